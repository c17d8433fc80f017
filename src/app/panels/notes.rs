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
        self.done.take_if(|done| done.since.elapsed() >= MOMENT);
        self.motor_for.take_if(|(_, since)| since.elapsed() >= MOTOR_OFFERED);
        if self.refused().is_some_and(|since| since.elapsed() >= REFUSED) {
            self.close();
        }
        let is_so = |line: &str, since: &Instant| !is_of_reach(line) || is_stretched(facts) || since.elapsed() < MOMENT;
        self.warnings.retain(|Said { line, since, .. }| since.elapsed() < WARNING && is_so(line, since));
        if places.is_covered {
            return self.show_below_sheet(context, places);
        }
        let mut top = places.bar_bottom().max(places.room.top() + APART);
        let complaint = self.complaint.as_ref().filter(|complaint| complaint.is_said(self.over));
        let complaint = complaint.map(|complaint| complaint.line.clone());
        // Beside a panel in a small window there is room for what is said of what is done alone.
        let is_caption_due = self.complaint.is_none() && self.done.is_none() && !places.is_crowded;
        let caption = facts.caption.filter(|_| is_caption_due && self.has_caption && self.offer.is_none());
        // Titles of worlds side by side lie below the caption, and all else that is said below the titles.
        let has_titles = !facts.neighbors.is_empty();
        if has_titles {
            if let Some(caption) = caption {
                top = self.caption(context, (places, top), (caption, facts.is_canvas), wishes);
            }
            top = top.max(titles_end(context, facts) + APART);
        }
        let mut is_read = false;
        if !self.warnings.is_empty() {
            let all = self.warnings.iter().map(|warning| &*warning.line).collect();
            let mut is_closed = None;
            top = words(context, (places, top), WARNED, |ui| is_closed = warned(ui, all));
            is_closed.into_iter().for_each(|place| _ = self.warnings.remove(place));
        }
        if let Some(line) = complaint {
            top = words(context, (places, top), COMPLAINT, |ui| is_read = complained(ui, &line));
        } else if let Some(done) = &self.done {
            top = words(context, (places, top), DONE, |ui| told(ui, &done.line));
        } else if let Some(caption) = caption.filter(|_| !has_titles) {
            top = self.caption(context, (places, top), (caption, facts.is_canvas), wishes);
        }
        if is_read {
            self.close();
        }
        if let Some((hub, _)) = self.motor_for.filter(|_| !facts.waits) {
            let mut is_taken = false;
            top = words(context, (places, top), MOTOR, |ui| is_taken = motor(ui));
            if is_taken {
                self.motor_for = None;
                wishes.push(Wish::GiveMotor(hub));
            }
        }
        // What lies over the world is done with first.
        if let Some(line) = self.offer.as_ref().filter(|_| !facts.waits) {
            words(context, (places, top), OFFER, |ui| offer(ui, line, wishes));
        }
        if let Some((at, line)) = self.hint {
            let id = Id::unique("hint");
            let size = context.memory(|memory| memory.area_rect(id)).map_or(HINT_SIZE, |rect| rect.size());
            let rect = kept_in(Rect::from_min_size(at + vec2(18.0, 18.0), size), Some(at), places.room);
            // What is said already lies there: nobody could read both.
            if lies_on_words(context, rect) {
                return;
            }
            let place = Area::new(id).order(egui::Order::Tooltip).interactable(false);
            place.fixed_pos(rect.min).show(context, |ui| {
                floating(ui).show(ui, |ui| ui.label(RichText::new(line).color(colors(ui).text)));
            });
        }
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
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use egui::pos2;
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::super::Sheet;
    use super::*;

    #[test]
    fn in_a_low_window_what_to_try_is_said_alone() {
        let high = |height: f32| {
            let context = egui::Context::default();
            let mut notes = Notes { has_caption: true, ..Notes::default() };
            let caption = Some(["a soft body falls, lands and wobbles for a while", "hold it up"]);
            let facts = Facts { caption, ..Facts::default() };
            for _ in 0..3 {
                let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(400.0, height)));
                let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
                let mut output = context.run_ui(input, |ui| {
                    let places = Places::new(ui.ctx().content_rect(), false);
                    notes.show(ui.ctx(), &places, &facts, &mut Vec::new());
                });
                output.textures_delta.clear();
            }
            context.memory(|memory| memory.area_rect(Id::unique(CAPTION))).unwrap().height()
        };
        assert!(high(180.0) + 14.0 < high(700.0), "{} {}", high(180.0), high(700.0));
    }

    #[test]
    fn the_hint_lies_over_nothing_that_is_said() {
        let context = egui::Context::default();
        let seen = |at: Pos2| {
            let mut notes = Notes { hint: Some((at, "press and drag")), ..Notes::default() };
            notes.warn("a line that is to be read".to_owned());
            for _ in 0..3 {
                let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(400.0, 320.0)));
                let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
                let mut output = context.run_ui(input, |ui| {
                    let places = Places::new(ui.ctx().content_rect(), false);
                    notes.show(ui.ctx(), &places, &Facts::default(), &mut Vec::new());
                });
                output.textures_delta.clear();
            }
            let layer = LayerId::new(egui::Order::Tooltip, Id::unique("hint"));
            context.memory(|memory| memory.areas().is_visible(&layer))
        };
        assert!(seen(pos2(200.0, 250.0)));
        let warned = context.memory(|memory| memory.area_rect(Id::unique(WARNED))).unwrap();
        assert!(!seen(warned.center() - vec2(30.0, 15.0)), "{warned}");
    }

    #[test]
    fn what_is_said_of_pins_too_far_apart_is_said_once() {
        let mut notes = Notes::default();
        let words = [
            "pins are led up to 2.3 m further apart than the bonds between them reach: these are strained (points 0 and 4)",
            "the pins are 1.1 m further apart than the bonds between them reach",
        ];
        words.into_iter().for_each(|line| notes.warn(line.to_owned()));
        assert!(notes.warnings.len() == 1 && notes.warnings[0].line == words[1], "{:?}", notes.warnings);
    }

    /// Which of what is said is on top where it stands, with a sheet in the middle or without.
    fn on_top(sheet: Option<Rect>) -> Vec<&'static str> {
        let context = egui::Context::default();
        let mut notes = Notes { offer: Some("a session was cut off".to_owned()), ..Notes::default() };
        notes.complain("it went wrong".to_owned(), Cover::default());
        for _ in 0..30 {
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
            let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
            let mut output = context.run_ui(input, |ui| {
                let room = ui.available_rect_before_wrap();
                let places = Places::new(room, sheet.is_some());
                notes.show(ui.ctx(), &places, &Facts { waits: sheet.is_some(), ..Facts::default() }, &mut Vec::new());
                if let Some(sheet) = sheet {
                    egui::Window::new("sheet").fixed_rect(sheet).show(ui.ctx(), |ui| ui.allocate_space(sheet.size()));
                }
            });
            output.textures_delta.clear();
        }
        let is_seen = |name: &&str| {
            let id = Id::unique(*name);
            let rect = context.memory(|memory| memory.area_rect(id));
            rect.is_some_and(|rect| context.layer_id_at(rect.center()).is_some_and(|layer| layer.id == id))
        };
        [COMPLAINT, OFFER].into_iter().filter(is_seen).collect()
    }

    #[test]
    fn over_a_sheet_what_is_said_of_it_is_seen_and_an_offer_waits() {
        assert_eq!(on_top(None), [COMPLAINT, OFFER]);
        let whole = Rect::from_min_max(pos2(20.0, 5.0), pos2(1260.0, 660.0));
        let narrow = whole.with_min_x(350.0).with_max_x(900.0);
        for sheet in [whole, narrow] {
            assert_eq!(on_top(Some(sheet)), [COMPLAINT], "{sheet}");
        }
    }

    #[test]
    fn what_is_said_of_a_sheet_covers_none_of_it() {
        use super::super::{PanelState, show};
        for size in [vec2(1280.0, 720.0), vec2(600.0, 450.0), vec2(420.0, 700.0)] {
            let sheets = [
                (Sheet::Gallery, "gallery"),
                (Sheet::Help, "keys"),
                (Sheet::SaveTo, "save to"),
                (Sheet::OpenFrom, "open from"),
            ];
            for (open, id) in sheets {
                let context = egui::Context::default();
                let mut state = PanelState { sheet: Some(open), ..PanelState::default() };
                state.notes.lie_under(Cover::Sheet(open));
                state.notes.warn("it is in the scene, but bodies pass through each other".to_owned());
                state
                    .notes
                    .complain("nothing is pasted: there is nothing on the clipboard".to_owned(), Cover::Sheet(open));
                for _ in 0..8 {
                    let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, size));
                    let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
                    let mut output = context.run_ui(input, |ui| _ = show(ui, &mut state, &Facts::default()));
                    output.textures_delta.clear();
                }
                let lies = |name: &str| context.memory(|memory| memory.area_rect(Id::unique(name)));
                let sheet = lies(id).unwrap();
                assert!(sheet.top() >= 0.0 && sheet.height() > 100.0, "{open:?} in {size}: {sheet}");
                for name in [WARNED, COMPLAINT] {
                    let own = lies(name).unwrap();
                    assert!(!own.intersects(sheet), "{name} over {open:?} in {size}: {own}, {sheet}");
                    assert!(own.bottom() <= size.y && own.left() >= 0.0, "{name} in {size}: {own}");
                }
            }
        }
    }

    #[test]
    fn what_was_done_before_a_sheet_opened_is_not_said_over_it_and_what_was_done_in_it_stays() {
        let keys = Cover::Sheet(Sheet::Help);
        let before = Said::now("Back to the start".to_owned(), Cover::Nothing);
        let within = Said::now("written".to_owned(), keys);
        assert_eq!([&before, &within].map(|said| said.is_said(keys)), [false, true]);
        assert_eq!([&before, &within].map(|said| said.is_said(Cover::Nothing)), [true, true]);
    }

    fn complaint(notes: &Notes) -> Option<&str> {
        notes.complaint.as_ref().map(|complaint| &*complaint.line)
    }

    #[test]
    fn what_was_refused_goes_with_the_next_try_or_by_itself_and_what_went_wrong_stays() {
        let mut notes = Notes::default();
        notes.refuse("no room".to_owned(), Cover::Nothing);
        assert!(notes.until().is_some_and(|until| until <= Instant::now() + REFUSED), "it goes by itself");
        notes.go_on();
        assert_eq!((complaint(&notes), notes.until()), (None, None));
        notes.say_of_tool("moved aside".to_owned(), Cover::Nothing);
        assert!(notes.until().is_some());
        notes.go_on();
        assert_eq!(notes.until(), None, "what a tool did goes with what is done next");
        notes.say("written".to_owned(), Cover::Nothing);
        notes.go_on();
        assert!(notes.done.take().is_some(), "what else was done stays its while");
        notes.refuse("no room".to_owned(), Cover::Nothing);
        notes.complain("the disk is full".to_owned(), Cover::Nothing);
        notes.go_on();
        assert_eq!((complaint(&notes), notes.until()), (Some("the disk is full"), None));
        assert!(notes.close() && !notes.close());
    }

    #[test]
    fn a_complaint_goes_with_the_dialog_that_it_was_made_in_and_with_the_next_one() {
        let dialogs =
            [Cover::Sheet(Sheet::OpenFrom), Cover::Sheet(Sheet::SaveTo), Cover::Sheet(Sheet::Help), Cover::Import];
        for own in dialogs.into_iter().chain([Cover::Nothing]) {
            for next in dialogs.into_iter().chain([Cover::Nothing]).filter(|next| *next != own) {
                let mut notes = Notes::default();
                notes.lie_under(own);
                notes.complain("it cannot be read".to_owned(), own);
                notes.lie_under(own);
                assert_eq!(complaint(&notes), Some("it cannot be read"), "{own:?}");
                notes.lie_under(next);
                assert_eq!(complaint(&notes), None, "of {own:?} over {next:?}");
            }
        }
    }

    #[test]
    fn what_is_to_be_known_of_a_scene_waits_below_what_lies_over_it() {
        let mut notes = Notes::default();
        notes.tell("bodies pass through each other".to_owned());
        let is_said = |notes: &Notes| notes.complaint.as_ref().map(|complaint| complaint.is_said(notes.over));
        for (over, says) in [(Cover::Nothing, true), (Cover::Sheet(Sheet::Gallery), false), (Cover::Import, false)] {
            notes.lie_under(over);
            assert_eq!(is_said(&notes), Some(says), "{over:?}");
        }
        notes.lie_under(Cover::Nothing);
        assert_eq!(is_said(&notes), Some(true), "and is there again");
    }

    #[test]
    fn a_warning_is_said_once_and_of_many_the_last_three() {
        let mut notes = Notes::default();
        for line in ["the pins are 1.2 m apart", "b", "the pins are 13 m apart"] {
            notes.warn(line.to_owned());
        }
        let said = |notes: &Notes| notes.warnings.iter().map(|said| said.line.clone()).collect::<Vec<_>>();
        assert_eq!(said(&notes), ["the pins are 13 m apart", "b"], "the newest first");
        ["c", "d"].into_iter().for_each(|line| notes.warn(line.to_owned()));
        assert_eq!(said(&notes), ["d", "c", "the pins are 13 m apart"]);
        assert!(notes.until().is_some(), "it goes by itself");
        notes.take_back(|line| line == "c");
        assert_eq!(said(&notes), ["c"], "what an undo took back is said no more");
        notes.begin();
        assert_eq!(notes.until(), None);
    }

    #[test]
    fn a_motor_is_offered_for_a_wheel_until_it_is_taken_or_something_else_is_done() {
        let shown = |ui: &mut egui::Ui, (notes, wishes): &mut (Notes, Vec<Wish>)| {
            let places = Places::new(ui.ctx().content_rect(), false);
            notes.show(ui.ctx(), &places, &Facts::default(), wishes);
        };
        let hub = PointId(7);
        let mut notes = Notes::default();
        notes.offer_motor(Some(hub));
        assert!(notes.until().is_some(), "it goes by itself");
        let mut panel = Harness::builder().with_size([900.0, 600.0]).build_ui_state(shown, (notes, Vec::new()));
        panel.run_steps(4);
        panel.get_by_label("Give it a motor").click();
        panel.run_steps(4);
        assert_eq!(panel.state().1, [Wish::GiveMotor(hub)]);
        assert!(panel.query_by_label("Give it a motor").is_none(), "it is taken");
        let mut notes = Notes::default();
        let other: [fn(&mut Notes); 3] =
            [|notes| notes.offer_motor(None), |notes| notes.take_back(|_| true), Notes::begin];
        for done in other {
            notes.offer_motor(Some(hub));
            done(&mut notes);
            assert_eq!(notes.until(), None);
        }
    }
}
