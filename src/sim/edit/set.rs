//! Points, bonds, obstacles, the mouse force and the scene get other numbers.

use std::sync::Arc;

use super::add::check_surface;
use super::check::{finite, value, values};
use super::{Applied, CommandError, done, invalid};
use crate::sim::bond::{Bond, BondId, BondKind, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::command::{AngleChange, BondChange, Change, Kind, MouseChange, SceneChange, Values};
use crate::sim::contact::bounds::Bounds;
use crate::sim::contact::penalty::Penalty;
use crate::sim::contact::skin::SkinMaterial;
use crate::sim::force::mouse::{MouseForce, Profile, Region, Track};
use crate::sim::force::wind::Wind;
use crate::sim::model::{Method, Model};
use crate::sim::moved::Moved;
use crate::sim::real::Real;
use crate::sim::vector::{convert, truncate, zero};
use crate::sim::world::World;

/// How much stronger than asked for the mouse force is that islands are made for, where it is stronger than any before: not every
/// turn at its knob is to make all of them anew.
const HEADROOM: f64 = 2.0;
/// Stiffness of a spring that nothing is said of `[N/m]`.
const STIFFNESS: f64 = 1000.0;

impl<S: Real, const D: usize> World<S, D> {
    pub(super) fn set(&mut self, change: &Change) -> Result<Applied, CommandError> {
        match change {
            Change::Points { points, mass, velocity, skin } => {
                self.set_points(points, (mass.as_ref(), velocity.as_deref(), *skin))
            }
            Change::Bonds { bonds, to } => self.set_bonds(bonds, to),
            Change::Angles { angles, to } => self.set_angles(angles, to),
            Change::Obstacles { obstacles, restitution, friction, penalty } => {
                self.set_obstacles(obstacles, (*restitution, *friction), *penalty)
            }
            Change::Forces { forces, force, torque } => self.set_forces(forces, (*force, *torque)),
            Change::Scene(change) => self.set_scene(change),
        }
    }

    fn set_points(
        &mut self,
        points: &[PointId],
        (mass, velocity, skin): (Option<&Values>, Option<&[[f64; 3]]>, SkinMaterial),
    ) -> Result<Applied, CommandError> {
        self.check_points(points)?;
        if let Some(mass) = mass {
            let fits = |m: f64| m > 0.0 && m.is_finite() && (1.0 / m).is_finite();
            values("mass", mass, points.len(), (fits, "finite and > 0"))?;
        }
        if let Some(list) = velocity {
            finite("velocity", list.iter().flatten())?;
            if list.len() != 1 && list.len() != points.len() {
                let (found, count) = (list.len(), points.len());
                return Err(invalid(format!(
                    "velocity has {found} values for {count} that are named: give one, or one each"
                )));
            }
        }
        if !skin.is_fine() {
            return Err(invalid("friction and radius of skins must be finite and >= 0, restitution from 0 to 1"));
        }
        let has_skin = skin != SkinMaterial::default();
        if points.is_empty() || (mass.is_none() && velocity.is_none() && !has_skin) {
            return Ok(done(false));
        }
        let touched: Vec<u32> = points.iter().map(|point| point.0).collect();
        let mut detached = self.detach(&self.with_mates(touched.clone()), false);
        if has_skin {
            let skins = &mut Arc::make_mut(&mut self.model).skins;
            points.iter().for_each(|&point| skins.set([point], skins.of(point).overlaid(skin)));
        }
        if let Some(mass) = mass {
            let model = Arc::make_mut(&mut self.model);
            points.iter().enumerate().for_each(|(k, point)| model.mass[point.index()] = value(mass, k));
            self.weigh(touched.iter().copied());
        }
        for (k, &point) in touched.iter().enumerate().filter(|_| velocity.is_some()) {
            let given = velocity.and_then(|list| list.get(k).or(list.first()));
            if let (Some(place), Some(&v)) = (detached.place(point), given)
                && self.inverse_mass[point as usize] > 0.0
            {
                detached.state.velocity[place] = convert(truncate(v));
                detached.state.velocity_lost[place] = zero();
            }
        }
        self.attach(detached);
        Ok(done(true))
    }

    fn set_bonds(&mut self, bonds: &[BondId], to: &BondChange) -> Result<Applied, CommandError> {
        let places = self.bond_places(bonds)?;
        if places.is_empty() || *to == BondChange::default() {
            return Ok(done(false));
        }
        check_change(to, places.len())?;
        let mut changed = Bonds::clone(&self.bonds);
        for (k, &place) in places.iter().enumerate() {
            let bond =
                to.applied(changed.get(place), k).map_err(|why| invalid(format!("bond {} {why}", bonds[k].0)))?;
            self.model.check_added_bond(bonds[k].index(), &bond)?;
            changed.set(place, bond);
        }
        let mut changes = vec![false; self.bonds.len()];
        places.iter().for_each(|&place| changes[place] = true);
        let detached = self.detach(&self.free_ends(&changes), false);
        self.bonds = Arc::new(changed);
        self.leave_out_idle_drives(&detached);
        self.tell_drives();
        self.attach(detached);
        Ok(done(true))
    }

    fn set_angles(&mut self, angles: &[u32], to: &AngleChange) -> Result<Applied, CommandError> {
        let places = self.angle_places(angles)?;
        if places.is_empty() || *to == AngleChange::default() {
            return Ok(done(false));
        }
        let at_least_0 = |x: f64| x >= 0.0 && x.is_finite();
        for (name, list) in [("stiffness", &to.stiffness), ("damping", &to.damping)] {
            list.iter().try_for_each(|list| values(name, list, places.len(), (at_least_0, "finite and >= 0")))?;
        }
        let is_rest = |x: f64| x > 0.0 && x < 2.0 * std::f64::consts::PI;
        to.rest.iter().try_for_each(|list| values("rest", list, places.len(), (is_rest, "between 0 and 2 pi")))?;
        let mut changed = self.model.angles.clone();
        for (k, &place) in places.iter().enumerate() {
            let angle = &mut changed.list[place];
            angle.rest = to.rest.as_ref().map_or(angle.rest, |list| value(list, k));
            angle.stiffness = to.stiffness.as_ref().map_or(angle.stiffness, |list| value(list, k));
            angle.damping = to.damping.as_ref().map_or(angle.damping, |list| value(list, k));
            if let Some(range) = to.range {
                (angle.range, angle.stop) = (range, 0.0);
            }
            angle.drive = to.drive.unwrap_or(angle.drive);
            self.model.check_angle(angle)?;
        }
        let full = self.laid_out(&Model { angles: changed, ..Model::clone(&self.model) });
        let changed = full.form_missing().map_or(full.angles, |(_, angles)| angles);
        let detached = self.detach(&self.free_points_of(&places), false);
        Arc::make_mut(&mut self.model).angles = changed;
        self.tell_drives();
        self.attach(detached);
        if to.range.is_some() {
            angles.iter().for_each(|&number| self.warn_of_stops_now(number..number + 1));
        }
        Ok(done(true))
    }

    fn set_obstacles(
        &mut self,
        obstacles: &[u32],
        (restitution, friction): (Option<f64>, Option<f64>),
        penalty: Option<Option<Penalty>>,
    ) -> Result<Applied, CommandError> {
        self.check_obstacles(obstacles)?;
        check_surface(restitution.unwrap_or(0.0), friction.unwrap_or(0.0))?;
        if obstacles.is_empty() || (restitution.is_none() && friction.is_none() && penalty.is_none()) {
            return Ok(done(false));
        }
        if let Some(penalty) = penalty {
            self.check_penalty(obstacles, penalty)?;
        }
        let detached = self.detach(&[], true);
        let model = Arc::make_mut(&mut self.model);
        let [planes, others] = &self.numbers.obstacles;
        for (plane, _) in model.planes.iter_mut().zip(planes).filter(|(_, number)| obstacles.contains(number)) {
            plane.penalty = penalty.unwrap_or(plane.penalty);
        }
        let planes = model.planes.iter_mut().zip(planes).map(|(on, n)| (&mut on.restitution, &mut on.friction, n));
        let polygons = model.polygons.iter_mut().zip(others).map(|(on, n)| (&mut on.restitution, &mut on.friction, n));
        let convex = model.convex.iter_mut().zip(others).map(|(on, n)| (&mut on.restitution, &mut on.friction, n));
        let all = planes.chain(polygons).chain(convex);
        for (own_restitution, own_friction, _) in all.filter(|(.., n)| obstacles.contains(n)) {
            *own_restitution = restitution.unwrap_or(*own_restitution);
            *own_friction = friction.unwrap_or(*own_friction);
        }
        self.obstacles = Self::obstacles_of(&self.model)?;
        self.attach(detached);
        Ok(done(true))
    }

    /// Errors: some of these obstacles are no planes; the scene, its method or the numbers allow no such penalty.
    fn check_penalty(&self, obstacles: &[u32], penalty: Option<Penalty>) -> Result<(), CommandError> {
        let planes = &self.numbers.obstacles[0];
        if let Some(other) = obstacles.iter().find(|number| !planes.contains(number)) {
            return Err(invalid(format!("obstacle {other} is no plane: a penalty is of planes alone")));
        }
        let mut model = Model::clone(&self.model);
        for (plane, _) in model.planes.iter_mut().zip(planes).filter(|(_, number)| obstacles.contains(number)) {
            plane.penalty = penalty;
        }
        Ok(model.check_surroundings()?)
    }

    fn set_scene(&mut self, change: &SceneChange) -> Result<Applied, CommandError> {
        if *change == SceneChange::default() {
            return Ok(done(false));
        }
        let mut model = Model::clone(&self.model);
        if let Some(gravity) = change.gravity {
            model.gravity = truncate(gravity);
        }
        model.drag_rate = change.drag_rate.unwrap_or(model.drag_rate);
        if let Some(wind) = change.wind {
            model.wind = wind.map(|wind| Wind {
                velocity: truncate(wind.velocity),
                turbulence: wind.turbulence,
                seed: wind.seed,
            });
        }
        if let Some(bounds) = change.bounds {
            model.bounds = bounds.map(|bounds| Bounds {
                min: truncate(bounds.min),
                max: truncate(bounds.max),
                restitution: bounds.restitution,
                friction: bounds.friction,
            });
        }
        model.contact = change.contact.unwrap_or(model.contact);
        if let Some(areas) = change.areas {
            model.areas = areas;
        }
        if change.areas.is_some() || change.contact.is_some() {
            model.rest_areas = self.rest_areas(&model);
        }
        if let Some(method) = change.method {
            let Method { precision, ledger, .. } = model.method;
            model.method = Method { precision, ledger, ..method };
        }
        if model == *self.model {
            return Ok(done(false));
        }
        model.check_surroundings()?;
        for (k, bond) in self.bonds.iter().enumerate() {
            model.check_added_bond(k, &bond)?;
        }
        for angle in &model.angles.list {
            model.check_angle(angle)?;
        }
        model.check_areas()?;
        if let Some(bounds) = &model.bounds {
            check_surface(bounds.restitution, bounds.friction)?;
        }
        if self.allows_other_work(&model) {
            if model.budget() > self.model.budget() {
                self.allow_more(self.timeline.time());
            }
            self.model = Arc::new(model);
            return Ok(done(true));
        }
        let obstacles = Self::obstacles_of(&model)?;
        let mut detached = self.detach(&[], true);
        if model.method != self.model.method || model.is_live() != self.model.is_live() {
            // What was handed over is so no more.
            detached.moved.fill(Moved::by_plan(self.timeline.time()));
        }
        self.around.gravity = model.gravity;
        if model.bounds != self.model.bounds {
            let fresh = Model { bounds: model.bounds, ..Model::default() };
            self.clear_of(&fresh, (&model, &obstacles), &mut detached);
        }
        self.model = Arc::new(model);
        self.obstacles = obstacles;
        self.attach(detached);
        if change.wind.is_some() {
            self.warn_of_wind();
        }
        if change.areas.is_some() {
            self.warn_of_areas(0);
        }
        Ok(done(true))
    }

    /// Whether a model differs from that of now in the budget alone, and both have one: who is handed over from now on is another, and
    /// nothing else is.
    fn allows_other_work(&self, model: &Model<D>) -> bool {
        let same = Method { budget: self.model.method.budget, ..model.method };
        let has_budgets = model.budget().is_some() && self.model.budget().is_some();
        has_budgets && *self.model == Model { method: same, ..model.clone() }
    }

    /// The areas at rest of all triangles of a model `[m^2]`: those that are known, or as they are made; none where nobody needs them.
    fn rest_areas(&self, model: &Model<D>) -> Vec<f64> {
        if !model.needs_areas() {
            return Vec::new();
        }
        if model.rest_areas.len() == model.triangles.len() {
            return model.rest_areas.clone();
        }
        self.laid_out(model).areas_at_rest()
    }

    /// A model with the bonds that are left, and points where they are now.
    fn laid_out(&self, model: &Model<D>) -> Model<D> {
        let count = self.count();
        let place = |i: usize| if self.numbers.is_gone(i as u32) { zero() } else { self.place(i) };
        Model {
            position: (0..count).map(place).collect(),
            velocity: vec![zero(); count],
            bonds: Bonds::clone(&self.bonds),
            ..model.clone()
        }
    }

    /// The mouse force is so from now on. Islands are compiled anew where it is stronger than any that they were made for.
    pub(super) fn change_mouse(&mut self, change: &MouseChange) -> Result<Applied, CommandError> {
        let old = self.around.mouse.clone();
        let given = |name: &str, said: Option<f64>, old: Option<f64>| {
            said.or(old).ok_or_else(|| invalid(format!("the scene has no mouse force yet: give `{name}`")))
        };
        let mouse = MouseForce {
            strength: given("strength", change.strength, old.as_ref().map(|old| old.strength))?,
            radius: given("radius", change.radius, old.as_ref().map(|old| old.radius))?,
            region: change.region.or(old.as_ref().map(|old| old.region)).unwrap_or_default(),
            profile: change.profile.or(old.as_ref().map(|old| old.profile)).unwrap_or(Profile::Smooth),
            track: old.filter(|_| !change.ends_track).map_or(Track::default(), |old| old.track),
        };
        if !(mouse.strength.is_finite() && mouse.radius.is_finite() && mouse.radius > 0.0) {
            return Err(invalid("`strength` must be finite, `radius` finite and > 0"));
        }
        if D == 3 && mouse.region == Region::Square {
            return Err(invalid("a square region is of the plane"));
        }
        let most = self.model.mouse.as_ref().map(|made_for| made_for.strength.abs());
        let is_new = most.is_none_or(|most| mouse.strength.abs() > most);
        let was_reached = self.kept_in_reach();
        let detached = is_new.then(|| self.detach(&[], true));
        if is_new {
            let strength = HEADROOM * mouse.strength;
            Arc::make_mut(&mut self.model).mouse = Some(MouseForce { strength, ..mouse.clone() });
        }
        self.around.mouse = Some(mouse);
        detached.into_iter().for_each(|detached| _ = self.attach(detached));
        self.refresh(was_reached);
        Ok(done(true))
    }
}

/// Errors: a number outside its range, or lists of another length than that of what is named.
fn check_change(to: &BondChange, count: usize) -> Result<(), CommandError> {
    let at_least_0 = |x: f64| x >= 0.0 && x.is_finite();
    let lists = [
        ("rest", &to.rest_length, "finite and >= 0"),
        ("stiffness", &to.stiffness, "finite and >= 0"),
        ("damping", &to.damping, "finite and >= 0"),
    ];
    for (name, list, range) in lists {
        list.iter().try_for_each(|list| values(name, list, count, (at_least_0, range)))?;
    }
    if let Some(list) = &to.relaxation {
        values("relaxation", list, count, (|x| x > 0.0 && x <= 1.0, "above 0 and at most 1"))?;
    }
    if let Some(list) = &to.max_correction {
        values("max_correction", list, count, (|x| x >= 0.0, ">= 0"))?;
    }
    if let Some(list) = &to.phase {
        values("phase", list, count, (f64::is_finite, "finite"))?;
    }
    if let Some(list) = &to.break_strain {
        values("break_strain", list, count, (|x| x > 0.0, "> 0"))?;
    }
    Ok(())
}

impl BondChange {
    /// What the k-th bond that is named becomes.
    ///
    /// Errors: a number that its kind has not.
    fn applied(&self, bond: Bond, k: usize) -> Result<Bond, &'static str> {
        let of = |values: &Option<Values>| values.as_ref().map(|values| value(values, k));
        let kind = match (self.kind, bond.kind) {
            (None, kind) => kind,
            (Some(Kind::Rigid), _) => BondKind::Rigid,
            (Some(Kind::Spring), kind @ BondKind::Spring { .. }) => kind,
            (Some(Kind::Spring), _) => BondKind::Spring { stiffness: STIFFNESS, damping: 0.0 },
            (Some(Kind::Relaxed), kind @ BondKind::Relaxed { .. }) => kind,
            (Some(Kind::Relaxed), _) => BondKind::Relaxed { relaxation: 1.0, max_correction: f64::INFINITY },
        };
        let is_spring = matches!(kind, BondKind::Spring { .. });
        let is_relaxed = matches!(kind, BondKind::Relaxed { .. });
        if !is_spring && (self.stiffness.is_some() || self.damping.is_some()) {
            return Err("is no spring: it has no stiffness and no damping");
        }
        if !is_relaxed && (self.relaxation.is_some() || self.max_correction.is_some()) {
            return Err("is not relaxed: it has no relaxation and no largest correction");
        }
        let kind = match kind {
            BondKind::Rigid => BondKind::Rigid,
            BondKind::Spring { stiffness, damping } => BondKind::Spring {
                stiffness: of(&self.stiffness).unwrap_or(stiffness),
                damping: of(&self.damping).unwrap_or(damping),
            },
            BondKind::Relaxed { relaxation, max_correction } => BondKind::Relaxed {
                relaxation: of(&self.relaxation).unwrap_or(relaxation),
                max_correction: of(&self.max_correction).unwrap_or(max_correction),
            },
        };
        let mut drive = self.drive.unwrap_or(bond.drive);
        if let Some(phase) = of(&self.phase) {
            let wave = drive.as_mut().and_then(|drive| drive.signal.wave.as_mut());
            wave.ok_or("follows no wave: it has no phase")?.phase = phase;
        }
        Ok(Bond {
            kind,
            rest_length: of(&self.rest_length).unwrap_or(bond.rest_length),
            break_strain: of(&self.break_strain).unwrap_or(bond.break_strain),
            limit: self.limit.unwrap_or(bond.limit),
            drive,
            ..bond
        })
    }
}
