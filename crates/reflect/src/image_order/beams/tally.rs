//! What a frame took, counted.

/// Sums over a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    /// Tests of a cluster's box against a node.
    pub cluster_tests: u64,
    /// Tests of a triangle's box against a node.
    pub triangle_tests: u64,
    /// Of a leaf and a triangle that it may meet.
    pub pairs: u64,
    /// Tests of a ray against a triangle.
    pub exact: u64,
    /// Most of these for one pixel and part of a tile.
    pub longest: u64,
    /// Parts of tiles.
    pub parts: u64,
    /// Bytes of the lists, and of what the parts met.
    pub bytes: u64,
}

impl Tally {
    /// For the reader of a frame's numbers; `triangles`: of the scene, sent down in so many `slices`.
    pub(super) fn sentences(&self, triangles: u32, slices: usize) -> Vec<String> {
        let each = |count: u64| count as f64 / f64::from(triangles.max(1));
        let mut sentences = vec![format!(
            "beams: {:.1} node tests of clusters and {:.1} of triangles for each of {triangles} triangles; \
             {} pairs of a leaf and a triangle, at most {} a leaf; {} parts of tiles; {} bytes of lists",
            each(self.cluster_tests),
            each(self.triangle_tests),
            self.pairs,
            self.longest,
            self.parts,
            self.bytes,
        )];
        if slices > 1 {
            sentences.push(format!(
                "beams: the triangles are sent down in {slices} parts, since the lists have room for no more"
            ));
        }
        sentences
    }
}
