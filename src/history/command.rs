//! Commands as files have them.

use crate::scene::{
    AddKeys, AreaKeys, BoundsKeys, DriveKeys, KindName, LabelKeys, LimitName, Meeting, MethodKeys, PenaltyKeys, Vector,
    WindKeys, object,
};
use crate::sim::{BondId, Cursor, Key, MouseChange, PointId, Reach};

/// A command with its time.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// When it is done `[s]`: at the end of the step that reaches it.
    pub at: f64,
    /// What is done.
    pub act: Do,
    /// Commands of one number are undone as one; `None`: no edit.
    pub edit: Option<u64>,
    /// What they are called then.
    pub name: Option<String>,
}

/// One action on a world, as a file has it: numbers are those of the world, and bodies are still to be made.
#[derive(Clone, Debug, PartialEq)]
pub enum Do {
    /// The live cursor goes along a straight line from where it is to `to`, until `by`; where there was none it is at `to` at
    /// once. `None`: it leaves.
    Cursor {
        /// Where it goes.
        to: Option<Cursor>,
        /// When it is there `[s]`; at once if not said.
        by: Option<f64>,
    },
    /// The mouse force changes.
    Mouse(MouseChange),
    /// A spring leads the middle of points to the cursor.
    Grab(Reach),
    /// What was grabbed keeps the velocity that it has.
    Release,
    /// A key that drives have goes down or up.
    Key {
        /// Which.
        key: Key,
        /// Whether it is held from now on.
        down: bool,
    },
    /// Points are held where they are, at rest.
    Pin(Vec<PointId>),
    /// Points are let go, at rest.
    Unpin(Vec<PointId>),
    /// Bonds that a stroke crosses go: from a place to another; in space what lies across between two rays.
    Cut {
        /// Where it begins.
        from: Cursor,
        /// Where it ends.
        to: Cursor,
    },
    /// Points are doubled, and their copies take bonds from them: see [`Command::Split`](crate::sim::Command::Split).
    Split {
        /// Which.
        points: Vec<PointId>,
        /// Bonds that go to the copies.
        bonds: Vec<BondId>,
    },
    /// Points, bonds, bodies and obstacles come.
    Add(Box<AddKeys>),
    /// Things go, by their numbers, with all that hangs on them.
    Delete(DeleteKeys),
    /// All points, bonds and obstacles go.
    Clear,
    /// Points and obstacles change their place.
    Move(Box<MoveKeys>),
    /// Something gets other numbers, from now on.
    Set(Box<SetKeys>),
    /// Points that are selected and deleted as one; the world doesn't know of it.
    Group {
        /// Which.
        points: Vec<PointId>,
        /// What they are called.
        name: String,
    },
}

object! {
    /// Things by their numbers.
    #[derive(Default)]
    DeleteKeys: "what is deleted: an object with keys such as `points` and `bonds`" {
        optional {}
        lists {
            /// Points.
            points: u32,
            /// Bonds.
            bonds: u32,
            /// Obstacles.
            obstacles: u32,
            /// Constant forces.
            forces: u32,
            /// Angles.
            angles: u32,
        }
    }
}

object! {
    /// What is moved, and how: scaled and turned about a place, then shifted.
    #[derive(Default)]
    MoveKeys: "a move: an object with keys such as `points` and `by`" {
        optional {
            /// How far `[m]`, 0 if not said.
            by: Vector,
            /// Anticlockwise about the axis `[rad]`, 0 if not said.
            turn: f64,
            /// The axis of the turn, of any length above 0, in space: z if not said.
            axis: Vector,
            /// 1 if not said: one factor, > 0, or in the plane two, along x and y, below 0 where it is mirrored.
            scale: Factors,
            /// The place that stays where it is but for `by` `[m]`: the middle of what is moved if not said.
            about: Vector,
            /// How long obstacles took on the way `[s]`, > 0: they push ahead what is in it. If not said, they are put there, and bodies
            /// beside them.
            over: f64,
        }
        lists {
            /// Points.
            points: u32,
            /// Obstacles.
            obstacles: u32,
        }
    }
}

