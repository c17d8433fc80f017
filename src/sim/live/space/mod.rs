//! The live step in space: cloth and ropes that meet planes, balls and boxes, each other and themselves.
//!
//! The phases are those of the plane, and so are its rules of bonds, friction, overlap, settling, energy and sleep. What differs is who
//! meets whom (`detect.rs`): points planes; points, edges and triangles balls and boxes (`obstacle.rs`, `touch.rs`), so that no corner
//! pokes through between points; points triangles (`pair.rs`), from either side. What would pass a triangle is cut (`truncate.rs`).
//! Edges do not meet edges of bodies: where two coarse cloths cross between their points, they hang through each other by less than a
//! cell.

mod body;
mod bonds;
mod calm;
mod cluster;
mod detect;
mod gather;
mod geometry;
mod grid;
mod guard;
mod obstacle;
mod pair;
mod patches;
mod path;
mod rest;
mod substep;
mod touch;
mod truncate;

use super::{Draft, FRAMES};
use crate::sim::account::Account;
use crate::sim::bulk::kernel::Kernel;
use crate::sim::bulk::mover::Mover;
use crate::sim::contact::skin::Contact;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{add, zero};
use body::Bodies;
use cluster::{Cluster, Common};
use obstacle::Solid;
use pair::Sides;
use rest::Rest;
use substep::Outside;

/// Bodies in the live step, in space.
#[derive(Clone, Debug)]
pub(super) struct Space<S: Real> {
    bodies: Bodies<S>,
    contact: Option<Contact>,
    settles: bool,
    sleeps: bool,
    solids: Vec<Solid<S>>,
    /// Which side of a triangle every point near one belongs to.
    sides: Sides,
    /// Of every body.
    rests: Vec<Rest>,
    /// Where bodies were when they were last seen to move, in the order of the bodies.
    anchor: Vec<[S; 3]>,
    /// How much what settles is slowed down `[1/s]`, one a body.
    settling: Vec<S>,
    bond_count: usize,
    /// What constant forces give every point of the group `[m/s^2]`; empty without any.
    thrust: Vec<[S; 3]>,
    /// Slots of what left the finite numbers.
    lost: Vec<u32>,
}

impl<S: Real> Space<S> {
    pub(super) fn new(draft: &Draft<S>, points: &Points<S, 3>, pull: &Pull<S, 3>) -> Self {
        let bodies = Bodies::new(draft, points);
        let count = bodies.list.len();
        Space {
            contact: draft.contact,
            settles: draft.settles,
            sleeps: draft.sleeps,
            solids: pull.contacts.obstacles.convex().iter().map(Solid::new).collect(),
            sides: Vec::new(),
            rests: vec![Rest::default(); count],
            anchor: Vec::new(),
            settling: vec![S::ZERO; count],
            bond_count: draft.bonds.len(),
            thrust: thrust(points, pull),
            lost: Vec::new(),
            bodies,
        }
    }

    /// A step of a cluster, in equal substeps.
    fn run(
        &self,
        cluster: &mut Cluster<S>,
        common: &Common<S>,
        (pull, around): (&Pull<S, 3>, &Environment<3>),
        (t, h): (f64, f64),
    ) {
        let count = (h * FRAMES * f64::from(cluster.substeps(common, pull, around, t))).ceil().max(1.0);
        let moving = cluster.now.iter().copied().zip(cluster.velocity.iter().copied());
        let count = count.max(f64::from(around.parts_near(moving, (t, h))));
        let own = h / count;
        let outside = Outside { pull, around, settling: &self.settling };
        cluster.span = S::from_f64(own);
        let before = guard::energy(cluster, common, around.gravity);
        bonds::prepare(cluster, common, cluster.span);
        detect::look_at_obstacles(cluster, common);
        detect::look_at_skins(cluster, common, common.sides);
        for substep in 0..count as u32 {
            substep::advance(cluster, common, outside, (t + f64::from(substep) * own, own));
        }
        // What is no number any more is not to be shared out.
        if cluster.is_finite() {
            guard::hold(cluster, common, (before, around.gravity));
        }
    }
}

