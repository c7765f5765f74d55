//! Benchmarks of the reference: hierarchy, rays, exact reflection points.

fn main() {}
