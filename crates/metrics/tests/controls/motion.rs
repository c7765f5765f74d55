//! Control of `motion`: vectors that are a known way off, or missing, must be noticed.

use catoptric_frame::{Frame, Image, Motion};
use catoptric_metrics::{MotionSamples, motion_error, motion_map};
use glam::Vec2;

use super::support::{SIZE, frame, scene};

/// Everything reflected has moved 2 pixels to the right.
const WAY: Vec2 = Vec2::new(-2.0, 0.0);

fn with_motion(frame: Frame, vector: Vec2) -> Frame {
    let status = &frame.reflected.as_ref().unwrap().status;
    let mirror = status.map(|status| *status == catoptric_frame::Status::Resolved);
    Frame {
        motion: Some(Motion {
            vector: mirror.map(|mirror| if *mirror { vector } else { Vec2::ZERO }),
            valid: mirror,
            disoccluded: Some(Image::filled(SIZE, false)),
            converted: None,
        }),
        ..frame
    }
}

fn truth() -> Frame {
    with_motion(scene(2), WAY)
}

#[test]
fn a_vector_that_is_a_pixel_off_is_an_error_of_a_pixel() {
    let same = motion_error(&truth(), &truth()).unwrap();
    assert_eq!(same.error_px.unwrap().max, 0.0);
    assert_eq!((same.pixels, same.missing), (1245, Some(0.0)));
    assert_eq!(same.true_px.unwrap().p50, 2.0);
    assert_eq!(same.rim.pixels + same.interior.pixels, same.pixels);
    assert_eq!((same.mirrors.len(), same.mirrors[0].pixels), (1, 1245));
    assert_eq!(same.mirrors[0].name, "mirror");

    let off = with_motion(scene(2), WAY + Vec2::Y);
    let error = motion_error(&truth(), &off).unwrap();
    let px = error.error_px.unwrap();
    assert_eq!((px.p50, px.max), (1.0, 1.0));
    assert_eq!(error.rim.error_px.unwrap().p50, 1.0);
    assert_eq!(error.interior.error_px.unwrap().p50, 1.0);
    let map = motion_map(&truth(), &off).unwrap();
    assert_eq!(*map.at(32, 24), 1.0);
    assert!(map.at(0, 0).is_nan());
}

#[test]
fn a_vector_that_is_missing_is_no_error_but_missing() {
    let mut some = truth();
    let motion = some.motion.as_mut().unwrap();
    for y in 20..25 {
        *motion.valid.at_mut(32, y) = false;
    }
    let error = motion_error(&truth(), &some).unwrap();
    assert_eq!(error.missing, Some(5.0 / 1245.0));
    assert_eq!(error.error_px.unwrap().max, 0.0);
    assert_eq!(
        *motion_map(&truth(), &some).unwrap().at(32, 22),
        f32::INFINITY
    );
    // What is not a number is no answer.
    some.motion.as_mut().unwrap().vector.at_mut(30, 24).x = f32::NAN;
    let error = motion_error(&truth(), &some).unwrap();
    assert_eq!(error.missing, Some(6.0 / 1245.0));
}

#[test]
fn a_picture_fetched_by_wrong_vectors_is_seen_to_be_wrong() {
    let before = scene(0).color;
    let picture = |vector: Vec2| {
        let mut samples = MotionSamples::default();
        let test = with_motion(scene(2), vector);
        samples.add(&truth(), &test, Some(&before)).unwrap();
        samples.report().unwrap().picture.unwrap()
    };
    let right = picture(WAY);
    assert_eq!(right.excess, 0.0);
    let wrong = picture(WAY + Vec2::new(3.0, 0.0));
    assert_eq!(wrong.flip_true, right.flip_true);
    assert!(wrong.excess > 0.02, "{wrong:?}");
    // Left out where something was hidden.
    let mut hidden = truth();
    hidden.motion.as_mut().unwrap().disoccluded = Some(Image::filled(SIZE, true));
    let mut samples = MotionSamples::default();
    samples.add(&hidden, &truth(), Some(&before)).unwrap();
    assert_eq!(samples.report().unwrap().picture, None);
}

#[test]
fn without_layers_there_is_nothing_to_judge() {
    assert!(motion_error(&frame(), &truth()).is_err());
    assert!(motion_error(&truth(), &frame()).is_err());
    assert_eq!(MotionSamples::default().report(), None);
}
