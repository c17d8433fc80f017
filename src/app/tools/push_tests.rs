//! Forces that are drawn as arrows, without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::tests::{SIZE, opened, pixel, scope};
use super::{Hand, Mark, PushWay};
use crate::app::action::Tool;
use crate::app::opening;
use crate::app::player::{Order, Shown, Stage};
use crate::render::Camera;
use crate::scene::Scene;
use crate::sim::PointId;

/// Three free points in a row of rods and one that is held, without gravity.
const SCENE: &str = r#"{"wobble": 1, "points": {"position": [[-1, 0], [0, 0], [1, 0], [3, 2]], "pinned": [3], "mass": [1, 2, 3, 1]},
    "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2}], "forces": [{"points": [0], "force": [0, -40]}],
    "view": {"center": [0, 0], "height": 8}}"#;

struct Bench {
    stage: Stage,
    seen: (Shown, Camera, Scene),
    hand: Hand,
}

impl Bench {
    fn new() -> Self {
        let scene = Scene::parse(SCENE, "x.json").unwrap();
        let mut stage = Stage::new(scene.clone().into()).unwrap();
        let mut shown = Shown::default();
        stage.show(&mut shown);
        let camera = opening::camera(&scene, &shown.view(), SIZE);
        let mut hand = Hand::default();
        hand.take(Tool::Push);
        Bench { stage, seen: (shown, camera, scene), hand }
    }

    /// A drag, which is done. Returns what it is called, or what was said.
    fn drag(&mut self, from: DVec2, by: [f64; 2]) -> String {
        let to = from + DVec2::from(by);
        let pressed = self.hand.press(scope(&self.seen), from);
        if let Some(words) = pressed.words {
            return words;
        }
        let deed = self.hand.release(scope(&self.seen), to);
        let name = deed.edit.map(str::to_owned);
        if !deed.is_empty() {
            assert_eq!(self.stage.obey(Order::Give(deed.commands, deed.edit)), None);
            self.stage.show(&mut self.seen.0);
        }
        name.or(deed.words).unwrap_or_default()
    }

    fn at(&self, point: usize) -> DVec2 {
        pixel(&self.seen, point)
    }

    /// Force and torque of each that is there.
    fn forces(&self) -> Vec<([f64; 2], f64, usize)> {
        let forces = self.stage.history().world().forces();
        forces.iter().map(|one| ([one.force[0], one.force[1]], one.torque, one.points.len())).collect()
    }
}

#[test]
fn an_arrow_is_a_force_that_can_be_changed_and_taken_away() {
    let mut bench = Bench::new();
    let at = bench.at(2);
    assert_eq!(bench.drag(at, [0.0, -100.0]), "force");
    assert_eq!(bench.forces()[1], ([0.0, 10.0], 0.0, 1), "100 px are 10 N");
    // Its head: 60 px to the right of it from there.
    assert_eq!(bench.drag(at + DVec2::new(0.0, -100.0), [0.0, -100.0]), "force");
    assert_eq!((bench.forces().len(), bench.forces()[1].0), (2, [0.0, 40.0]), "twice as long is four times as much");
    bench.stage.obey(Order::Undo(None));
    bench.stage.show(&mut bench.seen.0);
    assert_eq!(bench.forces()[1].0, [0.0, 10.0]);
    assert_eq!(bench.drag(at + DVec2::new(0.0, -60.0), [0.0, 0.0]), "force away");
    assert_eq!(bench.forces().len(), 1);
    // That of the scene file is an arrow too: 200 px down.
    let at = bench.at(0);
    assert_eq!(bench.drag(at + DVec2::new(1.0, 150.0), [1.0, 0.0]), "force away");
    assert!(bench.forces().is_empty());
}

