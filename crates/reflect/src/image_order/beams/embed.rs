//! Beams in a renderer of one's own: exact reflections on its own device, from its own G-buffer, of its
//! own triangles, recorded into its own encoder.
//!
//! [`Beams`] answers one question: what does each mirror pixel's reflected ray meet? The answer is a texture with a
//! triangle, a distance and weights for each pixel; shading and materials are left to the renderer. Nothing is
//! approximated: the answer is a ray tracer's, without a hierarchy over the scene, so that triangles may move freely.
//!
//! 1. [`Beams::new`] takes the device, the triangles and the G-buffer. It reads the positions once, to group
//!    neighbouring triangles. The answers stay right whatever moves later, and the speed is kept while neighbours
//!    stay neighbours.
//! 2. In each frame the renderer draws its G-buffer and writes its vertices as it does anyway, calls
//!    [`Beams::record`], and reads [`Beams::hits`] in a later pass of the same encoder.
//!
//! The device needs nothing beyond [`wgpu::Limits::default`] and no feature. The wgpu in these signatures is
//! re-exported as [`wgpu`](crate::wgpu): with another version of it in the program the types do not fit.
//!
//! `examples/embed.rs` is a whole small renderer that does so.
//!
//! ```no_run
//! use catoptric_reflect::{embed, wgpu};
//!
//! # fn frame(device: &wgpu::Device, queue: &wgpu::Queue, vertices: &wgpu::Buffer,
//! #          position: &wgpu::Texture, normal: &wgpu::Texture) -> Result<(), embed::Error> {
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
//! let triangles = embed::Triangles {
//!     positions: &positions,
//!     indices: &[[0, 1, 2]],
//!     vertices, // where the same positions lie, 12 bytes from one to the next
//!     offset: 0,
//!     stride: 12,
//! };
//! let gbuffer = embed::GBuffer { position, normal };
//! let beams = embed::Beams::new(device, queue, &triangles, gbuffer)?;
//!
//! let mut encoder = device.create_command_encoder(&Default::default());
//! // … draw the G-buffer …
//! beams.record(&mut encoder, [0.0, 1.5, 4.0]);
//! // … shade with `beams.hits()` …
//! queue.submit([encoder.finish()]);
//! # Ok(())
//! # }
//! ```
//!
//! A shader reads the answer so:
//!
//! ```wgsl
//! @group(0) @binding(0) var hits: texture_2d<u32>;
//!
//! let hit = textureLoad(hits, pixel, 0);
//! if hit.y != 0xffffffffu {             // else the ray leaves the scene, or there is none
//!     let t = bitcast<f32>(hit.x);      // world units from the mirror's point
//!     let first_two = bitcast<vec2f>(hit.zw);
//!     let weights = vec3f(first_two, 1.0 - first_two.x - first_two.y);
//!     // Triangle hit.y of `indices`; its corners' attributes, times these weights, are those of the point.
//! }
//! ```

use glam::Vec3;
use thiserror::Error;

use super::clusters::of_triangles;
use super::geometry::{Geometry, Strided};
use super::lists::{self, Lists, Wanted};
use super::pyramid::Pyramid;
use super::source::Source;
use super::tile::Tile;
use crate::error::ReflectError;
use crate::gpu::{
    FLOAT4, Gpu, Kernel, Recorder, Slot, compute, group, layout, module, set_uniform,
    storage_zeros, target, texture_of_numbers, uniform, view,
};
use crate::stage::variant::Variant;

/// Most triangles.
const MOST: usize = 1 << 27;

/// The triangles that mirrors reflect, here and on the GPU.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// World-space positions of all vertices, as they are now.
    pub positions: &'a [[f32; 3]],
    /// Three vertices a triangle. Both sides are seen. These stay; a renderer whose triangles change makes new
    /// [`Beams`].
    pub indices: &'a [[u32; 3]],
    /// The same positions on the GPU, in the same order and in world space: x, y and z as `f32` somewhere
    /// in each vertex. Read in each frame, so that whatever writes them moves the triangles. With
    /// [`STORAGE`](wgpu::BufferUsages::STORAGE) among its usages.
    pub vertices: &'a wgpu::Buffer,
    /// Bytes before the first vertex' x; a multiple of 4.
    pub offset: u64,
    /// Bytes from one vertex to the next; a multiple of 4, at least 12.
    pub stride: u64,
}

