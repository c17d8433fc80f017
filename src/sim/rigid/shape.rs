//! The shape in which rigid bonds hold a body.

use std::collections::BTreeMap;

use crate::sim::vector::{add, cross, dot, scale, sub};

/// Least share of the length of a bond by which a point that two bonds hold must be off the line through their other ends.
pub(crate) const LEAST_HEIGHT: f64 = 1e-2;
/// Share of its length by which a bond may differ from what the others say.
pub(crate) const FITS: f64 = 1e-6;

/// What a rigid body is by itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shape {
    /// Where its points are, from its middle, or from the point that it is pinned at `[m]`.
    pub(crate) places: Vec<[f64; 2]>,
    /// Of its points `[kg]`; 0 of one that is pinned.
    pub(crate) masses: Vec<f64>,
    pub(crate) mass: f64,
    /// About where its places are counted from `[kg m^2]`.
    pub(crate) inertia: f64,
    /// Which of its points is pinned, and where its middle is from there `[m]`.
    pub(crate) pin: Option<(u32, [f64; 2])>,
    /// The points that may touch something.
    pub(crate) surface: Vec<u32>,
}

/// Points as a shape is found from them: where they are now `[m]`, masses `[kg]`, infinite where they are pinned, and the rigid bonds between them.
pub(crate) struct Held<'a> {
    pub(crate) now: Vec<[f64; 2]>,
    pub(crate) masses: Vec<f64>,
    /// Points in the order of the lists above.
    pub(crate) bonds: Vec<([u32; 2], f64)>,
    pub(crate) surface: &'a [u32],
}

impl Shape {
    /// The shape in which bonds hold all points; `None`: they leave some of them loose, are too few, contradict each other, or more than one
    /// point is pinned.
    ///
    /// From one bond on, point after point is laid out that two bonds hold to what is there, on the side on which it is now: linear in
    /// the bonds.
    pub(crate) fn of(held: Held<'_>) -> Option<Self> {
        let count = held.now.len();
        if count < 3 || held.bonds.len() < 2 * count - 3 {
            return None;
        }
        let mut pinned = (0..count).filter(|&k| !held.masses[k].is_finite());
        let (pin, None) = (pinned.next(), pinned.next()) else { return None };
        let net = Net::new(&held);
        let mut places = net.of(0).iter().find_map(|seed| {
            let mut places = vec![None; count];
            net.grow(Net::placed(seed, &mut places), &mut places);
            places.into_iter().collect::<Option<Vec<_>>>()
        })?;
        if !held.bonds.iter().all(|bond| fits(bond, |point| places[point as usize])) {
            return None;
        }
        let Held { mut masses, .. } = held;
        if let Some(pin) = pin {
            masses[pin] = 0.0;
        }
        let (mass, middle) = middle(&places, &masses);
        let origin = pin.map_or(middle, |pin| places[pin]);
        places.iter_mut().for_each(|x| *x = sub(*x, origin));
        let inertia = places.iter().zip(&masses).map(|(&x, &m)| m * dot(x, x)).sum();
        let pin = pin.map(|pin| (pin as u32, sub(middle, origin)));
        Some(Shape { places, masses, mass, inertia, pin, surface: held.surface.to_vec() })
    }

    /// Its points in another order, of which the first `outer` may touch something. Nothing of it is pinned.
    pub(crate) fn reorder(&mut self, order: &[u32], outer: u32) {
        self.places = order.iter().map(|&k| self.places[k as usize]).collect();
        self.masses = order.iter().map(|&k| self.masses[k as usize]).collect();
        self.surface = (0..outer).collect();
    }

    /// The shape of places with these masses `[kg]`, counted from their middle; a point alone does not turn.
    pub(crate) fn free(mut places: Vec<[f64; 2]>, masses: Vec<f64>) -> Self {
        let (mass, middle) = middle(&places, &masses);
        places.iter_mut().for_each(|x| *x = sub(*x, middle));
        let inertia: f64 = places.iter().zip(&masses).map(|(&x, &m)| m * dot(x, x)).sum();
        let inertia = if inertia > 0.0 { inertia } else { f64::INFINITY };
        Shape { places, masses, mass, inertia, pin: None, surface: Vec::new() }
    }
}

