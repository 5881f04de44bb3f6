use super::*;
use proptest::prelude::*;

fn lengths(rods: &[f64], how: Share) -> Vec<f64> {
    let rods: Vec<(f64, bool)> = rods.iter().map(|&l| (l, true)).collect();
    shared_lengths(&rods, how).expect("sharing is on")
}

#[test]
fn rods_share_the_length_of_the_longest_among_them() {
    let rods = [50.0, 40.0, 49.0, 41.5, 40.0];
    assert_eq!(lengths(&rods, Share::Classes(2)), [50.0, 41.5, 50.0, 41.5, 41.5]);
    assert_eq!(lengths(&rods, Share::Classes(3)), [50.0, 40.0, 50.0, 41.5, 40.0]);
    assert_eq!(lengths(&rods, Share::Classes(9)), rods);
    assert_eq!(lengths(&rods, Share::Tolerance(1.0)), [50.0, 40.0, 50.0, 41.5, 40.0]);
    assert_eq!(lengths(&rods, Share::Tolerance(1.5)), [50.0, 41.5, 50.0, 41.5, 41.5]);
    assert_eq!(lengths(&rods, Share::Tolerance(0.0)), rods);
    assert_eq!(shared_lengths(&[(50.0, true)], Share::Off), None);
    assert_eq!(lengths(&[], Share::Classes(2)), Vec::<f64>::new());
    assert_eq!(lengths(&[], Share::Tolerance(2.0)), Vec::<f64>::new());
}

#[test]
fn a_rod_that_cannot_grow_keeps_its_length_and_others_may_share_it() {
    let rods = [(40.0, true), (41.0, false), (42.0, true), (43.0, true)];
    let shared = |how| shared_lengths(&rods, how).expect("sharing is on");
    assert_eq!(shared(Share::Classes(1)), [41.0, 41.0, 43.0, 43.0], "one more than asked for");
    assert_eq!(shared(Share::Tolerance(9.0)), [41.0, 41.0, 43.0, 43.0]);
}

/// Every way to part steps into neighbours: by a bit after each step but the last.
fn best_of_all(rods: &[(f64, bool)], how: Share) -> (usize, f64) {
    let all = distinct(rods.iter().map(|r| r.0).collect());
    let ways = (0..1_u32 << (all.len() - 1)).map(|cuts| {
        let up = |l: f64| {
            let at = all.iter().position(|&x| x >= l).expect("it is one of them");
            let end = (at..all.len() - 1).find(|i| cuts >> i & 1 == 1).unwrap_or(all.len() - 1);
            all[end]
        };
        (cuts.count_ones() as usize + 1, rods.iter().map(|r| (up(r.0) - r.0, r.1)).collect())
    });
    let fine = ways.filter(|(_, growth): &(usize, Vec<(f64, bool)>)| {
        growth.iter().all(|&(extra, grows)| {
            let most = if let Share::Tolerance(t) = how { t } else { f64::INFINITY };
            extra == 0.0 || (grows && extra <= most)
        })
    });
    let ways = fine.map(|(n, growth)| (n, growth.iter().map(|g| g.0).sum::<f64>()));
    let least = |ways: &mut dyn Iterator<Item = (usize, f64)>| {
        ways.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
    };
    let ways: Vec<(usize, f64)> = ways.collect();
    let fewest = ways.iter().map(|w| w.0).min().expect("each its own is fine");
    let wanted = match how {
        Share::Classes(n) => n.max(fewest).min(all.len()),
        _ => fewest,
    };
    least(&mut ways.into_iter().filter(|w| w.0 == wanted)).expect("there is a way")
}

proptest! {
    #[test]
    fn no_other_way_to_share_needs_less(
        rods in proptest::collection::vec(
            ((80u32..120).prop_map(|h| f64::from(h) * 0.5), proptest::bool::weighted(0.9)), 1..12,
        ),
        how in prop_oneof![
            (1usize..6).prop_map(Share::Classes),
            (0u32..12).prop_map(|h| Share::Tolerance(f64::from(h) * 0.5)),
        ],
    ) {
        let made = shared_lengths(&rods, how).expect("sharing is on");
        for (&new, &(old, grows)) in made.iter().zip(&rods) {
            prop_assert!(new == old || (grows && new > old));
            if let Share::Tolerance(t) = how {
                prop_assert!(new <= old + t);
            }
        }
        let extra: f64 = made.iter().zip(&rods).map(|(new, old)| new - old.0).sum();
        let (classes, least) = best_of_all(&rods, how);
        prop_assert_eq!(distinct(made).len(), classes);
        prop_assert!((extra - least).abs() < 1e-9, "{} for {}", extra, least);
    }
}