/// What the eye sees of the mirrors. Two textures of one size, one texel a pixel, of formats that shaders read as
/// `f32` and that need not be filterable, with [`TEXTURE_BINDING`](wgpu::TextureUsages::TEXTURE_BINDING)
/// among their usages. Position in fewer than 32 bits a channel is too coarse: the rays start there.
#[derive(Clone, Copy, Debug)]
pub struct GBuffer<'a> {
    /// World-space position of the mirror's point in x, y, z; w above 0 where the pixel shows a mirror, any
    /// other number elsewhere.
    pub position: &'a wgpu::Texture,
    /// World-space normal of the mirror on its reflecting side, of any length; w is not read. Where the eye is on the
    /// other side, the pixel has no ray.
    pub normal: &'a wgpu::Texture,
}

/// Why there are no beams.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The two textures of the G-buffer are not alike.
    #[error("the G-buffer's textures differ in size: position {position:?}, normal {normal:?}")]
    Size {
        /// Width and height of the position.
        position: [u32; 2],
        /// Of the normal.
        normal: [u32; 2],
    },
    /// A texture or a buffer cannot be read.
    #[error("the {what} lacks the usage {usage}")]
    Usage {
        /// Which.
        what: &'static str,
        /// As wgpu calls it.
        usage: &'static str,
    },
    /// A triangle's vertex is not among the positions.
    #[error("triangle {triangle} has vertex {vertex}, but there are {vertices} positions")]
    Vertex {
        /// Its index.
        triangle: usize,
        /// The vertex.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// Vertices do not lie as whole numbers of 4 bytes.
    #[error("offset {offset} and stride {stride} must be multiples of 4, the stride at least 12")]
    Stride {
        /// As given.
        offset: u64,
        /// As given.
        stride: u64,
    },
    /// The buffer ends before the last vertex.
    #[error(
        "the vertices take {needed} bytes with this offset and stride, but the buffer has {size}"
    )]
    Buffer {
        /// Bytes to the end of the last one.
        needed: u64,
        /// Of the buffer.
        size: u64,
    },
    /// More triangles than can be told apart.
    #[error("{0} triangles are more than {MOST}")]
    Many(usize),
    /// What the device cannot hold.
    #[error(transparent)]
    Device(#[from] ReflectError),
}

/// Exact reflections of triangles in mirrors, on the caller's device. Rays are reflected once: mirrors show
/// triangles, and other mirrors only if their triangles are among these.
pub struct Beams {
    gpu: Gpu,
    source: Source,
    pyramid: Pyramid,
    geometry: Geometry,
    lists: Lists,
    eye: wgpu::Buffer,
    first: Kernel,
    first_group: wgpu::BindGroup,
    hits: Kernel,
    /// For all slices but the last.
    keep: Kernel,
    /// For the first slice, and for those after it.
    hits_groups: [wgpu::BindGroup; 2],
    texture: wgpu::Texture,
}

