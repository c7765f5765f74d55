//! How far reflected edges lie from where they should be.
//!
//! An edge point lies between two neighbouring mirror pixels that show different objects (the
//! background counts as one). Straight edges that a technique fails to bend lie far from the truth's;
//! so do the edges of cracks and of what is missing, which the truth does not have.

use catoptric_frame::Reflected;

use crate::coverage::Layers;
use crate::stats::Summary;

/// Distances in pixels from every edge point of the one picture to the nearest of the other, both
/// ways; `None` unless both have edges. Points where an object reaches the mirror's outline are only
/// measured to, not from: the outline is the same in both pictures.
pub(crate) fn edge_offset(layers: &Layers) -> Option<Summary> {
    let pictures = [layers.reference, layers.test];
    let edges = pictures.map(|layer| edge_points(layers, layer, false));
    if edges.iter().any(Vec::is_empty) {
        return None;
    }
    let [in_reference, in_test] = pictures.map(|layer| edge_points(layers, layer, true));
    let size = layers.size.map(|side| 2 * side as usize + 1);
    let from = |points: &[usize], to: &[usize]| -> Vec<f64> {
        let squares = distances(size, to);
        let points = points.iter();
        // The grid has two steps a pixel.
        points.map(|&at| squares[at].sqrt() / 2.0).collect()
    };
    Summary::of([from(&edges[0], &in_test), from(&edges[1], &in_reference)].concat())
}

/// Indices of a layer's edge points in a grid of half pixels, `2 · width + 1` by `2 · height + 1`;
/// `outline` adds the points where an object reaches the mirror's outline.
fn edge_points(layers: &Layers, layer: &Reflected, outline: bool) -> Vec<usize> {
    let [width, height] = layers.size.map(|side| side as usize);
    let id = |x: usize, y: usize| {
        let index = y * width + x;
        layers.mask.pixels()[index].then(|| layer.id.pixels()[index])
    };
    let differ = |a: Option<u32>, b: Option<u32>| match (a, b) {
        (Some(a), Some(b)) => a != b,
        // Nothing is beyond the outline, as in the background.
        (Some(id), None) | (None, Some(id)) => outline && id != 0,
        (None, None) => false,
    };
    let mut points = Vec::new();
    for y in 0..height {
        for x in 0..width {
            if x + 1 < width && differ(id(x, y), id(x + 1, y)) {
                points.push((2 * y + 1) * (2 * width + 1) + 2 * x + 2);
            }
            if y + 1 < height && differ(id(x, y), id(x, y + 1)) {
                points.push((2 * y + 2) * (2 * width + 1) + 2 * x + 1);
            }
        }
    }
    points
}

/// Square of the distance from every point of a grid to the nearest of `points`: along the
/// columns, then along the rows.
fn distances([width, height]: [usize; 2], points: &[usize]) -> Vec<f64> {
    // Farther than any two points of the grid, and exact.
    let far = ((width + height) as f64).powi(2);
    let mut squares = vec![far; width * height];
    for &point in points {
        squares[point] = 0.0;
    }
    let mut column = vec![0.0; height];
    for x in 0..width {
        for y in 0..height {
            column[y] = squares[y * width + x];
        }
        for (y, square) in lower_envelope(&column).into_iter().enumerate() {
            squares[y * width + x] = square;
        }
    }
    for row in squares.chunks_exact_mut(width) {
        let nearest = lower_envelope(row);
        row.copy_from_slice(&nearest);
    }
    squares
}

/// For every place the least of `(place - other)² + heights[other]` over all others: the lower
/// envelope of parabolas (Felzenszwalb and Huttenlocher 2012).
fn lower_envelope(heights: &[f64]) -> Vec<f64> {
    // Parabolas of the envelope from left to right, and where each begins.
    let mut envelope: Vec<(usize, f64)> = Vec::new();
    for (place, height) in heights.iter().enumerate() {
        let begin = loop {
            let Some(&(last, begun)) = envelope.last() else {
                break f64::NEG_INFINITY;
            };
            let (here, there) = (place as f64, last as f64);
            let meet =
                ((height + here * here) - (heights[last] + there * there)) / (2.0 * (here - there));
            if meet > begun {
                break meet;
            }
            envelope.pop();
        };
        envelope.push((place, begin));
    }
    let mut current = 0;
    let at = |place: usize| {
        while envelope
            .get(current + 1)
            .is_some_and(|next| next.1 <= place as f64)
        {
            current += 1;
        }
        let (nearest, _) = envelope[current];
        let offset = place as f64 - nearest as f64;
        offset * offset + heights[nearest]
    };
    (0..heights.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_a_search_over_all_points() {
        let size = [23, 17];
        let points = [5, 60, 61, 200, 389];
        let place = |point: usize| ((point % size[0]) as f64, (point / size[0]) as f64);
        for (index, square) in distances(size, &points).into_iter().enumerate() {
            let (x, y) = place(index);
            let squares = points.map(|point| {
                let (px, py) = place(point);
                (x - px) * (x - px) + (y - py) * (y - py)
            });
            let nearest = squares.into_iter().fold(f64::INFINITY, f64::min);
            assert_eq!(square, nearest, "{index}");
        }
    }
}
