//! The account of a group: what is written into the ledger, there only where one is kept.
//!
//! Works are integrals of power over time along the way that the points went. From the states at both ends of a part of a substep
//! comes a cubic; power is taken at its ends and in its middle (Simpson's rule):
//!
//! ```text
//! x_mid = (x0 + x1)/2 + h (v0 - v1)/8        v_mid = 3 (x1 - x0)/(2 h) - (v0 + v1)/4
//! ```
//!
//! No engine takes part in that, so what an engine makes of these forces otherwise is left over, as its own error. Velocities that
//! change at once, in impacts, jerks and kicks, are booked where that happens.

use super::bond::Bond;
use super::environment::Environment;
use super::force::form::{Form, at};
use super::force::mean::amendment;
use super::force::mouse::{self, Track};
use super::force::spring::Spring;
use super::ledger::Book;
use super::points::{Points, State};
use super::pull::Pull;
use super::real::Real;
use super::vector::{add, dot, scale, sub, widen, zero};

/// The account of a group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Account {
    pub(crate) book: Book,
    /// Springs with a damper, and those that end at a pin which is led, between places in the group.
    springs: Vec<Spring<f64>>,
    /// The same of angles and areas.
    form: Option<Form<f64>>,
    /// Some bonds that are no springs end at pins that are led.
    pub(crate) pulls_rigid: bool,
}

impl Account {
    /// An empty account of a group with these bonds, angles and areas, between places in the group, and these tracks of pins.
    pub(crate) fn new<'a, const D: usize>(
        bonds: impl Iterator<Item = &'a Bond>,
        mut form: Form<f64>,
        tracks: &[(u32, Track<D>)],
    ) -> Self {
        let is_led = |point: u32| tracks.iter().any(|(led, _)| *led == point);
        form.hinges.retain(|hinge| hinge.damping > 0.0 || hinge.points.iter().any(|&point| is_led(point)));
        form.patches.retain(|patch| patch.corners.iter().any(|&corner| is_led(corner)));
        let mut account = Account { form: (!form.is_empty()).then_some(form), ..Account::default() };
        for bond in bonds {
            let ends_led = is_led(bond.a.0) || is_led(bond.b.0);
            match Spring::of(bond) {
                Some(spring) if spring.damping > 0.0 || ends_led => account.springs.push(spring),
                Some(_) => {}
                None => account.pulls_rigid |= ends_led,
            }
        }
        account
    }

    /// A bond between two places of the group, of this rest length `[m]`, is gone.
    pub(crate) fn lose(&mut self, ends: [u32; 2], rest: f64) {
        let is_it = |spring: &Spring<f64>| {
            ([spring.a, spring.b] == ends || [spring.b, spring.a] == ends) && spring.rest_length == rest
        };
        if let Some(place) = self.springs.iter().position(is_it) {
            self.springs.swap_remove(place);
        }
    }

    /// Power of drag, dampers and springs at led pins `[W]`, of points in this state.
    pub(crate) fn add_bonds<S: Real, const D: usize>(
        &self,
        (x, v, w): (&[[S; D]], &[[S; D]], &[S]),
        drag_rate: f64,
        power: &mut Book,
    ) {
        for spring in &self.springs {
            let (i, j) = (spring.a as usize, spring.b as usize);
            let [x_a, x_b, v_a, v_b] = [x[i], x[j], v[i], v[j]].map(widen);
            let (d, closing) = (sub(x_a, x_b), sub(v_a, v_b));
            let [pull, at_rest] = spring.forces(d, closing);
            power.dampers += dot(sub(at_rest, pull), closing);
            // The pin is pulled by the spring: what holds it does as much work as it gives.
            let of_pin = |k: usize, v: [f64; D]| if w[k] == S::ZERO { dot(pull, v) } else { 0.0 };
            power.pins -= of_pin(i, v_a) - of_pin(j, v_b);
        }
        if let Some(form) = &self.form {
            add_form(form, (x, v, w), power);
        }
        if drag_rate != 0.0 {
            power.drag += 2.0 * drag_rate * kinetic(v, w);
        }
    }

    /// Adds what led pins do more `[W]` where springs pull by their mean lengths along a step, from `start` through `middle`.
    pub(crate) fn amend_pins<S: Real, const D: usize>(
        &self,
        (start, middle): (&[[S; D]], &[[S; D]]),
        (v, w): (&[[S; D]], &[S]),
        power: &mut Book,
    ) {
        for spring in &self.springs {
            let (i, j) = (spring.a as usize, spring.b as usize);
            let apart = |x: &[[S; D]]| sub(widen(x[i]), widen(x[j]));
            let pull = amendment(spring, apart(start), apart(middle));
            let of_pin = |k: usize| if w[k] == S::ZERO { dot(pull, widen(v[k])) } else { 0.0 };
            power.pins -= of_pin(i) - of_pin(j);
        }
    }

    /// Books a substep of `h` of large bodies: points in the middle of it, at `time` `[s]`, with the velocity that they have in it.
    pub(crate) fn book_middle<S: Real, const D: usize>(
        &mut self,
        (pull, around): (&Pull<S, D>, &Environment<D>),
        (time, h): (f64, f64),
        (x, v, w): (&[[S; D]], &[[S; D]], &[S]),
    ) {
        let mut power = Book::default();
        self.add_bonds((x, v, w), pull.drag_rate, &mut power);
        power.mouse = pushed(pull, around, time, (x, v, w));
        driven((pull, around), time, (x, v, w), &mut power);
        if self.pulls_rigid {
            // The impulses of all bonds are booked, those of springs too.
            power.pins = 0.0;
        }
        self.book.add(&power, h);
    }
}

