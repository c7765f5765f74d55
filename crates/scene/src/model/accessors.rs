//! The numbers behind glTF's accessors: buffers, views of them, and what is stored there.
//!
//! Whatever a file says of offsets and lengths is checked before it is used.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::json;
use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, Type};
use gltf::json::validation::Checked;

/// Most elements of an accessor: as many corners as the largest mesh has.
const MOST_ELEMENTS: u64 = 12_000_000;

/// A file's description and the bytes that it describes.
pub(super) struct Source<'f> {
    pub root: &'f json::Root,
    /// Folder of the file, for those that it names.
    pub folder: &'f Path,
    /// One a buffer.
    buffers: Vec<Cow<'f, [u8]>>,
}

/// An accessor's numbers, row by row.
pub(super) struct Numbers {
    pub values: Vec<f64>,
    /// A row's.
    pub width: usize,
}

impl<'f> Source<'f> {
    /// Reads all buffers; `inside` is what a binary file has in itself.
    pub(super) fn read(
        root: &'f json::Root,
        folder: &'f Path,
        inside: Option<&'f [u8]>,
    ) -> Result<Self, String> {
        let mut buffers = Vec::new();
        for (number, buffer) in root.buffers.iter().enumerate() {
            let bytes = match (&buffer.uri, inside) {
                (Some(uri), _) => match resource(uri, folder) {
                    Ok(Resource::Bytes(bytes)) => Cow::Owned(bytes),
                    Ok(Resource::File(path)) => {
                        let read = std::fs::read(&path);
                        let bytes = read.map_err(|error| {
                            format!("buffer {number}: cannot read {}: {error}", path.display())
                        })?;
                        Cow::Owned(bytes)
                    }
                    Err(message) => return Err(format!("buffer {number}: {message}")),
                },
                (None, Some(bytes)) if number == 0 => Cow::Borrowed(bytes),
                (None, _) => return Err(format!("buffer {number} has neither `uri` nor bytes")),
            };
            if (bytes.len() as u64) < buffer.byte_length.0 {
                return Err(format!(
                    "buffer {number} is to have {} bytes, and has {}",
                    buffer.byte_length.0,
                    bytes.len()
                ));
            }
            buffers.push(bytes);
        }
        Ok(Self {
            root,
            folder,
            buffers,
        })
    }

    /// The bytes of a view.
    pub(super) fn view(&self, index: json::Index<json::buffer::View>) -> Result<&[u8], String> {
        let number = index.value();
        let view = self.root.get(index);
        let view = view.ok_or_else(|| format!("there is no bufferView {number}"))?;
        let bytes = self.buffers.get(view.buffer.value());
        let bytes = bytes.ok_or_else(|| format!("bufferView {number} is of no buffer"))?;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let range = |length: u64| {
            let start = usize::try_from(start).ok()?;
            bytes.get(start..start.checked_add(usize::try_from(length).ok()?)?)
        };
        range(view.byte_length.0).ok_or_else(|| {
            format!(
                "bufferView {number} ends at byte {}, past the {} of its buffer",
                start.saturating_add(view.byte_length.0),
                bytes.len()
            )
        })
    }

    /// All numbers of an accessor; integers that stand for fractions become these.
    pub(super) fn numbers(&self, index: json::Index<Accessor>) -> Result<Numbers, String> {
        let number = index.value();
        let error = |message: String| format!("accessor {number}: {message}");
        let accessor = self.root.get(index);
        let accessor = accessor.ok_or_else(|| format!("there is no accessor {number}"))?;
        let (Checked::Valid(GenericComponentType(kind)), Checked::Valid(shape)) =
            (accessor.component_type, accessor.type_)
        else {
            return Err(error("its type is none that there is".to_owned()));
        };
        let width = match shape {
            Type::Scalar => 1,
            Type::Vec2 => 2,
            Type::Vec3 => 3,
            Type::Vec4 => 4,
            _ => return Err(error("matrices are not read".to_owned())),
        };
        let count = accessor.count.0;
        if count > MOST_ELEMENTS {
            return Err(error(format!(
                "has {count} elements: the most is {MOST_ELEMENTS}"
            )));
        }
        let count = count as usize;
        let layout = Layout {
            kind,
            width,
            normalized: accessor.normalized,
        };
        let mut values = match accessor.buffer_view {
            None => vec![0.0; count * width],
            Some(view) => {
                let stride = self.root.get(view).and_then(|view| view.byte_stride);
                let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
                let bytes = self.view(view).map_err(error)?;
                layout
                    .rows(bytes, offset, stride.map(|stride| stride.0), count)
                    .map_err(error)?
            }
        };
        if let Some(sparse) = &accessor.sparse {
            self.replace(sparse, &layout, &mut values).map_err(error)?;
        }
        Ok(Numbers { values, width })
    }

