//! Runs a scene in an engine that lives in this process.

use std::time::Instant;

use super::bodies::{Body, Shape, State};
use super::judge::{Judge, Verdict};
use super::scenes::Scene;
use crate::times::Times;

/// A scene inside an engine.
pub(super) trait World {
    /// Advances by one frame; this alone is timed.
    fn step(&mut self);

    /// How each body is, in the order of the scene.
    fn states(&self) -> Vec<State>;

    /// Whether all bodies sleep.
    fn is_asleep(&self) -> bool;
}

/// What a run cost and how good it was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome {
    /// What a frame took.
    pub(super) times: Times,
    /// What came of it.
    pub(super) verdict: Verdict,
}

/// Steps a fresh world to the end of its scene.
pub(super) fn run(scene: &Scene, bodies: &[Body], shape: Shape, mut world: impl World) -> Outcome {
    let mut judge = Judge::new(scene, bodies, shape);
    let mut seconds = Vec::with_capacity(scene.frames());
    for frame in 1..=scene.frames() {
        let start = Instant::now();
        world.step();
        seconds.push(start.elapsed().as_secs_f64());
        if frame % scene.frames_a_look == 0 {
            judge.look(&world.states(), world.is_asleep());
        }
    }
    Outcome { times: Times::of(seconds), verdict: judge.verdict() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::bodies::{Pose, square};
    use crate::rigid::scenes::all;
    use crate::rigid::vector::turned;
    use crate::rigid::{box2d, rapier};

    /// Squares in place of the scene's bodies, told by their centres.
    fn outcome<W: World>(name: &str, body: Body, make: fn(&Scene, &[Body], Shape) -> W) -> Verdict {
        let scenes = all();
        let scene = scenes.iter().find(|scene| scene.name == name).expect("it is in the list");
        let bodies = [body];
        run(scene, &bodies, scene.shapes[0], make(scene, &bodies, scene.shapes[0])).verdict
    }

    fn is_near_the_truth<W: World>(make: fn(&Scene, &[Body], Shape) -> W) {
        let verdict = outcome("flight", square([0.0, 5.0], [2.0, 3.0], 2.0), make);
        assert!(verdict.error_m.is_some_and(|error| error < 0.3), "{verdict:?}");
        assert!(verdict.error_rad.is_some_and(|error| error < 0.1), "{verdict:?}");
        let verdict = outcome("land", square([0.0, 2.0], [0.0; 2], 0.0), make);
        assert!(verdict.error_m.is_some_and(|error| error < 0.1) && verdict.deepest_m < 0.05, "{verdict:?}");
        assert!(verdict.asleep_after_s.is_some() && verdict.creep_m.is_some_and(|creep| creep < 1e-3), "{verdict:?}");
        let mut body = square([0.0; 2], [0.0; 2], 0.0);
        body.corners.iter_mut().for_each(|corner| *corner = turned(*corner, -0.3));
        body.centre = turned([0.0, 1.0], -0.3);
        let verdict = outcome("slide", body, make);
        assert!(verdict.error_m.is_some_and(|error| error < 0.05), "{verdict:?}");
    }

    #[test]
    fn other_engines_are_near_the_truth() {
        is_near_the_truth(box2d::World::new);
        is_near_the_truth(rapier::World::new);
    }

    /// Stands still: what a judge must find wrong.
    struct Still(Vec<State>);

    impl World for Still {
        fn step(&mut self) {}

        fn states(&self) -> Vec<State> {
            self.0.clone()
        }

        fn is_asleep(&self) -> bool {
            false
        }
    }

    #[test]
    fn what_never_moves_is_found_wrong() {
        let still = |_: &Scene, bodies: &[Body], _: Shape| Still(bodies.iter().map(Body::start).collect());
        let verdict = outcome("flight", square([0.0; 2], [0.0; 2], 1.0), still);
        let fallen = 0.5 * 9.81 * 9.0;
        assert!(verdict.error_m.is_some_and(|error| (error - fallen).abs() < 1e-9), "{verdict:?}");
        assert!(verdict.error_rad.is_some_and(|error| (error - 3.0).abs() < 1e-9), "{verdict:?}");
        let Pose { angle, .. } = square([0.0; 2], [0.0; 2], 1.0).start().pose;
        assert_eq!(angle, 0.0);
    }
}
