//! What a figure measures: series of points along its axis.

use crate::record::Record;

/// Points of one kind, from left to right.
#[derive(Clone, Debug)]
pub struct Series {
    /// In the legend; unique in the figure.
    pub label: String,
    /// From left to right.
    pub points: Vec<Point>,
}

/// A scene and a technique, and where they stand on the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// On the axis.
    pub x: f64,
    /// Built-in name or scene file.
    pub scene: String,
    /// Picture size; `None` for the scene's own.
    pub resolution: Option<[u32; 2]>,
    /// Name, with options.
    pub technique: String,
    /// Frames of the scene's motion to follow (the record's `temporal`); the largest of a scene's
    /// points holds for all of them.
    pub frames: Option<u32>,
    /// Whether its pictures come on the page.
    pub picture: bool,
    /// A number of its record that says where it stands on the axis, in place of `x`: error against
    /// time, for example.
    pub along: Option<&'static str>,
}

impl Series {
    /// Points of one kind.
    pub fn new(label: impl Into<String>, points: impl IntoIterator<Item = Point>) -> Self {
        Self {
            label: label.into(),
            points: points.into_iter().collect(),
        }
    }
}

impl Point {
    /// A point without pictures, in the scene's own size.
    pub fn new(x: f64, scene: impl Into<String>, technique: impl Into<String>) -> Self {
        Self {
            x,
            scene: scene.into(),
            resolution: None,
            technique: technique.into(),
            frames: None,
            picture: false,
            along: None,
        }
    }

    /// The same point with its pictures on the page.
    pub fn shown(self) -> Self {
        Self {
            picture: true,
            ..self
        }
    }

    /// Whether a row holds the measurement of this point. Names may be spelled differently: options in
    /// another order, a scene file by its path.
    pub fn is_of(&self, row: &Record) -> bool {
        let size = self.resolution.is_none_or(|size| size == row.resolution);
        let means = || self.canonical().as_ref() == Some(&row.technique);
        size && self.is_on(&row.scene) && (row.technique == self.technique || means())
    }

    /// Whether a record's scene is this one.
    pub fn is_on(&self, scene: &str) -> bool {
        let stem = || std::path::Path::new(&self.scene).file_stem();
        scene == self.scene || stem().is_some_and(|stem| stem == scene)
    }

    /// The technique as records have it; `None` where it is none.
    pub fn canonical(&self) -> Option<String> {
        let spec = catoptric_reflect::parse(&self.technique).ok()?;
        Some(spec.to_string())
    }
}

/// A number of ours: of the point of a series, which is nearest to `x`.
#[derive(Clone, Copy, Debug)]
pub struct Ask {
    /// The label of the series.
    pub series: &'static str,
    /// On the axis.
    pub x: f64,
    /// Where it stands in the record.
    pub path: &'static str,
    /// Written behind it.
    pub unit: &'static str,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::measured;

    #[test]
    fn rows_are_found_by_any_spelling() {
        let row = measured("bowl", "linear(neighbours=8,residual=cross)");
        let other = "linear(residual=cross,neighbours=8)";
        assert!(Point::new(0.0, "bowl", other).is_of(&row));
        assert!(Point::new(0.0, "mine/bowl.toml", other).is_of(&row));
        assert!(!Point::new(0.0, "bowl", "linear").is_of(&row));
        let size = Point {
            resolution: Some([1, 1]),
            ..Point::new(0.0, "bowl", other)
        };
        assert!(!size.is_of(&row));
    }
}
