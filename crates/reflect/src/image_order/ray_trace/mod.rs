//! The control: the reference's reflected rays, traced on the GPU in `f32` over the objects' triangles, not the mirrors
//! (truth `first-bounce`). Its differences from the reference are the harness's own noise; its time is what an
//! application would pay for ray tracing instead of any other technique.
//!
//! With `traversal=shader` a shader walks obvhs's hierarchy; with `hardware` ray queries walk the driver's own
//! structure. With `update=frame` either is built for each frame, as for a scene that deforms: obvhs's on the CPU
//! before the frame, the driver's on the GPU in a pass `build`. With `update=refit` obvhs's is built once, and in each
//! frame its boxes are refitted on the GPU in a pass `refit`, whether something has moved or not.

mod hardware;
mod refit;
mod wide;

use catoptric_frame::Work;
use catoptric_scene::Scene;

use super::{ImageOrder, Recipe};
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, module, storage_zeros, view,
};
use crate::options::{options, words};
use crate::stage::Stage;
use crate::stage::variant::Variant;
use crate::technique::{Built, Info, Named, Properties};

use hardware::Hardware;
use refit::Refitted;
use wide::Wide;

words! {
    /// What goes through the hierarchy.
    pub(crate) enum Traversal {
        Shader = "shader",
        /// Ray queries.
        Hardware = "hardware",
    }
}

words! {
    /// When the hierarchy is built.
    pub(crate) enum Update {
        /// When something has moved.
        Static = "static",
        /// For every frame.
        Frame = "frame",
        /// Once; in every frame its boxes are fitted anew.
        Refit = "refit",
    }
}

options! {
    pub(crate) struct RayTrace {
        /// what goes through the hierarchy: a shader (obvhs's), or ray queries in hardware where the adapter has them (the driver's)
        traversal: Traversal,
        /// whether the hierarchy is built when something has moved, for every frame, or once, its boxes fitted anew in every frame (a shader's alone)
        update: Update,
    }
}

impl Named for RayTrace {
    const INFO: Info = Info {
        name: "ray-trace",
        what: "the control: the reference's rays on the GPU",
        paper: "control",
    };
}

impl Recipe for RayTrace {
    fn objection(&self, _: &Scene) -> Option<String> {
        let refits = self.update == Update::Refit && self.traversal == Traversal::Hardware;
        let reason =
            "update=refit: the driver's own structure is not fitted anew; take update=frame";
        refits.then(|| reason.to_owned())
    }

    fn properties(&self) -> Properties {
        Properties {
            is_control: true,
            ..Properties::default()
        }
    }

    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError> {
        let scene = &stage.world.scene;
        let structure = match self.traversal {
            Traversal::Shader if self.update == Update::Refit => {
                Structure::Refitted(Box::new(Refitted::new(gpu, stage)?))
            }
            Traversal::Shader => Structure::Wide(Wide::new(gpu, scene)?),
            Traversal::Hardware if gpu.info().ray_queries => {
                let structure = Hardware::new(gpu, scene);
                gpu.run(|frame| structure.build(frame));
                Structure::Hardware(Box::new(structure))
            }
            Traversal::Hardware => return Err(ReflectError::Adapter("offers no ray queries")),
        };
        let every_frame = self.update == Update::Frame;
        let rays = Rays::new(gpu, stage, structure, every_frame, Extra::Nothing)?;
        Ok(Box::new(rays))
    }
}

/// The pass `trace`, for all mirror pixels or for those that another technique leaves open.
pub(crate) struct Rays {
    layout: wgpu::BindGroupLayout,
    trace: Kernel,
    counting: Kernel,
    structure: Structure,
    every_frame: bool,
    /// Nodes and triangles tested, a pair of `u32` a pixel.
    counts: wgpu::Buffer,
    extra: Extra,
    group: wgpu::BindGroup,
}

/// What the pass reads or writes besides.
enum Extra {
    Nothing,
    /// Colours of a technique before, −1 in w where it has no answer; all others are left alone.
    LeftOpen(wgpu::TextureView),
    /// Where each ray meets which triangle, as `ray_trace/trace.wesl` has it.
    Hits(wgpu::TextureView),
}

impl Extra {
    fn view(&self) -> Option<&wgpu::TextureView> {
        match self {
            Self::Nothing => None,
            Self::LeftOpen(view) | Self::Hits(view) => Some(view),
        }
    }
}

