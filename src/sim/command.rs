//! What can be done to a running world, between two of its steps.
//!
//! A world changes by steps and by these alone: a list of them with their times replays a session without a window.
//! Numbers of points, bonds, obstacles and forces are those of the world: the next one is one above the highest that was ever given,
//! and what is deleted leaves a gap.

use std::ops::Range;

use super::bond::{Bond, BondId, Limit, PointId};
use super::contact::convex::Convex;
use super::contact::penalty::Penalty;
use super::contact::polygon::Polygon;
use super::contact::skin::{Contact, SkinMaterial};
use super::drive::{AngleDrive, Drive, Key};
use super::force::angle::Angle;
use super::force::area::Areas;
use super::force::mouse::{Cursor, Profile, Region};
use super::force::steady::Force;
use super::force::wind::Wind;
use super::model::{Method, ModelError};

/// One action on a world. Places have three components, z = 0 in the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// The live cursor goes along a straight line from where it is to `to`, from now to `by`; where there was none it is at `to` at
    /// once. `None`: it leaves. A mouse force with a track of its own ignores it.
    Cursor {
        /// Where it goes.
        to: Option<Cursor>,
        /// When it is there `[s]`, not before now.
        by: f64,
    },
    /// The mouse force changes. A world without one gets it from strength and radius.
    Mouse(MouseChange),
    /// A spring leads the middle of points to the cursor.
    Grab(Reach),
    /// What was grabbed keeps the velocity that it has.
    Release,
    /// A key that drives may have goes down or up.
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
    /// Bonds that a stroke crosses go: in the plane those that a stretch from one place to another does, in space those that lie across
    /// what is between two rays, which begin at one place or are parallel.
    Cut {
        /// Where it begins.
        from: Cursor,
        /// Where it ends.
        to: Cursor,
    },
    /// Points are doubled: their copies have half of their mass, the place and the speed that they have, and take bonds from them; triangles
    /// along these go with the copies, and bonds along the slit are there on both sides of it.
    Split {
        /// Which, no pins.
        points: Vec<PointId>,
        /// Bonds that go to the copies, each with an end among the points.
        bonds: Vec<BondId>,
    },
    /// Points, bonds, obstacles and forces come.
    Add(Box<Addition>),
    /// Points with all that hangs on them, bonds, obstacles, forces go.
    Delete(Selection),
    /// All points, bonds and obstacles go.
    Clear,
    /// Points and obstacles change their place.
    Move(Motion),
    /// Something gets other numbers, from now on.
    Set(Change),
}

/// What of the mouse force changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MouseChange {
    /// Strength `[1/s^2]`, positive repels.
    pub strength: Option<f64>,
    /// Radius `[m]`, > 0.
    pub radius: Option<f64>,
    /// Shape of the region.
    pub region: Option<Region>,
    /// How the force falls off.
    pub profile: Option<Profile>,
    /// Its own track ends: it goes with the live cursor.
    pub ends_track: bool,
}

/// Which points a grab takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Reach {
    /// These.
    Points(Vec<PointId>),
    /// All that are no further from the cursor (in space: from its ray) `[m]`, > 0.
    Within(f64),
    /// A patch of what tears.
    Patch {
        /// Its points.
        points: Vec<PointId>,
        /// A cursor that is no farther from their middle leads them by less than tears them off; one twice as far pulls as hard as it can
        /// `[m]`, > 0.
        torn_beyond: f64,
    },
}

/// A track: (t `[s]`, place `[m]`), times ascending.
pub type Knots = Vec<(f64, [f64; 3])>;

/// What comes: points follow the last number that was given, in this order, and so do bonds and obstacles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Addition {
    /// Positions `[m]`.
    pub position: Vec<[f64; 3]>,
    /// Velocities `[m/s]`, one a point.
    pub velocity: Vec<[f64; 3]>,
    /// Masses `[kg]`, > 0, one a point.
    pub mass: Vec<f64>,
    /// Points of the world, new ones included, that are held from now on.
    pub pinned: Vec<PointId>,
    /// Bonds between points of the world, new ones included.
    pub bonds: Vec<Bond>,
    /// Obstacles, in order.
    pub obstacles: Vec<Obstacle>,
    /// Pinned points that are led along tracks.
    pub pin_motion: Vec<(PointId, Knots)>,
    /// What is covered from now on, between points of the world, new ones included: corners that differ, anticlockwise.
    pub triangles: Vec<[PointId; 3]>,
    /// Constant forces and torques on points of the world, new ones included.
    pub forces: Vec<Force<3>>,
    /// What skins of points of the world, new ones included, are made of from now on.
    pub skins: Vec<(SkinMaterial, Vec<PointId>)>,
    /// Angles between points of the world, new ones included, which get the next numbers.
    pub angles: Vec<Angle>,
}

