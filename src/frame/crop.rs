//! Which tiles become units (paper, section 4.1): those that lie on the surface, hold
//! together, and hang on to each other.

use super::canvas::Canvas;
use crate::ids::{IdVec, TileId};
use crate::tiling::Net;

/// The tiles to build units on, in the order of their rank.
///
/// Of those in `held`, tiles with fewer than two neighbours are dropped, repeatedly,
/// then all but the largest connected piece.
pub fn crop(canvas: &impl Canvas, held: &IdVec<TileId, bool>) -> Vec<TileId> {
    let mut kept = held.clone();
    drop_loose(canvas.net(), &mut kept);
    let tiles = largest_piece(canvas.net(), &kept);
    let ranks: Vec<[f64; 2]> = tiles.iter().map(|&t| canvas.rank(t)).collect();
    let mut order: Vec<usize> = (0..tiles.len()).collect();
    order.sort_by(|&i, &j| {
        let ([ring, angle], [other_ring, other_angle]) = (ranks[i], ranks[j]);
        ring.total_cmp(&other_ring).then(angle.total_cmp(&other_angle)).then(i.cmp(&j))
    });
    order.into_iter().map(|i| tiles[i]).collect()
}

/// The tiles that lie on the surface.
pub fn held(canvas: &impl Canvas) -> IdVec<TileId, bool> {
    canvas.net().tiles.ids().map(|t| canvas.holds(t)).collect()
}

/// Tiles on the other side of a tile's edges, where they are kept.
fn neighbours<'a>(
    net: &'a Net,
    kept: &'a IdVec<TileId, bool>,
    tile: TileId,
) -> impl Iterator<Item = TileId> + 'a {
    net.neighbours(tile).filter(|&t| kept[t])
}

fn drop_loose(net: &Net, kept: &mut IdVec<TileId, bool>) {
    let mut todo: Vec<TileId> = kept.ids().filter(|&t| kept[t]).collect();
    while let Some(tile) = todo.pop() {
        if kept[tile] && neighbours(net, kept, tile).count() < 2 {
            kept[tile] = false;
            todo.extend(neighbours(net, kept, tile));
        }
    }
}

fn largest_piece(net: &Net, kept: &IdVec<TileId, bool>) -> Vec<TileId> {
    let mut seen: IdVec<TileId, bool> = vec![false; kept.len()].into();
    let mut largest = Vec::new();
    for start in kept.ids() {
        if !kept[start] || seen[start] {
            continue;
        }
        seen[start] = true;
        let (mut piece, mut next) = (vec![start], 0);
        while let Some(&tile) = piece.get(next) {
            next += 1;
            for other in neighbours(net, kept, tile) {
                if !std::mem::replace(&mut seen[other], true) {
                    piece.push(other);
                }
            }
        }
        if piece.len() > largest.len() {
            largest = piece;
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::canvas::PlaneCanvas;
    use crate::frame::canvas::fixture::Rooms;
    use crate::pattern::{Pattern, Shape};
    use crate::tiling::Placement;

    fn rooms() -> PlaneCanvas<'static, Rooms> {
        let placement = Placement { origin: [0.5; 2].into(), rotation: 0.0, edge: 1.0 };
        let squares = Pattern::named("4.4.4.4").expect("in the library");
        let shape = Shape { turn: 0.3, slide: 0.0 };
        PlaneCanvas::new(&Rooms, squares, placement, shape).expect("few tiles")
    }

    #[test]
    fn a_chain_of_single_tiles_joins_rooms_and_its_loss_parts_them() {
        let canvas = rooms();
        let x = |t: TileId| canvas.middle(t).x;
        let mut held = held(&canvas);
        let kept = crop(&canvas, &held);
        let passage = kept.iter().find(|&&t| (5.0..9.0).contains(&x(t)));
        held[*passage.expect("the passage is kept")] = false;
        let kept = crop(&canvas, &held);
        assert!(kept.iter().all(|&t| x(t) < 5.0), "the larger room stays");
        assert!(kept.len() >= 64);
    }

    #[test]
    fn tiles_come_from_the_middle_outwards() {
        let canvas = rooms();
        let kept = crop(&canvas, &held(&canvas));
        let far: Vec<f64> = kept.iter().map(|&t| canvas.middle(t).coords.norm()).collect();
        assert!(far.windows(2).all(|w| w[0] <= w[1] + 1e-6));
    }
}
