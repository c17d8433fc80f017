//! A sheet: rows and columns of points, with the same bonds in every cell.

use fearless_simd::Simd;

use super::form::{Form, MOST_IDLE, Run};
use super::spec::{Spec, Substep};
use crate::sim::bond::BondKind;
use crate::sim::kernels::cells::{Cells, View};
use crate::sim::kernels::lanes::{Lanes, Mask, WIDEST, between, largest, load, splat, store, width};
use crate::sim::kernels::law::{Law, Rigid};
use crate::sim::kernels::level::vectorized;
use crate::sim::kernels::pair::{Correct, Measure};
use crate::sim::kernels::path::{self, GONE, PathLaw, Scratch, Strip};
use crate::sim::kernels::rows::{self, Cut, Kinds, Shape};
use crate::sim::kernels::store::Store;
use crate::sim::kernels::turn::Turned;
use crate::sim::real::Real;
use crate::sim::threads;

/// Points that one thread takes at a time.
const PART: usize = 1 << 12;

/// What a sheet pulls by, in its weight, when it falls into a few pins.
const FALL_INTO_PINS: f64 = 2.25;

/// The directions in which bonds of a sheet make lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lines {
    Along,
    Down,
    Falling,
    Rising,
}

/// A sheet: where its points lie, what its bonds are.
#[derive(Clone, Debug)]
pub(crate) struct Sheet<S, const D: usize> {
    shape: Shape,
    specs: Kinds<Spec>,
    /// Rows whose points all have weight 1.
    is_plain: Vec<bool>,
    /// Where bonds are gone.
    holes: Option<Box<Holes<S>>>,
    /// Rows are solved after columns: they bear the load.
    rows_last: bool,
    /// Rows side by side, and what a solve keeps: for each thread.
    rooms: Vec<(Cells<S, D>, Scratch<S>)>,
    /// The pulls of rows or columns.
    pulls: Vec<S>,
}

/// What a sheet knows of bonds that are gone.
#[derive(Clone, Debug)]
struct Holes<S> {
    /// Rest length of each bond at the cell of its first point `[m]`: [`GONE`] of those that are gone.
    rests: Kinds<Vec<S>>,
    /// Rows with such a bond, of their own or to the next row.
    is_in: Vec<bool>,
    /// How many are gone.
    count: usize,
}

impl<S: Real, const D: usize> Sheet<S, D> {
    pub(crate) fn new(columns: usize, rows: usize, specs: Kinds<Spec>, rows_last: bool) -> Self {
        let shape = Shape::new(columns, rows);
        Sheet {
            shape,
            specs,
            is_plain: vec![true; rows],
            holes: None,
            rows_last,
            rooms: vec![(Cells::new(2 * shape.half * WIDEST), Scratch::default())],
            pulls: vec![S::ZERO; rows.max(2 * shape.half).next_multiple_of(WIDEST)],
        }
    }

    /// One sweep over all bonds.
    fn sweep_by<L: Law<S>>(&self, cells: &mut Cells<S, D>, law: impl Fn(&Spec) -> L + Sync) {
        let Sheet { shape, is_plain, .. } = self;
        for parity in 0..2 {
            let parts = self.parts(cells, parity);
            threads::with_each(self.bond_count(), parts, |(first, mut view)| {
                let kinds = self.cuts(&law, shape.row(first));
                vectorized!(m => {
                    let end = (first + self.shape.rows_of_part()).min(shape.rows);
                    for row in (first..end).step_by(2) {
                        let has_next = row + 1 < shape.rows;
                        let plain = is_plain[row] && (!has_next || is_plain[row + 1]) && !self.has_hole(row);
                        let here = ((row - first) * shape.pitch, has_next, plain);
                        rows::row::<_, S, L, _, D>(m, &mut Correct, &mut view, shape, &kinds, here);
                    }
                });
            });
        }
    }

