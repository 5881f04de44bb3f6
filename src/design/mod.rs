//! What the user asks for: every setting, its default, and its bounds.
//!
//! The same [`Settings`] are read from design.toml and from the command line, where
//! nothing need be given. [`Settings::resolve`] fills in the defaults and checks
//! the whole, which gives a [`Design`].

mod file;
mod measured;
mod resolve;
mod rod;
mod settings;
mod statics;
mod stock;
mod tolerance;

pub use measured::MeasuredTable;
pub use resolve::Folders;
pub use rod::RodSetting;
pub use settings::Settings;
pub use statics::{LoadSetting, StaticsSettings};
pub use stock::{OffcutItem, StockItem};
pub use tolerance::ToleranceSetting;

use crate::chart::Method;
use crate::frame::close::Way;
use crate::frame::layer::Layering;
use crate::frame::relax::Relax;
use crate::frame::share::Share;
use crate::frame::sizes::SizeTable;
use crate::frame::tolerance::Tolerance;
use crate::pattern::{Pattern, PatternError, ShapeError};
use crate::sheets::labels::LabelSettings;
use crate::sheets::{Language, LaserProfile, Paper, PaperUnits, TextError, Texts};
use crate::shop::laser::Material;
use crate::shop::{JigSettings, OrderSettings, Stock};
use crate::statics::goal::Goal;
use crate::statics::wish::Wish;
use crate::surface::component::Component;
use crate::surface::cut::CutPlane;
use crate::surface::up::Up;
use crate::tiling::conway::Notation;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;
use thiserror::Error;

/// A part of the output folder.
#[derive(
    Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// structure.json, report.json and design.toml, which every folder has.
    Structure,
    /// rods.csv, contacts.csv, supports.csv, tolerance.csv
    Csv,
    /// cutlist.json, cutlist.csv
    Cutlist,
    /// assembly.json
    Assembly,
    /// steps.pdf: the pages of the assembly steps alone; only where it is named, since
    /// sheets.pdf has them
    Steps,
    /// model.glb
    Glb,
    /// viewer.html: the frame, its rod cards and its steps in a browser.
    Viewer,
    /// sheets.pdf, sheets/*.svg
    Sheets,
    /// labels.pdf, labels/*.svg
    Labels,
    /// handout.pdf: for a class that builds the model.
    Handout,
    /// support-map.svg, support-map.pdf, support-map.dxf
    SupportMap,
    /// footprint.svg: the flattened surface on its pattern.
    Footprint,
    /// statics.json, model.inp, model.mac, statics.pdf, statics/*.svg, where the statics are asked
    /// for
    Statics,
    /// jigs.svg, jigs.dxf: laser-cut parts; of several sheets jigs/*.svg, jigs/*.dxf. Where it
    /// is not named, they are left out if they do not fit the sheets
    Jigs,
    /// pictures/*.svg: the frame from the side and from above, and its histograms.
    Pictures,
}

/// What is written where nothing is named.
const ALL_PARTS: [Part; 14] = [
    Part::Structure,
    Part::Csv,
    Part::Cutlist,
    Part::Assembly,
    Part::Glb,
    Part::Viewer,
    Part::Sheets,
    Part::Labels,
    Part::Handout,
    Part::SupportMap,
    Part::Footprint,
    Part::Statics,
    Part::Jigs,
    Part::Pictures,
];

/// What the units of a frame are made on.
#[derive(Clone, Debug)]
pub enum Tiles {
    /// A pattern of the plane, on the chart of a surface file.
    Pattern(Arc<Pattern>),
    /// The polygons of a surface file.
    Mesh,
    /// A polyhedron on a sphere.
    Sphere(Sphere),
}

/// A sphere tiled by a polyhedron.
#[derive(Clone, Debug)]
pub struct Sphere {
    /// The polyhedron.
    pub notation: Notation,
    /// How much larger its units are on top.
    pub warp: f64,
    /// Radius, mm.
    pub radius: f64,
}

impl Tiles {
    /// The name for titles and reports.
    pub fn name(&self) -> String {
        match self {
            Self::Pattern(pattern) => pattern.name.clone(),
            Self::Mesh => "mesh".into(),
            Self::Sphere(sphere) => sphere.notation.to_string(),
        }
    }

    /// What it looks like, in a few words.
    pub fn summary(&self) -> &str {
        match self {
            Self::Pattern(pattern) => &pattern.summary,
            Self::Mesh => "the polygons of the surface itself",
            Self::Sphere(_) => "a polyhedron on a sphere, along great circles",
        }
    }
}

/// How the surface of a design begins that is no file.
const SPHERE: &str = "sphere:";

