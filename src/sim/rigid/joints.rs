//! What joins rigid bodies: points that two of them share or that are pinned, and bonds of their own.
//!
//! ```text
//! joint   x_a - x_b = 0            two rows
//! rod     |x_a - x_b| - rest = 0   one row
//! G v = target,  v+ = v + M^-1 G^T lambda        G: a row has a leg on each of its two bodies, along x, along y and by the angle
//! ```
//!
//! All rows are solved together by elimination, fewest neighbours first: chains and trees of bodies fill nothing in.

use super::inertia::Inertia;
use super::link::{Anchor, Clock, End, Link, Stand, are_led};
use super::motion::{Motion, Pose, Twist};
use super::place::Place;
use crate::sim::solve::elimination::{self, Pattern};
use crate::sim::solve::ldl::Ldl;
use crate::sim::vector::{add, cross, dot, scale, sub};

/// Pivots below this share of their diagonal are skipped: rows that repeat others, as those of a mechanism at its dead point. What rounding makes of
/// a pivot is 1e-16 over the square of the angle from there; light bodies between heavy ones have small ones too (`MOST_RATIO` in `blueprint.rs`).
const LEAST_PIVOT: f64 = 1e-10;

/// Share of the squares of all gaps that rows from before may leave in a round: where they leave more they are worked out anew.
const SLOW: f64 = 1e-4;

/// Parts of the way that a round would go which are tried until gaps are smaller.
const PARTS: [f64; 3] = [1.0, 0.25, 0.0625];

/// A row of a link: along x or y of a joint, or along a rod.
#[derive(Clone, Copy, Debug)]
struct Row {
    link: u32,
    axis: usize,
}

/// What a row does to a body.
#[derive(Clone, Copy, Debug)]
struct Leg {
    body: u32,
    slope: [f64; 3],
}

/// The links of a few bodies, in their order of elimination.
#[derive(Clone, Debug)]
pub(crate) struct Joints {
    links: Vec<Link>,
    rows: Vec<Row>,
    /// Entries left of the diagonal, row by row.
    couples: Vec<[u32; 2]>,
    ldl: Ldl<f64>,
}

