//! Angles of a body that are bent together: one by one each would give way to the next, and a fine chain be limp.
//!
//! Model: with C what an angle is off, g its slopes, k its stiffness, c its damper and way what its points have gone, the multipliers at the end of
//! a substep are l = -(k h^2 C + c h g . way), where C and g . way have grown by A l, A_ij the sum over the points that i and j share of
//! w g_i . g_j: a step of implicit Euler, linear in C. With s = k h^2 + c h these are (1/s + A) l = -(k h^2 C + c h g . way)/s. Where contacts
//! have moved points since, the same again for what l lacks.

use super::cluster::{Cluster, Common};
use super::shape::{self, MOST_TURN};
use crate::sim::force::angle::Hinge;
use crate::sim::force::form::at;
use crate::sim::real::Real;
use crate::sim::solve::elimination::{self, Pattern};
use crate::sim::solve::ldl::Ldl;
use crate::sim::vector::{convert, dot, widen};

/// What the points of an angle may give to it within a substep, over what it gives itself, where one by one is as good: k h^2 + c h times the
/// sum of w |g|^2.
const SOFT: f64 = 0.05;
/// Share by which what an angle and its points give may have changed since the matrix was factored: a body that only turns keeps its matrix.
const STALE: f64 = 0.1;
/// Most multiplications of a factorisation for each angle: what is meshed more closely is bent one by one.
const MOST_FILL: usize = 60;

/// How the angles of a body hang together, and what solves for them.
#[derive(Clone, Debug)]
pub(super) struct Bends {
    /// Their places among those of the body, in the order of elimination.
    order: Vec<u32>,
    /// Points that two of them share: the entry of the matrix, the two by their places in `order`, and which corner it is of each.
    shared: Vec<(u32, [u32; 2], [u8; 2])>,
    entries: usize,
    ldl: Ldl<f64>,
    /// The diagonal of the matrix that was factored; empty: none was.
    factored: Vec<f64>,
    /// The multipliers so far in this substep, in the order of elimination `[kg m^2]`.
    pressed: Vec<f64>,
    /// All give so much more than their points in this step that they are bent one by one.
    pub(super) is_soft: bool,
    /// Some gives less than half of what its points do: what moves these again is to be answered in the same substep.
    is_stiff: bool,
}

/// An angle as it stands in a substep.
#[derive(Clone, Copy)]
struct Bent {
    points: [u32; 3],
    w: [f64; 3],
    slopes: [[f64; 2]; 3],
    /// 1/s.
    give: f64,
}

impl Bends {
    /// Of angles between points of a body; `None` without any, or where they are meshed too closely.
    pub(super) fn of<S: Real>(hinges: &[Hinge<S>]) -> Option<Self> {
        let mut at: Vec<[u32; 2]> =
            hinges.iter().zip(0..).flat_map(|(hinge, k)| hinge.points.map(|point| [point, k])).collect();
        at.sort_unstable();
        let groups = || at.chunk_by(|a, b| a[0] == b[0]);
        // Two angles share three points at most, and each pair is an entry of the factor.
        let most = MOST_FILL * hinges.len();
        if hinges.is_empty() || groups().map(|group| group.len() * (group.len() - 1) / 2).sum::<usize>() > 3 * most {
            return None;
        }
        let mut pairs = Vec::new();
        for group in groups() {
            for (k, [_, later]) in group.iter().enumerate() {
                pairs.extend(group[..k].iter().map(|[_, earlier]| [*earlier, *later]));
            }
        }
        let Pattern { order, lower, .. } = elimination::pattern(hinges.len(), &pairs);
        let ldl = Ldl::analyse(&lower);
        if ldl.multiplications() > most {
            return None;
        }
        let mut shared = Vec::new();
        let entries = lower.iter().zip(0..).flat_map(|(row, k)| row.iter().map(move |&j| [k, j])).zip(0..);
        for ([row, column], entry) in entries {
            let [a, b] = [row, column].map(|at| hinges[order[at as usize] as usize].points);
            for (i, point) in (0..).zip(a) {
                let same = b.iter().position(|&other| other == point);
                shared.extend(same.map(|j| (entry, [row, column], [i, j as u8])));
            }
        }
        Some(Bends {
            order,
            shared,
            entries: lower.iter().map(Vec::len).sum(),
            ldl,
            factored: Vec::new(),
            pressed: vec![0.0; hinges.len()],
            is_soft: false,
            is_stiff: false,
        })
    }

    /// Finds out whether all are soft in substeps of `h` `[s]`, of a body whose points begin at `base`.
    fn prepare<S: Real>(&mut self, state: &Cluster<S>, hinges: &[Hinge<S>], (base, h): (u32, S)) {
        let give = |hinge: &Hinge<S>| {
            let points = hinge.points.map(|point| base + point);
            let stand = hinge.stand(at(&state.now, points))?;
            let asked = stand.share() * (hinge.stiffness * h * h + hinge.damping * h);
            Some((asked * shape::weight(state, points, stand.slopes)).to_f64())
        };
        self.is_soft = hinges.iter().all(|hinge| give(hinge).is_none_or(|give| give < SOFT));
    }

