//! Load → trace the reference → render → compare → **time** → record: interleaved samples within a
//! budget, and their summary.

use std::time::{Duration, Instant};

use catoptric_metrics::Timing;
use catoptric_reflect::{FrameTime, Prepared, ReflectError, STAGE_PASSES};

use crate::record::Status;

use super::interrupt::interrupted;
use super::render::{Rendered, RowError, one_line};

/// Frames before the first that counts.
const WARM_UP: usize = 2;
/// Never fewer samples, whatever the budget.
const FEWEST: usize = catoptric_metrics::stats::FEWEST_FOR_INTERVAL;
/// Never more samples, whatever the budget.
const MOST: usize = 200;

/// Share of the frame's time by which the sum of its passes may differ from it.
const PASSES_MISS_FRAME: f64 = 0.1;

/// All samples of one technique, in the order in which they were taken.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// One a timed frame.
    pub frames: Vec<FrameTime>,
}

/// Times `techniques` in turn, A B A B …, until the budget is spent: after two warm-up frames
/// each at least 6 and at most 200 samples, no more than 6 once `stop` says so. One result a
/// technique, in order: its samples, or the first error, after which it is left out.
fn interleaved(
    techniques: &mut [&mut Prepared<'_>],
    budget: Duration,
    stop: impl Fn() -> bool,
) -> Vec<Result<Samples, ReflectError>> {
    let mut results: Vec<Result<Samples, ReflectError>> =
        techniques.iter().map(|_| Ok(Samples::default())).collect();
    let start = Instant::now();
    for round in 0..WARM_UP + MOST {
        if round >= WARM_UP + FEWEST && (start.elapsed() >= budget || stop()) {
            break;
        }
        for (technique, result) in techniques.iter_mut().zip(&mut results) {
            let Ok(samples) = result else { continue };
            match technique.time_frame() {
                Ok(time) if round >= WARM_UP => samples.frames.push(time),
                Ok(_) => {}
                Err(error) => *result = Err(error),
            }
        }
    }
    results
}

/// Times the techniques that could be rendered, in turn, within the budget; the result has an
/// entry for each of them, in order.
pub fn time(
    rendered: &mut [Result<Rendered<'_>, RowError>],
    budget: Duration,
) -> Vec<Option<Result<Samples, RowError>>> {
    let places: Vec<bool> = rendered.iter().map(Result::is_ok).collect();
    let mut ready: Vec<&mut Prepared<'_>> = rendered
        .iter_mut()
        .filter_map(|row| row.as_mut().ok())
        .map(|row| &mut row.prepared)
        .collect();
    let mut samples = interleaved(&mut ready, budget, interrupted).into_iter();
    places
        .into_iter()
        .map(|place| place.then(|| samples.next()).flatten())
        .map(|row| row.map(|row| row.map_err(|error| (Status::Failed, one_line(&error)))))
        .collect()
}

impl Samples {
    /// GPU time of the frame; `None` unless every sample has one.
    pub fn gpu(&self) -> Option<Vec<f64>> {
        let times: Option<Vec<f64>> = self.frames.iter().map(|frame| frame.gpu_ms).collect();
        times.filter(|times| !times.is_empty())
    }

    /// Wall time of the frame.
    pub fn wall(&self) -> Vec<f64> {
        self.frames.iter().map(|frame| frame.wall_ms).collect()
    }

    /// Time before each frame to build what it traces; empty where nothing is built.
    pub fn builds(&self) -> Vec<f64> {
        self.frames
            .iter()
            .filter_map(|frame| frame.build_ms)
            .collect()
    }

    /// Time of the technique's own passes, and of what is built before them, of each frame whose passes are known;
    /// empty where fewer than half of them are.
    pub fn own(&self) -> Vec<f64> {
        let of_frame = |frame: &FrameTime| {
            let passes = frame.passes.as_ref()?.iter();
            let own = passes.filter(|(name, _)| !STAGE_PASSES.contains(&name.as_str()));
            let own: f64 = own.map(|(_, time)| time).sum();
            Some(own + frame.build_ms.unwrap_or(0.0))
        };
        let known: Vec<f64> = self.frames.iter().filter_map(of_frame).collect();
        match 2 * known.len() > self.frames.len() {
            true => known,
            false => Vec::new(),
        }
    }

    /// Median time of each pass over the samples that have it, or the most recent reason why
    /// there is none. Passes are only reported if more than half of the samples know theirs, and if
    /// their medians add up to that of the frame.
    pub fn passes(&self) -> Result<Vec<(String, f64)>, String> {
        // A clock that lied once is not asked for parts of what it is not believed in whole.
        let lied = self.frames.iter().find(|frame| frame.gpu_ms.is_none());
        if let Some(reason) = lied.and_then(|frame| frame.passes_reason.clone()) {
            return Err(reason);
        }
        let known: Vec<_> = self
            .frames
            .iter()
            .filter_map(|frame| frame.passes.as_ref())
            .collect();
        if 2 * known.len() <= self.frames.len() {
            let reason = self
                .frames
                .iter()
                .rev()
                .find_map(|frame| frame.passes_reason.clone());
            return Err(reason.unwrap_or_else(|| "no frame was timed".to_owned()));
        }
        let names = known[0].iter().map(|(name, _)| name);
        let passes: Vec<_> = names
            .filter_map(|name| {
                let times = known.iter().filter_map(|passes| {
                    passes
                        .iter()
                        .find(|(other, _)| other == name)
                        .map(|(_, time)| *time)
                });
                Some((name.clone(), Timing::of(&times.collect::<Vec<_>>())?.median))
            })
            .collect();
        let sum: f64 = passes.iter().map(|(_, time)| time).sum();
        let frame = Timing::of(&self.gpu().unwrap_or_default()).map_or(0.0, |frame| frame.median);
        if (sum - frame).abs() > PASSES_MISS_FRAME * frame {
            return Err(format!(
                "the medians of the passes add up to {sum:.2} ms, that of the frame is {frame:.2}"
            ));
        }
        Ok(passes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(gpu_ms: Option<f64>, passes: Option<Vec<(&str, f64)>>) -> FrameTime {
        let reason = passes.is_none().then(|| "no clock".to_owned());
        let passes = passes.map(|passes| {
            passes
                .into_iter()
                .map(|(name, time)| (name.to_owned(), time))
                .collect()
        });
        FrameTime {
            gpu_ms,
            passes,
            passes_reason: reason,
            wall_ms: 1.0,
            build_ms: None,
        }
    }

    #[test]
    fn passes_are_medians_by_name() {
        let frames = [1.0, 2.0, 9.0].map(|time| {
            frame(
                Some(time + 0.5),
                Some(vec![("search", time), ("draw", 0.5)]),
            )
        });
        let samples = Samples {
            frames: frames.to_vec(),
        };
        assert_eq!(
            samples.passes(),
            Ok(vec![("search".to_owned(), 2.0), ("draw".to_owned(), 0.5)])
        );
        assert_eq!(samples.gpu(), Some(vec![1.5, 2.5, 9.5]));
    }

    #[test]
    fn own_time_is_that_of_all_passes_but_the_stages_and_of_what_is_built() {
        let timed = |build_ms| FrameTime {
            build_ms,
            ..frame(
                Some(9.0),
                Some(vec![("gbuffer", 4.0), ("sift", 2.0), ("tiles", 3.0)]),
            )
        };
        let samples = |frames: &[FrameTime]| Samples {
            frames: frames.to_vec(),
        };
        assert_eq!(samples(&[timed(None), timed(Some(1.5))]).own(), [5.0, 6.5]);
        let unknown = || frame(Some(9.0), None);
        assert!(
            samples(&[timed(None), unknown(), unknown()])
                .own()
                .is_empty()
        );
    }

    #[test]
    fn passes_that_do_not_add_up_are_not_reported() {
        let search = |total| frame(Some(total), Some(vec![("search", 1.0)]));
        let frames = |totals: [f64; 3]| Samples {
            frames: totals.map(search).to_vec(),
        };
        assert!(frames([1.0, 1.05, 9.0]).passes().is_ok());
        assert!(frames([1.0, 1.2, 1.2]).passes().is_err());
    }

    #[test]
    fn one_frame_whose_stamps_lie_leaves_no_gpu_time() {
        let samples = Samples {
            frames: vec![
                frame(Some(1.0), Some(vec![("search", 1.0)])),
                frame(Some(1.0), Some(vec![("search", 1.0)])),
                frame(None, None),
            ],
        };
        assert_eq!(
            (samples.gpu(), samples.passes()),
            (None, Err("no clock".to_owned()))
        );
        assert_eq!(samples.wall(), [1.0; 3]);
    }

    #[test]
    fn without_a_clock_there_is_a_reason_and_no_number() {
        let samples = Samples {
            frames: vec![frame(None, None)],
        };
        assert_eq!(samples.passes(), Err("no clock".to_owned()));
        assert_eq!(samples.gpu(), None);
        assert_eq!(Samples::default().gpu(), None);
    }
}
