//! Worlds in which bodies meet: what commands leave of them, and that they may begin and cease to meet.

use wobble::sim::{Contact, Convex, Figure, PlanPart, Solver};

use super::*;

/// Squares as of `boxes`, each covered by two triangles, in a row on pins at both ends, which meet.
fn meeting(count: u32) -> Model<2> {
    let squares = (0..count).map(|k| 4 * k);
    let triangles = squares.flat_map(|at| [[at, at + 1, at + 2], [at, at + 2, at + 3]]);
    Model {
        triangles: triangles.map(|corners| corners.map(PointId)).collect(),
        contact: Some(Contact::default()),
        ..boxes(count)
    }
}

fn corners(world: &dyn Dynamics) -> Vec<[u32; 3]> {
    world.triangles().iter().map(|corners| corners.map(|corner| corner.0)).collect()
}

/// The corners of each, ascending: what comes clockwise is turned.
fn sorted(mut list: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    list.iter_mut().for_each(|corners| corners.sort_unstable());
    list
}

/// Whether all that moves is moved by the live step, in one part.
fn is_live(world: &dyn Dynamics) -> bool {
    matches!(world.parts(), [PlanPart { solver: Solver::Live, .. }])
}

fn set(change: SceneChange) -> Command {
    Command::Set(Change::Scene(Box::new(change)))
}

fn contact(contact: Option<Contact>) -> Command {
    set(SceneChange { contact: Some(contact), ..SceneChange::default() })
}

#[test]
fn triangles_go_with_corners_and_with_bonds_along_their_sides() {
    let points =
        |points: &[u32]| Selection { points: points.iter().map(|&i| PointId(i)).collect(), ..Selection::default() };
    let bonds = |bonds: &[u32]| Selection { bonds: bonds.iter().map(|&k| BondId(k)).collect(), ..Selection::default() };
    let (first, second) = (vec![[0, 1, 2], [0, 2, 3]], vec![[4, 5, 6], [4, 6, 7]]);
    let all = [&first[..], &second].concat();
    for (what, command, left) in [
        ("a corner of one", Command::Delete(points(&[1])), [&first[1..], &second].concat()),
        ("a corner of both", Command::Delete(points(&[2])), second.clone()),
        // The bonds of a square: four sides, the diagonal that the triangles share, the other one.
        ("a side", Command::Delete(bonds(&[3])), [&first[..1], &second].concat()),
        ("the shared side", Command::Delete(bonds(&[10])), first.clone()),
        ("the other diagonal", Command::Delete(bonds(&[5, 11])), all.clone()),
        (
            "a stroke",
            Command::Cut { from: Cursor::at([-0.5, 1.9]), to: Cursor::at([0.1, 1.9]) },
            [&first[..1], &second].concat(),
        ),
        ("all", Command::Clear, Vec::new()),
        ("a pin", Command::Pin(vec![PointId(0)]), all.clone()),
    ] {
        for contact in [Some(Contact::default()), None] {
            let mut world = build(&Model { contact, ..meeting(2) }).unwrap();
            assert_eq!(corners(&*world), all);
            assert!(world.apply(&command).unwrap().is_something, "{what}");
            assert_eq!(corners(&*world), left, "{what}");
            steps(&mut *world, 0.1);
            assert_eq!((corners(&*world), world.contact()), (left.clone(), contact), "{what}");
        }
    }
}

#[test]
fn a_bond_that_breaks_takes_its_triangles_along() {
    for contact in [Some(Contact::default()), None] {
        let mut model = Model { contact, gravity: [0.0; 2], bounds: None, ..meeting(1) };
        let weak = Bond { break_strain: 0.3, ..model.bonds.get(0) };
        model.bonds.set(0, weak);
        (model.velocity[0], model.velocity[1]) = ([-30.0, 0.0], [30.0, 0.0]);
        let mut world = build(&model).unwrap();
        steps(&mut *world, 0.5);
        assert_eq!(world.counters().bonds_torn, 1);
        assert_eq!(corners(&*world), [[0, 2, 3]]);
    }
}

