//! The sections of the settings: what the scene is about first, then in the order of use.

use egui::{Slider, Ui};

use super::super::{Facts, Wish, parameters, ranged, ticks};
use super::{Sink, fields, labels, push, time};
use crate::app::action::Action;
use crate::app::trailing::TrailSettings;
use crate::render::Palette;
use crate::scene::Parameter;

/// A few settings that belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    /// The numbers that the scene names.
    Scene,
    Gravity,
    Bodies,
    Push,
    Air,
    Walls,
    Method,
    /// How fast it is played, and where it ends.
    Time,
    /// How all scenes look.
    Colors,
    Trails,
    /// The words that stand in the world.
    Labels,
}

/// All of them, in the order of use.
const ALL: [Section; 11] = [
    Section::Scene,
    Section::Gravity,
    Section::Bodies,
    Section::Push,
    Section::Air,
    Section::Walls,
    Section::Method,
    Section::Time,
    Section::Colors,
    Section::Trails,
    Section::Labels,
];

/// What a caption that sends one here calls the settings.
const SETTINGS: &str = "settings";

impl Section {
    /// What is looked for when it is meant.
    fn words(self) -> &'static [&'static str] {
        match self {
            Section::Scene => &["this scene"],
            Section::Gravity => &["gravity", "weight", "down", "m/s²"],
            Section::Bodies => &[
                "bodies",
                "meet",
                "collide",
                "contact",
                "collisions",
                "friction",
                "restitution",
                "bounce",
                "areas",
                "resist",
                "skin",
                "thickness",
            ],
            Section::Push => {
                &["push", "mouse", "strength", "radius", "reach", "region", "round", "square", "falls off", "smooth"]
            }
            Section::Air => &["air", "drag", "wind", "turbulence", "gusts", "seed"],
            Section::Walls => {
                &["walls", "floor", "left", "right", "top", "back", "front", "friction", "restitution", "bounce"]
            }
            Section::Method => &[
                "method",
                "solver",
                "substep",
                "sweeps",
                "iterations",
                "order",
                "seed of the order",
                "precision",
                "bits",
                "tolerance",
                "stretch of rigid bonds",
                "strain of rods",
                "work in a frame, at most",
                "budget",
                "sleep",
                "asleep",
                "rest",
            ],
            Section::Time => &["time", "rate", "pace", "duration", "ends"],
            Section::Colors => {
                &["colours", "colors", "dark", "light", "palette", "theme", "look", "grid", "numbers", "axes"]
            }
            Section::Trails => &["trails", "paths", "points", "number", "length"],
            Section::Labels => &["labels", "words", "text", "captions"],
        }
    }

    /// Whether a caption that speaks of the settings means it.
    fn is_named(self, caption: &str) -> bool {
        let words = match self {
            // What the scene names stands first anyway; colours and trails belong to none.
            Section::Scene | Section::Time | Section::Colors | Section::Trails | Section::Labels => return false,
            Section::Gravity => &["gravity"][..],
            Section::Bodies => &["meet each other", "collide", "areas"],
            Section::Push => &["push of the mouse"],
            Section::Air => &["wind", "drag rate", "turbulence"],
            Section::Walls => &["walls"],
            Section::Method => &["sweeps", "substep", "solver", "method"],
        };
        words.iter().any(|word| caption.contains(word))
    }

    /// Whether the world has any of it.
    fn is_there(self, facts: &Facts) -> bool {
        let (settings, scene) = (&facts.settings, &facts.settings.scene);
        match self {
            Section::Scene => settings.parameters.iter().any(|(_, value)| value.is_some()),
            Section::Gravity => scene.gravity.is_some(),
            Section::Bodies => scene.contact.is_some() || facts.dimensions == 2 && scene.areas.is_some(),
            Section::Push => true,
            Section::Air => scene.drag_rate.is_some() && scene.wind.is_some(),
            Section::Walls => scene.bounds.is_some(),
            Section::Method => scene.method.is_some(),
            Section::Time => settings.clock.is_some(),
            Section::Colors | Section::Trails | Section::Labels => true,
        }
    }

    /// Whether what is looked for is in its words.
    fn has(self, facts: &Facts, wanted: &str) -> bool {
        let is_in = |text: &str| text.to_lowercase().contains(wanted);
        let labels = || facts.settings.parameters.iter().any(|(Parameter { label, .. }, _)| is_in(label));
        self.words().iter().any(|word| is_in(word)) || self == Section::Scene && labels()
    }

    pub(super) fn show(self, ui: &mut Ui, facts: &Facts, sink: &mut Sink<'_>) {
        let (settings, scene) = (&facts.settings, &facts.settings.scene);
        match self {
            Section::Scene => parameters::show(ui, &settings.parameters, scene, sink),
            Section::Gravity => scene.gravity.iter().for_each(|g| fields::of_gravity(ui, *g, sink)),
            Section::Bodies => {
                scene.contact.iter().for_each(|contact| fields::of_contact(ui, *contact, sink));
                if let Some(areas) = scene.areas.filter(|_| facts.dimensions == 2) {
                    fields::of_areas(ui, (areas, scene.contact.flatten().is_some()), sink);
                }
            }
            Section::Push => push::show(ui, facts, sink),
            Section::Air => {
                if let (Some(drag_rate), Some(wind)) = (scene.drag_rate, scene.wind) {
                    fields::of_air(ui, drag_rate, wind, sink);
                }
            }
            Section::Walls => {
                scene.bounds.iter().for_each(|walls| fields::of_walls(ui, walls.as_ref(), facts.new_walls, sink));
            }
            Section::Method => scene.method.iter().for_each(|method| fields::of_method(ui, method, facts, sink)),
            Section::Time => settings.clock.iter().for_each(|clock| time::show(ui, *clock, sink)),
            Section::Colors => of_colors(ui, facts, sink),
            Section::Trails => of_trails(ui, facts, sink),
            Section::Labels => labels::show(ui, settings, sink),
        }
    }
}

