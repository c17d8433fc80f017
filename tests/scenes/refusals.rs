//! What is refused, and in which words: file, line, key, fault and cure.

use wobble::scene::{Scene, SceneErrorKind};
use wobble::sim::Contact;

/// A scene in the plane with two points on line 2 and the rest on line 3.
fn plane(rest: &str) -> String {
    format!("{{ \"wobble\": 1,\n\"points\": {{ \"position\": [[0,0],[1,0]], \"pinned\": [0] }},\n{rest} }}")
}

/// The same in space.
fn space(rest: &str) -> String {
    format!("{{ \"wobble\": 1, \"dimensions\": 3,\n\"points\": {{ \"position\": [[0,0,0],[1,0,0]] }},\n{rest} }}")
}

fn refusal(text: &str) -> String {
    match Scene::parse(text, "x.json") {
        Ok(_) => panic!("accepted: {text}"),
        Err(error) => error.to_string(),
    }
}

/// Every row: what stands on line 3, and the whole message after "x.json:3: ".
fn hold(form: fn(&str) -> String, rows: &[(&str, &str)]) {
    for (rest, message) in rows {
        assert_eq!(refusal(&form(rest)), format!("x.json:3: {message}"), "{rest}");
    }
}

#[test]
fn texts_that_are_no_scene() {
    for (text, message) in [
        ("", "x.json: is empty: a scene starts with {\"wobble\": 1, …}"),
        (" \n ", "x.json: is empty: a scene starts with {\"wobble\": 1, …}"),
        ("\u{feff}{}", "x.json:1: starts with a byte order mark: save it as UTF-8 without one"),
        (
            "{ \"wobble\": 1,\n\"points\": {",
            "x.json:2: points: the text ends in the middle: it was cut off, so get it whole",
        ),
        ("{ \"wobble\": 1,\n}", "x.json:2: is not JSON: trailing comma (column 1)"),
        ("{ \"wobble\": 1 } x", "x.json:1: is not JSON: trailing characters (column 17)"),
        ("[]", "x.json:1: is a list: give a scene: an object with the key `wobble`"),
        ("{}", "x.json:1: the key `wobble` is missing: add \"wobble\": 1"),
        (
            "{ \"zork\": 1,\n\"wobble\": 2 }",
            "x.json:2: wobble: is version 2: this program reads version 1, so write \"wobble\": 1 or get a newer wobble",
        ),
        ("{ \"wobble\": \"1\" }", "x.json:1: wobble: is string \"1\": give a whole number, 0 or more"),
    ] {
        assert_eq!(refusal(text), message, "{text}");
    }
}

#[test]
fn keys_and_types() {
    hold(
        plane,
        &[
            ("\"gravty\": [0,0]", "gravty: unknown key: did you mean `gravity`?"),
            (
                "\"bounds\": { \"zork\": 1 }",
                "bounds.zork: unknown key: the keys here are `min`, `max`, `restitution` and `friction`",
            ),
            (
                "\"bodies\": [{ \"make\": \"rim\", \"material\": { \"stifness\": 1 } }]",
                "bodies[0].material.stifness: unknown key: did you mean `stiffness`?",
            ),
            ("\"name\": \"a\", \"name\": \"b\"", "the key `name` stands here twice: leave one out"),
            ("\"drag_rate\": null", "drag_rate: is null: give a number"),
            ("\"drag_rate\": \"1\"", "drag_rate: is string \"1\": give a number"),
            ("\"drag_rate\": 1e999", "drag_rate: the number is too large: give a finite one"),
            ("\"drag_rate\": NaN", "drag_rate: NaN and infinity are no numbers of JSON: give a finite one"),
            ("\"drag_rate\": -Infinity", "drag_rate: NaN and infinity are no numbers of JSON: give a finite one"),
            ("\"tags\": \"a\"", "tags: is string \"a\": give a list"),
            ("\"bonds\": [[0, 1]]", "bonds[0]: is a list: give a bond: an object with the keys `a` and `b`"),
            ("\"bonds\": [{ \"a\": 0 }]", "bonds[0]: the key `b` is missing: add `b`"),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": -1 }]",
                "bonds[0].b: is integer `-1`: give a whole number from 0 to 4294967295",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"sprong\" }]",
                "bonds[0].kind: `sprong` is not a kind of bond: did you mean `spring`?",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": { \"rigid\": 1 } }]",
                "bonds[0].kind: is an object: give the name of a kind of bond",
            ),
            ("\"gravity\": [0,-1e308]", "gravity[1]: is -1e308: give a number from -1e9 to 1e9 m/s^2"),
            ("\"gravity\": [0]", "gravity: has length 1: give a vector: [x, y], in space [x, y, z]"),
            ("\"gravity\": [0,0,0,0]", "gravity: has length 4: give a vector: [x, y], in space [x, y, z]"),
            (
                "\"gravity\": [0,0,0]",
                "gravity: has 3 numbers: a vector in the plane has 2 (for space set \"dimensions\": 3)",
            ),
            ("\"dimensions\": 4", "dimensions: is 4: give 2 for the plane or 3 for space"),
            (
                "\"mouse\": { \"strength\": 1, \"radius\": 1, \"track\": [[0,0,0,0]] }",
                "mouse.track[0]: has length 4: give a list of 3 numbers",
            ),
        ],
    );
    hold(space, &[("\"gravity\": [0,0]", "gravity: has 2 numbers: a vector in space has 3")]);
}

