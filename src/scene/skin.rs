//! What is drawn on triangles: the texture of a scene, and the pictures that its bodies are made of.

use super::check;
use super::error::{Fault, SceneError, Within};
use super::keys::{BodyKeys, MakerName, Row, Scene, TextureKeys};
use super::start::make;
use crate::picture::Skin;

impl Scene {
    /// The skins of its triangles: that of the scene's texture, then one for each body of a picture.
    ///
    /// Errors: a picture that is not there or is none.
    pub fn skins(&self) -> Result<Vec<Skin>, SceneError> {
        self.all_skins().map_err(|fault| self.source.error(fault))
    }

    fn all_skins(&self) -> Result<Vec<Skin>, Fault> {
        let mut skins = Vec::new();
        if let Some(texture) = &self.texture
            && !self.triangles.is_empty()
        {
            skins.push(Skin {
                picture: self.source.picture(&texture.image).at("image").at("texture")?,
                first: 0,
                triangles: self.triangles.iter().map(|corners| corners.0).collect(),
                texture: texture.uv.iter().map(|uv| uv.0.map(|x| x as f32)).collect(),
            });
        }
        let mut first = self.points.as_ref().map_or(0, |points| points.position.len() as u32);
        for (i, keys) in self.bodies.iter().enumerate() {
            skins.extend(self.skin(keys, first).item(i).at("bodies")?);
            first += check::count(keys, self).item(i).at("bodies")?;
        }
        Ok(skins)
    }

    /// The skin of a body of a picture, whose points begin at `first`; `None` of any other.
    fn skin(&self, keys: &BodyKeys, first: u32) -> Result<Option<Skin>, Fault> {
        let Some(file) = keys.file.as_ref().filter(|_| keys.make == MakerName::Picture) else { return Ok(None) };
        let body = make(keys, self)?;
        let (each, copies) = (body.positions.len() as u32, check::copies(keys));
        let of_copy = |copy: u32| {
            let first = first + copy * each;
            body.triangles.iter().map(move |corners| corners.map(|corner| first + corner))
        };
        Ok(Some(Skin {
            picture: self.source.picture(file).at("file")?,
            first,
            triangles: (0..copies).flat_map(of_copy).collect(),
            texture: (0..copies).flat_map(|_| body.texture.iter().copied()).collect(),
        }))
    }

    /// Gives `expanded`, this scene without bodies, the triangles of its bodies; and their picture, where all have the same:
    /// a scene has one texture.
    pub(super) fn dress(&self, expanded: &mut Scene) -> Result<(), Fault> {
        let of_pictures = self.bodies.iter().filter(|keys| keys.make == MakerName::Picture);
        let mut files: Vec<&str> = of_pictures.filter_map(|keys| keys.file.as_deref()).collect();
        files.dedup();
        let Some(&file) = files.first().filter(|_| self.texture.is_none()) else { return Ok(()) };
        let count = expanded.points.as_ref().map_or(0, |points| points.position.len());
        let mut uv = vec![Row([0.0; 2]); count];
        let skins = self.all_skins()?;
        for skin in &skins {
            expanded.triangles.extend(skin.triangles.iter().map(|&corners| Row(corners)));
            for (k, at) in skin.texture.iter().enumerate() {
                uv[skin.first as usize + k] = Row(at.map(f64::from));
            }
        }
        if files.len() == 1 {
            expanded.texture = Some(TextureKeys { image: file.to_owned(), uv });
        }
        Ok(())
    }
}
