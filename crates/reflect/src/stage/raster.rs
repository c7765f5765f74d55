//! Rasterization of the virtual triangles onto the mirror's visible pixels.

use crate::error::ReflectError;
use crate::gpu::{Begin, Gpu, RasterTargets, Recorder, Slot, layout, module, raster, view};
use crate::stage::Stage;
use crate::stage::options::{Depth, Fragments, Hidden, SearchOptions, Show};
use crate::stage::variant::Variant;

/// The pass `virtual`.
pub(crate) struct Raster {
    /// Group 3: what `program` reads beside view, mirror and surfaces.
    pub own_layout: wgpu::BindGroupLayout,
    color: wgpu::RenderPipeline,
    layers: wgpu::RenderPipeline,
    /// Corners drawn of a triangle.
    corners: u32,
}

impl Raster {
    /// `program` has the entries `vertex`, `color` and `layers`, knows the features
    /// `virtual_depth`, `extend`, `exact`, `wireframe`, `levels` and those given, and reads `slots` as
    /// group 3.
    pub(crate) fn new(
        gpu: &Gpu,
        options: SearchOptions,
        stage: &Stage,
        program: &str,
        features: &[&str],
        slots: &[Slot],
    ) -> Result<Self, ReflectError> {
        let of_options = [
            (options.depth == Depth::Virtual, "virtual_depth"),
            (options.hidden == Hidden::Extend, "extend"),
            (options.fragments == Fragments::Exact, "exact"),
            (options.show == Show::Wireframe, "wireframe"),
            (options.show == Show::Levels, "levels"),
        ];
        let of_options = of_options
            .into_iter()
            .filter_map(|(on, name)| on.then_some(name));
        let features: Vec<_> = of_options.chain(features.iter().copied()).collect();
        let module = module(gpu, program, &features)?;
        let own_layout = layout(gpu, program, slots);
        let layouts = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&stage.world.surface_layout),
            Some(&own_layout),
        ];
        let pipeline = |entry, colors| {
            let targets = RasterTargets {
                colors,
                depth: true,
            };
            raster(gpu, &module, entry, targets, &layouts, &[])
        };
        Ok(Self {
            color: pipeline("color", 1),
            layers: pipeline("layers", 2),
            own_layout,
            corners: match options.fragments {
                Fragments::Interpolated => 3,
                Fragments::Exact => 6,
            },
        })
    }

    /// The vertices to draw for so many triangles.
    pub(crate) fn vertices(&self, triangles: u32) -> std::ops::Range<u32> {
        0..self.corners * triangles
    }

    /// Records an empty frame of reflections.
    pub(crate) fn record_clear(frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        record(frame, stage, variant, Begin::Clear, |_| {});
    }

    /// Records triangles over the reflections drawn so far; `draw` finds all groups bound.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        own: &wgpu::BindGroup,
        variant: Variant,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        record(frame, stage, variant, Begin::Keep, |pass| {
            pass.set_pipeline(match variant {
                Variant::AllLayers => &self.layers,
                Variant::Color => &self.color,
            });
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.gbuffer.mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, own, &[]);
            draw(pass);
        });
    }
}

fn record(
    frame: &mut Recorder<'_>,
    stage: &Stage,
    variant: Variant,
    begin: Begin,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let reflections = &stage.reflections;
    let targets = [view(&reflections.color), view(&reflections.position)];
    let targets = [&targets[0], &targets[1]];
    let targets = match variant {
        Variant::AllLayers => &targets[..],
        Variant::Color => &targets[..1],
    };
    let depth = Some((&reflections.depth, begin));
    frame.render("virtual", targets, begin, depth, draw);
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec2, DVec3};

    use crate::testing::{gpu_or_skip, scene};

    const SIZE: [u32; 2] = [160, 120];

    /// Largest distance between what a pixel shows and what it should show, in world units: the
    /// square's sides are 1.6 long. Rasterizers snap corners to a 256th of a pixel.
    const SNAPPED: f64 = 1e-3;

    /// In the depth mode of the thesis a triangle is interpolated as one whose corners are the
    /// reflection points: with perspective, by their own w.
    #[test]
    fn what_is_drawn_at_reflection_points_is_interpolated_by_their_w() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-square");
        let spec = crate::parse("linear").expect("a technique");
        let mut prepared = crate::prepare(&gpu, &spec, &scene, SIZE).expect("fits");
        let output = prepared.render().expect("a frame");
        let view = scene.camera.view(SIZE);
        let mesh = &scene.objects[0].mesh;
        let vertices = output.vertices.expect("a search");
        let corner = |index: u32| {
            let at = vertices[index as usize].at.as_dvec2();
            let dir = view.ray(at);
            let hit = scene.mirrors[0].shape.intersect(view.eye, dir, 0.0);
            let point = hit.expect("on the mirror").position - view.eye;
            (
                at,
                point.dot(view.forward),
                mesh.positions[index as usize].as_dvec3(),
            )
        };
        let reflected = output.frame.reflected.expect("layers");
        let (mut with_w, mut without, mut count) = (0.0_f64, 0.0_f64, 0);
        for triangle in &mesh.triangles {
            let corners = triangle.map(corner);
            let places = corners.map(|(at, ..)| at.extend(1.0));
            let weights_at = DMat3::from_cols_array_2d(&places.map(|at| at.to_array())).inverse();
            for (index, shown) in reflected.position.pixels().iter().enumerate() {
                let (x, y) = (index as u32 % SIZE[0], index as u32 / SIZE[0]);
                let center = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
                let weights = weights_at * center.extend(1.0);
                if weights.min_element() < 0.01 || reflected.id.pixels()[index] != 1 {
                    continue;
                }
                let by = |weights: DVec3| {
                    let weights = (weights / weights.element_sum()).to_array();
                    let all = weights.iter().zip(&corners);
                    all.map(|(weight, (.., position))| *weight * *position)
                        .sum::<DVec3>()
                };
                let w = DVec3::from_array(corners.map(|(_, w, _)| w));
                let shown = shown.as_dvec3();
                with_w = with_w.max(shown.distance(by(weights / w)));
                without = without.max(shown.distance(by(weights)));
                count += 1;
            }
        }
        assert!(count > 100, "{count} pixels");
        assert!(with_w < SNAPPED, "{with_w}");
        assert!(without > 10.0 * SNAPPED, "{without}");
    }
}
