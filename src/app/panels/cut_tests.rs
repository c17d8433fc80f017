//! No text of panels is cut off at its side, in windows of several sizes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use egui::{Pos2, Rect, Shape};

use super::{Facts, PanelState, Pushing, Settings, Sheet, parameters, show, theme};
use crate::app::action::Tool;
use crate::app::matter::Among;
use crate::app::player::{Order, Shown, Stage};
use crate::app::plots::Plots;
use crate::render::Overlay;
use crate::scene::{PrecisionName, gallery};
use crate::sim::PointId;

/// The last two are the first two where a point has two pixels, on a screen of twice the size and of that size.
const SIZES: [[f32; 2]; 4] = [[1280.0, 720.0], [720.0, 1280.0], [1920.0, 1080.0], [640.0, 360.0]];

/// Scenes with what the panels have to show of them, and whether all of it is selected.
const SCENES: [(&str, bool); 2] = [("jelly", false), ("soft-car", true)];

/// A text of the keys has no more lines than are so high `[points]`.
const MOST_HIGH: f32 = 70.0;

/// What is written, where, and how much of it can be seen; and whether it ends in dots.
fn written(shape: &Shape, clip: Rect, to: &mut Vec<(String, Rect, Rect, bool)>) {
    match shape {
        Shape::Text(text) if !text.galley.text().trim().is_empty() => {
            to.push((text.galley.text().to_owned(), text.visual_bounding_rect(), clip, text.galley.elided));
        }
        Shape::Vec(all) => all.iter().for_each(|shape| written(shape, clip, to)),
        _ => {}
    }
}

/// What a scene of the gallery has to show, with all of its points selected or none.
fn facts(name: &str, tool: Tool, is_selected: bool) -> Facts {
    let entry = gallery().iter().find(|entry| entry.name == name).unwrap();
    let scene = entry.scene().unwrap();
    let mut stage = Stage::new(scene.clone().into()).unwrap();
    if is_selected {
        let points = (0..stage.history().world().point_count() as u32).map(PointId).collect();
        stage.obey(Order::Inspect(Among { points, ..Among::default() }));
    }
    let mut shown = Shown::default();
    stage.show(&mut shown);
    let push = stage.history().world().mouse_force().map(|force| [force.strength, force.radius]);
    let settings = Settings {
        parameters: parameters(&scene.named_parameters(), &shown, push),
        scene: shown.settings.clone(),
        clock: Some(shown.figures.clock),
        fixed: Some((scene.method.precision.unwrap_or(PrecisionName::Auto), scene.method.tolerance)),
        pushing: stage.history().world().mouse_force().map(Pushing::of),
        push,
        ..Settings::default()
    };
    Facts {
        title: entry.title.to_owned(),
        caption: Some([entry.description, entry.to_try]),
        figures: shown.figures.clone(),
        tool,
        matter: shown.matter.clone(),
        dimensions: scene.dimensions(),
        settings,
        seen: [[-3.0, -2.0], [3.0, 2.0]],
        new_walls: [[-3.0, -2.0, 0.0], [3.0, 2.0, 0.0]],
        ..Facts::default()
    }
}

#[test]
fn no_text_is_cut_off_at_its_side() {
    let mut wrong = Vec::new();
    let tools = [Tool::Hand, Tool::Build, Tool::Select, Tool::Muscle, Tool::Motor, Tool::Paint, Tool::Push];
    let cases = tools.into_iter().map(|tool| (tool, None));
    let sheets = [Sheet::Gallery, Sheet::Help, Sheet::SaveTo, Sheet::OpenFrom];
    let cases: Vec<_> = cases.chain(sheets.map(|sheet| (Tool::Hand, Some(sheet)))).collect();
    for (tool, sheet) in cases {
        // A sheet has the window for itself.
        let (scenes, opened) = if sheet.is_some() { (&SCENES[..1], 1) } else { (&SCENES[..], 3) };
        for &(scene, is_selected) in scenes {
            let mut facts = facts(scene, tool, is_selected);
            for (size, open) in SIZES.into_iter().flat_map(|size| (0..opened).map(move |open| (size, open))) {
                let mut state = PanelState { sheet, has_settings: open == 0, ..PanelState::default() };
                state.lessons.is_open = open == 1;
                state.plots = (open == 2).then(|| Plots::new(1.0));
                state.notes.has_caption = true;
                facts.look.overlay = if open == 2 { Overlay::Strain } else { Overlay::None };
                let context = egui::Context::default();
                theme::apply(&context, Default::default());
                let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, size.into()));
                let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
                let mut shapes = Vec::new();
                for _ in 0..5 {
                    let mut output = context.run_ui(input.clone(), |ui| _ = show(ui, &mut state, &facts));
                    output.textures_delta.clear();
                    shapes = output.shapes;
                }
                let mut all = Vec::new();
                shapes.iter().for_each(|clipped| written(&clipped.shape, clipped.clip_rect, &mut all));
                assert!(all.len() > 3, "{size:?} {tool:?} {sheet:?}");
                let screen = Rect::from_min_size(Pos2::ZERO, size.into());
                for (text, at, clip, is_elided) in all {
                    // What is scrolled may be out of view above and below; what is open is told by its button when the pointer rests on it.
                    let is_seen = at.top() < clip.bottom() && at.bottom() > clip.top();
                    let room = clip.intersect(screen);
                    let is_whole = at.left() >= room.left() - 1.0 && at.right() <= room.right() + 1.0;
                    let is_title = text.starts_with(facts.title.get(..3).unwrap_or_default());
                    // A column that is much too narrow has a word a line.
                    let is_whole = is_whole && (sheet != Some(Sheet::Help) || at.height() < MOST_HIGH);
                    if is_seen && (!is_whole || is_elided && !is_title) {
                        wrong.push(format!("{scene} {size:?} {tool:?} {sheet:?} {open}: {text:?} at {at} in {room}"));
                    }
                }
            }
        }
    }
    wrong.sort();
    assert!(wrong.is_empty(), "{} are cut off:\n{}", wrong.len(), wrong.join("\n"));
}
