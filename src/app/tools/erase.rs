//! The tool that takes away: bodies, bonds and obstacles, by a click or all along a stroke.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::Deed;
use super::marks::{self, Mark, Role};
use super::pick::Scope;
use super::segments::{cross, distance_to_segment};
use super::selecting::is_drag;
use crate::app::count::counted;
use crate::history::{DeleteKeys, Do};
use crate::picture::Tint;
use crate::sim::PointId;

/// What goes when a pixel is clicked.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    Body(Vec<PointId>),
    Bond(u32, [PointId; 2]),
    Obstacle(u32),
}

/// Of what is filled a bond is meant only where it is longer than this, and the pixel no further from it `[logical px]`: of what is smaller the
/// body is, whose bonds nobody sees.
const LONG: f64 = 48.0;
const ON_IT: f64 = 3.0;
/// Said where a bond of something filled goes.
const ONE_BOND: &str = "this bond alone; a click beside it takes the body";

/// A point is meant before a bond, what is filled before its bonds, and what lies on top before an obstacle.
pub(super) fn target(scope: Scope<'_>, at: DVec2) -> Option<Target> {
    match scope.nearest(at) {
        Some(hit) if hit.distance > 8.0 * scope.scale && is_bare(scope, hit.point) => {
            bond(scope, at).or_else(|| Some(Target::Body(scope.body(hit.point))))
        }
        Some(hit) => Some(Target::Body(scope.body(hit.point))),
        None => scope.obstacle(at).map(Target::Obstacle),
    }
}

/// The bond that lies at a pixel, if it is meant there.
fn bond(scope: Scope<'_>, at: DVec2) -> Option<Target> {
    let bond = scope.bond(at).filter(|(_, ends)| !is_filled(scope, *ends) || is_meant(scope, (*ends, at)));
    bond.map(|(place, ends)| Target::Bond(scope.shown.scenery.bond_number(place), ends))
}

/// Of a point with a skin about it the body is meant, wherever it is clicked.
fn is_bare(scope: Scope<'_>, point: PointId) -> bool {
    let has = |skin: &crate::picture::Skin| skin.triangles.iter().any(|corners| corners.contains(&point.0));
    !scope.shown.scenery.skins.iter().any(has)
}

/// Whether a point is a corner of something filled.
fn has_fill(scope: Scope<'_>, point: PointId) -> bool {
    !is_bare(scope, point) || scope.is_a_corner(point)
}

/// Whether two stretches cross, or come so near to each other.
fn touches([from, to]: [DVec2; 2], [a, b]: [DVec2; 2], near: f64) -> bool {
    let is_far = |low: DVec2, high: DVec2| (low - high).cmpgt(DVec2::splat(near)).any();
    if is_far(from.min(to), a.max(b)) || is_far(a.min(b), from.max(to)) {
        return false;
    }
    let is_near = |at: DVec2, from: DVec2, to: DVec2| distance_to_segment(at, from, to) <= near;
    let is_end_near = is_near(from, a, b) || is_near(to, a, b) || is_near(a, from, to) || is_near(b, from, to);
    is_end_near || cross([from, to], [a, b])
}

/// Whether both ends of a bond are of what is filled.
fn is_filled(scope: Scope<'_>, ends: [PointId; 2]) -> bool {
    ends.iter().all(|end| scope.is_a_corner(*end))
}

/// Whether a pixel means a bond of something filled.
fn is_meant(scope: Scope<'_>, (ends, at): ([PointId; 2], DVec2)) -> bool {
    let [Some(from), Some(to)] = ends.map(|end| scope.pixel(end)) else { return false };
    from.distance(to) > LONG * scope.scale && distance_to_segment(at, from, to) <= ON_IT * scope.scale
}

/// What goes, and what is said of it, before the click.
pub(super) fn marks(scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
    let Some(target) = target(scope, at) else { return Vec::new() };
    let is_one_of_many = matches!(target, Target::Bond(_, ends) if is_filled(scope, ends));
    let said = is_one_of_many.then(|| marks::beside(scope, at, ONE_BOND));
    would_go(scope, &target).into_iter().chain(said).collect()
}

fn would_go(scope: Scope<'_>, target: &Target) -> Vec<Mark> {
    match target {
        Target::Body(points) => marks::bonds(Role::Away, scope, points),
        Target::Bond(_, ends) => marks::line(Role::Away, scope, *ends).into_iter().collect(),
        Target::Obstacle(number) => marks::obstacle(Role::Away, scope, *number),
    }
}

