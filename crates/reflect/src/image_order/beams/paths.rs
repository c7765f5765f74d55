//! More than one reflection: the rays of each pixel as images, what each ray meets, mirrors included,
//! and the colour of what its path ends on (`beams/first.wesl`, `beams/bounce.wesl`, `beams/ends.wesl`).
//!
//! The hierarchy is built again over the second rays, and again over the third. Rays of one tile then
//! leave different mirrors, so that their boxes are larger, but their hits are just as exact. A ray
//! follows the reference's rules. It does not meet the surface that it leaves: a sphere, an ellipsoid and
//! a plane are skipped, a bowl, a saddle and a torus are skipped near the ray's start, and a triangle is
//! skipped if the ray starts in its plane. Of surfaces equally far away a mirror's front is met first,
//! then a mirror's back, then an object. A back ends the path in black, as does a mirror met by the last
//! ray, and a mirror whose shading normal sends the next ray below its surface.

use encase::ShaderType;

use super::lists::Lists;
use super::mirrors::Mirrors;
use super::settings::TOUCHING;
use super::source::Source;
use crate::error::ReflectError;
use crate::gpu::{
    FLOAT4, Gpu, Kernel, Recorder, Slot, compute, group, layout, module, set_uniform,
    storage_zeros, target, uniform, view,
};
use crate::stage::Stage;
use crate::stage::extent::diagonal;
use crate::stage::variant::Variant;

/// Twin of `Bounce` in `beams/bounce.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Bounce {
    pub last: u32,
    pub mirrors: u32,
    pub touching: f32,
}

/// The images of the rays and of the paths' ends, and the passes between them.
pub(super) struct Paths {
    pub(super) reflections: usize,
    mirrors: u32,
    /// For all reflections but the last, and for that.
    settings: [wgpu::Buffer; 2],
    first: Kernel,
    first_group: wgpu::BindGroup,
    bounce: Kernel,
    /// For all slices but the last.
    keep: Kernel,
    /// By the reflection's oddness, by whether slices came before, by whether it is the last.
    groups: [[[wgpu::BindGroup; 2]; 2]; 2],
    color: Kernel,
    layers: Kernel,
    shade_group: wgpu::BindGroup,
    slices: usize,
    /// Length of the last segment and reflections of each pixel's path, with all layers.
    path: wgpu::Texture,
}

/// Images of origins and directions, for rays after an even and after an odd number of reflections.
pub(super) struct RayImages([[wgpu::Texture; 2]; 2]);

impl RayImages {
    /// The images, and what reads the rays from them.
    pub(super) fn new(gpu: &Gpu, stage: &Stage) -> (Self, Source) {
        let size = stage.world.size;
        let image = |label| target(gpu, label, size, FLOAT4);
        let pair = || [image("rays, origin"), image("rays, direction")];
        let images = [pair(), pair()];
        let rays_layout = layout(gpu, "rays of paths", &[Slot::Texture; 2]);
        let rays = images.iter().map(|images| {
            let views = images.each_ref().map(view);
            let resources = views.each_ref().map(wgpu::BindingResource::TextureView);
            group(gpu, &rays_layout, &resources)
        });
        let source = Source {
            size,
            feature: Some("rays"),
            view: None,
            rays: rays.collect(),
            rays_layout,
        };
        (Self(images), source)
    }
}

