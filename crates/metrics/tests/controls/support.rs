//! A frame with a mirror, and what can go wrong with it.

use catoptric_frame::{Frame, Image, Name, Primary, Reflected, Status};
use catoptric_metrics::{Comparison, compare};
use glam::Vec3;

pub const SIZE: [u32; 2] = [64, 48];
pub const MIRROR: u32 = 3;

/// A round mirror at z = 0, its lower half showing floor (1), a block (2) in it, background above.
/// Positions are one unit behind the mirror point, so that angles are known.
pub fn frame() -> Frame {
    scene(0)
}

/// The same with everything that is reflected moved `shift` pixels to the right.
pub fn scene(shift: i32) -> Frame {
    let pixels = || (0..SIZE[1] as i32).flat_map(|y| (0..SIZE[0] as i32).map(move |x| (x, y)));
    let is_mirror = |(x, y): (i32, i32)| (x - 32).pow(2) + (y - 24).pow(2) < 400;
    let reflected_id = move |(x, y): (i32, i32)| {
        let x = x - shift;
        match (x, y) {
            _ if !is_mirror((x + shift, y)) => 0,
            (26..36, 14..34) => 2,
            (_, 24..) => 1,
            _ => 0,
        }
    };
    let point = |(x, y): (i32, i32)| Vec3::new(x as f32, y as f32, 0.0) / 10.0;
    let color = move |(x, y): (i32, i32)| match reflected_id((x, y)) {
        1 => Vec3::new(0.6, 0.5, 0.1) * (0.5 + ((x - shift) % 8) as f32 / 16.0),
        2 => Vec3::new(0.1, 0.2, 0.7),
        _ => Vec3::splat(0.25),
    };
    let hit = move |at: (i32, i32)| match reflected_id(at) {
        0 => Vec3::ZERO,
        _ => point((at.0 - shift, at.1)) - Vec3::Z,
    };
    Frame {
        color: Image::from_vec(SIZE, pixels().map(color).collect()),
        primary: Some(Primary {
            id: Image::from_vec(
                SIZE,
                pixels().map(|p| u32::from(is_mirror(p)) * MIRROR).collect(),
            ),
            position: Image::from_vec(SIZE, pixels().map(point).collect()),
            normal: Image::filled(SIZE, Vec3::Z),
        }),
        reflected: Some(Reflected {
            status: Image::from_vec(
                SIZE,
                pixels()
                    .map(|p| {
                        if is_mirror(p) {
                            Status::Resolved
                        } else {
                            Status::NotMirror
                        }
                    })
                    .collect(),
            ),
            id: Image::from_vec(SIZE, pixels().map(reflected_id).collect()),
            position: Image::from_vec(SIZE, pixels().map(hit).collect()),
            distance: Image::filled(SIZE, 1.0),
            bounces: None,
        }),
        motion: None,
        names: vec![Name {
            id: MIRROR,
            name: "mirror".into(),
            mirror: true,
        }],
    }
}

pub fn layers(frame: &mut Frame) -> &mut Reflected {
    frame.reflected.as_mut().unwrap()
}

/// Compares the frame with itself after `fault` has happened to it.
pub fn with_fault(fault: impl FnOnce(&mut Frame)) -> Comparison {
    let mut test = frame();
    fault(&mut test);
    compare(&frame(), &test).unwrap()
}

/// The technique sees nothing at these pixels.
pub fn cut(frame: &mut Frame, columns: std::ops::Range<u32>, rows: std::ops::Range<u32>) -> f64 {
    for y in rows.clone() {
        for x in columns.clone() {
            *layers(frame).id.at_mut(x, y) = 0;
            *layers(frame).position.at_mut(x, y) = Vec3::ZERO;
        }
    }
    f64::from((columns.end - columns.start) * (rows.end - rows.start))
}

pub fn mirror_pixels() -> f64 {
    with_fault(|_| {}).coverage.mirror_pixels as f64
}
