//! The panel of what is selected without a window: what clicks and drags on it ask for.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use egui::{Event, Pos2, Rect, Shape, vec2};

use super::pointer::{button, click};
use super::{Facts, PanelState, Wish, material};
use crate::app::action::{Action, Tool};
use crate::app::matter::{
    Among, Common, Matter, MatterChange, MotorChange, Motors, Placed, Placing, Preset, Size, Span, Stops,
};
use crate::app::player::{Order, Shown, Stage};
use crate::scene::{DriveKeys, KeyName, Scene};
use crate::sim::PointId;

const SCENE: &str = r#"{"wobble": 1, "contact": true, "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5,
    "material": {"kind": "spring", "stiffness": 300, "mass": 4}}]}"#;

fn matter() -> Arc<Matter> {
    let mut stage = Stage::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap();
    stage.obey(Order::Inspect(Among { points: (0..9).map(PointId).collect(), ..Among::default() }));
    let mut shown = Shown::default();
    stage.show(&mut shown);
    shown.matter.unwrap()
}

struct Screen {
    context: egui::Context,
    state: PanelState,
    facts: Facts,
    width: f32,
    /// What other panels take of the right edge.
    edge: f32,
}

impl Screen {
    fn new(matter: Option<Arc<Matter>>) -> Self {
        let facts = Facts { dimensions: 2, tool: Tool::Select, matter, ..Facts::default() };
        let mut screen =
            Screen { context: egui::Context::default(), state: PanelState::default(), facts, width: 1280.0, edge: 0.0 };
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
        screen
    }

    /// A frame with events. Returns what is asked for, and what is written where.
    fn frame(&mut self, events: Vec<Event>) -> (Vec<Wish>, Vec<(String, Pos2)>) {
        let mut wishes = Vec::new();
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(self.width, 800.0)));
        let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
        let mut output = self.context.run_ui(input, |ui| {
            let room = ui.available_rect_before_wrap();
            let room = room.with_max_x(room.right() - self.edge);
            material::show(ui.ctx(), (room, Pos2::new(80.0, 60.0), false), &mut self.state, &self.facts, &mut wishes);
        });
        output.textures_delta.clear();
        let mut texts = Vec::new();
        for clipped in &output.shapes {
            gather(&clipped.shape, &mut texts);
        }
        (wishes, texts)
    }

    fn place(&mut self, text: &str) -> Pos2 {
        let texts = self.frame(Vec::new()).1;
        let found = texts.iter().find(|(other, _)| other == text);
        found.unwrap_or_else(|| panic!("{text} is not among {texts:?}")).1
    }

    /// How a number is written there.
    fn number(&mut self, value: f64) -> String {
        let texts = self.frame(Vec::new()).1;
        let is_it = |text: &str| text.parse::<f64>().is_ok_and(|number| (number - value).abs() < 1e-6);
        texts.into_iter().map(|(text, _)| text).find(|text| is_it(text)).unwrap()
    }

    /// Clicks what is written there.
    fn click(&mut self, text: &str) -> Vec<Wish> {
        let at = self.place(text);
        click(at).into_iter().flat_map(|events| self.frame(events).0).collect()
    }
}

fn gather(shape: &Shape, texts: &mut Vec<(String, Pos2)>) {
    match shape {
        Shape::Text(text) => texts.push((text.galley.text().to_owned(), text.pos + 0.5 * text.galley.size())),
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| gather(shape, texts)),
        _ => {}
    }
}

