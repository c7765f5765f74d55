//! Technique names: `SEARCH[(options)][+REFINE[(options)]]` or `NAME[(options)]`.

use std::fmt;

use catoptric_scene::suggest;
use thiserror::Error;

use crate::options::{OptionInfo, Settled, Value, Values};
use crate::technique::{Family, Named, Properties, TechniqueInfo};

/// The techniques that a name may be of.
pub(crate) type Table = [&'static TechniqueInfo];

/// A parsed technique name with every option settled. `Display` gives the canonical name: options
/// in the order in which they are listed, those left out that have their default.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    pub(crate) options: Options,
    pub(crate) refinement: Option<Options>,
}

/// A technique with a value for each of its options.
#[derive(Clone, Debug)]
pub struct Options {
    info: &'static TechniqueInfo,
    values: Vec<Value>,
}

/// What is wrong with a technique name.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum SpecError {
    /// No such technique.
    #[error("unknown technique `{name}`{hint}")]
    Technique {
        /// As written.
        name: String,
        /// The nearest name, as a question, or all there are.
        hint: String,
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
        /// The nearest option, as a question, or all there are.
        hint: String,
    },
    /// An option with two values.
    #[error("`{option}` is given twice")]
    Repeated {
        /// Option.
        option: &'static str,
    },
    /// A value the option does not take.
    #[error("`{option}={value}`: {option} is {allowed}")]
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

/// The known name that is likely meant, as a question; else all names.
fn hint(word: &str, known: impl Iterator<Item = &'static str> + Clone) -> String {
    let question = suggest(word, known.clone());
    if question.is_empty() {
        return format!("; known: {}", known.collect::<Vec<_>>().join(", "));
    }
    question
}

fn technique(
    table: &Table,
    name: &str,
    refines: bool,
) -> Result<&'static TechniqueInfo, SpecError> {
    let of = |refines: bool| {
        let is_refinement = |info: &&TechniqueInfo| info.family == Family::Refinement;
        (table.iter().copied()).filter(move |info| is_refinement(info) == refines)
    };
    let found = of(refines).find(|info| info.name == name);
    found.ok_or_else(|| {
        let refinement = format!("+{}", name.trim_start_matches('+'));
        let as_refinement = of(true).any(|info| info.name == refinement);
        SpecError::Technique {
            name: name.to_owned(),
            hint: if !refines && as_refinement {
                format!("; `{refinement}` goes with a search, such as `linear{refinement}`")
            } else {
                hint(name, of(refines).map(|info| info.name))
            },
        }
    })
}

/// Parses the name of a technique of a table.
///
/// # Errors
/// Unknown names, options and values, with the nearest known one; options given twice.
pub(crate) fn parse(table: &Table, text: &str) -> Result<Spec, SpecError> {
    let written: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let (first, refinement) = match written.split_once('+') {
        Some((first, refinement)) => (first, Some(format!("+{refinement}"))),
        None => (written.as_str(), None),
    };
    // A refinement alone is told where it goes.
    let first = if first.is_empty() { &written } else { first };
    let options = Options::parse(table, first, false)?;
    let refinement = refinement.map(|text| Options::parse(table, &text, true));
    if refinement.is_some() && options.info.family != Family::Search {
        return Err(SpecError::Alone {
            name: options.info.name,
        });
    }
    Ok(Spec {
        options,
        refinement: refinement.transpose()?,
    })
}

impl Options {
    /// Parses `NAME` or `NAME(key=value,…)`.
    fn parse(table: &Table, text: &str, refines: bool) -> Result<Self, SpecError> {
        let (name, arguments) = match text.split_once('(') {
            Some((name, rest)) => (
                name,
                rest.strip_suffix(')')
                    .ok_or_else(|| SpecError::Syntax(text.to_owned()))?,
            ),
            None => (text, ""),
        };
        let info = technique(table, name, refines)?;
        let values = info.options().map(OptionInfo::default_value).collect();
        let mut options = Self { info, values };
        let mut seen = Vec::new();
        let given = arguments.split(',').filter(|given| !given.is_empty());
        for argument in given {
            let (key, value) = argument
                .split_once('=')
                .ok_or_else(|| SpecError::Syntax(argument.to_owned()))?;
            let option = options.find(key)?;
            if seen.contains(&option.name) {
                return Err(SpecError::Repeated {
                    option: option.name,
                });
            }
            seen.push(option.name);
            options.set(key, value)?;
        }
        Ok(options)
    }

