//! Hinges that are there: their hubs, and the pieces of a body that turn about them.

use glam::{DVec2, DVec3};

use super::pick::Scope;
use crate::app::matter::{Adjacency, is_broad};
use crate::sim::{Angle, AngleDrive, PointId};

/// A hinge that is there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hub {
    pub(super) point: PointId,
    /// The points that it is bonded to, of each piece that turns about it; the one with the most of them first.
    pub(super) sides: Vec<Vec<PointId>>,
    /// It is pinned to the background.
    pub(super) is_pinned: bool,
    /// The motors that turn it.
    pub(super) motors: Vec<Angle>,
}

impl Hub {
    /// The most torque of its motors together `[N m]`.
    pub(super) fn torque(&self) -> f64 {
        let of = |angle: &Angle| match angle.drive {
            Some(AngleDrive::Motor { torque, .. }) => torque,
            _ => 0.0,
        };
        self.motors.iter().map(of).sum()
    }

    /// Whether a motor of it pushes against a point.
    pub(super) fn pushes_against(&self, point: PointId) -> bool {
        self.motors.iter().any(|angle| angle.points[0] == point)
    }

    /// The props of its motors alone.
    pub(super) fn motor_props(&self, scope: Scope<'_>) -> Vec<PointId> {
        props_of(scope, self.point).into_iter().filter(|prop| self.pushes_against(*prop)).collect()
    }
}

/// The props of the motors and stops about a point, ascending: pins that hold nothing else.
pub(super) fn props_of(scope: Scope<'_>, hub: PointId) -> Vec<PointId> {
    let scenery = &scope.shown.scenery;
    if scenery.props.is_empty() {
        return Vec::new();
    }
    let about = scenery.angles.iter().filter(|angle| angle.points[1] == hub).map(|angle| angle.points[0]);
    let mut props: Vec<PointId> = about.filter(|point| scenery.props.binary_search(point).is_ok()).collect();
    props.sort_unstable();
    props.dedup();
    props
}

/// Points, which are ascending, with the props of what turns about one of them.
pub(super) fn with_props(scope: Scope<'_>, mut points: Vec<PointId>) -> Vec<PointId> {
    let scenery = &scope.shown.scenery;
    if scenery.props.is_empty() {
        return points;
    }
    let has = |point: PointId| points.binary_search(&point).is_ok();
    let props = scenery.angles.iter().filter(|angle| has(angle.points[1])).map(|angle| angle.points[0]);
    let props: Vec<PointId> = props.filter(|point| scenery.props.binary_search(point).is_ok()).collect();
    points.extend(props);
    points.sort_unstable();
    points.dedup();
    points
}

/// Whether a point is the hub of a hinge, or a prop of one.
pub(super) fn is_hinged(scope: Scope<'_>, point: PointId) -> bool {
    let hubs = Hubs::of(scope, point);
    let is_of =
        |hub: &Hub| hub.point == point || hub.pushes_against(point) || props_of(scope, hub.point).contains(&point);
    hubs.all.iter().any(is_of)
}

/// The hubs of the body that a point belongs to.
pub(super) struct Hubs<'a> {
    scope: Scope<'a>,
    adjacency: Adjacency,
    pub(super) body: Vec<PointId>,
    pub(super) all: Vec<Hub>,
}

impl<'a> Hubs<'a> {
    pub(super) fn of(scope: Scope<'a>, point: PointId) -> Self {
        let scenery = &scope.shown.scenery;
        let bonds = scenery.bonds.ends().iter().copied();
        let adjacency = Adjacency::of(scope.shown.point_count(), bonds, &scenery.triangles);
        let mut hubs = Hubs { scope, adjacency, body: scope.body(point), all: Vec::new() };
        // A pin may hold what hangs on it by two bonds.
        let loose = hubs.adjacency.loose(hubs.body.iter().copied(), 2);
        hubs.all = loose.into_iter().filter_map(|point| hubs.hub(point)).collect();
        hubs
    }

    /// What a point is the hub of: pieces that no short way joins but through it, or what a pin beside a body holds.
    fn hub(&self, point: PointId) -> Option<Hub> {
        let mut sides = self.adjacency.sides(point);
        sides.sort_by_key(|side| std::cmp::Reverse(side.len()));
        let is_motor =
            |angle: &&Angle| angle.points[1] == point && matches!(angle.drive, Some(AngleDrive::Motor { .. }));
        let motors: Vec<Angle> = self.scope.shown.scenery.angles.iter().filter(is_motor).copied().collect();
        let is_pinned = self.scope.is_pinned(point);
        let is_beside_a_body = self.adjacency.neighbours(point).iter().all(|end| self.adjacency.is_covered(*end));
        let broad = sides.iter().filter(|side| is_broad(side)).count();
        let is_hub = broad > 1 || !motors.is_empty() || (is_pinned && broad > 0 && is_beside_a_body);
        is_hub.then_some(Hub { point, sides, is_pinned, motors })
    }

    /// The hub of a point that is one.
    pub(super) fn at(&self, point: PointId) -> Option<&Hub> {
        self.all.iter().find(|hub| hub.point == point)
    }

    /// The hub that stands within so far of a place `[m]`, nearest first.
    pub(super) fn near(&self, at: DVec2, most: f64) -> Option<&Hub> {
        let far = |hub: &Hub| DVec3::from(self.scope.shown.place(hub.point.index())).truncate().distance(at);
        let near = self.all.iter().filter(|hub| far(hub) <= most);
        near.min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// The hub about which two pieces turn already, each ascending.
    pub(super) fn between(&self, one: &[PointId], other: &[PointId]) -> Option<&Hub> {
        let holds = |hub: &&Hub, piece: &[PointId]| {
            hub.sides.iter().any(|side| is_broad(side) && piece.binary_search(&side[0]).is_ok())
        };
        self.all.iter().find(|hub| holds(hub, one) && holds(hub, other))
    }

    /// The points that hang together with one without going through hubs, ascending: what turns as a whole.
    pub(super) fn piece(&self, point: PointId) -> Vec<PointId> {
        let mut is_seen = vec![false; self.scope.shown.point_count()];
        let mut piece = vec![point];
        is_seen[point.index()] = true;
        self.all.iter().for_each(|hub| is_seen[hub.point.index()] = true);
        let mut next = 0;
        while let Some(from) = piece.get(next).copied() {
            next += 1;
            for &to in self.adjacency.neighbours(from) {
                if !std::mem::replace(&mut is_seen[to.index()], true) {
                    piece.push(to);
                }
            }
        }
        piece.sort_unstable();
        piece
    }
}
