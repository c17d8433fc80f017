//! Circles that do not move, large ones and thin pegs: they are met as what they are, by points and by edges.

use serde_json::{Value, json};
use wobble::sim::{Command, Dynamics, Motion, PointId, Sample, Selection, Why};

use super::{disc, fastest, middle, run, soft, world};

/// Depth up to which something counts as on a circle [m]: a tenth of a peg.
const SKIN: f64 = 2e-3;
/// Radius of a peg [m].
const PEG: f64 = 0.02;

fn circle(center: [f64; 2], radius: f64) -> Value {
    json!({"circle": {"center": center, "radius": radius}, "friction": 0.5})
}

fn rigid_box(at: [f64; 2], velocity: [f64; 2]) -> Value {
    json!({"make": "box", "width": 0.6, "height": 0.6, "supports": 2, "origin": at, "velocity": velocity,
        "material": {"kind": "rigid", "mass": 1}})
}

/// A scene that the live step moves.
fn scene(bodies: &[Value], obstacles: &[Value]) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"solver": "live"}, "bodies": bodies,
        "obstacles": obstacles})
}

/// The edges of the skins of bodies of triangles; of others all bonds.
fn skins(world: &dyn Dynamics) -> Vec<[usize; 2]> {
    let sorted = |[a, b]: [PointId; 2]| [a.index().min(b.index()), a.index().max(b.index())];
    let triangles = world.triangles();
    if triangles.is_empty() {
        return world.bonds().iter().map(|bond| sorted([bond.a, bond.b])).collect();
    }
    let mut edges: Vec<[usize; 2]> =
        triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]].map(sorted)).collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]).collect()
}

