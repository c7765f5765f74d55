//! Every metric against a slow evaluation in f64 that follows the definition word by word, on dark,
//! bright, flat, huge and tiny values.

use catoptric_frame::{
    Frame, Image, Name, Primary, Reflected, Status, TrueVertex, VertexClass, VertexResult,
    VertexState,
};
use catoptric_metrics::flip::DEFAULT_PIXELS_PER_DEGREE;
use catoptric_metrics::{
    ColorError, Summary, compare, compare_color, temporal, vertex_errors, vertex_report,
};
use glam::{DMat3, DVec2, DVec3, Vec2, Vec3};

const SIZE: [u32; 2] = [19, 14];
const TOLERANCE: f64 = 1e-6;

fn close(what: &str, ours: f64, plain: f64) {
    assert!(
        (ours - plain).abs() <= TOLERANCE * plain.abs(),
        "{what}: {ours} where {plain} is right"
    );
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)))
}

fn image<T>(pixel: impl FnMut((u32, u32)) -> T) -> Image<T> {
    Image::from_vec(SIZE, pixels().map(pixel).collect())
}

fn flat(value: f32) -> Image<Vec3> {
    Image::filled(SIZE, Vec3::splat(value))
}

/// A number from 0 to 1 for a place and a seed.
fn noise(x: u32, y: u32, seed: u32) -> f32 {
    let mixed = (x * 7919 + y * 104_729 + seed * 15_485_863).wrapping_mul(0x9e37_79b9);
    ((mixed ^ (mixed >> 15)).wrapping_mul(0x85eb_ca6b) >> 8) as f32 / 16_777_216.0
}

/// Noise about a gradient, up to a few times `scale`.
fn textured(scale: f32, seed: u32) -> Image<Vec3> {
    image(|(x, y)| {
        let channel = |channel| noise(x, y, seed + channel) + (x + channel * y) as f32 / 20.0;
        scale * Vec3::new(channel(0), channel(1), channel(2))
    })
}

/// A picture with every value changed by a share.
fn times(picture: &Image<Vec3>, factor: f32) -> Image<Vec3> {
    picture.map(|color| factor * *color)
}

fn with_pixel(mut picture: Image<Vec3>, color: Vec3) -> Image<Vec3> {
    *picture.at_mut(8, 6) = color;
    picture
}

/// Pairs of pictures on which sums in f32, differences of large numbers and squares go wrong.
fn pairs() -> Vec<(&'static str, Image<Vec3>, Image<Vec3>)> {
    let middle = textured(0.3, 1);
    let mut pairs = vec![
        ("textures", middle.clone(), textured(0.3, 2)),
        ("nearly equal", middle.clone(), times(&middle, 1.000_001)),
        (
            "another texture on bright",
            textured(100.0, 1),
            textured(100.0, 5),
        ),
        ("negative", times(&middle, -1.0), textured(0.2, 4)),
        (
            "a huge pixel in one",
            middle.clone(),
            with_pixel(middle.clone(), Vec3::splat(1e20)),
        ),
        (
            "a huge pixel in both",
            with_pixel(middle.clone(), Vec3::splat(1e20)),
            with_pixel(textured(0.3, 2), Vec3::splat(1e20)),
        ),
        (
            "the largest and the smallest",
            with_pixel(flat(f32::from_bits(1)), Vec3::splat(f32::MAX)),
            with_pixel(flat(0.0), Vec3::splat(f32::MIN)),
        ),
        (
            "a small texture on a large value",
            image(|(x, y)| Vec3::splat(1000.0 + noise(x, y, 1))),
            image(|(x, y)| Vec3::splat(1000.0 + noise(x, y, 2))),
        ),
    ];
    for (name, scale) in [
        ("dark", 1e-4),
        ("darker", 1e-9),
        ("tiny", 1e-30),
        ("not normal", 1e-40),
        ("bright", 100.0),
        ("huge", 1e20),
        ("close to the largest", 1e37),
    ] {
        let texture = textured(scale, 1);
        pairs.push((name, texture.clone(), times(&texture, 1.001)));
    }
    for (a, b) in [
        (100.0, 100.1),
        (10.0, 10.01),
        (0.6, 0.600_000_1),
        (0.0, 1.0),
        (1e-7, 1.1e-7),
        (1e20, 1.000_001e20),
        (-1.0, 1.0),
    ] {
        pairs.push(("flat", flat(a), flat(b)));
    }
    pairs
}

