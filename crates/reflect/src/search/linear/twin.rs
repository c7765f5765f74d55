//! Twin of `linear.wesl` and `start.wesl`.

use glam::{IVec2, Vec2, Vec3};

use crate::stage::points::Found;
use crate::stage::twin::GBuffer;

struct Walk<'a> {
    gbuffer: &'a GBuffer,
    cross: bool,
    eight: bool,
    extend: bool,
}

/// What `linear.wesl` hands over.
#[derive(Debug, PartialEq)]
struct Answer {
    texel: IVec2,
    state: u32,
    steps: u32,
    evaluations: u32,
}

const MAX_STEPS_PER_SIDE: u32 = 8;
const OFFSETS: [IVec2; 8] = [
    IVec2::new(-1, 0),
    IVec2::new(0, -1),
    IVec2::new(1, 0),
    IVec2::new(0, 1),
    IVec2::new(-1, -1),
    IVec2::new(1, -1),
    IVec2::new(1, 1),
    IVec2::new(-1, 1),
];

/// `start.wesl`; `wanted` in image coordinates.
fn start(gbuffer: &GBuffer, wanted: Vec2) -> Option<IVec2> {
    let wanted = wanted
        .floor()
        .as_ivec2()
        .clamp(IVec2::ZERO, gbuffer.size - 1);
    let texels =
        (0..gbuffer.size.y).flat_map(|y| (0..gbuffer.size.x).map(move |x| IVec2::new(x, y)));
    texels
        .filter(|texel| gbuffer.on_mirror(*texel))
        .min_by_key(|texel| (*texel - wanted).length_squared())
}

impl Walk<'_> {
    fn fitness(&self, texel: IVec2, vertex: Vec3) -> f32 {
        let point = self.gbuffer.position(texel);
        let normal = self.gbuffer.normal(texel);
        let towards_eye = (self.gbuffer.eye - point).normalize();
        let mut to_vertex = vertex - point;
        if self.extend {
            to_vertex -= 2.0 * to_vertex.dot(normal).min(0.0) * normal;
        }
        let bisector = (towards_eye + to_vertex.normalize()).normalize();
        let cosine = bisector.dot(normal);
        if self.cross {
            let sine = bisector.cross(normal).length();
            return -if cosine > 0.0 { sine } else { 2.0 - sine };
        }
        cosine
    }

    fn search(&self, start: IVec2, vertex: Vec3) -> Answer {
        let max_steps = MAX_STEPS_PER_SIDE * self.gbuffer.size.element_sum() as u32;
        let neighbours = if self.eight { 8 } else { 4 };
        let mut current = start;
        let mut best = self.fitness(current, vertex);
        let mut evaluations = 1;
        let mut steps = 0;
        let mut finished = false;
        while !finished && steps < max_steps {
            steps += 1;
            let mut next = current;
            for offset in &OFFSETS[..neighbours] {
                let neighbour = current + *offset;
                if self.gbuffer.on_mirror(neighbour) {
                    let value = self.fitness(neighbour, vertex);
                    evaluations += 1;
                    if value > best {
                        best = value;
                        next = neighbour;
                    }
                }
            }
            finished = next == current;
            current = next;
        }
        let point = self.gbuffer.position(current);
        let normal = self.gbuffer.normal(current);
        let hidden = (vertex - point).dot(normal) < 0.0;
        Answer {
            texel: current,
            state: match (finished, hidden) {
                (false, _) => Found::FAILED,
                (true, true) => Found::HIDDEN,
                (true, false) => Found::FOUND,
            },
            steps,
            evaluations,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::twin::vertices;
    use crate::testing::{Searched, gpu_or_skip, scene};

    /// Share of vertices for which GPU and twin must find the same texel. Both round in `f32`, but
    /// not alike: the GPU may fuse products and sums and take another square root, so that two
    /// nearly equal neighbours can change places.
    const SAME_TEXEL: f64 = 0.999;

    fn agreement(name: &str, options: &str, size: [u32; 2]) -> Option<(f64, usize)> {
        let gpu = gpu_or_skip()?;
        let scene = scene(name);
        let technique = format!("linear({options})");
        let searched = Searched::new(&gpu, &scene, &technique, size);
        let (mut same, mut count) = (0, 0);
        for (mirror, points) in searched.batches.iter().enumerate() {
            let extend = options.contains("extend");
            let gbuffer = GBuffer::read(&gpu, &searched.stage, mirror);
            let view = scene.camera.view(size);
            let center = scene.mirrors[mirror].shape.middle();
            let (wanted, _) = view.project(center).expect("in front of the eye");
            let from = start(&gbuffer, wanted.as_vec2()).expect("the mirror is in view");
            let walk = Walk {
                gbuffer: &gbuffer,
                cross: options.contains("cross"),
                eight: options.contains("=8"),
                extend,
            };
            let positions = vertices(&searched.stage);
            let found = points.read_found(&gpu, positions.len() as u32);
            for (found, vertex) in found.iter().zip(positions) {
                let answer = walk.search(from, vertex);
                let texel = found.at.floor().as_ivec2();
                same += usize::from((texel, found.state) == (answer.texel, answer.state));
                count += 1;
            }
        }
        Some((same as f64 / count as f64, count))
    }

    #[test]
    fn gpu_finds_the_same_texels() {
        for (name, options, size) in [
            ("prototype-sphere", "residual=dot", [512, 512]),
            (
                "prototype-ellipsoid",
                "residual=cross,neighbours=8",
                [256, 256],
            ),
            ("prototype-bowl", "residual=cross", [256, 256]),
            ("sphere-objects-20k", "neighbours=8", [160, 120]),
            ("spheres", "residual=dot", [160, 120]),
            ("spheres", "occluders=cut", [160, 120]),
            ("sphere-touching", "hidden=extend", [160, 120]),
            ("kitchen", "hidden=extend,residual=cross", [160, 120]),
        ] {
            let Some((share, count)) = agreement(name, options, size) else {
                return;
            };
            assert!(count > 500, "{name}: only {count} vertices");
            assert!(share >= SAME_TEXEL, "{name} {options}: {share} of {count}");
        }
    }
}
