//! Where a copy has room in space: as near as may be to where it is wished, and in view, beside bodies, balls, boxes and walls.

use std::collections::BTreeSet;

use glam::DVec3;

use super::room::{IN_ANOTHER, Place};
use super::{Clip, Wish};
use crate::sim::{Dynamics, Figure, PointId};

/// A copy is tried so many times as far as it is large, to each side.
const STEPS: i32 = 8;
/// What is kept free about a copy, as a share of its longest side.
const APART: f64 = 0.05;
/// Sheets and bonds are looked at in places so far apart, at least, as a share of all that there is.
const FINEST: f64 = 1.0 / 300.0;
/// Places along each side of a ball or a box.
const SIDE: usize = 8;

/// A cell of space.
type Cell = [i64; 3];

/// What lies somewhere: places on bodies, and balls and boxes.
#[derive(Default)]
struct Things {
    places: Vec<DVec3>,
    figures: Vec<Figure>,
}

impl Things {
    /// Of points, bonds and triangles, in places no further apart than `fine` `[m]`.
    fn of(
        points: &[DVec3],
        bonds: impl Iterator<Item = [u32; 2]>,
        triangles: impl Iterator<Item = [u32; 3]>,
        fine: f64,
    ) -> Self {
        let at = |point: u32| points.get(point as usize).copied().unwrap_or(DVec3::NAN);
        let mut places = points.to_vec();
        let count = |far: f64| if far.is_finite() { (far / fine).ceil().max(1.0) as usize } else { 0 };
        for [a, b] in bonds.map(|ends| ends.map(at)) {
            let parts = count(a.distance(b));
            places.extend((1..parts).map(|k| a.lerp(b, k as f64 / parts as f64)));
        }
        for [a, b, c] in triangles.map(|corners| corners.map(at)) {
            let parts = count(a.distance(b).max(a.distance(c)).max(b.distance(c)));
            let share = |k: usize| k as f64 / parts as f64;
            let inner = (1..parts).flat_map(|i| (1..parts - i).map(move |j| (i, j)));
            places.extend(inner.map(|(i, j)| a + share(i) * (b - a) + share(j) * (c - a)));
        }
        places.retain(|place| place.is_finite());
        Things { places, figures: Vec::new() }
    }

    fn of_world(world: &dyn Dynamics, fine: f64) -> Self {
        let x = world.positions();
        let is_there = |point: usize| world.gone().binary_search(&PointId(point as u32)).is_err();
        let at = |point: usize| DVec3::from([0, 1, 2].map(|axis| x.get(3 * point + axis)));
        let points: Vec<DVec3> =
            (0..world.point_count()).map(|point| if is_there(point) { at(point) } else { DVec3::NAN }).collect();
        let bonds = world.bonds().ends().iter().map(|ends| ends.map(|end| end.0));
        let triangles = world.triangles().iter().map(|corners| corners.map(|corner| corner.0));
        let figures = world.convex().iter().map(|convex| convex.figure).collect();
        Things { figures, ..Things::of(&points, bonds, triangles, fine) }
    }

    /// The box around it.
    fn around(&self) -> Option<[DVec3; 2]> {
        let ends = self.figures.iter().flat_map(Figure::extent).map(DVec3::from);
        self.places.iter().copied().chain(ends).fold(None, |around: Option<[DVec3; 2]>, at| {
            Some(around.map_or([at; 2], |[low, high]| [low.min(at), high.max(at)]))
        })
    }
}

/// Places all over a figure.
fn inside(figure: &Figure) -> Vec<DVec3> {
    let [low, high] = figure.extent().map(DVec3::from);
    let share = |k: usize| k as f64 / (SIDE - 1) as f64;
    let all = (0..SIDE).flat_map(|i| (0..SIDE).flat_map(move |j| (0..SIDE).map(move |k| [i, j, k])));
    all.map(|of| low + DVec3::from(of.map(share)) * (high - low))
        .filter(|&at| figure.holds(at.to_array(), 0.0))
        .collect()
}

/// A world, as a copy is put into it.
struct Around {
    things: Things,
    cells: BTreeSet<Cell>,
    side: f64,
    bounds: Option<[DVec3; 2]>,
    planes: Vec<[DVec3; 2]>,
}

impl Around {
    fn cell(&self, place: DVec3) -> Cell {
        (place / self.side).floor().to_array().map(|k| k as i64)
    }

