//! STL files, as text or binary.

use std::io::{self, Cursor, Read, Seek, SeekFrom};
use std::path::Path;

use glam::{DVec3, Vec3};

use super::parts::Triangles;
use crate::SceneError;
use crate::loading::Loading;
use crate::text::at_line;

/// Bytes of a binary file before its triangles: a comment and their number.
const HEADER: usize = 84;
/// Bytes a triangle in a binary file.
const TRIANGLE: usize = 50;

/// Reads a mesh. Its normals are those of the flat triangles, so none are kept.
pub(super) fn read(path: &Path, copies: usize, loading: &Loading) -> Result<Triangles, SceneError> {
    let whole = |message: String| SceneError::File {
        file: path.display().to_string(),
        message,
    };
    let mut bytes =
        std::fs::read(path).map_err(|error| whole(format!("cannot be read: {error}")))?;
    let count = bytes.get(80..HEADER).map_or(0, |count| {
        u32::from_le_bytes([count[0], count[1], count[2], count[3]]) as usize
    });
    let is_binary = bytes.len() >= HEADER && bytes.len() - HEADER == count.saturating_mul(TRIANGLE);
    if is_binary {
        // A comment that begins like text would be taken for it.
        bytes[0] = b'\0';
    } else if !bytes.starts_with(b"solid") || bytes.contains(&0) {
        let message = match bytes.len() < HEADER {
            true => {
                "is no STL: it neither begins with `solid` nor has a header of 84 bytes".to_owned()
            }
            false => format!(
                "is no STL as text, and as a binary one of {count} triangles it would have {} bytes, \
                 not {}",
                count.saturating_mul(TRIANGLE).saturating_add(HEADER),
                bytes.len()
            ),
        };
        return Err(whole(message));
    } else if bytes.starts_with(b"solid\n") || bytes.starts_with(b"solid\r") {
        // The reader wants a space there.
        bytes.insert(5, b' ');
    }
    let mut lines = Lines {
        bytes: Cursor::new(bytes),
        line: 0,
        by_line: !is_binary,
    };
    let read = {
        let triangles = stl_io::create_stl_reader(&mut lines);
        triangles.and_then(|triangles| {
            let mut mesh = Triangles::default();
            for triangle in triangles {
                let triangle = triangle?;
                let first = mesh.positions.len() as u32;
                let corner = |vertex: stl_io::Vertex| Vec3::from(vertex.0).as_dvec3();
                mesh.positions.extend(triangle.vertices.map(corner));
                mesh.triangles.push([first, first + 1, first + 2]);
            }
            Ok(mesh)
        })
    };
    let mesh = read.map_err(|error| match is_binary {
        true => whole(error.to_string()),
        false => at_line(path, lines.line, error.to_string()),
    })?;
    if let Some(index) = mesh.positions.iter().position(|at| !at.is_finite()) {
        return Err(whole(format!("triangle {} is not finite", index / 3 + 1)));
    }
    loading
        .triangles(mesh.triangles.len() as u64, copies)
        .map_err(whole)?;
    Ok(shared(mesh))
}

/// The same triangles with bitwise equal corners merged: otherwise nothing could be smooth.
fn shared(mesh: Triangles) -> Triangles {
    let mut known = std::collections::HashMap::new();
    let mut positions: Vec<DVec3> = Vec::new();
    let triangles = mesh.triangles.iter().map(|three| {
        three.map(|index| {
            let position = mesh.positions[index as usize];
            let key = position.to_array().map(f64::to_bits);
            *known.entry(key).or_insert_with(|| {
                positions.push(position);
                positions.len() as u32 - 1
            })
        })
    });
    let triangles = triangles.collect();
    Triangles {
        positions,
        triangles,
        ..Triangles::default()
    }
}

/// Hands out text line by line, so that the line that the reader has reached is known.
struct Lines {
    bytes: Cursor<Vec<u8>>,
    line: usize,
    by_line: bool,
}

impl Read for Lines {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if !self.by_line {
            return self.bytes.read(into);
        }
        let at = usize::try_from(self.bytes.position()).unwrap_or(usize::MAX);
        let rest = self.bytes.get_ref().get(at..).unwrap_or_default();
        let end = rest.iter().position(|byte| *byte == b'\n');
        let length = end.map_or(rest.len(), |end| end + 1).min(into.len());
        into[..length].copy_from_slice(&rest[..length]);
        self.line += usize::from(length > 0 && (end == Some(length - 1) || end.is_none()));
        self.bytes.set_position((at + length) as u64);
        Ok(length)
    }
}

impl Seek for Lines {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.line = 0;
        self.bytes.seek(to)
    }
}
