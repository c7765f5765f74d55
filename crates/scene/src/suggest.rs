//! The known name that a misspelt one is likely to mean.

/// How alike two names must be (Jaro–Winkler) for one to be taken for the other: swapped or lost
/// letters pass, words that only begin alike do not.
const ALIKE: f64 = 0.8;

/// ` (did you mean …?)` with the most similar of `known`, or nothing where none is similar.
pub fn suggest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let nearest = known
        .into_iter()
        .map(|name| (strsim::jaro_winkler(word, name), name))
        .filter(|(similarity, _)| *similarity >= ALIKE)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map_or_else(String::new, |(_, name)| {
        format!(" (did you mean `{name}`?)")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognized_and_nonsense_is_not() {
        let known = ["search", "tessellation", "estalella", "cubemap", "control"];
        assert_eq!(suggest("serach", known), " (did you mean `search`?)");
        assert_eq!(
            suggest("tesselation", known),
            " (did you mean `tessellation`?)"
        );
        for nonsense in ["foo", "", "bogus", "hammer"] {
            assert_eq!(suggest(nonsense, known), "", "{nonsense}");
        }
    }
}
