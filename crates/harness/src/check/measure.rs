//! Layer by layer: how far a picture is from what our tracer sees.

use catoptric_frame::{Channels, FrameError, Image, Primary, Status};
use catoptric_metrics::stats::percentile;
use glam::Vec3;

use super::color;
use super::layer::Layer;
use super::limits;
use super::masks::Masks;
use super::ours::Ours;
use super::theirs::Theirs;

/// Everything that a picture brings, compared with ours.
pub struct Measured {
    /// In the order of a path.
    pub layers: Vec<Layer>,
    /// Pixels at which we see a mirror.
    pub mirror_pixels: usize,
    /// As in [`Masks::apart`].
    pub apart: usize,
}

impl Measured {
    /// Whether every layer keeps its limit.
    pub fn passed(&self) -> bool {
        self.layers.iter().all(|layer| layer.passed)
    }

    /// Sum over the layers of the shares that disagree: of two truths the nearer has less.
    pub fn disagreement(&self) -> f64 {
        let off = |layer: &Layer| layer.agree.map_or(0.0, |agree| 1.0 - agree);
        self.layers.iter().map(off).sum()
    }
}

/// Compares all layers that a picture has.
pub fn measure(channels: &Channels, ours: &Ours) -> Result<Measured, FrameError> {
    let theirs = Theirs::new(channels)?;
    let (primary, reflected) = (&ours.primary, &ours.reflected);
    let masks = Masks::new(&theirs, primary, reflected);
    let scale = (median_reach(&primary.position, &masks.same_mirror) / limits::REACH).max(1.0);
    let turn = turn(primary, &masks.same_mirror);
    let mut layers = Vec::new();

    if let Some(id) = &theirs.primary_id {
        let (ours, mask) = (&primary.id, &masks.everywhere);
        layers.push(Layer::agreement(
            "primary.id",
            mask,
            id,
            ours,
            limits::AGREE,
        ));
    }
    if let Some(position) = channels.positions("primary.position.")? {
        let rounded = rounding(channels, "primary.position.", extent(&position));
        let limit = limits::PRIMARY_POSITION.scaled(scale).widened(rounded);
        let off = apart(&position, &primary.position);
        layers.push(Layer::distance(
            "primary.position",
            &masks.same_primary,
            &off,
            limit,
        ));
    }
    if let Some(normal) = channels.positions("primary.normal.")? {
        let limit = limits::PRIMARY_NORMAL.widened(rounding(channels, "primary.normal.", 1.0));
        let limit = limit.turned(turn);
        let pairs = normal.pixels().iter().zip(primary.normal.pixels());
        let off = pairs.map(|(a, b)| far(*a, *b).min(far(*a, -*b)));
        let off = Image::from_vec(normal.size(), off.collect());
        layers.push(Layer::distance(
            "primary.normal",
            &masks.same_mirror,
            &off,
            limit,
        ));
    }
    if let Some(direction) = channels.positions("reflected.direction.")? {
        let limit = limits::DIRECTION.widened(rounding(channels, "reflected.direction.", 1.0));
        // A mirror that turns by an angle turns what it reflects by twice that angle.
        let limit = limit.turned(2.0 * turn);
        let off = apart(&direction, &ours.direction);
        layers.push(Layer::distance(
            "reflected.direction",
            &masks.mirror,
            &off,
            limit,
        ));
    }
    let agree_once = limits::agree_once(ours.start, scale);
    if let Some(status) = &theirs.status {
        let (ours, mask) = (&reflected.status, &masks.same_mirror);
        layers.push(Layer::agreement(
            "reflected.status",
            mask,
            status,
            ours,
            agree_once,
        ));
    }
    let agree_deep = limits::agree_deep(ours.start);
    if let Some(id) = &theirs.reflected_id {
        let of =
            |name, mask: &[bool], least| Layer::agreement(name, mask, id, &reflected.id, least);
        layers.push(of("reflected.id", &masks.mirror_once, agree_once));
        if masks.mirror_more.contains(&true) {
            layers.push(of("reflected.id 2+", &masks.mirror_more, agree_deep));
        }
    }
    if let Some(bounces) = theirs
        .bounces
        .as_ref()
        .filter(|_| reflected.bounces.is_some())
    {
        let of = |name, mask: &[bool], least| {
            Layer::agreement(name, mask, bounces, &masks.bounces, least)
        };
        layers.push(of("bounces", &masks.mirror_once, agree_once));
        if masks.mirror_more.contains(&true) {
            layers.push(of("bounces 2+", &masks.mirror_more, agree_deep));
        }
    }
    let limit = limits::reflected(ours.start).scaled(scale);
    if let Some(position) = channels.positions("reflected.position.")? {
        let limit = limit.widened(rounding(channels, "reflected.position.", extent(&position)));
        let off = apart(&position, &reflected.position);
        layers.push(Layer::distance(
            "reflected.position",
            &masks.after_one,
            &off,
            limit,
        ));
        // After more than two, differences are magnified beyond any limit that would say something.
        if masks.after_two.contains(&true) {
            layers.push(Layer::distance(
                "reflected.position 2",
                &masks.after_two,
                &off,
                limit.scaled(limits::MAGNIFICATION),
            ));
        }
    }
    if let Some(distances) = channels.numbers("reflected.distance")? {
        let finite = distances.pixels().iter().filter(|t| t.is_finite());
        let extent = finite.fold(0.0f32, |most, t| most.max(t.abs()));
        let limit = limit.widened(rounding(channels, "reflected.distance", extent));
        let pairs = distances.pixels().iter().zip(reflected.distance.pixels());
        let off = pairs.map(|(theirs, ours)| (f64::from(*theirs) - f64::from(*ours)).abs() as f32);
        let off = Image::from_vec(distances.size(), off.collect());
        layers.push(Layer::distance(
            "reflected.distance",
            &masks.after_one,
            &off,
            limit,
        ));
    }
    if let Some(colors) = channels.colors("")? {
        layers.extend(color_layers(channels, &colors, ours, &masks));
    }
    let is_mirror = |status: &&Status| **status != Status::NotMirror;
    Ok(Measured {
        layers,
        mirror_pixels: reflected.status.pixels().iter().filter(is_mirror).count(),
        apart: masks.apart,
    })
}

