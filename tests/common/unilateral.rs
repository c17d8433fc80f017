//! Bodies, rods and strings in the plane by another way than the program's: accelerations with multipliers, Runge-Kutta of order 4, and which
//! strings pull found by trying all sets of them.

use std::ops::Range;

/// Where a tie ends.
#[derive(Clone, Copy, Debug)]
pub enum Seat {
    /// A place of a body, from its middle `[m]`.
    On(usize, [f64; 2]),
    /// A point that stands still `[m]`.
    At([f64; 2]),
}

/// What keeps two places their distance `[m]`: a rod, or a string, which is never longer.
#[derive(Clone, Copy, Debug)]
pub struct Tie {
    pub ends: [Seat; 2],
    pub rest: f64,
    pub is_rod: bool,
}

/// Bodies and what ties them; of each body mass `[kg]` and moment of inertia `[kg m^2]`, and of all of them x, y, angle, one after the other.
#[derive(Clone, Debug)]
pub struct Bodies {
    pub inertias: Vec<[f64; 2]>,
    pub ties: Vec<Tie>,
    pub gravity: f64,
    pub place: Vec<f64>,
    pub speed: Vec<f64>,
}

/// Substep `[s]`.
const STEP: f64 = 5e-4;
/// A gap `[m]` and a speed `[m/s]` that are none: no string gets that fast in a gap that is none, or it would be struck for ever.
const TOUCH: f64 = 1e-13;
const STILL: f64 = 3e-6;

