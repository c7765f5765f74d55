//! Embree and our tracer on the same rays and triangles: `cargo xtask embree`.
//!
//! One thread each, processor time. Runs of the two alternate, so that drift of the machine hits
//! both alike; the ratio is the median over the runs of (Embree's time ÷ our time), and the
//! quartiles stand beside it. Embree's scenes are `ROBUST` (a `HIGH` build is then the same as a
//! `MEDIUM` one: there is no robust hierarchy with spatial splits in Embree 3), its answers f32;
//! ours are f64. Rays are rounded to f32 first, for both, and start outside of mirrors.
//!
//! What limits us, by the counts printed: on the Sponza a ray tests 8 nodes and 2 leaves, so that
//! the triangles, though tested in f64, matter less than the way to them. Over the four sets of
//! rays, time fits (nodes + 1.7) × a constant: a node is a chain of dependent steps (load, eight
//! boxes, mask, next child) whatever is in it, and setting a ray up is worth nearly two of them,
//! which is why rays that meet little (`balls`, reflected) fare worst. Packets share both among
//! eight rays, and win by as much as the rays are coherent. (One box at a time, as obvhs itself
//! walks its binary hierarchy, it was 80 boxes and 9 triangles, and 0.4 of Embree's speed.)
//!
//! Without `--embree PROGRAM` (as under `cargo bench`) nothing is measured.

#[path = "../load/mod.rs"]
mod load;

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use catoptric_reference::Tracer;
use catoptric_reference::bvh::{TriangleBvh, TriangleHit};
use catoptric_scene::Scene;
use cpu_time::ThreadTime;
use glam::Vec3;
use load::{Ray, Rays};

/// Size of the picture whose rays are traced.
const SIZE: [u32; 2] = [640, 480];

/// Alternating runs.
const RUNS: usize = 21;

/// Share of the rays that may hit in one tracer alone, or at different places: rounding to f32
/// decides at silhouettes.
const DISAGREEMENT: f64 = 1e-4;

/// Difference of distances, relative to the larger of the distance and the scene's radius, from
/// which two hits are at different places: some 80 rounding steps of f32.
const SAME_PLACE: f64 = 1e-5;

/// What Embree is asked to do: the words of its protocol, and how it is printed. The first two
/// are what we compare ourselves with; packets are for information.
const WAYS: [(&str, &str); 4] = [
    ("medium 1", "MEDIUM"),
    ("high 1", "HIGH"),
    ("medium 8", "MEDIUM, packets of 8"),
    ("high 8", "HIGH, packets of 8"),
];

