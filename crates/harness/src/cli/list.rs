//! `catoptric list`: scenes, techniques, adapters.

use catoptric_reflect::{OptionInfo, TechniqueInfo, Values};
use catoptric_scene::suggest;
use clap::ValueEnum;
use serde_json::{Value, json};

use crate::exit::{Outcome, bad_input};
use crate::options::{Common, Format};
use crate::run::load::load_options;
use crate::show::print;
use crate::show::table::cell;
use crate::terminal::{cut, width, wrapped};

/// What `list` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// What to list
    #[arg(value_enum)]
    pub what: Listing,
    /// One technique by its name: what it is, and each of its options
    pub name: Option<String>,
}

/// What `list` lists.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Listing {
    /// Built-in scenes
    Scenes,
    /// Techniques with their options
    Techniques,
    /// Graphics adapters
    Adapters,
}

/// Lists what was asked for.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    match (args.what, &args.name) {
        (Listing::Techniques, None) => techniques(&catoptric_reflect::list(), false, common),
        (Listing::Techniques, Some(name)) => techniques(&[technique(name)?], true, common),
        (_, Some(name)) => {
            return Err(bad_input(format!(
                "`{name}`: only a technique is explained by its name: list techniques NAME"
            )));
        }
        (Listing::Scenes, None) => scenes(common),
        (Listing::Adapters, None) => adapters(common),
    }?;
    Ok(Outcome::Done)
}

fn scenes(common: &Common) -> anyhow::Result<()> {
    let infos = catoptric_scene::list::builtin(&load_options(common));
    let rows = infos
        .iter()
        .map(serde_json::to_value)
        .collect::<Result<Vec<_>, _>>()?;
    let columns = [
        "name",
        "available",
        "objects",
        "mirrors",
        "vertices",
        "triangles",
        "why",
        "reason",
    ];
    print::listing(&rows, &columns, common)
}

/// The technique of this name; a refinement may be named without its `+`.
fn technique(name: &str) -> anyhow::Result<&'static TechniqueInfo> {
    let all = catoptric_reflect::list();
    let bare = |name: &str| name.trim_start_matches('+').to_owned();
    let found = all.iter().find(|info| bare(info.name) == bare(name));
    found.copied().ok_or_else(|| {
        let hint = suggest(name, all.iter().map(|info| info.name));
        bad_input(format!(
            "no technique `{name}`{hint}; `list techniques` names them, each without its options"
        ))
    })
}

