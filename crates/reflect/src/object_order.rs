//! Object order: a reflection point for every vertex, then the triangles are drawn there
//! (Szabo 2013, Alg. 3.1): primary → mirror G-buffer → search → virtual triangles → composite.

use catoptric_frame::{
    Frame, Image, Name, Primary, Reflected, Status, Triangles, VertexResult, VertexState, Work,
};
use catoptric_scene::{Mesh, Scene, Shape};
use encase::{ShaderType, StorageBuffer, UniformBuffer, internal::WriteInto};
use glam::{DVec2, Vec2, Vec3};
use wgpu::util::DeviceExt;

use crate::gpu::Gpu;
use crate::shaders;
use crate::spec::Spec;
use crate::timing::{FrameTime, Timer};
use crate::uniforms::{Found, Geometry, MirrorUniform, SearchSettings, ViewUniform};
use crate::{Output, ReflectError};

const FLOAT4: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Steps after which a walk is given up, as a multiple of width + height; reaching it makes the
/// vertex fail.
const MAX_STEPS_PER_SIDE: u32 = 8;

struct Targets {
    color: wgpu::Texture,
    primary_color: wgpu::Texture,
    primary_position: wgpu::Texture,
    primary_normal: wgpu::Texture,
    mirror_position: wgpu::Texture,
    mirror_normal: wgpu::Texture,
    reflected_color: wgpu::Texture,
    reflected_position: wgpu::Texture,
    depth: wgpu::Texture,
    virtual_depth: wgpu::Texture,
}

struct MirrorDraw {
    id: u32,
    vertices: wgpu::Buffer,
    count: u32,
    analytic: bool,
    gbuffer: wgpu::BindGroup,
    nearest: wgpu::BindGroup,
    choose: wgpu::BindGroup,
    search: wgpu::BindGroup,
    counting: wgpu::BindGroup,
    virtual_color: wgpu::BindGroup,
    virtual_layers: wgpu::BindGroup,
    start: wgpu::Buffer,
    settings: wgpu::Buffer,
    search_settings: SearchSettings,
}

/// A search technique that stands ready for one scene and size.
pub struct Prepared<'g> {
    gpu: &'g Gpu,
    size: [u32; 2],
    names: Vec<Name>,
    /// `(object id, vertex)` of each position.
    places: Vec<(u32, u32)>,
    corners: u32,
    warm: bool,
    frames: u32,
    targets: Targets,
    mirrors: Vec<MirrorDraw>,
    found: wgpu::Buffer,
    work: wgpu::Buffer,
    primary: [(wgpu::RenderPipeline, Vec<wgpu::BindGroup>); 2],
    gbuffer: [(wgpu::RenderPipeline, wgpu::BindGroup); 2],
    nearest: (wgpu::ComputePipeline, wgpu::BindGroup),
    choose: (wgpu::ComputePipeline, wgpu::BindGroup),
    search: [(wgpu::ComputePipeline, wgpu::BindGroup); 2],
    raster: [(wgpu::RenderPipeline, Vec<wgpu::BindGroup>); 2],
    composite: (wgpu::RenderPipeline, Vec<wgpu::BindGroup>),
    timer: Timer,
}

fn uniform<T: ShaderType + WriteInto>(gpu: &Gpu, value: &T) -> wgpu::Buffer {
    let mut bytes = UniformBuffer::new(Vec::new());
    bytes.write(value).expect("writing to memory");
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: &bytes.into_inner(),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        })
}

fn storage_bytes(gpu: &Gpu, bytes: &[u8]) -> wgpu::Buffer {
    let empty = [0; 64];
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: if bytes.is_empty() { &empty } else { bytes },
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_DST
                | wgpu::BufferUsages::COPY_SRC,
        })
}

