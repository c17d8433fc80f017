//! What a picture shows: a borrowed view of a world at one moment.

use super::trails::Trails;
use crate::picture::{Skin, Tint};
use crate::sim::{
    Angle, AngleDrive, Bond, Bonds, Convex, Cursor, Dynamics, MouseForce, PointId, Polygon, Positions, Signal,
};

/// A driven angle: the third point turns about the second, as seen from the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// Its points.
    pub points: [PointId; 3],
    /// Which way it turns.
    pub ways: Ways,
}

/// Which way a hinge is turned by what drives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ways {
    /// Anticlockwise.
    Left,
    /// Clockwise.
    Right,
    /// To and fro, or as a key says.
    Both,
}

impl Hinge {
    /// Those of a world, one for each point that something turns about: none where nothing is driven.
    pub fn of(world: &dyn Dynamics) -> Vec<Hinge> {
        let ways =
            |drive: AngleDrive| match drive {
                AngleDrive::Motor { speed, signal, .. } if signal.wave.is_none() && !goes_back(&signal) => {
                    if speed < 0.0 { Ways::Right } else { Ways::Left }
                }
                _ => Ways::Both,
            };
        let hinge = |angle: &Angle| Some(Hinge { points: angle.points, ways: ways(angle.drive?) });
        let mut list: Vec<Hinge> = world.angles().iter().filter_map(hinge).collect();
        list.sort_by_key(|hinge| hinge.points[1]);
        list.dedup_by(|next, first| {
            let is_same = next.points[1] == first.points[1];
            if is_same && next.ways != first.ways {
                first.ways = Ways::Both;
            }
            is_same
        });
        list
    }
}

/// Where a world has joints, ascending: those with stops, and those that lost them and turn freely. What bends or is driven is none, nor what
/// hangs on the background: its stops push against a pin that is no limb.
pub fn joints(world: &dyn Dynamics) -> Vec<PointId> {
    let props = world.props();
    let is_limb = |angle: &Angle| props.binary_search(&angle.points[0]).is_err();
    let turns = |angle: &Angle| angle.range.is_some() || (angle.stiffness == 0.0 && angle.drive.is_none());
    let is_joint = |angle: &&Angle| turns(angle) && is_limb(angle);
    let mut list: Vec<PointId> = world.angles().iter().filter(is_joint).map(|angle| angle.points[1]).collect();
    list.sort_unstable();
    list.dedup();
    list
}

fn goes_back(signal: &Signal) -> bool {
    signal.held.is_some_and(|held| held.back.is_some())
}

/// A borrowed view of a world, between its last two substeps.
#[derive(Clone)]
pub struct View<'a> {
    /// 2 in the plane, 3 in space.
    pub dimensions: usize,
    /// Positions before the last substep.
    pub previous: Positions<'a>,
    /// Positions now.
    pub current: Positions<'a>,
    /// What is drawn lies between the two: 0 = previous, 1 = current.
    pub mix: f32,
    /// Changes whenever `previous` or `current` did: equal numbers mean that nothing has to be uploaded.
    pub motion: u64,
    /// Changes whenever points or bonds came or went.
    pub topology: u64,
    /// The bonds.
    pub bonds: &'a Bonds,
    /// Bonds that tore or were cut: loose threads hang from nets there. Others are another topology.
    pub torn: &'a [Bond],
    /// What is drawn on triangles. A world of other skins is another topology.
    pub skins: &'a [Skin],
    /// What bodies cover, by their points: filled where no skin is.
    pub triangles: &'a [[PointId; 3]],
    /// Which body points belong to; none: what hangs together is one.
    pub tints: &'a [Tint],
    /// What points are coloured by, one each, where the look shows a difference `[m]`: below 0, or no number, it has none.
    pub values: Option<&'a [f32]>,
    /// Where points have been, with the place of the colour of each among those of the look; the first are the world's own, and lie on top.
    pub trails: Vec<(&'a Trails, usize)>,
    /// What points weigh `[kg]`, or nothing where that is not known.
    pub masses: &'a [f64],
    /// The points that never move.
    pub pinned: &'a [PointId],
    /// Corners of the walls (z = 0 in the plane).
    pub bounds: Option<[[f64; 3]; 2]>,
    /// A point of each plane that nothing goes through `[m]`, and the normal that leads away from what is solid (z = 0 in
    /// the plane).
    pub planes: Vec<[[f64; 3]; 2]>,
    /// What else is solid, in the plane. Other obstacles are another topology.
    pub polygons: &'a [Polygon],
    /// Balls and boxes, in space. Others are another topology.
    pub convex: &'a [Convex],
    /// The mouse force and where its cursor is.
    pub mouse: Option<(&'a MouseForce, Cursor)>,
    /// Where motors and servos turn: marked over all else.
    pub hinges: Vec<Hinge>,
    /// Where joints are, ascending: bodies that have some are drawn as figures of limbs.
    pub joints: Vec<PointId>,
    /// What lies over the picture, from the left and from the top to the right and to the bottom `[px]`: numbers of the grid stay clear
    /// of it.
    pub covered: &'a [[f32; 4]],
}

impl<'a> View<'a> {
    /// A world of nothing.
    #[cfg(test)]
    pub(crate) fn empty(bonds: &'a Bonds, dimensions: usize) -> Self {
        View {
            dimensions,
            previous: Positions::F64(&[]),
            current: Positions::F64(&[]),
            mix: 1.0,
            motion: 0,
            topology: 0,
            bonds,
            torn: &[],
            skins: &[],
            triangles: &[],
            tints: &[],
            values: None,
            trails: Vec::new(),
            masses: &[],
            pinned: &[],
            bounds: None,
            planes: Vec::new(),
            polygons: &[],
            convex: &[],
            mouse: None,
            hinges: Vec::new(),
            joints: Vec::new(),
            covered: &[],
        }
    }

    /// The world as it is now; `motion` is 0, `topology` the number of bonds that broke.
    pub fn of(world: &'a dyn Dynamics) -> Self {
        View {
            dimensions: world.dimensions(),
            previous: world.positions(),
            current: world.positions(),
            mix: 1.0,
            motion: 0,
            topology: world.counters().bonds_torn,
            bonds: world.bonds(),
            torn: world.torn(),
            skins: &[],
            triangles: world.triangles(),
            tints: &[],
            values: None,
            trails: Vec::new(),
            masses: world.masses(),
            pinned: world.pinned(),
            bounds: world.bounds(),
            planes: world.planes(),
            polygons: world.polygons(),
            convex: world.convex(),
            mouse: world.mouse(),
            hinges: Hinge::of(world),
            joints: joints(world),
            covered: &[],
        }
    }
}
