//! Twin of `swept_boxes/rays.wesl`, `swept_boxes/build.wesl`, `swept_boxes/leaf.wesl` and
//! `swept_boxes/search.wesl`. The distances of the slices are those that the GPU has found.

use glam::{IVec2, Mat3, Vec2, Vec3, Vec4};

use super::nodes::{cells, top_level};
use super::{SHEETS, WIDER};
use crate::gpu::Gpu;
use crate::stage::Stage;
use crate::stage::extent::diagonal;
use crate::stage::twin::GBuffer;
use crate::stage::view::ViewUniform;

/// Greater than any distance.
const FAR: f32 = 3e38;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Nothing,
    Seen,
    Continued,
}

/// A texel of the ray images.
#[derive(Clone, Copy, Debug)]
struct Ray {
    kind: Kind,
    point: Vec3,
    direction: Vec3,
    /// To the right and down the mirror goes on smoothly, or ends.
    goes_on: bool,
}

/// `swept_boxes/smooth.wesl`.
fn is_smooth(
    view: &ViewUniform,
    [point, normal]: [Vec3; 2],
    [other, other_normal]: [Vec3; 2],
) -> bool {
    let chord = other - point;
    let (to_eye, to_eye_other) = (view.eye - point, view.eye - other);
    let (distance, other_distance) = (to_eye.length(), to_eye_other.length());
    let cosine =
        (to_eye.dot(normal) / distance).max(to_eye_other.dot(other_normal) / other_distance);
    let size = view.size.as_vec2();
    let pixel = (2.0 * view.tan_x / size.x).max(2.0 * view.tan_y / size.y);
    (normal + other_normal).dot(chord).abs() <= 2.0 * 0.2 * chord.length()
        && normal.dot(other_normal) >= 0.25
        && chord.length() * cosine <= 4.0 * pixel * distance.max(other_distance)
}

/// What the boxes of a node are made of.
#[derive(Clone, Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    least: Vec3,
    greatest: Vec3,
    parts: f32,
    slices: Vec<[Vec3; 2]>,
}

impl Node {
    fn empty(slices: usize) -> Self {
        Self {
            low: Vec3::splat(FAR),
            high: Vec3::splat(-FAR),
            least: Vec3::splat(FAR),
            greatest: Vec3::splat(-FAR),
            parts: 0.0,
            slices: vec![[Vec3::splat(FAR), Vec3::splat(-FAR)]; slices],
        }
    }

    fn is_empty(&self) -> bool {
        self.low.x > self.high.x
    }

    fn join(&mut self, other: &Self) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
        self.least = self.least.min(other.least);
        self.greatest = self.greatest.max(other.greatest);
        self.parts = self.parts.max(other.parts);
        for (mine, theirs) in self.slices.iter_mut().zip(&other.slices) {
            *mine = [mine[0].min(theirs[0]), mine[1].max(theirs[1])];
        }
    }
}

/// A solution that is kept, and what it is drawn with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    pub at: Vec2,
    pub t: f32,
}

/// The search on one mirror.
pub(super) struct Twin {
    view: ViewUniform,
    rays: Vec<Ray>,
    /// Along both sides.
    ray_size: IVec2,
    slices: Vec<f32>,
    /// Level 0 first, with the nodes along both sides.
    levels: Vec<(IVec2, Vec<Node>)>,
    wider: f32,
    first: bool,
}

impl Twin {
    pub(super) fn new(
        gpu: &Gpu,
        stage: &Stage,
        mirror: usize,
        slices: Vec<f32>,
        first: bool,
    ) -> Self {
        let gbuffer = GBuffer::read(gpu, stage, mirror);
        let world = &stage.world;
        let view = ViewUniform::new(&world.scene, world.size, stage.options.under);
        let ray_size = gbuffer.size + 2;
        let texels = 0..ray_size.x * ray_size.y;
        let ray = |index: i32| {
            let pixel = IVec2::new(index % ray_size.x, index / ray_size.x) - 1;
            ray_at(&gbuffer, &view, pixel)
        };
        let mut made = Self {
            rays: texels.map(ray).collect(),
            ray_size,
            slices,
            levels: Vec::new(),
            wider: WIDER * diagonal(&world.scene),
            first,
            view,
        };
        let size = IVec2::from_array(cells(world.size).map(|side| side as i32));
        let at = |index: i32| IVec2::new(index % size.x, index / size.x);
        let base = (0..size.x * size.y).map(|index| made.cell(at(index)));
        let base = base.collect();
        made.levels.push((size, base));
        for level in 1..=top_level(world.size) as usize {
            let (below, nodes) = &made.levels[level - 1];
            let size = below / 2;
            let joined = (0..size.x * size.y).map(|index| {
                let at = IVec2::new(index % size.x, index / size.x);
                let mut node = Node::empty(made.slices.len());
                for child in 0..4 {
                    let child = 2 * at + IVec2::new(child & 1, child >> 1);
                    node.join(&nodes[(child.y * below.x + child.x) as usize]);
                }
                node
            });
            let joined = joined.collect();
            made.levels.push((size, joined));
        }
        made
    }

