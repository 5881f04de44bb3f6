//! What is drawn and written of a finished model: the files of the output folder.

use crate::design::{Design, Part};
use crate::drawing::pdf::{self, DocumentInfo, Page};
use crate::drawing::{Drawing, DrawingError, dxf, svg};
use crate::frame::Frame;
use crate::frame::arrangement::arrangement;
use crate::pipeline::{Model, Stiffened, Tried};
use crate::sheets::labels::labels;
use crate::sheets::viewer::{viewer, with_stress};
use crate::sheets::{Document, LaserProfile, TextError, document_title, handout, jigs, notes};
use crate::sheets::{
    Sheet, SheetError, SheetSettings, footprint, histogram_pairs, histograms, relaxing_pairs,
};
use crate::sheets::{pictures, sheets, statics_sheets, step_sheets, support_map};
use crate::shop::Jigs;
use crate::shop::lengths::classes;
use crate::statics::study::Study;
use crate::write::assembly::assembly_json;
use crate::write::cutlist::{cutlist_csv, cutlist_json};
use crate::write::glb::{GlbError, assembly_glb, glb};
use crate::write::report::{self, Report};
use crate::write::statics::inp::calculix;
use crate::write::statics::mac::ansys;
use crate::write::statics::{StiffenedFigures, TriedFigures, statics_figures, statics_json};
use crate::write::structure::{Structure, StructureFault};
use crate::write::tables::{self, TableError};
use std::collections::BTreeSet;
use thiserror::Error;

/// A file of the output folder: its path inside, and its bytes.
pub type OutputFile = (String, Vec<u8>);

/// The files that the design wants of a model, in a fixed order.
///
/// # Errors
/// [`DocumentError`] when a document cannot be drawn or encoded.
pub fn files(design: &Design, model: &Model) -> Result<Vec<OutputFile>, DocumentError> {
    let frame = &model.formed.frame;
    let classes = classes(frame);
    let structure = Structure::from_frame(frame, &classes, &[]);
    let mut stock: Vec<f64> = model.plan.shopping().iter().map(|p| p.length).collect();
    stock.sort_by(|a, b| b.total_cmp(a));
    stock.dedup();
    let order = model.assembly.as_ref().map(|assembly| assembly.order);
    let study = model.statics.as_ref().and_then(|found| found.as_ref().ok());
    let mut files = Files::default();
    files.add("structure.json", structure.to_json()?);
    files.add("report.json", report(design, model).to_json()?);
    files.add("design.toml", design.to_toml(&model.fit, &stock, order));
    if design.wants(Part::Csv) {
        files.add("rods.csv", tables::rods(frame, &classes, study)?);
        files.add("contacts.csv", tables::contacts(frame)?);
        files.add("supports.csv", tables::supports(frame)?);
        if let Some(misfit) = &model.misfit {
            files.add("tolerance.csv", tables::tolerance(misfit)?);
        }
    }
    if design.wants(Part::Cutlist) {
        files.add("cutlist.json", cutlist_json(&model.plan, design.density)?);
        files.add("cutlist.csv", cutlist_csv(&model.plan, &classes)?);
    }
    if let (Some(assembly), true) = (&model.assembly, design.wants(Part::Assembly)) {
        files.add("assembly.json", assembly_json(assembly)?);
        if design.wants(Part::Glb) {
            files.add("assembly.glb", assembly_glb(&structure, assembly)?);
        }
    }
    if design.wants(Part::Glb) {
        files.add("model.glb", glb(&structure, study)?);
    }
    if design.wants(Part::Viewer) {
        let settings = sheet_settings(design, model)?;
        files.add("viewer.html", viewer(frame, model.assembly.as_ref(), study, &settings)?);
    }
    if design.wants(Part::Sheets) {
        add_sheets(design, model, &mut files)?;
    }
    if design.wants(Part::Labels) {
        let sheets = labels(frame, design.labels, &sheet_settings(design, model)?)?;
        add_pages("labels", sheets, (design, Document::Labels), &mut files)?;
    }
    if design.wants(Part::Handout) {
        let settings = sheet_settings(design, model)?;
        let sheets = handout::pages(frame, &model.plan, &design.tiles.name(), &settings)?;
        files.add("handout.pdf", bound(sheets, design, Document::Handout)?);
    }
    if let (Some(assembly), true) = (&model.assembly, design.wants(Part::Steps)) {
        let sheets = step_sheets(frame, assembly, &sheet_settings(design, model)?)?;
        files.add("steps.pdf", bound(sheets, design, Document::Steps)?);
    }
    if design.wants(Part::SupportMap) {
        add_support_map(design, model, &mut files)?;
    }
    if let (Some(plane), true) = (&model.footprint, design.wants(Part::Footprint)) {
        let sheet = footprint::drawing(plane, &sheet_settings(design, model)?)?;
        files.add("footprint.svg", svg::render(&sheet)?);
    }
    if let (Some(study), true) = (study, design.wants(Part::Statics)) {
        add_statics(design, frame, study, &mut files)?;
    }
    if let Some(Ok(jigs)) = &model.jigs {
        add_jigs(jigs, design.laser, &mut files)?;
    }
    if design.wants(Part::Pictures) {
        add_pictures(design, model, &mut files)?;
    }
    Ok(files.0)
}

