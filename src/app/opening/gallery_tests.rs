//! The gallery as it opens in windows of several sizes, beside panels and figures: all of it is in view, and large enough to be looked at.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use egui::{Pos2, Rect, ViewportId};
use glam::{DVec2, DVec3};

use super::{Free, Over, followed, free_of_pane, opened_in, shared};
use crate::app::action::Tool;
use crate::app::framing::{Framed, Left, Open, Turn};
use crate::app::panels::{self, Facts, Laid, Neighbor, PanelState, TOOLS, theme};
use crate::app::thumbnails::coarser;
use crate::render::{Camera, Pose, Tiles, View};
use crate::scene::{Entry, Scene, gallery};
use crate::sim::{BondKind, Dynamics};

/// Sizes of a window `[px]`, each with so many pixels a point: it gets one after the other, and the first one again.
const WINDOWS: [([u32; 2], f32); 5] =
    [([1280, 720], 1.0), ([720, 1280], 1.0), ([3840, 2160], 1.0), ([3840, 2160], 2.0), ([1280, 720], 1.0)];
/// Panels find their sizes in so many frames.
const FRAMES: usize = 12;
/// What is seen takes this share of the free part's width or height at least `[1]`.
const LEAST: f64 = 1.0 / 3.0;
/// What is open: the figures.
const OPEN: Open = Open { tool: Tool::Hand, panels: [false, false, false, true, false, false, false] };

/// What holds of a scene as it opens.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rule {
    /// All points lie in the part of the picture that panels leave free, and not below the figures.
    Points,
    /// So do all solid obstacles that end somewhere.
    Obstacles,
    /// All walls are in the picture.
    Walls,
    /// All of that fills a third of the free part's width or height.
    Size,
}

/// Where a rule does not hold, and why.
const EXCEPT: [(&str, Rule, &str); 5] = [
    (
        "random-graph-as-printed",
        Rule::Walls,
        "its room is five times as wide as what moves in it: the view says a width",
    ),
    ("penalty", Rule::Walls, "the floor lies 2 m below the soft ground, where nothing comes"),
    ("penalty", Rule::Obstacles, "the step goes down to that floor"),
    ("slide-circle", Rule::Size, "there is room for the spiral, which gets four times as wide"),
    ("cloth-space-as-printed", Rule::Size, "there is room for the drop, from above the bar to as far below it"),
];

/// A scene in a window, beside its panels.
struct Opened {
    entry: &'static Entry,
    scene: Scene,
    world: Box<dyn Dynamics>,
    context: egui::Context,
    state: PanelState,
    facts: Facts,
    framed: Framed,
    area: [u32; 2],
    free: Free,
    over: Over,
    titles: f64,
    tiles: Tiles,
    /// That of the world alone, in the first of the panes.
    camera: Camera,
}

impl Opened {
    fn new(entry: &'static Entry) -> Self {
        let scene = coarser(entry.scene().unwrap());
        let world = scene.world(None).unwrap();
        let context = egui::Context::default();
        theme::apply(&context, Default::default());
        let facts = Facts {
            title: entry.title.to_owned(),
            caption: Some([entry.description, entry.to_try]),
            dimensions: scene.dimensions(),
            stretch: world.bonds().iter().any(|bond| bond.kind == BondKind::Rigid).then_some(0.0),
            keys: world.drive_keys().into_iter().map(|key| (key, false)).collect(),
            ..Facts::default()
        };
        let mut state = PanelState::default();
        state.notes.has_caption = true;
        Opened {
            entry,
            scene,
            world,
            context,
            state,
            facts,
            framed: Framed::default(),
            area: [1; 2],
            free: [[0.0; 2]; 2],
            over: Over::default(),
            titles: 0.0,
            tiles: Tiles::ALONE,
            camera: Camera::new(Pose::Plane { center: DVec2::ZERO, height: 1.0 }, [1; 2]),
        }
    }

    /// The window has another size: panels are shown until they have theirs.
    fn resize(&mut self, window: [u32; 2], scale: f32) {
        assert_eq!(self.frame(window, scale), Turn::Fit, "{} in {window:?}", self.entry.name);
        for _ in 1..FRAMES {
            assert_ne!(self.frame(window, scale), Turn::Keep, "{} in {window:?}", self.entry.name);
        }
    }