#[test]
fn clicks_ask_for_what_is_written_on_them() {
    let mut screen = Screen::new(Some(matter()));
    let preset = |preset| vec![Wish::Matter(MatterChange::Preset(preset), false)];
    assert_eq!(screen.click("Steel"), preset(Preset::Steel));
    assert_eq!(screen.click("Jelly"), preset(Preset::Jelly));
    assert_eq!(screen.click("rigid"), [Wish::Matter(MatterChange::Rigid, false)]);
    assert_eq!(screen.click("springy"), [], "they are springs already");
    assert_eq!(screen.click("relaxed"), [Wish::Matter(MatterChange::Relaxed, false)]);
    assert!(!screen.frame(Vec::new()).1.iter().any(|(text, _)| text == "Group"), "one body is selected as one anyway");
    assert_eq!(screen.click("tears"), [Wish::Matter(MatterChange::Breaks(0.5), false)]);
    assert_eq!(screen.click("Flip left-right"), [Wish::Act(Action::FlipAcross)]);
    assert_eq!(screen.click("Flip up-down"), [Wish::Act(Action::FlipOver)]);
    screen.facts.dimensions = 3;
    assert!(!screen.frame(Vec::new()).1.iter().any(|(text, _)| text.starts_with("Flip")), "it is of the plane");
    let two = Matter { bodies: 2, ..(*matter()).clone() };
    assert_eq!(matter().bodies, 1);
    let mut screen = Screen::new(Some(Arc::new(two)));
    assert_eq!(screen.click("Group"), [Wish::Act(Action::Group)]);
    screen.facts.is_grouped = true;
    assert_eq!(screen.click("Ungroup"), [Wish::Act(Action::Ungroup)]);
    let mut screen = Screen::new(None);
    assert_eq!(screen.click("Free stroke"), [Wish::Lasso(true)]);
}

#[test]
fn a_drag_of_a_number_goes_on_and_mixed_ones_say_so() {
    let mut screen = Screen::new(Some(matter()));
    let at = screen.place("4.00");
    screen.frame(vec![Event::PointerMoved(at)]);
    let mut all = screen.frame(vec![button(at, true)]).0;
    for x in [20.0, 40.0, 60.0] {
        all.extend(screen.frame(vec![Event::PointerMoved(at + vec2(x, 0.0))]).0);
    }
    all.extend(screen.frame(vec![button(at + vec2(60.0, 0.0), false)]).0);
    let masses: Vec<(f64, bool)> = all
        .iter()
        .map(|wish| match wish {
            Wish::Matter(MatterChange::Mass(mass), goes_on) => (*mass, *goes_on),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(masses.len() >= 2 && masses.iter().all(|(mass, _)| *mass > 4.0), "{masses:?}");
    assert!(!masses[0].1 && masses[1..].iter().all(|(_, goes_on)| *goes_on), "{masses:?}");
    let mut mixed = (*matter()).clone();
    mixed.stiffness = mixed.stiffness.map(|span| Span { most: 2.0 * span.most, ..span });
    assert!(Screen::new(Some(Arc::new(mixed))).place("mixed").x > 60.0);
}

#[test]
fn it_stays_at_the_right_edge_whatever_is_selected_and_names_it() {
    let mut screen = Screen::new(Some(matter()));
    let at = screen.place("Steel");
    assert!(at.x > 1280.0 - 250.0, "{at}");
    assert_eq!(matter().name.as_deref(), Some("block"), "by what made it");
    assert!(screen.place("block").y < screen.place("9 points, 20 bonds").y);
    screen.facts.matter = Some(Arc::new(Matter { name: None, bodies: 3, points: 240, ..(*matter()).clone() }));
    assert!((screen.place("Steel").x - at.x).abs() < 1.0);
    screen.place("3 bodies, 240 points");
    screen.facts.matter = Some(Arc::new(Matter { obstacles: 1, ..Matter::default() }));
    screen.place("obstacle");
    screen.facts.matter = Some(Arc::new(Matter { points: 4, bodies: 4, obstacles: 2, ..Matter::default() }));
    screen.place("4 points, 2 obstacles");
    // Where it would cover the middle of the window it begins folded, and a click on its head opens it.
    let mut screen = Screen { width: 480.0, ..Screen::new(Some(matter())) };
    (0..3).for_each(|_| _ = screen.frame(Vec::new()));
    assert!(!screen.frame(Vec::new()).1.iter().any(|(text, _)| text == "Steel"));
    let head = screen.place("block");
    click(head).into_iter().for_each(|events| _ = screen.frame(events));
    (0..30).for_each(|_| _ = screen.frame(Vec::new()));
    screen.place("Steel");
}

#[test]
fn what_nothing_made_is_named_by_its_shape() {
    let named = |text: &str, points: std::ops::Range<u32>| {
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        stage.obey(Order::Inspect(Among { points: points.map(PointId).collect(), ..Among::default() }));
        let mut shown = Shown::default();
        stage.show(&mut shown);
        shown.matter.unwrap().name.clone()
    };
    let alone = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0.1], [1, 1], [5, 5]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}]}"#;
    assert_eq!(named(alone, 0..4).as_deref(), Some("rope"));
    assert_eq!(named(alone, 4..5).as_deref(), Some("point"));
    assert_eq!(named(alone, 0..5), None, "two are counted");
    let loop_of_four = alone.replace(r#"{"a": 2, "b": 3}]"#, r#"{"a": 2, "b": 3}, {"a": 3, "b": 0}]"#);
    assert_eq!(named(&loop_of_four, 0..4).as_deref(), Some("net"));
    let made = r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 5, "to": [1.8, 0]},
        {"make": "disc", "radius": 1, "spacing": 0.5, "origin": [0, 5], "material": {"kind": "spring", "stiffness": 100, "mass": 1}}]}"#;
    assert_eq!([named(made, 0..5), named(made, 5..9)].map(|name| name.unwrap()), ["rope", "disc"]);
}

