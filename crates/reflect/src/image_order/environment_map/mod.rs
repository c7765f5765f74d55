//! Environment mapping: one cube map from each mirror's centre, looked up in the reflected
//! direction (Blinn and Newell 1976). The baseline that all four papers compare with.

use catoptric_frame::Work;
use catoptric_scene::{Mirror, Scene};
use glam::DVec3;

use super::ImageOrder;
use super::cubemaps::{CubeMaps, Wanted, maps_layout};
use super::per_pixel::PerPixel;
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, group, module};
use crate::spec::Options;
use crate::stage::Stage;
use crate::stage::variant::Variant;

struct EnvironmentMap {
    /// The maps are drawn anew in every frame.
    every_frame: bool,
    /// Their centres go with the mirrors.
    follows: bool,
    lookup: PerPixel,
    /// One a mirror.
    maps: Vec<(CubeMaps, wgpu::BindGroup)>,
}

/// Where a mirror's map is taken from, world space.
fn center(options: &Options, mirror: &Mirror) -> DVec3 {
    match options.text("placement").as_str() {
        "scene" => mirror.cubemaps[0],
        _ => mirror.shape.center(),
    }
}

/// Why the places in the scene file do not do.
pub(crate) fn objection(options: &Options, scene: &Scene) -> Option<String> {
    let without = scene
        .mirrors
        .iter()
        .find(|mirror| mirror.cubemaps.is_empty());
    let mirror = without.filter(|_| options.is("placement", "scene"))?;
    Some(format!(
        "placement=scene: mirror \"{}\" has no place for a map (key `cubemaps` in the scene file)",
        mirror.name
    ))
}

pub(crate) fn make(
    gpu: &Gpu,
    options: &Options,
    stage: &Stage,
) -> Result<Box<dyn ImageOrder>, ReflectError> {
    let module = module(gpu, "environment_map", &[])?;
    let own_layout = maps_layout(gpu, "environment map", &[]);
    let mut maps = Vec::new();
    for mirror in &stage.world.scene.mirrors {
        let wanted = Wanted {
            size: options.whole("size"),
            centers: vec![center(options, mirror)],
            traced: 1,
            mirrors: false,
        };
        let map = CubeMaps::new(gpu, stage, wanted)?;
        let [colors, distances] = map.views();
        let own = group(gpu, &own_layout, &map.resources([&colors, &distances]));
        maps.push((map, own));
    }
    let every_frame = options.is("update", "frame");
    let technique = EnvironmentMap {
        every_frame,
        follows: every_frame && options.is("placement", "center"),
        lookup: PerPixel::new(gpu, stage, &module, &own_layout),
        maps,
    };
    gpu.run(|frame| technique.record_maps(frame, stage));
    Ok(Box::new(technique))
}

impl EnvironmentMap {
    fn record_maps(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        for (map, _) in &self.maps {
            map.record(frame, stage);
        }
    }
}

impl ImageOrder for EnvironmentMap {
    /// A mirror's own centre goes with it where the map is drawn in every frame; a place in the scene
    /// file stays.
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        if self.follows {
            for ((map, _), mirror) in self.maps.iter_mut().zip(&stage.world.scene.mirrors) {
                map.set_centers(gpu, stage, &[mirror.shape.center()]);
            }
        }
        Ok(())
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        if self.every_frame {
            self.record_maps(frame, stage);
        }
        let groups = self.maps.iter().map(|(_, group)| group);
        let targets = stage.reflections.views();
        (self.lookup).record(frame, "lookup", (stage, variant), groups, &targets);
    }

    /// One lookup a pixel.
    fn work(&self, _: &Gpu, _: &Stage) -> Work {
        Work {
            samples: Some(1.0),
            ..Work::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::parse;
    use crate::testing::{gpu_or_skip, scene};
    use crate::{Support, supports};

    #[test]
    fn a_place_in_the_scene_file_takes_the_centres_place() {
        let Some(gpu) = gpu_or_skip() else { return };
        let mut scene = scene("sphere-table");
        let given = parse("environment-map(size=32,placement=scene)").expect("a technique");
        let Support::No(reason) = supports(&given, &scene) else {
            panic!("no place is given")
        };
        assert!(reason.contains("`cubemaps`"), "{reason}");
        let render = |scene: &_, spec: &_| {
            let mut prepared =
                crate::prepare(&gpu, spec, scene, [40, 30]).expect("fits the device");
            prepared.render().expect("renders").frame.color
        };
        let own = render(
            &scene,
            &parse("environment-map(size=32)").expect("a technique"),
        );
        let center = scene.mirrors[0].shape.center();
        scene.mirrors[0].cubemaps = vec![center];
        assert_eq!(supports(&given, &scene), Support::Yes);
        assert_eq!(render(&scene, &given), own);
        scene.mirrors[0].cubemaps = vec![center + 0.5 * glam::DVec3::X];
        assert_ne!(render(&scene, &given), own);
    }
}
