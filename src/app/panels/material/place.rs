//! Where the panel of what is selected stands.

use egui::Rect;

/// Where the panel of what is selected stands: it is found once for a selection, and anew when its room at the right edge gets another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct MatterAt {
    /// Beside the tools: at the right edge it would cover what is selected.
    pub(super) is_left: bool,
    /// Where that room ended when it was found `[points]`; `None`: not yet.
    room: Option<f32>,
}

impl MatterAt {
    /// Where it goes, of `sides`: at the right edge, unless it covers what is selected there and not at the left; where nothing is selected,
    /// unless other panels push it off that edge.
    pub(super) fn find(&mut self, room: Rect, [right, left]: [Rect; 2], (chosen, is_pushed): (Option<Rect>, bool)) {
        if self.room != Some(room.right()) {
            let covers = |side: Rect| chosen.is_some_and(|chosen| side.intersects(chosen));
            let is_left = if chosen.is_some() { covers(right) && !covers(left) } else { is_pushed };
            *self = MatterAt { is_left, room: Some(room.right()) };
        }
    }
}
