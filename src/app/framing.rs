//! When the view is fitted to what panels leave of the window: as a scene opens and when it is asked for, not while somebody uses it.

use std::time::{Duration, Instant};

use egui::Rect;

use super::action::Tool;
use super::opening::{Free, Over};
use super::panels::Laid;
use crate::render::Camera;

/// How the camera came to be where it is: it is put there again when the window gets another size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Framing {
    /// As the scene opens.
    Opening,
    /// All points.
    Fit,
    /// By hand.
    Free,
}

/// What panels leave of a window, in its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Left {
    /// Width and height of the part that the world is drawn in `[px]`.
    pub(super) area: [u32; 2],
    /// Where nothing lies over it; `None`: a sheet lies over all of it for now.
    pub(super) free: Option<Free>,
    /// What lies over that part where it may.
    pub(super) over: Over,
    /// Height of what stands above each of several worlds `[px]`.
    pub(super) titles: f64,
}

impl Left {
    /// Of a window of this size `[px]`, with so many of them a point.
    pub(super) fn of(laid: &Laid, scale: f32, window: [u32; 2]) -> Self {
        let pixels = laid.size.map(|side| (side * scale).round() as u32);
        let corners = |free: Rect| [free.min, free.max].map(|at| [at.x, at.y].map(|x| f64::from((x * scale).round())));
        Left {
            area: [pixels[0].min(window[0]), pixels[1].min(window[1])],
            free: laid.free.map(corners),
            over: Over {
                corner: laid.corner.map(|at| [at.x, at.y].map(|x| f64::from(x * scale))),
                column: laid.column.map(|ends| ends.map(|x| f64::from((x * scale).round()))),
                low: laid.column_low.map(|low| f64::from((low * scale).round())),
            },
            titles: f64::from(laid.titles * scale),
        }
    }
}

/// What is open, by which panels leave more room or less.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Open {
    pub(super) tool: Tool,
    /// Settings, lessons, plots, figures, the legend of strains; all panels are hidden; and a sheet lies over them.
    pub(super) panels: [bool; 7],
}

/// What the camera does when panels leave another part of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// It stays as it is.
    Stay,
    /// The world is drawn in a larger or smaller part of the window: at the same scale, with the same place in the left upper corner.
    Keep,
    /// It is fitted anew.
    Fit,
}

/// Whether the view was just fitted: panels find their sizes in the frames after that, and it is fitted to those too.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Framed {
    fresh: Fresh,
    /// Width and height of the window when panels were shown last `[px]`.
    window: [u32; 2],
}

#[derive(Clone, Copy, Debug, Default)]
enum Fresh {
    /// It was fitted since panels were shown last.
    #[default]
    Now,
    /// These panels were there in the first frame after that, and nobody used the scene.
    With(Open),
    /// Somebody opened a panel or pressed into the scene: nothing moves under the pointer.
    Not,
}

impl Framed {
    /// The view is fitted, because a scene opens or somebody asked for it.
    pub(super) fn begin(&mut self) {
        self.fresh = Fresh::Now;
    }

    /// Somebody uses the scene as it is seen.
    pub(super) fn hold(&mut self) {
        self.fresh = Fresh::Not;
    }

    /// Panels were shown in a window of this size `[px]`. They leave another part of it free, if `is_other`; the world is drawn in another
    /// part of it, if `is_resized`.
    pub(super) fn turn(&mut self, (window, open): ([u32; 2], Open), (is_other, is_resized): (bool, bool)) -> Turn {
        let is_new_window = std::mem::replace(&mut self.window, window) != window;
        if is_new_window {
            self.fresh = Fresh::Now;
        }
        self.fresh = match self.fresh {
            Fresh::Now => Fresh::With(open),
            Fresh::With(other) if other == open => Fresh::With(open),
            Fresh::With(_) | Fresh::Not => Fresh::Not,
        };
        match self.fresh {
            Fresh::With(_) if is_other || is_resized || is_new_window => Turn::Fit,
            _ if is_resized => Turn::Keep,
            _ => Turn::Stay,
        }
    }
}

/// The view of worlds side by side before a panel took room from them: it comes back with the room.
#[derive(Clone, Copy, Debug)]
pub(super) struct Undocked {
    /// The camera of all of them, and the part of the window that they shared `[px]`.
    camera: Camera,
    area: [u32; 2],
    /// The camera that was made of it since.
    now: Camera,
}

impl Undocked {
    /// Of worlds that are seen by `camera` in `area` `[px]`, where `last` is what was known of them: somebody may have moved the view since.
    pub(super) fn of(last: Option<Undocked>, camera: Camera, area: [u32; 2]) -> Self {
        last.filter(|last| last.now == camera).unwrap_or(Undocked { camera, area, now: camera })
    }