impl Beams {
    /// Puts neighbouring triangles together and makes what the passes need: pipelines, and buffers and textures for
    /// the G-buffer's size. After a change of that size, make new ones.
    ///
    /// # Errors
    /// Whatever does not fit: [`enum@Error`] says what was given and what would be right. What the device itself
    /// refuses, such as formats that are no floats, goes to its own error handler.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        triangles: &Triangles<'_>,
        gbuffer: GBuffer<'_>,
    ) -> Result<Self, Error> {
        check(triangles, gbuffer)?;
        let gpu = Gpu::given(device, queue);
        let beams = Self::made(gpu, triangles, gbuffer)?;
        beams.gpu.check().map_err(ReflectError::from)?;
        Ok(beams)
    }

    fn made(
        gpu: Gpu,
        triangles: &Triangles<'_>,
        gbuffer: GBuffer<'_>,
    ) -> Result<Self, ReflectError> {
        use Slot::{Image, Numbers, Read, Texture, Uniform, Write};
        let positions: Vec<Vec3> = triangles
            .positions
            .iter()
            .copied()
            .map(Vec3::from)
            .collect();
        let size = [gbuffer.position.width(), gbuffer.position.height()];
        let images =
            ["rays, origin", "rays, direction"].map(|label| target(&gpu, label, size, FLOAT4));
        let rays_layout = layout(&gpu, "rays", &[Texture; 2]);
        let views = images.each_ref().map(view);
        let resources = views.each_ref().map(wgpu::BindingResource::TextureView);
        let source = Source {
            size,
            feature: Some("rays"),
            view: None,
            rays: vec![group(&gpu, &rays_layout, &resources)],
            rays_layout,
        };
        let pyramid = Pyramid::new(&gpu, &source)?;
        let slots = of_triangles(&positions, triangles.indices);
        let strided = Strided {
            stride: (triangles.stride / 4) as u32,
            first: (triangles.offset / 4) as u32,
        };
        let geometry = Geometry::of_slots(&gpu, &slots, triangles.vertices, Some(strided), None)?;
        let wanted = Wanted {
            tile: Tile::Two,
            room: lists::ROOM,
            reflections: 1,
        };
        let extent = extent(&positions);
        let lists = Lists::new(&gpu, &source, (&pyramid, &geometry), extent, wanted)?;

        let eye = uniform(&gpu, &glam::Vec4::ZERO);
        let first_layout = layout(
            &gpu,
            "given rays",
            &[Uniform, Texture, Texture, Image, Image],
        );
        let given = [gbuffer.position, gbuffer.normal].map(view);
        let first_group = group(
            &gpu,
            &first_layout,
            &[
                eye.as_entire_binding(),
                wgpu::BindingResource::TextureView(&given[0]),
                wgpu::BindingResource::TextureView(&given[1]),
                wgpu::BindingResource::TextureView(&views[0]),
                wgpu::BindingResource::TextureView(&views[1]),
            ],
        );
        let first_module = module(&gpu, "beams/given", &[])?;

        let texture = texture_of_numbers(&gpu, "hits", size);
        let slices = lists.slices();
        let kept = 16 * u64::from(size[0]) * u64::from(size[1]);
        let nearest = storage_zeros(&gpu, if slices > 1 { kept } else { 0 });
        let hits_slots = [Numbers, Uniform, Read, Read, Write, Uniform];
        let hits_layout = layout(&gpu, "hits", &hits_slots);
        let hits_view = view(&texture);
        let hits_groups = [0_u32, 1].map(|has_nearest| {
            let has_nearest = uniform(&gpu, &has_nearest);
            let resources = [
                wgpu::BindingResource::TextureView(&hits_view),
                // Of a slot that `hits` does not read, so that the others are those of `nearest`.
                eye.as_entire_binding(),
                lists.parts_of_tiles.as_entire_binding(),
                lists.hits.as_entire_binding(),
                nearest.as_entire_binding(),
                has_nearest.as_entire_binding(),
            ];
            group(&gpu, &hits_layout, &resources)
        });
        let hits_module = module(&gpu, "beams/hits", &["rays"])?;
        let layouts = [None, Some(&source.rays_layout), None, Some(&hits_layout)];
        Ok(Self {
            first: compute(&gpu, &first_module, "rays", &[Some(&first_layout)]),
            first_group,
            hits: compute(&gpu, &hits_module, "hits", &layouts),
            keep: compute(&gpu, &hits_module, "keep", &layouts),
            hits_groups,
            texture,
            eye,
            lists,
            geometry,
            pyramid,
            source,
            gpu,
        })
    }

    /// Records the passes of a frame, after those that draw the G-buffer and write the vertices and before those that
    /// read [`Beams::hits`]. `eye`: world space; it is written to the queue at once, so that each frame's
    /// commands are to be submitted before the next one's are recorded.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, eye: [f32; 3]) {
        set_uniform(&self.gpu, &self.eye, &Vec3::from(eye).extend(1.0));
        Gpu::record_into(encoder, |frame| self.record_passes(frame));
    }

    fn record_passes(&self, frame: &mut Recorder<'_>) {
        frame.compute("rays", |pass| {
            pass.set_pipeline(&self.first);
            pass.set_bind_group(0, &self.first_group, &[]);
            let [x, y] = self.first.groups_over(self.source.size);
            pass.dispatch_workgroups(x, y, 1);
        });
        self.pyramid.record(frame, &self.source, 0);
        self.geometry.record(frame);
        for slice in 0..self.lists.slices() {
            self.lists
                .record(frame, &self.source, (0, slice), Variant::Color);
            let kernel = match slice + 1 < self.lists.slices() {
                true => &self.keep,
                false => &self.hits,
            };
            frame.compute("hits", |pass| {
                pass.set_pipeline(kernel);
                self.source.set(pass, 0);
                pass.set_bind_group(3, &self.hits_groups[usize::from(slice > 0)], &[]);
                let [x, y] = kernel.groups_over(self.source.size);
                pass.dispatch_workgroups(x, y, 1);
            });
        }
    }

    /// What the last recorded frame met, as large as the G-buffer, of format
    /// [`Rgba32Uint`](wgpu::TextureFormat::Rgba32Uint): the distance from the mirror's point along the
    /// reflected ray, world units; the index of the triangle among the given ones, or `0xffffffff` where
    /// there is no mirror or the ray meets nothing; the weights of the triangle's first two corners. Distance and
    /// weights are the bits of an `f32`.
    pub fn hits(&self) -> &wgpu::Texture {
        &self.texture
    }
}

