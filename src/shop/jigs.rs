//! Jigs: everything that a laser cuts for a frame, laid out on sheets.

use super::falsework::{Falsework, PlateError, falsework};
use super::gauges::{angle_gauges, coupon, diameter_gauges, marking_gauges, stop_blocks};
use super::laser::{Board, Spot, nest};
use super::{Assembly, CutPlan, classes};
use crate::frame::Frame;
use crate::ids::{PropId, RodId, UnitId};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A kind of jig.
#[derive(
    Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Jig {
    /// Base plate and props
    Falsework,
    /// Gauges to mark rods by
    Marking,
    /// Wedges for the angles at which rods cross
    Angles,
    /// Holes to sort sticks by diameter
    Diameter,
    /// Blocks to set the stop of the saw by
    Stops,
    /// Slots that show how wide the laser cuts
    Coupon,
}

impl Jig {
    /// All kinds.
    pub const ALL: [Self; 6] =
        [Self::Falsework, Self::Marking, Self::Angles, Self::Diameter, Self::Stops, Self::Coupon];

    /// The name by which it is asked for.
    pub fn code(self) -> &'static str {
        match self {
            Self::Falsework => "falsework",
            Self::Marking => "marking",
            Self::Angles => "angles",
            Self::Diameter => "diameter",
            Self::Stops => "stops",
            Self::Coupon => "coupon",
        }
    }
}

/// What jigs are cut from, and which.
#[derive(Clone, PartialEq, Debug)]
pub struct JigSettings {
    /// The kinds that are wanted.
    pub kinds: Vec<Jig>,
    /// Width and height of a sheet, mm.
    pub sheet: [f64; 2],
    /// Thickness of the board, mm.
    pub thickness: f64,
    /// Full width of a cut, mm.
    pub kerf: f64,
}

/// Jigs on their sheets.
#[derive(Clone, PartialEq, Debug)]
pub struct Jigs {
    /// Width and height of a sheet, mm.
    pub sheet: [f64; 2],
    /// What lies on each sheet: boards as the laser has to follow them, at their places. y up
    /// from the lower left corner.
    pub sheets: Vec<Vec<Board>>,
    /// Props of the falsework.
    pub props: usize,
    /// Units that no prop holds.
    pub unheld: Vec<UnitId>,
    /// Props of the assembly for which the falsework has no room.
    pub missed: Vec<PropId>,
    /// Rods without a marking gauge.
    pub unmarked: Vec<RodId>,
}

/// Why there are no jigs.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum JigError {
    /// The plate of the falsework.
    #[error("{source}. {}", help(Jig::Falsework))]
    Plate {
        /// What is wrong with it.
        #[from]
        source: PlateError,
    },
    /// A part is larger than a sheet.
    #[error(
        "{part} is {:.0} × {:.0} mm and does not fit a sheet of {:.0} × {:.0} mm. {}",
        size[0], size[1], sheet[0], sheet[1], help(*kind)
    )]
    TooLarge {
        /// The part.
        part: String,
        /// Its kind.
        kind: Jig,
        /// Its width and height, mm.
        size: [f64; 2],
        /// The sheet's, mm.
        sheet: [f64; 2],
    },
    /// A part has details finer than the cut.
    #[error("{part} has details that are finer than the cut of {kerf} mm: set --laser-kerf")]
    Kerf {
        /// The part.
        part: String,
        /// Width of the cut, mm.
        kerf: f64,
    },
    /// More sheets than are written unless they are asked for.
    #[error(
        "they would take {sheets} sheets. Ask for them with --only jigs, or for some of them with \
         --jigs"
    )]
    TooMany {
        /// How many.
        sheets: usize,
    },
}

/// What helps where a part does not fit.
fn help(kind: Jig) -> String {
    let others: Vec<&str> = Jig::ALL.into_iter().filter(|k| *k != kind).map(Jig::code).collect();
    let smaller = if kind == Jig::Falsework { ", make the model smaller (--span)" } else { "" };
    format!(
        "Take a larger sheet (--sheet){smaller}, or leave this kind out: --jigs {}",
        others.join(",")
    )
}

