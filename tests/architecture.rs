//! Holds the arrows between rooms that ARCHITECTURE.md draws, by the paths that the code names.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod paths;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Each room, the rooms that it may name, which all stand above it here, and the crates that it may name beside those for every
/// room.
const ROOMS: [(&str, &[&str], &[&str]); 13] = [
    ("output", &[], &["tempfile"]),
    ("picture", &[], &["image", "spade", "earcutr", "libm", "rayon"]),
    ("sim", &[], &["rand", "rand_pcg", "libm", "rayon", "fearless_simd", "aligned_vec", "petgraph"]),
    ("equilibrium", &["sim"], &["rand", "rand_pcg"]),
    ("search", &["sim"], &[]),
    ("body", &["sim", "picture"], &["rand", "rand_pcg", "libm", "spade"]),
    ("render", &["sim", "picture"], &["wgpu", "image", "pollster"]),
    (
        "scene",
        &["sim", "body", "picture", "output"],
        &["base64", "serde", "serde_json", "serde_path_to_error", "schemars", "xxhash_rust", "csv", "libm"],
    ),
    (
        "history",
        &["sim", "body", "picture", "scene", "output"],
        &["base64", "flate2", "serde", "serde_json", "serde_path_to_error", "schemars", "libm"],
    ),
    ("lessons", &["sim", "scene"], &["serde", "serde_json", "libm"]),
    (
        "study",
        &["sim", "equilibrium", "search", "body", "scene", "history", "output"],
        &["serde", "serde_json", "csv", "plotters", "epaint_default_fonts", "image", "libm"],
    ),
    (
        "app",
        &["sim", "equilibrium", "search", "body", "picture", "scene", "history", "lessons", "render", "output"],
        &[
            "wgpu",
            "winit",
            "egui",
            "egui_plot",
            "egui_wgpu",
            "egui_winit",
            "rfd",
            "strsim",
            "arboard",
            "pollster",
            "image",
            "etcetera",
            "serde",
            "serde_json",
        ],
    ),
    (
        "cli",
        &[
            "sim",
            "equilibrium",
            "search",
            "body",
            "picture",
            "scene",
            "history",
            "lessons",
            "render",
            "output",
            "app",
            "study",
        ],
        &["clap", "anyhow", "indicatif", "image", "serde_json", "signal_hook", "tiny_skia"],
    ),
];

