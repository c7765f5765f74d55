//! Technique names: `SEARCH[(options)][+REFINE[(options)]]` or `NAME[(options)]`.

use std::fmt;

use thiserror::Error;

use crate::registry::{Family, OptionInfo, TECHNIQUES, TechniqueInfo, Values};

/// A parsed technique name with every option settled.
#[derive(Clone, Debug)]
pub struct Spec {
    written: String,
    pub(crate) options: Options,
    pub(crate) refinement: Option<Options>,
}

/// A technique with a value for each of its options.
#[derive(Clone, Debug)]
pub struct Options {
    info: &'static TechniqueInfo,
    values: Vec<(&'static str, String)>,
}

/// What is wrong with a technique name.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum SpecError {
    /// No such technique.
    #[error("unknown technique `{name}`{hint}")]
    Technique {
        /// As written.
        name: String,
        /// The nearest name, as a question.
        hint: String,
    },
    /// A technique of the papers that is not built yet.
    #[error("technique `{name}` is not available: {reason}")]
    Unavailable {
        /// Its name.
        name: &'static str,
        /// Why.
        reason: &'static str,
    },
    /// A refinement of a technique that takes none.
    #[error("`{name}` takes no refinement; refinements go with a search")]
    Alone {
        /// Its name.
        name: &'static str,
    },
    /// No such option.
    #[error("`{technique}` has no option `{option}`{hint}")]
    Option {
        /// Technique.
        technique: &'static str,
        /// As written.
        option: String,
        /// The nearest option, as a question.
        hint: String,
    },
    /// A value the option does not take.
    #[error("`{option}={value}`: {option} is one of {allowed}")]
    Value {
        /// Option.
        option: &'static str,
        /// As written.
        value: String,
        /// What it takes.
        allowed: String,
    },
    /// Parentheses or `=` missing.
    #[error("`{0}` is not NAME or NAME(key=value,…)")]
    Syntax(String),
}

fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> String {
    known
        .map(|name| (strsim::damerau_levenshtein(word, name), name))
        .min()
        .filter(|(distance, name)| *distance <= name.len().max(3) / 2)
        .map(|(_, name)| format!(" (did you mean `{name}`?)"))
        .unwrap_or_default()
}

fn technique(name: &str, refines: bool) -> Result<&'static TechniqueInfo, SpecError> {
    let known = || {
        let is_refinement = |info: &&TechniqueInfo| info.family == Family::Refinement;
        (TECHNIQUES.iter()).filter(move |info| is_refinement(info) == refines)
    };
    let found = known().find(|info| info.name == name);
    let found = found.ok_or_else(|| SpecError::Technique {
        name: name.to_owned(),
        hint: nearest(name, known().map(|info| info.name)),
    })?;
    match found.reason() {
        Some(reason) => Err(SpecError::Unavailable {
            name: found.name,
            reason,
        }),
        None => Ok(found),
    }
}

/// Parses a technique name.
///
/// # Errors
/// Unknown names, options and values, with the nearest known one.
pub fn parse(text: &str) -> Result<Spec, SpecError> {
    let written: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let (first, refinement) = match written.split_once('+') {
        Some((first, refinement)) => (first, Some(format!("+{refinement}"))),
        None => (written.as_str(), None),
    };
    let options = Options::parse(first, false)?;
    let refinement = refinement.map(|text| Options::parse(&text, true));
    if refinement.is_some() && options.info.family != Family::Search {
        return Err(SpecError::Alone {
            name: options.info.name,
        });
    }
    Ok(Spec {
        options,
        refinement: refinement.transpose()?,
        written,
    })
}

