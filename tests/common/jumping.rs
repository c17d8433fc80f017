//! A mouse that is somewhere else in every frame, and in the second half of the time grabs what it finds and flings it.

use wobble::sim::{Command, Cursor, Dynamics, PointId, Reach};

/// In the second half of the time a point is grabbed every so many frames, and held for so many of them.
const GRABS: [u64; 2] = [15, 12];

/// The least and the greatest place of points along x and y [m].
pub fn extent(world: &dyn Dynamics) -> [[f64; 2]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [-f64::INFINITY; 2]);
    for x in world.sample(world.time()).position {
        for k in 0..2 {
            (low[k], high[k]) = (low[k].min(x[k]), high[k].max(x[k]));
        }
    }
    [low, high]
}

/// The mouse; where it jumps is the same every time.
pub struct JumpingMouse {
    low: [f64; 2],
    high: [f64; 2],
    /// When it begins to grab [s].
    grabs_from: f64,
    state: u64,
}

impl JumpingMouse {
    /// One that jumps about where the points are now, until `end` [s].
    pub fn new(world: &dyn Dynamics, end: f64) -> Self {
        let [low, high] = extent(world);
        JumpingMouse { low, high, grabs_from: 0.5 * end, state: 5 }
    }

    /// Leads the cursor elsewhere by the end of a frame, and grabs, or lets go.
    pub fn jump(&mut self, world: &mut dyn Dynamics, frame: u64) {
        let at = [0, 1].map(|k| self.low[k] + self.draw() * (self.high[k] - self.low[k]));
        let by = world.time() + 1.0 / 60.0;
        world.apply(&Command::Cursor { to: Some(Cursor::at(at)), by }).unwrap();
        if world.time() > self.grabs_from {
            self.fling(world, frame);
        }
    }

    /// Grabs a point that is not pinned, or lets it go.
    fn fling(&mut self, world: &mut dyn Dynamics, frame: u64) {
        match frame % GRABS[0] {
            0 => {
                let mut is_free = vec![true; world.point_count()];
                world.pinned().iter().for_each(|pin| is_free[pin.index()] = false);
                let free: Vec<PointId> =
                    (0..world.point_count() as u32).map(PointId).filter(|point| is_free[point.index()]).collect();
                let chosen = (self.draw() * free.len() as f64) as usize;
                if let Some(&point) = free.get(chosen) {
                    world.apply(&Command::Grab(Reach::Points(vec![point]))).unwrap();
                }
            }
            k if k == GRABS[1] => {
                world.apply(&Command::Release).unwrap();
            }
            _ => {}
        }
    }

    /// A number in [0, 1).
    fn draw(&mut self) -> f64 {
        self.state = self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 11) as f64 / (1_u64 << 53) as f64
    }
}
