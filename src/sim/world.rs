//! A world: the state of a scene and the plan that moves it.

use std::sync::Arc;

use super::bond::{Bond, BondKind, PointId};
use super::bonds::Bonds;
use super::command::{Applied, Command, CommandError, MouseChange};
use super::contact::obstacles::Obstacles;
use super::contact::polygon::Polygon;
use super::counters::Counters;
use super::dynamics::{Dynamics, GrabView, Sample};
use super::environment::{CursorPath, Environment};
use super::force::mouse::{self, Cursor, MouseForce};
use super::group::Group;
use super::measure;
use super::model::{Model, ModelError};
use super::plan::{self, Cleared, Plan};
use super::plan_part::PlanPart;
use super::points::State;
use super::real::{Positions, Precision, Real};
use super::solver::Solver;
use super::timeline::Timeline;
use super::vector::{add, convert, embed, length, sub, widen, zero};

/// A running scene, generic over its scalar and its dimension: one source for all four.
#[derive(Clone, Debug)]
pub struct World<S: Real, const D: usize> {
    pub(crate) plan: Plan<S, D>,
    pub(crate) timeline: Timeline,
    pub(crate) around: Environment<D>,
    obstacles: Obstacles<S, D>,
    pub(crate) counters: Counters,
    /// The bonds that are left.
    bonds: Bonds,
    /// Positions in the order of the model; empty where the first group has them so.
    gathered: Vec<[S; D]>,
    warnings: Vec<String>,
    topology: u64,
    model: Arc<Model<D>>,
}

/// A world for a model, its scalar as the method says.
///
/// Errors: as [`Model::check`].
pub fn build<const D: usize>(model: &Model<D>) -> Result<Box<dyn Dynamics>, ModelError> {
    Ok(if plan::is_single(model) {
        Box::new(World::<f32, D>::new(model)?)
    } else {
        Box::new(World::<f64, D>::new(model)?)
    })
}

impl<S: Real, const D: usize> World<S, D> {
    /// A world at the start of a model.
    ///
    /// Bodies that start inside obstacles are moved out, each as a whole, with a warning.
    /// Rigid bonds that the start violates are projected, positions first, then velocities, weighted by mass; lengths
    /// that contradict each other are met in least squares, with a warning.
    /// Errors: as [`Model::check`]; outlines of polygons that cross too often.
    pub fn new(model: &Model<D>) -> Result<Self, ModelError> {
        model.check()?;
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
        let plan = plan::compile((model, &obstacles), &model.bonds, &state);
        let tracks = model.pin_motion.iter().flat_map(|(_, track)| track.knots.iter().map(|knot| knot.0));
        let mouse = model.mouse.iter().flat_map(|mouse| mouse.track.knots.iter().map(|knot| knot.0));
        let mut world = World {
            timeline: Timeline::new(plan.substep, tracks.chain(mouse).chain(model.duration)),
            around: Environment { gravity: model.gravity, mouse: model.mouse.clone(), cursor: None },
            plan,
            obstacles,
            counters: Counters::default(),
            bonds: model.bonds.clone(),
            gathered: Vec::new(),
            warnings: Vec::new(),
            topology: 0,
            model: Arc::new(Model { position: Vec::new(), velocity: Vec::new(), bonds: Bonds::new(), ..model.clone() }),
        };
        world.warn_of_overlap(&cleared);
        world.warn_of_pins(&w, &model.position);
        world.warn_of_limits();
        world.begin(&state, &w);
        Ok(world)
    }

    /// Makes the start fit bonds and surfaces.
    fn begin(&mut self, state: &State<S, D>, w: &[f64]) {
        let mut is_held = true;
        for group in &mut self.plan.groups {
            is_held &= group.begin(&self.around, 0.0);
        }
        if !is_held {
            self.reconcile(state, w);
        }
        self.gather();
    }

    /// Lengths that contradict each other give way to those of the nearest shape.
    fn reconcile(&mut self, state: &State<S, D>, w: &[f64]) {
        let mut position: Vec<[f64; D]> = state.position.iter().map(|&x| widen(x)).collect();
        let changed = plan::reconcile(&mut self.bonds, &mut position, w);
        if !changed.is_empty() {
            self.warnings.push(format!(
                "rigid bonds contradict each other: {} were given the lengths of the nearest shape: make them agree",
                list(&changed)
            ));
        }
        let state = State { position: position.into_iter().map(convert).collect(), ..state.clone() };
        self.plan = plan::compile((&self.model, &self.obstacles), &self.bonds, &state);
        for group in &mut self.plan.groups {
            group.begin(&self.around, 0.0);
        }
    }

