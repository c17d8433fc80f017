//! What plots are made of, measured on the stepping thread and only while somebody looks at it.

use std::collections::VecDeque;

use crate::history::History;
use crate::sim::{Bond, BondKind, Book, Dynamics, Energies, Limit, PointId};

/// What a probe is put on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Probe {
    /// A point.
    Point(PointId),
    /// A bond, by its number.
    Bond(u32),
    /// The angle at the second of three points, from the first to the third, in the plane.
    Corner([PointId; 3]),
}

impl From<PointId> for Probe {
    fn from(point: PointId) -> Self {
        Probe::Point(point)
    }
}

/// What is probed, each in a place of its own, which it keeps.
pub type Probes = [Option<Probe>; 2];

/// The state of a point, of a bond or of an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probed {
    /// Which one.
    pub probe: Probe,
    /// Position of the point, of the middle of the bond, or of the point that the angle is at `[m]`, z = 0 in the plane.
    pub position: [f64; 3],
    /// The velocity of that `[m/s]`.
    pub velocity: [f64; 3],
    /// Strain of the bond, length/rest - 1 `[1]`; none of a point, or at rest length 0.
    pub strain: Option<f64>,
    /// By which the bond pulls its ends together, below 0 where it pushes `[N]`: of springs without a drive, and of rigid bonds where the
    /// state tells.
    pub force: Option<f64>,
    /// The ends of the bond, and the way from the first to the second `[m]`.
    pub span: Option<([PointId; 2], [f64; 3])>,
    /// From 0 to 360, anticlockwise: of a bond from the first axis to where its second end lies of its first one, or of the angle that is probed
    /// `[degrees]`; in the plane.
    pub angle: Option<f64>,
    /// How far the first world beside this one has the point from here `[m]`, once that is known.
    pub error: Option<f64>,
}

impl Probed {
    /// What is known of a probe in a place with a velocity, and nothing else `[m]`, `[m/s]`.
    pub(in crate::app) fn new(probe: Probe, [position, velocity]: [[f64; 3]; 2]) -> Self {
        Probed { probe, position, velocity, strain: None, force: None, span: None, angle: None, error: None }
    }

    /// The length of a bond `[m]`.
    pub fn length(&self) -> Option<f64> {
        self.span.map(|(_, way)| norm(way))
    }

    /// How far it is from another one `[m]`.
    pub fn distance(&self, other: &Probed) -> f64 {
        norm(less(other.position, self.position))
    }

    /// The angle from a bond to another one, anticlockwise from 0 to 360 `[degrees]`, in the plane: at the point that they share, or else as the bonds
    /// go from their first ends.
    pub fn angle_to(&self, other: &Probed) -> Option<f64> {
        let ((from, way), (to, other_way)) = (self.span?, other.span?);
        let shared = |end: &PointId| from.contains(end) && to.contains(end);
        let joint = from.iter().copied().find(shared);
        let out_of_joint = |ends: [PointId; 2], way: [f64; 3]| match joint {
            Some(joint) if ends[1] == joint => way.map(|part| -part),
            _ => way,
        };
        Some(turn(out_of_joint(from, way), out_of_joint(to, other_way)))
    }

    /// The length of its velocity `[m/s]`.
    pub fn speed(&self) -> f64 {
        norm(self.velocity)
    }
}

/// Energies and probed points at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// Time `[s]`.
    pub time: f64,
    /// Of the points that are not pinned `[J]`.
    pub energies: Energies,
    /// The largest |length/rest - 1| of the bonds that act `[1]`.
    pub strain: f64,
    /// Where energy came from and went, where the world keeps a ledger.
    pub book: Option<Book>,
    /// The probed points and bonds that are there.
    pub probes: [Option<Probed>; 2],
    /// It is the present at no fixed time, and goes once there is a later one.
    pub is_passing: bool,
}

/// How far points that are probed are from where the first world beside this one has them, at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Time `[s]`, of something that was measured.
    pub time: f64,
    /// Of each probe `[m]`; `None` where that is no point of both worlds.
    pub distances: [Option<f64>; 2],
}

/// A world with more points and bonds than this is measured half as often, with twice as many a third as often: a measurement reads
/// all of them once, so that it takes less than a millisecond a frame in the mean at the scene's own pace, and four times that at the greatest,
/// four times it: the times that are measured, and so the curves, are the same at all paces.
const AT_ONCE: usize = 50_000;

/// What was before is measured so far back, in wall time at the scene's own pace `[s]`.
pub const REACH: f64 = 20.0;
/// Counted work that steps may be taken again for, to measure what was before `[s]`: while time goes on less than a frame may spend.
const WORK: f64 = 0.4;
const WORK_IN_A_FRAME: f64 = 0.02;
/// Measurements lie so far apart, in wall time at the scene's own pace `[s]`, or as a whole number of steps does that is near to it: they are
/// of the same times however many frames there are. Further apart curves would get corners, nearer they would cost more.
pub const EVERY: f64 = 1.0 / 60.0;
/// Of a step: so much the sums of times may be off by.
const ROUNDING: f64 = 1e-6;

