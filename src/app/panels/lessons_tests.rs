//! The panel of lessons without a window: what it shows, where it lies, and what clicks on it ask for.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use egui::{Color32, Event, FontId, Pos2, Rect, Shape};

use super::lessons::{self, At, Lessons, Met};
use super::pointer::click;
use super::theme::{self, colors};
use super::{Wish, settings};
use crate::app::action::{Action, Showing};
use crate::app::player::Probe;
use crate::app::plots::{Plots, Quantity, Subject};
use crate::lessons::{Plot, lessons};
use crate::sim::PointId;

/// The least laptop.
const SIZE: [f32; 2] = [1280.0, 720.0];
/// What the bar below takes `[points]`.
const BAR: f32 = 52.0;

/// A panel on a screen of its own.
struct Screen {
    context: egui::Context,
    state: Lessons,
    at_edge: f32,
}

impl Screen {
    fn new() -> Self {
        let context = egui::Context::default();
        theme::apply(&context, Default::default());
        let mut screen = Screen { context, state: Lessons::default(), at_edge: 0.0 };
        screen.rest();
        screen
    }

    /// A step of a lesson.
    fn enter(&mut self, at: At) {
        self.state.enter(at);
        self.rest();
    }

    /// The first frames find their sizes, and it fades in.
    fn rest(&mut self) {
        (0..30).for_each(|_| _ = self.frame(Vec::new()));
    }

    /// A frame with events. Returns what is asked for, and what is drawn: words with the part of them that is seen.
    fn frame(&mut self, events: Vec<Event>) -> (Vec<Wish>, Vec<(Rect, Shape)>) {
        let mut wishes = Vec::new();
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, SIZE.into()));
        let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
        let mut output = self.context.run_ui(input, |ui| {
            let room = Rect::from_min_size(Pos2::ZERO, [SIZE[0], SIZE[1] - BAR].into());
            _ = lessons::show(ui.ctx(), (room, self.at_edge), &mut self.state, &mut wishes);
        });
        output.textures_delta.clear();
        (wishes, output.shapes.into_iter().map(|clipped| (clipped.clip_rect, clipped.shape)).collect())
    }

    /// All words that are drawn: where they stand, how much of them is seen, and in which colour.
    fn words(&mut self) -> Vec<(String, Rect, bool, Color32)> {
        let of = |(clip, shape): (Rect, Shape)| match shape {
            Shape::Text(text) => {
                let place = text.visual_bounding_rect();
                let color = text.override_text_color.unwrap_or(text.galley.job.sections[0].format.color);
                let color = if color == Color32::PLACEHOLDER { text.fallback_color } else { color };
                Some((text.galley.text().to_owned(), place, clip.contains_rect(place), color))
            }
            _ => None,
        };
        self.frame(Vec::new()).1.into_iter().filter_map(of).collect()
    }

    fn place_of(&mut self, words: &str) -> Option<Pos2> {
        self.words().into_iter().find(|(text, ..)| text == words).map(|(_, place, ..)| place.center())
    }

    fn click(&mut self, words: &str) -> Vec<Wish> {
        let at = self.place_of(words).unwrap();
        let wishes = click(at).into_iter().flat_map(|events| self.frame(events).0).collect();
        self.rest();
        wishes
    }
}

/// How much lighter one colour is than another, by the definition of WCAG.
fn contrast(a: Color32, b: Color32) -> f32 {
    let luminance = |color: Color32| {
        let [r, g, b, _] = egui::Rgba::from(color).to_array();
        0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
    };
    let [a, b] = [a, b].map(luminance);
    a.max(b) / a.min(b)
}

