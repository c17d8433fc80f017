//! Where what hangs on pins may swing to: a view that nothing says has room for that from the first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::extent::include;
use crate::render::View;
use crate::scene::Scene;

/// Points and pins of scenes that are looked through: what hangs on more is a net or a cloth, whose place its start says well.
const MOST: [usize; 2] = [2_000, 16];
/// Gravity this much off the vertical is straight down `[1]`.
const UPRIGHT: f64 = 1e-9;

/// The box in which what hangs on pins stays `[m]`, if it starts at rest and its bonds keep their lengths: no further from each pin than its bonds
/// are long, no higher than its highest point, and within walls. `None`: nothing hangs there, or the scene's `view` says how high it is.
pub(super) fn swung(scene: &Scene, seen: &View<'_>) -> Option<[[f64; 3]; 2]> {
    let count = seen.current.len() / seen.dimensions.max(1);
    let is_small = seen.dimensions == 2 && count <= MOST[0] && (1..=MOST[1]).contains(&seen.pinned.len());
    let is_said = scene.view.as_ref().is_some_and(|view| view.height.is_some());
    let [across, down, _] = scene.gravity.map_or([0.0; 3], |gravity| gravity.embed());
    if !is_small || is_said || !(down < 0.0 && across.abs() <= UPRIGHT * -down) {
        return None;
    }
    let at = |point: u32| [0, 1].map(|axis| seen.current.get(2 * point as usize + axis));
    let apart = |[a, b]: [u32; 2]| {
        let ([ax, ay], [bx, by]) = (at(a), at(b));
        (bx - ax).hypot(by - ay)
    };
    let mut beside = vec![Vec::new(); count];
    for [a, b] in seen.bonds.ends().iter().map(|ends| ends.map(|end| end.0)) {
        beside[a as usize].push(b);
        beside[b as usize].push(a);
    }
    let is_pin = |point: u32| seen.pinned.iter().any(|pin| pin.0 == point);
    // Where each point stays; `None`: it hangs on no pin.
    let mut stays: Vec<Option<[[f64; 2]; 2]>> = vec![None; count];
    for pin in seen.pinned.iter().map(|pin| pin.0) {
        let far = lengths(pin, &beside, apart, is_pin);
        let hung = || (0..count as u32).filter(|&point| point != pin && far[point as usize].is_finite());
        let top = hung().map(|point| at(point)[1]).fold(f64::NEG_INFINITY, f64::max);
        let [x, y] = at(pin);
        for point in hung() {
            let r = far[point as usize];
            let below = (y - top).clamp(0.0, r);
            let wide = (r * r - below * below).sqrt();
            let own = [[x - wide, y - r], [x + wide, top.min(y + r)]];
            let both = stays[point as usize].map_or(own, |[low, high]| {
                [[0, 1].map(|k| low[k].max(own[0][k])), [0, 1].map(|k| high[k].min(own[1][k]))]
            });
            stays[point as usize] = Some(both);
        }
    }
    let mut corners = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    stays.into_iter().flatten().flatten().for_each(|corner| include(&mut corners, &corner));
    if let Some([low, high]) = seen.bounds {
        for k in 0..2 {
            (corners[0][k], corners[1][k]) = (corners[0][k].max(low[k]), corners[1][k].min(high[k]));
        }
    }
    (0..2).all(|k| corners[0][k] <= corners[1][k]).then_some(corners)
}

/// How far points are from a pin along bonds, not through other pins `[m]`; infinite: not joined to it.
fn lengths(pin: u32, beside: &[Vec<u32>], apart: impl Fn([u32; 2]) -> f64, is_pin: impl Fn(u32) -> bool) -> Vec<f64> {
    let mut far = vec![f64::INFINITY; beside.len()];
    far[pin as usize] = 0.0;
    // Lengths are no less than 0: their bits are in their order.
    let mut next = BinaryHeap::from([Reverse((0, pin))]);
    while let Some(Reverse((bits, point))) = next.pop() {
        let so_far = f64::from_bits(bits);
        if so_far > far[point as usize] {
            continue;
        }
        for &other in &beside[point as usize] {
            let length = so_far + apart([point, other]);
            if length < far[other as usize] && !is_pin(other) {
                far[other as usize] = length;
                next.push(Reverse((length.to_bits(), other)));
            }
        }
    }
    far
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn swung_of(keys: &str) -> Option<[[f64; 2]; 2]> {
        let scene = Scene::parse(&format!(r#"{{"wobble": 1, {keys}}}"#), "x.json").unwrap();
        let world = scene.world(None).unwrap();
        let corners = swung(&scene, &View::of(&*world));
        corners.map(|corners| corners.map(|[x, y, _]| [x, y].map(|x| (1e6 * x).round() / 1e6)))
    }

    #[test]
    fn a_pendulum_swings_to_the_other_side_and_through_its_lowest_place() {
        let pendulum = |more: &str| {
            swung_of(&format!(
                r#""points": {{"position": [[0, 0], [0.6, -0.8]], "pinned": [0]}}, "bonds": [{{"a": 0, "b": 1}}]{more}"#
            ))
        };
        assert_eq!(pendulum(r#", "gravity": [0, -9.81]"#), Some([[-0.6, -1.0], [0.6, -0.8]]));
        assert_eq!(pendulum(""), None, "nothing pulls it");
        let walls = r#", "gravity": [0, -9.81], "bounds": {"min": [-0.5, -0.9], "max": [2, 2]}"#;
        assert_eq!(pendulum(walls), Some([[-0.5, -0.9], [0.6, -0.8]]));
        let said = r#", "gravity": [0, -9.81], "view": {"center": [0, 0], "height": 3}"#;
        assert_eq!(pendulum(said), None, "the file says what is seen");
    }

    #[test]
    fn a_rope_between_two_pins_stays_where_both_let_it() {
        let rope = r#""gravity": [0, -9.81], "points": {"position": [[0, 0], [1, 0], [2, 0], [3, 0]], "pinned": [0, 3]},
            "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}]"#;
        assert_eq!(swung_of(rope), Some([[1.0, -1.0], [2.0, 0.0]]));
    }

    #[test]
    fn what_starts_level_with_its_pin_swings_as_far_as_its_bonds_reach_and_what_falls_counts_for_nothing() {
        let chain = r#""gravity": [0, -1], "points": {"position": [[0, 0], [1, 0], [2, 0], [9, 9]], "pinned": [0]},
            "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}]"#;
        assert_eq!(swung_of(chain), Some([[-2.0, -2.0], [2.0, 0.0]]));
    }
}
