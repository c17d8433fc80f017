//! Obstacles that go on their way while time runs push ahead what they meet, and carry what lies on them.

use super::recompile::Detached;
use super::shift::Placement;
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
/// Halvings of a part to where a point is out.
const HALVINGS: u32 = 10;
/// Rounds in which bonds that the obstacle still goes through are pushed, and rigid bodies are put out.
const ROUNDS: u32 = 6;
/// Rounds in which the speeds of a rigid body at all that pushes it are found.
const BLOWS: u32 = 24;
/// What is nearer to an obstacle than this, as a share of half its thickness, lies on it.
const NEAR: f64 = 0.02;
/// Half the thickness of what has no end `[m]`.
const LIES: f64 = 0.5;

/// Obstacles in two places, one after the other, and the way between.
struct Part<'a, const D: usize> {
    before: &'a Obstacles<f64, D>,
    after: &'a Obstacles<f64, D>,
    /// All that stands.
    others: &'a Obstacles<f64, D>,
    placement: &'a Placement,
    /// What it takes `[s]`.
    seconds: f64,
}

/// What hangs together by bonds, by the places of its points in what was taken out.
#[derive(Default)]
struct Hanging {
    points: Vec<usize>,
    bonds: Vec<[usize; 2]>,
    /// Bonds hold it as one piece.
    is_rigid: bool,
    /// Something of it is held.
    is_pinned: bool,
}

/// Points that are pushed.
struct Crowd<const D: usize> {
    x: Vec<[f64; D]>,
    v: Vec<[f64; D]>,
    /// Inverse masses `[1/kg]`, 0 of what is held.
    w: Vec<f64>,
    is_changed: Vec<bool>,
}

/// Where an obstacle pushes: how deep it came to be there `[m]`, which way out, and how fast it goes there `[m/s]`.
#[derive(Clone, Copy)]
struct Touch<const D: usize> {
    at: [f64; D],
    depth: f64,
    normal: [f64; D],
    speed: f64,
}

impl<S: Real, const D: usize> World<S, D> {
    /// Obstacles went so within so long `[s]`. What they met among what was taken out is ahead of them, with at least the speed that
    /// they have there and then: points and bonds by themselves, bodies of one rigid piece as a whole; what lies on them goes along as
    /// friction lets it. What can go no further, against pins or other obstacles, is left to the next step.
    pub(super) fn push_ahead(
        &mut self,
        (model, obstacles): (&Model<D>, &[u32]),
        (placement, seconds): (&Placement, f64),
        detached: &mut Detached<S, D>,
    ) {
        let mut moved = self.only(&self.model, obstacles);
        let Ok(mut before) = Obstacles::<f64, D>::of(&moved) else { return };
        let Ok(others) = Obstacles::<f64, D>::of(&self.all_but(model, obstacles)) else { return };
        let bodies = self.hanging(detached);
        let mut crowd = Crowd {
            x: detached.state.position.iter().map(|&x| widen(x)).collect(),
            v: detached.state.velocity.iter().map(|&v| widen(v)).collect(),
            w: detached.points.iter().map(|&point| self.inverse_mass[point as usize]).collect(),
            is_changed: vec![false; detached.points.len()],
        };
        let half = half_thickness(&moved);
        let gravity = self.model.gravity;
        for body in bodies.iter().filter(|body| !body.is_pinned) {
            let friction = friction(&moved);
            crowd.carry(body, (&before, NEAR * half), (placement, seconds), (gravity, friction));
        }
        let far = corners(&moved).map(|x| length(sub(placement.place(x), x))).fold(0.0, f64::max);
        let count = if placement.has_parts() { (far / half).ceil().clamp(1.0, MOST_PARTS) } else { 1.0 };
        for number in 0..count as u32 {
            let step = placement.part(number, count as u32);
            step.put(&mut moved);
            let Ok(after) = Obstacles::<f64, D>::of(&moved) else { return };
            let part =
                Part { before: &before, after: &after, others: &others, placement: &step, seconds: seconds / count };
            bodies.iter().for_each(|body| crowd.push(body, &part));
            before = after;
        }
        for place in (0..detached.points.len()).filter(|&place| crowd.is_changed[place]) {
            let state = &mut detached.state;
            (state.position[place], state.velocity[place]) = (convert(crowd.x[place]), convert(crowd.v[place]));
            (state.position_lost[place], state.velocity_lost[place]) = (zero(), zero());
        }
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
            list[place_of_root[root]].bonds.push([from, to]);
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
    fn way(&self, x: [f64; D]) -> [f64; D] {
        sub(self.placement.place(x), x)
    }

    fn is_free(&self, x: [f64; D]) -> bool {
        depth(self.after, x).is_none()
    }

    /// Whether what stands leaves room there, or did not where it was.
    fn has_room(&self, from: [f64; D], to: [f64; D]) -> bool {
        depth(self.others, to).is_none() || depth(self.others, from).is_some()
    }

    /// What the obstacle came to be around a point.
    fn touch(&self, x: [f64; D]) -> Option<Touch<D>> {
        let (depth_after, normal) = depth(self.after, x)?;
        if depth(self.before, x).is_some() {
            return None;
        }
        let speed = dot(self.way(x), normal).max(0.0) / self.seconds;
        Some(Touch { at: x, depth: depth_after, normal, speed })
    }

    /// The place on a bond that the obstacle came to go through, with both ends outside.
    fn pierced(&self, [a, b]: [[f64; D]; 2]) -> Option<Touch<D>> {
        let share = pierced(self.after, [a, b])?;
        if pierced(self.before, [a, b]).is_some() || !self.is_free(a) || !self.is_free(b) {
            return None;
        }
        let at = add(a, scale(sub(b, a), share));
        let way = self.way(at);
        let far = length(way);
        (far > 0.0).then(|| Touch { at, depth: far, normal: scale(way, 1.0 / far), speed: far / self.seconds })
    }
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
        let met = obstacles.meeting(a, b, |_| true)?;
        return (obstacles.surfaces[met.surface].gap(b) < -obstacles.slack()).then_some(met.share);
    }
    (!obstacles.convex().is_empty() && obstacles.pierces_convex(a, b)).then_some(0.5)
}

