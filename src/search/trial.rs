//! Runs of one model with different settings, and what they cost.

use crate::sim::build::build;
use crate::sim::dynamics::Dynamics;
use crate::sim::model::{Method, Model, ModelError};
use crate::sim::plan::{gust_rate, islands_of};
use crate::sim::solver::Solver;

/// Most work of a whole search, in the units of `sim::plan`: about ten seconds.
const MOST_WORK: f64 = 2e10;
/// Most of what a whole search may take by the work that runs really counted `[ms]`: events, retries and rounds cost more than is foreseen.
const MOST_COUNTED: f64 = 20e3;
/// Rounds of a substep that are usual, and what each further one takes about `[ms]`: where friction holds what is rigid, there are hundreds.
const USUAL_ROUNDS: u64 = 64;
const OF_A_ROUND: f64 = 5e-3;
/// What a part of a step of a rigid body takes of what is counted for it, about, where it lies on something.
const OF_A_RIGID: f64 = 6.0;
/// Longest substep that is tried `[s]`.
const LONGEST: f64 = 0.25;
/// The longest of what the rules move, such as rigid bodies `[s]`.
const FRAME: f64 = 1.0 / 60.0;

/// Samples of one run.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub(super) method: Method,
    /// Positions of all points, sample by sample.
    positions: Vec<Vec<[f64; 3]>>,
    pub(super) work: f64,
    /// Parts of it went to more robust methods, whose errors do not fall as they should.
    pub(super) is_patched: bool,
}

impl Trial {
    /// The largest coordinate of any sample `[m]`.
    pub(super) fn extent(&self) -> f64 {
        self.positions.iter().flatten().flatten().fold(0.0, |most, x| most.max(x.abs()))
    }

    /// The largest distance between two runs, over points and samples `[m]`.
    pub(super) fn distance(&self, other: &Trial) -> f64 {
        let apart = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        let pairs = self.positions.iter().zip(&other.positions).flat_map(|(a, b)| a.iter().zip(b));
        pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max).sqrt()
    }
}

/// Runs a model, and remembers what that cost.
pub(super) struct Trials<'a, const D: usize> {
    model: &'a Model<D>,
    times: &'a [f64],
    /// Bounds on the fastest oscillation and decay `[1/s]`.
    frequency: f64,
    decay: f64,
    spent: f64,
    /// Counted work so far `[ms]`.
    counted: f64,
    last_work: f64,
    was_dear: bool,
    pub(super) substeps: u64,
}

impl<'a, const D: usize> Trials<'a, D> {
    pub(super) fn new(model: &'a Model<D>, times: &'a [f64]) -> Self {
        let islands = islands_of(model);
        let most = |of: fn(&crate::sim::plan::island::Island) -> f64| islands.iter().map(of).fold(0.0, f64::max);
        let mouse = model.mouse.as_ref().map_or(0.0, |mouse| mouse.strength.abs().sqrt());
        Trials {
            frequency: most(|island| island.frequency).max(mouse).max(gust_rate(model).unwrap_or(0.0)),
            decay: most(|island| island.decay) + model.drag_rate,
            model,
            times,
            spent: 0.0,
            counted: 0.0,
            last_work: 0.0,
            was_dear: false,
            substeps: 0,
        }
    }

    /// The longest substep that makes sense for a method: at the edge of its stability, or the one that is said.
    pub(super) fn longest(&self, solver: Solver) -> f64 {
        if let Some(substep) = self.model.method.substep {
            return substep;
        }
        let (phase, decay) = match solver {
            Solver::ImplicitMidpoint | Solver::BackwardEuler | Solver::Flight => (f64::INFINITY, f64::INFINITY),
            Solver::Rk4 | Solver::Pefrl => (2.6, 2.6),
            Solver::Rk8 | Solver::Auto => (5.0, 5.0),
            Solver::BlanesMoan4 => (4.0, 2.0),
            Solver::BlanesMoan6 => (8.0, 2.0),
            _ => (1.9, 1.9),
        };
        // What presses rigid bodies goes by parts of a step, which are no longer in a longer one.
        let most = if solver == Solver::Auto { FRAME } else { LONGEST };
        let end = self.times.last().copied().unwrap_or(0.0);
        let mut longest = if end > 0.0 { most.min(end) } else { most };
        if self.frequency > 0.0 {
            longest = longest.min(phase / self.frequency);
        }
        if self.decay > 0.0 && solver != Solver::Flight {
            longest = longest.min(decay / self.decay);
        }
        longest
    }

    /// Whether the search has cost what it may.
    pub(super) fn is_spent(&self) -> bool {
        self.spent >= MOST_WORK || self.counted >= MOST_COUNTED
    }

    /// Whether the last run was broken off because it costs more than it might.
    pub(super) fn was_dear(&self) -> bool {
        self.was_dear
    }

    /// Work of the last run that went through.
    pub(super) fn last_work(&self) -> f64 {
        self.last_work
    }

    /// Runs the model; `None` where the motion is not finite, or costs more than `limit` or what is left.
    pub(super) fn run(&mut self, solver: Solver, substep: f64, limit: f64) -> Result<Option<Trial>, ModelError> {
        let method = Method { solver, substep: Some(substep), tolerance: None, budget: None, ..self.model.method };
        let model = Model { method, ..self.model.clone() };
        let mut world = build(&model)?;
        let parts = world.parts();
        let unit: f64 = parts.iter().map(|part| part.work).sum();
        let is_rigid = parts.iter().any(|part| part.solver == Solver::Rigid);
        let rate = if is_rigid { OF_A_RIGID } else { 1.0 };
        let limit = limit.min(MOST_WORK - self.spent);
        let mut positions = Vec::with_capacity(self.times.len());
        self.was_dear = false;
        for &time in self.times {
            while world.time() + world.substep() * (1.0 - 1e-9) <= time {
                world.step();
                if work(&*world, unit) > limit || rate * counted(&*world) > MOST_COUNTED - self.counted {
                    self.was_dear = true;
                    self.count(&*world, (unit, rate));
                    return Ok(None);
                }
            }
            positions.push(world.sample(time).position);
            if !world.is_finite() {
                self.count(&*world, (unit, rate));
                return Ok(None);
            }
        }
        self.count(&*world, (unit, rate));
        self.last_work = work(&*world, unit);
        let is_finite = positions.iter().flatten().flatten().all(|x| x.is_finite());
        Ok(is_finite.then_some(Trial {
            method,
            positions,
            work: self.last_work,
            is_patched: world.counters().fallbacks > 0,
        }))
    }

    fn count(&mut self, world: &dyn Dynamics, (unit, rate): (f64, f64)) {
        self.spent += work(world, unit);
        self.counted += rate * counted(world);
        self.substeps += world.counters().substeps;
    }
}

/// What a run took so far by what it counted `[ms]`.
fn counted(world: &dyn Dynamics) -> f64 {
    let counters = world.counters();
    let rounds = counters.iterations.saturating_sub(USUAL_ROUNDS * counters.substeps);
    counters.work_ms() + OF_A_ROUND * rounds as f64
}

/// Work of a run so far: a split substep is paid for twice over, one that went to the robust method more.
fn work(world: &dyn Dynamics, unit: f64) -> f64 {
    let counters = world.counters();
    let steps = counters.substeps + 2 * counters.guard_splits + 8 * counters.fallbacks + 8 * counters.events;
    steps as f64 * unit
}