#[test]
fn colour_errors() {
    let masks = [image(|_| true), image(|(x, y)| x > 3 && y % 3 != 1)];
    for (name, reference, test) in pairs() {
        for mask in &masks {
            let ours = compare_color(&reference, &test, mask, DEFAULT_PIXELS_PER_DEGREE);
            let (ours, plain) = (ours.unwrap().unwrap(), plain_color(&reference, &test, mask));
            let numbers = |color: &ColorError| {
                let ColorError {
                    mae,
                    rmse,
                    psnr,
                    ssim,
                    flip,
                    rel_mse,
                    mrse,
                    ..
                } = *color;
                let psnr = psnr.unwrap_or(f64::MAX);
                [mae, rmse, psnr, ssim, flip, rel_mse, mrse]
            };
            let names = ["mae", "rmse", "psnr", "ssim", "flip", "rel_mse", "mrse"];
            for ((metric, ours), plain) in names.iter().zip(numbers(&ours)).zip(numbers(&plain)) {
                close(&format!("{name}, {metric}"), ours, plain);
            }
            assert!(
                ours.ssim <= 1.0 && (0.0..=1.0).contains(&ours.flip),
                "{name}: {ours:?}"
            );
            assert!(!ours.equal && ours.left_out == 0, "{name}");
        }
    }
}

#[test]
fn equal_pictures_have_the_best_value_of_each() {
    let mask = image(|_| true);
    let pictures = pairs()
        .into_iter()
        .flat_map(|(name, a, b)| [(name, a), (name, b)]);
    for (name, picture) in pictures {
        let color = compare_color(&picture, &picture, &mask, DEFAULT_PIXELS_PER_DEGREE);
        let best = ColorError {
            mae: 0.0,
            rmse: 0.0,
            psnr: None,
            equal: true,
            ssim: 1.0,
            flip: 0.0,
            rel_mse: 0.0,
            mrse: 0.0,
            left_out: 0,
        };
        assert_eq!(color.unwrap(), Some(best), "{name}");
    }
}

fn plain_color(reference: &Image<Vec3>, test: &Image<Vec3>, mask: &Image<bool>) -> ColorError {
    let (ssim, flip) = (plain_ssim(reference, test), plain_flip(reference, test));
    let mean = |of: &dyn Fn(usize) -> f64| {
        let kept = (0..mask.pixels().len()).filter(|&index| mask.pixels()[index]);
        kept.clone().map(of).sum::<f64>() / kept.count() as f64
    };
    let channels = |of: &dyn Fn(f64, f64) -> f64| {
        mean(&|index| {
            let [f, t] = [reference, test].map(|image| image.pixels()[index].to_array());
            let channel = |channel: usize| of(f64::from(f[channel]), f64::from(t[channel]));
            (channel(0) + channel(1) + channel(2)) / 3.0
        })
    };
    let mse = channels(&|f, t| (t - f).powi(2));
    ColorError {
        mae: channels(&|f, t| (t - f).abs()),
        rmse: mse.sqrt(),
        psnr: Some(10.0 * (1.0 / mse).log10()),
        equal: false,
        ssim: mean(&|index| ssim[index]),
        flip: mean(&|index| flip[index]),
        rel_mse: channels(&|f, t| (t - f).powi(2) / (f * f + 0.01)),
        mrse: channels(&|f, t| (t - f).powi(2) / (f.max(0.0) + 0.01).powi(2)),
        left_out: 0,
    }
}

/// The pixel at an offset from another; beyond the border the nearest.
fn beside(image: &[DVec3], (x, y): (u32, u32), (dx, dy): (i32, i32)) -> DVec3 {
    let at = |place: u32, offset: i32, side: u32| (place as i32 + offset).clamp(0, side as i32 - 1);
    image[(at(y, dy, SIZE[1]) * SIZE[0] as i32 + at(x, dx, SIZE[0])) as usize]
}

fn offsets(radius: i32) -> impl Iterator<Item = (i32, i32)> {
    (-radius..=radius).flat_map(move |dy| (-radius..=radius).map(move |dx| (dx, dy)))
}

fn doubles(image: &Image<Vec3>) -> Vec<DVec3> {
    image
        .pixels()
        .iter()
        .map(|color| color.as_dvec3())
        .collect()
}

