//! The mouse force: an acceleration away from the cursor (or towards it) inside a region around it.

/// Strength, reach and shape of the mouse force, the same for every mass.
///
/// Model: a = strength * profile(q) * (x - mouse) inside the region; q = |x - mouse|/radius, in a square region
/// max(|dx|, |dy|)/radius. In space x - mouse is the vector from the cursor's ray to the point.
#[derive(Clone, Debug, PartialEq)]
pub struct MouseForce {
    /// Strength [1/s^2]: positive repels, negative attracts.
    pub strength: f64,
    /// Radius of the region, half the side of a square one [m], > 0.
    pub radius: f64,
    /// Shape of the region.
    pub region: Region,
    /// How the force falls off towards the edge.
    pub profile: Profile,
    /// Where the cursor goes by itself; empty: it is the live cursor.
    pub track: Track,
}

/// Shape of the region that the mouse force acts in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Region {
    /// |x - mouse| < radius.
    #[default]
    Round,
    /// max(|dx|, |dy|) < radius; in the plane only.
    Square,
}

/// How the mouse force falls off towards the edge of its region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Profile {
    /// (1 - q^2)^2: smooth down to zero at the edge.
    #[default]
    Smooth,
    /// 1 up to the edge, where the force jumps to zero.
    Linear,
}

/// A path over time, linear between its knots and held at both ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// (t [s], [x, y] [m]), times ascending.
    pub knots: Vec<(f64, [f64; 2])>,
}

/// Where the cursor points: a ray in space; in the plane its origin is the cursor and z is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cursor {
    /// A point of the ray [m].
    pub origin: [f64; 3],
    /// Unit vector along the ray.
    pub direction: [f64; 3],
}
