//! Sweeps in vectors against a plain program that takes one bond after another: bit for bit.

use super::crowd::Crowd;
use super::form::Form;
use super::mesh::Mesh;
use super::sheet::Sheet;
use super::spec::{Spec, Substep};
use super::trails::Segment;
use crate::sim::bond::{BondKind, Limit};
use crate::sim::colour::colours;
use crate::sim::kernels::level::InstructionSet;
use crate::sim::kernels::rows::Kinds;
use crate::sim::kernels::store::{Drift, Store};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// The same numbers in [-0.5, 0.5) for the same seed.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

const STEP: Substep =
    Substep { h: 0.01, reference: 1.0, share: 0.8, tolerance: 1e-3, tautness: f64::INFINITY, kick: None };
/// The same where springs push.
const PUSH: Substep = Substep { kick: Some(0.007), reference: 0.7, ..STEP };

/// The plain program: points in the order of the body.
#[derive(Clone)]
struct Plain<S, const D: usize> {
    x: Vec<[S; D]>,
    d: Vec<[S; D]>,
    w: Vec<S>,
}

impl<S: Real, const D: usize> Plain<S, D> {
    /// Points about a metre apart in rows of `columns`; every seventh pinned or of another mass where it is weighted.
    fn random(seed: u64, (columns, count): (usize, usize), is_weighted: bool) -> Self {
        let mut draw = Draw(seed);
        let place = |i: usize, k: usize| if k == 0 { i % columns } else { i / columns };
        let x = (0..count).map(|i| {
            std::array::from_fn(|k| S::from_f64(if k < 2 { place(i, k) as f64 } else { 0.0 } + 0.2 * draw.next()))
        });
        let x: Vec<[S; D]> = x.collect();
        let d = (0..count).map(|_| std::array::from_fn(|_| S::from_f64(0.3 * draw.next()))).collect();
        let w = (0..count).map(|i| match i % 7 {
            _ if !is_weighted => 1.0,
            2 => 0.0,
            3 if i > 10 => 0.0,
            5 => 0.3,
            _ => 1.0,
        });
        Plain { x, d, w: w.map(S::from_f64).collect() }
    }

    /// One bond, as the laws are written down.
    fn correct(&mut self, [a, b]: [usize; 2], spec: &Spec, step: &Substep) {
        let (rest, sum) = (S::from_f64(spec.rest), self.w[a] + self.w[b]);
        let change = sub(self.d[a], self.d[b]);
        let is_force = step.kick.is_some() && matches!(spec.kind, BondKind::Spring { .. });
        let start = sub(self.x[a], self.x[b]);
        let e = if is_force { start } else { add(start, change) };
        let square = dot(e, e);
        let factor = match spec.kind {
            BondKind::Rigid => (rest * rest - square) / ((rest * rest + square) * sum),
            BondKind::Relaxed { .. } => {
                let law = spec.relaxed::<S>(step);
                let error = law.relaxation * (rest / square.sqrt() - S::ONE);
                error.max(law.least).min(law.most) * law.share / sum
            }
            BondKind::Spring { stiffness, damping } if is_force => {
                let of = |size: f64| S::from_f64(size);
                let time = step.kick.unwrap_or_default() * step.reference;
                let pull = of(stiffness * step.h * time) * (S::ONE - rest / square.sqrt());
                -(pull + of(damping * time) * dot(e, change) / square)
            }
            BondKind::Spring { .. } => {
                let law = spec.compliant::<S>(step);
                let top = square - rest * square.sqrt() + law.gamma * dot(e, change);
                -top / (((S::ONE + law.gamma) * sum + law.alpha) * square)
            }
        };
        if sum > S::ZERO && square > S::ZERO {
            self.d[a] = add(self.d[a], scale(e, factor * self.w[a]));
            self.d[b] = sub(self.d[b], scale(e, factor * self.w[b]));
        }
    }

    /// |e.e - rest^2|/rest^2 of a rigid bond.
    fn stretch(&self, [a, b]: [usize; 2], spec: &Spec) -> S {
        if spec.kind != BondKind::Rigid {
            return S::ZERO;
        }
        let e = add(sub(self.x[a], self.x[b]), sub(self.d[a], self.d[b]));
        let square = S::from_f64(spec.rest) * S::from_f64(spec.rest);
        (dot(e, e) - square).abs() / square
    }

