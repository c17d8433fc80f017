//! Which bodies go together, and their state: copied for the step and back.

use super::Space;
use super::body::Body;
use super::bonds::Held;
use super::cluster::{Cluster, Common, Counts};
use super::patches::Patches;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::live::FRAMES;
use crate::sim::live::gather::{PROMISE, WAY, affordable, asked, enough};
use crate::sim::live::given::Given;
use crate::sim::live::work_of_a_substep;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::swept::{self, Span, Swept};
use crate::sim::vector::{length, zero};

impl<S: Real> Space<S> {
    /// The clusters of what is awake, in the order of their lowest bodies.
    pub(super) fn gather(
        &self,
        points: &Points<S, 3>,
        common: &Common<S>,
        (pull, around): (&Pull<S, 3>, &Environment<3>),
        h: f64,
    ) -> Vec<Cluster<S>> {
        let is_there = |body: &usize| self.bodies.list[*body].points.len() > 0;
        let all = 0..self.bodies.list.len();
        let mut together = crate::sim::sets::Sets::new(self.bodies.list.len());
        if self.contact.is_some_and(|contact| contact.with_others) {
            let span = pull.span(around, h);
            let obstacles = &pull.contacts.obstacles;
            let settled = |swept: Swept<S, 3>| swept.settled(|bounds| obstacles.may_touch(bounds));
            let reach = |body| Some((body, settled(self.reach(body, points, span)?)));
            swept::join(&mut together, all.clone().filter_map(reach).collect(), settled);
        }
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); self.bodies.list.len()];
        all.filter(is_there).for_each(|body| members[together.find(body as u32) as usize].push(body));
        let is_awake = |bodies: &Vec<usize>| bodies.iter().any(|&body| !self.rests[body].is_asleep);
        members.retain(is_awake);
        let of = |&body: &usize| {
            let body = &self.bodies.list[body];
            work_of_a_substep([body.points.len(), body.springs.len() + body.holds.len(), body.triangles.len()])
        };
        let most_substeps = affordable(members.iter().flatten().map(of).sum());
        members.into_iter().map(|bodies| Cluster { most_substeps, ..self.cluster(bodies, points, common) }).collect()
    }

    /// Where the points of a body may get to, and what is near.
    fn reach(&self, body: usize, points: &Points<S, 3>, span: Span) -> Option<Swept<S, 3>> {
        let of = &self.bodies.list[body];
        let own = self.bodies.order[of.points.range()].iter().map(|&slot| slot as usize);
        let margin = of.edge_length * S::from_f64(2.0 * PROMISE) + of.radius;
        Swept::of(points, own, span, margin)
    }

    fn cluster(&self, bodies: Vec<usize>, points: &Points<S, 3>, common: &Common<S>) -> Cluster<S> {
        let own: usize = bodies.iter().map(|&body| self.bodies.list[body].points.len()).sum();
        let mut cluster = Cluster {
            torn: Vec::new(),
            touched: bodies.iter().map(|&body| self.rests[body].touches).collect(),
            bases: vec![0],
            start: Vec::new(),
            now: Vec::with_capacity(own),
            way: vec![zero(); own],
            turned: vec![zero(); own],
            velocity: Vec::with_capacity(own),
            lost: Vec::with_capacity(own),
            w: Vec::with_capacity(own),
            thrust: Vec::new(),
            body_of: Vec::with_capacity(own),
            triangles: Vec::new(),
            edges: Vec::new(),
            corners: Vec::new(),
            held: Held::default(),
            pairs: Vec::new(),
            touches: Vec::new(),
            touch_rooms: Vec::new(),
            near: Vec::new(),
            rooms: Vec::new(),
            chosen: Vec::new(),
            promised_far: vec![S::ZERO; own],
            gone_far: vec![S::ZERO; own],
            promised: vec![S::ZERO; own],
            gone_apart: vec![S::ZERO; own],
            goes: vec![S::ZERO; own],
            ways: vec![S::ZERO; own],
            patches: Patches::default(),
            least_promise: S::INFINITY,
            most_substeps: 0,
            span: S::ZERO,
            has_pressed: false,
            work: S::ZERO,
            given: Given::none(),
            counts: Counts::default(),
            bodies,
        };
        for k in 0..cluster.bodies.len() {
            let body = &self.bodies.list[cluster.bodies[k]];
            let base = cluster.now.len() as u32;
            for &slot in &self.bodies.order[body.points.range()] {
                let i = slot as usize;
                cluster.now.push(points.position[i]);
                cluster.velocity.push(points.velocity[i]);
                cluster.lost.push(points.position_lost.get(i).copied().unwrap_or(zero()));
                cluster.w.push(points.inverse_mass[i]);
                cluster.body_of.push(k as u32);
            }
            cluster.bases.push(cluster.now.len() as u32);
            let corners = self.bodies.corners[body.corners.range()].iter();
            cluster.corners.extend(corners.map(|&local| (base + local, body.points.first + local)));
            let triangles = self.bodies.triangles[body.triangles.range()].iter().zip(body.triangles.first..);
            cluster.triangles.extend(triangles.map(|(at, number)| (at.map(|local| base + local), number, k as u32)));
            let edges = self.bodies.edges[body.edges.range()].iter();
            // Without contact points alone meet obstacles.
            if common.contact.is_some() {
                cluster.edges.extend(edges.map(|ends| ends.map(|local| base + local)));
            }
            if body.edge_length > S::ZERO {
                cluster.least_promise = cluster.least_promise.min(body.edge_length * S::from_f64(PROMISE));
            }
        }
        if common.contact.is_none() {
            cluster.triangles.clear();
        }
        if !cluster.least_promise.is_finite() {
            cluster.least_promise = S::from_f64(PROMISE * 0.1);
        }
        cluster.start.clone_from(&cluster.now);
        if !self.thrust.is_empty() {
            for &body in &cluster.bodies {
                let slots = &self.bodies.order[self.bodies.list[body].points.range()];
                cluster.thrust.extend(slots.iter().map(|&slot| self.thrust[slot as usize]));
            }
        }
        cluster
    }

    /// Writes the state of a cluster back.
    pub(super) fn scatter(&self, cluster: &Cluster<S>, points: &mut Points<S, 3>) {
        for (k, &body) in cluster.bodies.iter().enumerate() {
            let base = cluster.bases[k] as usize;
            for (i, &slot) in (base..).zip(&self.bodies.order[self.bodies.list[body].points.range()]) {
                points.position[slot as usize] = cluster.now[i];
                points.velocity[slot as usize] = cluster.velocity[i];
                if let Some(lost) = points.position_lost.get_mut(slot as usize) {
                    *lost = cluster.lost[i];
                }
            }
        }
    }
}

