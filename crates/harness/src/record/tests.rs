//! Records for tests of whatever reads records.

use catoptric_frame::{Triangles, Work};
use catoptric_metrics::{
    ColorError, Coverage, Discard, FoundCount, Jitter, MirrorMotion, Mismatch, More, MotionError,
    MotionPart, MotionPicture, NonFinite, OffsetShare, PairedDifference, Region, Regions,
    SolutionCount, SolutionsByK, Summary, Temporal, Timing, TrueMotion, VertexReport,
};
use serde_json::{Value, json};

use super::row::*;
use super::{metrics, read, schema, write};

const SUMMARY: Summary = Summary {
    mean: 0.5,
    p50: 0.25,
    p95: 1.0,
    p99: 2.0,
    max: 4.0,
};

fn meta() -> Meta {
    Meta {
        command: "catoptric compare a-scene -t linear".to_owned(),
        revision: Some("0123456789ab".to_owned()),
        version: "0.1.0".to_owned(),
        date: "2026-01-02T03:04:05Z".to_owned(),
        scene_hash: Some("abcdef".to_owned()),
        scene_why: Some("For tests.".to_owned()),
        bounces: 8,
        time_budget_s: Some(6.0),
        part: Some("1/2".to_owned()),
        notes: Vec::new(),
    }
}

