use super::*;
use core::f64::consts::PI;
use proptest::prelude::*;

fn degrees(value: f64) -> f64 {
    value.to_radians()
}

#[test]
fn at_a_right_angle_the_cover_is_the_other_width_along_the_slide() {
    let contact = Contact {
        width: 0.03,
        other: 0.02,
        on: [0.5, 0.54],
        angles: [0.5 * PI; 2],
    };
    for [from, to] in cover(&contact) {
        assert!((from - 0.49).abs() < 1e-12 && (to - 0.55).abs() < 1e-12);
    }
}

#[test]
fn without_slide_and_turn_the_cover_is_the_parallelogram_of_the_two_strips() {
    // Strips of 30 and 20 mm at 30 degrees: 20 / sin 30 = 40 mm along, sheared by 30 cot 30.
    let contact = Contact {
        width: 0.03,
        other: 0.02,
        on: [0.5; 2],
        angles: [degrees(30.0); 2],
    };
    let shear = 0.015 * 3.0_f64.sqrt();
    let [right, left] = cover(&contact);
    for (edge, middle) in [(right, 0.5 - shear), (left, 0.5 + shear)] {
        assert!((edge[0] - (middle - 0.02)).abs() < 1e-12, "{edge:?}");
        assert!((edge[1] - (middle + 0.02)).abs() < 1e-12, "{edge:?}");
    }
    // Its area is the product of the widths over the sine.
    let area = 0.5 * (right[1] - right[0] + left[1] - left[0]) * 0.03;
    assert!((area - 0.03 * 0.02 / 0.5).abs() < 1e-12);
}

#[test]
fn the_other_direction_mirrors_the_cover() {
    let contact = Contact {
        width: 0.03,
        other: 0.02,
        on: [0.5, 0.52],
        angles: [degrees(35.0), degrees(80.0)],
    };
    let mirrored = Contact {
        angles: contact.angles.map(|angle| -angle),
        ..contact
    };
    let [right, left] = cover(&contact);
    assert_eq!(cover(&mirrored), [left, right]);
}

proptest! {
    #[test]
    fn the_contact_area_stays_below_the_cover_all_the_way(
        width in 0.005..0.1_f64,
        other in 0.005..0.1_f64,
        from in -0.1..0.1_f64,
        to in -0.1..0.1_f64,
        first in 15.0..165.0_f64,
        second in 15.0..165.0_f64,
        turned in any::<bool>(),
        along in 0.0..1.0_f64,
        place in 0.0..1.0_f64,
        across in -0.5..0.5_f64,
        beside in -0.5..0.5_f64,
    ) {
        let sign = if turned { -1.0 } else { 1.0 };
        let contact = Contact {
            width,
            other,
            on: [from, to],
            angles: [sign * degrees(first), sign * degrees(second)],
        };
        let [right, left] = cover(&contact);
        // Any point of the other strip at any place and angle on the way.
        let angle = contact.angles[0] + along * (contact.angles[1] - contact.angles[0]);
        let centre = from + place * (to - from);
        let (sin, cos) = libm::sincos(angle);
        let y = across * width;
        let x = centre + (y * cos + beside * other) / sin;
        let share = across + 0.5;
        let bound = |i: usize| right[i] + share * (left[i] - right[i]);
        prop_assert!(bound(0) - 1e-12 <= x && x <= bound(1) + 1e-12);
    }
}

fn sticker(outline: [[f64; 2]; 4], slot: [f64; 2], diameter: f64) -> StickerRecord {
    StickerRecord {
        id: String::new(),
        number: 1,
        crossing: String::new(),
        lamella: String::new(),
        face: Face::Top,
        outline,
        slot,
        diameter,
    }
}

#[test]
fn the_land_is_the_least_foil_around_the_slot() {
    let square = [[0.0, -0.01], [0.06, -0.01], [0.06, 0.01], [0.0, 0.01]];
    // 20 mm at the left, 15 mm at the right, 10 mm above and below, less a radius of 3 mm.
    let land_of = |slot, diameter| land(&sticker(square, slot, diameter));
    assert!((land_of([0.02, 0.045], 0.006) - 0.007).abs() < 1e-12);
    assert!((land_of([0.02, 0.055], 0.006) - 0.002).abs() < 1e-12);
    assert!((land_of([0.02, 0.059], 0.006) + 0.002).abs() < 1e-12);
}

#[test]
fn neighbours_are_cut_apart_and_cover_as_much_as_before() {
    let mut first = [[0.0, 0.05], [0.0, 0.03]];
    let mut second = [[0.04, 0.09], [0.06, 0.09]];
    part(&mut first, &mut second);
    assert!((first[0][1] - 0.04475).abs() < 1e-12 && (second[0][0] - 0.04525).abs() < 1e-12);
    // Where they do not meet they stay.
    assert_eq!((first[1], second[1]), ([0.0, 0.03], [0.06, 0.09]));
}
