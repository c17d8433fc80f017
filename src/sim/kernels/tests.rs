//! Paths against a dense solve of the same system, and turning there and back.

use fearless_simd::Simd;

use super::cells::Cells;
use super::lanes::{Lanes, Mask, WIDEST, between, load, width};
use super::level::{InstructionSet, vectorized};
use super::path::{self, PathLaw, Scratch, Strip};
use super::rows::Shape;
use super::split::{PIECES, Split};
use super::store::Store;
use super::turn::Turned;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub, widen};

/// The same numbers in [-0.5, 0.5) for the same seed.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

fn for_every_set(check: impl Fn()) {
    let before = InstructionSet::chosen();
    InstructionSet::ALL.into_iter().filter(|set| set.choose()).for_each(|_| check());
    before.choose();
}

/// A path as the test keeps it.
#[derive(Clone)]
struct Path<S, const D: usize> {
    x: Vec<[S; D]>,
    d: Vec<[S; D]>,
    w: Vec<S>,
    rest: Vec<S>,
}

impl<S: Real, const D: usize> Path<S, D> {
    /// A crooked path whose bonds are off by up to a tenth of their rest lengths.
    fn random(draw: &mut Draw, count: usize, pins: &[usize]) -> Self {
        let (mut x, mut rest) = (vec![[S::ZERO; D]], Vec::new());
        for _ in 1..count {
            let mut way = [0.0; D];
            way.iter_mut().for_each(|c| *c = draw.next());
            way[0] += 0.7;
            let size = (0.1 + 0.05 * draw.next()) / length(way);
            let last = x[x.len() - 1];
            x.push(std::array::from_fn(|k| last[k] + S::from_f64(way[k] * size)));
            rest.push(S::from_f64(size * length(way) * (1.0 + 0.1 * draw.next())));
        }
        let d = (0..count).map(|_| std::array::from_fn(|_| S::from_f64(0.005 * draw.next()))).collect();
        let mut w: Vec<S> = (0..count).map(|_| S::from_f64(1.0 + draw.next())).collect();
        pins.iter().filter(|&&pin| pin < count).for_each(|&pin| w[pin] = S::ZERO);
        Path { x, d, w, rest }
    }

    /// Displacements after one round, by elimination of the whole matrix in `f64`.
    fn solved(&self, law: &PathLaw<S>) -> Vec<[f64; D]> {
        let (alpha, share) = (law.alpha.to_f64(), law.share.to_f64());
        let bonds = self.rest.len();
        let (x, d): (Vec<_>, Vec<_>) = (0..=bonds).map(|i| (widen(self.x[i]), widen(self.d[i]))).unzip();
        let w: Vec<f64> = self.w.iter().map(|w| w.to_f64()).collect();
        let mut ways = vec![[0.0; D]; bonds];
        let mut matrix = vec![vec![0.0; bonds + 1]; bonds];
        for k in 0..bonds {
            let change = sub(d[k], d[k + 1]);
            let e = add(sub(x[k], x[k + 1]), change);
            if length(e) > 0.0 && w[k] + w[k + 1] > 0.0 {
                ways[k] = scale(e, 1.0 / length(e));
                matrix[k][k] = w[k] + w[k + 1] + alpha;
                let error = (length(e) - self.rest[k].to_f64()) * share + dot(ways[k], change) * (1.0 - share);
                matrix[k][bonds] = -error;
            } else {
                matrix[k][k] = 1.0;
            }
            if k > 0 {
                let beside = -w[k] * dot(ways[k - 1], ways[k]);
                (matrix[k - 1][k], matrix[k][k - 1]) = (beside, beside);
            }
        }
        let lambda = eliminate(matrix);
        let push = |k: usize| scale(ways[k], lambda[k]);
        (0..=bonds)
            .map(|i| {
                let behind = if i < bonds { push(i) } else { [0.0; D] };
                let before = if i > 0 { push(i - 1) } else { [0.0; D] };
                add(d[i], scale(sub(behind, before), w[i]))
            })
            .collect()
    }

    /// Asserts that displacements are the solved ones but for rounding.
    fn check(&self, law: &PathLaw<S>, moved: impl Fn(usize) -> [S; D], what: &str) {
        for (i, truth) in self.solved(law).into_iter().enumerate() {
            let off = length(sub(widen(moved(i)), truth));
            // Displacements are some hundredths; a path of free ends loses up to its length squared in rounding.
            let allowed = 20.0 * self.x.len() as f64 * S::EPSILON.to_f64();
            assert!(off < allowed, "{what}: point {i} of {} off by {off:e}, {allowed:e} allowed", self.x.len());
        }
    }
}

