//! Where one more thing has room in the plane: as near as may be to where it is wished, and in view, beside bodies, obstacles and walls, by what
//! they cover.

mod raster;

use glam::{DVec2, DVec3};

use crate::sim::{Dynamics, PointId};
use raster::Raster;

/// Cells along the longer side of what is looked at.
const CELLS: f64 = 400.0;
/// Cells that are kept free about a thing, beside what skins need.
const APART: f64 = 1.0;
/// Part of its longer side that a thing keeps from others, where it is looked for room for by [`in_view_or_not`] `[1]`.
const GAP: f64 = 0.05;

/// How a thing lies where it is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lies {
    /// In view, and nothing else is there.
    Free,
    /// Nothing is there, but a part of it is out of view.
    OutOfView,
    /// In the hollow of another body, and nothing else is there.
    InHollow,
    /// In another body: nothing is free.
    InAnother,
}

/// What is wished for a thing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    /// From where it is `[m]`.
    pub(crate) by: DVec2,
    /// It may be there though a part of it is out of view.
    pub(crate) is_meant: bool,
    /// It is beside what lies where it comes from: as far to the right. The other sides are as good, in their order.
    pub(crate) is_beside: bool,
    /// Lower and upper corner of what is seen `[m]`.
    pub(crate) seen: [DVec2; 2],
}

/// Places, lines and loops `[m]`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Drawing {
    dots: Vec<DVec2>,
    lines: Vec<[DVec2; 2]>,
    loops: Vec<Vec<Vec<DVec2>>>,
}

impl Drawing {
    /// Of points, bonds and triangles.
    pub(crate) fn bodies(
        places: &[DVec2],
        bonds: impl Iterator<Item = [u32; 2]>,
        triangles: impl Iterator<Item = [u32; 3]>,
    ) -> Self {
        let at = |point: u32| places.get(point as usize).copied().unwrap_or(DVec2::NAN);
        Drawing {
            dots: places.to_vec(),
            lines: bonds.map(|ends| ends.map(at)).collect(),
            loops: triangles.map(|corners| vec![corners.map(at).to_vec()]).collect(),
        }
    }

    /// With what lies within the loops of each.
    pub(crate) fn with(mut self, solids: impl Iterator<Item = Vec<Vec<[f64; 2]>>>) -> Self {
        let placed = |corners: Vec<[f64; 2]>| corners.into_iter().map(DVec2::from).collect();
        self.loops.extend(solids.map(|loops| loops.into_iter().map(placed).collect()));
        self
    }

    /// The box around it.
    pub(crate) fn around(&self) -> Option<[DVec2; 2]> {
        let corners = self.loops.iter().flatten().flatten();
        let all = self.dots.iter().chain(corners).filter(|at| at.is_finite());
        all.fold(None, |around: Option<[DVec2; 2]>, &at| {
            Some(around.map_or([at; 2], |[low, high]| [low.min(at), high.max(at)]))
        })
    }

    fn onto(&self, raster: &mut Raster, by: DVec2) {
        self.dots.iter().for_each(|&at| raster.dot(at + by));
        self.lines.iter().for_each(|ends| raster.line(ends.map(|end| end + by)));
        for loops in &self.loops {
            let moved: Vec<Vec<DVec2>> =
                loops.iter().map(|corners| corners.iter().map(|&corner| corner + by).collect()).collect();
            if moved.iter().flatten().all(|corner| corner.is_finite()) {
                raster.fill(&moved.iter().map(Vec::as_slice).collect::<Vec<_>>());
            }
        }
    }
}

/// How far a thing goes from where it is `[m]`, and how it lies there; `None`: it would be in obstacles or behind walls all over what is seen.
pub(crate) fn in_view(world: &dyn Dynamics, own: &Drawing, wanted: Wanted) -> Option<(DVec2, Lies)> {
    let Some(search) = Search::new(world, own, (wanted, 0.0), true) else { return Some((wanted.by, Lies::Free)) };
    // Whoever points into a hollow means it.
    if wanted.is_meant && search.has_room(&search.taken, [0; 2]) {
        return Some((wanted.by, Lies::Free));
    }
    let filled = search.filled(own);
    let sides = search.sides(own);
    let is_free = |side: &&[i64; 2]| search.has_room(&filled, **side);
    if let Some(&side) = sides.iter().filter(is_free).find(|side| search.may_be(search.way(**side))) {
        return Some((wanted.by + search.way(side), Lies::Free));
    }
    if let Some(by) = search.nearest(&filled) {
        return Some((by, Lies::Free));
    }
    if let Some(&side) = sides.iter().find(is_free) {
        return Some((wanted.by + search.way(side), Lies::OutOfView));
    }
    if let Some(by) = search.nearest(&search.taken) {
        return Some((by, Lies::InHollow));
    }
    Some((search.nearest(&search.solid)?, Lies::InAnother))
}