    fn warn_of_overlap(&mut self, cleared: &Cleared<D>) {
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

    fn warn_of_pins(&mut self, w: &[f64], position: &[[f64; D]]) {
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

    fn warn_of_limits(&mut self) {
        let is_swept = |part: &&PlanPart| part.solver == Solver::Path && part.kernel.is_empty() && part.bonds > 0;
        let swept: usize = self.plan.parts.iter().filter(is_swept).map(|part| part.bonds).sum();
        if swept > 0 {
            let text = format!("bonds with a limit make no paths: {swept} bonds beside them are swept as xpbd does");
            self.warnings.push(text);
        }
    }

    /// Bonds that are overstretched at time `t` [s] are gone: the plan is made anew without them.
    pub(crate) fn tear(&mut self, mut torn: Vec<u32>, t: f64) {
        torn.sort_unstable();
        torn.dedup();
        self.counters.bonds_torn += torn.len() as u64;
        self.topology += 1;
        let mut index = 0;
        self.bonds.retain(|_| {
            index += 1;
            torn.binary_search(&(index - 1)).is_err()
        });
        // Pieces may be moved in other substeps: all start with the velocities of now.
        for group in &mut self.plan.groups {
            group.centre_velocity(&self.around, t);
        }
        let state = self.state_of_all();
        self.plan = plan::compile((&self.model, &self.obstacles), &self.bonds, &state);
        for group in &mut self.plan.groups {
            group.begin(&self.around, t);
        }
    }

    /// The state in the order of the model.
    fn state_of_all(&self) -> State<S, D> {
        let pick = |list: fn(&super::points::Points<S, D>) -> &[[S; D]]| {
            // Large bodies have no list of what rounding takes.
            let of = |&[group, slot]: &[u32; 2]| {
                let list = list(&self.plan.groups[group as usize].points);
                list.get(slot as usize).copied().unwrap_or(zero())
            };
            match &self.plan.groups[..] {
                [only] if self.plan.is_plain => (0..only.points.len() as u32).map(|slot| of(&[0, slot])).collect(),
                _ => self.plan.slots.iter().map(of).collect(),
            }
        };
        State {
            position: pick(|points| &points.position),
            velocity: pick(|points| &points.velocity),
            position_lost: pick(|points| &points.position_lost),
            velocity_lost: pick(|points| &points.velocity_lost),
        }
    }

    /// Copies positions into the order of the model, where the groups have another.
    pub(crate) fn gather(&mut self) {
        if self.plan.is_plain {
            return self.gathered.clear();
        }
        let of = |&[group, slot]: &[u32; 2]| self.plan.groups[group as usize].points.position[slot as usize];
        let slots = self.plan.slots.iter().map(of);
        self.gathered.clear();
        self.gathered.extend(slots);
    }

    fn state(&self) -> Sample {
        let state = self.state_of_all();
        let position: Vec<[f64; D]> = state.position.iter().map(|&x| widen(x)).collect();
        let velocity: Vec<[f64; D]> = state.velocity.iter().map(|&v| widen(v)).collect();
        Sample {
            time: self.timeline.time(),
            energy: self.energy_of(&position, &velocity),
            max_strain: measure::max_strain(&position, &self.bonds),
            position: position.into_iter().map(embed).collect(),
            velocity: velocity.into_iter().map(embed).collect(),
        }
    }

    fn energy_of(&self, position: &[[f64; D]], velocity: &[[f64; D]]) -> f64 {
        let w = plan::inverse_masses(&*self.model);
        measure::energy(|i| position[i], |i| velocity[i], &w, &self.bonds, self.around.gravity)
    }

    /// Whether the mouse is still to be moved by its track.
    fn mouse_moves(&self) -> bool {
        let t = self.timeline.time();
        self.around.mouse.as_ref().is_some_and(|mouse| mouse.track.moves_after(t))
    }

    /// Does a command: see [`Dynamics::apply`].
    fn edit(&mut self, command: &Command) -> Result<Applied, CommandError> {
        match command {
            Command::Cursor { to, by } => {
                let t = self.timeline.time();
                self.around.cursor = to.map(|to| CursorPath::onwards(self.around.cursor, to, t, *by));
            }
            Command::Mouse(MouseChange { strength, radius, .. }) => {
                if let Some(mouse) = &mut self.around.mouse {
                    mouse.strength = strength.unwrap_or(mouse.strength);
                    mouse.radius = radius.unwrap_or(mouse.radius);
                }
            }
            _ => return Err(CommandError::Invalid("not built yet".to_owned())),
        }
        self.refresh();
        Ok(Applied { is_something: true, ..Applied::default() })
    }

    /// Something changed from outside: nothing that was worked out before belongs to the present.
    fn refresh(&mut self) {
        let t = self.timeline.time();
        for group in &mut self.plan.groups {
            group.stir(&self.around, t);
            group.mark_inside(&self.around, t);
        }
    }
}

/// "bond 3", "bonds 1, 2 and 4", the first few of many.
fn list(bonds: &[usize]) -> String {
    const MOST: usize = 8;
    let shown: Vec<String> = bonds.iter().take(MOST).map(usize::to_string).collect();
    match (&shown[..], bonds.len()) {
        ([one], _) => format!("bond {one}"),
        (some, count) if count > MOST => format!("bonds {} and {} more", some.join(", "), count - MOST),
        (some, _) => format!("bonds {} and {}", some[..some.len() - 1].join(", "), some[some.len() - 1]),
    }
}

impl<S: Real, const D: usize> Dynamics for World<S, D> {
    fn dimensions(&self) -> usize {
        D
    }

    fn point_count(&self) -> usize {
        match &self.plan.groups[..] {
            [only] if self.plan.is_plain => only.points.len(),
            _ => self.plan.slots.len(),
        }
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

    fn step_until(&mut self, time: f64) {
        let (t, h) = (self.timeline.time(), self.timeline.substep());
        if t + h <= time + 1e-9 * h {
            return self.step();
        }
        self.step_by(time - t);
        self.timeline.advance_to(time);
    }

    fn apply(&mut self, command: &Command) -> Result<Applied, CommandError> {
        self.edit(command)
    }

    fn topology(&self) -> u64 {
        self.topology
    }

    fn gone(&self) -> &[PointId] {
        &[]
    }

    fn bond_numbers(&self) -> Option<&[u32]> {
        None
    }

    fn obstacle_numbers(&self) -> [&[u32]; 2] {
        [&[], &[]]
    }

    fn next_numbers(&self) -> [u32; 3] {
        [0; 3]
    }

    fn cursor(&self) -> Option<Cursor> {
        self.around.cursor.map(|path| path.at(self.timeline.time()))
    }

    fn grab(&self) -> Option<GrabView> {
        None
    }

    fn sample(&self, time: f64) -> Sample {
        let rest = time - self.timeline.time();
        let mut copy = self.clone();
        if rest > self.timeline.substep() * 1e-9 {
            copy.step_by(rest);
            copy.timeline.advance_to(time);
        }
        for group in &mut copy.plan.groups {
            group.hold_velocity();
            group.centre_velocity(&copy.around, time);
        }
        copy.state()
    }

    fn positions(&self) -> Positions<'_> {
        let own = || self.plan.groups.first().map_or(&[][..], |group| &group.points.position);
        let positions: &[[S; D]] = if self.plan.is_plain { own() } else { &self.gathered };
        S::flat(positions.as_flattened())
    }

    fn bonds(&self) -> &Bonds {
        &self.bonds
    }

    fn pinned(&self) -> &[PointId] {
        &self.model.pinned
    }

    fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        self.model.bounds.map(|bounds| [embed(bounds.min), embed(bounds.max)])
    }

    fn planes(&self) -> Vec<[[f64; 3]; 2]> {
        self.model.planes.iter().map(|plane| [embed(plane.point), embed(plane.normal)]).collect()
    }

    fn polygons(&self) -> &[Polygon] {
        &self.model.polygons
    }

    fn mouse(&self) -> Option<(&MouseForce, Cursor)> {
        self.around.mouse_at(self.timeline.time())
    }

    fn energy(&self) -> f64 {
        // Shown in every frame: no list is made of the state.
        let points_of = |i: usize| match self.plan.is_plain {
            true => (&self.plan.groups[0].points, i),
            false => (&self.plan.groups[self.plan.slots[i][0] as usize].points, self.plan.slots[i][1] as usize),
        };
        let position = |i: usize| {
            let (points, slot) = points_of(i);
            widen(points.position[slot])
        };
        let velocity = |i: usize| {
            let (points, slot) = points_of(i);
            widen(points.velocity[slot])
        };
        let w = plan::inverse_masses(&*self.model);
        measure::energy(position, velocity, &w, &self.bonds, self.around.gravity)
    }

    fn counters(&self) -> &Counters {
        &self.counters
    }

    fn heap_bytes(&self) -> usize {
        let groups: usize = self.plan.groups.iter().map(|group| group.heap_bytes()).sum();
        let own = self.plan.slots.capacity() * 8 + self.gathered.capacity() * size_of::<[S; D]>();
        let model = 8 * self.model.mass.capacity() + 4 * self.model.pinned.capacity();
        groups + own + model + self.bonds.heap_bytes()
    }

    fn parts(&self) -> &[PlanPart] {
        &self.plan.parts
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn is_asleep(&self) -> bool {
        !self.mouse_moves() && self.plan.groups.iter().all(Group::is_asleep)
    }

    fn wake(&mut self) {
        self.plan.groups.iter_mut().for_each(Group::wake);
    }

    fn is_still(&self, speed: f64) -> bool {
        let t = self.timeline.time();
        let track_moves = self.mouse_moves() || self.model.pin_motion.iter().any(|(_, track)| track.moves_after(t));
        let groups = &self.plan.groups;
        let reached = |(force, cursor)| groups.iter().any(|group| mouse::reaches(&group.points, force, cursor));
        !track_moves
            && groups.iter().all(|group| measure::is_slower(&group.points, speed))
            && !self.mouse().is_some_and(reached)
    }

    fn is_finite(&self) -> bool {
        let is_fine = |points: &[[S; D]]| points.as_flattened().iter().all(|x| x.is_finite());
        self.plan.groups.iter().all(|group| is_fine(&group.points.position))
    }

    fn boxed_clone(&self) -> Box<dyn Dynamics> {
        Box::new(self.clone())
    }
}
