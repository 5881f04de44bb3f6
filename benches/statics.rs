//! Time to solve the statics of a frame against its number of rods, on a smooth dome that stands
//! on its rim: `cargo bench --bench statics [-- MOST_RODS]`.
//!
//! `solve` is from the frame to displacements under its weight and a load: cutting the rods,
//! assembling, factoring, looking for free modes, solving, the stresses of all rods. `growth` is the exponent of that
//! time from the row before. `unbalanced` is what loads and reactions lack of equilibrium,
//! as part of the load. Rods are as thick as suits the units, so the more there are the thinner
//! and softer they are: the largest domes are too soft for some contacts, and are refused.

mod dome;
mod measure;

use dome::standing_dome;
use measure::{forget_peak, growth, least, ms, peak_memory};
use rodwright::frame::Frame;
use rodwright::statics::framework::Feet;
use rodwright::statics::joint::Hold;
use rodwright::statics::material::Material;
use rodwright::statics::solve::StaticsError;
use rodwright::statics::study::{Combination, Largest, Study, study};
use rodwright::statics::wish::{Target, Wish, WishedLoad};
use rodwright::surface::Vector3;
use std::time::Duration;

/// Rod counts aimed at.
const SIZES: [f64; 7] = [1e2, 4e2, 1e3, 4e3, 2e4, 5e4, 1e5];
/// Frames up to this many rods unless another number is given.
const MOST_RODS: f64 = 2e4;

const RUNS: usize = 10;
const BUDGET: Duration = Duration::from_secs(5);

fn main() {
    let most = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(MOST_RODS);
    println!(
        "{:>7} {:>7} {:>7} {:>10} {:>7} {:>8} {:>11} {:>10} {:>10}",
        "rods",
        "beams",
        "joint",
        "solve ms",
        "growth",
        "peak MB",
        "unbalanced",
        "strength %",
        "moves mm"
    );
    let holds = [Hold::Nailed, Hold::Tied, Hold::Notched];
    let mut last = [None; 3];
    for rods in SIZES.into_iter().filter(|&size| size <= most) {
        let frame = standing_dome(rods);
        for (last, hold) in last.iter_mut().zip(holds) {
            *last = Some(row(&frame, hold, *last));
        }
    }
}

/// One row; returns the number of rods and the time, ms.
fn row(frame: &Frame, hold: Hold, last: Option<(f64, f64)>) -> (f64, f64) {
    forget_peak();
    let case =
        |name: &str, points| Combination { name: name.into(), weight: 1.0, area: 0.0, points };
    let down = WishedLoad { on: Target::Top, force: -Vector3::z() };
    let wish = Wish {
        material: Material::default(),
        material_name: "pine".into(),
        hold,
        feet: Feet::Pinned,
        span: None,
        loads: vec![down],
        pressure: 0.0,
        combinations: vec![case("weight and load", 1.0)],
        add_feet: false,
    };
    let solve = || study(frame, wish.about(frame).expect("there is a rod"));
    let (time, found) = least(RUNS, BUDGET, solve);
    let (rods, all) = (frame.rods.len() as f64, ms(time));
    let found: Study = match found {
        Ok(found) => found,
        Err(StaticsError::Loose(loose)) => {
            let how = if loose.nearly { "too soft" } else { "loose" };
            println!("{rods:>7} {:>7} {:>7} {all:>10.2} {how}", "", hold.code());
            return (rods, all);
        }
        Err(e) => panic!("{e}"),
    };
    let most = |of: Vec<Largest>| of.into_iter().map(|l| l.value).fold(0.0, f64::max);
    let unbalanced = found.cases.iter().map(|c| c.unbalanced(found.model())).fold(0.0, f64::max);
    println!(
        "{rods:>7} {:>7} {:>7} {all:>10.2} {:>7} {:>8.0} {unbalanced:>11.1e} {:>10.4} {:>10.4}",
        found.model().beams.len(),
        hold.code(),
        growth(last, (rods, all)),
        peak_memory(),
        100.0 * most(found.worst()),
        most(found.displacements()),
    );
    (rods, all)
}
