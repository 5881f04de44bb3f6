//! Tables of Markdown, which read well as they are.

use super::trial::{Figures, Outcome};
use std::fmt::Write as _;

/// A column: its head, and what stands in it; none where there is no frame.
pub struct Column {
    head: &'static str,
    cell: fn(&Figures) -> Option<String>,
}

const fn column(head: &'static str, cell: fn(&Figures) -> Option<String>) -> Column {
    Column { head, cell }
}

/// A column with a figure of what was made.
macro_rules! made {
    ($head:literal, $field:ident, $format:literal) => {
        made!($head, $field, $format, $field)
    };
    ($head:literal, $field:ident, $format:literal, $value:expr) => {
        column($head, |f| match &f.outcome {
            Outcome::Made { $field, .. } => Some(format!($format, $value)),
            Outcome::Failed { .. } => None,
        })
    };
}

/// The table of one surface, to choose a pattern from.
pub const LARGE: [Column; 9] = [
    column("pattern", |f| Some(f.pattern.into())),
    made!("rods", rods, "{}"),
    made!("units", units, "{}"),
    made!("lengths", different_lengths, "{}"),
    made!("rod in all, m", total_length, "{:.2}", total_length / 1000.0),
    made!("tile edge, mm", tile_edge, "{:.1}"),
    made!("move, diameters", median_move, "{:.2}"),
    made!("off, mm", off_surface, "{:.1}"),
    made!("left out", left_out, "{}"),
];

/// The table of many surfaces, which says how well frames come out.
pub const WIDE: [Column; 10] = [
    column("surface", |f| Some(f.surface.clone())),
    column("pattern", |f| Some(f.pattern.into())),
    column("rod, mm", |f| Some(f.rod.to_string())),
    made!("rods", rods, "{}"),
    made!("units", units, "{}"),
    made!("left out", left_out, "{}"),
    made!("mean move, diameters", mean_move, "{:.2}"),
    made!("largest move", largest_move, "{:.2}"),
    made!("off, mm", off_surface, "{:.1}"),
    made!("worst gap, diameters", worst_gap, "{:.0e}"),
];

/// Figures in columns.
pub struct Table {
    heads: Vec<&'static str>,
    cells: Vec<Vec<String>>,
    /// Columns of names, the first ones.
    names: usize,
    /// What failed, a line each.
    failed: Vec<String>,
}

impl Table {
    pub fn new<'a>(columns: &[Column], rows: impl IntoIterator<Item = &'a Figures<'a>>) -> Self {
        let names = columns.iter().position(|c| c.head == "pattern").map_or(0, |i| i + 1);
        let heads = columns.iter().map(|c| c.head).collect();
        let mut table = Self { heads, cells: Vec::new(), names, failed: Vec::new() };
        for row in rows {
            let cells = columns.iter().map(|c| (c.cell)(row).unwrap_or_else(|| "-".into()));
            table.cells.push(cells.collect());
            if let Outcome::Failed { failed } = &row.outcome {
                let name = table.cells[table.cells.len() - 1][..names].join(", ");
                table.failed.push(format!("{name}: {failed}"));
            }
        }
        table
    }

    pub fn text(&self) -> String {
        let wide = |i: usize| self.cells.iter().map(move |row| row[i].chars().count());
        let widths: Vec<usize> = self
            .heads
            .iter()
            .enumerate()
            .map(|(i, head)| wide(i).fold(head.len(), usize::max))
            .collect();
        let rule = widths.iter().enumerate().map(|(i, &width)| {
            if i < self.names { "-".repeat(width) } else { "-".repeat(width - 1) + ":" }
        });
        let mut text = String::new();
        self.line(&mut text, &widths, self.heads.iter().copied());
        self.line(&mut text, &widths, rule);
        for row in &self.cells {
            self.line(&mut text, &widths, row);
        }
        for failed in &self.failed {
            write!(text, "\n{failed}\n").expect("writing to a string cannot fail");
        }
        text
    }

    fn line<S: AsRef<str>>(
        &self,
        text: &mut String,
        widths: &[usize],
        cells: impl IntoIterator<Item = S>,
    ) {
        for ((i, cell), width) in cells.into_iter().enumerate().zip(widths) {
            let cell = cell.as_ref();
            let cell =
                if i < self.names { format!("{cell:<width$}") } else { format!("{cell:>width$}") };
            write!(text, "| {cell} ").expect("writing to a string cannot fail");
        }
        text.push_str("|\n");
    }
}
