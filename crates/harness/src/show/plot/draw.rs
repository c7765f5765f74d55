//! A diagram as SVG: grid, axes, lines, then what is set upon them (`svg`).

use super::axis::{Extent, Scale};
use super::data::{Mark, Plot, SERIES, WIDTH};
use super::{names, svg};
use crate::show::html::escape;

/// Around every plot.
const MARGIN: u32 = 12;
/// Room for the label of the y axis, and at least for the numbers at it.
const TITLE: u32 = 26;
const NUMBERS: u32 = 52;
/// The same at an axis without numbers.
const BARE: u32 = 12;
/// Room for the numbers at the x axis, and for its label.
const BELOW: u32 = 52;
/// Size of the labels at the axes, and the width of a character as a share of it, about.
const LABEL: f64 = 17.0;
const CHARACTER: f64 = 0.52;
/// Width of a digit as a share of its size, about.
const DIGIT: f64 = 0.6;
/// Size of the numbers at the axes.
const NUMBER: f64 = 16.0;
/// Length of the marks at labelled places of an axis, and from there to the end of a number at the y axis.
const TICK: f64 = 5.0;
const ASIDE: f64 = 4.0;

/// A point that can be shown: its series, its place on the axes, and itself.
struct Shown<'p> {
    series: usize,
    place: (f64, f64),
    point: &'p Mark,
}

/// Where the axes lie in the drawing's units, from the top left.
struct Area {
    x: Extent,
    y: Extent,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Area {
    fn at_x(&self, place: f64) -> f64 {
        self.left + (self.right - self.left) * self.x.share(place)
    }

    fn at_y(&self, place: f64) -> f64 {
        self.bottom + (self.top - self.bottom) * self.y.share(place)
    }

    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.at_x(x), self.at_y(y))
    }
}

impl Plot {
    /// The diagram as part of a page; `None` where no point can be shown.
    pub fn inline(&self) -> Option<String> {
        self.draw().map(|drawn| svg::inline(&drawn, self))
    }

