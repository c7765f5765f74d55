//! Records: one object a (scene, technique), as written to files and to stdout.
//!
//! `schema/record.schema.json` is derived from these types. A field that does not apply, or was not
//! measured, is `null`, never a made-up 0.

use std::collections::BTreeMap;

use catoptric_frame::{Triangles, Work};
use catoptric_metrics::{
    ColorError, Coverage, Mismatch, More, MotionError, NonFinite, PairedDifference, Regions,
    Summary, Temporal, Timing, VertexReport,
};
use schemars::JsonSchema;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use serde_json::Value;

/// Version of the record's shape.
pub const SCHEMA_VERSION: u32 = 1;

/// What is known about one technique on one scene.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Record {
    /// Version of the record's shape.
    #[schemars(extend("enum" = [SCHEMA_VERSION]))]
    pub schema_version: u32,
    /// Built-in name, or the scene file's stem.
    pub scene: String,
    /// Canonical name with the options that differ from the defaults.
    pub technique: String,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// By which truth the technique is judged.
    #[schemars(extend("enum" = ["first-bounce", "full"]))]
    pub truth: &'static str,
    /// Whether the row holds measurements.
    pub status: Status,
    /// Why it holds none.
    pub reason: Option<String>,
    /// What rendered.
    pub adapter: Option<Adapter>,
    /// Which mirror pixels show something they should.
    pub coverage: Option<Coverage>,
    /// Share of mirror pixels that show the right object.
    pub object_agreement: Option<f64>,
    /// Angle at the mirror between the shown and the true point, degrees.
    pub angular_error_deg: Option<Summary>,
    /// Distance from the true edges of reflected objects to the nearest shown, pixels.
    pub edge_offset_px: Option<Summary>,
    /// Angle between what a mirror pixel's centre and the rest of the pixel truly show, degrees:
    /// what an answer in whole pixels is off by.
    pub pixel_angle_deg: Option<Summary>,
    /// Colour errors on the mirror mask.
    pub color: Option<ColorError>,
    /// Reflection points against the exact ones.
    pub vertices: Option<VertexReport>,
    /// Triangles of a frame.
    pub triangles: Option<Triangles>,
    /// Device-independent cost.
    pub work: Option<Work>,
    /// Shares of the mirror pixels that each cube map resolved, in the order in which a mirror's maps
    /// are tried; of techniques that trace through maps.
    pub resolved_by: Option<Vec<f64>>,
    /// Steadiness from frame to frame.
    pub temporal: Option<Steadiness>,
    /// Where reflections were a frame before, of techniques that say so.
    pub motion: Option<MotionError>,
    /// The same judged by the truth `full`.
    pub against_full: Option<AgainstFull>,
    /// What a frame costs.
    pub time_ms: Option<Times>,
    /// Where the wrong objects are.
    pub mismatch: Option<Mismatch>,
    /// Pixels that no mean includes.
    pub non_finite: Option<NonFinite>,
    /// Rim and interior of the mirrors apart, and the whole picture.
    pub regions: Option<Regions>,
    /// Metrics of the picture that are one number each.
    pub more: Option<More>,
    /// Where the numbers come from.
    pub meta: Meta,
    /// Every timing sample; only in recorded runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub raw: Option<Raw>,
}

/// Whether a row holds measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// It holds measurements.
    Ok,
    /// The technique does not claim to handle the scene, or the scene's model is missing.
    NotApplicable,
    /// Something broke.
    Failed,
}

/// What rendered.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Adapter {
    /// As the driver calls it.
    pub name: String,
    /// Driver and version.
    pub driver: String,
    /// Graphics interface.
    pub backend: String,
    /// A CPU plays the GPU: times say little about a real one.
    pub software: bool,
}

/// The record's `temporal`: how steady a technique is while things move, and what that costs.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Steadiness {
    /// Jitter and jumps of the reflection points.
    #[serde(flatten)]
    pub points: Temporal,
    /// Smallest share of mirror pixels that show the right object, over the frames.
    pub object_agreement_min: Option<f64>,
    /// Most pixels in cracks of the reflected surface that a frame has.
    pub crack_pixels_max: Option<u64>,
    /// Most T-junctions that a frame has; `None` where no triangle is split.
    pub t_junctions_max: Option<u64>,
    /// Triangles of the scene drawn in two frames running and split to another depth in the second, each on each
    /// sheet of images; mean over the frames. `None` where no triangle is split.
    pub triangles_changed: Option<f64>,
    /// Median GPU time of a moving frame in milliseconds; `None` without a usable clock.
    pub frame_ms: Option<f64>,
    /// The same of frames at rest, each in the pose of a moving frame and timed right after it.
    pub still_ms: Option<f64>,
    /// What a moving frame takes more than the one at rest after it; `None` of few frames.
    pub added_ms: Option<PairedDifference>,
    /// Mean evaluations a search, from the second frame on.
    pub evaluations: Option<f64>,
    /// Mean steps a search, from the second frame on.
    pub steps: Option<f64>,
    /// Mean node tests a search or a mirror pixel in the last frame: what a hierarchy is worth by then that was
    /// made for the first.
    pub moved_node_tests: Option<f64>,
}

