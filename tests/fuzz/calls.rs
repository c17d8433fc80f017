//! Calls of the program with values that are odd: each ends with one of its three codes, and says why in plain lines.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::common::session::Dice;
use super::driver::{Trial, run, shows};

const TRIAL: Trial = Trial { name: "calls", few: 60, most_bytes: 16 << 20 };

/// Time after which a call is ended as one that does not end [s].
const HANG: u64 = 120;

/// A scene with a point and a spring: what a call does with it takes no time.
const SCENE: &str = r#"{"wobble":1,"points":{"position":[[0,0],[1,0]],"pinned":[0]},"gravity":[0,-9.81],
    "bonds":[{"a":0,"b":1,"kind":"spring","stiffness":50}],"samples":[0.1]}"#;

const RECORDING: &str = r#"{"wobble_recording":1,"scene":"points","commands":[{"at":0.01,"do":"release"}],"end":0.02}"#;

/// Commands, what they take first, and their options with values that they take; none of them opens a window or draws.
const CALLS: [(&str, &[&str], &[&str]); 6] = [
    ("scenes", &["rim", "points", "{scene}", "rimm"], &["--json", "--expanded", "--schema", "--threads=1|2"]),
    (
        "simulate",
        &["{scene}", "points", "{recording}", "{none}", "{folder}"],
        &[
            "--solver=auto|verlet|pefrl|path|xpbd|rk4|relaxation|backward-euler",
            "--substep=0.01|0.005|1",
            "--iterations=1|2",
            "--order=fixed|coloured|shuffled",
            "--seed=0|7",
            "--precision=f32|f64",
            "--tolerance=0.01|1",
            "--settle",
            "--samples=0|0.05|0,0.01|0.02,0.01",
            "--max-strain=0.01",
            "--commands={recording}",
            "--record={folder}/again.json|{folder}/again.jsonl",
            "--out={folder}/out.json|{folder}/out.csv|{none}/out.csv",
            "--hash",
            "--quiet",
            "--threads=1|2",
            "--instruction-set=baseline|avx2",
        ],
    ),
    (
        "mesh",
        &["{picture}", "{picture}", "{scene}", "{none}", "{folder}"],
        &[
            "--spacing=2|4|8",
            "--max-area=4|30",
            "--grading=1|3",
            "--threshold=0|0.5|1",
            "--invert",
            "--whole",
            "--min-area=0|5",
            "--blur=0|3",
            "--fill-holes",
            "--strokes=ropes|widen|drop|mesh",
            "--pattern=edges|braced",
            "--material=soft|rigid",
            "--young=1000",
            "--height=1",
            "--out={folder}/body.json",
            "--preview={folder}/body.png",
            "--stats",
        ],
    ),
    ("replay", &["{recording}", "{scene}", "{none}"], &["--time=0|0.01", "--hash", "--out={folder}/r.csv", "--quiet"]),
    ("verify", &["{recording}", "{scene}", "{none}"], &["--quiet"]),
    (
        "study",
        &["accuracy", "speed", "stability", "stability", "{none}"],
        &["--points", "--what=1", "--case=0|3", "--cases=1|2", "--family=rope|points", "--sweep=stiffness", "--quick"],
    ),
];

/// Values that options seldom take.
const VALUES: [&str; 26] = [
    "",
    " ",
    "0",
    "-0",
    "-1",
    "0.01",
    ",",
    "0.1,",
    "1e999",
    "-1e999",
    "NaN",
    "inf",
    "0x10",
    "1_000",
    "4294967296",
    "18446744073709551616",
    "99999999999x1",
    "0x0",
    "auto",
    "f64",
    "é",
    "--",
    "-",
    "{folder}",
    "{folder}/out.txt",
    "{none}/x.json",
];

/// The words of a call.
fn words(dice: &mut Dice) -> Vec<String> {
    let pick = |list: &[&str], dice: &mut Dice| list[dice.below(list.len() as u64) as usize].to_owned();
    let (name, first, options) = CALLS[dice.below(CALLS.len() as u64) as usize];
    let mut words = vec![name.to_owned(), pick(first, dice)];
    for _ in 0..dice.below(4) {
        let option = pick(options, dice);
        let Some((option, values)) = option.split_once('=') else {
            words.push(option);
            continue;
        };
        let values: Vec<&str> = values.split('|').collect();
        let value = pick(if dice.below(4) == 0 { &VALUES } else { &values }, dice);
        match dice.below(8) {
            0 => words.push(option.to_owned()),
            1..4 => words.push(format!("{option}={value}")),
            _ => words.extend([option.to_owned(), value]),
        }
    }
    if dice.below(10) == 0 {
        words.remove(dice.below(words.len() as u64) as usize);
    }
    // A study that can be done takes minutes: this one has nowhere to write.
    if words.iter().any(|word| word == "study") {
        words.push("--out={scene}/x".to_owned());
    }
    words
}

/// Lines of a call that must end.
fn call(words: &[String], folder: &std::path::Path) -> (Option<i32>, String) {
    let errors = folder.join("errors.txt");
    let mut command = Command::new(env!("CARGO_BIN_EXE_wobble"));
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    command.args(words).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null());
    let mut child = command.stderr(std::fs::File::create(&errors).unwrap()).spawn().unwrap();
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if start.elapsed() > Duration::from_secs(HANG) {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{words:?} does not end");
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    (status.code(), std::fs::read_to_string(errors).unwrap())
}

fn exercise(words: &[String], folder: &std::path::Path) -> &'static str {
    let (code, said) = call(words, folder);
    assert!(!said.contains("panicked"), "{words:?}: {said}");
    match code {
        Some(0) => "done",
        Some(1) => {
            let lines: Vec<&str> = said.lines().filter(|line| line.starts_with("wobble: ")).collect();
            assert_eq!(lines.len(), 1, "{words:?}: {said}");
            "failed"
        }
        Some(2) => {
            assert!(!said.is_empty(), "{words:?}");
            "refused"
        }
        other => panic!("{words:?} ends with {other:?}: {said}"),
    }
}

#[test]
fn odd_calls_end_with_a_code_and_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("scene.json"), SCENE).unwrap();
    std::fs::write(path("recording.json"), RECORDING).unwrap();
    let picture = wobble::picture::Picture::filled(9, 9, [40, 40, 40, 255]);
    std::fs::write(path("picture.png"), wobble::picture::encode(&picture).unwrap()).unwrap();
    let ended = run(&TRIAL, |number| {
        let words: Vec<String> = words(&mut Dice::new(number))
            .iter()
            .map(|word| {
                let word = word.replace("{scene}", &path("scene.json")).replace("{recording}", &path("recording.json"));
                let word = word.replace("{picture}", &path("picture.png")).replace("{none}", &path("none.json"));
                word.replace("{folder}", folder.path().to_str().unwrap())
            })
            .collect();
        if shows() {
            eprintln!("{number}: {words:?}");
        }
        exercise(&words, folder.path())
    });
    assert!(ended.len() == 3 || ended.values().sum::<u64>() < 50, "{ended:?}");
}
