//! From bonds and triangles to bodies with skins.

use std::sync::Arc;

use super::bend::Bends;
use super::body::{Area, Body, Edge, Link, Relaxed, Span};
use super::cluster::{Cluster, Side};
use super::drives::{Muscle, Turn};
use super::gather::MOST_SUBSTEPS;
use super::rig::Rig;
use super::rigid::{Held, Shape};
use super::skins::Skin;
use super::strap::{is_led_apart, straps};
use super::{Draft, FRAMES, bear, bonds, flats, tree};
use crate::sim::bond::{Bond, BondKind, Lengths, Limit, PointId};
use crate::sim::colour::by_colour;
use crate::sim::contact::hinged::Hinged;
use crate::sim::contact::skin::{MOST_RADIUS, RADIUS};
use crate::sim::force::angle::Hinge;
use crate::sim::force::area;
use crate::sim::measure::extent;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::sizes::{LEAST_LIVE_PATH, MOST_LIVE_RING};
use crate::sim::triangles;
use crate::sim::vector::{length, scale, sub, widen};

/// Stiffness over mass from which on springs that make trees are taken for rigid, times the square of the longest substep, of 1/16 frame `[1]`.
const STIFF: f64 = 100.0;
/// The longest substep `[s]`, and how stiff angles may be in it (`Hinge::bounded`) that are bent one by one: stiffer ones, each solved once, would
/// give way to bonds and load them.
const BENDING: (f64, f64) = (1.0 / 960.0, 1.0);
/// Oscillation beyond which a body of hard springs counts as rigid `[rad/s]`: of 30 Hz, more than 60 frames a second can show.
const SEEN: f64 = 188.5;

/// All bodies of a group.
#[derive(Clone, Debug, Default)]
pub(super) struct Bodies<S> {
    pub(super) list: Vec<Body<S>>,
    /// Places of points in the group, body by body.
    pub(super) order: Vec<u32>,
    /// Bonds that may be forces.
    pub(super) springs: Vec<Link<S>>,
    /// Of every spring bounds on the square of the fastest oscillation `[1/s^2]` and on the fastest decay `[1/s]` of its ends.
    pub(super) swings: Vec<[S; 2]>,
    /// Bonds that are held whatever the substep.
    pub(super) holds: Vec<Link<S>>,
    pub(super) areas: Vec<Area<S>>,
    /// Angles that resist.
    pub(super) hinges: Vec<Hinge<S>>,
    /// Bonds and angles that drives move.
    pub(super) muscles: Vec<Muscle<S>>,
    pub(super) turns: Vec<Turn<S>>,
    pub(super) edges: Vec<Edge>,
    /// Points of skins.
    pub(super) corners: Vec<u32>,
    /// What skins are made of, in the order of `order`; empty where no body has its own.
    pub(super) skins: Vec<Skin<S>>,
    /// Points of a body that bonds join, by the places of points in `order`: where the list of each begins, and all lists.
    neighbours: (Vec<u32>, Vec<u32>),
    /// Meshes of a body that pass through each other, by the places of points in `order`.
    hinged: Hinged,
}

impl<S: Real> Bodies<S> {
    pub(super) fn new(draft: &Draft<S>, points: &Points<S, 2>) -> Self {
        let mut bodies = Bodies::default();
        let count = draft.body_of.iter().map(|&body| body as usize + 1).max().unwrap_or(0);
        let mut own: Vec<Own<S>> = vec![Own::default(); count];
        let mut local = vec![0; points.len()];
        for (i, &body) in draft.body_of.iter().enumerate() {
            local[i] = own[body as usize].points.len() as u32;
            own[body as usize].points.push(i as u32);
        }
        for bond in &draft.bonds {
            // A pin that several bodies hang on belongs to one of them: its bonds go with their free ends.
            own[draft.body_of[bond.a.index()] as usize].bonds.push(*bond);
        }
        for (corners, rest) in &draft.triangles {
            let [a, b, c] = corners.map(|corner| draft.body_of[corner as usize]);
            if a == b && b == c {
                own[a as usize].triangles.push(*corners);
                own[a as usize].rests.push(*rest);
            }
        }
        for hinge in &draft.hinges {
            own[draft.body_of[hinge.points[1] as usize] as usize].hinges.push(*hinge);
        }
        for own in own {
            bodies.push(own, &mut local, points, draft);
        }
        bodies.note_neighbours(draft, points.len());
        bodies
    }

