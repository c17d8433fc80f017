//! Who has the keyboard: the scene, a field that is written in, or a menu.

use winit::keyboard::{Key, NamedKey};

use super::action::Action;

/// What keys are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keyboard {
    /// Nothing else wants them.
    Scene,
    /// A field: what is typed is written there.
    Field,
    /// A menu, a list or a picker of colours: arrows move in it, Enter chooses, Esc closes it.
    Menu,
}

impl Keyboard {
    /// Of a field that has the focus, or anything in a sheet that has it, and a menu that is open: a menu lies over its field.
    pub(super) fn of((is_writing, is_on_sheet): (bool, bool), has_menu: bool) -> Self {
        match (has_menu, is_writing || is_on_sheet) {
            (true, _) => Keyboard::Menu,
            (false, true) => Keyboard::Field,
            (false, false) => Keyboard::Scene,
        }
    }

    /// Whether the panels hear of a key: Tab would move the focus about them, and the scene's own keys are not for their buttons.
    pub(super) fn tells_panels(self, key: &Key) -> bool {
        self != Keyboard::Scene || !matches!(key, Key::Named(NamedKey::Tab | NamedKey::Space | NamedKey::Enter))
    }

    /// Whether an action is done whose key is pressed: in a field those that close or leave, in a menu those that no menu has.
    pub(super) fn lets(self, action: Action) -> bool {
        match self {
            Keyboard::Scene => true,
            Keyboard::Field => matches!(action, Action::Cancel | Action::Quit | Action::FullScreen | Action::Help),
            Keyboard::Menu => matches!(action, Action::Quit | Action::FullScreen),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::keys::TABLE;

    #[test]
    fn nothing_that_is_typed_into_a_field_or_a_menu_reaches_the_scene() {
        let actions = || TABLE.iter().flat_map(|binding| binding.strokes).map(|(_, action)| *action);
        let let_through = |keyboard: Keyboard| actions().filter(|action| keyboard.lets(*action)).collect::<Vec<_>>();
        assert_eq!(let_through(Keyboard::Scene).len(), actions().count());
        let leaves = [Action::FullScreen, Action::Quit];
        assert_eq!(let_through(Keyboard::Menu), leaves, "Esc closes the menu alone");
        assert_eq!(let_through(Keyboard::Field), [Action::Help, Action::FullScreen, Action::Cancel, Action::Quit]);
    }

    #[test]
    fn a_menu_hears_the_keys_that_choose_in_it_and_buttons_hear_none_of_the_scene() {
        let [enter, arrow] = [NamedKey::Enter, NamedKey::ArrowDown].map(Key::Named);
        let (field, nothing) = ((true, false), (false, false));
        assert!(Keyboard::of(nothing, true).tells_panels(&enter), "a list that dropped down");
        assert!(Keyboard::of(field, false).tells_panels(&enter));
        let scene = Keyboard::of(nothing, false);
        assert!(!scene.tells_panels(&enter) && scene.tells_panels(&arrow));
        assert_eq!(Keyboard::of(field, true), Keyboard::Menu, "a picker of colours with its field");
    }

    #[test]
    fn a_button_of_a_sheet_that_tab_has_reached_hears_enter_and_tab_leads_on() {
        let on_button = Keyboard::of((false, true), false);
        for key in [NamedKey::Enter, NamedKey::Space, NamedKey::Tab].map(Key::Named) {
            assert!(on_button.tells_panels(&key), "{key:?}");
        }
        assert!(!on_button.lets(Action::Finish) && on_button.lets(Action::Cancel));
    }
}
