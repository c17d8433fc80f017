//! Every tool on every kind of scene, paused and running: it changes something, which undo takes back to the bit, or it says why not.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use glam::DVec2;

use super::handles::{Frame, Handle};
use super::tests::{SIZE, scope};
use super::{Chosen, Deed, Hand, Mark, PushWay, Ring, Role, clear_bodies};
use crate::app::action::{Primitive, Tool};
use crate::app::clip::Clip;
use crate::app::import::Import;
use crate::app::matter::{Among, MatterChange, Preset};
use crate::app::opening;
use crate::app::player::Coming;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::{Do, Group, SetKeys, Weather, hash_now};
use crate::picture::Tint;
use crate::render::Camera;
use crate::scene::{Scene, Vector, WindKeys, gallery};
use crate::sim::{Angle, Bond, ForceView, Obstacle, PointId, SceneChange};

/// What is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Act {
    Grab,
    Pin,
    Cut,
    Erase,
    Build,
    Block,
    Cloth,
    Rim,
    Rope,
    Figure,
    Solid,
    SolidBox,
    Slope,
    Polygon,
    Bonds,
    Push,
    PushBody,
    Turned,
    Throw,
    Move,
    Turn,
    Scale,
    Muscle,
    Motor,
    Paint,
    Numbers,
    Hide,
    Preset,
    Soften,
    Copy,
    Group,
    Wind,
    Delete,
    Lasso,
    Clear,
    Drawn,
    Hover,
}

/// What comes of it: an edit, words, a grab or a push of the cursor, which are no edits, or nothing: no body is there to be pushed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Comes {
    Edit,
    Words,
    Grab,
    Push,
    Nothing,
}

use Comes::{Edit as E, Grab as G, Nothing as N, Push as P, Words as W};

/// The scenes of the columns, and the point that is meant in each; `None`: the obstacle in the middle. That in space is the gallery's own cloth.
pub(in crate::app) const SCENES: [(&str, &str, Option<usize>); 7] = [
    (
        "soft",
        r#""bodies": [{"make": "picture", "file": "pictures/jelly.png", "height": 2, "spacing": 0.3, "origin": [0, 1], "velocity": [0.5, 0],
        "material": {"kind": "spring", "stiffness": 400, "damping": 2, "mass": 3}}]"#,
        Some(0),
    ),
    (
        "rope",
        r#""bodies": [{"make": "rope", "count": 20, "to": [4, 0], "origin": [-2, 2], "pinned": [0],
        "material": {"kind": "rigid", "mass": 1}}]"#,
        Some(10),
    ),
    (
        "net",
        r#""bodies": [{"make": "cloth", "columns": 100, "rows": 100, "spacing": 0.05, "origin": [-2.5, 2], "pinned": [0, 99],
        "material": {"kind": "spring", "stiffness": 2000, "damping": 2, "mass": 4}}]"#,
        Some(5050),
    ),
    (
        "pile",
        r#""bodies": [{"make": "lattice", "columns": 4, "rows": 3, "spacing": 0.4, "origin": [-0.6, -3],
        "repeat": {"count": [1, 2], "step": [0, 0.85]},
        "material": {"kind": "spring", "stiffness": 900, "damping": 20, "mass": 1}}]"#,
        Some(13),
    ),
    (
        "rigid",
        r#""bodies": [{"make": "picture", "file": "pictures/gear.png", "height": 2, "spacing": 0.25, "origin": [0, 0.5],
        "spin": 1, "material": {"kind": "rigid", "mass": 2}}]"#,
        Some(5),
    ),
    ("solid", r#""obstacles": [{"box": {"min": [-1, -1], "max": [1, 1], "angle": 0.3}}]"#, None),
    ("space", "", Some(84)),
];