/// A complete, checked design. Lengths in mm, angles in radians.
#[derive(Clone, Debug)]
pub struct Design {
    /// The surface as given: a file, or `sphere:` and a notation.
    pub surface: PathBuf,
    /// The surface file, where it was found.
    pub surface_file: PathBuf,
    /// What the units are made on.
    pub tiles: Tiles,
    /// How the surface is flattened.
    pub chart: Method,
    /// Only what lies above this plane.
    pub cut: Option<CutPlane>,
    /// Only this piece.
    pub component: Option<Component>,
    /// The nominal diameter of the rods.
    pub rod: f64,
    /// Rods of other diameters.
    pub sizes: SizeTable,
    /// Longest horizontal side, if the model is to be scaled.
    pub span: Option<f64>,
    /// Tile edge, if it is not to be fitted.
    pub unit: Option<f64>,
    /// Turn of the rods, if it is not to be fitted.
    pub turn: Option<f64>,
    /// Slide of the rods, in tile edges.
    pub slide: f64,
    /// Start of the pattern in the plane.
    pub origin: [f64; 2],
    /// Turn of the pattern.
    pub rotate: f64,
    /// Whether the pattern is relaxed.
    pub relax: Relax,
    /// Rod beyond the last contact.
    pub overhang: f64,
    /// Who goes over.
    pub layer: Layering,
    /// How contacts are closed.
    pub close: Way,
    /// The file's up axis, if given.
    pub up: Option<Up>,
    /// What rods are sawn from, and how; without bars on sale to choose some.
    pub stock: Stock,
    /// Density of the rods, kg/m³.
    pub density: f64,
    /// Step of cut lengths.
    pub round: f64,
    /// How rods share lengths.
    pub share: Share,
    /// In which order it is put together.
    pub order: OrderSettings,
    /// Paper size.
    pub paper: Paper,
    /// Unit on paper.
    pub units: PaperUnits,
    /// Language on paper.
    pub language: Language,
    /// What is said on paper.
    pub texts: Texts,
    /// What rod labels are printed on, and from which label on.
    pub labels: LabelSettings,
    /// Which jigs are cut, and from what.
    pub jigs: JigSettings,
    /// What they are cut from: sets how wide the laser cuts, where that is not given.
    pub material: Material,
    /// The laser that cuts them.
    pub laser: LaserProfile,
    /// What was measured on sticks, if the frame is to be solved again with it.
    pub measured: Option<MeasuredTable>,
    /// How exact marks and sticks are, if it is to be tried what that does.
    pub tolerance: Option<Tolerance>,
    /// Where the random errors of that start.
    pub seed: u32,
    /// What is asked of the statics, if they are.
    pub statics: Option<Wish>,
    /// What turn, slide and tile edge are changed for, if they are.
    pub stiffen: Option<Goal>,
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
    /// The table of measurements is not valid.
    #[error("{file}: line {line}: {problem}")]
    Measured { file: PathBuf, line: u64, problem: String },
    /// The texts of the papers.
    #[error(transparent)]
    Texts(#[from] TextError),
    /// The pattern file cannot be read, or is not valid.
    #[error("{}", source.in_file(file))]
    Pattern { file: PathBuf, source: Box<PatternError> },
    /// No surface anywhere.
    #[error(
        "no surface given. Name a file, as in `rodwright build samples/igloo.obj`, or set `surface` in the design file"
    )]
    NoSurface,
    /// Turn and slide do not suit the pattern.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// A setting that would change nothing.
    #[error("{key} does nothing here: {why}. Leave it out")]
    Idle { key: &'static str, why: &'static str },
    /// A setting is outside its bounds.
    #[error("{key} = {value}: {problem}")]
    Setting { key: &'static str, value: String, problem: String },
}

impl DesignError {
    /// Whether a file cannot be read, as opposed to one that asks for what cannot be.
    pub fn is_io(&self) -> bool {
        match self {
            Self::Unreadable { .. } => true,
            Self::Pattern { source, .. } => source.is_io(),
            Self::Texts(e) => e.is_io(),
            _ => false,
        }
    }
}

impl Design {
    /// The name of the model: the surface's file name without its ending, or the
    /// notation of a sphere with its slash as a dash.
    pub fn name(&self) -> String {
        if let Tiles::Sphere(sphere) = &self.tiles {
            return format!("sphere-{}", sphere.notation.to_string().replace('/', "-"));
        }
        self.surface.file_stem().map_or_else(|| "model".into(), |s| s.to_string_lossy().into())
    }

    /// Where the folder goes when the user does not say: beside where we are.
    pub fn default_folder(&self) -> PathBuf {
        PathBuf::from(format!("{}-frame", self.name()))
    }

    /// Whether a part is named, and not only written with all others.
    pub fn names(&self, part: Part) -> bool {
        self.given.only.iter().flatten().any(|&named| named == part)
    }

    /// What was asked of the statics, as it was given.
    pub fn statics_as_given(&self) -> StaticsSettings {
        self.given.statics.clone().unwrap_or_default()
    }

    /// Whether a part is to be written.
    pub fn wants(&self, part: Part) -> bool {
        self.only.contains(&part)
    }
}