/// So many measurements at most wait for the world beside to come along: of what it is later by, nothing is told.
const MOST_WAITING: usize = 600;

/// Where probed points were at a time `[s]`, `[m]`.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    time: f64,
    points: [Option<(PointId, [f64; 3])>; 2],
}

/// Whether and which measurements are wanted, and those that were made.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    probes: Option<Probes>,
    /// Seconds of the scene in a second of wall time, at its own pace.
    rate: f64,
    /// What was measured since it was handed out last.
    list: Vec<Measured>,
    /// Frames until the present is measured again.
    wait: usize,
    /// What the world beside has to be asked for, ascending in time.
    waiting: VecDeque<Waiting>,
    /// What it was found to have since that was handed out last.
    apart: Vec<Apart>,
}

impl Watch {
    /// These points and bonds from now on, at once, of a scene that plays so many of its seconds a second of wall time; `None`: nothing more.
    pub(super) fn set(&mut self, probes: Option<Probes>, world: &dyn Dynamics, rate: f64) {
        (self.probes, self.rate, self.wait) = (probes, rate, 0);
        if self.probes.is_none() {
            self.list.clear();
        }
        self.forget_waiting();
        self.note(world);
    }

    /// What it would have measured before now, if anything is wanted. What is of no fixed time, where there is nothing else, says so.
    pub(super) fn look_back(&self, history: &History, moves: bool) -> Vec<Measured> {
        let mut list: Vec<Measured> = Vec::new();
        let Some(probes) = self.probes else { return list };
        let from = history.world().time() - REACH * self.rate;
        let mut last = f64::NEG_INFINITY;
        history.look_back(from, if moves { WORK_IN_A_FRAME } else { WORK }, |world| {
            let (time, is_due) = (world.time(), self.is_due(world));
            let is_alone = time - last > 1.5 * EVERY * self.rate;
            last = time;
            if time >= from && (is_due || is_alone) {
                list.push(Measured { is_passing: !is_due, ..measured(world, probes) });
            }
        });
        list
    }

    /// A step was taken: its end is measured if that is one of the fixed times.
    pub(super) fn note(&mut self, world: &dyn Dynamics) {
        if let Some(probes) = self.probes
            && self.is_due(world)
        {
            let measured = measured(world, probes);
            self.await_beside(&measured);
            self.list.push(measured);
        }
    }

    /// The world went elsewhere: what was to be asked of the one beside it was of another past.
    pub(super) fn forget_waiting(&mut self) {
        self.waiting.clear();
    }

    /// Where a world beside this one has the probed points is asked for once it comes there.
    fn await_beside(&mut self, measured: &Measured) {
        let point = |probed: &Probed| match probed.probe {
            Probe::Point(point) => Some((point, probed.position)),
            Probe::Bond(_) | Probe::Corner(_) => None,
        };
        let points = measured.probes.map(|probed| probed.as_ref().and_then(point));
        if points.iter().any(Option::is_some) {
            self.waiting.push_back(Waiting { time: measured.time, points });
            if self.waiting.len() > MOST_WAITING {
                self.waiting.pop_front();
            }
        }
    }

    /// The first time before `end` that a world beside this one is asked for `[s]`.
    pub(super) fn awaited(&self, end: f64) -> Option<f64> {
        self.waiting.front().map(|first| first.time).filter(|time| *time <= end)
    }

    /// What was asked for first is known: where all points of the world beside are `[m]`, of so many dimensions; `None`: it was there and went on.
    pub(super) fn tell(&mut self, places: Option<&[f64]>, dimensions: usize) {
        let Some(Waiting { time, points }) = self.waiting.pop_front() else { return };
        let Some(places) = places else { return };
        let distance = |(point, here): (PointId, [f64; 3])| {
            let at = point.index() * dimensions;
            let there = places.get(at..at + dimensions)?;
            let way = std::array::from_fn(|axis| there.get(axis).map_or(0.0, |there| there - here[axis]));
            Some(norm(way)).filter(|distance| distance.is_finite())
        };
        self.apart.push(Apart { time, distances: points.map(|point| point.and_then(distance)) });
    }

    /// Puts what was found of the world beside into a list in place of what is there.
    pub(super) fn hand_out_apart(&mut self, list: &mut Vec<Apart>) {
        list.clear();
        list.append(&mut self.apart);
    }

