//! Elements of a file by their names, and errors at their lines.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use catoptric_scene::SceneError;
use roxmltree::{Document, Node, NodeId};

/// The text of a file.
pub struct Text {
    pub path: PathBuf,
    text: String,
}

/// A scene's files, parsed: the first is the one that was asked for.
pub struct Files<'t> {
    all: Vec<(&'t Path, Document<'t>)>,
    /// Elements by their `id`, in whichever file.
    ids: HashMap<&'t str, (usize, NodeId)>,
    /// Where files that are named are looked for.
    folders: Vec<PathBuf>,
}

/// One of them.
#[derive(Clone, Copy)]
pub struct File<'f> {
    files: &'f Files<'f>,
    index: usize,
}

/// Most files of a scene.
const MOST_FILES: usize = 200;

/// Largest file of XML.
const LARGEST: u64 = 1 << 28;

/// Reads a file and those that it includes.
pub fn read_all(path: &Path) -> anyhow::Result<Vec<Text>> {
    let mut texts: Vec<Text> = Vec::new();
    let mut defaults: HashMap<String, String> = HashMap::new();
    let mut open = vec![path.to_owned()];
    let main = path.parent().unwrap_or(Path::new(""));
    while let Some(path) = open.pop() {
        if texts.iter().any(|known| known.path == path) {
            continue;
        }
        let whole = |message: String| SceneError::File {
            file: path.display().to_string(),
            message,
        };
        if texts.len() >= MOST_FILES {
            return Err(whole(format!("is one of more than {MOST_FILES} files")).into());
        }
        let size = std::fs::metadata(&path).map_or(0, |about| about.len());
        if size > LARGEST {
            return Err(whole(format!("has {size} bytes: the most is {LARGEST}")).into());
        }
        let text = std::fs::read_to_string(&path)
            .map_err(|error| whole(format!("cannot be read: {error}")))?;
        {
            let document = parse(&path, &text)?;
            let root = document.root_element();
            let attribute = |node: Node<'_, '_>, key| node.attribute(key).map(str::to_owned);
            for node in root.children().filter(|node| node.has_tag_name("default")) {
                if let (Some(name), Some(value)) =
                    (attribute(node, "name"), attribute(node, "value"))
                {
                    defaults.entry(name).or_insert(value);
                }
            }
            for node in root.children().filter(|node| node.has_tag_name("include")) {
                let name = attribute(node, "filename").unwrap_or_default();
                let name = substituted(&name, &defaults);
                let folder = path.parent().unwrap_or(Path::new(""));
                let found = [main, folder].map(|folder| folder.join(&name));
                let found = found.into_iter().find(|path| path.is_file());
                let Some(found) = found else {
                    return Err(SceneError::AtLine {
                        file: path.display().to_string(),
                        line: document.text_pos_at(node.range().start).row as usize,
                        message: format!("<include>: there is no file `{name}`"),
                    }
                    .into());
                };
                open.push(found);
            }
        }
        texts.push(Text { path, text });
    }
    Ok(texts)
}

fn parse<'t>(path: &Path, text: &'t str) -> anyhow::Result<Document<'t>> {
    let document = Document::parse(text).map_err(|error| SceneError::AtLine {
        file: path.display().to_string(),
        line: error.pos().row as usize,
        message: format!("is no XML: {error}"),
    })?;
    let root = document.root_element().tag_name().name().to_owned();
    if root != "scene" {
        return Err(SceneError::File {
            file: path.display().to_string(),
            message: format!("is no scene of Mitsuba: it begins with <{root}>"),
        }
        .into());
    }
    Ok(document)
}

/// What a name was called in other versions: `toWorld` is `to_world`.
pub fn normalized(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() {
            text.push('_');
        }
        text.push(c.to_ascii_lowercase());
    }
    text
}

/// What an element is called.
pub fn name_of<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute("id").or(node.attribute("name"))
}

