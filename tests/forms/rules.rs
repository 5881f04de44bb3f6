//! The rules that every frame keeps, checked from its axes, diameters and contacts alone.

use rodwright::frame::{Contact, ContactKind, Frame};
use rodwright::ids::{Id, RodId};
use rodwright::surface::Point3;
use std::collections::BTreeSet;

/// Errors of a contact that are rounding, in diameters. What is promised.
const EXACT: f64 = 1e-9;

/// Rods this much nearer than both radii still pass, as part of them: as in the program,
/// with room for rounding.
const TOUCHING: f64 = 2e-9;

/// What a frame breaks, a sentence each; none for a sound one.
pub fn broken(frame: &Frame) -> Vec<String> {
    let mut found = Vec::new();
    for id in frame.contacts.ids() {
        contact(frame, &frame.contacts[id], &mut |what| found.push(format!("{id}: {what}")));
    }
    for (r, rod) in frame.rods.enumerate() {
        let own = frame.contacts.enumerate().filter(|(_, c)| c.over == r || c.under == r);
        let own: BTreeSet<_> = own.map(|(c, _)| c).collect();
        let listed: BTreeSet<_> = rod.contacts.iter().copied().collect();
        let at: Vec<f64> = rod.contacts.iter().map(|&c| frame.seen_from(c, r).at).collect();
        if own != listed || listed.len() != rod.contacts.len() {
            found.push(format!("{r}: its list of contacts is not that of the frame"));
        }
        // Ends that meet lie all at one place.
        if at.windows(2).any(|s| s[1] < s[0] - EXACT * frame.diameter) {
            found.push(format!("{r}: contacts out of order, {at:?}"));
        }
        if own.len() < 2 {
            found.push(format!("{r}: {} contacts", own.len()));
        }
    }
    clashes(frame, &mut found);
    let pieces = pieces(frame);
    if pieces != 1 {
        found.push(format!("{pieces} pieces"));
    }
    found
}

fn contact(frame: &Frame, c: &Contact, say: &mut dyn FnMut(String)) {
    // What is not a number does not hold either.
    let mut need = |holds: bool, what: String| {
        if !holds {
            say(what)
        }
    };
    let small = EXACT * frame.diameter;
    let (over, under) = (&frame.rods[c.over], &frame.rods[c.under]);
    if let ContactKind::End([a, b]) = c.kind {
        let apart = (over.axis.end(a) - under.axis.end(b)).norm();
        return need(apart <= small, format!("ends {apart:e} mm apart"));
    }
    let apart = over.axis.at(c.at_over) - under.axis.at(c.at_under);
    let wanted = (over.diameter_at(c.at_over) + under.diameter_at(c.at_under)) / 2.0;
    let exact = (apart.norm() - wanted).abs() <= small && (c.gap - wanted).abs() <= small;
    need(exact, format!("gap {} for {wanted}", apart.norm()));
    // Across both axes: the marks are where the rods are nearest.
    let [u, v] = [over, under].map(|rod| rod.axis.direction());
    let across = apart.dot(&u).abs() <= 1e-6 && apart.dot(&v).abs() <= 1e-6;
    need(across, "not where the rods are nearest".into());
    need(apart.dot(&c.normal) > 0.0, "the over rod is not over".into());
    let on = |at: f64, length: f64| 0.0 < at && at < length;
    let both = on(c.at_over, over.axis.length()) && on(c.at_under, under.axis.length());
    need(both, "off a rod".into());
    let angle = u.dot(&v).abs().min(1.0).acos();
    need((angle - c.angle).abs() <= 1e-6, format!("angle {}", c.angle));
}