/// Rows: what comes of it in each scene.
const TABLE: [(Act, [Comes; 7]); 37] = [
    //                soft rope net pile rigid solid space
    (Act::Grab, [G, G, G, G, G, E, G]),
    (Act::Pin, [E, E, E, E, E, W, E]),
    (Act::Cut, [E, E, E, E, E, W, E]),
    (Act::Erase, [E, E, E, E, E, E, E]),
    (Act::Build, [E, E, E, E, E, E, W]),
    (Act::Block, [E, E, E, E, E, E, W]),
    (Act::Cloth, [E, E, E, E, E, E, E]),
    (Act::Rim, [E, E, E, E, E, E, W]),
    (Act::Rope, [E, E, E, E, E, E, E]),
    (Act::Figure, [E, E, E, E, E, E, W]),
    (Act::Solid, [E, E, E, E, E, E, E]),
    (Act::SolidBox, [E, E, E, E, E, E, E]),
    (Act::Slope, [E, E, E, E, E, E, W]),
    (Act::Polygon, [E, E, E, E, E, E, W]),
    (Act::Bonds, [E, E, E, E, E, E, W]),
    (Act::Push, [E, E, E, E, E, W, E]),
    (Act::PushBody, [E, E, E, E, E, W, E]),
    (Act::Turned, [E, E, E, E, E, W, W]),
    (Act::Throw, [E, E, E, E, E, W, E]),
    (Act::Move, [E, E, E, E, E, E, E]),
    (Act::Turn, [E, E, E, E, E, E, E]),
    (Act::Scale, [E, E, E, E, E, E, E]),
    // Of what meets others in space no bond is a muscle.
    (Act::Muscle, [E, E, E, E, W, W, W]),
    (Act::Motor, [E, E, E, E, E, W, W]),
    (Act::Paint, [E, E, E, E, E, W, E]),
    (Act::Numbers, [E, E, E, E, E, W, E]),
    (Act::Hide, [E, E, E, E, E, W, E]),
    (Act::Preset, [E, E, E, E, E, E, E]),
    (Act::Soften, [E, W, E, E, W, W, E]),
    (Act::Copy, [E, E, E, E, E, E, E]),
    (Act::Group, [E, E, E, E, E, W, E]),
    (Act::Wind, [E, E, E, E, E, E, E]),
    (Act::Delete, [E, E, E, E, E, E, E]),
    (Act::Lasso, [E, E, E, E, E, E, E]),
    (Act::Clear, [E, E, E, E, E, W, E]),
    (Act::Drawn, [E, E, E, E, E, E, W]),
    // The last, for it is not undone.
    (Act::Hover, [P, P, P, P, P, N, P]),
];

/// The scene of a column.
pub(in crate::app) fn scene_of(name: &str, keys: &str) -> Scene {
    if name == "space" {
        return gallery().iter().find(|entry| entry.name == "cloth-space").unwrap().scene().unwrap();
    }
    let text = format!(
        r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true, "view": {{"center": [0, 0], "height": 8}},
        "mouse": {{"strength": 3000, "radius": 0.8}},
        "bounds": {{"min": [-5, -3], "max": [5, 5], "friction": 0.5}}, {keys}}}"#
    );
    Scene::parse(&text, "x.json").unwrap()
}

/// A canvas that somebody has painted a thick stroke on.
fn painted() -> Import {
    let mut import = Import::of_canvas(|| ()).unwrap();
    let context = egui::Context::default();
    let button = |pos, pressed| {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        egui::Event::PointerButton { pos, button, pressed, modifiers }
    };
    let [from, to] = [[330.0, 300.0], [470.0, 380.0]].map(egui::Pos2::from);
    let stroke = [
        vec![egui::Event::PointerMoved(from)],
        vec![button(from, true)],
        vec![egui::Event::PointerMoved(to)],
        vec![button(to, false)],
    ];
    // A window is measured first, then placed.
    for events in [vec![], vec![], vec![]].into_iter().chain(stroke) {
        let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 720.0)));
        let input = egui::RawInput { screen_rect, events, ..Default::default() };
        let mut output = context.run_ui(input, |ui| _ = import.show(ui.ctx(), true));
        output.textures_delta.clear();
    }
    assert!(import.has_work(), "the stroke is on the canvas");
    import
}

/// All that an edit may change.
#[derive(Clone, Debug, PartialEq)]
struct State {
    hash: String,
    bonds: Vec<Bond>,
    angles: Vec<Angle>,
    masses: Vec<f64>,
    pinned: Vec<PointId>,
    obstacles: Vec<(u32, Obstacle)>,
    tints: Arc<[Tint]>,
    groups: Vec<Group>,
    forces: Vec<ForceView>,
    settings: SceneChange,
}

struct Bench {
    stage: Stage,
    seen: (Shown, Camera, Scene),
    point: Option<usize>,
    /// What was marked before the last press said that something would come.
    promises: bool,
}

impl Bench {
    fn new(name: &str, keys: &str, point: Option<usize>) -> Self {
        let scene = scene_of(name, keys);
        let mut stage = Stage::new(scene.clone().into()).unwrap();
        let mut shown = Shown::default();
        stage.show(&mut shown);
        let camera = opening::camera(&scene, &shown.view(), SIZE);
        let mut bench = Bench { stage, seen: (shown, camera, scene), point, promises: false };
        // What is to sleep does, what is to move does.
        let frames = if name == "pile" { 240 } else { 4 };
        (0..frames).for_each(|_| bench.frame());
        assert!(name != "pile" || bench.seen.0.figures.asleep, "it sleeps");
        bench
    }

