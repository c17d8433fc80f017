//! Commands of a case: what a hand does to a scene while it runs.

use serde_json::{Value, json};

use super::SECONDS;
use super::dice::Dice;

/// A few commands, times ascending. Some may not be possible where they stand: they are refused, as in the window.
pub(super) fn commands(dice: &mut Dice) -> Vec<Value> {
    let mut commands = Vec::new();
    let mut at = 0.1;
    while at < 0.8 * SECONDS {
        one(dice, at, &mut commands);
        at += dice.between(0.1, 0.5);
    }
    commands
}

fn one(dice: &mut Dice, at: f64, commands: &mut Vec<Value>) {
    let place = [dice.between(-1.2, 1.2), dice.between(-1.2, 1.2)];
    let other = [dice.between(-1.2, 1.2), dice.between(-1.2, 1.2)];
    let by = at + dice.between(0.02, 0.1);
    match dice.of(&[0, 0, 1, 2, 3, 4, 5, 6]) {
        0 => {
            commands.push(json!({ "at": at, "do": "cursor", "to": place }));
            commands.push(json!({ "at": at, "do": "grab", "within": dice.between(0.2, 1.0) }));
            commands.push(json!({ "at": at, "do": "cursor", "to": other, "by": by }));
            commands.push(json!({ "at": by, "do": "release" }));
        }
        1 => commands.push(json!({ "at": at, "do": "pin", "points": [0, 1] })),
        2 => commands.push(json!({ "at": at, "do": "unpin", "points": [0] })),
        3 => commands.push(json!({ "at": at, "do": "cut", "from": place, "to": other })),
        4 => {
            let rope = json!({ "make": "rope", "count": dice.count(2, 20), "spacing": 0.1, "origin": place,
                               "material": { "kind": "spring", "stiffness": dice.decades(10.0, 1e4), "mass": 1 } });
            commands.push(json!({ "at": at, "do": "add", "bodies": [rope] }));
        }
        5 => commands.push(json!({ "at": at, "do": "delete", "points": [dice.of(&[0, 1, 2])] })),
        _ => commands.push(json!({ "at": at, "do": "set", "gravity": [0, dice.of(&[-9.81, 9.81, 0.0])] })),
    }
}
