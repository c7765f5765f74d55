//! Where a line meets a torus.
//!
//! With the torus' axis `a` through the origin, radii `R` and `r`, and the line `q + s d` with `q`
//! its point closest to the origin, the surface's equation
//! `(|p|² + R² − r²)² = 4R² (|p|² − (p·a)²)` becomes a quartic in `s` without a cubic term. Its
//! roots are enclosed between those of its derivative, which are enclosed likewise, so none is
//! lost and none needs a start; each is then polished on the distance to the surface.

use glam::DVec3;

/// At most four numbers, ascending.
pub(crate) type Roots = Few<4>;

/// A short list.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Few<const N: usize> {
    numbers: [f64; N],
    count: usize,
}

impl<const N: usize> Few<N> {
    const NONE: Self = Self {
        numbers: [0.0; N],
        count: 0,
    };

    fn push(&mut self, number: f64) {
        self.numbers[self.count] = number;
        self.count += 1;
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.numbers[..self.count].iter().copied()
    }
}

/// Signed distance of a point to the surface around the unit `axis`, negative inside, and the
/// outward unit normal there. On the axis, where no direction is nearest, any normal will do.
pub(crate) fn distance(point: DVec3, axis: DVec3, major: f64, minor: f64) -> (f64, DVec3) {
    let height = point.dot(axis);
    let radial = point - height * axis;
    let outward = radial
        .try_normalize()
        .unwrap_or_else(|| axis.any_orthonormal_vector());
    let from_ring = point - major * outward;
    let normal = from_ring.try_normalize().unwrap_or(axis);
    (from_ring.length() - minor, normal)
}

/// Where the line `origin + t · dir` (`dir` of unit length) meets the torus around the origin.
/// Where it only touches, it may count as meeting twice or not at all.
pub(crate) fn roots(origin: DVec3, dir: DVec3, axis: DVec3, major: f64, minor: f64) -> Roots {
    let size = major + minor;
    let (ring, tube) = (major / size, minor / size);
    let start = -origin.dot(dir);
    let nearest = (origin + start * dir) / size;
    // Again, for what rounding leaves along the line when the origin is far away.
    let nearest = nearest - nearest.dot(dir) * dir;
    let square = nearest.length_squared();
    let mut found = Roots::NONE;
    // A little more than the sphere around all, on which roots lie where the equator is met.
    let reach = (1.0 + 1e-6 - square).sqrt();
    if reach.is_nan() {
        return found;
    }
    let (height, slope) = (nearest.dot(axis), dir.dot(axis));
    let k = square + (ring - tube) * (ring + tube);
    let ring4 = 4.0 * ring * ring;
    let quartic = [
        k * k - ring4 * (square - height * height),
        2.0 * ring4 * height * slope,
        2.0 * k - ring4 * (1.0 - slope) * (1.0 + slope),
        0.0,
        1.0,
    ];
    let unpolished = between::<4>(&quartic, -reach, reach);
    let mut last = f64::NEG_INFINITY;
    for s in unpolished.iter() {
        let s = polish(s, nearest, dir, axis, ring, tube).max(last);
        last = s;
        found.push(start + s * size);
    }
    found
}

/// Newton's steps on the distance, as long as they get closer.
fn polish(start: f64, nearest: DVec3, dir: DVec3, axis: DVec3, ring: f64, tube: f64) -> f64 {
    let at = |s: f64| distance(nearest + s * dir, axis, ring, tube);
    let mut s = start;
    let (mut off, mut normal) = at(s);
    for _ in 0..4 {
        let next = s - off / normal.dot(dir);
        let (next_off, next_normal) = at(next);
        // Not where the line grazes: there the step may lead to another root.
        if !((next - s).abs() < 1e-6 && next_off.abs() < off.abs()) {
            break;
        }
        (s, off, normal) = (next, next_off, next_normal);
    }
    s
}

fn value(polynomial: &[f64], at: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * at + c)
}

/// Roots of a polynomial of degree at most `N`, constant term first, in `[low, high]`.
fn between<const N: usize>(polynomial: &[f64], low: f64, high: f64) -> Few<N> {
    let mut found = Few::NONE;
    let degree = polynomial.len() - 1;
    if degree == 0 {
        return found;
    }
    let mut slope = [0.0; N];
    for (power, coefficient) in polynomial.iter().enumerate().skip(1) {
        slope[power - 1] = power as f64 * coefficient;
    }
    let turns = between::<N>(&slope[..degree], low, high);
    let mut left = low;
    for right in turns.iter().chain([high]) {
        if let Some(root) = bracketed(polynomial, &slope[..degree], left, right) {
            found.push(root);
        }
        left = right;
    }
    found
}

/// The root between two points of unlike sign, between which the polynomial is monotone: Newton's
/// steps, and halving where they leave the bracket.
fn bracketed(polynomial: &[f64], slope: &[f64], low: f64, high: f64) -> Option<f64> {
    let (mut low, mut high) = (low, high);
    let rising = value(polynomial, low);
    if rising == 0.0 || rising.signum() == value(polynomial, high).signum() {
        return None;
    }
    let mut at = (low + high) / 2.0;
    for _ in 0..100 {
        let here = value(polynomial, at);
        if here == 0.0 {
            break;
        }
        if here.signum() == rising.signum() {
            low = at;
        } else {
            high = at;
        }
        let newton = at - here / value(slope, at);
        let next = if newton > low && newton < high {
            newton
        } else {
            (low + high) / 2.0
        };
        if (next - at).abs() <= f64::EPSILON * at.abs() {
            break;
        }
        at = next;
    }
    Some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_products_are_found_in_order() {
        // (s − ½)(s + ½)(s − ¼)(s + 2) and (s² + 1)(s − 0.1).
        let first = [0.125, -0.4375, -0.75, 1.75, 1.0];
        let found: Vec<f64> = between::<4>(&first, -1.0, 1.0).iter().collect();
        assert_eq!(found.len(), 3);
        for (root, expected) in found.iter().zip([-0.5, 0.25, 0.5]) {
            assert!((root - expected).abs() < 1e-15, "{root}");
        }
        let second: Vec<f64> = between::<4>(&[-0.1, 1.0, -0.1, 1.0], -1.0, 1.0)
            .iter()
            .collect();
        assert!(second.len() == 1 && (second[0] - 0.1).abs() < 1e-15);
    }

    #[test]
    fn a_line_through_the_tube_twice_meets_it_four_times() {
        let origin = DVec3::new(-1e6, 0.05, 0.0);
        let found: Vec<f64> = roots(origin, DVec3::X, DVec3::Y, 1.0, 0.25)
            .iter()
            .collect();
        let half = (0.25f64 * 0.25 - 0.05 * 0.05).sqrt();
        let expected = [-1.0 - half, -1.0 + half, 1.0 - half, 1.0 + half];
        assert_eq!(found.len(), 4);
        for (t, x) in found.iter().zip(expected) {
            assert!((t - 1e6 - x).abs() < 1e-9, "{t}");
        }
    }
}
