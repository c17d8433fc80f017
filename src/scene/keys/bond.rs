//! The keys of a bond.

use super::drive::DriveKeys;
use super::macros::{names, object};

names! {
    /// How a bond resists.
    KindName: "a kind of bond" {
        /// |d| = rest.
        Rigid = "rigid",
        /// A force.
        Spring = "spring",
        /// Swept.
        Relaxed = "relaxed",
    }
}

names! {
    /// On which side of its rest length a bond acts.
    LimitName: "a limit" {
        /// Always.
        Both = "both",
        /// When longer.
        Max = "max",
        /// When shorter.
        Min = "min",
    }
}

object! {
    /// A bond between two points. Points are counted over the scene: the explicit ones, then body by body.
    #[derive(Copy)]
    BondKeys: "a bond: an object with the keys `a` and `b`" {
        required {
            /// Index of one end.
            a: u32,
            /// Index of the other end, not the same.
            b: u32,
        }
        optional {
            /// How it resists: rigid if not said.
            kind: KindName,
            /// Rest length `[m]`, >= 0; the distance at the start if not said, and 0 is a weld.
            rest: f64,
            /// Of a spring `[N/m]`, >= 0.
            stiffness: f64,
            /// Of a spring, in place of its stiffness: 1/stiffness `[m/N]`, >= 0, where 0 is rigid. Of a rigid bond:
            /// above 0 it is a spring.
            compliance: f64,
            /// Of a spring, in place of its stiffness: that times its rest length `[N]`, E A of a bar: the force at a strain of 1. Then pieces
            /// of one bar, however short, have the same.
            axial_stiffness: f64,
            /// Of a spring `[N s/m]`, >= 0: 0 if not said.
            damping: f64,
            /// Of a relaxed bond: the share of its error that a sweep takes away `[1]`, in (0, 1]; 1 if not said.
            relaxation: f64,
            /// Of a relaxed bond: largest correction of one sweep, as a ratio `[1]`, > 0; none if not said.
            max_correction: f64,
            /// Strain above which it is gone `[1]`, > 0; never if not said.
            break_strain: f64,
            /// On which side of its rest length it acts: both if not said.
            limit: LimitName,
            /// What its rest length follows: a muscle. Of a spring or a rigid bond that has a length and acts both ways.
            drive: DriveKeys,
        }
    }
}

impl BondKeys {
    /// A rigid bond between two points at their distance.
    pub fn new(a: u32, b: u32) -> Self {
        BondKeys {
            a,
            b,
            kind: None,
            rest: None,
            stiffness: None,
            compliance: None,
            axial_stiffness: None,
            damping: None,
            relaxation: None,
            max_correction: None,
            break_strain: None,
            limit: None,
            drive: None,
        }
    }
}
