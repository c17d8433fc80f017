//! Obstacles that go on their way while time runs push ahead what they meet, and carry what lies on them.

use super::crowd::{Crowd, Hanging, Stop};
use super::recompile::Detached;
use super::shift::Placement;
use crate::sim::bond::PointId;
use crate::sim::command::Jam;
use crate::sim::contact::convex::{Convex, Figure};
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::contact::polygon::Polygon;
use crate::sim::model::Model;
use crate::sim::plan::Sets;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, dot, embed, length, scale, sub, truncate, widen, zero};
use crate::sim::world::World;

/// Most parts that a way is gone in: each is shorter than half the obstacle is thick, so that nothing is leapt over. A longer way is gone
/// in longer parts, past what is thinner than these.
const MOST_PARTS: f64 = 64.0;
/// A part that has no room is tried again by half, down to this share of it.
const SHORTEST: f64 = 0.05;
/// What parts of a way add up to is off by less than this.
const ROUNDING: f64 = 1e-9;
/// What is nearer to an obstacle than this, as a share of half its thickness, lies on it.
const NEAR: f64 = 0.02;
/// A pin that is no further off the surface of an obstacle hangs on it `[m]`.
const AT: f64 = 1e-6;
/// Half the thickness of what has no end `[m]`.
const LIES: f64 = 0.5;

/// Obstacles in two places, one after the other, and the way between.
pub(super) struct Part<'a, const D: usize> {
    before: &'a Obstacles<f64, D>,
    pub(super) after: &'a Obstacles<f64, D>,
    /// All that stands.
    others: &'a Obstacles<f64, D>,
    placement: &'a Placement,
    /// What it takes `[s]`.
    seconds: f64,
}

/// Where an obstacle pushes: how deep it came to be there `[m]`, which way out, and how fast it goes there `[m/s]`.
#[derive(Clone, Copy)]
pub(super) struct Touch<const D: usize> {
    pub(super) at: [f64; D],
    pub(super) depth: f64,
    pub(super) normal: [f64; D],
    pub(super) speed: f64,
}

impl<S: Real, const D: usize> World<S, D> {
    /// Obstacles go on a way within so long `[s]`. What they meet among what was taken out is ahead of them, with at least the speed that
    /// they have there and then: soft bodies point by point, bodies of one rigid piece as a whole; what lies on them goes along as
    /// friction lets it. They stop where what is in the way has no room: returns the share of the way that they go, and what stopped them.
    pub(super) fn push_ahead(
        &self,
        (model, obstacles): (&Model<D>, &[u32]),
        (placement, seconds): (&Placement, f64),
        detached: &mut Detached<S, D>,
    ) -> (f64, Option<Jam>) {
        let mut moved = self.only(&self.model, obstacles);
        let Ok(mut before) = Obstacles::<f64, D>::of(&moved) else { return (1.0, None) };
        let Ok(others) = Obstacles::<f64, D>::of(&self.all_but(model, obstacles)) else { return (1.0, None) };
        let bodies = self.hanging(detached);
        let mut crowd = Crowd {
            x: detached.state.position.iter().map(|&x| widen(x)).collect(),
            v: detached.state.velocity.iter().map(|&v| widen(v)).collect(),
            w: detached.points.iter().map(|&point| self.inverse_mass[point as usize]).collect(),
            is_changed: vec![false; detached.points.len()],
            meets: self.model.contact.is_some_and(|contact| contact.with_others),
        };
        let half = half_thickness(&moved);
        let gravity = self.model.gravity;
        for body in bodies.iter().filter(|body| !body.is_pinned) {
            let friction = friction(&moved);
            crowd.carry(body, (&before, NEAR * half), (placement, seconds), (gravity, friction));
        }
        let far = corners(&moved).map(|x| length(sub(placement.place(x), x))).fold(0.0, f64::max);
        let has_parts = placement.has_parts();
        let mut share = if has_parts { 1.0 / (far / half).ceil().clamp(1.0, MOST_PARTS) } else { 1.0 };
        let least = if has_parts { SHORTEST * share } else { 1.0 };
        let (mut gone, mut stop) = (0.0, None);
        while gone < 1.0 && share >= least {
            let end = if gone + share < 1.0 - ROUNDING { gone + share } else { 1.0 };
            let step = placement.between(gone, end);
            let mut there = moved.clone();
            step.put(&mut there);
            let Ok(after) = Obstacles::<f64, D>::of(&there) else { break };
            let seconds = seconds * (end - gone);
            let part = Part { before: &before, after: &after, others: &others, placement: &step, seconds };
            match crowd.push(&bodies, &part) {
                Ok(()) => (gone, before, moved) = (end, after, there),
                Err(found) => (share, stop) = (0.5 * share, Some(found)),
            }
        }
        for place in (0..detached.points.len()).filter(|&place| crowd.is_changed[place]) {
            let state = &mut detached.state;
            (state.position[place], state.velocity[place]) = (convert(crowd.x[place]), convert(crowd.v[place]));
            (state.position_lost[place], state.velocity_lost[place]) = (zero(), zero());
        }
        let jam = stop.filter(|_| gone < 1.0).map(|Stop { bodies: stuck, why }| {
            let places = stuck.into_iter().flat_map(|body| &bodies[body].points);
            let mut points: Vec<PointId> = places.map(|&place| PointId(detached.points[place])).collect();
            points.sort_unstable();
            Jam { points, why }
        });
        (gone, jam)
    }