/// Variances and the covariance as means over all pairs of pixels in the window, which need no mean.
fn plain_ssim(reference: &Image<Vec3>, test: &Image<Vec3>) -> Vec<f64> {
    let luma = DVec3::new(0.2126, 0.7152, 0.0722);
    let images = [doubles(reference), doubles(test)];
    let gaussian = |(dx, dy): (i32, i32)| (-f64::from(dx * dx + dy * dy) / (2.0 * 2.25)).exp();
    let sum: f64 = offsets(5).map(gaussian).sum();
    let similarity = |at: (u32, u32)| {
        let window: Vec<(f64, [f64; 2])> = offsets(5)
            .map(|offset| {
                let value = |image: &[DVec3]| beside(image, at, offset).dot(luma);
                let values = [value(&images[0]), value(&images[1])];
                (gaussian(offset) / sum, values)
            })
            .collect();
        let mean = |image: usize| {
            window
                .iter()
                .map(|(w, value)| w * value[image])
                .sum::<f64>()
        };
        let covariance = |a: usize, b: usize| {
            let mut sum = 0.0;
            for (w, value) in &window {
                for (v, other) in &window {
                    sum += w * v * (value[a] - other[a]) * (value[b] - other[b]);
                }
            }
            0.5 * sum
        };
        let (mx, my, c1, c2) = (mean(0), mean(1), 0.01_f64.powi(2), 0.03_f64.powi(2));
        (2.0 * mx * my + c1) / (mx * mx + my * my + c1) * (2.0 * covariance(0, 1) + c2)
            / (covariance(0, 0) + covariance(1, 1) + c2)
    };
    pixels().map(similarity).collect()
}

/// FLIP by sums over the whole window of each filter.
fn plain_flip(reference: &Image<Vec3>, test: &Image<Vec3>) -> Vec<f64> {
    let ppd = f64::from(DEFAULT_PIXELS_PER_DEGREE);
    let matrix = DMat3::from_cols_array(&[
        10_135_552.0 / 24_577_794.0,
        871_024.0 / 4_096_299.0,
        79_184.0 / 4_096_299.0,
        8_788_810.0 / 24_577_794.0,
        8_788_810.0 / 12_288_897.0,
        4_394_405.0 / 36_866_691.0,
        4_435_075.0 / 24_577_794.0,
        887_015.0 / 12_288_897.0,
        70_074_185.0 / 73_733_382.0,
    ]);
    let white = matrix * DVec3::ONE;
    let displayed = |image: &Image<Vec3>| -> Vec<DVec3> {
        let clamped = doubles(image).into_iter();
        clamped
            .map(|color| matrix * color.clamp(DVec3::ZERO, DVec3::ONE) / white)
            .collect()
    };
    let images = [displayed(reference), displayed(test)];

    // Contrast sensitivity: of Y, X − Y and Y − Z, relative to white.
    let pi = std::f64::consts::PI;
    let gaussian = |a: f64, b: f64, (dx, dy): (i32, i32)| {
        let x2 = f64::from(dx * dx + dy * dy) / (ppd * ppd);
        a * (pi / b).sqrt() * (-pi * pi * x2 / b).exp()
    };
    let sensitivity = |offset: (i32, i32)| {
        DVec3::new(
            gaussian(1.0, 0.0047, offset),
            gaussian(1.0, 0.0053, offset),
            gaussian(34.1, 0.04, offset) + gaussian(13.5, 0.025, offset),
        )
    };
    let radius = (3.0 * (0.04 / (2.0 * pi * pi)).sqrt() * ppd).ceil() as i32;
    let sum: DVec3 = offsets(radius).map(sensitivity).sum();
    let cie = |t: f64| {
        let delta = 6.0_f64 / 29.0;
        let above = |t: f64| t.cbrt() - 4.0 / 29.0;
        if t > delta.powi(3) {
            above(t)
        } else {
            t / (3.0 * delta * delta)
        }
    };
    let lab = |xyz: DVec3| {
        let [x, y, z] = xyz.to_array().map(cie);
        let lightness = 116.0 * y;
        DVec3::new(
            lightness,
            0.01 * lightness * 500.0 * (x - y),
            0.01 * lightness * 200.0 * (y - z),
        )
    };
    let seen = |image: &[DVec3], at: (u32, u32)| {
        let weighted = |offset| {
            let DVec3 { x, y, z } = beside(image, at, offset);
            sensitivity(offset) / sum * DVec3::new(y, x - y, y - z)
        };
        let DVec3 {
            x: y,
            y: red_green,
            z: blue_yellow,
        } = offsets(radius).map(weighted).sum();
        let xyz = DVec3::new(y + red_green, y, y - blue_yellow) * white;
        let linear = (matrix.inverse() * xyz).clamp(DVec3::ZERO, DVec3::ONE);
        lab(matrix * linear / white)
    };
    let hyab = |a: DVec3, b: DVec3| {
        let d = a - b;
        d.x.abs() + (d.y * d.y + d.z * d.z).sqrt()
    };

    // Features: first and second derivatives of a Gaussian, weights of either sign adding up to 1.
    let sigma = 0.5 * 0.082 * ppd;
    let reach = (3.0 * sigma).ceil() as i32;
    let bell = |x: f64| (-x * x / (2.0 * sigma * sigma)).exp();
    let derivative = |order: i32, x: f64| match order {
        1 => -x * bell(x),
        _ => (x * x / (sigma * sigma) - 1.0) * bell(x),
    };
    let kernel = |order: i32, (along, across): (i32, i32)| {
        let weight = |(along, across): (i32, i32)| {
            derivative(order, f64::from(along)) * bell(f64::from(across))
        };
        let here = weight((along, across));
        let alike = offsets(reach)
            .map(weight)
            .filter(|other| other * here > 0.0);
        let sum: f64 = alike.map(f64::abs).sum();
        if sum > 0.0 { here / sum } else { 0.0 }
    };
    let kernels: Vec<[f64; 4]> = offsets(reach)
        .map(|(dx, dy)| {
            [
                kernel(1, (dx, dy)),
                kernel(1, (dy, dx)),
                kernel(2, (dx, dy)),
                kernel(2, (dy, dx)),
            ]
        })
        .collect();
    let features = |image: &[DVec3], at: (u32, u32)| {
        let mut sums = [0.0; 4];
        for (offset, weights) in offsets(reach).zip(&kernels) {
            let achromatic = beside(image, at, offset).y;
            for (sum, weight) in sums.iter_mut().zip(weights) {
                *sum += weight * achromatic;
            }
        }
        [sums[0].hypot(sums[1]), sums[2].hypot(sums[3])]
    };

    let largest = hyab(
        lab(matrix * DVec3::Y / white),
        lab(matrix * DVec3::Z / white),
    )
    .powf(0.7);
    let error = |at| {
        let color = hyab(seen(&images[0], at), seen(&images[1], at)).powf(0.7);
        let knee = 0.4 * largest;
        let color = if color < knee {
            0.95 * color / knee
        } else {
            0.95 + 0.05 * (color - knee) / (largest - knee)
        };
        let [a, b] = [features(&images[0], at), features(&images[1], at)];
        let feature = (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) / 2.0_f64.sqrt();
        color.powf(1.0 - feature.sqrt())
    };
    pixels().map(error).collect()
}

