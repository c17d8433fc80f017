//! Whatever bytes a file has, reading it ends in a scene or in one line.

use proptest::prelude::*;
use wobble::scene::{Scene, gallery};

/// Texts to damage: small, and with most kinds of keys.
fn seeds() -> Vec<&'static str> {
    let mut seeds: Vec<_> = gallery().iter().map(|entry| entry.json).collect();
    seeds.push(r#"{"wobble":1,"dimensions":3,"points":{"position":[[0,0,0],[1,1,1]],"mass":[1,2],"pinned":[0]},
        "bonds":[{"a":0,"b":1,"kind":"spring","rest":0.5,"compliance":0.1,"limit":"max"}],"triangles":[],
        "obstacles":[{"box":{"min":[0,0,0],"max":[1,1,1],"rotation":{"axis":[0,1,0],"angle":1}}}],
        "pin_motion":[{"point":0,"track":[[0,1,2,3],[1,1,2,3]]}],"samples":[0,1.5e0],"view":{"target":[0,0,0],"distance":4}}"#);
    seeds.push(
        r#"{"wobble":1,"bodies":[{"make":"rope","count":3,"to":[1,1],"material":{"mass":2}},
        {"make":"cloth","columns":3,"rows":2,"spacing":0.1,"diagonals":"one"},
        {"make":"disc","radius":2,"spacing":0.5,"repeat":{"count":[2,3],"step":[5,5]}}],"method":{"iterations":2}}"#,
    );
    seeds
}

/// Reads, and where that works takes every way out; only the absence of a panic and the form of the message count.
fn exercise(text: &str) -> Result<(), TestCaseError> {
    match Scene::parse(text, "x.json") {
        Err(error) => {
            let line = error.to_string();
            prop_assert!(line.starts_with("x.json") && !line.contains('\n'), "{line:?}");
            prop_assert!(line.len() < 500);
        }
        Ok(scene) => {
            // A mutation may ask for millions of points: in order, and too slow to make by the thousand.
            let large = |body: &wobble::scene::BodyKeys| {
                [body.count, body.columns, body.rows, body.sectors].iter().flatten().any(|&n| n > 1000)
            };
            let many = |body: &wobble::scene::BodyKeys| {
                let copies = body.repeat.as_ref().map_or(1, |repeat| repeat.count.iter().product());
                copies > 100 || body.radius.unwrap_or(1.0) > 100.0 * body.spacing.unwrap_or(1.0)
            };
            if !scene.bodies.iter().any(|body| large(body) || many(body)) {
                let planar = scene.model::<2>().is_ok();
                let spatial = scene.model::<3>().is_ok();
                prop_assert!(!(planar && spatial));
                drop(scene.expanded());
            }
            let again = Scene::parse(&scene.to_json().unwrap(), "again").unwrap();
            prop_assert_eq!(again, scene);
        }
    }
    Ok(())
}

/// Pieces that are likely to hit something.
const PIECES: [&str; 22] = [
    "",
    "0",
    "-1",
    "1e999",
    "1e308",
    "5e-324",
    "4294967295",
    "18446744073709551616",
    "null",
    "true",
    "\"\"",
    "[]",
    "{}",
    "[[",
    "}",
    "\"",
    ",",
    ":",
    "\\",
    "\"a\":1,",
    "\u{1b}[31m\n",
    "é",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        exercise(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn damaged_scenes_never_panic(
        seed in 0..seeds().len(),
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0..12_usize, 0..PIECES.len()), 1..4),
    ) {
        let mut text = seeds()[seed].to_owned();
        for (place, length, piece) in cuts {
            let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
            let from = place.index(places.len());
            let to = (from + length).min(places.len() - 1);
            text.replace_range(places[from]..places[to], PIECES[piece]);
        }
        exercise(&text)?;
    }

    #[test]
    fn a_scene_cut_off_anywhere_is_refused(seed in 0..seeds().len(), place in any::<prop::sample::Index>()) {
        let text = seeds()[seed].trim_end();
        let places: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
        let cut = &text[..places[place.index(places.len())]];
        let error = Scene::parse(cut, "x.json").unwrap_err().to_string();
        prop_assert!(error.contains("cut off") || error.contains("is empty"), "{error}");
    }
}

/// The line of a message is that of the key that is wrong, wherever it stands.
#[test]
fn the_line_is_that_of_the_wrong_key() {
    for lines in 1..40 {
        let fill = "{ \"a\": 0, \"b\": 1 },\n".repeat(lines - 1);
        let text = format!(
            "{{\"wobble\":1,\"points\":{{\"position\":[[0,0],[1,1]]}},\n\"bonds\":[\n{fill}{{ \"a\": 0,\n \"b\": 7 }}]}}"
        );
        let error = Scene::parse(&text, "x.json").unwrap_err();
        assert_eq!((error.line, error.key), (Some(lines + 3), format!("bonds[{}].b", lines - 1)));
    }
}
