//! Pictures: what each pixel's eye ray meets, and what it sees reflected there.
//!
//! Colours are unlit. A mirror that is met on its back is opaque black ([`Status::Back`]). A
//! reflected ray that would start below the geometric surface of a mesh mirror is not traced
//! and its pixel is black ([`Status::Below`]); the same where that happens after further bounces.
//! `reflected.*` is the first surface that a reflected ray meets, under [`Truth::Full`] the last
//! of its path; `reflected.distance` is the length of the ray's last segment.

use std::sync::atomic::{AtomicU32, Ordering};

use catoptric_frame::{Frame, Image, Name, Primary, Reflected, Status};
use catoptric_scene::View;
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::tracer::{Hit, Surface, Tracer};

/// Which reflections a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Reflected rays meet everything except mirrors, as all four papers assume.
    FirstBounce,
    /// Mirrors in mirrors.
    Full {
        /// Most reflections on one path; 0 counts as 1. A mirror met after the last of them is
        /// the last surface of its path, and black.
        bounces: u32,
    },
}

/// What to render.
#[derive(Clone, Copy)]
pub struct RenderOptions<'a> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Which reflections.
    pub truth: Truth,
    /// Colour is the mean of a regular grid of `samples` × `samples` rays a pixel; 1 (and 0) is
    /// the pixel centre alone. All other layers are always of the pixel centre.
    pub samples: u32,
    /// Called after each row, from any thread, with the number of rows finished and of all rows.
    pub progress: Option<&'a (dyn Fn(u32, u32) + Sync)>,
}

impl RenderOptions<'_> {
    /// One ray through each pixel's centre, and no progress calls.
    pub fn new(size: [u32; 2], truth: Truth) -> Self {
        Self {
            size,
            truth,
            samples: 1,
            progress: None,
        }
    }
}

/// What one eye ray sees, in f64.
#[derive(Clone, Copy, Debug)]
pub struct PixelTrace {
    /// Unit direction of the eye ray, world space.
    pub direction: DVec3,
    /// The first surface along the eye ray.
    pub primary: Option<Hit>,
    /// What is reflected; `None` where the first surface is no mirror.
    pub reflection: Option<Reflection>,
    /// Linear RGB.
    pub color: Vec3,
}

/// What a mirror pixel reflects.
#[derive(Clone, Copy, Debug)]
pub struct Reflection {
    /// Never [`Status::NotMirror`] nor [`Status::Unresolved`].
    pub status: Status,
    /// Unit direction of the first reflected ray, world space; where `status` is `Back` or `Below` (at the
    /// first mirror), zero.
    pub direction: DVec3,
    /// The surface met: the first, under [`Truth::Full`] the last; `None` for the background.
    pub hit: Option<Hit>,
    /// Reflections on the way to `hit` or to the background.
    pub bounces: u32,
}

impl Tracer {
    /// Renders all layers, in parallel.
    pub fn render(&self, options: &RenderOptions) -> Frame {
        let [width, height] = options.size;
        let view = self.scene().camera.view(options.size);
        let finished = AtomicU32::new(0);
        let pixels: Vec<Pixel> = (0..height)
            .into_par_iter()
            .flat_map_iter(|y| {
                let row: Vec<Pixel> = (0..width)
                    .map(|x| self.pixel(&view, x, y, options))
                    .collect();
                if let Some(progress) = options.progress {
                    progress(finished.fetch_add(1, Ordering::Relaxed) + 1, height);
                }
                row
            })
            .collect();
        let pixels = Image::from_vec(options.size, pixels);
        let names = self.scene().ids().into_iter();
        Frame {
            color: pixels.map(|pixel| pixel.color),
            primary: Some(Primary {
                id: pixels.map(|pixel| pixel.primary_id),
                position: pixels.map(|pixel| pixel.primary_position),
                normal: pixels.map(|pixel| pixel.primary_normal),
            }),
            reflected: Some(Reflected {
                status: pixels.map(|pixel| pixel.status),
                id: pixels.map(|pixel| pixel.id),
                position: pixels.map(|pixel| pixel.position),
                distance: pixels.map(|pixel| pixel.distance),
                bounces: matches!(options.truth, Truth::Full { .. })
                    .then(|| pixels.map(|pixel| pixel.bounces)),
            }),
            motion: None,
            names: names
                .map(|(id, name, mirror)| Name { id, name, mirror })
                .collect(),
        }
    }

