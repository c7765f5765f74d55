//! What is made of records and frames: tables, plots, sentences, pages and pictures. Nothing here
//! measures.

pub mod changes;
mod diagrams;
pub mod facts;
pub mod html;
pub mod junit;
pub mod layers;
pub mod look;
pub mod number;
pub mod page;
pub mod pair;
pub mod pictures;
pub mod plot;
pub mod print;
pub mod records;
pub mod runs;
pub mod summary;
pub mod table;
mod views;
pub mod words;