    fn frame(&mut self) {
        self.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
        self.stage.show(&mut self.seen.0);
    }

    fn state(&self) -> State {
        let world = self.stage.history().world();
        State {
            hash: hash_now(world, world.time()),
            bonds: world.bonds().iter().collect(),
            angles: world.angles().to_vec(),
            masses: world.masses().to_vec(),
            pinned: world.pinned().to_vec(),
            obstacles: world.obstacles(),
            tints: Arc::clone(self.stage.history().tints()),
            groups: self.stage.history().groups(),
            forces: world.forces(),
            settings: world.settings(),
        }
    }

    /// The pixel that is meant.
    fn target(&self) -> DVec2 {
        match self.point {
            Some(point) => scope(&self.seen).pixel(PointId(point as u32)).unwrap(),
            None => 0.5 * DVec2::from(SIZE.map(f64::from)),
        }
    }

    fn chosen(&self) -> Chosen {
        Chosen::at(scope(&self.seen), self.target()).unwrap()
    }

    /// A press and a release of the left button; while it is down a frame passes.
    fn drag(&mut self, hand: &mut Hand, [from, to]: [DVec2; 2], runs: bool) -> Deed {
        let marks = hand.marks(scope(&self.seen), Some(from));
        let comes = |mark: &Mark| matches!(mark, Mark::Line(Role::Come, ..) | Mark::Ring(Role::Come, ..));
        self.promises = marks.iter().any(comes);
        let deed = hand.press(scope(&self.seen), from);
        if !deed.is_empty() || deed.words.is_some() {
            return deed;
        }
        hand.trace(scope(&self.seen), to);
        if runs {
            self.frame();
        }
        hand.release(scope(&self.seen), to)
    }

