//! Numbers as text: short in tables, with their unit and thin spaces in sentences.

/// A number with four significant digits, or whole above a thousand.
pub fn significant(value: f64) -> String {
    rounded(value, 4)
}

/// A number with so many significant digits, or whole where it has more.
pub fn rounded(value: f64, digits: u32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if magnitude < -4.0 {
        return format!("{value:.2e}");
    }
    let decimals = (f64::from(digits) - 1.0 - magnitude).clamp(0.0, 7.0) as usize;
    format!("{value:.decimals$}")
}

/// A share as per cent: never rounded to 0 or 100 unless it is.
pub fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value > 0.0 && value < 0.01 {
        "under 0.01 %".to_owned()
    } else if value < 100.0 && value > 99.99 {
        "over 99.99 %".to_owned()
    } else if value == 0.0 || value == 100.0 {
        format!("{value:.0} %")
    } else if !(1.0..=99.0).contains(&value) {
        format!("{value:.2} %")
    } else {
        format!("{value:.1} %")
    }
}

/// A whole number with thin spaces between its thousands.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// A share for a table: signs instead of words.
pub fn share(value: Option<f64>) -> String {
    let text = value.map_or_else(|| "–".to_owned(), percent);
    text.replace("under ", "< ").replace("over ", "> ")
}

/// Three significant digits: enough for a sentence.
pub fn short(value: f64) -> String {
    if !(1e-4..1000.0).contains(&value.abs()) {
        return significant(value);
    }
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// A value or a dash.
pub fn or_dash(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), significant)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0, "0"),
            (0.412345, "0.4123"),
            (12.3456, "12.35"),
            (98765.4, "98765"),
            (1e-7, "1.00e-7"),
            (-0.5, "-0.5000"),
        ];
        for (value, text) in cases {
            assert_eq!(significant(value), text);
        }
    }

    #[test]
    fn per_cent_is_never_rounded_to_all_or_nothing() {
        let cases = [
            (0.0, "0 %"),
            (1.0, "100 %"),
            (0.981, "98.1 %"),
            (0.00003, "under 0.01 %"),
            (0.99999, "over 99.99 %"),
            (0.0045, "0.45 %"),
        ];
        for (share, text) in cases {
            assert_eq!(percent(share), text);
        }
    }

    #[test]
    fn sentences_have_three_digits() {
        let cases = [
            (0.11504, "0.115"),
            (300.0, "300"),
            (0.5, "0.5"),
            (12.345, "12.3"),
            (4567.8, "4568"),
            (0.0, "0"),
        ];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
    }

    #[test]
    fn counts_have_narrow_spaces_that_do_not_break() {
        assert_eq!(
            [5, 999, 1000, 1_234_567].map(count),
            ["5", "999", "1\u{202f}000", "1\u{202f}234\u{202f}567"]
        );
    }
}
