//! What is done with what is selected: groups, its matter.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use winit::window::CursorIcon;

use super::Session;
use crate::app::action::Tool;
use crate::app::matter::{Among, Bearings, MatterChange, Placing, overload};
use crate::app::player::Order;
use crate::app::tools::{Chosen, Handle, Held, PushWay, Ring, Scope, hidden_bodies, is_of_space};
use crate::sim::PointId;

/// Said when something is hidden: how it is found again.
const HIDDEN: &str = "hidden: the Select tool (6) shows its outline; Ctrl+Shift+H shows all";
/// Said where nothing is selected.
const NOTHING: &str = "select something first, with the Select tool (6)";

/// How often it is looked at again whether bodies bear their weight `[s]`; in a world of no more bonds than this; and of what is selected once it is
/// no faster than this `[m/s]`.
const LOOKS: f64 = 0.5;
const MOST_WEIGHED: usize = 20_000;
const STILL: f64 = 0.1;

/// So many points of a selection are looked at, where it is asked where that is seen.
const MOST_SEEN: usize = 2_000;
/// What the pointer is on is looked for among so many points: more would take longer than a frame.
const MOST_HOVERED: usize = 100_000;

impl Session {
    /// What is selected, if anything is.
    pub(super) fn selected(&mut self) -> Option<Chosen> {
        let chosen = self.with_scope(|hand, scope| hand.chosen(scope));
        if chosen.is_none() {
            self.say(NOTHING.to_owned());
        }
        chosen
    }

    /// What is selected is mirrored: left and right, axis 0, or up and down, axis 1.
    pub(super) fn flip(&mut self, axis: usize) {
        let deed = self.with_scope(|hand, scope| hand.flip(scope, axis));
        self.do_deed(deed);
    }

    /// All bodies and obstacles are selected.
    pub(super) fn select_all(&mut self) {
        self.with_scope(|hand, scope| hand.select_all(scope));
    }

    /// The points that are selected are selected as one from now on.
    pub(super) fn group(&mut self) {
        let deed = self.with_scope(|hand, scope| hand.group(scope));
        self.do_deed(deed);
    }

    /// Whether something that is selected is in a group.
    pub(super) fn is_grouped(&self) -> bool {
        let is_chosen = |point: &PointId| self.inspected.points.binary_search(point).is_ok();
        self.shown().scenery.groups.iter().any(|group| group.points.iter().any(is_chosen))
    }

    /// The groups that are selected are none any more.
    pub(super) fn ungroup(&mut self) {
        let deed = self.with_scope(|hand, scope| hand.ungroup(scope));
        self.do_deed(deed);
    }

    /// The stepping thread is told whose matter is to be shown, where that is new.
    pub(super) fn inspect(&mut self) {
        let chosen = self.with_scope(|hand, scope| {
            hand.settle(scope);
            hand.chosen(scope).unwrap_or_default()
        });
        if chosen != self.inspected {
            self.inspected = chosen.clone();
            let Chosen { points, obstacles } = chosen;
            self.player.ask(Order::Inspect(Among { points, obstacles, bonds: None }));
            self.panels_dirty = true;
            self.panels.matter_at.begin();
            if !self.inspected.is_empty() {
                self.panels.select();
            }
        }
    }

    /// Looks how what is selected bears its weight, or what the brush painted and could paint, where that is asked for and may be another.
    pub(super) fn weigh(&mut self) {
        let chosen = (self.hand.tool() != Tool::Paint).then(|| self.inspected.clone());
        let shown = self.player.shown();
        let is_asked = chosen.as_ref().is_none_or(|chosen| !chosen.points.is_empty());
        // How it stands is another thing once it has fallen.
        let goes_on = shown.scenery.bonds.len() <= MOST_WEIGHED;
        let look = if goes_on { (shown.figures.time / LOOKS).floor() as i64 } else { 0 };
        let of = is_asked.then_some((shown.topology, shown.settings.gravity, chosen, look));
        if of == self.bearings.0 {
            return;
        }
        // What still falls or sinks is left as it was judged.
        if let (Some(new), Some(old)) = (&of, &self.bearings.0) {
            let is_same = (new.0, new.1, &new.2) == (old.0, old.1, &old.2);
            let speed = shown.figures.velocity.map_or(0.0, |velocity| DVec3::from(velocity).length());
            if is_same && speed > STILL {
                return;
            }
        }
        let (bearings, among) = match &of {
            Some((.., Some(chosen), _)) => (Bearings::default(), chosen.points.clone()),
            Some((.., None, _)) => (Bearings::of(shown), self.painted.iter().copied().collect()),
            None => Default::default(),
        };
        // Of more bonds it would take longer than a frame.
        let overload = if among.is_empty() || !goes_on { None } else { overload(shown, &among) };
        (self.bearings, self.overload) = ((of, Arc::new(bearings)), overload.map(Arc::new));
    }

