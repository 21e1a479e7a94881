//! Finds the types of the numbers in an accessor, and decodes numbers from bytes.

use gltf_json::Accessor;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;

use crate::fault::Fault;

pub(super) fn kinds(accessor: &Accessor, here: &str) -> Result<(Type, ComponentType), Fault> {
    let Checked::Valid(kind) = accessor.type_ else {
        let message = "expected SCALAR, VEC2, VEC3, ...";
        return Err(Fault::json(format!("{here}/type"), message));
    };
    let Checked::Valid(component) = accessor.component_type else {
        let message = "expected one of 5120, 5121, 5122, 5123, 5125, 5126";
        return Err(Fault::json(format!("{here}/componentType"), message));
    };
    Ok((kind, component.0))
}

pub(super) fn number(bytes: &[u8], component: ComponentType, normalized: bool) -> f64 {
    let (value, largest) = match (component, bytes) {
        (ComponentType::I8, &[a]) => (f64::from(i8::from_le_bytes([a])), 127.0),
        (ComponentType::U8, &[a]) => (f64::from(a), 255.0),
        (ComponentType::I16, &[a, b]) => (f64::from(i16::from_le_bytes([a, b])), 32767.0),
        (ComponentType::U16, &[a, b]) => (f64::from(u16::from_le_bytes([a, b])), 65535.0),
        (ComponentType::U32, &[a, b, c, d]) => (
            f64::from(u32::from_le_bytes([a, b, c, d])),
            f64::from(u32::MAX),
        ),
        (ComponentType::F32, &[a, b, c, d]) => return f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => return f64::NAN,
    };
    // The lowest signed integer and the next higher one (for example, -128 and -127) both represent -1 if they are
    // normalized.
    if normalized {
        (value / largest).max(-1.0)
    } else {
        value
    }
}

pub(super) fn whole(bytes: &[u8], component: ComponentType) -> u32 {
    match (component, bytes) {
        (ComponentType::U8, &[a]) => u32::from(a),
        (ComponentType::U16, &[a, b]) => u32::from(u16::from_le_bytes([a, b])),
        (ComponentType::U32, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]),
        _ => u32::MAX,
    }
}

pub(super) fn type_name(kind: Type) -> &'static str {
    match kind {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    }
}

pub(super) fn one_of(types: &[Type]) -> String {
    let names: Vec<&str> = types.iter().map(|&kind| type_name(kind)).collect();
    names.join(" or ")
}
