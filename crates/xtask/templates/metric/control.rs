//! Control of `more.template_name`.

use super::support::{cut, mirror_pixels, with_fault};

#[test]
fn template_name_notices_what_is_cut_out() {
    let same = with_fault(|_| {}).more.template_name.expect("a mirror");
    // TEMPLATE: a known fault, and by how much it must trip the metric.
    let mut lost = 0.0;
    let cut = with_fault(|frame| lost = cut(frame, 30..32, 28..30));
    let share = cut.more.template_name.expect("a mirror");
    assert!((same - share - lost / mirror_pixels()).abs() < 1e-12);
}
