//! What is drawn on triangles: the texture of a scene, and the pictures that its bodies are made of.

use super::check;
use super::error::{Fault, SceneError, Within};
use super::keys::{BodyKeys, MakerName, Row, Scene, TextureKeys};
use super::pictures::inline_picture;
use super::start::make;
use crate::picture::{Atlas, Picture, Skin};

impl Scene {
    /// The skins of its triangles: that of the scene's texture, then one for each body of a picture.
    ///
    /// Errors: a picture that is not there or is none.
    pub fn skins(&self) -> Result<Vec<Skin>, SceneError> {
        self.all_skins().map_err(|fault| self.source.error(fault))
    }

    pub(super) fn all_skins(&self) -> Result<Vec<Skin>, Fault> {
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
        if keys.make != MakerName::Picture {
            return Ok(None);
        }
        let body = make(keys, self)?;
        let (each, copies) = (body.positions.len() as u32, check::copies(keys));
        let of_copy = |copy: u32| {
            let first = first + copy * each;
            body.triangles.iter().map(move |corners| corners.map(|corner| first + corner))
        };
        Ok(Some(Skin {
            picture: check::skin(keys, &self.source)?,
            first,
            triangles: (0..copies).flat_map(of_copy).collect(),
            texture: (0..copies).flat_map(|_| body.texture.iter().copied()).collect(),
        }))
    }

    /// Gives `expanded`, this scene without bodies, the triangles of its bodies, and what is drawn on all of them: a scene has one
    /// texture, so several pictures become one, side by side.
    pub(super) fn dress(&self, expanded: &mut Scene) -> Result<(), Fault> {
        let Some(keys) = self.bodies.iter().find(|keys| keys.make == MakerName::Picture) else { return Ok(()) };
        let skins = self.all_skins()?;
        let mut pictures: Vec<&Picture> = Vec::new();
        for skin in &skins {
            if !pictures.contains(&&*skin.picture) {
                pictures.push(&skin.picture);
            }
        }
        let atlas = Atlas::new(&pictures);
        let count = expanded.points.as_ref().map_or(0, |points| points.position.len());
        let mut uv = vec![Row([0.0; 2]); count];
        let has_own = self.texture.is_some() && !self.triangles.is_empty();
        for (k, skin) in skins.iter().enumerate() {
            let number = pictures.iter().position(|&picture| *picture == *skin.picture).unwrap_or(0);
            for (at, to) in skin.texture.iter().zip(uv.iter_mut().skip(skin.first as usize)) {
                *to = Row(atlas.place(number, *at));
            }
            // The scene's own triangles are there already.
            if !(has_own && k == 0) {
                expanded.triangles.extend(skin.triangles.iter().map(|&corners| Row(corners)));
            }
        }
        let file = keys.file.as_deref().unwrap_or_default();
        let image = match pictures[..] {
            // A file that is drawn as it is need not be in the scene.
            [one] if *one == *self.source.picture(file)? => file.to_owned(),
            _ => inline_picture(&atlas.picture)?,
        };
        expanded.texture = Some(TextureKeys { image, uv });
        Ok(())
    }
}
