//! What rules read: numbers by series, place and path, each with the interval in which it may lie.

/// Measured or made-up numbers of a figure.
pub trait Numbers {
    /// The labels of all series.
    fn labels(&self) -> Vec<String>;
    /// Where the points of a series stand, from left to right.
    fn places(&self, series: &str) -> Vec<f64>;
    /// The number at a path of the point of a series at a place; `None` where it is not known.
    fn at(&self, series: &str, x: f64, path: &str) -> Option<f64>;
    /// What a place is called.
    fn place_name(&self, x: f64) -> String;
}

/// A number and the interval in which it may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// As measured.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// A number that is exact.
    pub fn exact(value: f64) -> Self {
        Self {
            value,
            low: value,
            high: value,
        }
    }

    fn around(value: f64, radius: f64) -> Self {
        Self {
            value,
            low: value - radius,
            high: value + radius,
        }
    }

    /// The quotient; `None` where the divisor is not positive.
    pub fn over(self, divisor: Self) -> Option<Self> {
        (divisor.value > 0.0).then(|| Self {
            value: self.value / divisor.value,
            low: self.low / divisor.high,
            high: match divisor.low > 0.0 {
                true => self.high / divisor.low,
                false => f64::INFINITY,
            },
        })
    }

    /// The difference.
    pub fn minus(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            low: self.low - other.high,
            high: self.high - other.low,
        }
    }
}

/// How far a number may be off by chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Noise {
    /// Counted: not at all.
    Exact,
    /// By such a share of itself.
    Share(f64),
    /// By so much.
    Plus(f64),
    /// A time: by the recorded interval of its median, and [`CLOCK`] where none is recorded, but never by
    /// less than [`LEAST_CLOCK`].
    Clock,
}

/// A share of a time by which two runs of the same differ on a busy machine.
pub const CLOCK: f64 = 0.1;
/// The least share of a time that can be told.
pub const LEAST_CLOCK: f64 = 0.03;

/// Which number of a record.
#[derive(Clone, Copy, Debug)]
pub enum Term {
    /// The one at a path.
    Path(&'static str),
    /// A sum: the first must be known; where others are not, they are 0.
    Sum(&'static [&'static str]),
    /// A quotient of two; a divisor of 0 has none.
    Quotient(&'static str, &'static str),
    /// A sum over a number.
    Share(&'static [&'static str], &'static str),
}

impl Term {
    /// The number of a point, with its noise.
    pub fn read(self, from: &dyn Numbers, series: &str, x: f64, noise: Noise) -> Option<Interval> {
        let at = |path: &str| from.at(series, x, path);
        let value = match self {
            Self::Path(path) => at(path)?,
            Self::Sum(paths) => sum(paths, &at)?,
            Self::Share(paths, below) => {
                let below = at(below).filter(|below| *below != 0.0)?;
                sum(paths, &at)? / below
            }
            Self::Quotient(above, below) => {
                let below = at(below).filter(|below| *below != 0.0)?;
                at(above)? / below
            }
        };
        Some(match noise {
            Noise::Exact => Interval::exact(value),
            Noise::Share(share) => Interval::around(value, share * value.abs()),
            Noise::Plus(radius) => Interval::around(value, radius),
            Noise::Clock => self.clock(value, &at),
        })
    }

    fn clock(self, value: f64, at: &dyn Fn(&str) -> Option<f64>) -> Interval {
        let ends = match self {
            Self::Path(path) => path.strip_suffix(".median").and_then(|time| {
                let end = |which: &str| at(&format!("{time}.{which}"));
                end("median_low").zip(end("median_high"))
            }),
            Self::Sum(_) | Self::Quotient(..) | Self::Share(..) => None,
        };
        let (low, high) = ends.unwrap_or((value * (1.0 - CLOCK), value * (1.0 + CLOCK)));
        Interval {
            value,
            low: low.min(value * (1.0 - LEAST_CLOCK)),
            high: high.max(value * (1.0 + LEAST_CLOCK)),
        }
    }

