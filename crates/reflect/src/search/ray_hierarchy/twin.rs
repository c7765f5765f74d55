//! Twin of `ray_hierarchy/build.wesl`, `ray_hierarchy/search.wesl` and `shared/angle.wesl`.

use glam::{IVec2, Vec2, Vec3, Vec4};

use super::{Again, RayHierarchy, Repair};
use crate::stage::points::{Effort, Found};
use crate::stage::twin::GBuffer;

const PI: f32 = std::f32::consts::PI;
const HALF_PI: f32 = std::f32::consts::FRAC_PI_2;

fn arcsine(x: f32) -> f32 {
    let above = x > 0.5;
    let square = if above { 0.5 * (1.0 - x) } else { x * x };
    let root = if above { square.sqrt() } else { x };
    let mut series = 4.216_32e-2;
    series = series * square + 2.418_131e-2;
    series = series * square + 4.547_002_5e-2;
    series = series * square + 7.495_300_3e-2;
    series = series * square + 1.666_675_2e-1;
    let angle = root + root * square * series;
    if above { HALF_PI - 2.0 * angle } else { angle }
}

fn angle_between(a: Vec3, b: Vec3) -> f32 {
    if a.dot(b) >= 0.0 {
        return 2.0 * arcsine((0.5 * (a - b).length()).min(1.0));
    }
    PI - 2.0 * arcsine((0.5 * (a + b).length()).min(1.0))
}

const EMPTY: Vec4 = Vec4::new(0.0, 0.0, 0.0, -1.0);

fn bound_sphere(a: Vec4, b: Vec4) -> Vec4 {
    if a.w == -1.0 {
        return b;
    }
    if b.w == -1.0 {
        return a;
    }
    let between = b.truncate() - a.truncate();
    let apart = between.length();
    if apart == 0.0 {
        return a.truncate().extend(a.w.max(b.w));
    }
    let center = a.truncate() + 0.5 * (between + between / apart * (b.w - a.w));
    center.extend(0.5 * (apart + a.w + b.w))
}

fn bound_cone(a: Vec4, b: Vec4) -> Vec4 {
    if a.w == -1.0 {
        return b;
    }
    if b.w == -1.0 {
        return a;
    }
    let (axis_a, axis_b) = (a.truncate(), b.truncate());
    let sum = axis_a + axis_b;
    let size = sum.length();
    let direction = if size == 0.0 { axis_a } else { sum / size };
    direction.extend(0.5 * angle_between(axis_a, axis_b) + a.w.max(b.w))
}

/// One level: square images of spheres and cones.
struct Level {
    side: usize,
    spheres: Vec<Vec4>,
    cones: Vec<Vec4>,
}

/// What `build.wesl` makes, level 0 first.
struct Pyramid {
    levels: Vec<Level>,
}

impl Pyramid {
    fn build(gbuffer: &GBuffer) -> Self {
        let longer = gbuffer.size.max_element() as usize;
        let mut levels = vec![base(gbuffer, longer.next_power_of_two().max(2))];
        while let Some(below) = levels.last()
            && below.side > 1
        {
            let level = bound(below);
            levels.push(level);
        }
        Self { levels }
    }

    fn top(&self) -> Node {
        Node {
            level: self.levels.len() - 1,
            x: 0,
            y: 0,
        }
    }

    fn sphere(&self, node: Node) -> Vec4 {
        let level = &self.levels[node.level];
        level.spheres[node.y * level.side + node.x]
    }

    fn cone(&self, node: Node) -> Vec4 {
        let level = &self.levels[node.level];
        level.cones[node.y * level.side + node.x]
    }
}

fn base(gbuffer: &GBuffer, side: usize) -> Level {
    let mut level = Level {
        side,
        spheres: vec![EMPTY; side * side],
        cones: vec![EMPTY; side * side],
    };
    for texel in 0..side * side {
        let at = IVec2::new((texel % side) as i32, (texel / side) as i32);
        if gbuffer.on_mirror(at) {
            let (point, normal) = (gbuffer.position(at), gbuffer.normal(at));
            let viewing = (point - gbuffer.eye).normalize();
            let reflected = viewing - 2.0 * normal.dot(viewing) * normal;
            level.spheres[texel] = point.extend(0.0);
            level.cones[texel] = reflected.extend(0.0);
        }
    }
    level
}