#[test]
fn triangles_come_by_commands_between_points_that_are_there() {
    let mut world = build(&meeting(2)).unwrap();
    let cover = |triangles: &[[u32; 3]]| {
        let triangles = triangles.iter().map(|corners| corners.map(PointId)).collect();
        Command::Add(Box::new(Addition { triangles, ..Addition::default() }))
    };
    world.apply(&Command::Delete(Selection { points: vec![PointId(7)], ..Selection::default() })).unwrap();
    for (triangle, why) in [([0, 1, 1], "three points"), ([0, 1, 99], "no point 99"), ([0, 1, 7], "no point 7")] {
        let error = world.apply(&cover(&[triangle])).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
    let before = corners(&*world);
    world.apply(&cover(&[[1, 4, 2]])).unwrap();
    assert_eq!(corners(&*world), [&before[..], &[[1, 4, 2]]].concat());
    let Command::Add(mut addition) = square(8, [3.0, 5.0]) else { panic!("a square is added") };
    addition.triangles = vec![[8, 9, 10].map(PointId), [8, 10, 0].map(PointId)];
    world.apply(&Command::Add(addition)).unwrap();
    assert_eq!(corners(&*world)[before.len() + 1..], [[8, 9, 10], [8, 0, 10]]);
    assert!(is_live(&*world), "{:?}", world.parts());
    steps(&mut *world, 0.2);
}

#[test]
fn bodies_begin_and_cease_to_meet() {
    let apart = Model { contact: None, ..meeting(3) };
    let mut world = build(&apart).unwrap();
    steps(&mut *world, 0.1);
    assert!(!is_live(&*world) && world.contact().is_none());
    let (topology, before) = (world.topology(), now(&*world));
    let slippery = Contact { friction: 0.0, restitution: 0.5, ..Contact::default() };
    assert!(world.apply(&contact(Some(slippery))).unwrap().is_something);
    assert!(is_live(&*world) && world.contact() == Some(slippery), "{:?}", world.parts());
    assert_eq!(world.parts()[0].islands, 3);
    assert_eq!(now(&*world).position, before.position);
    assert_ne!(world.topology(), topology);
    assert!(!world.apply(&contact(Some(slippery))).unwrap().is_something, "nothing new");
    steps(&mut *world, 0.1);
    let usual = |of: fn(&mut Contact)| {
        let mut contact = Contact::default();
        of(&mut contact);
        contact
    };
    for (wrong, why) in [
        (contact(Some(usual(|contact| contact.friction = -1.0))), "contact.friction is -1.0"),
        (contact(Some(usual(|contact| contact.friction = f64::INFINITY))), "contact.friction is inf"),
        (contact(Some(usual(|contact| contact.restitution = 2.0))), "contact.restitution is 2.0"),
        (contact(Some(usual(|contact| contact.restitution = f64::NAN))), "contact.restitution is NaN"),
        (contact(Some(usual(|contact| contact.radius = Some(f64::NAN)))), "contact.radius is NaN"),
        (contact(Some(usual(|contact| contact.radius = Some(-1e-9)))), "contact.radius is -1e-9"),
        (
            set(SceneChange {
                method: Some(Method { solver: Solver::Rk4, ..Method::default() }),
                ..SceneChange::default()
            }),
            "solver rk4 knows no contact: leave `solver` out",
        ),
    ] {
        let error = world.apply(&wrong).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
    assert!(world.apply(&contact(None)).unwrap().is_something);
    assert!(!is_live(&*world) && world.contact().is_none() && world.parts().len() > 1, "{:?}", world.parts());
    steps(&mut *world, 0.1);
    let alone = Method { solver: Solver::Live, ..Method::default() };
    world.apply(&set(SceneChange { method: Some(alone), ..SceneChange::default() })).unwrap();
    assert!(is_live(&*world), "{:?}", world.parts());
    assert_eq!(corners(&*world), corners(&*build(&apart).unwrap()));
}

#[test]
fn models_of_bodies_that_meet_are_checked() {
    let error = |change: fn(&mut Model<2>)| {
        let mut model = meeting(1);
        change(&mut model);
        build(&model).err().unwrap().to_string()
    };
    assert_eq!(error(|model| model.triangles[1][2] = PointId(4)), "triangle 1 names point 4, but there are 4 points");
    assert_eq!(
        error(|model| model.triangles[0][1] = PointId(0)),
        "triangle 0 is [0, 0, 2]: it must be of three points"
    );
    assert!(error(|model| model.contact.as_mut().unwrap().friction = f64::NAN).starts_with("contact.friction is NaN"));
    assert!(error(|model| model.method.solver = Solver::Path).starts_with("solver path knows no contact"));
    assert!(error(|model| model.method.tolerance = Some(0.1)).starts_with("no tolerance is held to"));
    let ball = Convex { figure: Figure::Ball { center: [0.0; 3], radius: 1.0 }, restitution: 0.0, friction: 0.0 };
    let space = |convex, solver| {
        let model = Model::<3> { convex, method: Method { solver, ..Method::default() }, ..Model::default() };
        build(&model).err().unwrap().to_string()
    };
    assert!(space(vec![ball], Solver::Rk4).starts_with("solver rk4 does not meet balls and boxes in space"));
    let figure = Figure::Ball { center: [0.0; 3], radius: f64::NAN };
    assert!(space(vec![Convex { figure, ..ball }], Solver::Auto).starts_with("ball or box 0 is"));
    let settled = wobble::equilibrium::settle(&meeting(1));
    assert!(settled.unwrap_err().to_string().contains("where bodies meet"));
}

/// What is left of triangles by the law, said in another way: by the numbers of points and bonds.
fn expected(before: &dyn Dynamics, after: &dyn Dynamics, command: &Command) -> Vec<[u32; 3]> {
    let named = |world: &dyn Dynamics| -> Vec<(u32, [u32; 2])> {
        let ends = world.bonds().ends().iter().enumerate();
        let number = |place: usize| world.bond_numbers().map_or(place as u32, |numbers| numbers[place]);
        ends.map(|(place, ends)| (number(place), ends.map(|end| end.0))).collect()
    };
    let kept: Vec<u32> = named(after).iter().map(|bond| bond.0).collect();
    let mut all = corners(before);
    if let Command::Add(addition) = command {
        all.extend(addition.triangles.iter().map(|corners| corners.map(|corner| corner.0)));
    }
    let went: Vec<[u32; 2]> =
        named(before).into_iter().filter(|(number, _)| !kept.contains(number)).map(|bond| bond.1).collect();
    all.retain(|corners| {
        let is_gone = corners.iter().any(|&corner| after.gone().contains(&PointId(corner)));
        let is_cut = went.iter().any(|ends| ends.iter().all(|end| corners.contains(end)));
        !is_gone && !is_cut
    });
    all
}

#[test]
fn random_commands_leave_bodies_that_meet_together() {
    for seed in 0..20 {
        let mut generator = Generator::new(seed);
        let mut world = build(&meeting(3)).unwrap();
        let mut done = 0;
        for _ in 0..40 {
            let command = generator.command(&*world);
            let before = world.boxed_clone();
            let when = format!("seed {seed} after {command:?}");
            if world.apply(&command).is_ok() {
                done += 1;
                assert_eq!(sorted(corners(&*world)), sorted(expected(&*before, &*world, &command)), "{when}");
            } else {
                assert_eq!(corners(&*world), corners(&*before), "{when}");
            }
            assert!(world.parts().is_empty() || is_live(&*world), "{when}: {:?}", world.parts());
            steps(&mut *world, 1.0 / 60.0);
            agrees(&*world, &when);
        }
        assert!(done > 15, "seed {seed}: {done} done");
    }
}