/// The jigs of a frame.
///
/// # Errors
/// [`JigError`] with the part that cannot be cut, and what helps.
pub fn jigs(
    frame: &Frame,
    plan: &CutPlan,
    assembly: Option<&Assembly>,
    settings: &JigSettings,
) -> Result<Jigs, JigError> {
    let JigSettings { sheet, thickness, kerf, .. } = *settings;
    let wants = |kind| settings.kinds.contains(&kind);
    let mut boards: Vec<(Jig, Board)> = Vec::new();
    let mut add = |kind, some: Vec<Board>| boards.extend(some.into_iter().map(|b| (kind, b)));
    let mut work = Falsework::default();
    if wants(Jig::Falsework) {
        work = falsework(frame, assembly, sheet, thickness)?;
        add(Jig::Falsework, std::mem::take(&mut work.boards));
    }
    let mut unmarked = Vec::new();
    if wants(Jig::Marking) {
        let marking = marking_gauges(frame, &classes(frame));
        unmarked = marking.without;
        add(Jig::Marking, marking.boards);
    }
    if wants(Jig::Angles) {
        add(Jig::Angles, angle_gauges(frame));
    }
    if wants(Jig::Diameter) {
        add(Jig::Diameter, diameter_gauges(frame));
    }
    if wants(Jig::Stops) {
        add(Jig::Stops, stop_blocks(plan));
    }
    if wants(Jig::Coupon) {
        add(Jig::Coupon, vec![coupon(thickness)]);
    }
    Ok(Jigs {
        sheet,
        sheets: laid_out(&boards, sheet, kerf)?,
        props: work.choice.stands.len(),
        unheld: work.choice.unheld,
        missed: work.choice.missed,
        unmarked,
    })
}

