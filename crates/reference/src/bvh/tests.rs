use proptest::prelude::*;

use super::walk::EQUAL;
use super::*;

fn point() -> impl Strategy<Value = Vec3> {
    (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

/// Every triangle on its own, by the baseline of this kind of processor.
fn brute_force(bvh: &TriangleBvh, triangles: &[[Vec3; 3]], ray: [DVec3; 2]) -> Option<TriangleHit> {
    let level = Level::baseline();
    let [origin, dir] = ray;
    let hits = (0..triangles.len() as u32).filter_map(|index| {
        let block = leaf::Block::new(&[index], triangles);
        dispatch!(level, simd => {
            let (bits, lanes) = leaf::Sheared::new(simd, origin, dir).intersect(simd, &block)?;
            let [u, v, w] = lanes.barycentric;
            (bits & 1 == 1 && lanes.t[0] > 0.0).then_some(TriangleHit {
                triangle: index,
                t: lanes.t[0],
                barycentric: DVec3::new(u[0], v[0], w[0]),
                corners: triangles[index as usize].map(Vec3::as_dvec3),
            })
        })
    });
    let hits: Vec<_> = hits.collect();
    let nearest = hits.iter().map(|hit| hit.t).min_by(f64::total_cmp)?;
    let skip = ((bvh.tree.center - origin).dot(dir) - bvh.tree.radius * 1.001).max(0.0);
    let last = nearest + EQUAL * (bvh.tree.radius + skip);
    hits.into_iter().find(|hit| hit.t <= last)
}

fn unlimited(bvh: &TriangleBvh, origin: DVec3, dir: DVec3) -> Option<TriangleHit> {
    bvh.intersect(origin, dir, 0.0, f64::INFINITY)
}

/// What this processor can be asked to use.
fn levels() -> Vec<Level> {
    let levels = vec![Level::new(), Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    let levels = {
        let sse4_2 = Level::new().as_sse4_2().map(Level::Sse4_2);
        let avx2 = Level::new().as_avx2().map(Level::Avx2);
        [levels, sse4_2.into_iter().chain(avx2).collect()].concat()
    };
    levels
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn hierarchy_agrees_with_all_triangles_on_every_processor(
        triangles in prop::collection::vec([point(), point(), point()], 1..60),
        tiny in prop::collection::vec(point(), 0..200),
        origin in point(),
        dir in point(),
        far in prop::sample::select(vec![0.5, 3.0, 1e4, 1e7]),
    ) {
        prop_assume!(dir.length() > 1e-3);
        // Beside tiny triangles, the others are large enough to be split.
        let tiny = tiny.into_iter().map(|at| [at, at + 0.01 * Vec3::X, at + 0.01 * Vec3::ONE]);
        let triangles: Vec<_> = triangles.into_iter().chain(tiny).collect();
        let dir = dir.as_dvec3().normalize();
        let origin = origin.as_dvec3() - far * dir;
        let mut bvh = TriangleBvh::new(&triangles);
        let expected = brute_force(&bvh, &triangles, [origin, dir]);
        for level in levels() {
            bvh.level = level;
            prop_assert_eq!(unlimited(&bvh, origin, dir), expected, "{:?}", level);
        }
        // A hierarchy too deep for the stack without an allocation.
        bvh.tree.wide.stack = 1000;
        prop_assert_eq!(unlimited(&bvh, origin, dir), expected);
    }

    #[test]
    fn flat_scenes_are_seen_along_the_axes(axis in 0usize..3, x in -1.0..1.0, y in -1.0..1.0) {
        // A unit square, its plane through the origin, offset from it within the other axes.
        let at = |u: f64, v: f64, w: f64| {
            let mut p = [0.0; 3];
            p[axis] = w;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            DVec3::from_array(p)
        };
        let corner = |u, v| at(u, v, 0.0).as_vec3();
        let (a, b, c, d) =
            (corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0));
        let bvh = TriangleBvh::new(&[[a, b, c], [a, c, d]]);
        let hit = unlimited(&bvh, at(x, y, 10.0), at(0.0, 0.0, -1.0));
        prop_assert!(hit.is_some_and(|hit| (hit.t - 10.0).abs() < 1e-14));
    }
}

#[test]
fn of_equal_triangles_the_first_is_hit() {
    let ahead = |x: f32| {
        let at = |y: f32, z: f32| Vec3::new(x, y, z);
        [at(-1.0, -1.0), at(1.0, -1.0), at(0.0, 1.0)]
    };
    let mut triangles: Vec<_> = (0..20).map(|index| ahead(index as f32)).collect();
    triangles.extend([ahead(0.0); 100]);
    let bvh = TriangleBvh::new(&triangles);
    let hit = unlimited(&bvh, DVec3::NEG_X, DVec3::X).unwrap();
    assert_eq!((hit.triangle, hit.t), (0, 1.0));
}

#[test]
fn of_squares_in_one_plane_the_first_is_hit_everywhere() {
    let at = |x: f32, y: f32| Vec3::new(x, y, 0.3);
    let [a, b, c, d] = [at(-1.0, -1.0), at(1.0, -1.1), at(1.2, 1.0), at(-0.9, 1.3)];
    // Split along one diagonal and along the other, each several times.
    let triangles = [
        [a, b, c],
        [a, c, d],
        [d, c, b],
        [d, b, a],
        [c, a, b],
        [d, a, b],
    ];
    let bvh = TriangleBvh::new(&triangles);
    for step in 0..10_000 {
        let (x, y) = (f64::from(step % 100), f64::from(step / 100));
        let target = DVec3::new(x / 60.0 - 0.8, y / 60.0 - 0.8, 0.3);
        let origin = DVec3::new(0.2, 0.1, 9.0);
        let hit = unlimited(&bvh, origin, (target - origin).normalize()).unwrap();
        assert!(hit.triangle < 2, "{target}: {}", hit.triangle);
    }
}

/// Triangles that are alike, or lie evenly in a row, are joined in few rounds.
#[test]
fn hierarchies_of_alike_triangles_are_shallow() {
    let triangle = |x: f32, y: f32| {
        let at = |dx: f32, dy: f32| Vec3::new(x + dx, y + dy, 0.0);
        [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]
    };
    let many = 20_000;
    let coincident = (0..many).map(|_| triangle(0.0, 0.0)).collect();
    let row = (0..many).map(|index| triangle(index as f32, 0.0)).collect();
    let column = (0..many)
        .map(|index| triangle(0.0, 1e-7 * index as f32))
        .collect();
    for triangles in [coincident, row, column] {
        let triangles: Vec<_> = triangles;
        let start = std::time::Instant::now();
        let bvh = TriangleBvh::new(&triangles);
        // Seven of eight children wait at each level.
        let levels = bvh.tree.wide.stack / 7;
        println!("{levels} levels, {:?}", start.elapsed());
        assert!(levels < 40, "{levels} levels");
    }
}

#[test]
fn limits_are_respected() {
    let triangle = [
        Vec3::NEG_ONE,
        Vec3::new(1.0, -1.0, -1.0),
        Vec3::new(0.0, 1.0, -1.0),
    ];
    let bvh = TriangleBvh::new(&[triangle]);
    let hit = |t_min, t_max| bvh.intersect(DVec3::ZERO, DVec3::NEG_Z, t_min, t_max);
    assert_eq!(hit(0.0, 2.0).map(|hit| hit.t), Some(1.0));
    assert!(hit(1.0, 2.0).is_none());
    assert!(hit(0.0, 1.0).is_none());
    assert!(hit(0.0, 0.5).is_none());
    assert!(unlimited(&bvh, DVec3::ZERO, DVec3::Z).is_none());
    assert!(unlimited(&TriangleBvh::new(&[]), DVec3::ZERO, DVec3::Z).is_none());
}

#[test]
fn work_is_counted() {
    let wall = |z: f32| {
        [
            Vec3::new(-9.0, -9.0, z),
            Vec3::new(9.0, -9.0, z),
            Vec3::new(0.0, 9.0, z),
        ]
    };
    let bvh = TriangleBvh::new(&[wall(-1.0), wall(-2.0), wall(-3.0)]);
    let count = |dir| {
        bvh.intersect_counted(DVec3::ZERO, dir, 0.0, f64::INFINITY)
            .1
    };
    let Work { nodes, blocks, met } = count(DVec3::NEG_Z);
    assert!(
        nodes <= 1 && blocks == 1 && met == 1,
        "{nodes} {blocks} {met}"
    );
    assert_eq!(count(DVec3::X).met, 0);
}
