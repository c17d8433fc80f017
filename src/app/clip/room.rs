//! Where a copy has room: as near as may be to where it is wished, and in view, beside bodies, obstacles and walls.

use glam::{DVec2, DVec3};

use super::{Clip, Wish, space};
use crate::history::History;
use crate::scene::room::{Drawing, Lies, Wanted, in_view};
use crate::sim::Dynamics;

/// Said of a copy that is put where another body is: nothing is free.
pub(in crate::app) const IN_ANOTHER: &str = "no free space in view: it overlaps another body";
/// Said of a copy that is put into what another body goes around.
const IN_HOLLOW: &str = "no free space in view: it lies in the hollow of another body";
/// Said of a copy that is put beside what it is of: there is room for it, but not in view.
const OUT_OF_VIEW: &str = "no free space in view: it lies beside it, partly out of view (F shows all)";
/// Said where it would lie in obstacles or beyond walls wherever it is put.
const NO_ROOM: &str = "no space for it in view: clear some, or zoom out (wheel)";

/// Where a copy comes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    /// From where it was `[m]`.
    pub(super) by: [f64; 3],
    /// What is to be said of it.
    pub(super) lies_in: Option<&'static str>,
}

/// Where there is room for a copy.
///
/// Errors: in words, that there is none.
pub(super) fn place(clip: &Clip, history: &History, wish: &Wish) -> Result<Place, String> {
    let is_endless = clip.keys.obstacles.iter().any(|obstacle| obstacle.plane.is_some());
    match clip.dimensions {
        // A plane has no end, so it lies in everything.
        _ if is_endless => Ok(Place { by: wish.by, lies_in: None }),
        2 => in_plane(clip, history.world(), wish),
        _ => Ok(space::place(clip, history.world(), wish)),
    }
}

fn in_plane(clip: &Clip, world: &dyn Dynamics, wish: &Wish) -> Result<Place, String> {
    let Wish { is_meant, is_beside, .. } = *wish;
    let wanted = Wanted { by: DVec3::from(wish.by).truncate(), is_meant, is_beside, seen: wish.seen() };
    let Some(shape) = clip.keys.shape(0) else { return Ok(Place { by: wish.by, lies_in: None }) };
    let places: Vec<DVec2> = shape.places.iter().copied().map(DVec2::from).collect();
    let own = Drawing::bodies(&places, shape.bonds.into_iter(), shape.triangles.into_iter())
        .with(shape.polygons.into_iter().map(|polygon| polygon.loops));
    let (by, lies) = in_view(world, &own, wanted).ok_or_else(|| NO_ROOM.to_owned())?;
    let lies_in = match lies {
        Lies::Free => None,
        Lies::OutOfView => Some(OUT_OF_VIEW),
        Lies::InHollow => Some(IN_HOLLOW),
        Lies::InAnother => Some(IN_ANOTHER),
    };
    Ok(Place { by: by.extend(0.0).to_array(), lies_in })
}

impl Wish {
    /// What is free of the picture in the plane: lower and upper corner `[m]`.
    fn seen(&self) -> [DVec2; 2] {
        let [[left, top], [right, bottom]] = self.free;
        [[left, bottom], [right, top]].map(|pixel| self.camera.world_from_screen(pixel).truncate())
    }

    /// Whether a place in space is seen beside panels.
    pub(super) fn sees(&self, at: DVec3) -> bool {
        let [low, high] = self.free;
        let is_in = |pixel: [f64; 2]| (0..2).all(|k| (low[k]..=high[k]).contains(&pixel[k]));
        self.camera.screen_from_world(at).is_some_and(is_in)
    }
}
