//! Files that are not those of their plan, before `egg verify`.

use crate::common::job::Job;
use crate::golden;
use egg::fabrication::readback::{Folder, verify};
use egg::plan::to_ron;
use egg::project::model::SpliceKind;
use proptest::prelude::*;

fn folder(job: &Job) -> Folder {
    let mut folder: Folder = job
        .files()
        .into_iter()
        .map(|file| (file.path, file.bytes))
        .collect();
    folder.insert("plan.ron".to_owned(), to_ron(&job.plan).into_bytes());
    folder
}

/// What is told of a folder: codes and messages, the first few.
fn told(folder: &Folder) -> String {
    let told = verify(folder).expect_err("a difference");
    let lines: Vec<String> = told
        .iter()
        .take(3)
        .map(|d| format!("{}: {}", d.code, d.message))
        .collect();
    let more = told.len().saturating_sub(3);
    let rest = if more > 0 {
        format!("\nand {more} more")
    } else {
        String::new()
    };
    lines.join("\n") + &rest
}

fn path(folder: &Folder, end: &str) -> String {
    let found = folder.keys().find(|path| path.ends_with(end));
    found.unwrap_or_else(|| panic!("{end}")).clone()
}

/// Replaces the first occurrence of a text in a file.
fn edit(folder: &mut Folder, path: &str, from: &str, to: &str) {
    let text = String::from_utf8(folder[path].clone()).expect("UTF-8");
    assert!(text.contains(from), "{path} has no {from:?}");
    folder.insert(path.to_owned(), text.replacen(from, to, 1).into_bytes());
}

#[test]
fn what_a_build_writes_agrees_with_its_plan() {
    let mut kerf = Job::pavilion();
    kerf.fabrication.kerf = 0.15e-3;
    kerf.prepare();
    let jobs = [
        (Job::desktop(), 16, 126),
        (Job::pavilion(), 31, 238),
        (Job::pushed(1.245), 31, 238),
        (kerf, 31, 238),
    ];
    for (job, parts, openings) in jobs {
        let agreed = verify(&folder(&job)).unwrap_or_else(|told| panic!("{told:#?}"));
        assert_eq!((agreed.parts, agreed.openings), (parts, openings));
        assert!(agreed.pairs >= agreed.cut_files && agreed.rows > parts);
    }
    for kind in [SpliceKind::Finger, SpliceKind::Scarf, SpliceKind::Plate] {
        let agreed = verify(&folder(&Job::spliced(kind)));
        let agreed = agreed.unwrap_or_else(|told| panic!("{told:#?}"));
        assert!(agreed.parts > 31);
    }
}

#[test]
fn a_folder_without_a_plan_is_none_of_a_build() {
    let mut files = folder(&Job::desktop());
    files.remove("plan.ron");
    golden("verify-no-plan.txt", &told(&files));
    files.insert("plan.ron".to_owned(), b"(\n  format: 99,\n)".to_vec());
    golden("verify-plan-of-another-format.txt", &told(&files));
    files.insert("plan.ron".to_owned(), b"(format: 1,\n name: ".to_vec());
    golden("verify-plan-cut-short.txt", &told(&files));
}

#[test]
fn missing_and_foreign_files_are_named() {
    let mut files = folder(&Job::pavilion());
    let sheet = path(&files, "sheet-01-of-01.dxf");
    let bytes = files.remove(&sheet).expect("a sheet");
    files.insert(sheet.replace("-of-01", "-of-02"), bytes);
    files.remove("parts/west.u03.dxf");
    files.remove("crossings.csv");
    golden("verify-files-missing.txt", &told(&files));
}

#[test]
fn files_that_are_cut_short_or_converted_are_named() {
    let mut files = folder(&Job::desktop());
    let sheet = path(&files, "sheet-01-of-01.dxf");
    let half = files[&sheet].len() / 2;
    files.get_mut(&sheet).expect("a sheet").truncate(half);
    edit(&mut files, "layout/west.svg", "mm\"", "px\"");
    let part = "parts/west.u01.dxf";
    edit(&mut files, part, "CIRCLE", "SPLINE");
    golden("verify-files-unreadable.txt", &told(&files));
}

#[test]
fn an_opening_that_was_moved_is_found_in_both_drawings() {
    let mut files = folder(&Job::desktop());
    let sheet = path(&files, "sheet-01-of-01.svg");
    let text = String::from_utf8(files[&sheet].clone()).expect("UTF-8");
    let at = text.find("<circle cx=\"").expect("a hole") + "<circle cx=\"".len();
    let end = at + text[at..].find('"').expect("a number");
    let moved: f64 = text[at..end].parse::<f64>().expect("a number") + 0.4;
    let text = format!("{}{moved}{}", &text[..at], &text[end..]);
    files.insert(sheet, text.into_bytes());
    golden("verify-opening-moved.txt", &told(&files));
}

#[test]
fn a_scaled_cut_file_is_found() {
    let mut job = Job::desktop();
    let plan = job.plan.clone();
    for lamella in &mut job.plan.lamellae {
        lamella.width *= 1.01;
    }
    let mut files = folder(&job);
    files.insert("plan.ron".to_owned(), to_ron(&plan).into_bytes());
    let told = verify(&files).expect_err("a difference");
    assert!(told.iter().any(|d| d.code.as_str() == "E0734"));
    assert!(told.iter().any(|d| d.code.as_str() == "E0736"));
    let of_part = told
        .iter()
        .find(|d| d.code.as_str() == "E0734")
        .expect("one");
    assert_eq!(of_part.subject.as_deref(), Some("west.u01"));
}

