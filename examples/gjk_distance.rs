//! The signed distance of two convex hulls, apart and then in each other, without a world.

use tautline::geometry::distance::distance;
use tautline::mesh::primitives;
use tautline::{Error, Vec3};

fn main() -> Result<(), Error> {
    let cube = primitives::cube(1.0)?.positions;
    let octahedron = primitives::octahedron(0.5)?.positions;

    for (height, expected) in [(1.5, 0.5), (1.1, 0.1), (0.9, -0.1)] {
        // The octahedron stands on its lower tip above the cube's top face.
        let above: Vec<Vec3> = octahedron.iter().map(|&p| p + Vec3::Y * height).collect();
        let found = distance(&cube, &above)?;
        println!(
            "octahedron at {height} m: distance {:+.3} m, from {:.2} to {:.2}, {} iterations",
            found.distance, found.point_a, found.point_b, found.iterations
        );
        assert!((found.distance - expected).abs() < 1e-6);
        assert!((found.normal - Vec3::Y).length() < 1e-6, "from the cube to the octahedron: up");
    }
    Ok(())
}