/// An obstacle, as commands name it.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// A plane.
    Plane {
        /// Any point of it `[m]`.
        point: [f64; 3],
        /// Its normal, of any length above 0, towards the free side.
        normal: [f64; 3],
        /// Restitution `[1]`, >= 0.
        restitution: f64,
        /// Friction `[1]`, >= 0.
        friction: f64,
        /// A force by depth in place of contact.
        penalty: Option<Penalty>,
    },
    /// A polygon, in the plane.
    Polygon(Polygon),
    /// A ball or a box, in space.
    Convex(Convex),
}

/// Some points, bonds, obstacles and forces by their numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Points.
    pub points: Vec<PointId>,
    /// Bonds.
    pub bonds: Vec<BondId>,
    /// Obstacles.
    pub obstacles: Vec<u32>,
    /// Constant forces.
    pub forces: Vec<u32>,
    /// Angles.
    pub angles: Vec<u32>,
}

/// Places change: scaled and turned about a place, then moved. Velocities turn and do not scale; rest lengths of bonds with both ends moved
/// scale as the bonds do, angles at rest turn as their arms do; masses and stiffness stay. A factor below 0 mirrors, velocities and what drives
/// angles too.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Points.
    pub points: Vec<PointId>,
    /// Obstacles.
    pub obstacles: Vec<u32>,
    /// How far `[m]`.
    pub by: [f64; 3],
    /// About the axis, anticlockwise to whoever it points at `[rad]`.
    pub turn: f64,
    /// Of the turn: of any length above 0, in the plane z.
    pub axis: [f64; 3],
    /// Factors along x, y and z `[1]`, before it is turned: not 0, in space > 0 and all the same.
    pub scale: [f64; 3],
    /// About this place `[m]`; `None`: the mean of the points, of the corners of the obstacles where there are none.
    pub about: Option<[f64; 3]>,
    /// The obstacles took so long on the way `[s]`, > 0: what is in their way is pushed ahead, with their speed. `None`: they are put there,
    /// and whole bodies are put beside them.
    pub over: Option<f64>,
}

impl Default for Motion {
    /// Nothing goes anywhere.
    fn default() -> Self {
        Motion {
            points: Vec::new(),
            obstacles: Vec::new(),
            by: [0.0; 3],
            turn: 0.0,
            axis: Motion::UPRIGHT,
            scale: [1.0; 3],
            about: None,
            over: None,
        }
    }
}

impl Motion {
    /// The axis of turns in the plane, and of those that name none.
    pub const UPRIGHT: [f64; 3] = [0.0, 0.0, 1.0];
}

/// One number for all, or one each.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// The same for all that are named.
    Same(f64),
    /// One each, in the order in which they are named.
    Each(Vec<f64>),
}

/// What is set.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Numbers of points.
    Points {
        /// Which.
        points: Vec<PointId>,
        /// Masses `[kg]`, > 0; velocities stay.
        mass: Option<Values>,
        /// Velocities `[m/s]`: one for all, or one each.
        velocity: Option<Vec<[f64; 3]>>,
        /// What their skins are made of, as far as it is said.
        skin: SkinMaterial,
    },
    /// Numbers of bonds.
    Bonds {
        /// Which.
        bonds: Vec<BondId>,
        /// To what.
        to: Box<BondChange>,
    },
    /// Numbers of angles.
    Angles {
        /// Which.
        angles: Vec<u32>,
        /// To what.
        to: Box<AngleChange>,
    },
    /// Numbers of obstacles.
    Obstacles {
        /// Which.
        obstacles: Vec<u32>,
        /// Restitution `[1]`, >= 0.
        restitution: Option<f64>,
        /// Friction `[1]`, >= 0.
        friction: Option<f64>,
        /// Of planes: a force by depth in place of contact, `Some(None)`: contact again.
        penalty: Option<Option<Penalty>>,
    },
    /// Numbers of constant forces.
    Forces {
        /// Which.
        forces: Vec<u32>,
        /// `[N]`
        force: Option<[f64; 3]>,
        /// `[N m]`
        torque: Option<f64>,
    },
    /// Keys of the scene: they touch all islands.
    Scene(Box<SceneChange>),
}

