//! What nothing touches: its slowest wobble beside the closed form of small swings, its energy, and what a bounce leaves of its speed.
//!
//! Springs that swing too fast for 128 substeps a frame, or of too many bodies for so many, are projected, and lose their wobble.

use std::f64::consts::{PI, TAU};

use serde_json::{Value, json};
use wobble::sim::{BondKind, Change, Command, Dynamics, PointId, Sample, SkinMaterial};

use super::{middle, run, soft, world};

/// Stiffness of the springs that modes are worked out with [N/m], their damping [N s/m].
const SPRING: [f64; 2] = [3000.0, 0.2];

fn springs([stiffness, damping]: [f64; 2]) -> Value {
    json!({"kind": "spring", "stiffness": stiffness, "damping": damping, "mass": 1})
}

fn disc(material: &Value) -> Value {
    json!({"make": "disc", "radius": 0.5, "spacing": 0.1, "material": material})
}

fn slab(material: &Value) -> Value {
    json!({"make": "lattice", "columns": 8, "rows": 5, "spacing": 0.1, "material": material})
}

/// A scene of one body that the live step moves, and that does not fall asleep.
fn alone(body: Value) -> Value {
    json!({"wobble": 1, "contact": true, "method": {"solver": "live", "sleep": false}, "bodies": [body]})
}

/// The slowest small swing of a body of springs.
struct Mode {
    /// Angular frequency [1/s].
    rate: f64,
    /// The way of each point, the furthest of which is 1.
    shape: Vec<[f64; 2]>,
}

/// The slowest mode of K u = w^2 M u that is no motion of the whole, by iteration from a stretch along x.
fn slowest(body: Value) -> Mode {
    let world = world(&alone(body));
    let (sample, mass) = (world.sample(0.0), world.masses());
    let links: Vec<([usize; 2], [f64; 2], f64)> = world
        .bonds()
        .iter()
        .map(|bond| {
            let [a, b] = [bond.a.index(), bond.b.index()];
            let d = [0, 1].map(|k| sample.position[a][k] - sample.position[b][k]);
            let BondKind::Spring { stiffness, .. } = bond.kind else { panic!("{bond:?}") };
            ([a, b], d.map(|part| part / d[0].hypot(d[1])), stiffness)
        })
        .collect();
    let pull = |u: &[[f64; 2]]| {
        let mut a = vec![[0.0; 2]; u.len()];
        for &([i, j], along, stiffness) in &links {
            let stretch: f64 = (0..2).map(|k| (u[i][k] - u[j][k]) * along[k]).sum();
            for k in 0..2 {
                a[i][k] += stiffness * stretch * along[k] / mass[i];
                a[j][k] -= stiffness * stretch * along[k] / mass[j];
            }
        }
        a
    };
    let product = |u: &[[f64; 2]], v: &[[f64; 2]]| -> f64 {
        u.iter().zip(v).zip(mass).map(|((u, v), mass)| mass * (u[0] * v[0] + u[1] * v[1])).sum()
    };
    let total: f64 = mass.iter().sum();
    let center = [0, 1].map(|k| sample.position.iter().zip(mass).map(|(x, m)| m * x[k]).sum::<f64>() / total);
    let places: Vec<[f64; 2]> = sample.position.iter().map(|x| [x[0] - center[0], x[1] - center[1]]).collect();
    let whole: [Vec<[f64; 2]>; 3] = [
        vec![[1.0, 0.0]; places.len()],
        vec![[0.0, 1.0]; places.len()],
        places.iter().map(|x| [-x[1], x[0]]).collect(),
    ];
    // No swing is faster: each point is pulled by all its springs at once, from both ends.
    let mut sums = vec![0.0; places.len()];
    links.iter().for_each(|&([a, b], _, stiffness)| {
        sums[a] += 2.0 * stiffness / mass[a];
        sums[b] += 2.0 * stiffness / mass[b];
    });
    let fastest = sums.into_iter().fold(0.0, f64::max);
    let mut u: Vec<[f64; 2]> = places.iter().map(|x| [x[0], -x[1]]).collect();
    let mut square = 0.0;
    for _ in 0..2_000 {
        for own in &whole {
            let share = product(own, &u) / product(own, own);
            u.iter_mut().zip(own).for_each(|(u, own)| (0..2).for_each(|k| u[k] -= share * own[k]));
        }
        let size = product(&u, &u).sqrt();
        u.iter_mut().for_each(|u| *u = u.map(|u| u / size));
        let a = pull(&u);
        square = product(&u, &a);
        u.iter_mut().zip(&a).for_each(|(u, a)| (0..2).for_each(|k| u[k] -= a[k] / fastest));
    }
    let most = u.iter().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
    Mode { rate: square.sqrt(), shape: u.iter().map(|u| u.map(|u| u / most)).collect() }
}

