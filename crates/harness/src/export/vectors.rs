//! Motion of reflections in the conventions of the programs that read it, and the distance of the virtual
//! image, which denoisers reproject.
//!
//! All of them point from a pixel of this frame to where it was in the frame before.
//!
//! | name | unit | y | read so by |
//! |---|---|---|---|
//! | `pixels` | pixels | down | DLSS and DLSS Ray Reconstruction (`InMVScale` 1), FSR 2 and 3 with `motionVectorScale` 1 over the picture's size, XeSS, MetalFX |
//! | `uv` | widths and heights of the picture | down | NRD (`IN_MV` in screen space, `motionVectorScale` 1), FSR 2 and 3 with `motionVectorScale` 1 |
//! | `ndc` | halves of them | up | XeSS with velocities in normalized device coordinates |
//!
//! The virtual distance is that of the thin lens, `b / (2 κ b cosθ + 1)` behind the mirror's point along the eye
//! ray, for the mean curvature κ of the picture's own points and normals; the true hit distance, which
//! NRD and Ray Reconstruction ask for, is `reflected.distance`.

use catoptric_frame::{Converted, Frame, Image, Motion, Status};
use clap::ValueEnum;
use glam::{DVec3, Vec2};

/// How vectors are written beside `motion.X` and `motion.Y`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Convention {
    /// Pixels, y down: DLSS, XeSS, MetalFX
    Pixels,
    /// Shares of the picture's width and height, y down: NRD, FSR
    Uv,
    /// Normalized device coordinates, y up: XeSS
    Ndc,
}

impl Convention {
    /// A vector in pixels, y down, as it is written.
    fn of(self, vector: Vec2, size: Vec2) -> Vec2 {
        match self {
            Self::Pixels => vector,
            Self::Uv => vector / size,
            Self::Ndc => 2.0 * vector / size * Vec2::new(1.0, -1.0),
        }
    }
}

/// Adds the vectors in a convention, and the virtual distance; does nothing to a picture without motion.
pub fn convert(frame: &mut Frame, eye: DVec3, convention: Convention) {
    let Some(motion) = &frame.motion else { return };
    let [width, height] = frame.color.size();
    let size = Vec2::new(width as f32, height as f32);
    let vector = motion.vector.map(|vector| convention.of(*vector, size));
    let converted = Converted {
        vector,
        virtual_distance: virtual_distance(frame, eye),
    };
    if let Some(Motion {
        converted: place, ..
    }) = &mut frame.motion
    {
        *place = Some(converted);
    }
}

/// Signed distance behind the mirror's point; 0 where nothing is reflected but the background, and off
/// the mirrors. Where the image lies at infinity, infinite.
fn virtual_distance(frame: &Frame, eye: DVec3) -> Image<f32> {
    let size = frame.color.size();
    let (Some(primary), Some(reflected)) = (&frame.primary, &frame.reflected) else {
        return Image::filled(size, 0.0);
    };
    let [width, height] = size.map(|side| side as usize);
    let shown = |x: usize, y: usize, id: u32| {
        let index = y * width + x;
        x < width
            && y < height
            && primary.id.pixels()[index] == id
            && reflected.status.pixels()[index] == Status::Resolved
    };
    let point = |index: usize| primary.position.pixels()[index].as_dvec3();
    let normal = |index: usize| primary.normal.pixels()[index].as_dvec3();
    let pixel = |index: usize| {
        let (x, y) = (index % width, index / width);
        let id = primary.id.pixels()[index];
        let b = f64::from(reflected.distance.pixels()[index]);
        if !shown(x, y, id) || b == 0.0 {
            return 0.0;
        }
        // Between both neighbours, or one of them at the outline.
        let change = |dx: usize, dy: usize| {
            let after = shown(x + dx, y + dy, id);
            let before = x >= dx && y >= dy && shown(x - dx, y - dy, id);
            let step = dy * width + dx;
            let (to, from) = (
                if after { index + step } else { index },
                if before { index - step } else { index },
            );
            let apart = (usize::from(after) + usize::from(before)) as f64;
            let over = |change: DVec3| change / apart;
            (
                over(point(to) - point(from)),
                over(normal(to) - normal(from)),
            )
        };
        let ((px, nx), (py, ny)) = (change(1, 0), change(0, 1));
        let (e, f, g) = (px.dot(px), px.dot(py), py.dot(py));
        let (l, m, n) = (nx.dot(px), (nx.dot(py) + ny.dot(px)) / 2.0, ny.dot(py));
        let curvature = (e * n - 2.0 * f * m + g * l) / (e * g - f * f) / 2.0;
        let cosine = (eye - point(index)).normalize().dot(normal(index));
        (b / (2.0 * curvature * b * cosine + 1.0)) as f32
    };
    let pixels = (0..width * height).map(pixel).map(|distance| {
        // A pixel without neighbours has no curvature.
        if distance.is_nan() { 0.0 } else { distance }
    });
    Image::from_vec(size, pixels.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conventions_differ_in_unit_and_sign() {
        let (vector, size) = (Vec2::new(32.0, -12.0), Vec2::new(640.0, 480.0));
        assert_eq!(Convention::Pixels.of(vector, size), vector);
        assert_eq!(Convention::Uv.of(vector, size), Vec2::new(0.05, -0.025));
        assert_eq!(Convention::Ndc.of(vector, size), Vec2::new(0.1, 0.05));
    }

    #[test]
    fn a_ball_shows_what_is_far_away_at_half_its_radius() {
        use catoptric_reference::{RenderOptions, Tracer, Truth};
        let scene = catoptric_scene::open("moving-ball-camera-within-8", &Default::default());
        let scene = scene.expect("a built-in scene");
        let tracer = Tracer::new(&scene).expect("can be traced");
        let frame = tracer.render(&RenderOptions::new([64, 48], Truth::FirstBounce));
        let distance = virtual_distance(&frame, scene.camera.eye);
        let hits = frame.reflected.as_ref().expect("layers");
        let far = hits.distance.pixels().iter().zip(distance.pixels());
        let focus: Vec<f32> = far.filter(|(b, _)| **b > 6.0).map(|(_, d)| *d).collect();
        assert!(focus.len() > 50, "{} pixels", focus.len());
        // Between the focus of rays along the normal, 0.45, and rays that graze: nothing nearer, and of most not
        // much farther.
        let near = focus.iter().filter(|d| (0.4..1.0).contains(*d)).count();
        assert!(near * 10 > focus.len() * 7, "{near} of {}", focus.len());
        assert!(focus.iter().all(|d| *d > 0.35), "{focus:?}");
    }
}