#[test]
fn a_lesson_is_chosen_gone_through_and_left_where_it_is() {
    let mut screen = Screen::new();
    let [first, second] = [&lessons()[0], &lessons()[1]];
    assert_eq!(screen.click(&second.title), [Wish::Learn(At { lesson: 1, step: 0 })]);
    assert_eq!(screen.state.lesson, None, "the session goes there, if the scene opens");
    screen.enter(At { lesson: 1, step: 0 });
    assert_eq!(screen.click("Back"), []);
    assert_eq!(screen.click("Next"), [Wish::Learn(At { lesson: 1, step: 1 })]);
    screen.enter(At { lesson: 1, step: 2 });
    assert!(screen.place_of(&second.steps[2].heading).is_some() && screen.place_of(&first.title).is_none());
    assert_eq!(screen.click("Begin again"), [Wish::Learn(At { lesson: 1, step: 2 })]);
    assert_eq!(screen.click("Back"), [Wish::Learn(At { lesson: 1, step: 1 })]);
    assert_eq!(screen.click("All lessons"), []);
    assert!(
        screen.place_of(&format!("at step 3 of {}", second.steps.len())).is_some()
            && screen.place_of(&first.title).is_some()
    );
    assert_eq!(screen.click(&second.title), [Wish::Learn(At { lesson: 1, step: 2 })]);
    assert_eq!(screen.click("Close"), [Wish::Act(Action::Lessons)]);
    // The last step leads on to the next lesson, the last lesson to none.
    let last = |lesson: usize| At { lesson, step: lessons()[lesson].steps.len() - 1 };
    screen.enter(last(0));
    assert_eq!(screen.click("Next lesson"), [Wish::Learn(At { lesson: 1, step: 2 })], "where it was left");
    screen.enter(last(lessons().len() - 1));
    assert!(screen.place_of("Next lesson").is_none() && screen.place_of("Next").is_none());
}

#[test]
fn a_lesson_that_was_put_away_is_left_with_its_scene() {
    let own = |at: At| lessons()[at.lesson].scene(at.step).unwrap().unwrap();
    let other = crate::scene::gallery()[0].scene().unwrap();
    let at = At { lesson: 1, step: 1 };
    assert_ne!(own(at), other);
    for is_open in [true, false] {
        let mut lessons = Lessons::default();
        lessons.enter(at);
        lessons.is_open = is_open;
        assert_eq!(lessons.meet(&own(at)), Met::Nothing, "its own scene");
        assert_eq!(lessons.lesson, Some(1));
        assert_eq!(lessons.meet(&other), Met::Left { had_plots: false });
        lessons.is_open = true;
        assert_eq!(lessons.open_at(), None, "H shows the list");
        assert_eq!(lessons.left, Some(at).filter(|_| is_open), "what was put away by hand is not offered again");
    }
}

#[test]
fn what_is_seen_at_once_stands_first_and_every_step_of_pictures_has_a_formula_and_a_plot() {
    let titles: Vec<&str> = lessons().iter().map(|lesson| &*lesson.title).collect();
    assert_eq!(titles[..2], ["A rope that keeps its length", "Verlet from Taylor's series"]);
    let pictures = lessons().iter().find(|lesson| lesson.name == "pictures").unwrap();
    assert!(pictures.steps.iter().all(|step| step.formula.is_some() && step.plot.is_some()));
}

