//! What `inspect` tells about a structure.

use super::Args;
use crate::cli::Failure;
use crate::cli::page::Page;
use crate::cli::summary::{diameter, rods};
use crate::cli::terminal::Terminal;
use crate::frame::{ContactKind, Frame};
use crate::ids::{ContactId, Id, IdVec, RodId, UnitId};
use crate::shop::feet::feet;
use crate::shop::lengths::{are_mixed, classes};
use crate::shop::marks::{Side, marks};
use crate::surface::Point3;
use crate::write::structure::Structure;
use std::fmt::Display;

/// The page about a structure, or about the rod, contact or unit asked for.
pub fn page(args: &Args, structure: &Structure, terminal: &Terminal) -> Result<String, Failure> {
    let frame = structure.to_frame().map_err(Failure::input)?;
    let mut page = Page::new(terminal);
    if let Some(id) = &args.rod {
        rod(&mut page, &frame, find(&frame.rods, id, "rod")?);
    } else if let Some(id) = &args.contact {
        contact(&mut page, &frame, find(&frame.contacts, id, "contact")?);
    } else if let Some(id) = &args.unit {
        unit(&mut page, &frame, find(&frame.units, id, "unit")?);
    } else {
        overview(&mut page, &frame);
    }
    Ok(page.text)
}

/// The element of this id; upper and lower case are the same, and zeros in front
/// may be left out.
fn find<I: Id + Display, T>(items: &IdVec<I, T>, name: &str, kind: &str) -> Result<I, Failure> {
    let missing = || {
        let range = match items.len() {
            0 => "there is none".to_string(),
            n => format!("there are {} to {}", I::new(0), I::new(n - 1)),
        };
        Failure::input(format!("no {kind} is called {name}: {range}"))
    };
    let prefix = &I::new(0).to_string()[..1];
    let upper = name.to_uppercase();
    let digits = upper.strip_prefix(prefix).unwrap_or(&upper);
    let number: usize = digits.parse().map_err(|_| missing())?;
    if (1..=items.len()).contains(&number) { Ok(I::new(number - 1)) } else { Err(missing()) }
}

fn place(p: Point3) -> String {
    format!("x {:.1}  y {:.1}  z {:.1} mm", p.x, p.y, p.z)
}

fn list(ids: impl IntoIterator<Item = impl Display>) -> String {
    ids.into_iter().map(|id| id.to_string()).collect::<Vec<_>>().join(" ")
}

fn overview(page: &mut Page, frame: &Frame) {
    page.head("Structure");
    page.row("rods", rods(frame));
    page.row("contacts", frame.contacts.len());
    page.row("units", frame.units.len());
    page.row("on the ground", list(frame.supports.iter().map(|s| s.rod)));
    let [lo, hi] = frame.bounds();
    let size = hi - lo;
    page.row("size", format!("{:.1} × {:.1} × {:.1} mm", size.x, size.y, size.z));
    page.head("Lengths");
    for class in &classes(frame) {
        let thick = if are_mixed(frame) {
            format!("Ø {}  ", diameter(class.diameters))
        } else {
            String::new()
        };
        let (count, rods) = (class.rods.len(), list(&class.rods));
        page.row(&class.name, format!("{:.1} mm  {thick}{count} ×  {rods}", class.length));
    }
}

fn rod(page: &mut Page, frame: &Frame, id: RodId) {
    let rod = &frame.rods[id];
    let classes = classes(frame);
    page.head(&format!("Rod {id}"));
    page.row("cut length", format!("{:.1} mm, class {}", rod.axis.length(), classes.of(id).name));
    if are_mixed(frame) {
        page.row("diameter", diameter(rod.diameters));
    }
    page.row("end A", place(rod.axis.a));
    page.row("end B", place(rod.axis.b));
    page.row("units", list(&rod.units));
    for foot in feet(frame).iter().filter(|f| f.rod == id) {
        let end = foot.end.letter();
        page.row(
            "stands",
            format!(
                "on end {end}, {:.1}° above the ground, heading {:.1}°; saw {:.1}° off square",
                foot.elevation.to_degrees(),
                foot.azimuth.to_degrees(),
                foot.bevel.to_degrees()
            ),
        );
    }
    page.head("Marks, measured from end A");
    for m in marks(frame, id) {
        let side = match m.side {
            Side::Over => "over ",
            Side::Under => "under",
            Side::Meets(_) => "meets",
        };
        page.line(format!(
            "{} {:8.1} mm  {side} {} @ {:.1} mm  {:5.1}°  clock {:5.1}°  {}",
            m.letter,
            m.at,
            m.partner,
            m.at_partner,
            m.angle.to_degrees(),
            m.clock.to_degrees(),
            m.contact
        ));
    }
}

fn contact(page: &mut Page, frame: &Frame, id: ContactId) {
    let c = &frame.contacts[id];
    page.head(&format!("Contact {id}"));
    let [first, second] = match c.kind {
        ContactKind::Cross => ["over", "under"],
        ContactKind::End(_) => ["end of", "meets"],
    };
    page.row(first, format!("{} @ {:.1} mm from its end A", c.over, c.at_over));
    page.row(second, format!("{} @ {:.1} mm from its end A", c.under, c.at_under));
    page.row("angle", format!("{:.1}°", c.angle.to_degrees()));
    page.row("axes apart", format!("{:.6} mm", c.gap));
    page.row("place", place(frame.contact_middle(id)));
    page.row("unit", c.unit);
}

fn unit(page: &mut Page, frame: &Frame, id: UnitId) {
    let unit = &frame.units[id];
    page.head(&format!("Unit {id}"));
    page.row("rods", format!("{}: {}", unit.rods.len(), list(&unit.rods)));
    page.row("runs", unit.chirality.code());
    page.row("middle", place(unit.center.position));
    page.head("Contacts, round the unit first");
    for &contact in &unit.contacts {
        let c = &frame.contacts[contact];
        let lies = if c.kind == ContactKind::Cross { "over" } else { "meets" };
        page.line(format!(
            "{contact}  {} {lies} {}  {:.1}°",
            c.over,
            c.under,
            c.angle.to_degrees()
        ));
    }
}
