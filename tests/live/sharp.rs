//! Boxes that fall on posts, needles and pegs: they rest or tip, and nothing pierces them.

use serde_json::{Value, json};
use wobble::sim::{Dynamics, Sample};

use super::{areas, fastest, middle, run, world};

/// Depth up to which a point counts as on a side [m].
const SKIN: f64 = 1e-3;

fn rigid() -> Value {
    json!({"kind": "rigid", "mass": 1})
}

fn soft() -> Value {
    json!({"kind": "spring", "stiffness": 3000, "damping": 2, "mass": 1})
}

/// A box of 0.6 m whose middle is 1 m above the top of an obstacle.
fn scene(obstacle: &Value, material: &Value, [x, speed]: [f64; 2]) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true,
        "bodies": [{"make": "box", "width": 0.6, "height": 0.6, "supports": 2, "origin": [x, 2], "velocity": [0, -speed],
            "material": material}],
        "obstacles": [{"polygon": [obstacle], "friction": 0.5}]})
}

fn needle() -> Value {
    json!([[-0.05, -5], [0.05, -5], [0, 1]])
}

fn peg() -> Value {
    json!([[-0.02, 0.96], [0.02, 0.96], [0.02, 1], [-0.02, 1]])
}

/// How far a point is inside a convex outline [m]; below 0 outside.
fn depth(outline: &[[f64; 2]], x: [f64; 2]) -> f64 {
    let side = |k: usize| {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        ((b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0])) / length
    };
    (0..outline.len()).map(side).fold(f64::INFINITY, f64::min)
}

/// The outline of the box, anticlockwise.
fn outline(sample: &Sample) -> Vec<[f64; 2]> {
    let center = [0, 1].map(|axis| middle(sample, axis));
    let mut corners: Vec<[f64; 2]> = sample.position.iter().map(|x| [x[0], x[1]]).collect();
    corners.sort_by(|a, b| {
        let angle = |x: &[f64; 2]| (x[1] - center[1]).atan2(x[0] - center[0]);
        angle(a).total_cmp(&angle(b))
    });
    corners
}

/// The deepest that a corner of the obstacle ever was in the box, or one of the box in the obstacle [m]; and the end.
fn pierced(scene: &Value, t: f64) -> (f64, Sample) {
    let list = |value: &Value| -> Vec<[f64; 2]> { serde_json::from_value(value.clone()).unwrap() };
    let obstacle = list(&scene["obstacles"][0]["polygon"][0]);
    let mut world = world(scene);
    let mut most = f64::NEG_INFINITY;
    loop {
        let sample = world.sample(world.time());
        let body = outline(&sample);
        let corners = obstacle.iter().map(|&x| depth(&body, x)).chain(body.iter().map(|&x| depth(&obstacle, x)));
        most = corners.fold(most, f64::max);
        if world.time() >= t - 1e-9 {
            return (most, sample);
        }
        world.step();
    }
}

#[test]
fn a_box_rests_on_a_post_or_tips() {
    let post = json!([[-0.15, -5], [0.15, -5], [0.15, 1], [-0.15, 1]]);
    let scene = |x: f64, speed: f64| scene(&post, &rigid(), [x, speed]);
    let (rests, world) = run(&scene(0.02, 5.0), 4.0);
    assert!((middle(&rests, 1) - 1.3).abs() < 0.05 && fastest(&rests) < 1e-2, "{rests:?}");
    assert!(areas(&*world, &rests).iter().all(|area| *area > 0.3));
    let (tips, _) = run(&scene(0.25, 5.0), 4.0);
    assert!(middle(&tips, 1) < 0.0, "{tips:?}");
    for x in [0.02, 0.25] {
        let (deepest, hit) = pierced(&scene(x, 50.0), 0.5);
        assert!(areas(&*world, &hit).iter().all(|area| *area > 0.3), "keeps its shape at 50 m/s: {hit:?}");
        assert!(deepest < SKIN, "{deepest} m");
    }
}

#[test]
fn no_needle_and_no_peg_pierces_a_box() {
    for (what, obstacle) in [("a needle", needle()), ("a peg", peg())] {
        for (of, material) in [("rigid bonds", rigid()), ("springs", soft())] {
            for (speed, t) in [(5.0, 2.0), (50.0, 0.5)] {
                for x in [0.0, 0.02, 0.15, 0.25] {
                    let (deepest, _) = pierced(&scene(&obstacle, &material, [x, speed]), t);
                    assert!(deepest < SKIN, "{what} in a box of {of} at {speed} m/s, {x} m off: {deepest} m");
                    assert!(deepest > -0.2, "{what} was met");
                }
            }
        }
    }
}