impl<const D: usize> Crowd<D> {
    fn extent(&self, body: &Hanging) -> Option<[[f64; D]; 2]> {
        let mut places = body.points.iter().map(|&i| self.x[i]);
        let first = places.next()?;
        Some(places.fold([first; 2], |[low, high], x| {
            [std::array::from_fn(|k| low[k].min(x[k])), std::array::from_fn(|k| high[k].max(x[k]))]
        }))
    }

    /// Pushes a body ahead.
    fn push(&mut self, body: &Hanging, part: &Part<'_, D>) {
        if !self.extent(body).is_some_and(|around| part.after.may_touch(around)) {
            return;
        }
        match body.is_rigid && !body.is_pinned {
            true => self.push_whole(body, part),
            false => self.push_points(body, part),
        }
    }

    /// Each point by itself, and each bond by both of its ends.
    fn push_points(&mut self, body: &Hanging, part: &Part<'_, D>) {
        for &i in &body.points {
            if self.w[i] == 0.0 {
                continue;
            }
            let Some(touch) = part.touch(self.x[i]) else { continue };
            let way = part.way(self.x[i]);
            let [mut short, mut far] = [0.0, 1.0];
            for _ in 0..HALVINGS {
                let middle = 0.5 * (short + far);
                *(if part.is_free(add(self.x[i], scale(way, middle))) { &mut far } else { &mut short }) = middle;
            }
            self.go(i, scale(way, far), part);
            self.hurry(i, &touch);
        }
        for _ in 0..ROUNDS {
            let mut is_done = true;
            for &ends in &body.bonds {
                let Some(touch) = part.pierced(ends.map(|end| self.x[end])) else { continue };
                for i in ends {
                    if self.w[i] == 0.0 {
                        continue;
                    }
                    is_done = false;
                    self.go(i, part.way(self.x[i]), part);
                    self.hurry(i, &touch);
                }
            }
            if is_done {
                return;
            }
        }
    }

