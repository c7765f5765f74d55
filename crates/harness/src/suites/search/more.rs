//! Figures that the thesis describes and does not draw, and its pictures with numbers beside them.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, ANGLE, FAILED, FLIP, FRAME_MS, HOLES, MEAN_PX, NODE_TESTS, P95_PX, SEARCH_MS,
    SEARCHED, STEPS, WORK,
};
use crate::suites::series::{Point, Series};
use crate::suites::shelf;

use super::claims;
use super::data::{ENLARGED, LINEAR, RAW};
use super::labels::{
    ALL_REFLECTED, CONE, ENVIRONMENT, EXACT_LINEAR, EXACT_PLANAR, PARTLY_HIDDEN, REFLECTOR, SPHERE,
    STOP,
};

/// How much wider the views are.
const WIDER: [(f64, &str); 4] = [
    (1.0, "sphere-objects-1k"),
    (2.0, "sphere-small-2"),
    (4.0, "sphere-small-4"),
    (8.0, "sphere-small-8"),
];
/// Numbers of mirrors that the built-in family has.
const MIRRORS: [u32; 6] = [1, 2, 3, 4, 6, 8];
const POINTS: &str = "prototype-sphere";

/// All of them.
pub fn figures() -> Vec<Figure> {
    vec![
        small(),
        mirrors(),
        factors(),
        stops(),
        hidden(),
        near(),
        examples(),
    ]
}

fn quantities() -> Vec<Quantity> {
    vec![
        Quantity::linear(FRAME_MS),
        Quantity::log(SEARCH_MS).called("search pass (ms)"),
        Quantity::log(STEPS).called("steps per vertex"),
        Quantity::log(WORK).called("looks at texels per vertex"),
    ]
}

/// The same scene in wider and wider views.
fn small() -> Figure {
    let series = |label, technique: &str| {
        let points = WIDER.map(|(wider, scene)| Point::new(wider, scene, technique));
        Series::new(label, points)
    };
    Figure {
        anchor: "small",
        title: "A small mirror in a large picture".to_owned(),
        after: "Szabo 2013, section 6.1",
        question: "The same scene in wider and wider views, so that the mirror covers fewer and fewer pixels: \
                   the walk has less far to go, the pyramid keeps its levels."
            .to_owned(),
        axis: Axis::log("times wider"),
        series: vec![
            series(LINEAR, "linear"),
            series(RAW, "ray-hierarchy"),
            series(ENLARGED, shelf::RAY_HIERARCHY.1),
            series(REFLECTOR, shelf::REFLECTOR_CUBEMAP.1),
        ],
        quantities: quantities(),
        quotes: &[],
        claims: claims::SMALL,
    }
}

/// One to eight mirrors.
fn mirrors() -> Figure {
    let series = |label, technique: &str| {
        let points = MIRRORS
            .map(|mirrors| Point::new(f64::from(mirrors), format!("mirrors-{mirrors}"), technique));
        Series::new(label, points)
    };
    let mut quantities = quantities();
    quantities.insert(
        1,
        Quantity::linear(SEARCHED).called("vertices searched, all mirrors"),
    );
    Figure {
        anchor: "mirrors",
        title: "One to eight mirrors".to_owned(),
        after: "Szabo 2013, sections 2.3 and 3.1",
        question: "The same floor and things under one to eight spheres of one size: every vertex is searched \
                   for every mirror."
            .to_owned(),
        axis: Axis::linear("mirrors"),
        series: vec![series(LINEAR, "linear"), series(ENLARGED, shelf::RAY_HIERARCHY.1)],
        quantities,
        quotes: &[],
        claims: claims::MIRRORS,
    }
}

/// The factors of enlargement.
fn factors() -> Figure {
    let cone = |factor: f64| {
        Point::new(
            factor,
            POINTS,
            format!("ray-hierarchy(repair=enlarge,cone={factor})"),
        )
    };
    let sphere = |factor: f64| {
        Point::new(
            factor,
            POINTS,
            format!("ray-hierarchy(repair=enlarge,sphere={factor})"),
        )
    };
    Figure {
        anchor: "factors",
        title: "The factors of the enlargement".to_owned(),
        after: "Szabo 2013, section 4.2",
        question: "A search that fell into a hole is repeated with cones and spheres enlarged by two factors. \
                   One is varied here and the other kept: 2 for the spheres, 1.5 for the cones. Points with \
                   known reflection points around a sphere."
            .to_owned(),
        axis: Axis::linear("factor"),
        series: vec![
            Series::new(CONE, [1.25, 1.5, 2.0, 2.5, 3.0].map(cone)),
            Series::new(SPHERE, [1.5, 2.0, 2.5, 3.0, 4.0].map(sphere)),
        ],
        quantities: vec![
            Quantity::linear(NODE_TESTS).called("node tests per vertex"),
            Quantity::linear(FAILED),
            Quantity::linear(MEAN_PX),
            Quantity::linear(P95_PX),
            Quantity::linear(FRAME_MS),
        ],
        quotes: &[],
        claims: claims::FACTORS,
    }
}

