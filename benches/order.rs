//! Time to find the order of assembly against the number of rods, on a smooth dome:
//! `cargo bench --bench order [-- MOST_RODS]`.
//!
//! `growth` is the exponent of the time from the row before: 1 is linear. Up to 3000 rods the
//! frame is checked as a whole again and again, beyond it each step against its neighbourhood.

mod dome;
mod measure;

use dome::standing_dome;
use measure::{forget_peak, growth, least, ms, peak_memory};
use rodwright::frame::Frame;
use rodwright::shop::{Order, OrderSettings, assembly};
use std::time::Duration;

/// Rod counts aimed at.
const SIZES: [f64; 7] = [1e2, 4e2, 1e3, 2e3, 1e4, 3e4, 1e5];
/// Frames up to this many rods unless another number is given.
const MOST_RODS: f64 = 1e5;

const RUNS: usize = 5;
const BUDGET: Duration = Duration::from_secs(3);

fn main() {
    let most = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(MOST_RODS);
    println!(
        "{:>7} {:>6} {:<6} {:>6} {:>6} {:>6} {:>7} {:>10} {:>7} {:>8}",
        "rods", "feet", "order", "steps", "props", "at once", "lifts", "ms", "growth", "peak MB"
    );
    let mut last = [None; 2];
    for rods in SIZES.into_iter().filter(|&size| size <= most) {
        let frame = standing_dome(rods);
        for (i, order) in [Order::Crown, Order::Ground].into_iter().enumerate() {
            last[i] = Some(row(&frame, order, last[i]));
        }
    }
}

/// One row; returns the number of rods and the time, ms.
fn row(frame: &Frame, order: Order, last: Option<(f64, f64)>) -> (f64, f64) {
    forget_peak();
    let settings = OrderSettings { order: Some(order), step_rods: None };
    let (time, made) =
        least(RUNS, BUDGET, || assembly(frame, &[], settings).expect("memory suffices"));
    let (rods, all) = (frame.rods.len() as f64, ms(time));
    println!(
        "{rods:>7} {:>6} {:<6} {:>6} {:>6} {:>7} {:>7} {all:>10.2} {:>7} {:>8.0}",
        frame.supports.len(),
        order.code(),
        made.steps.len(),
        made.props(),
        made.most_props(),
        made.lifts(),
        growth(last, (rods, all)),
        peak_memory(),
    );
    (rods, all)
}
