//! `catoptric bench tessellation`: adaptive against full tessellation of the reflected geometry,
//! Szabo 2013, chapter 5 and section 6.2, and Szabo CESCG, section 5.
//!
//! What the papers show as pictures and times stands here beside what they could not measure:
//! error against a ray-traced truth, so that "almost no visible difference" becomes a number.

use anyhow::Context;
use catoptric_frame::write_png;
use catoptric_scene::Scene;

use crate::pipeline;
use crate::plot::{Axis, Scale};
use crate::report::pictures::{FOLDER, slug};
use crate::report::words::{count, short};

use super::results::Results;
use super::{Figure, Picture, Point, Quantity, Quote, Series, Studio, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "tessellation",
    title: "Tessellation of the reflected geometry",
    why: "Straight edges between reflection points are not the curves that the mirror shows. How \
          far must triangles be split, what does it cost, and what does splitting only where an \
          error asks for it save?",
    figures,
    pictures: Some(geometry),
    timing_s: 90.0,
};

const FRAME_MS: &str = "time_ms.frame.median";
const AGREEMENT: &str = "object_agreement";
const ANGLE: &str = "angular_error_deg.p50";
const EDGES: &str = "edge_offset_px.p50";
const CRACK_PIXELS: &str = "coverage.crack_pixels";
const JUNCTIONS: &str = "coverage.t_junctions";
const SEARCHED: &str = "vertices.searched";
const DRAWN: &str = "triangles.drawn";

/// The thesis' scene, and CESCG's of coarse and fine models. The table is measured at a size at
/// which full tessellation to level 4 (2.6 million triangles) fits the suite's time.
const SQUARE: &str = "sphere-square";
const TABLE: &str = "sphere-table";
const TABLE_SIZE: [u32; 2] = [320, 240];

/// Level limits of Fig. 6.3 and of Fig. 9.
const SQUARE_LEVELS: u32 = 6;
const TABLE_LEVELS: u32 = 4;

/// The thesis' threshold.
const THRESHOLD: &str = "0.001";

/// On what both papers measured.
const PAPERS: &str = "Core 2 Duo, GTX 260";

const NONE: &str = "none";
const FULL: &str = "full";
const ADAPTIVE: &str = "adaptive";

fn full(level: u32) -> String {
    format!("linear+full(level={level})")
}

fn adaptive(level: u32, threshold: &str) -> String {
    format!("linear+adaptive(level={level},threshold={threshold})")
}

fn figures(scene: Option<&str>) -> Vec<Figure> {
    let square = scene.unwrap_or(SQUARE);
    let mut figures = vec![by_level(square), wireframes(square), visible_levels(square)];
    let table = Place::of(scene, TABLE);
    figures.extend([coarse_and_fine(&table), thresholds(&table), counts(&table)]);
    figures.insert(3, cracks(scene.unwrap_or("crack")));
    figures
}

/// A scene and the size in which it is measured.
struct Place {
    scene: String,
    size: Option<[u32; 2]>,
}

impl Place {
    /// The user's scene in its own size, or one of ours in the size for it.
    fn of(users: Option<&str>, ours: &str) -> Self {
        Self {
            scene: users.unwrap_or(ours).to_owned(),
            size: users.is_none().then_some(TABLE_SIZE),
        }
    }

    fn point(&self, x: f64, technique: impl Into<String>) -> Point {
        Point {
            resolution: self.size,
            ..Point::new(x, self.scene.clone(), technique)
        }
    }
}

/// Points at 0, 1, 2, …, one for each technique.
fn series(label: &str, points: impl IntoIterator<Item = Point>) -> Series {
    Series {
        label: label.to_owned(),
        points: points.into_iter().collect(),
    }
}

/// None, full and adaptive against the level limit.
fn three_modes(levels: u32, point: impl Fn(f64, String) -> Point) -> Vec<Series> {
    let points = |technique: &dyn Fn(u32) -> String| -> Vec<Point> {
        let at = |level: u32| point(f64::from(level), technique(level));
        (0..=levels).map(at).collect()
    };
    vec![
        series(NONE, points(&|_| "linear".to_owned())),
        series(FULL, points(&full)),
        series(ADAPTIVE, points(&|level| adaptive(level, THRESHOLD))),
    ]
}

