//! Islands that may meet something in the coming step go to the live step: all that may touch each other together.

use crate::sim::bulk::mover::Part;
use crate::sim::contact::skin::{MOST_RADIUS, RADIUS};
use crate::sim::group::Group;
use crate::sim::group::engine::Engine;
use crate::sim::moved::{Moved, Why};
use crate::sim::plan::{OWN, Sets};
use crate::sim::real::Real;
use crate::sim::swept::{self, Span, Swept};
use crate::sim::vector::{length, widen};
use crate::sim::world::World;

/// What follows within this time goes along: lists are made anew less often `[s]`.
const SOON: f64 = 0.05;
/// How long what is live has to stay apart from all else to go back `[s]`.
const APART: f64 = 0.1;
/// What is left between skins that do not touch yet, as a share of the mean bond.
const GAP: f64 = 0.05;

/// The place of what does not move by itself.
const FIXED: usize = usize::MAX;

/// Where a body may get to.
struct Reach<const D: usize> {
    /// Of its group.
    place: usize,
    /// What hangs together with it, pins included; of what is fixed, and of others where something is.
    root: u32,
    swept: Swept<f64, D>,
    is_awake: bool,
    /// Points without bonds, which do not meet each other.
    is_loose: bool,
}

impl<const D: usize> Reach<D> {
    /// Whether they may meet, if they come near each other.
    fn may_meet(&self, other: &Self) -> bool {
        self.place != other.place && self.may_touch(other)
    }

    /// The same of two that may go together already.
    fn may_touch(&self, other: &Self) -> bool {
        let is_own_pin = (self.place == FIXED || other.place == FIXED) && self.root == other.root;
        let are_bodies = !(self.is_loose && other.is_loose);
        are_bodies && !is_own_pin && (self.is_awake || other.is_awake)
    }

    /// Whether what meets the one meets the other as well, with nothing else to be done: they are of one group, or have just been put together.
    fn stands_for(&self, other: &Self, have_met: bool) -> bool {
        let are_one = self.place == other.place && self.root == other.root;
        let are_together = have_met && self.place != FIXED && other.place != FIXED;
        let are_alike = self.is_loose == other.is_loose && self.is_awake == other.is_awake;
        are_alike && (are_one || are_together)
    }

    /// Whether it may strike the other one, so that this one goes on.
    fn may_strike(&self, other: &Self) -> bool {
        other.place != FIXED && self.may_touch(other)
    }
}

impl<S: Real, const D: usize> World<S, D> {
    /// Before a step: what may meet something in it goes live.
    pub(crate) fn meet(&mut self) {
        let is_between = self.kept.is_empty() && self.timeline.is_between_steps();
        if !self.model.meets_on_demand() || !is_between || self.plan.groups.iter().all(Group::is_asleep) {
            return;
        }
        let (t, h) = (self.timeline.time(), self.timeline.substep());
        let count = self.plan.groups.len();
        if self.fixtures.0 != Some(self.topology) {
            self.fixtures = (Some(self.topology), self.fixtures().into());
        }
        let roots = self.roots();
        let mut goes: Vec<bool> = (0..count).map(|place| self.meets_itself(place, h)).collect();
        let mut reaches = self.reaches(h, roots.as_deref());
        self.mark_corners(&reaches, &mut goes);
        let mut sets = Sets::new(count);
        let is_live = |place: usize| self.plan.groups[place].is_live();
        let meets_others = self.model.contact.is_some_and(|contact| contact.with_others);
        if meets_others {
            swept::pass_on(&mut reaches, swept_of, |reach, grown| reach.swept = self.settled(grown), Reach::may_strike);
            sweep(&reaches, |a, b| join(&mut sets, &mut goes, [a, b], is_live));
        }
        if !goes.contains(&true) {
            return;
        }
        // What follows soon goes along.
        let mut soon = self.reaches(h + SOON, roots.as_deref());
        soon.retain(|reach| reach.place != FIXED && reach.is_awake);
        if meets_others {
            swept::sort(&mut soon, swept_of);
            sweep(&soon, |a, b| sets.join(a.place as u32, b.place as u32));
        }
        let mut groups: Vec<Vec<usize>> = vec![Vec::new(); count];
        let mut is_due = vec![false; count];
        for place in (0..count).filter(|&place| self.plan.groups[place].points.len() > 0) {
            let first = sets.find(place as u32) as usize;
            is_due[first] |= goes[place];
            groups[first].push(place);
        }
        let due: Vec<Vec<usize>> =
            groups.into_iter().zip(is_due).filter(|(_, due)| *due).map(|(group, _)| group).collect();
        for group in due {
            let is_new = |place: &&usize| !self.plan.groups[**place].is_live();
            self.counters.hand_overs += group.iter().filter(is_new).count() as u64;
            self.go_together(&group, t);
        }
        self.gather();
    }

