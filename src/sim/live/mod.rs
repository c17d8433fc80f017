//! The live step: bodies that meet, moved with a bounded amount of work.

use crate::sim::bond::Bond;
use crate::sim::bulk::mover::Mover;
use crate::sim::contact::skin::Contact;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;

/// What live bodies are made of. Points are numbered as in their group.
#[allow(dead_code, reason = "what moves live bodies reads them")]
pub(crate) struct Draft {
    /// The bonds, rest lengths and stiffness included.
    pub(crate) bonds: Vec<Bond>,
    /// The body of every point: of pins that nothing is fastened to and of points without bonds one each.
    pub(crate) body_of: Vec<u32>,
    /// What bodies cover, anticlockwise where nothing is inside out.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// How they meet; `None`: they do not.
    pub(crate) contact: Option<Contact>,
}

/// The live bodies of a draft; `None` for a scalar or a dimension that there is not.
pub(crate) fn mover<S: Real, const D: usize>(
    _draft: Draft,
    _points: &Points<S, D>,
    _pull: &Pull<S, D>,
) -> Option<Box<dyn Mover<S, D>>> {
    None
}
