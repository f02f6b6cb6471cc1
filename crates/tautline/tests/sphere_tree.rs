//! Sphere trees against brute force: containment, tightness, lazy updates, and the overlaps that descents find.

use glam::{Quat, Vec3};
use proptest::prelude::*;
use tautline::Error;
use tautline::geometry::Sphere;
use tautline::geometry::sphere_tree::{
    DescentStack, Feature, LayeredTree, SphereHierarchy, WrappedSpheres, WrappedTree, descend_pair,
    descend_self,
};

/// Features of every kind over random particles, with repeated particles and repeated features.
fn features() -> impl Strategy<Value = (Vec<Feature>, Vec<Vec3>)> {
    (4_u32..40).prop_flat_map(|count| {
        let feature = prop_oneof![
            (0..count).prop_map(Feature::Point),
            prop::array::uniform2(0..count).prop_map(Feature::Segment),
            prop::array::uniform3(0..count).prop_map(Feature::Triangle),
            prop::array::uniform4(0..count).prop_map(Feature::Quad),
        ];
        (prop::collection::vec(feature, 1..60), positions(count as usize))
    })
}

fn positions(count: usize) -> impl Strategy<Value = Vec<Vec3>> {
    let coordinate = prop_oneof![-4.0_f32..4.0, (-4_i8..5).prop_map(f32::from)];
    prop::collection::vec(prop::array::uniform3(coordinate).prop_map(Vec3::from), count)
}

fn motion() -> impl Strategy<Value = (Quat, Vec3)> {
    let turn = prop::array::uniform4(-1.0_f32..1.0)
        .prop_filter("a turn", |q| q.iter().map(|x| x * x).sum::<f32>() > 0.1)
        .prop_map(|q| Quat::from_array(q).normalize());
    (turn, prop::array::uniform3(-20.0_f32..20.0).prop_map(Vec3::from))
}

/// A sheet of n × n particles 5 cm apart, and its quads.
fn sheet(n: u32) -> (Vec<Feature>, Vec<Vec3>) {
    let positions = (0..n * n).map(|i| Vec3::new((i % n) as f32, 0.0, (i / n) as f32) * 0.05).collect();
    let cells = n - 1;
    let quad = |i: u32| {
        let corner = i % cells + n * (i / cells);
        Feature::Quad([corner, corner + 1, corner + n + 1, corner + n])
    };
    ((0..cells * cells).map(quad).collect(), positions)
}

fn contains(sphere: Sphere, point: Vec3) -> bool {
    sphere.center.as_dvec3().distance(point.as_dvec3()) <= f64::from(sphere.radius)
}

/// The leaves below a node, by walking down.
fn leaves_below(node: usize, leaf_count: usize) -> Vec<usize> {
    match node.checked_sub(leaf_count - 1) {
        Some(leaf) => vec![leaf],
        None => [leaves_below(2 * node + 1, leaf_count), leaves_below(2 * node + 2, leaf_count)].concat(),
    }
}

fn assert_contains_geometry(
    mut hierarchy: impl SphereHierarchy,
    features: &[Feature],
    positions: &[Vec3],
) -> Result<(), TestCaseError> {
    let leaf_count = hierarchy.leaf_count();
    prop_assert_eq!(leaf_count, features.len());
    for node in 0..2 * leaf_count - 1 {
        let sphere = hierarchy.sphere(node);
        for leaf in leaves_below(node, leaf_count) {
            for &particle in features[leaf].particles() {
                prop_assert!(
                    contains(sphere, positions[particle as usize]),
                    "node {node}, particle {particle}"
                );
            }
        }
    }
    Ok(())
}