    /// A point goes so far `[m]`, if there is room.
    fn go(&mut self, i: usize, way: [f64; D], part: &Part<'_, D>) {
        let to = add(self.x[i], way);
        if part.has_room(self.x[i], to) {
            (self.x[i], self.is_changed[i]) = (to, true);
        }
    }

    /// A point gets the speed of what pushes it.
    fn hurry(&mut self, i: usize, touch: &Touch<D>) {
        let lacking = touch.speed - dot(self.v[i], touch.normal);
        if lacking > 0.0 {
            (self.v[i], self.is_changed[i]) = (add(self.v[i], scale(touch.normal, lacking)), true);
        }
    }

    /// All that pushes a body now.
    fn touches(&self, body: &Hanging, part: &Part<'_, D>) -> Vec<Touch<D>> {
        let mut touches: Vec<Touch<D>> = body.points.iter().filter_map(|&i| part.touch(self.x[i])).collect();
        if touches.is_empty() {
            touches.extend(body.bonds.iter().filter_map(|ends| part.pierced(ends.map(|end| self.x[end]))));
        }
        touches
    }

    /// A body of one piece: where it is pushed it goes and turns as its mass says, and gets the speeds.
    fn push_whole(&mut self, body: &Hanging, part: &Part<'_, D>) {
        let touches = self.touches(body, part);
        if touches.is_empty() {
            return;
        }
        let inert = self.inert(body);
        let before: Vec<[f64; D]> = body.points.iter().map(|&i| self.x[i]).collect();
        for _ in 0..ROUNDS {
            let deepest = self.touches(body, part).into_iter().max_by(|a, b| a.depth.total_cmp(&b.depth));
            let Some(touch) = deepest else { break };
            let (arm, weight) = inert.at(&touch);
            let blow = touch.depth / weight;
            let (by, angle) = (scale(touch.normal, blow / inert.mass), blow * arm / inert.inertia);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            for &i in &body.points {
                let mut from = sub(self.x[i], inert.middle);
                (from[0], from[1]) = (cos * from[0] - sin * from[1], sin * from[0] + cos * from[1]);
                self.x[i] = add(add(inert.middle, from), by);
            }
        }
        if !self.touches(body, part).is_empty() {
            // As far as the obstacle goes it is as free as it was.
            let way = part.way(inert.middle);
            body.points.iter().zip(&before).for_each(|(&i, &x)| self.x[i] = add(x, way));
        }
        if body.points.iter().zip(&before).any(|(&i, &x)| !part.has_room(x, self.x[i])) {
            body.points.iter().zip(&before).for_each(|(&i, &x)| self.x[i] = x);
        }
        let (mut velocity, mut spin) = (inert.velocity, inert.spin);
        for _ in 0..BLOWS {
            for touch in &touches {
                let (arm, weight) = inert.at(touch);
                let lacking = touch.speed - dot(velocity, touch.normal) - spin * arm;
                if lacking > 0.0 {
                    let blow = lacking / weight;
                    velocity = add(velocity, scale(touch.normal, blow / inert.mass));
                    spin += blow * arm / inert.inertia;
                }
            }
        }
        let (faster, turns) = (sub(velocity, inert.velocity), spin - inert.spin);
        for (&i, &x) in body.points.iter().zip(&before) {
            let from = sub(x, inert.middle);
            let mut more = faster;
            (more[0], more[1]) = (more[0] - turns * from[1], more[1] + turns * from[0]);
            (self.v[i], self.is_changed[i]) = (add(self.v[i], more), true);
        }
    }

    /// A body as one piece.
    fn inert(&self, body: &Hanging) -> Inert<D> {
        let mass = |i: usize| 1.0 / self.w[i];
        let whole: f64 = body.points.iter().map(|&i| mass(i)).sum();
        let mean = |of: &[[f64; D]]| {
            let sum = body.points.iter().fold(zero(), |sum, &i| add(sum, scale(of[i], mass(i))));
            scale(sum, 1.0 / whole)
        };
        let (middle, velocity) = (mean(&self.x), mean(&self.v));
        let (mut inertia, mut turning) = (0.0, 0.0);
        for &i in &body.points {
            let (from, v) = (sub(self.x[i], middle), sub(self.v[i], velocity));
            inertia += mass(i) * dot(from, from);
            turning += mass(i) * (from[0] * v[1] - from[1] * v[0]);
        }
        Inert { middle, velocity, mass: whole, inertia, spin: turning / inertia }
    }

