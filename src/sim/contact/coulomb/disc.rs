//! Friction in space, where it acts in two directions: within a disc as wide as friction times what presses.

use super::{Friction, NOTHING, REPEATED, Rub};
use crate::sim::vector::{add, dot, scale, sub};

/// Rounds in which the direction is found in which one contact starts to slide, by turns of it and by steps.
const TURNS: u32 = 12;
const ROUNDS: u32 = 60;

/// Along the normal of a contact and the two tangents of it: impulses `[kg m/s]` or velocities `[m/s]`.
pub(crate) type Trio = [f64; 3];

/// Friction within a disc.
pub(crate) struct Disc;

impl Friction<3> for Disc {
    const MOST_PASSES: u32 = 300;
    const OF_A_CONTACT: u64 = 150;

    #[inline]
    fn solve(gives: &[Trio; 3], rub: &Rub<3>, old: Trio, speed: Trio) -> Trio {
        let across = gives[0][0];
        if across <= 0.0 {
            return old;
        }
        // What it lacks without an impulse of its own.
        let mut lacks = [0.0; 3];
        for k in 0..3 {
            lacks[k] = rub.target[k] - speed[k] + dot(gives[k], old);
        }
        if rub.is_sliding() {
            let [_, x, y] = rub.slides;
            let eased = across - rub.friction * (gives[0][1] * x + gives[0][2] * y);
            // Where friction that goes along with what presses lifts the point more than that does, it is held instead (Painlevé).
            if eased > 0.0 {
                let push = (lacks[0] / eased).max(0.0);
                return [push, -rub.friction * push * x, -rub.friction * push * y];
            }
        }
        if lacks[0] <= 0.0 {
            return [0.0; 3];
        }
        if rub.friction == 0.0 {
            return [lacks[0] / across, 0.0, 0.0];
        }
        if let Some(stuck) = solved(gives, lacks)
            && stuck[0] >= 0.0
            && along(stuck) <= rub.friction * stuck[0]
        {
            return stuck;
        }
        turning(gives, rub.friction, lacks, old).unwrap_or_else(|| slipping(gives, rub.friction, lacks, old))
    }
}

/// The impulse at the rim of the disc that is against the sliding which it leaves, by Newton's method on its direction, from the one that it had or
/// against what slides by itself; `None`: not found so.
fn turning(gives: &[Trio; 3], friction: f64, lacks: Trio, [_, u, v]: Trio) -> Option<Trio> {
    let start = if u != 0.0 || v != 0.0 { [u, v] } else { [lacks[1], lacks[2]] };
    let size = dot(start, start).sqrt();
    let mut f = if size > 0.0 { scale(start, 1.0 / size) } else { return None };
    let tangential = |p: [f64; 2]| [gives[1][1] * p[0] + gives[1][2] * p[1], gives[2][1] * p[0] + gives[2][2] * p[1]];
    let (both, aside) = ([gives[0][1], gives[0][2]], |f: [f64; 2]| [-f[1], f[0]]);
    for _ in 0..TURNS {
        let weight = gives[0][0] + friction * dot(both, f);
        let push = lacks[0] / weight;
        let rub = scale(f, friction * push);
        let slip = sub(add(scale(both, push), tangential(rub)), [lacks[1], lacks[2]]);
        let g = aside(f);
        let off = dot(g, slip);
        if off.abs() <= NOTHING * (dot(slip, slip).sqrt() + lacks[0].abs()) {
            let is_fine = push >= 0.0 && push.is_finite() && dot(f, slip) <= 0.0;
            return is_fine.then_some([push, rub[0], rub[1]]);
        }
        // How push, slip and what is left change as the direction turns.
        let eased = -push * friction * dot(both, g) / weight;
        let turned = add(scale(both, eased), tangential(scale(add(scale(f, eased), scale(g, push)), friction)));
        let by = off / (dot(f, slip) - dot(g, turned));
        // Half a radian at most; NaN is no turn.
        let by = if by.abs() < 0.5 { by } else { 0.5_f64.copysign(by) };
        f = add(f, scale(g, by));
        f = scale(f, 1.0 / dot(f, f).sqrt());
    }
    None
}