    fn note_neighbours(&mut self, draft: &Draft<S>, count: usize) {
        let mut place = vec![0; count];
        self.order.iter().zip(0..).for_each(|(&slot, at)| place[slot as usize] = at);
        // What is rigid meets nothing of itself.
        let is_soft = |point: u32| self.list[draft.body_of[point as usize] as usize].rigid.is_none();
        let mut ends: Vec<[u32; 2]> = Vec::new();
        for bond in draft.bonds.iter().filter(|bond| is_soft(bond.a.0)) {
            let [a, b] = [bond.a, bond.b].map(|end| place[end.index()]);
            ends.extend([[a, b], [b, a]]);
        }
        ends.sort_unstable();
        ends.dedup();
        let place_of = |corners: &([u32; 3], Option<f64>)| corners.0.map(|corner| place[corner as usize]);
        let soft = draft.triangles.iter().filter(|triangle| is_soft(triangle.0[0]));
        let triangles: Vec<[u32; 3]> = soft.map(place_of).collect();
        self.hinged = Hinged::of(count, &triangles, ends.iter().copied().filter(|[a, b]| a < b));
        let starts = (0..=count as u32).map(|at| ends.partition_point(|pair| pair[0] < at) as u32).collect();
        self.neighbours = (starts, ends.into_iter().map(|pair| pair[1]).collect());
    }

    /// Whether a point of a cluster passes the edge between two others of its body: it is joined to one of them, hinged to them, or lies in
    /// a layer of its own.
    pub(super) fn is_passed(&self, state: &Cluster<S>, (p, others): (usize, [usize; 2])) -> bool {
        let body = state.body_of[p] as usize;
        let (base, first) = (state.bases[body] as usize, self.list[state.bodies[body]].points.first as usize);
        let place = |point: usize| (point - base + first) as u32;
        let (at, others) = (place(p), others.map(place));
        let (starts, list) = &self.neighbours;
        let own = &list[starts[at as usize] as usize..starts[at as usize + 1] as usize];
        others.iter().any(|other| own.contains(other))
            || self.hinged.pass([at], others)
            || self.are_layers([at, others[0], others[1]])
    }

    /// Whether two edges of a body of a cluster pass through each other, for they are hinged or lie in layers.
    pub(super) fn pass(&self, state: &Cluster<S>, [first, second]: [&Side; 2]) -> bool {
        let body = first.body as usize;
        let (base, begin) = (state.bases[body], self.list[state.bodies[body]].points.first);
        let places = |ends: [u32; 2]| ends.map(|end| end - base + begin);
        let ([a, b], [c, d]) = (places(first.ends), places(second.ends));
        self.hinged.pass([a, b], [c, d]) || self.are_layers([a, b, c, d])
    }

