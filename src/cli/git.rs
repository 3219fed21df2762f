//! Reading revisions from the objects of a git repository, without touching its work tree.
//!
//! The `git` program does the reading: it is there wherever there is a repository to compare in,
//! and it knows every form that a repository can have (packs, alternates, partial and shallow
//! clones, worktrees, SHA-256, `safe.directory`), which a library would bring along as a hundred
//! crates. One process resolves a revision, one more answers all questions for files.

use crate::diagnostics::codes::diff as codes;
use crate::diagnostics::{Code, Diagnostic};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A repository, seen from a folder in it.
#[derive(Debug)]
pub(super) struct Repository {
    /// Where `git` runs.
    folder: PathBuf,
    /// The folder in the tree, with a slash at its end; empty at the top and in a bare clone.
    prefix: String,
    /// Whether there is a work tree.
    pub(super) kind: RepositoryKind,
    /// Where objects of extensions lie, those of LFS for one.
    common: PathBuf,
}

/// Whether a repository has a work tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RepositoryKind {
    /// It has one.
    WorkTree,
    /// It has objects only.
    Bare,
}

/// A commit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Commit {
    /// Its digest.
    pub(super) id: String,
    /// First line of its message.
    pub(super) subject: String,
}

impl Repository {
    /// The repository around a folder.
    pub(super) fn around(folder: &Path) -> Result<Self, Diagnostic> {
        let ask = |arguments: &[&str]| {
            let output = git(folder).arg("rev-parse").args(arguments).output();
            output.map_err(|error| no_git(&error))
        };
        let output = ask(&["--is-bare-repository", "--git-common-dir"])?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(no_repository(folder, said.trim()));
        }
        let text = String::from_utf8_lossy(&output.stdout);
        let mut lines = text.lines();
        let bare = lines.next() == Some("true");
        let common = folder.join(lines.next().unwrap_or(".git"));
        let prefix = if bare {
            String::new()
        } else {
            let output = ask(&["--show-prefix"])?;
            String::from_utf8_lossy(&output.stdout)
                .trim_end_matches('\n')
                .to_owned()
        };
        Ok(Self {
            folder: folder.to_owned(),
            prefix,
            kind: if bare {
                RepositoryKind::Bare
            } else {
                RepositoryKind::WorkTree
            },
            common,
        })
    }

    /// The path in the tree of a path below the folder, dots resolved; `None` if it leaves the
    /// tree.
    pub(super) fn path(&self, below: &str) -> Option<String> {
        resolved(&format!("{}{}", self.prefix, below.replace('\\', "/")))
    }

    /// The folder in the tree, without a slash at its end.
    pub(super) fn prefix(&self) -> &str {
        self.prefix.trim_end_matches('/')
    }

    /// The commit that a revision names.
    pub(super) fn commit(&self, revision: &str) -> Result<Commit, Diagnostic> {
        let name = format!("{revision}^{{commit}}");
        let output = git(&self.folder)
            .args([
                "rev-parse",
                "--verify",
                "--quiet",
                "--end-of-options",
                &name,
            ])
            .output()
            .map_err(|error| no_git(&error))?;
        let text = String::from_utf8_lossy(&output.stdout);
        let id = text.lines().last().unwrap_or("").trim();
        if !output.status.success() || id.is_empty() {
            return Err(self.no_revision(revision));
        }
        Ok(Commit {
            id: id.to_owned(),
            subject: String::new(),
        })
    }

    /// The last commit that two revisions have in common.
    pub(super) fn merge_base(&self, a: &str, b: &str) -> Result<String, Diagnostic> {
        let ends = [self.commit(a)?.id, self.commit(b)?.id];
        let output = git(&self.folder)
            .arg("merge-base")
            .args(&ends)
            .output()
            .map_err(|error| no_git(&error))?;
        let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        if text.is_empty() {
            let message = format!("`{a}` and `{b}` have no commit in common");
            return Err(Diagnostic::error(NO_REVISION, message));
        }
        Ok(text)
    }

    /// Files in a folder of a commit, without those in folders below it.
    pub(super) fn files(&self, commit: &Commit, folder: &str) -> Result<Vec<String>, Diagnostic> {
        let tree = format!("{}:{folder}", commit.id);
        let output = git(&self.folder)
            .args(["ls-tree", "-z", "--name-only", "--end-of-options", &tree])
            .output()
            .map_err(|error| no_git(&error))?;
        let text = String::from_utf8_lossy(&output.stdout);
        Ok(text
            .split('\0')
            .filter(|name| !name.is_empty())
            .map(str::to_owned)
            .collect())
    }

    /// Starts reading files.
    pub(super) fn reader(&self) -> Result<Reader<'_>, Diagnostic> {
        let mut child = git(&self.folder)
            .args(["cat-file", "--batch", "--follow-symlinks"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| no_git(&error))?;
        let pipes = child.stdin.take().zip(child.stdout.take());
        let (questions, answers) = pipes.ok_or_else(|| broken("it has no pipes"))?;
        Ok(Reader {
            repository: self,
            child,
            questions: Some(questions),
            answers: BufReader::new(answers),
        })
    }

    fn no_revision(&self, revision: &str) -> Diagnostic {
        let message = format!("there is no revision `{revision}`");
        let error = Diagnostic::error(NO_REVISION, message);
        let shallow = git(&self.folder)
            .args(["rev-parse", "--is-shallow-repository"])
            .output();
        let shallow = shallow.is_ok_and(|output| output.stdout.starts_with(b"true"));
        if shallow {
            error
                .note("this clone is shallow: it lacks older commits")
                .help("fetch more of them: `git fetch --deepen 100`, or `fetch-depth: 0` in CI")
        } else {
            error.help("revisions are branches, tags, digests, `HEAD~3`: what `git log` takes")
        }
    }

    /// Why a path of a commit cannot be read.
    fn why_missing(&self, commit: &Commit, label: &str, path: &str) -> Diagnostic {
        let mut prefix = String::new();
        let mut arguments = Vec::new();
        for part in path.split('/') {
            if !prefix.is_empty() {
                prefix.push('/');
            }
            prefix.push_str(part);
            arguments.push(prefix.clone());
        }
        let output = git(&self.folder)
            .args(["ls-tree", "-z", "--full-tree", &commit.id, "--"])
            .args(&arguments)
            .output();
        let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
        let text = text.unwrap_or_default();
        for entry in text.split('\0') {
            let Some((about, name)) = entry.split_once('\t') else {
                continue;
            };
            if about.starts_with("160000 ") {
                let digest = about.rsplit(' ').next().unwrap_or("");
                return Diagnostic::error(
                    SUBMODULE,
                    format!("`{path}` lies in the submodule `{name}` at `{label}`"),
                )
                .note(format!(
                    "the submodule is at its commit {}, whose files are not in this repository",
                    digest.get(..8).unwrap_or(digest)
                ))
                .help(
                    "build a plan of each side in a clone with `--recurse-submodules`, and \
                     compare the two: `egg diff a/plan.ron b/plan.ron`",
                );
            }
            if name == path && about.starts_with("10") {
                return Diagnostic::error(
                    UNREADABLE,
                    format!("the contents of `{path}` at `{label}` are not in this clone"),
                )
                .note("the commit lists the file, but its object is missing or damaged")
                .help("fetch it (`git fetch`), or look with `git fsck`");
            }
        }
        Diagnostic::error(NO_FILE, format!("there is no `{path}` at `{label}`"))
            .help("was it added later, or had it another name? `git log --follow` tells")
    }

    /// The contents behind a pointer of Git LFS, if this clone has them.
    fn stored(&self, pointer: &Pointer) -> Option<Vec<u8>> {
        let digest = &pointer.digest;
        let path = self.common.join("lfs/objects");
        let path = path
            .join(digest.get(..2)?)
            .join(digest.get(2..4)?)
            .join(digest);
        let bytes = std::fs::read(path).ok()?;
        (bytes.len() as u64 == pointer.size).then_some(bytes)
    }
}