/// Angular frequency [1/s] and decay [1/s] of a motion, by its zeros and by its largest values between them.
fn fit(step: f64, motion: &[f64]) -> [f64; 2] {
    let zeros: Vec<f64> = motion
        .windows(2)
        .zip(0_u32..)
        .filter(|(pair, _)| (pair[0] < 0.0) != (pair[1] < 0.0))
        .map(|(pair, k)| step * (f64::from(k) + pair[0] / (pair[0] - pair[1])))
        .collect();
    let peaks: Vec<[f64; 2]> = motion
        .windows(3)
        .zip(1_u32..)
        .filter(|(three, _)| three[1].abs() >= three[0].abs() && three[1].abs() > three[2].abs())
        .map(|(three, k)| {
            let bend = three[0] - 2.0 * three[1] + three[2];
            let top = three[1] - (three[2] - three[0]).powi(2) / (8.0 * bend);
            [step * f64::from(k), top.abs().ln()]
        })
        .collect();
    let mean = |k: usize| peaks.iter().map(|peak| peak[k]).sum::<f64>() / peaks.len() as f64;
    let [t, height] = [mean(0), mean(1)];
    let slope = peaks.iter().map(|peak| (peak[0] - t) * (peak[1] - height)).sum::<f64>()
        / peaks.iter().map(|peak| (peak[0] - t).powi(2)).sum::<f64>();
    [PI * (zeros.len() - 1) as f64 / (zeros[zeros.len() - 1] - zeros[0]), -slope]
}

/// Gives all points velocities [m/s].
fn push(world: &mut dyn Dynamics, velocity: Vec<[f64; 3]>) {
    let points = (0..velocity.len() as u32).map(PointId).collect();
    let change = Change::Points { points, mass: None, velocity: Some(velocity), skin: SkinMaterial::default() };
    world.apply(&Command::Set(change)).unwrap();
}

/// Frequency and decay of the slowest wobble over what they are by the closed form, of a body of these springs for `swings`.
fn wobble(make: fn(&Value) -> Value, spring: [f64; 2], swings: u32) -> [f64; 2] {
    let mode = slowest(make(&springs(SPRING)));
    let [stiffness, damping] = spring;
    let rate = mode.rate * (stiffness / SPRING[0]).sqrt();
    // Dampers beside all springs, by the same share: C = K damping/stiffness.
    let decay = 0.5 * rate * rate * damping / stiffness;
    let mut world = world(&alone(make(&springs(spring))));
    push(&mut *world, mode.shape.iter().map(|u| [1e-3 * rate * u[0], 1e-3 * rate * u[1], 0.0]).collect());
    let step = TAU / rate / 24.0;
    let mut motion = Vec::new();
    for k in 0..24 * swings {
        let t = step * f64::from(k);
        while world.time() + world.substep() <= t + 1e-12 {
            world.step();
        }
        let sample = world.sample(t.max(world.time()));
        let along = sample.velocity.iter().zip(&mode.shape).zip(world.masses());
        motion.push(along.map(|((v, u), mass)| mass * (v[0] * u[0] + v[1] * u[1])).sum::<f64>());
    }
    let [found, lost] = fit(step, &motion);
    [found / rate, lost / decay]
}

#[test]
fn a_soft_body_wobbles_as_the_closed_form_says() {
    for (what, make, spring) in [
        ("a disc", disc as fn(&Value) -> Value, [3000.0, 0.2]),
        ("a softer disc", disc, [300.0, 0.2]),
        ("a disc that is hardly damped", disc, [300.0, 0.02]),
        ("a slab", slab, [3000.0, 0.2]),
        ("a softer slab", slab, [300.0, 0.2]),
    ] {
        let [rate, decay] = wobble(make, spring, 16);
        assert!((rate - 1.0).abs() < 0.02, "{what}: {rate} of its frequency");
        assert!((decay - 1.0).abs() < 0.2, "{what}: {decay} of its decay");
    }
}

