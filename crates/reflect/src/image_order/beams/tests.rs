use super::*;
use crate::testing::{assert_layout, gpu_or_skip, scene};
use crate::{parse, prepare};

/// Ids at the mirror's pixels, 0 elsewhere.
fn ids(gpu: &Gpu, name: &str, technique: &str, size: [u32; 2]) -> Vec<u32> {
    let scene = scene(name);
    let spec = parse(technique).expect("a technique");
    let mut prepared = prepare(gpu, &spec, &scene, size).expect("fits");
    let output = prepared.render().expect("renders");
    println!("{name} {technique}: {:?} {:?}", output.work, output.notes);
    let reflected = output.frame.reflected.expect("all layers");
    reflected.id.pixels().to_vec()
}

#[test]
fn every_pixel_sees_what_the_ray_tracer_sees() {
    let Some(gpu) = gpu_or_skip() else { return };
    let size = [96, 72];
    for name in ["sphere-table", "bowl", "kitchen"] {
        let traced = ids(&gpu, name, "ray-trace", size);
        for technique in ["beams", "beams(tile=4)", "beams(tile=8)"] {
            let ours = ids(&gpu, name, technique, size);
            let other = traced.iter().zip(&ours).filter(|(a, b)| a != b).count();
            assert_eq!(other, 0, "{name} {technique}");
        }
    }
}

#[test]
fn the_settings_lie_as_the_shaders_read_them() {
    use super::settings::Settings;
    assert_layout!(
        Settings {
            wider,
            tiles,
            triangles,
            clusters,
            first_cluster,
            cluster_count,
            room,
            is_first
        },
        "beams/tiles",
        &[],
        "Settings"
    );
}
