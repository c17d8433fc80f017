//! `wobble study` as a process: what it writes, and that what it writes is right.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn study(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wobble"));
    command.arg("study").args(arguments).env_remove("WOBBLE_COMMIT").env_remove("RAYON_NUM_THREADS").output().unwrap()
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
    // The live step has substeps of its own, whatever the problem's are.
    let live = find(&problem["methods"], "solver", "live")["runs"].as_array().unwrap();
    let is_near = |run: &Value| run["error"].as_f64().is_some_and(|error| error > 0.0 && error < 1e-3);
    assert!(live.len() > 5 && live.iter().all(is_near), "{live:?}");
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
    assert_eq!(problem["tolerance"].as_array().unwrap().len(), 3);
}

fn check_tables(out: &Path) {
    let orders = rows(out, "orders.csv");
    for problem in ["A2_drag", "B1_osc"] {
        assert!(orders.iter().any(|row| row[0] == problem && row[1] == "live"), "{problem} by the live step");
    }
    let row = orders.iter().find(|row| row[0] == "B1_osc" && row[1] == "sources' method").unwrap();
    assert!((row[2].parse::<f64>().unwrap() - 1.0).abs() < 0.2, "{row:?}");
    let runs = rows(out, "runs.csv");
    assert!(runs.len() > 20 && runs.iter().all(|row| row.len() == 15));
    assert!(runs.iter().all(|row| row[5].parse::<f64>().unwrap() > 0.0));
    let equal = rows(out, "equal-error.csv");
    assert!(equal.iter().any(|row| row[0] == "A2_drag" && row[2] == "1" && row[8] == "35.0"), "{equal:?}");
    let asked = named_rows(out, "asked.csv");
    for row in &asked {
        let most = if row["asked_m"] == "default" { 1e-3 * number(row, "size_m") } else { number(row, "asked_m") };
        assert!(number(row, "error_m") <= most && row["holds"] == "true", "{row:?}");
    }
    assert_eq!(asked.iter().filter(|row| row["asked_m"] == "default").count(), 2);
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

/// A row of a table by the names of its columns.
type Row = std::collections::BTreeMap<String, String>;

fn named_rows(folder: &Path, name: &str) -> Vec<Row> {
    let file = std::fs::File::open(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    csv::Reader::from_reader(file).deserialize().map(|row| row.unwrap()).collect()
}

fn number(row: &Row, column: &str) -> f64 {
    let text = row.get(column).unwrap_or_else(|| panic!("no {column} in {row:?}"));
    text.parse().unwrap_or_else(|_| panic!("{column} is {text:?} in {row:?}"))
}

/// Peers as `benches/peers` writes them, with the columns that are read.
const PEERS: &str = "engine,scene,setting,ms_per_frame,max_strain,max_error_m,is_finished\n\
                     some engine,\"rope 1,000\",4 substeps,2.5,0.01,,true\n\
                     some engine,\"rope 1,000\",1 substep,0.5,inf,,false\n\
                     some engine,rope 50 (F4),8 substeps,0.1,0.001,0.0005,true\n";

#[test]
fn speed_leaves_tables_and_plots() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("speed");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("peers.csv"), PEERS).unwrap();
    let done = study(&["speed", "--quick", "--commit", "abc", "--out", out.to_str().unwrap()]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(done.stdout.is_empty() && done.stderr.is_empty(), "no bar where there is no terminal");

    let report: Value = serde_json::from_str(&read(&out, "speed.json")).unwrap();
    assert_eq!((&report["commit"], &report["settings"]["threads"]), (&"abc".into(), &1.into()));
    check_frames(&named_rows(&out, "frames.csv"));
    check_sweeps(&named_rows(&out, "kernels.csv"));
    check_comparisons(&out);
    for name in ["cost-strain-rope-1000", "sweeps"] {
        assert_well_formed(&read(&out, &format!("{name}.svg")));
        let image = image::open(out.join(format!("{name}.png"))).unwrap().into_rgb8();
        assert!(image.pixels().filter(|pixel| pixel.0 != [255; 3]).count() > 5000, "{name} is empty");
    }
    assert!(read(&out, "cost-strain-rope-1000.svg").contains("some engine"));
}

/// Every scene holds the strain that was asked for, and the counters make sense.
fn check_frames(rows: &[Row]) {
    let asked: Vec<&Row> = rows.iter().filter(|row| row["method"].starts_with("strain")).collect();
    assert_eq!(asked.len(), 6, "three scenes at two strains");
    for row in asked {
        assert!(number(row, "max_strain") <= number(row, "max_strain_asked"), "{row:?}");
        assert!(number(row, "rms_strain") <= number(row, "max_strain"), "{row:?}");
        assert_eq!((row["is_within"].as_str(), row["frames"].as_str(), row["threads"].as_str()), ("true", "120", "1"));
        assert!(number(row, "substeps") >= 1.0 && number(row, "bond_bytes") > 16.0, "{row:?}");
        for column in ["median_ms", "mean_ms", "bond_ns", "build_s", "point_bytes"] {
            assert!(number(row, column) > 0.0, "{column} of {row:?}");
        }
        assert!(!row["kernel"].is_empty() && !row["instruction_set"].is_empty());
    }
}

/// Every kind of body in both precisions, with every instruction set that this machine has.
fn check_sweeps(rows: &[Row]) {
    for family in ["net", "hard", "rope", "rims", "disc"] {
        for precision in ["f32", "f64"] {
            let is_same = |row: &&Row| row["family"] == family && row["precision"] == precision;
            assert!(rows.iter().any(|row| is_same(&row)), "{family} {precision}");
        }
    }
    for row in rows {
        assert!(!row["kernel"].is_empty() && number(row, "bonds") > 2_000.0, "{row:?}");
        for column in ["sweep_ns", "rest_ns", "step_ms", "naive_ns", "ratio"] {
            assert!(number(row, column).is_finite(), "{column} of {row:?}");
        }
    }
}

fn check_comparisons(out: &Path) {
    let rules = named_rows(out, "rules.csv");
    assert_eq!(rules[0]["scene"], "rope-1000");
    assert!(number(&rules[0], "ratio").is_finite() && !rules[0]["cheapest"].is_empty());
    let errors: Vec<f64> = named_rows(out, "rope50.csv").iter().map(|row| number(row, "error_m")).collect();
    assert!(errors.iter().any(|error| *error < 5e-5), "{errors:?}");
    for row in named_rows(out, "skipping.csv").iter().filter(|row| row["what"] != "asleep") {
        assert!(number(row, "ratio").is_finite(), "{row:?}");
    }
    let ratios = named_rows(out, "ratios.csv");
    let of =
        |scene: &str, bound: &str| ratios.iter().find(|row| row["scene"] == scene && row["bound"] == bound).unwrap();
    assert!(number(of("rope-1000", "0.02"), "ratio").is_finite());
    assert!(number(of("rope-50", "0.001"), "ratio").is_finite());
    assert_eq!(of("rope-1000", "0.001")["ratio"], "", "it never got there");
    let targets = named_rows(out, "targets.csv");
    assert!(targets.len() > 30 && targets.iter().any(|row| !row["is_reached"].is_empty()));
    let all = std::thread::available_parallelism().unwrap().get();
    if all > 1 {
        let others = named_rows(&out.join(format!("threads-{all}")), "frames.csv");
        assert!(others.iter().all(|row| row["threads"] == all.to_string()), "{others:?}");
        let threads = named_rows(out, "threads.csv");
        assert!(threads.iter().any(|row| row["scene"] == "rope-1000"), "{threads:?}");
        assert!(threads.iter().all(|row| number(row, "ratio").is_finite()), "{threads:?}");
    }
}

#[test]
fn a_wrong_call_ends_with_2_and_a_line_that_helps() {
    let cases: [(&[&str], &str); 6] = [
        (&["speed", "hard-99"], "hard-100, hard-316"),
        (&["speed", "--part", "all"], "frames, sweeps"),
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
    let help = text(&study(&["speed", "--help"]).stdout);
    assert!(help.contains("Examples:") && help.contains("hard-corners-100") && help.contains("skipping"), "{help}");
    assert!(study(&["--help"]).status.success());
}
