//! Where a copy has room: as near as may be to where it is wished, and in view, beside bodies, obstacles and walls.

use glam::{DVec2, DVec3};

use super::raster::Raster;
use super::{Clip, Wish, space};
use crate::history::History;
use crate::sim::Dynamics;

/// Cells along the longer side of what is looked at.
const CELLS: f64 = 400.0;
/// Cells that are kept free about a copy, beside what skins need.
const APART: f64 = 1.0;
/// Said of a copy that is put where another body is: nothing is free.
pub(super) const IN_ANOTHER: &str = "there is no free room in view: it lies in another body";
/// Said of a copy that is put beside what it is of: there is room for it, but not in view.
const OUT_OF_VIEW: &str = "there is no free room in view: it lies beside it, partly out of view (F shows all)";
/// Said where it would lie in obstacles or beyond walls wherever it is put.
const NO_ROOM: &str = "there is no room for it in view: make some, or look from further away (wheel)";

/// Where a copy comes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    /// From where it was `[m]`.
    pub(super) by: [f64; 3],
    /// What is to be said of it.
    pub(super) lies_in: Option<&'static str>,
}

/// Where there is room for a copy.
///
/// Errors: in words, that there is none.
pub(super) fn place(clip: &Clip, history: &History, wish: &Wish) -> Result<Place, String> {
    let is_endless = clip.keys.obstacles.iter().any(|obstacle| obstacle.plane.is_some());
    match clip.dimensions {
        // A plane has no end, so it lies in everything.
        _ if is_endless => Ok(Place { by: wish.by, lies_in: None }),
        2 => in_plane(clip, history.world(), wish),
        _ => Ok(space::place(clip, history.world(), wish)),
    }
}

/// Places, lines and loops `[m]`.
#[derive(Default)]
struct Drawing {
    dots: Vec<DVec2>,
    lines: Vec<[DVec2; 2]>,
    loops: Vec<Vec<Vec<DVec2>>>,
}

impl Drawing {
    fn bodies(
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
    fn with(mut self, solids: impl Iterator<Item = Vec<Vec<[f64; 2]>>>) -> Self {
        let placed = |corners: Vec<[f64; 2]>| corners.into_iter().map(DVec2::from).collect();
        self.loops.extend(solids.map(|loops| loops.into_iter().map(placed).collect()));
        self
    }

    /// The box around it.
    fn around(&self) -> Option<[DVec2; 2]> {
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

fn in_plane(clip: &Clip, world: &dyn Dynamics, wish: &Wish) -> Result<Place, String> {
    let wanted = DVec3::from(wish.by).truncate();
    let there = Ok(Place { by: wish.by, lies_in: None });
    let Some(shape) = clip.keys.shape(0) else { return there };
    let places: Vec<DVec2> = shape.places.iter().copied().map(DVec2::from).collect();
    let own = Drawing::bodies(&places, shape.bonds.into_iter(), shape.triangles.into_iter())
        .with(shape.polygons.into_iter().map(|polygon| polygon.loops));
    let Some(around) = own.around().map(|corners| corners.map(|corner| corner + wanted)) else { return there };
    let size = around[1] - around[0];
    let seen = wish.seen();
    // Of what is looked at there is room for all of it about what is seen.
    let reach = [seen[0].min(around[0]) - size, seen[1].max(around[1]) + size];
    let cell = (reach[1] - reach[0]).max_element() / CELLS;
    if !(cell > 0.0 && cell.is_finite()) {
        return there;
    }
    let [solid, taken] = rasters(world, reach, cell);
    let apart = (2.0 * world.contact().and_then(|contact| contact.radius).unwrap_or(0.0) / cell).ceil() + APART;
    let margin = DVec2::splat((apart + 1.0) * cell);
    let low = (around[0] - margin - reach[0]) / cell;
    let low = reach[0] + low.floor() * cell;
    let mut thing = Raster::new([low, around[1] + margin + DVec2::splat(cell)], cell);
    own.onto(&mut thing, wanted);
    let thing = thing.grown(apart as usize);
    let may_be = |by: DVec2| {
        let [from, to] = around.map(|corner| corner + by);
        let axis = |k: usize| match size[k] <= seen[1][k] - seen[0][k] {
            true => from[k] >= seen[0][k] && to[k] <= seen[1][k],
            false => (seen[0][k]..=seen[1][k]).contains(&(0.5 * (from[k] + to[k]))),
        };
        by == DVec2::ZERO && wish.is_meant || (axis(0) && axis(1))
    };
    let found = |raster: &Raster| nearest(raster, &thing, |[x, y]| may_be(cell * DVec2::new(x as f64, y as f64)));
    let (by, lies_in) = match found(&taken) {
        Some(by) => (by, None),
        None if taken.has_room(&thing, taken.offset(&thing)) => ([0; 2], Some(OUT_OF_VIEW)),
        None => (found(&solid).ok_or_else(|| NO_ROOM.to_owned())?, Some(IN_ANOTHER)),
    };
    let by = wanted + cell * DVec2::new(by[0] as f64, by[1] as f64);
    Ok(Place { by: by.extend(0.0).to_array(), lies_in })
}

/// What obstacles and walls cover of a part of the plane, and what bodies do too.
fn rasters(world: &dyn Dynamics, reach: [DVec2; 2], cell: f64) -> [Raster; 2] {
    let mut solid = Raster::new(reach, cell);
    Drawing::default().with(world.polygons().iter().map(|polygon| polygon.loops.clone())).onto(&mut solid, DVec2::ZERO);
    let flat = |x: [f64; 3]| DVec3::from(x).truncate();
    let bounds = world.bounds().map(|corners| corners.map(flat));
    let planes: Vec<[DVec2; 2]> = world.planes().into_iter().map(|plane| plane.map(flat)).collect();
    if bounds.is_some() || !planes.is_empty() {
        solid.cover(|at| {
            let is_out = bounds.is_some_and(|[low, high]| at.cmplt(low).any() || at.cmpgt(high).any());
            is_out || planes.iter().any(|[point, normal]| (at - *point).dot(*normal) < 0.0)
        });
    }
    let x = world.positions();
    let is_gone = |point: u32| world.gone().binary_search(&crate::sim::PointId(point)).is_ok();
    let at = |point: u32| match is_gone(point) {
        true => DVec2::NAN,
        false => DVec2::new(x.get(2 * point as usize), x.get(2 * point as usize + 1)),
    };
    let places: Vec<DVec2> = (0..world.point_count() as u32).map(at).collect();
    let bonds = world.bonds().ends().iter().map(|ends| ends.map(|end| end.0));
    let triangles = world.triangles().iter().map(|corners| corners.map(|corner| corner.0));
    let mut taken = solid.clone();
    Drawing::bodies(&places, bonds, triangles).onto(&mut taken, DVec2::ZERO);
    [solid, taken]
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

impl Wish {
    /// What is free of the picture in the plane: lower and upper corner `[m]`.
    fn seen(&self) -> [DVec2; 2] {
        let [[left, top], [right, bottom]] = self.free;
        [[left, bottom], [right, top]].map(|pixel| self.camera.world_from_screen(pixel).truncate())
    }

    /// Whether a place in space is seen beside panels.
    pub(super) fn sees(&self, at: DVec3) -> bool {
        let [low, high] = self.free;
        let is_in = |pixel: [f64; 2]| (0..2).all(|k| (low[k]..=high[k]).contains(&pixel[k]));
        self.camera.screen_from_world(at).is_some_and(is_in)
    }
}
