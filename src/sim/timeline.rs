//! How time is cut into substeps.

/// Substeps between knots: the start, the knots of tracks, the end.
///
/// Between two knots time is cut into ceil(dt/h) equal substeps, so that every knot ends one; after the last knot,
/// substeps of h follow without end. Times are counted, never summed, so that they do not drift.
#[derive(Clone, Debug)]
pub(crate) struct Timeline {
    /// The substep asked for `[s]`.
    nominal: f64,
    /// Knots after the start of the present stretch, ascending.
    knots: Vec<f64>,
    /// Start of the present stretch `[s]`.
    start: f64,
    /// Length of its substeps `[s]`.
    substep: f64,
    /// How many substeps it has; `None`: without end.
    count: Option<u64>,
    /// Length of the last of them, where that is a shorter one `[s]`.
    rest: Option<f64>,
    /// How many are done.
    done: u64,
    /// How far a command has cut into the substep under way `[s]`.
    within: Option<f64>,
}

/// Frames a second `[1/s]`.
const FRAMES: f64 = 60.0;
/// Share of a frame by which a step may end after it, for rounding, and still be of it.
const FRAME_SLACK: f64 = 1e-9;

/// The number of frames of 1/60 s that end at `time` `[s]` or before, the one that it lies in too: frame k is of the steps that end in
/// ((k-1)/60, k/60].
pub fn frame_of(time: f64) -> u64 {
    (time * FRAMES - FRAME_SLACK).ceil().max(0.0) as u64
}

/// A stretch that is a whole number of substeps but for rounding gets that number.
const SLACK: f64 = 1e-9;

impl Timeline {
    /// From time 0, with substeps of at most `nominal` `[s]`. Knots may come in any order; those not after 0 are ignored.
    pub(crate) fn new(nominal: f64, knots: impl IntoIterator<Item = f64>) -> Self {
        let mut knots: Vec<f64> = knots.into_iter().filter(|&t| t > 0.0).collect();
        knots.sort_by(|a, b| b.total_cmp(a));
        knots.dedup();
        let mut timeline =
            Timeline { nominal, knots, start: 0.0, substep: nominal, count: None, rest: None, done: 0, within: None };
        timeline.cut();
        timeline
    }

    /// The same from `time` `[s]` on.
    pub(crate) fn resumed(nominal: f64, knots: impl IntoIterator<Item = f64>, time: f64) -> Self {
        let mut timeline = Timeline::new(nominal, knots.into_iter().filter(|&t| t > time));
        timeline.start = time;
        timeline.cut();
        timeline
    }

    /// The substep asked for `[s]`.
    pub(crate) fn nominal(&self) -> f64 {
        self.nominal
    }

    /// Substeps from now on are `factor` times as long, if so many of those until now make a whole number: between two of them. Returns
    /// whether that is so.
    ///
    /// They are as long whenever the stretch ends: where that is no whole number of them, the last one is shorter.
    pub(crate) fn stretch(&mut self, factor: u32) -> bool {
        let many = u64::from(factor);
        if !self.done.is_multiple_of(many) {
            return false;
        }
        self.start = self.time();
        if let Some(count) = self.count {
            let (left, last) = (count - self.done, self.rest);
            let whole = left - u64::from(last.is_some());
            let over = (whole % many) as f64 * self.substep + last.unwrap_or(0.0);
            self.rest = (over > 0.0).then_some(over);
            self.count = Some(whole / many + u64::from(over > 0.0));
        }
        self.nominal *= f64::from(factor);
        self.substep *= f64::from(factor);
        self.done = 0;
        true
    }