/// The files of a finished folder that say something of statics, by another study than that which
/// the folder has: those about nothing else, and those of the others that `there` finds in it.
///
/// # Errors
/// [`DocumentError`] when one cannot be drawn or encoded.
pub fn studied_again<'a>(
    design: &Design,
    structure: &Structure,
    study: &Study,
    there: impl Fn(&str) -> Option<&'a [u8]>,
) -> Result<Vec<OutputFile>, DocumentError> {
    let frame = structure.to_frame()?;
    let mut files = Files::default();
    add_statics(design, &frame, study, &mut files)?;
    if there("rods.csv").is_some() {
        files.add("rods.csv", tables::rods(&frame, &classes(&frame), Some(study))?);
    }
    if there("model.glb").is_some() {
        files.add("model.glb", glb(structure, Some(study))?);
    }
    if let Some(page) = there("viewer.html").and_then(|bytes| str::from_utf8(bytes).ok()) {
        let page = with_stress(page, Some(study), &plain_settings(design))?;
        files.0.extend(page.map(|page| ("viewer.html".to_owned(), page.into_bytes())));
    }
    Ok(files.0)
}

/// The files about nothing but the statics of a frame.
fn add_statics(
    design: &Design,
    frame: &Frame,
    study: &Study,
    files: &mut Files,
) -> Result<(), DocumentError> {
    files.add("statics.json", statics_json(study)?);
    files.add("model.inp", calculix(study));
    files.add("model.mac", ansys(study));
    let sheets = statics_sheets(frame, study, &plain_settings(design))?;
    add_pages("statics", sheets, (design, Document::Statics), files)
}

#[derive(Default)]
struct Files(Vec<OutputFile>);

impl Files {
    fn add(&mut self, name: impl Into<String>, content: impl Into<Vec<u8>>) {
        self.0.push((name.into(), content.into()));
    }
}

fn report(design: &Design, model: &Model) -> Report {
    let (arrangement, tied) = report::arrangement(&arrangement(&model.formed));
    Report {
        model: design.name(),
        pattern: design.tiles.name(),
        rod_diameter: design.rod,
        turn: model.fit.turn.to_degrees(),
        surface: report::surface(&model.guide, &model.notes),
        fit: report::fit(&model.fit),
        relax: model.relaxing.clone(),
        closing: model.formed.closing,
        measures: model.measures.clone(),
        arrangement,
        tied,
        assembly: model.assembly.as_ref().map(report::assembly),
        sawing: report::sawing(&model.plan, design.density),
        shared_lengths: model.formed.shared.as_ref().map(report::shared),
        as_built: model.as_built.as_ref().map(report::as_built),
        tolerance: model.misfit.as_ref().map(report::tolerance),
        stiffened: model.stiffened.map(stiffened_figures),
        statics: model.statics.as_ref().map(statics_figures),
        jigs: model.jigs.as_ref().map(report::jigs),
        dropped: report::dropped(&model.formed.frame),
    }
}

/// What `report.json` says of a frame that was stiffened.
fn stiffened_figures(stiffened: Stiffened) -> StiffenedFigures {
    let Stiffened { goal, before, after, tried } = stiffened;
    let figures = |Tried { turn, slide, edge, rods, value }| TriedFigures {
        turn: turn.to_degrees(),
        slide,
        edge,
        rods,
        value,
    };
    StiffenedFigures { goal, before: figures(before), after: figures(after), tried }
}

fn add_sheets(design: &Design, model: &Model, files: &mut Files) -> Result<(), DocumentError> {
    let plane = model.footprint.as_ref();
    let settings = sheet_settings(design, model)?;
    let (frame, assembly) = (&model.formed.frame, model.assembly.as_ref());
    let sheets = sheets(frame, &model.measures, plane, &model.plan, assembly, &settings)?;
    add_pages("sheets", sheets, (design, Document::Sheets), files)
}

/// Sheets as one PDF file, and each as SVG in a folder of the same name.
fn add_pages(
    name: &str,
    sheets: Vec<Sheet>,
    (design, what): (&Design, Document),
    files: &mut Files,
) -> Result<(), DocumentError> {
    for sheet in &sheets {
        files.add(format!("{name}/{}.svg", sheet.stem), svg::render(&sheet.page.drawing)?);
    }
    files.add(format!("{name}.pdf"), bound(sheets, design, what)?);
    Ok(())
}

