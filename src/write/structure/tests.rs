use super::*;
use crate::frame::Frame;
use crate::shop::fixture::circuit;
use crate::shop::lengths::classes;
use serde_json::{Value, json};
use std::path::Path;

fn structure(frame: &Frame) -> Structure {
    Structure::from_frame(frame, &classes(frame), &[])
}

fn parse(text: &str) -> Result<Structure, StructureError> {
    parse_structure(Path::new("s.json"), text.as_bytes())
}

fn value() -> Value {
    serde_json::from_str(&structure(&circuit(3, 3.0)).to_json().unwrap()).unwrap()
}

fn keys(v: &Value) -> Vec<&str> {
    v.as_object().unwrap().keys().map(String::as_str).collect()
}

#[test]
fn keys_are_those_of_version_1() {
    let v = value();
    assert_eq!((&v["format"], &v["version"]), (&json!("rodwright-structure"), &json!(1)));
    let top = ["contacts", "format", "ground", "report", "rod_diameter", "rods", "supports"];
    assert_eq!(keys(&v), [&top[..], &["units", "version"]].concat());
    let rod = ["a", "b", "border", "class", "diameter", "id", "length", "units"];
    assert_eq!(keys(&v["rods"][0]), rod);
    let contact = ["angle", "at_over", "at_under", "gap", "id", "kind", "normal", "over", "under"];
    assert_eq!(keys(&v["contacts"][0]), [&contact[..], &["unit"]].concat());
    let unit = ["center", "chirality", "contacts", "id", "rods", "sides"];
    assert_eq!(keys(&v["units"][0]), unit);
    assert_eq!(keys(&v["supports"][0]), ["end", "point", "rod"]);
    assert_eq!(v["report"], json!({"clashes": [], "dropped": []}));
    assert_eq!(
        (&v["units"][0]["chirality"], &v["supports"][0]["end"]),
        (&json!("ccw"), &json!("a"))
    );
}

