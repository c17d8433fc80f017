//! Bytes that are no scene are refused in one line, which names the place.

use proptest::prelude::*;
use wobble::scene::{Scene, gallery};

/// Texts to cut off: small, and with most kinds of keys.
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_are_refused_in_a_line(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let line = Scene::parse(&String::from_utf8_lossy(&bytes), "x.json").unwrap_err().to_string();
        prop_assert!(line.starts_with("x.json") && !line.contains('\n') && line.len() < 500, "{line:?}");
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
