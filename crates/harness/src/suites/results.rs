//! A figure's measurements, as rules and pages read them.

use serde_json::Value;

use crate::record::path::{lookup, number};
use crate::record::{Record, Status};
use crate::show::number::count;
use crate::show::plot::{Axis, Scale};

use super::claims::Numbers;
use super::figure::Figure;
use super::paths::{HEIGHT, WIDTH};
use super::series::{Ask, Point, Series};

/// A measured row: its JSON, and what it is looked up by.
pub struct Row {
    value: Value,
    scene: String,
    technique: String,
    resolution: [u32; 2],
    ok: bool,
}

impl Row {
    /// A row just measured.
    pub fn of(row: &Record) -> Self {
        Self {
            value: row.to_value(),
            scene: row.scene.clone(),
            technique: row.technique.clone(),
            resolution: row.resolution,
            ok: row.status == Status::Ok,
        }
    }

    /// A row of a file; `None` where what it is looked up by is missing.
    pub fn read(value: Value) -> Option<Self> {
        let text = |path: &str| Some(lookup(&value, path)?.as_str()?.to_owned());
        let side =
            |place: usize| u32::try_from(value.get("resolution")?.get(place)?.as_u64()?).ok();
        Some(Self {
            scene: text("scene")?,
            technique: text("technique")?,
            resolution: [side(0)?, side(1)?],
            ok: text("status")? == "ok",
            value,
        })
    }
}

/// The rows of one figure.
pub struct Results<'r> {
    series: &'r [Series],
    axis: &'r Axis,
    rows: &'r [Row],
}

impl<'r> Results<'r> {
    /// `rows` are all rows of the suite.
    pub fn new(figure: &'r Figure, rows: &'r [Row]) -> Self {
        Self {
            series: &figure.series,
            axis: &figure.axis,
            rows,
        }
    }

    /// Where among all rows the one of a point stands; `None` where it is not measured (yet). Rows of several
    /// suites may be of the same point: the first one counts, but for a point that asks for frames the first one
    /// that followed a motion.
    pub fn index(&self, point: &Point) -> Option<usize> {
        let named = point.canonical();
        let is_of_point = |row: &Row| {
            let size = point.resolution.is_none_or(|size| size == row.resolution);
            size && point.is_on(&row.scene)
                && (row.technique == point.technique || named.as_ref() == Some(&row.technique))
        };
        let followed = |row: &Row| lookup(&row.value, "temporal").is_some_and(|it| !it.is_null());
        let rows = || self.rows.iter();
        let moving = point
            .frames
            .and_then(|_| rows().position(|row| is_of_point(row) && followed(row)));
        moving.or_else(|| rows().position(is_of_point))
    }

    /// The size of the picture of a point's row.
    pub fn size(&self, point: &Point) -> Option<[u32; 2]> {
        Some(self.rows[self.index(point)?].resolution)
    }

    /// Why a point has no numbers; `None` where it has, or is not measured.
    pub fn reason(&self, point: &Point) -> Option<&'r str> {
        lookup(&self.rows[self.index(point)?].value, "reason")?.as_str()
    }

    /// A number of a point's row; `None` where it is `null` or not measured.
    pub fn value(&self, point: &Point, path: &str) -> Option<f64> {
        let row = &self.rows[self.index(point)?];
        let [width, height] = row.resolution.map(f64::from);
        match path {
            WIDTH => Some(width),
            HEIGHT => Some(height),
            _ => row.ok.then(|| number(&row.value, path)).flatten(),
        }
    }

    /// Where a point stands on the axis; `None` where that is measured and is not known.
    pub fn place(&self, point: &Point) -> Option<f64> {
        point
            .along
            .map_or(Some(point.x), |path| self.value(point, path))
    }

    /// Our number for a quotation.
    pub fn answer(&self, ask: &Ask) -> Option<f64> {
        self.at(ask.series, ask.x, ask.path)
    }

    fn points(&self, series: &str) -> &'r [Point] {
        let found = self.series.iter().find(|found| found.label == series);
        found.map_or(&[], |series| &series.points)
    }
}

/// What a place on an axis is called.
pub fn place_name(axis: &Axis, x: f64) -> String {
    match &axis.scale {
        Scale::Names(names) => names.get(x as usize).cloned().unwrap_or_default(),
        Scale::Linear | Scale::Close | Scale::Log if x.fract() == 0.0 && x >= 0.0 => {
            count(x as u64)
        }
        Scale::Linear | Scale::Close | Scale::Log => format!("{x}"),
    }
}

impl Numbers for Results<'_> {
    fn labels(&self) -> Vec<String> {
        self.series
            .iter()
            .map(|series| series.label.clone())
            .collect()
    }

    fn places(&self, series: &str) -> Vec<f64> {
        let points = self.points(series).iter();
        points.filter_map(|point| self.place(point)).collect()
    }

    fn at(&self, series: &str, x: f64, path: &str) -> Option<f64> {
        let mut points = self.points(series).iter();
        let point = points.find(|point| self.place(point) == Some(x))?;
        self.value(point, path)
    }

    fn place_name(&self, x: f64) -> String {
        match &self.axis.scale {
            Scale::Names(_) => place_name(self.axis, x),
            Scale::Linear | Scale::Close | Scale::Log => {
                format!("{} {}", place_name(self.axis, x), self.axis.label)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::measured;

    #[test]
    fn a_point_that_asks_for_frames_reads_a_row_that_followed_a_motion() {
        let row = |temporal: Value| {
            let mut row = serde_json::to_value(measured("bowl", "linear")).unwrap();
            row["temporal"] = temporal;
            Row::read(row).unwrap()
        };
        let rows = [
            row(Value::Null),
            row(serde_json::json!({ "jumps": 0.25 })),
            row(Value::Null),
        ];
        let axis = Axis::linear("x");
        let results = Results {
            series: &[],
            axis: &axis,
            rows: &rows,
        };
        let still = Point::new(0.0, "bowl", "linear");
        let moving = Point {
            frames: Some(10),
            ..still.clone()
        };
        assert_eq!(results.index(&still), Some(0));
        assert_eq!(results.index(&moving), Some(1));
        assert_eq!(results.value(&moving, "temporal.jumps"), Some(0.25));
    }
}
