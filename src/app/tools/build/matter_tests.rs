//! What is built is made of what was chosen, and stands accordingly.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::fibre::{BuiltOf, Fibre};
use super::links::Links;
use super::tests::{Seen, added, at, hand};
use crate::app::action::Primitive;
use crate::app::matter::{Among, Preset};
use crate::app::player::{Order, Shown, Stage};
use crate::app::tools::tests::{scope, shown};
use crate::app::tools::{Deed, Hand, Mark};
use crate::history::{Do, OneOrEach, SetKeys};
use crate::render::{Look, Palette, body_color};
use crate::scene::{ColorKey, KindName, Material, Scene};
use crate::sim::PointId;

/// A floor on which bodies meet.
const ROOM: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "bounds": {"min": [-6, -4], "max": [6, 4], "friction": 0.5},
    "contact": {"friction": 0.5}, "view": {"center": [0, 0], "height": 8}}"#;

fn room() -> Seen {
    shown(Scene::parse(ROOM, "x.json").unwrap())
}

fn of(primitive: Primitive, matter: Preset) -> Hand {
    let mut hand = hand(primitive);
    hand.build_of(BuiltOf { filled: matter, ..BuiltOf::default() });
    hand
}

fn drag(seen: &Seen, hand: &mut Hand, [from, to]: [[f64; 2]; 2]) -> Deed {
    hand.press(scope(seen), at(seen, from[0], from[1]));
    hand.release(scope(seen), at(seen, to[0], to[1]))
}

fn material(deed: &Deed) -> Material {
    added(deed).bodies[0].material.clone().unwrap()
}

#[test]
fn boxes_discs_and_rims_are_of_what_was_chosen_and_ropes_cloths_and_figures_of_their_own() {
    let seen = room();
    let corners = [[-1.0, 1.0], [1.0, 0.0]];
    for (primitive, area, times) in [
        (Primitive::Box, 2.0, 1.0),
        (Primitive::Disc, std::f64::consts::PI * 5.0, 1.0),
        (Primitive::Rim, std::f64::consts::PI * 5.0 * (1.0 - 0.75 * 0.75), 16.0),
    ] {
        let close = |found: Option<f64>, wanted: f64| (found.unwrap() / wanted - 1.0).abs() < 1e-9;
        let jelly = material(&drag(&seen, &mut of(primitive, Preset::Jelly), corners));
        assert_eq!((jelly.kind, jelly.color), (Some(KindName::Spring), Some(ColorKey(Preset::Jelly.color()))));
        assert!(close(jelly.mass, area) && close(jelly.stiffness, times * 250.0 * area), "{primitive:?}: {jelly:?}");
        let rubber = material(&drag(&seen, &mut of(primitive, Preset::Rubber), corners));
        assert!(close(rubber.mass, 1.1 * area) && close(rubber.stiffness, times * 2500.0 * 1.1 * area), "{rubber:?}");
        let steel = material(&drag(&seen, &mut of(primitive, Preset::Steel), corners));
        assert_eq!((steel.kind, steel.stiffness, steel.damping), (Some(KindName::Rigid), None, None));
        assert!(close(steel.mass, 7.8 * area) && steel.color == Some(ColorKey(Preset::Steel.color())), "{steel:?}");
        assert_eq!((steel.friction, steel.restitution), (Some(0.2), Some(0.5)));
        let cloth = material(&drag(&seen, &mut of(primitive, Preset::Cloth), corners));
        assert_eq!((cloth.kind, cloth.break_strain), (Some(KindName::Spring), Some(0.3)));
    }
    for primitive in [Primitive::Rope, Primitive::Cloth, Primitive::Figure] {
        let [plain, steel] =
            [Preset::Jelly, Preset::Steel].map(|of_it| drag(&seen, &mut of(primitive, of_it), corners));
        assert_eq!(plain, steel, "{primitive:?}");
    }
}

/// A hand that builds ropes and cloths of this.
fn with(primitive: Primitive, fibre: Fibre) -> Hand {
    let mut hand = hand(primitive);
    hand.build_of(BuiltOf { rope: fibre, cloth: fibre, ..BuiltOf::default() });
    hand
}

