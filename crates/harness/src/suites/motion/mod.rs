//! `catoptric bench motion`: where a reflection was a frame before, by the formulas that engines use and
//! by Newton's method, against the truth: which formula, what it costs, when it breaks.

mod claims;
mod labels;
mod pictures;

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Guide, Quantity};
use crate::suites::paths::{
    EVALUATIONS, MOTION_EXCESS, MOTION_MISSING, MOTION_MS, MOTION_P50, MOTION_P95, TRUE_MOTION,
};
use crate::suites::series::{Point, Series};
use crate::suites::suite::{Asked, Budget, Layout, Suite};

use labels::{ESTIMATORS, LENS, LENS_ANALYTIC, MIRRORS, NEWTON, NEWTON_ANALYTIC, NEWTON_MESH};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "motion",
    title: "Where was this reflection a frame ago?",
    why: "Temporal upscalers and denoisers need the motion of what a mirror shows. How far off are the \
          formulas that engines feed them on curved mirrors, and what does the exact one cost?",
    figures,
    judged: None,
    pictures: Some(pictures::make),
    timing: Budget::Whole(60.0),
    resolution: None,
    layout: Layout::Figures,
};

/// What is drawn of each figure.
fn quantities() -> Vec<Quantity> {
    vec![
        Quantity::log(MOTION_P50),
        Quantity::log(MOTION_P95).beside(Guide {
            label: "true motion",
            path: TRUE_MOTION,
        }),
        Quantity::linear(MOTION_MISSING),
        Quantity::linear(MOTION_EXCESS),
    ]
}

fn figures(asked: &Asked<'_>) -> Vec<Figure> {
    if let Some(scene) = asked.scene {
        let axis = Axis::names("scene", [scene]);
        return vec![mirrors(axis, &[scene.to_owned()], &[])];
    }
    let scenes = MIRRORS.map(|mirror| format!("moving-{mirror}-all-step-4"));
    let axis = Axis::names("mirror", MIRRORS);
    vec![
        mirrors(axis, &scenes, claims::MIRRORS),
        moves(),
        steps("ball", "step", claims::STEPS),
        steps("bowl", "step-bowl", claims::STEPS),
        distances(),
        meshes(),
        derivatives(),
    ]
}

/// A series an estimator, a place a scene.
fn series(scenes: &[String]) -> Vec<Series> {
    let of = |(label, technique): &(&str, &str)| {
        let points = (0..).zip(scenes);
        let points = points.map(|(x, scene)| Point::new(f64::from(x), scene, *technique));
        Series::new(*label, points)
    };
    ESTIMATORS.iter().map(of).collect()
}

fn mirrors(
    axis: Axis,
    scenes: &[String],
    claims: &'static [crate::suites::claims::Claim],
) -> Figure {
    let mut quantities = quantities();
    quantities.extend([
        Quantity::linear(EVALUATIONS).called("looks at the mirror's surface per pixel"),
        Quantity::linear(MOTION_MS).called("the pass (ms)"),
        Quantity::linear(TRUE_MOTION),
    ]);
    Figure {
        anchor: "mirrors",
        title: "Which formula".to_owned(),
        after: "",
        question: "Camera, mirror and an object move, so that reflections move by some 4 pixels. Each \
                   estimator is told the two frames' G-buffers and what the reflected rays meet. On a \
                   flat mirror two formulas are exact: that is the control. Excess FLIP is what a viewer \
                   sees: the last frame's true picture, fetched by the vectors, beside this frame's, less \
                   the same by the true vectors."
            .to_owned(),
        axis,
        series: series(scenes),
        quantities,
        quotes: &[],
        claims,
    }
}

fn moves() -> Figure {
    const WHAT: [&str; 4] = ["camera", "object", "mirror", "all"];
    let scenes = WHAT.map(|what| format!("moving-ball-{what}-step-4"));
    Figure {
        anchor: "moves",
        title: "What moves".to_owned(),
        after: "",
        question: "The same step of the camera alone, of an object alone, of the mirror alone, and of all, \
                   before a ball. Where an object moves alone, most reflections stand still."
            .to_owned(),
        axis: Axis::names("what moves", WHAT),
        series: series(&scenes),
        quantities: quantities(),
        quotes: &[],
        claims: &[],
    }
}

