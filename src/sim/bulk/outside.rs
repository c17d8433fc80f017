//! What acts on points of large bodies from outside: the mouse and surfaces, where they are in reach.

use crate::sim::contact::surface::Surface;
use crate::sim::force::mouse::{Cursor, Push};
use crate::sim::measure;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::surroundings::Surroundings;
use crate::sim::vector::{add, dot, length, scale, sub};

/// Steps that are looked ahead: where nothing is in reach for so many, it is looked for once in all of them.
const AHEAD: f64 = 5.0;

/// Until when nothing is in reach, as long as the mouse stays where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clear {
    /// [s]
    until: f64,
    /// Where the mouse is, and its radius [m].
    mouse: Option<(Cursor, f64)>,
}

/// The mouse and the surfaces that some point may meet in a step.
pub(crate) struct Outside<S: Real, const D: usize> {
    pub(crate) mouse: Option<Push<S, D>>,
    pub(crate) surfaces: Vec<Surface<S, D>>,
}

impl<S: Real, const D: usize> Outside<S, D> {
    /// What the box around all points can meet in a step of `h` [s] from `t` on. Looks at no point where the scene has nothing to
    /// meet, or what was looked at last is clear: not far ahead where bonds push points, whose speeds now say little.
    pub(crate) fn in_reach(
        points: &Points<S, D>,
        pull: &Pull<S, D>,
        around: &Surroundings<D>,
        (t, h): (f64, f64),
        (clear, pushes): (&mut Option<Clear>, bool),
    ) -> Self {
        let none = Outside { mouse: None, surfaces: Vec::new() };
        let mouse = around.mouse_at(t + 0.5 * h);
        if mouse.is_none() && !pull.contacts.has_surfaces() {
            return none;
        }
        let place = mouse.map(|(force, cursor)| (cursor, force.radius));
        if clear.is_some_and(|clear| clear.mouse == place && t + h <= clear.until) {
            return none;
        }
        let Some([low, high]) = measure::extent(&points.position) else { return none };
        let fastest = measure::speed_bound(&points.velocity);
        let within = |time: f64| {
            let fall = length(pull.gravity) * time;
            let reach = (fastest + S::from_f64(fall)) * S::from_f64(2.0 * time);
            let bounds = [low.map(|x| x - reach), high.map(|x| x + reach)];
            let surfaces = pull.contacts.surfaces.iter().filter(|surface| surface.least_gap(bounds) < S::ZERO);
            Outside {
                mouse: mouse.map(|(force, cursor)| Push::new(force, cursor)).filter(|push| push.reaches(bounds)),
                surfaces: surfaces.copied().collect(),
            }
        };
        let ahead = if pushes { 1.0 } else { AHEAD };
        let is_clear = within(ahead * h).is_nothing();
        *clear = is_clear.then_some(Clear { until: t + (ahead + 1e-6) * h, mouse: place });
        if is_clear { none } else { within(h) }
    }

    /// Whether nothing is in reach.
    pub(crate) fn is_nothing(&self) -> bool {
        self.mouse.is_none() && self.surfaces.is_empty()
    }

    /// The surfaces that `x` is below.
    pub(crate) fn below(&self, x: [S; D]) -> impl Iterator<Item = &Surface<S, D>> {
        self.surfaces.iter().filter(move |surface| surface.gap(x) < S::ZERO)
    }

    /// Whether `x` is below some surface.
    pub(crate) fn is_below(&self, x: [S; D]) -> bool {
        self.below(x).next().is_some()
    }

    /// What the surfaces make of a point that is about to go by `motion` from `x`: where it starts and how it goes instead,
    /// so that it ends on the surface with the velocity of the bounce. `None`: it meets none. `fall` is what gravity adds to a
    /// motion [m].
    ///
    /// v_n -> -restitution v_n, |change of v_t| <= friction |change of v_n|. Slow impacts do not bounce.
    pub(crate) fn meet(&self, x: [S; D], motion: [S; D], fall: [S; D]) -> Option<([S; D], [S; D])> {
        let (mut end, mut motion, mut met) = (add(x, motion), motion, false);
        let gentle = gentle(fall);
        for surface in &self.surfaces {
            let gap = surface.gap(end);
            if gap >= S::ZERO {
                continue;
            }
            met = true;
            end = sub(end, scale(surface.normal, gap));
            let speed = dot(motion, surface.normal);
            if speed >= S::ZERO {
                continue;
            }
            let bounce = if -speed > gentle { surface.restitution } else { S::ZERO };
            let along = sub(motion, scale(surface.normal, speed));
            let (size, most) = (length(along), surface.friction * (S::ONE + bounce) * -speed);
            let rubbed = if size > most { scale(along, (size - most) / size) } else { [S::ZERO; D] };
            end = sub(end, sub(along, rubbed));
            motion = sub(rubbed, scale(surface.normal, bounce * speed));
        }
        met.then(|| (sub(end, motion), motion))
    }
}

/// The fastest motion that does not bounce: what gravity gives and takes again while a point rests.
pub(crate) fn gentle<S: Real, const D: usize>(fall: [S; D]) -> S {
    S::from_f64(4.0) * length(fall)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::contact::surface::Plane;

    fn floor(restitution: f64, friction: f64) -> Outside<f64, 2> {
        let plane = Plane { point: [0.0, 0.0], normal: [0.0, 2.0], restitution, friction };
        Outside { mouse: None, surfaces: vec![Surface::new(&plane)] }
    }

    #[test]
    fn a_point_above_the_floor_meets_nothing() {
        assert_eq!(floor(0.5, 0.0).meet([0.0, 1.0], [0.1, -0.5], [0.0; 2]), None);
    }

    #[test]
    fn a_point_ends_on_the_floor_with_the_velocity_of_the_bounce() {
        let (x, motion) = floor(0.5, 0.0).meet([0.0, 0.1], [0.2, -0.4], [0.0, -0.002]).unwrap_or_default();
        assert_eq!(motion, [0.2, 0.2]);
        assert_eq!(add(x, motion), [0.2, 0.0]);
    }

    #[test]
    fn friction_takes_no_more_than_there_is_and_gentle_impacts_stay() {
        let (x, motion) = floor(0.5, 0.1).meet([0.0, 0.0], [0.3, -0.1], [0.0, -0.25]).unwrap_or_default();
        assert!((motion[0] - 0.29).abs() < 1e-15 && motion[1] == 0.0, "{motion:?}");
        assert!((add(x, motion)[0] - 0.29).abs() < 1e-15);
        let (_, motion) = floor(0.0, 9.0).meet([0.0, 0.0], [0.3, -0.1], [0.0; 2]).unwrap_or_default();
        assert_eq!(motion, [0.0, 0.0]);
    }
}
