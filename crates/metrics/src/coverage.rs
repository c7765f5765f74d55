//! Which mirror pixels show a surface: masks, regions, cracks.
//!
//! A *mirror pixel* is one that reference and technique both see as reflecting mirror (resolved or
//! unresolved). The mirror's back and pixels whose ray goes below the surface are none.

use catoptric_frame::{Frame, Image, Reflected, Status};
use glam::{DVec3, Vec3};

use crate::MetricsError;

/// The widest gap in pixels that is still called a crack; a wider one is a hole, since a triangle
/// is missing and not merely its edge displaced.
pub const MAX_CRACK_WIDTH: u32 = 16;

/// Mirror pixels at most this far (Euclidean, in pixels) from the mask's border are the rim.
pub const RIM_WIDTH: i32 = 3;

/// The layers that geometric metrics look at, checked to be there and of one size.
pub(crate) struct Layers<'frames> {
    pub size: [u32; 2],
    pub mirror_point: &'frames Image<Vec3>,
    pub reference: &'frames Reflected,
    pub test: &'frames Reflected,
    /// Mirror pixels.
    pub mask: Image<bool>,
}

impl<'frames> Layers<'frames> {
    pub fn new(reference: &'frames Frame, test: &'frames Frame) -> Result<Self, MetricsError> {
        let missing = |which, layer| MetricsError::MissingLayer { which, layer };
        let primary = reference
            .primary
            .as_ref()
            .ok_or(missing("reference", "primary"))?;
        let mirror_point = &primary.position;
        let reference_layer = reference
            .reflected
            .as_ref()
            .ok_or(missing("reference", "reflected"))?;
        let test_layer = test
            .reflected
            .as_ref()
            .ok_or(missing("technique", "reflected"))?;

        let size = reference.color.size();
        MetricsError::same_size("color", size, test.color.size())?;
        MetricsError::same_size("primary.position", size, mirror_point.size())?;
        for Reflected {
            status,
            id,
            position,
            ..
        } in [reference_layer, test_layer]
        {
            MetricsError::same_size("reflected.status", size, status.size())?;
            MetricsError::same_size("reflected.id", size, id.size())?;
            MetricsError::same_size("reflected.position", size, position.size())?;
        }
        let statuses = reference_layer
            .status
            .pixels()
            .iter()
            .zip(test_layer.status.pixels());
        let mask = statuses
            .map(|(&r, &t)| is_reflecting(r) && is_reflecting(t))
            .collect();
        let mask = Image::from_vec(size, mask);
        Ok(Self {
            size,
            mirror_point,
            reference: reference_layer,
            test: test_layer,
            mask,
        })
    }

    /// Indices of the mirror pixels.
    pub fn mirror_pixels(&self) -> impl Iterator<Item = usize> {
        self.mask
            .pixels()
            .iter()
            .enumerate()
            .filter(|(_, mirror)| **mirror)
            .map(|(index, _)| index)
    }

    /// Both see the same; unresolved agrees only with unresolved.
    pub fn agree(&self, index: usize) -> bool {
        let seen = |layer: &Reflected| (layer.id.pixels()[index], layer.status.pixels()[index]);
        seen(self.reference) == seen(self.test)
    }

    /// Ids of reference and technique at a pixel.
    pub fn ids(&self, index: usize) -> [u32; 2] {
        [self.reference, self.test].map(|layer| layer.id.pixels()[index])
    }

    /// Whether reference and technique show a reflected surface at a pixel.
    pub fn show(&self, index: usize) -> [bool; 2] {
        self.ids(index).map(|id| id != 0)
    }

    /// The technique answers "background" where the reference sees an object: where cracks are
    /// looked for. An unresolved pixel is no crack, since it says that it does not know.
    fn gap(&self, index: usize) -> bool {
        self.show(index) == [true, false] && self.test.status.pixels()[index] == Status::Resolved
    }

    /// Enclosed gaps of the technique's picture.
    pub fn gaps(&self) -> Gaps {
        let mut missing = Image::filled(self.size, false);
        let mut surface = Image::filled(self.size, false);
        for index in self.mirror_pixels() {
            missing.pixels_mut()[index] = self.gap(index);
            surface.pixels_mut()[index] = self.show(index)[1];
        }
        find_cracks(&missing, &surface)
    }

