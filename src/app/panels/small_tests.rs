//! Panels in windows of all sizes, at both scales of the display: none lies over another nor out of the window, the one that was opened last
//! is seen, and what is left is wide enough to play in.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use egui::{Id, Pos2, Rect, ViewportId, pos2};

use super::{At, Facts, Laid, Neighbor, Opened, PanelState, Room, Sheet, palette, places, show, theme};
use crate::app::action::{Primitive, Tool};
use crate::app::matter::Matter;
use crate::render::Overlay;
use crate::sim::Key;

/// The smallest window, small ones, those of a small laptop, at 200 % too, in points, and of one that stands upright.
const SIZES: [[f32; 2]; 6] =
    [[480.0, 360.0], [600.0, 450.0], [640.0, 360.0], [800.0, 600.0], [1280.0, 720.0], [720.0, 1280.0]];
/// What a panel leaves in the smallest windows at least `[points]`.
const LEAST: [f32; 2] = [90.0, 60.0];

/// Panels find their sizes in so many frames.
const FRAMES: usize = 6;

/// What is opened last, with the areas that it may have.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Last {
    Panel(Opened, [&'static str; 3]),
    Tool(Tool, &'static str),
}

const LAST: [Last; 9] = [
    Last::Panel(Opened::Settings, ["settings"; 3]),
    Last::Panel(Opened::Lessons, ["lessons"; 3]),
    Last::Panel(Opened::Plots, ["plots", "plots below", "plots above"]),
    Last::Tool(Tool::Build, "primitives"),
    Last::Tool(Tool::Select, "matter"),
    Last::Tool(Tool::Muscle, "drives"),
    Last::Tool(Tool::Motor, "drives"),
    Last::Tool(Tool::Paint, "brush"),
    Last::Tool(Tool::Push, "push"),
];

/// A window of a size, at a scale.
struct Window {
    context: egui::Context,
    size: [f32; 2],
    scale: f32,
    state: PanelState,
    facts: Facts,
}

impl Window {
    fn new(size: [f32; 2], scale: f32) -> Self {
        let context = egui::Context::default();
        theme::apply(&context, Default::default());
        let facts = Facts {
            dimensions: 2,
            title: "a scene".to_owned(),
            has_picture: true,
            caption: Some(["A block of jelly, cut out of a picture, falls into a box.", "throw it; press V"]),
            ..Facts::default()
        };
        let mut window = Window { context, size, scale, state: PanelState::default(), facts };
        window.state.notes.has_caption = true;
        window.frames();
        window
    }

    /// Frames in which panels find their sizes and fade in. Returns what is left.
    fn frames(&mut self) -> Laid {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, self.size.into()));
        let mut laid = Laid::default();
        for _ in 0..FRAMES {
            let mut input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
            let viewport = input.viewports.entry(ViewportId::ROOT).or_default();
            viewport.native_pixels_per_point = Some(self.scale);
            let mut output = self.context.run_ui(input, |ui| laid = show(ui, &mut self.state, &self.facts).1);
            output.textures_delta.clear();
        }
        laid
    }

    fn open(&mut self, last: Last) {
        match last {
            Last::Panel(Opened::Settings, _) => self.state.toggle_settings(),
            Last::Panel(Opened::Lessons, _) => self.state.toggle_lessons(),
            Last::Panel(..) => self.state.toggle_plots(1.0),
            Last::Tool(tool, _) => {
                self.facts.tool = tool;
                self.facts.matter = (tool == Tool::Select).then(|| Arc::new(matter()));
                self.state.take(tool);
            }
        }
        self.frames();
    }

    /// What floats.
    fn rects(&self) -> Vec<Rect> {
        let all = places::covered(&self.context, 1.0);
        all.into_iter().map(|[a, b, c, d]| Rect::from_min_max(pos2(a, b), pos2(c, d)).shrink(1.0)).collect()
    }

    fn has(&self, area: &str) -> bool {
        let layer = egui::LayerId::new(egui::Order::Middle, Id::unique(area));
        self.context.memory(|memory| memory.areas().is_visible(&layer))
    }

    /// What lies over something else or out of the window, said of a case.
    fn faults(&self, case: &str) -> Vec<String> {
        let window = Rect::from_min_size(Pos2::ZERO, self.size.into());
        let (all, mut wrong) = (self.rects(), Vec::new());
        for (place, one) in all.iter().enumerate() {
            let other = all[..place].iter().find(|other| other.intersects(*one));
            wrong.extend(other.map(|other| format!("{case}: {one:?} lies over {other:?}")));
            wrong.extend((!window.contains_rect(*one)).then(|| format!("{case}: {one:?} is not all in {window:?}")));
        }
        wrong
    }
}

