//! What is seen of a copy and no step knows of: colours, pictures, groups.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};

use crate::history::{Do, Group, History};
use crate::picture::{Coat, Picture, Skin, Tint, hue};
use crate::scene::{DrawnKeys, LookKeys, PointGroupKeys, Row, SkinKeys, picture_as_text};
use crate::sim::{PointId, SkinMaterial};

/// Runs of points, counted in their order, that have the same.
fn runs<T: PartialEq>(points: &[PointId], of: impl Fn(&PointId) -> T) -> Vec<(T, Vec<u32>)> {
    let mut first = 0;
    let mut list = Vec::new();
    for same in points.chunk_by(|a, b| of(a) == of(b)) {
        let copies = first..first + same.len() as u32;
        first = copies.end;
        list.push((of(&same[0]), copies.collect()));
    }
    list
}

/// How points are drawn, and what their skins are made of.
pub(super) fn skins(history: &History, points: &[PointId]) -> Vec<SkinKeys> {
    let (world, tints) = (history.world(), history.tints());
    let look = |point: &PointId| {
        let tint = Tint::of(tints, point.0);
        let coat = Coat {
            color: tint.and_then(|tint| tint.color),
            width: tint.map(|tint| tint.width).filter(|width| *width > 0.0),
            visible: tint.filter(|tint| tint.is_hidden).map(|_| false),
        };
        (coat, world.skin_of(*point))
    };
    let keys = |((coat, material), points): ((Coat, SkinMaterial), Vec<u32>)| {
        let SkinMaterial { friction, restitution, radius, layered } = material;
        let is_said = !coat.is_empty() || material != SkinMaterial::default();
        is_said.then(|| SkinKeys { friction, restitution, radius, layered, ..SkinKeys::of_coat(points, coat) })
    };
    runs(points, look).into_iter().filter_map(keys).collect()
}

/// The bodies that points, ascending, are of: what they are called, and which colour of the palette they have. What has neither a name nor
/// triangles is as what holds together there.
pub(super) fn looks(history: &History, points: &[PointId]) -> Vec<LookKeys> {
    let (tints, names) = (history.tints(), history.body_names());
    let mut is_filled = vec![false; points.len()];
    let corners = history.world().triangles().iter().flatten();
    corners.filter_map(|corner| points.binary_search(corner).ok()).for_each(|place| is_filled[place] = true);
    let mut bodies: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (place, point) in points.iter().enumerate() {
        if let Some(tint) = Tint::of(tints, point.0) {
            bodies.entry(tint.body).or_default().push(place as u32);
        }
    }
    let of = |(body, points): (u32, Vec<u32>)| {
        let title = names.get(body as usize).cloned().flatten();
        let is_seen = title.is_some() || points.iter().any(|&place| is_filled[place as usize]);
        is_seen.then(|| LookKeys { points, title, hue: Some(hue(body)) })
    };
    bodies.into_iter().filter_map(of).collect()
}

/// The pictures that are drawn on triangles among points, ascending, each with where the points lie in it.
pub(super) fn textures(skins: &[Skin], points: &[PointId]) -> Vec<DrawnKeys> {
    let place = |point: u32| points.binary_search(&PointId(point)).ok();
    let of = |skin: &Skin| {
        let whole = skin.triangles.iter().filter(|corners| corners.iter().all(|&corner| place(corner).is_some()));
        let mut corners: Vec<u32> = whole.flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        let uv =
            |corner: &u32| skin.texture.get((corner - skin.first) as usize).map_or([0.0; 2], |uv| uv.map(f64::from));
        let uv = corners.iter().map(|corner| Row(uv(corner))).collect();
        let image = (!corners.is_empty()).then(|| as_text(&skin.picture)).flatten()?;
        let points = corners.into_iter().filter_map(place).map(|place| place as u32).collect();
        Some(DrawnKeys { image, points, uv })
    };
    skins.iter().filter_map(of).collect()
}

/// So many pictures are known as texts, the last ones.
const MOST_KNOWN: usize = 4;
/// Pictures that were copied last, as texts: making one takes longer than a frame, and who copies once does so again.
static KNOWN: Mutex<Vec<(Weak<Picture>, Arc<str>)>> = Mutex::new(Vec::new());

/// A picture as text; `None` of one that cannot be written.
fn as_text(picture: &Arc<Picture>) -> Option<String> {
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let is_it = |(kept, _): &&(Weak<Picture>, Arc<str>)| kept.upgrade().is_some_and(|kept| Arc::ptr_eq(&kept, picture));
    if let Some((_, text)) = known().iter().find(is_it) {
        return Some(text.to_string());
    }
    let text = picture_as_text(picture).ok()?;
    let mut list = known();
    list.retain(|(kept, _)| kept.strong_count() > 0);
    if list.len() == MOST_KNOWN {
        list.remove(0);
    }
    list.push((Arc::downgrade(picture), text.as_str().into()));
    Some(text)
}

/// The groups of which two points or more are copied, counted in the copy.
pub(super) fn groups(groups: Vec<Group>, place: impl Fn(PointId) -> Option<u32>) -> Vec<PointGroupKeys> {
    let of = |group: Group| {
        let points: Vec<u32> = group.points.into_iter().filter_map(&place).collect();
        (points.len() > 1).then_some(PointGroupKeys { points, title: Some(group.name) })
    };
    groups.into_iter().filter_map(of).collect()
}

/// What names the groups of a copy whose first point gets the number `next`: as they were called, or with the next number that is free.
pub(super) fn named(groups: &[PointGroupKeys], there: &[Group], next: u32) -> Vec<Do> {
    let mut taken: Vec<String> =
        there.iter().filter(|group| !group.points.is_empty()).map(|group| group.name.clone()).collect();
    let mut list = Vec::new();
    for group in groups {
        let title = group.title.as_deref().unwrap_or("group");
        let stem = title.trim_end_matches(|sign: char| sign.is_ascii_digit()).trim_end();
        let stem = if stem.is_empty() { "group" } else { stem };
        let counted = (1..).map(|k| format!("{stem} {k}"));
        let is_free = |name: &String| !taken.contains(name);
        let Some(name) = std::iter::once(title.to_owned()).chain(counted).find(is_free) else { continue };
        taken.push(name.clone());
        list.push(Do::Group { points: group.points.iter().map(|point| PointId(point + next)).collect(), name });
    }
    list
}