/// All of the mass and its middle.
fn middle(places: &[[f64; 2]], masses: &[f64]) -> (f64, [f64; 2]) {
    let mass: f64 = masses.iter().sum();
    let sum = places.iter().zip(masses).fold([0.0; 2], |sum, (&x, &m)| add(sum, scale(x, m)));
    (mass, scale(sum, 1.0 / mass))
}

/// Whether a bond has the length that places say.
pub(super) fn fits(&([a, b], rest): &([u32; 2], f64), place: impl Fn(u32) -> [f64; 2]) -> bool {
    let d = sub(place(a), place(b));
    (dot(d, d).sqrt() - rest).abs() <= FITS * rest
}

/// A bond as one of its ends sees it: that, the other one, its length `[m]` and its number.
type Spoke = (u32, u32, f64, u32);

/// Where points are that are laid out.
pub(super) trait Places {
    fn at(&self, point: u32) -> Option<[f64; 2]>;
    fn put(&mut self, point: u32, place: [f64; 2]);
}

impl Places for Vec<Option<[f64; 2]>> {
    fn at(&self, point: u32) -> Option<[f64; 2]> {
        self[point as usize]
    }

    fn put(&mut self, point: u32, place: [f64; 2]) {
        self[point as usize] = Some(place);
    }
}

impl Places for BTreeMap<u32, [f64; 2]> {
    fn at(&self, point: u32) -> Option<[f64; 2]> {
        self.get(&point).copied()
    }

    fn put(&mut self, point: u32, place: [f64; 2]) {
        self.insert(point, place);
    }
}

/// Bonds by the points that they are at.
pub(super) struct Net<'a> {
    now: &'a [[f64; 2]],
    spokes: Vec<Spoke>,
    /// Where those of each point begin.
    starts: Vec<usize>,
}

impl<'a> Net<'a> {
    pub(super) fn new(held: &'a Held<'_>) -> Self {
        let both = |(&([a, b], rest), k): (&([u32; 2], f64), u32)| [(a, b, rest, k), (b, a, rest, k)];
        let mut spokes: Vec<Spoke> = held.bonds.iter().zip(0..).flat_map(both).collect();
        spokes.sort_unstable_by_key(|spoke| (spoke.0, spoke.1));
        let count = held.now.len() as u32;
        let starts = (0..=count).map(|point| spokes.partition_point(|spoke| spoke.0 < point)).collect();
        Net { now: &held.now, spokes, starts }
    }

    /// How many points there are.
    pub(super) fn count(&self) -> usize {
        self.now.len()
    }

    /// The bonds at a point.
    pub(super) fn of(&self, point: u32) -> &[Spoke] {
        &self.spokes[self.starts[point as usize]..self.starts[point as usize + 1]]
    }

    /// The ends of a bond are laid out.
    pub(super) fn placed(&(a, b, rest, _): &Spoke, places: &mut [Option<[f64; 2]>]) -> Vec<u32> {
        (places[a as usize], places[b as usize]) = (Some([0.0; 2]), Some([rest, 0.0]));
        vec![a, b]
    }

    /// Lays points out from these on, as far as two bonds each hold them. Returns these and then all that got a place.
    pub(super) fn grow(&self, mut list: Vec<u32>, places: &mut impl Places) -> Vec<u32> {
        let now = |i: u32| self.now[i as usize];
        let mut next = 0;
        while let Some(&point) = list.get(next) {
            next += 1;
            let Some(from) = places.at(point) else { continue };
            for &(_, q, to, _) in self.of(point) {
                if places.at(q).is_some() {
                    continue;
                }
                let other = self.of(q).iter().filter(|spoke| spoke.1 != point);
                let found = other.filter_map(|&(_, other, rest, _)| Some((other, places.at(other)?, rest))).find_map(
                    |(other, place, rest)| {
                        let side = cross(sub(now(other), now(point)), sub(now(q), now(point)));
                        third((from, to), (place, rest), side)
                    },
                );
                if let Some(place) = found {
                    places.put(q, place);
                    list.push(q);
                }
            }
        }
        list
    }
}

