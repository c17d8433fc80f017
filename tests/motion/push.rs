//! Obstacles that go on their way while time runs: what they meet is ahead of them, as fast as they are, and what lies on them goes along.

use super::common::physics::spring;
use wobble::sim::{Bond, Command, Dynamics, Jam, Model, Motion, NoRoom, Obstacle, PointId, Polygon, Sample, build};

/// Between two commands `[s]`.
const EVERY: f64 = 1.0 / 30.0;

fn rectangle([left, low]: [f64; 2], [right, high]: [f64; 2]) -> Polygon {
    let corners = vec![[left, low], [right, low], [right, high], [left, high]];
    Polygon { loops: vec![corners], restitution: 0.0, friction: 0.5 }
}

/// A rigid body of points of 1 kg, braced by bonds between all of them.
fn rigid(position: Vec<[f64; 2]>) -> Model<2> {
    let count = position.len() as u32;
    let mut model = Model {
        velocity: vec![[0.0; 2]; position.len()],
        mass: vec![1.0; position.len()],
        position,
        contact: Some(wobble::sim::Contact { friction: 0.5, ..Default::default() }),
        ..Model::default()
    };
    for (a, b) in (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))) {
        let [x, y] = [a, b].map(|i| model.position[i as usize]);
        model.bonds.push(Bond::new(PointId(a), PointId(b), (x[0] - y[0]).hypot(x[1] - y[1])));
    }
    model
}

/// Obstacle 0 goes with a velocity for so long; the world goes along.
fn drag(world: &mut dyn Dynamics, velocity: [f64; 2], seconds: f64, see: impl FnMut(&Sample)) -> Sample {
    drag_until_jam(world, velocity, seconds, see).0
}

/// The same, and what had no room at the end.
fn drag_until_jam(
    world: &mut dyn Dynamics,
    velocity: [f64; 2],
    seconds: f64,
    mut see: impl FnMut(&Sample),
) -> (Sample, Option<Jam>) {
    let mut jam = None;
    let start = world.time();
    let by = [velocity[0] * EVERY, velocity[1] * EVERY, 0.0];
    for k in 1..=(seconds / EVERY).round() as u32 {
        let motion = Motion { obstacles: vec![0], by, over: Some(EVERY), ..Motion::default() };
        let applied = world.apply(&Command::Move(motion)).unwrap();
        assert_eq!(applied.gone < 1.0, applied.jam.is_some());
        jam = applied.jam;
        while world.time() < start + f64::from(k) * EVERY - 1e-9 {
            world.step();
            see(&world.sample(world.time()));
        }
    }
    (world.sample(world.time()), jam)
}

fn mean(list: &[[f64; 3]]) -> [f64; 2] {
    [0, 1].map(|k| list.iter().map(|x| x[k]).sum::<f64>() / list.len() as f64)
}

#[test]
fn what_is_pushed_gets_the_speed_of_the_push_and_turns_as_its_mass_says() {
    // A rod of five points across the way, pushed at a place `arm` from its middle: v (1 + m arm^2 / I) = u there. A peg 4 cm wide pushes
    // with the corner that is nearer to the middle, for further out the rod runs ahead.
    for arm in [0.0_f64, 0.2] {
        let rod = rigid((0..5).flat_map(|k| [0.0, 0.02].map(|x| [1.0 + x, -0.5 + 0.25 * f64::from(k)])).collect());
        let inertia: f64 = rod.position.iter().map(|x| (x[0] - 1.01).powi(2) + x[1].powi(2)).sum();
        let peg = rectangle([0.8, arm - 0.02], [0.99, arm + 0.02]);
        let mut world = build(&Model { polygons: vec![peg], ..rod }).unwrap();
        // It comes to it within the first way.
        let end = drag(&mut *world, [1.0, 0.0], EVERY, |_| ());
        let v = mean(&end.velocity);
        let near: f64 = (arm - 0.02_f64).max(0.0);
        let expected = 1.0 / (1.0 + 10.0 * near * near / inertia);
        assert!((v[0] - expected).abs() < 2e-3 && v[1].abs() < 1e-2, "{arm}: {v:?} for {expected}");
    }
}