#[test]
fn points() {
    for (points, message) in [
        (
            "[[0,0],[1,2,3]] }",
            "points.position[1]: has 3 numbers: a vector in the plane has 2 (for space set \"dimensions\": 3)",
        ),
        ("[[0,0]], \"velocity\": [] }", "points.velocity: has 0 entries for 1 point: give one a point"),
        ("[[0,0]], \"mass\": 0 }", "points.mass: is 0.0: give a number above 0"),
        ("[[0,0]], \"mass\": [-1] }", "points.mass[0]: is -1.0: give a number above 0"),
        ("[[0,0]], \"mass\": [1,1] }", "points.mass: has 2 entries for 1 point: give one a point"),
        ("[[0,0]], \"mass\": \"1\" }", "points.mass: is string \"1\": give a number, or a list of one number a point"),
        ("[[0,0]], \"pinned\": [1] }", "points.pinned[0]: point 1 does not exist: there is 1 point, so use 0"),
        ("[], \"pinned\": [0] }", "points.pinned[0]: point 0 does not exist: there are no points"),
    ] {
        let text = format!("{{ \"wobble\": 1,\n\"points\": {{ \"position\":\n{points} }}");
        assert_eq!(refusal(&text), format!("x.json:3: {message}"), "{points}");
    }
}

#[test]
fn bonds() {
    hold(
        plane,
        &[
            (
                "\"bonds\": [{ \"a\": 40, \"b\": 1 }]",
                "bonds[0].a: point 40 does not exist: there are 2 points, so use 0 to 1",
            ),
            (
                "\"bonds\": [{ \"a\": 1, \"b\": 1 }]",
                "bonds[0].b: is point 1 as `a` is: a bond needs two points, so give another",
            ),
            ("\"bonds\": [{ \"a\": 0, \"b\": 1, \"rest\": -1 }]", "bonds[0].rest: is -1.0: give a number of 0 or more"),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"break_strain\": 0 }]",
                "bonds[0].break_strain: is 0.0: give a number above 0",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"stiffness\": 5 }]",
                "bonds[0].stiffness: is a key of kind spring, and this is rigid as no `kind` is said: leave it out or set \"kind\": \"spring\"",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"relaxed\", \"stiffness\": 5 }]",
                "bonds[0].stiffness: is a key of kind spring, and this is relaxed: leave it out or set \"kind\": \"spring\"",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"relaxed\", \"compliance\": 0 }]",
                "bonds[0].compliance: is a key of kind spring, and this is relaxed: leave it out or set \"kind\": \"spring\"",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"rigid\", \"compliance\": 1, \"damping\": 5 }]",
                "bonds[0].damping: is a key of kind spring, and this is rigid: leave it out or set \"kind\": \"spring\"",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"spring\", \"stiffness\": 1, \"max_correction\": 1 }]",
                "bonds[0].max_correction: is a key of kind relaxed, and this is spring: leave it out or set \"kind\": \"relaxed\"",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"spring\" }]",
                "bonds[0]: a spring needs `stiffness` [N/m], `compliance` [m/N] or `axial_stiffness` [N]: add one of them",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"spring\", \"stiffness\": 2, \"compliance\": 0.5 }]",
                "bonds[0].compliance: stands beside `stiffness`, its reciprocal: leave one of them out",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"spring\", \"stiffness\": -2 }]",
                "bonds[0].stiffness: is -2.0: give a number of 0 or more",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"compliance\": -2 }]",
                "bonds[0].compliance: is -2.0: give a number of 0 or more",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"compliance\": 1e-320 }]",
                "bonds[0].compliance: is 1e-320, too small to divide by: give 0",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"spring\", \"stiffness\": 1, \"damping\": -1 }]",
                "bonds[0].damping: is -1.0: give a number of 0 or more",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"relaxed\", \"relaxation\": 1.5 }]",
                "bonds[0].relaxation: is 1.5: give a number above 0, at most 1",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"relaxed\", \"relaxation\": 0 }]",
                "bonds[0].relaxation: is 0.0: give a number above 0, at most 1",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"relaxed\", \"max_correction\": 0 }]",
                "bonds[0].max_correction: is 0.0: give a number above 0",
            ),
            (
                "\"bonds\": [{ \"a\": 0, \"b\": 1, \"limit\": \"maximum\" }]",
                "bonds[0].limit: `maximum` is not a limit: use `both`, `max` or `min`",
            ),
        ],
    );
}

