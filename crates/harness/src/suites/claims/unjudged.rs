//! Claims of the papers that are not judged here, each with the reason.

use super::Paper;
use super::Paper::{Ciz2017, Estalella2005, Szabo2013, SzaboCescg};

/// A claim without a verdict.
#[derive(Clone, Copy, Debug)]
pub struct Unjudged {
    /// Who says so.
    pub paper: Paper,
    /// Where.
    pub section: &'static str,
    /// What, in our words.
    pub says: &'static str,
    /// Why there is no verdict.
    pub reason: &'static str,
}

const fn open(
    paper: Paper,
    section: &'static str,
    says: &'static str,
    reason: &'static str,
) -> Unjudged {
    Unjudged {
        paper,
        section,
        says,
        reason,
    }
}

const RATES: &str = "A number of frames a second of one graphics card of its time; what is compared here \
                     are ratios between techniques on one adapter.";
const TASTE: &str = "Says how a picture pleases; no number of it is agreed on.";
const UNBUILT: &str = "Speaks of what nobody has built: there is nothing to measure.";

/// All of them.
pub const UNJUDGED: &[Unjudged] = &[
    open(
        Szabo2013,
        "2.3, 7.1",
        "The search runs at interactive rates for some tens of thousands of vertices.",
        RATES,
    ),
    open(
        Szabo2013,
        "1.2",
        "Ray tracing is too slow for interactive use in many cases.",
        RATES,
    ),
    open(
        Szabo2013,
        "3.1",
        "The method fits the pipeline with few changes.",
        "Speaks of the effort of writing it, not of its result.",
    ),
    open(
        Szabo2013,
        "4.2",
        "Any of several cones that contain a vertex leads to the reflection point or near it.",
        "The search reports the answer that it returns, not those of the branches that it leaves.",
    ),
    open(
        Szabo2013,
        "3.2",
        "On a concave mirror vertices with one reflection point are handled, those with several are not.",
        "Needs the answers by the class of the reflection point; the record keeps one recall for all.",
    ),
    open(
        Szabo2013,
        "5.1",
        "The two buffers spare operations on triangles that are finished.",
        "There is no version without them to compare with.",
    ),
    open(
        Szabo2013,
        "7.1",
        "Other patterns, metrics and thresholds would split still less.",
        UNBUILT,
    ),
    open(
        SzaboCescg,
        "5.1",
        "Adaptive tessellation is robust in different circumstances.",
        TASTE,
    ),
    open(
        SzaboCescg,
        "5.1",
        "Those who make models need not care for their tessellation.",
        "Follows from what is judged as “no visible difference”; by itself it speaks of people's work.",
    ),
    open(
        SzaboCescg,
        "5.4",
        "Irregular subdivision would prevent cracks.",
        UNBUILT,
    ),
    open(
        Estalella2005,
        "7",
        "The kitchen runs at 10 frames a second with the grid.",
        RATES,
    ),
    open(
        Estalella2005,
        "2, 8",
        "The search is more exact than explosion maps, at a like cost.",
        "Explosion maps (Ofek and Rappoport 1998) are not among the techniques here.",
    ),
    open(
        Estalella2005,
        "4.1",
        "A finer mesh of the reflector in the maps makes reflections more exact at no cost when rendering.",
        "Maps of mirrors with a formula are exact here whatever the mesh.",
    ),
    open(
        Estalella2005,
        "8",
        "A hierarchy of grids would greatly reduce the cost.",
        UNBUILT,
    ),
    open(
        Estalella2005,
        "7",
        "The grid's picture is smooth and pleasant to look at.",
        TASTE,
    ),
    open(
        Ciz2017,
        "5.1",
        "It runs at interactive rates, on some cards with certain settings only.",
        RATES,
    ),
    open(
        Ciz2017,
        "3.1",
        "A straight ray crosses at most four faces of a cube.",
        "Proved in the thesis; a proof needs no measurement.",
    ),
    open(
        Ciz2017,
        "2.3.4, Table 5.1",
        "Light field maps reflect near and distant objects, for much storage and costly changes.",
        "Light fields are not among the techniques here.",
    ),
    open(
        Ciz2017,
        "Table 5.1",
        "A cubemap object needs moderate storage, an environment map little.",
        "The record does not count a technique's memory.",
    ),
    open(
        Ciz2017,
        "5",
        "It works for any representation of the scene that can be drawn.",
        "All scenes here are triangles.",
    ),
    open(
        Ciz2017,
        "5.1",
        "What costs most are rays that no map resolves, since they are followed to their end in all maps.",
        "Samples are counted for a pixel, not by what became of its ray.",
    ),
    open(
        Ciz2017,
        "6",
        "Effects that depend on the direction of view would be wrong in the maps' colours.",
        "Colours are unlit here, so nothing depends on the direction of view.",
    ),
    open(
        Ciz2017,
        "6",
        "Paraboloids in place of cubes could be faster.",
        UNBUILT,
    ),
];
