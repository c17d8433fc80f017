//! Below the figures: what moves bodies otherwise than by plan, what gave way to the load, what the live step does beside moving. Nothing
//! of it, nothing there.

use egui::{Align2, Area, Color32, Id, Label, RichText};

use super::theme::{AWAY, LEAD, TEXT, WEAK, floating};
use super::{Facts, Wish, short};
use crate::app::player::{Acts, Figures, Moved, Movers, Rung, Yielded};
use crate::sim::Why;

/// Widest line `[points]`.
const WIDTH: f32 = 250.0;

/// What is said, and what can be asked for beside it.
#[derive(Clone, Debug, PartialEq)]
struct Line {
    words: String,
    color: Color32,
    offer: Option<Offer>,
}

/// A button: its words, what it does, and what is asked for.
type Offer = (&'static str, &'static str, Wish);

/// Shows it so far from the upper right corner `[points]`.
pub(super) fn show(context: &egui::Context, off: [f32; 2], facts: &Facts, wishes: &mut Vec<Wish>) {
    let lines = lines(&facts.figures);
    if lines.is_empty() {
        return;
    }
    let place = Area::new(Id::unique("moving")).anchor(Align2::RIGHT_TOP, off);
    let place = place.interactable(lines.iter().any(|line| line.offer.is_some()));
    place.show(context, |ui| {
        floating().show(ui, |ui| {
            ui.set_max_width(WIDTH);
            ui.vertical(|ui| {
                for Line { words, color, offer } in lines {
                    ui.add(Label::new(RichText::new(words).color(color)).wrap().selectable(false));
                    if let Some((name, said, wish)) = offer
                        && ui.button(name).on_hover_text(said).clicked()
                    {
                        wishes.push(wish);
                    }
                }
            });
        });
    });
}

fn lines(figures: &Figures) -> Vec<Line> {
    let line = |(words, color)| Line { words, color, offer: None };
    let Movers { moved, islands, can_be_exact } = &*figures.movers;
    let mut lines: Vec<Line> = moved.iter().map(|one| line(told(one, *islands))).collect();
    if *can_be_exact {
        let said =
            "moved by its own method from now on, whatever that costs; what touches something stays in the live step";
        // Beside what it would change.
        let last = moved.iter().rposition(|one| matches!(one.why, Why::Budget | Why::Alarm));
        if let Some(line) = last.and_then(|last| lines.get_mut(last)) {
            line.offer = Some(("Make this exact", said, Wish::Exact));
        }
    }
    if let Some(yielded) = &figures.yielded {
        let said = "the method of before, and slow motion where that takes too long";
        let offer = Some(("Take it back", said, Wish::TakeBack));
        lines.push(Line { words: gave_way(yielded), color: LEAD, offer });
    }
    lines.extend(done(&figures.acts).into_iter().map(|words| line((words, WEAK))));
    lines
}

/// How many bodies are moved by whom, since when, and why.
fn told(&Moved { why, islands, since }: &Moved, all: usize) -> (String, Color32) {
    let who = match (islands, all) {
        (1, 1) => "The body has been".to_owned(),
        (count, all) if count == all => format!("All {all} bodies have been"),
        (1, all) => format!("1 of {all} bodies has been"),
        (count, all) => format!("{count} of {all} bodies have been"),
    };
    let [since, last] = since.map(|time| format!("{time:.1}\u{a0}s"));
    let since = if since == last { format!("since {since}") } else { format!("since {since}, the last since {last}") };
    let live = |cause: &str| format!("{who} in the live step {since}: {cause}");
    match why {
        Why::Budget => (live("their own methods take too much work"), TEXT),
        Why::Alarm => (live("their own methods fail there"), TEXT),
        Why::Contact | Why::Plan => (live("they may touch something, which no exact method knows"), TEXT),
        Why::NotFinite => {
            let stands = who.replace(" has been", " has stood").replace(" have been", " have stood");
            (format!("{stands} still {since}: no finite numbers. Grab or change it, and it goes on"), AWAY)
        }
    }
}

/// What gave way, and to what.
fn gave_way(&Yielded { rung, since, work }: &Yielded) -> String {
    let what = match rung {
        Rung::Order => "Order 2 in place of 4",
        Rung::Live => "The live step wherever it is cheaper",
    };
    let cause = work.map_or(String::new(), |work| format!(": {} of work a frame", short(work)));
    format!("{what} since {since:.1}\u{a0}s{cause}")
}

