//! The one error type of the engine: what was wrong, where, and what would be right.

use glam::Vec3;

/// Why a call was refused. The world is as it was before the call.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number outside its range; `field` is its path, such as `settings.substeps`.
    #[error("{field}: {value} is not {expected}")]
    OutOfRange {
        /// Path of the field.
        field: String,
        /// The value found; not finite where that is what is wrong.
        value: f64,
        /// What would be right, such as "a finite number above 0".
        expected: &'static str,
    },
    /// A value that is wrong as a whole: a list that is empty, a hull without volume.
    #[error("{field}: {problem}")]
    Invalid {
        /// Path of the field.
        field: String,
        /// What is wrong and what would be right.
        problem: String,
    },
    /// A mesh that cannot be used, with the place of its first defect.
    #[error("mesh: {0}")]
    Mesh(#[from] MeshDefect),
    /// A handle whose body or joint has been removed.
    #[error("this handle names nothing any more: it has been removed")]
    StaleHandle,
    /// Bytes that are not a snapshot this version can read.
    #[error("snapshot: {0}")]
    Snapshot(String),
}

/// What is wrong with a triangle mesh, and where. Indices count from 0 in the order given.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshDefect {
    /// No triangles.
    #[error("it has no triangles")]
    Empty,
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} names vertex {vertex}, but there are only {count}")]
    IndexOutOfRange {
        /// The triangle.
        triangle: usize,
        /// The index it names.
        vertex: u32,
        /// How many vertices there are.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A triangle with a repeated vertex or without area.
    #[error("triangle {triangle} is degenerate: its corners are not three distinct points off one line")]
    DegenerateTriangle {
        /// The triangle.
        triangle: usize,
    },
    /// Two triangles with the same corners.
    #[error("triangles {first} and {second} have the same corners")]
    DuplicateTriangle {
        /// The earlier one.
        first: usize,
        /// The later one.
        second: usize,
    },
    /// An edge in more than two triangles.
    #[error("edge ({a}, {b}) belongs to more than two triangles, the third being {triangle}")]
    NonManifoldEdge {
        /// One end.
        a: u32,
        /// The other end.
        b: u32,
        /// The triangle one too many.
        triangle: usize,
    },
    /// Two triangles run along an edge in the same direction: one of them is flipped.
    #[error("triangle {triangle} is flipped: it runs along edge ({a}, {b}) the same way as its neighbour")]
    FlippedTriangle {
        /// The triangle.
        triangle: usize,
        /// Start of the edge.
        a: u32,
        /// End of the edge.
        b: u32,
    },
    /// A vertex where two or more fans of triangles meet only in a point.
    #[error("vertex {vertex} is a bow-tie: its triangles form more than one fan")]
    BowTieVertex {
        /// The vertex.
        vertex: u32,
    },
    /// A vertex of no triangle.
    #[error("vertex {vertex} belongs to no triangle")]
    IsolatedVertex {
        /// The vertex.
        vertex: u32,
    },
    /// A closed surface was asked for and this edge has one triangle only.
    #[error("edge ({a}, {b}) is open: the surface is not closed")]
    OpenEdge {
        /// One end.
        a: u32,
        /// The other end.
        b: u32,
    },
    /// The surface is closed but turned inside out, or encloses no volume.
    #[error("it encloses a volume of {volume} m³; triangles must run counter-clockwise seen from outside")]
    NotPositiveVolume {
        /// The signed volume, in m³.
        volume: f64,
    },
    /// Points that span no volume: fewer than four, or all in one plane.
    #[error("its {count} points span no volume: at least four points off one plane are needed")]
    Flat {
        /// How many points there were.
        count: usize,
    },
    /// No tetrahedralisation was found that keeps the surface as it is.
    #[error("it could not be divided into tetrahedra: {0}")]
    Tetrahedralisation(String),
}

/// Refuses what is not a finite number above 0.
pub(crate) fn positive(field: &str, value: f32) -> Result<f32, Error> {
    within(field, value, f32::MIN_POSITIVE, f32::MAX, "a finite number above 0")
}

/// Refuses what is NaN or outside `low..=high`.
pub(crate) fn within(
    field: &str,
    value: f32,
    low: f32,
    high: f32,
    expected: &'static str,
) -> Result<f32, Error> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(Error::OutOfRange { field: field.into(), value: f64::from(value), expected })
}

/// Refuses a vector with a coordinate that is NaN, infinite or beyond ±1e9.
pub(crate) fn coordinates(field: &str, value: Vec3) -> Result<Vec3, Error> {
    for (axis, part) in ["x", "y", "z"].into_iter().zip(value.to_array()) {
        within(&format!("{field}.{axis}"), part, -1e9, 1e9, "a number from -1e9 to 1e9")?;
    }
    Ok(value)
}

/// Refuses points of which one has a coordinate that is NaN, infinite or beyond ±1e9.
pub(crate) fn all_coordinates(field: &str, points: &[Vec3]) -> Result<(), Error> {
    let sound = |point: &Vec3| point.abs().cmple(Vec3::splat(1e9)).all();
    match points.iter().position(|point| !sound(point)) {
        Some(index) => coordinates(&format!("{field}[{index}]"), points[index]).map(|_| ()),
        None => Ok(()),
    }
}
