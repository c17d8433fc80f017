//! Damage to texts, values and bytes that were whole, drawn from a seed: what readers are tried with.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Number, Value, json};

use super::session::Dice;

/// Pieces that are likely to hit something in a text.
const PIECES: [&str; 24] = [
    "",
    "0",
    "-1",
    "0.1",
    "1e999",
    "1e308",
    "5e-324",
    "4294967295",
    "18446744073709551616",
    "null",
    "true",
    "NaN",
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

/// Numbers at which something may turn: ends of ranges, of integers and of floats.
const NUMBERS: [f64; 24] = [
    0.0,
    -0.0,
    -1.0,
    1.0,
    2.0,
    3.0,
    0.5,
    1.5,
    -0.5,
    1e-3,
    1e3,
    1e-9,
    1e9,
    1e-15,
    1e15,
    1e-300,
    1e300,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    255.0,
    65_536.0,
    4_294_967_295.0,
    1.844_674_407_370_955_2e19,
];

/// Damages a text in up to three places: characters go, come, change or are doubled, or the end is missing.
pub fn text(whole: &str, dice: &mut Dice) -> String {
    let mut text = whole.to_owned();
    for _ in 0..1 + dice.below(3) {
        let from = boundary(&text, dice.below(text.len() as u64 + 1) as usize);
        let to = boundary(&text, from + dice.below(40) as usize);
        match dice.below(8) {
            0 => text.truncate(from),
            1 => {
                let part = text[from..to].to_owned();
                text.insert_str(from, &part);
            }
            2 => text.insert(from, char::from(b"0123456789-.eE,:[]{}\"ntx "[dice.below(25) as usize])),
            3 => text.replace_range(from..to, ""),
            _ => {
                let end = if dice.below(2) == 0 { from } else { to };
                text.replace_range(from..end, PIECES[dice.below(PIECES.len() as u64) as usize]);
            }
        }
    }
    text
}

/// The first place from this one on between two characters.
fn boundary(text: &str, at: usize) -> usize {
    (at..text.len()).find(|&at| text.is_char_boundary(at)).unwrap_or(text.len())
}

/// Damages bytes in up to four places: bits turn, numbers get large, parts go, come, are doubled, or the end is missing.
pub fn bytes(whole: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    for _ in 0..1 + dice.below(4) {
        if bytes.is_empty() {
            break;
        }
        let at = dice.below(bytes.len() as u64) as usize;
        let end = (at + 1 + dice.below(32) as usize).min(bytes.len());
        match dice.below(8) {
            0 | 1 => bytes[at] ^= 1 << dice.below(8),
            2 => bytes[at] = dice.next() as u8,
            3 => bytes[at..end].fill([0, 0xFF, 0x7F, 0x80][dice.below(4) as usize]),
            4 => drop(bytes.drain(at..end)),
            5 => {
                let part = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, part));
            }
            6 => {
                let other = dice.below(bytes.len() as u64) as usize;
                let length = (end - at).min(bytes.len() - other);
                let to = at.min(bytes.len() - length);
                bytes.copy_within(other..other + length, to);
            }
            _ if dice.below(4) == 0 => bytes.truncate(at),
            _ => bytes[at] = bytes[at].wrapping_add(1),
        }
    }
    bytes
}

/// Whole values, and what their keys have been seen with: they are mixed into values that look as if someone had meant them.
#[derive(Debug)]
pub struct Stock {
    whole: Vec<Value>,
    /// Values by their key.
    known: BTreeMap<String, Vec<Value>>,
    /// Keys by the key of the object that they stand in.
    within: BTreeMap<String, BTreeSet<String>>,
    names: Vec<String>,
}

