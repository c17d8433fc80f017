//! What is built more finely has more points, and sags and bends as what is coarse.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::fibre::BuiltOf;
use super::grain::Grain;
use super::links::Links;
use super::tests::{Seen, added, at, hand};
use crate::app::action::Primitive;
use crate::app::player::{Order, Stage};
use crate::app::tools::tests::{scope, shown};
use crate::app::tools::{Deed, Hand, Mark};
use crate::scene::Scene;

/// A floor that bodies lie on.
const ROOM: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "bounds": {"min": [-6, -4], "max": [6, 4], "friction": 0.5},
    "contact": {"friction": 0.5}, "view": {"center": [0, 0], "height": 8}}"#;

fn room() -> Seen {
    shown(Scene::parse(ROOM, "x.json").unwrap())
}

fn of(primitive: Primitive, grain: Grain) -> Hand {
    let mut hand = hand(primitive);
    hand.build_of(BuiltOf { grain, ..BuiltOf::default() });
    hand
}

fn drag(seen: &Seen, hand: &mut Hand, [from, to]: [[f64; 2]; 2]) -> Deed {
    hand.press(scope(seen), at(seen, from[0], from[1]));
    hand.release(scope(seen), at(seen, to[0], to[1]))
}

#[test]
fn the_preview_says_how_many_points_come_and_as_many_come() {
    let seen = room();
    for (primitive, counts) in [
        (Primitive::Box, [16, 36, 121, 441]),
        (Primitive::Disc, [19, 37, 127, 487]),
        (Primitive::Rim, [24, 36, 72, 144]),
    ] {
        let mut before = 0;
        for (grain, count) in Grain::ALL.into_iter().zip(counts) {
            let mut hand = of(primitive, grain);
            hand.press(scope(&seen), at(&seen, -0.5, 0.5));
            let marks = hand.marks(scope(&seen), Some(at(&seen, 0.5, -0.5)));
            let words = marks.iter().find_map(|mark| if let Mark::Words(_, words) = mark { Some(words) } else { None });
            let deed = hand.release(scope(&seen), at(&seen, 0.5, -0.5));
            let points = added(&deed).point_count(&seen.2);
            assert!(words.unwrap().contains(&format!(", {points} points")), "{primitive:?}: {words:?}");
            // The lattice of a disc may fill its rim by some points more.
            let most = if primitive == Primitive::Disc { count + count / 4 } else { count };
            assert!(
                (count - count / 8..=most).contains(&points) && points > before,
                "{primitive:?}, {grain:?}: {points}"
            );
            before = points;
        }
    }
}

#[test]
fn a_loop_is_filled_as_finely() {
    let seen = room();
    let counts = Grain::ALL.map(|grain| {
        let mut hand = of(Primitive::Bonds, grain);
        hand.set_links(Links { fills: true, ..Links::default() });
        let corners = [[-1.0, 0.0], [1.0, 0.0], [0.0, 1.5]];
        corners.into_iter().for_each(|corner| _ = drag(&seen, &mut hand, [corner; 2]));
        let marks = hand.marks(scope(&seen), Some(at(&seen, -1.0, 0.0)));
        let deed = drag(&seen, &mut hand, [[-1.0, 0.0]; 2]);
        let points = added(&deed).points.as_ref().unwrap().position.len();
        let says =
            |mark: &Mark| matches!(mark, Mark::Words(_, words) if words.ends_with(&format!(", {points} points")));
        assert!(points > 3 && marks.iter().any(says), "{points}: {marks:?}");
        added(&deed).triangles.len()
    });
    assert!(counts.windows(2).all(|pair| pair[1] as f64 > 1.8 * pair[0] as f64), "{counts:?}");
}

/// How high something is that was drawn as high as 1 m on the floor, after it came to rest `[m]`.
fn high(primitive: Primitive, grain: Grain) -> f64 {
    let mut seen = room();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let mut hand = of(primitive, grain);
    hand.hold([false, false]);
    let deed = drag(&seen, &mut hand, [[-0.5, -3.0], [0.5, -3.99]]);
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    for _ in 0..240 {
        stage.obey(Order::Step(None));
    }
    stage.show(&mut seen.0);
    let places = (0..seen.0.point_count()).map(|k| DVec2::from_slice(&seen.0.place(k)[..2]));
    places.fold(f64::NEG_INFINITY, |most, place| most.max(place.y)) + 4.0
}

#[test]
fn fine_jelly_sags_as_coarse_jelly_does() {
    for (primitive, within) in [(Primitive::Box, 0.03), (Primitive::Disc, 0.05), (Primitive::Rim, 0.08)] {
        let [medium, fine] = [Grain::Medium, Grain::Fine].map(|grain| high(primitive, grain));
        assert!((medium - fine).abs() < within, "{primitive:?}: {medium} m of medium fineness, {fine} m of fine");
        assert!(fine > 0.5 && fine < 0.995, "{primitive:?}: it sags: {fine} m");
    }
}
