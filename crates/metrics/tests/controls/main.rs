//! Every metric is shown to fail: a known fault is put into a frame and must trip it, by the amount
//! that follows from the fault.

mod distance;
mod motion;
mod support;

use catoptric_frame::{Image, Status};
use catoptric_metrics::{
    CompareOptions, Comparison, CoverageClass, MapKind, MetricsError, compare, compare_color,
    compare_with, error_map, pixel_angle_deg,
};
use glam::Vec3;

use support::{SIZE, cut, frame, layers, mirror_pixels, scene, with_fault};

#[test]
fn an_answer_in_whole_pixels_is_off_by_the_places_in_a_pixel() {
    // Hits a unit behind the mirror point, moving a tenth of a unit a pixel beyond the point's own
    // tenth: with mirror points that stand still a place (x, y) in the pixel is seen from the
    // centre at atan(|(x, y)| / 10) to the side, the hit at the centre being straight behind.
    let mut still = frame();
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let step = Vec3::new(x as f32, y as f32, 0.0) / 10.0;
            *layers(&mut still).position.at_mut(x, y) = step - 100.0 * Vec3::Z;
        }
    }
    let found = pixel_angle_deg(&still).unwrap().unwrap();
    let angle = |x: f64, y: f64| (x.hypot(y) / 1000.0).to_degrees();
    // Half the places of a 4 × 4 grid: 2 near, 4 between, 2 far.
    let expected = angle(0.125, 0.375);
    assert!((found.p50 / expected - 1.0).abs() < 1e-4, "{found:?}");
    assert!(
        (found.max / angle(0.375, 0.375) - 1.0).abs() < 1e-4,
        "{found:?}"
    );
    let mut nothing = frame();
    cut(&mut nothing, 0..SIZE[0], 0..SIZE[1]);
    assert_eq!(pixel_angle_deg(&nothing), Ok(None));
}

#[test]
fn identical_frames_are_without_any_error() {
    let same = with_fault(|_| {});
    assert_eq!(same.coverage.mirror_pixels, 1245);
    assert_eq!(
        (same.coverage.missing, same.coverage.extra),
        (Some(0.0), Some(0.0))
    );
    assert_eq!(
        (same.coverage.unresolved, same.coverage.t_junctions),
        (None, None)
    );
    assert_eq!(
        (same.coverage.cracks, same.coverage.holes),
        (Some(0), Some(0))
    );
    assert_eq!(same.coverage.iou, Some(1.0));
    assert_eq!(same.object_agreement, Some(1.0));
    let mismatch = same.mismatch.unwrap();
    assert_eq!((mismatch.boundary, mismatch.interior), (0.0, 0.0));
    assert_eq!(same.angular_error_deg.unwrap().max, 0.0);
    assert_eq!(same.edge_offset_px.unwrap().max, 0.0);
    let regions = [same.color, same.regions.image, same.regions.rim.color];
    for color in regions.into_iter().chain([same.regions.interior.color]) {
        let color = color.unwrap();
        assert_eq!((color.mae, color.rmse, color.psnr), (0.0, 0.0, None));
        assert!(color.equal && color.left_out == 0);
        assert_eq!((color.ssim, color.flip), (1.0, 0.0));
        assert_eq!((color.rel_mse, color.mrse), (0.0, 0.0));
    }
    let parts = same.regions.rim.mirror_pixels + same.regions.interior.mirror_pixels;
    assert_eq!(parts, same.coverage.mirror_pixels);
    assert!(same.regions.rim.mirror_pixels > 300);
}

#[test]
fn one_pixel_to_the_right_trips_everything() {
    let shifted = compare(&frame(), &scene(1)).unwrap();
    // The block's left edge: ten rows lose it to the background above, its right edge gains ten.
    assert_eq!(shifted.coverage.missing, Some(10.0 / mirror_pixels()));
    assert_eq!(shifted.coverage.extra, Some(10.0 / mirror_pixels()));
    assert_eq!(shifted.object_agreement, Some(1.0 - 40.0 / mirror_pixels()));
    let mismatch = shifted.mismatch.unwrap();
    assert!(mismatch.boundary > 0.0);
    assert_eq!(
        mismatch.interior, 0.0,
        "a pixel's shift stays within a pixel of the edges"
    );
    // A tenth of a unit sideways at a distance of one unit.
    let expected = 0.1_f64.atan().to_degrees();
    let angle = shifted.angular_error_deg.unwrap();
    assert!((angle.p50 - expected).abs() < 1e-4 && (angle.max - expected).abs() < 1e-4);
    // Upright edges move by a pixel, level ones along themselves.
    let edges = shifted.edge_offset_px.unwrap();
    assert!(
        edges.max == 1.0 && edges.mean > 0.3 && edges.mean < 0.7,
        "{edges:?}"
    );
    let color = shifted.color.unwrap();
    assert!(color.mae > 0.01 && color.rmse > 0.02 && color.psnr.unwrap() < 35.0);
    assert!(color.ssim < 0.95 && color.flip > 0.02, "{color:?}");
}

