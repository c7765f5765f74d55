//! What `cargo bench` times of the techniques: groups of scenes by techniques, and the check that a
//! picture is right before its time counts.
//!
//! The techniques are those of the registry; here stand only the variants of them that a comparison
//! needs, and the errors that a picture may have.

use catoptric_frame::Status as Pixel;
use catoptric_reflect::{
    Family, FrameTime, Gpu, STAGE_PASSES, Spec, Support, TechniqueInfo, Values, list,
};
use catoptric_scene::{LoadOptions, Scene};

use crate::options::Common;
use crate::run::compare::{Compared, compare};
use crate::run::progress::Progress;
use crate::run::render::{Rendered, render};
use crate::run::truth::{Truth, trace_reference};

const LINEAR_VS_HIERARCHY: &str = "linear-vs-hierarchy";
const ADAPTIVE_VS_FULL: &str = "adaptive-vs-full";
const IMAGE_ORDER: &str = "image-order";

/// Picture size of all groups.
pub const SIZE: [u32; 2] = [320, 240];

/// Levels of tessellation that are compared.
const LEVELS: [u32; 5] = [1, 2, 3, 4, 5];

/// Most triangles that a software adapter is made to draw in a frame: more take seconds each, and
/// the least number of samples minutes.
const MOST_IN_SOFTWARE: usize = 100_000;

/// Ways to run a search that the comparison of linear and hierarchy tells apart.
const SEARCH_VARIANTS: [(&str, &str); 3] = [
    ("start", "previous"),
    ("repair", "enlarge"),
    ("repair", "stop"),
];

/// How wrong a picture may be whose time counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Share of the mirror pixels that do not show the object that the truth shows: another one, none,
    /// one too many, or no answer.
    pub wrong: f64,
    /// Median angular error, degrees.
    pub median_deg: f64,
}

/// Of exact techniques and of searches that answer with pixels.
const CLOSE: Limit = Limit {
    wrong: 0.03,
    median_deg: 2.0,
};

/// Techniques that are published as less exact, by the beginning of their names. Each limit is some
/// one and a half times what was measured at [`SIZE`] in the scenes of its group.
const PUBLISHED: [(&str, Limit); 4] = [
    (
        "ray-hierarchy(repair=stop)",
        Limit {
            wrong: 0.04,
            median_deg: 15.0,
        },
    ),
    (
        "ray-hierarchy",
        Limit {
            wrong: 0.1,
            median_deg: 2.0,
        },
    ),
    (
        "cubemap-trace",
        Limit {
            wrong: 0.08,
            median_deg: 2.0,
        },
    ),
    (
        "environment-map",
        // 21 % in `planar`, which has no centre that a map could be taken from.
        Limit {
            wrong: 0.31,
            median_deg: 60.0,
        },
    ),
];

/// What a tessellation of so many levels leaves wrong, none first: some one and a half times what
/// `linear` shows with it in the scenes of the group.
const TESSELLATED: [Limit; 4] = [
    Limit {
        wrong: 0.25,
        median_deg: 14.0,
    },
    Limit {
        wrong: 0.16,
        median_deg: 4.0,
    },
    Limit {
        wrong: 0.06,
        median_deg: 2.5,
    },
    Limit {
        wrong: 0.05,
        median_deg: 2.5,
    },
];

/// A technique in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Bench {
    /// Group that it is shown in.
    pub group: &'static str,
    /// Built-in scene.
    pub scene: &'static str,
    /// Name with its options.
    pub technique: String,
    /// How wrong its picture may be.
    pub limit: Limit,
    /// Every triangle becomes four, so many times.
    splits: u32,
}

impl Bench {
    fn spec(&self) -> Spec {
        catoptric_reflect::parse(&self.technique).expect("a name made of the registry's")
    }
}

/// All benches, by group and scene.
pub fn benches() -> Vec<Bench> {
    let groups = [linear_vs_hierarchy(), adaptive_vs_full(), image_order()];
    groups.concat()
}

/// Techniques of a family.
fn of(family: Family) -> impl Iterator<Item = &'static TechniqueInfo> {
    let all = list().into_iter();
    all.filter(move |info| info.family == family)
}

fn limit(technique: &str) -> Limit {
    let published = PUBLISHED
        .iter()
        .find(|(name, _)| technique.starts_with(name));
    published.map_or(CLOSE, |(_, limit)| *limit)
}

/// Whether a technique has an option that may be this word.
fn takes(info: &TechniqueInfo, option: &str, word: &str) -> bool {
    info.options().any(|known| {
        let words = match known.values {
            Values::Words(words) => words,
            Values::Whole { .. } | Values::Number { .. } => &[],
        };
        known.name == option && words.contains(&word)
    })
}

