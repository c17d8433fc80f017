//! What is selected is made of: shown and changed at the right edge.

use egui::collapsing_header::CollapsingState;
use egui::{
    Align2, Area, Button, Color32, CornerRadius, DragValue, Id, Label, LayerId, Order, Pos2, Rect, Response, RichText,
    ScrollArea, Sense, Slider, Stroke, Ui,
};

use super::bonds::{breaks, kinds, limits};
use super::settings::Setting;
use super::theme::{as_high_as_buttons, colors, floating};
use super::{Facts, PanelState, Wish, angles, described, motors, ranged, swings, ticks, ways};
use crate::app::action::Action;
use crate::app::count::counted;
use crate::app::matter::{Coloring, Matter, MatterChange, Overload, Preset, Span};
use crate::history::Do;
use crate::render::contrast;

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
/// Width of the names before fields `[points]`.
const NAMES: f32 = 74.0;
/// What stands at the right edge pushes it further off that than this `[points]`.
const PUSHED: f32 = 40.0;
/// How fast a number changes as it is dragged, as a share of it for each point.
const SPEED: f64 = 0.01;
/// Where a drag of a number that is 0 begins.
const FIRST: f64 = 0.01;
/// Where a drag of the thickness of a skin begins that the rules chose `[m]`.
const THIN: f64 = 0.02;
/// What soft ground pushes with at first `[N/m]`, `[N s/m]`.
const PUSHES: [f64; 2] = [1000.0, 10.0];

/// Where changes go to.
pub(super) struct Sink<'a> {
    /// What is being dragged.
    gesture: &'a mut Option<Id>,
    wishes: &'a mut Vec<Wish>,
    /// The pointer rests on what gives joints stops.
    pub(super) previews_stops: &'a mut bool,
}

impl Sink<'_> {
    /// What is dragged on is one edit.
    pub(super) fn set(&mut self, by: &Response, change: MatterChange) {
        let goes_on = *self.gesture == Some(by.id);
        *self.gesture = by.ctx.input(|input| input.pointer.any_down()).then_some(by.id);
        self.wishes.push(Wish::Matter(change, goes_on));
    }

    fn act(&mut self, action: Action) {
        self.wishes.push(Wish::Act(action));
    }

    /// A command; what is dragged on is one edit.
    pub(super) fn give(&mut self, by: &Response, act: Do, name: &'static str) {
        let goes_on = *self.gesture == Some(by.id);
        *self.gesture = by.ctx.input(|input| input.pointer.any_down()).then_some(by.id);
        self.wishes.push(Wish::Set(Setting { act, name, goes_on }));
    }

    /// Commands of one click, and what they are called.
    pub(super) fn give_all(&mut self, acts: Vec<Do>, name: &'static str) {
        self.wishes.push(Wish::Give(acts, name));
    }
}

/// Where the panel of what is selected stands: it is found once for a selection, and anew when its room at the right edge gets another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct MatterAt {
    /// Beside the tools: at the right edge it would cover what is selected.
    is_left: bool,
    /// Where that room ended when it was found `[points]`; `None`: not yet.
    room: Option<f32>,
}

impl MatterAt {
    /// Where it goes, of `sides`: at the right edge, unless it covers what is selected there and not at the left; where nothing is selected,
    /// unless other panels push it off that edge.
    fn find(&mut self, room: Rect, [right, left]: [Rect; 2], (chosen, is_pushed): (Option<Rect>, bool)) {
        if self.room != Some(room.right()) {
            let covers = |side: Rect| chosen.is_some_and(|chosen| side.intersects(chosen));
            let is_left = if chosen.is_some() { covers(right) && !covers(left) } else { is_pushed };
            *self = MatterAt { is_left, room: Some(room.right()) };
        }
    }
}

