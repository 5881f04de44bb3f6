use super::*;
use crate::ids::Id;
use proptest::prelude::*;

fn stock(lengths: &[f64], kerf: f64) -> Stock {
    Stock { lengths: lengths.to_vec(), kerf }
}

fn sticks(lengths: &[f64]) -> IdVec<RodId, Stick> {
    lengths.iter().map(|&length| Stick { length, diameters: [3.0; 2] }).collect()
}

fn planned(lengths: &[f64], stock: &Stock) -> CutPlan {
    plan(&sticks(lengths), stock).expect("all fit")
}

/// What to buy, without diameters.
fn bought(plan: &CutPlan) -> Vec<(f64, usize)> {
    plan.shopping().iter().map(|p| (p.length, p.count)).collect()
}

#[test]
fn a_saw_cut_lies_between_pieces_only() {
    // Two pieces and one cut fill the bar exactly; with a wider cut they do not fit.
    let full = planned(&[499.5, 499.5], &stock(&[1000.0], 1.0));
    assert_eq!((full.bars.len(), full.cuts(), full.bars[0].left), (1, 1, 0.0));
    assert_eq!(full.bars[0].pieces[1].stop, 1000.0);
    let wide = planned(&[499.5, 499.5], &stock(&[1000.0], 1.1));
    assert_eq!((wide.bars.len(), wide.cuts()), (2, 2));
    assert!((wide.bars[0].left - 499.4).abs() < 1e-9);
}

#[test]
fn stops_count_the_cuts_before_them() {
    let p = planned(&[300.0, 200.0, 100.0], &stock(&[1000.0], 2.0));
    let stops: Vec<f64> = p.bars[0].pieces.iter().map(|p| p.stop).collect();
    assert_eq!(stops, [300.0, 502.0, 604.0]);
    assert_eq!(p.bars[0].left, 1000.0 - 604.0 - 2.0);
    assert!((p.waste() - 0.4).abs() < 1e-12);
}

#[test]
fn equal_rods_fill_bars_as_often_as_they_go() {
    for (length, kerf) in [(120.0, 0.0), (120.0, 1.0), (333.0, 0.5), (99.0, 1.0)] {
        let per_bar = ((1000.0 + kerf) / (length + kerf)) as usize;
        for n in 1..40 {
            let p = planned(&vec![length; n], &stock(&[1000.0], kerf));
            assert_eq!(p.bars.len(), n.div_ceil(per_bar), "{n} × {length}");
            assert!(p.groups().len() <= 2);
        }
    }
}

#[test]
fn long_rods_need_a_bar_each_and_that_is_proven() {
    // The plain bound says 4: Σ = 3606 of 1001.
    let p = planned(&[600.0; 6], &stock(&[1000.0], 1.0));
    assert_eq!((p.bars.len(), p.bound), (6, 6));
    assert!(p.is_proven());
}

#[test]
fn bars_become_the_shortest_stock_that_holds_them() {
    let p = planned(&[900.0, 400.0], &stock(&[1000.0, 500.0, 2000.0], 1.0));
    assert_eq!(bought(&p), [(1000.0, 1), (500.0, 1)]);
    let p = planned(&[400.0], &stock(&[1000.0, 400.0], 1.0));
    assert_eq!((bought(&p), p.cuts()), (vec![(400.0, 1)], 0));
}

#[test]
fn alike_bars_are_folded() {
    let p = planned(&[450.0, 450.0, 450.0, 450.0, 450.0], &stock(&[1000.0], 1.0));
    let counts: Vec<usize> = p.groups().iter().map(|g| g.bars.len()).collect();
    assert_eq!(counts, [2, 1]);
}

#[test]
fn rods_that_do_not_fit_are_named() {
    let e = plan(&sticks(&[100.0, 1200.0, 1300.5, 90.0]), &stock(&[500.0, 1000.0], 1.0))
        .expect_err("two are too long");
    let text = e.to_string();
    assert!(text.contains("R002, R003 are longer") && text.contains("1300.5 mm"), "{text}");
    assert!(e.hint().contains("1300.5 mm"));
    assert_eq!(plan(&IdVec::new(), &stock(&[], 1.0)), Err(CutError::NoStock));
    assert_eq!(plan(&IdVec::new(), &stock(&[-1.0], 1.0)), Err(CutError::StockLength(-1.0)));
    assert_eq!(plan(&IdVec::new(), &stock(&[10.0], -1.0)), Err(CutError::Kerf(-1.0)));
}

#[test]
fn no_rods_need_no_bars() {
    let p = planned(&[], &stock(&[1000.0], 1.0));
    assert_eq!((p.bars.len(), p.bound, p.waste()), (0, 0, 0.0));
}

