//! The command line: one file a subcommand. Exit codes: 0 done, 1 the work failed, 2 the call is wrong.

#[cfg(test)]
mod documents_tests;
mod machine;
mod mesh;
mod progress;
mod render;
mod replay;
mod scenes;
mod simulate;
mod spared;
mod stop;
mod study;
mod values;
mod window;

use std::io::Write;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::scene::nearest;

/// Soft-body sandbox: points and bonds under Verlet's method.
#[derive(Parser)]
#[command(
    name = "wobble",
    version,
    args_conflicts_with_subcommands = true,
    after_help = "Examples:\n  \
        wobble                                             the jelly, in a window\n  \
        wobble rim-relaxed                                 another scene of the gallery\n  \
        wobble my-scene.json                               a scene file\n  \
        wobble my-picture.png                              a picture, as a soft body\n  \
        wobble --record session.jsonl rim                  the rim, and all that is done to it in a file\n  \
        wobble replay session.json --hash                  a recording, run again\n  \
        wobble render rim --time 2 --size 1280x720 --out rim.png\n  \
        wobble simulate rim --samples 0.5,1,2 --out rim.csv"
)]
struct Call {
    #[command(flatten)]
    machine: machine::Machine,
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    window: window::Arguments,
}

/// The arguments of work that shows how far it is.
#[derive(clap::Args)]
struct Shown<A: clap::Args> {
    #[command(flatten)]
    arguments: A,
    /// No progress bars.
    #[arg(long, short, global = true)]
    quiet: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Lists the gallery, or prints a scene file.
    Scenes(scenes::Arguments),
    /// Runs a scene without a window or a GPU and writes positions and velocities.
    Simulate(Shown<simulate::Arguments>),
    /// Draws a scene off-screen to a PNG or an animated GIF.
    Render(Shown<render::Arguments>),
    /// Runs a recording again.
    Replay(Shown<replay::Arguments>),
    /// Runs recordings again and compares them with their marks.
    Verify(replay::Verified),
    /// Makes a soft body of a picture.
    Mesh(Shown<mesh::Arguments>),
    /// Measures the methods: tables and plots.
    Study(Shown<study::Arguments>),
}

/// Parses the call, does the work, reports the error in one line.
pub fn main() -> ExitCode {
    let call = match Call::try_parse() {
        Ok(call) => call,
        Err(error) => return refuse(&error),
    };
    // A window has ways of its own to be closed.
    let ready = if call.command.is_some() { stop::on_interrupt() } else { Ok(()) };
    let done = ready.and_then(|()| call.machine.prepare()).and_then(|()| match call.command {
        None => window::run(&call.window),
        Some(Command::Scenes(arguments)) => scenes::run(&arguments),
        Some(Command::Simulate(call)) => simulate::run(&call.arguments, call.quiet),
        Some(Command::Render(call)) => render::run(&call.arguments, call.quiet),
        Some(Command::Replay(call)) => replay::run(&call.arguments, call.quiet),
        Some(Command::Verify(arguments)) => replay::verify(&arguments),
        Some(Command::Mesh(call)) => mesh::run(&call.arguments, call.quiet),
        Some(Command::Study(call)) => study::run(&call.arguments, call.quiet),
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of our output has gone (`wobble scenes | head -1`): that is no failure.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            let line = format!("{error:#}").replace('\n', " ");
            let _ = writeln!(std::io::stderr(), "wobble: {line}");
            if error.is::<WrongCall>() { ExitCode::from(2) } else { ExitCode::FAILURE }
        }
    }
}

/// Says what is wrong with a call; a slip of a command's name is taken for a scene otherwise.
fn refuse(error: &clap::Error) -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let first = words.iter().find(|word| !word.starts_with('-'));
    match first.and_then(|word| Some((word, meant(word)?))) {
        Some((word, meant)) if matches!(error.kind(), ErrorKind::UnknownArgument | ErrorKind::ArgumentConflict) => {
            let _ = writeln!(std::io::stderr(), "wobble: `{word}` is no command: did you mean `wobble {meant}`?");
            ExitCode::from(2)
        }
        _ => error.exit(),
    }
}

/// The command that a word is a slip of.
fn meant(word: &str) -> Option<String> {
    let call = Call::command();
    let names: Vec<&str> = call.get_subcommands().map(clap::Command::get_name).collect();
    if names.contains(&word) {
        return None;
    }
    nearest(word, &names).map(str::to_owned)
}

/// A call that turns out to be wrong when the file is known.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct WrongCall(String);

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.downcast_ref::<std::io::Error>().is_some_and(|error| error.kind() == std::io::ErrorKind::BrokenPipe)
}
