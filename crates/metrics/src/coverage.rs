//! Which mirror pixels show a surface.
