//! Inner loops over many bonds, in vectors of numbers. They know slices, not worlds.
//!
//! One source serves `f32` and `f64`, plane and space, and every instruction set ([`level`]). Lanes never exchange
//! numbers, so that the same operations are done on every number whatever the width of a vector: the bits are the same.

pub(crate) mod cells;
pub(crate) mod crowd;
pub(crate) mod lanes;
pub(crate) mod law;
pub(crate) mod level;
pub(crate) mod links;
pub(crate) mod mesh;
pub(crate) mod nodes;
pub(crate) mod pair;
pub(crate) mod path;
pub(crate) mod rows;
pub(crate) mod split;
pub(crate) mod store;
#[cfg(test)]
mod tests;
pub(crate) mod turn;
