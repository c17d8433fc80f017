//! A world: the state of a scene and the plan that moves it.
//!
//! What a world is made of (the model that is left, its bonds and numbers) and what moves it (the plan) change together, by
//! `sim::edit` alone; what is large and seldom changes is shared by the copies of a world.

mod account;
mod face;
pub(crate) mod frozen;
mod kept;
mod meeting;
mod moved;
mod nested;
pub(crate) mod saved;
mod skins;
mod start;
mod state;
mod tension;
mod warnings;

use std::sync::Arc;

use super::bond::{Bond, PointId};
use super::bonds::Bonds;
use super::contact::obstacles::Obstacles;
use super::counters::Counters;
use super::environment::Environment;
use super::ledger::Totals;
use super::model::Model;
use super::plan::Plan;
use super::reach::Span;
use super::real::Real;
use super::timeline::Timeline;
use kept::Kept;

/// A running scene, generic over its scalar and its dimension: one source for all four.
#[derive(Clone, Debug)]
pub struct World<S: Real, const D: usize> {
    pub(crate) plan: Plan<S, D>,
    pub(crate) timeline: Timeline,
    pub(crate) around: Environment<D>,
    pub(crate) obstacles: Obstacles<S, D>,
    pub(crate) counters: Counters,
    /// The bonds that are left.
    pub(crate) bonds: Arc<Bonds>,
    /// What is left of the model, but for positions, velocities and bonds.
    pub(crate) model: Arc<Model<D>>,
    /// 1/m of every point, 0 where it is pinned or gone `[1/kg]`.
    pub(crate) inverse_mass: Arc<Vec<f64>>,
    pub(crate) numbers: Numbers,
    /// Points of the scene when the world began, which rules go by.
    pub(crate) scene_points: usize,
    /// Positions in the order of the model; empty where the first group has them so.
    gathered: Vec<[S; D]>,
    pub(crate) warnings: Vec<String>,
    /// How often points, bonds, pins or obstacles came, went or changed.
    pub(crate) topology: u64,
    /// Groups as they were before the step under way was cut, but for those that commands touched since.
    pub(crate) kept: Vec<Kept<S, D>>,
    /// Something was handed over since the timeline was looked at.
    pub(crate) was_handed_over: bool,
    /// Something was compiled since the last step.
    pub(crate) is_fresh: bool,
    /// A point each of bodies that lie in obstacles, and are led out before anything else.
    pub(crate) within: Vec<u32>,
    /// The points that are grabbed; the groups that they are in lead them.
    pub(crate) grabbed: Vec<PointId>,
    /// What is grabbed is torn off only by a cursor that is farther from it than this `[m]`; 0: by any.
    pub(crate) torn_beyond: f64,
    /// Pins that may be met, and the topology that they are of.
    pub(crate) fixtures: (Option<u64>, Arc<[u32]>),
    /// What hangs between pins that are led, and the topology that this is of.
    pub(crate) spans: (Option<u64>, Arc<[Span]>),
    /// Islands that left the finite numbers.
    pub(crate) frozen: Vec<frozen::Frozen>,
    /// Energy that came and went, where a ledger is kept.
    pub(crate) ledger: Option<Totals>,
}

/// The numbers that commands know things by.
#[derive(Clone, Debug, Default)]
pub(crate) struct Numbers {
    /// Of the bonds that are left, ascending; `None`: each has its own place.
    pub(crate) bonds: Option<Arc<Vec<u32>>>,
    /// Of the planes that are left, and of all other obstacles.
    pub(crate) obstacles: [Vec<u32>; 2],
    /// Points that are gone, ascending.
    pub(crate) gone: Arc<Vec<PointId>>,
    /// Bonds that tore or were cut, whatever became of their ends: no step reads them.
    pub(crate) torn: Arc<Vec<Bond>>,
    /// What the next bond and the next obstacle get.
    pub(crate) next_bond: u32,
    pub(crate) next_obstacle: u32,
    /// Of the constant forces that are left, in the order of the model, and what the next one gets.
    pub(crate) forces: Vec<u32>,
    pub(crate) next_force: u32,
}

impl Numbers {
    fn of<const D: usize>(model: &Model<D>) -> Self {
        let [planes, others] = [model.planes.len() as u32, (model.polygons.len() + model.convex.len()) as u32];
        let obstacles = match &model.obstacle_numbers {
            [a, b] if a.len() == planes as usize && b.len() == others as usize => model.obstacle_numbers.clone(),
            _ => [(0..planes).collect(), (planes..planes + others).collect()],
        };
        Numbers {
            bonds: None,
            obstacles,
            gone: Arc::default(),
            torn: Arc::default(),
            next_bond: model.bonds.len() as u32,
            next_obstacle: planes + others,
            forces: (0..model.forces.len() as u32).collect(),
            next_force: model.forces.len() as u32,
        }
    }

    /// The place of a bond among those that are left.
    pub(crate) fn place_of_bond(&self, number: u32) -> Option<usize> {
        match &self.bonds {
            Some(numbers) => numbers.binary_search(&number).ok(),
            None => (number < self.next_bond).then_some(number as usize),
        }
    }

    /// The number of the bond at a place.
    pub(crate) fn of_bond(&self, place: usize) -> u32 {
        self.bonds.as_ref().map_or(place as u32, |numbers| numbers[place])
    }

    pub(crate) fn is_gone(&self, point: u32) -> bool {
        self.gone.binary_search(&PointId(point)).is_ok()
    }
}
