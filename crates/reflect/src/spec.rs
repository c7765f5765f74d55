//! Technique names: `SEARCH[(options)][+REFINE[(options)]]` or `NAME[(options)]`.

use std::fmt;

use thiserror::Error;

use crate::registry::{TECHNIQUES, TechniqueInfo};

/// A parsed technique name with every option settled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spec {
    name: &'static str,
    /// Every option of the technique with its value.
    options: Vec<(&'static str, &'static str)>,
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

fn technique(name: &str) -> Result<&'static TechniqueInfo, SpecError> {
    let found = TECHNIQUES
        .iter()
        .find(|info| info.name == name)
        .ok_or_else(|| SpecError::Technique {
            name: name.to_owned(),
            hint: nearest(name, TECHNIQUES.iter().map(|info| info.name)),
        })?;
    match found.reason {
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
    let (search, refinement) = match text.split_once('+') {
        Some((search, refinement)) => (search, Some(refinement)),
        None => (text, None),
    };
    if let Some(refinement) = refinement {
        let name = refinement.split('(').next().unwrap_or_default().trim();
        technique(&format!("+{name}"))?;
    }
    let (name, arguments) = match search.trim().split_once('(') {
        Some((name, rest)) => (
            name,
            rest.strip_suffix(')')
                .ok_or_else(|| SpecError::Syntax(text.to_owned()))?,
        ),
        None => (search.trim(), ""),
    };
    let info = technique(name)?;
    let mut options: Vec<_> = info
        .options
        .iter()
        .map(|option| (option.name, option.values[0]))
        .collect();
    for argument in arguments
        .split(',')
        .map(str::trim)
        .filter(|argument| !argument.is_empty())
    {
        let (key, value) = argument
            .split_once('=')
            .ok_or_else(|| SpecError::Syntax(argument.to_owned()))?;
        let index = info
            .options
            .iter()
            .position(|option| option.name == key.trim())
            .ok_or_else(|| SpecError::Option {
                technique: info.name,
                option: key.to_owned(),
                hint: nearest(key, info.options.iter().map(|option| option.name)),
            })?;
        let option = &info.options[index];
        options[index].1 = option
            .values
            .iter()
            .find(|known| **known == value.trim())
            .ok_or_else(|| SpecError::Value {
                option: option.name,
                value: value.to_owned(),
                allowed: option.values.join(", "),
            })?;
    }
    Ok(Spec {
        name: info.name,
        options,
    })
}

impl Spec {
    /// Technique name without options.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Value of an option.
    ///
    /// # Panics
    /// If the technique has no such option: a bug in the caller.
    pub fn option(&self, name: &str) -> &'static str {
        let found = self.options.iter().find(|(key, _)| *key == name);
        found
            .unwrap_or_else(|| panic!("{} has no option {name}", self.name))
            .1
    }
}

impl fmt::Display for Spec {
    /// The name with the options that differ from their defaults.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let defaults = TECHNIQUES
            .iter()
            .find(|info| info.name == self.name)
            .map_or(&[][..], |info| info.options);
        let changed: Vec<_> = self
            .options
            .iter()
            .zip(defaults)
            .filter(|((_, value), option)| *value != option.values[0])
            .map(|((name, value), _)| format!("{name}={value}"))
            .collect();
        if changed.is_empty() {
            write!(f, "{}", self.name)
        } else {
            write!(f, "{}({})", self.name, changed.join(","))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_left_out_and_values_kept() {
        assert_eq!(parse("linear").unwrap().to_string(), "linear");
        assert_eq!(
            parse("linear(start=center, residual=cross)")
                .unwrap()
                .to_string(),
            "linear(residual=cross)"
        );
    }

    #[test]
    fn mistakes_name_the_nearest() {
        let message = |text: &str| parse(text).unwrap_err().to_string();
        assert!(
            message("liner").contains("`linear`"),
            "{}",
            message("liner")
        );
        assert!(message("linear(residul=cross)").contains("`residual`"));
        assert!(message("linear(residual=dut)").contains("dot, cross"));
        assert!(message("linear+full").contains("not available"));
    }
}
