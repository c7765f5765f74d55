//! Where a mirror's cube maps are taken from (Číž 2017, section 3.8): from where the scene file says,
//! or near its surface, far from each other, the most successful first.
//!
//! Without a place in the file, candidates are tried: small maps are drawn from each (with the mirrors, if the traced
//! maps show them among the objects), and a small picture says for which mirror pixels such a map surely resolves the
//! ray (a sign change of Δ where the map is continuous). Then the maps are chosen greedily, each for the pixels that
//! those before leave; `objects=auto` stops where the next one is not worth its cost.

use catoptric_scene::shape::Facing;
use catoptric_scene::{Mesh, Mirror, Random, Scene};
use glam::DVec3;

use super::maps::{MORE, MirrorMaps, TraceUniform};
use super::march::{self, Effort};
use super::options::{Accept, CubemapTrace, Objects, Placement};
use crate::error::ReflectError;
use crate::gpu::{FLOAT4, Gpu, target, view};
use crate::image_order::cubemaps::{Wanted, maps_layout};
use crate::stage::Stage;
use crate::stage::variant::Variant;

/// Candidates for each mirror.
const CANDIDATES: usize = 16;
/// Most maps of a mirror where their number is not given.
const MOST: usize = 8;
/// Share of a mirror's pixels that another map must resolve to be worth it (`objects=auto`).
const WORTH: f64 = 0.002;
/// Longer side of the picture in which candidates are tried, pixels, and texels a side of the maps that are
/// tried.
const TRIAL_SIDE: u32 = 64;
/// The same where a gain as small as [`WORTH`] is to be seen.
const FINE_TRIAL_SIDE: u32 = 128;
/// Step of trial rays, as a share of their length.
const TRIAL_STEP: f32 = 0.004;
/// Seed of the candidates: the same scene has the same maps in every run.
const SEED: u64 = 2017;

/// World-space centres of the maps of each mirror, in the order in which they are traced.
pub(crate) fn places(
    gpu: &Gpu,
    options: &CubemapTrace,
    stage: &Stage,
) -> Result<Vec<Vec<DVec3>>, ReflectError> {
    let number = options.objects.number();
    let most = number.unwrap_or(MOST);
    let outside = options.among().is_some();
    let scene = &stage.world.scene;
    let count = match options.placement {
        Placement::Auto => CANDIDATES,
        Placement::Random => most,
        Placement::Scene => {
            let by_mirror = scene.mirrors.iter().map(|mirror| &mirror.cubemaps);
            let listed = by_mirror.map(|places| places[..most.min(places.len())].to_vec());
            return Ok(listed.collect());
        }
    };
    let mut rng = Random::new(SEED);
    let mut candidates: Vec<Vec<DVec3>> = Vec::new();
    for mirror in &scene.mirrors {
        candidates.push(self::candidates(scene, mirror, outside, count, &mut rng));
    }
    let covered = Trial::new(gpu, options, stage)?.covered(gpu, &candidates)?;
    let chosen = candidates.iter().zip(&covered).map(|(centers, covered)| {
        let worth = WORTH * covered.pixels as f64;
        let least = if number.is_some() {
            0
        } else {
            (worth.ceil() as usize).max(1)
        };
        let order = greedy(centers, &covered.by_candidate, most, least);
        order.into_iter().map(|index| centers[index]).collect()
    });
    Ok(chosen.collect())
}

/// Why the places in the scene file are not enough.
pub(crate) fn objection(options: &CubemapTrace, scene: &Scene) -> Option<String> {
    if options.placement != Placement::Scene {
        return None;
    }
    let wanted = options.objects.number();
    let outside = options.among().is_some();
    scene.mirrors.iter().find_map(|mirror| {
        let (name, listed) = (&mirror.name, mirror.cubemaps.len());
        let least = wanted.unwrap_or(1);
        if listed < least {
            return Some(format!(
                "placement=scene: mirror \"{name}\" has places for {listed} of the {least} maps \
                 (key `cubemaps` in the scene file)"
            ));
        }
        let inside = |center: &&DVec3| outside && mirror.shape.contains(**center);
        let taken = wanted.unwrap_or(MOST).min(listed);
        let center = mirror.cubemaps[..taken].iter().find(inside)?;
        Some(format!(
            "placement=scene: with bounces={},mirrors=among the maps show the mirrors, but the one at {center} lies \
             inside mirror \"{name}\"",
            options.bounces
        ))
    })
}

