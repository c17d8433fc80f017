//! What is told of bodies that meet so many others that it takes long, and of those that meet none.

use super::World;
use super::nested::by_place;
use crate::sim::real::Real;

/// Points of bodies in one place from which on it is said how long that takes: a frame of 5,000 takes half a second.
const CROWD: usize = 3_000;

impl<S: Real, const D: usize> World<S, D> {
    /// Tells of a place `[m]` with more points of bodies that meet than a frame has time for.
    pub(super) fn warn_of_crowds(&mut self, position: &[[f64; D]]) {
        if self.model.contact.is_none() {
            return;
        }
        let mut points = self.in_bonds();
        self.tell_of_crowd(&mut points, position);
    }

    /// The same of points from `first` on, which just came: of others that lie where they do, and nowhere else.
    pub(crate) fn warn_of_new_crowds(&mut self, first: u32) {
        if self.model.contact.is_none() || self.count() < CROWD {
            return;
        }
        let (points, is_new) = (self.in_bonds(), |point: &&u32| **point >= first);
        let places = |point: &u32| self.place(*point as usize);
        let came = points.iter().filter(is_new).map(places);
        let [low, high] = came.fold([[f64::INFINITY; D], [f64::NEG_INFINITY; D]], |[low, high], x| {
            [std::array::from_fn(|k| low[k].min(x[k])), std::array::from_fn(|k| high[k].max(x[k]))]
        });
        let is_among = |x: &[f64; D]| (0..D).all(|k| (low[k]..=high[k]).contains(&x[k]));
        let near: Vec<[f64; D]> = points.iter().map(places).filter(is_among).collect();
        let mut numbers: Vec<u32> = (0..near.len() as u32).collect();
        self.tell_of_crowd(&mut numbers, &near);
    }

    /// The points that bonds hold, ascending.
    fn in_bonds(&self) -> Vec<u32> {
        let mut is_held = vec![false; self.count()];
        self.bonds.ends().iter().flatten().for_each(|end| is_held[end.index()] = true);
        (0..self.count() as u32).filter(|point| is_held[*point as usize]).collect()
    }

    fn tell_of_crowd(&mut self, points: &mut [u32], position: &[[f64; D]]) {
        let most = by_place(points, position).map(<[u32]>::len).max();
        if let Some(most) = most.filter(|most| *most >= CROWD) {
            self.tell_once(
                most,
                "points lie in one place, where each may meet all others, so a frame takes long: spread them out",
            );
        }
    }

    /// Tells of so many of something, unless that was told already, of however many.
    fn tell_once(&mut self, count: usize, words: &str) {
        let is_told = |told: &String| told.split_once(' ').is_some_and(|(_, rest)| rest == words);
        if !self.warnings.iter().any(is_told) {
            self.warnings.push(format!("{count} {words}"));
        }
    }

    /// Tells of bodies in space without triangles, which meet no others of their kind.
    pub(crate) fn warn_of_bare_bodies(&mut self) {
        if D != 3 || self.model.contact.is_none_or(|contact| !contact.with_others) {
            return;
        }
        let mut bodies = self.bonded();
        let mut skinned: Vec<u32> = self.model.triangles.iter().map(|[corner, ..]| bodies.find(corner.0)).collect();
        skinned.sort_unstable();
        let mut bare: Vec<u32> = self.bonds.ends().iter().map(|[end, _]| bodies.find(end.0)).collect();
        bare.sort_unstable();
        bare.dedup();
        bare.retain(|body| skinned.binary_search(body).is_err());
        if bare.len() > 1 {
            let words = "bodies without triangles pass each other, for in space edges do not meet edges: give those that are to meet a skin";
            self.tell_once(bare.len(), words);
        }
    }
}
