//! The ray tracer against closed forms and hand-made scenes.

use crate::common::*;
use catoptric_frame::Status;
use catoptric_reference::{RayStart, ReferenceError, RenderOptions, Surface, Tracer, Truth};
use catoptric_scene::shape::{Plane, Sphere};
use catoptric_scene::{Background, Mesh, Paint, Scene, Shape};
use glam::{DVec2, DVec3, Vec3};

const FIRST: Truth = Truth::FirstBounce;

fn plane(center: [f64; 3], normal: [f64; 3]) -> Shape {
    let normal = DVec3::from_array(normal);
    Shape::Plane(Plane {
        center: DVec3::from_array(center),
        normal,
        up: normal.any_orthonormal_vector(),
        size: DVec2::splat(10.0),
    })
}

/// Every pixel's eye ray and its first reflected ray, both as traced.
fn reflections(scene: &Scene, size: [u32; 2]) -> Vec<(DVec3, DVec3, DVec3)> {
    let tracer = Tracer::new(scene).unwrap();
    let view = scene.camera.view(size);
    let mut found = Vec::new();
    for y in 0..size[1] {
        for x in 0..size[0] {
            let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
            let trace = tracer.reflect_pixel(&view, at, FIRST);
            if let (Some(hit), Some(reflection)) = (trace.primary, trace.reflection) {
                found.push((view.ray(at), hit.position, reflection.direction));
            }
        }
    }
    found
}

#[test]
fn sphere_and_plane_reflect_as_in_closed_form() {
    let center = DVec3::new(0.2, -0.1, 0.3);
    let eye = DVec3::new(0.6, 0.5, 4.0);
    let camera = camera(eye.to_array(), 34.0, [96, 96]);
    let sphere = Shape::Sphere(Sphere {
        center,
        radius: 0.9,
    });
    let found = reflections(&scene(camera.clone(), vec![], vec![sphere]), [96, 96]);
    assert!(found.len() > 3000);
    for (dir, position, reflected) in found {
        // Distance to the nearest point of the line, then back by half the chord.
        let along = (center - eye).dot(dir);
        let off = (eye + along * dir).distance(center);
        let expected = eye + (along - (0.81 - off * off).sqrt()) * dir;
        let normal = (expected - center) / 0.9;
        assert!(position.distance(expected) < 1e-12);
        // Near the silhouette the closed form itself loses digits.
        let mirrored = dir - 2.0 * dir.dot(normal) * normal;
        assert!(reflected.angle_between(mirrored) < 1e-6);
    }
    let found = reflections(
        &scene(
            camera,
            vec![],
            vec![plane([0.0, -1.0, 0.0], [0.0, 1.0, 0.0])],
        ),
        [96, 96],
    );
    assert!(found.len() > 1000);
    for (dir, position, reflected) in found {
        assert!((position.y + 1.0).abs() < 1e-15);
        assert!(reflected.distance(DVec3::new(dir.x, -dir.y, dir.z)) < 1e-15);
    }
}

/// A unit sphere before a red wall behind the eye, and a green one behind the sphere.
fn walls() -> Scene {
    let wall = |name, z: f32, color| {
        quad(
            name,
            Vec3::new(-50.0, -50.0, z),
            100.0 * Vec3::X,
            100.0 * Vec3::Y,
            color,
        )
    };
    let objects = vec![wall("red", 6.0, Vec3::X), wall("green", -6.0, Vec3::Y)];
    scene(
        camera([0.0, 0.0, 4.0], 40.0, [9, 9]),
        objects,
        vec![unit_sphere()],
    )
}