fn main() -> ExitCode {
    match run() {
        Ok(code) => code,
        Err(error) => {
            eprintln!("embree: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<ExitCode> {
    let mut args = std::env::args_os().skip(1);
    let program = loop {
        match args.next() {
            Some(word) if word == "--embree" => {
                break PathBuf::from(args.next().context("--embree needs a program")?);
            }
            Some(_) => {}
            None => {
                eprintln!("embree: not measured here; `cargo xtask embree` does");
                return Ok(ExitCode::SUCCESS);
            }
        }
    };
    let folder = tempfile::tempdir()?;
    let mut agree = true;
    for scene in [Some(load::balls()), load::sponza()].into_iter().flatten() {
        agree &= compare_scene(&scene, &program, folder.path())?;
    }
    Ok(ExitCode::from(u8::from(!agree)))
}

/// Prints a table of both kinds of rays; the answer is whether hits agree.
fn compare_scene(scene: &Scene, program: &Path, folder: &Path) -> Result<bool> {
    let triangles: Vec<[Vec3; 3]> = scene
        .objects
        .iter()
        .flat_map(|object| {
            let corner = |index: u32| object.mesh.positions[index as usize];
            let corners = move |triangle: &[u32; 3]| triangle.map(corner);
            object.mesh.triangles.iter().map(corners)
        })
        .collect();
    let start = Instant::now();
    let bvh = TriangleBvh::new(&triangles);
    let build = start.elapsed();
    let tracer = Tracer::new(scene)?;
    let rays = Rays::new(&tracer, SIZE);
    println!("{}: {} triangles", scene.name, triangles.len());
    let mut agree = true;
    for (kind, rays) in [("primary", rays.primary), ("reflected", rays.reflected)] {
        let rays: Vec<Ray> = rays.into_iter().map(rounded).collect();
        let file = folder.join("rays");
        dump(&file, &triangles, &rays)?;
        let mut embree = Embree::start(program, &file)?;
        if kind == "primary" {
            println!(
                "  build, ms: ours {:.0} (all threads), Embree {} MEDIUM {:.0}, HIGH {:.0} (one thread)",
                1e3 * build.as_secs_f64(),
                embree.version,
                embree.build_ms[0],
                embree.build_ms[1],
            );
        }
        println!("  {} {kind} rays", rays.len());
        for (way, label) in &WAYS[..2] {
            let theirs = embree.hits(way, &folder.join("hits"))?;
            agree &= check(&bvh, &rays, &theirs, label)?;
        }
        compare_times(&bvh, &tracer, &rays, &mut embree)?;
    }
    Ok(agree)
}

/// A ray as Embree sees it.
fn rounded((origin, dir): Ray) -> Ray {
    (origin.as_vec3().as_dvec3(), dir.as_vec3().as_dvec3())
}

fn trace(bvh: &TriangleBvh, (origin, dir): &Ray) -> Option<TriangleHit> {
    bvh.intersect(*origin, *dir, 0.0, f64::INFINITY)
}

/// Prints how many hits differ from Embree's; the answer is whether that is few enough.
fn check(bvh: &TriangleBvh, rays: &[Ray], theirs: &[Option<f64>], label: &str) -> Result<bool> {
    let (alone, elsewhere) = differing(bvh, rays, theirs);
    let few = |count: usize| count as f64 <= DISAGREEMENT * rays.len() as f64;
    let agree = few(alone + elsewhere);
    let verdict = if agree { "" } else { " TOO MANY" };
    println!(
        "    against {label}: {alone} hit in one tracer alone, {elsewhere} elsewhere{verdict}"
    );
    // The comparison itself: hits of the rays next to these must not pass.
    let mut next = theirs.to_vec();
    next.rotate_left(1);
    let (alone, elsewhere) = differing(bvh, rays, &next);
    if few(alone + elsewhere) {
        bail!("hits of other rays go unnoticed");
    }
    Ok(agree)
}

/// How many rays hit in one tracer alone, and how many at different places.
fn differing(bvh: &TriangleBvh, rays: &[Ray], theirs: &[Option<f64>]) -> (usize, usize) {
    let (mut alone, mut elsewhere) = (0, 0);
    for (ray, theirs) in rays.iter().zip(theirs) {
        match (trace(bvh, ray).map(|hit| hit.t), theirs) {
            (Some(ours), Some(theirs)) => {
                let scale = ours.max(bvh.radius());
                elsewhere += usize::from((ours - theirs).abs() > SAME_PLACE * scale);
            }
            (None, None) => {}
            _ => alone += 1,
        }
    }
    (alone, elsewhere)
}

/// Alternates runs and prints medians.
fn compare_times(
    bvh: &TriangleBvh,
    tracer: &Tracer,
    rays: &[Ray],
    embree: &mut Embree,
) -> Result<()> {
    let mut ours: Vec<Duration> = Vec::new();
    let mut whole: Vec<Duration> = Vec::new();
    let mut theirs: [Vec<Duration>; WAYS.len()] = Default::default();
    for run in 0..=RUNS {
        let hierarchy = timed(|| rays.iter().filter(|ray| trace(bvh, ray).is_some()).count());
        let sees = |(origin, dir): &Ray| tracer.trace_objects(*origin, *dir).is_some();
        let objects = timed(|| rays.iter().filter(|ray| sees(ray)).count());
        // The first run warms caches up and does not count.
        for (way, times) in WAYS.iter().zip(&mut theirs) {
            let time = embree.time(way.0)?;
            if run > 0 {
                times.push(time);
            }
        }
        if run > 0 {
            ours.push(hierarchy);
            whole.push(objects);
        }
    }
    let mut sum = [0.0; 3];
    for (origin, dir) in rays {
        let (_, work) = bvh.intersect_counted(*origin, *dir, 0.0, f64::INFINITY);
        for (sum, count) in sum.iter_mut().zip([work.nodes, work.blocks, work.met]) {
            *sum += f64::from(count) / rays.len() as f64;
        }
    }
    println!(
        "    ours, a ray: {:.1} nodes of 8 boxes, {:.1} blocks of 4 triangles, {:.2} of them met",
        sum[0], sum[1], sum[2]
    );
    let speed = |times: &[Duration]| {
        let mut seconds: Vec<f64> = times.iter().map(Duration::as_secs_f64).collect();
        rays.len() as f64 / median(&mut seconds) / 1e6
    };
    println!(
        "    Mrays/s: ours {:.2}, with the surface's point and normal {:.2}",
        speed(&ours),
        speed(&whole)
    );
    for ((_, label), times) in WAYS.iter().zip(&theirs) {
        let mut ratios: Vec<f64> = times
            .iter()
            .zip(&ours)
            .map(|(theirs, ours)| theirs.as_secs_f64() / ours.as_secs_f64())
            .collect();
        let middle = median(&mut ratios);
        println!(
            "             Embree {label} {:.2}; ours is {middle:.2} of it ({:.2} to {:.2})",
            speed(times),
            ratios[ratios.len() / 4],
            ratios[ratios.len() * 3 / 4],
        );
    }
    Ok(())
}

/// Processor time that this thread takes.
fn timed(work: impl Fn() -> usize) -> Duration {
    let start = ThreadTime::now();
    std::hint::black_box(work());
    start.elapsed()
}

/// Sorts and gives the middle value.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Writes the file that the program in `embree.cpp` reads.
fn dump(file: &Path, triangles: &[[Vec3; 3]], rays: &[Ray]) -> Result<()> {
    let mut bytes = Vec::new();
    for count in [triangles.len(), rays.len()] {
        bytes.extend(u32::try_from(count)?.to_ne_bytes());
    }
    let corners = triangles.iter().flatten().copied();
    let ends = rays
        .iter()
        .flat_map(|(origin, dir)| [origin.as_vec3(), dir.as_vec3()]);
    for vector in corners.chain(ends) {
        for value in vector.to_array() {
            bytes.extend(value.to_ne_bytes());
        }
    }
    std::fs::write(file, bytes).with_context(|| file.display().to_string())
}

/// The running program of `embree.cpp`.
struct Embree {
    child: Child,
    stdin: ChildStdin,
    stdout: BufReader<ChildStdout>,
    version: String,
    /// Milliseconds: MEDIUM, HIGH.
    build_ms: [f64; 2],
}

impl Embree {
    fn start(program: &Path, file: &Path) -> Result<Self> {
        let mut child = Command::new(program)
            .arg(file)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .with_context(|| format!("cannot run {}", program.display()))?;
        let stdin = child.stdin.take().context("no stdin")?;
        let stdout = BufReader::new(child.stdout.take().context("no stdout")?);
        let mut embree = Self {
            child,
            stdin,
            stdout,
            version: String::new(),
            build_ms: [0.0; 2],
        };
        let line = embree.answer()?;
        let [version, medium, high] = line.split_whitespace().collect::<Vec<_>>()[..] else {
            bail!("not understood: {line}");
        };
        embree.version = version.to_owned();
        embree.build_ms = [medium.parse()?, high.parse()?];
        Ok(embree)
    }

    fn answer(&mut self) -> Result<String> {
        let mut line = String::new();
        if self.stdout.read_line(&mut line)? == 0 {
            bail!("the program ended: {}", self.child.wait()?);
        }
        Ok(line.trim().to_owned())
    }

    /// How long all rays took.
    fn time(&mut self, way: &str) -> Result<Duration> {
        writeln!(self.stdin, "time {way}")?;
        Ok(Duration::from_nanos(self.answer()?.parse()?))
    }

    /// Distance of each ray's hit.
    fn hits(&mut self, way: &str, file: &Path) -> Result<Vec<Option<f64>>> {
        writeln!(self.stdin, "hits {way} {}", file.display())?;
        self.answer()?;
        let word = |bytes: &[u8]| [bytes[0], bytes[1], bytes[2], bytes[3]];
        Ok(std::fs::read(file)?
            .chunks_exact(8)
            .map(|hit| {
                let triangle = u32::from_ne_bytes(word(hit));
                let t = f32::from_ne_bytes(word(&hit[4..]));
                (triangle != u32::MAX).then_some(f64::from(t))
            })
            .collect())
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // It ends by itself once stdin closes; on an error it must not linger.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