#[test]
fn ropes_and_cloths_are_of_what_was_chosen_for_them_and_plain_at_first() {
    let seen = room();
    for (primitive, from, to, size, plain) in [
        (Primitive::Rope, [0.0, 3.5], [0.0, 1.5], 0.15 * 2.0, 0.15 * 2.0),
        (Primitive::Cloth, [-1.0, 3.0], [1.0, 1.0], 4.0, 0.3 * 4.0),
    ] {
        let close = |found: Option<f64>, wanted: f64| (found.unwrap() / wanted - 1.0).abs() < 1e-9;
        let of = |fibre: Fibre| material(&drag(&seen, &mut with(primitive, fibre), [from, to]));
        let usual = material(&drag(&seen, &mut hand(primitive), [from, to]));
        assert_eq!((of(Fibre::Plain), usual.kind, usual.color), (usual.clone(), Some(KindName::Rigid), None));
        assert!(close(usual.mass, plain), "{usual:?}");
        let steel = of(Fibre::Steel);
        assert!(steel.kind == Some(KindName::Rigid) && close(steel.mass, 7.8 * size), "{steel:?}");
        let rubber = of(Fibre::Rubber);
        assert!(rubber.kind == Some(KindName::Spring) && close(rubber.mass, 1.1 * size), "{rubber:?}");
        let thin = of(Fibre::Thin);
        assert_eq!((thin.kind, thin.break_strain), (Some(KindName::Spring), Some(0.3)));
        assert!(close(thin.mass, 0.3 * size) && thin.stiffness > rubber.stiffness, "{thin:?}");
        // The panel of what is selected calls it the same.
        for (fibre, preset) in
            [(Fibre::Thin, Preset::Cloth), (Fibre::Rubber, Preset::Rubber), (Fibre::Steel, Preset::Steel)]
        {
            let mut stage = Stage::new(seen.2.clone().into()).unwrap();
            let deed = drag(&seen, &mut with(primitive, fibre), [from, to]);
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            let count = stage.history().world().point_count() as u32;
            let points = (0..count).map(PointId).collect();
            stage.obey(Order::Inspect(Among { points, ..Among::default() }));
            let mut shown = Shown::default();
            stage.show(&mut shown);
            assert_eq!(shown.matter.unwrap().preset(), Some(preset), "{primitive:?}");
        }
    }
}

/// How far the loose end of a rope of 2 m that hangs from a pin gets down within two seconds `[m]`, with so much on it `[kg]`.
fn sinks(fibre: Fibre, load: f64) -> f64 {
    let seen = room();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let deed = drag(&seen, &mut with(Primitive::Rope, fibre), [[0.0, 3.5], [0.0, 1.5]]);
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    let end = stage.history().world().point_count() - 1;
    let mass = Some(OneOrEach::One(load));
    let keys = SetKeys { points: Some(vec![end as u32]), mass, ..SetKeys::default() };
    stage.obey(Order::Give(vec![Do::Set(Box::new(keys))], None));
    assert_eq!(stage.history().world().masses()[end], load);
    let high = |stage: &Stage| stage.history().world().positions().get(2 * end + 1);
    let first = high(&stage);
    let mut lowest = first;
    for _ in 0..120 {
        stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
        lowest = lowest.min(high(&stage));
    }
    first - lowest
}

#[test]
fn rubber_is_drawn_out_by_what_it_bears_cord_and_steel_are_not_and_thread_tears() {
    // On a spring it swings as far below its rest as it began above it.
    let stretched = 2.0 * 9.81 / (0.05 * 2500.0 * 1.1 * 0.15 * 2.0);
    let rubber = sinks(Fibre::Rubber, 1.0);
    assert!((0.8 * stretched..1.4 * stretched).contains(&rubber), "{rubber} m of {stretched} m");
    for fibre in [Fibre::Plain, Fibre::Steel] {
        assert!(sinks(fibre, 30.0) < 0.02, "{fibre:?}: {} m", sinks(fibre, 30.0));
    }
    assert!(sinks(Fibre::Thin, 1.0) < 0.2, "{} m", sinks(Fibre::Thin, 1.0));
    assert!(sinks(Fibre::Thin, 30.0) > 2.0, "it tears: {} m", sinks(Fibre::Thin, 30.0));
}

/// Space with a floor.
const SPACE: &str = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, -9.81, 0],
    "obstacles": [{"plane": {"point": [0, -2, 0], "normal": [0, 1, 0]}}],
    "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0.6, "pitch": 0.3}}"#;

#[test]
fn ropes_and_cloths_in_space_are_of_it_too() {
    let seen = shown(Scene::parse(SPACE, "x.json").unwrap());
    for primitive in [Primitive::Rope, Primitive::Cloth] {
        let of = |fibre: Fibre| drag(&seen, &mut with(primitive, fibre), [[-0.8, 1.2], [0.8, 0.4]]);
        let [plain, rubber] = [Fibre::Plain, Fibre::Rubber].map(|fibre| material(&of(fibre)));
        assert_eq!((plain.kind, rubber.kind), (Some(KindName::Rigid), Some(KindName::Spring)));
        assert_eq!((rubber.friction, rubber.restitution), (None, None), "skins are of the plane");
        for fibre in Fibre::ALL {
            let (mut stage, deed) = (Stage::new(seen.2.clone().into()).unwrap(), of(fibre));
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None, "{fibre:?}");
            assert!(stage.history().world().bonds().len() > 3);
        }
    }
}

