use super::*;
use proptest::prelude::*;

fn stock(lengths: &[f64], kerf: f64) -> Stock {
    Stock::plain(lengths, kerf)
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

/// 40 rods of 60 to 200 mm, from 300 mm sticks: a linear congruential generator's.
fn forty(mut state: u64) -> Vec<f64> {
    let next = |_| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((state >> 40) as u32 % 280 + 120) * 0.5
    };
    (0..40).map(next).collect()
}

#[test]
fn forty_rods_from_300_mm_sticks_need_column_generation() {
    let (sticks, stock) = (sticks(&forty(5)), stock(&[300.0], 1.0));
    let pieces: Vec<_> = sticks.enumerate().map(|(r, s)| (r, *s)).collect();
    let task = Batch::new(&pieces, &stock, Aim::Bars).task;
    let full = filled(&task, &Cells::new(&task).safe, &mut Work::default());
    assert_eq!(full.map(|loads| loads.len()), Some(18), "nor is filling bars enough");
    let quick = plan_by(&sticks, &stock, Effort::BestFit).expect("all fit");
    let p = plan(&sticks, &stock).expect("all fit");
    assert_eq!((quick.bars.len(), p.bars.len(), p.bound), (18, 17, 17));
    assert!(p.is_proven() && !quick.is_proven());
}

/// Bars of a length at a price.
fn priced(length: f64, price: f64, count: Option<usize>) -> Offer {
    Offer { price: Some(price), count, ..Offer::plain(length) }
}

#[test]
fn prices_decide_which_bars_are_bought() {
    // Two pieces a short bar, or five a long one.
    let bars = |price| vec![priced(1000.0, 1.0, None), priced(2500.0, price, None)];
    let made = |price, n| {
        let stock = Stock { bars: bars(price), ..Stock::default() };
        planned(&vec![500.0; n], &stock)
    };
    let dear = made(2.6, 5);
    assert_eq!((bought(&dear), dear.cost()), (vec![(2500.0, 1)], Some(2.6)));
    let cheap = made(3.1, 5);
    assert_eq!((bought(&cheap), cheap.cost()), (vec![(1000.0, 3)], Some(3.0)));
    assert!(dear.is_proven() && cheap.is_proven());
    assert_eq!((dear.aim, dear.spent, dear.least), (Aim::Cost, 2.6, 2.6));
}

#[test]
fn counts_are_kept_and_offcuts_used_first() {
    let bars =
        vec![Offer::offcuts(510.0, 1), priced(1000.0, 1.0, Some(1)), priced(2000.0, 3.0, None)];
    let stock = Stock { bars, ..Stock::default() };
    let p = planned(&[500.0; 4], &stock);
    assert_eq!(bought(&p), [(2000.0, 1)], "the offcut and one long bar, or three bars");
    let p = planned(&[500.0; 3], &stock);
    assert_eq!((bought(&p), p.cost()), (vec![(1000.0, 1)], Some(1.0)));
    assert!(p.bars[0].at_hand && p.bars[0].price.is_none());
    assert_eq!((p.bought(), p.sawn(), p.taken()[0].length), (1000.0, 1510.0, 510.0));
    // An offcut longer than the bars on sale is fine.
    let bars = vec![Offer::plain(1000.0), Offer::offcuts(1500.0, 1)];
    let p = planned(&[1400.0, 900.0], &Stock { bars, ..Stock::default() });
    assert_eq!((bought(&p), p.is_proven()), (vec![(1000.0, 1)], true));
}

#[test]
fn too_few_bars_are_refused_with_what_is_missing() {
    let bars = vec![Offer { count: Some(1), ..Offer::plain(1000.0) }, Offer::offcuts(300.0, 1)];
    let stock = Stock { bars, ..Stock::default() };
    let e = plan(&sticks(&[500.0, 500.0, 400.0, 250.0]), &stock).expect_err("one too many");
    assert_eq!(
        e.to_string(),
        "the stock does not suffice: R003 is left without a bar, 0.40 m in all"
    );
    assert!(plan(&sticks(&[500.0, 500.0, 250.0]), &stock).is_ok());
    // Both bars are filled to the last mm.
    let two =
        Stock { bars: vec![Offer { count: Some(2), ..Offer::plain(10.0) }], ..Stock::default() };
    assert!(plan_by(&sticks(&[5.0, 5.0, 4.0, 3.0, 3.0]), &two, Effort::BestFit).is_ok());
    assert!(plan(&sticks(&[6.0, 4.0, 4.0, 3.0, 3.0]), &two).is_ok());
}

