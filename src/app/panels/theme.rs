//! How the panels look: calm, one colour for what is on or asked for, dark or light as the world is.

use egui::{Color32, Context, CornerRadius, FontId, Margin, Shadow, Stroke, TextStyle, Theme, Ui, Visuals};

use crate::render::Palette;

/// The colours of the panels, and of what is marked in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Colors {
    /// What is on, and the button that is wanted most.
    pub(in crate::app) accent: Color32,
    /// On the accent.
    pub(in crate::app) on_accent: Color32,
    /// What takes away, and what went wrong.
    pub(in crate::app) away: Color32,
    /// What is led, and what is to be known.
    pub(in crate::app) lead: Color32,
    /// Forces that stay.
    pub(in crate::app) push: Color32,
    /// The probes: their rings and their curves.
    pub(in crate::app) probes: [Color32; 2],
    /// Kinds of energy, the kinetic one, that of springs and that of gravity first: those who are blind to some colours tell them apart.
    pub(in crate::app) energies: [Color32; 8],
    /// Text that matters.
    pub(in crate::app) text: Color32,
    /// Text beside it.
    pub(in crate::app) weak: Color32,
    /// Text on what the pointer rests on.
    hovered_text: Color32,
    /// Panels.
    pub(in crate::app) panel: Color32,
    /// What is written or drawn in.
    field: Color32,
    /// What lies a little apart.
    faint: Color32,
    /// Buttons, and those that the pointer rests on.
    raised: Color32,
    hovered: Color32,
    /// Behind what is chosen of several.
    selected: Color32,
    /// Lines between and around what is shown.
    pub(in crate::app) line: Color32,
    /// Around what is marked in the world, so that it is seen on any ground.
    pub(in crate::app) edge: Color32,
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

/// Energies by Okabe and Ito.
static DARK: Colors = Colors {
    accent: rgb(0x7d_f0_c8),
    on_accent: rgb(0x0a1a16),
    away: rgb(0xff_78_6e),
    lead: rgb(0xff_d6_78),
    push: rgb(0xff_a8_5c),
    probes: [rgb(0xf0_e4_42), rgb(0xdc_8c_be)],
    energies: [
        rgb(0xe6_9f_00),
        rgb(0x56_b4_e9),
        rgb(0x00_9e_73),
        rgb(0xe8_74_3b),
        rgb(0xdc_8c_be),
        rgb(0xf0_e4_42),
        rgb(0xb8_b0_ff),
        rgb(0xa0_c8_b0),
    ],
    text: rgb(0xe2_e9_f4),
    weak: rgb(0xa6_b2_c7),
    hovered_text: Color32::WHITE,
    panel: rgb(0x14_1a_26),
    field: rgb(0x0c_10_19),
    faint: rgb(0x19_20_2e),
    raised: rgb(0x21_2a_3b),
    hovered: rgb(0x2e_3a_51),
    selected: rgb(0x1d_4a_41),
    line: rgb(0x28_32_46),
    edge: Color32::from_black_alpha(150),
};

/// The same hues, dark enough to be read on what is nearly white.
static LIGHT: Colors = Colors {
    accent: rgb(0x00_6a_4f),
    on_accent: Color32::WHITE,
    away: rgb(0xb4_24_1c),
    lead: rgb(0x80_56_00),
    push: rgb(0x9a_48_00),
    probes: [rgb(0x6e_5c_00), rgb(0x8e_36_6e)],
    energies: [
        rgb(0x8a_56_00),
        rgb(0x00_5c_9e),
        rgb(0x00_66_4a),
        rgb(0xa8_32_00),
        rgb(0x8e_36_6e),
        rgb(0x6e_5c_00),
        rgb(0x5a_48_b0),
        rgb(0x3c_5c_44),
    ],
    text: rgb(0x1a_22_30),
    weak: rgb(0x4c_58_6c),
    hovered_text: Color32::BLACK,
    panel: rgb(0xf7_f9_fc),
    field: Color32::WHITE,
    faint: rgb(0xed_f1_f7),
    raised: rgb(0xe2_e8_f1),
    hovered: rgb(0xd2_db_e8),
    selected: rgb(0xbf_e6_da),
    line: rgb(0xc6_cf_dd),
    edge: Color32::from_rgba_premultiplied(190, 190, 190, 190),
};

