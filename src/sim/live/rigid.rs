//! Bodies that rigid bonds hold in their shape: each moves as one, with a middle and an angle.
//!
//! A substep in which nothing touches them takes them on exactly; what pushes their points pushes them (`frame.rs`).
//! Source: M. Müller and others, Detailed Rigid Body Simulation with Extended Position Based Dynamics, 2020.

use std::sync::Arc;

use super::cluster::Cluster;
use super::frame::follow;
pub(super) use super::frame::{Change, Frame, Shift};
use super::gather::Motion;
use super::substep::SHORT;
use crate::sim::real::Real;
use crate::sim::rigid::motion::{Pose, Twist};
pub(super) use crate::sim::rigid::place::Place;
pub(super) use crate::sim::rigid::shape::{Held, Shape};
use crate::sim::vector::{add, convert, cross, dot, scale, sub, widen};

/// Share of what two things close within a substep in which hits count as one.
pub(super) const AT_ONCE: f64 = 0.02;

/// What a pinned end of an edge gives where it is pressed by what does not move, as a share of what the other end would `[1]`: right beside the pin
/// that would be pushed without end.
const GIVES: f64 = 1e-2;

/// No frame.
const NONE: u32 = u32::MAX;

/// Whether a point goes with a frame.
pub(super) fn goes_with_frame(frame_of: &[[u32; 2]], i: usize) -> bool {
    frame_of.get(i).is_some_and(|home| home[0] != NONE)
}

impl<S: Real> Cluster<S> {
    /// One of its bodies, which comes last, is rigid; its points, in the order of the shape, are there and go so fast. Of them those from `base` on are
    /// in the cluster.
    pub(super) fn include_rigid(
        &mut self,
        shape: &Arc<Shape>,
        base: usize,
        points: impl Fn(usize) -> [[f64; 2]; 2],
        motion: Motion,
    ) {
        let end = self.now.len();
        self.include_frame(shape, (base as u32..end as u32).collect(), |k| points(k)[0]);
        if let Some(frame) = self.frames.last_mut() {
            frame.take_motion(|k| points(k)[1]);
            frame.is_free = motion != Motion::OfPoints;
        }
        self.inner.resize(base, false);
        self.inner.resize(end, true);
        shape.surface.iter().for_each(|&k| self.inner[base + k as usize] = false);
        self.is_one.resize(self.bases.len(), false);
        self.is_one[self.bases.len() - 1] = true;
    }

    /// Some of its points, which come last, go together; those that go with others already are only felt.
    pub(super) fn include_frame(&mut self, shape: &Arc<Shape>, points: Vec<u32>, at: impl Fn(usize) -> [f64; 2]) {
        let frame = Frame::of(shape, points, at);
        self.frame_of.resize(self.now.len(), [NONE; 2]);
        for (&i, k) in frame.points.iter().zip(0..) {
            let home = &mut self.frame_of[i as usize];
            if home[0] == NONE && self.w[i as usize] != S::ZERO {
                *home = [self.frames.len() as u32, k];
            }
        }
        self.frames.push(frame);
    }

    /// Something is fastened to a point: it follows each push of its frame.
    pub(super) fn fasten(&mut self, i: usize) {
        if let Some(number) = self.frame_number(i) {
            let place = self.frame_of[i][1];
            let Frame { near, fastened, .. } = &mut self.frames[number];
            if !fastened.contains(&place) {
                fastened.push(place);
                near.push(place);
            }
        }
    }

    /// The frame that a point goes with.
    fn frame(&self, i: usize) -> Option<&Frame> {
        self.frame_number(i).map(|k| &self.frames[k])
    }

    pub(super) fn frame_number(&self, i: usize) -> Option<usize> {
        let number = self.frame_of.get(i).map_or(NONE, |home| home[0]);
        (number != NONE).then_some(number as usize)
    }

    /// Whether a body moves as one.
    pub(super) fn is_rigid(&self, body: u32) -> bool {
        self.is_one.get(body as usize).is_some_and(|&is_one| is_one)
    }

    /// Whether points go with one frame.
    pub(super) fn go_together(&self, points: [usize; 3]) -> bool {
        let [p, a, b] = points.map(|i| self.frame_number(i));
        p.is_some() && p == a && a == b
    }

