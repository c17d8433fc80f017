//! The bar at the bottom: play, step, back; the pace; the time, and the line of what was seen.

use egui::{Align, Label, Layout, Rect, RichText, Role, Slider, WidgetInfo, vec2};

use super::choosing::choice;
use super::fewer::{shorter, that_fits};
use super::icons::{self, Icon};
use super::steady::steady;
use super::theme::colors;
use super::waiting::is_said;
use super::{At, Facts, Wish, described, icon, moving, short, timelines};
use crate::app::action::Action;
use crate::app::player::{Figures, LONGEST_FRAME};
use crate::lessons::lessons;

/// The paces that can be chosen.
pub(in crate::app) const PACES: [(f64, &str); 6] =
    [(0.125, "1/8"), (0.25, "1/4"), (0.5, "1/2"), (1.0, "1"), (2.0, "2"), (4.0, "4")];

/// Returns where the line of what was seen is, if there is room for it.
pub(super) fn show(ui: &mut egui::Ui, left: &mut Option<At>, facts: &Facts, wishes: &mut Vec<Wish>) -> Option<Rect> {
    let frame = egui::Frame::new().fill(colors(ui).panel).inner_margin(egui::Margin::symmetric(12, 7));
    let panel = egui::Panel::bottom("transport").resizable(false).frame(frame).show_separator_line(false);
    let panel = panel.show(ui, |ui| {
        ui.horizontal(|ui| {
            play(ui, facts, wishes);
            icon(ui, Icon::Step, "one frame on", Action::Step, wishes);
            icon(ui, Icon::Reset, "back to the start", Action::Reset, wishes);
            ui.add_space(4.0);
            pace(ui, facts, wishes);
            ui.add_space(4.0);
            ui.monospace(format!("{:7.2} s", facts.figures.time));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                // Always of one width, so that the line stays where it is while it is pressed on.
                let room = ui.available_width();
                let width = STATE.min(if room < NARROW { 0.2 } else { 0.45 } * room);
                let size = vec2(width, ui.spacing().interact_size.y);
                ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
                    ui.set_min_width(width);
                    let now = state(facts);
                    let is_same = |a: &(String, bool), b: &(String, bool)| kind(&a.0) == kind(&b.0) || a.1;
                    let is_urgent = now.1 || facts.waits;
                    let (words, matters) = steady(ui.ctx(), "how it stands", (now, is_urgent), is_same);
                    let words = that_fits(ui, shorter(&words), width);
                    let words = RichText::new(words).color(if matters { colors(ui).accent } else { colors(ui).weak });
                    ui.add(Label::new(words).truncate());
                });
                moving::show(ui, facts, wishes);
                way_back(ui, left, wishes);
                timelines::show(ui, facts, wishes);
                timeline(ui, facts, wishes)
            })
            .inner
        })
        .inner
    });
    panel.inner
}

/// Width of the words on how it stands `[points]`.
const STATE: f32 = 290.0;
/// Room for these words, for notes and for the line of time below which the words make way `[points]`.
const NARROW: f32 = 560.0;
/// Work that slows a scene down takes most of a frame at least `[s]`.
const LEAST_CAUSE: f64 = 0.75 / 60.0;

fn play(ui: &mut egui::Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
    let (sign, name) = if facts.figures.playing { (Icon::Pause, "pause") } else { (Icon::Play, "play") };
    let button = icons::button(ui, sign, name, vec2(46.0, 30.0), true);
    if button.on_hover_text(described(name, Action::TogglePlay)).clicked() {
        wishes.push(Wish::Act(Action::TogglePlay));
    }
}

fn pace(ui: &mut egui::Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
    let name = |pace: f64| {
        let known = PACES.iter().find(|(value, _)| *value == pace);
        known.map_or_else(|| format!("{pace:.2} x"), |(_, name)| format!("{name} x"))
    };
    let menu = egui::ComboBox::from_id_salt("pace").selected_text(name(facts.pace)).width(58.0).show_ui(ui, |ui| {
        for (value, _) in PACES {
            if choice(ui, value == facts.pace, name(value)).clicked() {
                wishes.push(Wish::Pace(value));
            }
        }
    });
    menu.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "pace"));
}