/// The impulse at the rim of the disc that is against the sliding which it leaves, or within it where nothing slides: by steps against that
/// sliding, put back on the disc.
fn slipping(gives: &[Trio; 3], friction: f64, lacks: Trio, old: Trio) -> Trio {
    let stiff = gives[1][1] + gives[2][2];
    let mut p = old;
    for _ in 0..ROUNDS {
        let push = ((lacks[0] - gives[0][1] * p[1] - gives[0][2] * p[2]) / gives[0][0]).max(0.0);
        let mut next = [push, p[1], p[2]];
        if stiff > 0.0 {
            let slip = [1, 2].map(|k| dot(gives[k], next) - lacks[k]);
            next = [push, p[1] - slip[0] / stiff, p[2] - slip[1] / stiff];
        }
        let (size, most) = (along(next), friction * push);
        // What is no number stays none, and is seen as that.
        if size > most {
            next = [push, next[1] * (most / size), next[2] * (most / size)];
        }
        let change = sub(next, p);
        p = next;
        if dot(change, change) <= f64::EPSILON * f64::EPSILON * dot(p, p) {
            break;
        }
    }
    p
}

/// How much of it is along the surface.
fn along([_, x, y]: Trio) -> f64 {
    (x * x + y * y).sqrt()
}

/// A symmetric system of three by Cholesky's method; `None` where two of its directions are one.
fn solved(m: &[Trio; 3], b: Trio) -> Option<Trio> {
    let x = m[0][0];
    let (u, v) = (m[1][0] / x, m[2][0] / x);
    let y = m[1][1] - u * m[1][0];
    if y <= REPEATED * m[1][1] {
        return None;
    }
    let w = (m[2][1] - v * m[1][0]) / y;
    let z = m[2][2] - v * m[2][0] - w * w * y;
    if z <= REPEATED * m[2][2] {
        return None;
    }
    let c = [b[0], b[1] - u * b[0], 0.0];
    let last = (b[2] - v * c[0] - w * c[1]) / z;
    let middle = c[1] / y - w * last;
    Some([c[0] / x - u * middle - v * last, middle, last])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_of_three_is_solved() {
        let m = [[4.0, 1.0, -0.5], [1.0, 3.0, 0.25], [-0.5, 0.25, 2.0]];
        let x = solved(&m, [1.0, 2.0, 3.0]).unwrap_or_default();
        for (row, b) in m.iter().zip([1.0, 2.0, 3.0]) {
            assert!((dot(*row, x) - b).abs() < 1e-14);
        }
        assert!(solved(&[[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [1.0; 3]).is_none());
    }

    #[test]
    fn one_contact_is_free_held_or_slides_against_its_friction() {
        let gives = [[2.0, 0.4, -0.3], [0.4, 1.5, 0.2], [-0.3, 0.2, 1.0]];
        for friction in [0.0, 0.1, 0.5, 2.0] {
            for turned in 0..16 {
                let angle = 0.4 * f64::from(turned);
                let speed = [-1.0, 2.0 * libm::cos(angle), 2.0 * libm::sin(angle)];
                let rub = Rub { friction, ..Rub::SMOOTH };
                let p = (0..40).fold([0.0; 3], |p, _| {
                    let now = std::array::from_fn(|k| speed[k] + dot(gives[k], p));
                    Disc::solve(&gives, &rub, p, now)
                });
                let after: Trio = std::array::from_fn(|k| speed[k] + dot(gives[k], p));
                let (held, slip) = ([p[1], p[2]], [after[1], after[2]]);
                assert!(p[0] > 0.0 && after[0].abs() < 1e-12, "{friction} {angle}: {after:?}");
                assert!(dot(held, held).sqrt() <= friction * p[0] + 1e-12);
                let is_held = dot(slip, slip).sqrt() < 1e-9;
                // Against the way: a product as far below 0 as it can be.
                let most = friction * p[0] * dot(slip, slip).sqrt();
                assert!(is_held || (dot(held, slip) + most).abs() < 1e-9, "{friction} {angle}: {held:?} {slip:?}");
                let lacks: Trio = std::array::from_fn(|k| -speed[k]);
                let stepped = (0..40).fold([0.0; 3], |p, _| slipping(&gives, friction, lacks, p));
                assert!(along(sub(stepped, p)) < 1e-9, "{friction} {angle}: {stepped:?} {p:?}");
                let turned = turning(&gives, friction, lacks, [0.0; 3]);
                let is_it = |turned: Trio| along(sub(turned, p)) < 1e-9;
                assert!(
                    is_held || friction == 0.0 || turned.is_some_and(is_it),
                    "{friction} {angle}: {turned:?} {p:?}"
                );
            }
        }
    }
}
