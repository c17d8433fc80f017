//! Which scenes of the gallery a search finds, and what it may have meant where it finds none.

use crate::scene::{EMPTY, Entry, gallery, keywords, topic_place};

/// How like a word must be to one that scenes are found by, to be offered in its place `[1]`.
const ALIKE: f64 = 0.82;
/// So many words are offered at most.
const OFFERED: usize = 4;
/// Of shorter words the last letter is no plural's.
const SINGULAR: usize = 4;
/// What there is, in words that scenes are found by.
const THINGS: [&str; 10] =
    ["jelly", "rope", "cloth", "spring", "pendulum", "car", "walker", "bridge", "gear", "picture"];

/// The names of the scenes that a search finds, in their order.
pub(in crate::app) fn names(search: &str) -> Vec<&'static str> {
    found(search).iter().map(|entry| entry.name).collect()
}

/// The scenes in whose words all words of a search are: first the one that is called so, then those whose names begin so or hold them, then
/// those whose captions do, then those that are of such a topic.
pub(super) fn found(search: &str) -> Vec<&'static Entry> {
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    let wanted = words.join(" ");
    let rank = |entry: &Entry| {
        let names = [entry.name, entry.title].map(str::to_lowercase);
        let text = [entry.name, entry.title, entry.description, entry.to_try].join(" ").to_lowercase();
        let is_in = |text: &str, word: &str| text.contains(word) || text.contains(singular(word));
        let has_all = |text: &str| words.iter().all(|word| is_in(text, word));
        let of_topic = |word: &str| topic_place(entry.name, word).or_else(|| topic_place(entry.name, singular(word)));
        let topics = || words.iter().map(|word| of_topic(word).or_else(|| is_in(&text, word).then_some(OF_CAPTION)));
        match () {
            () if names.contains(&wanted) => Some((0, 0)),
            () if names.iter().any(|name| name.starts_with(&wanted)) => Some((1, 0)),
            () if names.iter().any(|name| has_all(name)) => Some((2, 0)),
            () => topics().sum::<Option<usize>>().map(|place| (3, place)),
        }
    };
    let mut found: Vec<_> = all().filter_map(|entry| Some((rank(entry)?, entry))).collect();
    // Loops with the faults of their sources look broken to whoever does not look for them: where nothing is looked for, they come last.
    let is_printed = |entry: &Entry| words.is_empty() && entry.name.ends_with("as-printed");
    found.sort_by_key(|(rank, entry)| (*rank, is_printed(entry)));
    found.into_iter().map(|(_, entry)| entry).collect()
}

/// All that can be opened here: the scenes of the gallery, then an empty one.
fn all() -> impl Iterator<Item = &'static Entry> {
    gallery().iter().chain([&EMPTY])
}

/// What a caption alone names comes after the scenes of a topic.
const OF_CAPTION: usize = 100;

/// "springs" is looked for as "spring" too.
fn singular(word: &str) -> &str {
    if word.len() > SINGULAR { word.strip_suffix('s').unwrap_or(word) } else { word }
}

/// Where a search finds nothing: the words that are most like one of its own and find something, and whether there are any; else what there is.
pub(super) fn instead(search: &str) -> (bool, Vec<&'static str>) {
    let names = || all().flat_map(|entry| entry.name.split('-').chain(keywords(entry.name)));
    let mut alike: Vec<(f64, &'static str)> = Vec::new();
    for word in search.split_whitespace().map(str::to_lowercase) {
        for own in names().filter(|own| own.len() > 2) {
            let like = strsim::jaro_winkler(&word, own);
            if like >= ALIKE && !alike.iter().any(|(_, other)| *other == own) {
                alike.push((like, own));
            }
        }
    }
    alike.sort_by(|a, b| b.0.total_cmp(&a.0));
    match alike.is_empty() {
        true => (false, THINGS.to_vec()),
        false => (true, alike.into_iter().take(OFFERED).map(|(_, word)| word).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(search: &str) -> Option<&'static str> {
        names(search).first().copied()
    }

    #[test]
    fn a_search_finds_words_anywhere_in_any_order() {
        let all = found("");
        assert_eq!(all.len(), gallery().len() + 1, "and an empty one");
        let printed: Vec<bool> = all.iter().map(|entry| entry.name.ends_with("as-printed")).collect();
        assert!(printed.is_sorted() && printed.contains(&true), "loops as they are printed come last");
        assert_eq!(first("ROPE"), Some("rope"), "its own name before others' words");
        assert_eq!(first("shuffled rim source"), Some("rim-relaxed"));
        assert!(found("no such scene at all").is_empty());
    }

    #[test]
    fn what_a_newcomer_looks_for_is_found_by_words_that_no_caption_has() {
        for (word, scene) in [
            ("pendulum", "constraints"),
            ("Pendulums", "constraints"),
            ("swing", "constraints"),
            ("springs", "spring-damper"),
            ("spring", "spring-damper"),
            ("gear", "gear"),
            ("cogwheel", "gear"),
            ("jello", "jelly"),
            ("vehicle", "soft-car"),
            ("car", "soft-car"),
            ("water", "jellyfish"),
            ("bridge", "bridge"),
            ("chain", "rope"),
            ("flag", "cloth-wind"),
            ("robot", "walker"),
            ("car wheel", "soft-car"),
            ("empty", "empty"),
            ("blank", "empty"),
            ("sandbox", "empty"),
            ("dominoes", "wrecking-ball"),
            ("double pendulum", "constraints"),
            ("trampoline", "net"),
            ("hammock", "net"),
            ("sphere", "ring"),
            ("cube", "box-two-supports"),
            ("rubber", "jelly"),
            ("slinky", "spring-damper"),
            ("solar system", "slide-circle"),
            ("explosion", "wrecking-ball"),
            ("crane", "wrecking-ball"),
            ("cannon", "catapult"),
            ("ramp", "soft-car"),
            ("hinge", "ragdoll"),
            ("football", "ring"),
            ("bouncing", "ring"),
            ("snow", "picture-obstacle"),
            ("text", "image-mesh"),
            ("dog", "walker"),
            ("boat", "cloth-wind"),
            ("guitar", "rope"),
            ("wood", "box-two-supports"),
            ("game", "catapult"),
            ("pillow", "jelly"),
            ("gravity", "jelly"),
        ] {
            assert_eq!(first(word), Some(scene), "{word}: {:?}", names(word));
        }
    }

    #[test]
    fn where_nothing_is_found_words_that_find_something_are_offered() {
        for (wrong, right) in [("pendelum", "pendulum"), ("brigde", "bridge"), ("curtian", "curtain")] {
            assert!(found(wrong).is_empty());
            let (is_alike, words) = instead(wrong);
            assert!(is_alike && words[0] == right, "{wrong}: {words:?}");
        }
        let (is_alike, words) = instead("xyzzy");
        assert!(!is_alike);
        assert!(words.iter().all(|word| !found(word).is_empty()), "{words:?}");
    }
}
