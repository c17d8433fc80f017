//! What acts on points of large bodies from outside: the mouse and surfaces, where they are in reach.

use crate::sim::contact::obstacles::Obstacles;
use crate::sim::contact::surface::Surface;
use crate::sim::environment::Environment;
use crate::sim::force::mouse::Cursor;
use crate::sim::measure;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub};

/// Share of its motion by which a point may be off a surface that it lies on: so much of what impacts take is not told from that.
pub(crate) const LAY: f64 = 0.02;
/// Steps that are looked ahead: where nothing is in reach for so many, it is looked for once in all of them.
const AHEAD: f64 = 5.0;

/// Until when nothing is in reach, as long as the mouse stays where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clear {
    /// `[s]`
    until: f64,
    /// Where the mouse is, and its radius `[m]`.
    mouse: Option<(Cursor, f64)>,
}

/// The mouse and the surfaces that some point may meet in a step.
pub(crate) struct Outside<'a, S: Real, const D: usize> {
    /// What has a mouse in it that comes near.
    pub(crate) mouse: Option<&'a Environment<D>>,
    /// Where the mouse may push a point in the step: a box in the plane, all of space.
    pushed: [[S; D]; 2],
    planes: Vec<Surface<S, D>>,
    /// Where polygons are in reach.
    walls: Option<Obstacles<S, D>>,
    /// Bonds push points: what they give to one that friction holds is no motion of its body.
    by_forces: bool,
}

/// What surfaces took of a motion: by restitution, and by friction [m^2, of a point of mass 1].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Toll {
    pub(crate) impacts: f64,
    pub(crate) friction: f64,
}

impl Toll {
    /// Adds `share` times another.
    pub(crate) fn add(&mut self, other: Toll, share: f64) {
        self.impacts += share * other.impacts;
        self.friction += share * other.friction;
    }
}

/// A point's substep: from where to where, and its motion in the next one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Going<S, const D: usize> {
    /// Where it is before.
    pub(crate) from: [S; D],
    /// Where it is about to end.
    pub(crate) to: [S; D],
    /// What it has of velocity, as a displacement in a substep.
    pub(crate) motion: [S; D],
}

