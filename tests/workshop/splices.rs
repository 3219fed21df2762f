//! Lamellae that are longer than the stock.

use crate::common::job::Job;
use crate::common::{python, synthetic};
use crate::{golden, readers};
use egg::fabrication::drawing::{Layer, Shape};
use egg::fabrication::nesting::Settings;
use egg::fabrication::part::{Part, PartStyle};
use egg::fabrication::parts;
use egg::fabrication::pieces::{pieces, plates};
use egg::fabrication::splicing::{Rules, Spliced, Stock, splice};
use egg::fabrication::summary::Summary;
use egg::plan::{OpeningRecord, Plan};
use egg::project::model::SpliceKind;

const KINDS: [SpliceKind; 3] = [SpliceKind::Finger, SpliceKind::Scarf, SpliceKind::Plate];

fn rules(kind: SpliceKind, longest: f64) -> Rules {
    Rules {
        kind,
        bolt: 0.004,
        clearance: 0.0002,
        stock: vec![Stock {
            material: "poplar-plywood".to_owned(),
            longest,
            elastic_modulus: 7.6e9,
            bending_strength: 40e6,
        }],
    }
}

#[test]
fn readers_find_the_pieces_of_every_kind_of_joint() {
    let python = readers();
    for (kind, name) in KINDS.into_iter().zip(["finger", "scarf", "plate"]) {
        let job = Job::spliced(kind);
        let folder = job.write(&format!("spliced-{name}"));
        let counts = python::read(&python, "cut_files.py", &[&folder]);
        let parts: usize = counts.split(' ').next().unwrap().parse().unwrap();
        assert!(parts > job.plan.lamellae.len(), "{name}: {counts}");
        python::read(&python, "same_drawing.py", &[&folder]);
    }
}

#[test]
fn readers_find_fingers_that_grow_and_gaps_that_shrink_by_the_kerf() {
    let mut job = Job::spliced(SpliceKind::Finger);
    job.fabrication.kerf = 0.2e-3;
    job.prepare();
    let folder = job.write("spliced-kerf");
    python::read(&readers(), "cut_files.py", &[&folder]);
}

#[test]
fn pieces_fit_on_the_stock_and_hold_all_openings() {
    for kind in KINDS {
        let job = Job::spliced(kind);
        let longest = Settings::new(&job.fabrication).longest(job.materials[1].grain) * 1e3;
        let mut spliced = 0;
        for lamella in &job.plan.lamellae {
            let pieces = pieces(lamella);
            assert!(pieces.iter().all(|p| p.length() <= longest + 1e-6));
            let openings: usize = pieces.iter().map(|p| p.openings().count()).sum();
            assert_eq!(openings, lamella.openings.len(), "{}", lamella.id);
            assert_eq!(lamella.pieces.is_empty(), lamella.length * 1e3 <= longest);
            spliced += usize::from(!lamella.pieces.is_empty());
            let expected = match kind {
                SpliceKind::Plate => lamella.pieces.len().saturating_sub(1),
                _ => 0,
            };
            assert_eq!(plates(lamella).len(), expected);
            assert_eq!(
                pieces.iter().map(|p| p.screws().len()).sum::<usize>(),
                4 * expected
            );
        }
        assert!(spliced > 5, "{kind:?}");
    }
}

/// Distance of each joint from the nearest edge of an opening, metres.
fn clearances(plan: &Plan) -> Vec<f64> {
    let mut found = Vec::new();
    for lamella in &plan.lamellae {
        for piece in &lamella.pieces {
            let Some(joint) = &piece.joint else { continue };
            let [from, to] = [-0.5, 0.5].map(|side| piece.to + side * joint.length);
            let gap = |opening: &OpeningRecord| {
                let (a, b, d) = match *opening {
                    OpeningRecord::Hole { at, diameter, .. } => (at, at, diameter),
                    OpeningRecord::Notch {
                        from, to, diameter, ..
                    } => (from.min(to), from.max(to), diameter),
                };
                let at = |s: f64| s + lamella.end_margin;
                (at(a) - 0.5 * d - to).max(from - at(b) - 0.5 * d)
            };
            found.push(
                lamella
                    .openings
                    .iter()
                    .map(gap)
                    .fold(f64::INFINITY, f64::min),
            );
        }
    }
    found
}

#[test]
fn joints_keep_a_web_of_one_and_a_half_bolts_from_every_opening() {
    for kind in KINDS {
        let clear = clearances(&Job::spliced(kind).plan);
        assert!(!clear.is_empty());
        let least = clear.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least >= 1.5 * 0.004 - 1e-9, "{kind:?}: {least}");
    }
}

