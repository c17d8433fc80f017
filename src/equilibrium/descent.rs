//! The descent of one island, round by round.

use super::friction::{Rub, rubs};
use super::hold::{Grip, Hold};
use super::part::{Part, extent, grain};
use super::stride::largest_displacement;
use super::system::{NEUTRAL, pattern};
use super::{BALANCED, BALANCED_ENOUGH};
use crate::sim::solve::blocks::Blocks;
use crate::sim::vector::length;

/// Rounds after which an equilibrium is given up.
const MOST_ROUNDS: u32 = 1000;
/// Times that holds are let go or taken in one round: they nearly always agree after two or three.
const MOST_REVISIONS: u32 = 20;
/// Longest step at first, as a share of the extent: further out the model of the energy is none.
pub(super) const REACH: f64 = 0.25;
/// Rounds in which the force that is left has to halve, once it is small: rounding keeps it from going lower.
const PATIENCE: u32 = 10;
/// Force that rounding makes, in that of the stiffest bond strained by the grain of positions.
const NOISE: f64 = 0.1;
/// Extents that an island can move before it is said to fall: struts can be slid off.
const FARTHEST: f64 = 1e6;

/// Where the points are, what holds them, and how far the descent has come.
pub(super) struct Descent<const D: usize> {
    pub(super) part: Part<D>,
    /// Positions `[m]`.
    pub(super) x: Vec<[f64; D]>,
    pub(super) holds: Vec<Hold>,
    pub(super) rubs: Vec<Rub<D>>,
    /// What torques give to points `[N]`, as they lay when the round began.
    pub(super) twist: Vec<[f64; D]>,
    pub(super) system: Blocks<f64, D>,
    pub(super) work: Vec<f64>,
    /// The scale of stiffness `[N/m]`.
    pub(super) scale: f64,
    /// Added to the diagonal of the matrix `[N/m]`.
    pub(super) shift: f64,
    /// The longest step `[m]`.
    pub(super) reach: f64,
    /// Times that it was pushed off a saddle.
    pub(super) pushes: u32,
    /// Force that is left, as a share of the largest single one; 0 where all are what rounding makes.
    pub(super) residual: f64,
    /// That force is what the stiffest bond makes of the rounding of positions.
    is_noise: bool,
    pub(super) rounds: u32,
    /// It falls for ever.
    pub(super) falls: bool,
    /// It balances, at a minimum.
    is_balanced: bool,
    is_done: bool,
    /// The least force that was left, and the rounds since then.
    best: (f64, u32),
}

impl<const D: usize> Descent<D> {
    pub(super) fn new(mut part: Part<D>) -> Self {
        let falls = part.falls_for_ever();
        if !falls {
            part.drop_down();
        }
        let (x, holds) = (part.position.clone(), part.holds.clone());
        let scale = part.stiffest();
        let has_rigid = holds.iter().any(|hold| matches!(hold.grip, Grip::Bond { .. }));
        Descent {
            // Without tensions yet nothing tells a chain which way is down: the first steps go along the gradient.
            shift: if has_rigid { scale } else { 0.0 },
            scale,
            system: pattern(&part),
            rubs: rubs(&part),
            twist: part.twist(&part.position),
            reach: REACH * extent(&x),
            work: Vec::new(),
            pushes: 0,
            residual: f64::INFINITY,
            is_noise: false,
            rounds: 0,
            falls,
            is_balanced: false,
            is_done: falls,
            best: (f64::INFINITY, 0),
            part,
            x,
            holds,
        }
    }

    pub(super) fn run(&mut self) {
        let (start, farthest) = (self.x.clone(), FARTHEST * extent(&self.x));
        while self.rounds < MOST_ROUNDS && !self.is_done {
            self.round();
            self.rounds += 1;
            if largest_displacement(&start, &self.x) > farthest {
                (self.falls, self.is_done) = (true, true);
            }
        }
    }

    /// Whether forces balance at a minimum.
    pub(super) fn is_settled(&self) -> bool {
        self.is_balanced && self.is_balanced_enough()
    }

    /// One step of Newton's method, shortened where it has to be.
    fn round(&mut self) {
        let scale = self.scale;
        if !self.part.torques.is_empty() {
            self.twist = self.part.twist(&self.x);
        }
        let (force, largest) = self.forces(&self.x);
        self.touch();
        self.factor();
        let mut step = self.newton_step(force.clone());
        for _ in 0..MOST_REVISIONS {
            if !self.revise(&step) {
                break;
            }
            self.factor();
            step = self.newton_step(force.clone());
        }
        let left = self.largest(&self.rubbed(self.left(force, &step.lambda, &self.x), &step.rubs));
        let tension =
            self.holds.iter().zip(&step.lambda).map(|(hold, &lambda)| hold.tension(lambda)).fold(0.0, f64::max);
        self.residual = left / largest.max(tension).max(f64::MIN_POSITIVE);
        let is_level = self.shift <= NEUTRAL * scale;
        self.is_noise = left <= NOISE * scale * grain(&self.x);
        let is_still = self.is_still(&step.displacement, is_level);
        // A last step would follow rounding along directions that are neutral.
        if !is_still || self.shift == 0.0 {
            let before: Vec<f64> = self.violations(&self.x).collect();
            let is_whole = self.stride(&step);
            if is_level && is_whole {
                self.firm_up(&before);
            }
        } else {
            self.holds.iter_mut().zip(&step.lambda).for_each(|(hold, lambda)| hold.lambda = *lambda);
            self.rubs.iter_mut().zip(&step.rubs).for_each(|(rub, force)| rub.force = *force);
        }
        if is_still && self.slip(&step) {
            self.best = (f64::INFINITY, 0);
        } else if is_still && is_level {
            (self.is_balanced, self.is_done) = (true, true);
            // Where there is no force but that of rounding, a share of the largest says nothing.
            self.residual = if self.is_noise && self.residual > BALANCED_ENOUGH { 0.0 } else { self.residual };
        } else if is_still {
            self.leave_saddle();
        }
    }

    /// Whether nothing moves any more, or no force is left but what rounding makes.
    fn is_still(&mut self, step: &[[f64; D]], is_level: bool) -> bool {
        let fine = grain(&self.x);
        if self.residual < 0.5 * self.best.0 {
            self.best = (self.residual, 0);
        }
        self.best.1 += u32::from(is_level);
        let stalls = self.best.1 > PATIENCE && self.is_balanced_enough();
        let moves = step.iter().map(|&s| length(s)).fold(0.0, f64::max);
        moves <= fine || ((self.residual <= BALANCED || stalls) && self.violation(&self.x) <= 4.0 * fine)
    }

    /// Whether the force that is left may be what rounding makes of one of bad condition.
    fn is_balanced_enough(&self) -> bool {
        self.residual <= BALANCED_ENOUGH || self.is_noise
    }

    /// The end of the descent without an equilibrium.
    pub(super) fn give_up(&mut self) {
        self.is_done = true;
    }
}
