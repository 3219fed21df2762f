//! Where the cache lies. The environment is read by whoever calls this, not here.

use std::ffi::OsString;
use std::path::PathBuf;

/// Where the cache's directory may be named, the strongest first.
#[derive(Debug, Clone, Default)]
pub struct CacheNames {
    /// The command line's directory, relative to the current one.
    pub option: Option<PathBuf>,
    /// The environment's: `EGG_CACHE_DIR`.
    pub variable: Option<OsString>,
    /// The user's configuration's.
    pub configured: Option<PathBuf>,
}

/// The cache's directory: the option, or the variable, or what the user configured, or `egg` in the
/// user's cache directory.
/// `None` if the environment does not even tell a home; `environment` looks variables up.
pub fn cache_directory(
    names: &CacheNames,
    environment: &dyn Fn(&str) -> Option<OsString>,
) -> Option<PathBuf> {
    let variable = names.variable.as_ref().filter(|value| !value.is_empty());
    names
        .option
        .clone()
        .or_else(|| variable.map(PathBuf::from))
        .or_else(|| names.configured.clone())
        .or_else(|| user_directory(System::CURRENT, environment))
}

/// The directory of the user's configuration of egg. `None` if the environment does not even tell a
/// home; `environment` looks variables up.
pub fn user_config_directory(environment: &dyn Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    config_directory(System::CURRENT, environment)
}

fn config_directory(
    system: System,
    environment: &dyn Fn(&str) -> Option<OsString>,
) -> Option<PathBuf> {
    let below = |name: &str, parts: &str| Some(absolute(environment, name)?.join(parts));
    match system {
        System::Windows => below("APPDATA", "egg"),
        System::Mac => below("HOME", "Library/Application Support/egg"),
        System::Other => below("XDG_CONFIG_HOME", "egg").or_else(|| below("HOME", ".config/egg")),
    }
}

/// The path in a variable. As the XDG specification says, a relative one is passed over.
fn absolute(environment: &dyn Fn(&str) -> Option<OsString>, name: &str) -> Option<PathBuf> {
    let path = PathBuf::from(environment(name)?);
    path.has_root().then_some(path)
}

/// Systems with different habits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum System {
    Windows,
    Mac,
    /// Linux and all that follow the XDG base directories.
    Other,
}

impl System {
    const CURRENT: Self = if cfg!(windows) {
        Self::Windows
    } else if cfg!(target_os = "macos") {
        Self::Mac
    } else {
        Self::Other
    };
}

fn user_directory(
    system: System,
    environment: &dyn Fn(&str) -> Option<OsString>,
) -> Option<PathBuf> {
    let below = |name: &str, parts: &str| Some(absolute(environment, name)?.join(parts));
    match system {
        System::Windows => below("LOCALAPPDATA", "egg/cache"),
        System::Mac => below("HOME", "Library/Caches/egg"),
        System::Other => below("XDG_CACHE_HOME", "egg").or_else(|| below("HOME", ".cache/egg")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn environment(name: &str) -> Option<OsString> {
        match name {
            "HOME" => Some("/home/u".into()),
            "APPDATA" => Some("/c/roaming".into()),
            "LOCALAPPDATA" => Some("/c/local".into()),
            "XDG_CACHE_HOME" => Some("relative".into()),
            _ => None,
        }
    }

    #[test]
    fn the_option_wins_over_the_variable_over_the_habit() {
        let mut names = CacheNames {
            option: Some("here".into()),
            variable: Some("there".into()),
            configured: Some("elsewhere".into()),
        };
        let found = |names: &CacheNames| cache_directory(names, &environment);
        assert_eq!(found(&names), Some("here".into()));
        names.option = None;
        assert_eq!(found(&names), Some("there".into()));
        names.variable = Some(OsString::new());
        assert_eq!(found(&names), Some("elsewhere".into()));
        names.configured = None;
        assert_eq!(found(&names), user_directory(System::CURRENT, &environment));
    }

    #[test]
    fn the_configuration_has_a_place_on_every_system() {
        let found = |system| config_directory(system, &environment);
        assert_eq!(found(System::Other), Some("/home/u/.config/egg".into()));
        assert_eq!(
            found(System::Mac),
            Some("/home/u/Library/Application Support/egg".into())
        );
        assert_eq!(found(System::Windows), Some("/c/roaming/egg".into()));
        assert_eq!(config_directory(System::Mac, &|_| None), None);
    }

    #[test]
    fn every_system_has_its_habit() {
        let found = |system| user_directory(system, &environment);
        assert_eq!(found(System::Other), Some("/home/u/.cache/egg".into()));
        assert_eq!(
            found(System::Mac),
            Some("/home/u/Library/Caches/egg".into())
        );
        assert_eq!(found(System::Windows), Some("/c/local/egg/cache".into()));
        let xdg = |name: &str| (name == "XDG_CACHE_HOME").then(|| "/x".into());
        assert_eq!(user_directory(System::Other, &xdg), Some("/x/egg".into()));
        assert_eq!(user_directory(System::Other, &|_| None), None);
    }
}
