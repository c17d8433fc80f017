//! Every shader compiles, and none lies about unused.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use naga::valid::{Capabilities, ValidationFlags, Validator};
use wobble::render::SHADERS;

#[test]
fn every_shader_is_valid() {
    for (name, source) in SHADERS {
        let module = naga::front::wgsl::parse_str(source).unwrap_or_else(|error| {
            panic!("{name}: {}", error.emit_to_string(source));
        });
        let valid = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
        if let Err(error) = valid {
            panic!("{name}: {}", error.emit_to_string(source));
        }
    }
}

#[test]
fn every_file_of_the_folder_is_compiled_into_the_program() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(SHADERS.iter().any(|(_, source)| source.contains(&text)), "{} is not used", path.display());
        count += 1;
    }
    assert_eq!(count, SHADERS.len() + 3, "one file a pass, and three that they share");
}

#[test]
fn uniforms_have_the_same_fields_in_both_languages() {
    let rust = include_str!("../src/render/frame.rs");
    let wgsl = include_str!("../shaders/common.wgsl");
    let fields = |text: &str, start: &str| -> Vec<String> {
        let body = text.split(start).nth(1).unwrap().split('}').next().unwrap();
        let lines = body.lines().map(str::trim).filter(|line| !line.starts_with("//"));
        lines.filter_map(|line| line.split_once(':')).map(|(name, _)| name.to_owned()).collect()
    };
    let (rust, wgsl) = (fields(rust, "struct Frame {"), fields(wgsl, "struct Frame {"));
    assert!(rust.len() > 10);
    assert_eq!(rust, wgsl);
}

/// Mesa's lavapipe 22.3 builds a shader anew, and keeps it for good, whenever a uniform changes that it branches by alone: some megabytes a second.
#[test]
fn no_shader_branches_by_uniforms_alone() {
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut seen = 0;
    for (name, source) in SHADERS {
        let conditions =
            source.lines().filter_map(|line| line.trim().trim_start_matches("} else ").strip_prefix("if "));
        for condition in conditions {
            let asks = condition.split(['|', '&']).filter(|part| part.contains("frame."));
            for part in asks {
                let others = part
                    .split(|c| !is_name(c))
                    .filter(|word| !word.starts_with("frame.") && word.chars().next().is_some_and(char::is_alphabetic));
                assert!(others.count() > 0, "{name}: `if {condition}` asks for the frame alone: use `is_set`");
                seen += 1;
            }
        }
    }
    assert!(seen > 10, "{seen}");
}
