//! Counts of the work that was done: they prove what was skipped.

/// Work done since a world was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Substeps taken.
    pub substeps: u64,
    /// Bonds taken by sweeps and solves, or evaluated as springs.
    pub bonds_solved: u64,
    /// Points advanced.
    pub points_moved: u64,
    /// Sweeps over the bonds, and rounds of Newton's method.
    pub iterations: u64,
    /// Points that the mouse force was evaluated for.
    pub mouse_points: u64,
    /// Touches of surfaces, and crossings of the mouse region's edge and turns of bonds that were located.
    pub events: u64,
    /// Substeps that a guard split in two.
    pub guard_splits: u64,
    /// Substeps that went to the next more robust method, or on with bonds that do not hold.
    pub fallbacks: u64,
    /// Bonds that broke.
    pub bonds_torn: u64,
    /// Points and edges of bodies that pressed each other, once a substep; obstacles without corners apart.
    pub contacts: u64,
    /// Motions that were cut where a point would have passed an edge.
    pub truncations: u64,
    /// Steps after which energy was taken from bodies that had got it from nowhere.
    pub guarded: u64,
    /// Searches for what is near what, of bodies that go together.
    pub detections: u64,
    /// Looks whether skins cross, one a step of bodies that go together.
    pub looks: u64,
    /// Points that were led back to the shape of their body, once a substep.
    pub mended: u64,
    /// Couples of bodies that were parted, once a substep.
    pub parted: u64,
    /// Bodies that were slowed down as they came to rest in the live step, once a step.
    pub settled: u64,
    /// Islands that left the finite numbers and stood still from then on.
    pub frozen: u64,
    /// Groups of islands that were handed over to the live step.
    pub hand_overs: u64,
    /// Those that went back to their own methods.
    pub returns: u64,
    /// Operations, about: what substeps cost, those too that were taken again or only tried, and looks for events.
    pub work: u64,
}

/// Time of an operation of [`Counters::work`] on the machine that its weights were fitted on `[ms]`.
///
/// Fitted to the processor time of the gallery's scenes: most lie within a factor of two.
const OPERATION: f64 = 0.17e-6;
/// Operations of each coordinate of the points of large bodies that a substep moves.
const OF_A_COORDINATE: u64 = 2;

/// Operations of a substep of large bodies of so many bonds, each of so many, and points.
pub(crate) fn of_a_batch((bonds, of_a_bond): (usize, u64), points: usize, dimensions: usize) -> u64 {
    of_a_bond * bonds as u64 + OF_A_COORDINATE * (points * dimensions) as u64
}

/// Operations that so much time is counted for `[ms]`.
pub(crate) fn operations(ms: f64) -> u64 {
    (ms / OPERATION) as u64
}

impl Counters {
    /// Adds the work that somebody else counted.
    pub(crate) fn add(&mut self, other: &Counters) {
        let &Counters {
            substeps,
            bonds_solved,
            points_moved,
            iterations,
            mouse_points,
            events,
            guard_splits,
            fallbacks,
            bonds_torn,
            contacts,
            truncations,
            guarded,
            detections,
            looks,
            mended,
            parted,
            settled,
            frozen,
            hand_overs,
            returns,
            work,
        } = other;
        self.substeps += substeps;
        self.bonds_solved += bonds_solved;
        self.points_moved += points_moved;
        self.iterations += iterations;
        self.mouse_points += mouse_points;
        self.events += events;
        self.guard_splits += guard_splits;
        self.fallbacks += fallbacks;
        self.bonds_torn += bonds_torn;
        self.contacts += contacts;
        self.truncations += truncations;
        self.guarded += guarded;
        self.detections += detections;
        self.looks += looks;
        self.mended += mended;
        self.parted += parted;
        self.settled += settled;
        self.frozen += frozen;
        self.hand_overs += hand_overs;
        self.returns += returns;
        self.work += work;
    }

    /// Counts `sweeps` over `bonds`.
    pub(crate) fn sweep(&mut self, sweeps: u32, bonds: usize) {
        self.iterations += u64::from(sweeps);
        self.bonds_solved += u64::from(sweeps) * bonds as u64;
    }

    /// Counts the work of large bodies since `before`: of so many operations a bond and components a point.
    pub(crate) fn count_batches(&mut self, before: &Counters, of_a_bond: u64, dimensions: usize) {
        let [bonds, points] = [self.bonds_solved - before.bonds_solved, self.points_moved - before.points_moved]
            .map(|count| count as usize);
        self.work += of_a_batch((bonds, of_a_bond), points, dimensions);
    }

    /// What may be counted once `seconds` more were spent.
    pub(crate) fn work_after(&self, seconds: f64) -> u64 {
        self.work.saturating_add(operations(1e3 * seconds))
    }

    /// The time that the work counted so far takes, by counting: the same on every machine `[ms]`.
    pub fn work_ms(&self) -> f64 {
        self.work as f64 * OPERATION
    }
}
