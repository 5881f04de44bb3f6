//! What every DXF file of release 2000 must have around its entities: header, tables,
//! blocks and objects. Fields and their order are those of Autodesk's DXF reference.

use super::document::{Document, Layer};
use super::file::Writer;

/// Handles of the fixed parts.
const VPORTS: u32 = 0x1;
const LINE_TYPES: u32 = 0x2;
const LAYERS: u32 = 0x3;
const STYLES: u32 = 0x4;
const VIEWS: u32 = 0x5;
const AXES: u32 = 0x6;
const APPLICATIONS: u32 = 0x7;
const DIMENSION_STYLES: u32 = 0x8;
const BLOCK_RECORDS: u32 = 0x9;
const ROOT: u32 = 0xA;
const GROUPS: u32 = 0xB;
const PAPER_SPACE: u32 = 0xC;
/// The block record that owns all entities.
pub(super) const MODEL_SPACE: u32 = 0xD;

/// Nobody.
const NONE: u32 = 0;
/// Room round everything when the file is opened, as a factor.
const VIEW: f64 = 1.1;
/// Text is shown in this font where the reader has it.
const FONT_FILE: &str = "arial.ttf";

/// The header section; millimetres.
pub(super) fn header(out: &mut Writer, [lo, hi]: [[f64; 3]; 2], next_handle: u32) {
    out.section("HEADER");
    let name = |out: &mut Writer, name: &str| out.pair(9, format_args!("${name}"));
    name(out, "ACADVER");
    out.pair(1, "AC1015");
    name(out, "DWGCODEPAGE");
    out.pair(3, "ANSI_1252");
    name(out, "INSUNITS");
    out.pair(70, 4);
    name(out, "MEASUREMENT");
    out.pair(70, 1);
    name(out, "EXTMIN");
    out.point(10, lo);
    name(out, "EXTMAX");
    out.point(10, hi);
    name(out, "HANDSEED");
    out.handle(5, next_handle);
    out.end_section();
}

/// Classes, tables and blocks.
pub(super) fn before_entities(out: &mut Writer, document: &Document) {
    out.section("CLASSES");
    out.end_section();
    out.section("TABLES");
    viewports(out, document.extent());
    line_types(out);
    layers(out, &document.layers);
    styles(out);
    table(out, "VIEW", VIEWS, 0);
    end_table(out);
    table(out, "UCS", AXES, 0);
    end_table(out);
    table(out, "APPID", APPLICATIONS, 1);
    record(out, "APPID", APPLICATIONS, "AcDbRegAppTableRecord", "ACAD");
    out.pair(70, 0);
    end_table(out);
    dimension_styles(out);
    block_records(out);
    out.end_section();
    out.section("BLOCKS");
    block(out, "*Model_Space", MODEL_SPACE, false);
    block(out, "*Paper_Space", PAPER_SPACE, true);
    out.end_section();
}

/// The objects section: the root dictionary with the empty dictionary of groups.
pub(super) fn objects(out: &mut Writer) {
    out.section("OBJECTS");
    dictionary(out, ROOT, NONE);
    out.pair(3, "ACAD_GROUP");
    out.handle(350, GROUPS);
    dictionary(out, GROUPS, ROOT);
    out.end_section();
}

fn dictionary(out: &mut Writer, handle: u32, owner: u32) {
    out.pair(0, "DICTIONARY");
    out.handle(5, handle);
    out.owner(owner);
    out.pair(100, "AcDbDictionary");
    // Entries that are copied in keep their owner.
    out.pair(281, 1);
}

fn table(out: &mut Writer, name: &str, handle: u32, entries: usize) {
    out.pair(0, "TABLE");
    out.pair(2, name);
    out.handle(5, handle);
    out.owner(NONE);
    out.pair(100, "AcDbSymbolTable");
    out.pair(70, entries);
}

fn end_table(out: &mut Writer) {
    out.pair(0, "ENDTAB");
}

/// The beginning of an entry of a table.
fn record(out: &mut Writer, kind: &str, table: u32, class: &str, name: &str) {
    out.pair(0, kind);
    out.new_handle();
    named(out, table, class, name);
}

fn named(out: &mut Writer, table: u32, class: &str, name: &str) {
    out.owner(table);
    out.pair(100, "AcDbSymbolTableRecord");
    out.pair(100, class);
    out.pair(2, name);
}

