//! Where bodies have been in the last seconds: what is to lie beside them lies beside their ways, not beside where they are at one moment.

use std::collections::{BTreeSet, VecDeque};

use egui::{Pos2, pos2};

use super::player::Shown;

/// Places are noted so often `[s of wall time]` at the scene's own pace, and so many times are kept: five seconds.
const EVERY: f64 = 0.1;
const KEPT: usize = 50;
/// So many points and bonds of a scene are looked at: their ways weigh no more than all that is seen at one moment.
const MOST: usize = 20;
/// Places nearer to each other than this are one `[points]`.
const APART: f32 = 8.0;

/// Places of the last seconds, those of the last time last.
#[derive(Clone, Debug, Default)]
pub(super) struct Whereabouts {
    times: VecDeque<(f64, Vec<[f64; 3]>)>,
}

impl Whereabouts {
    /// Another scene is shown.
    pub(super) fn begin(&mut self) {
        self.times.clear();
    }

    /// Notes where bodies are, if it is time.
    pub(super) fn note(&mut self, shown: &Shown) {
        let (time, rate) = (shown.figures.time, shown.figures.rate);
        // Where time went back, bodies will be where they were.
        if self.times.back().is_some_and(|(last, _)| (time - last).abs() < EVERY * rate) {
            return;
        }
        let mut places = if self.times.len() < KEPT { None } else { self.times.pop_front() }.unwrap_or_default().1;
        places.clear();
        places.extend(places_of(shown, MOST));
        self.times.push_back((time, places));
    }

    /// Where bodies have been `[m]`.
    pub(super) fn places(&self) -> impl Iterator<Item = [f64; 3]> {
        self.times.iter().flat_map(|(_, places)| places.iter().copied())
    }
}

/// The places that are apart on the screen: what swings is in many, what stands still in one `[points]`.
pub(super) fn apart(points: impl Iterator<Item = Pos2>) -> impl Iterator<Item = Pos2> {
    let cells: BTreeSet<[i32; 2]> = points.map(|at| [at.x, at.y].map(|x| (x / APART).round() as i32)).collect();
    cells.into_iter().map(|[x, y]| pos2(APART * x as f32, APART * y as f32))
}

/// Where points are and the middles of bonds `[m]`, no more than about `most` of each: bonds are long, and what stands between their ends
/// is to be seen too.
pub(super) fn places_of(shown: &Shown, most: usize) -> impl Iterator<Item = [f64; 3]> {
    let bonds = &shown.scenery.bonds;
    let middle = |bond: usize| {
        let bond = bonds.get(bond);
        let [a, b] = [bond.a, bond.b].map(|end| shown.place(end.index()));
        std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
    };
    let middles = (0..bonds.len()).step_by(bonds.len() / most + 1).map(middle);
    let count = shown.point_count();
    (0..count).step_by(count / most + 1).map(|point| shown.place(point)).chain(middles)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::{Order, Stage};
    use crate::scene::gallery;

    #[test]
    fn the_ways_of_what_swings_are_known_for_some_seconds() {
        let scene = gallery().iter().find(|entry| entry.name == "spring-damper").unwrap().scene().unwrap();
        let (mut stage, mut shown, mut whereabouts) =
            (Stage::new(scene.into()).unwrap(), Shown::default(), Whereabouts::default());
        let mut lowest = f64::INFINITY;
        for _ in 0..210 {
            stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            stage.show(&mut shown);
            whereabouts.note(&shown);
            lowest = lowest.min(shown.place(1)[1]);
        }
        let is_below = |high: f64| whereabouts.places().any(|place| (place[0] + 3.0).abs() < 1e-6 && place[1] < high);
        assert!(is_below(lowest + 0.3), "the first weight was at {lowest} m");
        assert!(shown.place(1)[1] > lowest + 0.3, "it is not there now");
        let ways = whereabouts.places().count();
        assert!((16 * 29..=16 * 37).contains(&ways), "ten times a second of ten points and six bonds: {ways}");
        // What stands still is noted no more.
        (0..9).for_each(|_| whereabouts.note(&shown));
        assert_eq!(whereabouts.places().count(), ways);
        for _ in 0..600 {
            stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            stage.show(&mut shown);
            whereabouts.note(&shown);
        }
        assert_eq!(whereabouts.places().count(), 16 * KEPT);
        // What swings weighs more than what stands still.
        let way = (0..40).map(|k| pos2(300.0, 400.0 + 60.0 * (0.3 * k as f32).sin()));
        let still = (0..40).map(|_| pos2(90.0, 200.0));
        assert!(apart(way).count() > 10 && apart(still).count() == 1);
        whereabouts.begin();
        assert_eq!(whereabouts.places().count(), 0);
    }
}
