//! Records that the loop's kernels share, as `tessellation/kernels.wesl` and `shared/triangle.wesl` read
//! them.

use encase::ShaderType;
use glam::{UVec3, UVec4};

/// Twin of `Settings` in `tessellation/kernels.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Settings {
    pub threshold: f32,
    pub level: u32,
}

/// Twin of `Chunk` in `tessellation/kernels.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Chunk {
    pub first: u32,
    pub count: u32,
}

/// Twin of `Level` in `tessellation/kernels.wesl`, as far as the CPU reads it.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Level {
    pub groups: UVec3,
    pub count: u32,
    pub draw: UVec4,
    pub finished: u32,
    pub points: u32,
    pub splits: u32,
    pub index: u32,
}

/// Twin of `Totals` in `tessellation/kernels.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Totals {
    pub by_level: [u32; 12],
    pub points: u32,
    pub unfinished: u32,
}

/// Twin of `Triangle` in `shared/triangle.wesl`: a piece of one of the scene's triangles.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Piece {
    /// Corners: scene vertices, or with [`Piece::NEW`] points of the refinement.
    pub points: UVec3,
    /// The scene's triangle.
    pub source: u32,
    /// Where the corners lie in the source: weights of its second and third corner, 16 bits each.
    pub places: UVec3,
    /// How often the source was split.
    pub level: u32,
}

impl Piece {
    /// Marks a point as one of the refinement's.
    pub const NEW: u32 = 1 << 31;
    /// The bits of `level` that say how often the source was split; those above are for drawing.
    pub const LEVEL: u32 = 0xff;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn records_lie_as_the_shaders_read_them() {
        let program = "tessellation/kernels";
        assert_layout!(Settings { threshold, level }, program, &[], "Settings");
        assert_layout!(Chunk { first, count }, program, &[], "Chunk");
        assert_layout!(
            Level {
                groups,
                count,
                draw,
                finished,
                points,
                splits,
                index
            },
            program,
            &[],
            "Level"
        );
        assert_layout!(
            Totals {
                by_level,
                points,
                unfinished
            },
            program,
            &[],
            "Totals"
        );
        assert_layout!(
            Piece {
                points,
                source,
                places,
                level
            },
            "stage/virtual",
            &["split"],
            "Triangle"
        );
    }
}