    /// Puts the points into a store of the form.
    fn store<F: Form<S, D>>(&self, form: &mut F) -> F::Store {
        let mut store = F::Store::new(form.cells());
        form.each(|i, cell| {
            *store.weight(cell) = self.w[i];
            store.put(cell, self.x[i], self.d[i]);
        });
        form.weigh(&mut store);
        store
    }

    /// Asserts that the form sweeps as `order` says, bond by bond, three times, and measures the same.
    fn check<F: Form<S, D> + Clone>(self, form: &mut F, order: &[([usize; 2], Spec)], what: &str) {
        self.clone().check_by(STEP, &mut form.clone(), order, what);
        self.check_by(PUSH, form, order, &format!("{what}, forces"));
    }

    fn check_by<F: Form<S, D>>(mut self, step: Substep, form: &mut F, order: &[([usize; 2], Spec)], what: &str) {
        let mut store = self.store(form);
        assert_eq!(form.bonds(), order.len(), "{what}");
        let drift = Drift { keep: S::from_f64(0.9), ratio: S::ONE, fall: [S::from_f64(-0.01); D] };
        for sweep in 0..3 {
            form.sweep(&mut store, &step);
            order.iter().for_each(|(ends, spec)| self.correct(*ends, spec, &step));
            form.each(|i, cell| assert_eq!(store.get(cell).1, self.d[i], "{what}: point {i} in sweep {sweep}"));
            let most = order.iter().map(|(ends, spec)| self.stretch(*ends, spec)).fold(S::ZERO, S::max);
            assert_eq!(form.stretch(&mut store), most, "{what}: strain");
            store.go_on(&drift);
            form.each(|i, cell| (self.x[i], self.d[i]) = store.get(cell));
        }
    }
}

/// One kind of every law, with this rest length `[m]`.
fn specs(rest: f64) -> [Spec; 4] {
    let spec = |kind, limit| Spec { rest, kind, limit };
    [
        spec(BondKind::Rigid, Limit::Both),
        spec(BondKind::Relaxed { relaxation: 0.7, max_correction: 0.05 }, Limit::Both),
        spec(BondKind::Relaxed { relaxation: 0.7, max_correction: f64::INFINITY }, Limit::Max),
        spec(BondKind::Spring { stiffness: 3e4, damping: 40.0 }, Limit::Both),
    ]
}

/// Bonds of a sheet in the order of a sweep: even rows with the next one, then odd ones; of each row what lies in the same
/// place of its halves, then what reaches one place further.
fn row_order([columns, rows]: [usize; 2], specs: &Kinds<Spec>) -> Vec<([usize; 2], Spec)> {
    let mut order = Vec::new();
    for row in (0..rows).step_by(2).chain((1..rows).step_by(2)) {
        let at = |column: usize, down: usize| (row + down) * columns + column;
        let mut bond = |[a, b]: [(usize, usize); 2], spec: Option<Spec>| {
            if let Some(spec) = spec
                && a.0.max(b.0) < columns
                && row + a.1.max(b.1) < rows
            {
                order.push(([at(a.0, a.1), at(b.0, b.1)], spec));
            }
        };
        let Kinds { along, down, falling, rising } = *specs;
        for e in (0..columns).step_by(2) {
            let o = e + 1;
            bond([(e, 0), (o, 0)], Some(along));
            bond([(e, 0), (e, 1)], Some(down));
            bond([(o, 0), (o, 1)], Some(down));
            bond([(e, 0), (o, 1)], falling);
            bond([(o, 0), (e, 1)], rising);
        }
        for o in (1..columns).step_by(2) {
            let next = o + 1;
            bond([(o, 0), (next, 0)], Some(along));
            bond([(o, 0), (next, 1)], falling);
            bond([(next, 0), (o, 1)], rising);
        }
    }
    order
}