    /// Angle at the reference's mirror point between the directions to the two hit positions, in
    /// degrees; `None` unless both see the same object, NaN if there is no such angle.
    pub fn angular_error_deg(&self, index: usize) -> Option<f64> {
        let [reference, test] = self.ids(index);
        if reference == 0 || reference != test {
            return None;
        }
        let [a, b] = self.hits(index);
        Some(angle_deg(a, b))
    }

    /// From the reference's mirror point to what reference and technique show there.
    pub fn hits(&self, index: usize) -> [DVec3; 2] {
        let mirror_point = self.mirror_point.pixels()[index].as_dvec3();
        [self.reference, self.test]
            .map(|layer| layer.position.pixels()[index].as_dvec3() - mirror_point)
    }

    /// How the reference's hit moves from a pixel to another; `None` unless both are mirror pixels
    /// that show the same object.
    pub fn step(&self, from: usize, to: usize) -> Option<DVec3> {
        let ids = self.reference.id.pixels();
        let same = *self.mask.pixels().get(to)? && ids[from] != 0 && ids[from] == ids[to];
        let hits = self.reference.position.pixels();
        same.then(|| hits[to].as_dvec3() - hits[from].as_dvec3())
    }

    /// A mirror pixel next to which (8 neighbours) a mirror pixel has another id in the reference.
    pub fn on_id_edge(&self, index: usize) -> bool {
        let ids = self.reference.id.pixels();
        neighbours(self.size, index)
            .flatten()
            .any(|other| self.mask.pixels()[other] && ids[other] != ids[index])
    }
}

/// Angle between two directions of any length, degrees; NaN if one of them has none.
pub(crate) fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    let degenerate = a.length_squared() * b.length_squared() == 0.0;
    // a × (b − a) is a × b, without the cancellation where both are nearly the same.
    let angle = a.cross(b - a).length().atan2(a.dot(b)).to_degrees();
    if degenerate { f64::NAN } else { angle }
}

pub(crate) fn is_reflecting(status: Status) -> bool {
    matches!(status, Status::Resolved | Status::Unresolved)
}

/// The eight neighbours of a pixel; `None` for those outside the image.
fn neighbours(size: [u32; 2], index: usize) -> impl Iterator<Item = Option<usize>> {
    let [width, height] = size.map(|side| side as i32);
    let (x, y) = (index as i32 % width, index as i32 / width);
    (-1..=1)
        .flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)))
        .filter(|&offset| offset != (0, 0))
        .map(move |(dx, dy)| {
            let (x, y) = (x + dx, y + dy);
            let inside = (0..width).contains(&x) && (0..height).contains(&y);
            inside.then_some((y * width + x) as usize)
        })
}

/// The part of a mask within [`RIM_WIDTH`] of its border. The image's edge is no border.
pub fn rim(mask: &Image<bool>) -> Image<bool> {
    let size = mask.size();
    let [width, height] = size.map(|side| side as i32);
    let disc: Vec<(i32, i32)> = (-RIM_WIDTH..=RIM_WIDTH)
        .flat_map(|dy| (-RIM_WIDTH..=RIM_WIDTH).map(move |dx| (dx, dy)))
        .filter(|(dx, dy)| dx * dx + dy * dy <= RIM_WIDTH * RIM_WIDTH)
        .collect();
    let pixels = mask.pixels();
    let in_rim = pixels.iter().enumerate().map(|(index, &inside)| {
        let (x, y) = (index as i32 % width, index as i32 / width);
        inside
            && disc.iter().any(|(dx, dy)| {
                let (x, y) = (x + dx, y + dy);
                (0..width).contains(&x)
                    && (0..height).contains(&y)
                    && !pixels[(y * width + x) as usize]
            })
    });
    Image::from_vec(size, in_rim.collect())
}

/// Enclosed gaps in a reflected surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaps {
    /// Gaps at most [`MAX_CRACK_WIDTH`] wide.
    pub cracks: u64,
    /// Pixels in those.
    pub crack_pixels: u64,
    /// Width of the widest of those; 0 without any.
    pub widest_crack: u32,
    /// Wider gaps.
    pub holes: u64,
    /// Where the cracks are.
    pub in_crack: Image<bool>,
}

