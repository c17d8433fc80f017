//! The program: parse, call, report the error.

fn main() -> std::process::ExitCode {
    wobble::cli::main()
}