#[test]
fn a_colour_is_clicked_on_or_dragged_to() {
    let mut screen = Screen::new(Some(matter()));
    let label = screen.place("colour");
    let at = label + vec2(80.0, 0.0);
    click(at).into_iter().for_each(|events| _ = screen.frame(events));
    (0..20).for_each(|_| _ = screen.frame(Vec::new()));
    let texts = screen.frame(Vec::new()).1;
    for name in ["hue", "strength", "lightness"] {
        assert!(texts.iter().any(|(text, _)| text == name), "{name}: {texts:?}");
    }
    let fonts = [egui::FontId::proportional(13.5), egui::FontId::monospace(12.0)];
    for (text, _) in &texts {
        let is_known =
            |sign: char| fonts.iter().any(|font| screen.context.fonts_mut(|fonts| fonts.has_glyph(font, sign)));
        assert!(text.chars().all(|sign| sign == '\n' || is_known(sign)), "{text} has a sign that no font has");
    }
    // Of the samples the first lies at the left of the first row, above the first bar.
    let hue = screen.place("hue");
    let sample = hue - vec2(3.0, 45.0);
    let wishes: Vec<Wish> = click(sample).into_iter().flat_map(|events| screen.frame(events).0).collect();
    let [Wish::Matter(MatterChange::Color(_), false)] = wishes[..] else { panic!("{wishes:?}") };
    // A drag along the bar is one edit.
    let bar = hue + vec2(90.0, 0.0);
    screen.frame(vec![Event::PointerMoved(bar)]);
    let mut all = screen.frame(vec![button(bar, true)]).0;
    for x in [15.0, 30.0, 45.0] {
        all.extend(screen.frame(vec![Event::PointerMoved(bar + vec2(x, 0.0))]).0);
    }
    all.extend(screen.frame(vec![button(bar + vec2(45.0, 0.0), false)]).0);
    let goes_on: Vec<bool> = all
        .iter()
        .map(|wish| match wish {
            Wish::Matter(MatterChange::Color(_), goes_on) => *goes_on,
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(goes_on.len() >= 3 && !goes_on[0] && goes_on[1..].iter().all(|goes_on| *goes_on), "{all:?}");
}

#[test]
fn the_panel_goes_to_the_other_side_where_it_would_cover_what_is_selected() {
    let mut screen = Screen::new(Some(matter()));
    let at_right = screen.place("Copy");
    assert!(at_right.x > 900.0, "{at_right}");
    // Another selection, which lies there.
    screen.facts.chosen_at = Some(Rect::from_center_size(at_right, vec2(60.0, 60.0)));
    assert_eq!(screen.place("Copy"), at_right, "it stays while that is selected, wherever it goes");
    screen.state.matter_at = Default::default();
    let at_left = screen.place("Copy");
    assert!(at_left.x < 400.0, "{at_left}");
    screen.facts.chosen_at = Some(Rect::from_min_max(Pos2::ZERO, Pos2::new(1280.0, 800.0)));
    screen.state.matter_at = Default::default();
    assert_eq!(screen.place("Copy"), at_right, "what lies everywhere is covered anyway");
}

#[test]
fn the_panel_is_dragged_aside_by_its_title_and_put_back_by_a_double_click() {
    let mut screen = Screen::new(Some(matter()));
    let (at_right, title) = (screen.place("Copy"), screen.place("block"));
    let by = vec2(-400.0, 100.0);
    screen.frame(vec![Event::PointerMoved(title)]);
    screen.frame(vec![button(title, true)]);
    for share in [0.25, 0.5, 1.0] {
        screen.frame(vec![Event::PointerMoved(title + share * by)]);
    }
    // It comes along a frame later. Meanwhile something else is told to be selected there: it stays in the hand.
    screen.frame(Vec::new());
    screen.facts.chosen_at = Some(Rect::from_center_size(at_right + by, vec2(60.0, 60.0)));
    assert!((screen.place("Copy") - (at_right + by)).length() < 3.0, "{} {at_right}", screen.place("Copy"));
    screen.frame(vec![button(title + by, false)]);
    assert!((screen.place("Copy") - (at_right + by)).length() < 3.0, "it is open still: a drag is no click");
    // What is selected next lies below it, and then does not.
    screen.state.matter_at.begin();
    screen.frame(Vec::new());
    assert_eq!(screen.place("Copy"), at_right);
    screen.facts.chosen_at = None;
    screen.state.matter_at.begin();
    screen.frame(Vec::new());
    assert!((screen.place("Copy") - (at_right + by)).length() < 3.0);
    for events in click(title + by).into_iter().chain(click(title + by)) {
        screen.frame(events);
    }
    // Two clicks fold it and open it again, which takes a while.
    (0..20).for_each(|_| _ = screen.frame(Vec::new()));
    assert_eq!(screen.place("Copy"), at_right);
}

#[test]
fn where_nothing_is_selected_it_stands_beside_the_tools_once_settings_take_the_edge() {
    let mut screen = Screen::new(None);
    let at_edge = screen.place("All");
    assert!(at_edge.x > 900.0, "{at_edge}");
    screen.edge = 280.0;
    let beside_tools = screen.place("All");
    assert!(beside_tools.x < 400.0, "not over the middle: {beside_tools}");
}

#[test]
fn stops_of_joints_are_ticked_and_typed_in_degrees() {
    let knee = r#"{"wobble": 1, "points": {"position": [[1, 0], [0, 0], [0, 1]]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}],
        "angles": [{"points": [0, 1, 2], "stiffness": 2}]}"#;
    let mut stage = Stage::new(Scene::parse(knee, "x.json").unwrap().into()).unwrap();
    stage.obey(Order::Inspect(Among { points: (0..3).map(PointId).collect(), ..Among::default() }));
    let mut shown = Shown::default();
    stage.show(&mut shown);
    let mut screen = Screen::new(shown.matter.clone());
    assert_eq!(screen.click("stops"), [Wish::Matter(MatterChange::Stops(Stops::Some), false)]);
    let stopped = |least: f64, most: f64| {
        let span = |x: f64| Span { least: x, most: x };
        let ends = [span(least.to_radians()), span(most.to_radians())];
        Arc::new(Matter { joints: [1, 1], stops: Some(ends), ..(**shown.matter.as_ref().unwrap()).clone() })
    };
    screen.facts.matter = Some(stopped(30.0, 150.0));
    let mut type_in = |field: f64, text: &str| {
        let field = screen.number(field);
        screen.click(&field);
        screen.frame(vec![Event::Text(text.to_owned())]);
        let beside = Pos2::new(300.0, 700.0);
        let wishes: Vec<Wish> =
            click(beside).into_iter().chain([Vec::new()]).flat_map(|events| screen.frame(events).0).collect();
        let [Wish::Matter(change, false)] = wishes[..] else { panic!("{wishes:?}") };
        change
    };
    let near = |x: f64, degrees: f64| (x.to_degrees() - degrees).abs() < 0.01;
    let least = type_in(30.0, "45");
    assert!(matches!(least, MatterChange::Stops(Stops::Least(x)) if near(x, 45.0)), "{least:?}");
    // The one end goes no further than the other.
    let most = type_in(150.0, "10");
    assert!(matches!(most, MatterChange::Stops(Stops::Most(x)) if near(x, 30.1)), "{most:?}");
    let rest = type_in(90.0, "100");
    assert!(matches!(rest, MatterChange::RestAngle(x) if near(x, 100.0)), "{rest:?}");
}

#[test]
fn bending_is_typed_for_a_rope_without_angles_and_not_offered_in_space() {
    let of = |text: &str| {
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        stage.obey(Order::Inspect(Among { points: (0..5).map(PointId).collect(), ..Among::default() }));
        let mut shown = Shown::default();
        stage.show(&mut shown);
        Screen::new(shown.matter.clone())
    };
    let mut screen = of(r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 5, "to": [1, 0]}]}"#);
    let field = screen.place("bending") + vec2(75.0, 0.0);
    click(field).into_iter().for_each(|events| _ = screen.frame(events));
    screen.frame(vec![Event::Text("2.5".to_owned())]);
    let beside = Pos2::new(300.0, 700.0);
    let wishes: Vec<Wish> =
        click(beside).into_iter().chain([Vec::new()]).flat_map(|events| screen.frame(events).0).collect();
    assert_eq!(wishes, [Wish::Matter(MatterChange::Bending(2.5), false)]);
    let mut space = of(r#"{"wobble": 1, "dimensions": 3, "bodies": [{"make": "rope", "count": 5, "to": [1, 0, 0]}]}"#);
    space.place("mass");
    assert!(!space.frame(Vec::new()).1.iter().any(|(text, _)| text == "bending"));
}