    /// What gives way under its load is made stiff enough for it, with what it stands on.
    pub(super) fn bear(&mut self) {
        let among: Vec<PointId> = match self.hand.tool() {
            Tool::Paint => self.painted.iter().copied().collect(),
            _ => self.inspected.points.clone(),
        };
        // As it is bent now, which it was not when that was offered.
        let Some(overload) = overload(self.shown(), &among) else { return };
        let among = Among { bonds: Some(overload.bonds), ..Among::default() };
        let change = MatterChange::Bears(overload.stiffness);
        self.player.ask(Order::Change { among, change, goes_on: false });
        self.dirty = true;
    }

    /// Where what is selected is seen `[points]`: the box around its points, some of many, and its obstacles.
    pub(super) fn selection_seen(&self) -> Option<egui::Rect> {
        if self.inspected.is_empty() {
            return None;
        }
        let (shown, chosen) = (self.shown(), &self.inspected);
        let step = chosen.points.len() / MOST_SEEN + 1;
        let points = chosen.points.iter().step_by(step).map(|point| DVec3::from(shown.place(point.index())));
        let scenery = &shown.scenery;
        let is_chosen = |number: &&u32| chosen.obstacles.contains(number);
        let flat = scenery.polygons.iter().zip(&scenery.solid_numbers).filter(|(_, number)| is_chosen(number));
        let corners = flat.flat_map(|(polygon, _)| &polygon.loops).flatten().map(|&x| DVec2::from(x).extend(0.0));
        let solid = scenery.convex.iter().zip(&scenery.solid_numbers).filter(|(_, number)| is_chosen(number));
        let ends = solid.flat_map(|(convex, _)| convex.figure.extent()).map(DVec3::from);
        let seen = points.chain(corners).chain(ends).filter_map(|place| self.camera.screen_from_world(place));
        let seen = seen.map(|pixel| self.point_of(pixel));
        let around = seen.fold(egui::Rect::NOTHING, |around, at| around.union(egui::Rect::from_min_max(at, at)));
        around.is_finite().then_some(around)
    }

    /// What is selected gets another matter.
    pub(super) fn change_matter(&mut self, change: MatterChange, goes_on: bool) {
        let Some(Chosen { points, obstacles }) = self.selected() else { return };
        let hides = change == MatterChange::Visible(false) && !points.is_empty();
        self.player.ask(Order::Change { among: Among { points, obstacles, bonds: None }, change, goes_on });
        self.dirty = true;
        if hides {
            self.say(HIDDEN.to_owned());
        }
    }

    /// What is selected is put where a number says.
    pub(super) fn place(&mut self, placing: Placing, goes_on: bool) {
        // What was not asked for at first is no edit to go on with.
        let goes_on = goes_on && self.is_put;
        self.is_put = goes_on;
        let Some(chosen) = self.selected() else { return };
        let (more, goes_on) = self.turned.more(placing, goes_on);
        let (fit, words) = match self.with_scope(|_, scope| chosen.fit(scope, more)) {
            Ok((fit, words)) => (Some(fit), words),
            Err(words) => (None, words),
        };
        if let Some(words) = words {
            self.say(words);
        }
        let Some(fit) = fit else { return };
        self.turned.take(placing);
        let Chosen { points, obstacles } = chosen;
        self.player.ask(Order::Place { among: Among { points, obstacles, bonds: None }, fit, placing, goes_on });
        self.is_put = true;
        self.dirty = true;
    }

    /// What is selected is not drawn any more.
    pub(super) fn hide(&mut self) {
        self.change_matter(MatterChange::Visible(false), false);
    }

    /// All that is hidden is drawn again, and selected.
    pub(super) fn show_hidden(&mut self) {
        let hidden = self.with_scope(|_, scope| Chosen::hidden(scope));
        if hidden.is_empty() {
            return self.say("nothing is hidden".to_owned());
        }
        let among = Among { points: hidden.points.clone(), ..Among::default() };
        self.player.ask(Order::Change { among, change: MatterChange::Visible(true), goes_on: false });
        self.with_scope(|hand, _| {
            hand.take(Tool::Select);
            hand.select(hidden);
        });
        // In place of what was said when it was hidden.
        self.say("all is drawn again, and selected".to_owned());
    }

    /// How many bodies are hidden: of the tool that selects, whose panel alone says it.
    pub(super) fn hidden_count(&self) -> usize {
        if self.hand.tool() != Tool::Select {
            return 0;
        }
        let scale = f64::from(self.look.scale_factor);
        hidden_bodies(Scope { shown: self.shown(), camera: &self.camera, scale, free: Scope::ANYWHERE }).len()
    }