fn bound(below: &Level) -> Level {
    let side = below.side / 2;
    let bounded = |values: &[Vec4], bound: fn(Vec4, Vec4) -> Vec4| {
        let texel = |texel: usize| {
            let child =
                |dx, dy| values[(2 * (texel / side) + dy) * below.side + 2 * (texel % side) + dx];
            bound(
                bound(child(0, 0), child(1, 0)),
                bound(child(0, 1), child(1, 1)),
            )
        };
        (0..side * side).map(texel).collect()
    };
    Level {
        side,
        spheres: bounded(&below.spheres, bound_sphere),
        cones: bounded(&below.cones, bound_cone),
    }
}

#[derive(Clone, Copy)]
struct Node {
    level: usize,
    x: usize,
    y: usize,
}

impl Node {
    fn child(self, index: usize) -> Self {
        Self {
            level: self.level - 1,
            x: 2 * self.x + (index & 1),
            y: 2 * self.y + (index >> 1),
        }
    }
}

fn contains(
    sphere: Vec4,
    cone: Vec4,
    vertex: Vec3,
    [cone_factor, sphere_factor]: [f32; 2],
) -> bool {
    let radius = sphere.w * sphere_factor;
    let towards = vertex - sphere.truncate();
    let apart = towards.length();
    if apart <= radius {
        return true;
    }
    let angle = angle_between(towards / apart, cone.truncate());
    angle <= cone.w * cone_factor + arcsine(radius / apart)
}

/// What `search.wesl` hands over.
#[derive(Debug, PartialEq)]
struct Answer {
    /// Where the answer is a pixel.
    texel: Option<IVec2>,
    position: Vec3,
    state: u32,
    node_tests: u32,
    flags: u32,
}

struct Descent<'a> {
    gbuffer: &'a GBuffer,
    pyramid: &'a Pyramid,
    /// `repair=enlarge`: what is repeated, with which factors on cones and spheres.
    enlarge: Option<(Again, [f32; 2])>,
    /// `repair=stop`.
    stop: Option<usize>,
}

impl<'a> Descent<'a> {
    fn new(gbuffer: &'a GBuffer, pyramid: &'a Pyramid, options: &RayHierarchy) -> Self {
        let factors = [options.cone, options.sphere].map(|factor| factor as f32);
        let is = |repair| options.repair == repair;
        Self {
            gbuffer,
            pyramid,
            enlarge: is(Repair::Enlarge).then_some((options.again, factors)),
            stop: is(Repair::Stop).then_some(options.stop as usize),
        }
    }