#[test]
fn first_bounce_on_a_sphere_is_as_by_hand() {
    let scene = walls();
    let frame = Tracer::new(&scene)
        .unwrap()
        .render(&RenderOptions::new([9, 9], FIRST));
    let (primary, reflected) = (frame.primary.unwrap(), frame.reflected.unwrap());
    // Straight ahead: the sphere at distance 3, and the wall behind the eye at distance 5.
    assert_eq!(*primary.id.at(4, 4), 3);
    assert_eq!(*primary.position.at(4, 4), Vec3::Z);
    assert_eq!(*primary.normal.at(4, 4), Vec3::Z);
    assert_eq!(*reflected.status.at(4, 4), Status::Resolved);
    assert_eq!(*reflected.id.at(4, 4), 1);
    assert_eq!(*reflected.position.at(4, 4), Vec3::new(0.0, 0.0, 6.0));
    assert_eq!(*reflected.distance.at(4, 4), 5.0);
    assert_eq!(*frame.color.at(4, 4), Vec3::X);
    // In the corner: past the sphere, the wall behind it, its normal towards the eye.
    assert_eq!(*primary.id.at(0, 0), 2);
    assert_eq!(primary.position.at(0, 0).z, -6.0);
    assert!(primary.position.at(0, 0).x < 0.0 && primary.position.at(0, 0).y > 0.0);
    assert_eq!(*primary.normal.at(0, 0), Vec3::Z);
    assert_eq!(*reflected.status.at(0, 0), Status::NotMirror);
    assert_eq!(*reflected.id.at(0, 0), 0);
    assert_eq!(*reflected.position.at(0, 0), Vec3::ZERO);
    assert_eq!(*frame.color.at(0, 0), Vec3::Y);
    assert!(reflected.bounces.is_none());
    let names: Vec<_> = frame
        .names
        .iter()
        .map(|n| (n.id, n.name.as_str(), n.mirror))
        .collect();
    assert_eq!(
        names,
        [
            (1, "red", false),
            (2, "green", false),
            (3, "mirror 0", true)
        ]
    );
}

