//! What is done with what is selected: copies, groups, its matter.

use std::sync::{Arc, OnceLock};

use winit::window::CursorIcon;

use super::Session;
use crate::app::action::Tool;
use crate::app::count::counted;
use crate::app::fetch;
use crate::app::matter::{Among, MatterChange};
use crate::app::player::Order;
use crate::app::tools::{Chosen, Clip, Handle, Held, Scope};
use crate::history::{Do, Group};
use crate::sim::PointId;

/// Said where nothing is selected.
const NOTHING: &str = "select something first: the tool for that is 6";

/// What the pointer is on is looked for among so many points: more would take longer than a frame.
const MOST_HOVERED: usize = 100_000;
/// Of so many points at most it is looked where they are seen.
const MOST_LOOKED_AT: usize = 1_000;

/// What Ctrl+C copied: the stepping thread puts it there.
pub(super) type Copied = Arc<OnceLock<Clip>>;

impl Session {
    /// What is selected, if anything is.
    fn selected(&mut self) -> Option<Chosen> {
        let chosen = self.with_scope(|hand, scope| hand.chosen(scope));
        if chosen.is_none() {
            self.say(NOTHING.to_owned());
        }
        chosen
    }

    /// All bodies and obstacles are selected.
    pub(super) fn select_all(&mut self) {
        self.with_scope(|hand, scope| hand.select_all(scope));
    }

    /// What a copy of so many points and obstacles will be.
    fn coming(&self, points: u32, obstacles: u32) -> Chosen {
        let [point, obstacle] = [self.shown().point_count() as u32, self.shown().scenery.next_obstacle];
        Chosen {
            points: (point..point + points).map(PointId).collect(),
            obstacles: (obstacle..obstacle + obstacles).collect(),
        }
    }

    /// A copy of what is selected comes beside it, and is selected in its place.
    pub(super) fn duplicate(&mut self) {
        let Some(chosen) = self.selected() else { return };
        let by = self.with_scope(|_, scope| chosen.beside(scope));
        let coming = self.coming(chosen.points.len() as u32, chosen.obstacles.len() as u32);
        let tints = Arc::clone(&self.shown().scenery.tints);
        self.ask_if_full(chosen.points.len(), move |session| {
            session
                .player
                .ask(Order::Add(Box::new(move |_, world| Ok(Clip::of(world, &tints, &chosen).placed(world, by)))));
            session.with_scope(|hand, _| hand.select(coming));
        });
    }

    /// A copy of what is selected is kept as it is now, to be pasted here or in another scene.
    pub(super) fn copy(&mut self) {
        let Some(chosen) = self.selected() else { return };
        let copied = Copied::default();
        self.copied = Some(Arc::clone(&copied));
        let [points, obstacles] = [chosen.points.len(), chosen.obstacles.len()];
        self.player.ask(Order::Copy(Box::new(move |world, tints| {
            let clip = Clip::of(world, tints, &chosen);
            fetch::copy(clip.fragment());
            // It is new, so there is nothing in it.
            let _ = copied.set(clip);
        })));
        let all = [(points, "point"), (obstacles, "obstacle")].into_iter().filter(|(count, _)| *count > 0);
        let all: Vec<String> = all.map(|(count, name)| counted(count, name)).collect();
        self.say(format!("copied: {}; Ctrl+V puts a copy where the cursor is", all.join(" and ")));
    }

    /// What was copied comes to where the cursor is. Returns whether anything was.
    pub(super) fn paste_copied(&mut self) -> bool {
        let Some(copied) = self.copied.clone() else { return false };
        let Some(clip) = copied.get() else {
            self.say("what was copied is still on its way: try again".to_owned());
            return true;
        };
        let clip = clip.clone();
        self.paste_clip(clip);
        true
    }

    /// Bodies come to where the cursor is.
    pub(super) fn paste_clip(&mut self, clip: Clip) {
        if clip.dimensions != self.scene.dimensions() {
            self.complain(&format!(
                "what was copied is of a scene of {} dimensions: it cannot come into one of {}",
                clip.dimensions,
                self.scene.dimensions()
            ));
            return;
        }
        let [points, obstacles] = clip.counts();
        let coming = self.coming(points, obstacles);
        let by = match (clip.dimensions, self.pixel()) {
            (2, Some(at)) => {
                let to = self.camera_here().world_from_screen(at.to_array()).to_array();
                [to[0] - clip.middle[0], to[1] - clip.middle[1], 0.0]
            }
            _ => [0.0; 3],
        };
        self.ask_if_full(points as usize, move |session| {
            session.player.ask(Order::Add(Box::new(move |_, world| Ok(clip.placed(world, by)))));
            session.with_scope(|hand, _| {
                hand.take(Tool::Select);
                hand.select(coming);
            });
        });
    }