    /// The bonds of each kind, for a view that begins at a cell.
    fn cuts<L>(&self, law: impl Fn(&Spec) -> L, from: usize) -> Kinds<Cut<'_, L, S>> {
        let rests = self.holes.as_ref().map(|holes| &holes.rests);
        self.specs.with(rests, |spec, rests| Cut {
            law: law(spec),
            rest: S::from_f64(spec.rest),
            rests: rests.map(|list| &list[from..]),
        })
    }

    fn has_hole(&self, row: usize) -> bool {
        self.holes.as_ref().is_some_and(|holes| holes.is_in[row])
    }

    /// The rows from `start` on in parts, each with its first row.
    fn parts<'a>(&self, cells: &'a mut Cells<S, D>, start: usize) -> impl Iterator<Item = (usize, View<'a, S, D>)> {
        let (rows, all) = (self.shape.rows_of_part(), self.shape.rows);
        let parts = cells.view().after(self.shape.row(start)).parts(rows * self.shape.pitch);
        parts
            .into_iter()
            .enumerate()
            .map(move |(k, part)| (start + k * rows, part))
            .filter(move |(first, _)| *first < all)
    }

    /// In the plane, diagonals hold rows and columns across their direction.
    fn is_braced(&self) -> bool {
        D == 2 && self.specs.falling.is_some() && self.specs.rising.is_some()
    }

    fn bond_count(&self) -> usize {
        let Shape { columns, rows, .. } = self.shape;
        let diagonals = self.specs.falling.iter().chain(&self.specs.rising).count();
        (columns - 1) * rows + columns * (rows - 1) + diagonals * (columns - 1) * (rows - 1)
    }

    /// Solves lines of one direction, if they have bonds. Returns the pull of rows and columns.
    fn solve_lines(&mut self, lines: Lines, cells: &mut Cells<S, D>, step: &Substep) -> S {
        let Some(spec) = self.specs.of(lines) else { return S::ZERO };
        let (law, rest) = (spec.path::<S>(step), S::from_f64(spec.rest));
        match lines {
            Lines::Along => self.solve_rows(cells, &law, rest),
            Lines::Down => self.solve_columns(cells, &law, rest),
            Lines::Falling | Lines::Rising => {
                self.solve_diagonals(cells, lines, &law, rest);
                S::ZERO
            }
        }
    }

    /// Solves every column. Returns their pull.
    fn solve_columns(&mut self, cells: &mut Cells<S, D>, law: &PathLaw<S>, rest: S) -> S {
        let Sheet { shape, rooms, pulls, holes, .. } = self;
        let rests = rests_of(holes, Lines::Down);
        let scratch = &mut rooms[0].1;
        let mut view = cells.view();
        vectorized!(m => {
            for parity in 0..2.min(shape.columns) {
                let count = (shape.columns - parity).div_ceil(2);
                for k in (0..count).step_by(width::<_, S>(m)) {
                    let strip = Columns { m, shape, parity, k, count, rest, rests };
                    let pull = path::solve(m, &mut view, &strip, law, scratch);
                    store::<_, S>(pull, pulls, parity * shape.half + k);
                }
            }
        });
        self.pull(self.shape.columns)
    }

    /// Solves every row. Returns their pull.
    fn solve_rows(&mut self, cells: &mut Cells<S, D>, law: &PathLaw<S>, rest: S) -> S {
        let (shape, count) = (self.shape, self.bond_count());
        let Sheet { rooms, pulls, holes, .. } = self;
        let rests = rests_of(holes, Lines::Along);
        let rows = shape.rows_of_part().next_multiple_of(WIDEST);
        let parts = cells.view().after(shape.row(0)).parts(rows * shape.pitch).enumerate();
        let parts = parts.zip(pulls.chunks_mut(rows));
        let parts = parts.map(|((k, part), pulls)| (k * rows, part, pulls));
        let room = || (Cells::new(2 * shape.half * WIDEST), Scratch::default());
        threads::with_each_in(count, parts, rooms, room, |(turned, scratch), (first, mut view, pulls)| {
            let rests = rests.map(|list| &list[shape.row(first).min(list.len())..]);
            let rows = shape.rows.saturating_sub(first).min(rows);
            let shape = Shape { rows, ..shape };
            vectorized!(m => {
                for first in (0..rows).step_by(width::<_, S>(m)) {
                    let strip = Turned { m, shape: &shape, first, rest, rests };
                    strip.read(&view, turned);
                    let pull = path::solve(m, &mut turned.view(), &strip, law, scratch);
                    store::<_, S>(pull, pulls, first);
                    strip.write(turned, &mut view);
                }
            });
        });
        self.pull(shape.rows)
    }

    /// The pull of so many rows or columns, and none of their padding.
    ///
    /// Across its direction a row is held by all columns. In the plane what rows do together counts: of each column they
    /// move all points, if they move any. In space nothing holds points across both.
    fn pull(&mut self, count: usize) -> S {
        let all = self.pulls.iter();
        let pull = if D == 2 {
            all.fold(S::ZERO, |sum, &pull| sum + pull) / S::from_f64(count as f64)
        } else {
            all.fold(S::ZERO, |most, &pull| most.max(pull))
        };
        self.pulls.fill(S::ZERO);
        pull
    }

    /// Solves every diagonal of those that fall to the right, or of those that rise.
    fn solve_diagonals(&mut self, cells: &mut Cells<S, D>, lines: Lines, law: &PathLaw<S>, rest: S) {
        let slope = if lines == Lines::Falling { 1 } else { -1 };
        let Sheet { shape, rooms, holes, .. } = self;
        let rests = rests_of(holes, lines);
        let scratch = &mut rooms[0].1;
        let mut view = cells.view();
        let (rows, columns) = (shape.rows as isize, shape.columns as isize);
        // Columns where diagonals would meet row 0.
        let first = if slope > 0 { 1 - rows } else { 0 };
        let last = if slope > 0 { columns - 1 } else { columns + rows - 2 };
        vectorized!(m => {
            let span = 2 * width::<_, S>(m) as isize;
            for parity in 0..2 {
                for start in (first + parity..=last).step_by(span as usize) {
                    if let Some(strip) = Diagonals::new(m, shape, slope, (start, span), (rest, rests)) {
                        path::solve(m, &mut view, &strip, law, scratch);
                    }
                }
            }
        });
    }
}

