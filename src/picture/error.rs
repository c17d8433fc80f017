//! What can be wrong with a picture or with what is asked of it.

use thiserror::Error;

/// Why a picture makes no mesh: one line, with what to do about it where that is known.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PictureError {
    /// The bytes begin like no format that is read here.
    #[error("not a picture of a known format (PNG, JPEG, GIF, BMP, WebP, TIFF, PNM, TGA, ICO, QOI)")]
    Unknown,
    /// An SVG.
    #[error("is an SVG, a drawing of lines and areas, and pixels are needed: export it as a PNG, 1000 px or so wide")]
    Drawing,
    /// The format is known, the content is cut off or wrong.
    #[error("the {format} picture cannot be read: {reason}")]
    Damaged {
        /// Name of the format.
        format: String,
        /// The decoder's message, on one line.
        reason: String,
    },
    /// There is no pixel in it.
    #[error("the picture is {width} x {height} pixels: there is nothing in it")]
    NoPixels {
        /// Width `[px]`.
        width: u32,
        /// Height `[px]`.
        height: u32,
    },
    /// More pixels than are taken.
    #[error(
        "the picture is {width} x {height} pixels: {side} a side and {megapixels} million in all are the most; \
         scale it down"
    )]
    TooLarge {
        /// Width `[px]`.
        width: u32,
        /// Height `[px]`.
        height: u32,
        /// Longest side that is taken `[px]`.
        side: u32,
        /// Most pixels that are taken, in millions of 2^20.
        megapixels: u64,
    },
    /// Few enough pixels, but too many bytes for each.
    #[error("the picture needs {needed} MiB to decode: {limit} MiB is the most; store it with 8 bits a channel")]
    TooHeavy {
        /// Memory for decoding `[MiB]`.
        needed: u64,
        /// Most memory that is taken `[MiB]`.
        limit: u64,
    },
    /// No pixel is above the threshold.
    #[error(
        "there is nothing in the picture: no pixel is above the threshold {threshold:.3}; try another one, or invert"
    )]
    Empty {
        /// Share of full coverage.
        threshold: f64,
    },
    /// There were pixels, but nothing of them was left.
    #[error("nothing in the picture is as large as {min_area} px^2: lower min_area")]
    Dropped {
        /// Least area that was kept `[px^2]`.
        min_area: f64,
    },
    /// There was ink, all of it in strokes that were left out.
    #[error(
        "there is nothing in the picture but strokes thinner than the spacing, and these are dropped: make ropes of them"
    )]
    Thin,
    /// All that was left are points without a bond.
    #[error("there is nothing to make a body of but lone points: give a closer spacing")]
    NoBody,
    /// A setting is no number, or outside its range.
    #[error("{name} is {value}: {range}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// A canvas has no pixel or too many.
    #[error("the canvas is {width} x {height} pixels: each side must be from 1 to {side}")]
    Canvas {
        /// Width `[px]`.
        width: u32,
        /// Height `[px]`.
        height: u32,
        /// Longest side `[px]`.
        side: u32,
    },
    /// The mesh would be too large.
    #[error("spacing {spacing} px makes about {points} points: {limit} are the most; {}", cure(*would_do))]
    TooManyPoints {
        /// Distance of neighbours `[px]`.
        spacing: f64,
        /// Estimate.
        points: u64,
        /// Most points.
        limit: u64,
        /// A spacing that makes few enough `[px]`; none where there is too much grain for any.
        would_do: Option<f64>,
    },
    /// The boundary of the mesh would be too long.
    #[error(
        "the outline has about {points} points, more points than the {limit} that are taken: blur it, give a wider \
         spacing or a larger least area"
    )]
    TooLongEdge {
        /// Estimate.
        points: u64,
        /// Most points along the boundary.
        limit: u64,
    },
    /// Whoever asked for the mesh wants it no more.
    #[error("was stopped")]
    Stopped,
    /// Neither the fine outline nor coarser ones could be triangulated.
    #[error("the outline cannot be triangulated: {0}")]
    Mesh(String),
}

fn cure(would_do: Option<f64>) -> String {
    match would_do {
        Some(spacing) => format!("{spacing} px would do"),
        None => "it is mere grain: blur it, or give a larger least area".to_owned(),
    }
}
