//! The techniques on two Vulkan drivers, the second compared with the first.

use std::path::{Path, PathBuf};

use crate::step::Step;

/// Where packages put the manifest of SwiftShader.
const SWIFTSHADER: [&str; 4] = [
    "/usr/lib/chromium/vk_swiftshader_icd.json",
    "/usr/lib/chromium-browser/vk_swiftshader_icd.json",
    "/opt/google/chrome/vk_swiftshader_icd.json",
    "/usr/share/vulkan/icd.d/vk_swiftshader_icd.json",
];

/// One mirror of each kind, and one that is a mesh.
const COMPARED: &str = "run --release -p catoptric -- compare spheres planar bowl faceted sphere-table \
     -t linear ray-hierarchy newton ray-trace beams planar cubemap-trace --resolution 96x72 --time-budget 0.1";

/// The rows of the first driver.
const FIRST: &str = "target/drivers.json";

/// The manifest of the other driver.
///
/// # Errors
/// A message where none is found.
pub fn other(named: Option<&Path>) -> Result<PathBuf, String> {
    if let Some(named) = named {
        return match named.is_file() {
            true => Ok(named.to_owned()),
            false => Err(format!("no driver manifest {}", named.display())),
        };
    }
    let found = SWIFTSHADER
        .iter()
        .map(PathBuf::from)
        .find(|path| path.is_file());
    found.ok_or_else(|| {
        "no second Vulkan driver is found: the Debian package `chromium` brings SwiftShader, and any \
         other driver is compared by `cargo xtask drivers MANIFEST.json`"
            .to_owned()
    })
}

/// Both runs; the second says what changed.
pub fn steps(manifest: &Path) -> Vec<Step> {
    let mut first = Step::cargo(COMPARED);
    first.args.extend(["-o".into(), FIRST.into()]);
    let mut second = Step::cargo(COMPARED);
    second.args.extend(["--against".into(), FIRST.into()]);
    second.env = vec![("VK_DRIVER_FILES", manifest.display().to_string())];
    vec![first, second]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_run_is_held_against_the_first_on_the_other_driver() {
        let [first, second] = &steps(Path::new("other.json"))[..] else {
            panic!("two runs");
        };
        assert!(first.env.is_empty() && first.shown().ends_with("-o target/drivers.json"));
        let shown = second.shown();
        assert!(
            shown.starts_with("VK_DRIVER_FILES=other.json cargo run"),
            "{shown}"
        );
        assert!(shown.ends_with("--against target/drivers.json"), "{shown}");
    }

    #[test]
    fn a_manifest_that_is_not_there_is_said() {
        let missing = other(Some(Path::new("no/such.json")));
        assert_eq!(missing, Err("no driver manifest no/such.json".to_owned()));
    }
}
