//! `catoptric claims`: the papers' claims by recorded runs.

use crate::support::{catoptric, code, json, refused, stdout};

const RECORD: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../results/2026-12-01-llvmpipe/record.json"
);

#[test]
fn every_claim_has_a_row_and_none_a_verdict_that_nothing_measured() {
    let output = catoptric(&["claims", RECORD, "--format", "json"]);
    assert_eq!(code(&output), 0);
    let rows = json(&output);
    let rows = rows.as_array().expect("an array");
    assert!(rows.len() > 150, "{}", rows.len());
    for row in rows {
        let text = |name: &str| row[name].as_str().unwrap_or_default();
        for name in ["paper", "section", "claim", "why"] {
            assert!(!text(name).is_empty(), "{name}: {row}");
        }
        // The report measures no figure of a suite as a whole.
        assert!(
            ["not-measured", "not-judged"].contains(&text("verdict")),
            "{row}"
        );
    }
    let table = catoptric(&["claims", RECORD]);
    assert!(stdout(&table).starts_with("paper "));
}

#[test]
fn the_table_is_put_between_its_markers() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = folder.path().join("README.md");
    let [begin, end] = ["<!-- claims: begin -->", "<!-- claims: end -->"];
    std::fs::write(&text, format!("a\n{begin}\nold\n{end}\nb\n")).expect("a file");
    let path = text.to_str().expect("UTF-8");
    assert_eq!(code(&catoptric(&["claims", RECORD, "--into", path])), 0);
    let made = std::fs::read_to_string(&text).expect("a file");
    assert!(
        made.starts_with(&format!("a\n{begin}\nOf ")) && made.ends_with(&format!("{end}\nb\n"))
    );
    assert!(made.contains("| paper ") && !made.contains("\nold\n"));
    std::fs::write(&text, "no markers\n").expect("a file");
    assert!(refused(&["claims", RECORD, "--into", path]).contains(begin));
    assert!(refused(&["claims", path]).contains("README.md"));
}
