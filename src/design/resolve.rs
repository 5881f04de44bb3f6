//! Fills in the defaults and checks every setting.

use super::{ALL_PARTS, Design, DesignError, MeasuredTable, Part, SPHERE, Settings, Sphere, Tiles};
use crate::frame::close::Way;
use crate::frame::share::Share;
use crate::frame::tolerance::Tolerance;
use crate::pattern::{Pattern, Shape, library};
use crate::sheets::labels::LabelSettings;
use crate::sheets::{Paper, Texts};
use crate::shop::{Jig, JigSettings, Offer, OrderSettings, Stock};
use crate::statics::wish::Wish;
use crate::tiling::conway::Notation;
use crate::units::{Angle, Length};
use std::path::{Path, PathBuf};

/// Where relative paths are looked up before where we are: in the folder of the design
/// file that names them.
#[derive(Clone, Copy, Default, Debug)]
pub struct Folders<'a> {
    /// For the surface.
    pub surface: Option<&'a Path>,
    /// For the pattern file.
    pub pattern: Option<&'a Path>,
    /// For the table of measurements.
    pub as_built: Option<&'a Path>,
    /// For the folder of texts.
    pub templates: Option<&'a Path>,
}

/// A file in a folder if there is one of this name, or else where we are.
fn beside(folder: Option<&Path>, file: &Path) -> PathBuf {
    folder.map(|f| f.join(file)).filter(|f| f.exists()).unwrap_or_else(|| file.to_path_buf())
}

pub(super) fn setting(
    key: &'static str,
    value: impl ToString,
    problem: impl Into<String>,
) -> DesignError {
    DesignError::Setting { key, value: value.to_string(), problem: problem.into() }
}

impl Settings {
    /// Fills in the defaults and checks every setting.
    ///
    /// # Errors
    /// [`DesignError`] with the setting, its value, and what would be allowed.
    pub fn resolve(self, folders: Folders) -> Result<Design, DesignError> {
        let surface = self.surface.clone().ok_or(DesignError::NoSurface)?;
        let given = self.rod.clone().unwrap_or_default();
        let rod = positive("rod", given.diameter)?.unwrap_or(DEFAULT_ROD);
        let tiles = self.tiles(&surface.to_string_lossy(), folders.pattern)?;
        self.check_fit_for(&tiles)?;
        let language = self.language.unwrap_or_default();
        Ok(Design {
            surface_file: beside(folders.surface, &surface),
            surface,
            chart: self.chart.unwrap_or_default(),
            cut: self.cut,
            component: self.component,
            rod,
            sizes: given.sizes,
            span: match &tiles {
                Tiles::Sphere(sphere) => Some(2.0 * sphere.radius),
                _ => positive("span", self.span)?,
            },
            unit: positive("unit", self.unit)?,
            turn: self.turn.map(Angle::radians),
            slide: self.shaped(&tiles)?,
            tiles,
            origin: origin(self.origin.as_deref())?,
            rotate: self.rotate.map_or(0.0, Angle::radians),
            relax: self.relax.unwrap_or_default(),
            overhang: not_negative("overhang", self.overhang)?.unwrap_or(2.0 * rod),
            layer: self.layer.unwrap_or_default(),
            close: self.close.unwrap_or_default(),
            up: self.up,
            stock: self.stock(rod)?,
            density: self.density()?,
            share: self.share()?,
            round: not_negative("round", self.round)?.unwrap_or(DEFAULT_ROUND),
            order: self.ordered()?,
            paper: self.paper.unwrap_or_default(),
            units: self.units.unwrap_or_default(),
            language,
            texts: match &self.templates {
                None => Texts::built_in(language)?,
                Some(own) => Texts::with_folder(language, &beside(folders.templates, own))?,
            },
            labels: self.labels()?,
            jigs: self.jigs()?,
            material: self.material.unwrap_or_default(),
            laser: self.laser.unwrap_or_default(),
            measured: self.measured(folders.as_built)?,
            tolerance: self.tolerance()?,
            seed: self.seed.unwrap_or(DEFAULT_SEED),
            statics: self.studied()?,
            stiffen: self.stiffen,
            only: self.only.clone().unwrap_or_else(|| ALL_PARTS.to_vec()),
            given: self,
        })
    }

