//! How many substeps a step of large bodies takes: as many as a strain needs.
//!
//! What a pass over the bonds leaves undone makes them soft: a body under load is strained about in proportion to h^2.
//! Stiffening it while it is stretched feeds energy in, like a swing that is pumped: so substeps grow and shrink by a few per
//! cent a step, unless there is little strain that a change could set free.

use crate::sim::sizes::MOST_FOR_STRAIN;

/// The frame that automatic substeps divide `[s]`.
pub(crate) const FRAME: f64 = 1.0 / 60.0;
/// Share of the strain asked for that is aimed at: the largest strain of a step swings from step to step.
const AIM: f64 = 0.5;
/// Share of the aim below which substeps shrink.
const LOW: f64 = 0.5;
/// Share of the aim below which there is little to set free.
const LITTLE: f64 = 0.1;
/// What is remembered of the strain of the step before.
const MEMORY: f64 = 0.9;
/// What substeps grow and shrink by at most, a step.
const GROWTH: f64 = 1.05;
const DECAY: f64 = 0.98;
/// The same where there is little strain.
const FALL: f64 = 0.7;
/// What substeps grow by at most where the strain is above what is asked for.
const QUICK_GROWTH: f64 = 1.1;
/// A step with more strain than is asked for is taken again, if that comes from an event: nets that hang taut are strained as
/// they swing, and would be pumped. There it takes so much more strain than of late, or than is asked for.
const SUDDEN: f64 = 3.0;
/// What substeps then grow by at most, and how often.
const MOST_GROWTH: f64 = 2.0;
const MOST_TRIES: u32 = 9;
/// Most that bonds may pull, as w lambda/rest: directions are those of points as they go on unpushed, so of a row of points
/// with this between them the shortest wave is multiplied by 1 - 4 w lambda/rest a substep, and grows below -1/3.
const MOST_PULL: f64 = 0.3;
/// A pull that is not waited with: no substeps that grow by a few per cent a step would come in time. A taut rope between two
/// pins, whose length cannot give way, pulls without end.
const UNBEARABLE: f64 = 1.0;
/// Share of what a frame may take that one takes in which something is grabbed: what is swung stays so for a while, and others are to be moved and
/// drawn too.
const HANDS: f64 = 0.25;
/// Substeps of the first frame: what too few of them do to a start, later ones cannot mend.
const START: f64 = 16.0;

/// Substeps of a frame, and what they are chosen by.
#[derive(Clone, Debug)]
pub(crate) struct Control {
    /// Substeps of a frame, where they follow a strain: as many whole ones as this takes.
    count: f64,
    /// Fewest of them, and as many as a frame may take, those that are taken again among them.
    least: f64,
    paid: f64,
    /// Those that the step under way has taken.
    spent: f64,
    /// Largest strain `[1]`, where substeps follow it.
    target: Option<f64>,
    /// Largest strain of late `[1]`.
    late: f64,
    /// How often the step under way was taken.
    tries: u32,
    /// Longest substep `[s]`, where they don't.
    longest: f64,
    /// The heaviest body's weight `[N]`.
    weight: f64,
    /// Bonds give way a little: they pull more than the most substeps can bear.
    gives: bool,
}

/// What bonds bore in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load {
    /// The largest pull in a substep of bonds that nothing holds across their direction, as w lambda/rest `[1]`.
    pub(crate) pull: f64,
    /// The mouse or a surface was in reach.
    pub(crate) is_disturbed: bool,
    /// A hand leads some of the points.
    pub(crate) is_grabbed: bool,
}

impl Control {
    /// Substeps that follow a strain.
    pub(crate) fn following(target: f64) -> Self {
        let late = 0.5 * AIM * target;
        Control {
            count: START,
            least: 1.0,
            paid: f64::INFINITY,
            spent: 0.0,
            target: Some(target),
            late,
            tries: 0,
            longest: FRAME,
            weight: 0.0,
            gives: false,
        }
    }

    /// Substeps of at most `h` `[s]`.
    pub(crate) fn fixed(h: f64) -> Self {
        Control {
            count: 1.0,
            least: 1.0,
            paid: f64::INFINITY,
            spent: 0.0,
            target: None,
            late: 0.0,
            tries: 0,
            longest: h,
            weight: 0.0,
            gives: false,
        }
    }

