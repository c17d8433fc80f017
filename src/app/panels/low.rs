//! What is higher than a low window has room for: it can be scrolled.

use egui::{Rect, ScrollArea, Ui};

/// What the frame of a panel takes of its height `[points]`.
pub(super) const FRAME: f32 = 14.0;
/// Room to scroll in, however low a window is `[points]`.
const LEAST: f32 = 48.0;

/// Shows what a panel has, at most as high as a room; where it would be higher it is scrolled.
pub(super) fn within<R>(ui: &mut Ui, room: Rect, add: impl FnOnce(&mut Ui) -> R) -> R {
    let most = (room.height() - FRAME).max(LEAST);
    // As high as it was when it was shown last.
    let id = ui.scope_id().with("height of all of it");
    let is_higher = |high: f32| high > most + 0.5;
    let was_higher = ui.data(|data| data.get_temp::<f32>(id)).is_some_and(is_higher);
    let (inner, high) = match was_higher {
        true => {
            let shown = ScrollArea::vertical().max_height(most).min_scrolled_height(most).show(ui, add);
            (shown.inner, shown.content_size.y)
        }
        false => {
            let shown = ui.scope(add);
            (shown.inner, shown.response.rect.height())
        }
    };
    ui.data_mut(|data| data.insert_temp(id, high));
    if is_higher(high) != was_higher {
        ui.ctx().request_repaint();
    }
    inner
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::super::{Facts, PanelState, show, theme};
    use super::*;
    use crate::app::action::Tool;

    /// In small windows all tools are seen at once, and what the brush needs most.
    #[test]
    fn in_small_windows_nothing_that_is_needed_has_to_be_scrolled_to() {
        for size in [[600.0, 450.0], [720.0, 480.0]] {
            let facts = Facts { dimensions: 2, tool: Tool::Paint, ..Facts::default() };
            let mut state = PanelState::default();
            let mut panels = Harness::builder().with_size(size).build_ui(move |ui| {
                theme::apply(ui.ctx(), Default::default());
                _ = show(ui, &mut state, &facts);
            });
            panels.run_steps(12);
            let rect = |name: &str| panels.get_all_by_label(name).next().unwrap().rect();
            let below = rect("play").top();
            for name in
                ["grab and throw; beside bodies, push", "wind: drag an arrow through the air", "Steel", "radius"]
            {
                assert!(rect(name).bottom() <= below, "{size:?}: `{name}` at {}", rect(name));
            }
        }
    }

    /// In windows lower than any that can be made, on systems that make them all the same, each button can be scrolled to and pressed.
    #[test]
    fn in_windows_that_are_too_low_what_has_no_room_is_scrolled_to() {
        for size in [[480.0, 360.0], [400.0, 300.0], [320.0, 240.0]] {
            for tool in [Tool::Build, Tool::Paint, Tool::Muscle, Tool::Push] {
                let facts = Facts { dimensions: 2, tool, ..Facts::default() };
                let mut panels = Harness::builder().with_size(size).build_ui(move |ui| {
                    theme::apply(ui.ctx(), Default::default());
                    _ = show(ui, &mut PanelState::default(), &facts);
                });
                panels.run_steps(12);
                let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
                for name in ["grab and throw; beside bodies, push", "wind: drag an arrow through the air", "?"] {
                    panels.get_by_label(name).scroll_to_me();
                    panels.run_steps(30);
                    let button = panels.get_by_label(name).rect();
                    assert!(window.contains(button.center()), "{size:?}, {tool:?}: `{name}` at {button}");
                }
            }
        }
    }
}
