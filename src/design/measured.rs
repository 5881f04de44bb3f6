//! What was measured on sticks: a table as a spreadsheet saves it.
//!
//! ```text
//! rod,mate,mark,diameter
//! R012,R009,112.4,
//! R012,R031,140.5mm,3.1mm
//! R020,,,2.9
//! ```

use super::DesignError;
use crate::frame::as_built::{Measured, MeasuredMark};
use crate::ids::{ContactId, RodId};
use crate::units::Length;
use csv::StringRecord;
use std::path::{Path, PathBuf};

/// A table of measurements, and where it was found.
#[derive(Clone, PartialEq, Debug)]
pub struct MeasuredTable {
    /// The file as given.
    pub given: PathBuf,
    /// The file where it was found.
    pub file: PathBuf,
    /// Its rows.
    pub rows: Vec<Measured>,
}

/// The columns, in any order; only the first has to be there.
const COLUMNS: [&str; 6] = ["rod", "mate", "contact", "mark", "diameter", "diameter_b"];

/// Where each of [`COLUMNS`] stands in a file.
type Places = [Option<usize>; COLUMNS.len()];

impl MeasuredTable {
    /// Reads a file.
    ///
    /// # Errors
    /// [`DesignError::Unreadable`], or [`DesignError::Measured`] with the line and what is wrong.
    pub fn read(given: &Path, file: PathBuf) -> Result<Self, DesignError> {
        let bytes = std::fs::read(&file)
            .map_err(|source| DesignError::Unreadable { file: file.clone(), source })?;
        let rows = rows(&bytes).map_err(|Fault { line, problem }| DesignError::Measured {
            file: file.clone(),
            line,
            problem,
        })?;
        Ok(Self { given: given.to_path_buf(), file, rows })
    }
}

/// What is wrong on a line.
#[derive(PartialEq, Debug)]
struct Fault {
    line: u64,
    problem: String,
}

fn rows(bytes: &[u8]) -> Result<Vec<Measured>, Fault> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .flexible(true)
        .from_reader(bytes);
    let places = {
        let header = reader.headers().map_err(|e| unreadable(&e))?;
        let line = header.position().map_or(1, csv::Position::line);
        places(header).map_err(|problem| Fault { line, problem })?
    };
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| unreadable(&e))?;
        let line = record.position().map_or(0, csv::Position::line);
        // Spreadsheets save rows that were emptied.
        if record.iter().any(|cell| !cell.is_empty()) {
            rows.push(row(&record, &places, line).map_err(|problem| Fault { line, problem })?);
        }
    }
    match rows.is_empty() {
        true => Err(Fault { line: 1, problem: "no row follows the header".into() }),
        false => Ok(rows),
    }
}

fn unreadable(e: &csv::Error) -> Fault {
    let line = e.position().map_or(1, csv::Position::line);
    let problem = match e.kind() {
        csv::ErrorKind::Utf8 { .. } => "this is no text in UTF-8: save the table as CSV".into(),
        _ => e.to_string(),
    };
    Fault { line, problem }
}

/// Where the columns stand.
fn places(header: &StringRecord) -> Result<Places, String> {
    let known = COLUMNS.join(", ");
    let mut places = Places::default();
    for (at, name) in header.iter().enumerate() {
        let Some(column) = COLUMNS.iter().position(|column| *column == name) else {
            return Err(format!(
                "`{name}` is no column: a header line names some of {known}, with commas between"
            ));
        };
        if places[column].replace(at).is_some() {
            return Err(format!("the column {name} is there twice"));
        }
    }
    match places[0] {
        None => Err(format!("there is no column rod: a header line names some of {known}")),
        Some(_) => Ok(places),
    }
}

