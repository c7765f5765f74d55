//! Search in a watertight hierarchy over the cells between the reflected rays of neighbouring pixels, for all
//! reflections of a vertex: swept boxes.
//!
//! Positions and directions are interpolated inside a cell from its corners, so that each point of a
//! reflected ray lies in the box of the corners' rays, swept along the directions. Neighbouring cells share
//! corners, so there are no holes: a reflection that the search does not find is not in the interpolated
//! mirror. Solutions are told apart by the number of focal points of the beam before the vertex; each number
//! is a sheet. Triangles are drawn from both sides, so that those between two focal points, which are turned
//! over, need no special treatment.
//!
//! Work is counted thus: a step and an evaluation are a cell that is searched, a node test is a box.

mod nodes;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod twin;

use encase::{ShaderSize, ShaderType};
use glam::UVec2;

use super::{Context, Pipelines, Recipe, Search, Sheet};
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, module, set_uniform, storage_zeros,
    uniform, view,
};
use crate::options::{Words, options, words};
use crate::stage::Stage;
use crate::stage::extent::diagonal;
use crate::stage::points::{Found, Points};
use crate::stage::variant::Variant;
use crate::technique::{Info, Named, Properties};
use nodes::Nodes;

words! {
    /// How many slices a node has: boxes around its rays' points at a distance.
    pub(crate) enum Slices {
        /// On mirrors that are not convex, and of those where rays converge.
        Auto = "auto",
        None = "0",
        One = "1",
        Two = "2",
        Three = "3",
        Four = "4",
        Six = "6",
        Eight = "8",
    }
}

impl Slices {
    /// Slices of `auto`.
    const AUTO: u32 = 2;

    /// Room for slices, on mirrors of which some are not convex.
    fn room(self, convex: bool) -> u32 {
        match self {
            Self::Auto if convex => 0,
            Self::Auto => Self::AUTO,
            other => other.word().parse().expect("a number"),
        }
    }
}

words! {
    /// Which reflections of a vertex are looked for.
    pub(crate) enum Sheets {
        /// Every one; on a convex mirror there is only one.
        All = "all",
        /// The first that is met.
        First = "first",
    }
}

words! {
    /// Where a search starts.
    pub(crate) enum Start {
        /// At the top of the hierarchy.
        Top = "top",
        /// Around the vertex's answer in the previous frame, where there is one and no other is looked for.
        Previous = "previous",
    }
}

options! {
    /// The search, as its options describe it.
    pub(crate) struct SweptBoxes {
        /// boxes around the points of a node's rays at so many distances where rays converge; auto: two, and
        /// none on convex mirrors
        slices: Slices,
        /// all reflections of a vertex, each drawn on the sheet of those with as many focal points before the
        /// vertex, or the first that is met
        sheets: Sheets,
        /// from the top of the hierarchy, or where a vertex has one answer around that of the previous frame
        start: Start,
    }
}

impl Named for SweptBoxes {
    const INFO: Info = Info {
        name: "swept-boxes",
        what: "watertight hierarchy over cells between rays, all solutions",
        paper: "this project",
    };
}

impl Recipe for SweptBoxes {
    fn properties(&self) -> Properties {
        Properties {
            carries_over: self.start == Start::Previous,
            ..Properties::default()
        }
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
        Ok(Box::new(InBoxes::new(self, context)?))
    }
}

/// Twin of `Settings` in `swept_boxes/node.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct Settings {
    /// By which boxes grow, world units.
    wider: f32,
    /// The highest level.
    top: u32,
    /// Nodes of that level.
    tops: UVec2,
    /// Texels of a node.
    block: UVec2,
    /// 1: the first solution is the answer.
    first: u32,
    /// The sheet that is answered for.
    sheet: u32,
    /// Answers of a sheet in the list of all sheets.
    stride: u32,
}

/// Boxes grow by this share of the scene's extent: more than single precision rounds.
const WIDER: f32 = 4e-6;

/// Sheets of a mirror that is not convex: none, one and two focal points before the vertex, and as many for
/// further solutions with the same number.
const SHEETS: usize = 6;

/// The search, ready for a scene.
struct InBoxes {
    nodes: Nodes,
    /// For one sheet, or where there is only one.
    single: Pipelines,
    /// For all sheets of a mirror at once, and what hands the answers out: plain and counting.
    all: Option<(Pipelines, [Kernel; 2])>,
    /// One a mirror and sheet: settings and group 3.
    sheets: Vec<Vec<(wgpu::Buffer, wgpu::BindGroup)>>,
    first: bool,
    stride: u32,
}

