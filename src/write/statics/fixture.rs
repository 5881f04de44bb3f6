//! A study of a small frame for the tests of its writers.

use crate::frame::Frame;
use crate::frame::fixture::circuit;
use crate::ids::{Id, RodId};
use crate::statics::fixture::question;
use crate::statics::framework::{Assumptions, Feet};
use crate::statics::joint::Hold;
use crate::statics::study::{Combination, PointLoad, Question, Study, study};
use crate::surface::Vector3;

/// Three rods of 3 mm in a circuit, in two cases: the weight, and that with a force.
pub(super) fn three_rods(hold: Hold, feet: Feet) -> Study {
    loaded(&circuit(3, 3.0), hold, feet)
}

/// The same question of any frame.
pub(super) fn loaded(frame: &Frame, hold: Hold, feet: Feet) -> Study {
    let usual = question(frame, 1.0);
    let force = Vector3::new(0.5, 0.0, -2.0);
    let case =
        |name: &str, points| Combination { name: name.into(), weight: 1.0, area: 0.0, points };
    let question = Question {
        taken: Assumptions { hold, feet, ..usual.taken },
        points: vec![PointLoad { rod: RodId::new(1), at: 30.0, force }],
        combinations: vec![case("weight", 0.0), case("weight + loads", 1.0)],
        ..usual
    };
    study(frame, question).unwrap()
}
