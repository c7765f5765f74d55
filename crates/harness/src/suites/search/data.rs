//! What is measured, searches and scenes, and what the thesis printed.

use crate::suites::figure::Quote;
use crate::suites::paths::FRAME_MS;
use crate::suites::series::Ask;

pub const LINEAR: &str = "linear";
pub const WARM: &str = "linear, warm";
pub const RAW: &str = "hierarchy";
pub const ENLARGED: &str = "hierarchy, enlarged";
pub const STOPPED: &str = "hierarchy, stopped early";

/// Ours, cold and from the previous frame.
pub const SWEPT: (&str, &str) = ("swept boxes", "swept-boxes");
pub const SWEPT_WARM: (&str, &str) = ("swept boxes, warm", "swept-boxes(start=previous)");

/// Series of every figure: label and technique.
pub const SEARCHES: [(&str, &str); 5] = [
    (LINEAR, "linear"),
    (WARM, "linear(start=previous)"),
    (RAW, "ray-hierarchy"),
    (ENLARGED, "ray-hierarchy(repair=enlarge)"),
    (STOPPED, "ray-hierarchy(repair=stop)"),
];

/// On the published maps: what the rasterizer interpolates between a mesh's corners.
pub const MESH: (&str, &str) = ("linear, mirror as a mesh", "linear(gbuffer=mesh)");

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

/// On what the thesis measured.
pub const THESIS: &str = "Core 2 Duo, GTX 260";

const fn quote(what: &'static str, theirs: &'static str, series: &'static str, x: f64) -> Quote {
    Quote {
        what,
        theirs,
        on: THESIS,
        ours: Some(Ask {
            series,
            x,
            path: FRAME_MS,
            unit: "ms",
        }),
    }
}

/// The milliseconds of Fig. 4.3.
pub const QUOTES: [Quote; 10] = [
    quote("a: linear", "90 ms a frame", LINEAR, 0.0),
    quote("a: hierarchy", "600 ms a frame (6.7 times)", ENLARGED, 0.0),
    quote("b: linear", "8 ms a frame", LINEAR, 1.0),
    quote("b: hierarchy", "45 ms a frame (5.6 times)", ENLARGED, 1.0),
    quote("c: linear", "20 ms a frame", LINEAR, 2.0),
    quote(
        "c: hierarchy, enlarged",
        "95 ms a frame (4.8 times)",
        ENLARGED,
        2.0,
    ),
    quote(
        "c: hierarchy, no repair",
        "80 ms a frame (4 times)",
        RAW,
        2.0,
    ),
    quote("d: linear", "6 ms a frame", LINEAR, 3.0),
    quote("d: hierarchy", "20 ms a frame (3.3 times)", ENLARGED, 3.0),
    quote(
        "d: hierarchy, stopped early",
        "12 ms a frame (2 times)",
        STOPPED,
        3.0,
    ),
];
