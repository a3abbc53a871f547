use crate::error::CarveError;

/// From the world to pixels: the third row gives the depth (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    pub rows: [[f64; 4]; 3],
    /// The larger focal length (px).
    pub focal_px: f64,
    /// Where the camera stands (m).
    pub centre_m: [f64; 3],
}

impl Projection {
    /// (x, y) in pixels and the depth in metres; the pixels of what is not in front mean nothing.
    pub fn project(&self, point: [f64; 3]) -> ([f64; 2], f64) {
        let of = |row: [f64; 4]| row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3];
        let depth = of(self.rows[2]);
        ([of(self.rows[0]) / depth, of(self.rows[1]) / depth], depth)
    }
}

/// What a view says of the silhouette: the signed distance to its outline in pixels, less than zero
/// inside, around the part of the picture that has the silhouette.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    pub projection: Projection,
    /// The picture's coordinates of the upper left corner of the distances.
    pub corner_px: [f64; 2],
    pub width: usize,
    pub height: usize,
    pub distances_px: &'a [f32],
}

impl View<'_> {
    pub fn check(&self, view: usize) -> Result<(), CarveError> {
        let (width, height, given) = (self.width, self.height, self.distances_px.len());
        let needed = width * height;
        if given != needed || needed == 0 {
            return Err(CarveError::Size {
                view,
                width,
                height,
                needed,
                given,
            });
        }
        Ok(())
    }

    /// Between the four pixels around; beyond the border that of the border.
    pub fn distance_px(&self, at: [f64; 2]) -> f32 {
        let x = (at[0] - self.corner_px[0] - 0.5).clamp(0.0, (self.width - 1) as f64) as f32;
        let y = (at[1] - self.corner_px[1] - 0.5).clamp(0.0, (self.height - 1) as f64) as f32;
        let (left, top) = (x as usize, y as usize);
        let (right, low) = (
            (left + 1).min(self.width - 1),
            (top + 1).min(self.height - 1),
        );
        let (x, y) = (x - left as f32, y - top as f32);
        let value = |row: usize, column: usize| self.distances_px[row * self.width + column];
        let upper = value(top, left) * (1.0 - x) + value(top, right) * x;
        let lower = value(low, left) * (1.0 - x) + value(low, right) * x;
        upper * (1.0 - y) + lower * y
    }
}

/// A picture with its camera. pixels: three bytes each, row by row.
#[derive(Debug, Clone, Copy)]
pub struct Photo<'a> {
    pub projection: Projection,
    pub width: usize,
    pub height: usize,
    pub pixels: &'a [u8],
}

impl Photo<'_> {
    pub fn check(&self, view: usize) -> Result<(), CarveError> {
        let (width, height, given) = (self.width, self.height, self.pixels.len());
        let needed = width * height * 3;
        if given != needed || needed == 0 {
            return Err(CarveError::Size {
                view,
                width,
                height,
                needed,
                given,
            });
        }
        Ok(())
    }

    /// Between the four pixels around; None outside of the picture.
    pub fn colour(&self, at: [f64; 2]) -> Option<[f32; 3]> {
        let (x, y) = (at[0] - 0.5, at[1] - 0.5);
        let (most_x, most_y) = ((self.width - 1) as f64, (self.height - 1) as f64);
        if !(x >= 0.0 && y >= 0.0 && x <= most_x && y <= most_y) {
            return None;
        }
        let (left, top) = (x as usize, y as usize);
        let (right, low) = (
            (left + 1).min(self.width - 1),
            (top + 1).min(self.height - 1),
        );
        let (x, y) = ((x - left as f64) as f32, (y - top as f64) as f32);
        let value = |row: usize, column: usize, channel: usize| {
            f32::from(self.pixels[(row * self.width + column) * 3 + channel])
        };
        Some([0, 1, 2].map(|c| {
            let upper = value(top, left, c) * (1.0 - x) + value(top, right, c) * x;
            let lower = value(low, left, c) * (1.0 - x) + value(low, right, c) * x;
            upper * (1.0 - y) + lower * y
        }))
    }
}
