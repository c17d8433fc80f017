//! What is told of bodies that start in each other, or across themselves.

use std::cmp::Ordering;

use super::World;
use crate::sim::bond::{PointId, lower_first};
use crate::sim::contact::hinged::Hinged;
use crate::sim::contact::skin::Contact;
use crate::sim::real::Real;
use crate::sim::sets::Sets;
use crate::sim::triangles;
use crate::sim::vector::{add, cross, scale, sub};

/// Points against triangles, and edges against edges, that are looked at: of scenes with more in one place the first are told.
const MOST_LOOKS: usize = 4_000_000;

/// A triangle or an edge with its body, from its leftmost to its rightmost corner.
#[derive(Clone, Copy)]
struct Patch<const N: usize> {
    corners: [u32; N],
    places: [[f64; 2]; N],
    body: u32,
    left: f64,
    right: f64,
}

/// Patches by their left ends, those that a line which sweeps along x is over, and how many may still be looked at.
struct Sweep<const N: usize> {
    patches: Vec<Patch<N>>,
    open: Vec<usize>,
    next: usize,
    left: usize,
}

/// Which bodies, by any of their points.
#[derive(Default)]
struct Found {
    /// Are in others, or across them.
    nested: Vec<u32>,
    /// Are across themselves.
    folded: Vec<u32>,
}

impl<S: Real, const D: usize> World<S, D> {
    /// Tells of bodies that meet and have a point in another one at these places `[m]`, or an edge across one.
    pub(super) fn warn_of_nested(&mut self, position: &[[f64; D]]) {
        let Some(contact) = self.model.contact else { return };
        if D == 3 {
            return self.warn_of_shared_places(position);
        }
        let places: Vec<[f64; 2]> = position.iter().map(|x| [x[0], x[1]]).collect();
        let (mut bodies, mut found) = (self.bonded(), Found::default());
        if contact.with_others {
            self.find_nested(&places, &mut bodies, &mut found);
        }
        self.find_crossed((&places, contact), &mut bodies, &mut found);
        let [nested, folded] = [found.nested, found.folded].map(|mut list| {
            list.sort_unstable();
            list.dedup();
            list.len()
        });
        if nested > 0 {
            self.warnings.push(format!("{nested} bodies start in each other: they are parted, slowly"));
        }
        if folded > 0 {
            let bodies = match folded {
                1 => "a body starts across itself".to_owned(),
                _ => format!("{folded} bodies start across themselves"),
            };
            self.warnings.push(format!("{bodies}: where that can be undone it is, slowly"));
        }
    }

    /// Tells of bodies in space that have points where others have points: nothing says which side of the others they are on.
    fn warn_of_shared_places(&mut self, position: &[[f64; D]]) {
        let mut bodies = self.bonded();
        let mut points: Vec<u32> = (0..position.len() as u32).collect();
        let mut shared: Vec<u32> = Vec::new();
        for place in by_place(&mut points, position) {
            let mut own: Vec<u32> = place.iter().map(|&point| bodies.find(point)).collect();
            own.sort_unstable();
            own.dedup();
            if own.len() > 1 {
                shared.extend(own);
            }
        }
        shared.sort_unstable();
        shared.dedup();
        if !shared.is_empty() {
            self.warnings.push(format!("{} bodies start in the same places: move them apart", shared.len()));
        }
    }

    /// Points in triangles of others, and middles of triangles, which alone say so of bodies that are the same in one place.
    fn find_nested(&self, places: &[[f64; 2]], bodies: &mut Sets, found: &mut Found) {
        let triangles = || self.model.triangles.iter().map(|triangle| triangle.map(|corner| corner.0));
        let mut sweep = Sweep::new(triangles(), places, bodies);
        let mut probes: Vec<([f64; 2], u32)> = places.iter().copied().zip(0..).collect();
        probes.extend(triangles().map(|corners| {
            let sum = corners.iter().fold([0.0; 2], |sum, &corner| add(sum, places[corner as usize]));
            (scale(sum, 1.0 / 3.0), corners[0])
        }));
        probes.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        for (x, point) in probes {
            let own = bodies.find(point);
            let inside = sweep.over(x[0]).filter(|patch| patch.body != own && triangles::holds(patch.places, x));
            let others: Vec<u32> = inside.map(|patch| patch.body).collect();
            if !others.is_empty() {
                found.nested.push(own);
                found.nested.extend(others);
            }
        }
    }

