use crate::error::SurfaceError;

/// Where the values come from: a dense grid, or blocks that are filled in when they are asked for.
pub trait Samples: Sync {
    /// Samples along x, y and z.
    fn size(&self) -> [usize; 3];

    /// Writes the values of one layer, `y * size[2] + z`; NaN where nothing is known.
    fn layer(&self, x: usize, into: &mut [f32]);
}

/// A dense grid, z fastest.
#[derive(Debug, Clone, Copy)]
pub struct Grid<'a> {
    values: &'a [f32],
    size: [usize; 3],
}

impl<'a> Grid<'a> {
    pub fn new(values: &'a [f32], size: [usize; 3]) -> Result<Self, SurfaceError> {
        let needed = size.iter().product();
        if values.len() != needed {
            let given = values.len();
            return Err(SurfaceError::Size {
                size,
                needed,
                given,
            });
        }
        Ok(Self { values, size })
    }
}

impl Samples for Grid<'_> {
    fn size(&self) -> [usize; 3] {
        self.size
    }

    fn layer(&self, x: usize, into: &mut [f32]) {
        let length = self.size[1] * self.size[2];
        into.copy_from_slice(&self.values[x * length..][..length]);
    }
}
