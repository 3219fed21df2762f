//! A cache and an output directory for one test.

use crate::project::Design;
use egg::build::{Built, CancelToken, Engine, Event, How, Plan, Request, Settings};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

pub(crate) struct Workshop {
    directory: tempfile::TempDir,
    pub(crate) settings: Settings,
}

impl Workshop {
    pub(crate) fn new() -> Self {
        let directory = tempfile::tempdir().expect("a temporary directory");
        let mut settings =
            Settings::new(directory.path().join("cache"), directory.path().join("out"));
        settings.jobs = 2;
        Self {
            directory,
            settings,
        }
    }

    pub(crate) fn path(&self) -> &Path {
        self.directory.path()
    }

    pub(crate) fn engine(&self) -> Engine {
        Engine::open(self.settings.clone())
    }

    pub(crate) fn build(&self, design: &Design) -> Built {
        self.request(design, &Request::default())
    }

    pub(crate) fn request(&self, design: &Design, request: &Request) -> Built {
        let declare = |g: &mut _| design.declare(g);
        self.engine().build(
            request,
            &declare,
            &CancelToken::default(),
            &mut |_: Event| {},
        )
    }

    pub(crate) fn plan(&self, design: &Design) -> Plan {
        self.engine()
            .plan(&Request::default(), &|g| design.declare(g))
    }

    /// The published files, without the manifest.
    pub(crate) fn outputs(&self) -> BTreeMap<String, Vec<u8>> {
        files(&self.settings.output)
    }

    /// All files of the cache.
    pub(crate) fn cache(&self) -> Vec<PathBuf> {
        files(&self.settings.cache)
            .into_keys()
            .map(|name| self.settings.cache.join(name))
            .collect()
    }
}

/// What a clean build of the design publishes.
pub(crate) fn clean(design: &Design) -> BTreeMap<String, Vec<u8>> {
    let workshop = Workshop::new();
    workshop.build(design);
    workshop.outputs()
}

/// Instances that ran, in the graph's order.
pub(crate) fn ran(built: &Built) -> Vec<String> {
    built
        .stages
        .iter()
        .filter(|stage| matches!(stage.how, How::Ran | How::Failed))
        .map(|stage| stage.instance.to_string())
        .collect()
}

pub(crate) fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![directory.to_owned()];
    while let Some(folder) = folders.pop() {
        let Ok(listing) = fs::read_dir(folder) else {
            continue;
        };
        for entry in listing.flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(directory).expect("below it");
                let name = name.to_string_lossy().into_owned();
                found.insert(name, fs::read(&path).unwrap_or_default());
            }
        }
    }
    found
}
