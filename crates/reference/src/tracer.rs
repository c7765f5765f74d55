//! Single rays through a scene: the nearest object or mirror, exactly.
//!
//! Objects are two-sided triangles; analytic mirrors are met exactly ([`MirrorShape::intersect`](catoptric_scene::MirrorShape::intersect));
//! mesh mirrors are triangles with interpolated normals.
//!
//! Surfaces may coincide. A mirror as far away as an object (`EQUAL`) is met before it, and a
//! mirror's front before a back: a mirror that is written once for each side reflects on both. Of
//! coincident triangles of objects the first is met.
//!
//! A ray that leaves a mirror must not meet it again where it starts. From a mesh, the ray
//! starts `NUDGE` × the scene's extent off the triangle, on its reflecting side, and so moves
//! away from it and, where the mesh is convex, from its neighbours; a mesh as near as `EQUAL`
//! lies where it starts, as its other side does. A sphere, an ellipsoid and a
//! plane are not met again by a ray that leaves them, so they are left out. A mirror that is
//! not convex is met again only beyond `CONCAVE_NUDGE` × its extent.

use catoptric_scene::Scene;
use glam::{DVec3, Vec3};

use crate::bvh::TriangleHit;
use crate::check::{check, check_count, check_paint};
use crate::error::ReferenceError;
use crate::paint;
use crate::triangles::{Triangles, geometric_normal};

/// Share of the scene's extent by which a reflected ray stays clear of its start: several
/// thousand rounding steps of f64, and far below what f32 resolves.
const NUDGE: f64 = 1e-12;

/// Surfaces that are apart by no more than this share of their distance are equally far away: a few
/// rounding steps of f32, in which coordinates are given.
const EQUAL: f64 = 1.0 / 1_048_576.0;

/// Share of the extent of a mirror that is not convex within which a ray leaving it does not meet it again: rounding
/// moves the start along a ray that grazes the mirror far more than across it.
const CONCAVE_NUDGE: f64 = 1e-9;

/// How far Mitsuba 3 moves the start of a ray off the surface it leaves, as a share of 1 + the
/// largest coordinate.
const MITSUBA_OFFSET: f64 = 1500.0 / 16_777_216.0;

/// Where a ray that leaves a mirror starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RayStart {
    /// On the surface.
    #[default]
    Exact,
    /// Off the surface, as far as Mitsuba 3 moves it, to the side that the ray goes to: for
    /// comparing with its pictures more finely than that offset.
    Mitsuba,
}

/// A scene made ready for rays.
#[derive(Debug)]
pub struct Tracer {
    scene: Scene,
    objects: Triangles,
    mesh_mirrors: Triangles,
    /// Largest distance of anything from the origin.
    extent: f64,
    ray_start: RayStart,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// As in every id layer.
    pub id: u32,
    /// Distance along the (unit) ray, world units.
    pub t: f64,
    /// World-space point.
    pub position: DVec3,
    /// Unit normal: a mirror's on its reflecting side (of a mesh the interpolated shading
    /// normal), an object's geometric one turned towards the ray's origin.
    pub normal: DVec3,
    /// Unit normal of the surface itself: of a mesh mirror that of the triangle, on the side the
    /// shading normal is on; else equal to `normal`.
    pub geometric: DVec3,
    /// What was met.
    pub surface: Surface,
}

/// What a ray has met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// A triangle of an object.
    Object {
        /// Index into the scene's objects.
        index: usize,
        /// Index into the object's triangles.
        triangle: usize,
        /// Weights of the triangle's corners, summing to 1.
        barycentric: DVec3,
    },
    /// A mirror.
    Mirror {
        /// Index into the scene's mirrors.
        index: usize,
        /// True on the reflecting side.
        front: bool,
        /// Of a mesh, an index into its triangles, and the weights of that one's corners.
        triangle: Option<(usize, DVec3)>,
    },
}

/// A ray and what it may meet.
struct Start {
    origin: DVec3,
    t_min: f64,
    /// Mesh mirrors are not met before.
    mesh_t_min: f64,
    mirrors: bool,
    /// The analytic mirror that is being left.
    leaving: Option<usize>,
}

