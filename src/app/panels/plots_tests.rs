//! The panel of plots without a window: what it draws, and what clicks on it ask for.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use egui::{Color32, Event, Pos2, Rect, Shape, vec2};

use super::plots::{self, Seat, of_energies};
use super::plots_at::PlotsAt;
use super::pointer::{button, click};
use super::theme::colors;
use super::{Wish, theme};
use crate::app::action::Action;
use crate::app::player::{Order, Probe, Shown, Stage};
use crate::app::plots::{Plots, Quantity, Subject};
use crate::render::Palette;
use crate::scene::Scene;
use crate::sim::PointId;

/// Two springs that swing.
const SCENE: &str = r#"{"wobble": 1, "gravity": [0, -9.81],
    "bodies": [{"make": "rope", "count": 3, "spacing": 0.5, "pinned": [0],
        "material": {"kind": "spring", "stiffness": 100, "damping": 0, "mass": 1}}]}"#;

/// A panel on a screen of its own.
struct Screen {
    context: egui::Context,
    plots: Plots,
    at: PlotsAt,
    size: [f32; 2],
}

impl Screen {
    /// After a second of the scene, with so many probes.
    fn new(probes: u32) -> Self {
        let mut stage = Stage::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap();
        let (mut plots, mut shown) = (Plots::new(1.0), Shown::default());
        (0..probes).for_each(|point| plots.toggle(PointId(point + 1), |_| false));
        stage.obey(Order::Watch(Some(plots.probes())));
        for _ in 0..60 {
            stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            stage.show(&mut shown);
            plots.take(&shown);
        }
        let context = egui::Context::default();
        theme::apply(&context, Default::default());
        let mut screen = Screen { context, plots, at: PlotsAt::default(), size: [1280.0, 720.0] };
        // The first frames find their sizes, and it fades in.
        (0..30).for_each(|_| _ = screen.frame(Vec::new()));
        screen
    }

    /// A frame with events. Returns what is asked for, and what is drawn.
    fn frame(&mut self, events: Vec<Event>) -> (Vec<Wish>, Vec<Shape>) {
        let mut wishes = Vec::new();
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, self.size.into()));
        let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
        let mut output = self.context.run_ui(input, |ui| {
            let seat = Seat { points: &[], at: &mut self.at, is_docked: false, is_beside: false };
            plots::show(
                ui.ctx(),
                (ui.available_rect_before_wrap(), 0.0),
                (&mut self.plots, seat, Vec::new()),
                &mut wishes,
            );
        });
        output.textures_delta.clear();
        let mut shapes = Vec::new();
        output.shapes.into_iter().for_each(|clipped| flatten(clipped.shape, &mut shapes));
        (wishes, shapes)
    }

    /// Where words stand.
    fn place_of(&mut self, words: &str) -> Option<Pos2> {
        self.frame(Vec::new()).1.iter().find_map(|shape| match shape {
            Shape::Text(text) if text.galley.text() == words => Some(text.visual_bounding_rect().center()),
            _ => None,
        })
    }

    fn click(&mut self, words: &str) -> Vec<Wish> {
        let at = self.place_of(words).unwrap();
        click(at).into_iter().flat_map(|events| self.frame(events).0).collect()
    }

    /// How many points the curves of a colour have.
    fn curve(&mut self, color: Color32) -> usize {
        let shapes = self.frame(Vec::new()).1;
        let points = |shape: &Shape| match shape {
            Shape::Path(path) if path.stroke.color == egui::epaint::ColorMode::Solid(color) => path.points.len(),
            _ => 0,
        };
        shapes.iter().map(points).sum()
    }
}

