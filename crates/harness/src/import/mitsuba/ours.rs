//! What `export --mitsuba` writes beside a scene: which shape is which of our objects.

use std::path::Path;

use catoptric_frame::Channels;
use catoptric_scene::Background;
use glam::Vec3;
use serde_json::Value;

use crate::export::mitsuba::IDS_FILE;
use crate::input;

/// Which shape belongs to what.
pub struct Ids {
    entries: Vec<Entry>,
}

/// An object or a mirror.
pub struct Entry {
    pub id: u64,
    pub name: String,
    /// `object` or `mirror`.
    pub kind: String,
    shapes: Vec<String>,
}

impl Ids {
    /// What the shape of this id belongs to.
    pub fn of(&self, shape: &str) -> Option<&Entry> {
        self.entries
            .iter()
            .find(|entry| entry.shapes.iter().any(|known| known == shape))
    }
}

/// Reads the list beside a scene; `None` where there is none of ours.
pub fn beside(scene: &Path) -> anyhow::Result<Option<Ids>> {
    let path = scene.with_file_name(IDS_FILE);
    if !path.is_file() {
        return Ok(None);
    }
    let value = input::json(&path)?;
    let (Some(1), Some(ids)) = (value["format"].as_u64(), value["ids"].as_array()) else {
        return Ok(None);
    };
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let entry = |value: &Value| Entry {
        id: value["id"].as_u64().unwrap_or_default(),
        name: text(&value["name"]),
        kind: text(&value["kind"]),
        shapes: value["shapes"]
            .as_array()
            .into_iter()
            .flatten()
            .map(text)
            .collect(),
    };
    Ok(Some(Ids {
        entries: ids.iter().map(entry).collect(),
    }))
}

/// The gradient that a picture of the sky was made of; `None` where it is another picture.
pub fn gradient(path: &Path) -> anyhow::Result<Option<Background>> {
    let channels = Channels::read(path)?;
    let Some(colors) = channels.colors("")? else {
        return Ok(None);
    };
    let [width, height] = colors.size();
    if height < 3 || height % 2 == 0 {
        return Ok(None);
    }
    let row = |row: u32| colors.pixels()[(row * width) as usize];
    let [zenith, horizon, nadir] = [0, height / 2, height - 1].map(row);
    let near =
        |a: Vec3, b: Vec3| (a - b).abs().max_element() <= 1e-5 * (1.0 + b.abs().max_element());
    let is_gradient = (0..height).all(|index| {
        let polar = f64::from(index) / f64::from(height - 1) * std::f64::consts::PI;
        let up = polar.cos() as f32;
        let towards = if up >= 0.0 { zenith } else { nadir };
        let wanted = horizon.lerp(towards, up.abs());
        let first = (index * width) as usize;
        colors.pixels()[first..first + width as usize]
            .iter()
            .all(|color| near(*color, wanted))
    });
    Ok(is_gradient.then_some(Background::Gradient {
        zenith,
        horizon,
        nadir,
    }))
}
