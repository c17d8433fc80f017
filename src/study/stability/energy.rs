//! Energy both ways: what a run gained that nothing brought, and what it lost that nothing took.
//!
//! Model: E(t) <= E(0) + W(t) + 1 % of the largest kinetic and elastic energy so far, where W is the work of the mouse. What led
//! pins and grabs bring is not known: while they act energy is not judged, and afterwards it is counted from where it stands.

use super::quantile::{quantile, sorted};
use crate::scene::{KindName, MakerName, Scene};
use crate::sim::force::mouse::Push;
use crate::sim::vector::truncate;
use crate::sim::{Dynamics, Precision, Sample};

/// Samples whose median counts: velocities of large bodies are means over an impact, and one sample may be off by a third.
const MEDIAN: usize = 5;

/// What rounding makes of energies, as a share of their terms [1].
const ROUNDING: f64 = 1e-9;
/// The same in 32 bits.
const ROUNDING_F32: f64 = 1e-5;

/// What a run gained and lost, as shares of the largest kinetic and elastic energy so far [1].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Balance {
    /// The most above what was there and was brought; 0 where it never was.
    pub(super) gain: f64,
    /// What is missing at the end though nothing takes energy; `None` where something does.
    pub(super) loss: Option<f64>,
    /// Work of the mouse counts: it is worked out from ends of steps, and gains are known less well.
    pub(super) is_pushed: bool,
}

/// The energy of a run, sampled.
pub(super) struct Energy {
    gravity: [f64; 3],
    /// 1 where a point moves.
    mass: Vec<f64>,
    /// Something in the scene takes energy.
    is_lossy: bool,
    /// Pins are led: what they bring is not known.
    is_led: bool,
    /// Energy at the start, and what was brought since [J].
    start: Option<f64>,
    work: f64,
    largest: f64,
    recent: Vec<f64>,
    balance: Balance,
}

impl Energy {
    /// Of a scene whose run begins.
    pub(super) fn new(scene: &Scene) -> Self {
        Energy {
            gravity: scene.gravity.map_or([0.0; 3], |g| g.embed()),
            mass: Vec::new(),
            is_lossy: takes_energy(scene),
            is_led: !scene.pin_motion.is_empty(),
            start: None,
            work: 0.0,
            largest: 0.0,
            recent: Vec::new(),
            balance: Balance::default(),
        }
    }

    /// Something changed from outside: energy is counted from the next sample on.
    pub(super) fn restart(&mut self) {
        (self.start, self.work) = (None, 0.0);
        self.recent.clear();
        self.is_lossy = true;
    }

    /// Whether steps have to be told of: something pushes.
    pub(super) fn follows(&self, world: &dyn Dynamics) -> bool {
        world.mouse().is_some()
    }

    /// A step of a world that the mouse may push, from positions `before` to `after`.
    pub(super) fn step(&mut self, world: &dyn Dynamics, before: &[[f64; 3]], after: &[[f64; 3]]) {
        self.work += match world.dimensions() {
            2 => work::<2>(world, before, after),
            _ => work::<3>(world, before, after),
        };
        self.balance.is_pushed |= self.work != 0.0;
    }

    /// A sample of the run.
    pub(super) fn look(&mut self, world: &dyn Dynamics, sample: &Sample) {
        if self.is_led || world.grab().is_some() {
            return self.restart();
        }
        self.weigh(world);
        let (mut kinetic, mut fallen, mut size) = (0.0, 0.0, sample.energy.abs());
        for ((mass, x), v) in self.mass.iter().zip(&sample.position).zip(&sample.velocity) {
            if *mass > 0.0 && x[0].is_finite() {
                kinetic += 0.5 * mass * v.iter().map(|v| v * v).sum::<f64>();
                let terms = (0..3).map(|k| mass * self.gravity[k] * x[k]);
                fallen -= terms.clone().sum::<f64>();
                size += terms.map(f64::abs).sum::<f64>();
            }
        }
        let moving = sample.energy - fallen;
        self.largest = self.largest.max(moving).max(kinetic);
        let start = *self.start.get_or_insert(sample.energy);
        self.recent.push(sample.energy - start - self.work);
        let from = self.recent.len().saturating_sub(MEDIAN);
        self.recent.drain(..from);
        let over = quantile(&sorted(&self.recent), 0.5);
        let scale = self.largest.max(f64::MIN_POSITIVE);
        // Energies are sums of many terms of either sign.
        let rounding = if world.precision() == Precision::F32 { ROUNDING_F32 } else { ROUNDING };
        let rounding = rounding * (size + self.largest);
        if over > rounding {
            self.balance.gain = self.balance.gain.max(over / scale);
        }
        if !self.is_lossy {
            self.balance.loss = Some((-over - rounding).max(0.0) / scale);
        }
    }

    /// What was found.
    pub(super) fn balance(&self) -> Balance {
        self.balance
    }

    /// The masses of points that move.
    fn weigh(&mut self, world: &dyn Dynamics) {
        self.mass.clear();
        self.mass.extend_from_slice(world.masses());
        for point in world.pinned().iter().chain(world.gone()) {
            self.mass[point.index()] = 0.0;
        }
    }
}

/// Work of the mouse on all points along their ways in a step [J], by the force in the middle of each.
fn work<const D: usize>(world: &dyn Dynamics, before: &[[f64; 3]], after: &[[f64; 3]]) -> f64 {
    let Some((force, cursor)) = world.mouse() else { return 0.0 };
    let push = Push::<f64, D>::new(force, cursor);
    let is_held = |point: usize| world.pinned().iter().any(|pin| pin.index() == point);
    let mut sum = 0.0;
    for (point, (x, y)) in before.iter().zip(after).enumerate() {
        let middle: [f64; D] = truncate(std::array::from_fn(|k| 0.5 * (x[k] + y[k])));
        let Some(a) = push.acceleration(middle) else { continue };
        if !is_held(point) {
            sum += world.masses()[point] * (0..D).map(|k| a[k] * (y[k] - x[k])).sum::<f64>();
        }
    }
    sum
}

/// Whether anything in a scene takes energy, or brings it in ways that are not counted.
fn takes_energy(scene: &Scene) -> bool {
    let dampers = scene.bonds.iter().map(|bond| bond.damping).chain(scene.bodies.iter().map(|body| {
        let material = body.material.as_ref();
        // A picture of some `young` without a damping has one of its own.
        material.and_then(|m| m.damping.or(m.young.filter(|_| body.make == MakerName::Picture)))
    }));
    let relaxed =
        scene.bonds.iter().map(|bond| bond.kind).chain(scene.bodies.iter().map(|body| body.material.as_ref()?.kind));
    let torn = scene.bonds.iter().map(|bond| bond.break_strain);
    let mut torn = torn.chain(scene.bodies.iter().map(|body| body.material.as_ref()?.break_strain));
    let walls = scene.bounds.iter().map(|bounds| (bounds.restitution, bounds.friction));
    let mut surfaces = walls.chain(scene.obstacles.iter().map(|obstacle| (obstacle.restitution, obstacle.friction)));
    let takes = |(e, mu): (Option<f64>, Option<f64>)| e.unwrap_or(0.0) < 1.0 || mu.unwrap_or(0.0) > 0.0;
    scene.drag_rate.unwrap_or(0.0) > 0.0
        || scene.mouse.is_some()
        || !scene.pin_motion.is_empty()
        || dampers.flatten().any(|damping| damping > 0.0)
        || relaxed.flatten().any(|kind| kind == KindName::Relaxed)
        || torn.any(|strain| strain.is_some())
        || surfaces.any(takes)
}
