//! The inspector of the pages, in a real browser: skipped where there is no Chromium, unless
//! `CATOPTRIC_REQUIRE_BROWSER=1` says that there must be one.

mod chromium;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use catoptric_frame::{Frame, Status};
use catoptric_metrics::{CoverageClass, MapKind, error_map, offset_px};
use serde_json::json;

use crate::support::{catoptric, code, files, gpu_or_skip};
use chromium::Chromium;

/// Size of the pictures on the pages.
const SIZE: [u32; 2] = [96, 72];

/// Wide and narrow, light and dark.
const WINDOWS: [([u32; 2], bool); 4] = [
    ([1400, 900], false),
    ([1400, 900], true),
    ([400, 800], false),
    ([400, 800], true),
];

/// A page and a technique on a scene that it shows.
struct Page {
    verb: &'static [&'static str],
    scene: &'static str,
    technique: &'static str,
}

/// A report, a report with all values, a suite.
const PAGES: [Page; 3] = [
    Page {
        verb: &["report"],
        scene: "sphere-table",
        technique: "linear",
    },
    Page {
        verb: &["report", "--layers"],
        scene: "bowl",
        technique: "environment-map",
    },
    Page {
        verb: &["bench", "estalella"],
        scene: "sphere-square",
        technique: "environment-map(update=frame)",
    },
];

fn browser_or_skip() -> Option<Chromium> {
    if !gpu_or_skip() {
        return None;
    }
    if let Some(program) = chromium::program() {
        return Some(Chromium::start(program));
    }
    let required = std::env::var("CATOPTRIC_REQUIRE_BROWSER").is_ok_and(|value| value == "1");
    assert!(
        !required,
        "CATOPTRIC_REQUIRE_BROWSER=1, and there is no Chromium"
    );
    eprintln!("skipped: there is no Chromium");
    None
}

/// Runs the program with a picture size and an output.
fn run(args: &[&str], output: &Path) {
    let [width, height] = SIZE;
    let size = format!("{width}x{height}");
    let output = output.to_str().expect("UTF-8");
    let args = [args, &["--resolution", &size, "--quiet", "-o", output]].concat();
    let ended = catoptric(&args);
    assert_eq!(code(&ended), 0, "{args:?}: {ended:?}");
}

impl Page {
    /// The page's folder, made once for all tests.
    fn folder(&self) -> PathBuf {
        static MADE: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let folder = folder.join(format!("inspector-{}", self.scene));
        let mut made = MADE.lock().expect("no other test failed here");
        if made.insert(self.scene) {
            let scene = ["--scene", self.scene, "--time-budget", "0.05"];
            run(&[self.verb, &scene].concat(), &folder);
        }
        folder
    }

    fn link(&self, more: &str) -> String {
        let [width, height] = SIZE;
        format!(
            "#inspect&scene={}&size={width}x{height}&technique={}{more}",
            self.scene, self.technique
        )
    }

    /// What the values must be those of: the pictures as the program writes them.
    fn frames(&self) -> [Frame; 2] {
        let folder = tempfile::tempdir().expect("a folder");
        let read = |name: &str, args: &[&str]| {
            let path = folder.path().join(name);
            run(args, &path);
            Frame::read_exr(&path).expect("an EXR of ours")
        };
        [
            read("reference.exr", &["reference", self.scene]),
            read(
                "technique.exr",
                &["render", self.scene, "-t", self.technique],
            ),
        ]
    }
}

/// What a page must show at a pixel, by the pictures that the program writes.
struct Expected {
    frames: [Frame; 2],
    angle: catoptric_frame::Image<f32>,
    flip: catoptric_frame::Image<f32>,
    coverage: catoptric_frame::Image<f32>,
    offset: catoptric_frame::Image<f32>,
}

impl Expected {
    fn of(page: &Page) -> Self {
        let frames = page.frames();
        let map = |kind| error_map(kind, &frames[0], &frames[1]).expect("layers");
        Self {
            angle: map(MapKind::Angular),
            flip: map(MapKind::Flip),
            coverage: map(MapKind::Coverage),
            offset: offset_px(&frames[0], &frames[1]).expect("layers"),
            frames,
        }
    }

