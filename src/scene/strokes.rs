//! Strokes of pictures: drawn in their ink's colour and as wide as it, and other bodies stay as far off as that.

use super::check;
use super::error::{Fault, Within};
use super::keys::{BodyKeys, MakerName, Material, Meeting, Scene};
use crate::picture::{Coat, Pen};

/// Strokes of one pen in a body.
pub(super) struct Strokes {
    /// Their points, over all copies, counted within the body.
    pub(super) points: Vec<u32>,
    /// How they are drawn where the body does not say it.
    pub(super) coat: Coat,
    /// Half of their width `[m]`.
    pub(super) radius: f64,
}

impl Scene {
    /// The strokes of a body, pen by pen; none of one that is no picture.
    ///
    /// Errors: a picture that is not there or is none.
    pub(super) fn strokes(&self, keys: &BodyKeys) -> Result<Vec<Strokes>, Fault> {
        if keys.make != MakerName::Picture || self.dimensions() != 2 {
            return Ok(Vec::new());
        }
        let cutout = check::cutout(keys, &self.source)?;
        let picture = self.source.picture(keys.file.as_deref().unwrap_or_default()).at("file")?;
        let metre = cutout.height / f64::from(cutout.mesh.picture[1]);
        let (each, copies) = (cutout.mesh.points.len() as u32, check::copies(keys));
        let of = |pen: Pen| {
            let width = metre * pen.width;
            let points = (0..copies).flat_map(|copy| pen.points.iter().map(move |point| copy * each + point)).collect();
            Strokes {
                points,
                coat: Coat { color: Some(pen.color), width: Some(width), visible: None },
                radius: 0.5 * width,
            }
        };
        Ok(cutout.mesh.pens(&picture).into_iter().map(of).collect())
    }

    /// How strokes are drawn, each with its points, where their body says no colour or no width of its own.
    ///
    /// Errors: as of [`Scene::strokes`]; a body whose points cannot be counted.
    pub(super) fn stroke_coats(&self) -> Result<Vec<(Vec<u32>, Coat)>, Fault> {
        let mut first = self.points.as_ref().map_or(0, |points| points.position.len() as u32);
        let mut list = Vec::new();
        for (i, keys) in self.bodies.iter().enumerate() {
            let said = keys.material.as_ref().map(Material::coat).unwrap_or_default();
            for Strokes { points, coat, .. } in self.strokes(keys).item(i).at("bodies")? {
                let coat = Coat {
                    color: coat.color.filter(|_| said.color.is_none()),
                    width: coat.width.filter(|_| said.width.is_none()),
                    visible: None,
                };
                if !coat.is_empty() {
                    list.push((points.into_iter().map(|point| first + point).collect(), coat));
                }
            }
            first += check::count(keys, self).item(i).at("bodies")?;
        }
        Ok(list)
    }

    /// How far strokes keep other bodies off `[m]`, with their points counted within the body, where neither it nor the scene says that.
    ///
    /// Errors: as of [`Scene::strokes`].
    pub(super) fn stroke_radii(&self, keys: &BodyKeys) -> Result<Vec<(f64, Vec<u32>)>, Fault> {
        let is_said = keys.material.as_ref().is_some_and(|material| material.radius.is_some());
        let of_scene = self.contact.and_then(Meeting::resolve).and_then(|contact| contact.radius);
        if is_said || of_scene.is_some() {
            return Ok(Vec::new());
        }
        Ok(self.strokes(keys)?.into_iter().map(|strokes| (strokes.radius, strokes.points)).collect())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::picture::{Picture, Settings, Size, Tint, Watch};
    use crate::scene::{Matter, Vector};
    use crate::sim::PointId;

    /// A red line of 6 px by 160 px on white, 2 m the picture's height of 200 px.
    fn drawn() -> Scene {
        let mut picture = Picture::filled(100, 200, [255; 4]);
        for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
            if (47..53).contains(&(i % 100)) && (20..180).contains(&(i / 100)) {
                pixel[..3].copy_from_slice(&[200, 40, 40]);
            }
        }
        let settings = Settings { size: Size::Spacing(16.0), ..Settings::default() };
        let keys = BodyKeys::cut(&settings, 2.0, &picture);
        Scene::of_drawing("line", Arc::new(picture), keys, Matter::Soft, &Watch::default()).unwrap()
    }

    #[test]
    fn a_stroke_is_as_wide_as_its_ink_in_its_colour_and_keeps_others_off_by_half_of_that() {
        let scene = drawn();
        let (tints, world) = (scene.tints().unwrap(), scene.world(None).unwrap());
        let of = |point: u32| Tint::of(&tints, point).copied().unwrap();
        for point in 0..world.point_count() as u32 {
            let Tint { color, width, .. } = of(point);
            assert!((width - 0.06).abs() < 0.006, "{width}");
            assert!(color.is_some_and(|[red, green, _]| red > green + 100), "{color:?}");
            assert_eq!(world.skin_of(PointId(point)).radius, Some(0.5 * width));
        }
    }

    #[test]
    fn what_a_body_or_a_scene_says_of_itself_holds_for_its_strokes() {
        let mut scene = drawn();
        scene.bodies[0].material.as_mut().unwrap().width = Some(0.01);
        scene.bodies[0].material.as_mut().unwrap().radius = Some(0.002);
        let (tints, world) = (scene.tints().unwrap(), scene.world(None).unwrap());
        let tint = Tint::of(&tints, 3).unwrap();
        assert!(tint.width == 0.01 && tint.color.is_some());
        assert_eq!(world.skin_of(PointId(3)).radius, Some(0.002));
    }

    #[test]
    fn each_copy_has_the_strokes_of_its_body_and_listed_points_have_the_same() {
        let mut scene = drawn();
        let each = scene.world(None).unwrap().point_count() as u32;
        scene.bodies[0].origin = Some(Vector::Plane([0.0, 0.0]));
        scene.bodies.push(BodyKeys { origin: Some(Vector::Plane([1.0, 0.0])), ..scene.bodies[0].clone() });
        let listed = scene.expanded().unwrap();
        for scene in [&scene, &listed] {
            let (tints, world) = (scene.tints().unwrap(), scene.world(None).unwrap());
            let [first, second] = [3, each + 3].map(|point| *Tint::of(&tints, point).unwrap());
            assert!(first.width > 0.0 && (first.color, first.width) == (second.color, second.width));
            assert_eq!(world.skin_of(PointId(each + 3)).radius, Some(0.5 * first.width));
        }
    }
}
