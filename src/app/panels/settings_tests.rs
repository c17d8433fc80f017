//! Settings without a window: what drags and clicks on the panel ask for.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use egui::{Event, Pos2, Shape, pos2, vec2};

use super::pointer::button;
use super::{Facts, PanelState, Setting, Settings, Wish, parameters, settings};
use crate::app::player::{MethodSetting, Note, Order, Shown, Stage};
use crate::history::{Do, SetKeys};
use crate::scene::{Scene, SolverName, Vector, gallery};
use crate::sim::{Change, Command, Solver};

const SCENE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0, 1]]}, "drag_rate": 0.5,
    "bounds": {"min": [-5, -5], "max": [5, 5], "friction": 0.4}, "mouse": {"strength": 20, "radius": 1}}"#;

fn stage() -> Stage {
    Stage::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap()
}

fn shown(stage: &mut Stage) -> Shown {
    let mut shown = Shown::default();
    stage.show(&mut shown);
    shown
}

/// A panel on a screen of its own.
struct Screen {
    context: egui::Context,
    state: PanelState,
    facts: Facts,
}

impl Screen {
    fn new(stage: &mut Stage) -> Self {
        let now = shown(stage);
        let (scene, points) = (now.settings.clone(), now.point_count());
        let settings = Settings { scene, points, push: Some([20.0, 1.0]), ..Settings::default() };
        let facts = Facts { settings, dimensions: 2, ..Facts::default() };
        let mut screen = Screen { context: egui::Context::default(), state: PanelState::default(), facts };
        // The first two frames find their sizes.
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
        screen
    }

