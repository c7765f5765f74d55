//! The report's page: the record and the names of its pictures in, `index.html` out.

use anyhow::Context;
use askama::Template;

use crate::record::Record;

use super::facts::{self, Fact};
use super::views::{self, Scene, SummaryRow};
use super::{diagrams, look, pictures, words};

/// Everything that the template shows.
#[derive(Template)]
#[template(path = "report.html")]
struct Page<'r> {
    /// How many rows of how many, where some are missing.
    unfinished: Option<String>,
    lead: Vec<String>,
    noise_floor: Option<String>,
    hero: Option<Hero<'r>>,
    headings: Vec<(String, &'static str)>,
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
    look: String,
}

/// The first picture of the page.
struct Hero<'r> {
    scene: &'r Scene,
    technique: &'r views::Technique,
}

/// The page as text. Of `wanted` rows some may not be measured yet: then it says so, and draws no
/// conclusion from the others.
pub fn render(rows: &[Record], wanted: usize) -> anyhow::Result<String> {
    let finished = rows.len() >= wanted;
    let techniques = views::techniques(rows);
    let scenes = views::scenes(rows, &techniques)?;
    let hero = scenes.iter().find_map(|scene| {
        Some(Hero {
            scene,
            technique: scene.techniques.first()?,
        })
    });
    let page = Page {
        unfinished: (!finished).then(|| format!("{} of {wanted}", rows.len())),
        lead: match finished {
            true => words::lead(rows, &techniques),
            false => Vec::new(),
        },
        noise_floor: words::noise_floor(rows).filter(|_| finished),
        hero,
        headings: views::headings(),
        summary: views::summary(rows, &techniques),
        scatter: diagrams::error_against_time(rows, &techniques).inline(),
        scenes: &scenes,
        angle_labels: &pictures::ANGLE_LABELS,
        scale: pictures::SCALE,
        coverage: facts::coverage_legend(),
        software: facts::software(rows),
        environment: facts::environment(rows),
        command: facts::command(rows),
        wall_clock: rows.iter().any(|row| {
            row.time_ms
                .as_ref()
                .is_some_and(|times| times.frame.is_none())
        }),
        look: look::json(),
    };
    page.render().context("filling the report's template")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::{blank, measured};

    #[test]
    fn numbers_reasons_and_pictures_are_on_the_page() {
        let rows = [
            measured("a-scene", "linear(residual=cross)"),
            blank("other", "linear"),
        ];
        let html = render(&rows, 2).unwrap();
        assert!(!html.contains("Not finished"));
        let part = render(&rows, 5).unwrap();
        assert!(part.contains("2 of 5 measurements"));
        let claim = "shows the right object on";
        assert!(html.contains(claim) && !part.contains("<b>linear(residual=cross)</b> shows"));
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
        // The name of SVG's elements leads nowhere.
        let html = html.replace("http://www.w3.org/2000/svg", "");
        assert!(
            !html.contains("http://") && !html.contains("https://"),
            "nothing is fetched"
        );
    }

    #[test]
    fn a_technique_that_is_as_good_everywhere_is_said_to_be() {
        let mut rows = ["one", "other"].map(|scene| measured(scene, "linear"));
        let html = render(&rows, 2).unwrap();
        assert!(html.contains("98.1 % of the mirror pixels of each of 2 scenes."));
        rows[1].object_agreement = Some(0.5);
        let html = render(&rows, 2).unwrap();
        assert!(
            html.contains("50.0 % (<i>other</i>) to 98.1 % (<i>one</i>) of the mirror pixels.")
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