    fn push(&mut self, mut own: Own<S>, local: &mut [u32], points: &Points<S, 2>, draft: &Draft<S>) {
        let place = |i: u32| points.position[i as usize];
        let w = |i: u32| points.inverse_mass[i as usize];
        let starts = self.ends();
        let mut edges = skin(&own);
        let mut corners = corners(&edges, &own);
        let lengths = Lengths::of(own.bonds.iter().map(|bond| ([bond.a, bond.b], bond.rest_length)));
        let total = edges.iter().fold(S::ZERO, |sum, edge| sum + length(sub(place(edge.ends[0]), place(edge.ends[1]))));
        let edge_length = if edges.is_empty() { S::ZERO } else { total / S::from_f64(edges.len() as f64) };
        let thin = thickness(&own.triangles, edges.iter().filter(|edge| edge.is_closed), place);
        let surface = if draft.contact.is_some() { &corners } else { &own.points };
        let is_hard = own.is_hard((place, w));
        let mut rigid = own.shape((local, points), surface, |bond| bond.holds() || is_hard && is_spring(bond));
        let straps = straps(&own.bonds, (&own.points, local), &draft.led, |i| w(i) == S::ZERO);
        // Joints that pins contradict have no solution: bonds are stretched there.
        let is_apart = is_led_apart(&straps, (&own.points, place), draft);
        if let Some(shape) = rigid.as_mut().filter(|_| draft.contact.is_some()) {
            let material = |i: u32| draft.skins.get(i as usize);
            let at = |i: u32| shape.places[local[i as usize] as usize];
            edges = flats::joined(&edges, at, |a, b| material(a) == material(b));
            corners = self::corners(&edges, &own);
            // What may touch something comes first.
            let is_inner = |i: &u32| corners.binary_search(i).is_err();
            let inner = own.points.iter().copied().filter(is_inner);
            let points: Vec<u32> = corners.iter().copied().chain(inner).collect();
            let order: Vec<u32> = points.iter().map(|&i| local[i as usize]).collect();
            shape.reorder(&order, corners.len() as u32);
            points.iter().zip(0..).for_each(|(&i, k)| local[i as usize] = k);
            own.points = points;
        }
        let rig = if rigid.is_none() && !is_apart {
            own.rig((local, points), &draft.led, draft.contact.is_some())
        } else {
            None
        };
        if rigid.is_some() {
            // What it is made of within says nothing any more.
            own.let_go();
        } else if let Some(rig) = &rig {
            own.let_go_of(rig, local);
        }
        let (driven, kept): (Vec<Bond>, Vec<Bond>) = own.bonds.iter().partition(|bond| bond.drive.is_some());
        own.bonds = kept;
        let (tree, others) = own.forest(|bond| bond.is_held() || is_stiff(bond, w), |i| w(i) == S::ZERO);
        let (tree, others) =
            if tree.is_empty() { own.forest(Bond::is_held, |i| w(i) == S::ZERO) } else { (tree, others) };
        let link = |bond: &Bond| link(bond, local, draft.sweeps);
        self.holds.extend(tree.iter().map(link));
        let (springs, holds): (Vec<&Bond>, Vec<&Bond>) = others.iter().partition(|bond| is_spring(bond));
        let [springs, holds] = [springs, holds].map(|list| in_turn(list, local, own.points.len()));
        let bounds = Bounds::new(&springs.iter().copied().chain(&driven).collect::<Vec<&Bond>>(), (place, w));
        self.muscles.extend(driven.iter().filter_map(|bond| {
            Muscle::of(bond, [bond.a, bond.b].map(|end| local[end.index()]), bounds.at_ends(bond).map(S::from_f64))
        }));
        self.springs.extend(springs.iter().map(|bond| link(bond)));
        self.swings.extend(springs.iter().map(|bond| bounds.at_ends(bond).map(S::from_f64)));
        self.holds.extend(holds.iter().map(|bond| link(bond)));
        self.areas.extend(
            own.triangles
                .iter()
                .zip(&own.rests)
                .filter_map(|(&corners, &rest)| area(corners, (corners.map(place), rest), (&lengths, local))),
        );
        let within = |hinge: &Hinge<S>| hinge.between(hinge.points.map(|point| local[point as usize]));
        let borne = |hinge: &Hinge<S>| hinge.bounded(hinge.points.map(|point| w(point).to_f64()), BENDING);
        let (turns, hinges): (Vec<Hinge<S>>, Vec<Hinge<S>>) =
            own.hinges.iter().partition(|hinge| hinge.drive.is_some());
        let as_made: Vec<Hinge<S>> = hinges.iter().map(within).collect();
        let bends = if rig.is_none() { Bends::of(&as_made) } else { None };
        match bends {
            Some(_) => self.hinges.extend(as_made),
            None => self.hinges.extend(hinges.iter().map(|hinge| within(&borne(hinge)))),
        }
        self.turns.extend(turns.iter().map(|hinge| Turn::of(within(&borne(hinge)))));
        let contact = draft.contact.unwrap_or_default();
        let radius = draft.contact.and(contact.radius);
        let radius = radius.map_or(edge_length.min(thin) * S::from_f64(RADIUS), S::from_f64);
        let most = if edge_length > S::ZERO { edge_length * S::from_f64(MOST_RADIUS) } else { S::INFINITY };
        let radius = radius.min(most);
        self.edges.extend(edges.iter().map(|edge| Edge { ends: edge.ends.map(|end| local[end as usize]), ..*edge }));
        self.corners.extend(corners.iter().map(|&corner| local[corner as usize]));
        self.order.extend(&own.points);
        let ends = self.ends();
        let corners = Span { first: starts[5], end: ends[5] };
        let radius = self.note_skins((&own.points, corners), &draft.skins, (&contact, radius, most));
        let span = |k: usize| Span { first: starts[k], end: ends[k] };
        self.list.push(Body {
            points: span(0),
            springs: span(1),
            holds: span(2),
            areas: span(3),
            edges: span(4),
            corners: span(5),
            hinges: span(6),
            muscles: span(7),
            turns: span(8),
            bends: bends.map(Arc::new),
            tree: tree.len() as u32,
            is_swept: own.hinges.is_empty() && others.iter().any(|bond| bond.kind == BondKind::Rigid),
            edge_length,
            radius,
            least_substeps: bounds.substeps([bonds::MOST_BY_FORCES, 1.0], MOST_SUBSTEPS),
            straps,
            rigid: rigid.map(Arc::new),
            rig: rig.map(Arc::new),
        });
    }

