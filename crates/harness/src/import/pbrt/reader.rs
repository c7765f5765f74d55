//! What is known while files are read: the state that directives change, and what was found.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::DMat4;

use super::lexer::Lexer;
use super::surface::{Material, Texture};
use crate::import::cameras::Axis;
use crate::import::found::{Choice, Found, Thing, View};

/// What directives change and blocks restore.
#[derive(Clone)]
pub struct State {
    /// World from the current space.
    pub matrix: DMat4,
    pub material: Material,
    /// Of an area light: its colour.
    pub light: Option<glam::Vec3>,
    pub reversed: bool,
}

/// What is known so far.
pub struct Reader<'r> {
    pub choice: &'r Choice,
    pub found: Found,
    pub state: State,
    pub kept: Vec<State>,
    pub named_spaces: HashMap<String, DMat4>,
    pub materials: HashMap<String, Material>,
    pub textures: HashMap<String, Texture>,
    /// Shapes of objects that are shown by their instances, in the space of the object.
    pub objects: HashMap<String, Vec<Thing>>,
    /// The object that is being described.
    pub within: Option<(String, DMat4)>,
    pub in_world: bool,
    pub instances: usize,
    pub shapes: usize,
    pub files: usize,
    pub size: [f64; 2],
    pub camera: Option<(View, f64, Axis, usize)>,
}

impl Reader<'_> {
    pub fn leave_out(&mut self, lexer: &Lexer, line: usize, what: &str) {
        let file = lexer.path.file_name().unwrap_or_default().to_string_lossy();
        self.found
            .left_out
            .push(format!("{what} of {file}, line {line}"));
    }

    /// Adds a thing to the scene, or to the object that is being described.
    pub fn add(&mut self, thing: Thing) {
        match &self.within {
            Some((object, _)) => self.objects.entry(object.clone()).or_default().push(thing),
            None => self.found.things.push(thing),
        }
    }
}

/// A file that another one names.
pub fn beside(lexer: &Lexer, name: &str) -> PathBuf {
    lexer.path.parent().unwrap_or(Path::new("")).join(name)
}
