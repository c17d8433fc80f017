//! x
#[derive(clap::Args)]
pub(super) struct Arguments {
    scene: Option<String>,
}
pub(super) fn run(_arguments: &Arguments) -> anyhow::Result<()> {
    Ok(())
}
