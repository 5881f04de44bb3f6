//! Which rods are placed in one step.

use super::Order;
use super::site::Site;
use crate::ids::RodId;
use std::collections::BTreeSet;

/// The missing rods of a unit, and whatever else they need to be held, in batches of at most
/// `most` rods each.
///
/// In crown order rods that hold each other stay together, even where they are more.
pub fn batches(site: &Site, missing: Vec<RodId>, most: Option<usize>) -> Vec<Vec<RodId>> {
    let all = held(site, missing);
    let Some(most) = most.filter(|&most| all.len() > most.max(1)) else {
        return if all.is_empty() { Vec::new() } else { vec![all] };
    };
    match site.order {
        Order::Ground => all.chunks(most.max(1)).map(<[RodId]>::to_vec).collect(),
        Order::Crown => {
            let mut batches: Vec<Vec<RodId>> = Vec::new();
            for chain in chains(site, &all) {
                match batches.last_mut() {
                    Some(last) if last.len() + chain.len() <= most => last.extend(chain),
                    _ => batches.push(chain),
                }
            }
            batches
        }
    }
}

/// Adds rods until each is held by two contacts or feet at least.
fn held(site: &Site, mut rods: Vec<RodId>) -> Vec<RodId> {
    let frame = site.frame;
    let mut chosen: BTreeSet<RodId> = rods.iter().copied().collect();
    loop {
        let swings = |&&rod: &&RodId| site.holds(rod, |partner| chosen.contains(&partner)) < 2;
        let Some(&rod) = rods.iter().find(swings) else { return rods };
        let open = |&r: &RodId| !site.has(r) && !chosen.contains(&r);
        let of_units = frame.rods[rod].units.iter().flat_map(|&unit| site.missing(unit));
        let mut more: Vec<RodId> = of_units.filter(open).collect();
        if more.is_empty() {
            let contacts = frame.rods[rod].contacts.iter();
            let partners = contacts.map(|&c| frame.seen_from(c, rod).partner);
            more = partners.filter(open).collect();
        }
        more.sort_unstable();
        more.dedup();
        if more.is_empty() {
            // A rod with fewer than two contacts in all, which no frame has.
            return rods;
        }
        chosen.extend(&more);
        rods.extend(more);
    }
}

/// The rods in groups that touch, in their order.
fn chains(site: &Site, rods: &[RodId]) -> Vec<Vec<RodId>> {
    let mut left: Vec<RodId> = rods.to_vec();
    let mut chains = Vec::new();
    while !left.is_empty() {
        let mut chain = vec![left.remove(0)];
        let mut next = 0;
        while next < chain.len() {
            let rod = chain[next];
            let contacts = &site.frame.rods[rod].contacts;
            for partner in contacts.iter().map(|&c| site.frame.seen_from(c, rod).partner) {
                if let Some(i) = left.iter().position(|&r| r == partner) {
                    chain.push(left.remove(i));
                }
            }
            next += 1;
        }
        chains.push(chain);
    }
    chains
}
