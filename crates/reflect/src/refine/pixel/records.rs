//! Records that the kernels share, as `pixel/records.wesl` reads them, and how much room there is for them.

use encase::ShaderType;
use glam::{UVec2, UVec3, UVec4};

/// Of an edge or a triangle: there is none. Twin of `NONE` in `pixel/records.wesl`.
pub(super) const NONE: u32 = u32::MAX;

/// Threads of a workgroup. Twin of `GROUP` in `pixel/records.wesl`.
pub(super) const GROUP: u32 = 256;

/// Twin of `Settings` in `pixel/records.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Settings {
    pub error: f32,
    pub level: u32,
    pub vertices: u32,
    pub edges: u32,
    pub triangles: u32,
    pub most_points: u32,
    pub most_edges: u32,
    pub most_working: u32,
    pub most_finished: u32,
    pub most_items: u32,
}

/// Twin of `Edge` in `pixel/records.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Edge {
    pub ends: UVec2,
    pub middle: u32,
    pub quarters: u32,
    pub state: u32,
}

/// Twin of `Working` in `pixel/records.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Working {
    pub points: UVec3,
    pub source: u32,
    pub places: UVec3,
    pub level: u32,
    pub edges: UVec3,
    pub center: u32,
}

/// Twin of `Level` in `pixel/records.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Level {
    pub groups: UVec3,
    pub edges: u32,
    pub edge_groups: UVec3,
    pub triangles: u32,
    pub draw: UVec4,
    pub first_edge: u32,
    pub next_edge: u32,
    pub points: u32,
    pub finished: u32,
    pub index: u32,
    pub is_full: u32,
}

/// Twin of `Totals` in `pixel/records.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Totals {
    pub by_level: [u32; 12],
    pub points: u32,
    pub unfinished: u32,
    pub wanted_points: u32,
    pub wanted_edges: u32,
    pub wanted_working: u32,
    pub wanted_finished: u32,
}

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    /// How far a drawn edge may be off the true curve, pixels.
    pub error: f32,
    /// How often an edge may be split.
    pub level: u32,
}

/// How many records of each kind there is room for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Room {
    /// The scene's vertices included.
    pub points: u32,
    /// The scene's included.
    pub edges: u32,
    /// Triangles worked on, the scene's left out: they have a list of their own.
    pub working: u32,
    pub finished: u32,
    /// Edges and triangles worked on at a time.
    pub items: u32,
}

impl Room {
    /// Beyond the scene's own records, at first.
    const SPARE: u32 = 1 << 13;

    /// For the first frame of a scene with so many vertices, edges and triangles.
    pub(super) fn first([vertices, edges, triangles]: [u32; 3]) -> Self {
        Self {
            points: vertices + Self::SPARE,
            edges: edges + Self::SPARE,
            working: Self::SPARE,
            finished: triangles + Self::SPARE,
            items: (edges + triangles).max(2 * Self::SPARE),
        }
    }

    /// With room for what was wanted and half as much again; `None` if that much is there.
    pub(super) fn grown(self, wanted: Self) -> Option<Self> {
        let more = |room: u32, wanted: u32| match wanted > room {
            true => wanted.saturating_add(wanted / 2),
            false => room,
        };
        let working = more(self.working, wanted.working);
        let edges = more(self.edges, wanted.edges);
        let grown = Self {
            points: more(self.points, wanted.points),
            edges,
            working,
            finished: more(self.finished, wanted.finished),
            items: self.items.max(working.saturating_add(edges)),
        };
        (grown != self).then_some(grown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn records_lie_as_the_shaders_read_them() {
        let program = "pixel/kernels";
        assert_layout!(
            Settings {
                error,
                level,
                vertices,
                edges,
                triangles,
                most_points,
                most_edges,
                most_working,
                most_finished,
                most_items
            },
            program,
            &[],
            "Settings"
        );
        assert_layout!(
            Edge {
                ends,
                middle,
                quarters,
                state
            },
            program,
            &[],
            "Edge"
        );
        assert_layout!(
            Working {
                points,
                source,
                places,
                level,
                edges,
                center
            },
            program,
            &[],
            "Working"
        );
        assert_layout!(
            Level {
                groups,
                edges,
                edge_groups,
                triangles,
                draw,
                first_edge,
                next_edge,
                points,
                finished,
                index,
                is_full
            },
            program,
            &[],
            "Level"
        );
        assert_layout!(
            Totals {
                by_level,
                points,
                unfinished,
                wanted_points,
                wanted_edges,
                wanted_working,
                wanted_finished
            },
            program,
            &[],
            "Totals"
        );
    }

    #[test]
    fn room_grows_by_what_is_wanted_alone() {
        let room = Room {
            points: 100,
            edges: 100,
            working: 50,
            finished: 80,
            items: 150,
        };
        let wanted = Room {
            points: 100,
            edges: 200,
            working: 50,
            finished: 3,
            items: 0,
        };
        let grown = room.grown(wanted).expect("more edges");
        assert_eq!((grown.points, grown.edges, grown.items), (100, 300, 350));
        assert_eq!(grown.grown(wanted), None);
    }
}
