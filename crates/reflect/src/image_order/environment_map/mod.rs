//! Environment mapping: one cube map from each mirror's centre, looked up in the reflected
//! direction (Blinn and Newell 1976). The baseline that all four papers compare with.

use catoptric_frame::Work;
use catoptric_scene::{Mirror, Scene};
use glam::DVec3;

use super::cubemaps::{CubeMaps, MapOptions, Update, Wanted, bytes, maps_layout};
use super::per_pixel::PerPixel;
use super::{ImageOrder, Recipe};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, group, module};
use crate::options::{options, words};
use crate::stage::Stage;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named};

words! {
    /// Where a mirror's map is taken from.
    pub(crate) enum Placement {
        Center = "center",
        /// The first of its places in the scene file.
        Scene = "scene",
    }
}

options! {
    pub(crate) struct EnvironmentMap {
        /// where the map is taken from: the mirror's centre, or the first of its `cubemaps` in the scene file
        placement: Placement,
        ..maps: MapOptions,
    }
}

impl Named for EnvironmentMap {
    const INFO: Info = Info {
        name: "environment-map",
        what: "one cube map a mirror, looked up by direction alone",
        paper: "baseline",
    };
}

impl Recipe for EnvironmentMap {
    /// The scene file must have the places that are asked of it.
    fn objection(&self, scene: &Scene) -> Option<String> {
        let mut mirrors = scene.mirrors.iter();
        let without = mirrors.find(|mirror| mirror.cubemaps.is_empty());
        let mirror = without.filter(|_| self.placement == Placement::Scene)?;
        Some(format!(
            "placement=scene: mirror \"{}\" has no place for a map (key `cubemaps` in the scene file)",
            mirror.name
        ))
    }

    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError> {
        let module = module(gpu, "environment_map", &[])?;
        let own_layout = maps_layout(gpu, "environment map", &[]);
        let count = stage.world.mirrors.len();
        gpu.check_memory(bytes(self.maps.size.texels(), count, None))?;
        let mut maps = Vec::new();
        for mirror in &stage.world.scene.mirrors {
            let wanted = Wanted {
                size: self.maps.size.texels(),
                centers: vec![self.center(mirror)],
                traced: 1,
                mirrors: None,
            };
            let map = CubeMaps::new(gpu, stage, wanted)?;
            let [colors, distances] = map.views();
            let own = group(gpu, &own_layout, &map.resources([&colors, &distances]));
            maps.push((map, own));
        }
        let every_frame = self.maps.update == Update::Frame;
        let technique = LookedUp {
            every_frame,
            follows: every_frame && self.placement == Placement::Center,
            lookup: PerPixel::new(gpu, stage, &module, &own_layout),
            maps,
        };
        gpu.run(|frame| technique.record_maps(frame, stage));
        Ok(Box::new(technique))
    }
}

impl EnvironmentMap {
    /// Where a mirror's map is taken from, world space.
    fn center(&self, mirror: &Mirror) -> DVec3 {
        match self.placement {
            Placement::Center => mirror.shape.center(),
            Placement::Scene => mirror.cubemaps[0],
        }
    }
}

/// The technique, ready for a scene.
struct LookedUp {
    /// The maps are drawn anew in every frame.
    every_frame: bool,
    /// Their centres go with the mirrors.
    follows: bool,
    lookup: PerPixel,
    /// One a mirror.
    maps: Vec<(CubeMaps, wgpu::BindGroup)>,
}

impl LookedUp {
    fn record_maps(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        for (map, _) in &self.maps {
            map.record(frame, stage);
        }
    }
}

impl ImageOrder for LookedUp {
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
