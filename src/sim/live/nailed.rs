//! What a pin holds within an obstacle passes obstacles: a limb that is nailed there cannot come out, and what pressed it out, substep after substep,
//! would throw it about its joints.
//!
//! How deep the far end of what is nailed stays at the least is the depth of the pin less its length: what is in a joint there may be held within
//! too.

use super::cluster::{Cluster, Common};
use super::rig::{Member, Rig};
use crate::sim::real::Real;
use crate::sim::rigid::link::End;
use crate::sim::vector::{dot, sub};

/// How deep a pin lies in an obstacle at least to hold something there, in quarters of an edge: what only rests on it is left to contacts.
const LEAST: f64 = 0.2;

impl<S: Real> Cluster<S> {
    /// Whether one of these points is of what is nailed.
    #[inline(always)]
    pub(super) fn passes_obstacles(&self, points: &[u32]) -> bool {
        !self.rigs.is_empty()
            && points.iter().any(|&i| self.frame_number(i as usize).is_some_and(|number| self.frames[number].is_nailed))
    }

    /// Looks what of bodies in joints is nailed as a step begins.
    pub(super) fn look_for_nails(&mut self, common: &Common<S>) {
        let least = (self.least_promise * S::from_f64(LEAST)).to_f64();
        for rigged in &self.rigs {
            let (rig, base) = (&rigged.rig, rigged.base);
            let depth = |&pin: &u32| common.walls.depth(self.now[base + pin as usize]).to_f64();
            let depths: Vec<f64> = rig.fixed.iter().map(depth).collect();
            let is_frame = |member: &&Member| matches!(member, Member::Frame(..));
            let count = rig.members.iter().filter(is_frame).count();
            let frames = &mut self.frames[rigged.first..rigged.first + count];
            frames.iter_mut().for_each(|frame| frame.is_nailed = false);
            if depths.iter().all(|&depth| depth <= least) {
                continue;
            }
            let held = held_within(rig, &depths, least);
            let of_frames = rig.members.iter().zip(held).filter(|(member, _)| is_frame(member));
            frames.iter_mut().zip(of_frames).for_each(|(frame, (_, is_held))| frame.is_nailed = is_held);
        }
    }
}

/// Which members of a rig stay deeper than `least` `[m]` in an obstacle with some of their points, whose pins lie so deep.
fn held_within(rig: &Rig, depths: &[f64], least: f64) -> Vec<bool> {
    let links = rig.joints.links();
    let mut deepest = vec![0.0; rig.members.len()];
    // Members, where they are held, and how deep that is at the least.
    let mut next: Vec<(u32, [f64; 2], f64)> = Vec::new();
    for link in links {
        if let [End::Fixed(pin), End::On { body, place }] | [End::On { body, place }, End::Fixed(pin)] = link.ends {
            next.push((body, place, depths[pin as usize] - link.rest.unwrap_or(0.0)));
        }
    }
    while let Some((body, at, depth)) = next.pop() {
        let known = &mut deepest[body as usize];
        if depth <= least || depth <= *known {
            continue;
        }
        *known = depth;
        for link in links {
            for [own, other] in [link.ends, [link.ends[1], link.ends[0]]] {
                if let (End::On { body: of, place }, End::On { body: to, place: there }) = (own, other)
                    && of == body
                {
                    let way = sub(place, at);
                    next.push((to, there, depth - dot(way, way).sqrt() - link.rest.unwrap_or(0.0)));
                }
            }
        }
    }
    deepest.iter().map(|&depth| depth > least).collect()
}
