//! How far bonds are from their rest lengths.

use crate::sim::Dynamics;

/// |length/rest - 1| over bonds and readings `[1]`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Strain {
    /// The largest; infinite where any is not a number.
    pub(super) largest: f64,
    squares: f64,
    count: u64,
}

impl Strain {
    /// Adds every bond of a world as it is now.
    pub(super) fn read(&mut self, world: &dyn Dynamics) {
        let positions = world.positions();
        let at = |point: usize| [positions.get(2 * point), positions.get(2 * point + 1)];
        let bonds = world.bonds();
        for (ends, rest) in bonds.ends().iter().zip(bonds.rest_lengths()) {
            let [p, q] = ends.map(|end| at(end.index()));
            let [dx, dy] = [p[0] - q[0], p[1] - q[1]];
            self.add(((dx * dx + dy * dy).sqrt() / rest - 1.0).abs());
        }
    }

    fn add(&mut self, strain: f64) {
        let strain = if strain.is_nan() { f64::INFINITY } else { strain };
        self.largest = self.largest.max(strain);
        self.squares += strain * strain;
        self.count += 1;
    }

    /// Root of the mean square.
    pub(super) fn rms(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bond, Model, PointId, build};

    #[test]
    fn the_largest_and_the_root_of_the_mean_square() {
        let mut strain = Strain::default();
        [0.3, 0.4].into_iter().for_each(|value| strain.add(value));
        assert_eq!(strain.largest, 0.4);
        assert!((strain.rms() - 0.125_f64.sqrt()).abs() < 1e-15);
        strain.add(f64::NAN);
        assert_eq!(strain.largest, f64::INFINITY);
    }

    #[test]
    fn a_bond_of_a_world_is_read() {
        let mut model = Model::<2> {
            position: vec![[0.0, 0.0], [0.0, -1.5]],
            velocity: vec![[0.0; 2]; 2],
            mass: vec![1.0; 2],
            ..Model::default()
        };
        let kind = crate::sim::BondKind::Spring { stiffness: 1.0, damping: 0.0 };
        model.bonds.push(Bond { kind, ..Bond::new(PointId(0), PointId(1), 1.0) });
        let mut strain = Strain::default();
        strain.read(&*build(&model).unwrap());
        assert!((strain.largest - 0.5).abs() < 1e-12);
    }
}
