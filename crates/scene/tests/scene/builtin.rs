//! The scenes that come with the program.

use catoptric_scene::{LoadOptions, builtin, list, open};
use glam::DVec2;

#[test]
fn all_load_and_say_why() {
    let names = builtin::names();
    for info in list::builtin(&LoadOptions::default()) {
        assert!(names.contains(&info.name));
        assert!(info.why.len() > 20, "{}", info.name);
        let needs_models = ["teapot-ball", "sponza-ball"].contains(&info.name.as_str());
        assert_eq!(
            info.available, !needs_models,
            "{}: {:?}",
            info.name, info.reason
        );
        assert_eq!(info.reason.is_some(), needs_models);
        if info.available {
            assert!(
                info.objects > 0 && info.mirrors > 0 && info.vertices > 0,
                "{}",
                info.name
            );
        }
    }
}

#[test]
fn sizes_are_what_the_names_say() {
    for (name, vertices) in [
        ("sphere-objects-1k", 1000),
        ("sphere-objects-20k", 20000),
        ("sphere-grid-100", 100),
        ("sphere-grid-300", 300),
        ("sphere-grid-full-1k", 1000),
        ("sphere-grid-3k", 3000),
        ("sphere-grid-10k", 10000),
        ("sphere-grid-full-30k", 30000),
        ("sphere-grid-100k", 100_000),
    ] {
        let found = open(name, &LoadOptions::default()).unwrap().vertex_count();
        assert!(found.abs_diff(vertices) * 20 <= vertices, "{name}: {found}");
    }
}

#[test]
fn a_mirror_is_drawn_with_as_many_segments_as_its_scene_says() {
    for (name, segments) in [("sphere-drawn-8", 8), ("sphere-drawn-256", 256)] {
        let scene = open(name, &LoadOptions::default()).unwrap();
        assert_eq!(scene.mirrors[0].tessellation, segments);
    }
}

#[test]
fn a_zoom_narrows_the_view() {
    let half_height = |name: &str| {
        let scene = open(name, &LoadOptions::default()).unwrap();
        match scene.camera.fov {
            catoptric_scene::Fov::Y(angle) => (angle.to_radians() / 2.0).tan(),
            other => panic!("{name}: {other:?}"),
        }
    };
    let ratio = half_height("prototype-sphere") / half_height("prototype-sphere-zoom-32");
    assert!((ratio - 32.0).abs() < 1e-3, "{ratio}");
}

#[test]
fn rooms_have_the_triangles_they_say() {
    for (name, triangles) in [("box", 850), ("room", 4_700), ("atrium", 30_000)] {
        let found = open(name, &LoadOptions::default())
            .unwrap()
            .triangle_count();
        assert!(
            found.abs_diff(triangles) * 50 <= triangles,
            "{name}: {found}"
        );
    }
    let kitchen = open("kitchen", &LoadOptions::default()).unwrap();
    assert!((5_000..20_000).contains(&kitchen.vertex_count()));
    assert!(kitchen.mirrors.len() > 2 && kitchen.mirrors.iter().all(|m| m.shape.is_convex()));
}

#[test]
fn prototype_mirrors_cover_the_pixels_they_should() {
    for (name, pixels) in [
        ("prototype-sphere", 141_144),
        ("prototype-ellipsoid", 68_890),
        ("prototype-bowl", 161_269),
    ] {
        let scene = open(name, &LoadOptions::default()).unwrap();
        let [width, height] = scene.camera.resolution;
        let view = scene.camera.view(scene.camera.resolution);
        let mut found = 0;
        for j in 0..height {
            for i in 0..width {
                let dir = view.ray(DVec2::new(f64::from(i), f64::from(j)) + 0.5);
                let hit = scene.mirrors[0].shape.intersect(view.eye, dir, 0.0);
                found += u32::from(hit.is_some_and(|hit| hit.normal.dot(dir) < 0.0));
            }
        }
        assert_eq!(found, pixels, "{name}");
        assert_eq!(scene.vertex_count(), 3000);
    }
}

#[test]
fn the_hash_knows_what_a_picture_shows() {
    let options = LoadOptions::default();
    let scene = |name: &str| open(name, &options).unwrap();
    assert_eq!(scene("spheres").hash.len(), 64);
    let larger = LoadOptions {
        resolution: Some([32, 16]),
        ..LoadOptions::default()
    };
    let resized = open("spheres", &larger).unwrap();
    assert_eq!(
        resized.hash,
        scene("spheres").hash,
        "resolution is not in the hash"
    );
    assert_eq!(resized.camera.resolution, [32, 16]);
    assert_ne!(scene("sphere-grid-100").hash, scene("sphere-grid-300").hash);
    // Motion changes no picture: those that differ in it alone have one hash.
    let names = builtin::names();
    let moving = |name: &str| name.starts_with("moving-") && !name.ends_with("-all");
    let other = |name: &str| name.contains("-within-") || name.contains("-segments-");
    let alone = |name: &&String| !moving(name) || other(name);
    let mut hashes: Vec<_> = names
        .iter()
        .filter(alone)
        .filter_map(|n| open(n, &options).ok())
        .map(|s| s.hash)
        .collect();
    let count = hashes.len();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), count);
}

#[test]
fn a_family_of_mirrors_has_as_many_as_its_names_say() {
    for (name, mirrors) in [("mirrors-1", 1), ("mirrors-3", 3), ("mirrors-8", 8)] {
        let scene = open(name, &LoadOptions::default()).unwrap();
        assert_eq!(
            (scene.mirrors.len(), scene.objects.len()),
            (mirrors, 4),
            "{name}"
        );
    }
}

#[test]
fn a_family_of_objects_has_one_of_its_template_each() {
    let whole = open("sphere-table", &LoadOptions::default()).unwrap();
    for name in ["cloth", "candlestick", "teapot", "apple"] {
        let scene = open(
            &format!("sphere-table-only-{name}"),
            &LoadOptions::default(),
        )
        .unwrap();
        let names: Vec<&str> = scene
            .objects
            .iter()
            .map(|object| object.name.as_str())
            .collect();
        assert_eq!(
            (names, scene.mirrors.len()),
            (vec![name], whole.mirrors.len())
        );
        assert_eq!(scene.camera, whole.camera);
    }
}
