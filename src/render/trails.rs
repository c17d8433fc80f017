//! Trails: where the points of a scene of few points have been of late.

use std::collections::VecDeque;

use glam::DVec3;

use super::view::View;
use crate::picture::Tint;

/// Points that are free to move, up to which they have trails.
const MOST: usize = 8;
/// Places of a point that are kept.
const PLACES: f64 = 150.0;

/// Where points have been, for as long as a trail lasts.
#[derive(Clone, Debug)]
pub struct Trails {
    /// `[s]` of the scene.
    length: f64,
    /// Times `[s]` with the places of all points then `[m]`, oldest first.
    past: VecDeque<(f64, Vec<DVec3>)>,
}

impl Trails {
    /// Trails that fade within `length` `[s]` of the scene.
    pub fn new(length: f64) -> Self {
        Trails { length, past: VecDeque::new() }
    }

    /// How long they last `[s]` of the scene.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Whether the points of a world have trails: few of them are free, and nothing is covered.
    pub fn suit(view: &View<'_>) -> bool {
        let count = view.current.len() / view.dimensions.max(1);
        count <= MOST + view.pinned.len() && view.triangles.is_empty() && view.skins.is_empty()
    }

    /// Notes where points are at a time `[s]`. What was noted of later times is forgotten: time ran back.
    pub fn note(&mut self, time: f64, view: &View<'_>) {
        if !Trails::suit(view) {
            return self.past.clear();
        }
        let places = places(view);
        while self.past.back().is_some_and(|(last, then)| *last >= time || then.len() != places.len()) {
            self.past.pop_back();
        }
        while self.past.front().is_some_and(|(first, _)| *first < time - self.length) {
            self.past.pop_front();
        }
        if self.past.back().is_none_or(|(last, _)| time - last >= self.length / PLACES) {
            self.past.push_back((time, places));
        }
    }

    /// Stretches of the trails up to where points are now: their ends `[m]`, and how fresh they are, 0 to 1. Points that are gone, which
    /// have no place, have none, and neither have hidden ones.
    pub(super) fn stretches(&self, view: &View<'_>) -> Vec<([DVec3; 2], f64)> {
        let mut now = places(view);
        for (point, place) in (0..).zip(&mut now) {
            if Tint::hides(view.tints, point) {
                *place = DVec3::NAN;
            }
        }
        let count = self.past.len();
        let ends = self.past.iter().map(|(_, places)| places).chain([&now]);
        let pairs = self.past.iter().map(|(_, places)| places).zip(ends.skip(1)).enumerate();
        let mut list = Vec::new();
        for (place, (from, to)) in pairs {
            let fresh = (place + 1) as f64 / count as f64;
            let all = from.iter().zip(to).zip(&now).filter(|(_, now)| now.is_finite()).map(|(ends, _)| ends);
            let moved = all.filter(|(a, b)| a != b && a.is_finite() && b.is_finite());
            list.extend(moved.map(|(a, b)| ([*a, *b], fresh)));
        }
        list
    }
}

/// Where the points are drawn `[m]`.
fn places(view: &View<'_>) -> Vec<DVec3> {
    let (count, mix) = (view.current.len() / view.dimensions.max(1), f64::from(view.mix));
    let at = |point: usize| {
        DVec3::from_array(std::array::from_fn(|axis| {
            let place = view.dimensions * point + axis;
            if axis >= view.dimensions {
                return 0.0;
            }
            let [from, to] = [view.previous.get(place), view.current.get(place)];
            from + mix * (to - from)
        }))
    };
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bonds, Positions};

    #[test]
    fn trails_fade_and_end_where_points_are_and_go_back_with_time() {
        let bonds = Bonds::default();
        let mut trails = Trails::new(1.5);
        let view = |x: &'static [f64]| View {
            previous: Positions::F64(x),
            current: Positions::F64(x),
            ..View::empty(&bonds, 2)
        };
        let noted: [&[f64]; 4] = [&[0.0, 5.0], &[1.0, 5.0], &[2.0, 5.0], &[3.0, 5.0]];
        for (time, x) in [0.0, 1.0, 2.0, 3.0].into_iter().zip(noted) {
            trails.note(time, &view(x));
        }
        let ends: Vec<f64> = trails.stretches(&view(&[3.5, 5.0])).iter().map(|(ends, _)| ends[1].x).collect();
        assert_eq!(ends, [3.0, 3.5], "what is older has faded");
        assert!(trails.stretches(&view(&[f64::NAN, f64::NAN])).is_empty(), "the trail of a point goes with it");
        trails.note(2.5, &view(&[2.5, 5.0]));
        assert_eq!(trails.past.len(), 2, "2 and 2.5");
        trails.note(4.0, &view(&[0.0; 40]));
        assert!(trails.past.is_empty(), "twenty points have none");
    }
}
