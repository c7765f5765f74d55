//! What the objects of a scene are on the GPU: one list of vertices, corners and materials for all.

use catoptric_scene::{Mesh, Paint, Scene};
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
}

/// All object geometry of a scene, flattened.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    pub positions: Vec<[f32; 4]>,
    pub corners: Vec<Corner>,
    pub materials: Vec<MaterialUniform>,
    pub texels: Vec<[f32; 4]>,
}

impl Geometry {
    pub(crate) fn new(scene: &Scene) -> Self {
        let mut geometry = Self::default();
        for (index, object) in scene.objects.iter().enumerate() {
            geometry.add(&object.mesh, scene.object_id(index));
        }
        geometry
    }

    fn add(&mut self, mesh: &Mesh, object: u32) {
        let first_vertex = self.positions.len() as u32;
        let first_material = self.materials.len() as u32;
        self.positions
            .extend(mesh.positions.iter().map(|p| [p.x, p.y, p.z, 1.0]));
        for material in &mesh.materials {
            self.add_material(&material.paint);
        }
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            for (corner, vertex) in triangle.iter().enumerate() {
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
                let first_texel = self.texels.len() as u32;
                self.texels
                    .extend(image.texels.iter().map(|t| [t.x, t.y, t.z, 1.0]));
                material = MaterialUniform {
                    a: *tint,
                    kind: 2,
                    first_texel,
                    width: image.width,
                    height: image.height,
                    ..material
                };
            }
            Paint::Vertex => material.kind = 3,
        }
        self.materials.push(material);
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
                height
            },
            "stage/primary",
            &[],
            "Material"
        );
    }
}
