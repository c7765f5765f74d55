//! Sweeps: exactness and cost against the size of the faces, the number of maps, what drawing them
//! anew costs, and how many rays are followed.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{
    AGREEMENT, FRAME_MS, FULL_AGREEMENT, FULL_ANGLE, MAPS_MS, PYRAMID_MS, SAMPLES, TRACE_MS,
    UNRESOLVED,
};
use crate::suites::series::{Ask, Series};

use super::claims;
use super::data::{point, quantities};
use super::labels::{ENVIRONMENT, SWEPT};
use super::options::{cubemap, figure, values};

pub fn figures(scene: Option<&str>, scenes: &[&str]) -> Vec<Figure> {
    vec![
        faces(scenes),
        objects(scenes),
        rebuild(scenes),
        bounces(scene),
    ]
}

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
        claims: claims::FACES,
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
        claims: claims::OBJECTS,
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
            Quantity::log(MAPS_MS).called("drawing the maps (ms)"),
            Quantity::log(PYRAMID_MS).called("building the pyramid (ms)"),
            Quantity::log(FRAME_MS),
        ],
        quotes: match scenes.contains(&QUOTED) {
            true => &REBUILD,
            false => &[],
        },
        claims: claims::REBUILD,
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
            Quantity::log(FULL_ANGLE),
            Quantity::linear(UNRESOLVED),
            Quantity::log(SAMPLES),
            Quantity::log(FRAME_MS),
        ],
        claims: claims::BOUNCES,
        ..values(figure, "rays", &BOUNCES, &scenes)
    }
}

/// As everywhere, with agreement on an axis that shows how it rises.
fn rising_quantities() -> Vec<Quantity> {
    let mut all = quantities();
    all[0] = Quantity::close(AGREEMENT);
    all.push(Quantity::log(TRACE_MS).called("tracing pass (ms)"));
    all
}