    /// What rods are sawn from. Of rods of several diameters, offcuts are of the nominal one
    /// if they do not say.
    fn stock(&self, rod: f64) -> Result<Stock, DesignError> {
        let several = self.rod.as_ref().is_some_and(|r| !r.sizes.is_empty());
        let offcut =
            |offer: Offer| Offer { diameter: offer.diameter.or(several.then_some(rod)), ..offer };
        let offcuts = self.offcuts.iter().flatten().map(|item| offcut(item.0));
        let sold = self.stock.iter().flatten().map(|item| item.0);
        Ok(Stock {
            bars: offcuts.chain(sold).collect(),
            kerf: not_negative("kerf", self.kerf)?.unwrap_or(DEFAULT_KERF),
            trim: not_negative("trim", self.trim)?.unwrap_or(0.0),
            keep: positive("keep", self.keep)?,
        })
    }

    /// What rod labels are printed on, and from which label on.
    fn labels(&self) -> Result<LabelSettings, DesignError> {
        let medium = self.labels.unwrap_or_default();
        let Some(start) = self.label_start else { return Ok(LabelSettings { medium, used: 0 }) };
        let Some(grid) = medium.grid() else {
            let why = "strips are cut from plain paper. It is for sheets of labels, as in --labels \
                       l7160";
            return Err(DesignError::Idle { key: "label_start", why });
        };
        if !(1..=grid.labels()).contains(&start) {
            let problem = format!("a sheet has the labels 1 to {}", grid.labels());
            return Err(setting("label_start", start, problem));
        }
        Ok(LabelSettings { medium, used: start - 1 })
    }

    /// Which jigs are cut, and from what.
    fn jigs(&self) -> Result<JigSettings, DesignError> {
        let sheet = self.sheet.unwrap_or(DEFAULT_SHEET);
        let [width, height] = sheet.size();
        if width < LEAST_SHEET[0] || height < LEAST_SHEET[1] {
            let problem = format!(
                "a sheet is at least {} mm wide and {} mm high",
                LEAST_SHEET[0], LEAST_SHEET[1]
            );
            return Err(setting("sheet", sheet, problem));
        }
        let thickness = positive("thickness", self.thickness)?.unwrap_or(DEFAULT_THICKNESS);
        if thickness > MOST_THICKNESS {
            let given = format!("{thickness}mm");
            let problem = format!("a laser cuts boards of up to {MOST_THICKNESS} mm");
            return Err(setting("thickness", given, problem));
        }
        let usual = self.material.unwrap_or_default().kerf();
        let kerf = not_negative("laser_kerf", self.laser_kerf)?.unwrap_or(usual);
        // Slots are as wide as the board is thick, and half of that is to be left of them.
        if kerf > thickness / 2.0 {
            let problem = format!(
                "a cut is at most half as wide as the board is thick, which is {thickness} mm \
                 (--thickness)"
            );
            return Err(setting("laser_kerf", format!("{kerf}mm"), problem));
        }
        let mut kinds = self.jigs.clone().unwrap_or_else(|| Jig::ALL.to_vec());
        if kinds.is_empty() {
            return Err(setting("jigs", "[]", "name a kind, or leave it out for all"));
        }
        kinds.sort_unstable();
        kinds.dedup();
        Ok(JigSettings { kinds, sheet: [width, height], thickness, kerf })
    }

    /// What is asked of the statics, if they are.
    fn studied(&self) -> Result<Option<Wish>, DesignError> {
        let named = self.only.iter().flatten().any(|&part| part == Part::Statics);
        if !self.study && !named && self.statics.is_none() && self.stiffen.is_none() {
            return Ok(None);
        }
        if self.stiffen.is_some() && self.as_built.is_some() {
            let why = "the sticks are sawn already";
            return Err(DesignError::Idle { key: "stiffen", why });
        }
        let settings = self.statics.clone().unwrap_or_default();
        settings.resolve(self.density).map(Some)
    }

    fn density(&self) -> Result<f64, DesignError> {
        let of_rods = self.studied()?.map(|wish| wish.material.density);
        let density = self.density.or(of_rods).unwrap_or(DEFAULT_DENSITY);
        if density > 0.0 && density.is_finite() {
            return Ok(density);
        }
        Err(setting("density", density, "must be a number of kg/m³ above 0"))
    }

    fn share(&self) -> Result<Share, DesignError> {
        let tolerance = not_negative("class_tolerance", self.class_tolerance)?;
        match (self.classes, tolerance) {
            (Some(_), Some(_)) => Err(DesignError::Idle {
                key: "class_tolerance",
                why: "classes says how many lengths",
            }),
            (Some(0), None) => Err(setting("classes", 0, "there is at least one length")),
            (Some(n), None) => Ok(Share::Classes(n)),
            (None, Some(tolerance)) => Ok(Share::Tolerance(tolerance)),
            (None, None) => Ok(Share::Off),
        }
    }

