//! What is set around and upon a drawing: markers and their names, the legend, the colours of a page
//! or of a file.

use crate::show::html::escape;

use super::data::{Plot, SERIES, WIDTH};

/// A drawing without markers and legend.
pub struct Drawn {
    /// Grid, axes and lines.
    pub body: String,
    /// Of the drawing.
    pub height: u32,
    /// In the order in which they are set.
    pub markers: Vec<Marker>,
}

/// A point's mark.
pub struct Marker {
    /// Decides colour and shape.
    pub series: usize,
    /// In the drawing's units, from the top left.
    pub at: (i32, i32),
    /// Written beside it; may be empty.
    pub name: String,
    /// Said when hovered over.
    pub label: String,
}

/// Height of a line of the legend.
const LINE: u32 = 24;
/// Width of a character of the legend, about.
const CHARACTER: u32 = 9;
/// Size of the names beside markers.
const NAME_SIZE: i32 = 13;

/// The drawing as part of a page.
pub fn inline(drawn: &Drawn, plot: &Plot) -> String {
    let title = escape(&plot.title);
    let (body, height) = complete(drawn, plot);
    format!(
        "<svg role=\"img\" aria-label=\"{title}\" viewBox=\"0 0 {WIDTH} {height}\" \
         font-family=\"inherit\">\n{body}</svg>\n"
    )
}

/// The drawing as a file.
pub fn file(drawn: &Drawn, plot: &Plot) -> String {
    let title = escape(&plot.title);
    let (body, height) = complete(drawn, plot);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         width=\"{WIDTH}\" height=\"{height}\">\n<title>{title}</title>\n<style>\
         svg {{ color: #1c1d20; background: #fdfdfb; font-family: sans-serif; }} \
         @media (prefers-color-scheme: dark) {{ svg {{ color: #e6e6e3; background: #16171a; }} }}\
         </style>\n{body}</svg>\n"
    )
}

/// The inside of the SVG, and its height.
fn complete(drawn: &Drawn, plot: &Plot) -> (String, u32) {
    let mut body = drawn.body.clone();
    for marker in &drawn.markers {
        let (x, y) = (f64::from(marker.at.0), f64::from(marker.at.1));
        let shape = shape(marker.series, x, y);
        body += &format!("<g>{shape}<title>{}</title></g>\n", escape(&marker.label));
    }
    for (name, (x, y)) in names(&drawn.markers) {
        body += &format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{NAME_SIZE}\" fill=\"currentColor\" \
             opacity=\"0.75\">{}</text>\n",
            escape(name)
        );
    }
    let height = drawn.height + legend(plot, drawn.height, &mut body);
    (body, height)
}

/// A mark that is told apart without its colour, too.
fn shape(series: usize, x: f64, y: f64) -> String {
    let color = SERIES[series % SERIES.len()];
    let path = match series % 4 {
        0 => return format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"5\" fill=\"{color}\"/>"),
        1 => format!("M{} {}h9v9h-9z", x - 4.5, y - 4.5),
        2 => format!("M{x} {}l6 6l-6 6l-6 -6z", y - 6.0),
        _ => format!("M{x} {}l6 10.5h-12z", y - 6.5),
    };
    format!("<path d=\"{path}\" fill=\"{color}\"/>")
}

/// Sets the legend under a drawing of height `top`, as many entries a line as fit, and returns its
/// height.
fn legend(plot: &Plot, top: u32, body: &mut String) -> u32 {
    let (mut x, mut line) = (14, 0);
    let named = plot.series.iter().enumerate();
    let named = named.filter(|(_, series)| !series.points.is_empty());
    for (series, label) in named.map(|(place, series)| (place, &series.label)) {
        let width = 30 + CHARACTER * label.chars().count() as u32;
        if x > 14 && x + width > WIDTH {
            (x, line) = (14, line + 1);
        }
        let y = top + LINE * line + LINE / 2;
        *body += &shape(series, f64::from(x), f64::from(y));
        *body += &format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"16\" fill=\"currentColor\">{}</text>\n",
            x + 12,
            y + 5,
            escape(label)
        );
        x += width;
    }
    LINE * (line + 1) + 4
}

/// Places for the names of markers: right, left, above or below, wherever it is emptiest.
fn names(markers: &[Marker]) -> Vec<(&str, (i32, i32))> {
    let dot = |marker: &Marker| {
        let (x, y) = marker.at;
        [x - 6, y - 6, x + 6, y + 6]
    };
    let mut taken: Vec<[i32; 4]> = markers.iter().map(dot).collect();
    let mut placed = Vec::new();
    for marker in markers.iter().filter(|marker| !marker.name.is_empty()) {
        let width = 7 * marker.name.chars().count() as i32;
        let (x, y) = marker.at;
        let candidates = [
            (x + 9, y + 5),
            (x - 9 - width, y + 5),
            (x - width / 2, y - 10),
            (x - width / 2, y + 19),
        ];
        let overlap = |&(x, y): &(i32, i32)| {
            let area = [x, y - NAME_SIZE, x + width, y + 3];
            let outside = (area[2] - WIDTH as i32 + 8).max(90 - area[0]).max(0) * 100;
            outside + taken.iter().map(|other| shared(&area, other)).sum::<i32>()
        };
        let best = candidates.into_iter().min_by_key(overlap);
        if let Some((x, y)) = best {
            taken.push([x, y - NAME_SIZE, x + width, y + 3]);
            placed.push((marker.name.as_str(), (x, y)));
        }
    }
    placed
}

/// The area that two boxes (left, top, right, bottom) share.
fn shared(a: &[i32; 4], b: &[i32; 4]) -> i32 {
    let width = a[2].min(b[2]) - a[0].max(b[0]);
    let height = a[3].min(b[3]) - a[1].max(b[1]);
    width.max(0) * height.max(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_clear_of_each_other() {
        let marker = |x, y| Marker {
            series: 0,
            at: (x, y),
            name: "a-scene".to_owned(),
            label: String::new(),
        };
        let markers = [marker(300, 100), marker(340, 100), marker(320, 120)];
        let placed = names(&markers);
        let boxes: Vec<[i32; 4]> = placed
            .iter()
            .map(|(_, (x, y))| [*x, y - NAME_SIZE, x + 49, y + 3])
            .collect();
        for (place, first) in boxes.iter().enumerate() {
            for second in &boxes[place + 1..] {
                assert_eq!(shared(first, second), 0, "{placed:?}");
            }
        }
    }
}
