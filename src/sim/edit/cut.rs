//! Bonds that a stroke crosses go.

use super::check::finite;
use super::segments::segments_meet;
use super::{done, invalid};
use crate::sim::bond::PointId;
use crate::sim::command::{Applied, CommandError};
use crate::sim::force::mouse::Cursor;
use crate::sim::real::Real;
use crate::sim::vector::{add, cross3, dot, embed, flat, length, scale, sub};
use crate::sim::world::World;

/// Rays whose directions differ by less than this are parallel `[rad]`, and a stroke of a smaller angle crosses nothing.
const PARALLEL: f64 = 1e-9;

impl<S: Real, const D: usize> World<S, D> {
    /// Bonds that the stroke crosses go.
    pub(super) fn cut(&mut self, stroke: [Cursor; 2]) -> Result<Applied, CommandError> {
        finite("from and to", stroke.iter().flat_map(|end| end.origin.iter().chain(&end.direction)))?;
        let goes = self.crossed_by(stroke)?;
        if !goes.contains(&true) {
            return Ok(done(false));
        }
        self.part(&goes, self.timeline.time());
        Ok(done(true))
    }

    /// Which bonds a stroke crosses.
    ///
    /// Errors: in space, rays that neither begin at one place nor are parallel.
    pub(super) fn crossed_by(&self, stroke: [Cursor; 2]) -> Result<Vec<bool>, CommandError> {
        let ends = self.bonds.ends().iter();
        if D == 2 {
            let place = |point: PointId| flat(self.place(point.index()));
            let stroke = stroke.map(|end| [end.origin[0], end.origin[1]]);
            return Ok(ends.map(|ends| segments_meet(stroke, ends.map(place))).collect());
        }
        let place = |point: PointId| embed(self.place(point.index()));
        let sheet = Sheet::between(stroke).ok_or_else(|| {
            invalid("the rays of a cut neither begin at one place nor are parallel: give both from where the eye is")
        })?;
        Ok(ends.map(|ends| sheet.is_crossed(ends.map(place))).collect())
    }
}

/// What lies between two rays: part of a plane.
enum Sheet {
    /// From one place on, between two directions.
    Fan { from: [f64; 3], along: [[f64; 3]; 2], normal: [f64; 3] },
    /// From one place and from another beside it on, along one direction.
    Strip { from: [f64; 3], along: [f64; 3], across: [f64; 3], normal: [f64; 3] },
}

impl Sheet {
    /// `None`: the rays neither begin at one place nor are parallel.
    fn between([from, to]: [Cursor; 2]) -> Option<Self> {
        let normal = cross3(from.direction, to.direction);
        if from.origin == to.origin {
            return Some(Sheet::Fan { from: from.origin, along: [from.direction, to.direction], normal });
        }
        if length(normal) > PARALLEL || dot(from.direction, to.direction) <= 0.0 {
            return None;
        }
        let along = from.direction;
        let off = sub(to.origin, from.origin);
        let across = sub(off, scale(along, dot(off, along)));
        Some(Sheet::Strip { from: from.origin, along, across, normal: cross3(along, across) })
    }

    /// Whether a bond goes through it, from one side to the other.
    fn is_crossed(&self, [a, b]: [[f64; 3]; 2]) -> bool {
        let (Sheet::Fan { from, normal, .. } | Sheet::Strip { from, normal, .. }) = *self;
        let [of_a, of_b] = [a, b].map(|x| dot(normal, sub(x, from)));
        let is_through = (of_a > 0.0 && of_b <= 0.0) || (of_a <= 0.0 && of_b > 0.0);
        if !is_through || length(normal) <= PARALLEL {
            return false;
        }
        let at = sub(add(a, scale(sub(b, a), of_a / (of_a - of_b))), from);
        match *self {
            Sheet::Fan { along: [first, last], .. } => {
                dot(cross3(first, at), normal) >= 0.0 && dot(cross3(at, last), normal) >= 0.0
            }
            Sheet::Strip { along, across, .. } => {
                let share = dot(at, across) / dot(across, across);
                dot(at, along) >= 0.0 && (0.0..=1.0).contains(&share)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bonds_go_through_what_is_between_two_rays_or_past_it() {
        let half = 0.5_f64.sqrt();
        let ray = |origin: [f64; 3], direction: [f64; 3]| Cursor { origin, direction };
        let [eye, ahead] = [[0.0, 0.0, 5.0], [0.0, 0.0, -1.0]];
        let fan = [ray(eye, ahead), ray(eye, [half, 0.0, -half])];
        let strip = [ray(eye, ahead), ray([5.0, 0.0, 3.0], ahead)];
        for stroke in [fan, strip] {
            let sheet = Sheet::between(stroke).unwrap_or_else(|| unreachable!("it is one"));
            let is_crossed = |x: f64, z: f64| sheet.is_crossed([[x, -1.0, z], [x + 0.1, 1.0, z]]);
            assert!(is_crossed(1.0, 0.0) && is_crossed(2.0, -9.0), "behind each other");
            assert!(!is_crossed(-1.0, 0.0) && !is_crossed(9.0, 0.0), "beside it");
            assert!(!is_crossed(1.0, 9.0), "behind the eye");
            assert!(!sheet.is_crossed([[1.0, 1.0, 0.0], [1.0, 2.0, 0.0]]), "above it");
            assert!(!sheet.is_crossed([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), "within it");
        }
        assert!(Sheet::between([ray(eye, ahead), ray([1.0, 0.0, 5.0], [half, 0.0, -half])]).is_none());
        let nothing = Sheet::between([ray(eye, ahead); 2]);
        assert!(nothing.is_some_and(|sheet| !sheet.is_crossed([[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]])), "of no length");
    }
}
