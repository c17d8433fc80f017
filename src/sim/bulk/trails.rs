//! The bonds of any mesh as long paths: straight on as far as it goes.

use super::spec::Spec;
use crate::sim::kernels::lanes::WIDEST;
use crate::sim::kernels::path::GONE;
use crate::sim::real::Real;
use crate::sim::vector::{dot, length, scale, sub};

/// Least cosine of the angle between a bond of a trail and the next one.
const STRAIGHT: f64 = 0.6;

/// A bond as trails are looked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) ends: [u32; 2],
    pub(crate) spec: Spec,
}

/// Trails side by side: they share no point, their bonds are of one kind, the longest comes first.
#[derive(Clone, Debug)]
pub(crate) struct Bundle<S> {
    /// Bundles of one class share no point.
    pub(crate) class: usize,
    pub(crate) spec: Spec,
    /// Points of the longest trail.
    pub(crate) len: usize,
    /// Point k of the trail in lane l at k times [`WIDEST`] + l; trails that have ended repeat their last point.
    pub(crate) points: Vec<u32>,
    /// Rest length of the bond behind each of them `[m]`.
    pub(crate) rests: Vec<S>,
    /// How many trails have a point k.
    pub(crate) counts: Vec<u8>,
}

impl<S: Real> Bundle<S> {
    /// The bond between points that are meant, of this rest length, goes. Returns whether there was one.
    pub(crate) fn lose(&mut self, is_meant: impl Fn([u32; 2]) -> bool, rest: S) -> bool {
        let lanes = |k: usize| (0..usize::from(self.counts[k + 1])).map(move |lane| k * WIDEST + lane);
        let is_it =
            |&at: &usize| is_meant([self.points[at], self.points[at + WIDEST]]) && is_about(self.rests[at], rest);
        let found = (0..self.len - 1).flat_map(lanes).find(is_it);
        if let Some(at) = found {
            self.rests[at] = S::from_f64(GONE);
        }
        found.is_some()
    }
}

/// Whether a rest length is the one meant: those that differ by rounding are one.
pub(crate) fn is_about<S: Real>(rest: S, meant: S) -> bool {
    (rest - meant).abs() <= S::from_f64(1e-5) * meant
}

/// A trail while it is made.
struct Trail {
    points: Vec<u32>,
    bonds: Vec<u32>,
    /// How much its bonds lie along gravity `[1]`.
    steepness: f64,
}

/// Trails with every bond once, in bundles, those that bear the load last.
///
/// A trail starts at the steepest bond that is left and goes on in both directions, each time along the straightest bond
/// of its kind that is left. `down` is the direction of gravity, or zero.
/// Shapes: `position` has one entry a point.
pub(crate) fn bundles<S: Real, const D: usize>(
    segments: &[Segment],
    position: &[[f64; D]],
    down: [f64; D],
) -> Vec<Bundle<S>> {
    let trails = Finder::new(segments, position, down).find();
    let mut classes = classes(&trails, segments, position.len());
    classes.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut bundles = Vec::new();
    for (place, (mut class, _)) in classes.into_iter().enumerate() {
        class.sort_by_key(|&trail| std::cmp::Reverse(trails[trail].points.len()));
        for some in class.chunks(WIDEST) {
            bundles.push(bundle(place, some.iter().map(|&trail| &trails[trail]).collect(), segments));
        }
    }
    bundles
}

/// Mean number of bonds of the trails in bundles.
pub(crate) fn mean_length<S>(bundles: &[Bundle<S>]) -> f64 {
    let trails: usize = bundles.iter().map(|bundle| usize::from(bundle.counts[0])).sum();
    let points: usize = bundles.iter().flat_map(|bundle| &bundle.counts).map(|&count| usize::from(count)).sum();
    if trails == 0 { 0.0 } else { (points - trails) as f64 / trails as f64 }
}

/// Trails of one kind that share no point, with their mean steepness.
fn classes(trails: &[Trail], segments: &[Segment], points: usize) -> Vec<(Vec<usize>, f64)> {
    let mut taken: Vec<u64> = vec![0; points];
    let mut classes: Vec<(Vec<usize>, Spec, f64)> = Vec::new();
    let mut waiting: Vec<usize> = (0..trails.len()).collect();
    let mut base = 0;
    while !waiting.is_empty() {
        waiting.retain(|&t| {
            let spec = segments[trails[t].bonds[0] as usize].spec;
            let used = trails[t].points.iter().fold(0, |used, &point| used | taken[point as usize]);
            let fits = |k: usize| {
                let class = classes.get(base + k);
                used & (1 << k) == 0 && class.is_none_or(|class| class.1.is_of_kind(&spec))
            };
            let Some(k) = (0..64).find(|&k| fits(k)) else { return true };
            trails[t].points.iter().for_each(|&point| taken[point as usize] |= 1 << k);
            if classes.len() == base + k {
                classes.push((Vec::new(), spec, 0.0));
            }
            classes[base + k].0.push(t);
            classes[base + k].2 += trails[t].steepness;
            false
        });
        base = classes.len();
        taken.fill(0);
    }
    let mean = |(class, _, sum): (Vec<usize>, Spec, f64)| {
        let mean = sum / class.len() as f64;
        (class, mean)
    };
    classes.into_iter().map(mean).collect()
}

