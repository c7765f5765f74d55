//! Table 5.2 of the thesis of 2017 as printed, cell by cell.

/// The series.
pub const OURS: &str = "ours";

/// A cell of the table, as measured on a GT 540M.
pub struct Cell {
    /// Of the picture.
    pub window: [u32; 2],
    faces: u32,
    flags: &'static str,
    scene: &'static str,
    /// Microseconds a mirror pixel.
    pub micros: f64,
    /// The place of the cell that it is compared with: without flags in the same window and scene,
    /// where the table has one.
    pub base: usize,
}

/// The windows.
pub const SMALL: [u32; 2] = [320, 240];
pub const LARGE: [u32; 2] = [640, 480];
const SMALL_BASE: usize = 0;
const LARGE_BASE: usize = 5;

/// Short for the list below.
const fn cell(
    window: [u32; 2],
    faces: u32,
    flags: &'static str,
    scene: &'static str,
    micros: f64,
    base: usize,
) -> Cell {
    Cell {
        window,
        faces,
        flags,
        scene,
        micros,
        base,
    }
}

/// Every cell whose window is one of the two usual ones, and the one of a third.
pub const CELLS: [Cell; 19] = [
    cell(SMALL, 256, "", "S0", 1.77, SMALL_BASE),
    cell(SMALL, 256, "A", "S0", 1.80, SMALL_BASE),
    cell(SMALL, 256, "A", "S1", 1.23, SMALL_BASE),
    cell(SMALL, 256, "E", "S0", 8.91, SMALL_BASE),
    cell(SMALL, 256, "A, L", "S0", 1.92, SMALL_BASE),
    cell(LARGE, 256, "", "S0", 1.19, LARGE_BASE),
    cell(LARGE, 256, "A", "S0", 1.28, LARGE_BASE),
    cell(LARGE, 256, "A", "S1", 0.91, LARGE_BASE),
    cell(LARGE, 256, "E", "S0", 6.71, LARGE_BASE),
    cell(LARGE, 128, "A", "S0", 1.77, LARGE_BASE),
    cell(LARGE, 512, "E", "S0", 1.11, LARGE_BASE),
    cell(LARGE, 128, "A, L, E", "S0", 0.81, LARGE_BASE),
    cell(LARGE, 512, "A, L", "S0", 0.89, LARGE_BASE),
    cell(LARGE, 256, "A, L, E", "S0", 0.66, LARGE_BASE),
    cell(LARGE, 256, "L", "S0", 0.41, LARGE_BASE),
    cell(LARGE, 256, "L, E", "S0", 3.69, LARGE_BASE),
    cell(LARGE, 256, "A, L, E, S", "S0", 1.61, LARGE_BASE),
    cell(LARGE, 256, "L, E, S", "S0", 5.01, LARGE_BASE),
    cell([800, 600], 256, "L", "S0", 0.38, LARGE_BASE),
];

impl Cell {
    /// As the table writes it.
    pub fn label(&self) -> String {
        let [width, height] = self.window;
        let flags = match self.flags {
            "" => String::new(),
            flags => format!("{flags}, "),
        };
        format!("{width}×{height}, {}, {flags}{}", self.faces, self.scene)
    }

    /// Levels 1 to 7 of the pyramid, with the analytical criterion 1 to 5, as in the author's program.
    pub fn technique(&self) -> String {
        let has = |flag: &str| self.flags.split(", ").any(|other| other == flag);
        let mut options = vec![format!("size={}", self.faces)];
        options.push(match has("L") {
            true => "criterion=analytic,accept=any".to_owned(),
            false => "criterion=distance".to_owned(),
        });
        if has("A") {
            let finest = if has("L") { 5 } else { 7 };
            options.push(format!("pyramid=published,from=1,to={finest}"));
        }
        if has("E") {
            options.push("sampling=texel-entry".to_owned());
        }
        if has("S") {
            options.push("bounces=3,bias=0.0005".to_owned());
        }
        format!("cubemap-trace({})", options.join(","))
    }

    /// The built-in scene that is like the one measured.
    pub fn scene(&self) -> &'static str {
        match self.scene {
            "S0" => "box-teapot",
            _ => "atrium-teapot",
        }
    }
}
