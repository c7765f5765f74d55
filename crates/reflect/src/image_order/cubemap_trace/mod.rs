//! Cubemap tracing (Číž 2017, chapter 3): the reflected ray of each mirror pixel is marched through
//! the distances that a few cube maps hold of the scene, and shows the colour found there.
//!
//! Each mirror has maps of its own (`placement`). `march` is the fragment-shader version with its
//! criteria, samplings and skipping (`pyramid`); `lanes` the version for compute shaders; `fill`
//! what becomes of pixels that no map resolves.

mod fill;
mod lanes;
mod maps;
mod march;
mod options;
mod placement;
mod pyramid;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod variants;

use catoptric_frame::{Image, Traced, Work};
use catoptric_scene::Scene;
use glam::DVec3;

use self::fill::Fill;
use self::lanes::Lanes;
use self::maps::{MORE, MirrorMaps, TraceUniform};
use self::march::March;
pub(crate) use self::options::CubemapTrace;
use self::options::{Objects, ShaderStage, Skipping, Unresolved};
use super::cubemaps::{Update, Wanted, bytes, maps_layout};
use super::{ImageOrder, Recipe};
use crate::diagnostics::{Answer, Question};
use crate::error::ReflectError;
use crate::gpu::{FLOAT4, Gpu, Recorder, target, view};
use crate::stage::Stage;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named, Properties};

impl Named for CubemapTrace {
    const INFO: Info = Info {
        name: "cubemap-trace",
        what: "reflected rays marched through a few cube maps of distance",
        paper: "Číž 2017",
    };
}

impl Recipe for CubemapTrace {
    fn objection(&self, scene: &Scene) -> Option<String> {
        CubemapTrace::objection(self).or_else(|| placement::objection(self, scene))
    }

    fn properties(&self) -> Properties {
        Properties {
            may_be_unresolved: true,
            ..Properties::default()
        }
    }

    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError> {
        let technique = Tracing::new(gpu, self, stage)?;
        gpu.run(|frame| technique.record_maps(frame, stage));
        Ok(Box::new(technique))
    }
}

/// Part of its distance from a mirror by which the eye may move before the mirror's maps are placed anew
/// (`objects=auto`).
const MOVED: f64 = 0.1;

/// The technique, ready for a scene.
struct Tracing {
    options: CubemapTrace,
    own_layout: wgpu::BindGroupLayout,
    mirrors: Vec<MirrorMaps>,
    /// From each mirror's centre to the eye when its maps were placed.
    placed_from: Vec<DVec3>,
    tracer: Tracer,
    fill: Option<Fill>,
    /// What rays took, as [`march::traced`] reads it; written with all layers.
    effort: wgpu::Texture,
}

/// Which shader stage follows the rays.
enum Tracer {
    Fragment(March),
    Compute(Lanes),
}

/// A place as it may stand in a scene file.
fn written(place: &DVec3) -> String {
    format!("[{:.4}, {:.4}, {:.4}]", place.x, place.y, place.z)
}

fn eye_from_mirrors(scene: &Scene) -> Vec<DVec3> {
    let mirrors = scene.mirrors.iter();
    let from = mirrors.map(|mirror| scene.camera.eye - mirror.shape.center());
    from.collect()
}

/// The maps of all mirrors, placed but not drawn yet.
fn mirrors_maps(
    gpu: &Gpu,
    options: &CubemapTrace,
    stage: &Stage,
    own_layout: &wgpu::BindGroupLayout,
) -> Result<Vec<MirrorMaps>, ReflectError> {
    let pyramid = options.stage == ShaderStage::Compute || options.pyramid != Skipping::Off;
    let scene = &stage.world.scene;
    let trace = TraceUniform::new(options, scene);
    let size = options.maps.size.texels();
    let fit = |count| gpu.check_memory(bytes(size, count, options.mirrors_in()));
    // Before places are looked for, which takes long where there are many mirrors.
    fit(scene.mirrors.len() * options.objects.number().unwrap_or(1))?;
    let places = placement::places(gpu, options, stage)?;
    fit(places.iter().map(Vec::len).sum())?;
    let placed = scene.mirrors.iter().zip(places);
    let maps = placed.map(|(mirror, mut centers)| {
        let traced = centers.len();
        if options.unresolved == Unresolved::Environment {
            centers.push(mirror.shape.center());
        }
        let wanted = Wanted {
            size,
            centers,
            traced,
            mirrors: options.mirrors_in(),
        };
        MirrorMaps::new(gpu, pyramid, &trace, stage, wanted, own_layout)
    });
    maps.collect()
}

impl Tracing {
    fn new(gpu: &Gpu, options: &CubemapTrace, stage: &Stage) -> Result<Self, ReflectError> {
        let own_layout = maps_layout(gpu, "cubemap trace", MORE);
        let mirrors = mirrors_maps(gpu, options, stage, &own_layout)?;
        let fill = match options.unresolved {
            Unresolved::Trace => Some(Fill::new(gpu, stage, true)?),
            Unresolved::Neighbours => Some(Fill::new(gpu, stage, false)?),
            _ => None,
        };
        let effort = target(gpu, "effort", stage.world.size, FLOAT4);
        let tracer = if options.stage == ShaderStage::Compute {
            Tracer::Compute(Lanes::new(gpu, options, stage, &own_layout, &effort)?)
        } else {
            Tracer::Fragment(March::new(gpu, options, stage, &own_layout)?)
        };
        Ok(Self {
            options: *options,
            placed_from: eye_from_mirrors(&stage.world.scene),
            own_layout,
            tracer,
            fill,
            effort,
            mirrors,
        })
    }

