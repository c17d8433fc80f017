//! Room for what a tool puts somewhere: how far a body that comes is put out of obstacles, and which bodies an obstacle puts beside itself,
//! by the law that the world follows.

use glam::{DVec2, DVec3};

use super::enclosed::Cover;
use super::marks::{self, Mark, Role};
use super::pick::Scope;
use super::segments::is_inside;
use crate::app::player::Shown;
use crate::scene::{AddKeys, Vector};
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::contact::surface::Plane;
use crate::sim::measure;
use crate::sim::plan::{Cleared, clear};
use crate::sim::reach::reaches;
use crate::sim::vector::truncate;
use crate::sim::{Bond, Bonds, Bounds, Convex, Model, PointId, Polygon, blocked};

/// Said where an obstacle would take in a body as a whole.
const SWALLOWED: &str = "a body would be inside it: move the body first";
/// Said where a body finds no way out of obstacles, or of walls alone.
const NO_ROOM: [&str; 2] =
    ["no room here: it would be stuck in the obstacle", "no room here: it would be stuck in the wall"];
/// Said where it is put out of them.
const OUT: [&str; 2] = ["moved aside: an obstacle was in the way", "moved aside: a wall was in the way"];
/// Said of a body that is drawn around an obstacle.
const BESIDE: &str = "moved beside the obstacle: a body cannot be built around one";
/// Said of one that finds no place beside it.
const AROUND: &str = "no room here: an obstacle would be inside it";
/// Said of an obstacle that is put onto what pins hold.
const HELD: &str = "it overlaps something pinned: neither can move";
/// Said of an obstacle that is put between pins.
const TAUT: &str = "what hangs between two pins cannot go round it: leave it more room, or take a pin away first";
/// Said of a body with pins that is put into an obstacle, or into walls alone.
const STAYS: [&str; 2] = ["its pins hold it in the obstacle", "its pins hold it in the wall"];
/// Said of a body that is put over another one, while time runs and while it stands still.
const OVER: [&str; 2] = [
    "over another body: they part (pause with Space to hinge them)",
    "over another body: they part as time runs, unless they are hinged (8)",
];
/// Ways that are shorter are not told of `[logical px]`.
const LEAST: f64 = 1.0;

/// What becomes of what is put somewhere.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Outcome {
    /// How far what comes is put out of obstacles `[m]`.
    pub(super) way: DVec2,
    /// How far of that the world does not put it: the tool does.
    pub(super) own: DVec2,
    /// Bodies that an obstacle puts beside itself, and how far `[m]`.
    pub(super) moved: Vec<(Vec<PointId>, DVec2)>,
    /// Why it cannot be there.
    pub(super) refused: Option<&'static str>,
    /// What is to be said of it.
    pub(super) said: Option<&'static str>,
    /// The same where it lies over another body.
    pub(super) over: Option<&'static str>,
}

/// Obstacles without the world, in the plane or in space.
#[derive(Clone, Debug)]
pub(in crate::app) struct Walls<const D: usize = 2>(Option<Obstacles<f64, D>>);

impl Walls {
    /// Corners of the walls, a point and the normal of each plane, and the polygons.
    pub(in crate::app) fn of(bounds: Option<[[f64; 3]; 2]>, planes: &[[[f64; 3]; 2]], polygons: Vec<Polygon>) -> Self {
        Walls::all(bounds, planes, (polygons, Vec::new()))
    }
}

impl<const D: usize> Walls<D> {
    /// The same, with balls and boxes of space.
    pub(super) fn all(
        bounds: Option<[[f64; 3]; 2]>,
        planes: &[[[f64; 3]; 2]],
        (polygons, convex): (Vec<Polygon>, Vec<Convex>),
    ) -> Self {
        let bounds =
            bounds.map(|[min, max]| Bounds { min: truncate(min), max: truncate(max), restitution: 0.0, friction: 0.0 });
        let plane = |[point, normal]: &[[f64; 3]; 2]| Plane {
            point: truncate(*point),
            normal: truncate(*normal),
            restitution: 0.0,
            friction: 0.0,
            penalty: None,
        };
        let planes = planes.iter().map(plane).collect();
        let model = Model::<D> { bounds, planes, polygons, convex, ..Model::default() };
        Walls(Obstacles::of(&model).ok())
    }

    /// Others in their place where these cannot be.
    pub(super) fn or(self, others: &Self) -> Self {
        if self.0.is_some() { self } else { others.clone() }
    }

    /// Whether they are near to something of these places `[m]`.
    pub(super) fn may_touch(&self, places: &[[f64; D]]) -> bool {
        let around = measure::extent(places);
        self.0.as_ref().zip(around).is_some_and(|(obstacles, around)| obstacles.may_touch(around))
    }

    /// How what hangs together by these bonds gets out of them; pins stay.
    pub(super) fn clear(&self, places: &[[f64; D]], bonds: &Bonds, pinned: &[u32]) -> Cleared<D> {
        let Some(obstacles) = &self.0 else { return Cleared::default() };
        let mut w = vec![1.0; places.len()];
        pinned.iter().for_each(|&pin| w[pin as usize] = 0.0);
        clear(obstacles, bonds, (places, &w), |_| false)
    }
}

