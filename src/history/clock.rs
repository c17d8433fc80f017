//! How fast a history is played and where it ends by itself: numbers of the scene that commands change, of which no step knows.

use super::command::{EndOrNone, SetKeys};
use crate::scene::Scene;

/// Seconds of the scene a second of wall time, and its end, as they are now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Seconds of the scene a second of wall time `[1]`, > 0.
    pub rate: f64,
    /// Where it ends by itself `[s]`; `None`: never.
    pub duration: Option<f64>,
}

/// What commands said of a clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Said {
    rate: Option<f64>,
    duration: Option<Option<f64>>,
}

impl Said {
    /// A command sets some of it. Returns whether it says anything of a clock.
    pub(super) fn hear(&mut self, keys: &SetKeys) -> bool {
        self.rate = keys.rate.or(self.rate);
        let duration = keys.duration.as_ref().map(|end| match end {
            EndOrNone::At(end) => Some(*end),
            EndOrNone::None(()) => None,
        });
        self.duration = duration.or(self.duration);
        keys.rate.is_some() || duration.is_some()
    }

    /// The clock of a scene of which this was said.
    pub(super) fn of(self, scene: &Scene) -> Clock {
        Clock { rate: self.rate.unwrap_or_else(|| scene.rate()), duration: self.duration.unwrap_or(scene.duration) }
    }

    /// The scene that begins with this.
    pub(super) fn put(self, scene: &Scene) -> Scene {
        let duration = self.duration.unwrap_or(scene.duration);
        Scene { rate: self.rate.or(scene.rate), duration, ..scene.clone() }
    }
}

/// Errors: in words, numbers of a clock that are none.
pub(super) fn check(keys: &SetKeys) -> Result<(), String> {
    if let Some(rate) = keys.rate.filter(|rate| !(*rate > 0.0 && rate.is_finite())) {
        return Err(format!("rate: is {rate:?}: give seconds of the scene a second of wall time, above 0"));
    }
    match keys.duration {
        Some(EndOrNone::At(end)) if !(end >= 0.0 && end.is_finite()) => {
            Err(format!("duration: is {end:?} s: give a time of at least 0, or null for no end"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::{Do, History};
    use super::*;

    fn history() -> History {
        let text = r#"{"wobble": 1, "rate": 2, "duration": 9, "gravity": [0, -1], "points": {"position": [[0, 0]]}}"#;
        History::new(Scene::parse(text, "x.json").unwrap().into()).unwrap()
    }

    fn set(keys: SetKeys) -> Vec<Do> {
        vec![Do::Set(Box::new(keys))]
    }

    #[test]
    fn rate_and_end_are_set_undone_recorded_and_begun_with() {
        let mut history = history();
        assert_eq!(history.clock(), Clock { rate: 2.0, duration: Some(9.0) });
        history.step();
        history.give(set(SetKeys { rate: Some(0.5), ..SetKeys::default() }), Some("rate")).unwrap();
        let never = SetKeys { duration: Some(EndOrNone::None(())), ..SetKeys::default() };
        history.give(set(never), Some("duration")).unwrap();
        assert_eq!(history.clock(), Clock { rate: 0.5, duration: None });
        // A file has it as it is, and a moment begins with it.
        let mut text = Vec::new();
        history.recording().write_json(&mut text).unwrap();
        let read = super::super::Log::of_text(&String::from_utf8(text).unwrap(), "x.json").unwrap();
        assert_eq!(read.commands().unwrap(), history.recording().commands);
        let moment = History::new(history.snapshot().unwrap().into()).unwrap();
        assert_eq!(moment.clock(), history.clock());
        assert_eq!(history.undo().unwrap().name, "duration");
        assert_eq!(history.clock(), Clock { rate: 0.5, duration: Some(9.0) });
        assert_eq!(history.undo().unwrap().name, "rate");
        assert_eq!(history.clock(), Clock { rate: 2.0, duration: Some(9.0) });
        history.redo().unwrap();
        assert_eq!(history.clock().rate, 0.5);
    }

    #[test]
    fn a_clock_that_is_none_is_refused() {
        for (keys, words) in [
            (SetKeys { rate: Some(0.0), ..SetKeys::default() }, "rate: is 0.0"),
            (SetKeys { duration: Some(EndOrNone::At(-1.0)), ..SetKeys::default() }, "duration: is -1.0 s"),
        ] {
            let mut history = history();
            let refusal = history.give(set(keys), Some("x")).unwrap_err();
            assert!(refusal.reason.to_string().starts_with(words), "{:?}", refusal.reason);
            assert_eq!(history.clock().rate, 2.0);
        }
    }
}
