//! What is selected is made of: shown and changed at the right edge.

mod heavy;
mod look;
pub(super) mod modulus;
mod place;
mod placing;
mod rows;
mod sink;
mod surface;
mod swatch;

use egui::collapsing_header::CollapsingState;
use egui::{
    Align2, Area, CursorIcon, Id, Label, LayerId, Order, Pos2, Rect, Response, RichText, ScrollArea, Sense, Ui, Vec2,
};

use super::bonds::{breaks, kinds, limits};
use super::theme::{colors, floating};
use super::{Facts, PanelState, Wish, angles, described, motors, swings, ways};
use crate::app::action::Action;
use crate::app::count::counted;
use crate::app::matter::{Matter, MatterChange, Span};
pub(super) use heavy::{gives_way, sagging};
use look::looks;
pub(in crate::app) use place::MatterAt;
pub(super) use rows::{number, row, short};
pub(super) use sink::Sink;
use surface::surface;
pub(in crate::app) use swatch::presets;
pub(super) use swatch::swatch;

/// Width of the panel `[points]`.
pub(super) const WIDTH: f32 = 226.0;
/// What its frame takes beside that, and frame and header above what is scrolled `[points]`.
const FRAME: f32 = 18.0;
/// Room for the bar that scrolls it, and beside it `[points]`.
const BAR: f32 = 20.0;
/// All of its width `[points]`.
pub(super) const WHOLE: f32 = WIDTH + FRAME + BAR;
const HEAD: f32 = 50.0;
/// What is scrolled is no lower, however low a window is `[points]`.
const LEAST: f32 = 60.0;
/// What stands at the right edge pushes it further off that than this `[points]`.
const PUSHED: f32 = 40.0;

/// Shows it at the right edge of a room, or beside the tools, where it would cover what is selected, or where its title was dragged to. Where it would cover the middle of the
/// window it begins folded. In windows higher than wide it stays at the right, unless it was dragged: bodies lie below it. Returns where it begins and ends, bars and all, however much of that it takes now `[points]`; `None`: it was
/// dragged, and lies where it lies.
pub(super) fn show(
    context: &egui::Context,
    (room, beside_tools, is_upright): (Rect, Pos2, bool),
    state: &mut PanelState,
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) -> Option<[f32; 2]> {
    let id = area_id();
    let is_down = context.input(|input| input.pointer.any_down());
    // It may get as high as there is room.
    let (size, whole) = (egui::vec2(WIDTH + FRAME, room.height()), (room, beside_tools.x));
    if !is_down {
        state.gesture = None;
        let right = Rect::from_min_size(room.right_top() - egui::vec2(size.x, 0.0), size);
        let is_pushed = facts.matter.is_none() && room.right() + PUSHED < context.content_rect().right();
        let sides = [right, Rect::from_min_size(beside_tools, size)];
        state.matter_at.find(whole, sides, (facts.chosen_at, is_pushed, is_upright));
    }
    let dragged = state.matter_at.corner(size, whole);
    let mut sink = Sink { gesture: &mut state.gesture, wishes, previews_stops: &mut state.previews_stops };
    let middle = context.content_rect().center().x;
    let (pivot, corner, is_open) = match state.matter_at.is_left {
        true => (Align2::LEFT_TOP, beside_tools, beside_tools.x + WIDTH + FRAME < middle),
        false => (Align2::RIGHT_TOP, room.right_top(), room.right() - WIDTH - FRAME > middle),
    };
    let (pivot, corner) = dragged.map_or((pivot, corner), |dragged| (Align2::LEFT_TOP, dragged));
    let mut grip = None;
    let shown = Area::new(id).pivot(pivot).fixed_pos(corner).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_width(WIDTH);
            let fold =
                CollapsingState::load_with_default_open(ui.ctx(), Id::unique(("matter is open", is_open)), is_open);
            let mut header = fold.show_header(ui, |ui| {
                let words = facts.matter.as_deref().map_or_else(|| "Select".to_owned(), title);
                let words = Label::new(RichText::new(words).color(colors(ui).text).strong()).truncate();
                let title = ui.add(words.selectable(false).sense(Sense::click_and_drag()));
                grip = Some(title.on_hover_cursor(CursorIcon::Grab).on_hover_text(GRIP));
            });
            if grip.as_ref().is_some_and(Response::clicked) {
                header.toggle();
            }
            header.body_unindented(|ui| {
                let height = (room.bottom() - corner.y - HEAD).max(LEAST);
                ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
                    match &facts.matter {
                        Some(matter) => of_selection(ui, matter, facts, &mut sink),
                        None => of_nothing(ui, facts, &mut sink),
                    }
                });
            });
        });
    });
    if let Some(grip) = grip {
        lead(&mut state.matter_at, &grip, shown.response.rect);
    }
    match state.matter_at.is_left {
        _ if state.matter_at.is_dragged() => None,
        true => Some([beside_tools.x, beside_tools.x + WHOLE]),
        false => Some([room.right() - WHOLE, room.right()]),
    }
}

