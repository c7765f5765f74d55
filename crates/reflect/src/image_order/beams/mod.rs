//! Beams: the exact reflection on any mirror, without a hierarchy over the scene. They are the image-order counterpart
//! of swept boxes. Roger et al. 2007 is related: it streams triangles down a hierarchy of cones.
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
//! With `bounces` mirrors are seen in mirrors: the hierarchy is built again over the second rays (`paths.rs`).
//!
//! Work is counted over all rays of a path: a node test is one of a box of a cluster or a triangle against a node, an
//! evaluation is a test of a ray against a triangle.

mod clusters;
pub mod embed;
mod geometry;
mod lists;
mod mirrors;
mod paths;
mod pyramid;
mod settings;
mod shade;
mod source;
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
use crate::stage::extent::diagonal;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named};

use geometry::Geometry;
use lists::{Lists, Wanted};
use mirrors::Mirrors;
use paths::{Paths, RayImages};
use pyramid::Pyramid;
use shade::Shade;
use source::Source;
use tile::Tile;

options! {
    pub(crate) struct Beams {
        /// pixels along the side of the smallest nodes, whose pixels test their triangles one by one
        tile: Tile,
        /// most reflections on a path: with more than 1, mirrors are seen in mirrors
        bounces: u32 = 1 in 1..=16,
    }
}

impl Named for Beams {
    const INFO: Info = Info {
        name: "beams",
        what: "triangles sent down a hierarchy over the rays, exact",
        paper: "this project",
    };
}

impl Recipe for Beams {
    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError> {
        Ok(Box::new(Ready::new(
            gpu,
            stage,
            Wanted {
                tile: self.tile,
                room: lists::ROOM,
                reflections: self.bounces,
            },
        )?))
    }
}

/// The technique, ready for a scene.
struct Ready {
    source: Source,
    pyramid: Pyramid,
    geometry: Geometry,
    lists: Lists,
    seen: Seen,
}

/// What is done with the hits of the rays.
enum Seen {
    /// It is shown.
    First(Shade),
    /// Mirrors reflect it.
    Paths(Box<(Mirrors, Paths)>),
}

impl Ready {
    fn new(gpu: &Gpu, stage: &Stage, wanted: Wanted) -> Result<Self, ReflectError> {
        let more = wanted.reflections > 1;
        let mirrors = more.then(|| Mirrors::new(gpu, stage));
        let images = more.then(|| RayImages::new(gpu, stage));
        let (images, source) = images.unzip();
        let source = source.unwrap_or_else(|| Source::of_gbuffer(stage));
        let pyramid = Pyramid::new(gpu, &source)?;
        let geometry = Geometry::new(gpu, stage, mirrors.as_ref())?;
        let extent = diagonal(&stage.world.scene);
        let lists = Lists::new(gpu, &source, (&pyramid, &geometry), extent, wanted)?;
        let seen = match mirrors.zip(images) {
            None => Seen::First(Shade::new(gpu, stage, &lists)?),
            Some((mirrors, images)) => {
                let of = (stage, &lists, &mirrors);
                let paths = Paths::new(gpu, of, (&images, &source), wanted.reflections)?;
                Seen::Paths(Box::new((mirrors, paths)))
            }
        };
        gpu.check()?;
        Ok(Self {
            source,
            pyramid,
            geometry,
            lists,
            seen,
        })
    }

    /// Records the passes that find what the rays after so many reflections of each path meet; `met` records
    /// what comes after each slice.
    fn record_rays(
        &self,
        frame: &mut Recorder<'_>,
        variant: Variant,
        reflections: usize,
        met: impl Fn(&mut Recorder<'_>, usize),
    ) {
        self.pyramid.record(frame, &self.source, reflections);
        if reflections == 0 {
            self.geometry.record(frame);
        }
        for slice in 0..self.lists.slices() {
            let part = (reflections, slice);
            self.lists.record(frame, &self.source, part, variant);
            met(frame, slice);
        }
    }
}

impl ImageOrder for Ready {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        self.geometry.update(gpu, stage);
        let extent = diagonal(&stage.world.scene);
        self.lists.update(gpu, extent, &self.geometry);
        if let Seen::Paths(more) = &self.seen {
            let (mirrors, paths) = &**more;
            mirrors.update(gpu, &stage.world.scene);
            paths.update(gpu, stage);
        }
        Ok(())
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        match &self.seen {
            Seen::First(shade) => self.record_rays(frame, variant, 0, |frame, slice| {
                shade.record(frame, stage, slice, variant);
            }),
            Seen::Paths(more) => {
                let (_, paths) = &**more;
                paths.record_first(frame, stage);
                for reflections in 0..paths.reflections {
                    self.record_rays(frame, variant, reflections, |frame, slice| {
                        paths.record(frame, &self.source, slice, reflections);
                    });
                }
                paths.record_shade(frame, stage, &self.source, variant);
            }
        }
    }

    fn paths(&self, gpu: &Gpu) -> Option<Vec<[f32; 4]>> {
        match &self.seen {
            Seen::First(_) => None,
            Seen::Paths(more) => Some(more.1.read(gpu)),
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
