//! Everything that is read from outside, fed with made-up input: no panic, no abort, no hang, no
//! runaway memory. `cargo test` tries each target for a few seconds, with the same inputs every time;
//! `cargo xtask fuzz` does so for as long as one likes, with others.
//!
//! An input is made from its number alone. A worker process tries one after the other and notes where
//! it is; the test that started it watches, and starts it anew behind an input that it fell over.
//! Inputs that failed are kept in `target/tmp/fuzz/`.

mod foreign;
mod inputs;
mod mutate;
mod targets;

use std::fs;
use std::io::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use targets::{TARGETS, Target};

/// Seconds for all targets, or for the one that is asked for by name, and the number of a target's
/// first input; other than these by `cargo xtask fuzz`.
const SECONDS: (&str, u64) = ("CATOPTRIC_FUZZ_SECONDS", 12);
const FIRST: (&str, u64) = ("CATOPTRIC_FUZZ_FIRST", 0);
/// What a worker is told: target, first input, seconds, folder.
const WORK: &str = "CATOPTRIC_FUZZ_WORK";
/// No input may take longer.
const LONGEST: Duration = Duration::from_secs(10);
/// Address space of a worker in KiB: 2 GiB for an input, and what a process takes by itself.
const MEMORY_KIB: u64 = 3 << 20;
/// More failures than these are not looked for.
const MOST_FAILURES: usize = 10;

fn setting((name, default): (&str, u64)) -> u64 {
    let text = std::env::var(name).ok();
    text.map_or(default, |text| text.parse().expect("a whole number"))
}

/// The file in which a worker notes the input that it is at, and how many were accepted.
fn note(folder: &Path) -> PathBuf {
    folder.join("at")
}

/// The worker: not a test of its own, but a process of this one that may fall over.
#[test]
#[ignore = "the other tests start it"]
fn worker() {
    let Ok(work) = std::env::var(WORK) else {
        return;
    };
    let words: Vec<&str> = work.splitn(4, ' ').collect();
    let [target, first, seconds, folder] = words[..] else {
        panic!("{work}");
    };
    let target = targets::named(target);
    let mut seed: u64 = first.parse().expect("a number");
    let end = Instant::now() + Duration::from_secs(seconds.parse().expect("a number"));
    let folder = Path::new(folder);
    let mut at = fs::File::create(note(folder)).expect("can be written");
    let mut accepted = 0_u64;
    std::panic::set_hook(Box::new(|_| {}));
    while Instant::now() < end {
        writeln!(at, "{seed} {accepted}").expect("can be written");
        let input = (target.make)(seed);
        input.write(folder);
        match catch_unwind(AssertUnwindSafe(|| (target.run)(folder))) {
            Ok(taken) => accepted += u64::from(taken),
            Err(panic) => {
                let text = panic.downcast_ref::<String>().map(String::as_str);
                let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
                fs::write(folder.join("panic"), text.unwrap_or("a panic")).expect("can be written");
                std::process::exit(1);
            }
        }
        seed += 1;
    }
    writeln!(at, "{seed} {accepted}").expect("can be written");
}

/// Where a worker is: input, and inputs that were accepted.
fn place(folder: &Path) -> Option<(u64, u64)> {
    let text = fs::read_to_string(note(folder)).ok()?;
    let line = text.lines().rfind(|line| line.contains(' '))?;
    let (seed, accepted) = line.split_once(' ')?;
    Some((seed.parse().ok()?, accepted.parse().ok()?))
}

/// A new folder for a worker, in memory where there is such: files on disks that are written again and
/// again are waited for.
fn folder() -> tempfile::TempDir {
    let memory = Path::new("/dev/shm");
    let made = match memory.is_dir() {
        true => tempfile::tempdir_in(memory),
        false => tempfile::tempdir(),
    };
    made.expect("a folder")
}

fn start(target: &Target, first: u64, seconds: u64, folder: &Path) -> Child {
    let program = std::env::current_exe().expect("a program");
    let arguments = ["--exact", "worker", "--ignored"];
    let mut command = if cfg!(unix) {
        let mut command = Command::new("sh");
        let limited = format!("ulimit -c 0; ulimit -v {MEMORY_KIB}; exec \"$@\"");
        command.arg("-c").arg(limited).arg("sh").arg(program);
        command
    } else {
        Command::new(program)
    };
    let work = format!("{} {first} {seconds} {}", target.name, folder.display());
    command
        .args(arguments)
        .env(WORK, work)
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.spawn().expect("a worker starts")
}

/// Waits for a worker; why it fell over, `None` where it did not.
fn watch(mut worker: Child, folder: &Path) -> Option<String> {
    let (mut last, mut since) = (None, Instant::now());
    loop {
        if let Some(status) = worker.try_wait().expect("a worker can be waited for") {
            let panic = fs::read_to_string(folder.join("panic"));
            return (!status.success()).then(|| panic.unwrap_or_else(|_| status.to_string()));
        }
        let now = place(folder);
        if now != last {
            (last, since) = (now, Instant::now());
        }
        if since.elapsed() > LONGEST {
            let _ = worker.kill();
            let _ = worker.wait();
            return Some(format!("no end within {} s", LONGEST.as_secs()));
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Tries a target, and fails where an input fails.
fn fuzz(name: &str) {
    let target = targets::named(name);
    let first = setting(FIRST);
    let alone = std::env::args().any(|argument| argument == name);
    let seconds = setting(SECONDS).div_ceil(if alone { 1 } else { TARGETS.len() as u64 });
    let end = Instant::now() + Duration::from_secs(seconds);
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    let (mut next, mut accepted) = (first, 0);
    let mut failures = Vec::new();
    while failures.len() < MOST_FAILURES {
        let left = end.saturating_duration_since(Instant::now()).as_secs();
        if left == 0 && next > first {
            break;
        }
        let folder = folder();
        let why = watch(
            start(target, next, left.max(1), folder.path()),
            folder.path(),
        );
        let (at, taken) = place(folder.path()).expect("the worker has started");
        accepted += taken;
        next = at;
        let Some(why) = why else { break };
        let input = kept.join(format!("{name}-{at}"));
        fs::create_dir_all(&input).expect("a folder can be made");
        (target.make)(at).write(&input);
        failures.push(format!("{}: {why}", input.display()));
        next = at + 1;
    }
    println!(
        "fuzz {name}: {} inputs, {accepted} of them accepted",
        next - first
    );
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(accepted > 0, "no input was good: nothing is tried");
}

/// Declares a test a target.
macro_rules! tests {
    ($($name:ident),+) => {
        $(#[test]
        fn $name() {
            fuzz(stringify!($name));
        })+

        #[test]
        fn every_target_has_a_test() {
            let tests = [$(stringify!($name)),+];
            assert!(TARGETS.iter().map(|target| target.name).eq(tests));
        }
    };
}

tests!(scene, mesh, texture, exr, name, record, model, import);

#[test]
fn a_failure_is_noticed() {
    for (name, why) in [
        ("panics", "on purpose"),
        ("aborts", "signal"),
        ("fills", "signal"),
    ] {
        let folder = folder();
        let worker = start(targets::named(name), 0, 1, folder.path());
        let found = watch(worker, folder.path());
        let limited = cfg!(unix) || name != "fills";
        assert!(
            !limited || found.is_some_and(|text| text.contains(why)),
            "{name}"
        );
    }
}
