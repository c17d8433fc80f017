//! What is said, for how long, and what goes on by a click.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

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
            state.notes.complain("nothing is pasted: there is nothing on the clipboard".to_owned(), Cover::Sheet(open));
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
    let other: [fn(&mut Notes); 3] = [|notes| notes.offer_motor(None), |notes| notes.take_back(|_| true), Notes::begin];
    for done in other {
        notes.offer_motor(Some(hub));
        done(&mut notes);
        assert_eq!(notes.until(), None);
    }
}
