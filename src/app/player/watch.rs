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
}

/// A world with more points and bonds than this is measured in every second frame, with twice as many in every third: a measurement reads
/// all of them once, so that it takes less than a millisecond a frame in the mean.
const AT_ONCE: usize = 50_000;

/// What was before is measured so far back, in wall time at the scene's own pace `[s]`.
pub const REACH: f64 = 20.0;
/// Counted work that steps may be taken again for, to measure what was before `[s]`: while time goes on less than a frame may spend.
const WORK: f64 = 0.4;
const WORK_IN_A_FRAME: f64 = 0.02;
/// So many are measured of what was before at most.
const MOST_BEFORE: f64 = 1200.0;

/// Whether and which measurements are wanted.
#[derive(Debug, Default)]
pub(super) struct Watch {
    probes: Option<Probes>,
    /// Frames until the next measurement.
    wait: usize,
}

impl Watch {
    /// These points and bonds from now on, at once; `None`: nothing more.
    pub(super) fn set(&mut self, probes: Option<Probes>) {
        (self.probes, self.wait) = (probes, 0);
    }

    /// What it would have measured before now, if anything is wanted, of a scene that plays so many of its seconds a second of wall time.
    pub(super) fn look_back(&self, history: &History, rate: f64, moves: bool) -> Vec<Measured> {
        let mut list: Vec<Measured> = Vec::new();
        let Some(probes) = self.probes else { return list };
        let span = REACH * rate;
        let from = history.world().time() - span;
        history.look_back(from, if moves { WORK_IN_A_FRAME } else { WORK }, |world| {
            let is_due = list.last().is_none_or(|last| world.time() - last.time >= span / MOST_BEFORE);
            if is_due && world.time() >= from {
                list.push(measured(world, probes));
            }
        });
        list
    }

    /// The world's state in this frame, if it is wanted.
    pub(super) fn look(&mut self, world: &dyn Dynamics) -> Option<Measured> {
        let probes = self.probes?;
        if self.wait > 0 {
            self.wait -= 1;
            return None;
        }
        self.wait = (world.point_count() + world.bonds().len()) / AT_ONCE;
        Some(measured(world, probes))
    }
}

fn measured(world: &dyn Dynamics, probes: Probes) -> Measured {
    let probes = probes.map(|probe| probe.and_then(|probe| probed(world, probe)));
    Measured { time: world.time(), energies: world.energies(), probes }
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
