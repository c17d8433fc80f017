//! What a picture shows: a borrowed view of a world at one moment.

use super::trails::Trails;
use crate::picture::{Skin, Tint};
use crate::sim::{Bonds, Convex, Cursor, Dynamics, MouseForce, PointId, Polygon, Positions};

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
    /// What is drawn on triangles. A world of other skins is another topology.
    pub skins: &'a [Skin],
    /// What bodies cover, by their points: filled where no skin is.
    pub triangles: &'a [[PointId; 3]],
    /// Which body points belong to; none: what hangs together is one.
    pub tints: &'a [Tint],
    /// What points are coloured by, one each, where the look shows a difference `[m]`: below 0, or no number, it has none.
    pub values: Option<&'a [f32]>,
    /// Where points have been, if that is shown.
    pub trails: Option<&'a Trails>,
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
}

impl<'a> View<'a> {
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
            skins: &[],
            triangles: world.triangles(),
            tints: &[],
            values: None,
            trails: None,
            pinned: world.pinned(),
            bounds: world.bounds(),
            planes: world.planes(),
            polygons: world.polygons(),
            convex: world.convex(),
            mouse: world.mouse(),
        }
    }
}
