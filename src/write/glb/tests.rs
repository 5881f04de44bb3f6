use super::*;
use crate::shop::fixture::circuit;
use crate::shop::lengths::classes;
use gltf::Gltf;
use nalgebra::{Matrix4, Point3};

fn structure() -> Structure {
    let frame = circuit(5, 3.0);
    Structure::from_frame(&frame, &classes(&frame), &[])
}

fn node<'a>(gltf: &'a Gltf, name: &str) -> gltf::Node<'a> {
    gltf.nodes().find(|n| n.name() == Some(name)).unwrap()
}

/// Back to mm, z up.
fn back(p: Point3<f32>) -> Point3<f64> {
    let p = p.cast::<f64>() * 1000.0;
    Point3::new(p.x, -p.z, p.y)
}

#[test]
fn cylinders_lie_on_the_axes_of_their_rods() {
    let mut s = structure();
    // Straight up, straight down, and nearly so.
    s.rods[0].b = [s.rods[0].a[0], s.rods[0].a[1], 500.0];
    s.rods[1].b = [s.rods[1].a[0], s.rods[1].a[1], -500.0];
    s.rods[2].b = [s.rods[2].a[0] + 1e-4, s.rods[2].a[1], -5000.0];
    s.rods[3].diameter = Some([5.0, 5.0].into());
    let gltf = Gltf::from_slice(&glb(&s).unwrap()).unwrap();
    for rod in &s.rods {
        let n = node(&gltf, &rod.id);
        let matrix: Matrix4<f32> = n.transform().matrix().into();
        for (y, end) in [(0.0, rod.a), (1.0, rod.b)] {
            let got = back(matrix.transform_point(&Point3::new(0.0, y, 0.0)));
            assert!((got - Point3::from(end)).norm() < 1e-3, "{}: {got} {end:?}", rod.id);
            let rim = back(matrix.transform_point(&Point3::new(1.0, y, 0.0)));
            assert!(((rim - got).norm() - s.diameters(rod)[0] / 2.0).abs() < 1e-3);
        }
        assert!(matrix.determinant() > 0.0);
    }
}

#[test]
fn all_rods_share_one_cylinder() {
    let s = structure();
    let bytes = glb(&s).unwrap();
    let gltf = Gltf::from_slice(&bytes).unwrap();
    assert_eq!((gltf.accessors().count(), gltf.meshes().count()), (3, 1));
    let mut two = s.clone();
    two.rods[0].border = false;
    let gltf = Gltf::from_slice(&glb(&two).unwrap()).unwrap();
    assert_eq!((gltf.accessors().count(), gltf.meshes().count()), (3, 2));
    let material = |name: &str| {
        let mesh = node(&gltf, name).mesh().unwrap();
        mesh.primitives().next().unwrap().material().name().unwrap().to_owned()
    };
    assert_eq!((material("R001"), material("R002")), ("inner rods".into(), "border rods".into()));
}

#[test]
fn rods_that_taper_alike_share_a_cone() {
    let mut s = structure();
    s.rods[1].diameter = Some([6.0, 4.0].into());
    s.rods[2].diameter = Some([3.0, 2.0].into());
    s.rods[3].diameter = Some([4.0, 6.0].into());
    let bytes = glb(&s).unwrap();
    let gltf = Gltf::from_slice(&bytes).unwrap();
    assert_eq!((gltf.accessors().count(), gltf.meshes().count()), (9, 3));
    let buffers = [gltf.blob.clone().unwrap()];
    for rod in &s.rods {
        let n = node(&gltf, &rod.id);
        let matrix: Matrix4<f32> = n.transform().matrix().into();
        let primitive = n.mesh().unwrap().primitives().next().unwrap();
        let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
        for p in reader.read_positions().unwrap() {
            let place = back(matrix.transform_point(&p.into()));
            let [a, b] = [rod.a, rod.b].map(Point3::from);
            let along = (place - a).dot(&(b - a).normalize());
            let off = (place - a - (b - a).normalize() * along).norm();
            let [d, e] = s.diameters(rod);
            let radius = d / 2.0 + (e - d) / 2.0 * along / rod.length;
            assert!((off - radius).abs() < 1e-3, "{}: {off} {radius}", rod.id);
        }
    }
    let extras = node(&gltf, "R002").extras().clone().unwrap();
    let figures: serde_json::Value = serde_json::from_str(extras.get()).unwrap();
    assert_eq!(figures["diameter_mm"], serde_json::json!([6.0, 4.0]));
}

#[test]
fn contacts_and_supports_are_named_points() {
    let s = structure();
    let gltf = Gltf::from_slice(&glb(&s).unwrap()).unwrap();
    let at = |name: &str| back(Point3::from(node(&gltf, name).transform().decomposed().0));
    for c in &s.contacts {
        let [over, under] = [(&c.over, c.at_over), (&c.under, c.at_under)].map(|(id, at)| {
            let rod = s.rod(id).unwrap();
            crate::frame::axis::Axis { a: rod.a.into(), b: rod.b.into() }.at(at)
        });
        let got = at(&c.id);
        for p in [over, under] {
            assert!(((p - got).norm() - s.rod_diameter / 2.0).abs() < 1e-3);
        }
    }
    assert!((at("S002-R002-A") - Point3::from(s.supports[1].point)).norm() < 1e-3);
    let groups: Vec<_> =
        node(&gltf, "structure").children().map(|n| n.name().unwrap().to_owned()).collect();
    assert_eq!(groups, ["rods", "contacts", "supports"]);
    assert_eq!(node(&gltf, "contacts").children().count(), 5);
}

#[test]
fn figures_stand_in_the_extras() {
    let s = structure();
    let gltf = Gltf::from_slice(&glb(&s).unwrap()).unwrap();
    let figures = |name: &str| -> serde_json::Value {
        let extras = node(&gltf, name).extras().clone().unwrap();
        serde_json::from_str(extras.get()).unwrap()
    };
    let rod = figures("R001");
    assert_eq!(rod["length_mm"], rounded(s.rods[0].length, 6));
    assert_eq!((&rod["class"], &rod["support"]), (&"A".into(), &"A".into()));
    assert_eq!(rod["contacts"].as_array().unwrap().len(), 2);
    let contact = figures("C0001");
    assert_eq!((&contact["over"], &contact["under"]), (&"R001".into(), &"R002".into()));
    assert_eq!(figures("structure")["rods"], 5);
}

#[test]
fn the_file_is_whole_and_the_same_every_time() {
    let s = structure();
    let bytes = glb(&s).unwrap();
    assert_eq!(bytes, glb(&s).unwrap());
    assert_eq!(bytes.len() % 4, 0);
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!(u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize, bytes.len());
}
