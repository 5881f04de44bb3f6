//! Which unit lies on which tile.
use super::{Join, Pattern};
use crate::ids::{Id, IdVec, TileEdgeId, TileId};
use crate::tiling::Tiling;
use std::collections::VecDeque;

#[derive(Clone, Debug)]
pub struct Layout {
    pub tiles: IdVec<TileId, Place>,
    pub joins: IdVec<TileEdgeId, Join>,
}
#[derive(Clone, Copy, Debug)]
pub struct Place {
    pub kind: usize,
    pub first: usize,
    pub even: bool,
}
#[derive(Debug, Clone, thiserror::Error, PartialEq)]
#[error("layout")]
pub struct LayoutError;
impl Layout {
    pub fn new(pattern: &Pattern, tiling: &Tiling) -> Result<Self, LayoutError> {
        let n = tiling.net.tiles.len();
        let mut tiles: IdVec<TileId, Option<Place>> = vec![None; n].into();
        let key = |t: TileId| {
            let c = tiling.centers[t];
            ((c.coords.norm() * 1e6).round(), c.y.atan2(c.x))
        };
        let Some(start) = tiling.net.tiles.ids().min_by(|&a, &b| {
            let (p, q) = (key(a), key(b));
            p.0.total_cmp(&q.0).then(p.1.total_cmp(&q.1))
        }) else {
            return Ok(Self { tiles: IdVec::default(), joins: IdVec::default() });
        };
        let ok = |a: usize, b: usize| {
            pattern
                .rules
                .iter()
                .find(|r| {
                    (r.slots[0].kind == a && r.slots[1].kind == b)
                        || (r.slots[0].kind == b && r.slots[1].kind == a)
                })
                .map(|r| r.join)
        };
        let mut queue = VecDeque::from([start]);
        let pick = |t: TileId, tiles: &IdVec<TileId, Option<Place>>| {
            let sides = tiling.net.tiles[t].corners.len();
            (0..pattern.kinds.len()).find(|&k| {
                pattern.kinds[k].sides == sides
                    && tiling
                        .net
                        .neighbours(t)
                        .all(|o| tiles[o].is_none_or(|p| ok(k, p.kind).is_some()))
            })
        };
        tiles[start] =
            Some(Place { kind: pick(start, &tiles).ok_or(LayoutError)?, first: 0, even: true });
        while let Some(t) = queue.pop_front() {
            let even = tiles[t].is_some_and(|p| p.even);
            for o in tiling.net.neighbours(t).collect::<Vec<_>>() {
                if tiles[o].is_none() {
                    tiles[o] = Some(Place {
                        kind: pick(o, &tiles).ok_or(LayoutError)?,
                        first: 0,
                        even: !even,
                    });
                    queue.push_back(o);
                }
            }
        }
        let tiles: IdVec<TileId, Place> =
            tiles.iter().map(|p| p.unwrap_or(Place { kind: 0, first: 0, even: true })).collect();
        let joins = tiling
            .net
            .edges
            .iter()
            .map(|e| {
                e.right.and_then(|r| ok(tiles[e.left].kind, tiles[r].kind)).unwrap_or(Join::Shared)
            })
            .collect();
        let _ = TileId::new(0);
        Ok(Self { tiles, joins })
    }
}