/// A path in a tree, dots resolved; `None` if it leaves the tree.
pub(super) fn resolved(path: &str) -> Option<String> {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// Reads files of commits, one after the other.
#[derive(Debug)]
pub(super) struct Reader<'r> {
    repository: &'r Repository,
    child: Child,
    questions: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Reader<'_> {
    /// The commit with its subject.
    pub(super) fn subject(&mut self, commit: Commit) -> Result<Commit, Diagnostic> {
        let text = match self.ask(&commit.id)? {
            Answer::Found(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Answer::Missing => return Err(broken("it does not have the commit that it named")),
        };
        let message = text.split_once("\n\n").map_or("", |(_, message)| message);
        let subject = message.lines().find(|line| !line.trim().is_empty());
        Ok(Commit {
            subject: subject.unwrap_or("").trim().to_owned(),
            ..commit
        })
    }

    /// A file of a commit; of a pointer of Git LFS the contents. `label` is what the user calls
    /// the commit.
    pub(super) fn file(
        &mut self,
        commit: &Commit,
        label: &str,
        path: &str,
    ) -> Result<Vec<u8>, Diagnostic> {
        let bytes = match self.ask(&format!("{}:{path}", commit.id))? {
            Answer::Found(bytes) => bytes,
            Answer::Missing => return Err(self.repository.why_missing(commit, label, path)),
        };
        let Some(pointer) = Pointer::read(&bytes) else {
            return Ok(bytes);
        };
        self.repository.stored(&pointer).ok_or_else(|| {
            Diagnostic::error(
                POINTER,
                format!("`{path}` at `{label}` is a pointer of Git LFS"),
            )
            .note(format!(
                "its contents, {:.1} MB, are not in this clone",
                pointer.size as f64 / 1e6
            ))
            .help(format!(
                "get them first: `git lfs fetch origin {}`",
                commit.id
            ))
        })
    }

    /// A file of a commit, if it is there.
    pub(super) fn file_if_there(&mut self, commit: &Commit, path: &str) -> Option<Vec<u8>> {
        match self.ask(&format!("{}:{path}", commit.id)) {
            Ok(Answer::Found(bytes)) if Pointer::read(&bytes).is_none() => Some(bytes),
            _ => None,
        }
    }

    fn ask(&mut self, name: &str) -> Result<Answer, Diagnostic> {
        if name.contains(['\n', '\r']) {
            return Ok(Answer::Missing);
        }
        let failed = |error: std::io::Error| broken(&error.to_string());
        let questions = self
            .questions
            .as_mut()
            .ok_or_else(|| broken("it has ended"))?;
        questions
            .write_all(format!("{name}\n").as_bytes())
            .map_err(failed)?;
        questions.flush().map_err(failed)?;
        let mut head = String::new();
        self.answers.read_line(&mut head).map_err(failed)?;
        let head = head.trim_end_matches('\n');
        if head.is_empty() {
            return Err(broken("it ended too early"));
        }
        let size = |text: &str| text.rsplit(' ').next().and_then(|size| size.parse().ok());
        if head.ends_with(" missing") || head.ends_with(" ambiguous") {
            return Ok(Answer::Missing);
        }
        let Some(size): Option<usize> = size(head) else {
            return Err(broken(&format!("it answered `{head}`")));
        };
        let mut bytes = vec![0; size];
        self.answers.read_exact(&mut bytes).map_err(failed)?;
        let mut end = [0];
        self.answers.read_exact(&mut end).map_err(failed)?;
        // `OID blob SIZE` and `OID commit SIZE` are what was asked for. `symlink SIZE` leaves the
        // tree; `dangling SIZE`, `loop SIZE` and `notdir SIZE` lead nowhere; a tree is no file.
        let words: Vec<&str> = head.split(' ').collect();
        Ok(match words.as_slice() {
            [_, "blob" | "commit", _] => Answer::Found(bytes),
            _ => Answer::Missing,
        })
    }
}

impl Drop for Reader<'_> {
    fn drop(&mut self) {
        // Without questions it ends by itself.
        drop(self.questions.take());
        self.child.wait().ok();
    }
}

