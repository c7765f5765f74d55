//! What both papers say about tessellation without drawing a figure of it.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, CHANGED, CRACK_PIXELS, DRAWN, EDGES, FRAME_MS, JITTER_P99, MOST_CRACKED,
    MOST_JUNCTIONS, MOVING_MS, SEARCHED, STILL_MS,
};
use crate::suites::series::{Point, Series};

use super::claims;
use super::data::{
    ADAPTIVE, FULL, HALF, PIXEL, SQUARE, TABLE, THRESHOLD, adaptive, full, pixel, pixels_by_level,
    quantities, three_modes,
};
use super::labels::{
    COARSE, ELLIPSOID, ELLIPSOID_BY_PIXELS, FINE, HIERARCHY_ADAPTIVE, HIERARCHY_FULL, LARGE_MIRROR,
    MOTION, SMALL_MIRROR, SPHERE, SPHERE_BY_PIXELS,
};

/// Level limits of the sweep under both searches.
const LEVELS: u32 = 5;
const THRESHOLDS: [&str; 5] = ["0.1", "0.01", "0.001", "0.0001", "0.00001"];
/// Frames of the path that are followed.
const FRAMES: u32 = 12;
/// The square before an ellipsoid.
const OTHER_SQUARE: &str = "ellipsoid-square";
/// The size of what is measured on the table.
const SIZE: [u32; 2] = [320, 240];

/// All of them. A scene of the user's has no objects, mirrors and sizes of ours.
pub fn figures(scene: Option<&str>) -> Vec<Figure> {
    let square = scene.unwrap_or(SQUARE);
    let mut figures = vec![hierarchy(square)];
    if scene.is_none() {
        figures.extend([objects(), reflectors(), size(), dynamic()]);
    }
    figures
}

/// Of the table, each object by itself.
fn objects() -> Figure {
    let technique = |x: f64, object: &str, technique: String| Point {
        resolution: Some(SIZE),
        ..Point::new(x, format!("{TABLE}-only-{object}"), technique)
    };
    let point = |x: f64, object: &str| technique(x, object, adaptive(4, THRESHOLD));
    let names = ["cloth", "candlestick", "teapot", "apple"];
    let by_pixels = (0..).zip(names);
    let by_pixels = by_pixels.map(|(x, object)| technique(f64::from(x), object, pixel(HALF)));
    Figure {
        anchor: "objects",
        title: "Object by object".to_owned(),
        after: "Szabo CESCG, Fig. 7",
        question: format!(
            "Each object of the table alone before the same mirror, adaptive to level 4 at a threshold of \
             {THRESHOLD}, and by pixels: which of them are split? Triangles that the mirror hides are among those left whole."
        ),
        axis: Axis::names("object", names),
        series: vec![
            Series::new(COARSE, [point(0.0, "cloth"), point(1.0, "candlestick")]),
            Series::new(FINE, [point(2.0, "teapot"), point(3.0, "apple")]),
            Series::new(PIXEL, by_pixels),
        ],
        quantities: quantities([
            Quantity::log("triangles.in"),
            Quantity::log(DRAWN),
            Quantity::linear(CRACK_PIXELS),
        ]),
        quotes: &[],
        claims: claims::OBJECTS,
    }
}

/// Both refinements under the hierarchy.
fn hierarchy(scene: &str) -> Figure {
    let under =
        |technique: String| technique.replacen("linear", "ray-hierarchy(repair=enlarge)", 1);
    let series = |label, technique: &dyn Fn(u32) -> String| {
        let point = |level: u32| Point::new(f64::from(level), scene, under(technique(level)));
        Series::new(label, (0..=LEVELS).map(point))
    };
    let mut all = three_modes(LEVELS, |x, technique| Point::new(x, scene, technique));
    all.retain(|series| [FULL, ADAPTIVE].contains(&series.label.as_str()));
    all.push(series(HIERARCHY_FULL, &full));
    all.push(series(HIERARCHY_ADAPTIVE, &|level| {
        adaptive(level, THRESHOLD)
    }));
    all.push(pixels_by_level(LEVELS, |x, technique| {
        Point::new(x, scene, technique)
    }));
    Figure {
        anchor: "hierarchy",
        title: "Full and adaptive under both searches".to_owned(),
        after: "Szabo 2013, section 6.2",
        question: "The thesis measures tessellation with the linear search and says that with the hierarchy \
                   both kinds relate alike, since every new vertex is one more search."
            .to_owned(),
        axis: Axis::linear("level limit"),
        series: all,
        quantities: quantities([Quantity::log(FRAME_MS), Quantity::log(SEARCHED), Quantity::log(DRAWN)]),
        quotes: &[],
        claims: claims::HIERARCHY,
    }
}

