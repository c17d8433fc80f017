//! Colours and sizes: how a world looks.

/// A colour in sRGB as it is stored, with opacity; not premultiplied.
pub type Color = [f32; 4];

/// What of a state is shown by colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overlay {
    /// Nothing: bodies have colours of their own.
    #[default]
    None,
    /// The strain of bonds, and of what bodies cover.
    Strain,
    /// The distance to where points are in another world, where the view tells it: colours as of stretched bonds.
    Difference,
}

/// Which colours there are: on a dark ground, or on a light one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Palette {
    /// Bright on nearly black.
    #[default]
    Dark,
    /// Dark on nearly white.
    Light,
}

impl Palette {
    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Palette::Dark => Palette::Light,
            Palette::Light => Palette::Dark,
        }
    }
}

/// Colours of strains, from squeezed to stretched, in even steps.
///
/// Blue, grey and red: eyes that see two colours only tell both sides apart, and each from rest.
///
/// Source: P. Tol, Colour schemes (technical note SRON/EPS/TN/09-002, 3.2, 2021), the scheme `sunset` without its darkest two, which
/// a dark ground would swallow, and with grey in place of its middle, which is hardly told from a hundredth of stretch.
pub const STRAIN_COLORS: [Color; 9] = [
    hex(0x4a_7b_b7, 1.0),
    hex(0x6e_a6_cd, 1.0),
    hex(0x98_ca_e1, 1.0),
    hex(0xc2_e4_ef, 1.0),
    hex(0xa9_b0_bb, 1.0),
    hex(0xfe_da_8b, 1.0),
    hex(0xfd_b3_66, 1.0),
    hex(0xf6_7e_4b, 1.0),
    hex(0xdd_3d_2d, 1.0),
];

/// The same hues on a light ground, dark enough to be told from it.
const STRAIN_ON_LIGHT: [Color; 9] = [
    hex(0x24_3c_8a, 1.0),
    hex(0x33_5c_a6, 1.0),
    hex(0x3f_78_b4, 1.0),
    hex(0x4c_89_b4, 1.0),
    hex(0x7c_85_92, 1.0),
    hex(0xa8_7c_14, 1.0),
    hex(0xb8_66_0c, 1.0),
    hex(0xbc_44_18, 1.0),
    hex(0x981616, 1.0),
];

/// Colours of distances, in even steps from none on.
const DISTANCE_COLORS: [Color; 5] =
    [hex(0xa9_b0_bb, 1.0), hex(0xbf_a0_dd, 1.0), hex(0xc7_7f_e8, 1.0), hex(0xcf_5c_f0, 1.0), hex(0xe8_3f_e0, 1.0)];

/// The same on a light ground.
const DISTANCE_ON_LIGHT: [Color; 5] =
    [hex(0x7c_85_92, 1.0), hex(0x8a_63_b0, 1.0), hex(0x8a_3f_b8, 1.0), hex(0x8a_1f_b0, 1.0), hex(0x7a_0a_8a, 1.0)];

/// Colours of trails, of as many worlds as there may be side by side; eyes that see two colours only tell those next to each other apart.
///
/// Source: P. Tol, Colour schemes (technical note SRON/EPS/TN/09-002, 3.2, 2021), the schemes `light` and `bright`.
const TRAILS: [Color; 6] = [
    hex(0xee_dd_88, 0.85),
    hex(0x66_ac_ff, 0.85),
    hex(0xff_88_77, 0.85),
    hex(0x55_d0_a0, 0.85),
    hex(0xdd_99_ee, 0.85),
    hex(0xff_ff_ff, 0.85),
];

/// The same on a light ground.
const TRAILS_ON_LIGHT: [Color; 6] = [
    hex(0x8c_6a_00, 0.85),
    hex(0x1a_5a_b0, 0.85),
    hex(0xb8_30_28, 0.85),
    hex(0x0f_7a_50, 0.85),
    hex(0x8a_3a_a8, 0.85),
    hex(0x22_2d_3e, 0.85),
];

