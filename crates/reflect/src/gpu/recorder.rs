//! A frame being recorded: passes in order, each ended by a time stamp.

use super::device::Gpu;
use super::stamps::Stamps;
use super::textures::view;

/// What becomes of a target's contents when a pass begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Begin {
    /// All zeros: for depth, infinitely far.
    Clear,
    /// As earlier passes left them.
    Keep,
}

/// Records the passes of one frame.
pub(crate) struct Recorder<'a> {
    encoder: &'a mut wgpu::CommandEncoder,
    stamps: &'a mut Stamps,
}

impl<'a> Recorder<'a> {
    pub(super) fn new(encoder: &'a mut wgpu::CommandEncoder, stamps: &'a mut Stamps) -> Self {
        Self { encoder, stamps }
    }

    /// A raster pass. Passes of the same name are one line in the times.
    pub(crate) fn render(
        &mut self,
        name: &str,
        colors: &[&wgpu::TextureView],
        color_begin: Begin,
        depth: Option<(&wgpu::Texture, Begin)>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let attachments: Vec<_> = colors
            .iter()
            .map(|view| {
                Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: match color_begin {
                            Begin::Clear => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                            Begin::Keep => wgpu::LoadOp::Load,
                        },
                        store: wgpu::StoreOp::Store,
                    },
                })
            })
            .collect();
        let depth = depth.map(|(texture, begin)| (view(texture), begin));
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(name),
            color_attachments: &attachments,
            depth_stencil_attachment: depth.as_ref().map(|(view, begin)| {
                wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: Some(wgpu::Operations {
                        load: match begin {
                            Begin::Clear => wgpu::LoadOp::Clear(0.0),
                            Begin::Keep => wgpu::LoadOp::Load,
                        },
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }
            }),
            timestamp_writes: self.stamps.next(name).map(|(query_set, index)| {
                wgpu::RenderPassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: None,
                    end_of_pass_write_index: Some(index),
                }
            }),
            ..Default::default()
        });
        draw(&mut pass);
    }

    /// Builds an acceleration structure for ray queries. No pass of its own: it has no time.
    pub(crate) fn build_acceleration_structures(
        &mut self,
        blas: &wgpu::BlasBuildEntry<'_>,
        tlas: &wgpu::Tlas,
    ) {
        self.encoder.build_acceleration_structures([blas], [tlas]);
    }

    /// A compute pass. Passes of the same name are one line in the times.
    pub(crate) fn compute(
        &mut self,
        name: &str,
        dispatch: impl FnOnce(&mut wgpu::ComputePass<'_>),
    ) {
        let mut pass = self
            .encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(name),
                timestamp_writes: self.stamps.next(name).map(|(query_set, index)| {
                    wgpu::ComputePassTimestampWrites {
                        query_set,
                        beginning_of_pass_write_index: None,
                        end_of_pass_write_index: Some(index),
                    }
                }),
            });
        dispatch(&mut pass);
    }
}

impl Gpu {
    /// Records passes into an encoder, without times.
    pub(crate) fn record_into(
        encoder: &mut wgpu::CommandEncoder,
        record: impl FnOnce(&mut Recorder<'_>),
    ) {
        record(&mut Recorder::new(encoder, &mut Stamps::new(None)));
    }

    /// Records passes and submits them, without times.
    pub(crate) fn run(&self, record: impl FnOnce(&mut Recorder<'_>)) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        Self::record_into(&mut encoder, record);
        self.queue.submit([encoder.finish()]);
    }
}