    /// What the eye ray through image coordinates `at` sees.
    pub fn reflect_pixel(&self, view: &View, at: DVec2, truth: Truth) -> PixelTrace {
        let direction = view.ray(at);
        let primary = self.trace(view.eye, direction);
        let (reflection, color) = match primary {
            None => (None, self.background(direction)),
            Some(hit) => match hit.surface {
                Surface::Object { .. } => (None, self.color(&hit)),
                Surface::Mirror { front, .. } => {
                    let (reflection, color) = self.follow(direction, hit, front, truth);
                    (Some(reflection), color)
                }
            },
        };
        PixelTrace {
            direction,
            primary,
            reflection,
            color,
        }
    }

    /// Follows a ray in direction `dir` that has met a mirror, to its end.
    fn follow(&self, dir: DVec3, mirror: Hit, front: bool, truth: Truth) -> (Reflection, Vec3) {
        let black = |status, direction, hit, bounces| {
            (
                Reflection {
                    status,
                    direction,
                    hit,
                    bounces,
                },
                Vec3::ZERO,
            )
        };
        if !front {
            return black(Status::Back, DVec3::ZERO, None, 0);
        }
        let (limit, mirrors) = match truth {
            Truth::FirstBounce => (1, false),
            Truth::Full { bounces } => (bounces.max(1), true),
        };
        let mut first = DVec3::ZERO;
        let (mut dir, mut mirror) = (dir, mirror);
        for bounces in 1..=limit {
            let Some(reflected) = reflect(dir, &mirror) else {
                return black(Status::Below, first, None, bounces - 1);
            };
            if bounces == 1 {
                first = reflected;
            }
            let hit = self.trace_reflected(&mirror, reflected, mirrors);
            match hit.map(|hit| (hit, hit.surface)) {
                Some((hit, Surface::Mirror { front: true, .. })) => {
                    (dir, mirror) = (reflected, hit);
                }
                Some((hit, Surface::Mirror { front: false, .. })) => {
                    return black(Status::Resolved, first, Some(hit), bounces);
                }
                Some((hit, Surface::Object { .. })) => {
                    let status = Status::Resolved;
                    let reflection = Reflection {
                        status,
                        direction: first,
                        hit: Some(hit),
                        bounces,
                    };
                    return (reflection, self.color(&hit));
                }
                None => {
                    let status = Status::Resolved;
                    let reflection = Reflection {
                        status,
                        direction: first,
                        hit: None,
                        bounces,
                    };
                    return (reflection, self.background(reflected));
                }
            }
        }
        black(Status::Resolved, first, Some(mirror), limit)
    }

    fn pixel(&self, view: &View, x: u32, y: u32, options: &RenderOptions) -> Pixel {
        let corner = DVec2::new(f64::from(x), f64::from(y));
        let trace = self.reflect_pixel(view, corner + 0.5, options.truth);
        let mut pixel = Pixel {
            color: trace.color,
            ..Pixel::default()
        };
        if options.samples > 1 {
            let n = options.samples;
            let mut sum = DVec3::ZERO;
            for sample in 0..n * n {
                let cell = DVec2::new(f64::from(sample % n), f64::from(sample / n));
                let at = corner + (cell + 0.5) / f64::from(n);
                sum += self.reflect_pixel(view, at, options.truth).color.as_dvec3();
            }
            pixel.color = (sum / f64::from(n * n)).as_vec3();
        }
        if let Some(hit) = trace.primary {
            pixel.primary_id = hit.id;
            pixel.primary_position = hit.position.as_vec3();
            pixel.primary_normal = hit.normal.as_vec3();
        }
        if let Some(reflection) = trace.reflection {
            pixel.status = reflection.status;
            pixel.bounces = reflection.bounces;
            if let Some(hit) = reflection.hit {
                pixel.id = hit.id;
                pixel.position = hit.position.as_vec3();
                pixel.distance = hit.t as f32;
            }
        }
        pixel
    }
}

/// Direction of the ray reflected about the shading normal; `None` where it would start below
/// the surface, or where the shading normal is turned away from the incoming ray.
pub(crate) fn reflect(dir: DVec3, mirror: &Hit) -> Option<DVec3> {
    let cosine = dir.dot(mirror.normal);
    let reflected = (dir - 2.0 * cosine * mirror.normal).normalize();
    (cosine < 0.0 && reflected.dot(mirror.geometric) > 0.0).then_some(reflected)
}

/// All layers of one pixel.
#[derive(Clone, Copy, Default)]
struct Pixel {
    color: Vec3,
    primary_id: u32,
    primary_position: Vec3,
    primary_normal: Vec3,
    status: Status,
    id: u32,
    position: Vec3,
    distance: f32,
    bounces: u32,
}
