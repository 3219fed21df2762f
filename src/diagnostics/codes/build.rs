//! Codes of the incremental engine: the cache, running stages, the output directory.

use super::CodeInfo;

pub(super) const CODES: &[CodeInfo] = &[
    CodeInfo {
        code: "E0801",
        name: "stage-broke-down",
        title: "a stage of the compiler broke down",
        text: "A part of egg stopped where it should have gone on or given an error with a reason. \
               This is a defect of egg, not of the project. Other stages have finished and are \
               kept; the one that broke down runs again in the next build.\n\n\
               Please report it with the project file, the mesh, and what `egg --version` prints.",
    },
    CodeInfo {
        code: "E0802",
        name: "input-without-key",
        title: "the input of a stage cannot be told apart from others",
        text: "Results are found again by what they were made from. An input that contains \
               something without a fixed value (not a number, a map without an order) has no such \
               name, and its stage does not run. This is a defect of egg: values that a project \
               file can hold are checked before.",
    },
    CodeInfo {
        code: "E0803",
        name: "stage-declared-twice",
        title: "two stages have the same name and target",
        text: "The graph of a build names every stage by what it does and for what: `cladding \
               west`. Two with the same name cannot be told apart in messages and in the cache. \
               This is a defect of egg, not of the project.",
    },
    CodeInfo {
        code: "E0804",
        name: "result-not-encodable",
        title: "the result of a stage cannot be written to the cache",
        text: "Results are kept in a binary form between builds. A result that has no such form \
               is a defect of egg, not of the project.",
    },
    CodeInfo {
        code: "E0805",
        name: "result-not-repeatable",
        title: "a stage gives another result every time it runs",
        text: "A stage was run several times on the same input and never gave the same bytes, so \
               nothing that depends on it can be trusted to stay. The build stops. This is a \
               defect of egg (or of the computer's memory), not of the project.",
    },
    CodeInfo {
        code: "E0806",
        name: "failed-silently",
        title: "a stage failed without saying why",
        text: "A part of egg has no result for its input and gave no reason. This is a defect of \
               egg, not of the project: every failure names what to change.",
    },
    CodeInfo {
        code: "E0807",
        name: "source-unreadable",
        title: "an input file cannot be read",
        text: "A file that the project names could be read when the build began and cannot be \
               read now. The build keeps what was finished; run it again when the file is back.",
    },
    CodeInfo {
        code: "E0808",
        name: "source-changed",
        title: "an input file changed while it was being compiled",
        text: "A file was saved between the moment when the build looked at it and the moment when \
               a stage read it. Using it would mix two states of the project, so the stage stops \
               and nothing of it is kept. Run the build again.",
    },
    CodeInfo {
        code: "E0810",
        name: "no-such-stage",
        title: "a stage or target that was asked for does not exist",
        text: "`--only` names what is built: a patch, or a part of one (`west`, `west.u`); \
               `--stage` names what is done (`cladding`). `egg graph` lists all of them.",
    },
    CodeInfo {
        code: "E0811",
        name: "output-path-invalid",
        title: "an output file would have a name that it cannot have",
        text: "Outputs have names that every system can store, inside the output directory. A name \
               of the project (of a patch, say) ended up in a file name and has a character, or is \
               a word, that some system refuses. Rename it; nothing of the stage was published.",
    },
    CodeInfo {
        code: "E0812",
        name: "outputs-collide",
        title: "two output files would have the same name",
        text: "Two outputs have the same name, or names that differ only in upper and lower case, \
               or one is a folder that the other is a file. On some systems the second would \
               replace the first. Rename what they are named after; neither was published.",
    },
    CodeInfo {
        code: "E0813",
        name: "foreign-file",
        title: "a file that egg did not write is in the way",
        text: "egg replaces and removes only files that it wrote itself; `.egg-manifest` in the \
               output directory lists them. Another file has the name of an output. It was left \
               alone, and the output (with the others of its stage) was not published.\n\n\
               Move the file away, choose another directory with `--out`, or let egg replace it \
               with `--overwrite`.",
    },
    CodeInfo {
        code: "E0814",
        name: "output-not-written",
        title: "an output file cannot be written",
        text: "The system refused to write a file in the output directory: no space, no \
               permission, or the directory is gone. The file that stood there before is whole. \
               Results are in the cache, so the next build only writes them.",
    },
    CodeInfo {
        code: "W0801",
        name: "cache-entry-damaged",
        title: "a file of the cache is damaged and is made again",
        text: "Every file of the cache carries a digest of its contents, which is checked whenever \
               it is read. This one did not match: a disk fault, a power cut, or an edit. It was \
               set aside in the cache's folder `quarantine` and its stage runs again, so the build \
               is right. If it happens again, check the disk; `egg cache verify` reads everything.",
    },
    CodeInfo {
        code: "W0802",
        name: "cache-not-writable",
        title: "results cannot be kept in the cache",
        text: "The cache's directory is full, read-only or not there. The build is complete and \
               right, but the next one computes its results again. `--cache-dir` or \
               `EGG_CACHE_DIR` name another place; `egg cache gc` makes room.",
    },
    CodeInfo {
        code: "W0803",
        name: "result-differs",
        title: "a stage gave another result for the same input",
        text: "A result that was lost, or that was asked for again, came out differently from what \
               the cache had recorded. The new result stands, and everything that depends on it \
               was looked up again. This is a defect of egg, not of the project.",
    },
    CodeInfo {
        code: "W0804",
        name: "edited-output-replaced",
        title: "an output file had been edited and was replaced",
        text: "A file in the output directory was not as egg had written it. Outputs always show \
               the project as it is, so it was written anew and the edit is gone. Edit the project, \
               or a copy of the output under another name.",
    },
    CodeInfo {
        code: "W0805",
        name: "edited-output-kept",
        title: "an edited file is no longer an output and stays",
        text: "The project does not make this file any more, and egg would have removed it; but it \
               was not as egg had written it. It stays and is yours from now on.",
    },
];
