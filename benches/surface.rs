//! Time and memory from a file's bytes to the chart and to located points, against the
//! number of triangles. Prints a table: `cargo bench --bench surface`, or some of its
//! rows: `cargo bench --bench surface -- 1000 100000`.
//!
//! The surface is a bumpy disk with a pocket deeper than wide, so that the map has to
//! stretch far. Every map is made in a process of its own, so that its peak of memory is
//! its own. Times are CPU seconds where the system tells them, of one run.

use rodwright::chart::{Chart, Method, PlanarChart};
use rodwright::surface::locate::{Locator, PlanarLocator};
use rodwright::surface::read::read_bytes;
use rodwright::surface::samples::grid::revolve;
use rodwright::surface::topology::require_disk;
use rodwright::surface::{Mesh, Point3, Vector3};
use rodwright::write::obj::write_obj;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::process::Command;
use std::time::Instant;

/// Triangles aimed at, and whether ABF++ is tried.
const SIZES: [(usize, bool); 6] = [
    (1_000, true),
    (10_000, true),
    (90_000, true),
    (360_000, true),
    (400_000, true),
    (1_000_000, false),
];

/// CPU seconds of others for ABF on another surface (a camel's head) of about as many
/// triangles: Blender, OpenABF.
const OTHERS: [(usize, [f64; 2]); 2] = [(90_000, [26.0, 38.0]), (360_000, [224.0, 275.0])];

/// Points located in each test.
const POINTS: usize = 100_000;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    match args.first().map(String::as_str) {
        Some("chart") => chart_row(&args[1], &args[2]),
        Some("steps") => steps_row(&args[1]),
        _ => table(&args),
    }
}

fn table(args: &[String]) {
    let wanted: Vec<usize> = args.iter().filter_map(|a| a.parse().ok()).collect();
    let sizes = SIZES.iter().filter(|(n, _)| wanted.is_empty() || wanted.contains(n));
    println!("seconds; angle errors are means in degrees; memory is the peak of a process");
    println!(
        "triangles |   read  shape  trees  plane  space |     ABF steps   angle  flips   scale   \
         memory |    LSCM   angle  flips   memory | ABF of Blender, OpenABF"
    );
    for &(n, abf) in sizes {
        let n_text = n.to_string();
        let steps = child(&["steps", &n_text]);
        let abf = if abf { child(&["chart", &n_text, "abf"]) } else { "-".into() };
        let lscm = child(&["chart", &n_text, "lscm"]);
        let lscm: Vec<&str> = lscm.split_whitespace().collect();
        let lscm = match lscm[..] {
            [time, _, angle, flips, _, memory] => {
                format!("{time:>7} {angle:>7} {flips:>6} {memory:>8}")
            }
            _ => lscm.join(" "),
        };
        let others = OTHERS.iter().find(|o| o.0 == n);
        let others = others.map_or_else(|| "-".into(), |o| format!("{} {}", o.1[0], o.1[1]));
        println!("{steps} | {abf:>46} | {lscm:>31} | {others}");
    }
}

/// What this program prints when it does one part of a row.
fn child(args: &[&str]) -> String {
    let me = std::env::current_exe().expect("a running program has a file");
    let out = Command::new(me).args(args).output().expect("it runs again");
    if out.status.success() {
        String::from_utf8_lossy(&out.stdout).trim_end().to_string()
    } else {
        "failed".into()
    }
}

/// Reading, connectivity, trees and queries.
fn steps_row(size: &str) {
    let bytes = write_obj(&dented(size.parse().expect("a number"))).into_bytes();
    let (read, reading) = timed(|| read_bytes("dented.obj", &bytes, None).expect("it reads"));
    let mesh = reading.mesh;
    let (shape, _) = timed(|| require_disk(&mesh).expect("it is a disk"));
    let [lo, hi] = mesh.bounds().expect("it has points");
    // Seen from above the walls of the pocket stand on each other; that is no matter here.
    let flat: Vec<_> = mesh.points.iter().map(|p| p.xy()).collect();
    let (trees, (plane, space)) =
        timed(|| (PlanarLocator::new(&flat, &mesh.triangles), Locator::new(&mesh)));
    let points: Vec<Point3> = (0..POINTS).map(|i| scattered(i, lo, hi)).collect();
    let (in_plane, hits) = timed(|| points.iter().filter_map(|p| plane.locate(p.xy())).count());
    let (in_space, far) =
        timed(|| points.iter().map(|&p| space.closest(p).distance).fold(0.0, f64::max));
    assert!(hits > POINTS / 2 && far > 0.0, "points lie over the surface");
    println!(
        "{:>9} | {read:>6.2} {shape:>6.2} {trees:>6.2} {in_plane:>6.2} {in_space:>6.2}",
        mesh.triangles.len()
    );
}