#[test]
fn what_stands_on_a_tray_goes_along_and_is_left_behind_by_one_that_is_jerked() {
    for (speed, carried) in [(0.4, true), (6.0, false)] {
        let mut block = rigid(vec![[0.0, 0.0], [0.4, 0.0], [0.4, 0.2], [0.0, 0.2]]);
        block.gravity = [0.0, -9.81];
        block.triangles = vec![[0, 1, 2].map(PointId), [0, 2, 3].map(PointId)];
        let tray = rectangle([-4.0, -0.1], [1.4, 0.0]);
        let mut world = build(&Model { polygons: vec![tray], ..block }).unwrap();
        let seconds = if carried { 1.0 } else { 0.4 };
        let end = drag(&mut *world, [speed, 0.0], seconds, |_| ());
        let far = mean(&end.position)[0] - 0.2;
        match carried {
            true => assert!((far / (speed * seconds) - 1.0).abs() < 0.15, "{far} m with the tray"),
            // Friction gives it mu g t^2 / 2, from one command to the next at once.
            false => assert!((far / (0.5 * 0.5 * 9.81 * seconds * seconds) - 1.0).abs() < 0.25, "{far} m"),
        }
        assert!(mean(&end.position)[1] > 0.09, "{:?}", mean(&end.position));
    }
}

#[test]
fn a_peg_takes_a_rope_along_however_fast_it_goes() {
    // A rope of springs between two pins, and a rigid one; a thin peg goes through where they hang.
    for is_rigid in [false, true] {
        let count = 21_u32;
        let mut model = Model::<2> {
            position: (0..count)
                .map(|k| [0.1 * f64::from(k) - 1.0, 0.3 * (0.01 * (f64::from(k) - 10.0).powi(2) - 1.0)])
                .collect(),
            velocity: vec![[0.0; 2]; count as usize],
            mass: vec![0.05; count as usize],
            pinned: vec![PointId(0), PointId(count - 1)],
            contact: Some(Default::default()),
            gravity: [0.0, -9.81],
            ..Model::default()
        };
        for k in 1..count as usize {
            let [x, y] = [k - 1, k].map(|i| model.position[i]);
            let rest = 1.01 * (x[0] - y[0]).hypot(x[1] - y[1]);
            let (a, b) = (k as u32 - 1, k as u32);
            model.bonds.push(if is_rigid {
                Bond::new(PointId(a), PointId(b), rest)
            } else {
                spring(a, b, rest, 400.0, 1.0)
            });
        }
        for speed in [1.0, 6.0] {
            let peg = rectangle([-0.05, 0.25], [0.05, 0.3]);
            let mut world = build(&Model { polygons: vec![peg], ..model.clone() }).unwrap();
            let end = drag(&mut *world, [0.03, -speed], 0.6 / speed, |sample| {
                assert!(sample.position.iter().flatten().all(|x| x.is_finite() && x.abs() < 9.0), "{sample:?}");
            });
            // The peg is at -0.35 to -0.3 now: what hangs under it is below.
            let lowest = end.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
            assert!(lowest < -0.34, "{is_rigid} at {speed} m/s: {lowest}");
        }
    }
}

/// How far left obstacle 0 begins `[m]`.
fn left_of_first(world: &dyn Dynamics) -> f64 {
    let obstacles = world.obstacles();
    let Obstacle::Polygon(polygon) = &obstacles[0].1 else { panic!("obstacle 0 is a polygon") };
    polygon.loops[0].iter().map(|corner| corner[0]).fold(f64::INFINITY, f64::min)
}

/// `[m^2]`
fn area(position: &[[f64; 2]], corners: [PointId; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| position[corner.index()]);
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
}

