//! Bonds, angles and obstacles of a world as keys.

use crate::scene::{
    AngleKeys, BondKeys, BoxKeys, CircleKeys, KindName, LimitName, ObstacleKeys, PenaltyKeys, PlaneKeys, RotationKeys,
    Row, Vector,
};
use crate::sim::{Angle, Bond, BondKind, Convex, Figure, Limit, Obstacle, PointId};

/// A bond between other points.
pub(super) fn bond_keys(bond: Bond, a: u32, b: u32) -> BondKeys {
    let keys = BondKeys { rest: Some(bond.rest_length), ..BondKeys::new(a, b) };
    let keys = match bond.kind {
        BondKind::Rigid => BondKeys { kind: Some(KindName::Rigid), ..keys },
        BondKind::Spring { stiffness, damping } => {
            BondKeys { kind: Some(KindName::Spring), stiffness: Some(stiffness), damping: Some(damping), ..keys }
        }
        BondKind::Relaxed { relaxation, max_correction } => BondKeys {
            kind: Some(KindName::Relaxed),
            relaxation: Some(relaxation),
            max_correction: max_correction.is_finite().then_some(max_correction),
            ..keys
        },
    };
    let limit = match bond.limit {
        Limit::Both => None,
        Limit::Max => Some(LimitName::Max),
        Limit::Min => Some(LimitName::Min),
    };
    let drive = bond.drive.map(Into::into);
    BondKeys { drive, break_strain: bond.break_strain.is_finite().then_some(bond.break_strain), limit, ..keys }
}

/// An angle between other points; `None` where one of its own is not among them.
pub(super) fn angle_keys(angle: &Angle, place: impl Fn(PointId) -> Option<u32>) -> Option<AngleKeys> {
    let [i, j, k] = angle.points.map(place);
    let above_0 = |x: f64| (x > 0.0).then_some(x);
    Some(AngleKeys {
        points: Row([i?, j?, k?]),
        rest: Some(angle.rest),
        stiffness: above_0(angle.stiffness),
        damping: above_0(angle.damping),
        min: angle.range.map(|[least, _]| least),
        max: angle.range.map(|[_, most]| most),
        drive: angle.drive.map(Into::into),
    })
}

/// An obstacle as keys have it.
pub(super) fn solid(obstacle: &Obstacle, dimensions: usize) -> ObstacleKeys {
    let vector = |x: [f64; 3]| Vector::new(x, dimensions);
    let (keys, restitution, friction) = match obstacle {
        Obstacle::Plane { point, normal, restitution, friction, penalty } => {
            let plane = Some(PlaneKeys { point: vector(*point), normal: vector(*normal) });
            let penalty = penalty.map(PenaltyKeys::from);
            (ObstacleKeys { plane, penalty, ..ObstacleKeys::default() }, restitution, friction)
        }
        Obstacle::Polygon(polygon) => {
            let corners = |corners: &Vec<[f64; 2]>| corners.iter().map(|&corner| Vector::Plane(corner)).collect();
            let polygon_keys = Some(polygon.loops.iter().map(corners).collect());
            let keys = ObstacleKeys { polygon: polygon_keys, ..ObstacleKeys::default() };
            (keys, &polygon.restitution, &polygon.friction)
        }
        Obstacle::Convex(Convex { figure, restitution, friction }) => (figure_keys(figure), restitution, friction),
    };
    ObstacleKeys { restitution: Some(*restitution), friction: Some(*friction), ..keys }
}

/// A ball or a box of space.
fn figure_keys(figure: &Figure) -> ObstacleKeys {
    match *figure {
        Figure::Ball { center, radius } => ObstacleKeys {
            circle: Some(CircleKeys { center: Vector::Space(center), radius }),
            ..ObstacleKeys::default()
        },
        Figure::Box { min, max, axis, angle } => ObstacleKeys {
            r#box: Some(BoxKeys {
                min: Vector::Space(min),
                max: Vector::Space(max),
                angle: None,
                rotation: Some(RotationKeys { axis: Vector::Space(axis), angle }),
            }),
            ..ObstacleKeys::default()
        },
    }
}