#[test]
fn a_box_balances_on_a_needle_and_a_peg_or_tips() {
    // In the very middle it may stay; a little aside it falls, or stands on what is wider than that.
    for (obstacle, x, stays) in
        [(needle(), 0.0, true), (needle(), 0.15, false), (peg(), 0.02, true), (peg(), 0.25, false)]
    {
        let (end, _) = run(&scene(&obstacle, &rigid(), [x, 5.0]), 3.0);
        let (height, speed) = (middle(&end, 1), fastest(&end));
        let is_at_rest = (height - 1.3).abs() < 0.01 && speed < 1e-2;
        assert!(if stays { is_at_rest } else { height < 0.0 }, "{x} m off {obstacle}: at {height} m, {speed} m/s");
    }
}

#[test]
fn a_soft_box_falls_off_a_needle() {
    for x in [0.15, 0.25] {
        let (end, _) = run(&scene(&needle(), &soft(), [x, 5.0]), 3.0);
        assert!(middle(&end, 1) < 0.0, "{x} m off: at {} m, {} m/s", middle(&end, 1), fastest(&end));
    }
}

/// Whether a place is well inside a triangle of a world.
fn is_covered(world: &dyn Dynamics, sample: &Sample, x: [f64; 2]) -> bool {
    world.triangles().iter().any(|corners| {
        let [a, b, c] = corners.map(|corner| sample.position[corner.index()]);
        depth(&[[a[0], a[1]], [b[0], b[1]], [c[0], c[1]]], x) > SKIN
    })
}

/// A skin that is dented by a tip and slides along it is not slid over it.
#[test]
fn no_spike_pierces_a_soft_disc() {
    for (half, x) in [(0.005, 0.02), (0.02, 0.02), (0.05, 0.2), (0.1, 0.02), (0.2, 0.02)] {
        let disc = json!({"make": "disc", "radius": 0.5, "spacing": 0.12, "origin": [x, 2],
            "material": {"kind": "spring", "stiffness": 600, "damping": 1, "mass": 1}});
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": [disc],
            "obstacles": [{"polygon": [[[-half, 0], [half, 0], [0, 1]]]}],
            "bounds": {"min": [-3, 0], "max": [3, 12], "friction": 0.5}});
        let mut world = world(&scene);
        while world.time() < 2.0 {
            world.step();
            let sample = world.sample(world.time());
            assert!(!is_covered(&*world, &sample, [0.0, 1.0]), "{half} m wide, {x} m off: at {} s", world.time());
        }
    }
}

/// Squeezed hard a skin slips over a wide tip: it comes out again, whichever edge is nearest, and nobody else takes the body before.
#[test]
fn a_block_that_a_needle_pierced_is_led_off_it() {
    for (speed, stiffness, x) in [(5.0, 20_000.0, -0.43), (20.0, 5_000.0, -0.37), (50.0, 20_000.0, -0.5)] {
        let block = json!({"make": "lattice", "columns": 6, "rows": 6, "spacing": 0.2, "origin": [x, 0.1], "velocity": [0, -speed],
            "material": {"kind": "spring", "stiffness": stiffness, "damping": 10, "point_mass": 1}});
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": [block],
            "obstacles": [{"polygon": [[[-0.3, -2], [0.3, -2], [0, 0]]], "friction": 0.5},
                {"plane": {"point": [0, -3], "normal": [0, 1]}, "friction": 0.5}]});
        let mut world = world(&scene);
        let mut last = 0.0;
        while world.time() < 4.0 {
            world.step();
            if is_covered(&*world, &world.sample(world.time()), [0.0, 0.0]) {
                last = world.time();
            }
        }
        assert!(last < 2.0, "at {speed} m/s, of {stiffness} N/m, {x} m off: pierced at {last} s");
    }
}

#[test]
fn a_rope_hangs_over_a_spike() {
    for half in [0.02, 0.1, 0.3] {
        let rope = json!({"make": "rope", "count": 20, "to": [2, 0], "origin": [-1.02, 1.5],
            "material": {"kind": "rigid", "mass": 1}});
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": [rope],
            "obstacles": [{"polygon": [[[-half, -2], [half, -2], [0, 1]]], "friction": 0.5}]});
        let mut world = world(&scene);
        while world.time() < 2.0 {
            world.step();
            let sample = world.sample(world.time());
            for bond in world.bonds() {
                let [a, b] = [bond.a, bond.b].map(|end| sample.position[end.index()]);
                if (a[0] < 0.0) != (b[0] < 0.0) {
                    let over = a[1] - a[0] * (b[1] - a[1]) / (b[0] - a[0]);
                    assert!(over > 1.0 - SKIN, "{half} m wide: {over} m at {} s", world.time());
                }
            }
        }
    }
}