/// What becomes of what keys would bring.
pub(super) fn coming(scope: Scope<'_>, keys: &AddKeys) -> Outcome {
    let first = scope.shown.point_count() as u32;
    let Some(shape) = keys.shape(first) else { return Outcome::default() };
    if !shape.planes.is_empty() || !shape.polygons.is_empty() {
        return under(scope, (&shape.planes, shape.polygons), &[], |point| here(scope, point));
    }
    let bonds: Bonds = shape.bonds.iter().map(|&[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).collect();
    let cleared = scope.shown.scenery.walls().clear(&shape.places, &bonds, &shape.pinned);
    let least = LEAST * scope.scale / scope.camera.pixels_per_metre();
    let way = cleared.moves.first().map_or(DVec2::ZERO, |(_, way)| DVec2::from(*way));
    let is_stuck = !cleared.stuck.is_empty();
    let solids = &scope.shown.scenery.polygons;
    let by_solids = Walls::of(None, &[], solids.clone()).clear(&shape.places, &bonds, &shape.pinned);
    // What is in the way: an obstacle, or walls alone.
    let what = usize::from(by_solids.moves.is_empty() && by_solids.stuck.is_empty());
    let cover = Cover::of(&shape);
    if let Some(cover) = cover.as_ref().filter(|cover| !is_stuck && cover.has_any(solids, way)) {
        let is_free = |by: DVec2| {
            let places: Vec<[f64; 2]> = shape.places.iter().map(|&at| (DVec2::from(at) + by).to_array()).collect();
            let cleared = scope.shown.scenery.walls().clear(&places, &bonds, &shape.pinned);
            cleared.moves.is_empty() && cleared.stuck.is_empty()
        };
        return match cover.way_off(solids, (way, up(scope)), is_free) {
            Some(way) => Outcome { way, own: way, said: Some(BESIDE), ..Outcome::default() },
            None => Outcome { refused: Some(AROUND), ..Outcome::default() },
        };
    }
    let way = if way.length() > least { way } else { DVec2::ZERO };
    let refused = (is_stuck && shape.pinned.is_empty()).then_some(NO_ROOM[what]);
    let stays = (is_stuck && refused.is_none()).then_some(STAYS[what]);
    let is_over = |_: &&'static str| cover.as_ref().is_some_and(|cover| cover.lies_over(scope, way));
    let over = over(scope.shown).filter(is_over);
    let said = stays.or((way != DVec2::ZERO).then_some(OUT[what]));
    // What is whole and hangs on nothing is put there by the tool, so that the world has nothing to say of it.
    let is_whole = shape.pinned.is_empty() && keys.bonds.is_empty() && keys.points.is_none();
    let own = if is_whole { way } else { DVec2::ZERO };
    Outcome { way, own, refused, said, over, ..Outcome::default() }
}

/// What is said of a body that is put over another one; nothing where bodies pass through each other.
pub(in crate::app) fn over(shown: &Shown) -> Option<&'static str> {
    let meets = shown.settings.contact.flatten().is_some_and(|contact| contact.with_others);
    meets.then_some(OVER[usize::from(!shown.figures.playing)])
}

/// Against gravity; nowhere where nothing falls.
fn up(scope: Scope<'_>) -> DVec2 {
    let [x, y, _] = scope.shown.settings.gravity.unwrap_or_default();
    -DVec2::new(x, y).normalize_or_zero()
}

