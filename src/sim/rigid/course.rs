//! From one moment to the next: flights, hits, and what lies on surfaces.

use std::cell::Cell;

use crate::sim::bulk::control::FRAME;
use crate::sim::ledger::Book;

/// Angle that a body near surfaces turns in a part of a step at most `[rad]`.
pub(super) const TURN: f64 = 0.05;
/// Longest part in which it lies on something or is pushed by the mouse, hangs on a pin, or is driven by forces and gusts, each so many of a
/// step at least; and the shortest that is asked for, however fast it spins `[s]`.
pub(super) const LYING: (f64, f64) = (1.0 / 960.0, 16.0);
pub(super) const HANGING: (f64, f64) = (1.0 / 480.0, 8.0);
pub(super) const DRIVEN: (f64, f64) = (1.0 / 240.0, 4.0);
pub(super) const SHORTEST: f64 = 1.0 / 30_720.0;
/// Phase of the mouse force that a part spans `[rad]`.
pub(super) const PHASE: f64 = 0.25;
/// How long a bounce takes that is none any more `[s]`: slower hits give nothing back.
pub(super) const GENTLE: f64 = 1e-4;
/// How high something is thrown that bounces, as a share of its size `[1]`, at least.
pub(super) const LEAST_BOUNCE: f64 = 2e-6;
/// Speed that counts as none, as a share of the body's own `[1]`.
pub(super) const STILL: f64 = 1e-11;

/// Halvings of parts that are too long, in a frame at most: what turns too fast for any part is not followed. And how much longer than one that
/// was halved the next ones get.
const HALVINGS: f64 = 64.0;
const GROWTH: f64 = 1.25;

/// What a step counts and books.
pub(super) struct Log<'a> {
    pub(super) hits: u64,
    pub(super) work: u64,
    pub(super) book: Option<&'a mut Book>,
    /// When something broke, from the start of the step on `[s]`: what follows is not of this step.
    pub(super) broke: Option<f64>,
    /// Work beyond which the step ends early, and when it did, from its start on `[s]`: what is left of it is somebody else's.
    pub(super) most_work: u64,
    pub(super) gave_up: Option<f64>,
}

impl<'a> Log<'a> {
    /// Of a step that may take what it takes.
    pub(super) fn new(book: Option<&'a mut Book>) -> Self {
        Log { hits: 0, work: 0, book, broke: None, most_work: u64::MAX, gave_up: None }
    }
}

/// Why a part was too long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// It turned too far, or was jerked.
    Strays,
    /// It did not come to where all joints fit.
    Misses,
}

/// What moves as one among surfaces: a body alone, or bodies that joints hold together.
pub(super) trait Assembly {
    /// Where all of it is and how it moves.
    type Motion: Clone;
    /// A point on a surface.
    type Touch: Copy;
    /// The surfaces that it may meet in a part of a step.
    type Near;

