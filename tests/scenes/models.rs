//! What scenes mean: models by hand, expansion, numbering over explicit points and bodies.

use std::f64::consts::TAU;

use wobble::scene::{Entry, MakerName, Meeting, Row, Scene, SolverName, gallery};
use wobble::sim::{BondKind, Limit, Model, PointId, Profile, Region, Solver};

fn scene(text: &str) -> Scene {
    Scene::parse(text, "x.json").unwrap_or_else(|error| panic!("{error}"))
}

/// A pendulum with everything said, as reference problems have it.
const PENDULUM: &str = r#"{"wobble":1,"name":"B5","points":{"position":[[0.0,0.0],[1.0,0.0]],
    "velocity":[[0.0,0.0],[0.0,0.5]],"mass":[1.0,2.0],"pinned":[0]},"gravity":[0,-9.81],"drag_rate":0.25,
    "duration":3.0,"samples":[0.75,1.5,2.25,3.0],
    "bonds":[{"a":0,"b":1,"kind":"spring","rest":1.25,"stiffness":200.0,"damping":2.0,"limit":"max"}]}"#;

#[test]
fn explicit_points_and_bonds_come_out_as_said() {
    let scene = scene(PENDULUM);
    let model: Model<2> = scene.model().unwrap();
    assert_eq!(model.position, [[0.0, 0.0], [1.0, 0.0]]);
    assert_eq!(model.velocity, [[0.0, 0.0], [0.0, 0.5]]);
    assert_eq!(model.mass, [1.0, 2.0]);
    assert_eq!(model.pinned, [PointId(0)]);
    assert_eq!(model.gravity, [0.0, -9.81]);
    assert_eq!((model.drag_rate, model.duration), (0.25, Some(3.0)));
    let bond = model.bonds.get(0);
    assert_eq!((bond.a, bond.b, bond.rest_length), (PointId(0), PointId(1), 1.25));
    assert_eq!((bond.kind, bond.limit), (BondKind::Spring { stiffness: 200.0, damping: 2.0 }, Limit::Max));
    assert_eq!(scene.sample_times(), [0.75, 1.5, 2.25, 3.0]);
    assert_eq!((scene.rate(), scene.dimensions()), (1.0, 2));
}

#[test]
fn what_is_not_said_has_the_value_of_the_specification() {
    let scene = scene(
        r#"{"wobble":1,"points":{"position":[[0,0],[3,4]]},"bonds":[{"a":1,"b":0}],"duration":2,
        "mouse":{"strength":-7,"radius":2},"bounds":{"min":[-5,-5],"max":[5,5]}}"#,
    );
    let model: Model<2> = scene.model().unwrap();
    assert_eq!(model.velocity, [[0.0; 2]; 2]);
    assert_eq!(model.mass, [1.0; 2]);
    assert!(model.pinned.is_empty());
    assert_eq!((model.gravity, model.drag_rate), ([0.0; 2], 0.0));
    let bond = model.bonds.get(0);
    assert_eq!((bond.rest_length, bond.kind, bond.limit), (5.0, BondKind::Rigid, Limit::Both));
    let mouse = model.mouse.unwrap();
    assert_eq!((mouse.region, mouse.profile), (Region::Round, Profile::Smooth));
    assert!(mouse.track.knots.is_empty());
    let bounds = model.bounds.unwrap();
    assert_eq!((bounds.restitution, bounds.friction), (0.0, 0.0));
    assert_eq!(
        model.method,
        wobble::sim::Method { sleeps: true, settles: true, budget: Some(6.0), ..Default::default() }
    );
    assert_eq!(scene.sample_times(), [2.0]);
}

#[test]
fn a_scene_in_space_needs_a_model_in_space() {
    let scene = scene(
        r#"{"wobble":1,"dimensions":3,"points":{"position":[[0,0,0],[1,2,2]],"mass":3},
        "bonds":[{"a":0,"b":1}],"gravity":[0,-9.81,1],"mouse":{"strength":1,"radius":1,"track":[[0,1,2],[1,3,4]]}}"#,
    );
    let model: Model<3> = scene.model().unwrap();
    assert_eq!(model.bonds.get(0).rest_length, 3.0);
    assert_eq!(model.mass, [3.0, 3.0]);
    let track = model.mouse.unwrap().track;
    assert_eq!(track.knots, [(0.0, [1.0, 2.0]), (1.0, [3.0, 4.0])]);
    assert_eq!(scene.model::<2>().unwrap_err().to_string(), "x.json:1: dimensions: the scene has 3 dimensions, not 2");
}

