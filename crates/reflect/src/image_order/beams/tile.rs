//! The smallest nodes.

use crate::options::words;

words! {
    /// Pixels along the side of a leaf.
    pub(crate) enum Tile {
        Two = "2",
        Four = "4",
        Eight = "8",
    }
}