    /// The longest part of a step that it may turn in, in flight and among surfaces `[s]`.
    fn turned(&self, motion: &Self::Motion) -> [f64; 2];
    /// Hits in a frame after which nothing bounces that does not give all back, and after which none is located: what gets behind a surface is
    /// put out of it.
    fn most_hits(&self) -> [f64; 2];
    /// What it may meet within `h` from `t` on `[s]`; `None`: nothing.
    fn near(&self, motion: &Self::Motion, span: (f64, f64)) -> Option<Self::Near>;
    /// It is put out of surfaces that it is behind at `t` `[s]`, without speed; `None`: there is no room for it.
    fn put_out(&self, motion: &Self::Motion, t: f64, near: &Self::Near) -> Option<Self::Motion>;
    /// It stands still.
    fn stopped(&self, motion: Self::Motion) -> Self::Motion;
    /// What touches at `t` `[s]`: points on surfaces, and strings that are taut.
    fn touching(&self, motion: &Self::Motion, t: f64, near: &Self::Near) -> Vec<Self::Touch>;
    /// How fast that goes across its surface at `t` `[m/s]`: below 0 into it.
    fn speed(&self, motion: &Self::Motion, t: f64, touch: Self::Touch) -> f64;
    /// A speed that counts as none `[m/s]`.
    fn still(&self, motion: &Self::Motion) -> f64;
    /// A speed of hits that give nothing back `[m/s]`.
    fn gentle(&self) -> f64;
    /// An impact at `t` `[s]` on what it touches. Hits that are slower than `gentle` `[m/s]` give nothing back, nor, when it `is_over`, those that are to
    /// give back some.
    fn strike(
        &self,
        motion: &Self::Motion,
        t: f64,
        touching: &[Self::Touch],
        how: (f64, bool),
        log: &mut Log,
    ) -> Self::Motion;
    /// On for `h` from `t` `[s]` where nothing touches it.
    fn fly(&self, motion: &Self::Motion, span: (f64, f64), book: Option<&mut Book>) -> Self::Motion;
    /// The same with points that lie on surfaces. What that takes is counted as spent.
    fn slide(
        &self,
        motion: &Self::Motion,
        span: (f64, f64),
        lying: &[Self::Touch],
        spent: (&Cell<u64>, Option<&mut Book>),
    ) -> Self::Motion;
    /// When within `h` `[s]` the first point gets to a surface along a path from `t` on, whose ends are given; `lying` are on theirs already.
    fn first_hit(
        &self,
        path: &dyn Fn(f64) -> Self::Motion,
        ends: (&Self::Motion, &Self::Motion, f64),
        among: (&Self::Near, &[Self::Touch]),
        t: f64,
    ) -> Option<f64>;
    /// When within `h` `[s]` the first of the points that slide on their surfaces stops or turns back.
    fn first_stop(
        &self,
        path: &dyn Fn(f64) -> Self::Motion,
        ends: (&Self::Motion, &Self::Motion, f64),
        lying: &[Self::Touch],
    ) -> Option<f64>;
    /// When within `h` `[s]` the first bond breaks along a path from `t` on, whose ends are given.
    fn first_break(
        &self,
        _path: &dyn Fn(f64) -> Self::Motion,
        _ends: (&Self::Motion, &Self::Motion, f64),
        _t: f64,
    ) -> Option<f64> {
        None
    }
    /// Whether a part of `h` `[s]` that led from one to the other was too long, and why; `is_free`: nothing touched it.
    fn fault(&self, _ends: (&Self::Motion, &Self::Motion), _h: f64, _is_free: bool) -> Option<Fault> {
        None
    }
    /// Whether what lies on surfaces stands still there at both ends of a part, and nothing pushes it that may change: so it goes on.
    fn rests(&self, _ends: (&Self::Motion, &Self::Motion)) -> bool {
        false
    }
    /// Operations of a part in flight, and of a look at what it touches, about.
    fn work(&self, near: Option<&Self::Near>) -> u64;
}

