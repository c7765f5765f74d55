//! One option at a time: criterion, sampling, acceleration, face size, number of maps, stage, what
//! unresolved pixels show, bounces.

use crate::plot::Axis;
use crate::report::words::{percent, short};
use crate::suites::{Figure, Quantity, Results, Series};

use super::{AGREEMENT, ANGLE, FRAME_MS, SAMPLES, UNRESOLVED, by_scene, names, point, quantities};

/// Where one option is looked at.
const SCENES: [&str; 2] = ["sphere-objects-1k", "box"];

pub fn figures(scene: Option<&str>) -> Vec<Figure> {
    let own = scene.map(|scene| [scene]);
    let scenes = own.as_ref().map_or(SCENES.as_slice(), |scene| scene);
    vec![
        criteria(scenes),
        samplings(scenes),
        pyramids(scenes),
        unresolved(scenes),
        stages(scenes),
        faces(scenes),
        objects(scenes),
        rebuild(scenes),
        bounces(scene),
    ]
}

fn cubemap(options: &str) -> String {
    format!("cubemap-trace({options})")
}

/// A figure with an option's values along the axis.
fn values(figure: Figure, label: &str, values: &[(&str, &str)], scenes: &[&str]) -> Figure {
    let techniques: Vec<_> = values.iter().map(|(_, options)| cubemap(options)).collect();
    Figure {
        axis: names(label, values.iter().map(|(name, _)| *name)),
        series: by_scene(scenes, &techniques, Some(scenes[0])),
        quantities: quantities(),
        ..figure
    }
}

fn figure(anchor: &'static str, title: &str, after: &'static str, question: &str) -> Figure {
    Figure {
        anchor,
        title: title.to_owned(),
        after,
        question: question.to_owned(),
        axis: Axis::linear(""),
        series: Vec::new(),
        quantities: Vec::new(),
        quotes: Vec::new(),
        analysis: |_| Vec::new(),
    }
}

const CRITERIA: [(&str, &str); 5] = [
    ("distance", "criterion=distance"),
    ("analytic", "criterion=analytic"),
    ("both", "criterion=both"),
    ("switch", "criterion=switch"),
    ("continuous", "criterion=analytic,accept=continuous"),
];