    /// What hangs together of what was taken out; points by themselves too.
    fn hanging(&self, detached: &Detached<S, D>) -> Vec<Hanging> {
        let mut sets = Sets::new(self.count());
        self.bonds.ends().iter().for_each(|[a, b]| sets.join(a.0, b.0));
        let mut place_of_root = vec![usize::MAX; self.count()];
        let mut list: Vec<Hanging> = Vec::new();
        for (place, &point) in detached.points.iter().enumerate() {
            let root = sets.find(point) as usize;
            if place_of_root[root] == usize::MAX {
                place_of_root[root] = list.len();
                list.push(Hanging::default());
            }
            let body = &mut list[place_of_root[root]];
            body.points.push(place);
            body.is_pinned |= self.inverse_mass[point as usize] == 0.0;
        }
        let mut held = vec![0; list.len()];
        for (k, [a, b]) in self.bonds.ends().iter().enumerate() {
            let ([Some(from), Some(to)], root) = ([a, b].map(|end| detached.place(end.0)), sets.find(a.0) as usize)
            else {
                continue;
            };
            held[place_of_root[root]] += usize::from(self.bonds.get(k).is_held());
            let body = &mut list[place_of_root[root]];
            body.bonds.push([from, to]);
            body.rests.push((self.bonds.get(k).rest_length, self.bonds.get(k).is_held()));
        }
        let rests = self.model.rest_areas.iter().copied().chain(std::iter::repeat(0.0));
        for (corners, rest) in self.model.triangles.iter().zip(rests) {
            if let [Some(a), Some(b), Some(c)] = corners.map(|corner| detached.place(corner.0)) {
                let body = &mut list[place_of_root[sets.find(corners[0].0) as usize]];
                body.triangles.push([a, b, c]);
                body.areas.push(rest);
            }
        }
        for (body, held) in list.iter_mut().zip(held) {
            // As many as hold a frame in the plane (Laman).
            body.is_rigid = D == 2 && body.points.len() > 1 && held + 3 >= 2 * body.points.len();
        }
        list
    }
}

/// Corners of obstacles; of what has none, a place on it.
fn corners<const D: usize>(model: &Model<D>) -> impl Iterator<Item = [f64; D]> + '_ {
    let planes = model.planes.iter().map(|plane| plane.point);
    let polygons = model.polygons.iter().flat_map(|polygon| &polygon.loops).flatten().map(|&x| truncate(embed(x)));
    let convex = model.convex.iter().flat_map(|convex| convex.figure.extent()).map(truncate);
    planes.chain(polygons).chain(convex)
}

/// Half of how thick the thinnest obstacle is `[m]`: of an outline its area by its length. Planes are thicker than anything.
fn half_thickness<const D: usize>(model: &Model<D>) -> f64 {
    let of_loop = |corners: &[[f64; 2]]| {
        let sides = || (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]]);
        let area: f64 = sides().map(|[a, b]| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum();
        let around: f64 = sides().map(|[a, b]| length(sub(b, a))).sum();
        (area.abs(), around)
    };
    let of_polygon = |polygon: &Polygon| {
        let loops = polygon.loops.iter().map(|corners| of_loop(corners));
        let (area, around) = loops.fold((0.0_f64, 0.0), |(area, around), (own, side)| (area.max(own), around + side));
        area / around
    };
    let of_convex = |convex: &Convex| match convex.figure {
        Figure::Ball { radius, .. } => 0.5 * radius,
        Figure::Box { min, max, .. } => (0..3).map(|k| 0.5 * (max[k] - min[k])).fold(f64::INFINITY, f64::min),
    };
    let polygons = model.polygons.iter().map(of_polygon).filter(|half| *half > 0.0);
    let thinnest = polygons.chain(model.convex.iter().map(of_convex)).fold(f64::INFINITY, f64::min);
    if thinnest.is_finite() { thinnest } else { LIES }
}

