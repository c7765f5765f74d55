//! Control of `more.distance`.

use glam::Vec3;

use super::support::{layers, with_fault};

#[test]
fn a_tenth_farther_is_an_error_of_a_tenth() {
    assert_eq!(with_fault(|_| {}).more.distance, Some(0.0));
    // Hits lie one unit behind the mirror points.
    let farther = with_fault(|frame| {
        for position in layers(frame).position.pixels_mut() {
            position.z -= 0.1;
        }
    });
    let error = farther.more.distance.expect("objects are reflected");
    assert!((error - 0.1).abs() < 1e-6, "{error}");
    // The angle does not notice.
    assert!(farther.angular_error_deg.expect("the same objects").max < 1e-3);
}

#[test]
fn where_nothing_is_reflected_there_is_no_distance() {
    let nothing = with_fault(|frame| layers(frame).id.pixels_mut().fill(0));
    assert_eq!(nothing.more.distance, None);
    let not_finite = with_fault(|frame| layers(frame).position.pixels_mut().fill(Vec3::NAN));
    assert_eq!(not_finite.more.distance, None);
}
