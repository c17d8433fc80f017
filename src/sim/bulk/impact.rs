//! Impacts of bodies that keep their shape: as one piece.
//!
//! What a surface gives to one point reaches the others through bonds, and passes over bonds take many substeps to carry it
//! through a large body: until then it is squeezed like rubber, which gives back what restitution should take. Where bonds hold
//! every point of a body in its place, an impact changes the motion u of all of them at once, as that of a rigid body:
//!
//! ```text
//! u_i <- u_i + V + omega x (x_i - c)      V = sum P/m,  omega = sum (x - c) x P/I
//! ```
//!
//! with impulses P where points hit that are the least that no surface pulls, each point has its velocity off the surface,
//! and friction holds it back by at most `friction` times what presses. What hits goes by its old motion until then, a share
//! of the substep, and by the new one from there on. What lies on the floor is hit in every substep by as much as gravity
//! gave it: so it lies still, and is not squeezed by its weight.

use super::outside::{self, Toll};
use crate::sim::contact::surface::Surface;
use crate::sim::real::Real;
use crate::sim::vector::{add, cross, dot, flat, scale, sub};

/// Most times that the impulses of an impact are gone through, one after the other (Gauss and Seidel's method).
const MOST_PASSES: u32 = 200;
/// Change of a motion, relative to the fastest that hits, that is none.
const NOTHING: f64 = 1e-9;
/// Share of a substep within which hits count as one impact.
const AT_ONCE: f64 = 0.02;

/// A body that hits surfaces: in the plane, in the units of its points' motions.
#[derive(Clone, Debug)]
pub(crate) struct Piece<const D: usize> {
    mass: f64,
    /// Sum of m x, and of m x.x.
    moments: ([f64; 2], f64),
    /// Where it is pinned; of more than two points, two.
    pins: Vec<[f64; 2]>,
    hits: Vec<Hit>,
    /// Share of the substep after which the first of them comes `[1]`.
    first: f64,
    centre: [f64; 2],
    /// What the impact changes: V and omega.
    change: ([f64; 2], f64),
}

/// A point and a surface that it hits.
#[derive(Clone, Copy, Debug)]
struct Hit {
    /// Share of the substep after which it comes `[1]`.
    share: f64,
    x: [f64; 2],
    motion: [f64; 2],
    normal: [f64; 2],
    friction: f64,
    /// The surface's restitution, 0 for slow impacts.
    bounce: f64,
    /// Motion off the surface afterwards, at least.
    target: f64,
    /// Along the normal, and across it.
    impulse: [f64; 2],
    /// Restitution takes something of it, and it did not lie there.
    takes: bool,
}

impl<const D: usize> Piece<D> {
    /// No point of it is known yet.
    pub(crate) fn new() -> Self {
        let (nothing, nowhere) = (([0.0; 2], 0.0), [0.0; 2]);
        let (pins, hits) = (Vec::new(), Vec::new());
        Piece { mass: 0.0, moments: nothing, pins, hits, first: 1.0, centre: nowhere, change: nothing }
    }

    /// A point about to end at `x` by `motion` is below this surface. `fall` is what gravity adds to a motion: slow impacts
    /// do not bounce, and those that are none do nothing.
    pub(crate) fn touch<S: Real>(&mut self, (x, motion): ([S; D], [S; D]), surface: &Surface<S, D>, fall: [S; D]) {
        let (speed, gap) = (dot(motion, surface.normal), surface.gap(x));
        let gentle = outside::gentle(fall);
        if speed >= -(gentle * S::from_f64(NOTHING)) {
            return;
        }
        let share = (S::ONE - gap / speed).max(S::ZERO).to_f64();
        self.first = self.first.min(share);
        self.hits.push(Hit {
            share,
            x: flat(x),
            motion: flat(motion),
            normal: flat(surface.normal),
            friction: surface.friction.to_f64(),
            bounce: if -speed > gentle { surface.restitution.to_f64() } else { 0.0 },
            target: 0.0,
            impulse: [0.0; 2],
            takes: -speed > gentle && surface.restitution < S::ONE && share > outside::LAY,
        });
    }

    /// Share of the substep that is left after the first hits `[1]`.
    pub(crate) fn left(&self) -> f64 {
        1.0 - self.first
    }

    /// Whether it hits nothing.
    pub(crate) fn is_clear(&self) -> bool {
        self.hits.is_empty()
    }

    /// A point of the body lies at `x`; w = 0 is pinned.
    pub(crate) fn weigh<S: Real>(&mut self, x: [S; D], w: S) {
        let x = flat(x);
        if w > S::ZERO {
            let mass = 1.0 / w.to_f64();
            self.mass += mass;
            self.moments = (add(self.moments.0, scale(x, mass)), self.moments.1 + mass * dot(x, x));
        } else if self.pins.len() < 2 {
            self.pins.push(x);
        }
    }

