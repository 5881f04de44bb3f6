//! Closing on frames from files: time, steps, error of the worst contact, and the shape of
//! the units before and after: `cargo bench --bench close -- FOLDER [least|shape|paper]`.
//!
//! Every file of the folder is a JSON object
//! `{w, rods: [[Ax, Ay, Az, Bx, By, Bz]], contacts: [[i, j, sign]], units: [{ends: [[rod,
//! 0 or 1]], g}]}`. The gap of a contact is (A_i − A_j)·n, with n the unit vector along
//! (B_i − A_i) × (B_j − A_j), and is to become sign·w. The rods of a unit are named in
//! order, and g is where its middle belongs.
//!
//! The last column names what a sparse direct projection (CHOLMOD on J Jᵀ, own C++) and a
//! general solver (Ceres, until exact) were seen to take on frames of that many rods, on
//! a machine of two slow cores.

mod measure;

use measure::{forget_peak, least, ms, peak_memory};
use rodwright::chart::SurfacePoint;
use rodwright::frame::ContactKind;
use rodwright::frame::axis::Axis;
use rodwright::frame::close::bounds::Limits;
use rodwright::frame::close::marks::Marks;
use rodwright::frame::close::shape::Circuit;
use rodwright::frame::close::{Closing, Task, Way, close, project};
use rodwright::frame::gaps::Joint;
use rodwright::ids::{ContactId, Id, IdVec, RodId};
use rodwright::surface::Vector3;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;
use std::time::Duration;

#[derive(Deserialize)]
struct File {
    w: f64,
    rods: Vec<[f64; 6]>,
    contacts: Vec<(usize, usize, f64)>,
    units: Vec<FileUnit>,
}

#[derive(Deserialize)]
struct FileUnit {
    ends: Vec<(usize, usize)>,
    g: [f64; 3],
}

/// Time to spend on one row, and the most runs of it.
const BUDGET: Duration = Duration::from_secs(10);
const RUNS: usize = 15;

fn main() {
    let mut words = std::env::args().skip(1).filter(|a| !a.starts_with("--"));
    let Some(folder) = words.next() else {
        println!("name a folder of problems: cargo bench --bench close -- FOLDER");
        return;
    };
    let only = words.next();
    println!(
        "{:<10} {:>6} {:<7} {:>10} {:>7} {:>7} {:>6} {:>9} {:>6} {:>22} {:>22} {:>22}  others, ms",
        "problem",
        "rods",
        "way",
        "ms",
        "peak MB",
        "shaping",
        "exact",
        "error / w",
        "bounds",
        "F2",
        "F3",
        "F4"
    );
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .expect("the folder can be read")
        .map(|entry| entry.expect("the folder can be read").path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort_by_key(|path| path.metadata().map_or(0, |m| m.len()));
    files.iter().for_each(|file| problem(file, only.as_deref()));
}

fn problem(path: &Path, only: Option<&str>) {
    let text = std::fs::read_to_string(path).expect("the file can be read");
    let file: File = serde_json::from_str(&text).expect("a problem");
    let axes: IdVec<RodId, Axis> = file
        .rods
        .iter()
        .map(|r| Axis { a: [r[0], r[1], r[2]].into(), b: [r[3], r[4], r[5]].into() })
        .collect();
    let joints: IdVec<ContactId, Joint> =
        file.contacts.iter().map(|c| joint(&axes, c, file.w)).collect();
    let circuits = circuits(&file, &joints);
    let edge = axes.iter().map(Axis::length).sum::<f64>() / axes.len() as f64 / ROD_LENGTH;
    let limits = limits(&axes, &joints, file.w);
    let task = Task {
        joints: &joints,
        circuits: &circuits,
        limits: None,
        marks: Marks::default(),
        roam: None,
        edge,
    };
    let bounded = Task { limits: Some(&limits), ..task };
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    for (way, task) in [(Way::Least, &task), (Way::Shape, &bounded), (Way::Paper, &task)] {
        if only.is_some_and(|only| only != word(way)) {
            continue;
        }
        forget_peak();
        let (time, closing) = match way {
            // Without the shape of units, which nothing looks at.
            Way::Least => least(RUNS, BUDGET, || project(&mut axes.clone(), &joints)),
            _ => least(RUNS, BUDGET, || close(&mut axes.clone(), task, way)),
        };
        let mut made = closing.expect("the problem closes");
        if way == Way::Least {
            made.energy = close(&mut axes.clone(), task, way).expect("the problem closes").energy;
        }
        row(&name, axes.len(), way, time, &made);
    }
}

/// What others take for frames of so many rods, ms.
fn others(rods: usize) -> &'static str {
    match rods {
        516 => "CHOLMOD 3.4, Ceres 400",
        632 => "CHOLMOD 4.1, Ceres 450",
        6728 => "CHOLMOD 130, Ceres 11400",
        65060 => "CHOLMOD 1600, Ceres 1233000",
        _ => "",
    }
}

