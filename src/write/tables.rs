//! Tables for spreadsheets and scripts: `rods.csv`, `contacts.csv`, `supports.csv`.
//!
//! Comma-separated with a header, UTF-8, one line feed a row. Positions and marks are
//! rounded to a micrometre, angles to a thousandth of a degree; cut lengths stand as
//! they are to be sawn. Lists inside a cell are separated by spaces.

use super::figure::figure;
use super::structure::ContactKindName;
use crate::frame::Frame;
use crate::frame::tolerance::{Misfit, UnitOff};
use crate::ids::{ContactId, IdVec, RodId};
use crate::shop::feet;
use crate::shop::lengths::LengthClasses;
use crate::shop::marks;
use crate::statics::along::{RodFigures, rod_figures};
use crate::statics::study::Study;
use csv::Writer;
use thiserror::Error;

/// The columns of `rods.csv`. `contacts` lists those of the rod from end A on;
/// `support` is the letter of the end that stands on the ground, if one does. `diameter_mm` is
/// that of end A, `diameter_b_mm` that of end B.
pub const RODS: [&str; 13] = [
    "id",
    "cut_length_mm",
    "diameter_mm",
    "class",
    "ax",
    "ay",
    "az",
    "bx",
    "by",
    "bz",
    "contacts",
    "support",
    "diameter_b_mm",
];

/// What `rods.csv` has besides where the statics ran: the largest stress of the rod, how far from
/// its end A, and that stress by the strength; how far it moves at most, at the size studied.
pub const STRESSED: [&str; 4] = ["stress_mpa", "stress_at_mm", "utilisation", "displacement_mm"];

/// The columns of `contacts.csv`. A clock angle tells where the partner lies round
/// the rod: clockwise, seen from its end A, with its first contact at 0.
pub const CONTACTS: [&str; 10] = [
    "id",
    "kind",
    "over",
    "under",
    "at_over_mm",
    "at_under_mm",
    "angle_deg",
    "clock_over_deg",
    "clock_under_deg",
    "unit",
];

/// The columns of `supports.csv`.
pub const SUPPORTS: [&str; 7] =
    ["rod", "end", "x", "y", "elevation_deg", "azimuth_deg", "bevel_deg"];

/// The columns of `tolerance.csv`: how far the last contact of each unit is off.
pub const TOLERANCE: [&str; 4] = ["unit", "last_contact", "median_mm", "p95_mm"];

/// Why a table could not be made.
#[derive(Error, Debug)]
#[error("table {table} cannot be written: {reason}")]
pub struct TableError {
    /// The table.
    pub table: &'static str,
    /// What the writer said.
    pub reason: String,
}

/// Digits after the point of positions and marks, mm.
const LENGTH_DIGITS: usize = 3;
/// Digits after the point of angles, degrees.
const ANGLE_DIGITS: usize = 3;
/// Digits after the point of stresses, utilisations and displacements: sticks of a model may
/// carry a thousandth of what they could.
const STRESS_DIGITS: usize = 6;
/// Digits after the point of cut lengths, mm: only the noise of arithmetic goes.
const CUT_DIGITS: usize = 6;

fn length(x: f64) -> String {
    figure(x, LENGTH_DIGITS)
}

/// Radians as degrees.
fn angle(x: f64) -> String {
    figure(x.to_degrees(), ANGLE_DIGITS)
}

/// An angle in radians as degrees below 360, also after rounding.
fn turn(x: f64) -> String {
    let text = angle(x);
    if text == "360" { "0".into() } else { text }
}

/// The bytes of `rods.csv`; with a study of the frame, its figures stand in columns at the end.
///
/// # Errors
/// [`TableError`], which none of a frame's figures causes.
pub fn rods(
    frame: &Frame,
    classes: &LengthClasses,
    study: Option<&Study>,
) -> Result<Vec<u8>, TableError> {
    let figures = study.map(rod_figures);
    let row = |(r, rod): (RodId, &crate::frame::Rod)| {
        let contacts: Vec<String> =
            marks::marks(frame, r).iter().map(|m| m.contact.to_string()).collect();
        let [a, b] = [rod.axis.a, rod.axis.b];
        let mut cells = vec![
            r.to_string(),
            figure(rod.axis.length(), CUT_DIGITS),
            figure(rod.diameters[0], CUT_DIGITS),
            classes.of(r).name.clone(),
        ];
        cells.extend([a.x, a.y, a.z, b.x, b.y, b.z].map(length));
        cells.push(contacts.join(" "));
        cells.push(standing_ends(frame, r));
        cells.push(figure(rod.diameters[1], CUT_DIGITS));
        cells.extend(figures.iter().flat_map(|figures| stressed(&figures[r])));
        cells
    };
    let more = if figures.is_some() { &STRESSED[..] } else { &[] };
    table("rods.csv", &[&RODS[..], more].concat(), frame.rods.enumerate().map(row))
}

