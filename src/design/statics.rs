//! What is asked of the statics, as given: options on the command line, the table `[statics]`
//! in a design file.
//!
//! ```toml
//! [statics]
//! material = "bamboo"         # or a table of figures of your own
//! joint = "tied"
//! feet = "pinned"
//! loads = ["R012:100N@35mm", "top:2kg"]
//! snow = "0.5kPa"
//! span = "10m"
//! combinations = ["1.35 weight + 1.5 snow"]
//! supports = "auto"
//! ```

use super::DesignError;
use super::resolve::{positive, setting};
use crate::ids::{Id, RodId};
use crate::statics::framework::Feet;
use crate::statics::joint::Hold;
use crate::statics::material::{Material, TABLE};
use crate::statics::study::Combination;
use crate::statics::wish::{Target, Wish, WishedLoad};
use crate::surface::Vector3;
use crate::units::{Force, Length, Pressure};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;
use std::str::FromStr;

/// What is asked of the statics: none is required, none has its default yet.
#[derive(clap::Args, Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StaticsSettings {
    /// What the rods are made of: pine, bamboo, birch, paper (the wood of the paper) or steel;
    /// figures of your own in a design file [default: pine]
    #[arg(id = "rod_material", long = "rod-material", value_name = "NAME")]
    pub material: Option<MaterialSetting>,

    /// How the rods of a contact hold each other [default: tied]
    #[arg(long, value_enum)]
    pub joint: Option<Hold>,

    /// How the feet are held by the ground [default: pinned]
    #[arg(long, value_enum)]
    pub feet: Option<Feet>,

    /// Forces on rods, as in R012:100N (down, in its middle), R012:2kg@35mm (from its end A),
    /// R012:5N+x (along x), top:1kg (on the highest contact)
    #[arg(long = "load", value_name = "LOAD", value_delimiter = ',', action = clap::ArgAction::Append)]
    #[serde(default)]
    pub loads: Option<Vec<LoadSetting>>,

    /// Load on the area that the frame covers in plan, as in 0.5kPa, 50kg/m2 or 10psf: snow, a
    /// book, a cover [default: none]
    #[arg(long, value_name = "PRESSURE")]
    pub snow: Option<Pressure>,

    /// Study the frame at another size: its longest horizontal side, diameters alike [default:
    /// as it is built]
    #[arg(id = "statics_span", long = "statics-span", value_name = "LENGTH")]
    pub span: Option<Length>,

    /// Loads that act together, with their factors, as in "1.35 weight + 1.5 snow"; repeat it
    /// for more cases [default: "1 weight + 1 snow + 1 loads"]
    #[arg(long = "combine", value_name = "SUM", action = clap::ArgAction::Append)]
    #[serde(default)]
    pub combinations: Option<Vec<CombinationSetting>>,

    /// Whether feet are added where something moves freely, until it stands [default: given]
    #[arg(long, value_enum)]
    pub supports: Option<Supports>,
}

/// Which feet a frame stands on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Supports {
    /// Its own
    #[default]
    Given,
    /// Its own, and more until it stands
    Auto,
}

