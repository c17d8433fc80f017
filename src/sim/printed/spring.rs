//! 003: springs with dampers.
//!
//! ```text
//! f = k r (|d| - L) + c ((v_j - v_i) . r) r      or relative: k r (|d| - L)/L
//! v += h f/m                                     for all points, by the state before the step
//! x += h v                                       by the new velocities
//! ```
//!
//! Fault: it is called explicit Euler there. It is semi-implicit: the orbits of an oscillator are closed ellipses, where explicit Euler's
//! grow by sqrt(1 + (omega h)^2) a step.

use super::link::Link;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

pub(super) fn step<S: Real, const D: usize>(
    (x, v, w): (&mut [[S; D]], &mut [[S; D]], &[S]),
    links: &[Link<S>],
    is_relative: bool,
    (mut a, h): (Vec<[S; D]>, f64),
) {
    for link in links {
        let (d, size) = link.span(x);
        let [i, j] = link.ends().map(|end| end as usize);
        // From a to b.
        let r = scale(d, -(S::ONE / size));
        let excess = if is_relative { (size - link.rest) / link.rest } else { size - link.rest };
        let force = scale(r, link.stiffness * excess + link.damping * dot(sub(v[j], v[i]), r));
        a[i] = add(a[i], scale(force, w[i]));
        a[j] = sub(a[j], scale(force, w[j]));
    }
    let h = S::from_f64(h);
    for i in (0..x.len()).filter(|&i| w[i] != S::ZERO) {
        v[i] = add(v[i], scale(a[i], h));
        x[i] = add(x[i], scale(v[i], h));
    }
}
