//! design.toml: every setting as it was used.

use super::statics::OwnMaterial;
use super::{Design, Tiles};
use crate::frame::fit::Fit;
use crate::frame::share::Share;
use crate::sheets::Paper;
use crate::shop::Order;
use crate::statics::material::Material;
use serde::Serialize;
use std::fmt::Write as _;

impl Design {
    /// The design as a file that repeats the run: every setting as it was used, with
    /// what was found for those left open in comments.
    pub fn to_toml(&self, fit: &Fit, found_stock: &[f64], found_order: Option<Order>) -> String {
        let mut file = TomlFile::default();
        file.text.push_str(
            "# Every setting as it was used; `rodwright build --design` repeats the run.\n",
        );
        self.surface_settings(&mut file);
        self.tile_settings(&mut file, fit);
        file.set("overhang", mm(self.overhang));
        file.set("layer", choice(self.layer));
        file.set("close", choice(self.close));
        self.stock_settings(&mut file, found_stock);
        self.order_settings(&mut file, found_order);
        file.set("paper", self.paper.to_string());
        file.set("units", choice(self.units));
        file.set("language", choice(self.language));
        if let Some(folder) = &self.given.templates {
            file.set("templates", folder.to_string_lossy().into_owned());
        }
        file.set("labels", choice(self.labels.medium));
        if let Some(start) = self.given.label_start {
            file.set("label_start", start as i64);
        }
        self.jig_settings(&mut file);
        if let Some(measured) = &self.measured {
            file.set("as_built", measured.given.to_string_lossy().into_owned());
        }
        if let Some(tolerance) = self.tolerance {
            let both = [("marks", tolerance.marks), ("diameter", tolerance.diameter)];
            let table = both.map(|(key, length)| (key.to_owned(), mm(length).into()));
            file.set("tolerance", toml::Table::from_iter(table));
            file.set("seed", i64::from(self.seed));
        }
        if let Some(goal) = self.stiffen {
            file.set("stiffen", choice(goal));
        }
        if let Some(only) = &self.given.only {
            file.set("only", choice(only));
        }
        // What follows a table belongs to it, so they come last.
        self.rod_table(&mut file);
        self.statics_table(&mut file);
        file.text
    }

    /// Which jigs are cut by laser, and from what.
    fn jig_settings(&self, file: &mut TomlFile) {
        let jigs = &self.jigs;
        if self.given.jigs.is_some() {
            file.set("jigs", choice(&jigs.kinds));
        }
        let [width, height] = jigs.sheet;
        file.set("sheet", Paper::Custom { width, height }.to_string());
        file.set("thickness", mm(jigs.thickness));
        file.set("material", choice(self.material));
        file.set("laser_kerf", mm(jigs.kerf));
        file.set("laser", choice(self.laser));
    }

    /// In which order the frame is put together.
    fn order_settings(&self, file: &mut TomlFile, found: Option<Order>) {
        match (self.order.order, found) {
            (Some(order), _) => file.set("order", choice(order)),
            (None, Some(found)) => file.note(&format!("order was chosen: {}", found.code())),
            (None, None) => {}
        }
        if let Some(most) = self.order.step_rods {
            file.set("step_rods", most as i64);
        }
    }

    /// What rods are sawn from, and to.
    fn stock_settings(&self, file: &mut TomlFile, found: &[f64]) {
        match &self.given.stock {
            Some(stock) => {
                file.set("stock", stock.iter().map(ToString::to_string).collect::<Vec<_>>());
            }
            None => {
                let lengths: Vec<String> = found.iter().map(|&l| mm(l)).collect();
                file.note(&format!(
                    "stock was chosen to hold the longest rod: {}",
                    lengths.join(", ")
                ));
            }
        }
        if let Some(offcuts) = &self.given.offcuts {
            file.set("offcuts", offcuts.iter().map(ToString::to_string).collect::<Vec<_>>());
        }
        if let Some(keep) = self.stock.keep {
            file.set("keep", mm(keep));
        }
        file.set("kerf", mm(self.stock.kerf));
        file.set("trim", mm(self.stock.trim));
        file.set("density", self.density);
        file.set("round", mm(self.round));
        match self.share {
            Share::Off => {}
            Share::Classes(n) => file.set("classes", n as i64),
            Share::Tolerance(tolerance) => file.set("class_tolerance", mm(tolerance)),
        }
    }

    /// The rods, where they have several diameters.
    fn rod_table(&self, file: &mut TomlFile) {
        if self.sizes.is_empty() {
            return;
        }
        file.table("rod");
        file.set("diameter", mm(self.rod));
        file.table("rod.sizes");
        let unnamed = [("border", self.sizes.border), ("all", self.sizes.all)];
        let rods = self.sizes.rods.iter().map(|(rod, &ends)| (rod.to_string(), ends));
        let unnamed = unnamed.into_iter().filter_map(|(key, ends)| Some((key.to_owned(), ends?)));
        for (key, [a, b]) in unnamed.chain(rods) {
            if a == b { file.set(&key, mm(a)) } else { file.set(&key, vec![mm(a), mm(b)]) }
        }
    }

