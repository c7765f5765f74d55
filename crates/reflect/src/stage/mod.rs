//! What every technique stands on: the scene on the GPU, the eye's picture, the mirror G-buffer,
//! and the composite that puts the technique's reflections into the picture.

pub(crate) mod composite;
pub(crate) mod extent;
pub(crate) mod gbuffer;
pub(crate) mod geometry;
pub(crate) mod maps;
pub(crate) mod mirror;
pub(crate) mod options;
pub(crate) mod points;
pub(crate) mod primary;
pub(crate) mod raster;
#[cfg(test)]
pub(crate) mod twin;
pub(crate) mod variant;
pub(crate) mod view;
pub(crate) mod world;

use catoptric_frame::{Frame, Image, Primary as PrimaryLayers, Reflected, Status};
use catoptric_scene::Scene;
use glam::Vec3;

use crate::error::ReflectError;
use crate::gpu::{Begin, Gpu, Recorder};
use crate::stage::variant::Variant;
use composite::{Composite, Reflections};
use gbuffer::GBuffer;
use maps::WholeMaps;
use options::{Occluders, SearchOptions, StageOptions, Surface};
use primary::Primary;
use world::World;

const GBUFFER: &str = "gbuffer";
/// The id that a technique gives where a later reflected ray would start below the surface of its mirror. Twin
/// of `BELOW_ID` in `beams/ends.wesl`.
const BELOW: f32 = -2.0;

/// Names of the passes that every technique's frame has, whatever the technique; all others are its own.
pub const STAGE_PASSES: [&str; 3] = [primary::PASS, GBUFFER, composite::PASS];

/// The passes before and after a technique's own.
pub(crate) struct Stage {
    pub options: StageOptions,
    pub world: World,
    pub primary: Primary,
    pub gbuffer: GBuffer,
    /// What searches read; `None`: the G-buffer.
    whole: Option<WholeMaps>,
    pub reflections: Reflections,
    composite: Composite,
}

impl Stage {
    pub(crate) fn new(
        gpu: &Gpu,
        options: StageOptions,
        scene: &Scene,
        size: [u32; 2],
    ) -> Result<Self, ReflectError> {
        let exact = options.gbuffer == Surface::Exact;
        let world = World::new(gpu, scene, size, exact, options.under)?;
        let primary = Primary::new(gpu, &world)?;
        let gbuffer = GBuffer::new(gpu, &world)?;
        let reflections = Reflections::new(gpu, size);
        let composite = Composite::new(gpu, &world, &primary, &gbuffer, &reflections)?;
        gpu.check()?;
        Ok(Self {
            options,
            world,
            primary,
            gbuffer,
            whole: None,
            reflections,
            composite,
        })
    }

    /// With the maps that a search reads.
    pub(crate) fn searched(
        gpu: &Gpu,
        options: &SearchOptions,
        scene: &Scene,
        size: [u32; 2],
    ) -> Result<Self, ReflectError> {
        let mut stage = Self::new(gpu, options.stage, scene, size)?;
        if options.occluders == Occluders::Ignore {
            stage.whole = Some(WholeMaps::new(gpu, &stage.world)?);
            gpu.check()?;
        }
        Ok(stage)
    }

    /// What a search reads: position and normal of the mirror whose maps were recorded last.
    pub(crate) fn maps(&self) -> &GBuffer {
        let whole = self.whole.as_ref();
        whole.map_or(&self.gbuffer, |whole| &whole.gbuffer)
    }

    /// Records the maps of a mirror (an index), where they are not the G-buffer's. They hold until
    /// those of another mirror are recorded.
    pub(crate) fn record_maps(&self, frame: &mut Recorder<'_>, mirror: usize) {
        if let Some(whole) = &self.whole {
            whole.record(frame, &self.world, mirror);
        }
    }

    /// Primary picture and mirror G-buffer.
    pub(crate) fn begin(&self, frame: &mut Recorder<'_>, variant: Variant) {
        self.primary.record(frame, &self.world, variant);
        let depth = (&self.primary.depth, Begin::Keep);
        let all = 0..self.world.mirrors.len();
        (self.gbuffer).record(frame, GBUFFER, &self.world, all, depth);
    }

    /// The picture with its reflections.
    pub(crate) fn finish(&self, frame: &mut Recorder<'_>) {
        self.composite.record(frame, &self.world);
    }

    /// Reads back the layers of the frame that was rendered last, in [`Variant::AllLayers`]. `paths`: where a
    /// technique follows paths, the length of each pixel's last segment and its reflections.
    pub(crate) fn layers(&self, gpu: &Gpu, paths: Option<&[[f32; 4]]>) -> Frame {
        let read = |texture| gpu.read_texture(texture);
        let xyz = |texel: &[f32; 4]| Vec3::new(texel[0], texel[1], texel[2]);
        let size = self.world.size;
        let image = |texels: &[[f32; 4]]| Image::from_vec(size, texels.iter().map(xyz).collect());
        let ids = |texels: &[[f32; 4]]| {
            let ids = texels.iter().map(|texel| texel[3] as u32).collect();
            Image::from_vec(size, ids)
        };
        let (mut position, mut normal) = (read(&self.primary.position), read(&self.primary.normal));
        let mirror_position = read(&self.gbuffer.position);
        let mirror_normal = read(&self.gbuffer.normal);
        let mut hits = read(&self.reflections.position);
        let mut status = vec![Status::NotMirror; hits.len()];
        let mut distance = vec![0.0; hits.len()];
        for pixel in 0..hits.len() {
            if mirror_position[pixel][3] == 0.0 {
                hits[pixel] = [0.0; 4];
                continue;
            }
            position[pixel] = mirror_position[pixel];
            normal[pixel] = mirror_normal[pixel];
            status[pixel] = match mirror_normal[pixel][3] as u32 {
                2 => Status::Back,
                3 => Status::Below,
                _ if hits[pixel][3] == BELOW => Status::Below,
                _ if hits[pixel][3] < 0.0 => Status::Unresolved,
                _ => Status::Resolved,
            };
            if status[pixel] == Status::Resolved && hits[pixel][3] > 0.0 {
                let first = || xyz(&hits[pixel]).distance(xyz(&mirror_position[pixel]));
                distance[pixel] = paths.map_or_else(first, |paths| paths[pixel][0]);
            } else {
                hits[pixel] = [0.0; 4];
            }
        }
        Frame {
            color: image(&read(&self.composite.color)),
            primary: Some(PrimaryLayers {
                id: ids(&position),
                position: image(&position),
                normal: image(&normal),
            }),
            reflected: Some(Reflected {
                status: Image::from_vec(size, status),
                id: ids(&hits),
                position: image(&hits),
                distance: Image::from_vec(size, distance),
                bounces: paths.map(|paths| {
                    let reflections = paths.iter().map(|path| path[1] as u32);
                    Image::from_vec(size, reflections.collect())
                }),
            }),
            motion: None,
            names: self.world.names(),
        }
    }
}
