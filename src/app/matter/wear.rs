//! The picture that a body wears.

use std::collections::BTreeSet;

use crate::history::Do;
use crate::picture::{Picture, Skin};
use crate::scene::{AddKeys, DrawnKeys, Row, picture_as_text};
use crate::sim::PointId;

/// Longest side of what is worn `[px]`: more is never seen of a body.
const MOST: u32 = 1024;

/// A pixel is seen from this opacity on, and colours within so much of each other are the same, of 255.
const SEEN: u8 = 127;
const ALIKE: u8 = 24;

/// The command by which points wear a picture, in the plane: as it is, so large that it covers the box around them, whose middle is its own.
///
/// Errors: in words, a picture that cannot be written.
pub(in crate::app) fn worn(
    picture: &Picture,
    points: &[PointId],
    place: impl Fn(PointId) -> [f64; 3],
) -> Result<Do, String> {
    let picture = picture.shrunk(MOST);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for at in points.iter().map(|point| place(*point)) {
        for axis in 0..2 {
            (low[axis], high[axis]) = (low[axis].min(at[axis]), high[axis].max(at[axis]));
        }
    }
    let size = [f64::from(picture.width), f64::from(picture.height)];
    let metre =
        (0..2).map(|axis| size[axis] / (high[axis] - low[axis]).max(f64::MIN_POSITIVE)).fold(f64::MAX, f64::min);
    let uv = |point: &PointId| {
        let at = place(*point);
        let along = |axis: usize| (at[axis] - 0.5 * (low[axis] + high[axis])) * metre / size[axis];
        Row([0.5 + along(0), 0.5 - along(1)])
    };
    let texture = DrawnKeys {
        image: picture_as_text(&picture)?,
        points: points.iter().map(|point| point.0).collect(),
        uv: points.iter().map(uv).collect(),
    };
    Ok(Do::Add(Box::new(AddKeys { textures: vec![texture], ..AddKeys::default() })))
}

/// Commands that paint no body which wears a picture of several colours: a matter by name leaves that as it is.
pub(in crate::app) fn but_for_pictures(acts: Vec<Do>, skins: &[Skin]) -> Vec<Do> {
    let drawn = skins.iter().filter(|skin| has_colors(&skin.picture));
    let worn: BTreeSet<u32> = drawn.flat_map(|skin| skin.triangles.iter().flatten().copied()).collect();
    let bare = |act: Do| {
        let Do::Add(mut keys) = act else { return Some(act) };
        for skin in &mut keys.skins {
            skin.points.retain(|point| !worn.contains(point));
        }
        keys.skins.retain(|skin| !skin.points.is_empty());
        (*keys != AddKeys::default()).then_some(Do::Add(keys))
    };
    if worn.is_empty() { acts } else { acts.into_iter().filter_map(bare).collect() }
}

/// Whether what is seen of a picture is of more than one colour: not all drawn in the same ink.
fn has_colors(picture: &Picture) -> bool {
    let mut seen = picture.rgba.as_chunks::<4>().0.iter().filter(|[.., alpha]| *alpha > SEEN);
    let Some(first) = seen.next() else { return false };
    seen.any(|color| (0..3).any(|k| color[k].abs_diff(first[k]) > ALIKE))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use std::sync::Arc;

    use super::super::{Among, MatterChange, Preset};
    use super::*;
    use crate::app::player::{Note, Order, Shown, Stage};
    use crate::history::{History, Start};
    use crate::picture::Tint;
    use crate::scene::Scene;

    /// A picture and nine points without one, and how many points there are.
    fn picture_and_lattice() -> (Stage, u32) {
        let text = r#"{"wobble": 1, "bodies": [{"make": "picture", "file": "pictures/jelly.png", "height": 2, "spacing": 0.4,
            "material": {"kind": "spring", "stiffness": 400, "mass": 3}}, {"make": "lattice", "columns": 3, "rows": 3,
            "spacing": 0.5, "origin": [4, 0], "material": {"kind": "spring", "stiffness": 400, "mass": 3}}]}"#;
        let stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let count = stage.history().world().point_count() as u32;
        (stage, count)
    }

    #[test]
    fn a_body_wears_another_picture_in_place_of_its_own_in_one_step_of_undo_and_in_files() {
        let (mut stage, count) = picture_and_lattice();
        let before = stage.history().skins().to_vec();
        let picture = Picture::new(4, 2, vec![200; 32]).unwrap();
        for points in [0..count - 9, count - 9..count] {
            let points: Vec<PointId> = points.map(PointId).collect();
            let world = stage.history().world();
            let at = |point: PointId| {
                let [x, y] = [0, 1].map(|axis| world.positions().get(2 * point.index() + axis));
                [x, y, 0.0]
            };
            let act = worn(&picture, &points, at).unwrap();
            assert_eq!(stage.obey(Order::Give(vec![act], Some("picture"))), None);
            let skins = stage.history().skins().to_vec();
            let own = |corners: &[u32; 3]| points.binary_search(&PointId(corners[0])).is_ok();
            let drawn: Vec<_> = skins.iter().filter(|skin| skin.triangles.iter().any(own)).collect();
            assert_eq!((drawn.len(), drawn[0].picture.width), (1, 4), "in place of what was there");
            let covered =
                stage.history().world().triangles().iter().filter(|corners| own(&corners.map(|corner| corner.0)));
            assert_eq!(drawn[0].triangles.len(), covered.count(), "all of it");
            let uv = drawn[0].texture.iter().flatten();
            assert!(uv.clone().all(|x| (-1e-6..=1.0 + 1e-6).contains(&f64::from(*x))), "within the picture");
            let again = History::new(Start::from(stage.history().snapshot().unwrap())).unwrap();
            assert_eq!(again.skins().len(), skins.len(), "a moment that is kept has it");
            assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "picture"));
            assert_eq!(stage.history().skins(), before);
        }
    }

    #[test]
    fn a_matter_by_name_paints_bodies_and_leaves_pictures_as_they_are() {
        let (mut stage, count) = picture_and_lattice();
        let all = Among { points: (0..count).map(PointId).collect(), ..Among::default() };
        let ink = Arc::clone(&stage.history().skins()[0].picture);
        let leaf = Picture {
            rgba: ink
                .rgba
                .as_chunks::<4>()
                .0
                .iter()
                .enumerate()
                .flat_map(
                    |(place, [.., alpha])| {
                        if place % 2 == 0 { [200, 30, 30, *alpha] } else { [30, 160, 60, *alpha] }
                    },
                )
                .collect(),
            ..(*ink).clone()
        };
        assert!(has_colors(&leaf) && !has_colors(&Picture::new(2, 1, vec![9, 9, 9, 255, 250, 9, 9, 0]).unwrap()));
        let points: Vec<PointId> = (0..count - 9).map(PointId).collect();
        let world = stage.history().world();
        let place = |point: PointId| {
            let [x, y] = [0, 1].map(|axis| world.positions().get(2 * point.index() + axis));
            [x, y, 0.0]
        };
        let act = worn(&leaf, &points, place).unwrap();
        assert_eq!(stage.obey(Order::Give(vec![act], Some("picture"))), None);
        let steel = MatterChange::Preset(Preset::Steel);
        assert_eq!(stage.obey(Order::Change { among: all, change: steel, goes_on: false }), None);
        let mut shown = Shown::default();
        stage.show(&mut shown);
        let color = |point: u32| Tint::of(&shown.scenery.tints, point).and_then(|tint| tint.color);
        assert_eq!([color(0), color(count - 1)], [None, Some(Preset::Steel.color())]);
    }
}