impl Stock {
    /// Of valid texts, and a schema for keys and names that none of them has.
    pub fn new<'a>(texts: impl IntoIterator<Item = &'a str>, schema: &Value) -> Self {
        let whole: Vec<Value> = texts.into_iter().map(|text| serde_json::from_str(text).unwrap()).collect();
        let mut stock = Stock { whole, known: BTreeMap::new(), within: BTreeMap::new(), names: Vec::new() };
        for value in stock.whole.clone() {
            stock.learn(&value, "");
        }
        stock.learn_schema(schema);
        stock
    }

    /// The values that are changed.
    pub fn all(&self) -> &[Value] {
        &self.whole
    }

    fn learn(&mut self, value: &Value, parent: &str) {
        match value {
            Value::Object(map) => {
                for (key, value) in map {
                    self.within.entry(parent.to_owned()).or_default().insert(key.clone());
                    self.known.entry(key.clone()).or_default().push(value.clone());
                    self.learn(value, key);
                }
            }
            Value::Array(list) => list.iter().take(8).for_each(|value| self.learn(value, parent)),
            _ => {}
        }
    }

    /// Keys are those of `properties`, names those of `enum` and `const`.
    fn learn_schema(&mut self, schema: &Value) {
        let Value::Object(map) = schema else {
            schema.as_array().into_iter().flatten().for_each(|value| self.learn_schema(value));
            return;
        };
        for (key, value) in map {
            match (key.as_str(), value) {
                ("properties", Value::Object(keys)) => keys.keys().for_each(|key| {
                    self.known.entry(key.clone()).or_default();
                }),
                ("enum", Value::Array(names)) => self.names.extend(names.iter().filter_map(text_of)),
                ("const", name) => self.names.extend(text_of(name)),
                _ => {}
            }
            self.learn_schema(value);
        }
    }

    /// A value that was whole, as text: changed in its parts, as characters, or both.
    pub fn draw(&self, dice: &mut Dice) -> String {
        let mut value = self.pick(&self.whole, dice);
        let kind = dice.below(8);
        if kind > 0 {
            self.change(&mut value, dice);
        }
        let whole = value.to_string();
        if kind < 2 { text(&whole, dice) } else { whole }
    }

    /// Goes from a whole value on by changes of which each leaves it whole, up to eight; a last one may not.
    pub fn wander(&self, dice: &mut Dice, is_whole: impl Fn(&str) -> bool) -> String {
        let mut value = self.pick(&self.whole, dice);
        for _ in 0..1 + dice.below(8) {
            let mut other = value.clone();
            self.change(&mut other, dice);
            if is_whole(&other.to_string()) {
                value = other;
            }
        }
        if dice.below(4) == 0 {
            self.change(&mut value, dice);
        }
        value.to_string()
    }

    /// Changes up to four parts of a value, mostly one.
    pub fn change(&self, value: &mut Value, dice: &mut Dice) {
        let wanted = if dice.below(2) == 0 { 1 } else { 1 + dice.below(4) };
        let mut done = 0;
        for _ in 0..40 {
            let mut number = dice.below(count(value) as u64) as usize;
            let Some((part, key)) = nth(value, &mut number, None) else { continue };
            done += u64::from(self.change_part(part, key.as_deref(), dice));
            if done == wanted {
                break;
            }
        }
    }

    fn pick(&self, list: &[Value], dice: &mut Dice) -> Value {
        list[dice.below(list.len() as u64) as usize].clone()
    }

    /// Something that the key has been seen with, or anything.
    fn known(&self, key: &str, dice: &mut Dice) -> Value {
        match self.known.get(key) {
            Some(list) if !list.is_empty() && dice.below(10) > 0 => self.pick(list, dice),
            _ => self.odd(dice),
        }
    }

    /// A key that such an object has been seen with, or any.
    fn key(&self, parent: &str, dice: &mut Dice) -> &str {
        let among = |count: usize, dice: &mut Dice| dice.below(count as u64) as usize;
        match self.within.get(parent) {
            Some(keys) if dice.below(12) > 0 => keys.iter().nth(among(keys.len(), dice)).unwrap(),
            _ => self.known.keys().nth(among(self.known.len(), dice)).unwrap(),
        }
    }

    fn odd(&self, dice: &mut Dice) -> Value {
        match dice.below(10) {
            0 => Value::Null,
            1 => json!(dice.below(2) == 0),
            2 => json!([]),
            3 => json!({}),
            4 => json!([dice.within(-2.0, 2.0), dice.within(-2.0, 2.0)]),
            5 if !self.names.is_empty() => json!(self.names[dice.below(self.names.len() as u64) as usize]),
            6 => json!(dice.below(12)),
            _ => json!(NUMBERS[dice.below(NUMBERS.len() as u64) as usize]),
        }
    }

    /// Whether the change that was drawn is one that this part can have.
    fn change_part(&self, part: &mut Value, key: Option<&str>, dice: &mut Dice) -> bool {
        match (dice.below(12), part) {
            (0, part) => *part = self.odd(dice),
            (1..4, part) if key.is_some() => *part = self.known(key.unwrap_or_default(), dice),
            (4, Value::Object(map)) if !map.is_empty() => {
                let key = map.keys().nth(dice.below(map.len() as u64) as usize).cloned().unwrap();
                map.remove(&key);
            }
            (4..8, Value::Object(map)) => {
                let key = self.key(key.unwrap_or_default(), dice);
                map.insert(key.to_owned(), self.known(key, dice));
            }
            (4 | 5, Value::Array(list)) if !list.is_empty() => list.push(self.pick(list, dice)),
            (6, Value::Array(list)) if !list.is_empty() => drop(list.remove(dice.below(list.len() as u64) as usize)),
            (7, Value::Array(list)) if list.len() > 1 => {
                let other = dice.below(list.len() as u64) as usize;
                list.swap(0, other);
            }
            (8, Value::Array(list)) => list.truncate(list.len() / 2),
            (6..12, Value::Number(number)) => *number = changed(number, dice),
            (6, Value::String(name)) if !self.names.is_empty() => {
                name.clone_from(&self.names[dice.below(self.names.len() as u64) as usize]);
            }
            _ => return false,
        }
        true
    }
}

fn text_of(value: &Value) -> Option<String> {
    value.as_str().map(str::to_owned)
}

/// Another number near this one, far from it, or one at which something may turn; of what counts mostly one that counts.
fn changed(number: &Number, dice: &mut Dice) -> Number {
    let value = number.as_f64().unwrap_or(0.0);
    let other = match dice.below(6) {
        0 => NUMBERS[dice.below(NUMBERS.len() as u64) as usize],
        1 => -value,
        2 => value + 1.0,
        3 => value * 10.0_f64.powi(dice.below(13) as i32 - 6),
        _ => value * dice.within(0.1, 3.0),
    };
    if !number.is_f64() && other >= 0.0 && dice.below(10) > 0 {
        return Number::from(other as u64);
    }
    Number::from_f64(other).unwrap_or_else(|| Number::from(0))
}

/// How many parts a value has, itself among them.
fn count(value: &Value) -> usize {
    1 + match value {
        Value::Object(map) => map.values().map(count).sum(),
        Value::Array(list) => list.iter().map(count).sum(),
        _ => 0,
    }
}

/// The part of this number, as [`count`] goes through them, with the key that it stands under.
fn nth<'a>(value: &'a mut Value, left: &mut usize, key: Option<&str>) -> Option<(&'a mut Value, Option<String>)> {
    if *left == 0 {
        return Some((value, key.map(str::to_owned)));
    }
    *left -= 1;
    match value {
        Value::Object(map) => map.iter_mut().find_map(|(key, value)| nth(value, left, Some(key))),
        Value::Array(list) => list.iter_mut().find_map(|value| nth(value, left, key)),
        _ => None,
    }
}