#[test]
fn bodies_follow_the_explicit_points_and_bonds() {
    let scene = scene(
        r#"{"wobble":1,"points":{"position":[[9,9]],"pinned":[0,0]},
        "bonds":[{"a":0,"b":3,"kind":"spring","stiffness":1}],
        "bodies":[{"make":"rope","count":2,"to":[0,2],"origin":[1,0],"pinned":[1]},
                  {"make":"box","width":2,"height":2,"spin":3,"velocity":[1,0],
                   "material":{"kind":"spring","compliance":0.5,"mass":8}}]}"#,
    );
    let model: Model<2> = scene.model().unwrap();
    assert_eq!(model.position.len(), 7);
    assert_eq!(model.position[1..4], [[1.0, 0.0], [1.0, 2.0], [-1.0, -1.0]]);
    assert_eq!(model.velocity[3], [1.0 + 3.0, -3.0]);
    assert_eq!(model.mass, [1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0]);
    assert_eq!(model.pinned, [PointId(0), PointId(2)]);
    assert_eq!(model.bonds.len(), 1 + 1 + 5);
    assert_eq!((model.bonds.get(1).a, model.bonds.get(1).b), (PointId(1), PointId(2)));
    assert_eq!((model.bonds.get(2).a, model.bonds.get(2).b), (PointId(3), PointId(4)));
    assert_eq!(model.bonds.get(1).kind, BondKind::Rigid);
    assert_eq!(model.bonds.get(2).kind, BondKind::Spring { stiffness: 2.0, damping: 0.0 });
}

#[test]
fn a_body_is_repeated_along_x_then_y_then_z() {
    let planar = scene(
        r#"{"wobble":1,"points":{"position":[[9,9]]},
        "bodies":[{"make":"rope","count":2,"spacing":1,"origin":[1,2],"pinned":[1],"material":{"mass":3},
                   "repeat":{"count":[2,3],"step":[5,-4]}},
                  {"make":"box","width":2,"height":2}],
        "pin_motion":[{"point":10,"track":[[0,1,1]]}]}"#,
    );
    let model: Model<2> = planar.model().unwrap();
    assert_eq!(model.position.len(), 1 + 2 * 6 + 4);
    let starts: Vec<[f64; 2]> = (0..6).map(|copy| model.position[1 + 2 * copy]).collect();
    assert_eq!(starts, [[1.0, 2.0], [6.0, 2.0], [1.0, -2.0], [6.0, -2.0], [1.0, -6.0], [6.0, -6.0]]);
    assert_eq!(model.pinned, [2, 4, 6, 8, 10, 12].map(PointId));
    assert!(model.mass[1..13].iter().all(|&mass| mass == 1.5));
    assert_eq!((model.bonds.len(), model.bonds.get(5).a, model.bonds.get(6).a), (6 + 5, PointId(11), PointId(13)));
    let spatial = scene(
        r#"{"wobble":1,"dimensions":3,"bodies":[{"make":"points","count":1,"min":[0,0,0],"max":[0,0,0],
        "repeat":{"count":[1,2,2],"step":[1,2,3]}}]}"#,
    );
    let model: Model<3> = spatial.model().unwrap();
    assert_eq!(model.position, [[0.0; 3], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [0.0, 2.0, 3.0]]);
}

#[test]
fn repeats_that_make_too_many_bonds_are_refused() {
    let graph = scene(
        r#"{"wobble":1,"bodies":[{"make":"random-graph","count":1000,"bonds":400000,"min":[0,0],"max":[1,1],
        "repeat":{"count":[100,3],"step":[1,1]}}]}"#,
    );
    let error = graph.model::<2>().unwrap_err().to_string();
    assert_eq!(error, "x.json:2: bodies[0].repeat: makes 120000000 bonds: 100000000 are the most");
}

#[test]
fn a_call_may_override_the_method() {
    let mut scene = Scene::load("rim").unwrap();
    scene.method.solver = Some("relaxation".parse().unwrap());
    assert!(scene.model::<2>().is_err());
    scene.method.solver = Some(SolverName::Verlet);
    scene.method.substep = Some(0.01);
    let model: Model<2> = scene.model().unwrap();
    assert_eq!((model.method.solver, model.method.substep), (Solver::Verlet, Some(0.01)));
    scene.method.substep = Some(-1.0);
    assert_eq!(scene.model::<2>().unwrap_err().to_string(), "rim.json: method.substep: is -1.0: give a number above 0");
    assert_eq!("verlett".parse::<SolverName>().unwrap_err(), "`verlett` is not a solver: did you mean `verlet`?");
}

