//! What is drawn on triangles: the texture of a scene, and the pictures that its bodies are made of.

use super::check;
use super::error::{Fault, SceneError, Within};
use super::keys::{BodyKeys, MakerName, Meeting, Row, Scene, TextureKeys};
use super::pictures::inline_picture;
use super::start::{PlacedBody, make};
use crate::picture::{Atlas, Picture, Skin};

/// Where a corner lies in a texture of which its triangles are not drawn.
const NOWHERE: [f64; 2] = [-1.0; 2];

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
            let is_there = |corner: &u32| texture.uv.get(*corner as usize).is_none_or(|uv| uv.0 != NOWHERE);
            let is_drawn = |corners: &[u32; 3]| corners.iter().all(is_there);
            skins.push(Skin {
                picture: self.source.picture(&texture.image).at("image").at("texture")?,
                first: 0,
                triangles: self.triangles.iter().map(|corners| corners.0).filter(is_drawn).collect(),
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

    /// Gives `expanded`, this scene without bodies, the triangles of its bodies as they were made, where bodies meet, resist by area or are drawn on, and
    /// what is drawn on them: a scene has one texture, so several pictures become one, side by side.
    pub(super) fn dress(&self, expanded: &mut Scene, made: &[PlacedBody]) -> Result<(), Fault> {
        let meets = self.contact.and_then(Meeting::resolve).is_some() || self.areas.is_some();
        let count = expanded.points.as_ref().map_or(0, |points| points.position.len());
        let mut is_drawn = vec![false; count];
        let mut draw = |corners: [u32; 3]| corners.into_iter().for_each(|corner| is_drawn[corner as usize] = true);
        if self.texture.is_some() {
            self.triangles.iter().for_each(|corners| draw(corners.0));
        }
        for (keys, body) in self.bodies.iter().zip(made) {
            let is_picture = keys.make == MakerName::Picture;
            if is_picture {
                body.triangles().for_each(&mut draw);
            }
            if meets || is_picture {
                expanded.triangles.extend(body.triangles().map(Row));
            }
        }
        self.paint(expanded)?;
        let has_undrawn = meets || (self.texture.is_none() && !self.triangles.is_empty());
        if let Some(texture) = expanded.texture.as_mut().filter(|_| has_undrawn) {
            let undrawn = texture.uv.iter_mut().zip(is_drawn).filter(|(_, is_drawn)| !is_drawn);
            undrawn.for_each(|(at, _)| *at = Row(NOWHERE));
        }
        Ok(())
    }

    /// Gives `expanded` one texture for all that is drawn, if bodies of pictures are.
    fn paint(&self, expanded: &mut Scene) -> Result<(), Fault> {
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
        for skin in &skins {
            let number = pictures.iter().position(|&picture| *picture == *skin.picture).unwrap_or(0);
            for (at, to) in skin.texture.iter().zip(uv.iter_mut().skip(skin.first as usize)) {
                *to = Row(atlas.place(number, *at));
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
