//! A git repository in a workshop.

use crate::edit::Project;
use crate::program::{Ran, Workshop};
use std::path::Path;
use std::process::Command;

/// The folder `repo` of a workshop under git, without the user's configuration.
pub(crate) struct Repository<'w> {
    pub(crate) workshop: &'w Workshop,
    pub(crate) folder: &'static str,
}

impl<'w> Repository<'w> {
    /// An empty repository.
    pub(crate) fn new(workshop: &'w Workshop) -> Self {
        let repository = Self {
            workshop,
            folder: "repo",
        };
        std::fs::create_dir_all(workshop.path("repo")).expect("a folder");
        repository.git(&["init", "--quiet", "--initial-branch", "main"]);
        repository
    }

    /// With the project as its first commit.
    pub(crate) fn with_bays(workshop: &'w Workshop) -> Self {
        let repository = Self::new(workshop);
        repository.commit(&Project::bays(), "Start with two bays");
        repository
    }

    /// Runs git in the folder.
    #[track_caller]
    pub(crate) fn git(&self, arguments: &[&str]) -> String {
        let output = isolated(&mut Command::new("git"), &self.workshop.path(""))
            .current_dir(self.workshop.path(self.folder))
            .args(arguments)
            .output()
            .expect("git runs");
        let ran = Ran::of(&output);
        assert_eq!(
            ran.code,
            Some(0),
            "git {arguments:?}\n{}{}",
            ran.out,
            ran.err
        );
        ran.out
    }

    /// Writes a project and commits everything.
    #[track_caller]
    pub(crate) fn commit(&self, project: &Project, message: &str) {
        project.write(self.workshop, self.folder);
        self.git(&["add", "--all"]);
        self.git(&["commit", "--quiet", "--message", message]);
    }

    /// Runs `egg` in the folder.
    pub(crate) fn egg(&self, arguments: &[&str]) -> Ran {
        self.egg_in(self.folder, arguments)
    }

    /// Runs `egg` in another folder of the workshop.
    pub(crate) fn egg_in(&self, folder: &str, arguments: &[&str]) -> Ran {
        let mut command = self.workshop.command(arguments);
        command.current_dir(self.workshop.path(folder));
        Ran::of(
            &isolated(&mut command, &self.workshop.path(""))
                .output()
                .expect("egg runs"),
        )
    }
}

/// Keeps the user's configuration and identity out.
fn isolated<'c>(command: &'c mut Command, home: &Path) -> &'c mut Command {
    for name in ["GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE"] {
        command.env_remove(name);
    }
    command
        .env("HOME", home)
        .env("XDG_CONFIG_HOME", home)
        .env("GIT_CONFIG_NOSYSTEM", "1")
        // A ceiling does not hold for a search that begins in it.
        .env("GIT_CEILING_DIRECTORIES", home.parent().unwrap_or(home))
        .env("GIT_ALLOW_PROTOCOL", "file")
        .env("GIT_AUTHOR_NAME", "Ada")
        .env("GIT_AUTHOR_EMAIL", "ada@example.org")
        .env("GIT_COMMITTER_NAME", "Ada")
        .env("GIT_COMMITTER_EMAIL", "ada@example.org")
        .env("GIT_AUTHOR_DATE", "2021-05-01T12:00:00Z")
        .env("GIT_COMMITTER_DATE", "2021-05-01T12:00:00Z")
}
