//! Options that every command understands, and some cannot use: refused rather than ignored.

use clap::ArgMatches;
use clap::parser::ValueSource;

use crate::exit::bad_input;

/// The common options, by what clap calls them and by what they are called on the command line.
const COMMON: [(&str, &str); 6] = [
    ("resolution", "--resolution"),
    ("models", "--models"),
    ("adapter", "--adapter"),
    ("bounces", "--bounces"),
    ("format", "--format"),
    ("output", "-o"),
];

/// Which of them a command uses. `--quiet` does no harm anywhere.
fn used(command: &str, listing: Option<&str>) -> &'static [&'static str] {
    match (command, listing) {
        ("list", Some("scenes")) => &["models", "format", "output"],
        ("list" | "summary", _) => &["format", "output"],
        ("reference", _) => &["resolution", "models", "bounces", "output"],
        ("render", _) => &["resolution", "models", "adapter", "output"],
        ("report", _) => &["resolution", "models", "adapter", "bounces", "output"],
        ("diff", _) => &["format", "output"],
        ("export", _) => &["resolution", "models", "bounces"],
        ("check", _) => &["resolution", "models", "bounces", "format", "output"],
        ("doctor", _) => &["adapter", "format", "output"],
        // `compare` and `bench`.
        _ => &[
            "resolution",
            "models",
            "adapter",
            "bounces",
            "format",
            "output",
        ],
    }
}

/// What is written where, for a command that does not use `-o`.
fn instead(command: &str, option: &str) -> &'static str {
    match (command, option) {
        ("export", "output") => ": --mitsuba DIR says where to",
        ("report", "format") => ": it is a page, and its numbers are in `record.json` beside it",
        ("reference" | "render", "format") => ": the ending of -o FILE says how, .exr or .png",
        ("list", "adapter") => ": all adapters are listed",
        _ => "",
    }
}

/// Refuses an option on the command line that the command would ignore.
pub fn refuse(matches: &ArgMatches) -> anyhow::Result<()> {
    let Some((command, of_command)) = matches.subcommand() else {
        return Ok(());
    };
    let listing = of_command.try_get_raw("what").ok().flatten();
    let listing = listing.and_then(|mut values| values.next()?.to_str());
    let used = used(command, listing);
    let given = |id: &str| of_command.value_source(id) == Some(ValueSource::CommandLine);
    for (id, option) in COMMON {
        if given(id) && !used.contains(&id) {
            let listing = listing.map_or_else(String::new, |listing| format!(" {listing}"));
            return Err(bad_input(format!(
                "`{command}{listing}` does not use {option}{}",
                instead(command, id)
            )));
        }
    }
    Ok(())
}
