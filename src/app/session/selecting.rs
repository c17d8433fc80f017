//! What is done with what is selected: copies, groups, its matter.

use std::sync::{Arc, OnceLock};

use winit::window::CursorIcon;

use super::Session;
use crate::app::action::Tool;
use crate::app::count::counted;
use crate::app::fetch;
use crate::app::matter::{Among, MatterChange};
use crate::app::player::Order;
use crate::app::tools::{Chosen, Clip, Handle};
use crate::history::{Do, Group};
use crate::sim::PointId;

/// Said where nothing is selected.
const NOTHING: &str = "select something first: the tool for that is 6";

/// Of so many points at most it is looked where they are seen.
const MOST_LOOKED_AT: usize = 1_000;

/// A scene may take so long for a frame with what is pasted, without a question `[s]`.
const MOST_WORK: f64 = 1.0 / 60.0;
/// So many points are pasted without a question into a scene that has not run yet.
const MOST_UNKNOWN: u32 = 20_000;
/// What makes a scene larger by less than this share of it is not asked about `[1]`.
const LITTLE: f64 = 0.05;

/// What Ctrl+C copied: the stepping thread puts it there.
#[derive(Clone, Default)]
pub(super) struct Copied {
    clip: Arc<OnceLock<Clip>>,
    /// The user was asked whether it is to come into a scene of so many points.
    asked: Option<usize>,
}

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
        self.player.ask(Order::Add(Box::new(move |_, world| Ok(Clip::of(world, &tints, &chosen).placed(world, by)))));
        self.with_scope(|hand, _| hand.select(coming));
    }

    /// A copy of what is selected is kept as it is now, to be pasted here or in another scene.
    pub(super) fn copy(&mut self) {
        let Some(chosen) = self.selected() else { return };
        let copied = Arc::new(OnceLock::new());
        self.copied = Some(Copied { clip: Arc::clone(&copied), asked: None });
        let [points, obstacles] = [chosen.points.len(), chosen.obstacles.len()];
        self.player.ask(Order::Copy(Box::new(move |world, tints| {
            // It is new, so there is nothing in it.
            let _ = copied.set(Clip::of(world, tints, &chosen));
        })));
        fetch::announce();
        let all = [(points, "point"), (obstacles, "obstacle")].into_iter().filter(|(count, _)| *count > 0);
        let all: Vec<String> = all.map(|(count, name)| counted(count, name)).collect();
        self.say(format!("copied: {}; Ctrl+V puts a copy where the cursor is", all.join(" and ")));
    }

    /// What was copied comes to where the cursor is. Returns whether anything was.
    pub(super) fn paste_copied(&mut self) -> bool {
        let Some(copied) = self.copied.clone() else { return false };
        let Some(clip) = copied.clip.get() else {
            self.say("what was copied is still on its way: try again".to_owned());
            return true;
        };
        if clip.dimensions != self.scene.dimensions() {
            self.complain(&format!(
                "what was copied is of a scene of {} dimensions: it cannot come into one of {}",
                clip.dimensions,
                self.scene.dimensions()
            ));
            return true;
        }
        let [points, obstacles] = clip.counts();
        let figures = &self.shown().figures;
        let there = figures.points;
        if let Some(question) = question(figures.work, there, points).filter(|_| copied.asked != Some(there)) {
            self.copied = Some(Copied { asked: Some(there), ..copied });
            self.say(question);
            return true;
        }
        let coming = self.coming(points, obstacles);
        let by = match (clip.dimensions, self.pixel()) {
            (2, Some(at)) => {
                let to = self.camera_here().world_from_screen(at.to_array()).to_array();
                [to[0] - clip.middle[0], to[1] - clip.middle[1], 0.0]
            }
            _ => [0.0; 3],
        };
        let clip = clip.clone();
        self.player.ask(Order::Add(Box::new(move |_, world| Ok(clip.placed(world, by)))));
        self.with_scope(|hand, _| {
            hand.take(Tool::Select);
            hand.select(coming);
        });
        true
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

    /// The pointer looks as what a press would do.
    pub(super) fn show_cursor(&mut self) {
        let at = self.pixel().filter(|_| !self.is_over_panels() && !self.is_covered());
        let tool = self.hand.tool();
        let icon = match at.and_then(|at| self.with_scope(|hand, scope| hand.handle(scope, at))) {
            Some(Handle::Turn) => CursorIcon::Grab,
            Some(Handle::Corner(corner)) if corner % 2 == 0 => CursorIcon::NeswResize,
            Some(Handle::Corner(_)) => CursorIcon::NwseResize,
            None if at.is_some() && matches!(tool, Tool::Cut | Tool::Build | Tool::Paint) => CursorIcon::Crosshair,
            None => CursorIcon::Default,
        };
        if icon != self.cursor_icon {
            self.cursor_icon = icon;
            self.window.set_cursor(icon);
        }
    }
}

/// What is asked before so many points come into a scene that has others, where stepping a frame of it takes so long `[s]`; 0: not known.
fn question(work: f64, there: usize, more: u32) -> Option<String> {
    let many = f64::from(more) / there.max(1) as f64;
    let then = work * (1.0 + many);
    let counted = counted(more as usize, "point");
    match work > 0.0 && there > 0 {
        true if then > MOST_WORK && many > LITTLE => Some(format!(
            "{counted} more: the scene would run at about {:.0} % of its pace; Ctrl+V once more puts them here all the same",
            (100.0 * MOST_WORK / then).clamp(1.0, 99.0)
        )),
        false if more > MOST_UNKNOWN => {
            Some(format!("{counted} more may be slow; Ctrl+V once more puts them here all the same"))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::question;

    #[test]
    fn what_would_slow_a_scene_down_is_asked_about_before() {
        assert_eq!(question(0.002, 1_000, 1_000), None, "there is time for it");
        assert!(question(0.01, 1_000, 4_000).is_some_and(|words| words.contains("33 % of its pace")));
        assert_eq!(question(0.05, 10_000, 100), None, "next to what is there it is nothing");
        assert_eq!(question(0.0, 0, 500), None);
        assert!(question(0.0, 0, 50_000).is_some_and(|words| words.contains("once more")));
    }
}
