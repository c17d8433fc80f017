//! `scripts/run` as it is called, with a builder in place of cargo that runs the program under test.

use std::path::Path;
use std::process::{Command, Output};

use super::{text, wobble};

/// What stands in for `scripts/setup`: it writes down what it is asked for, and makes a cargo that does the same, builds nothing and draws nothing.
const SETUP: &str = r#"
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
say() { printf 'wobble: %s\n' "$*" >&2; }
is_linux() { true; }
setup() {
  echo "setup $*" >>"$CALLS"
  mkdir "$root/bin"
  cat >"$root/bin/cargo" <<'CARGO'
#!/bin/sh
echo "$*" >>"$CALLS"
[ "$1" = run ] || exit 0
while [ "$1" != -- ]; do shift; done
shift
[ "$1" = render ] && exit 0
exec "$PROGRAM" "$@"
CARGO
  chmod +x "$root/bin/cargo"
  PATH=$root/bin:$PATH
}
"#;

/// Runs the script with these arguments where no display is. Returns what came of it, and the calls that it made.
fn run(arguments: &[&str]) -> (Output, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let scripts = folder.path().join("scripts");
    std::fs::create_dir(&scripts).unwrap();
    std::fs::write(scripts.join("setup"), SETUP).unwrap();
    std::fs::write(scripts.join("run"), include_str!("../../scripts/run")).unwrap();
    let calls = folder.path().join("calls");
    let done = Command::new("bash")
        .arg(scripts.join("run"))
        .args(arguments)
        .current_dir(folder.path())
        .env("CALLS", &calls)
        .env("PROGRAM", env!("CARGO_BIN_EXE_wobble"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap();
    let root = folder.path().canonicalize().unwrap();
    let made = std::fs::read_to_string(&calls).unwrap();
    (done, made.lines().map(|line| line.replace(path(&root), "ROOT")).collect())
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// How the program is built, and how it is run.
const BUILD: &str = "build --release --locked --manifest-path ROOT/Cargo.toml --bin wobble";
const RUN: &str = "run --quiet --release --locked --manifest-path ROOT/Cargo.toml --bin wobble --";

#[test]
fn the_run_script_builds_and_runs_what_it_is_asked_for() {
    let (done, calls) = run(&["scenes", "rim", "--json"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(done.stdout, wobble(&["scenes", "rim", "--json"]).stdout);
    assert_eq!(calls, ["setup build", BUILD, &format!("{RUN} scenes rim --json")]);
    let (done, _) = run(&["scenes", "no-such-scene", "--json"]);
    assert_eq!(done.status.code(), Some(1), "what the program says it says: {}", text(&done.stderr));
}

#[test]
fn the_run_script_draws_the_scene_where_no_display_is() {
    let draws = |scene: &str, picture: &str| format!("{RUN} render {scene} --time 1 --size 1280x720 --out {picture}");
    let asked: [(&[&str], &str, &str); 3] = [
        (&[], "rim", "rim.png"),
        (&["ragdoll"], "ragdoll", "ragdoll.png"),
        (&["--record", "session.jsonl", "folder/mine.json"], "folder/mine.json", "mine.png"),
    ];
    for (arguments, scene, picture) in asked {
        let (done, calls) = run(arguments);
        assert!(done.status.success(), "{}", text(&done.stderr));
        assert!(text(&done.stderr).contains("no display here"), "{}", text(&done.stderr));
        assert_eq!(calls, ["setup build gpu", BUILD, &draws(scene, picture)]);
    }
}