#[test]
fn mirrors_are_hidden_by_objects_and_not_seen_by_reflected_rays() {
    let mut scene = walls();
    scene.objects.push(quad(
        "near",
        Vec3::new(-9.0, 0.0, 2.0),
        18.0 * Vec3::X,
        9.0 * Vec3::Y,
        Vec3::Z,
    ));
    scene.mirrors[0].shape = plane([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let second = plane([0.0, 0.0, 5.0], [0.0, 0.0, -1.0]);
    scene.mirrors.push(catoptric_scene::Mirror {
        name: "behind".into(),
        shape: second,
        tessellation: 8,
        cubemaps: Vec::new(),
        proxies: Vec::new(),
        pose: catoptric_scene::Pose::REST,
    });
    let frame = Tracer::new(&scene)
        .unwrap()
        .render(&RenderOptions::new([9, 9], FIRST));
    let (primary, reflected) = (frame.primary.unwrap(), frame.reflected.unwrap());
    assert_eq!(
        (*primary.id.at(4, 0), *reflected.status.at(4, 0)),
        (3, Status::NotMirror)
    );
    // The eye ray downwards: by the first mirror, through the second, to the red wall.
    assert_eq!((*primary.id.at(4, 8), *reflected.id.at(4, 8)), (4, 1));
}

#[test]
fn facing_planes_bounce_a_known_number_of_times() {
    // The eye looks along −z, slightly to the right, between mirrors at z = ±1, which end at
    // x = 5; beyond is a wall at x = 20.
    let slope: f64 = 0.3;
    let mut camera = camera([-4.0, 0.0, 0.0], 1.0, [1, 1]);
    camera.target = camera.eye + DVec3::new(slope, 0.0, -1.0);
    let wall = quad(
        "wall",
        Vec3::new(20.0, -90.0, -90.0),
        180.0 * Vec3::Y,
        180.0 * Vec3::Z,
        Vec3::Y,
    );
    let mirrors = vec![
        plane([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]),
        plane([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]),
    ];
    let scene = scene(camera, vec![wall], mirrors);
    let tracer = Tracer::new(&scene).unwrap();
    // Met at x = −4 + 0.3 (1 + 2k) ≤ 5: k = 0 … 14.
    let render = |bounces| tracer.render(&RenderOptions::new([1, 1], Truth::Full { bounces }));
    for (limit, id, bounces, color) in [
        (40, 1, 15, Vec3::Y),
        (15, 1, 15, Vec3::Y),
        (14, 2, 14, Vec3::ZERO),
        (1, 3, 1, Vec3::ZERO),
        (0, 3, 1, Vec3::ZERO),
    ] {
        let frame = render(limit);
        let reflected = frame.reflected.unwrap();
        assert_eq!(*reflected.id.at(0, 0), id, "limit {limit}");
        assert_eq!(
            *reflected.bounces.unwrap().at(0, 0),
            bounces,
            "limit {limit}"
        );
        assert_eq!(*frame.color.at(0, 0), color);
        assert_eq!(*reflected.status.at(0, 0), Status::Resolved);
        let step = (1.0 + slope * slope).sqrt();
        if id == 1 {
            // The last segment alone: from x = 4.7 to the wall.
            let expected = 15.3 / slope * step;
            assert!((f64::from(*reflected.distance.at(0, 0)) - expected).abs() < 1e-4);
            assert!((reflected.position.at(0, 0).x - 20.0).abs() < 1e-5);
        } else {
            assert!((f64::from(*reflected.distance.at(0, 0)) - 2.0 * step).abs() < 1e-5);
        }
    }
}

#[test]
fn a_ray_from_mitsubas_start_is_moved_by_its_offset() {
    let scene = Scene {
        mirrors: scene(
            camera([0.6, 0.5, 4.0], 34.0, [64, 64]),
            vec![],
            vec![plane([0.0, 0.0, -2.0], [0.0, 0.0, 1.0])],
        )
        .mirrors,
        ..walls()
    };
    let view = scene.camera.view([64, 64]);
    let tracer = |start| Tracer::new(&scene).unwrap().with_ray_start(start);
    let (exact, moved) = (tracer(RayStart::Exact), tracer(RayStart::Mitsuba));
    let mut compared = 0;
    for at in 0..64 * 64 {
        let at = DVec2::new(f64::from(at % 64), f64::from(at / 64)) + 0.5;
        let [a, b] = [&exact, &moved].map(|tracer| tracer.reflect_pixel(&view, at, FIRST));
        let (Some(from), Some(a), Some(b)) = (a.primary, a.reflection, b.reflection) else {
            continue;
        };
        let (Some(a_hit), Some(b_hit)) = (a.hit, b.hit) else {
            continue;
        };
        if a_hit.surface == b_hit.surface || a_hit.id == b_hit.id {
            // (1 + max |P|) · 1500 · 2⁻²⁴ along the mirror's normal, carried along the ray to the
            // same plane.
            let offset = (1.0 + from.position.abs().max_element()) * 1500.0 / 2f64.powi(24);
            let start = from.position + DVec3::Z * offset;
            let t = (a_hit.position - start).dot(a_hit.normal) / a.direction.dot(a_hit.normal);
            let expected = start + t * a.direction;
            assert!(b_hit.position.distance(expected) < 1e-9, "{at}");
            assert!((b_hit.t - b_hit.position.distance(from.position)).abs() < 1e-12);
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn backs_are_black() {
    let scene = scene(
        camera([0.0, 0.0, 4.0], 20.0, [3, 3]),
        vec![],
        vec![plane([0.0; 3], [0.0, 0.0, -1.0])],
    );
    let tracer = Tracer::new(&scene).unwrap();
    for truth in [FIRST, Truth::Full { bounces: 3 }] {
        let frame = tracer.render(&RenderOptions::new([3, 3], truth));
        assert_eq!(*frame.color.at(1, 1), Vec3::ZERO);
        assert_eq!(*frame.primary.unwrap().id.at(1, 1), 1);
        let reflected = frame.reflected.unwrap();
        assert_eq!(
            (*reflected.status.at(1, 1), *reflected.id.at(1, 1)),
            (Status::Back, 0)
        );
    }
    // The back of another mirror, in a mirror.
    let mut scene = walls();
    let back = plane([0.0, 0.0, 5.0], [0.0, 0.0, 1.0]);
    scene.mirrors.push(catoptric_scene::Mirror {
        name: "back".into(),
        shape: back,
        tessellation: 8,
        cubemaps: Vec::new(),
        proxies: Vec::new(),
        pose: catoptric_scene::Pose::REST,
    });
    let frame = Tracer::new(&scene)
        .unwrap()
        .render(&RenderOptions::new([9, 9], Truth::Full { bounces: 3 }));
    let reflected = frame.reflected.unwrap();
    assert_eq!(
        (*reflected.id.at(4, 4), *reflected.distance.at(4, 4)),
        (4, 4.0)
    );
    assert_eq!(*frame.color.at(4, 4), Vec3::ZERO);
}

#[test]
fn bowl_reflects_inside_and_sees_itself() {
    let bowl = prototype_bowl();
    let size = [64, 64];
    let scene = scene(camera([0.5, 0.35, 4.0], 34.0, size), vec![], vec![bowl]);
    let tracer = Tracer::new(&scene).unwrap();
    let full = tracer.render(&RenderOptions::new(size, Truth::Full { bounces: 20 }));
    let bounces = full.reflected.as_ref().unwrap().bounces.as_ref().unwrap();
    assert_eq!(*bounces.at(32, 32), 1);
    // A ray that grazes a circle goes round it with equal angles: each bounce turns by the same.
    let most = bounces.pixels().iter().max().copied();
    assert!(most.is_some_and(|most| (2..=4).contains(&most)), "{most:?}");
    assert!(full.primary.unwrap().id.pixels().iter().all(|id| *id <= 1));
}

#[test]
fn tessellated_sphere_never_meets_itself_and_comes_close_to_the_exact_one() {
    let size = [256, 256];
    let mesh = unit_sphere().tessellate(128);
    assert!(mesh.triangles.len() > 7_500);
    let mut scene = walls();
    scene.camera = camera([0.6, 0.5, 4.0], 34.0, size);
    let exact = Tracer::new(&scene).unwrap();
    scene.mirrors[0].shape = Shape::Mesh(mesh);
    let mesh = Tracer::new(&scene).unwrap();
    let (view, mut below, mut pixels) = (scene.camera.view(size), 0, 0);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
            let trace = mesh.reflect_pixel(&view, at, Truth::Full { bounces: 4 });
            let Some(reflection) = trace.reflection else {
                continue;
            };
            pixels += 1;
            if reflection.status == Status::Below {
                below += 1;
                assert!(reflection.hit.is_none());
                assert_eq!(trace.color, Vec3::ZERO);
                continue;
            }
            assert_eq!(reflection.status, Status::Resolved);
            assert_eq!(reflection.bounces, 1, "met itself at {at}");
            let other = exact.reflect_pixel(&view, at, FIRST).reflection;
            let Some(other) = other else { continue };
            let facing = trace.primary.unwrap().geometric.dot(trace.direction);
            if facing < -0.3 {
                let angle = reflection.direction.angle_between(other.direction);
                assert!(angle < 4e-3, "{angle} at {at}");
            }
        }
    }
    println!("{below} of {pixels} below the surface");
    assert!(pixels > 20_000 && below > 0 && below * 100 < pixels);
}

#[test]
fn supersampling_changes_colour_alone() {
    let scene = walls();
    let tracer = Tracer::new(&scene).unwrap();
    let one = tracer.render(&RenderOptions::new([9, 9], FIRST));
    let rows = std::sync::atomic::AtomicU32::new(0);
    let count = |_, all| {
        assert_eq!(all, 9);
        rows.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    };
    let options = RenderOptions {
        samples: 4,
        progress: Some(&count),
        ..RenderOptions::new([9, 9], FIRST)
    };
    let many = tracer.render(&options);
    assert_eq!(rows.into_inner(), 9);
    assert_eq!((one.primary, one.reflected), (many.primary, many.reflected));
    // A 4 × 4 grid is the mean of a picture four times as large.
    let large = tracer.render(&RenderOptions::new([36, 36], FIRST));
    for y in 0..9 {
        for x in 0..9 {
            let mut mean = Vec3::ZERO;
            for sub in 0..16 {
                mean += *large.color.at(4 * x + sub % 4, 4 * y + sub / 4) / 16.0;
            }
            assert!(many.color.at(x, y).distance(mean) < 1e-6);
        }
    }
}

#[test]
fn textured_quad_shows_its_texels() {
    let texels = vec![[0; 3], [255, 0, 0], [0, 255, 0], [0, 0, 255]];
    let image = std::sync::Arc::new(catoptric_scene::Texture::linear([2; 2], texels));
    let mut wall = quad(
        "wall",
        Vec3::new(-1.0, -1.0, 0.0),
        2.0 * Vec3::X,
        2.0 * Vec3::Y,
        Vec3::ONE,
    );
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(glam::Vec2::from_array);
    wall.mesh.uvs = wall
        .mesh
        .triangles
        .iter()
        .map(|t| t.map(|i| corners[i as usize]))
        .collect();
    wall.mesh.materials[0].paint = Paint::Texture {
        tint: Vec3::splat(0.5),
        image,
    };
    let scene = scene(camera([0.0, 0.0, 1.0], 90.0, [4, 4]), vec![wall], vec![]);
    let tracer = Tracer::new(&scene).unwrap();
    let at = |x: f64, y: f64| {
        let view = scene.camera.view([4, 4]);
        tracer.reflect_pixel(&view, DVec2::new(x, y), FIRST).color
    };
    for (x, y, color) in [
        (1.0, 1.0, Vec3::ZERO),
        (3.0, 1.0, Vec3::X),
        (1.0, 3.0, Vec3::Y),
        (3.0, 3.0, Vec3::Z),
        (2.0, 2.0, Vec3::splat(0.25)),
        (2.0, 1.0, Vec3::X / 2.0),
        (1.5, 3.0, (3.0 * Vec3::Y + Vec3::Z) / 4.0),
    ] {
        assert!(
            at(x, y).distance(color / 2.0) < 1e-6,
            "{} at {x} {y}",
            at(x, y)
        );
    }
}

#[test]
fn degenerate_scenes_are_rendered() {
    let camera = camera([0.0, 0.0, 4.0], 40.0, [4, 4]);
    let points = object("points", vec![Vec3::X, Vec3::Y], vec![], Vec3::ONE);
    let thin = object(
        "thin",
        vec![Vec3::ZERO, Vec3::X, 2.0 * Vec3::X],
        vec![[0, 1, 2], [0, 0, 0]],
        Vec3::ONE,
    );
    for objects in [vec![], vec![points], vec![thin]] {
        for mirrors in [vec![], vec![unit_sphere()]] {
            let mut scene = scene(camera.clone(), objects.clone(), mirrors);
            scene.background = Background::Gradient {
                zenith: Vec3::X,
                horizon: Vec3::Y,
                nadir: Vec3::Z,
            };
            let tracer = Tracer::new(&scene).unwrap();
            let frame = tracer.render(&RenderOptions::new([4, 4], FIRST));
            let corner = scene.camera.view([4, 4]).ray(DVec2::splat(0.5));
            assert_eq!(*frame.color.at(0, 0), tracer.background(corner));
            assert_eq!(*frame.reflected.unwrap().id.at(1, 1), 0);
        }
    }
    let empty = scene(camera, vec![], vec![]);
    let frame = Tracer::new(&empty)
        .unwrap()
        .render(&RenderOptions::new([0, 0], FIRST));
    assert!(frame.color.pixels().is_empty());
}

#[test]
fn broken_scenes_are_refused() {
    let refuse = |change: fn(&mut Mesh)| {
        let mut scene = walls();
        change(&mut scene.objects[0].mesh);
        Tracer::new(&scene).unwrap_err()
    };
    let error = refuse(|mesh| mesh.triangles[1][2] = 4);
    assert_eq!(error.to_string(), "`red`: triangle 1: position 4 of 4");
    let error = refuse(|mesh| mesh.material[1] = 1);
    assert_eq!(error.to_string(), "`red`: triangle 1: material 1 of 1");
    assert!(matches!(
        refuse(|mesh| mesh.positions[3].x = f32::NAN),
        ReferenceError::NotFinite { index: 3, .. }
    ));
    assert!(matches!(
        refuse(|mesh| mesh.materials[0].paint = Paint::Vertex),
        ReferenceError::Attribute { .. }
    ));
    assert!(matches!(
        refuse(|mesh| mesh.uvs = vec![[glam::Vec2::ZERO; 3]]),
        ReferenceError::Attribute { .. }
    ));
    let mut scene = walls();
    let mesh = Mesh {
        normals: vec![],
        ..unit_sphere().tessellate(8)
    };
    scene.mirrors[0].shape = Shape::Mesh(mesh);
    let error = Tracer::new(&scene).unwrap_err();
    assert!(
        error.to_string().starts_with("`mirror 0`: 0 normals for "),
        "{error}"
    );
}

/// A tessellated sphere's triangles, as an object around the origin.
fn ball(segments: u32) -> Scene {
    let mesh = unit_sphere().tessellate(segments);
    scene(
        camera([0.0, 0.0, 4.0], 40.0, [4, 4]),
        vec![object("ball", mesh.positions, mesh.triangles, Vec3::ONE)],
        vec![],
    )
}

#[test]
fn no_ray_slips_between_triangles() {
    let scene = ball(128);
    let mesh = &scene.objects[0].mesh;
    let tracer = Tracer::new(&scene).unwrap();
    let mut random = Random::new(17);
    for index in 0..200_000 {
        let triangle = mesh.triangles[(random.unit() * mesh.triangles.len() as f64) as usize];
        let corner = |i: usize| mesh.positions[triangle[i % 3] as usize].as_dvec3();
        let target = match index % 3 {
            0 => corner(index),
            1 => corner(index).midpoint(corner(index + 1)),
            _ => corner(index).lerp(corner(index + 1), random.unit()),
        };
        let origin = random.between(0.0, 0.99) * random.direction();
        let dir = (target - origin).normalize();
        let hit = tracer
            .trace(origin, dir)
            .unwrap_or_else(|| panic!("{origin} {dir} sees nothing"));
        assert!((hit.t - origin.distance(target)).abs() < 1e-9);
        assert!((hit.position - origin - hit.t * dir).length() < 1e-13);
        assert!(matches!(hit.surface, Surface::Object { index: 0, .. }));
        assert!(tracer.trace_objects(2.0 * dir, dir).is_none());
    }
}