/// Every search, as published and in the variants that are compared, by growing numbers of vertices.
fn linear_vs_hierarchy() -> Vec<Bench> {
    let techniques: Vec<String> = of(Family::Search)
        .flat_map(|info| {
            let variants = SEARCH_VARIANTS.iter();
            let taken = variants.filter(|(option, word)| takes(info, option, word));
            let named = taken.map(|(option, word)| format!("{}({option}={word})", info.name));
            std::iter::once(info.name.to_owned()).chain(named)
        })
        .collect();
    let scenes = ["sphere-grid-100", "sphere-grid-10k"];
    product(LINEAR_VS_HIERARCHY, &scenes, &techniques)
}

/// Every refinement with the linear search, and none; those that have levels at each of them.
fn adaptive_vs_full() -> Vec<Bench> {
    let bench = |scene, technique: String, level: u32| Bench {
        group: ADAPTIVE_VS_FULL,
        scene,
        technique,
        limit: TESSELLATED[(level as usize).min(TESSELLATED.len() - 1)],
        splits: 0,
    };
    let mut benches = Vec::new();
    for scene in ["sphere-square", "sphere-table"] {
        benches.push(bench(scene, "linear".to_owned(), 0));
        for info in of(Family::Refinement) {
            let name = info.name;
            if !info.options().any(|option| option.name == "level") {
                // What interpolates between the vertices is made for finer meshes than these.
                if scene == "sphere-square" {
                    benches.push(bench(scene, format!("linear{name}"), 0));
                }
                continue;
            }
            // A refinement without another criterion splits all.
            let splits_all = info.options().count() == 1;
            benches.extend(LEVELS.map(|level| Bench {
                splits: if splits_all { level } else { 0 },
                ..bench(scene, format!("linear{name}(level={level})"), level)
            }));
        }
    }
    benches
}

/// Every technique of image order, where it applies.
fn image_order() -> Vec<Bench> {
    let techniques: Vec<String> = of(Family::ImageOrder)
        .map(|info| info.name.to_owned())
        .collect();
    product(
        IMAGE_ORDER,
        &["sphere-table", "spheres", "bowl", "planar"],
        &techniques,
    )
}

fn product(group: &'static str, scenes: &[&'static str], techniques: &[String]) -> Vec<Bench> {
    let of = |scene| {
        techniques.iter().map(move |technique| Bench {
            group,
            scene,
            technique: technique.clone(),
            limit: limit(technique),
            splits: 0,
        })
    };
    scenes.iter().copied().flat_map(of).collect()
}

/// A scene with its truth: what the benches of a scene share.
pub struct Judged {
    /// At [`SIZE`].
    pub scene: Scene,
    truth: Truth,
}

impl Judged {
    /// Loads a built-in scene and traces its truth.
    ///
    /// # Errors
    /// A scene that cannot be loaded or traced.
    pub fn new(scene: &str) -> anyhow::Result<Self> {
        let options = LoadOptions {
            resolution: Some(SIZE),
            ..LoadOptions::default()
        };
        let scene = catoptric_scene::open(scene, &options)?;
        let truth = trace_reference(&scene, Common::default().bounces, &Progress::new(0, true))?;
        Ok(Self { scene, truth })
    }

    /// Why a bench is not run here; `None` if it is.
    pub fn left_out(&self, bench: &Bench, gpu: &Gpu) -> Option<String> {
        if let Support::No(reason) = catoptric_reflect::supports(&bench.spec(), &self.scene) {
            return Some(reason);
        }
        let drawn = self.scene.triangle_count() << (2 * bench.splits);
        (gpu.info().software && drawn > MOST_IN_SOFTWARE)
            .then(|| format!("{drawn} triangles a frame take seconds on a software adapter"))
    }

    /// Prepares a technique and judges its picture.
    ///
    /// # Errors
    /// What is wrong with its picture, or why there is none.
    pub fn stand<'g>(&self, bench: &Bench, gpu: &'g Gpu) -> Result<Stand<'g>, String> {
        let reason = |(_, reason)| reason;
        let rendered = render(gpu, &bench.spec(), &self.scene).map_err(reason)?;
        let compared = compare(&self.scene, &self.truth, &rendered.output).map_err(reason)?;
        right(&compared, bench.limit)?;
        Ok(Stand { rendered })
    }

    /// What the throughput of a group counts a frame: of searches the vertices times the mirrors, of
    /// all else the mirror pixels.
    pub fn elements(&self, group: &str) -> u64 {
        let elements = match group {
            LINEAR_VS_HIERARCHY => self.scene.vertex_count() * self.scene.mirrors.len(),
            _ => {
                let layers = self.truth.first.reflected.as_ref();
                let status = layers.map_or(&[][..], |layers| layers.status.pixels());
                let resolved = status.iter().filter(|status| **status == Pixel::Resolved);
                resolved.count()
            }
        };
        elements as u64
    }
}

