//! Damaged recordings, lists of commands, running states and the pictures that hold them.

use std::io::{Read, Write};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use wobble::history::{Entry, History, Log, Recording, Replay, Start, chunk};
use wobble::scene::{Scene, schema};

use super::common::damage::{Stock, bytes, text};
use super::common::session::{Dice, any};
use super::driver::{Trial, run, shows};

const TRIAL: Trial = Trial { name: "recordings", few: 1_000, most_bytes: 16 << 20 };

/// Commands later than this are read and not done [s].
const LATEST: f64 = 0.1;

/// What is damaged.
struct Whole {
    header: Value,
    commands: Stock,
    recordings: Stock,
    state: Recording,
    picture: Vec<u8>,
}

/// A session with commands of all kinds, whether they can be done or not.
fn whole() -> Whole {
    let mut history = History::new(Start::from(Scene::load("spring-damper").unwrap())).unwrap();
    let mut dice = Dice::new(11);
    for _ in 0..60 {
        let (act, name) = any(&history, &mut dice);
        let _ = history.give(vec![act], name);
        history.step();
    }
    let state = history.snapshot().unwrap();
    let mut made = history.recording();
    let whole = text_of(&made);
    for number in 0..40 {
        let (act, _) = any(&history, &mut dice);
        made.commands.push(Entry {
            at: history.world().time() + 0.001 * f64::from(number),
            act,
            edit: None,
            name: None,
        });
    }
    (made.end, made.marks) = (None, Vec::new());
    let mut lines = Vec::new();
    made.write_lines(&mut lines).unwrap();
    let lines = String::from_utf8(lines).unwrap();
    let (header, commands) = lines.split_once('\n').unwrap();
    let blank = wobble::picture::Picture::filled(4, 3, [9; 4]);
    let picture = wobble::picture::encode(&blank).unwrap();
    Whole {
        header: serde_json::from_str(header).unwrap(),
        commands: Stock::new(commands.lines(), &Value::Null),
        recordings: Stock::new([whole.as_str(), text_of(&state).as_str()], &schema()),
        picture: chunk::insert(&picture, &whole).unwrap(),
        state,
    }
}

fn text_of(recording: &Recording) -> String {
    let mut bytes = Vec::new();
    recording.write_json(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

impl Whole {
    /// A recording as lines: some of the commands, in the order of their times, damaged here and there.
    fn lines(&self, dice: &mut Dice) -> String {
        let all = self.commands.all();
        let mut some: Vec<Value> =
            (0..1 + dice.below(6)).map(|_| all[dice.below(all.len() as u64) as usize].clone()).collect();
        for command in &mut some {
            // Early, so that it is done.
            command["at"] = json!(dice.within(0.0, LATEST));
            if dice.below(2) == 0 {
                self.commands.change(command, dice);
            }
        }
        if dice.below(8) > 0 {
            let time = |command: &Value| command.get("at").and_then(Value::as_f64).unwrap_or(0.0);
            some.sort_by(|a, b| time(a).total_cmp(&time(b)));
        }
        let lines: Vec<String> = some.iter().map(Value::to_string).collect();
        let whole = format!("{}\n{}\n", self.header, lines.join("\n"));
        if dice.below(5) == 0 { text(&whole, dice) } else { whole }
    }

    /// A recording that begins at a running state, whose numbers are damaged behind the sum that guards them.
    fn state(&self, dice: &mut Dice) -> String {
        let mut state = self.state.clone();
        let kept = state.state.as_mut().unwrap();
        let packed = BASE64_STANDARD.decode(kept["data"].as_str().unwrap()).unwrap();
        let mut plain = Vec::new();
        flate2::read::ZlibDecoder::new(&packed[..]).read_to_end(&mut plain).unwrap();
        let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
        packed.write_all(&bytes(&plain, dice)).unwrap();
        kept["data"] = json!(BASE64_STANDARD.encode(packed.finish().unwrap()));
        text_of(&state)
    }

    fn draw(&self, dice: &mut Dice) -> String {
        match dice.below(8) {
            0 => self.recordings.draw(dice),
            1 => self.state(dice),
            2 => chunk::find(&bytes(&self.picture, dice)).unwrap_or_default(),
            _ => self.lines(dice),
        }
    }
}

/// Reads a recording and does its early commands.
fn exercise(text: &str) -> &'static str {
    let is_line = |line: String| assert!(!line.contains('\n') && line.len() < 900, "{line:?}");
    let log = match Log::of_text(text, "x") {
        Ok(log) => log,
        Err(error) => {
            is_line(error.to_string());
            return "refused";
        }
    };
    let Ok(head) = log.head() else { return "a list" };
    let mut run = match Replay::new(head, "x") {
        Ok(run) => run,
        Err(error) => {
            is_line(error.to_string());
            return "no world";
        }
    };
    let start = run.world().time();
    let mut ended = "ran";
    let read = log.each(&mut |number, entry| {
        if entry.at < start + LATEST
            && let Err(error) = run.follow(number, &entry)
        {
            is_line(error.to_string());
            ended = "refused on the way";
            return Ok(false);
        }
        Ok(true)
    });
    if let Err(error) = read {
        is_line(error.to_string());
    }
    ended
}

#[test]
fn damaged_recordings_are_run_or_refused_in_a_line() {
    let whole = whole();
    let ended = run(&TRIAL, |number| {
        let text = whole.draw(&mut Dice::new(number));
        if shows() {
            eprintln!("{number}: {text}");
        }
        exercise(&text)
    });
    let all: u64 = ended.values().sum();
    let share = |how: &str| ended.get(how).copied().unwrap_or(0) as f64 / all as f64;
    assert!(all < 500 || (share("refused") > 0.1 && share("ran") > 0.1), "the damage is too much or too little");
}
