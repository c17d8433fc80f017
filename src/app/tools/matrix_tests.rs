//! Every tool on every kind of scene, paused and running, in a past that was gone back to and at the end: it changes something, which undo takes
//! back to the bit, or it says why not.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod keys;
mod trying;

use std::sync::Arc;

use glam::DVec2;

use super::Chosen;
use super::tests::{SIZE, scope};
use crate::app::opening;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::{Do, Group, SetKeys, hash_now};
use crate::picture::Tint;
use crate::render::Camera;
use crate::scene::{Scene, gallery};
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
    Paste,
    Group,
    Ungroup,
    Flip,
    PinHeld,
    Unpin,
    Hinge,
    Stop,
    Click,
    Boxed,
    Wind,
    Delete,
    Lasso,
    Clear,
    Drawn,
    Hover,
}

/// When it is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
enum When {
    Paused,
    Running,
    /// Paused at a time that was gone back to: what is done there begins a branch.
    Back,
    /// Where the scene has ended by itself: nothing moves there either.
    Ended,
}

/// What comes of it: an edit, words, a grab or a push of the cursor or a selection, which are no edits, or nothing: no body is there to be pushed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Comes {
    Edit,
    Words,
    Grab,
    Push,
    Selection,
    Nothing,
}

use Comes::{Edit as E, Grab as G, Nothing as N, Push as P, Selection as S, Words as W};

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
const TABLE: [(Act, [Comes; 7]); 45] = [
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
    (Act::Paste, [E, E, E, E, E, E, E]),
    (Act::Group, [E, E, E, E, E, W, E]),
    (Act::Ungroup, [E, E, E, E, E, W, E]),
    (Act::Flip, [E, E, E, E, E, E, W]),
    (Act::PinHeld, [E, E, E, E, E, W, E]),
    (Act::Unpin, [E, E, E, E, E, W, E]),
    (Act::Hinge, [E, E, E, E, E, W, W]),
    (Act::Click, [S, S, S, S, S, S, S]),
    (Act::Boxed, [S, S, S, S, S, S, S]),
    (Act::Wind, [E, E, E, E, E, E, E]),
    (Act::Delete, [E, E, E, E, E, E, E]),
    (Act::Lasso, [E, E, E, E, E, E, E]),
    (Act::Clear, [E, E, E, E, E, W, E]),
    (Act::Drawn, [E, E, E, E, E, E, W]),
    // The last, for it is not undone.
    (Act::Hover, [P, P, P, P, P, N, P]),
];

/// The columns that are gone back in too.
const BACK: [&str; 7] = ["soft", "rope", "net", "pile", "rigid", "solid", "space"];
/// Those that come to an end: all but that without bodies, which rests from its start on, so that no time passes in it.
const ENDING: [&str; 6] = ["soft", "rope", "net", "pile", "rigid", "space"];
/// What is tried of the net there: with ten thousand points each takes a while.
const OF_NET: [Act; 6] = [Act::Pin, Act::Cut, Act::Move, Act::Group, Act::Delete, Act::Click];
/// What is tried of it paused, but not once more as time runs.
const OF_NET_ONCE: [Act; 6] = [Act::Paste, Act::Ungroup, Act::Flip, Act::PinHeld, Act::Unpin, Act::Hinge];
/// A joint with stops that flies.
const KNEE: &str = r#""points": {"position": [[1, 0], [0, 0], [0, 1]], "velocity": [[0.5, 0], [0.5, 0], [0.5, 0]]},
    "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}], "angles": [{"points": [0, 1, 2], "min": 0.5, "max": 2.5}]"#;
/// Where they end `[s]`: about as far from the start as all others are tried.
const END: f64 = 0.066;
/// So many frames from the start it is tried.
const FRAMES: usize = 4;

/// What comes of it then, where `usual` does while time runs.
fn wanted(act: Act, when: When, usual: Comes) -> Comes {
    match act {
        _ if when == When::Running => usual,
        // Nothing can be led: what is pressed on is moved.
        Act::Grab => Comes::Edit,
        // The cursor pushes while time runs.
        Act::Hover => Comes::Nothing,
        _ => usual,
    }
}

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
    /// What was marked while the button was down said that something goes.
    shows: bool,
}

