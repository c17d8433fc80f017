//! A loop of drawn points, filled with triangles by the mesher of pictures.

use std::collections::BTreeSet;

use glam::DVec2;

use super::chain::Node;
use super::corners::area;
use super::grain::Grain;
use crate::app::matter::Preset;
use crate::picture::{Boundary, Settings, fill_boundary};
use crate::scene::{AddKeys, BondKeys, MassKeys, Material, PointKeys, Row, SkinKeys, Vector};
use crate::sim::bond::lower_first;

/// A corner of the mesh is a corner of the loop when it is no further from it, in sides of triangles `[1]`.
const SAME: f64 = 1e-6;

/// What brings the body of a matter, so fine, within `corners` `[m]`, in a world where the next point gets the number `next`: those of its corners that are points
/// of the world stay these. `is_covered` says which of these are of a body that is filled already.
///
/// Errors: in words, that no triangles can be made.
pub(super) fn filled(
    (corners, nodes): (&[DVec2], &[Node]),
    (of, grain): (Preset, Grain),
    (next, is_covered): (u32, impl Fn(u32) -> bool),
) -> Result<AddKeys, String> {
    let size = area(corners);
    let settings = Settings::default();
    let (spacing, middle) = (size.abs().sqrt() / grain.of_loop(), corners[0]);
    let unit = settings.spacing() / spacing;
    let mut rim = rim(corners, spacing);
    if size < 0.0 {
        rim.reverse();
    }
    let rim = rim.into_iter().map(|at| (unit * (at - middle)).to_array()).collect();
    let boundary = Boundary { loops: vec![rim], ..Boundary::default() };
    let mesh = fill_boundary(&boundary, &settings).map_err(|error| format!("the loop is not filled: {error}"))?;
    let places: Vec<DVec2> = mesh.points.iter().map(|&at| middle + DVec2::from(at) / unit).collect();
    let mut position = Vec::new();
    let numbers: Vec<u32> = places
        .iter()
        .map(|place| {
            let corner = corners.iter().position(|corner| corner.distance(*place) <= SAME * spacing);
            if let Some(Node::World(point)) = corner.map(|corner| nodes[corner]) {
                return point.0;
            }
            position.push(Vector::Plane(place.to_array()));
            next + position.len() as u32 - 1
        })
        .collect();
    let Material { kind, stiffness, damping, mass, break_strain, friction, restitution, color, .. } =
        of.material(size.abs(), 1.0);
    let triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(|list| list.map(|k| numbers[k as usize])).collect();
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let sides: BTreeSet<[u32; 2]> = sides.map(lower_first).collect();
    let bond = |[a, b]: [u32; 2]| BondKeys { kind, stiffness, damping, break_strain, ..BondKeys::new(a, b) };
    // Corners that are points of other bodies stay as they are.
    let mut of_it: Vec<u32> = numbers.iter().copied().filter(|&number| number >= next || !is_covered(number)).collect();
    of_it.sort_unstable();
    let skin = SkinKeys { points: of_it, friction, restitution, color, ..SkinKeys::default() };
    let points = PointKeys {
        position,
        mass: mass.map(|mass| MassKeys::Same(mass / places.len().max(1) as f64)),
        velocity: None,
        pinned: Vec::new(),
    };
    Ok(AddKeys {
        points: Some(points).filter(|points| !points.position.is_empty()),
        bonds: sides.into_iter().map(bond).collect(),
        triangles: triangles.into_iter().map(Row).collect(),
        skins: Some(skin).filter(|skin| !skin.points.is_empty()).into_iter().collect(),
        ..AddKeys::default()
    })
}

/// The loop, its sides divided into pieces about as long as the spacing.
fn rim(corners: &[DVec2], spacing: f64) -> Vec<DVec2> {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let pieces = sides.flat_map(|(&from, &to)| {
        let count = (from.distance(to) / spacing).round().clamp(1.0, 1e3);
        (0..count as u32).map(move |k| from.lerp(to, f64::from(k) / count))
    });
    pieces.collect()
}
