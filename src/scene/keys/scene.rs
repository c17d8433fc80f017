//! The keys of the whole file.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Unexpected, Visitor};
use serde::ser::{Serialize, Serializer};

use super::beside::BesideKeys;
use super::body::BodyKeys;
use super::bonds::BondList;
use super::contact::{Meeting, SkinKeys};
use super::drive::DriveKeys;
use super::macros::{names, object};
use super::method::MethodKeys;
use super::surroundings::{BoundsKeys, ForceKeys, MouseKeys, ObstacleKeys, PinMotionKeys, WindKeys};
use super::vector::{Row, Vector};
use super::view::ViewKeys;
use crate::scene::error::Source;

/// The version of the file's form: always 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Version;

impl<'de> Deserialize<'de> for Version {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        match u64::deserialize(from)? {
            1 => Ok(Version),
            other => Err(Error::invalid_value(Unexpected::Unsigned(other), &"1")),
        }
    }
}

impl Serialize for Version {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_u32(1)
    }
}

impl JsonSchema for Version {
    fn schema_name() -> Cow<'static, str> {
        "Version".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "const": 1 })
    }
}

/// One mass for all points, or one each `[kg]`.
#[derive(Clone, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
#[serde(untagged)]
pub enum MassKeys {
    /// The same for all.
    Same(f64),
    /// One a point.
    Each(Vec<f64>),
}

impl<'de> Deserialize<'de> for MassKeys {
    // Not derived: an untagged enum keeps a copy of all numbers and loses the place of a wrong one.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Masses;

        impl<'de> Visitor<'de> for Masses {
            type Value = MassKeys;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or a list of one number a point")
            }

            fn visit_f64<E>(self, mass: f64) -> Result<MassKeys, E> {
                Ok(MassKeys::Same(mass))
            }

            fn visit_u64<E>(self, mass: u64) -> Result<MassKeys, E> {
                Ok(MassKeys::Same(mass as f64))
            }

