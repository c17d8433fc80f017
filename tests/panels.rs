//! The panels as one uses them: found by the names that what reads aloud has of them, pressed, dragged and typed in; and pictures of them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use egui::{Event, Id, Key, Modifiers, PointerButton, Pos2, Rect};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use wobble::app::action::{Action, Tool};
use wobble::app::rehearsal::Rehearsal;
use wobble::render::Palette;
use wobble::scene::{Scene, gallery};
use wobble::sim::{BondKind, PointId};

use crate::common;
use crate::common::panels::{Textures, harness, picture};

const SIZE: [f32; 2] = [1280.0, 720.0];
/// Gravity as a number that the scene names, and a soft block.
const SCENE: &str = r#"{"wobble": 1, "name": "a block", "gravity": [0, -9.81], "contact": true,
    "bounds": {"min": [-5, 0], "max": [5, 5]}, "mouse": {"strength": 20, "radius": 1},
    "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [0, 1],
        "material": {"kind": "spring", "stiffness": 300, "mass": 4}}],
    "parameters": [{"path": "gravity[1]", "min": -20, "max": 0, "label": "pull of the earth", "unit": "m/s²"},
        {"path": "bounds.friction", "min": 0, "max": 1, "label": "grip of the floor"}]}"#;

type Panels = Harness<'static, Rehearsal>;

fn open(act: &[Action]) -> Panels {
    opened(SCENE, act, 1.0).0
}

fn opened(text: &str, act: &[Action], scale: f32) -> (Panels, Textures) {
    let mut rehearsal = Rehearsal::new(Scene::parse(text, "x.json").unwrap()).unwrap();
    act.iter().for_each(|action| rehearsal.act(*action));
    harness(rehearsal, SIZE, scale)
}

fn press(panels: &mut Panels, name: &str) {
    panels.get_by_label(name).click();
    panels.run_steps(3);
}

/// Looks for a scene in the gallery and opens the first that is found.
fn open_from_the_gallery(panels: &mut Panels, search: &str) {
    panels.state_mut().act(Action::Gallery);
    panels.run_steps(3);
    panels.get_by_label("search the gallery").type_text(search);
    panels.run_steps(2);
    panels.key_press(Key::Enter);
    panels.run_steps(4);
}

/// What is said in the window beside what stands at the pointer: all labels that are shown.
fn says(panels: &Panels, words: &str) -> bool {
    panels.query_all_by_label_contains(words).next().is_some()
}

fn gravity(panels: &Panels) -> f64 {
    panels.state().history().world().settings().gravity.unwrap()[1]
}

#[test]
fn every_tool_is_chosen_by_its_button_and_says_what_it_does_and_by_which_key() {
    let mut panels = open(&[]);
    let tools = [
        (Tool::Pin, "pin a point, or let it go", "2"),
        (Tool::Cut, "cut the bonds that a stroke crosses", "3"),
        (Tool::Erase, "take away bodies, bonds and obstacles: click, or drag over them", "4"),
        (Tool::Build, "build: drag a body or an obstacle out", "5"),
        (Tool::Select, "select, move, turn and scale bodies and obstacles; what they are made of", "6"),
        (Tool::Muscle, "make a bond a muscle: it gets longer and shorter", "7"),
        (Tool::Motor, "hinge a body to another or to the ground, with a motor", "8"),
        (
            Tool::Paint,
            "a brush that makes bodies of jelly, rubber, cloth, wood or steel, or gives them single numbers",
            "9",
        ),
        (Tool::Push, "a force that stays: drag an arrow from a body", "0"),
        (Tool::Hand, "grab and throw; beside bodies, push", "1"),
    ];
    assert_eq!(tools.len(), Tool::ALL.len(), "a tool without a test");
    for (tool, name, key) in tools {
        panels.get_by_label(name).hover();
        panels.run_steps(8);
        assert!(says(&panels, &format!("{name} ({key})")), "{tool:?} has no tip");
        press(&mut panels, name);
        assert_eq!(panels.state().tool(), tool);
    }
}