/// To the step of a lesson that was left for another scene.
fn way_back(ui: &mut egui::Ui, left: &mut Option<At>, wishes: &mut Vec<Wish>) {
    let Some(at) = *left else { return };
    let Some(lesson) = lessons().get(at.lesson) else { return };
    if icons::button(ui, Icon::Close, "stay here: do not go back to the lesson", icons::SMALL, false)
        .on_hover_text("stay here")
        .clicked()
    {
        *left = None;
    }
    let said = format!("{}, step {} of {}", lesson.title, at.step + 1, lesson.steps.len());
    if ui.button("Back to the lesson").on_hover_text(said).clicked() {
        wishes.push(Wish::Learn(at));
    }
}

/// The line of what was seen already; dragging on it goes back.
fn timeline(ui: &mut egui::Ui, facts: &Facts, wishes: &mut Vec<Wish>) -> Option<Rect> {
    let end = facts.figures.end.max(facts.figures.time);
    let room = ui.available_width() - 12.0;
    if end <= 0.0 || room < 60.0 {
        return None;
    }
    ui.spacing_mut().slider_width = room;
    // Where it goes to it stands already.
    let mut time = facts.going.as_ref().and_then(|going| going.to).unwrap_or(facts.figures.time);
    let slider = Slider::new(&mut time, 0.0..=end).show_value(false).trailing_fill(true);
    let line = ui.add(slider);
    line.widget_info(|| WidgetInfo::slider(true, time, "time"));
    let line = line.on_hover_text("what was seen: drag to go back");
    if line.dragged() || line.clicked() {
        wishes.push(Wish::GoTo(time));
    }
    Some(line.rect)
}

/// What words say, whatever their numbers are.
fn kind(words: &str) -> &str {
    words.trim_start_matches(|sign: char| sign.is_ascii_digit())
}

/// In words how it stands, and whether that matters.
fn state(facts: &Facts) -> (String, bool) {
    let figures = &facts.figures;
    if facts.is_opening {
        return ("opening ...".to_owned(), true);
    }
    if facts.waits {
        return ("paused while this is open".to_owned(), false);
    }
    if let Some(going) = facts.going.as_ref().filter(|going| is_said(going)) {
        return (going.words.clone(), true);
    }
    let is_slow = !figures.asleep && figures.pace > 0.0 && figures.pace < 0.95;
    match (figures.playing, figures.asleep) {
        (false, _) => (at_end(figures).unwrap_or_else(|| "paused".to_owned()), true),
        // What sleeps takes no step, however long nobody has heard of it.
        (true, true) => ("at rest".to_owned(), false),
        // Back in time, and on to where it was, it is worked out from the nearest moment that is kept.
        (true, false) if facts.is_busy && figures.time < figures.end => ("working out that moment".to_owned(), false),
        // One that is known to be slow is told how slow, however long its steps are.
        (true, false) if facts.is_busy && !is_slow => ("computing a long step".to_owned(), false),
        (true, false) if figures.follows => ("replay: press to take over".to_owned(), true),
        (true, false) if is_slow => (slow_motion(facts), false),
        (true, false) if figures.yielded.is_some() => ("computed more roughly, to keep up".to_owned(), false),
        (true, false) => (String::new(), false),
    }
}

/// Half of the last digit of the time that is shown `[s]`.
const SHOWN: f64 = 0.005;

