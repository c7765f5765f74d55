//! Exact reflection points of vertices, in f64, without a search over pixels.
//!
//! A point `R` of a mirror reflects vertex `V` to eye `O` where the bisector of the directions to both
//! is the normal `N` of the reflecting side, and both lie in front: `N·(O−R) > 0` and `N·(V−R) > 0`.
//! Occlusion is not considered, neither by objects nor by the mirror itself (the outside of a bowl may
//! well hide its inside). The only exception is the eye's view of a torus, a saddle or a mesh, where
//! one part of the front may hide another.
//!
//! Each shape has a file of its own, named as in `scene::shape`, and a line in the function `exact`:
//! - sphere and bowl: the roots of Alhazen's quartic, all of them (`alhazen`);
//! - plane: the mirror image;
//! - ellipsoid: the minimum of a convex function;
//! - torus and saddle: all stationary points, by dividing the surface until each part is settled
//!   (`stationary`);
//! - mesh: the points whose interpolated normal reflects the eye's ray into the vertex, all of them, by
//!   dividing the triangles that a hierarchy leaves (`mesh`).
//!
//! Regions are those of Estalella et al., "Accurate Interactive Specular Reflections on Curved
//! Objects", VMV 2005, §6.1. World space throughout.

mod alhazen;
mod bowl;
mod ellipsoid;
mod focal;
mod mesh;
mod patch;
mod plane;
mod quartic;
mod saddle;
mod solutions;
mod sphere;
mod stationary;
mod torus;

use std::sync::atomic::{AtomicUsize, Ordering};

use catoptric_frame::{Frame, Status, TrueVertex, VertexClass};
use catoptric_scene::{Scene, Shape, View};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use self::mesh::MeshPoints;
use self::solutions::ExactPoints;
pub use self::solutions::Solutions;
use crate::error::NotAvailable;

/// A shape's exact solver, if it has one: a line for each. A mesh is made ready for the eye.
fn exact(shape: &Shape, eye: DVec3) -> Result<Box<dyn ExactPoints + '_>, NotAvailable> {
    Ok(match shape {
        Shape::Sphere(sphere) => Box::new(sphere),
        Shape::Ellipsoid(ellipsoid) => Box::new(ellipsoid),
        Shape::Plane(plane) => Box::new(plane),
        Shape::Bowl(bowl) => Box::new(bowl),
        Shape::Torus(torus) => Box::new(torus),
        Shape::Saddle(saddle) => Box::new(saddle),
        other => match other.as_mesh() {
            Some(mesh) => Box::new(MeshPoints::new(mesh, eye)),
            None => {
                let why = format!("they are not known of a {}", other.name());
                return Err(NotAvailable(why));
            }
        },
    })
}

/// All points of the mirror at which `eye` sees `vertex` reflected, occlusion-free.
///
/// A mesh is made ready for the eye at each call: for many vertices ask [`reflections`].
///
/// # Errors
/// For shapes without exact points. Of a single vertex that cannot be decided, the class is
/// [`VertexClass::Unknown`].
pub fn reflection_points(
    shape: &Shape,
    eye: DVec3,
    vertex: DVec3,
) -> Result<Solutions, NotAvailable> {
    Ok(exact(shape, eye)?.points(eye, vertex))
}

/// As [`reflection_points`], for many vertices and one eye.
///
/// # Errors
/// For shapes without exact points.
pub fn reflections(
    shape: &Shape,
    eye: DVec3,
) -> Result<impl Fn(DVec3) -> Solutions + Sync + '_, NotAvailable> {
    let exact = exact(shape, eye)?;
    Ok(move |vertex| exact.points(eye, vertex))
}

/// The exact answer for every (mirror, object vertex) pair: mirrors outer, then objects, then
/// the objects' unique positions, all in scene order. The answer for mirror `m`, object `o`,
/// vertex `v` is at `m · scene.vertex_count()` + the positions of all objects before `o` + `v`.
///
/// Beside a mirror that has exact answers, those for one that has none are
/// [`VertexClass::Unknown`].
///
/// # Errors
/// If no mirror has exact answers ([`reflection_points`]).
pub fn true_vertices(scene: &Scene, view: &View) -> Result<Vec<TrueVertex>, NotAvailable> {
    true_vertices_watched(scene, view, &|_, _| ())
}

/// As [`true_vertices`], and reports now and then how many of all answers are found: those of a finely
/// triangulated mesh mirror take minutes.
///
/// # Errors
/// As [`true_vertices`].
pub fn true_vertices_watched(
    scene: &Scene,
    view: &View,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<TrueVertex>, NotAvailable> {
    let mirrors: Vec<_> = scene
        .mirrors
        .iter()
        .map(|mirror| exact(&mirror.shape, view.eye))
        .collect();
    if mirrors.iter().all(Result::is_err) {
        let first = mirrors.into_iter().find_map(Result::err);
        return Err(first.unwrap_or_else(|| NotAvailable("there is no mirror".into())));
    }
    let positions: Vec<DVec3> = scene
        .objects
        .iter()
        .flat_map(|object| &object.mesh.positions)
        .map(|position| position.as_dvec3())
        .collect();
    let count = positions.len();
    let all = mirrors.len() * count;
    let finished = AtomicUsize::new(0);
    let answers = (0..all)
        .into_par_iter()
        .with_min_len(64)
        .map(|index| {
            let before = finished.fetch_add(1, Ordering::Relaxed);
            if before.is_multiple_of(64) {
                progress(before, all);
            }
            let vertex = positions[index % count];
            let solutions = match &mirrors[index / count] {
                Ok(mirror) => mirror.points(view.eye, vertex),
                Err(_) => Solutions::none(VertexClass::Unknown),
            };
            let project = |point: DVec3| (point, view.project(point).map(|(at, _)| at));
            let shape = &scene.mirrors[index / count].shape;
            let focal = solutions.points.iter();
            let focal = focal.map(|point| focal::before(shape, view.eye, *point, vertex));
            TrueVertex {
                class: solutions.class,
                undecided: solutions.undecided,
                focal: focal.collect(),
                points: solutions.points.into_iter().map(project).collect(),
            }
        })
        .collect();
    Ok(answers)
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
