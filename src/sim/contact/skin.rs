//! How bodies meet each other, as a model says it.

/// What happens between the skins of bodies: the edges of what their triangles cover, and bonds that belong to no triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// |change of v_t| <= friction |change of v_n| between two skins [1], >= 0.
    pub friction: f64,
    /// v_n -> -restitution v_n on touching [1], from 0 to 1.
    pub restitution: f64,
    /// Distance that a skin keeps from the middle of its edges [m], >= 0; `None`: 0.05 of the mean edge of each skin.
    pub radius: Option<f64>,
    /// Bodies meet themselves.
    pub with_itself: bool,
    /// Bodies meet each other.
    pub with_others: bool,
}

impl Default for Contact {
    fn default() -> Self {
        Contact { friction: 0.5, restitution: 0.0, radius: None, with_itself: true, with_others: true }
    }
}
