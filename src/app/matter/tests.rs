//! Matter of worlds: what is shown is what there is, and what is changed is that alone.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::{Among, Common, Matter, MatterChange, NEVER, Preset};
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Do;
use crate::scene::Scene;
use crate::sim::{BondKind, PointId};

/// A box of springs of 1 m^2, a rigid triangle, a rope, an obstacle.
pub(super) const SCENE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.4},
    "points": {"position": [[5, 0], [6, 0], [5.5, 1]]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}],
    "triangles": [[0, 1, 2]],
    "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "material": {"kind": "spring", "stiffness": 300,
        "damping": 1, "mass": 4}}, {"make": "rope", "count": 6, "to": [1, 0], "origin": [0, 3], "material": {"kind": "rigid", "mass": 1}}],
    "obstacles": [{"box": {"min": [0, -3], "max": [2, -2]}, "friction": 0.7}]}"#;

pub(super) fn stage() -> Stage {
    Stage::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap()
}

pub(super) fn among(points: std::ops::Range<u32>) -> Among {
    Among { points: points.map(PointId).collect(), ..Among::default() }
}

pub(super) fn matter(stage: &mut Stage, among: &Among) -> Matter {
    assert_eq!(stage.obey(Order::Inspect(among.clone())), None);
    let mut shown = Shown::default();
    stage.show(&mut shown);
    (*shown.matter.unwrap()).clone()
}

pub(super) fn change(stage: &mut Stage, among: &Among, change: MatterChange) {
    assert_eq!(stage.obey(Order::Change { among: among.clone(), change, goes_on: false }), None, "{change:?}");
}

#[test]
fn what_is_shown_is_what_there_is() {
    let mut stage = stage();
    let soft = matter(&mut stage, &among(3..12));
    assert_eq!((soft.points, soft.bonds, soft.kinds), (9, 20, [0, 20, 0]));
    assert!((soft.mass - 4.0).abs() < 1e-12 && (soft.area - 1.0).abs() < 1e-6);
    assert!((soft.density().unwrap() - 4.0).abs() < 1e-5);
    assert_eq!(soft.friction.unwrap().same(), Some(0.4));
    assert_eq!((soft.breaks.unwrap().same(), soft.color), (Some(NEVER), Common::One(None)));
    let both = matter(&mut stage, &Among { obstacles: vec![0], ..among(0..12) });
    assert_eq!((both.kinds, both.obstacles, both.friction.unwrap().same()), ([3, 20, 0], 1, None));
    assert!(both.stiffness.unwrap().same().is_some() == soft.stiffness.unwrap().same().is_some());
    let mut shown = Shown::default();
    stage.obey(Order::Inspect(Among::default()));
    stage.show(&mut shown);
    assert!(shown.matter.is_none(), "nobody asks");
}

