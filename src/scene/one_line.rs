//! Names and titles are shown on one line: what would break it, or turn its letters about, is a space.

use super::keys::Scene;

/// A text on one line: control characters, line ends and marks that change the direction of letters become single spaces.
pub(crate) fn one_line(text: &str) -> String {
    let breaks = |letter: char| {
        letter.is_control()
            || matches!(letter, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200e}' | '\u{200f}')
    };
    if !text.contains(breaks) {
        return text.to_owned();
    }
    let words = text.split(breaks).map(str::trim).filter(|words| !words.is_empty());
    words.collect::<Vec<_>>().join(" ")
}

impl Scene {
    /// Puts what is shown of it as a name on one line each.
    pub(super) fn tidy(&mut self) {
        let line = |text: &mut String| *text = one_line(text);
        self.name.iter_mut().for_each(line);
        self.name.take_if(|name| name.is_empty());
        self.beside.iter_mut().filter_map(|entry| entry.title.as_mut()).for_each(line);
        self.groups.iter_mut().filter_map(|group| group.title.as_mut()).for_each(line);
        self.labels.iter_mut().for_each(|label| line(&mut label.text));
        for parameter in &mut self.parameters {
            parameter.label.iter_mut().chain(&mut parameter.unit).for_each(line);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_scene_are_one_line_each() {
        assert_eq!(one_line("a  b, as it was"), "a  b, as it was");
        assert_eq!(one_line("\ttwo\r\nlines\u{1b}[31m\u{202e}x\n"), "two lines [31m x");
        let text = r#"{"wobble": 1, "name": "a\nb", "points": {"position": [[0, 0], [1, 0]]}, "gravity": [0, 0],
            "groups": [{"points": [0, 1], "title": "the\tone"}], "beside": [{"title": "by\neuler"}],
            "parameters": [{"path": "gravity[1]", "min": -1, "max": 1, "label": "down\u0007"}],
            "labels": [{"at": [0, 1], "text": "left\nand right"}]}"#;
        let scene = Scene::parse(text, "x.json").unwrap();
        assert_eq!(scene.name(), "a b");
        assert_eq!(scene.beside[0].title.as_deref(), Some("by euler"));
        assert_eq!(scene.groups[0].title.as_deref(), Some("the one"));
        assert_eq!(scene.named_parameters()[0].label, "down");
        assert_eq!(scene.labels[0].text, "left and right");
        let nameless = Scene::parse(&text.replace("a\\nb", "\\n"), "y.json").unwrap();
        assert_eq!(nameless.name(), "y", "a name of no letters is none");
    }
}