enum Answer {
    Found(Vec<u8>),
    Missing,
}

/// What stands for a large file in a repository with Git LFS.
#[derive(Debug, PartialEq, Eq)]
struct Pointer {
    digest: String,
    size: u64,
}

impl Pointer {
    /// Pointers are shorter than this.
    const LONGEST: usize = 1024;

    fn read(bytes: &[u8]) -> Option<Self> {
        if bytes.len() > Self::LONGEST {
            return None;
        }
        let text = std::str::from_utf8(bytes).ok()?;
        if !text.starts_with("version https://git-lfs.github.com/spec/") {
            return None;
        }
        let value = |key: &str| text.lines().find_map(|line| line.strip_prefix(key));
        let digest = value("oid sha256:")?.trim();
        let is_hex = digest.len() == 64 && digest.bytes().all(|byte| byte.is_ascii_hexdigit());
        Some(Self {
            digest: is_hex.then(|| digest.to_owned())?,
            size: value("size ")?.trim().parse().ok()?,
        })
    }
}

const NO_GIT: Code = codes::NO_GIT;
const NO_REPOSITORY: Code = codes::NO_REPOSITORY;
const NO_REVISION: Code = codes::NO_REVISION;
const NO_FILE: Code = codes::NO_FILE;
const SUBMODULE: Code = codes::SUBMODULE;
const POINTER: Code = codes::POINTER;
const UNREADABLE: Code = codes::UNREADABLE_OBJECT;

