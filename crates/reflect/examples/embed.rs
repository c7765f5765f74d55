//! A small renderer of its own that shows exact reflections by [`catoptric_reflect::embed`]: a mirror ball over a
//! floor with two coloured pyramids, drawn into a texture without a window.
//!
//! `cargo run --release --example embed -- ball.ppm` writes the picture. What an application does already
//! is in [`Renderer`]; what beams add is marked with "beams:". Copied into a project of its own, this file needs
//! `catoptric-reflect`, which hands on its `wgpu`, `bytemuck` and `pollster`.

use catoptric_reflect::{embed, wgpu};
use wgpu::util::DeviceExt;

/// Where the eye is, world space; it looks along −z.
pub const EYE: [f32; 3] = [0.0, 0.9, 4.2];

/// Tangents of half the field of view, x and y.
pub const TANGENTS: [f32; 2] = [0.48, 0.36];

/// The mirror ball.
pub const BALL: ([f32; 3], f32) = ([0.0, 0.7, 0.0], 0.7);

/// What is seen where nothing is, linear RGB.
pub const SKY: [f32; 3] = [0.10, 0.18, 0.40];

/// A vertex: world-space position, linear RGB.
pub type Vertex = [f32; 6];

/// The triangles: a floor of 16 × 16 cells, and pyramids.
pub fn triangles() -> (Vec<Vertex>, Vec<[u32; 3]>) {
    const CELLS: u32 = 16;
    let (mut vertices, mut indices): (Vec<Vertex>, Vec<[u32; 3]>) = (Vec::new(), Vec::new());
    let mut triangle = |corners: [[f32; 3]; 3], color: [f32; 3]| {
        let first = vertices.len() as u32;
        indices.push([first, first + 1, first + 2]);
        let [r, g, b] = color;
        vertices.extend(corners.map(|[x, y, z]| [x, y, z, r, g, b]));
    };
    for cell in 0..CELLS * CELLS {
        let (column, row) = (cell % CELLS, cell / CELLS);
        let at = |dx: u32, dz: u32| {
            let place = |index: u32| index as f32 / CELLS as f32 * 8.0 - 4.0;
            [place(column + dx), 0.0, place(row + dz)]
        };
        let color = match (column + row) % 2 {
            0 => [0.75, 0.70, 0.60],
            _ => [0.20, 0.16, 0.14],
        };
        triangle([at(0, 0), at(0, 1), at(1, 1)], color);
        triangle([at(0, 0), at(1, 1), at(1, 0)], color);
    }
    for ([x, z], color) in [
        ([-1.1, 0.9], [0.8, 0.2, 0.1]),
        ([1.0, 1.2], [0.1, 0.5, 0.3]),
    ] {
        let base = [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], [-0.3, 0.3]];
        let base = base.map(|[dx, dz]: [f32; 2]| [x + dx, 0.0, z + dz]);
        for side in 0..4 {
            let shade = 0.55 + 0.15 * side as f32;
            let corners = [base[side], base[(side + 1) % 4], [x, 0.8, z]];
            triangle(corners, color.map(|part: f32| part * shade));
        }
    }
    (vertices, indices)
}

/// The G-buffer pass draws triangles and the ball; the picture's pass shades them.
const SHADER: &str = r"
struct Eye {
    position: vec3f,
    tan_x: f32,
    sky: vec3f,
    tan_y: f32,
    ball: vec4f,
    size: vec2f,
}
@group(0) @binding(0) var<uniform> eye: Eye;

struct Surface {
    @builtin(position) clip: vec4f,
    @location(0) color: vec3f,
}
// A mirror's point and normal; elsewhere nothing, and the colour with w 1.
struct GBuffer {
    @location(0) position: vec4f,
    @location(1) normal: vec4f,
    @builtin(frag_depth) depth: f32,
}

const NEAR: f32 = 0.01;

fn direction_of(pixel: vec2f) -> vec3f {
    let at = 2.0 * pixel / eye.size - 1.0;
    return normalize(vec3f(at.x * eye.tan_x, -at.y * eye.tan_y, -1.0));
}

