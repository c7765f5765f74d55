//! Scenes, techniques and the adapter by their names.

use anyhow::Context;
use catoptric_reflect::{Gpu, Prefer, Spec, SpecError};
use catoptric_scene::{LoadOptions, Scene, SceneError, builtin};

use crate::exit::{bad_input, warn};
use crate::options::Common;

/// Loads a scene. A built-in one whose model is missing is no error: the inner result then has the
/// reason. Anything else that is wrong is an error of the user's input.
pub fn load(name: &str, options: &LoadOptions) -> anyhow::Result<Result<Scene, String>> {
    match catoptric_scene::open(name, options) {
        Ok(scene) => {
            warn(&scene);
            Ok(Ok(scene))
        }
        Err(error @ SceneError::MissingModel { .. }) if builtin::text(name).is_some() => {
            Ok(Err(error.to_string()))
        }
        Err(error) => Err(error.into()),
    }
}

/// The size of a scene's pictures.
pub fn size(scene: &Scene) -> [u32; 2] {
    scene.camera.resolution
}

/// Pixels of a picture at most, enough for 7680×4320: with all layers, of several renderers, a
/// pixel takes some hundred bytes of memory.
const MOST_PIXELS: u64 = 1 << 25;

/// Refuses a picture that cannot be rendered: sides up to `limit`, `MOST_PIXELS` in all.
pub fn check_size(size: [u32; 2], limit: u32, whose: &str) -> anyhow::Result<()> {
    let [width, height] = size;
    let too_large = |why: String| {
        let text = format!("a picture of {width}x{height} pixels is too large: {why}");
        Err(bad_input(text))
    };
    if width.max(height) > limit {
        too_large(format!("{whose} ends at {limit} a side"))
    } else if u64::from(width) * u64::from(height) > MOST_PIXELS {
        too_large(format!("{MOST_PIXELS} are the most"))
    } else {
        Ok(())
    }
}

/// A technique by its name.
pub fn parse(text: &str) -> anyhow::Result<Spec> {
    if refinements(text) > 1 {
        return Err(bad_input(format!(
            "technique `{text}`: a search goes with one refinement, such as `linear+full(level=3)`"
        )));
    }
    match catoptric_reflect::parse(text) {
        // These name what is wrong themselves.
        Err(error @ SpecError::Technique { .. }) => Err(error.into()),
        parsed => parsed.with_context(|| format!("technique `{text}`")),
    }
}

/// How many refinements a technique's name adds to its search.
fn refinements(text: &str) -> usize {
    let mut depth = 0;
    let mut count = 0;
    for c in text.chars() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            '+' if depth == 0 => count += 1,
            _ => {}
        }
    }
    count
}

/// Opens the adapter asked for; without a wish, hardware first.
pub fn open_gpu(common: &Common) -> anyhow::Result<Gpu> {
    Ok(Gpu::new(common.adapter.as_deref(), Prefer::Hardware)?)
}

/// How scenes are loaded under these options.
pub fn load_options(common: &Common) -> LoadOptions {
    LoadOptions {
        models: common.models.clone(),
        resolution: common.resolution,
    }
}