fn accuracy() -> Vec<Quantity> {
    vec![
        Quantity::linear("right object (share of mirror pixels)", AGREEMENT),
        Quantity::log("median angular error (degrees)", ANGLE),
        Quantity::linear("median offset of edges (px)", EDGES),
    ]
}

fn quantities(first: impl IntoIterator<Item = Quantity>) -> Vec<Quantity> {
    first.into_iter().chain(accuracy()).collect()
}

fn named(label: &str, names: &[&str]) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Names(names.iter().map(|name| (*name).to_owned()).collect()),
    }
}

/// Thesis Fig. 6.3.
fn by_level(scene: &str) -> Figure {
    Figure {
        anchor: "levels",
        title: "Cost and error against the level limit".to_owned(),
        after: "Szabo 2013, Fig. 6.3 and 1.5",
        question: format!(
            "A square of two triangles under a mirror sphere, split at most so often; adaptive splits \
             where the edge error reaches {THRESHOLD}."
        ),
        axis: Axis::linear("level limit"),
        series: three_modes(SQUARE_LEVELS, |x, technique| {
            Point::new(x, scene, technique)
        }),
        quantities: quantities([
            Quantity::log("time of a frame (ms)", FRAME_MS),
            Quantity::log("searches", SEARCHED),
        ]),
        quotes: vec![Quote {
            what: "level that adaptive reaches at a threshold of 0.001",
            theirs: "never beyond 2",
            on: PAPERS,
            ours: None,
        }],
        analysis: level_analysis,
    }
}

/// How deep adaptive went: the deepest level with triangles, and the share of full's triangles at
/// that limit which were never made.
fn depth(results: &Results<'_>) -> Option<String> {
    let adaptive = results.last(ADAPTIVE)?;
    let full = results.last(FULL)?;
    let (adaptive, full) = (adaptive.triangles.as_ref()?, full.triangles.as_ref()?);
    let deepest = adaptive.by_level.iter().rposition(|count| *count > 0)?;
    let spared = 1.0 - adaptive.drawn as f64 / full.drawn as f64;
    let limit = adaptive.by_level.len() - 1;
    let verdict = if deepest <= 2 {
        "The paper's “never beyond level 2” holds here"
    } else {
        "The paper's “never beyond level 2” does not hold on this view of the scene"
    };
    Some(format!(
        "{verdict}: allowed {limit} levels at a threshold of {THRESHOLD}, adaptive goes to level {deepest} \
         and draws {} triangles where full draws {}: {} % are spared.",
        count(adaptive.drawn),
        count(full.drawn),
        short(100.0 * spared)
    ))
}

fn level_analysis(results: &Results<'_>) -> Vec<String> {
    let mut sentences: Vec<String> = depth(results).into_iter().collect();
    let last = f64::from(SQUARE_LEVELS);
    let at = |series, path| results.at(series, last, path);
    if let (Some(full), Some(adaptive)) = (at(FULL, FRAME_MS), at(ADAPTIVE, FRAME_MS)) {
        sentences.push(format!(
            "At a limit of {SQUARE_LEVELS} a frame takes {} ms with full and {} ms with adaptive tessellation.",
            short(full),
            short(adaptive)
        ));
    }
    if let (Some(full), Some(adaptive)) = (at(FULL, EDGES), at(ADAPTIVE, EDGES)) {
        sentences.push(format!(
            "“Practically the same” picture: edges lie {} px from the truth with full and {} px with \
             adaptive tessellation.",
            short(full),
            short(adaptive)
        ));
    }
    sentences.extend(floor(&results.curve(FULL, ANGLE)));
    sentences
}

/// Where the median angular error stops falling: the search answers with whole pixels, so that
/// each vertex is up to half a pixel off, however many there are.
fn floor(angles: &[(f64, f64)]) -> Option<String> {
    let first = angles.first()?;
    let least = angles.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let last = angles.last()?;
    let beyond = if last.0 > least.0 {
        format!(
            " Beyond, triangles shrink to the size of a pixel, their corners fall on the same few answers, \
             and the error rises again, to {}° at level {}.",
            short(last.1),
            last.0
        )
    } else {
        String::new()
    };
    Some(format!(
        "With full tessellation the median angular error falls from {}° at level {} to {}° at level {}, the \
         floor that whole-pixel answers set.{beyond}",
        short(first.1),
        first.0,
        short(least.1),
        least.0
    ))
}

