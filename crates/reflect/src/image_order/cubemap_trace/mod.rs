//! Cubemap tracing (Číž 2017, chapter 3): the reflected ray of each mirror pixel is marched through
//! the distances that a few cube maps hold of the scene, and shows the colour found there.
//!
//! Each mirror has maps of its own (`placement`). `march` is the fragment-shader version with its
//! criteria, samplings and skipping (`pyramid`); `lanes` the version for compute shaders; `fill`
//! what becomes of pixels that no map resolves.

mod fill;
mod lanes;
mod march;
mod placement;
mod pyramid;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod variants;

use catoptric_frame::{Image, Traced, Work};
use catoptric_scene::Scene;
use encase::ShaderType;
use glam::DVec3;

use self::fill::Fill;
use self::lanes::Lanes;
use self::march::March;
use self::pyramid::Pyramid;
use super::ImageOrder;
use super::cubemaps::{CubeMaps, Wanted, array_view, maps_layout};
use crate::diagnostics::{Answer, Question};
use crate::error::ReflectError;
use crate::gpu::{FLOAT4, Gpu, Recorder, Slot, group, target, uniform, view};
use crate::spec::Options;
use crate::stage::Stage;
use crate::stage::extent::diagonal;
use crate::stage::variant::Variant;

/// Twin of `Trace` in `shared/rays.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct TraceUniform {
    pub length: f32,
    pub step: f32,
    pub limit: f32,
    pub bias: f32,
    pub coarsest: u32,
    pub finest: u32,
    pub bounces: u32,
}

/// The maps of one mirror and what reads them.
struct MirrorMaps {
    maps: CubeMaps,
    pyramid: Option<Pyramid>,
    /// Group 3 of the passes that trace.
    group: wgpu::BindGroup,
}