impl<'t> Files<'t> {
    /// Parses all texts, which begin with the file that was asked for.
    pub fn new(texts: &'t [Text]) -> anyhow::Result<Self> {
        let mut all = Vec::new();
        for text in texts {
            all.push((text.path.as_path(), parse(&text.path, &text.text)?));
        }
        let mut ids = HashMap::new();
        let mut folders: Vec<PathBuf> = Vec::new();
        for (index, (path, document)) in all.iter().enumerate() {
            let folder = path.parent().unwrap_or(Path::new(""));
            folders.push(folder.to_owned());
            for node in document
                .descendants()
                .filter(|node| !node.has_tag_name("ref"))
            {
                let id = node.attribute_node("id").map(|id| id.range_value());
                if let Some(id) = id.and_then(|range| texts[index].text.get(range)) {
                    ids.entry(id).or_insert((index, node.id()));
                }
                if let (true, Some(value)) = (node.has_tag_name("path"), node.attribute("value")) {
                    folders.push(folder.join(value));
                }
            }
        }
        for (index, (_, document)) in all.iter().enumerate() {
            for alias in document
                .descendants()
                .filter(|node| node.has_tag_name("alias"))
            {
                let known = alias.attribute("id").and_then(|id| ids.get(id).copied());
                let name = alias.attribute_node("as").map(|name| name.range_value());
                let name = name.and_then(|range| texts[index].text.get(range));
                if let (Some(name), Some(known)) = (name, known) {
                    ids.insert(name, known);
                }
            }
        }
        Ok(Self { all, ids, folders })
    }

    /// The file that was asked for.
    pub fn first(&'t self) -> File<'t> {
        File {
            files: self,
            index: 0,
        }
    }
}

impl<'f> File<'f> {
    /// Its outermost element.
    pub fn root(self) -> Node<'f, 'f> {
        self.files.all[self.index].1.root_element()
    }

    pub fn path(self) -> &'f Path {
        self.files.all[self.index].0
    }

    /// A file that this one names, where there is one.
    pub fn find(self, name: &str) -> PathBuf {
        let beside = self.path().parent().unwrap_or(Path::new("")).join(name);
        let all = self.files.folders.iter().map(|folder| folder.join(name));
        let mut all = std::iter::once(beside.clone()).chain(all);
        all.find(|path| path.is_file()).unwrap_or(beside)
    }

    /// The file that this one includes under a name.
    pub fn included(self, name: &str) -> Option<Self> {
        let path = self.find(name);
        let same =
            |known: &Path| known == path || known.canonicalize().ok() == path.canonicalize().ok();
        let index = self.files.all.iter().position(|(known, _)| same(known))?;
        Some(Self { index, ..self })
    }

    pub fn error(self, node: Node<'_, '_>, message: &str) -> anyhow::Error {
        SceneError::AtLine {
            file: self.path().display().to_string(),
            line: line(node),
            message: format!("<{}>: {message}", node.tag_name().name()),
        }
        .into()
    }

    pub fn attribute<'a>(self, node: Node<'a, '_>, key: &str) -> anyhow::Result<&'a str> {
        node.attribute(key)
            .ok_or_else(|| self.error(node, &format!("has no `{key}`")))
    }

    /// The element that a reference leads to, and its file; one that is none leads to itself.
    pub fn resolved(self, node: Node<'f, 'f>) -> Option<(Self, Node<'f, 'f>)> {
        if !node.has_tag_name("ref") {
            return Some((self, node));
        }
        let (index, id) = *self.files.ids.get(node.attribute("id")?)?;
        let node = self.files.all[index].1.get_node(id)?;
        Some((Self { index, ..self }, node))
    }
}

/// The line of an element, from 1.
pub fn line(node: Node<'_, '_>) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}

/// The elements inside one.
pub fn children<'a>(of: Node<'a, 'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    of.children().filter(Node::is_element)
}

/// The parameter of this name.
pub fn child<'a, 'i>(of: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    of.children().filter(Node::is_element).find(|child| {
        let known = child.attribute("name");
        known.is_some_and(|known| known == name || normalized(known) == name)
    })
}

/// A text with `$names` replaced by their values.
pub fn substituted(text: &str, defaults: &HashMap<String, String>) -> String {
    let mut names: Vec<&String> = defaults.keys().collect();
    // The longest first: `$a` must not be taken out of `$ab`.
    names.sort_by_key(|name| std::cmp::Reverse(name.len()));
    let mut text = text.to_owned();
    for name in names {
        text = text.replace(&format!("${name}"), &defaults[name]);
    }
    text
}