impl Options {
    /// Parses `NAME` or `NAME(key=value,…)`.
    fn parse(text: &str, refines: bool) -> Result<Self, SpecError> {
        let (name, arguments) = match text.split_once('(') {
            Some((name, rest)) => (
                name,
                rest.strip_suffix(')')
                    .ok_or_else(|| SpecError::Syntax(text.to_owned()))?,
            ),
            None => (text, ""),
        };
        let info = technique(name, refines)?;
        let default = |option: &OptionInfo| (option.name, option.default());
        let mut values: Vec<_> = info.options().map(default).collect();
        let given = arguments.split(',').filter(|given| !given.is_empty());
        for argument in given {
            let (key, value) = argument
                .split_once('=')
                .ok_or_else(|| SpecError::Syntax(argument.to_owned()))?;
            let known = info.options().zip(&mut values);
            let (option, place) = known
                .into_iter()
                .find(|(option, _)| option.name == key)
                .ok_or_else(|| SpecError::Option {
                    technique: info.name,
                    option: key.to_owned(),
                    hint: nearest(key, info.options().map(|option| option.name)),
                })?;
            place.1 = settle(option, value).ok_or_else(|| SpecError::Value {
                option: option.name,
                value: value.to_owned(),
                allowed: option.allowed(),
            })?;
        }
        Ok(Self { info, values })
    }

    /// Name of the technique.
    pub fn name(&self) -> &'static str {
        self.info.name
    }

    pub(crate) fn info(&self) -> &'static TechniqueInfo {
        self.info
    }

    /// Value of an option.
    ///
    /// # Panics
    /// If the technique has no such option: a bug in the caller.
    pub fn text(&self, key: &str) -> &str {
        let found = self.values.iter().find(|(known, _)| *known == key);
        &found
            .unwrap_or_else(|| panic!("{} has no option {key}", self.info.name))
            .1
    }

    /// Whether an option has this value.
    ///
    /// # Panics
    /// As [`Options::text`].
    pub fn is(&self, key: &str, value: &str) -> bool {
        self.text(key) == value
    }

    /// Value of an option that is a whole number.
    ///
    /// # Panics
    /// As [`Options::text`], or if the option is no whole number.
    pub fn whole(&self, key: &str) -> u32 {
        self.text(key).parse().expect("settled as a whole number")
    }

    /// Value of an option that is a number.
    ///
    /// # Panics
    /// As [`Options::text`], or if the option is no number.
    pub fn number(&self, key: &str) -> f64 {
        self.text(key).parse().expect("settled as a number")
    }
}

/// The value in its usual spelling; `None` if the option does not take it.
fn settle(option: &OptionInfo, value: &str) -> Option<String> {
    match option.values {
        Values::Words(words) => words.contains(&value).then(|| value.to_owned()),
        Values::Whole { range, .. } => {
            let number: u32 = value.parse().ok()?;
            (range[0]..=range[1])
                .contains(&number)
                .then(|| number.to_string())
        }
        Values::Number { range, .. } => {
            let number: f64 = value.parse().ok()?;
            (range[0]..=range[1])
                .contains(&number)
                .then(|| number.to_string())
        }
    }
}

impl Spec {
    /// Name of the search or technique, without options and refinement.
    pub fn name(&self) -> &'static str {
        self.options.name()
    }

    /// The search or technique with its options.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The refinement with its options.
    pub fn refinement(&self) -> Option<&Options> {
        self.refinement.as_ref()
    }
}

impl PartialEq for Spec {
    /// Whether both mean the same, however they are written.
    fn eq(&self, other: &Self) -> bool {
        self.options == other.options && self.refinement == other.refinement
    }
}

impl PartialEq for Options {
    fn eq(&self, other: &Self) -> bool {
        self.info.name == other.info.name && self.values == other.values
    }
}

impl fmt::Display for Spec {
    /// As it was written, without spaces.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_as_written_and_mean_the_same() {
        let spec = parse("linear(start=center, residual=cross)").unwrap();
        assert_eq!(spec.to_string(), "linear(start=center,residual=cross)");
        assert_eq!(spec, parse("linear(residual=cross)").unwrap());
        assert_ne!(spec, parse("linear").unwrap());
        assert!(spec.options().is("neighbours", "4"));
    }

    #[test]
    fn mistakes_name_the_nearest() {
        let message = |text: &str| parse(text).unwrap_err().to_string();
        assert!(message("liner").contains("`linear`"));
        assert!(message("linear(residul=cross)").contains("`residual`"));
        assert!(message("linear(residual=dut)").contains("dot, cross"));
        assert!(message("linear(residual)").contains("key=value"));
        assert!(message("linear(residual=dot").contains("key=value"));
        assert!(message("linear+ful").contains("`+full`"));
        assert!(message("+full").contains("unknown"));
    }
}
