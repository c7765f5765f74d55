//! Shader sources, linked by WESL when a pipeline is built.
//!
//! A file with entry points is a program. `shaders/shared/` holds modules that programs import; a
//! folder of programs, such as `cubemap_trace/`, may hold modules that these alone import.
//! A program's features are the names in its `@if(…)` and those of the modules it imports.
//!
//! Where a module of a folder is to be chosen by number, a line `//each FOLDER: CODE` is replaced by `CODE`
//! once for each module of `FOLDER`, with `$name` and `$number` (`number_in`) put in: a new module in the
//! folder needs no other line.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use include_dir::{Dir, include_dir};
use wesl::{ManglerKind, VirtualResolver, Wesl};

static SHADERS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../shaders");

/// All modules: path without extension, and text.
static MODULES: LazyLock<Vec<(String, &str)>> = LazyLock::new(|| {
    let mut modules = Vec::new();
    files(&SHADERS, &mut modules);
    modules
});

/// Appends the files below `dir`.
fn files(dir: &'static Dir<'static>, into: &mut Vec<(String, &'static str)>) {
    for file in dir.files() {
        if let (Some("wesl"), Some(text)) = (
            file.path()
                .extension()
                .and_then(|extension| extension.to_str()),
            file.contents_utf8(),
        ) {
            let path = file.path().with_extension("");
            let parts: Vec<_> = path.iter().filter_map(|part| part.to_str()).collect();
            into.push((parts.join("/"), text));
        }
    }
    for dir in dir.dirs() {
        files(dir, into);
    }
}

/// Plain WGSL of a program, such as `linear`, with the given features on and all others off.
///
/// # Errors
/// The linker's message, naming the module.
pub fn link(program: &str, features: &[&str]) -> Result<String, String> {
    let mut resolver = VirtualResolver::new();
    let module = |name: &str| format!("package::{}", name.replace('/', "::"));
    for (name, text) in MODULES.iter() {
        let path = module(name);
        let path = path.parse().map_err(|error| format!("{name}: {error}"))?;
        resolver.add_module(path, expanded(text, &MODULES).into());
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
    let root = module(program)
        .parse()
        .map_err(|error| format!("{program}: {error}"))?;
    let linked = compiler
        .compile(&root)
        .map_err(|error| format!("{program}.wesl: {error}"))?;
    Ok(linked.to_string())
}

/// Names of the modules of a folder, sorted.
fn names_in<'m>(folder: &str, modules: &'m [(String, &str)]) -> Vec<&'m str> {
    let names = modules.iter().filter_map(|(path, _)| {
        let (of, name) = path.rsplit_once('/')?;
        (of == folder).then_some(name)
    });
    let mut names: Vec<_> = names.collect();
    names.sort_unstable();
    names
}

/// The number by which shaders choose a module of a folder; `None` if it is not there.
pub(crate) fn number_in(folder: &str, name: &str) -> Option<u32> {
    let names = names_in(folder, &MODULES);
    let index = names.iter().position(|other| *other == name);
    index.map(|index| index as u32)
}

/// The text of a module with its lines `//each FOLDER: CODE` written out.
fn expanded(text: &str, modules: &[(String, &str)]) -> String {
    let mut lines = Vec::new();
    for line in text.lines() {
        let each = line.trim_start().strip_prefix("//each ");
        let Some((folder, code)) = each.and_then(|each| each.split_once(": ")) else {
            lines.push(line.to_owned());
            continue;
        };
        let names = names_in(folder, modules).into_iter().zip(0_u32..);
        lines.extend(names.map(|(name, number)| {
            let code = code.replace("$name", name);
            code.replace("$number", &number.to_string())
        }));
    }
    lines.join("\n")
}

/// Threads of a workgroup of each compute entry point, as the linked text says; else where it is not valid.
pub(crate) fn workgroup_sizes(text: &str) -> Result<BTreeMap<String, [u32; 3]>, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    let entries = module.entry_points.into_iter();
    let compute = entries.filter(|point| point.stage == naga::ShaderStage::Compute);
    Ok(compute
        .map(|point| (point.name, point.workgroup_size))
        .collect())
}

#[cfg(test)]
pub(crate) mod tests {
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::Path;

    use naga::back::{hlsl, msl};
    use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

    use super::*;

