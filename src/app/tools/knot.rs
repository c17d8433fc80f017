//! Loose ends of ropes: a body that is drawn over one, or up to one, is tied to it, and one that the hand lets go on a body is tied to that. A
//! body that is drawn from or to a pin, or a point of a rope, is tied to that.

use glam::DVec2;

use super::Deed;
use super::areas::is_in;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::room::here;
use super::segments::distance_to_segment;
use super::skin;
use crate::history::{DeleteKeys, Do};
use crate::scene::{AddKeys, BondKeys, KindName, LimitName, Shape};
use crate::sim::triangles::outer_sides;
use crate::sim::{Bond, BondKind, Limit, PointId};

/// Between an end that is dragged and the skin that it is tied to there is no more than this `[logical px]`.
const REACH: f64 = 24.0;
/// In space it is no deeper or less deep than so many times as much: who drags sees that least.
const DEEP: f64 = 3.0;
/// What tying is called when it is undone.
const TIE: &str = "tie a rope";
/// Said where the end of a rope is dragged onto a body.
const LET_GO: &str = "let go: it is tied here (not with Shift)";

/// An end of a rope this near to the outline of a body is tied to it, and so is a corner this near to a point that it is drawn from or to
/// `[logical px]`.
pub(super) const NEAR: f64 = 12.0;
/// Of longer ropes no more points are followed.
const MOST: usize = 200;
/// What lies no further from a point is welded to it `[m]`.
const AT_IT: f64 = 1e-6;

/// What becomes of a rope whose end a body is drawn over, or of a point that one is drawn from or to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Knot {
    /// What of it lies within the body and goes; none of a point that stays.
    gone: Vec<PointId>,
    /// The last of its points that stays, and how that was bonded to the next.
    from: PointId,
    bond: Bond,
    /// The point of the skin that it is tied to: its number in what comes, and where it is `[m]`.
    to: (u32, DVec2),
}

/// The bonds of each point.
struct Ends {
    at: Vec<Vec<u32>>,
}

impl Ends {
    fn of(scope: Scope<'_>) -> Self {
        let count = scope.shown.point_count();
        let mut at = vec![Vec::new(); count];
        for (place, ends) in scope.shown.scenery.bonds.ends().iter().enumerate() {
            ends.iter().filter(|end| end.index() < count).for_each(|end| at[end.index()].push(place as u32));
        }
        Ends { at }
    }

    /// Points that one bond hangs on a rope: no pins, and no part of what covers something.
    fn loose(&self, scope: Scope<'_>) -> Vec<PointId> {
        let mut is_part = vec![false; self.at.len()];
        for corner in scope.shown.scenery.triangles.iter().flatten() {
            if let Some(is_part) = is_part.get_mut(corner.index()) {
                *is_part = true;
            }
        }
        let is_loose = |point: &PointId| {
            self.at[point.index()].len() == 1
                && !is_part[point.index()]
                && !scope.is_pinned(*point)
                && scope.is_there(*point)
        };
        (0..self.at.len() as u32).map(PointId).filter(is_loose).collect()
    }
}

/// Whether a body can be tied to a point: to a pin, or a point of a rope or a net, but to no part of what covers something, which it may lie on.
pub(super) fn can_hold(scope: Scope<'_>, point: PointId) -> bool {
    let is_part = scope.shown.scenery.triangles.iter().any(|corners| corners.contains(&point));
    scope.is_there(point) && !is_part
}