/// A joint that resists, in a panel.
fn of_a_knee() -> (Screen, Arc<Matter>) {
    let knee = r#"{"wobble": 1, "points": {"position": [[1, 0], [0, 0], [0, 1]]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}],
        "angles": [{"points": [0, 1, 2], "stiffness": 2, "damping": 0.25}]}"#;
    let mut stage = Stage::new(Scene::parse(knee, "x.json").unwrap().into()).unwrap();
    stage.obey(Order::Inspect(Among { points: (0..3).map(PointId).collect(), ..Among::default() }));
    let mut shown = Shown::default();
    stage.show(&mut shown);
    let matter = shown.matter.unwrap();
    (Screen::new(Some(Arc::clone(&matter))), matter)
}

impl Screen {
    /// Types into the field with this number; returns what that asks for.
    fn type_in(&mut self, field: &str, text: &str) -> Vec<Wish> {
        self.click(field);
        self.frame(vec![Event::Text(text.to_owned())]);
        let beside = click(Pos2::new(300.0, 700.0)).into_iter().chain([Vec::new()]);
        beside.flat_map(|events| self.frame(events).0).collect()
    }
}

#[test]
fn damping_of_angles_is_typed_beside_their_bending() {
    let (mut screen, _) = of_a_knee();
    assert!(screen.place("damped by").y < screen.place("rest angle").y);
    assert_eq!(screen.type_in("0.25", "0.5"), [Wish::Matter(MatterChange::AngleDamping(0.5), false)]);
}

