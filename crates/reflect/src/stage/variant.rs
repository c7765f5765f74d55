//! What frames are rendered for.

/// What a frame is rendered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variant {
    /// Accuracy: all layers, and the work is counted.
    AllLayers,
    /// Timing: colour and depth, as an application would.
    Color,
}