impl Bench {
    fn new(name: &str, keys: &str, point: Option<usize>) -> Self {
        let mut bench = Bench::at_start(scene_of(name, keys), point);
        // What is to sleep does, what is to move does.
        let frames = if name == "pile" { 240 } else { FRAMES };
        (0..frames).for_each(|_| bench.frame());
        assert!(name != "pile" || bench.seen.0.figures.asleep, "it sleeps");
        bench
    }

    /// One that has gone on a little beyond a time `[s]`, that time.
    fn gone_on(name: &str, keys: &str, point: Option<usize>) -> (Self, f64) {
        let mut bench = Bench::at_start(scene_of(name, keys), point);
        let mut step = |times: usize| {
            (0..times).for_each(|_| _ = bench.stage.obey(Order::Step(None)));
            bench.stage.history().world().time()
        };
        let time = step(FRAMES);
        assert!(step(1) > time, "{name}");
        // What is done after that is only there.
        let keys = SetKeys { drag_rate: Some(0.1), ..SetKeys::default() };
        assert_eq!(bench.stage.obey(Order::Give(vec![Do::Set(Box::new(keys))], Some("drag"))), None, "{name}");
        bench.stage.obey(Order::Step(None));
        (bench, time)
    }

    /// One that has come to its end.
    fn ended(name: &str, keys: &str, point: Option<usize>) -> Self {
        let mut scene = scene_of(name, keys);
        (scene.duration, scene.samples) = (Some(END), Vec::new());
        let mut bench = Bench::at_start(scene, point);
        // On a busy machine a frame has time for a few substeps only.
        for _ in 0..10_000 {
            if bench.seen.0.figures.ended {
                return bench;
            }
            bench.frame();
        }
        panic!("{name} does not end");
    }

    fn at_start(scene: Scene, point: Option<usize>) -> Self {
        let mut stage = Stage::new(scene.clone().into()).unwrap();
        let mut shown = Shown::default();
        stage.show(&mut shown);
        let camera = opening::camera(&scene, &shown.view(), SIZE);
        Bench { stage, seen: (shown, camera, scene), point, promises: false, shows: false }
    }

