//! The page behind the cover: the main figures of the frame, and its histograms.

use super::histograms::{
    GAP, HistogramPair, KEY_HEIGHT, LEAST_HEIGHT, histogram_pairs, key, pair_row,
};
use super::page::{BODY, Column, Flow, HEADING, Leaf, TABLE, TABLE_LEADING, Table};
use super::text::TextError;
use super::text::message::messages;
use super::{SheetError, SheetSettings};
use crate::drawing::Rect;
use crate::drawing::font::LEADING;
use crate::frame::measure::{Measures, Spread};

messages! {
    mod say in "figures.toml" {
        "title" => Title {}
        "introduction" => Introduction {}
        "main-figures" => MainFigures {}
        "figure" => Figure {}
        "median" => Median {}
        "rms" => Rms {}
        "largest" => Largest {}
        "unit" => Unit {}
        "gap" => Gap {}
        "gap-unit" => GapUnit {}
        "ends-moved" => EndsMoved {}
        "ends-moved-unit" => EndsMovedUnit {}
        "rise" => Rise {}
        "rise-unit" => RiseUnit {}
        "from-surface" => FromSurface {}
        "from-surface-unit" => FromSurfaceUnit { inches: bool }
        "unit-angles" => UnitAngles {}
        "unit-angles-unit" => UnitAnglesUnit {}
        "unit-sides" => UnitSides {}
        "unit-sides-unit" => UnitSidesUnit {}
        "rods" => Rods { rods: usize, lengths: usize, shortest: String, longest: String, total: String }
    }
}

/// Greatest height of a histogram, mm: taller, and it is stretched without showing more.
const GREATEST_HEIGHT: f64 = 80.0;

/// Histograms, and the main figures below.
pub(super) fn page(measures: &Measures, settings: &SheetSettings) -> Result<Vec<Leaf>, SheetError> {
    let mut flow = Flow::new(settings, "figures", &settings.say(say::Title {})?);
    flow.paragraph(&settings.say(say::Introduction {})?)?;
    let table = table(measures, settings)?;
    let lengths = lengths(measures, settings)?;
    let lines = table.rows.len() as f64 + 1.0;
    let below = HEADING * 1.7 + lines * TABLE * TABLE_LEADING + 2.0 + 3.0 * BODY * LEADING;
    grid(&histogram_pairs(measures, &settings.texts)?, below, &mut flow, settings)?;
    flow.heading(&settings.say(say::MainFigures {})?, below - HEADING * 1.7);
    flow.table(&table)?;
    flow.paragraph(&lengths)?;
    Ok(flow.finish(None))
}

/// All histograms, as tall as leaves `below` mm of the page.
fn grid(
    pairs: &[HistogramPair],
    below: f64,
    flow: &mut Flow,
    settings: &SheetSettings,
) -> Result<(), SheetError> {
    let [left, width] = [flow.area().min[0], flow.area().width()];
    flow.skip(1.5);
    let y = flow.y;
    key([left, y], &settings.texts, flow.page())?;
    flow.skip(KEY_HEIGHT);
    let rows = pairs.len().div_ceil(2).max(1) as f64;
    let height = (flow.room() - below) / rows - GAP;
    let height = height.clamp(LEAST_HEIGHT, GREATEST_HEIGHT);
    for row in pairs.chunks(2) {
        flow.need(height);
        let room = Rect::new([left, flow.y], [width, height]);
        pair_row(row, room, &settings.texts, flow.page())?;
        flow.skip(height + GAP);
    }
    Ok(())
}

fn table(measures: &Measures, settings: &SheetSettings) -> Result<Table, TextError> {
    let format = settings.format();
    let row = |what: String, unit: String, spread: &Spread, print: &dyn Fn(f64) -> String| {
        let [median, rms, max] = [spread.median, spread.rms, spread.max].map(print);
        vec![what, median, rms, max, unit]
    };
    let gap = format.local(format!("{:.0e}", measures.worst_gap));
    let (none, inches) = (String::new, settings.units.is_inches());
    Ok(Table {
        columns: vec![
            Column::text(settings.say(say::Figure {})?),
            Column::figure(settings.say(say::Median {})?),
            Column::figure(settings.say(say::Rms {})?),
            Column::figure(settings.say(say::Largest {})?),
            Column::text(settings.say(say::Unit {})?),
        ],
        rows: vec![
            vec![settings.say(say::Gap {})?, none(), none(), gap, settings.say(say::GapUnit {})?],
            row(
                settings.say(say::EndsMoved {})?,
                settings.say(say::EndsMovedUnit {})?,
                &measures.moves,
                &|x| format.fixed(x, 2),
            ),
            row(
                settings.say(say::Rise {})?,
                settings.say(say::RiseUnit {})?,
                &measures.rises,
                &|x| format.fixed(x, 2),
            ),
            row(
                settings.say(say::FromSurface {})?,
                settings.say(say::FromSurfaceUnit { inches })?,
                &measures.from_surface,
                &|mm| format.length(mm),
            ),
            row(
                settings.say(say::UnitAngles {})?,
                settings.say(say::UnitAnglesUnit {})?,
                &measures.unit_angles,
                &|x| format.fixed(x, 1),
            ),
            row(
                settings.say(say::UnitSides {})?,
                settings.say(say::UnitSidesUnit {})?,
                &measures.unit_sides,
                &|x| format.fixed(100.0 * x, 1),
            ),
        ],
    })
}

fn lengths(measures: &Measures, settings: &SheetSettings) -> Result<String, TextError> {
    let format = settings.format();
    let [shortest, longest] = measures.lengths.map(|mm| format.measure(mm));
    settings.say(say::Rods {
        rods: measures.rods,
        lengths: measures.distinct_lengths,
        shortest,
        longest,
        total: format.total(measures.total_length),
    })
}
