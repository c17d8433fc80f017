//! Random commands of all kinds, seeded.

use wobble::history::{DeleteKeys, Do, Factors, History, MoveKeys, OneOrEach, SetKeys};
use wobble::scene::{AddKeys, BodyKeys, BondKeys, MakerName, ObstacleKeys, PlaneKeys, PointKeys, Vector};
use wobble::sim::{Cursor, MouseChange, PointId, Reach};

/// A source of numbers that depends on nothing but its seed (splitmix64).
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Dice(seed)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, count: u64) -> u64 {
        self.next() % count.max(1)
    }

    /// In [low, high).
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn place(&mut self) -> [f64; 2] {
        [self.within(-3.0, 3.0), self.within(-3.0, 3.0)]
    }

    fn vector(&mut self, dimensions: usize) -> Vector {
        let [x, y] = self.place();
        if dimensions == 2 { Vector::Plane([x, y]) } else { Vector::Space([x, y, 0.1 * x]) }
    }
}

fn points(history: &History, dice: &mut Dice) -> Vec<PointId> {
    let count = history.world().point_count() as u64;
    (0..1 + dice.below(4)).map(|_| PointId(dice.below(count + 1) as u32)).collect()
}

fn numbers(count: usize, dice: &mut Dice) -> Vec<u32> {
    (0..1 + dice.below(3)).map(|_| dice.below(count as u64 + 1) as u32).collect()
}

/// A command that may or may not be possible; with what it is called as an edit.
pub fn any(history: &History, dice: &mut Dice) -> (Do, Option<&'static str>) {
    let dimensions = history.scene().dimensions();
    let bonds = history.world().bonds().len();
    match dice.below(15) {
        0 => (Do::Grab(Reach::Within(dice.within(0.1, 1.0))), None),
        1 => (Do::Grab(Reach::Points(points(history, dice))), None),
        2 => (Do::Release, None),
        3 => {
            let strength = Some(dice.within(-60.0, 120.0));
            (
                Do::Mouse(MouseChange { strength, radius: Some(dice.within(0.2, 2.0)), ..MouseChange::default() }),
                Some("Mouse"),
            )
        }
        4 => (Do::Pin(points(history, dice)), Some("Pin")),
        5 => (Do::Unpin(points(history, dice)), Some("Unpin")),
        6 => (Do::Cut { from: Cursor::at(dice.place()), to: Cursor::at(dice.place()) }, Some("Cut")),
        7 | 8 => (Do::Add(Box::new(addition(history, dice, dimensions))), Some("Add")),
        9 => (
            Do::Delete(DeleteKeys {
                points: points(history, dice).iter().map(|p| p.0).collect(),
                ..DeleteKeys::default()
            }),
            Some("Delete points"),
        ),
        10 => (Do::Delete(DeleteKeys { bonds: numbers(bonds, dice), ..DeleteKeys::default() }), Some("Delete bonds")),
        11 => (Do::Move(Box::new(motion(history, dice, dimensions))), Some("Move")),
        12 | 13 => (Do::Set(Box::new(setting(history, dice, dimensions))), Some("Set")),
        _ => (Do::Group { points: points(history, dice), name: format!("group {}", dice.below(4)) }, Some("Group")),
    }
}

fn addition(history: &History, dice: &mut Dice, dimensions: usize) -> AddKeys {
    let next = history.world().next_numbers()[0].max(history.world().point_count() as u32);
    let body = |make| BodyKeys { make, ..BodyKeys::default() };
    match dice.below(4) {
        0 => AddKeys {
            points: Some(PointKeys {
                position: vec![dice.vector(dimensions), dice.vector(dimensions)],
                velocity: None,
                mass: None,
                pinned: if dice.below(2) == 0 { vec![next] } else { Vec::new() },
            }),
            bonds: vec![BondKeys::new(next, next + 1), BondKeys::new(dice.below(u64::from(next)) as u32, next)],
            ..AddKeys::default()
        },
        1 if dimensions == 2 => AddKeys {
            bodies: vec![BodyKeys {
                width: Some(dice.within(0.2, 1.0)),
                height: Some(dice.within(0.2, 1.0)),
                origin: Some(dice.vector(dimensions)),
                ..body(MakerName::Box)
            }],
            ..AddKeys::default()
        },
        2 => AddKeys {
            obstacles: vec![ObstacleKeys {
                plane: Some(PlaneKeys {
                    point: if dimensions == 2 { Vector::Plane([0.0, -4.0]) } else { Vector::Space([0.0, -4.0, 0.0]) },
                    normal: if dimensions == 2 { Vector::Plane([0.1, 1.0]) } else { Vector::Space([0.1, 1.0, 0.0]) },
                }),
                restitution: Some(dice.within(0.0, 0.5)),
                ..ObstacleKeys::default()
            }],
            ..AddKeys::default()
        },
        _ => AddKeys {
            bodies: vec![BodyKeys {
                count: Some(2 + dice.below(5)),
                spacing: Some(dice.within(0.1, 0.3)),
                origin: Some(dice.vector(dimensions)),
                ..body(MakerName::Rope)
            }],
            ..AddKeys::default()
        },
    }
}

fn motion(history: &History, dice: &mut Dice, dimensions: usize) -> MoveKeys {
    MoveKeys {
        points: points(history, dice).iter().map(|point| point.0).collect(),
        by: Some(Vector::new([dice.within(-0.2, 0.2), dice.within(-0.2, 0.2), 0.0], dimensions)),
        turn: Some(dice.within(-0.5, 0.5)),
        scale: Some(Factors::One(dice.within(0.9, 1.1))),
        ..MoveKeys::default()
    }
}

fn setting(history: &History, dice: &mut Dice, dimensions: usize) -> SetKeys {
    match dice.below(5) {
        0 => SetKeys {
            points: Some(points(history, dice).iter().map(|point| point.0).collect()),
            mass: Some(OneOrEach::One(dice.within(0.5, 2.0))),
            ..SetKeys::default()
        },
        1 => SetKeys {
            bonds: Some(numbers(history.world().bonds().len(), dice)),
            stiffness: Some(OneOrEach::One(dice.within(10.0, 400.0))),
            ..SetKeys::default()
        },
        2 => SetKeys {
            bonds: Some(numbers(history.world().bonds().len(), dice)),
            rest: Some(OneOrEach::One(dice.within(0.1, 1.0))),
            ..SetKeys::default()
        },
        3 => SetKeys { gravity: Some(dice.vector(dimensions)), ..SetKeys::default() },
        _ => SetKeys { drag_rate: Some(dice.within(0.0, 2.0)), ..SetKeys::default() },
    }
}

/// Leads a world for `seconds` as a player would: a cursor every frame, now and then a command, an undo or a redo. Returns how
/// many commands were done.
pub fn play(history: &mut History, dice: &mut Dice, seconds: f64) -> usize {
    let end = history.world().time() + seconds;
    let mut done = 0;
    while history.world().time() < end && history.world().is_finite() {
        let now = history.world().time();
        if dice.below(3) > 0 {
            let to = Some(Cursor::at(dice.place()));
            done += usize::from(history.give(vec![Do::Cursor { to, by: Some(now + 1.0 / 60.0) }], None).is_ok());
        }
        if dice.below(4) == 0 {
            let (act, name) = any(history, dice);
            done += usize::from(history.give(vec![act], name).is_ok());
        }
        match dice.below(60) {
            0 => drop(history.undo()),
            1 => drop(history.redo()),
            _ => {}
        }
        let frame = history.world().time() + dice.within(0.2, 1.0) / 30.0;
        while history.world().time() < frame {
            history.step();
        }
    }
    done
}