    /// The live step moves groups from `t` on `[s]`, all together.
    fn go_together(&mut self, places: &[usize], t: f64) {
        let firsts: Vec<u32> = self.firsts_of(places).into_iter().map(|(_, first)| first).collect();
        let mut detached = self.detach_at(&firsts, false, t);
        let new = |moved: &Moved| {
            if moved.is_handed_over() { *moved } else { moved.handed_over(t, Why::Contact) }
        };
        detached.moved.iter_mut().for_each(|moved| *moved = new(moved).kept_until_apart(t));
        detached.are_together = true;
        self.was_handed_over = true;
        self.put_back(detached);
    }

    /// What of a live group may go back to its own method: a number for every slot, [`OWN`] for what goes; `None`: nothing may, or has to be
    /// divided.
    pub(super) fn parted(&self, place: usize) -> Option<Vec<u32>> {
        let group = &self.plan.groups[place];
        if !self.model.meets_on_demand() {
            return Some(Vec::new());
        }
        let Engine::Bulk(mover) = &group.engine else { return None };
        let parts = mover.parts(&group.points, &group.pull, &self.around, APART);
        let mut numbers = vec![OWN; group.points.len()];
        for (Part { slots, is_free }, number) in parts.iter().zip(0..) {
            let is_free = *is_free && !self.is_cornered(group, slots);
            slots.iter().for_each(|&slot| numbers[slot as usize] = if is_free { OWN } else { number });
        }
        let stays = parts.len() == 1 && numbers.iter().any(|&number| number != OWN);
        (!stays).then_some(numbers)
    }

    /// Whether corners of obstacles are near points of a group, or fixed bodies.
    fn is_cornered(&self, group: &Group<S, D>, slots: &[u32]) -> bool {
        let own = slots.iter().map(|&slot| slot as usize);
        let (span, margin) = (group.pull.span(&self.around, APART), S::from_f64(self.margin(group)));
        let Some(swept) = Swept::of(&group.points, own, span, margin) else { return false };
        let swept = self.settled(swept.widen());
        self.obstacles.has_corner_in(swept.bounds())
            || self.fixed_reaches(APART, None).iter().any(|fixed| fixed.swept.meets(&swept))
    }

    /// Whether a group that its own method moves may meet itself within `h` `[s]`.
    fn meets_itself(&mut self, place: usize, h: f64) -> bool {
        let group = &mut self.plan.groups[place];
        !group.is_live() && !group.is_asleep() && group.meets_itself(h)
    }

    /// Where bodies may get to within `h` `[s]`, those that do not move by themselves as well.
    fn reaches(&self, h: f64, roots: Option<&[u32]>) -> Vec<Reach<D>> {
        let mut reaches = self.own_reaches(h, roots);
        reaches.extend(self.fixed_reaches(h, roots));
        reaches
    }

    fn own_reaches(&self, h: f64, roots: Option<&[u32]>) -> Vec<Reach<D>> {
        let mut reaches = Vec::with_capacity(self.plan.groups.len());
        let root_of: Vec<u32> = match roots {
            Some(roots) => {
                let mut of = vec![0; self.plan.groups.len()];
                self.lowest().into_iter().for_each(|(place, point)| of[place] = roots[point.index()]);
                of
            }
            None => vec![0; self.plan.groups.len()],
        };
        // What rows hold between pins is there to be met, though it does not move.
        let groups = self.plan.groups.iter().enumerate();
        for (place, group) in groups.filter(|(place, _)| self.plan.own[*place].points > 0) {
            let span = group.pull.span(&self.around, h);
            let reach = |swept: Swept<S, D>| Reach {
                place,
                root: root_of[place],
                swept: self.settled(swept.widen()),
                is_awake: !group.is_asleep(),
                is_loose: self.plan.own[place].bonds == 0,
            };
            if let Engine::Bulk(mover) = &group.engine {
                let margin = if group.is_live() { S::ZERO } else { S::from_f64(self.margin(group)) };
                let swept = mover.reaches(&group.points, span);
                if group.is_live() || !swept.is_empty() {
                    reaches.extend(swept.into_iter().map(|swept| reach(swept.around(margin))));
                    continue;
                }
            }
            let slots = 0..group.points.len();
            reaches.extend(Swept::of(&group.points, slots, span, S::from_f64(self.margin(group))).map(reach));
        }
        reaches
    }