#[test]
fn a_change_is_seen_changes_nothing_else_and_is_undone_as_one() {
    let one = MatterChange::Stiffness;
    let all = [
        MatterChange::Mass(9.0),
        one(70.0),
        MatterChange::Damping(3.0),
        MatterChange::Breaks(0.3),
        MatterChange::Limit(crate::sim::Limit::Max),
        MatterChange::Radius(0.03),
        MatterChange::Layered(true),
        MatterChange::Friction(0.9),
        MatterChange::Restitution(0.5),
        MatterChange::Color([1, 2, 3]),
        MatterChange::Rigid,
    ];
    let soft = among(3..12);
    for given in all {
        let mut stage = stage();
        let [before, other] = [soft.clone(), among(12..18)].map(|among| matter(&mut stage, &among));
        change(&mut stage, &soft, given);
        let after = matter(&mut stage, &soft);
        let same = |span: Option<super::Span>| span.and_then(super::Span::same);
        let expected = match given {
            MatterChange::Mass(mass) => {
                Matter { mass: after.mass, ..before.clone() }.clone_if((after.mass - mass).abs() < 1e-9)
            }
            MatterChange::Stiffness(x) => {
                Matter { stiffness: after.stiffness, ..before.clone() }.clone_if(same(after.stiffness) == Some(x))
            }
            MatterChange::Damping(x) => {
                Matter { damping: after.damping, ..before.clone() }.clone_if(same(after.damping) == Some(x))
            }
            // Its area is worked out from where its corners are then: bonds that do not hold apart say nothing of it.
            MatterChange::Limit(_) => Matter { limits: [0, before.bonds, 0], area: after.area, ..before.clone() }
                .clone_if((after.area - before.area).abs() < 1e-6),
            MatterChange::Breaks(x) => {
                Matter { breaks: after.breaks, ..before.clone() }.clone_if(same(after.breaks) == Some(x))
            }
            MatterChange::Radius(x) => {
                Matter { radius: after.radius, ..before.clone() }.clone_if(same(after.radius.unwrap()) == Some(x))
            }
            MatterChange::Layered(_) => Matter { layered: Some(before.points), ..before.clone() },
            MatterChange::Friction(x) => {
                Matter { friction: after.friction, ..before.clone() }.clone_if(same(after.friction) == Some(x))
            }
            MatterChange::Restitution(x) => {
                Matter { restitution: after.restitution, ..before.clone() }.clone_if(same(after.restitution) == Some(x))
            }
            MatterChange::Color(color) => Matter { color: Common::One(Some(color)), ..before.clone() },
            // What is rigid bends no more.
            _ => Matter { kinds: [20, 0, 0], stiffness: None, damping: None, bending: None, ..before.clone() },
        };
        assert_eq!(after, expected, "{given:?}");
        assert_eq!(matter(&mut stage, &among(12..18)), other, "{given:?} touches nothing else");
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == given.name()));
        assert_eq!(matter(&mut stage, &soft), before, "{given:?} undone");
    }
}

impl Matter {
    /// Itself, where the number that was asked for is there.
    fn clone_if(self, is_so: bool) -> Self {
        assert!(is_so, "{self:?}");
        self
    }
}

#[test]
fn a_drag_of_a_number_is_one_edit() {
    let mut stage = stage();
    let soft = among(3..12);
    let before = matter(&mut stage, &soft);
    for (k, mass) in [5.0, 6.0, 7.0].into_iter().enumerate() {
        let order = Order::Change { among: soft.clone(), change: MatterChange::Mass(mass), goes_on: k > 0 };
        assert_eq!(stage.obey(order), None);
    }
    assert!((matter(&mut stage, &soft).mass - 7.0).abs() < 1e-9);
    stage.obey(Order::Undo(None));
    assert_eq!(matter(&mut stage, &soft), before);
}

#[test]
fn a_drag_whose_first_number_is_refused_is_an_edit_of_its_own() {
    let mut stage = stage();
    let soft = among(3..12);
    change(&mut stage, &soft, MatterChange::Restitution(0.3));
    let before = matter(&mut stage, &soft);
    for (k, bounces) in [3.0, 0.4, 0.5].into_iter().enumerate() {
        let order = Order::Change { among: soft.clone(), change: MatterChange::Restitution(bounces), goes_on: k > 0 };
        assert_eq!(matches!(stage.obey(order), Some(Note::Refused(_))), k == 0, "{bounces}");
    }
    stage.obey(Order::Undo(None));
    assert_eq!(matter(&mut stage, &soft), before);
}

#[test]
fn presets_weigh_by_area_are_soft_by_weight_and_hold_their_shape() {
    for preset in Preset::ALL {
        let mut stage = stage();
        let soft = among(3..12);
        change(&mut stage, &soft, MatterChange::Preset(preset));
        let stuff = preset.stuff();
        let after = matter(&mut stage, &soft);
        assert!((after.density().unwrap() / stuff.density - 1.0).abs() < 1e-5, "{preset:?}: {after:?}");
        assert_eq!(after.kinds, if stuff.springs.is_some() { [0, 20, 0] } else { [20, 0, 0] });
        if let Some([soft, _]) = stuff.springs {
            assert!((after.stiffness.unwrap().least / (soft * after.mass) - 1.0).abs() < 1e-9);
        }
        assert_eq!(after.color, Common::One(Some(stuff.color)));
        assert_eq!(after.preset(), Some(preset));
        let touched = [
            Matter { mass: 1.01 * after.mass, ..after.clone() },
            Matter { kinds: [after.kinds[1], after.kinds[0], 0], ..after.clone() },
            Matter { friction: after.restitution, restitution: after.friction, ..after.clone() },
        ];
        assert!(touched.iter().all(|other| other.preset().is_none()), "{preset:?} as long as nothing of it was set");
        assert_eq!(after.friction.unwrap().same(), Some(stuff.friction));
        // It falls two seconds long and lies, as wide as it was within what its softness gives.
        (0..120).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
        let later = matter(&mut stage, &soft);
        assert_eq!(later.bonds, 20, "{preset:?} is whole");
        let world = stage.history().world();
        let x = |point: usize, axis: usize| world.positions().get(2 * point + axis);
        let long = (x(5, 0) - x(3, 0)).hypot(x(5, 1) - x(3, 1));
        let least = if stuff.springs.is_some() { 0.6 } else { 0.999 };
        assert!((least..=2.0 - least).contains(&long), "{preset:?}: a side of 1 m is {long} m long");
    }
}