#[test]
fn every_step_is_whole_readable_and_beside_the_middle() {
    let mut screen = Screen::new();
    let colors = colors(&screen.context);
    for (lesson, steps) in lessons().iter().map(|lesson| lesson.steps.len()).enumerate() {
        for at in (0..steps).map(|step| At { lesson, step }) {
            screen.enter(at);
            let words = screen.words();
            let free = 0.5 * SIZE[0] + 40.0;
            for (text, place, is_seen, color) in &words {
                assert!(is_seen, "{at:?}: {text} is cut off");
                assert!(place.left() > free && place.bottom() < SIZE[1] - BAR, "{at:?}: {text} at {place}");
                let ground = if *color == colors.on_accent { colors.accent } else { colors.panel };
                assert!(text == "Back" || contrast(*color, ground) >= 4.5, "{at:?}: {text}: {color:?}");
            }
            for rows in lessons()[lesson].steps[at.step].formula.iter() {
                let row = rows.lines().count() as f32 * 15.5;
                let place = words.iter().find(|(text, ..)| text == rows).map(|(_, place, ..)| *place);
                assert!(place.is_some_and(|place| place.height() < row), "{at:?}: {rows} is broken: {place:?}");
            }
            let has_next = words.iter().any(|(text, ..)| text == "Next");
            assert_eq!(has_next, at.step + 1 < steps);
            let source = &lessons()[lesson].source;
            assert_eq!(words.iter().any(|(text, ..)| text == source), !has_next, "{at:?}");
        }
    }
    screen.at_edge = settings::WIDTH + 28.0;
    screen.rest();
    let least = screen.words().iter().map(|(_, place, ..)| place.left()).fold(f32::INFINITY, f32::min);
    assert!(least > 0.5 * SIZE[0], "beside the settings: {least}");
    let room = |width: f32| Rect::from_min_size(Pos2::ZERO, [width, 600.0].into());
    assert!(lessons::has_room(room(400.0), 0.0) && lessons::has_room(room(1100.0), screen.at_edge));
    assert!(!lessons::has_room(room(1024.0), screen.at_edge), "the settings alone");
}

#[test]
fn every_sign_of_every_lesson_can_be_written() {
    let screen = Screen::new();
    for lesson in lessons() {
        for step in &lesson.steps {
            let claims = step.claims.iter().map(|claim| &claim.words);
            let words =
                [&lesson.title, &lesson.about, &lesson.source, &step.heading, &step.text, &step.to_try, &step.seen];
            let plain = words.into_iter().chain(claims).map(|words| (words, FontId::proportional(13.0)));
            for (words, font) in plain.chain(step.formula.iter().map(|formula| (formula, FontId::monospace(13.0)))) {
                for sign in words.chars().filter(|sign| *sign != '\n') {
                    assert!(screen.context.fonts_mut(|fonts| fonts.has_glyph(&font, sign)), "{sign} in {words}");
                }
            }
        }
    }
}

#[test]
fn plots_show_what_a_step_asks_for() {
    let plots = Plots::of(1.0, &Plot::Energies);
    assert_eq!((plots.subject, plots.probes()), (Subject::Energies, [None; 2]));
    let quantity = crate::lessons::Quantity::Speed;
    let plots = Plots::of(1.0, &Plot::Probes { points: vec![5], quantity });
    assert_eq!((plots.subject, plots.quantity), (Subject::Probes, Quantity::Speed));
    assert_eq!(plots.probes(), [Some(PointId(5).into()), None]);
    let plots = Plots::of(1.0, &Plot::Phase { points: [1, 2], quantity });
    assert_eq!((plots.subject, plots.probes()), (Subject::Phase, [1, 2].map(|point| Some(PointId(point).into()))));
    assert_eq!(Plots::of(1.0, &Plot::Strain).subject, Subject::Strain);
    let quantity = crate::lessons::Quantity::Force;
    let plots = Plots::of(1.0, &Plot::Bonds { bonds: vec![3, 7], quantity });
    assert_eq!((plots.quantity, plots.probes()), (Quantity::Force, [3, 7].map(|bond| Some(Probe::Bond(bond)))));
    let plots = Plots::of(1.0, &Plot::Angle { points: [3, 18, 21] });
    let corner = Probe::Corner([3, 18, 21].map(PointId));
    assert_eq!((plots.quantity, plots.probes()), (Quantity::Angle, [Some(corner), None]));
}

#[test]
fn what_a_step_shows_goes_with_it_and_what_somebody_chose_since_stays() {
    let mut lessons = Lessons::default();
    lessons.show_as(Showing::Strain, Showing::Bodies);
    lessons.show_as(Showing::Bonds, Showing::Strain);
    assert_eq!(lessons.show_no_more(Showing::Bonds), Some(Showing::Bodies), "as it was before the first step");
    assert_eq!(lessons.show_no_more(Showing::Bonds), None, "once");
    lessons.show_as(Showing::Strain, Showing::Bodies);
    assert_eq!(lessons.show_no_more(Showing::Bonds), None, "that was chosen by hand");
}
