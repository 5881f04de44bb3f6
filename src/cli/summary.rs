//! The summary at the end of a run, for the builder.

use super::statics_page::{self, digits};
use super::terminal::Terminal;
use crate::design::Design;
use crate::frame::Frame;
use crate::frame::arrangement::arrangement;
use crate::frame::as_built::AsBuilt;
use crate::frame::fit::FitBy;
use crate::frame::share::Shared;
use crate::frame::tolerance::{Misfit, Tolerance};
use crate::ids::RodId;
use crate::pipeline::{Model, Stiffened, Tried};
use crate::shop::lengths::diameters;
use crate::shop::{Aim, Assembly, CutPlan, JigError, Jigs, Order, Purchase};
use crate::statics::goal::Goal;
use std::fmt::Write as _;
use std::path::Path;

/// A table of what was made and what to buy.
pub fn summary(design: &Design, model: &Model, out: &Path, terminal: &Terminal) -> String {
    let m = &model.measures;
    let plan = &model.plan;
    let [lo, hi] = model.formed.frame.bounds();
    let size = hi - lo;
    let mut rows = vec![
        ("rods", format!("{}, {} units", rods(&model.formed.frame), m.units)),
        ("size", format!("{:.0} × {:.0} × {:.0} mm", size.x, size.y, size.z)),
        (
            "lengths",
            format!(
                "{:.1} to {:.1} mm, {} different, {:.2} m in all",
                m.lengths[0],
                m.lengths[1],
                m.distinct_lengths,
                m.total_length / 1e3
            ),
        ),
    ];
    rows.extend(model.formed.shared.as_ref().map(|s| ("shared lengths", shared(s))));
    rows.extend([
        ("to buy", to_buy(plan)),
        ("contacts", format!("{}, worst error {:.1e} of the diameter", m.contacts, m.worst_gap)),
        ("to be tied", to_be_tied(model)),
        ("on the ground", format!("{} rods", m.supports)),
        ("unit", unit(model)),
        (
            "off the surface",
            format!("{:.1} mm rms, {:.1} mm at most", m.from_surface.rms, m.from_surface.max),
        ),
        ("left out", left_out(model)),
    ]);
    rows.extend(model.assembly.as_ref().map(|assembly| ("assembly", put_together(assembly))));
    rows.extend(model.stiffened.map(|stiffened| ("stiffened", stiffer(stiffened))));
    rows.extend(model.statics.iter().flatten().map(|study| ("statics", statics_page::line(study))));
    rows.extend(model.as_built.as_ref().map(|what| ("as built", as_built(what))));
    rows.extend(model.misfit.as_ref().map(|misfit| ("tolerance", tolerance(misfit))));
    rows.extend(model.jigs.as_ref().map(|jigs| ("for the laser", lasered(jigs))));
    let mut text = String::new();
    let title = format!("{}: {} reciprocal frame", design.name(), design.tiles.name());
    writeln!(text, "{}", terminal.bold(&title)).expect("writing to a string cannot fail");
    for (label, value) in rows {
        writeln!(text, "  {label:<16} {value}").expect("writing to a string cannot fail");
    }
    let end = format!("  {:<16} {}", "written to", out.display());
    writeln!(text, "{end}").expect("writing to a string cannot fail");
    text
}

/// What to buy, and whether that is the least.
fn to_buy(plan: &CutPlan) -> String {
    let of = |p: &Purchase| {
        if plan.is_mixed() { format!(" of Ø {}", diameter(p.diameters)) } else { String::new() }
    };
    let list = |bars: &[Purchase]| {
        let one = |p: &Purchase| format!("{} × {} mm{}", p.count, p.length, of(p));
        bars.iter().map(one).collect::<Vec<_>>().join(" + ")
    };
    let (buy, taken) = (plan.shopping(), plan.taken());
    if plan.bars.is_empty() {
        return "nothing: all rods are sawn".into();
    }
    let mut text = if buy.is_empty() { "nothing".into() } else { list(&buy) };
    if !taken.is_empty() {
        text += &format!(" and the offcuts {}", list(&taken));
    }
    let (best, least) = match plan.aim {
        Aim::Bars => ("fewest possible", format!("at least {} bars", plan.least)),
        Aim::Length => ("least possible", format!("at least {} m", plan.least / 1e3)),
        Aim::Cost => ("cheapest possible", format!("at least {:.2}", plan.least)),
    };
    let best = if plan.is_proven() { best.into() } else { format!("good; {least} in any plan") };
    if let Some(cost) = plan.cost() {
        text += &format!(", cost {cost:.2}");
    }
    format!("{text}, {:.1} % waste ({best})", 100.0 * plan.waste())
}