#[test]
fn an_expanded_scene_has_the_same_model_bit_for_bit() {
    let every_maker = scene(
        r#"{"wobble":1,"points":{"position":[[0.1,0.2]],"mass":0.3,"pinned":[0]},
        "bodies":[{"make":"points","count":5,"min":[-1,-1],"max":[1,1],"seed":3,"spin":0.1},
                  {"make":"random-graph","count":6,"bonds":9,"min":[-1,-1],"max":[1,1],"pinned":[5]},
                  {"make":"rim","angle":0.7,"origin":[0.3,-0.1],"material":{"kind":"spring","compliance":0.003,"mass":7}},
                  {"make":"box","width":0.3,"height":0.7,"supports":2,"velocity":[0.1,0.2],"spin":-0.7},
                  {"make":"rope","count":7,"to":[0.1,0.7],"material":{"compliance":0.7,"mass":0.1}},
                  {"make":"cloth","columns":4,"rows":3,"spacing":0.1,"diagonals":"one","angle":-2.1,
                   "material":{"kind":"relaxed","relaxation":0.7,"max_correction":0.3,"point_mass":0.7}},
                  {"make":"disc","radius":0.7,"spacing":0.1,"angle":0.1,"repeat":{"count":[3,2],"step":[0.3,-0.7]},
                   "material":{"mass":0.3},"pinned":[4]},
                  {"make":"lattice","columns":3,"rows":4,"spacing":0.3,"material":{"kind":"spring","stiffness":3,"damping":0.1}},
                  {"make":"ragdoll","height":0.9,"angle":0.4,"repeat":{"count":[2,1],"step":[1,0]},"material":{"mass":7}}],
        "method":{"substep":0.01,"iterations":3}}"#,
    );
    let meeting = Scene { contact: Some(Meeting::Is(true)), ..every_maker.clone() };
    let mut scenes = vec![every_maker, meeting];
    let small = gallery().iter().filter(|entry| entry.is_small()).map(|entry| entry.scene().unwrap());
    let (flat, in_space): (Vec<Scene>, Vec<Scene>) = small.partition(|scene| scene.dimensions() == 2);
    scenes.extend(flat);
    for scene in scenes {
        let expanded = scene.expanded().unwrap();
        assert!(expanded.bodies.is_empty());
        let again = Scene::parse(&expanded.to_json().unwrap(), "again").unwrap();
        let (mut model, other): (Model<2>, Model<2>) = (scene.model().unwrap(), again.model().unwrap());
        let is_drawn = scene.bodies.iter().any(|body| body.make == MakerName::Picture);
        if scene.contact.is_none() && !is_drawn && !scene.bodies.is_empty() {
            // Nobody asks what they cover.
            assert_eq!(again.triangles, scene.triangles);
            model.triangles.truncate(scene.triangles.len());
        }
        // Debug output tells -0.0 from 0.0 and prints every digit: equal text is equal bits.
        assert_eq!(format!("{model:?}"), format!("{other:?}"));
    }
    let cloth = scene(
        r#"{"wobble":1,"dimensions":3,"bodies":[{"make":"cloth","columns":3,"rows":3,"spacing":0.7,
        "u":[1,2,3],"v":[0,1,-1],"angle":0.3,"spin":1,"velocity":[0,0,1]}]}"#,
    );
    for scene in in_space.into_iter().chain([cloth]) {
        let (mut model, other): (Model<3>, Model<3>) =
            (scene.model().unwrap(), scene.expanded().unwrap().model().unwrap());
        model.triangles.truncate(if scene.contact.is_none() { 0 } else { model.triangles.len() });
        assert_eq!(format!("{model:?}"), format!("{other:?}"));
    }
}

