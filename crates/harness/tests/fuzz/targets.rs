//! What is tried: how an input is made, and what reads it.

use std::fs;
use std::path::Path;

use catoptric::{import, record};
use catoptric_frame::{Channels, Frame};
use catoptric_scene::LoadOptions;

use super::{foreign, inputs};

/// Files of an input, the first of which is opened.
pub struct Input(pub Vec<(&'static str, Vec<u8>)>);

impl Input {
    /// Writes the files.
    pub fn write(&self, folder: &Path) {
        for (name, bytes) in &self.0 {
            fs::write(folder.join(name), bytes).expect("can be written");
        }
    }
}

/// Something that reads.
pub struct Target {
    pub name: &'static str,
    /// The input of a number.
    pub make: fn(u64) -> Input,
    /// Reads the input in a folder; whether it was accepted.
    pub run: fn(&Path) -> bool,
}

/// All of them.
pub const TARGETS: [Target; 8] = [
    Target {
        name: "scene",
        make: inputs::scene,
        run: opens,
    },
    Target {
        name: "mesh",
        make: inputs::mesh,
        run: opens,
    },
    Target {
        name: "texture",
        make: inputs::texture,
        run: opens,
    },
    Target {
        name: "exr",
        make: inputs::exr,
        run: |folder| {
            let file = folder.join("a.exr");
            let (ours, any) = (Frame::read_exr(&file), Channels::read(&file));
            ours.is_ok() || any.is_ok()
        },
    },
    Target {
        name: "name",
        make: inputs::name,
        run: |folder| {
            let text = fs::read(folder.join("name")).expect("a file");
            catoptric_reflect::parse(&String::from_utf8_lossy(&text)).is_ok()
        },
    },
    Target {
        name: "record",
        make: inputs::record,
        run: |folder| {
            let Ok(rows) = record::read(&folder.join("a.json")) else {
                return false;
            };
            record::against::changes(&rows, &inputs::rows());
            record::against::changes(&inputs::rows(), &rows);
            true
        },
    },
    Target {
        name: "model",
        make: foreign::model,
        run: opens,
    },
    Target {
        name: "import",
        make: foreign::import,
        run: |folder| {
            // The folder is one worker's: the file of the input before is taken away.
            let files = ["s.xml", "s.pbrt", "s.gltf", "s.glb"].map(|name| folder.join(name));
            let choice = import::Choice {
                roughness: 0.15,
                mirrors: Vec::new(),
            };
            let read = files.iter().filter(|file| file.is_file()).map(|file| {
                let found = import::read(file, &choice);
                let _ = fs::remove_file(file);
                found
            });
            let out = folder.join("out");
            let mut any = false;
            for found in read.flatten() {
                let written = import::write(&found, Path::new("s"), &out);
                let scene = out.join("scene.toml");
                if written.is_ok() && scene.is_file() {
                    let name = scene.to_str().expect("a plain path");
                    any |= catoptric_scene::open(name, &LoadOptions::default()).is_ok();
                }
            }
            any
        },
    },
];

/// Failures made to be noticed.
const FAILING: [Target; 3] = [
    Target {
        name: "panics",
        make: |_| Input(Vec::new()),
        run: |_| panic!("on purpose"),
    },
    Target {
        name: "aborts",
        make: |_| Input(Vec::new()),
        run: |_| std::process::abort(),
    },
    Target {
        name: "fills",
        make: |_| Input(Vec::new()),
        run: |_| vec![1_u8; 4 << 30].iter().all(|byte| *byte == 1),
    },
];

/// A target by its name.
pub fn named(name: &str) -> &'static Target {
    let mut all = TARGETS.iter().chain(&FAILING);
    all.find(|target| target.name == name)
        .unwrap_or_else(|| panic!("no target {name}"))
}

fn opens(folder: &Path) -> bool {
    let file = folder.join("s.toml");
    let file = file.to_str().expect("a plain path");
    let options = LoadOptions {
        resolution: Some([16, 12]),
        ..LoadOptions::default()
    };
    catoptric_scene::open(file, &options).is_ok()
}
