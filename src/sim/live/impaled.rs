//! Corners of obstacles that got into soft bodies: squeezed hard, a skin may slip over the tip of a needle, which then belongs to no edge.
//! It is led out through the nearest one.

use super::cluster::{Cluster, Common, OBSTACLE};
use super::detect::{Found, Search, find, pair};
use super::pair::{Pair, is_right_of};
use super::rest::Lies;
use crate::sim::measure::extent;
use crate::sim::real::Real;

impl<S: Real> Search<'_, S> {
    /// Pairs that were found of each corner of an obstacle, from the first on: where it is in a body and is led out of no edge of that, it
    /// comes out of the nearest.
    pub(super) fn lead_out(&mut self, state: &mut Cluster<S>, common: &Common<S>) {
        let first = state.corners.partition_point(|&(p, _)| state.body_of[p as usize] != OBSTACLE);
        if first == state.corners.len() {
            return;
        }
        let boxes: Vec<_> =
            state.bases.windows(2).map(|ends| extent(&state.now[ends[0] as usize..ends[1] as usize])).collect();
        for k in first..state.corners.len() {
            let (p, number) = state.corners[k];
            let x = state.now[p as usize];
            for (body, of) in (0..).zip(&boxes) {
                let is_near = of.is_some_and(|[low, high]| (0..2).all(|k| x[k] >= low[k] && x[k] <= high[k]));
                if !is_near || state.is_rigid(body) || self.is_led(state, (body, p)) {
                    continue;
                }
                if let Some(found) = self.nearest(state, (body, x))
                    && !state.passes_obstacles(&state.edges[found.edge].ends)
                {
                    let key = u64::from(number) << 32 | u64::from(state.edges[found.edge].number);
                    self.pairs.retain(|pair| pair.key != key);
                    let pair = pair(state, common, (p, found.edge, key), 1);
                    self.pairs.push(Pair { room: -S::INFINITY, ..pair });
                    state.lies[body as usize] = Lies::Within;
                }
            }
        }
    }

    /// Whether an edge of a body leads a corner out already.
    fn is_led(&self, state: &Cluster<S>, (body, p): (u32, u32)) -> bool {
        let is_of = |pair: &&Pair<S>| pair.p == p && state.body_of[pair.a as usize] == body;
        self.pairs.iter().filter(is_of).any(|pair| pair.side > S::ZERO && pair.room < S::ZERO)
    }

    /// The edge of the closed skins of a body that is nearest to a place within them; `None` of one outside.
    fn nearest(&self, state: &Cluster<S>, (body, x): (u32, [S; 2])) -> Option<Found<S>> {
        let [first, end] = [body, body + 1].map(|body| state.edges.partition_point(|edge| edge.body < body));
        let own = (first..end).filter(|&k| state.edges[k].is_closed);
        let crosses = |k: &usize| is_right_of(state.edges[*k].ends.map(|end| state.now[end as usize]), x);
        if own.clone().filter(crosses).count() % 2 == 0 {
            return None;
        }
        let found = own.filter_map(|k| find(&self.lines[k], k, x, S::INFINITY)).filter(|found| !found.is_end);
        found.min_by(|a, b| a.square.to_f64().total_cmp(&b.square.to_f64()))
    }
}
