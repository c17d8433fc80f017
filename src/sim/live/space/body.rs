//! Bodies in space: each one's points, bonds and skin, one after the other.

use crate::sim::bond::{Bond, Lengths, PointId, lower_first};
use crate::sim::contact::skin::RADIUS;
use crate::sim::live::Draft;
use crate::sim::live::body::{Link, Span};
use crate::sim::live::build::{Bounds, in_turn, is_spring, link, path_of};
use crate::sim::live::gather::MOST_SUBSTEPS;
use crate::sim::live::strap::{Strap, straps};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{cross3, dot, length, sub};

/// Largest share of its thinnest triangle's height that a skin keeps from itself: neighbours would press each other.
const FROM_ITSELF: f64 = 0.5;

/// One body. Its points are numbered within it.
#[derive(Clone, Debug)]
pub(super) struct Body<S> {
    pub(super) points: Span,
    pub(super) springs: Span,
    pub(super) holds: Span,
    pub(super) triangles: Span,
    pub(super) edges: Span,
    pub(super) corners: Span,
    /// Its rigid bonds make one open path: their order is that of the path.
    pub(super) is_path: bool,
    /// Mean length of the edges of its skin at the start `[m]`; 0 without any.
    pub(super) edge_length: S,
    /// Distance that its skin keeps from others, and from itself `[m]`.
    pub(super) radius: S,
    pub(super) own_distance: S,
    /// Pins of it that its rigid bonds keep near each other, where some are led.
    pub(super) straps: Vec<Strap<S>>,
    /// Bounds on the square of the fastest oscillation of its springs `[1/s^2]` and on the fastest decay by their dampers `[1/s]`.
    pub(super) swing: [S; 2],
    /// Substeps of a frame in which all its springs may be forces, and exact ones; 0: no number of them.
    pub(super) least_substeps: [u32; 2],
}

/// All bodies of a group.
#[derive(Clone, Debug, Default)]
pub(super) struct Bodies<S> {
    pub(super) list: Vec<Body<S>>,
    /// Places of points in the group, body by body.
    pub(super) order: Vec<u32>,
    /// Bonds that may be forces.
    pub(super) springs: Vec<Link<S>>,
    /// Bonds that are held whatever the substep.
    pub(super) holds: Vec<Link<S>>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The longest side of each at rest `[m]`.
    pub(super) sizes: Vec<S>,
    /// Sides of triangles, and bonds at points of none.
    pub(super) edges: Vec<[u32; 2]>,
    /// Points of skins.
    pub(super) corners: Vec<u32>,
}

/// What is of one body, points numbered as in the group.
#[derive(Clone, Debug, Default)]
struct Own {
    points: Vec<u32>,
    bonds: Vec<Bond>,
    triangles: Vec<[u32; 3]>,
}

impl<S: Real> Bodies<S> {
    pub(super) fn new(draft: &Draft<S>, points: &Points<S, 3>) -> Self {
        let mut bodies = Bodies::default();
        let count = draft.body_of.iter().map(|&body| body as usize + 1).max().unwrap_or(0);
        let mut own = vec![Own::default(); count];
        let mut local = vec![0; points.len()];
        for (i, &body) in draft.body_of.iter().enumerate() {
            local[i] = own[body as usize].points.len() as u32;
            own[body as usize].points.push(i as u32);
        }
        for bond in &draft.bonds {
            own[draft.body_of[bond.a.index()] as usize].bonds.push(*bond);
        }
        for (corners, _) in &draft.triangles {
            let [a, b, c] = corners.map(|corner| draft.body_of[corner as usize]);
            let [p, q, r] = corners.map(|corner| points.position[corner as usize]);
            let normal = cross3(sub(q, p), sub(r, p));
            if a == b && b == c && dot(normal, normal) > S::ZERO {
                own[a as usize].triangles.push(*corners);
            }
        }
        own.into_iter().for_each(|own| bodies.push(own, &local, points, draft));
        bodies
    }