#[test]
fn every_button_of_the_bar_is_found_by_its_name_and_says_what_it_does_and_by_which_key() {
    let mut panels = open(&[]);
    for (name, said) in [
        ("the scene before", "the scene before"),
        ("the scene after", "the scene after"),
        ("New", "new: an empty scene"),
        ("Draw", "draw a body"),
        ("Open", "open a scene, a recording or a picture"),
        ("Save", "save this moment, or all that was done"),
        ("undo", "nothing to undo"),
        ("redo", "nothing to redo"),
        ("Fit", "fit all points"),
        ("Bodies", ""),
        ("Strain", ""),
        ("Bonds", ""),
        ("lessons: how it works", "lessons: how it works"),
        ("plots of the energies", "plots of the energies"),
        ("settings of the scene", "settings of the scene"),
        ("?", "the keys"),
        ("one frame on", "one frame on"),
        ("back to the start", "back to the start"),
    ] {
        let button = panels.get_by_label(name);
        let place = button.rect();
        assert!(place.width() >= 26.0 && place.height() >= 26.0, "{name}: {place:?}");
        button.hover();
        panels.run_steps(8);
        assert!(says(&panels, &format!("{said} (")), "{name} has no tip with its key");
    }
}

#[test]
fn undo_and_redo_are_off_where_there_is_nothing_and_say_what_there_is() {
    let mut panels = open(&[Action::Settings]);
    let rect = slider(&panels);
    panels.drag_at(Pos2::new(rect.left() + 0.3 * rect.width(), rect.center().y));
    panels.run_steps(2);
    let to = Pos2::new(rect.left() + 0.8 * rect.width(), rect.center().y);
    panels.hover_at(to);
    panels.run_steps(2);
    panels.drop_at(to);
    panels.run_steps(3);
    for (name, other, said) in [("undo", "redo", "undo: gravity ("), ("redo", "undo", "redo: gravity (")] {
        assert!(panels.get_by_label(other).accesskit_node().is_disabled(), "nothing to {other}");
        panels.get_by_label(name).hover();
        panels.run_steps(8);
        assert!(says(&panels, said), "{said}");
        press(&mut panels, name);
    }
}

#[test]
fn wind_has_a_button_of_its_own() {
    let mut panels = open(&[]);
    press(&mut panels, "wind: drag an arrow through the air");
    assert_eq!(panels.state().tool(), Tool::Push);
    assert!(says(&panels, "the air is still"), "its panel says what blows");
    press(&mut panels, "a force that stays: drag an arrow from a body");
    assert!(!says(&panels, "the air is still") && says(&panels, "Force that stays"));
}

#[test]
fn whatever_can_be_pressed_or_typed_in_has_a_name() {
    let tools = Tool::ALL.map(|tool| vec![Action::Take(tool)]);
    let others = [Action::Settings, Action::Plots, Action::Lessons, Action::Gallery, Action::Help].map(|act| vec![act]);
    for act in tools.into_iter().chain(others) {
        let (mut panels, _) = opened(SCENE, &act, 1.0);
        panels.state_mut().select((0..9).map(PointId).collect());
        panels.run_steps(3);
        panels.check_accessibility();
    }
}

#[test]
fn buttons_stand_where_they_are_whatever_a_scene_is_called() {
    let at = |name: &str| {
        let text = SCENE.replace("a block", name);
        let (panels, _) = opened(&text, &[], 1.0);
        ["undo", "redo", "Save", "settings of the scene", "?"].map(|name| panels.get_by_label(name).rect())
    };
    assert_eq!(at("x"), at("a scene with a very long name that has no end and goes on and on"));
}

#[test]
fn a_slider_sets_gravity_by_a_command_that_is_undone() {
    let mut panels = open(&[Action::Settings]);
    let rect = slider(&panels);
    let at = |share: f32| Pos2::new(rect.left() + share * rect.width(), rect.center().y);
    panels.drag_at(at(0.3));
    panels.run_steps(2);
    for share in [0.4, 0.8] {
        panels.hover_at(at(share));
        panels.run_steps(2);
    }
    panels.drop_at(at(0.8));
    panels.run_steps(3);
    let set = gravity(&panels);
    assert!((-8.0..0.0).contains(&set) && set != -9.81, "{set}");
    assert!(panels.state().history().recording().commands.len() >= 2, "what was dragged is in the log");
    panels.state_mut().act(Action::Undo);
    panels.run_steps(3);
    assert_eq!(gravity(&panels), -9.81, "the drag is undone as one");
    press(&mut panels, "down");
    press(&mut panels, "0");
    assert_eq!(gravity(&panels), 0.0);
    assert_eq!(panels.state().refusals(), [""; 0]);
}