    /// The view has moved so far that other places may serve it better.
    fn has_moved(&self, scene: &Scene) -> bool {
        let pairs = self.placed_from.iter().zip(eye_from_mirrors(scene));
        let mut pairs = pairs.map(|(from, to)| from.distance(to) > MOVED * from.length());
        pairs.any(|moved| moved)
    }

    /// The maps are drawn anew in every frame.
    fn draws_every_frame(&self) -> bool {
        self.options.maps.update == Update::Frame
    }

    fn has_pyramid(&self) -> bool {
        self.mirrors.iter().any(|mirror| mirror.pyramid.is_some())
    }

    /// What the last frame's rays took, as [`march::traced`] reads it.
    fn traced(&self, gpu: &Gpu) -> Traced {
        let texels = gpu.read_texture(&self.effort);
        let maps = self.mirrors.iter().map(|mirror| mirror.maps.traced());
        let maps = maps.max().unwrap_or(0);
        let size = [self.effort.width(), self.effort.height()];
        march::traced(size, &texels, maps)
    }

    fn record_maps(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        for mirror in &self.mirrors {
            mirror.record(frame, stage);
        }
    }
}

impl ImageOrder for Tracing {
    /// Maps stay where they were placed, unless they are placed by what the view needs; drawn in every
    /// frame, they show what moved.
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        let scene = &stage.world.scene;
        if self.options.objects == Objects::Auto && self.has_moved(scene) {
            self.mirrors = mirrors_maps(gpu, &self.options, stage, &self.own_layout)?;
            self.placed_from = eye_from_mirrors(scene);
            gpu.run(|frame| self.record_maps(frame, stage));
        } else if self.draws_every_frame() {
            let trace = TraceUniform::new(&self.options, scene);
            for mirror in &mut self.mirrors {
                mirror.refresh(gpu, &trace, stage);
            }
        }
        let fill = self.fill.as_mut();
        fill.map_or(Ok(()), |fill| fill.update(gpu, stage))
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        if self.draws_every_frame() {
            self.record_maps(frame, stage);
        }
        let groups: Vec<_> = self.mirrors.iter().map(|mirror| &mirror.group).collect();
        let effort = view(&self.effort);
        match &self.tracer {
            Tracer::Fragment(march) => {
                let targets = match &self.fill {
                    Some(fill) => [view(&fill.color), view(&fill.position)],
                    None => stage.reflections.views(),
                };
                march.record(frame, stage, variant, &groups, &targets);
                if variant == Variant::AllLayers {
                    march.record_effort(frame, stage, &groups, &effort);
                }
            }
            Tracer::Compute(lanes) => lanes.record(frame, stage, variant, &groups, &effort),
        }
        if let Some(fill) = &self.fill {
            fill.record(frame, stage, variant);
        }
    }

    fn work(&self, gpu: &Gpu, _: &Stage) -> Work {
        let traced = self.traced(gpu);
        let pixels = traced.pixels() as f64;
        let mean = |counts: &Image<u32>| {
            let sum: f64 = counts.pixels().iter().map(|n| f64::from(*n)).sum();
            (pixels > 0.0).then(|| sum / pixels)
        };
        Work {
            samples: mean(&traced.samples),
            node_tests: mean(&traced.node_tests).filter(|_| self.has_pyramid()),
            skips: mean(&traced.skips),
            ..Work::default()
        }
    }

    fn answer(&self, gpu: &Gpu, stage: &Stage, question: Question) -> Option<Answer> {
        match question {
            Question::Traced => Some(Answer::Traced(self.traced(gpu))),
            Question::DistanceLevels => {
                let mirror = self.mirrors.first()?;
                let pyramid = mirror.pyramid.as_ref()?;
                let far = mirror.maps.far(&stage.world.scene);
                let levels = pyramid.levels(gpu, &mirror.maps, far);
                Some(Answer::DistanceLevels(levels))
            }
            Question::Path { .. } => None,
        }
    }

    fn notes(&self, gpu: &Gpu, stage: &Stage) -> Vec<String> {
        let mirrors = stage.world.scene.mirrors.iter().zip(&self.mirrors);
        let mut notes: Vec<String> = mirrors
            .map(|(mirror, its)| {
                let places: Vec<_> = its.maps.centers().iter().map(written).collect();
                format!("maps of {}: {}", mirror.name, places.join(", "))
            })
            .collect();
        let traced = self.traced(gpu);
        let pixels = traced.pixels().max(1) as f64;
        let share = |count: u64| format!("{:.2} %", 100.0 * count as f64 / pixels);
        let by_map: Vec<_> = traced.resolved_by.iter().map(|n| share(*n)).collect();
        notes.push(format!(
            "resolved in the first map and those after it: {}; in none: {}",
            by_map.join(", "),
            share(traced.unresolved)
        ));
        if let Tracer::Compute(lanes) = &self.tracer {
            notes.push(lanes.agreement().to_owned());
        }
        notes
    }
}