    /// What is asked of the statics, if they are.
    fn statics_table(&self, file: &mut TomlFile) {
        let Some(wish) = &self.statics else { return };
        let given = self.given.statics.clone().unwrap_or_default();
        file.table("statics");
        let named = Material::named(&wish.material_name);
        if named.is_some_and(|named| named == wish.material) {
            file.set("material", wish.material_name.clone());
        } else {
            file.set("material", table(OwnMaterial::of(&wish.material_name, &wish.material)));
        }
        file.set("joint", choice(wish.hold));
        file.set("feet", choice(wish.feet));
        if let Some(loads) = &given.loads {
            file.set("loads", loads.iter().map(ToString::to_string).collect::<Vec<_>>());
        }
        if let Some(snow) = given.snow {
            file.set("snow", snow.to_string());
        }
        if let Some(span) = wish.span {
            file.set("span", mm(span));
        }
        if given.combinations.is_some() {
            let names = wish.combinations.iter().map(|c| c.name.clone());
            file.set("combinations", names.collect::<Vec<_>>());
        }
        if let Some(supports) = given.supports {
            file.set("supports", choice(supports));
        }
    }

    fn surface_settings(&self, file: &mut TomlFile) {
        file.set("surface", self.surface.to_string_lossy().into_owned());
        if !matches!(self.tiles, Tiles::Sphere(_)) {
            match self.up {
                Some(up) => file.set("up", up.to_string()),
                None => file.note("up is z (glTF: y)"),
            }
        }
        if let Some(cut) = self.cut {
            file.set("cut", cut.to_string());
        }
        if let Some(component) = self.component {
            file.set("component", component.to_string());
        }
        match self.span {
            Some(span) => file.set("span", mm(span)),
            None => file.note("span is the file's own size, 1 unit = 1 mm (glTF: 1 m)"),
        }
    }

    fn tile_settings(&self, file: &mut TomlFile, fit: &Fit) {
        if self.sizes.is_empty() {
            file.set("rod", mm(self.rod));
        }
        let rotate = self.given.rotate.map_or_else(|| "0deg".into(), |a| a.to_string());
        match &self.tiles {
            Tiles::Pattern(pattern) => {
                file.set("pattern", self.given.pattern_name());
                if let Some(cycle) = &self.given.cycle {
                    file.set("cycle", cycle.clone());
                }
                file.set("chart", choice(self.chart));
                match self.unit {
                    Some(unit) => file.set("unit", mm(unit)),
                    None => {
                        file.note(&format!(
                            "unit was fitted to rod and surface: {:.2}mm",
                            fit.edge
                        ));
                    }
                }
                let usual = format!("{}deg", pattern.turn.usual);
                file.set("turn", self.given.turn.map_or(usual, |t| t.to_string()));
                file.set("slide", self.slide);
                file.set("origin", self.origin.map(mm).to_vec());
                file.set("rotate", rotate);
                file.set("relax", choice(self.relax));
                return;
            }
            Tiles::Mesh => file.set("pattern", "mesh"),
            Tiles::Sphere(sphere) => {
                file.set("warp", sphere.warp);
                file.set("rotate", rotate);
            }
        }
        file.set("slide", self.slide);
        match self.given.turn {
            Some(turn) => file.set("turn", turn.to_string()),
            None => file.note(&format!(
                "turn was fitted to rod and surface: {:.2}deg",
                fit.turn.to_degrees()
            )),
        }
    }
}

/// A TOML file with remarks, line by line.
#[derive(Default)]
struct TomlFile {
    text: String,
}

impl TomlFile {
    fn set(&mut self, key: &str, value: impl Into<toml::Value>) {
        let value: toml::Value = value.into();
        writeln!(self.text, "{key} = {value}").expect("writing to a string cannot fail");
    }

    fn table(&mut self, name: &str) {
        writeln!(self.text, "\n[{name}]").expect("writing to a string cannot fail");
    }

    fn note(&mut self, text: &str) {
        writeln!(self.text, "# {text}").expect("writing to a string cannot fail");
    }
}

/// A choice as the file names it.
fn choice(value: impl Serialize) -> toml::Value {
    toml::Value::try_from(value).expect("choices are written by their names: TOML strings")
}

/// A value that is written as a table.
fn table(value: impl Serialize) -> toml::Value {
    toml::Value::try_from(value).expect("its fields are texts and finite numbers")
}

fn mm(length: f64) -> String {
    format!("{length}mm")
}