impl Bodies {
    /// On for a time `[s]`.
    pub fn run(&mut self, time: f64) {
        let mut left = time;
        while left > 1e-13 {
            let h = left.min(STEP);
            let pulling = self.pulling();
            let start = self.clone();
            self.step(h, &pulling);
            let slack: Vec<usize> = (0..self.ties.len()).filter(|k| !pulling.contains(k)).collect();
            let is_beyond = |bodies: &Bodies| slack.iter().any(|&k| bodies.gap(k) < -TOUCH);
            if !is_beyond(self) {
                left -= h;
                continue;
            }
            let (mut low, mut high) = (0.0, h);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                *self = start.clone();
                self.step(middle, &pulling);
                if is_beyond(self) { high = middle } else { low = middle }
            }
            *self = start;
            self.step(high, &pulling);
            self.strike();
            left -= high;
        }
    }

    /// By how much a string may still give, or how far the ends of a rod are too near `[m]`.
    fn gap(&self, tie: usize) -> f64 {
        let Tie { ends: [a, b], rest, .. } = self.ties[tie];
        let ([a, _], [b, _]) = (self.at(a), self.at(b));
        rest - (a[0] - b[0]).hypot(a[1] - b[1])
    }

    /// A place, and from the middle of its body to there.
    fn at(&self, seat: Seat) -> [[f64; 2]; 2] {
        match seat {
            Seat::At(place) => [place, [0.0; 2]],
            Seat::On(body, [x, y]) => {
                let (s, c) = self.place[3 * body + 2].sin_cos();
                let arm = [c * x - s * y, s * x + c * y];
                [[self.place[3 * body] + arm[0], self.place[3 * body + 1] + arm[1]], arm]
            }
        }
    }

    /// What opens the gap of a tie, coordinate by coordinate, and how fast its speed grows as all goes straight on `[m/s^2]`.
    fn row(&self, tie: usize) -> (Vec<f64>, f64) {
        let ends = self.ties[tie].ends;
        let [[a, _], [b, _]] = ends.map(|seat| self.at(seat));
        let length = (a[0] - b[0]).hypot(a[1] - b[1]);
        let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let mut row = vec![0.0; self.speed.len()];
        let (mut rate, mut bent) = ([0.0; 2], 0.0);
        for (seat, sign) in ends.into_iter().zip([1.0, -1.0]) {
            let (Seat::On(body, _), [_, arm]) = (seat, self.at(seat)) else { continue };
            let [u, v, spin] = [0, 1, 2].map(|k| self.speed[3 * body + k]);
            row[3 * body] += sign * along[0];
            row[3 * body + 1] += sign * along[1];
            row[3 * body + 2] += sign * (arm[0] * along[1] - arm[1] * along[0]);
            rate = [rate[0] + sign * (u - spin * arm[1]), rate[1] + sign * (v + spin * arm[0])];
            bent -= sign * spin * spin * (arm[0] * along[0] + arm[1] * along[1]);
        }
        let across = rate[0] * along[1] - rate[1] * along[0];
        (row, bent - across * across / length)
    }

    fn inverse(&self, coordinate: usize) -> f64 {
        let [mass, inertia] = self.inertias[coordinate / 3];
        1.0 / if coordinate % 3 == 2 { inertia } else { mass }
    }

    fn rates(&self, ties: &[usize]) -> Vec<f64> {
        ties.iter().map(|&tie| product(&self.row(tie).0, &self.speed)).collect()
    }

    /// Multipliers that give ties what they lack, and how all coordinates answer.
    fn solved(&self, ties: &[usize], lacks: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let rows: Vec<Vec<f64>> = ties.iter().map(|&tie| self.row(tie).0).collect();
        let all = 0..self.speed.len();
        let entry = |a: &[f64], b: &[f64]| all.clone().map(|k| a[k] * b[k] * self.inverse(k)).sum::<f64>();
        let matrix = rows.iter().map(|a| rows.iter().map(|b| entry(a, b)).collect()).collect();
        let pulls = eliminated(matrix, lacks.to_vec())?;
        let way = all
            .map(|k| rows.iter().zip(&pulls).map(|(row, pull)| row[k] * pull).sum::<f64>() * self.inverse(k))
            .collect();
        Some((pulls, way))
    }

    /// The set of rods and of those strings among `taut` ones that pull, so that none of the others would have to, and what they do: all
    /// `lacks`, one a tie, are what is to be made up for.
    fn chosen(&self, taut: &[usize], lacks: &[f64]) -> (Vec<usize>, Vec<f64>) {
        let strings: Vec<usize> = taut.iter().copied().filter(|&tie| !self.ties[tie].is_rod).collect();
        let rods: Vec<usize> = (0..self.ties.len()).filter(|&tie| self.ties[tie].is_rod).collect();
        let size = lacks.iter().fold(1e-9, |most: f64, lack| most.max(lack.abs()));
        let sets: Range<u32> = 0..1 << strings.len();
        for set in sets {
            let pulling = (0..strings.len()).filter(|k| (set >> k) & 1 == 1).map(|k| strings[k]);
            let ties: Vec<usize> = rods.iter().copied().chain(pulling).collect();
            let asked: Vec<f64> = ties.iter().map(|&tie| lacks[tie]).collect();
            let Some((pulls, way)) = self.solved(&ties, &asked) else { continue };
            let holds = |tie: &&usize| product(&self.row(**tie).0, &way) >= lacks[**tie] - 1e-9 * size;
            if pulls[rods.len()..].iter().all(|pull| *pull >= 0.0) && strings.iter().all(|tie| holds(&tie)) {
                return (ties, way);
            }
        }
        panic!("no set of {taut:?} does: {self:?}");
    }

    /// Rods, and strings that pull now.
    fn pulling(&self) -> Vec<usize> {
        let is_taut = |tie: &usize| self.gap(*tie) <= 10.0 * TOUCH && self.rates(&[*tie])[0].abs() <= STILL;
        let taut: Vec<usize> = (0..self.ties.len()).filter(is_taut).collect();
        self.chosen(&taut, &self.lacks()).0
    }

    /// The accelerations that ties lack as gravity alone has it.
    fn lacks(&self) -> Vec<f64> {
        let of = |tie| {
            let (row, bent) = self.row(tie);
            self.gravity * row.iter().skip(1).step_by(3).sum::<f64>() - bent
        };
        (0..self.ties.len()).map(of).collect()
    }

    /// An impact on all strings that are at their length, which gives nothing back.
    fn strike(&mut self) {
        let taut: Vec<usize> = (0..self.ties.len()).filter(|&tie| self.gap(tie) <= 10.0 * TOUCH).collect();
        let all: Vec<usize> = (0..self.ties.len()).collect();
        let lacks: Vec<f64> = self.rates(&all).iter().map(|rate| -rate).collect();
        let (_, way) = self.chosen(&taut, &lacks);
        self.speed.iter_mut().zip(way).for_each(|(speed, way)| *speed += way);
    }

    fn accelerations(&self, pulling: &[usize]) -> Vec<f64> {
        let lacks = self.lacks();
        let asked: Vec<f64> = pulling.iter().map(|&tie| lacks[tie]).collect();
        let (_, mut way) = self.solved(pulling, &asked).expect("what pulls is independent");
        way.iter_mut().skip(1).step_by(3).for_each(|down| *down -= self.gravity);
        way
    }

    /// A step of order 4 with the same ties, which are put right at its end.
    fn step(&mut self, h: f64, pulling: &[usize]) {
        let start = self.clone();
        let mut sums = vec![[0.0; 2]; self.speed.len()];
        for (at, weight) in [(0.5, 1.0), (0.5, 2.0), (1.0, 2.0), (0.0, 1.0)] {
            let acceleration = self.accelerations(pulling);
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum = [sum[0] + weight * self.speed[k], sum[1] + weight * acceleration[k]];
            }
            let speed = self.speed.clone();
            for k in 0..speed.len() {
                self.place[k] = start.place[k] + at * h * speed[k];
                self.speed[k] = start.speed[k] + at * h * acceleration[k];
            }
        }
        for (k, sum) in sums.iter().enumerate() {
            self.place[k] = start.place[k] + h / 6.0 * sum[0];
            self.speed[k] = start.speed[k] + h / 6.0 * sum[1];
        }
        for _ in 0..3 {
            let gaps: Vec<f64> = pulling.iter().map(|&tie| -self.gap(tie)).collect();
            let Some((_, way)) = self.solved(pulling, &gaps) else { break };
            self.place.iter_mut().zip(way).for_each(|(place, way)| *place += way);
        }
        let rates: Vec<f64> = self.rates(pulling).iter().map(|rate| -rate).collect();
        if let Some((_, way)) = self.solved(pulling, &rates) {
            self.speed.iter_mut().zip(way).for_each(|(speed, way)| *speed += way);
        }
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The answer to a few equations; `None`: some repeat others.
fn eliminated(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let count = right.len();
    let size: Vec<f64> = (0..count).map(|k| matrix[k][k]).collect();
    for k in 0..count {
        if matrix[k][k].abs() <= 1e-9 * size[k] {
            return None;
        }
        for l in k + 1..count {
            let share = matrix[l][k] / matrix[k][k];
            for m in k..count {
                matrix[l][m] -= share * matrix[k][m];
            }
            right[l] -= share * right[k];
        }
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|m| matrix[k][m] * right[m]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    Some(right)
}
