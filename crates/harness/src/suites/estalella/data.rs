//! What the figures share: techniques.

/// The search as the paper runs it: hidden vertices continued, true virtual depth.
pub fn search(iterations: u32) -> String {
    format!("reflector-cubemap(iterations={iterations},hidden=extend,depth=virtual)")
}

/// With so many per cent of a mesh's vertices in its grid.
pub fn with_grid(iterations: u32, percent: f64) -> String {
    let fraction = (percent * 10.0).round() / 1000.0;
    format!("{}+grid(fraction={fraction})", search(iterations))
}
