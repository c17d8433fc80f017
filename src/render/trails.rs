//! Trails: where chosen points have been of late.

use std::collections::{BTreeSet, VecDeque};

use glam::DVec3;

use super::view::View;
use super::watched::watched;
use crate::picture::Tint;
use crate::sim::PointId;

/// Points that are free to move, up to which all of them have trails unless anybody says otherwise.
const FEW: usize = 8;
/// Places of a point that are kept.
const PLACES: f64 = 150.0;

/// Where points have been, for as long as a trail lasts.
#[derive(Clone, Debug)]
pub struct Trails {
    /// `[s]` of the scene.
    length: f64,
    /// Those of the points that are followed.
    lines: Vec<Line>,
}

/// Where a point has been.
#[derive(Clone, Debug)]
struct Line {
    point: PointId,
    /// Times `[s]` with places `[m]`, oldest first.
    past: VecDeque<(f64, DVec3)>,
}

impl Trails {
    /// Trails that fade within `length` `[s]` of the scene.
    pub fn new(length: f64) -> Self {
        Trails { length, lines: Vec::new() }
    }

    /// How long they last `[s]` of the scene.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// They last so long from now on `[s]` of the scene.
    pub fn set_length(&mut self, length: f64) {
        self.length = length;
    }

    /// Whether the points of a world have trails by themselves: few of them are free, and nothing is covered.
    pub fn suit(view: &View<'_>) -> bool {
        let count = view.current.len() / view.dimensions.max(1);
        count <= FEW + view.pinned.len() && view.triangles.is_empty() && view.skins.is_empty()
    }

    /// At most `most` points to follow: those of `first`, one list after the other, then those that are looked at first, then all free ones. Of a list that is too long every
    /// second, third … of its points is followed.
    pub fn choose(view: &View<'_>, first: &[&[PointId]], most: usize) -> Vec<PointId> {
        let count = view.current.len() / view.dimensions.max(1);
        let pinned: BTreeSet<PointId> = view.pinned.iter().copied().collect();
        let free: Vec<PointId> = (0..count as u32).map(PointId).filter(|point| !pinned.contains(point)).collect();
        let mut list: Vec<PointId> = Vec::new();
        let watched = if free.len() > most { watched(view, &free) } else { Default::default() };
        for group in first.iter().copied().chain(watched.iter().map(Vec::as_slice)).chain([&free[..]]) {
            let left = most.saturating_sub(list.len());
            let taken: BTreeSet<PointId> = list.iter().copied().collect();
            let group: Vec<PointId> =
                group.iter().copied().filter(|point| point.index() < count && !taken.contains(point)).collect();
            let wanted = left.min(group.len());
            list.extend((0..wanted).map(|k| group[k * group.len() / wanted]));
        }
        list
    }

    /// Those that have trails by themselves.
    pub fn usual(view: &View<'_>) -> Vec<PointId> {
        if Trails::suit(view) { Trails::choose(view, &[], FEW) } else { Vec::new() }
    }

    /// Notes where the followed points are at a time `[s]`; of others nothing is kept. What was noted of later times is forgotten: time
    /// ran back.
    pub fn note(&mut self, time: f64, view: &View<'_>, followed: &[PointId]) {
        let is_same = self.lines.iter().map(|line| line.point).eq(followed.iter().copied());
        if !is_same {
            let mut before = std::mem::take(&mut self.lines);
            let line = |&point: &PointId| {
                let known = before.iter().position(|line| line.point == point);
                known.map_or_else(|| Line { point, past: VecDeque::new() }, |place| before.swap_remove(place))
            };
            self.lines = followed.iter().map(line).collect();
        }
        for line in &mut self.lines {
            let past = &mut line.past;
            while past.back().is_some_and(|(last, _)| *last >= time) {
                past.pop_back();
            }
            while past.front().is_some_and(|(first, _)| *first < time - self.length) {
                past.pop_front();
            }
            if past.back().is_none_or(|(last, _)| time - last >= self.length / PLACES) {
                past.push_back((time, place(view, line.point)));
            }
        }
    }

    /// Stretches of the trails: their ends `[m]`, and how fresh they are, 0 to 1. Those that are the view's own lead up to where its points
    /// are now; those of another world, which are compared there, end where its points were noted last. Points that are gone, which have no
    /// place, have none, and neither have hidden ones.
    pub(super) fn stretches(&self, view: &View<'_>, is_own: bool) -> Vec<([DVec3; 2], f64)> {
        let mut list = Vec::new();
        for Line { point, past } in &self.lines {
            let now = place(view, *point);
            if Tint::hides(view.tints, point.0) || !now.is_finite() {
                continue;
            }
            let places = past.iter().map(|(_, place)| *place);
            let pairs = places.clone().zip(places.skip(1).chain(is_own.then_some(now))).zip(1..);
            let all = pairs.map(|((a, b), count)| ([a, b], f64::from(count) / past.len() as f64));
            list.extend(all.filter(|([a, b], _)| a != b && a.is_finite() && b.is_finite()));
        }
        list
    }
}