    /// Does it as the window would. Returns what the hand says, and the order that it comes to.
    fn try_out(&mut self, act: Act, runs: bool) -> (Option<String>, Option<Order>) {
        let mut hand = Hand::default();
        let at = self.target();
        let [aside, far] = [at + DVec2::new(4.0, 3.0), at + DVec2::new(60.0, -45.0)];
        let tool = match act {
            Act::Grab => Tool::Hand,
            Act::Pin => Tool::Pin,
            Act::Cut => Tool::Cut,
            Act::Erase => Tool::Erase,
            Act::Build | Act::Block | Act::Cloth | Act::Rim | Act::Rope | Act::Figure => Tool::Build,
            Act::Solid | Act::SolidBox | Act::Slope | Act::Polygon | Act::Bonds => Tool::Build,
            Act::Push | Act::PushBody | Act::Turned | Act::Throw => Tool::Push,
            Act::Muscle => Tool::Muscle,
            Act::Motor => Tool::Motor,
            Act::Paint | Act::Numbers => Tool::Paint,
            _ => Tool::Select,
        };
        hand.take(tool);
        let chosen = self.chosen();
        let among = Among { points: chosen.points.clone(), obstacles: chosen.obstacles.clone(), bonds: None };
        let deed = match act {
            Act::Build | Act::Block | Act::Cloth | Act::Rim | Act::Rope | Act::Figure => {
                hand.choose(match act {
                    Act::Block => Primitive::Box,
                    Act::Cloth => Primitive::Cloth,
                    Act::Rim => Primitive::Rim,
                    Act::Rope => Primitive::Rope,
                    Act::Figure => Primitive::Figure,
                    _ => Primitive::Disc,
                });
                hand.hold([false, true]);
                self.drag(&mut hand, [at, far], runs)
            }
            Act::Solid | Act::SolidBox | Act::Slope => {
                hand.choose(match act {
                    Act::SolidBox => Primitive::SolidBox,
                    Act::Slope => Primitive::Slope,
                    _ => Primitive::SolidCircle,
                });
                hand.hold([false, true]);
                // An obstacle takes in no body, and cuts no rope that is held at both ends.
                let beside = DVec2::new(0.0, 150.0);
                self.drag(&mut hand, [at + beside, far + beside], runs)
            }
            Act::Polygon | Act::Bonds => {
                hand.choose(if act == Act::Polygon { Primitive::Polygon } else { Primitive::Bonds });
                // Off what is rigid: between its own points a bond does nothing.
                let off = if act == Act::Bonds { 3.0 } else { 1.0 };
                // Up from the floor, beyond which no bond is drawn.
                let aside = if act == Act::Bonds { -60.0 } else { 60.0 };
                let up = if act == Act::Bonds { -45.0 } else { 45.0 };
                let corners = [at, at + off * DVec2::new(60.0, -45.0), at + off * DVec2::new(aside, up)];
                let deeds = corners.map(|corner| self.drag(&mut hand, [corner; 2], runs));
                let said = deeds.into_iter().find(|deed| *deed != Deed::default());
                said.unwrap_or_else(|| hand.finish(scope(&self.seen)))
            }
            Act::Grab | Act::Push => self.drag(&mut hand, [at, far], runs),
            Act::Turned => {
                hand.set_push_way(PushWay::Turn);
                self.drag(&mut hand, [at, far], runs)
            }
            Act::Throw => {
                hand.set_push_way(PushWay::Speed);
                self.drag(&mut hand, [at, far], runs)
            }
            Act::PushBody => {
                hand.set_push_way(PushWay::Body);
                self.drag(&mut hand, [at, far], runs)
            }
            Act::Numbers => {
                let mut brush = hand.brush();
                brush.numbers.density = crate::app::matter::Switched { is_on: true, value: 2.0 };
                brush.numbers.color.is_on = true;
                hand.set_brush(brush);
                self.drag(&mut hand, [aside, far], runs)
            }
            Act::Hide => {
                let change = MatterChange::Visible(false);
                return (None, Some(Order::Change { among, change, goes_on: false }));
            }
            Act::Cut => self.drag(&mut hand, [at - DVec2::new(31.0, 42.0), at + DVec2::new(33.0, 44.0)], runs),
            Act::Muscle => {
                let ends = self
                    .seen
                    .0
                    .scenery
                    .bonds
                    .ends()
                    .iter()
                    .find(|ends| ends.map(|end| Some(end.index())).contains(&self.point));
                let middle = ends.map(|ends| ends.map(|end| scope(&self.seen).pixel(end).unwrap()));
                let middle = middle.map_or(at, |[a, b]| 0.5 * (a + b));
                self.drag(&mut hand, [middle; 2], runs)
            }
            Act::Turn | Act::Scale if self.seen.0.dimensions == 3 => {
                hand.select(chosen);
                let meant = if act == Act::Turn { Ring::About(2) } else { Ring::Size };
                let marks = hand.marks(scope(&self.seen), None);
                let on = |at: &DVec2| hand.ring(scope(&self.seen), *at) == Some(meant);
                let places = marks.iter().filter_map(|mark| match mark {
                    Mark::Line(_, at, ..) | Mark::Square(_, at, _) => Some(*at),
                    _ => None,
                });
                let from = places.into_iter().find(on).unwrap();
                self.drag(&mut hand, [from, from + DVec2::new(25.0, -20.0)], runs)
            }
            Act::Turn | Act::Scale => {
                hand.select(chosen.clone());
                let handle = if act == Act::Turn { Handle::Turn } else { Handle::Corner(2) };
                let from = Frame::of(scope(&self.seen), &chosen).map_or(at, |frame| {
                    frame.handles(scope(&self.seen)).into_iter().find(|(other, _)| *other == handle).unwrap().1
                });
                self.drag(&mut hand, [from, from + DVec2::new(25.0, -20.0)], runs)
            }
            Act::Preset => {
                let change = MatterChange::Preset(Preset::Rubber);
                return (None, Some(Order::Change { among, change, goes_on: false }));
            }
            Act::Soften => {
                return (None, Some(Order::Change { among, change: MatterChange::Stiffness(123.0), goes_on: false }));
            }
            Act::Copy => {
                let by = chosen.beside(scope(&self.seen));
                let add = move |history: &crate::history::History| {
                    Ok(Coming::of(Clip::of(history, &chosen).placed(history.world(), by)))
                };
                return (None, Some(Order::Add(Box::new(add))));
            }
            Act::Group if chosen.points.len() < 2 => return (Some("the session says so".to_owned()), None),
            Act::Group => {
                let act = Do::Group { points: chosen.points, name: "group 1".to_owned() };
                return (None, Some(Order::Give(vec![act], Some("group"))));
            }
            Act::Wind => {
                let velocity = Vector::new([3.0, 0.0, 0.0], self.seen.0.dimensions);
                let wind = Weather::This(WindKeys { velocity, turbulence: None, seed: None });
                let set = Do::Set(Box::new(SetKeys { wind: Some(wind), ..SetKeys::default() }));
                return (None, Some(Order::Give(vec![set], Some("wind"))));
            }
            Act::Lasso => {
                hand.draw_lasso(true);
                // Around all that is in view, from one corner on.
                let [right, low] = SIZE.map(|side| f64::from(side) - 5.0);
                let corners = [[5.0, 5.0], [right, 5.0], [right, low], [5.0, low]].map(DVec2::from);
                hand.press(scope(&self.seen), corners[0]);
                corners[1..].iter().for_each(|&corner| hand.trace(scope(&self.seen), corner));
                hand.release(scope(&self.seen), corners[3]);
                hand.delete(scope(&self.seen), None)
            }
            Act::Clear => clear_bodies(scope(&self.seen)),
            Act::Drawn => {
                let import = painted();
                let seen = [[-5.0, -3.0], [5.0, 5.0]];
                return (None, Some(Order::Add(Box::new(import.adder(seen)))));
            }
            Act::Delete => {
                hand.select(chosen);
                hand.delete(scope(&self.seen), None)
            }
            Act::Move => self.drag(&mut hand, [at, far], runs),
            _ => self.drag(&mut hand, [aside; 2], runs),
        };
        let order = match deed.painted {
            Some(among) => Some(Order::Change { among, change: hand.brush().change(), goes_on: false }),
            None if deed.commands.is_empty() => None,
            None => Some(Order::Give(deed.commands, deed.edit)),
        };
        (deed.words, order)
    }

