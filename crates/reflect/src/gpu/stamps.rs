//! END stamps: one at the end of each pass.

/// Hands out END stamps, one a pass, and remembers the passes' names.
#[derive(Debug)]
pub(crate) struct Stamps {
    set: Option<wgpu::QuerySet>,
    names: Vec<String>,
}

impl Stamps {
    /// As many as every adapter has.
    pub(super) const CAPACITY: u32 = wgpu::QUERY_SET_MAX_QUERIES;

    /// Stamps in a query set of [`Stamps::CAPACITY`]; none are written where there is no set.
    pub(super) fn new(set: Option<wgpu::QuerySet>) -> Self {
        let names = Vec::new();
        Self { set, names }
    }

    /// What the stamps are written to.
    pub(super) fn set(&self) -> Option<&wgpu::QuerySet> {
        self.set.as_ref()
    }

    /// Names of the passes since [`Stamps::clear`]; pass `i` ends with stamp `i + 1`.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// Begins a frame.
    pub(super) fn clear(&mut self) {
        self.names.clear();
    }

    /// The query set and the index of the next pass's END stamp.
    pub(super) fn next(&mut self, name: &str) -> Option<(&wgpu::QuerySet, u32)> {
        self.names.push(name.to_owned());
        let index = self.names.len() as u32;
        let set = self.set.as_ref().filter(|_| index < Self::CAPACITY)?;
        Some((set, index))
    }
}
