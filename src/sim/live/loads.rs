//! What presses in one substep presses in the next: contacts of rigid bodies begin with the loads of the one before.
//!
//! Passes over contacts have to find only what has changed, however many bodies lie on each other: without that what lies below bears too little,
//! and a heap creeps apart for ever.
//! Source: E. Catto, Iterative Dynamics with Temporal Coherence, 2005 (warm starting).

use super::build::Bodies;
use super::cluster::{Cluster, Common};
use super::detect;
use super::pair::{OnPlane, Pair};
use crate::sim::real::Real;

/// What presses and what rubs `[N]`.
pub(super) type Load<S> = [S; 2];

/// Loads of contacts by the numbers of both sides, ascending.
pub(super) type Loads<S> = Vec<(u64, Load<S>)>;

/// The load that pushes `[kg m]` were of two that came with a speed `[m/s]`, in a substep in which a push was a force by a factor `[1/s^2]` and what
/// came faster than a speed bounced. A blow is none: it is over.
#[inline(always)]
pub(super) fn load<S: Real>(pushes: [S; 2], approach: S, (rate, least): (S, S)) -> Load<S> {
    if approach < -least { [S::ZERO; 2] } else { pushes.map(|push| push * rate) }
}

impl<S: Real> Cluster<S> {
    /// The number of a point on a plane or a circle for ever.
    fn key(&self, bodies: &Bodies<S>, on: &OnPlane<S>) -> u64 {
        u64::from(detect::number(self, bodies, on.p)) << 32 | u64::from(!on.surface)
    }

    /// The force that a push `[kg m]` of the last substep was `[1/s^2]`.
    pub(super) fn load_of_a_push(&self) -> S {
        let square = self.pressed_in * self.pressed_in;
        if square > S::ZERO { S::ONE / square } else { S::ZERO }
    }

    /// The loads of the last substep, or of those before it.
    pub(super) fn loads(&self, bodies: &Bodies<S>) -> Loads<S> {
        if self.is_one.is_empty() {
            return Vec::new();
        }
        let last = (self.load_of_a_push(), self.least_bounce);
        let of_pair = |pair: &Pair<S>| (pair.key, pair.contact.load_after(last));
        let of_plane = |on: &OnPlane<S>| (self.key(bodies, on), on.contact.load_after(last));
        let pairs = self.pairs.iter().filter(|pair| self.is_between_firm(pair)).map(of_pair);
        let planes = self.on_planes.iter().filter(|on| self.is_firm(on.p as usize)).map(of_plane);
        let mut list: Loads<S> = pairs.chain(planes).filter(|load| load.1[0] > S::ZERO).collect();
        list.sort_unstable_by_key(|load| load.0);
        list
    }

    /// Contacts that were found anew bear what they bore.
    pub(super) fn load_again(&mut self, common: &Common<S>, loads: Loads<S>) {
        let loads = if self.counts.substeps == 0 { common.loads } else { &loads };
        if loads.is_empty() {
            return;
        }
        let of = |key: u64| {
            let found = loads.binary_search_by_key(&key, |load| load.0).ok();
            found.map_or([S::ZERO; 2], |found| loads[found].1)
        };
        self.pairs.iter_mut().for_each(|pair| pair.contact.load = of(pair.key));
        let mut on_planes = std::mem::take(&mut self.on_planes);
        for on in &mut on_planes {
            on.contact.load = of(self.key(common.bodies, on));
        }
        self.on_planes = on_planes;
    }
}
