//! x
#[derive(clap::Args)]
pub(super) struct Arguments {}
pub(super) fn run(_arguments: &Arguments, _quiet: bool) -> anyhow::Result<()> {
    Ok(())
}
