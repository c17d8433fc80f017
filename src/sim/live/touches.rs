//! Contacts of bodies that move as one, with each other and with what does not give way: solved on the motions of the bodies.
//!
//! Where two touch and how they are pressed there changes little within a substep: it is worked out once, and a pass takes a few products for each
//! contact, however many points a body has. Each begins with what it bore in the substep before (`loads.rs`).
//! Source: E. Catto, Iterative Dynamics with Temporal Coherence, 2005.

use super::cluster::{Cluster, Common};
use super::contact::Contact;
use super::pair::{Beside, OnPlane, Pair, beside, left};
use super::rigid::{AT_ONCE, Frame, Shift};
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, cross, dot, scale, sub, widen};

/// Counted work of a contact that is looked at, and of one in a pass.
const LOOKED: u64 = 300;
const PRESSED: u64 = 60;

/// Passes where nothing else moves bodies meanwhile: so many contacts in all of them together, but no fewer and no more than these; and what the last
/// one may change, as a share of how far gravity takes a body in a substep, and of how far the fastest gets. Of nine heaps of sixty to a hundred
/// boxes two crept on for more than ten seconds by 8 passes and 0.02, and none by these.
const ALL_PASSES: usize = 20_000;
const PASSES: [usize; 2] = [16, 64];
const STEADY: [f64; 2] = [1e-3, 1e-4];

/// What touches in a substep.
#[derive(Clone, Debug, Default)]
pub(super) struct Touches<S> {
    list: Vec<Touch>,
    /// What contacts have changed of each body, and of what does not move, which is last.
    moves: Vec<Moves>,
    /// Contacts with planes, which are put back.
    planes: Vec<OnPlane<S>>,
    /// Bodies are not moved by anything else meanwhile.
    pub(super) is_alone: bool,
    /// What the last pass may change `[m]`.
    steady: f64,
}

/// How contacts move a body within a substep.
#[derive(Clone, Copy, Debug, Default)]
struct Moves {
    /// What becomes speed, and what it is led elsewhere by.
    way: Shift,
    led: Shift,
    /// Both, as they were as the contacts were found.
    from: [Shift; 2],
}

impl Moves {
    fn since(&self, before: &Self) -> Self {
        Moves { way: self.way.less(&before.way), led: self.led.less(&before.led), ..*self }
    }
}

/// What a contact is.
#[derive(Clone, Copy, Debug)]
enum Of {
    /// A pair of the cluster, by its number, and the share of the edge at which they touch.
    Pair(u32, f64),
    /// A point on a plane, by its place among those.
    Plane(u32),
}

/// One of the two that touch.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Its place among the moves.
    body: usize,
    /// Of mass `[1/kg]` and moment of inertia `[1/(kg m^2)]`; 0 of what does not move.
    inverse: [f64; 2],
    /// Arms of pushes along the normal and along the tangent `[m]`.
    arms: [f64; 2],
}

impl Side {
    /// What does not move, whose place among the moves is this.
    fn still(body: usize) -> Self {
        Side { body, inverse: [0.0; 2], arms: [0.0; 2] }
    }

    fn weights(&self) -> [f64; 2] {
        let [ease, swing] = self.inverse;
        self.arms.map(|arm| ease + arm * arm * swing)
    }
}

/// A contact as it is solved.
#[derive(Clone, Copy, Debug)]
struct Touch {
    of: Of,
    sides: [Side; 2],
    /// From the edge to the point, and along the edge.
    axes: [[f64; 2]; 2],
    /// One over what a push along these changes `[kg]`.
    masses: [f64; 2],
    /// How far apart they are as the passes begin, beyond the distance that they keep, and their ways away from each other and along `[m]`.
    room: f64,
    ways: [f64; 2],
    /// What they overlapped before, and by how much that is mended at once `[m]`.
    overlap: f64,
    mended: f64,
    /// Normal speed at the start of the substep `[m/s]`.
    approach: f64,
    friction: f64,
    pressed: f64,
    rubbed: f64,
    old: f64,
    is_met: bool,
}

impl Touch {
    /// The places of both among the moves.
    #[inline(always)]
    fn bodies(&self) -> [usize; 2] {
        [self.sides[0].body, self.sides[1].body]
    }

    /// By how much motions change the distance and the way along.
    #[inline(always)]
    fn by(&self, [one, other]: [&Shift; 2]) -> [f64; 2] {
        let way = sub(one.way, other.way);
        let [p, e] = &self.sides;
        let along = |k: usize| dot(self.axes[k], way) + p.arms[k] * one.turn - e.arms[k] * other.turn;
        [along(0), along(1)]
    }

