//! What the user asks for: every setting, its default, and its bounds.
//!
//! The same [`Settings`] are read from design.toml and from the command line, where
//! nothing need be given. [`Settings::resolve`] fills in the defaults and checks
//! the whole, which gives a [`Design`].

use crate::frame::layer::Layering;
use crate::pattern::{LIBRARY, Pattern};
use crate::sheets::{Paper, PaperUnits};
use crate::surface::up::Up;
use crate::units::{Angle, Length};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The settings as given: none is required, none has its default yet.
#[derive(clap::Args, Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The surface: an OBJ, glTF or GLB file
    #[arg(value_name = "SURFACE")]
    pub surface: Option<PathBuf>,

    /// Rod diameter [default: 3mm]
    #[arg(long, value_name = "LENGTH")]
    pub rod: Option<Length>,

    /// Longest horizontal side of the model [default: the file's own size, mm]
    #[arg(long, value_name = "LENGTH")]
    pub span: Option<Length>,

    /// Pattern, by vertex configuration [default: 4.4.4.4]
    #[arg(long, value_name = "NAME")]
    pub pattern: Option<String>,

    /// Mean tile edge [default: fitted to rod and surface]
    #[arg(long, value_name = "LENGTH")]
    pub unit: Option<Length>,

    /// Turn of the rods against the lines between unit centres [default: by pattern]
    #[arg(long, value_name = "ANGLE", allow_negative_numbers = true)]
    pub turn: Option<Angle>,

    /// Where the pattern starts, from the middle of the flattened surface [default: 0,0]
    #[arg(
        long,
        value_name = "U,V",
        value_delimiter = ',',
        num_args = 1,
        allow_hyphen_values = true
    )]
    pub origin: Option<Vec<Length>>,

    /// Turn of the whole pattern on the surface [default: 0deg]
    #[arg(long, value_name = "ANGLE", allow_negative_numbers = true)]
    pub rotate: Option<Angle>,

    /// Rod left beyond its last contact [default: two rod diameters]
    #[arg(long, value_name = "LENGTH")]
    pub overhang: Option<Length>,

    /// Who goes over: by the surface, or each rod on top of the next [default: follow]
    #[arg(long, value_enum)]
    pub layer: Option<Layering>,

    /// The axis of the file that points up [default: z; y for glTF]
    #[arg(long, value_name = "AXIS")]
    pub up: Option<Up>,

    /// Lengths in which the sticks are sold [default: 1000mm, or enough whole metres]
    #[arg(long, value_name = "LENGTH", value_delimiter = ',', num_args = 1)]
    pub stock: Option<Vec<Length>>,

    /// Width of a saw cut [default: 1mm]
    #[arg(long, value_name = "LENGTH")]
    pub kerf: Option<Length>,

    /// Cut lengths are multiples of this; 0 for exact ones [default: 0.5mm]
    #[arg(long, value_name = "LENGTH")]
    pub round: Option<Length>,

    /// Paper: a4, a3, letter, tabloid, or width x height such as 300x200mm [default: a4]
    #[arg(long, value_name = "PAPER")]
    pub paper: Option<Paper>,

    /// Unit of lengths on paper [default: mm]
    #[arg(long, value_enum)]
    pub units: Option<PaperUnits>,

    /// Write only these besides structure and report [default: all]
    #[arg(long, value_name = "PARTS", value_delimiter = ',', num_args = 1, value_enum)]
    pub only: Option<Vec<Part>>,
}

/// A part of the output folder.
#[derive(
    Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// structure.json, report.json and design.toml, which every folder has.
    Structure,
    /// rods.csv, contacts.csv, supports.csv
    Csv,
    /// cutlist.json, cutlist.csv
    Cutlist,
    /// model.glb
    Glb,
    /// sheets.pdf, sheets/*.svg
    Sheets,
    /// support-map.svg, support-map.pdf
    SupportMap,
    /// pictures/*.svg: the frame from the side and from above.
    Pictures,
}

const ALL_PARTS: [Part; 7] = [
    Part::Structure,
    Part::Csv,
    Part::Cutlist,
    Part::Glb,
    Part::Sheets,
    Part::SupportMap,
    Part::Pictures,
];