impl Joints {
    pub(crate) fn new(links: Vec<Link>) -> Self {
        let axes = |link: &Link| 0..if link.rest.is_some() { 1 } else { 2 };
        let of = |(link, k): (&Link, u32)| axes(link).map(move |axis| Row { link: k, axis });
        let listed: Vec<Row> = links.iter().zip(0..).flat_map(of).collect();
        let pairs = neighbours(&links, &listed);
        let Pattern { order, lower, .. } = elimination::pattern(listed.len(), &pairs);
        let couples = lower.iter().zip(0..).flat_map(|(columns, k)| columns.iter().map(move |&l| [k, l])).collect();
        Joints {
            rows: order.iter().map(|&row| listed[row as usize]).collect(),
            couples,
            ldl: Ldl::analyse(&lower),
            links,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    pub(crate) fn links(&self) -> &[Link] {
        &self.links
    }

    pub(crate) fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Operations of one factorisation and a few solves, about.
    pub(crate) fn work(&self) -> u64 {
        60 * self.rows.len() as u64 + 30 * self.ldl.fill() as u64
    }

    /// Operations of a round that closes gaps by rows that are known, about.
    pub(crate) fn work_of_a_round(&self) -> u64 {
        60 * self.rows.len() as u64
    }

    /// How far every row is from where it should be `[m]`.
    pub(crate) fn gaps(&self, stand: Stand) -> Vec<f64> {
        let of = |row: &Row| {
            let link = &self.links[row.link as usize];
            let d = sub(stand.at(link.ends[0]), stand.at(link.ends[1]));
            link.length(stand.clock).map_or(d[row.axis], |rest| dot(d, d).sqrt() - rest)
        };
        self.rows.iter().map(of).collect()
    }

    /// Bodies are moved, without speed, to where no row is off by more than `closed` `[m]`: in so many rounds at most, each with new directions.
    /// Near a dead point, where a round would take them far off, they go a part of that way, or stay. Rows that are `kept` from a place near by
    /// do as long as gaps close quickly by them, in twice as many rounds.
    pub(crate) fn close(
        &self,
        inertias: &[Inertia],
        (motions, anchors, clock): (&mut [Motion], &[Anchor], Option<Clock>),
        (rounds, closed): (u32, f64),
        mut kept: Option<&mut Option<Rows>>,
    ) -> Closing {
        let mut closing = Closing { rounds: 0, factored: 0, pulls: vec![Pull::default(); self.links.len()] };
        let mut gaps = self.gaps(Stand { motions, anchors, since: 0.0, clock });
        // A round by rows that are known costs less than half of one that works them out.
        let rounds = if kept.is_some() { 2 * rounds } else { rounds };
        for round in 0..rounds {
            closing.rounds = round;
            if gaps.iter().all(|gap| gap.abs() <= closed) {
                return closing;
            }
            let targets: Vec<f64> = gaps.iter().map(|gap| -gap).collect();
            let mut ways = vec![Twist::STILL; motions.len()];
            let old = kept.as_mut().and_then(|kept| kept.take());
            let is_old = old.is_some();
            closing.factored += u32::from(!is_old);
            let rows = old.unwrap_or_else(|| self.rows_at(inertias, Stand { motions, anchors, since: 0.0, clock }));
            let lambda = rows.hold(inertias, &mut ways, &targets);
            let places: Vec<Place> = motions.iter().map(|motion| motion.place).collect();
            let before = square(&gaps);
            let taken = PARTS.into_iter().find(|&part| {
                for ((motion, way), place) in motions.iter_mut().zip(&ways).zip(&places) {
                    motion.place = place.moved(scale(way.velocity, part), part * way.spin);
                }
                gaps = self.gaps(Stand { motions, anchors, since: 0.0, clock });
                square(&gaps) < before
            });
            let Some(part) = taken else {
                motions.iter_mut().zip(places).for_each(|(motion, place)| motion.place = place);
                if is_old {
                    gaps = self.gaps(Stand { motions, anchors, since: 0.0, clock });
                    continue;
                }
                return closing;
            };
            for ((row, legs), lambda) in self.rows.iter().zip(&rows.legs).zip(lambda) {
                closing.pulls[row.link as usize].note(inertias, legs, part * lambda);
            }
            if let Some(kept) = kept.as_mut().filter(|_| !is_old || square(&gaps) <= SLOW * before) {
                **kept = Some(rows);
            }
        }
        closing.rounds = rounds;
        closing
    }

    /// The direction of a row where bodies are now.
    fn direction(&self, row: &Row, stand: Stand) -> [f64; 2] {
        let link = &self.links[row.link as usize];
        match link.rest {
            None => [[1.0, 0.0], [0.0, 1.0]][row.axis],
            Some(_) => {
                let d = sub(stand.at(link.ends[0]), stand.at(link.ends[1]));
                let length = dot(d, d).sqrt();
                if length > 0.0 { scale(d, 1.0 / length) } else { [1.0, 0.0] }
            }
        }
    }

    /// The rows where bodies are now, ready to be solved.
    pub(crate) fn rows_at(&self, inertias: &[Inertia], stand: Stand) -> Rows {
        let legs = |row: &Row| {
            let (link, normal) = (&self.links[row.link as usize], self.direction(row, stand));
            let leg = |end: End, sign: f64| match end {
                End::On { body, place } => {
                    let arm = stand.motions[body as usize].place.turned(place);
                    Some(Leg { body, slope: [sign * normal[0], sign * normal[1], sign * cross(arm, normal)] })
                }
                End::Fixed(_) => None,
            };
            [leg(link.ends[0], 1.0), leg(link.ends[1], -1.0)]
        };
        let legs: Vec<[Option<Leg>; 2]> = self.rows.iter().map(legs).collect();
        let couple = |k: usize, l: usize| -> f64 {
            let both = legs[k].iter().flatten().flat_map(|one| legs[l].iter().flatten().map(move |other| (one, other)));
            both.filter(|(one, other)| one.body == other.body)
                .map(|(one, other)| {
                    let [ease, swing] = inertias[one.body as usize].inverse;
                    let [a, b] = [one.slope, other.slope];
                    ease * (a[0] * b[0] + a[1] * b[1]) + swing * a[2] * b[2]
                })
                .sum()
        };
        let diagonal: Vec<f64> = (0..legs.len()).map(|k| couple(k, k)).collect();
        let lower: Vec<f64> = self.couples.iter().map(|&[k, l]| couple(k as usize, l as usize)).collect();
        let mut ldl = self.ldl.clone();
        ldl.factor(&diagonal, &lower, LEAST_PIVOT);
        Rows { legs, ldl }
    }

    /// Whether the length of some rod follows a drive.
    pub(super) fn are_driven(&self) -> bool {
        self.links.iter().any(|link| link.drive.is_some())
    }

    /// How fast drives change the lengths of rods, row by row `[m/s]`; empty, where none does.
    fn growths(&self, stand: Stand) -> Vec<f64> {
        let of = |row: &Row| self.links[row.link as usize].growth(stand.clock);
        if self.are_driven() { self.rows.iter().map(of).collect() } else { Vec::new() }
    }

    /// The rates of all rows that points which are led ask for `[m/s]`; empty, where none is.
    pub(crate) fn leads(&self, stand: Stand) -> Vec<f64> {
        let led = |row: &Row| {
            let rate = |(end, sign): (&End, f64)| match end {
                End::Fixed(_) => -sign * dot(self.direction(row, stand), stand.velocity(*end)),
                End::On { .. } => 0.0,
            };
            self.links[row.link as usize].ends.iter().zip([1.0, -1.0]).map(rate).sum()
        };
        if are_led(stand.anchors) { self.rows.iter().map(led).collect() } else { Vec::new() }
    }

    /// The same with what points that are led and drives ask for.
    pub(crate) fn factored<'a>(&self, inertias: &'a [Inertia], stand: Stand) -> Factored<'a> {
        let (mut leads, growths, rows) = (self.leads(stand), self.growths(stand), self.rows_at(inertias, stand));
        let is_led = are_led(stand.anchors);
        leads.resize(rows.legs.len(), 0.0);
        leads.iter_mut().zip(&growths).for_each(|(lead, growth)| *lead += growth);
        Factored { inertias, rows, leads, growths, is_led }
    }
}