impl<S: Real, const D: usize> Form<S, D> for Sheet<S, D> {
    type Store = Cells<S, D>;

    fn cells(&self) -> usize {
        self.shape.count()
    }

    #[inline(always)]
    fn runs(&self, mut visit: impl FnMut(Run)) {
        let Shape { columns, rows, half, .. } = self.shape;
        for row in 0..rows {
            for parity in 0..2 {
                let (point, cell) = (row * columns + parity, self.shape.row(row) + parity * half);
                visit(Run { point, point_step: 2, cell, cell_step: 1, count: (columns + 1 - parity) / 2 });
            }
        }
    }

    fn weigh(&mut self, cells: &mut Cells<S, D>) {
        let Shape { columns, rows, .. } = self.shape;
        let is_one = |row, column| cells.w[self.shape.at(row, column)] == S::ONE;
        self.is_plain = (0..rows).map(|row| (0..columns).all(|column| is_one(row, column))).collect();
    }

    fn bears(&self, cells: &mut Cells<S, D>) -> f64 {
        let (mut mass, mut pins) = (0.0, 0_u32);
        Form::<S, D>::each(self, |_, cell| match cells.w[cell].to_f64() {
            0.0 => pins += 1,
            w => mass += 1.0 / w,
        });
        let rest = self.specs.along.rest.min(self.specs.down.rest);
        // From a few points it falls into its pins.
        let blow = if 2 * pins as usize >= self.shape.columns.min(self.shape.rows) { 1.0 } else { FALL_INTO_PINS };
        if self.is_braced() || pins == 0 { 0.0 } else { blow * mass / f64::from(pins) / rest }
    }

    fn sweep(&mut self, cells: &mut Cells<S, D>, step: &Substep) {
        match self.specs.along.kind {
            BondKind::Rigid => self.sweep_by(cells, |_| Rigid),
            _ => self.sweep_by(cells, |spec| spec.elastic::<S>(step)),
        }
    }

    fn solve(&mut self, cells: &mut Cells<S, D>, step: &Substep) -> S {
        let (light, heavy) = if self.rows_last { (Lines::Down, Lines::Along) } else { (Lines::Along, Lines::Down) };
        let diagonals = [Lines::Falling, Lines::Rising];
        let is_rigid = self.specs.along.kind == BondKind::Rigid;
        let both_ways = is_rigid && self.specs.falling.is_some() != self.specs.rising.is_some();
        let there: &[Lines] = if both_ways { &[heavy, light] } else { &[] };
        let mut pull = S::ZERO;
        for lines in there.iter().chain(&diagonals).chain(&[light, heavy]) {
            pull = pull.max(self.solve_lines(*lines, cells, step));
        }
        if self.is_braced() { S::ZERO } else { pull }
    }

