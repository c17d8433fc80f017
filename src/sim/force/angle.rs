//! Angles between two arms that meet in a point, as forces in the plane: bending, and the limits of joints.
//!
//! theta is the angle at j from the arm j -> i to the arm j -> k, anticlockwise. It is measured from the middle m of its range, or from its
//! rest: m + atan2(sin(theta - m), cos(theta - m)), which has its jump half a turn away from there, so that it may cross pi.

use crate::sim::bond::PointId;
use crate::sim::drive::{AngleDrive, Keys};
use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub};

/// Share of an arm's length at the start below which the arm pulls less and less: at none it has no direction.
const LEAST_ARM: f64 = 0.1;
/// How far beyond its range an angle may be to count as at its stop `[rad]`: what numbers in a file leave.
const AT_STOP: f64 = 1e-6;

/// An angle that resists, as a model has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// The number that commands know it by.
    pub number: u32,
    /// i, j, k: at j, from the arm to i to the arm to k, anticlockwise. They differ.
    pub points: [PointId; 3],
    /// The angle at which it is at rest `[rad]`, in (0, 2 pi).
    pub rest: f64,
    /// `[N m]`, >= 0.
    pub stiffness: f64,
    /// `[N m s]`, >= 0.
    pub damping: f64,
    /// The least and the largest angle of a joint `[rad]`, less than a turn apart; `None`: it turns freely.
    pub range: Option<[f64; 2]>,
    /// Lengths of both arms at the start `[m]`, > 0.
    pub arms: [f64; 2],
    /// Stiffness beyond the range `[N m]`; 0: still to be worked out from what acts on its body.
    pub stop: f64,
    /// What moves it.
    pub drive: Option<AngleDrive>,
}

impl Angle {
    /// The energy `[J]` with which its stops push it in where its points are at these places `[m]`; 0 within its range.
    pub(crate) fn pushed_in<const D: usize>(&self, places: [[f64; D]; 3]) -> f64 {
        let beyond = self.beyond(places).abs();
        if beyond > AT_STOP { 0.5 * self.stop * beyond * beyond } else { 0.0 }
    }

    /// By how much it is above its range `[rad]`, negative below; 0 within.
    fn beyond<const D: usize>(&self, places: [[f64; D]; 3]) -> f64 {
        let Some([least, most]) = self.range else { return 0.0 };
        let (off, half) = (wrapped(measured(places).0 - 0.5 * (least + most)), 0.5 * (most - least));
        off - off.min(half).max(-half)
    }

    /// Widens the range to where it stands, if that is beyond it by no more than `margin` `[rad]`.
    pub(crate) fn reach<const D: usize>(&mut self, places: [[f64; D]; 3], margin: f64) {
        let beyond = self.beyond(places);
        if let Some([least, most]) = self.range.as_mut().filter(|_| beyond.abs() <= margin) {
            *least += beyond.min(0.0);
            *most += beyond.max(0.0);
        }
    }
}

/// The angles of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Angles {
    /// Those that are left, their numbers ascending.
    pub list: Vec<Angle>,
    /// The number of the next one.
    pub next: u32,
}

impl Angles {
    /// Angles numbered from 0.
    pub fn of(mut list: Vec<Angle>) -> Self {
        list.iter_mut().zip(0..).for_each(|(angle, number)| angle.number = number);
        Angles { next: list.len() as u32, list }
    }
}

/// The angle at j from the arm to i to that to k, in [0, 2 pi) `[rad]`, and the lengths of both arms `[m]`.
pub fn measured<const D: usize>([i, j, k]: [[f64; D]; 3]) -> (f64, [f64; 2]) {
    let (p, q) = (sub(i, j), sub(k, j));
    let angle = libm::atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]);
    let arms = [dot(p, p).sqrt(), dot(q, q).sqrt()];
    (if angle < 0.0 { angle + 2.0 * std::f64::consts::PI } else { angle }, arms)
}

/// An angle in (-pi, pi] that points the same way `[rad]`.
fn wrapped(angle: f64) -> f64 {
    libm::atan2(libm::sin(angle), libm::cos(angle))
}

