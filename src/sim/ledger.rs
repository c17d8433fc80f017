//! The ledger of a world: where its energy came from, where it went, and what the method itself made or lost.
//!
//! ```text
//! energy now - energy at the start = brought - taken + left over
//! ```
//!
//! Energy is kinetic + springs', angles' and areas' + gravity's. What mouse, grab, led pins, forces, drives, wind, commands and parting brought, and what dampers, drag, friction,
//! impacts and breaking bonds took, are line integrals of their forces along the ways of the points, and changes of velocities
//! where these change at once. What is left over is the method's own error.

mod judge;

pub use judge::{LOSS_TIME, MOST_GAIN, MOST_LOSS, Verdict, judge};

/// Works and losses since a world began `[J]`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Book {
    /// Work of the mouse force: the integral of m a . v.
    pub mouse: f64,
    /// Work of a grab: the integral of its force times the velocity of what it holds.
    pub grab: f64,
    /// Work at pins that are led along tracks: what holds them times their velocity.
    pub pins: f64,
    /// Work of constant forces and torques: the integral of their force times the velocity of each point.
    pub forces: f64,
    /// Work of drives: of muscles the integral of stiffness (moved rest - rest) times the rate of the length, of rigid ones that of their
    /// tension times the rate of the rest length, of motors and servos that of their torque times the rate of the angle.
    pub drives: f64,
    /// Work of the air that moves: the integral of m drag_rate u . v, u its velocity where the point is. What air at rest would take is
    /// [`Book::drag`].
    pub wind: f64,
    /// What commands changed: points and bonds that came and went, velocities that were set.
    pub commands: f64,
    /// What the live step made, or took, as it parted bodies that began in an obstacle, in each other or in themselves, and opened triangles that were inside out: places that no forces
    /// lead to. Below 0 it took.
    pub parting: f64,
    /// Taken by dampers: the integral of c u^2, u the rate of a bond's length (at rest length 0 the whole relative velocity).
    pub dampers: f64,
    /// Taken by drag: the integral of m drag_rate v^2.
    pub drag: f64,
    /// Taken by friction: its force times the way along the surface, and in impacts what it changes of m v^2/2.
    pub friction: f64,
    /// Taken by impacts with a restitution below 1, by bonds that get taut with a jerk, and in the live step by joints at the ends of their ranges
    /// and triangles that are crushed: the change of m v^2/2. A point that hits at v_n across the surface loses (1 - restitution^2) m v_n^2/2.
    pub impacts: f64,
    /// Springs' energy that went with bonds that broke.
    pub breaks: f64,
    /// Taken by sweeps over relaxed bonds, net of what they gave back: the impulses of their corrections times the velocities that they change. Below 0 they
    /// made energy, which explains nothing: they have none to give.
    pub relaxation: f64,
    /// Substeps in which the work at led pins could not be told from the method's own error: large bodies of rigid bonds with
    /// pins that go different ways.
    pub untold: u64,
}

impl Book {
    /// What came from outside `[J]`.
    pub fn brought(&self) -> f64 {
        self.mouse
            + self.grab
            + self.pins
            + self.forces
            + self.drives
            + self.wind
            + self.commands
            + self.parting.max(0.0)
    }

    /// What is explained of what went `[J]`.
    pub fn taken(&self) -> f64 {
        let others = self.relaxation.max(0.0) + (-self.parting).max(0.0);
        self.dampers + self.drag + self.friction + self.impacts + self.breaks + others
    }

    /// Adds `share` times the works of another.
    pub(crate) fn add(&mut self, other: &Book, share: f64) {
        self.mouse += share * other.mouse;
        self.grab += share * other.grab;
        self.pins += share * other.pins;
        self.forces += share * other.forces;
        self.drives += share * other.drives;
        self.wind += share * other.wind;
        self.commands += share * other.commands;
        self.parting += share * other.parting;
        self.dampers += share * other.dampers;
        self.drag += share * other.drag;
        self.friction += share * other.friction;
        self.impacts += share * other.impacts;
        self.breaks += share * other.breaks;
        self.relaxation += share * other.relaxation;
        self.untold += other.untold;
    }
}

/// Energies of a state `[J]`, of the points that are not pinned.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// The sum of m v^2/2.
    pub kinetic: f64,
    /// The sum of stiffness (|d| - rest)^2/2 over springs that act.
    pub springs: f64,
    /// Of angles that are held by springs, and of stops of joints that are springs.
    pub angles: f64,
    /// The sum of stiffness (area - rest)^2/(2 rest) over triangles whose areas resist.
    pub areas: f64,
    /// Of planes that push by depth: the sum of stiffness depth^2/2.
    pub surfaces: f64,
    /// The sum of -m g . x: 0 at the origin.
    pub gravity: f64,
}

impl Energies {
    /// All of them.
    pub fn sum(&self) -> f64 {
        self.kinetic + self.elastic() + self.gravity
    }

    /// What is stored in springs, angles, areas and surfaces `[J]`.
    pub fn elastic(&self) -> f64 {
        self.springs + (self.angles + self.areas) + self.surfaces
    }
}

/// The ledger at one time.
///
/// Accuracy: line integrals along cubics through the places and velocities at both ends of each part of a substep, by Simpson's rule: of
/// order 4; of large bodies by the midpoint rule over their substeps: of order 2. An impact that the sample time falls into shows
/// for one substep in the kinetic energy of large bodies, whose velocities are means over it: judge by medians, as [`judge()`] does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Time `[s]`.
    pub time: f64,
    /// The energies now.
    pub now: Energies,
    /// Energy at the start `[J]`.
    pub start: f64,
    /// Works and losses since then.
    pub book: Book,
    /// The largest kinetic energy so far, looked at after every step `[J]`.
    pub most_kinetic: f64,
    /// What all that can move would have at a speed that nobody sees, 1 cm/s, or at what free fall brings in 1/60 s, if that is more `[J]`.
    pub unseen: f64,
    /// What rounding alone may make of the energy `[J]`.
    pub rounding: f64,
}

impl Ledger {
    /// Energy now less what it was and what came from outside `[J]`: above 0 it came from nowhere.
    pub fn excess(&self) -> f64 {
        self.now.sum() - self.start - self.book.brought()
    }

    /// What neither works nor losses explain `[J]`: the method's own error.
    pub fn left_over(&self) -> f64 {
        self.excess() + self.book.taken()
    }
}

/// A world's ledger as it goes on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Totals {
    pub(crate) start: f64,
    pub(crate) book: Book,
    pub(crate) most_kinetic: f64,
    pub(crate) unseen: f64,
}

impl Totals {
    /// The ledger at a time `[s]` with these energies; numbers have the rounding `epsilon`.
    pub(crate) fn at(&self, time: f64, now: Energies, epsilon: f64) -> Ledger {
        // Energies are sums of many terms of either sign: a few hundred roundings of the largest.
        let size = now.kinetic.abs() + now.elastic().abs() + now.gravity.abs() + self.start.abs();
        Ledger {
            time,
            now,
            start: self.start,
            book: self.book,
            most_kinetic: self.most_kinetic.max(now.kinetic),
            unseen: self.unseen,
            rounding: 256.0 * epsilon * size,
        }
    }
}