    /// Whether a point lies within a rigid body, where nothing gets to it.
    pub(super) fn is_inner(&self, i: usize) -> bool {
        self.inner.get(i).is_some_and(|&is_inner| is_inner)
    }

    /// Inverse mass of a point against a place on an edge, a share `at` of it from its first end on, along a direction `[1/kg]`.
    #[inline(always)]
    pub(super) fn weight(&self, points: [usize; 3], at: S, n: [S; 2]) -> S {
        let [p, a, b] = points;
        let rest = S::ONE - at;
        let (other, felt) = if self.frames.is_empty() {
            (self.w[p], self.w[p] + rest * rest * self.w[a] + at * at * self.w[b])
        } else {
            let other = self.felt(p, n);
            (other, other + self.felt_on_edge([a, b], at, n))
        };
        if other == S::ZERO { felt + self.given_by_pin([a, b], n) } else { felt }
    }

    /// What an edge with one end on a pin gives along a direction wherever it is pressed `[1/kg]`.
    fn given_by_pin(&self, ends: [usize; 2], n: [S; 2]) -> S {
        let [is_a, is_b] = ends.map(|end| self.w[end] == S::ZERO);
        if is_a == is_b { S::ZERO } else { S::from_f64(GIVES) * (self.felt(ends[0], n) + self.felt(ends[1], n)) }
    }

    /// Inverse mass of a place on an edge along a direction `[1/kg]`.
    #[inline(always)]
    pub(super) fn felt_on_edge(&self, [a, b]: [usize; 2], at: S, n: [S; 2]) -> S {
        let rest = S::ONE - at;
        match (self.frame_number(a), self.frame_number(b)) {
            (Some(one), Some(other)) if one == other => {
                S::from_f64(self.frames[one].weight(widen(self.between([a, b], at)), widen(n)))
            }
            _ => rest * rest * self.felt(a, n) + at * at * self.felt(b, n),
        }
    }

    /// Inverse mass of a point along a direction `[1/kg]`.
    #[inline(always)]
    pub(super) fn felt(&self, p: usize, n: [S; 2]) -> S {
        self.frame(p).map_or(self.w[p], |frame| S::from_f64(frame.weight(widen(self.now[p]), widen(n))))
    }

    /// What pushes of three points by their slopes, as large as those, change along all of them `[1/kg]`.
    pub(super) fn felt_by_three(&self, points: [usize; 3], slopes: [[S; 2]; 3]) -> S {
        let mut sum = S::ZERO;
        for (k, (&i, g)) in points.iter().zip(slopes).enumerate() {
            let Some(number) = self.frame_number(i) else {
                sum += self.w[i] * dot(g, g);
                continue;
            };
            if points[..k].iter().any(|&other| self.frame_number(other) == Some(number)) {
                continue;
            }
            let frame = &self.frames[number];
            let (mut push, mut turn) = ([0.0; 2], 0.0);
            for (&other, g) in points.iter().zip(slopes).skip(k) {
                if self.frame_number(other) == Some(number) {
                    push = add(push, widen(g));
                    turn += cross(sub(widen(self.now[other]), frame.now.middle), widen(g));
                }
            }
            sum += S::from_f64(frame.inverse[0] * dot(push, push) + frame.inverse[1] * turn * turn);
        }
        sum
    }

    /// The same of a point of a rigid body alone; 1 of any other: what pushes it is counted as what it moves it by.
    #[inline(always)]
    pub(super) fn own_weight(&self, p: usize, n: [S; 2]) -> S {
        if self.frames.is_empty() {
            return S::ONE;
        }
        self.frame(p).map_or(S::ONE, |frame| S::from_f64(frame.weight(widen(self.now[p]), widen(n))))
    }

    /// By how much a point that goes with a frame was put elsewhere in this substep, without speed `[m]`; of others nobody asks.
    #[inline(always)]
    pub(super) fn crept(&self, i: usize) -> [S; 2] {
        let Some(frame) = self.frame(i) else { return [S::ZERO; 2] };
        let q = frame.shape.places[self.frame_of[i][1] as usize];
        convert(sub(frame.start.out(q), frame.found.out(q)))
    }

    /// Whether some of its points may creep: joints are led back to their ranges, against what they lie on.
    #[inline(always)]
    pub(super) fn may_creep(&self) -> bool {
        !self.rigs.is_empty()
    }

