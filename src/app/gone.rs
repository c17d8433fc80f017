//! A window that is taken away from outside: the library that it is of gives up in the middle of whatever it was asked for.

use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, resume_unwind, set_hook, take_hook};

/// How the library says that the display knows no such window any more.
const GONE: &str = "X11(X11Error";

/// Does what a window needs; `None`: it was taken away meanwhile. All else that panics goes on to.
pub(super) fn unless_gone<T>(work: impl FnOnce() -> T) -> Option<T> {
    let before = take_hook();
    set_hook(Box::new(move |info: &PanicHookInfo<'_>| {
        if !info.payload_as_str().is_some_and(is_gone) {
            before(info);
        }
    }));
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(done) => Some(done),
        Err(why) if why.downcast_ref::<String>().is_some_and(|words| is_gone(words)) => None,
        Err(why) => resume_unwind(why),
    }
}

fn is_gone(words: &str) -> bool {
    words.contains(GONE)
}

#[cfg(test)]
#[allow(clippy::panic, reason = "what is tested is what comes of a panic")]
mod tests {
    use super::*;

    #[test]
    fn a_window_that_is_gone_ends_the_work_and_all_else_goes_on_to_panic() {
        assert_eq!(unless_gone(|| 7), Some(7));
        let words =
            "called `Result::unwrap()` on an `Err` value: X11(X11Error { error_kind: Drawable, error_code: 9 })";
        assert_eq!(unless_gone(|| panic!("{words}")), None::<()>);
        assert!(catch_unwind(|| unless_gone(|| panic!("{}", "another"))).is_err());
    }
}
