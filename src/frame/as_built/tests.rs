use super::*;
use crate::frame::fixture::{circuit, on_sample};
use crate::ids::UnitId;

const CUTTING: Cutting = Cutting { overhang: 6.0, round: 0.5 };

fn id(i: usize) -> RodId {
    RodId::new(i)
}

/// The marks of a rod as planned, each off by so much, as rows.
fn rows(plan: &Frame, rod: RodId, off: impl Fn(usize) -> f64) -> Vec<Measured> {
    let row = |(i, &c): (usize, &ContactId)| {
        let at = plan.seen_from(c, rod).at + off(i);
        let mark = MeasuredMark { mate: None, contact: Some(c), at };
        Measured { line: i as u64 + 2, rod, mark: Some(mark), diameter: None }
    };
    let crossing = |c: &&ContactId| plan.met_end(**c, rod).is_none();
    plan.rods[rod].contacts.iter().filter(crossing).enumerate().map(row).collect()
}

fn diameter(rod: RodId, a: f64, b: Option<f64>) -> Measured {
    Measured { line: 2, rod, mark: None, diameter: Some((a, b)) }
}

/// Contacts exact, and marks where the axes say.
fn require_exact(frame: &Frame) {
    for contact in &frame.contacts {
        let off = contact.gap - frame.wanted_gap(contact);
        assert!(off.abs() < 1e-9 * frame.diameter, "{off}");
        let [p, q] = [(contact.over, contact.at_over), (contact.under, contact.at_under)]
            .map(|(rod, at)| frame.rods[rod].axis.at(at));
        assert!(((p - q).norm() - contact.gap).abs() < 1e-9);
    }
    for support in &frame.supports {
        assert!((support.point.z - frame.ground).abs() < 1e-9);
        assert_eq!(support.point, frame.end(support.rod, support.end));
    }
}

fn largest_move(plan: &Frame, frame: &Frame) -> f64 {
    let ends = plan.rods.iter().zip(frame.rods.iter());
    ends.map(|(p, q)| (p.axis.a - q.axis.a).norm().max((p.axis.b - q.axis.b).norm()))
        .fold(0.0, f64::max)
}

#[test]
fn what_was_planned_changes_nothing() {
    for plan in [circuit(5, 3.0), on_sample("igloo", "4.4.4.4")] {
        let all: Vec<Measured> =
            plan.rods.ids().flat_map(|rod| rows(&plan, rod, |_| 0.0)).collect();
        let some = rows(&plan, id(2), |_| 0.0);
        for measured in [all, some, vec![diameter(id(1), 3.0, None)]] {
            let (frame, what) = as_built(&plan, &measured, CUTTING).unwrap();
            require_exact(&frame);
            assert!(largest_move(&plan, &frame) < 1e-6, "{}", largest_move(&plan, &frame));
            assert!(what.deviation < 1e-6 && what.mark_change < 1e-6, "{what:?}");
            assert!(what.mark_again.is_empty() && what.saw_again.is_empty(), "{what:?}");
        }
    }
}

#[test]
fn a_stick_that_stands_meets_its_marks_and_the_ground() {
    let plan = circuit(5, 3.0);
    let measured = rows(&plan, id(1), |i| [2.0, -0.7][i]);
    let (frame, what) = as_built(&plan, &measured, CUTTING).unwrap();
    require_exact(&frame);
    assert!(what.deviation < 1e-9, "{what:?}");
    let length = |frame: &Frame| frame.rods[id(1)].axis.length();
    assert!((length(&frame) - length(&plan)).abs() < 1e-9);
    assert_eq!((what.sawn.as_slice(), what.marks), (&[id(1)][..], 2));
    for row in &measured {
        let mark = row.mark.unwrap();
        let at = frame.seen_from(mark.contact.unwrap(), id(1)).at;
        assert!((at - mark.at).abs() < 1e-9);
    }
    assert_eq!(frame.rods[id(1)].contacts, plan.rods[id(1)].contacts);
}

#[test]
fn measured_diameters_set_the_gaps() {
    let plan = circuit(4, 3.0);
    let measured = [diameter(id(0), 3.3, None), diameter(id(2), 2.9, Some(2.5))];
    let (frame, what) = as_built(&plan, &measured, CUTTING).unwrap();
    require_exact(&frame);
    assert_eq!(what.diameters, 2);
    assert_eq!(frame.rods[id(2)].diameters, [2.9, 2.5]);
    let between = frame.contacts.iter().find(|c| [c.over, c.under] == [id(0), id(1)]).unwrap();
    assert!((between.gap - 3.15).abs() < 1e-9);
    for (rod, planned) in frame.rods.iter().zip(plan.rods.iter()) {
        let off = rod.axis.length() * 2.0 - (rod.axis.length() * 2.0).round();
        assert!(off.abs() < 1e-6, "cut to half mm, as {} was", planned.axis.length());
    }
}

