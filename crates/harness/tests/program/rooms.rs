//! The walls inside the crate: a room of `src/` knows only the rooms below it.

use std::path::Path;

/// Each room, or file beside the rooms, and what it may know.
const ROOMS: [(&str, &[&str]); 13] = [
    ("terminal", &[]),
    ("exit", &["terminal"]),
    ("options", &[]),
    ("input", &["exit"]),
    ("output", &["exit"]),
    ("record", &["exit", "input"]),
    ("show", &["options", "output", "record", "terminal"]),
    ("run", &["exit", "options", "record", "terminal"]),
    (
        "suites",
        &[
            "exit", "options", "output", "record", "run", "show", "terminal",
        ],
    ),
    ("check", &["exit", "input", "options"]),
    ("export", &["output"]),
    ("import", &["exit", "export", "input", "output"]),
    (
        "cli",
        &[
            "check", "exit", "export", "import", "input", "options", "output", "record", "run",
            "show", "suites", "terminal",
        ],
    ),
];

/// Every `crate::ROOM` in a source file, its tests aside.
fn known(text: &str) -> Vec<String> {
    let code = text
        .split("#[cfg(test)]\nmod tests {")
        .next()
        .unwrap_or_default();
    let code = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code: Vec<&str> = code.collect();
    let code = code.join("\n");
    let mut found = Vec::new();
    for after in code.split("crate::").skip(1) {
        match after.strip_prefix('{') {
            None => found.push(name(after)),
            Some(_) => panic!("one line a room: `use crate::{{` hides which rooms are known"),
        }
    }
    found
}

fn name(text: &str) -> String {
    let letters = text.chars();
    letters
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect()
}

fn sources(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => sources(&path, found),
            false => found.push(path),
        }
    }
}

#[test]
fn a_room_knows_only_what_is_below_it() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&src, &mut files);
    assert!(files.len() > ROOMS.len());
    for file in files {
        let inside = file.strip_prefix(&src).expect("a file in src");
        let first = inside.iter().next().expect("a name").to_string_lossy();
        let room = first.trim_end_matches(".rs");
        if ["lib", "main"].contains(&room) || inside.ends_with("record/tests.rs") {
            continue;
        }
        let rule = ROOMS.iter().find(|(name, _)| *name == room);
        let (_, below) = rule.unwrap_or_else(|| panic!("no rule for {}", inside.display()));
        let text = std::fs::read_to_string(&file).expect("UTF-8");
        for other in known(&text) {
            assert!(
                other == room || below.contains(&other.as_str()),
                "{}: `{room}` must not know `{other}`",
                inside.display()
            );
        }
    }
}

#[test]
fn a_breach_is_noticed() {
    let text = "use crate::run::Setup;\n// crate::cli\n#[cfg(test)]\nmod tests {\n    use crate::suites;\n}\n";
    assert_eq!(known(text), ["run"]);
}
