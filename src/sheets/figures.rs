//! The page behind the cover: the main figures of the frame, and its histograms.

use super::format::{counted, fixed};
use super::histograms::{
    GAP, HistogramPair, KEY_HEIGHT, LEAST_HEIGHT, histogram_pairs, key, pair_row,
};
use super::page::{BODY, Column, Flow, HEADING, Leaf, TABLE, TABLE_LEADING, Table};
use super::{SheetError, SheetSettings};
use crate::drawing::font::LEADING;
use crate::drawing::{DrawingError, Rect};
use crate::frame::measure::{Measures, Spread};

/// Greatest height of a histogram, mm: taller, and it is stretched without showing more.
const GREATEST_HEIGHT: f64 = 80.0;

/// Histograms, and the main figures below.
pub(super) fn page(measures: &Measures, settings: &SheetSettings) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "figures", "Figures: how well the frame came out");
    flow.paragraph(
        "The further left the bars stand, the less the frame differs from what was wanted. All \
         figures are in report.json, too.",
    )?;
    let table = table(measures, settings);
    let lengths = lengths(measures, settings);
    let lines = table.rows.len() as f64 + 1.0;
    let below = HEADING * 1.7 + lines * TABLE * TABLE_LEADING + 2.0 + 3.0 * BODY * LEADING;
    grid(&histogram_pairs(measures), below, &mut flow)?;
    flow.heading("Main figures", below - HEADING * 1.7);
    flow.table(&table)?;
    flow.paragraph(&lengths)?;
    Ok(flow.finish(None))
}

/// All histograms, as tall as leaves `below` mm of the page.
fn grid(pairs: &[HistogramPair], below: f64, flow: &mut Flow) -> Result<(), DrawingError> {
    let [left, width] = [flow.area().min[0], flow.area().width()];
    flow.skip(1.5);
    let y = flow.y;
    key([left, y], flow.page())?;
    flow.skip(KEY_HEIGHT);
    let rows = pairs.len().div_ceil(2).max(1) as f64;
    let height = (flow.room() - below) / rows - GAP;
    let height = height.clamp(LEAST_HEIGHT, GREATEST_HEIGHT);
    for row in pairs.chunks(2) {
        flow.need(height);
        let room = Rect::new([left, flow.y], [width, height]);
        pair_row(row, room, flow.page())?;
        flow.skip(height + GAP);
    }
    Ok(())
}

fn table(measures: &Measures, settings: &SheetSettings) -> Table {
    let units = settings.units;
    let row = |what: &str, unit: &str, spread: &Spread, print: &dyn Fn(f64) -> String| {
        let [median, rms, max] = [spread.median, spread.rms, spread.max].map(print);
        vec![what.to_owned(), median, rms, max, unit.to_owned()]
    };
    let gap = format!("{:.0e}", measures.worst_gap);
    let gap = ["Distance of touching rods, off one diameter", "", "", &gap, "diameters"];
    let two = |x: f64| fixed(x, 2);
    Table {
        columns: vec![
            Column::text("figure"),
            Column::figure("median"),
            Column::figure("rms"),
            Column::figure("largest"),
            Column::text("unit"),
        ],
        rows: vec![
            gap.map(str::to_owned).to_vec(),
            row("Rod ends moved in closing", "diameters", &measures.moves, &two),
            row("Rise of contacts before closing", "diameters", &measures.rises, &two),
            row("Contacts from the surface", units.plural(), &measures.from_surface, &|mm| {
                units.length(mm)
            }),
            row("Angles of units, off regular", "degrees", &measures.unit_angles, &|x| fixed(x, 1)),
            row("Sides of units, off their mean", "per cent", &measures.unit_sides, &|x| {
                fixed(100.0 * x, 1)
            }),
        ],
    }
}

fn lengths(measures: &Measures, settings: &SheetSettings) -> String {
    let units = settings.units;
    let [shortest, longest] = measures.lengths;
    let different = match measures.distinct_lengths {
        1 => "all of one length".to_owned(),
        n => format!("in {}", counted(n, "different length")),
    };
    format!(
        "{} {different}, from {} to {}, {} in all. The rms (root mean square) is a mean in which \
         large figures count for more.",
        counted(measures.rods, "rod"),
        units.measure(shortest),
        units.measure(longest),
        units.total(measures.total_length)
    )
}