/// A complete, checked design. Lengths in mm, angles in radians.
#[derive(Clone, Debug)]
pub struct Design {
    /// The surface file, as given.
    pub surface: PathBuf,
    /// The surface file, where it was found.
    pub surface_file: PathBuf,
    /// Rod diameter.
    pub rod: f64,
    /// Longest horizontal side, if the model is to be scaled.
    pub span: Option<f64>,
    /// The pattern.
    pub pattern: &'static Pattern,
    /// Tile edge, if it is not to be fitted.
    pub unit: Option<f64>,
    /// Turn of the rods.
    pub turn: f64,
    /// Start of the pattern in the plane.
    pub origin: [f64; 2],
    /// Turn of the pattern.
    pub rotate: f64,
    /// Rod beyond the last contact.
    pub overhang: f64,
    /// Who goes over.
    pub layer: Layering,
    /// The file's up axis, if given.
    pub up: Option<Up>,
    /// Stock lengths; empty to choose one.
    pub stock: Vec<f64>,
    /// Saw cut.
    pub kerf: f64,
    /// Step of cut lengths.
    pub round: f64,
    /// Paper size.
    pub paper: Paper,
    /// Unit on paper.
    pub units: PaperUnits,
    /// What to write.
    pub only: Vec<Part>,
    given: Settings,
}

/// What is wrong with a design.
#[derive(Error, Debug)]
pub enum DesignError {
    /// The design file cannot be read.
    #[error("cannot read {file}: {source}. Check the name of the file")]
    Unreadable { file: PathBuf, source: std::io::Error },
    /// The design file is not valid; the message names line, key and known keys.
    #[error("{file}: {source}")]
    Invalid { file: PathBuf, source: Box<toml::de::Error> },
    /// No surface anywhere.
    #[error(
        "no surface given. Name a file, as in `rodwright build samples/igloo.obj`, or set `surface` in the design file"
    )]
    NoSurface,
    /// A setting is outside its bounds.
    #[error("{key} = {value}: {problem}")]
    Setting { key: &'static str, value: String, problem: String },
}

fn setting(key: &'static str, value: impl ToString, problem: impl Into<String>) -> DesignError {
    DesignError::Setting { key, value: value.to_string(), problem: problem.into() }
}

impl Settings {
    /// Reads a design file.
    ///
    /// # Errors
    /// [`DesignError`] when it cannot be read, is not TOML, or holds an unknown key.
    pub fn read(file: &Path) -> Result<Self, DesignError> {
        let unreadable = |source| DesignError::Unreadable { file: file.to_path_buf(), source };
        let text = std::fs::read_to_string(file).map_err(unreadable)?;
        toml::from_str(&text).map_err(|source| DesignError::Invalid {
            file: file.to_path_buf(),
            source: Box::new(source),
        })
    }

    /// These settings, with those of `other` where these say nothing.
    pub fn or(self, other: Self) -> Self {
        Self {
            surface: self.surface.or(other.surface),
            rod: self.rod.or(other.rod),
            span: self.span.or(other.span),
            pattern: self.pattern.or(other.pattern),
            unit: self.unit.or(other.unit),
            turn: self.turn.or(other.turn),
            origin: self.origin.or(other.origin),
            rotate: self.rotate.or(other.rotate),
            overhang: self.overhang.or(other.overhang),
            layer: self.layer.or(other.layer),
            up: self.up.or(other.up),
            stock: self.stock.or(other.stock),
            kerf: self.kerf.or(other.kerf),
            round: self.round.or(other.round),
            paper: self.paper.or(other.paper),
            units: self.units.or(other.units),
            only: self.only.or(other.only),
        }
    }

    /// Fills in the defaults and checks every setting. Relative surface paths are
    /// looked up in `folder` (that of the design file) first, then where we are.
    ///
    /// # Errors
    /// [`DesignError`] with the setting, its value, and what would be allowed.
    pub fn resolve(self, folder: Option<&Path>) -> Result<Design, DesignError> {
        let surface = self.surface.clone().ok_or(DesignError::NoSurface)?;
        let beside = folder.map(|f| f.join(&surface)).filter(|f| f.exists());
        let rod = positive("rod", self.rod)?.unwrap_or(DEFAULT_ROD);
        let pattern = pattern(self.pattern.as_deref())?;
        Ok(Design {
            surface_file: beside.unwrap_or_else(|| surface.clone()),
            surface,
            rod,
            span: positive("span", self.span)?,
            pattern,
            unit: positive("unit", self.unit)?,
            turn: turn(pattern, self.turn)?,
            origin: origin(self.origin.as_deref())?,
            rotate: self.rotate.map_or(0.0, Angle::radians),
            overhang: not_negative("overhang", self.overhang)?.unwrap_or(2.0 * rod),
            layer: self.layer.unwrap_or_default(),
            up: self.up,
            stock: stock(self.stock.as_deref())?,
            kerf: not_negative("kerf", self.kerf)?.unwrap_or(DEFAULT_KERF),
            round: not_negative("round", self.round)?.unwrap_or(DEFAULT_ROUND),
            paper: self.paper.unwrap_or_default(),
            units: self.units.unwrap_or_default(),
            only: self.only.clone().unwrap_or_else(|| ALL_PARTS.to_vec()),
            given: self,
        })
    }
}