/// The colours that a context has now.
pub(in crate::app) fn colors(context: &Context) -> &'static Colors {
    match context.theme() {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// A row is as high as its buttons from the start: words before them stand in its middle.
pub(in crate::app) fn as_high_as_buttons(ui: &mut Ui) {
    let high = button_height(ui);
    ui.set_min_height(high);
}

/// How high a button with words is `[points]`.
pub(super) fn button_height(ui: &Ui) -> f32 {
    ui.text_style_height(&TextStyle::Button) + 2.0 * ui.spacing().button_padding.y
}

/// Gives a context the program's look.
pub(in crate::app) fn apply(context: &Context, palette: Palette) {
    context.set_theme(match palette {
        Palette::Dark => Theme::Dark,
        Palette::Light => Theme::Light,
    });
    for (theme, colors) in [(Theme::Dark, &DARK), (Theme::Light, &LIGHT)] {
        context.set_visuals_of(theme, visuals(theme, colors));
    }
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

fn visuals(theme: Theme, colors: &Colors) -> Visuals {
    let mut visuals = theme.default_visuals();
    visuals.panel_fill = colors.panel;
    visuals.window_fill = colors.panel;
    visuals.extreme_bg_color = colors.field;
    visuals.faint_bg_color = colors.faint;
    visuals.window_stroke = Stroke::new(1.0, colors.line);
    visuals.window_corner_radius = CornerRadius::same(12);
    visuals.menu_corner_radius = CornerRadius::same(10);
    let darkness = if theme == Theme::Dark { 110 } else { 50 };
    let shadow = Shadow { offset: [0, 6], blur: 22, spread: 0, color: Color32::from_black_alpha(darkness) };
    (visuals.window_shadow, visuals.popup_shadow) = (shadow, shadow);
    visuals.hyperlink_color = colors.accent;
    visuals.selection.bg_fill = colors.selected;
    visuals.selection.stroke = Stroke::new(1.0, colors.accent);
    visuals.weak_text_color = Some(colors.weak);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, colors.text);
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, colors.line);
    for (state, fill, text) in [
        (&mut widgets.inactive, colors.raised, colors.text),
        (&mut widgets.hovered, colors.hovered, colors.hovered_text),
        (&mut widgets.active, colors.hovered, colors.accent),
        (&mut widgets.open, colors.hovered, colors.text),
    ] {
        (state.bg_fill, state.weak_bg_fill) = (fill, fill);
        state.fg_stroke = Stroke::new(1.0, text);
        state.bg_stroke = Stroke::NONE;
        state.corner_radius = CornerRadius::same(7);
        state.expansion = 0.0;
    }
    visuals
}

/// How opaque what floats is: what lies below is guessed at, and words are read over white and over black bodies `[1]`.
const FLOATING: f32 = 0.96;

/// The ground of what floats over the world.
pub(super) fn floating(context: &Context) -> egui::Frame {
    let colors = colors(context);
    egui::Frame::new()
        .fill(colors.panel.gamma_multiply(FLOATING))
        .stroke(Stroke::new(1.0, colors.line))
        .corner_radius(CornerRadius::same(10))
        .inner_margin(Margin::symmetric(8, 6))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{Look, contrast};

    /// As the renderer has colours.
    fn plain(color: Color32) -> [f32; 4] {
        color.to_normalized_gamma_f32()
    }

    #[test]
    fn all_text_is_read_on_whatever_it_stands_on() {
        for (colors, palette) in [(&DARK, Palette::Dark), (&LIGHT, Palette::Light)] {
            let grounds = [colors.panel, colors.faint, colors.field];
            let written = [colors.text, colors.weak, colors.accent, colors.away, colors.lead, colors.push];
            let mut pairs: Vec<(Color32, Color32)> = Vec::new();
            for ground in grounds {
                pairs
                    .extend(written.into_iter().chain(colors.probes).chain(colors.energies).map(|text| (text, ground)));
            }
            // On buttons, on rows that the pointer rests on, and on what is chosen, with what is said beside it.
            for ground in [colors.raised, colors.hovered, colors.selected] {
                pairs.extend([colors.text, colors.weak, colors.accent, colors.hovered_text].map(|text| (text, ground)));
            }
            pairs.push((colors.on_accent, colors.accent));
            for (text, ground) in pairs {
                let found = contrast(plain(text), plain(ground));
                assert!(found >= 4.5, "{palette:?}: {text:?} on {ground:?}: {found:.2}");
            }
            let look = Look::in_palette(palette);
            // What floats is a little transparent: the ground of the world shines through it, or a body of any colour.
            let panel = plain(colors.panel);
            for behind in [look.ground, [0.0, 0.0, 0.0, 1.0], [1.0; 4]] {
                let floating = std::array::from_fn(|part| FLOATING * panel[part] + (1.0 - FLOATING) * behind[part]);
                for text in written.into_iter().chain(colors.probes).chain(colors.energies) {
                    let found = contrast(plain(text), floating);
                    assert!(found >= 4.5, "{palette:?}: {text:?} on what floats over {behind:?}: {found:.2}");
                }
            }
            // What is marked in the world has the colours of the world's own marks.
            assert_eq!(look.region[..3], plain(colors.accent)[..3]);
            assert_eq!(look.motor[..3], plain(colors.lead)[..3]);
        }
    }
}
