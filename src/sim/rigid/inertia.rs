//! What resists impulses on a rigid body.

use super::motion::{Axial, Twist};
use crate::sim::contact::coulomb::Friction;
use crate::sim::contact::coulomb::line::Line;
use crate::sim::vector::dot;

/// What resists them in the plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    /// Inverse mass `[1/kg]` and inverse moment of inertia `[1/(kg m^2)]`.
    pub(crate) inverse: [f64; 2],
}

/// What resists impulses on a body where it is.
pub(super) trait Inertial<const N: usize> {
    type Spin: Axial<N>;
    type Friction: Friction<N>;

    /// Inverse mass `[1/kg]`; 0 of what a pin holds.
    fn ease(&self) -> f64;
    /// The change of a spin that an angular momentum about the origin makes, as pins allow.
    fn spun(&self, moment: Self::Spin) -> Self::Spin;
    /// Kinetic energy, but for what cannot move `[J]`.
    fn energy(&self, twist: &Twist<Self::Spin, N>) -> f64;
    /// A mass and a moment of inertia that are no less than those of what moves.
    fn heaviest(&self) -> f64;
}

impl Inertial<2> for Inertia {
    type Spin = f64;
    type Friction = Line;

    #[inline(always)]
    fn ease(&self) -> f64 {
        self.inverse[0]
    }

    #[inline(always)]
    fn spun(&self, moment: f64) -> f64 {
        moment * self.inverse[1]
    }

    fn energy(&self, twist: &Twist) -> f64 {
        let of = |inverse: f64, square: f64| if inverse > 0.0 { 0.5 * square / inverse } else { 0.0 };
        of(self.inverse[0], dot(twist.velocity, twist.velocity)) + of(self.inverse[1], twist.spin * twist.spin)
    }

