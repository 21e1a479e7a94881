//! Serialization of large types that many crates use.

/// Implements `Deserialize` and `Serialize` for a type that derives them with the attribute
/// `#[serde(remote = "Self")]`.
///
/// The code that Serde derives is generic over the format. Every crate whose steps have a field of this type would
/// therefore compile the code again. The implementations that this macro writes call the derived code with trait
/// objects. The derived code is therefore compiled only once, in this crate.
macro_rules! compiled_once {
    ($name:ident) => {
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                // If this function were inlined into another crate, the derived code would be compiled there.
                #[inline(never)]
                fn derived(
                    deserializer: &mut dyn erased_serde::Deserializer<'_>,
                ) -> Result<$name, erased_serde::Error> {
                    $name::deserialize(deserializer)
                }
                let mut erased = <dyn erased_serde::Deserializer>::erase(deserializer);
                derived(&mut erased).map_err(serde::de::Error::custom)
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                struct Derived<'a>(&'a $name);

                impl serde::Serialize for Derived<'_> {
                    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                        $name::serialize(self.0, to)
                    }
                }

                #[inline(never)]
                fn erased<'a>(derived: &'a Derived<'_>) -> &'a dyn erased_serde::Serialize {
                    derived
                }
                erased_serde::serialize(erased(&Derived(self)), serializer)
            }
        }
    };
}

pub(crate) use compiled_once;