/// Diameter of the sticks when none is given, mm: dowel from any craft shop.
const DEFAULT_ROD: f64 = 3.0;
/// Width of the cut of a fine saw, mm.
const DEFAULT_KERF: f64 = 1.0;
/// Step of cut lengths, mm: what can be marked and sawn by hand.
const DEFAULT_ROUND: f64 = 0.5;

fn positive(key: &'static str, length: Option<Length>) -> Result<Option<f64>, DesignError> {
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

fn pattern(name: Option<&str>) -> Result<&'static Pattern, DesignError> {
    let name = name.unwrap_or(LIBRARY[0].name);
    Pattern::named(name).ok_or_else(|| {
        let known: Vec<&str> = LIBRARY.iter().map(|p| p.name).collect();
        setting("pattern", name, format!("no such pattern; there are {}", known.join(", ")))
    })
}

fn turn(pattern: &Pattern, angle: Option<Angle>) -> Result<f64, DesignError> {
    let Some(angle) = angle else { return Ok(pattern.turn.to_radians()) };
    let [least, most] = pattern.turns;
    if (least..=most).contains(&angle.degrees().abs()) {
        return Ok(angle.radians());
    }
    let problem = format!(
        "the pattern {} holds together between {least} and {most} degrees, either way round",
        pattern.name
    );
    Err(setting("turn", angle, problem))
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

fn stock(lengths: Option<&[Length]>) -> Result<Vec<f64>, DesignError> {
    let lengths = lengths.unwrap_or_default();
    lengths.iter().map(|&l| positive("stock", Some(l)).map(|l| l.unwrap_or_default())).collect()
}

impl Design {
    /// The name of the model: the surface's file name without its ending.
    pub fn name(&self) -> String {
        self.surface.file_stem().map_or_else(|| "model".into(), |s| s.to_string_lossy().into())
    }

    /// Where the folder goes when the user does not say: beside where we are.
    pub fn default_folder(&self) -> PathBuf {
        PathBuf::from(format!("{}-frame", self.name()))
    }

    /// Whether a part is to be written.
    pub fn wants(&self, part: Part) -> bool {
        self.only.contains(&part)
    }

    /// The design as a file that repeats the run: every setting as it was used, with
    /// what was found for those left open in comments.
    pub fn to_toml(&self, found_unit: f64, found_stock: &[f64]) -> String {
        let mut file = TomlFile::default();
        file.text.push_str(
            "# Every setting as it was used; `rodwright build --design` repeats the run.\n",
        );
        file.set("surface", self.surface.to_string_lossy().into_owned());
        file.set("rod", mm(self.rod));
        match self.span {
            Some(span) => file.set("span", mm(span)),
            None => file.note("span is the file's own size, 1 unit = 1 mm (glTF: 1 m)"),
        }
        file.set("pattern", self.pattern.name);
        match self.unit {
            Some(unit) => file.set("unit", mm(unit)),
            None => file.note(&format!("unit was fitted to rod and surface: {found_unit:.2}mm")),
        }
        let turn =
            self.given.turn.map_or_else(|| format!("{}deg", self.pattern.turn), |t| t.to_string());
        file.set("turn", turn);
        file.set("origin", self.origin.map(mm).to_vec());
        file.set("rotate", self.given.rotate.map_or_else(|| "0deg".into(), |a| a.to_string()));
        file.set("overhang", mm(self.overhang));
        file.set("layer", choice(self.layer));
        match self.up {
            Some(up) => file.set("up", up.to_string()),
            None => file.note("up is z (glTF: y)"),
        }
        if self.stock.is_empty() {
            let lengths: Vec<String> = found_stock.iter().map(|&l| mm(l)).collect();
            file.note(&format!("stock was chosen to hold the longest rod: {}", lengths.join(", ")));
        } else {
            file.set("stock", self.stock.iter().map(|&l| mm(l)).collect::<Vec<_>>());
        }
        file.set("kerf", mm(self.kerf));
        file.set("round", mm(self.round));
        file.set("paper", self.paper.to_string());
        file.set("units", choice(self.units));
        if let Some(only) = &self.given.only {
            file.set("only", choice(only));
        }
        file.text
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

    fn note(&mut self, text: &str) {
        writeln!(self.text, "# {text}").expect("writing to a string cannot fail");
    }
}

/// A choice as the file names it.
fn choice(value: impl Serialize) -> toml::Value {
    toml::Value::try_from(value).expect("choices are written by their names: TOML strings")
}

fn mm(length: f64) -> String {
    format!("{length}mm")
}
