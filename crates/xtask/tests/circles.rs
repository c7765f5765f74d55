//! No files of a crate use each other in a circle, tests aside.
//!
//! Read as text: a file uses another where a path in it leads to a definition there, also by way of
//! names that a third file only hands on: `pub use` is no use.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A module's names from the crate's root on.
type Module = Vec<String>;

/// What a file holds.
#[derive(Default)]
struct Source {
    /// Names of the items that it defines.
    defined: BTreeSet<String>,
    /// Paths that it imports or hands on, and the names that they get: `*` of a glob.
    imported: Vec<(Vec<String>, String)>,
    /// All other paths in it that begin at the root, here, above or in a module below.
    paths: Vec<Vec<String>>,
    /// All words in it.
    words: BTreeSet<String>,
}

/// The files of a crate by their modules.
type Sources = BTreeMap<Module, Source>;

fn is_word(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

/// The code of a file, without comments and tests.
fn code(text: &str) -> String {
    let inline = |at: &usize| {
        let item = text[*at..].lines().nth(1).unwrap_or_default();
        item.contains("mod ") && item.ends_with('{')
    };
    let tests = text.match_indices("#[cfg(test)]").map(|(at, _)| at);
    let end = tests.into_iter().find(inline).unwrap_or(text.len());
    let lines = text[..end].lines();
    let lines = lines.filter(|line| !line.trim_start().starts_with("//"));
    lines.map(|line| format!("{line}\n")).collect()
}

/// Modules that a file declares: those for tests alone, or the others.
fn children(code: &str, for_tests: bool) -> Vec<String> {
    let mut found = Vec::new();
    let mut test = false;
    for line in code.lines() {
        let name = line.strip_suffix(';').and_then(|line| {
            let (before, name) = line.split_once("mod ")?;
            (before.is_empty() || before.starts_with("pub")).then_some(name)
        });
        match name {
            Some(name) if test == for_tests => found.push(name.to_owned()),
            _ => {}
        }
        test = line == "#[cfg(test)]";
    }
    found
}

/// The paths of what follows `use`, with the names that they get.
fn imports(tree: &str, before: &[String], found: &mut Vec<(Vec<String>, String)>) {
    let (path, group) = match tree.split_once('{') {
        Some((path, group)) => (path, Some(group.trim_end().trim_end_matches('}'))),
        None => (tree, None),
    };
    let (path, name) = match path.split_once(" as ") {
        Some((path, name)) => (path, Some(name.trim().to_owned())),
        None => (path, None),
    };
    let names = path.split("::").map(str::trim);
    let names = names.filter(|name| !name.is_empty()).map(str::to_owned);
    let path: Vec<String> = before.iter().cloned().chain(names).collect();
    let Some(group) = group else {
        let last = path.last().cloned().unwrap_or_default();
        let path = match last.as_str() {
            "self" => path[..path.len() - 1].to_vec(),
            _ => path,
        };
        let name = name.or_else(|| path.last().cloned()).unwrap_or_default();
        found.push((path, name));
        return;
    };
    let (mut depth, mut start) = (0, 0);
    for (at, letter) in group.char_indices().chain([(group.len(), ',')]) {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = group.get(start..at).unwrap_or_default();
                if !part.trim().is_empty() {
                    imports(part, &path, found);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
}

/// The name that an item's line at the top of a file defines.
fn defines(line: &str) -> Option<String> {
    const KINDS: [&str; 10] = [
        "fn",
        "struct",
        "enum",
        "trait",
        "const",
        "static",
        "type",
        "union",
        "unsafe",
        "macro_rules!",
    ];
    let mut words = line.split_whitespace();
    let mut word = words.next()?;
    if word.starts_with("pub") {
        word = words.next()?;
    }
    if !KINDS.contains(&word) {
        return None;
    }
    let name = words.find(|word| !KINDS.contains(word))?;
    Some(name.chars().take_while(|c| is_word(*c)).collect())
}

fn source(text: &str) -> Source {
    let code = code(text);
    let mut source = Source {
        defined: code.lines().filter_map(defines).collect(),
        words: code.split(|c| !is_word(c)).map(str::to_owned).collect(),
        ..Source::default()
    };
    let mut rest = String::new();
    for part in code.split_inclusive(';') {
        let is_use = |line: &str| {
            let line = line.trim_start();
            line.starts_with("use ") || line.starts_with("pub") && line.contains(" use ")
        };
        let before = part.lines().take_while(|line| !is_use(line)).count();
        let (before, import): (Vec<&str>, Vec<&str>) = (
            part.lines().take(before).collect(),
            part.lines().skip(before).collect(),
        );
        rest += &before.join("\n");
        let import = import.join(" ");
        let Some((start, tree)) = import.split_once("use ") else {
            continue;
        };
        let mut found = Vec::new();
        imports(tree.trim_end_matches(';'), &[], &mut found);
        if !start.contains("pub") {
            source
                .paths
                .extend(found.iter().map(|(path, _)| path.clone()));
        }
        source.imported.extend(found);
    }
    let mut starts: Vec<String> = ["crate", "super", "self"].map(str::to_owned).to_vec();
    starts.extend(children(&code, false));
    for start in starts {
        let start = format!("{start}::");
        for (at, _) in rest.match_indices(&start) {
            if rest[..at].ends_with(|c| is_word(c) || c == ':') {
                continue;
            }
            let path = rest[at..].chars();
            let path: String = path.take_while(|c| is_word(*c) || *c == ':').collect();
            let names = path.split("::").filter(|name| !name.is_empty());
            source.paths.push(names.map(str::to_owned).collect());
        }
    }
    source
}

/// Reads a module's file and those of the modules below it.
fn read(file: &Path, folder: &Path, module: &Module, sources: &mut Sources) {
    let Ok(text) = fs::read_to_string(file) else {
        return;
    };
    for child in children(&code(&text), false) {
        let below: Module = module.iter().cloned().chain([child.clone()]).collect();
        let inside = folder.join(&child);
        let alone = folder.join(format!("{child}.rs"));
        let of_folder = inside.join("mod.rs");
        let file = if of_folder.exists() { of_folder } else { alone };
        read(&file, &inside, &below, sources);
    }
    sources.insert(module.clone(), source(&text));
}

/// The module in whose file a path ends, which a file of module `from` writes.
fn leads_to(sources: &Sources, from: &Module, path: &[String], depth: u32) -> Option<Module> {
    let (mut at, mut rest) = (from.clone(), path);
    let first = rest.first()?.as_str();
    match first {
        "crate" => (at, rest) = (Vec::new(), &rest[1..]),
        "self" => rest = &rest[1..],
        "super" => {}
        child => {
            let below: Module = from.iter().cloned().chain([child.to_owned()]).collect();
            if !sources.contains_key(&below) {
                return None;
            }
        }
    }
    for name in rest {
        if name == "super" {
            at.pop()?;
            continue;
        }
        let below: Module = at.iter().cloned().chain([name.clone()]).collect();
        if sources.contains_key(&below) {
            at = below;
            continue;
        }
        let source = sources.get(&at)?;
        if source.defined.contains(name) || depth == 0 {
            return Some(at);
        }
        let named = source.imported.iter().filter(|(_, other)| other == name);
        let globs = source.imported.iter().filter(|(_, other)| other == "*");
        for (path, other) in named.chain(globs) {
            let mut path = path.clone();
            if other == "*" {
                path.pop();
                path.push(name.clone());
            }
            let Some(end) = leads_to(sources, &at, &path, depth - 1) else {
                continue;
            };
            if other != "*" || sources[&end].defined.contains(name) {
                return Some(end);
            }
        }
        return Some(at);
    }
    Some(at)
}

/// The modules whose files a file uses.
fn used(sources: &Sources, module: &Module) -> BTreeSet<Module> {
    let source = &sources[module];
    let mut found = BTreeSet::new();
    for path in &source.paths {
        let names: Vec<Vec<String>> = match path.split_last() {
            Some((last, above)) if last == "*" => {
                let Some(whole) = leads_to(sources, module, above, 4) else {
                    continue;
                };
                let other = &sources[&whole];
                let given = other.imported.iter().map(|(_, name)| name);
                let names = other.defined.iter().chain(given);
                let names = names.filter(|name| source.words.contains(*name));
                names
                    .map(|name| [above, std::slice::from_ref(name)].concat())
                    .collect()
            }
            _ => vec![path.clone()],
        };
        for path in names {
            found.extend(leads_to(sources, module, &path, 4));
        }
    }
    found.remove(module);
    found
}

/// Files that use each other in a circle: each file of one, with what it uses of the circle.
fn circles(sources: &Sources) -> Vec<String> {
    let uses: BTreeMap<&Module, BTreeSet<Module>> = sources
        .keys()
        .map(|module| (module, used(sources, module)))
        .collect();
    let reached = |from: &Module| {
        let (mut reached, mut open) = (BTreeSet::new(), vec![from.clone()]);
        while let Some(module) = open.pop() {
            for next in &uses[&module] {
                if reached.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        reached
    };
    let all: BTreeMap<&Module, BTreeSet<Module>> = sources
        .keys()
        .map(|module| (module, reached(module)))
        .collect();
    let mut found = Vec::new();
    for (module, reached) in &all {
        if reached.contains(*module) {
            let back = |other: &&Module| all[*other].contains(*module);
            let circle: Vec<String> = uses[*module]
                .iter()
                .filter(back)
                .map(|other| other.join("::"))
                .collect();
            found.push(format!("{} uses {}", module.join("::"), circle.join(", ")));
        }
    }
    found
}

fn crates() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = fs::read_dir(root).expect("the crates");
    let mut found: Vec<PathBuf> = folders
        .filter_map(|folder| Some(folder.ok()?.path().join("src")))
        .filter(|folder| folder.is_dir())
        .collect();
    found.sort();
    found
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    let crates = crates();
    assert!(crates.len() > 5);
    let mut found = Vec::new();
    for folder in crates {
        let roots = ["lib.rs", "main.rs"].map(|name| folder.join(name));
        let root = roots.iter().find(|file| file.is_file()).expect("a root");
        let mut sources = Sources::new();
        read(root, &folder, &Vec::new(), &mut sources);
        let name = folder.parent().and_then(Path::file_name).expect("a name");
        let circles = circles(&sources).into_iter();
        found.extend(circles.map(|line| format!("{}: {line}", name.display())));
    }
    assert!(found.is_empty(), "in a circle:\n{}", found.join("\n"));
}

/// A crate of files that are written here.
fn made(files: [(&str, &str); 3]) -> Sources {
    let module = |path: &str| -> Module {
        let names = path.split("::").filter(|name| !name.is_empty());
        names.map(str::to_owned).collect()
    };
    let files = files.into_iter();
    files
        .map(|(path, text)| (module(path), source(text)))
        .collect()
}

#[test]
fn a_circle_is_found_and_names_that_are_handed_on_are_followed() {
    let root = "mod a;\nmod b;\npub use self::b::Thing;\n";
    let user = "use crate::{\n    Thing,\n    b::{self, Other},\n};\npub fn act(_: Thing) {}\n";
    let fine =
        "pub struct Thing;\npub struct Other;\n#[cfg(test)]\nmod tests {\n    use crate::a;\n}\n";
    assert_eq!(
        circles(&made([("", root), ("a", user), ("b", fine)])),
        [""; 0]
    );
    let round = "pub struct Thing;\nfn f() {\n    super::a::act(Thing);\n}\n";
    let found = circles(&made([("", root), ("a", user), ("b", round)]));
    assert_eq!(found, ["a uses b", "b uses a"]);
}