    /// A frame: panels are shown, and the view is fitted to what they leave, as that of the window is.
    fn frame(&mut self, window: [u32; 2], scale: f32) -> Turn {
        let size = window.map(|side| side as f32 / scale);
        let facts = Facts { neighbors: self.neighbors(scale), ..self.facts.clone() };
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, size.into()));
        let mut input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
        input.viewports.entry(ViewportId::ROOT).or_default().native_pixels_per_point = Some(scale);
        let mut laid = Laid::default();
        let mut output = self.context.run_ui(input, |ui| laid = panels::show(ui, &mut self.state, &facts).1);
        output.textures_delta.clear();
        let Left { area, free, over, titles } = Left::of(&laid, scale, window);
        let free = free.unwrap();
        let is_other = free != self.free || over.is_wider_than(&self.over);
        let is_resized = area != self.area;
        (self.area, self.free, self.over, self.titles) = (area, free, over, titles);
        let turn = self.framed.turn((window, OPEN), (is_other, is_resized));
        if turn == Turn::Fit {
            self.fit();
        }
        turn
    }

    fn fit(&mut self) {
        let (view, count) = (View::of(&*self.world), 1 + self.scene.beside.len());
        self.tiles = shared(&self.scene, &view, count, (self.area, self.free, self.titles));
        self.camera = opened_in(&self.scene, &view, &self.tiles, (self.area, self.free, self.over));
    }

    /// What is said above each of several worlds.
    fn neighbors(&self, scale: f32) -> Vec<Neighbor> {
        let (count, columns) = (self.tiles.count(), self.tiles.columns());
        let of = |place: usize| {
            let [left, top, width, _] = self.tiles.clip(place, self.area).map(|pixels| pixels as f32 / scale);
            let inset = if place.is_multiple_of(columns) { TOOLS } else { 0.0 };
            Neighbor {
                title: "this scene: as it is printed".to_owned(),
                words: "up to 1.50 m apart".to_owned(),
                at: [left + inset, top],
                width: width - inset,
                color: None,
                columns,
            }
        };
        if count > 1 { (0..count).map(of).collect() } else { Vec::new() }
    }

    /// What of the rules does not hold.
    fn faults(&self) -> Vec<String> {
        let view = View::of(&*self.world);
        let pane = self.tiles.pane(self.area);
        let (free, whole) = (free_of_pane(pane, (self.area, self.free)), [[0.0; 2], pane.map(f64::from)]);
        // In space the way back is found in a few rounds, and as exactly as these lead.
        let slack = 1.0 + 1e-3 * f64::from(pane[0].max(pane[1]));
        let at = |place: &[f64; 3]| self.camera.screen_from_world(DVec3::from(*place)).unwrap_or([f64::NAN; 2]);
        let seen = |places: Vec<[f64; 3]>| places.iter().map(at).collect::<Vec<[f64; 2]>>();
        let (points, obstacles, walls) = (seen(places(&view)), seen(corners(&view)), seen(walls(&view)));
        let outside = |places: &[[f64; 2]], [low, high]: Free| {
            let is_in = |at: &[f64; 2], axis: usize| (low[axis] - slack..=high[axis] + slack).contains(&at[axis]);
            places.iter().find(|at| !(is_in(at, 0) && is_in(at, 1))).copied()
        };
        let mut wrong: Vec<(Rule, [f64; 2])> = Vec::new();
        wrong.extend(outside(&points, free).map(|at| (Rule::Points, at)));
        // A view that goes along with what moves shows no end of what stands about it.
        if followed(&self.scene, &view, pane).points.is_empty() {
            wrong.extend(outside(&obstacles, free).map(|at| (Rule::Obstacles, at)));
            wrong.extend(outside(&walls, whole).map(|at| (Rule::Walls, at)));
        }
        let is_for_one = |corner: &[f64; 2]| self.tiles.count() == 1 && corner[1] < 0.5 * (free[0][1] + free[1][1]);
        if let Some([left, below]) = self.over.corner.filter(is_for_one) {
            let hidden = points.iter().find(|at| at[0] > left + slack && at[1] < below - slack);
            wrong.extend(hidden.map(|at| (Rule::Points, *at)));
        }
        let share = |axis: usize| {
            // What ends beyond the free part is seen up to its end.
            let bodies = points.iter().chain(&obstacles).map(|at| at[axis].clamp(free[0][axis], free[1][axis]));
            let sides = walls.iter().map(|at| at[axis]).filter(|x| (0.0..=whole[1][axis]).contains(x));
            let [low, high] = bodies
                .chain(sides)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
            (high - low) / (free[1][axis] - free[0][axis])
        };
        let shares = [share(0), share(1)];
        wrong.extend(shares.iter().all(|share| *share < LEAST).then_some((Rule::Size, shares)));
        let is_held = |(rule, _): &(Rule, [f64; 2])| {
            !EXCEPT.iter().any(|(name, other, _)| *name == self.entry.name && other == rule)
        };
        let words = |(rule, at): (Rule, [f64; 2])| format!("{rule:?}: {at:?}, where {free:?} of {pane:?} px is free");
        wrong.into_iter().filter(is_held).map(words).collect()
    }
}

/// All points `[m]`.
fn places(view: &View<'_>) -> Vec<[f64; 3]> {
    let (x, dimensions) = (view.current, view.dimensions);
    let place = |first: usize| std::array::from_fn(|axis| if axis < dimensions { x.get(first + axis) } else { 0.0 });
    (0..x.len()).step_by(dimensions).map(place).collect()
}

/// The corners of obstacles, or of the boxes about them `[m]`: planes have none.
fn corners(view: &View<'_>) -> Vec<[f64; 3]> {
    let polygons = view.polygons.iter().flat_map(|polygon| &polygon.loops).flatten().map(|[x, y]| [*x, *y, 0.0]);
    let about = view.convex.iter().flat_map(|convex| {
        let ends = convex.figure.extent();
        (0..8_usize).map(move |corner| [0, 1, 2].map(|axis| ends[(corner >> axis) & 1][axis]))
    });
    polygons.chain(about).collect()
}

/// The lower and the upper corner of the walls `[m]`.
fn walls(view: &View<'_>) -> Vec<[f64; 3]> {
    view.bounds.map_or_else(Vec::new, |corners| corners.to_vec())
}

#[test]
fn every_scene_of_the_gallery_opens_whole_and_large_in_windows_of_all_sizes() {
    assert!(EXCEPT.iter().all(|(name, ..)| gallery().iter().any(|entry| entry.name == *name)));
    let mut wrong = Vec::new();
    for entry in gallery() {
        let mut opened = Opened::new(entry);
        for (window, scale) in WINDOWS {
            opened.resize(window, scale);
            let faults = opened.faults().into_iter();
            wrong.extend(faults.map(|fault| format!("{} in {window:?} at {scale}: {fault}", entry.name)));
        }
    }
    assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}
