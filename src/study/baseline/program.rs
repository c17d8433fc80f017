//! The baseline's state and its step, as one would write them down from a tutorial: an array of points, an array of
//! bonds, one loop after the other.
#![allow(clippy::needless_range_loop, reason = "components are indexed, as one would write it down")]

use super::Variant;

/// A point as a struct, in the way of the sources.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<const D: usize> {
    pub(super) x: [f64; D],
    pub(super) previous: [f64; D],
    /// Of springs `[N]`.
    pub(super) force: [f64; D],
    /// 0 where it is pinned `[1/kg]`.
    pub(super) inverse_mass: f64,
}

/// A spring with its damper.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spring {
    pub(super) a: usize,
    pub(super) b: usize,
    pub(super) rest: f64,
    pub(super) stiffness: f64,
    pub(super) damping: f64,
}

/// A rigid bond; the shares are those of its ends in a correction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rod {
    pub(super) a: usize,
    pub(super) b: usize,
    pub(super) rest: f64,
    pub(super) share_a: f64,
    pub(super) share_b: f64,
}

/// An acceleration around a cursor that stays where it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mouse {
    pub(super) at: [f64; 2],
    pub(super) strength: f64,
    pub(super) radius: f64,
    pub(super) is_square: bool,
    pub(super) is_linear: bool,
}

/// A half-space that points stay out of: where normal . x < offset.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane<const D: usize> {
    pub(super) normal: [f64; D],
    pub(super) offset: f64,
    pub(super) restitution: f64,
}

/// Walls around the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<const D: usize> {
    pub(super) min: [f64; D],
    pub(super) max: [f64; D],
    pub(super) restitution: f64,
}

/// The whole program: what a scene is, and how far it has come.
#[derive(Clone, Debug)]
pub(crate) struct Program<const D: usize> {
    pub(super) points: Vec<Point<D>>,
    /// Velocities at the start `[m/s]`.
    pub(super) velocity: Vec<[f64; D]>,
    pub(super) springs: Vec<Spring>,
    pub(super) rods: Vec<Rod>,
    pub(super) gravity: [f64; D],
    pub(super) drag_rate: f64,
    pub(super) mouse: Option<Mouse>,
    pub(super) bounds: Option<Bounds<D>>,
    pub(super) planes: Vec<Plane<D>>,
    /// h^2 and 1/h for the step h.
    pub(super) hh: f64,
    pub(super) per_h: f64,
    pub(super) sweeps: u32,
    pub(super) is_shuffled: bool,
    /// State of the shuffle.
    pub(super) random: u64,
}

impl<const D: usize> Program<D> {
    pub(super) fn rigid_bonds(&self) -> usize {
        self.rods.len()
    }

    /// Points and bonds.
    pub(super) fn size(&self) -> (u64, u64) {
        (self.points.len() as u64, (self.springs.len() + self.rods.len()) as u64)
    }

    /// A copy at time 0 that steps by `h`.
    pub(super) fn start(&self, h: f64, variant: Variant) -> Self {
        let Variant { sweeps, is_shuffled } = variant;
        let mut program = Program { hh: h * h, per_h: 1.0 / h, sweeps, is_shuffled, ..self.clone() };
        for (point, v) in program.points.iter_mut().zip(&self.velocity) {
            for k in 0..D {
                // The sources' start; the right one has + a h^2/2.
                point.previous[k] = point.x[k] - v[k] * h;
            }
        }
        program
    }

    /// Positions now, z = 0 in the plane.
    pub(super) fn positions(&self) -> Vec<[f64; 3]> {
        let embed = |point: &Point<D>| {
            let mut x = [0.0; 3];
            x[..D].copy_from_slice(&point.x);
            x
        };
        self.points.iter().map(embed).collect()
    }

    pub(super) fn run(&mut self, steps: u64) {
        for _ in 0..steps {
            self.step();
        }
    }

    fn step(&mut self) {
        if !self.springs.is_empty() {
            self.stretch();
        }
        self.advance();
        for _ in 0..self.sweeps {
            if self.is_shuffled {
                shuffle(&mut self.rods, &mut self.random);
            }
            self.sweep();
        }
        if let Some(bounds) = self.bounds {
            self.keep_inside(&bounds);
        }
        self.clip();
    }

