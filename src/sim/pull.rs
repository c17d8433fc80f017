//! What acts on the points of a group: springs, the mouse, forces, gravity, drag and wind, rigid bonds and contacts.

use std::sync::Arc;

use super::constrain::direct::{Direct, Held};
use super::contact::Contacts;
use super::contact::penalty::Cushion;
use super::counters::Counters;
use super::environment::Environment;
use super::force::form::Form;
use super::force::mouse::{self, Inside};
use super::force::muscle::Driven;
use super::force::spring::Springs;
use super::force::steady::Thrust;
use super::force::wind::Air;
use super::points::Points;
use super::real::Real;
use super::swept::Span;
use super::vector::{add, convert, length, scale, sub, widen, zero};

/// Forces and holds of one group.
#[derive(Clone, Debug)]
pub(crate) struct Pull<S: Real, const D: usize> {
    /// Bonds that are forces.
    pub(crate) springs: Springs<S>,
    /// Angles and areas that are forces.
    pub(crate) form: Form<S>,
    /// Rigid bonds that are solved together.
    pub(crate) rigid: Option<Direct<S, D>>,
    /// Surfaces and the points that rest on them.
    pub(crate) contacts: Contacts<S, D>,
    /// Which points the mouse force acts on, where that is decided by located events instead of positions.
    pub(crate) inside: Option<Inside>,
    /// Points that a grab leads, and the acceleration that it gives them `[m/s^2]`.
    pub(crate) led: Vec<u32>,
    /// A hand leads some of its points, by this or by kicks.
    pub(crate) is_grabbed: bool,
    pub(crate) lead: [S; D],
    /// Constant forces and torques on some of the points.
    pub(crate) thrusts: Vec<Thrust<S, D>>,
    /// What drives move of it.
    pub(crate) driven: Driven<S>,
    /// What is the same everywhere and for ever: gravity, and what the mean wind gives by drag `[m/s^2]`.
    pub(crate) gravity: [f64; D],
    pub(crate) drag_rate: f64,
    /// Air that moves, where there is drag.
    pub(crate) air: Option<Arc<Air<D>>>,
    /// Surfaces that push by depth.
    pub(crate) cushions: Arc<[Cushion<S, D>]>,
}

impl<S: Real, const D: usize> Pull<S, D> {
    /// Gravity as kicks give it: where points may rest on surfaces, which take it away.
    pub(crate) fn kicking_gravity(&self) -> [f64; D] {
        if self.contacts.obstacles.is_empty() { [0.0; D] } else { self.gravity }
    }

    /// Gravity as flights give it.
    pub(crate) fn flying_gravity(&self) -> [f64; D] {
        if self.contacts.obstacles.is_empty() { self.gravity } else { [0.0; D] }
    }

    /// Whether some force depends on velocities, drag apart.
    pub(crate) fn is_damped(&self) -> bool {
        let is_driven = self.driven.has_motors() || self.cushions.iter().any(Cushion::is_damped);
        self.springs.is_damped() || self.form.is_damped() || is_driven
    }

    /// Energy of springs, angles and areas whose points are at these places `[J]`.
    pub(crate) fn elastic(&self, x: &[[S; D]]) -> f64 {
        let springs = self.springs.iter().map(|spring| spring.energy(sub(x[spring.a as usize], x[spring.b as usize])));
        springs.fold(self.form.energy(x).to_f64(), |sum, energy| sum + energy.to_f64())
    }

    /// Whether anything but springs, the mouse and what is the same everywhere pushes points.
    pub(crate) fn has_fields(&self) -> bool {
        !self.thrusts.is_empty() || self.gusts().is_some() || !self.cushions.is_empty()
    }

    /// Air with gusts, where there is drag.
    pub(crate) fn gusts(&self) -> Option<&Air<D>> {
        self.air.as_deref().filter(|air| air.has_gusts())
    }

    /// A bound on what forces and gusts give `[m/s^2]`, torques apart.
    pub(crate) fn most_push(&self) -> f64 {
        let gusts = self.gusts().map_or(0.0, |air| self.drag_rate * air.bounds()[0]);
        self.thrusts.iter().map(Thrust::size).sum::<f64>() + gusts + self.driven.most_push()
    }

    /// What gravity, forces, wind and mouse give at most in a time `[s]`.
    pub(crate) fn span(&self, around: &Environment<D>, h: f64) -> Span {
        Span { h, fall: length(self.gravity), pushed: self.most_push() + around.most_push() }
    }

