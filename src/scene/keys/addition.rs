//! The keys of what is added to a running world.

use super::body::BodyKeys;
use super::bond::BondKeys;
use super::contact::SkinKeys;
use super::macros::object;
use super::scene::{AngleKeys, PointKeys};
use super::surroundings::{ForceKeys, ObstacleKeys, PinMotionKeys};
use super::vector::Row;

object! {
    /// What comes, in the keys of scenes. Numbers of points under `pinned` of the points, `bonds`, `triangles` and `angles` are those of the world, in
    /// which new points follow the last number.
    #[derive(Default)]
    AddKeys: "what is added: an object with keys such as `points` and `bodies`" {
        optional {
            /// Points, one by one.
            points: PointKeys,
        }
        lists {
            /// Bonds between points of the world, new ones included.
            bonds: BondKeys,
            /// Bodies: their points and bonds follow those above.
            bodies: BodyKeys,
            /// Triangles between points of the world, new ones included.
            triangles: Row<u32, 3>,
            /// What skins are made of, of points of the world, new ones included.
            skins: SkinKeys,
            /// Constant forces and torques on points of the world, new ones included.
            forces: ForceKeys,
            /// Angles between points of the world, new ones included; those that the bending of materials makes follow them.
            angles: AngleKeys,
            /// Obstacles.
            obstacles: ObstacleKeys,
            /// Pins that move; times are those of the scene.
            pin_motion: PinMotionKeys,
            /// Pictures that are drawn on the triangles above, and on those that are there.
            textures: DrawnKeys,
            /// Which of the points above are one body, and how that looks: what bonds and triangles hold together, if not said.
            looks: LookKeys,
        }
    }
}

object! {
    /// Points that are one body, as that which they are a copy of.
    LookKeys: "a look: an object with the key `points`" {
        required {
            /// New points, by their numbers of the world.
            points: Vec<u32>,
        }
        optional {
            /// What the body is called: by what it is made of, if not said.
            title: String,
            /// Which colour of the palette it has, from 0 to 6: the next one, if not said.
            hue: u32,
        }
    }
}

object! {
    /// A picture drawn on the triangles of an addition, and of the world, whose corners are all among its points: in place of what was drawn there.
    DrawnKeys: "a texture: an object with the keys `image`, `points` and `uv`" {
        required {
            /// A relative path, or data:image/png;base64,…
            image: String,
            /// Points, by their numbers of the world.
            points: Vec<u32>,
            /// Where each of them lies in the image, (0, 0) to (1, 1) from the upper left.
            uv: Vec<Row<f64, 2>>,
        }
    }
}
