//! One option at a time: criterion, sampling, acceleration, stage, what unresolved pixels show.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::series::{Point, Series};

use super::claims;
use super::data::{SIZE, by_scene, nodes, quantities};

pub fn figures(scenes: &[&str]) -> Vec<Figure> {
    vec![
        criteria(scenes),
        steps(scenes),
        samplings(scenes),
        pyramids(scenes),
        unresolved(scenes),
        stages(scenes),
    ]
}

pub fn cubemap(options: &str) -> String {
    format!("cubemap-trace({options})")
}

/// A figure with an option's values along the axis.
pub fn values(figure: Figure, label: &str, values: &[(&str, &str)], scenes: &[&str]) -> Figure {
    let techniques: Vec<_> = values.iter().map(|(_, options)| cubemap(options)).collect();
    Figure {
        axis: Axis::names(label, values.iter().map(|(name, _)| *name)),
        series: by_scene(scenes, &techniques, Some(scenes[0])),
        quantities: quantities(),
        ..figure
    }
}

pub fn figure(anchor: &'static str, title: &str, after: &'static str, question: &str) -> Figure {
    Figure {
        anchor,
        title: title.to_owned(),
        after,
        question: question.to_owned(),
        axis: Axis::linear(""),
        series: Vec::new(),
        quantities: Vec::new(),
        quotes: &[],
        claims: &[],
    }
}

const CRITERIA: [(&str, &str); 5] = [
    ("distance", "criterion=distance"),
    ("analytic", "criterion=analytic,accept=any"),
    ("both", "criterion=both,accept=any"),
    ("switch", "criterion=switch,accept=any"),
    ("continuous", "criterion=analytic"),
];

fn criteria(scenes: &[&str]) -> Figure {
    let figure = Figure {
        claims: claims::CRITERIA,
        ..figure(
            "criteria",
            "Criteria of intersection",
            "Číž 2017, Fig. 5.3 and section 3.4",
            "A small distance to the map, a change of its sign, the first or else the second, either \
             by how much the ray turns; and the sign changes alone at which the map is continuous, \
             after halving the step.",
        )
    };
    values(figure, "criterion", &CRITERIA, scenes)
}

/// Lengths of a step, as shares of the ray.
const STEPS: [f64; 5] = [0.0005, 0.001, 0.002, 0.005, 0.01];

/// Both criteria at several lengths of the step.
fn steps(scenes: &[&str]) -> Figure {
    let criteria = [
        ("distance", "criterion=distance"),
        ("analytic", "criterion=analytic,accept=any"),
    ];
    let mut series = Vec::new();
    for scene in scenes {
        for (label, options) in criteria {
            let points = STEPS.map(|step| Point {
                resolution: Some(SIZE),
                ..Point::new(step, *scene, cubemap(&format!("{options},step={step}")))
            });
            series.push(Series::new(format!("{scene}, {label}"), points));
        }
    }
    Figure {
        axis: Axis::log("step, as a share of the ray"),
        series,
        quantities: quantities(),
        claims: claims::STEPS,
        ..figure(
            "steps",
            "The length of a step",
            "Číž 2017, sections 3.4 and 5.1",
            "Both criteria at even steps of several lengths. The distance that counts as a hit is 1.5 steps.",
        )
    }
}

const SAMPLINGS: [(&str, &str); 3] = [
    ("step", "sampling=step,accept=any"),
    ("angle", "sampling=angle,accept=any"),
    ("texel", "sampling=texel,accept=any"),
];

fn samplings(scenes: &[&str]) -> Figure {
    let figure = Figure {
        claims: claims::SAMPLINGS,
        ..figure(
            "samplings",
            "Where a ray is sampled",
            "Číž 2017, section 3.5",
            "Even steps, even angles, or each texel once, all with the analytical criterion.",
        )
    };
    values(figure, "sampling", &SAMPLINGS, scenes)
}

const PYRAMIDS: [(&str, &str); 6] = [
    ("off", "pyramid=off,accept=any"),
    ("published", "pyramid=published,accept=any"),
    ("sound", "pyramid=sound,accept=any"),
    ("off, distance", "criterion=distance,pyramid=off"),
    (
        "published, distance",
        "criterion=distance,pyramid=published",
    ),
    ("sound, distance", "criterion=distance,pyramid=sound"),
];

fn pyramids(scenes: &[&str]) -> Figure {
    let mut quantities = quantities();
    quantities.extend([nodes(), Quantity::linear("work.skips")]);
    let figure = Figure {
        claims: claims::PYRAMIDS,
        ..figure(
            "pyramids",
            "Skipping with a pyramid of distances",
            "Číž 2017, Alg. 2 and 4, Fig. 5.1",
            "The published test compares a cell's range with the distances at both ends of the ray \
             in it, though the nearest point may lie between; the sound one takes that point, goes on \
             at the next step, and skips only what has the sign of the sample before. Each picture \
             says which pixels a test changes, all else being equal.",
        )
    };
    Figure {
        quantities,
        ..values(figure, "pyramid", &PYRAMIDS, scenes)
    }
}

const UNRESOLVED_AS: [(&str, &str); 6] = [
    ("marked", "objects=1,unresolved=mark"),
    ("environment", "objects=1,unresolved=environment"),
    ("background", "objects=1,unresolved=background"),
    ("neighbours", "objects=1,unresolved=neighbours"),
    ("best", "objects=1,unresolved=best"),
    ("ray trace", "objects=1,unresolved=trace"),
];

fn unresolved(scenes: &[&str]) -> Figure {
    let figure = Figure {
        claims: claims::FILLINGS,
        ..figure(
            "unresolved",
            "What pixels show that no map resolves",
            "Číž 2017, Fig. 3.10 and section 3.9",
            "One map only, so that there are such pixels: a mark, an environment map, the background, the \
         nearest resolved pixels, the texel that came nearest to a hit, or the ray tracer.",
        )
    };
    values(figure, "filling", &UNRESOLVED_AS, scenes)
}

const STAGES: [(&str, &str); 3] = [
    ("fragment, step", "pyramid=sound"),
    ("fragment, texel", "sampling=texel,pyramid=sound"),
    ("compute", "stage=compute"),
];

fn stages(scenes: &[&str]) -> Figure {
    let mut quantities = quantities();
    quantities.push(nodes());
    let figure = Figure {
        claims: claims::STAGES,
        ..figure(
            "stages",
            "Fragments or compute shaders",
            "Číž 2017, section 3.7, Alg. 3",
            "The thesis left the compute version unfinished: 32 lanes a ray that test the cells of a level \
         together. Samples are distances looked up by any of them; where the lanes of a ray look at \
         the same, it counts once.",
        )
    };
    Figure {
        quantities,
        ..values(figure, "stage", &STAGES, scenes)
    }
}