    fn between(&self, [a, b]: [usize; 2], at: S) -> [S; 2] {
        add(scale(self.now[a], S::ONE - at), scale(self.now[b], at))
    }

    /// A push between a point and a place on an edge.
    #[inline(always)]
    pub(super) fn push(&mut self, points: [usize; 3], at: S, push: [S; 2], change: Change) {
        let [p, a, b] = points;
        if self.frames.is_empty() {
            return [(p, S::ONE), (a, at - S::ONE), (b, -at)].into_iter().for_each(|(i, share)| {
                self.push_plain(i, scale(push, share * self.w[i]), change);
            });
        }
        let place = self.between([a, b], at);
        self.push_point(p, push, change);
        self.push_edge(([a, b], at, place), scale(push, -S::ONE), change);
    }

    /// A push of a place on an edge `[kg m]`, a share `at` of it from its first end on.
    #[inline(always)]
    pub(super) fn push_edge(&mut self, ([a, b], at, place): ([usize; 2], S, [S; 2]), push: [S; 2], change: Change) {
        match (self.frame_number(a), self.frame_number(b)) {
            (Some(one), Some(other)) if one == other => self.push_frame(one, (place, push), change),
            _ => {
                for (i, share) in [(a, S::ONE - at), (b, at)] {
                    self.push_point(i, scale(push, share), change);
                }
            }
        }
    }

    /// A push of a point `[kg m]`, whatever it goes with.
    #[inline(always)]
    pub(super) fn push_point(&mut self, p: usize, push: [S; 2], change: Change) {
        match self.frame_number(p) {
            Some(frame) => self.push_frame(frame, (self.now[p], push), change),
            None => self.push_plain(p, scale(push, self.w[p]), change),
        }
    }

    /// A push of a point alone, as [`own_weight`](Self::own_weight) counts it.
    #[inline(always)]
    pub(super) fn push_one(&mut self, p: usize, push: [S; 2], change: Change) {
        match self.frame_number(p) {
            Some(frame) => self.push_frame(frame, (self.now[p], push), change),
            None => self.push_plain(p, push, change),
        }
    }

    /// Notes what a push of a point `[kg m]` would have changed of velocities by the arm and the direction that it had as the substep began: see
    /// [`Turned`](crate::sim::kernels::links::Turned).
    pub(super) fn turn_point(&mut self, p: usize, [now, begun]: [[S; 2]; 2]) {
        let Some(number) = self.frame_number(p) else {
            self.turned[p] = add(self.turned[p], scale(sub(begun, now), self.w[p]));
            return;
        };
        let (x, before) = (widen(self.now[p]), widen(self.start[p]));
        let (now, begun): ([f64; 2], [f64; 2]) = (widen(now), widen(begun));
        let frame = &mut self.frames[number];
        let ([ease, swing], [old, new]) = (frame.inverse, [sub(before, frame.start.middle), sub(x, frame.now.middle)]);
        frame.turn_back(Twist {
            velocity: scale(sub(begun, now), ease),
            spin: swing * (cross(old, begun) - cross(new, now)),
        });
    }

    #[inline(always)]
    fn push_plain(&mut self, i: usize, shift: [S; 2], change: Change) {
        match change {
            Change::Way => {
                self.now[i] = add(self.now[i], shift);
                self.way[i] = add(self.way[i], shift);
            }
            Change::Place => {
                self.start[i] = add(self.start[i], shift);
                self.now[i] = add(self.now[i], shift);
                self.gone[i] += dot(shift, shift).sqrt();
            }
            Change::Velocity => self.velocity[i] = add(self.velocity[i], shift),
        }
    }

    fn push_frame(&mut self, number: usize, (x, push): ([S; 2], [S; 2]), change: Change) {
        let Cluster { frames, now, way, start, gone, velocity, counts, .. } = self;
        let frame = &mut frames[number];
        frame.push(widen(x), widen(push), change);
        counts.work += 40 + 40 * frame.near.len() as u64;
        follow(frame, (now, way, start, gone, velocity), change);
    }

