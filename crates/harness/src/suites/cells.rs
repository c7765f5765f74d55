//! Tables with coloured cells, for figures with few places or with names along their axis, which
//! plots would show less well.

use crate::record::metric::{Better, Unit};
use crate::record::metrics;
use crate::show::number::{count, percent, significant};
use crate::show::plot::Scale;

use super::figure::{Figure, Quantity};
use super::results::{Results, place_name};
use super::series::Point;

/// With so many places or fewer, a plot shows no more than a table.
const FEW: usize = 3;
/// With so many series or fewer, one table holds all quantities.
const NARROW: usize = 2;
/// Best and worst, told apart by the colour-blind, on light and on dark paper.
const GOOD: [u8; 3] = [42, 134, 200];
const BAD: [u8; 3] = [221, 106, 19];
/// In place of a number that is not known.
const NONE: &str = "–";
/// How much of a colour the best and the worst cell have.
const STRONGEST: f64 = 0.55;
/// From this ratio of the largest to the least on, colours go by ratios.
const WIDE: f64 = 5.0;

/// A table of numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// What all its numbers are; empty where each column says so itself.
    pub title: String,
    /// Over the first column, then over the numbers.
    pub heading: Vec<String>,
    /// One a row.
    pub rows: Vec<Line>,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Before the numbers.
    pub name: String,
    /// One a column.
    pub cells: Vec<Cell>,
}

/// A number of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// As it is written.
    pub text: String,
    /// Its colour as CSS; empty where it has none.
    pub style: String,
    /// Why there is no number, or what it is.
    pub hint: String,
}

/// The tables that stand in place of a figure's plots; `None` where plots say more.
pub fn grids(figure: &Figure, results: &Results<'_>) -> Option<Vec<Grid>> {
    let mut places: Vec<f64> = Vec::new();
    let points = || figure.series.iter().flat_map(|series| &series.points);
    if points().any(|point| point.along.is_some()) {
        return None;
    }
    for point in points() {
        if !places.contains(&point.x) {
            places.push(point.x);
        }
    }
    places.sort_by(f64::total_cmp);
    let names = matches!(figure.axis.scale, Scale::Names(_));
    if places.len() > FEW && !names {
        return None;
    }
    let whole = places.len() <= FEW || figure.series.len() <= NARROW;
    Some(match whole {
        true => vec![by_quantity(figure, results)],
        false => (figure.quantities.iter())
            .map(|quantity| by_series(figure, quantity, results, &places))
            .collect(),
    })
}

/// All points, a row each; all quantities, a column each.
fn by_quantity(figure: &Figure, results: &Results<'_>) -> Grid {
    let several = figure.series.len() > 1;
    let mut grid = Grid {
        heading: vec![figure.axis.label.clone()],
        ..Grid::default()
    };
    grid.heading
        .extend(figure.quantities.iter().map(Quantity::label));
    let points = || {
        let series = figure.series.iter();
        series.flat_map(|series| series.points.iter().map(move |point| (series, point)))
    };
    let columns = figure.quantities.iter().map(|quantity| {
        let points: Vec<&Point> = points().map(|(_, point)| point).collect();
        cells(quantity, &points, results)
    });
    let columns: Vec<Vec<Cell>> = columns.collect();
    grid.rows = points()
        .enumerate()
        .map(|(row, (series, point))| {
            let place = place_name(&figure.axis, point.x);
            Line {
                name: match several {
                    true => format!("{}: {place}", series.label),
                    false => place,
                },
                cells: columns.iter().map(|column| column[row].clone()).collect(),
            }
        })
        .collect();
    grid.without_empty_columns()
}

/// Places down, series across, one quantity.
fn by_series(figure: &Figure, quantity: &Quantity, results: &Results<'_>, places: &[f64]) -> Grid {
    let at = |x: f64| {
        let series = figure.series.iter();
        series.map(move |series| series.points.iter().find(|point| point.x == x))
    };
    let all = places.iter().flat_map(|x| at(*x).flatten());
    let all: Vec<&Point> = all.collect();
    let mut colored = cells(quantity, &all, results).into_iter();
    let rows = places.iter().map(|x| {
        let cells = at(*x).map(|point| point.and_then(|_| colored.next()));
        Line {
            name: place_name(&figure.axis, *x),
            cells: cells
                .map(|cell| cell.unwrap_or_else(|| blank(String::new())))
                .collect(),
        }
    });
    let rows = rows.collect();
    let series = figure.series.iter().map(|series| series.label.clone());
    let grid = Grid {
        title: quantity.label(),
        heading: [figure.axis.label.clone()]
            .into_iter()
            .chain(series)
            .collect(),
        rows,
    };
    // What could not be measured here stands among all points, with the reason.
    grid.without_empty_columns().without_empty_rows()
}

impl Grid {
    fn without_empty_rows(mut self) -> Self {
        let is_empty = |row: &Line| row.cells.iter().all(|cell| cell.text == NONE);
        self.rows.retain(|row| !is_empty(row));
        self
    }

    fn without_empty_columns(mut self) -> Self {
        let empty = |column: usize| {
            let cells = self.rows.iter().map(|row| &row.cells[column]);
            cells.into_iter().all(|cell| cell.text == NONE)
        };
        let kept: Vec<usize> = (0..self.heading.len() - 1)
            .filter(|column| !empty(*column))
            .collect();
        for row in &mut self.rows {
            row.cells = kept
                .iter()
                .map(|column| row.cells[*column].clone())
                .collect();
        }
        let headings = kept.iter().map(|column| self.heading[column + 1].clone());
        self.heading = [self.heading[0].clone()]
            .into_iter()
            .chain(headings)
            .collect();
        self
    }
}