fn add_support_map(design: &Design, model: &Model, files: &mut Files) -> Result<(), DocumentError> {
    let (frame, settings) = (&model.formed.frame, sheet_settings(design, model)?);
    files.add("support-map.svg", svg::render(&support_map::drawing(frame, &settings)?)?);
    let (map, origin) = support_map::full_size(frame, &settings)?;
    files.add("support-map.dxf", dxf::render(&map, origin)?);
    let sheets = support_map::pages(frame, &settings)?;
    files.add("support-map.pdf", bound(sheets, design, Document::SupportMap)?);
    Ok(())
}

/// The frame from the side and from above, and its histograms.
fn add_pictures(design: &Design, model: &Model, files: &mut Files) -> Result<(), DocumentError> {
    for (name, picture) in pictures(&model.formed.frame) {
        files.add(format!("pictures/{name}.svg"), svg::render(&picture)?);
    }
    let mut pairs = histogram_pairs(&model.measures, &design.texts)?;
    if let Some(relaxing) = &model.relaxing {
        pairs.extend(relaxing_pairs(relaxing, &design.texts)?);
    }
    let figures = histograms(&pairs, &design.texts)?;
    files.add("pictures/histograms.svg", svg::render(&figures)?);
    Ok(())
}

/// The sheets for a laser: all in one file, where that is not too large, and each in its own as
/// well where there are several.
fn add_jigs(jigs: &Jigs, laser: LaserProfile, files: &mut Files) -> Result<(), DocumentError> {
    let named = |sheets: Vec<Drawing>| {
        let all = jigs::together(&sheets).map(|drawing| ("jigs".to_owned(), drawing));
        let single = if sheets.len() > 1 { sheets } else { Vec::new() };
        let stem = |i: usize| format!("jigs/sheet-{:02}", i + 1);
        let single = single.into_iter().enumerate().map(move |(i, sheet)| (stem(i), sheet));
        all.into_iter().chain(single)
    };
    for (stem, drawing) in named(jigs::laser_sheets(jigs, laser)) {
        files.add(format!("{stem}.svg"), svg::render(&drawing)?);
    }
    if laser.reads_dxf() {
        for (stem, drawing) in named(jigs::cad_sheets(jigs)) {
            let origin = [0.0, drawing.height];
            files.add(format!("{stem}.dxf"), dxf::render(&drawing, origin)?);
        }
    }
    Ok(())
}

/// How papers are printed, without what is known of the model only.
fn plain_settings(design: &Design) -> SheetSettings {
    SheetSettings {
        model: design.name(),
        paper: design.paper,
        units: design.units,
        density: design.density,
        sawn: BTreeSet::new(),
        notes: Vec::new(),
        texts: design.texts.clone(),
    }
}

fn sheet_settings(design: &Design, model: &Model) -> Result<SheetSettings, TextError> {
    let mut settings = plain_settings(design);
    settings.sawn = model.as_built.iter().flat_map(|what| what.sawn.iter().copied()).collect();
    let run = notes::Run {
        pattern: &design.tiles.name(),
        summary: design.tiles.summary(),
        fit: &model.fit,
        shared: model.formed.shared.as_ref(),
    };
    settings.notes = notes::notes(&run, settings.format(), &settings.texts)?;
    Ok(settings)
}

/// Sheets as one PDF file.
fn bound(
    sheets: Vec<Sheet>,
    design: &Design,
    document: Document,
) -> Result<Vec<u8>, DocumentError> {
    let pages: Vec<Page> = sheets.into_iter().map(|s| s.page).collect();
    let info = DocumentInfo {
        title: document_title(document, &design.name(), &design.texts)?,
        creator: format!("rodwright {}", env!("CARGO_PKG_VERSION")),
        language: design.texts.language().to_owned(),
        ..DocumentInfo::default()
    };
    Ok(pdf::render(&pages, &info)?)
}

/// Why a file cannot be made.
#[derive(Error, Debug)]
pub enum DocumentError {
    /// The papers.
    #[error(transparent)]
    Sheets(#[from] SheetError),
    /// A text.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A drawing.
    #[error(transparent)]
    Drawing(#[from] DrawingError),
    /// structure.json.
    #[error(transparent)]
    Structure(#[from] StructureFault),
    /// report.json or statics.json.
    #[error("a report cannot be written: {0}")]
    Report(#[from] serde_json::Error),
    /// A table.
    #[error(transparent)]
    Table(#[from] TableError),
    /// model.glb.
    #[error(transparent)]
    Glb(#[from] GlbError),
}
