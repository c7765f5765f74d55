//! Separable convolution of four channels at once, each with its own kernel; beyond the border the
//! nearest pixel counts.

use catoptric_frame::Image;
use glam::DVec4;
use rayon::prelude::*;

/// One-dimensional kernel of odd length, centred; a weight per channel.
pub(crate) type Kernel = [DVec4];

/// Gaussian weights for integer offsets `-radius..=radius`, not normalized.
pub(crate) fn gaussian(sigma: f64, radius: usize) -> impl Iterator<Item = (f64, f64)> {
    offsets(radius).map(move |x| (x, (-x * x / (2.0 * sigma * sigma)).exp()))
}

/// The integer offsets `-radius..=radius`.
pub(crate) fn offsets(radius: usize) -> impl Iterator<Item = f64> {
    (0..=2 * radius).map(move |index| index as f64 - radius as f64)
}

/// Convolves along the rows. (Correlates, rather: the kernel is not mirrored.)
pub(crate) fn along_x(image: &Image<DVec4>, kernel: &Kernel) -> Image<DVec4> {
    let [width, height] = image.size();
    let (columns, radius) = (width as usize, kernel.len() / 2);
    let mut filtered = Image::filled([width, height], DVec4::ZERO);
    if columns == 0 {
        return filtered;
    }
    let rows = filtered.pixels_mut().par_chunks_mut(columns);
    rows.zip(image.pixels().par_chunks(columns)).for_each_init(
        || vec![DVec4::ZERO; columns + 2 * radius],
        |padded, (filtered, row)| {
            padded[..radius].fill(row[0]);
            padded[radius..radius + columns].copy_from_slice(row);
            padded[radius + columns..].fill(row[columns - 1]);
            for (x, pixel) in filtered.iter_mut().enumerate() {
                let window = &padded[x..x + kernel.len()];
                *pixel = window
                    .iter()
                    .zip(kernel)
                    .map(|(&pixel, &weight)| pixel * weight)
                    .sum();
            }
        },
    );
    filtered
}

/// Convolves along the columns.
pub(crate) fn along_y(image: &Image<DVec4>, kernel: &Kernel) -> Image<DVec4> {
    let [width, height] = image.size();
    let (columns, last_row) = (width as usize, (height as usize).saturating_sub(1));
    let mut filtered = Image::filled([width, height], DVec4::ZERO);
    if columns == 0 {
        return filtered;
    }
    filtered
        .pixels_mut()
        .par_chunks_mut(columns)
        .enumerate()
        .for_each(|(y, filtered)| {
            for (index, &weight) in kernel.iter().enumerate() {
                let source = (y + index).saturating_sub(kernel.len() / 2).min(last_row);
                let row = &image.pixels()[source * columns..][..columns];
                for (sum, &pixel) in filtered.iter_mut().zip(row) {
                    *sum += pixel * weight;
                }
            }
        });
    filtered
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_directions_shift_alike_and_repeat_the_border() {
        let kernel = [0.0, 0.0, 1.0].map(DVec4::splat);
        let ramp = |size| Image::from_vec(size, [1.0, 2.0, 4.0].map(DVec4::splat).to_vec());
        let expected = [2.0, 4.0, 4.0].map(DVec4::splat);
        assert_eq!(along_x(&ramp([3, 1]), &kernel).pixels(), expected);
        assert_eq!(along_y(&ramp([1, 3]), &kernel).pixels(), expected);
        assert_eq!(along_x(&ramp([1, 3]), &kernel), ramp([1, 3]));
    }
}
