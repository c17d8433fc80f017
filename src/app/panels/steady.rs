//! What is said steadily: something else is said once it has been so for a while, not while it comes and goes.

use std::time::Duration;

use egui::{Context, Id};

/// For how long something else is to be so before it is said `[s]`.
const STEADY: f64 = 1.0;

/// What is said now, and since when it would be something else `[s]`.
#[derive(Clone)]
struct Kept<T> {
    said: T,
    other_since: Option<f64>,
}

/// What is said by a name where it would be `new` now: that at once where it is urgent, or as good as what is said; else once it has not been that
/// for a second.
pub(super) fn steady<T: Clone + Send + Sync + 'static>(
    context: &Context,
    name: &str,
    (new, is_urgent): (T, bool),
    is_same: impl Fn(&T, &T) -> bool,
) -> T {
    let id = Id::unique(name).with("steady");
    let now = context.input(|input| input.time);
    let kept = context.data(|data| data.get_temp::<Kept<T>>(id));
    let kept = match kept {
        Some(Kept { said, other_since }) if !is_urgent && !is_same(&said, &new) => {
            let since = other_since.unwrap_or(now);
            let left = since + STEADY - now;
            if left > 0.0 {
                context.request_repaint_after(Duration::from_secs_f64(left));
                Kept { said, other_since: Some(since) }
            } else {
                Kept { said: new, other_since: None }
            }
        }
        _ => Kept { said: new, other_since: None },
    };
    context.data_mut(|data| data.insert_temp(id, kept.clone()));
    kept.said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_and_goes_is_not_said_and_what_stays_is() {
        let context = Context::default();
        let mut now = 0.0;
        let mut said = |new: &'static str, is_urgent: bool| {
            now += 0.1;
            let input = egui::RawInput { time: Some(now), ..egui::RawInput::default() };
            let mut said = "";
            let mut output = context.run_ui(input, |ui| said = steady(ui.ctx(), "it", (new, is_urgent), |a, b| a == b));
            output.textures_delta.clear();
            said
        };
        assert_eq!(said("quick", false), "quick", "nothing was said before");
        for _ in 0..40 {
            assert_eq!((said("rough", false), said("quick", false)), ("quick", "quick"));
        }
        let after: Vec<&str> = (0..12).map(|_| said("rough", false)).collect();
        assert_eq!((after[8], after[11]), ("quick", "rough"));
        assert_eq!(said("frozen", true), "frozen");
    }
}