impl<'a, S: Real, const D: usize> Outside<'a, S, D> {
    /// What the box around all points can meet in a step of `h` `[s]` from `t` on. Looks at no point where the scene has nothing to
    /// meet, or what was looked at last is clear: not far ahead where bonds push points, whose speeds now say little.
    pub(crate) fn in_reach(
        points: &Points<S, D>,
        pull: &Pull<S, D>,
        around: &'a Environment<D>,
        (t, h): (f64, f64),
        (clear, by_forces): (&mut Option<Clear>, bool),
    ) -> Self {
        let pushed = [[S::ZERO; D]; 2];
        let none = Outside { mouse: None, pushed, planes: Vec::new(), walls: None, by_forces };
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
            let fall = (length(pull.gravity) + pull.most_push()) * time;
            let reach = (fastest + S::from_f64(fall)) * S::from_f64(2.0 * time);
            let bounds = [low.map(|x| x - reach), high.map(|x| x + reach)];
            let obstacles = &pull.contacts.obstacles;
            let planes = obstacles.planes().iter().filter(|surface| surface.least_gap(bounds) < S::ZERO);
            Outside {
                mouse: Some(around).filter(|around| around.may_reach(bounds, (t, h))),
                pushed: around.swept((t, h), reach),
                planes: planes.copied().collect(),
                walls: obstacles.has_walls_near(bounds).then(|| obstacles.clone()),
                by_forces,
            }
        };
        let ahead = if by_forces { 1.0 } else { AHEAD };
        let is_clear = within(ahead * h).is_nothing();
        *clear = is_clear.then_some(Clear { until: t + (ahead + 1e-6) * h, mouse: place });
        if is_clear { none } else { within(h) }
    }

    /// Whether the mouse may push a point in the step that is at `x` as it begins.
    #[inline(always)]
    pub(crate) fn may_push(&self, x: [S; D]) -> bool {
        let [low, high] = self.pushed;
        (0..D).all(|k| low[k] <= x[k] && x[k] <= high[k])
    }

    /// In how many parts of the step of `h` from `t` `[s]` points follow the cursor.
    pub(crate) fn parts(&self, points: &Points<S, D>, span: (f64, f64)) -> u32 {
        let moving = || points.position.iter().copied().zip(points.velocity.iter().copied());
        self.mouse.map_or(1, |around| around.parts_near(moving(), span))
    }

    /// Whether nothing is in reach.
    pub(crate) fn is_nothing(&self) -> bool {
        self.mouse.is_none() && !self.has_surfaces()
    }

    /// Whether surfaces are in reach.
    pub(crate) fn has_surfaces(&self) -> bool {
        !self.planes.is_empty() || self.walls.is_some()
    }

    /// The surfaces that a point on its way from `from` ends behind at `to`: planes, and of the walls of polygons the first that
    /// it goes through.
    pub(crate) fn behind(&self, from: [S; D], to: [S; D]) -> impl Iterator<Item = &Surface<S, D>> {
        let wall = self.walls.as_ref().and_then(|walls| {
            let met = walls.meeting(from, to, |_| true)?;
            Some(&walls.surfaces[met.surface]).filter(|surface| surface.gap(to) < S::ZERO)
        });
        self.planes.iter().filter(move |surface| surface.gap(to) < S::ZERO).chain(wall)
    }

    /// What the surfaces make of a point's substep: where it ends and its motion then, that of the bounce. `None`: it meets none.
    /// `fall` is what gravity adds to a motion `[m]`.
    ///
    /// v_n -> -restitution v_n, |change of v_t| <= friction |change of v_n|. Slow impacts do not bounce. Of a plane it ends on
    /// the surface; by the wall of a polygon it is turned where it meets it.
    /// What is taken of the motion is added to `toll`, if there is one.
    pub(crate) fn meet(
        &self,
        going: Going<S, D>,
        fall: [S; D],
        mut toll: Option<&mut Toll>,
    ) -> Option<([S; D], [S; D])> {
        let Going { from, mut to, mut motion } = going;
        let (mut met, gentle) = (false, gentle(fall));
        let mut count = |bounce: &Bounce<S, D>, surface: &Surface<S, D>| {
            if let Some(toll) = &mut toll {
                toll.add(bounce.toll(surface, (gentle, self.by_forces)), 1.0);
            }
        };
        let led = self.walls.as_ref().and_then(|walls| {
            walls.led(from, to, fall, |surface, left| {
                let bounce = Bounce::of((from, motion), &walls.surfaces[surface], gentle, scale(fall, left));
                motion = bounce.motion;
                count(&bounce, &walls.surfaces[surface]);
                [bounce.keep, bounce.back]
            })
        });
        if let Some(end) = led {
            (to, met) = (end, true);
        }
        for surface in &self.planes {
            let gap = surface.gap(to);
            if gap >= S::ZERO {
                continue;
            }
            met = true;
            let bounce = Bounce::of((from, motion), surface, gentle, [S::ZERO; D]);
            to = sub(sub(to, scale(surface.normal, gap)), bounce.rubbed);
            motion = bounce.motion;
            count(&bounce, surface);
        }
        met.then_some((to, motion))
    }
}

/// What a surface makes of a motion.
#[derive(Clone, Copy, Debug)]
struct Bounce<S, const D: usize> {
    /// The motion afterwards.
    motion: [S; D],
    /// What friction took.
    rubbed: [S; D],
    /// Share of the part along the surface that is left.
    keep: S,
    /// Share of the part across that is turned back.
    back: S,
    /// The parts across and along that it had.
    parts: [S; 2],
    /// The point lay on the surface: it is pressed, and no impact.
    lies: bool,
}

impl<S: Real, const D: usize> Bounce<S, D> {
    /// Of a point that began at `from`. What lay there bounces off what gives all back alone: bonds press it on again and again.
    /// `late` is what gravity added to the motion since `[m]`: what bounces did so without it.
    fn of((from, motion): ([S; D], [S; D]), surface: &Surface<S, D>, gentle: S, late: [S; D]) -> Self {
        let speed = dot(motion, surface.normal);
        if speed >= S::ZERO {
            let parts = [S::ZERO; 2];
            return Bounce { motion, rubbed: [S::ZERO; D], keep: S::ONE, back: S::ZERO, parts, lies: false };
        }
        let lies = surface.gap(from) <= -(S::from_f64(LAY) * speed);
        let is_impact = -speed > gentle && (!lies || surface.restitution >= S::ONE);
        let back = if is_impact { surface.restitution } else { S::ZERO };
        let late = if back > S::ZERO { late } else { [S::ZERO; D] };
        let motion = sub(motion, late);
        let speed = dot(motion, surface.normal).min(S::ZERO);
        let along = sub(motion, scale(surface.normal, speed));
        let (size, most) = (length(along), surface.friction * (S::ONE + back) * -speed);
        let keep = if size > most { (size - most) / size } else { S::ZERO };
        let kept = scale(along, keep);
        let motion = add(sub(kept, scale(surface.normal, back * speed)), late);
        Bounce { motion, rubbed: sub(along, kept), keep, back, parts: [speed, size], lies }
    }