    /// Substeps are to be as many as bonds take that pull by this much over a frame, as w lambda/rest; `weight` is that of the
    /// heaviest body `[N]`.
    pub(crate) fn bear(&mut self, pull: f64, weight: f64) {
        self.weight = weight;
        self.least = (pull / MOST_PULL).sqrt().clamp(self.least, MOST_FOR_STRAIN);
        self.count = self.count.max(self.least);
    }

    /// A frame takes no more substeps than these, unless fewer could not bear what bonds pull; one in which something is grabbed a share of them:
    /// under the hand bodies stretch sooner than they get slow.
    pub(crate) fn within(self, paid: f64) -> Self {
        Control { paid: paid.max(START), ..self }
    }

    /// Whether substeps follow a strain.
    pub(crate) fn follows(&self) -> bool {
        self.target.is_some()
    }

    /// Strain above which a path gets another round.
    pub(crate) fn tolerance(&self) -> f64 {
        self.target.unwrap_or(1e-3).clamp(1e-7, 1e-3)
    }

    /// Tension over strain of rigid bonds `[N]`: infinite, unless they have to give way.
    ///
    /// Then it is that of a taut string which sags under the weight of all to the strain aimed at: with T = weight/(8 sag) for
    /// a length of 1 and a strain s = 8/3 sag^2, T/s = weight/(s sqrt(24 s)). It is a stiffness, not a share of a substep's
    /// correction: substeps that change feed nothing in.
    pub(crate) fn tautness(&self) -> f64 {
        match self.target {
            Some(target) if self.gives => self.weight / (AIM * target * (24.0 * AIM * target).sqrt()),
            _ => f64::INFINITY,
        }
    }

    /// Substeps of a step of `h` `[s]`.
    pub(crate) fn count(&self, h: f64) -> u32 {
        ((h / self.substep() * (1.0 - 1e-9)).ceil() as u32).max(1)
    }

    /// Substeps of a step of `h` `[s]` in which the cursor is to be followed in so many parts: as many as may be paid for.
    pub(crate) fn follow(&self, parts: u32, h: f64) -> u32 {
        self.count(h).max(parts.min((self.paid * h / FRAME) as u32))
    }

    /// The longest substep `[s]`.
    pub(crate) fn substep(&self) -> f64 {
        if self.target.is_some() { FRAME / self.count.ceil() } else { self.longest }
    }

    /// A step ended with this strain: whether it stands.
    pub(crate) fn accepts(&mut self, strain: f64, load: Load) -> bool {
        let Some(target) = self.target else { return true };
        let (count, aim) = (self.count.ceil(), AIM * target);
        self.spent += count;
        let paid = if load.is_grabbed { (HANDS * self.paid).max(START) } else { self.paid };
        let wanted = (strain / aim).sqrt();
        let next = (count * wanted.min(MOST_GROWTH)).min(MOST_FOR_STRAIN);
        let is_event = load.is_disturbed || load.pull == 0.0 || strain > SUDDEN * self.late.min(target);
        let is_paid = self.spent + next <= paid;
        if strain > target && is_event && self.tries < MOST_TRIES && count < MOST_FOR_STRAIN && is_paid {
            self.count = next;
            self.tries += 1;
            return false;
        }
        (self.tries, self.spent) = (0, 0.0);
        self.late = strain.max(MEMORY * self.late);
        let factor = if strain > aim {
            wanted.min(if strain > target { QUICK_GROWTH } else { GROWTH })
        } else if self.late < LITTLE * aim {
            (self.late / (LITTLE * aim)).sqrt().max(FALL)
        } else if self.late < LOW * aim {
            DECAY
        } else {
            1.0
        };
        self.gives |= load.pull > UNBEARABLE || (load.pull > MOST_PULL && self.count >= MOST_FOR_STRAIN);
        let borne = count * (load.pull / MOST_PULL).sqrt().min(GROWTH);
        self.count = (self.count * factor).min(paid.max(count)).max(borne).max(self.least).min(MOST_FOR_STRAIN);
        true
    }
}
