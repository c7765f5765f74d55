//! Motion: for each mirror pixel, where its reflection was a frame before. One folder an estimator, named as its
//! shader in `shaders/motion/`.
//!
//! An estimator is a compute pass over the mirror's pixels. It reads the mirror G-buffers of two frames, what each
//! reflected ray meets now (a place on a triangle, and its distance), and where the vertices were before. The rays are
//! the control's (`ray-trace`), so that the motion alone is judged; the picture is theirs too. The G-buffer of the frame
//! before is kept, as an application would keep it: no time of a frame contains it.
//!
//! The frame before is the one that was shown before [`Technique::update`]; until then there is none, and the technique
//! gives no motion.

pub(crate) mod flat;
pub(crate) mod lens;
pub(crate) mod newton;
pub(crate) mod none;
pub(crate) mod surface;

use catoptric_frame::{Image, Motion, Status, Work};
use catoptric_scene::{Pose, Scene};
use encase::ShaderType;
use glam::{DVec3, Vec2, Vec3};

use crate::error::ReflectError;
use crate::gpu::{
    FLOAT4, Gpu, Kernel, Recorder, Slot, compute, group, layout, module, set_uniform, target,
    uniform, view,
};
use crate::image_order::ImageOrder;
use crate::image_order::ray_trace::Rays;
use crate::options::{Options, Settled, words};
use crate::stage::Stage;
use crate::stage::options::StageOptions;
use crate::stage::variant::Variant;
use crate::technique::{Built, Output, Technique};

/// Most triangles whose indices an f32 can tell apart.
const MOST_TRIANGLES: usize = 1 << 24;

words! {
    /// Where the derivatives of a mirror's surface come from.
    pub(crate) enum Derivatives {
        /// Differences between texels of the G-buffer.
        Gbuffer = "gbuffer",
        /// The shape itself, met by rays half a pixel apart.
        Analytic = "analytic",
    }
}

impl Derivatives {
    /// What the shader is asked for.
    fn features(self) -> &'static [&'static str] {
        match self {
            Self::Gbuffer => &[],
            Self::Analytic => &["analytic"],
        }
    }

    /// Why they cannot be had in a scene.
    fn objection(self, scene: &Scene) -> Option<String> {
        if self == Self::Gbuffer {
            return None;
        }
        let mut mirrors = scene.mirrors.iter();
        let mesh = mirrors.find(|mirror| !mirror.shape.is_analytic())?;
        Some(format!(
            "`derivatives=analytic` needs shapes that are known exactly, and `{}` is a mesh",
            mesh.name
        ))
    }
}

/// An estimator with its options settled, not yet made ready for a scene.
pub(crate) trait Recipe {
    /// Its program in `shaders/`.
    fn program(&self) -> &'static str;

    /// What of the program is on.
    fn features(&self) -> &'static [&'static str] {
        &[]
    }

    /// Steps of an iterative one.
    fn steps(&self) -> u32 {
        0
    }

    /// Why it cannot be used in a scene that has mirrors.
    fn objection(&self, _scene: &Scene) -> Option<String> {
        None
    }
}

/// An estimator as a name asks for it.
pub(crate) struct Asked {
    recipe: Box<dyn Recipe>,
    common: StageOptions,
}

impl Asked {
    /// The estimator `T`.
    pub(crate) fn read<T: Options + Recipe + 'static>(values: &mut Settled<'_>) -> Self {
        Self {
            recipe: Box::new(T::read(values)),
            common: Options::read(values),
        }
    }

    /// Why it cannot be used in a scene that has mirrors.
    pub(crate) fn objection(&self, scene: &Scene) -> Option<String> {
        if scene.triangle_count() > MOST_TRIANGLES {
            return Some(format!(
                "the scene has more than {MOST_TRIANGLES} triangles, whose indices an image cannot hold"
            ));
        }
        self.recipe.objection(scene)
    }
}

/// Twin of `Carry` in `motion/here.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct Carry {
    eye: Vec3,
    steps: u32,
    center: Vec3,
    center_before: Vec3,
    turn_x: Vec3,
    turn_y: Vec3,
    turn_z: Vec3,
}

impl Carry {
    /// Of a mirror, given its centre, how it has moved by now and how it had before.
    fn new(eye: DVec3, steps: u32, center: DVec3, [now, before]: [Pose; 2]) -> Self {
        let column = |axis: DVec3| before.turn(now.unturned(axis)).as_vec3();
        Self {
            eye: eye.as_vec3(),
            steps,
            center: center.as_vec3(),
            center_before: before.point(now.undone(center)).as_vec3(),
            turn_x: column(DVec3::X),
            turn_y: column(DVec3::Y),
            turn_z: column(DVec3::Z),
        }
    }
}

/// An estimator that stands ready for one scene and image size.
struct Estimator {
    now: Stage,
    before: Stage,
    rays: Rays,
    kernel: Kernel,
    steps: u32,
    /// There is a frame before.
    has_before: bool,
    /// A [`Carry`] a mirror, with the group 3 that has it.
    carries: Vec<(wgpu::Buffer, wgpu::BindGroup)>,
    /// The motion in pixels, 1 where there is an answer, and how often the surface was looked at.
    motion: wgpu::Texture,
}