/// Thesis Fig. 5.3 and 5.4.
fn wireframes(scene: &str) -> Figure {
    let techniques = ["linear".to_owned(), full(5), adaptive(5, THRESHOLD)];
    let points = (0..).zip(techniques);
    let points = points.map(|(x, technique)| Point::new(f64::from(x), scene, technique).shown());
    Figure {
        anchor: "wireframes",
        title: "None, full and adaptive".to_owned(),
        after: "Szabo 2013, Fig. 5.3 and 5.4",
        question: "The same reflection three times, shaded and as the triangles it is made of."
            .to_owned(),
        axis: named("tessellation", &[NONE, "full, 5 levels", ADAPTIVE]),
        series: vec![series("linear search", points)],
        quantities: quantities([Quantity::log("triangles drawn", DRAWN)]),
        quotes: Vec::new(),
        analysis: |_| Vec::new(),
    }
}

/// Thesis Fig. 6.4.
const SHOWN_LEVELS: [u32; 4] = [0, 2, 3, 4];

fn visible_levels(scene: &str) -> Figure {
    let points = (0..)
        .zip(SHOWN_LEVELS)
        .map(|(x, level)| Point::new(f64::from(x), scene, full(level)).shown());
    Figure {
        anchor: "visible",
        title: "Levels 0, 2, 3 and 4".to_owned(),
        after: "Szabo 2013, Fig. 6.4",
        question: "“After level 3, there is almost no visible difference”: what is the difference?"
            .to_owned(),
        axis: named("level", &["0", "2", "3", "4"]),
        series: vec![series(FULL, points)],
        quantities: quantities([Quantity::log("mean FLIP", "color.flip")]),
        quotes: Vec::new(),
        analysis: visible_analysis,
    }
}

fn visible_analysis(results: &Results<'_>) -> Vec<String> {
    let edges = results.curve(FULL, EDGES);
    let flip = results.curve(FULL, "color.flip");
    let (Some([.., three, four]), Some([.., flip_three, flip_four])) =
        (edges.get(2..), flip.get(2..))
    else {
        return Vec::new();
    };
    let verdict = if three.1 - four.1 < 0.5 {
        "less than half a pixel: the claim holds"
    } else {
        "more than half a pixel: the claim does not hold"
    };
    vec![format!(
        "From level 3 to level 4 the median offset of edges goes from {} to {} px, {verdict}; mean FLIP goes \
         from {} to {}.",
        short(three.1),
        short(four.1),
        short(flip_three.1),
        short(flip_four.1)
    )]
}

/// Thesis Fig. 6.5, CESCG Fig. 10a.
const CRACK_THRESHOLDS: [&str; 4] = ["0.1", "0.01", "0.001", "0.0001"];

fn cracks(scene: &str) -> Figure {
    let names = ["none", "0.1", "0.01", "0.001", "0.0001", "full"];
    let adaptive = CRACK_THRESHOLDS.map(|threshold| adaptive(5, threshold));
    let techniques = [vec!["linear".to_owned()], adaptive.to_vec(), vec![full(5)]].concat();
    let points = (0..).zip(techniques).map(|(x, technique)| {
        let point = Point::new(f64::from(x), scene, technique);
        if names[x as usize] == THRESHOLD {
            point.shown()
        } else {
            point
        }
    });
    Figure {
        anchor: "crack",
        title: "Cracks where neighbours are split differently".to_owned(),
        after: "Szabo 2013, Fig. 6.5, and Szabo CESCG, Fig. 10a",
        question:
            "A triangle is split by its worst edge, whatever its neighbour does: where a split \
                   edge meets an unsplit one the surface tears."
                .to_owned(),
        axis: named("threshold", &names),
        series: vec![series("up to 5 levels", points)],
        quantities: vec![
            Quantity::linear("pixels in cracks", CRACK_PIXELS),
            Quantity::linear("widest crack (px)", "coverage.widest_crack_px"),
            Quantity::linear("T-junctions", JUNCTIONS),
            Quantity::linear("right object (share of mirror pixels)", AGREEMENT),
        ],
        quotes: Vec::new(),
        analysis: crack_analysis,
    }
}

