//! What a suite is.

use catoptric_scene::LoadOptions;

use crate::options::Common;
use crate::output::Draft;
use crate::run::Setup;

use super::figure::Figure;

/// A named set of figures.
#[derive(Clone, Copy)]
pub struct Suite {
    /// As on the command line.
    pub name: &'static str,
    /// Heading of the page.
    pub title: &'static str,
    /// What is asked, in a sentence or two.
    pub why: &'static str,
    /// What is measured.
    pub figures: fn(&Asked<'_>) -> Vec<Figure>,
    /// Figures of other suites, each with its suite's name, whose claims are judged in a table at the end
    /// of the page; `None` where there is none. The text is the user's scene.
    pub judged: Option<Judged>,
    /// Pictures other than those of points; `None` where there are none.
    pub pictures: Option<MakePictures>,
    /// Seconds of timing, where the user does not say.
    pub timing: Budget,
    /// Picture size of all points, where the user does not say; `None` for each point's own.
    pub resolution: Option<[u32; 2]>,
    /// What the page is made of.
    pub layout: Layout,
}

/// What the user asks of a suite.
#[derive(Clone, Debug, Default)]
pub struct Asked<'a> {
    /// A scene in place of the suite's own.
    pub scene: Option<&'a str>,
    /// How scenes are to be loaded.
    pub load: LoadOptions,
}

/// Seconds of timing, shared by the techniques.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// In all.
    Whole(f64),
    /// For each scene.
    EachScene(f64),
}

impl Budget {
    /// The same kind of budget with the seconds asked for, if any.
    pub fn or(self, seconds: Option<f64>) -> Self {
        match self {
            Self::Whole(usual) => Self::Whole(seconds.unwrap_or(usual)),
            Self::EachScene(usual) => Self::EachScene(seconds.unwrap_or(usual)),
        }
    }
}

/// What a page is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A section a figure: plots, a table, quotations. Made once all is measured.
    Figures,
    /// A section a scene: pictures and numbers of every technique. Made anew after each scene.
    Scenes,
}

/// Lists figures of other suites.
pub type Judged = fn(Option<&str>) -> Vec<(&'static str, Figure)>;

/// Makes pictures of a suite's own kind.
pub type MakePictures = fn(&Studio<'_>) -> anyhow::Result<Vec<Picture>>;

/// What a suite's own pictures are made with.
pub struct Studio<'s> {
    /// Adapter and scenes.
    pub setup: &'s Setup,
    /// The user's scene.
    pub scene: Option<&'s str>,
    /// How scenes are to be loaded.
    pub common: &'s Common,
    /// The files of the page; pictures go into [`crate::output::PICTURES`].
    pub draft: &'s Draft,
}

/// A picture of a suite's own kind, written already.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The figure under which it stands.
    pub figure: &'static str,
    /// Path, relative to the page.
    pub path: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What it shows, for everyone.
    pub caption: String,
    /// What is to be seen, for those who cannot.
    pub alt: String,
}