/// An angle as the kernel reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hinge<S> {
    pub(crate) points: [u32; 3],
    /// Sine and cosine of what it is measured from.
    from: [S; 2],
    /// Rest and half the range, measured from there `[rad]`.
    rest: S,
    half: S,
    pub(crate) stiffness: S,
    pub(crate) damping: S,
    /// Stiffness beyond the range `[N m]`.
    pub(crate) stop: S,
    /// Squares of the lengths below which arms pull less `[m^2]`.
    least: [S; 2],
    /// What moves it.
    pub(crate) drive: Option<AngleDrive>,
}

/// How an angle stands: itself, seen from its middle `[rad]`, and its slopes by the places of its points `[rad/m]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stand<S> {
    pub(crate) angle: S,
    pub(crate) slopes: [[S; 2]; 3],
    /// Share of its torque that it has with arms as short as they are `[1]`.
    share: S,
    arms: [[S; 2]; 2],
    squares: [S; 2],
}

impl<S: Real> Hinge<S> {
    /// The hinge between these places in a group.
    pub(crate) fn new(angle: &Angle, points: [u32; 3]) -> Self {
        let middle = angle.range.map_or(angle.rest, |[least, most]| 0.5 * (least + most));
        let half = angle.range.map_or(f64::INFINITY, |[least, most]| 0.5 * (most - least));
        let least = |arm: f64| S::from_f64(LEAST_ARM * LEAST_ARM * arm * arm);
        Hinge {
            points,
            from: [libm::sin(middle), libm::cos(middle)].map(S::from_f64),
            rest: S::from_f64(if angle.range.is_some() { wrapped(angle.rest - middle) } else { 0.0 }),
            half: S::from_f64(half),
            stiffness: S::from_f64(angle.stiffness),
            damping: S::from_f64(angle.damping),
            stop: S::from_f64(angle.stop),
            least: angle.arms.map(least),
            drive: angle.drive,
        }
    }

    /// No stiffer than a step of `h` `[s]` bears where points of these inverse masses `[1/kg]` are moved by it alone: k h^2 sum of w |g|^2, with
    /// arms as long as at the start and in line, is at most `most`, and of its damper c h sum of w |g|^2.
    pub(crate) fn bounded(self, [i, j, k]: [f64; 3], (h, most): (f64, f64)) -> Self {
        let [a, b] = self.least.map(|least| LEAST_ARM / least.to_f64().sqrt());
        let most = most / (i * a * a + k * b * b + j * (a + b) * (a + b));
        let [stiffness, damping] = [most / (h * h), most / h].map(S::from_f64);
        Hinge { stiffness: self.stiffness.min(stiffness), damping: self.damping.min(damping), ..self }
    }

    /// How it stands where its points are; `None` of an arm without a length.
    #[inline(always)]
    pub(crate) fn stand<const D: usize>(&self, [i, j, k]: [[S; D]; 3]) -> Option<Stand<S>> {
        let arm = |end: [S; D]| [end[0] - j[0], end[1] - j[1]];
        let (p, q) = (arm(i), arm(k));
        let squares = [dot(p, p), dot(q, q)];
        if !(squares[0] > S::ZERO && squares[1] > S::ZERO) {
            return None;
        }
        let (sin, cos) = (p[0] * q[1] - p[1] * q[0], dot(p, q));
        // Turned back by where it is measured from.
        let [from_sin, from_cos] = self.from;
        let angle = libm::atan2((sin * from_cos - cos * from_sin).to_f64(), (cos * from_cos + sin * from_sin).to_f64());
        let share = |n: usize| if squares[n] < self.least[n] { squares[n] / self.least[n] } else { S::ONE };
        let slope = |v: [S; 2], square: S| scale([-v[1], v[0]], S::ONE / square);
        let (to_i, to_k) = (slope(p, -squares[0]), slope(q, squares[1]));
        let to_j = [-(to_i[0] + to_k[0]), -(to_i[1] + to_k[1])];
        Some(Stand {
            angle: S::from_f64(angle),
            slopes: [to_i, to_j, to_k],
            share: share(0) * share(1),
            arms: [p, q],
            squares,
        })
    }