    /// Adds to `a` what forces and gusts give `[m/s^2]` at time `t` `[s]`.
    pub(crate) fn drive(&self, t: f64, (x, w): (&[[S; D]], &[S]), a: &mut [[S; D]]) {
        for thrust in &self.thrusts {
            thrust.each(x, w, |i, push| a[i] = add(a[i], push));
        }
        if let Some(air) = self.gusts() {
            for i in 0..x.len() {
                if w[i] != S::ZERO {
                    a[i] = add(a[i], convert(scale(air.gust(widen(x[i]), t), self.drag_rate)));
                }
            }
        }
    }

    /// Accelerations by springs, angles, areas, the mouse, forces, gusts and a field of this strength `[m/s^2]`, at these positions and velocities.
    pub(crate) fn forces(
        &self,
        around: &Environment<D>,
        t: f64,
        (x, v, w): (&[[S; D]], &[[S; D]], &[S]),
        (field, a): ([S; D], &mut [[S; D]]),
        counters: &mut Counters,
    ) {
        if self.springs.is_empty() && self.form.is_empty() {
            for (a, &w) in a.iter_mut().zip(w) {
                *a = if w == S::ZERO { zero() } else { field };
            }
        } else {
            a.fill(zero());
            self.springs.pull(x, v, a);
            self.form.pull(x, v, a);
            counters.bonds_solved += (self.springs.len() + self.form.len()) as u64;
            for (a, &w) in a.iter_mut().zip(w) {
                *a = if w == S::ZERO { zero() } else { add(scale(*a, w), field) };
            }
        }
        for &i in &self.led {
            a[i as usize] = add(a[i as usize], self.lead);
        }
        self.drive(t, (x, w), a);
        self.cushions.iter().for_each(|cushion| cushion.push((x, v, w), a));
        if !self.driven.is_empty() {
            self.driven.each((t, &around.keys), (x, v), |i, push| a[i] = add(a[i], scale(push, w[i])));
        }
        if let Some((force, cursor)) = around.mouse_at(t) {
            counters.mouse_points += mouse::push(force, cursor, self.inside.as_ref(), x, w, a);
        }
    }

    /// `points.acceleration`: springs and the mouse at the present state, less what held points cannot follow.
    pub(crate) fn push(&mut self, around: &Environment<D>, t: f64, points: &mut Points<S, D>, counters: &mut Counters) {
        let Points { position, velocity, inverse_mass, acceleration, .. } = points;
        if acceleration.is_empty() {
            return;
        }
        self.forces(around, t, (position, velocity, inverse_mass), (zero(), acceleration), counters);
        self.hold_kick((position, velocity), acceleration);
    }

    /// Takes from accelerations what surfaces do not let points follow, and what friction takes: as much as all that presses on a point
    /// allows, what rigid bonds pass on included.
    fn hold_kick(&mut self, (x, v): (&[[S; D]], &[[S; D]]), a: &mut [[S; D]]) {
        let gravity = self.kicking_gravity();
        let Pull { rigid, contacts, .. } = self;
        match rigid {
            Some(rigid) if contacts.rubs() => {
                let fall: [S; D] = convert(gravity);
                let mut all: Vec<[S; D]> = a.iter().map(|a| add(*a, fall)).collect();
                rigid.answer(x, v, &mut all, contacts);
                contacts.hold_kick(gravity, v, a, Some(&all));
            }
            _ => contacts.hold_kick(gravity, v, a, None),
        }
    }

    /// As [`Pull::push`], at the velocities that half a kick of `h` makes: dampers pull with the velocity in the middle
    /// of a kick. It is foretold from the last accelerations, which is enough for order 2.
    pub(crate) fn push_ahead(
        &mut self,
        around: &Environment<D>,
        (t, h): (f64, f64),
        gravity: [f64; D],
        points: &mut Points<S, D>,
        counters: &mut Counters,
    ) {
        let half = S::from_f64(0.5 * h);
        let fall: [S; D] = convert(gravity.map(|g| g * 0.5 * h));
        let Points { position, velocity, velocity_ahead, inverse_mass, acceleration, .. } = points;
        for i in 0..position.len() {
            let gain = if inverse_mass[i] == S::ZERO { zero() } else { add(fall, scale(acceleration[i], half)) };
            velocity_ahead[i] = add(velocity[i], gain);
        }
        // Rigid bonds answer at once: dampers feel the velocity that the bonds leave.
        if let Some(rigid) = &mut self.rigid {
            rigid.project_ahead(velocity_ahead, &self.contacts);
        }
        self.forces(around, t, (position, velocity_ahead, inverse_mass), (zero(), acceleration), counters);
        self.hold_kick((position, velocity), acceleration);
    }

