//! Full tessellation: every triangle is split `level` times (Szabo 2013, chapter 5), but for those
//! that are hidden by all their corners.

use super::tessellation::{Rule, Tessellation};
use super::{Context, Refine};
use crate::error::ReflectError;

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
    let options = context.options.expect("a refinement has options");
    let rule = Rule {
        level: options.whole("level"),
        threshold: None,
    };
    Ok(Box::new(Tessellation::new(context, rule)?))
}