impl Paths {
    /// # Errors
    /// Shaders that do not link: a bug. What the device cannot hold it notes itself.
    pub(super) fn new(
        gpu: &Gpu,
        (stage, lists, mirrors): (&Stage, &Lists, &Mirrors),
        (RayImages(images), source): (&RayImages, &Source),
        reflections: u32,
    ) -> Result<Self, ReflectError> {
        use Slot::{Image, Read, Texture, Uniform, Write};
        let [width, height] = stage.world.size;
        let path = target(gpu, "paths", stage.world.size, FLOAT4);
        let end = target(gpu, "ends of paths", stage.world.size, FLOAT4);
        let slices = lists.slices();
        let kept = u64::from(width) * u64::from(height) * 16;
        let nearest = storage_zeros(gpu, if slices > 1 { kept } else { 0 });
        gpu.check()?;
        let views = [&images[0], &images[1]].map(|pair| pair.each_ref().map(view));
        let image = wgpu::BindingResource::TextureView;
        let whole = wgpu::Buffer::as_entire_binding;
        let own = |program: &str, entry: &str, features: &[&str], layouts: [_; 4]| {
            Ok::<_, ReflectError>(compute(
                gpu,
                &module(gpu, program, features)?,
                entry,
                &layouts,
            ))
        };

        let first_layout = layout(gpu, "first rays", &[Image; 2]);
        let first_group = group(
            gpu,
            &first_layout,
            &[image(&views[0][0]), image(&views[0][1])],
        );
        let of_gbuffer = Source::of_gbuffer(stage);
        let [of_view, of_mirrors] = of_gbuffer.layouts();
        let first = own(
            "beams/first",
            "rays",
            &[],
            [of_view, of_mirrors, None, Some(&first_layout)],
        )?;

        let bounce_slots = [
            Image, Image, Read, Read, Write, Uniform, Image, Read, Read, Uniform,
        ];
        let bounce_layout = layout(gpu, "bounce", &bounce_slots);
        let settings = [0, 1].map(|last| uniform(gpu, &bounce(stage, mirrors.exact_count, last)));
        let has_nearest = [0_u32, 1].map(|has| uniform(gpu, &has));
        let end_view = view(&end);
        let groups = [0, 1].map(|odd: usize| {
            let [origin, direction] = &views[1 - odd];
            [0, 1].map(|later: usize| {
                [0, 1].map(|last: usize| {
                    let resources = [
                        image(origin),
                        image(direction),
                        whole(&lists.parts_of_tiles),
                        whole(&lists.hits),
                        whole(&nearest),
                        whole(&has_nearest[later]),
                        image(&end_view),
                        whole(&mirrors.exact),
                        whole(&mirrors.corners),
                        whole(&settings[last]),
                    ];
                    group(gpu, &bounce_layout, &resources)
                })
            })
        });
        let rays = Some(&source.rays_layout);
        let layouts = [None, rays, None, Some(&bounce_layout)];
        let bounce = own("beams/bounce", "bounces", &["rays"], layouts)?;
        let keep = own("beams/bounce", "keep", &["rays"], layouts)?;

        let shade_layout = layout(gpu, "ends", &[Image, Image, Image, Texture]);
        let drawn = stage.reflections.views();
        let path_view = view(&path);
        let resources = [
            image(&drawn[0]),
            image(&drawn[1]),
            image(&path_view),
            image(&end_view),
        ];
        let world = &stage.world;
        let layouts = [
            Some(&world.view_layout),
            rays,
            Some(&world.surface_layout),
            Some(&shade_layout),
        ];
        Ok(Self {
            reflections: reflections as usize,
            mirrors: mirrors.exact_count,
            settings,
            first,
            first_group,
            bounce,
            keep,
            groups,
            color: own("beams/ends", "shade", &["rays"], layouts)?,
            layers: own("beams/ends", "shade", &["rays", "layers"], layouts)?,
            shade_group: group(gpu, &shade_layout, &resources),
            slices,
            path,
        })
    }

    /// Takes over how large the scene is now.
    pub(super) fn update(&self, gpu: &Gpu, stage: &Stage) {
        for (last, settings) in (0..).zip(&self.settings) {
            set_uniform(gpu, settings, &bounce(stage, self.mirrors, last));
        }
    }

    /// Records the pass `rays`: the first rays.
    pub(super) fn record_first(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        frame.compute("rays", |pass| {
            pass.set_pipeline(&self.first);
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.gbuffer.mirror_groups[0], &[]);
            pass.set_bind_group(3, &self.first_group, &[]);
            let [x, y] = self.first.groups_over(stage.world.size);
            pass.dispatch_workgroups(x, y, 1);
        });
    }

    /// Records the pass `bounce`, after the tiles of a slice, for the rays after so many reflections of
    /// each path before their own.
    pub(super) fn record(
        &self,
        frame: &mut Recorder<'_>,
        source: &Source,
        slice: usize,
        reflections: usize,
    ) {
        let kernel = match slice + 1 < self.slices {
            true => &self.keep,
            false => &self.bounce,
        };
        let last = usize::from(reflections + 1 == self.reflections);
        let own = &self.groups[reflections % 2][usize::from(slice > 0)][last];
        frame.compute("bounce", |pass| {
            pass.set_pipeline(kernel);
            source.set(pass, reflections);
            pass.set_bind_group(3, own, &[]);
            let [x, y] = kernel.groups_over(source.size);
            pass.dispatch_workgroups(x, y, 1);
        });
    }

    /// Records the pass `shade`, after all bounces.
    pub(super) fn record_shade(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        source: &Source,
        variant: Variant,
    ) {
        let kernel = match variant {
            Variant::AllLayers => &self.layers,
            Variant::Color => &self.color,
        };
        frame.compute("shade", |pass| {
            pass.set_pipeline(kernel);
            source.set(pass, self.reflections);
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, &self.shade_group, &[]);
            let [x, y] = kernel.groups_over(source.size);
            pass.dispatch_workgroups(x, y, 1);
        });
    }

    /// Of each pixel of the last frame with all layers: the length of its path's last segment, world
    /// units, and the reflections on it.
    pub(super) fn read(&self, gpu: &Gpu) -> Vec<[f32; 4]> {
        gpu.read_texture(&self.path)
    }
}

fn bounce(stage: &Stage, mirrors: u32, last: u32) -> Bounce {
    Bounce {
        last,
        mirrors,
        touching: TOUCHING * diagonal(&stage.world.scene),
    }
}
