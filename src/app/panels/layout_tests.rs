//! Panels in windows of several sizes: none lies over another, and bodies are shown where none is.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use egui::{Pos2, Rect, pos2};

use super::{At, Cover, Facts, Laid, Neighbor, PanelState, Sheet, places, show, theme};
use crate::app::action::Tool;
use crate::app::matter::Matter;
use crate::app::plots::Plots;
use crate::render::Overlay;

/// The last is that of 3840x2160 pixels where a point has two.
const SIZES: [[f32; 2]; 5] = [[1280.0, 720.0], [820.0, 600.0], [1024.0, 600.0], [720.0, 1280.0], [1920.0, 1080.0]];

/// Panels after sizes were found and they faded in, and what they leave.
fn shown(size: [f32; 2], state: &mut PanelState, facts: &Facts) -> (egui::Context, Laid) {
    let context = egui::Context::default();
    theme::apply(&context, Default::default());
    let input =
        egui::RawInput { screen_rect: Some(Rect::from_min_size(Pos2::ZERO, size.into())), ..egui::RawInput::default() };
    let mut left = Laid::default();
    for _ in 0..12 {
        let mut output = context.run_ui(input.clone(), |ui| left = show(ui, state, facts).1);
        output.textures_delta.clear();
    }
    (context, left)
}

/// What floats, and what is left for bodies.
fn laid(size: [f32; 2], state: &mut PanelState, facts: &Facts) -> (Vec<Rect>, Laid) {
    let (context, left) = shown(size, state, facts);
    let all = places::covered(&context, 1.0);
    (all.into_iter().map(|[a, b, c, d]| Rect::from_min_max(pos2(a, b), pos2(c, d)).shrink(1.0)).collect(), left)
}

fn facts(tool: Tool) -> Facts {
    let points = vec![pos2(600.0, 400.0)];
    let caption = Some([
        "A block of jelly, cut out of a picture, falls into a box.",
        "throw it; press V to see where it strains",
    ]);
    Facts { tool, dimensions: 2, caption, points, ..Facts::default() }
}

/// A body that is selected.
fn matter() -> Arc<Matter> {
    Arc::new(Matter {
        points: 84,
        bonds: 230,
        bodies: 1,
        name: Some("jelly".to_owned()),
        mass: 3.0,
        ..Matter::default()
    })
}

