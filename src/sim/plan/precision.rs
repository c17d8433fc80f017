//! Which scalar a world is made of, where the scene leaves it open.

use super::choice::LARGE_STRAIN;
use crate::sim::bond::BondKind;
use crate::sim::model::Model;
use crate::sim::real::Precision;
use crate::sim::sets::Sets;
use crate::sim::sizes::{LARGE_RIGID_SINGLE, LARGE_SINGLE, MOST_DIRECT};

/// Positions of 32 bits are off by a part in 2^24 of their size; so many times that has to be below the strain that
/// bonds may have.
const ROOM: f64 = 8.0 / 16_777_216.0;

/// Whether a world of this model is made of `f32`.
///
/// Of fewer points where many rigid bonds hang together that are not one rigid body, for those are moved by vectors; bodies are not, and keep
/// their digits.
/// Not where the rounding of positions, over the rest length of the shortest rigid bond, comes near the strain asked for; nor where rigid bodies
/// may meet polygons, which are as roundly where they are as the world: what lies on their sides is told to a millionth of that.
pub(crate) fn is_single<const D: usize>(model: &Model<D>) -> bool {
    match model.method.precision {
        Precision::F32 => true,
        Precision::F64 => false,
        Precision::Auto => {
            let rigid = || model.bonds.iter().filter(|bond| bond.kind == BondKind::Rigid && bond.rest_length > 0.0);
            let count = model.position.len();
            if count <= LARGE_RIGID_SINGLE || (count <= LARGE_SINGLE && !has_large_mesh(model)) {
                return false;
            }
            if !model.polygons.is_empty() && !model.triangles.is_empty() && rigid().next().is_some() {
                return false;
            }
            let farthest = model.position.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let shortest = rigid().map(|bond| bond.rest_length).fold(f64::INFINITY, f64::min);
            farthest * ROOM <= model.method.max_strain.unwrap_or(LARGE_STRAIN) * shortest
        }
    }
}

/// Whether more than [`MOST_DIRECT`] rigid bonds hang together that leave the points which they hold more freedom than a rigid body of the
/// plane has.
fn has_large_mesh<const D: usize>(model: &Model<D>) -> bool {
    let rigid = || model.bonds.iter().filter(|bond| bond.kind == BondKind::Rigid);
    if rigid().nth(MOST_DIRECT).is_none() {
        return false;
    }
    let count = model.position.len();
    let mut sets = Sets::new(count);
    rigid().for_each(|bond| sets.join(bond.a.0, bond.b.0));
    // Of each set, by its lowest point: points, bonds, and those of them that make bodies.
    let mut counts = vec![[0_usize; 3]; count];
    (0..count as u32).for_each(|point| counts[sets.find(point) as usize][0] += 1);
    for bond in rigid() {
        let [_, bonds, holding] = &mut counts[sets.find(bond.a.0) as usize];
        *bonds += 1;
        *holding += usize::from(bond.holds());
    }
    let is_body = |points: usize, holding: usize| D == 2 && holding + 3 >= 2 * points;
    counts.into_iter().any(|[points, bonds, holding]| bonds > MOST_DIRECT && !is_body(points, holding))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bond::{Bond, PointId};
    use crate::sim::bonds::Bonds;
    use crate::sim::contact::polygon::Polygon;
    use crate::sim::model::Method;
    use crate::sim::solver::Solver;

    fn rope(count: u32, max_strain: f64) -> Model<2> {
        let bonds: Bonds = (1..count).map(|i| Bond::new(PointId(i - 1), PointId(i), 0.1)).collect();
        Model {
            position: (0..count).map(|i| [0.1 * f64::from(i), 0.0]).collect(),
            velocity: vec![[0.0; 2]; count as usize],
            mass: vec![1.0; count as usize],
            bonds,
            method: Method { solver: Solver::Auto, max_strain: Some(max_strain), ..Method::default() },
            ..Model::default()
        }
    }

    #[test]
    fn small_scenes_and_strains_that_32_bits_cannot_tell_are_of_64() {
        assert!(!is_single(&rope(900, 0.02)), "small");
        assert!(is_single(&rope(10_000, 0.02)), "large");
        assert!(!is_single(&rope(10_000, 1e-3)), "a kilometre of decimetres");
    }

    /// A strip of so many points in two rows, braced in each cell.
    fn strip(count: u32) -> Model<2> {
        let link = |i: u32, step: u32| Bond::new(PointId(i), PointId(i + step), 0.1);
        let bonds = (0..count - 2).flat_map(|i| [link(i, 1), link(i, 2)]).chain([link(count - 2, 1)]);
        Model { bonds: bonds.collect(), ..rope(count, 0.02) }
    }

    #[test]
    fn rigid_bodies_are_of_64_and_nets_as_large_of_32() {
        assert!(!is_single(&strip(3_000)), "5,997 bonds as one body");
        let mut hinged = strip(3_000);
        hinged.bonds = hinged.bonds.iter().filter(|bond| bond.a.0 != 1_500).collect();
        assert!(is_single(&hinged), "two bodies");
        let mut torn = strip(3_000);
        torn.bonds = torn.bonds.iter().map(|bond| Bond { break_strain: 0.1, ..bond }).collect();
        assert!(is_single(&torn), "what may tear is no body");
        let ropes: Bonds =
            (1..3_000).filter(|i| i % 100 != 0).map(|i| Bond::new(PointId(i - 1), PointId(i), 0.1)).collect();
        assert!(!is_single(&Model { bonds: ropes, ..rope(3_000, 0.02) }), "many ropes, each short");
    }

    #[test]
    fn rigid_bodies_among_polygons_are_of_64() {
        let wedge =
            Polygon { loops: vec![vec![[0.0, -9.0], [1.0, -9.0], [1.0, -8.0]]], restitution: 0.0, friction: 0.0 };
        let among = Model { polygons: vec![wedge], ..rope(10_000, 0.02) };
        assert!(is_single(&among), "a rope is no body");
        assert!(!is_single(&Model { triangles: vec![[PointId(0), PointId(1), PointId(2)]], ..among }));
    }
}