#[test]
fn chains_are_stiffer_by_as_many_as_pull_in_a_row_and_back_again() {
    let mut stage = stage();
    let rope = among(12..18);
    change(&mut stage, &rope, MatterChange::Springy);
    let springs: Vec<f64> = stage
        .history()
        .world()
        .bonds()
        .iter()
        .filter_map(|bond| match bond.kind {
            BondKind::Spring { stiffness, .. } if bond.a.0 >= 12 => Some(stiffness),
            _ => None,
        })
        .collect();
    assert!(springs.len() == 5 && springs.iter().all(|k| (k / (600.0 * 5.0) - 1.0).abs() < 1e-9), "{springs:?}");
    change(&mut stage, &rope, MatterChange::Rigid);
    assert_eq!(matter(&mut stage, &rope).kinds, [5, 0, 0]);
}

#[test]
fn what_cannot_be_changed_is_said() {
    let mut stage = stage();
    for (among, change) in [
        (among(0..3), MatterChange::Stiffness(5.0)),
        (among(0..3), MatterChange::Bending(5.0)),
        (Among { obstacles: vec![0], ..Among::default() }, MatterChange::Rigid),
        (among(3..12), MatterChange::Restitution(3.0)),
        (among(3..12), MatterChange::Mass(-1.0)),
    ] {
        let before = matter(&mut stage, &among);
        let note = stage.obey(Order::Change { among: among.clone(), change, goes_on: false });
        assert!(matches!(note, Some(Note::Refused(_))), "{change:?}: {note:?}");
        assert_eq!(matter(&mut stage, &among), before);
    }
}

/// A soft disc that lies on the ground, pressed down by a weight on each of its points.
const LOADED: &str = r#"{"wobble": 1, "gravity": [0, -30], "contact": {"friction": 0.4},
    "bounds": {"min": [-5, 0], "max": [5, 8]},
    "bodies": [{"make": "disc", "radius": 0.5, "spacing": 0.17, "origin": [0, 0.6],
        "material": {"kind": "spring", "stiffness": 200, "damping": 1.2, "mass": 0.8}}]}"#;

/// The disc of [`LOADED`] at rest, and all of it.
fn loaded() -> (Stage, Among) {
    let mut stage = Stage::new(Scene::parse(LOADED, "x.json").unwrap().into()).unwrap();
    (0..300).for_each(|_| _ = stage.obey(Order::Step(None)));
    let count = stage.history().world().point_count() as u32;
    (stage, among(0..count))
}

/// The least and the mean height of all points `[m]`.
fn heights(stage: &Stage) -> [f64; 2] {
    let world = stage.history().world();
    let all: Vec<f64> = (0..world.point_count()).map(|point| world.positions().get(2 * point + 1)).collect();
    [all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().sum::<f64>() / all.len() as f64]
}

