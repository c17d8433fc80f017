//! Bonds between any points in the plane, in runs in which no point occurs twice: directions are gathered, multipliers are worked out
//! in vectors, and what they move is scattered.

use fearless_simd::{Select, Simd, SimdBase, SimdFloat};

use super::lanes::{Lanes, WIDEST, load, splat, store};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Most bonds that are gathered at once: their numbers stay in the nearest cache. A multiple of [`WIDEST`].
const CHUNK: usize = 64;

/// Bonds that follow one law, in runs: no point occurs twice in one.
///
/// Shapes: `rest`, `gain` and `drag` have an entry a bond and are padded beyond, so that a vector may begin at the last one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links<S> {
    ends: Vec<[u32; 2]>,
    /// Rest lengths `[m]`.
    rest: Vec<S>,
    /// What a metre of error gives.
    gain: Vec<S>,
    /// Metres of error that a unit of the rate along the bond counts as.
    drag: Vec<S>,
    /// Where runs end.
    stops: Vec<usize>,
    is_damped: bool,
    /// In which run each point was seen last.
    seen: Vec<u32>,
}

/// A bond as a kernel takes it: see [`Links`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry<S> {
    pub(crate) ends: [u32; 2],
    pub(crate) rest: S,
    pub(crate) gain: S,
    pub(crate) drag: S,
}

impl<S: Real> Links<S> {
    /// None of them, between this many points.
    pub(crate) fn clear(&mut self, points: usize) {
        self.ends.clear();
        [&mut self.rest, &mut self.gain, &mut self.drag].into_iter().for_each(Vec::clear);
        self.stops.clear();
        self.is_damped = false;
        self.seen.clear();
        self.seen.resize(points, 0);
    }

    /// One more. Those that follow on each other should share no point: where they do a run ends.
    pub(crate) fn push(&mut self, entry: Entry<S>) {
        let [a, b] = [entry.ends[0] as usize, entry.ends[1] as usize];
        let run = self.stops.len() as u32 + 1;
        let run = if self.seen[a] == run || self.seen[b] == run {
            self.stops.push(self.ends.len());
            run + 1
        } else {
            run
        };
        (self.seen[a], self.seen[b]) = (run, run);
        self.ends.push(entry.ends);
        self.rest.push(entry.rest);
        self.gain.push(entry.gain);
        self.drag.push(entry.drag);
        self.is_damped |= entry.drag != S::ZERO;
    }

    /// No more will come.
    pub(crate) fn finish(&mut self) {
        if self.stops.last() != Some(&self.ends.len()) {
            self.stops.push(self.ends.len());
        }
        for list in [&mut self.rest, &mut self.gain, &mut self.drag] {
            list.resize(self.ends.len() + WIDEST, S::ZERO);
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }
}

/// What bonds move, one entry a point.
pub(crate) struct Moved<'a, S> {
    /// Where the points are `[m]`.
    pub(crate) now: &'a mut [[S; 2]],
    /// Their ways or velocities: what dampers look at.
    pub(crate) rate: &'a mut [[S; 2]],
    pub(crate) w: &'a [S],
}

/// Where the ends were as the substep began `[m]`, and what would have been otherwise along the directions of then `[m]`.
pub(crate) struct Turned<'a, S, const D: usize> {
    pub(crate) start: &'a [[S; D]],
    pub(crate) turned: &'a mut [[S; D]],
}

