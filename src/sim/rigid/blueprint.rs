//! What an island of rigid bonds is made of: rigid bodies, what joins them, and what stands still.

use std::sync::Arc;

use super::link::{End, Link};
use super::pieces::{Found, find};
use super::shape::{Held, Shape};
use super::strings::Strand;
use crate::sim::bond::{Bond, Limit};
use crate::sim::sets::Sets;
use crate::sim::sizes::MOST_PIECES;

/// Most that one body in joints may be as heavy as another: of more, rows that light ones bear look as if they repeated others.
const MOST_RATIO: f64 = 1e5;

/// Bodies and links, with points as the island has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Blueprint {
    pub(crate) bodies: Vec<BodyPlan>,
    pub(crate) links: Vec<Link>,
    pub(crate) strings: Vec<Strand>,
    /// The points that [`End::Fixed`] counts.
    pub(crate) fixed: Vec<u32>,
    /// Points of bodies that two pins or more hold: they stand still.
    pub(crate) still: Vec<u32>,
    /// Where each point is on a body or fixed: for springs between them.
    pub(crate) seats: Vec<End>,
}

/// One body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BodyPlan {
    pub(crate) shape: Arc<Shape>,
    /// Its points, in the order of the shape.
    pub(crate) points: Vec<u32>,
    /// Those of them, counted in the shape, that meet nothing: pins, and joints that are met as points of another body.
    pub(crate) deaf: Vec<u32>,
}

impl Blueprint {
    /// A body alone.
    pub(crate) fn alone(shape: Shape) -> Self {
        let points = (0..shape.places.len() as u32).collect();
        let deaf = shape.pin.map(|(pin, _)| pin).into_iter().collect();
        Blueprint { bodies: vec![BodyPlan { shape: Arc::new(shape), points, deaf }], ..Blueprint::default() }
    }

    /// Bodies that share points or that bonds join, points that are in none being bodies too; `None`: lengths contradict each other, there is too
    /// much, or masses differ too much, or there are points alone and no bonds, or more than `most_alone`.
    ///
    /// Masses are infinite where points are pinned. What two pins hold that are not led stands still, and so does what hangs on that by two
    /// points. `loose` bonds are rigid too and make no body, for they may break, act on one side only or have a
    /// drive: they join bodies, if there are any.
    pub(crate) fn of(held: &Held<'_>, loose: &[Bond], most_alone: usize, is_led: impl Fn(u32) -> bool) -> Option<Self> {
        let found = find(held)?;
        let is_of_points = loose.is_empty() && (1..=most_alone).contains(&held.bonds.len());
        if found.pieces.is_empty() && !is_of_points {
            return None;
        }
        let count = held.now.len();
        let mut is_fixed: Vec<bool> = held.masses.iter().map(|mass| !mass.is_finite()).collect();
        let moves = stand(&found, &mut is_fixed, is_led);
        let mut homes: Vec<Vec<u32>> = vec![Vec::new(); count];
        let moving: Vec<usize> = (0..found.pieces.len()).filter(|&k| moves[k]).collect();
        for (body, &piece) in moving.iter().enumerate() {
            found.pieces[piece].points.iter().for_each(|&point| homes[point as usize].push(body as u32));
        }
        let mut plan = Blueprint {
            still: (0..count as u32).filter(|&k| is_fixed[k as usize] && held.masses[k as usize].is_finite()).collect(),
            ..Blueprint::default()
        };
        for (body, &piece) in moving.iter().enumerate() {
            let points = found.pieces[piece].points.clone();
            let mass = |point: u32| match is_fixed[point as usize] {
                true => 0.0,
                false => held.masses[point as usize] / homes[point as usize].len() as f64,
            };
            let masses: Vec<f64> = points.iter().map(|&point| mass(point)).collect();
            let shape = Shape::free(found.pieces[piece].places.clone(), masses);
            let is_deaf =
                |point: u32| is_fixed[point as usize] || homes[point as usize].first() != Some(&(body as u32));
            let deaf = points.iter().zip(0..).filter(|(point, _)| is_deaf(**point)).map(|(_, k)| k).collect();
            plan.bodies.push(BodyPlan { shape: Arc::new(shape), points, deaf });
        }
        for point in 0..count as u32 {
            if homes[point as usize].is_empty() && !is_fixed[point as usize] {
                homes[point as usize].push(plan.bodies.len() as u32);
                let shape = Shape::free(vec![[0.0; 2]], vec![held.masses[point as usize]]);
                plan.bodies.push(BodyPlan { shape: Arc::new(shape), points: vec![point], deaf: Vec::new() });
            }
        }
        plan.join(held, &found, (&homes, &is_fixed));
        plan.join_loosely(loose, &homes);
        let masses = || plan.bodies.iter().map(|body| body.shape.mass);
        let (lightest, heaviest) = (masses().fold(f64::INFINITY, f64::min), masses().fold(0.0, f64::max));
        let joined = plan.links.len() + plan.strings.len();
        // Rods that may break and are more than hold bodies are a mesh.
        let is_mesh = !loose.is_empty() && plan.rows() > plan.freedoms();
        let is_even = joined == 0 || heaviest <= MOST_RATIO * lightest;
        let is_small = plan.bodies.len() <= MOST_PIECES && joined <= MOST_PIECES;
        (is_small && is_even && !is_mesh && plan.follows()).then_some(plan)
    }