    /// How far beyond the range an angle is `[rad]`, below 0 under its least.
    #[inline(always)]
    pub(crate) fn beyond(&self, angle: S) -> S {
        if angle > self.half {
            angle - self.half
        } else if angle < -self.half {
            angle + self.half
        } else {
            S::ZERO
        }
    }

    /// Of a turn from an angle on what keeps it within the range `[rad]`.
    #[inline(always)]
    pub(crate) fn kept(&self, angle: S, turn: S) -> S {
        match turn > S::ZERO {
            true => turn.min((self.half - angle).max(S::ZERO)),
            false => turn.max((-self.half - angle).min(S::ZERO)),
        }
    }

    /// How far an angle is from its rest `[rad]`.
    #[inline(always)]
    pub(crate) fn off_rest(&self, angle: S) -> S {
        angle - self.rest
    }

    /// dE/dtheta, the damper left aside `[N m]`.
    #[inline(always)]
    fn torque(&self, angle: S) -> S {
        self.stiffness * self.off_rest(angle) + self.stop * self.beyond(angle)
    }

    /// The forces on its points `[N]`: without and with its damper.
    ///
    /// Model: E = stiffness/2 (theta - rest)^2 + stop/2 (what theta is beyond its range)^2, force = -(dE/dtheta + damping theta')
    /// dtheta/dx; the slope by the end of an arm e is e turned by a right angle, over |e|^2. Arms shorter than a tenth of their length at the
    /// start scale all three forces by (|e|/that)^2: they stay finite and keep momentum and angular momentum.
    #[inline(always)]
    pub(crate) fn forces<const D: usize>(&self, x: [[S; D]; 3], v: [[S; D]; 3]) -> Option<[[[S; 2]; 3]; 2]> {
        let stand = self.stand(x)?;
        let torque = self.torque(stand.angle) * stand.share;
        let damped = torque + self.damping * stand.rate(v) * stand.share;
        Some([torque, damped].map(|torque| stand.slopes.map(|slope| scale(slope, -torque))))
    }

    /// The level of its drive at time `t` `[s]`; 0 without one.
    pub(crate) fn level(&self, t: f64, keys: &Keys) -> S {
        self.drive.map_or(S::ZERO, |drive| S::from_f64(drive.signal().level(t, keys)))
    }

    /// Whether a motor drives it.
    pub(crate) fn is_motor(&self) -> bool {
        matches!(self.drive, Some(AngleDrive::Motor { .. }))
    }

    /// The torque `[N m]` of its drive at a level, while it changes at `rate` `[rad/s]`; arms that are too short left aside.
    #[inline(always)]
    pub(crate) fn driving(&self, rate: S, level: S) -> S {
        match self.drive {
            None => S::ZERO,
            Some(AngleDrive::Servo { amplitude, .. }) => self.stiffness * S::from_f64(amplitude) * level,
            Some(drive @ AngleDrive::Motor { speed, torque, .. }) => {
                let most = S::from_f64(torque);
                (S::from_f64(drive.slope()) * (S::from_f64(speed) * level - rate)).max(-most).min(most)
            }
        }
    }

    /// The same with its angle at rest moved by so much `[rad]`.
    pub(crate) fn moved(self, by: S) -> Self {
        Hinge { rest: self.rest + by, ..self }
    }

    /// The steepest of its slopes, with arms as long as at the start and in line, and that of its longer arm `[1/m]`.
    pub(crate) fn steepest(&self) -> f64 {
        self.least.iter().map(|least| LEAST_ARM / least.to_f64().sqrt()).sum()
    }

    /// See [`Hinge::steepest`].
    pub(crate) fn shallowest(&self) -> f64 {
        self.least.iter().map(|least| LEAST_ARM / least.to_f64().sqrt()).fold(f64::INFINITY, f64::min)
    }

    /// The same between other points.
    pub(crate) fn between(self, points: [u32; 3]) -> Self {
        Hinge { points, ..self }
    }

    /// Its energy but for what its limits have `[J]`.
    pub(crate) fn energy_within<const D: usize>(&self, x: [[S; D]; 3]) -> S {
        Hinge { stop: S::ZERO, ..*self }.energy(x)
    }