fn square(gaps: &[f64]) -> f64 {
    gaps.iter().map(|gap| gap * gap).sum()
}

/// Rows that share a body.
fn neighbours(links: &[Link], rows: &[Row]) -> Vec<[u32; 2]> {
    let mut at: Vec<(u32, u32)> = Vec::new();
    for (row, k) in rows.iter().zip(0..) {
        for end in links[row.link as usize].ends {
            if let End::On { body, .. } = end {
                at.push((body, k));
            }
        }
    }
    at.sort_unstable();
    let mut pairs = Vec::new();
    for of_one in at.chunk_by(|a, b| a.0 == b.0) {
        for (i, &(_, k)) in of_one.iter().enumerate() {
            pairs.extend(of_one[..i].iter().map(|&(_, l)| [l, k]));
        }
    }
    pairs
}

/// How gaps were closed.
pub(crate) struct Closing {
    pub(crate) rounds: u32,
    /// How many times rows were worked out.
    pub(crate) factored: u32,
    pub(crate) pulls: Vec<Pull>,
}

/// What a link did to what it joins as gaps were closed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pull {
    /// With what it pulled its first end `[kg m]`.
    pub(crate) push: [f64; 2],
    /// By what it turned the body of each end `[rad]`.
    pub(crate) turns: [f64; 2],
}

impl Pull {
    fn note(&mut self, inertias: &[Inertia], legs: &[Option<Leg>; 2], impulse: f64) {
        self.push = add(self.push, scale(normal(legs), impulse));
        for (turn, leg) in self.turns.iter_mut().zip(legs) {
            *turn += leg.map_or(0.0, |leg| leg.slope[2] * inertias[leg.body as usize].inverse[1] * impulse);
        }
    }
}

/// The rows where bodies were at one moment, ready to be solved.
#[derive(Clone, Debug)]
pub(crate) struct Rows {
    legs: Vec<[Option<Leg>; 2]>,
    ldl: Ldl<f64>,
}

impl Rows {
    /// Impulses at the links give every row its target `[m/s]`, in the order of [`Joints::gaps`]; empty: none.
    ///
    /// Returns the multipliers of the rows.
    pub(crate) fn hold(&self, inertias: &[Inertia], twists: &mut [Twist], targets: &[f64]) -> Vec<f64> {
        let off = |(k, row): (usize, &[Option<Leg>; 2])| targets.get(k).copied().unwrap_or(0.0) - rate(row, twists);
        let mut lambda: Vec<f64> = self.legs.iter().enumerate().map(off).collect();
        self.ldl.solve_one(&mut lambda);
        for (row, impulse) in self.legs.iter().zip(&lambda) {
            for leg in row.iter().flatten() {
                let [ease, swing] = inertias[leg.body as usize].inverse;
                let twist = &mut twists[leg.body as usize];
                twist.velocity = add(twist.velocity, scale([leg.slope[0], leg.slope[1]], ease * impulse));
                twist.spin += leg.slope[2] * swing * impulse;
            }
        }
        lambda
    }
}

/// Links where bodies are at one moment.
pub(crate) struct Factored<'a> {
    pub(super) inertias: &'a [Inertia],
    rows: Rows,
    /// The rates of all rows that points which are led and drives ask for `[m/s]`, and drives alone; empty, where none does.
    pub(crate) leads: Vec<f64>,
    growths: Vec<f64>,
    /// Whether some point is led.
    pub(super) is_led: bool,
}

