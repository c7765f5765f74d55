//! What a technique is to the rest of the crate: its description, its properties, and the trait by which
//! it records frames and hands over what it drew and counted.

use std::fmt;

use catoptric_frame::{Frame, Triangles, VertexResult, Work};
use catoptric_scene::Scene;

use crate::diagnostics::{Answer, Question};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::options::{OptionInfo, Options, Settled};
use crate::stage::variant::Variant;

/// What a technique is called, takes and is like.
#[derive(Clone, Copy, Debug)]
pub struct TechniqueInfo {
    /// As written on the command line; refinements start with `+`.
    pub name: &'static str,
    /// A sentence.
    pub what: &'static str,
    /// How it goes together with others.
    pub family: Family,
    /// Where it was published.
    pub paper: &'static str,
    /// Groups of options, in display order: its own, then those of all its family.
    pub(crate) options: [&'static [&'static [OptionInfo]]; 2],
    /// What it is like with these options.
    pub(crate) properties: fn(&mut Settled<'_>) -> Properties,
}

/// How a technique goes together with others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Finds reflection points; goes with any refinement.
    Search,
    /// Chooses the points to search; goes with any search.
    Refinement,
    /// Finds what each mirror pixel's ray meets; stands alone.
    ImageOrder,
    /// Finds where each mirror pixel's reflection was a frame before; stands alone. Its picture is
    /// the control's.
    Motion,
}

impl Family {
    /// What techniques of the family do, and how they are named on the command line.
    pub fn what(self) -> &'static str {
        match self {
            Self::Search => "finds reflection points of vertices; alone or with a refinement",
            Self::Refinement => "chooses the points to search, as in `linear+full(level=3)`",
            Self::ImageOrder => "finds what each mirror pixel's ray meets; stands alone",
            Self::Motion => "finds where each mirror pixel's reflection was a frame before; alone",
        }
    }
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Search => "search",
            Self::Refinement => "refinement",
            Self::ImageOrder => "image order",
            Self::Motion => "motion",
        })
    }
}

impl TechniqueInfo {
    /// All options, in display order.
    pub fn options(&self) -> impl Iterator<Item = &'static OptionInfo> + Clone + use<> {
        self.options.into_iter().flatten().copied().flatten()
    }
}

/// How a technique introduces itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Info {
    /// As written on the command line; refinements start with `+`.
    pub name: &'static str,
    /// A sentence.
    pub what: &'static str,
    /// Where it was published.
    pub paper: &'static str,
}

/// What is listed: options that have a name.
pub(crate) trait Named: Options {
    const INFO: Info;
}

/// Properties of a technique, for code that would otherwise have to know it by its name. Each is true
/// only where it holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Properties {
    /// It follows the reference's own rays from the reference's own points: its errors are the
    /// measurement's noise.
    pub is_control: bool,
    /// A vertex may fall into a gap of its hierarchy; it tells of which vertices did ("holes").
    pub has_holes: bool,
    /// It walks from texel to texel and ends where no neighbour is better, right or wrong.
    pub walks: bool,
    /// Triangles are split.
    pub splits_triangles: bool,
    /// A frame takes less work after another one, since it starts from that one's answers.
    pub carries_over: bool,
    /// Vertices behind the tangent plane are continued, so that triangles are drawn that the mirror
    /// hides in part.
    pub continues_hidden: bool,
    /// Mirror pixels may be left without an answer.
    pub may_be_unresolved: bool,
    /// It says where reflections were a frame before.
    pub estimates_motion: bool,
}

impl Properties {
    /// Nothing holds.
    pub(crate) const NONE: Self = Self {
        is_control: false,
        has_holes: false,
        walks: false,
        splits_triangles: false,
        carries_over: false,
        continues_hidden: false,
        may_be_unresolved: false,
        estimates_motion: false,
    };

    /// Of a search with a refinement.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            is_control: self.is_control || other.is_control,
            has_holes: self.has_holes || other.has_holes,
            walks: self.walks || other.walks,
            splits_triangles: self.splits_triangles || other.splits_triangles,
            carries_over: self.carries_over || other.carries_over,
            continues_hidden: self.continues_hidden || other.continues_hidden,
            may_be_unresolved: self.may_be_unresolved || other.may_be_unresolved,
            estimates_motion: self.estimates_motion || other.estimates_motion,
        }
    }
}

/// What was done before a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Built {
    /// Nothing that a reader of times must know of.
    Nothing,
    /// Something that the technique traces or looks up, without which there would be no frame.
    OnTheCpu,
}

/// A technique that stands ready for one scene and image size.
pub(crate) trait Technique {
    /// Takes over what moved; `scene` differs from the one prepared for in positions only: eye,
    /// vertices, mirrors.
    ///
    /// # Errors
    /// As when preparing.
    fn update(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), ReflectError>;

    /// Called before each frame is recorded.
    ///
    /// # Errors
    /// As when preparing.
    fn begin_frame(&mut self, gpu: &Gpu) -> Result<Built, ReflectError>;

    /// Records all passes of a frame.
    fn record(&self, frame: &mut Recorder<'_>, variant: Variant);

    /// Whether the last frame wanted more room than there was. It was not drawn whole then: more room has
    /// been made, and it is to be rendered anew.
    ///
    /// # Errors
    /// What the device cannot hold.
    fn outgrown(&mut self, _: &Gpu) -> Result<bool, ReflectError> {
        Ok(false)
    }

    /// Whether a frame takes less work after another one.
    fn carries_over(&self) -> bool {
        false
    }

    /// Reads back what the last frame drew and counted; it was rendered in
    /// [`Variant::AllLayers`].
    fn output(&self, gpu: &Gpu) -> Output;

    /// Tells of its inside; `None` if there is no such thing in it.
    ///
    /// # Errors
    /// As when preparing.
    fn answer(&self, _: &Gpu, _: Question) -> Result<Option<Answer>, ReflectError> {
        Ok(None)
    }
}

/// A rendered frame and all that was counted on the way.
#[derive(Clone, Debug)]
pub struct Output {
    /// All layers.
    pub frame: Frame,
    /// Whether mirror pixels may be left without an answer; otherwise a pixel without one counts as
    /// showing nothing.
    pub may_be_unresolved: bool,
    /// By mirror, object, vertex; `None` for techniques that search no vertices.
    pub vertices: Option<Vec<VertexResult>>,
    /// Searches that were run, those of a refinement's new points included; 0 without a search.
    pub searched: u64,
    /// Triangles of the virtual geometry; `None` for techniques that have none.
    pub triangles: Option<Triangles>,
    /// Corners of drawn triangles inside an edge of another; `None` where no triangle is split.
    pub t_junctions: Option<u64>,
    /// By sheet of images, then triangle of the scene: 0 where nothing of it is drawn, else one more than
    /// how often its deepest part was split; `None` where no triangle is split.
    pub levels: Option<Vec<u8>>,
    /// Means per search that was run, or per mirror pixel.
    pub work: Work,
    /// What else the reader of these numbers should know, in sentences.
    pub notes: Vec<String>,
}
