//! Where bodies meet something: a point of one on a surface, or two of them each other by a string that is taut.

use super::contact::Contact;
use super::inertia::Inertia;
use super::motion::Twist;
use crate::sim::contact::coulomb::{Impulse, Rub};

/// A contact of one body, or of two that push each other by as much.
#[derive(Clone, Debug)]
pub(super) struct Meeting {
    pub(super) rub: Rub,
    /// Each with the number of its body; the normal of the second is the opposite of that of the first.
    legs: Vec<(u32, Contact)>,
    /// How fast a led pin at its other end goes away across `[m/s]`.
    lead: f64,
    is_string: bool,
}

impl Meeting {
    /// A point of a body on a surface.
    pub(super) fn surface(body: u32, contact: Contact) -> Self {
        Meeting { rub: contact.rub, legs: vec![(body, contact)], lead: 0.0, is_string: false }
    }

    /// Ends of a string on bodies, with normals in which it pulls them; `lead`: how fast that of no body goes away `[m/s]`.
    pub(super) fn string(legs: Vec<(u32, Contact)>, lead: f64) -> Self {
        Meeting { rub: Rub::SMOOTH, legs, lead, is_string: true }
    }

    /// Whether it is a string: without friction, and one of several that may be taut at once.
    pub(super) fn is_string(&self) -> bool {
        self.is_string
    }

    /// How fast it opens and goes along by the motion of its bodies `[m/s]`.
    pub(super) fn rates(&self, twists: &[Twist]) -> [f64; 2] {
        let of = |(body, contact): &(u32, Contact)| contact.speeds(&twists[*body as usize]);
        self.legs.iter().map(of).fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]])
    }

    /// The same with what led pins do.
    pub(super) fn speeds(&self, twists: &[Twist]) -> [f64; 2] {
        let [across, along] = self.rates(twists);
        [across + self.lead, along]
    }

    /// Its bodies after an impulse, along the normal and across it.
    pub(super) fn push(&self, inertias: &[Inertia], twists: &mut [Twist], impulse: Impulse) {
        for (body, contact) in &self.legs {
            let twist = &mut twists[*body as usize];
            *twist = contact.pushed(&inertias[*body as usize], twist, impulse);
        }
    }

    /// Work of a led pin at its other end by an impulse along the normal `[J]`.
    pub(super) fn work_of_lead(&self, impulse: f64) -> f64 {
        -impulse * self.lead
    }

    /// The direction along the surface.
    pub(super) fn tangent(&self) -> [f64; 2] {
        self.legs.first().map_or([0.0; 2], |(_, contact)| contact.tangent())
    }
}