impl StaticsSettings {
    /// These settings, with those of `other` where these say nothing.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            material: self.material.or(other.material),
            joint: self.joint.or(other.joint),
            feet: self.feet.or(other.feet),
            loads: self.loads.or(other.loads),
            snow: self.snow.or(other.snow),
            span: self.span.or(other.span),
            combinations: self.combinations.or(other.combinations),
            supports: self.supports.or(other.supports),
        }
    }

    /// Fills in the defaults and checks every setting. `density` takes the place of the
    /// material's, kg/m³.
    ///
    /// # Errors
    /// [`DesignError`] with the setting, its value, and what would be allowed.
    pub fn resolve(&self, density: Option<f64>) -> Result<Wish, DesignError> {
        let usual =
            MaterialSetting { name: DEFAULT_MATERIAL.into(), material: Material::default() };
        let MaterialSetting { name, material } = self.material.clone().unwrap_or(usual);
        let snow = self.snow.map_or(0.0, Pressure::mpa);
        if let Some(snow) = self.snow.filter(|s| s.mpa() < 0.0) {
            return Err(setting("snow", snow, "must not be negative"));
        }
        let loads: Vec<WishedLoad> = self.loads.iter().flatten().map(|l| l.0).collect();
        let given = self.combinations.clone().filter(|given| !given.is_empty());
        let combinations: Vec<Combination> = match given {
            None => vec![Combination { name: "all".into(), weight: 1.0, area: 1.0, points: 1.0 }],
            Some(given) => given.into_iter().map(|c| c.0).collect(),
        };
        for c in &combinations {
            let idle = [(c.area, snow == 0.0, "snow"), (c.points, loads.is_empty(), "load")];
            let named = |word: &str| c.name.contains(word);
            if let Some((.., word)) = idle.iter().find(|(_, none, word)| *none && named(word)) {
                let problem = format!("it names {word}, but there is none: give one with --{word}");
                return Err(setting("combinations", &c.name, problem));
            }
        }
        Ok(Wish {
            material: Material { density: density.unwrap_or(material.density), ..material },
            material_name: name,
            hold: self.joint.unwrap_or(Hold::Tied),
            feet: self.feet.unwrap_or(Feet::Pinned),
            span: positive("span of statics", self.span)?,
            loads,
            pressure: snow,
            combinations,
            add_feet: self.supports == Some(Supports::Auto),
        })
    }
}

/// What rods are made of when it is not said: the cheapest.
const DEFAULT_MATERIAL: &str = "pine";

/// A material as given: a name of the table, or figures.
#[derive(Clone, PartialEq, Debug)]
pub struct MaterialSetting {
    /// What it is called.
    pub name: String,
    /// Its figures.
    pub material: Material,
}

impl FromStr for MaterialSetting {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let material = Material::named(name).ok_or_else(|| {
            let known: Vec<&str> = TABLE.iter().map(|(name, _)| *name).collect();
            format!("`{name}` is none of {}", known.join(", "))
        })?;
        Ok(Self { name: name.into(), material })
    }
}

/// Figures of one's own in a design file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OwnMaterial {
    #[serde(default = "own")]
    name: String,
    young_mpa: f64,
    /// Without it as of an even material: E / 2(1 + ν).
    shear_mpa: Option<f64>,
    #[serde(default = "usual_poisson")]
    poisson: f64,
    density: f64,
    strength_mpa: f64,
}

fn own() -> String {
    "own".into()
}

fn usual_poisson() -> f64 {
    0.3
}

impl OwnMaterial {
    /// The table that reads back as this material.
    pub(super) fn of(name: &str, material: &Material) -> Self {
        let Material { young, shear, poisson, density, strength } = *material;
        let (young_mpa, shear_mpa, strength_mpa) = (young, Some(shear), strength);
        Self { name: name.into(), young_mpa, shear_mpa, poisson, density, strength_mpa }
    }

    fn checked(self) -> Result<MaterialSetting, String> {
        let Self { name, young_mpa: young, poisson, density, strength_mpa: strength, .. } = self;
        if !(0.0..=0.5).contains(&poisson) {
            return Err(format!("poisson = {poisson}: it lies between 0 and 0.5"));
        }
        let shear = self.shear_mpa.unwrap_or(young / (2.0 * (1.0 + poisson)));
        let figures = [
            ("young_mpa", young),
            ("shear_mpa", shear),
            ("density", density),
            ("strength_mpa", strength),
        ];
        match figures.iter().find(|(_, x)| !(*x > 0.0 && x.is_finite())) {
            Some((key, x)) => Err(format!("{key} = {x}: it must be a number above 0")),
            None => Ok(MaterialSetting {
                name,
                material: Material { young, shear, poisson, density, strength },
            }),
        }
    }
}

impl<'de> Deserialize<'de> for MaterialSetting {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MaterialVisitor)
    }
}

/// Not an untagged enum: its errors would say neither key nor reason.
struct MaterialVisitor;

