//! How many substeps a step of large bodies takes: as many as a strain needs.

/// Most substeps of a frame.
const MOST: u32 = 512;
/// The frame that automatic substeps divide [s].
pub(crate) const FRAME: f64 = 1.0 / 60.0;
/// Share of the strain asked for that is aimed at: the largest strain of a step swings from step to step.
const AIM: f64 = 0.6;
/// What is remembered of the strain of the step before.
const MEMORY: f64 = 0.85;
/// Most times that a step is taken again.
const MOST_TRIES: u32 = 4;
/// Substeps of the first frame: what too few of them do to a start, later ones cannot mend.
const START: u32 = 16;

/// Substeps of a frame, and what they are chosen by.
#[derive(Clone, Debug)]
pub(crate) struct Control {
    /// Substeps of a frame, where they follow a strain.
    count: u32,
    /// Largest strain [1], where substeps follow it.
    target: Option<f64>,
    /// Largest strain of late [1].
    late: f64,
    /// How often the step under way was taken.
    tries: u32,
    /// Longest substep [s], where they don't.
    longest: f64,
}

impl Control {
    /// Substeps that follow a strain.
    pub(crate) fn following(target: f64) -> Self {
        Control { count: START, target: Some(target), late: 0.5 * AIM * target, tries: 0, longest: FRAME }
    }

    /// Substeps of at most `h` [s].
    pub(crate) fn fixed(h: f64) -> Self {
        Control { count: 1, target: None, late: 0.0, tries: 0, longest: h }
    }

    /// Whether substeps follow a strain.
    pub(crate) fn follows(&self) -> bool {
        self.target.is_some()
    }

    /// Strain above which a path gets another round.
    pub(crate) fn tolerance(&self) -> f64 {
        self.target.unwrap_or(1e-3).clamp(1e-7, 1e-3)
    }

    /// Substeps of a step of `h` [s].
    pub(crate) fn count(&self, h: f64) -> u32 {
        let longest = if self.target.is_some() { FRAME / f64::from(self.count) } else { self.longest };
        ((h / longest * (1.0 - 1e-9)).ceil() as u32).max(1)
    }

    /// A step ended with this strain: whether it stands. The next one has more substeps where the strain is above what is
    /// aimed at, and fewer where it has been far below for a while.
    ///
    /// Strain falls with the square of the substep.
    pub(crate) fn accepts(&mut self, strain: f64) -> bool {
        let Some(target) = self.target else { return true };
        let aim = AIM * target;
        let count = f64::from(self.count);
        self.late = strain.max(MEMORY * self.late);
        if strain > aim {
            let wanted = (count * (strain / aim).sqrt().min(2.0)).ceil() as u32;
            let more = wanted.max(self.count + 1).min(MOST);
            let is_last = more == self.count || self.tries == MOST_TRIES;
            self.count = more;
            if strain > target && !is_last {
                self.tries += 1;
                return false;
            }
        } else if self.late < 0.5 * aim && self.count > 1 {
            let wanted = (count * (1.2 * (self.late / aim).sqrt()).max(0.85)) as u32;
            self.count = wanted.clamp(1, self.count - 1);
        }
        self.tries = 0;
        true
    }
}