    /// A frame with events. Returns what is asked for, and the middle of the dial if it is seen.
    fn frame(&mut self, events: Vec<Event>) -> (Vec<Setting>, Option<Pos2>) {
        let mut wishes = Vec::new();
        let screen_rect = Some(egui::Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
        let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
        let mut output = self.context.run_ui(input, |ui| {
            let room = ui.available_rect_before_wrap();
            settings::show(ui.ctx(), room, &mut self.state, &self.facts, &mut wishes);
        });
        output.textures_delta.clear();
        let dial = output.shapes.iter().find_map(|clipped| match &clipped.shape {
            Shape::Circle(circle) if circle.radius > 20.0 => Some(circle.center),
            _ => None,
        });
        let settings = wishes.into_iter().filter_map(|wish| if let Wish::Set(set) = wish { Some(set) } else { None });
        (settings.collect(), dial)
    }
}

fn gravity(set: &Setting) -> [f64; 3] {
    match &set.act {
        Do::Set(keys) => keys.gravity.unwrap().embed(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_drag_of_the_dial_is_one_edit() {
    let mut screen = Screen::new(&mut stage());
    let middle = screen.frame(Vec::new()).1.unwrap();
    screen.frame(vec![Event::PointerMoved(middle)]);
    let mut all = screen.frame(vec![button(middle, true)]).0;
    for x in [10.0, 16.0] {
        all.extend(screen.frame(vec![Event::PointerMoved(middle + vec2(x, 0.0))]).0);
    }
    let last = screen.frame(vec![button(middle + vec2(16.0, 0.0), false)]).0;
    assert!(all.len() >= 2 && last.iter().all(|set| set.goes_on), "{all:?} {last:?}");
    assert_eq!(
        all.iter().map(|set| set.goes_on).collect::<Vec<_>>(),
        [vec![false], vec![true; all.len() - 1]].concat()
    );
    assert!(all.iter().all(|set| set.name == "gravity"));
    let to = gravity(all.last().unwrap());
    assert!((to[0] - 10.0).abs() < 0.05 && to[1] == 0.0, "half the way to the rim: {to:?}");
    // Another drag is another edit.
    screen.frame(Vec::new());
    let at = middle + vec2(0.0, 20.0);
    screen.frame(vec![Event::PointerMoved(at)]);
    screen.frame(vec![button(at, true)]);
    let again = screen.frame(vec![Event::PointerMoved(at + vec2(0.0, 8.0))]).0;
    assert!(!again[0].goes_on, "{again:?}");
}

#[test]
fn nothing_is_asked_for_where_nothing_is_touched() {
    let mut screen = Screen::new(&mut stage());
    for x in 0..40 {
        let over = Event::PointerMoved(pos2(1020.0 + 6.0 * x as f32, 690.0 - 13.0 * x as f32));
        assert_eq!(screen.frame(vec![over]).0, []);
    }
}

#[test]
fn what_is_shown_is_what_the_world_has_and_setting_it_changes_nothing() {
    for entry in gallery().iter().filter(|entry| entry.name != "million-cloth") {
        let scene = entry.scene().unwrap();
        let mut world = scene.world(None).unwrap();
        let settings = world.settings();
        let set = Command::Set(Change::Scene(Box::new(settings.clone())));
        assert!(!world.apply(&set).unwrap().is_something, "{}", entry.name);
        assert_eq!(world.settings(), settings, "{}", entry.name);
    }
}

#[test]
fn every_number_that_a_scene_of_the_gallery_names_can_be_set_to_both_ends_while_it_runs() {
    let mut count = 0;
    for entry in gallery().iter().filter(|entry| entry.name != "million-cloth") {
        let scene = entry.scene().unwrap();
        let named = scene.named_parameters();
        for (place, parameter) in named.iter().enumerate() {
            let mut stage = Stage::new(scene.clone().into()).unwrap();
            let case = format!("{}: {}", entry.name, parameter.label);
            for to in [*parameter.range.start(), *parameter.range.end()] {
                let now = shown(&mut stage);
                let vector = |v: [f64; 3]| Vector::new(v, now.dimensions);
                let acts = parameters::commands(&parameter.target, to, &now.settings, vector).unwrap();
                assert_eq!(stage.obey(Order::Give(acts, Some("parameter"))), None, "{case}");
                (0..6).for_each(|_| _ = stage.obey(Order::Step(None)));
                assert!(stage.history().world().is_finite(), "{case} at {to}");
                let now = shown(&mut stage);
                let push = stage.history().world().mouse_force().map(|force| [force.strength, force.radius]);
                let value = parameters::all(&named, &now, push)[place].1;
                assert!(value.is_some_and(|value| (value - to).abs() <= 1e-9 * to.abs()), "{case}: {value:?} for {to}");
            }
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn a_slider_over_several_planes_leaves_each_its_other_number() {
    let plane = |x: i32, both: [f64; 2]| {
        let [stiffness, damping] = both;
        format!(
            r#"{{"plane": {{"point": [{x}, 0], "normal": [{}, 1]}}, "penalty": {{"stiffness": {stiffness}, "damping": {damping}}}}}"#,
            -x
        )
    };
    let planes = [plane(0, [100.0, 1.0]), plane(1, [200.0, 2.0]), plane(-1, [300.0, 1.0])].join(", ");
    let text = format!(
        r#"{{"wobble": 1, "points": {{"position": [[0, 3]]}}, "obstacles": [{planes}],
        "parameters": [{{"path": "obstacles[0-2].penalty.stiffness", "min": 10, "max": 1000}},
            {{"path": "obstacles[0-2].penalty.damping", "min": 0, "max": 9}}]}}"#
    );
    let scene = Scene::parse(&text, "x.json").unwrap();
    let named = scene.named_parameters();
    let mut stage = Stage::new(scene.into()).unwrap();
    let mut set = |place: usize, to: f64| {
        let now = shown(&mut stage);
        let target = &parameters::all(&named, &now, None)[place].0.target;
        let acts = parameters::commands(target, to, &now.settings, |v| Vector::new(v, 2)).unwrap();
        assert_eq!(stage.obey(Order::Give(acts, Some("parameter"))), None);
        shown(&mut stage).scenery.penalties.iter().map(|(_, both)| *both).collect::<Vec<[f64; 2]>>()
    };
    assert_eq!(set(0, 500.0), [[500.0, 1.0], [500.0, 2.0], [500.0, 1.0]]);
    assert_eq!(set(0, 600.0), [[600.0, 1.0], [600.0, 2.0], [600.0, 1.0]]);
    assert_eq!(set(1, 4.0), [[600.0, 4.0]; 3]);
}

#[test]
fn a_slider_is_undone_as_one_and_what_is_shown_follows() {
    let mut stage = stage();
    let set = |y: f64| {
        let keys = SetKeys { gravity: Some(Vector::Plane([0.0, y])), ..SetKeys::default() };
        Do::Set(Box::new(keys))
    };
    assert_eq!(stage.obey(Order::Give(vec![set(-5.0)], Some("gravity"))), None);
    assert_eq!(stage.obey(Order::GiveOn(set(-2.0), "gravity")), None);
    assert_eq!(shown(&mut stage).settings.gravity, Some([0.0, -2.0, 0.0]));
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "gravity"));
    assert_eq!(shown(&mut stage).settings.gravity, Some([0.0, -9.81, 0.0]));
}

#[test]
fn another_solver_leaves_the_rest_of_the_method() {
    let mut stage = stage();
    let before = stage.history().world().method();
    assert_eq!(stage.obey(Order::Solver(SolverName::Rk4)), None);
    let method = stage.history().world().method();
    assert_eq!((method.solver, method.sleeps, method.precision), (Solver::Rk4, before.sleeps, before.precision));
    let names = Solver::ALL.map(|solver| solver.name());
    let named: Vec<&str> = SolverName::NAMES.iter().copied().filter(|name| *name != "as-printed").collect();
    assert_eq!(names, named[..], "the list is by the names of files");
}

#[test]
fn numbers_of_the_method_are_set_one_by_one_and_undone() {
    let mut stage = stage();
    let before = stage.history().world().method();
    let all = [
        MethodSetting::Substep(Some(0.002)),
        MethodSetting::Iterations(Some(7)),
        MethodSetting::Order(crate::scene::OrderName::Shuffled),
        MethodSetting::Seed(9),
        MethodSetting::MaxStrain(Some(0.01)),
        MethodSetting::Budget(None),
        MethodSetting::Sleep(false),
        MethodSetting::Settle(true),
    ];
    for setting in all {
        assert_eq!(stage.obey(Order::Method(setting, false)), None, "{setting:?}");
    }
    let method = stage.history().world().method();
    assert_eq!((method.substep, method.iterations, method.max_strain), (Some(0.002), Some(7), Some(0.01)));
    assert_eq!((method.budget, method.sleeps, method.settles), (None, false, true));
    assert_eq!((method.order, method.seed), (crate::sim::Order::Shuffled, 9));
    assert_eq!(method.solver, before.solver);
    assert_eq!(stage.obey(Order::Method(MethodSetting::Substep(Some(0.001)), false)), None);
    assert_eq!(stage.obey(Order::Method(MethodSetting::Substep(Some(0.0005)), true)), None);
    assert_eq!(stage.history().world().method().substep, Some(0.0005));
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "substep"));
    assert_eq!(stage.history().world().method().substep, Some(0.002), "a drag is undone as one");
    assert_eq!(stage.obey(Order::Method(MethodSetting::Substep(None), false)), None);
    assert_eq!(stage.history().world().method().substep, None, "as the rules choose");
}

#[test]
fn numbers_that_a_scene_names_are_read_from_the_world_and_set_by_their_sliders() {
    let text = r#"{"wobble": 1, "gravity": [0, -9.81], "drag_rate": 0.5,
        "points": {"position": [[0, 0], [1, 0], [2, 0]], "pinned": [0]}, "bounds": {"min": [-5, -5], "max": [5, 5], "friction": 0.4},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 50}, {"a": 1, "b": 2, "kind": "spring", "stiffness": 50}],
        "parameters": [{"path": "bonds[0-1].stiffness", "min": 10, "max": 1000, "label": "both springs", "unit": "N/m"},
            {"path": "bounds.friction", "min": 0, "max": 1}, {"path": "gravity[1]", "min": -20, "max": 0}]}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let mut stage = Stage::new(scene.clone().into()).unwrap();
    let read = |stage: &mut Stage| {
        let shown = shown(stage);
        let of = |parameter: crate::scene::Parameter| {
            let value = parameters::value(&parameter.target, &shown.settings, None, &shown.scenery);
            (parameter, value)
        };
        scene.named_parameters().into_iter().map(of).collect::<Vec<_>>()
    };
    let values = |stage: &mut Stage| read(stage).into_iter().map(|(_, value)| value.unwrap()).collect::<Vec<f64>>();
    assert_eq!(values(&mut stage), [50.0, 0.4, -9.81]);
    let mut screen = Screen::new(&mut stage);
    screen.facts.settings.parameters = read(&mut stage);
    (0..2).for_each(|_| _ = screen.frame(Vec::new()));
    // Sliders of all heights: a press at the right end of each that is among the first.
    let mut acts = Vec::new();
    for step in 0..90 {
        let at = pos2(1130.0, 40.0 + 4.0 * step as f32);
        screen.frame(vec![Event::PointerMoved(at)]);
        let pressed = screen.frame(vec![button(at, true)]).0;
        acts.extend(pressed.into_iter().map(|set| (set.name, set.act)));
        screen.frame(vec![button(at, false)]);
    }
    // What the scene names stands above all else.
    let first = |name: &str| acts.iter().find(|(own, _)| *own == name).map(|(_, act)| act.clone());
    for act in ["stiffness", "friction", "gravity"].map(|name| first(name).unwrap()) {
        assert_eq!(stage.obey(Order::Give(vec![act], Some("parameter"))), None);
    }
    let [stiffness, friction, gravity] = values(&mut stage)[..] else { panic!("three") };
    assert!(stiffness > 50.0 && friction > 0.4 && gravity > -9.81, "{stiffness} {friction} {gravity}");
    let world = stage.history().world();
    let is_set = |bond: crate::sim::Bond| matches!(bond.kind, crate::sim::BondKind::Spring { stiffness: k, .. } if k == stiffness);
    assert!(world.bonds().iter().all(is_set));
}