/// The least number of bars, by trying every way.
fn least(lengths: &[f64], room: f64, kerf: f64) -> usize {
    fn go(rest: &[f64], bars: &mut Vec<f64>, room: f64, best: &mut usize) {
        if bars.len() >= *best {
            return;
        }
        let Some((&size, rest)) = rest.split_first() else {
            *best = bars.len();
            return;
        };
        for i in 0..bars.len() {
            if bars[i] + size <= room + 1e-6 {
                bars[i] += size;
                go(rest, bars, room, best);
                bars[i] -= size;
            }
        }
        bars.push(size);
        go(rest, bars, room, best);
        bars.pop();
    }
    let sizes: Vec<f64> = lengths.iter().map(|l| l + kerf).collect();
    let mut best = lengths.len() + 1;
    go(&sizes, &mut Vec::new(), room + kerf, &mut best);
    best
}

proptest! {
    #[test]
    fn plans_hold_every_rod_once_and_no_bar_is_over_full(
        halves in proptest::collection::vec(1u32..=600, 1..60),
        kerf in 0.0..4.0f64,
        longest in 300.0..900.0f64,
        others in proptest::collection::vec(50.0..900.0f64, 0..3),
    ) {
        let lengths: Vec<f64> = halves.iter().map(|&h| f64::from(h) * 0.5).collect();
        let sticks = sticks(&lengths);
        let offers: Vec<f64> = others.into_iter().chain([longest]).collect();
        let p = plan(&sticks, &stock(&offers, kerf)).expect("all fit");
        let mut rods: Vec<RodId> = Vec::new();
        for bar in &p.bars {
            let n = bar.pieces.len() as f64;
            let used: f64 = bar.pieces.iter().map(|p| p.length).sum::<f64>() + kerf * (n - 1.0);
            prop_assert!(used <= bar.stock_length + 1e-6);
            prop_assert!(offers.contains(&bar.stock_length));
            prop_assert!(bar.left >= 0.0 && bar.left + used <= bar.stock_length + 1e-6);
            rods.extend(bar.pieces.iter().map(|p| p.rod));
        }
        rods.sort();
        prop_assert!(rods.into_iter().eq(sticks.ids()));
        prop_assert!(p.bars.len() >= p.bound);
        let room = offers.iter().copied().fold(0.0, f64::max) + kerf;
        let plain = (lengths.iter().map(|l| l + kerf).sum::<f64>() / room - 1e-6).ceil();
        prop_assert!(p.bound as f64 >= plain);
        prop_assert_eq!(p.groups().iter().map(|g| g.bars.len()).sum::<usize>(), p.bars.len());
        prop_assert_eq!(plan(&sticks, &stock(&offers, kerf)).expect("as before"), p);
    }

    /// Each diameter is planned as if it were alone.
    #[test]
    fn no_bar_holds_rods_of_two_diameters(
        pieces in proptest::collection::vec((1u32..=600, 0..3usize), 1..40),
        kerf in 0.0..4.0f64,
    ) {
        let kinds = [[5.0, 5.0], [3.0, 3.0], [6.0, 4.0]];
        let all: IdVec<RodId, Stick> = pieces
            .iter()
            .map(|&(h, kind)| Stick { length: f64::from(h) * 0.5, diameters: kinds[kind] })
            .collect();
        let stock = stock(&[300.0, 500.0], kerf);
        let p = plan(&all, &stock).expect("all fit");
        for piece in p.bars.iter().flat_map(|bar| bar.pieces.iter().map(move |q| (bar, q))) {
            prop_assert_eq!(piece.0.diameters, all[piece.1.rod].diameters);
        }
        prop_assert_eq!(p.pieces(), all.len());
        let (mut bars, mut bound) = (0, 0);
        for kind in kinds {
            let alone: IdVec<RodId, Stick> =
                all.iter().copied().filter(|s| s.diameters == kind).collect();
            let alone = plan(&alone, &stock).expect("all fit");
            let buy = p.shopping();
            let mine: Vec<Purchase> = buy.into_iter().filter(|b| b.diameters == kind).collect();
            prop_assert_eq!(alone.shopping(), mine);
            bars += alone.bars.len();
            bound += alone.bound;
        }
        prop_assert_eq!((p.bars.len(), p.bound), (bars, bound));
        let order: Vec<f64> = p.bars.iter().map(|bar| bar.diameters[0]).collect();
        prop_assert!(order.is_sorted());
    }

    #[test]
    fn the_bound_is_not_above_the_least(
        lengths in proptest::collection::vec(50.0..900.0f64, 1..8),
        kerf in 0.0..4.0f64,
    ) {
        let p = planned(&lengths, &stock(&[1000.0], kerf));
        let least = least(&lengths, 1000.0, kerf);
        prop_assert!(p.bound <= least && least <= p.bars.len());
        prop_assert!(p.bars.iter().flat_map(|b| &b.pieces).all(|q| lengths[q.rod.index()] == q.length));
    }
}
