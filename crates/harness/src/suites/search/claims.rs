//! What came out, and whether the thesis' claims hold here, by time and by counted work.

use crate::show::number::{count, percent, short};
use crate::suites::paths::{
    EVALUATIONS, FRAME_MS, JITTER_MAX, JITTER_MEAN, JUMPS, MEAN_PX, MOVING_MS, NODE_TESTS, P95_PX,
    STEPS, STILL_MS,
};
use crate::suites::results::Results;
use crate::suites::results::{line, power};

use super::data::{CASES, ENLARGED, LINEAR, RAW, SEARCHES, STOPPED, WARM};

/// A ratio from here to its inverse counts as about equal.
const ABOUT_EQUAL: f64 = 1.25;

/// Frame-time ratios of Fig. 4.3, hierarchy to linear: place on the axis, series, ratio.
const PRINTED: [(f64, &str, f64); 6] = [
    (0.0, ENLARGED, 600.0 / 90.0),
    (1.0, ENLARGED, 45.0 / 8.0),
    (2.0, ENLARGED, 95.0 / 20.0),
    (2.0, RAW, 80.0 / 20.0),
    (3.0, ENLARGED, 20.0 / 6.0),
    (3.0, STOPPED, 12.0 / 6.0),
];

/// Node tests and evaluations of a series: what one search looks at.
fn work(results: &Results<'_>, series: &str) -> Vec<(f64, f64)> {
    let tests = results.curve(series, NODE_TESTS);
    let tested = |x: f64| tests.iter().find(|(place, _)| *place == x);
    let evaluations = results.curve(series, EVALUATIONS).into_iter();
    evaluations
        .map(|(x, evaluations)| (x, evaluations + tested(x).map_or(0.0, |(_, tests)| *tests)))
        .collect()
}

/// Milliseconds of all that depends on the search: start or pyramid, search, and the drawing of its
/// answers. On some adapters a compute pass ends in the time of the raster pass after it, so that
/// the search alone would be too little.
fn own_passes(results: &Results<'_>, series: &str) -> Vec<(f64, f64)> {
    let pass = |name: &str| results.curve(series, &format!("time_ms.passes.{name}"));
    let others = ["start", "hierarchy", "virtual"].map(pass);
    let total = |(x, search): (f64, f64)| {
        let others = others.iter().filter_map(|curve| at(curve, x));
        (x, search + others.sum::<f64>())
    };
    pass("search").into_iter().map(total).collect()
}

fn own_ratios(results: &Results<'_>, one: &str, other: &str) -> Vec<(f64, f64)> {
    ratios(&own_passes(results, one), &own_passes(results, other))
}

fn ratios(one: &[(f64, f64)], other: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let at = |x: f64| {
        other
            .iter()
            .find(|(place, value)| *place == x && *value > 0.0)
    };
    let ratio = |(x, value): &(f64, f64)| Some((*x, value / at(*x)?.1));
    one.iter().filter_map(ratio).collect()
}

fn at(curve: &[(f64, f64)], x: f64) -> Option<f64> {
    curve
        .iter()
        .find(|(place, _)| *place == x)
        .map(|(_, value)| *value)
}

/// `3.1 times`, `0.4 times`.
fn times(ratio: f64) -> String {
    format!("{} times", short(ratio))
}

/// `0.4 to 3.1 times`.
fn range(least: f64, most: f64) -> String {
    match short(least) == short(most) {
        true => times(most),
        false => format!("{} to {}", short(least), times(most)),
    }
}

/// One series beside the linear search at one place.
fn beside_linear(
    results: &Results<'_>,
    series: &str,
    x: f64,
    printed: Option<f64>,
) -> Option<String> {
    let frame = at(&results.ratios(series, LINEAR, FRAME_MS), x)?;
    let own = at(&own_ratios(results, series, LINEAR), x);
    let counted = at(&ratios(&work(results, series), &work(results, LINEAR)), x);
    let optional = |value: Option<f64>, text: &dyn Fn(String) -> String| {
        value.map_or_else(String::new, |value| text(times(value)))
    };
    Some(format!(
        "“{series}” takes {} the frame time of “{LINEAR}”{}{}{}.",
        times(frame),
        optional(printed, &|ratio| format!(" where the thesis has {ratio}")),
        optional(own, &|ratio| format!(
            "; its own passes (building, search, drawing) take {ratio} as long"
        )),
        optional(counted, &|ratio| format!(
            "; it looks at {ratio} as many texels (node tests and evaluations)"
        ))
    ))
}

