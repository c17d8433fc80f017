//! Words where there is little room: fewer, but whole ones.

/// Words that none of the others ends with: they lead on to what follows.
const LEADING: [&str; 12] = ["a", "at", "its", "is", "long", "more", "of", "than", "the", "this", "to", "while"];

/// Words, then less and less of them: what stands before a colon or a comma, and that without its last words.
pub(super) fn shorter(words: &str) -> Vec<String> {
    let first = words.split([':', ',']).next().unwrap_or_default();
    let parts: Vec<&str> = first.split(' ').collect();
    let less = (1..=parts.len()).rev().filter(|count| !LEADING.contains(&parts[count - 1]));
    std::iter::once(words.to_owned()).chain(less.map(|count| parts[..count].join(" "))).collect()
}

/// The first of these that is no wider than a room `[points]`: where there is no room for words there are fewer, but whole ones.
pub(super) fn that_fits(ui: &egui::Ui, all: impl IntoIterator<Item = String>, room: f32) -> String {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let wide = |words: &String| {
        let galley = ui.painter().layout_no_wrap(words.clone(), font.clone(), egui::Color32::PLACEHOLDER);
        galley.size().x
    };
    all.into_iter().find(|words| wide(words) <= room).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_words_have_no_room_there_are_fewer_of_them_but_whole_ones() {
        for (words, less) in [
            ("paused", &["paused"][..]),
            ("at rest", &["at rest"]),
            ("paused while this is open", &["paused while this is open", "paused"]),
            ("replay: press to take over", &["replay"]),
            ("34 % of its speed: 20 ms of work a frame", &["34 % of its speed", "34 %", "34"]),
            ("computed more roughly, to keep up", &["computed more roughly", "computed"]),
            ("computing a long step", &["computing a long step", "computing"]),
        ] {
            let all = shorter(words);
            assert_eq!(
                (all[0].as_str(), &all[1..]),
                (words, &less.iter().map(|&less| less.to_owned()).collect::<Vec<_>>()[..])
            );
        }
        let mut found = Vec::new();
        let context = egui::Context::default();
        let mut output = context.run_ui(egui::RawInput::default(), |ui| {
            found = [1000.0, 60.0, 1.0].map(|room| that_fits(ui, shorter("paused while this is open"), room)).to_vec();
        });
        output.textures_delta.clear();
        assert_eq!(found, ["paused while this is open", "paused", ""]);
    }
}