/// The cells of a rod under [`STRESSED`].
fn stressed(rod: &RodFigures) -> [String; 4] {
    let RodFigures { stress, at, utilisation, displacement, .. } = *rod;
    let at = length(at);
    let [stress, utilisation, displacement] =
        [stress, utilisation, displacement].map(|x| figure(x, STRESS_DIGITS));
    [stress, at, utilisation, displacement]
}

/// The letters of a rod's ends on the ground.
fn standing_ends(frame: &Frame, rod: RodId) -> String {
    frame.supports.iter().filter(|s| s.rod == rod).map(|s| s.end.letter()).collect()
}

/// The bytes of `contacts.csv`.
///
/// # Errors
/// [`TableError`], which none of a frame's figures causes.
pub fn contacts(frame: &Frame) -> Result<Vec<u8>, TableError> {
    let clocks = clocks(frame);
    let row = |(c, contact): (ContactId, &crate::frame::Contact)| {
        let [over, under] = clocks[c];
        vec![
            c.to_string(),
            ContactKindName::from(contact.kind).code().into(),
            contact.over.to_string(),
            contact.under.to_string(),
            length(contact.at_over),
            length(contact.at_under),
            angle(contact.angle),
            turn(over),
            turn(under),
            contact.unit.to_string(),
        ]
    };
    table("contacts.csv", &CONTACTS, frame.contacts.enumerate().map(row))
}

/// The clock angles of every contact on its over and under rod, radians.
fn clocks(frame: &Frame) -> IdVec<ContactId, [f64; 2]> {
    let mut clocks: IdVec<ContactId, [f64; 2]> = vec![[0.0; 2]; frame.contacts.len()].into();
    for rod in frame.rods.ids() {
        for mark in marks::marks(frame, rod) {
            let over = frame.seen_from(mark.contact, rod).over;
            clocks[mark.contact][usize::from(!over)] = mark.clock;
        }
    }
    clocks
}

/// The bytes of `supports.csv`.
///
/// # Errors
/// [`TableError`], which none of a frame's figures causes.
pub fn supports(frame: &Frame) -> Result<Vec<u8>, TableError> {
    let row = |foot: feet::Foot| {
        vec![
            foot.rod.to_string(),
            foot.end.letter().into(),
            length(foot.x),
            length(foot.y),
            angle(foot.elevation),
            turn(foot.azimuth),
            angle(foot.bevel),
        ]
    };
    table("supports.csv", &SUPPORTS, feet::feet(frame).into_iter().map(row))
}

/// The bytes of `tolerance.csv`.
///
/// # Errors
/// [`TableError`], which none of its figures causes.
pub fn tolerance(misfit: &Misfit) -> Result<Vec<u8>, TableError> {
    let row = |u: &UnitOff| {
        let off = [u.off.median, u.off.p95].map(length);
        [u.unit.to_string(), u.contact.to_string()].into_iter().chain(off).collect()
    };
    table("tolerance.csv", &TOLERANCE, misfit.units.iter().map(row))
}

