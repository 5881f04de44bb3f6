//! Sawing plans of random rods against their number: bars by best-fit decreasing and by the full
//! plan, the bound, and time: `cargo bench --bench saw`.

use rodwright::ids::{IdVec, RodId};
use rodwright::shop::Stick;
use rodwright::shop::saw::{CutPlan, Effort, Offer, Stock, plan_by};
use std::time::Instant;

fn main() {
    println!(
        "{:<34} {:>6} {:>9} {:>9} {:>9} {:>7} {:>9}",
        "stock", "rods", "best fit", "plan", "bound", "proven", "ms"
    );
    let priced = |length, price| Offer { price: Some(price), ..Offer::plain(length) };
    let stocks = [
        ("1000 mm, rods of 120 to 400 mm", vec![Offer::plain(1000.0)], [120.0, 400.0], 0.5),
        ("300 mm, rods of 40 to 140 mm", vec![Offer::plain(300.0)], [40.0, 140.0], 0.5),
        ("1000 mm, rods not rounded", vec![Offer::plain(1000.0)], [120.0, 400.0], 0.0),
        (
            "three lengths with prices",
            vec![priced(1000.0, 1.2), priced(2000.0, 2.1), priced(2500.0, 2.9)],
            [120.0, 700.0],
            0.5,
        ),
    ];
    for (name, bars, lengths, round) in stocks {
        for rods in [50, 100, 200, 400, 1000] {
            let stock = Stock { bars: bars.clone(), kerf: 1.0, ..Stock::default() };
            row(name, &sticks(rods, lengths, round), &stock);
        }
    }
}

fn row(name: &str, sticks: &IdVec<RodId, Stick>, stock: &Stock) {
    let made = |effort| plan_by(sticks, stock, effort).expect("the stock holds all rods");
    let quick: CutPlan = made(Effort::BestFit);
    let start = Instant::now();
    let full = made(Effort::Full);
    let ms = start.elapsed().as_secs_f64() * 1e3;
    let proven = if full.is_proven() { "yes" } else { "no" };
    let (rods, least) = (sticks.len(), full.least);
    println!(
        "{name:<34} {rods:>6} {:>9.2} {:>9.2} {least:>9.2} {proven:>7} {ms:>9.1}",
        quick.spent, full.spent
    );
}

/// Rods of random lengths, multiples of `round`.
fn sticks(count: usize, [least, most]: [f64; 2], round: f64) -> IdVec<RodId, Stick> {
    let mut state = 12_345_u64 + count as u64;
    let length = |_| {
        // Knuth's linear congruential generator.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let part = (state >> 11) as f64 / (1_u64 << 53) as f64;
        let length = least + (most - least) * part;
        if round > 0.0 { (length / round).round() * round } else { length }
    };
    (0..count).map(length).map(|length| Stick { length, diameters: [3.0; 2] }).collect()
}