/// Where the points of each rope with a loose end are `[m]`, from that on to what it hangs on, or where it branches.
pub(super) fn loose_ropes(scope: Scope<'_>) -> Vec<Vec<DVec2>> {
    let ends = Ends::of(scope);
    let pairs = scope.shown.scenery.bonds.ends();
    let rope = |end: PointId| {
        let mut points = vec![end];
        loop {
            let last = points[points.len() - 1];
            let beside = ends.at[last.index()].iter().filter_map(|&place| {
                let &[a, b] = pairs.get(place as usize)?;
                Some(if a == last { b } else { a })
            });
            let mut next = beside.filter(|point| !points.contains(point) && scope.is_there(*point));
            match (next.next(), next.next()) {
                (Some(point), None) if points.len() < MOST => points.push(point),
                _ => break points.into_iter().map(|point| here(scope, point)).collect(),
            }
        }
    };
    ends.loose(scope).into_iter().map(rope).collect()
}

/// A body that comes, as it takes hold of what it is drawn over.
struct Coming {
    /// Where its points will be `[m]`.
    places: Vec<DVec2>,
    triangles: Vec<[u32; 3]>,
    sides: Vec<[u32; 2]>,
    /// The points at its outline, ascending.
    rim: Vec<u32>,
}

impl Coming {
    /// What keys bring, once that is put `way` `[m]` out of obstacles; `None` of what covers nothing.
    fn of(scope: Scope<'_>, keys: &AddKeys, way: DVec2) -> Option<Self> {
        let Shape { places, triangles, .. } = keys.shape(scope.shown.point_count() as u32)?;
        if triangles.is_empty() {
            return None;
        }
        let places = places.into_iter().map(|at| DVec2::from(at) + way).collect();
        let sides: Vec<[u32; 2]> = outer_sides(triangles.iter().copied()).into_iter().map(|side| side.ends).collect();
        let mut rim: Vec<u32> = sides.iter().flatten().copied().collect();
        rim.sort_unstable();
        rim.dedup();
        Some(Coming { places, triangles, sides, rim })
    }

    fn at(&self, point: u32) -> DVec2 {
        self.places.get(point as usize).copied().unwrap_or(DVec2::NAN)
    }

    fn covers(&self, place: DVec2) -> bool {
        self.triangles.iter().any(|corners| is_in(corners.map(|corner| self.at(corner)), place))
    }

    /// Whether its outline is so near to a place `[m]`.
    fn is_beside(&self, place: DVec2, near: f64) -> bool {
        self.sides.iter().any(|&[a, b]| distance_to_segment(place, self.at(a), self.at(b)) <= near)
    }

    /// A point that stays where it is, tied to the corner that is nearest to it, if one is so near `[m]`.
    fn held(&self, scope: Scope<'_>, point: PointId, near: f64) -> Option<Knot> {
        let place = here(scope, point);
        let far = |corner: u32| self.at(corner).distance(place);
        let to = self.rim.iter().copied().min_by(|&a, &b| far(a).total_cmp(&far(b))).filter(|&to| far(to) <= near)?;
        let bond = Bond { kind: BondKind::Rigid, ..Bond::new(point, point, far(to)) };
        Some(Knot { gone: Vec::new(), from: point, bond, to: (to, self.at(to)) })
    }

    /// The rope of a loose end, tied to the skin where it comes out; `None` where it branches, is held or ends within the body.
    fn tied(&self, scope: Scope<'_>, (ends, bonds): (&Ends, &[Bond]), end: PointId) -> Option<Knot> {
        let mut gone = Vec::new();
        let mut point = end;
        loop {
            // The end itself goes where it is at the outline only, too.
            if point != end && !self.covers(here(scope, point)) {
                break;
            }
            // What branches, or is held, within the body is no end of a rope.
            if scope.is_pinned(point) || ends.at[point.index()].len() > 2 {
                return None;
            }
            gone.push(point);
            let next = |&place: &u32| {
                let bond = bonds.get(place as usize)?;
                let other = if bond.a == point { bond.b } else { bond.a };
                (!gone.contains(&other)).then_some(other)
            };
            point = ends.at[point.index()].iter().find_map(next)?;
        }
        let last = *gone.last()?;
        let is_it = |bond: &&Bond| [bond.a, bond.b] == [point, last] || [bond.b, bond.a] == [point, last];
        let bond = *bonds.iter().find(is_it)?;
        // Where the rope meets the skin.
        let (from, into) = (here(scope, point), here(scope, last));
        let far = |corner: u32| distance_to_segment(self.at(corner), from, into);
        // A bond has a length.
        let to = self.rim.iter().copied().filter(|&corner| self.at(corner).distance(from) > 1e-9);
        let to = to.min_by(|&a, &b| far(a).total_cmp(&far(b)))?;
        Some(Knot { gone, from: point, bond, to: (to, self.at(to)) })
    }
}