fn blank(hint: String) -> Cell {
    Cell {
        text: NONE.to_owned(),
        style: String::new(),
        hint,
    }
}

/// The numbers of a quantity, coloured from its best to its worst.
fn cells(quantity: &Quantity, points: &[&Point], results: &Results<'_>) -> Vec<Cell> {
    let metric = metrics::known(quantity.path);
    let values: Vec<Option<f64>> = points
        .iter()
        .map(|point| results.value(point, quantity.path))
        .collect();
    let colors = colors_by_scene(points, &values, metric.better);
    let cells = values.iter().zip(points).zip(colors);
    cells
        .map(|((value, point), style)| match value {
            None => blank(results.reason(point).unwrap_or_default().to_owned()),
            Some(value) => Cell {
                text: match metric.unit {
                    Unit::Share => percent(*value),
                    Unit::Count if value.fract() == 0.0 && *value >= 0.0 => count(*value as u64),
                    _ => significant(*value),
                },
                style,
                hint: format!("{}, {}", point.scene, point.technique),
            },
        })
        .collect()
}

/// Colours among the points of each scene; among all of them where no scene has several.
fn colors_by_scene(points: &[&Point], values: &[Option<f64>], better: Better) -> Vec<String> {
    let on = |scene: &str| -> Vec<usize> {
        let all = points.iter().enumerate();
        let all = all.filter(|(_, point)| point.scene == scene);
        all.map(|(place, _)| place).collect()
    };
    if points.iter().all(|point| on(&point.scene).len() < 2) {
        return colors(values, better);
    }
    let mut all = vec![String::new(); values.len()];
    for point in points {
        let places = on(&point.scene);
        let own: Vec<Option<f64>> = places.iter().map(|place| values[*place]).collect();
        for (place, color) in places.into_iter().zip(colors(&own, better)) {
            all[place] = color;
        }
    }
    all
}

/// A colour for each value, as CSS: blue for the best, orange for the worst, none in the middle.
fn colors(values: &[Option<f64>], better: Better) -> Vec<String> {
    let finite = || {
        values
            .iter()
            .flatten()
            .copied()
            .filter(|value| value.is_finite())
    };
    let least = finite().fold(f64::INFINITY, f64::min);
    let most = finite().fold(f64::NEG_INFINITY, f64::max);
    let ratios = least > 0.0 && most > WIDE * least;
    let place = |value: f64| if ratios { value.ln() } else { value };
    let color = |value: f64| {
        if better == Better::Neither || most <= least || !value.is_finite() {
            return String::new();
        }
        let share = (place(value) - place(least)) / (place(most) - place(least));
        let good = match better {
            Better::High => 2.0 * share - 1.0,
            Better::Low | Better::Neither => 1.0 - 2.0 * share,
        };
        let [red, green, blue] = if good > 0.0 { GOOD } else { BAD };
        let strength = STRONGEST * good.abs();
        format!("background: rgba({red}, {green}, {blue}, {strength:.2})")
    };
    values
        .iter()
        .map(|value| value.map_or_else(String::new, color))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_is_blue_and_the_worst_orange_whichever_way_is_better() {
        let values = [Some(0.2), None, Some(0.9)];
        let high = colors(&values, Better::High);
        let low = colors(&values, Better::Low);
        assert!(high[2].contains("42, 134, 200, 0.55") && high[0].contains("221, 106, 19, 0.55"));
        assert!(low[0].contains("42, 134, 200") && low[2].contains("221, 106, 19"));
        assert_eq!((high[1].as_str(), low[1].as_str()), ("", ""));
    }

    #[test]
    fn what_has_no_number_takes_no_room() {
        let cell = |text: &str| Cell {
            text: text.to_owned(),
            ..blank(String::new())
        };
        let row = |name: &str, cells: [&str; 3]| Line {
            name: name.to_owned(),
            cells: cells.map(cell).to_vec(),
        };
        let grid = Grid {
            title: String::new(),
            heading: ["scene", "a", "b", "c"].map(str::to_owned).to_vec(),
            rows: vec![
                row("one", ["1", NONE, NONE]),
                row("none", [NONE; 3]),
                row("two", ["1", NONE, "3"]),
            ],
        };
        let grid = grid.without_empty_columns().without_empty_rows();
        assert_eq!(grid.heading, ["scene", "a", "c"]);
        assert_eq!(
            grid.rows,
            [row("one", ["1", NONE, NONE]), row("two", ["1", NONE, "3"])].map(|mut row| {
                row.cells.remove(1);
                row
            })
        );
    }

    #[test]
    fn techniques_are_compared_scene_by_scene() {
        let points = ["a", "a", "b", "b"].map(|scene| Point::new(0.0, scene, "linear"));
        let points: Vec<&Point> = points.iter().collect();
        let values = [1.0, 2.0, 100.0, 200.0].map(Some);
        let colors = colors_by_scene(&points, &values, Better::Low);
        assert_eq!(colors[0], colors[2]);
        assert_eq!(colors[1], colors[3]);
        assert_ne!(colors[0], colors[1]);
    }

    #[test]
    fn equal_values_have_no_colour() {
        assert!(
            colors(&[Some(1.0), Some(1.0)], Better::High)
                .iter()
                .all(String::is_empty)
        );
        assert!(
            colors(&[Some(1.0), Some(2.0)], Better::Neither)
                .iter()
                .all(String::is_empty)
        );
    }

    #[test]
    fn wide_ranges_are_coloured_by_ratios() {
        let colors = colors(&[Some(1.0), Some(10.0), Some(100.0)], Better::Low);
        assert!(colors[1].ends_with("0.00)"), "{colors:?}");
    }
}
