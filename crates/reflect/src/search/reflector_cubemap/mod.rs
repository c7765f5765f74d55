//! Midpoint search in reflector cube maps (Estalella et al. 2005, §4.3).
//!
//! The maps depend on the mirror alone: they are made when the technique is prepared, and again
//! only for a mirror that has moved.

mod maps;
#[cfg(test)]
mod tests;
pub(crate) mod twin;

use catoptric_scene::{Mirror, Scene, Shape};
use wgpu::util::{DeviceExt, TextureDataOrder};

use super::{Context, Pipelines, Search};
use crate::error::ReflectError;
use crate::gpu::{FLOAT4, Gpu, Recorder, Slot, group, layout, uniform};
use crate::spec::Options;
use crate::stage::Stage;
use crate::stage::data::ReflectorCubemapSettings;
use crate::stage::points::Points;
use crate::technique::Variant;
use maps::Maps;

/// Reads the search's options, for a mirror whose maps face this way ([`Maps::facing`]).
///
/// Where normals point inwards, the surface whose normal is the bisector lies in the direction
/// against it. The field so turned has its sinks at the inverted images: in front of a point beyond
/// the focus the bisector turns less along the mirror than the normal, in front of a nearer one more,
/// so that each step leads away from the upright image.
fn settings(options: &Options, facing: f32) -> ReflectorCubemapSettings {
    ReflectorCubemapSettings {
        size: options.whole("size"),
        iterations: options.whole("iterations"),
        first_step: options.number("step") as f32,
        shrink: options.number("shrink") as f32,
        grow: options.number("grow") as f32,
        from_eye: u32::from(options.is("start", "eye")),
        facing,
    }
}

/// Why a scene's mirrors cannot be searched.
pub(crate) fn objection(_: &Options, scene: &Scene) -> Option<String> {
    scene.mirrors.iter().find_map(|mirror| {
        let reason = maps::objection(&mirror.shape)?;
        Some(format!("mirror `{}` {reason}", mirror.name))
    })
}

struct ReflectorCubemap {
    options: Options,
    layout: wgpu::BindGroupLayout,
    pipelines: Pipelines,
    mirrors: Vec<OnGpu>,
    /// How often a mirror's maps were made.
    builds: u32,
}

/// The maps of one mirror.
struct OnGpu {
    shape: Shape,
    group: wgpu::BindGroup,
}

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
    Ok(Box::new(ReflectorCubemap::new(context)?))
}

impl ReflectorCubemap {
    fn new(context: &Context<'_>) -> Result<Self, ReflectError> {
        let Context {
            gpu,
            options,
            stage,
            ..
        } = context;
        let slots = [Slot::Uniform, Slot::Textures, Slot::Textures];
        let layout = layout(gpu, "reflector cube maps", &slots);
        let extend = options.is("hidden", "extend").then_some("extend");
        let features: Vec<_> = extend.into_iter().collect();
        let mut made = Self {
            options: (*options).clone(),
            pipelines: Pipelines::new(context, "reflector_cubemap", &features, &layout)?,
            layout,
            mirrors: Vec::new(),
            builds: 0,
        };
        let mirrors = stage.world.scene.mirrors.iter();
        made.mirrors = mirrors.map(|mirror| made.build(gpu, mirror)).collect();
        Ok(made)
    }

    /// Makes the maps of a mirror.
    fn build(&mut self, gpu: &Gpu, mirror: &Mirror) -> OnGpu {
        self.builds += 1;
        let maps = Maps::new(&mirror.shape, self.options.whole("size"));
        let settings = uniform(gpu, &settings(&self.options, maps.facing));
        let views = [&maps.positions, &maps.normals].map(|texels| {
            let texture = faces(gpu, maps.size, texels);
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            })
        });
        let resources = [
            settings.as_entire_binding(),
            wgpu::BindingResource::TextureView(&views[0]),
            wgpu::BindingResource::TextureView(&views[1]),
        ];
        OnGpu {
            shape: mirror.shape.clone(),
            group: group(gpu, &self.layout, &resources),
        }
    }
}

/// A texture of six layers. Cube textures cannot be read texel by texel.
fn faces(gpu: &Gpu, size: u32, texels: &[[f32; 4]]) -> wgpu::Texture {
    gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("reflector cube map"),
            size: wgpu::Extent3d {
                width: size,
                height: size,
                depth_or_array_layers: 6,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FLOAT4,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(texels),
    )
}

impl Search for ReflectorCubemap {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        for (index, mirror) in stage.world.scene.mirrors.iter().enumerate() {
            if self.mirrors[index].shape != mirror.shape {
                self.mirrors[index] = self.build(gpu, mirror);
            }
        }
    }

    fn begin_frame(&mut self, _gpu: &Gpu) {}

    fn record_build(&self, _frame: &mut Recorder<'_>, _stage: &Stage) {}

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        points: &Points,
        variant: Variant,
    ) {
        let own = &self.mirrors[mirror].group;
        let on = &stage.gbuffer.mirror_groups[mirror];
        (self.pipelines).record(frame, (stage, on), points, own, variant);
    }
}

#[cfg(test)]
mod rebuilding {
    use glam::DVec3;

    use super::*;
    use crate::search::Account;
    use crate::spec::parse;
    use crate::stage::points::points_layout;
    use crate::testing::{gpu_or_skip, scene};

    #[test]
    fn maps_are_made_again_for_a_mirror_that_moves_and_only_then() {
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let mut scene = scene("spheres");
        let spec = parse("reflector-cubemap(size=16)").expect("a technique");
        let mut stage = Stage::new(&gpu, spec.options(), &scene, [32, 24]).expect("fits");
        let mut search = ReflectorCubemap::new(&Context {
            gpu: &gpu,
            options: spec.options(),
            stage: &stage,
            points_layout: &points_layout(&gpu),
            account: Account::Efforts,
        })
        .expect("can be made");
        let mirrors = scene.mirrors.len() as u32;
        assert_eq!(search.builds, mirrors);
        let mut builds_after = |scene: &Scene| {
            stage.world.update(&gpu, scene).expect("the same scene");
            search.update(&gpu, &stage);
            search.builds - mirrors
        };
        scene.camera.eye += DVec3::new(0.1, 0.2, 0.0);
        scene.objects[0].mesh.positions[0] += 0.5;
        assert_eq!(builds_after(&scene), 0, "eye and objects");
        let Shape::Sphere { center, .. } = &mut scene.mirrors[0].shape else {
            panic!("a sphere")
        };
        center.x += 0.1;
        assert_eq!(builds_after(&scene), 1, "moved");
        let Shape::Sphere { radius, .. } = &mut scene.mirrors[0].shape else {
            panic!("a sphere")
        };
        *radius *= 1.01;
        assert_eq!(builds_after(&scene), 2, "deformed");
        assert_eq!(builds_after(&scene), 2, "at rest");
    }

    #[test]
    fn scenes_with_mirrors_that_no_closed_shape_stands_for_are_refused_by_name() {
        let spec = parse("reflector-cubemap").expect("a technique");
        let why = |name: &str| objection(spec.options(), &scene(name));
        assert_eq!(why("spheres"), None);
        assert_eq!(why("ellipsoid"), None);
        assert_eq!(why("bowl"), None);
        assert!(why("planar").is_some_and(|why| why.contains("open")));
        assert!(why("torus").is_some_and(|why| why.contains("whole")));
    }
}
