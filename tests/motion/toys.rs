//! What the gallery's toys do, as their words say, and what a hand does to them.

use std::f64::consts::PI;

use serde_json::json;
use wobble::scene::{AngleKeys, Scene};
use wobble::sim::{Command, Cursor, Dynamics, Key, Limit, PointId, Reach, Sample};

fn world(name: &str) -> Box<dyn Dynamics> {
    Scene::load(name).unwrap().world(None).unwrap()
}

/// Runs to a time [s]; the state there.
fn until(world: &mut dyn Dynamics, time: f64) -> Sample {
    while world.time() < time - 1e-9 {
        world.step();
    }
    world.sample(world.time())
}

/// Takes a point and leads it in a straight line from now on; when it is to be let go [s].
fn take(world: &mut dyn Dynamics, point: u32, velocity: [f64; 2], seconds: f64) -> f64 {
    let start = world.sample(world.time());
    let [x, y, _] = start.position[point as usize];
    let now = world.time();
    let end = now + seconds;
    let to = [x + velocity[0] * seconds, y + velocity[1] * seconds];
    for command in [
        Command::Cursor { to: Some(Cursor::at([x, y])), by: now },
        Command::Grab(Reach::Points(vec![PointId(point)])),
        Command::Cursor { to: Some(Cursor::at(to)), by: end },
    ] {
        world.apply(&command).unwrap();
    }
    end
}

/// What was taken is let go, and the cursor leaves.
fn let_go(world: &mut dyn Dynamics) {
    world.apply(&Command::Release).unwrap();
    world.apply(&Command::Cursor { to: None, by: world.time() }).unwrap();
}

/// Takes a point, leads it in a straight line from now on for `seconds`, and lets go.
fn fling(world: &mut dyn Dynamics, point: u32, velocity: [f64; 2], seconds: f64) {
    let end = take(world, point, velocity, seconds);
    until(world, end);
    let_go(world);
}

/// How far the farthest joint is beyond its stops [rad].
fn beyond_stops(joints: &[AngleKeys], sample: &Sample) -> f64 {
    let off = |joint: &AngleKeys| {
        let (least, most) = joint.min.zip(joint.max)?;
        let [from, at, to] = joint.points.0.map(|point| sample.position[point as usize]);
        let turn = |x: [f64; 3]| (x[1] - at[1]).atan2(x[0] - at[0]);
        let turned = (turn(to) - turn(from) - 0.5 * (least + most) + PI).rem_euclid(2.0 * PI) - PI;
        Some(turned.abs() - 0.5 * (most - least))
    };
    joints.iter().filter_map(off).fold(0.0, f64::max)
}

/// What is reached, looked at after every step: bones are off by 3.3e-4 at most, as the figure is flung by its foot, and the stop that is
/// passed most, of the arm that is torn down, gives way by 0.031 rad, under two degrees.
#[test]
fn ragdolls_stand_a_fling_of_30_metres_a_second_and_come_to_rest() {
    let joints = Scene::load("ragdoll").unwrap().expanded().unwrap().angles;
    assert_eq!(joints.len(), 18);
    for (point, velocity, end) in [(12, [25.0, 16.0], 20.0), (20, [30.0, 0.0], 3.0), (30, [0.0, -30.0], 3.0)] {
        let mut world = world("ragdoll");
        let (mut beyond, mut stretched) = (0.0_f64, 0.0_f64);
        let mut look_until = |world: &mut dyn Dynamics, time: f64| {
            while world.time() < time - 1e-9 {
                world.step();
                let sample = world.sample(world.time());
                beyond = beyond.max(beyond_stops(&joints, &sample));
                stretched = stretched.max(sample.max_strain);
                for x in &sample.position {
                    assert!((-4.01..4.01).contains(&x[0]) && (-1.61..4.21).contains(&x[1]), "at {x:?}");
                }
            }
        };
        look_until(&mut *world, 1.0);
        let led = take(&mut *world, point, velocity, 0.12);
        look_until(&mut *world, led);
        let_go(&mut *world);
        look_until(&mut *world, end);
        assert!(beyond < 0.04, "{beyond} rad beyond its stops, by point {point}");
        assert!(stretched < 2e-3, "bones by {stretched}, by point {point}");
        if end == 20.0 {
            let fallen = world.sample(world.time());
            let fastest = fallen.velocity[..36].iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max);
            assert!(fastest < 0.02, "{fastest} m/s");
        }
    }
}

#[test]
fn what_falls_into_a_heap_comes_to_rest_within_its_walls() {
    for (name, seconds, [low, high]) in [
        ("box", 8.0, [[-3.21, -1.31], [3.21, 1.0]]),
        ("jelly-stack", 12.0, [[-2.91, -1.21], [2.91, 2.2]]),
        ("pegs", 20.0, [[-2.41, -2.01], [2.41, 2.2]]),
    ] {
        let mut world = world(name);
        let sample = until(&mut *world, seconds);
        assert!(world.is_asleep(), "{name} still moves");
        for x in &sample.position {
            assert!((0..2).all(|k| (low[k]..high[k]).contains(&x[k])), "{name}: a point at {x:?}");
        }
    }
}

