//! Sparse symmetric systems and roots of functions: the same bits on every machine.

pub(crate) mod blocks;
pub(crate) mod elimination;
pub(crate) mod ldl;
pub(crate) mod root;
