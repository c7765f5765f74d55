//! `cargo xtask new KIND NAME`: writes what something new starts from, and the lines that register
//! it. The templates are techniques that work, though not well.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::ValueEnum;

/// What can be begun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// Finds a reflection point for every vertex
    Search,
    /// Chooses which points are searched and which triangles are drawn
    Refinement,
    /// Finds what each mirror pixel's reflected ray hits
    ImageOrder,
    /// Measures how far a picture is off, in one number
    Metric,
}

/// A file to write, and the text it is written from.
struct File {
    path: &'static str,
    text: &'static str,
}

/// A line to add to a file that is there.
struct Line {
    path: &'static str,
    place: Place,
    text: &'static str,
}

/// Where a line is added.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// Behind the last line that begins so.
    Behind(&'static str),
    /// Before the first line that begins so.
    Before(&'static str),
    /// Among the modules, in the order of their names.
    Module,
}

/// What a kind consists of. In paths and texts `template-name`, `template_name` and `TemplateName`
/// stand for the name.
struct Template {
    files: &'static [File],
    lines: &'static [Line],
}

const SEARCH: Template = Template {
    files: &[
        File {
            path: "crates/reflect/src/search/template_name/mod.rs",
            text: include_str!("../templates/search/mod.rs"),
        },
        File {
            path: "shaders/template_name.wesl",
            text: include_str!("../templates/search/shader.wesl"),
        },
    ],
    lines: &[
        Line {
            path: "crates/reflect/src/search/mod.rs",
            place: Place::Module,
            text: "pub(crate) mod template_name;",
        },
        Line {
            path: "crates/reflect/src/registry.rs",
            place: Place::Behind("    search::<"),
            text: "    search::<search::template_name::TemplateName>(),",
        },
    ],
};

const REFINEMENT: Template = Template {
    files: &[File {
        path: "crates/reflect/src/refine/template_name/mod.rs",
        text: include_str!("../templates/refine/mod.rs"),
    }],
    lines: &[
        Line {
            path: "crates/reflect/src/refine/mod.rs",
            place: Place::Module,
            text: "pub(crate) mod template_name;",
        },
        Line {
            path: "crates/reflect/src/registry.rs",
            place: Place::Behind("    refinement::<"),
            text: "    refinement::<refine::template_name::TemplateName>(),",
        },
    ],
};

const IMAGE_ORDER: Template = Template {
    files: &[
        File {
            path: "crates/reflect/src/image_order/template_name/mod.rs",
            text: include_str!("../templates/image_order/mod.rs"),
        },
        File {
            path: "shaders/template_name.wesl",
            text: include_str!("../templates/image_order/shader.wesl"),
        },
    ],
    lines: &[
        Line {
            path: "crates/reflect/src/image_order/mod.rs",
            place: Place::Module,
            text: "pub(crate) mod template_name;",
        },
        Line {
            path: "crates/reflect/src/registry.rs",
            place: Place::Behind("    image_order::<"),
            text: "    image_order::<image_order::template_name::TemplateName>(),",
        },
    ],
};

const METRIC: Template = Template {
    files: &[
        File {
            path: "crates/metrics/src/more/template_name.rs",
            text: include_str!("../templates/metric/metric.rs"),
        },
        File {
            path: "crates/metrics/tests/controls/template_name.rs",
            text: include_str!("../templates/metric/control.rs"),
        },
    ],
    lines: &[
        Line {
            path: "crates/metrics/src/more/mod.rs",
            place: Place::Module,
            text: "mod template_name;",
        },
        Line {
            path: "crates/metrics/src/more/mod.rs",
            place: Place::Behind("metrics! {"),
            text: "    /// TEMPLATE: what the number is.\n    template_name,",
        },
        Line {
            path: "crates/metrics/tests/controls/main.rs",
            place: Place::Module,
            text: "mod template_name;",
        },
        Line {
            path: "crates/harness/src/record/table.rs",
            place: Place::Before("    One(row(\"more."),
            text: "    One(row(\"more.template_name\", \"template-name\", \"template-name\", Share, High,\n        \
                   \"TEMPLATE: what the number is.\"), false),",
        },
    ],
};

impl Kind {
    fn template(self) -> &'static Template {
        match self {
            Self::Search => &SEARCH,
            Self::Refinement => &REFINEMENT,
            Self::ImageOrder => &IMAGE_ORDER,
            Self::Metric => &METRIC,
        }
    }
}

/// A name as it is written in the different places.
struct Name {
    /// On the command line, `like-this`.
    shown: String,
    /// As a module, `like_this`.
    module: String,
    /// As a type, `LikeThis`.
    ty: String,
}

