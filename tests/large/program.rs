//! What the program says of large bodies and of the machine.

use std::process::{Command, Output};

use super::models::{path, rims, rope, scene, to_strain};

fn wobble(arguments: &[&str], variables: &[(&str, &str)]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wobble"));
    for name in ["WOBBLE_INSTRUCTION_SET", "RAYON_NUM_THREADS"] {
        command.env_remove(name);
    }
    command.args(arguments).envs(variables.iter().copied()).output().unwrap()
}

fn error(done: &Output) -> String {
    String::from_utf8(done.stderr.clone()).unwrap()
}

/// A scene file, with what keeps it.
fn file(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, text).unwrap();
    let name = path.to_str().unwrap().to_owned();
    (folder, name)
}

#[test]
fn threads_and_instruction_sets_are_checked() {
    for wrong in [["--threads", "0"], ["--threads", "10000"], ["--threads", "two"], ["--instruction-set", "mmx"]] {
        let done = wobble(&[&["scenes"], &wrong[..]].concat(), &[]);
        assert_eq!(done.status.code(), Some(2), "{wrong:?}: {}", error(&done));
        assert!(error(&done).contains(wrong[1]), "{}", error(&done));
    }
    for wrong in [("RAYON_NUM_THREADS", "x"), ("WOBBLE_INSTRUCTION_SET", "mmx")] {
        let done = wobble(&["scenes"], &[wrong]);
        assert_eq!(done.status.code(), Some(2), "{wrong:?}: {}", error(&done));
    }
}

/// A cloth whose passes several threads share, as another test counts.
#[test]
fn a_shared_cloth_has_the_same_hash_for_any_threads() {
    let (_keeps, name) = file(&super::bits::shared_cloth().to_json().unwrap());
    let hash = |more: &[&str], variables: &[(&str, &str)]| {
        let call = ["simulate", &name, "--samples", "0.0166", "--hash", "--quiet"];
        let done = wobble(&[&call[..], more].concat(), variables);
        assert!(done.status.success(), "{}", error(&done));
        String::from_utf8(done.stdout).unwrap()
    };
    let alone = hash(&["--threads", "1"], &[]);
    assert_eq!(hash(&["--threads", "3"], &[]), alone);
    assert_eq!(hash(&[], &[("RAYON_NUM_THREADS", "2")]), alone);
}

#[test]
fn the_call_says_how_a_large_body_moves_and_any_instructions_give_the_same_hash() {
    let (_keeps, name) = file(&scene(&to_strain(&rope::<2>(2_100), 1e-3)).to_json().unwrap());
    let run = |more: &[&str], variables: &[(&str, &str)]| {
        let done = wobble(&[&["simulate", &name, "--samples", "0.1", "--hash"], more].concat(), variables);
        assert!(done.status.success(), "{}", error(&done));
        (String::from_utf8(done.stdout.clone()).unwrap(), error(&done))
    };
    let (hash, said) = run(&["--threads", "1"], &[]);
    assert!(said.contains("2099 bonds as a chain by paths for a strain of 0.001 (f64,"), "{said}");
    let (plain, said) = run(&[], &[("WOBBLE_INSTRUCTION_SET", "baseline")]);
    assert_eq!(plain, hash);
    assert!(said.contains("(f64, baseline)"), "{said}");
    let (called, said) = run(&["--instruction-set", "Baseline"], &[("WOBBLE_INSTRUCTION_SET", "avx2")]);
    assert_eq!(called, hash);
    assert!(said.contains("(f64, baseline)"), "the call is heard before the variable: {said}");
}

#[test]
fn kernels_are_named_of_each_part_and_small_scenes_have_none() {
    let (_keeps, name) = file(&scene(&path(&to_strain(&rims(20), 1e-3))).to_json().unwrap());
    let said = error(&wobble(&["simulate", &name, "--samples", "0.05", "--hash"], &[]));
    assert!(said.contains("1040 bonds as a crowd by paths for a strain of 0.001"), "{said}");
    let said = error(&wobble(&["simulate", "rim", "--samples", "0.05", "--hash"], &[]));
    assert!(said.is_empty(), "{said}");
}

#[test]
fn strains_that_are_none_and_relaxed_bonds_on_paths_are_refused() {
    let with = |method: &str, kind: &str| {
        format!(
            "{{\"wobble\":1,\"points\":{{\"position\":[[0,0],[1,0]]}},\"bonds\":[{{\"a\":0,\"b\":1{kind}}}],\
             \"method\":{{{method}}}}}"
        )
    };
    for (method, kind, said) in [
        ("\"max_strain\":0", "", "method.max_strain: is 0.0: give a number above 0"),
        ("\"max_strain\":-0.1", "", "method.max_strain: is -0.1: give a number above 0"),
        ("\"max_strain\":NaN", "", "scene.json"),
        ("\"max_strain\":1e999", "", "scene.json"),
        ("\"solver\":\"path\"", ",\"kind\":\"relaxed\"", "which solver `path` refuses"),
    ] {
        let (_keeps, name) = file(&with(method, kind));
        let done = wobble(&["simulate", &name, "--samples", "0.1", "--hash"], &[]);
        assert_eq!(done.status.code(), Some(1), "{method}: {}", error(&done));
        assert!(error(&done).contains(said), "{method}: {}", error(&done));
    }
    let (_keeps, name) = file(&scene(&path(&to_strain(&rope::<2>(3), 0.02))).to_json().unwrap());
    let done = wobble(&["simulate", &name, "--samples", "0.1", "--hash"], &[]);
    assert!(done.status.success(), "{}", error(&done));
}

/// 64 bytes a point and 32 a bond, whatever a large rigid sheet is made of: of a large one padding is little.
#[test]
fn large_sheets_take_little_memory() {
    use super::models::{hung, kernel, single, to_strain, world};
    let model = single(&to_strain(&hung::<2>([400, 300], [true; 2]), 0.02));
    let mut world = world(&model);
    assert_eq!(kernel(&*world), "a sheet by paths");
    let allowed = 64 * model.position.len() + 32 * model.bonds.len();
    let start = world.heap_bytes();
    assert!(start <= allowed, "{start} of {allowed} bytes");
    world.step();
    let moved = world.heap_bytes();
    assert!(moved <= allowed, "{moved} of {allowed} bytes after a step");
}

#[test]
fn paths_that_cannot_take_a_limit_say_so() {
    use super::models::{hung, path, world};
    let mut model = path(&hung::<2>([60, 40], [true; 2]));
    assert!(world(&model).warnings().is_empty());
    let mut first = model.bonds.get(5);
    first.limit = wobble::sim::Limit::Max;
    model.bonds.set(5, first);
    let warnings = world(&model).warnings().to_vec();
    assert!(warnings.iter().any(|text| text.contains("limit")), "{warnings:?}");
}
