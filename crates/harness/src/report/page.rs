//! The page itself: the record and the names of its pictures in, `index.html` out.

use std::path::{Path, PathBuf};

use anyhow::Context;
use askama::Template;
use catoptric_frame::write_whole;
use catoptric_metrics::CoverageClass;

use crate::record::{Record, Status};

use super::views::{self, SUMMARY, Scene, SummaryRow};
use super::{diagrams, pictures, words};

/// A name and what belongs to it.
pub struct Fact {
    /// Name.
    pub name: String,
    /// Value.
    pub value: String,
}

/// Everything that the template shows.
#[derive(Template)]
#[template(path = "report.html")]
struct Page<'r> {
    /// How many rows of how many, where some are missing.
    unfinished: Option<String>,
    lead: Vec<String>,
    noise_floor: Option<String>,
    hero: Option<Hero<'r>>,
    headings: &'static [(&'static str, &'static str)],
    summary: Vec<SummaryRow>,
    scatter: Option<String>,
    scenes: &'r [Scene],
    angle_labels: &'static [&'static str],
    scale: &'static str,
    coverage: Vec<Fact>,
    software: Option<String>,
    environment: Vec<Fact>,
    command: String,
    wall_clock: bool,
}

/// The first picture of the page.
struct Hero<'r> {
    scene: &'r Scene,
    technique: &'r views::Technique,
}

/// Writes `index.html` into the report's folder. Of `wanted` rows some may not be measured yet.
pub fn write(rows: &[Record], wanted: usize, folder: &Path) -> anyhow::Result<PathBuf> {
    let path = folder.join("index.html");
    write_whole(&path, render(rows, wanted)?.as_bytes())?;
    Ok(path)
}

/// The page as text.
fn render(rows: &[Record], wanted: usize) -> anyhow::Result<String> {
    let techniques = views::techniques(rows);
    let scenes = views::scenes(rows, &techniques)?;
    let hero = scenes.iter().find_map(|scene| {
        Some(Hero {
            scene,
            technique: scene.techniques.first()?,
        })
    });
    let page = Page {
        unfinished: (rows.len() < wanted).then(|| format!("{} of {wanted}", rows.len())),
        lead: words::lead(rows, &techniques),
        noise_floor: words::noise_floor(rows),
        hero,
        headings: &SUMMARY,
        summary: views::summary(rows, &techniques),
        scatter: diagrams::error_against_time(rows, &techniques).inline()?,
        scenes: &scenes,
        angle_labels: &pictures::ANGLE_LABELS,
        scale: pictures::SCALE,
        coverage: coverage_legend(),
        software: software(rows),
        environment: environment(rows),
        command: command(rows),
        wall_clock: rows.iter().any(|row| {
            row.time_ms
                .as_ref()
                .is_some_and(|times| times.frame.is_none())
        }),
    };
    page.render().context("filling the report's template")
}

/// Colours and names of what coverage maps paint.
pub fn coverage_legend() -> Vec<Fact> {
    let fact = |(class, name): &(CoverageClass, &str)| {
        let [red, green, blue] = class.color();
        Fact {
            name: (*name).to_owned(),
            value: format!("#{red:02x}{green:02x}{blue:02x}"),
        }
    };
    pictures::COVERAGE.iter().map(fact).collect()
}

/// The adapter's name where a CPU plays the GPU.
pub fn software(rows: &[Record]) -> Option<String> {
    let adapter = rows.iter().find_map(|row| row.adapter.as_ref());
    let adapter = adapter.filter(|adapter| adapter.software);
    adapter.map(|adapter| adapter.name.clone())
}

/// The command line of the run.
pub fn command(rows: &[Record]) -> String {
    let row = rows.first();
    row.map(|row| row.meta.command.clone()).unwrap_or_default()
}

/// What measured, with which program, on which scenes.
pub fn environment(rows: &[Record]) -> Vec<Fact> {
    let mut facts = Vec::new();
    let mut fact = |name: &str, value: String| {
        facts.push(Fact {
            name: name.to_owned(),
            value,
        })
    };
    if let Some(adapter) = rows.iter().find_map(|row| row.adapter.as_ref()) {
        let kind = if adapter.software {
            "a CPU playing the GPU"
        } else {
            "hardware"
        };
        fact("adapter", format!("{} ({kind})", adapter.name));
        fact("driver", adapter.driver.clone());
        fact("backend", adapter.backend.clone());
    }
    if let Some(row) = rows.first() {
        let meta = &row.meta;
        fact("program", format!("catoptric {}", meta.version));
        fact(
            "revision",
            meta.revision
                .clone()
                .unwrap_or_else(|| "unknown".to_owned()),
        );
        fact("measured", meta.date.replace('T', " ").replace('Z', " UTC"));
        fact("truth `full`", format!("up to {} bounces", meta.bounces));
        if let Some(seconds) = meta.time_budget_s {
            fact(
                "timing",
                format!("{seconds} s a scene, shared by the techniques"),
            );
        }
    }
    for row in rows.iter().filter(|row| row.status == Status::Ok) {
        let hash = row.meta.scene_hash.as_deref().unwrap_or("unknown");
        let [width, height] = row.resolution;
        let value = format!("{width} × {height}, {}", hash.get(..16).unwrap_or(hash));
        let name = format!("scene {}", row.scene);
        if !facts.iter().any(|fact| fact.name == name) {
            facts.push(Fact { name, value });
        }
    }
    facts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::{blank, measured};

    #[test]
    fn the_same_record_gives_the_same_bytes() {
        let rows = [measured("a-scene", "linear"), blank("other", "linear")];
        assert_eq!(render(&rows, 2).unwrap(), render(&rows, 2).unwrap());
    }

    #[test]
    fn numbers_reasons_and_pictures_are_on_the_page() {
        let rows = [
            measured("a-scene", "linear(residual=cross)"),
            blank("other", "linear"),
        ];
        let html = render(&rows, 2).unwrap();
        assert!(!html.contains("Not finished"));
        assert!(render(&rows, 5).unwrap().contains("2 of 5 measurements"));
        for text in [
            "98.1 %",
            "no such model",
            "pictures/a-scene-640x480/linear-residual-cross.angle.png",
            "prefers-color-scheme",
        ] {
            assert!(html.contains(text), "{text}");
        }
        assert_eq!(
            html.matches("<img ").count(),
            html.matches(" alt=\"").count(),
            "every picture has an alt text"
        );
        assert!(
            !html.contains("http://") && !html.contains("https://"),
            "nothing is fetched"
        );
    }

    #[test]
    fn names_cannot_break_out_of_the_page() {
        let html = render(&[measured("<script>x</script>", "linear")], 1).unwrap();
        assert!(!html.contains("<script>x"));
    }

    #[test]
    fn an_empty_record_is_a_page() {
        assert!(render(&[], 0).unwrap().contains("</html>"));
    }
}
