//! What each tool is tried by: presses, drags and buttons, as the window would have them.

use glam::DVec2;

use super::super::handles::{Frame, Handle};
use super::super::stops::Dial;
use super::super::tests::{SIZE, scope};
use super::super::{Deed, Drives, Hand, Mark, PushWay, Ring, Role, clear_bodies, unpin};
use super::{Act, Bench, When};
use crate::app::action::{Primitive, Tool};
use crate::app::import::{Answer, Import};
use crate::app::matter::{Among, MatterChange, Preset};
use crate::app::player::Order;
use crate::sim::PointId;

/// A canvas that somebody has painted a thick stroke on, once it is cut out and Enter adds it.
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
    let frame = |import: &mut Import, events: Vec<egui::Event>| {
        let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 720.0)));
        let input = egui::RawInput { screen_rect, events, ..Default::default() };
        let mut answer = None;
        let mut output = context.run_ui(input, |ui| answer = import.show(ui.ctx(), true).or(answer));
        output.textures_delta.clear();
        answer
    };
    // A window is measured first, then placed.
    for events in [vec![], vec![], vec![]].into_iter().chain(stroke) {
        assert_eq!(frame(&mut import, events), None);
    }
    assert!(import.has_work(), "the stroke is on the canvas");
    // What was painted is cut out beside the window.
    for _ in 0..20_000 {
        _ = import.poll();
        import.enter();
        if frame(&mut import, Vec::new()) == Some(Answer::Add) {
            return import;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    panic!("Enter never adds what was painted")
}

impl Bench {
    /// A press and a release of the left button; while it is down a frame passes, where time does.
    fn drag(&mut self, hand: &mut Hand, [from, to]: [DVec2; 2], runs: bool) -> Deed {
        let marks = hand.marks(scope(&self.seen), Some(from));
        let comes = |mark: &Mark| matches!(mark, Mark::Line(Role::Come, ..) | Mark::Ring(Role::Come, ..));
        self.promises = marks.iter().any(comes);
        let deed = hand.press(scope(&self.seen), from);
        if !deed.is_empty() || deed.words.is_some() {
            return deed;
        }
        hand.trace(scope(&self.seen), to);
        if matches!(hand.tool(), Tool::Cut | Tool::Erase) {
            let is_red = |mark: &Mark| {
                matches!(mark, Mark::Line(Role::Away, ..) | Mark::Ring(Role::Away, ..) | Mark::Frame(Role::Away, ..))
            };
            self.shows = hand.marks(scope(&self.seen), Some(to)).iter().any(is_red);
        }
        if runs {
            self.frame();
        }
        hand.release(scope(&self.seen), to)
    }

    /// Does it as the window would. Returns what the hand says, and the order that it comes to.
    pub(super) fn try_out(&mut self, act: Act, when: When) -> (Option<String>, Option<Order>) {
        let runs = when == When::Running;
        let mut hand = Hand::default();
        hand.stand_still(!runs);
        let at = self.target();
        let [aside, far] = [at + DVec2::new(4.0, 3.0), at + DVec2::new(60.0, -45.0)];
        let tool = match act {
            Act::Grab => Tool::Hand,
            Act::Pin => Tool::Pin,
            Act::PinHeld | Act::Unpin => Tool::Hand,
            Act::Cut => Tool::Cut,
            Act::Erase => Tool::Erase,
            Act::Build | Act::Block | Act::Cloth | Act::Rim | Act::Rope | Act::Figure => Tool::Build,
            Act::Solid | Act::SolidBox | Act::Slope | Act::Polygon | Act::Bonds => Tool::Build,
            Act::Push | Act::PushBody | Act::Turned | Act::Throw | Act::Wind => Tool::Push,
            Act::Muscle => Tool::Muscle,
            Act::Motor | Act::Hinge => Tool::Motor,
            Act::Paint | Act::Numbers => Tool::Paint,
            _ => Tool::Select,
        };
        hand.take(tool);
        let chosen = self.chosen();
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
            Act::Hide | Act::Preset | Act::Soften => {
                hand.select(chosen);
                let chosen = hand.chosen(scope(&self.seen)).unwrap_or_default();
                let among = Among { points: chosen.points, obstacles: chosen.obstacles, bonds: None };
                let change = match act {
                    Act::Hide => MatterChange::Visible(false),
                    Act::Preset => MatterChange::Preset(Preset::Rubber),
                    _ => MatterChange::Stiffness(123.0),
                };
                return (None, Some(Order::Change { among, change, goes_on: false }));
            }
            Act::Copy => return (None, Some(self.duplicate(chosen))),
            Act::Paste => return (None, Some(self.paste(&chosen, far))),
            Act::Group | Act::Ungroup | Act::Flip => {
                hand.select(chosen);
                match act {
                    Act::Group => hand.group(scope(&self.seen)),
                    Act::Ungroup => hand.ungroup(scope(&self.seen)),
                    _ => hand.flip(scope(&self.seen), 0),
                }
            }
            Act::PinHeld => {
                hand.hold_pins(true);
                let deed = self.drag(&mut hand, [at; 2], runs);
                hand.hold_pins(false);
                deed
            }
            Act::Unpin => unpin(scope(&self.seen), at),
            Act::Hinge => {
                let drives = hand.drives();
                let mut motor = drives.motor;
                motor.is_on = Some(false);
                hand.set_drives(Drives { motor, ..drives });
                self.drag(&mut hand, [at; 2], runs)
            }
            Act::Stop => {
                hand.select(chosen);
                let dial = Dial::of(scope(&self.seen), [0, 1, 2].map(PointId)).unwrap();
                let on = |angle: f64| dial.at(scope(&self.seen), angle, 1.0).unwrap();
                let [from, to] = [2.5, 2.1].map(on);
                assert!(hand.takes_stop(scope(&self.seen), from), "the stop is there");
                self.drag(&mut hand, [from, to], runs)
            }
            Act::Wind => {
                hand.set_push_way(PushWay::Wind);
                self.drag(&mut hand, [aside, far], runs)
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
}
