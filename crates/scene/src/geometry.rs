//! From parts (a primitive, an OBJ file) to a world-space [`Mesh`]: transform, merge, normals.

use std::collections::HashMap;

use glam::{DMat3, DVec3, Vec2, Vec3};

use crate::mesh::{Material, Mesh};

/// Triangles in a model's own space, in f64, positions not merged yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Geometry {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// One per corner, like `uvs` and `colors`; empty where there are none.
    pub normals: Vec<[DVec3; 3]>,
    /// Corners that have no normal although others have; empty where all have.
    pub bare: Vec<[bool; 3]>,
    /// How corners get the normals that they lack, one per triangle; empty where all are flat.
    pub smoothing: Vec<Smoothing>,
    pub uvs: Vec<[Vec2; 3]>,
    pub colors: Vec<[Vec3; 3]>,
    /// One per triangle; empty where all use the first of `materials`.
    pub material: Vec<u32>,
    pub materials: Vec<Material>,
}

/// With which triangles a triangle shares its normals where they meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) enum Smoothing {
    /// Not given: in an object with none, in a mirror with all others for which it is not given.
    #[default]
    Unsaid,
    /// With none.
    Flat,
    /// With those of the same number.
    Group(u32),
}

/// What a mesh is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// It may do without normals.
    Object,
    /// It needs a normal at every corner, and is curved where nothing else is said.
    Mirror,
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

    /// The mesh in world space, once for each of `copies`. Positions that are equal after the transform
    /// are merged; collapsed triangles and (where there are triangles) unused positions are removed.
    pub(crate) fn into_mesh(self, copies: &[Transform], purpose: Purpose) -> Result<Mesh, String> {
        let mut used = vec![self.triangles.is_empty(); self.positions.len()];
        self.triangles
            .iter()
            .flatten()
            .for_each(|index| used[*index as usize] = true);
        let mut built = Built::default();
        for transform in copies {
            self.copy(transform, &used, &mut built)?;
        }
        let mut mesh = built.mesh;
        mesh.materials = self.materials;
        mesh.complete_normals(&built.bare, &built.smoothing, purpose);
        Ok(mesh)
    }

    /// Adds a transformed copy to a mesh.
    fn copy(&self, transform: &Transform, used: &[bool], built: &mut Built) -> Result<(), String> {
        let Built {
            mesh,
            indices,
            bare,
            smoothing,
        } = built;
        let flip = transform.linear.determinant() < 0.0;
        let to_normal = transform.linear.inverse().transpose();
        let mut merged = vec![0; self.positions.len()];
        for (index, position) in self.positions.iter().enumerate().filter(|(i, _)| used[*i]) {
            // Adding zero turns −0 into +0.
            let world = transform.apply(*position).as_vec3() + Vec3::ZERO;
            if !world.is_finite() {
                return Err(format!("vertex {} is not finite", index + 1));
            }
            merged[index] = *indices
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
                let world = normals.map(|normal| unit(to_normal * normal));
                let lacks = self.bare.get(index).copied().unwrap_or_default();
                let none = [0, 1, 2].map(|corner| lacks[corner] || world[corner].is_none());
                let world = world.map(|normal| normal.unwrap_or(DVec3::ZERO).as_vec3());
                mesh.normals.push(turned(world, flip));
                bare.push(turned(none, flip));
            }
            let group = self.smoothing.get(index).copied();
            smoothing.push(group.unwrap_or(Smoothing::Flat));
            mesh.uvs
                .extend(self.uvs.get(index).map(|uvs| turned(*uvs, flip)));
            mesh.colors
                .extend(self.colors.get(index).map(|colors| turned(*colors, flip)));
        }
        Ok(())
    }
}

/// A mesh to which copies are added.
#[derive(Default)]
struct Built {
    mesh: Mesh,
    /// Index of each position, by the position's bits.
    indices: HashMap<[u32; 3], u32>,
    /// Corners whose normal is not known; empty where none is.
    bare: Vec<[bool; 3]>,
    /// One per triangle.
    smoothing: Vec<Smoothing>,
}

/// A vector of length 1 in this direction. One that is of that length in 32 bits stays as it is, so that
/// the normals of a mesh that was written come back bit by bit.
fn unit(vector: DVec3) -> Option<DVec3> {
    match (vector.length_squared() - 1.0).abs() < f64::from(2.0 * f32::EPSILON) {
        true => Some(vector),
        false => vector.try_normalize(),
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

    /// Gives corners the normals that they lack: by their smoothing, or else those of their
    /// triangles. Where nothing has a normal and nothing is smooth, an object stays without.
    fn complete_normals(&mut self, bare: &[[bool; 3]], smoothing: &[Smoothing], purpose: Purpose) {
        let smooth = |triangle: usize| match smoothing[triangle] {
            Smoothing::Flat => None,
            Smoothing::Unsaid => (purpose == Purpose::Mirror).then_some(Smoothing::Unsaid),
            group @ Smoothing::Group(_) => Some(group),
        };
        let triangles = 0..self.triangles.len();
        let none = self.normals.is_empty();
        if none && purpose == Purpose::Object && triangles.clone().all(|t| smooth(t).is_none()) {
            return;
        }
        let lacks = |triangle: usize| match bare.get(triangle) {
            Some(corners) => *corners,
            None => [none; 3],
        };
        if triangles
            .clone()
            .all(|triangle| lacks(triangle) == [false; 3])
        {
            return;
        }
        let sums = self.smooth_sums(smooth);
        self.normals.resize(self.triangles.len(), [Vec3::ZERO; 3]);
        for triangle in triangles {
            let corners = self.triangles[triangle];
            let lacks = lacks(triangle);
            for corner in (0..3).filter(|corner| lacks[*corner]) {
                let shared = smooth(triangle)
                    .and_then(|group| sums.get(&(corners[corner], group)))
                    // Triangles that face each other leave nothing but rounding.
                    .filter(|sum| sum.length() > 1e-6)
                    .and_then(|sum| sum.try_normalize());
                let normal = shared.unwrap_or_else(|| self.face_normal(&corners));
                self.normals[triangle][corner] = normal.as_vec3();
            }
        }
    }

    /// For each position and each group of triangles that meet there, the sum of their normals,
    /// weighted by the angles of their corners.
    fn smooth_sums(
        &self,
        smooth: impl Fn(usize) -> Option<Smoothing>,
    ) -> HashMap<(u32, Smoothing), DVec3> {
        let mut sums = HashMap::new();
        for (index, triangle) in self.triangles.iter().enumerate() {
            let Some(group) = smooth(index) else {
                continue;
            };
            let normal = self.area_vector(triangle).normalize_or_zero();
            for corner in 0..3 {
                let [here, next, previous] = [0, 1, 2].map(|offset| {
                    self.positions[triangle[(corner + offset) % 3] as usize].as_dvec3()
                });
                let angle = (next - here).angle_between(previous - here);
                if angle.is_finite() {
                    *sums.entry((triangle[corner], group)).or_insert(DVec3::ZERO) += angle * normal;
                }
            }
        }
        sums
    }

    /// The normal of a flat triangle, as its corners run.
    fn face_normal(&self, triangle: &[u32; 3]) -> DVec3 {
        self.area_vector(triangle).normalize_or(DVec3::Y)
    }

    /// Replaces all normals by those of the flat triangles, as their corners run.
    pub(crate) fn flat_normals(&mut self) {
        self.normals = self
            .triangles
            .iter()
            .map(|triangle| [self.face_normal(triangle).as_vec3(); 3])
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