/// The sections in whose words all words of a search are: what the scene names and what its caption sends one to stand first.
pub(super) fn found(facts: &Facts, search: &str) -> Vec<Section> {
    let wanted: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    let caption = facts.caption.map(|lines| lines.join(" ").to_lowercase()).filter(|words| words.contains(SETTINGS));
    let mut found: Vec<Section> = ALL
        .into_iter()
        .filter(|section| section.is_there(facts) && wanted.iter().all(|word| section.has(facts, word)))
        .collect();
    let is_named = |section: &Section| caption.as_deref().is_some_and(|caption| section.is_named(caption));
    // A stable order: those that are named, then the others, each as they are used.
    found.sort_by_key(|section| *section != Section::Scene && !is_named(section));
    found
}

fn of_colors(ui: &mut Ui, facts: &Facts, sink: &mut Sink<'_>) {
    ui.strong("Colours");
    ui.horizontal(|ui| {
        for (palette, name) in [(Palette::Dark, "dark"), (Palette::Light, "light")] {
            let said = super::described("of panels and world, kept for the next start", Action::Palette);
            let is_on = facts.palette == palette;
            if ticks::radio(ui, is_on, name).on_hover_text(said).clicked() && !is_on {
                sink.wishes.push(Wish::Act(Action::Palette));
            }
        }
    });
    let mut is_shown = facts.look.has_grid;
    let said = super::described("metres along the lower and the left edge", Action::ToggleGrid);
    if ticks::check(ui, &mut is_shown, "grid and its numbers").on_hover_text(said).changed() {
        sink.wishes.push(Wish::Act(Action::ToggleGrid));
    }
}

fn of_trails(ui: &mut Ui, facts: &Facts, sink: &mut Sink<'_>) {
    let (mut is_on, before) = facts.trails;
    let mut to = before;
    ui.strong("Trails");
    let said =
        super::described("where points have been: those that are probed or selected first", Action::ToggleTrails);
    if ticks::check(ui, &mut is_on, "trails of points").on_hover_text(said).changed() {
        sink.wishes.push(Wish::Act(Action::ToggleTrails));
    }
    ui.spacing_mut().slider_width = 96.0;
    ui.add_enabled_ui(is_on, |ui| {
        let most = Slider::new(&mut to.most, 1..=TrailSettings::MOST).logarithmic(true).text("points");
        ranged::slider(ui, most, 1.0..=TrailSettings::MOST as f64, "");
        let [shortest, longest] = TrailSettings::LENGTHS;
        let length = Slider::new(&mut to.length, shortest..=longest).logarithmic(true).max_decimals(1);
        ranged::slider(ui, length.suffix(" s").text("long"), shortest..=longest, " s");
    });
    if to != before {
        sink.wishes.push(Wish::Trails(to));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::panels::Settings;
    use crate::scene::gallery;

    fn facts(name: &str) -> Facts {
        let entry = gallery().iter().find(|entry| entry.name == name).unwrap();
        let scene = entry.scene().unwrap().world(None).unwrap().settings();
        let settings = Settings { scene, push: Some([20.0, 1.0]), ..Settings::default() };
        Facts { settings, dimensions: 2, caption: Some([entry.description, entry.to_try]), ..Facts::default() }
    }

    #[test]
    fn what_a_caption_sends_one_to_stands_first() {
        let sent: Vec<&str> = gallery()
            .iter()
            .filter(|entry| entry.to_try.contains("settings") && entry.to_try.contains("sweeps"))
            .map(|entry| entry.name)
            .collect();
        assert!(!sent.is_empty(), "no caption sends one to the sweeps any more");
        for name in sent {
            assert_eq!(found(&facts(name), "")[0], Section::Method, "{name}");
        }
        assert_eq!(found(&facts("jelly"), "")[0], Section::Gravity, "else in the order of use");
    }

    #[test]
    fn a_search_finds_sections_by_any_of_their_words() {
        let facts = facts("jelly");
        assert_eq!(found(&facts, "Sweeps"), [Section::Method]);
        assert_eq!(found(&facts, "wind"), [Section::Air]);
        assert_eq!(
            (found(&facts, "seed"), found(&facts, "grid")),
            (vec![Section::Air, Section::Method], vec![Section::Colors])
        );
        assert_eq!(found(&facts, "friction"), [Section::Bodies, Section::Walls]);
        assert_eq!(found(&facts, "light"), [Section::Colors]);
        assert_eq!(found(&facts, "trails"), [Section::Trails]);
        assert_eq!(found(&facts, "labels"), [Section::Labels]);
        assert!(found(&facts, "no such thing").is_empty());
        assert!(found(&facts, " ").len() >= 7);
    }
}
