//! What the program says: faults until they are read, what was just done for a moment, what to try until something is tried.

use std::time::{Duration, Instant};

use egui::{Align2, Area, Button, Id, Label, LayerId, Pos2, Rect, RichText, vec2};

use super::beside::titles_end;
use super::complaint::{Complaint, Cover};
use super::hud::STRETCHED;
use super::places::{APART, Places, kept_in};
use super::theme::{colors, floating};
use super::{Facts, Wish, button, sheet};
use crate::app::action::Action;
use crate::app::warnings::seen;
use crate::sim::PointId;

/// What was just done is said so long, and what an edit warned of.
const MOMENT: Duration = Duration::from_secs(4);
const WARNING: Duration = Duration::from_secs(9);
/// So is what was refused, unless something else is pressed before.
const REFUSED: Duration = Duration::from_secs(9);
/// A motor is offered so long, unless something else is done before.
const MOTOR_OFFERED: Duration = Duration::from_secs(20);
/// Warnings that are shown at most.
const MOST_WARNINGS: usize = 3;
/// In a warning of pins that are led too far apart, which is said only while that is so, and as they are led.
const OF_REACH: &str = "further apart than the bonds between them reach";

/// What is to be said.
#[derive(Debug, Default)]
pub(in crate::app) struct Notes {
    /// What went wrong, or should be known: until it is closed.
    complaint: Option<Complaint>,
    /// What lies over the world.
    over: Cover,
    /// A session that was cut off, which can be gone on with.
    pub(in crate::app) offer: Option<String>,
    /// The hub of a wheel that just came without a motor, and when.
    motor_for: Option<(PointId, Instant)>,
    /// What was just done.
    done: Option<Said>,
    /// What edits warned of, the newest first.
    warnings: Vec<Said>,
    /// Nobody has touched this scene yet: its caption is shown.
    pub(in crate::app) has_caption: bool,
    /// Width of the room in which the caption of this scene was last shown, and where it ended `[points]`.
    caption_end: Option<(f32, f32)>,
    /// Nobody has touched anything yet: a line at the cursor says how, where the cursor is `[points]`.
    pub(in crate::app) hint: Option<(Pos2, &'static str)>,
}

/// A line that goes by itself.
#[derive(Debug)]
struct Said {
    line: String,
    /// When it was said, and what lay over the world then.
    since: Instant,
    over: Cover,
    /// It is of what a tool did: what is done next is another thing.
    is_of_tool: bool,
}

impl Said {
    fn now(line: String, over: Cover) -> Self {
        Said { line, since: Instant::now(), over, is_of_tool: false }
    }

    /// Whether it is said where this lies over the world: a sheet that opens is not about what was done before it.
    fn is_said(&self, over: Cover) -> bool {
        over == Cover::Nothing || over == self.over
    }
}

/// Whether a warning is of pins that are led too far apart.
fn is_of_reach(line: &str) -> bool {
    line.contains(OF_REACH)
}

/// Whether what keeps its length is stretched.
fn is_stretched(facts: &Facts) -> bool {
    facts.stretch.is_some_and(|stretch| stretch >= STRETCHED)
}

/// A line whatever its numbers are.
fn digitless(line: &str) -> String {
    line.chars().filter(|sign| !sign.is_ascii_digit() && *sign != '.').collect()
}

/// Words that are less wide stand above their button, not beside it `[points]`.
const NARROW: f32 = 200.0;

/// Where less than this is left below the buttons, of what is seen and what to try the second is said alone `[points]`.
const LOW: f32 = 200.0;
/// The size of the line at the cursor until it was shown, about `[points]`.
const HINT_SIZE: egui::Vec2 = vec2(220.0, 28.0);

impl Notes {
    /// Says what went wrong while this lay over the world: until it is closed, or something else lies there.
    pub(in crate::app) fn complain(&mut self, line: String, over: Cover) {
        self.complaint = Some(Complaint::of_deed(line, over, None));
    }

    /// Says why something was not done: until something else is tried, or for a while.
    pub(in crate::app) fn refuse(&mut self, line: String, over: Cover) {
        self.complaint = Some(Complaint::of_deed(line, over, Some(Instant::now())));
    }