    fn stretch(&self, cells: &mut Cells<S, D>) -> S {
        if self.specs.along.kind != BondKind::Rigid {
            return S::ZERO;
        }
        let shape = &self.shape;
        // Bonds to the row below the last one of a part are measured one after the other.
        let rows = self.shape.rows_of_part();
        let within = threads::largest_of(
            self.bond_count(),
            self.parts(cells, 0).collect(),
            S::ZERO,
            |(first, mut view): (usize, View<'_, S, D>)| {
                let end = (first + rows).min(shape.rows);
                let kinds = self.cuts(|_| (), shape.row(first));
                vectorized!(m => {
                    let mut measure = Measure { most: splat(m, S::ZERO) };
                    for row in first..end {
                        let here = ((row - first) * shape.pitch, row + 1 < end, !self.has_hole(row));
                        rows::row::<_, S, (), _, D>(m, &mut measure, &mut view, shape, &kinds, here);
                    }
                    largest::<_, S>(measure.most)
                })
            },
        );
        let mut view = cells.view();
        let kinds = self.cuts(|_| (), 0);
        vectorized!(m => {
            let mut measure = Measure { most: splat(m, within) };
            for row in (rows - 1..shape.rows - 1).step_by(rows) {
                let here = (shape.row(row), true, !self.has_hole(row));
                rows::row::<_, S, (), _, D>(m, &mut measure, &mut view, shape, &kinds, here);
            }
            largest::<_, S>(measure.most)
        })
    }

    fn lose(&mut self, [a, b]: [u32; 2], _: f64) -> bool {
        let Shape { columns, .. } = self.shape;
        let [row, column] = [a.min(b), a.max(b)].map(|i| i as usize).map(|i| [i / columns, i % columns])[0];
        let lines = match (a.abs_diff(b) as usize, column) {
            (1, _) if column + 1 < columns => Lines::Along,
            (step, _) if step == columns => Lines::Down,
            (step, _) if step == columns + 1 => Lines::Falling,
            _ => Lines::Rising,
        };
        let most = MOST_IDLE * self.bond_count() as f64;
        if self.specs.of(lines).is_none() || self.holes.as_ref().is_some_and(|holes| holes.count as f64 >= most) {
            return false;
        }
        let Sheet { holes, shape, specs, .. } = self;
        let holes = holes.get_or_insert_with(|| {
            let all = |spec: &Spec| vec![S::from_f64(spec.rest); shape.count() + WIDEST];
            Box::new(Holes { rests: specs.map(all), is_in: vec![false; shape.rows], count: 0 })
        });
        let Some(rests) = holes.rests.of_mut(lines) else { return false };
        let rest = &mut rests[shape.at(row, column)];
        let was_there = *rest > S::ZERO;
        *rest = S::from_f64(GONE);
        holes.is_in[row] = true;
        holes.count += usize::from(was_there);
        was_there
    }

    fn heap_bytes(&self) -> usize {
        let holes = self.holes.as_ref().map_or(0, |holes| 4 * size_of::<S>() * holes.rests.along.capacity());
        holes
            + self.is_plain.capacity()
            + self.rooms.iter().map(|(turned, scratch)| turned.heap_bytes() + scratch.heap_bytes()).sum::<usize>()
    }

    fn bonds(&self) -> usize {
        self.bond_count() - self.holes.as_ref().map_or(0, |holes| holes.count)
    }
}

impl<T> Kinds<T> {
    /// The kind of bonds that lie along lines.
    fn of(&self, lines: Lines) -> Option<&T> {
        match lines {
            Lines::Along => Some(&self.along),
            Lines::Down => Some(&self.down),
            Lines::Falling => self.falling.as_ref(),
            Lines::Rising => self.rising.as_ref(),
        }
    }

    fn of_mut(&mut self, lines: Lines) -> Option<&mut T> {
        match lines {
            Lines::Along => Some(&mut self.along),
            Lines::Down => Some(&mut self.down),
            Lines::Falling => self.falling.as_mut(),
            Lines::Rising => self.rising.as_mut(),
        }
    }
}

/// Rest lengths of the bonds along lines, where some are gone.
fn rests_of<S>(holes: &Option<Box<Holes<S>>>, lines: Lines) -> Option<&[S]> {
    holes.as_ref()?.rests.of(lines).map(Vec::as_slice)
}

