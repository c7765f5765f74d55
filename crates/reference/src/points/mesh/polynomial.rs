//! Polynomials over a triangle, in the weights of its corners.
//!
//! A homogeneous polynomial of degree `n` in the weights `(a, b, c)` has a coefficient for each
//! `a^(n−i−j) b^i c^j`. Divided by the multinomial coefficient of these powers, it is a Bernstein
//! coefficient: where no weight is negative, the polynomial's value is a weighted mean of the Bernstein
//! coefficients, and so lies between the least and the greatest of them (Farin, Curves and Surfaces for
//! CAGD, ch. 17).

use std::ops::AddAssign;

use glam::{DMat2, DVec2, DVec3};

/// Coefficients of degree 1, 2, 3, and 4.
pub(super) type Linear<T> = [T; 3];
type Quadratic<T> = [T; 6];
type Cubic<T> = [T; 10];
type Quartic<T> = [T; 15];

/// Where the coefficient of `b^i c^j` stands in degree `n`.
const fn place(n: usize, i: usize, j: usize) -> usize {
    j * (2 * n + 3 - j) / 2 + i
}

/// Powers `(i, j)` of degree `n`, in the order of their places.
const fn powers<const N: usize>(n: usize) -> [(usize, usize); N] {
    let mut powers = [(0, 0); N];
    let (mut j, mut at) = (0, 0);
    while j <= n {
        let mut i = 0;
        while i <= n - j {
            powers[at] = (i, j);
            at += 1;
            i += 1;
        }
        j += 1;
    }
    powers
}

/// The multinomial coefficient `n! / (i! j! (n − i − j)!)` of each coefficient of degree `n`.
const fn multinomials<const N: usize>(n: usize) -> [f64; N] {
    const FACTORIALS: [f64; 5] = [1.0, 1.0, 2.0, 6.0, 24.0];
    let mut ways = [0.0; N];
    let powers: [(usize, usize); N] = powers(n);
    let mut at = 0;
    while at < N {
        let (i, j) = powers[at];
        ways[at] = FACTORIALS[n] / (FACTORIALS[i] * FACTORIALS[j] * FACTORIALS[n - i - j]);
        at += 1;
    }
    ways
}

const QUARTIC: Quartic<(usize, usize)> = powers(4);
const QUARTIC_WAYS: Quartic<f64> = multinomials(4);
const CUBIC: Cubic<(usize, usize)> = powers(3);
const CUBIC_WAYS: Cubic<f64> = multinomials(3);

/// The product of a polynomial of degree 1 and one of degree `n`, by any product of their values.
#[inline(always)]
fn product<A: Copy, B: Copy, C: Copy + Default + AddAssign, const N: usize, const M: usize>(
    one: &Linear<A>,
    n: usize,
    other: &[B; N],
    times: impl Fn(A, B) -> C,
) -> [C; M] {
    let mut result = [C::default(); M];
    let powers: [(usize, usize); N] = powers(n);
    for (at, (i, j)) in powers.into_iter().enumerate() {
        for (corner, (more_i, more_j)) in [(0, 0), (1, 0), (0, 1)].into_iter().enumerate() {
            result[place(n + 1, i + more_i, j + more_j)] += times(one[corner], other[at]);
        }
    }
    result
}

/// How far a mirror's triangle is from reflecting the eye's rays into a vertex: a polynomial of degree
/// 4 with two values, both zero exactly where it does.
///
/// With `d` from the eye to the point, `N` the normal and `w` from the point to the vertex, all linear in
/// the weights, `w × (d (N·N) − 2 (d·N) N)` vanishes where the reflected ray runs through the vertex,
/// forwards or backwards. It is perpendicular to `w`. As long as `w` stays within a right angle of one
/// direction, the product's two components perpendicular to that direction are zero only if the product
/// is.
pub(super) struct Miss {
    bernstein: Quartic<DVec2>,
    /// What rounding may add to a coefficient.
    pub rounding: f64,
}

impl Miss {
    /// Of the triangle with these `d`, `N`, `w` at its corners; `None` where `w` turns too far, that is
    /// where the vertex is very near.
    pub(super) fn new(d: &Linear<DVec3>, n: &Linear<DVec3>, w: &Linear<DVec3>) -> Option<Self> {
        /// Rounding steps in a coefficient, and some.
        const ROUNDING: f64 = 64.0 * f64::EPSILON;
        let towards = w.iter().sum::<DVec3>();
        if w.iter().any(|w| w.dot(towards) <= 0.0) {
            return None;
        }
        let (one, other) = towards.normalize().any_orthonormal_pair();
        let square: Quadratic<f64> = product(n, 1, n, DVec3::dot);
        let along: Quadratic<f64> = product(d, 1, n, DVec3::dot);
        let mut reflected: Cubic<DVec3> = product(d, 2, &square, |d, square| d * square);
        let turned: Cubic<DVec3> = product(n, 2, &along, |n, along| n * along);
        for (reflected, turned) in reflected.iter_mut().zip(turned) {
            *reflected -= 2.0 * turned;
        }
        let across: Quartic<DVec3> = product(w, 3, &reflected, DVec3::cross);
        let mut bernstein = across.map(|across| DVec2::new(across.dot(one), across.dot(other)));
        for (coefficient, ways) in bernstein.iter_mut().zip(QUARTIC_WAYS) {
            *coefficient /= ways;
        }
        let longest =
            |vectors: &Linear<DVec3>| vectors.map(DVec3::length).into_iter().fold(0.0, f64::max);
        Some(Self {
            bernstein,
            rounding: ROUNDING * longest(d) * longest(w) * longest(n).powi(2),
        })
    }