    /// Says what should be known of the scene: until it is closed, and not over what lies over the scene.
    pub(in crate::app) fn tell(&mut self, line: String) {
        self.complaint = Some(Complaint::of_scene(line));
    }

    /// This lies over the world: what was said of something else there goes.
    pub(super) fn lie_under(&mut self, over: Cover) {
        self.complaint.take_if(|complaint| complaint.is_past(over));
        self.over = over;
    }

    /// What went wrong is read. Returns whether anything was said of it.
    pub(in crate::app) fn close(&mut self) -> bool {
        self.complaint.take().is_some()
    }

    /// Since when something is said that was refused.
    fn refused(&self) -> Option<Instant> {
        self.complaint.as_ref().and_then(|complaint| complaint.refused)
    }

    /// Something else is tried: what was refused before is said no more, nor what a tool did.
    pub(in crate::app) fn go_on(&mut self) {
        self.done.take_if(|done| done.is_of_tool);
        if self.refused().is_some() {
            self.close();
        }
    }

    /// Says what was just done while this lay over the world.
    pub(in crate::app) fn say(&mut self, line: String, over: Cover) {
        self.done = Some(Said::now(line, over));
    }

    /// Says what a tool just did: until something else is done.
    pub(in crate::app) fn say_of_tool(&mut self, line: String, over: Cover) {
        self.done = Some(Said { is_of_tool: true, ..Said::now(line, over) });
    }

    /// Says what is to be known of what was just done, above that. The same is said once, whatever its numbers are.
    pub(in crate::app) fn warn(&mut self, line: String) {
        // Commands and worlds say the same of pins in words of their own.
        let bare = |line: &str| match is_of_reach(line) {
            true => OF_REACH.to_owned(),
            false => digitless(line),
        };
        let own = bare(&line);
        self.warnings.retain(|other| bare(&other.line) != own);
        self.warnings.insert(0, Said::now(line, self.over));
        self.warnings.truncate(MOST_WARNINGS);
    }

    /// Something else was done: a motor is offered for a wheel that came with it, and for no other.
    pub(in crate::app) fn offer_motor(&mut self, hub: Option<PointId>) {
        self.motor_for = hub.map(|hub| (hub, Instant::now()));
    }

    /// Another scene: what was said of the last one goes.
    pub(in crate::app) fn begin(&mut self) {
        self.motor_for = None;
        self.warnings.clear();
        self.caption_end = None;
    }

    /// An edit was undone: what was warned of goes, but for what is so still.
    pub(in crate::app) fn take_back(&mut self, is_so: impl Fn(&str) -> bool) {
        self.motor_for = None;
        self.warnings.retain(|warning| is_so(&warning.line));
    }

    /// Where the caption of the scene ends, also when it is gone, so that nothing moves then; until the room has another width `[points]`.
    pub(super) fn caption_end(&self, room: Rect) -> Option<f32> {
        self.caption_end.filter(|(width, _)| *width == room.width()).map(|(_, end)| end)
    }

    /// When something that is said is to go by itself.
    pub(in crate::app) fn until(&self) -> Option<Instant> {
        let ends = |said: &Said, long| said.since.checked_add(long);
        let done = self.done.iter().filter_map(|done| ends(done, MOMENT));
        let refused = self.refused().and_then(|since| since.checked_add(REFUSED));
        let motor = self.motor_for.and_then(|(_, since)| since.checked_add(MOTOR_OFFERED));
        done.chain(refused).chain(motor).chain(self.warnings.iter().filter_map(|warning| ends(warning, WARNING))).min()
    }