/// The place at these distances from two others, on the left of the way from the first to the second where `side` > 0; `None`: there is
/// none, or hardly beside it.
fn third((a, to_a): ([f64; 2], f64), (b, to_b): ([f64; 2], f64), side: f64) -> Option<[f64; 2]> {
    let u = sub(b, a);
    let square = dot(u, u);
    let along = (square + to_a * to_a - to_b * to_b) / (2.0 * square);
    let height = to_a * to_a - along * along * square;
    let least = LEAST_HEIGHT * to_a;
    // NaN is beside nothing.
    let is_beside = height > least * least;
    if !is_beside || side == 0.0 {
        return None;
    }
    let out = scale([-u[1], u[0]], side.signum() * (height / square).sqrt());
    Some(add(a, add(scale(u, along), out)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points with the bonds between these ends, as long as they are apart.
    fn shape(now: &[[f64; 2]], ends: &[[u32; 2]], longer: f64) -> Option<Shape> {
        let length = |[a, b]: [u32; 2]| {
            let d = sub(now[a as usize], now[b as usize]);
            dot(d, d).sqrt()
        };
        let mut bonds: Vec<([u32; 2], f64)> = ends.iter().map(|&ends| (ends, length(ends))).collect();
        if let Some(last) = bonds.last_mut() {
            last.1 *= longer;
        }
        let masses = (0..now.len()).map(|i| 1.0 + i as f64).collect();
        Shape::of(Held { now: now.to_vec(), masses, bonds, surface: &[] })
    }

    const SQUARE: [[f64; 2]; 4] = [[2.0, 1.0], [3.0, 1.0], [3.0, 2.0], [2.0, 2.0]];
    const SIDES: [[u32; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];

    #[test]
    fn a_square_needs_its_diagonal() {
        assert!(shape(&SQUARE, &SIDES, 1.0).is_none());
        let braced = [SIDES.to_vec(), vec![[0, 2]]].concat();
        let found = shape(&SQUARE, &braced, 1.0).unwrap_or_else(|| unreachable!("it is rigid"));
        // Its points weigh 1 to 4.
        assert!((found.mass - 10.0).abs() < 1e-12);
        let middle = [2.5, 1.7];
        let inertia: f64 = (1..=4).zip(SQUARE).map(|(m, x)| f64::from(m) * dot(sub(x, middle), sub(x, middle))).sum();
        assert!((found.inertia - inertia).abs() < 1e-12, "{} and {inertia}", found.inertia);
    }

    #[test]
    fn lengths_that_contradict_each_other_make_no_shape() {
        let all = [SIDES.to_vec(), vec![[0, 2], [1, 3]]].concat();
        assert!(shape(&SQUARE, &all, 1.0).is_some());
        assert!(shape(&SQUARE, &all, 1.001).is_none());
    }

    #[test]
    fn what_moves_is_no_shape() {
        // Two triangles with a common corner, and with three parallel bars between them.
        let bow = [[0.0, 0.0], [1.0, 0.5], [1.0, -0.5], [-1.0, 0.5], [-1.0, -0.5]];
        assert!(shape(&bow, &[[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0], [3, 0]], 1.0).is_none());
        let bars = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.0, 3.0], [1.0, 3.0], [0.5, 4.0]];
        let ends = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
        assert!(shape(&bars, &ends, 1.0).is_none());
        // In a row: a bond's length says nothing across it.
        assert!(shape(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], &[[0, 1], [1, 2], [0, 2]], 1.0).is_none());
    }
}
