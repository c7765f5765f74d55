//! What the machine must have besides Rust, and how it gets it.
//!
//! Only Linux needs anything: a Vulkan driver (a software one will do) and, for the tests, a C++
//! compiler. With apt-get and the right to use it they are installed; otherwise they are named.

use std::env;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result};

/// Where the Vulkan loader finds driver manifests (`*.json`) on Linux.
const ICD_FOLDERS: [&str; 3] = [
    "/usr/share/vulkan/icd.d",
    "/etc/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
];

/// Variables that name driver manifests themselves and so replace the search in the folders.
const ICD_VARIABLES: [&str; 2] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];

/// The Vulkan loader's file name.
const LOADER: &str = "libvulkan.so.1";

/// Something a chore cannot do without.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// The Vulkan loader and at least one driver.
    Vulkan,
    /// A C++ compiler: a dependency of the tests (`nv-flip`) is written in C++.
    CppCompiler,
    /// Embree 3, to measure beside.
    Embree,
}

impl Need {
    /// What it is, for a message.
    fn what(self) -> &'static str {
        match self {
            Self::Vulkan => "a Vulkan driver and its loader",
            Self::CppCompiler => "a C++ compiler (for a dependency of the tests)",
            Self::Embree => "Embree 3 with its headers",
        }
    }

    /// The packages that bring it on Debian and Ubuntu.
    fn apt_packages(self) -> &'static [&'static str] {
        match self {
            Self::Vulkan => &["mesa-vulkan-drivers", "libvulkan1"],
            Self::CppCompiler => &["g++"],
            Self::Embree => &["libembree-dev"],
        }
    }

    /// The packages that bring it on Fedora.
    fn fedora_packages(self) -> &'static [&'static str] {
        match self {
            Self::Vulkan => &["vulkan-loader", "mesa-vulkan-drivers"],
            Self::CppCompiler => &["gcc-c++"],
            Self::Embree => &["embree3-devel"],
        }
    }

    /// The packages that bring it on Arch.
    fn arch_packages(self) -> &'static [&'static str] {
        match self {
            Self::Vulkan => &["vulkan-icd-loader", "vulkan-swrast"],
            Self::CppCompiler => &["gcc"],
            Self::Embree => &["embree3"],
        }
    }

    /// Whether this machine has it.
    fn is_met(self) -> bool {
        match self {
            Self::Vulkan => Vulkan::of_this_machine().usable(),
            Self::CppCompiler => {
                env::var_os("CXX").is_some_and(|name| !name.is_empty())
                    || ["c++", "g++", "clang++"].iter().any(|name| on_path(name))
            }
            Self::Embree => {
                let folders = env::var_os("CPATH").unwrap_or_default();
                env::split_paths(&folders)
                    .chain(["/usr/include", "/usr/local/include"].map(PathBuf::from))
                    .any(|folder| folder.join("embree3/rtcore.h").is_file())
            }
        }
    }
}

/// Installs what is missing, where that is possible. `Err(message)` inside says what stays missing.
pub fn provide(needs: &[Need]) -> Result<Result<(), String>> {
    if !cfg!(target_os = "linux") {
        return Ok(Ok(()));
    }
    let missing = unmet(needs);
    if missing.is_empty() {
        return Ok(Ok(()));
    }
    for need in &missing {
        eprintln!("xtask: this machine lacks {}", need.what());
    }
    if on_path("apt-get")
        && let Some(prefix) = privilege()
    {
        let packages: Vec<&str> = missing
            .iter()
            .flat_map(|need| need.apt_packages())
            .copied()
            .collect();
        // An update that fails for one source may still leave what is needed; the installation decides.
        if !apt_get(prefix, &["update"])? {
            eprintln!("xtask: apt-get update failed; trying to install nevertheless");
        }
        let install = [
            &["install", "-y", "--no-install-recommends"],
            packages.as_slice(),
        ]
        .concat();
        if !apt_get(prefix, &install)? {
            eprintln!("xtask: apt-get install failed");
        }
    }
    let missing = unmet(needs);
    Ok(if missing.is_empty() {
        Ok(())
    } else {
        Err(advice(&missing))
    })
}

