//! Triangles that coincide, corner by corner. A ray sees only one of them, and a hierarchy must not
//! hold thousands of them.

use glam::Vec3;

/// Whether each of `count` triangles is the first with its three corners, whatever their order, and
/// with its mark: triangles with different marks are told apart though they coincide.
pub fn first_of_coincident(
    count: usize,
    triangle: impl Fn(usize) -> ([Vec3; 3], bool),
) -> Vec<bool> {
    let key = |index: usize| {
        let (corners, mark) = triangle(index);
        // Adding zero turns −0 into +0.
        let mut corners = corners.map(|corner| (corner + Vec3::ZERO).to_array().map(f32::to_bits));
        corners.sort_unstable();
        (corners, mark)
    };
    // It only has to keep most of those apart that differ.
    let hash = |index: u32| {
        let (corners, mark) = key(index as usize);
        let words = corners.as_flattened().iter().copied();
        let mixed = words.chain([u32::from(mark)]).fold(0_u64, |sum, word| {
            (sum ^ u64::from(word))
                .wrapping_mul(0x9e37_79b9_7f4a_7c15)
                .rotate_left(29)
        });
        (mixed, index)
    };
    let mut by_hash: Vec<(u64, u32)> = (0..count as u32).map(hash).collect();
    by_hash.sort_unstable();
    let mut first = vec![false; count];
    for alike in by_hash.chunk_by(|(a, _), (b, _)| a == b) {
        if let [(_, index)] = alike {
            first[*index as usize] = true;
            continue;
        }
        // Other triangles may share a hash.
        let mut kept = Vec::new();
        for (_, index) in alike {
            let index = *index as usize;
            let key = key(index);
            if !kept.contains(&key) {
                kept.push(key);
                first[index] = true;
            }
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_stays_whatever_the_order_of_corners() {
        let [a, b, c, d] = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let triangles = [
            ([a, b, c], false),
            ([c, a, b], false),
            ([-a, c, b], false),
            ([a, b, d], false),
            ([c, b, a], true),
            ([a, b, c], true),
        ];
        let first = first_of_coincident(triangles.len(), |index| triangles[index]);
        assert_eq!(first, [true, false, false, true, true, false]);
    }
}
