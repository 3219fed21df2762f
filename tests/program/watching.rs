//! `egg watch` and Ctrl-C, in processes of their own.
#![cfg(unix)]

use crate::program::Workshop;
use crate::{JUNCTION, read, with_junction};
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// Longest wait for anything that has to happen: far more than it takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// A running `egg watch` that is ended with the test.
struct Watching {
    child: Child,
    lines: Receiver<String>,
}

impl Watching {
    fn start(shop: &Workshop) -> Self {
        let mut child = shop
            .command(&["watch", "junction.toml"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        let said = BufReader::new(child.stderr.take().expect("piped"));
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            for line in said.lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Self { child, lines }
    }

    /// Waits for a line with this in it.
    fn hears(&self, part: &str) -> String {
        let mut heard = Vec::new();
        loop {
            match self.lines.recv_timeout(PATIENCE) {
                Ok(line) if line.contains(part) => return line,
                Ok(line) => heard.push(line),
                Err(error) => panic!("never heard `{part}` ({error}): {heard:#?}"),
            }
        }
    }

    /// Presses Ctrl-C; gives the exit code.
    fn interrupt(&mut self) -> Option<i32> {
        let pid = self.child.id().to_string();
        let sent = Command::new("kill").args(["-INT", &pid]).status();
        assert!(sent.expect("kill runs").success());
        self.child.wait().expect("it ends").code()
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_watch_builds_at_every_save_and_ends_with_ctrl_c() {
    let shop = with_junction();
    let mut watching = Watching::start(&shop);
    watching.hears("Finished junction");
    watching.hears("Watching");
    let plan = || fs::read_to_string(shop.path("build/junction/plan.ron")).expect("a plan");
    assert!(plan().contains("id: \"south.u09\""));

    let more = read(JUNCTION).replace("u = 9, v = 6", "u = 9, v = 7");
    shop.write("junction.toml", &more);
    watching.hears("Finished junction");
    watching.hears("Watching");
    assert!(plan().contains("id: \"south.v07\""));

    // A mistake is told, and the next save mends it.
    shop.write("junction.toml", more.replace("\"limewood\"", "\"limwood\""));
    watching.hears("limwood");
    watching.hears("Watching");
    shop.write("junction.toml", &more);
    watching.hears("(");
    watching.hears("Watching");

    // The mesh counts as well.
    let mesh = fs::read_to_string(shop.path("vault.obj")).expect("a mesh");
    shop.write("vault.obj", format!("# another comment\n{mesh}"));
    watching.hears("Finished junction");
    watching.hears("Watching");
    assert_eq!(watching.interrupt(), Some(130));
}

#[test]
fn ctrl_c_keeps_what_is_finished_and_publishes_nothing() {
    let shop = with_junction();
    let mut child = shop
        .command(&["build", "junction.toml", "--message-format", "json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts");
    let mut said = BufReader::new(child.stdout.take().expect("piped"));
    let mut line = String::new();
    said.read_line(&mut line).expect("a record");
    assert!(line.contains("stage-finished"), "{line}");
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.expect("kill runs").success());
    let mut rest = String::new();
    while said.read_line(&mut rest).expect("records") > 0 {}
    // A build of a second may be over before the signal comes.
    match child.wait().expect("it ends").code() {
        Some(130) => assert!(!shop.path("build/junction/plan.ron").exists(), "{rest}"),
        code => assert_eq!(code, Some(0)),
    }
    let again = shop.egg(&["build", "junction.toml"]).expect(0);
    assert!(!again.err.contains(" 0 cached"), "{}", again.err);
    assert!(shop.path("build/junction/plan.ron").exists());
}