/// The needs that this machine does not meet.
fn unmet(needs: &[Need]) -> Vec<Need> {
    needs
        .iter()
        .copied()
        .filter(|need| !need.is_met())
        .collect()
}

/// The message that names the packages to install by hand.
fn advice(missing: &[Need]) -> String {
    let list = |packages: fn(Need) -> &'static [&'static str]| {
        missing
            .iter()
            .flat_map(|need| packages(*need))
            .copied()
            .collect::<Vec<_>>()
            .join(" ")
    };
    format!(
        "missing: {}. Install it and call this again:\n  \
         Debian, Ubuntu:  apt-get install {}\n  \
         Fedora:          dnf install {}\n  \
         Arch:            pacman -S {}",
        missing
            .iter()
            .map(|need| need.what())
            .collect::<Vec<_>>()
            .join("; "),
        list(Need::apt_packages),
        list(Need::fedora_packages),
        list(Need::arch_packages),
    )
}

/// What decides whether Vulkan is there, gathered so that the decision can be tested.
#[derive(Debug, Default)]
struct Vulkan {
    /// A variable names driver manifests.
    named_by_variable: bool,
    /// The files in the folders of driver manifests.
    manifests: Vec<PathBuf>,
    /// What `ldconfig -p` printed; `None` where there is no such program.
    ldconfig: Option<String>,
    /// The loader lies in a folder of `LD_LIBRARY_PATH`.
    loader_in_library_path: bool,
}

impl Vulkan {
    /// Looks at this machine.
    fn of_this_machine() -> Self {
        Self {
            named_by_variable: ICD_VARIABLES
                .iter()
                .any(|name| env::var_os(name).is_some_and(|v| !v.is_empty())),
            manifests: ICD_FOLDERS
                .iter()
                .flat_map(|folder| files_in(Path::new(folder)))
                .collect(),
            ldconfig: ["ldconfig", "/sbin/ldconfig", "/usr/sbin/ldconfig"]
                .iter()
                .find_map(|ldconfig| {
                    let output = Command::new(ldconfig)
                        .arg("-p")
                        .stderr(Stdio::null())
                        .output()
                        .ok()?;
                    output
                        .status
                        .success()
                        .then(|| String::from_utf8_lossy(&output.stdout).into_owned())
                }),
            loader_in_library_path: env::var_os("LD_LIBRARY_PATH").is_some_and(|path| {
                env::split_paths(&path).any(|folder| folder.join(LOADER).is_file())
            }),
        }
    }

    /// Whether there are both a driver and a loader.
    fn usable(&self) -> bool {
        self.has_driver() && self.has_loader()
    }

    /// A driver: named by a variable, or described by a manifest.
    fn has_driver(&self) -> bool {
        self.named_by_variable
            || self
                .manifests
                .iter()
                .any(|file| file.extension() == Some(OsStr::new("json")))
    }

    /// The loader: known to the linker. Where nobody can say (no `ldconfig`), it is taken to be
    /// there: the program itself says so if it is not.
    fn has_loader(&self) -> bool {
        self.loader_in_library_path
            || self.ldconfig.as_deref().is_none_or(|printed| {
                printed
                    .lines()
                    .any(|line| line.split_whitespace().next() == Some(LOADER))
            })
    }
}

/// The files in a folder; none if it does not exist.
fn files_in(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .collect()
}

/// Whether a program of this name is on the path.
pub fn on_path(name: &str) -> bool {
    env::var_os("PATH")
        .is_some_and(|path| env::split_paths(&path).any(|folder| folder.join(name).is_file()))
}

