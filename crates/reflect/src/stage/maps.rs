//! The maps that searches on the image read: position and normal of one mirror at each pixel.
//!
//! Each mirror's maps are its own, and whole: Szabo 2013, Alg. 3.1, draws them of that mirror alone.
//! What stands before a mirror hides pixels of the picture, not texels of the search. A walk must not
//! end at the outline of an object: the reflection point may lie on its other side, or behind it.

use crate::error::ReflectError;
use crate::gpu::{Begin, DEPTH, Gpu, Recorder, target};
use crate::stage::gbuffer::GBuffer;
use crate::stage::world::World;

/// Maps of one mirror at a time, and the pass `maps` that draws them.
pub(crate) struct WholeMaps {
    pub gbuffer: GBuffer,
    depth: wgpu::Texture,
}

impl WholeMaps {
    pub(crate) fn new(gpu: &Gpu, world: &World) -> Result<Self, ReflectError> {
        Ok(Self {
            gbuffer: GBuffer::new(gpu, world)?,
            depth: target(gpu, "depth of a mirror alone", world.size, DEPTH),
        })
    }

    /// Draws a mirror (an index) as if nothing else were there.
    pub(crate) fn record(&self, frame: &mut Recorder<'_>, world: &World, mirror: usize) {
        let depth = (&self.depth, Begin::Clear);
        (self.gbuffer).record(frame, "maps", world, mirror..mirror + 1, depth);
    }
}