#[test]
fn bodies() {
    let body = |rest: &str| plane(&format!("\"bodies\": [{{ {rest} }}]"));
    for (rest, message) in [
        ("\"make\": \"rimm\"", ".make: `rimm` is not a maker: did you mean `rim`?"),
        ("\"sectors\": 12", ": the key `make` is missing: add `make`"),
        (
            "\"make\": \"rim\", \"columns\": 3",
            ".columns: is no parameter of `rim`, which takes `radius`, `inner_radius`, `sectors` or `bracing`",
        ),
        ("\"make\": \"rim\", \"sectors\": 2", ".sectors: is 2: give a number from 3 to 10000000"),
        ("\"make\": \"rim\", \"inner_radius\": 3", ".inner_radius: is 3.0: it must be below radius, 2.0"),
        (
            "\"make\": \"rim\", \"bracing\": [\"spokes\"]",
            ".bracing[0]: `spokes` is not a bond of a rim: did you mean `spoke`?",
        ),
        (
            "\"make\": \"rim\", \"pinned\": [24]",
            ".pinned[0]: point 24 does not exist: there are 24 points, so use 0 to 23",
        ),
        (
            "\"make\": \"rim\", \"origin\": [0,0,0]",
            ".origin: has 3 numbers: a vector in the plane has 2 (for space set \"dimensions\": 3)",
        ),
        (
            "\"make\": \"rim\", \"material\": { \"mass\": 1, \"point_mass\": 1 }",
            ".material.point_mass: stands beside `mass`: give the body's mass or each point's, not both",
        ),
        ("\"make\": \"rim\", \"material\": { \"mass\": -1 }", ".material.mass: is -1.0: give a number above 0"),
        (
            "\"make\": \"rim\", \"material\": { \"stiffness\": 1 }",
            ".material.stiffness: is a key of kind spring, and this is rigid as no `kind` is said: leave it out or set \"kind\": \"spring\"",
        ),
        (
            "\"make\": \"points\", \"count\": 1, \"min\": [0,0], \"max\": [1,1], \"material\": { \"kind\": \"rigid\" }",
            ".material.kind: is a key of bonds, and `points` makes none: leave it out",
        ),
        ("\"make\": \"points\", \"count\": 1, \"min\": [0,0]", ": `points` needs `max`: add it"),
        (
            "\"make\": \"points\", \"count\": 0, \"min\": [0,0], \"max\": [1,1]",
            ".count: is 0: give a number from 1 to 20000000",
        ),
        (
            "\"make\": \"points\", \"count\": 1, \"min\": [0,2], \"max\": [1,1]",
            ".min: 2.0 on axis 1 is above max, 1.0: swap them",
        ),
        (
            "\"make\": \"random-graph\", \"count\": 4, \"bonds\": 7, \"min\": [0,0], \"max\": [1,1]",
            ".bonds: is 7: 4 points can have 6 bonds at most",
        ),
        ("\"make\": \"box\", \"width\": 1, \"height\": 1, \"supports\": 3", ".supports: is 3: a box has 0, 1 or 2"),
        ("\"make\": \"box\", \"width\": 1", ": `box` needs `height`: add it"),
        ("\"make\": \"rope\", \"count\": 3", ": `rope` needs `spacing` or `to`: add one of them"),
        (
            "\"make\": \"rope\", \"count\": 3, \"spacing\": 1, \"to\": [1,1]",
            ".to: stands beside `spacing`: give how far apart the points are or where the rope ends, not both",
        ),
        ("\"make\": \"rope\", \"count\": 3, \"spacing\": 0", ".spacing: is 0.0: give a finite number above 0"),
        ("\"make\": \"rope\", \"count\": 1, \"to\": [1,1]", ".count: is 1: give a number from 2 to 20000000"),
        (
            "\"make\": \"cloth\", \"columns\": 9999, \"rows\": 9999, \"spacing\": 1",
            ".rows: 9999 times 9999 columns make 99980001 points: 20000000 is the most",
        ),
        (
            "\"make\": \"cloth\", \"columns\": 2, \"rows\": 2, \"spacing\": 1, \"u\": [1,0]",
            ".u: is an axis in space: leave it out in the plane",
        ),
        (
            "\"make\": \"cloth\", \"columns\": 2, \"rows\": 2, \"spacing\": 1, \"diagonals\": \"two\"",
            ".diagonals: `two` is not a choice of diagonals: use `none`, `one` or `both`",
        ),
        (
            "\"make\": \"lattice\", \"columns\": 2, \"rows\": 0, \"spacing\": 1",
            ".rows: is 0: give a number from 1 to 20000000",
        ),
        ("\"make\": \"disc\", \"radius\": 1, \"spacing\": 2", ".spacing: is 2.0: it must be at most radius, 1.0"),
        (
            "\"make\": \"disc\", \"radius\": 1, \"spacing\": 1e-5",
            ".spacing: is 1e-5, which makes about 3.6e10 points: 20000000 is the most",
        ),
        ("\"make\": \"disc\", \"radius\": 1", ": `disc` needs `spacing`: add it"),
        ("\"make\": \"picture\"", ": `picture` needs `file`: add it"),
        (
            "\"make\": \"picture\", \"file\": \"a.png\"",
            ".file: `a.png` cannot be found: check the path: give a path relative to the scene file",
        ),
        (
            "\"make\": \"picture\", \"file\": \"/a.png\"",
            ".file: is no image: give a path relative to the scene, or data:image/png;base64,…",
        ),
        (
            "\"make\": \"picture\", \"file\": \"data:image/png;base64,AAAA\"",
            ".file: not a picture of a known format (PNG, JPEG, GIF, BMP, WebP, TIFF, PNM, TGA, ICO, QOI)",
        ),
        (
            "\"make\": \"picture\", \"file\": \"pictures/ring.png\", \"spacing\": 1e-5",
            ".spacing: a spacing of 0.00001 m is 0.0019 px of the picture: give one from 0.0052083 to 21.3333333 m (1 to 4096 px)",
        ),
        (
            "\"make\": \"picture\", \"file\": \"pictures/ring.png\", \"spacing\": 1, \"max_area\": 50",
            ".max_area: stands beside `spacing`: give one of them",
        ),
        (
            "\"make\": \"picture\", \"file\": \"pictures/ring.png\", \"whole\": true, \"threshold\": 0.5",
            ".threshold: stands beside `whole`: give one of them",
        ),
        (
            "\"make\": \"picture\", \"file\": \"pictures/ring.png\", \"part\": 1",
            ".part: is 1, and the picture has one part: give 0, or leave it out",
        ),
        (
            "\"make\": \"picture\", \"file\": \"pictures/ring.png\", \"invert\": true, \"part\": 9",
            ".part: is 9, and the picture has 2 parts: give a number from 0, the largest, to 1",
        ),
        (
            "\"make\": \"picture\", \"file\": \"pictures/ring.png\", \"pattern\": \"brace\"",
            ".pattern: `brace` is not a pattern of bonds: did you mean `braced`?",
        ),
        (
            "\"make\": \"disc\", \"radius\": 1, \"spacing\": 0.5, \"material\": { \"kind\": \"spring\", \"young\": 9 }",
            ".material.young: is of meshes of pictures, and this is `disc`: give `stiffness`",
        ),
        ("\"make\": \"ragdoll\", \"height\": -1", ".height: is -1.0: give a finite number above 0"),
        (
            "\"make\": \"ragdoll\", \"material\": { \"bending\": 1 }",
            ".material.bending: is of chains and skins, and `ragdoll` has none: leave it out",
        ),
    ] {
        assert_eq!(refusal(&body(rest)), format!("x.json:3: bodies[0]{message}"), "{rest}");
    }
}