/// Where the slider of gravity is.
fn slider(panels: &Panels) -> Rect {
    let all: Vec<_> = panels.get_all_by_label("pull of the earth").collect();
    all.iter().map(|node| node.rect()).find(|rect| rect.width() > 100.0).unwrap()
}

#[test]
fn a_drag_that_one_long_frame_brings_sets_a_slider_too() {
    let mut panels = open(&[Action::Settings]);
    let rect = slider(&panels);
    let at = |share: f32| Pos2::new(rect.left() + share * rect.width(), rect.center().y);
    let button = |pos: Pos2, pressed: bool| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let events = [
        Event::PointerMoved(at(0.2)),
        button(at(0.2), true),
        Event::PointerMoved(at(0.5)),
        Event::PointerMoved(at(0.8)),
        button(at(0.8), false),
        // It goes on to something else.
        Event::PointerMoved(Pos2::new(600.0, 300.0)),
    ];
    panels.input_mut().events.extend(events);
    panels.run_steps(6);
    let set = gravity(&panels);
    assert!((-6.0..-2.0).contains(&set), "{set}");
    panels.state_mut().act(Action::Undo);
    panels.run_steps(3);
    assert_eq!(gravity(&panels), -9.81, "it is one edit");
}

#[test]
fn the_search_has_the_focus_when_it_is_asked_for_and_stays_where_it_is() {
    for size in [SIZE, [720.0, 1280.0]] {
        let mut rehearsal = Rehearsal::new(Scene::parse(SCENE, "x.json").unwrap()).unwrap();
        rehearsal.act(Action::FindSetting);
        let (mut panels, _) = harness(rehearsal, size, 1.0);
        let field = |panels: &Panels| panels.get_by_label("search the settings").rect();
        let before = field(&panels);
        assert!(panels.get_by_label("search the settings").is_focused());
        for letter in ["w", "i", "n", "d", "q"] {
            panels.event(Event::Text(letter.to_owned()));
            panels.run_steps(3);
            assert_eq!(field(&panels), before, "after {letter} in {size:?}");
        }
        assert!(says(&panels, "no setting found"), "what was typed is in the field");
    }
}

#[test]
fn settings_are_found_by_a_word() {
    let mut panels = open(&[Action::Settings]);
    assert!(says(&panels, "sweeps") && says(&panels, "turbulence"));
    panels.get_by_label("search the settings").focus();
    panels.run_steps(2);
    panels.get_by_label("search the settings").type_text("sweep");
    panels.run_steps(3);
    assert!(says(&panels, "sweeps") && !says(&panels, "turbulence"));
    press(&mut panels, "sweeps");
    assert_eq!(panels.state().history().world().method().iterations, Some(10));
    panels.get_by_label("search the settings").focus();
    panels.run_steps(2);
    panels.get_by_label("search the settings").type_text(" of nothing");
    panels.run_steps(3);
    assert!(says(&panels, "no setting found"));
}

#[test]
fn what_is_selected_gets_another_matter_by_its_button() {
    let mut panels = open(&[Action::Take(Tool::Select)]);
    panels.state_mut().select((0..9).map(PointId).collect());
    panels.run_steps(4);
    let stiffness = |panels: &Panels| {
        // What gets stiffer is led there: as it will be.
        let ahead = panels.state().history().ahead();
        let world = ahead.as_deref().unwrap_or(panels.state().history().world());
        world.bonds().iter().find_map(|bond| match bond.kind {
            BondKind::Spring { stiffness, .. } => Some(stiffness),
            _ => None,
        })
    };
    let before = stiffness(&panels);
    for name in ["Rubber", "Jelly", "Wood"] {
        press(&mut panels, name);
        assert_ne!(stiffness(&panels), before, "{name}");
        panels.state_mut().act(Action::Undo);
        panels.run_steps(3);
        assert_eq!(stiffness(&panels), before, "{name} is undone");
    }
    assert_eq!(panels.state().refusals(), [""; 0]);
}

