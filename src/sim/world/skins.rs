//! What is told of skins that cannot be as they are asked for.

use super::World;
use crate::sim::bond::PointId;
use crate::sim::contact::skin::MOST_RADIUS;
use crate::sim::real::Real;
use crate::sim::sets::Sets;

impl<S: Real, const D: usize> World<S, D> {
    /// Which points bonds hold together, pins included.
    pub(super) fn bonded(&self) -> Sets {
        let mut bodies = Sets::new(self.count());
        self.bonds.ends().iter().for_each(|[a, b]| bodies.join(a.0, b.0));
        bodies
    }

    /// Tells of radii that are more than skins in the plane can have.
    pub(super) fn warn_of_radius(&mut self) {
        let Some(contact) = self.model.contact.filter(|_| D == 2) else { return };
        if contact.radius.is_none() && self.model.skins.widest().is_none() {
            return;
        }
        let mut bodies = self.bonded();
        // Of every body by its lowest point: its bonds, their lengths [m], its largest radius [m].
        let mut sums = vec![(0_u32, 0.0, 0.0_f64); self.count()];
        for bond in self.bonds.iter() {
            let (count, length, _) = &mut sums[bodies.find(bond.a.0) as usize];
            *count += 1;
            *length += bond.rest_length;
        }
        for point in 0..self.count() as u32 {
            let own = self.model.skins.of(PointId(point)).radius.or(contact.radius).unwrap_or_default();
            let radius = &mut sums[bodies.find(point) as usize].2;
            *radius = radius.max(own);
        }
        let is_thick = |&&(count, length, radius): &&(u32, f64, f64)| {
            count > 0 && length > 0.0 && radius > MOST_RADIUS * length / f64::from(count)
        };
        let thick = sums.iter().filter(is_thick).count();
        if thick > 0 {
            let bodies = if thick == 1 { "a body".to_owned() } else { format!("{thick} bodies") };
            self.warnings.push(format!(
                "the radius of the skin of {bodies} is more than half an edge: it is taken as half an edge"
            ));
        }
    }
}