    /// Its energy `[J]`.
    pub(crate) fn energy<const D: usize>(&self, x: [[S; D]; 3]) -> S {
        let Some(stand) = self.stand(x) else { return S::ZERO };
        let (off, beyond) = (self.off_rest(stand.angle), self.beyond(stand.angle));
        S::HALF * (self.stiffness * off * off + self.stop * beyond * beyond)
    }

    /// Minus the derivative of the forces by the places, `rate` `[1/s]` times that by the velocities included `[N/m]`.
    ///
    /// (K + rate c) g g^T with the slopes g, and the torque times the second derivative of theta, which is left out where `is_cautious`:
    /// it may be negative.
    pub(crate) fn stiffness_blocks<const D: usize>(
        &self,
        x: [[S; D]; 3],
        rate: S,
        is_cautious: bool,
    ) -> Option<[[[[S; 2]; 2]; 3]; 3]> {
        let stand = self.stand(x)?;
        let stop = if self.beyond(stand.angle) == S::ZERO { S::ZERO } else { self.stop };
        let along = (self.stiffness + stop + rate * self.damping) * stand.share;
        let g = stand.slopes;
        let mut blocks = [[[[S::ZERO; 2]; 2]; 3]; 3];
        for (m, row) in blocks.iter_mut().enumerate() {
            for (n, block) in row.iter_mut().enumerate() {
                *block = g[m].map(|component| scale(g[n], along * component));
            }
        }
        if !is_cautious {
            let torque = self.torque(stand.angle) * stand.share;
            let bend = |arm: [S; 2], square: S, sign: S| {
                let two = S::ONE + S::ONE;
                let by = sign * torque / (square * square);
                let (diagonal, beside) = (two * arm[0] * arm[1] * by, (arm[1] * arm[1] - arm[0] * arm[0]) * by);
                [[diagonal, beside], [beside, -diagonal]]
            };
            let ends = [
                (0, bend(stand.arms[0], stand.squares[0], -S::ONE)),
                (2, bend(stand.arms[1], stand.squares[1], S::ONE)),
            ];
            for (end, bend) in ends {
                for (m, n, sign) in [(end, end, S::ONE), (1, 1, S::ONE), (end, 1, -S::ONE), (1, end, -S::ONE)] {
                    for r in 0..2 {
                        for c in 0..2 {
                            blocks[m][n][r][c] += sign * bend[r][c];
                        }
                    }
                }
            }
        }
        Some(blocks)
    }
}

impl<S: Real> Stand<S> {
    /// Share of its torque that it has with arms as short as they are `[1]`.
    pub(crate) fn share(&self) -> S {
        self.share
    }

