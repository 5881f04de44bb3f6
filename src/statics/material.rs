//! What rods are made of. Forces in N, lengths in mm, stresses in MPa, densities in kg/m³.

use crate::units::GRAVITY;

/// A straight-grained or even material of a rod: elastic, the same along its whole length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Material {
    /// Young's modulus along the rod, MPa.
    pub young: f64,
    /// Shear modulus, MPa. In wood it is no function of E and ν.
    pub shear: f64,
    /// Poisson's ratio, for the shear area only.
    pub poisson: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Bending strength, MPa.
    pub strength: f64,
}

impl Default for Material {
    /// Pine.
    fn default() -> Self {
        TABLE[0].1
    }
}

impl Material {
    /// Weight of a volume, N/mm³.
    pub fn weight(&self) -> f64 {
        self.density * GRAVITY * 1e-9
    }

    /// One of the table by its name.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().find(|(known, _)| *known == name).map(|(_, material)| *material)
    }
}

/// Materials by name. Strengths are those that the source gives, without safety factors.
///
/// - `pine`: softwood of class C24, EN 338: mean E, G and density, characteristic bending
///   strength.
/// - `bamboo`: culms of *Bambusa blumeana*, tested after ISO 22157 (Salzer, Wallbaum, Alipon,
///   Lopez, *BioResources* 13(1), 2018): mean E and characteristic bending strength, which is
///   also that which ISO 22156 starts from. G by G/E = 0.07 and the density are usual ones.
///   Culms are hollow, and rods here are solid.
/// - `birch`: dowels of clear yellow birch at 12 % moisture, *Wood Handbook* (FPL-GTR-282),
///   chapter 5: mean E, modulus of rupture, G by G/E = 0.07, density by the specific gravity of
///   0.62 and the moisture.
/// - `paper`: the wood of the paper that this program follows, its E and density; ν, which
///   it does not give, is 0.3, and G = E / 2(1 + ν); strength as of pine.
/// - `steel`: S235, EN 1993-1-1: E, G, ν and yield stress.
pub const TABLE: [(&str, Material); 5] = [
    ("pine", wood(11_000.0, 690.0, 420.0, 24.0)),
    ("bamboo", wood(13_100.0, 920.0, 700.0, 34.6)),
    ("birch", wood(13_900.0, 970.0, 694.0, 114.0)),
    ("paper", wood(11_000.0, 11_000.0 / 2.6, 800.0, 24.0)),
    (
        "steel",
        Material { young: 210e3, shear: 81e3, poisson: 0.3, density: 7850.0, strength: 235.0 },
    ),
];

const fn wood(young: f64, shear: f64, density: f64, strength: f64) -> Material {
    Material { young, shear, poisson: 0.3, density, strength }
}
