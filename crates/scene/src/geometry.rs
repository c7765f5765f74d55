//! From parts (a primitive, an OBJ file) to a world-space [`Mesh`]: transform, merge, normals.

use std::collections::HashMap;

use glam::{DMat3, DVec3, Vec2, Vec3};

use crate::mesh::{Material, Mesh};

/// Triangles in a model's own space, in f64, positions not merged yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Geometry {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// A corner each, like `uvs` and `colors`; empty where there are none.
    pub normals: Vec<[DVec3; 3]>,
    pub uvs: Vec<[Vec2; 3]>,
    pub colors: Vec<[Vec3; 3]>,
    /// A triangle each; empty where all use the first of `materials`.
    pub material: Vec<u32>,
    pub materials: Vec<Material>,
}

/// An invertible affine map: scale, then rotation, then translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Transform {
    pub linear: DMat3,
    pub translate: DVec3,
}

impl Transform {
    pub(crate) const IDENTITY: Self = Self {
        linear: DMat3::IDENTITY,
        translate: DVec3::ZERO,
    };

    /// Rotation about a point, then translation.
    pub(crate) fn rigid(degrees: DVec3, about: DVec3, translate: DVec3) -> Self {
        let linear = rotation(degrees);
        Self {
            linear,
            translate: about - linear * about + translate,
        }
    }

    pub(crate) fn apply(&self, point: DVec3) -> DVec3 {
        self.linear * point + self.translate
    }

    /// This one, then `next`.
    pub(crate) fn then(&self, next: &Self) -> Self {
        Self {
            linear: next.linear * self.linear,
            translate: next.apply(self.translate),
        }
    }
}

