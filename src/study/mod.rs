//! Studies of the methods: what an error costs, with every method and with the baseline; and how fast they are
//! ([`speed`]).
//!
//! ```text
//! problems (scene + truth) --accuracy--> runs --fit--> orders, costs --equal--> ratios to the baseline
//!                                          \--report--> JSON, tables, plots
//! ```
//! A study runs scenes through the same face as the program does; the baseline is a program of its own.

mod accuracy;
mod baseline;
mod equal;
mod error;
mod fit;
mod machine;
mod methods;
mod plot;
pub mod problems;
mod report;
mod rest;
mod run;
mod setting;
mod slides;
pub mod speed;
pub mod stability;
mod tables;
mod targets;
mod tolerance;

pub use accuracy::{MethodReport, ProblemReport, Progress, measure};
pub use equal::{EqualError, Priced};
pub use error::StudyError;
pub use fit::Cost;
pub use machine::{Machine, machine};
pub use problems::{Kind, Problem, Truth, TruthSample, find, problems};
pub use report::{Report, make_folder, ready_folder};
pub use rest::{Settled, settle, softness};
pub use run::{Run, Settings, Work};
pub use setting::tune;
pub use slides::{CircleRow, DecayRow, ObservedOrder, OrderRow, Slides, slides};
pub use targets::{LEVELS, REACHED, TARGETS, Target, target_of};
pub use tolerance::{TOLERANCES, ToleranceReport};