/// A row in which nothing is null that need not be.
pub fn measured(scene: &str, technique: &str) -> Record {
    let color = ColorError {
        mae: 0.1,
        rmse: 0.2,
        psnr: Some(30.0),
        equal: false,
        ssim: 0.9,
        flip: 0.05,
        rel_mse: 0.1,
        mrse: 0.1,
        left_out: 0,
    };
    let motion_part = || MotionPart {
        pixels: 10,
        missing: Some(0.0),
        error_px: Some(SUMMARY),
    };
    let region = || Region {
        mirror_pixels: 10,
        object_agreement: Some(0.9),
        angular_error_deg: Some(SUMMARY),
        color: Some(color),
    };
    Record {
        adapter: Some(Adapter {
            name: "test adapter".to_owned(),
            driver: "none 1.0".to_owned(),
            backend: "Vulkan".to_owned(),
            software: true,
        }),
        coverage: Some(Coverage {
            mirror_pixels: 102_872,
            missing: Some(0.011),
            extra: Some(0.0),
            unresolved: Some(0.0),
            cracks: Some(0),
            crack_pixels: Some(0),
            widest_crack_px: Some(0),
            holes: Some(0),
            t_junctions: Some(0),
            below: 0,
            mirror_only_reference: 0,
            mirror_only_test: 0,
            iou: Some(0.98),
        }),
        object_agreement: Some(0.981),
        angular_error_deg: Some(SUMMARY),
        edge_offset_px: Some(SUMMARY),
        pixel_angle_deg: Some(SUMMARY),
        color: Some(color),
        vertices: Some(VertexReport {
            searched: 100,
            reflected: Some(60),
            hidden: Some(30),
            failed: Some(0),
            non_finite: 0,
            recall: Some(0.95),
            solutions: Some(SolutionCount {
                existing: 80,
                found: 76,
                spurious: 3,
                by_k: Some(SolutionsByK {
                    k0: FoundCount {
                        existing: 50,
                        found: 48,
                    },
                    k1: FoundCount {
                        existing: 10,
                        found: 9,
                    },
                    k2: FoundCount {
                        existing: 20,
                        found: 19,
                    },
                }),
            }),
            undecided: Some(0),
            hole: Some(0),
            enlarged: Some(0),
            offset_px: Some(SUMMARY),
            offset_share: Some(OffsetShare {
                over_0_71: 0.1,
                over_2: 0.0,
                over_5: 0.0,
            }),
            discard: Some(Discard {
                false_keep: 1,
                false_drop: 2,
            }),
        }),
        triangles: Some(Triangles {
            input: 2,
            drawn: 128,
            by_level: vec![0, 0, 0, 128],
            unfinished: 0,
        }),
        work: Some(Work {
            total: Some(400.5),
            evaluations: Some(400.5),
            steps: Some(99.0),
            node_tests: Some(0.0),
            samples: Some(0.0),
            skips: Some(0.0),
            cluster_tests: Some(0.0),
            pairs: Some(0.0),
            longest_list: Some(0.0),
            bytes: Some(0.0),
        }),
        resolved_by: Some(vec![0.9, 0.1]),
        motion: Some(MotionError {
            pairs: 1,
            pixels: 20,
            missing: Some(0.0),
            error_px: Some(SUMMARY),
            true_px: Some(TrueMotion { p50: 2.0, p99: 4.0 }),
            rim: motion_part(),
            interior: motion_part(),
            mirrors: vec![MirrorMotion {
                name: "mirror".to_owned(),
                pixels: 20,
                missing: Some(0.0),
                error_px: Some(SUMMARY),
            }],
            picture: Some(MotionPicture {
                flip: 0.1,
                flip_true: 0.05,
                excess: 0.05,
            }),
        }),
        temporal: Some(Steadiness {
            points: Temporal {
                frames: 10,
                jitter_px: Some(Jitter {
                    mean: 0.1,
                    p99: 0.5,
                    max: 1.0,
                }),
                jumps: Some(0.0),
            },
            object_agreement_min: Some(0.9),
            crack_pixels_max: Some(3),
            t_junctions_max: Some(2),
            triangles_changed: Some(1.5),
            frame_ms: Some(1.0),
            still_ms: Some(1.0),
            added_ms: Some(PairedDifference {
                median: 0.1,
                low: -0.1,
                high: 0.2,
                significant: false,
            }),
            evaluations: Some(5.0),
            steps: Some(1.0),
            moved_node_tests: Some(3.0),
        }),
        against_full: Some(AgainstFull {
            object_agreement: Some(0.97),
            angular_error_deg: Some(SUMMARY),
        }),
        time_ms: Some(Times {
            prepare: 12.0,
            exact_points: Some(30.0),
            frame: Timing::of(&[4.0, 5.0, 6.0]),
            passes: Some(vec![
                ("gbuffer".to_owned(), 1.0),
                ("search".to_owned(), 4.0),
            ]),
            passes_reason: None,
            build: Timing::of(&[1.0, 2.0]),
            own: Timing::of(&[3.0, 4.0, 5.0]),
            wall: Wall { median: 6.0 },
        }),
        mismatch: Some(Mismatch {
            boundary: 0.015,
            interior: 0.004,
        }),
        non_finite: Some(NonFinite::default()),
        regions: Some(Regions {
            image: Some(color),
            rim: region(),
            interior: region(),
        }),
        more: Some(More::default()),
        raw: Some(Raw {
            frame_ms: vec![4.0, 5.0, 6.0],
            wall_ms: vec![5.0, 6.0, 7.0],
        }),
        ..Record::empty(scene, technique, [640, 480], meta())
    }
}

/// A row without numbers.
pub fn blank(scene: &str, technique: &str) -> Record {
    measured(scene, technique).without(Status::NotApplicable, "no such model")
}

