//! Bodies that are drawn out at the loose ends of ropes: they hang there.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::{DVec2, DVec3};

use super::tests::{LOOSE, added, at, drag, drawn, extent, hand};
use crate::app::action::Primitive;
use crate::app::player::{Note, Order, Stage};
use crate::app::tools::tests::{scope, shown};
use crate::scene::Scene;

#[test]
fn a_body_that_is_drawn_over_the_loose_end_of_a_rope_is_tied_to_it() {
    let seen = shown(Scene::parse(LOOSE, "x.json").unwrap());
    let count = seen.0.point_count();
    let drags = [
        (Primitive::Box, [-2.6, 1.4], [-1.4, 0.2]),
        (Primitive::Disc, [-2.0, 0.8], [-1.4, 0.8]),
        (Primitive::Box, [0.0, 3.0], [0.6, 2.4]),
    ];
    for (primitive, from, to) in drags {
        for is_free in [false, true] {
            let ties = from[0] < -1.0 && !is_free;
            let mut hand = hand(primitive);
            hand.hold([is_free, primitive == Primitive::Disc]);
            hand.press(scope(&seen), at(&seen, from[0], from[1]));
            let to = at(&seen, to[0], to[1]);
            let said = drawn(&hand.marks(scope(&seen), Some(to))).1;
            let deed = hand.release(scope(&seen), to);
            assert_eq!(said.contains("the rope's end is tied to it"), ties, "{primitive:?}: {said}");
            assert_eq!(deed.commands.len(), if ties { 2 } else { 1 }, "{deed:?}");
            if !ties {
                continue;
            }
            let mut stage = Stage::new(seen.2.clone().into()).unwrap();
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            let world = stage.history().world();
            let gone = world.gone().to_vec();
            assert!(!gone.is_empty() && gone.iter().all(|point| point.index() < count), "{gone:?}");
            let is_tie = |bond: &crate::sim::Bond| bond.a.index() < count && bond.b.index() >= count;
            let ties: Vec<_> = world.bonds().iter().filter(is_tie).collect();
            let [tie] = ties[..] else { panic!("{ties:?}") };
            assert!(tie.rest_length < 0.6 && !gone.contains(&tie.a), "{tie:?}");
            for _ in 0..180 {
                stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            }
            // It hangs, and is pushed out of nothing.
            let [low, high] = extent(stage.history().world(), count);
            assert!(low.y > -1.5 && low.y < 0.9 && (low.x + high.x + 4.0).abs() < 1.0, "{low} {high}");
            assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == primitive.name()));
            assert_eq!(stage.history().world().gone().len(), 0);
        }
    }
}

#[test]
fn a_box_that_is_drawn_under_the_loose_end_of_a_rope_or_from_a_pin_hangs_there() {
    let seen = shown(Scene::parse(LOOSE, "x.json").unwrap());
    let count = seen.0.point_count();
    let place = |point: usize| DVec3::from(seen.0.place(point)).truncate();
    let (end, pin) = (place(8), place(0));
    let below = [end + DVec2::new(-0.5, -0.05), end + DVec2::new(0.5, -1.05)];
    let from_pin = [pin + DVec2::new(-0.03, 0.02), pin + DVec2::new(-1.2, 0.9)];
    for ([from, to], words, weld) in
        [(below, "the rope's end is tied to it", false), (from_pin, "tied to the pin", true)]
    {
        for is_free in [false, true] {
            let mut hand = hand(Primitive::Box);
            hand.hold([is_free, false]);
            hand.press(scope(&seen), at(&seen, from.x, from.y));
            let to = at(&seen, to.x, to.y);
            let said = drawn(&hand.marks(scope(&seen), Some(to))).1;
            assert_eq!(said.contains(words), !is_free, "{said}");
            let deed = hand.release(scope(&seen), to);
            let mut stage = Stage::new(seen.2.clone().into()).unwrap();
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            let is_tie = |bond: &crate::sim::Bond| bond.a.index() < count && bond.b.index() >= count;
            let ties: Vec<_> = stage.history().world().bonds().iter().filter(is_tie).collect();
            assert_eq!(ties.len(), usize::from(!is_free), "{ties:?}");
            assert!(ties.iter().all(|tie| (tie.rest_length == 0.0) == weld), "{ties:?}");
            for _ in 0..120 {
                stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            }
            let world = stage.history().world();
            assert!(world.is_finite());
            let [_, high] = extent(world, count);
            assert_eq!(high.y > from.y - 0.6, !is_free, "{words}, free {is_free}: {high} from {from}");
        }
    }
}

#[test]
fn what_is_drawn_under_or_over_the_end_of_a_rope_hangs_where_the_rope_is_and_a_box_by_the_middle_of_its_side() {
    let seen = shown(Scene::parse(LOOSE, "x.json").unwrap());
    let count = seen.0.point_count();
    // From a little beside the middle, from well beside it, over the end, and a disc that is drawn from its middle.
    let drags = [
        (Primitive::Box, [-2.55, 0.97], [-1.5, 0.1], true),
        (Primitive::Box, [-2.3, 0.97], [-1.0, 0.1], false),
        (Primitive::Box, [-2.55, 1.6], [-1.4, 0.6], true),
        (Primitive::Disc, [-1.97, 0.45], [-1.45, 0.45], true),
    ];
    for (primitive, from, to, is_middle) in drags {
        let deed = drag(&seen, &mut hand(primitive), from, to);
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
        let place = |stage: &Stage, point: usize| {
            let x = stage.history().world().positions();
            DVec2::new(x.get(2 * point), x.get(2 * point + 1))
        };
        let is_tie = |bond: &crate::sim::Bond| bond.a.index() < count && bond.b.index() >= count;
        let ties: Vec<_> = stage.history().world().bonds().iter().filter(is_tie).collect();
        let [tie] = ties[..] else { panic!("{ties:?}") };
        assert!((place(&stage, tie.b.index()).x + 2.0).abs() < 1e-6, "{primitive:?} {from:?}: right below the rope");
        let [low, high] = extent(stage.history().world(), count);
        let off = 0.5 * (low.x + high.x) + 2.0;
        assert_eq!(off.abs() < 1e-6, is_middle, "{primitive:?} {from:?}: {off} m beside the rope");
        if is_middle {
            (0..240).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
            let [low, high] = extent(stage.history().world(), count);
            assert!((0.5 * (low.x + high.x) + 2.0).abs() < 0.03, "{primitive:?} {from:?}: it hangs straight down");
        }
    }
}

#[test]
fn boxes_are_not_tied_to_bodies_that_they_are_drawn_beside() {
    let text = LOOSE.replace("[1, 0]", "[0.4, 0.2]");
    let seen = shown(Scene::parse(&text, "x.json").unwrap());
    let corner = (0..seen.0.point_count()).map(|point| DVec3::from(seen.0.place(point)).truncate()).skip(9);
    let corner = corner.max_by(|a, b| (a.x + a.y).total_cmp(&(b.x + b.y))).unwrap();
    let deed = drag(&seen, &mut hand(Primitive::Box), [corner.x, corner.y], [corner.x + 1.0, corner.y + 1.0]);
    assert!(added(&deed).bonds.is_empty() && deed.words.is_none(), "{deed:?}");
}
