//! Builds the program that traces with Embree, beside the benchmark that calls it.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

const SOURCE: &str = "crates/reference/benches/embree/embree.cpp";

/// Compiles the program with the system's compiler (or `$CXX`); the answer is where it lies.
pub fn compile() -> Result<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let folder = target.join("embree");
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    let program = folder.canonicalize()?.join("embree");
    let compiler = env::var_os("CXX")
        .filter(|name| !name.is_empty())
        .unwrap_or_else(|| OsString::from("c++"));
    let shown = compiler.to_string_lossy();
    eprintln!(
        "xtask: {shown} -std=c++17 -O2 -o {} {SOURCE} -lembree3",
        program.display()
    );
    let status = Command::new(&compiler)
        .args(["-std=c++17", "-O2", "-o"])
        .arg(&program)
        .arg(root.join(SOURCE))
        .arg("-lembree3")
        .status()
        .with_context(|| format!("cannot run `{shown}`"))?;
    if !status.success() {
        bail!("{SOURCE} does not compile");
    }
    Ok(program)
}
