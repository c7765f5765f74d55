//! Sweeps: exactness and cost against the size of the faces, the number of maps, what drawing them
//! anew costs, and how many rays are followed.

use crate::show::number::{percent, short};
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{
    AGREEMENT, ANGLE, FRAME_MS, FULL_AGREEMENT, FULL_ANGLE, MAPS_MS, PYRAMID_MS, SAMPLES,
    UNRESOLVED,
};
use crate::suites::results::Results;
use crate::suites::results::power;
use crate::suites::series::{Ask, Series};

use super::data::{point, quantities};
use super::options::{cubemap, figure, values};

pub fn figures(scene: Option<&str>, scenes: &[&str]) -> Vec<Figure> {
    vec![
        faces(scenes),
        objects(scenes),
        rebuild(scenes),
        bounces(scene),
    ]
}

/// Sizes of faces and numbers of maps are swept with the criterion that does not err at
/// discontinuities, and with the published one.
const SWEPT: [(&str, &str); 2] = [
    ("continuous sign changes", "sampling=texel,pyramid=sound"),
    (
        "any, as published",
        "sampling=texel,pyramid=sound,accept=any",
    ),
];

/// The baseline's label and name.
const ENVIRONMENT: &str = "environment-map";

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
                label: format!("{scene}, {ENVIRONMENT}"),
                points: points(&|x| format!("{ENVIRONMENT}({option}={x})")),
            });
        }
    }
    series
}

fn faces(scenes: &[&str]) -> Figure {
    Figure {
        axis: Axis::log("texels a side of a face"),
        series: sweep(scenes, &[32, 64, 128, 256, 512], "size", true),
        quantities: rising_quantities(),
        analysis: |results| [rising(results), wrong(results)].concat(),
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
        quantities: rising_quantities(),
        analysis: |results| [rising(results), wrong(results)].concat(),
        ..figure(
            "objects",
            "Number of maps",
            "Číž 2017, section 3.8",
            "Maps placed one after the other, each for the pixels that those before leave.",
        )
    }
}

/// As everywhere, with agreement on an axis that shows how it rises.
fn rising_quantities() -> Vec<Quantity> {
    let mut all = quantities();
    all[0] = Quantity::close(AGREEMENT);
    all
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
            Quantity::log(MAPS_MS).called("drawing the maps (ms)"),
            Quantity::log(PYRAMID_MS).called("building the pyramid (ms)"),
            Quantity::log(FRAME_MS),
        ],
        quotes: match scenes.contains(&QUOTED) {
            true => &REBUILD,
            false => &[],
        },
        analysis: |results| {
            let series = results.series().iter();
            let sentences = series.filter_map(|series| {
                let grows = |path| power(&results.curve(&series.label, path)).map(short);
                Some(format!(
                    "{}: drawing the maps grows as the side to the power {} (2.0 in the thesis), the \
                     pyramid to the power {} (0.5): 2 is as the texels, less is a cost that does not \
                     depend on them, such as that of the scene's triangles.",
                    series.label,
                    grows(MAPS_MS)?,
                    grows(PYRAMID_MS)?
                ))
            });
            sentences.collect()
        },
        ..figure(
            "rebuild",
            "Maps and pyramid drawn anew",
            "Číž 2017, Table 5.2, last rows",
            "Two maps drawn in every frame, as a scene in motion needs it.",
        )
    }
}

/// The scene that is nearest to the thesis's first one.
const QUOTED: &str = "box";

const fn quote(what: &'static str, theirs: &'static str, x: f64, path: &'static str) -> Quote {
    Quote {
        what,
        theirs,
        on: "GT 540M",
        ours: Some(Ask {
            series: QUOTED,
            x,
            path,
            unit: "ms",
        }),
    }
}

const REBUILD: [Quote; 6] = [
    quote("maps, 128²", "8 ms", 128.0, MAPS_MS),
    quote("maps, 256²", "35 ms", 256.0, MAPS_MS),
    quote("maps, 512²", "136 ms", 512.0, MAPS_MS),
    quote("pyramid, 128²", "7 ms", 128.0, PYRAMID_MS),
    quote("pyramid, 256²", "10 ms", 256.0, PYRAMID_MS),
    quote("pyramid, 512²", "14 ms", 512.0, PYRAMID_MS),
];

const BOUNCES: [(&str, &str); 6] = [
    ("1", "bounces=1"),
    ("3", "bounces=3"),
    ("8", "bounces=8"),
    ("3, faces of 1024²", "bounces=3,size=1024"),
    ("3, clear sample", "bounces=3,restart=clear"),
    ("3, published bias", "bounces=3,bias=0.0005,accept=any"),
];

/// Places in that list.
const ONE: usize = 0;
const THREE: usize = 1;
const EIGHT: usize = 2;
const FINE: usize = 3;

/// A share of pixels below which agreement counts as unchanged along a sweep.
const CHANGE: f64 = 0.003;
/// A share of pixels below which more rays count as no better.
const DEEPER: f64 = 0.002;

