//! `catoptric list`: scenes, techniques, adapters.

use clap::ValueEnum;
use serde_json::{Value, json};

use crate::exit::Outcome;
use crate::options::{Common, Format};
use crate::run::load::load_options;
use crate::show::print;
use crate::show::table::cell;

/// What `list` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Of what
    #[arg(value_enum)]
    pub what: Listing,
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
    match args.what {
        Listing::Scenes => scenes(common),
        Listing::Techniques => techniques(common),
        Listing::Adapters => adapters(common),
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

fn techniques(common: &Common) -> anyhow::Result<()> {
    let infos = catoptric_reflect::list();
    let rows: Vec<Value> = infos
        .iter()
        .map(|info| {
            let option = |option: &catoptric_reflect::OptionInfo| {
                json!({ "name": option.name, "default": option.default(), "values": option.allowed(), "what": option.what })
            };
            let options: Vec<Value> = info.options().map(option).collect();
            json!({ "name": info.name, "what": info.what, "family": info.family.to_string(), "paper": info.paper,
                    "options": options, "available": info.reason().is_none(), "reason": info.reason() })
        })
        .collect();
    if print::format(common) == Format::Json {
        return print::listing(&rows, &[], common);
    }
    let lines: Vec<Value> = rows.iter().flat_map(lines).collect();
    let columns = ["name", "default", "values", "what", "paper", "reason"];
    print::listing(&lines, &columns, common)
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
