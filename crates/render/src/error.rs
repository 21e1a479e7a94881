//! The errors of this crate.

use mesh::readable_bytes;

/// The reason why a picture cannot be made or read.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// A side of an image is 0 or longer than [`LARGEST_SIDE`](crate::LARGEST_SIDE) pixels.
    #[error(
        "expected an image of 1 to {limit} pixels per side, found {width} x {height}; choose another size",
        limit = crate::LARGEST_SIDE
    )]
    Size {
        /// The width in pixels.
        width: u32,
        /// The height in pixels.
        height: u32,
    },
    /// The picture needs more memory than the budget allows.
    #[error(
        "the picture needs {} of memory, which exceeds the memory budget of {}; make the image smaller or raise the \
         budget",
        readable_bytes(*.needed), readable_bytes(*.budget)
    )]
    Budget {
        /// The memory that the picture needs, in bytes.
        needed: u64,
        /// The memory budget of the picture, in bytes.
        budget: u64,
    },
    /// A parameter of the camera is out of range, or the direction of the camera is undefined.
    #[error("{0}")]
    Camera(String),
    /// A number of the style is out of range, or the style or an overlay does not match the scene.
    #[error("{0}")]
    Style(String),
    /// The progress listener canceled the work.
    #[error("cancelled")]
    Cancelled,
    /// The bytes are not an image that can be read.
    #[error("the image cannot be read: {0}")]
    Decode(String),
    /// One of the two compared files is not an image that can be read.
    #[error("image {} of 2 cannot be read: {why}", .file + 1)]
    Unreadable {
        /// The index of the file, 0 or 1.
        file: usize,
        /// The reason why the file cannot be read.
        why: String,
    },
    /// An image cannot be encoded.
    #[error("the image cannot be encoded: {0}")]
    Encode(String),
}

impl PictureError {
    /// Returns an error if a picture needs more memory than the budget. Both numbers are in bytes.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Budget`] if `needed` exceeds `budget`.
    pub fn check_budget(needed: u64, budget: u64) -> Result<(), Self> {
        if needed > budget {
            return Err(Self::Budget { needed, budget });
        }
        Ok(())
    }
}

impl From<png::EncodingError> for PictureError {
    fn from(error: png::EncodingError) -> Self {
        Self::Encode(error.to_string())
    }
}

impl From<gif::EncodingError> for PictureError {
    fn from(error: gif::EncodingError) -> Self {
        Self::Encode(error.to_string())
    }
}
