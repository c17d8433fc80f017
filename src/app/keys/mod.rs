//! Keys and what they do: one table, which the program shows (F1), docs/window.md prints and the tests compare.

mod groups;
mod table;

use winit::keyboard::{Key, ModifiersState, NamedKey, PhysicalKey};

use super::action::Action;
pub use groups::{Group, Row, found};
pub use table::{TABLE, by_mouse};

/// A key as it is pressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// One without a letter, by its name.
    Named(NamedKey),
    /// The same while Shift is held.
    Shift(NamedKey),
    /// One that writes this, whatever the layout; Shift may be needed for it.
    Writes(&'static str),
    /// The same while Ctrl is held (the command key on a Mac).
    Ctrl(&'static str),
    /// The same while Ctrl and Shift are held.
    CtrlShift(&'static str),
}

/// What some keys do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Binding {
    /// The keys as they are printed.
    pub keys: &'static str,
    /// Each of them.
    pub strokes: &'static [(Stroke, Action)],
    /// What they do.
    pub words: &'static str,
}

/// Which keys are held down beside another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Held {
    /// Ctrl, or its like on a Mac.
    pub command: bool,
    /// Shift.
    pub shift: bool,
    /// Alt.
    pub alt: bool,
}

impl Held {
    /// What the system says is held down.
    pub fn of(held: ModifiersState) -> Self {
        let command = if cfg!(target_os = "macos") { held.super_key() } else { held.control_key() };
        Held { command, shift: held.shift_key(), alt: held.alt_key() }
    }
}

/// Keys that are held down, with what they were pressed for: other keys may be held beside them when they are let go.
#[derive(Clone, Debug, Default)]
pub struct Down(Vec<(PhysicalKey, Action)>);

impl Down {
    /// A key went down.
    pub fn press(&mut self, key: PhysicalKey, action: Action) {
        self.release(key);
        self.0.push((key, action));
    }

    /// A key went up. Returns what it was pressed for.
    pub fn release(&mut self, key: PhysicalKey) -> Option<Action> {
        let place = self.0.iter().position(|(held, _)| *held == key)?;
        Some(self.0.swap_remove(place).1)
    }
}

impl Stroke {
    fn is(self, key: &Key, held: Held) -> bool {
        match (self, key) {
            (Stroke::Named(name), Key::Named(pressed)) => name == *pressed && !held.command,
            (Stroke::Shift(name), Key::Named(pressed)) => name == *pressed && held.shift && !held.command,
            // Where the space bar writes a letter like others.
            (Stroke::Named(NamedKey::Space), Key::Character(text)) => text == " " && !held.command,
            (Stroke::Writes(letter), Key::Character(text)) => !held.command && text.to_lowercase() == letter,
            (Stroke::Ctrl(letter), Key::Character(text)) => {
                held.command && !held.shift && text.to_lowercase() == letter
            }
            (Stroke::CtrlShift(letter), Key::Character(text)) => {
                held.command && held.shift && text.to_lowercase() == letter
            }
            _ => false,
        }
    }
}

/// What a key means, if it means anything.
pub fn action(key: &Key, held: Held) -> Option<Action> {
    let strokes = TABLE.iter().flat_map(|binding| binding.strokes);
    // Where a key means something else with Shift, it means that; elsewhere Shift is nothing to keys with names.
    let is_shift = |stroke: &Stroke| matches!(stroke, Stroke::Shift(_));
    let with_shift = strokes.clone().find(|(stroke, _)| is_shift(stroke) && stroke.is(key, held));
    with_shift.or_else(|| strokes.clone().find(|(stroke, _)| stroke.is(key, held))).map(|&(_, action)| action)
}

/// What the window does by a key that a scene's drives have, while it has none of them: nothing of it is left there.
pub fn taken(key: crate::sim::Key) -> Option<&'static str> {
    let meant = match key.name() {
        "left" => Key::Named(NamedKey::ArrowLeft),
        "right" => Key::Named(NamedKey::ArrowRight),
        "up" => Key::Named(NamedKey::ArrowUp),
        "down" => Key::Named(NamedKey::ArrowDown),
        "space" => Key::Named(NamedKey::Space),
        name => Key::Character(name.into()),
    };
    let is_its = |binding: &&Binding| binding.strokes.iter().any(|(stroke, _)| stroke.is(&meant, Held::default()));
    TABLE.iter().find(is_its).map(|binding| binding.words)
}