    /// A body that stands on the obstacles, with its middle over where it touches them, goes along as far as friction lets it: it gets
    /// what brakes it until the next way too, and is put on by what that takes of its own.
    fn carry(
        &mut self,
        body: &Hanging,
        (obstacles, near): (&Obstacles<f64, D>, f64),
        (placement, seconds): (&Placement, f64),
        (gravity, friction): ([f64; D], f64),
    ) {
        let pull = length(gravity);
        let slacks = near / obstacles.slack();
        let Some(mut around) = self.extent(body) else { return };
        for k in 0..D {
            (around[0][k], around[1][k]) = (around[0][k] - near, around[1][k] + near);
        }
        if pull == 0.0 || friction == 0.0 || !obstacles.may_touch(around) {
            return;
        }
        let up = scale(gravity, -1.0 / pull);
        let (mut normal, mut ends, mut count) = (zero::<f64, D>(), [f64::INFINITY, f64::NEG_INFINITY], 0_u32);
        let aside = |x: [f64; D], along: [f64; D]| dot(x, along);
        let along = {
            let mut along = zero::<f64, D>();
            (along[0], along[1]) = (up[1], -up[0]);
            along
        };
        for &i in &body.points {
            let x = self.x[i];
            let plane = obstacles.planes().iter().find(|plane| plane.gap(x).abs() <= near).map(|plane| plane.normal);
            let mut found = plane;
            obstacles.touching(x, slacks, |wall| {
                let own = obstacles.surfaces[wall].normal;
                found = found.filter(|best| dot(*best, up) >= dot(own, up)).or(Some(own));
            });
            let Some(own) = found.filter(|own| dot(*own, up) > 0.0) else { continue };
            (normal, count) = (add(normal, own), count + 1);
            let at = aside(x, along);
            ends = [ends[0].min(at), ends[1].max(at)];
        }
        if count == 0 {
            return;
        }
        let inert = self.inert(body);
        let far = aside(inert.middle, along);
        if far < ends[0] - near || far > ends[1] + near {
            return;
        }
        normal = scale(normal, 1.0 / length(normal).max(f64::MIN_POSITIVE));
        let way = sub(placement.place(inert.middle), inert.middle);
        let flat = |v: [f64; D]| sub(v, scale(normal, dot(v, normal)));
        let goes = scale(flat(way), 1.0 / seconds);
        let (lacking, brake) = (sub(goes, flat(inert.velocity)), friction * pull * dot(up, normal) * seconds);
        let most = 2.0 * brake;
        let size = length(lacking);
        let more = if size > most { scale(lacking, most / size) } else { lacking };
        let speed = length(goes);
        // What the step makes of that speed is less than the way.
        let lost =
            if speed > brake { 0.5 * brake * seconds } else { speed * seconds - 0.5 * speed * speed * seconds / brake };
        let on = if size > most || speed == 0.0 { zero() } else { scale(goes, lost / speed) };
        for &i in &body.points {
            (self.x[i], self.v[i]) = (add(self.x[i], on), add(self.v[i], more));
            self.is_changed[i] = true;
        }
    }
}

/// A body as one piece: its middle `[m]`, mass `[kg]`, inertia `[kg m^2]` and motion.
struct Inert<const D: usize> {
    middle: [f64; D],
    velocity: [f64; D],
    mass: f64,
    inertia: f64,
    spin: f64,
}

impl<const D: usize> Inert<D> {
    /// The arm of a blow there `[m]`, and what one of 1 kg m/s makes its place faster by `[1/kg]`.
    fn at(&self, touch: &Touch<D>) -> (f64, f64) {
        let from = sub(touch.at, self.middle);
        let arm = from[0] * touch.normal[1] - from[1] * touch.normal[0];
        (arm, 1.0 / self.mass + arm * arm / self.inertia)
    }
}
