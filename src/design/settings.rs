//! The settings as given, on the command line or in design.toml.

use super::stock::{OffcutItem, StockItem};
use super::{DesignError, Part, RodSetting, StaticsSettings, ToleranceSetting};
use crate::chart::Method;
use crate::frame::close::Way;
use crate::frame::layer::Layering;
use crate::frame::relax::Relax;
use crate::sheets::labels::LabelMedium;
use crate::sheets::{Language, LaserProfile, Paper, PaperUnits};
use crate::shop::laser::Material;
use crate::shop::{Jig, Order};
use crate::statics::goal::Goal;
use crate::surface::component::Component;
use crate::surface::cut::CutPlane;
use crate::surface::up::Up;
use crate::units::{Angle, Length};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// The settings as given: none is required, none has its default yet.
#[derive(clap::Args, Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The surface: an OBJ, STL, PLY, OFF, glTF or GLB file, or a sphere such as sphere:aI/2
    #[arg(value_name = "SURFACE")]
    pub surface: Option<PathBuf>,

    /// Rod diameter [default: 3mm]
    #[arg(long, value_name = "LENGTH")]
    pub rod: Option<RodSetting>,

    /// Longest horizontal side of the model [default: the file's own size, mm; 600mm for a
    /// sphere]
    #[arg(long, value_name = "LENGTH")]
    pub span: Option<Length>,

    /// Pattern: a name of `rodwright patterns`, a pattern file (.toml), or mesh for the
    /// surface's own polygons [default: 4.4.4.4]
    #[arg(long, value_name = "NAME")]
    pub pattern: Option<String>,

    /// Tiling, where the rules of the pattern make several [default: as the pattern says]
    #[arg(long, value_name = "NAME")]
    pub cycle: Option<String>,

    /// How the surface is flattened [default: abf]
    #[arg(long, value_enum)]
    pub chart: Option<Method>,

    /// Keep what lies above this height, as z=120mm or z=40% [default: the whole surface]
    #[arg(long, value_name = "z=HEIGHT", allow_hyphen_values = true)]
    pub cut: Option<CutPlane>,

    /// Keep one piece: largest, or its number in the table of `rodwright inspect`
    #[arg(long, value_name = "PIECE")]
    pub component: Option<Component>,

    /// Sphere: units on top larger by this factor, those at the bottom smaller [default: 1]
    #[arg(long, value_name = "FACTOR")]
    pub warp: Option<f64>,

    /// Mean tile edge [default: fitted to rod and surface]
    #[arg(long, value_name = "LENGTH")]
    pub unit: Option<Length>,

    /// Turn of the rods against the lines between unit centres [default: by pattern; fitted
    /// on a sphere and with --pattern mesh]
    #[arg(long, value_name = "ANGLE", allow_negative_numbers = true)]
    pub turn: Option<Angle>,

    /// Slide of the rods along the tile edges, as part of an edge, to one side and the other
    /// in turn [default: by pattern]
    #[arg(long, value_name = "PART", allow_negative_numbers = true)]
    pub slide: Option<f64>,

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

    /// Whether the pattern is moved on the surface so that its units are more even in size
    /// [default: off]
    #[arg(long, value_enum)]
    pub relax: Option<Relax>,

    /// Rod left beyond its last contact [default: two rod diameters]
    #[arg(long, value_name = "LENGTH")]
    pub overhang: Option<Length>,

    /// Which rod goes over where two cross [default: auto]
    #[arg(long, value_enum)]
    pub layer: Option<Layering>,

    /// How contacts are made exact: with units kept in shape, by the least move, or as the
    /// paper does, which only comes near [default: shape]
    #[arg(long, value_enum)]
    pub close: Option<Way>,

    /// The axis of the file that points up [default: z; y for glTF]
    #[arg(long, value_name = "AXIS")]
    pub up: Option<Up>,

    /// Lengths in which the sticks are sold, with the price of one and how many there are, as
    /// in "1000mm @ 1.20, 2000mm @ 2.10 x 5" [default: 1000mm, or enough whole metres]
    #[arg(long, value_name = "BARS", value_delimiter = ',', num_args = 1)]
    pub stock: Option<Vec<StockItem>>,

    /// Offcuts at hand, as in 430mm,2x610mm: they cost nothing [default: none]
    #[arg(long, value_name = "BARS", value_delimiter = ',', num_args = 1)]
    pub offcuts: Option<Vec<OffcutItem>>,

    /// Shortest left-over that is kept and is no waste [default: all is waste]
    #[arg(long, value_name = "LENGTH")]
    pub keep: Option<Length>,

    /// Width of a saw cut [default: 1mm]
    #[arg(long, value_name = "LENGTH")]
    pub kerf: Option<Length>,

    /// What is sawn off either end of a bar before it is used, cut and all; of an offcut, off
    /// the end that is not sawn yet [default: 0mm]
    #[arg(long, value_name = "LENGTH")]
    pub trim: Option<Length>,

    /// Density of the sticks, kg/m³, for their weight [default: 600, a softwood]
    #[arg(long, value_name = "NUMBER")]
    pub density: Option<f64>,

    /// Cut lengths are multiples of this; 0 for exact ones [default: 0.5mm]
    #[arg(long, value_name = "LENGTH")]
    pub round: Option<Length>,

    /// Rods share so many lengths: the overhang of some gets longer
    #[arg(long, value_name = "NUMBER", conflicts_with = "class_tolerance")]
    pub classes: Option<usize>,

    /// Rods share as few lengths as they can when each gets longer by at most this
    #[arg(long, value_name = "LENGTH")]
    pub class_tolerance: Option<Length>,

    /// Assembly: from the middle outward on a table, or from the feet up with props [default:
    /// crown, if it needs no props]
    #[arg(long, value_enum)]
    pub order: Option<Order>,

    /// The most rods that a step of the assembly places; in crown order rods that only hold
    /// each other stay together [default: those of a unit]
    #[arg(long, value_name = "NUMBER")]
    pub step_rods: Option<usize>,

    /// Paper: a4, a3, letter, tabloid, or width x height such as 300x200mm [default: a4]
    #[arg(long, value_name = "PAPER")]
    pub paper: Option<Paper>,

    /// Unit of lengths on paper [default: mm]
    #[arg(long, value_enum)]
    pub units: Option<PaperUnits>,

    /// Language of the papers [default: en]
    #[arg(long, value_enum)]
    pub language: Option<Language>,

    /// Folder with texts of your own for the papers: its files take the place of those that
    /// `rodwright templates` writes, text by text
    #[arg(long, value_name = "FOLDER")]
    pub templates: Option<PathBuf>,

    /// What rod labels are printed on: sheets of labels of the size they are sold in, or strips
    /// cut from the paper [default: strips]
    #[arg(long, value_name = "SHEET", value_enum, ignore_case = true)]
    pub labels: Option<LabelMedium>,

    /// First free label of the first sheet, counted along the rows from 1, where labels of it
    /// are used up already [default: 1]
    #[arg(long, value_name = "N")]
    pub label_start: Option<usize>,

    /// What is cut by laser [default: all]
    #[arg(long, value_name = "JIGS", value_delimiter = ',', num_args = 1, value_enum)]
    pub jigs: Option<Vec<Jig>>,

    /// Sheets that a laser cuts jigs from, as width x height [default: 600x400mm]
    #[arg(long, value_name = "SIZE")]
    pub sheet: Option<Paper>,

    /// Thickness of those sheets, as measured [default: 3mm]
    #[arg(long, value_name = "LENGTH")]
    pub thickness: Option<Length>,

    /// What they are of [default: ply]
    #[arg(long, value_enum)]
    pub material: Option<Material>,

    /// Full width that the laser takes away; 0 draws parts at their exact size [default: 0.20mm in
    /// ply, 0.18mm in mdf, 0.15mm in acrylic and card]
    #[arg(long, value_name = "LENGTH")]
    pub laser_kerf: Option<Length>,

    /// The laser, or the program or service that cuts [default: generic]
    #[arg(long, value_enum)]
    pub laser: Option<LaserProfile>,

    /// Solve the frame again with what was measured on the sticks: a CSV file with the columns
    /// rod, mate or contact, mark, diameter (README, "Sticks as they are"). Rods in it are sawn:
    /// they keep their length, and contacts come to lie at their marks
    #[arg(long, value_name = "FILE")]
    pub as_built: Option<PathBuf>,

    /// Try how far the last contact of each unit will be off where marks and diameters are
    /// not exact, as "marks 0.5mm, diameter 0.1mm": ± two standard deviations, which 95 % keep
    #[arg(long, value_name = "ERRORS")]
    pub tolerance: Option<ToleranceSetting>,

    /// Where the random errors of --tolerance start [default: 1]
    #[arg(long, value_name = "N")]
    pub seed: Option<u32>,

    /// Study under which stresses the frame stands; any of the options of statics does so, too
    #[arg(long = "statics")]
    #[serde(skip)]
    pub study: bool,

    /// Change turn, slide and tile edge so that the largest stress or displacement becomes small
    /// under the loads given
    #[arg(long, value_enum, value_name = "WHAT")]
    pub stiffen: Option<Goal>,

    /// What is asked of its statics.
    #[command(flatten)]
    pub statics: Option<StaticsSettings>,

    /// Write only these besides structure and report [default: all]
    #[arg(long, value_name = "PARTS", value_delimiter = ',', num_args = 1, value_enum)]
    pub only: Option<Vec<Part>>,
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

    /// Those settings that tell how to print what is known of a finished frame: without what
    /// it was made by, whose files may be elsewhere by now.
    #[must_use]
    pub fn of_papers(self) -> Self {
        Self {
            surface: self.surface,
            paper: self.paper,
            units: self.units,
            language: self.language,
            templates: self.templates,
            stiffen: self.stiffen,
            statics: self.statics,
            ..Self::default()
        }
    }

    /// These settings, with those of `other` where these say nothing.
    pub fn or(self, other: Self) -> Self {
        // One of the two ways to share lengths takes the place of the other.
        let shares = self.classes.is_some() || self.class_tolerance.is_some();
        Self {
            surface: self.surface.or(other.surface),
            rod: match (self.rod, other.rod) {
                (Some(rod), Some(other)) => Some(rod.or(other)),
                (rod, other) => rod.or(other),
            },
            span: self.span.or(other.span),
            // A tiling goes with the pattern that it was named for.
            cycle: self.cycle.or(other.cycle.filter(|_| self.pattern.is_none())),
            pattern: self.pattern.or(other.pattern),
            chart: self.chart.or(other.chart),
            cut: self.cut.or(other.cut),
            component: self.component.or(other.component),
            warp: self.warp.or(other.warp),
            unit: self.unit.or(other.unit),
            turn: self.turn.or(other.turn),
            slide: self.slide.or(other.slide),
            origin: self.origin.or(other.origin),
            rotate: self.rotate.or(other.rotate),
            relax: self.relax.or(other.relax),
            overhang: self.overhang.or(other.overhang),
            layer: self.layer.or(other.layer),
            close: self.close.or(other.close),
            up: self.up.or(other.up),
            stock: self.stock.or(other.stock),
            offcuts: self.offcuts.or(other.offcuts),
            keep: self.keep.or(other.keep),
            kerf: self.kerf.or(other.kerf),
            trim: self.trim.or(other.trim),
            density: self.density.or(other.density),
            round: self.round.or(other.round),
            classes: self.classes.or(other.classes.filter(|_| !shares)),
            class_tolerance: self.class_tolerance.or(other.class_tolerance.filter(|_| !shares)),
            order: self.order.or(other.order),
            step_rods: self.step_rods.or(other.step_rods),
            paper: self.paper.or(other.paper),
            units: self.units.or(other.units),
            language: self.language.or(other.language),
            templates: self.templates.or(other.templates),
            // A half-used sheet is one of the labels that it was named for.
            label_start: self.label_start.or(other.label_start.filter(|_| self.labels.is_none())),
            labels: self.labels.or(other.labels),
            jigs: self.jigs.or(other.jigs),
            sheet: self.sheet.or(other.sheet),
            thickness: self.thickness.or(other.thickness),
            material: self.material.or(other.material),
            laser_kerf: self.laser_kerf.or(other.laser_kerf),
            laser: self.laser.or(other.laser),
            as_built: self.as_built.or(other.as_built),
            tolerance: self.tolerance.or(other.tolerance),
            seed: self.seed.or(other.seed),
            study: self.study || other.study,
            stiffen: self.stiffen.or(other.stiffen),
            statics: match (self.statics, other.statics) {
                (Some(own), Some(other)) => Some(own.or(other)),
                (own, other) => own.or(other),
            },
            only: self.only.or(other.only),
        }
    }
}
