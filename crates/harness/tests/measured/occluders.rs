//! What stands before a mirror hides pixels of the picture, not texels of the search.

use crate::support::{gpu_or_skip, measured, number};

#[test]
fn walks_end_at_outlines_only_on_maps_that_are_cut() {
    if !gpu_or_skip() {
        return;
    }
    let techniques = ["linear", "linear(occluders=cut)"];
    let rows = measured(&["sphere-touching"], &techniques, None, 0.1);
    let [whole, cut] = rows.as_slice() else {
        panic!("{} rows", rows.len())
    };
    let missing = |row| number(row, "/coverage/missing");
    let offset = |row| number(row, "/vertices/offset_px/mean");
    assert!(missing(whole) <= 0.03, "{whole}");
    assert!(offset(whole) < 1.5, "{whole}");
    // As measured before there were whole maps: 26.7 % and 54 pixels.
    assert!((missing(cut) - 0.267).abs() < 0.01, "{cut}");
    assert!((offset(cut) - 54.0).abs() < 2.0, "{cut}");
}

#[test]
fn a_mirror_before_another_cuts_nothing_either() {
    if !gpu_or_skip() {
        return;
    }
    let techniques = ["linear", "linear(occluders=cut)"];
    let rows = measured(&["spheres"], &techniques, Some([320, 240]), 0.1);
    let [whole, cut] = rows.as_slice() else {
        panic!("{} rows", rows.len())
    };
    let offset = |row| number(row, "/vertices/offset_px/mean");
    assert!(
        offset(whole) < 1.0 && offset(whole) < offset(cut),
        "{rows:#?}"
    );
}
