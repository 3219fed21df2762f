//! The command line: arguments, messages, progress, exit codes. Nothing else prints or reads the
//! environment.

mod args;
mod commands;
mod config;
mod console;
mod design;
mod exit;
mod git;
mod interrupt;
mod progress;
mod run;
mod table;

use crate::build::Request;
use args::{Cli, Command};
use clap::{CommandFactory, Parser};
use commands::{
    build, cache, check, diff, explain, export, graph, init, lock, materials, schema, split,
    verify, watch,
};
use console::Console;
use exit::Exit;
use std::process::ExitCode;

/// Runs `egg` with the arguments of the process.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let _ = error.print();
            return if error.use_stderr() {
                Exit::Usage
            } else {
                Exit::Done
            }
            .into();
        }
    };
    let console = Console::new(&cli.global);
    let dispatched = std::panic::catch_unwind(|| dispatch(console, cli));
    let exit = dispatched.unwrap_or_else(|_| {
        console.complain(
            "this is a fault of egg, not of the project",
            Some("please report it with the project file and the lines above"),
        );
        Exit::Usage
    });
    exit.into()
}

fn dispatch(console: Console, cli: Cli) -> Exit {
    let Cli { global, command } = cli;
    if let Some(jobs) = global.jobs {
        // Fails only if a pool exists already, and then that one serves.
        let _ = rayon::ThreadPoolBuilder::new()
            .num_threads(jobs.into())
            .build_global();
    }
    let ended = match command {
        Command::Init { name } => Ok(init::run(console, &name)),
        Command::Check {
            file,
            format,
            locked,
        } => {
            let held = if locked {
                check::Held::Locked
            } else {
                check::Held::Free
            };
            check::run(console, &global, file.path.as_deref(), format, held)
        }
        Command::Split { file, workflow } => {
            split::run(console, &global, file.path.as_deref(), workflow)
        }
        Command::Build {
            file,
            selection,
            dry_run,
            force,
        } => {
            let request = build::request(&selection, force);
            let run = if dry_run { build::dry_run } else { build::run };
            run(console, &global, file.path.as_deref(), &request)
        }
        Command::Coupon { file } => {
            let request = Request {
                stages: vec!["coupon-files".to_owned()],
                ..Request::default()
            };
            build::run(console, &global, file.path.as_deref(), &request)
        }
        Command::Verify { folder } => verify::run(console, &folder),
        Command::Export { file, format } => {
            export::run(console, &global, file.path.as_deref(), format)
        }
        Command::Diff(arguments) => diff::run(console, &global, &arguments),
        Command::Lock { file } => lock::run(console, &global, file.path.as_deref()),
        Command::Git { command } => commands::git::run(console, &command),
        Command::Schema { of } => {
            schema::run(of);
            Ok(Exit::Done)
        }
        Command::Explain { what } => explain::run(console, &global, &what),
        Command::Graph { file, format } => {
            graph::run(console, &global, file.path.as_deref(), format)
        }
        Command::Watch { file, selection } => {
            let request = build::request(&selection, false);
            watch::run(console, &global, file.path.as_deref(), &request)
        }
        Command::Cache { command } => cache::run(console, &global, &command),
        Command::Materials => {
            materials::run(console);
            Ok(Exit::Done)
        }
        Command::Completions { shell } => {
            let mut text = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "egg", &mut text);
            console::out(&String::from_utf8_lossy(&text));
            Ok(Exit::Done)
        }
    };
    ended.unwrap_or_else(|exit| exit)
}