    fn ray(&self, at: IVec2) -> &Ray {
        &self.rays[(at.y * self.ray_size.x + at.x) as usize]
    }

    fn corners(&self, cell: IVec2) -> [&Ray; 4] {
        [0, 1, 2, 3].map(|corner| self.ray(cell + IVec2::new(corner & 1, corner >> 1)))
    }

    fn normal(&self, ray: &Ray) -> Vec3 {
        (ray.direction - (ray.point - self.view.eye).normalize()).normalize()
    }

    fn cell(&self, at: IVec2) -> Node {
        let mut node = Node::empty(self.slices.len());
        if (at + 1).cmpge(self.ray_size).any() {
            return node;
        }
        let corners = self.corners(at);
        let is_whole = |a: usize, b: usize| {
            let [a, b] = [corners[a], corners[b]];
            let both = [a, b].map(|ray| [ray.point, self.normal(ray)]);
            a.kind != Kind::Seen || b.kind != Kind::Seen || is_smooth(&self.view, both[0], both[1])
        };
        let full = corners.iter().all(|ray| ray.kind != Kind::Nothing)
            && corners.iter().any(|ray| ray.kind == Kind::Seen)
            && [(0, 1), (1, 3), (3, 2), (2, 0)]
                .iter()
                .all(|(a, b)| is_whole(*a, *b));
        if !full {
            return node;
        }
        let mut chord = 0.0_f32;
        for (index, ray) in corners.iter().enumerate() {
            node.low = node.low.min(ray.point);
            node.high = node.high.max(ray.point);
            node.least = node.least.min(ray.direction);
            node.greatest = node.greatest.max(ray.direction);
            for other in &corners[..index] {
                chord = chord.max((ray.direction - other.direction).length_squared());
            }
            for (t, [low, high]) in self.slices.iter().zip(&mut node.slices) {
                let point = ray.point + t * ray.direction;
                *low = low.min(point);
                *high = high.max(point);
            }
        }
        let square = 1.0 - 0.375 * chord;
        node.parts = if square < 0.3 {
            256.0
        } else {
            (256.0 * (1.0 / square.sqrt() - 1.0) + 0.01)
                .ceil()
                .min(256.0)
        };
        node
    }

    /// Whether a node has a box, and whether that may hold the vertex.
    fn reaches(&self, at: IVec2, level: usize, vertex: Vec3) -> (bool, bool) {
        let (size, nodes) = &self.levels[level];
        let node = &nodes[(at.y * size.x + at.x) as usize];
        if node.is_empty() {
            return (false, false);
        }
        let before = (node.low - vertex).max(vertex - node.high).max(Vec3::ZERO);
        let beyond = (vertex - node.low).max(node.high - vertex);
        let longer = if node.parts >= 256.0 {
            FAR
        } else {
            1.0 + node.parts / 256.0
        };
        let (begin, end) = (
            0.999_999 * before.length(),
            (1.000_001 * beyond.length() * longer).min(FAR),
        );
        let mut from = 0.0;
        let [mut low, mut high] = [node.low, node.high];
        for (to, [next_low, next_high]) in self.slices.iter().zip(&node.slices) {
            if begin <= *to && end >= from {
                let slopes = [*next_low - low, *next_high - high];
                let share = |t: f32| (t - from) / (to - from);
                let range = [
                    0.99999 * share(begin).max(0.0),
                    1.00001 * share(end).min(1.0),
                ];
                if is_between([low, high], slopes, vertex, range, self.wider) {
                    return (true, true);
                }
            }
            [low, high] = [*next_low, *next_high];
            from = *to;
        }
        let range = [(0.99999 * (begin - from)).max(0.0), 1.00001 * (end - from)];
        let slopes = [node.least, node.greatest];
        let last = end >= from && is_between([low, high], slopes, vertex, range, self.wider);
        (true, last)
    }