/// That it stands at its end or past it, in words; `None` where it does not: time goes no further by itself then.
pub(in crate::app) fn at_end(figures: &Figures) -> Option<String> {
    if figures.ended {
        let end = figures.clock.duration.unwrap_or(figures.time);
        return Some(format!("the end of its {} s: R plays it again", plain(end)));
    }
    let end = figures.clock.duration.filter(|end| figures.time >= *end)?;
    // What begins anew there stands at its end, and so does what is past it by less than the time that is shown says.
    if figures.time - end < SHOWN {
        return Some(format!("the end of its {} s: R plays it again", plain(end)));
    }
    Some(format!("past its end of {} s: R plays it again", plain(end)))
}

/// A time `[s]` to a tenth of a millisecond, without zeros that say nothing.
fn plain(seconds: f64) -> String {
    let digits = format!("{seconds:.4}");
    digits.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A share of the speed that was asked for `[1]`, in words.
pub(in crate::app) fn speed(pace: f64) -> String {
    match 100.0 * pace {
        percent if percent < 1.0 => "less than 1 % of its speed".to_owned(),
        percent if (45.0..55.0).contains(&percent) => "half speed".to_owned(),
        percent => format!("{percent:.0} % of its speed"),
    }
}

/// How slow it is, and for what.
fn slow_motion(facts: &Facts) -> String {
    let figures = &facts.figures;
    let speed = speed(figures.pace);
    // A picture that takes longer than time is made up for drops time, however quick steps are.
    let drawing = facts.frame - figures.step;
    if facts.frame > LONGEST_FRAME && drawing > figures.step {
        format!("{speed}: {} of drawing a frame", short(drawing))
    } else if figures.work > LEAST_CAUSE {
        format!("{speed}: {} of work a frame", short(figures.work))
    } else {
        // Neither takes that long: something else keeps the machine busy.
        speed
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::theme;
    use super::*;
    use crate::app::player::{Moved, Movers};
    use crate::history::Clock;
    use crate::sim::Why;

    #[test]
    fn the_end_of_a_duration_is_said() {
        let figures = Figures { time: 31.415_926, ended: true, playing: false, ..Figures::default() };
        let facts = Facts { figures, ..Facts::default() };
        assert_eq!(state(&facts).0, "the end of its 31.4159 s: R plays it again");
        let even = |time| {
            let figures = Figures { time, ended: true, playing: false, ..Figures::default() };
            state(&Facts { figures, ..Facts::default() }).0
        };
        assert_eq!(even(20.000_000_004), "the end of its 20 s: R plays it again");
        assert_eq!(even(0.5), "the end of its 0.5 s: R plays it again");
        let clock = Clock { rate: 1.0, duration: Some(20.0) };
        let past = |time, playing| {
            let figures = Figures { time, clock, playing, pace: 1.0, ..Figures::default() };
            state(&Facts { figures, ..Facts::default() }).0
        };
        assert_eq!(past(20.0, false), "the end of its 20 s: R plays it again");
        assert_eq!(past(20.004, false), "the end of its 20 s: R plays it again", "the time that is shown is 20.00 s");
        assert_eq!(past(46.0, false), "past its end of 20 s: R plays it again");
        assert_eq!((past(46.0, true).as_str(), past(19.0, false).as_str()), ("", "paused"));
    }

    #[test]
    fn the_line_of_time_has_room_in_a_narrow_window_beside_notes() {
        let moved = Moved { why: Why::Contact, islands: 2, since: [0.0; 2] };
        let movers = Arc::new(Movers { moved: vec![moved], islands: 2, can_be_exact: false });
        let facts = Facts {
            figures: Figures { time: 4.0, end: 4.0, playing: true, movers, ..Figures::default() },
            ..Facts::default()
        };
        for width in [720.0, 1280.0] {
            let context = egui::Context::default();
            theme::apply(&context, Default::default());
            let screen = Rect::from_min_size(egui::Pos2::ZERO, vec2(width, 720.0));
            let mut line = None;
            for _ in 0..3 {
                let input = egui::RawInput { screen_rect: Some(screen), ..egui::RawInput::default() };
                let mut output = context.run_ui(input, |ui| line = show(ui, &mut None, &facts, &mut Vec::new()));
                output.textures_delta.clear();
            }
            let line = line.map_or(0.0, |line| line.width());
            assert!(line > 90.0, "{width}: {line}");
        }
    }

    #[test]
    fn a_world_behind_a_panel_waits_and_has_no_pace() {
        let figures = Figures { playing: true, pace: 0.0, ..Figures::default() };
        let facts = Facts { figures, waits: true, ..Facts::default() };
        assert_eq!(state(&facts).0, "paused while this is open");
        let slow = Facts { waits: false, ..facts };
        assert_eq!(
            state(&Facts { figures: Figures { pace: 0.004, ..slow.figures.clone() }, ..slow }).0,
            "less than 1 % of its speed"
        );
    }

    #[test]
    fn it_is_said_whether_steps_or_pictures_take_long() {
        let figures = Figures { playing: true, pace: 0.5, step: 0.025, work: 0.041, ..Figures::default() };
        let words = |frame: f64| state(&Facts { figures: figures.clone(), frame, ..Facts::default() }).0;
        assert_eq!(words(0.05), "half speed: 41 ms of work a frame");
        assert_eq!(words(0.2), "half speed: 175 ms of drawing a frame");
        let quick = Figures { work: 0.007, step: 0.007, ..figures.clone() };
        let of_nothing = Facts { figures: quick, frame: 0.017, ..Facts::default() };
        assert_eq!(state(&of_nothing).0, "half speed", "7 ms are no cause");
        let long = |figures: &Figures| state(&Facts { figures: figures.clone(), is_busy: true, ..Facts::default() }).0;
        assert_eq!(
            long(&figures),
            "half speed: 41 ms of work a frame",
            "how slow it is says more than that a step is long"
        );
        let quick = Figures { pace: 1.0, ..figures.clone() };
        assert_eq!(long(&quick), "computing a long step");
        assert_eq!(long(&Figures { time: 2.0, end: 5.0, ..quick.clone() }), "working out that moment");
        assert_eq!(long(&Figures { asleep: true, ..quick }), "at rest");
    }

    #[test]
    fn the_line_of_what_was_seen_stays_where_it_is() {
        let moved = |why: Why, islands: usize| Moved { why, islands, since: [0.0; 2] };
        let with = |pace: f64, asleep: bool, moved: Vec<Moved>| {
            let movers = Arc::new(Movers { moved, islands: 12, can_be_exact: true });
            let figures = Figures { time: 3.0, end: 9.0, playing: true, pace, asleep, movers, ..Figures::default() };
            let facts = Facts { figures, pace: 1.0, ..Facts::default() };
            let screen = Rect::from_min_size(egui::Pos2::ZERO, vec2(1180.0, 800.0));
            let input = egui::RawInput { screen_rect: Some(screen), ..egui::RawInput::default() };
            let mut rect = None;
            let context = egui::Context::default();
            for _ in 0..2 {
                let mut shown = context.run_ui(input.clone(), |ui| rect = show(ui, &mut None, &facts, &mut Vec::new()));
                shown.textures_delta.clear();
            }
            rect
        };
        let line = |pace: f64, asleep: bool| with(pace, asleep, Vec::new());
        assert!(line(1.0, false).is_some_and(|rect| rect.width() > 250.0), "{:?}", line(1.0, false));
        assert_eq!(line(1.0, false), line(0.71, false));
        assert_eq!(line(1.0, false), line(1.0, true));
        let notes = [
            vec![moved(Why::Contact, 1)],
            vec![moved(Why::Contact, 1), moved(Why::Budget, 2), moved(Why::Alarm, 1)],
            vec![moved(Why::NotFinite, 11)],
        ];
        for moved in notes {
            assert_eq!(line(1.0, false), with(1.0, false, moved.clone()), "{moved:?}");
        }
    }
}