    /// A push `[kg m]` along normal and tangent.
    #[inline(always)]
    fn push(&self, [one, other]: [&mut Shift; 2], [out, aside]: [f64; 2]) {
        let push = add(scale(self.axes[0], out), scale(self.axes[1], aside));
        let [p, e] = &self.sides;
        one.way = add(one.way, scale(push, p.inverse[0]));
        one.turn += p.inverse[1] * (p.arms[0] * out + p.arms[1] * aside);
        other.way = sub(other.way, scale(push, e.inverse[0]));
        other.turn -= e.inverse[1] * (e.arms[0] * out + e.arms[1] * aside);
    }

    /// They meet for the first time in the substep: what they overlapped before is mended a little, without speed.
    fn meet(&mut self, moves: &mut [Moves]) {
        self.is_met = true;
        if self.overlap > 0.0 {
            self.old = self.overlap - self.mended;
            let [p, e] = self.bodies();
            let (mut one, mut other) = (moves[p].led, moves[e].led);
            self.push([&mut one, &mut other], [self.mended * self.masses[0], 0.0]);
            (moves[p].led, moves[e].led) = (one, other);
        }
    }

    /// Begins with what it bore before.
    fn bear(&mut self, moves: &mut [Moves], [out, aside]: [f64; 2]) {
        self.meet(moves);
        (self.pressed, self.rubbed) = (out, aside);
        self.give(moves, [out, aside]);
    }

    #[inline(always)]
    fn give(&self, moves: &mut [Moves], push: [f64; 2]) {
        let [p, e] = self.bodies();
        let (mut one, mut other) = (moves[p].way, moves[e].way);
        self.push([&mut one, &mut other], push);
        (moves[p].way, moves[e].way) = (one, other);
    }

    /// The contact that it stands for knows what pressed it.
    fn tell<S: Real>(&self, contact: &mut Contact<S>) {
        [contact.pressed, contact.rubbed, contact.approach, contact.old] =
            [self.pressed, self.rubbed, self.approach, self.old].map(S::from_f64);
        contact.is_met = self.is_met;
    }

    /// Parts the two where they are nearer than they may be, and rubs them: the law of `contact.rs` by masses that are known. Returns by how
    /// much more or less than before `[m]`.
    #[inline(always)]
    fn press(&mut self, moves: &mut [Moves]) -> f64 {
        let [p, e] = self.bodies();
        let [out, along] = self.by([&moves[p].way, &moves[e].way]);
        let [led, _] = self.by([&moves[p].led, &moves[e].led]);
        let mut room = self.room + out + led;
        if self.pressed == 0.0 && room >= AT_ONCE * (-self.ways[0] - out).max(0.0) {
            return 0.0;
        }
        if !self.is_met {
            self.meet(moves);
            let [after, _] = self.by([&moves[p].led, &moves[e].led]);
            room += after - led;
        }
        let was = [self.pressed, self.rubbed];
        self.pressed = (was[0] - (room + self.old) * self.masses[0]).max(0.0);
        let most = self.friction * self.pressed;
        self.rubbed = (was[1] - (self.ways[1] + along) * self.masses[1]).max(-most).min(most);
        let push = [self.pressed - was[0], self.rubbed - was[1]];
        self.give(moves, push);
        (push[0] / self.masses[0]).abs().max((push[1] / self.masses[1]).abs())
    }
}

/// One pass. Returns what it changed most `[m]`.
fn pass(list: &mut [Touch], moves: &mut [Moves]) -> f64 {
    list.iter_mut().fold(0.0, |most: f64, touch| most.max(touch.press(moves)))
}

impl<S: Real> Cluster<S> {
    /// Whether a point is of a body that moves as one, or does not give way.
    #[inline(always)]
    pub(super) fn is_firm(&self, i: usize) -> bool {
        self.w[i] == S::ZERO || self.is_rigid(self.body_of[i])
    }

    /// Whether all of its bodies move as one.
    pub(super) fn is_all_whole(&self) -> bool {
        self.frames.len() == self.bodies.len() && self.rigs.is_empty() && !self.is_one.is_empty()
    }

    /// Whether both sides of a pair are; circles are met by sweeps of their own.
    pub(super) fn is_between_firm(&self, pair: &Pair<S>) -> bool {
        !pair.is_round && pair.places().into_iter().all(|i| self.is_firm(i))
    }

