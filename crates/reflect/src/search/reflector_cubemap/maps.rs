//! Reflector cube maps: position and normal of a mirror by direction from its centre
//! (Estalella et al. 2005, §4.1).
//!
//! The centre sees each point of a closed star-shaped mirror once. Texels lie on the nodes of a
//! grid over each face, those of the outer rows exactly on the cube's edges: neighbouring faces
//! share these, so that bilinear interpolation is continuous across seams and never reads two
//! faces. A sphere's or an ellipsoid's texels are exact, unless `tessellation` asks for those of its
//! triangles; a mesh's are the points and interpolated normals of its triangles, however finely it is drawn. An open mirror has the maps of the closed
//! shape that it was cut from (§6.2): a bowl those of its whole sphere, seen from inside; a mesh, for
//! each of its pieces, those of the closed mesh that the scene file names for it.
//!
//! Face `2k` looks along axis `k` (x, y, z), face `2k + 1` against it. Coordinates on a face are
//! the direction's components along axes `k + 1` and `k + 2` (cyclic) where that along `k` is ±1.

use catoptric_scene::shape::{Facing, Sphere};
use catoptric_scene::{Mesh, Mirror, MirrorShape};
use glam::DVec3;

/// Position and normal of one texel, relative to the mirror's centre.
#[derive(Clone, Copy, Debug)]
struct Texel {
    position: DVec3,
    normal: DVec3,
}

/// Both cube maps of a mirror, faces one after the other, rows along the face's first coordinate.
#[derive(Clone, Debug)]
pub(crate) struct Maps {
    /// Texels along an edge of a face.
    pub size: u32,
    /// World-space offset from the mirror's centre; w is 1 on the mirror and 0 beyond the rim of an open
    /// one, on the closed surface that it was cut from.
    pub positions: Vec<[f32; 4]>,
    /// Unit, on the reflecting side; w is 0.
    pub normals: Vec<[f32; 4]>,
    /// 1 where normals point away from the centre, −1 where they point towards it.
    pub facing: f32,
    /// The centre, world space.
    pub center: DVec3,
}

/// Why a mirror has no cube maps, to be read after its name; `None` if it has.
pub(crate) fn objection(mirror: &Mirror) -> Option<String> {
    if mirror.proxies.is_empty() {
        return mirror.shape.facing().err().map(str::to_owned);
    }
    Maps::of(mirror, LOOK, 0).err()
}

/// Texels along an edge of the maps that tell whether proxies and mirror fit.
const LOOK: u32 = 64;

/// A mirror's point is one of its proxy if their distances from the centre differ by no more than this
/// share: both may be cut into triangles differently.
const SAME: f64 = 0.01;

fn corners(mesh: &Mesh, triangle: &[u32; 3], center: DVec3) -> [DVec3; 3] {
    triangle.map(|vertex| mesh.positions[vertex as usize].as_dvec3() - center)
}

/// Signed axis of a face, and its two coordinate axes.
fn face_axes(face: u32) -> [DVec3; 3] {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let axis = face as usize / 2;
    let sign = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
    [
        sign * axes[axis],
        axes[(axis + 1) % 3],
        axes[(axis + 2) % 3],
    ]
}

impl Maps {
    /// The maps of a mirror: one pair, or one for each of its proxies.
    ///
    /// # Errors
    /// Why it has none, to be read after its name.
    pub(crate) fn of(mirror: &Mirror, size: u32, tessellation: u32) -> Result<Vec<Self>, String> {
        if mirror.proxies.is_empty() {
            return match mirror.shape.facing() {
                Ok(_) => Ok(vec![Self::new(&*mirror.shape, size, tessellation)]),
                Err(reason) => Err(reason.to_owned()),
            };
        }
        let Some(mesh) = mirror.shape.as_mesh() else {
            return Err("has proxies and is no mesh".to_owned());
        };
        let proxies = mirror.proxies.iter().zip(1..);
        let piece = |(proxy, number): (&Mesh, u32)| {
            Self::of_piece(mesh, proxy, size)
                .map_err(|reason| format!("has a proxy (number {number}) that {reason}"))
        };
        proxies.map(piece).collect()
    }

