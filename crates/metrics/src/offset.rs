//! How far from its place a technique shows a point.

use catoptric_frame::{Frame, Image};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::MetricsError;
use crate::coverage::Layers;

/// A point is not in the reference's picture if it lies farther than this from the nearest point
/// that the reference shows, in steps between neighbouring pixels.
const REACH: f64 = 1.5;

/// For each mirror pixel: how many pixels away the reference shows the point of the scene that the
/// technique shows here. NaN where the technique shows none, or one that the reference's mirrors do
/// not show.
///
/// The nearest point of the same object that the reference shows at any mirror pixel is looked for;
/// from its pixel, one step to the right and one downwards say where between pixels the point lies.
///
/// # Errors
/// The frames differ in size or lack a layer.
pub fn offset_px(reference: &Frame, test: &Frame) -> Result<Image<f32>, MetricsError> {
    let layers = Layers::new(reference, test)?;
    let ids = layers.reference.id.pixels();
    let positions = layers.reference.position.pixels();
    let mut shown: Vec<Shown> = layers
        .mirror_pixels()
        .filter(|&index| ids[index] != 0)
        .map(|index| Shown {
            id: ids[index],
            at: positions[index].as_dvec3(),
            index,
        })
        .collect();
    shown.sort_by_key(|shown| shown.id);
    let mut trees: Vec<&mut [Shown]> = shown.chunk_by_mut(|a, b| a.id == b.id).collect();
    trees.par_iter_mut().for_each(|tree| arrange(tree, 0));

    let width = layers.size[0] as usize;
    let place = |index: usize| DVec2::new((index % width) as f64, (index / width) as f64);
    let pixels: Vec<usize> = layers.mirror_pixels().collect();
    let offset = |&index: &usize| {
        let id = layers.ids(index)[1];
        let tree = trees.binary_search_by_key(&id, |tree| tree[0].id).ok()?;
        let point = layers.test.position.pixels()[index].as_dvec3();
        let mut nearest = Nearest {
            index: usize::MAX,
            squared: f64::INFINITY,
        };
        nearest.search(trees[tree], 0, point);
        let found = nearest.index;
        if found == usize::MAX {
            return None;
        }
        // Steps that lead out of the picture, or to another object, are the opposite ones turned.
        let step = |forth: bool, back: bool, by: usize| {
            let forth = forth.then(|| layers.step(found, found + by)).flatten();
            let back = || back.then(|| layers.step(found, found - by)).flatten();
            forth.or_else(|| back().map(|step| -step))
        };
        let column = found % width;
        let steps = [
            step(column + 1 < width, column > 0, 1),
            step(true, found >= width, width),
        ];
        let away = point - positions[found].as_dvec3();
        let longest = steps.iter().flatten().map(|step| step.length());
        let longest = longest.fold(0.0, f64::max);
        if away.length() > REACH * longest {
            // Without neighbours, only the very point is known to be shown.
            return (away.length() == 0.0).then(|| (place(found) - place(index)).length());
        }
        let between = within(steps, away).clamp(DVec2::splat(-0.5), DVec2::splat(0.5));
        Some((place(found) + between - place(index)).length())
    };
    let offsets: Vec<Option<f64>> = pixels.par_iter().map(offset).collect();
    let mut map = Image::filled(layers.size, f32::NAN);
    for (index, offset) in pixels.into_iter().zip(offsets) {
        map.pixels_mut()[index] = offset.map_or(f32::NAN, |offset| offset as f32);
    }
    Ok(map)
}

/// How many steps to the right and downwards make `away`: least squares.
fn within(steps: [Option<DVec3>; 2], away: DVec3) -> DVec2 {
    let along = |step: DVec3| away.dot(step) / step.length_squared();
    let [right, down] = match steps {
        [Some(x), Some(y)] => {
            let (xx, xy, yy) = (x.length_squared(), x.dot(y), y.length_squared());
            let (ax, ay) = (away.dot(x), away.dot(y));
            let determinant = xx * yy - xy * xy;
            [
                (ax * yy - ay * xy) / determinant,
                (ay * xx - ax * xy) / determinant,
            ]
        }
        [Some(x), None] => [along(x), 0.0],
        [None, Some(y)] => [0.0, along(y)],
        [None, None] => [0.0; 2],
    };
    let finite = |part: f64| if part.is_finite() { part } else { 0.0 };
    DVec2::new(finite(right), finite(down))
}