/// The least friction of obstacles.
fn friction<const D: usize>(model: &Model<D>) -> f64 {
    let planes = model.planes.iter().map(|plane| plane.friction);
    let polygons = model.polygons.iter().map(|polygon| polygon.friction);
    planes.chain(polygons).chain(model.convex.iter().map(|convex| convex.friction)).fold(f64::INFINITY, f64::min)
}

impl<const D: usize> Part<'_, D> {
    /// How far an obstacle goes that is at `x` `[m]`.
    pub(super) fn way(&self, x: [f64; D]) -> [f64; D] {
        sub(self.placement.place(x), x)
    }

    /// How deep a place is in the obstacles where they were `[m]`; 0: it is outside.
    pub(super) fn was_deep(&self, x: [f64; D]) -> f64 {
        if is_inside(self.before, x) { depth(self.before, x).map_or(0.0, |(depth, _)| depth) } else { 0.0 }
    }

    /// Whether a place is no deeper in the obstacles than `was` `[m]`.
    pub(super) fn is_free(&self, x: [f64; D], was: f64) -> bool {
        match was > 0.0 {
            true => depth(self.after, x).is_none_or(|(depth, _)| depth <= was + self.after.slack()),
            false => !is_inside(self.after, x),
        }
    }

    /// Whether a pin that was outside is in the obstacles now, and not at their surface: what hangs on them does not hold them.
    pub(super) fn holds(&self, x: [f64; D]) -> bool {
        let mut is_at = self.before.planes().iter().any(|plane| plane.gap(x).abs() <= AT);
        self.before.touching(x, AT / self.before.slack(), |_| is_at = true);
        !is_at && is_inside(self.after, x)
    }

    /// Whether what stands leaves room there, or did not where it was.
    pub(super) fn has_room(&self, from: [f64; D], to: [f64; D]) -> bool {
        !is_inside(self.others, to) || is_inside(self.others, from)
    }

    /// Where the obstacles came to be around a point that was so deep in them `[m]`, or deeper.
    pub(super) fn touch(&self, x: [f64; D], was: f64) -> Option<Touch<D>> {
        if self.is_free(x, was) {
            return None;
        }
        let (depth, normal) = depth(self.after, x)?;
        let speed = dot(self.way(x), normal).max(0.0) / self.seconds;
        Some(Touch { at: x, depth: depth - was, normal, speed })
    }

    /// The place on a bond that the obstacles go through, with both ends outside.
    pub(super) fn pierced(&self, [a, b]: [[f64; D]; 2]) -> Option<Touch<D>> {
        let share = pierced(self.after, [a, b])?;
        if is_inside(self.after, a) || is_inside(self.after, b) {
            return None;
        }
        let at = add(a, scale(sub(b, a), share));
        let way = self.way(at);
        let far = length(way);
        (far > 0.0).then(|| Touch { at, depth: far, normal: scale(way, 1.0 / far), speed: far / self.seconds })
    }

    /// Whether what stands goes through a bond.
    pub(super) fn stops(&self, ends: [[f64; D]; 2]) -> bool {
        pierced(self.others, ends).is_some()
    }

    /// Whether the obstacles went through a bond where they were.
    pub(super) fn was_pierced(&self, ends: [[f64; D]; 2]) -> bool {
        pierced(self.before, ends).is_some()
    }
}

/// Whether a place is in obstacles.
fn is_inside<const D: usize>(obstacles: &Obstacles<f64, D>, x: [f64; D]) -> bool {
    obstacles.planes().iter().any(|plane| -plane.gap(x) > obstacles.slack())
        || obstacles.depth_in_convex(x).is_some()
        || obstacles.is_inside(x)
}

/// How deep a place is in obstacles `[m]`, and the way out; `None`: it is outside.
fn depth<const D: usize>(obstacles: &Obstacles<f64, D>, x: [f64; D]) -> Option<(f64, [f64; D])> {
    let behind = obstacles.planes().iter().map(|plane| (-plane.gap(x), plane.normal));
    let plane = behind.filter(|(depth, _)| *depth > obstacles.slack()).max_by(|a, b| a.0.total_cmp(&b.0));
    plane.or_else(|| obstacles.depth_in_convex(x)).or_else(|| {
        let surface = obstacles.nearest(x, 0.0)?;
        let surface = &obstacles.surfaces[surface];
        Some(((-surface.gap(x)).max(0.0), surface.normal))
    })
}

/// Where a bond first goes into an obstacle that has an end, as a share of it.
fn pierced<const D: usize>(obstacles: &Obstacles<f64, D>, [a, b]: [[f64; D]; 2]) -> Option<f64> {
    if obstacles.has_walls() {
        let met = obstacles.entering(a, b, |_| true)?;
        return (obstacles.surfaces[met.surface].gap(b) < -obstacles.slack()).then_some(met.share);
    }
    (!obstacles.convex().is_empty() && obstacles.pierces_convex(a, b)).then_some(0.5)
}