    /// The maps of a closed mesh with those points of the mirror that lie on it.
    fn of_piece(mirror: &Mesh, proxy: &Mesh, size: u32) -> Result<Self, &'static str> {
        proxy.facing()?;
        let center = MirrorShape::center(proxy);
        let whole = of_mesh(proxy, center, size);
        let mut own: Vec<Option<Texel>> = vec![None; whole.len()];
        draw(mirror, center, size, |index, texel| {
            let off = |texel: &Texel| (texel.position - whole[index].position).length();
            if off(&texel) > SAME * whole[index].position.length() {
                return;
            }
            if own[index]
                .as_ref()
                .is_none_or(|other| off(&texel) < off(other))
            {
                own[index] = Some(texel);
            }
        });
        let outwards = |texel: &Texel| texel.normal.dot(texel.position) > 0.0;
        let mut facing = own.iter().flatten().map(outwards);
        let first = facing.next().ok_or("no part of the mirror lies on")?;
        if facing.any(|other| other != first) {
            return Err(
                "faces outwards in places and inwards in others: cut the mirror into convex and concave pieces",
            );
        }
        let side = if first { 1.0 } else { -1.0 };
        let four = |v: DVec3, w| [v.x as f32, v.y as f32, v.z as f32, w];
        let texels = || own.iter().zip(&whole);
        Ok(Self {
            size,
            positions: texels()
                .map(|(own, whole)| {
                    let position = own.as_ref().unwrap_or(whole).position;
                    four(position, f32::from(own.is_some()))
                })
                .collect(),
            normals: texels()
                .map(|(own, whole)| {
                    let normal = own.map_or(side * whole.normal, |texel| texel.normal);
                    four(normal, 0.0)
                })
                .collect(),
            facing: side as f32,
            center,
        })
    }

    /// Both maps, with `size` texels along an edge.
    ///
    /// # Panics
    /// On a shape that its centre does not see once all around.
    fn new(shape: &dyn MirrorShape, size: u32, tessellation: u32) -> Self {
        let facing = shape.facing().expect("the shape has cube maps");
        let texels = match (shape.as_mesh(), tessellation) {
            (Some(mesh), _) => of_mesh(mesh, shape.center(), size),
            (None, 0) => of_surface(shape, size),
            (None, segments) => of_mesh(&tessellated(shape, segments), shape.center(), size),
        };
        let four = |v: DVec3, w| [v.x as f32, v.y as f32, v.z as f32, w];
        let covered = |texel: &Texel| f32::from(shape.covers(texel.position.normalize()));
        let position = |texel: &Texel| four(texel.position, covered(texel));
        Self {
            size,
            positions: texels.iter().map(position).collect(),
            normals: texels.iter().map(|texel| four(texel.normal, 0.0)).collect(),
            facing: match facing {
                Facing::Outwards => 1.0,
                Facing::Inwards => -1.0,
            },
            center: shape.center(),
        }
    }
}

/// Coordinate in [−1, 1] of a texel on its face.
fn coordinate(texel: u32, size: u32) -> f64 {
    2.0 * f64::from(texel) / f64::from(size - 1) - 1.0
}

/// The whole closed surface that an analytic mirror is, or was cut from, in triangles with corners and
/// normals of the surface.
fn tessellated(shape: &dyn MirrorShape, segments: u32) -> Mesh {
    let unit = Sphere {
        center: DVec3::ZERO,
        radius: 1.0,
    };
    let mut mesh = unit.tessellate(segments.max(LEAST_SEGMENTS));
    let hit = |direction: glam::Vec3| {
        let hit = shape.from_center(direction.as_dvec3().normalize());
        hit.expect("the centre is inside the mirror")
    };
    for (triangle, normals) in mesh.triangles.iter().zip(&mut mesh.normals) {
        *normals = triangle.map(|corner| hit(mesh.positions[corner as usize]).normal.as_vec3());
    }
    for position in &mut mesh.positions {
        *position = hit(*position).position.as_vec3();
    }
    mesh
}

/// Fewest segments that a closed surface can be cut into.
const LEAST_SEGMENTS: u32 = 4;

fn of_surface(shape: &dyn MirrorShape, size: u32) -> Vec<Texel> {
    let center = shape.center();
    let mut texels = Vec::with_capacity(6 * (size * size) as usize);
    for face in 0..6 {
        let [axis, right, down] = face_axes(face);
        for row in 0..size {
            for column in 0..size {
                let [x, y] = [column, row].map(|texel| coordinate(texel, size));
                let direction = (axis + x * right + y * down).normalize();
                let hit = shape.from_center(direction);
                let hit = hit.expect("the centre is inside the mirror");
                texels.push(Texel {
                    position: hit.position - center,
                    normal: hit.normal,
                });
            }
        }
    }
    texels
}

