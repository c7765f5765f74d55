//! What is measured: searches, scenes, and where their numbers stand in a record.

pub const LINEAR: &str = "linear";
pub const WARM: &str = "linear, warm";
pub const RAW: &str = "hierarchy";
pub const ENLARGED: &str = "hierarchy, enlarged";
pub const STOPPED: &str = "hierarchy, stopped early";

/// Series of every figure: label and technique.
pub const SEARCHES: [(&str, &str); 5] = [
    (LINEAR, "linear"),
    (WARM, "linear(start=previous)"),
    (RAW, "ray-hierarchy"),
    (ENLARGED, "ray-hierarchy(repair=enlarge)"),
    (STOPPED, "ray-hierarchy(repair=stop)"),
];

/// The scenes of Fig. 4.3, by letter; the first two with their number of vertices.
pub const CASES: [(&str, &str); 4] = [
    ("a: 20 000", "sphere-objects-20k"),
    ("b: 1 000", "sphere-objects-1k"),
    ("c: holes", "sphere-grid-3k"),
    ("d: early stop", "sphere-grid-1k"),
];

/// The built-in family's sizes: the name's ending, and the vertices of its grid.
pub const SIZES: [(&str, u32); 7] = [
    ("100", 100),
    ("300", 289),
    ("1k", 1_024),
    ("3k", 3_025),
    ("10k", 10_000),
    ("30k", 29_929),
    ("100k", 99_856),
];

/// Scenes with a slow camera path.
pub const MOVING: [(&str, &str); 3] = [
    ("sphere, points", "prototype-sphere"),
    ("sphere, objects", "sphere-objects-1k"),
    ("ellipsoid, objects", "ellipsoid"),
];

/// Frames of the path that are followed.
pub const FRAMES: u32 = 12;
pub const SEARCH_MS: &str = "time_ms.passes.search";
pub const FRAME_MS: &str = "time_ms.frame.median";
pub const MOVING_MS: &str = "temporal.frame_ms";
pub const STILL_MS: &str = "temporal.still_ms";
pub const EVALUATIONS: &str = "work.evaluations";
pub const NODE_TESTS: &str = "work.node_tests";
pub const STEPS: &str = "work.steps";
pub const OFFSET: &str = "vertices.offset_px.mean";
pub const OFFSET_P95: &str = "vertices.offset_px.p95";
pub const JITTER_MEAN: &str = "temporal.jitter_px.mean";
pub const JITTER_MAX: &str = "temporal.jitter_px.max";
pub const JUMPS: &str = "temporal.jumps";

/// On what the thesis measured.
pub const THESIS: &str = "Core 2 Duo, GTX 260";
