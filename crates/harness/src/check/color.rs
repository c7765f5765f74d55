//! Whether colours agree.

use catoptric_frame::Image;
use glam::Vec3;

/// How far each colour lies outside the range that is allowed. For one ray a pixel, the range goes
/// from the least to the greatest of our pixel and its neighbours; for `side` × `side` rays, a
/// colour may differ from ours by as much as one of the rays can change it. NaN for a colour that
/// is not a number.
pub fn beyond(theirs: &Image<Vec3>, ours: &Image<Vec3>, side: u32) -> Image<f32> {
    let [width, _] = theirs.size();
    let ray = largest(theirs).max(largest(ours)) / (side * side) as f32;
    let pixel = |(at, theirs): (usize, &Vec3)| {
        let (low, high) = if side == 1 {
            range_around(ours, at as u32 % width, at as u32 / width)
        } else {
            (ours.pixels()[at] - ray, ours.pixels()[at] + ray)
        };
        if !theirs.is_finite() {
            return f32::NAN;
        }
        (low - *theirs)
            .max(*theirs - high)
            .max(Vec3::ZERO)
            .max_element()
    };
    let pixels = theirs.pixels().iter().enumerate().map(pixel).collect();
    Image::from_vec(theirs.size(), pixels)
}

/// The greatest channel of a picture, where it is a number.
pub fn largest(picture: &Image<Vec3>) -> f32 {
    let finite = picture.pixels().iter().filter(|pixel| pixel.is_finite());
    finite.fold(0.0, |most, pixel| most.max(pixel.max_element()))
}

/// Least and greatest of each channel in the pixels around one.
fn range_around(colors: &Image<Vec3>, x: u32, y: u32) -> (Vec3, Vec3) {
    let [width, height] = colors.size();
    let mut range = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for y in y.saturating_sub(1)..(y + 2).min(height) {
        for x in x.saturating_sub(1)..(x + 2).min(width) {
            let color = *colors.at(x, y);
            range = (range.0.min(color), range.1.max(color));
        }
    }
    range
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(values: [f32; 4]) -> Image<Vec3> {
        Image::from_vec([4, 1], values.map(Vec3::splat).to_vec())
    }

    #[test]
    fn an_edge_may_move_by_a_pixel_and_no_more() {
        let ours = row([0.0, 0.0, 1.0, 1.0]);
        let beyond = |theirs| beyond(&row(theirs), &ours, 1).pixels().to_vec();
        assert_eq!(beyond([0.0, 1.0, 1.0, 1.0]), [0.0; 4]);
        assert_eq!(beyond([0.0, 0.5, 0.0, 1.0]), [0.0; 4]);
        assert_eq!(beyond([1.0, 0.0, 1.0, 1.0]), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(beyond([0.0, 0.0, 1.0, 1.25]), [0.0, 0.0, 0.0, 0.25]);
        assert!(beyond([f32::NAN, 0.0, 1.0, 1.0])[0].is_nan());
        assert!(beyond([f32::INFINITY, 0.0, 1.0, 1.0])[0].is_nan());
    }

    #[test]
    fn of_several_rays_one_may_see_something_else() {
        let ours = row([0.0, 0.0, 1.0, 1.0]);
        let beyond = beyond(&row([0.25, 0.5, 0.75, 1.0]), &ours, 2);
        assert_eq!(beyond.pixels(), [0.0, 0.25, 0.0, 0.0]);
        let infinite = super::beyond(&row([f32::INFINITY, 0.5, 0.0, 0.0]), &ours, 2);
        assert!(infinite.pixels()[0].is_nan() && infinite.pixels()[2] > 0.0);
    }
}