#[test]
fn joints_of_neighbours_are_staggered() {
    let plan = Job::spliced(SpliceKind::Finger).plan;
    let members: Vec<_> = plan.members.iter().map(|m| (m.id.as_str(), m)).collect();
    let mut joints: Vec<(&str, [f64; 3])> = Vec::new();
    for lamella in &plan.lamellae {
        let member = members.iter().find(|(id, _)| *id == lamella.member);
        let polyline = &member.expect("a member").1.polyline;
        for piece in lamella.pieces.iter().filter(|p| p.joint.is_some()) {
            // The polylines of the made-up plan have equal steps.
            let share = (piece.to / lamella.length * 24.0) as usize;
            joints.push((&lamella.id, polyline[share.min(24)]));
        }
    }
    // Lamellae are some 150 mm apart; side by side would be nearer than that.
    let near = joints
        .iter()
        .enumerate()
        .flat_map(|(i, a)| joints[i + 1..].iter().map(move |b| (a, b)))
        .filter(|(a, b)| a.0 != b.0 && libm::hypot(a.1[0] - b.1[0], a.1[1] - b.1[1]) < 0.1);
    let near: Vec<_> = near.collect();
    assert!(near.len() * 4 < joints.len(), "{near:?}");
}

#[test]
fn equal_plans_give_equal_splices_and_short_lamellae_none() {
    let plan = synthetic::pavilion();
    let splices = |longest| -> Vec<Spliced> {
        splice(&plan, &rules(SpliceKind::Finger, longest))
            .expect("there are places")
            .value
    };
    assert_eq!(splices(1.2), splices(1.2));
    assert_eq!(splices(9.0), []);
}

#[test]
fn a_lamella_that_cannot_be_divided_is_told_with_what_to_do() {
    let plan = synthetic::pavilion();
    let told = splice(&plan, &rules(SpliceKind::Plate, 0.12)).expect_err("no place");
    let [told] = &told[..] else {
        panic!("one cause is told once: {told:?}");
    };
    assert_eq!(told.code.as_str(), "E0720");
    let notes = told.notes.join("\n  note: ");
    let help = told.help.clone().unwrap_or_default();
    golden(
        "no-place-for-splice.txt",
        &format!("{}\n  note: {notes}\n  help: {help}", told.message),
    );
    // Wider lamellae leave less between them, until nothing is left.
    let note = |factor: f64| {
        let mut plan = plan.clone();
        for lamella in &mut plan.lamellae {
            lamella.width *= factor;
        }
        let told = splice(&plan, &rules(SpliceKind::Plate, 0.9)).expect_err("no place");
        told[0].notes[0].clone()
    };
    assert_eq!(
        note(2.0),
        "the widest stretch between its crossings is 43.9 mm long, a joint takes 75.6 mm"
    );
    assert_eq!(
        note(3.0),
        "its crossings leave no stretch free, a joint takes 75.6 mm"
    );
}

#[test]
fn joints_that_are_bent_too_far_or_stand_close_to_a_crossing_are_told() {
    let plan = synthetic::pavilion();
    let of = |plan: &Plan, rules: &Rules, code: &str| {
        let told = splice(plan, rules).expect("there are places").warnings;
        told.into_iter().find(|d| d.code.as_str() == code)
    };
    let usual = rules(SpliceKind::Finger, 1.28);
    assert_eq!(of(&plan, &usual, "W0732"), None);
    let mut weak = usual.clone();
    weak.stock[0].bending_strength = 1e6;
    let told = of(&plan, &weak, "W0732").expect("one MPa is nothing");
    let message = &told.message;
    assert!(
        message.contains("MPa, `poplar-plywood` bears 1 MPa"),
        "{message}"
    );
    assert_eq!(told.notes, ["50 % of the section carry in the joint"]);

    // Lamellae three times as wide between the same crossings, and ones that are narrow.
    let scaled = |factor: f64| {
        let mut plan = plan.clone();
        for lamella in &mut plan.lamellae {
            lamella.width *= factor;
        }
        plan
    };
    let told = of(&scaled(3.0), &usual, "W0730").expect("180 mm are not there");
    let message = &told.message;
    assert!(message.contains(" mm from an opening"), "{message}");
    assert_eq!(of(&scaled(0.5), &usual, "W0730"), None);
}

/// Area of what is left of a part when it is cut, square millimetres.
fn cut_area(part: &Part) -> f64 {
    let area = |shape: &Shape| match shape {
        Shape::Path(path) => path.area(),
        Shape::Circle { radius, .. } => std::f64::consts::PI * radius * radius,
        Shape::Text(_) => 0.0,
    };
    let of = |layer: Layer| -> f64 {
        let shapes = part.shapes.iter().filter(|entity| entity.layer == layer);
        shapes.map(|entity| area(&entity.shape)).sum()
    };
    of(Layer::CutOuter) - of(Layer::CutInner)
}