impl Name {
    /// Reads a name: words of small letters and digits, joined by `-`.
    fn parse(name: &str) -> Result<Self> {
        let good = |word: &str| {
            word.starts_with(|c: char| c.is_ascii_lowercase())
                && word
                    .chars()
                    .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit())
        };
        let words: Vec<&str> = name.split('-').collect();
        ensure!(
            words.iter().all(|word| good(word)),
            "a name is words of small letters and digits, joined by `-`, such as `two-steps`; \
             `{name}` is not"
        );
        let capitalized = |word: &&str| word[..1].to_uppercase() + &word[1..];
        Ok(Self {
            shown: name.to_owned(),
            module: words.join("_"),
            ty: words.iter().map(capitalized).collect(),
        })
    }

    /// The text for this name.
    fn fill(&self, text: &str) -> String {
        text.replace("template-name", &self.shown)
            .replace("template_name", &self.module)
            .replace("TemplateName", &self.ty)
    }
}

/// Writes the files and lines of something new into the tree at `root`; the answer is what was
/// written or changed, relative to it. Where anything stands in the way, nothing is written.
pub fn write(root: &Path, kind: Kind, name: &str) -> Result<Vec<PathBuf>> {
    let name = Name::parse(name)?;
    let template = kind.template();
    let mut writes = Vec::new();
    for file in template.files {
        let path = PathBuf::from(name.fill(file.path));
        if root.join(&path).exists() {
            bail!("{} is there already", path.display());
        }
        writes.push((path, name.fill(file.text)));
    }
    for line in template.lines {
        let path = PathBuf::from(line.path);
        let before = writes.iter().position(|(written, _)| *written == path);
        let old = match before {
            Some(index) => writes.remove(index).1,
            None => fs::read_to_string(root.join(&path)).with_context(|| line.path.to_owned())?,
        };
        let new = with_line(&old, line.place, &name.fill(line.text))
            .with_context(|| format!("{} has no place for `{}`", line.path, line.text))?;
        writes.push((path, new));
    }
    for (path, text) in &writes {
        let path = root.join(path);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        }
        fs::write(&path, text).with_context(|| path.display().to_string())?;
    }
    Ok(writes.into_iter().map(|(path, _)| path).collect())
}

/// A text with one more line at its place; `None` if there is none.
fn with_line(text: &str, place: Place, line: &str) -> Option<String> {
    let mut lines: Vec<&str> = text.lines().collect();
    let behind_last = |test: &dyn Fn(&str) -> bool| {
        let last = lines.iter().rposition(|old| test(old))?;
        Some(last + 1)
    };
    let at = match place {
        Place::Behind(start) => behind_last(&|old| old.starts_with(start)),
        Place::Before(start) => lines.iter().position(|old| old.starts_with(start)),
        Place::Module => {
            let name = module(line);
            let next = lines.iter().position(|old| module(old) > name);
            next.or_else(|| behind_last(&|old| module(old).is_some()))
        }
    }?;
    lines.insert(at, line);
    Some(lines.join("\n") + "\n")
}

/// The module that a line declares.
fn module(line: &str) -> Option<&str> {
    let line = line.strip_prefix("pub(crate) ").unwrap_or(line);
    line.strip_prefix("mod ")?.strip_suffix(';')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_written_as_each_place_wants_it() {
        let name = Name::parse("two-steps3").expect("a name");
        assert_eq!(
            name.fill("template-name template_name TemplateName"),
            "two-steps3 two_steps3 TwoSteps3"
        );
        for bad in [
            "",
            "Two",
            "two_steps",
            "two--steps",
            "-two",
            "+two",
            "2steps",
        ] {
            assert!(Name::parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_line_goes_behind_the_last_of_its_kind() {
        let place = Place::Behind("a ");
        assert_eq!(
            with_line("a 1\na 2\nb\n", place, "a 3").as_deref(),
            Some("a 1\na 2\na 3\nb\n")
        );
        assert_eq!(with_line("b\n", place, "a 3"), None);
        assert_eq!(
            with_line("b\na 1\na 2\n", Place::Before("a "), "a 0").as_deref(),
            Some("b\na 0\na 1\na 2\n")
        );
    }

    #[test]
    fn a_module_is_declared_in_the_order_of_names() {
        let with = |text, line| with_line(text, Place::Module, line).expect("a place");
        let modules = "pub(crate) mod a;\nmod c;\npub(crate) mod e;\n\nuse x;\n";
        assert_eq!(
            with(modules, "pub(crate) mod d;"),
            "pub(crate) mod a;\nmod c;\npub(crate) mod d;\npub(crate) mod e;\n\nuse x;\n"
        );
        assert_eq!(
            with("use x;\nmod b;\n", "mod c;"),
            "use x;\nmod b;\nmod c;\n"
        );
        assert_eq!(
            with("use x;\nmod b;\n", "mod a;"),
            "use x;\nmod a;\nmod b;\n"
        );
    }
}