    /// All of the acceleration `[m/s^2]`: forces, gravity, drag, what rigid bonds and surfaces answer with.
    pub(crate) fn accelerate(
        &mut self,
        around: &Environment<D>,
        t: f64,
        (x, v, w): (&[[S; D]], &[[S; D]], &[S]),
        a: &mut [[S; D]],
        counters: &mut Counters,
    ) {
        self.act(around, t, (x, v, w), a, counters);
        self.react((x, v), a, counters);
    }

    /// Forces, gravity and drag `[m/s^2]`.
    pub(crate) fn act(
        &self,
        around: &Environment<D>,
        t: f64,
        (x, v, w): (&[[S; D]], &[[S; D]], &[S]),
        a: &mut [[S; D]],
        counters: &mut Counters,
    ) {
        self.forces(around, t, (x, v, w), (convert(self.gravity), a), counters);
        if self.drag_rate != 0.0 {
            let rate = S::from_f64(self.drag_rate);
            for (i, a) in a.iter_mut().enumerate() {
                *a = if w[i] == S::ZERO { zero() } else { sub(*a, scale(v[i], rate)) };
            }
        }
    }

    /// Adds to these accelerations what rigid bonds and surfaces answer with.
    pub(crate) fn react(&mut self, (x, v): (&[[S; D]], &[[S; D]]), a: &mut [[S; D]], counters: &mut Counters) {
        let Pull { rigid, contacts, .. } = self;
        match rigid {
            Some(rigid) => {
                rigid.answer(x, v, a, contacts);
                counters.bonds_solved += rigid.len() as u64;
                rub_through(rigid, contacts, v, a);
            }
            None => _ = contacts.rub(v, a),
        }
        contacts.hold(a);
    }

    /// Puts rigid bonds back to their lengths and takes from velocities what would change them, from wherever the points
    /// are. Returns whether they hold.
    pub(crate) fn project(&mut self, points: &mut Points<S, D>, counters: &mut Counters) -> bool {
        self.hold(points, counters, Direct::project_all)
    }

    /// The same after a step that has left the bonds by little.
    pub(crate) fn restore(&mut self, points: &mut Points<S, D>, counters: &mut Counters) -> bool {
        self.hold(points, counters, Direct::restore)
    }

    #[inline(always)]
    fn hold(
        &mut self,
        points: &mut Points<S, D>,
        counters: &mut Counters,
        by: fn(&mut Direct<S, D>, &mut Points<S, D>, &Contacts<S, D>) -> Held,
    ) -> bool {
        let Some(rigid) = &mut self.rigid else { return true };
        let held = by(rigid, points, &self.contacts);
        counters.iterations += u64::from(held.iterations);
        counters.bonds_solved += u64::from(held.iterations + 1) * rigid.len() as u64;
        held.is_held
    }
}

/// Times that friction is found anew from what presses with it, and by what share each time has to change less than the one before.
const MOST_ROUNDS: u32 = 60;
const SETTLES: f64 = 0.7;

/// Adds friction, and what rigid bonds answer to it, to accelerations to which they have answered: what presses is found together with what
/// rubs, for bonds make one of the other. Where that does not settle, as where friction holds more than it is pressed by, it is friction by
/// what presses without it.
fn rub_through<S: Real, const D: usize>(
    rigid: &mut Direct<S, D>,
    contacts: &mut Contacts<S, D>,
    v: &[[S; D]],
    a: &mut [[S; D]],
) {
    if !contacts.rub(v, a) {
        return;
    }
    rigid.multiply(v, a, contacts);
    let once = (a.to_vec(), contacts.pressing().collect::<Vec<_>>());
    let mut last = S::INFINITY;
    for _ in 0..MOST_ROUNDS {
        let change = contacts.rub_again(v, a);
        if change == S::ZERO {
            return;
        }
        // What is no number does not.
        let settles = change <= last * S::from_f64(SETTLES);
        if !settles {
            a.copy_from_slice(&once.0);
            contacts.press_again(&once.1);
            return;
        }
        rigid.multiply(v, a, contacts);
        last = change;
    }
}