impl Screen {
    /// Clicks on words; returns what that asks for.
    fn click(&mut self, words: &str) -> Vec<Setting> {
        let at = self.find(words).unwrap_or_else(|| panic!("{words} is not there"));
        super::pointer::click(at).into_iter().flat_map(|events| self.frame(events).0).collect()
    }

    /// Where words stand.
    fn find(&mut self, words: &str) -> Option<Pos2> {
        let mut wishes = Vec::new();
        let screen_rect = Some(egui::Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 1600.0)));
        let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
        let mut output = self.context.run_ui(input, |ui| {
            let room = ui.available_rect_before_wrap();
            settings::show(ui.ctx(), room, &mut self.state, &self.facts, &mut wishes);
        });
        output.textures_delta.clear();
        let is_it = |shape: &Shape| match shape {
            Shape::Text(text) if text.galley.text() == words => Some(text.pos + 0.5 * text.galley.size()),
            _ => None,
        };
        output.shapes.iter().find_map(|clipped| is_it(&clipped.shape))
    }
}

#[test]
fn the_region_of_the_push_and_how_it_falls_off_are_set_one_by_one_and_undone() {
    let mut stage = stage();
    let now = |stage: &Stage| stage.history().world().mouse_force().map(super::Pushing::of);
    for (name, search, region, profile) in [
        ("square", "region", crate::sim::Region::Square, crate::sim::Profile::Smooth),
        ("not at all", "falls off", crate::sim::Region::Round, crate::sim::Profile::Linear),
    ] {
        let mut screen = Screen::new(&mut stage);
        screen.state.settings_search = search.to_owned();
        screen.facts.settings.pushing = now(&stage);
        let before = now(&stage);
        let [set] = &screen.click(name)[..] else { panic!("{name}") };
        assert_eq!(stage.obey(Order::Give(vec![set.act.clone()], Some(set.name))), None);
        assert_eq!(now(&stage), Some(super::Pushing { region, profile, has_track: false }), "{name}");
        screen.facts.settings.pushing = now(&stage);
        assert!(screen.click(name).is_empty(), "{name}: it is so");
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "push"));
        assert_eq!(now(&stage), before);
    }
}

