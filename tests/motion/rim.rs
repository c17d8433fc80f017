//! The gallery's rim: it stands, a quick pass of the mouse dents it, and it recovers.

use wobble::scene::Scene;
use wobble::scene::record::record;
use wobble::sim::Sample;

const RADIUS: f64 = 2.0;

/// How far the farthest diameter of the outer ring is from what it is at rest [m].
fn dent(sample: &Sample) -> f64 {
    let diameter = |i: usize| {
        let (a, b) = (sample.position[i], sample.position[i + 6]);
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    (0..6).map(|i| (diameter(i) - 2.0 * RADIUS).abs()).fold(0.0, f64::max)
}

#[test]
fn the_rim_stands_is_dented_by_a_third_and_recovers() {
    // The mouse comes from far away at 8 s and goes through the rim, from wall to wall, at 8 m/s.
    let text = include_str!("../../assets/scenes/rim.json").replace(
        "\"radius\": 1 }",
        "\"radius\": 1, \"track\": [[0, -50, 50], [7.999, -50, 50], [8, -5, -2], [9.25, 5, -2], [9.251, 50, 50]] }",
    );
    let scene = Scene::parse(&text, "rim.json").unwrap();
    let mut world = scene.world(None).unwrap();
    let before = &record(&mut *world, &[7.9], |_| {}).unwrap()[0];
    let heights = before.position.iter().map(|x| x[1]);
    let height = heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min);
    assert!(2.0 * RADIUS - height < 0.1 * RADIUS, "it sags by {} m", 2.0 * RADIUS - height);
    let times: Vec<f64> = (0..13).map(|i| 8.0 + 0.1 * f64::from(i)).collect();
    let passing = record(&mut *world, &times, |_| {}).unwrap();
    let deepest = passing.iter().map(dent).fold(0.0, f64::max);
    assert!((0.25..0.5).contains(&(deepest / RADIUS)), "dented by {deepest} m");
    let after = &record(&mut *world, &[11.25], |_| {}).unwrap()[0];
    assert!(dent(after) < 0.1 * RADIUS, "2 s after the pass it is {} m off", dent(after));
}