/// Techniques: a line each for people, or one of them explained; all there is for programs.
fn techniques(
    infos: &[&'static TechniqueInfo],
    explained: bool,
    common: &Common,
) -> anyhow::Result<()> {
    match (print::format(common), infos) {
        (Format::Table, [info]) if explained => {
            return print::result(&explanation(info, width()), common);
        }
        (Format::Table, _) => return print::result(&overview(infos, width()), common),
        _ => {}
    }
    let rows: Vec<Value> = infos
        .iter()
        .map(|info| {
            let option = |option: &OptionInfo| {
                json!({ "name": option.name, "default": option.default(), "values": option.allowed(), "what": option.what })
            };
            let options: Vec<Value> = info.options().map(option).collect();
            json!({ "name": info.name, "what": info.what, "family": info.family.to_string(), "paper": info.paper,
                    "options": options, "available": true, "reason": null })
        })
        .collect();
    if print::format(common) == Format::Json {
        return print::listing(&rows, &[], common);
    }
    let lines: Vec<Value> = rows.iter().flat_map(lines).collect();
    let columns = ["name", "default", "values", "what", "paper", "reason"];
    print::listing(&lines, &columns, common)
}

/// A line a technique, by family; none is longer than `columns`.
fn overview(infos: &[&TechniqueInfo], columns: usize) -> String {
    let widest = infos.iter().map(|info| info.name.chars().count()).max();
    let widest = widest.unwrap_or(0);
    let mut families: Vec<String> = Vec::new();
    for info in infos {
        let family = format!("{}: {}", info.family, info.family.what());
        if !families.contains(&family) {
            families.push(family);
        }
    }
    let mut text = String::new();
    let mut line = |line: &str| {
        text += &cut(line, columns);
        text.push('\n');
    };
    for family in &families {
        line(family);
        let members = infos.iter().filter(|info| {
            let name = info.family.to_string();
            family
                .split_once(':')
                .is_some_and(|(known, _)| known == name)
        });
        for info in members {
            line(&format!("  {:widest$}  {}", info.name, info.what));
        }
        line("");
    }
    line("`catoptric list techniques NAME` explains one with its options.");
    text
}

/// What a technique is, and each option with its values, default and meaning.
fn explanation(info: &TechniqueInfo, columns: usize) -> String {
    let mut text = String::new();
    let mut paragraph = |indent: usize, said: &str| {
        for line in wrapped(said, columns.saturating_sub(indent).max(20)) {
            text += &format!("{:indent$}{line}\n", "");
        }
    };
    paragraph(0, &format!("{}: {}", info.name, info.what));
    paragraph(
        0,
        &format!("family: {}: {}", info.family, info.family.what()),
    );
    paragraph(0, &format!("paper: {}", info.paper));
    if info.options().next().is_none() {
        paragraph(0, "It has no options.");
        return text;
    }
    paragraph(0, &format!("options, as in {}:", example(info)));
    for option in info.options() {
        paragraph(2, &format!("{}={}", option.name, option.default()));
        let of_words = matches!(option.values, Values::Words(_));
        let before = if of_words { "one of " } else { "" };
        paragraph(6, &format!("{before}{}", option.allowed()));
        paragraph(6, option.what);
    }
    text
}

/// The technique with its first option at another value than by itself, where it has words.
fn example(info: &TechniqueInfo) -> String {
    let asked = info.options().find_map(|option| {
        let (value, others) = match option.values {
            Values::Words(words) => (words.get(1)?, words.len()),
            _ => return None,
        };
        (others > 1).then(|| format!("({}={value})", option.name))
    });
    let asked = asked.or_else(|| {
        let option = info.options().next()?;
        Some(format!("({}={})", option.name, option.default()))
    });
    format!("{}{}", info.name, asked.unwrap_or_default())
}

/// A line for a technique and one for each of its options, indented.
fn lines(technique: &Value) -> Vec<Value> {
    let options = technique["options"].as_array().into_iter().flatten();
    let option = |option: &Value| {
        let name = cell(option.get("name"));
        json!({ "name": format!("  {name}"), "default": option["default"], "values": option["values"],
                "what": option["what"] })
    };
    let head = json!({ "name": technique["name"], "what": technique["what"], "paper": technique["paper"],
                       "reason": technique["reason"] });
    std::iter::once(head).chain(options.map(option)).collect()
}

fn adapters(common: &Common) -> anyhow::Result<()> {
    let infos = catoptric_reflect::adapters();
    if infos.is_empty() {
        return Err(catoptric_reflect::GpuError::no_adapter().into());
    }
    let row = |info: &catoptric_reflect::AdapterInfo| json!({ "name": info.name, "driver": info.driver, "backend": info.backend, "software": info.software });
    let rows: Vec<Value> = infos.iter().map(row).collect();
    print::listing(&rows, &["name", "driver", "backend", "software"], common)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn techniques_fit_a_terminal() {
        let all = catoptric_reflect::list();
        for columns in [80, 40] {
            let text = overview(&all, columns);
            for line in text.lines() {
                assert!(line.chars().count() <= columns, "{line}");
                // In a terminal of the usual width nothing is cut.
                assert!(columns < 80 || !line.contains('…'), "{line}");
            }
            for info in &all {
                let start = format!("  {} ", info.name);
                let lines = text.lines().filter(|line| line.starts_with(&start));
                assert_eq!(lines.count(), 1, "{}\n{text}", info.name);
                assert!(text.contains(&format!("{}: ", info.family)));
            }
        }
    }

    #[test]
    fn one_is_explained_with_all_its_options() {
        for info in catoptric_reflect::list() {
            let text = explanation(info, 80);
            assert!(
                text.lines().all(|line| line.chars().count() <= 80),
                "{text}"
            );
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(words.contains(info.what) && words.contains(info.paper));
            for option in info.options() {
                let set = format!("{}={}", option.name, option.default());
                assert!(words.contains(&set), "{set}: {text}");
                let what = option.what.split_whitespace().collect::<Vec<_>>().join(" ");
                assert!(
                    words.contains(&what) && words.contains(&option.allowed()),
                    "{text}"
                );
            }
        }
        assert_eq!(technique("full").map(|info| info.name).ok(), Some("+full"));
        let error = technique("liner").expect_err("a misspelt name").to_string();
        assert!(error.contains("`linear`"), "{error}");
    }
}
