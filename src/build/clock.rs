//! The one place where the engine asks what time it is: for ages of cache entries and durations
//! of stages, never for anything that enters a key or an output.

use std::time::{Duration, Instant, SystemTime};

/// Where the time comes from.
#[derive(Debug, Clone, Copy, Default)]
pub enum Clock {
    /// The computer's clock.
    #[default]
    System,
    /// Stopped at this time, for tests.
    Stopped(SystemTime),
}

impl Clock {
    /// Now.
    pub fn now(self) -> SystemTime {
        match self {
            Self::System => SystemTime::now(),
            Self::Stopped(time) => time,
        }
    }
}

/// How long ago `then` was; a time in the future is no time ago, so a clock that was once ahead
/// makes entries young, never old.
pub(super) fn age(now: SystemTime, then: SystemTime) -> Duration {
    now.duration_since(then).unwrap_or_default()
}

/// Measures durations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stopwatch(Instant);

impl Stopwatch {
    pub(super) fn start() -> Self {
        Self(Instant::now())
    }

    pub(super) fn elapsed(self) -> Duration {
        self.0.elapsed()
    }
}
