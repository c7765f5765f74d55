//! Scenes from elsewhere: glTF 2, Mitsuba 3's XML and PBRT's files, as a folder with a scene file of ours,
//! its meshes and textures.
//!
//! What our scene files cannot express is left out and listed. A surface is a mirror if a name is given
//! for it, or if it is made of a smooth metal or of glass.

mod cameras;
mod colors;
mod found;
mod gltf;
mod mitsuba;
mod pbrt;
mod shapes;
mod sheets;
mod toml;
mod write;

use std::collections::HashSet;
use std::path::Path;

use catoptric_scene::suggest;

use crate::exit::bad_input;

pub use found::{Choice, Coat, Form, Found, Thing, View};
pub use write::write;

/// Kinds of files, by their endings.
const KINDS: &str = ".gltf or .glb (glTF 2), .xml (Mitsuba 3), .pbrt (PBRT)";

/// Reads a file of a kind that is known by its ending, and decides what is a mirror.
///
/// # Errors
/// Whatever is wrong with it, or a name that nothing has.
pub fn read(path: &Path, choice: &Choice) -> anyhow::Result<Found> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let mut found = match ending.to_ascii_lowercase().as_str() {
        "gltf" | "glb" => gltf::read(path, choice)?,
        "xml" => mitsuba::read(path, choice)?,
        "pbrt" => pbrt::read(path, choice)?,
        _ => {
            return Err(bad_input(format!(
                "{}: what kind of scene it is says its ending: {KINDS}",
                path.display()
            )));
        }
    };
    if found.things.is_empty() {
        return Err(bad_input(format!(
            "{}: no surface is left{}",
            path.display(),
            match &found.left_out[..] {
                [] => String::new(),
                [one] => format!(": left out was {one}"),
                [first @ .., last] => {
                    let some = &first[first.len().saturating_sub(MOST_LEFT_OUT)..];
                    format!(": left out were {}; {last}", some.join("; "))
                }
            }
        )));
    }
    name_all(&mut found.things);
    choose(&mut found.things, &choice.mirrors)?;
    Ok(found)
}

/// Gives each thing a name of its own. Parts of one object share theirs.
fn name_all(things: &mut [Thing]) {
    let mut known: HashSet<String> = HashSet::new();
    for number in 0..things.len() {
        let group = things[number].group.clone();
        let earlier = things[..number].iter();
        let sibling = earlier
            .rev()
            .find(|thing| group.is_some() && thing.group == group);
        if let Some(sibling) = sibling {
            things[number].name = sibling.name.clone();
            continue;
        }
        let plain = |c: char| if c.is_control() { ' ' } else { c };
        let name: String = things[number].name.chars().map(plain).collect();
        let name = match name.trim() {
            "" => format!("thing {}", number + 1),
            name => name.to_owned(),
        };
        let mut unique = name.clone();
        let mut count = 1;
        while !known.insert(unique.clone()) {
            count += 1;
            unique = format!("{name} {count}");
        }
        things[number].name = unique;
    }
}

/// Makes mirrors of what is called so, or made of what is called so.
fn choose(things: &mut [Thing], names: &[String]) -> anyhow::Result<()> {
    for name in names {
        let is = |known: &str| known.eq_ignore_ascii_case(name);
        let mut any = false;
        for thing in things.iter_mut() {
            if is(&thing.name) || is(&thing.material) {
                thing.is_mirror = true;
                any = true;
            }
        }
        if !any {
            let mut known: Vec<&str> = Vec::new();
            for name in things
                .iter()
                .flat_map(|thing| [&thing.name, &thing.material])
            {
                if !name.is_empty() && !known.contains(&name.as_str()) {
                    known.push(name);
                }
            }
            let hint = suggest(name, known.iter().copied());
            known.truncate(MOST_NAMES);
            return Err(bad_input(format!(
                "--mirror {name}: nothing is called or made of it{hint}; there are: {}",
                known.join(", ")
            )));
        }
    }
    Ok(())
}

/// Of what was left out, a message names the last one and at most so many before it.
const MOST_LEFT_OUT: usize = 7;
/// Most names in a message.
const MOST_NAMES: usize = 40;
