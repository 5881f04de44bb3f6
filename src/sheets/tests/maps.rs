//! The maps of the feet.

use super::*;

#[test]
fn circles_of_the_support_map_are_where_the_feet_are() {
    for frame in [&*IGLOO, &fixture::circuit(6, 5.0)] {
        let map = support_map::drawing(frame, &settings(Paper::A4, PaperUnits::Mm)).unwrap();
        let circles: Vec<[f64; 2]> = map
            .items()
            .filter_map(|i| match i {
                Item::Figure(Figure { shape: Shape::Circle { center, radius }, .. }) => {
                    (*radius == frame.diameter / 2.0).then_some(*center)
                }
                _ => None,
            })
            .collect();
        let feet = feet(frame);
        assert_eq!(circles.len(), feet.len());
        assert!(!feet.is_empty());
        for (c, foot) in circles.iter().zip(&feet) {
            assert!(map.frame().contains(*c));
            let from_first = [c[0] - circles[0][0], circles[0][1] - c[1]];
            assert!((from_first[0] - (foot.x - feet[0].x)).abs() < 1e-9);
            assert!((from_first[1] - (foot.y - feet[0].y)).abs() < 1e-9);
        }
    }
}

/// Numbers of feet lie on no chord and, on the small map, on no line between tiles.
#[test]
fn numbers_of_feet_keep_off_the_lines() {
    let station = fixture::on_sample("train-station", "3.3.3.4.4");
    for frame in [&*IGLOO, &station] {
        let settings = settings(Paper::A4, PaperUnits::Mm);
        let map = support_map::drawing(frame, &settings).unwrap();
        let overview = &support_tiles::overview(frame, &settings).unwrap()[0].drawing;
        for (drawing, names) in [(&map, "support map"), (overview, "overview")] {
            let numbers: Vec<Rect> = texts(drawing)
                .filter(|t| frame.supports.iter().any(|s| s.rod.to_string() == t.string))
                .filter(|t| t.anchor == crate::drawing::Anchor::Middle)
                .map(|t| t.extent().unwrap())
                .collect();
            assert!(numbers.len() + 2 >= frame.supports.len(), "{names}: {}", numbers.len());
            let is_chord = |item: &&Item| match item {
                Item::Figure(f) => f.paint.stroke.is_some_and(|s| s.dash == Dash::DASH_DOT),
                Item::Text(_) => false,
            };
            let chords: Vec<[[f64; 2]; 2]> = drawing
                .items()
                .filter(is_chord)
                .filter_map(|item| match item {
                    Item::Figure(Figure { shape: Shape::Line(a, b), .. }) => Some([*a, *b]),
                    _ => None,
                })
                .collect();
            assert_eq!(chords.len(), frame.supports.len(), "{names}");
            let on = |number: &&Rect| chords.iter().any(|&c| crosses(c, **number));
            assert_eq!(numbers.iter().filter(on).count(), 0, "{names}");
        }
    }
}

/// Each foot is whole on some tile, and tiles agree on where it is.
#[test]
fn every_foot_is_on_a_tile_at_full_size() {
    let settings = settings(Paper::A4, PaperUnits::Mm);
    let pages = support_map::pages(&IGLOO, &settings).unwrap();
    let tiles = pages.iter().filter(|s| {
        s.stem.contains("support-map-")
            && s.page.title.as_ref().is_some_and(|t| t.starts_with("tile "))
    });
    let whole: usize = tiles
        .map(|s| {
            let circle = |i: &&Item| matches!(i, Item::Figure(Figure { shape: Shape::Circle { radius, .. }, .. }) if *radius == 1.5);
            s.page.drawing.items().filter(circle).count()
        })
        .sum();
    assert!(whole >= IGLOO.supports.len());
}

#[test]
fn a_frame_without_feet_says_so() {
    let mut frame = fixture::circuit(5, 3.0);
    frame.supports.clear();
    let settings = settings(Paper::A4, PaperUnits::Mm);
    let pages = support_map::pages(&frame, &settings).unwrap();
    assert_eq!(pages.len(), 1);
    assert!(texts(&pages[0].page.drawing).any(|t| t.string.contains("No rod of this frame")));
    let map = support_map::drawing(&frame, &settings).unwrap();
    assert!(texts(&map).any(|t| t.string.contains("No rod of this frame")));
    assert!(map.items().all(|i| match i {
        Item::Text(t) => map.frame().contains_rect(&t.extent().unwrap()),
        Item::Figure(_) => true,
    }));
}

/// A frame whose feet are too far apart for a map at full size.
pub(super) fn huge() -> Frame {
    let mut frame = fixture::circuit(5, 3.0);
    for rod in frame.rods.ids() {
        let axis = &mut frame.rods[rod].axis;
        axis.a = (axis.a.coords * 100.0).into();
    }
    for support in &mut frame.supports {
        support.point = frame.rods[support.rod].axis.a;
    }
    frame
}

#[test]
fn a_huge_footprint_is_drawn_smaller_and_says_so() {
    let frame = huge();
    let settings = settings(Paper::A4, PaperUnits::Mm);
    let map = support_map::drawing(&frame, &settings).unwrap();
    assert!(map.width < 5000.0);
    assert!(texts(&map).any(|t| t.string.contains("scale 1:") && !t.string.contains("scale 1:1 ")));
    assert!(crate::drawing::svg::render(&map).is_ok());
    assert_eq!(support_map::pages(&frame, &settings).unwrap().len(), 1);
}

#[test]
fn a_huge_footprint_is_at_full_size_for_cad() {
    let frame = huge();
    let settings = settings(Paper::A4, PaperUnits::Mm);
    let (map, origin) = support_map::full_size(&frame, &settings).unwrap();
    assert!(map.width.max(map.height) > 5080.0, "larger than PDF allows");
    assert!(texts(&map).any(|t| t.string.contains("scale 1:1 ")));
    let circles = map.layers.iter().find(|l| l.name == "feet").unwrap();
    assert_eq!(circles.items.len(), frame.supports.len());
    for (item, foot) in circles.items.iter().zip(feet(&frame)) {
        let Item::Figure(Figure { shape: Shape::Circle { center, radius }, .. }) = item else {
            panic!("not a circle: {item:?}")
        };
        let [x, y] = [center[0] - origin[0], origin[1] - center[1]];
        assert!((x - foot.x).hypot(y - foot.y) < 1e-9 && *radius == foot.diameter / 2.0);
    }
    assert!(crate::drawing::dxf::render(&map, origin).is_ok());
}
