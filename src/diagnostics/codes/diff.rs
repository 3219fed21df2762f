//! Codes of comparing plans, of revisions and locks: `E082x` to `E084x`.

use super::{Code, CodeInfo};

/// `git` cannot be run.
pub const NO_GIT: Code = Code::new("E0820");
/// No repository around the project.
pub const NO_REPOSITORY: Code = Code::new("E0821");
/// A revision that is not there.
pub const NO_REVISION: Code = Code::new("E0822");
/// A file that a commit does not have.
pub const NO_FILE: Code = Code::new("E0823");
/// A file in a submodule.
pub const SUBMODULE: Code = Code::new("E0824");
/// A pointer without its contents.
pub const POINTER: Code = Code::new("E0825");
/// An object that the clone lacks.
pub const UNREADABLE_OBJECT: Code = Code::new("E0826");
/// A side that cannot be had.
pub const NO_SIDE: Code = Code::new("E0827");
/// A plan that cannot be read.
pub const BAD_PLAN: Code = Code::new("E0828");
/// A plan, lock or difference of another format.
pub const OTHER_FORMAT: Code = Code::new("E0829");
/// A lock that cannot be read.
pub const BAD_LOCK: Code = Code::new("E0830");
/// No lock to check against.
pub const NO_LOCK: Code = Code::new("E0831");
/// A lock that is not what the project gives.
pub const STALE_LOCK: Code = Code::new("E0832");
/// A lock of another project.
pub const FOREIGN_LOCK: Code = Code::new("E0833");
/// Two plans that have nothing in common.
pub const TWO_PROJECTS: Code = Code::new("W0820");

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0820",
        name: "no-git",
        title: "the program `git` cannot be run",
        text: "\
Revisions are read by the program `git`, which is not on the path or ended with an error of its own. \
Plans can be compared without it: `egg diff a/plan.ron b/plan.ron`.",
    },
    CodeInfo {
        code: "E0821",
        name: "no-repository",
        title: "the project is in no git repository",
        text: "\
`egg diff` compares the working tree with `HEAD` where nothing else is said, and revisions with each \
other; for both the project has to lie in a git repository. Start one with `git init`, or compare two \
plans that were built: `egg diff a/plan.ron b/plan.ron`.",
    },
    CodeInfo {
        code: "E0822",
        name: "no-revision",
        title: "a revision does not exist",
        text: "\
The repository knows no such branch, tag or commit. Clones for CI are often shallow and lack older \
commits: fetch them with `git fetch --deepen 100`, or say `fetch-depth: 0` in the workflow.",
    },
    CodeInfo {
        code: "E0823",
        name: "no-file-at-revision",
        title: "a commit does not have a file",
        text: "\
The project file or its mesh is not in the commit under this path. It may have been added later or \
have had another name then. A project file that was renamed cannot be followed: build a plan of each \
side and compare the two with `egg diff a/plan.ron b/plan.ron`.",
    },
    CodeInfo {
        code: "E0824",
        name: "file-in-submodule",
        title: "a file lies in a submodule",
        text: "\
The mesh belongs to another repository, of which the commit records a digest only. egg reads the \
objects of this repository. Check both commits out with their submodules, build a plan of each, and \
compare them: `egg diff a/plan.ron b/plan.ron`.",
    },
    CodeInfo {
        code: "E0825",
        name: "lfs-pointer",
        title: "the contents of a file are in Git LFS and not in this clone",
        text: "\
The commit holds a pointer of Git LFS in place of the file. egg reads the contents from the clone's \
own LFS store and never from the network. `git lfs fetch origin REVISION` brings them; in CI, \
`lfs: true` at the checkout brings those of the revision that is checked out only.",
    },
    CodeInfo {
        code: "E0826",
        name: "object-missing",
        title: "an object of the repository is missing",
        text: "\
A commit lists the file, but its contents cannot be read: the clone is partial and offline, or the \
repository is damaged. `git fetch` brings what is missing, `git fsck` tells what is damaged.",
    },
    CodeInfo {
        code: "E0827",
        name: "nothing-to-compare",
        title: "one side cannot be compared",
        text: "\
The project of this side does not compile (what is wrong is told above), and there is no plan or lock \
of it that could stand for it. A `plan.lock` in git, written by `egg lock`, lets revisions be compared \
that a newer egg no longer compiles.",
    },
    CodeInfo {
        code: "E0828",
        name: "unreadable-plan",
        title: "a plan cannot be read",
        text: "\
The file is no plan that `egg build` wrote, or it was edited or cut off. Build it again; plans are \
results and are not edited.",
    },
    CodeInfo {
        code: "E0829",
        name: "other-format",
        title: "a file has a format that this egg does not know",
        text: "\
Plans, locks and differences carry the version of their format. This one was written by a newer egg. \
Use that one, or build the plan again with this one.",
    },
    CodeInfo {
        code: "E0830",
        name: "lock-unreadable",
        title: "a lock cannot be read",
        text: "\
`plan.lock` has one line a part: kind, id, values, digest. A line cannot be understood, often after a \
merge that left marks of a conflict. `egg lock` writes the file anew.",
    },
    CodeInfo {
        code: "E0831",
        name: "no-lock",
        title: "there is no lock to check against",
        text: "\
`egg check --locked` holds the project to the `plan.lock` beside it, and there is none. `egg lock` \
writes it; commit it with the project file.",
    },
    CodeInfo {
        code: "E0832",
        name: "lock-stale",
        title: "the lock is not what the project gives",
        text: "\
The project, its mesh or egg changed since `plan.lock` was written, and with it the parts. Look at the \
changes (`egg diff plan.lock`); if they are meant, run `egg lock` and commit the file, so that \
reviewers see them.",
    },
    CodeInfo {
        code: "E0833",
        name: "lock-of-another-project",
        title: "the lock belongs to another project",
        text: "\
A folder has one `plan.lock`, and the one here was written for a project of another name. Give each \
project a folder of its own. If the project was renamed, remove the file and run `egg lock` again.",
    },
    CodeInfo {
        code: "W0820",
        name: "two-projects",
        title: "two plans of different projects are compared",
        text: "\
The plans have different names and no patch in common, neither by name nor by place. Everything is \
told as removed and added, which is true and of little use. Are these the files that were meant?",
    },
];