    /// The camera in `area` `[px]`: as it was, where they share as much as before, or what `narrowed` makes of it.
    pub(super) fn lead(&mut self, area: [u32; 2], narrowed: impl FnOnce(&Camera, [u32; 2]) -> Camera) -> Camera {
        self.now = if area == self.area { self.camera } else { narrowed(&self.camera, self.area) };
        self.now
    }
}

/// The view before panels that opened took room from it: it comes back with the room.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    /// As it was, and what was made of it.
    before: Camera,
    now: Camera,
}

impl Beside {
    /// What a view is beside panels, where `last` is what was known of it: somebody may have moved it since.
    pub(super) fn of(last: Option<Beside>, camera: Camera, look: impl FnOnce(Camera) -> Camera) -> (Self, Camera) {
        let before = last.filter(|last| last.now == camera).map_or(camera, |last| last.before);
        let now = look(before);
        (Beside { before, now }, now)
    }
}

/// In so many frames panels find their sizes after one of them opened or closed.
const SETTLING: u8 = 8;

/// What is selected lies still once it stayed within so many points for so long.
const STILL: f32 = 3.0;
const REST: Duration = Duration::from_millis(400);

/// Whether what is selected came to lie below the panel of the tool that selects.
#[derive(Debug, Default)]
pub(super) struct Lying {
    /// Where it was seen below the panel, and since when.
    still: Option<(Rect, Instant)>,
    /// The view made way since it came there, as far as it could.
    is_done: bool,
}

impl Lying {
    /// Whether the view is to make way: what is selected is `seen` below a panel `[points]`, and lies still there, or all `stands`. Once,
    /// until it was elsewhere.
    pub(super) fn is_due(&mut self, now: Instant, (seen, panel): (Option<Rect>, Option<Rect>), stands: bool) -> bool {
        let Some(seen) = seen.filter(|seen| panel.is_some_and(|panel| panel.intersects(*seen))) else {
            *self = Lying::default();
            return false;
        };
        if self.is_done {
            return false;
        }
        let is_near = |at: Rect| at.min.distance(seen.min).max(at.max.distance(seen.max)) < STILL;
        let (at, since) = self.still.filter(|(at, _)| is_near(*at)).unwrap_or((seen, now));
        self.still = Some((at, since));
        self.is_done = stands || now.saturating_duration_since(since) >= REST;
        self.is_done
    }
}

/// How a view made way for panels that opened over it.
#[derive(Debug, Default)]
pub(super) struct Ways {
    pub(super) beside: Option<Beside>,
    /// What they take of it `[px]`.
    pub(super) taken: Vec<[f64; 4]>,
    pub(super) lying: Lying,
    /// Which of them are open, with which tool, and for how many frames more they find their sizes.
    open: [bool; 5],
    tool: Tool,
    left: u8,
}