    fn ends(&self) -> [u32; 9] {
        let bonds = [self.order.len(), self.springs.len(), self.holds.len()];
        let [order, springs, holds] = bonds;
        let [areas, edges, corners] = [self.areas.len(), self.edges.len(), self.corners.len()];
        let [hinges, muscles, turns] = [self.hinges.len(), self.muscles.len(), self.turns.len()];
        [order, springs, holds, areas, edges, corners, hinges, muscles, turns].map(|count| count as u32)
    }
}

/// What is of one body, points numbered as in the group.
#[derive(Clone, Debug, Default)]
struct Own<S> {
    points: Vec<u32>,
    bonds: Vec<Bond>,
    triangles: Vec<[u32; 3]>,
    /// Areas at rest of the triangles `[m^2]`, where they are known.
    rests: Vec<Option<f64>>,
    hinges: Vec<Hinge<S>>,
}

impl<S: Real> Own<S> {
    /// The shape that bonds which hold keep it in, if they hold all of it; of points counted in the group those of its surface.
    fn shape(
        &self,
        (local, points): (&[u32], &Points<S, 2>),
        surface: &[u32],
        holds: impl Fn(&Bond) -> bool,
    ) -> Option<Shape> {
        if self.points.iter().any(|&i| points.inverse_mass[i as usize] == S::ZERO) {
            return None;
        }
        let surface: Vec<u32> = surface.iter().map(|&i| local[i as usize]).collect();
        Shape::of(self.held((local, points), &surface, holds))
    }

    /// Whether its springs are so hard that nobody sees it wobble: its slowest oscillation is faster than [`SEEN`]. Sweeps would make it
    /// softer by far.
    ///
    /// A body n bonds long and b thick bends at about omega b/n^2, with omega that of one bond.
    fn is_hard(&self, (place, w): (impl Fn(u32) -> [S; 2], impl Fn(u32) -> S + Copy)) -> bool {
        let lasts = |bond: &Bond| is_spring(bond) && is_plain(bond) && bond.drive.is_none();
        if !self.bonds.iter().any(is_spring) || !self.bonds.iter().all(|bond| bond.holds() || lasts(bond)) {
            return false;
        }
        let square = |bond: &Bond| match bond.kind {
            BondKind::Spring { stiffness, .. } => stiffness * (w(bond.a.0) + w(bond.b.0)).to_f64(),
            _ => f64::INFINITY,
        };
        let slowest = self.bonds.iter().map(square).fold(f64::INFINITY, f64::min).sqrt();
        let mean = self.bonds.iter().map(|bond| bond.rest_length).sum::<f64>() / self.bonds.len() as f64;
        let places: Vec<[S; 2]> = self.points.iter().map(|&i| place(i)).collect();
        let across = extent(&places).map_or(0.0, |[low, high]| length(sub(high, low)).to_f64());
        let long = across / mean + 1.0;
        slowest * self.points.len() as f64 >= SEEN * long.powi(3)
    }