/// Colours and sizes. Lengths are in logical pixels, to be multiplied by the scale factor of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// The ground.
    pub ground: Color,
    /// Lines of the grid.
    pub grid: Color,
    /// Axes of the grid.
    pub axis: Color,
    /// Walls, and the rims of obstacles.
    pub wall: Color,
    /// The inside of obstacles.
    pub obstacle: Color,
    /// Balls and boxes in space: where no light falls on them, and where all does.
    pub solid: [Color; 2],
    /// The numbers of the grid.
    pub number: Color,
    /// Bonds.
    pub bond: Color,
    /// Ropes.
    pub rope: Color,
    /// Strains, from squeezed by [`Look::strain_full`] to stretched by it.
    pub strain: [Color; 9],
    /// Distances, from none to [`Look::difference_full`]: hues that no strain has, since both may stand side by side.
    pub distance: [Color; 5],
    /// Points.
    pub point: Color,
    /// Pinned points.
    pub pin: Color,
    /// Trails of points, where they are fresh: of the world itself, then of those that stand beside it, each in its own.
    pub trails: [Color; 6],
    /// The region of the mouse force.
    pub region: Color,
    /// Marks of motors.
    pub motor: Color,
    /// Width of bonds `[px]`.
    pub bond_width: f32,
    /// Largest radius of points `[px]`; they shrink where bonds are short on the screen.
    pub point_radius: f32,
    /// Width of outlines `[px]`.
    pub outline_width: f32,
    /// Strain up to which colours go in proportion to it; above they go by its logarithm `[1]`.
    pub strain_scale: f32,
    /// Strain from which on there are no further colours `[1]`.
    pub strain_full: f32,
    /// Distance from which on there are no further colours `[m]`, > 0; below a hundredth of it they go in proportion, above by its logarithm.
    pub difference_full: f32,
    /// What is shown by colour.
    pub overlay: Overlay,
    /// Whether bodies without a picture are filled.
    pub has_fills: bool,
    /// Whether bonds and points that a skin or a fill covers are drawn; others are in any case.
    pub has_mesh: bool,
    /// Whether bonds are drawn as coils, bars and ropes, and points with an edge; plain strokes and discs otherwise.
    pub has_forms: bool,
    /// Whether the plane has a grid with numbers.
    pub has_grid: bool,
    /// Room at the left edge that numbers of the grid leave to what lies there `[px]`.
    pub inset: f32,
    /// Least radius of a pinned point, of a few: however small its body is, it is seen.
    pub least_pin: f32,
    /// How much of what is far away fades into the ground, in space `[1]`.
    pub fog: f32,
    /// Physical pixels in a logical one.
    pub scale_factor: f32,
}

/// A colour from its six hexadecimal digits.
const fn hex(rgb: u32, opacity: f32) -> Color {
    [((rgb >> 16) & 255) as f32 / 255.0, ((rgb >> 8) & 255) as f32 / 255.0, (rgb & 255) as f32 / 255.0, opacity]
}

impl Default for Look {
    fn default() -> Self {
        Look {
            ground: hex(0x0f_14_1e, 1.0),
            grid: hex(0xff_ff_ff, 0.04),
            axis: hex(0xff_ff_ff, 0.11),
            number: hex(0x9a_a8_bf, 1.0),
            wall: hex(0x6e_80_9c, 1.0),
            obstacle: hex(0x30_3d_53, 1.0),
            solid: [hex(0x4a_5a_76, 1.0), hex(0xa6_b8_d2, 1.0)],
            bond: hex(0x8f_a6_c2, 1.0),
            rope: hex(0xd8_bb_8c, 1.0),
            strain: STRAIN_COLORS,
            distance: DISTANCE_COLORS,
            point: hex(0xe9_f1_fb, 1.0),
            pin: hex(0xff_5c_7a, 1.0),
            trails: TRAILS,
            region: hex(0x7d_f0_c8, 0.9),
            motor: hex(0xff_d6_78, 0.95),
            bond_width: 1.8,
            point_radius: 4.2,
            outline_width: 1.5,
            strain_scale: 0.005,
            strain_full: 0.3,
            difference_full: 1.0,
            overlay: Overlay::None,
            has_fills: true,
            has_mesh: false,
            has_forms: true,
            has_grid: true,
            inset: 0.0,
            least_pin: 3.2,
            fog: 0.7,
            scale_factor: 1.0,
        }
    }
}

impl Look {
    /// The usual sizes, in the colours of a palette.
    pub fn in_palette(palette: Palette) -> Self {
        Look::default().colored(palette)
    }