    fn push(&mut self, own: Own, local: &[u32], points: &Points<S, 3>, draft: &Draft<S>) {
        let contact = draft.contact.as_ref();
        let is_pinned = |i: u32| points.inverse_mass[i as usize] == S::ZERO;
        let straps = straps(&own.bonds, (&own.points, local), &draft.led, is_pinned);
        let starts = self.ends();
        let (path, others): (Vec<Bond>, Vec<Bond>) = match path_of(&own.bonds) {
            Some(path) => (path, own.bonds.iter().copied().filter(|bond| !bond.is_held()).collect()),
            None => (Vec::new(), own.bonds.clone()),
        };
        self.holds.extend(path.iter().map(|bond| link(bond, local, draft.sweeps)));
        let (springs, holds): (Vec<&Bond>, Vec<&Bond>) = others.iter().partition(|bond| is_spring(bond));
        let [springs, holds] = [springs, holds].map(|list| in_turn(list, local, own.points.len()));
        self.springs.extend(springs.iter().map(|bond| link(bond, local, draft.sweeps)));
        self.holds.extend(holds.iter().map(|bond| link(bond, local, draft.sweeps)));
        let edges = edges(&own);
        let mut corners: Vec<u32> = edges.iter().flatten().copied().collect();
        if corners.is_empty() {
            corners.extend(&own.points);
        }
        corners.sort_unstable();
        corners.dedup();
        let place = |i: u32| points.position[i as usize];
        let total = edges.iter().fold(S::ZERO, |sum, &[a, b]| sum + length(sub(place(a), place(b))));
        let edge_length = if edges.is_empty() { S::ZERO } else { total / S::from_f64(edges.len() as f64) };
        let radius = contact.and_then(|contact| contact.radius);
        let radius = radius.map_or(edge_length * S::from_f64(RADIUS), S::from_f64);
        let thin = own.triangles.iter().map(|corners| height(corners.map(place)));
        let most = thin.fold(edge_length, S::min) * S::from_f64(FROM_ITSELF);
        let lengths = Lengths::of(own.bonds.iter().map(|bond| ([bond.a, bond.b], bond.rest_length)));
        let size = |&[a, b, c]: &[u32; 3]| {
            let now = |[p, q]: [u32; 2]| length(sub(place(p), place(q)));
            let side = |ends: [u32; 2]| lengths.between(ends.map(PointId)).map_or_else(|| now(ends), S::from_f64);
            side([a, b]).max(side([b, c])).max(side([c, a]))
        };
        self.sizes.extend(own.triangles.iter().map(size));
        let within = |i: u32| local[i as usize];
        self.triangles.extend(own.triangles.iter().map(|corners| corners.map(within)));
        self.edges.extend(edges.iter().map(|ends| ends.map(within)));
        self.corners.extend(corners.into_iter().map(within));
        self.order.extend(&own.points);
        let ends = self.ends();
        let span = |k: usize| Span { first: starts[k], end: ends[k] };
        let bounds = Bounds::new(&springs, (place, |i| points.inverse_mass[i as usize]));
        self.list.push(Body {
            points: span(0),
            springs: span(1),
            holds: span(2),
            triangles: span(3),
            edges: span(4),
            corners: span(5),
            is_path: !path.is_empty(),
            edge_length,
            radius,
            own_distance: (radius + radius).min(most),
            straps,
            swing: bounds.most().map(S::from_f64),
            least_substeps: bounds.substeps([1.0, 1.0], MOST_SUBSTEPS),
        });
    }

    fn ends(&self) -> [u32; 6] {
        let lengths = [self.order.len(), self.springs.len(), self.holds.len(), self.triangles.len()];
        let [points, springs, holds, triangles] = lengths.map(|count| count as u32);
        [points, springs, holds, triangles, self.edges.len() as u32, self.corners.len() as u32]
    }

    pub(super) fn springs(&self, body: &Body<S>) -> &[Link<S>] {
        &self.springs[body.springs.range()]
    }

    pub(super) fn holds(&self, body: &Body<S>) -> &[Link<S>] {
        &self.holds[body.holds.range()]
    }
}

/// The least height of a triangle `[m]`.
fn height<S: Real>([a, b, c]: [[S; 3]; 3]) -> S {
    let normal = cross3(sub(b, a), sub(c, a));
    let longest = [sub(b, a), sub(c, b), sub(a, c)].map(|side| dot(side, side)).into_iter().fold(S::ZERO, S::max);
    (dot(normal, normal) / longest).sqrt()
}

/// Sides of triangles, once each, and bonds at points of no triangle.
fn edges(own: &Own) -> Vec<[u32; 2]> {
    let mut covered: Vec<u32> = own.triangles.iter().flatten().copied().collect();
    covered.sort_unstable();
    covered.dedup();
    let is_covered = |point: u32| covered.binary_search(&point).is_ok();
    let sides = own.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let open = own.bonds.iter().map(|bond| [bond.a.0, bond.b.0]);
    let open = open.filter(|[a, b]| !(is_covered(*a) && is_covered(*b)));
    let mut edges: Vec<[u32; 2]> = sides.chain(open).map(lower_first).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}