#[test]
fn a_box_with_one_diagonal_falls_off_and_one_with_two_stays() {
    let mut world = world("box-two-supports");
    let sample = until(&mut *world, 10.0);
    let height = |first: usize| (first..first + 4).map(|i| sample.position[i][1]).sum::<f64>() / 4.0;
    // Boxes of 1 m on a floor at -1.3 m: the upper ones are points 4 to 7 and 12 to 15.
    assert!(height(4) < -0.5, "its middle is at {}", height(4));
    assert!(height(12) > 0.0, "its middle is at {}", height(12));
}

#[test]
fn rods_keep_their_length_and_strings_are_never_longer() {
    let mut world = world("constraints");
    fling(&mut *world, 1, [6.0, 3.0], 0.1);
    let mut slack = 0;
    for tenth in 2..100 {
        let sample = until(&mut *world, 0.1 * f64::from(tenth));
        for bond in world.bonds().iter() {
            let [a, b] = [bond.a, bond.b].map(|end| sample.position[end.index()]);
            let strain = (a[0] - b[0]).hypot(a[1] - b[1]) / bond.rest_length - 1.0;
            match bond.limit {
                Limit::Both => assert!(strain.abs() < 1e-6, "a rod by {strain}"),
                Limit::Max => assert!(strain < 1e-6, "a string by {strain}"),
                Limit::Min => assert!(strain > -1e-6, "what keeps apart by {strain}"),
            }
            slack += i32::from(bond.limit == Limit::Max && strain < -1e-3);
        }
    }
    assert!(slack > 0, "no string was ever slack");
}

#[test]
fn the_wind_blows_the_cloth_out_and_flutters_it() {
    let mut world = world("cloth-wind");
    let lower = |sample: &Sample| sample.position[494..].iter().map(|x| x[0]).sum::<f64>() / 26.0;
    let hung = lower(&world.sample(0.0));
    let blown: Vec<f64> =
        (20..60).map(|quarter| lower(&until(&mut *world, 0.25 * f64::from(quarter))) - hung).collect();
    let mean = blown.iter().sum::<f64>() / blown.len() as f64;
    let swing = blown.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / blown.len() as f64;
    assert!(mean > 0.1, "the lower hem is blown by {mean} m");
    assert!(swing.sqrt() > 0.02, "it swings by {} m", swing.sqrt());
}

#[test]
fn the_tower_falls_under_the_wrecking_ball() {
    let mut world = world("wrecking-ball");
    let top = |sample: &Sample| sample.position[46..].iter().map(|x| x[1]).fold(f64::MIN, f64::max);
    let before = until(&mut *world, 0.8);
    let after = until(&mut *world, 4.0);
    assert!(top(&before) > 1.5 && top(&after) < 1.2, "{} m, then {} m", top(&before), top(&after));
}

#[test]
fn the_bridge_holds_what_drops_on_it() {
    let mut world = world("bridge");
    let sample = until(&mut *world, 8.0);
    let lowest = sample.position.iter().map(|x| x[1]).fold(f64::MAX, f64::min);
    assert!(lowest > -2.0, "{lowest} m");
    assert_eq!(world.counters().bonds_torn, 0);
}

#[test]
fn the_last_ball_of_the_cradle_leaves() {
    let mut world = world("cradle");
    let middle = |sample: &Sample, ball: usize| {
        let points = &sample.position[5 + 20 * ball..25 + 20 * ball];
        points.iter().map(|x| x[0]).sum::<f64>() / points.len() as f64
    };
    let mut most = [0.0_f64; 5];
    for hundredth in 70..170 {
        let sample = until(&mut *world, 0.01 * f64::from(hundredth));
        for (ball, most) in most.iter_mut().enumerate() {
            *most = most.max(middle(&sample, ball) + 0.83 - 0.415 * ball as f64);
        }
    }
    assert!(most[4] > 0.9 && most[..4].iter().all(|&way| way < 0.25), "{most:?}");
}

#[test]
fn the_catapult_hits_its_tower() {
    let mut world = world("catapult");
    let sample = until(&mut *world, 4.0);
    let top = sample.position[15..].iter().map(|x| x[1]).fold(f64::MIN, f64::max);
    assert!(sample.position[11][0] > 0.0 && top < 0.5, "{:?}, {top} m", sample.position[11]);
}

#[test]
fn a_pin_in_the_tip_of_the_catapult_holds_its_box_until_it_is_taken_away() {
    let mut world = world("catapult");
    let start = world.sample(0.0).position[11];
    world.apply(&Command::Pin(vec![PointId(6)])).unwrap();
    let held = until(&mut *world, 2.0).position[11];
    assert!((held[0] - start[0]).abs() < 0.5, "it stays on the arm: {held:?}");
    world.apply(&Command::Unpin(vec![PointId(6)])).unwrap();
    let thrown = until(&mut *world, 5.0).position[11];
    assert!(thrown[0] > held[0] + 2.0, "from {held:?} to {thrown:?}");
}