/// Twice the area of a triangle [m^2]: above 0 anticlockwise.
fn twice_area(model: &Model<2>, corners: &[PointId; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| model.position[corner.index()]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[test]
fn bodies_that_enclose_an_area_cover_it() {
    let polygon = |corners: f64, radius: f64| 0.5 * corners * radius * radius * (TAU / corners).sin();
    for (keys, count, area) in [
        (r#""make":"points","count":5,"min":[0,0],"max":[1,1]"#, 0, 0.0),
        (r#""make":"random-graph","count":6,"bonds":9,"min":[0,0],"max":[1,1]"#, 0, 0.0),
        (r#""make":"rope","count":7,"spacing":0.1"#, 0, 0.0),
        (r#""make":"cloth","columns":4,"rows":3,"spacing":0.1"#, 0, 0.0),
        (r#""make":"lattice","columns":4,"rows":3,"spacing":0.5"#, 12, 1.5),
        (r#""make":"box","width":0.3,"height":0.7,"supports":0"#, 2, 0.21),
        (r#""make":"rim","radius":2,"inner_radius":1,"sectors":7"#, 14, polygon(7.0, 2.0) - polygon(7.0, 1.0)),
        (
            r#""make":"rim","radius":2,"inner_radius":1,"sectors":7,"bracing":["falling"]"#,
            14,
            polygon(7.0, 2.0) - polygon(7.0, 1.0),
        ),
        (r#""make":"disc","radius":1,"spacing":0.25"#, 105, polygon(25.0, 1.0)),
    ] {
        let text = format!(
            r#"{{"wobble":1,"points":{{"position":[[9,9]]}},"bodies":[{{{keys},"angle":0.4,"origin":[3,1]}}]}}"#
        );
        let model: Model<2> = scene(&text).model().unwrap();
        let areas: Vec<f64> = model.triangles.iter().map(|corners| 0.5 * twice_area(&model, corners)).collect();
        assert!(areas.iter().all(|&area| area > 0.0), "{keys}: anticlockwise");
        assert!((areas.iter().sum::<f64>() - area).abs() < 1e-12, "{keys}: {}", areas.iter().sum::<f64>());
        assert_eq!(areas.len(), count, "{keys}");
        // A side is of two triangles at most, each on its side of it.
        let sides = model.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let mut sides: Vec<_> = sides.collect();
        sides.sort_unstable();
        assert!(sides.windows(2).all(|pair| pair[0] != pair[1]), "{keys}");
    }
    let picture: Model<2> = Scene::load("gear").unwrap().model().unwrap();
    assert!(
        !picture.triangles.is_empty() && picture.triangles.iter().all(|corners| twice_area(&picture, corners) > 0.0)
    );
}

#[test]
fn triangles_that_are_listed_come_first_and_anticlockwise() {
    let scene = scene(
        r#"{"wobble":1,"points":{"position":[[0,0],[1,0],[0,1]]},"triangles":[[0,2,1],[0,1,2]],
        "bodies":[{"make":"box","width":1,"height":1,"repeat":{"count":[2,1],"step":[3,0]}}]}"#,
    );
    let model: Model<2> = scene.model().unwrap();
    let all = [[0, 1, 2], [0, 1, 2], [3, 4, 5], [3, 5, 6], [7, 8, 9], [7, 9, 10]];
    assert_eq!(model.triangles, all.map(|corners| corners.map(PointId)));
    // On a body they stand in place of its own: those of the gallery's rim lie along the other diagonals.
    let rim = Scene::load("rim").unwrap();
    let listed = rim.triangles.iter().map(|&Row([a, b, c])| [a, c, b].map(PointId));
    let listed: Vec<_> = listed.collect();
    assert_eq!((rim.model::<2>().unwrap().triangles, listed.len()), (listed, 24));
}

#[test]
fn bodies_of_the_gallery_that_share_a_space_meet() {
    // The others have one body that cannot reach itself, loose points, bodies far apart, or a method of the sources that knows no contact.
    let meet = [
        "box",
        "box-two-supports",
        "bridge",
        "brush",
        "catapult",
        "cloth-ball",
        "cloth-space",
        "cradle",
        "gear",
        "jelly",
        "jelly-stack",
        "jellyfish",
        "maze",
        "pebble",
        "pegs",
        "picture-obstacle",
        "ragdoll",
        "ring",
        "snake",
        "soft-car",
        "wrecking-ball",
    ];
    let told = |entry: &Entry| {
        let world = entry.scene().unwrap().world(None).unwrap();
        let islands: usize = world.moved_by().iter().map(|moved| moved.islands).sum();
        (entry.name, world.contact().is_some(), if world.bonds().is_empty() { 0 } else { islands })
    };
    let all: Vec<(&str, bool, usize)> = gallery().iter().map(told).collect();
    let mut found: Vec<&str> = all.iter().filter(|(_, meets, _)| *meets).map(|(name, ..)| *name).collect();
    found.sort_unstable();
    assert_eq!(found, meet);
    let apart = [
        "constraints",
        "penalty",
        "phase-portrait",
        "relaxation",
        "spring-damper",
        "spring-damper-as-printed",
        "spring-damper-relative",
        "spring-damper-relative-as-printed",
        "thousand-rims",
    ];
    for (name, _, islands) in all.iter().filter(|(name, meets, _)| !meets && !name.starts_with("slide-")) {
        assert!(*islands <= 1 || apart.contains(name), "{name} has {islands} bodies, which do not meet");
    }
}
