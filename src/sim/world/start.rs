//! How a world begins: what starts inside obstacles is moved out, lengths that contradict each other are met.

use std::sync::Arc;

use super::{Numbers, World};
use crate::sim::bond::{Bond, BondKind, PointId};
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::model::{Model, ModelError};
use crate::sim::plan::{self, Cleared};
use crate::sim::plan_part::PlanPart;
use crate::sim::points::State;
use crate::sim::real::Real;
use crate::sim::solver::Solver;
use crate::sim::timeline::Timeline;
use crate::sim::triangles::{aligned, turned};
use crate::sim::vector::{add, convert, length, sub, widen, zero};

impl<S: Real, const D: usize> World<S, D> {
    /// A world at the start of a model.
    ///
    /// Bodies that start inside obstacles are moved out, each as a whole, with a warning.
    /// Rigid bonds that the start violates are projected, positions first, then velocities, weighted by mass; lengths
    /// that contradict each other are met in least squares, with a warning.
    /// Errors: as [`Model::check`]; outlines of polygons that cross too often.
    pub fn new(model: &Model<D>) -> Result<Self, ModelError> {
        model.check()?;
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
        let cleared = plan::clear(&obstacles.widened(model), &model.bonds, &model.position, &w);
        let velocity = model.velocity.iter().zip(&w).map(|(&v, &w)| if w == 0.0 { zero() } else { convert(v) });
        let mut state = State {
            position: model.position.iter().map(|&x| convert(x)).collect(),
            velocity: velocity.collect(),
            position_lost: vec![zero(); count],
            velocity_lost: vec![zero(); count],
        };
        for (points, way) in &cleared.moves {
            points.iter().for_each(|&i| state.position[i as usize] = convert(add(model.position[i as usize], *way)));
        }
        let plan = plan::compile((model, &obstacles, count), (&model.bonds, None), &state, &[]);
        let mut world = World {
            timeline: Timeline::new(plan.substep, model.knots()),
            around: Environment { gravity: model.gravity, mouse: model.mouse.clone(), cursor: None, lead: None },
            plan,
            obstacles,
            counters: Counters::default(),
            bonds: Arc::new(model.bonds.clone()),
            numbers: Numbers::of(model),
            inverse_mass: Arc::new(w),
            scene_points: count,
            gathered: Vec::new(),
            warnings: Vec::new(),
            topology: 0,
            kept: Vec::new(),
            was_handed_over: false,
            is_fresh: true,
            fixtures: (None, Arc::new([])),
            grabbed: Vec::new(),
            ledger: None,
            model: Arc::new(model.bare()),
        };
        world.warn_of_overlap(&cleared);
        world.warn_of_pins(&model.position);
        world.warn_of_limits();
        world.warn_of_wind();
        world.warn_of_areas(0);
        world.warn_of_radius();
        world.begin(&state);
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

    /// Tells of bonds, by their numbers, that were given other lengths.
    pub(crate) fn warn_of_lengths(&mut self, changed: &[usize]) {
        if !changed.is_empty() {
            self.warnings.push(format!(
                "rigid bonds contradict each other: {} were given the lengths of the nearest shape: make them agree",
                list(changed)
            ));
        }
    }

    pub(crate) fn warn_of_overlap(&mut self, cleared: &Cleared<D>) {
        let several = |count: usize| match count {
            1 => "a body".to_owned(),
            _ => format!("{count} bodies"),
        };
        if !cleared.moves.is_empty() {
            self.warnings.push(format!(
                "{} started inside an obstacle: moved out as a whole, by up to {:.3} m",
                several(cleared.moves.len()),
                cleared.furthest()
            ));
        }
        if cleared.stuck > 0 {
            self.warnings.push(format!(
                "{} started inside an obstacle without a way out, or pinned: only points are put out, one by one, as far \
                 as bonds let them",
                several(cleared.stuck)
            ));
        }
    }

    fn warn_of_pins(&mut self, position: &[[f64; D]]) {
        let w = &self.inverse_mass;
        let leads = |point: PointId| self.model.pin_motion.iter().any(|(led, _)| *led == point);
        let stands = |bond: &(usize, Bond)| {
            let (a, b) = (bond.1.a, bond.1.b);
            let d = length(sub(position[a.index()], position[b.index()]));
            let is_off = (d - bond.1.rest_length).abs() > 1e-8 * bond.1.rest_length.max(1.0);
            let is_fixed = w[a.index()] + w[b.index()] == 0.0;
            bond.1.kind == BondKind::Rigid && is_fixed && (is_off || leads(a) || leads(b))
        };
        let between: Vec<usize> = self.bonds.iter().enumerate().filter(stands).map(|(k, _)| k).collect();
        if !between.is_empty() {
            let text = format!("{} cannot hold: both ends are pinned, and not at that length", list(&between));
            self.warnings.push(text);
        }
    }

    /// Tells of a wind that pushes nothing.
    pub(crate) fn warn_of_wind(&mut self) {
        if self.model.has_idle_wind() {
            self.warnings.push("the wind pushes nothing, for there is no drag: give `drag_rate`".to_owned());
        }
    }

    /// Tells of triangles from the `first` on that resist no change of their area, as they have none.
    pub(crate) fn warn_of_areas(&mut self, first: usize) {
        let resist = self.model.areas.is_some_and(|areas| areas.stiffness > 0.0);
        let flat: Vec<usize> =
            (first..self.model.rest_areas.len()).filter(|&k| self.model.rest_areas[k] == 0.0).collect();
        if resist && !flat.is_empty() {
            let text = format!("{} of area 0 at the start: left out of `areas`", named("triangle", &flat));
            self.warnings.push(text);
        }
    }

    fn warn_of_limits(&mut self) {
        let is_swept = |part: &&PlanPart| part.solver == Solver::Path && part.kernel.is_empty() && part.bonds > 0;
        let swept: usize = self.plan.parts.iter().filter(is_swept).map(|part| part.bonds).sum();
        if swept > 0 {
            let text = format!("bonds with a limit make no paths: {swept} bonds beside them are swept as xpbd does");
            self.warnings.push(text);
        }
    }
}

/// "bond 3", "bonds 1, 2 and 4", the first few of many.
fn list(bonds: &[usize]) -> String {
    named("bond", bonds)
}

fn named(what: &str, numbers: &[usize]) -> String {
    const MOST: usize = 8;
    let shown: Vec<String> = numbers.iter().take(MOST).map(usize::to_string).collect();
    match (&shown[..], numbers.len()) {
        ([one], _) => format!("{what} {one}"),
        (some, count) if count > MOST => format!("{what}s {} and {} more", some.join(", "), count - MOST),
        (some, _) => format!("{what}s {} and {}", some[..some.len() - 1].join(", "), some[some.len() - 1]),
    }
}
