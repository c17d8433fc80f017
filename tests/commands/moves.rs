//! What is moved, turned and scaled, and what has to make way.

use super::*;

#[test]
fn a_body_that_an_obstacle_is_put_onto_is_moved_out_as_a_whole() {
    let mut model = boxes(2);
    model.gravity = [0.0; 2];
    model.velocity.fill([0.0; 2]);
    let floor = Obstacle::Plane {
        point: [0.0, 1.6, 0.0],
        normal: [0.0, 1.0, 0.0],
        restitution: 0.0,
        friction: 0.0,
        penalty: None,
    };
    let walls = BoundsChange { min: [-10.0, 1.6, 0.0], max: [100.0, 20.0, 0.0], restitution: 0.0, friction: 0.0 };
    let bounds = Change::Scene(Box::new(SceneChange { bounds: Some(Some(walls)), ..SceneChange::default() }));
    let put: [Command; 2] =
        [Command::Add(Box::new(Addition { obstacles: vec![floor], ..Addition::default() })), Command::Set(bounds)];
    for command in put {
        let mut world = build(&model).unwrap();
        steps(&mut *world, 0.1);
        let start = now(&*world);
        world.apply(&command).unwrap();
        let after = now(&*world);
        for i in 0..8 {
            let [dx, dy] = [0, 1].map(|k| after.position[i][k] - start.position[i][k]);
            let body = 4 * (i / 4);
            let first = after.position[body][1] - start.position[body][1];
            assert!(dx.abs() < 1e-9 && (dy - first).abs() < 1e-9 && dy > 0.4, "{dx} {dy}");
            assert!(after.position[i][1] > 1.6 - 1e-3);
        }
        assert!(world.warnings().iter().any(|warning| warning.contains("moved out")));
        steps(&mut *world, 0.5);
        assert_eq!(world.counters().fallbacks, 0);
        let velocity = now(&*world).velocity;
        for body in [0..4, 4..8] {
            let mean = velocity[body].iter().map(|v| v[1]).sum::<f64>() / 4.0;
            assert!(mean.abs() < 0.3, "nothing is thrown: {mean}");
        }
    }
}

#[test]
fn a_part_of_a_rigid_body_is_not_moved_against_its_lengths() {
    // A strip of rigid braced cells; some points of its middle are to go far to the side.
    let mut model = Model { bounds: None, ..boxes(0) };
    for column in 0..12 {
        model.position.extend([[f64::from(column), 0.0], [f64::from(column), 1.0]]);
        let first = 2 * column;
        model.bonds.push(Bond::new(PointId(first), PointId(first + 1), 1.0));
        if column > 0 {
            for (a, b) in [(first - 2, first), (first - 1, first + 1), (first - 2, first + 1), (first - 1, first)] {
                model.bonds.push(Bond::new(
                    PointId(a),
                    PointId(b),
                    if (a + b) % 2 == 0 { 1.0 } else { 2.0_f64.sqrt() },
                ));
            }
        }
    }
    model.velocity = vec![[0.0; 2]; 24];
    model.mass = vec![1.0; 24];
    let mut world = build(&model).unwrap();
    steps(&mut *world, 0.1);
    let (before, lengths) = (now(&*world), world.bonds().rest_lengths().to_vec());
    let mut refusals = 0;
    for (points, by) in [(8..14, [0.3, 0.8, 0.0]), (8..14, [-3.0, 2.0, 0.0]), (0..9, [6.0, 0.5, 0.0])] {
        let motion = Motion { points: numbers(points), by, ..Motion::default() };
        let mut copy = world.boxed_clone();
        match copy.apply(&Command::Move(motion)) {
            Err(CommandError::Invalid(why)) => {
                refusals += 1;
                assert!(why.contains("move the whole body"), "{why}");
                assert_eq!(bits(&now(&*copy), 0..24), bits(&before, 0..24), "the world is whole");
            }
            other => assert!(other.is_ok() && now(&*copy).max_strain < 1e-6, "the rest follows"),
        }
        assert_eq!(copy.bonds().rest_lengths(), lengths, "no length gives way");
    }
    assert!(refusals > 0);
    world
        .apply(&Command::Move(Motion {
            points: numbers(0..24),
            by: [5.0, 1.0, 0.0],
            turn: 1.0,
            scale: [1.5; 3],
            ..Motion::default()
        }))
        .unwrap();
    assert!(now(&*world).max_strain < 1e-6, "the whole body may be moved");
}