/// The ropes whose loose ends lie in what keys bring, once that is put `way` `[m]` out of obstacles. Of what is drawn as a whole those at its outline
/// too, and the points that it is drawn from and to, `held`, that a corner of it is near to; `None`: it is drawn click by click, from points that
/// are there.
pub(super) fn knots(scope: Scope<'_>, keys: &AddKeys, (way, held): (DVec2, Option<&[PointId]>)) -> Vec<Knot> {
    let Some(body) = Coming::of(scope, keys, way) else { return Vec::new() };
    let near = NEAR * scope.scale / scope.camera.pixels_per_metre();
    let is_at = |place: DVec2| body.covers(place) || held.is_some() && body.is_beside(place, near);
    let ends = Ends::of(scope);
    let loose: Vec<PointId> = ends.loose(scope).into_iter().filter(|&end| is_at(here(scope, end))).collect();
    let held = held.unwrap_or_default().iter().filter(|point| !loose.contains(point));
    let mut held: Vec<PointId> = held.copied().collect();
    held.dedup();
    let mut knots: Vec<Knot> = held.into_iter().filter_map(|point| body.held(scope, point, near)).collect();
    if loose.is_empty() {
        return knots;
    }
    let bonds: Vec<Bond> = scope.shown.scenery.bonds.iter().collect();
    knots.extend(loose.into_iter().filter_map(|end| body.tied(scope, (&ends, &bonds), end)));
    knots
}

/// A bond as another one is, as long as it is when it comes.
fn like(bond: &Bond, a: u32, b: u32) -> BondKeys {
    let keys = BondKeys::new(a, b);
    let limit = match bond.limit {
        Limit::Both => None,
        Limit::Max => Some(LimitName::Max),
        Limit::Min => Some(LimitName::Min),
    };
    match bond.kind {
        BondKind::Spring { stiffness, damping } => {
            BondKeys { kind: Some(KindName::Spring), stiffness: Some(stiffness), damping: Some(damping), limit, ..keys }
        }
        _ => BondKeys { kind: Some(KindName::Rigid), limit, ..keys },
    }
}

/// What ties ropes to a body that comes with keys: bonds beside it, and what goes after it.
pub(super) fn tied(scope: Scope<'_>, mut keys: AddKeys, knots: &[Knot]) -> Vec<Do> {
    let first = scope.shown.point_count() as u32;
    keys.bonds.extend(knots.iter().map(|knot| {
        // What lies right on a point is one with it.
        let rest = (knot.gone.is_empty() && knot.bond.rest_length <= AT_IT).then_some(0.0);
        BondKeys { rest, ..like(&knot.bond, knot.from.0, first + knot.to.0) }
    }));
    let mut gone: Vec<u32> = knots.iter().flat_map(|knot| &knot.gone).map(|point| point.0).collect();
    gone.sort_unstable();
    let add = Do::Add(Box::new(keys));
    let delete = (!gone.is_empty()).then(|| Do::Delete(DeleteKeys { points: gone, ..DeleteKeys::default() }));
    std::iter::once(add).chain(delete).collect()
}

