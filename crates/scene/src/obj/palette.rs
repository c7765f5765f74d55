//! The materials that the faces of an OBJ file use.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use super::statements::{Corner, Statements};
use crate::SceneError;
use crate::loading::Loading;
use crate::mtl::{DEFAULT_COLOR, Entry, Library, Painted};
use crate::text::{self, at_line};

/// Which materials a mesh is read with.
pub(crate) enum Materials {
    /// Those of the MTL files that the OBJ names.
    Own,
    /// Those of another MTL file.
    Other(PathBuf),
    /// None: something else gives the colour.
    Ignored,
}

/// The materials of a mesh.
#[derive(Default)]
pub(super) struct Palette {
    /// In the order of the faces that use them first.
    pub used: Vec<Painted>,
    /// Index of each face's own among them.
    pub of_face: Vec<u32>,
    /// Index of what faces without a material have.
    plain: Option<u32>,
    /// Indices of those of libraries.
    by_place: HashMap<Place, u32>,
}

impl Palette {
    /// Finds the material of each face, and reads what of them is used.
    pub(super) fn of(
        path: &Path,
        materials: &Materials,
        statements: &Statements,
        loading: &Loading,
    ) -> Result<Self, SceneError> {
        let libraries = libraries(path, materials, statements)?;
        let known = Known::new(&libraries);
        let mut palette = Self::default();
        let mut by_use: Vec<Option<u32>> = vec![None; statements.uses.len()];
        for (face, corners) in statements.faces() {
            let index = match face.material.map(|place| (place, by_use[place])) {
                None => palette.plain(),
                Some((_, Some(index))) => index,
                Some((place, None)) => {
                    let (line, name) = &statements.uses[place];
                    let index = match known.find(name) {
                        Some(place) => palette.entry(place, &known, loading)?,
                        // Without a name it is none of them.
                        None if libraries.is_empty() || name.is_empty() => palette.plain(),
                        None => {
                            let name = text::shown(name);
                            let message = format!("no material `{name}` in its MTL file");
                            return Err(at_line(path, *line, message));
                        }
                    };
                    by_use[place] = Some(index);
                    index
                }
            };
            palette
                .check_coordinates(index, corners)
                .map_err(|message| at_line(path, face.line, message))?;
            palette.of_face.push(index);
        }
        Ok(palette)
    }

    /// Index of a material of a library, which is read where it is new.
    fn entry(
        &mut self,
        place: Place,
        known: &Known<'_>,
        loading: &Loading,
    ) -> Result<u32, SceneError> {
        if let Some(index) = self.by_place.get(&place) {
            return Ok(*index);
        }
        let (library, entry) = known.at(place);
        let index = self.add(library.paint(entry, loading)?);
        self.by_place.insert(place, index);
        Ok(index)
    }

    fn add(&mut self, painted: Painted) -> u32 {
        self.used.push(painted);
        self.used.len() as u32 - 1
    }

    fn plain(&mut self) -> u32 {
        if let Some(index) = self.plain {
            return index;
        }
        let index = self.add(Painted::plain("default".to_owned(), DEFAULT_COLOR));
        self.plain = Some(index);
        index
    }

    /// A texture needs texture coordinates.
    fn check_coordinates(&self, index: u32, corners: &[Corner]) -> Result<(), String> {
        let painted = &self.used[index as usize];
        if !painted.is_textured() || corners.iter().all(|corner| corner.uv.is_some()) {
            return Ok(());
        }
        Err(format!(
            "the face has no texture coordinates, which the `map_Kd` of its material `{}` needs",
            painted.material.name
        ))
    }
}

/// All materials by their names.
struct Known<'a> {
    libraries: &'a [Library],
    places: HashMap<&'a [u8], Place>,
}

/// Index of a library, and of a material in it.
type Place = (usize, usize);

impl<'a> Known<'a> {
    fn new(libraries: &'a [Library]) -> Self {
        let mut places = HashMap::new();
        // Whole names take precedence over those before a comment.
        for spelling in [0, 1] {
            for (library, content) in libraries.iter().enumerate() {
                for (entry, content) in content.entries.iter().enumerate() {
                    if let Some(name) = text::spellings(&content.name).nth(spelling) {
                        places.entry(name).or_insert((library, entry));
                    }
                }
            }
        }
        Self { libraries, places }
    }

    fn find(&self, name: &[u8]) -> Option<Place> {
        text::spellings(name).find_map(|name| self.places.get(name).copied())
    }

    fn at(&self, (library, entry): Place) -> (&'a Library, &'a Entry) {
        let library = &self.libraries[library];
        (library, &library.entries[entry])
    }
}

/// All MTL files, each read once however often it is named.
fn libraries(
    path: &Path,
    materials: &Materials,
    statements: &Statements,
) -> Result<Vec<Library>, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut files: Vec<PathBuf> = Vec::new();
    match materials {
        Materials::Ignored => {}
        Materials::Other(file) => files.push(file.clone()),
        Materials::Own => {
            let mut seen = HashSet::new();
            for (line, names) in statements
                .libraries
                .iter()
                .filter(|(_, names)| seen.insert(names))
            {
                let named = library_files(folder, names)
                    .map_err(|message| at_line(path, *line, format!("`mtllib`: {message}")))?;
                files.extend(named);
            }
        }
    }
    let mut read = HashSet::new();
    files
        .iter()
        .filter(|file| read.insert(*file))
        .map(|file| Library::read(file))
        .collect()
}

/// The files that a `mtllib` line names: all of it one, or else each of its words.
fn library_files(folder: &Path, names: &[u8]) -> Result<Vec<PathBuf>, String> {
    if let Some(file) = text::beside(folder, names) {
        return Ok(vec![file]);
    }
    let words = text::file_words(names);
    if words.is_empty() {
        return Err("names no file".to_owned());
    }
    let file = |word: &Vec<u8>| {
        text::beside(folder, word).ok_or_else(|| {
            let file = folder.join(text::shown(word));
            format!("no file `{}`", file.display())
        })
    };
    words.iter().map(file).collect()
}