    /// Every path that is read.
    pub fn paths(self) -> Vec<&'static str> {
        match self {
            Self::Path(path) => vec![path],
            Self::Sum(paths) => paths.to_vec(),
            Self::Quotient(above, below) => vec![above, below],
            Self::Share(above, below) => [above, &[below]].concat(),
        }
    }
}

/// A sum: the first must be known; where others are not, they are 0.
fn sum(paths: &[&str], at: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
    let (first, others) = paths.split_first()?;
    Some(at(first)? + others.iter().filter_map(|path| at(path)).sum::<f64>())
}

/// Which series.
#[derive(Clone, Copy, Debug)]
pub enum Which {
    /// The one of this label.
    Named(&'static str),
    /// Each one whose label ends so; beside another ending, those with the same beginning belong
    /// together. The empty ending is every series.
    Ending(&'static str),
}

impl Which {
    /// The series, each with the beginning of its label, which tells the cases of a claim apart.
    pub fn of(self, from: &dyn Numbers) -> Vec<(String, String)> {
        match self {
            Self::Named(label) => vec![(label.to_owned(), String::new())],
            Self::Ending(ending) => (from.labels().into_iter())
                .filter_map(|label| {
                    let start = label.strip_suffix(ending)?.to_owned();
                    Some((label, start))
                })
                .collect(),
        }
    }

    /// The series that belongs to a beginning.
    pub fn beside(self, start: &str) -> String {
        match self {
            Self::Named(label) => label.to_owned(),
            Self::Ending(ending) => format!("{start}{ending}"),
        }
    }
}

/// Which points of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// The one that stands there.
    At(f64),
    /// The leftmost that is known.
    First,
    /// The rightmost that is known.
    Last,
    /// The one with the least number.
    Least,
    /// The one with the greatest number.
    Most,
    /// Each, a case of its own.
    Each,
    /// Each that stands to the right of this, a case of its own.
    RightOf(f64),
}

/// Points of series.
#[derive(Clone, Copy, Debug)]
pub struct Pick {
    /// Of which series.
    pub series: Which,
    /// Which ones.
    pub place: Place,
}

/// The point of a series that stands at `x`.
pub const fn at(series: &'static str, x: f64) -> Pick {
    of(Which::Named(series), Place::At(x))
}

/// The last point of a series.
pub const fn last(series: &'static str) -> Pick {
    of(Which::Named(series), Place::Last)
}

/// The first point of a series.
pub const fn first(series: &'static str) -> Pick {
    of(Which::Named(series), Place::First)
}

/// Each point of a series.
pub const fn each(series: &'static str) -> Pick {
    of(Which::Named(series), Place::Each)
}

/// Points of series.
pub const fn of(series: Which, place: Place) -> Pick {
    Pick { series, place }
}

/// Every series.
pub const EVERY: Which = Which::Ending("");

impl Pick {
    /// The numbers of one series: with the place, where that tells cases apart.
    pub fn read(
        self,
        from: &dyn Numbers,
        series: &str,
        term: Term,
        noise: Noise,
    ) -> Vec<(Option<f64>, Interval)> {
        let known = || {
            let places = from.places(series).into_iter();
            places.filter_map(|x| Some((x, term.read(from, series, x, noise)?)))
        };
        let by_value = |a: &(f64, Interval), b: &(f64, Interval)| a.1.value.total_cmp(&b.1.value);
        let one = match self.place {
            Place::At(x) => {
                return (term.read(from, series, x, noise).into_iter())
                    .map(|value| (None, value))
                    .collect();
            }
            Place::Each => return known().map(|(x, value)| (Some(x), value)).collect(),
            Place::RightOf(left) => {
                let right = known().filter(|(x, _)| *x > left);
                return right.map(|(x, value)| (Some(x), value)).collect();
            }
            Place::First => known().next(),
            Place::Last => known().next_back(),
            Place::Least => known().min_by(by_value),
            Place::Most => known().max_by(by_value),
        };
        one.into_iter().map(|(_, value)| (None, value)).collect()
    }
}
