//! Words of a PBRT file, each with its line.

use std::path::{Path, PathBuf};

use catoptric_scene::SceneError;

/// A word.
#[derive(Clone, Debug, PartialEq)]
pub enum Word {
    /// A directive, or `true` and `false`.
    Bare(String),
    /// In quotation marks.
    Quoted(String),
    /// A number.
    Number(f64),
    /// `[`.
    Open,
    /// `]`.
    Close,
}

/// A word and where it stands.
#[derive(Clone, Debug)]
pub struct Token {
    pub word: Word,
    pub line: usize,
}

/// Reads words one after another.
pub struct Lexer {
    pub path: PathBuf,
    text: Vec<u8>,
    at: usize,
    line: usize,
    peeked: Option<Token>,
}

impl Lexer {
    pub fn new(path: &Path, text: Vec<u8>) -> Self {
        Self {
            path: path.to_owned(),
            text,
            at: 0,
            line: 1,
            peeked: None,
        }
    }

    pub fn error(&self, line: usize, message: impl Into<String>) -> anyhow::Error {
        SceneError::AtLine {
            file: self.path.display().to_string(),
            line,
            message: message.into(),
        }
        .into()
    }

    /// The line of the next word, or of the last one.
    pub fn line(&self) -> usize {
        self.peeked.as_ref().map_or(self.line, |token| token.line)
    }

    /// The next word without taking it.
    pub fn peek(&mut self) -> anyhow::Result<Option<&Token>> {
        if self.peeked.is_none() {
            self.peeked = self.read()?;
        }
        Ok(self.peeked.as_ref())
    }

    /// The next word; `None` at the end.
    pub fn next(&mut self) -> anyhow::Result<Option<Token>> {
        match self.peeked.take() {
            Some(token) => Ok(Some(token)),
            None => self.read(),
        }
    }

    fn read(&mut self) -> anyhow::Result<Option<Token>> {
        loop {
            match self.text.get(self.at) {
                None => return Ok(None),
                Some(b'\n') => {
                    self.line += 1;
                    self.at += 1;
                }
                Some(byte) if byte.is_ascii_whitespace() => self.at += 1,
                Some(b'#') => {
                    while self.text.get(self.at).is_some_and(|byte| *byte != b'\n') {
                        self.at += 1;
                    }
                }
                Some(_) => break,
            }
        }
        let line = self.line;
        let word = match self.text[self.at] {
            b'[' => {
                self.at += 1;
                Word::Open
            }
            b']' => {
                self.at += 1;
                Word::Close
            }
            b'"' => {
                let start = self.at + 1;
                let rest = &self.text[start..];
                let end = rest.iter().position(|byte| matches!(byte, b'"' | b'\n'));
                match end {
                    Some(end) if rest[end] == b'"' => {
                        self.at = start + end + 1;
                        Word::Quoted(String::from_utf8_lossy(&rest[..end]).into_owned())
                    }
                    _ => return Err(self.error(line, "a quotation mark is not closed")),
                }
            }
            _ => {
                let start = self.at;
                let ends = |byte: &u8| {
                    byte.is_ascii_whitespace() || matches!(byte, b'[' | b']' | b'"' | b'#')
                };
                while self.text.get(self.at).is_some_and(|byte| !ends(byte)) {
                    self.at += 1;
                }
                let text = String::from_utf8_lossy(&self.text[start..self.at]).into_owned();
                match text.parse::<f64>() {
                    Ok(number) if number.is_finite() && !text.starts_with(char::is_alphabetic) => {
                        Word::Number(number)
                    }
                    Ok(_) => return Err(self.error(line, format!("`{text}` is no finite number"))),
                    Err(_) => Word::Bare(text),
                }
            }
        };
        Ok(Some(Token { word, line }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_their_lines() {
        let text = b"LookAt 1 -2.5e1 .5 # eye\n\"point3 P\" [ 0 1]\nWorldBegin".to_vec();
        let mut lexer = Lexer::new(Path::new("a.pbrt"), text);
        let mut words = Vec::new();
        while let Some(token) = lexer.next().unwrap() {
            words.push((token.line, token.word));
        }
        assert_eq!(words[0], (1, Word::Bare("LookAt".to_owned())));
        assert_eq!(words[2], (1, Word::Number(-25.0)));
        assert_eq!(words[4], (2, Word::Quoted("point3 P".to_owned())));
        assert_eq!(words[5], (2, Word::Open));
        assert_eq!(words[9], (3, Word::Bare("WorldBegin".to_owned())));
        let mut lexer = Lexer::new(Path::new("a.pbrt"), b"\n\"open".to_vec());
        let error = lexer.next().unwrap_err().to_string();
        assert!(error.starts_with("a.pbrt:2: "), "{error}");
        let mut lexer = Lexer::new(Path::new("a.pbrt"), b"inf nan 1e999".to_vec());
        assert!(lexer.next().is_err());
    }
}
