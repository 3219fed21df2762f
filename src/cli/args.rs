//! What can be typed.

use crate::diff::Class;
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use std::path::PathBuf;

/// Compiles project files into elastic geodesic grids: flat lamellae that unfold into curved
/// structures.
#[derive(Debug, Parser)]
#[command(name = "egg", version, propagate_version = true, max_term_width = 100)]
#[command(after_help = "\
Exit codes: 0 done, 1 the project has errors, 2 wrong usage or an internal error, 3 differences
(`egg diff --exit-code`), 130 interrupted.
Results go to standard output, messages and progress to standard error.")]
pub(super) struct Cli {
    #[command(flatten)]
    pub(super) global: Global,
    #[command(subcommand)]
    pub(super) command: Command,
}

/// Options of every command.
#[derive(Debug, Args)]
#[command(next_help_heading = "Global options")]
pub(super) struct Global {
    /// How diagnostics and progress are written: for people, or one JSON object a line on standard
    /// output
    #[arg(
        long,
        global = true,
        value_enum,
        default_value_t,
        value_name = "FORMAT"
    )]
    pub(super) message_format: MessageFormat,
    /// When to use colour; `auto` also obeys `NO_COLOR` and `FORCE_COLOR`
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    pub(super) color: ColorWhen,
    /// Say nothing but errors
    #[arg(long, short, global = true)]
    pub(super) quiet: bool,
    /// Number of threads; all processors where unsaid
    #[arg(long, short, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) jobs: Option<u16>,
    /// Output directory; `build/NAME` beside the project file where unsaid
    #[arg(long, global = true, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(super) out: Option<PathBuf>,
    /// Directory of the cache; `EGG_CACHE_DIR`, the user's configuration or cache directory where
    /// unsaid
    #[arg(long, global = true, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(super) cache_dir: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum MessageFormat {
    #[default]
    Human,
    Json,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum ColorWhen {
    #[default]
    Auto,
    Always,
    Never,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Start a project: a commented project file and a mesh that build as they are
    Init {
        /// Name of the project and of its folder
        name: String,
    },
    /// Check a project without writing files, and print the criteria of its patches
    Check {
        #[command(flatten)]
        file: ProjectFile,
        /// How the criteria are printed
        #[arg(long, value_enum, default_value_t)]
        format: CheckFormat,
        /// Also hold the project to the `plan.lock` beside it
        #[arg(long)]
        locked: bool,
    },
    /// Split patches that cannot be built in one piece, and print the points and patches as text
    /// for the project file
    Split {
        #[command(flatten)]
        file: ProjectFile,
        /// How; `split.workflow` of the project where unsaid, or automatic
        #[arg(long, value_enum)]
        workflow: Option<SplitWorkflow>,
    },
    /// Compile a project into its plan, drawings and tables
    Build {
        #[command(flatten)]
        file: ProjectFile,
        #[command(flatten)]
        selection: Selection,
        /// Only tell what would be done
        #[arg(long)]
        dry_run: bool,
        /// Replace files that are in the way and were not written by egg
        #[arg(long)]
        force: bool,
    },
    /// Write the test pieces that tell kerf and fit of a machine
    Coupon {
        #[command(flatten)]
        file: ProjectFile,
    },
    /// Read the files of a build back and compare them with its plan
    Verify {
        /// The output directory of a build
        #[arg(value_name = "FOLDER", value_hint = ValueHint::DirPath)]
        folder: PathBuf,
    },
    /// Write the plan to standard output
    Export {
        #[command(flatten)]
        file: ProjectFile,
        /// Notation of the plan
        #[arg(long, value_enum, default_value_t)]
        format: PlanFormat,
    },
    /// Tell what a change does to the parts: of the working tree against HEAD, of two revisions, or
    /// of two plans
    Diff(DiffArguments),
    /// Write `plan.lock`, a line a part, for `egg check --locked` and for reviews
    Lock {
        #[command(flatten)]
        file: ProjectFile,
    },
    /// Let `git diff` show parts of plans and drawings
    Git {
        #[command(subcommand)]
        command: GitCommand,
    },
    /// Print a JSON schema
    Schema {
        /// Of what
        #[arg(value_enum)]
        of: SchemaOf,
    },
    /// Explain a diagnostic, or why an output is as it is
    Explain {
        /// A code such as E0503 or the name of a lint; or [FILE] and an output such as
        /// `fabrication/NAME.dxf` or a stage such as `cladding west`
        #[arg(required = true, num_args = 1..=2, value_name = "WHAT")]
        what: Vec<String>,
    },
    /// Print the dependency graph
    Graph {
        #[command(flatten)]
        file: ProjectFile,
        /// Notation of the graph
        #[arg(long, value_enum, default_value_t)]
        format: GraphFormat,
    },
    /// Build whenever the project file or its mesh is saved
    Watch {
        #[command(flatten)]
        file: ProjectFile,
        #[command(flatten)]
        selection: Selection,
    },
    /// Look after the cache of results
    Cache {
        #[command(subcommand)]
        command: CacheCommand,
    },
    /// List the built-in materials with their sources
    Materials,
    /// Print completions for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// `egg diff`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  egg diff                                working tree against HEAD
  egg diff HEAD~3 HEAD pavilion.toml      two revisions, compiled through the cache
  egg diff main...                        what this branch changed
  egg diff a/plan.ron b/plan.ron          two plans
  egg diff plan.lock                      what the project gives against its lock
  egg diff --format html --to diff.html   a page to look at")]
pub(super) struct DiffArguments {
    /// What is compared, before and after: revisions (or `A..B`), plans (`plan.ron`), locks, one saved
    /// difference (`.json`); none is the working tree against HEAD. A project file (`.toml`, `.ron`)
    /// beside them says which one is meant where a folder has several
    #[arg(value_name = "WHAT", num_args = 0..=3)]
    pub(super) sides: Vec<String>,
    /// How the difference is written
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(super) format: DiffFormat,
    /// Where it is written: a file; of `svg` also a folder, which gets one file a drawing
    #[arg(long, value_name = "PATH", value_hint = ValueHint::AnyPath)]
    pub(super) to: Option<PathBuf>,
    /// What is noise: `0.05mm` for lengths, or `angle=0.1deg`, `share=0.1%`, `relative=1%`
    #[arg(long, value_name = "TOLERANCE")]
    pub(super) tolerance: Vec<String>,
    /// Exit with 3 if there are differences
    #[arg(long)]
    pub(super) exit_code: bool,
    /// From which class on differences count for the exit code, which it asks for; recut where
    /// unsaid
    #[arg(long, value_enum, value_name = "CLASS")]
    pub(super) fail_on: Option<FailOn>,
    /// Show long lists in full
    #[arg(long)]
    pub(super) all: bool,
    /// Largest size of Markdown; GitHub takes 65536 characters
    #[arg(long, value_name = "BYTES", value_parser = clap::value_parser!(u32).range(2000..))]
    pub(super) max_bytes: Option<u32>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum DiffFormat {
    /// For a terminal
    #[default]
    Text,
    /// For a comment in a review
    Markdown,
    /// The document that all others are made from
    Json,
    /// Overlays
    Svg,
    /// A page with list and drawings
    Html,
}

/// A class of changes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum FailOn {
    /// A part has to be cut
    #[default]
    Recut,
    /// The same, or parts go elsewhere
    Reassemble,
    /// The same, or drawings and labels change
    Redraw,
}

impl FailOn {
    pub(super) fn class(self) -> Class {
        match self {
            Self::Recut => Class::Recut,
            Self::Reassemble => Class::Reassemble,
            Self::Redraw => Class::Redraw,
        }
    }
}

#[derive(Debug, Subcommand)]
pub(super) enum GitCommand {
    /// Set the driver up in this clone
    Install {
        /// Where attributes are written: `local` in `.git/info`, `shared` in `.gitattributes`, to
        /// be committed
        #[arg(long, value_enum, default_value_t, value_name = "WHERE")]
        attributes: Attributes,
    },
    /// Take it away again
    Uninstall,
    /// Print a plan or a drawing as text by parts; git calls this
    Textconv {
        /// The file
        file: PathBuf,
    },
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Attributes {
    #[default]
    Local,
    Shared,
}

#[derive(Debug, Args)]
pub(super) struct ProjectFile {
    /// The project file; the one of the current folder where unsaid
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) path: Option<PathBuf>,
}

/// A part of a graph.
#[derive(Debug, Args)]
pub(super) struct Selection {
    /// Build only these targets (a patch, `west.u`, a point) with what they need
    #[arg(long, value_name = "TARGET")]
    pub(super) only: Vec<String>,
    /// Build only these stages with what they need
    #[arg(long, value_name = "STAGE")]
    pub(super) stage: Vec<String>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum PlanFormat {
    #[default]
    Json,
    Ron,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum CheckFormat {
    /// For people
    #[default]
    Table,
    /// For scripts
    Json,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SplitWorkflow {
    /// Sides over peaks of curvature, corners on them where that is not enough
    Automatic,
    /// By curvature: corners on peaks, patches as large as they can be, neighbours merged
    Informed,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum GraphFormat {
    /// Graphviz
    #[default]
    Dot,
    Json,
}

#[derive(Debug, Subcommand)]
pub(super) enum CacheCommand {
    /// What is in the cache
    Status,
    /// Read everything and set damaged files aside
    Verify {
        /// Only tell
        #[arg(long)]
        dry_run: bool,
    },
    /// Remove what was not used for long, and what is too much
    Gc {
        /// Only tell
        #[arg(long)]
        dry_run: bool,
        /// Megabytes to keep
        #[arg(long, value_name = "MB")]
        max_size: Option<u64>,
        /// Days to keep
        #[arg(long, value_name = "DAYS")]
        max_age: Option<u32>,
    },
    /// Remove everything
    Clean {
        /// Only tell
        #[arg(long)]
        dry_run: bool,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SchemaOf {
    /// The project file
    Project,
    /// The plan
    Plan,
    /// What `egg check --format json` writes
    Check,
    /// What `egg diff --format json` writes
    Difference,
}
