//! What a plan or a build is asked for.

use super::declare::Instance;

/// What to build, and how.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Request {
    /// Build these targets only, with what they need; all if empty. A name also stands for
    /// everything below it: `west` for `west.u`, and for its parts: `west` for `west-1`.
    pub targets: Vec<String>,
    /// Build these stages only, with what they need; all if empty.
    pub stages: Vec<String>,
    /// Which results are made again although they are known.
    pub force: Force,
    /// How published files are compared with what egg wrote.
    pub outputs: OutputCheck,
    /// What happens to a file that is in the way and was not written by egg.
    pub foreign: Foreign,
}

/// Which results are made again although they are known.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Force {
    /// None.
    #[default]
    Nothing,
    /// Those that the request selects, without what they need.
    Selected,
}

/// How published files are compared with what egg wrote.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum OutputCheck {
    /// By size and times; by contents only where these differ.
    #[default]
    Stamps,
    /// By contents.
    Contents,
    /// Not at all: nothing is published, and nothing that was published is removed.
    Ignore,
}

/// What happens to a file that is in the way and was not written by egg.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Foreign {
    /// It stays, and that is an error.
    #[default]
    Keep,
    /// It is replaced.
    Replace,
}

impl Request {
    /// Whether the request names the instance (or everything).
    pub fn selects(&self, instance: &Instance) -> bool {
        let below = |name: &String| {
            instance
                .target
                .strip_prefix(name.as_str())
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        (self.stages.is_empty() || self.stages.contains(&instance.stage))
            && (self.targets.is_empty() || self.targets.iter().any(below))
    }

    /// Whether the request is for everything.
    pub fn is_whole(&self) -> bool {
        self.stages.is_empty() && self.targets.is_empty()
    }
}
