//! Marking gauges: a slot to lay a rod in, end A against the triangle, with a tick and a letter
//! for each of its marks.
//!
//! Rods of one length class whose marks are at the same places share a row of ticks, and a gauge
//! has two rows, one above its slot and one below. The rods that most others share their marks
//! with come first: there is a most number of gauges, and the rest are marked on their cards.

use crate::frame::Frame;
use crate::ids::RodId;
use crate::shop::laser::{Board, Curve, Lettering, Point, rectangle, width_of};
use crate::shop::lengths::LengthClass;
use crate::shop::{LengthClasses, marks};

/// Most gauges: so many fill two sheets of 600 × 400 mm when rods are 200 mm long. A builder with
/// more rods of their own marks them on their cards sooner.
const MOST: usize = 60;
/// Marks no farther apart than this are at the same place, mm: what a pencil line is wide.
const SAME_MARK: f64 = 0.25;
/// Room of a rod in its slot, mm: sticks vary.
const PLAY: f64 = 0.3;
/// Between the slot's ends and the ends of the gauge, mm.
const STOP: f64 = 9.0;
const END: f64 = 5.0;
/// Height of the board on either side of the slot, mm.
const RAIL: f64 = 11.0;
/// Length of a tick, mm.
const TICK: f64 = 3.0;
/// Height of letters, mm.
const LETTERS: f64 = 2.5;
/// Between lines, mm.
const FREE: f64 = 1.0;

/// The marking gauges.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Marking {
    /// The gauges, those of the longest rods first.
    pub boards: Vec<Board>,
    /// Rods without one.
    pub without: Vec<RodId>,
}

/// Rods with the same marks: their places from end A with their letters.
struct Alike {
    rods: Vec<RodId>,
    marks: Vec<(f64, String)>,
}

/// The marking gauges of a frame.
pub fn marking_gauges(frame: &Frame, classes: &LengthClasses) -> Marking {
    let mut gauges: Vec<(&LengthClass, Vec<Alike>)> = Vec::new();
    for class in classes {
        let mut rows = alike(frame, class);
        rows.sort_by_key(|row| (std::cmp::Reverse(row.rods.len()), row.rods[0]));
        while !rows.is_empty() {
            let rest = rows.split_off(rows.len().min(2));
            gauges.push((class, std::mem::replace(&mut rows, rest)));
        }
    }
    // A stable sort: of gauges for as many rods the longest stay first.
    let served = |rows: &[Alike]| rows.iter().map(|row| row.rods.len()).sum::<usize>();
    gauges.sort_by_key(|(_, rows)| std::cmp::Reverse(served(rows)));
    let left = gauges.split_off(gauges.len().min(MOST));
    let mut without: Vec<RodId> =
        left.into_iter().flat_map(|(_, rows)| rows).flat_map(|row| row.rods).collect();
    without.sort_unstable();
    let boards = gauges.iter().map(|(class, rows)| gauge(class, rows)).collect();
    Marking { boards, without }
}

/// The rods of a class by their marks.
fn alike(frame: &Frame, class: &LengthClass) -> Vec<Alike> {
    let mut rows: Vec<Alike> = Vec::new();
    for &rod in &class.rods {
        let marks: Vec<(f64, String)> =
            marks(frame, rod).into_iter().map(|mark| (mark.at, mark.letter)).collect();
        let same = |row: &&mut Alike| {
            row.marks.len() == marks.len()
                && row.marks.iter().zip(&marks).all(|(a, b)| (a.0 - b.0).abs() <= SAME_MARK)
        };
        match rows.iter_mut().find(same) {
            Some(row) => row.rods.push(rod),
            None => rows.push(Alike { rods: vec![rod], marks }),
        }
    }
    rows
}