    /// Whether a file has entry points. Those of `shared/` have none.
    fn is_program(text: &str) -> bool {
        ["@compute", "@vertex", "@fragment"]
            .iter()
            .any(|stage| text.contains(stage))
    }

    /// Every program and its features.
    fn programs() -> Vec<(String, Vec<String>)> {
        let modules: BTreeMap<_, _> = MODULES.iter().cloned().collect();
        let programs = modules.iter().filter(|(_, text)| is_program(text));
        programs
            .map(|(name, _)| {
                let mut reached = BTreeSet::new();
                reach(&modules, name, &mut reached);
                let texts = reached.iter().map(|name| modules[name.as_str()]);
                let features: BTreeSet<_> = texts.flat_map(features).collect();
                (name.clone(), features.into_iter().collect())
            })
            .collect()
    }

    /// A module and all that it imports, directly or by others.
    fn reach(modules: &BTreeMap<String, &str>, name: &str, reached: &mut BTreeSet<String>) {
        if !reached.insert(name.to_owned()) {
            return;
        }
        for other in modules.keys() {
            let path = format!("package::{}::", other.replace('/', "::"));
            if modules[name].contains(&path) {
                reach(modules, other, reached);
            }
        }
    }

    /// Names in `@if(…)`.
    fn features(text: &str) -> Vec<String> {
        let conditions = text.split("@if(").skip(1);
        conditions
            .filter_map(|rest| rest.split(')').next())
            .flat_map(|condition| condition.split(|c: char| !c.is_alphanumeric() && c != '_'))
            .filter(|name| !name.is_empty())
            .map(str::to_owned)
            .collect()
    }

    /// Most features of a program for which all sets are tried; of more features, only sets of at most two,
    /// and all.
    const ALL_SETS: usize = 5;

    /// All sets of up to [`ALL_SETS`] features; of more features, all sets of at most two, and all.
    fn sets(features: &[String]) -> Vec<Vec<&str>> {
        let count = features.len();
        let chosen = (0..1_u32 << count).filter(|set| {
            count <= ALL_SETS || set.count_ones() <= 2 || set.count_ones() as usize == count
        });
        chosen
            .map(|set| {
                let on = features
                    .iter()
                    .enumerate()
                    .filter(|(bit, _)| set >> bit & 1 == 1);
                on.map(|(_, name)| name.as_str()).collect()
            })
            .collect()
    }

