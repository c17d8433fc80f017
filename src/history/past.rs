//! Looking at the past without going there.

use super::keyframes::Keyframe;
use super::session::History;
use crate::sim::Dynamics;

impl History {
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
