//! Where numbers come from: command line, source revision, date.

use std::ffi::OsString;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::record::Meta;

/// Provenance of this run, before a scene is known.
pub fn meta(bounces: u32) -> Meta {
    Meta {
        command: command_line(std::env::args_os()),
        revision: revision(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        date: date(SystemTime::now()),
        scene_hash: None,
        scene_why: None,
        bounces,
        time_budget_s: None,
        part: None,
        notes: Vec::new(),
    }
}

/// The command line as one would type it; the program by its name alone. What is not Unicode in it is
/// shown as `�`.
fn command_line(args: impl Iterator<Item = OsString>) -> String {
    let quoted = args.skip(1).map(|arg| {
        let arg = arg.to_string_lossy().into_owned();
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,=:+%@".contains(c);
        if !arg.is_empty() && arg.chars().all(plain) {
            arg
        } else {
            format!("'{}'", arg.replace('\'', r"'\''"))
        }
    });
    std::iter::once("catoptric".to_owned())
        .chain(quoted)
        .collect::<Vec<_>>()
        .join(" ")
}

/// Revision of the sources that the program was built from, with `-dirty` where they differed from
/// it; `None` where it was not built in a git checkout.
fn revision() -> Option<String> {
    let revision = env!("CATOPTRIC_REVISION");
    (!revision.is_empty()).then(|| revision.to_owned())
}

/// RFC 3339 in UTC, to the second.
fn date(time: SystemTime) -> String {
    let seconds = time
        .duration_since(UNIX_EPOCH)
        .map_or(0, |elapsed| elapsed.as_secs());
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    let (year, month, day) = civil(days);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Year, month and day of a number of days since 1970-01-01 (Hinnant's `civil_from_days`).
fn civil(days: u64) -> (u64, u64, u64) {
    let shifted = days + 719_468; // days since 0000-03-01
    let era = shifted / 146_097;
    let day_of_era = shifted % 146_097;
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * day_of_year + 2) / 153; // from March
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let (month, year) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    (year_of_era + era * 400 + year, month, day)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn dates() {
        let at = |seconds| date(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00Z");
        assert_eq!(at(951_827_696), "2000-02-29T12:34:56Z");
        assert_eq!(at(1_767_225_599), "2025-12-31T23:59:59Z");
    }

    #[test]
    fn command_lines_can_be_typed_again() {
        let args = [
            "/somewhere/catoptric",
            "compare",
            "x",
            "-t",
            "linear(residual=cross)",
            "it's",
        ];
        let line = command_line(args.map(OsString::from).into_iter());
        assert_eq!(
            line,
            r"catoptric compare x -t 'linear(residual=cross)' 'it'\''s'"
        );
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStringExt;
            let odd = OsString::from_vec(b"n\xff/r.json".to_vec());
            let line = command_line(["catoptric".into(), odd].into_iter());
            assert_eq!(line, "catoptric 'n\u{fffd}/r.json'");
        }
    }
}
