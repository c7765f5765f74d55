//! The scenes of Szabo 2013, Fig. 5.3 and 6.1 to 6.4: every vertex is reflected and none hidden
//! (§6.1), and in Fig. 6.2 "the reflection covers the entire viewport".

use catoptric_frame::VertexClass;
use catoptric_reference::{RenderOptions, Tracer, Truth, true_vertices};
use catoptric_scene::{LoadOptions, Scene};

/// Share of vertices in a class.
fn share(name: &str, class: VertexClass) -> f64 {
    let scene = Scene::load(name, &LoadOptions::default()).unwrap();
    let view = scene.camera.view(scene.camera.resolution);
    let vertices = true_vertices(&scene, &view).unwrap();
    let of_class = vertices.iter().filter(|vertex| vertex.class == class);
    of_class.count() as f64 / vertices.len() as f64
}

#[test]
fn every_vertex_is_reflected() {
    for name in [
        "sphere-square",
        "sphere-grid-100",
        "sphere-grid-10k",
        "sphere-grid-full-100",
        "sphere-grid-full-10k",
    ] {
        assert_eq!(share(name, VertexClass::Reflected), 1.0, "{name}");
    }
}

#[test]
fn views_with_hidden_vertices_have_names_of_their_own() {
    // The same square as that of `sphere-square-hidden`, whose corners are all reflected.
    for (name, hidden) in [
        ("sphere-grid-hidden-10k", 0.13..=0.15),
        ("sphere-grid-full-hidden-10k", 0.07..=0.09),
    ] {
        let found = share(name, VertexClass::Hidden);
        assert!(hidden.contains(&found), "{name}: {found}");
    }
}

#[test]
fn the_reflection_covers_the_viewport() {
    let scene = Scene::load("sphere-grid-full-100", &LoadOptions::default()).unwrap();
    let options = RenderOptions::new([160, 120], Truth::FirstBounce);
    let frame = Tracer::new(&scene).unwrap().render(&options);
    let mirror = scene.mirror_id(0);
    let primary = frame.primary.expect("layers");
    assert!(primary.id.pixels().iter().all(|id| *id == mirror));
    let reflected = frame.reflected.expect("layers");
    let pixels = reflected.id.pixels();
    let shown = pixels.iter().filter(|id| **id != 0).count();
    assert!(
        shown * 100 >= pixels.len() * 95,
        "{shown} of {}",
        pixels.len()
    );
}