/// Said of the title.
const GRIP: &str = "a click folds it, a drag puts it elsewhere, a double click back at the edge";

/// The panel goes where its title is dragged, and back by a double click.
fn lead(at: &mut MatterAt, grip: &Response, lies: Rect) {
    if grip.dragged() && grip.drag_delta() != Vec2::ZERO {
        at.drag_to(lies.min + grip.drag_delta());
    } else if grip.double_clicked() {
        at.put_back();
    } else {
        return;
    }
    // It lies there from the next frame on.
    grip.ctx.request_repaint();
}

fn area_id() -> Id {
    Id::unique("matter")
}

/// Where it lies, if it is shown `[points]`.
pub(in crate::app) fn lies(context: &egui::Context) -> Option<Rect> {
    let layer = LayerId::new(Order::Middle, area_id());
    context.memory(|memory| memory.area_rect(area_id()).filter(|_| memory.areas().is_visible(&layer)))
}

/// A button: its name, what it does, and the action.
const PASTE: (&str, &str, Action) = ("Paste", "what was copied, into the middle of what is seen", Action::Paste);

/// Mirrors, of the plane.
const FLIPS: [(&str, &str, Action); 2] = [
    ("Flip left-right", "mirror it, with its velocity and what drives it", Action::FlipAcross),
    ("Flip up-down", "turn it upside down as a mirror does, with its velocity", Action::FlipOver),
];

/// How to select more than one body, or less.
const HOW: &str = "Shift adds to what is selected; a double click or Ctrl+click takes one bond or one point";

/// How to select, where nothing is.
fn of_nothing(ui: &mut Ui, facts: &Facts, sink: &mut Sink<'_>) {
    ui.label(RichText::new("click a body or an obstacle, or drag beside them").color(colors(ui).weak));
    ui.horizontal(|ui| {
        for (is_lasso, name) in [(false, "Box"), (true, "Free stroke")] {
            let choice = ui.selectable_label(facts.draws_lasso == is_lasso, name);
            if choice.on_hover_text("what a drag beside all bodies draws; with Alt always a free stroke").clicked() {
                sink.wishes.push(Wish::Lasso(is_lasso));
            }
        }
        if ui.button("All").on_hover_text(described("all bodies and obstacles", Action::SelectAll)).clicked() {
            sink.act(Action::SelectAll);
        }
        let (name, words, action) = PASTE;
        if ui.button(name).on_hover_text(described(words, action)).clicked() {
            sink.act(action);
        }
    });
    ui.label(RichText::new(HOW).color(colors(ui).weak));
    if facts.hidden > 0 {
        let bodies = if facts.hidden == 1 {
            "a body is hidden".to_owned()
        } else {
            format!("{} bodies are hidden", facts.hidden)
        };
        ui.horizontal(|ui| {
            ui.label(RichText::new(bodies).color(colors(ui).weak));
            if ui
                .button("Show all")
                .on_hover_text(described("all that is hidden is drawn again", Action::ShowHidden))
                .clicked()
            {
                sink.act(Action::ShowHidden);
            }
        });
    }
}