    /// The same in the colours of a palette.
    pub fn colored(self, palette: Palette) -> Self {
        let of = match palette {
            Palette::Dark => Look::default(),
            Palette::Light => Look {
                ground: hex(0xf1_f4_f9, 1.0),
                grid: hex(0x00_00_00, 0.05),
                axis: hex(0x00_00_00, 0.15),
                number: hex(0x4a_56_69, 1.0),
                wall: hex(0x6f_7d_94, 1.0),
                obstacle: hex(0xc9_d2_df, 1.0),
                solid: [hex(0x4e_5d_75, 1.0), hex(0x9c_ab_c2, 1.0)],
                bond: hex(0x52_67_84, 1.0),
                rope: hex(0x8a_66_2c, 1.0),
                strain: STRAIN_ON_LIGHT,
                distance: DISTANCE_ON_LIGHT,
                point: hex(0x22_2d_3e, 1.0),
                pin: hex(0xcc_1f_46, 1.0),
                trails: TRAILS_ON_LIGHT,
                region: hex(0x00_6a_4f, 0.9),
                motor: hex(0x80_56_00, 0.95),
                ..Look::default()
            },
        };
        Look {
            ground: of.ground,
            grid: of.grid,
            axis: of.axis,
            number: of.number,
            wall: of.wall,
            obstacle: of.obstacle,
            solid: of.solid,
            bond: of.bond,
            rope: of.rope,
            strain: of.strain,
            distance: of.distance,
            point: of.point,
            pin: of.pin,
            trails: of.trails,
            region: of.region,
            motor: of.motor,
            ..self
        }
    }
}

impl Look {
    /// Colours of distances as the shader reads those of strains: from its middle on.
    pub(super) fn of_distances(&self) -> [Color; 9] {
        std::array::from_fn(|place| self.distance[place.abs_diff(self.strain.len() / 2)])
    }
}

/// A colour as files have it, without its opacity.
pub fn in_bytes([red, green, blue, _]: Color) -> [u8; 3] {
    [red, green, blue].map(|part| (255.0 * part).round() as u8)
}

/// How much brighter one colour is than the other, from 1 to 21; opacity does not count.
///
/// Source: W3C, Web Content Accessibility Guidelines 2.2 (2023), contrast ratio.
pub fn contrast(a: Color, b: Color) -> f32 {
    let [a, b] = [a, b].map(luminance);
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// How bright a colour is, from 0 to 1, by the same guidelines.
pub(super) fn luminance([red, green, blue, _]: Color) -> f32 {
    let linear = |c: f32| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::guides::HALO;

    #[test]
    fn numbers_of_the_grid_and_all_that_is_drawn_are_seen_on_the_ground() {
        for palette in [Palette::Dark, Palette::Light] {
            let look = Look::in_palette(palette);
            let on_ground = |color| contrast(color, look.ground);
            // Numbers stand on the ground, its lines, obstacles and the rims of these, with the ground half seen between: on each they are read.
            let over = |above: Color, share: f32, below: Color| -> Color {
                std::array::from_fn(|part| share * above[part] + (1.0 - share) * below[part])
            };
            let lines = [look.grid, look.axis].map(|line| over([line[0], line[1], line[2], 1.0], line[3], look.ground));
            let below = [look.ground, look.obstacle, lines[0], lines[1], look.wall];
            let halos = below.map(|ground| over(look.ground, HALO[1], ground));
            for ground in halos.into_iter().chain([look.ground, look.obstacle]) {
                let found = contrast(look.number, ground);
                assert!(found >= 4.5, "{palette:?}: {ground:?}: {found}");
            }
            for color in look
                .strain
                .into_iter()
                .chain(look.distance)
                .chain(look.trails)
                .chain([look.wall, look.bond, look.rope, look.point, look.pin])
            {
                assert!(on_ground(color) >= 3.0, "{palette:?}: {color:?}: {}", on_ground(color));
            }
            // Obstacles are large: their inside is seen by less, and their rim stands out from it.
            let least = if palette == Palette::Dark { 1.6 } else { 1.35 };
            assert!(on_ground(look.obstacle) >= least, "{palette:?}: {}", on_ground(look.obstacle));
            // In space their shape is seen by light and shade, and both on the floor, which is hardly other than the ground.
            let [shade, lit] = look.solid.map(on_ground);
            assert!(shade >= 2.0 && lit >= 2.0, "{palette:?}: {shade} {lit}");
            assert!(contrast(look.solid[0], look.solid[1]) >= 2.0, "{palette:?}");
            let rim = contrast(look.wall, look.obstacle);
            assert!(rim >= 2.4, "{palette:?}: {rim}");
            assert_eq!(look.colored(palette.other()).colored(palette), look);
        }
    }

    #[test]
    fn contrast_is_as_the_guidelines_have_it() {
        let [black, white] = [hex(0, 1.0), hex(0xff_ff_ff, 1.0)];
        assert!((contrast(black, white) - 21.0).abs() < 1e-4 && contrast(white, white) == 1.0);
        // A published pair: #767676 on white.
        assert!((contrast(hex(0x76_76_76, 1.0), white) - 4.54).abs() < 0.01);
    }
}
