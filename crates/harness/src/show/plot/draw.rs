//! Axes, grid and lines of a diagram, drawn by plotters.

use anyhow::anyhow;
use plotters::prelude::*;

use super::axis::{Extent, Scale};
use super::data::{Mark, Plot, SERIES, WIDTH};
use super::{names, svg};

/// Around every plot.
const MARGIN: u32 = 12;
/// Room for the numbers at the y axis.
const LEFT: u32 = 78;

/// A point that can be shown: its series, its place on the axes, and itself.
struct Shown<'p> {
    series: usize,
    place: (f64, f64),
    point: &'p Mark,
}

impl Plot {
    /// The diagram as part of a page; `None` where no point can be shown.
    pub fn inline(&self) -> anyhow::Result<Option<String>> {
        let drawn = self.draw()?;
        Ok(drawn.map(|drawn| svg::inline(&drawn, self)))
    }

    /// The diagram as a file of its own; `None` where no point can be shown.
    pub fn file(&self) -> anyhow::Result<Option<String>> {
        let drawn = self.draw()?;
        Ok(drawn.map(|drawn| svg::file(&drawn, self)))
    }

    fn shown(&self) -> Vec<Shown<'_>> {
        let points = self.series.iter().enumerate();
        let points = points.flat_map(|(series, all)| all.points.iter().map(move |p| (series, p)));
        points
            .filter_map(|(series, point)| {
                let place = (
                    self.x.place(point.x)? + self.aside(series),
                    self.y.place(point.y)?,
                );
                Some(Shown {
                    series,
                    place,
                    point,
                })
            })
            .collect()
    }

    /// How far a series steps aside, so that what stands at one name is told apart.
    fn aside(&self, series: usize) -> f64 {
        match self.x.scale {
            Scale::Names(_) => {
                let middle = (self.series.len() as f64 - 1.0) / 2.0;
                (series as f64 - middle) * 0.6 / self.series.len() as f64
            }
            Scale::Linear | Scale::Close | Scale::Log => 0.0,
        }
    }

    fn draw(&self) -> anyhow::Result<Option<svg::Drawn>> {
        let shown = self.shown();
        let x = self.x.extent(shown.iter().map(|point| point.place.0));
        let y = self.y.extent(shown.iter().map(|point| point.place.1));
        let (Some(x), Some(y)) = (x, y) else {
            return Ok(None);
        };
        let drawn = self
            .axes_and_lines(&shown, x, y)
            .map_err(|error| anyhow!("drawing `{}`: {error}", self.title))?;
        Ok(Some(drawn))
    }

    /// Everything but the legend; names along the x axis take what room they need.
    fn axes_and_lines(
        &self,
        shown: &[Shown<'_>],
        x: Extent,
        y: Extent,
    ) -> Result<svg::Drawn, Box<dyn std::error::Error>> {
        let labelled = !matches!(self.y.scale, Scale::Names(_));
        let names = match &self.x.scale {
            Scale::Names(names) => Some(names::Layout::of(names, WIDTH - 2 * MARGIN - LEFT)),
            _ => None,
        };
        let room = names.as_ref().map_or(0, |names| names.room);
        let height = self.height + room;
        let mut body = String::new();
        let root = SVGBackend::with_string(&mut body, (WIDTH, height)).into_drawing_area();
        let floor = y.range[0];
        let ticks = (x.bold.len(), if labelled { y.bold.len() } else { 0 });
        let tick = |place: f64| match &names {
            Some(_) => String::new(),
            None => self.x.tick(place),
        };
        let places = x.bold.clone();
        let mut chart = ChartBuilder::on(&root)
            .margin(MARGIN)
            .x_label_area_size(52 + room)
            .y_label_area_size(if labelled { LEFT } else { 12 })
            .build_cartesian_2d(x, y)
            .map_err(|error| error.to_string())?;
        chart
            .configure_mesh()
            .x_desc(self.x.label.as_str())
            .y_desc(self.y.label.as_str())
            .x_labels(ticks.0)
            .y_labels(ticks.1)
            .x_label_formatter(&|place| tick(*place))
            .y_label_formatter(&|place| self.y.tick(*place))
            .label_style(("sans-serif", 16))
            .axis_desc_style(("sans-serif", 17))
            .axis_style(BLACK.mix(0.5))
            .bold_line_style(BLACK.mix(0.16))
            .light_line_style(BLACK.mix(0.06))
            .draw()
            .map_err(|error| error.to_string())?;
        if self.joined {
            for series in 0..self.series.len() {
                let line = shown.iter().filter(|point| point.series == series);
                let line =
                    LineSeries::new(line.map(|point| point.place), color(series).stroke_width(2));
                chart.draw_series(line).map_err(|error| error.to_string())?;
            }
        }
        if matches!(self.x.scale, Scale::Names(_)) {
            for point in shown {
                let (x, y) = point.place;
                let stem =
                    LineSeries::new([(x, floor), (x, y)], color(point.series).stroke_width(3));
                chart.draw_series(stem).map_err(|error| error.to_string())?;
            }
        }
        let markers = shown.iter().map(|point| svg::Marker {
            series: point.series,
            at: chart.backend_coord(&point.place),
            name: point.point.name.clone(),
            label: point.point.label.clone(),
        });
        let markers = markers.collect();
        let named = names.map(|names| {
            let at = places
                .iter()
                .map(|place| chart.backend_coord(&(*place, floor)));
            (names, at.collect())
        });
        root.present().map_err(|error| error.to_string())?;
        drop(chart);
        drop(root);
        Ok(svg::Drawn {
            body,
            height,
            markers,
            named,
        })
    }
}

