//! Twin of `tessellation/kernels.wesl`: the edge error and the loop. New points are searched by the GPU's
//! own search, which has a twin of its own, so that what differs here is the tessellation's.

use glam::{IVec2, Vec3};

use crate::stage::points::Found;
use crate::stage::twin::{GBuffer, image};
use crate::stage::view::ViewUniform;

/// Weight 1 of a packed place.
const WHOLE: u32 = 1 << 14;

/// Edge error and loop on one mirror.
struct Tessellation<'a> {
    view: ViewUniform,
    gbuffer: &'a GBuffer,
    threshold: f32,
    level: u32,
}

/// A point of the geometry with its answer.
#[derive(Clone, Copy)]
struct Point {
    position: Vec3,
    answer: Found,
}

/// A triangle that was judged or left over.
#[derive(Clone, Copy)]
struct Triangle {
    points: [usize; 3],
    source: u32,
    places: [u32; 3],
    level: u32,
    /// Index of the triangle it was split from.
    parent: Option<usize>,
    error: f32,
    split: bool,
}

fn halfway(a: u32, b: u32) -> u32 {
    (a + b) >> 1
}

impl Tessellation<'_> {
    fn edge_error(&self, a: &Point, b: &Point) -> f32 {
        if a.answer.state == Found::FAILED || b.answer.state == Found::FAILED {
            return 1.0;
        }
        let on_edge = (a.answer.position + b.answer.position) * 0.5;
        let Some(at) = image(&self.view, on_edge) else {
            return 1.0;
        };
        let texel: IVec2 = at.floor().as_ivec2();
        if !self.gbuffer.on_mirror(texel) {
            return 1.0;
        }
        let normal = self.gbuffer.normal(texel);
        let towards_eye = (self.view.eye - on_edge).normalize();
        let towards_middle = ((a.position + b.position) * 0.5 - on_edge).normalize();
        let bisector = (towards_eye + towards_middle).normalize();
        (1.0 - (normal.dot(bisector) + 1.0) * 0.5).clamp(0.0, 1.0)
    }

    fn judge(&self, points: &[Point], triangle: &mut Triangle) {
        let [a, b, c] = triangle.points.map(|point| &points[point]);
        let edges = [self.edge_error(a, b), self.edge_error(b, c)];
        triangle.error = edges[0].max(edges[1]).max(self.edge_error(c, a));
        let given_up = [a, b, c]
            .iter()
            .all(|point| [Found::HIDDEN, Found::UNREFLECTED].contains(&point.answer.state));
        triangle.split = !given_up && self.threshold < 1.0 && triangle.error >= self.threshold;
    }

    /// All triangles that the loop meets, judged; those not split are the finished ones.
    fn run(
        &self,
        mut points: Vec<Point>,
        sources: &[[usize; 3]],
        search: impl Fn(&[Vec3]) -> Vec<Found>,
    ) -> Vec<Triangle> {
        let original = |(source, points): (u32, &[usize; 3])| Triangle {
            points: *points,
            source,
            places: [0, WHOLE, WHOLE << 16],
            level: 0,
            parent: None,
            error: 0.0,
            split: false,
        };
        let mut all: Vec<_> = (0..).zip(sources).map(original).collect();
        let mut working = 0..all.len();
        for _ in 0..self.level {
            let first = points.len();
            let mut positions = Vec::new();
            let mut children = Vec::new();
            for index in working.clone() {
                self.judge(&points, &mut all[index]);
                let parent = all[index];
                if !parent.split {
                    continue;
                }
                let [a, b, c] = parent.points.map(|point| points[point].position);
                let m = [0, 1, 2].map(|edge| first + positions.len() + edge);
                positions.extend([(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5]);
                let [p, q, r] = parent.points;
                let [x, y, z] = parent.places;
                let at = [halfway(x, y), halfway(y, z), halfway(z, x)];
                for (points, places) in [
                    ([p, m[0], m[2]], [x, at[0], at[2]]),
                    ([m[0], q, m[1]], [at[0], y, at[1]]),
                    ([m[2], m[1], r], [at[2], at[1], z]),
                    (m, at),
                ] {
                    children.push(Triangle {
                        points,
                        places,
                        level: parent.level + 1,
                        parent: Some(index),
                        split: false,
                        ..parent
                    });
                }
            }
            let answers = search(&positions);
            let new = positions.into_iter().zip(answers);
            points.extend(new.map(|(position, answer)| Point { position, answer }));
            working = all.len()..all.len() + children.len();
            all.extend(children);
        }
        for index in working {
            let above = &mut all[index];
            self.judge(&points, above);
            above.split = false;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use std::collections::{HashMap, HashSet};

    use super::*;
    use crate::gpu::{Gpu, storage_bytes};
    use crate::refine::tessellation::tests::Tessellated;
    use crate::stage::options::Under;
    use crate::stage::points::{Points, points_layout};
    use crate::stage::twin::vertices;
    use crate::stage::variant::Variant;
    use crate::testing::{Searched, gpu_or_skip, scene};

    /// Share by which the number of triangles of a level may differ: what lies at the threshold.
    const COUNTS: f64 = 0.001;
    /// How near to the threshold the error of a triangle must be that GPU and twin judge
    /// differently: a few roundings of `f32` in the scalar product of unit vectors.
    const NEAR: f32 = 1e-6;

    fn search(gpu: &Gpu, searched: &Searched, mirror: usize, positions: &[Vec3]) -> Vec<Found> {
        let count = positions.len() as u32;
        let padded: Vec<_> = positions.iter().map(|p| p.extend(1.0).to_array()).collect();
        let buffer = storage_bytes(gpu, bytemuck::cast_slice(&padded));
        let points = Points::new(gpu, &points_layout(gpu), &buffer, count);
        gpu.run(|frame| {
            let variant = Variant::Color;
            let sheet = searched.sheets[mirror];
            (searched.search).record_search(frame, &searched.stage, sheet, &points, variant);
        });
        points.read_found(gpu, count)
    }

    fn check(gpu: &Gpu, name: &str, options: &str, size: [u32; 2]) {
        let scene = scene(name);
        let technique = format!("linear+adaptive({options})");
        let gpus = Tessellated::new(gpu, &scene, &technique, size);
        let searched = &gpus.searched;
        let gbuffer = GBuffer::read(gpu, &searched.stage, 0);
        let twin = Tessellation {
            view: ViewUniform::new(&scene, size, Under::Background),
            gbuffer: &gbuffer,
            threshold: gpus.rule.threshold.expect("adaptive"),
            level: gpus.rule.level,
        };
        let positions = vertices(&searched.stage);
        let answers = search(gpu, searched, 0, &positions);
        let points = positions.into_iter().zip(answers);
        let points = points.map(|(position, answer)| Point { position, answer });
        let mut first = 0;
        let mut sources = Vec::new();
        for object in &scene.objects {
            let triangles = object.mesh.triangles.iter();
            sources.extend(triangles.map(|corners| corners.map(|corner| first + corner as usize)));
            first += object.mesh.positions.len();
        }
        let all = twin.run(points.collect(), &sources, |new| {
            search(gpu, searched, 0, new)
        });

        let mut leaves = HashSet::new();
        let mut by_level = [0_u64; 9];
        for leaf in gpus.leaves(gpu, 0) {
            leaves.insert((leaf.piece.source, leaf.piece.places.to_array()));
            by_level[leaf.piece.level as usize] += 1;
        }
        let counted = by_level.iter().sum::<u64>() as usize;
        assert_eq!(leaves.len(), counted, "{name}: a triangle twice");
        let mut twins = [0_u64; 9];
        let mut differences = 0;
        let at_threshold = |triangle: &Triangle| {
            let off = (triangle.error - twin.threshold).abs();
            assert!(
                off < NEAR,
                "{name}: error {} is judged twice",
                triangle.error
            );
        };
        let key = |triangle: &Triangle| (triangle.source, triangle.places);
        let known: HashMap<_, _> = all
            .iter()
            .map(|triangle| (key(triangle), triangle))
            .collect();
        for triangle in all.iter().filter(|triangle| !triangle.split) {
            twins[triangle.level as usize] += 1;
            let upwards = std::iter::successors(triangle.parent, |parent| all[*parent].parent);
            let finished_above = upwards
                .into_iter()
                .any(|above| leaves.contains(&key(&all[above])));
            if !leaves.contains(&key(triangle)) && !finished_above {
                at_threshold(triangle);
                differences += 1;
            }
        }
        for leaf in &leaves {
            if let Some(triangle) = known.get(leaf).filter(|triangle| triangle.split) {
                at_threshold(triangle);
                differences += 1;
            }
        }
        assert!(twins[1..].iter().sum::<u64>() > 50, "{name}: {twins:?}");
        for (level, (gpu, twin)) in by_level.iter().zip(&twins).enumerate() {
            let off = gpu.abs_diff(*twin) as f64;
            assert!(
                off <= COUNTS * *twin as f64,
                "{name}, level {level}: {gpu} triangles, twin {twin} ({differences} differences)"
            );
        }
    }

    #[test]
    fn gpu_finishes_the_same_triangles() {
        let Some(gpu) = gpu_or_skip() else { return };
        check(
            &gpu,
            "sphere-square-hidden",
            "level=6,threshold=0.00001",
            [320, 240],
        );
        check(&gpu, "sphere-table", "level=3,threshold=0.001", [160, 120]);
        check(&gpu, "ellipsoid", "level=4,threshold=0.01", [160, 120]);
    }
}
