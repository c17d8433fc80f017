//! What is drawn apart from all else of a case: circles, steady forces, wind, and what resists bending and changes of areas.

use serde_json::{Value, json};

use super::Family;
use super::dice::Dice;

/// Adds to a scene that has its bodies and surroundings; what rests is left as it is.
pub(super) fn fill(family: Family, dice: &mut Dice, scene: &mut Value) {
    if family == Family::Resting {
        return;
    }
    if dice.chance(0.15) {
        let circle = circle(dice);
        match scene["obstacles"].as_array_mut() {
            Some(list) => list.push(circle),
            None => scene["obstacles"] = json!([circle]),
        }
    }
    if dice.chance(0.12) {
        scene["forces"] = json!([force(family, dice)]);
    }
    // Without drag air pushes nothing.
    if !scene["drag_rate"].is_null() && dice.chance(0.3) {
        let velocity = [dice.between(-8.0, 8.0), dice.between(-2.0, 2.0)];
        scene["wind"] = json!({ "velocity": velocity, "turbulence": dice.of(&[0.0, 0.2, 0.5]), "seed": dice.seed() });
    }
    let is_relaxed = !scene["method"]["iterations"].is_null();
    if !is_relaxed {
        resist(family, dice, scene);
    }
}

/// Below the bodies.
fn circle(dice: &mut Dice) -> Value {
    let radius = dice.between(0.15, 0.7);
    let center = [dice.between(-1.0, 1.0), dice.between(-2.0, -1.5)];
    let (e, mu) = (dice.of(&[0.0, 0.0, 0.3, 1.0]), dice.of(&[0.0, 0.3, 1.0]));
    json!({ "circle": { "center": center, "radius": radius }, "restitution": e, "friction": mu })
}

/// A push on the first point, or on the first two, which it may turn as well.
fn force(family: Family, dice: &mut Dice) -> Value {
    let size = dice.decades(0.1, 100.0);
    let angle = dice.between(0.0, std::f64::consts::TAU);
    let push = [size * libm::cos(angle), size * libm::sin(angle)];
    if family == Family::Points || dice.chance(0.5) {
        return json!({ "points": [0], "force": push });
    }
    json!({ "points": [0, 1], "force": push, "torque": dice.between(-2.0, 2.0) })
}

/// Bending of chains and skins, angles of what is listed point by point, areas of what is meshed.
fn resist(family: Family, dice: &mut Dice, scene: &mut Value) {
    let (is_bent, is_filled) = (dice.chance(0.15), dice.chance(0.3));
    let stiffness = dice.decades(1e-5, 0.1);
    match family {
        Family::Rope | Family::Rim | Family::Box | Family::Lattice | Family::Disc | Family::Picture if is_bent => {
            scene["bodies"][0]["material"]["bending"] = json!(stiffness);
        }
        Family::HeavyEnd | Family::Comb if is_bent => {
            let count = scene["points"]["position"].as_array().map_or(0, Vec::len);
            // A spine ends at its second pin.
            let last = scene["points"]["pinned"][1].as_u64();
            let most = last.map_or(count, |last| last as usize + 1);
            let angle =
                |i: usize| json!({ "points": [i, i + 1, i + 2], "stiffness": 10.0 * stiffness, "damping": 1e-3 });
            scene["angles"] = (0..most.saturating_sub(2)).map(angle).collect();
        }
        _ => {}
    }
    let is_meshed = matches!(family, Family::Lattice | Family::Disc | Family::Picture | Family::Pile);
    if is_meshed && is_filled {
        scene["areas"] = match dice.chance(0.25) {
            true => json!({ "kind": "rigid" }),
            false => json!({ "kind": "spring", "stiffness": dice.decades(10.0, 1e5) }),
        };
    }
}