fn criteria(scenes: &[&str]) -> Figure {
    let figure = Figure {
        analysis: |results| {
            compared(results, &CRITERIA, 1, 4, |any, continuous| {
                format!(
                    "accepting sign changes only where the map is continuous takes the agreement from \
                     {} to {}: false hits at the map's discontinuities are what keeps the published \
                     criterion below",
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
    ("step", "sampling=step"),
    ("angle", "sampling=angle"),
    ("texel", "sampling=texel"),
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
    ("off", "pyramid=off"),
    ("published", "pyramid=published"),
    ("sound", "pyramid=sound"),
    ("off, distance", "criterion=distance,pyramid=off"),
    (
        "published, distance",
        "criterion=distance,pyramid=published",
    ),
    ("sound, distance", "criterion=distance,pyramid=sound"),
];

fn pyramids(scenes: &[&str]) -> Figure {
    let mut quantities = quantities();
    quantities.push(Quantity::linear("skips per mirror pixel", "work.skips"));
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
                let samples = |x: usize| results.value(&series.points[x], SAMPLES);
                if let (Some(off), Some(sound)) = (samples(0), samples(2)) {
                    sentences.push(format!(
                        "{}: the sound skip test leaves {} of {} samples a pixel.",
                        series.label,
                        short(sound),
                        short(off)
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
             at the next step, and skips only what has the sign of the sample before.",
        )
    };
    Figure {
        quantities,
        ..values(figure, "pyramid", &PYRAMIDS, scenes)
    }
}

const UNRESOLVED_AS: [(&str, &str); 6] = [
    ("marked", "objects=1,accept=continuous,unresolved=mark"),
    (
        "environment",
        "objects=1,accept=continuous,unresolved=environment",
    ),
    (
        "background",
        "objects=1,accept=continuous,unresolved=background",
    ),
    (
        "neighbours",
        "objects=1,accept=continuous,unresolved=neighbours",
    ),
    ("best", "objects=1,accept=continuous,unresolved=best"),
    ("ray trace", "objects=1,accept=continuous,unresolved=trace"),
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
    let figure = figure(
        "stages",
        "Fragments or compute shaders",
        "Číž 2017, section 3.7, Alg. 3",
        "The thesis left the compute version unfinished: 32 lanes a ray that test the cells of a level \
         together. Its samples are cells tested, so they do not compare with the others'.",
    );
    values(figure, "stage", &STAGES, scenes)
}

/// Sizes of faces and numbers of maps are swept with the criterion that does not err at
/// discontinuities, and with the published one.
const SWEPT: [(&str, &str); 2] = [
    ("any sign change", "sampling=texel,pyramid=sound"),
    (
        "continuous ones",
        "sampling=texel,pyramid=sound,accept=continuous",
    ),
];

fn sweep(scenes: &[&str], xs: &[u32], option: &str, environment: bool) -> Vec<Series> {
    let mut series = Vec::new();
    for scene in scenes {
        let points = |technique: &dyn Fn(u32) -> String| {
            let points = xs.iter().map(|x| point(*x as usize, scene, technique(*x)));
            points.collect()
        };
        for (label, options) in SWEPT {
            series.push(Series {
                label: format!("{scene}, {label}"),
                points: points(&|x| cubemap(&format!("{option}={x},{options}"))),
            });
        }
        if environment {
            series.push(Series {
                label: format!("{scene}, environment-map"),
                points: points(&|x| format!("environment-map({option}={x})")),
            });
        }
    }
    series
}

fn faces(scenes: &[&str]) -> Figure {
    Figure {
        axis: Axis::log("texels a side of a face"),
        series: sweep(scenes, &[32, 64, 128, 256, 512], "size", true),
        quantities: quantities(),
        analysis: rising,
        ..figure(
            "faces",
            "Face size",
            "Číž 2017, Table 5.2",
            "Exactness and cost against the size of the faces.",
        )
    }
}

fn objects(scenes: &[&str]) -> Figure {
    Figure {
        axis: Axis::linear("maps"),
        series: sweep(scenes, &[1, 2, 3, 4], "objects", false),
        quantities: quantities(),
        analysis: rising,
        ..figure(
            "objects",
            "Number of maps",
            "Číž 2017, section 3.8",
            "Maps placed one after the other, each for the pixels that those before leave.",
        )
    }
}

fn rebuild(scenes: &[&str]) -> Figure {
    let sizes = [64_u32, 128, 256, 512];
    let series = |scene: &&str| Series {
        label: (*scene).to_owned(),
        points: sizes
            .iter()
            .map(|size| {
                let options = format!("size={size},update=frame,pyramid=sound,sampling=texel");
                point(*size as usize, scene, cubemap(&options))
            })
            .collect(),
    };
    Figure {
        axis: Axis::log("texels a side of a face"),
        series: scenes.iter().map(series).collect(),
        quantities: vec![
            Quantity::log("drawing the maps (ms)", "time_ms.passes.maps"),
            Quantity::log("building the pyramid (ms)", "time_ms.passes.pyramid"),
            Quantity::log("time of a frame (ms)", FRAME_MS),
        ],
        ..figure(
            "rebuild",
            "Maps and pyramid drawn anew",
            "Číž 2017, Table 5.2, last rows",
            "Two maps drawn in every frame, as a scene in motion needs it. The thesis quotes, on a GT \
             540M, for faces of 128², 256², 512²: 8, 35, 136 ms for the maps and 7, 10, 14 ms for the \
             pyramid.",
        )
    }
}

const BOUNCES: [(&str, &str); 4] = [
    ("1", "accept=continuous"),
    ("3", "accept=continuous,bounces=3"),
    (
        "3, clear sample",
        "accept=continuous,bounces=3,restart=clear",
    ),
    ("3, published bias", "bounces=3,bias=0.0005"),
];

fn bounces(scene: Option<&str>) -> Figure {
    let scenes = [scene.unwrap_or("bowl")];
    let figure = Figure {
        quantities: vec![
            Quantity::linear(
                "right object, mirrors in mirrors",
                "against_full.object_agreement",
            ),
            Quantity::linear("right object, first bounce", AGREEMENT),
            Quantity::linear("share of pixels unresolved", UNRESOLVED),
            Quantity::log("samples per mirror pixel", SAMPLES),
            Quantity::log("time of a frame (ms)", FRAME_MS),
        ],
        ..figure(
            "bounces",
            "Mirrors in mirrors",
            "Číž 2017, section 3.3 and chapter 4",
            "The maps show the mirror too, with its normal; a ray that meets it is reflected again. \
             The published bias is a share of the ray; ours goes with the width of a texel and the \
             angle; the alternative waits for a sample that is clear of the surface. The judge is the \
             truth with mirrors in mirrors.",
        )
    };
    let quantities = figure.quantities.clone();
    Figure {
        quantities,
        ..values(figure, "rays", &BOUNCES, &scenes)
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

/// How agreement and angle go from the first place to the last.
fn rising(results: &Results<'_>) -> Vec<String> {
    let series = results.series().iter();
    let sentences = series.filter_map(|series| {
        let ends = |path| {
            let curve = results.curve(&series.label, path);
            Some((curve.first()?.1, curve.last()?.1))
        };
        let (low, high) = ends(AGREEMENT)?;
        let (coarse, fine) = ends(ANGLE)?;
        Some(format!(
            "{}: from the first to the last place the right object goes from {} to {} of the pixels, \
             the median angle from {}° to {}°.",
            series.label,
            percent(low),
            percent(high),
            short(coarse),
            short(fine)
        ))
    });
    sentences.collect()
}
