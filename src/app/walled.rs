//! Where walls stand that are put up in space: around all that is there, with room to move.

use super::player::Shown;

/// Room on each side, in the longest side of what is there `[1]`: a body that is thrown has some way to go.
const ROOM: f64 = 0.5;
/// They lie on multiples of a power of ten that goes so often into their longest side, at least `[1]`.
const STEPS: f64 = 10.0;

/// The lower and the upper corner of walls about all points, balls and boxes `[m]`; where there are none, of what a camera sees that looks at
/// `middle` and shows so much height.
pub(super) fn about(shown: &Shown, (middle, height): ([f64; 3], f64)) -> [[f64; 3]; 2] {
    let points = (0..shown.point_count()).map(|point| shown.place(point));
    let solids = shown.scenery.convex.iter().flat_map(|convex| convex.figure.extent());
    let places = points.chain(solids).filter(|place| place.iter().all(|x| x.is_finite()));
    let empty = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let [mut low, mut high] = places.fold(empty, |[low, high], place| {
        [std::array::from_fn(|k| low[k].min(place[k])), std::array::from_fn(|k| high[k].max(place[k]))]
    });
    let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    // A single point has no side.
    let room = if longest > 0.0 { ROOM * longest } else { ROOM * height };
    if low[0] > high[0] {
        (low, high) = (middle, middle);
    }
    let step = 10_f64.powf(((longest + 2.0 * room) / STEPS).log10().floor());
    [low.map(|x| ((x - room) / step).floor() * step), high.map(|x| ((x + room) / step).ceil() * step)]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::Stage;
    use crate::scene::Scene;

    fn shown(text: &str) -> Shown {
        let mut shown = Shown::default();
        Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap().show(&mut shown);
        shown
    }

    /// To a step of what they are rounded to.
    fn is_near(of: [[f64; 3]; 2], to: [[f64; 3]; 2]) -> bool {
        of.iter().flatten().zip(to.iter().flatten()).all(|(a, b)| (a - b).abs() < 0.11)
    }

    #[test]
    fn walls_stand_around_bodies_and_solid_obstacles_with_room() {
        let text = r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[0, 0, 0], [2, 1, -1]]},
            "obstacles": [{"circle": {"center": [-1, 0, 0], "radius": 1}}]}"#;
        assert!(is_near(about(&shown(text), ([0.0; 3], 3.0)), [[-4.0, -3.0, -3.0], [4.0, 3.0, 3.0]]));
    }

    #[test]
    fn where_nothing_is_they_stand_around_what_is_looked_at() {
        let empty = shown(r#"{"wobble": 1, "dimensions": 3}"#);
        assert!(is_near(about(&empty, ([1.0, 2.0, 3.0], 4.0)), [[-1.0, 0.0, 1.0], [3.0, 4.0, 5.0]]));
        let one = shown(r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[5, 5, 5]]}}"#);
        let [low, high] = about(&one, ([0.0; 3], 2.0));
        assert!((0..3).all(|k| low[k] < 5.0 && high[k] > 5.0), "{low:?} {high:?}");
    }
}
