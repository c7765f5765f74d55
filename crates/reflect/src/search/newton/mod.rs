//! Newton's method on the G-buffer, at subpixel positions: the tangential part of the bisector is 0 at a
//! reflection point, and its derivatives follow from those of position and normal. It reads the same
//! buffers as the published searches.

mod tiles;

use super::start::{self, FromStart};
use super::{Context, Recipe, Search};
use crate::error::ReflectError;
use crate::options::{options, words};
use crate::technique::{Info, Named, Properties};
use tiles::FromTiles;

words! {
    /// Where the iteration starts.
    pub(crate) enum Start {
        /// At the best of a coarse sample of the mirror.
        Tile = "tile",
        /// The mirror's projected middle.
        Center = "center",
        /// Its projected bounding box's.
        Bounds = "bounds",
        /// The vertex's answer in the previous frame, where there is one; else as for `tile`.
        Previous = "previous",
    }
}

options! {
    /// The search, as its options describe it.
    pub(crate) struct Newton {
        /// where the iteration starts: the best of nine places spread over the mirror (then the next best,
        /// where it leads nowhere), the mirror's projected centre, its projected bounding box's, or the
        /// previous frame's answer
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
        let from = match self.start {
            Start::Tile | Start::Previous => None,
            Start::Center => Some(start::Start::Center),
            Start::Bounds => Some(start::Start::Bounds),
        };
        let features = [(context.extends, "extend"), (from.is_none(), "tiles")];
        let features = features.into_iter().filter(|(on, _)| *on);
        let features: Vec<_> = features.map(|(_, name)| name).collect();
        Ok(match from {
            None => Box::new(FromTiles::new(context, "newton", &features)?),
            Some(from) => Box::new(FromStart::new(context, from, "newton", &features)?),
        })
    }
}
