//! Midpoint search in reflector cube maps (Estalella et al. 2005, §4.3).
//!
//! The maps depend on the mirror alone: they are made when the technique is prepared, and again
//! only for a mirror that has moved.

mod maps;
#[cfg(test)]
mod tests;
pub(crate) mod twin;

use catoptric_scene::{Mirror, Scene, Shape};
use encase::ShaderType;

use super::{Context, Pipelines, Recipe, Search};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, Slot, group, layout, texture_with, uniform};
use crate::options::{options, words};
use crate::stage::Stage;
use crate::stage::options::SearchOptions;
use crate::stage::points::Points;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named};
use maps::Maps;

/// Faces of a cube.
const FACES: u32 = 6;

words! {
    /// Where a search starts.
    pub(crate) enum Start {
        /// Halfway between the directions to eye and vertex.
        Bisector = "bisector",
        /// In the eye's direction.
        Eye = "eye",
    }
}

words! {
    /// How the bisector is projected onto a face of the cube.
    pub(crate) enum Projection {
        /// To first order, at the point reached.
        Ours = "ours",
        /// Between the points where the rays along normal and bisector meet the face.
        Published = "published",
    }
}

options! {
    /// The search, as its options describe it.
    pub(crate) struct ReflectorCubemap {
        /// most steps of a search
        iterations: u32 = 9 in 1..=256,
        /// texels along an edge of the cube maps
        size: u32 = 256 in 2..=2048,
        /// the direction from the mirror's centre where a search starts (in a concave mirror the
        /// one against it): halfway between eye and vertex, or the eye's
        start: Start,
        /// the projected bisector: of first order at the point reached, or between the places where the
        /// rays from the centre along normal and bisector meet the face
        projection: Projection,
        /// segments around the tessellated mirror that the maps are drawn from, as the paper draws them;
        /// 0: each texel has the mirror's exact point and normal (a mesh's its triangles' in any case)
        tessellation: u32 = 0 in 0..=1024,
        /// length of the first step, in units of the projected bisector; 0: every step starts from the
        /// length that fits the distances of eye and vertex, which the factors change
        step: f64 = 0.0 in 0.0..=4.0,
        /// factor of the step length where the field changes much within a step
        shrink: f64 = 0.6 in 0.1..=1.0,
        /// factor of the step length where the field changes little within a step
        grow: f64 = 1.25 in 1.0..=4.0,
        /// change of the field, relative to the longer of two, that is much (the paper gives no number)
        different: f64 = 0.5 in 0.0..=2.0,
        /// change of the field that is little (the paper gives no number)
        similar: f64 = 0.25 in 0.0..=2.0,
        /// least length of a step, or with step=0 least factor of the length that fits
        least: f64 = 0.05 in 0.0..=1.0,
        /// greatest length of a step, or with step=0 greatest factor
        greatest: f64 = 4.0 in 1.0..=16.0,
    }
}

impl Named for ReflectorCubemap {
    const INFO: Info = Info {
        name: "reflector-cubemap",
        what: "midpoint search in cube maps of the mirror",
        paper: "Estalella et al. 2005",
    };
}

impl Recipe for ReflectorCubemap {
    fn objection(&self, _: &SearchOptions, scene: &Scene) -> Option<String> {
        scene.mirrors.iter().find_map(|mirror| {
            let reason = maps::objection(&*mirror.shape)?;
            Some(format!("mirror `{}` {reason}", mirror.name))
        })
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
        Ok(Box::new(InMaps::new(self, context)?))
    }
}

/// Twin of `Settings` in `reflector_cubemap.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct Settings {
    /// Texels along an edge of a face.
    size: u32,
    /// Most steps.
    iterations: u32,
    /// Length of the first step; 1 moves a point of the unit sphere from the normal's tip to the
    /// bisector's, to first order; 0: as long as the distances of eye and vertex allow.
    first_step: f32,
    /// Factor of the step length where the field changes much.
    shrink: f32,
    /// Factor of the step length where the field changes little.
    grow: f32,
    /// Relative change of the field that is much.
    different: f32,
    /// Relative change of the field that is little.
    similar: f32,
    /// Shortest step.
    least: f32,
    /// Longest step.
    greatest: f32,
    /// 1: start in the eye's direction, 0: at the bisector of the directions to eye and vertex.
    from_eye: u32,
    /// 1: the mirror's normals point away from its centre, −1: towards it.
    facing: f32,
}

impl Settings {
    /// For a mirror whose maps face this way ([`Maps::facing`]).
    ///
    /// Where normals point inwards, the surface whose normal is the bisector lies in the direction
    /// against it. The field so turned has its sinks at the inverted images: in front of a point
    /// beyond the focus the bisector turns less along the mirror than the normal, in front of a
    /// nearer one more, so that each step leads away from the upright image.
    fn new(options: &ReflectorCubemap, facing: f32) -> Self {
        Self {
            size: options.size,
            iterations: options.iterations,
            first_step: options.step as f32,
            shrink: options.shrink as f32,
            grow: options.grow as f32,
            different: options.different as f32,
            similar: options.similar as f32,
            least: options.least as f32,
            greatest: options.greatest as f32,
            from_eye: u32::from(options.start == Start::Eye),
            facing,
        }
    }
}

/// The search, ready for a scene.
struct InMaps {
    options: ReflectorCubemap,
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

impl InMaps {
    fn new(options: &ReflectorCubemap, context: &Context<'_>) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let slots = [Slot::Uniform, Slot::Textures, Slot::Textures];
        let layout = layout(gpu, "reflector cube maps", &slots);
        let published = options.projection == Projection::Published;
        let features = [(context.extends, "extend"), (published, "published")];
        let features = features.into_iter().filter(|(on, _)| *on);
        let features: Vec<_> = features.map(|(_, name)| name).collect();
        let mut made = Self {
            options: *options,
            pipelines: Pipelines::new(context, "reflector_cubemap", &features, &layout)?,
            layout,
            mirrors: Vec::new(),
            builds: 0,
        };
        let mirrors = stage.world.scene.mirrors.iter();
        // Before they are made on the CPU.
        let texels = u64::from(FACES) * u64::from(options.size).pow(2);
        gpu.check_memory(mirrors.len() as u64 * 2 * 16 * texels)?;
        made.mirrors = mirrors.map(|mirror| made.build(gpu, mirror)).collect();
        Ok(made)
    }

    /// Makes the maps of a mirror.
    fn build(&mut self, gpu: &Gpu, mirror: &Mirror) -> OnGpu {
        self.builds += 1;
        let maps = Maps::new(&*mirror.shape, &self.options);
        let settings = uniform(gpu, &Settings::new(&self.options, maps.facing));
        let views = [&maps.positions, &maps.normals].map(|texels| {
            // Cube textures cannot be read texel by texel.
            let texture = texture_with(gpu, "reflector cube map", [maps.size, FACES], texels);
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

impl Search for InMaps {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        for (index, mirror) in stage.world.scene.mirrors.iter().enumerate() {
            if self.mirrors[index].shape != mirror.shape {
                self.mirrors[index] = self.build(gpu, mirror);
            }
        }
    }

    /// It has maps of its own.
    fn reads_maps(&self) -> bool {
        false
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        points: &Points,
        variant: Variant,
    ) {
        let own = &self.mirrors[mirror].group;
        (self.pipelines).record(frame, (stage, mirror), points, own, variant);
    }
}