    fn search(&self, vertex: Vec3, image_from_world: impl Fn(Vec3) -> Vec2) -> Answer {
        let pyramid = self.pyramid;
        let (mut node_tests, mut flags) = (0, 0);
        let mut stack = vec![pyramid.top()];
        let mut push_children = |stack: &mut Vec<Node>, node: Node, factors: [f32; 2]| {
            let before = stack.len();
            for index in 0..4 {
                let child = node.child(index);
                let sphere = pyramid.sphere(child);
                if sphere.w == -1.0 {
                    continue;
                }
                node_tests += 1;
                if contains(sphere, pyramid.cone(child), vertex, factors) {
                    stack.push(child);
                }
            }
            stack.len() > before
        };
        let mut stopped = false;
        let mut node = pyramid.top();
        let mut factors = [1.0, 1.0];
        while let Some(next) = stack.pop() {
            node = next;
            stopped = self.stop.is_some_and(|stop| node.level <= stop);
            if stopped || node.level == 1 {
                break;
            }
            if !push_children(&mut stack, node, factors) {
                flags |= Effort::MET_HOLE;
                if let Some((Again::Hole, enlarged)) = self.enlarge {
                    flags |= Effort::ENLARGED;
                    push_children(&mut stack, node, enlarged);
                }
            }
            match self.enlarge {
                Some((Again::Last, enlarged)) if stack.is_empty() => {
                    flags |= Effort::ENLARGED;
                    push_children(&mut stack, node, enlarged);
                }
                Some((Again::Search, enlarged))
                    if stack.is_empty() && flags & Effort::ENLARGED == 0 =>
                {
                    flags |= Effort::ENLARGED;
                    factors = enlarged;
                    stack.push(pyramid.top());
                }
                _ => {}
            }
            if stack.is_empty() {
                flags |= Effort::STAND_IN;
            }
        }
        if !stopped {
            let children = (0..4).map(|index| node.child(index));
            let marked = children.filter(|child| pyramid.sphere(*child).w != -1.0);
            let distance = |child: &Node| {
                let offset = vertex - pyramid.sphere(*child).truncate();
                let direction = pyramid.cone(*child).truncate();
                (offset - offset.dot(direction).max(0.0) * direction).length()
            };
            let closest = marked.min_by(|a, b| distance(a).total_cmp(&distance(b)));
            node = closest.expect("a texel that is marked has a marked child");
        }
        let position = pyramid.sphere(node).truncate();
        let pixel = IVec2::new(node.x as i32, node.y as i32);
        let texel = if node.level == 0 {
            pixel
        } else {
            image_from_world(position).floor().as_ivec2()
        };
        let hidden = self.gbuffer.on_mirror(texel)
            && (vertex - position).dot(self.gbuffer.normal(texel)) < 0.0;
        Answer {
            texel: (node.level == 0).then_some(pixel),
            position,
            state: if hidden { Found::HIDDEN } else { Found::FOUND },
            node_tests,
            flags,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::Gpu;
    use crate::parse;
    use crate::search::ray_hierarchy::pyramid::Pyramid as OnGpu;
    use crate::stage::twin::vertices;
    use crate::testing::{Searched, gpu_or_skip, scene};

    /// Share of vertices for which GPU and twin must find the same answer. Both round in `f32`,
    /// but not alike, so that a vertex on a cone's surface can be inside on one side only.
    const SAME_ANSWER: f64 = 0.999;

    /// Largest difference between GPU and twin, at any level: sphere centres, radii (in mirror
    /// radii of about 1) and cone axes take a few roundings of 6e-8 a level, ten levels high. Cone
    /// angles add up half angles of wide cones, where a rounding of the axes counts double.
    const SAME_BOUND: f32 = 1e-5;

    /// Largest error of the arc sine: two units in the last place of values up to pi/2.
    const ARCSINE: f64 = 2.4e-7;

    #[test]
    fn arc_sine_is_exact_to_the_last_place() {
        for step in 0..=100_000 {
            let x = step as f32 / 100_000.0;
            let error = (f64::from(arcsine(x)) - f64::from(x).asin()).abs();
            assert!(error <= ARCSINE, "{x}: {error}");
        }
    }

    #[test]
    fn angles_small_and_large() {
        for angle in [0.0_f32, 1e-5, 0.3, 1.5, 1.7, 3.0, PI] {
            let found = angle_between(Vec3::X, Vec3::new(angle.cos(), angle.sin(), 0.0));
            assert!((found - angle).abs() <= 1e-6, "{angle}: {found}");
        }
    }

    #[test]
    fn bounds_are_the_published_ones() {
        let sphere = |x: f32, radius: f32| Vec4::new(x, 0.0, 0.0, radius);
        assert_eq!(
            bound_sphere(sphere(0.0, 1.0), sphere(4.0, 1.0)),
            sphere(2.0, 3.0)
        );
        assert_eq!(bound_sphere(EMPTY, sphere(4.0, 1.0)), sphere(4.0, 1.0));
        assert_eq!(
            bound_sphere(sphere(4.0, 1.0), sphere(4.0, 2.0)),
            sphere(4.0, 2.0)
        );
        // The flaw: a sphere within the other gives one that does not hold the larger.
        assert_eq!(
            bound_sphere(sphere(0.0, 3.0), sphere(1.0, 0.0)),
            sphere(-1.0, 2.0)
        );
        let cone = bound_cone(Vec4::new(1.0, 0.0, 0.0, 0.1), Vec4::new(0.0, 1.0, 0.0, 0.3));
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let expected = Vec4::new(half, half, 0.0, 0.25 * PI + 0.3);
        assert!((cone - expected).abs().max_element() < 1e-6, "{cone}");
        let opposite = bound_cone(
            Vec4::new(1.0, 0.0, 0.0, 0.0),
            Vec4::new(-1.0, 0.0, 0.0, 0.0),
        );
        assert_eq!(opposite, Vec4::new(1.0, 0.0, 0.0, HALF_PI));
    }

    fn read(gpu: &Gpu, pyramid: &OnGpu) -> Vec<[Vec<Vec4>; 2]> {
        let textures = [&pyramid.spheres, &pyramid.cones];
        (0..pyramid.spheres.mip_level_count())
            .map(|level| {
                textures.map(|texture| {
                    let texels = gpu.read_level(texture, level);
                    texels.into_iter().map(Vec4::from_array).collect()
                })
            })
            .collect()
    }

    #[test]
    fn gpu_builds_the_same_pyramid() {
        let Some(gpu) = gpu_or_skip() else { return };
        for (name, size) in [("prototype-sphere", [256, 256]), ("spheres", [160, 120])] {
            let scene = scene(name);
            let searched = Searched::new(&gpu, &scene, "ray-hierarchy", size);
            for mirror in 0..scene.mirrors.len() {
                let on_gpu = OnGpu::new(&gpu, &searched.stage).expect("fits the device");
                gpu.run(|frame| {
                    searched.stage.record_maps(frame, mirror);
                    on_gpu.record(frame, &searched.stage, mirror);
                });
                let twin = Pyramid::build(&GBuffer::read(&gpu, &searched.stage, mirror));
                let levels = read(&gpu, &on_gpu);
                assert_eq!(levels.len(), twin.levels.len());
                for (number, (level, [spheres, cones])) in
                    twin.levels.iter().zip(&levels).enumerate()
                {
                    let same = |ours: &[Vec4], theirs: &[Vec4], what: &str| {
                        assert_eq!(ours.len(), theirs.len());
                        for (texel, (ours, theirs)) in ours.iter().zip(theirs).enumerate() {
                            let apart = (*ours - *theirs).abs().max_element();
                            assert!(
                                apart <= SAME_BOUND,
                                "{name}, mirror {mirror}, {what} {texel} of level {number}: \
                                 {ours} and {theirs}"
                            );
                        }
                    };
                    same(&level.spheres, spheres, "sphere");
                    same(&level.cones, cones, "cone");
                }
            }
        }
    }

    /// Share of equal answers and equal counts, and number of vertices.
    fn agreement(gpu: &Gpu, name: &str, options: &str, size: [u32; 2]) -> (f64, f64, usize) {
        let scene = scene(name);
        let technique = format!("ray-hierarchy({options})");
        let spec = parse(&technique).expect("a technique");
        let (options, _) = spec.options().of().expect("its own");
        let searched = Searched::new(gpu, &scene, &technique, size);
        let view = scene.camera.view(size);
        let (mut same, mut same_work, mut count) = (0, 0, 0);
        for (mirror, points) in searched.batches.iter().enumerate() {
            let gbuffer = GBuffer::read(gpu, &searched.stage, mirror);
            let pyramid = Pyramid::build(&gbuffer);
            let descent = Descent::new(&gbuffer, &pyramid, &options);
            let positions = vertices(&searched.stage);
            let found = points.read_found(gpu, positions.len() as u32);
            let efforts = points.read_efforts(gpu, positions.len() as u32);
            for ((found, effort), vertex) in found.iter().zip(&efforts).zip(positions) {
                let answer = descent.search(vertex, |point| {
                    let projected = view.project(point.as_dvec3());
                    projected.expect("in front of the eye").0.as_vec2()
                });
                let same_place = match answer.texel {
                    Some(texel) => found.at.floor().as_ivec2() == texel,
                    None => found.position.distance(answer.position) <= SAME_BOUND,
                };
                same += usize::from(
                    same_place && (found.state, effort.flags) == (answer.state, answer.flags),
                );
                same_work += usize::from(effort.node_tests == answer.node_tests);
                count += 1;
            }
        }
        let share = |part: usize| part as f64 / count as f64;
        (share(same), share(same_work), count)
    }

    #[test]
    fn gpu_finds_the_same_answers() {
        let Some(gpu) = gpu_or_skip() else { return };
        for (name, options, size) in [
            ("prototype-sphere", "repair=none", [512, 512]),
            ("prototype-sphere", "repair=stop,stop=2", [256, 256]),
            ("prototype-ellipsoid", "repair=enlarge", [256, 256]),
            ("prototype-sphere", "repair=enlarge,again=hole", [256, 256]),
            ("prototype-bowl", "repair=enlarge,cone=1.2", [160, 120]),
            ("prototype-bowl", "repair=enlarge,again=last", [160, 120]),
            ("spheres", "repair=none", [160, 120]),
            ("sphere-touching", "occluders=cut", [160, 120]),
        ] {
            let (share, work, count) = agreement(&gpu, name, options, size);
            assert!(count > 500, "{name}: only {count} vertices");
            assert!(share >= SAME_ANSWER, "{name} {options}: {share} of {count}");
            assert!(
                work >= SAME_ANSWER,
                "{name} {options}: work, {work} of {count}"
            );
        }
    }

    #[test]
    fn two_runs_give_the_same_answers_and_counts() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("prototype-sphere");
        let mut searched = Searched::new(&gpu, &scene, "ray-hierarchy(repair=enlarge)", [128, 128]);
        let read = |searched: &Searched| {
            let count = searched.stage.world.vertices();
            let found = searched.batches[0].read_found(&gpu, count);
            let efforts = searched.batches[0].read_efforts(&gpu, count);
            format!("{found:?} {efforts:?}")
        };
        let first = read(&searched);
        searched.run(&gpu);
        assert_eq!(first, read(&searched));
    }
}
