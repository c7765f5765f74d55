//! Adaptive tessellation: a triangle is split while the error of one of its edges reaches
//! `threshold`, at most `level` times (Szabo 2013, chapter 5; Szabo CESCG, section 4.2).

use super::tessellation::{Rule, Tessellation};
use super::{Context, Refine};
use crate::error::ReflectError;

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
    let options = context.options.expect("a refinement has options");
    let rule = Rule {
        level: options.whole("level"),
        threshold: Some(options.number("threshold") as f32),
    };
    Ok(Box::new(Tessellation::new(context, rule)?))
}
