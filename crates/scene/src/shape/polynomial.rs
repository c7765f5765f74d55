//! Real roots of polynomials. Each is enclosed between neighbouring roots of the derivative, which
//! are found in the same way: no root is lost, and none needs a starting value.

/// A short list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Few<const N: usize> {
    numbers: [f64; N],
    count: usize,
}

impl<const N: usize> Few<N> {
    pub(super) const NONE: Self = Self {
        numbers: [0.0; N],
        count: 0,
    };

    pub(super) fn push(&mut self, number: f64) {
        self.numbers[self.count] = number;
        self.count += 1;
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.numbers[..self.count].iter().copied()
    }
}

fn value(polynomial: &[f64], at: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * at + c)
}

/// Roots of a polynomial of degree at most `N`, constant term first, in `[low, high]`.
pub(super) fn between<const N: usize>(polynomial: &[f64], low: f64, high: f64) -> Few<N> {
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
}
