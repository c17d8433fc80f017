//! Values of options, checked while the call is parsed: a wrong one ends with exit code 2.

use std::path::{Path, PathBuf};

use crate::scene::SolverName;
use crate::sim::Solver;

/// A finite number above 0.
pub(super) fn above_zero(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("give a finite number above 0".to_owned()),
    }
}

/// A finite number, 0 or more.
pub(super) fn at_least_zero(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
        _ => Err("give a finite number, 0 or more".to_owned()),
    }
}

/// Times that ascend, separated by commas.
#[derive(Clone, Debug)]
pub(super) struct Times(pub(super) Vec<f64>);

pub(super) fn times(text: &str) -> Result<Times, String> {
    let list: Vec<f64> = text.split(',').map(|part| at_least_zero(part.trim())).collect::<Result<_, _>>()?;
    if list.is_sorted() { Ok(Times(list)) } else { Err("give times in ascending order".to_owned()) }
}

/// Width and height in pixels, such as 1280x720.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X']).map(|(w, h)| (w.trim().parse::<u32>(), h.trim().parse::<u32>()));
    match sides {
        Some((Ok(width), Ok(height))) if width > 0 && height > 0 => Ok([width, height]),
        _ => Err("give width and height in pixels, such as 1280x720".to_owned()),
    }
}

/// A file with one of these extensions.
pub(super) fn ending(text: &str, known: &[&str]) -> Result<PathBuf, String> {
    if known.contains(&extension(Path::new(text)).as_str()) {
        return Ok(PathBuf::from(text));
    }
    let list: Vec<String> = known.iter().map(|ending| format!(".{ending}")).collect();
    Err(format!("name a file that ends in {}", list.join(" or ")))
}

/// What stands behind the last dot of a file's name, in small letters.
pub(super) fn extension(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

/// A solver that this version has.
pub(super) fn solver(text: &str) -> Result<SolverName, String> {
    let name: SolverName = text.parse()?;
    let known: Vec<&str> = Solver::ALL.iter().map(|solver| solver.name()).collect();
    if name == SolverName::AsPrinted || known.contains(&name.name()) {
        return Ok(name);
    }
    Err(format!("`{name}` is not in this version: use one of {}", known.join(", ")))
}
