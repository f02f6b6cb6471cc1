use super::*;

#[test]
fn looks_part_a_substep_evenly_and_are_never_too_rare() {
    let every: Vec<u32> = [1, 4, 5, 6, 8, 10, 11].map(look_every).to_vec();
    assert_eq!(every, [1, 4, 5, 3, 4, 5, 4]);
    assert!((1..=1000).all(|count| (1..=LOOK_EVERY as u32).contains(&look_every(count))));
}