object! {
    /// What is set: numbers of points, bonds, obstacles or forces, or keys of the scene.
    #[derive(Default)]
    SetKeys: "what is set: an object with one of the keys `points`, `bonds`, `obstacles` and `forces`, or keys of the scene" {
        optional {
            /// Points that get other masses or velocities.
            points: Vec<u32>,
            /// Bonds that get other numbers.
            bonds: Vec<u32>,
            /// Obstacles that get others.
            obstacles: Vec<u32>,
            /// Constant forces that get others.
            forces: Vec<u32>,
            /// Angles that get others.
            angles: Vec<u32>,
            /// Over what time masses, or kind, stiffness and damping of bonds get there `[s]`, > 0: loaded springs throw nothing then. If not
            /// said, they are set at once.
            over: f64,
            /// Of points `[kg]`, > 0.
            mass: OneOrEach,
            /// Of points `[m/s]`: one for all or one each.
            velocity: VectorOrEach,
            /// Of bonds.
            kind: KindName,
            /// Of bonds `[m]`, >= 0; of angles `[rad]`, between 0 and 2 pi.
            rest: OneOrEach,
            /// Of springs `[N/m]`, of angles `[N m]`, >= 0.
            stiffness: OneOrEach,
            /// Of springs, in place of the stiffness `[m/N]`, > 0.
            compliance: OneOrEach,
            /// Of springs `[N s/m]`, of angles `[N m s]`, >= 0.
            damping: OneOrEach,
            /// Of angles: the least and the largest of a joint `[rad]`, or none any more.
            range: RangeOrNone,
            /// Of relaxed bonds `[1]`, in (0, 1].
            relaxation: OneOrEach,
            /// Of relaxed bonds `[1]`, > 0.
            max_correction: OneOrEach,
            /// Of bonds `[1]`, > 0.
            break_strain: OneOrEach,
            /// Of bonds.
            limit: LimitName,
            /// Of bonds and angles: what moves them, or nothing any more.
            drive: DriveOrNone,
            /// Of bonds that follow a wave: where it begins `[rad]`, in place of what their drives say.
            phase: OneOrEach,
            /// Of obstacles `[1]`, >= 0; of the skins of points, to 1.
            restitution: f64,
            /// Of obstacles, or of the skins of points `[1]`, >= 0.
            friction: f64,
            /// Of planes among obstacles: a force by depth in place of contact, or contact again.
            penalty: PenaltyOrNone,
            /// Of the skins of points `[m]`, >= 0.
            radius: f64,
            /// Of the skins of points: whether they are of layers that pass each other.
            layered: bool,
            /// Of constant forces `[N]`.
            force: Vector,
            /// Of constant forces `[N m]`.
            torque: f64,
            /// Of the scene `[m/s^2]`.
            gravity: Vector,
            /// Of the scene `[1/s]`, >= 0.
            drag_rate: f64,
            /// Of the scene: air that moves, or rests again.
            wind: Weather,
            /// Of the scene: the walls, or none any more.
            bounds: Walls,
            /// Of the scene: whether bodies meet from now on, and how.
            contact: Meeting,
            /// Of the scene: how triangles resist from now on, or not any more.
            areas: AreasOrNone,
            /// Of the scene, in place of what was said of it before.
            method: MethodKeys,
            /// Of the scene: seconds of it a second of wall time `[1]`, > 0.
            rate: f64,
            /// Of the scene: where it ends by itself `[s]`, >= 0, or no end any more.
            duration: EndOrNone,
            /// Of the scene: the words that stand in the world, in place of those before; an empty list for none.
            labels: Vec<LabelKeys>,
        }
    }
}

/// One number for all, or one each.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a number, or a list of one number each")]
pub enum OneOrEach {
    /// The same for all that are named.
    One(f64),
    /// One each, in the order in which they are named.
    Each(Vec<f64>),
}

impl OneOrEach {
    /// Leaves out what is not to stay; `stays` has one entry each.
    pub fn retain(&mut self, stays: &[bool]) {
        if let OneOrEach::Each(list) = self {
            keep(list, stays);
        }
    }
}

/// Leaves out of a list what is not to stay; `stays` has one entry each.
pub(super) fn keep<T>(list: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    list.retain(|_| stays.next().is_some_and(|stays| *stays));
}

impl SetKeys {
    /// Whether it sets labels of the scene and nothing else.
    pub(super) fn is_of_labels(&self) -> bool {
        let labels = self.labels.clone();
        labels.is_some() && *self == SetKeys { labels, ..SetKeys::default() }
    }

    /// The same for some of the points or bonds that it names: `stays` has one entry each.
    pub fn among(mut self, stays: &[bool]) -> Self {
        [&mut self.points, &mut self.bonds].into_iter().flatten().for_each(|named| keep(named, stays));
        let lists = [
            &mut self.mass,
            &mut self.rest,
            &mut self.stiffness,
            &mut self.compliance,
            &mut self.damping,
            &mut self.relaxation,
            &mut self.max_correction,
            &mut self.break_strain,
            &mut self.phase,
        ];
        lists.into_iter().flatten().for_each(|list| list.retain(stays));
        if let Some(VectorOrEach::Each(list)) = &mut self.velocity {
            keep(list, stays);
        }
        self
    }
}

/// One factor for all directions, or one for x and one for y.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a factor, or a list of two: along x and along y")]
pub enum Factors {
    /// The same along all axes.
    One(f64),
    /// Along x, along y.
    Each([f64; 2]),
}

/// One vector for all, or one each.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a vector, or a list of one vector each")]
pub enum VectorOrEach {
    /// The same for all that are named.
    One(Vector),
    /// One each.
    Each(Vec<Vector>),
}

/// Wind, or none any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a wind: an object with the key `velocity`, or null")]
pub enum Weather {
    /// This, in place of that before.
    This(WindKeys),
    /// No more.
    None(()),
}

/// The least and the largest angle of a joint, or none any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "give a list of the least and the largest angle, or null")]
pub enum RangeOrNone {
    /// These `[rad]`.
    These([f64; 2]),
    /// It turns freely.
    None(()),
}

/// Where a scene ends by itself, or no end any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "give a time, or null")]
pub enum EndOrNone {
    /// There `[s]`.
    At(f64),
    /// It goes on.
    None(()),
}

/// What moves a bond or an angle, or nothing any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a drive: an object with keys such as `amplitude` and `period`, or null")]
pub enum DriveOrNone {
    /// So.
    This(DriveKeys),
    /// No more.
    None(()),
}

/// A force by depth, or none any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "a penalty: an object with the key `stiffness`, or null")]
pub enum PenaltyOrNone {
    /// So.
    This(PenaltyKeys),
    /// No more.
    None(()),
}

/// Areas that resist, or none any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "give an object with keys such as `kind` and `stiffness`, or null")]
pub enum AreasOrNone {
    /// So.
    These(AreaKeys),
    /// No more.
    None(()),
}

/// Walls, or none any more.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(untagged, expecting = "give an object with the keys `min` and `max`, or null")]
pub enum Walls {
    /// These, in place of those before.
    These(BoundsKeys),
    /// No more.
    None(()),
}
