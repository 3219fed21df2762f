use super::*;
use proptest::prelude::*;

fn blank(id: usize, length: f64, width: f64) -> Blank {
    Blank {
        id: format!("w.u{id:02}"),
        material: "poplar".to_owned(),
        thickness: 0.003,
        length,
        width,
        whole: 0.03,
        grain: Grain::Along,
    }
}

fn settings() -> Settings {
    Settings {
        stock_length: 2.5,
        stock_width: 1.25,
        bed: None,
        margin: 0.01,
        spacing: 0.003,
        kerf: 0.0002,
    }
}

fn placed(blanks: &[Blank], settings: &Settings) -> Nest {
    nest(blanks, settings).expect("everything fits").value
}

#[test]
fn sixty_strips_of_one_width_need_no_more_than_the_bound() {
    // A spread of 180 to 580 mm on sheets of 600 x 300 mm.
    let blanks: Vec<Blank> = (0..60)
        .map(|i| blank(i, 0.18 + 0.4 * ((i * 37) % 60) as f64 / 59.0, 0.03))
        .collect();
    let settings = Settings {
        stock_length: 0.6,
        stock_width: 0.3,
        margin: 0.005,
        ..settings()
    };
    let nest = placed(&blanks, &settings);
    let group = &nest.groups[0];
    assert_eq!((group.rows, group.rows_bound), (43, 43));
    assert_eq!((group.sheets, group.sheets_bound), (6, 6));
}

#[test]
fn a_bed_that_is_half_a_panel_wide_gives_two_sheets_a_panel() {
    let settings = Settings {
        bed: Some(BedSize {
            length: 1.245,
            width: 0.71,
            pass_through: true,
        }),
        ..settings()
    };
    let blanks: Vec<Blank> = (0..36).map(|i| blank(i, 2.0, 0.03)).collect();
    let nest = placed(&blanks, &settings);
    let group = &nest.groups[0];
    assert_eq!((group.sheets, group.panels), (2, 1));
    assert!((nest.sheets[0].width - 0.623).abs() < 1e-12);
}

#[test]
fn a_bed_without_passage_limits_the_length_of_parts() {
    let settings = Settings {
        bed: Some(BedSize {
            length: 1.245,
            width: 0.71,
            pass_through: false,
        }),
        ..settings()
    };
    let errors = nest(&[blank(1, 2.0, 0.03), blank(2, 1.3, 0.03)], &settings)
        .expect_err("two metres on a bed of one");
    assert_eq!(errors.len(), 1);
    assert_eq!(errors[0].code.as_str(), "E0701");
    assert_eq!(
        errors[0].message,
        "lamella `w.u01` is too long: 2000.0 mm, where a sheet takes 1225.0 mm"
    );
    let says =
        |told: &Diagnostic, words: &str| told.help.as_ref().is_some_and(|h| h.contains(words));
    let place = |told: &Diagnostic| format!("{:?}", told.labels);
    assert!(says(&errors[0], "pass_through = true"), "{errors:?}");
    assert!(place(&errors[0]).contains("fabrication.bed"), "{errors:?}");
    // What no panel takes, no bed is to blame for.
    let errors = nest(&[blank(1, 3.0, 0.03)], &settings).expect_err("three metres");
    assert!(says(&errors[0], "longer stock"), "{errors:?}");
    assert!(
        place(&errors[0]).contains("fabrication.stock"),
        "{errors:?}"
    );
}

#[test]
fn short_strips_lie_in_the_rests_of_wider_rows() {
    let mut blanks: Vec<Blank> = (0..4).map(|i| blank(i, 1.9, 0.04)).collect();
    blanks.extend((4..8).map(|i| blank(i, 0.5, 0.03)));
    let nest = placed(&blanks, &settings());
    assert_eq!(nest.groups[0].rows, 4);
}

#[test]
fn materials_and_thicknesses_have_sheets_of_their_own() {
    let mut blanks: Vec<Blank> = (0..3).map(|i| blank(i, 1.0, 0.03)).collect();
    blanks[1].thickness = 0.004;
    blanks[2].material = "birch".to_owned();
    let nest = placed(&blanks, &settings());
    let sheets: Vec<_> = nest
        .sheets
        .iter()
        .map(|s| (s.id.as_str(), s.material.as_str(), s.thickness))
        .collect();
    assert_eq!(
        sheets,
        [
            ("sheet-01", "birch", 0.003),
            ("sheet-02", "poplar", 0.003),
            ("sheet-03", "poplar", 0.004)
        ]
    );
}

#[test]
fn grain_across_the_lamella_turns_the_panel() {
    let mut long = blank(1, 1.3, 0.03);
    long.grain = Grain::Across;
    let errors = nest(&[long.clone()], &settings()).expect_err("longer than the panel is wide");
    assert_eq!(errors[0].code.as_str(), "E0701");
    long.grain = Grain::None;
    assert_eq!(placed(&[long], &settings()).sheets[0].length, 2.5);
}

#[test]
fn useless_settings_are_refused() {
    let code = |settings: &Settings| {
        nest(&[blank(1, 1.0, 0.03)], settings).expect_err("refused")[0]
            .code
            .to_string()
    };
    let base = settings();
    assert_eq!(
        code(&Settings {
            margin: 0.7,
            ..base.clone()
        }),
        "E0703"
    );
    assert_eq!(
        code(&Settings {
            spacing: 1e-4,
            ..base.clone()
        }),
        "E0704"
    );
    assert_eq!(
        code(&Settings {
            stock_width: 0.04,
            ..base
        }),
        "E0702"
    );
}

proptest! {
    #[test]
    fn parts_lie_apart_inside_the_margins_whatever_their_order(
        sizes in prop::collection::vec((0.1f64..2.4, 0.02f64..0.06), 1..40),
        turn in 0usize..40,
    ) {
        let blanks: Vec<Blank> = sizes
            .iter()
            .enumerate()
            .map(|(i, &(length, width))| blank(i, length, (width * 50.0).round() / 50.0))
            .collect();
        let settings = settings();
        let nest = placed(&blanks, &settings);
        let mut turned = blanks.clone();
        turned.rotate_left(turn % blanks.len());
        prop_assert_eq!(&placed(&turned, &settings), &nest);

        let mut count = 0;
        for sheet in &nest.sheets {
            let boxes: Vec<[f64; 4]> = sheet
                .parts
                .iter()
                .map(|part| {
                    let blank = blanks.iter().find(|b| b.id == part.part).expect("a part");
                    [part.x, part.y, part.x + blank.length, part.y + blank.width]
                })
                .collect();
            count += boxes.len();
            for (i, a) in boxes.iter().enumerate() {
                prop_assert!(a[0] >= 0.01 - 1e-9 && a[2] <= sheet.length - 0.01 + 1e-9);
                prop_assert!(a[1] >= 0.01 - 1e-9 && a[3] <= sheet.width - 0.01 + 1e-9);
                for b in &boxes[i + 1..] {
                    let gap = (0..2)
                        .map(|k| (b[k] - a[k + 2]).max(a[k] - b[k + 2]))
                        .fold(f64::NEG_INFINITY, f64::max);
                    prop_assert!(gap >= settings.spacing - 1e-9);
                }
            }
        }
        prop_assert_eq!(count, blanks.len());
    }
}
