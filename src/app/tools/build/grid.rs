//! Square cells that fill a rectangle as nearly as may be.

use std::ops::RangeInclusive;

use glam::DVec2;

/// A grid of points on square cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    /// Lower left corner `[m]`.
    pub(super) low: DVec2,
    /// Cells along x and y.
    pub(super) cells: [u32; 2],
    /// Side of a cell `[m]`.
    pub(super) spacing: f64,
}

/// How many cells the sides of a rectangle may have.
#[derive(Clone, Debug)]
pub(super) struct Fineness {
    /// Along the shorter side.
    pub(super) across: RangeInclusive<u32>,
    /// Most along the longer one: a strip that would need more is made thicker.
    pub(super) most: u32,
}

/// A side of fewer cells than this counts as so much further off a cell `[1]`: thin strips fold.
const THIN: f64 = 0.1;
/// Cells from which on a side is not thin.
const THICK: u32 = 3;

impl Grid {
    /// The grid that is nearest to the rectangle between two corners `[m]`, from the first one on.
    pub(super) fn fit(from: DVec2, to: DVec2, fineness: &Fineness) -> Self {
        let size = (to - from).abs();
        let (short, long) = (size.min_element(), size.max_element());
        let fits = |&across: &u32| across == *fineness.across.start() || along(across, short, long) <= fineness.most;
        let tried =
            fineness.across.clone().rev().filter(fits).map(|across| Cells::new(across, [short, long], fineness));
        let best = tried.min_by(|a, b| a.miss.total_cmp(&b.miss));
        let Cells { across, along, spacing, .. } = best.unwrap_or_else(|| Cells::new(1, [short, long], fineness));
        let cells = if size.x < size.y { [across, along] } else { [along, across] };
        let reach = spacing * DVec2::new(f64::from(cells[0]), f64::from(cells[1]));
        let far = from + reach * (to - from).signum();
        Grid { low: from.min(far), cells, spacing }
    }

    /// Width and height `[m]`.
    pub(super) fn size(&self) -> DVec2 {
        self.spacing * DVec2::new(f64::from(self.cells[0]), f64::from(self.cells[1]))
    }
}

/// So many cells across and along a rectangle.
struct Cells {
    across: u32,
    along: u32,
    spacing: f64,
    /// How far it is from the rectangle, in its longer side `[1]`.
    miss: f64,
}

impl Cells {
    fn new(across: u32, [short, long]: [f64; 2], fineness: &Fineness) -> Self {
        let along = along(across, short, long).clamp(across, fineness.most);
        let [m, n] = [along, across].map(f64::from);
        // The least squares of both sides' errors; of a strip that is too long, its length.
        let is_cut = along == fineness.most;
        let spacing = if is_cut { long / m } else { (m * long + n * short) / (m * m + n * n) };
        let miss = (m * spacing - long).hypot(n * spacing - short) / long;
        Cells { across, along, spacing, miss: miss + THIN * f64::from(THICK.saturating_sub(across)) }
    }
}

/// Cells along the longer side where there are so many across.
fn along(across: u32, short: f64, long: f64) -> u32 {
    (f64::from(across) * long / short.max(f64::MIN_POSITIVE)).round().min(1e6) as u32
}