impl InBoxes {
    fn new(options: &SweptBoxes, context: &Context<'_>) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let world = &stage.world;
        let convex: Vec<bool> = (world.scene.mirrors.iter())
            .map(|mirror| mirror.shape.is_convex())
            .collect();
        let all_convex = convex.iter().all(|convex| *convex);
        let nodes = Nodes::new(gpu, stage, options.slices.room(all_convex), context.extends)?;
        let only_first = options.sheets == Sheets::First;
        let slots = [
            Slot::Uniform,
            Slot::Read,
            Slot::Texture,
            Slot::Texture,
            Slot::Texture,
            Slot::Write,
        ];
        let own = layout(gpu, "swept boxes", &slots);
        let several = !only_first && !all_convex;
        let stride = if several { world.vertices() } else { 0 };
        let answers = u64::from(stride) * SHEETS as u64 * Found::SHADER_SIZE.get();
        gpu.check_memory(answers)?;
        let answers = storage_zeros(gpu, answers);
        gpu.check()?;
        let program = "swept_boxes/search";
        let warm = (options.start == Start::Previous).then_some("warm");
        let extend = context.extends.then_some("extend");
        let features: Vec<_> = extend.into_iter().chain(warm).collect();
        let all = if several {
            let features: Vec<_> = extend.into_iter().chain(["all"]).collect();
            let pipelines = Pipelines::new(context, program, &features, &own)?;
            let spread = |features: &[&str]| -> Result<_, ReflectError> {
                let layouts = [None, None, Some(context.points_layout), Some(&own)];
                Ok(compute(
                    gpu,
                    &module(gpu, program, features)?,
                    "spread",
                    &layouts,
                ))
            };
            Some((pipelines, [spread(&["all"])?, spread(&["all", "count"])?]))
        } else {
            None
        };
        let mut made = Self {
            single: Pipelines::new(context, program, &features, &own)?,
            all,
            sheets: Vec::new(),
            first: only_first,
            stride,
            nodes,
        };
        let sheets = |convex: &bool| {
            let one = only_first || *convex;
            let sheets = 0..if one { 1 } else { SHEETS };
            let sheet = |number: usize| {
                let settings = uniform(gpu, &made.settings(stage, number, one));
                let [points, directions] = made.nodes.rays().each_ref().map(view);
                let boxes = view(made.nodes.boxes());
                let resources = [
                    settings.as_entire_binding(),
                    made.nodes.slices().as_entire_binding(),
                    wgpu::BindingResource::TextureView(&boxes),
                    wgpu::BindingResource::TextureView(&points),
                    wgpu::BindingResource::TextureView(&directions),
                    answers.as_entire_binding(),
                ];
                let group = group(gpu, &own, &resources);
                (settings, group)
            };
            sheets.map(sheet).collect()
        };
        made.sheets = convex.iter().map(sheets).collect();
        Ok(made)
    }

    fn settings(&self, stage: &Stage, sheet: usize, one: bool) -> Settings {
        let (top, tops) = self.nodes.top();
        Settings {
            wider: WIDER * diagonal(&stage.world.scene),
            top,
            tops: UVec2::from_array(tops),
            block: UVec2::from_array(self.nodes.block()),
            first: u32::from(self.first || one),
            sheet: sheet as u32,
            stride: self.stride,
        }
    }
}

impl Search for InBoxes {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        for sheets in &self.sheets {
            for (number, (buffer, _)) in sheets.iter().enumerate() {
                set_uniform(
                    gpu,
                    buffer,
                    &self.settings(stage, number, sheets.len() == 1),
                );
            }
        }
    }

    fn sheets(&self, mirror: usize) -> usize {
        self.sheets[mirror].len()
    }

    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage, mirror: usize) {
        self.nodes.record(frame, stage, mirror);
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        points: &Points,
        variant: Variant,
    ) {
        let (_, own) = &self.sheets[sheet.mirror][sheet.number];
        (self.single).record(frame, (stage, sheet.mirror), points, own, variant);
    }

    fn record_sheets(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheets: &[Sheet],
        batches: &[&Points],
        variant: Variant,
    ) {
        let (Some((search, [plain, counting])), [first, _, ..]) = (&self.all, sheets) else {
            for (sheet, points) in sheets.iter().zip(batches) {
                self.record_search(frame, stage, *sheet, points, variant);
            }
            return;
        };
        let groups = &self.sheets[first.mirror];
        let (_, own) = &groups[0];
        search.record(frame, (stage, first.mirror), batches[0], own, variant);
        let spread = match variant {
            Variant::AllLayers => counting,
            Variant::Color => plain,
        };
        frame.compute("search", |pass| {
            pass.set_pipeline(spread);
            for ((_, own), points) in groups.iter().zip(batches) {
                pass.set_bind_group(2, &points.group, &[]);
                pass.set_bind_group(3, own, &[]);
                points.run(pass, spread);
            }
        });
    }
}