/// On for `h` from `t` `[s]`, in parts of at most `longest`, or until something breaks.
pub(super) fn advance<A: Assembly>(
    of: &A,
    mut motion: A::Motion,
    (t, h, longest): (f64, f64, f64),
    log: &mut Log,
) -> A::Motion {
    // What bounces no higher than a millionth of its size is at rest.
    let gentle = of.gentle();
    let [many, most_hits] = of.most_hits();
    let frames = (h / FRAME).ceil().max(1.0);
    let (mut done, mut hits, mut is_out) = (0.0, 0.0, false);
    let (mut halvings, mut grown) = (HALVINGS * frames, f64::INFINITY);
    while h - done > 1e-12 * h {
        if log.work > log.most_work {
            log.gave_up = Some(done);
            break;
        }
        let (now, left) = (t + done, h - done);
        let [in_flight, turned] = of.turned(&motion);
        let mut part = left.min(longest.max(SHORTEST)).min(in_flight).min(grown);
        log.work += of.work(None);
        let Some(near) = of.near(&motion, (now, part)) else {
            let fly = |part| of.fly(&motion, (now, part), None);
            let end = shortened((of, &motion, true), (&mut part, &mut grown), &mut halvings, fly);
            let broke = of.first_break(&fly, (&motion, &end, part), now);
            let until = broke.unwrap_or(part);
            motion = match (broke, log.book.as_deref_mut()) {
                (None, None) => end,
                (_, book) => of.fly(&motion, (now, until), book),
            };
            done += until;
            if broke.is_some() {
                log.broke = Some(done);
                return motion;
            }
            continue;
        };
        let locates = hits < most_hits * frames;
        if !is_out || !locates {
            let Some(out) = of.put_out(&motion, now, &near) else {
                // There is no room for it: it is held.
                return of.stopped(motion);
            };
            motion = out;
            is_out = true;
        }
        part = part.min(turned).min(if locates { f64::INFINITY } else { LYING.0 });
        let touching = of.touching(&motion, now, &near);
        log.work += of.work(Some(&near));
        if touching.iter().any(|&touch| of.speed(&motion, now, touch) < -of.still(&motion)) {
            hits += 1.0;
            motion = of.strike(&motion, now, &touching, (gentle, hits > many * frames), log);
        }
        let most = gentle.max(of.still(&motion));
        let lying: Vec<A::Touch> =
            touching.into_iter().filter(|&touch| of.speed(&motion, now, touch) <= most).collect();
        let spent = Cell::new(0);
        let go = |time: f64, book: Option<&mut Book>| {
            let ways = (now, time);
            if lying.is_empty() { of.fly(&motion, ways, book) } else { of.slide(&motion, ways, &lying, (&spent, book)) }
        };
        part = if lying.is_empty() { part } else { part.min(within(LYING, h)) };
        let path = |time: f64| go(time, None);
        let end = shortened((of, &motion, lying.is_empty()), (&mut part, &mut grown), &mut halvings, path);
        if !lying.is_empty() && of.rests((&motion, &end)) {
            log.work += spent.get();
            return of.stopped(motion);
        }
        let hit = of.first_hit(&path, (&motion, &end, part), (&near, &lying), now).filter(|_| locates);
        let until = hit.map_or_else(|| (end.clone(), part), |time| (path(time), time));
        let stop = of.first_stop(&path, (&motion, &until.0, until.1), &lying).filter(|_| locates);
        let first = stop.or(hit);
        let reached = stop.map(&path);
        let reached = reached.as_ref().unwrap_or(&until.0);
        let broke = of.first_break(&path, (&motion, reached, first.unwrap_or(part)), now);
        let first = broke.or(first);
        let next = match (first, log.book.as_deref_mut()) {
            (None, None) => end,
            // Where a book is kept, that way is gone once more.
            (first, book) => go(first.unwrap_or(part), book),
        };
        motion = next;
        log.work += spent.get();
        done += first.unwrap_or(part);
        hits += if first.is_some() { 1.0 } else { 0.0 };
        if broke.is_some() {
            log.broke = Some(done);
            break;
        }
    }
    motion
}

/// Where a path leads in a part, which is halved until it is not too long, as often as is left; and how long the next one may be, for it is hardly
/// ever one that has to be.
fn shortened<A: Assembly>(
    (of, start, is_free): (&A, &A::Motion, bool),
    (part, grown): (&mut f64, &mut f64),
    left: &mut f64,
    path: impl Fn(f64) -> A::Motion,
) -> A::Motion {
    let mut end = path(*part);
    let whole = *part;
    while let Some(fault) = of.fault((start, &end), *part, is_free) {
        if *part <= SHORTEST || *left <= 0.0 {
            // Where no part is short enough, as where lengths and leads contradict each other, the others are not cut in vain.
            if fault == Fault::Misses {
                *left = 0.0;
            }
            break;
        }
        *part *= 0.5;
        *left -= 1.0;
        end = path(*part);
    }
    *grown = if *part < whole { *part } else { *grown * GROWTH };
    end
}

/// What an impact took is booked; `is_elastic`: what it took is the method's own.
pub(super) fn book_strike(book: Option<&mut Book>, taken: [f64; 2], is_elastic: bool) {
    if let Some(book) = book {
        let friction = taken[1].max(0.0);
        book.friction += friction;
        book.impacts += if is_elastic { 0.0 } else { (taken[0] + taken[1] - friction).max(0.0) };
    }
}

/// The share of the speed across that a hit of this speed `[m/s]` gives back.
pub(super) fn gives_back(restitution: f64, speed: f64, (gentle, is_over): (f64, bool)) -> f64 {
    if speed > -gentle || (is_over && restitution < 1.0) { 0.0 } else { restitution }
}

/// The longest part of a step of `h` `[s]`, of so many at least.
pub(super) fn within((longest, count): (f64, f64), h: f64) -> f64 {
    longest.min(h / count)
}