    /// A linked program as naga sees it.
    pub(crate) fn parsed(program: &str, features: &[&str]) -> naga::Module {
        let text = link(program, features).expect("links");
        naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| {
            panic!("{program} {features:?}: {}", error.emit_to_string(&text))
        })
    }

    /// What is wrong with a linked program that is used with these features.
    fn fault(text: &str, features: &[&str]) -> Option<String> {
        let module = match naga::front::wgsl::parse_str(text) {
            Ok(module) => module,
            Err(error) => return Some(error.emit_to_string(text)),
        };
        // Subgroups are for adapters that have them, behind this feature alone.
        let mut capabilities = Capabilities::RAY_QUERY | Capabilities::default();
        capabilities.set(Capabilities::SUBGROUP, features.contains(&"ballot"));
        let mut validator = Validator::new(ValidationFlags::all(), capabilities);
        match validator.validate(&module) {
            Ok(info) => translate(&module, &info).err(),
            Err(error) => Some(error.emit_to_string(text)),
        }
    }

    #[test]
    fn every_program_is_valid_with_all_sets_of_few_features_and_pairs_of_many() {
        let mut faults = Vec::new();
        for (program, features) in &programs() {
            for on in sets(features) {
                let fault = match link(program, &on) {
                    Ok(text) => fault(&text, &on),
                    Err(error) => Some(error),
                };
                faults.extend(fault.map(|fault| format!("{program} {on:?}: {fault}")));
            }
        }
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }

    #[test]
    fn workgroups_have_the_size_that_the_shader_states() {
        let text = "const SIDE: u32 = 4u; @compute @workgroup_size(2 * SIDE, SIDE) fn idle() {}";
        let stated = BTreeMap::from([("idle".to_owned(), [8, 4, 1])]);
        assert_eq!(workgroup_sizes(text), Ok(stated));
        let none = workgroup_sizes("@fragment fn idle() {}").unwrap();
        assert!(none.is_empty());
        let error = workgroup_sizes("fn f() { absent(); }").unwrap_err();
        assert!(error.contains("absent"), "{error}");
    }

    #[test]
    fn an_invalid_program_is_noticed() {
        assert_eq!(fault("@compute @workgroup_size(1) fn idle() {}", &[]), None);
        for wrong in [
            "@compute @workgroup_size(1) fn idle() { undefined(); }",
            "@compute @workgroup_size(1) fn idle() { let x: u32 = 1.0; }",
            "@compute @workgroup_size(1) fn idle() { workgroupBarrier() }",
            // Well-typed, but no binding.
            "var<storage> list: array<u32>; @compute @workgroup_size(1) fn idle() { _ = list[0]; }",
        ] {
            assert!(fault(wrong, &[]).is_some(), "{wrong}");
        }
        let subgroups = "@compute @workgroup_size(32) fn idle() { _ = subgroupBallot(true); }";
        assert!(fault(subgroups, &[]).is_some());
        assert_eq!(fault(subgroups, &["ballot"]), None);
    }

    /// Paths of the files below a folder that end in `extension`.
    fn on_disk(folder: &Path, extension: &str, into: &mut Vec<std::path::PathBuf>) {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                on_disk(&path, extension, into);
            } else if path.extension().is_some_and(|found| found == extension) {
                into.push(path);
            }
        }
    }

    #[test]
    fn every_file_is_a_program_or_a_module_that_programs_import() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = root.join("../../shaders");
        let (mut shaders, mut sources) = (Vec::new(), Vec::new());
        on_disk(&folder, "wesl", &mut shaders);
        on_disk(&root.join("src"), "rs", &mut sources);
        let sources = sources
            .iter()
            .map(|path| fs::read_to_string(path).expect("text"));
        let sources: String = sources.collect();
        let modules: BTreeMap<_, _> = MODULES.iter().cloned().collect();
        let importers = |module: &str| {
            let path = format!("package::{}::", module.replace('/', "::"));
            let importing = modules.iter().filter(|(_, text)| text.contains(&path));
            importing.map(|(name, _)| name.clone()).collect::<Vec<_>>()
        };
        for path in shaders {
            let name = path.strip_prefix(&folder).expect("below");
            let name = name.with_extension("");
            let name = name.to_str().expect("plain").replace('\\', "/");
            let (room, _) = name.split_once('/').unwrap_or_default();
            if is_program(modules[&name]) {
                assert_ne!(room, "shared", "{name} has entry points");
                let quoted = format!("\"{name}\"");
                assert!(sources.contains(&quoted), "no source names {name}");
            } else if room == "shared" {
                let shape = name.starts_with("shared/shape/");
                assert!(
                    shape || !importers(&name).is_empty(),
                    "nobody imports {name}"
                );
            } else {
                let importers = importers(&name);
                let near =
                    |other: &String| !room.is_empty() && other.starts_with(&format!("{room}/"));
                assert!(
                    !importers.is_empty() && importers.iter().all(near),
                    "{name} is for programs of its folder, not for {importers:?}"
                );
            }
        }
    }

    /// Writes a program in the languages of Metal and of DirectX, as a device there would.
    fn translate(module: &naga::Module, info: &ModuleInfo) -> Result<(), String> {
        let options = msl::Options {
            lang_version: (2, 4),
            fake_missing_bindings: true,
            ..Default::default()
        };
        msl::write_string(module, info, &options, &msl::PipelineOptions::default())
            .map_err(|error| format!("Metal: {error}"))?;
        let options = hlsl::Options {
            shader_model: hlsl::ShaderModel::V6_5,
            fake_missing_bindings: true,
            ..Default::default()
        };
        hlsl::Writer::new(
            &mut String::new(),
            &options,
            &hlsl::PipelineOptions::default(),
        )
        .write(module, info, None)
        .map_err(|error| format!("DirectX: {error}"))?;
        Ok(())
    }

    #[test]
    fn features_are_found_in_the_sources() {
        let linear = programs().into_iter().find(|(name, _)| name == "linear");
        let (_, features) = linear.expect("there is a linear search");
        assert_eq!(features, ["count", "cross", "eight", "extend", "path"]);
    }
}