#[test]
fn a_scene_without_a_push_can_have_one_and_one_on_a_track_follows_the_pointer() {
    let bare = r#"{"wobble": 1, "points": {"position": [[0, 1]]}}"#;
    let tracked = r#"{"wobble": 1, "points": {"position": [[0, 1]]},
        "mouse": {"strength": 20, "radius": 1, "track": [[0, 0, 0], [9, 1, 1]]}}"#;
    for (text, button) in [(bare, "add one"), (tracked, "follow the pointer")] {
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let mut screen = Screen::new(&mut stage);
        screen.state.settings_search = "push".to_owned();
        screen.facts.settings.push = None;
        screen.facts.settings.pushing = stage.history().world().mouse_force().map(super::Pushing::of);
        let [set] = &screen.click(button)[..] else { panic!("{button}") };
        assert_eq!(stage.obey(Order::Give(vec![set.act.clone()], Some(set.name))), None);
        let force = stage.history().world().mouse_force().cloned();
        assert!(force.is_some_and(|force| force.track.knots.is_empty() && force.radius > 0.0), "{button}");
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
    }
}

#[test]
fn areas_are_kept_or_not_and_skins_are_as_thick_as_is_said() {
    let text = r#"{"wobble": 1, "contact": {"radius": 0.02}, "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5,
        "material": {"kind": "spring", "stiffness": 300, "mass": 4}}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let mut screen = Screen::new(&mut stage);
    screen.state.settings_search = "areas".to_owned();
    let before = shown(&mut stage).settings;
    for (name, is_done) in [("areas are kept", "areas"), ("with one another", "contact"), ("skin", "contact")] {
        let [set] = &screen.click(name)[..] else { panic!("{name}") };
        assert_eq!(set.name, is_done);
        assert_eq!(stage.obey(Order::Give(vec![set.act.clone()], Some(set.name))), None, "{name}");
        let now = shown(&mut stage).settings;
        match name {
            "areas are kept" => assert!(now.areas.flatten().is_some_and(|areas| areas.stiffness.is_infinite())),
            "with one another" => assert!(now.contact.flatten().is_some_and(|contact| !contact.with_others)),
            _ => assert!(now.contact.flatten().is_some_and(|contact| contact.radius.is_none()), "as the rules choose"),
        }
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
        assert_eq!(shown(&mut stage).settings, before, "{name}");
    }
}