/// What of bonds changes. A number that the kind of a bond has not is refused.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BondChange {
    /// The kind: numbers that it has and that are not set start from those of a new bond of it.
    pub kind: Option<Kind>,
    /// Rest lengths `[m]`, >= 0.
    pub rest_length: Option<Values>,
    /// Stiffness of springs `[N/m]`, >= 0.
    pub stiffness: Option<Values>,
    /// Damping of springs `[N s/m]`, >= 0.
    pub damping: Option<Values>,
    /// Relaxation of relaxed bonds `[1]`, in (0, 1].
    pub relaxation: Option<Values>,
    /// Largest correction of relaxed bonds `[m]`, >= 0.
    pub max_correction: Option<Values>,
    /// Strain at which they break `[1]`, > 0, infinite: never.
    pub break_strain: Option<Values>,
    /// On which side of the rest length they act.
    pub limit: Option<Limit>,
    /// What their rest lengths follow; `Some(None)`: nothing any more.
    pub drive: Option<Option<Drive>>,
    /// Where the waves begin that they follow `[rad]`.
    pub phase: Option<Values>,
}

/// What of angles changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AngleChange {
    /// Where they are at rest `[rad]`, between 0 and 2 pi.
    pub rest: Option<Values>,
    /// `[N m]`, >= 0.
    pub stiffness: Option<Values>,
    /// `[N m s]`, >= 0.
    pub damping: Option<Values>,
    /// The least and the largest angle of joints `[rad]`; `Some(None)`: they turn freely.
    pub range: Option<Option<[f64; 2]>>,
    /// What moves them; `Some(None)`: nothing any more.
    pub drive: Option<Option<AngleDrive>>,
}

/// A kind of bond, without its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// |d| = rest.
    Rigid,
    /// A force.
    Spring,
    /// Defined by sweeps.
    Relaxed,
}

/// Which keys of the scene change.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneChange {
    /// Gravity `[m/s^2]`.
    pub gravity: Option<[f64; 3]>,
    /// Rate at which velocities decay `[1/s]`, >= 0.
    pub drag_rate: Option<f64>,
    /// Air that moves; `Some(None)`: it is still.
    pub wind: Option<Option<Wind<3>>>,
    /// Walls: lower corner, upper corner `[m]`, restitution, friction `[1]`; `Some(None)`: no more.
    pub bounds: Option<Option<BoundsChange>>,
    /// How bodies meet; `Some(None)`: they pass through each other.
    pub contact: Option<Option<Contact>>,
    /// How triangles resist; `Some(None)`: not at all.
    pub areas: Option<Option<Areas>>,
    /// The method, but for the precision and the step of the world, which are fixed when a history begins.
    pub method: Option<Method>,
}

/// Walls around the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundsChange {
    /// Lower corner `[m]`.
    pub min: [f64; 3],
    /// Upper corner `[m]`, above `min` on every axis.
    pub max: [f64; 3],
    /// Restitution `[1]`, >= 0.
    pub restitution: f64,
    /// Friction `[1]`, >= 0.
    pub friction: f64,
}

/// What a command did.
#[derive(Clone, Debug, PartialEq)]
pub struct Applied {
    /// Something changed.
    pub is_something: bool,
    /// Numbers given to new points.
    pub points: Range<u32>,
    /// Numbers given to new bonds.
    pub bonds: Range<u32>,
    /// Numbers given to new obstacles.
    pub obstacles: Range<u32>,
    /// Numbers given to new constant forces.
    pub forces: Range<u32>,
    /// Numbers given to new angles.
    pub angles: Range<u32>,
    /// The share of its way that a motion went, 0 to 1: obstacles that go while time runs stop where what they push has no room.
    pub gone: f64,
    /// What has no room, where they stopped.
    pub jam: Option<Jam>,
}

/// Bodies in the way of obstacles that push them, which give no more way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Jam {
    /// Their points, ascending.
    pub points: Vec<PointId>,
    /// Why they give no more way.
    pub why: NoRoom,
}

/// Why what is pushed gives no more way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoRoom {
    /// Pins hold it.
    Pinned,
    /// It is pressed together, or against what stands, as far as it goes.
    Pressed,
    /// It would be pushed into another body.
    Crowded,
}

impl Default for Applied {
    fn default() -> Self {
        Applied {
            is_something: false,
            points: 0..0,
            bonds: 0..0,
            obstacles: 0..0,
            forces: 0..0,
            angles: 0..0,
            gone: 1.0,
            jam: None,
        }
    }
}

/// A command that cannot be done where it stands: the world is whole, as it was before.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CommandError {
    /// A number that nothing has.
    #[error("there is no {kind} {number}")]
    NoSuch {
        /// "point", "bond", "obstacle" or "force".
        kind: &'static str,
        /// The number.
        number: u32,
    },
    /// A grab of what is a pin, or as taut between pins as rigid bonds are, all of it.
    #[error("what is in reach is held by pins: `unpin` lets one go")]
    Held,
    /// What there would be is nothing that a world can be made of.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A number outside its range, or anything else that the command excludes.
    #[error("{0}")]
    Invalid(String),
}
