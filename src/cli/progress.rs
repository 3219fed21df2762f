//! Progress of a build, drawn on a terminal or told to programs.

use super::console::Console;
use crate::build::{Event, How, Tally};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::time::Duration;

/// Draws events.
pub(super) struct Progress {
    console: Console,
    bar: Option<ProgressBar>,
}

impl Progress {
    pub(super) fn new(console: Console) -> Self {
        let bar = console.draws_progress().then(|| {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{prefix:>12} [{bar:24}] {pos}/{len} {msg}");
            if let Ok(style) = style {
                bar.set_style(style.progress_chars("=> "));
            }
            bar.set_prefix("Building");
            bar
        });
        Self { console, bar }
    }

    /// Shows an event.
    pub(super) fn show(&self, event: Event<'_>) {
        match event {
            Event::Planned { tally } => self.draw(tally, ""),
            Event::Started { instance, tally } => self.draw(tally, &instance.to_string()),
            Event::Progress {
                instance,
                done,
                total,
                tally,
            } => {
                self.draw(tally, &format!("{instance} ({done}/{total})"));
            }
            Event::Waiting {
                instance,
                process,
                tally,
            } => {
                let whom = process.map_or_else(String::new, |id| format!(" {id}"));
                self.draw(tally, &format!("{instance} (waiting for process{whom})"));
            }
            Event::Finished {
                instance,
                how,
                duration,
                tally,
            } => {
                self.draw(tally, "");
                self.console.record(&StageFinished {
                    reason: "stage-finished",
                    stage: &instance.stage,
                    target: &instance.target,
                    how,
                    milliseconds: duration.as_millis(),
                });
            }
        }
    }

    fn draw(&self, tally: Tally, message: &str) {
        let Some(bar) = &self.bar else { return };
        bar.set_length(tally.known as u64);
        bar.set_position(tally.finished as u64);
        let left = tally
            .remaining
            .filter(|left| *left >= Duration::from_secs(1))
            .map_or_else(String::new, |left| {
                format!(" about {} s left", left.as_secs())
            });
        bar.set_message(format!("{message}{left}"));
    }

    /// Takes the bar away.
    pub(super) fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}

#[derive(Serialize)]
struct StageFinished<'a> {
    reason: &'static str,
    stage: &'a str,
    target: &'a str,
    how: How,
    milliseconds: u128,
}