/// A point that the reference shows.
struct Shown {
    id: u32,
    at: DVec3,
    index: usize,
}

/// Orders points as a k-d tree: the middle one splits along an axis, the halves along the next.
fn arrange(points: &mut [Shown], axis: usize) {
    if points.len() < 2 {
        return;
    }
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.at[axis].total_cmp(&b.at[axis]));
    let (below, above) = points.split_at_mut(middle);
    arrange(below, (axis + 1) % 3);
    arrange(&mut above[1..], (axis + 1) % 3);
}

/// The nearest point so far.
struct Nearest {
    index: usize,
    squared: f64,
}

impl Nearest {
    fn search(&mut self, points: &[Shown], axis: usize, to: DVec3) {
        let middle = points.len() / 2;
        let Some(split) = points.get(middle) else {
            return;
        };
        let squared = split.at.distance_squared(to);
        if squared < self.squared || (squared == self.squared && split.index < self.index) {
            (self.index, self.squared) = (split.index, squared);
        }
        let beyond = to[axis] - split.at[axis];
        let (below, above) = (&points[..middle], &points[middle + 1..]);
        let (near, far) = match beyond < 0.0 {
            true => (below, above),
            false => (above, below),
        };
        self.search(near, (axis + 1) % 3, to);
        if beyond * beyond <= self.squared {
            self.search(far, (axis + 1) % 3, to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_frame::{Primary, Reflected, Status};
    use glam::Vec3;

    const SIZE: [u32; 2] = [12, 9];

    /// A mirror that shows a tilted plane; the point of a pixel is where `shift` says, in pixels.
    fn frame(shift: impl Fn(u32, u32) -> [f32; 2], id: impl Fn(u32) -> u32) -> Frame {
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
        let at = |(x, y): (u32, u32)| {
            let [right, down] = shift(x, y);
            let (u, v) = (x as f32 + right, y as f32 + down);
            Vec3::new(0.3 * u + 0.1 * v, 0.2 * v, 0.05 * u - 0.4 * v)
        };
        let blank = Image::filled(SIZE, Vec3::ZERO);
        let ids: Vec<u32> = pixels.clone().map(|(x, _)| id(x)).collect();
        Frame {
            color: blank.clone(),
            primary: Some(Primary {
                id: Image::filled(SIZE, 9),
                position: Image::filled(SIZE, Vec3::new(0.0, 0.0, 50.0)),
                normal: blank,
            }),
            reflected: Some(Reflected {
                status: Image::filled(SIZE, Status::Resolved),
                id: Image::from_vec(SIZE, ids),
                position: Image::from_vec(SIZE, pixels.map(at).collect()),
                distance: Image::filled(SIZE, 1.0),
                bounces: None,
            }),
            motion: None,
            names: Vec::new(),
        }
    }

    #[test]
    fn a_shift_by_parts_of_pixels_is_found() {
        let truth = frame(|_, _| [0.0; 2], |_| 1);
        for shift in [[0.0, 0.0], [0.25, 0.0], [-1.75, 2.5], [3.0, -0.4]] {
            let test = frame(|_, _| shift, |_| 1);
            let map = offset_px(&truth, &test).unwrap();
            let expected = shift[0].hypot(shift[1]);
            for (x, y) in [(5, 4), (6, 5)] {
                let got = *map.at(x, y);
                assert!((got - expected).abs() < 1e-3, "{shift:?}: {got}");
            }
        }
    }

    #[test]
    fn what_the_reference_does_not_show_has_no_offset() {
        let truth = frame(|_, _| [0.0; 2], |_| 1);
        let nothing = frame(|_, _| [0.0; 2], |_| 0);
        let another = frame(|_, _| [0.0; 2], |x| if x < 6 { 1 } else { 2 });
        let far = frame(|_, _| [40.0, 0.0], |_| 1);
        let at = |test: &Frame, x: u32| *offset_px(&truth, test).unwrap().at(x, 4);
        assert!(at(&nothing, 3).is_nan());
        assert_eq!(at(&another, 3), 0.0);
        assert!(at(&another, 8).is_nan());
        assert!(at(&far, 3).is_nan());
    }
}
