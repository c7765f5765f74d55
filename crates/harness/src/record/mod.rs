//! What was measured: rows, their file, their schema, and what is asked of their numbers.
//!
//! The lowest layer of the program: nothing here knows how a number is measured or shown.

pub mod against;
pub mod delta;
pub mod file;
pub mod gate;
pub mod joined;
pub mod metric;
pub mod metrics;
pub mod path;
pub mod row;
pub mod schema;
mod table;
pub mod technique;
#[cfg(test)]
pub(crate) mod tests;

pub use file::{read, text, write};
pub use row::{
    Adapter, AgainstFull, Meta, Raw, Record, SCHEMA_VERSION, Status, Steadiness, Times, Wall,
};
