//! The keys of what acts on the points from outside: mouse, wind, walls, obstacles, moving pins.

use super::macros::{names, object};
use super::vector::{Row, Vector};
use crate::sim::Penalty;

names! {
    /// Shape of the region that the mouse force acts in.
    RegionName: "a region" {
        /// A square; in the plane only.
        Square = "square",
        /// A disc.
        Round = "round",
    }
}

names! {
    /// How the mouse force falls off.
    ProfileName: "a profile" {
        /// 1 up to the edge.
        Linear = "linear",
        /// Smooth down to 0 at the edge.
        Smooth = "smooth",
    }
}

object! {
    /// The force around the cursor.
    MouseKeys: "a mouse force: an object with the keys `strength` and `radius`" {
        required {
            /// `[1/s^2]`: positive repels.
            strength: f64,
            /// Of the region, half the side of a square one `[m]`, > 0.
            radius: f64,
        }
        optional {
            /// Shape of the region: round if not said.
            region: RegionName,
            /// Fall-off: smooth if not said.
            profile: ProfileName,
        }
        lists {
            /// Where the cursor goes by itself, [t, x, y] with times ascending; the live cursor if not said.
            track: Row<f64, 3>,
        }
    }
}

object! {
    /// Moving air: drag is relative to it, so without `drag_rate` it pushes nothing.
    WindKeys: "a wind: an object with the key `velocity`" {
        required {
            /// Mean velocity `[m/s]`.
            velocity: Vector,
        }
        optional {
            /// Root mean square of the gusts as a share of the mean speed `[1]`, >= 0: 0 if not said.
            turbulence: f64,
            /// Seed of the gusts, 0 if not said.
            seed: u64,
        }
    }
}

object! {
    /// A constant force, a torque, or both, on chosen points. Points are counted over the scene.
    ForceKeys: "a force: an object with the key `points`" {
        required {
            /// The points that it acts on, one or more: pinned ones take none.
            points: Vec<u32>,
        }
        optional {
            /// Shared by mass `[N]`: 0 if not said.
            force: Vector,
            /// About the middle of the points, anticlockwise `[N m]`: 0 if not said. In the plane only.
            torque: f64,
        }
    }
}

object! {
    /// The walls around the world.
    BoundsKeys: "bounds: an object with the keys `min` and `max`" {
        required {
            /// Lower corner `[m]`.
            min: Vector,
            /// Upper corner `[m]`.
            max: Vector,
        }
        optional {
            /// v_n -> -restitution v_n on touching `[1]`, >= 0: 0 if not said.
            restitution: f64,
            /// |change of v_t| <= friction |change of v_n| `[1]`, >= 0: 0 if not said.
            friction: f64,
        }
    }
}

object! {
    /// Something that points cannot enter: exactly one of the shapes.
    #[derive(Default)]
    ObstacleKeys: "an obstacle: an object with one of the keys `plane`, `box`, `circle`, `polygon` and `picture`" {
        optional {
            /// A half-space; the free side is where its normal points.
            plane: PlaneKeys,
            /// A box.
            r#box: BoxKeys,
            /// A circle, in space a ball.
            circle: CircleKeys,
            /// An outline and its holes, even-odd; in the plane only.
            polygon: Vec<Vec<Vector>>,
            /// The ink of a picture; in the plane only.
            picture: PictureKeys,
            /// As of the bounds.
            restitution: f64,
            /// As of the bounds.
            friction: f64,
            /// Of a plane: a force by depth in place of contact.
            penalty: PenaltyKeys,
        }
    }
}

object! {
    /// A force by depth.
    #[derive(Copy)]
    PenaltyKeys: "a penalty: an object with the key `stiffness`" {
        required {
            /// Force over depth `[N/m]`, >= 0.
            stiffness: f64,
        }
        optional {
            /// Force over speed along the normal, while it is behind the surface `[N s/m]`, >= 0: 0 if not said.
            damping: f64,
        }
    }
}

impl From<PenaltyKeys> for Penalty {
    fn from(keys: PenaltyKeys) -> Self {
        Penalty { stiffness: keys.stiffness, damping: keys.damping.unwrap_or(0.0) }
    }
}

impl From<Penalty> for PenaltyKeys {
    fn from(Penalty { stiffness, damping }: Penalty) -> Self {
        PenaltyKeys { stiffness, damping: (damping > 0.0).then_some(damping) }
    }
}

object! {
    /// The ink of a picture as polygons. The keys mean what they mean of a body of a picture.
    PictureKeys: "a picture: an object with the key `file`" {
        required {
            /// The bitmap, a path relative to the scene or data:image/png;base64,…
            file: String,
        }
        optional {
            /// Where the middle of the picture lies `[m]`: (0, 0) if not said.
            origin: Vector,
            /// Anticlockwise about it `[rad]`: 0 if not said.
            angle: f64,
            /// Of the whole picture `[m]`, > 0: 2 if not said.
            height: f64,
            /// Distance of corners along smooth outlines `[m]`, > 0: a fortieth of its longer side if not said.
            spacing: f64,
            /// Coverage above which a pixel is solid `[1]`, 0 to 1; where the picture splits best if not said.
            threshold: f64,
            /// Whether light pixels, or clear ones, are solid.
            invert: bool,
            /// In place of `threshold` and `invert`: whether all of it is solid, a rectangle.
            whole: bool,
            /// Specks and holes smaller than this are left out `[px^2]`, 12 if not said.
            min_area: f64,
            /// Over how many pixels it is blurred first, 0 if not said.
            blur: u32,
            /// Whether holes stay holes; they do if not said.
            holes: bool,
        }
    }
}

object! {
    /// A plane.
    PlaneKeys: "a plane: an object with the keys `point` and `normal`" {
        required {
            /// Any point of it `[m]`.
            point: Vector,
            /// Its normal, of any length above 0.
            normal: Vector,
        }
    }
}

object! {
    /// A box, turned about its centre.
    BoxKeys: "a box: an object with the keys `min` and `max`" {
        required {
            /// Lower corner before it is turned `[m]`.
            min: Vector,
            /// Upper corner before it is turned `[m]`.
            max: Vector,
        }
        optional {
            /// In the plane: anticlockwise `[rad]`.
            angle: f64,
            /// In space.
            rotation: RotationKeys,
        }
    }
}

object! {
    /// A rotation in space.
    RotationKeys: "a rotation: an object with the keys `axis` and `angle`" {
        required {
            /// Axis, of any length above 0.
            axis: Vector,
            /// Angle about it `[rad]`.
            angle: f64,
        }
    }
}

object! {
    /// A circle, met as a regular polygon of 2048 corners on it: no further than 2e-6 of its radius inside it. In space a ball.
    CircleKeys: "a circle: an object with the keys `center` and `radius`" {
        required {
            /// Centre `[m]`.
            center: Vector,
            /// Radius `[m]`, > 0.
            radius: f64,
        }
    }
}

object! {
    /// A pinned point that is led along a track.
    PinMotionKeys: "a moving pin: an object with the keys `point` and `track`" {
        required {
            /// Index of a pinned point.
            point: u32,
            /// [t, x, y], in space [t, x, y, z], with times ascending.
            track: Vec<Vec<f64>>,
        }
    }
}
