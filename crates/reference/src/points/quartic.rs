//! All roots of a complex polynomial, at once.

use std::ops::{Add, Mul, Sub};

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Complex {
    pub const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    pub fn from_angle(angle: f64) -> Self {
        Self::new(angle.cos(), angle.sin())
    }

    pub fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    pub fn abs(self) -> f64 {
        self.re.hypot(self.im)
    }

    pub fn angle(self) -> f64 {
        self.im.atan2(self.re)
    }

    pub fn scale(self, factor: f64) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    fn inverse(self) -> Self {
        self.conj()
            .scale(1.0 / (self.re * self.re + self.im * self.im))
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

/// Roots of `coefficients[4] z⁴ + … + coefficients[0]`, the first not zero, by the iteration of
/// O. Aberth, "Iteration methods for finding all zeros of a polynomial simultaneously",
/// Mathematics of Computation 27, 1973. Simple roots come out to rounding; a double one to its
/// square root.
pub(super) fn roots(coefficients: &[Complex; 5]) -> [Complex; 4] {
    // Not symmetric to anything that the roots may be symmetric to.
    let mut z = [0.4, 1.9, 3.6, 5.2].map(|angle| Complex::from_angle(angle).scale(1.1));
    for _ in 0..100 {
        let mut moved = 0.0f64;
        for i in 0..4 {
            let (mut value, mut slope) = (coefficients[4], Complex::new(0.0, 0.0));
            for coefficient in coefficients[..4].iter().rev() {
                slope = slope * z[i] + value;
                value = value * z[i] + *coefficient;
            }
            if value == Complex::new(0.0, 0.0) {
                continue;
            }
            let others = (0..4)
                .filter(|j| *j != i)
                .map(|j| (z[i] - z[j]).inverse())
                .fold(Complex::new(0.0, 0.0), Complex::add);
            // value / (slope − value · others), without a division by a vanishing slope.
            let step = value * (slope - value * others).inverse();
            if !(step.re.is_finite() && step.im.is_finite()) {
                continue;
            }
            z[i] = z[i] - step;
            moved = moved.max(step.abs() / z[i].abs());
        }
        if moved < 1e-15 {
            break;
        }
    }
    z
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn complex() -> impl Strategy<Value = Complex> {
        (-2.0..2.0, -2.0..2.0).prop_map(|(re, im)| Complex::new(re, im))
    }

    proptest! {
        #[test]
        fn roots_of_a_product_are_found(expected in [complex(), complex(), complex(), complex()]) {
            let mut coefficients = [Complex::new(0.0, 0.0); 5];
            coefficients[0] = Complex::new(1.0, 0.0);
            for (degree, root) in expected.iter().enumerate() {
                for i in (0..=degree).rev() {
                    coefficients[i + 1] = coefficients[i + 1] + coefficients[i];
                    coefficients[i] = coefficients[i] * root.scale(-1.0);
                }
            }
            let found = roots(&coefficients);
            for root in expected {
                let nearest = found.iter().map(|z| (*z - root).abs()).fold(f64::MAX, f64::min);
                prop_assert!(nearest < 1e-4, "{root:?} not in {found:?}");
            }
        }
    }
}