/// Each module of `sim` and those that it may name, which all stand above it here: so there is no circle.
const SIM: [(&str, &[&str]); 46] = [
    ("real", &[]),
    ("drive", &[]),
    ("shared", &[]),
    ("sets", &[]),
    ("sizes", &[]),
    ("threads", &["sizes"]),
    ("timeline", &[]),
    ("counters", &[]),
    ("colour", &[]),
    ("ledger", &[]),
    ("bond", &["drive", "real"]),
    ("bonds", &["bond", "drive", "shared"]),
    ("source", &["bond"]),
    ("solver", &["bond", "source"]),
    ("moved", &["bond", "solver"]),
    ("vector", &["real"]),
    ("triangles", &["bond", "vector"]),
    ("points", &["real"]),
    ("solve", &["real", "vector"]),
    ("kernels", &["real", "threads", "vector"]),
    ("measure", &["bond", "bonds", "drive", "ledger", "points", "real", "vector"]),
    ("swept", &["points", "real", "sets", "vector"]),
    ("reach", &["bond"]),
    ("contact", &["bond", "points", "real", "sets", "sizes", "vector"]),
    ("force", &["bond", "colour", "drive", "measure", "points", "real", "vector"]),
    ("environment", &["drive", "force", "real", "swept", "vector"]),
    ("constrain", &["bond", "colour", "contact", "force", "points", "real", "solve", "solver", "vector"]),
    ("pull", &["constrain", "contact", "counters", "environment", "force", "points", "real", "swept", "vector"]),
    ("account", &["bond", "environment", "force", "ledger", "points", "pull", "real", "vector"]),
    (
        "integrate",
        &[
            "bond",
            "constrain",
            "contact",
            "counters",
            "environment",
            "force",
            "measure",
            "points",
            "pull",
            "real",
            "solve",
            "vector",
        ],
    ),
    (
        "bulk",
        &[
            "account",
            "bond",
            "colour",
            "contact",
            "counters",
            "environment",
            "force",
            "kernels",
            "measure",
            "points",
            "pull",
            "real",
            "sizes",
            "source",
            "swept",
            "threads",
            "vector",
        ],
    ),
    (
        "rigid",
        &[
            "account",
            "bond",
            "bulk",
            "contact",
            "counters",
            "drive",
            "environment",
            "force",
            "integrate",
            "ledger",
            "points",
            "pull",
            "real",
            "sets",
            "sizes",
            "solve",
            "swept",
            "vector",
        ],
    ),
    (
        "printed",
        &[
            "account",
            "bond",
            "bulk",
            "constrain",
            "contact",
            "counters",
            "environment",
            "force",
            "points",
            "pull",
            "real",
            "solver",
            "source",
            "vector",
        ],
    ),
    (
        "live",
        &[
            "account",
            "bond",
            "bulk",
            "colour",
            "contact",
            "counters",
            "drive",
            "environment",
            "force",
            "kernels",
            "ledger",
            "measure",
            "points",
            "pull",
            "reach",
            "real",
            "rigid",
            "sets",
            "sizes",
            "solve",
            "swept",
            "triangles",
            "vector",
        ],
    ),
    ("model", &["bond", "bonds", "contact", "drive", "force", "real", "sets", "solver", "source", "vector"]),
    (
        "group",
        &[
            "account",
            "bond",
            "bulk",
            "constrain",
            "contact",
            "counters",
            "environment",
            "force",
            "integrate",
            "ledger",
            "measure",
            "moved",
            "points",
            "pull",
            "real",
            "sizes",
            "solve",
            "timeline",
            "vector",
        ],
    ),
    ("plan_part", &["solver"]),
    (
        "plan",
        &[
            "account",
            "bond",
            "bonds",
            "bulk",
            "colour",
            "constrain",
            "contact",
            "counters",
            "drive",
            "force",
            "group",
            "integrate",
            "kernels",
            "live",
            "measure",
            "model",
            "moved",
            "plan_part",
            "points",
            "printed",
            "pull",
            "real",
            "rigid",
            "sets",
            "sizes",
            "solve",
            "solver",
            "source",
            "vector",
        ],
    ),
    ("command", &["bond", "contact", "drive", "force", "model"]),
    ("saved", &["bond", "drive", "force", "model", "moved", "real"]),
    (
        "dynamics",
        &[
            "bond",
            "bonds",
            "command",
            "contact",
            "counters",
            "drive",
            "force",
            "ledger",
            "model",
            "moved",
            "plan_part",
            "real",
            "saved",
        ],
    ),
    (
        "world",
        &[
            "account",
            "bond",
            "bonds",
            "command",
            "constrain",
            "contact",
            "counters",
            "drive",
            "dynamics",
            "environment",
            "force",
            "group",
            "ledger",
            "measure",
            "model",
            "moved",
            "plan",
            "plan_part",
            "points",
            "reach",
            "real",
            "saved",
            "sets",
            "sizes",
            "solver",
            "timeline",
            "triangles",
            "vector",
        ],
    ),
    (
        "edit",
        &[
            "bond",
            "bonds",
            "bulk",
            "command",
            "contact",
            "drive",
            "dynamics",
            "environment",
            "force",
            "group",
            "model",
            "moved",
            "plan",
            "plan_part",
            "points",
            "reach",
            "real",
            "solver",
            "triangles",
            "vector",
            "world",
        ],
    ),
    (
        "handover",
        &[
            "bond",
            "bulk",
            "contact",
            "counters",
            "environment",
            "group",
            "live",
            "measure",
            "moved",
            "plan",
            "reach",
            "real",
            "solver",
            "swept",
            "timeline",
            "vector",
            "world",
        ],
    ),
    ("step", &["counters", "environment", "group", "handover", "real", "threads", "world"]),
    ("build", &["dynamics", "model", "plan", "world"]),
];

/// Crates that every room may name.
const EVERYWHERE: [&str; 5] = ["std", "core", "thiserror", "bytemuck", "glam"];

/// The crates that Cargo.toml names, as code does, but for those of tests alone.
fn crates() -> Vec<String> {
    let text = include_str!("../Cargo.toml");
    let lines =
        text.lines().skip_while(|line| *line != "[dependencies]").skip(1).take_while(|line| !line.starts_with('['));
    lines.filter_map(|line| Some(line.split_once('=')?.0.trim().replace('-', "_"))).collect()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut list = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { list.extend(files(&path)) } else { list.push(path) }
    }
    list.sort();
    list
}

/// Every source file that is not of tests alone: its place in `src`, its module and its text.
fn sources() -> Vec<(String, Vec<String>, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut list = Vec::new();
    for path in files(&root) {
        let place = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
        if !place.contains("/tests/") && !place.ends_with("tests.rs") {
            let stem = place.strip_suffix(".rs").unwrap();
            let module = stem.strip_suffix("/mod").unwrap_or(stem).split('/').map(str::to_owned).collect();
            list.push((place, module, std::fs::read_to_string(&path).unwrap()));
        }
    }
    list
}