/// Shows it at the right edge of a room, or beside the tools, where it would cover what is selected. Where it would cover the middle of the
/// window it begins folded. In windows higher than wide it stays at the right: bodies lie below it. Returns where it begins and ends, bars and all, however much of that it takes now `[points]`.
pub(super) fn show(
    context: &egui::Context,
    (room, beside_tools, is_upright): (Rect, Pos2, bool),
    state: &mut PanelState,
    facts: &Facts,
    wishes: &mut Vec<Wish>,
) -> [f32; 2] {
    let id = area_id();
    let is_down = context.input(|input| input.pointer.any_down());
    if !is_down {
        state.gesture = None;
        // It may get as high as there is room.
        let size = egui::vec2(WIDTH + FRAME, room.height());
        let right = Rect::from_min_size(room.right_top() - egui::vec2(size.x, 0.0), size);
        let is_pushed = facts.matter.is_none() && room.right() + PUSHED < context.content_rect().right();
        let sides = [right, Rect::from_min_size(beside_tools, size)];
        state.matter_at.find(room, sides, (facts.chosen_at.filter(|_| !is_upright), is_pushed && !is_upright));
    }
    let mut sink = Sink { gesture: &mut state.gesture, wishes, previews_stops: &mut state.previews_stops };
    let middle = context.content_rect().center().x;
    let (pivot, corner, is_open) = match state.matter_at.is_left {
        true => (Align2::LEFT_TOP, beside_tools, beside_tools.x + WIDTH + FRAME < middle),
        false => (Align2::RIGHT_TOP, room.right_top(), room.right() - WIDTH - FRAME > middle),
    };
    Area::new(id).pivot(pivot).fixed_pos(corner).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_width(WIDTH);
            let fold =
                CollapsingState::load_with_default_open(ui.ctx(), Id::unique(("matter is open", is_open)), is_open);
            let mut is_clicked = false;
            let mut header = fold.show_header(ui, |ui| {
                let words = facts.matter.as_deref().map_or_else(|| "Select".to_owned(), title);
                let words = Label::new(RichText::new(words).color(colors(ui).text).strong()).truncate();
                is_clicked = ui.add(words.selectable(false).sense(Sense::click())).clicked();
            });
            if is_clicked {
                header.toggle();
            }
            header.body_unindented(|ui| {
                let height = (room.height() - HEAD).max(LEAST);
                ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
                    match &facts.matter {
                        Some(matter) => of_selection(ui, matter, facts, &mut sink),
                        None => of_nothing(ui, facts, &mut sink),
                    }
                });
            });
        });
    });
    match state.matter_at.is_left {
        true => [beside_tools.x, beside_tools.x + WHOLE],
        false => [room.right() - WHOLE, room.right()],
    }
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
        for (name, words, action) in first.into_iter().chain(group).chain([("Delete", "take it away", Action::Delete)])
        {
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
    of_springs(ui, ("stiffness", " N/m"), (matter.stiffness, matter), sink, MatterChange::Stiffness);
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

/// How it is drawn.
fn looks(ui: &mut Ui, matter: &Matter, facts: &Facts, sink: &mut Sink<'_>) {
    color(ui, matter, facts.drawn_color, sink);
    visible(ui, matter, sink);
    if matter.area > 0.0 && facts.dimensions == 2 {
        row(ui, "picture", |ui, label| {
            let by = ui.button("from a file…").labelled_by(label);
            if by.on_hover_text("drawn over all of it, as large as it is now").clicked() {
                sink.wishes.push(Wish::Wear);
            }
        });
    }
    number(ui, ("width", " m"), matter.width, sink, |x| Some(MatterChange::Width(x)));
}

/// How it meets others.
fn surface(ui: &mut Ui, matter: &Matter, facts: &Facts, sink: &mut Sink<'_>) {
    share(ui, "friction", 2.0, matter.friction, sink, MatterChange::Friction);
    share(ui, "restitution", 1.0, matter.restitution, sink, MatterChange::Restitution);
    skin(ui, matter, sink);
    layers(ui, matter, sink);
    penalty(ui, matter, sink);
    if matter.points > 0 && matter.friction.is_none() && facts.dimensions == 2 {
        ui.label(RichText::new("bodies pass through each other: G, to let them meet").color(colors(ui).weak));
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

/// Says that a body would sag by some share of its height, and offers the stiffness that bears it `[N/m]`. Returns the offer, if it is taken.
pub(super) fn sagging(ui: &mut Ui, (share, stiffness): (f64, f64)) -> Option<Response> {
    let words = match share {
        share if share < 1.0 => {
            format!("too heavy for its springs: it would sag by {:.0} % of its height", 100.0 * share)
        }
        _ => "too heavy for its springs: its own weight would crush it".to_owned(),
    };
    offer(ui, &words, stiffness, "so stiff springs let it sag by a tenth of its height")
}

/// Says that a part of a body gives way under its load, and offers the stiffness that bears it. Returns whether it is taken.
pub(super) fn gives_way(ui: &mut Ui, overload: &Overload) -> bool {
    let words = match overload.share {
        share if share < 1.0 => {
            format!("too heavy for what it stands on: it sinks by {:.0} % of its height", 100.0 * share)
        }
        _ => "too heavy for what it stands on: that is crushed".to_owned(),
    };
    let told = format!("so stiff springs in it and in what it stands on: {}", counted(overload.bonds.len(), "bond"));
    offer(ui, &words, overload.stiffness, &told).is_some()
}

/// Says that something is too heavy, and offers the stiffness that bears it `[N/m]`.
fn offer(ui: &mut Ui, words: &str, stiffness: f64, told: &str) -> Option<Response> {
    ui.add(Label::new(RichText::new(words).color(colors(ui).away)).wrap());
    let offer = ui.button(format!("{} N/m bear it", short(stiffness)));
    Some(offer.on_hover_text(told)).filter(Response::clicked)
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

/// Buttons for matter by name, in their colours. Returns the one that was clicked.
pub(super) fn presets(ui: &mut Ui, chosen: Option<Preset>) -> (Option<Response>, Option<Preset>) {
    let mut clicked = (None, None);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        for preset in Preset::ALL {
            let kind = (preset.name(), preset.color());
            let by = swatch(ui, kind, (chosen == Some(preset), 0.0)).on_hover_text(preset.words());
            if by.clicked() {
                clicked = (Some(by), Some(preset));
            }
        }
    });
    clicked
}

/// What is written on a button, on a bright ground and on a dark one.
const INK: [[u8; 3]; 2] = [[18, 22, 30], [250, 251, 253]];

/// A button for a matter, with its name and in its colour; so wide at least, and ringed where it is what is chosen.
pub(super) fn swatch(
    ui: &mut Ui,
    (name, [red, green, blue]): (&str, [u8; 3]),
    (is_chosen, width): (bool, f32),
) -> Response {
    let edge = if is_chosen { colors(ui).accent } else { Color32::TRANSPARENT };
    let [bright, dark] = INK.map(|[red, green, blue]| Color32::from_rgb(red, green, blue));
    let fill = Color32::from_rgb(red, green, blue);
    let seen = |ink: Color32| contrast(fill.to_normalized_gamma_f32(), ink.to_normalized_gamma_f32());
    let text = RichText::new(name).color(if seen(bright) >= seen(dark) { bright } else { dark });
    let button = Button::selectable(is_chosen, text)
        .fill(fill)
        .stroke(Stroke::new(2.0, edge))
        .corner_radius(CornerRadius::same(7))
        .min_size(egui::vec2(width, 0.0));
    ui.add(button)
}

/// A field beside its name, by which what reads aloud calls it: all names are as wide, so that fields stand below each other.
pub(super) fn row<T>(ui: &mut Ui, name: &str, add: impl FnOnce(&mut Ui, Id) -> T) -> T {
    ui.horizontal(|ui| {
        as_high_as_buttons(ui);
        let size = egui::vec2(NAMES, ui.spacing().interact_size.y);
        let layout = egui::Layout::left_to_right(egui::Align::Center);
        let label = ui.allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_size(size);
            ui.label(name)
        });
        add(ui, label.inner.id)
    })
    .inner
}

