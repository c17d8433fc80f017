//! What plots are made of, measured on the stepping thread and only while somebody looks at it.

use crate::history::History;
use crate::sim::{Bond, BondKind, Dynamics, Energies, Limit, PointId};

/// What a probe is put on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Probe {
    /// A point.
    Point(PointId),
    /// A bond, by its number.
    Bond(u32),
}

impl From<PointId> for Probe {
    fn from(point: PointId) -> Self {
        Probe::Point(point)
    }
}

/// Points and bonds that are probed, each in a place of its own, which it keeps.
pub type Probes = [Option<Probe>; 2];

/// The state of a point, or of a bond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probed {
    /// Which one.
    pub probe: Probe,
    /// Position of the point, or of the middle of the bond `[m]`, z = 0 in the plane.
    pub position: [f64; 3],
    /// The velocity of that `[m/s]`.
    pub velocity: [f64; 3],
    /// Strain of the bond, length/rest - 1 `[1]`; none of a point, or at rest length 0.
    pub strain: Option<f64>,
    /// By which the bond pulls its ends together, below 0 where it pushes `[N]`: of springs without a drive, and of rigid bonds where the
    /// state tells.
    pub force: Option<f64>,
}

impl Probed {
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
    /// The probed points and bonds that are there.
    pub probes: [Option<Probed>; 2],
    /// It is the present at no fixed time, and goes once there is a later one.
    pub is_passing: bool,
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
}

impl Watch {
    /// These points and bonds from now on, at once, of a scene that plays so many of its seconds a second of wall time; `None`: nothing more.
    pub(super) fn set(&mut self, probes: Option<Probes>, world: &dyn Dynamics, rate: f64) {
        (self.probes, self.rate, self.wait) = (probes, rate, 0);
        if self.probes.is_none() {
            self.list.clear();
        }
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
            self.list.push(measured(world, probes));
        }
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
    Measured { time: world.time(), energies: world.energies(), probes, is_passing: false }
}

/// What is measured of a probe, unless it is gone, not there yet or without finite numbers.
fn probed(world: &dyn Dynamics, probe: Probe) -> Option<Probed> {
    let found = match probe {
        Probe::Point(point) => {
            let [position, velocity] = state(world, point)?;
            Probed { probe, position, velocity, strain: None, force: None }
        }
        Probe::Bond(number) => {
            let place = world.bond_place(number)?;
            of_bond(world, (place, world.bonds().get(place)), probe)?
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
    let [apart, parting]: [[f64; 3]; 2] = [[y, x], [w, v]].map(|[p, q]| std::array::from_fn(|axis| p[axis] - q[axis]));
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
    Some(Probed { probe, position: half(x, y), velocity: half(v, w), strain, force })
}

fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}