    /// Moves a frame as contacts do: by a way, which becomes speed, and elsewhere.
    pub(super) fn shift_frame(&mut self, number: usize, way: Shift, led: Shift) {
        let Cluster { frames, now, way: ways, start, gone, velocity, counts, .. } = self;
        let frame = &mut frames[number];
        let is_led = led != Shift::default();
        if is_led {
            frame.start = frame.start.moved(led.way, led.turn);
            frame.free = frame.free.moved(led.way, led.turn);
        } else if way == Shift::default() {
            return;
        }
        let all = way.plus(&led);
        frame.now = frame.now.moved(all.way, all.turn);
        counts.work += 40 * frame.near.len() as u64;
        follow(frame, (now, ways, start, gone, velocity), if is_led { Change::Place } else { Change::Way });
    }

    /// Where a point is that goes with a frame, as far as the substep is solved.
    pub(super) fn of_frame(&self, i: usize) -> Option<[f64; 2]> {
        let frame = self.frame(i)?;
        Some(frame.now.out(frame.shape.places[self.frame_of[i][1] as usize]))
    }

    /// Notes which points of rigid bodies may touch something in this substep: only they follow each push.
    pub(super) fn note_near(&mut self) {
        if self.frames.is_empty() {
            return;
        }
        for frame in &mut self.frames {
            frame.near.clone_from(&frame.fastened);
        }
        let of_pairs = self.chosen.iter().flat_map(|&number| {
            let pair = &self.pairs[number as usize];
            [pair.p, pair.a, pair.b]
        });
        let points: Vec<u32> = of_pairs.chain(self.on_planes.iter().map(|on| on.p)).collect();
        for i in points {
            if let Some(number) = self.frame_number(i as usize) {
                let place = self.frame_of[i as usize][1];
                self.frames[number].near.push(place);
            }
        }
        for frame in &mut self.frames {
            frame.near.sort_unstable();
            frame.near.dedup();
        }
    }

    /// How far a point may be from touching and be struck together with what touches, where one of the two is rigid `[m]`: of what lies flat
    /// on something rounding says which point is there first.
    #[inline(always)]
    pub(super) fn at_once(&self, points: [usize; 2], closing: S) -> S {
        if self.is_of_rigid(points) { S::from_f64(AT_ONCE) * closing.max(S::ZERO) } else { S::ZERO }
    }

    /// A body is carried along as a whole.
    pub(super) fn carry(&mut self, body: usize, shift: [S; 2]) {
        let points = self.bases[body]..self.bases[body + 1];
        for frame in self.frames.iter_mut().filter(|frame| frame.points.first().is_some_and(|i| points.contains(i))) {
            frame.now.middle = add(frame.now.middle, widen(shift));
        }
    }

    /// What the velocities of its points make of rigid bodies, and where that takes them within a substep of `h` `[s]`.
    pub(super) fn predict_rigid(&mut self, h: S) {
        let mut frames = std::mem::take(&mut self.frames);
        for frame in &mut frames {
            let time = h.to_f64();
            if !frame.is_free {
                let points = std::mem::take(&mut frame.points);
                frame.take_motion(|k| widen(self.velocity[points[k] as usize]));
                frame.points = points;
                self.counts.work += 10 * frame.busy() as u64;
            }
            (frame.found, frame.start) = (frame.now, frame.now);
            frame.now = frame.now.moved(scale(frame.velocity, time), frame.spin * time);
            frame.free = frame.now;
            self.counts.work += 20 * frame.busy() as u64;
        }
        self.frames = frames;
        for number in 0..self.frames.len() {
            self.place_all(number);
        }
    }

    /// Ways and places of all points of a rigid body.
    fn place_all(&mut self, number: usize) {
        let frame = &self.frames[number];
        for (&i, &q) in frame.points.iter().zip(&frame.shape.places) {
            let i = i as usize;
            if self.frame_of[i][0] as usize == number {
                self.start[i] = convert(frame.start.out(q));
                self.way[i] = convert(frame.way_of(q));
                self.now[i] = convert(frame.now.out(q));
            }
        }
    }

    /// The solve is over: points within rigid bodies follow those of their skins.
    pub(super) fn follow_rigid(&mut self) {
        (0..self.frames.len()).for_each(|number| self.place_all(number));
    }