/// A number without an upper end, which says so where it is not the same everywhere.
pub(super) fn number(
    ui: &mut Ui,
    (name, unit): (&str, &str),
    span: Option<Span>,
    sink: &mut Sink<'_>,
    change: impl Fn(f64) -> Option<MatterChange>,
) {
    let Some(span) = span else { return };
    let mut value = span.same().unwrap_or((span.least.max(FIRST) * span.most.max(FIRST)).sqrt());
    row(ui, name, |ui, label| {
        let speed = SPEED * value.max(FIRST);
        let field = DragValue::new(&mut value).speed(speed).update_while_editing(false);
        let field = match span.same() {
            Some(_) => field.custom_formatter(|x, _| short(x)).suffix(unit),
            None => field.custom_formatter(|_, _| "mixed".to_owned()),
        };
        let by = ranged::field(ui, field, 0.0..=1e9, unit).labelled_by(label);
        let by = match span.same() {
            Some(_) => by,
            None => by.on_hover_text(format!("from {} to {}{unit}", short(span.least), short(span.most))),
        };
        if let Some(change) = change(value).filter(|_| by.changed()) {
            sink.set(&by, change);
        }
    });
}

/// A number with few digits, whatever its size.
pub(super) fn short(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size >= 1e6 => format!("{x:.2e}"),
        size if size >= 100.0 => format!("{x:.0}"),
        size if size >= 10.0 => format!("{x:.1}"),
        size if size >= 0.1 => format!("{x:.2}"),
        size if size >= 1e-3 => format!("{x:.4}"),
        _ => format!("{x:.2e}"),
    }
}