    /// Answers by sheet, and the number of node tests.
    pub(super) fn search(&self, vertex: Vec3) -> ([Option<Kept>; SHEETS], u32) {
        let mut kept = [None; SHEETS];
        let mut tests = 0;
        let top = self.levels.len() - 1;
        let size = self.levels[top].0;
        let all = (0..size.y)
            .rev()
            .flat_map(|y| (0..size.x).rev().map(move |x| IVec2::new(x, y)));
        // In the order of the shader: what is pushed last is visited first.
        let mut open: Vec<_> = all.map(|at| (at, top)).collect();
        let mut tested = |at, level| {
            let (has_box, reaches) = self.reaches(at, level, vertex);
            tests += u32::from(has_box);
            reaches
        };
        while let Some((at, level)) = open.pop() {
            if level == top && !tested(at, level) {
                continue;
            }
            if level == 0 {
                self.look_in(at, vertex, &mut kept);
                if self.first && kept[0].is_some() {
                    break;
                }
                continue;
            }
            for child in (0..4).rev() {
                let child = 2 * at + IVec2::new(child & 1, child >> 1);
                if tested(child, level - 1) {
                    open.push((child, level - 1));
                }
            }
        }
        (kept, tests)
    }

    fn look_in(&self, cell: IVec2, vertex: Vec3, kept: &mut [Option<Kept>; SHEETS]) {
        let corners = self.corners(cell);
        let size = corners
            .iter()
            .map(|ray| ray.point.distance(corners[0].point));
        let size = 1.01 * size.fold(0.0, f32::max);
        let away = vertex.distance(corners[0].point);
        let mut chord = 0.0_f32;
        for (index, ray) in corners.iter().enumerate() {
            for other in &corners[..index] {
                chord = chord.max((ray.direction - other.direction).length_squared());
            }
        }
        let begin = (away - size).max(0.0);
        let end = (away + size) * (1.00001 / (1.0 - 0.375 * chord).max(0.0025).sqrt());
        for (upper, [first, second, third]) in [(false, [0, 1, 2]), (true, [3, 2, 1])] {
            let rays = [first, second, third].map(|index| corners[index]);
            for met in solve(rays, vertex, begin, end) {
                let inwards = Vec2::new(met.weights.y, met.weights.z);
                let inwards = if upper { 1.0 - inwards } else { inwards };
                let nearest = usize::from(inwards.x >= 0.5) + 2 * usize::from(inwards.y >= 0.5);
                if corners[nearest].kind != Kind::Seen {
                    continue;
                }
                let mut place = Some((cell.as_vec2() + inwards, met.t, met.focal));
                if met.is_steep {
                    place = self.polished(cell.as_vec2() + inwards, &met, vertex);
                }
                if let Some((at, t, focal)) = place {
                    let sheet = if self.first { 0 } else { focal };
                    keep(kept, sheet, Kept { at: at - 0.5, t });
                }
            }
        }
    }
}

/// `swept_boxes/polish.wesl`.
impl Twin {
    fn polished(&self, begin: Vec2, met: &Met, vertex: Vec3) -> Option<(Vec2, f32, usize)> {
        let along = met.direction;
        let axis = if along.x.abs() > 0.6 * along.length() {
            Vec3::Y
        } else {
            Vec3::X
        };
        let u = along.cross(axis).normalize();
        let v = along.cross(u).normalize();
        let (mut at, mut last) = (begin, 0.4);
        for _ in 0..8 {
            if last <= 0.001 {
                break;
            }
            let Some([point, direction, point_x, direction_x, point_y, direction_y]) =
                self.patch(at)
            else {
                return Some((begin, met.t, met.focal));
            };
            let t = (vertex - point).dot(direction) / direction.length_squared();
            let across = |way: Vec3| Vec2::new(way.dot(u), way.dot(v));
            let off = across(vertex - point - t * direction);
            let off_x = across(-(point_x + t * direction_x));
            let off_y = across(-(point_y + t * direction_y));
            let area = off_x.perp_dot(off_y);
            let step = -Vec2::new(off.perp_dot(off_y), off_x.perp_dot(off)) / area;
            last = step.length().min(0.4);
            at += step.clamp_length_max(0.4);
        }
        if last >= 0.01 || at.distance(begin) > 0.7 {
            return None;
        }
        let [point, direction, point_x, direction_x, point_y, direction_y] = self.patch(at)?;
        let t = (vertex - point).dot(direction) / direction.length_squared();
        let turns = [direction_x, direction_y];
        Some((at, t, focal_count([point_x, point_y], turns, direction, t)))
    }