#[test]
fn swapped_ids_trip_agreement_but_not_coverage() {
    let swapped = with_fault(|test| {
        for id in layers(test).id.pixels_mut() {
            *id = [0, 2, 1][*id as usize];
        }
    });
    let surface = frame()
        .reflected
        .unwrap()
        .id
        .pixels()
        .iter()
        .filter(|&&id| id > 0)
        .count();
    let share = surface as f64 / mirror_pixels();
    assert!((swapped.object_agreement.unwrap() - (1.0 - share)).abs() < 1e-12);
    assert!(swapped.mismatch.unwrap().interior > 0.3);
    assert_eq!(
        (swapped.coverage.missing, swapped.coverage.extra),
        (Some(0.0), Some(0.0))
    );
    assert_eq!(
        swapped.angular_error_deg, None,
        "no pixel where both see the same object"
    );
}

#[test]
fn one_percent_brighter_trips_colour_by_as_much() {
    let brighter = with_fault(|test| {
        test.color
            .pixels_mut()
            .iter_mut()
            .for_each(|color| *color *= 1.01);
    });
    let color = brighter.color.unwrap();
    let reference = frame();
    let status = reference.reflected.unwrap().status;
    let mask = status.map(|&status| status == Status::Resolved);
    let of_mask = reference
        .color
        .pixels()
        .iter()
        .zip(mask.pixels())
        .filter(|(_, inside)| **inside);
    let mean = of_mask
        .map(|(color, _)| f64::from(color.element_sum()))
        .sum::<f64>();
    let mean = mean / (3.0 * mirror_pixels());
    assert!(
        (color.mae - 0.01 * mean).abs() < 1e-6,
        "{} {mean}",
        color.mae
    );
    assert!(color.psnr.unwrap() > 45.0 && color.psnr.unwrap() < 60.0);
    assert!(color.ssim < 1.0 && color.flip > 0.0 && color.rel_mse > 0.0 && color.mrse > 0.0);
    assert_eq!(brighter.object_agreement, Some(1.0));
    assert_eq!(brighter.angular_error_deg.unwrap().max, 0.0);
}

#[test]
fn a_known_colour_difference_gives_the_textbook_numbers() {
    let flat = |value: f32| Image::filled([16, 16], Vec3::splat(value));
    let mask = Image::filled([16, 16], true);
    let color = compare_color(&flat(0.5), &flat(0.75), &mask, 67.0)
        .unwrap()
        .unwrap();
    assert_eq!((color.mae, color.rmse), (0.25, 0.25));
    assert!((color.psnr.unwrap() - 12.041_199_826_559_248).abs() < 1e-12);
    assert!(!color.equal);
    assert!((color.rel_mse - 0.0625 / 0.26).abs() < 1e-12);
    assert!((color.mrse - 0.0625 / 0.2601).abs() < 1e-12);
}

#[test]
fn a_dropped_triangle_is_missing_and_a_thin_one_is_a_crack() {
    let mut pixels = 0.0;
    let dropped = with_fault(|test| pixels = cut(test, 20..24, 27..32));
    assert_eq!(dropped.coverage.missing, Some(pixels / mirror_pixels()));
    assert_eq!(dropped.coverage.cracks, Some(1));
    assert_eq!(dropped.coverage.crack_pixels, Some(20));
    assert_eq!(dropped.coverage.widest_crack_px, Some(4));
    assert_eq!(
        dropped.object_agreement,
        Some(1.0 - pixels / mirror_pixels())
    );
    assert!(dropped.coverage.iou.unwrap() < 1.0);

    let cracked = with_fault(|test| {
        cut(test, 20..21, 26..36);
        cut(test, 40..45, 30..31);
    });
    assert_eq!(
        (cracked.coverage.cracks, cracked.coverage.widest_crack_px),
        (Some(2), Some(1))
    );

    let at_the_edge = with_fault(|test| {
        cut(test, 18..22, 24..26);
    });
    assert!(at_the_edge.coverage.missing > Some(0.0));
    assert_eq!(
        at_the_edge.coverage.cracks,
        Some(0),
        "open towards the background"
    );
}

