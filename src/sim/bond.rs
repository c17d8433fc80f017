//! A bond between two points: its ends, its rest length, and how it resists.

use super::drive::Drive;
use super::real::Real;

/// Index of a point in its world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct PointId(pub u32);

impl PointId {
    /// The index as one into a slice.
    #[inline(always)]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Index of a bond in its world, as listed in the model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct BondId(pub u32);

impl BondId {
    /// The index as one into a slice.
    #[inline(always)]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Two ends of a bond or of a side, the lower one first: so that the same two are the same pair.
#[inline]
pub(crate) fn lower_first<T: Ord + Copy>([a, b]: [T; 2]) -> [T; 2] {
    [a.min(b), a.max(b)]
}

/// How a bond resists a change of its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BondKind {
    /// |x_a - x_b| = rest_length.
    Rigid,
    /// A force: f_a = -stiffness (|d| - rest) d/|d| - damping ((v_a - v_b).d) d/|d|^2 with d = x_a - x_b, f_b = -f_a.
    /// At rest length 0: f_a = -stiffness d - damping (v_a - v_b).
    Spring {
        /// Stiffness `[N/m]`, >= 0.
        stiffness: f64,
        /// Damping along the bond `[N s/m]`, >= 0.
        damping: f64,
    },
    /// Drawn towards its rest length by a share of the error in every sweep; not a material (it depends on the
    /// substep, the sweeps and their order).
    Relaxed {
        /// The share `[1]`, in (0, 1].
        relaxation: f64,
        /// Largest |rest/length - 1| times `relaxation` that one sweep may correct by, both ways `[1]`; infinite: no limit.
        max_correction: f64,
    },
}

/// On which side of its rest length a bond acts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Limit {
    /// Always.
    #[default]
    Both,
    /// Only when longer than its rest length (a string).
    Max,
    /// Only when shorter (a strut that may part).
    Min,
}

impl Limit {
    /// Whether a bond acts whose excess over its rest length, or what stands for that, is `over`: by more than `margin`
    /// on its side. One that acts always does.
    #[inline(always)]
    pub(crate) fn acts<S: Real>(self, over: S, margin: S) -> bool {
        match self {
            Limit::Both => true,
            Limit::Max => over > margin,
            Limit::Min => over < -margin,
        }
    }
}

/// A bond between the points `a` and `b` (not the same).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bond {
    /// One end.
    pub a: PointId,
    /// The other end.
    pub b: PointId,
    /// Rest length `[m]`, >= 0; 0 is a weld.
    pub rest_length: f64,
    /// How it resists.
    pub kind: BondKind,
    /// On which side of the rest length it acts.
    pub limit: Limit,
    /// Strain above which it is gone `[1]`, > 0; infinite: never. At that moment where events are located, else at the end
    /// of a substep.
    pub break_strain: f64,
    /// What its rest length follows; a spring or rigid bond that acts both ways and has a length.
    pub drive: Option<Drive>,
}

impl Bond {
    /// A rigid bond of this rest length `[m]` that acts both ways and never breaks.
    pub fn new(a: PointId, b: PointId, rest_length: f64) -> Self {
        Bond { a, b, rest_length, kind: BondKind::Rigid, limit: Limit::Both, break_strain: f64::INFINITY, drive: None }
    }

    /// Rigid, both ways, of one length.
    pub(crate) fn is_held(&self) -> bool {
        self.kind == BondKind::Rigid && self.limit == Limit::Both && self.drive.is_none()
    }

    /// Whether it does nothing: a spring without stiffness and damping, as springs are that were switched off.
    pub(crate) fn is_off(&self) -> bool {
        self.kind == BondKind::Spring { stiffness: 0.0, damping: 0.0 }
    }

    /// Its strain where it is so long `[1]`, of this length at rest, both `[m]`; 0 where it does not act, and without a length at rest.
    pub(crate) fn strain(&self, length: f64, rest: f64) -> f64 {
        if rest > 0.0 && self.limit.acts(length - rest, 0.0) { length / rest - 1.0 } else { 0.0 }
    }

    /// Whether it holds its length for ever.
    pub(crate) fn holds(&self) -> bool {
        self.is_held() && !self.break_strain.is_finite() && self.rest_length > 0.0
    }
}

/// Rest lengths of bonds `[m]` by their ends, ascending.
pub(crate) struct Lengths(Vec<([PointId; 2], f64)>);

impl Lengths {
    pub(crate) fn of(bonds: impl Iterator<Item = ([PointId; 2], f64)>) -> Self {
        let mut list: Vec<([PointId; 2], f64)> = bonds.map(|(ends, rest)| (lower_first(ends), rest)).collect();
        list.sort_unstable_by_key(|entry| entry.0);
        Lengths(list)
    }

    /// That of a bond between two points, where there is one.
    pub(crate) fn between(&self, ends: [PointId; 2]) -> Option<f64> {
        let found = self.0.binary_search_by_key(&lower_first(ends), |entry| entry.0);
        found.ok().map(|found| self.0[found].1)
    }
}