#[test]
fn repeats() {
    let body =
        |rest: &str| plane(&format!("\"bodies\": [ {{ \"make\": \"rope\", \"count\": 5, \"spacing\": 1, {rest} }} ]"));
    for (rest, message) in [
        ("\"repeat\": 3", "repeat: is integer `3`: give a repeat: an object with the keys `count` and `step`"),
        ("\"repeat\": { \"count\": [2, 2] }", "repeat: the key `step` is missing: add `step`"),
        ("\"repeat\": { \"count\": [2], \"step\": [1, 1] }", "repeat.count: has 1 numbers: it is [columns, rows]"),
        ("\"repeat\": { \"count\": [2, 0], \"step\": [1, 1] }", "repeat.count[1]: is 0: give 1 or more"),
        (
            "\"repeat\": { \"count\": [2, 2], \"step\": [1, 1, 1] }",
            "repeat.step: has 3 numbers: a vector in the plane has 2 (for space set \"dimensions\": 3)",
        ),
        ("\"repeat\": { \"count\": [9, 2], \"step\": [1e308, 1] }", "repeat.step[0]: is inf: give a finite number"),
        (
            "\"repeat\": { \"count\": [10000, 1000], \"step\": [1, 1] }",
            "repeat.count: makes 10000000 copies of 5 points: 20000000 points are the most",
        ),
        (
            "\"pinned\": [5], \"repeat\": { \"count\": [2, 2], \"step\": [1, 1] }",
            "pinned[0]: point 5 does not exist: there are 5 points, so use 0 to 4",
        ),
    ] {
        assert_eq!(refusal(&body(rest)), format!("x.json:3: bodies[0].{message}"), "{rest}");
    }
}