#[test]
fn rows_stay_where_they_are_while_what_they_are_of_is_switched_off() {
    let text = r#"{"wobble": 1, "contact": {"radius": 0.02}, "bounds": {"min": [-5, -5], "max": [5, 5]}, "bodies": [{"make": "lattice",
        "columns": 3, "rows": 3, "spacing": 0.5, "material": {"kind": "spring", "stiffness": 300, "mass": 4}}],
        "parameters": [{"path": "contact", "min": 0, "max": 1, "label": "all meet"},
            {"path": "contact.friction", "min": 0, "max": 1.5, "label": "rubbing"},
            {"path": "gravity[1]", "min": -20, "max": 20, "label": "weight"}]}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let mut stage = Stage::new(scene.clone().into()).unwrap();
    let mut screen = Screen::new(&mut stage);
    screen.facts.new_walls = [[-4.0, -3.0, 0.0], [4.0, 3.0, 0.0]];
    let look = |screen: &mut Screen, stage: &mut Stage| {
        let now = shown(stage);
        screen.facts.settings.parameters = parameters::all(&scene.named_parameters(), &now, None);
        screen.facts.settings.scene = now.settings;
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
    };
    for (search, switch, rows) in [
        ("areas", "areas are kept", &["areas resist", "least area", "with one another", "skin"][..]),
        ("contact", "collide", &["with one another", "with themselves", "friction", "skin", "areas resist"]),
        ("walls", "stand", &["left", "top", "friction", "restitution"]),
        ("this scene", "all meet", &["rubbing", "weight"]),
    ] {
        screen.state.settings_search = search.to_owned();
        look(&mut screen, &mut stage);
        let places = |screen: &mut Screen| rows.iter().map(|row| screen.find(row)).collect::<Vec<_>>();
        let before = places(&mut screen);
        assert!(before.iter().all(Option::is_some), "{search}: {rows:?} {before:?}");
        for _ in 0..2 {
            let [set] = &screen.click(switch)[..] else { panic!("{switch}") };
            assert_eq!(stage.obey(Order::Give(vec![set.act.clone()], Some(set.name))), None, "{switch}");
            look(&mut screen, &mut stage);
            assert_eq!(places(&mut screen), before, "{switch}");
        }
    }
}