/// One threshold on mirrors of two shapes.
fn reflectors() -> Figure {
    let series = |label, scene: &str| {
        let points = (0..).zip(THRESHOLDS);
        let points = points.map(|(x, threshold)| {
            let point = Point::new(f64::from(x), scene, adaptive(LEVELS, threshold));
            match threshold {
                THRESHOLD => point.shown(),
                _ => point,
            }
        });
        Series::new(label, points)
    };
    let by_pixels = |label, scene: &str| {
        let x = THRESHOLDS.len() as f64;
        Series::new(label, [Point::new(x, scene, pixel(HALF)).shown()])
    };
    Figure {
        anchor: "reflectors",
        title: "One threshold, two mirrors".to_owned(),
        after: "Szabo 2013, sections 5.1 and 6.2",
        question: "The same square before a sphere and before an ellipsoid, whose curvature changes from place to \
                   place. Does one threshold serve both?"
            .to_owned(),
        axis: Axis::names("threshold", THRESHOLDS.into_iter().chain([PIXEL])),
        series: vec![
            series(SPHERE, SQUARE),
            series(ELLIPSOID, OTHER_SQUARE),
            by_pixels(SPHERE_BY_PIXELS, SQUARE),
            by_pixels(ELLIPSOID_BY_PIXELS, OTHER_SQUARE),
        ],
        quantities: quantities([Quantity::log(DRAWN), Quantity::log(FRAME_MS)]),
        quotes: &[],
        claims: claims::REFLECTORS,
    }
}

/// The same mirror, small in the picture.
fn size() -> Figure {
    let series = |label, scene: &str| {
        let techniques = [adaptive(LEVELS, THRESHOLD), pixel(HALF)];
        let points = (0..).zip(techniques);
        Series::new(
            label,
            points.map(|(x, technique)| Point::new(f64::from(x), scene, technique)),
        )
    };
    Figure {
        anchor: "size",
        title: "A mirror that is small in the picture".to_owned(),
        after: "Szabo 2013, sections 5.2 and 6.2",
        question: "The edge error does not know how many pixels the mirror covers. The same scene in a view four \
                   times as wide: where the mirror is so small, is less split?"
            .to_owned(),
        axis: Axis::names("technique", [ADAPTIVE, PIXEL]),
        series: vec![series(LARGE_MIRROR, SQUARE), series(SMALL_MIRROR, "square-small-4")],
        quantities: quantities([Quantity::log(DRAWN), Quantity::log(FRAME_MS)]),
        quotes: &[],
        claims: claims::SIZE,
    }
}

/// A slow path of the camera.
fn dynamic() -> Figure {
    let scenes = [("square", SQUARE), ("objects", "sphere-objects-1k")];
    let series = |label, technique: String| {
        let points = scenes.iter().enumerate().map(|(x, (_, scene))| Point {
            resolution: Some(SIZE),
            frames: Some(FRAMES),
            ..Point::new(x as f64, *scene, technique.clone())
        });
        Series::new(label, points)
    };
    Figure {
        anchor: "dynamic",
        title: "While the camera moves".to_owned(),
        after: "Szabo CESCG, section 5.2",
        question: format!(
            "Every frame is tessellated anew, so that motion should cost nothing extra: {FRAMES} frames of the \
             scene's own path. What is split otherwise than a frame before may be seen to jump: such triangles are counted."
        ),
        axis: Axis::names("scene", scenes.map(|(name, _)| name)),
        series: vec![
            series(MOTION, adaptive(3, THRESHOLD)),
            series(PIXEL, pixel(HALF)),
        ],
        quantities: vec![
            Quantity::linear(MOVING_MS),
            Quantity::linear(STILL_MS),
            Quantity::linear(CHANGED),
            Quantity::linear(MOST_CRACKED),
            Quantity::linear(MOST_JUNCTIONS),
            Quantity::linear(JITTER_P99),
            Quantity::linear(AGREEMENT),
            Quantity::linear(EDGES),
        ],
        quotes: &[],
        claims: claims::DYNAMIC,
    }
}
