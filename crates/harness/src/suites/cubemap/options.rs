//! One option at a time: criterion, sampling, acceleration, stage, what unresolved pixels show.

use crate::show::number::{percent, short};
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, NODE_TESTS, SAMPLES};
use crate::suites::results::Results;

use super::data::{by_scene, nodes, quantities};

pub fn figures(scenes: &[&str]) -> Vec<Figure> {
    vec![
        criteria(scenes),
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
        analysis: |_| Vec::new(),
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
        analysis: |results| {
            compared(results, &CRITERIA, 1, 4, |any, continuous| {
                format!(
                    "accepting sign changes only where the map is continuous takes the agreement from \
                     {} to {}",
                    percent(any),
                    percent(continuous)
                )
            })
        },
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

const SAMPLINGS: [(&str, &str); 3] = [
    ("step", "sampling=step,accept=any"),
    ("angle", "sampling=angle,accept=any"),
    ("texel", "sampling=texel,accept=any"),
];

fn samplings(scenes: &[&str]) -> Figure {
    let figure = figure(
        "samplings",
        "Where a ray is sampled",
        "Číž 2017, section 3.5",
        "Even steps, even angles, or each texel once, all with the analytical criterion.",
    );
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
        analysis: |results| {
            let mut sentences = compared(results, &PYRAMIDS, 0, 1, |off, published| {
                format!(
                    "with the published skip test {} of the pixels show the right object, without \
                     skipping {}",
                    percent(published),
                    percent(off)
                )
            });
            for series in results.series() {
                let value = |x: usize, path| results.value(&series.points[x], path);
                let (off, sound) = (value(0, SAMPLES), value(2, SAMPLES));
                if let (Some(off), Some(sound), Some(nodes)) = (off, sound, value(2, NODE_TESTS)) {
                    sentences.push(format!(
                        "{}: the sound skip test leaves {} of {} samples a pixel, for looks at {} cells \
                         of the pyramid.",
                        series.label,
                        short(sound),
                        short(off),
                        short(nodes)
                    ));
                }
            }
            sentences
        },
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
    let figure = figure(
        "unresolved",
        "What pixels show that no map resolves",
        "Číž 2017, Fig. 3.10 and section 3.9",
        "One map only, so that there are such pixels: a mark, an environment map, the background, the \
         nearest resolved pixels, the texel that came nearest to a hit, or the ray tracer.",
    );
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
    let figure = figure(
        "stages",
        "Fragments or compute shaders",
        "Číž 2017, section 3.7, Alg. 3",
        "The thesis left the compute version unfinished: 32 lanes a ray that test the cells of a level \
         together. Samples are distances looked up by any of them; where the lanes of a ray look at \
         the same, it counts once.",
    );
    Figure {
        quantities,
        ..values(figure, "stage", &STAGES, scenes)
    }
}

/// The agreement of two values of an option on each scene, put into words.
fn compared(
    results: &Results<'_>,
    values: &[(&str, &str)],
    one: usize,
    other: usize,
    words: impl Fn(f64, f64) -> String,
) -> Vec<String> {
    debug_assert!(one < values.len() && other < values.len());
    let series = results.series().iter();
    let sentences = series.filter_map(|series| {
        let agreement = |x: usize| results.value(series.points.get(x)?, AGREEMENT);
        let words = words(agreement(one)?, agreement(other)?);
        Some(format!("{}: {words}.", series.label))
    });
    sentences.collect()
}