/// Rotation Rz·Ry·Rx by angles in degrees.
pub(crate) fn rotation(degrees: DVec3) -> DMat3 {
    let [x, y, z] = degrees.to_array().map(exact_angle);
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

/// Radians; full turns are taken off first, so that they are exactly none.
fn exact_angle(degrees: f64) -> f64 {
    (degrees % 360.0).to_radians()
}

impl Geometry {
    /// A vertex with neither normal nor texture coordinates; returns its index.
    pub(crate) fn vertex(&mut self, position: DVec3) -> u32 {
        self.positions.push(position);
        (self.positions.len() - 1) as u32
    }

    /// A triangle of vertex indices with their normals and texture coordinates.
    pub(crate) fn triangle(&mut self, corners: [u32; 3], normals: [DVec3; 3], uvs: [Vec2; 3]) {
        self.triangles.push(corners);
        self.normals.push(normals);
        self.uvs.push(uvs);
    }

    /// Corner colours that show where a point lies in the model's own bounding box.
    pub(crate) fn color_by_position(&mut self) {
        let low = self.positions.iter().copied().fold(DVec3::MAX, DVec3::min);
        let high = self.positions.iter().copied().fold(DVec3::MIN, DVec3::max);
        let size = (high - low).max(DVec3::splat(f64::MIN_POSITIVE));
        let color = |index: u32| ((self.positions[index as usize] - low) / size).as_vec3();
        self.colors = self
            .triangles
            .iter()
            .map(|corners| corners.map(color))
            .collect();
    }

    /// The mesh in world space, once for each of `copies`. Positions equal after the transform
    /// become one, collapsed triangles and (where there are triangles) unused positions go.
    pub(crate) fn into_mesh(self, copies: &[Transform]) -> Result<Mesh, String> {
        let mut used = vec![self.triangles.is_empty(); self.positions.len()];
        self.triangles
            .iter()
            .flatten()
            .for_each(|index| used[*index as usize] = true);
        let mut mesh = Mesh::default();
        let mut seen = HashMap::new();
        for transform in copies {
            self.copy(transform, &used, &mut seen, &mut mesh)?;
        }
        mesh.materials = self.materials;
        mesh.repair_normals();
        Ok(mesh)
    }

    /// Adds a transformed copy to a mesh; `seen` has the indices of its positions.
    fn copy(
        &self,
        transform: &Transform,
        used: &[bool],
        seen: &mut HashMap<[u32; 3], u32>,
        mesh: &mut Mesh,
    ) -> Result<(), String> {
        let flip = transform.linear.determinant() < 0.0;
        let to_normal = transform.linear.inverse().transpose();
        let mut merged = vec![0; self.positions.len()];
        for (index, position) in self.positions.iter().enumerate().filter(|(i, _)| used[*i]) {
            // Adding zero turns −0 into +0.
            let world = transform.apply(*position).as_vec3() + Vec3::ZERO;
            if !world.is_finite() {
                return Err(format!("vertex {} is not finite", index + 1));
            }
            merged[index] = *seen
                .entry(world.to_array().map(f32::to_bits))
                .or_insert_with(|| {
                    mesh.positions.push(world);
                    mesh.positions.len() as u32 - 1
                });
        }

        for (index, corners) in self.triangles.iter().enumerate() {
            let merged = corners.map(|corner| merged[corner as usize]);
            // Also where two corners are one.
            if mesh.area_vector(&merged) == DVec3::ZERO {
                continue;
            }
            mesh.triangles.push(turned(merged, flip));
            mesh.material
                .push(self.material.get(index).copied().unwrap_or(0));
            if let Some(normals) = self.normals.get(index) {
                let world =
                    normals.map(|normal| (to_normal * normal).normalize_or_zero().as_vec3());
                mesh.normals.push(turned(world, flip));
            }
            mesh.uvs
                .extend(self.uvs.get(index).map(|uvs| turned(*uvs, flip)));
            mesh.colors
                .extend(self.colors.get(index).map(|colors| turned(*colors, flip)));
        }
        Ok(())
    }
}

fn turned<T>([a, b, c]: [T; 3], flip: bool) -> [T; 3] {
    if flip { [a, c, b] } else { [a, b, c] }
}

impl Mesh {
    /// Twice the triangle's area along its geometric normal.
    fn area_vector(&self, triangle: &[u32; 3]) -> DVec3 {
        let [a, b, c] = triangle.map(|index| self.positions[index as usize].as_dvec3());
        (b - a).cross(c - a)
    }

    /// Zero normals of a file become geometric ones.
    fn repair_normals(&mut self) {
        for index in 0..self.normals.len() {
            if self.normals[index]
                .iter()
                .any(|normal| normal.length_squared() < 0.5)
            {
                let face = self
                    .area_vector(&self.triangles[index])
                    .normalize_or(DVec3::Y)
                    .as_vec3();
                for normal in &mut self.normals[index] {
                    if normal.length_squared() < 0.5 {
                        *normal = face;
                    }
                }
            }
        }
    }

    /// Replaces all normals by smooth ones: face normals at each position, weighted by angle.
    pub(crate) fn smooth_normals(&mut self) {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for triangle in &self.triangles {
            let normal = self.area_vector(triangle).normalize_or_zero();
            for corner in 0..3 {
                let [here, next, previous] = [0, 1, 2].map(|offset| {
                    self.positions[triangle[(corner + offset) % 3] as usize].as_dvec3()
                });
                let angle = (next - here).angle_between(previous - here);
                if angle.is_finite() {
                    sums[triangle[corner] as usize] += angle * normal;
                }
            }
        }
        let normal = |index: u32| sums[index as usize].normalize_or_zero().as_vec3();
        self.normals = self
            .triangles
            .iter()
            .map(|corners| corners.map(normal))
            .collect();
        self.repair_normals();
    }

    /// Replaces all normals by those of the flat triangles, as their corners run.
    pub(crate) fn flat_normals(&mut self) {
        self.normals = self
            .triangles
            .iter()
            .map(|triangle| [self.area_vector(triangle).normalize_or(DVec3::Y).as_vec3(); 3])
            .collect();
    }

    /// Turns triangles so that they run counter-clockwise seen from where their normals point.
    pub(crate) fn wind_by_normals(&mut self) {
        for index in 0..self.triangles.len() {
            let shading: Vec3 = self.normals[index].iter().sum();
            if self
                .area_vector(&self.triangles[index])
                .dot(shading.as_dvec3())
                < 0.0
            {
                self.triangles[index].swap(1, 2);
                self.normals[index].swap(1, 2);
                if let Some(uvs) = self.uvs.get_mut(index) {
                    uvs.swap(1, 2);
                }
                if let Some(colors) = self.colors.get_mut(index) {
                    colors.swap(1, 2);
                }
            }
        }
    }
}
