//! Bodies that start inside obstacles: each is moved out as a whole, and nothing is crushed or thrown.

use super::common::physics::{run_to, spring};
use wobble::sim::{Bond, Bounds, Command, Model, Motion, Plane, PointId, Polygon, Sample, build};

fn rectangle([left, low]: [f64; 2], [right, high]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[left, low], [right, low], [right, high], [left, high]]
}

fn solid(loops: Vec<Vec<[f64; 2]>>) -> Polygon {
    Polygon { loops, restitution: 0.0, friction: 0.0 }
}

/// A square lattice of side 1 whose lower left corner is given, of springs or rigid bonds, at rest.
fn square(corner: [f64; 2], is_rigid: bool) -> Model<2> {
    const SIDE: u32 = 6;
    let mut model = Model::default();
    for k in 0..SIDE * SIDE {
        let at = [k % SIDE, k / SIDE].map(|i| f64::from(i) / f64::from(SIDE - 1));
        model.position.push([corner[0] + at[0], corner[1] + at[1]]);
    }
    (model.velocity, model.mass) = (vec![[0.0; 2]; model.position.len()], vec![1.0; model.position.len()]);
    let mut join = |a: u32, b: u32| {
        let [x, y] = [a, b].map(|i| model.position[i as usize]);
        let length = (x[0] - y[0]).hypot(x[1] - y[1]);
        model.bonds.push(if is_rigid {
            Bond::new(PointId(a), PointId(b), length)
        } else {
            spring(a, b, length, 1e3, 1.0)
        });
    };
    for k in 0..SIDE * SIDE {
        let (column, row) = (k % SIDE, k / SIDE);
        let has = [column + 1 < SIDE, row + 1 < SIDE];
        [(has[0], k, k + 1), (has[1], k, k + SIDE), (has[0] && has[1], k, k + SIDE + 1)]
            .into_iter()
            .filter(|(is_there, ..)| *is_there)
            .for_each(|(_, a, b)| join(a, b));
    }
    model
}

/// By how much a body was moved, which must be the same for all of its points, and the warnings.
fn moved(model: &Model<2>) -> ([f64; 2], Vec<String>) {
    let world = build(model).unwrap();
    let start = world.sample(0.0);
    let way = |(now, before): (&[f64; 3], &[f64; 2])| [now[0] - before[0], now[1] - before[1]];
    let ways: Vec<[f64; 2]> = start.position.iter().zip(&model.position).map(way).collect();
    let is_whole = ways.iter().all(|way| (0..2).all(|k| (way[k] - ways[0][k]).abs() < 1e-12));
    assert!(is_whole, "not as a whole: {ways:?}");
    (ways[0], world.warnings().to_vec())
}

fn fastest(sample: &Sample) -> f64 {
    sample.velocity.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max)
}

#[test]
fn a_body_that_is_moved_into_a_wall_is_put_beside_it_as_a_whole() {
    for is_rigid in [false, true] {
        let wall = solid(vec![rectangle([3.0, -9.0], [3.5, 9.0])]);
        let mut world = build(&Model { polygons: vec![wall], ..square([0.0, 0.0], is_rigid) }).unwrap();
        let points = (0..36).map(PointId).collect();
        let motion = Motion { points, by: [2.4, 1.0, 0.0], ..Motion::default() };
        world.apply(&Command::Move(motion)).unwrap();
        let until = world.time() + 0.5;
        let end = run_to(&mut *world, until);
        // It reached 0.4 m into the wall.
        let [left, low] = [0, 1].map(|k| end.position[0][k]);
        assert!((left - 2.0).abs() < 1e-4 && (low - 1.0).abs() < 1e-4, "{is_rigid}: {left}, {low}");
        assert!(fastest(&end) < 1e-3, "{is_rigid}: {} m/s", fastest(&end));
    }
}

#[test]
fn a_pin_that_is_moved_into_a_wall_is_put_beside_it() {
    let wall = solid(vec![rectangle([1.0, -3.0], [3.0, 9.0])]);
    let hung = |count: u32| {
        let mut model = Model::<2> { gravity: [0.0, -9.81], polygons: vec![wall.clone()], ..Model::default() };
        model.position = (0..count).map(|k| [0.0, -0.2 * f64::from(k)]).collect();
        (model.velocity, model.mass) = (vec![[0.0; 2]; count as usize], vec![1.0; count as usize]);
        model.pinned = vec![PointId(0)];
        (1..count).for_each(|k| model.bonds.push(Bond::new(PointId(k - 1), PointId(k), 0.2)));
        model
    };
    // The pin alone, and all with it: it is the pin that goes deepest, 0.2 m.
    for moved in [1, 6] {
        let mut world = build(&hung(6)).unwrap();
        let by = [1.2, -0.1, 0.0];
        let points = (0..moved).map(PointId).collect();
        let motion = Motion { points, by, ..Motion::default() };
        world.apply(&Command::Move(motion)).unwrap();
        assert!(world.warnings().iter().any(|text| text.contains("moved out")), "{:?}", world.warnings());
        let start = world.sample(world.time());
        assert!((start.position[0][0] - 1.0).abs() < 1e-4, "{moved}: {:?}", start.position[0]);
        let until = world.time() + 5.0;
        let end = run_to(&mut *world, until);
        assert!((end.position[0][1] + 0.1).abs() < 1e-4, "{moved}: {:?}", end.position[0]);
        assert!(end.max_strain < 1e-3 && end.position[5][0] < 1.0 + 1e-6, "{moved}: {}", end.max_strain);
    }
}

