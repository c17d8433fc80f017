//! The live step: bodies that meet, moved with a bounded amount of work.

use crate::sim::bond::Bond;
use crate::sim::contact::skin::Contact;

/// What live bodies are made of. Points are numbered as in their group.
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
