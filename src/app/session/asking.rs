//! What would make a scene slow is asked about before it comes.

use std::time::Instant;

use super::Session;
use crate::app::count::grouped;
use crate::app::panels::{Question, short, speed};
use crate::history::Do;
use crate::scene::BodyKeys;

/// What takes less of a frame comes without a question, however slow the scene is already `[s]`.
const NOTICED: f64 = 0.004;
/// A scene that is slower than real time by more than this is asked about `[1]`.
const SLOWER: f64 = 1.25;
/// Of fewer points it says little what a point costs, unless all of them take what is noticed.
const KNOWN: usize = 500;
/// What a point costs in a frame, where nothing was measured yet, and at least: what comes moves, whatever sleeps there `[s]`.
const POINT: f64 = 3e-6;
const LEAST: f64 = 1e-7;
/// A frame `[s]`.
const FRAME: f64 = 1.0 / 60.0;

/// What an answer does, by its place.
pub(super) type Act = Box<dyn FnOnce(&mut Session, usize)>;

/// Something that waits for an answer.
pub(super) struct Asked {
    pub(super) question: Question,
    /// Since when it is asked whether the program is left; `None`: something else is asked.
    pub(super) leaving_since: Option<Instant>,
    /// What is done then.
    pub(super) act: Act,
}

/// The answers to something large that would come.
const ANSWERS: &[(&str, &str)] = &[("Add", "Enter"), ("Cancel", "Esc")];

/// What is asked where so many points come to so many others, which take so long in a frame `[s]` and reach such a share of their speed;
/// `None`: nothing. It speaks as the bar below does once they are there.
///
/// Model: work grows with points, so of twice as many a frame takes twice as long; where bodies meet what comes takes as much as what meets does,
/// however little what is there takes by itself. What else takes time, pictures above all, takes the same share of it.
fn question(coming: usize, (there, meets): (usize, bool), (work, pace): (f64, f64)) -> Option<String> {
    let all = coming + there;
    let is_known = there > 0 && (work >= NOTICED || (work > 0.0 && there >= KNOWN));
    let each = if is_known { (work / there as f64).max(LEAST) } else { POINT };
    let more = if meets { each.max(POINT) } else { each } * coming as f64;
    let later = each * there as f64 + more;
    if later <= SLOWER * FRAME || more < NOTICED {
        return None;
    }
    let steps_alone = |work: f64| (FRAME / work).min(1.0);
    let rest = if is_known && pace > 0.0 { (pace / steps_alone(work)).min(1.0) } else { 1.0 };
    let pace = speed(rest * steps_alone(later));
    let (more, all) = (grouped(coming), grouped(all));
    Some(format!("{more} points more, {all} in all: about {pace}, {} of work a frame.", short(later)))
}

/// How many points commands bring, about.
pub(super) fn points_of(commands: &[Do]) -> usize {
    let of_body = |body: &BodyKeys| body.columns.unwrap_or(0) as usize * body.rows.unwrap_or(1) as usize;
    let of = |act: &Do| match act {
        Do::Add(keys) => {
            let alone = keys.points.as_ref().map_or(0, |points| points.position.len());
            alone + keys.bodies.iter().map(of_body).sum::<usize>()
        }
        _ => 0,
    };
    commands.iter().map(of).sum()
}

impl Session {
    /// So many points come by `act`: at once, or after a question where the scene would be slow.
    pub(super) fn ask_if_full(&mut self, coming: usize, act: impl FnOnce(&mut Session) + 'static) {
        let figures = &self.shown().figures;
        // Not the work of late: what else runs on the machine is a part of that, and would be told as if points cost it.
        let work = figures.cost * figures.points as f64;
        let meets = self.shown().settings.contact.flatten().is_some();
        match question(coming, (figures.points, meets), (work, figures.pace)) {
            None => act(self),
            Some(words) => {
                let answered = |session: &mut Session, answer: usize| {
                    if answer == 0 {
                        act(session);
                    }
                };
                let question = Question { words, answers: ANSWERS };
                self.asked = Some(Asked { question, leaving_since: None, act: Box::new(answered) });
                self.panels_dirty = true;
            }
        }
        self.dirty = true;
    }