    /// Says it below the buttons, one below another, where nothing else is; below a sheet, which makes way, what is said of that.
    pub(super) fn show(&mut self, context: &egui::Context, places: &Places, facts: &Facts, wishes: &mut Vec<Wish>) {
        self.pass(is_stretched(facts));
        if places.is_covered {
            return self.show_below_sheet(context, places);
        }
        let mut top = places.bar_bottom().max(places.room.top() + APART);
        // Beside a panel in a small window there is room for what is said of what is done alone.
        let is_caption_due = self.complaint.is_none() && self.done.is_none() && !places.is_crowded;
        let mut caption = facts.caption.filter(|_| is_caption_due && self.has_caption && self.offer.is_none());
        // Titles of worlds side by side lie below the caption, and all else that is said below the titles.
        if !facts.neighbors.is_empty() {
            if let Some(caption) = caption.take() {
                top = self.caption(context, (places, top), (caption, facts.is_canvas), wishes);
            }
            top = top.max(titles_end(context, facts) + APART);
        }
        top = self.show_warnings(context, (places, top));
        top = match caption {
            Some(caption) => self.caption(context, (places, top), (caption, facts.is_canvas), wishes),
            None => self.show_deed(context, (places, top)),
        };
        // What lies over the world is done with first.
        if !facts.waits {
            self.show_offers(context, (places, top), wishes);
        }
        self.show_hint(context, places.room);
    }

    /// What was said for long enough goes; a warning of pins that are led too far apart goes once nothing `is_stretched`.
    fn pass(&mut self, is_stretched: bool) {
        self.done.take_if(|done| done.since.elapsed() >= MOMENT);
        self.motor_for.take_if(|(_, since)| since.elapsed() >= MOTOR_OFFERED);
        if self.refused().is_some_and(|since| since.elapsed() >= REFUSED) {
            self.close();
        }
        let is_so = |line: &str, since: &Instant| !is_of_reach(line) || is_stretched || since.elapsed() < MOMENT;
        self.warnings.retain(|Said { line, since, .. }| since.elapsed() < WARNING && is_so(line, since));
    }

    /// What edits warned of, from a height on. Returns where what is said next begins `[points]`.
    fn show_warnings(&mut self, context: &egui::Context, (places, top): (&Places, f32)) -> f32 {
        if self.warnings.is_empty() {
            return top;
        }
        let all = self.warnings.iter().map(|warning| &*warning.line).collect();
        let mut is_closed = None;
        let end = words(context, (places, top), WARNED, |ui| is_closed = warned(ui, all));
        is_closed.into_iter().for_each(|place| _ = self.warnings.remove(place));
        end
    }

    /// What went wrong, else what was just done, from a height on. Returns where what is said next begins `[points]`.
    fn show_deed(&mut self, context: &egui::Context, (places, top): (&Places, f32)) -> f32 {
        let complaint = self.complaint.as_ref().filter(|complaint| complaint.is_said(self.over));
        let Some(line) = complaint.map(|complaint| complaint.line.clone()) else {
            let done = self.done.as_ref();
            return done.map_or(top, |done| words(context, (places, top), DONE, |ui| told(ui, &done.line)));
        };
        let mut is_read = false;
        let end = words(context, (places, top), COMPLAINT, |ui| is_read = complained(ui, &line));
        if is_read {
            self.close();
        }
        end
    }

    /// A motor for a wheel that just came, and a session that was cut off, from a height on.
    fn show_offers(&mut self, context: &egui::Context, (places, mut top): (&Places, f32), wishes: &mut Vec<Wish>) {
        if let Some((hub, _)) = self.motor_for {
            let mut is_taken = false;
            top = words(context, (places, top), MOTOR, |ui| is_taken = motor(ui));
            if is_taken {
                self.motor_for = None;
                wishes.push(Wish::GiveMotor(hub));
            }
        }
        if let Some(line) = &self.offer {
            words(context, (places, top), OFFER, |ui| offer(ui, line, wishes));
        }
    }

    /// The line at the cursor, unless what is said already lies there: nobody could read both.
    fn show_hint(&self, context: &egui::Context, room: Rect) {
        let Some((at, line)) = self.hint else { return };
        let id = Id::unique("hint");
        let size = context.memory(|memory| memory.area_rect(id)).map_or(HINT_SIZE, |rect| rect.size());
        let rect = kept_in(Rect::from_min_size(at + vec2(18.0, 18.0), size), Some(at), room);
        if lies_on_words(context, rect) {
            return;
        }
        let place = Area::new(id).order(egui::Order::Tooltip).interactable(false);
        place.fixed_pos(rect.min).show(context, |ui| {
            floating(ui).show(ui, |ui| ui.label(RichText::new(line).color(colors(ui).text)));
        });
    }

