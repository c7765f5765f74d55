//! What every command is told: picture size, models, adapter, and how the result is written.

use std::path::PathBuf;

use clap::builder::{OsStringValueParser, TypedValueParser};
use clap::{Args, ValueEnum};

/// Options that every command understands.
#[derive(Clone, Debug, Args)]
pub struct Common {
    /// Picture size; default: the scene's own
    #[arg(long, global = true, value_name = "WxH", value_parser = resolution)]
    pub resolution: Option<[u32; 2]>,
    /// Folder of models that scenes name but do not bring along
    #[arg(long, global = true, value_name = "DIR", env = "CATOPTRIC_MODELS",
          value_parser = OsStringValueParser::new().map(PathBuf::from))]
    pub models: Option<PathBuf>,
    /// Graphics adapter, by a part of its name (`list adapters`)
    #[arg(long, global = true, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Mirror bounces that the truth `full` follows
    #[arg(long, global = true, value_name = "N", default_value_t = BOUNCES, value_parser = bounces)]
    pub bounces: u32,
    /// How the result is written
    #[arg(long, global = true, value_enum, default_value_t)]
    pub format: Format,
    /// File or folder to write; where it is a table or record, .json, .csv and .md say how
    #[arg(short, long, global = true, value_name = "PATH")]
    pub output: Option<PathBuf>,
    /// No progress and no remarks on stderr
    #[arg(long, global = true)]
    pub quiet: bool,
}

/// Mirror bounces of the truth `full` if nothing else is said.
const BOUNCES: u32 = 8;

impl Default for Common {
    fn default() -> Self {
        Self {
            resolution: None,
            models: None,
            adapter: None,
            bounces: BOUNCES,
            format: Format::default(),
            output: None,
            quiet: false,
        }
    }
}

/// How results are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Aligned columns for people
    #[default]
    Table,
    /// An array with one object a row
    Json,
    /// Comma-separated, one line a row
    Csv,
    /// A Markdown table
    Markdown,
}

/// Truth of the `reference` command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TruthArg {
    /// Reflected rays see everything but mirrors
    #[default]
    FirstBounce,
    /// Mirrors are seen in mirrors, up to --bounces
    Full,
}

/// Parses `640x480`.
fn resolution(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    let parsed = sides.and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]));
    match parsed {
        None => Err("expected WIDTHxHEIGHT in pixels, such as 640x480".to_owned()),
        Some([0, _] | [_, 0]) => Err("a picture needs at least one pixel each way".to_owned()),
        Some(size) => Ok(size),
    }
}

/// The longest time that can be asked for, in seconds: eleven days.
const LONGEST: f64 = 1e6;

/// Parses a positive number of seconds.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value <= LONGEST => Ok(value),
        _ => Err(format!(
            "expected a number of seconds above 0, at most {LONGEST}"
        )),
    }
}

/// Parses a number of mirror bounces.
fn bounces(text: &str) -> Result<u32, String> {
    let expected = || format!("expected a whole number from 0 to {MOST_BOUNCES}");
    let parsed = text.parse().ok();
    parsed
        .filter(|count| *count <= MOST_BOUNCES)
        .ok_or_else(expected)
}

/// Parses samples a pixel: rays in a regular grid.
pub fn samples(text: &str) -> Result<u32, String> {
    let side = |count: u32| count.isqrt();
    match text.parse() {
        Ok(count) if (1..=MOST_SAMPLES).contains(&count) && side(count).pow(2) == count => {
            Ok(count)
        }
        Ok(count) if (1..=MOST_SAMPLES).contains(&count) => Err(format!(
            "{count} samples are no regular grid in a pixel: give a square number, such as {}",
            (side(count) + 1).pow(2)
        )),
        _ => Err(format!(
            "expected a square number from 1 to {MOST_SAMPLES}, such as 16"
        )),
    }
}

/// The most samples a pixel.
pub const MOST_SAMPLES: u32 = 4096;
/// The most mirror bounces: what more of them add cannot be seen.
pub const MOST_BOUNCES: u32 = 1000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_within_what_can_be_done() {
        assert_eq!(seconds("0.5"), Ok(0.5));
        for bad in ["0", "-1", "x", "nan", "inf", "2e19", "1e300"] {
            assert!(seconds(bad).is_err(), "{bad}");
        }
        assert_eq!((bounces("0"), bounces("1000")), (Ok(0), Ok(1000)));
        assert!(bounces("4294967295").is_err() && bounces("-1").is_err());
        assert_eq!((samples("1"), samples("4096")), (Ok(1), Ok(4096)));
        assert!(samples("5").is_err_and(|message| message.contains("such as 9")));
        for bad in ["0", "4097", "x", "4294836225"] {
            assert!(samples(bad).is_err_and(|message| message.contains("square number")));
        }
    }

    #[test]
    fn resolutions() {
        assert_eq!(resolution("640x480"), Ok([640, 480]));
        assert_eq!(resolution("8×4"), Ok([8, 4]));
        for bad in ["0x0", "640", "x", "640x", "-1x3", "1.5x2", ""] {
            assert!(resolution(bad).is_err(), "{bad}");
        }
    }
}