fn bounces(scene: Option<&str>) -> Figure {
    let scenes = [scene.unwrap_or("bowl")];
    let figure = figure(
        "bounces",
        "Mirrors in mirrors",
        "Číž 2017, section 3.3 and chapter 4",
        "The maps show the mirror too, with its normal; a ray that meets it is reflected again. The \
         published bias is a share of the ray; ours goes with the width of a texel and the angle; the \
         alternative waits for a sample that is clear of the surface. The judge is the truth with \
         mirrors in mirrors.",
    );
    Figure {
        quantities: vec![
            Quantity::linear(FULL_AGREEMENT),
            Quantity::linear(AGREEMENT),
            Quantity::linear(UNRESOLVED),
            Quantity::log(SAMPLES),
            Quantity::log(FRAME_MS),
        ],
        analysis: limits,
        ..values(figure, "rays", &BOUNCES, &scenes)
    }
}

/// What keeps several rays from the truth with mirrors in mirrors.
fn limits(results: &Results<'_>) -> Vec<String> {
    let series = results.series().iter();
    let sentences = series.filter_map(|series| {
        let value = |place: usize, path| results.value(series.points.get(place)?, path);
        let full = |place| value(place, FULL_AGREEMENT).map(percent);
        let open = value(THREE, UNRESOLVED).unwrap_or(0.0);
        let deeper = match value(EIGHT, FULL_AGREEMENT)? - value(THREE, FULL_AGREEMENT)? < DEEPER {
            true => "more rays bring nothing",
            false => "more rays help",
        };
        Some(format!(
            "{}: one ray shows the right object on {} of the pixels, three on {}, eight on {}: {deeper}. \
             Faces of 1024² reach {} and take the median angle from {}° to {}° (a second ray starts with \
             the distance and normal of a texel). With three rays {} of the pixels are unresolved.",
            series.label,
            full(ONE)?,
            full(THREE)?,
            full(EIGHT)?,
            full(FINE)?,
            short(value(THREE, FULL_ANGLE)?),
            short(value(FINE, FULL_ANGLE)?),
            percent(open),
        ))
    });
    sentences.collect()
}

/// Whether agreement rises along each series, whether it is above the environment map's, and how the
/// angle goes.
fn rising(results: &Results<'_>) -> Vec<String> {
    let traced = |series: &&Series| !series.label.ends_with(ENVIRONMENT);
    let series = results.series().iter().filter(traced);
    let sentences = series.filter_map(|series| {
        let agreement = values_of(results, &series.label, AGREEMENT);
        let angle = values_of(results, &series.label, ANGLE);
        let (first, last) = (*agreement.first()?, *agreement.last()?);
        let steady = agreement.windows(2).all(|pair| pair[1] >= pair[0]);
        let strict = agreement.windows(2).all(|pair| pair[1] > pair[0]);
        let goes = if (last - first).abs() < CHANGE {
            "hardly changes"
        } else if last < first {
            "falls"
        } else if strict {
            "rises at every place"
        } else if steady {
            "rises, and nowhere falls"
        } else {
            "rises, not at every place"
        };
        Some(format!(
            "{}: the agreement {goes} ({} to {}{}); the median angle goes from {}° to {}°.",
            series.label,
            percent(first),
            percent(last),
            beside_environment(results, series, &agreement),
            short(*angle.first()?),
            short(*angle.last()?)
        ))
    });
    sentences.collect()
}

/// The comparison with the environment map of the same scene; nothing where there is none.
fn beside_environment(results: &Results<'_>, series: &Series, agreement: &[f64]) -> String {
    let Some(point) = series.points.first() else {
        return String::new();
    };
    let label = format!("{}, {ENVIRONMENT}", point.scene);
    let environment = values_of(results, &label, AGREEMENT);
    if environment.len() != agreement.len() {
        return String::new();
    }
    let mut pairs = agreement.iter().zip(&environment);
    let above = match pairs.all(|(ours, theirs)| ours > theirs) {
        true => "above",
        false => "not everywhere above",
    };
    let most = environment.iter().copied().fold(0.0, f64::max);
    format!(", {above} the environment map's, at most {}", percent(most))
}

fn values_of(results: &Results<'_>, label: &str, path: &str) -> Vec<f64> {
    let curve = results.curve(label, path).into_iter();
    curve.map(|(_, value)| value).collect()
}

/// What keeps the last place of the series with the best criterion from showing the right object
/// everywhere.
fn wrong(results: &Results<'_>) -> Vec<String> {
    let series = results.series().iter();
    let best = series.filter(|series| series.label.ends_with(SWEPT[0].0));
    let sentences = best.filter_map(|series| {
        let point = series.points.last()?;
        let value = |path| results.value(point, path);
        let open = value(UNRESOLVED).unwrap_or(0.0);
        Some(format!(
            "{}: what keeps the last place below 1 are {} of the pixels beside the edge of another \
             object and {} elsewhere; of all {} are unresolved, {} show an object in place of the background.",
            series.label,
            percent(value("mismatch.boundary")?),
            percent(value("mismatch.interior")?),
            percent(open),
            percent(value("coverage.extra")?)
        ))
    });
    sentences.collect()
}
