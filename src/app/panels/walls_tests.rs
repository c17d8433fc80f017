//! Walls that are put up from the settings, in the plane and in space.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use egui::{Pos2, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::{Facts, PanelState, Setting, Settings, Wish, settings};
use crate::app::player::{Order, Shown, Stage};
use crate::scene::Scene;

fn shown(stage: &mut Stage) -> Shown {
    let mut shown = Shown::default();
    stage.show(&mut shown);
    shown
}

/// What a click on the box for walls asks for in the settings of a scene, where new ones would have these corners.
fn clicked(stage: &mut Stage, new_walls: [[f64; 3]; 2]) -> Vec<Setting> {
    let now = shown(stage);
    let settings = Settings { scene: now.settings.clone(), ..Settings::default() };
    let facts = Facts { settings, dimensions: now.dimensions, new_walls, ..Facts::default() };
    let room = Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0));
    let begun = (PanelState { settings_search: "walls".to_owned(), ..PanelState::default() }, Vec::new());
    let show = move |ui: &mut egui::Ui, (state, wishes): &mut (PanelState, Vec<Wish>)| {
        settings::show(ui.ctx(), room, state, &facts, wishes);
    };
    let mut harness = Harness::builder().with_size(room.size()).build_ui_state(show, begun);
    harness.run_steps(4);
    harness.get_by_label("stand").click();
    harness.run_steps(3);
    let wishes = harness.state().1.clone();
    wishes.into_iter().filter_map(|wish| if let Wish::Set(set) = wish { Some(set) } else { None }).collect()
}

#[test]
fn walls_are_put_up_in_space_taken_away_and_undone() {
    let corners = [[-4.0, -3.0, -2.0], [4.0, 3.0, 2.0]];
    let scenes = [
        (r#"{"wobble": 1, "dimensions": 3, "points": {"position": [[0, 1, 0]]}}"#, corners),
        (r#"{"wobble": 1, "points": {"position": [[0, 1]]}}"#, corners.map(|[x, y, _]| [x, y, 0.0])),
    ];
    for (text, corners) in scenes {
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let give = |stage: &mut Stage| {
            let [set] = &clicked(stage, corners)[..] else { panic!("one change") };
            assert_eq!(stage.obey(Order::Give(vec![set.act.clone()], Some(set.name))), None);
            shown(stage).settings.bounds.unwrap().map(|walls| [walls.min, walls.max])
        };
        assert_eq!(give(&mut stage), Some(corners));
        assert_eq!(give(&mut stage), None, "a second click takes them away");
        stage.obey(Order::Undo(None));
        assert_eq!(shown(&mut stage).settings.bounds.unwrap().map(|walls| walls.max), Some(corners[1]));
        stage.obey(Order::Undo(None));
        assert_eq!(shown(&mut stage).settings.bounds, Some(None));
    }
}
