//! Every technique, a line each.

use crate::options::{Options, Settled};
use crate::spec::{self, Spec};
use crate::stage::options::{SearchOptions, StageOptions};
use crate::technique::{Family, Info, Named, Properties, TechniqueInfo};
use crate::{image_order, motion, refine, search};

/// All techniques, in the order in which they are listed.
static TECHNIQUES: &[Technique] = &[
    search::<search::linear::Linear>(),
    search::<search::ray_hierarchy::RayHierarchy>(),
    search::<search::reflector_cubemap::ReflectorCubemap>(),
    search::<search::newton::Newton>(),
    search::<search::swept_boxes::SweptBoxes>(),
    refinement::<refine::full::Full>(),
    refinement::<refine::adaptive::Adaptive>(),
    refinement::<refine::grid::Grid>(),
    refinement::<refine::pixel::Pixel>(),
    image_order::<image_order::environment_map::EnvironmentMap>(),
    image_order::<image_order::planar::Planar>(),
    image_order::<image_order::cubemap_trace::CubemapTrace>(),
    image_order::<image_order::ray_trace::RayTrace>(),
    image_order::<image_order::beams::Beams>(),
    motion::<motion::none::None>(),
    motion::<motion::surface::Surface>(),
    motion::<motion::flat::Flat>(),
    motion::<motion::lens::Lens>(),
    motion::<motion::newton::Newton>(),
];

/// A technique of the list.
struct Technique {
    info: TechniqueInfo,
    read: Read,
}

/// What reads a technique's options.
#[derive(Clone, Copy, Debug)]
enum Read {
    Search(fn(&mut Settled<'_>) -> search::Asked),
    Refinement(fn(&mut Settled<'_>) -> Box<dyn refine::Recipe>),
    ImageOrder(fn(&mut Settled<'_>) -> image_order::Asked),
    Motion(fn(&mut Settled<'_>) -> motion::Asked),
}

const fn search<T: Named + search::Recipe + 'static>() -> Technique {
    Technique {
        info: TechniqueInfo {
            options: [T::TABLE, SearchOptions::TABLE],
            properties: |values| search::Asked::read::<T>(values).properties(),
            ..introduced(T::INFO, Family::Search)
        },
        read: Read::Search(search::Asked::read::<T>),
    }
}

const fn refinement<T: Named + refine::Recipe + 'static>() -> Technique {
    Technique {
        info: TechniqueInfo {
            options: [T::TABLE, &[]],
            properties: |values| T::read(values).properties(),
            ..introduced(T::INFO, Family::Refinement)
        },
        read: Read::Refinement(|values| Box::new(T::read(values))),
    }
}

const fn image_order<T: Named + image_order::Recipe + 'static>() -> Technique {
    Technique {
        info: TechniqueInfo {
            options: [T::TABLE, StageOptions::TABLE],
            properties: |values| image_order::Asked::read::<T>(values).properties(),
            ..introduced(T::INFO, Family::ImageOrder)
        },
        read: Read::ImageOrder(image_order::Asked::read::<T>),
    }
}

const fn motion<T: Named + motion::Recipe + 'static>() -> Technique {
    Technique {
        info: TechniqueInfo {
            options: [T::TABLE, StageOptions::TABLE],
            properties: |_| Properties {
                estimates_motion: true,
                ..Properties::NONE
            },
            ..introduced(T::INFO, Family::Motion)
        },
        read: Read::Motion(motion::Asked::read::<T>),
    }
}

const fn introduced(info: Info, family: Family) -> TechniqueInfo {
    TechniqueInfo {
        name: info.name,
        what: info.what,
        family,
        paper: info.paper,
        options: [&[]; 2],
        properties: |_| Properties::NONE,
    }
}

/// All techniques, for listing.
pub fn list() -> Vec<&'static TechniqueInfo> {
    TECHNIQUES.iter().map(|technique| &technique.info).collect()
}

/// What the name of a technique asks for.
pub(crate) enum Asked {
    /// A search with a refinement.
    ObjectOrder(search::Asked, Box<dyn refine::Recipe>),
    ImageOrder(image_order::Asked),
    Motion(motion::Asked),
}

/// Reads the options of a technique and of its refinement.
///
/// # Panics
/// On a [`Spec`] that was not parsed with [`list`].
pub(crate) fn asked(spec: &Spec) -> Asked {
    let values = &mut spec.options.values();
    match (read(&spec.options), &spec.refinement) {
        (Read::Search(search), None) => {
            Asked::ObjectOrder(search(values), Box::new(refine::none::Unrefined))
        }
        (Read::Search(search), Some(options)) => {
            let Read::Refinement(refinement) = read(options) else {
                unreachable!("{} is parsed as a refinement", options.name())
            };
            Asked::ObjectOrder(search(values), refinement(&mut options.values()))
        }
        (Read::ImageOrder(technique), None) => Asked::ImageOrder(technique(values)),
        (Read::Motion(estimator), None) => Asked::Motion(estimator(values)),
        (other, _) => unreachable!("a parsed technique is never {other:?}"),
    }
}

/// What reads the options of a technique.
fn read(options: &spec::Options) -> Read {
    let mut techniques = TECHNIQUES.iter();
    let found = techniques.find(|technique| technique.info.name == options.name());
    found.expect("a technique of the registry").read
}