/// Mean and interpolated percentiles, over ranks.
fn plain_summary(samples: &[f64]) -> Summary {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = share * (sorted.len() - 1) as f64;
        let (below, part) = (place as usize, place.fract());
        let above = sorted[(below + 1).min(sorted.len() - 1)];
        (1.0 - part) * sorted[below] + part * above
    };
    Summary {
        mean: sorted
            .iter()
            .map(|sample| sample / sorted.len() as f64)
            .sum(),
        p50: at(0.5),
        p95: at(0.95),
        p99: at(0.99),
        max: at(1.0),
    }
}

fn summaries_close(what: &str, ours: &Summary, samples: &[f64]) {
    let plain = plain_summary(samples);
    for (name, ours, plain) in [
        ("mean", ours.mean, plain.mean),
        ("p50", ours.p50, plain.p50),
        ("p95", ours.p95, plain.p95),
        ("p99", ours.p99, plain.p99),
        ("max", ours.max, plain.max),
    ] {
        close(&format!("{what}, {name}"), ours, plain);
    }
}

/// Everything is mirror; ids and hit points as given.
fn frame(id: impl Fn((u32, u32)) -> u32, hit: impl Fn((u32, u32)) -> Vec3) -> Frame {
    Frame {
        color: flat(0.5),
        primary: Some(Primary {
            id: Image::filled(SIZE, 9),
            position: Image::filled(SIZE, Vec3::new(0.1, -0.2, 0.3)),
            normal: Image::filled(SIZE, Vec3::Z),
        }),
        reflected: Some(Reflected {
            status: Image::filled(SIZE, Status::Resolved),
            id: image(&id),
            position: image(&hit),
            distance: Image::filled(SIZE, 1.0),
            bounces: None,
        }),
        motion: None,
        names: vec![Name {
            id: 9,
            name: "mirror".into(),
            mirror: true,
        }],
    }
}