/// How far outside a triangle a direction may pass, as a share of the triangle's width, so that
/// rounding leaves no texel between two triangles.
const EDGE_SLACK: f64 = 1e-9;

fn of_mesh(mesh: &Mesh, center: DVec3, size: u32) -> Vec<Texel> {
    let mut texels = vec![None; 6 * (size * size) as usize];
    draw(mesh, center, size, |index, texel| {
        texels[index] = Some(texel);
    });
    let covered = texels.into_iter().collect::<Option<Vec<_>>>();
    covered.expect("a closed star-shaped mesh covers every direction")
}

/// Draws a mesh as its centre sees it: hands over each texel that a triangle covers.
fn draw(mesh: &Mesh, center: DVec3, size: u32, mut texel: impl FnMut(usize, Texel)) {
    for (triangle, normals) in mesh.triangles.iter().zip(&mesh.normals) {
        let corners = corners(mesh, triangle, center);
        let normals = normals.map(glam::Vec3::as_dvec3);
        for face in 0..6 {
            project(face, size, &corners, &normals, &mut texel);
        }
    }
}

/// Draws the part of a triangle that a face of the cube sees.
fn project(
    face: u32,
    size: u32,
    corners: &[DVec3; 3],
    normals: &[DVec3; 3],
    texel: &mut impl FnMut(usize, Texel),
) {
    let [axis, right, down] = face_axes(face);
    let depths = corners.map(|corner| corner.dot(axis));
    if depths.iter().all(|depth| *depth <= 0.0) {
        return;
    }
    // A triangle that reaches behind the centre is looked for all over the face.
    let in_front = depths.iter().all(|depth| *depth > 0.0);
    let range = |along: DVec3| -> std::ops::RangeInclusive<u32> {
        let last = f64::from(size - 1);
        if !in_front {
            return 0..=size - 1;
        }
        let places = [0, 1, 2].map(|i| (corners[i].dot(along) / depths[i] + 1.0) / 2.0 * last);
        let [low, high] = [
            places.into_iter().fold(f64::MAX, f64::min),
            places.into_iter().fold(f64::MIN, f64::max),
        ];
        if high < -1.0 || low > last + 1.0 {
            #[expect(
                clippy::reversed_empty_ranges,
                reason = "nothing of it is on this face"
            )]
            return 1..=0;
        }
        let low = (low - EDGE_SLACK).ceil().clamp(0.0, last);
        let high = (high + EDGE_SLACK).floor().clamp(0.0, last);
        low as u32..=high as u32
    };
    let [a, b, c] = *corners;
    let sides = [b.cross(c), c.cross(a), a.cross(b)];
    let volume = a.dot(sides[0]);
    for row in range(down) {
        for column in range(right) {
            let [x, y] = [column, row].map(|texel| coordinate(texel, size));
            let direction = axis + x * right + y * down;
            let weights = sides.map(|side| side.dot(direction));
            let sum = weights[0] + weights[1] + weights[2];
            if sum * volume <= 0.0 || weights.iter().any(|w| w / sum < -EDGE_SLACK) {
                continue;
            }
            let normal = (0..3)
                .map(|i| normals[i] * (weights[i] / sum))
                .sum::<DVec3>();
            let index = ((face * size + row) * size + column) as usize;
            let normal = normal.normalize_or_zero();
            let position = direction * (volume / sum);
            texel(index, Texel { position, normal });
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::shape::{Bowl, Ellipsoid, Plane};
    use glam::{DMat3, Vec3};

    use super::*;

    const SIZE: u32 = 17;

    fn ellipsoid() -> Ellipsoid {
        Ellipsoid {
            center: DVec3::new(0.3, -2.0, 1.0),
            radii: DVec3::new(1.5, 0.7, 1.0),
            rotation: DMat3::from_rotation_y(0.4),
        }
    }

    fn mirror(shape: impl Into<catoptric_scene::Shape>) -> Mirror {
        Mirror {
            name: "m".to_owned(),
            shape: shape.into(),
            tessellation: 64,
            cubemaps: Vec::new(),
            proxies: Vec::new(),
            pose: catoptric_scene::Pose::REST,
        }
    }

    fn why_not(shape: impl Into<catoptric_scene::Shape>) -> Option<String> {
        objection(&mirror(shape))
    }

    fn direction(index: usize) -> DVec3 {
        let texel = index as u32 % (SIZE * SIZE);
        let [axis, right, down] = face_axes(index as u32 / (SIZE * SIZE));
        axis + coordinate(texel % SIZE, SIZE) * right + coordinate(texel / SIZE, SIZE) * down
    }

    #[test]
    fn texels_lie_on_the_surface_in_their_direction() {
        let shape = ellipsoid();
        let maps = Maps::new(&shape, SIZE, 0);
        assert_eq!(maps.positions.len(), 6 * 17 * 17);
        for (index, (position, normal)) in maps.positions.iter().zip(&maps.normals).enumerate() {
            let position = Vec3::from_slice(position).as_dvec3();
            assert!(position.angle_between(direction(index)) < 1e-6);
            let expected = shape.normal_at(shape.center() + position);
            let normal = Vec3::from_slice(normal).as_dvec3();
            assert!(expected.is_some_and(|expected| expected.distance(normal) < 1e-6));
        }
    }

    #[test]
    fn a_fine_mesh_gives_nearly_the_maps_of_its_surface() {
        // A chord of 1/48 of a turn leaves the surface by 1.5 · (1 − cos(π/48)) ≈ 0.0032 at most,
        // and a facet has one along the ring and one across.
        const CHORD: f32 = 0.0065;
        let shape = ellipsoid();
        let mesh = shape.tessellate(48);
        assert_eq!(why_not(mesh.clone()), None);
        let (exact, drawn) = (Maps::new(&shape, SIZE, 0), Maps::new(&mesh, SIZE, 0));
        let gap = |a: &[[f32; 4]], b: &[[f32; 4]]| {
            let pairs = a.iter().zip(b);
            let gaps = pairs.map(|(a, b)| Vec3::from_slice(a).distance(Vec3::from_slice(b)));
            gaps.fold(0.0, f32::max)
        };
        let positions = gap(&exact.positions, &drawn.positions);
        assert!(positions < CHORD, "{positions}");
        // The normal of a chord's middle is interpolated over it and turns with the curvature.
        let normals = gap(&exact.normals, &drawn.normals);
        assert!(normals < 4.0 * CHORD, "{normals}");
    }

    #[test]
    fn maps_of_a_tessellated_mirror_near_the_exact_ones_as_it_gets_finer() {
        let center = DVec3::new(0.3, -2.0, 1.0);
        let bowl = Bowl {
            center,
            radius: 1.5,
            axis: DVec3::NEG_Z,
            half_angle: 1.0,
        };
        for shape in [&ellipsoid() as &dyn MirrorShape, &bowl] {
            let exact = Maps::new(shape, SIZE, 0);
            let gaps = [8, 16, 32, 64].map(|tessellation| {
                let drawn = Maps::new(shape, SIZE, tessellation);
                let pairs = exact.positions.iter().zip(&drawn.positions);
                let gaps = pairs.map(|(a, b)| Vec3::from_slice(a).distance(Vec3::from_slice(b)));
                f64::from(gaps.sum::<f32>()) / exact.positions.len() as f64
            });
            // Chords are off by the square of a segment.
            for pair in gaps.windows(2) {
                assert!((2.5..6.0).contains(&(pair[0] / pair[1])), "{gaps:?}");
            }
        }
    }

    #[test]
    fn a_bowl_has_the_maps_of_its_sphere_from_inside() {
        let center = DVec3::new(0.3, -2.0, 1.0);
        let radius = 1.5;
        let bowl = Bowl {
            center,
            radius,
            axis: DVec3::NEG_Z,
            half_angle: 1.0,
        };
        let outside = Maps::new(&Sphere { center, radius }, SIZE, 0);
        let inside = Maps::new(&bowl, SIZE, 0);
        let places = |maps: &Maps| -> Vec<_> {
            let positions = maps.positions.iter();
            positions
                .map(|position| Vec3::from_slice(position))
                .collect()
        };
        assert_eq!(places(&inside), places(&outside));
        for position in &inside.positions {
            let direction = Vec3::from_slice(position).as_dvec3().normalize();
            let angle = direction.angle_between(bowl.axis);
            // As far as f32 knows a direction.
            let decided = (angle - bowl.half_angle).abs() > 1e-6;
            assert!(!decided || (position[3] == 1.0) == (angle < bowl.half_angle));
        }
        let turned = outside.normals.iter().map(|normal| normal.map(|c| -c));
        assert!(inside.normals.iter().copied().eq(turned));
        assert_eq!([outside.facing, inside.facing], [1.0, -1.0]);
    }

    #[test]
    fn open_inside_out_and_winding_mirrors_are_refused() {
        let plane = Plane {
            center: DVec3::ZERO,
            normal: DVec3::Y,
            up: DVec3::X,
            size: glam::DVec2::ONE,
        };
        assert!(why_not(plane).is_some_and(|reason| reason.contains("open")));
        let mut open = ellipsoid().tessellate(16);
        open.triangles.pop();
        open.normals.pop();
        assert!(why_not(open).is_some_and(|reason| reason.contains("closed")));
        let mut inside = ellipsoid().tessellate(16);
        for normal in inside.normals.as_flattened_mut() {
            *normal = -*normal;
        }
        assert!(why_not(inside).is_some_and(|reason| reason.contains("whole")));
        let mut dented = ellipsoid().tessellate(16);
        dented.positions[0] = Vec3::new(0.3, -2.6, 1.0);
        assert!(why_not(dented).is_some_and(|reason| reason.contains("whole")));
    }

    /// The triangles of a mesh whose corners all lie at `z` or above, relative to its centre.
    fn cap(mesh: &Mesh, z: f32) -> Mesh {
        let center = MirrorShape::center(mesh).z as f32;
        let above = |triangle: &[u32; 3]| {
            let corners = triangle.map(|corner| mesh.positions[corner as usize].z - center);
            corners.iter().all(|corner| *corner >= z)
        };
        let kept = |index: &usize| above(&mesh.triangles[*index]);
        let kept: Vec<usize> = (0..mesh.triangles.len()).filter(kept).collect();
        Mesh {
            triangles: kept.iter().map(|index| mesh.triangles[*index]).collect(),
            normals: kept.iter().map(|index| mesh.normals[*index]).collect(),
            material: kept.iter().map(|_| 0).collect(),
            uvs: Vec::new(),
            ..mesh.clone()
        }
    }

    #[test]
    fn a_piece_has_the_maps_of_its_proxy_and_covers_what_it_is_cut_out() {
        let whole = ellipsoid().tessellate(48);
        let mut open = mirror(cap(&whole, 0.4));
        assert!(objection(&open).is_some());
        open.proxies = vec![whole.clone()];
        assert_eq!(objection(&open), None);
        let [of_piece] = Maps::of(&open, SIZE, 0)
            .expect("maps")
            .try_into()
            .expect("one");
        let of_whole = Maps::new(&whole, SIZE, 0);
        assert_eq!(of_piece.facing, 1.0);
        let mut covered = 0;
        for (piece, whole) in of_piece.positions.iter().zip(&of_whole.positions) {
            let [piece_at, whole_at] = [piece, whole].map(|texel| Vec3::from_slice(texel));
            assert!(piece_at.distance(whole_at) < 1e-6);
            // Triangles at the rim are in or out as a whole.
            assert!(whole_at.z < 0.6 || piece[3] == 1.0);
            assert!(whole_at.z > 0.2 || piece[3] == 0.0);
            covered += usize::from(piece[3] == 1.0);
        }
        assert!(covered > 100 && covered < of_piece.positions.len() / 2);
    }

    #[test]
    fn the_inside_of_a_proxy_is_concave_and_a_piece_of_both_is_refused() {
        let whole = ellipsoid().tessellate(48);
        let mut dent = cap(&whole, 0.4);
        for normal in dent.normals.as_flattened_mut() {
            *normal = -*normal;
        }
        let mut mixed = dent.clone();
        let many = mixed.normals.len() / 2;
        for normal in mixed.normals[..many].as_flattened_mut() {
            *normal = -*normal;
        }
        let mut dent = mirror(dent);
        dent.proxies = vec![whole.clone()];
        let maps = Maps::of(&dent, SIZE, 0).expect("maps");
        assert_eq!(maps[0].facing, -1.0);
        for (position, normal) in maps[0].positions.iter().zip(&maps[0].normals) {
            assert!(Vec3::from_slice(position).dot(Vec3::from_slice(normal)) < 0.0);
        }
        let mut mixed = mirror(mixed);
        mixed.proxies = vec![whole.clone()];
        assert!(objection(&mixed).is_some_and(|reason| reason.contains("convex and concave")));
        let mut elsewhere = whole;
        let center = MirrorShape::center(&elsewhere).as_vec3();
        for position in &mut elsewhere.positions {
            *position += 0.5 * (*position - center);
        }
        dent.proxies = vec![elsewhere];
        assert!(objection(&dent).is_some_and(|reason| reason.contains("no part of the mirror")));
    }
}
