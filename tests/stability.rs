//! The study of stability: its quick form as a process, and the scenes that are known to fail.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod borne;

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use wobble::history::Start;
use wobble::study::stability::{Bounds, Ended, Fault, Rest, StabilitySettings, Subject, battery, judge};

fn study(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wobble"));
    command.args(["study", "stability"]).args(arguments).env_remove("WOBBLE_COMMIT").output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The rows of a table by the names of its columns.
fn rows(folder: &Path, name: &str) -> Vec<std::collections::BTreeMap<String, String>> {
    let table = csv::Reader::from_path(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    table.into_deserialize().map(|row| row.unwrap()).collect()
}

/// The bounds of a quick study's cases.
fn quick() -> StabilitySettings {
    StabilitySettings::new(true, None, &[])
}

#[test]
fn a_quick_study_judges_sixty_cases_and_two_runs_agree() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a/new/folder");
    let done =
        study(&["--quick", "--commit", "abc", "--out", out.to_str().unwrap(), "--cases", "6", "--family", "rope"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let out = out.as_path();
    assert_eq!(rows(out, "cases.csv").len(), 6);
    assert!(rows(out, "cases.csv").iter().all(|row| row["family"] == "rope"));

    let done = study(&["--quick", "--sweep", "stiffness", "--cases", "60", "--out", out.to_str().unwrap()]);
    assert!(done.status.success() && done.stdout.is_empty(), "{}", text(&done.stderr));
    let report: Value = serde_json::from_str(&read(out, "stability.json")).unwrap();
    assert_eq!(report["is_finished"], true);
    let judged = report["judged"].as_array().unwrap();
    assert_eq!(judged.len(), 60);
    let settings = quick();
    for one in &judged[..28] {
        let case = one["case"].as_u64().unwrap();
        let subject = Subject { duration: settings.case_seconds, ..battery::subject(case).unwrap() };
        let again = serde_json::to_value(judge(&subject, settings.case_bounds).found).unwrap();
        assert_eq!(one["found"], again, "case {case}");
    }
    check_tables(out);
    check_files(out);
}

fn check_tables(out: &Path) {
    let cases = rows(out, "cases.csv");
    let faulty = cases.iter().filter(|row| !row["faults"].is_empty()).count();
    assert!((1..60).contains(&faulty), "{faulty} of 60 have a fault");
    for row in &cases {
        assert_ne!(row["ended"], "refused", "{row:?}");
        assert!(
            row["work_rate_s"].parse::<f64>().unwrap() >= 0.0 && row["points"].parse::<u32>().unwrap() > 0,
            "{row:?}"
        );
    }
    let groups = rows(out, "groups.csv");
    for by in ["all", "family", "path", "moved", "cause"] {
        assert!(groups.iter().any(|row| row["by"] == by), "{by}");
    }
    let sum: u32 =
        groups.iter().filter(|row| row["by"] == "family").map(|row| row["cases"].parse::<u32>().unwrap()).sum();
    assert_eq!(sum, 60, "families take turns and leave nothing out");
    let sweeps = rows(out, "sweeps.csv");
    assert_eq!(sweeps.len(), 5 * 3, "five methods at three values");
    let limits = rows(out, "limits.csv");
    let of = |method: &str| limits.iter().find(|row| row["method"] == method).unwrap();
    assert_eq!(of("xpbd")["breaks_above"], "1000000000000.0");
    assert_eq!(of("auto")["breaks_above"], "");
}

fn check_files(out: &Path) {
    for name in ["sweeps", "faults", "rates"] {
        let image = image::open(out.join(format!("{name}.png"))).unwrap().into_rgb8();
        assert!(image.pixels().filter(|pixel| pixel.0 != [255; 3]).count() > 5000, "{name} is empty");
        assert!(read(out, &format!("{name}.svg")).trim_end().ends_with("</svg>"));
    }
    let page = read(out, "README.md");
    for word in ["## What fails", "## By family", "## Where methods hold", "| family | rope |", "| stiffness:"] {
        assert!(page.contains(word), "{word} in {page}");
    }
    let worst: Vec<_> = std::fs::read_dir(out.join("worst")).unwrap().map(|file| file.unwrap().path()).collect();
    assert!(worst.len() >= 5, "{worst:?}");
    for file in worst {
        Start::load(file.to_str().unwrap()).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn a_scene_of_ones_own_and_a_single_case_are_judged_alike() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let done = study(&["rim", "--out", out]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stdout).starts_with("rim: "), "{}", text(&done.stdout));
    let done = study(&["--case", "4", "--quick", "--out", out]);
    assert!(text(&done.stdout).starts_with("case-4: "), "{}", text(&done.stdout));
    check_again(folder.path(), 4);
    let scene = folder.path().join("free.json");
    std::fs::write(&scene, r#"{"wobble": 1, "points": {"position": [[0, 0]]}, "gravity": [0, -9.81]}"#).unwrap();
    let done = study(&[scene.to_str().unwrap(), "--out", out]);
    assert_eq!(text(&done.stdout), "free: holds\n");
}

/// The scene of a case that was asked for is there, and is the case.
fn check_again(folder: &Path, case: u64) {
    let file = folder.join(format!("case-{case}.json"));
    let kept = Start::load(file.to_str().unwrap()).unwrap();
    let drawn = battery::subject(case).unwrap().recording;
    assert_eq!(kept.recording().scene.points, drawn.scene.points);
    assert_eq!(kept.recording().scene.bodies, drawn.scene.bodies);
}

#[test]
fn a_case_that_is_asked_for_is_written_out_also_where_nothing_fails() {
    let folder = tempfile::tempdir().unwrap();
    let done = study(&["--case", "0", "--quick", "--out", folder.path().to_str().unwrap()]);
    assert_eq!(text(&done.stdout), "case-0: holds\n");
    check_again(folder.path(), 0);
    assert!(!folder.path().join("worst").exists());
    assert!(read(folder.path(), "README.md").contains("by `wobble study stability --case 0 --quick --out "));
}

#[test]
fn names_of_scenes_lead_to_files_of_their_own_in_the_folder_and_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["a/b", "../x", "same", "same", "Same", ".."];
    let scenes: Vec<String> = (0..names.len()).map(|k| folder.path().join(format!("{k}.json"))).map(plain).collect();
    for (file, name) in scenes.iter().zip(names) {
        let scene = serde_json::json!({ "wobble": 1, "name": name, "gravity": [0, -9.81], "duration": 0.1,
            "points": { "position": [[0, 0], [1, 0]], "pinned": [0] }, "bonds": [{ "a": 0, "b": 1 }] });
        std::fs::write(file, scene.to_string()).unwrap();
    }
    let out = folder.path().join("deep/out");
    let mut call: Vec<&str> = scenes.iter().map(String::as_str).collect();
    // Which no method gives: each of them is among the worst.
    call.extend(["--tolerance", "1e-17", "--out", out.to_str().unwrap()]);
    let done = study(&call);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let listed = |folder: &Path| {
        let mut names: Vec<String> =
            std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    let worst = ["Same-3.json", "_x.json", "a_b.json", "same-2.json", "same.json", "scene.json"];
    assert_eq!(listed(&out.join("worst")), worst);
    assert_eq!(listed(&folder.path().join("deep")), ["out"]);
    assert_eq!(listed(folder.path()).len(), names.len() + 1);
}

fn plain(path: std::path::PathBuf) -> String {
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_wrong_call_ends_with_2_and_names_what_there_is() {
    let cases: [(&[&str], &str); 7] = [
        (&["--family", "ropes"], "rope, heavy-end"),
        (&["--sweep", "stifness"], "stiffness, mass ratio"),
        (&["--case", "one"], "invalid digit"),
        (&["--cases", "many"], "invalid digit"),
        (&["rim", "--case", "3"], "cannot be used with"),
        (&["--case", "3", "--cases", "9"], "cannot be used with"),
        (&["--case", "3", "--sweep", "stiffness"], "cannot be used with"),
    ];
    for (arguments, line) in cases {
        let done = study(arguments);
        assert_eq!(done.status.code(), Some(2), "{}", text(&done.stderr));
        assert!(text(&done.stderr).contains(line), "{}", text(&done.stderr));
    }
}

#[test]
fn a_folder_or_a_scene_that_cannot_be_had_is_told_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    for arguments in [["--out", file.to_str().unwrap()], ["no-such-scene", "--quick"]] {
        let done = Command::new(env!("CARGO_BIN_EXE_wobble"))
            .args(["study", "stability"])
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .unwrap();
        let error = text(&done.stderr);
        assert_eq!(done.status.code(), Some(1), "{error}");
        assert!(error.starts_with("wobble: ") && error.lines().count() == 1, "{error}");
    }
}

/// As long as this would run, it ends at once.
#[test]
fn what_stands_where_the_study_writes_is_told_before_the_work() {
    let stands: [(&str, bool); 3] = [("worst", false), ("stability.json", true), ("faults.png", true)];
    for (name, is_folder) in stands {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join(name);
        if is_folder {
            std::fs::create_dir(&place).unwrap()
        } else {
            std::fs::write(&place, "").unwrap()
        }
        check_refused(folder.path(), name);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "{name}: nothing else is left");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_no_file_can_be_made_in_is_told_before_the_work() {
    check_refused(Path::new("/proc"), "/proc");
}

fn check_refused(folder: &Path, word: &str) {
    let done = study(&["--cases", "1000000", "--out", folder.to_str().unwrap()]);
    let error = text(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{error}");
    assert!(error.starts_with("wobble: ") && error.contains(word) && error.lines().count() == 1, "{error}");
}

/// What was done before an interrupt is on the disk, whole: tables, plots and scenes.
#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let mut running = Command::new(env!("CARGO_BIN_EXE_wobble"))
        .args(["study", "stability", "--cases", "100000", "--family", "rim", "--family", "rope", "--quick", "--out"])
        .arg(folder.path())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let table = folder.path().join("stability.json");
    let is_there = (0..600).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(100));
        table.exists()
    });
    let told = Command::new("kill").args(["-INT", &running.id().to_string()]).status().unwrap();
    let ended = running.wait().unwrap();
    assert!(is_there && told.success());
    assert_eq!(ended.code(), Some(130));
    let report: Value = serde_json::from_str(&read(folder.path(), "stability.json")).unwrap();
    assert_eq!(report["is_finished"], false);
    assert!(!report["judged"].as_array().unwrap().is_empty());
    assert!(read(folder.path(), "README.md").contains("was not finished"));
    for name in ["faults.png", "faults.svg", "rates.png", "rates.svg"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
    let is_faulty = |one: &&Value| !one["found"]["faults"].as_array().unwrap().is_empty();
    let faulty = report["judged"].as_array().unwrap().iter().filter(is_faulty).count().min(20);
    assert!(faulty > 0);
    assert_eq!(std::fs::read_dir(folder.path().join("worst")).unwrap().count(), faulty);
}

#[test]
fn a_study_takes_away_the_files_of_an_earlier_one_alone() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let (mine, report) = (folder.path().join("sweeps.csv"), folder.path().join("stability.json"));
    std::fs::write(&mine, "mine").unwrap();
    std::fs::write(&report, r#"{"scenes": ["notes.json"]}"#).unwrap();
    std::fs::write(folder.path().join("notes.json"), "mine").unwrap();
    assert!(study(&["--case", "3", "--quick", "--out", out]).status.success());
    assert_eq!(std::fs::read_to_string(&mine).unwrap(), "mine", "no study wrote it");
    assert_eq!(read(folder.path(), "notes.json"), "mine");
    // What an earlier one wrote and this one does not goes, but for what is judged.
    let case = folder.path().join("case-3.json");
    assert!(case.exists());
    assert!(study(&["--quick", "--sweep", "stiffness", "--case", "4"]).status.code() == Some(2));
    assert!(study(&[case.to_str().unwrap(), "--quick", "--out", out]).status.success());
    assert!(case.exists(), "it was read");
    assert!(study(&["--case", "5", "--quick", "--out", out]).status.success());
    assert!(folder.path().join("case-5.json").exists());
    assert!(study(&["--quick", "--sweep", "stiffness", "--out", out]).status.success());
    assert!(!folder.path().join("case-5.json").exists() && !folder.path().join("cases.csv").exists());
    assert!(folder.path().join("sweeps.png").exists());
    assert!(study(&["--case", "3", "--quick", "--out", out]).status.success());
    assert!(!folder.path().join("sweeps.png").exists(), "a plot of an earlier study");
}

/// A scene of `tests/files/known` that fails, as its list has it.
#[derive(serde::Deserialize)]
struct Known {
    file: String,
    /// What is wrong with it, by the name that tables have.
    fault: String,
    /// What it comes to now.
    now: f64,
    /// What the figure must come to for the mark to be taken away.
    must: f64,
    /// `comes`: it has to come to rest.
    rest: Option<String>,
    /// What happens, in words.
    why: String,
}

fn known() -> Vec<Known> {
    serde_json::from_str(include_str!("files/known/known.json")).unwrap()
}

#[test]
fn scenes_that_are_known_to_fail_still_do() {
    let mut passed = Vec::new();
    for Known { file, fault, now, must, why, rest } in known() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/known").join(&file);
        let rest = if rest.as_deref() == Some("comes") { Rest::Comes } else { Rest::Free };
        let subject = Subject { rest, ..Subject::of_start(&Start::load(path.to_str().unwrap()).unwrap()) };
        let judged = judge(&subject, Bounds { work: 1.0, seconds: 300.0 });
        let named = Fault::ALL.into_iter().find(|one| one.name() == fault).unwrap_or_else(|| panic!("{fault}"));
        assert!(!matches!(judged.found.ended, Ended::Refused(_)), "{file}: {:?}", judged.found.ended);
        assert_eq!(named.figure().1, must, "{file}: the figure that it must reach is that of the meter");
        let found = named.measured(&judged.found);
        assert!((0.5..2.0).contains(&(found / now)) || found <= must, "{file}: {fault} is {found}, not about {now}");
        if !judged.found.faults.contains(&named) {
            passed.push(format!("{file}: {fault} is {}, at most {must} ({why})", named.measured(&judged.found)));
        }
    }
    assert!(
        passed.is_empty(),
        "these do not fail any more: take them off known.json, well done\n{}",
        passed.join("\n")
    );
}

#[test]
fn every_scene_that_is_known_to_fail_is_listed_once() {
    let mut listed: Vec<String> = known().into_iter().map(|known| known.file).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/known");
    let names = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
    let mut there: Vec<String> = names.filter(|name| name != "known.json").collect();
    // Those that are tried for other things too lie beside.
    listed.retain(|name| !name.starts_with("../abuse/"));
    listed.sort();
    there.sort();
    assert_eq!(listed, there);
    assert!(known().iter().all(|known| known.now > known.must && !known.why.is_empty()));
}

#[test]
fn a_tolerance_that_cannot_be_kept_is_a_fault_and_one_that_can_is_none() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("swing.json");
    std::fs::write(
        &scene,
        r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0]], "pinned": [0]}, "bonds": [{"a": 0, "b": 1}],
            "gravity": [0, -9.81], "duration": 0.5}"#,
    )
    .unwrap();
    let told = |tolerance: &str| {
        let out = folder.path().join(tolerance);
        let done = study(&[scene.to_str().unwrap(), "--tolerance", tolerance, "--out", out.to_str().unwrap()]);
        assert!(done.status.success(), "{}", text(&done.stderr));
        text(&done.stdout)
    };
    let kept = told("1e-4");
    assert!(kept.starts_with("swing: holds; the error asked for is kept (") && kept.ends_with(" of it)\n"), "{kept}");
    assert!(told("1e-17").starts_with("swing: tolerance ("), "{}", told("1e-17"));
    assert_eq!(study(&["--tolerance", "1e-4", "--quick"]).status.code(), Some(2), "of a scene of one's own");
}
