//! What is around the bodies of a case: gravity, surfaces, a mouse, led pins.

use serde_json::{Value, json};

use super::dice::Dice;
use super::{Family, SECONDS};

/// Gives a scene its surroundings; those of what rests are a floor at most.
pub(super) fn fill(family: Family, dice: &mut Dice, scene: &mut Value) {
    if family == Family::Resting {
        scene["gravity"] = json!([0, -9.81]);
        scene["obstacles"] = json!([{ "plane": { "point": [0, -2], "normal": [0, 1] }, "friction": 0.5 }]);
        return;
    }
    let gravity = if dice.chance(0.1) {
        0.0
    } else if dice.chance(0.12) {
        dice.of(&[100.0, 1000.0])
    } else {
        9.81
    };
    scene["gravity"] = json!([0, -gravity]);
    if dice.chance(0.35) {
        scene["drag_rate"] = json!(dice.decades(0.01, 10.0));
    }
    surfaces(dice, scene);
    if dice.chance(0.3) {
        scene["mouse"] = mouse(dice);
    }
    if dice.chance(0.35) {
        lead(dice, scene);
    }
}

fn surfaces(dice: &mut Dice, scene: &mut Value) {
    let (e, mu) = (dice.of(&[0.0, 0.0, 0.3, 0.5, 1.0]), dice.of(&[0.0, 0.0, 0.3, 0.5, 1.0]));
    let with = |mut shape: Value| {
        (shape["restitution"], shape["friction"]) = (json!(e), json!(mu));
        shape
    };
    let size = dice.between(2.2, 3.5);
    if dice.chance(0.5) {
        scene["bounds"] = with(json!({ "min": [-size, -size], "max": [size, size] }));
    }
    let mut obstacles = Vec::new();
    if dice.chance(0.3) {
        let normal = [dice.between(-0.5, 0.5), 1.0];
        obstacles.push(with(json!({ "plane": { "point": [0, -2], "normal": normal } })));
    }
    if dice.chance(0.25) {
        obstacles.push(with(polygon(dice)));
    }
    if dice.chance(0.06) {
        let file = format!("pictures/{}.png", dice.of(&["gear", "ring", "pebble"]));
        obstacles
            .push(with(json!({ "picture": { "file": file, "height": 1.4, "spacing": 0.07, "origin": [0, -1.4] } })));
    }
    if !obstacles.is_empty() {
        scene["obstacles"] = obstacles.into();
    }
}

/// A wedge, a valley, a step, a thin wall or a star that crosses itself.
fn polygon(dice: &mut Dice) -> Value {
    let (width, height) = (dice.between(0.3, 1.5), dice.between(0.3, 1.2));
    let valley =
        [[-4.0, -4.0], [4.0, -4.0], [4.0, -1.5], [width, -1.5], [0.0, -1.5 - height], [-width, -1.5], [-4.0, -1.5]];
    match dice.of(&[0, 1, 2, 3, 4]) {
        0 => json!({ "polygon": [[[-width, -2], [width, -2], [0, -2.0 + height]]] }),
        1 => json!({ "polygon": [valley] }),
        2 => {
            json!({ "box": { "min": [-width, -2.0], "max": [width, -2.0 + height], "angle": dice.between(-0.7, 0.7) } })
        }
        3 => json!({ "box": { "min": [-2, -1.51], "max": [2, -1.5] } }),
        _ => {
            let corner = |k: u32| {
                let angle = f64::from(2 * k) * std::f64::consts::TAU / 5.0 + 0.3;
                json!([width * libm::cos(angle), -1.8 + width * libm::sin(angle)])
            };
            json!({ "polygon": [(0..5).map(corner).collect::<Vec<_>>()] })
        }
    }
}

/// A mouse that circles as a hand would, or is somewhere else in every frame.
fn mouse(dice: &mut Dice) -> Value {
    let is_wild = dice.chance(0.5);
    let count = (60.0 * SECONDS) as u32;
    let knot = |i: u32, dice: &mut Dice| {
        let t = f64::from(i) / 60.0;
        let place = match is_wild {
            true => [dice.between(-1.5, 1.5), dice.between(-1.5, 1.5)],
            false => [0.9 * libm::cos(4.0 * t), 0.9 * libm::sin(4.0 * t)],
        };
        json!([t, place[0], place[1]])
    };
    let track: Vec<Value> = (0..=count).map(|i| knot(i, dice)).collect();
    let sign = dice.of(&[1.0, 1.0, 1.0, -1.0]);
    json!({ "strength": sign * dice.decades(10.0, 5e3), "radius": dice.between(0.2, 1.5), "track": track,
            "region": dice.of(&["round", "square"]), "profile": dice.of(&["smooth", "linear"]) })
}

/// Leads the first pin: swung gently, or thrown about in every frame.
fn lead(dice: &mut Dice, scene: &mut Value) {
    let Some(at) = pin(scene) else { return };
    let is_wild = dice.chance(0.4);
    let reach = if is_wild { dice.decades(0.01, 0.5) } else { dice.between(0.1, 0.5) };
    let knot = |i: u32, dice: &mut Dice| {
        let t = f64::from(i) / 60.0;
        let way = match is_wild {
            true if i > 0 => [dice.between(-reach, reach), dice.between(-reach, reach)],
            true => [0.0; 2],
            false => [reach * libm::sin(5.0 * t), 0.0],
        };
        json!([t, at[0] + way[0], at[1] + way[1]])
    };
    let track: Vec<Value> = (0..=(60.0 * SECONDS) as u32).map(|i| knot(i, dice)).collect();
    scene["pin_motion"] = json!([{ "point": 0, "track": track }]);
}

/// Where point 0 is, if it is a pin whose place can be read off the scene.
fn pin(scene: &Value) -> Option<[f64; 2]> {
    let place = |value: &Value| Some([value[0].as_f64()?, value[1].as_f64()?]);
    let is_pinned = |owner: &Value| owner["pinned"].as_array().is_some_and(|list| list.contains(&json!(0)));
    if is_pinned(&scene["points"]) {
        return place(&scene["points"]["position"][0]);
    }
    let body = &scene["bodies"][0];
    // Of these point 0 lies at the body's own origin.
    (scene["points"].is_null() && is_pinned(body)).then(|| place(&body["origin"]))?
}
