//! What one calls what bonds hold together: by the names of the bodies that it is made of, or by their shapes.

use super::extent::areas;
use crate::app::count::counted;
use crate::picture::Tint;
use crate::sim::{Bond, BondKind, Dynamics, PointId};

/// Of more kinds of bodies than this the number is said, not each name.
const MOST_KINDS: usize = 3;

/// The name of some points with their bonds, all of which hang together, in a world whose bodies are called by `names`: a rope and the box
/// that hangs on it are both said.
pub(super) fn name_of(
    world: &dyn Dynamics,
    (points, bonds): (&[PointId], &[(u32, Bond)]),
    (tints, names): (&[Tint], &[Option<String>]),
) -> String {
    let one = |points: &[PointId], body: Option<u32>| {
        let known = body.and_then(|body| names.get(body as usize).cloned().flatten());
        known.unwrap_or_else(|| {
            let has = |point: PointId| points.binary_search(&point).is_ok();
            let within: Vec<&Bond> =
                bonds.iter().map(|(_, bond)| bond).filter(|bond| has(bond.a) && has(bond.b)).collect();
            shape(points, &within, areas(world, points).iter().map(|(_, area)| area).sum()).to_owned()
        })
    };
    let mut parts = bodies(points, tints);
    if parts.len() > 1 {
        // The hub of a hinge is a point by itself, and so are several: no bond joins them but through what turns about them.
        let is_known = |body: Option<u32>| body.is_some_and(|body| matches!(names.get(body as usize), Some(Some(_))));
        let has =
            |points: &[PointId], bond: &Bond| [bond.a, bond.b].iter().all(|end| points.binary_search(end).is_ok());
        parts.retain(|(body, points)| {
            points.len() > 1 && (is_known(*body) || bonds.iter().any(|(_, bond)| has(points, bond)))
        });
    }
    match &parts[..] {
        [] | [_] => one(points, parts.first().and_then(|(body, _)| *body)),
        several => joined(several.iter().map(|(body, points)| one(points, *body))),
    }
}

/// Points by the bodies that they are of, in the order in which these come first.
fn bodies(points: &[PointId], tints: &[Tint]) -> Vec<(Option<u32>, Vec<PointId>)> {
    let mut list: Vec<(Option<u32>, Vec<PointId>)> = Vec::new();
    for &point in points {
        let body = Tint::of(tints, point.0).map(|tint| tint.body);
        match list.iter_mut().find(|(own, _)| *own == body) {
            Some((_, points)) => points.push(point),
            None => list.push((body, vec![point])),
        }
    }
    list
}

/// Names, those that are the same counted.
fn joined(names: impl Iterator<Item = String>) -> String {
    let (mut kinds, mut all): (Vec<(String, usize)>, usize) = (Vec::new(), 0);
    for name in names {
        all += 1;
        match kinds.iter_mut().find(|(other, _)| *other == name) {
            Some((_, count)) => *count += 1,
            None => kinds.push((name, 1)),
        }
    }
    if kinds.len() > MOST_KINDS {
        return format!("{} in one", counted(all, "body"));
    }
    let said = |(name, count): (String, usize)| if count == 1 { name } else { counted(count, &name) };
    let said: Vec<String> = kinds.into_iter().map(said).collect();
    match said.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => said.concat(),
    }
}

/// What one calls a body of which nothing is known but what holds it together, and the area that it covers `[m^2]`.
fn shape(points: &[PointId], bonds: &[&Bond], area: f64) -> &'static str {
    let is_rigid = bonds.iter().all(|bond| matches!(bond.kind, BondKind::Rigid));
    let mut ends = vec![0_u32; points.len()];
    for place in bonds.iter().flat_map(|bond| [bond.a, bond.b]).filter_map(|end| points.binary_search(&end).ok()) {
        ends[place] += 1;
    }
    let is_chain = bonds.len() + 1 == points.len() && ends.iter().all(|&count| count <= 2);
    match () {
        () if points.len() == 1 => "point",
        () if area > 0.0 && is_rigid => "rigid body",
        () if area > 0.0 => "soft body",
        () if bonds.len() == 1 => "bond",
        () if is_chain => "rope",
        () => "net",
    }
}

#[cfg(test)]
mod tests {
    use super::joined;

    #[test]
    fn all_that_hangs_together_is_said_and_what_is_the_same_counted() {
        let of = |names: &[&str]| joined(names.iter().map(|name| (*name).to_owned()));
        assert_eq!(of(&["rope", "disc"]), "rope and disc");
        assert_eq!(of(&["rope", "disc", "rope"]), "2 ropes and disc");
        assert_eq!(of(&["rope", "rope"]), "2 ropes");
        assert_eq!(of(&["rope", "disc", "lattice"]), "rope, disc and lattice");
        assert_eq!(of(&["a", "b", "c", "d"]), "4 bodies in one");
    }
}
