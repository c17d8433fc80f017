//! Whether a motion keeps its energy, by its ledger.

use super::Ledger;

/// Largest share of the kinetic energy so far that may come from nowhere `[1]`.
pub const MOST_GAIN: f64 = 0.01;
/// Largest share of the kinetic energy so far that may go without a reason within [`LOSS_TIME`] `[1]`.
pub const MOST_LOSS: f64 = 0.05;
/// Time within which losses are looked at `[s]`.
pub const LOSS_TIME: f64 = 10.0;

/// Entries that a median is taken of: an impact that one of them falls into does not count.
const SMOOTHED: usize = 5;

/// How well a motion kept its energy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Verdict {
    /// The most that came from nowhere, as a share of the largest kinetic energy until then `[1]`.
    pub gain: f64,
    /// When `[s]`.
    pub gain_at: f64,
    /// The most that went without a reason within [`LOSS_TIME`], as a share of the largest kinetic energy until then `[1]`.
    pub loss: f64,
    /// By when `[s]`.
    pub loss_at: f64,
    /// The work at led pins could be told from the method's own error: without that neither can be judged.
    pub is_told: bool,
}

impl Verdict {
    /// Whether energy came from nowhere: more than [`MOST_GAIN`], or a number that is none.
    pub fn gains(&self) -> bool {
        self.is_told && exceeds(self.gain, MOST_GAIN)
    }

    /// Whether energy went without a reason: more than [`MOST_LOSS`], or a number that is none.
    pub fn loses(&self) -> bool {
        self.is_told && exceeds(self.loss, MOST_LOSS)
    }

    /// Whether nothing is wrong.
    pub fn passes(&self) -> bool {
        !self.gains() && !self.loses()
    }
}

/// Judges a motion by its ledger at times that ascend, from the start on: once a frame is enough.
///
/// Gains are what the energy has over its start and what was brought, whatever was taken since. Losses are what neither dampers,
/// drag, friction, restitution nor breaking bonds explain, between any two times not further apart than [`LOSS_TIME`].
/// Both are medians of five entries but for the start, and relative to the largest kinetic energy until then, of what the scene could give
/// at most, at least to what nobody would see ([`Ledger::unseen`]); less than rounding makes is nothing.
/// Without entries nothing is wrong.
pub fn judge(entries: &[Ledger]) -> Verdict {
    let mut verdict = Verdict { is_told: entries.iter().all(|entry| entry.book.untold == 0), ..Verdict::default() };
    let excess = medians(entries, Ledger::excess);
    let left = medians(entries, Ledger::left_over);
    let available = available(entries);
    let mut first = 0;
    for (k, entry) in entries.iter().enumerate() {
        let last = &entries[(k + SMOOTHED / 2).min(entries.len() - 1)];
        let there = available[(k + SMOOTHED / 2).min(entries.len() - 1)];
        let share = |energy: f64| match energy {
            energy if energy <= last.rounding => 0.0,
            energy => energy / last.most_kinetic.min(there).max(last.unseen),
        };
        while entry.time - entries[first].time > LOSS_TIME {
            first += 1;
        }
        let most = left[first..=k].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (gain, loss) = (share(excess[k]), share(most - left[k]));
        if exceeds(gain, verdict.gain) {
            (verdict.gain, verdict.gain_at) = (gain, entry.time);
        }
        if exceeds(loss, verdict.loss) {
            (verdict.loss, verdict.loss_at) = (loss, entry.time);
        }
        if !entry.now.sum().is_finite() {
            return Verdict { gain: f64::INFINITY, gain_at: entry.time, ..verdict };
        }
    }
    verdict
}

/// Of each entry the largest kinetic energy that a motion could have had until then: what it had of it and of springs' at the start, what
/// was brought, and what gravity gave `[J]`.
fn available(entries: &[Ledger]) -> Vec<f64> {
    let Some(first) = entries.first() else { return Vec::new() };
    let [start, height] = [first.now.kinetic + first.now.elastic(), first.now.gravity];
    let given = |entry: &Ledger| entry.book.brought() + height - entry.now.gravity;
    let mut most: f64 = 0.0;
    let until = |entry| {
        most = most.max(given(entry));
        start + most
    };
    entries.iter().map(until).collect()
}

/// Whether a number is larger than another; what is no number is as large as can be.
fn exceeds(a: f64, b: f64) -> bool {
    a > b || a.is_nan()
}

