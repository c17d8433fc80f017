//! What is wrong with bodies: triangles inside out, skins that cross.

use wobble::sim::{Dynamics, PointId, Sample};

/// How many triangles are inside out, and how many pairs of edges of skins cross.
pub(crate) fn faults(world: &dyn Dynamics) -> [usize; 2] {
    let sample = world.sample(world.time());
    let inverted = super::areas(world, &sample).iter().filter(|area| **area <= 0.0).count();
    [inverted, crossings(&skin(world), &sample)]
}

/// The edges of skins: sides of one triangle alone, and bonds at points of none.
fn skin(world: &dyn Dynamics) -> Vec<[PointId; 2]> {
    let sorted = |a: PointId, b: PointId| [a.min(b), a.max(b)];
    let mut sides: Vec<[PointId; 2]> =
        world.triangles().iter().flat_map(|&[a, b, c]| [sorted(a, b), sorted(b, c), sorted(c, a)]).collect();
    sides.sort_unstable();
    let mut covered: Vec<PointId> = world.triangles().iter().flatten().copied().collect();
    covered.sort_unstable();
    covered.dedup();
    let mut edges: Vec<[PointId; 2]> =
        sides.chunk_by(|a, b| a == b).filter(|group| group.len() == 1).map(|group| group[0]).collect();
    let is_open = |ends: &[PointId; 2]| ends.iter().any(|end| covered.binary_search(end).is_err());
    edges.extend(world.bonds().iter().map(|bond| [bond.a, bond.b]).filter(is_open));
    edges
}

/// How many pairs of edges without a common end cross each other.
fn crossings(edges: &[[PointId; 2]], sample: &Sample) -> usize {
    let place = |point: PointId| sample.position[point.index()];
    let turn = |a: PointId, b: PointId, c: PointId| {
        let [a, b, c] = [a, b, c].map(place);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let cross = |&[a, b]: &[PointId; 2], &[c, d]: &[PointId; 2]| {
        ![c, d].contains(&a)
            && ![c, d].contains(&b)
            && turn(a, b, c) * turn(a, b, d) < 0.0
            && turn(c, d, a) * turn(c, d, b) < 0.0
    };
    edges.iter().enumerate().map(|(k, edge)| edges[..k].iter().filter(|other| cross(edge, other)).count()).sum()
}
