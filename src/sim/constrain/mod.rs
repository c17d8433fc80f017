//! Bonds that are not forces: they move the ends of a bond until its length is right.
//!
//! All of it works on the displacements of the substep under way, x(t+h) - x(t), never on the new positions: a
//! difference of displacements is small and exact where a difference of positions far from the origin is neither.

pub(crate) mod direct;
pub(crate) mod order;
pub(crate) mod relaxed;
pub(crate) mod rigid;
pub(crate) mod shape;
pub(crate) mod xpbd;
