//! How far rods are used up: along each of them, and at most.

use super::beam;
use super::stress::{peak, stress_at};
use super::study::Study;
use crate::ids::{IdVec, RodId};

/// A stretch of a rod and how far it is used up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stretch {
    /// Where it begins, from end A of the rod, mm at the model's scale.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// The largest utilisation in it, of all cases.
    pub utilisation: f64,
}

/// The figures of a rod.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct RodFigures {
    /// The case with the largest stress.
    pub case: usize,
    /// That stress, von Mises, MPa.
    pub stress: f64,
    /// Where, from end A, mm of the frame as it is built.
    pub at: f64,
    /// Stress by strength.
    pub utilisation: f64,
    /// The largest displacement of its nodes in any case, mm at the model's scale.
    pub displacement: f64,
}

/// Pieces between nodes are divided into at most so many stretches …
const MOST_PARTS: usize = 6;
/// … and into fewer where a frame would have more stretches than this: pictures of it are too
/// small to show them, and files would grow.
const MOST_STRETCHES: usize = 30_000;

/// The stretches of each rod, from end A to end B. Those about the place of its largest
/// stress have the utilisation of [`Study::worst`].
pub fn along(study: &Study) -> IdVec<RodId, Vec<Stretch>> {
    let model = study.model();
    let parts = (MOST_STRETCHES / model.beams.len().max(1)).clamp(1, MOST_PARTS);
    let mut rods: IdVec<RodId, Vec<Stretch>> = vec![Vec::new(); study.framework.rods.len()].into();
    for (i, beam) in model.beams.iter().enumerate() {
        let stretches = &mut rods[beam.rod];
        let start = stretches.last().map_or(0.0, |s| s.to);
        let length = model.along(beam).norm();
        let place = |k: usize| length * k as f64 / parts as f64;
        let stress = stresses(study, i, length, parts);
        stretches.extend(stress.iter().enumerate().map(|(k, stress)| Stretch {
            from: start + place(k),
            to: start + place(k + 1),
            utilisation: stress / model.material.strength,
        }));
    }
    rods
}

/// The largest stress in each of the parts of a beam, of all cases: of both ends of the part,
/// and of the beam's peak where it lies in it.
fn stresses(study: &Study, i: usize, length: f64, parts: usize) -> Vec<f64> {
    let model = study.model();
    let beam = &model.beams[i];
    let axes = beam::axes(&model.along(beam));
    let mut most = vec![0.0f64; parts];
    for case in &study.cases {
        let (ends, q) = (&case.response.beams[i], axes * case.load.beams[i]);
        let at = |k: usize| stress_at(beam, ends, &q, length * k as f64 / parts as f64);
        for (k, most) in most.iter_mut().enumerate() {
            *most = most.max(at(k)).max(at(k + 1));
        }
        let peak = peak(beam, length, ends, &q);
        let part = (peak.at / length * parts as f64) as usize;
        let holds = &mut most[part.min(parts - 1)];
        *holds = holds.max(peak.stress);
    }
    most
}

/// The figures of each rod; without cases all are 0.
pub fn rod_figures(study: &Study) -> IdVec<RodId, RodFigures> {
    let mut rods: IdVec<RodId, RodFigures> =
        vec![RodFigures::default(); study.framework.rods.len()].into();
    for worst in study.worst() {
        let stress = worst.value * study.question.taken.material.strength;
        let rod = &mut rods[worst.rod];
        (rod.case, rod.stress, rod.utilisation) = (worst.case, stress, worst.value);
        rod.at = worst.at / study.question.taken.scale;
    }
    for moved in study.displacements() {
        rods[moved.rod].displacement = moved.value;
    }
    rods
}

/// The largest utilisation of all rods: where scales of colour end.
pub fn most_used(figures: &IdVec<RodId, RodFigures>) -> f64 {
    figures.iter().map(|rod| rod.utilisation).fold(0.0, f64::max)
}

/// A utilisation as share of the largest one; 0 where nothing is stressed.
pub fn share(utilisation: f64, largest: f64) -> f64 {
    if largest > 0.0 { (utilisation / largest).clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statics::fixture::studied;

    #[test]
    fn stretches_cover_their_rods_and_hold_the_largest_stress() {
        for scale in [1.0, 10.0] {
            let (frame, study) = studied(6, scale);
            let figures = rod_figures(&study);
            for (rod, stretches) in along(&study).enumerate() {
                assert_eq!(stretches[0].from, 0.0);
                assert!(stretches.windows(2).all(|w| w[0].to == w[1].from));
                let length = frame.rods[rod].axis.length() * scale;
                let end = stretches.last().unwrap().to;
                assert!((end - length).abs() < 1e-9 * length, "{end}, not {length}");
                let most = stretches.iter().map(|s| s.utilisation).fold(0.0, f64::max);
                let figure = &figures[rod];
                assert!((most - figure.utilisation).abs() <= 1e-12 * most, "{rod}");
                let near = |s: &&Stretch| {
                    let slack = 1e-9 * length;
                    (s.from - slack..=s.to + slack).contains(&(figure.at * scale))
                };
                let there = stretches.iter().filter(near).map(|s| s.utilisation);
                assert!(there.fold(0.0, f64::max) >= most * (1.0 - 1e-12), "{rod}");
            }
        }
    }

    /// A rod that carries its own weight between contacts is not as stressed everywhere.
    #[test]
    fn free_ends_are_hardly_stressed() {
        let (_, study) = studied(6, 1.0);
        let largest = most_used(&rod_figures(&study));
        for stretches in along(&study).iter() {
            assert!(stretches.last().unwrap().utilisation < 0.5 * largest);
        }
    }

    #[test]
    fn shares_of_nothing_are_none() {
        assert_eq!([share(0.2, 0.4), share(1.0, 0.4), share(0.0, 0.0)], [0.5, 1.0, 0.0]);
    }
}