    /// The rigid bodies in joints that rigid bonds make of it, if they make any; or its points in a ring that bears a weight, where it meets no
    /// bodies: a crumpled one has no joints that could be closed.
    fn rig(&self, (local, points): (&[u32], &Points<S, 2>), led: &[u32], meets: bool) -> Option<Rig> {
        let is_led = |point: u32| led.binary_search(&self.points[point as usize]).is_ok();
        let w = |i: u32| points.inverse_mass[i as usize];
        let most_alone = if !meets && self.bears(w) { MOST_LIVE_RING } else { 0 };
        Rig::of(&self.held((local, points), &[], Bond::holds), most_alone, is_led)
    }

    /// Whether some of its points are much heavier than others, and rigid bonds that are no tree hold it.
    fn bears(&self, w: impl Fn(u32) -> S) -> bool {
        let masses = || self.points.iter().map(|&i| w(i).to_f64()).filter(|&w| w > 0.0);
        let (least, most) = (masses().fold(f64::INFINITY, f64::min), masses().fold(0.0, f64::max));
        let rigid: Vec<Bond> = self.bonds.iter().copied().filter(Bond::holds).collect();
        let are_few = self.points.len() <= MOST_LIVE_RING;
        are_few
            && most > bear::HEAVIER * least
            && rigid.len() <= 2 * self.points.len()
            && tree::forest(&rigid, |i| w(i) == S::ZERO).is_none()
    }

    /// Its points and the bonds that hold them: those that `holds` says.
    fn held<'a>(
        &self,
        (local, points): (&[u32], &Points<S, 2>),
        surface: &'a [u32],
        holds: impl Fn(&Bond) -> bool,
    ) -> Held<'a> {
        let bond = |bond: &Bond| ([bond.a, bond.b].map(|end| local[end.index()]), bond.rest_length);
        let of = |&i: &u32| widen(points.position[i as usize]);
        let mass = |&i: &u32| 1.0 / points.inverse_mass[i as usize].to_f64();
        Held {
            now: self.points.iter().map(of).collect(),
            masses: self.points.iter().map(mass).collect(),
            bonds: self.bonds.iter().filter(|bond| holds(bond)).map(bond).collect(),
            surface,
        }
    }

    /// What a rig holds of its bonds, triangles and angles goes, and all triangles at its frames: they cannot be pressed.
    fn let_go_of(&mut self, rig: &Rig, local: &[u32]) {
        let places = |points: &[u32]| points.iter().map(|&point| local[point as usize]).collect::<Vec<u32>>();
        self.bonds.retain(|bond| !bond.holds() && !rig.holds(&places(&[bond.a.0, bond.b.0])));
        self.hinges.retain(|hinge| !rig.holds(&places(&hinge.points)));
        let is_free = |corners: &[u32; 3]| !corners.iter().any(|&corner| rig.holds(&[local[corner as usize]]));
        let kept: Vec<bool> = self.triangles.iter().map(is_free).collect();
        let mut keeps = kept.iter();
        self.triangles.retain(|_| *keeps.next().unwrap_or(&true));
        let mut keeps = kept.iter();
        self.rests.retain(|_| *keeps.next().unwrap_or(&true));
    }

    /// Its bonds, triangles and angles go.
    fn let_go(&mut self) {
        self.bonds.clear();
        self.triangles.clear();
        self.rests.clear();
        self.hinges.clear();
    }

    /// The forest that some of its bonds make, from the roots on, and all others; no forest, where they make none.
    fn forest(
        &self,
        is_meant: impl Fn(&Bond) -> bool,
        is_pinned: impl Fn(u32) -> bool + Copy,
    ) -> (Vec<Bond>, Vec<Bond>) {
        let (meant, others): (Vec<Bond>, Vec<Bond>) = self.bonds.iter().copied().partition(|bond| is_meant(bond));
        match tree::forest(&meant, is_pinned) {
            Some(tree) => (tree, others),
            None => (Vec::new(), self.bonds.clone()),
        }
    }
}

