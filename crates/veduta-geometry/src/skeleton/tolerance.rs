//! Every tolerance of the roofs, in one place.
//!
//! Lengths are metres, or shares of the diagonal of the eaves' bounding box where the name says so.

/// The most vertices that eaves may have. Time and memory grow with vertices times reflex vertices:
/// a star of this many takes 3 s and 60 MB.
pub const MOST_VERTICES: usize = 5_000;

/// The largest coordinate (m): beyond, a double no longer resolves a tenth of a millimetre.
pub const LARGEST_COORDINATE_M: f64 = 1e11;

/// The largest speed (m of ground per unit of time).
pub const LARGEST_SPEED: f64 = 1e6;

/// The shortest edge of eaves, as a share of the diagonal.
pub const SHORTEST_EDGE_SHARE: f64 = 1e-8;

/// Edges whose ends are this near to one line, as a share of the diagonal, lie on it. The next is
/// taken where one leaves two edges that are neither in one line nor at an angle.
pub const SAME_LINE_SHARES: [f64; 3] = [4e-12, 1e-10, 5e-10];

/// Sine of the angle below which neighbours at the eaves get a step between them if they differ in
/// speed. (At larger angles their corner runs along the wall at the speed that the angle gives.)
pub const STEP_SINE: f64 = 1e-6;

/// Sine of the angle below which edges that meet on the way count as parallel.
pub const PARALLEL: f64 = 1e-10;

/// Relative difference below which two speeds are the same.
pub const SAME_SPEED: f64 = 1e-12;

/// How far each line is turned (radians) and shifted (share of the diagonal) before the wavefront
/// moves, so that no two events happen at once; the nodes are put back on the true planes after.
/// Some hundred times the rounding of the input, and 10^17 times that of the wavefront.
pub const JITTER: f64 = 3e-14;

/// How much larger the jitter of each further attempt is.
pub const JITTER_GROWTH: f64 = 8.0;

/// How often a wavefront is tried.
pub const ATTEMPTS: u64 = 4;

/// How far a corner of the moved lines may be from its vertex, as a share of its shorter edge.
pub const CORNER_SHIFT_SHARE: f64 = 0.2;

/// Nodes nearer to each other than this, as a share of the diagonal, are one node.
pub const SAME_NODE_SHARE: f64 = 2e-10;

/// How far a node of a roof may lie off the plane of its face, as a share of the diagonal.
pub const PLANE_SHARE: f64 = 1e-9;

/// How much the areas of the faces may differ from the area of the eaves, as a share of it.
pub const AREA_SHARE: f64 = 1e-7;

/// How far two sides of a face may cross, as a share of the diagonal.
pub const CROSSING_SHARE: f64 = 1e-9;

/// What [`super::clean()`] may mend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CleanTolerance {
    /// Vertices nearer to each other, and to an edge that is not theirs, touch (m).
    pub touch_m: f64,
    /// A vertex nearer to the line of its neighbours, with the same speed on both sides, is
    /// dropped; so is a spike that is narrower (m).
    pub off_line_m: f64,
    /// How far parts that touch are moved apart (m); above `touch_m`.
    pub gap_m: f64,
    /// The most that the area may change, as a share of it.
    pub area_share: f64,
}

impl Default for CleanTolerance {
    /// One millimetre, a tenth of one, two of them, and a ten-thousandth of the area.
    fn default() -> Self {
        Self {
            touch_m: 1e-3,
            off_line_m: 1e-4,
            gap_m: 2e-3,
            area_share: 1e-4,
        }
    }
}