#[test]
fn the_summary_weighs_all_parts_that_are_cut_and_all_that_holds_them_as_the_bill_does() {
    let job = Job::spliced(SpliceKind::Plate);
    let style = PartStyle {
        kerf: 0.0,
        label_height: 0.004,
        sticker_margin: 0.0,
    };
    let parts = parts(&job.plan, style).value;
    assert!(parts.len() > job.plan.lamellae.len() + 10);
    // Poplar of 3 mm.
    let wood: f64 = parts.iter().map(|part| cut_area(part) * 1e-6).sum::<f64>() * 0.003 * 450.0;
    let summary = Summary::new(&job.plan);
    let summed = summary.lamella_mass + summary.plate_mass;
    assert!((summed / wood - 1.0).abs() < 1e-9, "{summed} {wood}");
    assert!(summary.plate_mass > 0.01 * summary.lamella_mass);

    let rows = job.plan.bill_of_materials.iter();
    let bought_whole = ["stock", "support", "consumable"];
    let bill: f64 = rows
        .filter(|row| !bought_whole.contains(&&*row.category))
        .filter(|row| row.id != "tube" && row.id != "foil")
        .map(|row| row.quantity * row.unit_mass.expect("all of this has a mass"))
        .sum();
    assert!((bill - summary.grid_mass()).abs() < 1e-9);
}

#[test]
fn joints_are_in_the_bill_and_in_the_cut_list() {
    let count = |job: &Job| -> usize {
        let joints =
            |l: &egg::plan::LamellaRecord| l.pieces.iter().filter(|p| p.joint.is_some()).count();
        job.plan.lamellae.iter().map(joints).sum()
    };
    let row = |job: &Job, id: &str| {
        let row = job.plan.bill_of_materials.iter().find(|row| row.id == id);
        row.cloned().unwrap_or_else(|| panic!("{id}"))
    };
    let finger = Job::spliced(SpliceKind::Finger);
    let glue = row(&finger, "glue-finger");
    assert!(glue.description.contains(&count(&finger).to_string()));
    // Three flanks of 1.5 x 0.3 cm a joint.
    let area = count(&finger) as f64 * 3.0 * 1.5 * 0.3;
    assert!((glue.quantity - area).abs() < 1e-9);

    let plate = Job::spliced(SpliceKind::Plate);
    let screws = 4 * count(&plate);
    assert_eq!(row(&plate, "plate-nut-m4").quantity, screws as f64);
    assert_eq!(row(&plate, "plate-washer-m4").quantity, 2.0 * screws as f64);
    // Two lamellae of 3 mm, two washers of 1, a nut of 5, two threads of 0.7.
    assert_eq!(row(&plate, "plate-bolt-m4x16").quantity, screws as f64);

    let files = plate.files();
    let list = files
        .iter()
        .find(|f| f.path == "cutlist.csv")
        .expect("made");
    let text = String::from_utf8(list.bytes.clone()).expect("UTF-8");
    let plates = text.lines().filter(|line| line.contains(",plate,"));
    assert_eq!(plates.count(), count(&plate));
}

#[test]
fn the_step_list_and_the_flat_layout_say_which_pieces_make_a_lamella() {
    for kind in KINDS {
        let job = Job::spliced(kind);
        let text = |path: &str| {
            let file = job.files().into_iter().find(|file| file.path == path);
            String::from_utf8(file.expect("made").bytes).expect("UTF-8")
        };
        let steps = text("assembly.md");
        let drawn = text("layout/west.svg");
        let spliced = job.plan.lamellae.iter().filter(|l| !l.pieces.is_empty());
        for lamella in spliced {
            let row = steps
                .lines()
                .find(|line| line.starts_with(&format!("| {} | `{}a`", lamella.id, lamella.id)));
            let row = row.unwrap_or_else(|| panic!("{kind:?}: no row for {}", lamella.id));
            assert!(
                lamella
                    .pieces
                    .iter()
                    .all(|p| row.contains(&format!("`{}`", p.id)))
            );
            let has_all_plates = plates(lamella)
                .iter()
                .all(|plate| row.contains(&format!("`{}`", plate.id)));
            assert!(has_all_plates, "{row}");
            if kind == SpliceKind::Plate {
                let screws = 4 * (lamella.pieces.len() - 1);
                assert!(row.contains(&format!("| {screws} x M4x16 |")), "{row}");
            }
        }
        assert!(drawn.contains("aria-label=\"a\"") && drawn.contains("aria-label=\"b\""));
        // Wood is glued before it is coated, plates are bolted on when it is.
        let at = |step: &str| steps.find(step);
        match kind {
            SpliceKind::Plate => assert!(at("Bolt the pieces together") > at("Sand and coat")),
            _ => assert!(at("Glue the pieces") < at("Sand and coat")),
        }
    }
    let whole = Job::pavilion().files();
    let steps = whole.iter().find(|file| file.path == "assembly.md");
    let steps = String::from_utf8_lossy(&steps.expect("made").bytes);
    assert!(!steps.contains("pieces"), "{steps}");
}