/// Fig. 4.3: the cases a to d.
pub fn objects(results: &Results<'_>) -> Vec<String> {
    let cases = PRINTED.into_iter().filter_map(|(x, series, printed)| {
        let (case, _) = CASES.get(x as usize)?;
        let sentence = beside_linear(results, series, x, Some(printed))?;
        Some(format!("{case}: {sentence}"))
    });
    let mut sentences: Vec<String> = cases.collect();
    sentences.extend(slower(
        results,
        "The thesis finds the hierarchy slower than the linear search in most cases",
    ));
    sentences.extend(warm(results));
    sentences
}

/// A scene of the user's.
pub fn scene(results: &Results<'_>) -> Vec<String> {
    let hierarchies = [RAW, ENLARGED, STOPPED];
    let beside = hierarchies.map(|series| beside_linear(results, series, 0.0, None));
    beside.into_iter().flatten().chain(warm(results)).collect()
}

/// At how many places the enlarged hierarchy is slower than the linear search, by time and by
/// work, and whether a claim of that holds.
fn slower(results: &Results<'_>, claim: &str) -> Option<String> {
    let by_time = results.ratios(ENLARGED, LINEAR, FRAME_MS);
    let by_work = ratios(&work(results, ENLARGED), &work(results, LINEAR));
    let above = |ratios: &[(f64, f64)], least: f64| {
        ratios.iter().filter(|(_, ratio)| *ratio > least).count()
    };
    let verdict = |above: usize, places: usize| match 2 * above > places {
        true => "it holds",
        false => "it does not hold",
    };
    let (time, work) = (above(&by_time, ABOUT_EQUAL), above(&by_work, 1.0));
    (!by_time.is_empty()).then(|| {
        format!(
            "{claim}. By frame time {} here: “{ENLARGED}” is slower, by more than a quarter, at {time} of {} places. \
             By counted work {}: it looks at more texels at {work} of {} places (a node test computes more than an \
             evaluation).",
            verdict(time, by_time.len()),
            by_time.len(),
            verdict(work, by_work.len()),
            by_work.len()
        )
    })
}

/// What starting from the previous frame saves on a still camera.
fn warm(results: &Results<'_>) -> Option<String> {
    let steps = results.curve(WARM, STEPS);
    let most = steps.iter().map(|(_, steps)| *steps).reduce(f64::max)?;
    let saved = own_ratios(results, WARM, LINEAR);
    let least = saved.iter().map(|(_, ratio)| *ratio).reduce(f64::min)?;
    let largest = saved.iter().map(|(_, ratio)| *ratio).reduce(f64::max)?;
    let verdict = match most <= 1.0 {
        true => "the claim that a still camera needs a single step holds",
        false => "the claim that a still camera needs a single step does not hold",
    };
    Some(format!(
        "“{WARM}” starts from the previous frame's answers: {} at most a vertex on a still camera, so that \
         {verdict}. Its own passes (start, search, drawing) take {} the time of a cold one's.",
        match short(most).as_str() {
            "1" => "1 step".to_owned(),
            steps => format!("{steps} steps"),
        },
        range(least, largest)
    ))
}

/// Fig. 6.1.
pub fn general_view(results: &Results<'_>) -> Vec<String> {
    let mut sentences = growth(results);
    sentences.extend(slower(
        results,
        "The thesis finds that the hierarchy generally needs more time (Fig. 6.1)",
    ));
    sentences.extend(faster_where(results));
    sentences.extend(warm(results));
    sentences.extend(levels(results));
    sentences
}