fn crack_analysis(results: &Results<'_>) -> Vec<String> {
    let pixels = results.curve("up to 5 levels", CRACK_PIXELS);
    let junctions = results.curve("up to 5 levels", JUNCTIONS);
    let most = |curve: &[(f64, f64)]| curve.iter().map(|(_, value)| *value).fold(0.0, f64::max);
    let (cracks, met) = (most(&pixels), most(&junctions));
    if pixels.is_empty() || junctions.is_empty() {
        return Vec::new();
    }
    vec![if cracks > 0.0 {
        format!(
            "The published rule leaves up to {} pixels of cracks and {} T-junctions, as both papers say; \
             full tessellation, which splits all alike, has none of the latter.",
            count(cracks as u64),
            count(met as u64)
        )
    } else {
        format!(
            "Up to {} T-junctions, and none opens a crack of a whole pixel here.",
            count(met as u64)
        )
    }]
}

/// CESCG Fig. 7.
fn coarse_and_fine(place: &Place) -> Figure {
    let techniques = ["linear".to_owned(), adaptive(4, THRESHOLD), full(4)];
    let points = (0..).zip(techniques);
    let points = points.map(|(x, technique)| place.point(f64::from(x), technique).shown());
    Figure {
        anchor: "table",
        title: "A coarse cloth and candlestick beside a fine teapot".to_owned(),
        after: "Szabo CESCG, Fig. 7",
        question:
            "Adaptive tessellation should split the coarse models and leave the fine one alone."
                .to_owned(),
        axis: named("tessellation", &[NONE, ADAPTIVE, "full, 4 levels"]),
        series: vec![series("linear search", points)],
        quantities: quantities([
            Quantity::log("time of a frame (ms)", FRAME_MS),
            Quantity::log("triangles drawn", DRAWN),
        ]),
        quotes: Vec::new(),
        analysis: table_analysis,
    }
}

fn table_analysis(results: &Results<'_>) -> Vec<String> {
    let time = results.curve("linear search", FRAME_MS);
    let edges = results.curve("linear search", EDGES);
    let (&[(_, _), (_, adaptive), (_, full)], &[(_, plain), (_, some), (_, all)]) =
        (time.as_slice(), edges.as_slice())
    else {
        return Vec::new();
    };
    vec![format!(
        "Edges lie {} px off without tessellation, {} px with adaptive and {} px with full tessellation; \
         full takes {} times adaptive's time.",
        short(plain),
        short(some),
        short(all),
        short(full / adaptive)
    )]
}

/// CESCG Fig. 8, from none to full.
const THRESHOLDS: [&str; 8] = ["1", "0.1", "0.03", "0.01", "0.003", "0.001", "0.0001", "0"];

fn thresholds(place: &Place) -> Figure {
    let points = (0..).zip(THRESHOLDS).map(|(x, threshold)| {
        let point = place.point(f64::from(x), adaptive(TABLE_LEVELS, threshold));
        match threshold {
            "1" | "0.1" | "0.01" | "0.001" => point.shown(),
            _ => point,
        }
    });
    Figure {
        anchor: "thresholds",
        title: "From no tessellation to full, by the threshold".to_owned(),
        after: "Szabo CESCG, Fig. 8",
        question: format!(
            "The threshold decides between accuracy and time; up to {TABLE_LEVELS} levels."
        ),
        axis: named("threshold", &THRESHOLDS),
        series: vec![series(ADAPTIVE, points)],
        quantities: quantities([
            Quantity::log("time of a frame (ms)", FRAME_MS),
            Quantity::log("triangles drawn", DRAWN),
            Quantity::linear("pixels in cracks", CRACK_PIXELS),
        ]),
        quotes: vec![
            Quote {
                what: "threshold of 0.1 or larger",
                theirs: "too coarse",
                on: "by eye",
                ours: None,
            },
            Quote {
                what: "threshold between 0.01 and 0.1",
                theirs: "perfectly acceptable",
                on: "by eye",
                ours: None,
            },
            Quote {
                what: "threshold near 0",
                theirs: "no longer interactive",
                on: PAPERS,
                ours: None,
            },
        ],
        analysis: threshold_analysis,
    }
}

