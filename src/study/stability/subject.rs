//! What is judged: a scene, led or not, and for how long.

use serde::Serialize;

use crate::history::{Recording, Start};

/// What of a scene may be to blame where it fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// Walls around the world.
    Walls,
    /// Planes.
    Planes,
    /// Boxes and polygons.
    Polygons,
    /// Circles.
    Circles,
    /// Pictures as obstacles.
    Pictures,
    /// A mouse that is moved as by a hand.
    Mouse,
    /// A mouse that is somewhere else in every frame.
    WildMouse,
    /// Pins that are led.
    LedPins,
    /// Commands while it runs.
    Commands,
    /// Steady forces.
    Forces,
    /// Air that moves.
    Wind,
    /// Bonds that keep their lengths.
    Rigid,
    /// Springs that swing faster than a thousand times a second.
    Stiff,
    /// Relaxed bonds.
    Relaxed,
    /// Gravity of 100 m/s^2 or more.
    Heavy,
    /// Bodies that start at 20 m/s or more.
    Fast,
    /// Surfaces that give back all of a blow.
    Elastic,
    /// Chains, skins and joints that resist bending.
    Bending,
    /// Triangles that resist a change of their area.
    Areas,
    /// Bodies that meet.
    Contact,
}

impl Cause {
    /// All.
    pub const ALL: [Cause; 20] = [
        Cause::Walls,
        Cause::Planes,
        Cause::Polygons,
        Cause::Circles,
        Cause::Pictures,
        Cause::Mouse,
        Cause::WildMouse,
        Cause::LedPins,
        Cause::Commands,
        Cause::Forces,
        Cause::Wind,
        Cause::Rigid,
        Cause::Stiff,
        Cause::Relaxed,
        Cause::Heavy,
        Cause::Fast,
        Cause::Elastic,
        Cause::Bending,
        Cause::Areas,
        Cause::Contact,
    ];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Cause::Walls => "walls",
            Cause::Planes => "planes",
            Cause::Polygons => "polygons",
            Cause::Circles => "circles",
            Cause::Pictures => "pictures as obstacles",
            Cause::Mouse => "mouse",
            Cause::WildMouse => "wild mouse",
            Cause::LedPins => "led pins",
            Cause::Commands => "commands",
            Cause::Forces => "steady forces",
            Cause::Wind => "wind",
            Cause::Rigid => "rigid bonds",
            Cause::Stiff => "stiff springs",
            Cause::Relaxed => "relaxed bonds",
            Cause::Heavy => "heavy",
            Cause::Fast => "fast",
            Cause::Elastic => "elastic surfaces",
            Cause::Bending => "bending",
            Cause::Areas => "areas",
            Cause::Contact => "contact",
        }
    }
}

/// A scene to be judged.
#[derive(Clone, Debug)]
pub struct Subject {
    /// What it is called by.
    pub name: String,
    /// Subjects that have the most in common have this in common.
    pub family: String,
    /// Its number in the battery.
    pub case: Option<u64>,
    /// What it has that may be to blame, ascending.
    pub causes: Vec<Cause>,
    /// The scene, and the commands that lead it.
    pub recording: Recording,
    /// How long it runs `[s]`.
    pub duration: f64,
    /// What it owes to rest.
    pub rest: Rest,
    /// The error at its samples that it asks for `[m]`, by the setting that is found for that.
    pub tolerance: Option<f64>,
}

/// What a subject owes to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rest {
    /// Nothing.
    #[default]
    Free,
    /// It starts at rest and has to stay where it is.
    Stays,
    /// It has to be at rest at the end.
    Comes,
}

impl Subject {
    /// A scene of the user's own, judged like the others: as long as it says, ten seconds at the most.
    pub fn of_start(start: &Start) -> Subject {
        let recording = start.recording().clone();
        let said = if start.is_recording() { Some(recording.end()) } else { recording.scene.duration };
        let duration = said.filter(|end| *end > 0.0).unwrap_or(2.0).min(SECONDS);
        let name = recording.scene.name().to_owned();
        let (causes, tolerance) = (super::causes::of(&recording), recording.scene.method.tolerance);
        let family = "own".to_owned();
        Subject { name, family, case: None, causes, recording, duration, rest: Rest::Free, tolerance }
    }
}

/// Longest run of a scene of the user's own `[s]`.
const SECONDS: f64 = 10.0;