#[test]
fn a_servo_is_ticked_and_each_of_its_numbers_is_typed() {
    let (mut screen, matter) = of_a_knee();
    let first = DriveKeys { amplitude: Some(0.5), period: Some(1.0), ..DriveKeys::default() };
    assert_eq!(screen.click("swings"), [Wish::Matter(MatterChange::Swings(Some(first)), false)]);
    let mut with = |drive: DriveKeys, act: &mut dyn FnMut(&mut Screen) -> Vec<Wish>| {
        screen.facts.matter = Some(Arc::new(Matter { swings: Some(Common::One(Some(drive))), ..(*matter).clone() }));
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
        act(&mut screen)
    };
    let alone = DriveKeys { amplitude: Some(0.5), period: Some(4.0), phase: Some(0.0), ..DriveKeys::default() };
    let held = DriveKeys { key: Some(KeyName::A), back: Some(KeyName::B), rate: Some(6.0), ..alone };
    for (field, text, expected) in [
        ("28.6", "45", DriveKeys { amplitude: Some(45_f64.to_radians()), ..held }),
        ("4.00", "2", DriveKeys { period: Some(2.0), ..held }),
        ("6.00", "8", DriveKeys { rate: Some(8.0), ..held }),
    ] {
        let asked = with(held, &mut |screen| screen.type_in(field, text));
        assert_eq!(asked, [Wish::Matter(MatterChange::Swings(Some(expected)), false)], "{field}");
    }
    let without = DriveKeys { period: None, phase: None, ..held };
    assert_eq!(
        with(held, &mut |screen| screen.click("wave")),
        [Wish::Matter(MatterChange::Swings(Some(without)), false)]
    );
    assert_eq!(with(alone, &mut |screen| screen.click("wave")), [], "then it would follow nothing");
    assert_eq!(with(alone, &mut |screen| screen.click("swings")), [Wish::Matter(MatterChange::Swings(None), false)]);
}

