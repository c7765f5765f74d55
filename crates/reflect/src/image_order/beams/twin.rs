//! The same traversal on the CPU, level by level, over the G-buffer that the GPU has drawn.

use glam::Vec3;

use super::clusters::{CLUSTER, clusters};
use super::tally::Tally;
use crate::gpu::Gpu;
use crate::image_order::coincident::without_coincident;
use crate::stage::Stage;
use crate::stage::extent::diagonal;
use crate::stage::geometry::positions;

/// Levels of nodes, their sides in pixels: 2, 4, 8 (a tile), 32 and 128.
const LEAF: usize = 0;
const QUARTER: usize = 1;
const TILE: usize = 2;
const COARSE: usize = 4;
const TOP: usize = 6;

/// Bounds of rays.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    least: Vec3,
    greatest: Vec3,
    rays: u32,
}

const EMPTY: Node = Node {
    low: Vec3::INFINITY,
    high: Vec3::NEG_INFINITY,
    least: Vec3::INFINITY,
    greatest: Vec3::NEG_INFINITY,
    rays: 0,
};

impl Node {
    fn and(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            least: self.least.min(other.least),
            greatest: self.greatest.max(other.greatest),
            rays: self.rays + other.rays,
        }
    }

    /// Whether some t ≥ 0 satisfies low + t·least ≤ to + wider and high + t·greatest ≥ from − wider.
    fn reaches(&self, [from, to]: [Vec3; 2], wider: f32) -> bool {
        let (mut begin, mut end) = (0.0_f32, f32::INFINITY);
        for axis in 0..3 {
            let below = to[axis] - self.low[axis] + wider;
            let above = from[axis] - self.high[axis] - wider;
            for (slope, bound, is_upper) in [
                (self.least[axis], below, true),
                (self.greatest[axis], above, false),
            ] {
                if slope == 0.0 {
                    if (bound < 0.0) == is_upper && bound != 0.0 {
                        return false;
                    }
                } else if (slope > 0.0) == is_upper {
                    end = end.min(bound / slope);
                } else {
                    begin = begin.max(bound / slope);
                }
            }
        }
        self.rays > 0 && begin <= end
    }
}

/// All nodes of a level, in rows.
struct Level {
    width: usize,
    nodes: Vec<Node>,
}

impl Level {
    fn children(&self, [x, y]: [usize; 2]) -> [([usize; 2], Node); 4] {
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[dx, dy]| {
            let at = [2 * x + dx, 2 * y + dy];
            (at, self.nodes[at[1] * self.width + at[0]])
        })
    }
}

/// The pyramid over the rays of what was drawn last.
fn pyramid(gpu: &Gpu, stage: &Stage) -> Vec<Level> {
    let points = gpu.read_texture(&stage.gbuffer.position);
    let normals = gpu.read_texture(&stage.gbuffer.normal);
    let [width, height] = stage.world.size.map(|side| side as usize);
    let eye = stage
        .world
        .scene
        .camera
        .view(stage.world.size)
        .eye
        .as_vec3();
    let ray = |x: usize, y: usize| {
        if x >= width || y >= height {
            return EMPTY;
        }
        let ([px, py, pz, id], [nx, ny, nz, side]) =
            (points[y * width + x], normals[y * width + x]);
        if id == 0.0 || side != 1.0 {
            return EMPTY;
        }
        let (point, normal) = (Vec3::new(px, py, pz), Vec3::new(nx, ny, nz));
        let direction = (point - eye).normalize().reflect(normal).normalize();
        Node {
            low: point,
            high: point,
            least: direction,
            greatest: direction,
            rays: 1,
        }
    };
    let [across, down] = [width, height].map(|side| side.next_multiple_of(128));
    let mut levels = vec![Level {
        width: across,
        nodes: (0..across * down)
            .map(|index| ray(index % across, index / across))
            .collect(),
    }];
    for level in 1..=TOP + 1 {
        let below = &levels[level - 1];
        let [across, down] = [across, down].map(|side| side >> level);
        let node = |index: usize| {
            let children = below.children([index % across, index / across]);
            children.iter().fold(EMPTY, |all, (_, node)| all.and(*node))
        };
        levels.push(Level {
            width: across,
            nodes: (0..across * down).map(node).collect(),
        });
    }
    // The pixels themselves are no nodes.
    levels.remove(0);
    levels
}

/// What `beams` counts on this scene, all clusters sent down at once.
pub(super) fn tally(gpu: &Gpu, stage: &Stage) -> Tally {
    let scene = &stage.world.scene;
    let wider = super::lists::WIDER * diagonal(scene);
    let corners = positions(scene);
    let corner = |vertex: u32| {
        let [x, y, z, _] = corners[vertex as usize];
        Vec3::new(x, y, z)
    };
    let all = clusters(scene, &[]);
    let seen = without_coincident(scene, &all, 0).unwrap_or(all);
    let boxes: Vec<[Vec3; 2]> = seen
        .iter()
        .map(|[a, b, c, _]| {
            let [a, b, c] = [*a, *b, *c].map(corner);
            [a.min(b).min(c), a.max(b).max(c)]
        })
        .collect();
    let cluster_boxes: Vec<[Vec3; 2]> = boxes
        .chunks(CLUSTER)
        .map(|boxes| {
            let all = boxes.iter().copied();
            let joined = |[low, high]: [Vec3; 2], [a, b]: [Vec3; 2]| [low.min(a), high.max(b)];
            all.reduce(joined).expect("a chunk has members")
        })
        .collect();
    let levels = pyramid(gpu, stage);
    let mut tally = Tally::default();
    // A level, a node in it, and the clusters that are to be tested against it.
    let top = &levels[TOP];
    let all: Vec<u32> = (0..cluster_boxes.len() as u32).collect();
    let tops = (0..top.nodes.len()).map(|index| [index % top.width, index / top.width]);
    let mut open: Vec<(usize, [usize; 2], Vec<u32>)> =
        tops.map(|at| (TOP, at, all.clone())).collect();
    while let Some((level, at, clusters)) = open.pop() {
        let node = levels[level].nodes[at[1] * levels[level].width + at[0]];
        if node.rays == 0 {
            continue;
        }
        tally.cluster_tests += clusters.len() as u64;
        let reached = clusters.into_iter();
        let reached =
            reached.filter(|cluster| node.reaches(cluster_boxes[*cluster as usize], wider));
        let reached: Vec<u32> = reached.collect();
        let next = match level {
            TOP => COARSE,
            COARSE => TILE,
            _ => {
                for cluster in reached {
                    let first = cluster as usize * CLUSTER;
                    for triangle in &boxes[first..boxes.len().min(first + CLUSTER)] {
                        descend(&levels, (TILE, at, node), (*triangle, wider), &mut tally);
                    }
                }
                continue;
            }
        };
        let below = 1 << (level - next);
        for place in 0..below * below {
            let at = [at[0] * below + place % below, at[1] * below + place / below];
            open.push((next, at, reached.clone()));
        }
    }
    tally
}

/// Sends a triangle's box down from a node.
fn descend(
    levels: &[Level],
    (level, at, node): (usize, [usize; 2], Node),
    (triangle, wider): ([Vec3; 2], f32),
    tally: &mut Tally,
) {
    tally.triangle_tests += 1;
    if !node.reaches(triangle, wider) {
        return;
    }
    if level == LEAF {
        tally.pairs += 1;
        tally.exact += u64::from(node.rays);
        return;
    }
    debug_assert!(level == TILE || level == QUARTER, "level {level}");
    for (at, child) in levels[level - 1].children(at) {
        descend(levels, (level - 1, at, child), (triangle, wider), tally);
    }
}