/// `git`, asking nothing, changing nothing, speaking English, in a folder.
pub(super) fn git(folder: &Path) -> Command {
    let mut command = Command::new("git");
    command
        .arg("-C")
        .arg(folder)
        .args(["-c", "core.quotePath=false"])
        .stdin(Stdio::null())
        .env("GIT_OPTIONAL_LOCKS", "0")
        .env("GIT_TERMINAL_PROMPT", "0")
        .env("LC_ALL", "C");
    command
}

pub(super) fn no_git(error: &std::io::Error) -> Diagnostic {
    Diagnostic::error(NO_GIT, format!("the program `git` cannot be run: {error}"))
        .help("install git, or compare two plans: `egg diff a/plan.ron b/plan.ron`")
}

fn no_repository(folder: &Path, said: &str) -> Diagnostic {
    let message = format!("`{}` is in no git repository", folder.display());
    let error = Diagnostic::error(NO_REPOSITORY, message);
    let error = if said.is_empty() || said.contains("not a git repository") {
        error
    } else {
        error.note(format!("git says: {said}"))
    };
    error.help("compare two plans instead: `egg diff a/plan.ron b/plan.ron`")
}

fn broken(what: &str) -> Diagnostic {
    Diagnostic::error(NO_GIT, format!("`git` cannot be read from: {what}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pointer_of_lfs_is_told_from_a_file() {
        let digest = "4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393";
        let text = format!(
            "version https://git-lfs.github.com/spec/v1\noid sha256:{digest}\nsize 12345\n"
        );
        let pointer = Pointer::read(text.as_bytes()).unwrap();
        assert_eq!((pointer.digest.as_str(), pointer.size), (digest, 12345));
        assert_eq!(Pointer::read(b"v 0 0 0\n"), None);
        assert_eq!(Pointer::read(text.replace("4d7a", "../.").as_bytes()), None);
    }

    #[test]
    fn paths_in_the_tree_have_no_dots() {
        let repository = Repository {
            folder: PathBuf::new(),
            prefix: "designs/dome/".to_owned(),
            kind: RepositoryKind::WorkTree,
            common: PathBuf::new(),
        };
        let path = |below: &str| repository.path(below);
        assert_eq!(path("dome.toml").as_deref(), Some("designs/dome/dome.toml"));
        assert_eq!(
            path("../meshes/./a.obj").as_deref(),
            Some("designs/meshes/a.obj")
        );
        assert_eq!(path("../../../a.obj"), None);
    }
}