fn sheets<S: Real, const D: usize>() {
    for columns in 3..=40 {
        let rows = 3 + columns % 5;
        for law in 0..4 {
            let of = |rest: f64| specs(rest)[law];
            let diagonals = [[false, false], [true, false], [false, true], [true, true]][(columns + law) % 4];
            let [falling, rising] = [1.5, 1.3].map(of);
            let specs = Kinds {
                along: of(1.05),
                down: of(0.95),
                falling: diagonals[0].then_some(falling),
                rising: diagonals[1].then_some(rising),
            };
            let order = row_order([columns, rows], &specs);
            for is_weighted in [false, true] {
                let plain = Plain::<S, D>::random(columns as u64, (columns, columns * rows), is_weighted);
                let mut sheet = Sheet::new(columns, rows, specs, false);
                plain.check(&mut sheet, &order, &format!("{columns} x {rows}, {specs:?}, weighted {is_weighted}"));
            }
        }
    }
}

fn for_every_set(check: impl Fn()) {
    let before = InstructionSet::chosen();
    InstructionSet::ALL.into_iter().filter(|set| set.choose()).for_each(|_| check());
    before.choose();
}

#[test]
fn a_sheet_is_swept_as_bond_by_bond() {
    for_every_set(|| {
        sheets::<f32, 2>();
        sheets::<f64, 2>();
        sheets::<f32, 3>();
        sheets::<f64, 3>();
    });
}

/// Bonds between points up to five apart, rest lengths of their own.
fn tangle(seed: u64, count: usize, law: usize, has_one_rest: bool) -> Vec<([usize; 2], Spec)> {
    let mut draw = Draw(seed);
    let bond = |a: usize| {
        let b = (a + 1 + ((draw.next() + 0.5) * 5.0) as usize) % count;
        let rest = if has_one_rest { 1.1 } else { 1.2 + draw.next() };
        (if draw.next() > 0.0 { [a, b] } else { [b, a] }, specs(rest)[law])
    };
    let mut bonds: Vec<([usize; 2], Spec)> = (0..3 * count).map(|k| k % count).map(bond).collect();
    bonds.retain(|(ends, _)| ends[0] != ends[1]);
    bonds
}

fn crowds<S: Real, const D: usize>() {
    for (bodies, law) in [(8, 0), (15, 1), (16, 2), (17, 3), (33, 0), (40, 3)] {
        for is_weighted in [false, true] {
            let points = 9;
            let bonds = tangle(bodies as u64, points, law, false);
            let plain = Plain::<S, D>::random(3, (points, bodies * points), is_weighted);
            let links = bonds.iter().map(|&(ends, spec)| (ends.map(|end| end as u32), spec)).collect();
            let mut crowd = Crowd::new(bodies, points, links, true);
            let of_all = (0..bodies).flat_map(|body| {
                let shift = move |end: usize| body * points + end;
                bonds.iter().map(move |&(ends, spec)| (ends.map(shift), spec))
            });
            let order: Vec<_> = of_all.collect();
            plain.check(&mut crowd, &order, &format!("{bodies} bodies, law {law}, weighted {is_weighted}"));
        }
    }
}

#[test]
fn a_crowd_is_swept_as_bond_by_bond() {
    for_every_set(|| {
        crowds::<f32, 2>();
        crowds::<f64, 2>();
        crowds::<f32, 3>();
        crowds::<f64, 3>();
    });
}

fn meshes<S: Real, const D: usize>() {
    for (count, law) in [(7, 0), (40, 1), (97, 2), (150, 3), (201, 0)] {
        for (is_weighted, has_one_rest) in [(false, false), (true, false), (false, true), (true, true)] {
            let bonds = tangle(count as u64, count, law, has_one_rest);
            let pairs: Vec<[u32; 2]> = bonds.iter().map(|(ends, _)| ends.map(|end| end as u32)).collect();
            let segment = |(&ends, (_, spec)): (&[u32; 2], &([usize; 2], Spec))| Segment { ends, spec: *spec };
            let mut mesh = Mesh::new(count, pairs.iter().zip(&bonds).map(segment).collect());
            let order: Vec<_> = colours(&pairs, count).0.into_iter().map(|k| bonds[k as usize]).collect();
            let plain = Plain::<S, D>::random(4, (13, count), is_weighted);
            plain.check(&mut mesh, &order, &format!("{count} points, law {law}, weighted {is_weighted}"));
        }
    }
}

#[test]
fn a_mesh_is_swept_as_bond_by_bond() {
    for_every_set(|| {
        meshes::<f32, 2>();
        meshes::<f64, 2>();
        meshes::<f32, 3>();
        meshes::<f64, 3>();
    });
}
