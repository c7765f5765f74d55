//! The truth: the tracer and the exact reflection points against closed forms and each other.

mod common;
mod followed;
mod meshes;
mod mixed;
mod motion;
mod moving;
mod points;
mod scenes;
mod thesis_scenes;
mod tracer;
