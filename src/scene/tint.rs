//! Which body each point of a scene is of, and the colours that bodies say they have.

use super::check;
use super::error::{Fault, SceneError, Within};
use super::keys::{BodyKeys, MakerName, Scene, SkinKeys};
use crate::picture::Tint;

impl Scene {
    /// The runs of points of one body each: explicit points by what bonds and triangles hold together, then body by body, each copy by
    /// itself, with the colours that are said.
    ///
    /// Errors: a body whose points cannot be counted.
    pub fn tints(&self) -> Result<Vec<Tint>, SceneError> {
        self.all_tints().map_err(|fault| self.source.error(fault))
    }

    /// What the bodies of [`Scene::tints`] are called, by their numbers: a picture by its file, others by what makes them. `None`: points
    /// and bonds that are written one by one.
    ///
    /// Errors: as of [`Scene::tints`].
    pub fn body_names(&self) -> Result<Vec<Option<String>>, SceneError> {
        self.all_names().map_err(|fault| self.source.error(fault))
    }

    pub(super) fn all_names(&self) -> Result<Vec<Option<String>>, Fault> {
        let explicit = self.points.as_ref().map_or(0, |points| points.position.len());
        let mut names = vec![None; self.hanging(explicit).into_iter().max().map_or(0, |last| last as usize + 1)];
        for keys in &self.bodies {
            let copies = check::copies(keys) as usize;
            names.extend(std::iter::repeat_n(name(keys), copies));
        }
        Ok(names)
    }

    pub(super) fn all_tints(&self) -> Result<Vec<Tint>, Fault> {
        let explicit = self.points.as_ref().map_or(0, |points| points.position.len());
        let mut tints = Vec::new();
        let mut next = 0;
        for (point, body) in self.hanging(explicit).into_iter().enumerate() {
            if tints.last().is_none_or(|last: &Tint| last.body != body) {
                tints.push(Tint { first: point as u32, body, color: None });
            }
            next = next.max(body + 1);
        }
        let mut first = explicit as u32;
        for (i, keys) in self.bodies.iter().enumerate() {
            let count = check::count(keys, self).item(i).at("bodies")?;
            let copies = check::copies(keys);
            let color = keys.material.as_ref().and_then(|material| material.color).map(|color| color.0);
            for copy in 0..copies {
                tints.push(Tint { first: first + copy * (count / copies.max(1)), body: next, color });
                next += 1;
            }
            first += count;
        }
        for skin in &self.skins {
            paint(&mut tints, skin);
        }
        Ok(tints)
    }

    /// The body of each explicit point, counted by lowest points.
    fn hanging(&self, count: usize) -> Vec<u32> {
        let bonds = self.bonds.iter().map(|bond| [bond.a, bond.b]);
        let sides =
            self.triangles.iter().flat_map(|corners| [[corners.0[0], corners.0[1]], [corners.0[1], corners.0[2]]]);
        Tint::hanging(count, bonds.chain(sides))
    }
}

/// What a body is called that these keys make.
fn name(keys: &BodyKeys) -> Option<String> {
    let name = match keys.make {
        MakerName::Points => return None,
        MakerName::RandomGraph => "net",
        MakerName::Rim => "rim",
        MakerName::Box => "box",
        MakerName::Rope => "rope",
        MakerName::Cloth => "cloth",
        MakerName::Lattice => "block",
        MakerName::Disc => "disc",
        MakerName::Ragdoll => "figure",
        MakerName::Picture => {
            let file = keys.file.as_deref().filter(|file| !file.starts_with("data:"));
            file.and_then(|file| std::path::Path::new(file).file_stem()?.to_str()).unwrap_or("picture")
        }
    };
    Some(name.to_owned())
}

/// Gives points the colour that a skin says, if it says one.
pub(crate) fn paint(tints: &mut Vec<Tint>, skin: &SkinKeys) {
    if let Some(color) = skin.color {
        Tint::paint(tints, &skin.points, color.0);
    }
}