    /// Whether nothing lies within a cell of a place.
    fn is_clear(&self, place: DVec3) -> bool {
        let [x, y, z] = self.cell(place);
        // A row of three cells along z is one look.
        let row = |x: i64, y: i64| self.cells.range([x, y, z - 1]..=[x, y, z + 1]).next().is_none();
        (x - 1..=x + 1).all(|x| (y - 1..=y + 1).all(|y| row(x, y)))
    }

    /// Whether a copy has room that is `by` `[m]` further, whose box is `around`, and whose figures have `solid` places.
    fn has_room(&self, copy: &Things, [low, high]: [DVec3; 2], solid: &[DVec3], by: DVec3) -> bool {
        let [low, high] = [low + by, high + by];
        let is_in = self.bounds.is_none_or(|[least, most]| low.cmpge(least).all() && high.cmple(most).all());
        let corner = |normal: DVec3| DVec3::select(normal.cmplt(DVec3::ZERO), high, low);
        let is_before = self.planes.iter().all(|[point, normal]| (corner(*normal) - *point).dot(*normal) >= 0.0);
        if !is_in || !is_before {
            return false;
        }
        let apart = self.side;
        let off_solids = |place: DVec3| !self.things.figures.iter().any(|figure| figure.holds(place.to_array(), apart));
        let in_reach = |place: DVec3| place.cmpge(low - apart).all() && place.cmple(high + apart).all();
        let off_copy = |place: DVec3| !copy.figures.iter().any(|figure| figure.holds((place - by).to_array(), apart));
        let off_bodies =
            copy.figures.is_empty() || self.things.places.iter().all(|&place| !in_reach(place) || off_copy(place));
        let middles = self.things.figures.iter().map(|figure| DVec3::from(figure.center()));
        copy.places.iter().all(|&place| self.is_clear(place + by) && off_solids(place + by))
            && solid.iter().all(|&place| off_solids(place + by))
            && off_bodies
            && middles.into_iter().all(off_copy)
    }
}

/// Where there is room for a copy.
pub(super) fn place(clip: &Clip, world: &dyn Dynamics, wish: &Wish) -> Place {
    let wanted = DVec3::from(wish.by);
    let points = clip.keys.points.iter().flat_map(|points| &points.position);
    let points: Vec<DVec3> = points.map(|at| DVec3::from(at.embed())).collect();
    let figures = clip.keys.figures();
    let alone = Things { places: points.clone(), figures: figures.clone() };
    let Some(around) = alone.around() else { return Place { by: wish.by, lies_in: None } };
    let size = around[1] - around[0];
    let longest = size.max_element().max(1e-6);
    let side = {
        let world = Things::of_world(world, f64::INFINITY).around();
        let all = world.map_or(longest, |[low, high]| (high - low).max_element());
        (APART * longest).max(FINEST * all)
    };
    let bonds = clip.keys.bonds.iter().map(|bond| [bond.a, bond.b]);
    let triangles = clip.keys.triangles.iter().map(|corners| corners.0);
    let copy = Things { figures, ..Things::of(&points, bonds, triangles, side) };
    let mut there = Around {
        things: Things::of_world(world, side),
        cells: BTreeSet::new(),
        side,
        bounds: world.bounds().map(|corners| corners.map(DVec3::from)),
        planes: world.planes().into_iter().map(|plane| plane.map(DVec3::from)).collect(),
    };
    there.cells = there.things.places.iter().map(|&place| there.cell(place)).collect();
    let solid: Vec<DVec3> = copy.figures.iter().flat_map(inside).collect();
    // What is flat goes a part of its length only, across it too.
    let step = 0.5 * size.max(DVec3::splat(0.2 * longest));
    let along = -2 * STEPS..=2 * STEPS;
    let all =
        along.clone().flat_map(|i| along.clone().flat_map(move |j| (-2 * STEPS..=2 * STEPS).map(move |k| [i, j, k])));
    let mut ways: Vec<DVec3> = all.map(|of| step * DVec3::from(of.map(f64::from))).collect();
    ways.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let middle = 0.5 * (around[0] + around[1]);
    let mut ways = ways.into_iter().map(|way| wanted + way);
    let found = ways.find(|&by| wish.sees(middle + by) && there.has_room(&copy, around, &solid, by));
    let lies_in = found.is_none().then_some(IN_ANOTHER);
    Place { by: found.unwrap_or(wanted).to_array(), lies_in }
}
