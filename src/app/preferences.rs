//! What the user prefers, kept from one start to the next.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::trailing::TrailSettings;
use crate::output;
use crate::render::Palette;

/// Its file in the folder for what is kept between two starts.
const FILE: &str = "preferences.json";

/// A palette as its file has it.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Palette", rename_all = "lowercase")]
enum PaletteName {
    Dark,
    Light,
}

/// All of it. What a file does not say, or says in words of another version, is as it is at first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Preferences {
    /// The colours of panels and world.
    #[serde(with = "PaletteName")]
    pub(super) palette: Palette,
    /// How many trails points have, and how long they last.
    pub(super) trails: TrailSettings,
}

impl Preferences {
    /// Those in a folder; the first ones where there are none that can be read.
    pub(super) fn load(folder: &Path) -> Self {
        let text = std::fs::read_to_string(folder.join(FILE)).unwrap_or_default();
        let found: Preferences = serde_json::from_str(&text).unwrap_or_default();
        Preferences { trails: found.trails.kept(), ..found }
    }

    /// Keeps them in a folder, which is made if it is not there.
    ///
    /// Errors: in words, what cannot be written.
    pub(super) fn save(self, folder: &Path) -> Result<(), String> {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let text = serde_json::to_string(&self).map_err(|error| error.to_string())?;
        output::replace(&folder.join(FILE), |file| file.write_all(text.as_bytes())).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_trails_that_nobody_could_set_are_not_taken_from_a_file() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(FILE), r#"{"trails": {"most": 4000000000, "length": -1}}"#).unwrap();
        let trails = Preferences::load(folder.path()).trails;
        assert_eq!(trails, TrailSettings { most: TrailSettings::MOST, length: TrailSettings::LENGTHS[0] });
    }

    #[test]
    fn what_is_preferred_is_there_at_the_next_start_and_a_broken_file_is_as_none() {
        let folder = tempfile::tempdir().unwrap();
        let own = folder.path().join("not there yet");
        assert_eq!(Preferences::load(&own), Preferences::default());
        let trails = TrailSettings { most: 20, length: 6.5 };
        let light = Preferences { palette: Palette::Light, trails };
        light.save(&own).unwrap();
        assert_eq!(Preferences::load(&own), light);
        for broken in ["", "[]", r#"{"palette": "mauve"}"#] {
            std::fs::write(own.join(FILE), broken).unwrap();
            assert_eq!(Preferences::load(&own), Preferences::default(), "{broken}");
        }
        std::fs::write(own.join(FILE), r#"{"palette": "light", "of a later version": 3}"#).unwrap();
        assert_eq!(Preferences::load(&own).palette, light.palette);
    }
}