    /// How the pointer looks over the world with a tool.
    fn icon_of(&mut self, tool: Tool, at: DVec2) -> CursorIcon {
        match self.hand.holds() {
            Some(Held::Grip) => return CursorIcon::Grabbing,
            Some(Held::Move) => return CursorIcon::Move,
            None => {}
        }
        let can_look = self.shown().point_count() <= MOST_HOVERED;
        if can_look && self.label_under(at).is_some() {
            return CursorIcon::Move;
        }
        let is_plane = self.scene.dimensions() == 2;
        let push = self.hand.push_way();
        let mut on = |what: fn(Scope<'_>, DVec2) -> bool| can_look && self.with_scope(|_, scope| what(scope, at));
        match tool {
            Tool::Hand if on(|scope, at| scope.starts_at(at)) => CursorIcon::Crosshair,
            Tool::Hand if on(|scope, at| scope.nearest(at).is_some() || scope.block(at).is_some()) => CursorIcon::Grab,
            Tool::Hand if on(|scope, at| scope.solid(at).is_some()) => CursorIcon::NotAllowed,
            Tool::Motor if !is_plane => CursorIcon::NotAllowed,
            Tool::Build if !is_plane && !is_of_space(self.hand.primitive()) => CursorIcon::NotAllowed,
            Tool::Select if can_look && self.with_scope(|hand, scope| hand.takes_stop(scope, at)) => CursorIcon::Grab,
            Tool::Select if can_look && self.with_scope(|hand, scope| hand.would_move(scope, at)) => CursorIcon::Move,
            other => idle_icon(other, push),
        }
    }

    /// The pointer looks as what a press would do.
    pub(super) fn show_cursor(&mut self) {
        let at = self.pixel().filter(|_| !self.is_over_panels() && !self.is_covered());
        let tool = self.hand.tool();
        let icon = match at.and_then(|at| self.with_scope(|hand, scope| hand.handle(scope, at))) {
            Some(Handle::Turn) => CursorIcon::Grab,
            Some(Handle::Corner(corner)) if corner % 2 == 0 => CursorIcon::NeswResize,
            Some(Handle::Corner(_)) => CursorIcon::NwseResize,
            None => match at.and_then(|at| self.with_scope(|hand, scope| hand.ring(scope, at))) {
                Some(Ring::About(_)) => CursorIcon::Grab,
                Some(Ring::Size) => CursorIcon::NeswResize,
                None => at.map_or(CursorIcon::Default, |at| self.icon_of(tool, at)),
            },
        };
        if icon != self.cursor_icon {
            self.cursor_icon = icon;
            self.window.set_cursor(icon);
        }
    }
}

/// How the pointer looks over the world with a tool, wherever it has nothing else to say: each tool has an icon of its own, and so has the wind.
fn idle_icon(tool: Tool, push: PushWay) -> CursorIcon {
    match tool {
        Tool::Hand => CursorIcon::Default,
        Tool::Pin => CursorIcon::Pointer,
        Tool::Cut => CursorIcon::Crosshair,
        // A short bar in the middle of its ring: what has arms would be taken for a part of that.
        Tool::Paint => CursorIcon::VerticalText,
        // An arrow to somewhere, as forces are drawn; that of the wind is askew.
        Tool::Push if push == PushWay::Wind => CursorIcon::NeResize,
        Tool::Push => CursorIcon::EResize,
        Tool::Erase => CursorIcon::NoDrop,
        Tool::Build => CursorIcon::Copy,
        Tool::Muscle => CursorIcon::EwResize,
        Tool::Motor => CursorIcon::Alias,
        Tool::Select => CursorIcon::Cell,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tool_has_a_pointer_of_its_own() {
        let tools = Tool::ALL.into_iter().map(|tool| (tool, PushWay::default()));
        let tools: Vec<(Tool, PushWay)> = tools.chain([(Tool::Push, PushWay::Wind)]).collect();
        for (place, &(tool, push)) in tools.iter().enumerate() {
            let icon = idle_icon(tool, push);
            for &(other, way) in &tools[place + 1..] {
                assert_ne!(icon, idle_icon(other, way), "{tool:?} and {other:?}, {way:?}");
            }
            // Those say what is going on, which handle is held, or that nothing can be done.
            let going_on = [CursorIcon::Grab, CursorIcon::Grabbing, CursorIcon::Move, CursorIcon::NotAllowed];
            let handles = [CursorIcon::NeswResize, CursorIcon::NwseResize];
            assert!(!going_on.contains(&icon) && !handles.contains(&icon), "{tool:?}, {push:?}");
        }
    }
}