/// Points near a mirror's surface, the first one a good guess; never behind a surface that stands
/// before the mirror. Inside closed mirrors only where the maps do not show them (`outside` is false).
fn candidates(
    scene: &Scene,
    mirror: &Mirror,
    outside: bool,
    count: usize,
    rng: &mut Random,
) -> Vec<DVec3> {
    let (low, high) = mirror.shape.bounds();
    let radius = (high - low).length() / 2.0;
    let mesh = mirror.shape.tessellate(mirror.tessellation.min(32));
    let inside = mirror.shape.is_closed() && !outside;
    let first = if let Some((center, normal)) = mirror.shape.flat() {
        center + 0.01 * radius * normal
    } else if inside || mirror.shape.facing() == Ok(Facing::Inwards) {
        mirror.shape.center()
    } else {
        surface_point(scene, &mesh, rng, 0.2 * radius)
    };
    let mut points = vec![first];
    while points.len() < count {
        let height = if inside && rng.below(2) == 0 {
            rng.between(-0.8, 0.0)
        } else {
            rng.between(0.02, 0.6)
        };
        points.push(surface_point(scene, &mesh, rng, height * radius));
    }
    points
}

/// A corner of a mesh, moved along its normal, but not farther than halfway to what lies there.
fn surface_point(scene: &Scene, mesh: &Mesh, rng: &mut Random, height: f64) -> DVec3 {
    let triangle = rng.below(mesh.triangles.len());
    let corner = rng.below(3);
    let position = mesh.positions[mesh.triangles[triangle][corner] as usize];
    let normal = mesh.normals[triangle][corner].as_dvec3();
    let (from, twice) = (position.as_dvec3(), 2.0 * height * normal);
    from + 0.5 * free_part(scene, from, twice) * twice
}

/// The share of a way, from 0 to 1, that leads to the first object on it.
fn free_part(scene: &Scene, from: DVec3, way: DVec3) -> f64 {
    let objects = scene.objects.iter();
    let hits = objects.flat_map(|object| {
        let mesh = &object.mesh;
        let corner = |index: u32| mesh.positions[index as usize].as_dvec3();
        let triangles = mesh.triangles.iter();
        triangles.filter_map(move |triangle| crossing(triangle.map(corner), from, way))
    });
    hits.fold(1.0, f64::min)
}

/// Where a way meets a triangle, as a share of the way (Möller and Trumbore 1997).
fn crossing([a, b, c]: [DVec3; 3], from: DVec3, way: DVec3) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let across = way.cross(ac);
    let volume = ab.dot(across);
    if volume == 0.0 {
        return None;
    }
    let off = from - a;
    let u = off.dot(across) / volume;
    let turned = off.cross(ab);
    let v = way.dot(turned) / volume;
    let t = ac.dot(turned) / volume;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    (inside && (0.0..=1.0).contains(&t)).then_some(t)
}

/// Indices of the candidates chosen, each covering the most of what is left; where nothing is left
/// to cover, the one farthest from those chosen. None after the first that covers less than `least` pixels
/// of what is left.
fn greedy(centers: &[DVec3], covered: &[Vec<bool>], wanted: usize, least: usize) -> Vec<usize> {
    let mut chosen: Vec<usize> = Vec::new();
    let mut left = vec![true; covered.first().map_or(0, Vec::len)];
    while chosen.len() < wanted.min(centers.len()) {
        let gain = |index: usize| {
            let pixels = covered[index].iter().zip(&left);
            let gained = pixels.filter(|(covered, left)| **covered && **left).count();
            let distances = chosen
                .iter()
                .map(|other| centers[*other].distance(centers[index]));
            (gained, distances.fold(f64::INFINITY, f64::min))
        };
        let free = (0..centers.len()).filter(|index| !chosen.contains(index));
        let best = free.map(|index| (gain(index), std::cmp::Reverse(index)));
        let best =
            best.max_by(|(a, i), (b, j)| (a.0.cmp(&b.0)).then(a.1.total_cmp(&b.1)).then(i.cmp(j)));
        let Some(((gained, _), std::cmp::Reverse(index))) = best else {
            break;
        };
        if gained < least && !chosen.is_empty() {
            break;
        }
        for (left, covered) in left.iter_mut().zip(&covered[index]) {
            *left &= !covered;
        }
        chosen.push(index);
    }
    chosen
}

/// What the candidates of a mirror resolve.
#[derive(Clone, Default)]
struct Covered {
    /// Pixels that show the mirror.
    pixels: usize,
    /// By candidate, pixel of the whole picture: whether the ray is resolved in that candidate's map.
    by_candidate: Vec<Vec<bool>>,
}

/// A small picture of the scene in which candidates are tried.
struct Trial<'a> {
    options: &'a CubemapTrace,
    /// See [`TRIAL_SIDE`].
    side: u32,
    stage: Stage,
    own_layout: wgpu::BindGroupLayout,
    rays: Effort,
}

