//! What pictures are made of, as files that a page may read from disk: the values that the inspector
//! (`templates/inspector/`) shows.
//!
//! A browser lets a page from disk read no file but scripts. So each file is a call of
//! `catoptricLayers` with one object: `reference` and its names, or a technique with the summaries of
//! its errors; and the planes of either, quantised by steps that each plane states (`plane`).
//!
//! | plane | of | steps |
//! |---|---|---|
//! | `primary.id` | reference | whole |
//! | `id`, `status` | both | whole |
//! | `color` | both | 1/2048, from −1; red, green, blue |
//! | `angle` | technique | octaves/32, that is 2.2 %, degrees; 0 below 2⁻¹³ |
//! | `coverage` | technique | whole: codes of [`CoverageClass`](catoptric_metrics::CoverageClass) |
//! | `flip` | technique | 1/254 |
//!
//! With [`Extent::All`], also `primary.position`, `primary.normal` (reference), `position` and
//! `distance` (both) and `offset` (technique, in pixels).

mod plane;

use catoptric_frame::{Frame, Image};
use catoptric_metrics::{MapKind, Summary, error_map, offset_px};
use glam::Vec3;
use serde_json::{Map, Value, json};

use plane::{Code, Plane};

/// Which values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Objects, statuses, colours and errors.
    Usual,
    /// Positions, normals, distances and offsets too.
    All,
}

impl Extent {
    /// What `--layers` asks for, given or not.
    pub fn of(layers: bool) -> Self {
        match layers {
            true => Self::All,
            false => Self::Usual,
        }
    }
}

/// Colours: from −1 to 30.99 in steps below the 8-bit picture's nearly everywhere.
const COLOR: Code = Code::Linear {
    from: -1.0,
    step: 1.0 / 2048.0,
    bytes: 2,
};
/// Angles, in degrees. Angles below 2⁻¹³° (a thousandth of a usual pixel) are float32's noise and written
/// as 0: otherwise they would fill half of the file of an exact technique.
const ANGLE: Code = Code::Octaves {
    from: -13.0,
    step: 1.0 / 32.0,
};
/// Distances and offsets: relative steps. Below a millionth, 0.
const RELATIVE: Code = Code::Octaves {
    from: -20.0,
    step: 1.0 / 128.0,
};
/// Errors from 0 to 1.
const SHARE: Code = Code::Linear {
    from: 0.0,
    step: 1.0 / 254.0,
    bytes: 1,
};
/// Parts of unit vectors.
const UNIT: Code = Code::Linear {
    from: -1.0,
    step: 1.0 / 4096.0,
    bytes: 2,
};

/// Names of the axes, in planes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The file of a scene's truth.
pub fn reference(truth: &Frame, extent: Extent) -> anyhow::Result<String> {
    let mut planes = Map::new();
    for plane in shared(truth, truth, extent) {
        planes.insert(plane.name.clone(), plane.encode(None)?);
    }
    if let Some(primary) = &truth.primary {
        let id = &primary.id;
        let mut own = vec![whole("primary.id", id, largest([id]))];
        if extent == Extent::All {
            let met = |index: usize| id.pixels()[index] != 0;
            own.extend(places("primary.position", &primary.position, met));
            own.extend(vectors("primary.normal", &primary.normal, UNIT, met));
        }
        for plane in own {
            planes.insert(plane.name.clone(), plane.encode(None)?);
        }
    }
    let names = truth.names.iter().map(|name| json!([name.id, name.name]));
    Ok(call(&json!({
        "of": "reference",
        "size": truth.color.size(),
        "names": names.collect::<Vec<_>>(),
        "planes": planes,
    })))
}

/// The file of a technique's picture of that scene.
pub fn technique(truth: &Frame, frame: &Frame, extent: Extent) -> anyhow::Result<String> {
    let mut planes = Map::new();
    let of_truth = shared(truth, frame, extent);
    for plane in shared(frame, truth, extent) {
        let same = of_truth.iter().find(|other| other.name == plane.name);
        planes.insert(plane.name.clone(), plane.encode(same)?);
    }
    let map = |kind| error_map(kind, truth, frame);
    let (angle, flip) = (map(MapKind::Angular)?, map(MapKind::Flip)?);
    let mut own = vec![
        Plane::of("angle", &angle, ANGLE),
        Plane::of("flip", &flip, SHARE),
        Plane::of(
            "coverage",
            &map(MapKind::Coverage)?,
            Code::Whole { bytes: 1 },
        ),
    ];
    if extent == Extent::All {
        own.push(Plane::of("offset", &offset_px(truth, frame)?, RELATIVE));
    }
    for plane in own {
        planes.insert(plane.name.clone(), plane.encode(None)?);
    }
    let errors = json!({
        "angle": summary(&angle),
        "color": summary(&map(MapKind::AbsColor)?),
        "flip": summary(&flip),
    });
    Ok(call(&json!({
        "of": "technique",
        "size": frame.color.size(),
        "errors": errors,
        "planes": planes,
    })))
}