impl Tracer {
    /// Checks the scene and builds the hierarchies.
    pub fn new(scene: &Scene) -> Result<Self, ReferenceError> {
        for object in &scene.objects {
            check(&object.name, &object.mesh)?;
            check_paint(&object.name, &object.mesh)?;
        }
        for mirror in &scene.mirrors {
            if let Some(mesh) = mirror.shape.as_mesh() {
                check(&mirror.name, mesh)?;
                check_count(
                    &mirror.name,
                    "normals",
                    mesh.normals.len(),
                    mesh.triangles.len(),
                )?;
            }
        }
        let objects = Triangles::of_objects(scene);
        let mesh_mirrors = Triangles::of_mirrors(scene);
        let object_extents = scene
            .objects
            .iter()
            .filter_map(|object| object.mesh.bounds());
        let mirror_extents = scene
            .mirrors
            .iter()
            .map(|mirror| reach(mirror.shape.bounds()));
        let extent = object_extents
            .map(|(low, high)| reach((low.as_dvec3(), high.as_dvec3())))
            .chain(mirror_extents)
            .fold(0.0, f64::max);
        Ok(Self {
            scene: scene.clone(),
            objects,
            mesh_mirrors,
            extent,
            ray_start: RayStart::default(),
        })
    }

    /// The same with rays leaving mirrors elsewhere.
    #[must_use]
    pub fn with_ray_start(self, ray_start: RayStart) -> Self {
        Self { ray_start, ..self }
    }

    /// The scene traced.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Nearest object or mirror along the ray (`dir` of unit length).
    pub fn trace(&self, origin: DVec3, dir: DVec3) -> Option<Hit> {
        self.nearest(
            &Start {
                origin,
                t_min: 0.0,
                mesh_t_min: 0.0,
                mirrors: true,
                leaving: None,
            },
            dir,
        )
    }

    /// Nearest object along the ray (`dir` of unit length); mirrors are not seen.
    pub fn trace_objects(&self, origin: DVec3, dir: DVec3) -> Option<Hit> {
        self.nearest(
            &Start {
                origin,
                t_min: 0.0,
                mesh_t_min: 0.0,
                mirrors: false,
                leaving: None,
            },
            dir,
        )
    }

    /// What a ray that leaves a mirror at `from` in direction `dir` meets: objects, and mirrors if asked for.
    pub(crate) fn trace_reflected(&self, from: &Hit, dir: DVec3, mirrors: bool) -> Option<Hit> {
        if self.ray_start == RayStart::Mitsuba {
            return self.trace_from_mitsubas_start(from, dir, mirrors);
        }
        let nudge = self.extent * NUDGE;
        let start = match from.surface {
            Surface::Mirror { index, .. } if self.scene.mirrors[index].shape.is_analytic() => {
                Start {
                    origin: from.position,
                    t_min: nudge,
                    mesh_t_min: nudge,
                    mirrors,
                    leaving: Some(index),
                }
            }
            _ => Start {
                origin: from.position + nudge * from.geometric,
                t_min: 0.0,
                mesh_t_min: EQUAL * from.t,
                mirrors,
                leaving: None,
            },
        };
        self.nearest(&start, dir)
    }

    /// [`Tracer::trace_reflected`] under [`RayStart::Mitsuba`]; the distance is still measured from
    /// the surface.
    fn trace_from_mitsubas_start(&self, from: &Hit, dir: DVec3, mirrors: bool) -> Option<Hit> {
        let offset = MITSUBA_OFFSET * (1.0 + from.position.abs().max_element());
        let side = from.geometric * from.geometric.dot(dir).signum();
        let start = Start {
            origin: from.position + offset * side,
            t_min: 0.0,
            mesh_t_min: 0.0,
            mirrors,
            leaving: None,
        };
        self.nearest(&start, dir).map(|hit| Hit {
            t: hit.position.distance(from.position),
            ..hit
        })
    }

    /// Colour of an object's surface at a hit; black for mirrors.
    pub fn color(&self, hit: &Hit) -> Vec3 {
        match hit.surface {
            Surface::Object {
                index,
                triangle,
                barycentric,
            } => paint::surface(&self.scene.objects[index].mesh, triangle, barycentric),
            Surface::Mirror { .. } => Vec3::ZERO,
        }
    }

    /// Colour of a ray in direction `dir` (of unit length) that meets nothing.
    pub fn background(&self, dir: DVec3) -> Vec3 {
        paint::background(&self.scene.background, dir)
    }