/// What must hold before anything is made.
fn check(triangles: &Triangles<'_>, gbuffer: GBuffer<'_>) -> Result<(), Error> {
    let size = |texture: &wgpu::Texture| [texture.width(), texture.height()];
    let (position, normal) = (size(gbuffer.position), size(gbuffer.normal));
    if position != normal {
        return Err(Error::Size { position, normal });
    }
    for (what, texture) in [
        ("G-buffer's position", gbuffer.position),
        ("G-buffer's normal", gbuffer.normal),
    ] {
        if !texture
            .usage()
            .contains(wgpu::TextureUsages::TEXTURE_BINDING)
        {
            let usage = "TEXTURE_BINDING";
            return Err(Error::Usage { what, usage });
        }
    }
    let vertices = triangles.positions.len();
    let (offset, stride) = (triangles.offset, triangles.stride);
    if !offset.is_multiple_of(4) || !stride.is_multiple_of(4) || stride < 12 {
        return Err(Error::Stride { offset, stride });
    }
    if !triangles
        .vertices
        .usage()
        .contains(wgpu::BufferUsages::STORAGE)
    {
        let what = "buffer of vertices";
        let usage = "STORAGE";
        return Err(Error::Usage { what, usage });
    }
    let size = triangles.vertices.size();
    let last = (vertices as u64).saturating_sub(1);
    let needed = offset
        .saturating_add(last.saturating_mul(stride))
        .saturating_add(12);
    if vertices > 0 && needed > size {
        return Err(Error::Buffer { needed, size });
    }
    for (triangle, corners) in triangles.indices.iter().enumerate() {
        for vertex in *corners {
            if vertex as usize >= vertices {
                return Err(Error::Vertex {
                    triangle,
                    vertex,
                    vertices,
                });
            }
        }
    }
    match triangles.indices.len() {
        many if many > MOST => Err(Error::Many(many)),
        _ => Ok(()),
    }
}

/// The length that rounding is relative to: the diagonal of the box around all vertices and the origin.
fn extent(positions: &[Vec3]) -> f32 {
    let (low, high) = (positions.iter()).fold((Vec3::ZERO, Vec3::ZERO), |(low, high), position| {
        (low.min(*position), high.max(*position))
    });
    (high - low).length()
}
