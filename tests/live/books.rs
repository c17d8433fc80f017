//! The ledger of the live step against closed forms: what friction, impacts and dampers take, and that nothing else is called a reason.

use serde_json::{Value, json};
use wobble::scene::record::ledgers;
use wobble::sim::{Ledger, judge};

use super::{disc, world};

/// The ledger of a scene that the live step moves, once a frame.
fn books(scene: &Value, t: f64) -> Vec<Ledger> {
    let mut scene = scene.clone();
    scene["method"] = json!({"solver": "live", "ledger": true, "sleep": false, "settle": false});
    ledgers(&mut *world(&scene), t).unwrap()
}

#[test]
fn friction_takes_what_a_block_had() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true,
        "bodies": [{"make": "lattice", "columns": 6, "rows": 4, "spacing": 0.1, "velocity": [3, 0],
            "material": {"kind": "spring", "stiffness": 20000, "damping": 5, "mass": 2}}],
        "obstacles": [{"plane": {"point": [0, 0], "normal": [0, 1]}, "friction": 0.5}]});
    let list = books(&scene, 1.5);
    let (book, verdict) = (list.last().unwrap().book, judge(&list));
    // 2 kg at 3 m/s.
    assert!((book.friction / 9.0 - 1.0).abs() < 0.02, "{book:?}");
    assert!(verdict.passes() && verdict.is_told, "{verdict:?}");
    assert!(list.last().unwrap().now.kinetic < 0.05, "{:?}", list.last().unwrap().now);
}

#[test]
fn an_impact_takes_what_restitution_leaves() {
    for restitution in [0.0, 0.5, 0.8] {
        let scene = json!({"wobble": 1, "contact": true, "points": {"position": [[0, 0.5]], "velocity": [[0, -4]], "mass": [2]},
            "bounds": {"min": [-1, 0], "max": [1, 9], "restitution": restitution}});
        let list = books(&scene, 0.5);
        let (book, right) = (list.last().unwrap().book, 16.0 * (1.0 - restitution * restitution));
        assert!((book.impacts / right - 1.0).abs() < 0.01, "{restitution}: {book:?}, not {right} J");
        assert!(judge(&list).passes(), "{restitution}: {:?}", judge(&list));
    }
}

#[test]
fn forces_and_wind_are_told_from_the_mouse() {
    let point = json!({"position": [[0, 0]], "mass": [1]});
    let pushed = json!({"wobble": 1, "points": point, "contact": true, "forces": [{"points": [0], "force": [3, 0]}]});
    let list = books(&pushed, 2.0);
    let last = list.last().unwrap();
    // (3 m/s^2 x 2 s)^2/2.
    assert!((last.book.forces - 18.0).abs() < 0.05 && last.book.mouse == 0.0, "{:?}", last.book);
    let blown = json!({"wobble": 1, "points": point, "contact": true, "drag_rate": 1.5,
        "wind": {"velocity": [4, 0], "turbulence": 0.3, "seed": 1}});
    let calm = books(&blown, 2.0);
    let last = calm.last().unwrap();
    assert!(last.book.wind > 5.0 && last.book.drag > 1.0 && last.book.mouse.abs() < 1e-9, "{:?}", last.book);
    for list in [list, calm] {
        assert!(judge(&list).is_told && judge(&list).passes(), "{:?}", judge(&list));
    }
}

#[test]
fn what_pulls_at_one_point_of_a_rigid_body_works_along_its_way() {
    // A couple turns a free box: torque t over angle a.
    let turned = json!({"wobble": 1, "contact": true, "forces": [{"points": [0, 1], "force": [0, 0], "torque": 1.5}],
        "bodies": [{"make": "lattice", "columns": 5, "rows": 3, "spacing": 0.1, "material": {"kind": "rigid", "mass": 2}}]});
    let list = books(&turned, 1.0);
    let last = list.last().unwrap();
    // What lies off the middle is pulled by no net force: (t x torque)^2/2 over the moment about the middle.
    let masses = world(&turned).masses().to_vec();
    let arm = |k: usize| (0.1 * (k % 5) as f64 - 0.2).powi(2) + (0.1 * (k / 5) as f64 - 0.1).powi(2);
    let energy = 0.5 * 1.5_f64.powi(2) / masses.iter().enumerate().map(|(k, mass)| mass * arm(k)).sum::<f64>();
    assert!((last.now.kinetic / energy - 1.0).abs() < 0.01, "{:?}, not {energy} J", last.now);
    assert!((last.book.forces / energy - 1.0).abs() < 0.01, "{:?}, not {energy} J", last.book);
    assert!(last.left_over().abs() < 1e-3 * last.most_kinetic, "{} J", last.left_over());
}

