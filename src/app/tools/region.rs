//! The region that a drag beside all bodies selects: a box from corner to corner, or what a free stroke goes around.

use glam::DVec2;

use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::is_inside;

/// A stroke gets a corner so far from its last one `[logical px]`.
const STEP: f64 = 3.0;

/// A region that is being drawn `[px]`.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Region {
    /// From this corner.
    Box(DVec2),
    /// What the stroke goes around, from its last place straight back to its first.
    Lasso(Vec<DVec2>),
}

impl Region {
    /// It begins at a pixel.
    pub(super) fn begin(at: DVec2, is_lasso: bool) -> Self {
        if is_lasso { Region::Lasso(vec![at]) } else { Region::Box(at) }
    }

    /// Where it began.
    pub(super) fn from(&self) -> DVec2 {
        match self {
            Region::Box(from) => *from,
            Region::Lasso(stroke) => stroke.first().copied().unwrap_or_default(),
        }
    }

    /// The pointer goes on to a pixel.
    pub(super) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        if let Region::Lasso(stroke) = self
            && stroke.last().is_none_or(|last| last.distance(at) >= STEP * scope.scale)
        {
            stroke.push(at);
        }
    }

    /// How far it reaches from where it began to a pixel, and on the way there `[px]`.
    pub(super) fn reach(&self, to: DVec2) -> f64 {
        let from = self.from();
        let on_the_way = match self {
            Region::Box(_) => &[][..],
            Region::Lasso(stroke) => stroke,
        };
        on_the_way.iter().map(|at| at.distance(from)).fold(to.distance(from), f64::max)
    }

    /// Whether a pixel lies in it, where it ends at `to`.
    pub(super) fn has(&self, to: DVec2, at: DVec2) -> bool {
        match self {
            Region::Box(from) => {
                let (low, high) = (from.min(to), from.max(to));
                low.cmple(at).all() && at.cmple(high).all()
            }
            Region::Lasso(stroke) => {
                let corners: Vec<[f64; 2]> = stroke.iter().chain([&to]).map(|corner| corner.to_array()).collect();
                is_inside(&[corners], at.to_array())
            }
        }
    }

    /// Its edge, where it ends at `to`.
    pub(super) fn marks(&self, scope: Scope<'_>, to: DVec2) -> Vec<Mark> {
        let corners = match self {
            Region::Box(from) => vec![*from, DVec2::new(to.x, from.y), to, DVec2::new(from.x, to.y)],
            Region::Lasso(stroke) => stroke.iter().copied().chain([to]).collect(),
        };
        let side = |k: usize| {
            let (from, to) = (corners[k], corners[(k + 1) % corners.len()]);
            Mark::Line(Role::Lead, from, to, 1.2 * scope.scale)
        };
        (0..corners.len()).map(side).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_what_lies_between_its_corners_and_a_stroke_what_it_goes_around() {
        let [from, to] = [DVec2::new(10.0, 80.0), DVec2::new(50.0, 20.0)];
        let drawn = Region::begin(from, false);
        assert!(drawn.has(to, DVec2::new(30.0, 50.0)) && !drawn.has(to, DVec2::new(60.0, 50.0)));
        assert_eq!((drawn.from(), drawn.reach(to)), (from, from.distance(to)));
        // A hook about the upper left: what lies in its bay is outside.
        let hook = [[0.0, 0.0], [100.0, 0.0], [100.0, 30.0], [30.0, 30.0], [30.0, 100.0]];
        let hook = Region::Lasso(hook.map(DVec2::from).to_vec());
        let end = DVec2::new(0.0, 100.0);
        assert!(hook.has(end, DVec2::new(15.0, 70.0)) && hook.has(end, DVec2::new(70.0, 15.0)));
        assert!(!hook.has(end, DVec2::new(70.0, 70.0)), "in its box, not in it");
        assert!(hook.reach(DVec2::ZERO) > 100.0, "it ends where it began and is no click");
    }
}
