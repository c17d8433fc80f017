//! The cursor and the force about it.

use super::*;

#[test]
fn the_cursor_goes_along_a_line_so_that_frame_rates_agree() {
    let ends: Vec<Sample> = [30_u32, 60, 120]
        .into_iter()
        .map(|rate| {
            let mut world = build(&hovered(1.0)).unwrap();
            world.apply(&Command::Cursor { to: Some(Cursor::at([-3.0, 1.2])), by: 0.0 }).unwrap();
            for frame in 1..=rate {
                let t = f64::from(frame) / f64::from(rate);
                world.apply(&Command::Cursor { to: Some(Cursor::at([-3.0 + 6.0 * t, 1.2])), by: t }).unwrap();
                steps(&mut *world, 1.0 / f64::from(rate));
            }
            now(&*world)
        })
        .collect();
    let apart = |a: &Sample, b: &Sample| {
        let of = |(x, y): (&[f64; 3], &[f64; 3])| (x[0] - y[0]).hypot(x[1] - y[1]);
        a.position.iter().zip(&b.position).map(of).fold(0.0, f64::max)
    };
    assert!(apart(&ends[0], &ends[1]) < 1e-9 && apart(&ends[0], &ends[2]) < 1e-9, "{}", apart(&ends[0], &ends[1]));
    let still = now(&*build(&hovered(1.0)).unwrap());
    assert!(apart(&ends[0], &still) > 0.3, "it moved");
}

#[test]
fn the_mouse_force_is_so_from_now_on_and_its_track_may_end() {
    let mut model = hovered(1.0);
    model.mouse.as_mut().unwrap().track = Track { knots: vec![(0.0, [-3.0, 1.2]), (10.0, [9.0, 1.2])] };
    let mut world = build(&model).unwrap();
    steps(&mut *world, 1.0);
    let stronger = MouseChange { strength: Some(200.0), ..MouseChange::default() };
    world.apply(&Command::Mouse(stronger)).unwrap();
    let (force, at) = world.mouse().unwrap();
    assert_eq!((force.strength, force.radius), (200.0, 1.0));
    assert!((at.origin[0] + 3.0 - 1.2 * world.time()).abs() < 1e-9, "it goes on along its track");
    world.apply(&Command::Mouse(MouseChange { ends_track: true, ..MouseChange::default() })).unwrap();
    assert!(world.mouse().is_none(), "there is no live cursor");
    let mut plain = build(&boxes(1)).unwrap();
    assert!(plain.apply(&Command::Mouse(stronger)).is_err(), "without a radius there is none");
    let whole = MouseChange { radius: Some(0.5), ..stronger };
    assert!(plain.apply(&Command::Mouse(whole)).unwrap().is_something && plain.mouse_force().is_some());
}

#[test]
fn a_fast_cursor_is_swept() {
    // Across the body within one step: with the cursor's ends alone looked at, nothing would be pushed.
    let mut model = hovered(0.4);
    model.method = Method { substep: Some(1.0 / 60.0), ..Method::default() };
    let mut world = build(&model).unwrap();
    world.apply(&Command::Cursor { to: Some(Cursor::at([-4.0, 1.2])), by: 0.0 }).unwrap();
    steps(&mut *world, 1.0 / 60.0);
    let before = now(&*world).velocity;
    world.apply(&Command::Cursor { to: Some(Cursor::at([6.0, 1.2])), by: world.time() + 1.0 / 60.0 }).unwrap();
    steps(&mut *world, 1.0 / 60.0);
    assert!(world.counters().mouse_points > 0);
    let after = now(&*world).velocity;
    assert!((0..4).any(|i| (after[i][1] - before[i][1]).abs() > 1e-3), "{after:?}");
}

#[test]
fn a_ray_that_turns_fast_is_swept_too() {
    // A point in space, 5 m from the eye, between the rays of two frames.
    let mouse = MouseForce {
        strength: 60.0,
        radius: 0.3,
        region: Region::Round,
        profile: Profile::Smooth,
        track: Track::default(),
    };
    let model = Model::<3> {
        position: vec![[0.1, 0.0, 0.0]],
        velocity: vec![[0.0; 3]],
        mass: vec![1.0],
        mouse: Some(mouse),
        method: Method { substep: Some(1.0 / 60.0), ..Method::default() },
        ..Model::default()
    };
    let ray = |x: f64| {
        let length = x.hypot(5.0);
        Some(Cursor { origin: [0.0, 0.0, 5.0], direction: [x / length, 0.0, -5.0 / length] })
    };
    let mut world = build(&model).unwrap();
    world.apply(&Command::Cursor { to: ray(-4.0), by: 0.0 }).unwrap();
    world.step();
    assert_eq!(world.counters().mouse_points, 0, "out of reach");
    world.apply(&Command::Cursor { to: ray(4.5), by: world.time() + 1.0 / 60.0 }).unwrap();
    world.step();
    assert!(world.counters().mouse_points > 0, "it is passed on the way");
    assert!(now(&*world).velocity[0].iter().any(|v| v.abs() > 1e-5), "{:?}", now(&*world).velocity);
}
