//! Cameras, and what goes with each, as the shaders take them.

use bytemuck::{Pod, Zeroable};
use veduta_carve::{Photo, Projection, Root, View};

/// Seen from the root's corner: single precision is enough for an object, not for where it lies on the
/// earth. offset: where in one buffer for all views the own values begin.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct GivenView {
    rows: [[f32; 4]; 3],
    centre: [f32; 3],
    focal: f32,
    corner: [f32; 2],
    size: [u32; 2],
    offset: u32,
    spare: [u32; 3],
}

impl GivenView {
    /// With the distances to an outline.
    pub(crate) fn of_outline(view: &View<'_>, root: &Root, offset: usize) -> Self {
        let size = [view.width, view.height];
        Self::new(&view.projection, view.corner_px, size, root, offset)
    }

    /// With pixels.
    pub(crate) fn of_photo(photo: &Photo<'_>, root: &Root, offset: usize) -> Self {
        let size = [photo.width, photo.height];
        Self::new(&photo.projection, [0.0; 2], size, root, offset)
    }

    fn new(
        projection: &Projection,
        corner_px: [f64; 2],
        size: [usize; 2],
        root: &Root,
        offset: usize,
    ) -> Self {
        let rows = projection.rows.map(|row| {
            let moved: f64 = row[3] + (0..3).map(|axis| row[axis] * root.low_m[axis]).sum::<f64>();
            [row[0] as f32, row[1] as f32, row[2] as f32, moved as f32]
        });
        let centre = projection.centre_m;
        Self {
            rows,
            centre: std::array::from_fn(|axis| (centre[axis] - root.low_m[axis]) as f32),
            focal: projection.focal_px as f32,
            corner: corner_px.map(|one| one as f32),
            size: size.map(|one| one as u32),
            offset: offset as u32,
            spare: [0; 3],
        }
    }
}