#[test]
fn a_body_leaves_by_the_shortest_way_and_is_neither_crushed_nor_thrown() {
    let tilted = |angle: f64| {
        vec![solid(vec![
            rectangle([-3.0, -1.0], [3.0, 0.0])
                .into_iter()
                .map(|[x, y]| [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()])
                .collect(),
        ])]
    };
    for is_rigid in [false, true] {
        let body = square([-0.5, -0.3], is_rigid);
        let cases = [
            (Model { polygons: tilted(0.0), ..body.clone() }, 0.3),
            (Model { polygons: tilted(0.2), ..body.clone() }, 0.3 * 0.2_f64.cos() + 0.5 * 0.2_f64.sin()),
            (
                Model {
                    planes: vec![Plane {
                        point: [7.0, 0.0],
                        normal: [0.0, 3.0],
                        restitution: 0.0,
                        friction: 0.0,
                        penalty: None,
                    }],
                    ..body.clone()
                },
                0.3,
            ),
            (
                Model {
                    bounds: Some(Bounds { min: [0.0, -0.1], max: [9.0, 9.0], restitution: 0.0, friction: 0.0 }),
                    ..body.clone()
                },
                0.5_f64.hypot(0.2),
            ),
        ];
        for (model, shortest) in cases {
            let (way, warnings) = moved(&model);
            assert!((way[0].hypot(way[1]) - shortest).abs() < 1e-3, "{way:?} instead of {shortest}");
            assert!(warnings.len() == 1 && warnings[0].contains("moved out as a whole"), "{warnings:?}");
            let end = run_to(&mut *build(&model).unwrap(), 1.0);
            assert!(fastest(&end) < 1e-9, "at rest it stays at rest: {}", fastest(&end));
        }
    }
}

#[test]
fn a_body_goes_where_no_wall_passes_through_it() {
    // A bar that is thinner than the distance of neighbours: just off it there would be points on both sides.
    let bar = solid(vec![rectangle([-5.0, 0.39], [5.0, 0.41])]);
    let (way, _) = moved(&Model { polygons: vec![bar], ..square([-0.5, 0.0], false) });
    assert!((way[1] - 0.41).abs() < 1e-2 || (way[1] + 0.61).abs() < 1e-2, "{way:?}");
    // A ring around it that is just wide enough: it goes to its middle, not out.
    let ring = solid(vec![rectangle([-2.0, -2.0], [2.0, 2.0]), rectangle([-0.55, -0.55], [0.55, 0.55])]);
    let (way, _) = moved(&Model { polygons: vec![ring], ..square([-0.3, -0.6], true) });
    assert!(way[0].abs() <= 0.26 && (0.05..0.16).contains(&way[1]), "{way:?}");
}

#[test]
fn what_is_pinned_or_free_or_has_no_way_out_stays() {
    let floor = || solid(vec![rectangle([-9.0, -1.0], [9.0, 0.0])]);
    let pinned = Model { polygons: vec![floor()], pinned: vec![PointId(35)], ..square([0.0, -0.3], false) };
    let world = build(&pinned).unwrap();
    assert!(world.warnings().iter().any(|text| text.contains("pinned")), "{:?}", world.warnings());
    let free = Model { polygons: vec![floor()], ..square([0.0, 0.0], false) };
    assert_eq!(moved(&free), ([0.0, 0.0], Vec::new()));
    let small = Bounds { min: [0.2, 0.2], max: [0.8, 0.8], restitution: 0.0, friction: 0.0 };
    let world = build(&Model { bounds: Some(small), ..square([0.0, 0.0], false) }).unwrap();
    assert!(world.warnings()[0].contains("without a way out"), "{:?}", world.warnings());
}

#[test]
fn a_pinned_rope_over_an_obstacle_is_not_torn_apart() {
    let triangle = solid(vec![vec![[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]]]);
    for is_rigid in [true, false] {
        let mut model = Model::<2> { gravity: [0.0, -9.81], polygons: vec![triangle.clone()], ..Model::default() };
        model.position = (0..30).map(|k| [-1.0 + 2.0 / 29.0 * f64::from(k), 0.0]).collect();
        (model.velocity, model.mass) = (vec![[0.0; 2]; 30], vec![1.0; 30]);
        model.pinned = vec![PointId(15)];
        for k in 1..30 {
            let length = 2.0 / 29.0;
            let bond = if is_rigid {
                Bond::new(PointId(k - 1), PointId(k), length)
            } else {
                spring(k - 1, k, length, 1e4, 1.0)
            };
            model.bonds.push(bond);
        }
        let mut world = build(&model).unwrap();
        let start = world.sample(0.0);
        assert!(start.max_strain < 1e-9, "{}", start.max_strain);
        let end = run_to(&mut *world, 2.0);
        assert!(end.energy < start.energy + 1e-3 && end.max_strain < 1.0, "{} from {}", end.energy, start.energy);
    }
}
