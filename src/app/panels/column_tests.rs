//! A lesson, its plots and what is selected beside the world of each of its steps: they leave it most of the width, and nothing of it lies below them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use egui::{Pos2, Rect, Shape, pos2};
use glam::DVec3;

use super::lessons::At;
use super::{Facts, Laid, Neighbor, PanelState, TOOLS, places, show, theme};
use crate::app::action::Tool;
use crate::app::matter::Matter;
use crate::app::opening::{self, Over};
use crate::app::plots::Plots;
use crate::lessons::{Show, Step, lessons};
use crate::render::{Overlay, Tiles, View};
use crate::scene::Scene;
use crate::scene::record::run_to;

/// The least laptop.
const SIZE: [f32; 2] = [1280.0, 720.0];
/// The world has this share of its width at least `[1]`.
const WORLD: f32 = 0.6;
/// Seconds of a scene that are looked at: what falls or swings in the plane is seen as well. In space a cloth as printed falls out of any picture.
const TIMES: [f64; 2] = [0.0, 0.5];

/// A window on a step of a lesson.
struct Window {
    context: egui::Context,
    state: PanelState,
    facts: Facts,
}

impl Window {
    fn on(at: At, step: &Step, scene: &Scene, tool: Tool) -> Self {
        let context = egui::Context::default();
        theme::apply(&context, Default::default());
        let mut state = PanelState::default();
        state.lessons.enter(at);
        state.plots = step.plot.as_ref().map(|plot| Plots::of(scene.rate(), plot));
        let matter = Arc::new(Matter { points: 30, bonds: 29, bodies: 1, mass: 3.0, ..Matter::default() });
        let matter = Some(matter).filter(|_| tool == Tool::Select);
        let mut facts = Facts { tool, matter, dimensions: scene.dimensions(), ..Facts::default() };
        if matches!(step.show, Some(Show::Strain)) {
            facts.look.overlay = Overlay::Strain;
        }
        facts.tints_distance = !scene.beside.is_empty();
        Window { context, state, facts }
    }

    /// A frame. Returns what the panels leave, and what is drawn: words, and whether all of them is seen.
    fn frame(&mut self) -> (Laid, Vec<(String, bool)>) {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, SIZE.into()));
        let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
        let mut laid = Laid::default();
        let mut output = self.context.run_ui(input, |ui| laid = show(ui, &mut self.state, &self.facts).1);
        output.textures_delta.clear();
        let words = output.shapes.into_iter().filter_map(|clipped| match clipped.shape {
            Shape::Text(text) => {
                let is_seen = clipped.clip_rect.contains_rect(text.visual_bounding_rect());
                Some((text.galley.text().to_owned(), is_seen))
            }
            _ => None,
        });
        (laid, words.collect())
    }

    /// The worlds that stand side by side, as the panels know them.
    fn stand(&mut self, scene: &Scene, tiles: &Tiles, area: [u32; 2]) {
        let of = |place: usize| {
            let [left, top, width, _] = tiles.clip(place, area).map(|side| side as f32);
            let inset = if place.is_multiple_of(tiles.columns()) { TOOLS } else { 0.0 };
            let title = if place == 0 { "this scene: as printed".to_owned() } else { "the same, solved".to_owned() };
            let words = if place == 0 { String::new() } else { "up to 0.594 m apart, at rest".to_owned() };
            let color = None;
            Neighbor { title, words, at: [left + inset, top], width: width - inset, columns: tiles.columns(), color }
        };
        let count = if scene.beside.is_empty() { 0 } else { 1 + scene.beside.len() };
        self.facts.neighbors = (0..count).map(of).collect();
    }
}

