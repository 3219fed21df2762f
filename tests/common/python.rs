//! Independent readers: Python programs with public packages, in environments below the build
//! folder.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A Python interpreter in an environment that has the packages (requirement specifiers). Test
/// binaries that run at the same time wait for each other; a finished environment is reused.
pub(crate) fn venv(packages: &[&str]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python");
    fs::create_dir_all(&folder).expect("the build folder takes folders");
    let name: String = packages
        .join("+")
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
    let home = folder.join(&name);
    let interpreter = if cfg!(windows) {
        home.join("Scripts").join("python.exe")
    } else {
        home.join("bin").join("python")
    };
    let ready = home.join("ready");

    let lock = File::create(folder.join(format!("{name}.lock"))).expect("a lock file");
    lock.lock().expect("the file system has locks");
    if !ready.exists() {
        if home.exists() {
            fs::remove_dir_all(&home).expect("a broken environment goes");
        }
        let system = ["python3", "python"]
            .into_iter()
            .find(|python| {
                let version = Command::new(python).arg("--version").output();
                version.is_ok_and(|output| output.status.success())
            })
            .expect("the independent readers need Python 3 on the path");
        run(Command::new(system).arg("-m").arg("venv").arg(&home));
        run(Command::new(&interpreter)
            .args([
                "-m",
                "pip",
                "install",
                "--quiet",
                "--disable-pip-version-check",
            ])
            .args(packages));
        File::create(&ready).expect("a marker");
    }
    interpreter
}

/// Runs a script below `tests/readers` and gives what it prints; a failing script fails the test
/// with everything it said.
pub(crate) fn read(interpreter: &Path, script: &str, arguments: &[&Path]) -> String {
    let script = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/readers")
        .join(script);
    run(Command::new(interpreter).arg(script).args(arguments))
}

fn run(command: &mut Command) -> String {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(
        output.status.success(),
        "{command:?} failed:\n{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8_lossy(&output.stdout).into_owned()
}