impl<'de> Visitor<'de> for MaterialVisitor {
    type Value = MaterialSetting;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of a material, or a table with young_mpa, density and strength_mpa")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<MaterialSetting, E> {
        name.parse().map_err(E::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialSetting, A::Error> {
        let own = OwnMaterial::deserialize(MapAccessDeserializer::new(map))?;
        own.checked().map_err(A::Error::custom)
    }
}

/// A force on a rod as given: `R012:100N@35mm`, with `+x` or `-z` and so on behind it for the
/// way it acts; without, down.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LoadSetting(pub WishedLoad);

/// The ways a force can act, as they are written.
const WAYS: [(&str, [f64; 3]); 6] = [
    ("+x", [1.0, 0.0, 0.0]),
    ("-x", [-1.0, 0.0, 0.0]),
    ("+y", [0.0, 1.0, 0.0]),
    ("-y", [0.0, -1.0, 0.0]),
    ("+z", [0.0, 0.0, 1.0]),
    ("-z", [0.0, 0.0, -1.0]),
];

impl FromStr for LoadSetting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (on, rest) = text
            .split_once(':')
            .ok_or_else(|| format!("`{text}` is no load: write it as R012:100N, or top:2kg"))?;
        let way = WAYS.iter().find(|(way, _)| rest.ends_with(way));
        let rest = way.map_or(rest, |(way, _)| rest.trim_end_matches(way));
        let direction = Vector3::from(way.map_or([0.0, 0.0, -1.0], |(_, direction)| *direction));
        let (force, at) = match rest.split_once('@') {
            Some((force, at)) => (force, Some(at)),
            None => (rest, None),
        };
        let force: Force = force.trim().parse().map_err(|e| format!("{text}: {e}"))?;
        let at: Option<Length> =
            at.map(|at| at.parse().map_err(|e| format!("{text}: {e}"))).transpose()?;
        let on = match (on.trim(), at) {
            ("top", None) => Target::Top,
            ("top", Some(_)) => return Err(format!("{text}: a load on top has no place on a rod")),
            (rod, at) => Target::Rod(rod_named(rod)?, at.map(Length::mm)),
        };
        Ok(Self(WishedLoad { on, force: direction * force.newtons() }))
    }
}

fn rod_named(name: &str) -> Result<RodId, String> {
    let number = name.strip_prefix(['R', 'r']).and_then(|digits| digits.parse::<usize>().ok());
    match number.filter(|n| *n > 0) {
        Some(n) => Ok(RodId::new(n - 1)),
        None => Err(format!("`{name}` is no rod: write R012, or top for the highest contact")),
    }
}

/// As it is read.
impl fmt::Display for LoadSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let WishedLoad { on, force } = self.0;
        match on {
            Target::Top | Target::Near(_) => f.write_str("top")?,
            Target::Rod(rod, _) => write!(f, "{rod}")?,
        }
        let share = |way: &[f64; 3]| force.dot(&Vector3::from(*way));
        let way = WAYS.iter().rev().find(|(_, way)| share(way) > 0.0);
        let (way, direction) = way.unwrap_or(&WAYS[5]);
        write!(f, ":{}N", share(direction))?;
        if let Target::Rod(_, Some(at)) = on {
            write!(f, "@{at}mm")?;
        }
        f.write_str(way)
    }
}

/// A sum of loads as given: `1.35 weight + 1.5 snow`.
#[derive(Clone, PartialEq, Debug)]
pub struct CombinationSetting(pub Combination);

impl FromStr for CombinationSetting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let name = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let mut sum = Combination { name, weight: 0.0, area: 0.0, points: 0.0 };
        for part in text.split('+').map(str::trim) {
            let (factor, kind) = part.rsplit_once(char::is_whitespace).unwrap_or(("1", part));
            let factor: f64 = factor
                .trim()
                .parse()
                .ok()
                .filter(|f: &f64| f.is_finite())
                .ok_or_else(|| format!("`{factor}` in `{text}` is no number"))?;
            match kind {
                "weight" => sum.weight += factor,
                "snow" => sum.area += factor,
                "load" | "loads" => sum.points += factor,
                _ => return Err(format!("`{part}` in `{text}` is none of weight, snow, loads")),
            }
        }
        Ok(Self(sum))
    }
}

macro_rules! deserialize_from_text {
    ($type:ty) => {
        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
                String::deserialize(d)?.parse().map_err(D::Error::custom)
            }
        }
    };
}

deserialize_from_text!(LoadSetting);
deserialize_from_text!(CombinationSetting);
