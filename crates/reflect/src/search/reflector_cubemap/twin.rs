//! The search on the CPU: twin of `reflector_cubemap.wesl`, line by line in `f32`. Tests compare
//! the two; pictures show its steps.

use catoptric_scene::Scene;
use glam::{Vec2, Vec3};

use super::maps::Maps;
use super::{Image, Projection, ReflectorCubemap, Settings, Sheets};
use crate::options::Options as _;
use crate::spec::Options;
use crate::stage::options::{Hidden, SearchOptions};

/// The search in the reflector cube maps of one mirror, on the CPU: the walk for its first sheet.
///
/// Vertices are in world space. A place on the cube is a direction from the mirror's centre with
/// largest component 1.
#[derive(Clone, Debug)]
pub struct CubemapWalk {
    settings: Settings,
    maps: Maps,
    center: Vec3,
    /// Relative to the centre.
    eye: Vec3,
    extend: bool,
    published: bool,
    several: bool,
}

/// A step of a search: places on the cube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubemapStep {
    /// Where it begins.
    pub from: Vec3,
    /// Half a step along the field there, where the field is taken again.
    pub halfway: Vec3,
    /// A whole step along that.
    pub to: Vec3,
}

/// What a search hands over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubemapAnswer {
    /// Point of the mirror, world space.
    pub position: Vec3,
    /// Eye or vertex is behind the tangent plane there.
    pub hidden: bool,
    /// It lies beyond the rim of an open mirror.
    pub unreflected: bool,
    /// The walk has not arrived, where it must.
    pub failed: bool,
}

struct Start {
    direction: Vec3,
    continued: bool,
}

const NEAR_MISS: f32 = 1.05;
const LEAST_COSINE: f32 = 0.05;
const LEAST_DEPTH: f32 = 0.1;
const EPSILON: f32 = 1e-12;

fn major(q: Vec3) -> usize {
    let size = q.abs();
    if size.x >= size.y && size.x >= size.z {
        return 0;
    }
    if size.y >= size.z { 1 } else { 2 }
}

fn on_cube(q: Vec3) -> Vec3 {
    q / q.abs()[major(q)]
}

struct Surface {
    position: Vec3,
    normal: Vec3,
    cover: f32,
}

struct Field {
    step: Vec3,
    error: f32,
}

impl CubemapWalk {
    /// The search that `reflector-cubemap` with these options does on a mirror (an index), in the maps of
    /// its first proxy if it has some.
    ///
    /// # Panics
    /// On options of another technique, or a mirror that has no cube maps.
    pub fn new(options: &Options, scene: &Scene, mirror: usize) -> Self {
        let mirror = &scene.mirrors[mirror];
        let own = options.of();
        let (own, mut common): (ReflectorCubemap, _) = own.expect("options of this search");
        let common = SearchOptions::read(&mut common);
        let maps = Maps::of(mirror, own.size, own.tessellation).map(|mut all| all.swap_remove(0));
        let maps = maps.expect("cube maps");
        let image = own.sheets.images(maps.facing)[0];
        Self {
            settings: Settings::new(&own, &maps, mirror.shape.center(), image),
            several: own.sheets != Sheets::First,
            center: maps.center.as_vec3(),
            eye: (scene.camera.eye - maps.center).as_vec3(),
            maps,
            extend: common.hidden == Hidden::Extend,
            published: own.projection == Projection::Published,
        }
    }

    /// The projected bisector at a place, in the plane of its face: a step of length 1.
    pub fn bisector(&self, place: Vec3, vertex: Vec3) -> Vec3 {
        let vertex = vertex - self.center;
        let continued = self.start(vertex).continued;
        let surface = self.lookup(place);
        self.field(place, major(place), &surface, vertex, continued)
            .step
    }

    /// True where a search begins by looking where the line of sight meets the mirror.
    pub fn looks_along_the_line_of_sight(&self) -> bool {
        self.extend || self.several
    }

    fn lookup(&self, q: Vec3) -> Surface {
        let size = self.settings.size;
        let axis = major(q);
        let scale = q.abs()[axis];
        let place = Vec2::new(q[(axis + 1) % 3], q[(axis + 2) % 3]) / scale;
        let texel = ((place + 1.0) * 0.5).clamp(Vec2::ZERO, Vec2::ONE) * (size - 1) as f32;
        let low = texel.as_uvec2().min(glam::UVec2::splat(size - 2));
        let weight = texel - low.as_vec2();
        let layer = 2 * axis as u32 + u32::from(q[axis] < 0.0);
        let at = |map: &[[f32; 4]], x: u32, y: u32| {
            let texel = ((layer * size + low.y + y) * size + low.x + x) as usize;
            glam::Vec4::from_array(map[texel])
        };
        let blend = |map: &[[f32; 4]]| {
            let top = at(map, 0, 0).lerp(at(map, 1, 0), weight.x);
            let bottom = at(map, 0, 1).lerp(at(map, 1, 1), weight.x);
            top.lerp(bottom, weight.y)
        };
        let position = blend(&self.maps.positions);
        Surface {
            position: position.truncate(),
            normal: blend(&self.maps.normals).truncate().normalize(),
            cover: position.w,
        }
    }