fn sorted(mut pairs: Vec<(usize, usize)>) -> Vec<(usize, usize)> {
    pairs.sort_unstable();
    pairs
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn leaves_hold_the_features_each_once((features, positions) in features()) {
        let tree = LayeredTree::new(&features, &positions, 0.0).unwrap();
        let topology = tree.topology();
        let mut seen = vec![false; features.len()];
        for (leaf, &index) in topology.feature_indices().iter().enumerate() {
            prop_assert_eq!(topology.features()[leaf], features[index as usize]);
            prop_assert!(!std::mem::replace(&mut seen[index as usize], true));
        }
        prop_assert_eq!(seen.len(), topology.leaf_count());
        prop_assert!(topology.validate(positions.len()).is_ok());
    }

    #[test]
    fn layered_spheres_contain_their_geometry_after_a_refit(
        ((features, positions), shift) in features().prop_flat_map(|(f, p)| { let n = p.len(); (Just((f, p)), positions(n)) }),
        thickness in 0.0_f32..0.5,
    ) {
        let mut tree = LayeredTree::new(&features, &positions, thickness).unwrap();
        assert_contains_geometry(&tree, tree.topology().features(), &positions)?;
        tree.refit(&shift).unwrap();
        assert_contains_geometry(&tree, tree.topology().features(), &shift)?;
        prop_assert!(tree.leaf_spheres().iter().all(|sphere| sphere.radius >= thickness));
        let rebuilt = LayeredTree::new(&features, &shift, thickness).unwrap();
        let radius_by_feature = |tree: &LayeredTree| {
            let mut pairs: Vec<_> =
                tree.topology().feature_indices().iter().copied().zip(tree.leaf_spheres().iter().copied()).collect();
            pairs.sort_unstable_by_key(|pair| pair.0);
            pairs
        };
        prop_assert_eq!(radius_by_feature(&tree), radius_by_feature(&rebuilt));
    }

    #[test]
    fn inner_spheres_contain_their_children((features, positions) in features()) {
        let tree = LayeredTree::new(&features, &positions, 0.1).unwrap();
        for (node, sphere) in tree.spheres().iter().enumerate() {
            for child in tree.topology().children(node).into_iter().flatten() {
                let part = tree.spheres()[child];
                let distance = sphere.center.as_dvec3().distance(part.center.as_dvec3());
                prop_assert!(distance + f64::from(part.radius) <= f64::from(sphere.radius));
            }
        }
    }

    #[test]
    fn wrapped_spheres_are_no_larger_than_layered((features, positions) in features()) {
        let layered = LayeredTree::new(&features, &positions, 0.0).unwrap();
        let wrapped = WrappedTree::new(&features, &positions, 0.0).unwrap();
        prop_assert_eq!(layered.topology(), wrapped.topology());
        for (node, sphere) in layered.spheres().iter().enumerate() {
            // Both are widened by their own rounding, which alone is left where a feature is one point.
            prop_assert!(wrapped.sphere(node, &positions).radius <= sphere.radius + 2e-5);
        }
    }

    #[test]
    fn lazy_update_after_a_rigid_motion_equals_a_rebuild((features, positions) in features(), (turn, shift) in motion()) {
        let tree = WrappedTree::new(&features, &positions, 0.0).unwrap();
        let moved: Vec<Vec3> = positions.iter().map(|&p| turn * p + shift).collect();
        let mut state = WrappedSpheres::default();
        let rest: Vec<Sphere> = {
            let mut pose = tree.pose(&positions, &mut state).unwrap();
            (0..tree.topology().node_count()).map(|node| pose.sphere(node)).collect()
        };
        state.invalidate();
        prop_assert_eq!(state.computed_count(), 0);
        let mut pose = tree.pose(&moved, &mut state).unwrap();
        for (node, rest_sphere) in rest.iter().enumerate() {
            let sphere = pose.sphere(node);
            let below: Vec<Feature> =
                leaves_below(node, features.len()).iter().map(|&leaf| tree.topology().features()[leaf]).collect();
            // The root of a tree built over the moved geometry is that geometry's smallest sphere.
            let rebuilt = WrappedTree::new(&below, &moved, 0.0).unwrap().sphere(0, &moved);
            prop_assert!((sphere.radius - rebuilt.radius).abs() < 1e-4, "{sphere:?} is not {rebuilt:?}");
            prop_assert!((sphere.radius - rest_sphere.radius).abs() < 1e-4);
            prop_assert!(sphere.center.distance(turn * rest_sphere.center + shift) < 1e-4);
        }
        prop_assert_eq!(state.computed_count(), rest.len());
    }

    #[test]
    fn padding_covers_affine_stretch(
        (features, positions) in features(),
        stretch in prop::array::uniform3(0.97_f32..1.03),
        (turn, shift) in motion(),
    ) {
        // 0.03 plus what rounding the stretched positions themselves may add.
        let tree = WrappedTree::new(&features, &positions, 0.0301).unwrap();
        let stretched: Vec<Vec3> =
            positions.iter().map(|&p| turn * (turn.inverse() * p * Vec3::from(stretch)) + shift).collect();
        let mut state = WrappedSpheres::default();
        let pose = tree.pose(&stretched, &mut state).unwrap();
        assert_contains_geometry(pose, tree.topology().features(), &stretched)?;
    }

    #[test]
    fn measured_padding_is_enough(
        (features, positions) in features(),
        kick in prop::array::uniform3(-0.3_f32..0.3),
    ) {
        let tree = WrappedTree::new(&features, &positions, 0.0).unwrap();
        let mut bent = positions.clone();
        bent[0] += Vec3::from(kick);
        let needed = tree.padding_needed(&bent).unwrap();
        prop_assume!(needed.is_finite());
        let padded = WrappedTree::new(&features, &positions, needed * 1.0001 + 1e-6).unwrap();
        let mut state = WrappedSpheres::default();
        assert_contains_geometry(padded.pose(&bent, &mut state).unwrap(), padded.topology().features(), &bent)?;
    }

    #[test]
    fn descent_of_two_layered_trees_finds_all_overlaps_once(
        (features_a, positions_a) in features(),
        (features_b, positions_b) in features(),
        gap in 0.0_f32..10.0,
    ) {
        let moved: Vec<Vec3> = positions_b.iter().map(|&p| p + Vec3::new(gap, 0.3, 0.0)).collect();
        let a = LayeredTree::new(&features_a, &positions_a, 0.0).unwrap();
        let b = LayeredTree::new(&features_b, &moved, 0.0).unwrap();
        let mut expected = Vec::new();
        for (i, p) in a.leaf_spheres().iter().enumerate() {
            let overlapping = b.leaf_spheres().iter().enumerate().filter(|(_, q)| p.overlaps(q));
            expected.extend(overlapping.map(|(j, _)| (i, j)));
        }
        let mut stack = DescentStack::default();
        let (mut found, mut swapped) = (Vec::new(), Vec::new());
        descend_pair(&a, &b, &mut stack, |i, j| found.push((i, j)));
        descend_pair(&b, &a, &mut stack, |j, i| swapped.push((i, j)));
        prop_assert_eq!(sorted(found), &expected[..]);
        prop_assert_eq!(sorted(swapped), &expected[..]);
    }

    #[test]
    fn descent_into_a_wrapped_tree_finds_all_geometry_in_reach_once(
        (features_a, positions_a) in features(),
        (features_b, positions_b) in features(),
        gap in 0.0_f32..6.0,
    ) {
        let a = LayeredTree::new(&features_a, &positions_a, 0.0).unwrap();
        let b = WrappedTree::new(&features_b, &positions_b, 0.0).unwrap();
        let moved: Vec<Vec3> = positions_b.iter().map(|&p| p + Vec3::new(gap, 0.3, 0.0)).collect();
        let (mut state, mut stack) = (WrappedSpheres::default(), DescentStack::default());
        let (mut found, mut swapped) = (Vec::new(), Vec::new());
        descend_pair(&a, b.pose(&moved, &mut state).unwrap(), &mut stack, |i, j| found.push((i, j)));
        descend_pair(b.pose(&moved, &mut state).unwrap(), &a, &mut stack, |j, i| swapped.push((i, j)));
        let found = sorted(found);
        prop_assert_eq!(&found, &sorted(swapped));
        prop_assert!(found.windows(2).all(|two| two[0] != two[1]));
        let leaf_sphere = |leaf: usize| b.sphere(features_b.len() - 1 + leaf, &moved);
        for (i, sphere) in a.leaf_spheres().iter().enumerate() {
            for (j, feature) in b.topology().features().iter().enumerate() {
                // A wrapped sphere contains the geometry below it, not its children's spheres: so leaves that overlap
                // may be culled above, but not if a corner or the middle of the feature is within reach.
                let corners: Vec<Vec3> = feature.particles().iter().map(|&p| moved[p as usize]).collect();
                let middle = corners.iter().copied().sum::<Vec3>() / corners.len() as f32;
                let reached = corners.iter().chain([&middle]).any(|&p| sphere.contains_point(p, -1e-5));
                let listed = found.binary_search(&(i, j)).is_ok();
                prop_assert!(listed || !reached, "{i} and {j}");
                prop_assert!(!listed || sphere.overlaps(&leaf_sphere(j)));
            }
        }
    }

    #[test]
    fn descent_of_a_tree_with_itself_finds_all_overlaps_once((features, positions) in features(), scale in 0.2_f32..1.0) {
        let shrunk: Vec<Vec3> = positions.iter().map(|&p| (p / 4.0).round() * scale + p).collect();
        let mut tree = LayeredTree::new(&features, &positions, 0.0).unwrap();
        tree.refit(&shrunk).unwrap();
        let excluded = |i: usize, j: usize| (i + j).is_multiple_of(5);
        let spheres = tree.leaf_spheres();
        let mut expected = Vec::new();
        for i in 0..spheres.len() {
            let others = i + 1..spheres.len();
            expected.extend(others.filter(|&j| spheres[i].overlaps(&spheres[j]) && !excluded(i, j)).map(|j| (i, j)));
        }
        let mut found = Vec::new();
        let mut stack = DescentStack::default();
        descend_self(&tree, &mut stack, excluded, |i, j| found.push((i.min(j), i.max(j))));
        prop_assert_eq!(sorted(found), expected);
    }
}

