//! Shapes and trusses. Those already built are kept for inputs to come, since to build one takes longer than a step.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use tautline::mesh::primitives;
use tautline::shape::Decomposition;
use tautline::{Error, Quat, Shape, Truss, Vec3};

/// Most of them that are kept.
const MOST_KEPT: usize = 2_000;

/// What was built, by what it was built from.
type Kept<T> = RefCell<BTreeMap<(u8, Vec<u32>), Arc<T>>>;

/// A shape of one of ten kinds.
pub(super) fn shape(kind: u8, numbers: &[f32]) -> Result<Arc<Shape>, Error> {
    thread_local! {
        static SHAPES: Kept<Shape> = const { RefCell::new(BTreeMap::new()) };
    }
    SHAPES.with(|kept| keep(kept, (kind, numbers), || build(kind, numbers)))
}

/// A truss of one of two kinds.
pub(super) fn truss(kind: u8, size: f32) -> Result<Arc<Truss>, Error> {
    thread_local! {
        static TRUSSES: Kept<Truss> = const { RefCell::new(BTreeMap::new()) };
    }
    let build = || match kind {
        0 => Truss::from_mesh(&primitives::cube(size)?),
        _ => Truss::from_mesh(&primitives::tetrahedron(size)?),
    };
    TRUSSES.with(|kept| keep(kept, (kind, &[size]), build))
}

fn keep<T>(
    kept: &Kept<T>,
    (kind, numbers): (u8, &[f32]),
    build: impl FnOnce() -> Result<T, Error>,
) -> Result<Arc<T>, Error> {
    let key = (kind, numbers.iter().map(|number| number.to_bits()).collect());
    if let Some(built) = kept.borrow().get(&key) {
        return Ok(Arc::clone(built));
    }
    let built = Arc::new(build()?);
    let mut kept = kept.borrow_mut();
    if kept.len() == MOST_KEPT {
        kept.clear();
    }
    kept.insert(key, Arc::clone(&built));
    Ok(built)
}

fn build(kind: u8, numbers: &[f32]) -> Result<Shape, Error> {
    let at = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
    let vector = |i: usize| Vec3::new(at(i), at(i + 1), at(i + 2));
    match kind {
        0 => Shape::sphere(at(0)),
        1 => Shape::capsule(at(0), at(1)),
        2 => Shape::cylinder(at(0), at(1)),
        3 => Shape::cuboid(Vec3::new(at(0), at(1), 0.3)),
        4 => {
            let points: Vec<Vec3> = (0..numbers.len() / 3).map(|i| vector(3 * i)).collect();
            Shape::convex_hull(&points)
        }
        5 => {
            let (ball, rod) = (Shape::sphere(at(0))?, Shape::capsule(0.2, at(1))?);
            let turn = Quat::from_xyzw(at(5), at(6), 0.0, 1.0);
            Shape::compound(&[(&ball, Vec3::ZERO, Quat::IDENTITY), (&rod, vector(2), turn)])
        }
        6 => Shape::height_field(2, 2, at(0), &std::array::from_fn::<f32, 9, _>(at)),
        7 => Shape::triangle_mesh(&primitives::grid(2, 2, at(0), at(1))?),
        8 => Shape::from_mesh(&primitives::tetrahedron(at(0))?),
        _ => Shape::decomposed(&primitives::torus(at(0), at(1), 5, 3)?, &Decomposition::default()),
    }
}