/// The words to put before a command so that it runs as root; `None` if that takes a password.
fn privilege() -> Option<&'static [&'static str]> {
    let root = Command::new("id")
        .arg("-u")
        .output()
        .is_ok_and(|o| o.stdout.trim_ascii() == b"0");
    if root {
        return Some(&[]);
    }
    let sudo = Command::new("sudo")
        .args(["-n", "true"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    sudo.then_some(&["sudo", "-n"])
}

/// Prints and runs apt-get without questions; the answer is whether it succeeded.
fn apt_get(prefix: &[&str], args: &[&str]) -> Result<bool> {
    let words = [
        prefix,
        &["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"],
        args,
    ]
    .concat();
    let shown = words.join(" ");
    eprintln!("xtask: {shown}");
    // Its chatter goes to stderr: stdout carries the result of the chore and nothing else.
    let status = Command::new(words[0])
        .args(&words[1..])
        .stdin(Stdio::null())
        .stdout(std::io::stderr())
        .status()
        .with_context(|| format!("cannot run `{shown}`"))?;
    Ok(status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CACHE: &str = "2 libs found in cache `/etc/ld.so.cache'\n\
        \tlibz.so.1 (libc6,x86-64) => /lib/libz.so.1\n\
        \tlibvulkan.so.1 (libc6,x86-64) => /lib/libvulkan.so.1\n";

    fn machine(manifests: &[&str], ldconfig: Option<&str>) -> Vulkan {
        Vulkan {
            manifests: manifests.iter().map(PathBuf::from).collect(),
            ldconfig: ldconfig.map(str::to_owned),
            ..Vulkan::default()
        }
    }

    #[test]
    fn a_manifest_and_a_loader_are_enough() {
        assert!(machine(&["/usr/share/vulkan/icd.d/lvp_icd.json"], Some(CACHE)).usable());
    }

    #[test]
    fn without_a_manifest_there_is_no_driver() {
        assert!(!machine(&[], Some(CACHE)).usable());
        assert!(
            !machine(
                &["/etc/vulkan/icd.d/README", "/etc/vulkan/icd.d/lvp.json.bak"],
                Some(CACHE)
            )
            .usable()
        );
    }

    #[test]
    fn a_variable_stands_for_a_manifest_but_not_for_the_loader() {
        let named = |ldconfig: &str| Vulkan {
            named_by_variable: true,
            ..machine(&[], Some(ldconfig))
        };
        assert!(named(CACHE).usable());
        assert!(!named("").usable());
    }

    #[test]
    fn the_loader_is_known_by_its_whole_name() {
        let icd = ["/etc/vulkan/icd.d/lvp_icd.json"];
        assert!(!machine(&icd, Some("\tlibz.so.1 (libc6) => /lib/libz.so.1\n")).usable());
        assert!(
            !machine(
                &icd,
                Some("\tlibvulkan.so.12 (libc6) => /lib/libvulkan.so.12\n")
            )
            .usable()
        );
        assert!(
            !machine(
                &icd,
                Some("\tlibz.so.1 (libc6) => /opt/libvulkan.so.1/libz.so.1\n")
            )
            .usable()
        );
    }

    #[test]
    fn the_loader_may_lie_in_the_library_path_or_be_unknown() {
        let icd = ["/etc/vulkan/icd.d/lvp_icd.json"];
        assert!(
            Vulkan {
                loader_in_library_path: true,
                ..machine(&icd, Some(""))
            }
            .usable()
        );
        assert!(machine(&icd, None).usable());
    }

    #[test]
    fn the_advice_names_every_package() {
        let text = advice(&[Need::Vulkan, Need::CppCompiler]);
        for package in [
            "mesa-vulkan-drivers",
            "libvulkan1",
            "g++",
            "vulkan-loader",
            "vulkan-swrast",
            "gcc-c++",
        ] {
            assert!(text.contains(package), "{package} is missing in {text}");
        }
        assert!(!advice(&[Need::Vulkan]).contains("g++"));
    }
}