#[test]
fn the_motors_of_what_is_selected_are_typed_in_its_panel() {
    let one = |x: f64| Span { least: x, most: x };
    let mut screen = Screen::new(Some(matter()));
    assert!(!screen.frame(Vec::new()).1.iter().any(|(text, _)| text == "torque"), "it has none");
    let motors = Some(Motors { speed: one(-6.0), torque: one(30.0), keys: Common::One([None; 2]) });
    screen.facts.matter = Some(Arc::new(Matter { motors, ..(*matter()).clone() }));
    screen.frame(Vec::new());
    for (name, change) in [("speed", MotorChange::Speed(3.0)), ("torque", MotorChange::Torque(3.0))] {
        let field = screen.place(name) + vec2(75.0, 0.0);
        click(field).into_iter().for_each(|events| _ = screen.frame(events));
        screen.frame(vec![Event::Text("3".to_owned())]);
        let beside = Pos2::new(300.0, 700.0);
        let wishes: Vec<Wish> =
            click(beside).into_iter().chain([Vec::new()]).flat_map(|events| screen.frame(events).0).collect();
        assert_eq!(wishes, [Wish::Matter(MatterChange::Motor(change), false)]);
    }
    screen.place("always on");
}

#[test]
fn stops_for_many_joints_say_how_many_they_are() {
    let of = |joints: [usize; 2]| Some(Arc::new(Matter { joints, ..(*matter()).clone() }));
    let said = |screen: &mut Screen, words: &str| screen.frame(Vec::new()).1.iter().any(|(text, _)| text == words);
    let mut figure = Screen::new(of([0, 9]));
    assert!(said(&mut figure, "stops") && !said(&mut figure, "stops for all 9"));
    let mut net = Screen::new(of([0, 84]));
    assert!(!said(&mut net, "stops"), "no click gives them all unasked");
    assert_eq!(net.click("stops for all 84"), [Wish::Matter(MatterChange::Stops(Stops::Some), false)]);
    assert!(said(&mut net, "Ctrl+click a corner to give it stops alone"));
    // What has some loses them by the tick.
    let mut some = Screen::new(of([2, 84]));
    assert_eq!(some.click("stops"), [Wish::Matter(MatterChange::Stops(Stops::None), false)]);
}