    /// Ten pixels: of the mirror's, also the one of the largest angle.
    fn pixels(&self) -> Vec<[u32; 2]> {
        let [width, _] = SIZE;
        let place = |index: u32| [index % width, index / width];
        let known = |image: &catoptric_frame::Image<f32>| {
            let pixels = image.pixels().iter().zip(0..);
            let pixels = pixels.filter(|(value, _)| !value.is_nan());
            pixels
                .map(|(value, index)| (*value, index))
                .collect::<Vec<_>>()
        };
        let (mirror, angles) = (known(&self.coverage), known(&self.angle));
        let worst = angles.iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let spread = (0..9).map(|part| mirror[part * (mirror.len() - 1) / 8].1);
        spread
            .chain(worst.map(|(_, index)| *index))
            .map(place)
            .collect()
    }

    /// Compares what the inspector says of a pixel.
    fn compare(&self, browser: &mut Chromium, [x, y]: [u32; 2], all: bool) {
        let at = format!("pixel {x}, {y}");
        let mut text = |name: &str| browser.text(&format!("[data-value='{name}']"));
        let numbers = |text: &str| -> Vec<f64> {
            let parts = text.split([' ', ',', '°']).filter(|part| !part.is_empty());
            let parts = parts.map(|part| part.replace('−', "-").parse().unwrap_or(f64::NAN));
            parts.collect()
        };
        // Half a step, and half of the last digit that is shown.
        let absolute = |got: f64, value: f32, step: f64, digit: f64, what: &str| {
            let value = f64::from(value);
            let near = (got - value).abs() <= 0.5 * step + 0.5 * digit;
            assert!(
                near || (got.is_nan() && value.is_nan()),
                "{at}, {what}: {got} for {value}"
            );
        };
        // Half of a step of so many an octave, half of the last digit, and what is taken for 0.
        let relative = |text: String, value: f32, steps: f64, zero: f64, what: &str| {
            let got = numbers(&text)[0];
            let allowed = f64::from(value) * (2.0_f64.powf(0.5 / steps) - 1.0 + 0.5e-3);
            let near = (got - f64::from(value)).abs() <= allowed + zero;
            assert!(
                near || (got.is_nan() && value.is_nan()),
                "{at}, {what}: {got} for {value}"
            );
        };
        for (name, frame) in ["reference", "technique"].into_iter().zip(&self.frames) {
            let reflected = frame.reflected.as_ref().expect("layers");
            let id = *reflected.id.at(x, y);
            assert_eq!(text(&format!("{name}.id")), id.to_string(), "{at}");
            let status = *reflected.status.at(x, y);
            let object = match (status, frame.names.iter().find(|known| known.id == id)) {
                (Status::NotMirror, _) => "no mirror here",
                (_, Some(known)) => &known.name,
                (_, None) => "background",
            };
            assert_eq!(text(&format!("{name}.object")), object, "{at}");
            let said = text(&format!("{name}.status"));
            assert_eq!(
                said == "resolved",
                status == Status::Resolved,
                "{at}: {said}"
            );
            let color = numbers(&text(&format!("{name}.color")));
            for (channel, got) in color.into_iter().enumerate() {
                let value = frame.color.at(x, y)[channel];
                absolute(
                    got,
                    value,
                    1.0 / 2048.0,
                    1e-4,
                    &format!("{name}, channel {channel}"),
                );
            }
            if all && id != 0 {
                let position = numbers(&text(&format!("{name}.position")));
                for (axis, got) in position.into_iter().enumerate() {
                    let value = reflected.position.at(x, y)[axis];
                    // The scenes are less than 65 units wide; four digits are shown.
                    let digit = 1e-3 * f64::from(value.abs());
                    absolute(got, value, 1e-3, digit, &format!("{name}, axis {axis}"));
                }
                relative(
                    text(&format!("{name}.distance")),
                    *reflected.distance.at(x, y),
                    128.0,
                    1e-6,
                    "distance",
                );
            }
        }
        relative(
            text("angle"),
            *self.angle.at(x, y),
            32.0,
            0.5_f64.powi(13),
            "angle",
        );
        absolute(
            numbers(&text("flip"))[0],
            *self.flip.at(x, y),
            1.0 / 254.0,
            1e-3,
            "FLIP",
        );
        let code = *self.coverage.at(x, y);
        let class = CoverageClass::ALL
            .into_iter()
            .find(|class| f32::from(*class as u8) == code);
        let coverage = match class {
            Some(CoverageClass::Crack) => "missing in a crack",
            Some(class) => class.label(),
            None => "–",
        };
        assert_eq!(text("coverage"), coverage, "{at}");
        if all {
            relative(text("offset"), *self.offset.at(x, y), 128.0, 1e-6, "offset");
        }
    }
}