/// Where a point is drawn `[m]`; no numbers where there is none.
fn place(view: &View<'_>, point: PointId) -> DVec3 {
    let (dimensions, mix) = (view.dimensions, f64::from(view.mix));
    if (point.index() + 1) * dimensions > view.current.len() {
        return DVec3::NAN;
    }
    DVec3::from_array(std::array::from_fn(|axis| {
        let place = dimensions * point.index() + axis;
        if axis >= dimensions {
            return 0.0;
        }
        let [from, to] = [view.previous.get(place), view.current.get(place)];
        from + mix * (to - from)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bonds, Positions};

    fn view<'a>(bonds: &'a Bonds, x: &'a [f64]) -> View<'a> {
        View { previous: Positions::F64(x), current: Positions::F64(x), ..View::empty(bonds, 2) }
    }

    fn points(numbers: &[u32]) -> Vec<PointId> {
        numbers.iter().copied().map(PointId).collect()
    }

    #[test]
    fn trails_fade_and_end_where_points_are_and_go_back_with_time() {
        let bonds = Bonds::default();
        let mut trails = Trails::new(1.5);
        let first = points(&[0]);
        let noted: [&[f64]; 4] = [&[0.0, 5.0], &[1.0, 5.0], &[2.0, 5.0], &[3.0, 5.0]];
        for (time, x) in [0.0, 1.0, 2.0, 3.0].into_iter().zip(noted) {
            trails.note(time, &view(&bonds, x), &first);
        }
        let now = [3.5, 5.0];
        let ends: Vec<f64> = trails.stretches(&view(&bonds, &now), true).iter().map(|(ends, _)| ends[1].x).collect();
        assert_eq!(ends, [3.0, 3.5], "what is older has faded");
        let foreign = trails.stretches(&view(&bonds, &now), false);
        assert_eq!(foreign.last().map(|(ends, _)| ends[1].x), Some(3.0), "no line leads to where another world has it");
        let gone = [f64::NAN, f64::NAN];
        assert!(trails.stretches(&view(&bonds, &gone), true).is_empty(), "the trail of a point goes with it");
        assert!(trails.stretches(&view(&bonds, &[]), true).is_empty(), "or it is not there at all");
        trails.note(2.5, &view(&bonds, &[2.5, 5.0]), &first);
        assert_eq!(trails.lines[0].past.len(), 2, "2 and 2.5");
        trails.note(4.0, &view(&bonds, &[0.0; 40]), &[]);
        assert!(trails.lines.is_empty(), "nobody is followed any more");
    }

    #[test]
    fn a_trail_stays_when_another_point_is_followed_too() {
        let bonds = Bonds::default();
        let mut trails = Trails::new(1.5);
        trails.note(0.0, &view(&bonds, &[0.0, 0.0, 7.0, 0.0]), &points(&[1]));
        trails.note(1.0, &view(&bonds, &[1.0, 0.0, 8.0, 0.0]), &points(&[0, 1]));
        let now = [2.0, 0.0, 9.0, 0.0];
        let starts: Vec<f64> = trails.stretches(&view(&bonds, &now), true).iter().map(|(ends, _)| ends[0].x).collect();
        assert_eq!(starts, [1.0, 7.0, 8.0]);
    }

    #[test]
    fn chosen_points_come_first_and_few_have_trails_by_themselves() {
        let bonds = Bonds::default();
        let x = [0.0; 40];
        let pinned = points(&[0, 1]);
        let world = View { pinned: &pinned, ..view(&bonds, &x) };
        assert!(Trails::usual(&world).is_empty(), "eighteen are free");
        assert_eq!(Trails::choose(&world, &[], 3), points(&[2, 8, 14]), "spread over all free ones");
        let chosen = [&points(&[5])[..], &points(&[9, 5, 11, 99])[..]];
        assert_eq!(Trails::choose(&world, &chosen, 2), points(&[5, 9]));
        assert_eq!(Trails::choose(&world, &chosen, 4)[..3], points(&[5, 9, 11]));
        let few = view(&bonds, &x[..8]);
        assert_eq!(Trails::usual(&few), points(&[0, 1, 2, 3]));
    }
}