    /// Substeps from now on are frames long, if none has begun yet in the frame that time lies in: between two of them, of less than a
    /// frame. Returns whether that is so.
    ///
    /// They are as long whenever the stretch ends: the last one is shorter.
    pub(crate) fn stretch_to_frames(&mut self) -> bool {
        let time = self.time();
        let into = time * FRAMES - (time * FRAMES + FRAME_SLACK).floor();
        if into >= self.substep() * FRAMES - FRAME_SLACK {
            return false;
        }
        (self.start, self.done, self.rest) = (time, 0, None);
        (self.nominal, self.substep) = (1.0 / FRAMES, 1.0 / FRAMES);
        self.count = self.knots.last().map(|&end| {
            let frames = (end - time) * FRAMES;
            let whole = (frames * (1.0 + SLACK)).floor();
            let over = frames - whole;
            self.rest = (over > SLACK * frames).then_some(over / FRAMES);
            whole as u64 + u64::from(self.rest.is_some())
        });
        true
    }

    /// Cuts the stretch from `start` to the next knot.
    fn cut(&mut self) {
        (self.done, self.rest) = (0, None);
        match self.knots.last() {
            Some(&end) => {
                let length = end - self.start;
                let count = (length / self.nominal * (1.0 - SLACK)).ceil().max(1.0);
                self.substep = length / count;
                self.count = Some(count as u64);
            }
            None => {
                self.substep = self.nominal;
                self.count = None;
            }
        }
    }

    /// Time reached `[s]`.
    pub(crate) fn time(&self) -> f64 {
        self.within.unwrap_or_else(|| self.after(self.done))
    }

    fn after(&self, done: u64) -> f64 {
        match (self.rest, self.count) {
            (Some(rest), Some(count)) if done >= count => self.start + (count - 1) as f64 * self.substep + rest,
            _ => self.start + done as f64 * self.substep,
        }
    }

    /// Length of the next substep, or of what is left of the one under way `[s]`.
    pub(crate) fn substep(&self) -> f64 {
        self.left(self.time())
    }

    /// What is left of the substep under way for what has come to `from` `[s]`.
    pub(crate) fn left(&self, from: f64) -> f64 {
        if from != self.after(self.done) {
            return self.after(self.done + 1) - from;
        }
        self.rest.filter(|_| self.count == Some(self.done + 1)).unwrap_or(self.substep)
    }

    /// Whether no substep is under way.
    pub(crate) fn is_between_steps(&self) -> bool {
        self.within.is_none()
    }

    /// Ends the substep under way.
    pub(crate) fn advance(&mut self) {
        self.within = None;
        self.done += 1;
        if self.count == Some(self.done)
            && let Some(end) = self.knots.pop()
        {
            self.start = end;
            self.cut();
        }
    }

