//! Diagrams as SVG that takes the page's text colour.

use anyhow::anyhow;
use plotters::prelude::*;

use super::words::escape;

/// A measured point of error against time.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Place of the technique among all.
    pub series: usize,
    /// What the point is, for people who hover over it.
    pub label: String,
    /// Milliseconds.
    pub time: f64,
    /// Degrees.
    pub error: f64,
}

/// Colours of the series, told apart by the colour-blind (Okabe and Ito), readable on light and
/// dark.
pub const SERIES: [&str; 6] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b08a00", "#56b4e9",
];

const SIZE: (u32, u32) = (760, 400);

/// Both axes logarithmic, a circle a point. Needs at least one point with positive coordinates.
pub fn error_against_time(points: &[Point]) -> anyhow::Result<Option<String>> {
    let points: Vec<&Point> = points
        .iter()
        .filter(|point| point.time > 0.0 && point.error > 0.0)
        .collect();
    if points.is_empty() {
        return Ok(None);
    }
    let times = decades(points.iter().map(|point| point.time));
    let errors = decades(points.iter().map(|point| point.error));
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        let failed = |error: &dyn std::fmt::Display| anyhow!("drawing the scatter plot: {error}");
        let mut chart = ChartBuilder::on(&root)
            .margin(10)
            .x_label_area_size(46)
            .y_label_area_size(70)
            .build_cartesian_2d(
                (times.0..times.1).log_scale(),
                (errors.0..errors.1).log_scale(),
            )
            .map_err(|error| failed(&error))?;
        chart
            .configure_mesh()
            .x_desc("time of a frame (ms)")
            .y_desc("median angular error (°)")
            .x_label_formatter(&|value| plain(*value))
            .y_label_formatter(&|value| plain(*value))
            .label_style(("sans-serif", 14))
            .axis_desc_style(("sans-serif", 15))
            .bold_line_style(BLACK.mix(0.18))
            .light_line_style(BLACK.mix(0.06))
            .draw()
            .map_err(|error| failed(&error))?;
        let circles = points.iter().map(|point| {
            let (red, green, blue) = rgb(SERIES[point.series % SERIES.len()]);
            Circle::new(
                (point.time, point.error),
                6,
                RGBColor(red, green, blue).mix(0.85).filled(),
            )
        });
        chart.draw_series(circles).map_err(|error| failed(&error))?;
        root.present().map_err(|error| failed(&error))?;
    }
    Ok(Some(for_the_page(&svg, &points)))
}

/// Whole decades around the values.
fn decades(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let low = values.clone().fold(f64::INFINITY, f64::min).log10().floor();
    let high = values.fold(f64::NEG_INFINITY, f64::max).log10().ceil();
    (10f64.powf(low), 10f64.powf(high.max(low + 1.0)))
}

fn plain(value: f64) -> String {
    let decimals = (-value.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

fn rgb(hex: &str) -> (u8, u8, u8) {
    let channel = |at: usize| {
        hex.get(at..at + 2)
            .and_then(|text| u8::from_str_radix(text, 16).ok())
            .unwrap_or(0)
    };
    (channel(1), channel(3), channel(5))
}

/// Takes the text colour instead of black, fits any width, and names its points.
fn for_the_page(svg: &str, points: &[&Point]) -> String {
    let (width, height) = SIZE;
    let fixed = format!("width=\"{width}\" height=\"{height}\" ");
    let text = svg
        .replace("#000000", "currentColor")
        .replacen(&fixed, "", 1);
    // Inside HTML the namespace goes without saying, and the page names no address.
    let mut text = text.replace(" xmlns=\"http://www.w3.org/2000/svg\"", "");
    if let Some(start) = text.find("<svg ") {
        text.replace_range(
            ..start + 5,
            "<svg role=\"img\" aria-labelledby=\"scatter-title\" ",
        );
    }
    let mut named = String::with_capacity(text.len());
    let mut labels = points.iter().map(|point| point.label.as_str());
    for line in text.lines() {
        match line
            .strip_prefix("<circle ")
            .and_then(|circle| circle.strip_suffix("/>"))
        {
            Some(circle) => {
                let label = escape(labels.next().unwrap_or_default());
                named.push_str(&format!("<circle {circle}><title>{label}</title></circle>"));
            }
            None => named.push_str(line),
        }
        named.push('\n');
    }
    named
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(time: f64, error: f64) -> Point {
        Point {
            series: 0,
            label: "a <b>".to_owned(),
            time,
            error,
        }
    }

    #[test]
    fn a_plot_has_a_titled_circle_for_every_point() {
        let svg = error_against_time(&[point(1.0, 0.1), point(20.0, 3.0)])
            .unwrap()
            .unwrap();
        assert_eq!(svg.matches("<circle ").count(), 2);
        assert_eq!(svg.matches("<title>a &lt;b&gt;</title>").count(), 2);
        assert!(
            !svg.contains("#000000") && svg.starts_with("<svg role"),
            "{svg}"
        );
    }

    #[test]
    fn nothing_to_draw_is_no_plot() {
        assert_eq!(
            error_against_time(&[point(0.0, 0.1), point(f64::NAN, 1.0)]).unwrap(),
            None
        );
    }
}
