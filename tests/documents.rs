//! README, docs and the other pages: links lead somewhere, files that are named exist, scenes are read, keys are named, and the README
//! stays an invitation.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::Value;
use wobble::scene::{Scene, schema};

/// Most lines of the README, and most characters of each.
const README: [usize; 2] = [120, 120];
/// What the README shows: so many commands to begin with, calls of the command line, and scenes; and so many limitations at most.
const COMMANDS: usize = 2;
const CALLS: usize = 10;
const SCENES: usize = 1;
const LIMITATIONS: usize = 8;
/// Most characters of a line of the page on tools, but in tables, and most lines of what stands in it without a gap.
const TOOLS: [usize; 2] = [130, 6];
/// Most bytes of a picture that the README shows.
const PICTURE: u64 = 1_500_000;
/// Folders whose files pages name by their path.
const FOLDERS: [&str; 9] =
    ["src/", "shaders/", "assets/", "tests/", "benches/", "docs/", "examples/", "scripts/", ".ci/"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every page with its text.
fn pages() -> Vec<(PathBuf, String)> {
    let list = |folder: &str| std::fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let folders = ["", "docs", "benches/peers", "benches/results/0.1.0/stability"];
    let mut paths: Vec<PathBuf> = folders.into_iter().flat_map(list).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "md"));
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), std::fs::read_to_string(path).unwrap())).collect()
}

/// A page without its blocks of code, and those blocks, each with its language first.
fn parted(text: &str) -> (String, Vec<&str>) {
    let parts: Vec<&str> = text.split("```").collect();
    assert!(parts.len() % 2 == 1, "a block of code is left open");
    let prose = parts.iter().step_by(2).copied().collect::<Vec<_>>().join("\n");
    (prose, parts.into_iter().skip(1).step_by(2).collect())
}

/// A heading as links name it: small letters, digits, - and _, spaces as -.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
}

fn anchors(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    headings.map(|line| anchor(line.trim_start_matches('#').trim())).collect()
}

/// What is between `open` and the next `close`, everywhere.
fn between<'a>(text: &'a str, open: &str, close: char) -> impl Iterator<Item = &'a str> {
    text.split(open).skip(1).filter_map(move |rest| rest.split(close).next())
}

#[test]
fn links_lead_somewhere() {
    let mut found = 0;
    for (page, text) in pages() {
        for target in between(&parted(&text).0, "](", ')').filter(|target| !target.contains("://")) {
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let path = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            assert!(path.exists(), "{}: {target} is not there", page.display());
            if !heading.is_empty() {
                let there = anchors(&parted(&std::fs::read_to_string(&path).unwrap()).0);
                assert!(there.contains(heading), "{}: {target} has no such heading, but {there:?}", page.display());
            }
            found += 1;
        }
    }
    assert!(found > 60, "{found} links");
}

#[test]
fn files_that_are_named_exist() {
    let mut found = 0;
    for (page, text) in pages() {
        let (prose, blocks) = parted(&text);
        let words = between(&prose, "`", '`').chain(blocks).flat_map(str::split_whitespace);
        for word in words.map(|word| word.trim_matches(|c: char| ",.;:()\"'".contains(c) && c != '.')) {
            let is_path = FOLDERS.iter().any(|folder| word.starts_with(folder));
            if is_path && !word.contains(|c: char| "*{<…".contains(c)) {
                let word = word.trim_end_matches('.');
                assert!(root().join(word).exists(), "{}: `{word}` is not there", page.display());
                found += 1;
            }
        }
    }
    assert!(found > 60, "{found} paths");
}

#[test]
fn the_readme_stays_an_invitation() {
    let text = std::fs::read_to_string(root().join("README.md")).unwrap();
    let [lines, width] = README;
    assert!(text.lines().count() <= lines, "{} lines", text.lines().count());
    for (index, line) in text.lines().enumerate() {
        assert!(line.chars().count() <= width, "line {} has {} characters", index + 1, line.chars().count());
    }
    for picture in between(&text, "![", '\n').filter_map(|image| between(image, "](", ')').next()) {
        let bytes = std::fs::metadata(root().join(picture)).unwrap().len();
        assert!(bytes < PICTURE, "{picture} has {bytes} bytes");
    }
}

/// What stands under a heading, up to the next one of its kind.
fn under<'a>(text: &'a str, heading: &str) -> &'a str {
    let start = text.find(&format!("\n## {heading}\n")).unwrap_or_else(|| panic!("there is no part {heading:?}"));
    let part = &text[start + 1..];
    part.find("\n## ").map_or(part, |end| &part[..end])
}

