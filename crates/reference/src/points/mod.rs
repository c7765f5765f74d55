//! Exact reflection points of vertices, in f64, without a search over pixels.
//!
//! A point `R` of a mirror reflects vertex `V` to eye `O` where the bisector of the directions
//! to both is the normal `N` of the reflecting side, and both lie in front: `N·(O−R) > 0` and
//! `N·(V−R) > 0`. Objects do not occlude here, nor does the mirror itself (the outside of a bowl
//! may well hide its inside), but for the eye's view of a torus or a saddle, whose front may hide
//! its front.
//!
//! - sphere and bowl: the roots of Alhazen's quartic, all of them ([`mod@sphere`]);
//! - plane: the mirror image;
//! - ellipsoid: the minimum of a convex function ([`mod@ellipsoid`]);
//! - torus and saddle: all stationary points, by dividing the surface until each part is settled
//!   (`stationary`);
//! - mesh: not available, for its interpolated normals belong to no surface.
//!
//! Regions are those of Estalella et al., "Accurate Interactive Specular Reflections on Curved
//! Objects", VMV 2005, §6.1. World space throughout.

pub mod ellipsoid;
mod patch;
mod quartic;
pub mod sphere;
mod stationary;

use catoptric_frame::{Frame, Status, TrueVertex, VertexClass};
use catoptric_scene::{Mirror, Scene, Shape, View};
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use crate::error::NotAvailable;

/// All reflection points of a vertex, whatever may stand in between.
#[derive(Clone, Debug, PartialEq)]
pub struct Solutions {
    /// Region the vertex lies in.
    pub class: VertexClass,
    /// World-space points; empty unless `class` is `Reflected`.
    pub points: Vec<DVec3>,
}

impl Solutions {
    pub(crate) fn none(class: VertexClass) -> Self {
        Self {
            class,
            points: Vec::new(),
        }
    }

    /// `Reflected` in the points of the whole surface that an open mirror keeps; else
    /// `Unreflected` if the whole surface has any, else `Hidden`.
    pub(crate) fn within(whole: Vec<DVec3>, keep: impl Fn(&DVec3) -> bool) -> Self {
        if whole.is_empty() {
            return Self::none(VertexClass::Hidden);
        }
        let points: Vec<DVec3> = whole.into_iter().filter(keep).collect();
        if points.is_empty() {
            return Self::none(VertexClass::Unreflected);
        }
        Self {
            class: VertexClass::Reflected,
            points,
        }
    }
}

/// All points of the mirror at which `eye` sees `vertex` reflected, occlusion-free.
///
/// # Errors
/// For mesh mirrors. Of a single vertex that cannot be decided, the class is
/// [`VertexClass::Unknown`].
pub fn reflection_points(
    shape: &Shape,
    eye: DVec3,
    vertex: DVec3,
) -> Result<Solutions, NotAvailable> {
    match shape {
        Shape::Sphere { center, radius } => Ok(sphere::outside(*center, *radius, eye, vertex)),
        Shape::Bowl {
            center,
            radius,
            axis,
            half_angle,
        } => {
            let solutions = sphere::inside(*center, *radius, *axis, *half_angle, eye, vertex);
            Ok(match solutions.class {
                VertexClass::Unreflected if !seen(shape, eye)(vertex) => {
                    Solutions::none(VertexClass::Hidden)
                }
                _ => solutions,
            })
        }
        Shape::Ellipsoid {
            center,
            radii,
            rotation,
        } => Ok(ellipsoid::outside(*center, *radii, *rotation, eye, vertex)),
        Shape::Plane {
            center,
            normal,
            up,
            size,
        } => {
            let (eye_height, vertex_height) =
                ((eye - center).dot(*normal), (vertex - center).dot(*normal));
            if eye_height <= 0.0 || vertex_height <= 0.0 {
                return Ok(Solutions::none(VertexClass::Hidden));
            }
            // Where the line from the eye to the mirror image crosses the plane.
            let share = eye_height / (eye_height + vertex_height);
            let foot = |point: DVec3, height: f64| point - height * normal;
            let point = foot(eye, eye_height).lerp(foot(vertex, vertex_height), share);
            let right = up.cross(*normal);
            Ok(Solutions::within(vec![point], |point| {
                let offset = point - center;
                offset.dot(right).abs() <= size.x / 2.0 && offset.dot(*up).abs() <= size.y / 2.0
            }))
        }
        Shape::Torus {
            center,
            axis,
            major,
            minor,
        } => {
            let patch = patch::Torus {
                center: *center,
                axis: *axis,
                major: *major,
                minor: *minor,
            };
            let solutions = stationary::reflection_points(&patch, eye, vertex, seen(shape, eye));
            Ok(match solutions.class {
                VertexClass::Unreflected => Solutions::none(VertexClass::Hidden),
                _ => solutions,
            })
        }
        Shape::Saddle {
            center,
            normal,
            up,
            size,
            curvature,
        } => {
            let patch = patch::Saddle {
                center: *center,
                frame: DMat3::from_cols(up.cross(*normal), *up, *normal),
                half: *size / 2.0,
                curvature: *curvature,
            };
            Ok(stationary::reflection_points(
                &patch,
                eye,
                vertex,
                seen(shape, eye),
            ))
        }
        Shape::Mesh(_) => Err(mesh()),
    }
}

