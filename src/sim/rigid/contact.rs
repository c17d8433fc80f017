//! Where a rigid body touches a surface, and how it answers to impulses there.

use super::inertia::Inertial;
use super::motion::{Axial, Twist};
use crate::sim::contact::coulomb::{Answers, Rub};
use crate::sim::vector::{add, dot, scale};

/// A point of a body on a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact<const N: usize = 2> {
    /// From the origin `[m]`.
    pub(super) arm: [f64; N],
    /// Unit vectors: away from the surface, then along its tangents.
    pub(super) ways: [[f64; N]; N],
    pub(super) rub: Rub<N>,
}

impl Contact {
    #[inline(always)]
    pub(super) fn tangent(&self) -> [f64; 2] {
        self.ways[1]
    }
}

impl<const N: usize> Contact<N> {
    /// A vector along the normal and the tangents.
    #[inline(always)]
    pub(super) fn seen(&self, v: [f64; N]) -> [f64; N] {
        let mut seen = [0.0; N];
        for (seen, way) in seen.iter_mut().zip(&self.ways) {
            *seen = dot(*way, v);
        }
        seen
    }

    /// Its velocity along the normal and the tangents.
    #[inline(always)]
    pub(super) fn speeds<W: Axial<N>>(&self, twist: &Twist<W, N>) -> [f64; N] {
        self.seen(twist.at(self.arm))
    }

    /// A vector along the normal and the tangents, in the world.
    #[inline(always)]
    fn out(&self, v: [f64; N]) -> [f64; N] {
        let mut sum = scale(self.ways[N - 1], v[N - 1]);
        for k in (0..N - 1).rev() {
            sum = add(scale(self.ways[k], v[k]), sum);
        }
        sum
    }

    /// The motion after an impulse, along the normal and the tangents.
    #[inline(always)]
    pub(super) fn pushed<I: Inertial<N>>(
        &self,
        inertia: &I,
        twist: &Twist<I::Spin, N>,
        impulse: [f64; N],
    ) -> Twist<I::Spin, N> {
        let impulse = self.out(impulse);
        Twist {
            velocity: add(twist.velocity, scale(impulse, inertia.ease())),
            spin: twist.spin.plus(inertia.spun(I::Spin::moment(self.arm, impulse))),
        }
    }

    /// Which way it slides along its tangents, as a unit vector; 0: at no speed that counts `[m/s]`.
    #[inline]
    pub(super) fn direction<W: Axial<N>>(&self, twist: &Twist<W, N>, still: f64) -> [f64; N] {
        let mut along = self.speeds(twist);
        along[0] = 0.0;
        let speed = dot(along, along).sqrt();
        for x in &mut along {
            *x = if speed > still { *x / speed } else { 0.0 };
        }
        along
    }
}

/// One body and where it touches.
pub(super) struct Alone<'a, I, const N: usize> {
    pub(super) inertia: I,
    pub(super) contacts: &'a [Contact<N>],
}

impl<I, const N: usize> Alone<'_, I, N> {
    /// What the law asks of each contact.
    pub(super) fn rubs(&self) -> Vec<Rub<N>> {
        self.contacts.iter().map(|contact| contact.rub).collect()
    }
}

impl<I: Inertial<N>, const N: usize> Answers<N> for Alone<'_, I, N> {
    type Motion = Twist<I::Spin, N>;
    type Friction = I::Friction;

    #[inline]
    fn speeds(&self, contact: usize, twist: &Self::Motion) -> [f64; N] {
        self.contacts[contact].speeds(twist)
    }

    #[inline]
    fn gives(&self, contact: usize) -> [[f64; N]; N] {
        let Contact { arm, ways, .. } = &self.contacts[contact];
        let mut gives = [[0.0; N]; N];
        for (c, way) in ways.iter().enumerate() {
            let spin = self.inertia.spun(I::Spin::moment(*arm, *way));
            for (r, other) in ways.iter().enumerate() {
                let ease = if r == c { self.inertia.ease() } else { 0.0 };
                gives[r][c] = ease + I::Spin::moment(*arm, *other).dot(spin);
            }
        }
        gives
    }

    #[inline]
    fn pushed(&self, contact: usize, impulse: [f64; N], twist: Self::Motion) -> Self::Motion {
        self.contacts[contact].pushed(&self.inertia, &twist, impulse)
    }

    fn energy(&self, twist: &Self::Motion) -> f64 {
        self.inertia.energy(twist)
    }

    fn stopped(&self, _twist: &Self::Motion) -> Self::Motion {
        Twist::STILL
    }

    fn reversed(&self, twist: &Self::Motion, share: f64) -> Option<Self::Motion> {
        Some(Twist { velocity: scale(twist.velocity, -share), spin: twist.spin.times(-share) })
    }

    fn heaviest(&self) -> f64 {
        self.inertia.heaviest()
    }
}