/// In an order in which bonds that follow on each other share no point: none waits for the one before.
pub(super) fn in_turn<'a>(list: Vec<&'a Bond>, local: &[u32], points: usize) -> Vec<&'a Bond> {
    let ends: Vec<[u32; 2]> = list.iter().map(|bond| [bond.a, bond.b].map(|end| local[end.index()])).collect();
    by_colour(&ends, points).into_iter().map(|k| list[k as usize]).collect()
}

pub(super) fn is_spring(bond: &Bond) -> bool {
    matches!(bond.kind, BondKind::Spring { .. })
}

/// A spring that gives so little in a substep that a rigid bond is nearer to it than what one sweep makes of a spring.
fn is_stiff<S: Real>(bond: &Bond, w: impl Fn(u32) -> S) -> bool {
    let BondKind::Spring { stiffness, .. } = bond.kind else { return false };
    let sum = (w(bond.a.0) + w(bond.b.0)).to_f64();
    is_plain(bond) && stiffness * sum >= STIFF * (FRAMES * FRAMES) * 256.0
}

/// It pulls and presses, for ever.
fn is_plain(bond: &Bond) -> bool {
    bond.limit == Limit::Both && bond.rest_length > 0.0 && !bond.break_strain.is_finite()
}

/// A bond as the live step has it; `sweeps`: see [`Draft`].
pub(super) fn link<S: Real>(bond: &Bond, local: &[u32], sweeps: (f64, u32)) -> Link<S> {
    let (stiffness, damping, relaxed) = match bond.kind {
        BondKind::Rigid => (f64::INFINITY, 0.0, None),
        BondKind::Spring { stiffness, damping } => (stiffness, damping, None),
        BondKind::Relaxed { relaxation, max_correction } => {
            (f64::INFINITY, 0.0, Some(Relaxed::new((relaxation, max_correction), sweeps)))
        }
    };
    Link {
        a: local[bond.a.index()],
        b: local[bond.b.index()],
        rest: S::from_f64(bond.rest_length),
        stiffness: S::from_f64(stiffness),
        damping: S::from_f64(damping),
        relaxed,
        limit: bond.limit,
    }
}

/// The rigid bonds in the order of the one open path that they make, if they do: no point has more than two.
pub(super) fn path_of(bonds: &[Bond]) -> Option<Vec<Bond>> {
    let mut rigid: Vec<Bond> = bonds.iter().copied().filter(Bond::is_held).collect();
    if rigid.len() < LEAST_LIVE_PATH {
        return None;
    }
    let mut at: Vec<(u32, usize)> =
        rigid.iter().enumerate().flat_map(|(k, bond)| [(bond.a.0, k), (bond.b.0, k)]).collect();
    at.sort_unstable();
    let of = |point: u32| {
        let start = at.partition_point(|entry| entry.0 < point);
        at[start..].iter().take_while(move |entry| entry.0 == point).map(|entry| entry.1)
    };
    if at.windows(3).any(|three| three[0].0 == three[2].0) {
        return None;
    }
    let mut point = at.iter().map(|entry| entry.0).find(|&point| of(point).count() == 1)?;
    let mut path = Vec::with_capacity(rigid.len());
    let mut last = usize::MAX;
    while let Some(next) = of(point).find(|&k| k != last) {
        let bond = &mut rigid[next];
        if bond.a.0 != point {
            (bond.a, bond.b) = (bond.b, bond.a);
        }
        path.push(*bond);
        (point, last) = (bond.b.0, next);
    }
    (path.len() == rigid.len()).then_some(path)
}

