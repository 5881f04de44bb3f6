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
    #[error("they would take {sheets} sheets. Ask for them with --only jigs, or for some of them with --jigs")]
    TooMany {
        /// How many.
        sheets: usize,
    },
}

/// What helps where a part does not fit.
fn help(kind: Jig) -> String {
    let others: Vec<&str> =
        Jig::ALL.into_iter().filter(|k| *k != kind).map(Jig::code).collect();
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