            fn visit_i64<E>(self, mass: i64) -> Result<MassKeys, E> {
                Ok(MassKeys::Same(mass as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<MassKeys, A::Error> {
                let mut masses = Vec::new();
                while let Some(mass) = list.next_element()? {
                    masses.push(mass);
                }
                Ok(MassKeys::Each(masses))
            }
        }

        from.deserialize_any(Masses)
    }
}

object! {
    /// Points, one by one.
    PointKeys: "points: an object with the key `position`" {
        required {
            /// Positions at the start `[m]`.
            position: Vec<Vector>,
        }
        optional {
            /// Velocities at the start `[m/s]`: 0 if not said.
            velocity: Vec<Vector>,
            /// Masses `[kg]`, > 0: 1 if not said.
            mass: MassKeys,
        }
        lists {
            /// Points that never move, by their index in `position`.
            pinned: u32,
        }
    }
}

names! {
    /// How areas resist.
    AreaKindName: "a kind of area" {
        /// The area stays.
        Rigid = "rigid",
        /// A force.
        Spring = "spring",
    }
}

object! {
    /// How the triangles resist a change of their area, in the plane.
    #[derive(Default, Copy)]
    AreaKeys: "areas: an object with keys such as `kind` and `least`" {
        optional {
            /// How they resist; not at all if neither this nor `stiffness` is said.
            kind: AreaKindName,
            /// Of springs `[N/m]`, >= 0: the energy is stiffness (A - A0)^2/(2 A0), A signed.
            stiffness: f64,
            /// With `contact`: the share of its area that a triangle keeps in any case `[1]`, from 0 to below 1; 0.3 if not said.
            least: f64,
        }
    }
}

object! {
    /// An angle that resists, in the plane: bending, or the limits of a joint.
    AngleKeys: "an angle: an object with the key `points`" {
        required {
            /// Points i, j, k: the angle at j, from the arm to i to the arm to k, anticlockwise.
            points: Row<u32, 3>,
        }
        optional {
            /// Where it is at rest `[rad]`, between 0 and 2 pi: the angle at the start if not said.
            rest: f64,
            /// `[N m]`, >= 0: 0 if not said.
            stiffness: f64,
            /// `[N m s]`, >= 0: 0 if not said.
            damping: f64,
            /// The least angle of a joint `[rad]`; together with `max`.
            min: f64,
            /// The largest angle of a joint `[rad]`, less than a turn above `min`.
            max: f64,
            /// What moves it: a motor, or a servo.
            drive: DriveKeys,
        }
    }
}

object! {
    /// A picture drawn on the triangles, but for those with a corner at [-1, -1] in it.
    TextureKeys: "a texture: an object with the keys `image` and `uv`" {
        required {
            /// A relative path, or data:image/png;base64,…
            image: String,
            /// Where each point lies in the image.
            uv: Vec<Row<f64, 2>>,
        }
    }
}

object! {
    /// A number of the scene that a slider sets while it runs.
    ParameterKeys: "a parameter: an object with the keys `path`, `min` and `max`" {
        required {
            /// Where it stands in the file, such as `gravity[1]`, `bounds.friction` or `bonds[0-3].stiffness`.
            path: String,
            /// The left end of the slider.
            min: f64,
            /// The right end, above `min`.
            max: f64,
        }
        optional {
            /// What it is called: its path if not said.
            label: String,
            /// Its unit, as it is shown.
            unit: String,
        }
    }
}

object! {
    /// A few words that stand in the world.
    LabelKeys: "a label: an object with the keys `at` and `text`" {
        required {
            /// The middle of their lower edge `[m]`: with `point` as seen from there.
            at: Vector,
            /// The words, 200 characters at most.
            text: String,
        }
        optional {
            /// The point that they go along with.
            point: u32,
        }
    }
}

object! {
    /// Points that are selected as one in the window.
    PointGroupKeys: "a group: an object with the key `points`" {
        required {
            /// Its points, counted over the scene: two or more.
            points: Vec<u32>,
        }
        optional {
            /// What it is called, other than the other groups: "group 1", "group 2" … if not said.
            title: String,
        }
    }
}

object! {
    /// A scene: a start, what acts on it, and how it is computed. Loaded again it runs bit for bit as it did.
    ///
    /// Fields are the keys of the file, as said there; methods such as [`Scene::rate`] fill in what is not said.
    #[derive(Default)]
    Scene: "a scene: an object with the key `wobble`" {
        required {
            /// Version of the file's form.
            wobble: Version,
        }
        optional {
            /// Its name; [`Scene::name`] falls back on the file's.
            name: String,
        }
        lists {
            /// Words to find it by.
            tags: String,
        }
        optional {
            /// 2 in the plane, 3 in space: 2 if not said.
            dimensions: u32,
            /// Explicit points.
            points: PointKeys,
        }
        beside {
            /// Explicit bonds.
            #[serde(default, skip_serializing_if = "BondList::is_empty")]
            bonds: BondList,
        }
        optional {}
        lists {
            /// Bodies: their points and bonds follow the explicit ones, body by body.
            bodies: BodyKeys,
            /// Triangles, by the indices of their points. Where they lie on a body, but one of a picture, they stand in place of what it covers
            /// of itself.
            triangles: Row<u32, 3>,
        }
        optional {}
        lists {
            /// What skins are made of, where bodies do not say it.
            skins: SkinKeys,
        }
        optional {
            /// How triangles resist.
            areas: AreaKeys,
        }
        lists {
            /// Angles that resist; those that the bending of materials makes follow them.
            angles: AngleKeys,
            /// Points that are selected as one in the window.
            groups: PointGroupKeys,
            /// Numbers that sliders set while it runs.
            parameters: ParameterKeys,
        }
        optional {
            /// Whether bodies meet, and how: they pass through each other if not said.
            contact: Meeting,
            /// What is drawn on triangles.
            texture: TextureKeys,
        }
        lists {
            /// Constant forces and torques on chosen points.
            forces: ForceKeys,
        }
        optional {
            /// `[m/s^2]`: 0 if not said.
            gravity: Vector,
            /// Rate at which velocities decay `[1/s]`, >= 0: 0 if not said.
            drag_rate: f64,
            /// Moving air.
            wind: WindKeys,
            /// The force around the cursor.
            mouse: MouseKeys,
        }
        lists {
            /// Pins that move.
            pin_motion: PinMotionKeys,
        }
        optional {
            /// A pin that goes where the cursor is, in the window.
            cursor_pin: u32,
            /// A point of `points` that a click of the window beside all bodies puts there, in the plane: its velocity turns and grows with its
            /// place about the origin.
            click_start: u32,
            /// The walls around the world.
            bounds: BoundsKeys,
        }
        lists {
            /// What points cannot enter.
            obstacles: ObstacleKeys,
        }
        optional {
            /// Seconds of the scene in a second of wall time, > 0: 1 if not said.
            rate: f64,
            /// When the motion ends `[s]`, >= 0: never if not said.
            duration: f64,
        }
        lists {
            /// Times to report `[s]`, ascending: the duration if not said.
            samples: f64,
        }
        optional {
            /// What a picture shows at first: everything if not said.
            view: ViewKeys,
        }
        lists {
            /// Words that stand in the world, 100 labels at most.
            labels: LabelKeys,
        }
        beside {
            /// How the motion is computed; a call may set these over the file's.
            #[serde(default, skip_serializing_if = "MethodKeys::is_empty")]
            method: MethodKeys,
            /// The same start by other methods, drawn beside it.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            beside: Vec<BesideKeys>,
            /// Where it came from: no part of what it is.
            #[serde(skip)]
            source: Source,
        }
    }
}