/// A map and its figures.
fn chart_row(size: &str, method: &str) {
    let mesh = match size.parse() {
        Ok(triangles) => dented(triangles),
        Err(_) => {
            read_bytes(size, &std::fs::read(size).expect("a file"), None).expect("a surface").mesh
        }
    };
    let method = if method == "lscm" { Method::Lscm } else { Method::Abf };
    let topology = require_disk(&mesh).expect("it is a disk");
    let (time, chart) = timed(|| PlanarChart::new(mesh, &topology, method));
    let chart = match chart {
        Ok(chart) => chart,
        Err(e) => return println!("{e}"),
    };
    let d = chart.distortion();
    if let Some(why) = &d.fallback {
        return println!("{why}");
    }
    let flips = chart.mesh().triangles.iter().filter(|t| {
        let [a, b, c] = t.map(|v| chart.flat()[rodwright::ids::Id::index(v)]);
        (b - a).perp(&(c - a)) <= 0.0
    });
    assert!(chart.bounds()[0].x.is_finite());
    println!(
        "{time:>7.2} {:>5} {:>7.3} {:>6} {:>7.1} {:>8}",
        d.steps,
        d.mean_angle.to_degrees(),
        flips.count(),
        d.scale_most[1] / d.scale_most[0],
        peak_memory()
    );
}

/// A point somewhere in a box, the same for the same number: steps of an irrational
/// part of each side fill it evenly.
fn scattered(i: usize, lo: Point3, hi: Point3) -> Point3 {
    let part = [0.754_877_666, 0.569_840_291, 0.438_579_021].map(|s: f64| (s * i as f64).fract());
    Point3::from(lo.coords + (hi - lo).component_mul(&Vector3::from(part)))
}

/// A round plate, 600 mm across, with a pocket 120 mm wide and 240 mm deep in its middle,
/// bumpy all over.
fn dented(triangles: usize) -> Mesh {
    const ROUND: f64 = 60.0;
    const WALL: f64 = 150.0;
    const LIP: f64 = 30.0;
    const PLATE: f64 = 210.0;
    let ends = [ROUND * FRAC_PI_2, WALL, LIP * FRAC_PI_2, PLATE];
    let profile = |s: f64| {
        let mut rest = s;
        let part = ends.map(|end| {
            let here = rest.clamp(0.0, end);
            rest -= here;
            here
        });
        let (bottom, lip) = (part[0] / ROUND, part[2] / LIP);
        let radius = ROUND * bottom.sin() + LIP * (1.0 - lip.cos()) + part[3];
        [radius, ROUND * (1.0 - bottom.cos()) + part[1] + LIP * lip.sin()]
    };
    let length: f64 = ends.iter().sum();
    // Area of the surface of revolution, by strips.
    let strip = length / 1000.0;
    let area: f64 = (0..1000).map(|i| TAU * profile((i as f64 + 0.5) * strip)[0] * strip).sum();
    let edge = (area / (triangles as f64 * 0.433)).sqrt();
    let mut mesh = revolve(length, edge, profile);
    for p in mesh.points.iter_mut() {
        *p = bumped(*p);
    }
    mesh
}

/// Bends space in five octaves of waves, each as steep as the others. The slopes add
/// up to less than one, so that the surface never meets itself.
fn bumped(p: Point3) -> Point3 {
    let mut moved = p;
    for octave in 0..5 {
        let length = 160.0 / f64::from(1 << octave);
        let height = 0.025 * length;
        let wave =
            |x: f64, y: f64| height * (TAU * (x + 0.4 * y) / length + f64::from(octave)).sin();
        moved.x += wave(p.y, p.z);
        moved.y += wave(p.z, p.x);
        moved.z += wave(p.x, p.y) + wave(p.y, -p.x);
    }
    moved
}

/// Runs some work; its CPU seconds, or wall seconds where the system does not tell them.
fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let (start, cpu) = (Instant::now(), cpu_seconds());
    let result = work();
    let wall = start.elapsed().as_secs_f64();
    (cpu_seconds().zip(cpu).map_or(wall, |(after, before)| after - before), result)
}

/// CPU seconds of this thread so far; all work here is done in one.
fn cpu_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(|ns: f64| ns * 1e-9)
}

/// The process' peak memory in MB where the system tells it.
fn peak_memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kb = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    kb.map_or_else(|| "unknown".into(), |kb| format!("{:.0}MB", kb / 1024.0))
}
