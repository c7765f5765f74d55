//! Options that techniques have in common.

use crate::options::{options, words};

words! {
    /// Where the points of a mirror come from.
    pub(crate) enum Surface {
        Exact = "exact",
        Mesh = "mesh",
    }
}

words! {
    /// What a mirror shows where no reflection is drawn.
    pub(crate) enum Under {
        /// The background in the reflected direction.
        Background = "background",
        /// Black.
        Dark = "dark",
        /// A grey surface, lit from the eye: the mirror drawn as if it were none.
        Solid = "solid",
    }
}

options! {
    /// Options of every technique.
    pub(crate) struct StageOptions {
        /// mirror points by analytic intersection, or of the drawn triangles
        gbuffer: Surface,
        /// what a mirror shows where no reflection is drawn: the background in the reflected
        /// direction, black, or a grey surface lit from the eye
        under: Under,
    }
}

words! {
    /// What virtual triangles are depth-tested by.
    pub(crate) enum Depth {
        /// As in Szabo's thesis: by the distance from reflection point to vertex.
        Thesis = "thesis",
        /// By the virtual vertex, in space.
        Virtual = "virtual",
    }
}

words! {
    /// What becomes of vertices behind the tangent plane at their reflection point.
    pub(crate) enum Hidden {
        /// Triangles with such a vertex are not drawn.
        Drop = "drop",
        /// Such vertices are continued behind the tangent plane.
        Extend = "extend",
    }
}

words! {
    /// What surfaces before a mirror do to the maps that searches read.
    pub(crate) enum Occluders {
        /// Nothing: each mirror's maps are its own, and whole (Szabo 2013, Alg. 3.1).
        Ignore = "ignore",
        /// Searches read what the picture shows of the mirrors.
        Cut = "cut",
    }
}

words! {
    /// What a pixel inside a virtual triangle shows.
    pub(crate) enum Fragments {
        /// What the rasterizer interpolates between the corners.
        Interpolated = "interpolated",
        /// What the pixel's reflected ray meets of the triangle itself.
        Exact = "exact",
    }
}

words! {
    /// What is drawn of the virtual triangles.
    pub(crate) enum Show {
        Shaded = "shaded",
        Wireframe = "wireframe",
        Levels = "levels",
    }
}

options! {
    /// Options of every search.
    pub(crate) struct SearchOptions {
        /// what the virtual triangles are depth-tested by; with a +grid that interpolates always
        /// virtual
        depth: Depth,
        /// triangles with a hidden vertex are dropped, or drawn with the vertex continued behind
        /// the tangent plane unless all three are hidden
        hidden: Hidden,
        /// searches walk on each mirror's whole maps, as if nothing stood before it, or on maps
        /// cut by the objects and mirrors before it
        occluders: Occluders,
        /// what a pixel shows of a virtual triangle: what lies between the corners' reflections, or what the
        /// pixel's own reflected ray meets of the triangle, tried a little beyond its image too
        fragments: Fragments,
        /// the reflected surfaces, those with the edges of the virtual triangles, or how often each
        /// was split
        show: Show,
        ..stage: StageOptions,
    }
}
