//! The report: scenes by the techniques that say most about each, on one page, a section a scene.

use catoptric_scene::LoadOptions;
use catoptric_scene::builtin;
use catoptric_scene::list::SceneInfo;

use crate::record::technique::refines;
use crate::show::plot::{Axis, Scale};

use super::figure::Figure;
use super::series::{Point, Series};
use super::shelf;
use super::suite::{Asked, Budget, Layout, Suite};

/// A handful of scenes, small pictures.
pub const QUICK: Suite = Suite {
    name: "quick",
    title: "Reflections on curved mirrors",
    why: "How exact, how fast and how steady is a real-time reflection on a curved mirror?",
    figures: |asked| {
        figures(
            &scenes(asked, || QUICK_SCENES.map(str::to_owned).to_vec()),
            false,
        )
    },
    judged: None,
    pictures: None,
    // With all else the whole stays within three minutes.
    timing: Budget::EachScene(40.0 / QUICK_SCENES.len() as f64),
    resolution: None,
    layout: Layout::Scenes,
};

/// Every scene whose model is here.
pub const FULL: Suite = Suite {
    name: "full",
    figures: |asked| figures(&scenes(asked, || available(&asked.load)), true),
    timing: Budget::EachScene(6.0),
    resolution: Some([640, 480]),
    ..QUICK
};

/// Scenes of the quick suite: the first is the page's first picture.
const QUICK_SCENES: [&str; 10] = [
    "sphere-table",
    "sphere-objects-20k",
    "spheres",
    "ellipsoid",
    "bowl",
    "planar",
    "sphere-square",
    "sphere-touching",
    "moving-ball-all-step-4",
    "moving-bowl-all-step-4",
];

/// Of scenes that are about the motion of reflections.
const ESTIMATORS: [&str; 4] = [
    "motion-surface",
    "motion-flat",
    "motion-lens",
    "motion-newton",
];

/// Both published searches, what games use instead, the mirrored eye for flat mirrors, our exact one for
/// any, and the control.
const TECHNIQUES: [&str; 6] = [
    shelf::LINEAR.1,
    shelf::RAY_HIERARCHY.1,
    shelf::ENVIRONMENT_MAP.1,
    shelf::PLANAR.1,
    shelf::BEAMS.1,
    shelf::CONTROL.1,
];

/// Techniques on the scenes that show best what they are about: all of them on all scenes would take the
/// quick suite too long. They come after `linear`.
const FEATURED: [(&str, &[&str]); 5] = [
    // Few large triangles, and coarse models beside fine ones.
    ("linear+full(level=3)", &["sphere-square"]),
    (
        "linear+adaptive(level=3)",
        &["sphere-square", "sphere-table"],
    ),
    (
        shelf::LINEAR_CROSS.1,
        &["sphere-objects-20k", "spheres", "ellipsoid", "bowl"],
    ),
    (
        shelf::REFLECTOR_CUBEMAP.1,
        &["sphere-table", "ellipsoid", "sphere-touching"],
    ),
    (
        shelf::CUBEMAP.1,
        &["sphere-table", "bowl", "sphere-touching"],
    ),
];

/// What is measured on a scene. `everywhere`: the featured techniques too, but for refinements, which
/// make of large scenes more triangles than time allows.
fn techniques(scene: &str, everywhere: bool) -> Vec<&'static str> {
    if builtin::is_single_step(scene) {
        return ESTIMATORS.to_vec();
    }
    let featured = FEATURED.iter().filter(|(technique, scenes)| {
        scenes.contains(&scene) || (everywhere && !refines(technique))
    });
    let all = TECHNIQUES[..1].iter().copied();
    let all = all.chain(featured.map(|(technique, _)| *technique));
    all.chain(TECHNIQUES[1..].iter().copied()).collect()
}

/// The scene asked for, else the suite's own.
fn scenes(asked: &Asked<'_>, own: impl Fn() -> Vec<String>) -> Vec<String> {
    match asked.scene {
        Some(scene) => vec![scene.to_owned()],
        None => own(),
    }
}

/// Names of the built-in scenes whose models are here.
fn available(load: &LoadOptions) -> Vec<String> {
    let infos = catoptric_scene::list::builtin(load).into_iter();
    let worth_it = |info: &SceneInfo| {
        let quick = QUICK_SCENES.contains(&info.name.as_str());
        info.available && (quick || !builtin::is_single_step(&info.name))
    };
    let infos = infos.filter(worth_it);
    infos.map(|info| info.name).collect()
}

/// One figure: a series a scene, its points the techniques.
fn figures(scenes: &[String], everywhere: bool) -> Vec<Figure> {
    let series = |scene: &String| {
        let techniques = (0..).zip(techniques(scene, everywhere));
        let point = |(x, technique)| Point::new(f64::from(x), scene, technique).shown();
        Series {
            label: scene.clone(),
            points: techniques.map(point).collect(),
        }
    };
    vec![Figure {
        anchor: "scenes",
        title: "All scenes".to_owned(),
        after: "",
        question: String::new(),
        axis: Axis {
            label: "technique".to_owned(),
            scale: Scale::Linear,
        },
        series: scenes.iter().map(series).collect(),
        quantities: Vec::new(),
        quotes: &[],
        claims: &[],
    }]
}
