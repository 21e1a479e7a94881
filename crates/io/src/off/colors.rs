//! Colors as parts of 1 or as 255ths.

use glam::DVec4;

use crate::error::TextError;
use crate::text::{Place, number};

/// Colors as they are written, until it is known whether they are 255ths.
#[derive(Default)]
pub(super) struct Colors {
    values: Vec<DVec4>,
    /// Which of them have no alpha.
    opaque: Vec<bool>,
    fraction: bool,
    above_one: bool,
}

impl Colors {
    /// Adds a color of three or four words.
    pub(super) fn push(&mut self, words: &[(Place, &[u8])]) -> Result<(), TextError> {
        let mut color = DVec4::ONE;
        for (i, &(place, word)) in words.iter().enumerate() {
            color[i] = number(place, word)?;
            self.fraction |= word.iter().any(|byte| matches!(byte, b'.' | b'e' | b'E'));
            self.above_one |= color[i] > 1.0;
        }
        self.values.push(color);
        self.opaque.push(words.len() == 3);
        Ok(())
    }

    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    /// The place of a face without a color.
    pub(super) fn skip(&mut self) {
        self.values.push(DVec4::ONE);
        self.opaque.push(true);
    }

    pub(super) fn finish(mut self) -> Vec<DVec4> {
        if self.above_one && !self.fraction {
            for (color, opaque) in self.values.iter_mut().zip(self.opaque) {
                let alpha = if opaque { 1.0 } else { color.w / 255.0 };
                *color = (color.truncate() / 255.0).extend(alpha);
            }
        }
        self.values
    }
}
