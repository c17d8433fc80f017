//! The same bits for every instruction set and any number of threads.

use rayon::ThreadPoolBuilder;
use wobble::scene::Scene;
use wobble::scene::record::hash;
use wobble::sim::{Bond, BondKind, InstructionSet, Model, shared_passes};

use super::models::{FRAME, copies, disc, frames, hung, kernel, path, rims, rope, scene, single, to_strain};

/// Hash of positions and velocities of all frames.
fn bits(scene: &Scene, count: usize) -> String {
    let mut world = scene.world(Some(count as f64 * FRAME)).unwrap();
    let mut samples = Vec::new();
    frames(&mut *world, count, |sample| samples.push(sample.clone()));
    hash(&samples, scene.dimensions())
}

fn moving(mut model: Model<2>) -> Model<2> {
    for (v, x) in model.velocity.iter_mut().zip(&model.position) {
        *v = [0.3 + 0.2 * x[1], -0.1 * x[0]];
    }
    model
}

/// Small scenes of every form, with the word for it.
fn scenes() -> [(&'static str, Model<2>); 5] {
    [
        ("chain", rope(1_000)),
        ("sheet", hung([40, 37], [true; 2])),
        ("sheet", hung([47, 40], [false; 2])),
        ("crowd", rims(100)),
        ("mesh", disc(1.6)),
    ]
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let before = InstructionSet::chosen();
    for (form, model) in scenes() {
        let double = path(&to_strain(&moving(model), 1e-3));
        for model in [single(&double), double] {
            let scene = scene(&model);
            let world = scene.world(None).unwrap();
            assert!(kernel(&*world).contains(form), "{form}: {}", kernel(&*world));
            let mut first = None;
            for set in InstructionSet::ALL.into_iter().filter(|set| set.choose()) {
                let here = bits(&scene, 15);
                let there = first.get_or_insert_with(|| here.clone());
                assert_eq!(&here, there, "{form} in {:?} with {set}", world.precision());
            }
        }
    }
    before.choose();
}

/// What `work` gives on so many threads.
fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    ThreadPoolBuilder::new().num_threads(count).build().unwrap().install(|| {
        assert_eq!(rayon::current_num_threads(), count);
        work()
    })
}

/// Hash of some frames, and how many passes threads shared on the way.
fn shared(scene: &Scene, count: usize, threads: usize) -> (String, u64) {
    on_threads(threads, || {
        let before = shared_passes();
        let hash = bits(scene, count);
        (hash, shared_passes() - before)
    })
}

/// Holds a scene to the same bits on any number of threads, of which the first step at least is shared.
fn is_shared_alike(scene: &Scene, count: usize, form: &str) {
    let (first, alone) = shared(scene, count, 1);
    assert_eq!(alone, 0, "{form} by itself");
    for threads in [2, 5] {
        let (hash, passes) = shared(scene, count, threads);
        assert!(passes > 0, "{form} on {threads} threads shares nothing");
        assert_eq!(first, hash, "{form} on {threads} threads");
    }
}

/// A cloth of two diagonals; above a million bonds its passes are shared however few there are.
fn cloth(columns: u32, rows: u32) -> Scene {
    let text = format!(
        r#"{{ "wobble": 1, "gravity": [0, -9.8], "method": {{ "solver": "path", "max_strain": 0.02 }},
        "bodies": [{{ "make": "cloth", "columns": {columns}, "rows": {rows}, "spacing": 0.1, "pinned": [0, {}] }}] }}"#,
        columns - 1
    );
    Scene::parse(&text, "cloth.json").unwrap()
}

#[test]
fn a_huge_sheet_has_the_same_bits_on_any_number_of_threads() {
    is_shared_alike(&cloth(520, 500), 1, "a huge sheet");
}

/// Above a million bonds of one body, or of equal ones.
fn huge(body: &str) -> Scene {
    let text = format!(
        r#"{{ "wobble": 1, "gravity": [0, -9.8], "method": {{ "solver": "path", "max_strain": 0.02 }}, "bodies": [{{ {body}, "pinned": [0] }}] }}"#
    );
    Scene::parse(&text, "huge.json").unwrap()
}

#[test]
fn huge_chains_and_crowds_have_the_same_bits_on_any_number_of_threads() {
    let forms = [
        ("chain", r#""make": "rope", "count": 1100000, "spacing": 0.1"#),
        ("crowd", r#""make": "rim", "repeat": { "count": [220, 100], "step": [5, 5] }"#),
    ];
    for (form, body) in forms {
        let scene = huge(body);
        let world = scene.world(Some(FRAME)).unwrap();
        assert!(kernel(&*world).contains(form), "{form}: {}", kernel(&*world));
        assert!(world.bonds().len() > 1_000_000, "{form}: {} bonds", world.bonds().len());
        drop(world);
        is_shared_alike(&scene, 1, form);
    }
}

#[test]
fn many_bodies_have_the_same_bits_on_any_number_of_threads() {
    // Each by its own method: of 20,000 points they would be one large body.
    let net = hung([9, 9], [true, false]);
    let spring = BondKind::Spring { stiffness: 1e3, damping: 0.1 };
    let net = Model { bonds: net.bonds.iter().map(|bond| Bond { kind: spring, ..bond }).collect(), ..net };
    let bodies = |count| scene(&copies(&moving(net.clone()), count));
    is_shared_alike(&bodies(240), 1, "many bodies");
    assert_eq!(shared(&bodies(20), 1, 2).1, 0, "few are done before others are awake");
}

#[test]
fn a_pass_is_shared_from_sixty_thousand_bonds_on() {
    // Four bonds a point, less the rims: so small a sheet is done before others are awake, however many passes a frame has.
    assert_eq!(shared(&cloth(120, 120), 1, 2).1, 0);
    assert!(shared(&shared_cloth(), 1, 2).1 > 0);
}

/// The least square cloth that is shared.
pub(crate) fn shared_cloth() -> Scene {
    cloth(130, 130)
}
