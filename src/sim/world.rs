//! A world: the state of a scene and the plan that moves it.

use super::bond::{Bond, PointId};
use super::command::Command;
use super::constrain::rigid;
use super::contact::bounds::{Bounds, Touch, Walls};
use super::counters::Counters;
use super::dynamics::{Dynamics, Positions, Sample};
use super::force::mouse::{self, Cursor, MouseForce};
use super::integrate::verlet;
use super::measure;
use super::model::{Model, ModelError, Precision};
use super::plan::Plan;
use super::points::Points;
use super::real::Real;
use super::timeline::Timeline;
use super::vector::{embed, widen, zero};

/// A running scene, generic over its scalar and its dimension: one source for all four.
#[derive(Clone, Debug)]
pub struct World<S: Real, const D: usize> {
    pub(crate) points: Points<S, D>,
    pub(crate) plan: Plan<S>,
    pub(crate) timeline: Timeline,
    pub(crate) gravity: [f64; D],
    pub(crate) drag_rate: f64,
    pub(crate) mouse: Option<MouseForce>,
    /// The live cursor.
    pub(crate) cursor: Option<Cursor>,
    pub(crate) walls: Option<Walls<S, D>>,
    pub(crate) touches: Vec<Touch<S>>,
    /// Accelerations do not belong to the present state: they are evaluated before the next kick.
    pub(crate) stale: bool,
    pub(crate) counters: Counters,
    bonds: Vec<Bond>,
    pinned: Vec<PointId>,
    bounds: Option<Bounds<D>>,
}

/// Points above which an automatic precision is `f32`: there memory rules, below it scalar code gains too little.
const SMALL: usize = 20_000;

/// A world for a model, its scalar as the method says.
///
/// Errors: as [`Model::check`].
pub fn build<const D: usize>(model: &Model<D>) -> Result<Box<dyn Dynamics>, ModelError> {
    let single = match model.method.precision {
        Precision::Auto => model.position.len() > SMALL,
        Precision::F32 => true,
        Precision::F64 => false,
    };
    Ok(if single { Box::new(World::<f32, D>::new(model)?) } else { Box::new(World::<f64, D>::new(model)?) })
}

impl<S: Real, const D: usize> World<S, D> {
    /// A world at the start of a model.
    ///
    /// Rigid bonds that the start violates are projected, positions first, then velocities, weighted by mass.
    /// Errors: as [`Model::check`].
    pub fn new(model: &Model<D>) -> Result<Self, ModelError> {
        model.check()?;
        let mut inverse_mass: Vec<f64> = model.mass.iter().map(|m| 1.0 / m).collect();
        for point in &model.pinned {
            inverse_mass[point.index()] = 0.0;
        }
        let points = Points::new(&model.position, &model.velocity, inverse_mass);
        let plan = Plan::new(model, &points.inverse_mass);
        let knots = model.mouse.iter().flat_map(|mouse| mouse.track.knots.iter().map(|knot| knot.0));
        let mut world = World {
            timeline: Timeline::new(plan.substep, knots.chain(model.duration)),
            points,
            plan,
            gravity: model.gravity,
            drag_rate: model.drag_rate,
            mouse: model.mouse.clone(),
            cursor: None,
            walls: model.bounds.as_ref().map(Walls::new),
            touches: Vec::new(),
            stale: true,
            counters: Counters::default(),
            bonds: model.bonds.clone(),
            pinned: model.pinned.clone(),
            bounds: model.bounds,
        };
        world.allocate();
        world.hold_start();
        Ok(world)
    }

    /// Gives the scene the lists that its phases need, and no others.
    fn allocate(&mut self) {
        let count = self.points.len();
        if !self.plan.springs.is_empty() || self.mouse.is_some() {
            self.points.acceleration = vec![zero(); count];
        }
        if self.plan.is_damped {
            self.points.velocity_ahead = vec![zero(); count];
        }
        if self.plan.projects() || self.walls.is_some() {
            self.points.displacement = vec![zero(); count];
        }
    }

    fn hold_start(&mut self) {
        if self.plan.rigid.is_empty() {
            return;
        }
        rigid::hold(&mut self.points, &self.plan.rigid, &mut self.plan.rigid_order.clone());
        verlet::advance(&mut self.points);
        self.points.displacement.fill(zero());
        rigid::hold_velocity(&mut self.points, &self.plan.rigid);
    }

    /// Where the cursor of the mouse force is now: on its track, or where the live one is.
    pub(crate) fn cursor_now(&self) -> Option<Cursor> {
        let mouse = self.mouse.as_ref()?;
        mouse.track.at(self.timeline.time()).map(Cursor::at).or(self.cursor)
    }

    fn state(&self) -> Sample {
        let spread = |list: &[[S; D]]| list.iter().map(|&x| embed(widen(x))).collect();
        Sample {
            time: self.timeline.time(),
            position: spread(&self.points.position),
            velocity: spread(&self.points.velocity),
            energy: self.energy(),
            max_strain: measure::max_strain(&self.points, &self.bonds),
        }
    }
}

impl<S: Real, const D: usize> Dynamics for World<S, D> {
    fn dimensions(&self) -> usize {
        D
    }

    fn point_count(&self) -> usize {
        self.points.len()
    }

    fn precision(&self) -> Precision {
        S::PRECISION
    }

    fn time(&self) -> f64 {
        self.timeline.time()
    }

    fn substep(&self) -> f64 {
        self.timeline.substep()
    }

    fn step(&mut self) {
        self.step_by(self.timeline.substep());
        self.timeline.advance();
    }

    fn apply(&mut self, command: Command) {
        match (command, &mut self.mouse) {
            (Command::MoveCursor(cursor), _) => self.cursor = cursor,
            (Command::ShapeMouse { strength, radius }, Some(mouse)) => {
                mouse.strength = strength;
                mouse.radius = radius;
            }
            (Command::ShapeMouse { .. }, None) => return,
        }
        self.stale = true;
    }

    fn sample(&self, time: f64) -> Sample {
        let rest = time - self.timeline.time();
        let mut copy = self.clone();
        if rest > self.timeline.substep() * 1e-9 {
            copy.step_by(rest);
            copy.timeline.advance_to(time);
        }
        rigid::hold_velocity(&mut copy.points, &copy.plan.rigid);
        copy.state()
    }

    fn positions(&self) -> Positions<'_> {
        S::flat(self.points.position.as_flattened())
    }

    fn bonds(&self) -> &[Bond] {
        &self.bonds
    }

    fn pinned(&self) -> &[PointId] {
        &self.pinned
    }

    fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        self.bounds.map(|bounds| [embed(bounds.min), embed(bounds.max)])
    }

    fn mouse(&self) -> Option<(&MouseForce, Cursor)> {
        Some((self.mouse.as_ref()?, self.cursor_now()?))
    }

    fn energy(&self) -> f64 {
        measure::energy(&self.points, &self.bonds, self.gravity)
    }

    fn counters(&self) -> &Counters {
        &self.counters
    }

    fn is_still(&self, speed: f64) -> bool {
        let track_moves = self.mouse.as_ref().is_some_and(|mouse| mouse.track.moves_after(self.timeline.time()));
        let reached = |(force, cursor)| mouse::reaches(&self.points, force, cursor);
        !track_moves && measure::is_slower(&self.points, speed) && !self.mouse().is_some_and(reached)
    }

    fn is_finite(&self) -> bool {
        self.points.position.as_flattened().iter().all(|x| x.is_finite())
    }

    fn boxed_clone(&self) -> Box<dyn Dynamics> {
        Box::new(self.clone())
    }
}