    /// Finds what may touch in a substep of `h` `[s]`, and lets it begin with what it bore. What others push moves it by `slack`, and its
    /// own points go `longest`, at most `[m]`.
    pub(super) fn touch(&mut self, common: &Common<S>, (h, slack, longest): (S, S, S), gravity: [f64; 2]) {
        if self.is_one.is_empty() {
            return;
        }
        let mut touches = std::mem::take(&mut self.touches);
        touches.list.clear();
        touches.moves.clear();
        let from = |frame: &Frame| Moves { from: [frame.pushed(), frame.led()], ..Moves::default() };
        touches.moves.extend(self.frames.iter().map(from).chain([Moves::default()]));
        // Bodies that move as one hand on no more than what the fastest brings.
        let is_all_whole = self.is_all_whole();
        let slack = if is_all_whole { longest + longest } else { slack };
        let falls = dot(gravity, gravity).sqrt() * h.to_f64() * h.to_f64();
        touches.steady = (STEADY[0] * falls).max(STEADY[1] * longest.to_f64());
        // What is heavy on what is light is stopped by rules that begin with nothing (`bear.rs`).
        let square = if self.is_uneven { 0.0 } else { h.to_f64() * h.to_f64() };
        let (mut pairs, mut active) = (std::mem::take(&mut self.pairs), std::mem::take(&mut self.active));
        active.retain(|&number| {
            let pair = &mut pairs[number as usize];
            if !self.is_between_firm(pair) {
                return true;
            }
            let load = std::mem::take(&mut pair.contact.load).map(|part| part.to_f64() * square);
            let was_followed = pair.seen == self.counts.substeps as u32;
            if let Some(mut touch) = self.touch_of(pair, number, slack) {
                if load[0] > 0.0 && was_followed {
                    touch.bear(&mut touches.moves, load);
                }
                touches.list.push(touch);
            }
            false
        });
        self.active = active;
        self.pairs = pairs;
        let mut planes = std::mem::take(&mut self.on_planes);
        let is_taken =
            |on: &mut OnPlane<S>| common.circle_of(on).is_none() && self.is_rigid(self.body_of[on.p as usize]);
        touches.planes.extend(planes.extract_if(.., is_taken));
        self.on_planes = planes;
        for (on, place) in touches.planes.iter_mut().zip(0..) {
            let load = std::mem::take(&mut on.contact.load).map(|part| part.to_f64() * square);
            let Some(mut touch) = self.touch_on(common, on, place) else { continue };
            if load[0] > 0.0 {
                touch.bear(&mut touches.moves, load);
            }
            touches.list.push(touch);
        }
        self.counts.work += LOOKED * touches.list.len() as u64;
        touches.is_alone = is_all_whole && self.active.is_empty() && self.on_planes.is_empty();
        if !touches.is_alone {
            self.shift_frames(&touches.moves);
        }
        self.touches = touches;
    }

    /// A pair that may touch; `None` of one that is too far apart, or belongs nowhere.
    fn touch_of(&mut self, pair: &mut Pair<S>, number: u32, slack: S) -> Option<Touch> {
        if pair.side == S::ZERO || pair.seen != self.counts.substeps as u32 {
            pair.see(self);
        }
        let places = pair.places();
        let [p, a, b] = places;
        let side = pair.side.to_f64();
        if side == 0.0 {
            return None;
        }
        let Beside { at, normal, gap } = beside(places.map(|i| self.place(i)), side)?;
        let room = gap - pair.distance.to_f64();
        if room >= slack.to_f64() {
            return None;
        }
        let is_free = p.max(a) < self.own();
        if is_free && super::pair::gap_is_hopeless(gap, [self.place(a), self.place(b)]) {
            return None;
        }
        let place = add(scale(self.place(a), 1.0 - at), scale(self.place(b), at));
        let sides = [self.side(p, self.place(p), normal), self.side(a, place, normal)];
        // What comes from behind, around an end, is no contact.
        let before = beside(places.map(|i| widen(self.start[i])), side)?;
        let overlap = (pair.distance.to_f64() - before.gap).max(0.0);
        let mended =
            if overlap > 0.0 { pair.mends(self, (convert(normal), S::from_f64(before.gap))).to_f64() } else { 0.0 };
        let between = |of: &dyn Fn(usize) -> [f64; 2]| sub(of(p), add(scale(of(a), 1.0 - at), scale(of(b), at)));
        let (way, begun) = (between(&|i| widen(self.way[i])), between(&|i| widen(self.begun[i])));
        let kind = (Of::Pair(number, at), pair.friction.to_f64());
        Touch::new(kind, sides, (normal, room), (way, begun), [overlap, mended])
    }

    /// A point on a plane.
    fn touch_on(&mut self, common: &Common<S>, on: &OnPlane<S>, place: u32) -> Option<Touch> {
        let (p, plane) = (on.p as usize, &common.planes[on.surface as usize]);
        let normal = widen(on.normal);
        let room = plane.gap(self.now[p]).to_f64();
        let depth = on.depth(common, self.start[p]);
        let mended = if depth > S::ZERO { self.led_out([p, p], on.normal, depth).to_f64() } else { 0.0 };
        let sides = [self.side(p, self.place(p), normal), Side::still(self.frames.len())];
        let kind = (Of::Plane(place), plane.friction.to_f64());
        Touch::new(kind, sides, (normal, room), (widen(self.way[p]), widen(self.begun[p])), [depth.to_f64(), mended])
    }