#[test]
fn what_is_pressed_flat_becomes_stiffer_without_a_hop_in_one_step_of_undo() {
    for given in
        [MatterChange::Preset(Preset::Steel), MatterChange::Preset(Preset::Rubber), MatterChange::Stiffness(5e4)]
    {
        let hop = |is_led: bool| {
            let (mut stage, disc) = loaded();
            let flat = heights(&stage);
            assert!(flat[1] < 0.42, "it is pressed flat: {flat:?}");
            if is_led {
                change(&mut stage, &disc, given);
            } else {
                let list = super::commands((stage.history().world(), &super::Former::default()), &disc, given).unwrap();
                assert_eq!(stage.obey(Order::Give(list, Some("at once"))), None);
            }
            let mut highest = 0.0_f64;
            for _ in 0..120 {
                stage.obey(Order::Step(None));
                highest = highest.max(heights(&stage)[0]);
            }
            (stage, highest)
        };
        let ((led, slow), (_, fast)) = (hop(true), hop(false));
        assert!(slow < 0.03, "{given:?}: it leaves the ground by {slow} m");
        assert!(fast > 4.0 * slow.max(5e-3), "{given:?}: at once it hops: {fast} m");
        let there = matter(&mut { led }, &loaded().1);
        if given == MatterChange::Preset(Preset::Steel) {
            assert!(there.kinds[1] == 0 && there.mass > 6.5 * 0.8, "{there:?}");
        }
    }
}

#[test]
fn what_is_pressed_flat_or_stretched_gets_the_mass_of_its_shape_at_rest() {
    let weighed = |stage: &mut Stage, among: &Among| {
        let list = super::commands(
            (stage.history().world(), &super::Former::default()),
            among,
            MatterChange::Preset(Preset::Wood),
        )
        .unwrap();
        assert_eq!(stage.obey(Order::Give(list, Some("at once"))), None);
        let after = matter(stage, among);
        assert!(after.area == 0.0 || (after.density().unwrap() / Preset::Wood.stuff().density - 1.0).abs() < 1e-9);
        after.mass
    };
    let (mut flat, disc) = loaded();
    let mut round = Stage::new(Scene::parse(LOADED, "x.json").unwrap().into()).unwrap();
    let squeezed = heights(&flat)[1] / heights(&round)[1];
    assert!(squeezed < 0.75, "{squeezed}");
    let [pressed, free] = [&mut flat, &mut round].map(|stage| weighed(stage, &disc));
    assert!((pressed / free - 1.0).abs() < 1e-6, "{pressed} kg, {free} kg as it was built");
    // A rope of springs that is twice as long as it is at rest.
    let rope = |long: f64| {
        let text = format!(
            r#"{{"wobble": 1, "points": {{"position": [[0, 0], [{long}, 0]]}},
            "bonds": [{{"a": 0, "b": 1, "kind": "spring", "stiffness": 9, "rest": 1}}]}}"#
        );
        weighed(&mut Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap(), &among(0..2))
    };
    assert!(rope(1.0) > 0.0 && (rope(2.0) / rope(1.0) - 1.0).abs() < 1e-9);
}

#[test]
fn what_is_led_to_another_matter_is_shown_as_it_will_be_undone_as_one_kept_in_files_and_replayed_to_the_bit() {
    use crate::history::{Do, Replay, Start};
    let (mut stage, disc) = loaded();
    let before = matter(&mut stage, &disc);
    let at = stage.history().world().time();
    change(&mut stage, &disc, MatterChange::Preset(Preset::Steel));
    assert_eq!(matter(&mut stage, &disc).kinds[1], 0, "steel is rigid, as soon as it was asked for");
    (0..10).for_each(|_| _ = stage.obey(Order::Step(None)));
    let springs = |world: &dyn crate::sim::Dynamics| {
        world.bonds().iter().filter(|bond| matches!(bond.kind, BondKind::Spring { .. })).count()
    };
    assert!(springs(stage.history().world()) > 0, "it is on its way");
    // A moment that is kept goes on as this does.
    let moment = stage.history().snapshot().unwrap();
    let mut other = Stage::new(Start::from(moment)).unwrap();
    for stage in [&mut stage, &mut other] {
        (0..60).for_each(|_| _ = stage.obey(Order::Step(None)));
    }
    assert_eq!([springs(stage.history().world()), springs(other.history().world())], [0, 0]);
    let recording = stage.history().recording();
    let led = |entry: &&crate::history::Entry| matches!(&entry.act, Do::Set(keys) if keys.over.is_some());
    assert_eq!(recording.commands.iter().filter(led).count(), 2, "masses and bonds");
    let mut replay = Replay::new(&recording, "x").unwrap();
    replay.advance(&recording.commands, recording.end()).unwrap();
    let places = |world: &dyn crate::sim::Dynamics| {
        (0..2 * world.point_count()).map(|k| world.positions().get(k).to_bits()).collect::<Vec<_>>()
    };
    assert!(places(replay.world()) == places(stage.history().world()), "the same bits");
    let Some(Note::Undone(name, _)) = stage.obey(Order::Undo(None)) else { panic!("nothing undone") };
    assert_eq!((name.as_str(), matter(&mut stage, &disc)), ("Steel", before.clone()));
    assert!((stage.history().world().time() - at).abs() < 1e-9);
    let flat = heights(&stage)[1];
    (0..60).for_each(|_| _ = stage.obey(Order::Step(None)));
    let later = matter(&mut stage, &disc);
    let numbers = |of: &Matter| (of.kinds, of.mass, of.stiffness, of.damping, of.color);
    assert_eq!(numbers(&later), numbers(&before), "nothing is on its way any more");
    assert!((heights(&stage)[1] - flat).abs() < 0.01);
}

