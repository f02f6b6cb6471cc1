//! The elimination against a dense solution of the same equations.

use proptest::prelude::*;

use super::super::matrix::System;
use super::*;

/// Bodies that are solved for, and all.
const SOLVED: usize = 6;
const PLACES: usize = 8;

fn line() -> impl Strategy<Value = [Part; 2]> {
    prop::array::uniform2(prop::array::uniform6(-1.0..1.0))
}

/// With any rows, held in any way, between any two bodies; also between two that are not solved for.
fn any_contact() -> impl Strategy<Value = Contact> {
    let point = (prop::array::uniform3(line()), 0..3_usize).prop_map(|(lines, hold)| {
        let mut point = point(lines);
        point.hold = HOLDS[hold];
        point
    });
    let ends = (0..PLACES as u32, 1..PLACES as u32).prop_map(|(a, step)| [a, (a + step) % PLACES as u32]);
    (ends, prop::collection::vec(point, 1..=4), 1.0..100.0).prop_map(|(ends, points, stiffness)| {
        let mut contact = contact(ends, 0.5, points);
        contact.stiffness = stiffness;
        contact
    })
}

fn inverse_masses() -> Vec<f64> {
    (0..PLACES).map(|place| 1.0 / (1.0 + place as f64)).collect()
}

/// M + Jᵀ K J, written down row by row.
fn dense(contacts: &[Contact]) -> Vec<Vec<f64>> {
    let mut matrix = vec![vec![0.0; 6 * SOLVED]; 6 * SOLVED];
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] = if i % 6 < 3 { 1.0 / inverse_masses()[i / 6] } else { 1.0 };
    }
    for contact in contacts {
        for (lines, _) in contact.points.iter().flat_map(Point::held_rows) {
            let mut jacobian = vec![0.0; 6 * PLACES];
            for (end, part) in contact.ends.iter().zip(lines) {
                jacobian[6 * *end as usize..][..6].copy_from_slice(part);
            }
            for (i, row) in matrix.iter_mut().enumerate() {
                for (j, number) in row.iter_mut().enumerate() {
                    *number += contact.stiffness * jacobian[i] * jacobian[j];
                }
            }
        }
    }
    matrix
}

/// Gaussian elimination with partial pivoting.
fn solve_dense(mut matrix: Vec<Vec<f64>>, mut vector: Vec<f64>) -> Vec<f64> {
    let count = vector.len();
    for k in 0..count {
        let largest = (k..count).max_by(|&i, &j| matrix[i][k].abs().total_cmp(&matrix[j][k].abs()));
        matrix.swap(k, largest.unwrap());
        vector.swap(k, largest.unwrap());
        for i in k + 1..count {
            let factor = matrix[i][k] / matrix[k][k];
            let pivot = matrix[k].clone();
            matrix[i].iter_mut().zip(pivot).for_each(|(number, other)| *number -= factor * other);
            vector[i] -= factor * vector[k];
        }
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|j| matrix[k][j] * vector[j]).sum();
        vector[k] = (vector[k] - known) / matrix[k][k];
    }
    vector
}

fn hold_all(contacts: &[Contact], hold: Hold) -> Vec<Contact> {
    let mut contacts = contacts.to_vec();
    contacts.iter_mut().flat_map(|contact| &mut contact.points).for_each(|point| point.hold = hold);
    contacts
}

proptest! {
    /// Whatever touches what, and whichever rows are held, also after others were.
    #[test]
    fn elimination_agrees_with_a_dense_solution(
        contacts in prop::collection::vec(any_contact(), 1..16),
        right in prop::collection::vec(prop::array::uniform6(-1.0..1.0), SOLVED),
    ) {
        let mut system = System::new(inverse_masses(), SOLVED, &contacts);
        system.factor(&hold_all(&contacts, Hold::Sticks));
        system.factor(&contacts);
        let mut vector = right.clone();
        vector.resize(PLACES, [0.0; 6]);
        system.solve(&mut vector);
        let expected = solve_dense(dense(&contacts), right.concat());
        let largest = expected.iter().fold(0.0, |most: f64, number| most.max(number.abs()));
        for (number, expected) in vector.concat().iter().zip(&expected) {
            prop_assert!((number - expected).abs() <= 1e-9 * largest, "{number} and not {expected}");
        }
        prop_assert!(vector[SOLVED..].iter().all(|part| *part == [0.0; 6]), "only what is solved for moves");
    }
}
