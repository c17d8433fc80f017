//! A body that is drawn under the loose end of a rope, or over it: a point of its skin is right where the rope meets it, so that it hangs straight
//! down; near the middle of a box's side, that middle.

use glam::DVec2;

use super::fibre::BuiltOf;
use super::form::{Form, Round};
use super::grid::Grid;
use crate::app::tools::enclosed::Cover;
use crate::app::tools::knot::{NEAR, loose_ropes};
use crate::app::tools::pick::Scope;
use crate::app::tools::segments::distance_to_segment;
use crate::sim::triangles::outer_sides;

/// So near to the middle of a side, in that side, a rope means it `[1]`; and so near in any case `[logical px]`.
const MIDDLE: f64 = 0.12;
const SNAP: f64 = 12.0;
/// Halvings by which a rope's way into a body is cut at its skin.
const HALVINGS: u32 = 40;

/// What a form covers, and the sides of its outline.
struct Outlined {
    cover: Cover,
    sides: Vec<[DVec2; 2]>,
}

impl Outlined {
    fn of(form: &Form, built_of: BuiltOf) -> Option<Self> {
        let shape = form.keys(0, built_of).shape(0)?;
        let cover = Cover::of(&shape)?;
        let at = |corner: u32| shape.places.get(corner as usize).copied().map_or(DVec2::NAN, DVec2::from);
        let sides = outer_sides(shape.triangles.iter().copied()).into_iter().map(|side| side.ends.map(at)).collect();
        Some(Outlined { cover, sides })
    }

    fn gap(&self, place: DVec2) -> f64 {
        let far = |&[a, b]: &[DVec2; 2]| distance_to_segment(place, a, b);
        self.sides.iter().map(far).fold(f64::INFINITY, f64::min)
    }

    /// Where a rope, told from its loose end on, meets it: its end at the skin, or where it comes in; `None`: nowhere.
    fn met_by(&self, rope: &[DVec2], near: f64) -> Option<DVec2> {
        let end = *rope.first()?;
        if !self.cover.holds(end) {
            return (self.gap(end) <= near).then_some(end);
        }
        let outside = rope.iter().position(|place| !self.cover.holds(*place))?;
        let [mut inner, mut outer] = [rope[outside - 1], rope[outside]];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inner + outer);
            *(if self.cover.holds(middle) { &mut inner } else { &mut outer }) = middle;
        }
        Some(outer)
    }

    /// The point of the skin that is nearest to a place.
    fn nearest(&self, place: DVec2) -> Option<DVec2> {
        let rim = self.sides.iter().flatten().copied();
        rim.min_by(|a, b| a.distance(place).total_cmp(&b.distance(place)))
    }
}

impl Form {
    /// The same, built of this, where one rope's loose end meets it a little aside, so that a point of its skin is there.
    pub(super) fn hung(self, scope: Scope<'_>, of: BuiltOf) -> Self {
        if !matches!(self, Form::Box(_) | Form::Disc(_) | Form::Rim(_)) {
            return self;
        }
        let ropes = loose_ropes(scope);
        let metre = scope.camera.pixels_per_metre() / scope.scale;
        let meets = |form: &Form| {
            let outlined = Outlined::of(form, of)?;
            let mut met = ropes.iter().filter_map(|rope| outlined.met_by(rope, NEAR / metre));
            // What hangs on several ropes hangs as it is drawn.
            met.next().filter(|_| met.next().is_none()).map(|place| (place, outlined))
        };
        let Some((place, outlined)) = (!ropes.is_empty()).then(|| meets(&self)).flatten() else { return self };
        if let Form::Box(grid) = self {
            let (grid, node) = grid.under(place, SNAP / metre);
            return Form::Box(Grid { low: grid.low + place - node, ..grid });
        }
        let by = outlined.nearest(place).map_or(DVec2::ZERO, |node| place - node);
        let moved = |round: Round| Round { center: round.center + by, ..round };
        match self {
            Form::Disc(round) => Form::Disc(moved(round)),
            Form::Rim(round) => Form::Rim(moved(round)),
            other => other,
        }
    }
}

impl Grid {
    /// A point of its rim that is to hang at a place `[m]`, with the grid that has it: the nearest; the middle of the side where the place is no
    /// further than so far from that, for which it gets an even number of cells along that side.
    fn under(self, place: DVec2, near: f64) -> (Self, DVec2) {
        let (size, high) = (self.size(), self.low + self.size());
        let gaps = [place.y - high.y, place.y - self.low.y, place.x - self.low.x, place.x - high.x].map(f64::abs);
        let side = (0..4).min_by(|&a, &b| gaps[a].total_cmp(&gaps[b])).unwrap_or(0);
        let axis = usize::from(side > 1);
        let long = size[axis];
        let along = (place[axis] - self.low[axis]).clamp(0.0, long);
        if (along - 0.5 * long).abs() > near.max(MIDDLE * long) {
            let step = (along / self.spacing).round() * self.spacing;
            let mut node = [DVec2::new(0.0, high.y), self.low, self.low, DVec2::new(high.x, 0.0)][side];
            node[axis] = self.low[axis] + step;
            return (self, node);
        }
        let grid = if self.cells[axis].is_multiple_of(2) { self } else { self.with_even(axis, side) };
        let (size, high) = (grid.size(), grid.low + grid.size());
        let mut node = [DVec2::new(0.0, high.y), grid.low, grid.low, DVec2::new(high.x, 0.0)][side];
        node[axis] = grid.low[axis] + 0.5 * size[axis];
        (grid, node)
    }

    /// As wide along an axis, by one cell more; the side that is meant, of the upper, lower, left and right one, stays.
    fn with_even(self, axis: usize, side: usize) -> Self {
        let (size, high) = (self.size(), self.low + self.size());
        let mut cells = self.cells;
        cells[axis] += 1;
        let spacing = size[axis] / f64::from(cells[axis]);
        cells[1 - axis] = (size[1 - axis] / spacing).round().max(1.0) as u32;
        let mut low = self.low;
        if side == 0 || side == 3 {
            low[1 - axis] = high[1 - axis] - spacing * f64::from(cells[1 - axis]);
        }
        Grid { low, cells, spacing }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_side_gets_a_middle_and_keeps_its_place_and_its_length() {
        let grid = Grid { low: DVec2::new(1.0, 2.0), cells: [3, 3], spacing: 0.4 };
        let (even, node) = grid.under(DVec2::new(1.62, 3.25), 0.1);
        assert_eq!((even.cells, even.low.x), ([4, 4], 1.0));
        assert!((even.size() - grid.size()).length() < 1e-12 && (even.low - grid.low).length() < 1e-12);
        assert!((node - DVec2::new(1.6, 3.2)).length() < 1e-12, "{node}");
        let (same, node) = grid.under(DVec2::new(1.35, 3.25), 0.1);
        assert!(same == grid && (node - DVec2::new(1.4, 3.2)).length() < 1e-12, "{node}");
        // Of a side at the left, too.
        let (even, node) = grid.under(DVec2::new(0.97, 2.6), 0.1);
        assert_eq!((even.cells, node), ([4, 4], DVec2::new(1.0, 2.6)));
        let strip = Grid { low: DVec2::ZERO, cells: [5, 1], spacing: 0.2 };
        let (even, node) = strip.under(DVec2::new(0.52, 0.21), 0.1);
        assert!(even.cells[0] == 6 && (even.size().x - 1.0).abs() < 1e-12);
        assert!((node - DVec2::new(0.5, 0.2)).length() < 1e-12, "the upper side stays: {node}");
    }
}