    /// Edges of skins across edges.
    fn find_crossed(&self, (places, contact): (&[[f64; 2]], Contact), bodies: &mut Sets, found: &mut Found) {
        let triangles = self.model.triangles.iter().map(|triangle| triangle.map(|corner| corner.0));
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let ends = |bond: &[PointId; 2]| bond.map(|end| end.0);
        let mut bonded: Vec<[u32; 2]> = self.bonds.ends().iter().map(ends).map(lower_first).collect();
        bonded.sort_unstable();
        let skin = triangles::skin(&triangles, bonded.iter().copied());
        let are_bonded = |a: u32, b: u32| bonded.binary_search(&lower_first([a, b])).is_ok();
        let hinged = Hinged::of(places.len(), &triangles, bonded.iter().copied());
        let skins = &self.model.skins;
        let passes = |[a, b]: [u32; 2], [c, d]: [u32; 2]| hinged.pass([a, b], [c, d]) || skins.are_layers([a, b, c, d]);
        let mut sweep = Sweep::new(skin.closed.into_iter().chain(skin.open), places, bodies);
        for k in 0..sweep.patches.len() {
            let own = sweep.patches[k];
            for other in sweep.over(own.left).filter(|other| other.crosses(&own)) {
                let ([a, b], [c, d]) = (own.corners, other.corners);
                // Both diagonals of a cell of a net are meant to cross.
                let is_a_cell = [(a, c), (a, d), (b, c), (b, d)].into_iter().all(|(one, two)| are_bonded(one, two));
                if other.body != own.body && contact.with_others {
                    found.nested.extend([own.body, other.body]);
                } else if other.body == own.body && contact.with_itself && !is_a_cell && !passes([a, b], [c, d]) {
                    found.folded.push(own.body);
                }
            }
        }
    }
}

/// Points by the places `[m]` that they lie in, all of one place together.
pub(super) fn by_place<'a, const D: usize>(
    points: &'a mut [u32],
    position: &'a [[f64; D]],
) -> impl Iterator<Item = &'a [u32]> {
    let place = |point: &u32| position[*point as usize];
    points.sort_unstable_by(|a, b| {
        let axes = place(a).into_iter().zip(place(b)).map(|(x, y)| x.total_cmp(&y));
        axes.fold(Ordering::Equal, Ordering::then)
    });
    points.chunk_by(move |a, b| place(a) == place(b))
}

impl<const N: usize> Sweep<N> {
    fn new(corners: impl Iterator<Item = [u32; N]>, places: &[[f64; 2]], bodies: &mut Sets) -> Self {
        let patch = |corners: [u32; N]| {
            let places = corners.map(|corner| places[corner as usize]);
            let (left, right) = places
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), x| (left.min(x[0]), right.max(x[0])));
            Patch { corners, places, body: bodies.find(corners[0]), left, right }
        };
        let mut patches: Vec<Patch<N>> = corners.map(patch).collect();
        patches.sort_by(|a, b| a.left.total_cmp(&b.left));
        Sweep { patches, open: Vec::new(), next: 0, left: MOST_LOOKS }
    }

    /// The patches over this place, which is on the right of all before, as long as there is an end to looking.
    fn over(&mut self, x: f64) -> impl Iterator<Item = &Patch<N>> {
        while self.patches.get(self.next).is_some_and(|patch| patch.left <= x) {
            self.open.push(self.next);
            self.next += 1;
        }
        self.open.retain(|&k| self.patches[k].right >= x);
        let looks = self.open.len().min(self.left);
        self.left -= looks;
        self.open[..looks].iter().map(|&k| &self.patches[k])
    }
}

impl Patch<2> {
    /// Whether it goes through another edge, their ends apart.
    fn crosses(&self, other: &Self) -> bool {
        let ([a, b], [c, d]) = (self.places, other.places);
        let parts = |from: [f64; 2], to: [f64; 2], [x, y]: [[f64; 2]; 2]| {
            let turns = [x, y].map(|x| cross(sub(to, from), sub(x, from)));
            turns[0].min(turns[1]) < 0.0 && turns[0].max(turns[1]) > 0.0
        };
        !self.corners.iter().any(|end| other.corners.contains(end)) && parts(a, b, [c, d]) && parts(c, d, [a, b])
    }
}
