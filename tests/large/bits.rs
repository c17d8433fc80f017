//! The same bits for every instruction set and any number of threads.

use rayon::ThreadPoolBuilder;
use wobble::scene::Scene;
use wobble::scene::record::hash;
use wobble::sim::{InstructionSet, Model};

use super::models::{FRAME, disc, frames, hung, kernel, rims, rope, scene, single, to_strain};

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

/// Scenes of every form, with the word for it.
fn scenes(size: u32) -> Vec<(&'static str, Model<2>)> {
    let k = f64::from(size).sqrt();
    let side = |n: u32| (f64::from(n) * k) as u32;
    vec![
        ("chain", rope(1_000 * size)),
        ("sheet", hung([side(40), side(37)], [true; 2])),
        ("sheet", hung([side(47), side(40)], [false; 2])),
        ("crowd", rims(100 * size)),
        ("mesh", disc(1.6 * k)),
    ]
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let before = InstructionSet::chosen();
    for (form, model) in scenes(1) {
        let double = to_strain(&moving(model), 1e-3);
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

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for (form, model) in scenes(11) {
        let model = single(&to_strain(&moving(model), 0.02));
        let scene = scene(&model);
        let first = on_threads(1, || bits(&scene, 3));
        for threads in [2, 3, 5, 8] {
            assert_eq!(first, on_threads(threads, || bits(&scene, 3)), "{form} on {threads} threads");
        }
    }
}

/// A sheet with more than a million bonds, from where on its passes are shared by threads.
const HUGE: &str = r#"{ "wobble": 1, "gravity": [0, -9.8], "method": { "max_strain": 0.02 },
    "bodies": [{ "make": "cloth", "columns": 520, "rows": 500, "spacing": 0.1, "pinned": [0, 519] }] }"#;

#[test]
fn a_huge_sheet_has_the_same_bits_on_any_number_of_threads() {
    let scene = Scene::parse(HUGE, "huge.json").unwrap();
    let first = on_threads(1, || bits(&scene, 1));
    for threads in [2, 3, 5, 8] {
        assert_eq!(first, on_threads(threads, || bits(&scene, 1)), "{threads} threads");
    }
}