/// Fig. 6.2.
pub fn full_view(results: &Results<'_>) -> Vec<String> {
    let mut sentences = growth(results);
    let by_time = own_ratios(results, ENLARGED, LINEAR);
    let by_work = ratios(&work(results, ENLARGED), &work(results, LINEAR));
    if let (Some((most, time)), Some((_, work))) = (by_time.last(), by_work.last()) {
        let verdict = match *time {
            ratio if ratio > ABOUT_EQUAL => "it does not hold: the hierarchy is slower",
            ratio if ratio < 1.0 / ABOUT_EQUAL => "it does not hold: the hierarchy is faster",
            _ => "it holds",
        };
        sentences.push(format!(
            "The thesis finds both about equal where the mirror fills the view (Fig. 6.2). By time {verdict}: \
             at {} vertices the own passes of “{ENLARGED}” take {} as long as those of “{LINEAR}”; it looks at {} \
             as many texels.",
            count(*most as u64),
            times(*time),
            times(*work)
        ));
    }
    sentences.extend(faster_where(results));
    sentences.extend(warm(results));
    sentences.extend(levels(results));
    sentences
}

/// How the cost of each search grows.
fn growth(results: &Results<'_>) -> Vec<String> {
    let sentence = |(label, _): &(&str, &str)| {
        let search = own_passes(results, label);
        let growth = power(search.get(search.len() / 2..)?)?;
        let (constant, slope) = line(&results.curve(label, FRAME_MS))?;
        let (most, _) = search.last()?;
        Some(format!(
            "“{label}”: up to {} vertices its own passes grow as the vertices to the power {} (upper half of the \
             sizes); a whole frame costs about {} ms and {} ms more per 1\u{202f}000 vertices.",
            count(*most as u64),
            short(growth),
            short(constant),
            short(1000.0 * slope)
        ))
    };
    SEARCHES.iter().filter_map(sentence).collect()
}

/// Which search has the clearly faster frame, size by size: the pyramid is built whatever the number
/// of vertices.
fn faster_where(results: &Results<'_>) -> Option<String> {
    let frames = results.ratios(ENLARGED, LINEAR, FRAME_MS);
    let clear = |(_, ratio): &&(f64, f64)| !(1.0 / ABOUT_EQUAL..=ABOUT_EQUAL).contains(ratio);
    let (less, more): (Vec<_>, Vec<_>) = frames
        .iter()
        .filter(clear)
        .partition(|(_, ratio)| *ratio < 1.0);
    let sizes = |places: &[&(f64, f64)]| {
        let sizes = places.iter().map(|(vertices, _)| count(*vertices as u64));
        sizes.collect::<Vec<_>>().join(", ")
    };
    match (less.is_empty(), more.is_empty()) {
        (true, true) => None,
        (true, false) => Some(format!(
            "By the time of a whole frame, the building of the pyramid included, “{LINEAR}” is nowhere slower than \
             “{ENLARGED}” by more than a quarter."
        )),
        (false, true) => Some(format!(
            "By the time of a whole frame, the building of the pyramid included, “{ENLARGED}” is nowhere slower than \
             “{LINEAR}” by more than a quarter."
        )),
        (false, false) => Some(format!(
            "By the time of a whole frame, the building of the pyramid included, “{ENLARGED}” is faster than \
             “{LINEAR}” by more than a quarter at {} vertices and slower by as much at {}.",
            sizes(&less),
            sizes(&more)
        )),
    }
}

/// Whether the hierarchy takes fewer steps.
fn levels(results: &Results<'_>) -> Option<String> {
    let hierarchy = results.curve(RAW, STEPS).last()?.1;
    let linear = results.curve(LINEAR, STEPS).last()?.1;
    Some(format!(
        "A step is a move of the walk or a texel taken from the stack: at the largest size {} for “{RAW}”, {} \
         for “{LINEAR}”. What the thesis blames is the step: four intersections of cone and sphere instead \
         of four dot products.",
        short(hierarchy),
        short(linear)
    ))
}