#[test]
fn trim_is_sawn_off_both_ends() {
    let stock = Stock { trim: 2.0, ..stock(&[1000.0], 1.0) };
    let p = planned(&[497.5, 497.5], &stock);
    let stops: Vec<f64> = p.bars[0].pieces.iter().map(|p| p.stop).collect();
    assert_eq!((stops, p.bars[0].left, p.cuts()), (vec![499.5, 998.0], 1.0, 3));
    assert_eq!(planned(&[497.5, 498.0], &stock).bars.len(), 2);
    let e = plan(&sticks(&[997.0]), &stock).expect_err("no room");
    assert!(e.hint().contains("1001 mm"), "{}", e.hint());
}

#[test]
fn offcuts_are_measured_from_their_sawn_end_and_trimmed_at_the_other() {
    let bars = vec![Offer::offcuts(500.0, 1), Offer::plain(1000.0)];
    let stock = Stock { bars, kerf: 1.0, trim: 2.0, keep: None };
    let p = planned(&[498.0, 498.0], &stock);
    let [offcut, bar] = &p.bars[..] else { panic!("{:?}", p.bars) };
    assert_eq!((offcut.at_hand, offcut.pieces[0].stop, offcut.left), (true, 498.0, 1.0));
    assert_eq!((offcut.cuts(), bar.pieces[0].stop, bar.cuts()), (1, 500.0, 2));
    assert!(planned(&[498.5], &stock).bars.iter().all(|bar| !bar.at_hand));
}

#[test]
fn long_left_overs_are_kept_and_no_waste() {
    let stock = Stock { keep: Some(150.0), ..stock(&[1000.0], 1.0) };
    let p = planned(&[600.0, 600.0, 820.0], &stock);
    let kept: Vec<(f64, usize)> = p.kept().iter().map(|k| (k.length, k.count)).collect();
    assert_eq!(kept, [(399.0, 2), (179.0, 1)]);
    assert!((p.waste() - 3.0 / 3000.0).abs() < 1e-12, "only the cuts: {}", p.waste());
}

#[test]
fn bars_of_a_diameter_are_for_rods_of_it() {
    let stick = |length, d| Stick { length, diameters: [d; 2] };
    let sticks: IdVec<RodId, Stick> = [stick(300.0, 3.0), stick(300.0, 5.0)].into_iter().collect();
    let thick = Offer { diameter: Some(5.0), ..Offer::offcuts(400.0, 2) };
    let thin = Offer { diameter: Some(3.0), ..Offer::plain(1000.0) };
    let stock = |bars| Stock { bars, ..Stock::default() };
    let p = plan(&sticks, &stock(vec![thick, thin])).expect("one of each");
    let lengths: Vec<f64> = p.bars.iter().map(|b| b.stock_length).collect();
    assert_eq!(lengths, [1000.0, 400.0]);
    let e = plan(&sticks, &stock(vec![thin])).expect_err("no thick bars");
    assert!(e.to_string().contains("R002 is") && e.to_string().contains("diameter 5 mm"), "{e}");
}

#[test]
fn what_is_no_stock_is_refused() {
    let refused = |stock: Stock| {
        let e = plan(&sticks(&[100.0]), &stock).expect_err("no stock");
        format!("{e}. {}", e.hint())
    };
    let bars = |offers: &[Offer]| Stock { bars: offers.to_vec(), ..Stock::default() };
    for (stock, word) in [
        (bars(&[priced(1000.0, -1.0, None)]), "a price of -1 for bars of 1000 mm"),
        (bars(&[priced(1000.0, 0.0, None)]), "is an offcut"),
        (bars(&[priced(1000.0, f64::NAN, None)]), "a price of NaN"),
        (bars(&[priced(1000.0, 1.0, Some(0))]), "a count of 0 bars of 1000 mm"),
        (bars(&[Offer::offcuts(400.0, 0)]), "a count of 0"),
        (bars(&[priced(1000.0, 1.0, None), Offer::plain(2000.0)]), "bars of 2000 mm have no price"),
        (Stock { trim: 500.0, ..stock(&[1000.0], 1.0) }, "leaves nothing of bars of 1000 mm"),
        (Stock { trim: -1.0, ..stock(&[1000.0], 1.0) }, "a trim of -1 mm"),
        (Stock { trim: 451.0, ..stock(&[1000.0], 1.0) }, "R001 is longer"),
    ] {
        let message = refused(stock);
        assert!(message.contains(word), "{message}");
    }
}