fn call(file: &Value) -> String {
    // A value of JSON is one of JavaScript.
    format!("catoptricLayers({file});\n")
}

/// An error over the mirror, before it was quantised: percentiles, and the pixel where it is largest.
/// `null` where no pixel has it.
fn summary(map: &Image<f32>) -> Value {
    let known = || map.pixels().iter().filter(|value| value.is_finite());
    let Some(summary) = Summary::of(known().map(|value| f64::from(*value))) else {
        return Value::Null;
    };
    let [width, _] = map.size();
    let worst = map.pixels().iter().zip(0_u32..);
    let worst = worst.filter(|(value, _)| f64::from(**value) == summary.max);
    let worst = worst
        .map(|(_, index)| [index % width, index / width])
        .next();
    json!({
        "pixels": known().count(),
        "p50": summary.p50,
        "p95": summary.p95,
        "p99": summary.p99,
        "max": summary.max,
        "worst": worst,
    })
}

/// The planes that reference and technique both have; `other` is the other one of the two.
fn shared(frame: &Frame, other: &Frame, extent: Extent) -> Vec<Plane> {
    let mut planes = vec![Plane::of_vectors("color", &frame.color, COLOR)];
    if let Some(reflected) = &frame.reflected {
        let ids = [frame, other].map(|frame| frame.reflected.as_ref());
        let ids = ids.into_iter().flatten().map(|layer| &layer.id);
        planes.push(whole("id", &reflected.id, largest(ids)));
        let status = reflected.status.map(|status| *status as u32);
        planes.push(whole("status", &status, 0));
        if extent == Extent::All {
            let met = |index: usize| reflected.id.pixels()[index] != 0;
            planes.extend(places("position", &reflected.position, met));
            let pixels = reflected.distance.pixels().iter().enumerate();
            let distance = pixels.map(|(index, far)| if met(index) { *far } else { f32::NAN });
            let distance = Image::from_vec(frame.color.size(), distance.collect());
            planes.push(Plane::of("distance", &distance, RELATIVE));
        }
    }
    planes
}

fn largest<'i>(images: impl IntoIterator<Item = &'i Image<u32>>) -> u32 {
    let ids = images.into_iter().flat_map(|image| image.pixels());
    ids.copied().max().unwrap_or(0)
}

/// Whole numbers up to `most`, or of one byte.
fn whole(name: &str, image: &Image<u32>, most: u32) -> Plane {
    // The largest code stands for no value.
    let bytes = (1..4).find(|bytes| u64::from(most) + 1 < 1 << (8 * bytes));
    let values = image.map(|value| *value as f32);
    Plane::of(
        name,
        &values,
        Code::Whole {
            bytes: bytes.unwrap_or(4),
        },
    )
}

/// A plane an axis; no value where not `met`.
fn vectors(name: &str, image: &Image<Vec3>, code: Code, met: impl Fn(usize) -> bool) -> Vec<Plane> {
    let plane = |(axis, part): (usize, &str)| {
        Plane::of(&format!("{name}.{part}"), &along(image, axis, &met), code)
    };
    AXES.into_iter().enumerate().map(plane).collect()
}

/// World-space points: as [`vectors`], each axis in steps that fit its values.
fn places(name: &str, image: &Image<Vec3>, met: impl Fn(usize) -> bool) -> Vec<Plane> {
    let plane = |(axis, part): (usize, &str)| {
        let values = along(image, axis, &met);
        let code = Code::fitting(&values);
        Plane::of(&format!("{name}.{part}"), &values, code)
    };
    AXES.into_iter().enumerate().map(plane).collect()
}

fn along(image: &Image<Vec3>, axis: usize, met: impl Fn(usize) -> bool) -> Image<f32> {
    let pixels = image.pixels().iter().enumerate();
    let values = pixels.map(|(index, vector)| match met(index) {
        true => vector[axis],
        false => f32::NAN,
    });
    Image::from_vec(image.size(), values.collect())
}
