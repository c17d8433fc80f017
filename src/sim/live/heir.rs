//! What is known of bodies outlives the lists that they are in: sides, what is tangled, how calm they are.

use super::Live;
use super::pair::Sides;
use crate::sim::real::Real;

/// No number.
const NONE: u32 = u32::MAX;

impl<S: Real> Live<S> {
    /// Takes over what another list of bodies knew of these points: slots there and here.
    pub(super) fn take_over(&mut self, other: &Self, slots: &[(u32, u32)]) {
        let mut here = vec![NONE; other.bodies.order.len()];
        let mut place = vec![NONE; self.bodies.order.len()];
        self.bodies.order.iter().zip(0..).for_each(|(&slot, at)| place[slot as usize] = at);
        let mut old_place = vec![NONE; other.bodies.order.len()];
        other.bodies.order.iter().zip(0..).for_each(|(&slot, at)| old_place[slot as usize] = at);
        for &(old, new) in slots {
            here[old_place[old as usize] as usize] = place[new as usize];
        }
        self.take_sides(other, &here);
        self.take_rest(other, &here);
    }

    /// Sides of points of edges, by the places of points there and here.
    fn take_sides(&mut self, other: &Self, here: &[u32]) {
        let own = edges(self);
        let olds = edges(other);
        let mut at = vec![NONE; other.bodies.edges.len()];
        for &(ends, number) in &olds {
            let ends = ends.map(|end| here[end as usize]);
            if let Ok(found) = own.binary_search_by_key(&ends, |edge| edge.0) {
                at[number as usize] = own[found].1;
            }
        }
        let walls_stay = self.walls == other.walls;
        // Behind the own ones come those of obstacles.
        let number = |old: u32, list: &[u32], count: usize| match list.get(old as usize) {
            Some(&new) => (new != NONE).then_some(new),
            None => walls_stay.then(|| old - list.len() as u32 + count as u32),
        };
        let [corners, sides] = [self.bodies.order.len(), self.bodies.edges.len()];
        let of = |&(key, side): &(u64, i8)| {
            let corner = number((key >> 32) as u32, here, corners)?;
            let edge = number(key as u32, &at, sides)?;
            Some((u64::from(corner) << 32 | u64::from(edge), side))
        };
        let taken: Sides = other.sides.iter().filter_map(of).collect();
        self.sides.extend(taken);
        self.sides.sort_unstable();
        self.sides.dedup_by_key(|side| side.0);
    }

    /// What is known of bodies that are here as they were there.
    fn take_rest(&mut self, other: &Self, here: &[u32]) {
        let mut body_at = vec![NONE; self.bodies.order.len()];
        for (body, number) in self.bodies.list.iter().zip(0..) {
            body_at[body.points.range()].fill(number);
        }
        let same = |old: usize| {
            let from = &other.bodies.list[old].points;
            let first = *here.get(from.first as usize)?;
            let body = *body_at.get(first as usize)?;
            let to = &self.bodies.list[body as usize].points;
            let is_whole = to.first == first && to.len() == from.len();
            let mut pairs = here[from.range()].iter().zip(to.first..);
            (is_whole && pairs.all(|(&new, own)| new == own)).then_some(body)
        };
        let bodies: Vec<Option<u32>> = (0..other.bodies.list.len()).map(same).collect();
        for (old, &body) in bodies.iter().enumerate() {
            if let Some(body) = body {
                self.rests[body as usize] = other.rests[old].awake();
                self.settling[body as usize] = other.settling[old];
            }
        }
        self.tangle.take_over(&other.tangle, &bodies);
    }
}

/// The edges of all bodies by the places of their ends, ascending, with their numbers.
fn edges<S: Real>(live: &Live<S>) -> Vec<([u32; 2], u32)> {
    let of = |body: &super::body::Body<S>| {
        let (first, numbers) = (body.points.first, body.edges.first..);
        live.bodies.edges[body.edges.range()]
            .iter()
            .zip(numbers)
            .map(move |(edge, number)| (edge.ends.map(|end| first + end), number))
    };
    let mut list: Vec<([u32; 2], u32)> = live.bodies.list.iter().flat_map(of).collect();
    list.sort_unstable();
    list
}
