//! Colours and sizes: how a world looks.

/// A colour in sRGB as it is stored, with opacity; not premultiplied.
pub type Color = [f32; 4];

/// What of a state is shown by colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overlay {
    /// Nothing.
    None,
    /// The strain of bonds.
    #[default]
    Strain,
}

/// Colours and sizes. Lengths are in logical pixels, to be multiplied by the scale factor of the screen.
///
/// Stretched and squeezed bonds differ in hue along orange and blue, which colour-blind people tell apart.
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
    /// Bonds at rest.
    pub bond: Color,
    /// Stretched bonds.
    pub stretch: Color,
    /// Squeezed bonds.
    pub squeeze: Color,
    /// Points.
    pub point: Color,
    /// Pinned points.
    pub pin: Color,
    /// The region of the mouse force.
    pub region: Color,
    /// Width of bonds [px].
    pub bond_width: f32,
    /// Largest radius of points [px]; they shrink where bonds are short on the screen.
    pub point_radius: f32,
    /// Width of outlines [px].
    pub outline_width: f32,
    /// Strain that is shown about halfway to the full colour [1].
    pub strain_scale: f32,
    /// What is shown by colour.
    pub overlay: Overlay,
    /// Whether bonds and points that a skin covers are drawn; others are in any case, but in large scenes.
    pub has_mesh: bool,
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
            grid: hex(0xff_ff_ff, 0.035),
            axis: hex(0xff_ff_ff, 0.09),
            wall: hex(0x5b_6b_84, 1.0),
            obstacle: hex(0x26_30_41, 1.0),
            bond: hex(0x8f_a6_c2, 1.0),
            stretch: hex(0xff_8f_2e, 1.0),
            squeeze: hex(0x2f_9b_ff, 1.0),
            point: hex(0xe9_f1_fb, 1.0),
            pin: hex(0xff_5c_7a, 1.0),
            region: hex(0x7d_f0_c8, 0.9),
            bond_width: 1.8,
            point_radius: 4.0,
            outline_width: 1.5,
            strain_scale: 0.04,
            overlay: Overlay::Strain,
            has_mesh: true,
            scale_factor: 1.0,
        }
    }
}
