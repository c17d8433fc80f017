//! The frame of a sheet: what lies over the world until it is closed.

use egui::{Align2, Context, Id, Ui, Window};

/// The bar below is so high `[points]`: sheets lie above it.
const BAR: f32 = 44.0;

/// Shows a sheet in the middle, with its title and a button that closes it. Returns whether it stays.
pub(in crate::app) fn show(context: &Context, id: &str, title: impl Into<String>, add: impl FnOnce(&mut Ui)) -> bool {
    let mut stays = true;
    Window::new(title.into())
        .id(Id::unique(id))
        .open(&mut stays)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, -0.5 * BAR])
        .show(context, add);
    stays
}