#[test]
fn a_scene_is_found_by_typing_and_opened() {
    let mut panels = open(&[Action::Gallery]);
    panels.run_steps(2);
    // A card is pressed.
    press(&mut panels, gallery()[1].title);
    assert_eq!(panels.state().history().scene().name(), gallery()[1].name);
    // Or words are typed.
    panels.state_mut().act(Action::Gallery);
    panels.run_steps(3);
    panels.get_by_label("search the gallery").type_text("wrecking");
    panels.run_steps(3);
    assert!(says(&panels, "Wrecking ball") && !says(&panels, gallery()[1].title));
    panels.key_press(Key::Enter);
    panels.run_steps(3);
    assert_eq!(panels.state().history().scene().name(), "wrecking-ball");
}

#[test]
fn a_lesson_closes_with_its_scene_and_one_click_leads_back() {
    let mut panels = open(&[Action::Lessons]);
    let first = &wobble::lessons::lessons()[0];
    press(&mut panels, &first.title);
    assert!(says(&panels, &first.steps[0].heading));
    let own = panels.state().history().scene().name().to_owned();
    press(&mut panels, "Next");
    let second = panels.state().history().scene().name().to_owned();
    open_from_the_gallery(&mut panels, "wrecking");
    assert!(!panels.state().has_lessons() && panels.query_by_label("Next").is_none(), "it is of another scene");
    press(&mut panels, "Back to the lesson");
    assert_eq!(panels.state().history().scene().name(), second);
    assert!(says(&panels, &first.steps[1].heading), "where it was left, not at {own}");
    assert!(panels.query_by_label("Back to the lesson").is_none());
}

#[test]
fn a_lesson_whose_panel_was_closed_is_left_with_its_scene_and_the_list_comes_next() {
    let mut panels = open(&[Action::Lessons]);
    let [first, second] = [0, 1].map(|lesson| &wobble::lessons::lessons()[lesson]);
    press(&mut panels, &first.title);
    panels.state_mut().act(Action::Lessons);
    open_from_the_gallery(&mut panels, "wrecking");
    assert!(panels.query_by_label("Back to the lesson").is_none(), "what was put away is not offered");
    panels.state_mut().act(Action::Lessons);
    panels.run_steps(4);
    assert!(says(&panels, &second.title) && !says(&panels, &first.steps[0].heading), "no step beside another scene");
}

#[test]
fn a_tool_that_the_scene_has_no_use_for_is_off_and_says_why() {
    let of = |name: &str| {
        let scene = gallery().iter().find(|entry| entry.name == name).unwrap().scene().unwrap();
        harness(Rehearsal::new(scene).unwrap(), SIZE, 1.0).0
    };
    for (name, tool, why) in [
        ("cloth-space", "make a bond a muscle: it gets longer and shorter", "in space nothing is a muscle"),
        ("cloth-space", "hinge a body to another or to the ground, with a motor", "in the plane only"),
        ("relaxation", "make a bond a muscle: it gets longer and shorter", ""),
    ] {
        let mut panels = of(name);
        panels.get_by_label(tool).hover();
        panels.run_steps(8);
        assert!(why.is_empty() || says(&panels, why), "{name}: {tool}");
        press(&mut panels, tool);
        assert_eq!(panels.state().tool() == Tool::Hand, !why.is_empty(), "{name}: {tool}");
    }
}

#[test]
fn how_stiff_relaxed_bonds_are_stands_among_the_figures() {
    let scene = gallery().iter().find(|entry| entry.name == "relaxation").unwrap().scene().unwrap();
    let panels = harness(Rehearsal::new(scene).unwrap(), SIZE, 1.0).0;
    assert!(says(&panels, "152 N/m"));
    assert!(!says(&open(&[]), "N/m"));
}

#[test]
fn the_palette_is_changed_in_the_settings() {
    let mut panels = open(&[Action::Settings]);
    panels.get_by_label("search the settings").focus();
    panels.run_steps(2);
    panels.get_by_label("search the settings").type_text("colours");
    panels.run_steps(3);
    press(&mut panels, "light");
    assert_eq!(panels.state().palette(), Palette::Light);
    assert!(!panels.ctx.global_style().visuals.dark_mode, "the panels are light");
    press(&mut panels, "dark");
    assert_eq!(panels.state().palette(), Palette::Dark);
}