/// How far the nearest edge of a skin is from a circle [m]; below 0 inside, and where its centre is within the skin.
fn gap(world: &dyn Dynamics, sample: &Sample, (center, radius): ([f64; 2], f64)) -> f64 {
    let place = |point: usize| [sample.position[point][0] - center[0], sample.position[point][1] - center[1]];
    let (mut least, mut is_within) = (f64::INFINITY, false);
    for [a, b] in skins(world).into_iter().map(|ends| ends.map(place)) {
        let u = [b[0] - a[0], b[1] - a[1]];
        let at = (-(a[0] * u[0] + a[1] * u[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
        least = least.min((a[0] + at * u[0]).hypot(a[1] + at * u[1]) - radius);
        is_within ^= (a[1] > 0.0) != (b[1] > 0.0) && a[0] > a[1] * u[0] / u[1];
    }
    if is_within && !world.triangles().is_empty() { -radius } else { least }
}

/// The least gap to a circle after any step until `t`, and the end.
fn least_gap(scene: &Value, circle: ([f64; 2], f64), t: f64) -> (f64, Sample) {
    let mut world = world(scene);
    let mut least = f64::INFINITY;
    loop {
        let sample = world.sample(world.time());
        least = least.min(gap(&*world, &sample, circle));
        if world.time() >= t - 1e-9 {
            return (least, sample);
        }
        world.step();
    }
}

/// A disc that is so stiff that it keeps its shape at this speed [m/s]: a softer one would wrap itself around a peg and cross itself.
fn stiff_disc(at: [f64; 2], speed: f64) -> Value {
    json!({"make": "disc", "radius": 0.25, "spacing": 0.1, "origin": at, "velocity": [0, -speed],
        "material": {"kind": "spring", "stiffness": 100.0 * speed * speed + 3000.0, "damping": 2, "mass": 1}})
}

#[test]
fn no_circle_gets_into_a_disc_or_a_box() {
    for radius in [0.5, PEG] {
        for (speed, t) in [(5.0, 2.0), (50.0, 0.5), (200.0, 0.2)] {
            for x in [0.0, 0.02, 0.15, 0.24] {
                let obstacle = [circle([0.0, -radius], radius)];
                let bodies = [("a disc", stiff_disc([x, 0.8], speed)), ("a box", rigid_box([x, 0.8], [0.0, -speed]))];
                for (what, body) in bodies {
                    let (least, end) = least_gap(&scene(&[body], &obstacle), ([0.0, -radius], radius), t);
                    let left = end.velocity.iter().map(|v| -v[1]).sum::<f64>() / end.velocity.len() as f64 / speed;
                    let of = format!("{what} at {speed} m/s, {x} m off a circle of {radius} m");
                    assert!(least > -SKIN, "{of}: {least} m");
                    // What is hit at its rim goes on beside it.
                    assert!(speed < 50.0 || x > 0.2 || left < 0.9, "{of} went through");
                }
            }
        }
    }
}

#[test]
fn bodies_rest_on_circles_or_fall_off() {
    let hollow = [circle([-0.4, 0.0], 0.3), circle([0.4, 0.0], 0.3)];
    let (rests, world) = run(&scene(&[disc([0.02, 0.4], [0.0; 2])], &hollow), 5.0);
    assert!(world.is_asleep() && middle(&rests, 0).abs() < 0.02, "{rests:?}");
    assert!(gap(&*world, &rests, ([0.4, 0.0], 0.3)).abs() < SKIN, "it touches");
    for (x, stays) in [(0.0, true), (0.15, false)] {
        let peg = [circle([0.0, 0.7], PEG)];
        let (end, _) = run(&scene(&[rigid_box([x, 1.5], [0.0; 2])], &peg), 3.0);
        let is_at_rest = (middle(&end, 1) - 0.7 - PEG - 0.3).abs() < 0.01 && fastest(&end) < 1e-2;
        assert!(if stays { is_at_rest } else { middle(&end, 1) < 0.0 }, "{x} m off: {end:?}");
    }
    let (rolls, _) = run(&scene(&[disc([0.2, 0.8], [0.0; 2])], &[circle([0.0, 0.0], 0.5)]), 3.0);
    assert!(middle(&rolls, 0) > 0.5 && middle(&rolls, 1) < 0.0, "{rolls:?}");
}

#[test]
fn a_point_leaves_a_peg_as_a_mirror_says() {
    for (speed, time) in [(5.0, 0.2), (50.0, 0.05), (200.0, 0.02)] {
        let heights: Vec<f64> = (-9..=9).map(|k| 0.1 * f64::from(k) * PEG).collect();
        for &height in &heights {
            let scene = json!({"wobble": 1, "contact": true, "method": {"solver": "live"},
                "points": {"position": [[-0.5, height]], "velocity": [[speed, 0]]},
                "obstacles": [{"circle": {"center": [0, 0], "radius": PEG}, "restitution": 1}]});
            let (end, _) = run(&scene, time);
            let sine = height / PEG;
            let normal = [-(1.0 - sine * sine).sqrt(), sine];
            let v = [speed - 2.0 * speed * normal[0] * normal[0], -2.0 * speed * normal[0] * normal[1]];
            let off = (end.velocity[0][0] - v[0]).hypot(end.velocity[0][1] - v[1]) / speed;
            assert!(off < 0.02, "{speed} m/s at {height} m: {:?}, not {v:?}", end.velocity[0]);
        }
    }
}

#[test]
fn a_rod_is_struck_by_a_peg_where_it_meets_it() {
    for speed in [5.0, 50.0, 200.0] {
        for share in [0.2, 0.5, 0.7] {
            // It gets there just before 0.1 s have gone.
            let origin = [-PEG - 0.1 * speed + 0.0025, -0.1 * share];
            let rod = json!({"make": "rope", "count": 2, "origin": origin, "to": [0, 0.1], "velocity": [speed, 0],
                "material": {"kind": "rigid"}});
            let mut scene = scene(&[rod], &[json!({"circle": {"center": [0, 0], "radius": PEG}, "restitution": 1})]);
            scene["gravity"] = json!([0, 0]);
            let (end, _) = run(&scene, 0.1);
            let rest = 1.0 - share;
            // Both ends are equally heavy: what is given falls to them by their shares.
            let given = 2.0 * speed / (rest * rest + share * share);
            let [a, b] = [end.velocity[0], end.velocity[1]];
            let found = [0.5 * (a[0] + b[0]), (a[0] - b[0]).hypot(a[1] - b[1])];
            for (found, right) in found.into_iter().zip([speed - 0.5 * given, given * (rest - share).abs()]) {
                assert!((found - right).abs() < 0.1 * speed, "{speed} m/s, {share}: {found}, not {right}");
            }
        }
    }
}

#[test]
fn a_block_slides_off_a_large_circle_as_off_a_slope() {
    const RADIUS: f64 = 200.0;
    let block = |at: [f64; 2]| {
        json!({"make": "lattice", "columns": 5, "rows": 3, "spacing": 0.1, "origin": at, "angle": -20.0_f64.to_radians(),
            "material": {"kind": "spring", "stiffness": 1e5, "damping": 20, "mass": 1}})
    };
    let (sine, cosine) = 20.0_f64.to_radians().sin_cos();
    // The middle of its lower side touches the slope.
    let at = [-0.2 * cosine, 0.2 * sine];
    for (friction, slides) in [(0.2, true), (0.5, false)] {
        let speed = |obstacle: Value| {
            let (end, _) = run(&scene(&[block(at)], &[obstacle]), 0.5);
            end.velocity.iter().map(|v| v[0] * cosine - v[1] * sine).sum::<f64>() / end.velocity.len() as f64
        };
        let plane = speed(json!({"plane": {"point": [0, 0], "normal": [sine, cosine]}, "friction": friction}));
        let center = [-RADIUS * sine, -RADIUS * cosine];
        let round = speed(json!({"circle": {"center": center, "radius": RADIUS}, "friction": friction}));
        let right = if slides { 0.5 * 9.81 * (sine - friction * cosine) } else { 0.0 };
        assert!(
            (round - right).abs() < 0.01 && (round - plane).abs() < 0.01,
            "{round}, {plane} on a plane, not {right}"
        );
    }
}

#[test]
fn restitution_is_that_of_a_plane() {
    for restitution in [0.0, 0.5, 1.0] {
        let plane = json!({"plane": {"point": [0, 0], "normal": [0, 1]}, "restitution": restitution});
        let round =
            |radius: f64| json!({"circle": {"center": [0, -radius], "radius": radius}, "restitution": restitution});
        let point = |obstacle: &Value| {
            let scene = json!({"wobble": 1, "contact": true, "method": {"solver": "live"},
                "points": {"position": [[0, 1]], "velocity": [[0, -7]]}, "obstacles": [obstacle]});
            run(&scene, 0.3).0.velocity[0][1]
        };
        let [flat, small] = [plane.clone(), round(PEG)].map(|obstacle| point(&obstacle));
        assert!((flat - small).abs() < 1e-9 && (small - 7.0 * restitution).abs() < 1e-6, "{small}, {flat} on a plane");
        let body = |obstacle: &Value| {
            let mut scene = scene(&[disc([0.0, 0.5], [0.0, -5.0])], std::slice::from_ref(obstacle));
            scene["gravity"] = json!([0, 0]);
            let (end, _) = run(&scene, 0.2);
            end.velocity.iter().map(|v| v[1]).sum::<f64>() / end.velocity.len() as f64
        };
        let [flat, large] = [plane, round(300.0)].map(|obstacle| body(&obstacle));
        assert!((flat - large).abs() < 0.1, "{large} m/s, {flat} on a plane");
    }
}

/// Five discs, each above a circle, on a floor.
fn five(circles: bool) -> Value {
    let at = |k: u32| 0.9 * f64::from(k);
    let discs: Vec<Value> = (0..5).map(|k| disc([at(k), 1.2], [0.0; 2])).collect();
    let obstacles: Vec<Value> = (0..5).filter(|_| circles).map(|k| circle([at(k) + 0.1, 0.3], 0.3)).collect();
    let mut scene = scene(&discs, &obstacles);
    scene["bounds"] = json!({"min": [-1, 0], "max": [5, 5], "friction": 0.5});
    scene
}

#[test]
fn circles_cost_little_more_than_a_floor() {
    let work = |circles: bool| {
        let (_, world) = run(&five(circles), 2.0);
        let counters = world.counters();
        counters.work as f64 / counters.substeps as f64
    };
    let [round, flat] = [true, false].map(work);
    assert!(round < 2.0 * flat, "{round} a substep, {flat} on a floor");
}

#[test]
fn circles_give_the_same_bits_again() {
    for precision in ["f32", "f64"] {
        let mut scene = five(true);
        scene["method"]["precision"] = json!(precision);
        let [first, again] = [0, 1].map(|_| run(&scene, 1.5).0);
        assert!(fastest(&first).is_finite());
        assert_eq!((first.position, first.velocity), (again.position, again.velocity));
    }
}

#[test]
fn circles_that_are_moved_scaled_and_deleted_are_still_circles() {
    let obstacles = [circle([-0.4, 0.0], 0.3), circle([0.4, 0.0], 0.3)];
    let mut world = world(&scene(&[disc([0.0, 0.4], [0.0; 2])], &obstacles));
    let go = |world: &mut dyn Dynamics, t: f64| {
        while world.time() < t - 1e-9 {
            world.step();
        }
        world.sample(world.time())
    };
    go(&mut *world, 2.0);
    let contacts = world.counters().contacts;
    // Larger, further apart and turned by a little, and 0.1 m lower.
    let (by, about) = ([0.0, -0.1, 0.0], Some([0.0; 3]));
    let motion = Motion { obstacles: vec![0, 1], by, turn: 0.1, scale: [1.1; 3], about, ..Motion::default() };
    world.apply(&Command::Move(motion)).unwrap();
    let rests = go(&mut *world, 6.0);
    let (sine, cosine) = 0.1_f64.sin_cos();
    for side in [-0.44, 0.44] {
        let gap = gap(&*world, &rests, ([side * cosine, side * sine - 0.1], 0.33));
        assert!(gap.abs() < SKIN, "{gap} m from the circle at {side}");
    }
    assert!(world.is_asleep(), "{rests:?}");
    let pressed = world.counters().contacts - contacts;
    assert!(pressed < 10_000, "{pressed} contacts");
    world.apply(&Command::Delete(Selection { obstacles: vec![0, 1], ..Selection::default() })).unwrap();
    assert!(middle(&go(&mut *world, 7.0), 1) < -4.0, "nothing holds it any more");
}

#[test]
fn what_is_pinned_over_a_circle_is_put_out_at_once() {
    // A chain from pin to pin whose middle points begin inside.
    let chain = json!({"make": "rope", "count": 9, "origin": [-0.8, 0], "to": [1.6, 0], "material": soft(),
        "pinned": [0, 8]});
    let mut scene = scene(&[chain], &[circle([0.0, -0.1], 0.15)]);
    scene["gravity"] = json!([0, 0]);
    let (end, world) = run(&scene, 0.1);
    assert!(gap(&*world, &end, ([0.0, -0.1], 0.15)) > -SKIN, "{end:?}");
    assert!(fastest(&end) < 2.0, "without a blow: {end:?}");
}

#[test]
fn what_is_folded_over_a_circle_is_not_thrown_across_it() {
    let rim = json!({"make": "rim", "radius": 0.47, "inner_radius": 0.3, "sectors": 18, "origin": [0.05, 1.3],
        "bracing": ["outer", "inner", "spoke", "rising"], "velocity": [0.29, -10.76], "spin": -2.25,
        "material": {"kind": "spring", "stiffness": 60, "mass": 8}});
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": [rim],
        "obstacles": [{"circle": {"center": [0, 0], "radius": 0.68}, "friction": 1}],
        "bounds": {"min": [-2.5, -1], "max": [2.5, 3], "friction": 0.3}});
    let mut world = world(&scene);
    let mut least = f64::INFINITY;
    while world.time() < 1.0 {
        world.step();
        let sample = world.sample(world.time());
        least = least.min(sample.energy);
        assert!(sample.energy < least + 1.0, "{} J at {} s, after {least}", sample.energy, sample.time);
    }
}

/// Its sides begin at the pin, and what presses them right beside it would have to turn them without end.
#[test]
fn a_box_that_hangs_by_a_corner_which_a_circle_covers_swings_on_quietly() {
    for [deep, up] in [[1e-6, 0.0], [1e-4, 0.0], [1e-3, 1e-3], [0.05, 1e-3], [0.05, 0.02]] {
        let hung = json!({"make": "box", "width": 0.4, "height": 1.5, "supports": 2, "origin": [0.2, 1.25], "pinned": [3],
            "material": {"kind": "rigid", "mass": 1}});
        let mut world = world(&scene(&[hung], &[circle([deep - 0.5, 2.0 + up], 0.5)]));
        let start = world.energy();
        while world.time() < 2.0 {
            world.step();
            assert!(world.is_finite(), "{deep} m deep, {up} m up: not finite at {} s", world.time());
            assert!(world.energy() < start + 1.0, "{deep} m deep, {up} m up: from {start} to {} J", world.energy());
        }
        let is_frozen = world.moved_by().iter().any(|moved| moved.why == Why::NotFinite);
        assert!(!is_frozen, "{deep} m deep, {up} m up: it stands still");
    }
}