#[test]
fn elements_take_a_line_each_in_fixed_order() {
    let text = structure(&circuit(3, 3.0)).to_json().unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[1], r#""format": "rodwright-structure","#);
    assert_eq!(lines[5], r#""rods": ["#);
    assert!(lines[6].starts_with(r#"  {"id":"R001","a":["#), "{}", lines[6]);
    assert!(
        lines[11].starts_with(r#"  {"id":"C0001","kind":"cross","over":"R001","under":"R002","#)
    );
}

#[test]
fn what_is_written_is_read_back() {
    let mut frame = circuit(5, 3.0);
    frame.dropped.push(crate::frame::Dropped {
        center: [1.0, 2.0, 3.0].into(),
        reason: "it would hang in the air".into(),
    });
    let before = structure(&frame);
    let text = before.to_json().unwrap();
    let after = parse(&text).unwrap();
    assert_eq!(before.contacts.len(), after.contacts.len());
    for (b, a) in before.rods.iter().zip(&after.rods) {
        assert_eq!((&b.id, &b.class, &b.units, b.border), (&a.id, &a.class, &a.units, a.border));
        for (x, y) in b.a.iter().chain(&b.b).zip(a.a.iter().chain(&a.b)) {
            assert!((x - y).abs() <= f64::EPSILON * x.abs());
        }
    }
    assert_eq!(before.units[0].rods, after.units[0].rods);
    assert_eq!(before.report, after.report);
}

#[test]
fn a_frame_comes_back_from_its_file() {
    let before = circuit(4, 3.0);
    let after = parse(&structure(&before).to_json().unwrap()).unwrap().to_frame().unwrap();
    assert_eq!(after.diameter, before.diameter);
    for ((r, b), a) in before.rods.enumerate().zip(&after.rods) {
        assert!((b.axis.a - a.axis.a).norm() < 1e-12, "{r}");
        assert_eq!(b.units, a.units);
        let mut mine = b.contacts.clone();
        mine.sort_by(|x, y| before.seen_from(*x, r).at.total_cmp(&before.seen_from(*y, r).at));
        assert_eq!(mine, a.contacts);
    }
    for (b, a) in before.contacts.iter().zip(&after.contacts) {
        assert_eq!((b.over, b.under, b.unit), (a.over, a.under, a.unit));
        assert!((b.angle - a.angle).abs() < 1e-12);
    }
    assert_eq!(after.units[crate::ids::Id::new(0)].contacts.len(), 4);
    assert_eq!(after.supports[1].rod, before.supports[1].rod);
}

#[test]
fn diameters_come_back_and_rods_without_one_have_the_nominal() {
    let mut frame = circuit(4, 3.0);
    let [first, second, third] = [0, 1, 2].map(crate::ids::Id::new);
    frame.rods[first].diameters = [5.0; 2];
    frame.rods[second].diameters = [6.0, 4.0];
    let mut v: Value = serde_json::from_str(&structure(&frame).to_json().unwrap()).unwrap();
    assert_eq!((&v["rods"][0]["diameter"], &v["rods"][2]["diameter"]), (&json!(5.0), &json!(3.0)));
    assert_eq!(v["rods"][1]["diameter"], json!([6.0, 4.0]));
    let after = parse(&v.to_string()).unwrap().to_frame().unwrap();
    let ends = |r| after.rods[r].diameters;
    assert_eq!([first, second, third].map(ends), [[5.0; 2], [6.0, 4.0], [3.0; 2]]);
    for rod in v["rods"].as_array_mut().unwrap() {
        rod.as_object_mut().unwrap().remove("diameter");
    }
    let old = parse(&v.to_string()).unwrap().to_frame().unwrap();
    assert!(old.rods.iter().all(|rod| rod.diameters == [3.0; 2]));
}

#[test]
fn syntax_errors_name_the_line() {
    let text = structure(&circuit(3, 3.0)).to_json().unwrap();
    let cut = &text[..text.len() / 2];
    let message = parse(cut).unwrap_err().to_string();
    let line = cut.lines().count();
    assert!(message.starts_with(&format!("s.json:{line}:")), "{message}");

    let lines: Vec<&str> = text.lines().collect();
    let column = lines[6].find("\"length\"").unwrap();
    let wrong = text.replacen("\"length\":", "\"length\":\"long\",\"x\":", 1);
    let message = parse(&wrong).unwrap_err().to_string();
    assert!(message.starts_with("s.json:7:"), "{message} {column}");
    assert!(message.contains("expected f64"), "{message}");
    let missing = text.replacen("\"angle\":", "\"angel\":", 1);
    let message = parse(&missing).unwrap_err().to_string();
    assert!(
        message.starts_with("s.json:12:") && message.contains("missing field `angle`"),
        "{message}"
    );
}

#[test]
fn other_formats_and_versions_are_refused() {
    let with = |key: &str, x: Value| {
        let mut v = value();
        v[key] = x;
        parse(&v.to_string()).unwrap_err().to_string()
    };
    assert_eq!(
        with("format", json!("plan")),
        "s.json: it is not a rodwright-structure file, but plan"
    );
    assert_eq!(with("format", json!(null)), "s.json: it is not a rodwright-structure file");
    assert_eq!(
        with("version", json!(2)),
        "s.json: it is of version 2; this program reads version 1"
    );
    assert!(matches!(parse("[]"), Err(StructureError::Format { .. })));
    assert!(matches!(parse(""), Err(StructureError::Json { line: 1, .. })));
    assert!(matches!(parse("{}"), Err(StructureError::Format { .. })));
    let none = read_structure(Path::new("no/such/file.json")).unwrap_err();
    assert!(none.to_string().starts_with("no/such/file.json: "));
}

#[test]
fn structures_that_do_not_hang_together_are_refused() {
    let fault = |change: &dyn Fn(&mut Structure)| {
        let mut s = structure(&circuit(3, 3.0));
        change(&mut s);
        let fault = s.check().unwrap_err();
        assert_eq!(s.to_json().unwrap_err(), fault);
        fault.to_string()
    };
    assert_eq!(fault(&|s| s.rod_diameter = 0.0), "a rod diameter of 0 mm is not a length above 0");
    assert_eq!(
        fault(&|s| s.rods[1].diameter = Some([4.0, -1.0].into())),
        "R002 has a diameter of -1 mm, which is not a length above 0"
    );
    assert_eq!(fault(&|s| s.rods[1].id = "R001".into()), "R001 stands there twice");
    assert_eq!(
        fault(&|s| s.contacts[0].over = "R009".into()),
        "C0001 names R009, which is not there"
    );
    assert_eq!(
        fault(&|s| s.units[0].contacts[0] = "C0009".into()),
        "U001 names C0009, which is not there"
    );
    assert_eq!(fault(&|s| s.rods[2].a[1] = f64::NAN), "R003 holds a number that is not finite");
    assert_eq!(fault(&|s| s.rods[2].a = s.rods[2].b), "R003 has the same point at both ends");
    assert_eq!(fault(&|s| s.contacts[1].under = "R002".into()), "C0002 names one rod twice");
    assert_eq!(
        fault(&|s| s.contacts[0].kind = ContactKindName::End),
        "C0001 is an end contact without end_over and end_under"
    );
    assert_eq!(fault(&|s| s.units[0].sides = 4), "U001 has fewer rods than sides");
    assert_eq!(fault(&|s| s.rods.clear()), "it has no rods");
}

#[test]
fn keys_that_are_not_known_are_skipped() {
    let mut v = value();
    v["rods"][0]["color"] = json!("red");
    v["report"]["elapsed"] = json!(1.5);
    assert!(parse(&v.to_string()).is_ok());
}
