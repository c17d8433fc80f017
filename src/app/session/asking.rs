//! What would make a scene slow is asked about before it comes.

use std::time::Instant;

use super::Session;
use crate::app::action::Action;
use crate::app::count::grouped;
use crate::app::panels::{Question, short, speed};
use crate::history::Do;
use crate::scene::Scene;

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

/// What an answer does to `T`, by its place.
type Act<T> = Box<dyn FnOnce(&mut T, usize)>;

/// Something that waits for an answer.
pub(super) struct Asked<T = Session> {
    pub(super) question: Question,
    /// Since when it is asked whether the program is left; `None`: something else is asked.
    pub(super) leaving_since: Option<Instant>,
    /// What is done then.
    pub(super) act: Act<T>,
}

impl<T: 'static> Asked<T> {
    /// What is done by the first answer alone.
    fn adding(words: String, act: impl FnOnce(&mut T) + 'static) -> Self {
        let answered = |to: &mut T, answer: usize| {
            if answer == 0 {
                act(to);
            }
        };
        let question = Question { words, answers: ANSWERS };
        Asked { question, leaving_since: None, act: Box::new(answered) }
    }

    /// The place of the answer that a key gives: Enter the first, Esc the last, which does nothing.
    fn place(&self, action: Action) -> Option<usize> {
        match action {
            Action::Finish => Some(0),
            Action::Cancel => self.question.answers.len().checked_sub(1),
            _ => None,
        }
    }

    fn answer(self, to: &mut T, place: usize) {
        (self.act)(to, place);
    }
}

/// Something comes by `act`: at once, or where `words` ask about it once that is answered.
fn come<T: 'static>(to: &mut T, words: Option<String>, act: impl FnOnce(&mut T) + 'static) -> Option<Asked<T>> {
    match words {
        None => {
            act(to);
            None
        }
        Some(words) => Some(Asked::adding(words, act)),
    }
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

/// How many points commands bring into a world of a scene.
pub(super) fn points_of(commands: &[Do], scene: &Scene) -> usize {
    let of = |act: &Do| if let Do::Add(keys) = act { keys.point_count(scene) } else { 0 };
    commands.iter().map(of).sum()
}

impl Session {
    /// So many points come by `act`: at once, or after a question where the scene would be slow.
    pub(super) fn ask_if_full(&mut self, coming: usize, act: impl FnOnce(&mut Session) + 'static) {
        let figures = &self.shown().figures;
        // Not the work of late: what else runs on the machine is a part of that, and would be told as if points cost it.
        let work = figures.cost * figures.points as f64;
        let meets = self.shown().settings.contact.flatten().is_some();
        let words = question(coming, (figures.points, meets), (work, figures.pace));
        if let Some(asked) = come(self, words, act) {
            self.asked = Some(asked);
            self.panels_dirty = true;
        }
        self.dirty = true;
    }

    /// The question was answered, by the place of the answer.
    pub(super) fn answered(&mut self, answer: usize) {
        let Some(asked) = self.asked.take() else { return };
        asked.answer(self, answer);
        self.touch();
    }

    /// By a key.
    pub(super) fn answer_by(&mut self, action: Action) {
        let place = self.asked.as_ref().and_then(|asked| asked.place(action));
        place.into_iter().for_each(|place| self.answered(place));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use winit::keyboard::{Key, NamedKey};

    use super::{come, points_of, question};
    use crate::app::keys::{Held, action};
    use crate::history::{Do, History};
    use crate::scene::Scene;

    /// A body of each maker, and bodies in rows.
    const BODIES: [&str; 11] = [
        r#"{"make": "points", "count": 7, "min": [0, 0], "max": [1, 1]}"#,
        r#"{"make": "random-graph", "count": 9, "bonds": 12, "min": [0, 0], "max": [1, 1]}"#,
        r#"{"make": "rim", "radius": 1, "inner_radius": 0.8, "sectors": 10}"#,
        r#"{"make": "box", "width": 1, "height": 2}"#,
        r#"{"make": "rope", "count": 20, "to": [4, 0]}"#,
        r#"{"make": "cloth", "columns": 6, "rows": 4, "spacing": 0.2}"#,
        r#"{"make": "lattice", "columns": 5, "rows": 3, "spacing": 0.2}"#,
        r#"{"make": "disc", "radius": 1, "spacing": 0.2}"#,
        r#"{"make": "picture", "file": "pictures/gear.png", "height": 2, "spacing": 0.25}"#,
        r#"{"make": "ragdoll"}"#,
        r#"{"make": "disc", "radius": 1, "spacing": 0.3, "repeat": {"count": [2, 3], "step": [3, 3]}}"#,
    ];

    fn empty() -> Scene {
        Scene::parse(r#"{"wobble": 1, "gravity": [0, 0], "points": {"position": [[9, 9]]}}"#, "x.json").unwrap()
    }

    fn add(keys: &str) -> Vec<Do> {
        vec![Do::Add(Box::new(serde_json::from_str(keys).unwrap()))]
    }

    #[test]
    fn as_many_points_are_told_of_before_as_each_maker_makes() {
        let scene = empty();
        for body in BODIES {
            let commands = add(&format!(r#"{{"bodies": [{body}]}}"#));
            let told = points_of(&commands, &scene);
            let mut history = History::new(scene.clone().into()).unwrap();
            let before = history.world().point_count();
            history.give(commands, Some("build")).unwrap();
            assert_eq!(told, history.world().point_count() - before, "{body}");
            assert!(told > 3, "{body}");
        }
    }

    #[test]
    fn points_that_are_listed_count_too_and_bodies_that_cannot_be_do_not() {
        let scene = empty();
        let listed =
            r#"{"points": {"position": [[0, 0], [1, 0]]}, "bodies": [{"make": "rope", "count": 20, "spacing": 0.1}]}"#;
        assert_eq!(points_of(&add(listed), &scene), 22);
        for wrong in [
            r#"{"bodies": [{"make": "cloth", "columns": 6}]}"#,
            r#"{"bodies": [{"make": "box", "width": 1, "height": 1, "repeat": {"count": [4000000000, 4000000000], "step": [2, 2]}}]}"#,
        ] {
            assert_eq!(points_of(&add(wrong), &scene), 0, "the world says what is wrong with it: {wrong}");
        }
        assert_eq!(points_of(&[Do::Release], &scene), 0);
    }

    #[test]
    fn what_is_asked_about_comes_by_enter_and_is_left_by_esc() {
        // What has come.
        type World = Vec<usize>;
        let build = |world: &mut World, coming: usize| {
            let words = question(coming, (0, false), (0.0, 0.0));
            come(world, words, move |world: &mut World| world.push(coming))
        };
        let mut world = World::new();
        assert!(build(&mut world, 40).is_none());
        assert_eq!(world, [40], "what is few comes at once");
        for (key, comes) in [(NamedKey::Enter, true), (NamedKey::Escape, false)] {
            let mut world = World::new();
            let asked = build(&mut world, 16_000).unwrap();
            assert!(world.is_empty(), "nothing comes before it is answered");
            assert!(asked.question.words.starts_with("16,000 points more"));
            let place = |key: NamedKey| asked.place(action(&Key::Named(key), Held::default())?);
            assert_eq!((place(NamedKey::Space), place(NamedKey::Backspace)), (None, None), "other keys say nothing");
            let place = place(key).unwrap();
            asked.answer(&mut world, place);
            assert_eq!(world, if comes { vec![16_000] } else { vec![] }, "{key:?}");
        }
    }

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