#[test]
fn angles() {
    let hit = |scale: f32, seed: u32| {
        move |(x, y): (u32, u32)| {
            let direction = [0, 1, 2].map(|axis| noise(x, y, 10 + axis) - 0.5);
            let moved = [0, 1, 2].map(|axis| noise(x, y, seed + axis) - 0.5);
            scale * (Vec3::from(direction) + 1e-5 * Vec3::from(moved))
        }
    };
    for scale in [1e-6, 1.0, 1e6, 1e30] {
        let [a, b] = [20, 30].map(|seed| frame(|_| 1, hit(scale, seed)));
        let angle = |index: usize| {
            let point = a.primary.as_ref().unwrap().position.pixels()[index].as_dvec3();
            let [a, b] = [&a, &b].map(|frame| {
                let hits = &frame.reflected.as_ref().unwrap().position;
                hits.pixels()[index].as_dvec3() - point
            });
            // The way from one hit to the other, less its part along the ray.
            let (ray, way) = (a.normalize(), b - a);
            let across = (way - ray * way.dot(ray)).length();
            across.atan2(b.dot(ray)).to_degrees()
        };
        let angles: Vec<f64> = (0..a.color.pixels().len()).map(angle).collect();
        let ours = compare(&a, &b).unwrap().angular_error_deg.unwrap();
        summaries_close(&format!("angles at {scale}"), &ours, &angles);
        let same = compare(&a, &a).unwrap().angular_error_deg.unwrap();
        assert_eq!((same.mean, same.max), (0.0, 0.0));
    }
}

#[test]
fn edge_offsets() {
    let blob = |middle: f32| {
        move |(x, y): (u32, u32)| {
            let inside = (x as f32 - middle).hypot(y as f32 - 6.0) < 4.0 + noise(x, y, 3);
            1 + u32::from(inside)
        }
    };
    let ids = [blob(7.0), blob(10.0)];
    let points = ids.map(|id| -> Vec<DVec2> {
        let place = |x: u32, y: u32| DVec2::new(f64::from(x), f64::from(y));
        let right = pixels()
            .filter(move |&(x, y)| x + 1 < SIZE[0] && id((x, y)) != id((x + 1, y)))
            .map(move |(x, y)| place(x, y) + DVec2::new(1.0, 0.5));
        let below = pixels()
            .filter(move |&(x, y)| y + 1 < SIZE[1] && id((x, y)) != id((x, y + 1)))
            .map(move |(x, y)| place(x, y) + DVec2::new(0.5, 1.0));
        right.chain(below).collect()
    });
    // An object reaches the mirror's outline only where the mirror ends, and here it does not.
    let nearest = |to: &DVec2, points: &[DVec2]| {
        let distances = points.iter().map(|point| point.distance(*to));
        distances.fold(f64::INFINITY, f64::min)
    };
    let there = points[0].iter().map(|point| nearest(point, &points[1]));
    let back = points[1].iter().map(|point| nearest(point, &points[0]));
    let offsets: Vec<f64> = there.chain(back).collect();
    let [a, b] = ids.map(|id| frame(id, |_| Vec3::ONE));
    let ours = compare(&a, &b).unwrap().edge_offset_px.unwrap();
    summaries_close("edges", &ours, &offsets);
}

