//! Damage to bytes and texts.

use catoptric_scene::Random;

/// Numbers that programs fall over.
pub const NUMBERS: [&str; 22] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "0.5",
    "1e-30",
    "1e30",
    "1e38",
    "1e308",
    "-1e308",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "255",
    "65536",
    "2147483648",
    "4294967295",
    "9223372036854775807",
    "18446744073709551616",
    "0x10",
];

/// Texts that programs fall over.
pub const TEXTS: [&str; 12] = [
    "",
    " ",
    "\"",
    "'",
    "\\",
    "\\\n",
    "\r\n",
    "\0",
    "é",
    "\u{feff}",
    "\u{1b}[31m",
    "[[[[",
];

/// One of a list.
pub fn one<'t, T>(random: &mut Random, of: &'t [T]) -> &'t T {
    &of[random.below(of.len())]
}

/// True once in `times`.
pub fn once_in(random: &mut Random, times: usize) -> bool {
    random.below(times) == 0
}

/// A few damages at random places.
pub fn bytes(random: &mut Random, mut bytes: Vec<u8>) -> Vec<u8> {
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len() + 1);
        let length = 1 + random.below(16);
        let end = (at + length).min(bytes.len());
        match random.below(8) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let copy = bytes[at..end].to_vec();
                bytes.splice(at..at, copy);
            }
            3 => {
                let number = one(random, &NUMBERS).bytes();
                bytes.splice(at..end, number);
            }
            4 => {
                let text = one(random, &TEXTS).bytes();
                bytes.splice(at..at, text);
            }
            5 => {
                let value = *one(random, &[0, 1, 0x7f, 0x80, 0xff]);
                bytes.get_mut(at).into_iter().for_each(|byte| *byte = value);
            }
            6 if at + 4 <= bytes.len() => {
                let value = *one(random, &[0, 1, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff_u32]);
                bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
            }
            _ => {
                let bit = 1 << random.below(8);
                bytes.get_mut(at).into_iter().for_each(|byte| *byte ^= bit);
            }
        }
    }
    bytes
}

/// A text with one of its numbers, lines or bytes changed.
pub fn text(random: &mut Random, text: &str) -> Vec<u8> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..=random.below(3) {
        if lines.is_empty() {
            break;
        }
        let at = random.below(lines.len());
        match random.below(6) {
            0 => drop(lines.remove(at)),
            1 => lines.insert(at, lines[at].clone()),
            2 => {
                let other = random.below(lines.len());
                lines.swap(at, other);
            }
            _ => lines[at] = with_another_number(random, &lines[at]),
        }
    }
    let text = lines.join("\n").into_bytes();
    match once_in(random, 4) {
        true => bytes(random, text),
        false => text,
    }
}

/// A line with one of its numbers changed.
fn with_another_number(random: &mut Random, line: &str) -> String {
    let is_digit = |c: char| c.is_ascii_digit() || c == '.';
    let starts: Vec<usize> = line
        .char_indices()
        .filter(|(at, c)| is_digit(*c) && !line[..*at].ends_with(is_digit))
        .map(|(at, _)| at)
        .collect();
    if starts.is_empty() {
        return line.to_owned();
    }
    let at = *one(random, &starts);
    let rest = line[at..].trim_start_matches(is_digit);
    format!("{}{}{rest}", &line[..at], one(random, &NUMBERS))
}
