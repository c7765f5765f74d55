//! Exact reflection points.

use catoptric_frame::{Frame, TrueVertex, VertexClass};
use catoptric_scene::{Scene, Shape, View};
use glam::{DVec2, DVec3};

use crate::error::NotAvailable;

/// All reflection points of a vertex, whatever may stand in between.
#[derive(Clone, Debug, PartialEq)]
pub struct Solutions {
    /// Region the vertex lies in.
    pub class: VertexClass,
    /// World-space points; empty unless `class` is `Reflected`.
    pub points: Vec<DVec3>,
}

/// All points of the mirror at which `eye` sees `vertex` reflected, occlusion-free.
pub fn reflection_points(shape: &Shape, eye: DVec3, vertex: DVec3) -> Result<Solutions, NotAvailable> {
    todo!("{shape:?} {eye} {vertex}")
}

/// The exact answer for every (mirror, object vertex) pair: mirrors outer, then objects, then
/// the objects' unique positions, all in scene order.
pub fn true_vertices(scene: &Scene, view: &View) -> Result<Vec<TrueVertex>, NotAvailable> {
    todo!("{} {view:?}", scene.name)
}

/// Image coordinates of those solutions that lie in view: they project into the image, onto a
/// pixel whose first surface is the reflecting side of that mirror.
pub fn points_in_view<'a>(
    vertex: &'a TrueVertex,
    frame: &'a Frame,
    mirror_id: u32,
) -> impl Iterator<Item = DVec2> + 'a {
    let _ = (frame, mirror_id);
    vertex.points.iter().filter_map(|(_, at)| *at)
}

/// True where the vertex has at least one solution in view ([`points_in_view`]).
pub fn in_view(vertex: &TrueVertex, frame: &Frame, mirror_id: u32) -> bool {
    points_in_view(vertex, frame, mirror_id).next().is_some()
}
