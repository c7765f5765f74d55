//! From figures to what has to be measured: every pair of scene and technique once.

use std::time::Duration;

use crate::record::Record;
use crate::run::Wanted;

use super::figure::Figure;
use super::series::Point;
use super::suite::Budget;

/// All points of all figures without duplicates, by scene and size in order of appearance. If the
/// timing is one sum for all scenes, each scene gets a part in proportion to its number of
/// techniques.
///
/// Only so many techniques are timed in turn. So the first points of all series of a figure come
/// first, then the second ones: the points that a figure compares then see the same drift.
pub fn wanted(figures: &[Figure], timing: Budget) -> Vec<Wanted> {
    let mut jobs: Vec<Wanted> = Vec::new();
    let ranked = figures.iter().flat_map(|figure| {
        let longest = figure.series.iter().map(|series| series.points.len()).max();
        let rank = |rank| {
            figure
                .series
                .iter()
                .filter_map(move |series| series.points.get(rank))
        };
        (0..longest.unwrap_or(0)).flat_map(rank)
    });
    for point in ranked {
        // Figures spell options in any order, and name defaults or not.
        let technique = (point.canonical()).unwrap_or_else(|| point.technique.clone());
        let job = jobs
            .iter_mut()
            .find(|job| job.scene == point.scene && job.resolution == point.resolution);
        match job {
            Some(job) => {
                job.frames = job.frames.max(point.frames);
                if !job.techniques.contains(&technique) {
                    job.techniques.push(technique);
                }
            }
            None => jobs.push(Wanted {
                scene: point.scene.clone(),
                resolution: point.resolution,
                techniques: vec![technique],
                timing: Duration::ZERO,
                frames: point.frames,
            }),
        }
    }
    let rows: usize = jobs.iter().map(|job| job.techniques.len()).sum();
    for job in &mut jobs {
        let share = job.techniques.len() as f64 / rows as f64;
        job.timing = Duration::from_secs_f64(match timing {
            Budget::Whole(seconds) => seconds * share,
            Budget::EachScene(seconds) => seconds,
        });
    }
    jobs
}

/// Whether a row's pictures are asked for.
pub fn shown(figures: &[Figure], row: &Record) -> bool {
    points(figures).any(|point| point.picture && point.is_of(row))
}

fn points(figures: &[Figure]) -> impl Iterator<Item = &Point> {
    let series = figures.iter().flat_map(|figure| &figure.series);
    series.flat_map(|series| &series.points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::show::plot::Axis;
    use crate::suites::series::Series;

    fn figure(points: Vec<Point>) -> Figure {
        Figure {
            anchor: "a",
            title: String::new(),
            after: "",
            question: String::new(),
            axis: Axis::linear("x"),
            series: vec![Series {
                label: String::new(),
                points,
            }],
            quantities: Vec::new(),
            quotes: &[],
            claims: &[],
        }
    }

    #[test]
    fn what_two_figures_share_is_measured_once() {
        let shared = || Point::new(1.0, "bowl", "linear");
        let other = Point::new(2.0, "planar", "linear");
        let large = Point {
            resolution: Some([8, 6]),
            ..shared()
        };
        let jobs = wanted(
            &[figure(vec![shared(), other]), figure(vec![shared(), large])],
            Budget::Whole(30.0),
        );
        let names: Vec<_> = jobs.iter().map(|job| job.scene.as_str()).collect();
        assert_eq!(names, ["bowl", "planar", "bowl"]);
        assert_eq!(jobs[0].techniques, ["linear"]);
        assert_eq!(jobs[0].timing, Duration::from_secs(10));
    }

    #[test]
    fn one_technique_spelled_in_two_ways_is_measured_once() {
        let point = |x: f64, technique: &str| Point::new(x, "bowl", technique);
        let spelled = figure(vec![
            point(0.0, "cubemap-trace(accept=any)"),
            point(1.0, "cubemap-trace(step=0.001,accept=any)"),
        ]);
        let jobs = wanted(&[spelled], Budget::Whole(1.0));
        assert_eq!(jobs[0].techniques, ["cubemap-trace(accept=any)"]);
    }

    #[test]
    fn what_stands_at_one_place_is_measured_one_after_another() {
        let point = |x: f64, technique: &str| Point::new(x, "bowl", technique);
        let mut both = figure(vec![point(0.0, "linear"), point(1.0, "linear+full")]);
        both.series.push(Series {
            label: "other".to_owned(),
            points: vec![
                point(0.0, "planar"),
                point(1.0, "ray-trace"),
                point(2.0, "newton"),
            ],
        });
        let jobs = wanted(&[both], Budget::Whole(1.0));
        let order = ["linear", "planar", "linear+full", "ray-trace", "newton"];
        assert_eq!(jobs[0].techniques, order);
    }
}
