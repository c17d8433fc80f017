//! What things that are selected have in common.

/// The value of several things that have one each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Common<T> {
    /// All have this.
    One(T),
    /// They differ.
    Mixed,
}

impl<T> Common<T> {
    /// Of some values; `None` of none.
    pub(super) fn of(mut values: impl Iterator<Item = T>) -> Option<Self>
    where
        T: PartialEq,
    {
        let first = values.next()?;
        Some(if values.all(|value| value == first) { Common::One(first) } else { Common::Mixed })
    }

    /// The same, told otherwise.
    pub(super) fn map<U>(self, told: impl FnOnce(T) -> U) -> Common<U> {
        match self {
            Common::One(value) => Common::One(told(value)),
            Common::Mixed => Common::Mixed,
        }
    }
}

impl<T: Default> Default for Common<T> {
    fn default() -> Self {
        Common::One(T::default())
    }
}