    /// What a point goes with, pressed at `x`.
    fn side(&self, i: usize, x: [f64; 2], normal: [f64; 2]) -> Side {
        let Some(number) = self.frame_number(i) else {
            return Side::still(self.frames.len());
        };
        let frame = &self.frames[number];
        let arm = sub(x, frame.place().middle);
        Side { body: number, inverse: frame.inverse(), arms: [cross(arm, normal), cross(arm, left(normal))] }
    }

    /// Where a point is, as far as the substep is solved.
    fn place(&self, i: usize) -> [f64; 2] {
        self.of_frame(i).unwrap_or_else(|| widen(self.now[i]))
    }

    fn shift_frames(&mut self, moves: &[Moves]) {
        for (number, moves) in moves[..self.frames.len()].iter().enumerate() {
            self.shift_frame(number, moves.way, moves.led);
        }
    }

    /// One pass over what touches; where nothing else moves bodies meanwhile as many as it takes until a pass changes little.
    pub(super) fn press_touches(&mut self) {
        if self.touches.list.is_empty() {
            return;
        }
        let mut touches = std::mem::take(&mut self.touches);
        let Touches { list, moves, is_alone, steady, .. } = &mut touches;
        let most = (ALL_PASSES / list.len()).clamp(PASSES[0], PASSES[1]) as u64;
        let mut passes = 1;
        if *is_alone {
            while pass(list, moves) > *steady && passes < most {
                passes += 1;
            }
        } else {
            // What others do to bodies meanwhile counts for all that touches.
            for (moves, frame) in moves.iter_mut().zip(&self.frames) {
                let [way, led] = moves.from;
                (moves.way, moves.led) = (frame.pushed().less(&way), frame.led().less(&led));
            }
            let before = moves.clone();
            pass(list, moves);
            let changes: Vec<Moves> = moves.iter().zip(&before).map(|(after, before)| after.since(before)).collect();
            self.shift_frames(&changes);
        }
        self.counts.work += PRESSED * passes * touches.list.len() as u64;
        self.touches = touches;
    }

    /// The passes are over: bodies go where contacts moved them, and pairs know what pressed them.
    pub(super) fn end_touches(&mut self, common: &Common<S>) {
        if self.is_one.is_empty() {
            return;
        }
        let mut touches = std::mem::take(&mut self.touches);
        if touches.is_alone {
            self.shift_frames(&touches.moves);
        }
        let mut pairs = std::mem::take(&mut self.pairs);
        for touch in &touches.list {
            let push = [0, 1].map(|k| scale(touch.axes[k], [touch.pressed, touch.rubbed][k]));
            let [out, aside] = push.map(convert);
            match touch.of {
                Of::Pair(number, at) => {
                    let pair = &mut pairs[number as usize];
                    touch.tell(&mut pair.contact);
                    self.note_push(pair.places(), S::from_f64(at), pair.restitution, (out, aside));
                    self.active.push(number);
                }
                Of::Plane(place) => {
                    let on = &mut touches.planes[place as usize];
                    touch.tell(&mut on.contact);
                    on.slips = touch.rubbed.abs() >= touch.friction * touch.pressed;
                    let [_, restitution] = on.surface(common);
                    self.note_push_of_one(on.p as usize, restitution, (out, aside));
                }
            }
        }
        self.active.sort_unstable();
        self.pairs = pairs;
        self.on_planes.append(&mut touches.planes);
        self.on_planes.sort_unstable_by_key(|on| (on.p, on.surface));
        self.touches = touches;
    }
}

impl<S> Touches<S> {
    /// Whether something presses.
    pub(super) fn press(&self) -> bool {
        self.list.iter().any(|touch| touch.pressed > 0.0)
    }
}

impl Touch {
    /// `None`: neither of the two moves.
    fn new(
        (of, friction): (Of, f64),
        sides: [Side; 2],
        (normal, room): ([f64; 2], f64),
        (way, begun): ([f64; 2], [f64; 2]),
        [overlap, mended]: [f64; 2],
    ) -> Option<Self> {
        let [one, other] = [&sides[0], &sides[1]].map(Side::weights);
        let weights = add(one, other);
        let axes = [normal, left(normal)];
        (weights[0] > 0.0).then(|| Touch {
            of,
            sides,
            axes,
            masses: weights.map(|weight| 1.0 / weight),
            room,
            ways: axes.map(|axis| dot(way, axis)),
            overlap,
            mended,
            approach: dot(begun, normal),
            friction,
            pressed: 0.0,
            rubbed: 0.0,
            old: 0.0,
            is_met: false,
        })
    }
}
