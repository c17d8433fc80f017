//! What is tried by keys beside the tools: copies, and what has to be there before it is tried.

use glam::DVec2;

use super::super::tests::{SIZE, scope};
use super::super::{Chosen, Hand};
use super::{Act, Bench, Comes};
use crate::app::action::Tool;
use crate::app::clip::{Clip, Wish};
use crate::app::player::{Note, Order};
use crate::history::{Do, History};
use crate::sim::PointId;

impl Bench {
    fn wish(&self, name: &'static str, by: [f64; 3]) -> Wish {
        let free = [[0.0; 2], SIZE.map(f64::from)];
        Wish { name, by, is_meant: false, is_beside: false, camera: self.seen.1, free }
    }

    /// What Ctrl+D does with what is selected.
    pub(super) fn duplicate(&self, chosen: Chosen) -> Order {
        let by = chosen.beside(scope(&self.seen));
        let wish = Wish { is_beside: true, ..self.wish("duplicate", by) };
        Order::Add(Box::new(move |history: &History| Clip::of(history, &chosen).coming(history, &wish)))
    }

    /// What Ctrl+C and then Ctrl+V do, with the pointer at a pixel: a copy comes of what the clipboard has.
    pub(super) fn paste(&self, chosen: &Chosen, at: DVec2) -> Order {
        let clip = Clip::of_fragment(Clip::of(self.stage.history(), chosen).fragment());
        let to = self.seen.1.world_from_screen(at.to_array()).to_array();
        let by = std::array::from_fn(|axis| to[axis] - clip.middle[axis]);
        let wish = Wish { is_meant: true, ..self.wish("paste", by) };
        Order::Add(Box::new(move |history: &History| clip.coming(history, &wish)))
    }

    /// A click on what is meant, or a box around all that is in view.
    pub(super) fn selects(&self, act: Act) -> Comes {
        let mut hand = Hand::default();
        hand.take(Tool::Select);
        let [right, low] = SIZE.map(|side| f64::from(side) - 5.0);
        let [from, to] = match act {
            Act::Click => [self.target(); 2],
            _ => [DVec2::splat(5.0), DVec2::new(right, low)],
        };
        let pressed = hand.press(scope(&self.seen), from);
        hand.trace(scope(&self.seen), to);
        let released = hand.release(scope(&self.seen), to);
        let found = hand.chosen(scope(&self.seen)).unwrap_or_default();
        let meant = self.chosen();
        let is_there = match act {
            Act::Click => {
                meant.points.iter().all(|point| found.points.binary_search(point).is_ok())
                    && meant.obstacles.iter().all(|number| found.obstacles.contains(number))
            }
            _ => !found.is_empty(),
        };
        match pressed.is_empty() && released.is_empty() && is_there {
            true => Comes::Selection,
            false => Comes::Nothing,
        }
    }

    /// What has to be there before it is tried: a group that ends, a pin that is let go. Returns whether anything was done for that.
    pub(super) fn prepare(&mut self, act: Act) -> Result<bool, String> {
        let mut hand = Hand::default();
        let deed = match act {
            Act::Ungroup => {
                hand.take(Tool::Select);
                hand.select(self.chosen());
                hand.group(scope(&self.seen))
            }
            Act::Unpin => {
                hand.hold_pins(true);
                hand.press(scope(&self.seen), self.target())
            }
            _ => return Ok(false),
        };
        if deed.is_empty() {
            return Ok(false);
        }
        let note = self.stage.obey(Order::Give(deed.commands, deed.edit));
        self.stage.show(&mut self.seen.0);
        match note {
            None | Some(Note::Branched) => Ok(true),
            other => Err(format!("before it: {other:?}")),
        }
    }

    /// While time runs a pin is made, the hand leads it to another place, and undo brings it back; nothing where no point is.
    pub(super) fn lead_a_pin(&mut self) -> Result<(), String> {
        if self.point.is_none() {
            return Ok(());
        }
        let mut hand = Hand::default();
        hand.hold_pins(true);
        let at = self.target();
        let deed = hand.press(scope(&self.seen), at);
        hand.release(scope(&self.seen), at);
        hand.hold_pins(false);
        let [Do::Pin(pins)] = &deed.commands[..] else { return Err(format!("no pin: {deed:?}")) };
        let pin = pins[0];
        if let Some(note) = self.stage.obey(Order::Give(deed.commands, deed.edit)) {
            return Err(format!("{note:?}"));
        }
        self.stage.show(&mut self.seen.0);
        let before = self.state();
        let to = at + DVec2::new(-40.0, -30.0);
        let pressed = hand.press(scope(&self.seen), at);
        hand.trace(scope(&self.seen), to);
        let way = hand.lead(scope(&self.seen), to, f64::INFINITY);
        let Some(way) = way.filter(|_| hand.is_leading()) else { return Err(format!("it is not led: {pressed:?}")) };
        match self.stage.obey(Order::LeadPins(way)) {
            None | Some(Note::Warned(_)) => {}
            other => return Err(format!("{other:?}")),
        }
        // On a busy machine a frame has time for a few substeps only.
        for _ in 0..600 {
            if self.pixel_of(pin)?.distance(to) < 0.5 {
                break;
            }
            self.frame();
        }
        let off = self.pixel_of(pin)?.distance(to);
        if off >= 0.5 {
            return Err(format!("it is {off} px from where it is led"));
        }
        self.undo()?;
        if self.state() != before {
            return Err("undone it is another state".to_owned());
        }
        self.undo()
    }

    fn pixel_of(&self, point: PointId) -> Result<DVec2, String> {
        scope(&self.seen).pixel(point).ok_or_else(|| format!("{point:?} is out of view"))
    }
}