/// Boards on sheets, with the width of the cut allowed for.
fn laid_out(
    boards: &[(Jig, Board)],
    sheet: [f64; 2],
    kerf: f64,
) -> Result<Vec<Vec<Board>>, JigError> {
    let cut = |(_, board): &(Jig, Board)| {
        let part = || board.name.clone();
        board.compensated(kerf).ok_or_else(|| JigError::Kerf { part: part(), kerf })
    };
    let cut: Vec<Board> = boards.iter().map(cut).collect::<Result<_, _>>()?;
    let sizes: Vec<[f64; 2]> = cut.iter().map(Board::size).collect();
    let too_large = |i: usize| {
        let (kind, board) = &boards[i];
        JigError::TooLarge { part: board.name.clone(), kind: *kind, size: sizes[i], sheet }
    };
    let nest = nest(&sizes, sheet).map_err(too_large)?;
    let mut sheets = vec![Vec::new(); nest.sheets];
    for (board, &Spot { sheet, corner, turned }) in cut.iter().zip(&nest.spots) {
        sheets[sheet].push(board.placed(corner, turned));
    }
    Ok(sheets)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;
    use crate::shop::laser::{Curve, GAP, MARGIN, Point, REFERENCE, area, holds};
    use crate::shop::lengths::sticks;
    use crate::shop::saw::{Offer, Stock, plan_some};

    fn igloo() -> (Frame, CutPlan) {
        let frame = fixture::on_sample("igloo", "4.4.4.4");
        let sticks = sticks(&frame);
        let stock = Stock { bars: vec![Offer::plain(1000.0)], kerf: 1.0, trim: 0.0, keep: None };
        let plan = plan_some(&sticks, sticks.ids(), &stock).unwrap();
        (frame, plan)
    }

    fn settings(sheet: [f64; 2], kerf: f64) -> JigSettings {
        JigSettings { kinds: Jig::ALL.to_vec(), sheet, thickness: 3.0, kerf }
    }

    #[test]
    fn parts_keep_apart_on_every_sheet() {
        let (frame, plan) = igloo();
        let jigs = jigs(&frame, &plan, None, &settings([600.0, 400.0], 0.2)).unwrap();
        let reference = [[MARGIN; 2], [MARGIN + REFERENCE[0], MARGIN + REFERENCE[1]]];
        assert!(jigs.sheets.len() > 1 && jigs.sheets.len() < 8);
        for boards in &jigs.sheets {
            let mut boxes = vec![reference];
            for board in boards {
                let [lo, hi] = board.bounds();
                assert!(lo[0].min(lo[1]) >= MARGIN - 1e-9, "{}", board.name);
                assert!(hi[0] <= 595.0 + 1e-9 && hi[1] <= 395.0 + 1e-9, "{}", board.name);
                for [a, b] in &boxes {
                    let apart =
                        (0..2).any(|i| b[i] + GAP <= lo[i] + 1e-6 || hi[i] + GAP <= a[i] + 1e-6);
                    assert!(apart, "{}", board.name);
                }
                boxes.push([lo, hi]);
            }
        }
    }

    #[test]
    fn what_is_scored_lies_on_its_board_and_in_no_hole() {
        let (frame, plan) = igloo();
        for sheet in [[600.0, 400.0], [310.0, 300.0]] {
            let jigs = jigs(&frame, &plan, None, &settings(sheet, 0.2)).unwrap();
            for board in jigs.sheets.iter().flatten() {
                let rings = board.holes.iter().filter_map(|h| match h {
                    Curve::Path(ring) => Some(ring),
                    Curve::Circle { .. } => None,
                });
                let holes: Vec<_> = rings.collect();
                let between = |w: &[Point]| {
                    let at = |t: f64| [0, 1].map(|k| w[0][k] + t * (w[1][k] - w[0][k]));
                    (0..=10).map(|i| at(f64::from(i) / 10.0)).collect::<Vec<Point>>()
                };
                let scored = board.scores.iter().flat_map(|s| match s {
                    Curve::Path(path) => path.windows(2).flat_map(between).collect::<Vec<_>>(),
                    Curve::Circle { .. } => panic!("scores are lines"),
                });
                for p in scored.chain(board.engraved.concat()) {
                    assert!(holds(&board.outline, p), "{}: {p:?}", board.name);
                    assert!(!holes.iter().any(|h| holds(h, p)), "{}: {p:?} in a hole", board.name);
                }
            }
        }
    }

    #[test]
    fn parts_are_drawn_larger_and_their_holes_smaller_by_the_cut() {
        let (frame, plan) = igloo();
        let made = |kerf| {
            let jigs = jigs(&frame, &plan, None, &settings([600.0, 400.0], kerf)).unwrap();
            let mut boards: Vec<Board> = jigs.sheets.into_iter().flatten().collect();
            boards.sort_by(|a, b| a.name.cmp(&b.name));
            boards
        };
        let length = |ring: &[Point]| -> f64 {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum()
        };
        let (exact, cut) = (made(0.0), made(0.2));
        assert!(exact.len() == cut.len() && exact.len() > 100);
        for (exact, cut) in exact.iter().zip(&cut) {
            assert_eq!(exact.name, cut.name);
            let grown = area(&cut.outline) - area(&exact.outline);
            if exact.exact {
                assert!(grown.abs() < 1e-9, "{}", exact.name);
                continue;
            }
            // Half the cut all round, but for the corners: each is off by a square of it.
            let corners = exact.outline.len() as f64;
            let wanted = 0.1 * length(&exact.outline);
            assert!((grown - wanted).abs() < 0.05 * corners, "{}: {grown}", exact.name);
            assert!(grown > 0.5 * wanted, "{}", exact.name);
            for pair in exact.holes.iter().zip(&cut.holes) {
                match pair {
                    (Curve::Path(a), Curve::Path(b)) => {
                        let lost = area(a).abs() - area(b).abs();
                        assert!((lost - 0.1 * length(a)).abs() < 0.05, "{}", exact.name);
                    }
                    (Curve::Circle { radius: a, .. }, Curve::Circle { radius: b, .. }) => {
                        assert!((a - b - 0.1).abs() < 1e-9, "{}", exact.name);
                    }
                    other => panic!("{other:?}"),
                }
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_named_with_what_helps() {
        let (frame, plan) = igloo();
        let refused = |sheet| jigs(&frame, &plan, None, &settings(sheet, 0.2)).unwrap_err();
        let long = refused([200.0, 200.0]);
        let JigError::TooLarge { part, .. } = &long else { panic!("{long}") };
        assert!(part.starts_with("prop P"), "{part}");
        for word in ["--sheet", "--span", "200 × 200 mm", "--jigs marking,"] {
            assert!(long.to_string().contains(word), "{long}");
        }
        let plate = refused([120.0, 60.0]).to_string();
        assert!(plate.contains("base plate") && plate.contains("--span"), "{plate}");
    }
}
