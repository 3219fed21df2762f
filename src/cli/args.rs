//! What can be typed.

use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use std::path::PathBuf;

/// Compiles project files into elastic geodesic grids: flat lamellae that unfold into curved
/// structures.
#[derive(Debug, Parser)]
#[command(name = "egg", version, propagate_version = true, max_term_width = 100)]
#[command(after_help = "\
Exit codes: 0 done, 1 the project has errors, 2 wrong usage or an internal error, 130 interrupted.
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
    /// Check a project without writing files
    Check {
        #[command(flatten)]
        file: ProjectFile,
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
    /// Write the plan to standard output
    Export {
        #[command(flatten)]
        file: ProjectFile,
        /// Notation of the plan
        #[arg(long, value_enum, default_value_t)]
        format: PlanFormat,
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
}