/// The keys for an action, as they are printed beside its button.
pub fn keys_of(action: Action) -> Option<&'static str> {
    let binding = TABLE.iter().find(|binding| binding.strokes.iter().any(|&(_, does)| does == action))?;
    let place = binding.strokes.iter().position(|&(_, does)| does == action)?;
    match binding.keys.split(", ").count() == binding.strokes.len() {
        true => binding.keys.split(", ").nth(place),
        false => Some(binding.keys),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::action::{Primitive, Tool};

    const PLAIN: Held = Held { command: false, shift: false, alt: false };
    const CTRL: Held = Held { command: true, ..PLAIN };
    const CTRL_SHIFT: Held = Held { shift: true, ..CTRL };

    fn writes(text: &str, held: Held) -> Option<Action> {
        action(&Key::Character(text.into()), held)
    }

    #[test]
    fn what_is_built_comes_round() {
        let all: Vec<Primitive> =
            std::iter::successors(Some(Primitive::default()), |one| Some(one.next())).take(14).collect();
        assert_eq!((&all[..13], all[13]), (&Primitive::ALL[..], Primitive::default()));
    }

    #[test]
    fn keys_mean_what_the_table_says() {
        assert_eq!(action(&Key::Named(NamedKey::Escape), PLAIN), Some(Action::Cancel));
        assert_eq!(action(&Key::Named(NamedKey::PageDown), PLAIN), Some(Action::NextScene));
        assert_eq!((writes("r", PLAIN), writes("R", PLAIN)), (Some(Action::Reset), Some(Action::Reset)));
        assert_eq!((writes("e", CTRL), writes("o", PLAIN)), (None, None), "Ctrl makes another key of a key");
        assert_eq!((writes("z", CTRL), writes("y", CTRL)), (Some(Action::Undo), Some(Action::Redo)));
        assert_eq!((writes("Z", CTRL_SHIFT), writes("q", CTRL)), (Some(Action::Redo), Some(Action::Quit)));
        assert_eq!((writes("[", PLAIN), writes("{", PLAIN)), (Some(Action::SmallerRegion), Some(Action::Weaker)));
        assert_eq!((writes(" ", PLAIN), writes("u", PLAIN)), (Some(Action::TogglePlay), None));
        assert_eq!(writes("3", PLAIN), Some(Action::Take(Tool::Cut)));
        let shift = Held { shift: true, ..PLAIN };
        let f2 = [PLAIN, shift].map(|held| action(&Key::Named(NamedKey::F2), held));
        assert_eq!(f2, [Some(Action::Screenshot), Some(Action::Clip)]);
        assert_eq!(action(&Key::Named(NamedKey::F1), shift), Some(Action::Help), "Shift is nothing to other keys");
    }

    #[test]
    fn a_key_is_let_go_by_its_place_whatever_else_is_held() {
        let comma = PhysicalKey::Code(winit::keyboard::KeyCode::Comma);
        let mut down = Down::default();
        assert_eq!(down.release(comma), None);
        down.press(comma, Action::Rewind);
        down.press(comma, Action::Rewind);
        assert_eq!(writes("<", CTRL_SHIFT), None, "by what it writes now it would be held for ever");
        assert_eq!((down.release(comma), down.release(comma)), (Some(Action::Rewind), None));
    }

    #[test]
    fn what_drives_take_from_the_window_is_known() {
        let words = |name: &str| taken(crate::sim::Key::of(name).unwrap());
        assert_eq!(words("space"), Some("play or pause"));
        assert!(words("r").is_some_and(|words| words.starts_with("back to the start")));
        assert!(words("3").is_some_and(|words| words.starts_with("the tools")));
        assert_eq!((words("left"), words("d")), (None, None));
        assert!(words("w").is_some_and(|words| words.starts_with("wind")));
    }

    #[test]
    fn no_key_has_two_meanings() {
        let strokes: Vec<_> = TABLE.iter().flat_map(|binding| binding.strokes).collect();
        for (place, (stroke, _)) in strokes.iter().enumerate() {
            assert!(strokes[..place].iter().all(|(other, _)| other != stroke), "{stroke:?}");
        }
    }

    /// A stroke as it is printed.
    fn printed(stroke: Stroke) -> String {
        let upper = |letter: &str| letter.to_uppercase();
        match stroke {
            Stroke::Named(NamedKey::PageUp) => "PgUp".to_owned(),
            Stroke::Named(NamedKey::PageDown) => "PgDn".to_owned(),
            Stroke::Named(NamedKey::Delete) => "Del".to_owned(),
            Stroke::Named(NamedKey::Escape) => "Esc".to_owned(),
            Stroke::Named(name) => format!("{name:?}"),
            Stroke::Shift(name) => format!("Shift+{name:?}"),
            Stroke::Writes("{") => "Shift+[".to_owned(),
            Stroke::Writes("}") => "Shift+]".to_owned(),
            Stroke::Writes(letter) => upper(letter),
            Stroke::Ctrl(letter) => format!("Ctrl+{}", upper(letter)),
            Stroke::CtrlShift(letter) => format!("Ctrl+Shift+{}", upper(letter)),
        }
    }

    #[test]
    fn keys_are_printed_as_they_are_pressed() {
        for binding in TABLE {
            let strokes: Vec<String> = binding.strokes.iter().map(|&(stroke, _)| printed(stroke)).collect();
            let keys: Vec<&str> = binding.keys.split(", ").collect();
            // A comma is a key too.
            let keys = if binding.keys == "," { vec![","] } else { keys };
            assert_eq!(keys, strokes, "{}", binding.words);
        }
    }

    #[test]
    fn the_page_on_the_window_has_the_table() {
        let page = include_str!("../../../docs/window.md");
        let rows: Vec<[&str; 2]> = page
            .lines()
            .skip_while(|line| !line.starts_with("| key |"))
            .skip(2)
            .take_while(|line| line.starts_with('|'))
            .filter_map(|line| {
                let mut cells = line.trim_matches('|').split(" | ").map(str::trim);
                Some([cells.next()?, cells.next()?])
            })
            .collect();
        let keys = TABLE.iter().map(|binding| [binding.keys, binding.words]);
        let expected: Vec<[&str; 2]> = keys.chain(by_mouse()).collect();
        assert_eq!(rows, expected, "the table of docs/window.md is that of src/app/keys/table.rs, row by row");
    }

    #[test]
    fn buttons_name_their_keys() {
        assert_eq!(keys_of(Action::TogglePlay), Some("Space"));
        assert_eq!(keys_of(Action::Redo), Some("Ctrl+Shift+Z"));
        assert_eq!(keys_of(Action::LargerRegion), Some("]"));
        assert_eq!(keys_of(Action::Take(Tool::Hand)), Some("1"));
    }
}