/// What is wrong with a step, seen with a tool.
fn wrong(at: At, step: &Step, scene: &Scene, tool: Tool) -> Vec<String> {
    let mut window = Window::on(at, step, scene, tool);
    let mut world = scene.world(None).unwrap();
    let (mut area, mut free, mut corner) = ([SIZE[0] as u32, SIZE[1] as u32], [[0.0; 2], [100.0; 2]], None);
    let mut tiles = Tiles::ALONE;
    let mut laid = Laid::default();
    let mut words = Vec::new();
    for _ in 0..16 {
        window.stand(scene, &tiles, area);
        (laid, words) = window.frame();
        area = laid.size.map(|side| side as u32);
        let rect = laid.free.unwrap();
        free = [rect.min, rect.max].map(|at| [at.x, at.y].map(f64::from));
        corner = laid.corner.filter(|_| tiles.count() == 1).map(|at| [at.x, at.y].map(f64::from));
        tiles = opening::shared(scene, &View::of(&*world), 1 + scene.beside.len(), (area, free, laid.titles.into()));
    }
    let pane = tiles.pane(area);
    let free_here = opening::free_of_pane(pane, (area, free));
    let own = opening::opened(scene, &View::of(&*world), pane, (free_here, Over { corner, ..Over::default() }));
    let whole = tiles.whole(&own, area);
    let mut wrong = Vec::new();
    let width = if tiles.count() > 1 { laid.size[0] - TOOLS } else { laid.free.unwrap().width() };
    if width < WORLD * SIZE[0] {
        wrong.push(format!("the world has {width} points of the width"));
    }
    let taken = places::covered(&window.context, 1.0);
    let taken: Vec<Rect> = taken.into_iter().map(|[a, b, c, d]| Rect::from_min_max(pos2(a, b), pos2(c, d))).collect();
    for time in TIMES.into_iter().take(if scene.dimensions() == 2 { 2 } else { 1 }) {
        run_to(&mut *world, time, &mut |_| ()).unwrap();
        let view = View::of(&*world);
        for place in 0..tiles.count() {
            let camera = tiles.camera(place, &whole, area);
            let [left, top, width, height] = tiles.clip(place, area).map(f64::from);
            let x = |point: usize, axis: usize| {
                if axis < view.dimensions { view.current.get(point * view.dimensions + axis) } else { 0.0 }
            };
            for point in 0..view.current.len() / view.dimensions {
                let at = DVec3::new(x(point, 0), x(point, 1), x(point, 2));
                let Some([x, y]) = camera.screen_from_world(at) else { continue };
                let is_inside = (left..left + width).contains(&x) && (top..top + height).contains(&y);
                let below = taken.iter().find(|rect| rect.contains(pos2(x as f32, y as f32)));
                if !is_inside || below.is_some() {
                    wrong
                        .push(format!("world {place}: point {point} at {time} s is seen at {x:.0}, {y:.0}: {below:?}"));
                    break;
                }
            }
        }
    }
    let own = [&step.text, &step.to_try, &step.seen].into_iter().chain(step.claims.iter().map(|claim| &claim.words));
    for text in own {
        if !words.iter().any(|(word, is_seen)| word == text && *is_seen) {
            wrong.push(format!("`{text}` is not seen"));
        }
    }
    if step.plot.is_some() && !words.iter().any(|(word, is_seen)| word == "SVG" && *is_seen) {
        wrong.push("the plots are not seen".to_owned());
    }
    wrong
}

#[test]
fn a_lesson_leaves_most_of_the_width_to_the_world_and_lies_over_nothing_of_it() {
    let mut all = Vec::new();
    for (place, lesson) in lessons().iter().enumerate() {
        for (number, step) in lesson.steps.iter().enumerate() {
            let scene = lesson.scene(number).unwrap().unwrap();
            for tool in [Tool::Hand, Tool::Select].into_iter().take(if number == 0 { 2 } else { 1 }) {
                let wrong = wrong(At { lesson: place, step: number }, step, &scene, tool);
                let name = format!("{}, step {}, {tool:?}", lesson.title, number + 1);
                all.extend(wrong.into_iter().map(|what| format!("{name}: {what}")));
            }
        }
    }
    assert!(all.is_empty(), "{} are wrong:\n{}", all.len(), all.join("\n"));
}