    /// The option of this name.
    fn find(&self, key: &str) -> Result<&'static OptionInfo, SpecError> {
        let found = self.info.options().find(|option| option.name == key);
        found.ok_or_else(|| SpecError::Option {
            technique: self.info.name,
            option: key.to_owned(),
            hint: hint(key, self.info.options().map(|option| option.name)),
        })
    }

    /// Gives an option another value.
    fn set(&mut self, key: &str, value: &str) -> Result<(), SpecError> {
        let option = self.find(key)?;
        let settled = option.settle(value).ok_or_else(|| SpecError::Value {
            option: option.name,
            value: value.to_owned(),
            allowed: match option.values {
                Values::Words(_) => format!("one of {}", option.allowed()),
                Values::Whole { .. } | Values::Number { .. } => option.allowed(),
            },
        })?;
        for (known, place) in self.info.options().zip(&mut self.values) {
            if known.name == key {
                *place = settled;
            }
        }
        Ok(())
    }

    /// Name of the technique.
    pub fn name(&self) -> &'static str {
        self.info.name
    }

    /// Whether the technique has an option of this name.
    pub fn has(&self, key: &str) -> bool {
        self.info.options().any(|option| option.name == key)
    }

    /// The values, in the order in which the options are declared.
    pub(crate) fn values(&self) -> Settled<'_> {
        self.values.iter().copied()
    }

    /// The options as the technique `T` reads them, and the values of those of its family; `None` if
    /// they are another technique's.
    pub(crate) fn of<T: Named>(&self) -> Option<(T, Settled<'_>)> {
        let mut values = self.values();
        (self.info.name == T::INFO.name).then(|| (T::read(&mut values), values))
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

    /// What the search or technique, with its refinement, is like.
    pub fn properties(&self) -> Properties {
        let of = |options: &Options| (options.info.properties)(&mut options.values());
        let refinement = self.refinement.as_ref().map(of).unwrap_or_default();
        of(&self.options).and(refinement)
    }

    /// The same with another value of an option of the search or technique.
    ///
    /// # Errors
    /// There is no such option, or it does not take the value.
    pub fn with(&self, option: &str, value: &str) -> Result<Self, SpecError> {
        let mut changed = self.clone();
        changed.options.set(option, value)?;
        Ok(changed)
    }

    /// The refinement with its options.
    pub fn refinement(&self) -> Option<&Options> {
        self.refinement.as_ref()
    }
}

impl PartialEq for Options {
    fn eq(&self, other: &Self) -> bool {
        self.info.name == other.info.name && self.values == other.values
    }
}

impl fmt::Display for Options {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.info.name)?;
        let mut separator = "(";
        for (option, value) in self.info.options().zip(self.values()) {
            if value != option.default_value() {
                write!(f, "{separator}{}={}", option.name, option.text(value))?;
                separator = ",";
            }
        }
        f.write_str(if separator == "," { ")" } else { "" })
    }
}

