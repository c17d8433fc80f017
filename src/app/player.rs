//! Plays a world: wall time in, whole fixed substeps out.

use crate::sim::{Command, Dynamics, Positions};

/// Longest wall time that one frame makes up for [s]: after a hitch (a dragged window, a laptop that slept) the rest is
/// dropped, so that nothing is thrown about.
pub const LONGEST_FRAME: f64 = 0.1;
/// Wall time that one frame may spend on stepping [s]: a scene too slow for real time plays slower, at a usable frame
/// rate, instead of falling behind ever more.
pub const STEPPING_BUDGET: f64 = 0.025;
/// What a single step by hand advances [s of wall time at the scene's rate].
pub const SINGLE_STEP: f64 = 1.0 / 60.0;
/// A substep is due when all but this share of it has passed: sums of frame times round.
const ROUNDING: f64 = 1e-9;

/// Positions before the last substep, in the scalar of the world.
#[derive(Clone, Debug)]
enum Previous {
    F32(Vec<f32>),
    F64(Vec<f64>),
}

impl Previous {
    fn of(positions: Positions<'_>) -> Self {
        match positions {
            Positions::F32(x) => Previous::F32(x.to_vec()),
            Positions::F64(x) => Previous::F64(x.to_vec()),
        }
    }

    fn copy(&mut self, positions: Positions<'_>) {
        match (self, positions) {
            (Previous::F32(to), Positions::F32(x)) => to.copy_from_slice(x),
            (Previous::F64(to), Positions::F64(x)) => to.copy_from_slice(x),
            (previous, positions) => *previous = Previous::of(positions),
        }
    }

    fn view(&self) -> Positions<'_> {
        match self {
            Previous::F32(x) => Positions::F32(x),
            Previous::F64(x) => Positions::F64(x),
        }
    }
}

/// A world with a clock, a start to go back to, and the last two states to draw between.
///
/// The physics does not depend on the frame rate: frames only decide how many substeps are due.
pub struct Player {
    world: Box<dyn Dynamics>,
    start: Box<dyn Dynamics>,
    previous: Previous,
    /// Scene time that is due but not stepped yet [s].
    due: f64,
    /// Seconds of the scene a second of wall time.
    rate: f64,
    /// Where the scene ends by itself [s].
    duration: Option<f64>,
    /// Whether it has ended there: from then on it goes on without end.
    ended: bool,
    playing: bool,
    motion: u64,
    topology: u64,
    /// Substeps taken before the last return to the start.
    past_substeps: u64,
    /// How many bonds there were when the topology was last looked at.
    bond_count: usize,
}

impl Player {
    /// Plays `world` from its start at `rate` seconds a second, until `duration` [s] if there is one.
    pub fn new(world: Box<dyn Dynamics>, rate: f64, duration: Option<f64>) -> Self {
        Player {
            start: world.boxed_clone(),
            previous: Previous::of(world.positions()),
            bond_count: world.bonds().len(),
            world,
            due: 0.0,
            rate,
            duration,
            ended: false,
            playing: true,
            motion: 0,
            topology: 0,
            past_substeps: 0,
        }
    }

    /// Lets `wall` seconds pass and takes the substeps that are due; returns how many.
    ///
    /// `elapsed` tells the wall time [s] spent since the frame began: past [`STEPPING_BUDGET`] the rest is dropped.
    pub fn advance(&mut self, wall: f64, mut elapsed: impl FnMut() -> f64) -> u32 {
        if !self.is_moving() {
            return 0;
        }
        self.due += wall.clamp(0.0, LONGEST_FRAME) * self.rate;
        let mut substeps = 0;
        while self.is_due() {
            if substeps > 0 && elapsed() > STEPPING_BUDGET {
                self.settle();
                break;
            }
            self.step_once();
            substeps += 1;
            if self.world.is_asleep() {
                self.settle();
            } else if !self.ended && self.duration.is_some_and(|end| self.world.time() >= end) {
                self.playing = false;
                self.ended = true;
                self.settle();
            }
        }
        substeps
    }

    fn is_due(&self) -> bool {
        self.due >= self.world.substep() * (1.0 - ROUNDING)
    }

    /// One substep. Only the last one of a frame needs the positions before it.
    fn step_once(&mut self) {
        self.due -= self.world.substep();
        if self.due < self.world.substep() {
            self.previous.copy(self.world.positions());
        }
        self.world.step();
        self.motion += 1;
        self.watch_bonds();
    }