    /// Says what is of the sheet that lies over the world, and no more: along the lower edge, one line above another.
    fn show_below_sheet(&mut self, context: &egui::Context, places: &Places) {
        let lowest = places.room.bottom() - APART;
        let mut bottom = lowest;
        let over = self.over;
        let complaint = self.complaint.as_ref().filter(|complaint| complaint.is_said(over));
        if let Some(line) = complaint.map(|complaint| complaint.line.clone()) {
            let mut is_read = false;
            bottom = words_above(context, (places, bottom), COMPLAINT, |ui| is_read = complained(ui, &line));
            if is_read {
                self.close();
            }
        } else if let Some(done) = self.done.as_ref().filter(|done| done.is_said(over)) {
            bottom = words_above(context, (places, bottom), DONE, |ui| told(ui, &done.line));
        }
        let own: Vec<usize> = (0..self.warnings.len()).filter(|place| self.warnings[*place].is_said(over)).collect();
        if !own.is_empty() {
            let all = own.iter().map(|place| &*self.warnings[*place].line).collect();
            let mut is_closed = None;
            bottom = words_above(context, (places, bottom), WARNED, |ui| is_closed = warned(ui, all));
            is_closed.into_iter().for_each(|place: usize| _ = self.warnings.remove(own[place]));
        }
        sheet::keep_above(context, if bottom < lowest { places.room.bottom() - bottom } else { 0.0 });
    }