#[test]
fn surroundings() {
    hold(
        plane,
        &[
            ("\"drag_rate\": -1", "drag_rate: is -1.0: give a number of 0 or more"),
            (
                "\"wind\": { \"velocity\": [1,0], \"turbulence\": -1 }",
                "wind.turbulence: is -1.0: give a number of 0 or more",
            ),
            ("\"mouse\": { \"strength\": 1, \"radius\": 0 }", "mouse.radius: is 0.0: give a number above 0"),
            (
                "\"mouse\": { \"strength\": 1, \"radius\": 1, \"region\": \"disc\" }",
                "mouse.region: `disc` is not a region: use `square` or `round`",
            ),
            (
                "\"mouse\": { \"strength\": 1, \"radius\": 1, \"track\": [[1,0,0],[0,0,0]] }",
                "mouse.track[1]: time 0.0 does not come after 1.0: sort the knots upwards, one a time",
            ),
            ("\"click_start\": 0", "click_start: point 0 is pinned: name a free one"),
            ("\"click_start\": 99", "click_start: there is no point 99 in `points`: name one of them"),
            ("\"cursor_pin\": 1", "cursor_pin: point 1 is not pinned: add it to `pinned`, or give a pinned one"),
            (
                "\"pin_motion\": [{ \"point\": 1, \"track\": [[0,0,0]] }]",
                "pin_motion[0].point: point 1 is not pinned: add it to `pinned`, or give a pinned one",
            ),
            (
                "\"pin_motion\": [{ \"point\": 0, \"track\": [] }]",
                "pin_motion[0].track: has no knots: give at least one",
            ),
            (
                "\"pin_motion\": [{ \"point\": 0, \"track\": [[0,0]] }]",
                "pin_motion[0].track[0]: has 2 numbers: a knot is [t, x, y]",
            ),
            (
                "\"pin_motion\": [{ \"point\": 0, \"track\": [[1,0,0],[1,0,0]] }]",
                "pin_motion[0].track[1]: time 1.0 does not come after 1.0: sort the knots upwards, one a time",
            ),
            (
                "\"bounds\": { \"min\": [0,1], \"max\": [1,1] }",
                "bounds.min[1]: 1.0 is not below 1.0 of `max`: give min < max",
            ),
            (
                "\"bounds\": { \"min\": [0,0], \"max\": [1,1], \"restitution\": -1 }",
                "bounds.restitution: is -1.0: give a number of 0 or more",
            ),
            (
                "\"bounds\": { \"min\": [0,0], \"max\": [1,1], \"friction\": -1 }",
                "bounds.friction: is -1.0: give a number of 0 or more",
            ),
            (
                "\"obstacles\": [{ \"restitution\": 1 }]",
                "obstacles[0]: has no shape: give `plane`, `box`, `circle`, `polygon` or `picture`",
            ),
            (
                "\"obstacles\": [{ \"circle\": { \"center\": [0,0], \"radius\": 1 }, \"plane\": { \"point\": [0,0], \"normal\": [0,1] } }]",
                "obstacles[0].circle: stands beside `plane`: an obstacle has one shape, so make it two",
            ),
            (
                "\"obstacles\": [{ \"plane\": { \"point\": [0,0], \"normal\": [0,0] } }]",
                "obstacles[0].plane.normal: is zero: give a direction",
            ),
            (
                "\"obstacles\": [{ \"box\": { \"min\": [0,0], \"max\": [0,1] } }]",
                "obstacles[0].box.min[0]: 0.0 is not below 0.0 of `max`: give min < max",
            ),
            (
                "\"obstacles\": [{ \"box\": { \"min\": [0,0], \"max\": [1,1], \"rotation\": { \"axis\": [0,1], \"angle\": 1 } } }]",
                "obstacles[0].box.rotation: turns a box in space: in the plane give `angle`",
            ),
            (
                "\"obstacles\": [{ \"circle\": { \"center\": [0,0], \"radius\": -1 } }]",
                "obstacles[0].circle.radius: is -1.0: give a number above 0",
            ),
            (
                "\"obstacles\": [{ \"polygon\": [[[0,0],[1,0]]] }]",
                "obstacles[0].polygon[0]: has 2 corners: give 3 or more",
            ),
            ("\"obstacles\": [{ \"polygon\": [] }]", "obstacles[0].polygon: has no outline: give a list of corners"),
            (
                "\"obstacles\": [{ \"polygon\": [[[0.1,0.1],[0.2,0.2],[0.7,0.7],[0.1,0.1]]] }]",
                "obstacles[0].polygon[0]: encloses nothing, for its corners lie on a line: move one of them",
            ),
            (
                "\"obstacles\": [{ \"circle\": { \"center\": [0,0], \"radius\": 1 }, \"friction\": -1 }]",
                "obstacles[0].friction: is -1.0: give a number of 0 or more",
            ),
        ],
    );
    hold(
        space,
        &[
            (
                "\"mouse\": { \"strength\": 1, \"radius\": 1, \"region\": \"square\" }",
                "mouse.region: \"square\" is for the plane: in space use \"round\"",
            ),
            (
                "\"obstacles\": [{ \"box\": { \"min\": [0,0,0], \"max\": [1,1,1], \"angle\": 1 } }]",
                "obstacles[0].box.angle: turns a box in the plane: in space give `rotation`",
            ),
            (
                "\"obstacles\": [{ \"polygon\": [] }]",
                "obstacles[0].polygon: lies in the plane: in space use `plane`, `box` or `circle`",
            ),
            ("\"obstacles\": [{}]", "obstacles[0]: has no shape: give `plane`, `box` or `circle`"),
            (
                "\"bodies\": [{ \"make\": \"cloth\", \"columns\": 2, \"rows\": 2, \"spacing\": 1, \"v\": [2,0,0] }]",
                "bodies[0].v: is parallel to u: give another direction",
            ),
            ("\"areas\": { \"kind\": \"rigid\" }", "areas: act in the plane only: leave them out in space"),
        ],
    );
}

