//! The stiffness of a straight Timoshenko beam of circular section, 12 freedoms.
//!
//! Exact for loads at its ends and for an even load along it (Przemieniecki, *Theory of
//! Matrix Structural Analysis*, section 5.6, with φ = 12EI/(κGAL²)). Second-order effects
//! and buckling are left out.

use super::material::Material;
use super::section::Section;
use crate::surface::Vector3;
use nalgebra::{Matrix3, SMatrix, SVector};

/// Force or displacement of the twelve freedoms of a beam: six at each node.
pub type Twelve = SVector<f64, 12>;
/// The stiffness of a beam.
pub type Stiffness = SMatrix<f64, 12, 12>;

/// The axes of a beam as rows: along it, and two across. A circle has no preferred
/// direction across, so any will do: the one least along the beam is taken.
pub fn axes(along: &Vector3) -> Matrix3<f64> {
    let x = along.normalize();
    let least = x.iamin();
    let y = Vector3::ith(least, 1.0).cross(&x).normalize();
    let z = x.cross(&y);
    Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()])
}

/// Turns twelve global values into the beam's axes.
pub fn to_local(axes: &Matrix3<f64>, global: &Twelve) -> Twelve {
    let mut local = Twelve::zeros();
    for i in (0..12).step_by(3) {
        local.fixed_rows_mut::<3>(i).copy_from(&(axes * global.fixed_rows::<3>(i)));
    }
    local
}

/// The stiffness in the beam's own axes.
pub fn local_stiffness(length: f64, section: Section, material: &Material) -> Stiffness {
    let Material { young, shear, poisson, .. } = *material;
    let mut k = Stiffness::zeros();
    let mut pair = |i: usize, j: usize, value: f64| {
        k[(i, j)] = value;
        k[(j, i)] = value;
    };
    for (freedom, stiff) in [(0, young * section.area()), (3, shear * section.polar())] {
        pair(freedom, freedom, stiff / length);
        pair(freedom + 6, freedom + 6, stiff / length);
        pair(freedom, freedom + 6, -stiff / length);
    }
    let bending = young * section.inertia();
    let phi = 12.0 * bending / (shear * section.shear_area(poisson) * length.powi(2));
    let unit = bending / (length.powi(3) * (1.0 + phi));
    // Bending in the plane of x and y turns about z; in that of x and z about −y.
    for (shift, turn, sign) in [(1, 5, 1.0), (2, 4, -1.0)] {
        let (slope, half) = (sign * 6.0 * length * unit, length.powi(2) * unit);
        pair(shift, shift, 12.0 * unit);
        pair(shift + 6, shift + 6, 12.0 * unit);
        pair(shift, shift + 6, -12.0 * unit);
        pair(shift, turn, slope);
        pair(shift, turn + 6, slope);
        pair(shift + 6, turn, -slope);
        pair(shift + 6, turn + 6, -slope);
        pair(turn, turn, (4.0 + phi) * half);
        pair(turn + 6, turn + 6, (4.0 + phi) * half);
        pair(turn, turn + 6, (2.0 - phi) * half);
    }
    k
}

/// The stiffness in global axes.
pub fn stiffness(along: &Vector3, section: Section, material: &Material) -> Stiffness {
    let local = local_stiffness(along.norm(), section, material);
    let axes = axes(along);
    let mut global = Stiffness::zeros();
    for i in (0..12).step_by(3) {
        for j in (0..12).step_by(3) {
            let block = axes.transpose() * local.fixed_view::<3, 3>(i, j) * axes;
            global.fixed_view_mut::<3, 3>(i, j).copy_from(&block);
        }
    }
    global
}

/// What an even load `q` (N/mm, global) puts on the nodes of a beam: half of it on each,
/// and moments of ±qL²/12 across. Shear does not change them: the load is symmetric.
pub fn even_load(along: &Vector3, q: &Vector3) -> Twelve {
    let half = q * (along.norm() / 2.0);
    let moment = along.cross(q) * (along.norm() / 12.0);
    let mut load = Twelve::zeros();
    for (i, part) in [half, moment, half, -moment].iter().enumerate() {
        load.fixed_rows_mut::<3>(3 * i).copy_from(part);
    }
    load
}
