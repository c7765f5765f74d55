//! What a frame took, counted.

/// Sums over a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    /// Tests of a cluster's box against a node.
    pub cluster_tests: u64,
    /// Tests of a triangle's box against a node.
    pub triangle_tests: u64,
    /// Pairs of a leaf and a triangle that it may meet.
    pub pairs: u64,
    /// Tests of a ray against a triangle.
    pub exact: u64,
    /// Most of these for one pixel and part of a tile.
    pub longest: u64,
    /// Bytes of the lists, and of what the parts met.
    pub bytes: u64,
}