fn flatten(shape: Shape, all: &mut Vec<Shape>) {
    match shape {
        Shape::Vec(list) => list.into_iter().for_each(|shape| flatten(shape, all)),
        shape => all.push(shape),
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
fn every_curve_stands_out_from_its_ground() {
    for palette in [Palette::Dark, Palette::Light] {
        let context = egui::Context::default();
        theme::apply(&context, palette);
        let colors = colors(&context);
        for color in colors.energies.into_iter().chain(colors.probes) {
            assert!(contrast(color, colors.panel) >= 3.0, "{color:?}: {}", contrast(color, colors.panel));
        }
    }
}

#[test]
fn all_energies_are_drawn_with_their_names() {
    let mut screen = Screen::new(0);
    let energies = of_energies(&screen.plots, colors(&screen.context));
    let names: Vec<&str> = energies.iter().map(|(kind, ..)| kind.name).collect();
    assert_eq!(names, ["kinetic", "springs", "gravity", "sum"], "nothing is said of kinds that there are none of");
    for (kind, color, _) in energies {
        assert!(screen.curve(color) > 50, "{}: {}", kind.name, screen.curve(color));
        assert!(screen.place_of(kind.name).is_some(), "{}", kind.name);
    }
    let shapes = screen.frame(Vec::new()).1;
    let says =
        |end: &str| shapes.iter().any(|shape| matches!(shape, Shape::Text(text) if text.galley.text().ends_with(end)));
    assert!(says(" s") && says(" J"), "the units");
}

#[test]
fn curves_that_lie_on_each_other_are_all_seen() {
    let mut screen = Screen::new(0);
    let energies = of_energies(&screen.plots, colors(&screen.context));
    let shapes = screen.frame(Vec::new()).1;
    let width = |color: Color32| {
        let of = |shape: &Shape| match shape {
            Shape::Path(path) if path.stroke.color == egui::epaint::ColorMode::Solid(color) => Some(path.stroke.width),
            _ => None,
        };
        shapes.iter().find_map(of).unwrap()
    };
    let widths: Vec<f32> = energies.iter().map(|(_, color, _)| width(*color)).collect();
    assert!(widths.windows(2).all(|pair| pair[0] > pair[1] + 0.9), "what is drawn first is wider: {widths:?}");
    let drawn = super::figure(&screen.plots);
    assert!(widths.iter().all(|width| drawn.contains(&format!("stroke-width=\"{width}\""))), "{drawn}");
}

#[test]
fn a_plot_as_low_as_in_a_lesson_has_numbers_at_both_axes() {
    let mut screen = Screen::new(0);
    for (width, height) in [(300.0, 70.0), (180.0, 70.0), (340.0, 180.0), (400.0, 180.0)] {
        let words = words_above(&mut screen, width, height + plots::HEAD);
        let count = |unit: &str| words.iter().filter(|word| word.ends_with(unit)).count();
        assert!(count(" J") >= 2 && count(" s") >= 2, "{width} x {height}: {words:?}");
    }
}

/// The words in a panel beside a lesson, in a room so high with a plot so wide `[points]`.
fn words_above(screen: &mut Screen, width: f32, high: f32) -> Vec<String> {
    let room = Rect::from_min_size(Pos2::ZERO, vec2(1000.0, high));
    let mut words = Vec::new();
    for _ in 0..6 {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, screen.size.into()));
        let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
        let plots = &mut screen.plots;
        let mut output = screen.context.run_ui(input, |ui| {
            plots::show_above(ui.ctx(), (room, 0.0, width), plots, &mut Vec::new());
        });
        output.textures_delta.clear();
        let mut shapes = Vec::new();
        output.shapes.into_iter().for_each(|clipped| flatten(clipped.shape, &mut shapes));
        let text = |shape: &Shape| match shape {
            Shape::Text(text) => Some(text.galley.text().to_owned()),
            _ => None,
        };
        words = shapes.iter().filter_map(text).collect();
    }
    words
}

#[test]
fn what_is_looked_at_is_chosen_beside_a_lesson_at_every_width() {
    for probes in 0..3 {
        let mut screen = Screen::new(probes);
        for width in [200.0, 300.0, 335.0, 342.0, 344.0, 400.0] {
            let words = words_above(&mut screen, width, 300.0);
            let has = |word: &str| words.iter().any(|one| one == word);
            assert!(has("energies"), "{width}: {words:?}");
            assert!(probes == 0 || has("probe") || has("probes"), "{width}, {probes}: {words:?}");
        }
    }
}