#[test]
fn a_force_on_a_body_is_shared_out_and_a_torque_turns_it() {
    let mut bench = Bench::new();
    let at = bench.at(2);
    bench.hand.hold([true, false]);
    assert_eq!(bench.drag(at, [0.0, -100.0]), "force");
    bench.hand.hold([false, true]);
    assert_eq!(bench.drag(at, [0.0, -100.0]), "torque");
    let forces = bench.forces();
    assert_eq!(
        (forces[1], forces[2]),
        (([0.0, 10.0], 0.0, 3), ([0.0, 0.0], 10.0, 3)),
        "up at the right is anticlockwise"
    );
    let at = bench.at(0);
    bench.drag(at + DVec2::new(0.0, 120.0), [0.0, 0.0]);
    bench.stage.obey(Order::Play(true));
    (0..6).for_each(|_| drop(bench.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false })));
    let world = bench.stage.history().world();
    let (v, t) = (|k| world.velocity(PointId(k)), world.time());
    let mean = [1.0, 2.0, 3.0].into_iter().zip(0..).map(|(m, k)| m * v(k)[1]).sum::<f64>() / 6.0;
    assert!((mean - 10.0 / 6.0 * t).abs() < 1e-3 * t, "F/m: {mean} after {t} s");
    assert!(v(2)[1] > v(1)[1] && v(1)[1] > v(0)[1], "it turns anticlockwise");
}

#[test]
fn where_nothing_is_pushed_it_is_said() {
    let mut bench = Bench::new();
    let [pin, free] = [3, 1].map(|point| bench.at(point));
    assert!(bench.drag(pin, [50.0, 0.0]).contains("pin"));
    assert!(bench.drag(DVec2::new(400.0, 650.0), [50.0, 0.0]).contains("no body"));
    assert!(bench.drag(free, [0.0, 0.0]).contains("drag an arrow"));
    bench.hand.set_push_way(PushWay::Turn);
    assert!(bench.drag(pin, [50.0, 0.0]).contains("pin"));
    assert_eq!(bench.forces().len(), 1);
    let words = |hand: &Hand| {
        let marks = hand.marks(scope(&bench.seen), None);
        marks.iter().filter(|mark| matches!(mark, Mark::Words(_, words) if words == "40.0 N")).count()
    };
    let mut other = bench.hand.clone();
    other.take(Tool::Cut);
    assert_eq!((words(&bench.hand), words(&other)), (1, 1), "arrows stay, whatever is in the hand");
    let space = opened("cloth-ball");
    let deed = bench.hand.press(scope(&space), pixel(&space, 100));
    assert!(deed.words.is_some_and(|words| words.contains("in space")));
}

#[test]
fn an_arrow_of_velocity_throws_what_is_free_of_a_body_and_a_click_stops_it() {
    let mut bench = Bench::new();
    bench.hand.set_push_way(PushWay::Speed);
    let velocity = |bench: &Bench| {
        let world = bench.stage.history().world();
        [0, 1, 2].map(|point| world.velocity(PointId(point)))
    };
    let at = bench.at(1);
    let would = bench.hand.marks(scope(&bench.seen), Some(at));
    assert!(would.iter().any(|mark| matches!(mark, Mark::Words(_, said) if said.contains("flies off"))), "{would:?}");
    assert_eq!(bench.drag(at, [100.0, -50.0]), "velocity");
    for [x, y, _] in velocity(&bench) {
        assert!((x - 5.0).abs() < 0.02 && (y - 2.5).abs() < 0.02, "100 px are 5 m/s: {x} {y}");
    }
    assert_eq!(bench.drag(at, [0.0, 0.0]), "velocity");
    assert_eq!(velocity(&bench), [[0.0; 3]; 3], "a click stops it");
    bench.stage.obey(Order::Undo(None));
    assert!((velocity(&bench)[0][0] - 5.0).abs() < 0.02, "the click is undone");
    bench.stage.obey(Order::Undo(None));
    assert_eq!(velocity(&bench), [[0.0; 3]; 3]);
    let pin = bench.at(3);
    assert!(bench.drag(pin, [50.0, 0.0]).contains("pin"), "a pin takes none");
}