impl<S: Real, const D: usize> Turned<'_, S, D> {
    /// Notes what a bond whose ends a and b, of inverse masses `w` `[1/kg]`, are moved by -w_a `push` and w_b `push` would have changed along the
    /// direction that it had as the substep began. Nothing is noted of a pull so strong for the bond's length `[m]` that it would swing to
    /// and fro between substeps: above a share [`MOST_TURN`].
    ///
    /// A multiplier along the new direction, to which the bond turns by an angle t in the substep, takes the share t^2 of what speed there is;
    /// along the old one it takes nothing: J.-P. Ryckaert, G. Ciccotti, H. J. C. Berendsen, J. Comput. Phys. 23, 327, 1977.
    #[inline(always)]
    pub(crate) fn note(&mut self, [a, b]: [usize; 2], [w_a, w_b]: [S; 2], push: [S; D]) {
        let r = sub(self.start[a], self.start[b]);
        let (square, strength) = (dot(r, r), dot(push, push));
        let sum = w_a + w_b;
        let most = S::from_f64(MOST_TURN * MOST_TURN);
        // NaN is not noted, nor what is squeezed: it gives way sideways, the more the less that is damped.
        if strength * sum * sum <= most * square && dot(r, push) > S::ZERO {
            let other = sub(scale(r, (strength / square).sqrt()), push);
            self.turned[a] = sub(self.turned[a], scale(other, w_a));
            self.turned[b] = add(self.turned[b], scale(other, w_b));
        }
    }
}

/// Share of its length that a bond may move its ends by in a substep to be turned back: (w h)^2 of how it swings across is twice that. And
/// the angle that a joint may turn what it joins by.
pub(crate) const MOST_TURN: f64 = 0.25;

/// One sweep: with d = x_a - x_b and v the difference of the rates each bond gives -w_a f d to its first end and w_b f d to the other,
/// f = gain (|d| - rest + drag v . d/|d|)/|d|. It goes to the rates, and with `MOVES` to the places too; what
/// it would have been along old directions is noted where it is asked for.
///
/// Valid range: a bond of length 0 gives nothing.
#[inline(always)]
pub(crate) fn sweep<M: Simd, S: Real, const MOVES: bool>(
    m: M,
    links: &Links<S>,
    moved: &mut Moved<'_, S>,
    mut turned: Option<&mut Turned<'_, S, 2>>,
) {
    let mut parts = Parts { d: [[S::ZERO; CHUNK]; 2], v: [[S::ZERO; CHUNK]; 2], factor: [S::ZERO; CHUNK] };
    let mut from = 0;
    for &stop in &links.stops {
        while from < stop {
            let to = stop.min(from + CHUNK);
            let ends = &links.ends[from..to];
            gather(ends, moved, &mut parts, links.is_damped);
            factors(m, (&links.rest[from..], &links.gain[from..], &links.drag[from..]), ends.len(), &mut parts);
            scatter::<S, MOVES>(ends, moved, &parts);
            if let Some(turned) = &mut turned {
                turn(ends, moved.w, &parts, turned);
            }
            from = to;
        }
    }
}

/// The bonds of a chunk: differences of their ends by axis, and multipliers.
struct Parts<S> {
    d: [[S; CHUNK]; 2],
    v: [[S; CHUNK]; 2],
    factor: [S; CHUNK],
}

#[inline(always)]
fn gather<S: Real>(ends: &[[u32; 2]], moved: &Moved<'_, S>, parts: &mut Parts<S>, is_damped: bool) {
    let Parts { d: [x, y], v: [v_x, v_y], .. } = parts;
    for (lane, &[a, b]) in ends.iter().enumerate().take(CHUNK) {
        let (a, b) = (moved.now[a as usize], moved.now[b as usize]);
        x[lane] = a[0] - b[0];
        y[lane] = a[1] - b[1];
    }
    if is_damped {
        for (lane, &[a, b]) in ends.iter().enumerate().take(CHUNK) {
            let (a, b) = (moved.rate[a as usize], moved.rate[b as usize]);
            v_x[lane] = a[0] - b[0];
            v_y[lane] = a[1] - b[1];
        }
    }
}

#[inline(always)]
fn factors<M: Simd, S: Real>(m: M, (rest, gain, drag): (&[S], &[S], &[S]), count: usize, parts: &mut Parts<S>) {
    let Parts { d: [x, y], v: [v_x, v_y], factor } = parts;
    let (zero, one) = (splat::<M, S>(m, S::ZERO), splat::<M, S>(m, S::ONE));
    for at in (0..count).step_by(Lanes::<M, S>::LEN) {
        let (x, y) = (load(m, x, at), load(m, y, at));
        let length = (x * x + y * y).sqrt();
        let over = one / length;
        let closing = (load(m, v_x, at) * x + load(m, v_y, at) * y) * over;
        let error = length - load(m, rest, at) + load(m, drag, at) * closing;
        let pull = error * load(m, gain, at) * over;
        store::<M, S>(length.simd_gt(zero).select(pull, zero), factor, at);
    }
}