/// All that the panel can have.
fn matter() -> Matter {
    let span = Some(crate::app::matter::Span { least: 1.0, most: 2.0 });
    Matter {
        points: 84,
        bonds: 230,
        bodies: 1,
        name: Some("jelly".to_owned()),
        mass: 3.0,
        area: 1.0,
        stiffness: span,
        damping: span,
        friction: span,
        restitution: span,
        joints: [1, 2],
        stops: span.map(|span| [span; 2]),
        ..Matter::default()
    }
}

fn keys() -> Vec<(Key, bool)> {
    ["left", "right"].into_iter().filter_map(|name| Some((Key::of(name)?, false))).collect()
}

#[test]
fn no_panel_lies_over_another_in_a_window_of_any_size() {
    let mut wrong = Vec::new();
    for size in SIZES {
        for (scale, more) in [(1.0, false), (1.0, true), (2.0, true)] {
            let mut window = Window::new(size, scale);
            if more {
                window.facts.keys = keys();
                window.facts.look.overlay = Overlay::Strain;
                window.facts.primitive = Primitive::Bonds;
                window.state.notes.warn("a body lay inside an obstacle: it is led out of it slowly".to_owned());
            }
            // Each with those before it open, and from the second round on with all others.
            for (round, last) in LAST.into_iter().chain(LAST.into_iter().rev()).enumerate() {
                let is_open = matches!(last, Last::Panel(panel, _) if window.state.is_seen(panel));
                if !is_open {
                    window.open(last);
                }
                let case = format!("{size:?} at {scale}, more {more}, round {round}, {last:?}");
                wrong.extend(window.faults(&case));
                let is_seen = match last {
                    Last::Panel(_, areas) => areas.into_iter().any(|area| window.has(area)),
                    Last::Tool(_, area) => window.has(area),
                };
                wrong.extend((!is_seen).then(|| format!("{case}: it is not seen")));
                let free = window.frames().free.unwrap();
                let is_wide = free.width() >= LEAST[0] && free.height() >= LEAST[1];
                wrong.extend((!is_wide).then(|| format!("{case}: {free:?} is little")));
            }
        }
    }
    assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong[..wrong.len().min(60)].join("\n"));
}

#[test]
fn in_a_small_window_one_panel_is_seen_at_a_time() {
    for size in [SIZES[0], SIZES[1], SIZES[3]] {
        let mut window = Window::new(size, 1.0);
        LAST.into_iter().for_each(|last| window.open(last));
        assert_eq!(window.state.room, Room::One, "{size:?}");
        let names =
            ["settings", "lessons", "plots", "plots below", "plots above", "primitives", "matter", "drives", "brush"];
        let seen: Vec<&str> = names.into_iter().chain(["push"]).filter(|name| window.has(name)).collect();
        assert_eq!(seen, ["push"], "{size:?}");
        // What was opened before is there again when the tool goes.
        window.facts.tool = Tool::Hand;
        window.state.take(Tool::Hand);
        window.frames();
        let seen: Vec<&str> = names.into_iter().filter(|name| window.has(name)).collect();
        assert!(seen.len() == 1 && seen[0].starts_with("plots"), "{size:?}: {seen:?}");
    }
    let mut wide = Window::new(SIZES[4], 1.0);
    LAST.into_iter().take(3).for_each(|last| wide.open(last));
    assert!(wide.has("settings") && wide.has("lessons"), "there is room for all of them");
}

