//! Decodes arbitrary bytes as PNG or JPEG files.

#![no_main]

use libfuzzer_sys::fuzz_target;
use render::Image;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(image) = Image::decode(bytes) {
        assert_eq!(image.pixels.len() as u64, u64::from(image.width) * u64::from(image.height));
    }
});
