//! Boxes and triangles of the plane: what they have in common, and what lies in them. A box is its lower and its upper corner.

use glam::DVec2;

/// The box around places; `None` of nothing.
pub(super) fn around(places: impl Iterator<Item = DVec2>) -> Option<[DVec2; 2]> {
    places.fold(None, |around: Option<[DVec2; 2]>, at| {
        Some(around.map_or([at; 2], |[low, high]| [low.min(at), high.max(at)]))
    })
}

/// Whether two boxes have a place in common, be it on their sides alone.
pub(in crate::app) fn touch([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    a.cmple(d).all() && c.cmple(b).all()
}

/// Whether two boxes have more in common than a side.
pub(super) fn overlap([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    a.cmplt(d).all() && c.cmplt(b).all()
}

/// Whether a place lies in a triangle, or on its sides.
pub(super) fn is_in(corners: [DVec2; 3], at: DVec2) -> bool {
    let sides = turns(corners, at);
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

/// Whether a place lies in a triangle, and not on its sides.
pub(super) fn is_within(corners @ [a, b, c]: [DVec2; 3], at: DVec2) -> bool {
    let least = 1e-9 * (b - a).perp_dot(c - a).abs();
    let sides = turns(corners, at);
    sides.iter().all(|side| *side > least) || sides.iter().all(|side| *side < -least)
}

/// On which side of each side of a triangle a place lies, as twice the area between them.
fn turns([a, b, c]: [DVec2; 3], at: DVec2) -> [f64; 3] {
    [(b - a).perp_dot(at - a), (c - b).perp_dot(at - b), (a - c).perp_dot(at - c)]
}
