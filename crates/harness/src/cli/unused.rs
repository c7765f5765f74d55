//! Common options that a command cannot use: they are left out of its help, and refused rather than
//! ignored.

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, CommandFactory};

use crate::exit::bad_input;

use super::args::Cli;

/// The common options, by what clap calls them and by what they are called on the command line.
const COMMON: [(&str, &str); 6] = [
    ("resolution", "--resolution"),
    ("models", "--models"),
    ("adapter", "--adapter"),
    ("bounces", "--bounces"),
    ("format", "--format"),
    ("output", "-o"),
];

/// The option that does no harm where it is not used.
const QUIET: &str = "quiet";

/// Which of them a command uses.
fn used(command: &str, listing: Option<&str>) -> &'static [&'static str] {
    match (command, listing) {
        ("list", None | Some("scenes")) => &["models", "format", "output"],
        ("list" | "summary", _) => &["format", "output"],
        ("reference", _) => &["resolution", "models", "bounces", "output", QUIET],
        ("render", _) => &["resolution", "models", "adapter", "output", QUIET],
        ("report", _) => &[
            "resolution",
            "models",
            "adapter",
            "bounces",
            "output",
            QUIET,
        ],
        ("diff" | "claims", _) => &["format", "output"],
        ("page", _) => &["output"],
        ("import", _) => &["output", QUIET],
        ("completions", _) => &[],
        ("export", _) => &["resolution", "models", "bounces", QUIET],
        ("check", _) => &["resolution", "models", "bounces", "format", "output", QUIET],
        ("doctor", _) => &["adapter", "format", "output"],
        // `compare` and `bench`.
        _ => &[
            "resolution",
            "models",
            "adapter",
            "bounces",
            "format",
            "output",
            QUIET,
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
        ("page", "format") => ": -o DIR or -o FILE.md says how",
        ("completions", "output") => ": they go to stdout",
        _ => "",
    }
}

/// The command line, where each command's help has the common options that it uses and no others.
pub fn command() -> clap::Command {
    with_common(Cli::command(), |arg, used| match used {
        true => None,
        false => Some(arg.clone().hide(true)),
    })
}

/// The command line for shells, which offer also what is hidden: a command has no other common options
/// than those that it uses.
pub fn for_shells() -> clap::Command {
    let all = Cli::command();
    let common: Vec<_> = all
        .get_arguments()
        .filter(|arg| arg.is_global_set())
        .map(|arg| arg.get_id().clone())
        .collect();
    let all = with_common(all, |arg, used| used.then(|| arg.clone().global(false)));
    let of_its_own = |all: clap::Command, id| all.mut_arg(id, |arg| arg.global(false));
    common.into_iter().fold(all, of_its_own)
}

/// Gives each command what `of` makes of a common option that it uses or not.
fn with_common(all: clap::Command, of: impl Fn(&Arg, bool) -> Option<Arg>) -> clap::Command {
    let common: Vec<Arg> = all
        .get_arguments()
        .filter(|arg| arg.is_global_set())
        .cloned()
        .collect();
    let names: Vec<String> = all
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    names.into_iter().fold(all, |all, name| {
        let used = used(&name, None);
        let args: Vec<Arg> = common
            .iter()
            .filter_map(|arg| of(arg, used.contains(&arg.get_id().as_str())))
            .collect();
        all.mut_subcommand(name, |command| command.args(args))
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_has_what_a_command_uses_and_nothing_else() {
        let mut all = command();
        all.build();
        for command in all.get_subcommands_mut() {
            let name = command.get_name().to_owned();
            if name == "help" {
                continue;
            }
            let used = used(&name, None);
            let help = command.render_long_help().to_string();
            for (id, option) in COMMON.into_iter().chain([(QUIET, "--quiet")]) {
                let option = match option {
                    "-o" => "--output",
                    option => option,
                };
                let shown = help.lines().any(|line| {
                    let words = line.trim_start().split([' ', ',']);
                    line.trim_start().starts_with('-') && words.into_iter().any(|w| w == option)
                });
                assert_eq!(shown, used.contains(&id), "{name}: {option}\n{help}");
            }
        }
    }

    #[test]
    fn shells_offer_what_a_command_uses_and_nothing_else() {
        let mut all = for_shells();
        all.build();
        for command in all.get_subcommands() {
            let name = command.get_name();
            if name == "help" {
                continue;
            }
            let used = used(name, None);
            let has = |id: &str| command.get_arguments().any(|arg| arg.get_id() == id);
            for id in COMMON.map(|(id, _)| id).into_iter().chain([QUIET]) {
                assert_eq!(has(id), used.contains(&id), "{name}: {id}");
            }
        }
    }
}