/// How many lengths rods have that share them.
fn shared(shared: &Shared) -> String {
    let Shared { before, after, extra, kept, own } = shared;
    let alone = match own.len() {
        0 => String::new(),
        n => format!(
            "; {} kept {} own, having no room for more",
            named(own),
            if n == 1 { "its" } else { "their" }
        ),
    };
    let kept = match kept {
        0 => String::new(),
        n => format!("; {n} that taper or meet others at both ends keep theirs"),
    };
    format!("{after} in place of {before}, for {:.2} m more rod{kept}{alone}", extra / 1e3)
}

/// How many rods there are of each diameter.
pub fn rods(frame: &Frame) -> String {
    let count = |(ends, n): ([f64; 2], usize)| format!("{n} of {}", diameter(ends));
    let counts: Vec<String> = diameters(frame).into_iter().map(count).collect();
    format!("{} diameter", counts.join(", "))
}

/// The diameter of a stick, given at end A and at end B, mm.
pub fn diameter([a, b]: [f64; 2]) -> String {
    if a == b { format!("{a} mm") } else { format!("{a}→{b} mm") }
}

fn unit(model: &Model) -> String {
    let fit = &model.fit;
    let how = match fit.by {
        FitBy::Given if fit.is_flat(model.formed.frame.diameter) => {
            "as given; on so flat a surface all rods suit it alike".into()
        }
        FitBy::Given => format!("as given; rods of {:.1} mm would suit it best", fit.rise),
        FitBy::Edge => "fitted to rod and surface".into(),
        FitBy::Smaller => "fitted to rod and surface, where it is curved most".into(),
        FitBy::Turn => format!("rods turned by {:.1}° to suit them", fit.turn.to_degrees()),
        FitBy::TurnLimit => format!(
            "rods turned by {:.1}°, as far as is safe; {:.1} mm rods would suit it best",
            fit.turn.to_degrees(),
            fit.rise
        ),
        FitBy::Plain => "plain: the surface is too flat for the rods to decide".into(),
    };
    format!("tile edge {:.1} mm, {how}", fit.edge)
}

/// What became of measurements on sticks, and what to do now.
fn as_built(what: &AsBuilt) -> String {
    let left = match what.deviation {
        met if met < MET => "all met".into(),
        left => format!("at most {left:.2} mm left"),
    };
    let held = match what.marks {
        0 => String::new(),
        1 => format!("1 mark held, {left}; "),
        n => format!("{n} marks held, {left}; "),
    };
    let off: Vec<RodId> = what.mark_again.iter().map(|(rod, _)| *rod).collect();
    let most = what.mark_again.iter().map(|again| again.1).fold(0.0, f64::max);
    let marks = match off.is_empty() {
        true => format!("other marks change by {:.2} mm at most", what.mark_change),
        false => format!("marks are off by up to {most:.1} mm: mark again {}", named(&off)),
    };
    let lengths = match what.saw_again.is_empty() {
        true => String::new(),
        false => format!(
            "; lengths change by up to {:.1} mm: {}",
            what.length_change,
            named(&what.saw_again)
        ),
    };
    let sawn = match what.sawn.len() {
        1 => "1 rod sawn".into(),
        n => format!("{n} rods sawn"),
    };
    format!("{sawn}; {held}{marks}{lengths}")
}

