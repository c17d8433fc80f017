//! What of a scene has an inside: its triangles, and the outlines around them.

use std::collections::{BTreeMap, BTreeSet};

use super::sides::crossings;
use crate::scene::{BondList, MakerName, Scene, SceneError};
use crate::sim::Bonds;
use crate::sim::triangles::outer_sides;

/// The triangles of a scene in the plane, and their outlines.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    /// Corners, anticlockwise at the start.
    triangles: Vec<[u32; 3]>,
    /// Sides that belong to one triangle alone.
    outline: Vec<[u32; 2]>,
    /// Sides that are bonds, lower end first.
    bonded: BTreeSet<[u32; 2]>,
}

impl Shape {
    /// Of a scene whose bodies are made: triangles that it lists, and those that the bonds of meshed bodies make.
    ///
    /// Errors: those of [`Scene::expanded`].
    pub(super) fn of(scene: &Scene) -> Result<Shape, SceneError> {
        if scene.dimensions() != 2 {
            return Ok(Shape::default());
        }
        // Those that bodies cover are told by their bonds.
        let whole = Scene { contact: None, parameters: Vec::new(), ..scene.clone() }.expanded()?;
        let position: Vec<[f64; 2]> = whole.points.iter().flat_map(|points| &points.position).map(plane).collect();
        let mut triangles: Vec<[u32; 3]> = whole.triangles.iter().map(|row| row.0).collect();
        let mut first = scene.points.as_ref().map_or(0, |points| points.position.len() as u32);
        for body in &scene.bodies {
            let alone = Scene { bodies: vec![body.clone()], ..bare(scene) }.expanded()?;
            if matches!(body.make, MakerName::Lattice | MakerName::Disc | MakerName::Rim) {
                triangles.extend(of_bonds(&alone.bonds).map(|corners| corners.map(|corner| corner + first)));
            }
            first += alone.points.as_ref().map_or(0, |points| points.position.len() as u32);
        }
        triangles.retain_mut(|corners| turn(corners, &position));
        let sides = triangles.iter().flat_map(|&corners| sides(corners)).collect::<BTreeSet<_>>();
        let ends = whole.bonds.iter().map(|bond| ascending([bond.a, bond.b]));
        let bonded = ends.filter(|ends| sides.contains(ends)).collect();
        Ok(Shape { outline: outline(&triangles), triangles, bonded })
    }

    /// What is left of it where these bonds are: a triangle that has lost one is none any more.
    pub(super) fn left(&self, bonds: &Bonds) -> Shape {
        let now: BTreeSet<[u32; 2]> = bonds.ends().iter().map(|ends| ascending(ends.map(|end| end.0))).collect();
        let is_whole = |side: [u32; 2]| !self.bonded.contains(&side) || now.contains(&side);
        let triangles = self.triangles.iter().copied();
        let triangles: Vec<[u32; 3]> = triangles.filter(|&corners| sides(corners).into_iter().all(is_whole)).collect();
        Shape { outline: outline(&triangles), triangles, bonded: now }
    }

    /// Whether there is nothing to look at.
    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The share of triangles that are inside out `[1]`; those with a corner that is gone count as none.
    pub(super) fn inverted(&self, position: &[[f64; 3]]) -> f64 {
        let areas = self.triangles.iter().map(|&corners| area(corners, position)).filter(|area| !area.is_nan());
        let (count, inverted) =
            areas.fold((0, 0), |(count, inverted), area| (count + 1, inverted + u32::from(area < 0.0)));
        if count == 0 { 0.0 } else { f64::from(inverted) / f64::from(count) }
    }

    /// How many pairs of sides of outlines cross.
    pub(super) fn crossings(&self, position: &[[f64; 3]]) -> u32 {
        let mut count = 0;
        crossings(&self.outline, position, |_, _| count += 1);
        count
    }
}

fn plane(vector: &crate::scene::Vector) -> [f64; 2] {
    let [x, y, _] = vector.embed();
    [x, y]
}

/// A scene without points, bonds and bodies.
fn bare(scene: &Scene) -> Scene {
    let (points, bonds) = (None, BondList::new());
    let lists = Scene { points, bonds, bodies: Vec::new(), triangles: Vec::new(), ..scene.clone() };
    Scene { pin_motion: Vec::new(), texture: None, areas: None, parameters: Vec::new(), skins: Vec::new(), ..lists }
}

