//! Where the cache lies. The environment is read by whoever calls this, not here.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Where the cache's directory may be named, the strongest first.
#[derive(Debug, Clone, Default)]
pub struct CacheNames {
    /// The command line's directory, relative to the current one.
    pub option: Option<PathBuf>,
    /// The environment's: `EGG_CACHE_DIR`.
    pub variable: Option<OsString>,
}

/// The cache's directory: the option, or the variable, or `egg` in the user's cache directory.
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
        .or_else(|| user_directory(System::CURRENT, environment))
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
    // As the XDG specification says, a relative path is passed over.
    let absolute = |name: &str| {
        let path = PathBuf::from(environment(name)?);
        path.has_root().then_some(path)
    };
    let below = |path: PathBuf, parts: &str| path.join(Path::new(parts));
    match system {
        System::Windows => absolute("LOCALAPPDATA").map(|path| below(path, "egg/cache")),
        System::Mac => absolute("HOME").map(|path| below(path, "Library/Caches/egg")),
        System::Other => absolute("XDG_CACHE_HOME")
            .map(|path| below(path, "egg"))
            .or_else(|| absolute("HOME").map(|path| below(path, ".cache/egg"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn environment(name: &str) -> Option<OsString> {
        match name {
            "HOME" => Some("/home/u".into()),
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
        };
        let found = |names: &CacheNames| cache_directory(names, &environment);
        assert_eq!(found(&names), Some("here".into()));
        names.option = None;
        assert_eq!(found(&names), Some("there".into()));
        names.variable = Some(OsString::new());
        assert_eq!(found(&names), user_directory(System::CURRENT, &environment));
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
