//! Plots for a paper: every figure as SVG and as PNG, in colours that the colour-blind tell apart.

mod axes;
mod figure;
mod ratios;
mod slides;
mod speed;
mod stability;
mod style;
mod work;

use std::io::Cursor;
use std::path::Path;

use image::ImageFormat;

use super::error::StudyError;
use crate::output::replace;

pub(super) use figure::Figure;
pub(super) use ratios::ratios;
pub(super) use slides::{circle, decay, orders};
pub(super) use speed::{frames, sweeps};
pub(super) use stability::{outcomes, rates, shares};
pub(super) use work::work;

/// Writes a figure as NAME.svg and NAME.png.
///
/// Errors: it cannot be drawn or written.
pub(super) fn write(folder: &Path, name: &str, figure: &Figure) -> Result<(), StudyError> {
    let failed = |reason: String| StudyError::Plot { plot: name.to_owned(), reason };
    let svg = figure.svg().map_err(failed)?;
    let mut png = Cursor::new(Vec::new());
    let image = figure.image().map_err(failed)?;
    image.write_to(&mut png, ImageFormat::Png).map_err(|error| failed(error.to_string()))?;
    replace(&folder.join(format!("{name}.svg")), |to| to.write_all(svg.as_bytes()))?;
    replace(&folder.join(format!("{name}.png")), |to| to.write_all(png.get_ref()))?;
    Ok(())
}