#[test]
fn the_net_tears_where_it_is_pulled_and_not_by_itself() {
    let mut world = world("tearable-net");
    until(&mut *world, 3.0);
    assert_eq!(world.counters().bonds_torn, 0);
    fling(&mut *world, 187, [0.3, -2.0], 0.9);
    until(&mut *world, 5.0);
    let torn = world.counters().bonds_torn;
    assert!((5..500).contains(&torn), "{torn} bonds");
}

#[test]
fn the_car_drives_a_hundred_metres_under_its_key_and_is_braked_without_it() {
    let mut world = world("soft-car");
    let hub = |world: &mut dyn Dynamics, time: f64| until(world, time).position[0];
    let start = hub(&mut *world, 1.0);
    press(&mut *world, "right", true);
    let mut time = 1.0;
    while hub(&mut *world, time)[0] < start[0] + 100.0 {
        time += 1.0;
        assert!(time < 45.0, "{:?} after {time} s", hub(&mut *world, time));
    }
    press(&mut *world, "right", false);
    until(&mut *world, time + 3.0);
    let stands = hub(&mut *world, time + 6.0);
    let sample = until(&mut *world, time + 8.0);
    // A brake is a damper: on a slope it creeps.
    assert!((sample.position[0][0] - stands[0]).abs() < 0.2, "{stands:?}, then {:?}", sample.position[0]);
    assert!(sample.position[6][1] > sample.position[0][1], "on its wheels");
}

#[test]
fn the_walker_walks_where_its_keys_say_and_the_snake_crawls() {
    let mut walker = world("walker");
    let start = middle(&until(&mut *walker, 0.8));
    press(&mut *walker, "right", true);
    let there = middle(&until(&mut *walker, 6.8));
    press(&mut *walker, "right", false);
    press(&mut *walker, "left", true);
    let back = middle(&until(&mut *walker, 12.8));
    assert!(there[0] - start[0] > 2.0 && there[0] - back[0] > 2.0, "{start:?} {there:?} {back:?}");
    let mut snake = world("snake");
    let [early, late] = [2.0, 8.0].map(|time| middle(&until(&mut *snake, time)));
    assert!(late[0] - early[0] > 2.0 && late[1] < 0.6, "{early:?} {late:?}");
}

/// A key goes down or up.
fn press(world: &mut dyn Dynamics, name: &str, down: bool) {
    world.apply(&Command::Key { key: Key::of(name).unwrap(), down }).unwrap();
}

/// Middle of all points [m].
fn middle(sample: &Sample) -> [f64; 2] {
    [0, 1].map(|axis| sample.position.iter().map(|x| x[axis]).sum::<f64>() / sample.position.len() as f64)
}

/// A weight on a rod pulls at it by m (g cos + l w^2); the upper one of two rods carries both weights.
#[test]
fn the_force_in_a_rod_is_that_of_the_weight_on_it_and_of_its_swing() {
    let scene = |solver: &str| {
        json!({"wobble": 1, "gravity": [0, -10], "points": {"position": [[0, 0], [2, 0], [9, 0], [9, -1], [9, -2]],
            "mass": [1, 3, 1, 2, 5], "pinned": [0, 2]}, "method": {"solver": solver},
            "bonds": [{"a": 0, "b": 1}, {"a": 2, "b": 3}, {"a": 3, "b": 4}]})
    };
    for solver in ["auto", "rk4", "verlet", "implicit-midpoint"] {
        let scene = Scene::parse(&scene(solver).to_string(), "x.json").unwrap();
        let mut world = scene.world(None).unwrap();
        while world.time() < 0.4 {
            world.step();
        }
        let x = world.positions();
        let v = world.velocity(PointId(1));
        let (x, y) = (x.get(2), x.get(3));
        let wanted = 3.0 * (10.0 * -y / 2.0 + (v[0] * v[0] + v[1] * v[1]) / 2.0);
        let found = world.tension(0).unwrap();
        assert!((found - wanted).abs() < 1e-3 * wanted, "{solver}: {found} N for {wanted} N at {x} {y}");
        let hung = [1, 2].map(|bond| world.tension(bond).unwrap());
        assert!((hung[0] - 70.0).abs() < 1e-3 && (hung[1] - 50.0).abs() < 1e-3, "{solver}: {hung:?}");
    }
    let square = json!({"wobble": 1, "gravity": [0, -10], "points": {"position": [[0, 0], [1, 0], [1, 1], [0, 1]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2}, {"a": 1, "b": 3}]});
    let square = Scene::parse(&square.to_string(), "x.json").unwrap().world(None).unwrap();
    assert_eq!(square.tension(0), None, "with both diagonals no state tells who bears what");
}
