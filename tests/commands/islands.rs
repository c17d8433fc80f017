//! Islands: a command cuts the steps of those that it touches, and all others keep their bits.

use super::*;

#[test]
fn islands_that_an_edit_does_not_name_keep_their_bits() {
    let edits: Vec<(&str, Command)> = vec![
        ("pin", Command::Pin(vec![PointId(9)])),
        ("cut", Command::Cut { from: Cursor::at([7.5, 1.2]), to: Cursor::at([10.0, 1.3]) }),
        ("delete a point", Command::Delete(Selection { points: vec![PointId(10)], ..Selection::default() })),
        ("delete a bond", Command::Delete(Selection { bonds: vec![BondId(13)], ..Selection::default() })),
        ("add", square(24, [40.0, 3.0])),
        (
            "move",
            Command::Move(Motion {
                points: numbers(8..12),
                by: [0.3, 2.0, 0.0],
                turn: 0.4,
                scale: [1.2; 3],
                ..Motion::default()
            }),
        ),
        (
            "mass",
            Command::Set(Change::Points {
                points: vec![PointId(8)],
                mass: Some(Values::Same(3.0)),
                velocity: None,
                skin: SkinMaterial::default(),
            }),
        ),
        (
            "stiffness",
            Command::Set(Change::Bonds {
                bonds: vec![BondId(12)],
                to: Box::new(BondChange { stiffness: Some(Values::Same(50.0)), ..BondChange::default() }),
            }),
        ),
    ];
    let model = boxes(6);
    for (name, edit) in edits {
        let mut plain = build(&model).unwrap();
        let mut edited = build(&model).unwrap();
        steps(&mut *plain, 0.3);
        steps(&mut *edited, 0.3);
        assert!(edited.apply(&edit).unwrap().is_something, "{name}");
        steps(&mut *plain, 0.7);
        steps(&mut *edited, 0.7);
        let (plain, edited) = (now(&*plain), now(&*edited));
        for far in [0..8, 12..24] {
            assert_eq!(bits(&plain, far.clone()), bits(&edited, far), "{name}");
        }
        if name != "add" {
            assert_ne!(bits(&plain, 8..12), bits(&edited, 8..12), "{name} does something");
        }
    }
}

/// Two fifths of the way through the step under way.
fn within_a_step(world: &mut dyn Dynamics) {
    let time = world.time() + 0.4 * world.substep();
    world.step_until(time);
    assert_eq!(world.time().to_bits(), time.to_bits());
}

#[test]
fn a_command_within_a_step_cuts_the_step_of_what_it_touches_alone() {
    let cursor = |x: f64, by: f64| Command::Cursor { to: Some(Cursor::at([x, 1.5])), by };
    let mut model = boxes(6);
    model.mouse = hovered(0.8).mouse;
    type Edit = Box<dyn Fn(&dyn Dynamics) -> Vec<Command>>;
    let edits: Vec<(&str, Edit)> = vec![
        ("nothing", Box::new(|_| vec![Command::Cut { from: Cursor::at([50.0, 1.0]), to: Cursor::at([51.0, 1.0]) }])),
        ("pin", Box::new(|_| vec![Command::Pin(vec![PointId(9)])])),
        ("cut", Box::new(|_| vec![Command::Cut { from: Cursor::at([7.5, 1.2]), to: Cursor::at([10.0, 1.3]) }])),
        ("add", Box::new(|_| vec![square(24, [40.0, 3.0])])),
        ("cursor", Box::new(move |world| vec![cursor(8.5, world.time()), cursor(9.0, world.time() + 0.001)])),
        (
            "grab",
            Box::new(move |world| vec![cursor(8.5, world.time()), Command::Grab(Reach::Points(vec![PointId(9)]))]),
        ),
        (
            "stronger mouse",
            Box::new(move |world| {
                let stronger = MouseChange { strength: Some(30.0), ..MouseChange::default() };
                vec![cursor(8.5, world.time()), Command::Mouse(stronger)]
            }),
        ),
    ];
    for (name, edit) in edits {
        let mut plain = build(&model).unwrap();
        let mut edited = build(&model).unwrap();
        let grid = plain.substep();
        steps(&mut *plain, 0.3);
        steps(&mut *edited, 0.3);
        let start = edited.time();
        within_a_step(&mut *edited);
        edit(&*edited).iter().for_each(|command| assert!(edited.apply(command).is_ok(), "{name}"));
        // Once more in the same step, elsewhere.
        within_a_step(&mut *edited);
        edited.apply(&Command::Pin(vec![PointId(17)])).unwrap();
        edited.step();
        plain.step();
        assert_eq!(edited.time().to_bits(), plain.time().to_bits(), "{name}: the grid stays");
        assert!((edited.time() - start - grid).abs() < 1e-12);
        steps(&mut *plain, 0.2);
        steps(&mut *edited, 0.2);
        let (plain, edited) = (now(&*plain), now(&*edited));
        for far in [0..8, 12..16, 20..24] {
            assert_eq!(bits(&plain, far.clone()), bits(&edited, far), "{name}");
        }
        assert_ne!(bits(&plain, 16..20), bits(&edited, 16..20), "{name}: what was pinned");
        let is_same = bits(&plain, 8..12) == bits(&edited, 8..12);
        assert_eq!(is_same, name == "nothing" || name == "add", "{name}");
    }
}

