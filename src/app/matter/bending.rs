//! Bending of a selection: E I of its chains and skins, and the angles that give it some.

use std::collections::{BTreeMap, BTreeSet};

use super::extent::place;
use super::facts::Span;
use super::{Among, AngleAs};
use crate::history::{Do, OneOrEach, SetKeys};
use crate::picture::Tint;
use crate::scene::{AddKeys, AngleKeys, Bend, MOST_BENT, Row, bends_along, share_of, stiffness_of};
use crate::sim::bond::lower_first;
use crate::sim::triangles::{Edges, skin};
use crate::sim::vector::truncate;
use crate::sim::{Angle, Bond, Dynamics, Limit, PointId, angle_at};

/// A point of no triangle with so many bonds to corners of triangles is the hub of a hinge: along these nothing bends, for what turns about
/// it is to turn on.
const SPOKES: usize = 3;

/// Why nothing bends.
const IN_SPACE: &str = "bending is of the plane, and this scene is in space";
const TOO_MANY: &str = "bending of so many bonds would be too slow: select less";
const NOTHING: &str = "nothing of it bends: that takes a chain of bonds, or a skin that is not rigid";
const NOT_YET: &str = "it has no bending that could be taken away";

/// E I of chains and skins among some points `[N m^2]`, by the stiffness of the angles that bend there; 0 where none does and some could.
/// `None`: nothing of it could.
pub(super) fn shown(world: &dyn Dynamics, among: &Among) -> Option<Span> {
    let list = among.angles_of(world, AngleAs::Bend);
    let of_one = |(angle, share): (&Angle, f64)| angle.stiffness / stiffness_of(1.0, share, angle.arms);
    let none_yet = coming(world, among, 1.0).is_ok().then_some(0.0);
    Span::of(list.iter().zip(shares(world, &list)).map(of_one).chain(none_yet)).map(Span::evened)
}

/// The commands by which chains and skins among some points resist bending by `bending` = E I `[N m^2]`, >= 0.
///
/// Model: that of the key `bending` of a material, [`bends_along`]. Angles that bend there already get as stiff, by the lengths of their
/// arms as they came; at 0 they stay, and resist nothing. Where none bends yet, angles come, of chains and of skins alike at rest in the
/// shape in which these stand now, and without damping, as those of a material.
///
/// Errors: in words, why nothing of it bends.
pub(super) fn bent(world: &dyn Dynamics, among: &Among, bending: f64) -> Result<Vec<Do>, &'static str> {
    let list = among.angles_of(world, AngleAs::Bend);
    let coming = match coming(world, among, bending) {
        Err(why) if list.is_empty() => return Err(why),
        coming => coming.unwrap_or_default(),
    };
    if list.is_empty() && bending == 0.0 {
        return Err(NOT_YET);
    }
    let add = || Do::Add(Box::new(AddKeys { angles: coming.iter().map(keys).collect(), ..AddKeys::default() }));
    let set = || {
        let angles = Some(list.iter().map(|angle| angle.number).collect());
        let each = list.iter().zip(shares(world, &list));
        let each = each.map(|(angle, share)| stiffness_of(bending, share, angle.arms)).collect();
        Do::Set(Box::new(SetKeys { angles, stiffness: Some(OneOrEach::Each(each)), ..SetKeys::default() }))
    };
    let add = (bending > 0.0 && !coming.is_empty()).then(add);
    Ok(add.into_iter().chain((!list.is_empty()).then(set)).collect())
}

/// An angle that comes, at rest where it stands.
fn keys(bend: &Bend) -> AngleKeys {
    let (points, stiffness) = (Row(bend.points), Some(bend.stiffness));
    AngleKeys { points, rest: None, stiffness, damping: None, min: None, max: None, drive: None }
}

/// The share of E I that each of some angles has, by how many of the world bend at its point `[1]`.
fn shares(world: &dyn Dynamics, angles: &[Angle]) -> Vec<f64> {
    let mut middles: Vec<PointId> = AngleAs::Bend.all(world).map(|angle| angle.points[1]).collect();
    middles.sort_unstable();
    let count = |middle: PointId| {
        let first = middles.partition_point(|other| *other < middle);
        middles[first..].iter().take_while(|other| **other == middle).count()
    };
    angles.iter().map(|angle| share_of(count(angle.points[1]))).collect()
}

/// The angles that come where chains and skins among some points get `bending` = E I `[N m^2]`; never none.
///
/// Model: bonds and triangles hold a body together, spokes of hinges do not; [`bends_along`] has its angles. Points get none where rigid
/// bonds hold all of them as they are, or where an angle is already, of a joint or a motor. Arms that lie on each other have none.
///
/// Errors: in words, why there are none.
fn coming(world: &dyn Dynamics, among: &Among, bending: f64) -> Result<Vec<Bend>, &'static str> {
    if world.dimensions() != 2 {
        return Err(IN_SPACE);
    }
    let bonds = among.bonds_of(world);
    if bonds.len() > MOST_BENT {
        return Err(TOO_MANY);
    }
    if bonds.len() < 2 {
        return Err(NOTHING);
    }
    let web = Web::of(world, among);
    let mut taken: Vec<u32> = world.angles().iter().map(|angle| angle.points[1].0).collect();
    taken.sort_unstable();
    let at = |point: u32| place(world, PointId(point));
    let is_open = |bend: &Bend| {
        let places = bend.points.map(|point| truncate::<2>(at(point)));
        angle_at(bend.points.map(PointId), places).rest > 0.0
    };
    let bodies = web.bodies(&bonds).into_values();
    let mut list: Vec<Bend> = bodies.flat_map(|edges| bends_along(edges, at, bending)).collect();
    let give_way = list.iter().filter(|bend| !web.holds(bend)).map(|bend| bend.points[1]);
    let give_way: BTreeSet<u32> = give_way.filter(|point| taken.binary_search(point).is_err()).collect();
    list.retain(|bend| give_way.contains(&bend.points[1]) && is_open(bend));
    if list.is_empty() { Err(NOTHING) } else { Ok(list) }
}