/// Power of the dampers of angles, and of angles and areas at led pins `[W]`.
fn add_form<S: Real, const D: usize>(form: &Form<f64>, (x, v, w): (&[[S; D]], &[[S; D]], &[S]), power: &mut Book) {
    let mut of_pins = |points: [u32; 3], forces: [[f64; 2]; 3], v: [[f64; D]; 3]| {
        for ((point, force), v) in points.into_iter().zip(forces).zip(v) {
            if w[point as usize] == S::ZERO {
                power.pins -= force[0] * v[0] + force[1] * v[1];
            }
        }
    };
    let mut dampers = 0.0;
    for hinge in &form.hinges {
        let (x, v) = (at(x, hinge.points).map(widen), at(v, hinge.points).map(widen));
        if let Some([still, damped]) = hinge.forces(x, v) {
            let works = still.iter().zip(&damped).zip(&v);
            dampers += works.map(|((f, g), v)| (f[0] - g[0]) * v[0] + (f[1] - g[1]) * v[1]).sum::<f64>();
            of_pins(hinge.points, damped, v);
        }
    }
    for patch in &form.patches {
        let (x, v) = (at(x, patch.corners).map(widen), at(v, patch.corners).map(widen));
        of_pins(patch.corners, patch.forces(x), v);
    }
    power.dampers += dampers;
}

/// The sum of m v^2/2 of the points that can move `[J]`.
pub(crate) fn kinetic<S: Real, const D: usize>(v: &[[S; D]], w: &[S]) -> f64 {
    let of = |(v, w): (&[S; D], &S)| {
        let (v, w) = (widen(*v), w.to_f64());
        if w > 0.0 { 0.5 * dot(v, v) / w } else { 0.0 }
    };
    v.iter().zip(w).map(of).sum()
}

/// The sum of m a . v `[W]`.
pub(crate) fn power_of<S: Real, const D: usize>(a: &[[S; D]], v: &[[S; D]], w: &[S]) -> f64 {
    let of = |((a, v), w): ((&[S; D], &[S; D]), &S)| {
        let w = w.to_f64();
        if w > 0.0 { dot(widen(*a), widen(*v)) / w } else { 0.0 }
    };
    a.iter().zip(v).zip(w).map(of).sum()
}

/// Power of the mouse force `[W]`.
pub(crate) fn pushed<S: Real, const D: usize>(
    pull: &Pull<S, D>,
    around: &Environment<D>,
    t: f64,
    (x, v, w): (&[[S; D]], &[[S; D]], &[S]),
) -> f64 {
    let Some((force, cursor)) = around.mouse_at(t) else { return 0.0 };
    let mut a = vec![zero(); x.len()];
    mouse::push(force, cursor, pull.inside.as_ref(), x, w, &mut a);
    power_of(&a, v, w)
}

/// Adds the power of constant forces, of drives and of the wind `[W]`.
pub(crate) fn driven<S: Real, const D: usize>(
    (pull, around): (&Pull<S, D>, &Environment<D>),
    t: f64,
    (x, v, w): (&[[S; D]], &[[S; D]], &[S]),
    power: &mut Book,
) {
    if !pull.driven.is_empty() {
        pull.driven.each((t, &around.keys), (x, v), |i, push| {
            let done = dot(widen(push), widen(v[i]));
            power.drives += done;
            // What holds a pin does as much against it.
            power.pins -= if w[i] == S::ZERO { done } else { 0.0 };
        });
    }
    for thrust in &pull.thrusts {
        thrust.each(x, w, |i, push| power.forces += dot(widen(push), widen(v[i])) / w[i].to_f64());
    }
    if let Some(air) = &pull.air {
        for i in (0..x.len()).filter(|&i| w[i] != S::ZERO) {
            power.wind += pull.drag_rate * dot(air.at(widen(x[i]), t), widen(v[i])) / w[i].to_f64();
        }
    }
}

/// The middle of the cubic between two states that are `h` `[s]` apart.
pub(crate) fn middle<S: Real, const D: usize>(from: &State<S, D>, to: &Points<S, D>, h: f64) -> State<S, D> {
    let (h, half) = (S::from_f64(h), S::HALF);
    let quarter = half * half;
    let mut state =
        State { position: Vec::new(), velocity: Vec::new(), position_lost: Vec::new(), velocity_lost: Vec::new() };
    for i in 0..to.len() {
        let (x0, x1, v0, v1) = (from.position[i], to.position[i], from.velocity[i], to.velocity[i]);
        let way = sub(x1, x0);
        let bend = scale(sub(v0, v1), h * half * quarter);
        state.position.push(add(add(x0, scale(way, half)), bend));
        let mean = scale(way, (S::ONE + half) / h);
        state.velocity.push(sub(mean, scale(add(v0, v1), quarter)));
    }
    state
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_a_cubic_is_exact() {
        // x = t^3 - 2 t, v = 3 t^2 - 2, from 1 to 3.
        let state =
            |x: f64, v: f64| State::<f64, 2> { position: vec![[x, 0.0]], velocity: vec![[v, 0.0]], ..State::default() };
        let middle = middle(&state(-1.0, 1.0), &Points::new(state(21.0, 25.0), vec![1.0]), 2.0);
        assert_eq!((middle.position[0], middle.velocity[0]), ([4.0, 0.0], [10.0, 0.0]));
    }
}