/// The same for what has to be somewhere: near the middle of what is seen, else out of view, else behind walls, else in others.
pub(crate) fn in_view_or_not(world: &dyn Dynamics, own: &Drawing, seen: [DVec2; 2]) -> DVec2 {
    let middle = 0.5 * (seen[0] + seen[1]);
    let Some([low, high]) = own.around() else { return middle };
    let (by, size) = (middle - 0.5 * (low + high), high - low);
    let gap = GAP * size.max_element();
    let wanted = Wanted { by, is_meant: false, is_beside: false, seen };
    let all = everything(world).into_iter().fold(seen, |[least, most], at| [least.min(at), most.max(at)]);
    // Beside all that there is there is room.
    let wider = Wanted { seen: [all[0] - 1.5 * size, all[1] + 1.5 * size], ..wanted };
    let tried = [(wanted, true), (wider, true), (wider, false)];
    let found = tried.into_iter().find_map(|(wanted, has_walls)| {
        let search = Search::new(world, own, (wanted, gap), has_walls)?;
        search.nearest(&search.taken)
    });
    found.unwrap_or(by)
}

/// Places that say how far a world reaches `[m]`.
fn everything(world: &dyn Dynamics) -> Vec<DVec2> {
    let x = world.positions();
    let points = (0..world.point_count()).map(|i| DVec2::new(x.get(2 * i), x.get(2 * i + 1)));
    let corners = world.polygons().iter().flat_map(|polygon| polygon.loops.iter().flatten()).copied().map(DVec2::from);
    let bounds = world.bounds().into_iter().flatten().map(|at| DVec3::from(at).truncate());
    points.chain(corners).chain(bounds).filter(|at| at.is_finite()).collect()
}

/// Where a thing may be among what is there.
struct Search {
    solid: Raster,
    bodies: Raster,
    /// What either of them covers.
    taken: Raster,
    /// What it covers where it is wished, and a little around it.
    thing: Raster,
    cell: f64,
    around: [DVec2; 2],
    wanted: Wanted,
}

impl Search {
    /// Of a thing that keeps so far from others at least `[m]`. `None`: there is nothing to look among.
    fn new(world: &dyn Dynamics, own: &Drawing, (wanted, gap): (Wanted, f64), has_walls: bool) -> Option<Self> {
        let around = own.around()?.map(|corner| corner + wanted.by);
        let (size, seen) = (around[1] - around[0], wanted.seen);
        // Of what is looked at there is room for all of it about what is seen.
        let reach = [seen[0].min(around[0]) - size, seen[1].max(around[1]) + size];
        let cell = (reach[1] - reach[0]).max_element() / CELLS;
        if !(cell > 0.0 && cell.is_finite()) {
            return None;
        }
        let [solid, bodies] = rasters(world, (reach, cell), has_walls);
        let taken = solid.clone().with(&bodies);
        let radius = world.contact().and_then(|contact| contact.radius).unwrap_or(0.0);
        let apart = ((2.0 * radius).max(gap) / cell).ceil() + APART;
        let margin = DVec2::splat((apart + 1.0) * cell);
        let low = (around[0] - margin - reach[0]) / cell;
        let low = reach[0] + low.floor() * cell;
        let mut thing = Raster::new([low, around[1] + margin + DVec2::splat(cell)], cell);
        own.onto(&mut thing, wanted.by);
        let thing = thing.grown(apart as usize);
        Some(Search { solid, bodies, taken, thing, cell, around, wanted })
    }

    /// What is taken, with the hollows of bodies: but for the one that lies about the place that the thing comes from.
    fn filled(&self, own: &Drawing) -> Raster {
        let about = own.around().filter(|_| self.wanted.is_beside);
        // The next cell beside it: not beyond the rim of another.
        let margin = DVec2::splat(self.cell);
        self.solid.clone().with(&self.bodies.filled(about.map(|[low, high]| [low - margin, high + margin])))
    }