/// The solution of a system whose right-hand side is the last column, by Gauss with partial pivoting.
fn eliminate(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let best = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs())).unwrap_or(k);
        rows.swap(k, best);
        let (above, below) = rows.split_at_mut(k + 1);
        let pivot = &above[k];
        for row in below.iter_mut().filter(|row| row[k] != 0.0) {
            let factor = row[k] / pivot[k];
            row[k..].iter_mut().zip(&pivot[k..]).for_each(|(value, above)| *value -= factor * above);
        }
    }
    let mut solution = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * solution[j]).sum();
        solution[k] = (rows[k][n] - known) / rows[k][k];
    }
    solution
}

/// Paths side by side, the longest first.
struct Side<'a, M, S> {
    m: M,
    lane: usize,
    counts: &'a [usize],
    rests: &'a [S],
}

impl<M: Simd, S: Real> Strip<M, S> for Side<'_, M, S> {
    fn len(&self) -> usize {
        self.counts.len()
    }

    fn at(&self, k: usize) -> usize {
        k * WIDEST + self.lane
    }

    fn lanes(&self, k: usize) -> Mask<M, S> {
        between::<M, S>(self.m, 0, self.counts[k] as isize - self.lane as isize)
    }

    fn rest(&self, k: usize) -> Lanes<M, S> {
        load(self.m, self.rests, k * WIDEST + self.lane)
    }
}

/// One round over paths side by side.
fn solve<S: Real, const D: usize>(paths: &[Path<S, D>], law: &PathLaw<S>) -> Cells<S, D> {
    let longest = paths[0].x.len();
    let mut cells = Cells::<S, D>::new(longest * WIDEST);
    let mut rests = vec![S::ONE; longest * WIDEST];
    let counts: Vec<usize> = (0..longest).map(|k| paths.iter().filter(|path| path.x.len() > k).count()).collect();
    for (lane, path) in paths.iter().enumerate() {
        for k in 0..path.x.len() {
            cells.put(k * WIDEST + lane, path.x[k], path.d[k]);
            *cells.weight(k * WIDEST + lane) = path.w[k];
            if k < path.rest.len() {
                rests[k * WIDEST + lane] = path.rest[k];
            }
        }
    }
    let mut scratch = Scratch::default();
    vectorized!(m => {
        for lane in (0..paths.len()).step_by(width::<_, S>(m)) {
            let strip = Side { m, lane, counts: &counts, rests: &rests };
            path::solve(m, &mut cells.view(), &strip, law, &mut scratch);
        }
    });
    cells
}

/// Laws whose solve ends after one round.
fn laws<S: Real>() -> [PathLaw<S>; 3] {
    let law = |alpha, share| PathLaw { alpha: S::from_f64(alpha), share: S::from_f64(share), tolerance: S::INFINITY };
    [law(0.0, 1.0), law(0.3, 1.0), law(0.2, 0.6)]
}

fn paths_are_solved<S: Real, const D: usize>() {
    let mut draw = Draw(1);
    let pins: [&[usize]; 6] = [&[], &[0], &[8], &[19], &[0, 19], &[0, 7, 8, 12]];
    for law in laws::<S>() {
        for (turn, pins) in pins.into_iter().enumerate() {
            let lengths = (0..1 + 3 * turn).map(|lane| 20 - lane);
            let mut paths: Vec<Path<S, D>> = lengths.map(|count| Path::random(&mut draw, count, pins)).collect();
            // Two points at one place: no direction, no bond.
            let first = &mut paths[0];
            let shift = sub(first.x[5], first.x[4]);
            first.x[5..].iter_mut().for_each(|x| *x = sub(*x, shift));
            (first.x[5], first.d[5]) = (first.x[4], first.d[4]);
            let cells = solve(&paths, &law);
            for (lane, path) in paths.iter().enumerate() {
                let what = format!("{law:?}, pins {pins:?}, lane {lane}");
                path.check(&law, |k| cells.get(k * WIDEST + lane).1, &what);
            }
        }
    }
}