/// 1 + the largest coordinate of the points within a mask, in the median; 0 where there are none.
fn median_reach(positions: &Image<Vec3>, mask: &[bool]) -> f64 {
    let kept = positions
        .pixels()
        .iter()
        .zip(mask)
        .filter(|(_, kept)| **kept);
    let mut reaches: Vec<f64> = kept
        .map(|(position, _)| 1.0 + f64::from(position.abs().max_element()))
        .collect();
    reaches.sort_by(f64::total_cmp);
    percentile(&reaches, 0.5).unwrap_or(0.0)
}

/// How far 16-bit samples of this size may be rounded; 0 for 32-bit ones.
fn rounding(channels: &Channels, prefix: &str, extent: f32) -> f64 {
    if channels.half(prefix) {
        f64::from(extent) / 2048.0
    } else {
        0.0
    }
}

/// The largest coordinate. One that is infinite is no measure of how the others are rounded.
fn extent(image: &Image<Vec3>) -> f32 {
    let finite = image.pixels().iter().filter(|pixel| pixel.is_finite());
    finite.fold(0.0, |most, pixel| most.max(pixel.abs().max_element()))
}

fn apart(theirs: &Image<Vec3>, ours: &Image<Vec3>) -> Image<f32> {
    let pairs = theirs.pixels().iter().zip(ours.pixels());
    Image::from_vec(theirs.size(), pairs.map(|(a, b)| far(*a, *b)).collect())
}

/// The distance between two points, whose square need not fit a 32-bit float.
fn far(a: Vec3, b: Vec3) -> f32 {
    a.as_dvec3().distance(b.as_dvec3()) as f32
}

/// The angle, in radians, by which the mirrors' normals turn if their points move by the rounding of a
/// 32-bit coordinate: the length of that rounding times the mirror's curvature there, from pixel to
/// pixel. The median over the pixels within a mask, less the same on a mirror of radius 1 that reaches
/// to [`limits::REACH`], and at least 0; 0 where there are no pixels.
fn turn(primary: &Primary, mask: &[bool]) -> f64 {
    let [width, height] = primary.id.size();
    let kept = |x: u32, y: u32| mask[(y * width + x) as usize];
    let mut turns = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let beside = [(x + 1, y), (x, y + 1)];
            let inside = beside
                .into_iter()
                .filter(|(x, y)| *x < width && *y < height);
            let same = inside.filter(|(u, v)| {
                kept(x, y) && kept(*u, *v) && primary.id.at(x, y) == primary.id.at(*u, *v)
            });
            let at = primary.position.at(x, y).as_dvec3();
            let reach = 1.0 + at.abs().max_element();
            turns.extend(same.filter_map(|(u, v)| {
                let bend = far(*primary.normal.at(x, y), *primary.normal.at(u, v));
                let step = at.distance(primary.position.at(u, v).as_dvec3());
                (step > 0.0).then(|| reach * limits::FLOAT * f64::from(bend) / step)
            }));
        }
    }
    turns.sort_by(f64::total_cmp);
    let median = percentile(&turns, 0.5).unwrap_or(0.0);
    (median - limits::REACH * limits::FLOAT).max(0.0)
}

/// Colours of what is seen after at most one reflection and, where there are such, after more.
fn color_layers(
    channels: &Channels,
    theirs: &Image<Vec3>,
    ours: &Ours,
    masks: &Masks,
) -> Vec<Layer> {
    let rounded = ["R", "G", "B"].map(|name| rounding(channels, name, color::largest(theirs)));
    let limit = limits::color(ours.start);
    let within = limit.within + rounded.into_iter().fold(0.0, f64::max);
    let off = apart(theirs, &ours.color);
    let beyond = color::beyond(theirs, &ours.color, ours.side);
    let of = |name, mask: &[bool], least| Layer::color(name, mask, &off, &beyond, within, least);
    let mut layers = vec![of("R G B", &masks.direct, limits::AGREE)];
    if masks.once.contains(&true) {
        layers.push(of("R G B reflected", &masks.once, limit.agree));
    }
    if masks.deep.contains(&true) {
        layers.push(of("R G B 2+", &masks.deep, limits::agree_deep(ours.start)));
    }
    layers.push(Layer::surfaces(
        "R G B per surface",
        &masks.shallow,
        &seen(ours),
        &beyond,
        within,
    ));
    layers
}

/// Id of the surface that each pixel shows: on a mirror that which is reflected.
fn seen(ours: &Ours) -> Image<u32> {
    let primary = ours.primary.id.pixels().iter();
    let reflected = ours.reflected.id.pixels().iter();
    let status = ours.reflected.status.pixels().iter();
    let pixels = primary.zip(reflected).zip(status);
    let shown = pixels.map(|((primary, reflected), status)| match status {
        Status::Resolved => *reflected,
        _ => *primary,
    });
    Image::from_vec(ours.primary.id.size(), shown.collect())
}
