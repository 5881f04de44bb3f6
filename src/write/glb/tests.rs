use super::*;
use crate::drawing::Color;
use crate::shop::fixture::circuit;
use crate::shop::lengths::classes;
use gltf::Gltf;
use nalgebra::{Matrix4, Point3};

fn structure() -> Structure {
    let frame = circuit(5, 3.0);
    Structure::from_frame(&frame, &classes(&frame), &[])
}

/// One whose rods rise enough to be cut level at their feet.
fn standing() -> Structure {
    let frame = circuit(5, 8.0);
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
    let gltf = Gltf::from_slice(&glb(&s, None).unwrap()).unwrap();
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

/// Accessors, meshes and materials.
fn counts(gltf: &Gltf) -> [usize; 3] {
    [gltf.accessors().count(), gltf.meshes().count(), gltf.materials().count()]
}

#[test]
fn rods_that_are_cut_alike_share_a_shape() {
    let mut s = standing();
    let gltf = |s: &Structure| Gltf::from_slice(&glb(s, None).unwrap()).unwrap();
    assert_eq!(counts(&gltf(&s)), [3, 1, 1], "a regular circuit");
    s.supports.remove(0);
    assert_eq!(counts(&gltf(&s)), [5, 2, 1], "one stands no more");
    s.supports.clear();
    assert_eq!(counts(&gltf(&s)), [3, 1, 1]);
}

#[test]
fn the_material_tells_how_a_rod_ends() {
    let mut s = structure();
    s.supports.clear();
    let material = |s: &Structure, name: &str| {
        let gltf = Gltf::from_slice(&glb(s, None).unwrap()).unwrap();
        let mesh = node(&gltf, name).mesh().unwrap();
        let material = mesh.primitives().next().unwrap().material();
        material.name().unwrap().to_owned()
    };
    assert_eq!(material(&s, "R001"), "border rods");
    s.rods.iter_mut().for_each(|rod| rod.border = false);
    assert_eq!(material(&s, "R001"), "rods that end over and under");
    let swap = |c: &mut ContactEntry| {
        std::mem::swap(&mut c.over, &mut c.under);
        std::mem::swap(&mut c.at_over, &mut c.at_under);
    };
    let [first, last] = [0.0, f64::MAX].map(|from| {
        let of =
            s.contacts.iter().enumerate().filter(|(_, c)| c.over == "R001" || c.under == "R001");
        let at = |c: &ContactEntry| if c.over == "R001" { c.at_over } else { c.at_under };
        let near = |c: &ContactEntry| (at(c) - from).abs();
        of.min_by(|(_, a), (_, b)| near(a).total_cmp(&near(b))).unwrap().0
    });
    assert_ne!(first, last);
    let mut over = s.clone();
    for i in [first, last] {
        if over.contacts[i].under == "R001" {
            swap(&mut over.contacts[i]);
        }
    }
    assert_eq!(material(&over, "R001"), "rods that end over");
    [first, last].iter().for_each(|&i| swap(&mut over.contacts[i]));
    assert_eq!(material(&over, "R001"), "rods that end under");
}

#[test]
fn rods_are_round_and_taper_and_stand_level_on_the_ground() {
    let mut s = standing();
    s.rods[1].diameter = Some([6.0, 4.0].into());
    s.rods[2].diameter = Some([3.0, 2.0].into());
    s.rods[3].diameter = Some([4.0, 6.0].into());
    s.supports.remove(4);
    let gltf = Gltf::from_slice(&glb(&s, None).unwrap()).unwrap();
    let buffers = [gltf.blob.clone().unwrap()];
    for rod in &s.rods {
        let n = node(&gltf, &rod.id);
        let matrix: Matrix4<f32> = n.transform().matrix().into();
        let primitive = n.mesh().unwrap().primitives().next().unwrap();
        let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
        let (mut low, mut level) = (f64::MAX, 0);
        for p in reader.read_positions().unwrap() {
            let place = back(matrix.transform_point(&p.into()));
            let [a, b] = [rod.a, rod.b].map(Point3::from);
            let along = (place - a).dot(&(b - a).normalize());
            let off = (place - a - (b - a).normalize() * along).norm();
            let [d, e] = s.diameters(rod);
            let radius = d / 2.0 + (e - d) / 2.0 * along / rod.length;
            assert!((off - radius).abs() < 1e-3, "{}: {off} {radius}", rod.id);
            low = low.min(place.z);
            level += usize::from((place.z - s.ground).abs() < 1e-3);
        }
        let stands = s.supports.iter().any(|support| support.rod == rod.id);
        // Every corner is there twice, for the side and for the end. Of a square end, two are as
        // high as its middle.
        assert_eq!(level, if stands { 48 } else { 4 }, "{}", rod.id);
        assert_eq!(low >= s.ground - 1e-3, stands, "a square end reaches below: {low}");
    }
    let extras = node(&gltf, "R002").extras().clone().unwrap();
    let figures: serde_json::Value = serde_json::from_str(extras.get()).unwrap();
    assert_eq!(figures["diameter_mm"], serde_json::json!([6.0, 4.0]));
}

#[test]
fn the_text_form_holds_the_same() {
    let s = structure();
    let binary = Gltf::from_slice(&glb(&s, None).unwrap()).unwrap();
    let text = Gltf::from_slice(gltf(&s).unwrap().as_bytes()).unwrap();
    let names = |g: &Gltf| g.nodes().map(|n| n.name().unwrap().to_owned()).collect::<Vec<_>>();
    assert_eq!(names(&binary), names(&text));
    let length = binary.blob.unwrap().len();
    let buffer = text.buffers().next().unwrap();
    let gltf::buffer::Source::Uri(uri) = buffer.source() else { panic!("an address") };
    assert!(uri.starts_with("data:") && buffer.length() <= length);
}

#[test]
fn contacts_and_supports_are_named_points() {
    let s = structure();
    let gltf = Gltf::from_slice(&glb(&s, None).unwrap()).unwrap();
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
    let gltf = Gltf::from_slice(&glb(&s, None).unwrap()).unwrap();
    let figures = |name: &str| -> serde_json::Value {
        let extras = node(&gltf, name).extras().clone().unwrap();
        serde_json::from_str(extras.get()).unwrap()
    };
    let rod = figures("R001");
    assert_eq!(rod["length_mm"], rounded(s.rods[0].length, 6));
    assert_eq!((&rod["class"], &rod["support"]), (&"A".into(), &"A".into()));
    assert_eq!(rod["contacts"].as_array().unwrap().len(), 2);
    let mark = &rod["marks"][0];
    let contact = s.contact(mark["contact"].as_str().unwrap()).unwrap();
    assert_eq!((&mark["side"], &mark["partner"]), (&"under".into(), &contact.over.as_str().into()));
    assert_eq!(mark["at_mm"], rounded(contact.at_under, 6));
    let support = figures("S001-R001-A");
    let sum = |a: &str, b: &str| support[a].as_f64().unwrap() + support[b].as_f64().unwrap();
    assert!((sum("elevation_deg", "bevel_deg") - 90.0).abs() < 1e-5);
    let contact = figures("C0001");
    assert_eq!((&contact["over"], &contact["under"]), (&"R001".into(), &"R002".into()));
    assert_eq!(figures("structure")["rods"], 5);
}

#[test]
fn the_file_is_whole_and_the_same_every_time() {
    let s = structure();
    let bytes = glb(&s, None).unwrap();
    assert_eq!(bytes, glb(&s, None).unwrap());
    assert_eq!(bytes.len() % 4, 0);
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!(u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize, bytes.len());
}

#[test]
fn a_studied_frame_has_the_colours_of_its_stresses() {
    let (frame, study) = crate::statics::fixture::studied(5, 2.0);
    let s = Structure::from_frame(&frame, &classes(&frame), &[]);
    let gltf = Gltf::from_slice(&glb(&s, Some(&study)).unwrap()).unwrap();
    let worst = study.worst();
    let largest = worst.iter().map(|w| w.value).fold(0.0, f64::max);
    let read = |extras: &gltf_json::Extras| -> serde_json::Value {
        serde_json::from_str(extras.as_ref().unwrap().get()).unwrap()
    };
    for (rod, worst) in s.rods.iter().zip(&worst) {
        let node = node(&gltf, &rod.id);
        let figures = read(node.extras());
        assert_eq!(figures["utilisation"], rounded(worst.value, 6));
        assert_eq!(figures["stress_at_mm"], rounded(worst.at / 2.0, 6));
        let mesh = node.mesh().unwrap();
        assert_eq!(mesh.name(), Some("border rods"));
        let material = mesh.primitives().next().unwrap().material();
        let [r, g, ..] = material.pbr_metallic_roughness().base_color_factor();
        let share = worst.value / largest;
        // Green falls all along the scale; within half a step of 32.
        let at = |share: f64| Color::linear_part(crate::drawing::scale_color(share).g) as f32;
        assert!(g <= at(share - 0.016) + 1e-3 && g >= at(share + 0.016) - 1e-3, "{share}");
        assert!(r > g);
    }
    let scene = read(gltf.default_scene().unwrap().extras());
    assert_eq!(scene["statics"]["most"]["utilisation"], rounded(largest, 6));
    assert_eq!(scene["statics"]["most"]["color"], "#993404");
    assert_eq!(
        (&scene["statics"]["material"], &scene["statics"]["scale"]),
        (&"pine".into(), &2.0.into())
    );
}