impl<'a> Trial<'a> {
    fn new(gpu: &Gpu, options: &'a CubemapTrace, stage: &Stage) -> Result<Self, ReflectError> {
        let [width, height] = stage.world.size;
        let side = if options.objects == Objects::Auto {
            FINE_TRIAL_SIDE
        } else {
            TRIAL_SIDE
        };
        let scale = f64::from(side) / f64::from(width.max(height));
        let size = [width, height].map(|side| ((f64::from(side) * scale) as u32).max(1));
        let stage = Stage::new(gpu, stage.options, &stage.world.scene, size)?;
        let own_layout = maps_layout(gpu, "trial", MORE);
        // Where any sign change counts, the first one must be a certain one.
        let mut features = vec!["continuous"];
        if options.accept == Accept::Any {
            features.push("strict");
        }
        if options.among().is_some() {
            features.push("bounce");
        }
        let rays = Effort::new(gpu, &features, &stage, &own_layout)?;
        gpu.run(|frame| stage.begin(frame, Variant::Color));
        Ok(Self {
            options,
            side,
            stage,
            own_layout,
            rays,
        })
    }

    /// What each mirror's candidates resolve.
    fn covered(&self, gpu: &Gpu, candidates: &[Vec<DVec3>]) -> Result<Vec<Covered>, ReflectError> {
        let trace = TraceUniform {
            step: TRIAL_STEP,
            ..TraceUniform::new(self.options, &self.stage.world.scene)
        };
        let wanted = |center: DVec3| Wanted {
            size: self.side,
            centers: vec![center],
            traced: 1,
            mirrors: self.options.among(),
        };
        let effort = target(gpu, "trial", self.stage.world.size, FLOAT4);
        let mut covered = vec![Covered::default(); candidates.len()];
        let most = candidates.iter().map(Vec::len).max().unwrap_or(0);
        let first = candidates.iter().map(|centers| {
            MirrorMaps::new(
                gpu,
                false,
                &trace,
                &self.stage,
                wanted(centers[0]),
                &self.own_layout,
            )
        });
        let mut maps = first.collect::<Result<Vec<_>, _>>()?;
        gpu.check()?;
        for round in 0..most {
            for (maps, centers) in maps.iter_mut().zip(candidates) {
                maps.maps.set_centers(gpu, &self.stage, &[centers[round]]);
            }
            let groups: Vec<_> = maps.iter().map(|maps| &maps.group).collect();
            gpu.run(|frame| {
                for maps in &maps {
                    maps.record(frame, &self.stage);
                }
                self.rays
                    .record(frame, &self.stage, &groups, &view(&effort));
            });
            let texels = gpu.read_texture(&effort);
            let mirrors = gpu.read_texture(&self.stage.gbuffer.position);
            for (covered, mirror) in covered.iter_mut().zip(&self.stage.world.mirrors) {
                let shown = mirrors.iter().map(|point| point[3] == mirror.id as f32);
                covered.pixels = shown.clone().filter(|shown| *shown).count();
                let pixels = texels.iter().zip(shown);
                let resolved = pixels.map(|(effort, shown)| shown && march::is_resolved(effort));
                covered.by_candidate.push(resolved.collect());
            }
        }
        Ok(covered)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_candidate_lies_behind_a_wall() {
        let scene = crate::testing::scene("box");
        let (low, high) = (DVec3::new(-1.4, 0.0, -1.4), DVec3::new(1.4, 2.2, 4.0));
        for outside in [false, true] {
            let mut rng = Random::new(SEED);
            let points = candidates(&scene, &scene.mirrors[0], outside, 64, &mut rng);
            for point in points {
                // The ball touches the floor.
                let within = point.cmpge(low).all() && point.cmple(high).all();
                assert!(within, "{point}");
            }
        }
    }

    #[test]
    fn a_way_is_free_up_to_the_first_object_on_it() {
        let scene = crate::testing::scene("box");
        let from = DVec3::new(0.3, 1.9, 1.5);
        // The ceiling is 2.2 high.
        let part = |way| free_part(&scene, from, way);
        assert!((part(DVec3::Y) - 0.3).abs() < 1e-6);
        assert_eq!(part(0.2 * DVec3::Y), 1.0);
    }

    #[test]
    fn the_second_map_is_chosen_for_what_the_first_leaves() {
        let centers = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let covered = [
            vec![true, true, true, false],
            vec![true, true, false, false],
            vec![false, false, false, true],
        ];
        assert_eq!(greedy(&centers, &covered, 2, 0), [0, 2]);
        assert_eq!(greedy(&centers, &covered, 3, 0), [0, 2, 1]);
    }

    #[test]
    fn no_map_is_added_that_is_not_worth_it() {
        let centers = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let covered = [
            vec![true, true, true, false, false, false],
            vec![true, true, false, true, true, false],
            vec![false, false, false, false, false, true],
        ];
        // Of two that cover as much the farther one.
        assert_eq!(greedy(&centers, &covered, 3, 1), [1, 2, 0]);
        assert_eq!(greedy(&centers, &covered, 3, 2), [1]);
        // One at least.
        assert_eq!(greedy(&centers, &covered, 3, 9), [1]);
    }

    #[test]
    fn with_nothing_left_to_cover_the_farthest_is_chosen() {
        let centers = [DVec3::ZERO, DVec3::X, 3.0 * DVec3::X];
        let covered = [vec![true], vec![false], vec![false]];
        assert_eq!(greedy(&centers, &covered, 2, 0), [0, 2]);
    }
}