/// Whether a mirror does not hide a point, of its surface or behind it, from the eye.
fn seen(shape: &Shape, eye: DVec3) -> impl Fn(DVec3) -> bool {
    /// Share of a mirror's extent by which something hides before it counts as before.
    const BEFORE: f64 = 1e-6;
    let (low, high) = shape.bounds();
    let margin = BEFORE * (high - low).length();
    move |point| {
        let offset = point - eye;
        let first = shape.intersect(eye, offset.normalize(), 0.0);
        first.is_none_or(|hit| hit.t > offset.length() - margin)
    }
}

/// The exact answer for every (mirror, object vertex) pair: mirrors outer, then objects, then
/// the objects' unique positions, all in scene order. The answer for mirror `m`, object `o`,
/// vertex `v` is at `m · scene.vertex_count()` + the positions of all objects before `o` + `v`.
///
/// Beside an analytic mirror, the answers for a mesh are [`VertexClass::Unknown`].
///
/// # Errors
/// If no mirror has exact answers ([`reflection_points`]).
pub fn true_vertices(scene: &Scene, view: &View) -> Result<Vec<TrueVertex>, NotAvailable> {
    let analytic = |mirror: &Mirror| mirror.shape.is_analytic();
    if !scene.mirrors.iter().any(analytic) {
        return Err(mesh());
    }
    let positions: Vec<DVec3> = scene
        .objects
        .iter()
        .flat_map(|object| &object.mesh.positions)
        .map(|position| position.as_dvec3())
        .collect();
    let (mirrors, count) = (&scene.mirrors, positions.len());
    (0..mirrors.len() * count)
        .into_par_iter()
        .with_min_len(64)
        .map(|index| {
            let (mirror, vertex) = (&mirrors[index / count], positions[index % count]);
            let solutions = match analytic(mirror) {
                true => reflection_points(&mirror.shape, view.eye, vertex)?,
                false => Solutions::none(VertexClass::Unknown),
            };
            let project = |point: DVec3| (point, view.project(point).map(|(at, _)| at));
            Ok(TrueVertex {
                class: solutions.class,
                points: solutions.points.into_iter().map(project).collect(),
            })
        })
        .collect()
}

/// Image coordinates of those solutions that lie in view: they project into the image, onto a
/// pixel whose first surface is the reflecting side of mirror `mirror_id`. None where the frame
/// carries only colour.
pub fn points_in_view<'a>(
    vertex: &'a TrueVertex,
    frame: &'a Frame,
    mirror_id: u32,
) -> impl Iterator<Item = DVec2> + 'a {
    let [width, height] = frame.color.size();
    vertex
        .points
        .iter()
        .filter_map(|(_, at)| *at)
        .filter(move |at| {
            let inside =
                at.x >= 0.0 && at.y >= 0.0 && at.x < f64::from(width) && at.y < f64::from(height);
            let (Some(primary), true) = (&frame.primary, inside) else {
                return false;
            };
            let (x, y) = (at.x as u32, at.y as u32);
            let back = |status: &Status| *status == Status::Back;
            *primary.id.at(x, y) == mirror_id
                && !frame
                    .reflected
                    .as_ref()
                    .is_some_and(|reflected| back(reflected.status.at(x, y)))
        })
}

/// True where the vertex has at least one solution in view ([`points_in_view`]).
pub fn in_view(vertex: &TrueVertex, frame: &Frame, mirror_id: u32) -> bool {
    points_in_view(vertex, frame, mirror_id).next().is_some()
}

fn mesh() -> NotAvailable {
    NotAvailable("a mesh mirror has interpolated normals, which belong to no exact surface".into())
}
