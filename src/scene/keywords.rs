//! Words that scenes are looked for by, beside those of their names and captions.

/// Words for one thing, and the scenes that have it, the best first.
struct Topic {
    words: &'static str,
    scenes: &'static [&'static str],
}

const TOPICS: &[Topic] = &[
    Topic {
        words: "pendulum swing swinging",
        scenes: &["constraints", "wrecking-ball", "cradle", "rope-on-cursor", "ragdoll"],
    },
    Topic {
        words: "spring coil oscillator oscillation bungee shock absorber",
        scenes: &["spring-damper", "spring-damper-relative", "relaxation", "penalty"],
    },
    Topic { words: "car vehicle wheel tyre tire drive driving truck road race", scenes: &["soft-car"] },
    Topic { words: "walker robot legs spider insect creature animal muscle walk", scenes: &["walker", "snake"] },
    Topic { words: "snake worm caterpillar crawl", scenes: &["snake"] },
    Topic { words: "water sea ocean swim fish octopus squid float", scenes: &["jellyfish", "brush"] },
    Topic { words: "water liquid fluid rain drops", scenes: &["picture-obstacle", "points"] },
    Topic { words: "rain sand particles gas balls", scenes: &["picture-obstacle", "points", "pegs"] },
    Topic {
        words: "flag curtain banner sail fabric textile towel sheet cloth",
        scenes: &["cloth-wind", "cloth-space", "cloth-ball", "net", "tearable-net", "million-cloth"],
    },
    Topic { words: "wind air breeze blow", scenes: &["cloth-wind"] },
    Topic {
        words: "chain cable string thread whip cord rope",
        scenes: &["rope", "rope-on-cursor", "wrecking-ball", "constraints", "bridge"],
    },
    Topic {
        words: "jelly jello gelatin blob slime pudding gummy soft body squishy",
        scenes: &["jelly", "jelly-stack", "ring", "rim", "maze", "jellyfish"],
    },
    Topic {
        words: "balloon bubble circle disc ball wheel pressure",
        scenes: &["ring", "rim", "pegs", "thousand-rims", "cradle"],
    },
    Topic { words: "doll human person man dummy puppet skeleton stairs body figure", scenes: &["ragdoll"] },
    Topic { words: "cog cogwheel gear machine rigid solid", scenes: &["gear", "picture-obstacle"] },
    Topic { words: "motor engine", scenes: &["soft-car"] },
    Topic { words: "bridge beam truss plank construction crossing", scenes: &["bridge"] },
    Topic { words: "stiff frame brace truss house building", scenes: &["box-two-supports", "box"] },
    Topic { words: "newton collision momentum billiard marbles click clack", scenes: &["cradle"] },
    Topic { words: "trebuchet siege throw launch lever seesaw castle", scenes: &["catapult"] },
    Topic {
        words: "tower stack pile crash demolition destruction destroy knock smash",
        scenes: &["wrecking-ball", "catapult", "jelly-stack", "box"],
    },
    Topic { words: "tear rip break cut hole", scenes: &["tearable-net", "cloth-space", "net", "rope", "image-mesh"] },
    Topic { words: "pinball pachinko plinko galton obstacles", scenes: &["pegs", "picture-obstacle"] },
    Topic { words: "stone rock pebble", scenes: &["pebble", "picture-obstacle"] },
    Topic {
        words: "picture image photo letter drawing",
        scenes: &["image-mesh", "jelly", "maze", "jellyfish", "picture-obstacle"],
    },
    Topic { words: "paint draw drawing sketch canvas", scenes: &["brush"] },
    Topic { words: "3d three dimensions space depth", scenes: &["cloth-space", "cloth-ball"] },
    Topic { words: "orbit planet satellite turn", scenes: &["slide-circle", "phase-portrait"] },
    Topic {
        words: "accuracy error integrator method numerics euler verlet energy",
        scenes: &["slide-circle", "slide-decay", "phase-portrait", "points"],
    },
    Topic { words: "large big huge many performance benchmark", scenes: &["million-cloth", "thousand-rims", "rope"] },
    Topic { words: "graph network", scenes: &["random-graph", "net"] },
];

/// The words of all topics that a scene belongs to.
pub fn keywords(scene: &str) -> impl Iterator<Item = &'static str> {
    TOPICS.iter().filter(move |topic| topic.scenes.contains(&scene)).flat_map(|topic| topic.words.split(' '))
}

/// The place of a scene among those of the first topic that has this word or begins so; `None` where it is in none.
pub fn topic_place(scene: &str, word: &str) -> Option<usize> {
    let mut of_word = TOPICS.iter().filter(|topic| topic.words.split(' ').any(|own| own.starts_with(word)));
    of_word.find_map(|topic| topic.scenes.iter().position(|own| *own == scene))
}

#[cfg(test)]
mod tests {
    use super::super::gallery;
    use super::*;

    #[test]
    fn topics_name_scenes_that_are_there() {
        let names: Vec<&str> = gallery().iter().map(|entry| entry.name).collect();
        for topic in TOPICS {
            assert!(
                topic.words.split(' ').all(|word| word.len() > 1 && word == word.to_lowercase()),
                "{}",
                topic.words
            );
            for scene in topic.scenes {
                assert!(names.contains(scene), "{scene} of “{}”", topic.words);
            }
        }
        // A scene of a source as printed, and one that is its like, is found by its name and its caption.
        let lacks = |name: &&str| !name.ends_with("as-printed") && keywords(name).next().is_none();
        let lacking: Vec<&&str> = names.iter().filter(|name| lacks(name)).collect();
        assert!(lacking.len() <= 1, "{lacking:?}");
    }
}
