//! Rigid bodies: what rigid bonds hold in its shape has three degrees of freedom in the plane, whatever it is made of; in space it has six
//! (`space/`).
//!
//! ```text
//! read       place, angle, velocity and spin from the points: best fit, momentum and angular momentum
//! part       of the step: all of it in flight, shorter near surfaces, under the mouse, on a pin
//! flight     in closed form, or a composition of order 4 (`body.rs`)
//! hit        the moment when a point gets to a surface is located (`course.rs`, `touch.rs`); the impact is Coulomb's law (`contact.rs`)
//! rest       what lies on surfaces slides, rolls, tips or stays (`slide.rs`); where sliding ends is located
//! joined     bodies that share points, or that bonds join, are solved together: flight and rest (`moving.rs`), impacts (`together.rs`); strings between them are contacts (`strings.rs`)
//! write      points follow, once a step
//! ```
//!
//! Nothing is kept between steps but the points themselves: any copy goes on with the same bits.

mod alone;
pub(crate) mod blueprint;
mod body;
mod contact;
mod course;
mod fall;
mod field;
pub(crate) mod holding;
mod hull;
pub(crate) mod inertia;
mod joined;
pub(crate) mod joints;
pub(crate) mod link;
mod linkage;
mod meeting;
mod merge;
pub(crate) mod motion;
mod moving;
pub(crate) mod pieces;
pub(crate) mod place;
pub(crate) mod shape;
mod slide;
mod solid;
pub(crate) mod space;
mod strings;
pub(crate) mod ties;
mod together;
mod touch;

use std::sync::Arc;

use super::account::Account;
use super::bulk::kernel::Kernel;
use super::bulk::mover::Mover;
use super::counters::Counters;
use super::environment::Environment;
use super::points::Points;
use super::pull::Pull;
use super::real::Real;
use super::swept::{Span, Swept};
use super::vector::add;
use alone::Lone;
use blueprint::Blueprint;
use body::Body;
use course::{Log, advance};
use field::{Field, is_reached};
use link::{Clock, are_led};
use linkage::Linkage;
use motion::Motion;
use moving::Moving;
use solid::{Solid, lift};
use ties::Ties;

/// Rigid bodies that step together, alone or joined.
#[derive(Clone, Debug)]
pub(crate) struct Rigid {
    linkages: Arc<[Linkage]>,
    /// Bonds that they are made of.
    bonds: usize,
    /// Points of those that left the finite numbers: they are where their step began.
    lost: Vec<u32>,
    /// When springs broke in the step under way `[s]`, and which bonds of the world those are.
    broken: Option<(f64, Vec<u32>)>,
    /// Work that the next step may take, and when the last one ended early for that `[s]`.
    most_work: u64,
    gave_up: Option<f64>,
}

impl Rigid {
    /// Of plans, each with the places of its points in the group and springs between its bodies, made of so many bonds.
    pub(crate) fn new(plans: Vec<(Arc<Blueprint>, Vec<u32>, Ties)>, bonds: usize) -> Self {
        let linkages = plans.into_iter().map(|(plan, slots, ties)| Linkage::new(&plan, &slots, ties)).collect();
        Rigid { linkages, bonds, lost: Vec::new(), broken: None, most_work: u64::MAX, gave_up: None }
    }

    fn bodies(&self) -> impl Iterator<Item = &Body> {
        self.linkages.iter().flat_map(|linkage| &linkage.bodies)
    }
}

impl<S: Real, const D: usize> Mover<S, D> for Rigid {
    /// Points that are elsewhere get the places that the shape has for them.
    fn begin(&mut self, points: &mut Points<S, D>, around: &Environment<D>, t: f64) {
        let clock = Clock { time: t, keys: &around.keys };
        for linkage in self.linkages.iter() {
            linkage.stop(points);
            let motions = linkage.read(points, (&linkage.anchors(points), clock));
            let fits = |(body, motion): (&Body, &Motion)| body.fits(motion, points);
            if !linkage.bodies.iter().zip(&motions).all(fits) {
                linkage.bodies.iter().zip(&motions).for_each(|(body, motion)| body.write(motion, points));
            }
        }
    }

    fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
        account: Option<&mut Account>,
    ) {
        let mut book = account.map(|account| &mut account.book);
        for linkage in self.linkages.iter() {
            let anchors = linkage.anchors(points);
            let motions = linkage.read(points, (&anchors, Clock { time: t, keys: &around.keys }));
            let is_driven = linkage.is_driven();
            if let Some(book) = book.as_deref_mut().filter(|_| is_driven || !anchors.is_empty()) {
                // A pin that changes its velocity, or stops, passes that on at once, and so does a drive that begins.
                let given = linkage.energy_of(&motions) - linkage.energy(points);
                let by = if is_driven && !are_led(&anchors) { &mut book.drives } else { &mut book.pins };
                *by += given;
            }
            let mut all = linkage.bodies.iter().zip(&motions);
            let is_reached = all.any(|of| is_reached(of, (pull, around), (t, h)));
            let field = Field { pull, around, w: &points.inverse_mass, is_reached };
            let slots = || linkage.bodies.iter().flat_map(|body| &body.slots).map(|&slot| slot as usize);
            let moving = || slots().map(|i| (points.position[i], points.velocity[i]));
            let parts = if is_reached { around.parts_near(moving(), (t, h)) } else { 1 };
            let mut log = Log::new(book.as_deref_mut());
            // Of several none can be ahead of the others.
            let locates = self.linkages.len() == 1;
            log.most_work = if locates { self.most_work } else { u64::MAX };
            let most = h / f64::from(parts);
            let ends = match linkage.alone() {
                Some(body) => {
                    let span = (t, h, body.longest(&field, h).min(most));
                    let lone = Lone::new(body, &field, &motions[0]);
                    let end = advance(&lone, motions[0], span, &mut log);
                    log.work += lone.spent();
                    vec![end]
                }
                None => {
                    let joined = Moving::new(linkage, &field, (&anchors, t), &motions, locates);
                    let span = (t, h, joined.longest(h).min(most));
                    let ends = advance(&joined, motions, span, &mut log);
                    log.work += joined.take_spent();
                    if let Some(gone) = log.broke {
                        self.broken = Some((t + gone, linkage.ties.broken(joined.stand(&ends, t + gone))));
                    }
                    ends
                }
            };
            let count = slots().count() as u64;
            if ends.iter().all(Motion::is_finite) {
                linkage.bodies.iter().zip(&ends).for_each(|(body, end)| body.write(end, points));
                linkage.stop(points);
                linkage.lead(points, &anchors, log.broke.or(log.gave_up).unwrap_or(h));
            } else {
                self.lost.extend(linkage.bodies.iter().flat_map(|body| &body.slots));
            }
            self.gave_up = log.gave_up.map(|gone| t + gone);
            counters.substeps += 1;
            counters.points_moved += count;
            counters.mouse_points += if is_reached { count } else { 0 };
            counters.events += log.hits;
            counters.work += 60 * count + log.work;
        }
    }

    fn lose(&mut self, _ends: [u32; 2], _rest: f64) -> bool {
        false
    }

    fn reload(&mut self) {}

    fn lag(&self) -> f64 {
        0.0
    }

    /// A body that spins leaves the straight ways of its points: it stays in a circle around its middle. Bodies that joints hold together are
    /// one for those who ask what meets.
    fn reaches(&self, points: &Points<S, D>, span: Span) -> Vec<Swept<S, D>> {
        let swept = |body: &Body| {
            let Motion { place, twist } = body.read(points);
            let bent = Span { pushed: span.pushed + twist.spin * twist.spin * body.reach, ..span };
            let at = |&slot: &u32| (points.position[slot as usize], points.velocity[slot as usize]);
            let tight = Swept::new(body.slots.iter().map(at), bent, S::ZERO)?;
            let corner = |sign: f64| {
                let x = add(place.middle, [sign * body.reach; 2]);
                (lift(x), lift(twist.velocity))
            };
            let round = Swept::new([-1.0, 1.0].map(corner).into_iter(), span, S::ZERO)?;
            Some(tight.or_smaller(round))
        };
        let all = |linkage: &Linkage| {
            let joined = linkage.bodies.iter().filter_map(swept).reduce(Swept::with)?;
            Some(if linkage.anchors(points).is_empty() { joined } else { joined.held() })
        };
        self.linkages.iter().filter_map(all).collect()
    }

    fn take_lost(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.lost)
    }

    fn take_broken(&mut self) -> Option<(f64, Vec<u32>)> {
        self.broken.take()
    }

    fn bound(&mut self, work: u64) {
        self.most_work = work;
    }

    fn take_gave_up(&mut self) -> Option<f64> {
        self.gave_up.take()
    }

    fn kernel(&self) -> Kernel {
        let are_alone = self.linkages.iter().all(|linkage| linkage.alone().is_some());
        let count = self.bodies().count();
        if are_alone { Kernel::Rigid(count) } else { Kernel::Joined(count) }
    }

    fn heap_bytes(&self) -> usize {
        self.linkages.iter().map(Linkage::heap_bytes).sum()
    }

    fn bonds(&self) -> usize {
        self.bonds
    }

    fn boxed_clone(&self) -> Box<dyn Mover<S, D>> {
        Box::new(self.clone())
    }
}