    /// Forces of springs and their dampers.
    fn stretch(&mut self) {
        let per_h = self.per_h;
        for point in &mut self.points {
            point.force = [0.0; D];
        }
        for spring in &self.springs {
            let (a, b) = (self.points[spring.a], self.points[spring.b]);
            let (mut square, mut along) = (0.0, 0.0);
            let mut d = [0.0; D];
            let mut v = [0.0; D];
            for k in 0..D {
                d[k] = a.x[k] - b.x[k];
                v[k] = ((a.x[k] - a.previous[k]) - (b.x[k] - b.previous[k])) * per_h;
                square += d[k] * d[k];
                along += v[k] * d[k];
            }
            let mut force = [0.0; D];
            if spring.rest == 0.0 {
                for k in 0..D {
                    force[k] = -spring.stiffness * d[k] - spring.damping * v[k];
                }
            } else if square > 0.0 {
                let f = -spring.stiffness * (1.0 - spring.rest / square.sqrt()) - spring.damping * along / square;
                for k in 0..D {
                    force[k] = f * d[k];
                }
            }
            for k in 0..D {
                self.points[spring.a].force[k] += force[k];
                self.points[spring.b].force[k] -= force[k];
            }
        }
    }

    /// x' = 2x - x_prev + a h^2, with gravity, drag, the mouse and the forces of springs.
    fn advance(&mut self) {
        let (hh, drag) = (self.hh, self.drag_rate * self.per_h);
        for point in &mut self.points {
            if point.inverse_mass == 0.0 {
                continue;
            }
            let pushed = self.mouse.map_or([0.0; 2], |mouse| mouse.acceleration(point.x[0], point.x[1]));
            for k in 0..D {
                let (x, previous) = (point.x[k], point.previous[k]);
                let mut a = self.gravity[k] + point.force[k] * point.inverse_mass - drag * (x - previous);
                if k < 2 {
                    a += pushed[k];
                }
                point.x[k] = 2.0 * x - previous + a * hh;
                point.previous[k] = x;
            }
        }
    }

    /// Every rigid bond once, along its present direction.
    fn sweep(&mut self) {
        for rod in &self.rods {
            let (a, b) = (self.points[rod.a].x, self.points[rod.b].x);
            let mut d = [0.0; D];
            let mut square = 0.0;
            for k in 0..D {
                d[k] = a[k] - b[k];
                square += d[k] * d[k];
            }
            if square > 0.0 {
                let excess = rod.rest / square.sqrt() - 1.0;
                for k in 0..D {
                    self.points[rod.a].x[k] += rod.share_a * excess * d[k];
                    self.points[rod.b].x[k] -= rod.share_b * excess * d[k];
                }
            }
        }
    }

    /// Points outside the bounds are put on the wall, and their velocity across it is turned round.
    fn keep_inside(&mut self, bounds: &Bounds<D>) {
        for point in &mut self.points {
            for k in 0..D {
                let across = point.x[k] - point.previous[k];
                if point.x[k] < bounds.min[k] {
                    point.x[k] = bounds.min[k];
                } else if point.x[k] > bounds.max[k] {
                    point.x[k] = bounds.max[k];
                } else {
                    continue;
                }
                point.previous[k] = point.x[k] + bounds.restitution * across;
            }
        }
    }

    /// The same at planes.
    fn clip(&mut self) {
        for wall in &self.planes {
            for point in &mut self.points {
                if point.inverse_mass == 0.0 {
                    continue;
                }
                let mut depth = wall.offset;
                let mut across = 0.0;
                for k in 0..D {
                    depth -= wall.normal[k] * point.x[k];
                    across += wall.normal[k] * (point.x[k] - point.previous[k]);
                }
                if depth <= 0.0 {
                    continue;
                }
                for k in 0..D {
                    let along = point.x[k] - point.previous[k] - across * wall.normal[k];
                    point.x[k] += depth * wall.normal[k];
                    point.previous[k] = point.x[k] - along + wall.restitution * across * wall.normal[k];
                }
            }
        }
    }
}

impl Mouse {
    /// The acceleration of a point, the same for every mass `[m/s^2]`.
    fn acceleration(&self, x: f64, y: f64) -> [f64; 2] {
        let [dx, dy] = [x - self.at[0], y - self.at[1]];
        let reach = if self.is_square { dx.abs().max(dy.abs()) } else { (dx * dx + dy * dy).sqrt() };
        if reach >= self.radius {
            return [0.0; 2];
        }
        let q = reach / self.radius;
        let fall = if self.is_linear { 1.0 } else { (1.0 - q * q) * (1.0 - q * q) };
        [self.strength * fall * dx, self.strength * fall * dy]
    }
}

/// Fisher and Yates's shuffle on Marsaglia's xorshift.
fn shuffle(rods: &mut [Rod], random: &mut u64) {
    for i in (1..rods.len()).rev() {
        *random ^= *random << 13;
        *random ^= *random >> 7;
        *random ^= *random << 17;
        // The high half times the range: no division.
        let j = ((*random >> 32) * (i as u64 + 1)) >> 32;
        rods.swap(i, j as usize);
    }
}
