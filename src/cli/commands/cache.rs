//! `egg cache`: look after what was built before.

use crate::build::{CacheNames, Clock, Mode, Store, cache_directory};
use crate::cli::args::{CacheCommand, Global};
use crate::cli::commands::diff::is_memory;
use crate::cli::config::{Config, limits};
use crate::cli::console::{Console, out};
use crate::cli::exit::Exit;
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};

pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    command: &CacheCommand,
) -> Result<Exit, Exit> {
    let config = Config::read(console)?;
    let store = Store::new(directory(console, global, &config)?);
    let text = match *command {
        CacheCommand::Status => {
            let status = store.status();
            told(console, "cache-status", &status, || describe(&status))
        }
        CacheCommand::Verify { dry_run } => {
            let verified = store.verify(mode(dry_run));
            told(console, "cache-verified", &verified, || {
                let damaged = verified.damaged.len();
                let after = if dry_run {
                    ""
                } else {
                    ", set aside: they are made anew"
                };
                let damaged = if damaged > 0 {
                    format!("{damaged} damaged files{after}\n")
                } else {
                    String::new()
                };
                format!(
                    "{} sound files, {}\n{damaged}",
                    verified.sound.entries,
                    size(verified.sound.bytes)
                )
            })
        }
        CacheCommand::Gc {
            dry_run,
            max_size,
            max_age,
        } => {
            let limits = limits(max_size, max_age, config.limits());
            let collected = store.collect(&limits, Clock::default().now(), mode(dry_run));
            if collected.busy {
                return busy(console);
            }
            told(console, "cache-collected", &collected, || {
                format!(
                    "{}, {} kept\n",
                    removed(dry_run, &collected.removed),
                    size(collected.kept.bytes)
                )
            })
        }
        CacheCommand::Clean { dry_run } => {
            let cleaned = store.clean(mode(dry_run));
            if cleaned.busy {
                return busy(console);
            }
            told(console, "cache-cleaned", &cleaned, || {
                format!("{}\n", removed(dry_run, &cleaned.removed))
            })
        }
    };
    out(&text);
    Ok(Exit::Done)
}

/// The cache's directory, by option, environment, configuration or the user's habits.
pub(in crate::cli) fn directory(
    console: Console,
    global: &Global,
    config: &Config,
) -> Result<PathBuf, Exit> {
    let names = CacheNames {
        option: global.cache_dir.clone(),
        variable: std::env::var_os("EGG_CACHE_DIR"),
        configured: config.cache_directory(),
    };
    cache_directory(&names, &|name| std::env::var_os(name)).ok_or_else(|| {
        console.complain(
            "there is no place for the cache: neither HOME nor a cache directory is set",
            Some("name one with `--cache-dir` or EGG_CACHE_DIR"),
        );
        Exit::Usage
    })
}

fn mode(dry_run: bool) -> Mode {
    if dry_run { Mode::DryRun } else { Mode::Apply }
}

fn busy(console: Console) -> Result<Exit, Exit> {
    console.complain("a build is running", Some("wait until it is finished"));
    Err(Exit::Usage)
}

#[derive(Serialize)]
struct Record<'a, T> {
    reason: &'static str,
    #[serde(flatten)]
    report: &'a T,
}

/// The report as a record for programs, or else as text for people.
fn told<T: Serialize>(
    console: Console,
    reason: &'static str,
    report: &T,
    text: impl FnOnce() -> String,
) -> String {
    if console.is_json() {
        console.record(&Record { reason, report });
        String::new()
    } else {
        text()
    }
}

fn removed(dry_run: bool, tally: &crate::build::CacheTally) -> String {
    let verb = if dry_run { "would remove" } else { "removed" };
    format!("{verb} {} files, {}", tally.entries, size(tally.bytes))
}

fn describe(status: &crate::build::Status) -> String {
    let mut text = format!("{}\n", status.directory);
    let _ = writeln!(
        text,
        "  results  {:>6}, {}",
        status.blobs.entries,
        size(status.blobs.bytes)
    );
    let _ = writeln!(
        text,
        "  records  {:>6}, {}",
        status.traces.entries,
        size(status.traces.bytes)
    );
    if status.quarantined.entries > 0 {
        let _ = writeln!(
            text,
            "  damaged  {:>6}, set aside",
            status.quarantined.entries
        );
    }
    for worktree in &status.worktrees {
        // Sides that `egg diff` compiled are no projects.
        if is_memory(Path::new(&worktree.directory)) {
            continue;
        }
        let _ = writeln!(
            text,
            "  {} ({} stages, {})",
            worktree.directory,
            worktree.instances,
            size(worktree.bytes)
        );
    }
    text
}

fn size(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} bytes"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.2} GB", bytes as f64 / 1e9),
    }
}