/// What the rays are traced through.
enum Structure {
    Wide(Wide),
    Refitted(Box<Refitted>),
    Hardware(Box<Hardware>),
}

impl Structure {
    /// Bytes of nodes and triangles; `None` where the driver has them.
    fn bytes(&self) -> Option<u64> {
        let (nodes, triangles) = match self {
            Self::Wide(wide) => (&wide.nodes, &wide.triangles),
            Self::Refitted(refitted) => (&refitted.nodes, &refitted.triangles),
            Self::Hardware(_) => return None,
        };
        Some(nodes.size() + triangles.size())
    }
}

impl Rays {
    /// Rays for those pixels alone where the image `left_open` has −1 in w.
    pub(crate) fn of_pixels(
        gpu: &Gpu,
        stage: &Stage,
        left_open: &wgpu::Texture,
    ) -> Result<Self, ReflectError> {
        let structure = Structure::Wide(Wide::new(gpu, &stage.world.scene)?);
        let extra = Extra::LeftOpen(view(left_open));
        Self::new(gpu, stage, structure, false, extra)
    }

    /// Rays that tell also which triangle each meets, and where: into the image `hits`.
    pub(crate) fn keeping_hits(
        gpu: &Gpu,
        stage: &Stage,
        hits: &wgpu::Texture,
    ) -> Result<Self, ReflectError> {
        let structure = Structure::Wide(Wide::new(gpu, &stage.world.scene)?);
        Self::new(gpu, stage, structure, false, Extra::Hits(view(hits)))
    }

    fn new(
        gpu: &Gpu,
        stage: &Stage,
        structure: Structure,
        every_frame: bool,
        extra: Extra,
    ) -> Result<Self, ReflectError> {
        let mut slots = vec![Slot::Image, Slot::Image, Slot::Write];
        let mut features = Vec::new();
        match &structure {
            Structure::Wide(_) | Structure::Refitted(_) => {
                slots.extend([Slot::Read, Slot::Read]);
            }
            Structure::Hardware(_) => {
                slots.push(Slot::Structure);
                features.push("hardware");
            }
        }
        match &extra {
            Extra::Nothing => {}
            Extra::LeftOpen(_) => {
                slots.push(Slot::Texture);
                features.push("fallback");
            }
            Extra::Hits(_) => {
                slots.push(Slot::Image);
                features.push("keep_hit");
            }
        }
        let layout = layout(gpu, "ray trace", &slots);
        let pipeline = |features: &[&str]| -> Result<_, ReflectError> {
            let layouts = [
                Some(&stage.world.view_layout),
                Some(&stage.gbuffer.mirror_layout),
                Some(&stage.world.surface_layout),
                Some(&layout),
            ];
            let module = module(gpu, "ray_trace/trace", features)?;
            Ok(compute(gpu, &module, "reflections", &layouts))
        };
        let [width, height] = stage.world.size.map(u64::from);
        let counts = storage_zeros(gpu, width * height * 8);
        gpu.check()?;
        let trace = pipeline(&features)?;
        features.push("count");
        Ok(Self {
            trace,
            counting: pipeline(&features)?,
            group: bind(gpu, &layout, &structure, stage, &counts, extra.view()),
            extra,
            layout,
            structure,
            every_frame,
            counts,
        })
    }

    /// Takes the scene's triangles as they are now; what is fitted anew in the frame only learns which of them
    /// coincide.
    fn rebuild(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        self.structure = match &self.structure {
            Structure::Refitted(structure) => {
                structure.update(gpu, &stage.world.scene);
                return Ok(());
            }
            Structure::Wide(_) => Structure::Wide(Wide::new(gpu, &stage.world.scene)?),
            Structure::Hardware(_) => {
                Structure::Hardware(Box::new(Hardware::new(gpu, &stage.world.scene)))
            }
        };
        if let Structure::Hardware(structure) = &self.structure {
            gpu.run(|frame| structure.build(frame));
        }
        let (layout, extra) = (&self.layout, self.extra.view());
        self.group = bind(gpu, layout, &self.structure, stage, &self.counts, extra);
        Ok(())
    }

    /// A pass with a thread for each of so many pixels, from the image's corner.
    fn dispatch(
        &self,
        frame: &mut Recorder<'_>,
        (name, stage, variant): (&str, &Stage, Variant),
        pixels: [u32; 2],
    ) {
        let kernel = match variant {
            Variant::AllLayers => &self.counting,
            Variant::Color => &self.trace,
        };
        let [width, height] = kernel.groups_over(pixels);
        frame.compute(name, |pass| {
            pass.set_pipeline(kernel);
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.gbuffer.mirror_groups[0], &[]);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, &self.group, &[]);
            pass.dispatch_workgroups(width, height, 1);
        });
    }
}