    /// Finds what the impact changes, when all points have been weighed: that of the hits which come first.
    pub(crate) fn strike<S: Real>(&mut self, fall: [S; D]) {
        let Some((ease, swing)) = self.mobility() else { return };
        self.aim(flat(fall));
        let fastest = self.hits.iter().map(|hit| dot(hit.motion, hit.motion)).fold(0.0, f64::max).sqrt();
        for _ in 0..MOST_PASSES {
            let mut largest: f64 = 0.0;
            for at in 0..self.hits.len() {
                let Hit { x, motion, normal, friction, target, impulse, .. } = self.hits[at];
                let (arm, tangent) = (sub(x, self.centre), [-normal[1], normal[0]]);
                let (lever, hold) = (cross(arm, normal), cross(arm, tangent));
                let gives = [lever, hold].map(|lever| ease + swing * lever * lever);
                let moves =
                    |way: [f64; 2], (v, omega): ([f64; 2], f64)| dot(add(motion, v), way) + omega * cross(arm, way);
                if gives[0] == 0.0 {
                    continue;
                }
                let push = (impulse[0] + (target - moves(normal, self.change)) / gives[0]).max(0.0);
                self.push(scale(normal, push - impulse[0]), lever * (push - impulse[0]), (ease, swing));
                let most = friction * push;
                let wanted = if gives[1] > 0.0 { impulse[1] - moves(tangent, self.change) / gives[1] } else { 0.0 };
                let rub = wanted.clamp(-most, most);
                self.push(scale(tangent, rub - impulse[1]), hold * (rub - impulse[1]), (ease, swing));
                self.hits[at].impulse = [push, rub];
                largest = largest.max((push - impulse[0]).abs() * gives[0]).max((rub - impulse[1]).abs() * gives[1]);
            }
            if largest <= NOTHING * fastest {
                return;
            }
        }
    }

    /// Leaves the hits that come first, with what they ask for: a bounce by the speed of then, not of the middle of the
    /// substep.
    fn aim(&mut self, fall: [f64; 2]) {
        let first = self.first;
        self.hits.retain(|hit| hit.share <= first + AT_ONCE);
        for hit in self.hits.iter_mut().filter(|hit| hit.bounce > 0.0) {
            hit.motion = add(hit.motion, scale(fall, first - 0.5));
            hit.target = hit.bounce * (-dot(hit.motion, hit.normal)).max(0.0);
        }
    }

    /// What the impact took: each impulse times the mean of the motions before and after it.
    pub(crate) fn toll(&self) -> Toll {
        let mut toll = Toll::default();
        let (v, omega) = self.change;
        for Hit { x, motion, normal, impulse: [push, rub], takes, .. } in &self.hits {
            let arm = sub(*x, self.centre);
            let gained = add(v, scale([-arm[1], arm[0]], omega));
            let mean = add(*motion, scale(gained, 0.5));
            let along = dot(mean, [-normal[1], normal[0]]);
            toll.impacts -= if *takes { push * dot(mean, *normal) } else { 0.0 };
            toll.friction -= rub * along;
        }
        Toll { impacts: toll.impacts.max(0.0), friction: toll.friction.max(0.0) }
    }

    /// What the impact adds to the motion of a point at `x`, and to the place where it then ends.
    pub(crate) fn change<S: Real>(&self, x: [S; D]) -> ([S; D], [S; D]) {
        let (v, omega) = self.change;
        let arm = sub(flat(x), self.centre);
        let mut motion = [S::ZERO; D];
        motion[0] = S::from_f64(v[0] - omega * arm[1]);
        motion[1] = S::from_f64(v[1] + omega * arm[0]);
        (motion, scale(motion, S::from_f64(1.0 - self.first)))
    }

    /// One over the mass and over the moment of inertia, about the point that it turns about. `None`: it cannot move.
    fn mobility(&mut self) -> Option<(f64, f64)> {
        let (first, second) = self.moments;
        let about = |c: [f64; 2]| second - 2.0 * dot(c, first) + self.mass * dot(c, c);
        let (centre, ease) = match self.pins[..] {
            [] => (scale(first, 1.0 / self.mass), 1.0 / self.mass),
            [pin] => (pin, 0.0),
            _ => return None,
        };
        self.centre = centre;
        let inertia = about(centre);
        (inertia > 0.0).then(|| (ease, 1.0 / inertia))
    }

