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
use glam::{DVec3, Vec3};

use super::{Context, Pipelines, Recipe, Search, Sheet};
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

words! {
    /// Which reflections of a vertex in a concave mirror are searched.
    pub(crate) enum Sheets {
        /// The one that the walk as published finds: the inverted image.
        First = "first",
        /// The upright image by a second walk, and the inverted one.
        Extrema = "extrema",
        /// Also those between the two focal points, by Newton's method.
        All = "all",
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
        /// in a concave mirror: the inverted image alone, also the upright one by a walk the other way, or
        /// also the one between its focal points, a saddle of the path's length, by Newton's method; but
        /// for the first, a search that has not arrived has no answer
        sheets: Sheets,
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
            let reason = maps::objection(mirror)?;
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
    /// Sign of the field that a walk follows.
    sense: f32,
    /// Which images are looked for: one of `Image::…`.
    image: u32,
    /// Greatest error E of an answer.
    accept: f32,
    /// Centre of the maps less that of the mirror, world space: not 0 where a mirror has proxies.
    offset: Vec3,
}

/// Which image of a vertex a search looks for, as `image` in `reflector_cubemap.wesl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Image {
    /// The only one of a convex mirror, or the inverted one of a concave mirror.
    Published = 0,
    /// The upright one of a concave mirror.
    Upright = 1,
    /// The one between its focal points.
    Between = 2,
}

/// Greatest error E of an answer where walks must have arrived: bisector and normal differ by 0.0045
/// radians.
const ARRIVED: f32 = 5e-6;
/// Greater than any error.
const ANY: f32 = 2.0;

impl Sheets {
    /// The images looked for on a mirror whose maps face this way, by the number of their sheet.
    fn images(self, facing: f32) -> &'static [Image] {
        match self {
            _ if facing > 0.0 => &[Image::Published],
            Self::First => &[Image::Published],
            Self::Extrema => &[Image::Upright, Image::Published],
            Self::All => &[Image::Upright, Image::Between, Image::Published],
        }
    }
}

impl Settings {
    /// For maps of a mirror of this centre.
    ///
    /// Where normals point inwards, the surface point whose normal is the bisector lies opposite to the
    /// bisector's direction, so the field is reversed. The reversed field has its sinks at the inverted
    /// images. For a point beyond the focus the bisector turns less along the mirror than the normal does;
    /// for a nearer point it turns more, so that each step leads away from the upright image, or towards
    /// it if the sign of the field is changed. Between the foci of a beam the bisector turns less in one
    /// direction and more in the other: no walk leads to such a point.
    fn new(options: &ReflectorCubemap, maps: &Maps, center: DVec3, image: Image) -> Self {
        let facing = maps.facing;
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
            sense: match image {
                Image::Upright => 1.0,
                _ => facing,
            },
            image: image as u32,
            accept: match options.sheets {
                Sheets::First => ANY,
                _ if facing > 0.0 => ANY,
                _ => ARRIVED,
            },
            offset: (maps.center - center).as_vec3(),
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
    /// One a sheet: the images in each pair of maps.
    groups: Vec<wgpu::BindGroup>,
}

impl InMaps {
    fn new(options: &ReflectorCubemap, context: &Context<'_>) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let slots = [Slot::Uniform, Slot::Textures, Slot::Textures];
        let layout = layout(gpu, "reflector cube maps", &slots);
        let published = options.projection == Projection::Published;
        let several = options.sheets != Sheets::First;
        let features = [
            (context.extends, "extend"),
            (published, "published"),
            (several, "sheets"),
        ];
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
        let pairs: usize = mirrors
            .clone()
            .map(|mirror| mirror.proxies.len().max(1))
            .sum();
        gpu.check_memory(pairs as u64 * 2 * 16 * texels)?;
        made.mirrors = mirrors.map(|mirror| made.build(gpu, mirror)).collect();
        Ok(made)
    }

    /// Makes the maps of a mirror: without any, where it fits its proxies no more.
    fn build(&mut self, gpu: &Gpu, mirror: &Mirror) -> OnGpu {
        self.builds += 1;
        let ReflectorCubemap {
            size, tessellation, ..
        } = self.options;
        let all = Maps::of(mirror, size, tessellation).unwrap_or_default();
        let groups = all.iter().flat_map(|maps| self.groups(gpu, mirror, maps));
        OnGpu {
            shape: mirror.shape.clone(),
            groups: groups.collect(),
        }
    }

    /// The resources of each image that is looked for in a pair of maps.
    fn groups(&self, gpu: &Gpu, mirror: &Mirror, maps: &Maps) -> Vec<wgpu::BindGroup> {
        let views = [&maps.positions, &maps.normals].map(|texels| {
            // Cube textures cannot be read texel by texel.
            let texture = texture_with(gpu, "reflector cube map", [maps.size, FACES], texels);
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            })
        });
        let images = self.options.sheets.images(maps.facing).iter();
        let center = mirror.shape.center();
        let groups = images.map(|image| {
            let settings = uniform(gpu, &Settings::new(&self.options, maps, center, *image));
            let resources = [
                settings.as_entire_binding(),
                wgpu::BindingResource::TextureView(&views[0]),
                wgpu::BindingResource::TextureView(&views[1]),
            ];
            group(gpu, &self.layout, &resources)
        });
        groups.collect()
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

    fn sheets(&self, mirror: usize) -> usize {
        self.mirrors[mirror].groups.len()
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        points: &Points,
        variant: Variant,
    ) {
        let own = &self.mirrors[sheet.mirror].groups[sheet.number];
        (self.pipelines).record(frame, (stage, sheet.mirror), points, own, variant);
    }
}