/// What the live step did of late.
fn done(&Acts { cut, guarded, mends, parts, settles }: &Acts) -> Vec<String> {
    let times = |count: u64| if count == 1 { "once so far".to_owned() } else { format!("{count} times so far") };
    let mut lines = Vec::new();
    if cut > 0 {
        lines.push(format!("Stopped before it went through something: {}", times(cut)));
    }
    if guarded > 0 {
        lines.push(format!("Energy from nowhere taken out: {}", times(guarded)));
    }
    if mends {
        lines.push("What is inside out is led back to its shape".to_owned());
    }
    if parts {
        lines.push("Bodies in each other are parted".to_owned());
    }
    if settles {
        lines.push("What touches something and is slow is slowed down".to_owned());
    }
    lines
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    fn words(figures: &Figures) -> Vec<String> {
        lines(figures).into_iter().map(|line| line.words).collect()
    }

    fn moved(why: Why, islands: usize) -> Moved {
        Moved { why, islands, since: [3.25, 3.25] }
    }

    #[test]
    fn where_nothing_of_it_happens_nothing_is_said() {
        assert_eq!(words(&Figures::default()), Vec::<String>::new());
        let movers = Movers { islands: 5, ..Movers::default() };
        assert_eq!(words(&Figures { movers: Arc::new(movers), ..Figures::default() }), Vec::<String>::new());
    }

    #[test]
    fn who_is_moved_since_when_and_why_is_said_with_the_way_back() {
        let list = vec![moved(Why::Budget, 2), moved(Why::Contact, 1), moved(Why::NotFinite, 1)];
        let movers = Movers { moved: list, islands: 4, can_be_exact: true };
        let lines = lines(&Figures { movers: Arc::new(movers), ..Figures::default() });
        let said: Vec<&str> = lines.iter().map(|line| line.words.as_str()).collect();
        assert_eq!(
            said,
            [
                "2 of 4 bodies have been in the live step since 3.2\u{a0}s: their own methods take too much work",
                "1 of 4 bodies has been in the live step since 3.2\u{a0}s: they may touch something, which no exact method knows",
                "1 of 4 bodies has stood still since 3.2\u{a0}s: no finite numbers. Grab or change it, and it goes on",
            ]
        );
        let offers: Vec<bool> = lines.iter().map(|line| line.offer.is_some()).collect();
        assert_eq!(offers, [true, false, false]);
        let movers = Movers { moved: vec![moved(Why::Contact, 3)], islands: 3, can_be_exact: false };
        let figures = Figures { movers: Arc::new(movers), ..Figures::default() };
        assert!(words(&figures)[0].starts_with("All 3 bodies have been in the live step since 3.2\u{a0}s"));
        let joined = Moved { since: [3.25, 48.0], ..moved(Why::Contact, 3) };
        let words = told(&joined, 3).0;
        assert!(words.contains("since 3.2\u{a0}s, the last since 48.0\u{a0}s: they may touch"), "{words}");
        assert_eq!(super::lines(&figures)[0].offer, None);
    }

    #[test]
    fn what_gave_way_is_said_with_its_cause_and_the_way_back() {
        let yielded = Yielded { rung: Rung::Order, since: 12.0, work: Some(0.041) };
        let lines = lines(&Figures { yielded: Some(yielded), ..Figures::default() });
        assert_eq!(lines[0].words, "Order 2 in place of 4 since 12.0\u{a0}s: 41 ms of work a frame");
        assert_eq!(lines[0].offer.as_ref().map(|offer| &offer.2), Some(&Wish::TakeBack));
        let followed = Figures { yielded: Some(Yielded { work: None, ..yielded }), ..Figures::default() };
        assert_eq!(words(&followed), ["Order 2 in place of 4 since 12.0\u{a0}s"]);
    }

    #[test]
    fn what_the_live_step_did_of_late_is_said_in_plain_words() {
        let acts = Acts { cut: 3, guarded: 1, mends: true, parts: true, settles: true };
        assert_eq!(
            words(&Figures { acts, ..Figures::default() }),
            [
                "Stopped before it went through something: 3 times so far",
                "Energy from nowhere taken out: once so far",
                "What is inside out is led back to its shape",
                "Bodies in each other are parted",
                "What touches something and is slow is slowed down",
            ]
        );
    }
}
