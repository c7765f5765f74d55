//! A dense 2-D array.

/// Row-major pixels, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image<T> {
    width: u32,
    height: u32,
    data: Vec<T>,
}

impl<T: Clone> Image<T> {
    /// An image filled with one value.
    pub fn filled(size: [u32; 2], value: T) -> Self {
        let data = vec![value; size[0] as usize * size[1] as usize];
        Self {
            width: size[0],
            height: size[1],
            data,
        }
    }
}

impl<T> Image<T> {
    /// An image over existing pixels.
    ///
    /// # Panics
    /// If `data` does not hold `size[0] * size[1]` pixels: a bug in the caller.
    pub fn from_vec(size: [u32; 2], data: Vec<T>) -> Self {
        assert_eq!(
            data.len(),
            size[0] as usize * size[1] as usize,
            "pixels of {size:?}"
        );
        Self {
            width: size[0],
            height: size[1],
            data,
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[T] {
        &self.data
    }

    /// All pixels, row by row from the top, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [T] {
        &mut self.data
    }

    /// Pixel at column `x`, row `y`.
    pub fn at(&self, x: u32, y: u32) -> &T {
        &self.data[y as usize * self.width as usize + x as usize]
    }

    /// Pixel at column `x`, row `y`, to be changed.
    pub fn at_mut(&mut self, x: u32, y: u32) -> &mut T {
        &mut self.data[y as usize * self.width as usize + x as usize]
    }

    /// An image of the same size with `f` applied to every pixel.
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Image<U> {
        Image {
            width: self.width,
            height: self.height,
            data: self.data.iter().map(f).collect(),
        }
    }
}