    /// What is taken of the motion. A gentle impact is none, nor is what presses a point that lay there, or, where bonds are forces, what friction
    /// takes of one that it holds: that has by it as much as gravity or bonds gave it in the substep.
    fn toll(&self, surface: &Surface<S, D>, (gentle, by_forces): (S, bool)) -> Toll {
        let [across, along] = self.parts.map(|part| 0.5 * (part * part).to_f64());
        let left = |share: S| 1.0 - (share * share).to_f64();
        let is_impact = -self.parts[0] > gentle && surface.restitution < S::ONE && !self.lies;
        let is_held = by_forces && self.lies && self.keep == S::ZERO;
        Toll {
            impacts: if is_impact { across * left(self.back) } else { 0.0 },
            friction: if is_held { 0.0 } else { along * left(self.keep) },
        }
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

    fn floor(restitution: f64, friction: f64) -> Outside<'static, f64, 2> {
        let plane = Plane { point: [0.0, 0.0], normal: [0.0, 2.0], restitution, friction, penalty: None };
        Outside { mouse: None, pushed: [[0.0; 2]; 2], planes: vec![Surface::new(&plane)], walls: None, by_forces: true }
    }

    /// Where a point at `x` ends that is about to go by `motion`, and how.
    fn meet(
        outside: &Outside<'_, f64, 2>,
        x: [f64; 2],
        motion: [f64; 2],
        fall: [f64; 2],
    ) -> Option<([f64; 2], [f64; 2])> {
        outside.meet(Going { from: x, to: add(x, motion), motion }, fall, None)
    }

    #[test]
    fn a_point_above_the_floor_meets_nothing() {
        assert_eq!(meet(&floor(0.5, 0.0), [0.0, 1.0], [0.1, -0.5], [0.0; 2]), None);
    }

    #[test]
    fn a_point_ends_on_the_floor_with_the_velocity_of_the_bounce() {
        let (x, motion) = meet(&floor(0.5, 0.0), [0.0, 0.1], [0.2, -0.4], [0.0, -0.002]).unwrap_or_default();
        assert_eq!(motion, [0.2, 0.2]);
        assert_eq!(x, [0.2, 0.0]);
    }

    #[test]
    fn friction_takes_no_more_than_there_is_and_gentle_impacts_stay() {
        let (x, motion) = meet(&floor(0.5, 0.1), [0.0, 0.0], [0.3, -0.1], [0.0, -0.25]).unwrap_or_default();
        assert!((motion[0] - 0.29).abs() < 1e-15 && motion[1] == 0.0, "{motion:?}");
        assert!((x[0] - 0.29).abs() < 1e-15);
        let (_, motion) = meet(&floor(0.0, 9.0), [0.0, 0.0], [0.3, -0.1], [0.0; 2]).unwrap_or_default();
        assert_eq!(motion, [0.0, 0.0]);
    }

    #[test]
    fn what_surfaces_take_is_told() {
        let toll = |restitution: f64, friction: f64, motion: [f64; 2], fall: [f64; 2]| {
            let mut toll = Toll::default();
            let going = Going { from: [0.0, 0.1], to: add([0.0, 0.1], motion), motion };
            let met = floor(restitution, friction).meet(going, fall, Some(&mut toll));
            let (_, after) = met.unwrap_or_default();
            (toll, 0.5 * (dot(motion, motion) - dot(after, after)))
        };
        let (both, all) = toll(0.5, 0.1, [0.3, -0.4], [0.0, -0.001]);
        assert!((both.impacts - 0.5 * 0.16 * 0.75).abs() < 1e-15 && both.friction > 0.0, "{both:?}");
        assert!((both.impacts + both.friction - all).abs() < 1e-15, "{both:?} {all}");
        assert_eq!(toll(1.0, 0.0, [0.3, -0.4], [0.0; 2]).0, Toll::default());
        assert_eq!(toll(0.0, 0.0, [0.3, -0.4], [0.0, -0.2]).0, Toll::default(), "as fast as gravity makes it");
        let mut pressed = Toll::default();
        let going = Going { from: [0.0, 0.0], to: [0.3, -0.4], motion: [0.3, -0.4] };
        floor(0.0, 0.1).meet(going, [0.0; 2], Some(&mut pressed));
        assert!(pressed.impacts == 0.0 && pressed.friction > 0.0, "it lay there: {pressed:?}");
    }
}