    /// Held, if an obstacle may throw it back.
    fn settled(&self, swept: Swept<f64, D>) -> Swept<f64, D> {
        swept.settled(|bounds| self.obstacles.may_touch(bounds.map(|x| x.map(S::from_f64))))
    }

    /// How far from the points of a group it may be met `[m]`.
    fn margin(&self, group: &Group<S, D>) -> f64 {
        let edge = group.watch.as_ref().map_or(0.0, |watch| watch.edge);
        let said = self.model.contact.and_then(|contact| contact.radius).into_iter();
        let radius = said.chain(self.model.skins.widest()).reduce(f64::max).unwrap_or(RADIUS * edge);
        radius.min(if edge > 0.0 { MOST_RADIUS * edge } else { f64::INFINITY }) + GAP * edge
    }

    /// The boxes of bodies that are pinned all over, and of pins that nothing hangs on.
    fn fixed_reaches(&self, h: f64, roots: Option<&[u32]>) -> Vec<Reach<D>> {
        let root = |pin: u32| roots.map_or(pin, |roots| roots[pin as usize]);
        let mut by_root: Vec<(u32, u32)> = self.fixtures.1.iter().map(|&pin| (root(pin), pin)).collect();
        by_root.sort_unstable();
        let of = |pins: &[(u32, u32)]| {
            let points = pins.iter().map(|&(_, pin)| (self.place(pin as usize), self.led(pin)));
            let is_awake = points.clone().any(|(_, velocity)| velocity != [0.0; D]);
            let span = Span { h, fall: length(self.around.gravity), pushed: 0.0 };
            let swept = Swept::new(points, span, 0.0)?.staying();
            Some(Reach { place: FIXED, root: pins[0].0, swept, is_awake, is_loose: false })
        };
        by_root.chunk_by(|a, b| a.0 == b.0).filter_map(of).collect()
    }

    /// How fast a pin is led `[m/s]`.
    fn led(&self, pin: u32) -> [f64; D] {
        let slot = self.slot(pin as usize);
        slot.map_or([0.0; D], |[place, slot]| widen(self.plan.groups[place].points.velocity[slot]))
    }

    /// What hangs together by bonds and triangles, pins included: a number for every point; `None` where nothing is fixed.
    fn roots(&self) -> Option<Vec<u32>> {
        if self.fixtures.1.is_empty() {
            return None;
        }
        let mut sets = Sets::new(self.count());
        self.bonds.ends().iter().for_each(|[a, b]| sets.join(a.0, b.0));
        for [a, b, c] in &self.model.triangles {
            sets.join(a.0, b.0);
            sets.join(b.0, c.0);
        }
        Some((0..self.count() as u32).map(|point| sets.find(point)).collect())
    }

    /// Marks groups that corners of obstacles are near: their bonds may meet these, which their own methods do not know.
    fn mark_corners(&self, reaches: &[Reach<D>], goes: &mut [bool]) {
        let of = |reach: &&Reach<D>| {
            let can = reach.place != FIXED && reach.is_awake && !reach.is_loose;
            can && !goes[reach.place] && !self.plan.groups[reach.place].is_live()
        };
        let found: Vec<usize> = reaches
            .iter()
            .filter(of)
            .filter(|reach| self.obstacles.has_corner_in(reach.swept.bounds()))
            .map(|reach| reach.place)
            .collect();
        found.into_iter().for_each(|place| goes[place] = true);
    }
}

/// Two bodies come near each other: what moves by itself goes together, and who is not live goes live.
fn join<const D: usize>(sets: &mut Sets, goes: &mut [bool], [a, b]: [&Reach<D>; 2], is_live: impl Fn(usize) -> bool) {
    for place in [a.place, b.place].into_iter().filter(|&place| place != FIXED) {
        // Two live groups become one.
        goes[place] |= !is_live(place) || (a.place != FIXED && b.place != FIXED);
    }
    if a.place != FIXED && b.place != FIXED {
        sets.join(a.place as u32, b.place as u32);
    }
}

/// Tells of those in a sorted list that may meet, but for what others stand for.
fn sweep<const D: usize>(reaches: &[Reach<D>], mut tell: impl FnMut(&Reach<D>, &Reach<D>)) {
    let tell = |couple: [usize; 2]| {
        let [a, b] = couple.map(|place| &reaches[place]);
        let meets = a.may_meet(b);
        if meets {
            tell(a, b);
        }
        a.stands_for(b, meets)
    };
    swept::chains(reaches, swept_of, |reach| reach.is_loose, tell);
}

fn swept_of<const D: usize>(reach: &Reach<D>) -> &Swept<f64, D> {
    &reach.swept
}
