//! The tool that takes away: bodies, bonds and obstacles, by a click or all along a stroke.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::Deed;
use super::marks::{self, Mark, Role};
use super::pick::{Scope, distance_to_segment};
use super::selecting::is_drag;
use crate::history::{DeleteKeys, Do};
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

/// What a stroke takes at a pixel: of ropes and nets bonds alone, or it would take all of a net at the first of its points.
fn along(scope: Scope<'_>, at: DVec2) -> Option<Target> {
    match target(scope, at) {
        Some(Target::Body(points)) if points.len() > 1 && is_net(scope, &points) => bond(scope, at),
        other => other,
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

/// Whether points, which are ascending, are corners of nothing that is filled.
fn is_net(scope: Scope<'_>, points: &[PointId]) -> bool {
    let is_its = |corner: &PointId| points.binary_search(corner).is_ok();
    is_bare(scope, points[0]) && !scope.shown.scenery.triangles.iter().flatten().any(is_its)
}

/// Whether both ends of a bond are of what is filled.
fn is_filled(scope: Scope<'_>, ends: [PointId; 2]) -> bool {
    let is_corner = |end: &PointId| scope.shown.scenery.triangles.iter().any(|corners| corners.contains(end));
    ends.iter().all(is_corner)
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

/// A stroke looks so often what is under it `[logical px]`.
const STEP: f64 = 6.0;

/// What a stroke went over so far: all of it goes when the stroke ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Sweep {
    /// Where it began `[px]`, and what a click means there, until it is a stroke.
    from: DVec2,
    first: Option<Target>,
    is_stroke: bool,
    points: BTreeSet<PointId>,
    bonds: BTreeMap<u32, [PointId; 2]>,
    obstacles: BTreeSet<u32>,
    /// `[px]`
    last: DVec2,
}

impl Sweep {
    /// A stroke begins at a pixel, with what is meant there.
    pub(super) fn begin(scope: Scope<'_>, at: DVec2) -> Self {
        Sweep { from: at, last: at, first: target(scope, at), ..Sweep::default() }
    }

    /// It goes on to a pixel. Ground stays, unless the stroke began on it: a stroke along a floor means what lies there.
    pub(super) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        if !self.is_stroke {
            self.is_stroke = is_drag(scope, [self.from, at]);
            if !self.is_stroke {
                return;
            }
            let first = match self.first.take() {
                Some(Target::Body(_)) => along(scope, self.from),
                other => other,
            };
            first.into_iter().for_each(|target| self.take(target));
        }
        let steps = (self.last.distance(at) / (STEP * scope.scale)).ceil().max(1.0) as u32;
        let from = std::mem::replace(&mut self.last, at);
        for k in 1..=steps {
            let at = from.lerp(at, f64::from(k) / f64::from(steps));
            if scope.nearest(at).is_some_and(|hit| self.points.contains(&hit.point)) {
                continue;
            }
            match along(scope, at) {
                Some(Target::Obstacle(number)) if scope.block(at) != Some(number) => {}
                Some(target) => self.take(target),
                None => {}
            }
        }
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
            [true, false, true] => "delete a bond",
            [true, true, false] => "delete an obstacle",
            _ => "delete",
        };
        Deed::edit(name, Do::Delete(keys))
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
