//! A long session led by random commands: memory does not grow but by what was said, energy stays bounded, counts stay sane.
//!
//! `WOBBLE_SOAK_SECONDS` asks for a longer one: 3600 is an hour.

use std::sync::PoisonError;

use wobble::history::{DeleteKeys, Do, History, Start};
use wobble::scene::Scene;
use wobble::sim::{Dynamics, PointId};

use super::HEAP;
use super::common::session::{Dice, play};
use super::driver::{TURN, number};

/// Length of the session that always runs [s].
const SECONDS: u64 = 120;

/// Bytes that keyframes may take.
const KEYFRAMES: usize = 8 << 20;

/// Bytes of the log for a command, and of the world for a number that a point, a bond or an obstacle ever had.
const OF_A_COMMAND: usize = 2_048;
const OF_A_NUMBER: usize = 1_024;

/// Bytes that the program has without a session.
const OWN: usize = 2 << 20;

/// Living points above which the newest are taken away, so that the world stays as large as it is.
const MOST_POINTS: usize = 120;

/// Obstacles above which the newest are taken away.
const MOST_OBSTACLES: usize = 12;

/// Energy that no push, grab or edit of these gives so small a world [J]: ten times the most of five minutes.
const MOST_ENERGY: f64 = 1.6e4;

/// Takes points and obstacles away until few are left. Returns how many commands that was.
fn trim(history: &mut History) -> usize {
    let world = history.world();
    let (living, obstacles) = (world.point_count() - world.gone().len(), world.obstacle_numbers().concat());
    let mut keys = DeleteKeys::default();
    if living > MOST_POINTS {
        let numbers =
            (0..world.point_count() as u32).rev().filter(|&i| world.gone().binary_search(&PointId(i)).is_err());
        keys.points = numbers.take(living - MOST_POINTS / 2).collect();
    }
    if obstacles.len() > MOST_OBSTACLES {
        keys.obstacles = obstacles[MOST_OBSTACLES / 2..].to_vec();
    }
    if keys == DeleteKeys::default() {
        return 0;
    }
    usize::from(history.give(vec![Do::Delete(keys)], Some("Trim")).is_ok())
}

/// Resident size of the program [bytes], where the system tells.
fn resident() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.split_whitespace().next()?.parse::<usize>().ok().map(|kib| kib << 10)
}

/// Whether what a world counts and lists can be.
fn is_sane(world: &dyn Dynamics, when: &str) {
    let done = world.counters();
    let moved = done.points_moved;
    assert!(moved <= done.substeps * world.point_count() as u64, "{when}: {done:?}");
    assert!(done.bonds_torn <= u64::from(world.next_numbers()[1]), "{when}: {done:?}");
    assert!(world.is_finite() && world.energy().abs() < MOST_ENERGY, "{when}: {} J", world.energy());
    let numbers: u32 = world.next_numbers().iter().sum();
    let allowed = (64 << 10) + OF_A_NUMBER * numbers as usize;
    assert!(world.heap_bytes() < allowed, "{when}: {} of {allowed} bytes", world.heap_bytes());
}

#[test]
fn a_long_session_grows_by_what_is_said_alone() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let seconds = number("WOBBLE_SOAK_SECONDS").unwrap_or(SECONDS);
    let (heap, size) = (HEAP.current_usage(), resident());
    let mut history = History::new(Start::from(Scene::load("rim").unwrap())).unwrap();
    history.bound_keyframes(KEYFRAMES);
    let (mut dice, mut commands, mut most, mut second) = (Dice::new(29), 0, 0, 0);
    let mut highest: f64 = 0.0;
    while second < seconds {
        commands += play(&mut history, &mut dice, 1.0) + trim(&mut history);
        second += 1;
        let when = format!("after {second} s and {commands} commands");
        is_sane(history.world(), &when);
        highest = highest.max(history.world().energy().abs());
        let allowed = OWN + KEYFRAMES + OF_A_COMMAND * commands;
        let bytes = HEAP.current_usage().saturating_sub(heap);
        most = most.max(bytes);
        assert!(bytes < allowed, "{when}: {bytes} of {allowed} bytes on the heap");
        assert!(history.keyframe_bytes() <= KEYFRAMES, "{when}: {}", history.keyframe_bytes());
        if let (Some(before), Some(now)) = (size, resident()) {
            // What was freed may lie between what was not.
            assert!(now < before + 2 * allowed, "{when}: {now} bytes resident, {before} before");
        }
        if second % 60 == 0 {
            eprintln!(
                "soak: {when}: {} KiB, world {} KiB, {} J",
                bytes >> 10,
                history.world().heap_bytes() >> 10,
                history.world().energy()
            );
        }
    }
    assert!(commands as u64 > 20 * seconds, "{commands} commands");
    let world = history.world();
    eprintln!(
        "soak: {seconds} s, {commands} commands, {:?} numbers, at most {} KiB and {highest} J, {:?}",
        world.next_numbers(),
        most >> 10,
        world.counters()
    );
    drop(history);
    let left = HEAP.current_usage().saturating_sub(heap);
    assert!(left < 1 << 20, "{left} bytes are left of it");
}
