//! What a study ran on.

use serde::Serialize;

/// What figures of wall time mean nothing without.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// Model of the processor; `unknown` where the system does not say.
    pub processor: String,
    /// Threads that the system runs at once.
    pub threads: usize,
    /// The operating system.
    pub system: &'static str,
    /// The instruction set.
    pub architecture: &'static str,
    /// Whether the program's assertions were on: its times are then not those of a release.
    pub has_assertions: bool,
}

/// The machine that this runs on.
pub fn machine() -> Machine {
    let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    Machine {
        processor: processor(&about).unwrap_or("unknown").to_owned(),
        threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
        system: std::env::consts::OS,
        architecture: std::env::consts::ARCH,
        has_assertions: cfg!(debug_assertions),
    }
}

/// The first model name in the text of /proc/cpuinfo.
fn processor(about: &str) -> Option<&str> {
    let line = about.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_is_found_or_unknown() {
        let about = "processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\nmodel name\t: Another\n";
        assert_eq!(processor(about), Some("Some CPU @ 2 GHz"));
        assert_eq!(processor("processor : 0\n"), None);
    }
}
