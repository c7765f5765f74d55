//! The sets of features that options really link are too many to try with every set of features:
//! here are those of at most three options that differ from their defaults.

use std::collections::BTreeSet;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::march;
use super::options::CubemapTrace;
use crate::gpu::shaders::tests::parsed;
use crate::options::Options;
use crate::{Values, parse};

/// Options that the shaders know, beside those that are one of some words.
const BOUNCES: &str = "bounces=2";

/// Options that differ from the defaults, at most.
const DIFFERENT: usize = 3;

/// `key=value` of every word but the default, a list for each option.
fn choices() -> Vec<Vec<String>> {
    let options = CubemapTrace::TABLE.iter().copied().flatten();
    let words = options.filter_map(|option| {
        let Values::Words(words) = option.values else {
            return None;
        };
        let others = words.iter().skip(1);
        Some(
            others
                .map(|word| format!("{}={word}", option.name))
                .collect(),
        )
    });
    words.chain([vec![BOUNCES.to_owned()]]).collect()
}

/// Every way to make up to `most` choices, each of another option.
fn combinations(choices: &[Vec<String>], most: usize) -> Vec<Vec<&str>> {
    let Some((first, rest)) = choices.split_first() else {
        return vec![Vec::new()];
    };
    let mut all = combinations(rest, most);
    if most > 0 {
        for tail in combinations(rest, most - 1) {
            for choice in first {
                all.push([&[choice.as_str()], tail.as_slice()].concat());
            }
        }
    }
    all
}

#[test]
fn what_three_options_link_is_valid() {
    let choices = choices();
    let sets: BTreeSet<Vec<&str>> = combinations(&choices, DIFFERENT)
        .into_iter()
        .map(|chosen| {
            let spec = parse(&format!("cubemap-trace({})", chosen.join(","))).expect("a technique");
            let (options, _) = spec.options().of().expect("its own options");
            march::features(&options)
        })
        .collect();
    assert!(sets.len() > 100, "{}", sets.len());
    for features in &sets {
        let module = parsed("cubemap_trace/march", features);
        Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(&module)
            .unwrap_or_else(|error| panic!("{features:?}: {error:?}"));
    }
}