    /// In which order the frame is put together.
    fn ordered(&self) -> Result<OrderSettings, DesignError> {
        match self.step_rods {
            Some(0) => Err(setting("step_rods", 0, "a step places at least one rod")),
            step_rods => Ok(OrderSettings { order: self.order, step_rods }),
        }
    }

    /// What was measured on sticks.
    fn measured(&self, folder: Option<&Path>) -> Result<Option<MeasuredTable>, DesignError> {
        let Some(given) = &self.as_built else { return Ok(None) };
        if self.close == Some(Way::Paper) {
            let problem = "close = paper leaves gaps larger than what is measured: take shape, or \
                           leave close out";
            return Err(setting("as-built", given.display(), problem));
        }
        MeasuredTable::read(given, beside(folder, given)).map(Some)
    }

    /// How exact marks and sticks are.
    fn tolerance(&self) -> Result<Option<Tolerance>, DesignError> {
        let Some(given) = self.tolerance else {
            let why = "it is for the random errors of --tolerance";
            return match self.seed {
                Some(_) => Err(DesignError::Idle { key: "seed", why }),
                None => Ok(None),
            };
        };
        let ends = [given.marks, given.diameter].map(|length| not_negative("tolerance", length));
        let [marks, diameter] = ends;
        let [marks, diameter] = [marks?.unwrap_or(0.0), diameter?.unwrap_or(0.0)];
        Ok(Some(Tolerance { marks, diameter }))
    }

    /// What the units are made on, by the surface and the pattern asked for.
    fn tiles(&self, surface: &str, folder: Option<&Path>) -> Result<Tiles, DesignError> {
        if let Some(text) = surface.strip_prefix(SPHERE) {
            let notation = text.parse::<Notation>();
            let notation = notation.map_err(|e| setting("surface", surface, e.to_string()))?;
            let warp = self.warp.unwrap_or(1.0);
            if !(LEAST_WARP..=1.0 / LEAST_WARP).contains(&warp) {
                let problem = format!("a warp is from {LEAST_WARP} to {}", 1.0 / LEAST_WARP);
                return Err(setting("warp", warp, problem));
            }
            let radius = positive("span", self.span)?.unwrap_or(DEFAULT_SPHERE) / 2.0;
            return Ok(Tiles::Sphere(Sphere { notation, warp, radius }));
        }
        Ok(match self.pattern.as_deref() {
            Some("mesh") => Tiles::Mesh,
            _ => Tiles::Pattern(self.plane_pattern(folder)?.into()),
        })
    }

    /// The slide, given or usual, once it is known to go with the turn. On other tiles than
    /// a pattern's the surface has a say, and both are checked there.
    fn shaped(&self, tiles: &Tiles) -> Result<f64, DesignError> {
        if let Some(slide) = self.slide.filter(|s| s.is_nan() || s.abs() >= MOST_SLIDE) {
            let problem = format!("a slide is a part of the tile edge, less than {MOST_SLIDE}");
            return Err(setting("slide", slide, problem));
        }
        let Tiles::Pattern(pattern) = tiles else { return Ok(self.slide.unwrap_or(0.0)) };
        let usual = pattern.usual();
        let turn = self.turn.map_or(usual.turn, Angle::radians);
        let slide = self.slide.unwrap_or(usual.slide);
        pattern.check(Shape { turn, slide })?;
        Ok(slide)
    }

    /// The pattern as it is named: of the library, or a file.
    pub(super) fn pattern_name(&self) -> &str {
        self.pattern.as_deref().unwrap_or(&library()[0].name)
    }

    /// The pattern asked for.
    fn plane_pattern(&self, folder: Option<&Path>) -> Result<Pattern, DesignError> {
        let (name, cycle) = (self.pattern_name(), self.cycle.as_deref());
        if Pattern::is_file(name) {
            let file = beside(folder, Path::new(name));
            return Pattern::read(&file, cycle)
                .map_err(|source| DesignError::Pattern { file, source: source.into() });
        }
        let pattern = Pattern::named(name).ok_or_else(|| no_such_pattern(name))?;
        match cycle {
            Some(cycle) => pattern.on(cycle).map_err(|e| setting("cycle", cycle, e.to_string())),
            None => Ok(pattern.clone()),
        }
    }