    /// Puts what was measured into a list in place of what is there, and the present.
    pub(super) fn hand_out(&mut self, (world, moves): (&dyn Dynamics, bool), list: &mut Vec<Measured>) {
        list.clear();
        list.append(&mut self.list);
        let Some(probes) = self.probes else { return };
        if self.wait > 0 {
            self.wait -= 1;
            return;
        }
        self.wait = size(world) / AT_ONCE;
        // What stands may have been changed since it was stepped.
        let is_there = moves && list.last().is_some_and(|last| last.time == world.time());
        if !is_there {
            list.push(Measured { is_passing: !self.is_due(world), ..measured(world, probes) });
        }
    }

    /// Whether the world is at the end of the first step of one of the spans that time is cut into: that goes by its time alone.
    fn is_due(&self, world: &dyn Dynamics) -> bool {
        let (time, step) = (world.time(), world.substep());
        let every = EVERY * self.rate * (1 + size(world) / AT_ONCE) as f64;
        let span = (every / step).round().max(1.0) * step;
        time - (time / span + ROUNDING).floor() * span < (1.0 - ROUNDING) * step
    }
}

/// Points and bonds `[1]`.
fn size(world: &dyn Dynamics) -> usize {
    world.point_count() + world.bonds().len()
}

fn measured(world: &dyn Dynamics, probes: Probes) -> Measured {
    let probes = probes.map(|probe| probe.and_then(|probe| probed(world, probe)));
    let (energies, strain, book) = (world.energies(), world.max_strain(), world.book());
    Measured { time: world.time(), energies, strain, book, probes, is_passing: false }
}

/// What is measured of a probe, unless it is gone, not there yet or without finite numbers.
fn probed(world: &dyn Dynamics, probe: Probe) -> Option<Probed> {
    let found = match probe {
        Probe::Point(point) => Probed::new(probe, state(world, point)?),
        Probe::Bond(number) => {
            let place = world.bond_place(number)?;
            of_bond(world, (place, world.bonds().get(place)), probe)?
        }
        Probe::Corner([a, b, c]) => {
            let ([from, _], at, [to, _]) = (state(world, a)?, state(world, b)?, state(world, c)?);
            let angle = (world.dimensions() == 2).then(|| turn(less(from, at[0]), less(to, at[0])));
            Probed { angle, ..Probed::new(probe, at) }
        }
    };
    let numbers = found.position.into_iter().chain(found.velocity).chain(found.strain).chain(found.force);
    numbers.into_iter().all(f64::is_finite).then_some(found)
}

/// Position and velocity of a point that is there.
fn state(world: &dyn Dynamics, point: PointId) -> Option<[[f64; 3]; 2]> {
    if point.index() >= world.point_count() || world.gone().binary_search(&point).is_ok() {
        return None;
    }
    let dimensions = world.dimensions();
    let coordinate = |axis| world.positions().get(point.index() * dimensions + axis);
    let position = std::array::from_fn(|axis| if axis < dimensions { coordinate(axis) } else { 0.0 });
    Some([position, world.velocity(point)])
}

fn of_bond(world: &dyn Dynamics, (place, bond): (usize, Bond), probe: Probe) -> Option<Probed> {
    let ([x, v], [y, w]) = (state(world, bond.a)?, state(world, bond.b)?);
    let half = |p: [f64; 3], q: [f64; 3]| std::array::from_fn(|axis| 0.5 * (p[axis] + q[axis]));
    let [apart, parting] = [[y, x], [w, v]].map(|[p, q]| less(p, q));
    let length = norm(apart);
    let rest = bond.rest_length;
    let acts = match bond.limit {
        Limit::Both => true,
        Limit::Max => length > rest,
        Limit::Min => length < rest,
    };
    let force = match bond.kind {
        _ if bond.drive.is_some() => None,
        BondKind::Spring { .. } if !acts => Some(0.0),
        BondKind::Spring { stiffness, damping } => {
            let rate = apart.iter().zip(parting).map(|(d, v)| d * v).sum::<f64>() / length.max(f64::MIN_POSITIVE);
            Some(stiffness * (length - rest) + damping * rate)
        }
        BondKind::Rigid => world.tension(place),
        BondKind::Relaxed { .. } => None,
    };
    let strain = (rest > 0.0).then(|| length / rest - 1.0);
    let angle = (world.dimensions() == 2).then(|| turn([1.0, 0.0, 0.0], apart));
    let span = Some(([bond.a, bond.b], apart));
    Some(Probed { strain, force, span, angle, ..Probed::new(probe, [half(x, y), half(v, w)]) })
}

fn less(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| p[axis] - q[axis])
}

/// The angle from one direction of the plane to another, anticlockwise from 0 to 360 `[degrees]`.
fn turn([ax, ay, _]: [f64; 3], [bx, by, _]: [f64; 3]) -> f64 {
    (ax * by - ay * bx).atan2(ax * bx + ay * by).to_degrees().rem_euclid(360.0)
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}