#[test]
fn dampers_take_what_a_wobble_loses() {
    let mut body = disc([0.0, 1.0], [0.0; 2]);
    body["material"]["damping"] = json!(0.5);
    let scene = json!({"wobble": 1, "contact": true, "bodies": [body],
        "bounds": {"min": [-2, 0], "max": [2, 4]}, "gravity": [0, -9.81]});
    let list = books(&scene, 1.0);
    let last = list.last().unwrap();
    assert!(last.book.dampers > 0.3, "{:?}", last.book);
    assert!(last.left_over().abs() < 0.03 * last.most_kinetic, "{last:?}: {} J", last.left_over());
}

#[test]
fn bodies_that_give_all_back_lose_little_and_that_is_seen() {
    let bodies: Vec<Value> = (0..15_i32)
        .map(|i| {
            let [x, y] = [1.2 * f64::from(i % 5) - 2.4, 1.2 * f64::from(i / 5)];
            let velocity = [1.5 * f64::from(i * 7 % 5 - 2), 2.0 * f64::from(i * 3 % 5 - 2)];
            json!({"make": "disc", "radius": 0.4, "spacing": 0.15, "origin": [x, y], "velocity": velocity,
                "material": {"kind": "spring", "stiffness": 2000, "damping": 0, "mass": 0.1}})
        })
        .collect();
    let scene = json!({"wobble": 1, "bodies": bodies, "contact": {"friction": 0, "restitution": 1},
        "bounds": {"min": [-4, -2], "max": [4, 4], "restitution": 1, "friction": 0}});
    let list = books(&scene, 3.0);
    let (last, verdict) = (list.last().unwrap(), judge(&list));
    let kept = last.now.sum() / last.start;
    assert!((0.65..1.001).contains(&kept), "{kept}");
    // Nothing may take anything: what is missing is the method's own.
    assert!((verdict.loss - (1.0 - kept)).abs() < 0.05, "{verdict:?}, kept {kept}");
    assert_eq!(last.book.taken(), 0.0, "{:?}", last.book);
}

/// What begins in walls, hung up so that it cannot be put beside them, is led out at walking pace; that is told from what the method makes.
#[test]
fn what_begins_in_a_wall_is_led_out_slowly_and_that_is_told() {
    // It hangs askew: what stands quite straight over a wall is a strut, and held.
    let net = |kind: Value| {
        json!({"wobble": 1, "gravity": [0, -9.81], "drag_rate": 0.5, "method": {"ledger": true},
            "bodies": [{"make": "cloth", "columns": 3, "rows": 8, "spacing": 0.2, "diagonals": "none", "angle": 0.1, "pinned": [0, 2], "material": kind}],
            "bounds": {"min": [-3, -0.9], "max": [3, 3], "restitution": 0.3, "friction": 0.2}})
    };
    for kind in
        [json!({"kind": "rigid", "mass": 1}), json!({"kind": "spring", "stiffness": 5000, "damping": 1, "mass": 1})]
    {
        let mut world = world(&net(kind.clone()));
        let (mut fastest, mut list) = (0.0_f64, Vec::new());
        for frame in 1..=120 {
            while world.time() < f64::from(frame) / 60.0 - 1e-9 {
                world.step();
            }
            let sample = world.sample(world.time());
            fastest = sample.velocity.iter().map(|v| v[0].hypot(v[1])).fold(fastest, f64::max);
            list.extend(sample.ledger);
        }
        let lowest = world.sample(world.time()).position.iter().map(|x| x[1]).fold(0.0, f64::min);
        assert!(lowest > -0.9 - 1e-3, "{kind}: {lowest}");
        // Falls of 1.4 m end at 5 m/s; put out at once it left at 30 and more.
        assert!(fastest < 10.0, "{kind}: {fastest} m/s");
        let (book, verdict) = (list.last().unwrap().book, judge(&list));
        assert!(book.parting.abs() > 0.1, "{kind}: {book:?}");
        assert!(verdict.gain < 0.01, "{kind}: {verdict:?} {book:?}");
    }
}
