//! The statements of an OBJ file, in one pass over it: what it says, and the line of what is
//! wrong.
//!
//! This is a reader of our own, and no library, because a mesh that is measured has to arrive as
//! it is written: positions in f64 until they are transformed, smoothing groups, indices of
//! vertices that follow, names in any bytes, faces with all their corners, and the line number of
//! each mistake. `tobj`, which reads none of these, reads the same files in the tests: where both
//! can, they must agree.

use std::num::NonZeroU32;
use std::path::Path;

use glam::{DVec2, DVec3, Vec3};

use crate::SceneError;
use crate::geometry::Smoothing;
use crate::loading::Loading;
use crate::text::{self, at_line};

/// Most corners of a face.
const MOST_CORNERS: usize = 10_000;

/// What a file says.
#[derive(Default)]
pub(super) struct Statements {
    pub positions: Vec<DVec3>,
    /// One a position, or none.
    pub colors: Vec<Vec3>,
    pub uvs: Vec<DVec2>,
    pub normals: Vec<DVec3>,
    /// Those of all faces, one face after another.
    pub corners: Vec<Corner>,
    pub faces: Vec<Face>,
    /// Lines and values of `mtllib`.
    pub libraries: Vec<(usize, Vec<u8>)>,
    /// Lines and values of `usemtl`.
    pub uses: Vec<(usize, Vec<u8>)>,
}

/// What a corner of a face refers to, counted from 1 as in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub position: NonZeroU32,
    pub uv: Option<NonZeroU32>,
    pub normal: Option<NonZeroU32>,
}

pub(super) struct Face {
    pub line: usize,
    /// Where its own corners end among all corners; they start where those of the face before end.
    pub end: usize,
    /// Index into `uses`; `None` before the first.
    pub material: Option<usize>,
    pub smoothing: Smoothing,
}

/// What an index refers to.
#[derive(Clone, Copy)]
enum Kind {
    Position,
    Uv,
    Normal,
}

impl Kind {
    const ALL: [Self; 3] = [Self::Position, Self::Uv, Self::Normal];

    fn name(self) -> &'static str {
        ["vertex", "texture coordinate", "normal"][self as usize]
    }

    fn key(self) -> &'static str {
        ["v", "vt", "vn"][self as usize]
    }
}

/// An index that may turn out to refer to nothing.
#[derive(Clone, Copy)]
struct Doubtful {
    line: usize,
    index: i64,
}

/// What matters from line to line.
#[derive(Default)]
struct Reader {
    said: Statements,
    smoothing: Smoothing,
    /// For each kind, indices of what has not come yet: each larger than all before it, so that
    /// the first one beyond the end of the file is among them.
    ahead: [Vec<Doubtful>; 3],
    /// For each kind, the first index that counts back beyond the first of its kind.
    behind: [Option<Doubtful>; 3],
}

impl Statements {
    /// Reads a file, which has at least one face.
    pub(super) fn read(path: &Path, loading: &Loading) -> Result<Self, SceneError> {
        let content = text::read(path, "OBJ")?;
        let mut reader = Reader::default();
        for (number, line) in text::lines(&content) {
            reader
                .statement(number, &line)
                .map_err(|message| at_line(path, number, message))?;
        }
        reader.check_indices(path, loading)?;
        if reader.said.faces.is_empty() {
            return Err(SceneError::File {
                file: path.display().to_string(),
                message: "the mesh is empty: no face".to_owned(),
            });
        }
        Ok(reader.said)
    }

    /// Each face with its corners.
    pub(super) fn faces(&self) -> impl Iterator<Item = (&Face, &[Corner])> {
        self.faces.iter().scan(0, |start, face| {
            let corners = &self.corners[*start..face.end];
            *start = face.end;
            Some((face, corners))
        })
    }
}

