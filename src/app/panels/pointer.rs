//! What a pointer does, for tests of panels.

use egui::{Event, Modifiers, PointerButton, Pos2};

/// The events of a click, a frame each: the pointer comes, presses, lets go.
pub(super) fn click(at: Pos2) -> [Vec<Event>; 3] {
    [vec![Event::PointerMoved(at)], vec![button(at, true)], vec![button(at, false)]]
}

/// The left button goes down or up.
pub(super) fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}
