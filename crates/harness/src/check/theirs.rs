//! What a picture has to choose pixels by.

use catoptric_frame::{Channels, FrameError, Image, Status};

/// The layers by which pixels are chosen, as far as a picture has them.
pub struct Theirs {
    /// `primary.id`
    pub primary_id: Option<Image<u32>>,
    /// `reflected.id`
    pub reflected_id: Option<Image<u32>>,
    /// `reflected.status`
    pub status: Option<Image<Status>>,
    /// `bounces`
    pub bounces: Option<Image<u32>>,
}

impl Theirs {
    /// Reads those layers.
    pub fn new(channels: &Channels) -> Result<Self, FrameError> {
        Ok(Self {
            primary_id: channels.integers("primary.id")?,
            reflected_id: channels.integers("reflected.id")?,
            status: channels.statuses("reflected.status")?,
            bounces: channels.integers("bounces")?,
        })
    }
}