/// Panels with the areas that they lie in, and what is done before.
const PICTURES: [(&str, &str, &[Action]); 15] = [
    ("bar", "scene", &[]),
    ("tools", "tools", &[]),
    ("settings", "settings", &[Action::Settings]),
    ("settings-light", "settings", &[Action::Settings, Action::Palette]),
    ("matter", "matter", &[Action::Take(Tool::Select)]),
    ("lessons", "lessons", &[Action::Lessons]),
    ("build", "primitives", &[Action::Take(Tool::Build)]),
    ("plots", "plots", &[Action::Plots]),
    ("gallery", "gallery", &[Action::Gallery]),
    ("keys", "keys", &[Action::Help]),
    ("brush", "brush", &[Action::Take(Tool::Paint)]),
    ("muscles", "drives", &[Action::Take(Tool::Muscle)]),
    ("hinge", "drives", &[Action::Take(Tool::Motor)]),
    ("figures", "figures", &[]),
    ("force", "push", &[Action::Take(Tool::Push)]),
];

#[test]
fn panels_look_as_they_did_at_both_scales() {
    let Some(gpu) = common::gpu() else { return };
    for (name, area, act) in PICTURES {
        for (scale, percent) in [(1.0, 100), (2.0, 200)] {
            let (mut panels, textures) = opened(SCENE, act, scale);
            if area == "matter" {
                panels.state_mut().select((0..9).map(PointId).collect());
            }
            panels.run_steps(8);
            let id = Id::unique(area);
            let rect = panels.ctx.memory(|memory| memory.area_rect(id)).unwrap_or(Rect::ZERO);
            assert!(rect.is_positive(), "{name} is not shown");
            let drawn = picture(&gpu, (&panels, &textures), rect.expand(3.0));
            common::golden::check(&format!("panels/{name}-{percent}"), &drawn, &gpu.info);
        }
    }
}

/// A drag of a field, found by its name, to the right.
fn pull(panels: &mut Panels, name: &str, far: f32) {
    panels.get_by_label(name).scroll_to_me();
    panels.run_steps(4);
    let from = panels.get_by_label(name).rect().center();
    panels.drag_at(from);
    panels.run_steps(2);
    for share in [0.5, 1.0] {
        panels.hover_at(from + egui::vec2(share * far, 0.0));
        panels.run_steps(2);
    }
    panels.drop_at(from + egui::vec2(far, 0.0));
    panels.run_steps(3);
}

/// What is seen of a world beside its places: mean velocity, skin of the first point, tracks, order and seed.
fn set(panels: &Panels) -> String {
    let world = panels.state().history().world();
    let method = world.method();
    let velocities: Vec<_> = (0..world.point_count() as u32).map(|point| world.velocity(PointId(point))).collect();
    let corrections: Vec<_> = world.bonds().iter().map(|bond| bond.kind).collect();
    let skin = world.skin_of(PointId(0));
    format!("{velocities:?} {skin:?} {:?} {:?} {} {corrections:?}", world.pin_tracks(), method.order, method.seed)
}