/// The inspector is open and has its values.
const READY: &str = "document.querySelector('.inspector')?.open \
                     && !document.querySelector('.inspector .waiting') \
                     && document.querySelector('.message').hidden";

/// How many colours a part of the screen has.
fn colors(browser: &mut Chromium, selector: &str) -> usize {
    let picture = browser.picture(selector);
    let colors: BTreeSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    colors.len()
}

fn no_errors(browser: &Chromium) {
    assert_eq!(browser.errors, Vec::<String>::new());
}

/// The marked pixel.
fn marked(browser: &mut Chromium) -> [u32; 2] {
    let text = browser.text(".pixel");
    let parts = text
        .trim_start_matches("pixel ")
        .trim_end_matches(" (marked)");
    let parts = parts
        .split_once(", ")
        .unwrap_or_else(|| panic!("no pixel: {text}"));
    [parts.0, parts.1].map(|part| part.parse().unwrap_or_else(|_| panic!("no pixel: {text}")))
}

#[test]
fn the_inspector_shows_the_values_of_the_exr_files() {
    let Some(mut browser) = browser_or_skip() else {
        return;
    };
    browser.window([1400, 900], false);
    for page in &PAGES {
        let (folder, expected) = (page.folder(), Expected::of(page));
        let all = page.verb.contains(&"--layers");
        let pixels = expected.pixels();
        assert_eq!(pixels.len(), 10, "{}", page.scene);
        browser.open(&folder.join("index.html"), &page.link(""));
        for [x, y] in pixels {
            let link = page.link(&format!("&pixel={x},{y}"));
            browser.value(&format!("void (location.hash = {link:?})"));
            browser.wait(&format!(
                "{READY} && document.querySelector('.pixel').textContent.startsWith('pixel {x}, {y} ')"
            ));
            expected.compare(&mut browser, [x, y], all);
        }
    }
    no_errors(&browser);
}

#[test]
fn a_click_fills_the_window_the_wheel_zooms_and_a_link_leads_back() {
    let Some(mut browser) = browser_or_skip() else {
        return;
    };
    let page = &PAGES[0];
    let (index, expected) = (page.folder().join("index.html"), Expected::of(page));
    for (window, dark) in WINDOWS {
        browser.window(window, dark);
        browser.open(&index, "");
        browser.click(".pictures[data-technique='linear'] [data-picture='technique']");
        browser.wait(READY);
        let wide = browser.value("document.documentElement.scrollWidth <= innerWidth \
                                  && document.querySelector('.inspector').scrollWidth <= innerWidth");
        assert_eq!(wide, true, "{window:?}: nothing is cut off at the side");
        assert!(colors(&mut browser, ".stage") > 50, "a picture");
        let at = browser.middle(".stage");
        let before = browser.text(".zoom");
        for _ in 0..6 {
            browser.wheel(at, 1.0);
        }
        browser.wait(&format!(
            "document.querySelector('.zoom').textContent !== {before:?}"
        ));
        // The wheel's events come late.
        browser.wait("parseFloat(document.querySelector('.zoom').textContent) > 2000");
        let aside = [at[0] + 25.0, at[1] - 15.0];
        browser.click_at(aside);
        let pixel = marked(&mut browser);
        expected.compare(&mut browser, pixel, false);
        browser.key("3");
        browser.wait("document.querySelector('[data-kind=angle]').ariaPressed === 'true'");
        browser.wait("location.hash.includes('picture=angle') && location.hash.includes('pixel=')");
        let said = "['.zoom', '.pixel', '.values', '.by'].map((name) => \
                    document.querySelector(name).textContent).join()";
        let before = browser.value(said);
        let hash = browser.value("location.hash");
        browser.open(&index, hash.as_str().expect("text"));
        browser.wait(READY);
        assert_eq!(browser.value(said), before, "{hash}");
        assert_eq!(browser.value("location.hash"), hash);
        browser.key("ArrowRight");
        browser.wait(READY);
        browser.wait("document.querySelector('.by').textContent !== 'linear'");
        assert_eq!(marked(&mut browser), pixel, "the next technique in place");
        browser.key("Escape");
        browser.wait("!document.querySelector('.inspector').open");
    }
    no_errors(&browser);
}

