//! Scenes, meshes and shapes: what a file means, and what is said of a wrong one.

mod builtin;
mod errors;
mod meshes;
mod messages;
mod motion;
mod obj;
mod parser;
mod surfaces;
