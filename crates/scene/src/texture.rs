//! Textures: what a picture stores, and the linear value of each stored one.

use glam::Vec3;

/// A picture, to be sampled bilinearly at its finest level with repeat.
///
/// Texel (0, 0) is the top left; texture coordinate v = 0 is the bottom edge: the texel centre
/// of column `i`, row `j` is at `u = (i + ½)/width`, `v = 1 − (j + ½)/height`.
#[derive(Debug, PartialEq)]
pub struct Texture {
    size: [u32; 2],
    samples: Samples,
    table: Vec<f32>,
}

/// Red, green and blue of each texel as stored, rows from the top.
#[derive(Debug, PartialEq)]
pub enum Samples {
    /// Of 8 bits a channel.
    Eight(Vec<[u8; 3]>),
    /// Of 16 bits a channel.
    Sixteen(Vec<[u16; 3]>),
}

impl Samples {
    fn len(&self) -> usize {
        match self {
            Self::Eight(texels) => texels.len(),
            Self::Sixteen(texels) => texels.len(),
        }
    }
}

impl Texture {
    /// A texture of `size` texels (width, height); `table` holds the linear value of each stored
    /// value.
    ///
    /// # Panics
    /// Unless there are as many samples as texels, and as many values as can be stored.
    pub fn new(size: [u32; 2], samples: Samples, table: Vec<f32>) -> Self {
        assert_eq!(size[0] as usize * size[1] as usize, samples.len());
        let values = match samples {
            Samples::Eight(_) => 1 << 8,
            Samples::Sixteen(_) => 1 << 16,
        };
        assert_eq!(table.len(), values, "values of the table");
        Self {
            size,
            samples,
            table,
        }
    }

    /// A texture of 8 bits a channel whose stored values are linear, from 0 to 1.
    ///
    /// # Panics
    /// As [`Texture::new`].
    pub fn linear(size: [u32; 2], texels: Vec<[u8; 3]>) -> Self {
        let table = (0..=u8::MAX).map(|value| f32::from(value) / 255.0);
        Self::new(size, Samples::Eight(texels), table.collect())
    }

    /// Texels a row.
    pub fn width(&self) -> u32 {
        self.size[0]
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.size[1]
    }

    /// What is stored, rows from the top.
    pub fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The linear value of each stored value.
    pub fn table(&self) -> &[f32] {
        &self.table
    }

    /// Linear RGB of a texel, counted in rows from the top.
    #[inline]
    pub fn texel(&self, index: usize) -> Vec3 {
        let values = match &self.samples {
            Samples::Eight(texels) => texels[index].map(usize::from),
            Samples::Sixteen(texels) => texels[index].map(usize::from),
        };
        Vec3::from(values.map(|value| self.table[value]))
    }

    /// Linear RGB of all texels, rows from the top.
    pub fn texels(&self) -> impl Iterator<Item = Vec3> {
        (0..self.samples.len()).map(|index| self.texel(index))
    }
}