    /// Bonds that broke are gone: what is drawn is another topology.
    fn watch_bonds(&mut self) {
        let bond_count = self.world.bonds().len();
        if bond_count != self.bond_count {
            self.bond_count = bond_count;
            self.topology += 1;
        }
    }

    /// Nothing is due any more: what is drawn is the present state.
    fn settle(&mut self) {
        self.due = 0.0;
        self.previous.copy(self.world.positions());
        self.motion += 1;
        self.watch_bonds();
    }

    /// Pauses and goes on by one frame's worth of substeps, at least one.
    pub fn step(&mut self) {
        self.playing = false;
        self.world.wake();
        self.due = 0.0;
        let substeps = (SINGLE_STEP * self.rate / self.world.substep()).round().max(1.0) as u32;
        for _ in 0..substeps {
            self.world.step();
        }
        self.settle();
    }

    /// Back to the start, with the cursor where it is. Playing or paused stays as it is.
    pub fn reset(&mut self) {
        let cursor = self.world.mouse().map(|(_, cursor)| cursor);
        self.past_substeps += self.world.counters().substeps;
        self.world = self.start.boxed_clone();
        let _ = self.world.apply(&Command::Cursor { to: cursor, by: 0.0 });
        self.ended = false;
        self.settle();
    }

    /// Plays if paused, pauses if playing.
    pub fn toggle(&mut self) {
        self.playing = !self.playing;
        self.world.wake();
    }

    /// Applies a command to the world: what it reaches wakes.
    pub fn apply(&mut self, command: Command) {
        let _ = self.world.apply(&command);
    }

    /// Whether time passes: playing and awake.
    pub fn is_moving(&self) -> bool {
        self.playing && !self.world.is_asleep()
    }

    /// Whether it plays, asleep or not.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Whether the world sleeps.
    pub fn is_asleep(&self) -> bool {
        self.world.is_asleep()
    }

    /// Substeps taken since the scene was opened, whatever was returned from.
    pub fn substeps(&self) -> u64 {
        self.past_substeps + self.world.counters().substeps
    }

    /// The world.
    pub fn world(&self) -> &dyn Dynamics {
        &*self.world
    }

    /// Seconds of the scene a second of wall time.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Positions before the last substep, and how far between them and the present ones the picture lies (0 to 1).
    pub fn previous(&self) -> (Positions<'_>, f32) {
        let mix = if self.due > 0.0 { self.due / self.world.substep() } else { 1.0 };
        (self.previous.view(), mix.clamp(0.0, 1.0) as f32)
    }

    /// Changes whenever the positions did.
    pub fn motion(&self) -> u64 {
        self.motion
    }

    /// Changes whenever bonds broke, or came back with the start.
    pub fn topology(&self) -> u64 {
        self.topology
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bounds, Cursor, Method, Model, MouseForce, Profile, Region, Track, build};

    fn model() -> Model<2> {
        Model {
            position: vec![[0.0, 1.0], [0.5, 2.0]],
            velocity: vec![[1.0, 0.0], [0.0, 3.0]],
            mass: vec![1.0, 1.0],
            gravity: [0.0, -9.81],
            bounds: Some(Bounds { min: [-5.0; 2], max: [5.0; 2], restitution: 0.3, friction: 0.4 }),
            mouse: Some(MouseForce {
                strength: 20.0,
                radius: 1.0,
                region: Region::Round,
                profile: Profile::Smooth,
                track: Track::default(),
            }),
            method: Method { substep: Some(1.0 / 700.0), ..Method::default() },
            ..Model::default()
        }
    }

    fn player() -> Player {
        Player::new(build(&model()).unwrap(), 1.0, None)
    }

    /// Plays `seconds` at a frame rate by a clock that is nobody's.
    fn play(player: &mut Player, seconds: f64, frame_rate: u32) -> u64 {
        let frames = (seconds * f64::from(frame_rate)).round() as u32;
        (0..frames).map(|_| u64::from(player.advance(1.0 / f64::from(frame_rate), || 0.0))).sum()
    }

    #[test]
    fn the_motion_is_the_same_at_30_60_and_144_hz() {
        let mut states = Vec::new();
        for frame_rate in [30, 60, 144] {
            let mut player = player();
            assert_eq!(play(&mut player, 2.0, frame_rate), 1400, "{frame_rate} Hz");
            states.push(player.world().sample(player.world().time()));
        }
        assert_eq!(states[0], states[1]);
        assert_eq!(states[0], states[2]);
    }