/// The window that a program opens with: from above on everything.
fn viewports(out: &mut Writer, [lo, hi]: [[f64; 3]; 2]) {
    table(out, "VPORT", VPORTS, 1);
    record(out, "VPORT", VPORTS, "AcDbViewportTableRecord", "*Active");
    out.pair(70, 0);
    let flat = |out: &mut Writer, code: u16, [x, y]: [f64; 2]| {
        out.real(code, x);
        out.real(code + 10, y);
    };
    flat(out, 10, [0.0, 0.0]);
    flat(out, 11, [1.0, 1.0]);
    flat(out, 12, [(lo[0] + hi[0]) / 2.0, (lo[1] + hi[1]) / 2.0]);
    flat(out, 13, [0.0, 0.0]);
    flat(out, 14, [10.0, 10.0]);
    flat(out, 15, [10.0, 10.0]);
    out.point(16, [0.0, 0.0, 1.0]);
    out.point(17, [0.0, 0.0, 0.0]);
    let side = (hi[0] - lo[0]).max(hi[1] - lo[1]).max(1.0);
    out.real(40, side * VIEW);
    // Width by height, length of the lens, clipping in front and behind, turns.
    for (code, x) in [(41, 1.0), (42, 50.0), (43, 0.0), (44, 0.0), (50, 0.0), (51, 0.0)] {
        out.real(code, x);
    }
    for (code, value) in [(71, 0), (72, 100), (73, 1), (74, 3), (75, 0), (76, 0), (77, 0), (78, 0)]
    {
        out.pair(code, value);
    }
    end_table(out);
}

fn line_types(out: &mut Writer) {
    let names = [("ByBlock", ""), ("ByLayer", ""), ("Continuous", "Solid line")];
    table(out, "LTYPE", LINE_TYPES, names.len());
    for (name, says) in names {
        record(out, "LTYPE", LINE_TYPES, "AcDbLinetypeTableRecord", name);
        out.pair(70, 0);
        out.pair(3, says);
        // Alignment is always A; no dashes, of no length together.
        out.pair(72, 65);
        out.pair(73, 0);
        out.real(40, 0.0);
    }
    end_table(out);
}

/// Layer 0, which every file has, and those of the document.
fn layers(out: &mut Writer, layers: &[Layer]) {
    let zero = ("0", Layer::BLACK);
    let others = layers.iter().map(|l| (&*l.name, l.color)).filter(|l| l.0 != zero.0);
    let all: Vec<_> = std::iter::once(zero).chain(others).collect();
    table(out, "LAYER", LAYERS, all.len());
    for (name, color) in all {
        record(out, "LAYER", LAYERS, "AcDbLayerTableRecord", name);
        out.pair(70, 0);
        out.pair(62, color);
        out.pair(6, "Continuous");
    }
    end_table(out);
}

fn styles(out: &mut Writer) {
    table(out, "STYLE", STYLES, 1);
    record(out, "STYLE", STYLES, "AcDbTextStyleTableRecord", "Standard");
    out.pair(70, 0);
    // Height as each text says, width as the font has it, upright.
    out.real(40, 0.0);
    out.real(41, 1.0);
    out.real(50, 0.0);
    out.pair(71, 0);
    out.real(42, 2.5);
    out.pair(3, FONT_FILE);
    out.pair(4, "");
    end_table(out);
}

/// Entries of this table alone have their handle at 105.
fn dimension_styles(out: &mut Writer) {
    table(out, "DIMSTYLE", DIMENSION_STYLES, 1);
    out.pair(100, "AcDbDimStyleTable");
    out.pair(0, "DIMSTYLE");
    out.new_handle_at(105);
    named(out, DIMENSION_STYLES, "AcDbDimStyleTableRecord", "Standard");
    out.pair(70, 0);
    end_table(out);
}

fn block_records(out: &mut Writer) {
    let blocks = [("*Model_Space", MODEL_SPACE), ("*Paper_Space", PAPER_SPACE)];
    table(out, "BLOCK_RECORD", BLOCK_RECORDS, blocks.len());
    for (name, handle) in blocks {
        out.pair(0, "BLOCK_RECORD");
        out.handle(5, handle);
        named(out, BLOCK_RECORDS, "AcDbBlockTableRecord", name);
        // No layout: programs make their own.
        out.handle(340, NONE);
    }
    end_table(out);
}

fn block(out: &mut Writer, name: &str, record: u32, on_paper: bool) {
    let entity = |out: &mut Writer, kind: &str, class: &str| {
        out.pair(0, kind);
        out.new_handle();
        out.owner(record);
        out.pair(100, "AcDbEntity");
        if on_paper {
            out.pair(67, 1);
        }
        out.pair(8, "0");
        out.pair(100, class);
    };
    entity(out, "BLOCK", "AcDbBlockBegin");
    out.pair(2, name);
    out.pair(70, 0);
    out.point(10, [0.0; 3]);
    out.pair(3, name);
    out.pair(1, "");
    entity(out, "ENDBLK", "AcDbBlockEnd");
}