#[test]
fn a_click_inside_it_is_no_drag() {
    let mut screen = Screen::new(0);
    let lies = |screen: &Screen| plots::lie(&screen.context).unwrap();
    let first = lies(&screen);
    ["CSV", "SVG", "sum"].into_iter().for_each(|words| _ = screen.click(words));
    assert!(!screen.at.is_dragged(false) && lies(&screen) == first);
    let (from, way) = (first.left_bottom() + vec2(5.0, -5.0), vec2(90.0, -40.0));
    let drag = [Event::PointerMoved(from), button(from, true), Event::PointerMoved(from + way)];
    let drag = drag.into_iter().chain([Event::PointerMoved(from + way), button(from + way, false)]);
    drag.for_each(|event| _ = screen.frame(vec![event]));
    screen.frame(Vec::new());
    let moved = lies(&screen).left_bottom() - first.left_bottom();
    assert!(screen.at.is_dragged(false) && (moved - way).length() < 1.5, "{moved:?}");
    assert!(!screen.at.is_dragged(true), "of worlds side by side it has its own place still");
}

#[test]
fn buttons_ask_and_the_pointer_alone_does_not() {
    let mut screen = Screen::new(0);
    assert_eq!(screen.click("CSV"), [Wish::WriteTable]);
    assert_eq!(screen.click("Close"), [Wish::Act(Action::Plots)]);
    for step in 0..40_u8 {
        let over = Event::PointerMoved(Pos2::new(70.0 + 9.0 * f32::from(step), 715.0 - 6.0 * f32::from(step)));
        assert_eq!(screen.frame(vec![over]).0, []);
    }
}

#[test]
fn probes_are_plotted_over_time_and_against_each_other() {
    let mut none = Screen::new(0);
    assert!(none.place_of("probes").is_none() && none.place_of("against each other").is_none());
    let mut one = Screen::new(1);
    let [first, second] = colors(&one.context).probes;
    assert!(one.curve(first) > 50 && one.curve(second) == 0);
    assert!(one.place_of("against each other").is_none());
    let mut two = Screen::new(2);
    assert!(two.curve(first) > 50 && two.curve(second) > 50);
    two.click("speed");
    assert!(two.place_of("velocity z").is_none() && two.place_of("strain").is_none(), "not of points of the plane");
    two.click("velocity y");
    assert_eq!(two.plots.quantity, Quantity::VelocityY);
    two.click("against each other");
    assert_eq!(two.plots.subject, Subject::Phase);
    assert!({
        let text = colors(&two.context).text;
        two.curve(text) > 50
    });
    two.click("energies");
    two.click("largest strain");
    assert_eq!(two.plots.subject, Subject::Strain);
    let text = colors(&two.context).text;
    assert!(two.curve(text) > 50);
}

#[test]
fn a_probe_is_plotted_against_its_own_velocity() {
    let mut one = Screen::new(1);
    let first = colors(&one.context).probes[0];
    one.click("speed");
    one.click("phase portrait of y");
    assert_eq!((one.plots.subject, one.plots.quantity), (Subject::Orbit, Quantity::Y));
    assert!(one.curve(first) > 50, "{}", one.curve(first));
    one.click("probe");
    assert_eq!(one.plots.subject, Subject::Orbit, "the button is on in an orbit, too");
    let drawn = super::figure(&one.plots);
    assert!(drawn.contains("velocity y [m/s]") && drawn.contains("y [m]"), "{drawn}");
    // Another quantity is one over time again.
    one.click("phase portrait of y");
    one.click("velocity x");
    assert_eq!((one.plots.subject, one.plots.quantity), (Subject::Probes, Quantity::VelocityX));
}

#[test]
fn a_figure_of_forces_names_no_point() {
    let mut screen = Screen::new(1);
    screen.plots.toggle(Probe::Bond(0), |_| false);
    for (quantity, names_point) in [(Quantity::Force, false), (Quantity::Speed, true)] {
        screen.plots.choose(quantity);
        let drawn = super::figure(&screen.plots);
        assert!(drawn.contains("bond 0") && drawn.contains("point 1") == names_point, "{drawn}");
    }
}

#[test]
fn in_a_small_window_it_is_still_whole() {
    let mut screen = Screen::new(2);
    screen.size = [480.0, 340.0];
    (0..3).for_each(|_| _ = screen.frame(Vec::new()));
    let all = Rect::from_min_size(Pos2::ZERO, vec2(480.0, 340.0));
    for words in ["Plots", "Close", "energies", "speed", "1: point 1"] {
        assert!(screen.place_of(words).is_some_and(|at| all.contains(at)), "{words}");
    }
}