#[inline(always)]
fn scatter<S: Real, const MOVES: bool>(ends: &[[u32; 2]], moved: &mut Moved<'_, S>, parts: &Parts<S>) {
    let Parts { d: [x, y], factor, .. } = parts;
    for (lane, &[a, b]) in ends.iter().enumerate().take(CHUNK) {
        let (a, b) = (a as usize, b as usize);
        let (f_x, f_y) = (x[lane] * factor[lane], y[lane] * factor[lane]);
        let (w_a, w_b) = (moved.w[a], moved.w[b]);
        let (to_a, to_b) = ([f_x * w_a, f_y * w_a], [f_x * w_b, f_y * w_b]);
        for k in 0..2 {
            moved.rate[a][k] -= to_a[k];
            moved.rate[b][k] += to_b[k];
        }
        if MOVES {
            for k in 0..2 {
                moved.now[a][k] -= to_a[k];
                moved.now[b][k] += to_b[k];
            }
        }
    }
}

#[inline(always)]
fn turn<S: Real>(ends: &[[u32; 2]], w: &[S], parts: &Parts<S>, turned: &mut Turned<'_, S, 2>) {
    let Parts { d: [x, y], factor, .. } = parts;
    for (lane, &[a, b]) in ends.iter().enumerate().take(CHUNK) {
        let (a, b) = (a as usize, b as usize);
        turned.note([a, b], [w[a], w[b]], [x[lane] * factor[lane], y[lane] * factor[lane]]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::kernels::level::{InstructionSet, vectorized};

    /// A strip of squares with both diagonals, stretched and moving.
    fn swept(set: InstructionSet) -> Vec<[f64; 2]> {
        let count = 60_u32;
        let mut links = Links::default();
        links.clear(count as usize);
        for step in [1, 2, 3] {
            for a in 0..count - step {
                let rest = 0.1 * f64::from(1 + a % 3);
                links.push(Entry { ends: [a, a + step], rest, gain: 0.3, drag: 0.01 * f64::from(a % 2) });
            }
        }
        // Both ends at one place: no direction.
        links.push(Entry { ends: [0, 0], rest: 0.1, gain: 0.3, drag: 0.0 });
        links.finish();
        let at = |i: u32| [0.11 * f64::from(i), 0.07 * f64::from(i % 4)];
        let (mut now, mut rate): (Vec<[f64; 2]>, Vec<[f64; 2]>) = (0..count).map(|i| (at(i), at(i * 7 % 13))).unzip();
        let w: Vec<f64> = (0..count).map(|i| f64::from(i % 5)).collect();
        let chosen = InstructionSet::chosen();
        set.choose();
        let mut moved = Moved { now: &mut now, rate: &mut rate, w: &w };
        vectorized!(m => sweep::<_, _, true>(m, &links, &mut moved, None));
        chosen.choose();
        now
    }

    #[test]
    fn the_bits_do_not_depend_on_the_width_of_vectors() {
        let narrow = swept(InstructionSet::Baseline);
        assert!(narrow.iter().flatten().all(|x| x.is_finite()));
        for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
            assert_eq!(swept(set), narrow, "{set}");
        }
    }

    #[test]
    fn a_stretched_bond_gives_its_ends_what_is_missing_by_their_weights() {
        let mut links = Links::default();
        links.clear(2);
        links.push(Entry { ends: [0, 1], rest: 1.0, gain: 0.25, drag: 0.0 });
        links.finish();
        let (mut now, mut rate) = ([[0.0, 0.0], [0.0, 2.0]], [[0.0; 2]; 2]);
        let mut moved = Moved { now: &mut now, rate: &mut rate, w: &[1.0, 3.0] };
        vectorized!(m => sweep::<_, _, true>(m, &links, &mut moved, None));
        assert_eq!((now, rate), ([[0.0, 0.25], [0.0, 1.25]], [[0.0, 0.25], [0.0, -0.75]]));
    }
}