    /// Velocities and places of rigid bodies at the end of a substep of `h` `[s]`: their points turn with them, and do not cut corners.
    pub(super) fn finish_rigid(&mut self, h: f64) {
        for (frame, number) in self.frames.iter_mut().zip(0..) {
            if h > SHORT {
                let Twist { velocity, spin } = frame.turned;
                frame.velocity = scale(add(sub(frame.now.middle, frame.start.middle), velocity), 1.0 / h);
                frame.spin = (frame.now.angle - frame.start.angle + spin) / h;
            }
            frame.turned = Twist::STILL;
            for (&i, &q) in frame.points.iter().zip(&frame.shape.places) {
                let i = i as usize;
                if self.frame_of[i][0] == number {
                    let x = frame.now.out(q);
                    self.now[i] = convert(x);
                    self.lost[i] = convert(sub(x, widen(self.now[i])));
                }
            }
        }
        self.turn_rigid();
    }

    /// Velocities of all points of rigid bodies.
    pub(super) fn turn_rigid(&mut self) {
        self.turn_those(|_| true);
    }

    /// Velocities of the points of those that move by themselves.
    pub(super) fn turn_free(&mut self) {
        self.turn_those(|frame| frame.is_free);
    }

    fn turn_those(&mut self, are_meant: impl Fn(&Frame) -> bool) {
        for (frame, number) in self.frames.iter().zip(0..).filter(|(frame, _)| are_meant(frame)) {
            for (&i, &q) in frame.points.iter().zip(&frame.shape.places) {
                if self.frame_of[i as usize][0] == number {
                    self.velocity[i as usize] = convert(frame.velocity_of(q));
                }
            }
        }
    }

    /// A frame is there, as far as the substep is solved.
    pub(super) fn set_frame(&mut self, number: usize, place: Place) {
        self.frames[number].now = place;
        let Cluster { frames, now, way, .. } = self;
        let frame = &frames[number];
        for &k in &frame.near {
            let (i, q) = (frame.points[k as usize] as usize, frame.shape.places[k as usize]);
            way[i] = convert(frame.way_of(q));
            now[i] = convert(frame.now.out(q));
        }
    }

    /// A frame is there before anything moves, and all that goes with it.
    pub(super) fn begin_at(&mut self, number: usize, place: Place) {
        let frame = &mut self.frames[number];
        (frame.found, frame.start, frame.free, frame.now) = (place, place, place, place);
        self.place_all(number);
    }

    /// A frame moves so.
    pub(super) fn set_twist(&mut self, number: usize, twist: Twist) {
        (self.frames[number].velocity, self.frames[number].spin) = (twist.velocity, twist.spin);
        let Cluster { frames, velocity, .. } = self;
        let frame = &frames[number];
        for &k in &frame.near {
            velocity[frame.points[k as usize] as usize] = convert(frame.velocity_of(frame.shape.places[k as usize]));
        }
    }

    /// How many points are worked on in a substep: of bodies that move by themselves those that may touch something.
    pub(super) fn busy(&self) -> usize {
        self.free().fold(self.own(), |sum, frame| sum + frame.busy() - frame.points.len())
    }

    /// The frame that a body is, if it is one.
    pub(super) fn whole(&self, body: u32) -> Option<&Frame> {
        self.whole_number(body).map(|number| &self.frames[number])
    }

    /// The same, if it moves by itself.
    pub(super) fn free_whole(&self, body: u32) -> Option<&Frame> {
        self.whole(body).filter(|frame| frame.is_free)
    }

    /// The number of the frame that a body is, if it is one.
    pub(super) fn whole_number(&self, body: u32) -> Option<usize> {
        if self.is_rigid(body) { self.frame_number(self.bases[body as usize] as usize) } else { None }
    }

    /// Whether a point follows a body that moves by itself.
    pub(super) fn is_carried(&self, i: usize) -> bool {
        !self.frames.is_empty() && self.frame(i).is_some_and(|frame| frame.is_free)
    }

    /// The bodies that do so.
    pub(super) fn free(&self) -> impl Iterator<Item = &Frame> {
        self.frames.iter().filter(|frame| frame.is_free)
    }

    /// How many of its bodies are rigid.
    pub(super) fn rigid_count(&self) -> u64 {
        self.frames.len() as u64
    }

    /// Whether one of these points goes with a rigid body.
    pub(super) fn is_of_rigid(&self, points: [usize; 2]) -> bool {
        !self.frames.is_empty() && points.into_iter().any(|i| self.frame(i).is_some())
    }
}
