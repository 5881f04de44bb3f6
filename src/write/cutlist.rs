//! The sawing plan as files: `cutlist.json` for programs, `cutlist.csv` for the saw.

use super::figure::{figure, rounded};
use super::json::Document;
use super::report::aim;
use super::structure::DiameterEntry;
use super::tables::{TableError, table};
use crate::shop::lengths::LengthClasses;
use crate::shop::saw::{Bar, CutPlan, Piece, Purchase};
use serde::Serialize;

/// The columns of `cutlist.csv`: a row a piece, in the order of sawing. A piece runs
/// from `start_mm` to `stop_mm`, both measured from the bar's end. `diameter_mm` is that of
/// the rod at end A, `diameter_b_mm` at end B. `offcut` is 1 for bars that were at hand; `price` is
/// that of the bar, empty without prices.
pub const COLUMNS: [&str; 13] = [
    "bar",
    "stock_length_mm",
    "position",
    "rod",
    "length_mm",
    "class",
    "start_mm",
    "stop_mm",
    "left_mm",
    "diameter_mm",
    "diameter_b_mm",
    "offcut",
    "price",
];

/// Digits after the point of lengths, mm: only the noise of arithmetic goes.
const DIGITS: usize = 6;

fn exact(x: f64) -> f64 {
    rounded(x, DIGITS as i32)
}

#[derive(Serialize)]
struct BarEntry {
    stock_length: f64,
    rods: Vec<String>,
    left: f64,
    stops: Vec<f64>,
    diameter: DiameterEntry,
    /// Whether it was at hand already.
    offcut: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    price: Option<f64>,
    /// Whether what is left is to be kept.
    keep: bool,
}

impl BarEntry {
    fn new(plan: &CutPlan, bar: &Bar) -> Self {
        Self {
            stock_length: exact(bar.stock_length),
            rods: bar.pieces.iter().map(|p| p.rod.to_string()).collect(),
            left: exact(bar.left),
            stops: bar.pieces.iter().map(|p| exact(p.stop)).collect(),
            diameter: diameter(bar.diameters),
            offcut: bar.at_hand,
            price: bar.price,
            keep: plan.keeps(bar),
        }
    }
}

#[derive(Serialize)]
struct StockEntry {
    stock_length: f64,
    count: usize,
    diameter: DiameterEntry,
    #[serde(skip_serializing_if = "Option::is_none")]
    price: Option<f64>,
}

fn diameter(ends: [f64; 2]) -> DiameterEntry {
    ends.map(exact).into()
}

/// The text of `cutlist.json`. `waste` is the share of the sawn length that becomes neither rods
/// nor left-overs to keep; `bound` is a number of bars that no plan goes below. What the plan
/// makes small is its `aim`: `bars` to buy, their `length`, or their `cost`; it comes to `spent`,
/// no plan goes below `least`, and it is `proven` where the two agree. Weight is in kg.
///
/// # Errors
/// [`TableError`], which no sawing plan causes.
pub fn cutlist_json(plan: &CutPlan, density: f64) -> Result<String, TableError> {
    document(plan, density).map_err(|e| TableError { table: "cutlist.json", reason: e.to_string() })
}

fn document(plan: &CutPlan, density: f64) -> Result<String, serde_json::Error> {
    let bars: Vec<BarEntry> = plan.bars.iter().map(|bar| BarEntry::new(plan, bar)).collect();
    let stock = |p: Purchase| StockEntry {
        stock_length: exact(p.length),
        count: p.count,
        diameter: diameter(p.diameters),
        price: p.price,
    };
    let buy: Vec<StockEntry> = plan.shopping().into_iter().map(stock).collect();
    let keep: Vec<StockEntry> = plan.kept().into_iter().map(stock).collect();
    let mut document = Document::new();
    document.value("kerf", &plan.kerf)?;
    document.list("bars", &bars)?;
    document.value("waste", &exact(plan.waste()))?;
    document.list("buy", &buy)?;
    document.value("cuts", &plan.cuts())?;
    document.value("used", &exact(plan.used()))?;
    document.value("bought", &exact(plan.bought()))?;
    document.value("bound", &plan.bound)?;
    document.value("proven", &plan.is_proven())?;
    document.value("trim", &plan.trim)?;
    document.value("aim", aim(plan))?;
    document.value("spent", &exact(plan.spent))?;
    document.value("least", &exact(plan.least))?;
    if let Some(cost) = plan.cost() {
        document.value("cost", &exact(cost))?;
    }
    document.list("keep", &keep)?;
    document.value("weight", &exact(plan.weight(density)))?;
    Ok(document.finish())
}