#[test]
fn a_stiffer_body_wobbles_as_the_closed_form_says() {
    for spring in [[3000.0, 2.0], [10_000.0, 0.2], [30_000.0, 2.0]] {
        let [rate, decay] = wobble(disc, spring, 8);
        assert!((rate - 1.0).abs() < 0.02 && (decay - 1.0).abs() < 0.2, "{spring:?}: {rate}, {decay}");
    }
}

/// The energy that a disc without dampers has after 10 s, over what it had: it spins at 3/s and is stretched at 1/s.
fn kept(stiffness: f64) -> f64 {
    let mut body = disc(&springs([stiffness, 0.0]));
    body["spin"] = json!(3);
    let mut world = world(&alone(body));
    let sample = world.sample(0.0);
    let pairs = sample.position.iter().zip(&sample.velocity);
    push(&mut *world, pairs.map(|(x, v)| [v[0] + x[0], v[1] - x[1], 0.0]).collect());
    let start = world.energy();
    while world.time() < 10.0 - 1e-9 {
        world.step();
    }
    world.energy() / start
}

#[test]
fn what_has_no_dampers_keeps_its_energy_for_ten_seconds() {
    for stiffness in [300.0, 3000.0, 10_000.0, 30_000.0] {
        let kept = kept(stiffness);
        assert!((kept - 1.0).abs() < 0.05, "{stiffness} N/m: {kept}");
    }
}

/// What bonds without stretch do by the live step: a rope of 20 from its left end on.
fn rope(kind: &Value) -> Value {
    let mut scene = json!({"wobble": 1, "method": {"solver": "live", "sleep": false, "settle": false, "ledger": true},
        "bodies": [{"make": "rope", "count": 20, "to": [0.95, 0], "material": {"kind": "rigid", "mass": 0.2}}]});
    for (key, value) in kind.as_object().unwrap() {
        match key.as_str() {
            "gravity" | "method" => scene[key] = value.clone(),
            _ => scene["bodies"][0][key] = value.clone(),
        }
    }
    scene
}

/// The angular momentum of a world about the origin `[N m s]`.
fn turn(sample: &Sample, masses: &[f64]) -> f64 {
    let of = |((x, v), mass): ((&[f64; 3], &[f64; 3]), &f64)| mass * (x[0] * v[1] - x[1] * v[0]);
    sample.position.iter().zip(&sample.velocity).zip(masses).map(of).sum()
}

#[test]
fn a_rope_that_tumbles_keeps_its_energy_and_its_turn() {
    let scene = rope(&json!({"spin": 10}));
    let (begun, start) = run(&scene, 0.0);
    let (ended, end) = run(&scene, 2.0);
    let kept = end.energy() / start.energy();
    assert!((kept - 1.0).abs() < 1e-3, "{kept}");
    let turned = turn(&ended, end.masses()) / turn(&begun, start.masses());
    assert!((turned - 1.0).abs() < 1e-2, "{turned}");
}

#[test]
fn a_rope_swings_as_by_an_exact_method() {
    let hung = json!({"pinned": [0], "gravity": [0, -9.81]});
    // 3 mm off; where bonds drag, 100.
    let (live, world) = run(&rope(&hung), 0.6);
    let mut exact = rope(&hung);
    exact["method"] = json!({"solver": "rk8"});
    let (exact, _) = run(&exact, 0.6);
    let pairs = live.position.iter().zip(&exact.position);
    let off = pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
    assert!(off < 0.02, "{off} m of 0.95");
    let ledger = world.sample(0.6).ledger.unwrap();
    assert!(ledger.left_over().abs() < 0.005 * ledger.most_kinetic, "{ledger:?}: {} J", ledger.left_over());
}

#[test]
fn a_net_that_swings_in_space_keeps_its_energy() {
    let scene = json!({"wobble": 1, "dimensions": 3, "gravity": [0, -9.81, 0], "method": {"solver": "live", "sleep": false, "settle": false},
        "bodies": [{"make": "cloth", "columns": 6, "rows": 6, "spacing": 0.1, "diagonals": "none", "pinned": [0],
            "material": {"kind": "rigid", "mass": 0.5}}]});
    let mut world = world(&scene);
    let start = world.energy();
    let mut most: f64 = 0.0;
    while world.time() < 1.0 - 1e-9 {
        world.step();
        let kinetic: f64 = world
            .sample(world.time())
            .velocity
            .iter()
            .map(|v| 0.5 * 0.5 / 36.0 * v.iter().map(|v| v * v).sum::<f64>())
            .sum();
        most = most.max(kinetic);
    }
    let lost = (start - world.energy()) / most;
    // It hangs by one corner and falls together; where bonds drag it loses 0.28.
    assert!(lost.abs() < 0.2, "{lost} of {most} J");
}