#[test]
fn rate_and_duration_are_typed_live_and_undone() {
    let mut stage = stage();
    let mut screen = Screen::new(&mut stage);
    screen.state.settings_search = "duration".to_owned();
    let look = |screen: &mut Screen, stage: &mut Stage| {
        screen.facts.settings.clock = Some(shown(stage).figures.clock);
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
    };
    let give = |stage: &mut Stage, sets: &[Setting], name: &str| {
        let [set] = sets else { panic!("{name}: {sets:?}") };
        assert_eq!(set.name, name);
        assert_eq!(stage.obey(Order::Give(vec![set.act.clone()], Some(set.name))), None);
    };
    look(&mut screen, &mut stage);
    // It never ended: now it does, after as long as is usual.
    give(&mut stage, &screen.click("ends"), "duration");
    let now = |stage: &mut Stage| shown(stage).figures;
    assert_eq!(now(&mut stage).clock.duration, Some(20.0));
    look(&mut screen, &mut stage);
    let type_in = |screen: &mut Screen, field: &str, text: &str| {
        screen.click(field);
        screen.frame(vec![Event::Text(text.to_owned())]);
        let beside = super::pointer::click(pos2(200.0, 600.0)).into_iter().chain([Vec::new()]);
        beside.flat_map(|events| screen.frame(events).0).collect::<Vec<Setting>>()
    };
    let sets = type_in(&mut screen, "20.0", "0.5");
    give(&mut stage, &sets, "duration");
    stage.obey(Order::Rate(0.5));
    let sets = type_in(&mut screen, "1.00", "4");
    give(&mut stage, &sets, "rate");
    assert_eq!((now(&mut stage).clock.rate, now(&mut stage).rate), (4.0, 2.0), "at half the pace as before");
    (0..40).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
    let ended = now(&mut stage);
    assert!(ended.ended && !ended.playing && (0.5..0.52).contains(&ended.time), "{} s", ended.time);
    for (name, rate) in [("rate", 0.5), ("duration", 0.5), ("duration", 0.5)] {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(own, _)) if own == name));
        assert_eq!(now(&mut stage).rate, rate);
    }
    assert_eq!(now(&mut stage).clock.duration, None);
}

