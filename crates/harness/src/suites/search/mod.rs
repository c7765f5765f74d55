//! `catoptric bench search`: searches against each other, Szabo 2013, chapters 4 and 6.
//!
//! Frame and search time against the number of vertices (Fig. 6.1 and 6.2), and two scenes of
//! objects (Fig. 4.3), with work and accuracy on the same axes.

use anyhow::Context;
use catoptric_frame::{Image, Status as Pixel, write_png_rgb8};
use catoptric_scene::Scene;
use glam::Vec3;

use crate::plot::{Axis, Scale};
use crate::report::pictures::{FOLDER, slug};
use crate::report::words::{count, short};

use super::results::{Results, line, power};
use super::{Ask, Figure, Picture, Point, Quantity, Quote, Series, Studio, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "search",
    title: "Searches for reflection points",
    why: "What does it cost to find where each vertex is seen in the mirror, how does the cost grow \
          with the vertices, and how exact are the answers?",
    figures,
    pictures: Some(maps),
    timing_s: 120.0,
};

/// Series of every figure: label and technique.
const SEARCHES: [(&str, &str); 2] = [
    ("linear", "linear"),
    (
        "linear, 8 neighbours, cross",
        "linear(neighbours=8,residual=cross)",
    ),
];

/// The built-in family's sizes: the name's ending, and the vertices of its grid.
const SIZES: [(&str, u32); 7] = [
    ("100", 100),
    ("300", 289),
    ("1k", 1_024),
    ("3k", 3_025),
    ("10k", 10_000),
    ("30k", 29_929),
    ("100k", 99_856),
];

/// The pass that searches.
const SEARCH_MS: &str = "time_ms.passes.search";
const FRAME_MS: &str = "time_ms.frame.median";
const EVALUATIONS: &str = "work.evaluations";

/// On what the thesis measured.
const THESIS: &str = "Core 2 Duo, GTX 260";

fn figures(scene: Option<&str>) -> Vec<Figure> {
    if let Some(scene) = scene {
        return vec![objects(&[(scene, scene)], Vec::new())];
    }
    let scenes = [
        ("about 20 000 vertices", "sphere-objects-20k"),
        ("about 1 000 vertices", "sphere-objects-1k"),
    ];
    vec![
        objects(&scenes, object_quotes()),
        growth(
            "vertices",
            "Cost against the number of vertices",
            "Szabo 2013, Fig. 6.1",
            "A square under a mirror sphere, cut finer and finer; the mirror is a part of the picture.",
            "sphere-grid-",
        ),
        growth(
            "vertices-full",
            "The same with a mirror that fills the view",
            "Szabo 2013, Fig. 6.2",
            "Every pixel is a mirror pixel, so that a walk across the mirror is as long as it gets.",
            "sphere-grid-full-",
        ),
    ]
}

/// Fig. 4.3: every search on a few scenes.
fn objects(scenes: &[(&str, &str)], quotes: Vec<Quote>) -> Figure {
    let names = scenes.iter().map(|(name, _)| (*name).to_owned()).collect();
    let series = |(label, technique): &(&str, &str)| Series {
        label: (*label).to_owned(),
        points: scenes
            .iter()
            .enumerate()
            .map(|(x, (_, scene))| Point::new(x as f64, *scene, *technique).shown())
            .collect(),
    };
    Figure {
        anchor: "objects",
        title: "Searches on a scene of objects".to_owned(),
        after: "Szabo 2013, Fig. 4.3",
        question: "The same picture by every search: its time, its work and its error.".to_owned(),
        axis: Axis {
            label: "scene".to_owned(),
            scale: Scale::Names(names),
        },
        series: SEARCHES.iter().map(series).collect(),
        quantities: quantities(Quantity::linear),
        quotes,
        analysis: objects_analysis,
    }
}

fn object_quotes() -> Vec<Quote> {
    let frame = |x| {
        Some(Ask {
            series: SEARCHES[0].0,
            x,
            path: FRAME_MS,
            unit: "ms",
        })
    };
    let quote = |what, theirs, ours| Quote {
        what,
        theirs,
        on: THESIS,
        ours,
    };
    vec![
        quote(
            "linear search, about 20 000 vertices",
            "90 ms a frame",
            frame(0.0),
        ),
        quote(
            "linear search, about 1 000 vertices",
            "8 ms a frame",
            frame(1.0),
        ),
    ]
}