/// Finds gaps that are enclosed by reflected surface.
///
/// A gap is an 8-connected component of `missing`. It is enclosed if every pixel that touches it
/// (8 neighbours) lies inside the image and is `surface`, that is, a mirror pixel that shows a
/// reflected surface. Its width is the side of the largest square of pixels that fits into it.
pub fn find_cracks(missing: &Image<bool>, surface: &Image<bool>) -> Gaps {
    let size = missing.size();
    let squares = largest_squares(missing);
    let mut gaps = Gaps {
        cracks: 0,
        crack_pixels: 0,
        widest_crack: 0,
        holes: 0,
        in_crack: Image::filled(size, false),
    };
    let mut seen = vec![false; missing.pixels().len()];
    for start in 0..seen.len() {
        if !missing.pixels()[start] || seen[start] {
            continue;
        }
        seen[start] = true;
        let mut component = vec![start];
        let mut enclosed = true;
        let mut next = 0;
        while let Some(&index) = component.get(next) {
            next += 1;
            for neighbour in neighbours(size, index) {
                match neighbour {
                    Some(other) if missing.pixels()[other] => {
                        if !std::mem::replace(&mut seen[other], true) {
                            component.push(other);
                        }
                    }
                    Some(other) => enclosed &= surface.pixels()[other],
                    None => enclosed = false,
                }
            }
        }
        let width = component
            .iter()
            .map(|&index| squares[index])
            .max()
            .unwrap_or(0);
        if enclosed && width <= MAX_CRACK_WIDTH {
            gaps.cracks += 1;
            gaps.crack_pixels += component.len() as u64;
            gaps.widest_crack = gaps.widest_crack.max(width);
            component
                .iter()
                .for_each(|&index| gaps.in_crack.pixels_mut()[index] = true);
        } else if enclosed {
            gaps.holes += 1;
        }
    }
    gaps
}

/// For every pixel the side of the largest square in `mask` whose lower right corner it is.
fn largest_squares(mask: &Image<bool>) -> Vec<u32> {
    let width = mask.size()[0] as usize;
    let mut sides = vec![0; mask.pixels().len()];
    for index in 0..sides.len() {
        if !mask.pixels()[index] {
            continue;
        }
        let on_border = index < width || index % width == 0;
        let around = || {
            sides[index - 1]
                .min(sides[index - width])
                .min(sides[index - width - 1])
        };
        sides[index] = 1 + if on_border { 0 } else { around() };
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `#` surface, `.` missing, anything else neither.
    fn gaps(rows: &[&str]) -> Gaps {
        let size = [rows[0].len() as u32, rows.len() as u32];
        let picture = Image::from_vec(size, rows.concat().into_bytes());
        find_cracks(
            &picture.map(|&byte| byte == b'.'),
            &picture.map(|&byte| byte == b'#'),
        )
    }

    #[test]
    fn a_thin_line_inside_is_one_crack_even_diagonally() {
        let found = gaps(&["######", "#.####", "##.###", "###..#", "######"]);
        assert_eq!(
            (
                found.cracks,
                found.crack_pixels,
                found.widest_crack,
                found.holes
            ),
            (1, 4, 1, 0)
        );
    }

    #[test]
    fn a_gap_at_the_silhouette_or_the_image_edge_is_none() {
        assert_eq!(gaps(&["####", "#. #", "####"]).cracks, 0);
        assert_eq!(gaps(&["####", "#..."]).cracks, 0);
        assert_eq!(gaps(&["####", "####"]).cracks, 0);
    }

    #[test]
    fn a_wide_gap_is_a_hole() {
        let side = MAX_CRACK_WIDTH as usize + 1;
        let full = "#".repeat(side + 2);
        let open = format!("#{}#", ".".repeat(side));
        let mut rows = vec![full.as_str()];
        rows.extend(std::iter::repeat_n(open.as_str(), side));
        rows.push(&full);
        assert_eq!((gaps(&rows).cracks, gaps(&rows).holes), (0, 1));
        rows.remove(1);
        let narrower = gaps(&rows);
        assert_eq!((narrower.cracks, narrower.holes), (1, 0));
        assert_eq!(narrower.widest_crack, MAX_CRACK_WIDTH);
    }

    #[test]
    fn the_rim_is_three_pixels_wide_and_not_along_the_image_edge() {
        let mut mask = Image::filled([10, 3], true);
        for y in 0..3 {
            *mask.at_mut(0, y) = false;
        }
        let row: Vec<bool> = (0..10).map(|x| *rim(&mask).at(x, 1)).collect();
        let expected: Vec<bool> = (0..10).map(|x| (1..=3).contains(&x)).collect();
        assert_eq!(row, expected);
    }
}