/// What is drawn of knots: the line to the skin, and a ring about what it is tied to.
pub(super) fn marks(scope: Scope<'_>, knots: &[Knot]) -> Vec<Mark> {
    let of = |knot: &Knot| {
        let (from, to) = (scope.pixel(knot.from)?, scope.on_screen(knot.to.1)?);
        Some([
            Mark::Line(Role::Hold, from, to, 1.5 * scope.scale),
            Mark::Ring(Role::Hold, to, 9.0 * scope.scale),
            Mark::Knob(Role::Hold, to, 4.0 * scope.scale),
        ])
    };
    knots.iter().filter_map(of).flatten().collect()
}

/// What is said of knots.
pub(super) fn words(scope: Scope<'_>, knots: &[Knot]) -> Option<String> {
    let (ropes, points): (Vec<&Knot>, Vec<&Knot>) = knots.iter().partition(|knot| !knot.gone.is_empty());
    let of_ropes = match ropes.len() {
        0 => None,
        1 => Some("the rope's end is tied to it".to_owned()),
        many => Some(format!("{many} ropes' ends are tied to it")),
    };
    let of_points = match points[..] {
        [] => None,
        [one] if scope.is_pinned(one.from) => Some("tied to the pin".to_owned()),
        [_] => Some("tied to the point".to_owned()),
        _ => Some(format!("tied to {} points", points.len())),
    };
    let all: Vec<String> = of_points.into_iter().chain(of_ropes).collect();
    (!all.is_empty()).then(|| all.join(", "))
}

/// The end of a rope among points that are led, and the point of the skin of another body that it would be tied to at a pixel.
fn dragged(scope: Scope<'_>, led: &[PointId], at: DVec2) -> Option<[PointId; 2]> {
    let [corner, ..] = scope.triangle(at)?;
    let body = scope.body(corner);
    let ends = Ends::of(scope);
    let end = ends.loose(scope).into_iter().find(|end| led.contains(end))?;
    if body.binary_search(&end).is_ok() {
        return None;
    }
    let deep = |point: PointId| scope.depth(scope.shown.place(point.index())) * scope.camera.pixels_per_metre();
    let (from, depth) = (scope.pixel(end)?, deep(end));
    let corners = skin::sides(scope, &body).into_iter().flatten();
    // In space it is the nearest that counts, not the one that is seen next to it far behind.
    let far = |point: PointId| {
        let (beside, behind) = (scope.pixel(point)?.distance(from), (deep(point) - depth).abs());
        let is_near = beside <= REACH * scope.scale && behind <= DEEP * REACH * scope.scale;
        is_near.then_some((beside.hypot(behind), point))
    };
    let (_, to) = corners.filter_map(far).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
    Some([end, to])
}

/// Where the end of a rope that is led would be tied to, drawn, with what is said of it.
pub(super) fn would_tie(scope: Scope<'_>, led: &[PointId], at: DVec2) -> Vec<Mark> {
    let Some([_, to]) = dragged(scope, led, at) else { return Vec::new() };
    let Some(place) = scope.pixel(to) else { return Vec::new() };
    vec![
        Mark::Ring(Role::Hold, place, 9.0 * scope.scale),
        Mark::Knob(Role::Hold, place, 4.0 * scope.scale),
        Mark::Words(at + DVec2::new(16.0, -14.0) * scope.scale, LET_GO.to_owned()),
    ]
}

/// What is led is let go at a pixel: the end of a rope is tied to the body that lies there, if one does.
pub(super) fn let_go(scope: Scope<'_>, led: &[PointId], at: DVec2) -> Option<Deed> {
    let [end, to] = dragged(scope, led, at)?;
    let own = scope.shown.scenery.bonds.iter().find(|bond| bond.a == end || bond.b == end);
    let bonds = own.iter().map(|own| like(own, end.0, to.0)).collect();
    let add = Do::Add(Box::new(AddKeys { bonds, ..AddKeys::default() }));
    let words = Some("tied: Ctrl+Z lets it loose".to_owned());
    Some(Deed { commands: vec![Do::Release, add], edit: Some(TIE), words, ..Deed::default() })
}