/// A box that is turned, in the panel.
fn of_a_box() -> Screen {
    let matter = Matter { obstacles: 1, ..Matter::default() };
    let mut screen = Screen::new(Some(Arc::new(matter)));
    screen.facts.figures.placed =
        Some(Placed { middle: [1.5, 2.5, 0.0], angle: Some(0.25), size: Some(Size::Box([3.5, 0.75])) });
    (0..2).for_each(|_| _ = screen.frame(Vec::new()));
    screen
}

#[test]
fn where_a_box_is_and_how_it_stands_is_typed() {
    let slope = 21.8_f64.to_radians();
    for (field, text, expected) in [
        ("1.500", "1.25", Placing::At(0, 1.25)),
        ("2.500", "-3", Placing::At(1, -3.0)),
        ("14.324", "21.8", Placing::Angle(slope)),
        ("3.500", "4", Placing::Side(0, 4.0)),
        ("0.750", "0.2", Placing::Side(1, 0.2)),
    ] {
        assert_eq!(of_a_box().type_in(field, text), [Wish::Place(expected, false)], "{field}");
    }
    let mut screen = of_a_box();
    screen.facts.figures.placed = Some(Placed { middle: [1.0, 2.0, 0.0], angle: None, size: Some(Size::Circle(0.5)) });
    assert_eq!(screen.type_in("0.500", "0.75"), [Wish::Place(Placing::Radius(0.75), false)]);
    assert!(
        !screen.frame(Vec::new()).1.iter().any(|(text, _)| text == "turn by"),
        "a circle looks the same however it is turned"
    );
}

#[test]
fn a_place_that_is_clicked_and_left_stays_however_it_moved_meanwhile() {
    let mut screen = of_a_box();
    screen.click("1.500");
    screen.facts.figures.placed = Some(Placed { middle: [1.75, 2.5, 0.0], angle: None, size: None });
    let beside = click(Pos2::new(300.0, 700.0)).into_iter().chain([Vec::new()]);
    let asked: Vec<Wish> = beside.flat_map(|events| screen.frame(events).0).collect();
    assert_eq!(asked, []);
    screen.place("1.750");
}

#[test]
fn what_is_typed_of_a_place_stays_while_that_moves() {
    let mut screen = of_a_box();
    screen.click("1.500");
    let mut asked = Vec::new();
    for (x, text) in [(1.6, "4."), (1.7, "2"), (1.8, "5")] {
        screen.facts.figures.placed = Some(Placed { middle: [x, 2.5, 0.0], angle: None, size: None });
        asked.extend(screen.frame(vec![Event::Text(text.to_owned())]).0);
    }
    let beside = click(Pos2::new(300.0, 700.0)).into_iter().chain([Vec::new()]);
    asked.extend(beside.flat_map(|events| screen.frame(events).0));
    assert_eq!(asked, [Wish::Place(Placing::At(0, 4.25), false)]);
    screen.place("1.800");
}

#[test]
fn a_turn_that_is_dragged_on_is_asked_for_from_its_beginning_and_begins_at_0_again() {
    let mut screen = of_a_box();
    screen.facts.figures.placed = Some(Placed { middle: [1.0, 2.0, 0.0], angle: None, size: None });
    let at = screen.place("0.000");
    screen.frame(vec![Event::PointerMoved(at)]);
    let mut all = screen.frame(vec![button(at, true)]).0;
    for x in [20.0, 40.0, 60.0] {
        all.extend(screen.frame(vec![Event::PointerMoved(at + vec2(x, 0.0))]).0);
    }
    all.extend(screen.frame(vec![button(at + vec2(60.0, 0.0), false)]).0);
    let turns: Vec<(f64, bool)> = all
        .iter()
        .map(|wish| match wish {
            Wish::Place(Placing::TurnBy(turn), goes_on) => (turn.to_degrees(), *goes_on),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(turns.len() >= 2 && turns.is_sorted_by(|a, b| a.0 < b.0), "{turns:?}");
    assert!((turns[turns.len() - 1].0 - 30.0).abs() < 3.5, "{turns:?}");
    assert!(!turns[0].1 && turns[1..].iter().all(|(_, goes_on)| *goes_on), "{turns:?}");
    assert_eq!(screen.place("0.000"), at);
}