/// The record as the design gives it; numbers stand for any number or null.
fn design() -> Value {
    let summary = json!({ "mean": 0, "p50": 0, "p95": 0, "p99": 0, "max": 0 });
    json!({
        "schema_version": 1,
        "scene": "", "technique": "", "resolution": [640, 480], "truth": "first-bounce",
        "status": "ok", "reason": null,
        "adapter": { "name": "", "driver": "", "backend": "", "software": true },
        "coverage": { "mirror_pixels": 0, "missing": 0, "extra": 0, "unresolved": null, "cracks": 0, "t_junctions": 0 },
        "object_agreement": 0,
        "angular_error_deg": summary,
        "color": { "mae": 0, "rmse": 0, "psnr": 0, "ssim": 0, "flip": 0 },
        "vertices": { "searched": 0, "reflected": 0, "hidden": 0, "failed": 0, "recall": 0, "hole": null,
                      "solutions": { "true": 0, "found": 0, "spurious": 0 },
                      "enlarged": null, "offset_px": summary },
        "triangles": { "in": 2, "drawn": 128, "by_level": [0], "unfinished": 0 },
        "work": { "evaluations": 0, "steps": 0, "node_tests": 0, "samples": 0, "skips": 0 },
        "temporal": { "frames": 0, "jitter_px": { "mean": 0, "p99": 0, "max": 0 }, "jumps": 0,
                      "object_agreement_min": 0 },
        "motion": { "pixels": 0, "missing": 0.0, "error_px": summary, "true_px": { "p50": 0, "p99": 0 } },
        "against_full": { "object_agreement": 0, "angular_error_deg": summary },
        "time_ms": { "prepare": 0, "frame": { "median": 0, "mad": 0, "p5": 0, "p95": 0, "samples": 0 },
                     "passes": { "gbuffer": 0, "search": 0 }, "wall": { "median": 0 } },
    })
}

/// Every path of `wanted` that `value` lacks.
fn lacking(wanted: &Value, value: &Value, path: &str, missing: &mut Vec<String>) {
    for (name, inner) in wanted.as_object().into_iter().flatten() {
        let path = format!("{path}.{name}");
        match value.get(name) {
            None => missing.push(path),
            Some(found) => lacking(inner, found, &path, missing),
        }
    }
}

#[test]
fn no_field_of_the_design_is_missing() {
    let mut missing = Vec::new();
    lacking(&design(), &measured("s", "t").to_value(), "", &mut missing);
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn a_missing_field_is_noticed() {
    let mut row = measured("s", "t").to_value();
    row["vertices"]["offset_px"]
        .as_object_mut()
        .unwrap()
        .remove("p99");
    let mut missing = Vec::new();
    lacking(&design(), &row, "", &mut missing);
    assert_eq!(missing, [".vertices.offset_px.p99"]);
    assert!(!schema::violations(&schema::records(), &json!([row])).is_empty());
}

#[test]
fn records_keep_to_the_schema() {
    let rows = [measured("s", "t"), blank("s", "u")];
    let written = serde_json::to_value(&rows).unwrap();
    assert_eq!(
        schema::violations(&schema::records(), &written),
        Vec::<String>::new()
    );
    let printed = Value::Array(rows.iter().map(Record::to_value).collect());
    assert_eq!(
        schema::violations(&schema::records(), &printed),
        Vec::<String>::new()
    );
    assert!(printed[0].get("raw").is_none() && written[0].get("raw").is_some());
}

#[test]
fn the_schema_knows_every_field_of_the_design() {
    let mut missing = Vec::new();
    for (path, value) in super::path::leaves(&design()) {
        let pass = path.starts_with("time_ms.passes.");
        if value.is_number() && path != "schema_version" && !pass && metrics::at(&path).is_none() {
            missing.push(path);
        }
    }
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn rows_without_numbers_have_null_and_a_reason() {
    let row = blank("s", "t").to_value();
    assert_eq!(
        (&row["status"], &row["reason"]),
        (&json!("not-applicable"), &json!("no such model"))
    );
    for name in [
        "coverage",
        "object_agreement",
        "color",
        "vertices",
        "triangles",
        "work",
        "time_ms",
    ] {
        assert!(row[name].is_null(), "{name}");
    }
}

#[test]
fn a_written_record_is_read_again_and_nothing_else_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("record.json");
    write(&[measured("s", "t")], &path).unwrap();
    assert_eq!(read(&path).unwrap()[0]["scene"], "s");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    for text in ["", "{}", "[{}]", "[1]"] {
        std::fs::write(&path, text).unwrap();
        assert!(
            read(&path).unwrap_err().to_string().contains("record.json"),
            "{text}"
        );
    }
}
