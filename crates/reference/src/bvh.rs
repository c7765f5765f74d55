//! Triangles in a hierarchy.