#[test]
fn a_brush_paints_the_numbers_that_are_switched_on_alone_and_as_one_step_of_undo() {
    use super::{Painted, Switched};
    let mut stage = stage();
    let soft = among(3..12);
    let before = matter(&mut stage, &soft);
    let all = Painted::default();
    assert!(!all.is_any() && MatterChange::Painted(all).name() == "brush");
    let numbers = Painted {
        stiffness: Switched { is_on: true, value: 77.0 },
        friction: Switched { is_on: true, value: 0.9 },
        color: Switched { is_on: true, value: [1, 2, 3] },
        ..all
    };
    assert!(numbers.is_any() && !numbers.all_off().is_any() && numbers.all_off().stiffness.value == 77.0);
    change(&mut stage, &soft, MatterChange::Painted(numbers));
    let after = matter(&mut stage, &soft);
    let expected = Matter {
        stiffness: Some(super::Span { least: 77.0, most: 77.0 }),
        friction: Some(super::Span { least: 0.9, most: 0.9 }),
        color: Common::One(Some([1, 2, 3])),
        ..before.clone()
    };
    assert_eq!(after, expected, "mass, damping and all else stay");
    stage.obey(Order::Undo(None));
    assert_eq!(matter(&mut stage, &soft), before, "as one");
    // What is rigid has no stiffness: the rest is painted; nothing but that is refused, with why.
    let rope = among(0..3);
    let heavy = Painted { density: Switched { is_on: true, value: 5.0 }, ..numbers };
    change(&mut stage, &rope, MatterChange::Painted(heavy));
    assert_eq!(matter(&mut stage, &rope).color, Common::One(Some([1, 2, 3])));
    let stiff = Painted { stiffness: numbers.stiffness, ..all };
    assert_eq!(MatterChange::Painted(stiff).name(), "stiffness");
    let why =
        super::commands((stage.history().world(), &super::Former::default()), &rope, MatterChange::Painted(stiff));
    assert!(why.is_err_and(|why| why.contains("rigid")));
}