#[test]
fn labels_come_are_written_anew_put_elsewhere_and_go_each_in_one_step_of_undo() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 1]]}, "labels": [{"at": [0, 2.5], "text": "first"}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let mut screen = Screen::new(&mut stage);
    screen.state.settings_search = "labels".to_owned();
    screen.facts.settings.middle = [1.0, 2.0, 0.0];
    let look = |screen: &mut Screen, stage: &mut Stage| {
        screen.facts.settings.labels = shown(stage).labels;
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
    };
    let give = |stage: &mut Stage, sets: &[Setting]| {
        let [set] = sets else { panic!("{sets:?}") };
        assert_eq!((set.name, set.goes_on), ("labels", false));
        assert_eq!(stage.obey(Order::Give(vec![set.act.clone()], Some(set.name))), None);
        shown(stage).labels.iter().map(|label| (label.text.clone(), label.at, label.point)).collect::<Vec<_>>()
    };
    let first = ("first".to_owned(), Vector::Plane([0.0, 2.5]), None);
    look(&mut screen, &mut stage);
    let all = give(&mut stage, &screen.click("add a label"));
    assert_eq!(all, [first.clone(), ("a label".to_owned(), Vector::Plane([1.0, 2.0]), None)]);
    look(&mut screen, &mut stage);
    // Words are taken as the field is left, by Esc not.
    let key = |key: egui::Key| Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: egui::Modifiers::NONE,
    };
    let mut type_in = |leave: Vec<Vec<Event>>| {
        screen.click("a label");
        let typed = [vec![key(egui::Key::End)], vec![Event::Text(" more".to_owned())]];
        typed.into_iter().chain(leave).chain([Vec::new()]).flat_map(|events| screen.frame(events).0).collect::<Vec<_>>()
    };
    assert_eq!(type_in(vec![vec![key(egui::Key::Escape)]]), []);
    let sets = type_in(Vec::from(super::pointer::click(pos2(200.0, 600.0))));
    let all = give(&mut stage, &sets);
    assert_eq!(all[1].0, "a label more");
    look(&mut screen, &mut stage);
    let along = give(&mut stage, &screen.click("point"));
    assert_eq!((along[0].1, along[0].2), (Vector::Plane([0.0, 0.0]), Some(0)), "the first one goes along with a point");
    look(&mut screen, &mut stage);
    let left = give(&mut stage, &screen.click("×"));
    assert_eq!(left.len(), 1, "{left:?}");
    (0..4).for_each(|_| {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "labels"))
    });
    let labels = shown(&mut stage).labels;
    assert_eq!((labels.len(), labels[0].text.as_str(), labels[0].at), (1, "first", first.1));
}

/// Words that are left by a click on a button of another label: both are done, as one edit.
#[test]
fn words_that_are_left_for_a_button_are_taken_with_what_that_does() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 1]]},
        "labels": [{"at": [0, 1], "text": "one"}, {"at": [0, 2], "text": "two"}]}"#;
    let buttons = [("×", &["two more"][..]), ("add a label", &["one", "two more", "a label"])];
    for ((button, expected), at_once) in buttons.into_iter().flat_map(|case| [(case, true), (case, false)]) {
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let mut screen = Screen::new(&mut stage);
        screen.state.settings_search = "labels".to_owned();
        screen.facts.settings.labels = shown(&mut stage).labels;
        (0..3).for_each(|_| _ = screen.frame(Vec::new()));
        let at = screen.find(button).unwrap();
        screen.click("two");
        let end = Event::Key {
            key: egui::Key::End,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers: egui::Modifiers::NONE,
        };
        screen.frame(vec![end]);
        screen.frame(vec![Event::Text(" more".to_owned())]);
        // A click within one frame, as on a machine that stalls, or in several, of which the world has seen nothing yet.
        let click = super::pointer::click(at);
        let frames = if at_once { vec![click.concat()] } else { click.to_vec() };
        let sets: Vec<Setting> = frames.into_iter().flat_map(|events| screen.frame(events).0).collect();
        let Some(Setting { act: Do::Set(keys), .. }) = sets.last() else { panic!("{button}: {sets:?}") };
        let words: Vec<&str> = keys.labels.iter().flatten().map(|label| label.text.as_str()).collect();
        assert_eq!(words, expected, "{button}, at once: {at_once}");
        assert!(!at_once || sets.len() == 1, "one edit: {sets:?}");
    }
}