    /// Puts the sparse values in place.
    fn replace(
        &self,
        sparse: &json::accessor::sparse::Sparse,
        layout: &Layout,
        values: &mut [f64],
    ) -> Result<(), String> {
        let Checked::Valid(kind) = sparse.indices.component_type else {
            return Err("the type of its sparse indices is none that there is".to_owned());
        };
        let whole = Layout {
            kind: kind.0,
            width: 1,
            normalized: false,
        };
        let count = usize::try_from(sparse.count.0).unwrap_or(usize::MAX);
        if count > values.len() {
            return Err(format!("has {count} sparse values, more than elements"));
        }
        let indices = self.view(sparse.indices.buffer_view)?;
        let indices = whole.rows(indices, sparse.indices.byte_offset.0, None, count)?;
        let new = self.view(sparse.values.buffer_view)?;
        let new = layout.rows(new, sparse.values.byte_offset.0, None, count)?;
        for (index, row) in indices.iter().zip(new.chunks_exact(layout.width)) {
            let start = *index as usize * layout.width;
            let place = values.get_mut(start..start + layout.width);
            let place = place.ok_or_else(|| format!("has no element {index}"))?;
            place.copy_from_slice(row);
        }
        Ok(())
    }
}

/// How numbers are stored.
struct Layout {
    kind: ComponentType,
    width: usize,
    normalized: bool,
}

impl Layout {
    fn rows(
        &self,
        bytes: &[u8],
        offset: u64,
        stride: Option<usize>,
        count: usize,
    ) -> Result<Vec<f64>, String> {
        let row = self.width * self.kind.size();
        let stride = stride.unwrap_or(row);
        if stride < row {
            return Err(format!(
                "its stride of {stride} bytes is less than a row's {row}"
            ));
        }
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let end = (count.max(1) - 1).checked_mul(stride);
        let end = end.and_then(|end| end.checked_add(row)?.checked_add(offset));
        if count > 0 && end.is_none_or(|end| end > bytes.len()) {
            return Err(format!(
                "{count} rows of {row} bytes do not lie in the {} of its bufferView",
                bytes.len()
            ));
        }
        let rows = (0..count).map(|index| {
            let start = offset + index * stride;
            &bytes[start..start + row]
        });
        let numbers = rows.flat_map(|row| row.chunks_exact(self.kind.size()));
        Ok(numbers.map(|bytes| self.number(bytes)).collect())
    }

    /// A number of its size in bytes.
    fn number(&self, bytes: &[u8]) -> f64 {
        let byte = |place: usize| bytes.get(place).copied().unwrap_or_default();
        let two = [byte(0), byte(1)];
        let four = [byte(0), byte(1), byte(2), byte(3)];
        let (value, most) = match self.kind {
            ComponentType::I8 => (f64::from(byte(0) as i8), f64::from(i8::MAX)),
            ComponentType::U8 => (f64::from(byte(0)), f64::from(u8::MAX)),
            ComponentType::I16 => (f64::from(i16::from_le_bytes(two)), f64::from(i16::MAX)),
            ComponentType::U16 => (f64::from(u16::from_le_bytes(two)), f64::from(u16::MAX)),
            ComponentType::U32 => (f64::from(u32::from_le_bytes(four)), f64::from(u32::MAX)),
            ComponentType::F32 => return f64::from(f32::from_le_bytes(four)),
        };
        match self.normalized {
            true => (value / most).max(-1.0),
            false => value,
        }
    }
}

/// What a URI leads to.
pub(super) enum Resource {
    /// What stands in the URI itself.
    Bytes(Vec<u8>),
    /// A file.
    File(PathBuf),
}

/// Longest piece of a URI in a message.
const LONGEST: usize = 80;

/// Understands `data:…;base64,…` and names of files beside the one that names them.
pub(super) fn resource(uri: &str, folder: &Path) -> Result<Resource, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, coded) = data
            .split_once(";base64,")
            .ok_or("a data URI is read in base64 only")?;
        let bytes = STANDARD.decode(coded.trim_end());
        return bytes
            .map(Resource::Bytes)
            .map_err(|error| format!("its base64 is broken: {error}"));
    }
    let shown: String = uri.chars().take(LONGEST).collect();
    if uri.contains("://") {
        return Err(format!(
            "`{shown}` is not beside the file: nothing is fetched"
        ));
    }
    Ok(Resource::File(folder.join(without_escapes(uri))))
}

/// `%20` and its like as the bytes that they stand for.
fn without_escapes(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let [first, after @ ..] = rest {
        let hex = after.get(..2).filter(|_| *first == b'%');
        let hex = hex.and_then(|hex| std::str::from_utf8(hex).ok());
        match hex.and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_in_names() {
        assert_eq!(without_escapes("a%20b%C3%A9%zz%"), "a bé%zz%");
    }

    #[test]
    fn rows_stay_in_their_view() {
        let layout = Layout {
            kind: ComponentType::U8,
            width: 2,
            normalized: true,
        };
        let bytes = [0, 255, 9, 51, 0];
        assert_eq!(
            layout.rows(&bytes, 0, Some(3), 2),
            Ok(vec![0.0, 1.0, 0.2, 0.0])
        );
        assert!(layout.rows(&bytes, 1, Some(3), 2).is_err());
        assert!(layout.rows(&bytes, 0, Some(1), 2).is_err());
        assert!(layout.rows(&bytes, u64::MAX, Some(3), usize::MAX).is_err());
        assert_eq!(layout.rows(&bytes, u64::MAX, None, 0), Ok(Vec::new()));
    }
}
