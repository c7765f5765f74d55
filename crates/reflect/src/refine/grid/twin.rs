//! Twin of `grid/settle.wesl` and `grid/interpolate.wesl`: which cells serve, what is searched, and what
//! is interpolated. Records are searched by the GPU's own search, which has a twin of its own, so
//! that what differs here is the grid's.

use std::collections::BTreeSet;

use glam::Vec3;

use super::forest::{Cell, Forest, NONE, Place};
use crate::stage::points::Found;
use crate::stage::twin::image;
use crate::stage::view::ViewUniform;

const ASLEEP: u32 = 0;
const ACTIVE: u32 = 1;
const SPLIT: u32 = 2;
const SERVES: u32 = 3;
const SEARCHED: u32 = 4;

/// Cells on one mirror.
struct Cells<'a> {
    view: ViewUniform,
    forest: &'a Forest,
    /// Hidden points have images.
    continued: bool,
    error: f32,
    /// World space, one a record.
    positions: &'a [Vec3],
    /// One a record; only those that were searched mean something.
    found: &'a [Found],
}

/// What a frame has settled.
struct Settled {
    states: Vec<u32>,
    searched: BTreeSet<u32>,
}

fn share_of(corner: usize, local: Vec3) -> f32 {
    let upper = |axis: usize| corner >> axis & 1 == 1;
    let share = |axis: usize| match upper(axis) {
        true => local[axis],
        false => 1.0 - local[axis],
    };
    share(0) * share(1) * share(2)
}