    /// The cursor comes to the pixel that is meant, and some frames pass.
    fn hover(&mut self, runs: bool) -> Result<Comes, String> {
        let at = self.seen.1.cursor(self.target().to_array());
        let pushed = self.stage.history().world().counters().mouse_points;
        let before = self.state();
        for _ in 0..6 {
            self.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: Some(at), back: false });
            self.stage.show(&mut self.seen.0);
        }
        let is_pushed = self.stage.history().world().counters().mouse_points > pushed;
        match is_pushed {
            _ if !runs && self.state() != before => Err("while time stands still it has changed something".to_owned()),
            true => Ok(Comes::Push),
            false => Ok(Comes::Nothing),
        }
    }

    /// What comes of it; an edit is undone.
    fn comes(&mut self, act: Act, runs: bool) -> Result<Comes, String> {
        if act == Act::Hover {
            return self.hover(runs);
        }
        let (words, order) = self.try_out(act, runs);
        let Some(order) = order else {
            let words = words.filter(|words| !words.is_empty());
            return words.map(|_| Comes::Words).ok_or("it does nothing and says nothing".to_owned());
        };
        if let Order::Give(commands, None) = &order {
            let grabs = commands.iter().any(|act| matches!(act, Do::Grab(_)));
            return if grabs { Ok(Comes::Grab) } else { Err(format!("{commands:?}")) };
        }
        let before = self.state();
        match self.stage.obey(order) {
            Some(Note::Refused(words)) if !words.is_empty() => return Ok(Comes::Words),
            Some(Note::Held) => return Ok(Comes::Words),
            None | Some(Note::Added(None)) => {}
            Some(other) => return Err(format!("{other:?}")),
        }
        if self.state() == before {
            return Err("nothing has changed".to_owned());
        }
        if runs {
            (0..2).for_each(|_| self.frame());
            let world = self.stage.history().world();
            if !world.is_finite() {
                return Err("it is not finite".to_owned());
            }
        }
        let undone = self.stage.obey(Order::Undo(None));
        self.stage.show(&mut self.seen.0);
        if !matches!(undone, Some(Note::Undone(..))) {
            return Err(format!("not undone: {undone:?}"));
        }
        if self.state() == before { Ok(Comes::Edit) } else { Err("undone it is another state".to_owned()) }
    }
}

#[test]
fn every_tool_does_something_that_is_undone_or_says_why_not() {
    let mut wrong = Vec::new();
    for (column, (name, keys, point)) in SCENES.into_iter().enumerate() {
        let mut bench = Bench::new(name, keys, point);
        for runs in [false, true] {
            bench.stage.obey(Order::Play(runs));
            for (act, row) in TABLE {
                bench.promises = false;
                let comes = bench.comes(act, runs);
                if comes == Ok(Comes::Words) && bench.promises {
                    wrong.push(format!("{act:?} in {name}: it promises what is refused"));
                }
                // The cursor pushes while time runs.
                let wanted = if act == Act::Hover && !runs { Comes::Nothing } else { row[column] };
                if comes != Ok(wanted) {
                    wrong.push(format!("{act:?} in {name}, {}: {comes:?}", if runs { "running" } else { "paused" }));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
