//! A JSON merge patch.

use serde_json::{Map, Value};

/// Changes `target` by a patch: objects are merged key by key, `null` takes a key away, all else takes the place of what was there.
///
/// Source: P. Hoffman, J. Snell, JSON Merge Patch, RFC 7396 (2014), section 2.
pub(super) fn merge(target: &mut Value, patch: &Value) {
    let Value::Object(changes) = patch else {
        target.clone_from(patch);
        return;
    };
    if !target.is_object() {
        *target = Value::Object(Map::new());
    }
    let Value::Object(keys) = target else { return };
    for (key, value) in changes {
        if value.is_null() {
            keys.remove(key);
        } else {
            merge(keys.entry(key.as_str()).or_insert(Value::Null), value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn keys_are_merged_taken_away_and_replaced() {
        let mut keys = json!({"a": {"b": 1, "c": [1, 2]}, "d": 1});
        merge(&mut keys, &json!({"a": {"b": null, "c": [3], "e": {"f": null}}, "d": {"g": 2}}));
        assert_eq!(keys, json!({"a": {"c": [3], "e": {}}, "d": {"g": 2}}));
        merge(&mut keys, &json!([1]));
        assert_eq!(keys, json!([1]));
    }
}