#[test]
fn ropes_and_cloths_are_drawn_in_the_colours_of_their_buttons() {
    for palette in [Palette::Dark, Palette::Light] {
        let look = Look::in_palette(palette);
        for (primitive, fibre) in
            [Primitive::Rope, Primitive::Cloth].into_iter().flat_map(|of| Fibre::ALL.map(|fibre| (of, fibre)))
        {
            let mut seen = room();
            let deed = drag(&seen, &mut with(primitive, fibre), [[-1.0, 2.0], [1.0, 1.0]]);
            let mut stage = Stage::new(seen.2.clone().into()).unwrap();
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            stage.show(&mut seen.0);
            let points: Vec<PointId> = (0..seen.0.point_count() as u32).map(PointId).collect();
            let drawn = body_color(&seen.0.view(), &look, &points);
            assert_eq!(drawn, Some(fibre.color(primitive, &look)), "{primitive:?} of {fibre:?}, {palette:?}");
        }
    }
}

#[test]
fn a_loop_is_filled_with_what_was_chosen() {
    let seen = room();
    let mut hand = of(Primitive::Bonds, Preset::Wood);
    hand.set_links(Links { fills: true, ..Links::default() });
    let corners = [[-1.0, 0.0], [1.0, 0.0], [0.0, 1.5], [-1.0, 0.0]];
    let deeds = corners.map(|corner| drag(&seen, &mut hand, [corner; 2]));
    let deed = deeds.last().unwrap();
    let keys = added(deed);
    assert!(keys.triangles.len() > 5 && keys.bonds.iter().all(|bond| bond.kind == Some(KindName::Rigid)));
    let count = keys.points.as_ref().unwrap().position.len();
    assert_eq!(keys.skins.len(), 1);
    let skin = &keys.skins[0];
    assert_eq!(
        (skin.points.len(), skin.friction, skin.color),
        (count, Some(0.5), Some(ColorKey(Preset::Wood.color())))
    );
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(deed.commands.clone(), deed.edit)), None);
    let mass: f64 = stage.history().world().masses().iter().sum();
    assert!((mass - 0.7 * 1.5).abs() < 1e-9, "{mass} kg");
}

/// Four boxes are drawn on top of each other, a second after another, while time runs. Returns how high the top is over the floor then, and how
/// far aside of the lowest the highest box lies `[m]`.
fn tower(matter: Preset) -> [f64; 2] {
    let mut seen = room();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let mut hand = of(Primitive::Box, matter);
    for k in 0..4 {
        let low = -3.95 + 1.05 * f64::from(k);
        let deed = drag(&seen, &mut hand, [[-0.5, low], [0.5, low + 1.0]]);
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
        for _ in 0..60 {
            stage.obey(Order::Step(None));
        }
        stage.show(&mut seen.0);
    }
    for _ in 0..120 {
        stage.obey(Order::Step(None));
    }
    stage.show(&mut seen.0);
    let places: Vec<DVec2> = (0..seen.0.point_count()).map(|k| DVec2::from_slice(&seen.0.place(k)[..2])).collect();
    let each = places.len() / 4;
    let middle = |k: usize| places[k * each..(k + 1) * each].iter().sum::<DVec2>() / each as f64;
    let top = places.iter().map(|place| place.y).fold(f64::NEG_INFINITY, f64::max);
    [top + 4.0, (middle(3).x - middle(0).x).abs()]
}

#[test]
fn a_tower_of_wood_stands_as_high_as_its_boxes_and_one_of_jelly_sags() {
    let [high, aside] = tower(Preset::Wood);
    assert!((high - 4.0).abs() < 0.1 && aside < 0.1, "{high} m, {aside} m aside");
    let [high, _] = tower(Preset::Jelly);
    assert!(high < 3.9, "{high} m");
}

#[test]
fn what_is_drawn_over_another_body_is_told_that_they_part_unless_bodies_pass_each_other() {
    let said = |scene: &str, place: [f64; 2], plays: bool| {
        let seen = shown(Scene::parse(scene, "x.json").unwrap());
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        let deed = drag(&seen, &mut of(Primitive::Box, Preset::Wood), [[-1.0, -0.5], [1.0, 0.5]]);
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
        let mut seen = seen;
        stage.show(&mut seen.0);
        seen.0.figures.playing = plays;
        let hand = of(Primitive::Disc, Preset::Rubber);
        let marks = hand.marks(scope(&seen), Some(at(&seen, place[0], place[1])));
        marks.into_iter().find_map(|mark| if let Mark::Words(_, words) = mark { Some(words) } else { None }).unwrap()
    };
    for over in [[-0.8, -0.5], [0.0, 0.0], [1.2, 0.3]] {
        assert!(said(ROOM, over, true).contains("they part (pause with Space"), "{}", said(ROOM, over, true));
        assert!(said(ROOM, over, false).contains("unless they are hinged"), "{}", said(ROOM, over, false));
    }
    assert!(!said(ROOM, [2.5, 0.0], true).contains("part"), "beside it nothing is said");
    let passing = ROOM.replace(r#"{"friction": 0.5}, "view""#, r#"{"bodies": false}, "view""#);
    assert!(!said(&passing, [0.0, 0.0], true).contains("part"), "{}", said(&passing, [0.0, 0.0], true));
}