    /// How far the places at its sides are from where it is wished, in cells: the wish itself, then left, above and below of where it comes from.
    fn sides(&self, own: &Drawing) -> Vec<[i64; 2]> {
        let mut sides = vec![[0; 2]];
        if let Some([low, high]) = own.around().filter(|_| self.wanted.is_beside) {
            let (wide, size) = (self.wanted.by.x, high - low);
            // As far apart from it as at its right.
            let tall = size.y + (wide - size.x).max(0.0);
            let places = [DVec2::new(-wide, 0.0), DVec2::new(0.0, tall), DVec2::new(0.0, -tall)];
            sides.extend(places.map(|by| ((by - self.wanted.by) / self.cell).round().to_array().map(|x| x as i64)));
        }
        sides
    }

    /// So many cells `[m]`.
    fn way(&self, [x, y]: [i64; 2]) -> DVec2 {
        self.cell * DVec2::new(x as f64, y as f64)
    }

    /// Whether nothing of a raster is where it would be, so many cells from where it is wished.
    fn has_room(&self, raster: &Raster, by: [i64; 2]) -> bool {
        let from = raster.offset(&self.thing);
        raster.has_room(&self.thing, [from[0] + by[0], from[1] + by[1]])
    }

    /// Whether it may be so far from where it is wished `[m]`.
    fn may_be(&self, by: DVec2) -> bool {
        let ([from, to], seen) = (self.around.map(|corner| corner + by), self.wanted.seen);
        let axis = |k: usize| match to[k] - from[k] <= seen[1][k] - seen[0][k] {
            true => from[k] >= seen[0][k] && to[k] <= seen[1][k],
            false => (seen[0][k]..=seen[1][k]).contains(&(0.5 * (from[k] + to[k]))),
        };
        by == DVec2::ZERO && self.wanted.is_meant || (axis(0) && axis(1))
    }

    /// How far it goes from where it is to the nearest place that has room among these `[m]`.
    fn nearest(&self, raster: &Raster) -> Option<DVec2> {
        let by = nearest(raster, &self.thing, |by| self.may_be(self.way(by)))?;
        Some(self.wanted.by + self.way(by))
    }
}

/// What obstacles and walls cover of a part of the plane, and what bodies do.
fn rasters(world: &dyn Dynamics, (reach, cell): ([DVec2; 2], f64), has_walls: bool) -> [Raster; 2] {
    let mut solid = Raster::new(reach, cell);
    Drawing::default().with(world.polygons().iter().map(|polygon| polygon.loops.clone())).onto(&mut solid, DVec2::ZERO);
    let flat = |x: [f64; 3]| DVec3::from(x).truncate();
    let bounds = world.bounds().map(|corners| corners.map(flat));
    let planes: Vec<[DVec2; 2]> = world.planes().into_iter().map(|plane| plane.map(flat)).collect();
    if has_walls && (bounds.is_some() || !planes.is_empty()) {
        solid.cover(|at| {
            let is_out = bounds.is_some_and(|[low, high]| at.cmplt(low).any() || at.cmpgt(high).any());
            is_out || planes.iter().any(|[point, normal]| (at - *point).dot(*normal) < 0.0)
        });
    }
    let x = world.positions();
    let is_gone = |point: u32| world.gone().binary_search(&PointId(point)).is_ok();
    let at = |point: u32| match is_gone(point) {
        true => DVec2::NAN,
        false => DVec2::new(x.get(2 * point as usize), x.get(2 * point as usize + 1)),
    };
    let places: Vec<DVec2> = (0..world.point_count() as u32).map(at).collect();
    let bonds = world.bonds().ends().iter().map(|ends| ends.map(|end| end.0));
    let triangles = world.triangles().iter().map(|corners| corners.map(|corner| corner.0));
    let mut covered = Raster::new(reach, cell);
    Drawing::bodies(&places, bonds, triangles).onto(&mut covered, DVec2::ZERO);
    [solid, covered]
}