/// What a text of this module names that it may not.
fn forbidden(text: &str, module: &[&str], crates: &[String]) -> Vec<String> {
    let room = module[0];
    let (_, rooms, own) =
        ROOMS.iter().find(|(name, ..)| *name == room).unwrap_or_else(|| panic!("room {room} is not drawn"));
    let may_name = |path: &[String]| match path.first().map(String::as_str) {
        Some("crate") => {
            let Some(named) = path.get(1).map(String::as_str) else { return false };
            if room == "sim" && named == "sim" {
                within_sim(module, path)
            } else {
                named == room || rooms.contains(&named)
            }
        }
        Some(head) => !crates.iter().any(|known| known == head) || EVERYWHERE.contains(&head) || own.contains(&head),
        None => true,
    };
    paths::named(text, module).iter().filter(|path| !may_name(path)).map(|path| path.join("::")).collect()
}

/// Whether a module of `sim` may name a path in it. What `sim` shows to other rooms is not for its own modules.
fn within_sim(module: &[&str], path: &[String]) -> bool {
    let Some(&own) = module.get(1) else { return true };
    let Some(named) = path.get(2).map(String::as_str) else { return false };
    let may = SIM.iter().find(|(name, _)| *name == own).map_or(&[][..], |(_, may)| *may);
    named == own || may.contains(&named)
}

#[test]
fn rooms_name_only_what_stands_below_them() {
    let (crates, mut seen) = (crates(), 0);
    let mut wrong = Vec::new();
    for (place, module, text) in sources() {
        if matches!(place.as_str(), "lib.rs" | "main.rs") {
            continue;
        }
        let module: Vec<&str> = module.iter().map(String::as_str).collect();
        wrong.extend(forbidden(&text, &module, &crates).into_iter().map(|path| format!("{place} names {path}")));
        seen += 1;
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen > 30 && crates.len() > 20);
}

