//! Options of techniques. A technique declares its options once, by [`options!`], as a struct with
//! documented fields. The technique reads the struct; a table made from the same lines serves to
//! parse names and to list the options.

/// One option of a technique.
#[derive(Clone, Copy, Debug)]
pub struct OptionInfo {
    /// Key.
    pub name: &'static str,
    /// What it may be; the default first.
    pub values: Values,
    /// A sentence.
    pub what: &'static str,
}

/// What an option may be.
#[derive(Clone, Copy, Debug)]
pub enum Values {
    /// One of these, by default the first.
    Words(&'static [&'static str]),
    /// A whole number.
    Whole {
        /// Where it is not given.
        default: u32,
        /// Least and greatest.
        range: [u32; 2],
    },
    /// A number.
    Number {
        /// Where it is not given.
        default: f64,
        /// Least and greatest.
        range: [f64; 2],
    },
}

/// A value that an option takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value {
    /// The index of a word.
    Word(usize),
    /// A whole number.
    Whole(u32),
    /// A number.
    Number(f64),
}

impl OptionInfo {
    /// The value where none is given.
    pub fn default(&self) -> String {
        self.text(self.default_value())
    }

    /// What it may be, in words.
    pub fn allowed(&self) -> String {
        match self.values {
            Values::Words(words) => words.join(", "),
            Values::Whole { range, .. } => format!("a whole number, {} to {}", range[0], range[1]),
            Values::Number { range, .. } => format!("a number, {} to {}", range[0], range[1]),
        }
    }

    /// The value where none is given.
    pub(crate) fn default_value(&self) -> Value {
        match self.values {
            Values::Words(_) => Value::Word(0),
            Values::Whole { default, .. } => Value::Whole(default),
            Values::Number { default, .. } => Value::Number(default),
        }
    }

    /// The value that `text` stands for; `None` if the option does not take it.
    pub(crate) fn settle(&self, text: &str) -> Option<Value> {
        match self.values {
            Values::Words(words) => words.iter().position(|word| *word == text).map(Value::Word),
            Values::Whole { range, .. } => {
                let number: u32 = text.parse().ok()?;
                let within = (range[0]..=range[1]).contains(&number);
                within.then_some(Value::Whole(number))
            }
            Values::Number { range, .. } => {
                let number: f64 = text.parse().ok()?;
                let within = (range[0]..=range[1]).contains(&number);
                // Not minus zero.
                within.then_some(Value::Number(number + 0.0))
            }
        }
    }

    /// The usual spelling of one of its values.
    pub(crate) fn text(&self, value: Value) -> String {
        match (value, self.values) {
            (Value::Word(index), Values::Words(words)) => words[index].to_owned(),
            (Value::Whole(number), _) => number.to_string(),
            (Value::Number(number), _) => number.to_string(),
            (Value::Word(_), _) => unreachable!("{} has no words", self.name),
        }
    }
}

/// The values of all options of a technique, in the order in which they are declared, each read once.
pub(crate) type Settled<'a> = std::iter::Copied<std::slice::Iter<'a, Value>>;

/// Options as a technique reads them; made by [`options!`].
pub(crate) trait Options: Sized {
    /// The options declared here.
    const OWN: &'static [OptionInfo];
    /// Those, and then those of each group that is embedded.
    const TABLE: &'static [&'static [OptionInfo]];

    /// Takes as many values as there are options.
    fn read(values: &mut Settled<'_>) -> Self;
}

/// A type that a single option's value is read as.
pub(crate) trait Field {
    /// # Panics
    /// On a value of another kind: a bug.
    fn read(value: Option<Value>) -> Self;
}

impl Field for u32 {
    fn read(value: Option<Value>) -> Self {
        match value {
            Some(Value::Whole(number)) => number,
            other => unreachable!("{other:?} is no whole number"),
        }
    }
}

impl Field for f64 {
    fn read(value: Option<Value>) -> Self {
        match value {
            Some(Value::Number(number)) => number,
            other => unreachable!("{other:?} is no number"),
        }
    }
}

/// A set of words that an option may be; made by [`words!`].
pub(crate) trait Words: Sized + Copy + 'static {
    /// The words, the default first.
    const WORDS: &'static [&'static str];
    /// What they stand for, in the same order.
    const ALL: &'static [Self];

    /// The word that stands for it.
    fn word(self) -> &'static str;
}

impl<T: Words> Field for T {
    fn read(value: Option<Value>) -> Self {
        match value {
            Some(Value::Word(index)) => T::ALL[index],
            other => unreachable!("{other:?} is no word"),
        }
    }
}

/// Declares what an option may be by words, the default first:
///
/// ```text
/// words! {
///     /// How the error is measured.
///     pub(crate) enum Residual {
///         Dot = "dot",
///         Cross = "cross",
///     }
/// }
/// ```
macro_rules! words {
    (
        $(#[$meta:meta])*
        $vis:vis enum $name:ident {
            $($(#[$variant_meta:meta])* $variant:ident = $word:literal,)+
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $vis enum $name {
            $($(#[$variant_meta])* $variant,)+
        }

        impl $crate::options::Words for $name {
            const WORDS: &'static [&'static str] = &[$($word),+];
            const ALL: &'static [Self] = &[$(Self::$variant),+];

            fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }
        }
    };
}

/// Declares the options of a technique: a type made by [`words!`], or a number with default and
/// range; then groups that it shares with others. The comment of a field is the sentence that is
/// listed.
///
/// ```text
/// options! {
///     /// Linear screen-space search.
///     pub(crate) struct Linear {
///         /// the measure of a texel's fitness
///         residual: Residual,
///         /// most steps of a search
///         iterations: u32 = 9 in 1..=256,
///         /// length of the first step
///         step: f64 = 0.5 in 0.05..=4.0,
///         ..maps: MapOptions,
///     }
/// }
/// ```
macro_rules! options {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $(
                $(#[doc = $what:literal])+
                $field:ident: $ty:ident $(= $default:literal in $low:literal..=$high:expr)?,
            )*
            $(..$group:ident: $group_ty:ident,)*
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        $vis struct $name {
            $($(#[doc = $what])+ pub $field: $ty,)*
            $(pub $group: $group_ty,)*
        }

        impl $crate::options::Options for $name {
            const OWN: &'static [$crate::options::OptionInfo] = &[$(
                $crate::options::OptionInfo {
                    name: stringify!($field),
                    values: $crate::options::options!(@values $ty $($default, $low, $high)?),
                    what: concat!($($what),+).trim_ascii(),
                },
            )*];
            const TABLE: &'static [&'static [$crate::options::OptionInfo]] = &[
                Self::OWN,
                $(<$group_ty as $crate::options::Options>::OWN,)*
            ];

            #[allow(unused_variables, reason = "there may be no option")]
            fn read(values: &mut $crate::options::Settled<'_>) -> Self {
                Self {
                    $($field: $crate::options::Field::read(values.next()),)*
                    $($group: $crate::options::Options::read(values),)*
                }
            }
        }
    };
    (@values u32 $default:literal, $low:literal, $high:expr) => {
        $crate::options::Values::Whole { default: $default, range: [$low, $high] }
    };
    (@values f64 $default:literal, $low:literal, $high:expr) => {
        $crate::options::Values::Number { default: $default, range: [$low, $high] }
    };
    (@values $words:ident) => {
        $crate::options::Values::Words(<$words as $crate::options::Words>::WORDS)
    };
}

pub(crate) use {options, words};
