//! Axes: where a value stands on the drawing, and which ticks help to read it.

use crate::show::number::count;

/// How values are laid out along an axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// Equal steps; reaches down to 0 where no value is negative.
    Linear,
    /// Equal steps around the values alone, for small differences of large values.
    Close,
    /// Equal ratios; values that are not positive are left out.
    Log,
    /// The names of 0, 1, 2, …
    Names(Vec<String>),
}

/// One axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is shown, with its unit.
    pub label: String,
    /// How.
    pub scale: Scale,
}

/// The part of an axis that is drawn. Places are the values themselves, or their decimal
/// logarithms on a logarithmic scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// Lowest and highest place.
    pub range: [f64; 2],
    /// Places with a label and a line.
    pub bold: Vec<f64>,
    /// Places with a faint line.
    pub light: Vec<f64>,
}

impl Extent {
    /// How far along the axis a place is, 0 to 1.
    pub fn share(&self, place: f64) -> f64 {
        let [low, high] = self.range;
        (place - low) / (high - low)
    }
}

/// Width of a digit, about.
const CHARACTER: f64 = 9.0;

/// Labelled ticks at most, about.
const TICKS: f64 = 7.0;

impl Axis {
    /// An axis of equal steps.
    pub fn linear(label: impl Into<String>) -> Self {
        let label = label.into();
        Self {
            label,
            scale: Scale::Linear,
        }
    }

    /// An axis of equal ratios.
    pub fn log(label: impl Into<String>) -> Self {
        let label = label.into();
        Self {
            label,
            scale: Scale::Log,
        }
    }

    /// An axis of names, at 0, 1, 2, …
    pub fn names<'n>(label: &str, names: impl IntoIterator<Item = &'n str>) -> Self {
        Self {
            label: label.to_owned(),
            scale: Scale::Names(names.into_iter().map(str::to_owned).collect()),
        }
    }

    /// Where a value stands; `None` where it cannot be shown.
    pub fn place(&self, value: f64) -> Option<f64> {
        let place = match self.scale {
            Scale::Log if value > 0.0 => value.log10(),
            Scale::Log => return None,
            Scale::Linear | Scale::Close | Scale::Names(_) => value,
        };
        place.is_finite().then_some(place)
    }

    /// The part to draw for these places; `None` where there is none.
    pub fn extent(&self, places: impl Iterator<Item = f64> + Clone) -> Option<Extent> {
        let low = places.clone().reduce(f64::min)?;
        let high = places.reduce(f64::max)?;
        Some(match &self.scale {
            Scale::Names(names) => Extent {
                range: [-0.5, names.len().max(1) as f64 - 0.5],
                bold: (0..names.len()).map(|name| name as f64).collect(),
                light: Vec::new(),
            },
            Scale::Linear => linear(low.min(0.0), high, 0.0),
            Scale::Close => linear(low, high, 0.05),
            Scale::Log => log(low, high),
        })
    }

    /// Labels of ticks that do not run into one another: where each stands, and its text. Decades have
    /// priority over what is between them.
    pub fn apart(&self, places: &[f64], at: impl Fn(f64) -> f64) -> Vec<(f64, String)> {
        let between =
            |place: &f64| self.scale == Scale::Log && (place - place.round()).abs() > 1e-9;
        let (later, first): (Vec<f64>, Vec<f64>) = places.iter().copied().partition(between);
        let mut chosen: Vec<(f64, String)> = Vec::new();
        for place in first.into_iter().chain(later) {
            let (x, text) = (at(place), self.tick(place));
            let half = |text: &str| 0.5 * CHARACTER * (text.chars().count() + 1) as f64;
            let clear =
                |(other, said): &(f64, String)| (x - other).abs() >= half(&text) + half(said);
            if chosen.iter().all(clear) {
                chosen.push((x, text));
            }
        }
        chosen
    }

    /// Whether numbers stand at its ticks.
    pub fn is_labelled(&self) -> bool {
        !matches!(self.scale, Scale::Names(_))
    }

    /// The label of a tick.
    pub fn tick(&self, place: f64) -> String {
        match &self.scale {
            Scale::Names(names) => {
                let name = names.get(place.round() as usize);
                name.cloned().unwrap_or_default()
            }
            Scale::Linear => number(place),
            // Ticks are round numbers: what is cut off here are their rounding errors.
            Scale::Close => trimmed(&format!("{place:.6}")).to_owned(),
            Scale::Log => number(10f64.powf(place)),
        }
    }
}