fn storage<T: ShaderType + encase::ShaderSize + WriteInto>(
    gpu: &Gpu,
    values: &Vec<T>,
) -> wgpu::Buffer {
    let mut bytes = StorageBuffer::new(Vec::new());
    bytes.write(values).expect("writing to memory");
    storage_bytes(
        gpu,
        if values.is_empty() {
            &[]
        } else {
            bytes.as_ref()
        },
    )
}

fn texture(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    let extra = if format == DEPTH {
        wgpu::TextureUsages::empty()
    } else {
        wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::TEXTURE_BINDING
    };
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | extra,
        view_formats: &[],
    })
}

fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&Default::default())
}

fn group(
    gpu: &Gpu,
    layout: wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry {
            binding,
            resource: resource.clone(),
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    })
}

fn module(gpu: &Gpu, program: &str, features: &[&str]) -> Result<wgpu::ShaderModule, ReflectError> {
    let text = shaders::link(program, features).map_err(ReflectError::Shader)?;
    Ok(gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(program),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        }))
}

fn compute(gpu: &Gpu, module: &wgpu::ShaderModule, entry: &str) -> wgpu::ComputePipeline {
    gpu.device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            cache: None,
        })
}

fn raster(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    entry: &str,
    targets: usize,
    depth: bool,
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
) -> wgpu::RenderPipeline {
    let color = Some(wgpu::ColorTargetState {
        format: FLOAT4,
        blend: None,
        write_mask: wgpu::ColorWrites::ALL,
    });
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(entry),
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers,
            },
            primitive: Default::default(),
            depth_stencil: depth.then(|| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets: &vec![color; targets],
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Position, shading normal and face normal of each corner, as the G-buffer pass reads them.
fn mirror_vertices(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    let mut corners = Vec::with_capacity(mesh.triangles.len() * 3);
    for (triangle, normals) in mesh.triangles.iter().zip(&mesh.normals) {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let face = (b - a).cross(c - a).normalize_or_zero();
        let face = if face.dot(normals[0] + normals[1] + normals[2]) < 0.0 {
            -face
        } else {
            face
        };
        corners.extend(
            [a, b, c]
                .into_iter()
                .zip(*normals)
                .map(|(position, normal)| [position, normal, face]),
        );
    }
    corners
}

/// Where a search starts, in image coordinates, before it is moved onto the mirror.
fn start_point(shape: &Shape, proxy: &Mesh, view: &catoptric_scene::View, bounds: bool) -> DVec2 {
    let middle = DVec2::new(f64::from(view.size[0]), f64::from(view.size[1])) / 2.0;
    let projected: Vec<_> = proxy
        .positions
        .iter()
        .filter_map(|p| view.project(p.as_dvec3()))
        .map(|(at, _)| at)
        .collect();
    let box_middle = || {
        let low = projected.iter().copied().reduce(DVec2::min)?;
        let high = projected.iter().copied().reduce(DVec2::max)?;
        Some((low + high) / 2.0)
    };
    let center = || view.project(shape.center()).map(|(at, _)| at);
    let start = if bounds {
        box_middle()
    } else {
        center().or_else(box_middle)
    };
    start
        .unwrap_or(middle)
        .clamp(DVec2::ZERO, middle * 2.0 - 1.0)
}

impl<'g> Prepared<'g> {
    pub(crate) fn new(
        gpu: &'g Gpu,
        spec: &Spec,
        scene: &Scene,
        size: [u32; 2],
    ) -> Result<Self, ReflectError> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        if size[0].max(size[1]) > limit || size[0].min(size[1]) == 0 {
            return Err(ReflectError::Size { size, limit });
        }
        let camera = scene.camera.view(size);
        let geometry = Geometry::new(scene);
        let vertices = geometry.positions.len() as u32;
        let largest = (geometry.corners.len() * 32)
            .max(geometry.texels.len() * 16)
            .max(vertices as usize * scene.mirrors.len() * 32) as u64;
        let limit = gpu.device.limits().max_storage_buffer_binding_size;
        if largest > limit {
            return Err(ReflectError::TooLarge {
                bytes: largest,
                limit,
            });
        }
        let view_buffer = uniform(
            gpu,
            &ViewUniform::new(scene, &camera, spec.option("under") == "dark"),
        );
        let positions = storage_bytes(gpu, bytemuck::cast_slice(&geometry.positions));
        let corners = storage(gpu, &geometry.corners);
        let materials = storage(gpu, &geometry.materials);
        let texels = storage_bytes(gpu, bytemuck::cast_slice(&geometry.texels));
        let records = u64::from(vertices) * scene.mirrors.len().max(1) as u64;
        let blank = |bytes: u64| storage_bytes(gpu, &vec![0; bytes as usize]);
        let found = blank(records * Found::min_size().get());
        let work = blank(records * 8);
        let targets = Targets {
            color: texture(gpu, "color", size, FLOAT4),
            primary_color: texture(gpu, "primary color", size, FLOAT4),
            primary_position: texture(gpu, "primary position", size, FLOAT4),
            primary_normal: texture(gpu, "primary normal", size, FLOAT4),
            mirror_position: texture(gpu, "mirror position", size, FLOAT4),
            mirror_normal: texture(gpu, "mirror normal", size, FLOAT4),
            reflected_color: texture(gpu, "reflected color", size, FLOAT4),
            reflected_position: texture(gpu, "reflected position", size, FLOAT4),
            depth: texture(gpu, "depth", size, DEPTH),
            virtual_depth: texture(gpu, "virtual depth", size, DEPTH),
        };
        let mirror_position = view(&targets.mirror_position);
        let mirror_normal = view(&targets.mirror_normal);
        let (position_view, normal_view) = (
            wgpu::BindingResource::TextureView(&mirror_position),
            wgpu::BindingResource::TextureView(&mirror_normal),
        );

        let primary_module = module(gpu, "primary", &[])?;
        let surface = [
            positions.as_entire_binding(),
            corners.as_entire_binding(),
            materials.as_entire_binding(),
            texels.as_entire_binding(),
        ];
        let color = raster(gpu, &primary_module, "color", 1, true, &[]);
        let color_groups = vec![
            group(
                gpu,
                color.get_bind_group_layout(0),
                &[view_buffer.as_entire_binding()],
            ),
            group(gpu, color.get_bind_group_layout(1), &surface),
        ];
        let layers = raster(gpu, &primary_module, "layers", 2, true, &[]);
        let layer_groups = vec![
            group(
                gpu,
                layers.get_bind_group_layout(0),
                &[view_buffer.as_entire_binding()],
            ),
            group(gpu, layers.get_bind_group_layout(1), &surface[..2]),
        ];

        let layout = wgpu::VertexBufferLayout {
            array_stride: 36,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3],
        };
        let gbuffer_module = module(gpu, "gbuffer", &[])?;
        let gbuffer = ["exact", "mesh"].map(|entry| {
            let pipeline = raster(
                gpu,
                &gbuffer_module,
                entry,
                2,
                true,
                &[Some(layout.clone())],
            );
            let group = group(
                gpu,
                pipeline.get_bind_group_layout(0),
                &[view_buffer.as_entire_binding()],
            );
            (pipeline, group)
        });
        let start_module = module(gpu, "start", &[])?;
        let [nearest, choose] = ["nearest", "choose"].map(|entry| {
            let pipeline = compute(gpu, &start_module, entry);
            let group = group(
                gpu,
                pipeline.get_bind_group_layout(0),
                &[view_buffer.as_entire_binding()],
            );
            (pipeline, group)
        });
        let mut features: Vec<&str> = Vec::new();
        if spec.option("residual") == "cross" {
            features.push("cross");
        }
        if spec.option("neighbours") == "8" {
            features.push("eight");
        }
        let searcher = |features: &[&str]| -> Result<_, ReflectError> {
            let pipeline = compute(gpu, &module(gpu, "linear", features)?, "search");
            let group = group(
                gpu,
                pipeline.get_bind_group_layout(0),
                &[view_buffer.as_entire_binding()],
            );
            Ok((pipeline, group))
        };
        let plain = searcher(&features)?;
        features.push("count");
        let search = [plain, searcher(&features)?];
        let depth_mode: &[&str] = if spec.option("depth") == "virtual" {
            &["virtual_depth"]
        } else {
            &[]
        };
        let virtual_module = module(gpu, "virtual", depth_mode)?;
        let drawn = [("color", 1), ("layers", 2)].map(|(entry, count)| {
            let pipeline = raster(gpu, &virtual_module, entry, count, true, &[]);
            let groups = vec![
                group(
                    gpu,
                    pipeline.get_bind_group_layout(0),
                    &[view_buffer.as_entire_binding()],
                ),
                group(gpu, pipeline.get_bind_group_layout(1), &surface),
            ];
            (pipeline, groups)
        });
        let composite = raster(gpu, &module(gpu, "composite", &[])?, "color", 1, false, &[]);
        let (primary_view, reflected_view) =
            (view(&targets.primary_color), view(&targets.reflected_color));
        let composite_groups = vec![
            group(
                gpu,
                composite.get_bind_group_layout(0),
                &[view_buffer.as_entire_binding()],
            ),
            group(
                gpu,
                composite.get_bind_group_layout(1),
                &[
                    wgpu::BindingResource::TextureView(&primary_view),
                    position_view.clone(),
                    normal_view.clone(),
                    wgpu::BindingResource::TextureView(&reflected_view),
                ],
            ),
        ];

        let mut mirrors = Vec::new();
        for (index, mirror) in scene.mirrors.iter().enumerate() {
            let analytic = mirror.shape.is_analytic() && spec.option("gbuffer") == "exact";
            let surface_mesh = mirror.shape.tessellate(mirror.tessellation);
            let proxy = if analytic {
                mirror.shape.cover(mirror.tessellation)
            } else {
                surface_mesh.clone()
            };
            let start_at = start_point(
                &mirror.shape,
                &surface_mesh,
                &camera,
                spec.option("start") == "bounds",
            );
            let id = scene.mirror_id(index);
            let mirror_buffer = uniform(
                gpu,
                &MirrorUniform::new(&mirror.shape, id, &camera, start_at),
            );
            let search_settings = SearchSettings {
                vertices,
                first_found: index as u32 * vertices,
                warm: 0,
                max_steps: MAX_STEPS_PER_SIDE * (size[0] + size[1]),
            };
            let settings = uniform(gpu, &search_settings);
            let start = blank(8);
            let corners = mirror_vertices(&proxy);
            let seek = [
                mirror_buffer.as_entire_binding(),
                position_view.clone(),
                normal_view.clone(),
                start.as_entire_binding(),
            ];
            let walk = [
                mirror_buffer.as_entire_binding(),
                position_view.clone(),
                normal_view.clone(),
                positions.as_entire_binding(),
                found.as_entire_binding(),
                start.as_entire_binding(),
                settings.as_entire_binding(),
                work.as_entire_binding(),
            ];
            let show = [
                mirror_buffer.as_entire_binding(),
                position_view.clone(),
                normal_view.clone(),
                found.as_entire_binding(),
                settings.as_entire_binding(),
            ];
            mirrors.push(MirrorDraw {
                id,
                vertices: gpu
                    .device
                    .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                        label: Some("mirror"),
                        contents: bytemuck::cast_slice(&corners),
                        usage: wgpu::BufferUsages::VERTEX,
                    }),
                count: corners.len() as u32,
                analytic,
                gbuffer: group(
                    gpu,
                    gbuffer[usize::from(!analytic)].0.get_bind_group_layout(1),
                    &[mirror_buffer.as_entire_binding()],
                ),
                nearest: group(gpu, nearest.0.get_bind_group_layout(1), &seek),
                choose: group(gpu, choose.0.get_bind_group_layout(1), &seek),
                search: group(gpu, search[0].0.get_bind_group_layout(1), &walk[..7]),
                counting: group(gpu, search[1].0.get_bind_group_layout(1), &walk),
                virtual_color: group(gpu, drawn[0].0.get_bind_group_layout(2), &show),
                virtual_layers: group(gpu, drawn[1].0.get_bind_group_layout(2), &show),
                start,
                settings,
                search_settings,
            });
        }
        let places = scene
            .objects
            .iter()
            .enumerate()
            .flat_map(|(index, object)| {
                (0..object.mesh.positions.len() as u32)
                    .map(move |vertex| (scene.object_id(index), vertex))
            })
            .collect();
        Ok(Self {
            gpu,
            size,
            names: scene
                .ids()
                .into_iter()
                .map(|(id, name, mirror)| Name { id, name, mirror })
                .collect(),
            places,
            corners: geometry.corners.len() as u32,
            warm: spec.option("start") == "previous",
            frames: 0,
            targets,
            mirrors,
            found,
            work,
            primary: [(color, color_groups), (layers, layer_groups)],
            gbuffer,
            nearest,
            choose,
            search,
            raster: drawn,
            composite: (composite, composite_groups),
            timer: Timer::new(gpu),
        })
    }

    /// Renders a frame with all layers and counts the work.
    ///
    /// # Errors
    /// None today; the device's own errors are bugs and panic.
    pub fn render(&mut self) -> Result<Output, ReflectError> {
        self.begin_frame();
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut timer = std::mem::replace(&mut self.timer, Timer::none());
        self.record(&mut encoder, &mut timer, true);
        self.timer = timer;
        self.gpu.queue.submit([encoder.finish()]);
        Ok(self.output())
    }

    /// Renders a frame as an application would, colour and depth only, and times it.
    ///
    /// # Errors
    /// None today; the device's own errors are bugs and panic.
    pub fn time_frame(&mut self) -> Result<FrameTime, ReflectError> {
        self.begin_frame();
        let mut timer = std::mem::replace(&mut self.timer, Timer::none());
        let time = Timer::time(self.gpu, &mut timer, |encoder, timer| {
            self.record(encoder, timer, false)
        });
        self.timer = timer;
        Ok(time)
    }

    fn begin_frame(&mut self) {
        for mirror in &self.mirrors {
            self.gpu.queue.write_buffer(&mirror.start, 0, &[0xff; 8]);
            let warm = u32::from(self.warm && self.frames > 0);
            let mut bytes = UniformBuffer::new(Vec::new());
            bytes
                .write(&SearchSettings {
                    warm,
                    ..mirror.search_settings
                })
                .expect("writing to memory");
            self.gpu
                .queue
                .write_buffer(&mirror.settings, 0, &bytes.into_inner());
        }
        self.frames += 1;
    }

    fn record(&self, encoder: &mut wgpu::CommandEncoder, timer: &mut Timer, layers: bool) {
        let targets = &self.targets;
        let cleared = &[(&targets.primary_color, true)];
        self.pass(
            encoder,
            timer,
            "primary",
            cleared,
            Some((&targets.depth, true)),
            |pass| self.draw(pass, &self.primary[0], self.corners),
        );
        if layers {
            let both = &[
                (&targets.primary_position, true),
                (&targets.primary_normal, true),
            ];
            self.pass(
                encoder,
                timer,
                "primary layers",
                both,
                Some((&targets.depth, true)),
                |pass| self.draw(pass, &self.primary[1], self.corners),
            );
        }
        let both = &[
            (&targets.mirror_position, true),
            (&targets.mirror_normal, true),
        ];
        self.pass(
            encoder,
            timer,
            "gbuffer",
            both,
            Some((&targets.depth, false)),
            |pass| {
                for mirror in &self.mirrors {
                    let (pipeline, group) = &self.gbuffer[usize::from(!mirror.analytic)];
                    pass.set_pipeline(pipeline);
                    pass.set_bind_group(0, group, &[]);
                    pass.set_bind_group(1, &mirror.gbuffer, &[]);
                    pass.set_vertex_buffer(0, mirror.vertices.slice(..));
                    pass.draw(0..mirror.count, 0..1);
                }
            },
        );
        self.compute(encoder, timer, "start", |pass| {
            for mirror in &self.mirrors {
                for ((pipeline, group), own) in [
                    (&self.nearest, &mirror.nearest),
                    (&self.choose, &mirror.choose),
                ] {
                    pass.set_pipeline(pipeline);
                    pass.set_bind_group(0, group, &[]);
                    pass.set_bind_group(1, own, &[]);
                    pass.dispatch_workgroups(self.size[0].div_ceil(8), self.size[1].div_ceil(8), 1);
                }
            }
        });
        self.compute(encoder, timer, "search", |pass| {
            let (pipeline, group) = &self.search[usize::from(layers)];
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            let groups = (self.places.len() as u32).div_ceil(64);
            for mirror in &self.mirrors {
                pass.set_bind_group(
                    1,
                    if layers {
                        &mirror.counting
                    } else {
                        &mirror.search
                    },
                    &[],
                );
                pass.dispatch_workgroups(groups.min(65535), groups.div_ceil(65535), 1);
            }
        });
        let reflected = [
            (&targets.reflected_color, true),
            (&targets.reflected_position, true),
        ];
        self.pass(
            encoder,
            timer,
            "virtual",
            &reflected[..1 + usize::from(layers)],
            Some((&targets.virtual_depth, true)),
            |pass| {
                for mirror in &self.mirrors {
                    pass.set_bind_group(
                        2,
                        if layers {
                            &mirror.virtual_layers
                        } else {
                            &mirror.virtual_color
                        },
                        &[],
                    );
                    self.draw(pass, &self.raster[usize::from(layers)], self.corners);
                }
            },
        );
        self.pass(
            encoder,
            timer,
            "composite",
            &[(&targets.color, true)],
            None,
            |pass| self.draw(pass, &self.composite, 3),
        );
    }

    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        (pipeline, groups): &(wgpu::RenderPipeline, Vec<wgpu::BindGroup>),
        vertices: u32,
    ) {
        pass.set_pipeline(pipeline);
        for (index, group) in (0..).zip(groups) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.draw(0..vertices, 0..1);
    }

    fn pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut Timer,
        name: &str,
        colors: &[(&wgpu::Texture, bool)],
        depth: Option<(&wgpu::Texture, bool)>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let views: Vec<_> = colors.iter().map(|(texture, _)| view(texture)).collect();
        let attachments: Vec<_> = views
            .iter()
            .map(|view| {
                Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                        store: wgpu::StoreOp::Store,
                    },
                })
            })
            .collect();
        let depth = depth.map(|(texture, clear)| {
            (
                view(texture),
                if clear {
                    wgpu::LoadOp::Clear(0.0)
                } else {
                    wgpu::LoadOp::Load
                },
            )
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(name),
            color_attachments: &attachments,
            depth_stencil_attachment: depth.as_ref().map(|(view, load)| {
                wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: Some(wgpu::Operations {
                        load: *load,
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }
            }),
            timestamp_writes: timer.next(name).map(|(query_set, index)| {
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

    fn compute(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut Timer,
        name: &str,
        dispatch: impl FnOnce(&mut wgpu::ComputePass<'_>),
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(name),
            timestamp_writes: timer.next(name).map(|(query_set, index)| {
                wgpu::ComputePassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: None,
                    end_of_pass_write_index: Some(index),
                }
            }),
        });
        dispatch(&mut pass);
    }

    fn output(&self) -> Output {
        let read = |texture| self.gpu.read_texture(texture);
        let xyz = |texel: &[f32; 4]| Vec3::new(texel[0], texel[1], texel[2]);
        let image =
            |texels: &[[f32; 4]]| Image::from_vec(self.size, texels.iter().map(xyz).collect());
        let color = image(&read(&self.targets.color));
        let (mut position, mut normal) = (
            read(&self.targets.primary_position),
            read(&self.targets.primary_normal),
        );
        let (mirror_position, mirror_normal) = (
            read(&self.targets.mirror_position),
            read(&self.targets.mirror_normal),
        );
        let hits = read(&self.targets.reflected_position);
        let mut status = vec![Status::NotMirror; hits.len()];
        let mut distance = vec![0.0; hits.len()];
        let mut hits_kept = vec![[0.0; 4]; hits.len()];
        for pixel in 0..hits.len() {
            if mirror_position[pixel][3] == 0.0 {
                continue;
            }
            position[pixel] = mirror_position[pixel];
            normal[pixel] = mirror_normal[pixel];
            status[pixel] = match mirror_normal[pixel][3] as u32 {
                2 => Status::Back,
                3 => Status::Below,
                _ => Status::Resolved,
            };
            if status[pixel] == Status::Resolved && hits[pixel][3] > 0.0 {
                hits_kept[pixel] = hits[pixel];
                distance[pixel] = xyz(&hits[pixel]).distance(xyz(&mirror_position[pixel]));
            }
        }
        let ids = |texels: &[[f32; 4]]| {
            Image::from_vec(
                self.size,
                texels.iter().map(|texel| texel[3] as u32).collect(),
            )
        };
        let frame = Frame {
            color,
            primary: Some(Primary {
                id: ids(&position),
                position: image(&position),
                normal: image(&normal),
            }),
            reflected: Some(Reflected {
                status: Image::from_vec(self.size, status),
                id: ids(&hits_kept),
                position: image(&hits_kept),
                distance: Image::from_vec(self.size, distance),
                bounces: None,
            }),
            names: self.names.clone(),
        };
        let vertices = self.vertices();
        let count = vertices.len().max(1) as f64;
        let mean = |value: fn(&VertexResult) -> u32| {
            vertices
                .iter()
                .map(|vertex| f64::from(value(vertex)))
                .sum::<f64>()
                / count
        };
        let work = Work {
            evaluations: mean(|vertex| vertex.evaluations),
            steps: mean(|vertex| vertex.steps),
            ..Work::default()
        };
        let drawn = u64::from(self.corners / 3) * self.mirrors.len() as u64;
        Output {
            frame,
            triangles: Triangles {
                input: drawn,
                drawn,
                by_level: vec![drawn],
                unfinished: 0,
            },
            vertices: Some(vertices),
            work,
        }
    }

    fn vertices(&self) -> Vec<VertexResult> {
        let found = self.gpu.read_buffer(&self.found);
        let work = self.gpu.read_buffer(&self.work);
        let float =
            |bytes: &[u8], at: usize| -> f32 { bytemuck::pod_read_unaligned(&bytes[at..at + 4]) };
        let word =
            |bytes: &[u8], at: usize| -> u32 { bytemuck::pod_read_unaligned(&bytes[at..at + 4]) };
        let places = self
            .mirrors
            .iter()
            .flat_map(|mirror| self.places.iter().map(move |place| (mirror.id, *place)));
        places
            .zip(found.chunks_exact(32))
            .zip(work.chunks_exact(8))
            .map(
                |(((mirror, (object, vertex)), record), counts)| VertexResult {
                    object,
                    vertex,
                    mirror,
                    state: match word(record, 12) {
                        0 => VertexState::Found,
                        1 => VertexState::Hidden,
                        _ => VertexState::Failed,
                    },
                    at: Vec2::new(float(record, 16), float(record, 20)),
                    steps: word(counts, 0),
                    evaluations: word(counts, 4),
                    node_tests: 0,
                    hole: None,
                    enlarged: None,
                },
            )
            .collect()
    }
}
