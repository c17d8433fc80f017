//! Holds the arrows between rooms that ARCHITECTURE.md draws, by the paths that the code names.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::path::{Path, PathBuf};

/// Each room, the rooms that it may name, and the crates that it may name beside those for every room.
const ROOMS: [(&str, &[&str], &[&str]); 12] = [
    ("sim", &[], &["rand", "rand_pcg", "libm", "rayon", "fearless_simd", "aligned_vec"]),
    ("body", &["sim", "picture"], &["rand", "rand_pcg", "libm", "spade"]),
    ("picture", &[], &["image", "spade", "earcutr", "libm", "rayon"]),
    (
        "scene",
        &["sim", "body", "picture", "output"],
        &["base64", "serde", "serde_json", "serde_path_to_error", "schemars", "xxhash_rust", "csv"],
    ),
    ("equilibrium", &["sim"], &["rand", "rand_pcg"]),
    ("search", &["sim"], &[]),
    (
        "history",
        &["sim", "body", "picture", "scene", "output"],
        &["base64", "flate2", "serde", "serde_json", "serde_path_to_error", "schemars"],
    ),
    ("render", &["sim", "picture"], &["wgpu", "image", "pollster"]),
    ("output", &[], &["tempfile"]),
    (
        "app",
        &["sim", "equilibrium", "search", "body", "picture", "scene", "history", "render", "output"],
        &["wgpu", "winit", "egui", "egui_wgpu", "egui_winit", "rfd", "arboard", "pollster"],
    ),
    (
        "study",
        &["sim", "equilibrium", "search", "body", "scene", "history", "output"],
        &["serde", "serde_json", "csv", "plotters", "epaint_default_fonts", "image"],
    ),
    (
        "cli",
        &["sim", "equilibrium", "search", "body", "picture", "scene", "history", "render", "output", "app", "study"],
        &["clap", "anyhow", "indicatif", "image", "serde_json", "tiny_skia"],
    ),
];

/// Crates that every room may name.
const EVERYWHERE: [&str; 6] = ["std", "thiserror", "bytemuck", "glam", "crate", "core"];

/// Crates that are somewhere in the program: a path that starts with one of these is held to the table.
const KNOWN: [&str; 32] = [
    "earcutr",
    "base64",
    "flate2",
    "spade",
    "tiny_skia",
    "rayon",
    "fearless_simd",
    "aligned_vec",
    "rand",
    "rand_pcg",
    "libm",
    "serde",
    "serde_json",
    "serde_path_to_error",
    "schemars",
    "xxhash_rust",
    "csv",
    "wgpu",
    "image",
    "pollster",
    "tempfile",
    "winit",
    "egui",
    "egui_wgpu",
    "egui_winit",
    "rfd",
    "arboard",
    "clap",
    "anyhow",
    "indicatif",
    "plotters",
    "epaint_default_fonts",
];

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut list = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { list.extend(files(&path)) } else { list.push(path) }
    }
    list.sort();
    list
}

/// The code of a file: no comments, nothing of its test module.
fn code(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let text = text.split("#[cfg(test)]").next().unwrap();
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// Names before `::` at the start of a path.
fn heads(code: &str) -> Vec<String> {
    let bytes = code.as_bytes();
    let is_name = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    let mut list = Vec::new();
    for (at, _) in code.match_indices("::") {
        let start = (0..at).rev().take_while(|&i| is_name(bytes[i])).last().unwrap_or(at);
        if !code[..start].ends_with("::") {
            list.push(code[start..at].to_owned());
        }
    }
    list
}

/// Rooms named by `crate::room` in a path, grouped imports included.
fn rooms_named(code: &str) -> Vec<String> {
    let names = |part: &str| {
        let part = part.trim_start();
        part.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>()
    };
    let mut list = Vec::new();
    for part in code.split("crate::").skip(1) {
        match part.strip_prefix('{') {
            Some(group) => list.extend(group.split('}').next().unwrap().split(',').map(names)),
            None => list.push(names(part)),
        }
    }
    list
}

#[test]
fn rooms_name_only_what_stands_below_them() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut seen = 0;
    for path in files(&source) {
        let inside = path.strip_prefix(&source).unwrap().to_str().unwrap().to_owned();
        let room = inside.split(['/', '.']).next().unwrap();
        // Of tests alone.
        if matches!(room, "lib" | "main") || inside.contains("/tests/") || inside.ends_with("tests.rs") {
            continue;
        }
        let (_, rooms, crates) =
            ROOMS.iter().find(|(name, ..)| *name == room).unwrap_or_else(|| panic!("room {room} is not drawn"));
        let code = code(&path);
        for named in rooms_named(&code) {
            let known = ROOMS.iter().any(|(name, ..)| *name == named);
            assert!(!known || named == room || rooms.contains(&named.as_str()), "{inside} names {named}");
        }
        for head in heads(&code) {
            let held = KNOWN.contains(&head.as_str()) && !EVERYWHERE.contains(&head.as_str());
            assert!(!held || crates.contains(&head.as_str()), "{inside} names the crate {head}");
        }
        seen += 1;
    }
    assert!(seen > 30);
}

#[test]
fn the_simulation_knows_no_clock_and_no_file() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/sim");
    for path in files(&source) {
        let code = code(&path);
        for word in ["std::time", "std::fs", "std::env", "Instant", "HashMap", "HashSet"] {
            assert!(!code.contains(word), "{} names {word}", path.display());
        }
    }
}

#[test]
fn the_page_draws_every_room() {
    let page = include_str!("../ARCHITECTURE.md");
    for (room, ..) in ROOMS {
        assert!(page.contains(&format!("`{room}`")), "{room}");
    }
}
