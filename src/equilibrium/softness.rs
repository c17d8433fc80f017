//! The stiffness that relaxed bonds amount to: a share k of the error a sweep is no material, so it is measured on the scene.
//!
//! A force pulls the ends of a bond apart in a copy of the scene that nothing else acts on, and the bond gives way. Springs whose stiffness
//! is that of one bond alone,
//!
//! ```text
//! K = mu/h^2 (1 - q)/q,   q = (1 - k)^n,   mu = 1/(w_a + w_b)
//! ```
//!
//! for n sweeps in a substep of h `[s]`, would give way by so much in its place; the ratio of the two is what the others, and the order in
//! which all are swept, make of it. K follows from the rest of one bond under a force F: a substep takes it F h^2/mu away, and the sweeps
//! leave q of all that it is away.

use crate::sim::vector::{add, dot, length, scale, sub};
use crate::sim::{Bond, BondKind, Force, Method, Model, PointId, build};

/// Most points of a model in which it is measured.
pub const MOST_SOFT: usize = 1_000;
/// Most corrections of bonds that it takes.
const MOST_CORRECTIONS: f64 = 2e7;
/// Most substeps: a bond of k = 0.01 is at rest after some hundreds.
const MOST_SUBSTEPS: f64 = 4_000.0;
/// Strain that the force would give to one bond alone `[1]`.
const STRAIN: f64 = 1e-3;

/// What relaxed bonds of k < 1 amount to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Softness {
    /// The bond that was pulled, by its place in the scene.
    pub bond: usize,
    /// K of it alone `[N/m]`.
    pub alone: f64,
    /// Stiffness of springs that would give as much in its place `[N/m]`.
    pub stiffness: f64,
}

/// What relaxed bonds amount to at the model's substep, sweeps and order, measured on one in the middle of their list; `None` where
/// none has k < 1, the model has more than 1,000 points, or its method is not that of relaxed bonds.
///
/// Accuracy: a load on one bond. Under a load on all of them those that are swept before others give way more, by a share that grows with k
/// and with the bonds of a point: of n sweeps = 1 the compliance is D (1 - k)/k - U, with D the diagonal and U the upper part of G W G^T
/// in the order of the sweep; of a chain whose k is 0.05 that is 3 per cent.
pub fn softness<const D: usize>(model: &Model<D>) -> Option<Softness> {
    if model.position.len() > MOST_SOFT {
        return None;
    }
    let (h, sweeps) = (model.method.substep?, model.method.iterations?);
    let mut w: Vec<f64> = model.mass.iter().map(|mass| 1.0 / mass).collect();
    model.pinned.iter().for_each(|pin| w[pin.index()] = 0.0);
    let alone = |bond: &Bond| match bond.kind {
        BondKind::Relaxed { relaxation, .. } if relaxation < 1.0 => {
            let q = (1.0 - relaxation).powi(sweeps as i32);
            let sum = w[bond.a.index()] + w[bond.b.index()];
            (sum > 0.0 && q > 0.0).then(|| (1.0 - q) / (q * h * h * sum))
        }
        _ => None,
    };
    let soft: Vec<(usize, Bond)> = model.bonds.iter().enumerate().filter(|(_, bond)| alone(bond).is_some()).collect();
    let &(place, bond) = soft.get(soft.len() / 2)?;
    let stiffness = alone(&bond)?;
    let d = sub(model.position[bond.a.index()], model.position[bond.b.index()]);
    let size = length(d);
    if size == 0.0 {
        return None;
    }
    let way = scale(d, 1.0 / size);
    let force = STRAIN * size * stiffness;
    let pulled = elongation(model, (&bond, way), force)? - elongation(model, (&bond, way), 0.0)?;
    let springs = compliance((model, &w), (&bond, way), |bond| alone(bond).unwrap_or(0.0)) * force;
    let ratio = springs / pulled;
    (pulled > 0.0 && ratio.is_finite()).then_some(Softness {
        bond: place,
        alone: stiffness,
        stiffness: stiffness * ratio,
    })
}