/// Holes, failures and offsets.
pub fn exactness(results: &Results<'_>) -> Vec<String> {
    let share = |series: &str, path: &str, x: f64| {
        let part = at(&results.curve(series, path), x)?;
        let whole = at(&results.curve(series, "vertices.reflected"), x)?;
        (whole > 0.0).then(|| percent(part / whole))
    };
    let mut sentences = Vec::new();
    if let (Some(holes), Some(failed), Some(mean)) = (
        share(RAW, "vertices.hole", 0.0),
        share(RAW, "vertices.failed", 0.0),
        at(&results.curve(RAW, MEAN_PX), 0.0),
    ) {
        sentences.push(format!(
            "Holes are the rule: on the sphere {holes} of the searches meet one. Without a repair {failed} of \
             them fail, and their stand-ins raise the mean offset to {} px.",
            short(mean)
        ));
    }
    for (series, printed) in [
        (
            ENLARGED,
            "the thesis calls practically all errors of holes eliminated, with new ones at grazing angles",
        ),
        (
            STOPPED,
            "the thesis calls the reflection very erroneous by then",
        ),
    ] {
        let offsets = [MEAN_PX, P95_PX].map(|path| at(&results.curve(series, path), 0.0));
        if let ([Some(mean), Some(p95)], Some(failed)) =
            (offsets, share(series, "vertices.failed", 0.0))
        {
            sentences.push(format!(
                "“{series}” fails for {failed} and is off by {} px in the mean, {} px at the 95th percentile: \
                 {printed}.",
                short(mean),
                short(p95)
            ));
        }
    }
    sentences
}

/// Jitter, jumps, and the cost of a moving frame.
pub fn motion(results: &Results<'_>) -> Vec<String> {
    let mut sentences: Vec<String> = SEARCHES
        .iter()
        .filter_map(|(label, _)| {
            let worst = |path| {
                let values = results.curve(label, path).into_iter();
                values.map(|(_, value)| value).reduce(f64::max)
            };
            let (mean, most) = (worst(JITTER_MEAN)?, worst(JITTER_MAX)?);
            Some(format!(
                "“{label}”: jitter of {} px in the mean and {} px at most, {} of the vertices jump from one \
                 frame to the next (each on its worst scene).",
                short(mean),
                short(most),
                percent(worst(JUMPS)?)
            ))
        })
        .collect();
    let worst_jumps = |label| {
        let jumps = results.curve(label, JUMPS).into_iter();
        jumps.map(|(_, share)| share).reduce(f64::max)
    };
    if let (Some(linear), Some(raw)) = (worst_jumps(LINEAR), worst_jumps(RAW)) {
        sentences.push(format!(
            "The thesis sees vertices of the hierarchy “jumping around” as the camera moves slowly: {}.",
            match raw > 2.0 * linear && raw > 0.0 {
                true => "so they do here, far more often than those of the linear search",
                false => "here no more than those of the linear search",
            }
        ));
    }
    let cost = SEARCHES.iter().flat_map(|(label, _)| {
        let moving = results.curve(label, MOVING_MS);
        ratios(&moving, &results.curve(label, STILL_MS))
    });
    let cost: Vec<f64> = cost.map(|(_, ratio)| ratio).collect();
    let (least, most) = (
        cost.iter().copied().reduce(f64::min),
        cost.iter().copied().reduce(f64::max),
    );
    if let (Some(least), Some(most)) = (least, most) {
        let verdict = match most <= ABOUT_EQUAL {
            true => "moving scenes cost nothing extra, as claimed",
            false => {
                "a moving frame of one search or another took longer, where the claim is that moving scenes cost \
                 nothing extra; the counted steps tell whether it has more to do or was disturbed"
            }
        };
        sentences.push(format!(
            "A moving frame takes {} the time of a still one: {verdict}.",
            range(least, most)
        ));
    }
    if sentences.is_empty() {
        sentences.push("No scene here moves: its file has no motion.".to_owned());
    }
    sentences
}
