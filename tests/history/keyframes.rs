//! Keyframes: how many bytes they take, and how much is to be run through from the nearest one.

use wobble::history::{Do, History};
use wobble::scene::gallery;
use wobble::sim::{Counters, Cursor, Dynamics};

use super::common::session::Dice;
use super::common::{asked, say};
use super::{hash, history, play};

#[test]
fn keyframes_stay_within_their_bytes_and_going_back_stays_exact() {
    let mut history = history("rim");
    let each = history.keyframe_bytes();
    history.bound_keyframes(8 * each);
    let mut states = Vec::new();
    for _ in 0..12 {
        play(&mut history, 1500);
        states.push(hash(&history));
        assert!(history.keyframe_bytes() <= 8 * each + each / 2);
    }
    let (time, _) = history.nearest(f64::from_bits(states[5].1)).unwrap();
    assert!(time <= f64::from_bits(states[5].1));
    for index in [10, 2, 11, 6] {
        history.go_to(f64::from_bits(states[index].1));
        assert_eq!(hash(&history), states[index], "{index}");
    }
}

/// Runs for `seconds` with a cursor that goes about.
fn lead(history: &mut History, seconds: f64) {
    let end = history.world().time() + seconds;
    while history.world().time() < end {
        let now = history.world().time();
        let to = Some(Cursor::at([1.5 * (1.3 * now).sin(), 1.2 * (0.7 * now).cos()]));
        history.give(vec![Do::Cursor { to, by: Some(now + 0.1) }], None).unwrap();
        while history.world().time() < now + 0.1 {
            history.step();
        }
    }
}

/// Ten minutes of the rim, of which the last is dense: WOBBLE_SECONDS=600 runs all of it.
#[test]
fn ten_minutes_of_the_rim_take_64_mib_of_keyframes_at_most() {
    let seconds = asked("WOBBLE_SECONDS", 90.0);
    let mut live = history("rim");
    lead(&mut live, 60.0);
    let recent = live.keyframe_bytes();
    lead(&mut live, seconds - 60.0);
    let all = live.keyframe_bytes();
    let whole = recent as f64 + (all - recent) as f64 * 540.0 / (seconds - 60.0);
    say(&format!("{recent} bytes after a minute, {all} after {seconds} s, {whole:.0} after ten minutes"));
    assert!(whole <= f64::from(64 << 20), "{whole}");
    assert!(all > recent / 2 && recent > 0);
}

/// What was done between two states: points and bonds, in substeps.
fn work(from: &Counters, to: &Counters) -> (u64, u64) {
    let units = |counters: &Counters| counters.points_moved + counters.bonds_solved;
    (units(to) - units(from), to.substeps - from.substeps)
}

/// Time that this takes [s], by what a point or a bond was measured to take in each scene at most: 6e-8 s, in vectors 1e-8 s.
fn seconds(world: &dyn Dynamics, (units, substeps): (u64, u64)) -> f64 {
    let is_large = world.parts().iter().any(|part| !part.kernel.is_empty());
    units as f64 * if is_large { 1e-8 } else { 6e-8 } + substeps as f64 * 5e-7
}

/// Of each scene of up to 10,000 points, or of the first WOBBLE_SCENES alone.
#[test]
fn the_exact_state_of_any_time_takes_a_tenth_of_a_second_and_recording_a_hundredth() {
    let (count, run) = (asked("WOBBLE_SCENES", 5.0) as usize, asked("WOBBLE_SECONDS", 2.0));
    let names = ["rim", "gear", "spring-damper", "points", "random-graph"];
    let all = gallery().iter().map(|entry| entry.name).filter(|name| !names.contains(name));
    let mut dice = Dice::new(4);
    for name in names.into_iter().chain(all).take(count) {
        let mut live = history(name);
        if live.world().point_count() > 10_000 {
            continue;
        }
        let (start, first) = (*live.world().counters(), live.keyframe_bytes());
        lead(&mut live, run);
        let whole = work(&start, live.world().counters());
        let (mut worst, end) = (0.0f64, live.end());
        for _ in 0..40 {
            let t = dice.within((end - 60.0).max(0.0), end);
            let near = *live.nearest(t).unwrap().1.counters();
            live.go_to(t);
            worst = worst.max(seconds(live.world(), work(&near, live.world().counters())));
        }
        let bytes = (live.keyframe_bytes() - first) as f64;
        // Copies at 4 GB/s, beside the steps.
        let copies = bytes / 4e9 / seconds(live.world(), whole);
        say(&format!(
            "{name}: jump {:.0} ms, copies {:.2} %, {:.0} kB/s",
            1e3 * worst,
            1e2 * copies,
            bytes / run / 1e3
        ));
        assert!(worst <= 0.1, "{name}: {worst} s");
        assert!(copies <= 0.01, "{name}: {copies}");
    }
}
