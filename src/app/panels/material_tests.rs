//! The panel of what is selected without a window: what clicks and drags on it ask for.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use egui::{Event, Pos2, Rect, Shape, pos2, vec2};

use super::places::ToolRooms;
use super::pointer::{button, click};
use super::{Facts, PanelState, Wish, material};
use crate::app::action::{Action, Tool};
use crate::app::matter::{Among, Matter, MatterChange, Preset};
use crate::app::player::{Order, Shown, Stage};
use crate::scene::Scene;
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
}

impl Screen {
    fn new(matter: Option<Arc<Matter>>) -> Self {
        let facts = Facts { dimensions: 2, tool: Tool::Select, matter, ..Facts::default() };
        let mut screen = Screen { context: egui::Context::default(), state: PanelState::default(), facts };
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
        screen
    }

    /// A frame with events. Returns what is asked for, and what is written where.
    fn frame(&mut self, events: Vec<Event>) -> (Vec<Wish>, Vec<(String, Pos2)>) {
        let mut wishes = Vec::new();
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 800.0)));
        let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
        let mut output = self.context.run_ui(input, |ui| {
            let room = ui.available_rect_before_wrap();
            let tools = Rect::from_min_size(pos2(10.0, 100.0), vec2(50.0, 400.0));
            let rooms = ToolRooms { tools: room, left: room, right: room };
            material::show(ui.ctx(), (&rooms, tools), &mut self.state, &self.facts, &mut wishes);
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
    assert!(!screen.frame(Vec::new()).1.iter().any(|(text, _)| text == "Group"), "one body is selected as one anyway");
    assert_eq!(screen.click("tears"), [Wish::Matter(MatterChange::Breaks(0.5), false)]);
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
    mixed.stiffness = mixed.stiffness.map(|span| crate::app::matter::Span { most: 2.0 * span.most, ..span });
    assert!(Screen::new(Some(Arc::new(mixed))).place("mixed").x > 60.0);
}

#[test]
fn it_lies_where_what_is_selected_is_not() {
    let mut screen = Screen::new(Some(matter()));
    let selected = |left: f32| Some(Rect::from_min_size(pos2(left, 200.0), vec2(200.0, 200.0)));
    let left = screen.place("Steel").x;
    screen.state.selected_at = selected(150.0);
    let right = screen.place("Steel").x;
    assert!(left < 300.0 && right > 1000.0, "{left} {right}");
    assert_eq!(screen.place("Steel").x, right, "it stays there");
    screen.state.selected_at = selected(1050.0);
    assert_eq!(screen.place("Steel").x, left);
}