/// Of each entry the median of those around it.
fn medians(entries: &[Ledger], of: fn(&Ledger) -> f64) -> Vec<f64> {
    let values: Vec<f64> = entries.iter().map(of).collect();
    let around = |k: usize| {
        let mut near = values[k.saturating_sub(SMOOTHED / 2)..(k + SMOOTHED / 2 + 1).min(values.len())].to_vec();
        near.sort_by(f64::total_cmp);
        near[near.len() / 2]
    };
    // The start is what it is said to be.
    (0..values.len()).map(|k| if k == 0 { values[0] } else { around(k) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::ledger::{Book, Energies};

    /// Entries ten a second, with these kinetic energies from 100 J on, and what friction took by then.
    fn entries(count: usize, of: impl Fn(f64) -> (f64, f64)) -> Vec<Ledger> {
        let entry = |k: usize| {
            let time = 0.1 * k as f64;
            let (kinetic, friction) = of(time);
            let now = Energies { kinetic, ..Energies::default() };
            Ledger {
                time,
                now,
                start: 100.0,
                book: Book { friction, ..Book::default() },
                most_kinetic: 100.0,
                unseen: 1e-3,
                rounding: 1e-9,
            }
        };
        (0..count).map(entry).collect()
    }

    #[test]
    fn what_comes_from_nowhere_is_a_gain() {
        let kept = judge(&entries(300, |_| (100.0, 0.0)));
        assert_eq!((kept.gain, kept.loss), (0.0, 0.0));
        assert!(kept.passes());
        let more = judge(&entries(300, |t| (100.0 + 0.1 * t, 0.0)));
        assert!(more.gains() && !more.loses() && (more.gain - 0.0298).abs() < 1e-9, "{more:?}");
        assert!(judge(&entries(300, |t| (100.0 + 0.03 * t, 0.0))).passes());
    }

    #[test]
    fn what_friction_took_is_no_loss() {
        let slides = |share: f64| move |t: f64| (100.0 - 2.0 * t, share * 2.0 * t);
        assert!(judge(&entries(300, slides(1.0))).passes());
        let lost = judge(&entries(300, slides(0.5)));
        assert!(lost.loses() && (lost.loss - 0.1).abs() < 1e-9, "1 W for 10 s of 100 J: {lost:?}");
        assert!(judge(&entries(300, slides(0.8))).passes(), "0.4 W: 4 J in 10 s, though 12 J in all");
    }

    #[test]
    fn one_entry_in_an_impact_does_not_count() {
        let mut dented = entries(300, |_| (100.0, 0.0));
        dented[40].now.kinetic = 150.0;
        dented[90].now.kinetic = 20.0;
        assert!(judge(&dented).passes());
        (41..43).for_each(|k| dented[k].now.kinetic = 150.0);
        assert!(judge(&dented).gains(), "three of five do");
    }

    #[test]
    fn what_explodes_is_no_measure_of_itself() {
        let mut burst = entries(300, |t| if t < 3.0 { (100.0, 0.0) } else { (150.0, 0.0) });
        burst.iter_mut().for_each(|entry| entry.most_kinetic = 1e9);
        assert!(judge(&burst).gains(), "{:?}", judge(&burst));
        // What gravity gives and a hand brings counts.
        let mut falls = entries(300, |t| (100.0 + 10.0 * t, 0.0));
        for entry in &mut falls {
            (entry.now.gravity, entry.most_kinetic) = (-10.0 * entry.time, 100.0 + 10.0 * entry.time);
        }
        assert!(judge(&falls).passes());
        falls.iter_mut().for_each(|entry| entry.now.kinetic += 0.009 * entry.most_kinetic);
        falls[0].now.kinetic = 100.0;
        assert!(judge(&falls).passes(), "{:?}", judge(&falls));
    }

    #[test]
    fn what_goes_in_the_first_frame_is_seen() {
        let lost = entries(300, |t| if t < 0.05 { (100.0, 0.0) } else { (80.0, 0.0) });
        assert!(judge(&lost).loses(), "{:?}", judge(&lost));
        assert!(judge(&entries(300, |t| if t < 0.05 { (100.0, 0.0) } else { (80.0, 20.0) })).passes());
    }

    #[test]
    fn what_is_no_number_is_a_gain_and_nothing_is_nothing() {
        let mut broken = entries(30, |_| (100.0, 0.0));
        broken[20].now.kinetic = f64::NAN;
        assert!(judge(&broken).gains());
        assert!(judge(&[]).passes());
        let mut untold = entries(30, |t| (100.0 + t, 0.0));
        assert!(judge(&untold).gains());
        untold[29].book.untold = 1;
        assert!(judge(&untold).passes() && !judge(&untold).is_told);
    }
}
