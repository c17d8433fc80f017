//! How the panels look: dark, calm, one colour for what is on or asked for.

use egui::{Color32, CornerRadius, FontId, Margin, Shadow, Stroke, TextStyle, Visuals};

/// What is on, and the button that is wanted most.
pub(in crate::app) const ACCENT: Color32 = Color32::from_rgb(125, 240, 200);
/// On the accent.
pub(super) const ON_ACCENT: Color32 = Color32::from_rgb(10, 26, 22);
/// What takes away.
pub(in crate::app) const AWAY: Color32 = Color32::from_rgb(255, 120, 110);
/// What is led.
pub(in crate::app) const LEAD: Color32 = Color32::from_rgb(255, 214, 120);
/// Forces that stay.
pub(in crate::app) const PUSH: Color32 = Color32::from_rgb(255, 168, 92);
/// The probes: their rings and their curves.
pub(in crate::app) const PROBES: [Color32; 2] = [Color32::from_rgb(240, 228, 66), Color32::from_rgb(220, 140, 190)];
/// Text that matters.
pub(in crate::app) const TEXT: Color32 = Color32::from_rgb(226, 233, 244);
/// Text beside it: 6 : 1 on the panels.
pub(super) const WEAK: Color32 = Color32::from_rgb(150, 163, 184);
/// Panels, and what lies on them.
pub(in crate::app) const PANEL: Color32 = Color32::from_rgb(20, 26, 38);
const RAISED: Color32 = Color32::from_rgb(33, 42, 59);
const HOVERED: Color32 = Color32::from_rgb(46, 58, 81);
/// Lines between and around what is shown.
pub(super) const LINE: Color32 = Color32::from_rgb(40, 50, 70);

/// Gives a context the program's look.
pub(in crate::app) fn apply(context: &egui::Context) {
    context.set_theme(egui::Theme::Dark);
    context.set_visuals(visuals());
    context.all_styles_mut(|style| {
        // What can be scrolled shows that it can.
        let bar = egui::style::ScrollStyle::solid();
        style.spacing.scroll = egui::style::ScrollStyle { bar_width: 6.0, ..bar };
        style.spacing.item_spacing = egui::vec2(8.0, 6.0);
        style.spacing.button_padding = egui::vec2(10.0, 5.0);
        style.spacing.window_margin = Margin::same(14);
        style.text_styles.insert(TextStyle::Heading, FontId::proportional(17.0));
        style.text_styles.insert(TextStyle::Body, FontId::proportional(13.5));
        style.text_styles.insert(TextStyle::Button, FontId::proportional(13.5));
        style.text_styles.insert(TextStyle::Monospace, FontId::monospace(12.5));
    });
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = PANEL;
    visuals.window_fill = PANEL;
    visuals.extreme_bg_color = Color32::from_rgb(12, 16, 25);
    visuals.faint_bg_color = Color32::from_rgb(25, 32, 46);
    visuals.window_stroke = Stroke::new(1.0, LINE);
    visuals.window_corner_radius = CornerRadius::same(12);
    visuals.menu_corner_radius = CornerRadius::same(10);
    let shadow = Shadow { offset: [0, 6], blur: 22, spread: 0, color: Color32::from_black_alpha(110) };
    (visuals.window_shadow, visuals.popup_shadow) = (shadow, shadow);
    visuals.hyperlink_color = ACCENT;
    visuals.selection.bg_fill = Color32::from_rgb(36, 92, 80);
    visuals.selection.stroke = Stroke::new(1.0, ACCENT);
    visuals.weak_text_color = Some(WEAK);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, TEXT);
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, LINE);
    for (state, fill, text) in [
        (&mut widgets.inactive, RAISED, TEXT),
        (&mut widgets.hovered, HOVERED, Color32::WHITE),
        (&mut widgets.active, HOVERED, ACCENT),
        (&mut widgets.open, HOVERED, TEXT),
    ] {
        (state.bg_fill, state.weak_bg_fill) = (fill, fill);
        state.fg_stroke = Stroke::new(1.0, text);
        state.bg_stroke = Stroke::NONE;
        state.corner_radius = CornerRadius::same(7);
        state.expansion = 0.0;
    }
    visuals
}

/// The ground of what floats over the world.
pub(super) fn floating() -> egui::Frame {
    egui::Frame::new()
        .fill(PANEL.gamma_multiply(0.92))
        .stroke(Stroke::new(1.0, LINE))
        .corner_radius(CornerRadius::same(10))
        .inner_margin(Margin::symmetric(8, 6))
}