/// The least that bars cost for these pieces, by trying every way. Nothing if they do not suffice.
fn least(lengths: &[f64], stock: &Stock, costs: &[f64]) -> Option<f64> {
    struct Tried<'a> {
        stock: &'a Stock,
        costs: &'a [f64],
        best: f64,
    }
    /// Bars begun, by the room left and their kind.
    fn go(t: &mut Tried, rest: &[f64], bars: &mut Vec<(f64, usize)>, cost: f64) {
        if cost >= t.best - 1e-9 {
            return;
        }
        let Some((&size, rest)) = rest.split_first() else {
            t.best = cost;
            return;
        };
        for i in 0..bars.len() {
            if size <= bars[i].0 + 1e-6 {
                bars[i].0 -= size;
                go(t, rest, bars, cost);
                bars[i].0 += size;
            }
        }
        for (k, offer) in t.stock.bars.iter().enumerate() {
            let used = bars.iter().filter(|b| b.1 == k).count();
            let room = t.stock.room(offer) + t.stock.kerf;
            if offer.count.is_none_or(|n| used < n) && size <= room + 1e-6 {
                bars.push((room - size, k));
                go(t, rest, bars, cost + t.costs[k]);
                bars.pop();
            }
        }
    }
    let mut sizes: Vec<f64> = lengths.iter().map(|l| l + stock.kerf).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let mut tried = Tried { stock, costs, best: f64::INFINITY };
    go(&mut tried, &sizes, &mut Vec::new(), 0.0);
    tried.best.is_finite().then_some(tried.best)
}