#[test]
fn surfaces_method_times_and_view() {
    hold(
        plane,
        &[
            ("\"triangles\": [[0,1,2]]", "triangles[0][2]: point 2 does not exist: there are 2 points, so use 0 to 1"),
            ("\"triangles\": [[0,1,1]]", "triangles[0]: names a point twice: give three points"),
            ("\"triangles\": [[0,1]]", "triangles[0]: has length 2: give a list of 3 numbers"),
            ("\"areas\": { \"kind\": \"spring\" }", "areas: areas of kind spring need `stiffness`: add it"),
            (
                "\"areas\": { \"kind\": \"rigid\", \"stiffness\": 1 }",
                "areas.stiffness: is a key of areas of kind spring, and these are rigid: leave it out",
            ),
            ("\"contact\": { \"friction\": -0.1 }", "contact.friction: is -0.1: give a number of 0 or more"),
            ("\"contact\": { \"friction\": 1e999 }", "contact.friction: the number is too large: give a finite one"),
            ("\"contact\": { \"restitution\": 2 }", "contact.restitution: is 2.0: give a number from 0 to 1"),
            ("\"contact\": { \"restitution\": -1 }", "contact.restitution: is -1.0: give a number from 0 to 1"),
            ("\"contact\": { \"radius\": -1 }", "contact.radius: is -1.0: give a number of 0 or more"),
            (
                "\"contact\": { \"radius\": NaN }",
                "contact.radius: NaN and infinity are no numbers of JSON: give a finite one",
            ),
            ("\"contact\": { \"self\": 1 }", "contact.self: is integer `1`: give true or false"),
            (
                "\"contact\": { \"with_itself\": true }",
                "contact.with_itself: unknown key: the keys here are `friction`, `restitution`, `radius`, `self` and `bodies`",
            ),
            (
                "\"contact\": 0.5",
                "contact: is floating point `0.5`: give true, or an object with keys such as `friction`",
            ),
            ("\"contact\": null", "contact: is null: give true, or an object with keys such as `friction`"),
            ("\"drives\": []", "drives: `drives` is not in this version: leave it out"),
            ("\"angles\": \"a\"", "angles: is string \"a\": give a list"),
            (
                "\"texture\": { \"image\": \"/a.png\", \"uv\": [[0,0],[1,0]] }",
                "texture.image: is no image: give a path relative to the scene, or data:image/png;base64,…",
            ),
            (
                "\"texture\": { \"image\": \"a.png\", \"uv\": [[0,0]] }",
                "texture.uv: has 1 entry for 2 points: give one a point",
            ),
            (
                "\"method\": { \"solver\": \"verlett\" }",
                "method.solver: `verlett` is not a solver: did you mean `verlet`?",
            ),
            ("\"method\": { \"substep\": 0 }", "method.substep: is 0.0: give a number above 0"),
            ("\"method\": { \"iterations\": 0 }", "method.iterations: is 0: give 1 or more"),
            ("\"method\": { \"iterations\": 1000000000 }", "method.iterations: is 1000000000: give 100000 or less"),
            (
                "\"method\": { \"iterations\": 1.5 }",
                "method.iterations: is floating point `1.5`: give a whole number from 0 to 4294967295",
            ),
            (
                "\"method\": { \"order\": \"random\" }",
                "method.order: `random` is not an order: use `auto`, `fixed`, `symmetric`, `coloured` or `shuffled`",
            ),
            (
                "\"method\": { \"precision\": \"f16\" }",
                "method.precision: `f16` is not a precision: use `auto`, `f32` or `f64`",
            ),
            ("\"method\": { \"tolerance\": 0 }", "method.tolerance: is 0.0: give a number above 0"),
            ("\"method\": { \"max_strain\": -1 }", "method.max_strain: is -1.0: give a number above 0"),
            ("\"rate\": 0", "rate: is 0.0: give a number above 0"),
            ("\"duration\": -1", "duration: is -1.0: give a number of 0 or more"),
            ("\"samples\": [-1]", "samples[0]: is -1.0: give a number of 0 or more"),
            ("\"samples\": [1,0.5]", "samples[1]: 0.5 comes after 1.0: sort the times upwards"),
            (
                "\"view\": { \"target\": [0,0] }",
                "view.target: is no key of a view in the plane: its keys are `center`, `height`, `width` or `follow`",
            ),
            (
                "\"view\": { \"center\": [0,0], \"height\": 1, \"follow\": [] }",
                "view.follow: has no point: name one, or leave it out",
            ),
            (
                "\"view\": { \"center\": [0,0], \"height\": 1, \"follow\": [0,9] }",
                "view.follow[1]: point 9 does not exist: there are 2 points, so use 0 to 1",
            ),
            ("\"view\": { \"width\": 4 }", "view: a view in the plane needs `center` and `height`: add them"),
            ("\"view\": { \"center\": [0,0] }", "view: a view in the plane needs `height`: add it"),
            ("\"view\": { \"center\": [0,0], \"height\": 0 }", "view.height: is 0.0: give a number above 0"),
            (
                "\"view\": { \"center\": [0,0], \"height\": 1, \"width\": 0 }",
                "view.width: is 0.0: give a number above 0",
            ),
        ],
    );
    hold(
        space,
        &[
            (
                "\"view\": { \"center\": [0,0,0] }",
                "view.center: is no key of a view in space: its keys are `target`, `distance`, `yaw` or `pitch`",
            ),
            ("\"view\": { \"target\": [0,0,0], \"distance\": -1 }", "view.distance: is -1.0: give a number above 0"),
        ],
    );
}

/// What the form allows and this version cannot run: read, then refused by name.
#[test]
fn what_this_version_lacks() {
    let text = "{ \"wobble\": 1,\n\"contact\": true, \"method\": { \"tolerance\": 1e-4 } }";
    let scene = Scene::parse(text, "x.json").unwrap_or_else(|error| panic!("{error}"));
    let error = scene.model::<2>().unwrap_err();
    let message = "method.tolerance: no tolerance is held to where bodies meet in this version: leave `tolerance` or `contact` out";
    assert_eq!(error.to_string(), format!("x.json:2: {message}"));
    assert_eq!(error.kind, SceneErrorKind::Unsupported);
}