/// Three points with springs and an angle that pull nothing, one spring that is strained, a plane, a polygon.
fn drawn() -> Model<2> {
    let position = vec![[0.0, 0.0], [1.0, 0.5], [2.0, 0.0], [5.0, 5.0]];
    let far = |a: usize, b: usize| (position[b][0] - position[a][0] as f64).hypot(position[b][1] - position[a][1]);
    let bonds = [spring(0, 1, far(0, 1)), spring(1, 2, far(1, 2)), spring(0, 2, 1.5)];
    let bends = [0, 1, 2].map(|point: usize| position[point]);
    let angle = wobble::sim::Angle { stiffness: 30.0, ..wobble::sim::angle_at([0, 1, 2].map(PointId), bends) };
    Model {
        velocity: vec![[1.0, 2.0]; 4],
        mass: vec![1.0; 4],
        bonds: bonds.into_iter().collect(),
        angles: wobble::sim::Angles::of(vec![angle]),
        planes: vec![wobble::sim::Plane {
            point: [0.0, -9.0],
            normal: [1.0, 1.0],
            restitution: 0.0,
            friction: 0.0,
            penalty: None,
        }],
        polygons: vec![Polygon {
            loops: vec![vec![[8.0, 8.0], [9.0, 8.0], [9.0, 9.0]]],
            restitution: 0.0,
            friction: 0.0,
        }],
        position,
        ..Model::default()
    }
}

#[test]
fn a_scale_along_each_axis_and_a_turn_are_one_map_of_points_bonds_angles_and_obstacles() {
    let model = drawn();
    let (turn, factors, about, by) = (0.7_f64, [2.0, 0.5], [1.0, 1.0], [0.3, -0.2]);
    let (sin, cos) = turn.sin_cos();
    let turned = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let placed = |x: [f64; 2]| {
        let [x, y] = turned([factors[0] * (x[0] - about[0]), factors[1] * (x[1] - about[1])]);
        [x + about[0] + by[0], y + about[1] + by[1]]
    };
    let mut world = build(&model).unwrap();
    let motion = Motion {
        points: numbers(0..3),
        obstacles: vec![0, 1],
        by: [by[0], by[1], 0.0],
        turn,
        scale: [factors[0], factors[1], 1.0],
        about: Some([about[0], about[1], 0.0]),
        ..Motion::default()
    };
    assert!(world.apply(&Command::Move(motion.clone())).unwrap().is_something);
    let sample = now(&*world);
    let near = |found: [f64; 3], expected: [f64; 2]| {
        assert!((found[0] - expected[0]).hypot(found[1] - expected[1]) < 1e-6, "{found:?} {expected:?}");
    };
    for k in 0..3 {
        near(sample.position[k], placed(model.position[k]));
        near(sample.velocity[k], turned(model.velocity[k]));
    }
    near(sample.position[3], model.position[3]);
    let far = |a: usize, b: usize| {
        let [p, q] = [placed(model.position[a]), placed(model.position[b])];
        (q[0] - p[0]).hypot(q[1] - p[1])
    };
    let rests: Vec<f64> = world.bonds().iter().map(|bond| bond.rest_length).collect();
    // The third is strained as it was: its length was 2 m, its rest 1.5 m.
    let expected = [far(0, 1), far(1, 2), 0.75 * far(0, 2)];
    assert!(
        rests.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9),
        "{rests:?} {expected:?}"
    );
    let angle = world.angles()[0];
    let now_at =
        wobble::sim::angle_at([0, 1, 2].map(PointId), [0, 1, 2].map(|point| placed(model.position[point]))).rest;
    let was_at = wobble::sim::angle_at([0, 1, 2].map(PointId), [0, 1, 2].map(|point| model.position[point])).rest;
    assert!((angle.rest - now_at).abs() < 1e-6 && (now_at - was_at).abs() > 0.1, "{angle:?}");
    assert!((angle.arms[0] - far(0, 1)).abs() < 1e-9);
    let [point, normal] = world.planes()[0];
    for along in [0.0, 3.0] {
        let on = placed([along, -9.0 - along]);
        let off = (on[0] - point[0]) * normal[0] + (on[1] - point[1]) * normal[1];
        assert!(off.abs() < 1e-9, "what lay on the plane lies on it: {off}");
    }
    for (corner, was) in world.polygons()[0].loops[0].iter().zip(&model.polygons[0].loops[0]) {
        near([corner[0], corner[1], 0.0], placed(*was));
    }
    let mut space =
        build(&Model::<3> { position: vec![[0.0; 3]], velocity: vec![[0.0; 3]], mass: vec![1.0], ..Model::default() })
            .unwrap();
    let motion = Motion { points: numbers(0..1), obstacles: Vec::new(), ..motion };
    assert!(space.apply(&Command::Move(motion)).is_err(), "of the plane alone");
}