#[test]
fn a_command_within_a_step_counts_from_its_time() {
    // A free point under gravity is stopped within a step: from there it falls anew.
    let model = Model { position: vec![[0.0; 2]; 2], velocity: vec![[0.0; 2]; 2], mass: vec![1.0; 2], ..boxes(0) };
    let model = Model { bounds: None, ..model };
    let mut world = build(&model).unwrap();
    steps(&mut *world, 0.5);
    within_a_step(&mut *world);
    let t = world.time();
    let place = now(&*world).position[0][1];
    assert!((place + 0.5 * 9.81 * t * t).abs() < 1e-9, "{place}");
    let stop = Change::Points {
        points: vec![PointId(0)],
        mass: None,
        velocity: Some(vec![[0.0; 3]]),
        skin: SkinMaterial::default(),
    };
    world.apply(&Command::Set(stop)).unwrap();
    steps(&mut *world, 0.5);
    let fallen = world.time() - t;
    let after = now(&*world);
    assert!((after.position[0][1] - place + 0.5 * 9.81 * fallen * fallen).abs() < 1e-9);
    assert!((after.velocity[0][1] + 9.81 * fallen).abs() < 1e-9);
}

#[test]
fn a_fast_cursor_and_a_break_cut_the_steps_of_what_they_touch_alone() {
    let mut model = boxes(4);
    model.mouse = hovered(0.5).mouse;
    model.gravity = [0.0; 2];
    // The third body flies apart: one of its bonds breaks within a step.
    let brittle = Bond { break_strain: 0.05, ..model.bonds.get(12) };
    model.bonds.set(12, brittle);
    let mut plain = build(&model).unwrap();
    model.velocity[8] = [-3.0, 0.0];
    let mut torn = build(&model).unwrap();
    for world in [&mut plain, &mut torn] {
        world.apply(&Command::Cursor { to: Some(Cursor::at([50.0, 1.5])), by: 0.0 }).unwrap();
    }
    for step in 0..60 {
        let x = if step % 2 == 0 { 90.0 } else { 40.0 };
        let by = torn.time() + torn.substep();
        torn.apply(&Command::Cursor { to: Some(Cursor::at([x, 1.5])), by }).unwrap();
        torn.step();
        plain.step();
    }
    assert_eq!(torn.counters().bonds_torn, 1);
    assert_eq!(plain.counters().bonds_torn, 0);
    let (plain, torn) = (now(&*plain), now(&*torn));
    for far in [0..8, 12..16] {
        assert_eq!(bits(&plain, far.clone()), bits(&torn, far));
    }
}
