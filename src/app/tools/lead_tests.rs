//! A rope on the cursor: its first point goes where the pointer is, and is let go at rest.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::tests::opened;
use super::{Hand, Scope};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Do;
use crate::render::Camera;
use crate::sim::PointId;

struct Swung {
    stage: Stage,
    shown: Shown,
    hand: Hand,
    camera: Camera,
}

impl Swung {
    fn new() -> Self {
        let (shown, camera, scene) = opened("rope-on-cursor");
        assert_eq!(scene.cursor_pin, Some(0));
        Swung { stage: Stage::new(scene.into()).unwrap(), shown, hand: Hand::default(), camera }
    }

    /// So many frames with the pointer over a place `[m]`, whatever it is next. Returns how much longer than it is a link ever was `[1]`.
    fn frames(&mut self, count: u32, at: impl Fn(u32) -> [f64; 2]) -> f64 {
        let mut most = 0.0_f64;
        for k in 0..count {
            let [x, y] = at(k);
            let pixel = DVec2::from(self.camera.screen_from_world([x, y, 0.0].into()).unwrap());
            let scope = Scope { shown: &self.shown, camera: &self.camera, scale: 1.0, free: Scope::ANYWHERE };
            if let Some(way) = self.hand.lead_on_cursor(scope, (PointId(0), pixel), 1.0 / 60.0) {
                assert_eq!(self.stage.obey(Order::LeadPins(way)), None);
            }
            self.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            self.stage.show(&mut self.shown);
            for i in 0..29 {
                let [a, b] = [i, i + 1].map(|i| DVec2::new(self.shown.place(i)[0], self.shown.place(i)[1]));
                most = most.max((a.distance(b) / 0.1 - 1.0).abs());
            }
        }
        most
    }

    fn first(&self) -> DVec2 {
        let [x, y, _] = self.shown.place(0);
        DVec2::new(x, y)
    }

    /// Holds T and clicks where the rope begins.
    fn click(&mut self) {
        self.hand.hold_pins(true);
        let pixel = DVec2::from(self.camera.screen_from_world(self.first().extend(0.0)).unwrap());
        let scope = Scope { shown: &self.shown, camera: &self.camera, scale: 1.0, free: Scope::ANYWHERE };
        let deed = self.hand.press(scope, pixel);
        self.hand.release(scope, pixel);
        self.hand.hold_pins(false);
        assert!(matches!(deed.commands[..], [Do::Pin(_)] | [Do::Unpin(_)]), "{deed:?}");
        assert_eq!(self.stage.obey(Order::Give(deed.commands, deed.edit)), None);
        self.stage.show(&mut self.shown);
    }

    fn speeds(&self) -> Vec<f64> {
        let now = self.stage.history().world().time();
        self.stage.history().world().sample(now).velocity.iter().map(|v| v[0].hypot(v[1])).collect()
    }
}

#[test]
fn the_first_point_of_a_rope_goes_where_the_cursor_is_and_is_let_go_and_held_without_a_fling() {
    let mut swung = Swung::new();
    assert_eq!(swung.hand.tool(), Tool::Hand);
    // Around a circle of 1 m, twice a second and a half.
    let around = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / 90.0;
        [angle.sin(), 0.5 + angle.cos()]
    };
    let start = swung.frames(1, |_| [0.0, 1.5]);
    let stretched = start.max(swung.frames(180, around));
    let [x, y] = around(179);
    // It is where the cursor was a moment ago: at 4.2 m/s for a quarter of a second at most.
    assert!(swung.first().distance(DVec2::new(x, y)) < 1.0, "{}", swung.first());
    let stretched = stretched.max(swung.frames(30, |_| [x, y]));
    assert!(swung.first().distance(DVec2::new(x, y)) < 1e-6, "{}", swung.first());
    assert!(stretched < 1e-6, "as long as ever: {stretched}");
    // Let go, it falls from rest: nothing is faster than before but for what gravity gives.
    let before = swung.speeds().into_iter().fold(0.0, f64::max);
    swung.click();
    assert!(swung.speeds()[0] < 1e-9, "at rest");
    let dt = 3.0 / 60.0;
    let loose = swung.frames(3, |_| [5.0, 3.0]);
    let after = swung.speeds().into_iter().fold(0.0, f64::max);
    assert!(after < before + 15.0 * dt + 1.0, "{after} m/s after {before} m/s");
    assert!(loose < 1e-6 && swung.first().distance(DVec2::new(x, y)) < 0.3, "it is not on the cursor any more");
    // Held where it is, it goes with the cursor again.
    swung.click();
    assert!(swung.stage.history().world().pinned().contains(&PointId(0)));
    swung.frames(60, |k| [0.01 * f64::from(k.min(30)), 1.0]);
    assert!(swung.first().distance(DVec2::new(0.3, 1.0)) < 1e-6, "{}", swung.first());
    // What the cursor does is no edit: undo takes back the pin alone, then its letting go.
    for name in ["pin", "unpin"] {
        let undone = swung.stage.obey(Order::Undo(None));
        assert!(matches!(&undone, Some(Note::Undone(own, _)) if own == name), "{name}: {undone:?}");
    }
    assert_eq!(swung.stage.obey(Order::Undo(None)), Some(Note::NothingToUndo));
}

#[test]
fn a_rope_is_on_the_cursor_while_the_hand_is_free_alone() {
    let mut swung = Swung::new();
    let way = |tool: Tool, is_busy: bool| {
        let mut hand = Hand::default();
        hand.take(tool);
        let scope = Scope { shown: &swung.shown, camera: &swung.camera, scale: 1.0, free: Scope::ANYWHERE };
        if is_busy {
            hand.press(scope, DVec2::new(20.0, 20.0));
        }
        hand.lead_on_cursor(scope, (PointId(0), DVec2::new(300.0, 300.0)), 1.0);
        hand.lead_on_cursor(scope, (PointId(0), DVec2::new(400.0, 300.0)), 1.0)
    };
    assert!(way(Tool::Hand, false).is_some_and(|way| way.follows));
    assert!(way(Tool::Hand, true).is_none() && way(Tool::Cut, false).is_none());
    swung.click();
    let scope = Scope { shown: &swung.shown, camera: &swung.camera, scale: 1.0, free: Scope::ANYWHERE };
    assert!(swung.hand.lead_on_cursor(scope, (PointId(0), DVec2::new(400.0, 300.0)), 1.0).is_none());
}
