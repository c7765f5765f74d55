//! Parameters of a directive: `"float radius" 2`.

use catoptric_scene::suggest;
use glam::{DVec3, Vec2, Vec3};

use super::lexer::{Lexer, Word};

/// The parameters of a directive.
pub struct Params {
    /// The directive's line.
    pub line: usize,
    all: Vec<Param>,
}

struct Param {
    kind: String,
    name: String,
    line: usize,
    values: Values,
}

#[derive(Clone, Debug)]
enum Values {
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

impl Params {
    /// Reads all that follow, up to the next directive.
    pub fn read(lexer: &mut Lexer, line: usize) -> anyhow::Result<Self> {
        let mut all = Vec::new();
        while let Some(token) = lexer.peek()? {
            let Word::Quoted(said) = token.word.clone() else {
                break;
            };
            let line = token.line;
            lexer.next()?;
            let mut words = said.split_whitespace();
            let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
                return Err(lexer.error(
                    line,
                    format!("\"{said}\" is no parameter: type and name are wanted, as in \"float radius\""),
                ));
            };
            all.push(Param {
                kind: kind.to_owned(),
                name: name.to_owned(),
                line,
                values: values(lexer, line, name)?,
            });
        }
        Ok(Self { line, all })
    }

    fn find(&self, name: &str) -> Option<&Param> {
        self.all.iter().find(|param| param.name == name)
    }

    /// Whether there is a parameter of this name.
    pub fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }

    /// Names of parameters, of which a misspelt one may be among.
    pub fn nearest(&self, name: &str) -> String {
        suggest(name, self.all.iter().map(|param| param.name.as_str()))
    }

    /// All numbers of a parameter; none where it is not there.
    pub fn numbers(&self, lexer: &Lexer, name: &str) -> anyhow::Result<&[f64]> {
        match self.find(name) {
            None => Ok(&[]),
            Some(Param {
                values: Values::Numbers(numbers),
                ..
            }) => Ok(numbers),
            Some(param) => Err(lexer.error(param.line, format!("`{name}` must be numbers"))),
        }
    }

    /// The first number of a parameter.
    pub fn number(&self, lexer: &Lexer, name: &str, missing: f64) -> anyhow::Result<f64> {
        let numbers = match self.find(name).map(|param| param.kind.as_str()) {
            Some("texture" | "string" | "bool") => &[],
            _ => self.numbers(lexer, name)?,
        };
        Ok(numbers.first().copied().unwrap_or(missing))
    }

    /// The first word of a parameter.
    pub fn word(&self, name: &str) -> Option<&str> {
        match &self.find(name)?.values {
            Values::Words(words) => words.first().map(String::as_str),
            Values::Numbers(_) => None,
        }
    }

    /// The texture that a parameter refers to.
    pub fn texture(&self, name: &str) -> Option<&str> {
        let param = self.find(name)?;
        (param.kind == "texture").then(|| self.word(name))?
    }

    /// Whole numbers from 0.
    pub fn indices(&self, lexer: &Lexer, name: &str) -> anyhow::Result<Vec<u32>> {
        let numbers = self.numbers(lexer, name)?;
        let whole = |number: &f64| {
            let is = *number >= 0.0 && *number <= f64::from(u32::MAX) && number.fract() == 0.0;
            is.then_some(*number as u32)
        };
        let all: Option<Vec<u32>> = numbers.iter().map(whole).collect();
        all.ok_or_else(|| lexer.error(self.line, format!("`{name}` must be whole numbers from 0")))
    }

    pub fn vectors(&self, lexer: &Lexer, name: &str) -> anyhow::Result<Vec<DVec3>> {
        let numbers = self.numbers(lexer, name)?;
        match numbers.as_chunks::<3>() {
            (rows, []) => Ok(rows.iter().map(|row| DVec3::from(*row)).collect()),
            _ => Err(lexer.error(self.line, format!("`{name}` must be triples of numbers"))),
        }
    }

    pub fn pairs(&self, lexer: &Lexer, name: &str) -> anyhow::Result<Vec<Vec2>> {
        let numbers = self.numbers(lexer, name)?;
        match numbers.as_chunks::<2>() {
            (rows, []) => Ok(rows
                .iter()
                .map(|row| Vec2::new(row[0] as f32, row[1] as f32))
                .collect()),
            _ => Err(lexer.error(self.line, format!("`{name}` must be pairs of numbers"))),
        }
    }

    /// A colour; `None` where it is not there, or is a spectrum or a temperature.
    pub fn color(&self, lexer: &Lexer, name: &str) -> anyhow::Result<Option<Vec3>> {
        let Some(param) = self.find(name) else {
            return Ok(None);
        };
        if !["rgb", "color", "float"].contains(&param.kind.as_str()) {
            return Ok(None);
        }
        match self.numbers(lexer, name)? {
            [all] => Ok(Some(Vec3::splat(*all as f32))),
            [r, g, b] => Ok(Some(Vec3::new(*r as f32, *g as f32, *b as f32))),
            _ => Err(lexer.error(param.line, format!("`{name}` must be one number, or three"))),
        }
    }
}

/// What stands behind a parameter's name: one value, or several in brackets.
fn values(lexer: &mut Lexer, line: usize, name: &str) -> anyhow::Result<Values> {
    let missing = || format!("`{name}` has no value");
    let Some(first) = lexer.next()? else {
        return Err(lexer.error(line, missing()));
    };
    let mut numbers = Vec::new();
    let mut words = Vec::new();
    let mut take = |word: Word| match word {
        Word::Number(number) => {
            numbers.push(number);
            true
        }
        Word::Quoted(text) => {
            words.push(text);
            true
        }
        Word::Bare(text) if text == "true" || text == "false" => {
            words.push(text);
            true
        }
        Word::Bare(_) | Word::Open | Word::Close => false,
    };
    if first.word == Word::Open {
        loop {
            match lexer.next()? {
                None => {
                    return Err(
                        lexer.error(line, format!("the brackets of `{name}` are not closed"))
                    );
                }
                Some(token) if token.word == Word::Close => break,
                Some(token) => {
                    if !take(token.word) {
                        let message =
                            format!("`{name}` has a value that is neither number nor text");
                        return Err(lexer.error(token.line, message));
                    }
                }
            }
        }
    } else if !take(first.word) {
        return Err(lexer.error(first.line, missing()));
    }
    match (numbers.is_empty(), words.is_empty()) {
        (false, false) => Err(lexer.error(line, format!("`{name}` has numbers and text"))),
        (true, false) => Ok(Values::Words(words)),
        (_, true) => Ok(Values::Numbers(numbers)),
    }
}
