//! Looking at the past without going there.

use super::branch::Spot;
use super::keyframes::Keyframe;
use super::replay::Replay;
use super::session::History;
use super::start::Recording;
use crate::scene::BesideKeys;
use crate::sim::Dynamics;

/// The last of a history, to be run once more elsewhere.
pub struct Reel {
    /// All of it, from its start on.
    pub recording: Recording,
    /// What stands beside it.
    pub beside: Vec<BesideKeys>,
    /// Its world as it was some time ago, which has followed the recording to there.
    pub run: Replay,
    /// When it began, and now `[s]`.
    pub span: [f64; 2],
    /// Seconds of the scene a second of wall time, as it is played by itself.
    pub rate: f64,
}

impl History {
    /// What happened until now, with the world as it was at least so long ago `[s]`, or at the start.
    pub fn reel(&self, back: f64) -> Reel {
        let here = self.spot();
        let spot = Spot { time: (here.time - back).max(self.from()), ..here };
        let frame = self.keyframes.before(&self.tree, spot).map_or(&self.frame, |kept| &kept.frame).clone();
        Reel {
            recording: self.unmarked(),
            beside: self.companions.iter().map(|companion| companion.entry().clone()).collect(),
            run: Replay::of(frame, &self.scene),
            span: [self.from(), here.time],
            rate: self.clock().rate,
        }
    }

    /// Shows worlds of the past of the present branch, ascending in time, from about `from` `[s]` on up to now, which is none of them: the
    /// end of every step, as far back as steps of `work` counted seconds reach; of what was before that the keyframes.
    ///
    /// Steps are taken on a copy, as they were taken then. Costs `work`, and what `see` takes of each.
    pub fn look_back(&self, from: f64, work: f64, mut see: impl FnMut(&dyn Dynamics)) {
        let here = self.spot();
        let kept: Vec<&Keyframe> = self.keyframes.along(&self.tree, here, from);
        let is_near = |kept: &&Keyframe| self.frame.effort.seconds() - kept.frame.effort.seconds() <= work;
        let first = kept.iter().position(is_near);
        let (far, near) = kept.split_at(first.unwrap_or(kept.len()));
        let mut see = |world: &dyn Dynamics| {
            if world.time() < here.time {
                see(world)
            }
        };
        far.iter().for_each(|kept| see(&*kept.frame.world));
        let Some(first) = near.first().filter(|first| first.time < here.time) else { return };
        let mut frame = first.frame.clone();
        see(&*frame.world);
        loop {
            let next = self.tree.entry(here.branch, frame.place).filter(|_| frame.place < here.place);
            match next {
                // What was refused then is refused again.
                Some(entry) if frame.is_due(entry.at) => _ = frame.follow(entry, &self.scene),
                None if !frame.ends_by(here.time) => break,
                next => {
                    frame.step(next.map(|entry| entry.at), &self.scene);
                    see(&*frame.world);
                }
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use crate::history::{Do, Entry, History, Recording, Replay};
    use crate::scene::Scene;
    use crate::sim::PointId;

    #[test]
    fn a_reel_goes_on_past_what_was_refused() {
        let text = r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0, 3]]}}"#;
        let scene = Scene::parse(text, "x.json").unwrap();
        // There is no point of this number.
        let nothing = Do::Group { points: vec![PointId(7)], name: "nothing".to_owned() };
        let commands = vec![Entry { at: 0.5, act: nothing, edit: None, name: None }];
        let recording = Recording { commands: commands.clone(), ..scene.into() };
        let mut strict = Replay::new(&recording, "x.json").unwrap();
        assert!(strict.advance(&commands, 1.0).is_err());
        let mut history = History::new(recording.into()).unwrap();
        while history.world().time() < 1.0 {
            history.step();
        }
        assert_eq!(history.take_refused().len(), 1);
        let mut reel = history.reel(10.0);
        reel.run.advance(&reel.recording.commands, reel.span[1]).unwrap();
        assert!((reel.run.world().time() - history.world().time()).abs() < 1e-9);
        assert_eq!(reel.run.world().positions().get(1), history.world().positions().get(1));
    }
}
