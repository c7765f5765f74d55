//! What a row's numbers mean, in sentences.

use catoptric_metrics::paired;

use crate::record::{Record, Status, technique};

use super::html::escape;
use super::number::{count, percent, short};

/// What a row's numbers mean, a sentence each.
pub fn sentences(row: &Record) -> Vec<String> {
    [
        motion(row),
        agreement(row),
        angles(row),
        coverage(row),
        vertices(row),
        cost(row),
        full(row),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn motion(row: &Record) -> Option<String> {
    let motion = row.motion.as_ref()?;
    let (error, length) = (motion.error_px?, motion.true_px?);
    let mut text = format!(
        "Half of its vectors are within {} px of where the reflection was a frame before, 95 % within {} px; \
         the reflections move by {} px in the median",
        short(error.p50),
        short(error.p95),
        short(length.p50)
    );
    if let Some(missing) = motion.missing.filter(|missing| *missing > 0.0) {
        text += &format!("; {} of the pixels have no vector", percent(missing));
    }
    Some(text + ". Its picture is the control's.")
}

fn agreement(row: &Record) -> Option<String> {
    let pixels = row.coverage.as_ref()?.mirror_pixels;
    let Some(agreement) = row.object_agreement else {
        return Some("No mirror pixel is in view, so there is nothing to compare.".to_owned());
    };
    let mut text = format!(
        "The right object is shown on {} of {} mirror pixels",
        percent(agreement),
        count(pixels)
    );
    if let Some(mismatch) = row
        .mismatch
        .filter(|mismatch| mismatch.boundary + mismatch.interior > 0.0)
    {
        let boundary = mismatch.boundary / (mismatch.boundary + mismatch.interior);
        text += &match boundary {
            0.5.. => format!(
                "; {} of the others lie at the outline of a reflected object, where half a pixel decides",
                percent(boundary)
            ),
            _ => format!(
                "; {} of the others lie inside the outlines, where whole pieces are missing or wrong",
                percent(1.0 - boundary)
            ),
        };
    }
    Some(text + ".")
}

fn angles(row: &Record) -> Option<String> {
    let angle = row.angular_error_deg?;
    Some(format!(
        "Where it is the right object, half of the pixels show a point within {}° of the true one, \
         99 % within {}°; the worst is {}° off.",
        short(angle.p50),
        short(angle.p99),
        short(angle.max)
    ))
}

fn coverage(row: &Record) -> Option<String> {
    let coverage = row.coverage.as_ref()?;
    let hidden = row
        .vertices
        .as_ref()
        .is_some_and(|vertices| vertices.hidden > Some(0));
    let drops = hidden
        && row.triangles.is_some()
        && !technique::properties(&row.technique).continues_hidden;
    let mut parts = Vec::new();
    if let Some(missing) = coverage.missing.filter(|share| *share > 0.0) {
        let reason = match drops {
            true => "; triangles with a hidden corner are dropped, which is a part of it",
            false => "",
        };
        parts.push(format!(
            "{} of the mirror pixels miss a reflection that is there{reason}",
            percent(missing)
        ));
    }
    if let Some(extra) = coverage.extra.filter(|share| *share > 0.0) {
        parts.push(format!(
            "{} show an object where there is only background",
            percent(extra)
        ));
    }
    if let Some(cracks) = coverage.cracks.filter(|cracks| *cracks > 0) {
        let plural = if cracks == 1 {
            "crack opens"
        } else {
            "cracks open"
        };
        parts.push(format!(
            "{} {plural} between neighbouring triangles",
            count(cracks)
        ));
    }
    if let Some(unresolved) = coverage.unresolved.filter(|share| *share > 0.0) {
        parts.push(format!("{} have no answer", percent(unresolved)));
    }
    (!parts.is_empty()).then(|| capitalized(&parts.join("; ")) + ".")
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

fn vertices(row: &Record) -> Option<String> {
    let vertices = row.vertices.as_ref()?;
    let mut text = format!("{} searches were run", count(vertices.searched));
    let Some(reflected) = vertices.reflected else {
        return Some(text + "; where the reflections truly are is not known for a mesh.");
    };
    text += &format!(
        ", and {} of the scene's vertices truly have a reflection in view",
        count(reflected)
    );
    match vertices.offset_px {
        Some(offset) => {
            text += &format!(
                "; the search ends {} px from it on average ({} px at the worst)",
                short(offset.mean),
                short(offset.max)
            );
            text += if offset.mean < 0.45 {
                ", which is as near as whole pixels get (0.38 px if the point falls anywhere in its pixel)"
            } else {
                ", where choosing the nearest whole pixel would give 0.38 px"
            };
            let far = vertices.offset_share.map_or(0.0, |share| share.over_5);
            if far > 0.01 {
                text += &format!(". For {} of them it is more than 5 px", percent(far));
                if technique::properties(&row.technique).walks {
                    text += "; a walk from texel to texel can end beside the best one, where no neighbour is better";
                }
            }
        }
        None if reflected > 0 => text += ", none of which was found",
        None => {}
    }
    if let Some(failed) = vertices.failed.filter(|failed| *failed > 0) {
        text += &format!("; for {} of them it reports failure", count(failed));
    }
    Some(text + ".")
}

fn cost(row: &Record) -> Option<String> {
    let times = row.time_ms.as_ref()?;
    let work = row.work.and_then(|work| match row.vertices {
        Some(_) => Some(("search looks at {} texels", work.total?)),
        None => Some(("mirror pixel takes {} evaluations", work.evaluations?)),
    });
    let work = work.map_or_else(String::new, |(one, count)| {
        let one = one.replace("{}", &short(count));
        format!(" Each {one} on average.")
    });
    let Some(frame) = times.frame else {
        return Some(format!(
            "A frame takes {} ms by the wall clock.{work}",
            short(times.wall.median)
        ));
    };
    let mut text = format!(
        "A frame takes {} ms (median of {}, ± {} MAD)",
        short(frame.median),
        frame.samples,
        short(frame.mad)
    );
    let longest = times
        .passes
        .as_ref()
        .and_then(|passes| passes.iter().max_by(|a, b| a.1.total_cmp(&b.1)));
    let passes = times.passes.iter().flatten();
    let total: f64 = passes.map(|(_, time)| time).sum();
    if let (Some((name, time)), true) = (longest, total > 0.0) {
        let share = percent(time / total);
        text += &format!(", {share} of it in the pass <i>{}</i>", escape(name));
    }
    Some(format!("{text}.{work}"))
}

fn full(row: &Record) -> Option<String> {
    let (first, full) = (
        row.object_agreement?,
        row.against_full.as_ref()?.object_agreement?,
    );
    // Less is a difference in how a handful of pixels round.
    ((first - full).abs() > 1e-4).then(|| {
        format!(
            "Judged by a truth in which mirrors see mirrors, agreement is {} instead of {}: \
             the price of assuming that they do not.",
            percent(full),
            percent(first)
        )
    })
}

/// Whether the times of two techniques, taken in turn on one scene, differ.
pub fn time_difference(a: &Record, b: &Record) -> Option<String> {
    let (first, second) = (a.raw.as_ref()?, b.raw.as_ref()?);
    let clock = !first.frame_ms.is_empty() && !second.frame_ms.is_empty();
    let (first, second) = if clock {
        (&first.frame_ms, &second.frame_ms)
    } else {
        (&first.wall_ms, &second.wall_ms)
    };
    let (a, b) = (&a.technique, &b.technique);
    let Some(difference) = paired(first, second) else {
        let samples = first.len().min(second.len());
        return Some(format!(
            "{samples} frames of each are too few to say whether {a} or {b} is faster."
        ));
    };
    Some(if difference.significant {
        let (word, low, high) = match difference.median > 0.0 {
            true => ("slower", difference.low, difference.high),
            false => ("faster", -difference.high, -difference.low),
        };
        format!(
            "{b} is {} ms {word} than {a} (95 % interval of the paired median: {} to {} ms).",
            short(difference.median.abs()),
            short(low),
            short(high)
        )
    } else {
        format!(
            "No difference in time between {b} and {a} is shown: the paired interval includes zero."
        )
    })
}

/// The control's own error: a smaller difference between a technique and the truth says nothing.
/// `None` where the control was not measured.
pub fn noise_floor(rows: &[Record]) -> Option<String> {
    let is_control = |row: &&Record| technique::properties(&row.technique).is_control;
    let control = || rows.iter().filter(is_control);
    let agreement = control().filter_map(|row| row.object_agreement);
    let agreement = agreement.reduce(f64::min)?;
    let angle = control().filter_map(|row| Some(row.angular_error_deg?.p99));
    let angle = angle.reduce(f64::max).map_or_else(String::new, |angle| {
        format!(
            " and 99 % of its points lie within {}° of the true ones",
            short(angle)
        )
    });
    let share = match agreement {
        1.0 => "every mirror pixel of every scene".to_owned(),
        least => format!(
            "at least {} of the mirror pixels of a scene",
            percent(least)
        ),
    };
    Some(format!(
        "The control, the reference's rays traced on the graphics adapter, shows the right object on {share}{angle}: \
         differences below that are the measurement's own noise."
    ))
}

/// The page's first paragraph: how good each technique is over all scenes.
pub fn lead(rows: &[Record], techniques: &[String]) -> Vec<String> {
    techniques
        .iter()
        .filter(|technique| {
            // The picture of what says how reflections moved is the control's.
            let known = technique::properties(technique);
            !known.is_control && !known.estimates_motion
        })
        .filter_map(|technique| {
            let mut found: Vec<(f64, &str)> = rows
                .iter()
                .filter(|row| row.technique == *technique && row.status == Status::Ok)
                .filter_map(|row| Some((row.object_agreement?, row.scene.as_str())))
                .collect();
            found.sort_by(|a, b| a.0.total_cmp(&b.0));
            let ((low, worst), (high, best)) = (found.first()?, found.last()?);
            Some(if found.len() == 1 {
                let measured = rows.iter().filter(|row| row.technique == *technique);
                let alone = match measured.count() {
                    1 => "",
                    _ => ", the only scene here that it can draw",
                };
                format!(
                    "<b>{}</b> shows the right object on {} of the mirror pixels of <i>{}</i>{alone}.",
                    escape(technique), percent(*low), escape(worst)
                )
            } else if percent(*low) == percent(*high) {
                format!(
                    "<b>{}</b> shows the right object on {} of the mirror pixels of each of {} scenes.",
                    escape(technique), percent(*low), found.len()
                )
            } else {
                format!(
                    "<b>{}</b> shows the right object on {} (<i>{}</i>) to {} (<i>{}</i>) of the mirror pixels.",
                    escape(technique), percent(*low), escape(worst), percent(*high), escape(best)
                )
            })
        })
        .collect()
}