/// The bytes of `cutlist.csv`.
///
/// # Errors
/// [`TableError`], which no sawing plan causes.
pub fn cutlist_csv(plan: &CutPlan, classes: &LengthClasses) -> Result<Vec<u8>, TableError> {
    let rows = plan.bars.iter().enumerate().flat_map(|(number, bar)| {
        let row = move |(place, piece): (usize, &Piece)| {
            vec![
                (number + 1).to_string(),
                figure(bar.stock_length, DIGITS),
                (place + 1).to_string(),
                piece.rod.to_string(),
                figure(piece.length, DIGITS),
                classes.of(piece.rod).name.clone(),
                figure(piece.stop - piece.length, DIGITS),
                figure(piece.stop, DIGITS),
                figure(bar.left, DIGITS),
                figure(bar.diameters[0], DIGITS),
                figure(bar.diameters[1], DIGITS),
                u8::from(bar.at_hand).to_string(),
                bar.price.map_or_else(String::new, |price| figure(price, DIGITS)),
            ]
        };
        bar.pieces.iter().enumerate().map(row).collect::<Vec<_>>()
    });
    table("cutlist.csv", &COLUMNS, rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::lengths::{Stick, classes_of};
    use crate::shop::saw::{Stock, plan};
    use serde_json::{Value, json};

    fn tenth() -> (CutPlan, LengthClasses) {
        // 0.1 + 0.2 and the like leave noise in the stops.
        let stick = |length| Stick { length, diameters: [3.0; 2] };
        let sticks = [100.1, 50.2, 100.1, 30.3].into_iter().map(stick).collect();
        let stock = Stock::plain(&[210.0, 120.0], 0.7);
        (plan(&sticks, &stock).unwrap(), classes_of(&sticks))
    }

    #[test]
    fn json_has_the_keys_of_the_contract() {
        let (plan, _) = tenth();
        let v: Value = serde_json::from_str(&cutlist_json(&plan, 600.0).unwrap()).unwrap();
        assert_eq!(v["kerf"], 0.7);
        assert_eq!(
            (&v["bars"][0]["diameter"], &v["buy"][0]["diameter"]),
            (&json!(3.0), &json!(3.0))
        );
        let mut rods: Vec<&Value> = Vec::new();
        for bar in v["bars"].as_array().unwrap() {
            let stops = bar["stops"].as_array().unwrap();
            let last = stops.last().unwrap().as_f64().unwrap();
            let left = bar["left"].as_f64().unwrap();
            assert!((bar["stock_length"].as_f64().unwrap() - last - 0.7 - left).abs() < 1e-6);
            rods.extend(bar["rods"].as_array().unwrap());
        }
        rods.sort_by_key(|r| r.as_str());
        assert_eq!(json!(rods), json!(["R001", "R002", "R003", "R004"]));
        let waste = v["waste"].as_f64().unwrap();
        assert!((waste - (1.0 - 280.7 / v["bought"].as_f64().unwrap())).abs() < 1e-6);
        assert!(v["proven"].is_boolean() && v["bound"].is_u64());
    }

    #[test]
    fn csv_has_a_row_a_piece_with_its_stops() {
        let (plan, classes) = tenth();
        let text = String::from_utf8(cutlist_csv(&plan, &classes).unwrap()).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines[0],
            "bar,stock_length_mm,position,rod,length_mm,class,start_mm,stop_mm,left_mm,diameter_mm,\
             diameter_b_mm,offcut,price"
        );
        assert_eq!(lines.len(), 5);
        assert_eq!(lines[1], "1,210,1,R001,100.1,A,0,100.1,8.4,3,3,0,");
        assert_eq!(lines[2], "1,210,2,R003,100.1,A,100.8,200.9,8.4,3,3,0,");
    }
}
