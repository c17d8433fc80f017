//! What plots are made of, measured on the stepping thread and only while somebody looks at it.

use crate::sim::{Dynamics, Energies, PointId};

/// Points that are probed, each in a place of its own, which it keeps.
pub type Probes = [Option<PointId>; 2];

/// The state of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probed {
    /// Which one.
    pub point: PointId,
    /// Position `[m]`, z = 0 in the plane.
    pub position: [f64; 3],
    /// The length of its velocity `[m/s]`.
    pub speed: f64,
}

/// Energies and probed points at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// Time `[s]`.
    pub time: f64,
    /// Of the points that are not pinned `[J]`.
    pub energies: Energies,
    /// The probed points that are there.
    pub probes: [Option<Probed>; 2],
}

/// A world with more points and bonds than this is measured in every second frame, with twice as many in every third: a measurement reads
/// all of them once, so that it takes less than a millisecond a frame in the mean.
const AT_ONCE: usize = 50_000;

/// Whether and which measurements are wanted.
#[derive(Debug, Default)]
pub(super) struct Watch {
    probes: Option<Probes>,
    /// Frames until the next measurement.
    wait: usize,
}

impl Watch {
    /// These points from now on, at once; `None`: nothing more.
    pub(super) fn set(&mut self, probes: Option<Probes>) {
        (self.probes, self.wait) = (probes, 0);
    }

    /// The world's state in this frame, if it is wanted.
    pub(super) fn look(&mut self, world: &dyn Dynamics) -> Option<Measured> {
        let probes = self.probes?;
        if self.wait > 0 {
            self.wait -= 1;
            return None;
        }
        self.wait = (world.point_count() + world.bonds().len()) / AT_ONCE;
        let probes = probes.map(|point| point.and_then(|point| probed(world, point)));
        Some(Measured { time: world.time(), energies: world.energies(), probes })
    }
}

/// The state of a point, unless it is gone, not there yet or without finite numbers.
fn probed(world: &dyn Dynamics, point: PointId) -> Option<Probed> {
    if point.index() >= world.point_count() || world.gone().binary_search(&point).is_ok() {
        return None;
    }
    let dimensions = world.dimensions();
    let coordinate = |axis| world.positions().get(point.index() * dimensions + axis);
    let position = std::array::from_fn(|axis| if axis < dimensions { coordinate(axis) } else { 0.0 });
    let [x, y, z] = world.velocity(point);
    let speed = x.hypot(y).hypot(z);
    position.iter().chain([&speed]).all(|number| number.is_finite()).then_some(Probed { point, position, speed })
}
