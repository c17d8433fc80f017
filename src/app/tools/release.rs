//! The left button goes up, or what is under way ends otherwise.

use glam::DVec2;

use super::erase::{delete_points, erase};
use super::hover::{CALM, strength};
use super::selecting::is_drag;
use super::selection::Selection;
use super::{Chosen, Deed, Doing, Hand, Scope, brush, knot, selecting};
use crate::app::action::Tool;
use crate::app::player::Probe;
use crate::history::Do;

/// What a drag is called when it is undone, with what it threw.
const DRAG: &str = "drag";
/// Said of a drag through bodies that began beside them, where nothing pushes; a body is looked for at so many places along the drag.
const NO_PUSH: &str =
    "this scene has no push of the mouse: press on a body to grab it, or add a push in the settings (G)";
const LOOKS: u32 = 24;

impl Hand {
    /// The left button was let go at a pixel.
    pub(in crate::app) fn release(&mut self, scope: Scope<'_>, at: DVec2) -> Deed {
        match std::mem::take(&mut self.doing) {
            Doing::Grabbing(led) => {
                self.calm = Some(CALM);
                let ties = self.tool() == Tool::Hand && !self.shift;
                let is_dragged = self.is_dragged || is_drag(scope, [self.pressed, at]);
                match ties.then(|| knot::let_go(scope, &led, at)).flatten() {
                    Some(tied) => tied,
                    // Taking hold alone is nothing to undo.
                    None => Deed { edit: is_dragged.then_some(DRAG), ..Deed::plain(vec![Do::Release]) },
                }
            }
            Doing::Leading(_) => {
                self.calm = Some(CALM);
                Deed::default()
            }
            Doing::Cutting(slash) => slash.release(scope, at),
            Doing::Erasing(mut sweep) => {
                sweep.trace(scope, at);
                sweep.deed(scope)
            }
            Doing::Driving(swipe) => self.drives.muscle.release(scope, swipe, at),
            Doing::Building(drag) => {
                self.built_at = Some(at);
                self.maker.build(scope, &drag, at)
            }
            Doing::Drawing(mut path) => {
                let step = path.release(self.maker, scope, at);
                self.go_on(path, step)
            }
            Doing::Forcing(pull) => pull.release(scope, at),
            Doing::Throwing(throw) => throw.release(scope, at),
            Doing::Blowing(blow) => {
                self.wind_at = Some(blow.from());
                blow.release(scope, at)
            }
            Doing::Moving(hold, under) => self.end_move(scope, (hold, at), under),
            Doing::Stopping(stop) => stop.release(scope, (at, self.shift)),
            Doing::Labelling(number, hold) => self.end_label(scope, (number, hold), at),
            Doing::Carrying(hold, what) => selecting::moved(scope, (hold, at), &what),
            Doing::Handling(grip) => self.end_grip(scope, grip, at),
            Doing::Turning(grip) => self.end_turn(scope, grip, at),
            Doing::Marking(region) => {
                self.mark(scope, &region, at);
                Deed::default()
            }
            Doing::Painting(mut stroke) => {
                self.brush.trace(scope, &mut stroke, at);
                let among = stroke.among();
                match among.is_empty() {
                    true if scope.solid(at).is_some() => Deed::words(brush::SOLID.to_owned()),
                    true => Deed::words(brush::NOTHING.to_owned()),
                    false => Deed { painted: Some(among), ..Deed::default() },
                }
            }
            Doing::Pushing if self.has_no_push(scope, at) => Deed::words(NO_PUSH.to_owned()),
            _ => Deed::default(),
        }
    }

    /// Whether a drag that is let go at a pixel went over a body that nothing pushed, since the scene has no push of the mouse.
    fn has_no_push(&self, scope: Scope<'_>, at: DVec2) -> bool {
        let is_dragged = self.is_dragged || is_drag(scope, [self.pressed, at]);
        if !is_dragged || scope.shown.mouse.is_some() || scope.starts_at(self.pressed) {
            return false;
        }
        (1..=LOOKS).any(|k| !scope.grip(self.pressed.lerp(at, f64::from(k) / f64::from(LOOKS))).is_empty())
    }

    /// Whether the button, which is about to be let go at a pixel, clicked with the hand on something that it would have led.
    pub(in crate::app) fn has_clicked(&self, scope: Scope<'_>, at: DVec2) -> bool {
        let holds = matches!(self.doing, Doing::Grabbing(_) | Doing::Carrying(..)) && self.tool() == Tool::Hand;
        holds && !self.is_dragged && !is_drag(scope, [self.pressed, at])
    }

    /// The point that the button, which is about to be let go at a pixel, clicked on with the tool for selecting.
    pub(in crate::app) fn clicked(&self, scope: Scope<'_>, at: DVec2) -> Option<Probe> {
        let is_click = matches!(self.doing, Doing::Moving(hold, _) if !is_drag(scope, [hold.at, at]));
        let bond = || scope.bond(at).map(|(place, _)| Probe::Bond(scope.shown.scenery.bond_number(place)));
        let probe = scope.point(at).map(Probe::Point).or_else(bond);
        probe.filter(|_| is_click && !self.command && self.tool() == Tool::Select)
    }

    /// Ends what is under way without doing it. Returns whether anything was.
    pub(in crate::app) fn cancel(&mut self) -> (bool, Deed) {
        let was = self.is_busy();
        let deed = match std::mem::take(&mut self.doing) {
            Doing::Grabbing(_) => {
                self.calm = Some(CALM);
                Deed::plain(vec![Do::Release])
            }
            Doing::Leading(_) => {
                self.calm = Some(CALM);
                Deed::default()
            }
            _ => Deed::default(),
        };
        (was, deed)
    }

    /// Nothing is selected any more.
    pub(in crate::app) fn deselect(&mut self) {
        self.selection.set(Chosen::default());
    }

    /// Takes away what is led, what is selected, or what lies under the pixel, and says how it comes back.
    pub(in crate::app) fn delete(&mut self, scope: Scope<'_>, at: Option<DVec2>) -> Deed {
        let mut deed = self.taken_away(scope, at);
        if !deed.is_empty() {
            deed.words.get_or_insert_with(|| "taken away: Ctrl+Z brings it back".to_owned());
        }
        deed
    }

    fn taken_away(&mut self, scope: Scope<'_>, at: Option<DVec2>) -> Deed {
        if let Doing::Grabbing(points) = &self.doing {
            let Some(&point) = points.first() else { return Deed::default() };
            let deed = delete_points(scope.body(point));
            self.calm = Some(CALM);
            self.doing = Doing::Nothing;
            return deed;
        }
        if let Some(chosen) = self.chosen(scope) {
            self.selection.take_away(scope);
            return chosen.deleted();
        }
        at.map_or_else(Deed::default, |at| erase(scope, at))
    }

    /// A history begins: nothing is held any more, and nothing selected.
    pub(in crate::app) fn let_go(&mut self) {
        self.drop_all();
        self.selection = Selection::default();
    }

    /// Time was gone through: nothing is held any more; what is selected stays so where it is there.
    pub(in crate::app) fn drop_all(&mut self) {
        (self.doing, self.calm) = (Doing::Nothing, None);
    }

    /// Another history is gone to: what this one has in hand is let go first, and the hover force comes back at once.
    pub(in crate::app) fn leave(&mut self) -> Deed {
        let mut commands = Vec::new();
        if self.is_grabbing() {
            commands.push(Do::Release);
        }
        if self.calm.is_some() {
            commands.extend(self.strength.map(strength));
        }
        self.let_go();
        Deed::plain(commands)
    }
}
