//! A world with its past: undo, redo, going back and branches come to the same bits.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use wobble::history::{Do, History, Start, hash_now};
use wobble::scene::Scene;
use wobble::sim::{Cursor, MouseChange};

fn history(name: &str) -> History {
    History::new(Start::from(Scene::load(name).unwrap())).unwrap()
}

fn hash(history: &History) -> (String, u64) {
    (hash_now(history.world(), history.world().time()), history.world().time().to_bits())
}

fn cursor(x: f64, y: f64) -> Do {
    Do::Cursor { to: Some(Cursor::at([x, y])), by: None }
}

fn strength(strength: f64) -> Do {
    Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() })
}

/// Steps on, with a cursor that goes about.
fn play(history: &mut History, steps: usize) {
    for step in 0..steps {
        if step % 7 == 0 {
            let phase = step as f64 * 0.01;
            history.give(vec![cursor(phase.sin(), phase.cos())], None).unwrap();
        }
        history.step();
    }
}

#[test]
fn undo_goes_back_to_just_before_the_last_edit_and_redo_to_just_after_it() {
    let mut history = history("rim");
    play(&mut history, 300);
    let before = hash(&history);
    history.give(vec![strength(90.0)], Some("Stronger mouse")).unwrap();
    let after = hash(&history);
    play(&mut history, 200);
    let late = hash(&history);
    let undone = history.undo().unwrap();
    assert_eq!(undone.name, "Stronger mouse");
    assert!(undone.seconds < 0.0);
    assert_eq!(hash(&history), before);
    assert_eq!(history.undo(), None);
    let again = history.redo().unwrap();
    assert!(again.seconds == 0.0 && hash(&history) == after);
    assert_eq!(history.redo(), None);
    // What was undone is not done again by itself.
    history.undo().unwrap();
    play(&mut history, 200);
    assert_ne!(hash(&history), late);
}

#[test]
fn going_back_and_on_comes_to_the_same_bits() {
    let mut history = history("rim");
    let mut states = Vec::new();
    for _ in 0..40 {
        play(&mut history, 50);
        states.push(hash(&history));
    }
    let end = history.end();
    for &index in &[3, 38, 17, 0, 39] {
        let (_, bits) = states[index];
        history.go_to(f64::from_bits(bits));
        assert_eq!(hash(&history), states[index], "{index}");
        assert_eq!(history.end(), end);
    }
    history.go_to(0.5 * end);
    while history.world().time() < end {
        history.step();
    }
    assert_eq!(hash(&history), states[39]);
}