#[test]
fn offsets_and_jitter() {
    for scale in [1e-3_f32, 1.0, 1e4, 1e30] {
        let place = |vertex: u32, seed| {
            let at = Vec2::new(noise(vertex, 1, seed), noise(vertex, 2, seed));
            scale * at
        };
        let vertices = 40;
        let truth: Vec<TrueVertex> = (0..vertices)
            .map(|vertex| TrueVertex {
                class: VertexClass::Reflected,
                points: vec![(DVec3::ZERO, Some(place(vertex, 1).as_dvec2()))],
                focal: vec![None],
                undecided: 0,
            })
            .collect();
        let frames: Vec<Vec<VertexResult>> = (2..5)
            .map(|seed| {
                let result = |vertex| VertexResult {
                    object: 1,
                    vertex,
                    mirror: 2,
                    state: VertexState::Found,
                    at: place(vertex, seed),
                    steps: 0,
                    evaluations: 0,
                    node_tests: 0,
                    hole: None,
                    enlarged: None,
                    stand_in: false,
                };
                (0..vertices).map(result).collect()
            })
            .collect();
        let error = |frame: u32, vertex: u32| {
            let [x, y] = [0, 1].map(|axis| {
                let found = f64::from(place(vertex, frame)[axis]);
                found - f64::from(place(vertex, 1)[axis])
            });
            [x, y]
        };
        let length = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();

        let offsets: Vec<f64> = (0..vertices)
            .map(|vertex| length(error(2, vertex)))
            .collect();
        let report = vertex_report(&frames[0], &truth, |_, _| true).unwrap();
        summaries_close("offsets", &report.offset_px.unwrap(), &offsets);
        let over = offsets.iter().filter(|offset| **offset > 2.0).count();
        let share = report.offset_share.unwrap().over_2;
        close(
            "share of offsets",
            share,
            over as f64 / offsets.len() as f64,
        );

        let errors: Vec<Vec<Option<DVec2>>> = frames
            .iter()
            .map(|results| vertex_errors(results, &truth, |_, _| true).unwrap())
            .collect();
        let changes: Vec<f64> = (2..4)
            .flat_map(|frame| (0..vertices).map(move |vertex| (frame, vertex)))
            .map(|(frame, vertex)| {
                let [a, b] = [error(frame, vertex), error(frame + 1, vertex)];
                length([b[0] - a[0], b[1] - a[1]])
            })
            .collect();
        let (jitter, plain) = (
            temporal(&errors).jitter_px.unwrap(),
            plain_summary(&changes),
        );
        close("jitter, mean", jitter.mean, plain.mean);
        close("jitter, p99", jitter.p99, plain.p99);
        close("jitter, max", jitter.max, plain.max);
    }
}

#[test]
fn of_several_answers_those_that_are_found_are_judged() {
    let answer = |state, x| VertexResult {
        object: 1,
        vertex: 0,
        mirror: 2,
        state,
        at: Vec2::new(x, 0.0),
        steps: 0,
        evaluations: 0,
        node_tests: 0,
        hole: None,
        enlarged: None,
        stand_in: false,
    };
    let truth = [TrueVertex {
        class: VertexClass::Reflected,
        points: [1.0, 5.0]
            .map(|x| (DVec3::ZERO, Some(DVec2::new(x, 0.0))))
            .to_vec(),
        focal: vec![Some(0), Some(2)],
        undecided: 3,
    }];
    let report = |results: &[VertexResult]| vertex_report(results, &truth, |_, _| true).unwrap();
    // One of two solutions, a quarter of a pixel off; the sheet without an image says nothing.
    let found = report(&[
        answer(VertexState::Found, 1.25),
        answer(VertexState::Hidden, 90.0),
    ]);
    assert_eq!((found.searched, found.recall), (1, Some(0.5)));
    assert_eq!(found.offset_px.unwrap().max, 0.25);
    assert_eq!(
        (found.failed, found.discard.unwrap().false_drop),
        (Some(0), 0)
    );
    // Both, on two sheets.
    let found = report(&[
        answer(VertexState::Found, 1.0),
        answer(VertexState::Found, 5.5),
    ]);
    assert_eq!(
        (found.recall, found.offset_px.unwrap().max),
        (Some(1.0), 0.5)
    );
    // An answer to nothing, beside one of the two.
    let found = report(&[
        answer(VertexState::Found, 5.5),
        answer(VertexState::Found, 90.0),
    ]);
    let solutions = found.solutions.unwrap();
    assert_eq!(
        (solutions.existing, solutions.found, solutions.spurious),
        (2, 1, 1)
    );
    let by_k = solutions.by_k.unwrap();
    assert_eq!(
        [by_k.k0, by_k.k1, by_k.k2].map(|of| (of.existing, of.found)),
        [(1, 0), (0, 0), (1, 1)]
    );
    assert_eq!(found.undecided, Some(3));
    // Where none is found, what is called hidden or unreflected is what there is.
    let dropped = report(&[
        answer(VertexState::Unreflected, 7.0),
        answer(VertexState::Failed, 1.0),
    ]);
    assert_eq!(
        (dropped.recall, dropped.offset_px.unwrap().max),
        (Some(0.0), 2.0)
    );
    assert_eq!(dropped.discard.unwrap().false_drop, 1);
}
