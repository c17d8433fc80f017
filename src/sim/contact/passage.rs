//! A way through a surface, which is turned where it meets it.

use super::surface::Surface;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// A way that ends behind a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage<S, const D: usize> {
    /// Share of the way that is left when it meets the surface `[1]`.
    pub(crate) left: S,
    normal: [S; D],
    /// Where the straight way and where the flight meets the surface.
    at: [[S; D]; 2],
    /// The rest of the straight way.
    rest: [S; D],
    /// What the velocity there would make of it without gravity, and what gravity adds.
    thrown: [S; D],
    falls: [S; D],
}

impl<S: Real, const D: usize> Passage<S, D> {
    /// A way that meets the surface after the given share of it; `fall` is what gravity adds to a motion on all of it `[m]`.
    ///
    /// The point flies on a parabola whose chord the way is: after s of the way it is off the chord by -fall s (1 - s) / 2.
    pub(crate) fn new(surface: &Surface<S, D>, [from, to]: [[S; D]; 2], fall: [S; D], share: f64) -> Self {
        let half = S::from_f64(0.5);
        let (normal, way) = (surface.normal, sub(to, from));
        let on = |x: [S; D]| sub(x, scale(normal, surface.gap(x)));
        let chord = S::from_f64(share);
        let bulge = |share: S| scale(fall, half * share * (S::ONE - share));
        let (into, off) = (-dot(way, normal), dot(bulge(chord), normal));
        let share = if into > off.abs() { (chord - off / into).max(S::ZERO).min(S::ONE) } else { chord };
        let left = S::ONE - share;
        Passage {
            left,
            normal,
            at: [on(add(from, scale(way, chord))), on(sub(add(from, scale(way, share)), bulge(share)))],
            rest: scale(way, S::ONE - chord),
            thrown: scale(add(way, scale(fall, share - half)), left),
            falls: scale(fall, half * left * left),
        }
    }

    /// Where it is turned, and where it ends, if so much of it is kept along the surface, and so much of the part across is turned
    /// back `[1]`.
    pub(crate) fn turned(&self, [keep, back]: [S; 2]) -> [[S; D]; 2] {
        let turned = |way: [S; D]| {
            let across = scale(self.normal, dot(way, self.normal));
            sub(scale(sub(way, across), keep), scale(across, back))
        };
        let [straight, bent] = self.at;
        if back == S::ZERO {
            return [straight, add(straight, turned(self.rest))];
        }
        let way = add(turned(self.thrown), self.falls);
        // It may be back already.
        let deep = dot(way, self.normal).min(S::ZERO);
        [bent, add(bent, sub(way, scale(self.normal, deep)))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::contact::surface::Plane;

    #[test]
    fn a_bounce_of_full_restitution_keeps_the_energy_to_third_order() {
        let plane = Plane { point: [0.0, 0.0], normal: [0.0, 1.0], restitution: 1.0, friction: 0.0, penalty: None };
        let surface = Surface::<f64, 2>::new(&plane);
        let error = |h: f64| {
            let (g, v0, y0) = (10.0, -3.0, 3.0 * 0.3 * h);
            let (y1, v1) = (y0 + v0 * h - 0.5 * g * h * h, v0 - g * h);
            let fall = [0.0, -g * h * h];
            let passage = Passage::new(&surface, [[0.0, y0], [h, y1]], fall, y0 / (y0 - y1));
            let [_, [x, y]] = passage.turned([1.0, 1.0]);
            assert!((x - h).abs() < 1e-15, "what is along the surface is not touched: {x}");
            let late = passage.left * h;
            let v = -(v1 + g * late) - g * late;
            (0.5 * v * v + g * y - (0.5 * v0 * v0 + g * y0)).abs()
        };
        assert!(error(0.01) < 2e-3 && error(0.005) < error(0.01) / 6.0, "{} {}", error(0.01), error(0.005));
    }
}