fn threshold_analysis(results: &Results<'_>) -> Vec<String> {
    let place = |wanted: &str| THRESHOLDS.iter().position(|threshold| *threshold == wanted);
    let at = |threshold: &str, path: &str| {
        let x = place(threshold)? as f64;
        let curve = results.curve(ADAPTIVE, path);
        curve
            .iter()
            .find(|(other, _)| *other == x)
            .map(|(_, value)| *value)
    };
    let edges = |threshold: &str| at(threshold, EDGES);
    let (Some(coarse), Some(middle), Some(fine)) = (edges("0.1"), edges("0.01"), edges("0")) else {
        return Vec::new();
    };
    let off = |value: f64| short(value - fine);
    let mut sentences = vec![format!(
        "Full tessellation leaves edges {} px from the truth. A threshold of 0.1 adds {} px to that and \
         one of 0.01 adds {} px.",
        short(fine),
        off(coarse),
        off(middle)
    )];
    if let (Some(some), Some(all)) = (at("0.01", FRAME_MS), at("0", FRAME_MS)) {
        sentences.push(format!(
            "A threshold of 0 takes {} times the time of 0.01.",
            short(all / some)
        ));
    }
    sentences
}

/// CESCG Fig. 9.
fn counts(place: &Place) -> Figure {
    Figure {
        anchor: "counts",
        title: "Vertices by level and mode".to_owned(),
        after: "Szabo CESCG, Fig. 9",
        question: "How many triangles (three vertices each, as the papers draw them) and how many \
                   searches a level limit leads to."
            .to_owned(),
        axis: Axis::linear("level limit"),
        series: three_modes(TABLE_LEVELS, |x, technique| place.point(x, technique)),
        quantities: vec![
            Quantity::log("triangles drawn", DRAWN),
            Quantity::log("searches", SEARCHED),
            Quantity::log("time of a frame (ms)", FRAME_MS),
            Quantity::linear("median offset of edges (px)", EDGES),
        ],
        quotes: Vec::new(),
        analysis: |results| depth(results).into_iter().collect(),
    }
}

/// The virtual geometry itself: edges of the triangles, and how often each was split.
fn geometry(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let square = studio.scene.unwrap_or(SQUARE);
    let crack = studio.scene.unwrap_or("crack");
    let table = studio.scene.unwrap_or(TABLE);
    let wanted = [
        ("wireframes", square, String::new(), "not split"),
        (
            "wireframes",
            square,
            "+full(level=5)".to_owned(),
            "split five times",
        ),
        (
            "wireframes",
            square,
            format!("+adaptive(threshold={THRESHOLD})"),
            "split where needed",
        ),
        (
            "crack",
            crack,
            format!("+adaptive(threshold={THRESHOLD})"),
            "split where needed",
        ),
        ("table", table, String::new(), "not split"),
        (
            "table",
            table,
            format!("+adaptive(level=4,threshold={THRESHOLD})"),
            "split where needed",
        ),
    ];
    let mut pictures = Vec::new();
    for (figure, scene, refinement, what) in wanted {
        for (show, words) in [("wireframe", "edges"), ("levels", "levels")] {
            if let Some(picture) = draw(studio, scene, show, &refinement)? {
                let caption = format!("{scene}, {what}: the {words} of the virtual triangles.");
                let alt = format!("The reflection with the {words} of its triangles, {what}");
                pictures.push(Picture {
                    figure,
                    caption,
                    alt,
                    ..picture
                });
            }
        }
    }
    Ok(pictures)
}

fn draw(
    studio: &Studio<'_>,
    scene: &str,
    show: &str,
    refinement: &str,
) -> anyhow::Result<Option<Picture>> {
    let spec = crate::setup::parse(&format!("linear(show={show}){refinement}"))?;
    let scene = Scene::load(scene, &crate::setup::load_options(studio.common))?;
    let Ok(rendered) = pipeline::render(&studio.setup.gpu, &spec, &scene) else {
        return Ok(None);
    };
    let path = format!(
        "{FOLDER}/{}.{}.png",
        slug(&scene.name),
        slug(&spec.to_string())
    );
    let file = studio.folder.join(&path);
    let color = &rendered.output.frame.color;
    write_png(color, &file).with_context(|| format!("cannot write {}", file.display()))?;
    Ok(Some(Picture {
        figure: "",
        path,
        size: color.size(),
        caption: String::new(),
        alt: String::new(),
    }))
}