    fn field(
        &self,
        q: Vec3,
        axis: usize,
        surface: &Surface,
        vertex: Vec3,
        continued: bool,
    ) -> Field {
        let to_eye = (self.eye - surface.position).normalize();
        let mut to_vertex = vertex - surface.position;
        if continued {
            to_vertex -= 2.0 * to_vertex.dot(surface.normal).min(0.0) * surface.normal;
        }
        let sum = to_eye + to_vertex / to_vertex.length().max(1e-30);
        let bisector = self.settings.sense * sum / sum.length().max(1e-30);
        let normal = self.settings.sense * surface.normal;
        let turn = bisector - normal;
        let step = if self.published {
            let side = q[axis].signum();
            let mut step = bisector / (side * bisector[axis]).max(LEAST_DEPTH)
                - normal / (side * normal[axis]).max(LEAST_DEPTH);
            step[axis] = 0.0;
            step
        } else {
            (turn - turn[axis] / q[axis] * q) * q.length()
        };
        Field {
            step,
            error: 0.25 * turn.dot(turn),
        }
    }

    fn fitting_step(&self, surface: &Surface, vertex: Vec3) -> f32 {
        let to_eye = self.eye - surface.position;
        let a = to_eye.length();
        let b = vertex.distance(surface.position).max(1e-30);
        let cosine = (to_eye.dot(surface.normal).abs() / a).max(LEAST_COSINE);
        1.0 / (1.0 + 0.5 * surface.position.length() * (1.0 / a + 1.0 / b) / cosine)
    }

    fn start(&self, vertex: Vec3) -> Start {
        let to_eye = self.eye.normalize();
        let middle = to_eye + vertex / vertex.length().max(1e-30);
        let at_middle = self.settings.from_eye == 0 && middle.length() > 1e-3;
        let mut begin = Start {
            direction: self.settings.facing * if at_middle { middle } else { to_eye },
            continued: false,
        };
        if self.extend || self.several {
            let along = (vertex - self.eye).normalize();
            let mut nearest = self.eye - self.eye.dot(along) * along;
            if nearest.length() <= 1e-3 * self.eye.length() {
                nearest = 1e-3 * to_eye;
            }
            let below = self.lookup(nearest);
            let radius = below.position.length();
            let out = nearest.length() / radius;
            let slope = out * below.normal.dot(along) / below.normal.dot(below.position);
            let aside = if slope > 0.0 { -radius } else { radius };
            let other = nearest + aside * along;
            let other_out = other.length() / self.lookup(other).position.length();
            let bend = other_out * other_out - out * out - 2.0 * slope * aside;
            let bend = (bend / (aside * aside)).max(1e-6);
            let least = out * out - slope * slope / bend;
            let half = (bend * (1.0 - least)).max(0.0).sqrt();
            let met = nearest - (slope + self.settings.facing * half) / bend * along;
            if self.extend && least < NEAR_MISS * NEAR_MISS && (vertex - met).dot(along) > 0.0 {
                begin.continued = true;
                if least < 1.0 && self.settings.from_eye == 0 {
                    begin.direction = met;
                }
            }
            if self.settings.image == Image::Upright as u32 {
                begin.direction = met;
            }
        }
        begin
    }

    /// Searches for a vertex; `visit` is shown every step.
    pub fn search(&self, vertex: Vec3, mut visit: impl FnMut(CubemapStep)) -> CubemapAnswer {
        let vertex = vertex - self.center;
        let Start {
            direction,
            continued,
        } = self.start(vertex);
        let mut q = on_cube(direction);
        let mut surface = self.lookup(q);
        let mut axis = major(q);
        let mut here = self.field(q, axis, &surface, vertex, continued);
        let fits = self.settings.first_step == 0.0;
        let mut factor = if fits { 1.0 } else { self.settings.first_step };
        let mut steps = 0;
        while steps < self.settings.iterations && here.error >= EPSILON {
            steps += 1;
            let mut length_of_step = factor;
            if fits {
                length_of_step *= self.fitting_step(&surface, vertex);
            }
            let halfway = q + 0.5 * length_of_step * here.step;
            let there = self.field(halfway, axis, &self.lookup(halfway), vertex, continued);
            let from = q;
            q = on_cube(q + length_of_step * there.step);
            let longer = here.step.length().max(there.step.length()).max(1e-30);
            let change = here.step.distance(there.step) / longer;
            if change > self.settings.different {
                factor *= self.settings.shrink;
            } else if change < self.settings.similar {
                factor *= self.settings.grow;
            }
            factor = factor.clamp(self.settings.least, self.settings.greatest);
            surface = self.lookup(q);
            axis = major(q);
            here = self.field(q, axis, &surface, vertex, continued);
            visit(CubemapStep {
                from,
                halfway,
                to: q,
            });
        }
        CubemapAnswer {
            hidden: (vertex - surface.position).dot(surface.normal) < 0.0
                || (self.eye - surface.position).dot(surface.normal) < 0.0,
            unreflected: surface.cover < 0.5,
            failed: self.several && here.error > self.settings.accept,
            position: self.center + surface.position,
        }
    }
}
