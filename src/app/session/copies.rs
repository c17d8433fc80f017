//! Copies of what is selected: beside it, onto the clipboard, and from there to where the pointer is.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::Session;
use crate::app::action::Tool;
use crate::app::clip::{Clip, IN_ANOTHER, Wish};
use crate::app::count::counted;
use crate::app::fetch;
use crate::app::matter::Among;
use crate::app::player::Order;
use crate::app::tools::{Chosen, over};
use crate::history::History;

/// What copies beside what is selected are called when they are undone, and what comes from the clipboard.
const DUPLICATE: &str = "duplicate";
const PASTE: &str = "paste";
/// What every refusal of the clipboard begins with.
const NOT_PASTED: &str = "nothing is pasted";

/// What Ctrl+C copied: the stepping thread puts it there.
pub(super) type Copied = Arc<OnceLock<Clip>>;

/// A row of duplicates.
#[derive(Clone)]
pub(super) struct Row {
    /// The order that made the last one.
    serial: u64,
    /// How far each is wished to be from the one before `[m]`.
    by: [f64; 3],
    /// The last one, of which the next is made: the stepping thread knows its numbers.
    last: Arc<Mutex<Chosen>>,
}

impl Session {
    /// A copy of what is selected comes beside it, and is selected in its place. Whoever asks again before it is there gets one of that.
    pub(super) fn duplicate(&mut self) {
        let done = self.shown().serial;
        let row = self.duplicated.take().filter(|row| row.serial > done).or_else(|| {
            let chosen = self.selected()?;
            let by = self.with_scope(|_, scope| chosen.beside(scope));
            Some(Row { serial: 0, by, last: Arc::new(Mutex::new(chosen)) })
        });
        let Some(row) = row else { return };
        let count = row.last.lock().unwrap_or_else(PoisonError::into_inner).points.len();
        let wish = Wish { is_beside: true, ..self.wish(DUPLICATE, row.by) };
        self.ask_if_full(count, move |session| {
            let last = Arc::clone(&row.last);
            let copy = move |history: &History| {
                let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
                let coming = Clip::of(history, &last).coming(history, &wish)?;
                if let Some((came, _)) = &coming.came {
                    *last = Chosen { points: came.points.clone(), obstacles: came.obstacles.clone() };
                }
                Ok(coming)
            };
            session.player.ask(Order::Add(Box::new(copy)));
            session.duplicated = Some(Row { serial: session.player.serial(), ..row });
        });
    }

    /// A copy of what is selected is kept as it is now, to be pasted here or in another scene.
    pub(super) fn copy(&mut self) {
        let Some(chosen) = self.selected() else { return };
        let copied = Copied::default();
        self.copied = Some(Arc::clone(&copied));
        let words = in_words(chosen.points.len(), chosen.obstacles.len());
        self.player.ask(Order::Copy(Box::new(move |history| {
            let clip = Clip::of(history, &chosen);
            fetch::copy(clip.fragment());
            // It is new, so there is nothing in it.
            let _ = copied.set(clip);
        })));
        self.say(format!("copied: {words}; Ctrl+V puts a copy where the pointer is"));
    }

    /// What was copied comes to where the pointer is. Returns whether anything was.
    pub(super) fn paste_copied(&mut self) -> bool {
        let Some(copied) = self.copied.clone() else { return false };
        match copied.get() {
            Some(clip) => self.paste_clip(clip.clone()),
            None => self.refuse_to_paste("what was copied is still on its way: try again"),
        }
        true
    }

    /// Nothing comes from the clipboard, and why.
    pub(super) fn refuse_to_paste(&mut self, why: &str) {
        self.refuse(&format!("{NOT_PASTED}: {why}"));
    }