    /// Goes to `time` `[s]` within the substep under way: the grid stays.
    pub(crate) fn advance_within(&mut self, time: f64) {
        self.within = Some(time);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knots_end_substeps_exactly() {
        let mut timeline = Timeline::new(0.1, [1.0, 0.25]);
        let mut times = Vec::new();
        for _ in 0..13 {
            timeline.advance();
            times.push(timeline.time());
        }
        assert!(times.contains(&0.25) && times.contains(&1.0), "{times:?}");
        assert_eq!(times[10], 1.0, "3 substeps to 0.25, 8 to 1");
        assert!((times[12] - 1.2).abs() < 1e-15);
    }

    #[test]
    fn a_cut_leaves_the_grid_as_it_is() {
        let mut timeline = Timeline::new(0.1, [0.5]);
        timeline.advance();
        timeline.advance_within(0.13);
        assert_eq!(timeline.time(), 0.13);
        assert!((timeline.substep() - 0.07).abs() < 1e-15, "{}", timeline.substep());
        assert_eq!(timeline.left(0.1), 0.1, "of what was not cut");
        timeline.advance();
        assert_eq!((timeline.time(), timeline.substep()), (0.2, 0.1));
    }

    #[test]
    fn substeps_get_longer_from_where_it_stands() {
        let mut timeline = Timeline::new(0.125, [2.0]);
        timeline.advance();
        assert!(!timeline.stretch(2), "the longer ones begin at 0.25");
        timeline.advance();
        assert!(timeline.stretch(2));
        assert_eq!((timeline.time(), timeline.nominal(), timeline.count), (0.25, 0.25, Some(7)));
        (0..7).for_each(|_| timeline.advance());
        assert_eq!((timeline.time(), timeline.substep()), (2.0, 0.25));
    }

    #[test]
    fn longer_substeps_do_not_depend_on_the_end() {
        let lengths = |end: f64| {
            let mut timeline = Timeline::new(1.0 / 1024.0, [end]);
            (0..336).for_each(|_| timeline.advance());
            assert!(timeline.stretch(16), "at the end of a frame");
            (0..30)
                .map(|_| {
                    timeline.advance();
                    (timeline.time(), timeline.substep())
                })
                .collect::<Vec<_>>()
        };
        assert_eq!(lengths(1.5), lengths(20.0));
        assert_eq!(lengths(1.5), lengths(1.0));
        assert_eq!(lengths(1.5), lengths(1.5 + 3.0 / 1024.0), "no whole number of them is left");
    }

    #[test]
    fn the_last_one_is_shorter_where_it_is_no_whole_number() {
        let mut timeline = Timeline::new(0.125, [1.375]);
        (0..4).for_each(|_| timeline.advance());
        assert!(timeline.stretch(2));
        let mut steps = Vec::new();
        let mut walk = |timeline: &mut Timeline, count: usize| {
            for _ in 0..count {
                steps.push((timeline.time(), timeline.substep()));
                timeline.advance();
            }
        };
        walk(&mut timeline, 2);
        assert!(timeline.stretch(2), "what is left of 0.25 and 0.125 is one of 0.375");
        walk(&mut timeline, 2);
        assert_eq!(steps, [(0.5, 0.25), (0.75, 0.25), (1.0, 0.375), (1.375, 0.5)]);
    }

    #[test]
    fn substeps_of_any_length_are_stretched_to_frames_where_one_begins() {
        for end in [0.3, 0.305, 0.1 + 0.5 / 60.0, 20.0] {
            let mut timeline = Timeline::new(1.0 / 60.0 / 81.0, [20.0, end]);
            (0..3).for_each(|_| timeline.advance());
            assert!(!timeline.stretch_to_frames(), "it is within a frame");
            (3..6 * 81).for_each(|_| timeline.advance());
            // Those of a stretch that is no whole number of frames are a little shorter.
            if !timeline.stretch_to_frames() {
                timeline.advance();
                assert!(timeline.stretch_to_frames(), "{end}");
            }
            let start = timeline.time();
            assert!((start - 0.1).abs() < 1.0 / 60.0 / 81.0, "{start}");
            let mut ends = Vec::new();
            while timeline.time() < end - 1e-12 {
                let frame = frame_of(timeline.time());
                timeline.advance();
                let is_next = frame_of(timeline.time()) == frame + 1;
                assert!(is_next || timeline.time() == end, "one a frame, but for what is left in the end");
                ends.push(timeline.time());
            }
            assert_eq!((ends.len(), ends.last().copied()), (((end - start) * 60.0 - 1e-6).ceil() as usize, Some(end)));
            let is_frame = |(k, &t): (usize, &f64)| t == end || (t - start - (k + 1) as f64 / 60.0).abs() < 1e-9;
            assert!(ends.iter().enumerate().all(is_frame));
            timeline.advance();
            let next = 1.0 / 60.0;
            assert!(end == 20.0 || (timeline.time() - end - next).abs() < 1e-3, "they stay as long");
        }
    }

    #[test]
    fn frames_are_counted_by_what_ends_in_them() {
        let times = [0.0, 1.0 / 240.0, 1.0 / 60.0, 1.0 / 60.0 + 1e-3, 0.1];
        assert_eq!(times.map(frame_of), [0, 1, 1, 2, 6]);
    }

    #[test]
    fn a_whole_number_of_substeps_is_not_cut_finer() {
        let timeline = Timeline::new(1.0 / 240.0, [2.0]);
        assert_eq!(timeline.count, Some(480));
        assert_eq!(Timeline::new(0.006, [0.06]).count, Some(10));
    }
}