/// Uses a tree in every way there is; what passed validation must survive that.
fn exercise(
    layered: &mut LayeredTree,
    wrapped: &WrappedTree,
    state: &mut WrappedSpheres,
    positions: &[Vec3],
) {
    let mut stack = DescentStack::default();
    descend_self(&*layered, &mut stack, |_, _| false, |_, _| ());
    layered.refit(positions).unwrap();
    wrapped.padding_needed(positions).unwrap();
    descend_pair(&*layered, wrapped.pose(positions, state).unwrap(), &mut stack, |_, _| ());
    descend_self(&*layered, &mut stack, |_, _| false, |_, _| ());
    descend_self(wrapped.pose(positions, state).unwrap(), &mut stack, |_, _| false, |_, _| ());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_bytes_are_refused_or_harmless(
        (features, positions) in features(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
    ) {
        let layered = LayeredTree::new(&features, &positions, 0.1).unwrap();
        let wrapped = WrappedTree::new(&features, &positions, 0.1).unwrap();
        let mut state = WrappedSpheres::default();
        exercise(&mut layered.clone(), &wrapped, &mut state, &positions);
        let intact = (layered, wrapped, state);
        let mut bytes = postcard::to_stdvec(&intact).unwrap();
        for (place, byte) in &damage {
            let place = place.index(bytes.len());
            bytes[place] = *byte;
        }
        let read = postcard::from_bytes::<(LayeredTree, WrappedTree, WrappedSpheres)>(&bytes);
        if damage.is_empty() {
            prop_assert_eq!(read.as_ref(), Ok(&intact));
            prop_assert!(intact.0.validate(positions.len()).is_ok() && intact.1.validate(positions.len()).is_ok());
            prop_assert!(intact.0.validate(intact.0.topology().particle_count() - 1).is_err());
        }
        if let Ok((mut layered, wrapped, mut state)) = read
            && layered.validate(positions.len()).is_ok()
            && wrapped.validate(positions.len()).is_ok()
        {
            exercise(&mut layered, &wrapped, &mut state, &positions);
        }
    }
}

#[test]
fn self_descent_of_a_flat_sheet_visits_neighbours_only() {
    let (features, positions) = sheet(40);
    let tree = LayeredTree::new(&features, &positions, 0.0).unwrap();
    let cell = |leaf: usize| {
        let index = tree.topology().feature_indices()[leaf];
        (index % 39, index / 39)
    };
    let chebyshev = |i: usize, j: usize| {
        let (p, q) = (cell(i), cell(j));
        p.0.abs_diff(q.0).max(p.1.abs_diff(q.1))
    };
    let mut neighbours = 0;
    let mut stack = DescentStack::default();
    let no_exclusion = |_, _| false;
    descend_self(&tree, &mut stack, no_exclusion, |i, j| neighbours += usize::from(chebyshev(i, j) == 1));
    assert_eq!(neighbours, 4 * 39 * 39 - 6 * 39 + 2, "each of the adjacent pairs, once");
    descend_self(&tree, &mut stack, |i, j| chebyshev(i, j) <= 1, |i, j| panic!("{i} and {j} are apart"));
}

#[test]
fn a_descent_computes_only_what_it_visits() {
    let (features, positions) = sheet(20);
    let tree = WrappedTree::new(&features, &positions, 0.0).unwrap();
    let probe = LayeredTree::new(&[Feature::Point(0)], &positions, 0.01).unwrap();
    let (mut state, mut stack) = (WrappedSpheres::default(), DescentStack::default());
    let mut hits = 0;
    descend_pair(tree.pose(&positions, &mut state).unwrap(), &probe, &mut stack, |_, _| hits += 1);
    assert_eq!(hits, 1);
    assert!((2 * 8..60).contains(&state.computed_count()), "{} of 721", state.computed_count());
}

#[test]
fn coincident_features_make_a_balanced_tree() {
    let tree = LayeredTree::new(&[Feature::Point(0); 100], &[Vec3::ONE], 0.5).unwrap();
    assert_eq!(tree.topology().node_count(), 199);
    assert!(tree.spheres().iter().all(|sphere| (sphere.radius - 0.5).abs() < 1e-4));
    let mut pairs = 0;
    descend_self(&tree, &mut DescentStack::default(), |_, _| false, |_, _| pairs += 1);
    assert_eq!(pairs, 100 * 99 / 2);
}

/// Spheres that make no sense but overlap: of negative radius, all in one place.
struct Negative;

impl SphereHierarchy for Negative {
    fn leaf_count(&self) -> usize {
        9
    }

    fn sphere(&mut self, _: usize) -> Sphere {
        Sphere { center: Vec3::ZERO, radius: -1.0 }
    }
}

#[test]
fn a_descent_ends_on_any_spheres() {
    let mut stack = DescentStack::default();
    let mut pairs = 0;
    descend_pair(Negative, Negative, &mut stack, |_, _| pairs += 1);
    assert_eq!(pairs, 81);
}

#[test]
fn a_particle_that_is_not_finite_collides_with_nothing() {
    let (features, mut positions) = sheet(5);
    let mut tree = LayeredTree::new(&features, &positions, 0.0).unwrap();
    positions.fill(Vec3::NAN);
    tree.refit(&positions).unwrap();
    descend_self(&tree, &mut DescentStack::default(), |_, _| false, |_, _| panic!("NaN overlaps"));
}

#[test]
fn bad_input_is_refused() {
    let points = [Vec3::ZERO, Vec3::X];
    let feature = [Feature::Segment([0, 1])];
    let refused = |result: Result<LayeredTree, Error>| matches!(result, Err(Error::Invalid { .. }));
    assert!(refused(LayeredTree::new(&[], &points, 0.0)));
    assert!(refused(LayeredTree::new(&[Feature::Segment([0, 2])], &points, 0.0)));
    assert!(refused(LayeredTree::new(&[Feature::Point(u32::MAX)], &points, 0.0)));
    assert!(refused(LayeredTree::new(&feature, &[Vec3::ZERO, Vec3::NAN], 0.0)));
    for number in [-1.0, f32::NAN, f32::INFINITY] {
        assert!(matches!(LayeredTree::new(&feature, &points, number), Err(Error::OutOfRange { .. })));
        assert!(matches!(WrappedTree::new(&feature, &points, number), Err(Error::OutOfRange { .. })));
    }
    let mut layered = LayeredTree::new(&feature, &points, 0.0).unwrap();
    let before = layered.clone();
    assert!(layered.refit(&points[..1]).is_err());
    assert_eq!(layered, before);
    let wrapped = WrappedTree::new(&feature, &points, 0.0).unwrap();
    assert!(wrapped.pose(&points[..1], &mut WrappedSpheres::default()).is_err());
    assert!(wrapped.padding_needed(&[]).is_err());
}