/// Makes an estimator ready for a scene.
pub(crate) fn prepare(
    gpu: &Gpu,
    asked: &Asked,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Box<dyn Technique>, ReflectError> {
    let now = Stage::new(gpu, asked.common, scene, size)?;
    let before = Stage::new(gpu, asked.common, scene, size)?;
    let hits = target(gpu, "hits", size, FLOAT4);
    let motion = target(gpu, "motion", size, FLOAT4);
    let rays = Rays::keeping_hits(gpu, &now, &hits)?;
    let slots = [
        Slot::Uniform,
        Slot::Texture,
        Slot::Texture,
        Slot::Texture,
        Slot::Image,
    ];
    let own = layout(gpu, "motion", &slots);
    let steps = asked.recipe.steps();
    let carries = carries(&now, &before, steps).map(|carry| {
        let buffer = uniform(gpu, &carry);
        let views = [&now.gbuffer.position, &now.gbuffer.normal, &hits, &motion].map(view);
        let mut resources = vec![buffer.as_entire_binding()];
        resources.extend(views.iter().map(wgpu::BindingResource::TextureView));
        let bound = group(gpu, &own, &resources);
        (buffer, bound)
    });
    let carries = carries.collect();
    let module = module(gpu, asked.recipe.program(), asked.recipe.features())?;
    let layouts = [
        Some(&before.world.view_layout),
        Some(&before.gbuffer.mirror_layout),
        Some(&before.world.surface_layout),
        Some(&own),
    ];
    let kernel = compute(gpu, &module, "estimate", &layouts);
    gpu.check()?;
    let estimator = Estimator {
        now,
        before,
        rays,
        kernel,
        steps,
        has_before: false,
        carries,
        motion,
    };
    estimator.keep(gpu);
    Ok(Box::new(estimator))
}

/// One a mirror.
fn carries(now: &Stage, before: &Stage, steps: u32) -> impl Iterator<Item = Carry> {
    let eye = now.world.scene.camera.eye;
    let mirrors = now.world.scene.mirrors.iter();
    let mirrors = mirrors.zip(&before.world.scene.mirrors);
    mirrors.map(move |(now, before)| {
        Carry::new(eye, steps, now.shape.center(), [now.pose, before.pose])
    })
}

impl Estimator {
    /// Draws the G-buffer of the frame before.
    fn keep(&self, gpu: &Gpu) {
        gpu.run(|frame| self.before.begin(frame, Variant::Color));
    }
}

impl Technique for Estimator {
    fn update(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), ReflectError> {
        let shown = self.now.world.scene.clone();
        self.now.world.update(gpu, scene)?;
        self.before.world.update(gpu, &shown)?;
        self.rays.update(gpu, &self.now)?;
        let all = carries(&self.now, &self.before, self.steps);
        for (carry, (buffer, _)) in all.zip(&self.carries) {
            set_uniform(gpu, buffer, &carry);
        }
        self.keep(gpu);
        self.has_before = true;
        Ok(())
    }

    fn begin_frame(&mut self, _: &Gpu) -> Result<Built, ReflectError> {
        Ok(Built::Nothing)
    }

    fn record(&self, frame: &mut Recorder<'_>, variant: Variant) {
        self.now.begin(frame, variant);
        self.rays.record(frame, &self.now, variant);
        let [width, height] = self.kernel.groups_over(self.now.world.size);
        for ((_, own), mirror) in self.carries.iter().zip(&self.before.gbuffer.mirror_groups) {
            frame.compute("motion", |pass| {
                pass.set_pipeline(&self.kernel);
                pass.set_bind_group(0, &self.before.world.view_group, &[]);
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(2, &self.before.world.surface_group, &[]);
                pass.set_bind_group(3, own, &[]);
                pass.dispatch_workgroups(width, height, 1);
            });
        }
        self.now.finish(frame);
    }

    fn output(&self, gpu: &Gpu) -> Output {
        let mut frame = self.now.layers(gpu, None);
        let texels = gpu.read_texture(&self.motion);
        let status = frame.reflected.as_ref().map(|layers| &layers.status);
        // Elsewhere the image holds what earlier frames have left there.
        let shown: Vec<bool> = match status {
            Some(status) => status
                .pixels()
                .iter()
                .map(|s| *s == Status::Resolved)
                .collect(),
            None => vec![false; texels.len()],
        };
        let known = texels.iter().zip(&shown);
        let known: Vec<bool> = known
            .map(|(texel, shown)| *shown && texel[2] > 0.0)
            .collect();
        let vectors = texels.iter().zip(&known).map(|(texel, known)| match known {
            true => Vec2::new(texel[0], texel[1]),
            false => Vec2::ZERO,
        });
        let size = self.now.world.size;
        frame.motion = self.has_before.then(|| Motion {
            vector: Image::from_vec(size, vectors.collect()),
            valid: Image::from_vec(size, known.clone()),
            disoccluded: None,
            converted: None,
        });
        let looks = texels.iter().zip(&shown).filter(|(_, shown)| **shown);
        let looks: f64 = looks.map(|(texel, _)| f64::from(texel[3])).sum();
        let pixels = shown.iter().filter(|shown| **shown).count();
        Output {
            frame,
            may_be_unresolved: false,
            vertices: None,
            searched: 0,
            triangles: None,
            t_junctions: None,
            levels: None,
            work: Work {
                evaluations: (pixels > 0).then(|| looks / pixels as f64),
                ..Work::default()
            },
            notes: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn the_uniform_lies_as_the_shaders_read_it() {
        assert_layout!(
            Carry {
                eye,
                steps,
                center,
                center_before,
                turn_x,
                turn_y,
                turn_z
            },
            "motion/newton",
            &[],
            "Carry"
        );
    }
}