#[test]
fn paths_side_by_side_are_solved_as_their_system_says() {
    for_every_set(|| {
        paths_are_solved::<f32, 2>();
        paths_are_solved::<f64, 2>();
        paths_are_solved::<f32, 3>();
        paths_are_solved::<f64, 3>();
    });
}

fn pieces_are_solved<S: Real, const D: usize>() {
    let mut draw = Draw(2);
    for count in [PIECES + 2, 65, 79, 80, 81, 97, 130] {
        let pins: [&[usize]; 5] = [&[], &[0], &[count / 2], &[count - 1], &[0, count - 1]];
        for (law, pins) in laws::<S>().into_iter().flat_map(|law| pins.map(|pins| (law, pins))) {
            let path = Path::<S, D>::random(&mut draw, count, pins);
            let mut split = Split::new(&path.rest);
            let mut cells = Cells::<S, D>::new(split.cells());
            for k in 0..count {
                cells.put(split.at(k), path.x[k], path.d[k]);
                *cells.weight(split.at(k)) = path.w[k];
            }
            split.solve(&mut cells, &law);
            path.check(&law, |k| cells.get(split.at(k)).1, &format!("{law:?}, pins {pins:?}"));
        }
    }
}

#[test]
fn a_path_in_pieces_is_solved_as_one() {
    for_every_set(|| {
        pieces_are_solved::<f32, 2>();
        pieces_are_solved::<f64, 2>();
        pieces_are_solved::<f64, 3>();
    });
}

/// Rounds go on until every bond fits, those between pieces as well.
#[test]
fn rounds_bring_all_bonds_to_the_tolerance() {
    let law = PathLaw { alpha: 0.0, share: 1.0, tolerance: 1e-4 };
    for seed in 0..40 {
        let mut path = Path::<f64, 2>::random(&mut Draw(seed), 80, &[0]);
        let mut draw = Draw(seed + 100);
        path.d.iter_mut().skip(1).for_each(|d| *d = [0.03 * draw.next(), 0.03 * draw.next()]);
        let mut split = Split::new(&path.rest);
        let mut cells = Cells::<f64, 2>::new(split.cells());
        for k in 0..80 {
            cells.put(split.at(k), path.x[k], path.d[k]);
            *cells.weight(split.at(k)) = path.w[k];
        }
        split.solve(&mut cells, &law);
        for k in 0..79 {
            let [(xa, da), (xb, db)] = [k, k + 1].map(|k| cells.get(split.at(k)));
            let strain = length(add(sub(xa, xb), sub(da, db))) / path.rest[k] - 1.0;
            assert!(strain.abs() < 1.05e-4, "seed {seed}: bond {k} {strain:e}");
        }
    }
}

fn turned_and_back<S: Real, const D: usize>() {
    for (columns, rows) in (1..=40).map(|columns| (columns, 41 - columns)).chain([(33, 16), (16, 33), (40, 40)]) {
        let shape = Shape::new(columns, rows);
        let mut cells = Cells::<S, D>::new(shape.count());
        let value = |row: usize, column: usize| S::from_f64((row * 100 + column) as f64);
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let v = value(row, column);
            cells.put(shape.at(row, column), [v; D], [v + S::HALF; D]);
            *cells.weight(shape.at(row, column)) = v;
        }
        let before = cells.clone();
        let mut turned = Cells::<S, D>::new(2 * shape.half * WIDEST);
        vectorized!(m => {
            for first in (0..rows).step_by(width::<_, S>(m)) {
                let strip = Turned { m, shape: &shape, first, rest: S::ONE, rests: None };
                strip.read(&cells.view().after(shape.row(0)), &mut turned);
                for lane in 0..width::<_, S>(m).min(rows - first) {
                    for column in 0..columns {
                        let at = Strip::<_, S>::at(&strip, column) + lane;
                        let v = value(first + lane, column);
                        assert_eq!(turned.get(at), ([v; D], [v + S::HALF; D]));
                        assert_eq!(turned.w[at], v);
                    }
                }
                strip.write(&turned, &mut cells.view().after(shape.row(0)));
            }
        });
        for row in 0..rows {
            for column in 0..columns {
                let at = shape.at(row, column);
                assert_eq!(cells.get(at), before.get(at), "{columns} x {rows}");
            }
        }
    }
}

#[test]
fn rows_are_turned_and_back() {
    for_every_set(|| {
        turned_and_back::<f32, 2>();
        turned_and_back::<f64, 3>();
    });
}