/// Sticks here and there on real frames, with marks a little off.
#[test]
fn marks_of_some_sticks_are_met_on_real_frames() {
    for (surface, pattern) in
        [("igloo", "4.4.4.4"), ("igloo", "squares-end-to-end"), ("vault", "3.6.3.6")]
    {
        let plan = on_sample(surface, pattern);
        let sawn = || plan.rods.ids().filter(|r| r.index() % 17 == 5);
        let off = |r: RodId| move |i: usize| 0.3 * ((r.index() * 7 + i * 3) as f64).sin();
        let measured: Vec<_> = sawn().flat_map(|r| rows(&plan, r, off(r))).collect();
        let (frame, what) = as_built(&plan, &measured, CUTTING).unwrap();
        require_exact(&frame);
        assert!(what.deviation < 1e-9, "{surface} {pattern}: {what:?}");
        for r in sawn() {
            let change = frame.rods[r].axis.length() - plan.rods[r].axis.length();
            assert!(change.abs() < 1e-9, "{surface} {pattern}: {r} {change}");
        }
        assert_eq!(what.marks, measured.len());
    }
}

/// With all sticks marked, inside a frame four marks share three freedoms.
#[test]
fn marks_that_contradict_each_other_are_met_as_near_as_can_be() {
    let plan = on_sample("igloo", "4.4.4.4");
    let off = |r: RodId| move |i: usize| 0.3 * ((r.index() * 7 + i * 3) as f64).sin();
    let measured: Vec<_> = plan.rods.ids().flat_map(|r| rows(&plan, r, off(r))).collect();
    let (frame, what) = as_built(&plan, &measured, CUTTING).unwrap();
    require_exact(&frame);
    assert!(what.deviation > 0.01 && what.deviation < 0.6, "{what:?}");
    assert_eq!(what.mark_change, 0.0);
}

fn refusal(plan: &Frame, measured: &[Measured]) -> String {
    as_built(plan, measured, CUTTING).unwrap_err().to_string()
}

#[test]
fn rows_that_do_not_fit_are_refused_by_line() {
    let mut plan = circuit(4, 3.0);
    let seen = plan.seen_from(ContactId::new(1), id(1));
    let (near, length) = (seen.at, plan.rods[id(1)].axis.length());
    let row = |mate: Option<usize>, contact: Option<usize>, at: f64| {
        let contact = contact.map(ContactId::new);
        let mark = Some(MeasuredMark { mate: mate.map(id), contact, at });
        Measured { line: 7, rod: id(1), mark, diameter: None }
    };
    let missing = Measured { rod: id(4), ..row(Some(2), None, near) };
    for (row, words) in [
        (missing, "there is no rod R005, the last one is R004"),
        (row(Some(3), None, near), "R002 does not touch R004; it touches R001 (C0001), R003"),
        (row(None, Some(3), near), "R002 does not touch C0004"),
        (row(Some(2), Some(0), near), "R002 does not touch R003 at C0001"),
        (row(Some(2), None, near / 10.0), "measured from end B"),
        (row(Some(2), None, f64::NAN), "planned at"),
        (diameter(id(1), 0.3, None), "likely in another unit"),
    ] {
        let message = refusal(&plan, &[row]);
        let line = format!("line {}: ", row_line(&message));
        assert!(message.starts_with(&line) && message.contains(words), "{message}");
    }
    let twice = [row(Some(2), None, near), row(None, Some(1), near)];
    assert!(refusal(&plan, &twice).contains("for C0002 was given before"));
    let twice = [diameter(id(1), 3.1, None), diameter(id(1), 3.1, None)];
    assert!(refusal(&plan, &twice).contains("diameter of R002 was given before"));
    plan.rods[id(1)].diameters = [3.2, 2.8];
    assert!(refusal(&plan, &[diameter(id(1), 3.1, None)]).contains("diameter_b"));
    // 4 mm from end B, where half of a longer overhang has to be left.
    let far = [row(Some(2), None, length - 2.5)];
    let message = refusal(&circuit(4, 3.0), &far);
    assert!(message.contains("would lie 2.5 mm from end B, and 3.0 mm is the least"), "{message}");
}

fn row_line(message: &str) -> &str {
    message.strip_prefix("line ").and_then(|m| m.split(':').next()).unwrap_or_default()
}

#[test]
fn rods_without_room_on_a_stick_are_named() {
    let plan = on_sample("igloo", "4.4.4.4");
    // The two nearest marks of a stick within a unit, brought together.
    let inside = plan.units[UnitId::new(0)].rods[0];
    let marks: Vec<f64> = rows(&plan, inside, |_| 0.0).iter().map(|r| r.mark.unwrap().at).collect();
    let i = (0..marks.len() - 1)
        .min_by(|&i, &j| (marks[i + 1] - marks[i]).total_cmp(&(marks[j + 1] - marks[j])))
        .unwrap();
    let apart = marks[i + 1] - marks[i];
    let thick = rows(&plan, inside, |_| 0.0).len() as f64;
    assert!(apart > 3.0 && thick == 4.0);
    let close = |k: usize| if k == i { (apart - 2.0) / 2.0 } else { -(apart - 2.0) / 2.0 };
    let pair: Vec<Measured> = rows(&plan, inside, close).drain(i..i + 2).collect();
    let message = refusal(&plan, &pair);
    assert!(message.contains(&inside.to_string()), "{message}");
}