    /// The same, each value mixed anew.
    pub(super) fn mixed(&self, by: DMat2) -> Self {
        let larger = by.x_axis.abs() + by.y_axis.abs();
        Self {
            bernstein: self.bernstein.map(|coefficient| by * coefficient),
            rounding: self.rounding * larger.max_element(),
        }
    }

    /// Whether one of the values is nowhere zero on the triangle.
    pub(super) fn has_no_zero(&self) -> bool {
        let low = self.bernstein.into_iter().fold(DVec2::INFINITY, DVec2::min);
        let high = self
            .bernstein
            .into_iter()
            .fold(DVec2::NEG_INFINITY, DVec2::max);
        low.cmpgt(DVec2::splat(self.rounding)).any()
            || high.cmplt(DVec2::splat(-self.rounding)).any()
    }

    /// The values where the second and third corner have weights `q`.
    pub(super) fn at(&self, q: DVec2) -> DVec2 {
        let powers = |weight: f64| {
            let square = weight * weight;
            [1.0, weight, square, square * weight, square * square]
        };
        let [a, b, c] = [1.0 - q.x - q.y, q.x, q.y].map(powers);
        let mut sum = DVec2::ZERO;
        for (at, (i, j)) in QUARTIC.into_iter().enumerate() {
            sum += QUARTIC_WAYS[at] * a[4 - i - j] * b[i] * c[j] * self.bernstein[at];
        }
        sum
    }

    /// Bernstein coefficients of the derivative by the weights of the second and third corner.
    pub(super) fn derivative(&self) -> Cubic<DMat2> {
        let mut result = [DMat2::ZERO; 10];
        for (derivative, (i, j)) in result.iter_mut().zip(CUBIC) {
            let here = self.bernstein[place(4, i, j)];
            let by_second = self.bernstein[place(4, i + 1, j)] - here;
            let by_third = self.bernstein[place(4, i, j + 1)] - here;
            *derivative = DMat2::from_cols(4.0 * by_second, 4.0 * by_third);
        }
        result
    }
}

/// The value of a derivative in the middle of the triangle.
pub(super) fn in_the_middle(derivative: &Cubic<DMat2>) -> DMat2 {
    let mut sum = DMat2::ZERO;
    for (coefficient, ways) in derivative.iter().zip(CUBIC_WAYS) {
        sum += *coefficient * (ways / 27.0);
    }
    sum
}

#[cfg(test)]
mod tests {
    use catoptric_scene::Random;

    use super::*;

    fn corners(random: &mut Random, about: DVec3) -> Linear<DVec3> {
        [(); 3].map(|()| about + DVec3::from_array([(); 3].map(|()| random.between(-0.3, 0.3))))
    }

    fn mix(corners: &Linear<DVec3>, q: DVec2) -> DVec3 {
        (1.0 - q.x - q.y) * corners[0] + q.x * corners[1] + q.y * corners[2]
    }

    #[test]
    fn values_and_derivatives_are_those_of_the_formula() {
        let mut random = Random::new(3);
        for _ in 0..100 {
            let d = corners(&mut random, DVec3::new(0.0, 0.0, -3.0));
            let n = corners(&mut random, DVec3::Z);
            let w = corners(&mut random, DVec3::new(1.0, 0.0, 2.0));
            let miss = Miss::new(&d, &n, &w).expect("a far vertex");
            let (one, other) = w.iter().sum::<DVec3>().normalize().any_orthonormal_pair();
            let direct = |q: DVec2| {
                let [d, n, w] = [&d, &n, &w].map(|corners| mix(corners, q));
                let across = w.cross(d * n.dot(n) - 2.0 * d.dot(n) * n);
                DVec2::new(across.dot(one), across.dot(other))
            };
            let q = DVec2::new(random.between(0.0, 0.5), random.between(0.0, 0.5));
            assert!((miss.at(q) - direct(q)).length() < 1e-12);
            let step = 1e-5;
            let slope =
                |along: DVec2| (direct(q + step * along) - direct(q - step * along)) / (2.0 * step);
            let slopes = DMat2::from_cols(slope(DVec2::X), slope(DVec2::Y));
            let middle = DVec2::splat(1.0 / 3.0);
            let of = in_the_middle(&miss.derivative());
            let slope = |along: DVec2| {
                (direct(middle + step * along) - direct(middle - step * along)) / (2.0 * step)
            };
            assert!((of.x_axis - slope(DVec2::X)).length() < 1e-7);
            assert!((of.y_axis - slope(DVec2::Y)).length() < 1e-7);
            assert!(slopes.is_finite());
            // All values lie between the coefficients.
            let low = miss.bernstein.into_iter().fold(DVec2::INFINITY, DVec2::min);
            let high = miss
                .bernstein
                .into_iter()
                .fold(DVec2::NEG_INFINITY, DVec2::max);
            let value = miss.at(q);
            assert!(value.cmpge(low - 1e-12).all() && value.cmple(high + 1e-12).all());
        }
    }
}