/// The speed at which a body goes up 0.4 s after it began to fall on a floor at `speed`, over that.
fn returned(body: &Value, speed: f64, restitution: f64, method: Option<&str>) -> f64 {
    let mut body = body.clone();
    (body["velocity"], body["origin"]) = (json!([0, -speed]), json!([0, 0.4]));
    let mut scene = json!({"wobble": 1, "contact": true, "bodies": [body],
        "bounds": {"min": [-3, 0], "max": [3, 9], "restitution": restitution}});
    match method {
        Some("live") => scene["method"] = json!({"solver": "live"}),
        // Steps so fine that every touch of a point is resolved.
        Some(exact) => {
            (scene["contact"], scene["method"]) = (json!(false), json!({"solver": exact, "substep": 1.0 / 7680.0}));
        }
        None => {}
    }
    let (end, world) = run(&scene, 0.4);
    let up: f64 = end.velocity.iter().zip(world.masses()).map(|(v, mass)| mass * v[1]).sum();
    assert!(middle(&end, 1) > 0.3, "it is on its way up");
    up / world.masses().iter().sum::<f64>() / speed
}

fn rigid_box() -> Value {
    json!({"make": "box", "width": 0.6, "height": 0.6, "supports": 2, "material": {"kind": "rigid", "mass": 1}})
}

fn soft_disc() -> Value {
    json!({"make": "disc", "radius": 0.25, "spacing": 0.1, "material": soft()})
}

#[test]
fn a_single_body_bounces_as_restitution_says() {
    let rigid_disc = json!({"make": "disc", "radius": 0.25, "spacing": 0.1, "material": {"kind": "rigid"}});
    for speed in [2.0, 4.0] {
        for restitution in [0.5, 0.8, 1.0] {
            for (what, body) in [("a box", rigid_box()), ("a disc", rigid_disc.clone())] {
                let found = returned(&body, speed, restitution, None);
                assert!((found / restitution - 1.0).abs() < 0.03, "{what} at {speed} m/s: {found}, not {restitution}");
            }
            // A soft one swings afterwards: how much it returns nobody says in a word.
            let [found, right] = [None, Some("rk4")].map(|method| returned(&soft_disc(), speed, restitution, method));
            assert!((found / right - 1.0).abs() < 0.03, "a soft disc at {speed} m/s: {found}, not {right}");
        }
    }
    // At this speed it is squeezed until it touches itself, and goes live.
    let [found, right] = [None, Some("rk4")].map(|method| returned(&soft_disc(), 5.0, 0.5, method));
    assert!((found / right - 1.0).abs() < 0.03, "a soft disc at 5 m/s: {found}, not {right}");
}

#[test]
fn a_point_bounces_by_the_live_step_as_restitution_says() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"solver": "live"},
        "points": {"position": [[0, 1.0]]}, "bounds": {"min": [-1, 0], "max": [1, 5], "restitution": 0.5}});
    let mut world = world(&scene);
    let mut highest: f64 = 0.0;
    while world.time() < 1.2 {
        world.step();
        let sample = world.sample(world.time());
        if world.time() > 0.5 {
            highest = highest.max(sample.position[0][1]);
        }
    }
    // e = 0.5: the height falls by 4.
    assert!((highest - 0.25).abs() < 0.015, "{highest}");
}

#[test]
fn a_soft_body_bounces_by_the_live_step_as_restitution_says() {
    for speed in [2.0, 5.0] {
        for restitution in [0.0, 0.5, 1.0] {
            let body = soft_disc();
            let [found, right] = [Some("live"), Some("rk4")].map(|method| returned(&body, speed, restitution, method));
            assert!((found / right - 1.0).abs() < 0.03, "{restitution} at {speed} m/s: {found}, not {right}");
        }
    }
}

#[test]
fn a_box_of_rigid_bonds_bounces_by_the_live_step_as_restitution_says() {
    let found = returned(&rigid_box(), 2.0, 1.0, Some("live"));
    assert!((found - 1.0).abs() < 0.03, "a box: {found}, not 1");
    let found = returned(&rigid_box(), 2.0, 0.5, Some("live"));
    assert!((found / 0.5 - 1.0).abs() < 0.03, "a box: {found}, not 0.5");
}
