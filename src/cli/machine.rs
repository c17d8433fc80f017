//! What of the machine is used: threads and vector instructions.

use anyhow::{Context, bail};
use clap::Args;

use crate::sim::InstructionSet;

/// Most threads that may be asked for.
const MOST_THREADS: i64 = 1024;

/// For every command. Results do not depend on either, to the bit.
#[derive(Args)]
pub(super) struct Machine {
    /// Threads that large scenes may use; all processors if left out.
    #[arg(long, global = true, value_name = "N", env = "RAYON_NUM_THREADS", value_parser = clap::value_parser!(u32).range(1..=MOST_THREADS))]
    threads: Option<u32>,
    /// Vector instructions: baseline, avx2 or avx512; the widest that there are if left out.
    #[arg(long, global = true, value_name = "SET", env = "WOBBLE_INSTRUCTION_SET", value_parser = set)]
    instruction_set: Option<InstructionSet>,
}

fn set(text: &str) -> Result<InstructionSet, String> {
    let names = || InstructionSet::ALL.map(InstructionSet::name).join(", ");
    let found = InstructionSet::ALL.into_iter().find(|set| set.name() == text.to_ascii_lowercase());
    found.ok_or_else(|| format!("give one of {}", names()))
}

impl Machine {
    /// Makes it so, before any work is done.
    ///
    /// Errors: this machine lacks the instructions, or the threads cannot be started.
    pub(super) fn prepare(&self) -> anyhow::Result<()> {
        if let Some(set) = self.instruction_set
            && !set.choose()
        {
            let best = InstructionSet::best();
            bail!("this machine has no {set} instructions: use --instruction-set {best} or leave it out");
        }
        if let Some(threads) = self.threads {
            crate::sim::use_threads(threads as usize).with_context(|| format!("{threads} threads cannot be used"))?;
        }
        Ok(())
    }
}