#[test]
fn swapped_labels_are_found() {
    let mut files = folder(&Job::desktop());
    let sheet = path(&files, "sheet-01-of-01.svg");
    let text = String::from_utf8(files[&sheet].clone()).expect("UTF-8");
    let text = text
        .replace("inkscape:label=\"west.u01\"", "inkscape:label=\"west.u99\"")
        .replace("inkscape:label=\"west.u07\"", "inkscape:label=\"west.u01\"");
    files.insert(sheet, text.into_bytes());
    let told = verify(&files).expect_err("a difference");
    let messages: Vec<&str> = told.iter().map(|d| d.message.as_str()).collect();
    assert!(
        messages
            .iter()
            .any(|m| m.contains("part `west.u01` is drawn as `west.u99`")),
        "{messages:?}"
    );
}

#[test]
fn tables_that_a_spreadsheet_changed_are_found() {
    let mut files = folder(&Job::pavilion());
    edit(
        &mut files,
        "cutlist.csv",
        "east.u01,east,u,1",
        "east.u77,east,u,1",
    );
    edit(&mut files, "bom.csv", ",pcs,", ",m,");
    edit(
        &mut files,
        "crossings.csv",
        "west.u02-v02,west.u02,",
        "west.u02-v02,west.u03,",
    );
    golden("verify-tables-changed.txt", &told(&files));
}

#[test]
fn a_printed_support_that_was_scaled_opened_or_lost_is_found() {
    let mut files = folder(&Job::pavilion());
    let agreed = verify(&files).unwrap_or_else(|told| panic!("{told:#?}"));
    assert!(agreed.solids >= 4, "{}", agreed.solids);
    let stl: Vec<String> = files
        .keys()
        .filter(|path| path.rsplit('.').next() == Some("stl"))
        .cloned()
        .collect();
    // Scaled by inches that were taken for millimetres; a triangle less; gone.
    let scaled = files.get_mut(&stl[0]).expect("a support");
    for at in (84..scaled.len()).step_by(50) {
        for number in (at + 12..at + 48).step_by(4) {
            let bytes: [u8; 4] = scaled[number..number + 4].try_into().expect("four");
            let value = f32::from_le_bytes(bytes) * 25.4;
            scaled[number..number + 4].copy_from_slice(&value.to_le_bytes());
        }
    }
    let opened = files.get_mut(&stl[1]).expect("a support");
    let left = opened.len() / 50 - 2;
    opened.truncate(84 + 50 * left);
    opened[80..84].copy_from_slice(&(left as u32).to_le_bytes());
    files.remove(&stl[2]);
    golden("verify-supports-damaged.txt", &told(&files));
    files.insert("supports/supports.3mf".to_owned(), b"PK".to_vec());
    let told = verify(&files).expect_err("a difference");
    assert!(told.iter().any(|d| d.code.as_str() == "E0732"));
}

#[test]
fn no_bytes_make_verify_panic() {
    // Every file in turn becomes nonsense of several kinds.
    let whole = folder(&Job::desktop());
    let nonsense: [&[u8]; 5] = [
        b"",
        b"\xff\xfe\x00",
        b"0\r\nSECTION\r\n2\r\nENTITIES\r\n0\r\nCIRCLE\r\n10\r\nnan\r\n0\r\nENDSEC\r\n0\r\nEOF\r\n",
        b"<svg width=\"1mm\" height=\"1mm\" viewBox=\"0 0 1 1\"><g id=\"X\"><path d=\"Z A 1\"/></g></svg>",
        b"id,part_number\n\"",
    ];
    for path in whole.keys() {
        for bytes in nonsense {
            let mut files = whole.clone();
            files.insert(path.clone(), bytes.to_vec());
            // Pictures and texts for people are not read back.
            let for_people = [
                "coupon",
                "cladding",
                "layout",
                "stickers/",
                "assembly",
                "summary",
            ];
            let drawing = path.ends_with("dxf") || path.ends_with("svg");
            let not_read = path.contains("overview")
                || (path.starts_with("supports/") && drawing)
                || path.contains(".xlsx")
                || for_people.iter().any(|start| path.starts_with(start));
            assert!(verify(&files).is_err() || not_read, "{path}");
        }
    }
}

/// A plan with one drawing beside it, so that reading takes no time.
fn with_one(end: &str) -> (Folder, String) {
    let whole = folder(&Job::desktop());
    let name = path(&whole, end);
    let wanted = |path: &String| *path == name || path == "plan.ron";
    let few = whole.into_iter().filter(|(path, _)| wanted(path));
    (few.collect(), name)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn damaged_drawings_never_make_verify_panic(
        is_svg in any::<bool>(),
        edits in prop::collection::vec((0.0f64..1.0, 0usize..12, "[-0-9.eAMLZ \\r\\n\"<>]{0,6}"), 1..6),
    ) {
        let end = if is_svg { "coupon/limewood-1mm.svg" } else { "parts/west.u03.dxf" };
        let (mut files, name) = with_one(end);
        let mut text = String::from_utf8(files[&name].clone()).expect("UTF-8");
        for (place, removed, inserted) in edits {
            let mut at = (place * text.len() as f64) as usize;
            let mut to = (at + removed).min(text.len());
            while !text.is_char_boundary(at) { at -= 1; }
            while !text.is_char_boundary(to) { to += 1; }
            text.replace_range(at..to, &inserted);
        }
        files.insert(name, text.into_bytes());
        // Everything else is missing, which is told.
        prop_assert!(verify(&files).is_err());
    }
}
