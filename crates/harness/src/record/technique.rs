//! Properties of the technique that a record names: the record itself holds only the name.

use catoptric_reflect::{Properties, Spec};

/// The technique of this name; `None` where this program has no such technique (an earlier one wrote
/// the record).
fn named(name: &str) -> Option<Spec> {
    catoptric_reflect::parse(name).ok()
}

/// What the technique of this name is like; nothing in particular where it is not known.
pub fn properties(name: &str) -> Properties {
    named(name)
        .map(|spec| spec.properties())
        .unwrap_or_default()
}

/// Whether it chooses by itself which points are searched.
pub fn refines(name: &str) -> bool {
    named(name).is_some_and(|spec| spec.refinement().is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn techniques_are_asked() {
        for (name, control) in [
            ("ray-trace", true),
            ("ray-trace(update=frame)", true),
            ("ray-trace(gbuffer=mesh)", false),
            ("linear", false),
        ] {
            assert_eq!(properties(name).is_control, control, "{name}");
        }
        assert!(properties("linear(residual=cross)").walks && !properties("newton").walks);
        assert!(refines("linear+full(level=2)") && !refines("linear"));
        let continued = properties("reflector-cubemap(depth=virtual,hidden=extend)");
        assert!(continued.continues_hidden);
        assert!(!properties("linear").continues_hidden);
        assert_eq!(properties("of an earlier program"), Properties::default());
    }
}