/// The level at which the descent stops.
fn stops() -> Figure {
    let point = |stop: f64| {
        Point::new(
            stop,
            POINTS,
            format!("ray-hierarchy(repair=stop,stop={stop})"),
        )
    };
    Figure {
        anchor: "stop",
        title: "The level at which the descent stops".to_owned(),
        after: "Szabo 2013, sections 4.2 and 4.3",
        question: "The descent ends some levels above the pixels, before most holes; the answer is the centre of \
                   the sphere there. Points with known reflection points around a sphere."
            .to_owned(),
        axis: Axis::linear("levels left out"),
        series: vec![Series::new(STOP, [1.0, 2.0, 3.0, 4.0, 5.0].map(point))],
        quantities: vec![
            Quantity::log(MEAN_PX),
            Quantity::linear(FAILED),
            Quantity::linear(HOLES),
            Quantity::linear(NODE_TESTS).called("node tests per vertex"),
            Quantity::linear(FRAME_MS),
        ],
        quotes: &[],
        claims: claims::STOPS,
    }
}

/// The present view of the thesis' scene, and one with vertices behind the mirror.
fn hidden() -> Figure {
    let series = |label, technique: &str, family: &str| {
        let points = [("1k", 0.0), ("10k", 1.0)];
        Series::new(
            label,
            points.map(|(size, x)| Point::new(x, format!("{family}{size}"), technique)),
        )
    };
    let [shown, part] = ["sphere-grid-", "sphere-grid-hidden-"];
    Figure {
        anchor: "hidden",
        title: "With hidden vertices".to_owned(),
        after: "Szabo 2013, section 6.1",
        question: "A square of which the mirror hides a part, against one that is reflected as a whole. The \
                   linear search recognizes a hidden vertex by its answer; the hierarchy finds no cone for it."
            .to_owned(),
        axis: Axis::names("vertices", ["1 000", "10 000"]),
        series: vec![
            series("linear, all reflected", "linear", shown),
            series("linear, some hidden", "linear", part),
            series(ALL_REFLECTED, shelf::RAY_HIERARCHY.1, shown),
            series(PARTLY_HIDDEN, shelf::RAY_HIERARCHY.1, part),
        ],
        quantities: [quantities(), vec![Quantity::log(NODE_TESTS).called("node tests per vertex")]].concat(),
        quotes: &[],
        claims: claims::HIDDEN,
    }
}

fn picture_quantities() -> Vec<Quantity> {
    vec![
        Quantity::linear(AGREEMENT),
        Quantity::log(ANGLE),
        Quantity::linear(FLIP),
        Quantity::linear(FRAME_MS),
    ]
}

fn pictures(label: &str, technique: &str, scenes: &[(&str, &str)]) -> Series {
    let points = scenes.iter().enumerate();
    let points = points.map(|(x, (_, scene))| Point::new(x as f64, *scene, technique).shown());
    Series::new(label, points)
}

/// Fig. 1.1.
fn near() -> Figure {
    let scenes = [
        ("touching", "sphere-touching"),
        ("near", "sphere-objects-1k"),
    ];
    Figure {
        anchor: "near",
        title: "An environment map beside the search".to_owned(),
        after: "Szabo 2013, Fig. 1.1, and Szabo CESCG, Fig. 2",
        question: "An environment map shows all as if it were far away. What is near the mirror, or touches it, \
                   comes out wrong."
            .to_owned(),
        axis: Axis::names("objects", scenes.map(|(name, _)| name)),
        series: vec![
            pictures(ENVIRONMENT, shelf::ENVIRONMENT_MAP.1, &scenes),
            pictures(EXACT_LINEAR, "linear", &scenes),
        ],
        quantities: picture_quantities(),
        quotes: &[],
        claims: claims::NEAR,
    }
}

/// Fig. 3.2.
fn examples() -> Figure {
    let scenes = [
        ("one sphere", "sphere-objects-1k"),
        ("several spheres", "spheres"),
        ("flat", "planar"),
        ("concave", "bowl"),
    ];
    let flat = Point::new(2.0, "planar", "planar");
    Figure {
        anchor: "examples",
        title: "One sphere, several, a flat mirror, a concave one".to_owned(),
        after: "Szabo 2013, Fig. 3.2",
        question: "The four pictures of the thesis by the linear search, with their errors; on the flat mirror \
                   beside the view from the mirrored eye."
            .to_owned(),
        axis: Axis::names("mirror", scenes.map(|(name, _)| name)),
        series: vec![
            pictures(EXACT_LINEAR, "linear", &scenes),
            Series::new(EXACT_PLANAR, [flat]),
        ],
        quantities: picture_quantities(),
        quotes: &[],
        claims: claims::EXAMPLES,
    }
}