fn word(way: Way) -> &'static str {
    match way {
        Way::Shape => "shape",
        Way::Least => "least",
        Way::Paper => "paper",
    }
}

/// Length of a rod from contact to contact, in tile edges, in a pattern of squares turned
/// by 20°: cos 20° + sin 20°.
const ROD_LENGTH: f64 = 1.28;

fn row(name: &str, rods: usize, way: Way, time: Duration, made: &Closing) {
    let [from, to] = made.energy;
    let change = |a: f64, b: f64| format!("{a:.3e} -> {b:.3e}");
    println!(
        "{name:<10} {rods:>6} {:<7} {:>10.2} {:>7.0} {:>7} {:>6} {:>9.1e} {:>6} {:>22} {:>22} \
         {:>22}  {}",
        word(way),
        ms(time),
        peak_memory(),
        made.shaping,
        made.steps,
        made.error,
        made.held,
        change(from.places, to.places),
        change(from.angles, to.angles),
        change(from.sides, to.sides),
        others(rods),
    );
}

fn joint(axes: &IdVec<RodId, Axis>, &(i, j, sign): &(usize, usize, f64), w: f64) -> Joint {
    let (over, under) = (RodId::new(i), RodId::new(j));
    let along = |r: RodId| axes[r].b - axes[r].a;
    let outward = along(over).cross(&along(under)) * sign;
    Joint { over, under, outward, diameter: w, kind: ContactKind::Cross }
}

/// The units: corner i is the contact between rods i and i + 1; all are to be regular.
fn circuits(file: &File, joints: &IdVec<ContactId, Joint>) -> Vec<Circuit> {
    let of: BTreeMap<[RodId; 2], ContactId> = joints
        .enumerate()
        .map(|(id, j)| ([j.over.min(j.under), j.over.max(j.under)], id))
        .collect();
    let circuit = |unit: &FileUnit| {
        let n = unit.ends.len();
        let rod = |i: usize| RodId::new(unit.ends[i % n].0);
        let pair = |i: usize| [rod(i).min(rod(i + 1)), rod(i).max(rod(i + 1))];
        let contacts: Vec<ContactId> = (0..n).map(|i| of[&pair(i)]).collect();
        let cosine = -(TAU / n as f64).cos();
        let normal = contacts.iter().map(|&c| joints[c].outward.normalize()).sum::<Vector3>();
        let place = SurfacePoint { position: unit.g.into(), normal: normal.normalize() };
        Circuit { contacts, place, cosines: vec![cosine; n], sides: vec![1.0; n] }
    };
    file.units.iter().map(circuit).collect()
}

/// Bounds as for a frame with overhangs of two diameters.
fn limits(axes: &IdVec<RodId, Axis>, joints: &IdVec<ContactId, Joint>, w: f64) -> Limits {
    let mut along: IdVec<RodId, Vec<(f64, ContactId)>> = vec![Vec::new(); axes.len()].into();
    for (id, j) in joints.enumerate() {
        let x = axes[j.over].cross(&axes[j.under], &j.outward).expect("not parallel");
        along[j.over].push((x.at_first, id));
        along[j.under].push((x.at_second, id));
    }
    along.iter_mut().for_each(|seats| seats.sort_by(|p, q| p.0.total_cmp(&q.0)));
    Limits {
        along: along.iter().map(|seats| seats.iter().map(|s| s.1).collect()).collect(),
        room: along.iter().map(|seats| vec![w; seats.len()]).collect(),
        beyond: vec![[2.0 * w; 2]; axes.len()].into(),
        thickness: vec![w; axes.len()].into(),
        diameter: w,
    }
}