/// Rods that are nearer than both radii and not in contact.
fn clashes(frame: &Frame, found: &mut Vec<String>) {
    let pair = |p: RodId, q: RodId| [p.min(q), p.max(q)];
    let touching: BTreeSet<_> = frame.contacts.iter().map(|c| pair(c.over, c.under)).collect();
    for (p, a) in frame.rods.enumerate() {
        for (q, b) in frame.rods.enumerate().skip(p.index() + 1) {
            let ends = [[a.axis.a, a.axis.b], [b.axis.a, b.axis.b]];
            let [m, n] = ends.map(|[s, t]| nalgebra::center(&s, &t));
            let reach = (a.axis.length() + b.axis.length()) / 2.0 + a.thickest() + b.thickest();
            if (m - n).norm() > reach || touching.contains(&pair(p, q)) {
                continue;
            }
            let ([s, t], least) = nearest(ends);
            let radii =
                [(a, s), (b, t)].map(|(rod, share)| rod.diameter_at(share * rod.axis.length()));
            if least < (radii[0] + radii[1]) / 2.0 * (1.0 - TOUCHING) {
                found.push(format!("{p} and {q} pass at {least} mm"));
            }
        }
    }
}

/// Where two segments are nearest, as shares of both, and how near: within both, or at one
/// of the four ends.
fn nearest([p, q]: [[Point3; 2]; 2]) -> ([f64; 2], f64) {
    let at = |[a, b]: [Point3; 2], share: f64| a + (b - a) * share;
    let onto = |x: Point3, [a, b]: [Point3; 2]| {
        ((x - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0)
    };
    let mut tries = vec![
        [0.0, onto(p[0], q)],
        [1.0, onto(p[1], q)],
        [onto(q[0], p), 0.0],
        [onto(q[1], p), 1.0],
    ];
    let (u, v, w) = (p[1] - p[0], q[1] - q[0], q[0] - p[0]);
    let across = u.cross(&v);
    let [s, t] = [v, u].map(|d| w.cross(&d).dot(&across) / across.norm_squared());
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        tries.push([s, t]);
    }
    let apart = |[s, t]: [f64; 2]| (at(p, s) - at(q, t)).norm();
    let best = tries.into_iter().min_by(|&a, &b| apart(a).total_cmp(&apart(b)));
    let best = best.expect("there are at least four");
    (best, apart(best))
}

/// The number of pieces that contacts hold together.
fn pieces(frame: &Frame) -> usize {
    let mut seen = vec![false; frame.rods.len()];
    let mut pieces = 0;
    for start in frame.rods.ids() {
        let mut open = vec![start];
        pieces += usize::from(!seen[start.index()]);
        while let Some(r) = open.pop() {
            if !std::mem::replace(&mut seen[r.index()], true) {
                let partners = frame.rods[r].contacts.iter();
                open.extend(partners.map(|&c| frame.seen_from(c, r).partner));
            }
        }
    }
    pieces
}

/// The rules notice what is broken: each is broken here in a frame that is sound.
#[test]
fn each_rule_can_be_broken() {
    let frame = super::case::Case::on("igloo", "4.4.4.4").form().expect("it can be built").frame;
    assert_eq!(broken(&frame), Vec::<String>::new());
    let r = RodId::new(7);
    let found = |breaks: &dyn Fn(&mut Frame)| {
        let mut frame = frame.clone();
        breaks(&mut frame);
        broken(&frame).join("\n")
    };
    let moved = found(&|f| f.rods[r].axis.a.z += 1e-7);
    assert!(moved.contains("gap"), "{moved}");
    let swapped = found(&|f| f.rods[r].contacts.reverse());
    assert!(swapped.contains("out of order"), "{swapped}");
    let short = found(&|f| {
        let axis = f.rods[r].axis;
        f.rods[r].axis.b = axis.at(0.5 * axis.length());
    });
    assert!(short.contains("off a rod"), "{short}");
    let side = found(&|f| f.contacts.iter_mut().for_each(|c| c.normal = -c.normal));
    assert!(side.contains("not over"), "{side}");
    let doubled = found(&|f| {
        let double = rodwright::frame::Rod { contacts: Vec::new(), ..f.rods[r].clone() };
        f.rods.push(double);
    });
    let all = ["pass at", "0 contacts", "2 pieces"];
    assert!(all.iter().all(|what| doubled.contains(what)), "{doubled}");
}
