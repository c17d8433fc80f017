//! Words that scenes are looked for by, beside those of their names and captions.

/// Words for one thing, and the scenes that have it, the best first.
struct Topic {
    words: &'static str,
    scenes: &'static [&'static str],
}

const TOPICS: &[Topic] = &[
    Topic { words: "empty blank nothing new start scratch sandbox own void", scenes: &["empty"] },
    Topic {
        words: "pendulum swing swinging double chaos chaotic clock",
        scenes: &["constraints", "wrecking-ball", "cradle", "rope-on-cursor", "ragdoll"],
    },
    Topic {
        words: "spring coil oscillator oscillation vibration resonance bungee slinky elastic shock absorber",
        scenes: &["spring-damper", "spring-damper-relative", "relaxation", "penalty"],
    },
    Topic { words: "car vehicle wheel tyre tire drive driving truck road race", scenes: &["soft-car"] },
    Topic {
        words: "walker robot legs spider insect creature animal dog cat muscle walk",
        scenes: &["walker", "snake"],
    },
    Topic { words: "snake worm caterpillar crawl", scenes: &["snake"] },
    Topic { words: "water sea ocean swim fish octopus squid float", scenes: &["jellyfish", "brush"] },
    Topic { words: "water liquid fluid rain drops", scenes: &["picture-obstacle", "points"] },
    Topic { words: "rain snow sand particles gas balls", scenes: &["picture-obstacle", "points", "pegs"] },
    Topic {
        words: "flag curtain banner sail ship boat leaf fabric textile towel sheet cloth",
        scenes: &["cloth-wind", "cloth-space", "cloth-ball", "net", "tearable-net", "million-cloth"],
    },
    Topic { words: "wind air breeze blow", scenes: &["cloth-wind"] },
    Topic {
        words: "chain cable string thread whip cord rope hair guitar music",
        scenes: &["rope", "rope-on-cursor", "wrecking-ball", "constraints", "bridge"],
    },
    Topic {
        words: "jelly jello gelatin blob slime pudding gummy soft body squishy rubber elastic bouncy pillow cushion",
        scenes: &["jelly", "jelly-stack", "ring", "rim", "maze", "jellyfish"],
    },
    Topic {
        words: "balloon bubble circle disc ball sphere wheel pressure basketball football soccer bounce bouncing bouncy",
        scenes: &["ring", "rim", "pegs", "thousand-rims", "cradle"],
    },
    Topic { words: "doll human person man dummy puppet skeleton stairs body figure hinge joint", scenes: &["ragdoll"] },
    Topic { words: "cog cogwheel gear machine rigid solid", scenes: &["gear", "picture-obstacle"] },
    Topic { words: "motor engine", scenes: &["soft-car"] },
    Topic { words: "bridge beam truss plank construction crossing", scenes: &["bridge"] },
    Topic {
        words: "stiff frame brace truss house building cube crate block brick wood steel metal",
        scenes: &["box-two-supports", "box"],
    },
    Topic { words: "newton collision momentum billiard marbles click clack", scenes: &["cradle"] },
    Topic { words: "trebuchet siege throw launch lever seesaw castle cannon gun rocket", scenes: &["catapult"] },
    Topic {
        words: "tower stack pile domino dominoes crane crash explosion demolition destruction destroy knock smash",
        scenes: &["wrecking-ball", "catapult", "jelly-stack", "box"],
    },
    Topic { words: "tear rip break cut hole", scenes: &["tearable-net", "cloth-space", "net", "rope", "image-mesh"] },
    Topic { words: "pinball pachinko plinko galton obstacles", scenes: &["pegs", "picture-obstacle"] },
    Topic { words: "stone rock pebble", scenes: &["pebble", "picture-obstacle"] },
    Topic {
        words: "picture image photo letter text word drawing",
        scenes: &["image-mesh", "jelly", "maze", "jellyfish", "picture-obstacle"],
    },
    Topic { words: "paint draw drawing sketch canvas", scenes: &["brush"] },
    Topic { words: "3d three dimensions space depth", scenes: &["cloth-space", "cloth-ball"] },
    Topic { words: "orbit planet satellite solar system sun turn", scenes: &["slide-circle", "phase-portrait"] },
    Topic {
        words: "accuracy error integrator method numerics euler verlet energy",
        scenes: &["slide-circle", "slide-decay", "phase-portrait", "points"],
    },
    Topic { words: "large big huge many performance benchmark", scenes: &["million-cloth", "thousand-rims", "rope"] },
    Topic { words: "trampoline hammock bed web", scenes: &["net", "tearable-net", "cloth-ball"] },
    Topic { words: "slope ramp hill hills road", scenes: &["soft-car", "ragdoll", "picture-obstacle"] },
    Topic { words: "gravity fall falling drop", scenes: &["jelly", "pegs", "points"] },
    Topic { words: "force magnet attract attraction mouse push", scenes: &["points", "rim", "slide-circle"] },
    Topic { words: "game toy play fun", scenes: &["catapult", "pegs", "soft-car", "ragdoll", "wrecking-ball"] },
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
    use super::super::{EMPTY, gallery};
    use super::*;

    #[test]
    fn topics_name_scenes_that_are_there() {
        let names: Vec<&str> = gallery().iter().chain([&EMPTY]).map(|entry| entry.name).collect();
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
