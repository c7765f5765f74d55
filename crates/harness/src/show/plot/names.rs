//! Names along the x axis: in lines where they fit their places, slanted where they do not.

use crate::show::html::escape;

/// Width of a character, about, and height of a line.
const CHARACTER: u32 = 8;
const LINE: u32 = 18;
/// Slanted names rise to the right by so many degrees.
pub const SLANT: f64 = 35.0;

/// How names stand below the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// By name, its lines.
    pub lines: Vec<Vec<String>>,
    /// Names are slanted, and end at their places.
    pub slanted: bool,
    /// Height beyond that of one line.
    pub room: u32,
}

impl Layout {
    /// Of names that share `width` of the drawing.
    pub fn of(names: &[String], width: u32) -> Self {
        let place = width / names.len().max(1) as u32;
        let most = (place / CHARACTER) as usize;
        let lines: Vec<_> = names.iter().map(|name| wrapped(name, most)).collect();
        let longest = |lines: &[String]| lines.iter().map(|line| line.chars().count()).max();
        let fits = lines
            .iter()
            .filter_map(|lines| longest(lines))
            .all(|line| line <= most);
        if fits {
            let high = lines.iter().map(Vec::len).max().unwrap_or(1);
            return Self {
                lines,
                slanted: false,
                room: LINE * (high.max(1) - 1) as u32,
            };
        }
        let length = longest(names).unwrap_or(0) as u32 * CHARACTER;
        Self {
            lines: names.iter().map(|name| vec![name.clone()]).collect(),
            slanted: true,
            room: (f64::from(length) * SLANT.to_radians().sin()) as u32,
        }
    }

    /// The names as SVG: `at` are their places on the axis, from the left, which lies `axis` from the
    /// top.
    pub fn svg(&self, at: impl Iterator<Item = f64>, axis: f64) -> String {
        let mut body = String::new();
        let line_height = f64::from(LINE);
        let first = axis + line_height;
        for (lines, x) in self.lines.iter().zip(at) {
            let (anchor, turned) = match self.slanted {
                true => (
                    "end",
                    format!(" transform=\"rotate(-{SLANT} {x:.1} {first})\""),
                ),
                false => ("middle", String::new()),
            };
            for (line, place) in lines.iter().zip(0..) {
                body += &format!(
                    "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"{anchor}\" font-size=\"16\" \
                     fill=\"currentColor\"{turned}>{}</text>\n",
                    first + f64::from(place) * line_height,
                    escape(line)
                );
            }
        }
        body
    }
}

/// A name in lines of at most so many characters, if its words allow.
fn wrapped(name: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in name.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(names: &[&str], width: u32) -> Layout {
        let names: Vec<_> = names.iter().map(|name| (*name).to_owned()).collect();
        Layout::of(&names, width)
    }

    #[test]
    fn names_that_fit_stay_on_one_line() {
        let layout = layout(&["off", "on"], 200);
        assert_eq!(layout.lines, [["off"], ["on"]]);
        assert_eq!((layout.slanted, layout.room), (false, 0));
    }

    #[test]
    fn words_go_to_the_next_line() {
        let layout = layout(&["sound, distance", "off"], 160);
        assert_eq!(layout.lines, [vec!["sound,", "distance"], vec!["off"]]);
        assert_eq!((layout.slanted, layout.room), (false, LINE));
    }

    #[test]
    fn words_that_are_too_long_are_slanted() {
        let layout = layout(&["reflector cubemap", "planar"], 120);
        assert!(layout.slanted);
        assert_eq!(layout.lines[0], ["reflector cubemap"]);
        assert!(layout.room > LINE);
    }
}