/// Takes away what is meant by a pixel.
pub(super) fn erase(scope: Scope<'_>, at: DVec2) -> Deed {
    Sweep::begin(scope, at).deed(scope)
}

/// A stroke looks so often what is filled under it, and takes bonds and points alone that are so near `[logical px]`.
const STEP: f64 = 6.0;
const NEAR: f64 = 4.0;

/// What a stroke went over so far: all of it goes when the stroke ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Sweep {
    /// What a click means where it began, until it is a stroke; whether that is filled there, or a point alone.
    first: Option<Target>,
    is_whole: bool,
    is_stroke: bool,
    points: BTreeSet<PointId>,
    bonds: BTreeMap<u32, [PointId; 2]>,
    obstacles: BTreeSet<u32>,
    /// Where it is known to, where it began until it is a stroke `[px]`.
    last: DVec2,
}

impl Sweep {
    /// A stroke begins at a pixel, with what is meant there.
    pub(super) fn begin(scope: Scope<'_>, at: DVec2) -> Self {
        let first = target(scope, at);
        let hit = scope.nearest(at).map(|hit| hit.point);
        let is_whole = match &first {
            Some(Target::Body(points)) => points.len() == 1 || hit.is_some_and(|point| has_fill(scope, point)),
            _ => true,
        };
        Sweep { last: at, first, is_whole, ..Sweep::default() }
    }

    /// It goes on to a pixel: what is filled under it goes as a whole, of ropes and nets the bonds that it crosses or touches. Ground stays,
    /// unless the stroke began on it: a stroke along a floor means what lies there.
    pub(super) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        if !self.is_stroke {
            self.is_stroke = is_drag(scope, [self.last, at]);
            if !self.is_stroke {
                return;
            }
            self.first.take().filter(|_| self.is_whole).into_iter().for_each(|target| self.take(target));
        }
        let from = std::mem::replace(&mut self.last, at);
        self.take_bonds(scope, [from, at]);
        let steps = (from.distance(at) / (STEP * scope.scale)).ceil().max(1.0) as u32;
        (1..=steps).for_each(|k| self.take_filled(scope, from.lerp(at, f64::from(k) / f64::from(steps))));
    }

    /// What is filled at a pixel; else an obstacle, in front of which nothing lies.
    fn take_filled(&mut self, scope: Scope<'_>, at: DVec2) {
        if let Some([corner, ..]) = scope.triangle(at) {
            if !self.points.contains(&corner) {
                self.points.extend(scope.body(corner));
            }
        } else if let Some(number) = scope.block(at).filter(|_| scope.bond(at).is_none()) {
            self.obstacles.insert(number);
        }
    }

    /// Bonds of what is not filled, and points alone, along a piece of the stroke.
    fn take_bonds(&mut self, scope: Scope<'_>, stroke: [DVec2; 2]) {
        let scenery = &scope.shown.scenery;
        let (mut is_corner, mut is_bonded) = (vec![false; scope.shown.point_count()], Vec::new());
        scenery.triangles.iter().flatten().for_each(|corner| is_corner[corner.index()] = true);
        is_bonded.clone_from(&is_corner);
        for (place, &ends) in scenery.bonds.ends().iter().enumerate() {
            ends.iter().for_each(|end| is_bonded[end.index()] = true);
            let is_filled = ends.iter().all(|end| is_corner[end.index()]);
            if let ([Some(a), Some(b)], false) = (ends.map(|end| scope.pixel(end)), is_filled)
                && touches(stroke, [a, b], NEAR * scope.scale)
            {
                self.bonds.insert(scenery.bond_number(place), ends);
            }
        }
        let alone = (0..).map(PointId).zip(is_bonded).filter(|(_, is_bonded)| !is_bonded).map(|(point, _)| point);
        let is_near = |point: &PointId| {
            let at = scope.pixel(*point).filter(|_| scope.is_there(*point));
            at.is_some_and(|at| distance_to_segment(at, stroke[0], stroke[1]) <= 2.0 * NEAR * scope.scale)
        };
        self.points.extend(alone.filter(is_near));
    }

    fn take(&mut self, target: Target) {
        match target {
            Target::Body(points) => self.points.extend(points),
            Target::Bond(number, ends) => _ = self.bonds.insert(number, ends),
            Target::Obstacle(number) => _ = self.obstacles.insert(number),
        }
    }

    /// Bonds of bodies that stay.
    fn bonds(&self) -> impl Iterator<Item = (u32, [PointId; 2])> {
        let stays = |ends: &[PointId; 2]| !ends.iter().any(|end| self.points.contains(end));
        self.bonds.iter().map(|(number, ends)| (*number, *ends)).filter(move |(_, ends)| stays(ends))
    }

    /// What it went over goes, as far as it is there yet.
    pub(super) fn deed(mut self, scope: Scope<'_>) -> Deed {
        self.first.take().into_iter().for_each(|target| self.take(target));
        let is_there = |(number, ends): &(u32, [PointId; 2])| scope.shown.scenery.bond_ends(*number) == Some(*ends);
        let keys = DeleteKeys {
            points: self.points.iter().filter(|point| scope.is_there(**point)).map(|point| point.0).collect(),
            bonds: self.bonds().filter(is_there).map(|(number, _)| number).collect(),
            obstacles: self.obstacles.iter().copied().collect(),
            ..DeleteKeys::default()
        };
        let name = match [keys.points.is_empty(), keys.bonds.is_empty(), keys.obstacles.is_empty()] {
            [true, true, true] => return Deed::words("nothing lies here that could be taken away".to_owned()),
            [true, false, true] => "erase a bond",
            [true, true, false] => "erase an obstacle",
            _ => "erase",
        };
        let words = Some(erased(scope, &keys));
        Deed { words, ..Deed::edit(name, Do::Delete(keys)) }
    }

    /// What will go.
    pub(super) fn marks(&self, scope: Scope<'_>) -> Vec<Mark> {
        let first = self.first.clone().map_or_else(Vec::new, |target| would_go(scope, &target));
        let points: Vec<PointId> = self.points.iter().copied().filter(|&point| scope.is_there(point)).collect();
        let bodies = if points.is_empty() { Vec::new() } else { marks::body(Role::Away, scope, &points) };
        let bonds = self.bonds().filter_map(|(_, ends)| marks::line(Role::Away, scope, ends));
        let solids = self.obstacles.iter().flat_map(|&number| marks::obstacle(Role::Away, scope, number));
        first.into_iter().chain(bodies).chain(bonds).chain(solids).collect()
    }
}

