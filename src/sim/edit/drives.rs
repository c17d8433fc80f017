//! Keys that players hold, as drives follow them.

use std::sync::Arc;

use super::recompile::Detached;
use super::{Applied, done};
use crate::sim::bond::PointId;
use crate::sim::drive::{Held, Key, Signal};
use crate::sim::plan;
use crate::sim::real::Real;
use crate::sim::vector::widen;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// A key goes down or up: what it drives wakes.
    pub(super) fn press(&mut self, key: Key, down: bool) -> Applied {
        let t = self.timeline.time();
        let rates = self.rates();
        if !self.around.keys.press(key, down, t, rates.into_iter()) {
            return done(false);
        }
        let driven: Vec<usize> =
            (0..self.plan.groups.len()).filter(|&place| !self.plan.groups[place].pull.driven.is_empty()).collect();
        driven.into_iter().for_each(|place| self.touch(place));
        let World { plan, around, .. } = self;
        plan.groups.iter_mut().for_each(|group| group.wake_if_driven(around, t));
        done(true)
    }

    /// Muscles among detached points whose ends other rigid bonds hold from now on are none any more.
    pub(super) fn leave_out_idle_drives(&mut self, detached: &Detached<S, D>) {
        let among = |point: PointId| detached.place(point.0).is_some();
        // Pins, and what hangs on them elsewhere, are where they were.
        let place = |point: PointId| match detached.place(point.0) {
            Some(k) => widen(detached.state.position[k]),
            None => self.place(point.index()),
        };
        let idle = plan::idle_drives(&self.bonds, among, place);
        if idle.is_empty() {
            return;
        }
        let bonds = Arc::make_mut(&mut self.bonds);
        idle.iter().for_each(|&(place, bond)| bonds.set(place, bond));
        let numbers: Vec<usize> = idle.iter().map(|&(place, _)| self.numbers.of_bond(place) as usize).collect();
        self.warn_of_idle_drives(&numbers);
    }

    /// Drives that came know of the keys that are held already.
    pub(super) fn tell_drives(&mut self) {
        if !self.around.keys.held.is_empty() {
            let (t, rates) = (self.timeline.time(), self.rates());
            self.around.keys.include(rates.into_iter(), t);
        }
    }

    /// The keys of all drives, with the rates at which they come and go `[1/s]`.
    fn rates(&self) -> Vec<(Key, f64)> {
        let mut rates: Vec<(Key, f64)> = Vec::new();
        let pairs = self.signals().filter_map(|signal| signal.held);
        for pair in pairs.flat_map(|held| held.keys().map(move |key| (key, held.rate))) {
            if !rates.contains(&pair) {
                rates.push(pair);
            }
        }
        rates
    }

    fn signals(&self) -> impl Iterator<Item = Signal> {
        let angles = self.model.angles.list.iter().filter_map(|angle| angle.drive);
        self.bonds.drives().map(|drive| drive.signal).chain(angles.map(|drive| drive.signal()))
    }

    /// The keys that drives of this world have, ascending.
    pub(in crate::sim) fn keys_of_drives(&self) -> Vec<Key> {
        // What bonds were made of before stays in their table.
        let is_driven = self.bonds.drives().next().is_some();
        let bonds = self.bonds.iter().filter(|_| is_driven).filter_map(|bond| bond.drive).map(|drive| drive.signal);
        let angles = self.model.angles.list.iter().filter_map(|angle| angle.drive).map(|drive| drive.signal());
        let mut keys: Vec<Key> = bonds.chain(angles).filter_map(|signal| signal.held).flat_map(Held::keys).collect();
        keys.sort_unstable();
        keys.dedup();
        keys
    }
}