    /// Refuses settings that say nothing about what the units are made on.
    fn check_fit_for(&self, tiles: &Tiles) -> Result<(), DesignError> {
        let unit = self.unit.is_some().then_some("unit");
        let origin = self.origin.is_some().then_some("origin");
        let rotate = self.rotate.is_some().then_some("rotate");
        let pattern = self.pattern.is_some().then_some("pattern");
        let cycle = self.cycle.is_some().then_some("cycle");
        let up = self.up.is_some().then_some("up");
        let component = self.component.is_some().then_some("component");
        let chart = self.chart.is_some().then_some("chart");
        let relax = self.relax.is_some().then_some("relax");
        let warp = self.warp.is_some().then_some("warp");
        let (idle, why) = match tiles {
            Tiles::Pattern(_) => (vec![warp], "it is for spheres, as in sphere:aI/2"),
            Tiles::Mesh => (
                vec![warp, cycle, unit, origin, rotate, chart, relax],
                "the polygons of the mesh are the units; --span sets their size",
            ),
            Tiles::Sphere(_) => (
                vec![pattern, cycle, unit, origin, up, component, chart, relax],
                "the notation of the sphere says where its units are; --span sets their size",
            ),
        };
        match idle.into_iter().flatten().next() {
            Some(key) => Err(DesignError::Idle { key, why }),
            None => self.check_footprint_for(tiles),
        }
    }

    /// Refuses to draw the footprint, where it is asked for by name, of what is not laid
    /// flat.
    fn check_footprint_for(&self, tiles: &Tiles) -> Result<(), DesignError> {
        let why = match tiles {
            Tiles::Pattern(_) => return Ok(()),
            Tiles::Mesh => "the polygons of the mesh are the units, it is not laid flat",
            Tiles::Sphere(_) => "a sphere is not laid flat",
        };
        if self.only.iter().flatten().any(|&part| part == Part::Footprint) {
            return Err(DesignError::Idle { key: "only footprint", why });
        }
        Ok(())
    }
}

/// Rods that slide so far, or farther, leave the tile edge.
const MOST_SLIDE: f64 = 0.5;
/// Diameter of a sphere when none is given, mm: it fits a table.
const DEFAULT_SPHERE: f64 = 600.0;
/// The least warp; its inverse is the greatest. Beyond, units on one side are ten times
/// those on the other.
const LEAST_WARP: f64 = 0.3125;

/// Diameter of the sticks when none is given, mm: dowel from any craft shop.
const DEFAULT_ROD: f64 = 3.0;
/// Where random errors start when it is not said.
const DEFAULT_SEED: u32 = 1;
/// Width of the cut of a fine saw, mm.
const DEFAULT_KERF: f64 = 1.0;
/// Density of the rods when none is given, kg/m³: most softwoods are of 450 to 650, beech
/// and oak of 700.
const DEFAULT_DENSITY: f64 = 600.0;
/// Sheets for a laser when none are given: what most hobby machines and shops take.
const DEFAULT_SHEET: Paper = Paper::Custom { width: 600.0, height: 400.0 };
/// Least width and height of a sheet, mm: the reference rectangle and a part beside it.
const LEAST_SHEET: [f64; 2] = [120.0, 60.0];
/// Thickness of those sheets, mm: sold everywhere, and stiff enough.
const DEFAULT_THICKNESS: f64 = 3.0;
/// Thickest board that is cut by laser, mm.
const MOST_THICKNESS: f64 = 25.0;
/// Step of cut lengths, mm: what can be marked and sawn by hand.
const DEFAULT_ROUND: f64 = 0.5;

pub(super) fn positive(
    key: &'static str,
    length: Option<Length>,
) -> Result<Option<f64>, DesignError> {
    match length {
        Some(l) if l.mm() <= 0.0 => Err(setting(key, l, "must be more than nothing")),
        other => Ok(other.map(Length::mm)),
    }
}

fn not_negative(key: &'static str, length: Option<Length>) -> Result<Option<f64>, DesignError> {
    match length {
        Some(l) if l.mm() < 0.0 => Err(setting(key, l, "must not be negative")),
        other => Ok(other.map(Length::mm)),
    }
}

fn no_such_pattern(name: &str) -> DesignError {
    let near = Pattern::near(name).join(", ");
    let problem = format!(
        "no such pattern; the nearest are {near}. `rodwright patterns` lists all {}; mesh is for \
         the polygons of the surface, and a name that ends in .toml for a pattern file",
        library().len()
    );
    setting("pattern", name, problem)
}

fn origin(lengths: Option<&[Length]>) -> Result<[f64; 2], DesignError> {
    match lengths {
        None => Ok([0.0; 2]),
        Some([u, v]) => Ok([u.mm(), v.mm()]),
        Some(other) => {
            Err(setting("origin", format!("{} lengths", other.len()), "takes two, as in 10mm,-5mm"))
        }
    }
}