/// A header and rows as the bytes of a CSV file.
pub(super) fn table(
    name: &'static str,
    header: &[&str],
    rows: impl IntoIterator<Item = Vec<String>>,
) -> Result<Vec<u8>, TableError> {
    let fail = |reason: String| TableError { table: name, reason };
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(header).map_err(|e| fail(e.to_string()))?;
    for row in rows {
        writer.write_record(row).map_err(|e| fail(e.to_string()))?;
    }
    writer.into_inner().map_err(|e| fail(e.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::shop::fixture::circuit;
    use crate::shop::lengths::classes;
    use crate::statics::fixture::studied;

    fn rows(bytes: &[u8]) -> Vec<Vec<String>> {
        let mut reader = csv::Reader::from_reader(bytes);
        reader.records().map(|r| r.unwrap().iter().map(str::to_owned).collect()).collect()
    }

    fn first_line(bytes: &[u8]) -> &str {
        std::str::from_utf8(bytes).unwrap().lines().next().unwrap()
    }

    #[test]
    fn headers_are_those_of_the_contract() {
        let frame = circuit(3, 3.0);
        assert_eq!(
            first_line(&rods(&frame, &classes(&frame), None).unwrap()),
            "id,cut_length_mm,diameter_mm,class,ax,ay,az,bx,by,bz,contacts,support,diameter_b_mm"
        );
        assert_eq!(
            first_line(&contacts(&frame).unwrap()),
            "id,kind,over,under,at_over_mm,at_under_mm,angle_deg,clock_over_deg,clock_under_deg,unit"
        );
        assert_eq!(
            first_line(&supports(&frame).unwrap()),
            "rod,end,x,y,elevation_deg,azimuth_deg,bevel_deg"
        );
    }

    #[test]
    fn a_rod_row_tells_where_it_lies() {
        let mut frame = circuit(4, 3.0);
        frame.supports.remove(1);
        frame.rods[RodId::new(2)].diameters = [3.0, 2.25];
        let rows = rows(&rods(&frame, &classes(&frame), None).unwrap());
        assert_eq!(rows.len(), 4);
        for (row, (r, rod)) in rows.iter().zip(frame.rods.enumerate()) {
            let number = |i: usize| row[i].parse::<f64>().unwrap();
            assert_eq!(row[0], r.to_string());
            assert!((number(1) - rod.axis.length()).abs() < 1e-6);
            assert_eq!((number(1) * 2.0).fract(), 0.0, "cut to half mm: {}", row[1]);
            let taper = r.index() == 2;
            assert_eq!(
                (row[2].as_str(), row[12].as_str()),
                ("3", if taper { "2.25" } else { "3" })
            );
            assert_eq!(row[3], if taper { "A" } else { "B" });
            assert!((number(4) - rod.axis.a.x).abs() <= 0.000_5 + 1e-9);
            assert!((number(9) - rod.axis.b.z).abs() <= 0.000_5 + 1e-9);
            assert_eq!(row[10].split(' ').count(), 2);
        }
        assert_eq!([&rows[0][11], &rows[1][11]], ["A", ""]);
    }

    #[test]
    fn rows_of_a_studied_frame_end_with_its_figures() {
        let (frame, study) = studied(5, 4.0);
        let plain = rods(&frame, &classes(&frame), None).unwrap();
        let bytes = rods(&frame, &classes(&frame), Some(&study)).unwrap();
        let header = "stress_mpa,stress_at_mm,utilisation,displacement_mm";
        assert_eq!(first_line(&bytes), format!("{},{header}", first_line(&plain)));
        let worst = study.worst();
        for ((with, without), worst) in rows(&bytes).iter().zip(rows(&plain)).zip(worst) {
            assert_eq!(with[..13], without);
            let [stress, at, used, moved] = [13, 14, 15, 16].map(|i| with[i].parse().unwrap());
            let peak = study.cases[worst.case].rods[worst.rod.index()];
            let near = |a: f64, b: f64, by: f64| assert!((a - b).abs() <= by, "{a} {b}");
            near(stress, peak.stress, 1e-6);
            near(at, peak.at / 4.0, 1e-3);
            near(used, peak.utilisation, 1e-6);
            let nodes = &study.framework.rods[worst.rod];
            let of = |case: &crate::statics::study::Case| {
                let moved =
                    nodes.iter().map(|(_, n)| case.response.moved[*n].fixed_rows::<3>(0).norm());
                moved.fold(0.0, f64::max)
            };
            near(moved, study.cases.iter().map(of).fold(0.0, f64::max), 1e-6);
            assert!(stress > 0.0 && used < 1.0);
        }
    }

    #[test]
    fn a_contact_row_has_the_clock_of_either_rod() {
        let frame = circuit(4, 3.0);
        let rows = rows(&contacts(&frame).unwrap());
        for (row, (c, contact)) in rows.iter().zip(frame.contacts.enumerate()) {
            assert_eq!(
                row[..4],
                [
                    c.to_string(),
                    "cross".into(),
                    contact.over.to_string(),
                    contact.under.to_string()
                ]
            );
            let clock = |rod, cell: &str| {
                let marks = marks::marks(&frame, rod);
                let mark = marks.iter().find(|m| m.contact == c).unwrap();
                let got: f64 = cell.parse().unwrap();
                assert!((got - mark.clock.to_degrees()).abs() < 1e-3);
            };
            clock(contact.over, &row[7]);
            clock(contact.under, &row[8]);
        }
        let under_first = frame.contacts[ContactId::new(0)].under;
        assert_eq!(rows[0][3], under_first.to_string());
    }

    #[test]
    fn a_support_row_stands_upright() {
        let frame = circuit(3, 3.0);
        let rows = rows(&supports(&frame).unwrap());
        assert_eq!(rows.len(), 3);
        for row in rows {
            let number = |i: usize| row[i].parse::<f64>().unwrap();
            assert!((number(4) + number(6) - 90.0).abs() < 2e-3);
            assert!(number(5) >= 0.0 && number(5) < 360.0);
        }
    }

    #[test]
    fn a_full_turn_is_none() {
        assert_eq!(turn(std::f64::consts::TAU - 1e-9), "0");
        assert_eq!(turn(3.0_f64.to_radians()), "3");
    }
}
