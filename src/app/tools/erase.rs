//! The tool that takes away: bodies, bonds and obstacles, by a click or all along a stroke.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use super::Deed;
use super::marks::{self, Mark, Role};
use super::pick::{Scope, distance_to_segment};
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
    // Of a point with a skin about it the body is meant, wherever it is clicked.
    let hit = scope.nearest(at);
    let is_bare = |point: PointId| {
        let has = |skin: &crate::picture::Skin| skin.triangles.iter().any(|corners| corners.contains(&point.0));
        !scope.shown.scenery.skins.iter().any(has)
    };
    match hit {
        Some(hit) if hit.distance > 8.0 * scope.scale && is_bare(hit.point) => {
            let bond = scope.bond(at).filter(|(_, ends)| !is_filled(scope, *ends) || is_meant(scope, (*ends, at)));
            let bond = bond.map(|(place, ends)| Target::Bond(scope.shown.scenery.bond_number(place), ends));
            bond.or_else(|| Some(Target::Body(scope.body(hit.point))))
        }
        Some(hit) => Some(Target::Body(scope.body(hit.point))),
        None => scope.obstacle(at).map(Target::Obstacle),
    }
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

/// What is said of what goes, before the click.
pub(super) fn words(scope: Scope<'_>, target: &Target) -> Option<&'static str> {
    matches!(target, Target::Bond(_, ends) if is_filled(scope, *ends)).then_some(ONE_BOND)
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
    points: BTreeSet<PointId>,
    bonds: BTreeMap<u32, [PointId; 2]>,
    obstacles: BTreeSet<u32>,
    /// `[px]`
    last: DVec2,
}

impl Sweep {
    /// A stroke begins at a pixel, with what is meant there.
    pub(super) fn begin(scope: Scope<'_>, at: DVec2) -> Self {
        let mut sweep = Sweep { last: at, ..Sweep::default() };
        if let Some(target) = target(scope, at) {
            sweep.take(target);
        }
        sweep
    }

    /// It goes on to a pixel. Ground stays, unless the stroke began on it: a stroke along a floor means what lies there.
    pub(super) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        let steps = (self.last.distance(at) / (STEP * scope.scale)).ceil().max(1.0) as u32;
        let from = std::mem::replace(&mut self.last, at);
        for k in 1..=steps {
            let at = from.lerp(at, f64::from(k) / f64::from(steps));
            if scope.nearest(at).is_some_and(|hit| self.points.contains(&hit.point)) {
                continue;
            }
            match target(scope, at) {
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
    pub(super) fn deed(&self, scope: Scope<'_>) -> Deed {
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
        let points: Vec<PointId> = self.points.iter().copied().filter(|&point| scope.is_there(point)).collect();
        let bodies = if points.is_empty() { Vec::new() } else { marks::body(Role::Away, scope, &points) };
        let bonds = self.bonds().filter_map(|(_, ends)| marks::line(Role::Away, scope, ends));
        let solids = self.obstacles.iter().flat_map(|&number| marks::obstacle(Role::Away, scope, number));
        bodies.into_iter().chain(bonds).chain(solids).collect()
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