impl fmt::Display for Spec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.options)?;
        match &self.refinement {
            Some(refinement) => write!(f, "{refinement}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::registry::list;
    use crate::search::linear::{Linear, Neighbours};
    use crate::{Family, Spec, SpecError};

    fn parse(text: &str) -> Result<Spec, SpecError> {
        super::parse(&list(), text)
    }

    #[test]
    fn a_technique_has_one_name_however_it_is_written() {
        for (name, spellings) in [
            (
                "linear",
                [
                    "linear()",
                    "linear(residual=dot)",
                    "linear( start = center )",
                ],
            ),
            (
                "linear(neighbours=8,residual=cross)",
                [
                    "linear(residual=cross,neighbours=8)",
                    "linear(residual=cross, neighbours=8)",
                    "linear(start=center,neighbours=8,residual=cross,)",
                ],
            ),
            (
                "ray-hierarchy(cone=2.5)+full(level=2)",
                [
                    "ray-hierarchy(cone=2.50)+full(level=2)",
                    "ray-hierarchy(repair=none,cone=2.5)+full(level=02)",
                    "ray-hierarchy(cone=25e-1)+full(level=2)",
                ],
            ),
            (
                "linear+full",
                ["linear()+full()", "linear+full(level=3)", "linear + full"],
            ),
        ] {
            let spec = parse(name).unwrap();
            assert_eq!(spec.to_string(), name);
            for spelling in spellings {
                let same = parse(spelling).unwrap();
                assert_eq!(
                    (same.to_string().as_str(), &same),
                    (name, &spec),
                    "{spelling}"
                );
            }
        }
        assert_ne!(
            parse("linear").unwrap(),
            parse("linear(residual=cross)").unwrap()
        );
        let spec = parse("linear").unwrap();
        let linear = spec.options().of::<Linear>();
        assert!(linear.is_some_and(|(linear, _)| linear.neighbours == Neighbours::Four));
    }

    #[test]
    fn every_name_that_a_default_gives_is_short() {
        for info in list() {
            let all: Vec<_> = info
                .options()
                .map(|option| format!("{}={}", option.name, option.default()))
                .collect();
            let (before, name) = match info.family {
                Family::Refinement => ("linear", info.name),
                Family::Search | Family::ImageOrder | Family::Motion => ("", info.name),
            };
            let written = format!("{before}{name}({})", all.join(","));
            assert_eq!(
                parse(&written).unwrap().to_string(),
                format!("{before}{name}")
            );
        }
    }

    #[test]
    fn an_option_is_replaced_wherever_it_stood() {
        let with = |text: &str| parse(text).unwrap().with("show", "levels");
        for text in ["linear", "linear()", "linear(show=wireframe)"] {
            assert_eq!(with(text), parse("linear(show=levels)"), "{text}");
        }
        let refined = with("linear(residual=cross)+full(level=2)");
        assert_eq!(
            refined,
            parse("linear(show=levels,residual=cross)+full(level=2)")
        );
        assert!(with("ray-trace").is_err());
    }

    #[test]
    fn mistakes_name_the_nearest() {
        let message = |text: &str| parse(text).unwrap_err().to_string();
        assert!(message("liner").contains("did you mean `linear`?"));
        assert!(message("ray-hier").contains("did you mean `ray-hierarchy`?"));
        assert!(message("linear(residul=cross)").contains("did you mean `residual`?"));
        assert!(message("linear(residual=dut)").contains("is one of dot, cross"));
        assert!(message("linear(residual)").contains("key=value"));
        assert!(message("linear(residual=dot").contains("key=value"));
        assert!(message("linear+ful").contains("did you mean `+full`?"));
        assert!(message("+full(level=2)").contains("such as `linear+full`"));
        assert!(message("full").contains("such as `linear+full`"));
        assert_eq!(
            message("linear(neighbours=4,neighbours=8)"),
            "`neighbours` is given twice"
        );
        assert_eq!(
            message("linear+full(level=99)"),
            "`level=99`: level is a whole number, 0 to 8"
        );
    }

    #[test]
    fn nonsense_gets_the_list() {
        let message = |text: &str| parse(text).unwrap_err().to_string();
        for text in ["bogus", "x", "linear+nothing", "linear(foo=1)"] {
            let message = message(text);
            assert!(!message.contains("did you mean"), "{message}");
            assert!(message.contains("; known: "), "{message}");
        }
    }
}