/// A triangle with the area at rest that is known, or that it is made with; `None` of what has no inside.
fn area<S: Real>(
    corners: [u32; 3],
    (places, known): ([[S; 2]; 3], Option<f64>),
    (lengths, local): (&Lengths, &[u32]),
) -> Option<Area<S>> {
    let [p, q, r] = corners;
    let made = || area::rest(places, [[p, q], [q, r], [r, p]].map(|ends| lengths.between(ends.map(PointId))));
    let size = known.map_or_else(made, |known| (known > 0.0).then_some(known))?;
    Some(Area { corners: corners.map(|corner| local[corner as usize]), rest: S::from_f64(size) })
}

/// The hydraulic diameter of what triangles cover `[m]`: four areas by the length of its outline; infinite of what covers nothing.
fn thickness<'a, S: Real>(
    triangles: &[[u32; 3]],
    outline: impl Iterator<Item = &'a Edge>,
    place: impl Fn(u32) -> [S; 2],
) -> S {
    let size = |&corners: &[u32; 3]| area::size(corners.map(&place)).abs();
    let around = outline.fold(S::ZERO, |sum, edge| sum + length(sub(place(edge.ends[0]), place(edge.ends[1]))));
    let area = triangles.iter().map(size).fold(S::ZERO, |sum, size| sum + size);
    if area > S::ZERO && around > S::ZERO { area * S::from_f64(4.0) / around } else { S::INFINITY }
}

/// The skin of a body.
fn skin<S>(own: &Own<S>) -> Vec<Edge> {
    let skin = triangles::skin(&own.triangles, own.bonds.iter().map(|bond| [bond.a.0, bond.b.0]));
    let edge = |is_closed: bool| move |ends: [u32; 2]| Edge { ends, is_closed };
    skin.closed.into_iter().map(edge(true)).chain(skin.open.into_iter().map(edge(false))).collect()
}

/// The points of a skin; all where there is none.
fn corners<S>(edges: &[Edge], own: &Own<S>) -> Vec<u32> {
    let mut corners: Vec<u32> = edges.iter().flat_map(|edge| edge.ends).collect();
    if edges.is_empty() {
        corners.extend(&own.points);
    }
    corners.sort_unstable();
    corners.dedup();
    corners
}

/// Bounds on the square of the fastest oscillation `[1/s^2]` and on the fastest decay `[1/s]` of springs, a row a point.
///
/// Of a spring k along n between a and b k (n . (u_a - u_b))^2 <= 2 k ((n . u_a)^2 + (n . u_b)^2): so the square is at most 2 w times the largest
/// eigenvalue of the sum of k n n^T at a point, over all points. As springs turn against each other it grows, to the trace at most: half of that is
/// the least that counts, so that it never doubles.
pub(super) struct Bounds(Vec<(u32, [f64; 2])>);

impl Bounds {
    pub(super) fn new<S: Real, const D: usize>(
        springs: &[&Bond],
        (place, w): (impl Fn(u32) -> [S; D], impl Fn(u32) -> S),
    ) -> Self {
        let mut stars: Vec<(u32, [f64; 2], [f64; D])> = Vec::with_capacity(2 * springs.len());
        for bond in springs {
            if let BondKind::Spring { stiffness, damping } = bond.kind {
                let d = widen(sub(place(bond.a.0), place(bond.b.0)));
                let along = if bond.rest_length > 0.0 { scale(d, 1.0 / length(d)) } else { [f64::NAN; D] };
                stars.extend([bond.a.0, bond.b.0].map(|end| (end, [stiffness, damping], along)));
            }
        }
        stars.sort_by_key(|entry| entry.0);
        let row = |star: &[(u32, [f64; 2], [f64; D])]| {
            let w = w(star[0].0).to_f64();
            (star[0].0, [0, 1].map(|k| 2.0 * w * most_along(star.iter().map(|entry| (entry.1[k], entry.2)))))
        };
        Bounds(stars.chunk_by(|a, b| a.0 == b.0).map(row).collect())
    }