@vertex
fn surface(@location(0) position: vec3f, @location(1) color: vec3f) -> Surface {
    let from_eye = position - eye.position;
    let clip = vec4f(from_eye.x / eye.tan_x, from_eye.y / eye.tan_y, NEAR, -from_eye.z);
    return Surface(clip, color);
}

@fragment
fn object(in: Surface) -> GBuffer {
    return GBuffer(vec4f(), vec4f(in.color, 1.0), in.clip.z);
}

@vertex
fn everywhere(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn ball(@builtin(position) pixel: vec4f) -> GBuffer {
    let direction = direction_of(pixel.xy);
    let from_center = eye.position - eye.ball.xyz;
    let middle = -dot(from_center, direction);
    let closest = from_center + middle * direction;
    let square = eye.ball.w * eye.ball.w - dot(closest, closest);
    if square < 0.0 {
        discard;
    }
    let normal = normalize(closest - sqrt(square) * direction);
    let position = eye.ball.xyz + eye.ball.w * normal;
    // beams: w above 0 says that the pixel shows a mirror.
    return GBuffer(vec4f(position, 1.0), vec4f(normal, 0.0), NEAR / (eye.position.z - position.z));
}

@group(1) @binding(0) var seen_normal: texture_2d<f32>;
@group(1) @binding(1) var seen_position: texture_2d<f32>;
@group(1) @binding(2) var hits: texture_2d<u32>;
@group(1) @binding(3) var<storage, read> vertices: array<f32>;
@group(1) @binding(4) var<storage, read> indices: array<u32>;

fn color_of(vertex: u32) -> vec3f {
    let first = 6u * vertex + 3u;
    return vec3f(vertices[first], vertices[first + 1u], vertices[first + 2u]);
}

@fragment
fn picture(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    let color = textureLoad(seen_normal, texel, 0);
    if textureLoad(seen_position, texel, 0).w == 0.0 {
        return vec4f(select(eye.sky, color.xyz, color.w > 0.0), 1.0);
    }
    // beams: what the pixel's reflected ray meets.
    let hit = textureLoad(hits, texel, 0);
    if hit.y == 0xffffffffu {
        return vec4f(eye.sky, 1.0);
    }
    let two = bitcast<vec2f>(hit.zw);
    let first = 3u * hit.y;
    let reflected = two.x * color_of(indices[first]) + two.y * color_of(indices[first + 1u])
        + (1.0 - two.x - two.y) * color_of(indices[first + 2u]);
    return vec4f(reflected, 1.0);
}
";

const LINEAR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// What an application has: a device, its geometry, its G-buffer and its pipelines.
struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
    position: wgpu::Texture,
    normal: wgpu::Texture,
    depth: wgpu::Texture,
    picture: wgpu::Texture,
    object: wgpu::RenderPipeline,
    ball: wgpu::RenderPipeline,
    shade: wgpu::RenderPipeline,
    eye: wgpu::BindGroup,
    seen_layout: wgpu::BindGroupLayout,
}