#[test]
fn bodies_meet_by_the_solvers_that_know_of_it() {
    let scene = |text: &str| Scene::parse(text, "x.json").unwrap_or_else(|error| panic!("{error}"));
    for (contact, method, message) in [
        (
            "true",
            "\"solver\": \"rk4\"",
            "method.solver: solver `rk4` knows no contact: leave `solver` or `contact` out",
        ),
        (
            "{ \"friction\": 0 }",
            "\"tolerance\": 0.1",
            "method.tolerance: no tolerance is held to where bodies meet in this version: leave `tolerance` or `contact` out",
        ),
    ] {
        let text = |contact: &str| plane(&format!("\"contact\": {contact}, \"method\": {{ {method} }}"));
        let error = scene(&text(contact)).model::<2>().unwrap_err().to_string();
        assert_eq!(error, format!("x.json:3: {message}"));
        scene(&text("false")).model::<2>().unwrap();
    }
    for (rest, message) in [
        (
            "\"solver\": \"rk4\"",
            "method.solver: solver `rk4` does not meet balls and boxes in space: leave `solver` out",
        ),
        (
            "\"tolerance\": 0.1",
            "method.tolerance: no tolerance is held to among balls and boxes in this version: leave `tolerance` out",
        ),
    ] {
        let ball = "\"obstacles\": [{ \"circle\": { \"center\": [0,0,0], \"radius\": 1 } }]";
        let error = scene(&space(&format!("{ball}, \"method\": {{ {rest} }}"))).model::<3>().unwrap_err();
        assert_eq!(error.to_string(), format!("x.json:3: {message}"));
    }
    scene(&space("\"contact\": true, \"method\": { \"solver\": \"live\" }")).model::<3>().unwrap();
    for (keys, contact) in [
        ("true", Contact::default()),
        ("{}", Contact::default()),
        (
            "{ \"friction\": 0.1, \"restitution\": 1, \"radius\": 0, \"self\": false, \"bodies\": false }",
            Contact { friction: 0.1, restitution: 1.0, radius: Some(0.0), with_itself: false, with_others: false },
        ),
    ] {
        for solver in ["auto", "live"] {
            let text = plane(&format!("\"contact\": {keys}, \"method\": {{ \"solver\": \"{solver}\" }}"));
            assert_eq!(scene(&text).model::<2>().unwrap().contact, Some(contact));
        }
    }
}

#[test]
fn empty_lists_of_what_it_lacks_are_fine() {
    let text = plane("\"triangles\": [], \"pin_motion\": [], \"obstacles\": [], \"samples\": []");
    Scene::parse(&text, "x.json").unwrap().model::<2>().unwrap();
}

#[test]
fn solvers_and_bonds_that_do_not_go_together() {
    let sweep =
        "relaxed bonds need `substep` and `iterations` from the scene or the call, for they mean nothing without: give";
    let spring = "is a spring, which solver `relaxation` refuses: use auto, verlet, pefrl, rk4 or implicit-midpoint";
    let (relaxed, springs) = (
        "\"bonds\": [{ \"a\": 0, \"b\": 1, \"kind\": \"relaxed\" }]",
        "\"bonds\": [{ \"a\": 0, \"b\": 1 }, { \"a\": 0, \"b\": 1, \"compliance\": 1 }]",
    );
    for (bonds, method, message) in [
        (relaxed, "\"substep\": 0.1", format!("method: {sweep} `iterations`")),
        (relaxed, "\"iterations\": 1", format!("method: {sweep} `substep`")),
        ("\"bonds\": []", "\"solver\": \"relaxation\"", format!("method: {sweep} `substep`")),
        (springs, "\"solver\": \"relaxation\", \"substep\": 0.1, \"iterations\": 1", format!("bonds[1]: {spring}")),
        (
            "\"bodies\": [{ \"make\": \"rim\", \"material\": { \"kind\": \"spring\", \"stiffness\": 1 } }]",
            "\"solver\": \"relaxation\", \"substep\": 0.1, \"iterations\": 1",
            format!("bodies[0]: the material {spring}"),
        ),
    ] {
        let text = plane(&format!("{bonds}, \"method\": {{ {method} }}"));
        let scene = Scene::parse(&text, "x.json").unwrap_or_else(|error| panic!("{error}"));
        let error = scene.model::<2>().unwrap_err().to_string();
        assert_eq!(error, format!("x.json:3: {message}"));
    }
}