    /// What is seen and what to try, from a height on. Returns where what is said next begins `[points]`.
    fn caption(
        &mut self,
        context: &egui::Context,
        (places, top): (&Places, f32),
        ([seen, to_try], is_canvas): ([&str; 2], bool),
        wishes: &mut Vec<Wish>,
    ) -> f32 {
        // Both would cover what they are about.
        let is_low = places.room.bottom() - top < LOW;
        let top = words(context, (places, top), CAPTION, |ui| {
            if !is_low {
                ui.add(Label::new(RichText::new(seen).color(colors(ui).text)).wrap());
            }
            ui.add(Label::new(RichText::new(format!("Try: {to_try}")).color(colors(ui).weak)).wrap());
        });
        self.caption_end = Some((places.room.width(), top));
        if !is_canvas {
            return top;
        }
        words(context, (places, top), CANVAS, |ui| {
            button(ui, "Open the canvas", "paint over the body", Action::Paint, wishes);
        })
    }
}

/// What is said, by its names.
const COMPLAINT: &str = "complaint";
const WARNED: &str = "warned";
const DONE: &str = "done";
const CAPTION: &str = "caption";
const CANVAS: &str = "canvas of the scene";
const OFFER: &str = "offer";
const MOTOR: &str = "motor for a wheel";

/// All that is said below the buttons.
const ALL: [&str; 7] = [COMPLAINT, WARNED, DONE, CAPTION, CANVAS, OFFER, MOTOR];

/// Whether something that floats is said here.
pub(super) fn is_own(id: Id) -> bool {
    ALL.into_iter().chain(["hint"]).any(|name| Id::unique(name) == id)
}

/// Whether something that is said lies in a place.
fn lies_on_words(context: &egui::Context, place: Rect) -> bool {
    let lies = |name: &str| {
        let layer = LayerId::new(egui::Order::Middle, Id::unique(name));
        context.memory(|memory| {
            memory.areas().is_visible(&layer) && memory.area_rect(layer.id).is_some_and(|rect| rect.intersects(place))
        })
    };
    ALL.into_iter().any(lies)
}

/// What edits warned of, each with a button that closes it. Returns the place of one that is closed.
fn warned(ui: &mut egui::Ui, warnings: Vec<&str>) -> Option<usize> {
    let mut is_closed = None;
    for (place, warning) in warnings.into_iter().enumerate() {
        let is_narrow = ui.available_width() < NARROW;
        let said = |ui: &mut egui::Ui| ui.add(Label::new(RichText::new(seen(warning)).color(colors(ui).text)).wrap());
        ui.horizontal(|ui| {
            if ui.small_button("×").on_hover_text("close").clicked() {
                is_closed = Some(place);
            }
            ui.label(RichText::new("!").color(colors(ui).lead).strong());
            if !is_narrow {
                said(ui);
            }
        });
        if is_narrow {
            said(ui);
        }
    }
    is_closed
}

/// What went wrong, with a button that closes it. Returns whether that was pressed.
fn complained(ui: &mut egui::Ui, line: &str) -> bool {
    let words = |ui: &mut egui::Ui| {
        ui.label(RichText::new("!").color(colors(ui).away).strong());
        ui.add(Label::new(RichText::new(line).color(colors(ui).text)).wrap());
    };
    if ui.available_width() < NARROW {
        ui.vertical(words);
        return ui.button("Close").clicked();
    }
    let both = ui.horizontal(|ui| {
        let is_read = ui.button("Close").clicked();
        words(ui);
        is_read
    });
    both.inner
}

/// What was just done.
fn told(ui: &mut egui::Ui, line: &str) {
    ui.add(Label::new(RichText::new(line).color(colors(ui).accent)).wrap());
}

/// A wheel that was joined to a body can be driven. Returns whether it is to be.
fn motor(ui: &mut egui::Ui) -> bool {
    let said = "the wheel is joined and turns freely";
    ui.add(Label::new(RichText::new(said).color(colors(ui).text)).wrap());
    let give = Button::new(RichText::new("Give it a motor").color(colors(ui).on_accent)).fill(colors(ui).accent);
    ui.add(give)
        .on_hover_text("as the panel of this tool has it; once it is selected (6), its panel sets it too")
        .clicked()
}

/// A session that was cut off.
fn offer(ui: &mut egui::Ui, line: &str, wishes: &mut Vec<Wish>) {
    ui.add(Label::new(RichText::new(line).color(colors(ui).text)).wrap());
    ui.horizontal_wrapped(|ui| {
        let go_on = Button::new(RichText::new("Go on with it").color(colors(ui).on_accent)).fill(colors(ui).accent);
        if ui.add(go_on).clicked() {
            wishes.push(Wish::GoOnWithLeftover(0));
        }
        if ui.button("Later").on_hover_text("the gallery has it").clicked() {
            wishes.push(Wish::PutOffLeftover);
        }
        if ui.button("Discard").clicked() {
            wishes.push(Wish::DiscardLeftover(0));
        }
    });
}

/// A few words from a height on, where there is room. Returns where what is said next begins `[points]`.
fn words(context: &egui::Context, (places, top): (&Places, f32), name: &str, add: impl FnOnce(&mut egui::Ui)) -> f32 {
    let (at, width) = places.said(context, top);
    let place = Area::new(Id::unique(name)).pivot(Align2::CENTER_TOP).fixed_pos(at);
    framed(context, place, (name, width), add).bottom() + APART
}

/// The same down to a height, while a sheet lies over the world. Returns where what is said above that ends `[points]`.
fn words_above(
    context: &egui::Context,
    (places, bottom): (&Places, f32),
    name: &str,
    add: impl FnOnce(&mut egui::Ui),
) -> f32 {
    let (at, width) = places.said_below(bottom);
    let place = Area::new(Id::unique(name)).order(egui::Order::Foreground).pivot(Align2::CENTER_BOTTOM).fixed_pos(at);
    framed(context, place, (name, width), add).top() - APART
}

/// A few words in a frame, no wider than that. Returns where they lie `[points]`.
fn framed(context: &egui::Context, place: Area, (name, width): (&str, f32), add: impl FnOnce(&mut egui::Ui)) -> Rect {
    let can_be_pressed = [COMPLAINT, WARNED, CANVAS, OFFER, MOTOR].contains(&name);
    let shown = place.interactable(can_be_pressed).show(context, |ui| {
        floating(ui).show(ui, |ui| {
            ui.set_max_width(width - 20.0);
            ui.vertical_centered(add);
        });
    });
    shown.response.rect
}

#[cfg(test)]
#[path = "notes_tests.rs"]
mod tests;