impl<S: Real> Mover<S, 3> for Space<S> {
    fn begin(&mut self, _points: &mut Points<S, 3>, _around: &Environment<3>, _t: f64) {}

    fn step(
        &mut self,
        points: &mut Points<S, 3>,
        pull: &Pull<S, 3>,
        around: &Environment<3>,
        (t, h): (f64, f64),
        counters: &mut Counters,
        account: Option<&mut Account>,
    ) {
        let sides = std::mem::take(&mut self.sides);
        self.wake(points, around, (t, h));
        let mut clusters = {
            let common = Common {
                bodies: &self.bodies,
                solids: &self.solids,
                contact: self.contact.as_ref(),
                planes: pull.contacts.obstacles.planes(),
                sides: &sides,
            };
            let mut clusters = self.gather(points, &common, (pull, around), h);
            clusters.iter_mut().for_each(|cluster| self.run(cluster, &common, (pull, around), (t, h)));
            clusters
        };
        if let Some(account) = account.filter(|_| !clusters.is_empty()) {
            account.book.untold += 1;
        }
        // What left the numbers stays where the step began, with all that went with it.
        for cluster in clusters.extract_if(.., |cluster| !cluster.is_finite()) {
            cluster.count(counters);
            let bodies = cluster.lost().map(|body| self.bodies.list[body].points.range());
            self.lost.extend(bodies.flat_map(|points| &self.bodies.order[points]));
        }
        self.sides = kept(sides, &clusters);
        for cluster in &clusters {
            self.scatter(cluster, points);
            cluster.bodies.iter().for_each(|&body| self.rests[body].is_asleep = false);
            self.settle(cluster, h);
            cluster.count(counters);
            counters.settled += cluster.bodies.iter().filter(|&&body| self.settling[body] > S::ZERO).count() as u64;
        }
        // A gust may come at any time.
        if self.sleeps && pull.gusts().is_none() {
            self.doze(&clusters, points, t + h);
        }
    }

    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    fn reload(&mut self) {}

    fn lag(&self) -> f64 {
        0.0
    }

    fn take_lost(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.lost)
    }

    fn kernel(&self) -> Kernel {
        Kernel::Live
    }

    fn heap_bytes(&self) -> usize {
        let bodies = &self.bodies;
        let links = (bodies.springs.capacity() + bodies.holds.capacity()) * size_of::<super::body::Link<S>>();
        let skins = 12 * bodies.triangles.capacity() + 8 * bodies.edges.capacity() + 4 * bodies.corners.capacity();
        links
            + skins
            + size_of::<S>() * bodies.sizes.capacity()
            + 4 * bodies.order.capacity()
            + self.anchor.capacity() * size_of::<[S; 3]>()
            + 16 * self.sides.capacity()
    }

    fn bonds(&self) -> usize {
        self.bond_count
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, 3>> {
        Box::new(self.clone())
    }
}

/// What constant forces give every point `[m/s^2]`; empty without any. In space they have no torques.
fn thrust<S: Real>(points: &Points<S, 3>, pull: &Pull<S, 3>) -> Vec<[S; 3]> {
    let mut sum = if pull.thrusts.is_empty() { Vec::new() } else { vec![zero(); points.len()] };
    for thrust in &pull.thrusts {
        thrust.each(&points.position, &points.inverse_mass, |i, push| sum[i] = add(sum[i], push));
    }
    sum
}

/// The sides of what moved as they are now, those of what sleeps as they were.
fn kept<S: Real>(sides: Sides, clusters: &[Cluster<S>]) -> Sides {
    if clusters.is_empty() {
        return sides;
    }
    let mut awake: Vec<u32> = clusters.iter().flat_map(|cluster| &cluster.corners).map(|corner| corner.1).collect();
    awake.sort_unstable();
    let is_awake = |key: u64| awake.binary_search(&((key >> 32) as u32)).is_ok();
    let mut list: Sides = sides.into_iter().filter(|side| !is_awake(side.0)).collect();
    clusters.iter().for_each(|cluster| list.extend(detect::known(&cluster.pairs)));
    list.sort_unstable();
    list.dedup_by_key(|side| side.0);
    list
}