impl Ways {
    /// Whether panels find their sizes still, of which these are open: those of a tool alone are waited for no more.
    pub(super) fn wait_for(&mut self, open: [bool; 5], tool: Tool) -> bool {
        let is_other_tool = std::mem::replace(&mut self.tool, tool) != tool;
        self.left = match std::mem::replace(&mut self.open, open) != open {
            true => SETTLING,
            false if is_other_tool => 0,
            false => self.left.saturating_sub(1),
        };
        self.left > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [1280, 720];

    fn with(tool: Tool, settings: bool) -> Open {
        Open { tool, panels: [settings, false, false, true, false, false, false] }
    }

    #[test]
    fn the_view_is_fitted_while_panels_find_their_sizes_and_then_left_alone() {
        let mut framed = Framed::default();
        let turn = |framed: &mut Framed, open: Open, is_other: bool| framed.turn((SIZE, open), (is_other, false));
        let usual = with(Tool::Hand, false);
        assert_eq!(turn(&mut framed, usual, true), Turn::Fit, "the first frame");
        assert_eq!(turn(&mut framed, usual, true), Turn::Fit, "a caption got its lines");
        assert_eq!(turn(&mut framed, usual, false), Turn::Stay);
        assert_eq!(turn(&mut framed, with(Tool::Hand, true), true), Turn::Stay, "settings were opened");
        assert_eq!(turn(&mut framed, usual, true), Turn::Stay, "and closed");
        framed.begin();
        assert_eq!(turn(&mut framed, with(Tool::Select, true), true), Turn::Fit, "Home, beside what is open");
        assert_eq!(turn(&mut framed, with(Tool::Paint, true), true), Turn::Stay, "another tool");
        framed.begin();
        assert_eq!(turn(&mut framed, usual, true), Turn::Fit);
        framed.hold();
        assert_eq!(turn(&mut framed, usual, true), Turn::Stay, "somebody pressed into the scene");
    }

    #[test]
    fn the_view_comes_back_with_the_room_unless_somebody_moved_it() {
        use crate::render::Pose;
        let at = |height: f64| Camera::new(Pose::Plane { center: glam::DVec2::ZERO, height }, SIZE);
        let (wide, low) = ([1280, 670], [1280, 400]);
        let mut undocked = Undocked::of(None, at(4.0), wide);
        let docked = undocked.lead(low, |camera, area| {
            assert_eq!((*camera, area), (at(4.0), wide));
            at(6.0)
        });
        assert_eq!(docked, at(6.0));
        let mut again = Undocked::of(Some(undocked), docked, low);
        // The panel finds its size in two frames: nothing adds up.
        assert_eq!(again.lead([1280, 390], |camera, _| *camera), at(4.0));
        assert_eq!(Undocked::of(Some(undocked), docked, low).lead(wide, |_, _| at(9.0)), at(4.0), "closed again");
        let moved = Undocked::of(Some(undocked), at(5.0), low).lead(wide, |camera, area| {
            assert_eq!((*camera, area), (at(5.0), low));
            at(8.0)
        });
        assert_eq!(moved, at(8.0));
    }

    #[test]
    fn what_panels_took_from_the_view_comes_back_with_them_whichever_closes_first() {
        use crate::render::Pose;
        let at = |height: f64| Camera::new(Pose::Plane { center: glam::DVec2::ZERO, height }, SIZE);
        let (one, now) = Beside::of(None, at(4.0), |_| at(6.0));
        let (both, now) = Beside::of(Some(one), now, |before| {
            assert_eq!(before, at(4.0), "nothing adds up");
            at(8.0)
        });
        let (_, closed) = Beside::of(Some(both), now, |before| before);
        assert_eq!(closed, at(4.0));
        let (_, moved) = Beside::of(Some(both), at(5.0), |before| before);
        assert_eq!(moved, at(5.0), "somebody moved it since");
    }

    #[test]
    fn views_make_way_while_panels_that_opened_find_their_sizes_and_then_no_more() {
        let mut ways = Ways::default();
        let plots = [false, false, true, false, false];
        assert!(!ways.wait_for([false; 5], Tool::Hand), "nothing opened");
        assert!((0..SETTLING).all(|_| ways.wait_for(plots, Tool::Hand)));
        assert!(!ways.wait_for(plots, Tool::Hand), "what gets larger later moves no view");
        assert!(ways.wait_for([false; 5], Tool::Hand), "it closed");
        assert!(!ways.wait_for([false; 5], Tool::Paint), "what a tool's panel moves moves no view");
    }

    #[test]
    fn the_view_makes_way_once_for_what_comes_to_lie_below_the_panel() {
        use egui::{pos2, vec2};
        let panel = Some(Rect::from_min_max(pos2(1000.0, 60.0), pos2(1270.0, 600.0)));
        let at = |x: f32| Some(Rect::from_min_size(pos2(x, 300.0), vec2(80.0, 80.0)));
        let start = Instant::now();
        let later = |tenths: u64| start + Duration::from_millis(100 * tenths);
        let mut lying = Lying::default();
        // It rolls below it, and is waited for until it lies still.
        for tenths in 0..10 {
            assert!(!lying.is_due(later(tenths), (at(930.0 + 10.0 * tenths as f32), panel), false), "{tenths}");
        }
        assert!(!lying.is_due(later(12), (at(1020.0), panel), false));
        assert!(lying.is_due(later(13), (at(1021.0), panel), false), "it lies there for four tenths of a second");
        // The view did what it could, and what rolls on below the panel moves it no more.
        assert!((14..40).all(|tenths| !lying.is_due(later(tenths), (at(1020.0 + tenths as f32), panel), false)));
        assert!(!lying.is_due(later(40), (at(500.0), panel), false));
        assert!(lying.is_due(later(41), (at(1020.0), panel), true), "it was moved there while all stands");
        assert!(!lying.is_due(later(42), (at(1020.0), panel), true));
        assert!(!lying.is_due(later(43), (None, panel), true) && !lying.is_due(later(43), (at(1020.0), None), true));
    }

    #[test]
    fn another_window_is_fitted_to_and_bars_that_go_move_nothing() {
        let usual = with(Tool::Hand, false);
        let mut framed = Framed::default();
        framed.turn((SIZE, usual), (true, true));
        framed.hold();
        assert_eq!(framed.turn((SIZE, usual), (true, true)), Turn::Keep, "the bar below is hidden");
        assert_eq!(framed.turn(([1920, 1080], usual), (true, true)), Turn::Fit);
        assert_eq!(framed.turn(([1920, 1080], usual), (true, false)), Turn::Fit, "panels find their sizes there");
    }
}
