//! Newton's method on the G-buffer, between pixels: the field of tangential parts of the bisector
//! is 0 at a reflection point, and its derivatives follow from those of position and normal.
//! Sub-pixel answers from the same buffers that the published searches read.

use super::start::{FromStart, Start};
use super::{Context, Recipe, Search};
use crate::error::ReflectError;
use crate::options::options;
use crate::technique::{Info, Named, Properties};

options! {
    /// The search, as its options describe it.
    pub(crate) struct Newton {
        /// where the iteration starts: the mirror's projected centre, its projected bounding box's,
        /// or the previous frame's answer
        start: Start,
    }
}

impl Named for Newton {
    const INFO: Info = Info {
        name: "newton",
        what: "Newton's method on the G-buffer, sub-pixel",
        paper: "this project",
    };
}

impl Recipe for Newton {
    fn properties(&self) -> Properties {
        Properties {
            carries_over: self.start == Start::Previous,
            ..Properties::default()
        }
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
        let features = context.extends.then_some("extend");
        let search = FromStart::new(context, self.start, "newton", features.as_slice())?;
        Ok(Box::new(search))
    }
}