#[test]
fn a_false_edge_is_far_from_all_true_ones() {
    let torn = with_fault(|test| {
        cut(test, 19..21, 29..31);
    });
    let edges = torn.edge_offset_px.unwrap();
    assert!(edges.max > 3.0, "{edges:?}");
    assert!(
        edges.p50 == 0.0,
        "the others are where they were: {edges:?}"
    );
}

#[test]
fn something_where_nothing_is_is_extra() {
    let extra = with_fault(|test| *layers(test).id.at_mut(32, 8) = 1);
    assert_eq!(extra.coverage.extra, Some(1.0 / mirror_pixels()));
    assert_eq!(extra.coverage.missing, Some(0.0));
}

#[test]
fn unresolved_pixels_are_no_background() {
    let at_background = with_fault(|test| *layers(test).status.at_mut(32, 8) = Status::Unresolved);
    assert_eq!(
        at_background.coverage.unresolved,
        Some(1.0 / mirror_pixels())
    );
    assert_eq!(at_background.coverage.missing, Some(0.0));
    assert_eq!(
        at_background.object_agreement,
        Some(1.0 - 1.0 / mirror_pixels())
    );

    let at_object = with_fault(|test| {
        cut(test, 20..21, 30..31);
        *layers(test).status.at_mut(20, 30) = Status::Unresolved;
    });
    assert_eq!(at_object.coverage.missing, Some(1.0 / mirror_pixels()));
    assert_eq!(
        at_object.coverage.cracks,
        Some(0),
        "it says that it does not know"
    );

    let options = CompareOptions {
        may_be_unresolved: true,
        t_junctions: Some(7),
        ..CompareOptions::default()
    };
    let resolved = compare_with(&frame(), &frame(), &options).unwrap();
    assert_eq!(resolved.coverage.unresolved, Some(0.0));
    assert_eq!(resolved.coverage.t_junctions, Some(7));
}

#[test]
fn below_and_back_are_counted_apart() {
    let apart = with_fault(|test| {
        *layers(test).status.at_mut(32, 30) = Status::Below;
        *layers(test).status.at_mut(33, 30) = Status::Back;
        *layers(test).status.at_mut(0, 0) = Status::Resolved;
    });
    assert_eq!(apart.coverage.mirror_pixels as f64, mirror_pixels() - 2.0);
    assert_eq!(apart.coverage.below, 1);
    assert_eq!(apart.coverage.mirror_only_reference, 1);
    assert_eq!(apart.coverage.mirror_only_test, 1);
    assert_eq!(apart.object_agreement, Some(1.0));
}

#[test]
fn what_is_not_finite_is_counted_and_left_out() {
    let odd = with_fault(|test| {
        *test.color.at_mut(32, 24) = Vec3::splat(f32::NAN);
        *test.color.at_mut(33, 24) = Vec3::new(0.0, f32::INFINITY, 0.0);
        *layers(test).position.at_mut(20, 30) = Vec3::splat(f32::NAN);
    });
    assert_eq!((odd.non_finite.reference, odd.non_finite.test), (0, 2));
    assert_eq!(odd.non_finite.angles, 1);
    let reason = odd.non_finite.reason().unwrap();
    for part in [
        "2 mirror pixels whose colour in the tested",
        "1 mirror pixels where a position",
    ] {
        assert!(reason.contains(part), "{reason}");
    }
    assert_eq!(with_fault(|_| {}).non_finite.reason(), None);
    let color = odd.color.unwrap();
    assert_eq!((color.mae, color.psnr, color.left_out), (0.0, None, 2));
    assert!(!color.equal, "what is not compared is not equal");
    assert!(odd.color.unwrap().flip.is_finite() && odd.color.unwrap().ssim.is_finite());
    assert_eq!(odd.angular_error_deg.unwrap().max, 0.0);
}