/// What is said of what went: how much it was, and how it comes back. What bonds held together counts as one body, a loose point too.
fn erased(scope: Scope<'_>, keys: &DeleteKeys) -> String {
    let ends = scope.shown.scenery.bonds.ends().iter().map(|ends| ends.map(|end| end.0));
    let body = Tint::hanging(scope.shown.point_count(), ends);
    let bodies: BTreeSet<u32> = keys.points.iter().filter_map(|point| body.get(*point as usize).copied()).collect();
    let counts = [(bodies.len(), "body"), (keys.bonds.len(), "bond"), (keys.obstacles.len(), "obstacle")];
    let parts: Vec<String> =
        counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, name)| counted(count, name)).collect();
    let them = if counts.iter().map(|(count, _)| count).sum::<usize>() == 1 { "it" } else { "them" };
    let all = match &parts[..] {
        [but_last @ .., last] if !but_last.is_empty() => format!("{} and {last}", but_last.join(", ")),
        _ => parts.concat(),
    };
    format!("erased {all}: Ctrl+Z brings {them} back")
}

/// All bodies go; obstacles stay.
pub(in crate::app) fn clear(scope: Scope<'_>) -> Deed {
    let gone = &scope.shown.scenery.gone;
    let all = (0..scope.shown.point_count() as u32).map(PointId);
    let points: Vec<PointId> = all.filter(|point| gone.binary_search(point).is_err()).collect();
    if points.is_empty() {
        return Deed::words("there is no body here".to_owned());
    }
    let words = Some("all bodies are gone: Ctrl+Z brings them back".to_owned());
    Deed { edit: Some("clear"), words, ..delete_points(points) }
}

pub(super) fn delete_points(points: Vec<PointId>) -> Deed {
    let points = points.into_iter().map(|point| point.0).collect();
    Deed::edit("delete", Do::Delete(DeleteKeys { points, ..DeleteKeys::default() }))
}
