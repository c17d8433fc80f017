//! Readings of wall time: of several things in turn, so that what else the machine does falls on all of them.

use std::time::Instant;

/// Fewest readings of each.
const FEWEST: usize = 5;
/// Most readings of each.
const MOST: usize = 101;
/// Shortest reading `[s]`: below, the clock itself shows.
const SHORTEST: f64 = 2e-4;

/// Something that can be done over and over.
pub(super) type Task<'a> = &'a mut dyn FnMut();

/// Times tasks in turn for about `seconds` `[s]`. Returns, for each, its readings `[s]`, in the order in which they were
/// taken: entry k of all of them was taken in round k.
///
/// A task that is shorter than 0.2 ms is done several times for one reading, which is then divided.
pub(super) fn in_turn(seconds: f64, tasks: &mut [Task<'_>]) -> Vec<Vec<f64>> {
    let repeats: Vec<u32> = tasks.iter_mut().map(repeats).collect();
    let mut readings = vec![Vec::new(); tasks.len()];
    let begun = Instant::now();
    for round in 0..MOST {
        if round >= FEWEST && begun.elapsed().as_secs_f64() > seconds {
            break;
        }
        for ((task, &count), list) in tasks.iter_mut().zip(&repeats).zip(&mut readings) {
            let clock = Instant::now();
            (0..count).for_each(|_| task());
            list.push(clock.elapsed().as_secs_f64() / f64::from(count));
        }
    }
    readings
}

/// How often a task is done for one reading; the first time, which warms caches, does not count.
fn repeats(task: &mut Task<'_>) -> u32 {
    task();
    let clock = Instant::now();
    task();
    let once = clock.elapsed().as_secs_f64().max(1e-9);
    (SHORTEST / once).ceil().min(1e4) as u32
}

/// The median of some readings; NaN of none.
pub(super) fn median(mut readings: Vec<f64>) -> f64 {
    readings.sort_by(f64::total_cmp);
    readings.get(readings.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_are_read_in_turn_and_as_often() {
        let (mut a, mut b) = (0, 0);
        let readings = in_turn(0.0, &mut [&mut || a += 1, &mut || b += 1]);
        assert_eq!(readings.iter().map(Vec::len).collect::<Vec<_>>(), [FEWEST, FEWEST]);
        assert!(a > FEWEST && b > FEWEST);
    }

    #[test]
    fn the_median_is_a_reading() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert!(median(Vec::new()).is_nan());
    }
}