#[test]
fn velocity_skin_and_corrections_of_what_is_selected_are_set_by_their_fields_and_undone() {
    let relaxed = SCENE.replace(r#""kind": "spring", "stiffness": 300"#, r#""kind": "relaxed", "max_correction": 0.5"#);
    let relaxed = relaxed.replace(r#""contact": true"#, r#""method": {"substep": 0.002, "iterations": 4}"#);
    for (text, name) in [(SCENE, "velocity x"), (SCENE, "velocity y"), (SCENE, "skin"), (&relaxed, "corrects")] {
        let (mut panels, _) = opened(text, &[Action::Take(Tool::Select)], 1.0);
        panels.state_mut().select((0..9).map(PointId).collect());
        panels.run_steps(4);
        let before = set(&panels);
        pull(&mut panels, name, 40.0);
        let after = set(&panels);
        assert_ne!(after, before, "{name}");
        assert_eq!(panels.state().refusals(), [""; 0], "{name}");
        panels.state_mut().act(Action::Undo);
        panels.run_steps(3);
        assert_eq!(set(&panels), before, "{name}: the drag is undone as one");
    }
}

#[test]
fn a_pin_is_led_along_a_way_whose_places_come_change_and_go_each_as_one_edit() {
    let text = SCENE.replace(r#""origin": [0, 1]"#, r#""origin": [0, 1], "pinned": [0]"#);
    let (mut panels, _) = opened(&text, &[Action::Take(Tool::Select)], 1.0);
    panels.state_mut().select((0..9).map(PointId).collect());
    panels.run_steps(4);
    let knots =
        |panels: &Panels| panels.state().history().world().pin_tracks().pop().map_or(Vec::new(), |(_, knots)| knots);
    let mut counts = vec![knots(&panels).len()];
    for name in ["lead it", "+", "×"] {
        let button = panels.get_all_by_label(name).last().unwrap();
        button.scroll_to_me();
        panels.run_steps(4);
        panels.get_all_by_label(name).last().unwrap().click();
        panels.run_steps(4);
        counts.push(knots(&panels).len());
    }
    assert_eq!(counts, [0, 2, 3, 2]);
    let before = knots(&panels);
    pull(&mut panels, "y of knot 1 of pin 0", 50.0);
    let after = knots(&panels);
    assert!(after[1].1[1] > before[1].1[1] + 0.2 && after[0] == before[0], "{after:?}");
    pull(&mut panels, "time of knot 1 of pin 0", -400.0);
    assert!(knots(&panels)[1].0 > knots(&panels)[0].0, "times ascend: {:?}", knots(&panels));
    let mut left = Vec::new();
    for _ in 0..5 {
        panels.state_mut().act(Action::Undo);
        panels.run_steps(2);
        left.push(knots(&panels).len());
    }
    assert_eq!(left, [2, 2, 3, 2, 0], "each is one step of undo");
    press(&mut panels, "lead it");
    let stop = panels.get_all_by_label("stop").last().unwrap();
    stop.click();
    panels.run_steps(4);
    assert!(knots(&panels).is_empty() && panels.state().history().world().pinned() == [PointId(0)], "it stands again");
    assert_eq!(panels.state().refusals(), [""; 0]);
}

#[test]
fn order_seed_precision_and_tolerance_are_chosen_by_their_lists() {
    let text = SCENE.replace(r#""contact": true,"#, "");
    let (mut panels, _) = opened(&text, &[Action::Settings], 1.0);
    panels.get_by_label("search the settings").focus();
    panels.run_steps(2);
    panels.get_by_label("search the settings").type_text("method");
    panels.run_steps(3);
    let choose = |panels: &mut Panels, list: &str, name: &str| {
        panels.get_by_label(list).click();
        panels.run_steps(4);
        panels.get_all_by_label(name).last().unwrap().click();
        panels.run_steps(4);
    };
    let before = set(&panels);
    choose(&mut panels, "order", "shuffled");
    assert_eq!(panels.state().history().world().method().order, wobble::sim::Order::Shuffled);
    pull(&mut panels, "seed of the order", 60.0);
    assert!(panels.state().history().world().method().seed > 0);
    (0..2).for_each(|_| panels.state_mut().act(Action::Undo));
    panels.run_steps(3);
    assert_eq!(set(&panels), before);
    let precision = |panels: &Panels| panels.state().history().world().precision();
    assert_eq!(precision(&panels), wobble::sim::Precision::F64);
    let places = |panels: &Panels| panels.state().history().world().sample(0.0).position;
    let at = places(&panels);
    choose(&mut panels, "precision", "32 bits");
    assert_eq!(precision(&panels), wobble::sim::Precision::F32);
    let far = at.iter().flatten().zip(places(&panels).iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(far < 1e-6, "it goes on where it was: {far} m");
    choose(&mut panels, "tolerance", "0.1 mm");
    assert_eq!(panels.state().history().world().method().tolerance, Some(1e-4));
    choose(&mut panels, "precision", "64 bits");
    let method = panels.state().history().world().method();
    assert_eq!((precision(&panels), method.tolerance), (wobble::sim::Precision::F64, Some(1e-4)), "both stay");
    assert_eq!(panels.state().refusals(), [""; 0]);
}