/// A share that a slider sets, from 0.
fn share(ui: &mut Ui, name: &str, most: f64, span: Option<Span>, sink: &mut Sink<'_>, change: fn(f64) -> MatterChange) {
    let Some(span) = span else { return };
    let mut value = span.same().unwrap_or(0.5 * (span.least + span.most));
    let slider = Slider::new(&mut value, 0.0..=most).clamping(egui::SliderClamping::Edits).max_decimals(2);
    let slider = match span.same() {
        Some(_) => slider,
        None => slider.custom_formatter(|_, _| "mixed".to_owned()),
    };
    let by = row(ui, name, |ui, label| {
        ui.spacing_mut().slider_width = 72.0;
        ranged::slider(ui, slider.update_while_editing(false), 0.0..=most, "").labelled_by(label)
    });
    if by.changed() {
        sink.set(&by, change(value));
    }
}

/// How thick skins are, where bodies meet.
fn skin(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(radius) = matter.radius else { return };
    if let Some(span) = radius {
        return number(ui, ("skin", " m"), Some(span), sink, |x| Some(MatterChange::Radius(x)));
    }
    row(ui, "skin", |ui, label| {
        let mut value = THIN;
        let field = DragValue::new(&mut value).speed(SPEED * THIN).range(0.0..=1e3).update_while_editing(false);
        let field = ui.add(field.custom_formatter(|_, _| "by the rules".to_owned())).labelled_by(label);
        let by = field.on_hover_text("how thick its skin is: others lie so far off its outline");
        if by.changed() {
            sink.set(&by, MatterChange::Radius(value));
        }
    });
}

/// Whether its parts pass each other, where bodies meet themselves.
fn layers(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(layered) = matter.layered else { return };
    row(ui, "", |ui, _| {
        let mut is_layered = layered == matter.points;
        let words = "its parts are layers that pass each other, as the limbs of a figure do";
        let by = ticks::check(ui, &mut is_layered, "passes itself").on_hover_text(words);
        if by.changed() {
            sink.set(&by, MatterChange::Layered(is_layered));
        }
        if (1..matter.points).contains(&layered) {
            ui.label(RichText::new("some of it").color(colors(ui).weak));
        }
    });
}

/// Whether planes push out what has got into them, in place of contact, and how.
fn penalty(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(now) = matter.penalty else { return };
    row(ui, "", |ui, _| {
        let mut is_soft = now.is_some();
        let words = "what gets into it is pushed out, the harder the deeper it is, in place of contact";
        let by = ticks::check(ui, &mut is_soft, "soft ground").on_hover_text(words);
        if by.changed() {
            sink.set(&by, MatterChange::Penalty(is_soft.then_some(PUSHES)));
        }
    });
    let Some([stiffness, damping]) = now else { return };
    let one = |x: f64| Some(Span { least: x, most: x });
    number(ui, ("push", " N/m"), one(stiffness), sink, |x| Some(MatterChange::Penalty(Some([x, damping]))));
    number(ui, ("damping", " N s/m"), one(damping), sink, |x| Some(MatterChange::Penalty(Some([stiffness, x]))));
}

/// Whether it is drawn.
fn visible(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    row(ui, "", |ui, _| {
        let mut is_shown = matter.hidden == 0;
        let words = "what is hidden moves as before; the tool that selects shows its outline";
        let by = ticks::check(ui, &mut is_shown, "visible").on_hover_text(words);
        if by.changed() {
            sink.set(&by, MatterChange::Visible(is_shown));
        }
        if matter.hidden > 0 && matter.hidden < matter.points {
            ui.label(RichText::new("some of it").color(colors(ui).weak));
        }
    });
}

/// The colour of its own, or that which it is drawn in.
fn color(ui: &mut Ui, matter: &Matter, drawn: Option<[u8; 3]>, sink: &mut Sink<'_>) {
    let color = match matter.color {
        Coloring::One(color) => color,
        Coloring::Palette | Coloring::Mixed => drawn.unwrap_or([143, 166, 194]),
    };
    row(ui, "colour", |ui, label| {
        let words = "a picture is tinted by it: white leaves that as it is";
        if let Some((by, color)) = super::color::button(ui, color, label, words) {
            sink.set(&by, MatterChange::Color(color));
        }
        match matter.color {
            Coloring::Palette => _ = ui.label(RichText::new("its own").color(colors(ui).weak)),
            Coloring::Mixed => _ = ui.label(RichText::new("mixed").color(colors(ui).weak)),
            Coloring::One(_) => {}
        }
    });
}