fn steps(
    mirror: &str,
    anchor: &'static str,
    claims: &'static [crate::suites::claims::Claim],
) -> Figure {
    const STEPS: [&str; 6] = ["0.1", "0.3", "1", "4", "10", "30"];
    let of = |(label, technique): &(&str, &str)| {
        let points = STEPS.into_iter().map(|step| {
            let scene = format!("moving-{mirror}-all-step-{step}");
            Point {
                along: Some(TRUE_MOTION),
                ..Point::new(step.parse().unwrap_or_default(), scene, *technique)
            }
        });
        Series::new(*label, points)
    };
    Figure {
        anchor,
        title: format!("How long a step, before a {mirror}"),
        after: "",
        question: "All move, by steps of a tenth to thirty pixels. A formula that is wrong is wrong in \
                   proportion to the step; one that solves the right equation is off by what the G-buffer \
                   resolves, until a step is too long for it."
            .to_owned(),
        axis: Axis::log("true motion, median (px)"),
        series: ESTIMATORS.iter().map(of).collect(),
        quantities: quantities(),
        quotes: &[],
        claims,
    }
}

fn distances() -> Figure {
    const DISTANCES: [&str; 4] = ["1.2", "2", "4", "8"];
    let of = |(label, technique): &(&str, &str)| {
        let points = DISTANCES.into_iter().map(|distance| {
            let scene = format!("moving-ball-camera-within-{distance}");
            Point::new(distance.parse().unwrap_or_default(), scene, *technique)
        });
        Series::new(*label, points)
    };
    Figure {
        anchor: "distance",
        title: "How far away what is reflected is".to_owned(),
        after: "",
        question: "A ball of radius 0.9 in tubes of growing radius, open to the camera, which moves. The \
                   farther away what is reflected is, the nearer its image is to the focus, and the more \
                   the curvature decides."
            .to_owned(),
        axis: Axis::log("radius of the tube"),
        series: ESTIMATORS.iter().map(of).collect(),
        quantities: quantities(),
        quotes: &[],
        claims: &[],
    }
}

fn meshes() -> Figure {
    const SEGMENTS: [u32; 6] = [16, 32, 64, 128, 256, 512];
    let mesh = |technique: &'static str| {
        SEGMENTS.into_iter().map(move |segments| {
            let scene = match segments {
                256 => "moving-mesh-all-step-4".to_owned(),
                _ => format!("moving-mesh-all-segments-{segments}"),
            };
            Point::new(f64::from(segments), scene, technique)
        })
    };
    Figure {
        anchor: "meshes",
        title: "Where normals are interpolated".to_owned(),
        after: "",
        question: "A ball of triangles with smooth normals, which is the mirror itself: the truth is the \
                   mesh's own. Between a triangle's corners the normal turns evenly, over an edge its \
                   derivative jumps: that is what the differences of a G-buffer see."
            .to_owned(),
        axis: Axis::log("segments around the ball"),
        series: vec![
            Series::new(LENS.0, mesh(LENS.1)),
            Series::new(NEWTON_MESH, mesh(NEWTON.1)),
        ],
        quantities: quantities(),
        quotes: &[],
        claims: claims::MESHES,
    }
}

fn derivatives() -> Figure {
    let known = &MIRRORS[..MIRRORS.len() - 1];
    let of = |(label, technique): (&str, &'static str)| {
        let points = (0..).zip(known).map(move |(x, mirror)| {
            let scene = format!("moving-{mirror}-all-step-4");
            Point::new(f64::from(x), scene, technique)
        });
        Series::new(label, points)
    };
    Figure {
        anchor: "derivatives",
        title: "Where the surface is known exactly".to_owned(),
        after: "",
        question:
            "The same with point, normal and their derivatives from the shape itself instead of \
                   from differences between texels of the G-buffer."
                .to_owned(),
        axis: Axis::names("mirror", known.iter().copied()),
        series: [LENS, LENS_ANALYTIC, NEWTON, NEWTON_ANALYTIC]
            .map(of)
            .into(),
        quantities: vec![
            Quantity::log(MOTION_P50),
            Quantity::log(MOTION_P95),
            Quantity::linear(MOTION_MISSING),
            Quantity::linear(MOTION_MS).called("the pass (ms)"),
        ],
        quotes: &[],
        claims: claims::DERIVATIVES,
    }
}
