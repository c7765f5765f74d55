//! Rays followed by fragment shaders: one fragment a mirror pixel (Číž 2017, Alg. 1, 2 and 4).

use catoptric_frame::{Image, Traced};

use super::options::{
    Accept, Criterion, CubemapTrace, Filter, Restart, Sampling, Skipping, Unresolved,
};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, module};
use crate::image_order::cubemaps::MirrorsIn;
use crate::image_order::per_pixel::{Pass, PerPixel};
use crate::stage::Stage;
use crate::stage::variant::Variant;

/// The pass `trace`.
pub(crate) struct March {
    trace: PerPixel,
    effort: Effort,
}

/// The pass `effort`: follows the rays only to count their work.
pub(crate) struct Effort(Pass);

/// What options turn on in the shader.
pub(crate) fn features(options: &CubemapTrace) -> Vec<&'static str> {
    use {Criterion as C, Sampling as S, Skipping as P, Unresolved as U};
    let (criterion, sampling, unresolved) =
        (options.criterion, options.sampling, options.unresolved);
    let continuous = criterion != C::Distance && options.accept == Accept::Continuous;
    let features = [
        (criterion == C::Distance, "distance"),
        (criterion == C::Both, "both"),
        (criterion == C::Switch, "turning"),
        (sampling == S::Angle, "angle"),
        (sampling == S::Texel, "texel"),
        (sampling == S::Entry, "entry"),
        (options.pyramid != P::Off, "pyramid"),
        (options.pyramid == P::Sound, "sound"),
        (continuous, "continuous"),
        (options.accept == Accept::Any, "any"),
        (options.mirrors_in().is_some(), "bounce"),
        (options.mirrors_in() == Some(MirrorsIn::Apart), "apart"),
        (options.restart == Restart::Clear, "clear"),
        (options.filter == Filter::Linear, "linear"),
        (unresolved == U::Best, "best"),
        (unresolved == U::Background, "background"),
        (unresolved == U::Environment, "environment"),
        (matches!(unresolved, U::Neighbours | U::Trace), "later"),
    ];
    let features = features.into_iter();
    let features = features.filter_map(|(on, feature)| on.then_some(feature));
    features.collect()
}

impl March {
    /// `own_layout`: group 3.
    pub(crate) fn new(
        gpu: &Gpu,
        options: &CubemapTrace,
        stage: &Stage,
        own_layout: &wgpu::BindGroupLayout,
    ) -> Result<Self, ReflectError> {
        let module = module(gpu, "cubemap_trace/march", &features(options))?;
        Ok(Self {
            trace: PerPixel::new(gpu, stage, &module, own_layout),
            effort: Effort::of(gpu, stage, &module, own_layout),
        })
    }

    /// Traces into colour and, with all layers, position; `groups` are those of the mirrors' maps.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        variant: Variant,
        groups: &[&wgpu::BindGroup],
        targets: &[wgpu::TextureView; 2],
    ) {
        let groups = groups.iter().copied();
        (self.trace).record(frame, "trace", (stage, variant), groups, targets);
    }

    /// Traces once more, to count the work.
    pub(crate) fn record_effort(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        groups: &[&wgpu::BindGroup],
        target: &wgpu::TextureView,
    ) {
        self.effort.record(frame, stage, groups, target);
    }
}

impl Effort {
    /// With features of the shader named one by one; `own_layout`: group 3.
    pub(crate) fn new(
        gpu: &Gpu,
        features: &[&str],
        stage: &Stage,
        own_layout: &wgpu::BindGroupLayout,
    ) -> Result<Self, ReflectError> {
        let module = module(gpu, "cubemap_trace/march", features)?;
        Ok(Self::of(gpu, stage, &module, own_layout))
    }

    fn of(
        gpu: &Gpu,
        stage: &Stage,
        module: &wgpu::ShaderModule,
        own_layout: &wgpu::BindGroupLayout,
    ) -> Self {
        Self(Pass::new(gpu, stage, module, ("effort", 1), own_layout))
    }

    /// Writes what [`traced`] reads.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        groups: &[&wgpu::BindGroup],
        target: &wgpu::TextureView,
    ) {
        let groups = groups.iter().copied();
        self.0.record(frame, "effort", stage, groups, &[target]);
    }
}

/// Twin of `RAY` in `cubemap_trace/rays.wesl`.
const RAY: usize = 256;

/// Whether the texel of an effort image is of a pixel that a map resolved.
pub(crate) fn is_resolved(texel: &[f32; 4]) -> bool {
    !(texel[3] as usize).is_multiple_of(RAY)
}

/// What the texels of an effort image say: samples, node tests, skips, and rays with the resolving map
/// (from 1; 0 for none) in one. A pixel has been traced if it has rays.
pub(crate) fn traced(size: [u32; 2], texels: &[[f32; 4]], maps: usize) -> Traced {
    let image = |channel: usize| {
        let values = texels.iter().map(|texel| texel[channel] as u32);
        Image::from_vec(size, values.collect())
    };
    let mut resolved_by = vec![0; maps];
    let mut unresolved = 0;
    for texel in texels.iter().filter(|texel| texel[3] > 0.0) {
        match texel[3] as usize % RAY {
            0 => unresolved += 1,
            map => resolved_by[map - 1] += 1,
        }
    }
    let rays = texels.iter().map(|texel| (texel[3] as usize / RAY) as u32);
    Traced {
        samples: image(0),
        node_tests: image(1),
        skips: image(2),
        rays: Image::from_vec(size, rays.collect()),
        resolved_by,
        unresolved,
    }
}
