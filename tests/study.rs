//! `wobble study` as a process: what it writes, and that what it writes is right.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn study(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wobble"));
    command.arg("study").args(arguments).env_remove("WOBBLE_COMMIT").output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The rows of a table, each as its fields.
fn rows(folder: &Path, name: &str) -> Vec<Vec<String>> {
    let mut table = csv::Reader::from_reader(std::fs::File::open(folder.join(name)).unwrap());
    table.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

fn find<'a>(list: &'a Value, key: &str, value: &str) -> &'a Value {
    let items = list.as_array().unwrap();
    items.iter().find(|item| item[key] == value).unwrap_or_else(|| panic!("no {key} {value}"))
}

/// Every element that is opened is closed, in order; attributes are quoted.
fn assert_well_formed(svg: &str) {
    let mut open = Vec::new();
    for part in svg.split('<').skip(1) {
        let (tag, rest) = part.split_once('>').expect("a tag ends");
        assert!(!rest.contains('>'), "{part}");
        assert!(tag.matches('"').count().is_multiple_of(2), "{tag}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{part}");
        } else if !tag.ends_with('/') && !tag.starts_with(['?', '!']) {
            open.push(tag.split_whitespace().next().unwrap());
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn accuracy_leaves_tables_and_plots() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a/new/folder");
    let done = study(&["accuracy", "B1_osc", "A2_drag", "--quick", "--commit", "abc", "--out", out.to_str().unwrap()]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(done.stdout.is_empty() && done.stderr.is_empty(), "no bar where there is no terminal");

    let report: Value = serde_json::from_str(&read(&out, "accuracy.json")).unwrap();
    assert_eq!((&report["commit"], &report["version"]), (&"abc".into(), &env!("CARGO_PKG_VERSION").into()));
    assert!(report["command"].as_str().unwrap().contains("study accuracy B1_osc A2_drag --quick"));
    assert!(!report["machine"]["processor"].as_str().unwrap().is_empty());
    let names: Vec<&Value> = report["problems"].as_array().unwrap().iter().map(|problem| &problem["name"]).collect();
    assert_eq!(names, ["A2_drag", "B1_osc"], "in the catalogue's order");
    check_oscillator(find(&report["problems"], "name", "B1_osc"));

    check_tables(&out);
    check_plots(&out);
}

/// A spring between two points: the sources' method is of first order, Verlet's of second.
fn check_oscillator(problem: &Value) {
    let order = |list: &str, solver: &str| find(&problem[list], "solver", solver)["observed_order"].as_f64().unwrap();
    assert!((order("baseline", "baseline") - 1.0).abs() < 0.2);
    assert!((order("methods", "verlet") - 2.0).abs() < 0.2);
    let refused = find(&problem["methods"], "solver", "relaxation");
    assert!(refused["refused"].as_str().unwrap().contains("spring") && refused["runs"] == Value::Array(Vec::new()));
    let runs = find(&problem["methods"], "solver", "verlet")["runs"].as_array().unwrap();
    assert!(runs.len() > 5);
    for run in runs {
        assert!(run["cost"].as_f64().unwrap() > 0.0);
        assert!(run["work"]["substeps"].as_u64() >= run["steps"].as_u64());
    }
    let level = &problem["equal_error"][0];
    let (baseline, best) = (level["baseline"]["cost"].as_f64().unwrap(), level["methods"][0]["cost"].as_f64().unwrap());
    assert_eq!(level["error"], 1e-3);
    assert_eq!(level["target"], 14.0);
    assert!((level["ratio"].as_f64().unwrap() - baseline / best).abs() < 1e-9 * baseline / best);
    assert_eq!(problem["tolerance"].as_array().unwrap().len(), 2);
}

fn check_tables(out: &Path) {
    let orders = rows(out, "orders.csv");
    let row = orders.iter().find(|row| row[0] == "B1_osc" && row[1] == "sources' method").unwrap();
    assert!((row[2].parse::<f64>().unwrap() - 1.0).abs() < 0.2, "{row:?}");
    let runs = rows(out, "runs.csv");
    assert!(runs.len() > 20 && runs.iter().all(|row| row.len() == 15));
    assert!(runs.iter().all(|row| row[5].parse::<f64>().unwrap() > 0.0));
    let equal = rows(out, "equal-error.csv");
    assert!(equal.iter().any(|row| row[0] == "A2_drag" && row[2] == "1" && row[8] == "35.0"), "{equal:?}");
    let slides = rows(out, "slides.csv");
    let turn = slides.iter().find(|row| row[0] == "circle: growth a turn" && row[2] == "0.1").unwrap();
    assert!((turn[3].parse::<f64>().unwrap() - 1.368).abs() < 1e-3, "{turn:?}");
}

fn check_plots(out: &Path) {
    let names = ["error-cost-A2_drag", "error-cost-B1_osc", "ratios", "slides-circle", "slides-decay", "slides-orders"];
    for name in names {
        let svg = read(out, &format!("{name}.svg"));
        assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{name}");
        assert_well_formed(&svg);
        let image = image::open(out.join(format!("{name}.png"))).unwrap().into_rgb8();
        assert!(image.width() > 1000 && image.height() > 300, "{name}");
        let ink = image.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
        assert!(ink > 5000, "{name} is empty");
    }
    let plot = read(out, "error-cost-B1_osc.svg");
    for word in ["B1_osc", "verlet", "sources", "order"] {
        assert!(plot.contains(word), "{word}");
    }
}

#[test]
fn a_wrong_call_ends_with_2_and_a_line_that_helps() {
    let cases: [(&[&str], &str); 4] = [
        (&["accuracy", "b1_ocs", "--out", "x"], "did you mean B1_osc?"),
        (&["accuracy", "rim", "--out", "x"], "I1_rim_free, I3_rim_floor"),
        (&["accuracy", "A2_drag"], "--out"),
        (&["no-such-study", "--out", "x"], "no-such-study"),
    ];
    for (arguments, line) in cases {
        let done = study(arguments);
        let error = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{error}");
        assert!(error.contains(line), "{error}");
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_told_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    let done = study(&["accuracy", "--out", file.to_str().unwrap()]);
    let error = text(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{error}");
    assert!(error.starts_with("wobble: ") && error.contains("cannot be made") && error.lines().count() == 1, "{error}");
}

#[test]
fn help_has_examples_and_the_problems() {
    let help = text(&study(&["accuracy", "--help"]).stdout);
    assert!(help.contains("Examples:") && help.contains("D1_pendulum90"), "{help}");
    assert!(study(&["--help"]).status.success());
}
