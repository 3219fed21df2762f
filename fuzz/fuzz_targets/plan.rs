//! Any text as a plan: refused, or read into records that are written the same again.

#![no_main]

use egg::plan::{from_ron, to_json, to_ron};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(plan) = from_ron(text) else { return };
    let written = to_ron(&plan);
    let again = from_ron(&written).expect("egg reads its plans");
    assert_eq!(to_ron(&again), written);
    let _ = to_json(&plan);
});