    /// theta' `[rad/s]`.
    #[inline(always)]
    pub(crate) fn rate<const D: usize>(&self, v: [[S; D]; 3]) -> S {
        let along = |n: usize| self.slopes[n][0] * v[n][0] + self.slopes[n][1] * v[n][1];
        along(0) + along(1) + along(2)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn angle(rest: f64, range: Option<[f64; 2]>) -> Angle {
        let points = [PointId(0), PointId(1), PointId(2)];
        Angle {
            number: 0,
            points,
            rest,
            stiffness: 3.0,
            damping: 0.5,
            range,
            arms: [1.0, 2.0],
            stop: 40.0,
            drive: None,
        }
    }

    const X: [[f64; 2]; 3] = [[0.3, 1.1], [0.1, 0.2], [-1.4, 0.9]];

    #[test]
    fn an_angle_is_measured_anticlockwise() {
        let quarter = [[1.0, 0.0], [0.0, 0.0], [0.0, 2.0]];
        assert_eq!(measured(quarter), (0.5 * std::f64::consts::PI, [1.0, 2.0]));
        let [i, j, k] = quarter;
        assert_eq!(measured([k, j, i]).0, 1.5 * std::f64::consts::PI);
    }

    #[test]
    fn a_step_bears_no_stiffer_angle_than_it_is_asked_for() {
        // Arms of 1 and 2 m, 2 kg in the middle, 1 and 4 kg at the ends: sum of w |g|^2 = 1 + 1/16 + 9/8.
        let (hinge, w) = (Hinge::<f64>::new(&angle(2.0, None), [0, 1, 2]), [1.0, 0.5, 0.25]);
        let sum = 1.0 + 0.0625 + 1.125;
        let soft = hinge.bounded(w, (1e-3, 1.0));
        assert_eq!((soft.stiffness, soft.damping), (3.0, 0.5), "as it is");
        let bounded = hinge.bounded(w, (2.0, 0.5));
        assert!(
            (bounded.stiffness * 4.0 * sum - 0.5).abs() < 1e-12 && (bounded.damping * 2.0 * sum - 0.5).abs() < 1e-12
        );
        assert_eq!(hinge.bounded([0.0; 3], (2.0, 0.5)).stiffness, 3.0, "pins bear any");
    }

    #[test]
    fn forces_and_their_derivatives_are_those_of_the_energy() {
        for (rest, range) in [(2.0, None), (6.0, None), (1.0, Some([0.5, 1.1])), (1.0, Some([-3.0, -0.2]))] {
            let hinge = Hinge::<f64>::new(&angle(rest, range), [0, 1, 2]);
            let still = [[0.0; 2]; 3];
            let force = hinge.forces(X, still).unwrap()[0];
            let blocks = hinge.stiffness_blocks(X, 0.0, false).unwrap();
            let step = 1e-5;
            let moved = |n: usize, k: usize, by: f64| {
                let mut x = X;
                x[n][k] += by;
                x
            };
            for n in 0..3 {
                for k in 0..2 {
                    let (ahead, back) = (moved(n, k, step), moved(n, k, -step));
                    let slope = (hinge.energy(ahead) - hinge.energy(back)) / (2.0 * step);
                    assert!((force[n][k] + slope).abs() < 1e-7, "{rest}: {} {slope}", force[n][k]);
                    let (more, less) = (hinge.forces(ahead, still).unwrap()[0], hinge.forces(back, still).unwrap()[0]);
                    for m in 0..3 {
                        for c in 0..2 {
                            let stiff = -(more[m][c] - less[m][c]) / (2.0 * step);
                            assert!((blocks[m][n][c][k] - stiff).abs() < 1e-6 * (1.0 + stiff.abs()), "{m}{n} {c}{k}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn forces_have_no_sum_and_no_moment_whatever_the_arms() {
        for x in [X, [[0.11, 0.2], [0.1, 0.2], [-1.4, 0.9]], [[0.11, 0.2], [0.1, 0.2], [0.1, 0.23]]] {
            let hinge = Hinge::<f64>::new(&angle(4.0, None), [0, 1, 2]);
            let v = [[0.2, -1.0], [0.5, 0.1], [0.0, 0.7]];
            for force in hinge.forces(x, v).unwrap() {
                let size: f64 = force.iter().flatten().fold(0.0, |most, f| most.max(f.abs()));
                let sum = |k: usize| force.iter().map(|f| f[k]).sum::<f64>();
                let moment: f64 = x.iter().zip(&force).map(|(x, f)| x[0] * f[1] - x[1] * f[0]).sum();
                assert!(size > 0.0 && sum(0).abs() + sum(1).abs() + moment.abs() < 1e-13 * size.max(1.0), "{force:?}");
                assert!(size < 400.0, "arms without a length pull without bounds: {size}");
            }
        }
        let hinge = Hinge::<f64>::new(&angle(4.0, None), [0, 1, 2]);
        assert!(hinge.forces([[0.0; 2]; 3], [[0.0; 2]; 3]).is_none());
    }

    #[test]
    fn an_angle_may_cross_half_a_turn() {
        let hinge = Hinge::<f64>::new(&angle(3.0, None), [0, 1, 2]);
        let at = |theta: f64| [[1.0, 0.0], [0.0, 0.0], [libm::cos(theta), libm::sin(theta)]];
        let energy = |theta: f64| hinge.energy(at(theta));
        for theta in [3.1, 3.2, 4.0, 5.5, 0.5] {
            assert!((energy(theta) - 1.5 * (theta - 3.0) * (theta - 3.0)).abs() < 1e-12, "{theta}");
        }
    }
}
