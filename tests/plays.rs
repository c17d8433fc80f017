//! The gallery as someone plays it: what a caption tells to do is done by commands, as the tools give them, and the outcome that it
//! names is measured. `files/plays.json` has both; goldens show the scenes afterwards, `gallery/NAME.png` shows them before.
//! `minute` lets each play go on, and holds it to the laws that its scene is under.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

mod laws;
mod minute;

use crate::common;

use serde::Deserialize;
use serde_json::Value;
use wobble::scene::{ViewKeys, gallery};
use wobble::sim::Sample;

/// What is done in a scene, and what comes of it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Play {
    scene: String,
    /// When it is looked at `[s]`.
    end: f64,
    commands: Vec<Value>,
    measures: Vec<Measure>,
    /// Left out where another play of the same scene has one.
    #[serde(default = "yes")]
    picture: bool,
    /// What its picture shows, where that is seen from nearer than the scene opens.
    view: Option<ViewKeys>,
    /// What is done afterwards: hands let go, and it is played with again.
    #[serde(default)]
    then: Vec<Value>,
    /// How long it is played `[s]`, where that is no minute, and why not.
    until: Option<f64>,
    why: Option<String>,
    /// What holds all the while.
    laws: Vec<laws::Law>,
    /// What comes out by a formula.
    #[serde(default)]
    formulas: Vec<minute::Formula>,
}

/// A number of the caption.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Measure {
    what: What,
    #[serde(default)]
    axis: Axis,
    /// Of these points; of all unless they or a range are said.
    points: Option<Vec<usize>>,
    range: Option<[usize; 2]>,
    /// Less what it was then `[s]`.
    since: Option<f64>,
    expected: f64,
    within: f64,
}

/// Of which points: of these, of a range, or of all.
struct Which<'a>(Option<&'a [usize]>, Option<[usize; 2]>);

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Axis {
    X,
    #[default]
    Y,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum What {
    /// Where the middle is, the topmost, the lowest point, and how far they are apart `[m]`.
    Middle,
    Top,
    Bottom,
    Extent,
    /// From the first point to the second `[m]`.
    Length,
    /// What points enclose, in their order, in the plane `[m^2]`.
    Area,
    /// Of the fastest point `[m/s]`.
    Speed,
    /// The largest |length/rest - 1| of a bond `[1]`.
    Strain,
    /// Bonds that tore.
    Torn,
    /// The energy `[J]`.
    Energy,
}

/// Something is done after so long in each scene, or in the second half of what is played [s]: a minute is more than its first seconds.
const LATER: f64 = 20.0;

/// What is played no longer than this has time for its caption alone [s].
const SHORT: f64 = 1.0;

/// When a command begins [s].
fn begins(command: &Value) -> f64 {
    command["at"].as_f64().unwrap()
}

fn yes() -> bool {
    true
}

fn plays() -> Vec<Play> {
    let plays = std::fs::read_to_string(common::file("plays.json")).unwrap();
    serde_json::from_str(&plays).unwrap()
}

impl Measure {
    fn of(&self, sample: &Sample, torn: u64) -> f64 {
        self.what.of((self.axis, Which(self.points.as_deref(), self.range)), sample, torn)
    }
}

impl What {
    fn of(self, (axis, which): (Axis, Which<'_>), sample: &Sample, torn: u64) -> f64 {
        let points = match which {
            Which(Some(points), _) => points.to_vec(),
            Which(None, Some([first, last])) => (first..=last).collect(),
            Which(None, None) => (0..sample.position.len()).collect(),
        };
        let places = points.iter().map(|&point| sample.position[point][axis as usize]);
        let bottom = || places.clone().fold(f64::INFINITY, f64::min);
        let top = || places.clone().fold(f64::NEG_INFINITY, f64::max);
        let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        match self {
            What::Middle => places.clone().sum::<f64>() / points.len() as f64,
            What::Top => top(),
            What::Bottom => bottom(),
            What::Extent => top() - bottom(),
            What::Length => {
                let [a, b] = [points[0], points[1]].map(|point| sample.position[point]);
                size([0, 1, 2].map(|axis| a[axis] - b[axis]))
            }
            What::Area => {
                let corners = points.iter().zip(points.iter().cycle().skip(1));
                let corners = corners.map(|(&a, &b)| [sample.position[a], sample.position[b]]);
                0.5 * corners.map(|[a, b]| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
            }
            What::Speed => points.iter().map(|&point| size(sample.velocity[point])).fold(0.0, f64::max),
            What::Strain => sample.max_strain,
            What::Torn => torn as f64,
            What::Energy => sample.energy,
        }
    }
}

/// Whether a caption has a number, or one of per cent, that is what came out, as exactly as it is printed.
fn says(caption: &str, expected: f64, within: f64) -> bool {
    let words: Vec<&str> = caption.split_whitespace().collect();
    words.iter().zip(words.iter().skip(1).chain([&""])).any(|(word, next)| {
        let word = word.trim_end_matches(|c: char| !c.is_ascii_digit());
        let Ok(value) = word.parse::<f64>() else { return false };
        let digits = word.split_once('.').map_or(0, |(_, digits)| digits.len());
        let unit = if next.starts_with('%') { 0.01 } else { 1.0 };
        let printed = 0.5 * 0.1_f64.powi(digits as i32);
        (value * unit - expected.abs()).abs() <= within + printed * unit || (value * unit - expected).abs() <= 1e-12
    })
}

/// What its scene says of it, and whether the numbers that came out are those.
fn misprints(play: &Play, values: &[f64]) -> Vec<String> {
    let entry = gallery().iter().find(|entry| entry.name == play.scene).unwrap();
    let caption = [entry.description, entry.to_try].join(" ");
    let mut wrong = Vec::new();
    for (measure, value) in play.measures.iter().zip(values) {
        if (value - measure.expected).abs() > measure.within {
            wrong.push(format!("{}: {value} instead of {}", play.scene, measure.expected));
        }
        let is_none = measure.expected == 0.0 && measure.within < 1e-8;
        if !is_none && !says(&caption, measure.expected, measure.within) {
            wrong.push(format!("{}: its caption has no {}: {caption}", play.scene, measure.expected));
        }
    }
    wrong
}

#[test]
fn every_scene_of_the_gallery_is_played() {
    let plays = plays();
    for entry in gallery() {
        assert!(plays.iter().any(|play| play.scene == entry.name), "nobody plays {}", entry.name);
        let goes_on = |play: &Play| {
            let later = LATER.min(0.5 * play.until());
            let is_late = |command: &Value| begins(command) >= later;
            play.scene == entry.name && (play.until() < SHORT || play.then.iter().any(is_late))
        };
        assert!(plays.iter().any(goes_on), "nobody goes on with {} after its caption", entry.name);
    }
    for play in &plays {
        let mut commands = play.commands.iter().chain(&play.then);
        assert!(commands.all(|command| begins(command) <= play.until()), "{} ends before all is done", play.scene);
        assert!(!play.measures.is_empty(), "{}", play.scene);
    }
}

#[test]
fn a_number_that_a_caption_does_not_have_is_missed() {
    assert!(says("it hangs 0.18 m longer", 0.183, 0.0) && !says("it hangs 0.18 m longer", 0.19, 0.0));
    assert!(says("a bond is 92 % off", 0.918, 0.0) && !says("a bond is 92 off", 0.918, 0.0));
    assert!(says("it falls 1.3 m; then", -1.31, 0.0) && !says("it falls far", -1.31, 10.0));
}