fn growth(
    anchor: &'static str,
    title: &str,
    after: &'static str,
    question: &str,
    family: &str,
) -> Figure {
    let series = |(label, technique): &(&str, &str)| Series {
        label: (*label).to_owned(),
        points: SIZES
            .iter()
            .map(|(size, vertices)| {
                let point = Point::new(f64::from(*vertices), format!("{family}{size}"), *technique);
                match (*size, *label) {
                    ("1k", "linear") => point.shown(),
                    _ => point,
                }
            })
            .collect(),
    };
    Figure {
        anchor,
        title: title.to_owned(),
        after,
        question: question.to_owned(),
        axis: Axis::log("vertices"),
        series: SEARCHES.iter().map(series).collect(),
        quantities: quantities(Quantity::log),
        quotes: Vec::new(),
        analysis: growth_analysis,
    }
}

fn quantities(time: fn(&'static str, &'static str) -> Quantity) -> Vec<Quantity> {
    vec![
        time("time of a frame (ms)", FRAME_MS),
        time("search pass (ms)", SEARCH_MS),
        Quantity::linear("evaluations per vertex", EVALUATIONS),
        Quantity::linear("mean offset (px)", "vertices.offset_px.mean"),
    ]
}

fn objects_analysis(results: &Results<'_>) -> Vec<String> {
    let mut sentences = Vec::new();
    let (first, _) = SEARCHES[0];
    for (other, _) in &SEARCHES[1..] {
        let time = results.ratios(other, first, SEARCH_MS);
        let work = results.ratios(other, first, EVALUATIONS);
        if let (Some((_, time)), Some((_, work))) = (time.first(), work.first()) {
            sentences.push(format!(
                "On the first scene “{other}” takes {} times the search time of “{first}” and {} times \
                 its evaluations.",
                short(*time),
                short(*work)
            ));
        }
    }
    sentences
}

fn growth_analysis(results: &Results<'_>) -> Vec<String> {
    SEARCHES
        .iter()
        .filter_map(|(label, _)| {
            let search = results.curve(label, SEARCH_MS);
            let growth = power(search.get(search.len() / 2..)?)?;
            let (constant, slope) = line(&results.curve(label, FRAME_MS))?;
            let (most, _) = search.last()?;
            Some(format!(
                "“{label}”: up to {} vertices the search pass grows as the vertices to the power {} \
                 (upper half of the sizes); a whole frame costs about {} ms and {} ms more per 1\u{2009}000 \
                 vertices.",
                count(*most as u64),
                short(growth),
                short(constant),
                short(1000.0 * slope)
            ))
        })
        .collect()
}

/// Fig. 3.1: the position and the normal map, in which every search looks.
fn maps(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let name = studio.scene.unwrap_or("sphere-objects-1k");
    let options = crate::setup::load_options(studio.common);
    let scene = Scene::load(name, &options)?;
    let spec = crate::setup::parse("linear")?;
    let rendered = crate::pipeline::render(&studio.setup.gpu, &spec, &scene);
    let Ok(rendered) = rendered else {
        return Ok(Vec::new());
    };
    let frame = &rendered.output.frame;
    let (Some(primary), Some(reflected)) = (&frame.primary, &frame.reflected) else {
        return Ok(Vec::new());
    };
    let mask = reflected.status.map(|status| *status != Pixel::NotMirror);
    let maps = [
        ("position", &primary.position, "positions"),
        ("normal", &primary.normal, "normals"),
    ];
    maps.into_iter()
        .map(|(kind, map, what)| {
            let path = format!("{FOLDER}/{}.{kind}.png", slug(&scene.name));
            let file = studio.folder.join(&path);
            write_png_rgb8(&as_rgb(map, &mask), &file)
                .with_context(|| format!("cannot write {}", file.display()))?;
            Ok(Picture {
                figure: "objects",
                path,
                size: map.size(),
                caption: format!(
                    "{}: {what} of the mirror as red, green and blue (Fig. 3.1).",
                    scene.name
                ),
                alt: format!("Map of the mirror's {what}, x, y and z as red, green and blue"),
            })
        })
        .collect()
}

/// Vectors as colours, each component stretched over its range inside the mask; grey outside.
fn as_rgb(map: &Image<Vec3>, mask: &Image<bool>) -> Image<[u8; 3]> {
    let pixels = || {
        map.pixels()
            .iter()
            .copied()
            .zip(mask.pixels().iter().copied())
    };
    let inside = || pixels().filter_map(|(value, inside)| inside.then_some(value));
    let low = inside().reduce(Vec3::min).unwrap_or_default();
    let high = inside().reduce(Vec3::max).unwrap_or_default();
    let span = (high - low).max(Vec3::splat(f32::MIN_POSITIVE));
    let colors = pixels().map(|(value, inside)| match inside {
        true => (255.0 * (value - low) / span)
            .to_array()
            .map(|channel| channel.round() as u8),
        false => [128; 3],
    });
    Image::from_vec(map.size(), colors.collect())
}
