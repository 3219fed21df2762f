//! The user's configuration: what is the same for all projects of one person, and never enters a
//! result. `egg/config.toml` in the user's configuration directory:
//!
//! ```toml
//! [cache]
//! directory = "/data/egg"      # default: the user's cache directory
//! max_size = 10000             # megabytes
//! max_age = 30                 # days
//! ```

use super::console::Console;
use super::exit::Exit;
use crate::build::{Limits, user_config_directory};
use serde::Deserialize;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::time::Duration;

const DAY: Duration = Duration::from_secs(24 * 3600);

/// What the user has configured.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Config {
    cache: CacheConfig,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct CacheConfig {
    directory: Option<PathBuf>,
    /// Megabytes.
    max_size: Option<u64>,
    /// Days.
    max_age: Option<u32>,
}

impl Config {
    /// Reads the configuration; without a file everything is as by default.
    pub(super) fn read(console: Console) -> Result<Self, Exit> {
        let Some(directory) = user_config_directory(&|name| std::env::var_os(name)) else {
            return Ok(Self::default());
        };
        let path = directory.join("config.toml");
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Self::default()),
            Err(error) => {
                console.complain(&format!("cannot read `{}`: {error}", path.display()), None);
                return Err(Exit::Usage);
            }
        };
        let mut config: Self = toml::from_str(&text).map_err(|error| {
            let line = error
                .span()
                .and_then(|span| text.get(..span.start))
                .map_or(1, |before| before.matches('\n').count() + 1);
            console.complain(
                &format!("{}:{line}: {}", path.display(), error.message()),
                Some("`[cache]` has the keys `directory`, `max_size` (megabytes) and `max_age` (days)"),
            );
            Exit::Usage
        })?;
        // A relative directory would mean another cache in every folder.
        config.cache.directory = config.cache.directory.map(|it| directory.join(it));
        Ok(config)
    }

    /// Where the cache is to lie.
    pub(super) fn cache_directory(&self) -> Option<PathBuf> {
        self.cache.directory.clone()
    }

    /// How large and how old the cache may become.
    pub(super) fn limits(&self) -> Limits {
        limits(self.cache.max_size, self.cache.max_age, Limits::default())
    }
}

/// Limits in megabytes and days where they are said, others where not.
pub(super) fn limits(megabytes: Option<u64>, days: Option<u32>, others: Limits) -> Limits {
    Limits {
        size: megabytes.map_or(others.size, |megabytes| megabytes.saturating_mul(1_000_000)),
        age: days.map_or(others.age, |days| days * DAY),
    }
}