fn bind(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    structure: &Structure,
    stage: &Stage,
    counts: &wgpu::Buffer,
    extra: Option<&wgpu::TextureView>,
) -> wgpu::BindGroup {
    let color = view(&stage.reflections.color);
    let position = view(&stage.reflections.position);
    let mut resources = vec![
        wgpu::BindingResource::TextureView(&color),
        wgpu::BindingResource::TextureView(&position),
        counts.as_entire_binding(),
    ];
    match structure {
        Structure::Wide(wide) => resources.extend([
            wide.nodes.as_entire_binding(),
            wide.triangles.as_entire_binding(),
        ]),
        Structure::Refitted(structure) => resources.extend([
            structure.nodes.as_entire_binding(),
            structure.triangles.as_entire_binding(),
        ]),
        Structure::Hardware(structure) => resources.push(structure.tlas.as_binding()),
    }
    resources.extend(extra.map(wgpu::BindingResource::TextureView));
    group(gpu, layout, &resources)
}

impl ImageOrder for Rays {
    /// Builds the structure anew, or leaves it to be fitted: any object may have moved.
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        self.rebuild(gpu, stage)
    }

    fn begin_frame(&mut self, gpu: &Gpu, stage: &Stage) -> Result<Built, ReflectError> {
        if self.every_frame && matches!(self.structure, Structure::Wide(_)) {
            self.rebuild(gpu, stage)?;
            return Ok(Built::OnTheCpu);
        }
        Ok(Built::Nothing)
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        if let Structure::Refitted(structure) = &self.structure {
            structure.record(frame);
        }
        if let Structure::Hardware(structure) = &self.structure
            && self.every_frame
        {
            structure.build(frame);
            // The stamp at the end of a pass that uses the structure is the end of its build.
            self.dispatch(frame, ("build", stage, variant), [1, 1]);
        }
        self.dispatch(frame, ("trace", stage, variant), stage.world.size);
    }

    /// Nodes as `node_tests`, triangles as `evaluations`; hardware does not tell.
    fn work(&self, gpu: &Gpu, stage: &Stage) -> Work {
        if matches!(self.structure, Structure::Hardware(_)) {
            return Work::default();
        }
        let counts: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&gpu.read_buffer(&self.counts));
        let mirrors = gpu.read_texture(&stage.gbuffer.position);
        let pixels = mirrors.iter().filter(|texel| texel[3] > 0.0).count();
        let mean = |index: usize| {
            let counts = counts.iter().map(|count| f64::from(count[index]));
            (pixels > 0).then(|| counts.sum::<f64>() / pixels as f64)
        };
        Work {
            node_tests: mean(0),
            evaluations: mean(1),
            bytes: self.structure.bytes().map(|bytes| bytes as f64),
            ..Work::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{gpu_or_skip, scene, stage};
    use crate::{Prefer, parse};

    /// Object ids at the mirror's pixels.
    fn ids(gpu: &Gpu, technique: &Rays, stage: &Stage) -> Vec<u32> {
        gpu.run(|frame| {
            stage.begin(frame, Variant::AllLayers);
            technique.record(frame, stage, Variant::AllLayers);
            stage.finish(frame);
        });
        let texels = gpu.read_texture(&stage.reflections.position);
        texels.iter().map(|texel| texel[3] as u32).collect()
    }

    #[test]
    fn the_picture_comes_from_the_triangles_in_the_hierarchy() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-square");
        let stage = stage(&gpu, &scene, [96, 72]);
        let wide = Wide::new(&gpu, &stage.world.scene).expect("fits the device");
        let structure = Structure::Wide(wide);
        let technique = Rays::new(&gpu, &stage, structure, false, Extra::Nothing).expect("links");
        let before = ids(&gpu, &technique, &stage);
        assert!(before.contains(&1), "the square is reflected");
        assert_eq!(before, ids(&gpu, &technique, &stage));
        // The first triangle of the copy becomes a point.
        let Structure::Wide(wide) = &technique.structure else {
            unreachable!("made above")
        };
        gpu.queue.write_buffer(&wide.triangles, 0, &[0; 48]);
        let after = ids(&gpu, &technique, &stage);
        let lost = before
            .iter()
            .zip(&after)
            .filter(|(a, b)| **a == 1 && **b == 0);
        let seen = before.iter().filter(|id| **id == 1).count();
        assert!(lost.count() > seen / 5, "{seen} pixels showed the square");
    }

    #[test]
    #[ignore = "needs an adapter with ray queries, as few software ones are"]
    fn both_traversals_see_the_same() {
        let gpu = Gpu::new(None, Prefer::Software).expect("an adapter");
        assert!(gpu.info().ray_queries, "{}", gpu.info().driver);
        let scene = scene("sphere-objects-1k");
        let seen = |name: &str| {
            let spec = parse(name).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [96, 72]).expect("fits");
            let frame = prepared.render().expect("renders").frame;
            frame.reflected.expect("all layers").id
        };
        let software = seen("ray-trace");
        for name in [
            "ray-trace(traversal=hardware)",
            "ray-trace(traversal=hardware,update=frame)",
        ] {
            let hardware = seen(name);
            let pairs = software.pixels().iter().zip(hardware.pixels());
            let other = pairs.filter(|(a, b)| a != b).count();
            // Rays through an edge may fall to either side.
            assert!(other <= 2, "{name}: {other} pixels");
        }
    }

    /// Ids at the mirrors' pixels and node tests a pixel, frame by frame.
    fn followed(gpu: &Gpu, scene: &Scene, name: &str, frames: &[u32]) -> Vec<(Vec<u32>, f64)> {
        let spec = parse(name).expect("a technique");
        let mut prepared = crate::prepare(gpu, &spec, scene, [96, 72]).expect("fits");
        let frames = frames.iter().map(|frame| {
            prepared.update(&scene.at(*frame)).expect("the same scene");
            let output = prepared.render().expect("renders");
            let seen = output.frame.reflected.expect("all layers").id;
            let nodes = output.work.node_tests.expect("counted");
            (seen.pixels().to_vec(), nodes)
        });
        frames.collect()
    }

    #[test]
    fn a_refitted_hierarchy_shows_what_a_new_one_does() {
        let Some(gpu) = gpu_or_skip() else { return };
        for name in [
            "moving-ball-object",
            "parting",
            "sphere-objects-1k",
            "ellipsoid",
        ] {
            let scene = scene(name);
            let last = scene.frames() - 1;
            let frames = [0, last / 2, last, 0];
            let [built, refitted] = ["ray-trace", "ray-trace(update=refit)"]
                .map(|technique| followed(&gpu, &scene, technique, &frames));
            for (frame, (built, refitted)) in built.iter().zip(&refitted).enumerate() {
                assert!(built.0.iter().any(|id| *id > 0));
                assert_eq!(built.0, refitted.0, "{name}, {frame}");
            }
        }
    }

    #[test]
    fn a_refitted_hierarchy_is_worse_where_neighbours_part() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("parting");
        let frames = [0, scene.frames() - 1];
        let [built, refitted] = ["ray-trace", "ray-trace(update=refit)"]
            .map(|technique| followed(&gpu, &scene, technique, &frames));
        let worse = |frame: usize| refitted[frame].1 / built[frame].1;
        println!("{} at first, {} at last", worse(0), worse(1));
        // Boxes are rounded otherwise.
        assert!((0.9..1.1).contains(&worse(0)), "{}", worse(0));
        assert!(worse(1) > 1.3, "{}", worse(1));
    }

    #[test]
    fn a_refit_is_a_pass_of_the_frame() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-square");
        let spec = parse("ray-trace(update=refit)").expect("a technique");
        let mut prepared = crate::prepare(&gpu, &spec, &scene, [32, 24]).expect("fits");
        let time = prepared.time_frame().expect("renders");
        assert_eq!(time.build_ms, None);
        let passes = time.passes.unwrap_or_default();
        assert!(passes.is_empty() || passes.iter().any(|(name, _)| name == "refit"));
        let hardware = parse("ray-trace(update=refit,traversal=hardware)").expect("a technique");
        assert_ne!(crate::supports(&hardware, &scene), crate::Support::Yes);
    }

    #[test]
    fn what_is_built_for_each_frame_is_timed_apart() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-square");
        for (name, built) in [("ray-trace", false), ("ray-trace(update=frame)", true)] {
            let spec = parse(name).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [32, 24]).expect("fits");
            let time = prepared.time_frame().expect("renders");
            assert_eq!(time.build_ms.is_some(), built, "{name}");
        }
    }
}