/// How some points of a world hang together.
struct Web {
    /// Those with a corner among the points.
    triangles: Vec<[u32; 3]>,
    /// Whether each point of the world is one of them.
    is_meant: Vec<bool>,
    /// Whether it is a corner of those triangles, and of one with a side that is not rigid.
    is_covered: Vec<bool>,
    is_soft: Vec<bool>,
    /// The ends of rigid bonds, the lower one first, ascending.
    rigid: Vec<[u32; 2]>,
}

impl Web {
    fn of(world: &dyn Dynamics, among: &Among) -> Self {
        let none = vec![false; world.point_count()];
        let mut is_meant = none.clone();
        among.points_of(world).into_iter().for_each(|point| is_meant[point.index()] = true);
        let triangles = world.triangles().iter().map(|corners| corners.map(|corner| corner.0));
        let is_near = |corners: &[u32; 3]| corners.iter().any(|&corner| is_meant[corner as usize]);
        let triangles: Vec<[u32; 3]> = triangles.filter(is_near).collect();
        let mut is_covered = none.clone();
        triangles.iter().flatten().for_each(|&corner| is_covered[corner as usize] = true);
        let is_near = |end: PointId| is_meant[end.index()] || is_covered[end.index()];
        let rigid = world.bonds().iter().filter(|bond| bond.is_held() && is_near(bond.a) && is_near(bond.b));
        let mut rigid: Vec<[u32; 2]> = rigid.map(|bond| lower_first([bond.a.0, bond.b.0])).collect();
        rigid.sort_unstable();
        let mut web = Web { triangles, is_meant, is_covered, is_soft: none, rigid };
        let soft: Vec<[u32; 3]> = web.triangles.iter().filter(|corners| !web.is_rigid(**corners)).copied().collect();
        soft.iter().flatten().for_each(|&corner| web.is_soft[corner as usize] = true);
        web
    }

    /// Whether rigid bonds lead along all three sides between some points.
    fn is_rigid(&self, [i, j, k]: [u32; 3]) -> bool {
        [[i, j], [j, k], [k, i]].into_iter().all(|ends| self.rigid.binary_search(&lower_first(ends)).is_ok())
    }

    /// Whether rigid bonds hold an angle as it is: between its own points, or all around it in the triangles of a skin.
    fn holds(&self, bend: &Bend) -> bool {
        let is_of_skin = bend.points.iter().all(|&point| self.is_covered[point as usize]);
        (is_of_skin && !self.is_soft[bend.points[1] as usize]) || self.is_rigid(bend.points)
    }

    /// The edges of skins and chains of each body that bonds among the points hold together, by the numbers of the bodies.
    fn bodies(&self, bonds: &[(u32, Bond)]) -> BTreeMap<u32, Edges> {
        let is_hub = self.hubs(bonds);
        let is_spoke = |bond: &Bond| {
            let ends = [bond.a, bond.b].map(PointId::index);
            ends.iter().any(|&end| is_hub[end]) && ends.iter().any(|&end| self.is_covered[end])
        };
        let links = bonds.iter().map(|(_, bond)| bond).filter(|bond| bond.limit != Limit::Min && !is_spoke(bond));
        let links: Vec<[u32; 2]> = links.map(|bond| [bond.a.0, bond.b.0]).collect();
        let sides = self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
        let number = Tint::hanging(self.is_meant.len(), links.iter().copied().chain(sides));
        let Edges { closed, open } = skin(&self.triangles, links.iter().copied());
        let is_meant = |ends: &[u32; 2]| ends.iter().all(|&end| self.is_meant[end as usize]);
        let mut bodies: BTreeMap<u32, Edges> = BTreeMap::new();
        for ends in closed.into_iter().filter(is_meant) {
            bodies.entry(number[ends[0] as usize]).or_default().closed.push(ends);
        }
        for ends in open.into_iter().filter(is_meant) {
            bodies.entry(number[ends[0] as usize]).or_default().open.push(ends);
        }
        bodies
    }

    /// Whether each point of the world is the hub of a hinge.
    fn hubs(&self, bonds: &[(u32, Bond)]) -> Vec<bool> {
        let mut spokes = vec![0_usize; self.is_covered.len()];
        for (_, bond) in bonds {
            for [from, to] in [[bond.a, bond.b], [bond.b, bond.a]].map(|ends| ends.map(PointId::index)) {
                spokes[from] += usize::from(!self.is_covered[from] && self.is_covered[to]);
            }
        }
        spokes.into_iter().map(|count| count >= SPOKES).collect()
    }
}
