//! Shader sources, linked by WESL when a pipeline is built.

use wesl::{ManglerKind, VirtualResolver, Wesl};

/// Every module below `shaders/`: path in imports and text.
const MODULES: &[(&str, &str)] = &[
    (
        "package::shared::view",
        include_str!("../../../shaders/shared/view.wesl"),
    ),
    (
        "package::shared::surface",
        include_str!("../../../shaders/shared/surface.wesl"),
    ),
    (
        "package::shared::mirror",
        include_str!("../../../shaders/shared/mirror.wesl"),
    ),
    (
        "package::shared::found",
        include_str!("../../../shaders/shared/found.wesl"),
    ),
    (
        "package::primary",
        include_str!("../../../shaders/primary.wesl"),
    ),
    (
        "package::gbuffer",
        include_str!("../../../shaders/gbuffer.wesl"),
    ),
    (
        "package::start",
        include_str!("../../../shaders/start.wesl"),
    ),
    (
        "package::linear",
        include_str!("../../../shaders/linear.wesl"),
    ),
    (
        "package::virtual",
        include_str!("../../../shaders/virtual.wesl"),
    ),
    (
        "package::composite",
        include_str!("../../../shaders/composite.wesl"),
    ),
];

/// Modules with entry points, and the features each knows.
pub const PROGRAMS: &[(&str, &[&str])] = &[
    ("primary", &[]),
    ("gbuffer", &[]),
    ("start", &[]),
    ("linear", &["count", "cross", "eight"]),
    ("virtual", &["virtual_depth"]),
    ("composite", &[]),
];

/// Plain WGSL of a program with the given features on and all others off.
///
/// # Errors
/// The linker's message, naming the module.
pub fn link(program: &str, features: &[&str]) -> Result<String, String> {
    let mut resolver = VirtualResolver::new();
    for (path, text) in MODULES {
        resolver.add_module(
            path.parse().map_err(|error| format!("{path}: {error}"))?,
            (*text).into(),
        );
    }
    let mut compiler = Wesl::new_barebones().set_custom_resolver(resolver);
    compiler
        .set_mangler(ManglerKind::Escape)
        .use_imports(true)
        .use_condcomp(true)
        .use_stripping(true);
    compiler.set_missing_feature_behavior(false);
    for feature in features {
        compiler.set_feature(feature, true);
    }
    let root = format!("package::{program}")
        .parse()
        .map_err(|error| format!("{program}: {error}"))?;
    let linked = compiler
        .compile(&root)
        .map_err(|error| format!("{program}.wesl: {error}"))?;
    Ok(linked.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    #[test]
    fn every_program_is_valid_with_every_set_of_features() {
        let mut validated = 0;
        for (program, features) in PROGRAMS {
            for set in 0..1_u32 << features.len() {
                let on: Vec<_> = features
                    .iter()
                    .enumerate()
                    .filter(|(bit, _)| set >> bit & 1 == 1)
                    .map(|(_, name)| *name)
                    .collect();
                let text = link(program, &on).expect("links");
                let module = naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| {
                    panic!("{program} {on:?}: {}", error.emit_to_string(&text))
                });
                Validator::new(ValidationFlags::all(), Capabilities::default())
                    .validate(&module)
                    .unwrap_or_else(|error| {
                        panic!("{program} {on:?}: {}", error.emit_to_string(&text))
                    });
                validated += 1;
            }
        }
        assert_eq!(validated, 4 + 8 + 2);
    }
}