struct CubemapTrace {
    /// The maps are drawn anew in every frame.
    every_frame: bool,
    mirrors: Vec<MirrorMaps>,
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

/// Slots of group 3 behind those of the maps: `Trace`, pyramid, normals.
const MORE: &[Slot] = &[Slot::Uniform, Slot::Textures, Slot::Textures];

/// Why options do not go together.
pub(crate) fn objection(options: &Options, scene: &Scene) -> Option<String> {
    let compute = options.is("stage", "compute");
    let needs = |key: &str, values: &[&str]| {
        let value = options.text(key);
        (compute && !values.contains(&value.as_str())).then(|| {
            format!(
                "stage=compute has no {key}={value}, only {}",
                values.join(", ")
            )
        })
    };
    needs("criterion", &["analytic", "distance"])
        .or_else(|| needs("sampling", &["step", "texel"]))
        .or_else(|| needs("pyramid", &["off", "sound"]))
        .or_else(|| needs("bounces", &["1"]))
        .or_else(|| needs("unresolved", &["mark", "background"]))
        .or_else(|| placement::objection(options, scene))
}

fn trace_uniform(options: &Options, scene: &Scene) -> TraceUniform {
    let length = options.number("length") as f32 * diagonal(scene);
    let step = options.number("step") as f32;
    let levels = options.whole("size").ilog2();
    let finest = options.whole("to").min(levels - 1);
    TraceUniform {
        length,
        step,
        limit: options.number("limit") as f32 * step * length,
        bias: options.number("bias") as f32,
        coarsest: options.whole("from").min(finest),
        finest,
        bounces: options.whole("bounces"),
    }
}

pub(crate) fn make(
    gpu: &Gpu,
    options: &Options,
    stage: &Stage,
) -> Result<Box<dyn ImageOrder>, ReflectError> {
    let own_layout = maps_layout(gpu, "cubemap trace", MORE);
    let pyramid = !options.is("pyramid", "off") || options.is("stage", "compute");
    let trace = trace_uniform(options, &stage.world.scene);
    let mut mirrors = Vec::new();
    let places = placement::places(gpu, options, stage)?;
    for (mirror, mut centers) in stage.world.scene.mirrors.iter().zip(places) {
        let traced = centers.len();
        if options.is("unresolved", "environment") {
            centers.push(mirror.shape.center());
        }
        let wanted = Wanted {
            size: options.whole("size"),
            centers,
            traced,
            mirrors: options.whole("bounces") > 1,
        };
        let maps = MirrorMaps::new(gpu, pyramid, &trace, stage, wanted, &own_layout)?;
        mirrors.push(maps);
    }
    let trace_left = options.is("unresolved", "trace");
    let fill = (trace_left || options.is("unresolved", "neighbours"))
        .then(|| Fill::new(gpu, stage, trace_left));
    let effort = target(gpu, "effort", stage.world.size, FLOAT4);
    let tracer = if options.is("stage", "compute") {
        Tracer::Compute(Lanes::new(gpu, options, stage, &own_layout, &effort)?)
    } else {
        Tracer::Fragment(March::new(gpu, options, stage, &own_layout)?)
    };
    let technique = CubemapTrace {
        every_frame: options.is("update", "frame"),
        tracer,
        fill: fill.transpose()?,
        effort,
        mirrors,
    };
    gpu.run(|frame| technique.record_maps(frame, stage));
    Ok(Box::new(technique))
}

/// A place as it may stand in a scene file.
fn written(place: &DVec3) -> String {
    format!("[{:.4}, {:.4}, {:.4}]", place.x, place.y, place.z)
}

impl MirrorMaps {
    fn new(
        gpu: &Gpu,
        pyramid: bool,
        trace: &TraceUniform,
        stage: &Stage,
        wanted: Wanted,
        own_layout: &wgpu::BindGroupLayout,
    ) -> Result<Self, ReflectError> {
        let maps = CubeMaps::new(gpu, stage, wanted)?;
        let pyramid = pyramid.then(|| Pyramid::new(gpu, &maps));
        let pyramid = pyramid.transpose()?;
        let [colors, distances] = maps.views();
        // Where there is no pyramid or normal the shader does not look; some texture must be bound.
        let range = pyramid.as_ref().map_or(&maps.distances, |it| &it.texture);
        let range = array_view(range);
        let normals = array_view(maps.normals.as_ref().unwrap_or(&maps.distances));
        let trace = uniform(gpu, trace);
        let mut resources = maps.resources([&colors, &distances]).to_vec();
        resources.extend([
            trace.as_entire_binding(),
            wgpu::BindingResource::TextureView(&range),
            wgpu::BindingResource::TextureView(&normals),
        ]);
        let group = group(gpu, own_layout, &resources);
        Ok(Self {
            maps,
            pyramid,
            group,
        })
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        self.maps.record(frame, stage);
        if let Some(pyramid) = &self.pyramid {
            pyramid.record(frame);
        }
    }
}

impl CubemapTrace {
    fn has_pyramid(&self) -> bool {
        self.mirrors.iter().any(|mirror| mirror.pyramid.is_some())
    }

    /// What the last frame's rays took, as [`march::traced`] reads it.
    fn traced(&self, gpu: &Gpu) -> Traced {
        let texels = gpu.read_texture(&self.effort);
        let first = self.mirrors.first();
        let maps = first.map_or(0, |mirror| mirror.maps.traced());
        let size = [self.effort.width(), self.effort.height()];
        march::traced(size, &texels, maps)
    }

    fn record_maps(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        for mirror in &self.mirrors {
            mirror.record(frame, stage);
        }
    }
}

impl ImageOrder for CubemapTrace {
    /// Maps stay where they were placed; drawn in every frame, they show what moved.
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        if self.every_frame {
            for mirror in &mut self.mirrors {
                mirror.maps.refresh(gpu, stage);
            }
        }
        let fill = self.fill.as_mut();
        fill.map_or(Ok(()), |fill| fill.update(gpu, stage))
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        if self.every_frame {
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