    /// Back to a time `[s]` of the timeline that it began with, which goes on from there.
    fn go_back(&mut self, time: f64) {
        self.stage.obey(Order::ToBranch(0, None));
        self.stage.obey(Order::GoTo(time, None));
        self.stage.show(&mut self.seen.0);
        let history = self.stage.history();
        assert!(history.branch() == 0 && history.has_future(), "there is something to come at {time} s");
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

    /// What comes of it, once what it needs is there; an edit is undone, and so is what it needed.
    fn comes(&mut self, act: Act, when: When) -> Result<Comes, String> {
        match act {
            Act::Hover => return self.hover(when == When::Running),
            Act::Click | Act::Boxed => return Ok(self.selects(act)),
            _ => {}
        }
        let is_prepared = self.prepare(act)?;
        let comes = self.comes_of(act, when);
        if is_prepared {
            self.undo()?;
        }
        comes
    }

    fn undo(&mut self) -> Result<(), String> {
        let undone = self.stage.obey(Order::Undo(None));
        self.stage.show(&mut self.seen.0);
        if matches!(undone, Some(Note::Undone(..))) { Ok(()) } else { Err(format!("not undone: {undone:?}")) }
    }

    fn comes_of(&mut self, act: Act, when: When) -> Result<Comes, String> {
        let runs = when == When::Running;
        let (words, order) = self.try_out(act, when);
        let Some(order) = order else {
            let words = words.filter(|words| !words.is_empty());
            return words.map(|_| Comes::Words).ok_or("it does nothing and says nothing".to_owned());
        };
        if let Order::Give(commands, None) = &order {
            let grabs = commands.iter().any(|act| matches!(act, Do::Grab(_)));
            return if grabs { Ok(Comes::Grab) } else { Err(format!("{commands:?}")) };
        }
        if let (Act::Grab, Order::Give(commands, name)) = (act, &order)
            && *name != Some("move")
        {
            return Err(format!("{name:?} of {commands:?}"));
        }
        let (before, is_back) = (self.state(), self.stage.history().has_future());
        match self.stage.obey(order) {
            Some(Note::Refused(words)) if !words.is_empty() => return Ok(Comes::Words),
            Some(Note::Held) => return Ok(Comes::Words),
            Some(Note::Branched) if is_back => {}
            Some(Note::Added(None) | Note::Came(..)) => {}
            None if !is_back => {}
            other => return Err(format!("{other:?}")),
        }
        if is_back && self.stage.history().branch() == 0 {
            return Err("what was to come is lost".to_owned());
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
        self.undo()?;
        if self.state() == before { Ok(Comes::Edit) } else { Err("undone it is another state".to_owned()) }
    }
}

impl Bench {
    /// All that is tried in a column, gone back to a time before `[s]` if there is one. Returns what comes otherwise than it is to.
    fn try_all(&mut self, column: usize, when: When, back: Option<f64>) -> Vec<String> {
        let name = SCENES[column].0;
        let mut wrong = Vec::new();
        let is_tried = |act: &Act| match when {
            _ if name != "net" => true,
            When::Paused => true,
            When::Running => !OF_NET_ONCE.contains(act),
            When::Back | When::Ended => OF_NET.contains(act),
        };
        for (act, row) in TABLE.into_iter().filter(|(act, _)| is_tried(act)) {
            back.into_iter().for_each(|time| self.go_back(time));
            (self.promises, self.shows) = (false, false);
            let comes = self.comes(act, when);
            if comes == Ok(Comes::Words) && self.promises {
                wrong.push(format!("{act:?} in {name}, {when:?}: it promises what is refused"));
            }
            if comes == Ok(Comes::Edit) && matches!(act, Act::Cut | Act::Erase) && !self.shows {
                wrong.push(format!("{act:?} in {name}, {when:?}: what goes is not seen before"));
            }
            if when == When::Ended && !self.seen.0.figures.ended {
                wrong.push(format!("{act:?} in {name}: undone it has not ended any more"));
            }
            if comes != Ok(wanted(act, when, row[column])) {
                wrong.push(format!("{act:?} in {name}, {when:?}: {comes:?}"));
            }
        }
        wrong
    }
}

/// The columns of these names, each with its place.
fn columns(names: &[&str]) -> impl Iterator<Item = (usize, (&'static str, &'static str, Option<usize>))> {
    SCENES.into_iter().enumerate().filter(move |(_, (name, ..))| names.contains(name))
}

#[test]
fn every_tool_does_something_that_is_undone_or_says_why_not() {
    let mut wrong = Vec::new();
    for (column, (name, keys, point)) in SCENES.into_iter().enumerate() {
        let mut bench = Bench::new(name, keys, point);
        for when in [When::Paused, When::Running] {
            bench.stage.obey(Order::Play(when == When::Running));
            wrong.extend(bench.try_all(column, when, None));
        }
        let led = bench.lead_a_pin();
        wrong.extend(led.err().map(|why| format!("a pin of {name} that is led: {why}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_stop_of_a_joint_is_dragged_at_any_time_and_undone() {
    for when in [When::Paused, When::Running, When::Back, When::Ended] {
        let mut bench = match when {
            When::Paused | When::Running => Bench::new("knee", KNEE, Some(2)),
            When::Back => {
                let (mut bench, time) = Bench::gone_on("knee", KNEE, Some(2));
                bench.go_back(time);
                bench
            }
            When::Ended => Bench::ended("knee", KNEE, Some(2)),
        };
        bench.stage.obey(Order::Play(when == When::Running));
        assert_eq!(bench.comes(Act::Stop, when), Ok(E), "{when:?}");
        let has_ended = when == When::Ended;
        assert_eq!(bench.seen.0.figures.ended, has_ended, "{when:?}");
    }
}

#[test]
fn in_the_past_every_tool_begins_a_branch_that_is_undone_or_says_why_not() {
    let mut wrong = Vec::new();
    for (column, (name, keys, point)) in columns(&BACK) {
        let (mut bench, time) = Bench::gone_on(name, keys, point);
        wrong.extend(bench.try_all(column, When::Back, Some(time)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn at_the_end_every_tool_does_something_that_is_undone_or_says_why_not() {
    let mut wrong = Vec::new();
    for (column, (name, keys, point)) in columns(&ENDING) {
        let mut bench = Bench::ended(name, keys, point);
        wrong.extend(bench.try_all(column, When::Ended, None));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