/// What becomes of the bodies under obstacles that come, or that are moved: those of these numbers. `place` says where a point is then.
pub(super) fn under(
    scope: Scope<'_>,
    (planes, polygons): (&[[[f64; 3]; 2]], Vec<Polygon>),
    numbers: &[u32],
    place: impl Fn(PointId) -> DVec2,
) -> Outcome {
    let scenery = &scope.shown.scenery;
    let places: Vec<[f64; 2]> = (0..scope.shown.point_count() as u32).map(|k| place(PointId(k)).to_array()).collect();
    let pinned: Vec<u32> = scenery.pinned.iter().map(|pin| pin.0).collect();
    let fresh = Walls::of(None, planes, polygons.clone());
    let hit = fresh.clear(&places, &scenery.bonds, &pinned);
    let is_in = |points: &[u32]| {
        let is_covered = |loops: &Vec<Vec<[f64; 2]>>| points.iter().all(|&i| is_inside(loops, places[i as usize]));
        polygons.iter().any(|polygon| is_covered(&polygon.loops))
    };
    let swallows = hit.moves.iter().any(|(points, _)| is_in(points));
    let refused = swallows.then_some(SWALLOWED).or_else(|| {
        let is_left = |k: usize| scenery.solid_numbers.get(k).is_none_or(|number| !numbers.contains(number));
        let rest = scenery.polygons.iter().enumerate().filter(|(k, _)| is_left(*k));
        let all: Vec<Polygon> = rest.map(|(_, polygon)| polygon.clone()).chain(polygons.iter().cloned()).collect();
        blocks(scope, &all, &places).then_some(TAUT)
    });
    // Of what pins hold as a whole the world says nothing: it has no point that could move.
    let free = fresh.clear(&places, &scenery.bonds, &[]);
    let is_held = |(points, _): &(Vec<u32>, [f64; 2])| points.iter().any(|point| pinned.binary_search(point).is_ok());
    let said = (!hit.stuck.is_empty() || free.moves.iter().any(is_held)).then_some(HELD);
    let moved = if refused.is_some() {
        // What cannot be there puts nothing aside.
        Cleared::default()
    } else if hit.moves.is_empty() {
        hit
    } else {
        let is_left = |of: &[u32], place: usize| of.get(place).is_none_or(|number| !numbers.contains(number));
        let rest = scenery.polygons.iter().enumerate().filter(|(k, _)| is_left(&scenery.solid_numbers, *k));
        let rest = rest.map(|(_, polygon)| polygon.clone()).chain(polygons).collect();
        let flat = scenery.planes.iter().enumerate().filter(|(k, _)| is_left(&scenery.plane_numbers, *k));
        let flat: Vec<_> = flat.map(|(_, plane)| *plane).chain(planes.iter().copied()).collect();
        let mut stays = vec![true; places.len()];
        hit.moves.iter().flat_map(|(points, _)| points).for_each(|&point| stays[point as usize] = false);
        let others: Vec<u32> = (0..places.len() as u32).filter(|&point| stays[point as usize]).collect();
        let out = Walls::of(scenery.bounds, &flat, rest).clear(&places, &scenery.bonds, &others);
        if out.moves.is_empty() { hit } else { out }
    };
    let of = |(points, way): (Vec<u32>, [f64; 2])| (points.into_iter().map(PointId).collect(), DVec2::from(way));
    Outcome { moved: moved.moves.into_iter().map(of).collect(), refused, said, ..Outcome::default() }
}

/// Whether rigid bonds between two pins would be too short to go round polygons, with all points at these places `[m]`.
fn blocks(scope: Scope<'_>, polygons: &[Polygon], places: &[[f64; 2]]) -> bool {
    let scenery = &scope.shown.scenery;
    if polygons.is_empty() || scenery.pinned.len() < 2 {
        return false;
    }
    // Between pins a bond neither stretches nor goes round anything.
    let is_free = |end: &PointId| !scope.is_pinned(*end);
    let bonds: Bonds = scenery.bonds.iter().filter(|bond| is_free(&bond.a) || is_free(&bond.b)).collect();
    let reaches = reaches(bonds.iter(), &scenery.pinned, &scenery.pinned);
    let place = |pin: PointId| [here(scope, pin).to_array(), places[pin.index()]];
    blocked(&reaches, place, [&scenery.polygons, polygons]).is_some()
}

/// Where a point is `[m]`; at the origin, where nothing hangs on it, if it is gone.
pub(super) fn here(scope: Scope<'_>, point: PointId) -> DVec2 {
    let at = DVec3::from(scope.shown.place(point.index())).truncate();
    if at.is_finite() { at } else { DVec2::ZERO }
}

impl Outcome {
    /// What comes is put as far as the world does not put it.
    pub(super) fn put(&self, keys: &mut AddKeys) {
        for origin in keys.bodies.iter_mut().filter(|_| self.own != DVec2::ZERO).map(|body| &mut body.origin) {
            let [x, y, _] = origin.map_or([0.0; 3], |at| at.embed());
            *origin = Some(Vector::Plane((DVec2::new(x, y) + self.own).to_array()));
        }
    }

    /// Lines of what comes, where it will be; red where it cannot.
    pub(super) fn lines(&self, scope: Scope<'_>, mark: Mark) -> Mark {
        let by = scope.camera.pixels_per_metre() * DVec2::new(self.way.x, -self.way.y);
        let mark = mark.mapped(|at| at + by);
        if self.refused.is_some() { mark.with(Role::Away) } else { mark }
    }

    /// The bodies that it moves, where they will be.
    pub(super) fn others(&self, scope: Scope<'_>) -> Vec<Mark> {
        let moved = self.moved.iter().flat_map(|(points, way)| {
            let by = scope.camera.pixels_per_metre() * DVec2::new(way.x, -way.y);
            marks::body(Role::Lead, scope, points).into_iter().map(move |mark| mark.mapped(|at| at + by))
        });
        moved.collect()
    }

    /// What is to be known of it once it is done: of bodies that the world puts aside it tells itself.
    pub(super) fn told(&self) -> Option<String> {
        let all: Vec<&str> = match self.refused {
            Some(why) => vec![why],
            None => self.said.into_iter().chain(self.over).collect(),
        };
        (!all.is_empty()).then(|| all.join("; "))
    }

    /// What is to be known of it before, beside its size.
    pub(super) fn words(&self) -> Option<String> {
        let aside = match self.moved.len() {
            0 => None,
            1 => Some("it pushes a body aside".to_owned()),
            many => Some(format!("it pushes {many} bodies aside")),
        };
        self.told().or(aside)
    }
}
