//! Servos of a selection in its panel: where its angles are at rest goes to and fro by a wave, by a key, or by a wave while a key is held.

use egui::{Response, Ui};

use super::drives::keys;
use super::material::{Sink, row};
use super::{ticks, wave};
use crate::app::matter::{Common, Matter, MatterChange};
use crate::scene::DriveKeys;
use crate::sim::drive::{MOST_SWING, RATE, RATES};

/// What swings at first: by so much `[rad]`, once in so long `[s]`.
const FIRST: [f64; 2] = [0.5, 1.0];
/// How fast an angle changes as it is dragged, for each point `[deg]`, and a rate, as a share of it.
const SPEED: f64 = 0.5;
const SHARE: f64 = 0.01;

/// Whether angles that resist swing, and how.
pub(super) fn show(ui: &mut Ui, matter: &Matter, sink: &mut Sink<'_>) {
    let Some(now) = matter.swings else { return };
    row(ui, "", |ui, _| {
        let mut swings = now != Common::One(None);
        let words = "its angles at rest go to and fro, as servos turn them: by a wave, by a key, or by a wave while that is held";
        let by = ticks::check(ui, &mut swings, "swings").on_hover_text(words);
        if by.changed() {
            let first = DriveKeys { amplitude: Some(FIRST[0]), period: Some(FIRST[1]), ..DriveKeys::default() };
            sink.set(&by, MatterChange::Swings(swings.then_some(first)));
        }
    });
    match now {
        Common::Mixed => _ = row(ui, "", |ui, _| ui.weak("mixed: each has its own")),
        Common::One(None) => {}
        Common::One(Some(before)) => {
            let mut drive = before;
            let by = rows(ui, &mut drive);
            if let Some(by) = by.filter(|_| drive != before) {
                sink.set(&by, MatterChange::Swings(Some(drive)));
            }
        }
    }
}

/// All that a servo has. Returns what was changed by, if anything was.
fn rows(ui: &mut Ui, drive: &mut DriveKeys) -> Option<Response> {
    let mut all = Vec::new();
    let mut degrees = drive.amplitude.unwrap_or(0.0).to_degrees();
    let most = MOST_SWING.to_degrees().floor();
    all.push(wave::field(ui, ("swing", "°"), (&mut degrees, SPEED), -most..=most));
    if all.iter().any(Response::changed) {
        drive.amplitude = Some(degrees.to_radians());
    }
    all.extend(of_wave(ui, drive));
    let held = [drive.key, drive.back];
    let both = keys(ui, &mut drive.key, &mut drive.back);
    let is_held_anew = held != [drive.key, drive.back];
    let is_held = drive.key.is_some();
    // What follows nothing would be no servo; a key goes one way alone.
    drive.back = drive.back.filter(|back| is_held && Some(*back) != drive.key);
    if !is_held {
        (drive.rate, drive.period) = (None, drive.period.or(Some(FIRST[1])));
    }
    if is_held {
        let mut rate = drive.rate.unwrap_or(RATE);
        let speed = SHARE * rate;
        all.push(wave::field(ui, ("comes, goes", " /s"), (&mut rate, speed), RATES[0]..=RATES[1]));
        drive.rate = Some(rate);
    }
    all.into_iter().find(Response::changed).or(is_held_anew.then_some(both))
}

/// Whether it follows a wave, and which. It must where no key is held.
fn of_wave(ui: &mut Ui, drive: &mut DriveKeys) -> Vec<Response> {
    let mut has_wave = drive.period.is_some();
    let can_choose = drive.key.is_some();
    let by = row(ui, "", |ui, _| ticks::check_if(ui, can_choose || !has_wave, &mut has_wave, "wave"));
    if by.changed() {
        (drive.period, drive.phase) = (has_wave.then_some(FIRST[1]), None);
    }
    let mut all = vec![by];
    let Some(mut period) = drive.period else { return all };
    let mut phase = drive.phase.unwrap_or(0.0);
    all.extend(wave::fields(ui, &mut period, &mut phase));
    (drive.period, drive.phase) = (Some(period), drive.phase.or((phase != 0.0).then_some(phase)).map(|_| phase));
    all
}