/// Every rod once, no bar over-full, no more bars than there are, stops and left-overs right.
fn assert_sound(p: &CutPlan, sticks: &IdVec<RodId, Stick>, stock: &Stock) {
    let mut rods: Vec<RodId> = Vec::new();
    for bar in &p.bars {
        let mut at = stock.first_trim(bar.at_hand) - stock.kerf;
        for piece in &bar.pieces {
            at += stock.kerf + piece.length;
            assert!((piece.stop - at).abs() < 1e-9);
            assert_eq!(piece.length, sticks[piece.rod].length);
        }
        assert!(at <= bar.stock_length - stock.trim + 1e-6);
        let left = bar.stock_length - at - stock.kerf;
        assert!((bar.left - left.max(0.0)).abs() < 1e-5);
        rods.extend(bar.pieces.iter().map(|p| p.rod));
    }
    rods.sort();
    assert!(rods.into_iter().eq(sticks.ids()));
    for offer in &stock.bars {
        let alike = |b: &&Bar| {
            b.stock_length == offer.length && b.at_hand == offer.at_hand && b.price == offer.price
        };
        // Offers may be alike: there are as many bars as in all of them.
        let same = |o: &&Offer| {
            o.length == offer.length && o.at_hand == offer.at_hand && o.price == offer.price
        };
        let there: Option<usize> = stock.bars.iter().filter(same).map(|o| o.count).sum();
        assert!(there.is_none_or(|n| p.bars.iter().filter(alike).count() <= n));
        assert!(p.bars.iter().all(|b| stock.bars.iter().any(|o| o.length == b.stock_length)));
    }
    assert_eq!(p.groups().iter().map(|g| g.bars.len()).sum::<usize>(), p.bars.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn plans_are_sound_no_worse_than_best_fit_and_not_below_the_bound(
        halves in proptest::collection::vec(1u32..=600, 1..60),
        kerf in prop_oneof![Just(0.0), Just(1.0), 0.0..4.0f64],
        trim in prop_oneof![Just(0.0), 0.0..5.0f64],
        longest in 4u32..12,
        others in proptest::collection::vec(1u32..12, 0..3),
    ) {
        let lengths: Vec<f64> = halves.iter().map(|&h| f64::from(h) * 0.5).collect();
        let sticks = sticks(&lengths);
        let offers: Vec<f64> =
            others.into_iter().chain([longest]).map(|h| f64::from(h) * 100.0).collect();
        let stock = Stock { trim, ..stock(&offers, kerf) };
        let p = plan(&sticks, &stock).expect("all fit");
        assert_sound(&p, &sticks, &stock);
        let quick = plan_by(&sticks, &stock, Effort::BestFit).expect("all fit");
        assert_sound(&quick, &sticks, &stock);
        prop_assert!(p.spent <= quick.spent + 1e-9);
        prop_assert!(p.spent >= p.least - 1e-9 && p.bars.len() >= p.bound);
        prop_assert_eq!(p.is_proven(), p.spent <= p.least + 1e-6);
        if offers.len() == 1 {
            prop_assert_eq!(p.is_proven(), p.bars.len() == p.bound);
        }
        let room = offers.iter().copied().fold(0.0, f64::max) - 2.0 * trim + kerf;
        let plain = (lengths.iter().map(|l| l + kerf).sum::<f64>() / room - 1e-6).ceil();
        prop_assert!(p.bound as f64 >= plain);
        prop_assert_eq!(plan(&sticks, &stock).expect("as before"), p);
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

    /// Few pieces are always planned best, and it is known: in whole cells of a grid, and in
    /// lengths without one.
    #[test]
    fn few_pieces_are_planned_as_well_as_by_trying_every_way(
        lengths in prop_oneof![
            proptest::collection::vec(50.0..900.0f64, 1..=9),
            proptest::collection::vec((100u32..1800).prop_map(|h| f64::from(h) * 0.5), 1..=9),
            proptest::collection::vec((2u32..7).prop_map(|h| f64::from(h) * 100.0), 1..=9),
        ],
        kerf in prop_oneof![Just(0.0), Just(1.0), 0.0..4.0f64],
    ) {
        let stock = stock(&[1000.0], kerf);
        let p = planned(&lengths, &stock);
        prop_assert_eq!(Some(p.bars.len() as f64), least(&lengths, &stock, &[1.0]));
        prop_assert!(p.is_proven() && p.bound == p.bars.len());
    }

    #[test]
    fn several_stock_lengths_with_prices_and_counts_are_used_at_the_least_cost(
        lengths in proptest::collection::vec((100u32..1200).prop_map(|h| f64::from(h) * 0.5), 1..=7),
        prices in proptest::collection::vec((60u32..300, proptest::option::of(1usize..4)), 3),
        offcuts in proptest::collection::vec((200u32..1400, 1usize..3), 0..3),
        kerf in prop_oneof![Just(0.0), Just(1.0)],
        trim in prop_oneof![Just(0.0), Just(2.0)],
    ) {
        let sold = prices.iter().zip([700.0, 1000.0, 1500.0]);
        let sold = sold.map(|(&(p, count), l)| priced(l, f64::from(p) * 0.01, count));
        let old = offcuts.iter().map(|&(h, n)| Offer::offcuts(f64::from(h) * 0.5, n));
        let bars = old.chain(sold).collect();
        let stock = Stock { bars, kerf, trim, ..Stock::default() };
        let costs: Vec<f64> = stock.bars.iter().map(|b| b.price.unwrap_or(0.0)).collect();
        let sticks = sticks(&lengths);
        match (plan(&sticks, &stock), least(&lengths, &stock, &costs)) {
            (Ok(p), Some(least)) => {
                assert_sound(&p, &sticks, &stock);
                prop_assert!((p.spent - least).abs() < 1e-9, "{} for {least}", p.spent);
                prop_assert!((p.cost().unwrap_or_default() - least).abs() < 1e-9);
                prop_assert!(p.is_proven(), "{} {}", p.least, p.spent);
            }
            (Err(CutError::NotEnough { certain, .. }), None) => prop_assert!(certain),
            (got, wanted) => prop_assert!(false, "{got:?} {wanted:?}"),
        }
    }
}