    #[test]
    fn what_is_drawn_lies_between_the_last_two_states() {
        let mut player = player();
        player.advance(1.5 / 700.0, || 0.0);
        let (previous, mix) = player.previous();
        assert_eq!(previous.get(0), 0.0);
        assert!((mix - 0.5).abs() < 1e-6);
        assert!(player.world().positions().get(0) > 0.0);
    }

    #[test]
    fn a_long_hitch_is_clamped_and_a_slow_world_drops_time() {
        let mut player = player();
        assert_eq!(player.advance(60.0, || 0.0), 70);
        assert_eq!(player.advance(0.1, || 1.0), 1, "the budget is spent after one substep");
        assert_eq!(player.advance(0.0, || 0.0), 0, "and the rest is not owed");
    }

    #[test]
    fn paused_nothing_is_stepped() {
        let mut player = player();
        player.toggle();
        assert_eq!(play(&mut player, 1.0, 60), 0);
        assert_eq!(player.motion(), 0);
        player.step();
        assert_eq!(player.world().counters().substeps, 12, "1/60 s in substeps of 1/700 s");
    }

    #[test]
    fn a_resting_world_sleeps_and_the_cursor_wakes_it() {
        let mut player = player();
        play(&mut player, 20.0, 60);
        assert!(player.is_asleep());
        let asleep = (player.world().counters().substeps, player.motion());
        play(&mut player, 10.0, 60);
        player.apply(Command::Cursor { to: Some(Cursor::at([4.9, 4.9])), by: 0.0 });
        play(&mut player, 10.0, 60);
        assert_eq!((player.world().counters().substeps, player.motion()), asleep, "asleep, and the cursor is far away");
        let at = [player.world().positions().get(0) + 0.1, -4.9];
        player.apply(Command::Cursor { to: Some(Cursor::at(at)), by: 0.0 });
        assert!(play(&mut player, 0.1, 60) > 0);
    }

    #[test]
    fn a_far_cursor_costs_no_mouse_force() {
        let mut player = player();
        player.apply(Command::Cursor { to: Some(Cursor::at([100.0, 100.0])), by: 0.0 });
        play(&mut player, 0.2, 60);
        assert_eq!(player.world().counters().mouse_points, 0);
        player.apply(Command::Cursor { to: Some(Cursor::at([0.0, 1.0])), by: 0.0 });
        play(&mut player, 0.2, 60);
        assert!(player.world().counters().mouse_points > 0);
    }

    #[test]
    fn reset_is_the_start_bit_for_bit() {
        let mut player = player();
        play(&mut player, 1.0, 60);
        let first = player.world().sample(player.world().time());
        let taken = player.substeps();
        player.reset();
        assert_eq!((player.world().time(), player.substeps()), (0.0, taken), "what was done is not forgotten");
        play(&mut player, 1.0, 60);
        assert_eq!(player.world().sample(player.world().time()), first);
    }

    #[test]
    fn a_bond_that_breaks_is_another_topology_and_the_start_brings_it_back() {
        let mut model = model();
        let bond = crate::sim::Bond {
            break_strain: 0.2,
            kind: crate::sim::BondKind::Spring { stiffness: 1.0, damping: 0.0 },
            ..crate::sim::Bond::new(crate::sim::PointId(0), crate::sim::PointId(1), 1.0)
        };
        model.bonds = [bond].into();
        let mut player = Player::new(build(&model).unwrap(), 1.0, None);
        play(&mut player, 0.5, 60);
        assert_eq!((player.world().bonds().len(), player.topology()), (0, 1));
        play(&mut player, 0.5, 60);
        assert_eq!(player.topology(), 1, "nothing else broke");
        player.reset();
        assert_eq!((player.world().bonds().len(), player.topology()), (1, 2));
    }

    #[test]
    fn a_scene_with_a_duration_stops_there_and_can_go_on() {
        let mut player = Player::new(build(&model()).unwrap(), 1.0, Some(0.5));
        assert_eq!(play(&mut player, 1.0, 60), 350);
        assert!(!player.is_playing());
        player.toggle();
        assert_eq!(play(&mut player, 0.5, 60), 350);
    }
}