/// Agreement with the truth in which mirrors are seen in mirrors.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct AgainstFull {
    /// Share of mirror pixels that show the right object.
    pub object_agreement: Option<f64>,
    /// Angle at the mirror between the shown and the true point, degrees.
    pub angular_error_deg: Option<Summary>,
}

/// Times, milliseconds.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Times {
    /// Once, before the first frame.
    pub prepare: f64,
    /// The exact reflection points of the scene's vertices, which searches are compared with; on the CPU.
    pub exact_points: Option<f64>,
    /// GPU time of a frame; `None` without a usable clock.
    pub frame: Option<Timing>,
    /// Median GPU time by pass, in order.
    #[serde(serialize_with = "passes")]
    #[schemars(with = "Option<BTreeMap<String, f64>>")]
    pub passes: Option<Vec<(String, f64)>>,
    /// Why there is no time by pass.
    pub passes_reason: Option<String>,
    /// On the CPU before each frame, to build what it traces; `None` where nothing is built for
    /// each frame. Not part of the others.
    pub build: Option<Timing>,
    /// The technique's own passes in a frame, without those that every technique's frame has, and what it builds on the
    /// CPU before it; `None` without a usable clock.
    pub own: Option<Timing>,
    /// Wall-clock time.
    pub wall: Wall,
}

/// Wall-clock time of a frame, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Wall {
    /// The middle sample.
    pub median: f64,
}

/// Where the numbers come from.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Meta {
    /// The command line.
    pub command: String,
    /// Source revision, where the program was built from a git checkout.
    pub revision: Option<String>,
    /// Of the program.
    pub version: String,
    /// Start of the run, UTC.
    pub date: String,
    /// Of all that influences the picture.
    pub scene_hash: Option<String>,
    /// What the scene is for.
    pub scene_why: Option<String>,
    /// Limit of the truth `full`.
    pub bounces: u32,
    /// Seconds of timing for the scene, shared by the techniques; `None` where nothing is timed.
    pub time_budget_s: Option<f64>,
    /// Which part of a suite was measured, as `2/3`; `None` where it was measured whole.
    pub part: Option<String>,
    /// What a reader of the numbers must know.
    pub notes: Vec<String>,
}

/// Every timing sample, in order, milliseconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Raw {
    /// GPU time.
    pub frame_ms: Vec<f64>,
    /// Wall time.
    pub wall_ms: Vec<f64>,
}

fn passes<S: Serializer>(passes: &Option<Vec<(String, f64)>>, to: S) -> Result<S::Ok, S::Error> {
    let Some(passes) = passes else {
        return to.serialize_none();
    };
    let mut map = to.serialize_map(Some(passes.len()))?;
    for (name, time) in passes {
        map.serialize_entry(name, time)?;
    }
    map.end()
}

impl Record {
    /// A row with nothing measured.
    pub fn empty(scene: &str, technique: &str, resolution: [u32; 2], meta: Meta) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            scene: scene.to_owned(),
            technique: technique.to_owned(),
            resolution,
            truth: "first-bounce",
            status: Status::Ok,
            reason: None,
            adapter: None,
            coverage: None,
            object_agreement: None,
            angular_error_deg: None,
            edge_offset_px: None,
            pixel_angle_deg: None,
            color: None,
            vertices: None,
            triangles: None,
            work: None,
            resolved_by: None,
            temporal: None,
            motion: None,
            against_full: None,
            time_ms: None,
            mismatch: None,
            non_finite: None,
            regions: None,
            more: None,
            meta,
            raw: None,
        }
    }

    /// The same row without measurements, with a reason for that.
    pub fn without(self, status: Status, reason: impl Into<String>) -> Self {
        let empty = Self::empty(&self.scene, &self.technique, self.resolution, self.meta);
        Self {
            status,
            reason: Some(reason.into()),
            adapter: self.adapter,
            ..empty
        }
    }

    /// The row as JSON, without the raw samples.
    pub fn to_value(&self) -> Value {
        let bare = Self {
            raw: None,
            ..self.clone()
        };
        serde_json::to_value(bare).expect("a record has only string keys")
    }
}
