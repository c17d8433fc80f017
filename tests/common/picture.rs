//! Scenes of a few lines for tests of pictures.

use wobble::render::{Look, Overlay, View};
use wobble::sim::{Bond, Bonds, PointId, Positions};

/// White on black, nothing but points and bonds.
pub fn plain() -> Look {
    let white = [1.0; 4];
    let clear = [0.0; 4];
    Look {
        ground: [0.0, 0.0, 0.0, 1.0],
        grid: clear,
        axis: clear,
        wall: clear,
        bond: white,
        point: white,
        pin: white,
        overlay: Overlay::None,
        bond_width: 3.0,
        point_radius: 6.3,
        ..Look::default()
    }
}

/// For scenes of points alone.
pub const NO_BONDS: &Bonds = &Bonds::new();

/// A world that rests.
pub fn view<'a>(positions: &'a [f32], bonds: &'a Bonds, dimensions: usize) -> View<'a> {
    View {
        skins: &[],
        dimensions,
        previous: Positions::F32(positions),
        current: Positions::F32(positions),
        mix: 1.0,
        motion: 0,
        topology: 0,
        bonds,
        pinned: &[],
        bounds: None,
        mouse: None,
    }
}

/// A bond of a metre.
pub fn bond(a: u32, b: u32) -> Bond {
    Bond::new(PointId(a), PointId(b), 1.0)
}
