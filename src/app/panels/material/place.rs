//! Where the panel of what is selected stands.

use egui::{Pos2, Rect, Vec2, pos2};

/// What is selected is covered by what lies so near to it `[points]`: lines have no area of their own.
const ROOM: f32 = 4.0;
/// Beside the tools it covers at most so much of what it would cover at the right edge, to go there `[1]`.
const LESS: f32 = 0.5;

/// Where the panel of what is selected stands: it is found once for a selection, and anew when its room at the right edge gets another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct MatterAt {
    /// Beside the tools: at the right edge it would cover what is selected.
    pub(super) is_left: bool,
    /// Where it was dragged to, its left upper corner `[points]`.
    dragged: Option<Pos2>,
    /// It lies there: where it would cover what is selected it goes to a side.
    is_aside: bool,
    /// Where that room ended when it was found `[points]`; `None`: not yet.
    room: Option<f32>,
}

impl MatterAt {
    /// Something else is selected.
    pub(in crate::app) fn begin(&mut self) {
        self.room = None;
    }

    /// Whether it lies where somebody dragged it to, be that over bodies.
    pub(in crate::app) fn is_dragged(self) -> bool {
        self.is_aside
    }

    /// Where it goes: to where it was dragged to, or of `sides` to the right edge, unless it covers what is selected there and at most
    /// half as much of it at the left; where nothing is selected, unless other panels push it off that edge. Where the window is upright, higher than
    /// wide, the right edge is the only side.
    pub(super) fn find(
        &mut self,
        (room, tools_end): (Rect, f32),
        [right, left]: [Rect; 2],
        (chosen, is_pushed, is_upright): (Option<Rect>, bool, bool),
    ) {
        if self.room == Some(room.right()) {
            return;
        }
        let covered = |side: Rect| {
            let seen = chosen.map(|chosen| chosen.expand(ROOM)).filter(|seen| seen.intersects(side));
            seen.map_or(0.0, |seen| seen.intersect(side).area())
        };
        let aside = self.dragged.map(|corner| kept(corner, right.size(), (room, tools_end)));
        let at_sides = if is_upright { covered(right) } else { covered(right).min(covered(left)) };
        self.is_aside = aside.is_some_and(|aside| covered(aside) <= at_sides);
        // What covers nothing stays.
        let is_less = covered(right) > 0.0 && covered(left) <= LESS * covered(right);
        self.is_left = !is_upright && if chosen.is_some() { is_less } else { is_pushed };
        self.room = Some(room.right());
    }

    /// Its left upper corner where it was dragged to, of a panel that is at most so large, in a room beside where the tools end `[points]`;
    /// `None`: it stands at a side.
    pub(super) fn corner(self, size: Vec2, room: (Rect, f32)) -> Option<Pos2> {
        let corner = self.dragged.filter(|_| self.is_aside)?;
        Some(kept(corner, size, room).min)
    }

    /// It is dragged to a left upper corner `[points]`.
    pub(super) fn drag_to(&mut self, corner: Pos2) {
        (self.dragged, self.is_aside) = (Some(corner), true);
    }

    /// It goes back to the side that it came from.
    pub(super) fn put_back(&mut self) {
        (self.dragged, self.is_aside) = (None, false);
    }
}

/// Least height of the panel where it is dragged to `[points]`.
const LEAST: f32 = 160.0;

/// A panel that is dragged to a corner, as it lies in a room beside the tools: as high as there is room below it.
fn kept(corner: Pos2, size: Vec2, (room, tools_end): (Rect, f32)) -> Rect {
    let least = pos2(tools_end.min(room.right() - size.x), room.top());
    let most = pos2(room.right() - size.x, (room.bottom() - LEAST).max(room.top()));
    let corner = corner.clamp(least, most);
    Rect::from_min_max(corner, pos2(corner.x + size.x, room.bottom().min(corner.y + size.y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    const ROOM_OF_ALL: (Rect, f32) = (Rect { min: pos2(0.0, 50.0), max: pos2(1280.0, 650.0) }, 80.0);

    fn sides() -> [Rect; 2] {
        let at = |x: f32| Rect::from_min_size(pos2(x, 50.0), vec2(240.0, 600.0));
        [at(1040.0), at(80.0)]
    }

    /// Where it is found for something that is selected in a place.
    fn found(at: &mut MatterAt, chosen: Rect) -> (bool, Option<Pos2>) {
        at.begin();
        at.find(ROOM_OF_ALL, sides(), (Some(chosen), false, false));
        (at.is_left, at.corner(sides()[0].size(), ROOM_OF_ALL))
    }

    #[test]
    fn it_goes_where_it_covers_at_most_half_as_much_of_what_is_selected() {
        let mut at = MatterAt::default();
        let along = |from: f32, to: f32| Rect::from_min_max(pos2(from, 300.0), pos2(to, 300.0));
        assert_eq!(found(&mut at, along(500.0, 700.0)), (false, None));
        assert_eq!(found(&mut at, along(500.0, 1200.0)), (true, None), "a rod ends below the right edge");
        assert_eq!(found(&mut at, along(0.0, 1280.0)), (false, None), "it lies everywhere");
        assert_eq!(found(&mut at, along(290.0, 1270.0)), (true, None), "at most half as much of it lies at the left");
    }

    #[test]
    fn in_an_upright_window_it_stays_at_the_right_edge() {
        let mut at = MatterAt::default();
        let right = Rect::from_center_size(pos2(1200.0, 300.0), vec2(60.0, 60.0));
        for (chosen, is_pushed) in [(Some(right), false), (None, true)] {
            at.begin();
            at.find(ROOM_OF_ALL, sides(), (chosen, is_pushed, true));
            assert!(!at.is_left, "{is_pushed}");
        }
    }

    #[test]
    fn it_lies_where_it_was_dragged_to_until_something_is_selected_there() {
        let mut at = MatterAt::default();
        let middle = Rect::from_center_size(pos2(640.0, 300.0), vec2(60.0, 60.0));
        let low = Rect::from_center_size(pos2(1200.0, 600.0), vec2(60.0, 60.0));
        found(&mut at, middle);
        at.drag_to(pos2(500.0, 90.0));
        assert!(at.is_dragged());
        at.find(ROOM_OF_ALL, sides(), (Some(middle), false, false));
        assert!(at.is_dragged(), "it stays while that is selected");
        assert_eq!(found(&mut at, low), (true, Some(pos2(500.0, 90.0))));
        assert_eq!(found(&mut at, middle), (false, None), "it makes way for what is selected below it");
        assert_eq!(found(&mut at, low).1, Some(pos2(500.0, 90.0)), "and comes back");
        // Where windows are upright it makes way too, to the right edge.
        at.begin();
        at.find(ROOM_OF_ALL, sides(), (Some(middle), false, true));
        assert!(!at.is_dragged() && !at.is_left);
        at.put_back();
        assert_eq!(found(&mut at, middle), (false, None));
        at.drag_to(pos2(-300.0, 900.0));
        assert_eq!(found(&mut at, middle).1, Some(pos2(80.0, 650.0 - LEAST)), "within its room, beside the tools");
    }
}