impl Shape {
    /// Where the rows of a sheet go.
    ///
    /// Both halves of a row have room for the widest vector behind their last column, and rows are an odd number of cache
    /// lines apart: columns would else share few places of a cache.
    pub(crate) fn new(columns: usize, rows: usize) -> Self {
        let half = (columns.div_ceil(2).next_multiple_of(WIDEST) + 1).next_multiple_of(WIDEST);
        Shape { columns, rows, half, pitch: 2 * half + WIDEST }
    }

    /// The cell where a row begins.
    #[inline(always)]
    pub(crate) fn row(&self, row: usize) -> usize {
        WIDEST + row * self.pitch
    }

    /// The cell of a point.
    #[inline(always)]
    pub(crate) fn at(&self, row: usize, column: usize) -> usize {
        self.row(row) + column % 2 * self.half + column / 2
    }

    /// Rows that one thread takes at a time: an even number.
    fn rows_of_part(&self) -> usize {
        2 * (PART / (2 * self.columns)).max(1)
    }

    /// How many cells all rows take.
    pub(crate) fn count(&self) -> usize {
        WIDEST + self.rows * self.pitch
    }
}

/// Columns of one parity, side by side.
struct Columns<'a, M, S> {
    m: M,
    shape: &'a Shape,
    parity: usize,
    k: usize,
    count: usize,
    rest: S,
    /// Where bonds are gone: of each, at the cell of its upper point.
    rests: Option<&'a [S]>,
}

impl<M: Simd, S: Real> Strip<M, S> for Columns<'_, M, S> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.shape.rows
    }

    #[inline(always)]
    fn at(&self, k: usize) -> usize {
        self.shape.row(k) + self.parity * self.shape.half + self.k
    }

    #[inline(always)]
    fn lanes(&self, _: usize) -> Mask<M, S> {
        between::<M, S>(self.m, 0, self.count as isize - self.k as isize)
    }

    #[inline(always)]
    fn rest(&self, k: usize) -> Lanes<M, S> {
        match self.rests {
            Some(rests) => load(self.m, rests, Strip::<M, S>::at(self, k)),
            None => splat(self.m, self.rest),
        }
    }
}

/// Every other diagonal, side by side.
struct Diagonals<'a, M, S> {
    m: M,
    shape: &'a Shape,
    slope: isize,
    /// Column where the diagonal of lane 0 would meet row 0.
    start: isize,
    /// First row where any lane is in the sheet.
    first: usize,
    len: usize,
    rest: S,
    /// Where bonds are gone: of each, at the cell of its upper point.
    rests: Option<&'a [S]>,
}

impl<'a, M: Simd, S: Real> Diagonals<'a, M, S> {
    fn new(
        m: M,
        shape: &'a Shape,
        slope: isize,
        (start, span): (isize, isize),
        (rest, rests): (S, Option<&'a [S]>),
    ) -> Option<Self> {
        let (rows, columns) = (shape.rows as isize, shape.columns as isize);
        let end = start + span - 2;
        // Rows where a lane's column is in [0, columns): from the first lane to enter to the last to leave.
        let (enter, leave) = if slope > 0 { (-end, columns - 1 - start) } else { (start - columns + 1, end) };
        let (enter, leave) = (enter.max(0), leave.min(rows - 1));
        let len = (leave - enter + 1).max(0) as usize;
        (len > 1).then_some(Diagonals { m, shape, slope, start, first: enter as usize, len, rest, rests })
    }

    #[inline(always)]
    fn column(&self, k: usize) -> isize {
        self.start + self.slope * (self.first + k) as isize
    }
}

impl<M: Simd, S: Real> Strip<M, S> for Diagonals<'_, M, S> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.len
    }

    #[inline(always)]
    fn at(&self, k: usize) -> usize {
        let column = self.column(k);
        let parity = column.rem_euclid(2);
        let row = self.shape.row(self.first + k) + parity as usize * self.shape.half;
        (row as isize + column.div_euclid(2)) as usize
    }

    #[inline(always)]
    fn lanes(&self, k: usize) -> Mask<M, S> {
        let column = self.column(k);
        let place = column.div_euclid(2);
        let count = (self.shape.columns as isize - column.rem_euclid(2) + 1) / 2;
        between::<M, S>(self.m, -place, count - place)
    }

    #[inline(always)]
    fn rest(&self, k: usize) -> Lanes<M, S> {
        match self.rests {
            Some(rests) => load(self.m, rests, Strip::<M, S>::at(self, k)),
            None => splat(self.m, self.rest),
        }
    }
}
