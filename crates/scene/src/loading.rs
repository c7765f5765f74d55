//! What loading one scene has made so far: textures, counts against their limits, warnings.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::picture::{Picture, PictureSource};
use crate::texture::Texture;

/// Most triangles of a scene, in all objects and mesh mirrors with their copies: 1.7 GB while they are
/// made and traced.
const MOST_TRIANGLES: u64 = 4_000_000;

/// Most points (vertices without triangles) of a scene.
const MOST_POINTS: u64 = 10_000_000;

/// Most texels of a scene, in all its textures: 192 MiB, or 384 MiB where they have 16 bits.
const MOST_TEXELS: u64 = 1 << 26;

/// Shared by all objects and mirrors of a scene while it is loaded.
#[derive(Default)]
pub(crate) struct Loading {
    triangles: Cell<u64>,
    points: Cell<u64>,
    texels: Cell<u64>,
    textures: RefCell<HashMap<PathBuf, Arc<Texture>>>,
    warnings: RefCell<Vec<String>>,
}

impl Loading {
    /// Counts triangles that are about to be made, `copies` times; says where they are too many.
    pub(crate) fn triangles(&self, count: u64, copies: usize) -> Result<(), String> {
        add(&self.triangles, count, copies, "triangles", MOST_TRIANGLES)
    }

    /// Counts points that are about to be made, `copies` times; says where they are too many.
    pub(crate) fn points(&self, count: u64, copies: usize) -> Result<(), String> {
        add(&self.points, count, copies, "points", MOST_POINTS)
    }

    /// The picture in a file, which is read once a scene.
    pub(crate) fn texture(&self, file: &Path) -> Result<Arc<Texture>, String> {
        let file = file.canonicalize().unwrap_or_else(|_| file.to_owned());
        if let Some(texture) = self.textures.borrow().get(&file) {
            return Ok(Arc::clone(texture));
        }
        let texture = self.decoded(&Picture::open(&file)?)?;
        self.textures
            .borrow_mut()
            .insert(file, Arc::clone(&texture));
        Ok(texture)
    }

    /// The picture that a model names or holds.
    pub(crate) fn picture(&self, source: &PictureSource) -> Result<Arc<Texture>, String> {
        match source {
            PictureSource::File(path) => {
                let of_file = |message: String| format!("{} {message}", path.display());
                self.texture(path).map_err(of_file)
            }
            PictureSource::Bytes(bytes) => {
                let picture = Picture::of(bytes.clone());
                let decoded = picture.and_then(|picture| self.decoded(&picture));
                decoded.map_err(|message| format!("a picture in it {message}"))
            }
        }
    }

    /// Decodes a picture, if there are not too many texels in the scene.
    fn decoded(&self, picture: &Picture) -> Result<Arc<Texture>, String> {
        let [width, height] = picture.size();
        let texels = u64::from(width) * u64::from(height);
        let all = self.texels.get() + texels;
        if all > MOST_TEXELS {
            return Err(format!(
                "has {texels} texels ({width}x{height}), which makes {all} in all textures of the \
                 scene: the most is {MOST_TEXELS}"
            ));
        }
        self.texels.set(all);
        Ok(Arc::new(picture.decode()?))
    }

    /// Notes what is odd but keeps nothing from loading.
    pub(crate) fn warn(&self, message: String) {
        self.warnings.borrow_mut().push(message);
    }

    /// All that was noted, in order.
    pub(crate) fn into_warnings(self) -> Vec<String> {
        self.warnings.into_inner()
    }
}

fn add(sum: &Cell<u64>, count: u64, copies: usize, what: &str, most: u64) -> Result<(), String> {
    let new = count.saturating_mul(copies as u64);
    let all = sum.get().saturating_add(new);
    if all > most {
        let times = match copies {
            1 => String::new(),
            _ => format!(" (in {copies} copies)"),
        };
        return Err(format!(
            "makes {new} {what}{times}, which makes {all} in the scene: the most is {most}"
        ));
    }
    sum.set(all);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_counted_adds_up() {
        let loading = Loading::default();
        assert_eq!(loading.triangles(MOST_TRIANGLES / 2, 2), Ok(()));
        assert_eq!(loading.points(MOST_POINTS, 1), Ok(()));
        assert_eq!(
            loading.triangles(2, 3).unwrap_err(),
            "makes 6 triangles (in 3 copies), which makes 4000006 in the scene: the most is \
             4000000"
        );
        assert!(loading.points(u64::MAX, usize::MAX).is_err());
    }
}