/// Whether a picture is within its limit.
fn right(compared: &Compared, limit: Limit) -> Result<(), String> {
    let wrong = 1.0 - compared.first().object_agreement.unwrap_or(0.0);
    if wrong > limit.wrong {
        return Err(format!(
            "{:.2} % of the mirror pixels are wrong, at most {:.2} % may be",
            100.0 * wrong,
            100.0 * limit.wrong
        ));
    }
    let median = compared.first().angular_error_deg.map(|angle| angle.p50);
    match median {
        Some(median) if median <= limit.median_deg => Ok(()),
        Some(median) => Err(format!(
            "the median angular error is {median:.3} degrees, at most {} may be",
            limit.median_deg
        )),
        None => Err("no pixel shows the object that the truth shows".to_owned()),
    }
}

/// A technique whose picture was found right.
pub struct Stand<'g> {
    rendered: Rendered<'g>,
}

impl Stand<'_> {
    /// Times a frame.
    ///
    /// # Panics
    /// If the frame cannot be rendered, as the one before it was.
    pub fn time(&mut self) -> FrameTime {
        self.rendered
            .time_frame()
            .expect("a frame that was rendered before")
    }
}

/// Milliseconds of a frame: on the GPU where the adapter has a clock, else as waited for.
pub fn whole_frame(time: &FrameTime) -> f64 {
    time.gpu_ms.unwrap_or(time.wall_ms)
}

/// Milliseconds of the passes that are the technique's own; `None` where passes are not timed.
pub fn own_passes(time: &FrameTime) -> Option<f64> {
    let passes = time.passes.as_ref()?.iter();
    let own = passes.filter(|(name, _)| !STAGE_PASSES.contains(&name.as_str()));
    Some(own.map(|(_, ms)| ms).sum::<f64>() + time.build_ms.unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use catoptric_frame::Image;
    use catoptric_reflect::{Output, Prefer};

    use super::*;

    #[test]
    fn every_technique_of_the_registry_is_timed() {
        let benches = benches();
        for bench in &benches {
            catoptric_reflect::parse(&bench.technique).expect("a name of the registry");
        }
        let timed: Vec<&str> = benches
            .iter()
            .map(|bench| bench.technique.as_str())
            .collect();
        // What says how reflections moved is timed by `bench motion`.
        let pictures = list().into_iter();
        for info in pictures.filter(|info| info.family != Family::Motion) {
            let names = |text: &&str| text.contains(info.name);
            assert!(timed.iter().any(names), "{}", info.name);
        }
        let unique: BTreeSet<_> = benches
            .iter()
            .map(|bench| (bench.group, bench.scene, &bench.technique))
            .collect();
        assert_eq!(unique.len(), benches.len());
    }

    #[test]
    fn own_passes_are_those_that_not_every_technique_has() {
        let passes = [
            ("primary", 3.0),
            ("search", 2.0),
            ("composite", 4.0),
            ("virtual", 1.0),
        ];
        let named = |(name, ms): (&str, f64)| (name.to_owned(), ms);
        let time = |passes| FrameTime {
            gpu_ms: Some(10.0),
            passes,
            passes_reason: None,
            wall_ms: 12.0,
            build_ms: Some(0.5),
        };
        let known = time(Some(passes.map(named).to_vec()));
        assert_eq!(own_passes(&known), Some(3.5));
        assert_eq!(whole_frame(&known), 10.0);
        assert_eq!(own_passes(&time(None)), None);
    }

    /// A technique's output with the layers of the truth, and one of them spoilt.
    fn judged(spoil: impl FnOnce(&mut Output)) -> Result<(), String> {
        let judged = Judged::new("sphere-square").expect("a built-in scene");
        let gpu = Gpu::new(None, Prefer::Hardware).expect("an adapter");
        let spec = catoptric_reflect::parse("ray-trace").expect("a technique");
        let mut rendered = render(&gpu, &spec, &judged.scene).expect("a picture");
        spoil(&mut rendered.output);
        let compared = compare(&judged.scene, &judged.truth, &rendered.output).expect("layers");
        right(&compared, CLOSE)
    }

    #[test]
    fn a_wrong_picture_is_not_timed() {
        if Gpu::new(None, Prefer::Hardware).is_err() {
            eprintln!("skipped: there is no adapter");
            return;
        }
        judged(|_| {}).expect("an exact technique is right");
        let lost = judged(|output| {
            let reflected = output.frame.reflected.as_mut().expect("layers");
            reflected.id = Image::filled(reflected.id.size(), 0);
        });
        assert!(lost.unwrap_err().contains("mirror pixels are wrong"));
        let moved = judged(|output| {
            let reflected = output.frame.reflected.as_mut().expect("layers");
            for position in reflected.position.pixels_mut() {
                position.x += 0.3;
            }
        });
        assert!(moved.unwrap_err().contains("median angular error"));
    }
}