    /// The diagram as a file of its own; `None` where no point can be shown.
    pub fn file(&self) -> Option<String> {
        self.draw().map(|drawn| svg::file(&drawn, self))
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

    fn draw(&self) -> Option<svg::Drawn> {
        let shown = self.shown();
        let x = self.x.extent(shown.iter().map(|point| point.place.0))?;
        let y = self.y.extent(shown.iter().map(|point| point.place.1))?;
        let left = self.room_left(&y);
        let names = match &self.x.scale {
            Scale::Names(names) => Some(names::Layout::of(names, WIDTH - 2 * MARGIN - left)),
            Scale::Linear | Scale::Close | Scale::Log => None,
        };
        // Names along the x axis take what room they need.
        let room = names.as_ref().map_or(0, |names| names.room);
        let height = self.height + room;
        let area = Area {
            x,
            y,
            left: f64::from(MARGIN + left),
            right: f64::from(WIDTH - MARGIN),
            top: f64::from(MARGIN),
            bottom: f64::from(height - MARGIN - BELOW - room),
        };
        let mut body = String::new();
        grid(&area, &mut body);
        self.axes(&area, height, &mut body);
        self.lines(&area, &shown, &mut body);
        if let Some(names) = &names {
            let places = area.x.bold.iter().map(|place| area.at_x(*place));
            body += &names.svg(places, area.bottom);
        }
        let markers = shown.iter().map(|point| {
            let (x, y) = area.at(point.place);
            svg::Marker {
                series: point.series,
                at: (x.round() as i32, y.round() as i32),
                name: point.point.name.clone(),
                label: point.point.label.clone(),
            }
        });
        Some(svg::Drawn {
            body,
            height,
            markers: markers.collect(),
        })
    }

    /// Room at the left of the y axis: for its longest number and its label.
    fn room_left(&self, y: &Extent) -> u32 {
        if !self.y.is_labelled() {
            return BARE;
        }
        let widths = y.bold.iter().map(|place| width(&self.y.tick(*place)));
        let longest = widths.fold(0.0, f64::max) + TICK + ASIDE;
        TITLE + NUMBERS.max(longest.ceil() as u32)
    }

    /// The axes with their numbers and labels.
    fn axes(&self, area: &Area, height: u32, body: &mut String) {
        let Area {
            left,
            right,
            top,
            bottom,
            ..
        } = *area;
        let mut path = format!("M{left} {top}V{bottom}H{right}");
        let mut text = String::new();
        if matches!(self.x.scale, Scale::Linear | Scale::Close | Scale::Log) {
            for place in &area.x.bold {
                let x = area.at_x(*place);
                path += &format!("M{x:.1} {bottom}v{TICK}");
            }
            for (x, tick) in self.x.apart(&area.x.bold, |place| area.at_x(place)) {
                // A number at the end of the axis stays in the drawing.
                let x = x.min(f64::from(WIDTH) - 0.5 * width(&tick));
                let tick = escape(&tick);
                text += &format!(
                    "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{tick}</text>\n",
                    bottom + 20.0
                );
            }
        }
        if self.y.is_labelled() {
            for place in &area.y.bold {
                let y = area.at_y(*place);
                let tick = escape(&self.y.tick(*place));
                path += &format!("M{left} {y:.1}h-{TICK}");
                text += &format!(
                    "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{tick}</text>\n",
                    left - TICK - ASIDE,
                    y + 5.5
                );
            }
        }
        *body += &format!(
            "<path d=\"{path}\" fill=\"none\" stroke=\"currentColor\" opacity=\"0.5\"/>\n\
             <g font-size=\"{NUMBER}\" fill=\"currentColor\">\n{text}</g>\n"
        );
        let [middle_x, middle_y] = [0.5 * (left + right), 0.5 * (top + bottom)];
        let turned_x = f64::from(MARGIN) + 8.0;
        // A long label along the y axis is set smaller, so that it fits the drawing's height.
        let characters = self.y.label.chars().count().max(1) as f64;
        let fitting = (f64::from(height) / (CHARACTER * characters)).min(LABEL);
        let middle_y = middle_y.max(0.5 * CHARACTER * fitting * characters);
        *body += &format!(
            "<g font-size=\"{LABEL}\" fill=\"currentColor\" text-anchor=\"middle\">\n\
             <text x=\"{middle_x}\" y=\"{}\">{}</text>\n\
             <text x=\"{turned_x}\" y=\"{middle_y}\" font-size=\"{fitting:.1}\" \
             transform=\"rotate(-90 {turned_x} {middle_y})\">{}</text>\n</g>\n",
            height - MARGIN - 4,
            escape(&self.x.label),
            escape(&self.y.label)
        );
    }

    /// What joins the points of a series, or holds up those at names.
    fn lines(&self, area: &Area, shown: &[Shown<'_>], body: &mut String) {
        let mut line = |series: usize, width: u32, path: &str| {
            let color = SERIES[series % SERIES.len()];
            *body += &format!(
                "<path d=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"/>\n"
            );
        };
        if self.joined {
            for series in 0..self.series.len() {
                let points = shown.iter().filter(|point| point.series == series);
                let mut path = String::new();
                for point in points {
                    let (x, y) = area.at(point.place);
                    let step = if path.is_empty() { 'M' } else { 'L' };
                    path += &format!("{step}{x:.1} {y:.1}");
                }
                if !path.is_empty() {
                    line(series, 2, &path);
                }
            }
        }
        if matches!(self.x.scale, Scale::Names(_)) {
            for point in shown {
                let (x, y) = area.at(point.place);
                let path = format!("M{x:.1} {}V{y:.1}", area.bottom);
                line(point.series, 3, &path);
            }
        }
    }
}

/// Width of a number at an axis, about.
fn width(number: &str) -> f64 {
    NUMBER * DIGIT * number.chars().count() as f64
}

/// The lines behind a drawing: stronger ones at labelled places.
fn grid(area: &Area, body: &mut String) {
    let lines = |x: &[f64], y: &[f64]| {
        let (top, bottom) = (area.top, area.bottom);
        let upright = x
            .iter()
            .map(|x| format!("M{:.1} {top}V{bottom}", area.at_x(*x)));
        let (left, right) = (area.left, area.right);
        let level = y
            .iter()
            .map(|y| format!("M{left} {:.1}H{right}", area.at_y(*y)));
        upright.chain(level).collect::<String>()
    };
    for (path, opacity) in [
        (lines(&area.x.light, &area.y.light), 0.06),
        (lines(&area.x.bold, &area.y.bold), 0.16),
    ] {
        *body += &format!("<path d=\"{path}\" stroke=\"currentColor\" opacity=\"{opacity}\"/>\n");
    }
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
        let svg = plot(&[(1.0, 0.1), (20.0, 3.0)]).inline().unwrap();
        assert_eq!(svg.matches("<title>a &lt;b&gt;</title>").count(), 2);
        assert!(svg.starts_with("<svg role=\"img\""), "{svg}");
        assert!(!svg.contains("http"), "{svg}");
        assert!(svg.contains(">linear</text>"), "the legend");
    }

    /// Of the texts of a kind, where they begin, or end.
    fn places(svg: &str, anchor: &str) -> Vec<(f64, usize)> {
        let texts = svg.split("<text ").skip(1);
        let texts = texts.filter(|text| text.contains(anchor));
        let texts = texts.map(|text| {
            let x = text.split('"').nth(1).unwrap().parse().unwrap();
            let said = text.split(['>', '<']).nth(1).unwrap();
            (x, said.chars().count())
        });
        texts.collect()
    }

    #[test]
    fn long_numbers_have_room_at_both_axes() {
        let svg = plot(&[(2e3, 1e5), (1e6, 9e6)]).inline().unwrap();
        let numbers = places(&svg, "text-anchor=\"end\"");
        assert!(
            numbers.iter().any(|(_, characters)| *characters == 9),
            "{numbers:?}"
        );
        for (end, characters) in numbers {
            let begin = end - NUMBER * DIGIT * characters as f64;
            // The label's size, from the middle of which it reaches to both sides.
            assert!(begin > f64::from(MARGIN) + 8.0 + 0.5 * LABEL, "{begin}");
        }
        let numbers = places(&svg, "text-anchor=\"middle\"");
        assert!(!numbers.is_empty());
        for (middle, characters) in numbers {
            let end = middle + 0.5 * NUMBER * DIGIT * characters as f64;
            assert!(end <= f64::from(WIDTH), "{end}");
        }
    }

    #[test]
    fn a_file_stands_alone_in_light_and_dark() {
        let svg = plot(&[(1.0, 0.1), (20.0, 3.0)]).file().unwrap();
        for part in ["http://www.w3.org/2000/svg", "prefers-color-scheme: dark"] {
            assert!(svg.contains(part), "{part}");
        }
    }

    #[test]
    fn nothing_to_draw_is_no_plot() {
        let svg = plot(&[(0.0, 0.1), (f64::NAN, 1.0)]).inline();
        assert_eq!(svg, None);
    }
}