/// How far the ends of a bond are apart along this way, on average over the second half of a run, under a force that parts them `[m, N]`.
fn elongation<const D: usize>(model: &Model<D>, (bond, way): (&Bond, [f64; D]), force: f64) -> Option<f64> {
    let of = |end: PointId, sign: f64| Force { points: vec![end], force: scale(way, sign * force), torque: 0.0 };
    let method = Method { sleeps: false, budget: None, ledger: false, ..model.method };
    let bare = Model {
        position: model.position.clone(),
        velocity: vec![[0.0; D]; model.position.len()],
        mass: model.mass.clone(),
        pinned: model.pinned.clone(),
        bonds: model.bonds.clone(),
        forces: vec![of(bond.a, 1.0), of(bond.b, -1.0)],
        method,
        ..Model::default()
    };
    let mut world = build(&bare).ok()?;
    let corrections = (model.bonds.len() * model.method.iterations.unwrap_or(1) as usize) as f64;
    let substeps = (MOST_CORRECTIONS / corrections).clamp(2.0, MOST_SUBSTEPS) as u32;
    let mut sum = 0.0;
    for substep in 0..substeps {
        world.step();
        if substep >= substeps / 2 {
            let sample = world.sample(world.time());
            let [a, b] = [bond.a, bond.b].map(|end| sample.position[end.index()]);
            sum += (0..D).map(|k| way[k] * (a[k] - b[k])).sum::<f64>();
        }
    }
    let mean = sum / f64::from(substeps - substeps / 2);
    mean.is_finite().then_some(mean)
}

/// How far the ends of a bond part under a force of 1 N in a net of springs at rest `[m/N]`: conjugate gradients, from which what moves
/// as a whole drops out by itself.
fn compliance<const D: usize>(
    (model, w): (&Model<D>, &[f64]),
    (bond, way): (&Bond, [f64; D]),
    stiffness: impl Fn(&Bond) -> f64,
) -> f64 {
    let springs: Vec<([usize; 2], [f64; D], f64)> = model
        .bonds
        .iter()
        .filter_map(|bond| {
            let ends = [bond.a.index(), bond.b.index()];
            let d = sub(model.position[ends[0]], model.position[ends[1]]);
            let size = length(d);
            // What is rigid is far stiffer than what is soft.
            let k = if matches!(bond.kind, BondKind::Relaxed { .. }) { stiffness(&bond) } else { 0.0 };
            (size > 0.0).then(|| (ends, scale(d, 1.0 / size), k))
        })
        .collect();
    let pull = |u: &[[f64; D]]| {
        let mut f = vec![[0.0; D]; u.len()];
        for &([a, b], n, k) in &springs {
            let push = scale(n, k * dot(n, sub(u[a], u[b])));
            (f[a], f[b]) = (add(f[a], push), sub(f[b], push));
        }
        f.iter_mut().zip(w).filter(|(_, w)| **w == 0.0).for_each(|(f, _)| *f = [0.0; D]);
        f
    };
    let inner = |x: &[[f64; D]], y: &[[f64; D]]| x.iter().zip(y).map(|(x, y)| dot(*x, *y)).sum::<f64>();
    let mut u = vec![[0.0; D]; w.len()];
    let mut left = u.clone();
    for (end, sign) in [(bond.a, 1.0), (bond.b, -1.0)] {
        if w[end.index()] > 0.0 {
            left[end.index()] = scale(way, sign);
        }
    }
    let (mut go, mut square) = (left.clone(), inner(&left, &left));
    let start = square;
    for _ in 0..4 * D * w.len() {
        let f = pull(&go);
        let curve = inner(&go, &f);
        if curve <= 0.0 || square <= 1e-20 * start {
            break;
        }
        let step = square / curve;
        for i in 0..u.len() {
            u[i] = add(u[i], scale(go[i], step));
            left[i] = sub(left[i], scale(f[i], step));
        }
        let next = inner(&left, &left);
        go.iter_mut().zip(&left).for_each(|(go, left)| *go = add(*left, scale(*go, next / square)));
        square = next;
    }
    dot(way, sub(u[bond.a.index()], u[bond.b.index()]))
}