    /// Point, direction and their derivatives, on the cubics through four rays each way.
    fn patch(&self, at: Vec2) -> Option<[Vec3; 6]> {
        let first = at.floor().as_ivec2() - 1;
        if first.cmplt(IVec2::ZERO).any() || (first + 3).cmpge(self.ray_size).any() {
            return None;
        }
        let part = at - at.floor();
        let shares = |x: f32| {
            let (square, cube) = (x * x, x * x * x);
            [
                -0.5 * cube + square - 0.5 * x,
                1.5 * cube - 2.5 * square + 1.0,
                -1.5 * cube + 2.0 * square + 0.5 * x,
                0.5 * cube - 0.5 * square,
            ]
        };
        let slopes = |x: f32| {
            let square = x * x;
            [
                -1.5 * square + 2.0 * x - 0.5,
                4.5 * square - 5.0 * x,
                -4.5 * square + 4.0 * x + 0.5,
                1.5 * square - x,
            ]
        };
        let (x, y, dx, dy) = (
            shares(part.x),
            shares(part.y),
            slopes(part.x),
            slopes(part.y),
        );
        let mut sums = [Vec3::ZERO; 6];
        for row in 0..4 {
            for column in 0..4 {
                let texel = first + IVec2::new(column as i32, row as i32);
                let ray = self.ray(texel);
                if ray.kind != Kind::Seen || !ray.goes_on {
                    return None;
                }
                let weights = [x[column] * y[row], dx[column] * y[row], x[column] * dy[row]];
                for (index, weight) in weights.into_iter().enumerate() {
                    sums[2 * index] += weight * ray.point;
                    sums[2 * index + 1] += weight * ray.direction;
                }
            }
        }
        Some(sums)
    }
}

fn keep(kept: &mut [Option<Kept>; SHEETS], sheet: usize, new: Kept) {
    const SAME: f32 = 0.1;
    if kept
        .iter()
        .flatten()
        .any(|other| other.at.distance(new.at) < SAME)
    {
        return;
    }
    let further = sheet + SHEETS / 2;
    match kept[sheet] {
        Some(old) if old.t > new.t => {
            kept[further] = Some(old);
            kept[sheet] = Some(new);
        }
        Some(_) => kept[further] = Some(new),
        None => kept[sheet] = Some(new),
    }
}

fn ray_at(gbuffer: &GBuffer, view: &ViewUniform, pixel: IVec2) -> Ray {
    let reflected = |point: Vec3, normal: Vec3| {
        let dir = (point - view.eye).normalize();
        (dir - 2.0 * dir.dot(normal) * normal).normalize()
    };
    if gbuffer.shows_front(pixel) {
        let point = gbuffer.position(pixel);
        let normal = gbuffer.normal(pixel);
        let goes_on = [IVec2::X, IVec2::Y].into_iter().all(|way| {
            let other = pixel + way;
            !gbuffer.shows_front(other) || {
                let there = [gbuffer.position(other), gbuffer.normal(other)];
                is_smooth(view, [point, normal], there)
            }
        });
        let (kind, direction) = (Kind::Seen, reflected(point, normal));
        return Ray {
            kind,
            point,
            direction,
            goes_on,
        };
    }
    let continued = |ways: [[i32; 2]; 4]| {
        let (mut point, mut normal, mut count) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for way in ways.map(IVec2::from_array) {
            let (near, far) = (pixel + way, pixel + 2 * way);
            if gbuffer.shows_front(near) && gbuffer.shows_front(far) {
                let both = [near, far].map(|at| [gbuffer.position(at), gbuffer.normal(at)]);
                if is_smooth(view, both[0], both[1]) {
                    point += 2.0 * both[0][0] - both[1][0];
                    normal += 2.0 * both[0][1] - both[1][1];
                    count += 1.0;
                }
            }
        }
        (point, normal, count)
    };
    let (mut point, mut normal, mut count) = continued([[1, 0], [-1, 0], [0, 1], [0, -1]]);
    if count == 0.0 {
        (point, normal, count) = continued([[1, 1], [-1, 1], [1, -1], [-1, -1]]);
    }
    if count == 0.0 || normal == Vec3::ZERO {
        return Ray {
            kind: Kind::Nothing,
            point: Vec3::ZERO,
            direction: Vec3::ZERO,
            goes_on: true,
        };
    }
    point /= count;
    normal = normal.normalize();
    let direction = reflected(point, normal);
    Ray {
        kind: Kind::Continued,
        point,
        direction,
        goes_on: true,
    }
}

fn is_between(
    [low, high]: [Vec3; 2],
    [least, greatest]: [Vec3; 2],
    vertex: Vec3,
    [mut begin, mut end]: [f32; 2],
    wider: f32,
) -> bool {
    let inverse =
        |slope: f32| 1.0 / (slope.abs().max(1e-18)).copysign(if slope >= 0.0 { 1.0 } else { -1.0 });
    for axis in 0..3 {
        let below = (vertex[axis] + wider - low[axis]) * inverse(least[axis]);
        let above = (vertex[axis] - wider - high[axis]) * inverse(greatest[axis]);
        if least[axis] >= 0.0 {
            end = end.min(below);
        } else {
            begin = begin.max(below);
        }
        if greatest[axis] >= 0.0 {
            begin = begin.max(above);
        } else {
            end = end.min(above);
        }
    }
    begin <= end
}

