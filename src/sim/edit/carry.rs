//! What stands on obstacles that go on their way goes along, as far as friction lets it.

use super::crowd::{Crowd, Hanging};
use super::shift::Placement;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::vector::{add, dot, length, scale, sub, zero};

impl<const D: usize> Crowd<D> {
    /// A body that stands on the obstacles, with its middle over where it touches them, goes along as far as friction lets it: it gets
    /// what brakes it until the next way too, and is put on by what that takes of its own.
    pub(super) fn carry(
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