#[test]
fn the_worst_pixel_is_a_click_away() {
    let Some(mut browser) = browser_or_skip() else {
        return;
    };
    let page = &PAGES[0];
    let expected = Expected::of(page);
    browser.window([1400, 900], false);
    browser.open(&page.folder().join("index.html"), "");
    browser.click(".hero [data-picture='technique']");
    browser.wait(READY);
    browser.click("[data-do=worst]");
    let [x, y] = marked(&mut browser);
    let known = expected.angle.pixels().iter().copied();
    let largest = known.filter(|angle| !angle.is_nan()).fold(0.0, f32::max);
    assert_eq!(*expected.angle.at(x, y), largest);
    expected.compare(&mut browser, [x, y], false);
    no_errors(&browser);
}

#[test]
fn a_page_without_a_layer_says_so_and_shows_its_pictures() {
    let Some(mut browser) = browser_or_skip() else {
        return;
    };
    let page = &PAGES[0];
    let copy = tempfile::tempdir().expect("a folder");
    copy_folder(&page.folder(), copy.path());
    let index = copy.path().join("index.html");
    browser.window([1400, 900], false);
    browser.open(&index, "");
    let layers = browser.value("document.querySelector('.hero [data-layers]').dataset.layers");
    let layers = copy.path().join(layers.as_str().expect("a path"));
    let whole = std::fs::read_to_string(&layers).expect("a script");
    // The head of compressed data, which says how it was compressed.
    let flipped = whole.replacen("\"data\":\"e", "\"data\":\"f", 1);
    assert_ne!(flipped, whole);
    let damages = [
        None,
        Some(&whole[..whole.len() / 2]),
        Some(flipped.as_str()),
    ];
    for damage in damages {
        match damage {
            None => std::fs::remove_file(&layers).expect("a file"),
            Some(text) => std::fs::write(&layers, text).expect("a file"),
        }
        browser.open(&index, &page.link(""));
        browser.wait("!document.querySelector('.message').hidden");
        let message = browser.text(".message");
        assert!(message.contains("cannot be read"), "{message}");
        assert!(message.contains("linear.layers.js"), "{message}");
        browser.wait(
            "[...document.images].every((image) => image.complete || image.loading === 'lazy')",
        );
        for key in ["1", "2", "3", "4"] {
            browser.key(key);
            assert!(colors(&mut browser, ".stage") > 20, "picture {key}");
        }
    }
    std::fs::write(&layers, whole).expect("a file");
    browser.errors.clear();
    browser.open(&index, &page.link("&pixel=48,36"));
    browser.wait(READY);
    assert_eq!(
        browser.value("document.querySelectorAll('[data-value]').length > 8"),
        json!(true)
    );
    no_errors(&browser);
}

fn copy_folder(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a folder");
    for name in files(from) {
        let (from, to) = (from.join(&name), to.join(&name));
        match from.is_dir() {
            true => copy_folder(&from, &to),
            false => drop(std::fs::copy(from, to).expect("a copy")),
        }
    }
}