impl Reader {
    fn statement(&mut self, number: usize, line: &[u8]) -> Result<(), String> {
        let (key, rest) = text::split_key(line);
        let values = text::without_comment(rest);
        match key {
            b"v" => self.position(&numbers("v", values, 3)?),
            b"vt" => {
                let values = numbers("vt", values, 1)?;
                let v = values.get(1).copied().unwrap_or(0.0);
                self.said.uvs.push(DVec2::new(values[0], v));
                Ok(())
            }
            b"vn" => {
                let values = numbers("vn", values, 3)?;
                self.said.normals.push(DVec3::from_slice(&values));
                Ok(())
            }
            b"f" => self.face(number, values),
            b"s" => {
                self.smoothing = smoothing(values.trim_ascii())?;
                Ok(())
            }
            b"mtllib" => {
                self.said.libraries.push((number, rest.to_owned()));
                Ok(())
            }
            b"usemtl" => {
                self.said.uses.push((number, rest.to_owned()));
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn position(&mut self, values: &[f64]) -> Result<(), String> {
        let [x, y, z, rest @ ..] = values else {
            return Ok(());
        };
        let position = DVec3::new(*x, *y, *z);
        let (weight, color) = match rest {
            [] => (1.0, None),
            [weight] => (*weight, None),
            [red, green, blue] => (1.0, Some(DVec3::new(*red, *green, *blue).as_vec3())),
            _ => {
                let count = values.len();
                return Err(format!(
                    "`v` has {count} numbers: it takes x y z, then nothing, w or r g b"
                ));
            }
        };
        if weight == 0.0 {
            return Err("`v` has the weight 0".to_owned());
        }
        let colored_so_far = self.said.colors.len() == self.said.positions.len();
        if color.is_some() != colored_so_far && !self.said.positions.is_empty() {
            return Err("either all vertices have colours or none".to_owned());
        }
        self.said.colors.extend(color);
        self.said.positions.push(position / weight);
        Ok(())
    }

    fn face(&mut self, line: usize, values: &[u8]) -> Result<(), String> {
        let start = self.said.corners.len();
        for word in text::words(values) {
            let corner = self.corner(line, word)?;
            self.said.corners.push(corner);
        }
        let count = self.said.corners.len() - start;
        if count < 3 {
            return Err("a face needs at least 3 corners".to_owned());
        }
        if count > MOST_CORNERS {
            return Err(format!(
                "the face has {count} corners: the most is {MOST_CORNERS}"
            ));
        }
        self.said.faces.push(Face {
            line,
            end: self.said.corners.len(),
            material: self.said.uses.len().checked_sub(1),
            smoothing: self.smoothing,
        });
        Ok(())
    }

    fn corner(&mut self, line: usize, word: &[u8]) -> Result<Corner, String> {
        let no_corner = || format!("`{}` is no face corner", text::shown(word));
        let mut parts = word.split(|byte| *byte == b'/');
        let mut indices = [None; 3];
        for kind in Kind::ALL {
            let part = parts.next().unwrap_or_default();
            if part.is_empty() {
                continue;
            }
            let index = std::str::from_utf8(part)
                .ok()
                .and_then(|part| part.parse().ok());
            indices[kind as usize] = self.index(line, index.ok_or_else(no_corner)?, kind)?;
        }
        let [Some(position), uv, normal] = indices else {
            return Err(no_corner());
        };
        if parts.next().is_some() {
            return Err(no_corner());
        }
        Ok(Corner {
            position,
            uv,
            normal,
        })
    }

    /// An index from 1, of one from 1 or one back from the last; `None` where the file may prove
    /// to have nothing of the kind.
    fn index(&mut self, line: usize, index: i64, kind: Kind) -> Result<Option<NonZeroU32>, String> {
        let count = self.count(kind);
        let doubtful = Doubtful { line, index };
        if index == 0 || index < -count {
            if count > 0 || matches!(kind, Kind::Position) {
                return Err(out_of_range(index, kind, count));
            }
            self.behind[kind as usize].get_or_insert(doubtful);
            return Ok(None);
        }
        let absolute = if index < 0 { count + 1 + index } else { index };
        if absolute > count {
            let ahead = &mut self.ahead[kind as usize];
            if ahead.last().is_none_or(|last| last.index < absolute) {
                ahead.push(doubtful);
            }
        }
        u32::try_from(absolute)
            .map(NonZeroU32::new)
            .map_err(|_| out_of_range(index, kind, count))
    }

    fn count(&self, kind: Kind) -> i64 {
        let count = match kind {
            Kind::Position => self.said.positions.len(),
            Kind::Uv => self.said.uvs.len(),
            Kind::Normal => self.said.normals.len(),
        };
        count as i64
    }

    /// Indices may refer to what follows, but not to what never comes. Those of texture
    /// coordinates or normals count for nothing in a file that has none at all.
    fn check_indices(&mut self, path: &Path, loading: &Loading) -> Result<(), SceneError> {
        let mut first: Option<(Doubtful, Kind)> = None;
        for kind in Kind::ALL {
            let count = self.count(kind);
            let beyond = (self.ahead[kind as usize].iter()).find(|doubtful| doubtful.index > count);
            let wrong = [beyond, self.behind[kind as usize].as_ref()]
                .into_iter()
                .flatten()
                .min_by_key(|doubtful| doubtful.line);
            let Some(wrong) = wrong.copied() else {
                continue;
            };
            if count == 0 && !matches!(kind, Kind::Position) {
                for corner in &mut self.said.corners {
                    match kind {
                        Kind::Uv => corner.uv = None,
                        _ => corner.normal = None,
                    }
                }
                let (line, name, key) = (wrong.line, kind.name(), kind.key());
                loading.warn(format!(
                    "{}:{line}: the {name} index {} counts for nothing: the file has no `{key}`",
                    path.display(),
                    wrong.index
                ));
            } else if first.is_none_or(|(other, _)| wrong.line < other.line) {
                first = Some((wrong, kind));
            }
        }
        first.map_or(Ok(()), |(wrong, kind)| {
            let message = out_of_range(wrong.index, kind, self.count(kind));
            Err(at_line(path, wrong.line, message))
        })
    }
}

/// All words as numbers, at least `least` of them.
fn numbers(key: &str, values: &[u8], least: usize) -> Result<Vec<f64>, String> {
    let mut numbers = Vec::with_capacity(6);
    for word in text::words(values) {
        let number = text::number(word).ok_or_else(|| {
            let word = text::shown(word);
            format!("`{key}` has a value that is no finite number: `{word}`")
        })?;
        numbers.push(number);
    }
    if numbers.len() < least {
        let wanted = if least == 1 { "a number" } else { "3 numbers" };
        return Err(format!("`{key}` needs {wanted}"));
    }
    Ok(numbers)
}

/// The value of an `s`.
fn smoothing(value: &[u8]) -> Result<Smoothing, String> {
    // Some programs write several groups; the first is the one that matters.
    let first = text::words(value).next().unwrap_or_default();
    match first {
        b"off" | b"0" => Ok(Smoothing::Flat),
        b"on" => Ok(Smoothing::Group(1)),
        _ => std::str::from_utf8(first)
            .ok()
            .and_then(|number| number.parse().ok())
            .map(Smoothing::Group)
            .ok_or_else(|| {
                let found = text::shown(value);
                format!("`s` must be the number of a smoothing group or `off`, not `{found}`")
            }),
    }
}

fn out_of_range(index: i64, kind: Kind, count: i64) -> String {
    let name = kind.name();
    format!("{name} index {index} is out of range: there are {count}")
}