    fn nearest(&self, start: &Start, dir: DVec3) -> Option<Hit> {
        let object = self
            .objects
            .bvh
            .intersect(start.origin, dir, start.t_min, f64::INFINITY);
        if !start.mirrors {
            return object.map(|hit| self.object_hit(&hit, dir));
        }
        // A mirror as far away as an object wins.
        let t_max = object.map_or(f64::INFINITY, |hit| hit.t * (1.0 + EQUAL));
        let mut nearest = self.mesh_mirror(start, dir, t_max);
        for (index, mirror) in self.scene.mirrors.iter().enumerate() {
            let leaving = start.leaving == Some(index);
            if !mirror.shape.is_analytic() || leaving && mirror.shape.is_convex() {
                continue;
            }
            let t_min = match leaving {
                true => start
                    .t_min
                    .max(CONCAVE_NUDGE * reach(mirror.shape.bounds())),
                false => start.t_min,
            };
            let Some(hit) = mirror.shape.intersect(start.origin, dir, t_min) else {
                continue;
            };
            let hit = Hit {
                id: self.scene.mirror_id(index),
                t: hit.t,
                position: hit.position,
                normal: hit.normal,
                geometric: hit.normal,
                surface: Surface::Mirror {
                    index,
                    front: dir.dot(hit.normal) < 0.0,
                    triangle: None,
                },
            };
            if hit.t < t_max && nearest.is_none_or(|other| is_met_before(&hit, &other)) {
                nearest = Some(hit);
            }
        }
        nearest.or_else(|| object.map(|hit| self.object_hit(&hit, dir)))
    }

    /// The mesh mirror that is met before `t_max`.
    fn mesh_mirror(&self, start: &Start, dir: DVec3, t_max: f64) -> Option<Hit> {
        let bvh = &self.mesh_mirrors.bvh;
        let hit = bvh.intersect(start.origin, dir, start.mesh_t_min, t_max)?;
        let back = self.mesh_mirror_hit(&hit, dir);
        if back.is_front() {
            return Some(back);
        }
        let t_max = t_max.min(hit.t * (1.0 + EQUAL));
        let is_front = |triangle| self.mesh_mirrors.is_front(triangle, dir);
        let front = bvh.intersect_among(start.origin, dir, start.mesh_t_min, t_max, is_front);
        let front = front.map(|hit| self.mesh_mirror_hit(&hit, dir));
        front.filter(Hit::is_front).or(Some(back))
    }

    fn object_hit(&self, hit: &TriangleHit, dir: DVec3) -> Hit {
        let (index, triangle) = self.objects.owner(hit);
        let facing = geometric_normal(&hit.corners);
        let normal = if facing.dot(dir) > 0.0 {
            -facing
        } else {
            facing
        };
        Hit {
            id: self.scene.object_id(index),
            t: hit.t,
            position: mix(&hit.corners, hit.barycentric),
            normal,
            geometric: normal,
            surface: Surface::Object {
                index,
                triangle,
                barycentric: hit.barycentric,
            },
        }
    }

    fn mesh_mirror_hit(&self, hit: &TriangleHit, dir: DVec3) -> Hit {
        let (index, triangle) = self.mesh_mirrors.owner(hit);
        let mesh = self.scene.mirrors[index].shape.as_mesh();
        let mesh = mesh.expect("only meshes are in this hierarchy");
        let facing = geometric_normal(&hit.corners);
        let shading = mix(&mesh.normals[triangle].map(Vec3::as_dvec3), hit.barycentric);
        let normal = shading.try_normalize().unwrap_or(facing);
        let geometric = if facing.dot(normal) < 0.0 {
            -facing
        } else {
            facing
        };
        Hit {
            id: self.scene.mirror_id(index),
            t: hit.t,
            position: mix(&hit.corners, hit.barycentric),
            normal,
            geometric,
            surface: Surface::Mirror {
                index,
                front: geometric.dot(dir) < 0.0,
                triangle: Some((triangle, hit.barycentric)),
            },
        }
    }
}

impl Hit {
    /// Whether it is a mirror on its reflecting side.
    fn is_front(&self) -> bool {
        matches!(self.surface, Surface::Mirror { front: true, .. })
    }
}

/// Whether `hit` is met before `other`, both on mirrors: the nearer one is, and of two at the same distance the one on
/// a front.
fn is_met_before(hit: &Hit, other: &Hit) -> bool {
    let equal = (hit.t - other.t).abs() <= EQUAL * other.t;
    match (hit.is_front(), other.is_front()) {
        (true, false) if equal => true,
        (false, true) if equal => false,
        _ => hit.t < other.t,
    }
}

fn mix([a, b, c]: &[DVec3; 3], weights: DVec3) -> DVec3 {
    weights.x * a + weights.y * b + weights.z * c
}

/// Largest distance from the origin to a point of a box.
fn reach((low, high): (DVec3, DVec3)) -> f64 {
    low.abs().max(high.abs()).length()
}