#[test]
fn numbers_that_overflow_are_refused_when_the_model_is_made() {
    for (text, message) in [
        (
            plane("\"bodies\": [{ \"make\": \"rim\", \"origin\": [1.7e308,0], \"radius\": 1.7e308 }]"),
            "x.json:3: bodies[0].make: the body is too large for a number: make it smaller",
        ),
        (
            plane("\"bodies\": [{ \"make\": \"rim\", \"spin\": 1.7e308 }]"),
            "x.json:3: bodies[0]: its points are too far or too fast for a number: make it smaller",
        ),
        (
            plane("\"bodies\": [{ \"make\": \"rim\", \"material\": { \"mass\": 5e-324 } }]"),
            "x.json:3: bodies[0].material.mass: is too small to be shared by so many points: make it larger",
        ),
        (
            "{ \"wobble\": 1, \"points\": { \"position\": [[1e200,0],[-1e200,0]] },\n\"bonds\": [{ \"a\": 0, \"b\": 1 }] }".to_owned(),
            "x.json:2: bonds[0]: its points are too far apart for a number: move them together",
        ),
    ] {
        let scene = Scene::parse(&text, "x.json").unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.model::<2>().unwrap_err().to_string(), message);
    }
}

#[test]
fn labels() {
    hold(
        plane,
        &[
            ("\"labels\": [{\"text\": \"a\"}]", "labels[0]: the key `at` is missing: add `at`"),
            (
                "\"labels\": [{\"at\": [0, 0], \"text\": \" \"}]",
                "labels[0].text: is empty: give a few words, or leave the label out",
            ),
            (
                "\"labels\": [{\"at\": [0, 0], \"text\": \"a\"}, {\"at\": [0, 0], \"text\": \"b\", \"point\": 2}]",
                "labels[1].point: point 2 does not exist: there are 2 points, so use 0 to 1",
            ),
        ],
    );
    let one = |at: &str, text: &str| format!("{{\"at\": [{at}], \"text\": \"{text}\"}}");
    let list = |all: &[String]| plane(&format!("\"labels\": [{}]", all.join(", ")));
    let good = vec![one("1e300, -4", &"é".repeat(200)); 100];
    assert_eq!(Scene::parse(&list(&good), "x.json").unwrap().labels.len(), 100);
    let said = |all: &[String]| refusal(&list(all));
    assert!(said(&[good, vec![one("0, 0", "a")]].concat()).contains("labels: has 101 entries: give 100 at most"));
    assert!(said(&[one("0, 0", &"a".repeat(201))]).contains("labels[0].text: has 201 characters: give 200 at most"));
    assert!(said(&[one("0, 0, 0", "a")]).contains("labels[0].at: has 3 numbers"));
    assert!(said(&[one("1e999, 0", "a")]).contains("labels[0].at"), "not finite");
    assert!(said(&[one("0, 0", "a\", \"points\": 1, \"text\": \"b")]).contains("labels[0]"), "an unknown key");
}

#[test]
fn groups_of_points() {
    hold(
        plane,
        &[
            (
                "\"groups\": [{\"points\": [1, 1]}]",
                "groups[0].points: names less than two points: a group is made of two or more, or leave it out",
            ),
            (
                "\"groups\": [{\"points\": [0, 1], \"title\": \"a\"}, {\"points\": [0, 1], \"title\": \"a\"}]",
                "groups[1].title: is `a`, as another group's: give each a title of its own",
            ),
            (
                "\"groups\": [{\"points\": [0, 1], \"title\": \" \"}]",
                "groups[0].title: is empty: give a few words, or leave it out",
            ),
        ],
    );
    assert!(refusal(&plane("\"groups\": [{\"points\": [0, 2]}]")).contains("groups[0].points[1]"));
}

#[test]
fn parameters_of_sliders() {
    let spring = "\"bonds\": [{\"a\": 0, \"b\": 1, \"kind\": \"spring\", \"stiffness\": 5}, {\"a\": 0, \"b\": 1}], ";
    let row = |path: &str, rest: &str| format!("{spring}\"parameters\": [{{\"path\": \"{path}\", {rest}}}]");
    for path in ["gravity[1]", "drag_rate", "bonds[0].stiffness", "bonds[0-0].damping", "bonds[0-1].rest"] {
        assert!(Scene::parse(&plane(&row(path, "\"min\": 0, \"max\": 9")), "x.json").is_ok(), "{path}");
    }
    for (path, rest, words) in [
        ("points[0]", "\"min\": 0, \"max\": 1", "parameters[0].path: `points[0]` is no number that sliders set: give"),
        ("gravity[2]", "\"min\": 0, \"max\": 1", "parameters[0].path: names axis 2: give one below 2"),
        ("bounds.friction", "\"min\": 0, \"max\": 1", "parameters[0].path: is of `bounds`, which this scene has not"),
        ("bonds[0-1].stiffness", "\"min\": 0, \"max\": 1", "parameters[0].path: names bond 1, which is no spring"),
        (
            "obstacles[0].penalty.stiffness",
            "\"min\": 0, \"max\": 1",
            "parameters[0].path: names obstacle 0, and there is none",
        ),
        ("bonds[2].rest", "\"min\": 0, \"max\": 1", "parameters[0].path: names bond 2, and there are 2 explicit bonds"),
        ("drag_rate", "\"min\": 1, \"max\": 1", "parameters[0].max: is 1.0 beside a `min` of 1.0"),
        ("drag_rate", "\"min\": -1, \"max\": 1", "parameters[0].min: is -1.0: `drag_rate` is at least 0"),
    ] {
        let said = refusal(&plane(&row(path, rest)));
        assert!(said.starts_with(&format!("x.json:3: {words}")), "{said}");
    }
}