impl<S: Real> Cluster<S> {
    /// Substeps of a frame that the fastest point needs, and springs.
    pub(super) fn substeps(&self, common: &Common<S>, pull: &Pull<S, 3>, around: &Environment<3>, t: f64) -> u32 {
        let frame = 1.0 / FRAMES;
        let pushed = around.mouse_at(t).map_or(0.0, |(force, _)| force.strength.abs() * force.radius);
        let pulled = length(around.gravity) + pull.most_push();
        let speed = self.fastest().to_f64() + frame * (pulled + pushed);
        let shortest = self.least_promise.to_f64() / PROMISE;
        let wanted = speed * frame / (WAY * shortest);
        let flying = self.members(common).zip(&self.touched).filter(|(_, touched)| !**touched);
        let asked = |body: &Body<S>| asked(body.least_substeps, self.most_substeps, body.springs.len() > 0);
        let least = flying.filter_map(|((body, _), _)| asked(body)).max().unwrap_or_default();
        enough(wanted, least)
    }

    /// Adds what it did.
    pub(super) fn count(&self, counters: &mut Counters) {
        let counts = &self.counts;
        counters.substeps += counts.substeps;
        counters.points_moved += counts.points;
        counters.bonds_solved += counts.bonds;
        counters.mouse_points += counts.mouse_points;
        counters.contacts += counts.contacts;
        counters.truncations += counts.truncations;
        counters.guarded += counts.guarded;
        counters.detections += counts.detections;
        counters.work += counts.work;
    }
}