/// From `low`, and `below` of the span under it, to a little over `high`.
fn linear(low: f64, high: f64, below: f64) -> Extent {
    let span = if high > low { high - low } else { 1.0 };
    let rough = span / TICKS;
    let magnitude = 10f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * magnitude);
    let step = steps
        .into_iter()
        .find(|step| *step >= rough)
        .unwrap_or(steps[3]);
    let high = low + span * 1.05;
    let low = low - span * below;
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    Extent {
        range: [low, high],
        bold: (first..=last).map(|tick| tick as f64 * step).collect(),
        light: Vec::new(),
    }
}

fn log(low: f64, high: f64) -> Extent {
    let pad = (0.05 * (high - low)).max(0.08);
    let range = [low - pad, high + pad];
    let span = range[1] - range[0];
    let digits: &[f64] = if span > 3.0 {
        &[1.0]
    } else if span > 1.2 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0]
    };
    let every = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
    let light: &[f64] = if span > 6.0 { &[] } else { &every };
    let within = |digits: &[f64]| {
        let decades = range[0].floor() as i32..=range[1].ceil() as i32;
        let ticks = decades.flat_map(|decade| {
            let ticks = digits.iter();
            ticks.map(move |digit| f64::from(decade) + digit.log10())
        });
        ticks
            .filter(|tick| (range[0]..=range[1]).contains(tick))
            .collect()
    };
    Extent {
        range,
        bold: within(digits),
        light: within(light),
    }
}

/// A number on an axis: thousands apart, no trailing zeros.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-4.0..7.0).contains(&magnitude) {
        return format!("{value:.0e}");
    }
    let decimals = (1.0 - magnitude).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        return trimmed(&text).to_owned();
    }
    match text.parse::<u64>() {
        Ok(whole) => count(whole),
        Err(_) => text,
    }
}

/// A number with a decimal point, without the zeros at its end.
fn trimmed(text: &str) -> &str {
    text.trim_end_matches('0').trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_read_as_one_says_them() {
        let cases = [
            (0.0, "0"),
            (0.001, "0.001"),
            (0.25, "0.25"),
            (1.0, "1"),
            (1.5, "1.5"),
            (20.0, "20"),
            (100_000.0, "100\u{202f}000"),
            (1e-7, "1e-7"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn a_logarithmic_axis_has_its_decades() {
        let axis = Axis::log("n");
        let places = [100.0, 100_000.0].map(|value| axis.place(value).unwrap());
        let extent = axis.extent(places.into_iter()).unwrap();
        assert_eq!(extent.bold, [2.0, 3.0, 4.0, 5.0]);
        assert_eq!(axis.place(0.0), None);
    }

    #[test]
    fn labels_do_not_run_into_one_another() {
        let axis = Axis::log("n");
        let places =
            [2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6].map(|value| axis.place(value).unwrap());
        let said = |wide: f64| -> Vec<String> {
            let mut labels = axis.apart(&places, |place| wide * (place - 3.0));
            labels.sort_by(|a, b| a.0.total_cmp(&b.0));
            labels
                .into_iter()
                .map(|(_, text)| text.replace('\u{202f}', ""))
                .collect()
        };
        assert_eq!(said(1000.0).len(), places.len());
        assert_eq!(said(150.0), ["2000", "10000", "100000", "1000000"]);
    }

    #[test]
    fn a_linear_axis_starts_at_nothing() {
        let extent = Axis::linear("n").extent([3.0, 9.0].into_iter()).unwrap();
        assert_eq!(extent.range[0], 0.0);
        assert_eq!(extent.bold, [0.0, 2.0, 4.0, 6.0, 8.0]);
    }

    #[test]
    fn a_close_axis_shows_small_differences() {
        let axis = Axis {
            label: String::new(),
            scale: Scale::Close,
        };
        let extent = axis.extent([0.965, 0.978].into_iter()).unwrap();
        let labels: Vec<_> = extent.bold.iter().map(|place| axis.tick(*place)).collect();
        assert_eq!(labels[..3], ["0.966", "0.968", "0.97"]);
        assert!(extent.range[0] < 0.965 && extent.range[1] > 0.978);
    }

    #[test]
    fn one_value_is_enough() {
        for axis in [Axis::linear(""), Axis::log("")] {
            let extent = axis.extent([1.0].into_iter()).unwrap();
            assert!(extent.range[0] < extent.range[1] && !extent.bold.is_empty());
            assert_eq!(axis.extent(std::iter::empty()), None);
        }
    }
}
