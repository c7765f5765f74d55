//! A part of a suite, for one of several machines.

use std::fmt;
use std::str::FromStr;

use crate::run::Wanted;

/// The `index`-th of so many parts, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    index: u32,
    of: u32,
}

/// Most parts.
const MOST: u32 = 10_000;

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once('/');
        let parsed = sides.and_then(|(index, of)| Some((index.parse().ok()?, of.parse().ok()?)));
        match parsed {
            Some((index, of)) if 1 <= index && index <= of && of <= MOST => Ok(Self { index, of }),
            _ => Err(format!(
                "expected K/N, the K-th of N parts from 1, such as 2/3; N at most {MOST}"
            )),
        }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl Part {
    /// Whether it is the first.
    pub fn is_first(self) -> bool {
        self.index == 1
    }

    /// What of a suite is measured in this part. A scene stays whole, so that its techniques are timed
    /// in turn; scenes stay in their order, so that the parts one after another are the suite.
    pub fn of(self, wanted: Vec<Wanted>) -> Vec<Wanted> {
        let rows: usize = wanted.iter().map(|job| job.techniques.len()).sum();
        let mut before = 0;
        wanted
            .into_iter()
            .filter(|job| {
                // Twice the row in the middle of the scene's, so that it stays whole.
                let middle = 2 * before + job.techniques.len();
                before += job.techniques.len();
                let place = middle as u64 * u64::from(self.of) / (2 * rows as u64).max(1);
                place + 1 == u64::from(self.index)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    fn job(scene: usize, techniques: usize) -> Wanted {
        Wanted {
            scene: scene.to_string(),
            resolution: None,
            techniques: (0..techniques).map(|name| name.to_string()).collect(),
            timing: Duration::ZERO,
            frames: None,
        }
    }

    #[test]
    fn the_parts_one_after_another_are_the_whole() {
        for sizes in [
            vec![7, 6, 6, 6, 6, 5, 8, 7],
            vec![1],
            vec![30, 1, 1],
            vec![],
        ] {
            let jobs: Vec<Wanted> = (0..).zip(&sizes).map(|(at, size)| job(at, *size)).collect();
            for of in 1..=9 {
                let parts = (1..=of).map(|index| Part { index, of }.of(jobs.clone()));
                let joined: Vec<Wanted> = parts.flatten().collect();
                assert_eq!(joined, jobs, "{of} parts of {sizes:?}");
            }
        }
        let jobs: Vec<Wanted> = (0..8).map(|at| job(at, 6)).collect();
        let parts = [1, 2, 3].map(|index| Part { index, of: 3 }.of(jobs.clone()).len());
        assert_eq!(parts, [3, 2, 3]);
    }

    #[test]
    fn a_part_is_written_as_a_fraction() {
        assert_eq!("2/3".parse(), Ok(Part { index: 2, of: 3 }));
        for bad in [
            "0/3", "4/3", "2", "2/", "/3", "a/b", "-1/3", "1/0", "1/99999",
        ] {
            assert!(bad.parse::<Part>().is_err(), "{bad}");
        }
    }
}
