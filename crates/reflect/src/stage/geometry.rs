//! What the objects of a scene are on the GPU: one list of vertices, corners and materials for all.

use std::collections::HashMap;
use std::sync::Arc;

use catoptric_scene::{Mesh, Paint, Samples, Scene, Texture, first_of_coincident};
use encase::ShaderType;
use glam::{Vec2, Vec3};

/// Twin of `Corner` in `shared/surface.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Corner {
    pub uv: Vec2,
    pub vertex: u32,
    pub material: u32,
    pub color: Vec3,
    pub object: u32,
}

/// Twin of `Material` in `shared/surface.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct MaterialUniform {
    pub a: Vec3,
    pub kind: u32,
    pub b: Vec3,
    pub cells: u32,
    pub first_texel: u32,
    pub width: u32,
    pub height: u32,
    pub table: u32,
}

/// All object geometry of a scene, flattened.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    pub positions: Vec<[f32; 4]>,
    pub corners: Vec<Corner>,
    pub materials: Vec<MaterialUniform>,
    /// Of each texture a table of linear values, then the texels, which hold places in it.
    pub texels: Vec<u32>,
    /// Where a texture's table and texels begin, by its address.
    textures: HashMap<*const Texture, [u32; 2]>,
}

/// World-space positions of all objects' vertices, one after the other, w = 1.
pub(crate) fn positions(scene: &Scene) -> Vec<[f32; 4]> {
    let meshes = scene.objects.iter().map(|object| &object.mesh);
    let positions = meshes.flat_map(|mesh| &mesh.positions);
    positions.map(|p| [p.x, p.y, p.z, 1.0]).collect()
}

impl Geometry {
    pub(crate) fn new(scene: &Scene) -> Self {
        let mut geometry = Self {
            positions: positions(scene),
            ..Self::default()
        };
        let mut first_vertex = 0;
        for (index, object) in scene.objects.iter().enumerate() {
            geometry.add(&object.mesh, scene.object_id(index), first_vertex);
            first_vertex += object.mesh.positions.len() as u32;
        }
        geometry
    }

    fn add(&mut self, mesh: &Mesh, object: u32, first_vertex: u32) {
        let first_material = self.materials.len() as u32;
        for material in &mesh.materials {
            self.add_material(&material.paint);
        }
        // Of coincident triangles the first is seen; the others become points, so that rounding does not
        // choose between them.
        let first = first_of_coincident(mesh.triangles.len(), |index| {
            let corners = mesh.triangles[index].map(|vertex| mesh.positions[vertex as usize]);
            (corners, false)
        });
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let triangle = if first[index] {
                *triangle
            } else {
                [triangle[0]; 3]
            };
            for (corner, vertex) in triangle.into_iter().enumerate() {
                self.corners.push(Corner {
                    uv: mesh.uvs.get(index).map_or(Vec2::ZERO, |uvs| uvs[corner]),
                    vertex: first_vertex + vertex,
                    material: first_material + mesh.material[index],
                    color: mesh
                        .colors
                        .get(index)
                        .map_or(Vec3::ZERO, |colors| colors[corner]),
                    object,
                });
            }
        }
    }

    fn add_material(&mut self, paint: &Paint) {
        let mut material = MaterialUniform {
            a: Vec3::ZERO,
            kind: 0,
            b: Vec3::ZERO,
            cells: 0,
            first_texel: 0,
            width: 0,
            height: 0,
            table: 0,
        };
        match paint {
            Paint::Color(color) => material.a = *color,
            Paint::Checker { a, b, cells } => {
                material = MaterialUniform {
                    a: *a,
                    kind: 1,
                    b: *b,
                    cells: *cells,
                    ..material
                };
            }
            Paint::Texture { tint, image } => {
                let [table, first_texel] = self.texture(image);
                material = MaterialUniform {
                    a: *tint,
                    kind: match image.samples() {
                        Samples::Eight(_) => 2,
                        Samples::Sixteen(_) => 4,
                    },
                    first_texel,
                    width: image.width(),
                    height: image.height(),
                    table,
                    ..material
                };
            }
            Paint::Vertex => material.kind = 3,
        }
        self.materials.push(material);
    }

    /// Where the table and the texels of a texture begin; one that several materials show is there
    /// once.
    fn texture(&mut self, image: &Arc<Texture>) -> [u32; 2] {
        let address = Arc::as_ptr(image);
        if let Some(places) = self.textures.get(&address) {
            return *places;
        }
        let table = self.texels.len() as u32;
        (self.texels).extend(image.table().iter().map(|value| value.to_bits()));
        let first_texel = self.texels.len() as u32;
        match image.samples() {
            Samples::Eight(texels) => (self.texels).extend(
                texels
                    .iter()
                    .map(|[r, g, b]| u32::from_le_bytes([*r, *g, *b, 0])),
            ),
            Samples::Sixteen(texels) => (self.texels).extend(
                texels
                    .iter()
                    .flat_map(|[r, g, b]| [u32::from(*r) | u32::from(*g) << 16, u32::from(*b)]),
            ),
        }
        self.textures.insert(address, [table, first_texel]);
        [table, first_texel]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn records_lie_as_the_shaders_read_them() {
        assert_layout!(
            Corner {
                uv,
                vertex,
                material,
                color,
                object
            },
            "stage/primary",
            &[],
            "Corner"
        );
        assert_layout!(
            MaterialUniform {
                a,
                kind,
                b,
                cells,
                first_texel,
                width,
                height,
                table
            },
            "stage/primary",
            &[],
            "Material"
        );
    }
}