    /// Whether nothing else joins the ends of a driven rod: what is joined in a ring may not get as far as a drive leads it. And whether no
    /// more strings close rings than bodies have coordinates: such a net is better moved bond by bond.
    fn follows(&self) -> bool {
        let ground = self.bodies.len() as u32;
        let body = |end: End| match end {
            End::On { body, .. } => body,
            End::Fixed(_) => ground,
        };
        let is_driven = |link: &&Link| link.drive.is_some();
        let mut together = Sets::new(self.bodies.len() + 1);
        let mut is_bridge = |ends: [End; 2]| {
            let [a, b] = ends.map(body);
            let is_bridge = together.find(a) != together.find(b);
            together.join(a, b);
            is_bridge
        };
        self.links.iter().filter(|link| !is_driven(link)).for_each(|link| {
            is_bridge(link.ends);
        });
        let closing = self.strings.iter().filter(|string| !is_bridge(string.ends)).count();
        let turning = self.bodies.iter().filter(|body| body.shape.inertia.is_finite()).count();
        closing <= 3 * turning && self.links.iter().filter(is_driven).all(|link| is_bridge(link.ends))
    }

    /// The links between its bodies, and the seats of all points.
    fn join(&mut self, held: &Held<'_>, found: &Found, (homes, is_fixed): (&[Vec<u32>], &[bool])) {
        let ends = |plan: &mut Blueprint, point: u32| -> Vec<End> {
            let at = |body: u32| {
                let BodyPlan { shape, points, .. } = &plan.bodies[body as usize];
                let k = points.binary_search(&point).unwrap_or_default();
                End::On { body, place: shape.places[k] }
            };
            let mut list: Vec<End> = homes[point as usize].iter().map(|&body| at(body)).collect();
            if is_fixed[point as usize] {
                list.insert(0, End::Fixed(plan.fixed.len() as u32));
                plan.fixed.push(point);
            }
            list
        };
        for point in 0..held.now.len() as u32 {
            let list = ends(self, point);
            if let Some((&first, others)) = list.split_first() {
                self.links.extend(others.iter().map(|&other| Link { ends: [first, other], rest: None, drive: None }));
                self.seats.push(first);
            }
        }
        for &rod in &found.rods {
            let ([a, b], rest) = held.bonds[rod as usize];
            let ends = [a, b].map(|point| self.seats[point as usize]);
            if !ends.iter().all(|end| matches!(end, End::Fixed(_))) {
                self.links.push(Link { ends, rest: Some(rest), drive: None });
            }
        }
    }

    /// Equations of its links.
    fn rows(&self) -> usize {
        self.links.iter().map(|link| if link.rest.is_some() { 1 } else { 2 }).sum()
    }

    /// Coordinates of its bodies: a point alone does not turn.
    fn freedoms(&self) -> usize {
        self.bodies.iter().map(|body| if body.shape.inertia.is_finite() { 3 } else { 2 }).sum()
    }

    /// Links and strings for bonds that make no body, where their ends are on different ones: within one nothing strains them.
    fn join_loosely(&mut self, loose: &[Bond], homes: &[Vec<u32>]) {
        for bond in loose {
            let ends = [bond.a, bond.b].map(|end| self.seats[end.index()]);
            let [one, other] = [bond.a, bond.b].map(|end| &homes[end.index()]);
            let is_within = one.iter().any(|body| other.contains(body));
            if is_within || ends.iter().all(|end| matches!(end, End::Fixed(_))) {
                continue;
            }
            let rest = bond.rest_length;
            match bond.limit {
                Limit::Both => self.links.push(Link { ends, rest: Some(rest), drive: bond.drive }),
                limit => self.strings.push(Strand { ends, rest, is_longest: limit == Limit::Max }),
            }
        }
    }
}

/// Whether each piece moves: not where two of its points are fixed. The points of such a piece are, from then on.
fn stand(found: &Found, is_fixed: &mut [bool], is_led: impl Fn(u32) -> bool) -> Vec<bool> {
    let mut moves = vec![true; found.pieces.len()];
    loop {
        let is_held = |point: &&u32| is_fixed[**point as usize] && !is_led(**point);
        let fixed = |k: usize| found.pieces[k].points.iter().filter(is_held).count();
        let Some(next) = (0..moves.len()).find(|&k| moves[k] && fixed(k) > 1) else { return moves };
        moves[next] = false;
        found.pieces[next].points.iter().for_each(|&point| is_fixed[point as usize] = true);
    }
}