    /// Factors the matrix of these angles. Returns the counted work.
    fn factor(&mut self, bent: &[Bent], diagonal: Vec<f64>) -> u64 {
        let mut lower = vec![0.0; self.entries];
        for &(entry, pair, corners) in &self.shared {
            let [a, b] = pair.map(|k| &bent[k as usize]);
            let [i, j] = corners.map(usize::from);
            lower[entry as usize] += a.w[i] * dot(a.slopes[i], b.slopes[j]);
        }
        self.ldl.factor(&diagonal, &lower, 0.0);
        self.factored = diagonal;
        (4 * self.shared.len() + self.ldl.multiplications()) as u64
    }

    /// Bends all, in a substep of `h` `[s]`, of a body whose points begin at `base`.
    fn bend<S: Real>(&mut self, state: &mut Cluster<S>, hinges: &[Hinge<S>], (base, h): (u32, S)) {
        let idle = Bent { points: [0; 3], w: [0.0; 3], slopes: [[0.0; 2]; 3], give: 1.0 };
        let stands = |(&k, pressed): (&u32, &f64)| {
            let hinge = &hinges[k as usize];
            let points = hinge.points.map(|point| base + point);
            let w = points.map(|point| state.w[point as usize].to_f64());
            let stand = hinge.stand(at(&state.now, points))?;
            let [firm, slow] = [hinge.stiffness * h * h, hinge.damping * h].map(|x| (stand.share() * x).to_f64());
            let asks = firm * hinge.off_rest(stand.angle).to_f64() + slow * stand.rate(at(&state.way, points)).to_f64();
            let give = 1.0 / (firm + slow);
            let bent = Bent { points, w, slopes: stand.slopes.map(widen), give };
            (give.is_finite() && w != [0.0; 3]).then_some((bent, -(asks + pressed) * give))
        };
        let (bent, asked): (Vec<Bent>, Vec<f64>) =
            self.order.iter().zip(&self.pressed).map(|entry| stands(entry).unwrap_or((idle, 0.0))).unzip();
        let own =
            |bent: &Bent| bent.give + (0..3).map(|i| bent.w[i] * dot(bent.slopes[i], bent.slopes[i])).sum::<f64>();
        let diagonal: Vec<f64> = bent.iter().map(own).collect();
        self.is_stiff = bent.iter().zip(&diagonal).any(|(bent, diagonal)| *diagonal > 2.0 * bent.give);
        state.counts.work += (80 * self.order.len() + 2 * self.ldl.fill()) as u64;
        let keeps = |(now, before): (&f64, &f64)| (now - before).abs() <= STALE * before;
        if self.factored.is_empty() || !diagonal.iter().zip(&self.factored).all(keeps) {
            state.counts.work += self.factor(&bent, diagonal);
        }
        let mut multipliers = asked.clone();
        self.ldl.solve_one(&mut multipliers);
        // What they turn by is what was asked for less what they give.
        let turns = asked.iter().zip(&multipliers).zip(&bent).map(|((asked, l), bent)| (asked - l * bent.give).abs());
        let most = turns.fold(0.0, f64::max);
        let share = if most > MOST_TURN { MOST_TURN / most } else { 1.0 };
        for ((bent, multiplier), pressed) in bent.iter().zip(&multipliers).zip(&mut self.pressed) {
            if bent.w != [0.0; 3] {
                *pressed += share * multiplier;
                shape::push(state, bent.points, bent.slopes.map(convert), S::from_f64(share * multiplier));
            }
        }
    }
}

/// Finds out which bodies are bent one by one in a step, of substeps of `h` `[s]`.
pub(super) fn prepare<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    let mut bends = std::mem::take(&mut state.bends);
    for (own, (body, base)) in bends.iter_mut().zip(state.members(common)) {
        if let Some(own) = own {
            state.counts.work += 60 * own.order.len() as u64;
            own.prepare(state, common.hinges(body), (base as u32, h));
        }
    }
    state.bends = bends;
}

/// Bends the angles of all bodies that do so together, in a substep of `h` `[s]`.
pub(super) fn bend<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    for own in state.bends.iter_mut().flatten() {
        own.pressed.fill(0.0);
        own.is_stiff = !own.is_soft;
    }
    go_on(state, common, h);
}

/// Once more, where contacts pressed and what bends hardly gives.
pub(super) fn again<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    if state.bends.iter().flatten().any(|own| own.is_stiff) && state.is_pressed() {
        go_on(state, common, h);
    }
}

fn go_on<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    let mut bends = std::mem::take(&mut state.bends);
    for (own, (body, base)) in bends.iter_mut().zip(state.members(common)) {
        if let Some(own) = own.as_mut().filter(|own| own.is_stiff) {
            own.bend(state, common.hinges(body), (base as u32, h));
        }
    }
    state.bends = bends;
}
