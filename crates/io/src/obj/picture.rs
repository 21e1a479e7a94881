//! Parses the textures of material libraries, such as `map_Kd -s 2 2 1 wood.png`.

use scene::Texture;

/// A texture with its options, as declared in a material library.
#[derive(Debug, PartialEq)]
pub(super) struct Picture {
    /// The file of the texture.
    pub(super) texture: Texture,
    /// The value of the option `-bm`.
    pub(super) multiplier: Option<f64>,
    /// The number of options other than `-bm`.
    pub(super) n_options: usize,
}

impl Picture {
    /// Parses the text after the keyword: options, followed by a file name. The file name can contain blanks. Returns
    /// `None` if the file name is missing.
    pub(super) fn of(text: &str) -> Option<Self> {
        let mut rest = text.trim();
        let (mut multiplier, mut n_options) = (None, 0);
        while let Some((option, behind)) = cut_option(rest) {
            if option == "-bm" {
                let number = cut_word(behind).0.parse().ok();
                multiplier = number.filter(|m: &f64| m.is_finite());
            } else {
                n_options += 1;
            }
            rest = behind;
            for i in 0..most_values(option) {
                let (word, behind) = cut_word(rest);
                // The options `-o`, `-s` and `-t` have one to three numbers. The first word that is not a number
                // belongs to the file name or to the next option.
                if i > 0 && word.parse::<f64>().is_err() && most_values(option) == 3 {
                    break;
                }
                rest = behind;
            }
        }
        let name = unquoted(rest);
        (!name.is_empty()).then(|| Self {
            texture: Texture::file(name),
            multiplier,
            n_options,
        })
    }
}

/// Splits off the option at the beginning of a string. Returns the option and the rest of the string.
fn cut_option(text: &str) -> Option<(&str, &str)> {
    let (word, rest) = cut_word(text);
    (most_values(word) > 0).then_some((word, rest))
}

/// Returns the maximum number of values that can follow an option, or 0 if the word is not an option.
fn most_values(option: &str) -> usize {
    match option {
        "-o" | "-s" | "-t" => 3,
        "-mm" => 2,
        "-blendu" | "-blendv" | "-boost" | "-texres" | "-clamp" | "-bm" | "-imfchan" | "-type"
        | "-cc" => 1,
        _ => 0,
    }
}

/// Splits off the first word of a string. Returns the word and the rest of the string.
fn cut_word(text: &str) -> (&str, &str) {
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (&text[..end], text[end..].trim_start())
}

/// Returns a name without the quotes around it, if there are any.
fn unquoted(name: &str) -> &str {
    let inner = name
        .strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'));
    inner.unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_not_part_of_the_name() {
        for (text, name, multiplier, n_options) in [
            ("wood.png", "wood.png", None, 0),
            (" my wood.png ", "my wood.png", None, 0),
            ("\"my wood.png\"", "my wood.png", None, 0),
            ("-s 1 1 1 file.png", "file.png", None, 1),
            ("-s 2 file.png", "file.png", None, 1),
            ("-o 0 0.5 2 d.png", "d.png", None, 1),
            (
                "-blendu on -mm 0 1 -clamp on a/b c.png",
                "a/b c.png",
                None,
                3,
            ),
            ("-bm 0.5 bumps.png", "bumps.png", Some(0.5), 0),
            ("-imfchan r -bm x 3", "3", None, 1),
            ("-strange.png", "-strange.png", None, 0),
        ] {
            let expected = Picture {
                texture: Texture::file(name),
                multiplier,
                n_options,
            };
            assert_eq!(Picture::of(text), Some(expected), "{text}");
        }
        for text in ["", " ", "-s 1 1 1", "-bm", "\"\""] {
            assert_eq!(Picture::of(text), None, "{text}");
        }
    }
}