#[test]
fn ground_is_made_soft_while_it_runs_and_hard_again_by_undo() {
    let text = r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0, 0.5]]}, "drag_rate": 1,
        "obstacles": [{"plane": {"point": [0, 0], "normal": [0, 1]}}, {"box": {"min": [5, 0], "max": [6, 1]}}]}"#;
    let mut stage = stage_of(text);
    let ground = Among { obstacles: vec![0], ..Among::default() };
    assert_eq!(matter(&mut stage, &ground).penalty, Some(None));
    let low = |stage: &Stage| stage.history().world().positions().get(1);
    (0..120).for_each(|_| _ = stage.obey(Order::Step(None)));
    assert!(low(&stage).abs() < 1e-3, "it lies on the ground: {}", low(&stage));
    change(&mut stage, &ground, MatterChange::Penalty(Some([200.0, 20.0])));
    assert_eq!(matter(&mut stage, &ground).penalty, Some(Some([200.0, 20.0])));
    (0..600).for_each(|_| _ = stage.obey(Order::Step(None)));
    let deep = 9.81 / 200.0;
    assert!((low(&stage) + deep).abs() < 0.1 * deep, "{} m, as deep as its weight says", low(&stage));
    // What is written is read again, and undone as one.
    let recording = stage.history().recording();
    let mut bytes = Vec::new();
    recording.write_json(&mut bytes).unwrap();
    let again = crate::history::Log::of_text(&String::from_utf8(bytes).unwrap(), "x.json").unwrap();
    assert_eq!(again.commands().unwrap(), recording.commands);
    stage.obey(Order::Undo(None));
    assert_eq!(matter(&mut stage, &ground).penalty, Some(None));
    // Boxes have none, and where bodies meet there is none: that is said.
    let other = Among { obstacles: vec![1], ..Among::default() };
    assert_eq!(matter(&mut stage, &other).penalty, None);
    let refused = |stage: &mut Stage, among: &Among| {
        let change = MatterChange::Penalty(Some([200.0, 20.0]));
        match stage.obey(Order::Change { among: among.clone(), change, goes_on: false }) {
            Some(Note::Refused(why)) => why,
            other => format!("{other:?}"),
        }
    };
    assert!(refused(&mut stage, &other).contains("is no plane"));
    let mut meets = stage_of(
        r#"{"wobble": 1, "contact": true, "points": {"position": [[0, 0.5]]},
        "obstacles": [{"plane": {"point": [0, 0], "normal": [0, 1]}}]}"#,
    );
    assert!(refused(&mut meets, &ground).contains("contact"));
}

pub(super) fn stage_of(text: &str) -> Stage {
    Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap()
}

#[test]
fn a_velocity_is_that_of_the_middle_and_how_points_move_beside_each_other_stays() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0]], "velocity": [[1, 0], [3, 2], [9, 9]],
        "mass": [1, 3, 1], "pinned": [2]}}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let all = among(0..3);
    stage.obey(Order::Inspect(all.clone()));
    let mut shown = Shown::default();
    stage.show(&mut shown);
    assert_eq!(shown.figures.velocity, Some([2.5, 1.5, 0.0]));
    change(&mut stage, &all, MatterChange::Velocity([0.0, -1.0, 0.0]));
    let world = stage.history().world();
    let [a, b, pin] = [0, 1, 2].map(|point| world.velocity(PointId(point)));
    assert_eq!((a, b, pin), ([-1.5, -2.5, 0.0], [0.5, -0.5, 0.0], [0.0; 3]));
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "velocity"));
    assert_eq!(stage.history().world().velocity(PointId(0)), [1.0, 0.0, 0.0]);
    let pins = Among { points: vec![PointId(2)], ..Among::default() };
    let refused = stage.obey(Order::Change { among: pins, change: MatterChange::Velocity([1.0; 3]), goes_on: false });
    assert!(matches!(refused, Some(Note::Refused(_))), "a pin has none");
}

#[test]
fn what_was_only_just_built_is_as_stiff_at_once_as_it_is_made() {
    let mut stage = stage();
    let soft = among(3..12);
    let strained = |stage: &Stage| {
        let list = super::commands(
            (stage.history().world(), &super::Former::default()),
            &soft,
            MatterChange::Preset(Preset::Wood),
        )
        .unwrap();
        let led = super::led(stage.history().world(), list);
        led.iter().any(|act| matches!(act, Do::Set(keys) if keys.over.is_some()))
    };
    assert!(!strained(&stage), "nothing is lifted by it");
    let pressed = Among { points: vec![PointId(3)], ..Among::default() };
    let keys = crate::history::MoveKeys {
        points: vec![pressed.points[0].0],
        by: Some(crate::scene::Vector::Plane([0.05, 0.05])),
        ..Default::default()
    };
    assert_eq!(stage.obey(Order::Give(vec![Do::Move(Box::new(keys))], None)), None);
    assert!(strained(&stage), "what is loaded is led there");
    let mut fresh = self::stage();
    change(&mut fresh, &soft, MatterChange::Preset(Preset::Wood));
    fresh.obey(Order::Step(None));
    let springs = fresh.history().world().bonds().iter().filter(|bond| matches!(bond.kind, BondKind::Spring { .. }));
    assert_eq!(springs.count(), 0, "it is rigid from the first frame on");
}