impl Cells<'_> {
    fn serves(&self, cell: &Cell) -> bool {
        let corners = cell.corners.map(|record| self.found[record as usize]);
        let first = corners[0].state;
        let same = |answer: &Found| answer.state == first && answer.state != Found::FAILED;
        if !corners.iter().all(same) {
            return false;
        }
        if cell.center == NONE {
            return true;
        }
        let mean: Vec3 = corners.iter().map(|answer| 0.125 * answer.image).sum();
        let center = self.found[cell.center as usize];
        if !self.continued && first == Found::HIDDEN && center.state == Found::HIDDEN {
            return true;
        }
        let places = (image(&self.view, center.image), image(&self.view, mean));
        let (Some(there), Some(guess)) = places else {
            return false;
        };
        center.state == first && there.distance(guess) <= self.error
    }

    fn settle(&self) -> Settled {
        let cells = &self.forest.cells;
        let mut states: Vec<_> = cells
            .iter()
            .map(|cell| if cell.parent == NONE { ACTIVE } else { ASLEEP })
            .collect();
        let mut searched = BTreeSet::new();
        for (index, cell) in cells.iter().enumerate() {
            if states[index] != ACTIVE {
                continue;
            }
            let parts = cell.first as usize..(cell.first + cell.count) as usize;
            if cell.leaf == 1 {
                searched.extend(&self.forest.order[parts]);
                states[index] = SEARCHED;
                continue;
            }
            searched.extend(cell.corners);
            searched.extend((cell.center != NONE).then_some(cell.center));
            if self.serves(cell) {
                states[index] = SERVES;
                continue;
            }
            states[index] = SPLIT;
            states[parts].fill(ACTIVE);
        }
        Settled { states, searched }
    }

    /// State and virtual image of a scene vertex that lies at a place; `None` where nothing is found.
    fn interpolated(&self, position: Vec3, place: Place, states: &[u32]) -> Option<(u32, Vec3)> {
        let Place {
            mut local,
            mut cell,
        } = place;
        while states[cell as usize] == ASLEEP {
            let part = &self.forest.cells[cell as usize];
            local = part.offset + part.scale * local;
            cell = part.parent;
        }
        let (mut total, mut height, mut way, mut hidden) = (0.0, 0.0, Vec3::ZERO, false);
        for (corner, record) in self.forest.cells[cell as usize].corners.iter().enumerate() {
            let weight = share_of(corner, local);
            let answer = self.found[*record as usize];
            if weight <= 0.0 || answer.state == Found::FAILED {
                continue;
            }
            let corner_way = answer.image - self.positions[*record as usize];
            let below = answer.state == Found::HIDDEN;
            way += weight * corner_way;
            height += weight * corner_way.length() * if below { -1.0 } else { 1.0 };
            hidden |= below;
            total += weight;
        }
        if self.continued {
            hidden = height < 0.0;
        }
        let state = if hidden { Found::HIDDEN } else { Found::FOUND };
        (total > 0.0).then(|| (state, position + way / total))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::Gpu;
    use crate::refine::grid::tests::Gridded;
    use crate::stage::options::Under;
    use crate::stage::points::read;
    use crate::testing::{gpu_or_skip, scene};

    /// Least share of the vertices whose images agree to [`EXACT`].
    const ALIKE: f64 = 0.999;
    /// Distance of images, as a share of the scene's extent of some units: roundings of sums of eight.
    const EXACT: f32 = 1e-4;

    /// Compares GPU and twin and returns, over all mirrors, how many cells serve and are split.
    fn check(gpu: &Gpu, name: &str, technique: &str) -> [usize; 2] {
        let scene = scene(name);
        let size = [160, 120];
        let gridded = Gridded::new(gpu, &scene, technique, size);
        let made = &gridded.interpolation;
        let positions: Vec<_> = (made.positions().iter())
            .map(|[x, y, z, _]| Vec3::new(*x, *y, *z))
            .collect();
        let mut counts = [0; 2];
        for on_sheet in &made.on_sheets {
            let settled = on_sheet.settled.as_ref().expect("settles");
            let found = on_sheet.searched.read_found(gpu, positions.len() as u32);
            let twin = Cells {
                view: ViewUniform::new(&scene, size, Under::Background),
                forest: &made.forest,
                continued: gridded.continued,
                error: gridded.options.error as f32,
                positions: &positions,
                found: &found,
            };
            let expected = twin.settle();
            let states: Vec<u32> = read(gpu, &settled.states, made.forest.cells.len() as u32);
            let searched = settled.searched(gpu);
            let distinct: BTreeSet<_> = searched.iter().copied().collect();
            assert_eq!(distinct.len(), searched.len(), "{name}: a record twice");
            assert_eq!(states, expected.states, "{name}, {technique}");
            assert_eq!(distinct, expected.searched, "{name}, {technique}");
            counts[0] += states.iter().filter(|state| **state == SERVES).count();
            counts[1] += states.iter().filter(|state| **state == SPLIT).count();

            let answers = on_sheet
                .interpolated
                .read_found(gpu, made.forest.places.len() as u32);
            let (mut alike, mut all) = (0_u32, 0_u32);
            for (vertex, answer) in answers.iter().enumerate() {
                let place = made.forest.places[vertex];
                if states[place.cell as usize] == SEARCHED {
                    assert_eq!(answer.image, found[vertex].image);
                    continue;
                }
                all += 1;
                let expected = twin.interpolated(positions[vertex], place, &states);
                alike += u32::from(match expected {
                    None => answer.state == Found::FAILED,
                    Some((state, image)) => {
                        answer.state == state && answer.image.distance(image) < EXACT
                    }
                });
            }
            assert!(
                f64::from(alike) >= ALIKE * f64::from(all),
                "{name}: {alike} of {all}"
            );
        }
        counts
    }

    #[test]
    fn gpu_settles_the_same_cells_and_interpolates_the_same_images() {
        let Some(gpu) = gpu_or_skip() else { return };
        let cubemap = "reflector-cubemap(hidden=extend)";
        for name in ["sphere-touching", "spheres"] {
            for grid in ["mixed=search", "cells=octree", "cells=octree,error=0.05"] {
                let counts = check(&gpu, name, &format!("{cubemap}+grid({grid})"));
                assert!(
                    counts[0] > 20 && counts[1] > 20,
                    "{name}, {grid}: {counts:?}"
                );
            }
        }
        // A search that cannot continue hidden points.
        let hierarchy = "ray-hierarchy(repair=enlarge)+grid(cells=octree)";
        check(&gpu, "sphere-touching", hierarchy);
    }
}