impl Renderer {
    fn new(device: wgpu::Device, queue: wgpu::Queue, size: [u32; 2]) -> Self {
        let (vertices, indices) = triangles();
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents,
                usage,
            })
        };
        // beams: the vertices are read as storage, too.
        let storage = wgpu::BufferUsages::STORAGE;
        let of_vertices = storage | wgpu::BufferUsages::VERTEX;
        let of_indices = storage | wgpu::BufferUsages::INDEX;
        let vertex_buffer = buffer(bytemuck::cast_slice(&vertices), of_vertices);
        let index_buffer = buffer(bytemuck::cast_slice(&indices), of_indices);
        let texture = |format, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width: size[0],
                    height: size[1],
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let numbers = buffer(
            bytemuck::cast_slice(&eye_numbers(size)),
            wgpu::BufferUsages::UNIFORM,
        );
        let eye_layout = layout(&device, &[uniform()]);
        let seen = [color(true), color(true), color(false), list(), list()];
        let seen_layout = layout(&device, &seen);
        let pipelines = Pipelines::new(&device, [&eye_layout, &seen_layout]);
        let read = wgpu::TextureUsages::TEXTURE_BINDING;
        Self {
            position: texture(LINEAR, read),
            normal: texture(LINEAR, read),
            depth: texture(DEPTH, wgpu::TextureUsages::empty()),
            picture: texture(LINEAR, wgpu::TextureUsages::COPY_SRC),
            index_count: indices.len() as u32 * 3,
            vertices: vertex_buffer,
            indices: index_buffer,
            object: pipelines.make("surface", "object", 2),
            ball: pipelines.make("everywhere", "ball", 2),
            shade: pipelines.make("everywhere", "picture", 1),
            eye: group(&device, &eye_layout, &[numbers.as_entire_binding()]),
            seen_layout,
            device,
            queue,
        }
    }

    /// A frame: the G-buffer, what the mirror reflects, and the picture.
    fn draw(&self, beams: &embed::Beams) {
        let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let targets = [&self.position, &self.normal].map(view);
        let depth = view(&self.depth);
        {
            let mut pass = begin(&mut encoder, &targets, Some(&depth));
            pass.set_bind_group(0, &self.eye, &[]);
            pass.set_pipeline(&self.object);
            pass.set_vertex_buffer(0, self.vertices.slice(..));
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..self.index_count, 0, 0..1);
            pass.set_pipeline(&self.ball);
            pass.draw(0..3, 0..1);
        }
        // beams: between the pass that draws the G-buffer and the one that shades.
        beams.record(&mut encoder, EYE);
        let [normal, position, hits] = [&self.normal, &self.position, beams.hits()].map(view);
        let seen = [
            wgpu::BindingResource::TextureView(&normal),
            wgpu::BindingResource::TextureView(&position),
            wgpu::BindingResource::TextureView(&hits),
            self.vertices.as_entire_binding(),
            self.indices.as_entire_binding(),
        ];
        let seen = group(&self.device, &self.seen_layout, &seen);
        {
            let mut pass = begin(&mut encoder, &[view(&self.picture)], None);
            pass.set_bind_group(0, &self.eye, &[]);
            pass.set_bind_group(1, &seen, &[]);
            pass.set_pipeline(&self.shade);
            pass.draw(0..3, 0..1);
        }
        self.queue.submit([encoder.finish()]);
    }

    /// The picture, rows from the top, linear RGB and 1.
    fn read(&self) -> Vec<[f32; 4]> {
        let (width, height) = (self.picture.width(), self.picture.height());
        let row = (16 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: Some(height),
                },
            },
            self.picture.size(),
        );
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("mapped"));
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        waited.expect("the device works");
        let mapped = buffer.get_mapped_range(..).expect("mapped");
        let bytes = mapped.to_vec();
        let rows = bytes.chunks_exact(row as usize);
        let texels = rows.flat_map(|row| row[..16 * width as usize].chunks_exact(16));
        texels.map(bytemuck::pod_read_unaligned).collect()
    }
}

/// As the shader's `Eye` has them.
fn eye_numbers(size: [u32; 2]) -> [f32; 16] {
    let ([x, y, z], radius) = BALL;
    let [tan_x, tan_y] = TANGENTS;
    let [width, height] = size.map(|side| side as f32);
    let ([eye_x, eye_y, eye_z], [red, green, blue]) = (EYE, SKY);
    [
        eye_x, eye_y, eye_z, tan_x, red, green, blue, tan_y, x, y, z, radius, width, height, 0.0,
        0.0,
    ]
}

fn uniform() -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn list() -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only: true },
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

/// A texture of floats, or else of whole numbers.
fn color(floats: bool) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: match floats {
            true => wgpu::TextureSampleType::Float { filterable: false },
            false => wgpu::TextureSampleType::Uint,
        },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}

fn layout(device: &wgpu::Device, types: &[wgpu::BindingType]) -> wgpu::BindGroupLayout {
    let entries = (0..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: *ty,
            count: None,
        });
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries.collect::<Vec<_>>(),
    })
}

fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry {
            binding,
            resource: resource.clone(),
        });
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries.collect::<Vec<_>>(),
    })
}

