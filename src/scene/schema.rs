//! The JSON Schema of the scene file, from the types that read it.

use schemars::transform::{Transform, transform_subschemas};
use schemars::{Schema, generate::SchemaSettings};
use serde_json::Value;

use super::keys::Scene;

/// A JSON Schema (draft 2020-12) of the scene file, for editors that check and complete.
///
/// It holds keys and types. What excludes what, and ranges that need other keys, [`Scene::parse`] alone knows.
pub fn schema() -> Value {
    SchemaSettings::draft2020_12().with_transform(NoNull).into_generator().into_root_schema_for::<Scene>().to_value()
}

/// Takes `null` out: an optional key may be missing, and where it is there it has a value.
#[derive(Clone, Debug)]
struct NoNull;

impl Transform for NoNull {
    fn transform(&mut self, schema: &mut Schema) {
        if let Some(Value::Array(types)) = schema.get_mut("type") {
            types.retain(|name| name != "null");
            if let [only] = &types[..] {
                let only = only.clone();
                schema.insert("type".to_owned(), only);
            }
        }
        let null = serde_json::json!({ "type": "null" });
        if let Some(Value::Array(choices)) = schema.get_mut("anyOf") {
            choices.retain(|choice| choice != &null);
            if let [Value::Object(only)] = &choices[..] {
                let only = only.clone();
                schema.remove("anyOf");
                for (key, value) in only {
                    schema.insert(key, value);
                }
            }
        }
        transform_subschemas(self, schema);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn the_schema_knows_every_key_and_no_null() {
        let schema = schema();
        let text = schema.to_string();
        assert!(!text.contains("\"null\""), "{text}");
        let keys = schema["properties"].as_object().unwrap();
        for key in ["wobble", "points", "bonds", "bodies", "method", "view", "samples"] {
            assert!(keys.contains_key(key), "{key}");
        }
        assert_eq!(schema["required"], serde_json::json!(["wobble"]));
        assert_eq!(schema["additionalProperties"], false);
        let obstacle = &schema["$defs"]["ObstacleKeys"]["properties"];
        assert!(obstacle.get("box").is_some(), "{obstacle}");
        let solver = &schema["$defs"]["SolverName"]["enum"];
        assert!(solver.as_array().unwrap().contains(&"blanes-moan-4".into()));
    }
}
