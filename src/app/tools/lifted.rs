//! What is selected keeps clear of what stands there as it is moved, turned or scaled: by the law by which the world would put it out
//! afterwards, but all of it alike, and seen before.

use glam::DVec3;

use super::Deed;
use super::chosen::Chosen;
use super::pick::Scope;
use super::room::Walls;
use crate::history::Do;
use crate::scene::Vector;
use crate::sim::vector::truncate;
use crate::sim::{Bond, Bonds, PointId};

/// Of more points none is looked at: the world puts them out by itself.
const MOST: usize = 4_000;
/// Ways that are shorter are not told of, and what lies no deeper stood clear `[logical px]`.
const LEAST: f64 = 1.0;
/// Bodies are put out together in so many rounds.
const ROUNDS: usize = 4;
/// Said of what is lifted.
const LIFTED: &str = "put clear of what it would lie in";

/// How far what is selected is put so that it keeps clear once `place` has led it elsewhere `[m]`: nowhere where it lay in something before, or finds no
/// way out.
pub(super) fn lift(scope: Scope<'_>, chosen: &Chosen, place: impl Fn(DVec3) -> DVec3) -> DVec3 {
    let count = chosen.points.len();
    if !chosen.obstacles.is_empty() || count == 0 || count > MOST {
        return DVec3::ZERO;
    }
    let scenery = &scope.shown.scenery;
    match scope.shown.dimensions {
        2 => lifted(scope, chosen, scenery.walls(), place),
        _ => {
            let convex = scenery.convex.clone();
            let walls = Walls::<3>::all(scenery.bounds, &scenery.planes, (Vec::new(), convex));
            lifted(scope, chosen, &walls, place)
        }
    }
}

fn lifted<const D: usize>(
    scope: Scope<'_>,
    chosen: &Chosen,
    walls: &Walls<D>,
    place: impl Fn(DVec3) -> DVec3,
) -> DVec3 {
    let points: Vec<PointId> = chosen.points.iter().copied().filter(|&point| scope.is_there(point)).collect();
    let number = |point: PointId| points.binary_search(&point).ok().map(|k| PointId(k as u32));
    let within = |ends: &[PointId; 2]| Some(Bond::new(number(ends[0])?, number(ends[1])?, 1.0));
    let bonds: Bonds = scope.shown.scenery.bonds.ends().iter().filter_map(within).collect();
    let places = |of: &dyn Fn(DVec3) -> DVec3| -> Vec<[f64; D]> {
        let here = |point: &PointId| DVec3::from(scope.shown.place(point.index()));
        points.iter().map(|point| truncate(of(here(point)).to_array())).collect()
    };
    let before = walls.clear(&places(&|x| x), &bonds, &[]);
    if !before.stuck.is_empty() || before.furthest() > least(scope) {
        return DVec3::ZERO;
    }
    let mut lift = DVec3::ZERO;
    for _ in 0..ROUNDS {
        let cleared = walls.clear(&places(&|x| place(x) + lift), &bonds, &[]);
        let ways = cleared.moves.iter().map(|(_, way)| {
            let mut all = [0.0; 3];
            all[..D].copy_from_slice(way);
            DVec3::from(all)
        });
        match ways.max_by(|a, b| a.length().total_cmp(&b.length())) {
            _ if !cleared.stuck.is_empty() => return DVec3::ZERO,
            None => return lift,
            Some(way) => lift += way,
        }
    }
    DVec3::ZERO
}

/// The shortest way that is told of `[m]`.
fn least(scope: Scope<'_>) -> f64 {
    LEAST * scope.scale / scope.camera.pixels_per_metre()
}

/// What is said of so much `[m]`.
pub(super) fn words(scope: Scope<'_>, lift: DVec3) -> Option<&'static str> {
    (lift.length() > least(scope)).then_some(LIFTED)
}

/// A command that moves something, which lifts it so far too `[m]`.
pub(super) fn with(scope: Scope<'_>, lift: DVec3, mut deed: Deed) -> Deed {
    for command in &mut deed.commands {
        if let Do::Move(keys) = command
            && lift != DVec3::ZERO
        {
            let by = DVec3::from(keys.by.map_or([0.0; 3], |by| by.embed())) + lift;
            keys.by = Some(Vector::new(by.to_array(), scope.shown.dimensions));
        }
    }
    deed
}
