//! Balls that are pushed at sheets in space.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use crate::sim::vector::{length, sub};
use crate::sim::{Bond, BondKind, Bonds, Command, Contact, Convex, Figure, Model, Motion, Plane, PointId, build};

/// Points along a side of the sheet, and between them `[m]`.
const SIDE: u32 = 10;
const SPACING: f64 = 0.12;

/// A loose sheet that stands on its edge over a floor, in the way of a ball: of springs or of rigid bonds.
fn sheet(is_rigid: bool) -> Model<3> {
    let place = |k: u32| [f64::from(k % SIDE) * SPACING, 0.05 + f64::from(k / SIDE) * SPACING, 0.02 * f64::from(k % 3)];
    let position: Vec<[f64; 3]> = (0..SIDE * SIDE).map(place).collect();
    let number = |column: u32, row: u32| PointId(row * SIDE + column);
    let mut bonds = Bonds::new();
    let mut bind = |a: PointId, b: PointId| {
        let rest = length(sub(place(a.0), place(b.0)));
        let kind = if is_rigid { BondKind::Rigid } else { BondKind::Spring { stiffness: 300.0, damping: 0.05 } };
        bonds.push(Bond { kind, ..Bond::new(a, b, rest) });
    };
    let mut triangles = Vec::new();
    for row in 0..SIDE {
        for column in 0..SIDE {
            let (right, up) = (column + 1 < SIDE, row + 1 < SIDE);
            if right {
                bind(number(column, row), number(column + 1, row));
            }
            if up {
                bind(number(column, row), number(column, row + 1));
            }
            if right && up {
                let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| number(column + x, row + y));
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    let count = position.len();
    Model {
        position,
        velocity: vec![[0.0; 3]; count],
        mass: vec![0.005; count],
        bonds,
        triangles,
        gravity: [0.0, -9.81, 0.0],
        drag_rate: 0.3,
        contact: Some(Contact { friction: 0.4, ..Contact::default() }),
        planes: vec![Plane {
            point: [0.0; 3],
            normal: [0.0, 1.0, 0.0],
            restitution: 0.0,
            friction: 0.6,
            penalty: None,
        }],
        convex: vec![Convex {
            figure: Figure::Ball { center: [-0.6, 0.305, 0.0], radius: 0.3 },
            restitution: 0.0,
            friction: 0.4,
        }],
        ..Model::default()
    }
}

#[test]
fn a_ball_that_is_pushed_at_a_loose_sheet_goes_all_of_its_way() {
    const EVERY: f64 = 1.0 / 30.0;
    for is_rigid in [false, true] {
        let mut world = build(&sheet(is_rigid)).unwrap();
        // It falls over, or stands.
        while world.time() < 0.8 {
            world.step();
        }
        let by = [0.03, 0.0, 0.0];
        for k in 0..60 {
            let start = world.time();
            let motion = Motion { obstacles: vec![1], by, over: Some(EVERY), ..Motion::default() };
            let applied = world.apply(&Command::Move(motion)).unwrap();
            assert!(applied.jam.is_none(), "{is_rigid}, after {k} ways: {:?}", applied.jam.map(|jam| jam.why));
            while world.time() < start + EVERY - 1e-9 {
                world.step();
            }
            let Figure::Ball { center, radius } = world.convex()[0].figure else { continue };
            let now = world.sample(world.time());
            let deepest = now.position.iter().map(|x| radius - length(sub(*x, center))).fold(0.0, f64::max);
            assert!(deepest < 0.05, "{is_rigid}, after {k} ways: {deepest} m in it");
            assert!(now.position.iter().all(|x| x[1] > -0.02), "{is_rigid}: through the floor");
        }
    }
}
