//! A headless Chromium, driven by its DevTools protocol over a pipe.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

/// How Chromium may be called.
const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
];

/// Patience with an answer, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// The browser's program, if it is here.
pub fn program() -> Option<&'static str> {
    let path = std::env::var_os("PATH")?;
    let here = |name: &&str| std::env::split_paths(&path).any(|folder| folder.join(name).is_file());
    NAMES.into_iter().find(here)
}

/// A browser with one page. Whatever the page reports as an error is kept.
pub struct Chromium {
    child: Child,
    to: ChildStdin,
    from: Receiver<Value>,
    session: Option<String>,
    calls: u64,
    /// Exceptions, and errors and warnings of the console.
    pub errors: Vec<String>,
    _profile: TempDir,
}

impl Chromium {
    pub fn start(program: &str) -> Self {
        let profile = tempfile::tempdir().expect("a folder");
        // The protocol is spoken over descriptors 3 and 4. The sandbox needs rights that containers
        // lack, and only our own page is opened.
        let mut child = Command::new("sh")
            .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 1>&2", program])
            .args(["--headless", "--no-sandbox", "--disable-gpu"])
            .args(["--no-first-run", "--remote-debugging-pipe"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("a shell");
        let to = child.stdin.take().expect("a pipe");
        let mut answers = BufReader::new(child.stdout.take().expect("a pipe"));
        let (send, from) = channel();
        std::thread::spawn(move || {
            let mut message = Vec::new();
            while answers
                .read_until(0, &mut message)
                .is_ok_and(|read| read > 0)
            {
                message.pop();
                let value = serde_json::from_slice(&message).expect("JSON");
                if send.send(value).is_err() {
                    break;
                }
                message.clear();
            }
        });
        let mut browser = Self {
            child,
            to,
            from,
            session: None,
            calls: 0,
            errors: Vec::new(),
            _profile: profile,
        };
        let target = browser.call("Target.createTarget", json!({"url": "about:blank"}));
        let target = json!({"targetId": target["targetId"], "flatten": true});
        let attached = browser.call("Target.attachToTarget", target);
        browser.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// Calls a method of the protocol.
    fn call(&mut self, method: &str, params: Value) -> Value {
        self.calls += 1;
        let mut message = json!({"id": self.calls, "method": method, "params": params});
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let bytes = format!("{message}\0");
        self.to.write_all(bytes.as_bytes()).expect("a browser");
        loop {
            let answer = self.from.recv_timeout(PATIENCE);
            let answer = answer.unwrap_or_else(|error| panic!("{method}: {error}"));
            if answer["id"] == self.calls {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
            self.note(&answer);
        }
    }

    /// Keeps what the page reports as wrong.
    fn note(&mut self, event: &Value) {
        let params = &event["params"];
        let wrong = match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => {
                params["type"] == "error" || params["type"] == "warning"
            }
            Some("Log.entryAdded") => params["entry"]["level"] == "error",
            _ => false,
        };
        if wrong {
            self.errors.push(params.to_string());
        }
    }

    /// The value of an expression, once it has one if it is a promise.
    pub fn value(&mut self, expression: &str) -> Value {
        let params = json!({"expression": expression, "awaitPromise": true, "returnByValue": true});
        let answer = self.call("Runtime.evaluate", params);
        assert!(
            answer["exceptionDetails"].is_null(),
            "{expression}: {answer}"
        );
        answer["result"]["value"].clone()
    }

    /// The text of the first element that a selector finds.
    pub fn text(&mut self, selector: &str) -> String {
        let text = self.value(&format!(
            "document.querySelector({selector:?})?.textContent"
        ));
        let text = text.as_str();
        text.unwrap_or_else(|| panic!("no {selector}")).to_owned()
    }

    /// Waits until an expression is true.
    pub fn wait(&mut self, expression: &str) {
        let begun = Instant::now();
        while self.value(&format!("Boolean({expression})")) != true {
            assert!(begun.elapsed() < PATIENCE, "never: {expression}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// The size of the window, and light or dark.
    pub fn window(&mut self, [width, height]: [u32; 2], dark: bool) {
        let metrics =
            json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.call("Emulation.setDeviceMetricsOverride", metrics);
        let scheme = if dark { "dark" } else { "light" };
        let feature = json!({"name": "prefers-color-scheme", "value": scheme});
        self.call("Emulation.setEmulatedMedia", json!({"features": [feature]}));
    }

    /// Opens a page from disk; `fragment` is empty or begins with `#`.
    pub fn open(&mut self, page: &Path, fragment: &str) {
        let page = page.canonicalize().expect("a page");
        // From elsewhere, so that a change of the fragment alone loads the page too.
        self.call("Page.navigate", json!({"url": "about:blank"}));
        let url = format!("file://{}{fragment}", page.display());
        self.call("Page.navigate", json!({"url": url}));
        self.wait("location.protocol === 'file:' && document.readyState === 'complete'");
    }

    /// The middle of an element, on the screen.
    pub fn middle(&mut self, selector: &str) -> [f64; 2] {
        let element = format!("document.querySelector({selector:?})");
        self.value(&format!("{element}.scrollIntoView({{block: 'center'}})"));
        let middle = self.value(&format!(
            "(({{x, y, width, height}}) => [x + width / 2, y + height / 2])({element}.getBoundingClientRect())"
        ));
        [0, 1].map(|axis| middle[axis].as_f64().expect("a place"))
    }

    fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], more: Value) {
        let mut params = json!({"type": kind, "x": x, "y": y});
        for (key, value) in more.as_object().into_iter().flatten() {
            params[key] = value.clone();
        }
        self.call("Input.dispatchMouseEvent", params);
    }

    pub fn point_at(&mut self, at: [f64; 2]) {
        self.mouse("mouseMoved", at, json!({}));
    }

    pub fn click_at(&mut self, at: [f64; 2]) {
        self.point_at(at);
        for kind in ["mousePressed", "mouseReleased"] {
            self.mouse(kind, at, json!({"button": "left", "clickCount": 1}));
        }
    }

    pub fn click(&mut self, selector: &str) {
        let at = self.middle(selector);
        self.click_at(at);
    }

    /// Turns the wheel, upwards for positive steps.
    pub fn wheel(&mut self, at: [f64; 2], steps: f64) {
        self.mouse(
            "mouseWheel",
            at,
            json!({"deltaX": 0, "deltaY": -120.0 * steps}),
        );
    }

    pub fn key(&mut self, key: &str) {
        // By it Chromium itself knows what closes a dialog.
        let number = if key == "Escape" { 27 } else { 0 };
        for kind in ["keyDown", "keyUp"] {
            let params = json!({"type": kind, "key": key, "windowsVirtualKeyCode": number});
            self.call("Input.dispatchKeyEvent", params);
        }
    }

    /// What an element looks like.
    pub fn picture(&mut self, selector: &str) -> image::RgbImage {
        let element = format!("document.querySelector({selector:?})");
        let clip = self.value(&format!(
            "(({{x, y, width, height}}) => ({{x: x + scrollX, y: y + scrollY, width, height, scale: 1}}))({element}.getBoundingClientRect())"
        ));
        let shot = self.call(
            "Page.captureScreenshot",
            json!({"format": "png", "clip": clip}),
        );
        let png = from_base64(shot["data"].as_str().expect("a picture"));
        image::load_from_memory(&png).expect("a PNG").into_rgb8()
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// RFC 4648, section 4.
fn from_base64(text: &str) -> Vec<u8> {
    let digit = |sign: u8| match sign {
        b'A'..=b'Z' => sign - b'A',
        b'a'..=b'z' => sign - b'a' + 26,
        b'0'..=b'9' => sign - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let signs: Vec<u8> = text.bytes().filter(|sign| *sign != b'=').collect();
    let groups = signs.chunks(4).flat_map(|group| {
        let bits = group.iter().zip([18, 12, 6, 0]);
        let bits = bits.fold(0_u32, |bits, (sign, shift)| {
            bits | u32::from(digit(*sign)) << shift
        });
        let bytes = bits.to_be_bytes();
        bytes[1..group.len()].to_vec()
    });
    groups.collect()
}