#[test]
fn plots_leave_its_height_to_what_is_selected() {
    for size in [SIZES[4], [1024.0, 600.0], [1920.0, 1080.0]] {
        let height = |has_plots: bool| {
            let mut window = Window::new(size, 1.0);
            if has_plots {
                // Over all of the room but its right edge: that is where they open.
                let at = |k: u16| pos2(100.0 + 6.0 * f32::from(k % 100), 120.0 + 60.0 * f32::from(k / 100));
                window.facts.points = (0..900).map(at).filter(|at| at.x < size[0] - 380.0).collect();
                window.open(LAST[2]);
            }
            window.open(LAST[4]);
            assert!(!has_plots || window.has("plots"), "{size:?}");
            assert_eq!(window.faults(&format!("{size:?}")), [""; 0]);
            window.context.memory(|memory| memory.area_rect(Id::unique("matter"))).unwrap().height()
        };
        let (alone, beside) = (height(false), height(true));
        assert!(beside >= alone - 1.0 && alone > 300.0, "{size:?}: {beside} of {alone}");
    }
}

#[test]
fn worlds_side_by_side_and_lessons_lie_below_no_panel_of_a_small_window() {
    let world = |at: f32| Neighbor {
        title: "a world".to_owned(),
        at: [at, 0.0],
        width: 180.0,
        columns: 2,
        ..Neighbor::default()
    };
    for size in &SIZES[..4] {
        for last in &LAST[..3] {
            let mut window = Window::new(*size, 1.0);
            window.facts.neighbors = vec![world(66.0), world(260.0)];
            window.facts.caption = None;
            window.open(*last);
            let laid = window.frames();
            let worlds = Rect::from_min_size(Pos2::ZERO, laid.size.into());
            let Last::Panel(_, areas) = last else { continue };
            let id = areas.iter().find(|area| window.has(area)).map(|area| Id::unique(*area)).unwrap();
            let panel = window.context.memory(|memory| memory.area_rect(id)).unwrap();
            assert!(!worlds.intersects(panel.shrink(1.0)), "{size:?}, {last:?}: {panel:?} over {worlds:?}");
        }
        // A step with its plot: the words come first, and the plot by its button.
        let mut window = Window::new(*size, 1.0);
        window.state.lessons.enter(At { lesson: 0, step: 0 });
        window.open(LAST[2]);
        window.state.bring(Opened::Lessons);
        window.frames();
        assert!(window.has("lessons") && window.faults(&format!("{size:?}")).is_empty(), "{size:?}");
    }
}

#[test]
fn titles_of_a_comparison_lie_beside_or_below_each_other_in_small_windows() {
    // Two in a row of a narrow part, and two above each other below a caption of three lines.
    for (columns, places) in [(2, [[66.0, 0.0], [160.0, 0.0]]), (1, [[66.0, 0.0], [66.0, 110.0]])] {
        for size in &SIZES[..4] {
            let mut window = Window::new(*size, 1.0);
            let world = |at: [f32; 2]| Neighbor {
                title: "semi-implicit Euler".to_owned(),
                words: "up to 3.4 cm apart".to_owned(),
                at,
                width: 94.0,
                columns,
                ..Neighbor::default()
            };
            window.facts.neighbors = places.map(world).to_vec();
            window.open(LAST[1]);
            let rect = |place: usize| window.context.memory(|memory| memory.area_rect(Id::unique(("beside", place))));
            let [first, second] = [0, 1].map(|place| rect(place).unwrap());
            assert!(!first.intersects(second), "{size:?}: {first:?} on {second:?}");
        }
    }
}

#[test]
fn sheets_are_whole_in_a_window_of_any_size() {
    for size in SIZES {
        for (sheet, area) in [
            (Sheet::Gallery, "gallery"),
            (Sheet::Help, "keys"),
            (Sheet::SaveTo, "save to"),
            (Sheet::OpenFrom, "open from"),
        ] {
            let mut window = Window::new(size, 1.0);
            window.state.sheet = Some(sheet);
            window.frames();
            let rect = window.context.memory(|memory| memory.area_rect(Id::unique(area))).unwrap();
            let all = Rect::from_min_size(Pos2::ZERO, size.into());
            assert!(all.contains_rect(rect), "{sheet:?} in {size:?}: {rect:?}");
        }
    }
}

#[test]
fn every_tool_with_a_panel_is_tried() {
    let tried = |tool: &Tool| LAST.iter().any(|last| matches!(last, Last::Tool(other, _) if other == tool));
    assert!(Tool::ALL.iter().all(|tool| palette::has_panel(*tool) == tried(tool)));
}
