//! What can go wrong with a picture.

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The sides of an image are not from 1 to [`LARGEST_SIDE`](crate::LARGEST_SIDE) pixels.
    #[error(
        "expected an image of 1 to {limit} pixels a side, found {width} x {height}; choose another size",
        limit = crate::LARGEST_SIDE
    )]
    Size {
        /// Pixels from left to right.
        width: u32,
        /// Pixels from top to bottom.
        height: u32,
    },
    /// The picture needs more memory than it may take.
    #[error(
        "the picture needs {needed} bytes of memory, and {budget} are allowed; make the image smaller, or \
         allow more"
    )]
    Budget {
        /// The bytes that it needs.
        needed: u64,
        /// The bytes that it may take.
        budget: u64,
    },
    /// There is no view of the scene from this camera.
    #[error("{0}")]
    Camera(String),
    /// The style asks for what the scene does not have.
    #[error("{0}")]
    Style(String),
    /// It was asked not to go on.
    #[error("cancelled")]
    Cancelled,
    /// A file is no image.
    #[error("the image cannot be read: {0}")]
    Decode(String),
    /// One of several files is no image.
    #[error("the image of number {file} cannot be read: {why}")]
    Unreadable {
        /// Which of the files, from 0.
        file: usize,
        /// Why it cannot be read.
        why: String,
    },
    /// An image cannot be encoded.
    #[error("the image cannot be encoded: {0}")]
    Encode(String),
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