fn color(series: usize) -> RGBColor {
    let hex = SERIES[series % SERIES.len()];
    let channel = |at: usize| {
        let digits = hex.get(at..at + 2);
        digits.and_then(|text| u8::from_str_radix(text, 16).ok())
    };
    RGBColor(
        channel(1).unwrap_or(0),
        channel(3).unwrap_or(0),
        channel(5).unwrap_or(0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::show::plot::{Axis, Curve, TALL};

    fn plot(points: &[(f64, f64)]) -> Plot {
        let point = |&(x, y): &(f64, f64)| Mark {
            x,
            y,
            name: String::new(),
            label: "a <b>".to_owned(),
        };
        Plot {
            title: "error \"against\" time".to_owned(),
            x: Axis::log("time (ms)"),
            y: Axis::log("error (°)"),
            series: vec![Curve {
                label: "linear".to_owned(),
                points: points.iter().map(point).collect(),
            }],
            height: TALL,
            joined: true,
        }
    }

    #[test]
    fn a_plot_has_a_titled_marker_for_every_point() {
        let svg = plot(&[(1.0, 0.1), (20.0, 3.0)]).inline().unwrap().unwrap();
        assert_eq!(svg.matches("<title>a &lt;b&gt;</title>").count(), 2);
        assert!(svg.starts_with("<svg role=\"img\""), "{svg}");
        assert!(!svg.contains("#000000") && !svg.contains("http"), "{svg}");
        assert!(svg.contains(">linear</text>"), "the legend");
    }

    #[test]
    fn a_file_stands_alone_in_light_and_dark() {
        let svg = plot(&[(1.0, 0.1), (20.0, 3.0)]).file().unwrap().unwrap();
        for part in ["http://www.w3.org/2000/svg", "prefers-color-scheme: dark"] {
            assert!(svg.contains(part), "{part}");
        }
    }

    #[test]
    fn nothing_to_draw_is_no_plot() {
        let svg = plot(&[(0.0, 0.1), (f64::NAN, 1.0)]).inline().unwrap();
        assert_eq!(svg, None);
    }

    #[test]
    fn drawing_is_the_same_every_time() {
        let plot = plot(&[(1.0, 0.1), (3.0, 0.2)]);
        assert_eq!(plot.inline().unwrap(), plot.inline().unwrap());
    }
}
