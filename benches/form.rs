//! Time of each step from chart to closed frame against the number of rods, on the
//! igloo. Prints a table: `cargo bench --bench form`.
//!
//! Every row is the least of several runs. The first columns say what was made; the
//! error is that of the worst contact, as part of the rod diameter.

use rodwright::chart::{Method, PlanarChart};
use rodwright::frame::canvas::PlaneCanvas;
use rodwright::frame::close::{Way, project};
use rodwright::frame::fit::{Fit, fit};
use rodwright::frame::form::{FormSettings, form};
use rodwright::frame::gaps::Joint;
use rodwright::frame::layer::Layering;
use rodwright::frame::{
    crop::{crop, held},
    lift::lift,
    weave::weave,
};
use rodwright::pattern::Pattern;
use rodwright::surface::samples::sample;
use rodwright::surface::topology::require_disk;
use rodwright::tiling::Placement;
use std::time::{Duration, Instant};

/// Rod counts aimed at: those of the paper's Table 1, then larger ones.
const SIZES: [f64; 9] = [24.0, 49.0, 97.0, 205.0, 413.0, 500.0, 1000.0, 5000.0, 20000.0];

const RUNS: usize = 5;

/// Rods of the igloo with 3 mm sticks at fit; their number grows as one over the diameter.
const RODS_AT_3_MM: f64 = 141.0;

/// The least time of several runs, and the last result.
fn least<T>(mut work: impl FnMut() -> T) -> (Duration, T) {
    let mut best: Option<(Duration, T)> = None;
    for _ in 0..RUNS {
        let start = Instant::now();
        let result = work();
        let time = start.elapsed();
        let shorter = best.as_ref().map_or(time, |b| time.min(b.0));
        best = Some((shorter, result));
    }
    best.expect("at least one run")
}

fn main() {
    let mesh = sample("igloo").expect("the igloo is a sample");
    let topology = require_disk(&mesh).expect("the igloo is a disk");
    let (chart_time, chart) = least(|| {
        PlanarChart::new(mesh.clone(), &topology, Method::Abf).expect("the igloo flattens")
    });
    println!("chart of {} triangles: {:.1} ms", mesh.triangles.len(), ms(chart_time));
    println!(
        "{:>6} {:>9} {:>9} {:>8} {:>10} {:>10} {:>10} {:>6} {:>9}",
        "rods", "contacts", "rod mm", "fit ms", "lift ms", "close ms", "all ms", "steps", "error"
    );
    for size in SIZES {
        row(&chart, 3.0 * RODS_AT_3_MM / size);
    }
    println!("peak memory {}", peak_memory());
}

fn row(chart: &PlanarChart, diameter: f64) {
    let pattern = Pattern::named("4.4.4.4").expect("4.4.4.4 is in the library");
    let shape = pattern.usual();
    let start = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge: 1.0 };
    let (fit_time, found) = least(|| fit(chart, pattern, &start, shape, diameter));
    // Thick rods leave too few units for a fit; the square law still places them.
    let edge = found.map_or_else(|_| 75.0 * (diameter / 3.0).sqrt(), |f: Fit| f.edge);
    let placement = Placement { edge, ..start };
    let canvas = PlaneCanvas::new(chart, pattern, placement, shape).expect("under a million");
    let (lift_time, (woven, lifted)) = least(|| {
        let tiles = crop(&canvas, &held(&canvas));
        let woven = weave(&canvas, &tiles).expect("cropped tiles lie on the chart");
        let lifted = lift(&woven).expect("rods of a regular tile are not parallel");
        (woven, lifted)
    });
    let joints = woven
        .contacts
        .iter()
        .map(|c| Joint {
            over: c.ending,
            under: c.passing,
            outward: c.on.normal,
            diameter,
            kind: c.kind,
        })
        .collect();
    let (close_time, closing) = least(|| project(&mut lifted.axes.clone(), &joints));
    let settings = FormSettings {
        sizes: Default::default(),
        diameter,
        overhang: 2.0 * diameter,
        round: 0.5,
        layering: Layering::Auto,
        way: Way::default(),
        surface_low: 0.0,
    };
    let (all_time, _) = least(|| form(&canvas, &settings));
    let (steps, error) = closing.map_or((0, f64::NAN), |c| (c.steps, c.error));
    println!(
        "{:>6} {:>9} {diameter:>9.3} {:>8.1} {:>10.2} {:>10.2} {:>10.2} {steps:>6} {error:>9.1e}",
        woven.rods.len(),
        woven.contacts.len(),
        ms(fit_time),
        ms(lift_time),
        ms(close_time),
        ms(all_time),
    );
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// The process' peak memory where the system tells it.
fn peak_memory() -> String {
    std::fs::read_to_string("/proc/self/status")
        .ok()
        .and_then(|s| s.lines().find_map(|l| l.strip_prefix("VmHWM:").map(str::to_string)))
        .map_or_else(|| "unknown".into(), |m| m.trim().to_string())
}