    /// The question was answered, by the place of the answer.
    pub(super) fn answered(&mut self, answer: usize) {
        let Some(asked) = self.asked.take() else { return };
        (asked.act)(self, answer);
        self.touch();
    }

    /// By the last answer, which does nothing.
    pub(super) fn unanswered(&mut self) {
        let last = self.asked.as_ref().map(|asked| asked.question.answers.len() - 1);
        last.into_iter().for_each(|last| self.answered(last));
    }
}

#[cfg(test)]
mod tests {
    use super::question;

    #[test]
    fn what_is_few_or_fast_comes_at_once_and_what_makes_a_scene_slow_is_asked_about() {
        assert_eq!(question(30, (1_000_000, false), (1.0, 0.1)), None, "30 µs more of a second");
        // Few points that cost much: as many again as take 15 ms a frame.
        let words = question(600, (600, false), (0.015, 1.0)).unwrap_or_default();
        assert!(words.ends_with("about 56 % of its speed, 30 ms of work a frame."), "{words}");
        assert_eq!(question(100, (600, false), (0.015, 1.0)), None, "17.5 ms");
        assert!(question(100, (100, false), (0.015, 1.0)).is_some(), "a hundred that cost as much");
        assert_eq!(
            question(150, (600, false), (0.040, 1.0)).map(|words| words.starts_with("150 points more, 750 in all")),
            Some(true)
        );
        assert_eq!(question(4_000, (0, false), (0.0, 0.0)), None, "12 ms a frame");
        let words = question(16_000, (0, false), (0.0, 0.0)).unwrap_or_default();
        assert_eq!(words, "16,000 points more, 16,000 in all: about 35 % of its speed, 48 ms of work a frame.");
        // Ten thousand that take 10 ms leave room for a few more.
        assert_eq!(question(5_000, (10_000, false), (0.010, 1.0)), None);
        let words = question(40_000, (10_000, false), (0.010, 1.0)).unwrap_or_default();
        assert!(words.ends_with("about 33 % of its speed, 50 ms of work a frame."), "{words}");
        // What sleeps costs nothing, and what comes is awake.
        assert!(question(250_000, (10_000, false), (1e-5, 1.0)).is_some());
        assert_eq!(question(20_000, (10_000, false), (1e-5, 1.0)), None);
    }

    #[test]
    fn what_meets_is_dearer_than_what_hangs_alone() {
        // A net of ten thousand points takes 4 ms by itself.
        assert_eq!(question(10_000, (10_000, false), (0.004, 1.0)), None);
        let words = question(10_000, (10_000, true), (0.004, 1.0)).unwrap_or_default();
        assert!(words.ends_with("about half speed, 34 ms of work a frame."), "{words}");
        assert_eq!(question(24, (24_000, true), (0.015, 1.0)), None, "a rim among a thousand");
    }

    #[test]
    fn a_small_cloth_comes_to_a_small_scene_however_busy_the_machine_is() {
        // 36 points take a tenth of a millisecond at least, and reached half of their speed of late.
        assert_eq!(question(120, (36, false), (1e-4, 0.5)), None);
        assert!(question(120, (36, false), (0.006, 0.5)).is_some(), "they would be told as slow if 6 ms were theirs");
    }

    #[test]
    fn twice_as_many_are_half_as_fast_as_the_bar_says_of_those_that_are_there() {
        // 12 % of the speed at 90 ms of work a frame: pictures take time too.
        let words = question(36_000, (36_000, false), (0.090, 0.12)).unwrap_or_default();
        assert!(words.ends_with("about 6 % of its speed, 180 ms of work a frame."), "{words}");
    }
}