#[test]
fn no_panel_lies_over_another_and_bodies_are_shown_beside_them() {
    let mut wrong = Vec::new();
    for size in SIZES {
        for open in 0..32 {
            let [settings, lessons, plots, strain, said] = [1, 2, 4, 8, 16].map(|bit| open & bit > 0);
            for tool in [Tool::Hand, Tool::Build, Tool::Select, Tool::Muscle, Tool::Paint, Tool::Push] {
                let mut state = PanelState { has_settings: settings, ..PanelState::default() };
                state.lessons.is_open = lessons;
                state.plots = plots.then(|| Plots::new(1.0));
                state.notes.has_caption = said;
                if said {
                    state.notes.warn("a body lay inside an obstacle: it is led out of it slowly".to_owned());
                }
                let matter = Some(matter()).filter(|_| tool == Tool::Select);
                let mut facts = Facts { matter, ..facts(tool) };
                if strain {
                    facts.look.overlay = Overlay::Strain;
                }
                let (all, laid) = laid(size, &mut state, &facts);
                let case = format!(
                    "{size:?}, settings {settings}, lessons {lessons}, plots {plots}, strain {strain}, said {said}, {tool:?}"
                );
                assert!(all.len() >= 3, "{case}: {all:?}");
                for (place, one) in all.iter().enumerate() {
                    let other = all[..place].iter().find(|other| other.intersects(*one));
                    wrong.extend(other.map(|other| format!("{case}: {one:?} lies over {other:?}")));
                }
                let free = laid.free.unwrap();
                // In the smallest window all that can be open leaves little, and what belongs to a tool less.
                let share = match (size[0] < 900.0 && size[1] < size[0], tool) {
                    (false, _) => 0.12,
                    (true, Tool::Hand) => 0.1,
                    (true, _) => 0.05,
                };
                let least = share * size[0] * size[1];
                wrong.extend((free.area() <= least).then(|| format!("{case}: {free:?} is little")));
                // What belongs to a tool comes and goes: bodies do not move for it.
                // What lies in the upper right corner is left to the camera: it moves bodies from there alone.
                let is_corner =
                    |one: &Rect| laid.corner.is_some_and(|at| one.left() > at.x - 3.0 && one.bottom() < at.y + 3.0);
                let over = all.iter().find(|one| one.intersects(free) && !is_corner(one));
                let over = over.filter(|_| tool == Tool::Hand);
                wrong.extend(over.map(|over| format!("{case}: {over:?} lies over bodies in {free:?}")));
            }
        }
    }
    assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn the_column_of_a_tools_panel_is_where_that_stands() {
    for lessons in [false, true] {
        let mut state = PanelState::default();
        state.lessons.is_open = lessons;
        let (all, laid) = laid([1280.0, 720.0], &mut state, &facts(Tool::Select));
        let [from, to] = laid.column.unwrap();
        assert_eq!(to < 640.0, lessons, "beside the tools where lessons push it off the right edge: {from} to {to}");
        let stands = |one: &Rect| one.width() > 200.0 && one.left() > from - 3.0 && one.right() < to + 3.0;
        assert!(all.iter().any(stands), "it stands not between {from} and {to}: {all:?}");
    }
    let mut state = PanelState::default();
    assert_eq!(laid([1280.0, 720.0], &mut state, &facts(Tool::Hand)).1.column, None);
    // The others stand beside the tools, whatever opens at the right edge.
    for tool in [Tool::Motor, Tool::Muscle, Tool::Push, Tool::Paint] {
        let mut state = PanelState { has_settings: true, ..PanelState::default() };
        let (all, laid) = laid([1280.0, 720.0], &mut state, &facts(tool));
        let [from, to] = laid.column.unwrap();
        let stands = |one: &Rect| (one.left() - from).abs() < 3.0 && (one.right() - to).abs() < 3.0;
        assert!(to < 640.0 && all.iter().any(stands), "{tool:?}: it stands not from {from} to {to}: {all:?}");
    }
}

#[test]
fn in_a_small_window_what_is_selected_covers_no_button() {
    for size in [[480.0, 400.0], [480.0, 360.0], [600.0, 480.0]] {
        let facts = Facts { matter: Some(matter()), ..facts(Tool::Select) };
        let (context, _) = shown(size, &mut PanelState::default(), &facts);
        let lies = |name: &str| context.memory(|memory| memory.area_rect(egui::Id::unique(name))).unwrap();
        let (panel, bar) = (lies("matter"), lies("scene"));
        assert!(!panel.shrink(1.0).intersects(bar.shrink(1.0)), "{size:?}: {panel} over {bar}");
    }
}

#[test]
fn plots_take_room_from_worlds_side_by_side() {
    let world = |at: f32| Neighbor {
        title: "a world".to_owned(),
        at: [at, 0.0],
        width: 400.0,
        columns: 2,
        ..Neighbor::default()
    };
    for size in SIZES {
        let facts = Facts { neighbors: vec![world(66.0), world(500.0)], ..facts(Tool::Hand) };
        let alone = laid(size, &mut PanelState::default(), &facts);
        let mut state = PanelState { plots: Some(Plots::new(1.0)), ..PanelState::default() };
        let (all, with) = laid(size, &mut state, &facts);
        let plots =
            all.iter().find(|one| !alone.0.iter().any(|other| other.center().distance(one.center()) < 40.0)).unwrap();
        let worlds = Rect::from_min_size(Pos2::ZERO, with.size.into());
        assert!(!worlds.intersects(*plots), "{size:?}: {plots:?} lies over {worlds:?}");
        assert!(worlds.area() > 0.4 * size[0] * size[1] && worlds.contains_rect(with.free.unwrap().shrink(1.0)));
    }
}

#[test]
fn what_is_said_lies_over_no_title_of_worlds_side_by_side() {
    let world = |at: f32| Neighbor {
        title: "explicit Euler".to_owned(),
        words: "up to 3.23 m apart".to_owned(),
        at: [at, 0.0],
        width: 392.0,
        columns: 3,
        ..Neighbor::default()
    };
    for said in 0..16 {
        let [done, caption, warning, refused] = [1, 2, 4, 8].map(|bit| said & bit > 0);
        let mut state = PanelState::default();
        state.notes.has_caption = caption;
        if done {
            state.notes.say("it starts here, by each method; Ctrl+Z takes it back".to_owned(), Cover::Nothing);
        }
        if warning {
            state.notes.warn("a body lay inside an obstacle: it is led out of it slowly".to_owned());
        }
        if refused {
            state.notes.refuse("there is no room for it in view".to_owned(), Cover::default());
        }
        let facts = Facts { neighbors: [66.0, 394.0, 787.0].map(world).to_vec(), ..facts(Tool::Hand) };
        let (all, _) = laid(SIZES[0], &mut state, &facts);
        assert!(all.len() >= 5, "{all:?}");
        for (place, one) in all.iter().enumerate() {
            let other = all[..place].iter().find(|other| other.intersects(*one));
            assert_eq!(
                other, None,
                "{one:?} lies over it: said {done}, caption {caption}, warned {warning}, refused {refused}"
            );
        }
    }
}

#[test]
fn plots_that_were_dragged_over_a_world_stand_beside_it_in_a_lesson() {
    let plots_of = |size: [f32; 2], is_dragged: bool, is_in_lesson: bool| {
        let mut state = PanelState { plots: Some(Plots::new(1.0)), ..PanelState::default() };
        if is_dragged {
            state.plots_at.drag_to(pos2(420.0, 460.0), false);
        }
        state.lessons.is_open = true;
        if is_in_lesson {
            state.lessons.enter(At { lesson: 0, step: 0 });
        }
        laid(size, &mut state, &facts(Tool::Hand))
    };
    for size in SIZES {
        let [left_alone, dragged] = [false, true].map(|is_dragged| plots_of(size, is_dragged, true));
        assert_eq!(left_alone.0, dragged.0, "{size:?}: wherever they were dragged to");
        assert_eq!(left_alone.1.free, dragged.1.free, "{size:?}");
    }
    let is_over_world = |(all, _): (Vec<Rect>, Laid)| all.iter().any(|one| one.contains(pos2(500.0, 400.0)));
    assert!(is_over_world(plots_of(SIZES[0], true, false)), "beside the list of lessons they stay where they were put");
    assert!(!is_over_world(plots_of(SIZES[0], true, true)));
}

#[test]
fn plots_that_were_dragged_over_a_world_have_their_place_among_worlds_side_by_side() {
    let world = |left: f32| Neighbor {
        title: "explicit Euler".to_owned(),
        at: [left, 0.0],
        width: 574.0,
        columns: 2,
        ..Neighbor::default()
    };
    let free = |is_dragged: bool| {
        let mut state = PanelState { plots: Some(Plots::new(1.0)), ..PanelState::default() };
        if is_dragged {
            state.plots_at.drag_to(pos2(420.0, 460.0), false);
        }
        let facts = Facts { neighbors: [66.0, 640.0].map(world).to_vec(), ..facts(Tool::Hand) };
        let (all, left) = laid(SIZES[0], &mut state, &facts);
        (all, left.free, left.has_plots_at_edge)
    };
    assert_eq!(free(true), free(false));
    assert!(free(true).2);
}

#[test]
fn a_sheet_and_a_canvas_have_the_window_for_themselves() {
    let count = |state: &mut PanelState, waits: bool| {
        let facts = Facts { waits, ..facts(Tool::Select) };
        laid(SIZES[0], state, &facts).0.len()
    };
    let open = || PanelState { has_settings: true, plots: Some(Plots::new(1.0)), ..PanelState::default() };
    assert!(count(&mut open(), false) >= 5);
    assert_eq!(count(&mut open(), true), 0, "the canvas alone, which is none of the panels");
    for sheet in [Sheet::Help, Sheet::Gallery, Sheet::SaveTo] {
        assert_eq!(count(&mut PanelState { sheet: Some(sheet), ..open() }, true), 1, "{sheet:?}");
    }
}

#[test]
fn plots_that_float_take_nothing_from_the_view_and_those_at_an_edge_do() {
    for (size, lie_at_edge) in [(SIZES[0], false), (SIZES[4], false), (SIZES[3], true)] {
        let facts = Facts { matter: Some(matter()), ..facts(Tool::Select) };
        let taken = |has_plots: bool| {
            let plots = has_plots.then(|| Plots::new(1.0));
            let (context, left) = shown(size, &mut PanelState { plots, ..PanelState::default() }, &facts);
            (places::read(&context, 1.0, None).len(), left.has_plots_at_edge)
        };
        let (before, _) = taken(false);
        assert_eq!(taken(true), (before + usize::from(lie_at_edge), lie_at_edge), "{size:?}");
    }
}
