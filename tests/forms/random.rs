//! Random legal designs on random smooth surfaces: each gives a sound frame, or an error
//! that says why not.

use super::case::{Case, Refusal};
use super::rules::broken;
use rodwright::frame::close::Way;
use rodwright::frame::form::{FormSettings, Formed};
use rodwright::frame::layer::Layering;
use rodwright::pattern::{Pattern, Shape, library};
use rodwright::surface::samples::{dome::Ellipsoid, grid::strip, hall::Vault};
use rodwright::surface::{Mesh, Point3};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Splitmix64: numbers that depend on the seed alone.
struct Dice(u64);

impl Dice {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly between two figures.
    fn within(&mut self, [lo, hi]: [f64; 2]) -> f64 {
        lo + (hi - lo) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Evenly below a count.
    fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }
}

/// Edge of the meshes, mm: some thirty across.
const EDGE: f64 = 15.0;

/// A sheet with a few smooth bumps and dents.
fn bumps(dice: &mut Dice) -> Mesh {
    let [long, wide] = [0; 2].map(|_| dice.within([300.0, 600.0]));
    let count = 1 + dice.below(4);
    let bumps: Vec<[f64; 4]> = (0..count)
        .map(|_| {
            let reach = dice.within([100.0, 300.0]);
            let height = reach * dice.within([-0.3, 0.6]);
            let (x, y) = (dice.within([-0.5, 0.5]) * long, dice.within([-0.5, 0.5]) * wide);
            [x, y, reach, height]
        })
        .collect();
    strip([long, wide], EDGE, |u, v| {
        let (x, y) = (long * (u - 0.5), wide * (v - 0.5));
        let bump = |&[at_x, at_y, reach, height]: &[f64; 4]| {
            height * (-((x - at_x).powi(2) + (y - at_y).powi(2)) / (reach * reach)).exp()
        };
        Point3::new(x, y, bumps.iter().map(bump).sum())
    })
}

fn cap(dice: &mut Dice) -> Mesh {
    let half_axes = [0; 3].map(|_| dice.within([150.0, 350.0]));
    Ellipsoid { half_axes, cut: dice.within([0.0, 0.7]) }.mesh()
}

fn saddle(dice: &mut Dice) -> Mesh {
    let [long, wide] = [0; 2].map(|_| dice.within([300.0, 600.0]));
    let [up, down] = [0; 2].map(|_| dice.within([20.0, 150.0]));
    strip([long, wide], EDGE, |u, v| {
        let (x, y) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        Point3::new(long * x / 2.0, wide * y / 2.0, up * x * x - down * y * y)
    })
}

fn vault(dice: &mut Dice) -> Mesh {
    let [length, width] = [0; 2].map(|_| dice.within([250.0, 600.0]));
    Vault { length, width, reach: dice.within([20.0, 85.0]) }.mesh()
}

/// Turn and slide that the pattern takes, the mirror image's too.
fn shape(dice: &mut Dice, pattern: &Pattern) -> Shape {
    for _ in 0..100 {
        let turn = dice.within(pattern.turn.safe).to_radians();
        let slide = if dice.below(2) == 0 { 0.0 } else { dice.within(pattern.slide.safe) };
        let sign = if dice.below(2) == 0 { 1.0 } else { -1.0 };
        let shape = Shape { turn: sign * turn, slide: sign * slide };
        if pattern.check(shape).is_ok() {
            return shape;
        }
    }
    pattern.usual()
}

/// The design of a seed.
fn case(seed: u64) -> Case {
    let dice = &mut Dice(seed);
    let mesh = [bumps, cap, saddle, vault][dice.below(4)](dice);
    let pattern = &library()[dice.below(library().len())];
    // As many thin ones as thick ones.
    let diameter = dice.within([1.2f64.ln(), 5f64.ln()]).exp();
    let low = mesh.points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    Case {
        mesh,
        pattern,
        shape: shape(dice, pattern),
        origin: [0; 2].map(|_| dice.within([-50.0, 50.0])),
        rotation: dice.within([-PI, TAU]),
        edge: None,
        settings: FormSettings {
            diameter,
            sizes: Default::default(),
            overhang: diameter * dice.within([1.0, 3.0]),
            round: [0.0, 0.5, 1.0][dice.below(3)],
            share: rodwright::frame::share::Share::Off,
            // Mostly as most people leave it.
            layering: [Layering::Auto, Layering::Auto, Layering::Follow][dice.below(3)],
            way: [Way::Shape, Way::Shape, Way::Least][dice.below(3)],
            surface_low: low,
        },
    }
}

/// What came of the cases of many seeds.
#[derive(Default)]
struct Tally {
    /// Frames, refusals by kind, and what must not be.
    counts: BTreeMap<String, usize>,
    /// Units left out of the frames, and units in them.
    left_out: usize,
    units: usize,
    wrong: Vec<String>,
}

impl Tally {
    fn add(&mut self, seed: u64) {
        let made = catch_unwind(AssertUnwindSafe(|| {
            let case = case(seed);
            let formed = case.form();
            (case, formed)
        }));
        let Ok((case, made)) = made else {
            self.wrong.push(format!("seed {seed}: panic"));
            return;
        };
        let name = &case.pattern.name;
        let kind = match made {
            Ok(Formed { frame, .. }) => {
                self.left_out += frame.dropped.len();
                self.units += frame.units.len();
                let broken = broken(&frame);
                if let Some(first) = broken.first() {
                    let all = broken.len();
                    self.wrong.push(format!("seed {seed}, {name}: {all} faults, first {first}"));
                }
                "frame".into()
            }
            Err(Refusal { kind, message }) => {
                if message.trim().is_empty() {
                    self.wrong.push(format!("seed {seed}, {name}: {kind} without a message"));
                }
                kind
            }
        };
        *self.counts.entry(kind).or_default() += 1;
    }

    fn of(seeds: std::ops::Range<u64>) -> Self {
        let mut tally = Self::default();
        seeds.for_each(|seed| tally.add(seed));
        tally
    }

    fn check(&self) {
        for (kind, count) in &self.counts {
            println!("{count:4} {kind}");
        }
        println!("{} units, {} left out", self.units, self.left_out);
        assert!(self.wrong.is_empty(), "{}", self.wrong.join("\n"));
    }
}

#[test]
fn a_dozen_random_designs_give_sound_frames_or_say_why_not() {
    let tally = Tally::of(0..12);
    tally.check();
    assert!(tally.counts["frame"] >= 4, "{:?}", tally.counts);
}

/// Run with `cargo test --release --test forms -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn five_hundred_random_designs_give_sound_frames_or_say_why_not() {
    let tally = Tally::of(1000..1500);
    tally.check();
    assert!(tally.counts["frame"] >= 250, "{:?}", tally.counts);
}