    /// Bodies come to where the pointer is, or to the middle of what is seen while it is on a panel.
    pub(super) fn paste_clip(&mut self, clip: Clip) {
        let named = |dimensions: usize| if dimensions == 2 { "the plane" } else { "space" };
        if clip.dimensions != self.scene.dimensions() {
            return self.refuse_to_paste(&format!(
                "what was copied is of {}, and this scene is in {}",
                named(clip.dimensions),
                named(self.scene.dimensions())
            ));
        }
        let [low, high] = self.free_here();
        let on_world = self.pixel().filter(|at| {
            let is_in = (0..2).all(|k| (low[k]..=high[k]).contains(&at[k]));
            is_in && !self.is_over_panels()
        });
        let at = on_world.map_or([0, 1].map(|k| 0.5 * (low[k] + high[k])), |at| at.to_array());
        let to = self.camera_here().world_from_screen(at).to_array();
        let by = std::array::from_fn(|axis| to[axis] - clip.middle[axis]);
        let mut wish = self.wish(PASTE, by);
        wish.is_meant = on_world.is_some();
        let [points, _] = clip.counts();
        self.ask_if_full(points as usize, move |session| {
            session.player.ask(Order::Add(Box::new(move |history| clip.coming(history, &wish))));
        });
    }

    /// What panels leave of the world that the pointer is on `[px]`.
    fn free_here(&self) -> [[f64; 2]; 2] {
        let corner = self.tiles.shift(self.cell, self.area);
        let size = self.tiles.pane(self.area).map(f64::from);
        let [low, high] = self.free;
        let low = [0, 1].map(|k| low[k].max(corner[k]));
        let high = [0, 1].map(|k| high[k].min(corner[k] + size[k]));
        let has_room = (0..2).all(|k| high[k] > low[k]);
        if has_room { [low, high] } else { [corner, [0, 1].map(|k| corner[k] + size[k])] }
    }

    fn wish(&self, name: &'static str, by: [f64; 3]) -> Wish {
        Wish { name, by, is_meant: false, is_beside: false, camera: self.camera_here(), free: self.free_here() }
    }

    /// A copy is there: it is selected in place of what was.
    pub(super) fn have_come(&mut self, came: Among, said: Option<&'static str>, why: Option<String>) {
        let words = in_words(came.points.len(), came.obstacles.len());
        let Among { points, obstacles, .. } = came;
        self.with_scope(|hand, _| {
            hand.take(Tool::Select);
            hand.select_copy(Chosen { points, obstacles });
        });
        match (said, why) {
            (Some(said), _) => {
                let words = lies_in_words(said, over(self.shown()));
                self.panels.notes.warn(words);
            }
            (None, Some(why)) => {
                self.complain(&format!("the copy is there, but bodies pass through each other: {why}"))
            }
            (None, None) => self.say(format!("a copy: {words}; Ctrl+Z takes it away again")),
        }
    }
}

/// What is said of where a copy lies; over another body as of one that is built there.
fn lies_in_words(said: &str, over: Option<&str>) -> String {
    match over.filter(|_| said == IN_ANOTHER) {
        Some(over) => format!("no free space in view: the copy lies {over}"),
        None => said.to_owned(),
    }
}

/// So many points and obstacles.
fn in_words(points: usize, obstacles: usize) -> String {
    let all = [(points, "point"), (obstacles, "obstacle")].into_iter().filter(|(count, _)| *count > 0);
    let all: Vec<String> = all.map(|(count, name)| counted(count, name)).collect();
    all.join(" and ")
}

#[cfg(test)]
mod tests {
    use super::{IN_ANOTHER, lies_in_words};

    #[test]
    fn a_copy_that_lies_over_another_body_is_told_of_as_what_is_built_there() {
        let over = "over another body: they part as time runs, unless they are hinged (8)";
        assert!(lies_in_words(IN_ANOTHER, Some(over)).ends_with(&format!("the copy lies {over}")));
        assert_eq!(lies_in_words(IN_ANOTHER, None), IN_ANOTHER, "where bodies pass through each other none part");
        assert_eq!(lies_in_words("out of view", Some(over)), "out of view");
    }
}