fn focal_count(edges: [Vec3; 2], turns: [Vec3; 2], direction: Vec3, t: f32) -> usize {
    let a = turns[0].cross(turns[1]).dot(direction);
    let b = (turns[0].cross(edges[1]) + edges[0].cross(turns[1])).dot(direction);
    let c = edges[0].cross(edges[1]).dot(direction);
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let q = -0.5 * (b + if b >= 0.0 { root } else { -root });
    let one = if a == 0.0 { FAR } else { q / a };
    let other = if q == 0.0 { FAR } else { c / q };
    [one, other]
        .iter()
        .filter(|focus| **focus > 0.0 && **focus < t)
        .count()
}

/// A triangle's solution.
struct Met {
    weights: Vec3,
    t: f32,
    /// Focal points before the vertex.
    focal: usize,
    direction: Vec3,
    is_steep: bool,
}

/// A triangle's solutions.
fn solve(rays: [&Ray; 3], vertex: Vec3, begin: f32, end: f32) -> Vec<Met> {
    let base = 0.5 * (begin + end);
    let turns = [1, 2].map(|index: usize| rays[index].direction - rays[0].direction);
    let edges = [1, 2].map(|index: usize| rays[index].point - rays[0].point);
    let point = (rays[0].point - vertex) + base * rays[0].direction;
    let sides = [edges[0] + base * turns[0], edges[1] + base * turns[1]];
    let direction = rays[0].direction;
    let det = |a: Vec3, b: Vec3, c: Vec3| Mat3::from_cols(a, b, c).determinant();
    let c = Vec4::new(
        det(point, sides[0], sides[1]),
        det(direction, sides[0], sides[1])
            + det(point, turns[0], sides[1])
            + det(point, sides[0], turns[1]),
        det(direction, turns[0], sides[1])
            + det(direction, sides[0], turns[1])
            + det(point, turns[0], turns[1]),
        det(direction, turns[0], turns[1]),
    );
    let cubic = |t: f32| ((c.w * t + c.z) * t + c.y) * t + c.x;
    let (low, high) = (begin - base, end - base);
    let mut parts = [low, high, high, high];
    let under = c.z * c.z - 3.0 * c.w * c.y;
    if under > 0.0 {
        let q = -(c.z
            + if c.z >= 0.0 {
                under.sqrt()
            } else {
                -under.sqrt()
            });
        let one = if c.w == 0.0 { high } else { q / (3.0 * c.w) };
        let other = if q == 0.0 { high } else { c.y / q };
        parts[1] = one.min(other).clamp(low, high);
        parts[2] = one.max(other).clamp(low, high);
    }
    let mut found = Vec::new();
    for part in parts.windows(2) {
        let [from, to] = [part[0], part[1]];
        let (at_from, at_to) = (cubic(from), cubic(to));
        if to <= from || at_from != 0.0 && (at_from > 0.0) == (at_to > 0.0) {
            continue;
        }
        // A bisection: the shader's steps end at the same root.
        let (mut a, mut b) = (from, to);
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            if (cubic(middle) > 0.0) == (at_to > 0.0) {
                b = middle;
            } else {
                a = middle;
            }
        }
        let t = 0.5 * (a + b);
        let a = -(point + t * direction);
        let [b, c] = [sides[0] + t * turns[0], sides[1] + t * turns[1]];
        let normal = b.cross(c);
        let size = normal.length_squared();
        let [u, v] = [a.cross(c).dot(normal) / size, b.cross(a).dot(normal) / size];
        let weights = Vec3::new(1.0 - u - v, u, v);
        let whole = base + t;
        let longest = [b, c, b - c]
            .map(Vec3::length)
            .into_iter()
            .fold(0.0, f32::max);
        let rounding = 2.4e-7 * (vertex.length() + whole);
        let outside = (2e-3 + rounding * longest / size.sqrt()).min(0.5);
        if weights.cmpge(Vec3::splat(-outside)).all() && whole > 0.0 {
            let direction = direction + u * turns[0] + v * turns[1];
            found.push(Met {
                weights,
                t: whole,
                focal: focal_count(edges, turns, direction, whole),
                direction,
                is_steep: normal.dot(direction).abs() < 0.1 * longest * longest,
            });
        }
    }
    found
}
