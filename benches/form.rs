//! Time and memory of each step from chart to closed frame against the number of rods, on a
//! smooth dome. Prints a table: `cargo bench --bench form [-- MOST_RODS]`.
//!
//! Every time is the least of several runs, of large frames of one. `growth` is the exponent
//! of the whole time from the row before: 1 is linear. The first column of figures to compare
//! with is that of the paper (Table 1, closing only), whose contacts stay some thousandths of
//! a diameter open; `error` is that of the worst contact here, in diameters.

mod dome;
mod measure;

use dome::{Dome, dome_edge, settings};
use measure::{forget_peak, growth, least, ms, peak_memory};
use rodwright::frame::canvas::{Canvas, PlaneCanvas};
use rodwright::frame::close::project;
use rodwright::frame::form::{form, median_rise};
use rodwright::frame::gaps::Joint;
use rodwright::frame::{
    crop::{crop, held},
    lift::lift,
    weave::weave,
};
use rodwright::pattern::Pattern;
use rodwright::tiling::Placement;
use std::time::Duration;

/// Rod counts aimed at, each with the paper's seconds for closing so many.
const SIZES: [(f64, Option<f64>); 12] = [
    (24.0, Some(0.029)),
    (49.0, Some(0.186)),
    (97.0, Some(1.318)),
    (205.0, Some(12.13)),
    (413.0, Some(98.66)),
    (1e3, None),
    (2e3, None),
    (5e3, None),
    (2e4, None),
    (5e4, None),
    (1e5, None),
    (5e5, None),
];

/// Frames up to this many rods unless another number is given.
const MOST_RODS: f64 = 1e5;

const RUNS: usize = 7;
const BUDGET: Duration = Duration::from_secs(15);

fn main() {
    let most = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(MOST_RODS);
    println!(
        "{:>7} {:>9} {:>8} {:>10} {:>11} {:>10} {:>7} {:>8} {:>9} {:>5} {:>9} {:>10}",
        "rods",
        "contacts",
        "rod mm",
        "lift ms",
        "project ms",
        "all ms",
        "growth",
        "peak MB",
        "shaping",
        "exact",
        "error",
        "paper ms"
    );
    let mut last = None;
    for (rods, paper) in SIZES.into_iter().filter(|size| size.0 <= most) {
        let now = row(rods, paper, last);
        last = Some(now);
    }
}

/// One row; returns the number of rods and the whole time, ms.
fn row(rods: f64, paper: Option<f64>, last: Option<(f64, f64)>) -> (f64, f64) {
    let dome = Dome { radius: 300.0, part: 1.0 };
    let pattern = Pattern::named("4.4.4.4").expect("4.4.4.4 is in the library");
    let shape = pattern.usual();
    let edge = dome_edge(&dome, rods);
    let placement = Placement { origin: [0.0; 2].into(), rotation: 0.0, edge };
    forget_peak();
    let canvas = PlaneCanvas::new(&dome, pattern, placement, shape).expect("under a million");
    let (_, diameter) = median_rise(&canvas).expect("there are units");
    let (lift_time, (woven, lifted)) = least(RUNS, BUDGET, || {
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
    let (project_time, _) = least(RUNS, BUDGET, || {
        project(&mut lifted.axes.clone(), &joints).expect("contacts of a dome close")
    });
    let settings = settings(diameter, canvas.edge(), 0.0);
    let (time, formed) =
        least(RUNS, BUDGET, || form(&canvas, &settings).expect("a dome can be built"));
    let (rods, all) = (formed.frame.rods.len() as f64, ms(time));
    println!(
        "{rods:>7} {:>9} {diameter:>8.3} {:>10.2} {:>11.2} {all:>10.2} {:>7} {:>8.0} {:>9} {:>5} \
         {:>9.1e} {:>10}",
        formed.frame.contacts.len(),
        ms(lift_time),
        ms(project_time),
        growth(last, (rods, all)),
        peak_memory(),
        formed.closing.shaping,
        formed.closing.steps,
        formed.closing.error,
        paper.map_or_else(String::new, |s| format!("{:.0}", s * 1e3)),
    );
    (rods, all)
}