fn row(record: &StringRecord, places: &Places, line: u64) -> Result<Measured, String> {
    if let Some(more) = record.iter().skip(places.iter().flatten().count()).find(|c| !c.is_empty())
    {
        return Err(format!("`{more}` stands beyond the last column"));
    }
    let cells = places.map(|at| at.and_then(|at| record.get(at)).filter(|cell| !cell.is_empty()));
    let [rod, mate, contact, mark, diameter, diameter_b] = cells;
    let rod = rod.ok_or("no rod is named")?;
    let rod_of = |name: &str| {
        RodId::read(name).ok_or_else(|| format!("`{name}` is not the number of a rod, as R012 is"))
    };
    let contact = contact.map(|name| {
        ContactId::read(name)
            .ok_or_else(|| format!("`{name}` is not the number of a contact, as C0034 is"))
    });
    let (mate, contact) = (mate.map(rod_of).transpose()?, contact.transpose()?);
    let length = |name: &str, cell: Option<&str>| {
        let length = cell.map(|text| text.parse::<Length>().map_err(|e| format!("{name}: {e}")));
        Ok::<_, String>(length.transpose()?.map(Length::mm))
    };
    let thick = |name: &str, cell| match length(name, cell)? {
        Some(d) if d <= 0.0 => Err(format!("{name} = {d}mm must be more than nothing")),
        other => Ok(other),
    };
    let at = length("mark", mark)?;
    let (a, b) = (thick("diameter", diameter)?, thick("diameter_b", diameter_b)?);
    if a.is_none() && b.is_some() {
        return Err("diameter_b is that of end B: give the diameter of end A, too".into());
    }
    if at.is_none() && (mate.is_some() || contact.is_some()) && a.is_none() {
        return Err("the mark is missing".into());
    }
    if at.is_none() && a.is_none() {
        return Err("neither a mark nor a diameter is given".into());
    }
    if at.is_some() && mate.is_none() && contact.is_none() {
        return Err("the mark is of which crossing? Name the mate or the contact".into());
    }
    Ok(Measured {
        line,
        rod: rod_of(rod)?,
        mark: at.map(|at| MeasuredMark { mate, contact, at }),
        diameter: a.map(|a| (a, b)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;

    #[test]
    fn a_table_is_read_in_any_order_of_columns() {
        let text = "# with the steel tape\nmark, rod, diameter_b, mate, contact, diameter\n\
                    112.4, R012, , R009, C0034, \n 11.24cm ,r12,3,,C0035,1/8in\n,,,,,\n,R001,,,,3\n";
        let read = rows(text.as_bytes()).unwrap();
        let (rod, contact) = (RodId::new(11), |n: usize| Some(ContactId::new(n - 1)));
        let mark = |mate, contact| MeasuredMark { mate, contact, at: 112.4 };
        let first = Some(mark(Some(RodId::new(8)), contact(34)));
        assert_eq!(read[0], Measured { line: 3, rod, mark: first, diameter: None });
        assert_eq!((read[1].rod, read[1].mark), (rod, Some(mark(None, contact(35)))));
        assert_eq!(read[1].diameter, Some((3.175, Some(3.0))));
        assert_eq!((read[2].line, read[2].mark), (6, None));
        assert_eq!(read.len(), 3);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, line, words) in [
            ("", 1, "no column rod"),
            ("rod,mate,mark\n", 1, "no row"),
            ("rod;mate;mark\nR1;R2;3\n", 1, "with commas between"),
            ("rod,mark,mark\n", 1, "twice"),
            ("mate,mark\nR1,3\n", 1, "no column rod"),
            ("rod,length\n", 1, "`length` is no column"),
            ("rod,mate,mark\nR1,R2,3\nR0,R2,3\n", 3, "`R0` is not the number of a rod"),
            ("rod,mate,mark\nR1,U2,3\n", 2, "`U2` is not the number of a rod"),
            ("rod,contact,mark\nR1,34,3\n", 2, "`34` is not the number of a contact"),
            ("rod,mate,mark\nR1,R2,3 furlongs\n", 2, "mark: `furlongs`"),
            ("rod,mate,mark\nR1,R2,\n", 2, "the mark is missing"),
            ("rod,mate,mark\nR1,,3\n", 2, "Name the mate or the contact"),
            ("rod,mate,mark\n,R2,3\n", 2, "no rod is named"),
            ("rod,mate,mark\nR1,,\n", 2, "neither a mark nor a diameter"),
            ("rod,diameter\nR1,0\n", 2, "more than nothing"),
            ("rod,diameter,diameter_b\nR1,,3\n", 2, "diameter of end A"),
            ("rod,diameter\nR1,3,5\n", 2, "`5` stands beyond"),
            ("rod,diameter\n\n\nR1,3 \"\nR2,\n", 5, "neither"),
        ] {
            let fault = rows(text.as_bytes()).unwrap_err();
            assert!(fault.problem.contains(words), "{text}: {fault:?}");
            assert_eq!(fault.line, line, "{text}: {fault:?}");
        }
        assert!(rows(b"rod,mark\nR1,\xff\n").unwrap_err().problem.contains("UTF-8"));
    }
}