/// The shortest way in cells on which a thing comes to where it has room.
fn nearest(raster: &Raster, thing: &Raster, may_be: impl Fn([i64; 2]) -> bool) -> Option<[i64; 2]> {
    let from = raster.offset(thing);
    let most = raster.size.into_iter().max().unwrap_or(0) as i64;
    let mut best: Option<(i64, [i64; 2])> = None;
    for ring in 0..=most {
        if best.is_some_and(|(far, _)| far < ring * ring) {
            break;
        }
        let sides = (-ring..=ring).flat_map(|k| [[ring, k], [-ring, k], [k, ring], [k, -ring]]);
        for by in sides {
            let far = by[0] * by[0] + by[1] * by[1];
            let is_nearer = best.is_none_or(|(other, _)| far < other);
            if is_nearer && may_be(by) && raster.has_room(thing, [from[0] + by[0], from[1] + by[1]]) {
                best = Some((far, by));
            }
        }
    }
    best.map(|(_, by)| by)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::scene::Scene;

    const SEEN: [DVec2; 2] = [DVec2::splat(-5.0), DVec2::splat(5.0)];

    fn world(keys: &str) -> Box<dyn Dynamics> {
        Scene::parse(&format!(r#"{{"wobble": 1{keys}}}"#), "x.json").unwrap().world(None).unwrap()
    }

    fn square(half: f64) -> Drawing {
        Drawing::default().with([vec![vec![[-half, -half], [half, -half], [half, half], [-half, half]]]].into_iter())
    }

    /// Where the middle of a square of 2 m comes to be.
    fn place(keys: &str, seen: [DVec2; 2]) -> DVec2 {
        in_view_or_not(&*world(keys), &square(1.0), seen)
    }

    #[test]
    fn a_thing_comes_to_the_middle_of_what_is_seen_where_nothing_is_there() {
        assert_eq!(place("", [DVec2::ZERO, DVec2::new(8.0, 4.0)]), DVec2::new(4.0, 2.0));
    }

    #[test]
    fn by_its_shape_a_thing_lies_in_the_hollow_of_another() {
        // An L: in the box around it most is free.
        let at = place(
            r#", "points": {"position": [[-4, -4], [4, -4], [-4, 4]]}, "bonds": [{"a": 0, "b": 1}, {"a": 0, "b": 2}]"#,
            SEEN,
        );
        assert!(at.length() < 0.1, "{at}");
        let ball = place(r#", "obstacles": [{"circle": {"center": [0, 0], "radius": 2}}]"#, SEEN);
        let corner = (ball.abs() - 1.0).max(DVec2::ZERO).length();
        assert!((2.0..2.3).contains(&corner), "as near as may be beside it: {ball}");
    }

    #[test]
    fn holes_of_obstacles_are_used_where_nothing_else_is_free() {
        let cave = r#", "obstacles": [{"polygon": [[[-9, -9], [9, -9], [9, 9], [-9, 9]], [[1, -3], [4, -3], [4, 0], [1, 0]]]}]"#;
        let at = place(cave, SEEN);
        assert!((at - DVec2::new(2.5, -1.5)).abs().cmple(DVec2::splat(0.5)).all(), "{at}");
    }

    #[test]
    fn walls_and_planes_are_kept_even_where_that_is_out_of_view() {
        let walls = r#", "bounds": {"min": [-9, -1.5], "max": [2.5, 1.5]}, "points": {"position": [[0.3, 0]]}"#;
        let at = place(walls, [DVec2::new(-0.5, -9.0), DVec2::splat(9.0)]);
        assert!(at.x < 1.5 && at.y.abs() < 0.51 && (at.x - 0.3).abs() > 1.0, "{at}");
        let floor = r#", "obstacles": [{"plane": {"point": [0, -1], "normal": [0, 1]}}]"#;
        let at = place(floor, [DVec2::splat(-9.0), DVec2::new(9.0, 2.0)]);
        assert!(at.y > 0.0, "{at}");
    }

    #[test]
    fn what_is_too_large_for_the_walls_still_lies_beside_the_others() {
        let keys = r#", "bounds": {"min": [-0.5, -0.5], "max": [0.5, 0.5]}, "points": {"position": [[0, 0]]}"#;
        let at = place(keys, SEEN);
        assert!(at.abs().max_element() > 1.0, "{at}");
    }

    #[test]
    fn a_copy_says_how_it_lies() {
        let wanted = |by: f64, seen: [DVec2; 2]| {
            let by = DVec2::new(by, 0.0);
            Wanted { by, is_meant: false, is_beside: false, seen }
        };
        let full = world(
            r#", "points": {"position": [[-5, 0], [5, 0], [0, 5], [0, -5]]}, "bonds": [{"a": 0, "b": 1}, {"a": 2, "b": 3}]"#,
        );
        let small = [DVec2::splat(-1.5), DVec2::splat(1.5)];
        assert_eq!(in_view(&*full, &square(1.0), wanted(0.0, small)).map(|(_, lies)| lies), Some(Lies::InAnother));
        assert_eq!(in_view(&*full, &square(1.0), wanted(0.0, SEEN)).map(|(_, lies)| lies), Some(Lies::Free));
        let ring = world(
            r#", "points": {"position": [[-3, -3], [3, -3], [3, 3], [-3, 3]]},
            "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}]"#,
        );
        let within = [DVec2::splat(-2.0), DVec2::splat(2.0)];
        assert_eq!(in_view(&*ring, &square(1.0), wanted(0.0, within)).map(|(_, lies)| lies), Some(Lies::InHollow));
        let solid = world(r#", "obstacles": [{"box": {"min": [-20, -20], "max": [20, 20]}}]"#);
        assert_eq!(in_view(&*solid, &square(1.0), wanted(0.0, SEEN)), None);
    }

    /// A square of 1 m about the origin, with what else is there: where its copy comes to be.
    fn copied(keys: &str, seen: [DVec2; 2], far: f64) -> (DVec2, Lies) {
        let own = r#"{"polygon": [[[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]]}"#;
        let world = world(&format!(r#", "obstacles": [{own}{keys}"#));
        let wanted = Wanted { by: DVec2::new(far, 0.0), is_meant: false, is_beside: true, seen };
        in_view(&*world, &square(0.5), wanted).unwrap()
    }

    #[test]
    fn a_copy_comes_to_the_first_free_side_right_left_above_below() {
        let at = |x: f64, y: f64| {
            let [a, b] = [[x - 0.5, y - 0.5], [x + 0.5, y + 0.5]];
            format!(r#", {{"box": {{"min": [{}, {}], "max": [{}, {}]}}}}"#, a[0], a[1], b[0], b[1])
        };
        let sides = [DVec2::new(1.1, 0.0), DVec2::new(-1.1, 0.0), DVec2::new(0.0, 1.1), DVec2::new(0.0, -1.1)];
        let mut others = String::new();
        for side in sides {
            let (by, lies) = copied(&format!("{others}]"), SEEN, 1.1);
            assert!(by.distance(side) < 0.04 && lies == Lies::Free, "{by} in place of {side}");
            others += &at(1.4 * side.x, 1.4 * side.y);
        }
        let (by, lies) = copied(&format!("{others}]"), SEEN, 1.1);
        assert!(lies == Lies::Free && by.abs().max_element() > 1.0, "beside all of them: {by}");
    }

    #[test]
    fn a_copy_stays_within_walls_though_that_is_not_at_its_right() {
        let walls = r#"], "bounds": {"min": [-9, -9], "max": [0.8, 9]}"#;
        let (by, lies) = copied(walls, SEEN, 1.1);
        assert!(by.distance(DVec2::new(-1.1, 0.0)) < 0.04 && lies == Lies::Free, "{by}");
        // Nor is the left in view: it is within the walls.
        let (by, lies) = copied(walls, [DVec2::splat(-0.7), DVec2::splat(0.7)], 1.1);
        assert!(by.distance(DVec2::new(-1.1, 0.0)) < 0.04 && lies == Lies::OutOfView, "{by}");
    }

    #[test]
    fn a_copy_lies_in_no_hollow_of_another_body_but_in_that_of_its_original() {
        let ring = |middle: f64| {
            let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]].map(|[x, y]| [x + middle, y]);
            let bonds = r#"[{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}]"#;
            format!(r#"], "points": {{"position": {corners:?}}}, "bonds": {bonds}"#)
        };
        // From 0.65 to 4.65 m: the place at the right is in the hollow.
        let (by, lies) = copied(&ring(2.65), SEEN, 1.3);
        assert!(by.distance(DVec2::new(-1.3, 0.0)) < 0.04 && lies == Lies::Free, "{by}");
        let (by, _) = copied(&ring(0.0), SEEN, 1.3);
        assert!(by.distance(DVec2::new(1.3, 0.0)) < 0.04, "both lie in it: {by}");
    }
}