fn of_selection(ui: &mut Ui, matter: &Matter, facts: &Facts, sink: &mut Sink<'_>) {
    if let Some(parts) = parts(matter) {
        ui.label(RichText::new(parts).color(colors(ui).weak));
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        // One body is selected as one anyway.
        let group = match () {
            () if facts.is_grouped => Some(("Ungroup", "select each by itself again", Action::Ungroup)),
            () if matter.bodies > 1 => Some(("Group", "select them as one from now on", Action::Group)),
            () => None,
        };
        let first =
            [("Copy", "to the clipboard", Action::Copy), PASTE, ("Duplicate", "a copy beside it", Action::Duplicate)];
        let flips = if facts.dimensions == 3 { &[][..] } else { &FLIPS[..] }.iter().copied();
        let last = [("Delete", "take it away", Action::Delete)];
        for (name, words, action) in first.into_iter().chain(group).chain(flips).chain(last) {
            if ui.button(name).on_hover_text(described(words, action)).clicked() {
                sink.act(action);
            }
        }
    });
    ui.separator();
    if matter.points > 0 {
        if let (Some(by), Some(preset)) = presets(ui, matter.preset()) {
            sink.set(&by, MatterChange::Preset(preset));
        }
        ui.separator();
        let mass = Span { least: matter.mass, most: matter.mass };
        number(ui, ("mass", " kg"), Some(mass), sink, |x| (x > 0.0).then_some(MatterChange::Mass(x)));
        if let Some(density) = matter.density() {
            row(ui, "", |ui, _| {
                _ = ui.label(RichText::new(format!("{} kg/m²", short(density))).color(colors(ui).weak))
            });
        }
        kinds(ui, matter, sink);
    }
    match matter.stiffness.filter(|_| matter.density().is_some()) {
        Some(stiffness) => modulus::row(ui, stiffness, sink),
        None => of_springs(ui, ("stiffness", modulus::UNIT), (matter.stiffness, matter), sink, MatterChange::Stiffness),
    }
    if facts.overload.as_deref().is_some_and(|overload| gives_way(ui, overload)) {
        sink.wishes.push(Wish::Bear);
    }
    of_springs(ui, ("damping", " N s/m"), (matter.damping, matter), sink, MatterChange::Damping);
    let has_angles = matter.angle_damping.is_some() || matter.joints[1] > 0 || matter.bending.is_some();
    let has_surface = matter.friction.is_some() || matter.radius.is_some() || matter.points > 0;
    let moves = facts.figures.velocity.is_some() || !matter.pins.is_empty();
    // What is set most often first.
    if let Some(motors) = &matter.motors {
        group(ui, "Motor", true, |ui| motors::show(ui, motors, sink));
    }
    group(ui, "Place", facts.figures.placed.is_some(), |ui| placing::placing(ui, facts, sink));
    group(ui, "Angles and stops", has_angles, |ui| {
        // Angles come with it, and their rows below it.
        number(ui, ("bending", " N m²"), matter.bending, sink, |x| Some(MatterChange::Bending(x)));
        number(ui, ("damped by", " N m s"), matter.angle_damping, sink, |x| Some(MatterChange::AngleDamping(x)));
        angles::show(ui, matter, sink);
        swings::show(ui, matter, sink);
    });
    group(ui, "Look", matter.points > 0, |ui| looks(ui, matter, facts, sink));
    group(ui, "Surface", has_surface, |ui| surface(ui, matter, facts, sink));
    group(ui, "Motion", moves, |ui| ways::show(ui, matter, facts, sink));
    group(ui, "Bonds", matter.bonds > 0, |ui| of_bonds(ui, matter, sink));
}

/// A number of springs: its row stays where it is when none are left of the bonds.
fn of_springs(
    ui: &mut Ui,
    (name, unit): (&str, &str),
    (span, matter): (Option<Span>, &Matter),
    sink: &mut Sink<'_>,
    change: fn(f64) -> MatterChange,
) {
    if span.is_none() && matter.bonds > 0 {
        return row(ui, name, |ui, _| _ = ui.label(RichText::new("of springs alone").color(colors(ui).weak)));
    }
    number(ui, (name, unit), span, sink, |x| Some(change(x)));
}

/// Rows that belong together, where there are any.
fn group(ui: &mut Ui, name: &str, has_rows: bool, rows: impl FnOnce(&mut Ui)) {
    if has_rows {
        ui.separator();
        ui.label(RichText::new(name).color(colors(ui).accent));
        rows(ui);
    }
}

/// Lengths of bonds, and what they do at them.
fn of_bonds(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    breaks(ui, matter, sink);
    number(ui, ("rest length", " m"), matter.rest_length, sink, |x| (x > 0.0).then_some(MatterChange::RestLength(x)));
    limits(ui, matter, sink);
    number(ui, ("relaxation", ""), matter.relaxation, sink, |x| {
        (0.0 < x && x <= 1.0).then_some(MatterChange::Relaxation(x))
    });
    number(ui, ("corrects", ""), matter.max_correction, sink, |x| (x > 0.0).then_some(MatterChange::MaxCorrection(x)));
}

/// What is selected: a body by its name, several counted, with their points.
fn title(matter: &Matter) -> String {
    let bodies = match &matter.name {
        Some(name) => Some(name.clone()),
        None if matter.points == 0 => None,
        // Loose points are no bodies to whoever plays.
        None if matter.bodies == matter.points => Some(counted(matter.points, "point")),
        None => Some(format!("{}, {}", counted(matter.bodies, "body"), counted(matter.points, "point"))),
    };
    let obstacles = match (matter.obstacles, &bodies) {
        (0, _) => None,
        (1, None) => Some("obstacle".to_owned()),
        (count, _) => Some(counted(count, "obstacle")),
    };
    bodies.into_iter().chain(obstacles).collect::<Vec<_>>().join(", ")
}

/// What is not in the title of it, counted.
fn parts(matter: &Matter) -> Option<String> {
    let points = matter.name.as_ref().filter(|_| matter.points > 1).map(|_| counted(matter.points, "point"));
    let bonds = (matter.bonds > 0).then(|| counted(matter.bonds, "bond"));
    let all: Vec<String> = points.into_iter().chain(bonds).collect();
    (!all.is_empty()).then(|| all.join(", "))
}