/// The lines of blocks of code, without their languages and what is empty.
fn code<'a>(blocks: &[&'a str]) -> Vec<&'a str> {
    blocks.iter().flat_map(|block| block.lines().skip(1)).filter(|line| !line.trim().is_empty()).collect()
}

/// Whether an item of a list begins with a line: a point or a number.
fn is_item(line: &str) -> bool {
    let is_number = |number: &str| !number.is_empty() && number.chars().all(|c| c.is_ascii_digit());
    line.starts_with("- ") || line.starts_with("* ") || line.split_once(". ").is_some_and(|(start, _)| is_number(start))
}

#[test]
fn the_readme_has_two_commands_ten_calls_a_scene_and_few_limitations() {
    let text = std::fs::read_to_string(root().join("README.md")).unwrap();
    let blocks = parted(&text).1;
    // Each with what it does, after two spaces or more.
    let first = |line: &&str| line.split_once("  ").map_or("", |(call, _)| call).to_owned();
    let commands: Vec<String> = code(&blocks[..1]).iter().map(first).collect();
    assert_eq!(commands.len(), COMMANDS, "{commands:?}");
    assert_eq!(code(&blocks[..1]), code(&parted(under(&text, "Two commands")).1), "they come first");
    assert!(commands.iter().all(|command| root().join(command).is_file()), "{commands:?}");
    let calls: Vec<String> = code(&parted(under(&text, "The command line")).1).iter().map(first).collect();
    assert_eq!(calls.len(), CALLS, "{calls:?}");
    assert!(calls.iter().all(|call| call.split(' ').next() == Some("wobble")), "{calls:?}");
    assert_eq!(calls.iter().collect::<BTreeSet<_>>().len(), CALLS, "none is there twice: {calls:?}");
    let scenes = blocks.iter().filter(|block| block.starts_with("json"));
    assert_eq!(scenes.count(), SCENES);
    assert_eq!(blocks.len(), 2 + SCENES, "there is no other code");
    let limitations = under(&text, "Limitations").lines().filter(|line| is_item(line)).count();
    assert!((1..=LIMITATIONS).contains(&limitations), "{limitations} limitations");
}

#[test]
fn the_page_on_tools_can_be_read() {
    let text = std::fs::read_to_string(root().join("docs/tools.md")).unwrap();
    let [width, most] = TOOLS;
    let prose: Vec<&str> = text.lines().filter(|line| !line.starts_with('|')).collect();
    for line in &prose {
        assert!(line.chars().count() <= width, "{} characters: {line}", line.chars().count());
    }
    // A paragraph, or an item of a list.
    let ends = |line: &str| line.is_empty() || line.starts_with("- ");
    let (mut lines, mut parts) = (0, 0);
    for line in prose {
        lines = if ends(line) { 0 } else { lines + 1 };
        parts += usize::from(lines == 1);
        assert!(lines <= most, "a part is longer than {most} lines at: {line}");
    }
    assert!(parts > 40, "{parts} parts");
}

#[test]
fn scenes_and_parts_of_scenes_are_read() {
    let mut found = 0;
    for (page, text) in pages() {
        for block in parted(&text).1.into_iter().filter_map(|block| block.strip_prefix("json\n")) {
            let (is_whole, is_recording) = (block.starts_with('{'), block.contains("wobble_recording"));
            let whole = if is_whole { block.to_owned() } else { format!("{{ \"wobble\": 1, {block} }}") };
            // Recordings have a test of their own.
            let read = if is_recording { Ok(()) } else { serde_json::from_str::<Scene>(&whole).map(drop) };
            read.unwrap_or_else(|error| panic!("{}: {error} in\n{block}", page.display()));
            found += 1;
        }
    }
    assert!(found > 5, "{found} scenes");
}

#[test]
fn every_key_of_scenes_is_named() {
    fn collect(schema: &Value, keys: &mut BTreeSet<String>) {
        keys.extend(schema["properties"].as_object().into_iter().flatten().map(|(key, _)| key.clone()));
        schema["$defs"].as_object().into_iter().flatten().for_each(|(_, part)| collect(part, keys));
    }
    let mut keys = BTreeSet::new();
    collect(&schema(), &mut keys);
    assert!(keys.len() > 100, "{}", keys.len());
    let docs = ["docs/scenes.md", "docs/pictures.md"].map(|page| std::fs::read_to_string(root().join(page)).unwrap());
    keys.retain(|key| !docs.iter().any(|text| text.contains(&format!("`{key}`"))));
    assert!(keys.is_empty(), "docs/scenes.md names no {keys:?}");
}
