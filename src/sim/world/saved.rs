//! A running world that is kept, and gone on with.
//!
//! A world that goes on is compiled anew from what was kept, and runs the same way every time that it does. The one that it was
//! kept of goes on undisturbed: the two are the same but for what rounding makes of another order of the same numbers.

use std::any::Any;
use std::sync::Arc;

use super::{Numbers, World};
use crate::sim::bonds::Bonds;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::counters::Counters;
use crate::sim::dynamics::Dynamics;
use crate::sim::environment::{CursorPath, Environment, Lead};
use crate::sim::group::Group;
use crate::sim::model::{Model, ModelError};
use crate::sim::moved::Why;
use crate::sim::plan::{self, NOWHERE, OWN};
use crate::sim::points::State;
use crate::sim::real::{Precision, Real};
use crate::sim::saved::{Saved, SavedWorld};
use crate::sim::timeline::Timeline;
use crate::sim::vector::{convert, widen};

/// The kept world goes on.
///
/// Errors: lists that do not fit each other, numbers outside their ranges.
pub fn resume(saved: &SavedWorld) -> Result<Box<dyn Dynamics>, ModelError> {
    Ok(match saved {
        SavedWorld::Plane(saved) if saved.precision == Precision::F32 => Box::new(World::<f32, 2>::resumed(saved)?),
        SavedWorld::Plane(saved) => Box::new(World::<f64, 2>::resumed(saved)?),
        SavedWorld::Space(saved) if saved.precision == Precision::F32 => Box::new(World::<f32, 3>::resumed(saved)?),
        SavedWorld::Space(saved) => Box::new(World::<f64, 3>::resumed(saved)?),
    })
}

impl<S: Real, const D: usize> World<S, D> {
    /// The world as it stands.
    pub(super) fn saved(&self) -> Saved<D> {
        let mut copy = self.clone();
        let t = self.timeline.time();
        for group in &mut copy.plan.groups {
            group.beyond_rounding(Group::hold_velocity);
            group.centre_velocity(&copy.around, t);
        }
        let State { position, velocity, position_lost, velocity_lost } = copy.state_of(0..self.count());
        let wide = |list: Vec<[S; D]>| list.into_iter().map(widen).collect();
        Saved {
            model: Model {
                position: wide(position),
                velocity: wide(velocity),
                bonds: Bonds::clone(&self.bonds),
                mouse: self.around.mouse.clone(),
                obstacle_numbers: self.numbers.obstacles.clone(),
                ..Model::clone(&self.model)
            },
            precision: S::PRECISION,
            time: t,
            substep: self.timeline.nominal(),
            scene_points: self.scene_points,
            lost: [wide(position_lost), wide(velocity_lost)],
            gone: self.numbers.gone.to_vec(),
            bond_numbers: self.numbers.bonds.as_ref().map(|numbers| numbers.to_vec()),
            next_numbers: [self.numbers.next_bond, self.numbers.next_obstacle],
            force_numbers: self.numbers.forces.clone(),
            next_force: self.numbers.next_force,
            cursor: self.around.cursor.map(|path| path.parts()),
            grabbed: self.grabbed.clone(),
            torn_beyond: self.torn_beyond,
            lead: self.around.lead.map(|lead| [lead.point, lead.normal]),
            handed_over: self.handed_over(),
            keys: self.around.keys.clone(),
        }
    }

    /// A world that goes on from one that was kept.
    ///
    /// Errors: as [`resume`].
    fn resumed(saved: &Saved<D>) -> Result<Self, ModelError> {
        saved.check()?;
        let model = &saved.model;
        let obstacles = Obstacles::of(model).map_err(|_| ModelError::Crossings)?;
        let narrow = |list: &[[f64; D]]| list.iter().map(|&x| convert(x)).collect();
        let state = State {
            position: narrow(&model.position),
            velocity: narrow(&model.velocity),
            position_lost: narrow(&saved.lost[0]),
            velocity_lost: narrow(&saved.lost[1]),
        };
        let mut without_gone = model.clone();
        without_gone.pinned.extend(&saved.gone);
        let numbers = saved.bond_numbers.as_deref();
        let mut live = vec![OWN; if saved.handed_over.is_empty() { 0 } else { state.position.len() }];
        let handed_over = saved.handed_over.iter().filter(|entry| entry.why != Why::NotFinite);
        handed_over.for_each(|handed| live[handed.first.index()] = handed.first.0);
        let plan =
            plan::compile((&without_gone, &obstacles, saved.scene_points), (&model.bonds, numbers), &state, &live);
        let mut inverse_mass = plan::inverse_masses(&without_gone);
        saved.gone.iter().for_each(|point| inverse_mass[point.index()] = 0.0);
        let cursor = saved.cursor.map(CursorPath::of);
        let lead = saved.lead.map(|[point, normal]| Lead { point, normal });
        let mut world = World {
            timeline: Timeline::resumed(saved.substep, model.knots(), saved.time),
            around: Environment {
                gravity: model.gravity,
                mouse: model.mouse.clone(),
                cursor,
                lead,
                keys: saved.keys.clone(),
            },
            plan,
            obstacles,
            counters: Counters::default(),
            bonds: Arc::new(model.bonds.clone()),
            numbers: Numbers {
                bonds: saved.bond_numbers.clone().map(Arc::new),
                gone: Arc::new(saved.gone.clone()),
                next_bond: saved.next_numbers[0],
                next_obstacle: saved.next_numbers[1],
                forces: saved.force_numbers.clone(),
                next_force: saved.next_force,
                ..Numbers::of(model)
            },
            inverse_mass: Arc::new(inverse_mass),
            scene_points: saved.scene_points,
            gathered: Vec::new(),
            warnings: Vec::new(),
            topology: 0,
            kept: Vec::new(),
            was_handed_over: false,
            is_fresh: true,
            within: Vec::new(),
            fixtures: (None, Arc::new([])),
            spans: (None, Arc::new([])),
            grabbed: saved.grabbed.clone(),
            torn_beyond: saved.torn_beyond,
            frozen: Vec::new(),
            ledger: None,
            model: Arc::new(model.bare()),
        };
        world.spread_gone();
        world.note_handed_over(&saved.handed_over);
        for group in &mut world.plan.groups {
            group.resume(&world.around, saved.time);
        }
        for entry in saved.handed_over.iter().filter(|entry| entry.why == Why::NotFinite) {
            world.freeze(&[entry.first.0], (model.method.solver, entry.since));
        }
        world.hold_on();
        world.gather();
        world.begin_ledger();
        Ok(world)
    }

    /// Points that are gone have no place.
    fn spread_gone(&mut self) {
        if self.numbers.gone.is_empty() {
            return;
        }
        self.spread();
        let World { plan, numbers, .. } = self;
        numbers.gone.iter().for_each(|point| plan.slots[point.index()] = NOWHERE);
    }
}

/// A kept world of any dimension.
pub(super) fn of_any<const D: usize>(saved: Saved<D>) -> Option<SavedWorld> {
    let saved: Box<dyn Any> = Box::new(saved);
    match saved.downcast::<Saved<2>>() {
        Ok(plane) => Some(SavedWorld::Plane(*plane)),
        Err(other) => other.downcast::<Saved<3>>().ok().map(|space| SavedWorld::Space(*space)),
    }
}
