//! What is selected keeps clear of what stands there as it is moved, turned or scaled: by the law by which the world would put it out
//! afterwards, but all of it alike, and seen before. Other bodies stand there too, where bodies meet.

use glam::DVec3;

use super::Deed;
use super::chosen::Chosen;
use super::others::Others;
use super::pick::Scope;
use super::room::Walls;
use crate::history::Do;
use crate::scene::Vector;
use crate::sim::triangles::outer_sides;
use crate::sim::vector::truncate;
use crate::sim::{Bond, Bonds, PointId};

/// Of more points than the first those alone are looked at that lie on the rim of what they cover; of more than the second none is: looking at
/// those takes longer than a frame.
const MOST: [usize; 2] = [4_000, 16_000];
/// Ways that are shorter are not told of, and what lies no deeper stood clear `[logical px]`.
const LEAST: f64 = 1.0;
/// Bodies are put out together in so many rounds.
const ROUNDS: usize = 8;
/// Said of what is lifted, of what finds no room, and of what is too large to be looked at.
const LIFTED: &str = "moved aside: something was in the way";
const NO_ROOM: &str = "no room here: it overlaps what is in the way";
const TOO_LARGE: &str = "too many points to look for room: it may overlap something here";

/// How far something is put aside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Lift {
    /// `[m]`
    pub(super) way: DVec3,
    /// What is said of it.
    pub(super) said: Option<&'static str>,
}

/// How what is selected is put so that it keeps clear once `place` has led it elsewhere: nowhere where it lay in something before, or finds no
/// way out. Bodies are put, and obstacles that are selected with them go along; those alone stay.
pub(super) fn lift(scope: Scope<'_>, chosen: &Chosen, place: impl Fn(DVec3) -> DVec3) -> Lift {
    let scenery = &scope.shown.scenery;
    let points: Vec<PointId> = chosen.points.iter().copied().filter(|&point| scope.is_there(point)).collect();
    if points.is_empty() {
        return Lift::default();
    }
    let is_left = |of: &[u32], k: usize| of.get(k).is_none_or(|number| !chosen.obstacles.contains(number));
    let planes = scenery.planes.iter().enumerate().filter(|(k, _)| is_left(&scenery.plane_numbers, *k));
    let planes: Vec<_> = planes.map(|(_, plane)| *plane).collect();
    if scope.shown.dimensions == 2 {
        let polygons = scenery.polygons.iter().enumerate().filter(|(k, _)| is_left(&scenery.solid_numbers, *k));
        let polygons: Vec<_> = polygons.map(|(_, polygon)| polygon.clone()).collect();
        let still = match chosen.obstacles.is_empty() {
            true => scenery.walls().clone(),
            false => Walls::of(scenery.bounds, &planes, polygons.clone()),
        };
        let mut others = Others::of(scope, &points);
        let mut walls = still.clone();
        let count = points.len();
        let looked = outer(scope, points);
        let lift = lifted(scope, &looked, &still, &place, |places, is_before| {
            if is_before {
                others.leave_out(places, least(scope));
            } else if others.come_near(places) {
                let all = polygons.iter().cloned().chain(others.outlines()).collect();
                // Outlines that cross themselves too often are none.
                walls = Walls::of(scenery.bounds, &planes, all).or(&still);
            }
            walls.clone()
        });
        // What lies wholly within a rim touches nothing of it.
        let holds = looked.len() < count && others.lie_within(|x| place(x) + lift.way);
        return if holds { Lift { said: Some(NO_ROOM), ..Lift::default() } } else { lift };
    }
    let convex = scenery.convex.iter().enumerate().filter(|(k, _)| is_left(&scenery.solid_numbers, *k));
    let convex = convex.map(|(_, convex)| *convex).collect();
    let walls = Walls::<3>::all(scenery.bounds, &planes, (Vec::new(), convex));
    lifted(scope, &points, &walls, place, |_, _| walls.clone())
}

/// The points that are looked at of many: those on the rim of what they cover, and those that cover nothing.
fn outer(scope: Scope<'_>, points: Vec<PointId>) -> Vec<PointId> {
    if points.len() <= MOST[0] {
        return points;
    }
    let mut is_own = vec![false; scope.shown.point_count()];
    points.iter().for_each(|point| is_own[point.index()] = true);
    let own = scope.shown.scenery.triangles.iter().filter(|corners| corners.iter().all(|at| is_own[at.index()]));
    let own: Vec<[u32; 3]> = own.map(|corners| corners.map(|corner| corner.0)).collect();
    let mut is_looked_at = is_own;
    own.iter().flatten().for_each(|&corner| is_looked_at[corner as usize] = false);
    outer_sides(own).into_iter().flat_map(|side| side.ends).for_each(|end| is_looked_at[end as usize] = true);
    points.into_iter().filter(|point| is_looked_at[point.index()]).collect()
}

/// The same of some points, ascending, among what stands still, and what `around` says stands about places: where they were before, then where
/// they would be.
fn lifted<const D: usize>(
    scope: Scope<'_>,
    points: &[PointId],
    still: &Walls<D>,
    place: impl Fn(DVec3) -> DVec3,
    mut around: impl FnMut(&[[f64; D]], bool) -> Walls<D>,
) -> Lift {
    let places = |of: &dyn Fn(DVec3) -> DVec3| -> Vec<[f64; D]> {
        let here = |point: &PointId| DVec3::from(scope.shown.place(point.index()));
        points.iter().map(|point| truncate(of(here(point)).to_array())).collect()
    };
    let before = places(&|x| x);
    around(&before, true);
    if points.len() > MOST[1] {
        let there = places(&place);
        let touches = around(&there, false).may_touch(&there) && !still.may_touch(&before);
        return Lift { said: touches.then_some(TOO_LARGE), ..Lift::default() };
    }
    let number = |point: PointId| points.binary_search(&point).ok().map(|k| PointId(k as u32));
    let within = |ends: &[PointId; 2]| Some(Bond::new(number(ends[0])?, number(ends[1])?, 1.0));
    let bonds: Bonds = scope.shown.scenery.bonds.ends().iter().filter_map(within).collect();
    let was = still.clear(&before, &bonds, &[]);
    if !was.stuck.is_empty() || was.furthest() > least(scope) {
        return Lift::default();
    }
    let mut way = DVec3::ZERO;
    for _ in 0..ROUNDS {
        let there = places(&|x| place(x) + way);
        let cleared = around(&there, false).clear(&there, &bonds, &[]);
        let ways = cleared.moves.iter().map(|(_, way)| {
            let mut all = [0.0; 3];
            all[..D].copy_from_slice(way);
            DVec3::from(all)
        });
        match ways.max_by(|a, b| a.length().total_cmp(&b.length())) {
            _ if !cleared.stuck.is_empty() => break,
            None => return Lift { way, said: (way.length() > least(scope)).then_some(LIFTED) },
            Some(more) => way += more,
        }
    }
    Lift { said: Some(NO_ROOM), ..Lift::default() }
}

/// The shortest way that is told of `[m]`.
fn least(scope: Scope<'_>) -> f64 {
    LEAST * scope.scale / scope.camera.pixels_per_metre()
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
