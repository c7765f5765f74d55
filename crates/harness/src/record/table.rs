//! The one table of metrics: one row per number, or per family of numbers that have the same members
//! in several places. Tables, pages, plots, `--against`, `--require`, CSV and the schema read it.

use super::metric::Better::{High, Low, Neither};
use super::metric::Unit::{Count, Decibels, Degrees, Milliseconds, Pixels, Plain, Share};
use super::metric::{Better, Metric, Unit};

use self::Entry::{Family, One};

/// A row: a number, or a family of them.
pub enum Entry {
    /// One number, and whether `--against` judges it.
    One(Row, bool),
    /// The members of a family at a place, and which of them `--against` judges.
    Family(Row, &'static [Row], &'static [&'static str]),
}

/// What a number is; of a family, what all its members are.
pub struct Row {
    /// Where it stands; of a member, inside its family.
    path: &'static str,
    /// Over a column.
    heading: &'static str,
    /// At an axis; of a member, with `{}` for the family's name.
    name: &'static str,
    unit: Unit,
    better: Better,
    /// A sentence; of a member, with `{}` for the family's words.
    what: &'static str,
}

const fn row(
    path: &'static str,
    heading: &'static str,
    name: &'static str,
    unit: Unit,
    better: Better,
    what: &'static str,
) -> Row {
    Row {
        path,
        heading,
        name,
        unit,
        better,
        what,
    }
}

/// Members of [`catoptric_metrics::Summary`]; unit and direction are the family's.
#[rustfmt::skip] // A row reads better as a row.
const SUMMARY: &[Row] = &[
    row("mean", "", "mean {}", Plain, Low, "Mean of {}."),
    row("p50", "p50", "median {}", Plain, Low, "Median of {}."),
    row("p95", "p95", "95th percentile of the {}", Plain, Low, "95th percentile of {}."),
    row("p99", "p99", "99th percentile of the {}", Plain, Low, "99th percentile of {}."),
    row("max", "max", "largest {}", Plain, Low, "Largest value of {}."),
];

/// Members of [`catoptric_metrics::TrueMotion`].
#[rustfmt::skip] // A row reads better as a row.
const TRUE_MOTION: &[Row] = &[
    row("p50", "p50", "median {}", Plain, Neither, "Median of {}."),
    row("p99", "p99", "99th percentile of the {}", Plain, Neither, "99th percentile of {}."),
];

/// Members of [`catoptric_metrics::Jitter`].
#[rustfmt::skip] // A row reads better as a row.
const JITTER: &[Row] = &[
    row("mean", "", "mean {}", Plain, Low, "Mean of {}."),
    row("p99", "p99", "99th percentile of the {}", Plain, Low, "99th percentile of {}."),
    row("max", "max", "largest {}", Plain, Low, "Largest value of {}."),
];

/// Members of [`catoptric_metrics::Timing`].
#[rustfmt::skip] // A row reads better as a row.
const TIMING: &[Row] = &[
    row("median", "", "{}", Milliseconds, Low, "Median of {}."),
    row("mad", "MAD", "median absolute deviation of the {}", Milliseconds, Low,
        "Median absolute deviation from the median, unscaled, of {}."),
    row("p5", "p5", "5th percentile of the {}", Milliseconds, Low, "5th percentile of {}."),
    row("p95", "p95", "95th percentile of the {}", Milliseconds, Low, "95th percentile of {}."),
    row("samples", "samples", "samples of the {}", Count, Neither, "Number of samples of {}."),
    row("min", "min", "shortest {}", Milliseconds, Low, "Smallest sample of {}."),
    row("mean", "mean", "mean {}", Milliseconds, Low, "Mean of {}."),
    row("sigma", "σ", "standard deviation of the {}", Milliseconds, Low,
        "Standard deviation (n − 1) of {}."),
    row("p99", "p99", "99th percentile of the {}", Milliseconds, Low, "99th percentile of {}."),
    row("max", "max", "longest {}", Milliseconds, Low, "Largest sample of {}."),
    row("median_low", "median from", "lower end of the median of the {}", Milliseconds, Low,
        "Lower end of the 95 % bootstrap interval of the median of {}; null with fewer than six samples."),
    row("median_high", "median to", "upper end of the median of the {}", Milliseconds, Low,
        "Upper end of the 95 % bootstrap interval of the median of {}; null with fewer than six samples."),
];

/// Members of [`catoptric_metrics::ColorError`], with units and directions of their own.
#[rustfmt::skip] // A row reads better as a row.
const COLOR: &[Row] = &[
    row("mae", "MAE", "mean absolute colour error{}", Plain, Low,
        "Mean absolute error of linear red, green and blue{}."),
    row("rmse", "RMSE", "root mean squared colour error{}", Plain, Low,
        "Root of the mean squared error of linear red, green and blue{}."),
    row("psnr", "PSNR", "PSNR{}", Decibels, High,
        "Peak signal-to-noise ratio against a peak of 1{}; null where the pictures are equal, which `equal` says."),
    row("ssim", "SSIM", "SSIM{}", Plain, High,
        "Structural similarity of the luma, 1 where equal{}."),
    row("flip", "FLIP", "FLIP{}", Plain, Low, "Mean perceived difference (FLIP), 0 to 1{}."),
    row("rel_mse", "relMSE", "relative squared error{}", Plain, Low,
        "Mean of (t − f)² / (f² + 0.01){}."),
    row("mrse", "MRSE", "relative squared error as pbrt prints it{}", Plain, Low,
        "Mean of (t − f)² / (f + 0.01)²{}."),
    row("left_out", "left out", "pixels without a colour error{}", Count, Neither,
        "Pixels that are not finite in either picture and are left out of the colour errors{}."),
];

const ALL: &[&str] = &["mean", "p50", "p95", "p99", "max"];
const NONE: &[&str] = &[];

const ANGLE: &str = "the angle at the mirror between the shown and the true point, where the right \
                     object is shown";

/// Every row, in the order in which changes are told.
#[rustfmt::skip] // A row reads better as a row.
pub const ENTRIES: &[Entry] = &[
    One(row("object_agreement", "agree", "share of mirror pixels with the right object", Share, High,
        "Share of mirror pixels that show the right object, or the background where it is the background."), true),
    One(row("coverage.mirror_pixels", "mirror pixels", "mirror pixels", Count, Neither,
        "Pixels that reference and technique both see as reflecting mirror."), false),
    One(row("coverage.missing", "missing", "share of mirror pixels with an object missing", Share, Low,
        "Share of mirror pixels without the object that is reflected there."), true),
    One(row("coverage.extra", "extra", "share of mirror pixels with an object too many", Share, Low,
        "Share of mirror pixels with an object where only the background is reflected."), true),
    One(row("coverage.unresolved", "unresolved", "share of mirror pixels unresolved", Share, Low,
        "Share of mirror pixels for which the technique says that it found no answer; null for one that always answers."), true),
    One(row("coverage.cracks", "cracks", "cracks", Count, Low,
        "Thin gaps between neighbouring triangles."), true),
    One(row("coverage.crack_pixels", "crack pixels", "pixels in cracks", Count, Low,
        "Pixels in cracks."), false),
    One(row("coverage.widest_crack_px", "widest crack", "widest crack", Pixels, Low,
        "Width of the widest crack in pixels; 0 without cracks."), false),
    One(row("coverage.holes", "holes", "holes", Count, Low,
        "Enclosed gaps too wide for a crack: a triangle was dropped."), false),
    One(row("coverage.t_junctions", "T-junctions", "T-junctions", Count, Low,
        "T-junctions as the technique counts them; null if it does not."), true),
    One(row("coverage.below", "below", "pixels below the surface", Count, Neither,
        "Pixels left out because either sees the ray sent below the mirror's surface."), false),
    One(row("coverage.mirror_only_reference", "mirror lost", "mirror pixels of the reference only", Count, Low,
        "Reflecting mirror for the reference only."), false),
    One(row("coverage.mirror_only_test", "mirror gained", "mirror pixels of the technique only", Count, Low,
        "Reflecting mirror for the technique only."), false),
    One(row("coverage.iou", "IoU", "overlap of the reflected surfaces (IoU)", Plain, High,
        "Intersection over union of the pixels that show a reflected surface; null if neither has any."), false),
    Family(row("angular_error_deg", "angle", "angular error", Degrees, Low, ANGLE), SUMMARY, ALL),
    Family(row("edge_offset_px", "edges", "offset of edges", Pixels, Low,
        "the distance from the true edges of reflected objects to the nearest shown, and from those shown to the nearest true one"), SUMMARY, &["p50"]),
    Family(row("pixel_angle_deg", "pixel angle", "angle across a pixel", Degrees, Neither,
        "the angle between what a mirror pixel's centre and the rest of the pixel truly show: what an answer in whole pixels is off by"), SUMMARY, NONE),
    Family(row("color", "", "", Plain, Neither,
        ", on the mirror pixels"), COLOR, &["mae", "rmse", "psnr", "ssim", "flip"]),
    One(row("vertices.searched", "searched", "searches", Count, Neither,
        "Searches that were run."), false),
    One(row("vertices.reflected", "reflected", "vertices with a reflection in view", Count, Neither,
        "Vertices with a true reflection point in view; null where that is not known."), false),
    One(row("vertices.hidden", "hidden", "vertices hidden by the mirror", Count, Neither,
        "Vertices behind the mirror's silhouette cone: without any reflection point."), false),
    One(row("vertices.failed", "failed", "searches that failed", Count, Low,
        "Reflected vertices for which the search says that it has no answer, or a stand-in only."), true),
    One(row("vertices.non_finite", "not finite", "answers that are not finite", Count, Low,
        "Answers that are NaN or infinite though the search reports none as failed."), false),
    One(row("vertices.recall", "recall", "recall", Share, High,
        "Share of the true reflection points in view that were found, to 0.75 px."), true),
    One(row("vertices.solutions.true", "true points", "true reflection points in view", Count, Neither,
        "True reflection points in view, of all vertices together."), false),
    One(row("vertices.solutions.found", "found", "true reflection points found", Count, High,
        "Of the true reflection points in view, those with an answer within 0.75 px."), false),
    One(row("vertices.solutions.spurious", "spurious", "answers that are no reflection points", Count, Low,
        "Answers without a true reflection point within 0.75 px, in view or not."), false),
    One(row("vertices.solutions.by_k.k0.true", "true k=0", "true points with k = 0", Count, Neither,
        "True reflection points in view whose vertices lie before any focal point of their beam, as in an upright image."), false),
    One(row("vertices.solutions.by_k.k0.found", "found k=0", "true points with k = 0 found", Count, High,
        "Of those with k = 0 focal points before the vertex, with an answer within 0.75 px."), false),
    One(row("vertices.solutions.by_k.k1.true", "true k=1", "true points with k = 1", Count, Neither,
        "True reflection points in view whose vertices lie between the two focal points of their beam, as in an image that is turned over."), false),
    One(row("vertices.solutions.by_k.k1.found", "found k=1", "true points with k = 1 found", Count, High,
        "Of those with k = 1 focal points before the vertex, with an answer within 0.75 px."), false),
    One(row("vertices.solutions.by_k.k2.true", "true k=2", "true points with k = 2", Count, Neither,
        "True reflection points in view whose vertices lie behind both focal points of their beam, as in an inverted image."), false),
    One(row("vertices.solutions.by_k.k2.found", "found k=2", "true points with k = 2 found", Count, High,
        "Of those with k = 2 focal points before the vertex, with an answer within 0.75 px."), false),
    One(row("vertices.undecided", "undecided", "parts of mirrors left undecided", Count, Low,
        "Parts of mirrors of which it stays undecided whether they hold a true reflection point, of all vertices together."), false),
    One(row("vertices.hole", "met a hole", "searches that met a hole", Count, Low,
        "Searches that met a gap in a hierarchy; null for searches without one."), false),
    One(row("vertices.enlarged", "enlarged", "searches in enlarged cones", Count, Neither,
        "Searches that used the enlargement repair; null for searches without one."), false),
    Family(row("vertices.offset_px", "offset", "offset", Pixels, Low,
        "the distance from the found to the nearest true reflection point"), SUMMARY, &["mean", "p99"]),
    One(row("vertices.offset_share.over_0_71", "over 0.71 px", "share of offsets above 0.71 px", Share, Low,
        "Share of offsets above 0.71 px: not the nearest pixel."), false),
    One(row("vertices.offset_share.over_2", "over 2 px", "share of offsets above 2 px", Share, Low,
        "Share of offsets above 2 px."), false),
    One(row("vertices.offset_share.over_5", "over 5 px", "share of offsets above 5 px", Share, Low,
        "Share of offsets above 5 px."), false),
    One(row("vertices.discard.false_keep", "wrongly kept", "vertices wrongly kept", Count, Low,
        "Truly hidden vertices that the search calls reflected."), false),
    One(row("vertices.discard.false_drop", "wrongly dropped", "vertices wrongly dropped", Count, Low,
        "Vertices truly reflected in view that the search calls hidden."), false),
    One(row("triangles.in", "triangles in", "triangles before refinement", Count, Neither,
        "Object triangles times mirrors, before refinement."), false),
    One(row("triangles.drawn", "triangles", "triangles drawn", Count, Neither,
        "Triangles after refinement, before any is discarded."), false),
    One(row("triangles.unfinished", "unfinished", "triangles to be split further", Count, Low,
        "Triangles still above the threshold at the level limit."), false),
    One(row("work.total", "work", "work", Plain, Low,
        "Mean looks at texels (evaluations, node tests, samples together) for each searched vertex; of techniques that search no vertices, for each mirror pixel."), false),
    One(row("work.evaluations", "evals", "evaluations", Plain, Low,
        "Mean uses of the error function for each searched vertex; of traced rays, triangles tested for each mirror pixel."), true),
    One(row("work.steps", "steps", "steps", Plain, Low,
        "Mean moves of an iterative search for each searched vertex."), false),
    One(row("work.node_tests", "node tests", "node tests", Plain, Low,
        "Mean hierarchy nodes tested for each searched vertex or mirror pixel."), true),
    One(row("work.samples", "samples", "samples per mirror pixel", Plain, Low,
        "Mean places of cube maps looked up for each mirror pixel."), true),
    One(row("work.skips", "skips", "skips per mirror pixel", Plain, Neither,
        "Mean steps that an acceleration structure skipped for each mirror pixel."), false),
    One(row("work.cluster_tests", "cluster tests", "cluster tests per mirror pixel", Plain, Low,
        "Mean node tests of clusters of triangles for each mirror pixel, which are among the node tests."), false),
    One(row("work.pairs", "pairs", "pairs per mirror pixel", Plain, Low,
        "Mean pairs of a node over a few pixels and a triangle that their rays may meet, for each mirror pixel."), false),
    One(row("work.longest_list", "longest list", "longest list", Count, Low,
        "Most triangles that one pixel has to test from one list."), false),
    One(row("work.bytes", "list bytes", "bytes of lists", Count, Low,
        "Bytes of the lists that a frame works with."), false),
    One(row("temporal.frames", "frames", "frames", Count, Neither,
        "Frames of the scene's motion that were followed."), false),
    Family(row("temporal.jitter_px", "jitter", "jitter", Pixels, Low,
        "the change of a vertex' error from one frame to the next"), JITTER, &["mean"]),
    One(row("temporal.jumps", "jumps", "share of jumps above 2 px", Share, Low,
        "Share of the changes from frame to frame that are above 2 px."), true),
    One(row("temporal.object_agreement_min", "least agree", "smallest share of mirror pixels with the right object, over the frames", Share, High,
        "Smallest share of mirror pixels that show the right object, over the frames that were followed."), true),
    One(row("temporal.crack_pixels_max", "most crack px", "most crack pixels in a frame", Count, Low,
        "Most pixels in cracks that a frame has, over the frames that were followed."), false),
    One(row("temporal.t_junctions_max", "most T-junctions", "most T-junctions in a frame", Count, Low,
        "Most T-junctions that a frame has, over the frames that were followed."), false),
    One(row("temporal.triangles_changed", "changed", "triangles split otherwise than a frame before", Plain, Low,
        "Mean number of the scene's triangles that are split to another depth than in the frame before."), false),
    One(row("temporal.frame_ms", "moving", "time of a moving frame", Milliseconds, Low,
        "Median GPU time of a moving frame."), false),
    One(row("temporal.still_ms", "still", "time of a still frame", Milliseconds, Low,
        "Median GPU time of frames at rest, each in the pose of a moving frame and right after it."), false),
    One(row("temporal.added_ms.median", "motion adds", "what moving adds to a frame's time", Milliseconds, Low,
        "Median of what a moving frame takes more than the frame at rest after it."), false),
    One(row("temporal.added_ms.low", "motion adds, low", "what moving adds at least", Milliseconds, Low,
        "Lower end of the 95 % interval of what moving adds to a frame's time."), false),
    One(row("temporal.added_ms.high", "motion adds, high", "what moving adds at most", Milliseconds, Low,
        "Upper end of the 95 % interval of what moving adds to a frame's time."), false),
    One(row("temporal.evaluations", "moving evals", "evaluations, from the second frame", Plain, Low,
        "Mean evaluations a search, from the second frame on."), false),
    One(row("temporal.steps", "moving steps", "steps, from the second frame", Plain, Low,
        "Mean steps a search, from the second frame on."), false),
    One(row("temporal.moved_node_tests", "moved nodes", "node tests in the last frame", Plain, Low,
        "Mean node tests a search or a mirror pixel in the last frame of the motion."), false),
    One(row("motion.pairs", "pairs of frames", "pairs of frames", Count, Neither,
        "Pairs of frames over which the motion of reflections was judged."), false),
    One(row("motion.pixels", "motion pixels", "mirror pixels whose motion is known", Count, Neither,
        "Mirror pixels of which it is known where their reflection was a frame before, in all pairs of frames."), false),
    One(row("motion.missing", "motion missing", "share of those pixels without a vector", Share, Low,
        "Share of the pixels whose true motion is known for which the technique has no vector."), true),
    Family(row("motion.error_px", "motion", "error of the motion", Pixels, Low,
        "the distance between the vector and the true motion of the reflection"), SUMMARY, ALL),
    Family(row("motion.true_px", "true motion", "true motion", Pixels, Neither,
        "the length of the true motion of the reflections"), TRUE_MOTION, NONE),
    One(row("motion.rim.pixels", "rim motion pixels", "mirror pixels at the rim whose motion is known", Count, Neither,
        "Mirror pixels within 3 px of the mask's border whose true motion is known."), false),
    One(row("motion.rim.missing", "rim motion missing", "share of those pixels at the rim without a vector", Share, Low,
        "Share of the pixels at the rim whose true motion is known for which the technique has no vector."), false),
    Family(row("motion.rim.error_px", "rim motion", "error of the motion at the rim", Pixels, Low,
        "the distance between the vector and the true motion of the reflection, at the rim"), SUMMARY, NONE),
    One(row("motion.interior.pixels", "interior motion pixels", "mirror pixels off the rim whose motion is known", Count, Neither,
        "Mirror pixels farther than 3 px from the mask's border whose true motion is known."), false),
    One(row("motion.interior.missing", "interior motion missing", "share of those pixels off the rim without a vector", Share, Low,
        "Share of the pixels off the rim whose true motion is known for which the technique has no vector."), false),
    Family(row("motion.interior.error_px", "interior motion", "error of the motion off the rim", Pixels, Low,
        "the distance between the vector and the true motion of the reflection, off the rim"), SUMMARY, NONE),
    One(row("motion.picture.flip", "reprojected FLIP", "FLIP of the reprojected picture", Plain, Low,
        "Mean perceived difference (FLIP) between this frame and the colours that the vectors fetch from the frame before, where the reflection was not hidden."), false),
    One(row("motion.picture.flip_true", "FLIP by the truth", "FLIP of the picture reprojected by the true motion", Plain, Neither,
        "The same for the true vectors: what blending between pixels costs."), false),
    One(row("motion.picture.excess", "excess FLIP", "FLIP of the reprojected picture beyond the true motion's", Plain, Low,
        "FLIP of the picture that the vectors fetch from the frame before, less that of the true vectors."), true),
    One(row("against_full.object_agreement", "full agree", "share of mirror pixels with the right object, mirrors in mirrors", Share, High,
        "Share of mirror pixels that show the right object, judged by the truth in which mirrors see mirrors."), false),
    Family(row("against_full.angular_error_deg", "full angle", "angular error, mirrors in mirrors", Degrees, Low,
        "the angle at the mirror between the shown and the true point, judged by the truth in which mirrors see mirrors"), SUMMARY, NONE),
    One(row("time_ms.exact_points", "exact points", "time of the exact reflection points", Milliseconds, Neither,
        "Milliseconds on the CPU for the exact reflection points of the scene's vertices, which a search is compared with."), false),
    One(row("time_ms.prepare", "prepare", "time to prepare", Milliseconds, Low,
        "Wall-clock time, once, before the first frame."), false),
    Family(row("time_ms.frame", "GPU", "time of a frame", Milliseconds, Low,
        "the GPU time of a frame"), TIMING, &["median"]),
    One(row("time_ms.passes.*", "pass", "time of a pass", Milliseconds, Low,
        "Median GPU time of a pass."), false),
    Family(row("time_ms.build", "build", "time to build on the CPU before a frame", Milliseconds, Low,
        "the CPU time before each frame to build what it traces, which no other time contains"), TIMING, NONE),
    Family(row("time_ms.own", "own", "time of the technique's own passes and builds", Milliseconds, Low,
        "the GPU time of a technique's own passes in a frame, and of what it builds on the CPU before it"), TIMING, NONE),
    One(row("time_ms.wall.median", "wall", "wall-clock time of a frame", Milliseconds, Low,
        "Median wall-clock time of a frame."), false),
    One(row("mismatch.boundary", "wrong at edges", "share of mirror pixels wrong beside an edge", Share, Low,
        "Share of mirror pixels that show the wrong object next to an edge of the reference, where half a pixel decides."), false),
    One(row("mismatch.interior", "wrong inside", "share of mirror pixels wrong inside an outline", Share, Low,
        "Share of mirror pixels that show the wrong object elsewhere."), false),
    One(row("non_finite.reference", "not finite, reference", "pixels of the reference that are not finite", Count, Low,
        "Mirror pixels whose colour in the reference is NaN or infinite."), false),
    One(row("non_finite.test", "not finite", "pixels that are not finite", Count, Low,
        "Mirror pixels whose colour by the technique is NaN or infinite."), false),
    One(row("non_finite.angles", "no angle", "pixels without an angle", Count, Low,
        "Pixels without an angle: a position is not finite or lies on the mirror point."), false),
    Family(row("regions.image", "picture", ", whole picture", Plain, Neither,
        ", over the whole picture"), COLOR, NONE),
    One(row("regions.rim.mirror_pixels", "rim pixels", "mirror pixels at the rim", Count, Neither,
        "Mirror pixels within 3 px of the mask's border."), false),
    One(row("regions.rim.object_agreement", "rim agree", "share of rim pixels with the right object", Share, High,
        "Share of the rim's pixels that show the right object."), false),
    Family(row("regions.rim.angular_error_deg", "rim angle", "angular error at the rim", Degrees, Low,
        "the angle at the mirror between the shown and the true point, at the rim"), SUMMARY, NONE),
    Family(row("regions.rim.color", "rim", " at the rim", Plain, Neither,
        ", at the rim"), COLOR, NONE),
    One(row("regions.interior.mirror_pixels", "interior pixels", "mirror pixels off the rim", Count, Neither,
        "Mirror pixels farther than 3 px from the mask's border."), false),
    One(row("regions.interior.object_agreement", "interior agree", "share of pixels off the rim with the right object", Share, High,
        "Share of the pixels off the rim that show the right object."), false),
    Family(row("regions.interior.angular_error_deg", "interior angle", "angular error off the rim", Degrees, Low,
        "the angle at the mirror between the shown and the true point, off the rim"), SUMMARY, NONE),
    Family(row("regions.interior.color", "interior", " off the rim", Plain, Neither,
        ", off the rim"), COLOR, NONE),
    One(row("more.distance", "distance", "relative error of the reflected distance", Plain, Low,
        "Median of |t − f| / f, f and t being the true and the shown length of the reflected ray, where the right object is shown."), false),
];

impl Entry {
    /// The metrics of a row.
    pub fn metrics(&self) -> Vec<Metric> {
        match self {
            Self::One(row, judged) => vec![row.alone(*judged)],
            Self::Family(family, members, judged) => members
                .iter()
                .map(|member| member.of(family, judged.contains(&member.path)))
                .collect(),
        }
    }
}

impl Row {
    fn alone(&self, judged: bool) -> Metric {
        Metric {
            path: self.path.to_owned(),
            heading: self.heading.to_owned(),
            name: self.name.to_owned(),
            unit: self.unit,
            better: self.better,
            judged,
            what: self.what.to_owned(),
        }
    }

    /// A member at the family's place. It has the family's unit and direction, unless the family has
    /// no unit or the member is a count.
    fn of(&self, family: &Self, judged: bool) -> Metric {
        let own = family.unit == Plain || self.unit == Count;
        let heading = format!("{} {}", family.heading, self.heading);
        Metric {
            path: format!("{}.{}", family.path, self.path),
            heading: heading.trim().to_owned(),
            name: self.name.replace("{}", family.name),
            unit: if own { self.unit } else { family.unit },
            better: if own { self.better } else { family.better },
            judged,
            what: self.what.replace("{}", family.what),
        }
    }
}
