//! The report's plots: error against time, and the distribution of the times.

use crate::record::Record;

use super::number::significant;
use super::plot::{Axis, Curve, Mark, Plot, Scale, TALL};

/// Median angular error against the time of a frame, a point a row; only the first technique's
/// points are named, as those of a scene lie side by side.
pub fn error_against_time(rows: &[Record], techniques: &[String]) -> Plot {
    let point = |row: &Record| {
        let times = row.time_ms.as_ref()?;
        let x = times.frame.map_or(times.wall.median, |frame| frame.median);
        let y = row.angular_error_deg?.p50;
        Some(Mark {
            x,
            y,
            name: if techniques.first() == Some(&row.technique) {
                row.scene.clone()
            } else {
                String::new()
            },
            label: format!(
                "{}, {}: {} ms, {}°",
                row.scene,
                row.technique,
                significant(x),
                significant(y)
            ),
        })
    };
    let series = |technique: &String| Curve {
        label: technique.clone(),
        points: rows
            .iter()
            .filter(|row| row.technique == *technique)
            .filter_map(point)
            .collect(),
    };
    Plot {
        title: "Median angular error against the time of a frame".to_owned(),
        x: Axis::log("time of a frame (ms)"),
        y: Axis::log("median angular error (°)"),
        series: techniques.iter().map(series).collect(),
        height: TALL,
        joined: false,
    }
}

/// Every timing sample of a scene's rows: how steady the times are, and whether they overlap.
pub fn distribution(rows: &[&Record], techniques: &[String]) -> Plot {
    let samples = |technique: &String| {
        let row = rows.iter().find(|row| row.technique == *technique);
        let raw = row.and_then(|row| row.raw.as_ref());
        raw.map_or(&[][..], |raw| match raw.frame_ms.is_empty() {
            true => &raw.wall_ms,
            false => &raw.frame_ms,
        })
    };
    let series = techniques.iter().enumerate().map(|(place, technique)| {
        let level = (techniques.len() - 1 - place) as f64;
        let points = samples(technique).iter().zip(0..).map(|(time, sample)| {
            // Samples step up and down a little, so that equal times are seen apart.
            let aside = [0.0, 0.2, -0.1, 0.1, -0.2][sample % 5];
            Mark {
                x: *time,
                y: level + aside,
                name: String::new(),
                label: format!(
                    "{technique}, sample {}: {} ms",
                    sample + 1,
                    significant(*time)
                ),
            }
        });
        Curve {
            label: technique.clone(),
            points: points.collect(),
        }
    });
    let series: Vec<Curve> = series.collect();
    Plot {
        title: "Every timing sample".to_owned(),
        x: Axis::linear("time of a frame (ms), every sample"),
        y: Axis {
            label: String::new(),
            scale: Scale::Names(vec![String::new(); series.len()]),
        },
        height: 76 + 30 * series.len() as u32,
        series,
        joined: false,
    }
}
