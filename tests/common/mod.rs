//! What several tests share.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its part of this")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

pub mod commands;
pub mod damage;
pub mod golden;
pub mod inside;
pub mod jumping;
pub mod panels;
pub mod physics;
pub mod picture;
pub mod session;
pub mod unilateral;

use std::io::Write;
use std::path::PathBuf;

/// A file of the tests.
pub fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

/// A test cannot run here: says so where nobody captures it; fails if WOBBLE_REQUIRE names `what`.
pub fn skip(what: &str, reason: &str) {
    let required = std::env::var("WOBBLE_REQUIRE").unwrap_or_default();
    assert!(!required.split(',').any(|name| name == what), "WOBBLE_REQUIRE names {what}, but {reason}");
    let test = std::thread::current().name().unwrap_or("test").to_owned();
    say(&format!("skipped: {test}: {reason}"));
}

/// Says something of a test that passes.
pub fn say(line: &str) {
    // Not eprintln!, which the test runner keeps to itself then.
    let mut stderr = std::io::stderr();
    writeln!(stderr, "{line}").unwrap();
}

/// A GPU, or nothing and a word that the test was skipped.
pub fn gpu() -> Option<wobble::render::Gpu> {
    match wobble::render::Gpu::headless() {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            skip("gpu", &error.to_string());
            None
        }
    }
}

/// The picture that the program itself draws.
pub fn rendered(scene: &str, time: &str, size: &str) -> image::RgbaImage {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("x.png");
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_wobble"))
        .args(["render", scene, "--time", time, "--size", size, "--out"])
        .arg(&out)
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    image::open(out).unwrap().to_rgba8()
}

/// Whether a variable of the environment asks for this, or for nothing.
pub fn is_asked(variable: &str, name: &str) -> bool {
    std::env::var(variable).map_or(true, |asked| asked == name)
}

/// A number from a variable of the environment: figures that take long are run whole by it.
pub fn asked(variable: &str, otherwise: f64) -> f64 {
    std::env::var(variable).map_or(otherwise, |text| text.parse().unwrap())
}
