//! The solid circle as the section of a beam.

use std::f64::consts::PI;

/// A solid circular section; its figures follow from its diameter.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Section {
    /// Diameter, mm.
    pub diameter: f64,
}

impl Section {
    /// Area πd²/4, mm².
    pub fn area(self) -> f64 {
        PI * self.diameter.powi(2) / 4.0
    }

    /// Second moment of area about any diameter, πd⁴/64, mm⁴.
    pub fn inertia(self) -> f64 {
        PI * self.diameter.powi(4) / 64.0
    }

    /// Polar second moment πd⁴/32, the torsion constant of a circle, mm⁴.
    pub fn polar(self) -> f64 {
        2.0 * self.inertia()
    }

    /// Section modulus πd³/32, mm³; that of torsion is twice as large.
    pub fn modulus(self) -> f64 {
        PI * self.diameter.powi(3) / 32.0
    }

    /// Shear area κA with κ = 6(1 + ν)/(7 + 6ν) (Cowper 1966, solid circle), mm².
    pub fn shear_area(self, poisson: f64) -> f64 {
        self.area() * 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson)
    }
}
