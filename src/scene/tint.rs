//! Which body each point of a scene is of, and how bodies say that they are drawn.

use super::check;
use super::error::{Fault, SceneError, Within};
use super::keys::{BodyKeys, ColorKey, MakerName, Material, Scene, SkinKeys};
use super::pictures::is_kept;
use crate::picture::{Coat, Tint};

impl Scene {
    /// The runs of points of one body each: explicit points by what bonds and triangles hold together, then body by body, each copy by
    /// itself, as they are to be drawn.
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
            names.extend(std::iter::repeat_n(name(keys, self.name()), copies));
        }
        Ok(names)
    }

    pub(super) fn all_tints(&self) -> Result<Vec<Tint>, Fault> {
        let explicit = self.points.as_ref().map_or(0, |points| points.position.len());
        let mut tints = Vec::new();
        let mut next = 0;
        for (point, body) in self.hanging(explicit).into_iter().enumerate() {
            if tints.last().is_none_or(|last: &Tint| last.body != body) {
                tints.push(Tint::new(point as u32, body));
            }
            next = next.max(body + 1);
        }
        let mut first = explicit as u32;
        for (i, keys) in self.bodies.iter().enumerate() {
            let count = check::count(keys, self).item(i).at("bodies")?;
            let copies = check::copies(keys);
            let coat = keys.material.as_ref().map(Material::coat).unwrap_or_default();
            for copy in 0..copies {
                tints.push(Tint::new(first + copy * (count / copies.max(1)), next).with(coat));
                next += 1;
            }
            first += count;
        }
        for (points, coat) in self.stroke_coats()? {
            Tint::paint(&mut tints, &points, coat);
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

/// What a body is called that these keys make, in a scene that is called so: a picture that is in no file as that is.
fn name(keys: &BodyKeys, scene: &str) -> Option<String> {
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
            if keys.file.as_deref().is_some_and(is_kept) {
                return Some(scene.to_owned());
            }
            let file = keys.file.as_deref().filter(|file| !file.starts_with("data:"));
            file.and_then(|file| std::path::Path::new(file).file_stem()?.to_str()).unwrap_or("picture")
        }
    };
    Some(name.to_owned())
}

/// Gives points the coat that a skin says.
pub(crate) fn paint(tints: &mut Vec<Tint>, skin: &SkinKeys) {
    if !skin.coat().is_empty() {
        Tint::paint(tints, &skin.points, skin.coat());
    }
}

impl SkinKeys {
    /// How its points are drawn.
    pub fn coat(&self) -> Coat {
        Coat { color: self.color.map(|color| color.0), width: self.width, visible: self.visible }
    }

    /// Points in a coat, whose skins stay as they are.
    pub fn of_coat(points: Vec<u32>, coat: Coat) -> Self {
        let Coat { color, width, visible } = coat;
        SkinKeys { points, color: color.map(ColorKey), width, visible, ..SkinKeys::default() }
    }
}

impl Material {
    /// How its body is drawn.
    pub(super) fn coat(&self) -> Coat {
        Coat { color: self.color.map(|color| color.0), width: self.width, visible: self.visible }
    }
}
