//! Binary PLY files: triangles whose corners share what is bitwise equal.

use std::collections::HashMap;

/// Triangles with the same float properties at each corner.
pub struct Ply {
    properties: &'static [&'static str],
    /// Rows of as many floats as there are properties.
    vertices: Vec<f32>,
    faces: Vec<[u32; 3]>,
    known: HashMap<Vec<u32>, u32>,
}

impl Ply {
    /// No triangles yet; `properties` names the floats of a corner in their order.
    pub fn new(properties: &'static [&'static str]) -> Self {
        Self {
            properties,
            vertices: Vec::new(),
            faces: Vec::new(),
            known: HashMap::new(),
        }
    }

    /// Adds a triangle; each corner has its properties' values in order.
    pub fn triangle(&mut self, corners: [&[f32]; 3]) {
        let face = corners.map(|corner| self.vertex(corner));
        self.faces.push(face);
    }

    /// True where no triangle was added.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    fn vertex(&mut self, values: &[f32]) -> u32 {
        assert_eq!(values.len(), self.properties.len(), "{:?}", self.properties);
        let key = values.iter().map(|value| value.to_bits()).collect();
        let next = self.known.len() as u32;
        *self.known.entry(key).or_insert_with(|| {
            self.vertices.extend_from_slice(values);
            next
        })
    }

    /// The file.
    pub fn bytes(&self) -> Vec<u8> {
        let mut text = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
            self.known.len()
        );
        for name in self.properties {
            text += &format!("property float {name}\n");
        }
        text += &format!("element face {}\n", self.faces.len());
        text += "property list uchar uint vertex_indices\nend_header\n";
        let mut bytes = text.into_bytes();
        for value in &self.vertices {
            bytes.extend(value.to_le_bytes());
        }
        for face in &self.faces {
            bytes.push(3);
            face.iter()
                .for_each(|index| bytes.extend(index.to_le_bytes()));
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_corners_are_stored_once() {
        let mut ply = Ply::new(&["x", "y", "z"]);
        let [a, b, c, d] = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
        ];
        ply.triangle([&a, &b, &c]);
        ply.triangle([&c, &b, &d]);
        assert_eq!(ply.faces, [[0, 1, 2], [2, 1, 3]]);
        let bytes = ply.bytes();
        let header = b"ply\nformat binary_little_endian 1.0\nelement vertex 4\n\
            property float x\nproperty float y\nproperty float z\n\
            element face 2\nproperty list uchar uint vertex_indices\nend_header\n";
        assert!(bytes.starts_with(header));
        assert_eq!(bytes.len(), header.len() + 4 * 12 + 2 * 13);
    }
}