/// A lattice of springs, 5 x 5 points of 0.1 kg, 0.1 m apart, from a corner; or the same rigid.
fn block(corner: [f64; 2], is_rigid: bool) -> Model<2> {
    let side = 5_u32;
    let places = (0..side * side).map(|k| [0.1 * f64::from(k % side), 0.1 * f64::from(k / side)]);
    let mut model = Model {
        position: places.map(|x| [corner[0] + x[0], corner[1] + x[1]]).collect(),
        velocity: vec![[0.0; 2]; 25],
        mass: vec![0.1; 25],
        contact: Some(Default::default()),
        ..Model::default()
    };
    let at = |column: u32, row: u32| row * side + column;
    let mut pairs = Vec::new();
    for (column, row) in (0..side).flat_map(|row| (0..side).map(move |column| (column, row))) {
        let right = (column + 1 < side).then(|| [at(column, row), at(column + 1, row)]);
        let up = (row + 1 < side).then(|| [at(column, row), at(column, row + 1)]);
        pairs.extend(right.into_iter().chain(up));
        if column + 1 < side && row + 1 < side {
            let corners = [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
            pairs.extend([[corners[0], corners[2]], [corners[1], corners[3]]]);
            model.triangles.push([corners[0], corners[1], corners[2]].map(PointId));
            model.triangles.push([corners[0], corners[2], corners[3]].map(PointId));
        }
    }
    for [a, b] in pairs {
        let [x, y] = [a, b].map(|i| model.position[i as usize]);
        let rest = (x[0] - y[0]).hypot(x[1] - y[1]);
        model.bonds.push(if is_rigid {
            Bond::new(PointId(a), PointId(b), rest)
        } else {
            spring(a, b, rest, 500.0, 0.5)
        });
    }
    model
}

#[test]
fn an_obstacle_stops_where_what_it_pushes_has_no_room() {
    for (is_rigid, speed) in [(false, 1.0), (false, 8.0), (true, 1.0), (true, 8.0)] {
        // Between a peg as narrow as one cell and a wall, in a channel.
        let soft = block([0.0, -0.2], is_rigid);
        let areas: Vec<f64> = soft.triangles.iter().map(|corners| area(&soft.position, *corners)).collect();
        let (peg, wall) = (rectangle([-0.6, -0.05], [-0.1, 0.05]), rectangle([0.45, -1.0], [0.6, 1.0]));
        let beside = [[-0.3, 0.21], [-0.3, -0.3]].map(|low| rectangle(low, [0.45, low[1] + 0.09]));
        let triangles = soft.triangles.clone();
        let mut world = build(&Model { polygons: [peg, wall].into_iter().chain(beside).collect(), ..soft }).unwrap();
        let inside =
            |x: &[f64; 3], left: f64| x[0] > left + 1e-6 && x[0] < left + 0.5 - 1e-6 && x[1].abs() < 0.05 - 1e-6;
        let (_, jam) = drag_until_jam(&mut *world, [speed, 0.0], 1.0, |_| ());
        let all = (0..world.point_count() as u32).map(PointId).collect();
        assert_eq!(jam, Some(Jam { points: all, why: NoRoom::Pressed }), "{is_rigid} at {speed}");
        let left = left_of_first(&*world);
        assert!(left + 0.5 < 0.45 && left > -0.6, "{is_rigid} at {speed}: the peg is at {left}");
        let now = world.sample(world.time());
        assert!(!now.position.iter().any(|x| inside(x, left)), "{is_rigid} at {speed}: in the peg");
        assert!(now.position.iter().all(|x| x[0] < 0.4501), "{is_rigid} at {speed}: in the wall");
        // It goes back, and the body is whole.
        assert_eq!(drag_until_jam(&mut *world, [-1.0, 0.0], 2.0, |_| ()).1, None);
        let then = world.sample(world.time());
        let places: Vec<[f64; 2]> = then.position.iter().map(|x| [x[0], x[1]]).collect();
        for (corners, rest) in triangles.iter().zip(&areas) {
            let share = area(&places, *corners) / rest;
            assert!((0.6..1.5).contains(&share), "{is_rigid} at {speed}: an area of {share}");
        }
    }
}

#[test]
fn a_board_stops_on_limbs_and_on_pins() {
    let ragdoll = r#"{"wobble": 1, "contact": true, "gravity": [0, -9.81], "bounds": {"min": [-3, -2], "max": [3, 4], "friction": 0.5},
        "obstacles": [{"box": {"min": [-2, 1], "max": [2, 1.28]}}], "bodies": [{"make": "ragdoll", "height": 1.5, "origin": [0, -2], "material": {"layered": false}}]}"#;
    let pinned = r#"{"wobble": 1, "contact": true, "obstacles": [{"box": {"min": [-1, 1], "max": [1, 1.3]}}],
        "bodies": [{"make": "lattice", "columns": 5, "rows": 5, "spacing": 0.2, "origin": [-0.4, -0.4], "pinned": [10, 14],
            "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 2}}]}"#;
    let reasons = [("a ragdoll", ragdoll, 3.0, NoRoom::Pressed), ("pins", pinned, 0.0, NoRoom::Pinned)];
    for (name, text, waits, why) in reasons {
        let mut world = wobble::scene::Scene::parse(text, "x.json").unwrap().world(None).unwrap();
        while world.time() < waits {
            world.step();
        }
        let (end, jam) = drag_until_jam(&mut *world, [0.0, -1.0], 4.0, |_| ());
        assert_eq!(jam.map(|jam| jam.why), Some(why), "{name}");
        let obstacles = world.obstacles();
        let Obstacle::Polygon(board) = &obstacles[0].1 else { panic!("obstacle 0 is a polygon") };
        let low = board.loops[0].iter().map(|corner| corner[1]).fold(f64::INFINITY, f64::min);
        assert!(low > -1.95, "{name}: the board is at {low}");
        let above = end.position.iter().filter(|x| x[1] > low + 0.01 && x[1] < low + 0.27 && x[0].abs() < 0.99).count();
        assert_eq!(above, 0, "{name}: points are in the board");
    }
}
