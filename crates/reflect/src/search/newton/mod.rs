//! Newton's method on the G-buffer, between pixels: the field of tangential parts of the bisector
//! is 0 at a reflection point, and its derivatives follow from those of position and normal.
//! Sub-pixel answers from the same buffers that the published searches read.

use super::start::FromStart;
use super::{Context, Search};
use crate::error::ReflectError;

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
    let mut features = Vec::new();
    if context.options.is("hidden", "extend") {
        features.push("extend");
    }
    Ok(Box::new(FromStart::new(context, "newton", &features)?))
}
