//! Which vector instructions the kernels use. The bits of a run do not depend on it.

use std::fmt;
use std::sync::atomic::{AtomicU8, Ordering};

/// A set of vector instructions.
///
/// Every kernel does the same IEEE 754 operations on every number in the same order, so a run gives the same bits with
/// any of them; only its speed differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every processor of the kind has: SSE2 on x86-64, NEON on 64-bit ARM.
    Baseline,
    /// 256-bit vectors of x86-64.
    Avx2,
    /// 512-bit vectors of x86-64.
    Avx512,
}

/// The set that all kernels use, as its place in [`InstructionSet::ALL`] plus 1; 0: not decided.
static CHOSEN: AtomicU8 = AtomicU8::new(0);

impl InstructionSet {
    /// All, the narrowest first.
    pub const ALL: [InstructionSet; 3] = [InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512];

    /// Its name in calls.
    pub fn name(self) -> &'static str {
        match self {
            InstructionSet::Baseline => "baseline",
            InstructionSet::Avx2 => "avx2",
            InstructionSet::Avx512 => "avx512",
        }
    }

    /// Whether this machine has it.
    pub fn is_available(self) -> bool {
        self.token().is_some()
    }

    /// The widest that this machine has.
    pub fn best() -> Self {
        Self::ALL.into_iter().rev().find(|set| set.is_available()).unwrap_or(InstructionSet::Baseline)
    }

    /// The one that kernels use: the one that was [chosen](InstructionSet::choose), or the best.
    pub fn chosen() -> Self {
        match CHOSEN.load(Ordering::Relaxed) {
            0 => Self::best(),
            place => Self::ALL[usize::from(place) - 1],
        }
    }

    /// Makes all kernels of the program use this set from now on. Returns whether this machine has it; if not, nothing
    /// changes.
    pub fn choose(self) -> bool {
        let place = Self::ALL.iter().position(|&set| set == self).unwrap_or(0);
        if self.is_available() {
            CHOSEN.store(place as u8 + 1, Ordering::Relaxed);
        }
        self.is_available()
    }

    #[cfg(target_arch = "x86_64")]
    fn token(self) -> Option<Token> {
        let level = fearless_simd::Level::new();
        match self {
            InstructionSet::Baseline => level.as_sse2().map(Token::Baseline),
            InstructionSet::Avx2 => level.as_avx2().map(Token::Avx2),
            InstructionSet::Avx512 => level.as_avx512().map(Token::Avx512),
        }
    }

    #[cfg(target_arch = "aarch64")]
    fn token(self) -> Option<Token> {
        let neon = fearless_simd::Level::new().as_neon();
        neon.filter(|_| self == InstructionSet::Baseline).map(Token::Baseline)
    }

    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    fn token(self) -> Option<Token> {
        (self == InstructionSet::Baseline).then(|| Token::Baseline(fearless_simd::Fallback::new()))
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set that this machine has, with the proof of it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Token {
    #[cfg(target_arch = "x86_64")]
    Baseline(fearless_simd::x86::Sse2),
    #[cfg(target_arch = "aarch64")]
    Baseline(fearless_simd::aarch64::Neon),
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    Baseline(fearless_simd::Fallback),
    #[cfg(target_arch = "x86_64")]
    Avx2(fearless_simd::x86::Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(fearless_simd::x86::Avx512),
}

/// The proof of the set that kernels use.
///
/// Every machine has the baseline: asking again for it yields one.
pub(crate) fn token() -> Option<Token> {
    InstructionSet::chosen().token()
}

/// Compiles an expression for every instruction set, with `$m` bound to its proof, and runs the one that is chosen.
macro_rules! vectorized {
    ($m:ident => $op:expr) => {{
        use fearless_simd::Simd;
        use $crate::sim::kernels::level::{Token, token};
        match token() {
            #[cfg(target_arch = "x86_64")]
            Some(Token::Avx512($m)) => $m.vectorize(
                #[inline(always)]
                || $op,
            ),
            #[cfg(target_arch = "x86_64")]
            Some(Token::Avx2($m)) => $m.vectorize(
                #[inline(always)]
                || $op,
            ),
            Some(Token::Baseline($m)) => $m.vectorize(
                #[inline(always)]
                || $op,
            ),
            None => unreachable!("every machine has the baseline"),
        }
    }};
}
pub(crate) use vectorized;