/// What is left of held marks below this is not worth a word, mm.
const MET: f64 = 0.005;

/// The rods, or the first of them.
fn named(rods: &[RodId]) -> String {
    let names: Vec<String> = rods.iter().take(NAMED).map(RodId::to_string).collect();
    match rods.len().saturating_sub(NAMED) {
        0 => names.join(", "),
        more => format!("{} and {more} more (report.json)", names.join(", ")),
    }
}

/// How many rods a line names before it only counts the rest.
const NAMED: usize = 12;

/// What errors of marks and diameters do.
fn tolerance(misfit: &Misfit) -> String {
    let Tolerance { marks, diameter } = misfit.tolerance;
    let worst = misfit.worst().map_or(String::new(), |worst| {
        format!("; worst {}, {:.1} mm at 95 %", worst.unit, worst.off.p95)
    });
    format!(
        "with marks ±{marks} mm and sticks ±{diameter} mm, the last contact of a unit will be off \
         by {:.1} mm in the median, {:.1} mm at 95 %{worst}",
        misfit.overall.median, misfit.overall.p95
    )
}

fn to_be_tied(model: &Model) -> String {
    match arrangement(&model.formed).tied.len() {
        0 => "nothing: every rod lies on the one it ends at".into(),
        1 => "1 contact, where the end of a rod hangs below the other".into(),
        n => format!("{n} contacts, where the end of a rod hangs below the other"),
    }
}

/// What stiffening came to.
fn stiffer(stiffened: Stiffened) -> String {
    let Stiffened { goal, before, after, tried } = stiffened;
    let figure = |of: Tried| match goal {
        Goal::Utilisation => format!("{} %", digits(100.0 * of.value)),
        Goal::Displacement => format!("{} mm", digits(of.value)),
    };
    let what = match goal {
        Goal::Utilisation => "of the strength",
        Goal::Displacement => "of movement",
    };
    let Tried { turn, slide, edge, .. } = after;
    format!(
        "from {} to {} {what}: turn {:.1}°, slide {slide:.3}, tile edge {edge:.1} mm ({tried} \
         frames tried)",
        figure(before),
        figure(after),
        turn.to_degrees()
    )
}

/// In which order the frame is put together, and what that takes.
fn put_together(assembly: &Assembly) -> String {
    let from = match assembly.order {
        Order::Crown => "from the crown outward",
        Order::Ground => "from the ground up",
    };
    let props = match (assembly.props(), assembly.most_props()) {
        (0, _) => "no props".into(),
        (1, _) => "1 prop".into(),
        (all, most) if all == most => format!("{all} props"),
        (all, most) => format!("{all} props, {most} at a time"),
    };
    let missed = match assembly.missed.len() {
        0 => String::new(),
        n => format!("; it needs a stand where the last {n} are"),
    };
    let steps = assembly.steps.len();
    format!("{from} in {steps} steps, {props}; {} times a rod is lifted{missed}", assembly.lifts())
}

/// What a laser cuts, or why that is left out.
fn lasered(jigs: &Result<Jigs, JigError>) -> String {
    let jigs = match jigs {
        Ok(jigs) => jigs,
        Err(e) => return format!("left out: {e}"),
    };
    let [width, height] = jigs.sheet;
    let sheets = match jigs.sheets.len() {
        1 => "1 sheet".into(),
        n => format!("{n} sheets"),
    };
    let props = match (jigs.props, jigs.unheld.len() + jigs.missed.len()) {
        (0, 0) => String::new(),
        (props, 0) => format!(", {props} props"),
        (props, n) => format!(", {props} props; there is none for {n} more (report.json)"),
    };
    format!("{sheets} of {width} × {height} mm{props}")
}

fn left_out(model: &Model) -> String {
    match &model.formed.frame.dropped[..] {
        [] => "nothing".into(),
        [one] => format!("1 unit: {}", one.reason),
        [first, rest @ ..] => {
            format!("{} units, the first: {}", rest.len() + 1, first.reason)
        }
    }
}