    /// The larger ones of both ends of a spring.
    fn at_ends(&self, bond: &Bond) -> [f64; 2] {
        let at = |end: u32| self.0.binary_search_by_key(&end, |row| row.0).map_or([0.0; 2], |row| self.0[row].1);
        let [a, b] = [at(bond.a.0), at(bond.b.0)];
        [a[0].max(b[0]), a[1].max(b[1])]
    }

    /// Substeps of a frame in which springs at these shares of the points may be forces, and exact ones; 0 where that were more than `most`.
    pub(super) fn substeps(&self, shares: [f64; 2], most: u32) -> [u32; 2] {
        [0, 1].map(|k| {
            let mut list: Vec<f64> = self.0.iter().map(|row| bonds::substeps(row.1)[k]).collect();
            list.sort_unstable_by(f64::total_cmp);
            let last = ((list.len() as f64 * shares[k]).ceil() as usize).min(list.len());
            let wanted = last.checked_sub(1).map_or(0.0, |last| list[last]);
            if wanted <= f64::from(most) { wanted as u32 } else { 0 }
        })
    }

    /// The largest bounds of all points.
    pub(super) fn most(&self) -> [f64; 2] {
        [0, 1].map(|k| self.0.iter().map(|row| row.1[k]).fold(0.0, f64::max))
    }
}

/// A bound on the largest eigenvalue of the sum of k n n^T, within a few per cent, and not below half of its trace; what has no direction is as stiff
/// in all of them.
fn most_along<const D: usize>(springs: impl Iterator<Item = (f64, [f64; D])>) -> f64 {
    let mut sum = [[0.0; D]; D];
    let mut trace = 0.0;
    for (stiffness, n) in springs {
        let is_known = n.iter().all(|x| x.is_finite());
        for (i, j) in (0..D).flat_map(|i| (0..D).map(move |j| (i, j))) {
            sum[i][j] += stiffness * if is_known { n[i] * n[j] } else { f64::from(u8::from(i == j)) };
        }
        trace += stiffness * if is_known { 1.0 } else { D as f64 };
    }
    if trace == 0.0 {
        return 0.0;
    }
    // The sum of the sixteenth powers of its eigenvalues is the trace of its sixteenth power.
    let mut power = sum.map(|row| row.map(|x| x / trace));
    for _ in 0..4 {
        power = std::array::from_fn(|i| std::array::from_fn(|j| (0..D).map(|k| power[i][k] * power[k][j]).sum()));
    }
    let largest = (0..D).map(|i| power[i][i]).sum::<f64>().powf(1.0 / 16.0);
    trace * largest.clamp(0.5, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_springs_do_along_one_way_is_their_sum_and_all_around_half_of_it() {
        let star = |angles: &[f64]| {
            angles.iter().map(|&angle| (3.0, [libm::cos(angle), libm::sin(angle)])).collect::<Vec<_>>()
        };
        let third = std::f64::consts::FRAC_PI_3;
        for (angles, expected) in [
            (vec![0.0], 3.0),
            (vec![0.3, 0.3 + 3.0 * third], 6.0),
            ((0..6).map(|k| 0.1 + f64::from(k) * third).collect(), 9.0),
            (vec![0.0, third], 4.5),
        ] {
            let found = most_along(star(&angles).into_iter());
            assert!((1.0..1.05).contains(&(found / expected)), "{found}, {expected} expected");
        }
        assert!(
            (1.0..1.08).contains(&(most_along([(2.0, [f64::NAN; 3])].into_iter()) / 3.0)),
            "half of what has no direction"
        );
        assert_eq!(most_along([(0.0, [1.0, 0.0])].into_iter()), 0.0);
        assert!(most_along([(1e300, [1.0, 0.0])].into_iter()) > 9e299);
    }
}