fn bundle<S: Real>(class: usize, trails: Vec<&Trail>, segments: &[Segment]) -> Bundle<S> {
    let len = trails[0].points.len();
    let mut points = vec![0; len * WIDEST];
    let mut rests = vec![S::ONE; len * WIDEST];
    let mut counts = vec![0; len];
    for (lane, trail) in trails.iter().enumerate() {
        for k in 0..len {
            points[k * WIDEST + lane] = trail.points[k.min(trail.points.len() - 1)];
            counts[k] += u8::from(k < trail.points.len());
        }
        for (k, &bond) in trail.bonds.iter().enumerate() {
            rests[k * WIDEST + lane] = S::from_f64(segments[bond as usize].spec.rest);
        }
    }
    Bundle { spec: segments[trails[0].bonds[0] as usize].spec, class, len, points, rests, counts }
}

/// Looks for trails.
struct Finder<'a, const D: usize> {
    segments: &'a [Segment],
    position: &'a [[f64; D]],
    down: [f64; D],
    /// Bonds of each point: those of point i from `first[i]` to `first[i + 1]`.
    first: Vec<u32>,
    bonds: Vec<u32>,
    used: Vec<bool>,
    /// The trail that a point was last put on.
    on: Vec<u32>,
}

impl<'a, const D: usize> Finder<'a, D> {
    fn new(segments: &'a [Segment], position: &'a [[f64; D]], down: [f64; D]) -> Self {
        let mut first = vec![0_u32; position.len() + 1];
        for segment in segments {
            segment.ends.iter().for_each(|&end| first[end as usize + 1] += 1);
        }
        for i in 0..position.len() {
            first[i + 1] += first[i];
        }
        let mut next = first.clone();
        let mut bonds = vec![0; 2 * segments.len()];
        for (k, segment) in segments.iter().enumerate() {
            for &end in &segment.ends {
                bonds[next[end as usize] as usize] = k as u32;
                next[end as usize] += 1;
            }
        }
        let (used, on) = (vec![false; segments.len()], vec![u32::MAX; position.len()]);
        Finder { segments, position, down, first, bonds, used, on }
    }

    fn find(mut self) -> Vec<Trail> {
        let mut order: Vec<u32> = (0..self.segments.len() as u32).collect();
        let steepness: Vec<f64> = order.iter().map(|&k| dot(self.way(k), self.down).abs()).collect();
        order.sort_by(|&a, &b| steepness[b as usize].total_cmp(&steepness[a as usize]));
        let mut trails = Vec::new();
        for bond in order {
            if !self.used[bond as usize] {
                let name = trails.len() as u32;
                trails.push(self.follow(bond, name, &steepness));
            }
        }
        trails
    }

    /// The trail through a bond.
    fn follow(&mut self, start: u32, name: u32, steepness: &[f64]) -> Trail {
        self.used[start as usize] = true;
        let [a, b] = self.segments[start as usize].ends;
        self.on[a as usize] = name;
        self.on[b as usize] = name;
        let (mut points, mut bonds) = (vec![b], vec![start]);
        self.extend((a, b), start, name, &mut points, &mut bonds);
        points.reverse();
        bonds.reverse();
        // From the other end: `points` ends with `b` now.
        points.push(a);
        self.extend((b, a), start, name, &mut points, &mut bonds);
        let steepness = bonds.iter().map(|&bond| steepness[bond as usize]).sum::<f64>() / bonds.len() as f64;
        Trail { points, bonds, steepness }
    }

    /// Goes on from `at`, which was reached from `from` by `bond`.
    fn extend(
        &mut self,
        (mut from, mut at): (u32, u32),
        bond: u32,
        name: u32,
        points: &mut Vec<u32>,
        bonds: &mut Vec<u32>,
    ) {
        let spec = self.segments[bond as usize].spec;
        while let Some((next, point)) = self.straightest(from, at, name, &spec) {
            self.used[next as usize] = true;
            self.on[point as usize] = name;
            points.push(point);
            bonds.push(next);
            (from, at) = (at, point);
        }
    }

    /// The bond that leads straightest on, and where to.
    fn straightest(&self, from: u32, at: u32, name: u32, spec: &Spec) -> Option<(u32, u32)> {
        let heading = unit(sub(self.position[at as usize], self.position[from as usize]));
        let list = &self.bonds[self.first[at as usize] as usize..self.first[at as usize + 1] as usize];
        let mut best: Option<(f64, u32, u32)> = None;
        for &bond in list.iter().filter(|&&bond| !self.used[bond as usize]) {
            let segment = &self.segments[bond as usize];
            let point = if segment.ends[0] == at { segment.ends[1] } else { segment.ends[0] };
            if self.on[point as usize] == name || !segment.spec.is_of_kind(spec) {
                continue;
            }
            let cosine = dot(heading, unit(sub(self.position[point as usize], self.position[at as usize])));
            if cosine > STRAIGHT && best.is_none_or(|(most, ..)| cosine > most) {
                best = Some((cosine, bond, point));
            }
        }
        best.map(|(_, bond, point)| (bond, point))
    }

    fn way(&self, bond: u32) -> [f64; D] {
        let [a, b] = self.segments[bond as usize].ends.map(|end| self.position[end as usize]);
        unit(sub(a, b))
    }
}

/// The direction of a vector; zero has none.
fn unit<const D: usize>(a: [f64; D]) -> [f64; D] {
    let size = length(a);
    if size > 0.0 { scale(a, 1.0 / size) } else { a }
}
