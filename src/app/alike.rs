//! What gets the same numbers goes together: a command gives all that it names the same.

/// Things by what they get, in the order in which that comes first.
pub(super) fn alike<K: PartialEq, T>(list: impl IntoIterator<Item = (K, T)>) -> Vec<(K, Vec<T>)> {
    let mut groups: Vec<(K, Vec<T>)> = Vec::new();
    for (key, thing) in list {
        match groups.iter_mut().find(|(other, _)| *other == key) {
            Some((_, things)) => things.push(thing),
            None => groups.push((key, vec![thing])),
        }
    }
    groups
}
