//! What can go wrong here.

/// Why a scene cannot be traced. A loaded scene never gives one; a scene built by hand may.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReferenceError {
    /// A triangle refers to a position or a material that does not exist.
    #[error("`{surface}`: triangle {triangle}: {what} {index} of {count}")]
    Index {
        /// Name of the object or mirror.
        surface: String,
        /// Index of the triangle.
        triangle: usize,
        /// `position` or `material`.
        what: &'static str,
        /// The index found.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// A per-triangle attribute is needed, and there is not one for each triangle.
    #[error("`{surface}`: {found} {what} for {triangles} triangles")]
    Attribute {
        /// Name of the object or mirror.
        surface: String,
        /// Which attribute.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many are needed.
        triangles: usize,
    },
    /// A position is infinite or not a number.
    #[error("`{surface}`: position {index} is not finite")]
    NotFinite {
        /// Name of the object or mirror.
        surface: String,
        /// Index of the position.
        index: usize,
    },
}

/// Why the exact reflection points of a mirror cannot be given.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("exact reflection points are not available: {0}")]
pub struct NotAvailable(
    /// The reason.
    pub String,
);
