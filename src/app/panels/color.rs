//! A colour is chosen: samples to click on, and below them bars of hue, strength and lightness for any other.

use egui::ecolor::Hsva;
use egui::epaint::Mesh;
use egui::{
    Align2, Color32, FontId, Grid, Id, Popup, PopupCloseBehavior, Rect, Response, RichText, Role, Sense, Shape, Stroke,
    StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

use super::theme::colors;

/// A colour: red, green, blue as stored (sRGB).
type Rgb = [u8; 3];

/// Colours to click on, told apart by those who are blind to some: by Okabe and Ito, with lighter ones and greys.
const SAMPLES: [(&str, Rgb); 16] = [
    ("red", [0xd5, 0x3e, 0x3e]),
    ("orange", [0xe6, 0x8a, 0x2e]),
    ("yellow", [0xf0, 0xe4, 0x42]),
    ("green", [0x2f, 0x9e, 0x5b]),
    ("teal", [0x00, 0x9e, 0x9e]),
    ("blue", [0x2f, 0x7a, 0xd9]),
    ("violet", [0x8a, 0x5c, 0xd0]),
    ("pink", [0xdc, 0x6c, 0xae]),
    ("light red", [0xff, 0xa8, 0x9e]),
    ("light orange", [0xff, 0xcf, 0x8a]),
    ("light green", [0x9c, 0xe8, 0xb8]),
    ("light blue", [0x9a, 0xcb, 0xff]),
    ("brown", [0x8a, 0x5a, 0x3a]),
    ("white", [0xff; 3]),
    ("grey", [0x8c, 0x93, 0x9e]),
    ("black", [0x1a, 0x1c, 0x20]),
];
/// Samples in a row, their side and the room between `[points]`.
const COLUMNS: usize = 8;
const SAMPLE: f32 = 22.0;
const APART: f32 = 4.0;
/// Size of a bar, and of the names before them `[points]`.
const BAR: [f32; 2] = [138.0, 14.0];
/// Steps of a bar's colours.
const STEPS: usize = 24;
/// A key moves a bar by this share of it `[1]`.
const KEY: f32 = 0.02;

/// A button in a colour, beside its label, which opens them. Returns what a click or a drag changed it to, and by what.
pub(in crate::app) fn button(ui: &mut Ui, color: Rgb, label: Id, said: &str) -> Option<(Response, Rgb)> {
    let (rect, button) = ui.allocate_exact_size(ui.spacing().interact_size, Sense::click());
    let [red, green, blue] = color;
    let hex = format!("#{red:02x}{green:02x}{blue:02x}");
    button.widget_info(|| WidgetInfo {
        current_text_value: Some(hex.clone()),
        ..WidgetInfo::labeled(Role::ColorWell, true, "colour")
    });
    let edge = if button.hovered() || button.has_focus() { colors(ui).accent } else { colors(ui).line };
    ui.painter().rect(rect, 5.0, rgb(color), Stroke::new(1.0, edge), StrokeKind::Inside);
    let button = button.labelled_by(label).on_hover_text(said);
    let popup = Popup::from_toggle_button_response(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    popup.show(|ui| choices(ui, color)).and_then(|shown| shown.inner)
}

fn rgb([red, green, blue]: Rgb) -> Color32 {
    Color32::from_rgb(red, green, blue)
}

/// What is in the window that opens.
fn choices(ui: &mut Ui, color: Rgb) -> Option<(Response, Rgb)> {
    let mut changed = None;
    Grid::new("samples").spacing(vec2(APART, APART)).min_col_width(SAMPLE).show(ui, |ui| {
        for (place, (name, own)) in SAMPLES.into_iter().enumerate() {
            let (rect, by) = ui.allocate_exact_size(vec2(SAMPLE, SAMPLE), Sense::click());
            by.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
            let is_lit = by.hovered() || by.has_focus() || own == color;
            let edge = if is_lit { colors(ui).accent } else { colors(ui).line };
            let stroke = Stroke::new(if is_lit { 2.0 } else { 1.0 }, edge);
            ui.painter().rect(rect, 5.0, rgb(own), stroke, StrokeKind::Inside);
            if by.clicked() {
                changed = Some((by.clone(), own));
            }
            by.on_hover_text(name);
            if (place + 1) % COLUMNS == 0 {
                ui.end_row();
            }
        }
    });
    ui.add_space(APART);
    // A grey has no hue, and a black one no strength either: the bars keep what they had.
    let id = ui.scope_id().with("hsva");
    let kept: Option<Hsva> = ui.data(|data| data.get_temp(id));
    let mut hsva = kept.filter(|hsva| hsva.to_srgb() == color).unwrap_or_else(|| Hsva::from_srgb(color));
    let mut moved = None;
    let of = |h: f32, s: f32, v: f32| Color32::from(Hsva::new(h, s, v, 1.0));
    let Hsva { h, s, v, .. } = hsva;
    Grid::new("bars").num_columns(2).spacing(vec2(8.0, 6.0)).show(ui, |ui| {
        let mut row = |name: &str, value: &mut f32, shade: &dyn Fn(f32) -> Color32| {
            ui.label(RichText::new(name).color(colors(ui).weak).size(12.0));
            moved = bar(ui, name, value, shade).or(moved.take());
            ui.end_row();
        };
        row("hue", &mut hsva.h, &|h| of(h, 0.85, 0.95));
        row("strength", &mut hsva.s, &|s| of(h, s, v.max(0.35)));
        row("lightness", &mut hsva.v, &|v| of(h, s, v));
    });
    let [red, green, blue] = color;
    let hex = format!("#{red:02x}{green:02x}{blue:02x}");
    let (rect, _) = ui.allocate_exact_size(vec2(ui.min_rect().width(), 22.0), Sense::hover());
    ui.painter().rect_filled(rect, 5.0, rgb(color));
    let ink = readable(rgb(color));
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, hex, FontId::monospace(12.0), ink);
    if let Some(by) = moved {
        ui.data_mut(|data| data.insert_temp(id, hsva));
        let now = hsva.to_srgb();
        changed = (now != color).then_some((by, now)).or(changed);
    }
    changed
}

/// Black or white, whichever is read on a colour more easily.
fn readable(ground: Color32) -> Color32 {
    let [r, g, b, _] = egui::Rgba::from(ground).to_array();
    if 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 { Color32::BLACK } else { Color32::WHITE }
}

/// A bar from 0 to 1 in its colours, which is dragged along or moved by keys. Returns it if it was moved.
fn bar(ui: &mut Ui, name: &str, value: &mut f32, shade: &dyn Fn(f32) -> Color32) -> Option<Response> {
    let (rect, by) = ui.allocate_exact_size(BAR.into(), Sense::click_and_drag());
    let before = *value;
    if let Some(at) = by.interact_pointer_pos().filter(|_| by.is_pointer_button_down_on()) {
        *value = ((at.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
    }
    if by.has_focus() {
        let pressed = |key| ui.input(|input| input.num_presses(key)) as f32;
        let steps = pressed(egui::Key::ArrowRight) - pressed(egui::Key::ArrowLeft);
        *value = (*value + KEY * steps).clamp(0.0, 1.0);
    }
    by.widget_info(|| WidgetInfo::slider(true, f64::from(*value), name));
    let mut mesh = Mesh::default();
    for step in 0..=STEPS {
        let share = step as f32 / STEPS as f32;
        let first = mesh.vertices.len() as u32;
        let x = rect.left() + share * rect.width();
        [rect.top(), rect.bottom()].into_iter().for_each(|y| mesh.colored_vertex(pos2(x, y), shade(share)));
        if step < STEPS {
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    ui.painter().add(Shape::mesh(mesh));
    let edge = if by.hovered() || by.has_focus() { colors(ui).accent } else { colors(ui).line };
    ui.painter().rect_stroke(rect, 2.0, Stroke::new(1.0, edge), StrokeKind::Outside);
    let at = Rect::from_center_size(
        pos2(rect.left() + *value * rect.width(), rect.center().y),
        vec2(6.0, rect.height() + 6.0),
    );
    ui.painter().rect(at, 3.0, shade(*value), Stroke::new(2.0, colors(ui).text), StrokeKind::Outside);
    (*value != before).then_some(by)
}