    fn push(&mut self, impulse: [f64; 2], turn: f64, (ease, swing): (f64, f64)) {
        self.change = (add(self.change.0, scale(impulse, ease)), self.change.1 + swing * turn);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::contact::surface::Plane;

    fn floor(restitution: f64, friction: f64) -> Surface<f64, 2> {
        Surface::new(&Plane { point: [0.0, 0.0], normal: [0.0, 1.0], restitution, friction, penalty: None })
    }

    /// The motion of a point at `x` that was `motion`.
    fn moved(piece: &Piece<2>, x: [f64; 2], motion: [f64; 2]) -> [f64; 2] {
        add(motion, piece.change(x).0)
    }

    /// A rod of two points of mass 1, the left one at the origin and about to hit.
    fn rod(restitution: f64, friction: f64, motion: [f64; 2]) -> Piece<2> {
        let mut piece = Piece::new();
        piece.touch(([0.0, 0.0], motion), &floor(restitution, friction), [0.0; 2]);
        piece.weigh([0.0, 0.0], 1.0);
        piece.weigh([2.0, 0.0], 1.0);
        piece.strike([0.0; 2]);
        piece
    }

    #[test]
    fn a_level_rod_that_hits_with_one_end_turns_about_the_other() {
        let motion = [0.3, -1.0];
        let piece = rod(0.5, 0.0, motion);
        let [hit, free] = [[0.0, 0.0], [2.0, 0.0]].map(|x| moved(&piece, x, motion));
        assert!((hit[1] - 0.5).abs() < 1e-12 && (free[1] + 1.0).abs() < 1e-12, "{hit:?} {free:?}");
        assert!((hit[0] - 0.3).abs() < 1e-12, "no friction");
    }

    #[test]
    fn what_an_impact_takes_is_what_the_rod_has_less() {
        for (restitution, friction) in [(0.5, 0.0), (0.5, 0.1), (0.0, 9.0)] {
            let motion = [1.0, -1.0];
            let piece = rod(restitution, friction, motion);
            let left: f64 =
                [[0.0, 0.0], [2.0, 0.0]].map(|x| moved(&piece, x, motion)).map(|v| 0.5 * dot(v, v)).iter().sum();
            let Toll { impacts, friction } = piece.toll();
            assert!((impacts + friction - (2.0 - left)).abs() < 1e-9, "{impacts} {friction} {left}");
            assert!(impacts > 0.0);
        }
        assert_eq!(rod(1.0, 0.0, [1.0, -1.0]).toll(), Toll::default());
    }

    #[test]
    fn friction_is_a_share_of_what_presses_until_the_point_holds() {
        let slides = moved(&rod(0.0, 0.1, [1.0, -1.0]), [0.0; 2], [1.0, -1.0]);
        assert!(
            (slides[0] - 0.95).abs() < 1e-12,
            "an impulse of 1 stops the end, 0.1 of it on a mass of 2: {slides:?}"
        );
        let holds = moved(&rod(0.0, 9.0, [1.0, -1.0]), [0.0; 2], [1.0, -1.0]);
        assert!(holds[0].abs() < 1e-9 && holds[1].abs() < 1e-9, "{holds:?}");
    }

    #[test]
    fn a_piece_on_one_pin_turns_about_it_and_on_two_stays() {
        let (x, motion) = ([2.0, 0.0], [0.0, -1.0]);
        let strike = |pins: &[[f64; 2]]| {
            let mut piece = Piece::<2>::new();
            piece.touch((x, motion), &floor(1.0, 0.0), [0.0; 2]);
            piece.weigh(x, 1.0);
            pins.iter().for_each(|&pin| piece.weigh(pin, 0.0));
            piece.strike([0.0; 2]);
            (moved(&piece, x, motion), moved(&piece, [0.0; 2], [0.0; 2]))
        };
        let (end, pin) = strike(&[[0.0, 0.0]]);
        assert!((end[1] - 1.0).abs() < 1e-12 && pin == [0.0, 0.0], "{end:?} {pin:?}");
        assert_eq!(strike(&[[0.0, 0.0], [0.0, 1.0]]).0, motion);
    }

    #[test]
    fn a_box_that_lands_flat_stops_level() {
        let (mut piece, motion) = (Piece::<2>::new(), [0.4, -2.0]);
        for k in 0..20 {
            let x = [f64::from(k) * 0.1, -0.01];
            piece.touch((x, motion), &floor(0.0, 0.0), [0.0; 2]);
            piece.weigh(x, 1.0);
            piece.weigh([x[0], 1.0], 1.0);
        }
        piece.strike([0.0; 2]);
        for x in [[0.0, -0.01], [1.9, -0.01], [0.0, 1.0]] {
            let after = moved(&piece, x, motion);
            assert!(after[1].abs() < 1e-6 && (after[0] - 0.4).abs() < 1e-6, "{after:?}");
        }
    }

    #[test]
    fn a_point_that_hits_half_way_goes_on_from_the_surface() {
        let mut piece = Piece::<2>::new();
        piece.touch(([0.0, -1.0], [0.0, -2.0]), &floor(1.0, 0.0), [0.0; 2]);
        piece.weigh([0.0, -1.0], 1.0);
        piece.weigh([0.5, -1.0], 0.0);
        piece.strike([0.0; 2]);
        let (motion, end) = piece.change([0.0, -1.0]);
        assert_eq!((motion, end), ([0.0, 4.0], [0.0, 2.0]), "up to y = 1");
    }
}
