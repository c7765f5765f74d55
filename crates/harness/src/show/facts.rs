//! Named values at the end of a page: what measured, with which program, on which scenes.

use catoptric_metrics::CoverageClass;

use crate::record::{Record, Status};

use super::pictures;

/// A name and what belongs to it.
pub struct Fact {
    /// Name.
    pub name: String,
    /// Value.
    pub value: String,
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
        });
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
