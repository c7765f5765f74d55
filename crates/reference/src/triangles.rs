//! The triangles that rays are to meet, of all objects or of all mesh mirrors.

use catoptric_scene::{Mesh, Scene, first_of_coincident};
use glam::{DVec3, Vec3};

use crate::bvh::{TriangleBvh, TriangleHit};

/// Triangles of several meshes in one hierarchy. Of coincident triangles of objects only the first
/// is kept, of mirrors the first for each side.
#[derive(Debug)]
pub(crate) struct Triangles {
    pub(crate) bvh: TriangleBvh,
    /// Mesh and triangle of each triangle in the hierarchy.
    owners: Vec<(u32, u32)>,
    /// Of mirrors, the unit normal of each on the reflecting side.
    fronts: Vec<Vec3>,
}

impl Triangles {
    /// The triangles of objects.
    pub(crate) fn of_objects(scene: &Scene) -> Self {
        let meshes = scene.objects.iter().map(|object| Some(&object.mesh));
        let (all, owners) = triangles(meshes);
        let first = first_of_coincident(all.len(), |index| (all[index], false));
        Self {
            bvh: TriangleBvh::new(&those(&first, all)),
            owners: those(&first, owners),
            fronts: Vec::new(),
        }
    }

    /// The triangles of mesh mirrors.
    pub(crate) fn of_mirrors(scene: &Scene) -> Self {
        let meshes = scene.mirrors.iter().map(|mirror| mirror.shape.as_mesh());
        let (all, owners) = triangles(meshes);
        let front = |(corners, (mirror, triangle)): (&[Vec3; 3], &(u32, u32))| {
            let mesh = scene.mirrors[*mirror as usize].shape.as_mesh();
            let normals = mesh.map(|mesh| mesh.normals[*triangle as usize]);
            let shading: Vec3 = normals.unwrap_or_default().iter().sum();
            let facing = geometric_normal(&corners.map(Vec3::as_dvec3)).as_vec3();
            match facing.dot(shading) < 0.0 {
                true => -facing,
                false => facing,
            }
        };
        let fronts: Vec<Vec3> = all.iter().zip(&owners).map(front).collect();
        // One for each side.
        let first = first_of_coincident(all.len(), |index| {
            let mut corners = all[index];
            corners.sort_by_key(|corner| corner.to_array().map(f32::to_bits));
            let facing = geometric_normal(&corners.map(Vec3::as_dvec3)).as_vec3();
            (all[index], facing.dot(fronts[index]) < 0.0)
        });
        Self {
            bvh: TriangleBvh::new(&those(&first, all)),
            owners: those(&first, owners),
            fronts: those(&first, fronts),
        }
    }

    /// Mesh, and triangle in it.
    pub(crate) fn owner(&self, hit: &TriangleHit) -> (usize, usize) {
        let (mesh, triangle) = self.owners[hit.triangle as usize];
        (mesh as usize, triangle as usize)
    }

    /// Whether a ray in direction `dir` meets a mirror's triangle on its reflecting side.
    pub(crate) fn is_front(&self, triangle: u32, dir: DVec3) -> bool {
        self.fronts[triangle as usize].as_dvec3().dot(dir) < 0.0
    }
}

/// All triangles, each with its mesh and its index there. Those without an area are left out: no ray
/// can meet them.
fn triangles<'a>(
    meshes: impl Iterator<Item = Option<&'a Mesh>>,
) -> (Vec<[Vec3; 3]>, Vec<(u32, u32)>) {
    let mut all = Vec::new();
    let mut owners = Vec::new();
    for (mesh, index) in meshes.zip(0..) {
        let Some(mesh) = mesh else { continue };
        for triangle in 0..mesh.triangles.len() {
            let corners = corners(mesh, triangle);
            let [a, b, c] = corners.map(Vec3::as_dvec3);
            if (b - a).cross(c - a) != DVec3::ZERO {
                all.push(corners);
                owners.push((index, triangle as u32));
            }
        }
    }
    (all, owners)
}

/// The values for which `wanted` holds.
fn those<T>(wanted: &[bool], values: Vec<T>) -> Vec<T> {
    let values = values.into_iter().zip(wanted);
    values
        .filter_map(|(value, wanted)| wanted.then_some(value))
        .collect()
}

fn corners(mesh: &Mesh, triangle: usize) -> [Vec3; 3] {
    mesh.triangles[triangle].map(|index| mesh.positions[index as usize])
}

/// Unit normal of a triangle as its corners run.
pub(crate) fn geometric_normal([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}
