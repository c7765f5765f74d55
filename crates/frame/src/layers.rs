//! The layers that a renderer hands over: what `catoptric diff` and `check` read of anybody's OpenEXR
//! file.
//!
//! One part, scanlines or tiles, any compression that the `exr` crate reads, channels in any order, 16- or 32-bit
//! samples; [`Frame::read_exr`](crate::Frame::read_exr) reads it. Positions in 16-bit samples are too coarse to be
//! judged: write 32 bits. Row 0 is on top, x to the right, y down. A sample belongs to the centre of its pixel, and
//! should come from one ray through that centre.
//!
//! | channels | what | unit and space | where there is nothing |
//! |---|---|---|---|
//! | `R` `G` `B` | colour | linear, the scene's own scale | – |
//! | `primary.id` | what the eye ray meets first | whole number: objects from 1 in the scene file's order, then mirrors | 0 |
//! | `primary.position.X` `.Y` `.Z` | where | world | 0 0 0 |
//! | `primary.normal.X` `.Y` `.Z` | unit normal: a mirror's on its reflecting side (of a mesh the shading normal), an object's towards the eye | world | 0 0 0 |
//! | `reflected.id` | what the reflected ray of a mirror pixel meets | as `primary.id` | 0: the background, or no mirror |
//! | `reflected.position.X` `.Y` `.Z` | where | world | 0 0 0 |
//! | `reflected.distance` | from the mirror's point to there | world units | 0 |
//! | `reflected.status` | what is known of the pixel, below | whole number | 0 |
//! | `bounces` | reflections on the path to there, in a picture with mirrors in mirrors | whole number | 0 |
//!
//! `reflected.status` is 0 where the first surface is no mirror, 1 where the reflection is known, 2 on a mirror where
//! the technique found no answer, 3 where a mesh's shading normal sends the ray below its surface, 4 on a mirror's
//! black back ([`Status`](crate::Status)).
//!
//! The header text `catoptric.ids` names the ids, one a line: id, `object` or `mirror`, name, such as
//! `1 object floor`.
//!
//! # What may be missing
//!
//! - `R G B` must be there.
//! - Either all seven `primary` channels are there or none, and likewise the five `reflected` ones besides the status.
//!   Without them only the colour is compared, over the whole picture, and a message says so.
//! - Without `reflected.status` the pixels of mirrors count as known: those of the ids that `catoptric.ids`
//!   calls mirrors, or, without that list, of each id that has a `reflected.id` at some pixel. Holes of a
//!   technique cannot be told from background then.
//! - Without `catoptric.ids`, which programs that rewrite a file may drop, ids get the names of the other picture.
//! - Only `check` reads `bounces`.
//!
//! # What a metric needs
//!
//! | metric | channels, of both pictures |
//! |---|---|
//! | `color.*`, FLIP | `R G B`; on the mirrors where there are layers |
//! | `object_agreement`, `coverage.*`, `mismatch.*` | `primary.id`, `reflected.id`, `reflected.status` |
//! | `angular_error_deg.*` | those, `primary.position` of the reference, `reflected.position` of both |
//! | `pixel_angle_deg`, `edge_offset_px` | those of the reference |
//!
//! # By hand
//!
//! `examples/write_layers.py` traces the built-in scene `sphere-square` in Python and writes these
//! channels; `catoptric diff truth.exr mine.exr` judges them.
