//! A look at every line of an OBJ file: what is wrong with it, and what it refers to.

use std::path::Path;

use crate::SceneError;
use crate::text::{at_line, lines, split_key, without_comment};

/// What a look at every line finds.
pub(super) struct Scan {
    /// The vertices, faces and uses of materials alone: no comments, one line a statement, two
    /// numbers a texture coordinate.
    pub clean: String,
    /// Whether every face corner has a position, a texture coordinate, a normal.
    pub everywhere: [bool; 3],
    /// Lines and values of `mtllib`.
    pub libraries: Vec<(usize, String)>,
    /// Lines and values of `usemtl`.
    pub materials: Vec<(usize, String)>,
    /// Line and material of the first face after each `usemtl` that has a corner without a
    /// texture coordinate.
    pub bare: Vec<(usize, String)>,
}

/// What the lines so far say.
#[derive(Default)]
struct State {
    /// Positions, texture coordinates and normals.
    counts: [i64; 3],
    faces: usize,
    colored: Option<bool>,
    /// Line, index and kind; legal where the index exists at the end of the file.
    ahead: Vec<(usize, i64, usize)>,
    /// How many materials were in use where a face without texture coordinates came last.
    bare_in: Option<usize>,
}

/// Finds what is wrong with numbers and indices, and what the file refers to.
pub(super) fn scan(path: &Path, text: &str) -> Result<Scan, SceneError> {
    let mut scan = Scan {
        clean: String::with_capacity(text.len()),
        everywhere: [true; 3],
        libraries: Vec::new(),
        materials: Vec::new(),
        bare: Vec::new(),
    };
    let mut state = State::default();
    for (number, line) in lines(text) {
        let (key, rest) = split_key(&line);
        let done = match key {
            "v" | "vt" | "vn" => scan.vertex(&mut state, key, without_comment(rest)),
            "f" => scan.face(&mut state, number, without_comment(rest)),
            "mtllib" => {
                scan.libraries.push((number, rest.to_owned()));
                Ok(())
            }
            "usemtl" if rest.is_empty() => Err("`usemtl` names no material".to_owned()),
            "usemtl" => {
                scan.materials.push((number, rest.to_owned()));
                scan.keep(key, rest);
                Ok(())
            }
            _ => Ok(()),
        };
        done.map_err(|message| at_line(path, number, message))?;
    }
    let State {
        counts,
        faces,
        ahead,
        ..
    } = state;
    let beyond = ahead
        .into_iter()
        .find(|(_, index, kind)| *index > counts[*kind]);
    if let Some((line, index, kind)) = beyond {
        return Err(at_line(path, line, out_of_range(index, kind, counts[kind])));
    }
    if faces == 0 {
        let message = "the mesh is empty: no face".to_owned();
        return Err(SceneError::File {
            file: path.display().to_string(),
            message,
        });
    }
    Ok(scan)
}

impl Scan {
    fn keep(&mut self, key: &str, rest: &str) {
        for part in [key, " ", rest, "\n"] {
            self.clean.push_str(part);
        }
    }

    /// A `v`, `vt` or `vn`.
    fn vertex(&mut self, state: &mut State, key: &str, rest: &str) -> Result<(), String> {
        let finite = |word: &str| word.parse().ok().filter(|value: &f32| value.is_finite());
        let values: Option<Vec<f32>> = rest.split_whitespace().map(finite).collect();
        let Some(values) = values else {
            return Err(format!("`{key}` has a value that is no finite number"));
        };
        let wanted = if key == "vt" { 1 } else { 3 };
        if values.len() < wanted {
            let numbers = if wanted == 1 { "a number" } else { "3 numbers" };
            return Err(format!("`{key}` needs {numbers}"));
        }
        match key {
            "v" => {
                if !matches!(values.len(), 3 | 4 | 6) {
                    let count = values.len();
                    return Err(format!(
                        "`v` has {count} numbers: it takes x y z, then nothing, w or r g b"
                    ));
                }
                if values.len() == 4 && values[3] == 0.0 {
                    return Err("`v` has the weight 0".to_owned());
                }
                state.counts[0] += 1;
                let color = values.len() == 6;
                if *state.colored.get_or_insert(color) != color {
                    return Err("either all vertices have colours or none".to_owned());
                }
            }
            "vt" => state.counts[1] += 1,
            _ => state.counts[2] += 1,
        }
        self.keep(key, rest);
        if key == "vt" && values.len() == 1 {
            self.clean.pop();
            self.clean.push_str(" 0\n");
        }
        Ok(())
    }

    /// An `f`.
    fn face(&mut self, state: &mut State, line: usize, rest: &str) -> Result<(), String> {
        let corners = || rest.split_whitespace();
        if corners().count() < 3 {
            return Err("a face needs at least 3 corners".to_owned());
        }
        state.faces += 1;
        let mut bare = false;
        for corner in corners() {
            let mut parts = corner.split('/');
            for (kind, count) in state.counts.into_iter().enumerate() {
                let part = parts.next().unwrap_or("");
                if part.is_empty() && kind > 0 {
                    self.everywhere[kind] = false;
                    bare |= kind == 1;
                    continue;
                }
                let Ok(index) = part.parse::<i64>() else {
                    return Err(format!("`{corner}` is no face corner"));
                };
                if index == 0 || index < -count {
                    return Err(out_of_range(index, kind, count));
                }
                if index > count {
                    state.ahead.push((line, index, kind));
                }
            }
            if parts.next().is_some() {
                return Err(format!("`{corner}` is no face corner"));
            }
        }
        let material = self.materials.last().map(|(_, name)| name.clone());
        if let Some(material) = material.filter(|_| bare)
            && state.bare_in.replace(self.materials.len()) != Some(self.materials.len())
        {
            self.bare.push((line, material));
        }
        self.keep("f", rest);
        Ok(())
    }
}

fn out_of_range(index: i64, kind: usize, count: i64) -> String {
    let what = ["vertex", "texture coordinate", "normal"][kind];
    format!("{what} index {index} is out of range: there are {count}")
}
