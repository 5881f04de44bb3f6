use super::*;
use crate::frame::fixture;
use crate::ids::Id;
use crate::sheets::{Language, Paper, PaperUnits, Texts};
use crate::shop::{OrderSettings, assembly, marks};
use crate::statics::fixture::studied;
use serde_json::Value;

fn settings(language: Language, units: PaperUnits) -> SheetSettings {
    SheetSettings {
        model: "a </script> & \"b\" %data%".to_owned(),
        paper: Paper::default(),
        units,
        density: 600.0,
        sawn: Default::default(),
        notes: Vec::new(),
        texts: Texts::built_in(language).unwrap(),
    }
}

fn data_of(page: &str) -> Value {
    let (_, rest) = page.split_once(r#"<script id="data" type="application/json">"#).unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_name_cannot_break_out_of_the_page() {
    let frame = fixture::circuit(5, 3.0);
    let settings = settings(Language::En, PaperUnits::Mm);
    let page = viewer(&frame, None, None, &settings).unwrap();
    assert_eq!(data_of(&page)["model"], settings.model);
    assert!(page.contains("<title>a &lt;/script&gt; &amp; &quot;b&quot; %data%</title>"));
    assert_eq!(page.matches("</script>").count(), 3);
    assert!(!page.contains("http://") && !page.contains("https://"));
}

#[test]
fn every_rod_has_the_figures_of_its_marks_as_the_papers_print_them() {
    let frame = fixture::circuit(6, 3.0);
    for units in [PaperUnits::Mm, PaperUnits::Inch, PaperUnits::ThirtySeconds] {
        let settings = settings(Language::De, units);
        let data = data_of(&viewer(&frame, None, None, &settings).unwrap());
        assert_eq!(data["rods"].as_array().unwrap().len(), 6);
        for (rod, shown) in frame.rods.ids().zip(data["rods"].as_array().unwrap()) {
            assert_eq!(shown["id"], rod.to_string());
            let length = settings.format().measure(frame.rods[rod].axis.length());
            assert!(shown["cut"].as_str().unwrap().starts_with(&length));
            let marks = marks(&frame, rod);
            assert_eq!(shown["marks"].as_array().unwrap().len(), marks.len());
            for (mark, shown) in marks.iter().zip(shown["marks"].as_array().unwrap()) {
                assert_eq!(shown["at"], settings.format().length(mark.at));
                assert_eq!(shown["angle"], settings.format().angle(mark.angle));
                assert_eq!(shown["side"], mark.side.letter());
            }
        }
    }
}

#[test]
fn every_rod_is_placed_in_one_step() {
    let frame = fixture::circuit(6, 3.0);
    let order = assembly(&frame, &[], OrderSettings::default()).unwrap();
    let page = viewer(&frame, Some(&order), None, &settings(Language::En, PaperUnits::Mm)).unwrap();
    let data = data_of(&page);
    assert_eq!(data["steps"].as_array().unwrap().len(), order.steps.len());
    let mut seen = 0;
    for (n, step) in data["steps"].as_array().unwrap().iter().enumerate() {
        for rod in step["rods"].as_array().unwrap() {
            assert_eq!(data["rods"][rod.as_u64().unwrap() as usize]["step"], n);
            seen += 1;
        }
    }
    assert_eq!(seen, 6);
}

#[test]
fn scripts_ask_only_for_words_that_there_are() {
    let data = data_of(
        &viewer(&fixture::circuit(3, 3.0), None, None, &settings(Language::En, PaperUnits::Mm))
            .unwrap(),
    );
    for attribute in ["data-say=\"", "data-label=\"", "data-hint=\""] {
        for word in PAGE.split(attribute).skip(1) {
            let word = word.split('"').next().unwrap();
            assert!(data["words"][word].is_string(), "{word}");
        }
    }
    for word in SCRIPTS.concat().split("data.words.").skip(1) {
        let word: String = word.chars().take_while(char::is_ascii_alphanumeric).collect();
        assert!(data["words"][&word].is_string(), "{word}");
    }
}

fn stress_of(page: &str) -> Option<Value> {
    let (_, rest) = page.split_once(r#"<script id="stress" type="application/json">"#).unwrap();
    let data = rest.split_once("</script>").unwrap().0;
    (!data.is_empty()).then(|| serde_json::from_str(data).unwrap())
}

#[test]
fn rods_have_the_stresses_of_the_study() {
    let (frame, study) = studied(6, 4.0);
    let settings = settings(Language::De, PaperUnits::Mm);
    let page = viewer(&frame, None, Some(&study), &settings).unwrap();
    let data = stress_of(&page).unwrap();
    let worst = study.worst();
    let largest = worst.iter().map(|w| w.value).fold(0.0, f64::max);
    let steps = data["colors"].as_array().unwrap().len() as f64 - 1.0;
    for (shown, worst) in data["rods"].as_array().unwrap().iter().zip(&worst) {
        let along: Vec<f64> = serde_json::from_value(shown["along"].clone()).unwrap();
        let most = along.chunks(2).map(|c| c[1]).fold(0.0, f64::max);
        assert_eq!(most, (worst.value / largest * steps).round());
        assert!(along.chunks(2).map(|c| c[0]).is_sorted());
        // Places are those of the model, not of the size studied.
        let length = frame.rods[worst.rod].axis.length();
        assert!((along[along.len() - 2] - length).abs() < 0.01);
        assert!((shown["at"].as_f64().unwrap() - worst.at / 4.0).abs() < 0.01);
        let text = shown["text"].as_str().unwrap();
        let peak = study.cases[worst.case].rods[worst.rod.index()];
        let stress = settings.format().three_digits(peak.stress);
        assert!(text.starts_with(&format!("Spannung {stress} MPa")), "{text}");
    }
}

#[test]
fn a_finished_page_is_given_other_stresses_or_none() {
    let (frame, study) = studied(5, 1.0);
    let settings = settings(Language::En, PaperUnits::Mm);
    let plain = viewer(&frame, None, None, &settings).unwrap();
    let stressed = viewer(&frame, None, Some(&study), &settings).unwrap();
    assert_eq!(stress_of(&plain), None);
    assert_eq!(with_stress(&plain, Some(&study), &settings).unwrap().unwrap(), stressed);
    assert_eq!(with_stress(&stressed, None, &settings).unwrap().unwrap(), plain);
    assert_eq!(with_stress("<html></html>", Some(&study), &settings).unwrap(), None);
}
