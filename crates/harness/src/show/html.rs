//! Text and names inside HTML and SVG.

/// A technique's name in HTML, which may be broken between its options.
pub fn breakable(name: &str) -> String {
    let text = escape(name);
    ["(", ",", "+"].iter().fold(text, |text, sign| {
        text.replace(sign, &format!("{sign}<wbr>"))
    })
}

/// Text as it may stand in HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