/// Triples of points that are bonded pairwise.
fn of_bonds(bonds: &BondList) -> impl Iterator<Item = [u32; 3]> {
    let mut above: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for bond in bonds.iter() {
        above.entry(bond.a.min(bond.b)).or_default().push(bond.a.max(bond.b));
    }
    for list in above.values_mut() {
        list.sort_unstable();
        list.dedup();
    }
    let mut found = Vec::new();
    for (&a, list) in &above {
        for (i, &b) in list.iter().enumerate() {
            let of_b = above.get(&b).map_or(&[][..], |list| list);
            found.extend(list[i + 1..].iter().filter(|c| of_b.contains(c)).map(|&c| [a, b, c]));
        }
    }
    found.into_iter()
}

/// Turns a triangle anticlockwise; false where it has no area to speak of.
fn turn(corners: &mut [u32; 3], position: &[[f64; 2]]) -> bool {
    let [a, b, c] = corners.map(|corner| position[corner as usize]);
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let area = u[0] * v[1] - u[1] * v[0];
    if area < 0.0 {
        corners.swap(1, 2);
    }
    area.abs() > 1e-6 * (u[0] * u[0] + u[1] * u[1] + v[0] * v[0] + v[1] * v[1])
}

/// Twice the area `[m^2]`, positive anticlockwise.
fn area(corners: [u32; 3], position: &[[f64; 3]]) -> f64 {
    let [a, b, c] = corners.map(|corner| position[corner as usize]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn ascending([p, q]: [u32; 2]) -> [u32; 2] {
    [p.min(q), p.max(q)]
}

fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(ascending)
}

fn outline(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    outer_sides(triangles.iter().copied()).into_iter().map(|side| side.ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bond, PointId};

    fn lattice() -> Shape {
        let text = r#"{"wobble": 1, "bodies": [{"make": "lattice", "columns": 3, "rows": 2, "spacing": 1,
            "origin": [5, 5], "material": {"kind": "spring", "stiffness": 1}}]}"#;
        Shape::of(&Scene::parse(text, "test").unwrap()).unwrap()
    }

    #[test]
    fn a_lattice_has_four_triangles_a_cell_and_no_outline_of_its_own() {
        let shape = lattice();
        assert_eq!(shape.triangles.len(), 8);
    }

    #[test]
    fn scenes_of_the_gallery_have_shapes_whatever_sliders_they_name() {
        for entry in crate::scene::gallery().iter().filter(|entry| entry.name != "million-cloth") {
            Shape::of(&entry.scene().unwrap()).unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        }
    }

    #[test]
    fn what_is_mirrored_is_inside_out() {
        let shape = lattice();
        let at = |sign: f64| (0..6).map(|i| [sign * f64::from(i % 3), f64::from(i / 3), 0.0]).collect::<Vec<_>>();
        assert_eq!((shape.inverted(&at(1.0)), shape.inverted(&at(-1.0))), (0.0, 1.0));
        let mut gone = at(1.0);
        gone[1] = [f64::NAN; 3];
        assert_eq!(shape.inverted(&gone), 0.0);
    }

    #[test]
    fn a_triangle_that_has_lost_a_bond_is_none() {
        let shape = lattice();
        let bond = |[a, b]: [u32; 2]| Bond::new(PointId(a), PointId(b), 1.0);
        let all: Bonds = shape.bonded.iter().map(|&ends| bond(ends)).collect();
        assert_eq!((all.len(), shape.left(&all).triangles.len()), (11, 8));
        // A side of the first cell: two of its four triangles have it.
        let cut: Bonds = shape.bonded.iter().filter(|ends| **ends != [0, 1]).map(|&ends| bond(ends)).collect();
        assert_eq!(shape.left(&cut).triangles.len(), 6);
        assert!(!shape.left(&cut).outline.contains(&[0, 1]));
    }

    #[test]
    fn sides_that_cross_are_counted_once() {
        let shape = Shape { outline: vec![[0, 1], [2, 3], [1, 2]], ..Shape::default() };
        let crossed = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
        assert_eq!(shape.crossings(&crossed), 1);
        let apart = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(shape.crossings(&apart), 0);
    }
}
