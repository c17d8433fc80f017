//! Random commands of all kinds, seeded, for a world as it stands.

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg32;
use wobble::sim::{
    Addition, Bond, BondChange, BondId, BondKind, Change, Command, Cursor, Dynamics, Motion, MouseChange, Obstacle,
    PointId, Polygon, Reach, SceneChange, Selection, Values,
};

/// Draws commands.
pub(crate) struct Generator {
    random: Pcg32,
}

impl Generator {
    pub(crate) fn new(seed: u64) -> Self {
        Generator { random: Pcg32::seed_from_u64(seed) }
    }

    fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.random.next_u32()) / f64::from(u32::MAX)
    }

    fn below(&mut self, count: u32) -> u32 {
        if count == 0 { 0 } else { self.random.random_range(0..count) }
    }

    fn place(&mut self) -> [f64; 2] {
        [self.number(-3.0, 14.0), self.number(-1.0, 6.0)]
    }

    /// A living point, or one that is not there now and then.
    fn point(&mut self, world: &dyn Dynamics) -> PointId {
        let count = world.point_count() as u32;
        for _ in 0..20 {
            let point = PointId(self.below(count));
            if world.gone().binary_search(&point).is_err() {
                return point;
            }
        }
        PointId(count)
    }

    fn points(&mut self, world: &dyn Dynamics) -> Vec<PointId> {
        (0..1 + self.below(4)).map(|_| self.point(world)).collect()
    }

    fn bond(&mut self, world: &dyn Dynamics) -> BondId {
        let place = self.below(world.bonds().len() as u32);
        BondId(world.bond_numbers().map_or(place, |numbers| numbers.get(place as usize).copied().unwrap_or(0)))
    }

    fn obstacles(&mut self, world: &dyn Dynamics) -> Vec<u32> {
        let all: Vec<u32> = world.obstacle_numbers().concat();
        if all.is_empty() { Vec::new() } else { vec![all[self.below(all.len() as u32) as usize]] }
    }

    fn addition(&mut self, world: &dyn Dynamics) -> Addition {
        let [first, ..] = world.next_numbers();
        let [x, y] = self.place();
        let count = 1 + self.below(5);
        let position: Vec<[f64; 3]> =
            (0..count).map(|i| [x + 0.4 * f64::from(i), y + self.number(0.0, 0.3), 0.0]).collect();
        let kinds = [BondKind::Rigid, BondKind::Spring { stiffness: 300.0, damping: 1.0 }];
        let kind = kinds[self.below(2) as usize];
        let mut bonds: Vec<Bond> = (1..count)
            .map(|i| {
                let rest = self.number(0.2, 0.5);
                Bond { kind, ..Bond::new(PointId(first + i - 1), PointId(first + i), rest) }
            })
            .collect();
        if self.below(3) == 0 {
            bonds.push(Bond { kind: kinds[1], ..Bond::new(self.point(world), PointId(first), 1.0) });
        }
        let triangles = match count {
            0..3 => Vec::new(),
            _ => vec![[first, first + 1, first + 2].map(PointId)],
        };
        let corners = vec![[x - 1.0, y - 2.0], [x + 1.0, y - 2.2], [x, y - 1.0]];
        let polygon = Obstacle::Polygon(Polygon { loops: vec![corners], restitution: 0.2, friction: 0.3 });
        Addition {
            velocity: vec![[self.number(-2.0, 2.0), 0.0, 0.0]; position.len()],
            mass: vec![self.number(0.2, 3.0); position.len()],
            position,
            bonds,
            pinned: if self.below(3) == 0 { vec![PointId(first)] } else { Vec::new() },
            obstacles: if self.below(4) == 0 { vec![polygon] } else { Vec::new() },
            triangles,
            ..Addition::default()
        }
    }

    /// One command.
    pub(crate) fn command(&mut self, world: &dyn Dynamics) -> Command {
        match self.below(18) {
            0..4 => {
                let to = if self.below(6) == 0 { None } else { Some(Cursor::at(self.place())) };
                Command::Cursor { to, by: world.time() + self.number(0.0, 0.05) }
            }
            4 => Command::Mouse(MouseChange {
                strength: Some(self.number(-50.0, 80.0)),
                radius: Some(self.number(0.3, 2.0)),
                ..MouseChange::default()
            }),
            5 => Command::Grab(Reach::Points(self.points(world))),
            6 => Command::Grab(Reach::Within(self.number(0.2, 1.5))),
            7 => Command::Release,
            8 => Command::Pin(self.points(world)),
            9 => Command::Unpin(world.pinned().iter().copied().take(1 + self.below(2) as usize).collect()),
            10 => Command::Cut { from: Cursor::at(self.place()), to: Cursor::at(self.place()) },
            11..13 => Command::Add(Box::new(self.addition(world))),
            13 => match self.below(3) {
                0 => Command::Delete(Selection { points: vec![self.point(world)], ..Selection::default() }),
                1 => Command::Delete(Selection { bonds: vec![self.bond(world)], ..Selection::default() }),
                _ => Command::Delete(Selection { obstacles: self.obstacles(world), ..Selection::default() }),
            },
            14 => Command::Move(Motion {
                points: self.points(world),
                obstacles: self.obstacles(world),
                by: [self.number(-0.5, 0.5), self.number(0.0, 0.5), 0.0],
                turn: self.number(-0.5, 0.5),
                scale: [self.number(0.8, 1.2); 3],
                ..Motion::default()
            }),
            15 => Command::Set(Change::Points {
                points: self.points(world),
                mass: Some(Values::Same(self.number(0.2, 4.0))),
                velocity: None,
                skin: wobble::sim::SkinMaterial::default(),
            }),
            16 => {
                let bond = self.bond(world);
                let rest = Some(Values::Same(self.number(0.3, 1.5)));
                Command::Set(Change::Bonds {
                    bonds: vec![bond],
                    to: Box::new(BondChange { rest_length: rest, ..BondChange::default() }),
                })
            }
            _ => Command::Set(Change::Scene(Box::new(SceneChange {
                gravity: Some([self.number(-1.0, 1.0), self.number(-12.0, 0.0), 0.0]),
                drag_rate: Some(self.number(0.0, 0.5)),
                ..SceneChange::default()
            }))),
        }
    }
}