#[test]
fn no_mirror_in_view_gives_null_and_no_division_by_zero() {
    let mut empty = frame();
    layers(&mut empty)
        .status
        .pixels_mut()
        .fill(Status::NotMirror);
    let nothing = compare(&empty, &empty).unwrap();
    assert_eq!(nothing.coverage.mirror_pixels, 0);
    assert_eq!(
        (nothing.coverage.missing, nothing.coverage.extra),
        (None, None)
    );
    assert_eq!(
        (nothing.coverage.cracks, nothing.object_agreement),
        (None, None)
    );
    assert!(nothing.angular_error_deg.is_none() && nothing.color.is_none());
    assert!(nothing.mismatch.is_none() && nothing.regions.image.is_some());
    let text = serde_json::to_string(&nothing).unwrap();
    assert!(text.contains(r#""object_agreement":null"#) && text.contains(r#""color":null"#));
}

#[test]
fn the_record_has_the_agreed_names() {
    let json = serde_json::to_value(with_fault(|_| {})).unwrap();
    let names = |value: &serde_json::Value| -> Vec<String> {
        value.as_object().unwrap().keys().cloned().collect()
    };
    let pieces = [
        (
            &json,
            vec!["coverage", "object_agreement", "angular_error_deg", "color"],
        ),
        (
            &json["angular_error_deg"],
            vec!["mean", "p50", "p95", "p99", "max"],
        ),
        (&json["color"], vec!["mae", "rmse", "psnr", "ssim", "flip"]),
        (
            &json["coverage"],
            vec![
                "mirror_pixels",
                "missing",
                "extra",
                "unresolved",
                "cracks",
                "t_junctions",
            ],
        ),
    ];
    for (piece, agreed) in pieces {
        let names = names(piece);
        assert!(
            agreed.iter().all(|name| names.iter().any(|n| n == name)),
            "{names:?}"
        );
    }
    let text = serde_json::to_string(&json).unwrap();
    assert_eq!(
        serde_json::from_str::<Comparison>(&text).unwrap(),
        with_fault(|_| {})
    );
}

#[test]
fn pictures_that_do_not_belong_together_are_refused() {
    let mut small = frame();
    small.color = Image::filled([3, 3], Vec3::ZERO);
    assert!(matches!(
        compare(&frame(), &small),
        Err(MetricsError::Size { .. })
    ));
    let mut bare = frame();
    bare.reflected = None;
    let error = compare(&frame(), &bare).unwrap_err().to_string();
    assert!(
        error.contains("technique") && error.contains("reflected"),
        "{error}"
    );
    bare.primary = None;
    assert!(
        compare(&bare, &frame())
            .unwrap_err()
            .to_string()
            .contains("reference")
    );
}

#[test]
fn maps_show_the_faults_where_they_are() {
    let mut test = frame();
    cut(&mut test, 20..22, 28..30);
    *layers(&mut test).id.at_mut(32, 8) = 1;
    *layers(&mut test).id.at_mut(30, 30) = 1;
    *layers(&mut test).status.at_mut(32, 6) = Status::Unresolved;
    *test.color.at_mut(32, 20) += 0.3;
    *layers(&mut test).position.at_mut(40, 30) += Vec3::X;
    let map = |kind| error_map(kind, &frame(), &test).unwrap();

    let coverage = map(MapKind::Coverage);
    for (x, y, class) in [
        (20, 28, CoverageClass::Crack),
        (32, 8, CoverageClass::Extra),
        (30, 30, CoverageClass::WrongId),
        (32, 6, CoverageClass::Unresolved),
        (32, 24, CoverageClass::Agree),
    ] {
        assert_eq!(*coverage.at(x, y), f32::from(class as u8), "{class:?}");
    }
    for kind in [MapKind::AbsColor, MapKind::SignedColor] {
        assert!((map(kind).at(32, 20) - 0.3).abs() < 1e-6);
        assert_eq!(*map(kind).at(32, 24), 0.0);
    }
    assert!((map(MapKind::Angular).at(40, 30) - 45.0).abs() < 1e-4);
    assert!(map(MapKind::Angular).at(32, 8).is_nan(), "background");
    assert_eq!(
        (
            *map(MapKind::IdMismatch).at(30, 30),
            *map(MapKind::IdMismatch).at(32, 24)
        ),
        (1.0, 0.0)
    );
    assert!(*map(MapKind::Flip).at(32, 20) > 0.05);
    for kind in [
        MapKind::AbsColor,
        MapKind::Coverage,
        MapKind::Flip,
        MapKind::IdMismatch,
    ] {
        assert!(map(kind).at(0, 0).is_nan(), "outside the mirror");
    }
    let missing = {
        let mut test = frame();
        cut(&mut test, 18..22, 24..26);
        error_map(MapKind::Coverage, &frame(), &test).unwrap()
    };
    assert_eq!(*missing.at(20, 24), f32::from(CoverageClass::Missing as u8));
}