/// A pass that clears its targets.
fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    targets: &[wgpu::TextureView],
    depth: Option<&wgpu::TextureView>,
) -> wgpu::RenderPass<'e> {
    let attachments = targets.iter().map(|view| {
        Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                store: wgpu::StoreOp::Store,
            },
        })
    });
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &attachments.collect::<Vec<_>>(),
        depth_stencil_attachment: depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0.0),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

/// What makes pipelines.
struct Pipelines<'d> {
    device: &'d wgpu::Device,
    shader: wgpu::ShaderModule,
    /// Of the G-buffer's pass, and of the picture's.
    layouts: [wgpu::PipelineLayout; 2],
}

impl<'d> Pipelines<'d> {
    fn new(device: &'d wgpu::Device, [eye, seen]: [&wgpu::BindGroupLayout; 2]) -> Self {
        let layout = |groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        Self {
            shader: device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(SHADER.into()),
            }),
            layouts: [layout(&[Some(eye)]), layout(&[Some(eye), Some(seen)])],
            device,
        }
    }

    /// With so many colour targets; several of them go with a depth.
    fn make(&self, vertex: &str, fragment: &str, colors: usize) -> wgpu::RenderPipeline {
        let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
        let vertices = [Some(wgpu::VertexBufferLayout {
            array_stride: 24,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes,
        })];
        let target = Some(wgpu::ColorTargetState {
            format: LINEAR,
            blend: None,
            write_mask: wgpu::ColorWrites::ALL,
        });
        let depth = wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        };
        let descriptor = wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: Some(&self.layouts[usize::from(colors == 1)]),
            vertex: wgpu::VertexState {
                module: &self.shader,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: if vertex == "surface" { &vertices } else { &[] },
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: (colors > 1).then_some(depth),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &self.shader,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &vec![target; colors],
            }),
            multiview_mask: None,
            cache: None,
        };
        self.device.create_render_pipeline(&descriptor)
    }
}

/// Draws the picture on a device and reads it back: rows from the top, linear RGB and 1.
///
/// # Errors
/// What the beams cannot take.
pub fn draw(
    device: wgpu::Device,
    queue: wgpu::Queue,
    size: [u32; 2],
) -> Result<Vec<[f32; 4]>, embed::Error> {
    let renderer = Renderer::new(device, queue, size);
    // beams: made once, for these triangles and textures.
    let (vertices, indices) = triangles();
    let positions: Vec<[f32; 3]> = vertices.iter().map(|[x, y, z, ..]| [*x, *y, *z]).collect();
    let triangles = embed::Triangles {
        positions: &positions,
        indices: &indices,
        vertices: &renderer.vertices,
        offset: 0,
        stride: 24,
    };
    let gbuffer = embed::GBuffer {
        position: &renderer.position,
        normal: &renderer.normal,
    };
    let beams = embed::Beams::new(&renderer.device, &renderer.queue, &triangles, gbuffer)?;
    renderer.draw(&beams);
    Ok(renderer.read())
}

/// A device with the default limits and no features; `None` where there is no adapter.
pub fn device() -> Option<(wgpu::Device, wgpu::Queue)> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(descriptor);
    let adapter = pollster::block_on(instance.request_adapter(&Default::default())).ok()?;
    pollster::block_on(adapter.request_device(&Default::default())).ok()
}

/// A picture as a file of the simplest format that viewers know.
fn ppm(picture: &[[f32; 4]], [width, height]: [u32; 2]) -> Vec<u8> {
    let mut file = format!("P6\n{width} {height}\n255\n").into_bytes();
    for [red, green, blue, _] in picture {
        let bytes = [red, green, blue].map(|part| (part.powf(1.0 / 2.2) * 255.0 + 0.5) as u8);
        file.extend(bytes);
    }
    file
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let size = [320, 240];
    let path = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "embed.ppm".to_owned());
    let (device, queue) = device().ok_or("there is no graphics adapter")?;
    let picture = draw(device, queue, size)?;
    std::fs::write(&path, ppm(&picture, size))?;
    println!("{path}: {} × {} pixels", size[0], size[1]);
    Ok(())
}