impl Factored<'_> {
    /// The work `[J]` of points that are led, and of drives, where impulses at the links alone changed motions by these.
    pub(super) fn works(&self, changes: &[Twist]) -> [f64; 2] {
        let mut lambda: Vec<f64> = self.rows.legs.iter().map(|row| rate(row, changes)).collect();
        self.rows.ldl.solve_one(&mut lambda);
        let work = |rates: &[f64]| lambda.iter().zip(rates).map(|(impulse, rate)| impulse * rate).sum::<f64>();
        let driven = work(&self.growths);
        [work(&self.leads) - driven, driven]
    }

    /// Whether some point is led or some rod driven.
    pub(super) fn does_work(&self) -> bool {
        self.is_led || !self.growths.is_empty()
    }

    /// Impulses at the links give every row its target `[m/s]`, in the order of [`Joints::gaps`]; empty: none.
    ///
    /// Returns the multipliers of the rows.
    pub(crate) fn hold(&self, twists: &mut [Twist], targets: &[f64]) -> Vec<f64> {
        self.rows.hold(self.inertias, twists, targets)
    }
}

/// The direction in which a row pulls its first end; of what has no end that moves none.
fn normal(row: &[Option<Leg>; 2]) -> [f64; 2] {
    match row {
        [Some(leg), _] => [leg.slope[0], leg.slope[1]],
        [None, Some(leg)] => [-leg.slope[0], -leg.slope[1]],
        [None, None] => [0.0; 2],
    }
}

/// How fast the gap of a row grows by the motion of its bodies `[m/s]`.
fn rate(row: &[Option<Leg>; 2], twists: &[Twist]) -> f64 {
    let of = |leg: &Leg| {
        let Twist { velocity, spin } = twists[leg.body as usize];
        leg.slope[0] * velocity[0] + leg.slope[1] * velocity[1] + leg.slope[2] * spin
    };
    row.iter().flatten().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rods of 1 m from one pin on, each at an angle `[rad]` and a little off the end of the one before it.
    fn chain(angles: &[f64]) -> (Joints, Vec<Inertia>, Vec<Motion>, [Anchor; 1]) {
        let on = |body: u32, x: f64| End::On { body, place: [x, 0.0] };
        let first = Link { ends: [End::Fixed(0), on(0, -0.5)], rest: None, drive: None };
        let others =
            (1..angles.len() as u32).map(|k| Link { ends: [on(k - 1, 0.5), on(k, -0.5)], rest: None, drive: None });
        let mut end = [1e-4, -2e-4];
        let motion = |&angle: &f64| {
            let turn = [libm::cos(angle), libm::sin(angle)];
            let middle = add(end, scale(turn, 0.5));
            end = add(end, scale(turn, 1.0002));
            Motion { place: Place { middle, angle, turn }, twist: Twist::STILL }
        };
        let motions = angles.iter().map(motion).collect();
        let inertias = vec![Inertia { inverse: [1.0, 12.0] }; angles.len()];
        (
            Joints::new(std::iter::once(first).chain(others).collect()),
            inertias,
            motions,
            [Anchor { place: [0.0; 2], velocity: [0.0; 2] }],
        )
    }

    /// The largest gap that is left by rows of where each rod is turned on by `turn` `[rad]`, and how often rows were worked out.
    fn closed_by_rows_of(turn: f64) -> (f64, u32) {
        let angles = [0.3, -0.4, 1.0];
        let (joints, inertias, mut motions, anchors) = chain(&angles);
        let (_, _, turned, _) = chain(&angles.map(|angle| angle + turn));
        let mut kept =
            Some(joints.rows_at(&inertias, Stand { motions: &turned, anchors: &anchors, since: 0.0, clock: None }));
        let closing = joints.close(&inertias, (&mut motions, &anchors, None), (8, 1e-12), Some(&mut kept));
        let gaps = joints.gaps(Stand { motions: &motions, anchors: &anchors, since: 0.0, clock: None });
        (gaps.iter().fold(0.0, |most: f64, gap| most.max(gap.abs())), closing.factored)
    }

    #[test]
    fn rows_from_near_by_close_gaps_and_those_from_far_off_are_worked_out_anew() {
        let (gap, factored) = closed_by_rows_of(0.001);
        assert!(gap < 1e-11 && factored == 0, "{gap} m, worked out {factored} times");
        let (gap, factored) = closed_by_rows_of(2.0);
        assert!(gap < 1e-9 && factored > 0, "{gap} m, worked out {factored} times");
    }
}
