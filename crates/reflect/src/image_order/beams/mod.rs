//! Beams: the exact reflection on any mirror, without a hierarchy over the scene. The image-order end of
//! swept boxes; related is Roger et al. 2007, who stream triangles down a hierarchy of cones.
//!
//! Each frame a hierarchy of boxes is made over the reflected rays of the mirror pixels (pass
//! `hierarchy`), and the triangles are put where they are now, in clusters of neighbours that were made
//! once (pass `refit`). Clusters are sent down to nodes of 32 × 32 pixels (pass `sift`), then clusters,
//! and at last their triangles, to leaves of a few pixels, where each pixel tests its ray against the
//! triangles that are left (pass `tiles`). The test and its ties are those of `ray-trace`, so the picture
//! is the ray tracer's, on mirrors of any shape and number, and whatever moves.
//!
//! No list can lose an entry: those of large nodes have room for all clusters that are sent down at a
//! time, and where there are more of these than the memory takes, they are sent down in slices
//! (`lists.rs`); those of a tile lie in a workgroup's memory, which has room for a batch of triangles.
//!
//! Counted: a node test is one of a box of a cluster or a triangle against a node, an evaluation a test of
//! a ray against a triangle.

mod clusters;
mod geometry;
mod lists;
mod pyramid;
mod settings;
mod shade;
mod tally;
#[cfg(test)]
mod tests;
mod tile;
#[cfg(test)]
mod twin;

use catoptric_frame::Work;

use super::{ImageOrder, Recipe};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::options::options;
use crate::stage::Stage;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named};

use geometry::Geometry;
use lists::Lists;
use pyramid::Pyramid;
use shade::Shade;
use tile::Tile;

options! {
    pub(crate) struct Beams {
        /// pixels along the side of the smallest nodes, whose pixels test their triangles one by one
        tile: Tile,
    }
}

impl Named for Beams {
    const INFO: Info = Info {
        name: "beams",
        what: "triangles sent down a hierarchy over the mirror's rays: exact on any mirror",
        paper: "this project",
    };
}

impl Recipe for Beams {
    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError> {
        Ok(Box::new(Ready::new(gpu, stage, self.tile, lists::ROOM)?))
    }
}

/// The technique, ready for a scene.
struct Ready {
    pyramid: Pyramid,
    geometry: Geometry,
    lists: Lists,
    shade: Shade,
}

impl Ready {
    /// `room`: most bytes of the lists of large nodes.
    fn new(gpu: &Gpu, stage: &Stage, tile: Tile, room: u64) -> Result<Self, ReflectError> {
        let pyramid = Pyramid::new(gpu, stage)?;
        let geometry = Geometry::new(gpu, stage)?;
        let lists = Lists::new(gpu, stage, (&pyramid, &geometry), tile, room)?;
        let shade = Shade::new(gpu, stage, &lists)?;
        gpu.check()?;
        Ok(Self {
            pyramid,
            geometry,
            lists,
            shade,
        })
    }
}

impl ImageOrder for Ready {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        self.geometry.update(gpu, stage);
        self.lists.update(gpu, stage, &self.geometry);
        Ok(())
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        self.pyramid.record(frame, stage);
        self.geometry.record(frame);
        for slice in 0..self.lists.slices() {
            self.lists.record(frame, stage, slice, variant);
            self.shade.record(frame, stage, slice, variant);
        }
    }

    fn work(&self, gpu: &Gpu, stage: &Stage) -> Work {
        let tally = self.lists.tally(gpu);
        let mirrors = gpu.read_texture(&stage.gbuffer.position);
        let pixels = mirrors.iter().filter(|texel| texel[3] > 0.0).count();
        let mean = |count: u64| (pixels > 0).then(|| count as f64 / pixels as f64);
        Work {
            node_tests: mean(tally.cluster_tests + tally.triangle_tests),
            cluster_tests: mean(tally.cluster_tests),
            evaluations: mean(tally.exact),
            pairs: mean(tally.pairs),
            longest_list: Some(tally.longest as f64),
            bytes: Some(tally.bytes as f64),
            ..Work::default()
        }
    }

    fn notes(&self, _: &Gpu, _: &Stage) -> Vec<String> {
        let slices = self.lists.slices();
        let sliced = format!(
            "the triangles are sent down in {slices} slices: the lists have room for no more at a time"
        );
        (slices > 1).then_some(sliced).into_iter().collect()
    }
}
