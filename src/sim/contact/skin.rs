//! How bodies meet each other, as a model says it.

use super::surface::MOST_FRICTION;
use crate::sim::bond::PointId;

/// Share of the mean edge of a skin, or of the thickness of its body where that is less, that its radius is where nothing is said.
pub(crate) const RADIUS: f64 = 0.05;
/// The most of it in the plane: what is thicker would press its own edges apart.
pub(crate) const MOST_RADIUS: f64 = 0.5;

/// What happens between the skins of bodies: the edges of what their triangles cover, and bonds that belong to no triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// |change of v_t| <= friction |change of v_n| between two skins `[1]`, >= 0; more than 30 is taken as 30.
    pub friction: f64,
    /// v_n -> -restitution v_n on touching `[1]`, from 0 to 1.
    pub restitution: f64,
    /// Distance that a skin keeps from the middle of its edges `[m]`, >= 0; `None`: 0.05 of the mean edge of each skin, in the plane of the
    /// body's hydraulic diameter (four areas by its circumference) where that is less. In the plane at most half of that edge.
    pub radius: Option<f64>,
    /// Bodies meet themselves.
    pub with_itself: bool,
    /// Bodies meet each other.
    pub with_others: bool,
}

impl Contact {
    /// As it is moved: no friction larger than is borne.
    pub(crate) fn borne(self) -> Self {
        Contact { friction: self.friction.min(MOST_FRICTION), ..self }
    }
}

impl Default for Contact {
    fn default() -> Self {
        Contact { friction: 0.5, restitution: 0.0, radius: None, with_itself: true, with_others: true }
    }
}

/// What the skin of a point's body is made of, where it differs from what [`Contact`] says for all.
///
/// Between two skins friction is the root of the product of both, restitution the larger one, the distance the sum of both radii.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SkinMaterial {
    /// `[1]`, >= 0; `None`: that of [`Contact`].
    pub friction: Option<f64>,
    /// `[1]`, from 0 to 1; `None`: that of [`Contact`].
    pub restitution: Option<f64>,
    /// `[m]`, >= 0; `None`: that of [`Contact`].
    pub radius: Option<f64>,
    /// Whether it is of a layer that passes the others of its body, as the limbs of a figure do; `None`: it meets them where bodies meet
    /// themselves.
    pub layered: Option<bool>,
}

impl SkinMaterial {
    /// Whether all is in its range.
    pub(crate) fn is_fine(&self) -> bool {
        let is_size = |x: &f64| *x >= 0.0 && x.is_finite();
        self.friction.iter().chain(&self.radius).all(is_size)
            && self.restitution.is_none_or(|e| (0.0..=1.0).contains(&e))
    }

    /// As it is moved: no friction larger than is borne.
    pub(crate) fn borne(self) -> Self {
        SkinMaterial { friction: self.friction.map(|friction| friction.min(MOST_FRICTION)), ..self }
    }

    /// Whether it passes what else of its body does.
    pub(crate) fn is_layer(&self) -> bool {
        self.layered == Some(true)
    }

    /// This, with what another one says in place of it.
    pub(crate) fn overlaid(self, other: SkinMaterial) -> Self {
        SkinMaterial {
            friction: other.friction.or(self.friction),
            restitution: other.restitution.or(self.restitution),
            radius: other.radius.or(self.radius),
            layered: other.layered.or(self.layered),
        }
    }
}

/// The materials of skins by their points; nothing is listed where all are as [`Contact`] says.
#[derive(Clone, Debug, Default)]
pub struct SkinMaterials {
    /// Each once; the first is that of nothing said.
    kinds: Vec<SkinMaterial>,
    /// For every point the place of its own among these; empty, or shorter than there are points: the first.
    of_point: Vec<u32>,
}

impl SkinMaterials {
    /// Whether all are as [`Contact`] says.
    pub fn is_empty(&self) -> bool {
        self.of_point.is_empty()
    }

    /// The largest radius that is said `[m]`.
    pub(crate) fn widest(&self) -> Option<f64> {
        self.kinds.iter().filter_map(|kind| kind.radius).reduce(f64::max)
    }

    /// That of a point.
    pub fn of(&self, point: PointId) -> SkinMaterial {
        let kind = self.of_point.get(point.index()).and_then(|&kind| self.kinds.get(kind as usize));
        kind.copied().unwrap_or_default()
    }

    /// Whether points of one body are all of layers that pass each other.
    pub(crate) fn are_layers<const N: usize>(&self, points: [u32; N]) -> bool {
        !self.is_empty() && points.iter().all(|&point| self.of(PointId(point)).is_layer())
    }

    /// Gives it to points.
    pub fn set(&mut self, points: impl IntoIterator<Item = PointId>, material: SkinMaterial) {
        let mut place = None;
        for point in points {
            if self.of(point) == material {
                continue;
            }
            if self.kinds.is_empty() {
                self.kinds.push(SkinMaterial::default());
            }
            let place = *place.get_or_insert_with(|| match self.kinds.iter().position(|kind| *kind == material) {
                Some(place) => place as u32,
                None => {
                    self.kinds.push(material);
                    self.kinds.len() as u32 - 1
                }
            });
            if self.of_point.len() <= point.index() {
                self.of_point.resize(point.index() + 1, 0);
            }
            self.of_point[point.index()] = place;
        }
    }

    /// Those of some points, which are counted anew in this order.
    pub(crate) fn among(&self, points: impl Iterator<Item = PointId>) -> Self {
        let mut own = SkinMaterials::default();
        if !self.is_empty() {
            points.zip(0..).for_each(|(point, place)| own.set([PointId(place)], self.of(point)));
        }
        own
    }

    /// All that differ from nothing said, with their points, ascending, in the order of the first point of each.
    pub fn lists(&self) -> Vec<(SkinMaterial, Vec<u32>)> {
        let mut points: Vec<Vec<u32>> = vec![Vec::new(); self.kinds.len()];
        self.of_point.iter().zip(0..).for_each(|(&kind, point)| points[kind as usize].push(point));
        let mut lists: Vec<(SkinMaterial, Vec<u32>)> = self.kinds.iter().copied().zip(points).collect();
        lists.retain(|(kind, points)| *kind != SkinMaterial::default() && !points.is_empty());
        lists.sort_unstable_by_key(|(_, points)| points.first().copied());
        lists
    }
}

impl PartialEq for SkinMaterials {
    /// Whether all points have the same, however it is listed.
    fn eq(&self, other: &Self) -> bool {
        self.lists() == other.lists()
    }
}