    fn heaviest(&self) -> f64 {
        self.inverse.iter().filter(|inverse| **inverse > 0.0).fold(0.0, |sum, inverse| sum + 1.0 / inverse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::contact::coulomb::{Pressed, Rub, strike};
    use crate::sim::rigid::contact::{Alone, Contact};

    fn on_floor(arm: [f64; 2], friction: f64, restitution: f64) -> Contact {
        let rub = Rub { friction, restitution, ..Rub::SMOOTH };
        Contact { arm, ways: [[0.0, 1.0], [-1.0, 0.0]], rub }
    }

    fn struck(inertia: Inertia, before: Twist, contacts: &[Contact]) -> Pressed<Twist> {
        let body = Alone { inertia, contacts };
        strike(&body, &before, &body.rubs())
    }

    /// A rod of two points of 1 kg, 2 m apart, its middle at the origin.
    const ROD: Inertia = Inertia { inverse: [0.5, 0.5] };

    #[test]
    fn a_level_rod_that_hits_with_one_end_turns_about_the_other() {
        let falling = Twist { velocity: [0.3, -1.0], spin: 0.0 };
        let after = struck(ROD, falling, &[on_floor([-1.0, 0.0], 0.0, 0.5)]).motion;
        let [hit, free] = [[-1.0, 0.0], [1.0, 0.0]].map(|arm| after.at(arm));
        assert!((hit[1] - 0.5).abs() < 1e-14 && (free[1] + 1.0).abs() < 1e-14, "{hit:?} {free:?}");
        assert!((hit[0] - 0.3).abs() < 1e-14, "no friction");
    }

    #[test]
    fn what_an_impact_takes_is_what_the_rod_has_less_and_never_below_nothing() {
        for restitution in [0.0, 0.5, 1.0] {
            for friction in [0.0, 0.1, 0.7, 9.0] {
                for turned in 0..16 {
                    let angle = 0.4 * f64::from(turned);
                    let arm = [libm::cos(angle), libm::sin(angle)];
                    let before = Twist { velocity: [1.0, -1.0], spin: 0.3 * f64::from(turned) - 2.0 };
                    if before.at(arm)[1] >= 0.0 {
                        continue;
                    }
                    let contact = on_floor(arm, friction, restitution);
                    let Pressed { motion: after, taken, .. } = struck(ROD, before, &[contact]);
                    let lost = ROD.energy(&before) - ROD.energy(&after);
                    assert!((taken[0] + taken[1] - lost).abs() < 1e-12, "{taken:?} {lost}");
                    assert!(lost > -1e-12, "{restitution} {friction} {angle}: {lost}");
                    assert!(after.at(arm)[1] > -1e-12);
                }
            }
        }
    }

    #[test]
    fn one_contact_obeys_the_law_at_once_however_rough_it_is() {
        for friction in [0.0, 0.1, 0.7, 2.0, 9.0] {
            for turned in 0..64 {
                let angle = 0.1 * f64::from(turned);
                let arm = [libm::cos(angle), libm::sin(angle)];
                let before = Twist { velocity: [1.0, -1.0], spin: 0.07 * f64::from(turned) - 2.0 };
                let found = struck(ROD, before, &[on_floor(arm, friction, 0.0)]);
                assert!(found.has_converged && found.passes <= 2, "{friction} {angle}: {}", found.passes);
                let ([push, rub], speed) = (found.impulses[0], found.motion.at(arm));
                assert!(push >= 0.0 && speed[1] > -1e-12 && (push * speed[1]).abs() < 1e-12, "{friction} {angle}");
                // Along (-1, 0): what rubs is held, or as large as may be and against the way.
                let most = friction * push;
                assert!(rub.abs() <= most * (1.0 + 1e-12), "{friction} {angle}");
                let is_held = speed[0].abs() < 1e-12;
                assert!(
                    push == 0.0 || is_held || (rub * speed[0] >= 0.0 && rub.abs() >= most * (1.0 - 1e-12)),
                    "{friction} {angle}"
                );
            }
        }
    }

    #[test]
    fn friction_is_a_share_of_what_presses_until_the_point_holds() {
        let before = Twist { velocity: [1.0, -1.0], spin: 0.0 };
        let end = |friction: f64, slides: f64| {
            let mut contact = on_floor([-1.0, 0.0], friction, 0.0);
            contact.rub.slides = [0.0, slides];
            struck(ROD, before, &[contact]).motion.at([-1.0, 0.0])
        };
        // Level: what presses is 1 kg m/s, and friction moves both points.
        assert!((end(0.1, 0.0)[0] - 0.95).abs() < 1e-14 && (end(0.1, -1.0)[0] - 0.95).abs() < 1e-14);
        assert!(end(9.0, 0.0)[0].abs() < 1e-12);
    }

    #[test]
    fn a_box_that_lands_flat_stops_level_and_with_restitution_1_returns_level() {
        let body = Inertia { inverse: [0.25, 1.0 / (4.0 * 0.5)] };
        let before = Twist { velocity: [0.0, -2.0], spin: 0.0 };
        for restitution in [0.0, 1.0] {
            let both = [-0.5, 0.5].map(|x| on_floor([x, -0.5], 0.5, restitution));
            let after = struck(body, before, &both).motion;
            assert!((after.velocity[1] - 2.0 * restitution).abs() < 1e-12 && after.spin.abs() < 1e-12, "{after:?}");
        }
    }

    #[test]
    fn a_lever_that_friction_wedges_below_its_pin_comes_back_as_its_restitution_says() {
        let pinned = Inertia { inverse: [0.0, 0.5] };
        for (lean, friction) in [(0.3, 2.0), (0.01, 0.1), (2.0, 9.0), (-0.3, 2.0)] {
            for restitution in [0.5, 1.0] {
                let before = Twist { velocity: [0.0; 2], spin: -f64::signum(lean) };
                let found = struck(pinned, before, &[on_floor([lean, -1.0], friction, restitution)]);
                assert!((found.motion.spin + restitution * before.spin).abs() < 1e-12, "{lean}: {:?}", found.motion);
                assert!(found.has_converged && found.impulses[0][1].abs() <= friction * found.impulses[0][0]);
            }
        }
    }

    #[test]
    fn what_falls_between_rough_walls_comes_out_with_all_but_what_friction_takes() {
        let body = Inertia { inverse: [0.25, 1.0 / (4.0 * 0.5)] };
        for steep in [0.05, 0.1, 0.3, 1.0] {
            for (friction, spin) in [(0.3, -1.0), (0.3, 0.0), (0.3, 0.3), (2.0, -1.0), (2.0, 0.0), (2.0, 0.3)] {
                let wall = |side: f64| {
                    let length = f64::sqrt(1.0 + steep * steep);
                    let n = [-side / length, steep / length];
                    let contact = on_floor([0.5 * side, 0.1 * side - 0.2], friction, 1.0);
                    Contact { ways: [n, [-n[1], n[0]]], ..contact }
                };
                let before = Twist { velocity: [0.1, -2.0], spin };
                let both = [-1.0, 1.0].map(wall);
                let after = struck(body, before, &both).motion;
                let kept = body.energy(&after) / body.energy(&before);
                assert!((0.2..1.0 + 1e-9).contains(&kept), "{steep} {friction} {spin}: {kept}");
                let slowest = both.iter().map(|contact| contact.speeds(&after)[0]).fold(f64::INFINITY, f64::min);
                assert!(slowest > -1e-3, "{steep} {friction} {spin}: {slowest} m/s");
            }
        }
    }

    #[test]
    fn what_is_pinned_turns_alone() {
        let pinned = Inertia { inverse: [0.0, 0.5] };
        let before = Twist { velocity: [0.0; 2], spin: -1.0 };
        let after = struck(pinned, before, &[on_floor([1.0, 0.0], 0.3, 1.0)]).motion;
        assert!((after.spin - 1.0).abs() < 1e-14 && after.velocity == [0.0; 2]);
    }
}
