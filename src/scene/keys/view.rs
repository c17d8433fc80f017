//! The keys of the view.

use super::macros::object;
use super::vector::Vector;

object! {
    /// What a picture shows at first: in the plane `center`, `height`, `width` and what it goes along with, in space the other four.
    #[derive(Default)]
    ViewKeys: "a view: an object with the keys `center` and `height`, in space `target` and `distance`" {
        optional {
            /// Plane: the middle of the picture `[m]`.
            center: Vector,
            /// Plane: from the lower edge to the upper `[m]`, > 0.
            height: f64,
            /// Plane: from the left edge to the right at least `[m]`, > 0, where that takes a higher picture: what points and walls there take if not said.
            width: f64,
            /// Plane: points whose middle the picture goes along with, as far as it leaves the middle of that; at least one.
            follow: Vec<u32>,
            /// Space: what the camera looks at `[m]`.
            target: Vector,
            /// Space: of the camera from its target `[m]`, > 0.
            distance: f64,
            /// Space: about the vertical `[rad]`, 0 if not said.
            yaw: f64,
            /// Space: above the horizontal `[rad]`, 0 if not said.
            pitch: f64,
        }
    }
}