    /// The points that are selected are selected as one from now on.
    pub(super) fn group(&mut self) {
        let Some(chosen) = self.selected() else { return };
        if chosen.points.len() < 2 {
            return self.say("a group is made of bodies: select some more with Shift, or a box around them".to_owned());
        }
        let groups = &self.shown().scenery.groups;
        let is_free = |name: &String| groups.iter().all(|group| group.points.is_empty() || group.name != *name);
        let Some(name) = (1..).map(|k| format!("group {k}")).find(is_free) else { return };
        self.player.give(vec![Do::Group { points: chosen.points, name: name.clone() }], Some("group"));
        self.say(format!("{name}: a click on one of its bodies selects all of it; Ctrl+Shift+G ends that"));
    }

    /// Whether something that is selected is in a group.
    pub(super) fn is_grouped(&self) -> bool {
        let is_chosen = |point: &PointId| self.inspected.points.binary_search(point).is_ok();
        self.shown().scenery.groups.iter().any(|group| group.points.iter().any(is_chosen))
    }

    /// The groups that are selected are none any more.
    pub(super) fn ungroup(&mut self) {
        let Some(chosen) = self.selected() else { return };
        let has = |group: &&Group| group.points.iter().any(|point| chosen.points.binary_search(point).is_ok());
        let groups = self.shown().scenery.groups.iter().filter(has);
        let acts: Vec<Do> = groups.map(|group| Do::Group { points: Vec::new(), name: group.name.clone() }).collect();
        match acts.len() {
            0 => self.say("what is selected is in no group".to_owned()),
            _ => {
                self.player.give(acts, Some("ungroup"));
                self.say("each body is selected by itself again".to_owned());
            }
        }
    }

    /// The stepping thread is told whose matter is to be shown, where that is new.
    pub(super) fn inspect(&mut self) {
        let chosen = self.with_scope(|hand, scope| hand.chosen(scope)).unwrap_or_default();
        if chosen != self.inspected {
            self.inspected = chosen.clone();
            self.panels.selected_at = self.rect_of(&chosen.points);
            let Chosen { points, obstacles } = chosen;
            self.player.ask(Order::Inspect(Among { points, obstacles, bonds: None }));
            self.panels_dirty = true;
        }
    }

    /// The box that points are seen in `[points]`, of some of many.
    fn rect_of(&self, points: &[PointId]) -> Option<egui::Rect> {
        let (camera, scale) = (self.camera_here(), f64::from(self.egui.egui_ctx().pixels_per_point()));
        let step = points.len() / MOST_LOOKED_AT + 1;
        let seen = points.iter().step_by(step).filter_map(|point| {
            let [x, y] = camera.screen_from_world(self.shown().place(point.index()).into())?;
            Some(egui::pos2((x / scale) as f32, (y / scale) as f32))
        });
        let rect = egui::Rect::from_points(&seen.collect::<Vec<_>>());
        rect.is_finite().then_some(rect)
    }

    /// What is selected gets another matter.
    pub(super) fn change_matter(&mut self, change: MatterChange, goes_on: bool) {
        let Some(Chosen { points, obstacles }) = self.selected() else { return };
        self.player.ask(Order::Change { among: Among { points, obstacles, bonds: None }, change, goes_on });
        self.dirty = true;
    }

    /// How the pointer looks over the world with a tool.
    fn icon_of(&mut self, tool: Tool, at: glam::DVec2) -> CursorIcon {
        match self.hand.holds() {
            Some(Held::Grip) => return CursorIcon::Grabbing,
            Some(Held::Move) => return CursorIcon::Move,
            None => {}
        }
        let can_look = self.shown().point_count() <= MOST_HOVERED;
        let is_plane = self.scene.dimensions() == 2;
        let mut on = |what: fn(Scope<'_>, glam::DVec2) -> bool| can_look && self.with_scope(|_, scope| what(scope, at));
        match tool {
            Tool::Hand if on(|scope, at| scope.nearest(at).is_some()) => CursorIcon::Grab,
            Tool::Hand if on(|scope, at| scope.solid(at).is_some()) => CursorIcon::NotAllowed,
            Tool::Hand => CursorIcon::Default,
            Tool::Cut | Tool::Build | Tool::Motor if !is_plane => CursorIcon::NotAllowed,
            Tool::Pin => CursorIcon::Cell,
            Tool::Cut | Tool::Paint | Tool::Push => CursorIcon::Crosshair,
            Tool::Erase => CursorIcon::NoDrop,
            Tool::Build => CursorIcon::Copy,
            Tool::Muscle => CursorIcon::Pointer,
            Tool::Motor => CursorIcon::Alias,
            Tool::Select if on(|scope, at| scope.nearest(at).is_some() || scope.solid(at).is_some()) => {
                CursorIcon::Move
            }
            Tool::Select => CursorIcon::Default,
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
            None => at.map_or(CursorIcon::Default, |at| self.icon_of(tool, at)),
        };
        if icon != self.cursor_icon {
            self.cursor_icon = icon;
            self.window.set_cursor(icon);
        }
    }
}
