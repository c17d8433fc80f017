//! Whole pictures: figures whose truth is known, and random ones.

mod figures;
mod robustness;
mod tiny;