/// What is being written in a label stays with it as another one goes.
#[test]
fn what_is_written_in_a_label_stays_with_it_as_others_go() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 1]]}, "labels": [{"at": [0, 1], "text": "one"},
        {"at": [0, 2], "text": "two"}, {"at": [0, 3], "text": "three"}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let mut screen = Screen::new(&mut stage);
    screen.state.settings_search = "labels".to_owned();
    let all = shown(&mut stage).labels;
    screen.facts.settings.labels = Arc::clone(&all);
    (0..3).for_each(|_| _ = screen.frame(Vec::new()));
    screen.click("two");
    screen.frame(vec![Event::Text("2".to_owned())]);
    // The first one goes elsewhere, as undo takes it: the field is still that of the second one.
    for labels in [&all[1..], &all[..]] {
        screen.facts.settings.labels = Arc::new(labels.to_vec());
        (0..2).for_each(|_| _ = screen.frame(Vec::new()));
    }
    let sets: Vec<Setting> =
        super::pointer::click(pos2(200.0, 700.0)).into_iter().flat_map(|events| screen.frame(events).0).collect();
    let [Setting { act: Do::Set(keys), .. }] = &sets[..] else { panic!("{sets:?}") };
    let words: Vec<&str> = keys.labels.iter().flatten().map(|label| label.text.as_str()).collect();
    assert!(words[0] == "one" && words[1] != "two" && words[1].contains('2') && words[2] == "three", "{words:?}");
}

/// A label goes along with a point that there is.
#[test]
fn a_label_can_be_held_to_no_point_that_there_is_not() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 1], [1, 1]]}, "labels": [{"at": [0, 1], "text": "one", "point": 1}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let mut screen = Screen::new(&mut stage);
    screen.state.settings_search = "labels".to_owned();
    screen.facts.settings.labels = shown(&mut stage).labels;
    (0..3).for_each(|_| _ = screen.frame(Vec::new()));
    screen.click("1");
    screen.frame(vec![Event::Text("12".to_owned())]);
    let sets: Vec<Setting> =
        super::pointer::click(pos2(200.0, 700.0)).into_iter().flat_map(|events| screen.frame(events).0).collect();
    assert_eq!(sets, [], "the last one is the highest that there is");
}

/// What is typed after a label was added is its words.
#[test]
fn a_label_that_was_added_is_written_at_once() {
    let mut stage =
        Stage::new(Scene::parse(r#"{"wobble": 1, "points": {"position": [[0, 1]]}}"#, "x.json").unwrap().into());
    let mut screen = Screen::new(stage.as_mut().unwrap());
    screen.state.settings_search = "labels".to_owned();
    (0..3).for_each(|_| _ = screen.frame(Vec::new()));
    assert_eq!(screen.click("add a label").len(), 1);
    screen.frame(Vec::new());
    screen.frame(vec![Event::Text("Hello".to_owned())]);
    let sets: Vec<Setting> =
        super::pointer::click(pos2(200.0, 700.0)).into_iter().flat_map(|events| screen.frame(events).0).collect();
    let [Setting { act: Do::Set(keys), .. }] = &sets[..] else { panic!("{sets:?}") };
    assert_eq!(keys.labels.as_ref().unwrap()[0].text, "Hello");
}

/// What lies beyond the reach of the fields stays where it is as they are shown.
#[test]
fn labels_far_away_stay_there() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 1]]}, "labels": [{"at": [2e6, 1], "text": "far"}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let mut screen = Screen::new(&mut stage);
    screen.facts.settings.labels = shown(&mut stage).labels;
    assert_eq!((0..4).flat_map(|_| screen.frame(Vec::new()).0).collect::<Vec<_>>(), []);
}
