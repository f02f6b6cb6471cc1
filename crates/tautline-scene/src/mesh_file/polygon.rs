//! Polygons to triangles, by cutting off ears (Meisters 1975), so that a face need not be convex.

use tautline::Vec3;

/// Corners of a face that is cut ear by ear, which takes the cube of their number at worst.
const MOST_CORNERS: usize = 256;

/// Corners that are looked at, over all faces of a file, before the division is given up: less than a tenth of a second.
/// That is enough for 100 000 faces of 12 corners, and for fifty of the worst, of 248.
const MOST_WORK: u64 = 1 << 24;

/// Divides the faces of one file.
pub(super) struct Divider {
    work_left: u64,
}

impl Divider {
    pub(super) fn new() -> Self {
        Self { work_left: MOST_WORK }
    }

    /// Adds triangles with the polygon's corners and its direction of turning. A convex polygon becomes a fan around
    /// its first corner.
    pub(super) fn divide(
        &mut self,
        positions: &[Vec3],
        corners: &[u32],
        triangles: &mut Vec<[u32; 3]>,
    ) -> Result<(), String> {
        if corners.len() < 3 {
            return Err(format!("a face of {} corners is none: at least 3", corners.len()));
        }
        let normal = newell_normal(positions, corners);
        let fan = corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]);
        if corners.len() == 3 || fan.clone().all(|triangle| turns(positions, triangle, normal)) {
            triangles.extend(fan);
            return Ok(());
        }
        if corners.len() > MOST_CORNERS {
            let count = corners.len();
            return Err(format!("a face of {count} corners that is not convex: at most {MOST_CORNERS}"));
        }
        self.cut_ears(positions, corners, normal, triangles)
    }

    fn cut_ears(
        &mut self,
        positions: &[Vec3],
        corners: &[u32],
        normal: Vec3,
        triangles: &mut Vec<[u32; 3]>,
    ) -> Result<(), String> {
        let mut rest = corners.to_vec();
        while rest.len() > 3 {
            // Without an ear the polygon crosses itself or has no area: the surface says so where it is built.
            let ear = find_ear(positions, &rest, normal);
            let looked_at = ear.map_or(rest.len(), |ear| ear.max(1)) * rest.len();
            self.work_left = self
                .work_left
                .checked_sub(looked_at as u64)
                .ok_or("faces with many corners that are not convex: divide them into triangles first")?;
            let ear = ear.unwrap_or(1);
            triangles.push(around(&rest, ear));
            rest.remove(ear);
        }
        triangles.push([rest[0], rest[1], rest[2]]);
        Ok(())
    }
}

/// Twice the polygon's area along its normal (Newell's method): right for any polygon that is nearly plane.
fn newell_normal(positions: &[Vec3], corners: &[u32]) -> Vec3 {
    let origin = positions[corners[0] as usize];
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    ends.map(|(&a, &b)| (positions[a as usize] - origin).cross(positions[b as usize] - origin)).sum()
}

/// The first corner, from the second on, whose triangle turns as the polygon does and holds no other corner.
fn find_ear(positions: &[Vec3], corners: &[u32], normal: Vec3) -> Option<usize> {
    (1..=corners.len()).map(|i| i % corners.len()).find(|&i| {
        let ear = around(corners, i);
        let holds = |&other: &u32| !ear.contains(&other) && is_inside(positions, other, ear, normal);
        turns(positions, ear, normal) && !corners.iter().any(holds)
    })
}

/// A corner with its neighbours.
fn around(corners: &[u32], i: usize) -> [u32; 3] {
    let n = corners.len();
    [corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]]
}

/// Whether a triangle turns counter-clockwise around the normal.
fn turns(positions: &[Vec3], triangle: [u32; 3], normal: Vec3) -> bool {
    let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
    (b - a).cross(c - a).dot(normal) > 0.0
}

/// Whether a vertex, seen along the normal, lies in a triangle or on its border.
fn is_inside(positions: &[Vec3], vertex: u32, [a, b, c]: [u32; 3], normal: Vec3) -> bool {
    [[b, a, vertex], [c, b, vertex], [a, c, vertex]].iter().all(|&outside| !turns(positions, outside, normal))
}
