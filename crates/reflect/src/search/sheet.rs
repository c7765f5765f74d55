//! Several reflections of one vertex in one mirror.
//!
//! In a concave mirror a vertex may be seen more than once. Its reflections are told apart by how many
//! focal points of the reflected beam lie before the vertex: none for the upright image, two for the
//! inverted one, one between the two. Each such *sheet* of images is smooth, so that it is searched,
//! refined and drawn as if it were a mirror's only one.

use super::Search;

/// One of the reflections that a search looks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sheet {
    /// Index of the mirror.
    pub mirror: usize,
    /// Which of the mirror's own sheets; what it stands for is the search's to say.
    pub number: usize,
    /// Place among all sheets, mirrors outer.
    pub index: usize,
}

impl Sheet {
    /// All sheets of a search on so many mirrors, mirrors outer.
    pub(crate) fn all(search: &dyn Search, mirrors: usize) -> Vec<Self> {
        let of = |mirror| (0..search.sheets(mirror)).map(move |number| (mirror, number));
        let all = (0..mirrors).flat_map(of).enumerate();
        all.map(|(index, (mirror, number))| Self {
            mirror,
            number,
            index,
        })
        .collect()
    }
}
