//! How a world begins: what starts inside obstacles is moved out, lengths that contradict each other are met.

use std::sync::Arc;

use super::{Numbers, World};
use crate::sim::bond::PointId;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::counters::Counters;
use crate::sim::drive::Keys;
use crate::sim::environment::Environment;
use crate::sim::model::{Model, ModelError};
use crate::sim::plan;
use crate::sim::points::State;
use crate::sim::real::Real;
use crate::sim::timeline::Timeline;
use crate::sim::triangles::{aligned, repeats, turned, without};
use crate::sim::vector::{convert, widen, zero};

impl<S: Real, const D: usize> World<S, D> {
    /// A world at the start of a model.
    ///
    /// Bodies that start inside obstacles are moved out, each as a whole, with a warning.
    /// Rigid bonds that the start violates are projected, positions first, then velocities, weighted by mass; lengths
    /// that contradict each other are met in least squares, with a warning where that is by more than rounding. Triangles that repeat others are left out, with a warning.
    /// Errors: as [`Model::check`]; outlines of polygons that cross too often.
    pub fn new(model: &Model<D>) -> Result<Self, ModelError> {
        model.check()?;
        let repeated = repeats(&model.triangles);
        if !repeated.is_empty() {
            let triangles = without(&model.triangles, &repeated);
            let rest_areas = without(&model.rest_areas, &repeated);
            let mut world = World::new(&Model { triangles, rest_areas, ..model.clone() })?;
            world.warn_of_repeats(&repeated);
            return Ok(world);
        }
        let place = |point: PointId| model.position[point.index()];
        let triangles = turned(&model.triangles, place);
        let triangles = if model.contact.is_some() { aligned(triangles, &model.triangles, place) } else { triangles };
        if let Some(triangles) = triangles {
            return World::of_turned(&Model { triangles, ..model.clone() });
        }
        World::of_turned(model)
    }

    /// A world at the start of a model whose triangles have their corners in order.
    fn of_turned(model: &Model<D>) -> Result<Self, ModelError> {
        if let Some((rest_areas, angles)) = model.form_missing() {
            return World::of_turned(&Model { rest_areas, angles, ..model.clone() });
        }
        if let Some([found, most]) = plan::too_many_held(model) {
            return Err(ModelError::TooManyHeld { found, most });
        }
        let count = model.position.len();
        let w = plan::inverse_masses(model);
        let obstacles = Obstacles::of(model).map_err(|_| ModelError::Crossings)?;
        let cleared = plan::clear(&obstacles.widened(model), &model.bonds, (&model.position, &w), |_| false);
        let velocity = model.velocity.iter().zip(&w).map(|(&v, &w)| if w == 0.0 { zero() } else { convert(v) });
        let mut position = cleared.moved(&model.position).into_owned();
        let mut bonds = model.bonds.clone();
        let fitted = plan::fit_rest_lengths(model, &mut bonds, &mut position);
        let idle = plan::idle_drives(&bonds, |_| true, |point| position[point.index()]);
        idle.iter().for_each(|&(place, bond)| bonds.set(place, bond));
        let state = State {
            position: position.iter().map(|&x| convert(x)).collect(),
            velocity: velocity.collect(),
            position_lost: vec![zero(); count],
            velocity_lost: vec![zero(); count],
        };
        let plan = plan::compile((model, &obstacles, count), (&bonds, None), &state, &[]);
        let mut world = World {
            timeline: Timeline::new(plan.substep, model.knots()),
            around: Environment {
                gravity: model.gravity,
                mouse: model.mouse.clone(),
                cursor: None,
                lead: None,
                keys: Keys::default(),
            },
            plan,
            obstacles,
            counters: Counters::default(),
            bonds: Arc::new(bonds),
            numbers: Numbers::of(model),
            inverse_mass: Arc::new(w),
            scene_points: count,
            gathered: Vec::new(),
            warnings: Vec::new(),
            topology: 0,
            kept: Vec::new(),
            was_handed_over: false,
            is_fresh: true,
            within: Vec::new(),
            fixtures: (None, Arc::new([])),
            spans: (None, Arc::new([])),
            grabbed: Vec::new(),
            torn_beyond: 0.0,
            frozen: Vec::new(),
            ledger: None,
            model: Arc::new(model.bare()),
        };
        world.warn_of_overlap(&cleared, 0);
        world.warn_of_pins(&model.position);
        world.warn_of_held(&model.velocity);
        world.warn_of_torques(&model.position);
        world.warn_of_rounding(&model.position);
        world.warn_of_limits();
        world.warn_of_single();
        world.warn_of_wind();
        world.warn_of_areas(0);
        world.warn_of_stops(0..u32::MAX, |point| model.position[point.index()]);
        world.warn_of_radius();
        world.warn_of_friction();
        world.warn_of_flat(&position);
        world.warn_of_nested(&position);
        world.warn_of_crowds(&position);
        world.warn_of_bare_bodies();
        world.warn_of_fit(&fitted);
        world.warn_of_idle_drives(&idle.iter().map(|&(place, _)| place).collect::<Vec<_>>());
        world.begin(&state);
        world.within = cleared.stuck;
        world.foresee();
        world.begin_ledger();
        Ok(world)
    }

    /// Makes the start fit bonds and surfaces.
    fn begin(&mut self, state: &State<S, D>) {
        let mut is_held = true;
        for group in &mut self.plan.groups {
            is_held &= group.begin(&self.around, 0.0);
        }
        if !is_held {
            self.reconcile(state);
        }
        self.gather();
    }

    /// Lengths that contradict each other give way to those of the nearest shape.
    fn reconcile(&mut self, state: &State<S, D>) {
        let mut position: Vec<[f64; D]> = state.position.iter().map(|&x| widen(x)).collect();
        let changed = plan::reconcile(Arc::make_mut(&mut self.bonds), &mut position, &self.inverse_mass);
        self.warn_of_lengths(&changed);
        let state = State { position: position.into_iter().map(convert).collect(), ..state.clone() };
        self.plan = plan::compile((&self.model, &self.obstacles, self.scene_points), (&self.bonds, None), &state, &[]);
        for group in &mut self.plan.groups {
            group.begin(&self.around, 0.0);
        }
    }
}
