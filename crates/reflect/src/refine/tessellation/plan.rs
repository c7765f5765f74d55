//! How much of a scene is tessellated at a time, so that every buffer fits the device.

use encase::ShaderSize;

use super::records::Piece;
use crate::stage::points::Found;

/// Most triangles in a chunk: bounds a frame's buffers at about 250 MB, even where the device
/// would take more.
const MOST_TRIANGLES: u64 = 1 << 21;

/// Deepest level that the options allow: of one triangle, 65,536 pieces.
pub(crate) const DEEPEST: u32 = 8;

/// Sizes of buffers, in records, and the chunks that share them. A chunk's worst case, every
/// triangle split `level` times, fits: nothing is ever dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Plan {
    /// How often a triangle may be split.
    pub level: u32,
    /// The scene's triangles.
    pub triangles: u32,
    /// The scene's triangles in a chunk; the last chunk may have fewer.
    pub chunk: u32,
}

impl Plan {
    /// `binding` is the largest buffer that a shader may see, in bytes.
    pub(super) fn new(triangles: u32, level: u32, binding: u64) -> Self {
        assert!(level <= DEEPEST, "the options allow {DEEPEST} levels");
        let record = Piece::SHADER_SIZE.max(Found::SHADER_SIZE).get();
        let records = (binding / record).min(MOST_TRIANGLES);
        let chunk = (records / 4_u64.pow(level)).clamp(1, u64::from(triangles.max(1)));
        Self {
            level,
            triangles,
            chunk: chunk as u32,
        }
    }

    /// First triangle and number of triangles of each chunk.
    pub(super) fn chunks(self) -> impl Iterator<Item = [u32; 2]> {
        (0..self.triangles)
            .step_by(self.chunk as usize)
            .map(move |first| [first, self.chunk.min(self.triangles - first)])
    }

    /// Most triangles of a chunk that a level works on.
    pub(super) fn at(self, level: u32) -> u32 {
        self.chunk * 4_u32.pow(level)
    }

    /// Most new points of a chunk: three a split.
    pub(super) fn points(self) -> u32 {
        self.at(self.level) - self.chunk
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a device gives by default.
    const BINDING: u64 = 128 << 20;

    #[test]
    fn chunks_cover_the_scene_once_and_fit_the_device() {
        for (triangles, level) in [(0, 3), (2, 0), (2, 8), (19_000, 4), (262_267, 5), (7, 8)] {
            let plan = Plan::new(triangles, level, BINDING);
            let mut next = 0;
            for [first, count] in plan.chunks() {
                assert_eq!(first, next);
                assert!(count > 0 && count <= plan.chunk);
                next += count;
            }
            assert_eq!(next, triangles);
            let record = Piece::SHADER_SIZE.max(Found::SHADER_SIZE).get();
            assert!(u64::from(plan.at(level)) * record <= BINDING);
            assert!(plan.points() < plan.at(level) || triangles == 0);
        }
    }

    #[test]
    fn a_small_device_takes_smaller_chunks() {
        let small = Plan::new(19_000, 4, 1 << 20);
        // 256 answers of 48 bytes a triangle.
        assert_eq!(small.chunk, 85);
        assert_eq!(small.chunks().count(), 19_000_usize.div_ceil(85));
    }
}