/// The rooms without their crates.
fn rooms() -> Vec<(&'static str, &'static [&'static str])> {
    ROOMS.iter().map(|&(room, may, _)| (room, may)).collect()
}

#[test]
fn rooms_and_modules_stand_in_no_circle() {
    for table in [&rooms()[..], &SIM] {
        for (at, (own, may)) in table.iter().enumerate() {
            for named in *may {
                let is_above = table[..at].iter().any(|(above, _)| above == named);
                assert!(is_above, "{own} may name {named}, which does not stand above it in the table");
            }
        }
    }
}

#[test]
fn the_table_has_every_module_of_the_simulation() {
    let listed = sources().into_iter().filter(|(_, module, _)| module[0] == "sim");
    let found: BTreeSet<String> = listed.filter_map(|(_, module, _)| module.get(1).cloned()).collect();
    let table: BTreeSet<String> = SIM.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(found, table);
}

/// Each kind of path that leads where it may not, in a made-up file.
#[test]
fn every_kind_of_forbidden_path_is_found() {
    let crates = crates();
    let found = |text: &str, module: &[&str]| forbidden(text, module, &crates);
    let deep = ["sim", "force", "spring"];
    for (text, path) in [
        ("use crate::scene::Scene;", "crate::scene::Scene"),
        ("use crate::{body, sim::real::Real};", "crate::body"),
        ("use crate::{sim::{real::Real, world::{self}}};", "crate::sim::world"),
        ("use crate::sim::group as g;", "crate::sim::group"),
        ("use super::super::group::Group;", "crate::sim::group::Group"),
        ("use super::super::super::render;", "crate::render"),
        ("use super::{super::plan::Plan};", "crate::sim::plan::Plan"),
        ("use super::super::*;", "crate::sim::*"),
        ("use crate::sim::Bond;", "crate::sim::Bond"),
        ("use crate::*;", "crate::*"),
        ("use crate as root;", "crate"),
        ("use wgpu as gpu;", "wgpu"),
        ("fn f() -> Vec<super::super::world::World> { Vec::<u8>::new() }", "crate::sim::world::World"),
        ("const N: usize = 2 * crate::sim::plan::MOST as usize;", "crate::sim::plan::MOST"),
        ("fn f(x: u8) { let y = A::B as crate::app::C; }", "crate::app::C"),
        ("mod inner { use super::super::super::step; }", "crate::sim::step"),
        ("#[cfg(test)] mod tests { fn f() { let brace = '}'; } }\nuse super::super::edit;", "crate::sim::edit"),
        ("#[cfg(test)]\n#[path = \"x;{.rs\"]\nmod tests;\nfn f() { ::egui::warn(\"//\"); }", "egui::warn"),
        ("/* use crate::bonds; /* */ */ const C: char = '\"'; const D: u8 = crate::app::D; // \"", "crate::app::D"),
    ] {
        assert_eq!(found(text, &deep), [path], "{text}");
    }
    assert_eq!(found("use super::world::World;", &["sim", "group"]), ["crate::sim::world::World"]);
    assert_eq!(found("use super::super::app::App;", &["render", "gpu"]), ["crate::app::App"]);
    assert_eq!(found("use self::super::super::cli;", &["app", "input"]), ["crate::cli"]);
}

#[test]
fn what_is_no_path_of_the_code_is_not_found() {
    let crates = crates();
    for text in [
        "use super::mouse::{self, Push}; use crate::sim::{real::Real, vector::{add, sub}}; use std::fmt;",
        "// use crate::app::App;\n/// [`World`](crate::sim::world::World)\n/* crate::cli */ fn f() {}",
        "const A: &str = \"crate::app::App\"; const B: &str = r#\"crate::\"app::B\"#; const C: &[u8] = br\"crate::cli\";",
        "#[cfg(test)]\nmod tests {\n    use crate::sim::world::World;\n    fn f() { let _ = \"}\"; use crate::scene::Scene; }\n}",
        "#[cfg(test)]\n#[allow(dead_code, reason = \"{\")]\nfn only() { crate::app::run() }",
        "pub(in crate::sim) fn f<'a>(x: &'a str) -> Self { Self::new::<u8>(x) }",
        "mod inner { use super::Spring; use super::super::mouse; }",
    ] {
        assert_eq!(forbidden(text, &["sim", "force", "spring"], &crates), [] as [&str; 0], "{text}");
    }
}

#[test]
fn the_simulation_knows_no_clock_and_no_file() {
    for (place, _, text) in sources().into_iter().filter(|(_, module, _)| module[0] == "sim") {
        let code = paths::without_tests(&paths::bare(&text));
        for word in ["std::time", "std::fs", "std::env", "Instant", "HashMap", "HashSet"] {
            assert!(!code.contains(word), "{place} names {word}");
        }
    }
}

/// A table as ARCHITECTURE.md draws it, top down: of what each may name, what it may not name through another.
fn drawing(table: &[(&str, &[&str])]) -> String {
    let may = |own: &str| table.iter().find(|(name, _)| *name == own).map_or(&[][..], |(_, may)| *may);
    let line = |(own, named): &(&str, &[&str])| {
        let direct = named.iter().filter(|name| !named.iter().any(|other| may(other).contains(name)));
        let direct: Vec<&str> = direct.copied().collect();
        if direct.is_empty() { (*own).to_owned() } else { format!("{own:<12}──► {}", direct.join(", ")) }
    };
    table.iter().rev().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_page_draws_both_tables() {
    let page = include_str!("../ARCHITECTURE.md");
    for drawing in [drawing(&rooms()), drawing(&SIM)] {
        assert!(page.contains(&format!("```\n{drawing}\n```")), "ARCHITECTURE.md should draw:\n{drawing}");
    }
    let listed: Vec<(String, Vec<String>)> =
        page.lines().skip_while(|line| !line.starts_with("| room |")).skip(2).map_while(row).collect();
    let mut expected: Vec<&str> = ROOMS.iter().map(|(room, ..)| *room).collect();
    let mut found: Vec<&str> = listed.iter().map(|(room, _)| room.as_str()).collect();
    expected.sort_unstable();
    found.sort_unstable();
    assert_eq!(found, expected, "the rooms that ARCHITECTURE.md lists");
    for (room, may, _) in ROOMS {
        let (_, named) = listed.iter().find(|(name, _)| name == room).unwrap();
        let mut may = may.to_vec();
        may.sort_unstable();
        assert_eq!(named, &may, "what ARCHITECTURE.md says that {room} may name");
    }
}

/// A room of the page's list and the rooms that it may name, in the order of the alphabet.
fn row(line: &str) -> Option<(String, Vec<String>)> {
    let cells: Vec<&str> = line.strip_prefix("| `")?.trim_end_matches(" |").split(" | ").collect();
    let (room, may) = (cells[0].trim_end_matches('`').to_owned(), *cells.last()?);
    let quoted = |text: &str| text.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<String>>();
    let all = || rooms().iter().map(|(name, _)| (*name).to_owned()).filter(|name| *name != room).collect::<Vec<_>>();
    let mut named: Vec<String> = match may {
        "nothing else" => Vec::new(),
        "all" => all(),
        _ if may.starts_with("all but ") => {
            let without = quoted(may);
            all().into_iter().filter(|name| !without.contains(name)).collect()
        }
        _ => quoted(may),
    };
    named.sort_unstable();
    Some((room, named))
}