/// One gauge, its first row above the slot.
fn gauge(class: &LengthClass, rows: &[Alike]) -> Board {
    let [a, b] = class.diameters;
    let slot = [class.length + PLAY, a.max(b) + PLAY];
    let size = [STOP + slot[0] + END, 2.0 * RAIL + slot[1]];
    let name = format!("marking gauge of class {} ({} mm)", class.name, class.length);
    let mut board = Board::rectangle(name, size);
    board.holes.push(Curve::Path(rectangle([STOP, RAIL], slot)));
    let middle = size[1] / 2.0;
    board.engraved.push(vec![
        [STOP - FREE, middle],
        [STOP - FREE - 4.0, middle + 2.0],
        [STOP - FREE - 4.0, middle - 2.0],
    ]);
    board.score(Lettering::new(LETTERS).centred([STOP / 2.0, middle + 5.5], &class.name));
    for (row, up) in rows.iter().zip([true, false]) {
        board.score(row_of_marks(row, up, slot));
    }
    board
}

/// The ticks of a row with their letters, and the rods that it is for.
fn row_of_marks(row: &Alike, up: bool, slot: [f64; 2]) -> Vec<Vec<Point>> {
    // From the slot's edge outward.
    let y = |out: f64| if up { RAIL + slot[1] + out } else { RAIL - out };
    let letters = Lettering::new(LETTERS);
    let mut strokes = Vec::new();
    for (at, letter) in &row.marks {
        let x = STOP + at;
        strokes.push(vec![[x, y(FREE / 2.0)], [x, y(TICK)]]);
        strokes.extend(letters.centred([x, y(TICK + FREE + LETTERS / 2.0)], letter));
    }
    let line = y(TICK + 2.0 * FREE + 1.5 * LETTERS) - LETTERS / 2.0;
    strokes.extend(letters.at([STOP, line], &names(&row.rods, slot[0])));
    strokes
}

/// The numbers of as many rods as there is room for, and how many more there are.
fn names(rods: &[RodId], room: f64) -> String {
    let joined = |n: usize| {
        let mut text = rods[..n].iter().map(RodId::to_string).collect::<Vec<_>>().join(" ");
        if n < rods.len() {
            text += &format!(" +{}", rods.len() - n);
        }
        text
    };
    let fits = |text: &String| width_of(text, LETTERS) <= room;
    (1..=rods.len()).rev().map(joined).find(fits).unwrap_or_else(|| joined(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::{classes, fixture};

    #[test]
    fn rods_alike_share_a_gauge_with_a_tick_at_each_mark() {
        let frame = fixture::circuit(5, 3.0);
        let marking = marking_gauges(&frame, &classes(&frame));
        assert!(marking.without.is_empty());
        let [board] = &marking.boards[..] else { panic!("one gauge for five rods alike") };
        let Curve::Path(slot) = &board.holes[0] else { panic!("a slot") };
        let length = frame.rods.first().unwrap().axis.length();
        assert!((slot[1][0] - slot[0][0] - length - PLAY).abs() < 1e-9);
        let ticks: Vec<f64> = board
            .scores
            .iter()
            .filter_map(|s| match s {
                Curve::Path(p)
                    if p.len() == 2 && p[0][0] == p[1][0] && p[0][1] == slot[2][1] + 0.5 =>
                {
                    Some(p[0][0] - slot[0][0])
                }
                _ => None,
            })
            .collect();
        let wanted: Vec<f64> =
            marks(&frame, frame.rods.ids().next().unwrap()).iter().map(|m| m.at).collect();
        assert_eq!(ticks.len(), wanted.len());
        assert!(
            ticks.iter().zip(&wanted).all(|(t, w)| (t - w).abs() < 1e-9),
            "{ticks:?} {wanted:?}"
        );
    }

    #[test]
    fn names_are_counted_where_there_is_no_room() {
        use crate::ids::Id;
        let rods: Vec<RodId> = (0..9).map(RodId::new).collect();
        assert_eq!(names(&rods[..2], 100.0), "R001 R002");
        let short = names(&rods, 40.0);
        assert!(short.starts_with("R001 R002") && short.contains(" +"), "{short}");
        assert!(width_of(&short, LETTERS) <= 40.0);
    }
}
