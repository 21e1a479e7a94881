//! Streams that meshoptimizer wrote, and streams that nobody should have written.

use proptest::prelude::*;
use serde_json::json;

use super::super::buffers::data_uri;
use super::*;

/// Arrays with the streams of each; `make.mjs` beside the file says how they were made.
const STREAMS: &str = include_str!("../../../tests/formats/meshopt/streams.json");

struct Sample {
    name: String,
    compressed: Compressed,
    stream: Vec<u8>,
    decoded: Vec<u8>,
}

fn samples() -> Vec<Sample> {
    let bytes = |text: &Value| {
        let uri = format!(";base64,{}", text.as_str().unwrap());
        data_uri(&uri, "").unwrap().1
    };
    let arrays: Vec<Value> = serde_json::from_str(STREAMS).unwrap();
    let samples = arrays.iter().flat_map(|array| {
        let streams = array["streams"].as_array().unwrap();
        streams.iter().enumerate().map(move |(i, stream)| {
            let stream = bytes(stream);
            let mut json = array.clone();
            json["buffer"] = json!(0);
            json["byteLength"] = json!(stream.len());
            Sample {
                name: format!("{}, stream {i}", array["name"]),
                compressed: Compressed::deserialize(&json).unwrap(),
                stream,
                decoded: bytes(&array["decoded"]),
            }
        })
    });
    samples.collect()
}

fn view(length: u64) -> View {
    View::deserialize(json!({ "buffer": 0, "byteLength": length })).unwrap()
}

/// Decodes as the reader does: what is too short to be true is refused before.
fn decode(compressed: &Compressed, stream: &[u8]) -> Result<Vec<u8>, String> {
    let length = compressed.count.saturating_mul(compressed.byte_stride);
    let compressed = Compressed {
        byte_length: stream.len() as u64,
        ..compressed.clone()
    };
    let length = compressed.decoded_length(&view(length), "");
    let length = length.map_err(|error| error.message)?;
    let decoded = compressed.decode(stream, usize::try_from(length).unwrap(), "");
    decoded.map_err(|error| error.message)
}

/// Whether arrays are the same: bit by bit, but for one unit of the last place where a filter rounds.
fn is_near(filter: Filter, stride: u64, a: &[u8], b: &[u8]) -> bool {
    let short = |bytes: &[u8]| i32::from(i16::from_le_bytes([bytes[0], bytes[1]]));
    let mut pairs = a.chunks(2).zip(b.chunks(2));
    a.len() == b.len()
        && match (filter, stride) {
            (Filter::None | Filter::Exponential, _) => a == b,
            (_, 8) => pairs.all(|(a, b)| (short(a) - short(b)).abs() <= 1),
            _ => a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1),
        }
}

#[test]
fn streams_decode_to_what_their_makers_find() {
    let samples = samples();
    assert!(samples.len() > 50);
    for Sample {
        name,
        compressed,
        stream,
        decoded,
    } in samples
    {
        let found = decode(&compressed, &stream).unwrap_or_else(|e| panic!("{name}: {e}"));
        let stride = compressed.byte_stride;
        assert!(
            is_near(compressed.filter, stride, &found, &decoded),
            "{name}"
        );
    }
}

#[test]
fn cut_and_lengthened_streams_are_refused() {
    for Sample {
        name,
        compressed,
        stream,
        ..
    } in samples()
    {
        for cut in [0, 1, stream.len() / 2, stream.len() - 1] {
            assert!(decode(&compressed, &stream[..cut]).is_err(), "{name}");
        }
        let mut long = stream.clone();
        long.insert(stream.len() / 2, 0);
        long.push(0);
        let _ = decode(&compressed, &long);
        let mut other = stream;
        other[0] ^= 0x10;
        let error = decode(&compressed, &other).unwrap_err();
        assert!(error.starts_with("byte 0 of the stream"), "{name}: {error}");
    }
}

#[test]
fn what_no_stream_of_the_length_holds_is_refused_before_it_is_made() {
    for Sample {
        name, compressed, ..
    } in samples()
    {
        for count in [12_000_000_000, u64::MAX / 3 * 3] {
            let compressed = Compressed {
                count,
                ..compressed.clone()
            };
            let view = view(count.saturating_mul(compressed.byte_stride));
            assert!(compressed.decoded_length(&view, "").is_err(), "{name}");
        }
    }
}

#[test]
fn rules_of_the_extension_are_checked() {
    let good = json!({
        "buffer": 0, "byteLength": 100, "byteStride": 4, "count": 6, "mode": "ATTRIBUTES",
    });
    let length = |json: &Value| {
        let compressed = Compressed::deserialize(json).map_err(|e| e.to_string())?;
        let length = compressed.decoded_length(&view(24), "");
        length.map_err(|error| error.message)
    };
    assert_eq!(length(&good), Ok(24));
    for (change, words) in [
        (json!({ "byteStride": 0 }), "from 4 to 256"),
        (json!({ "byteStride": 6 }), "from 4 to 256"),
        (json!({ "byteStride": 260 }), "from 4 to 256"),
        (json!({ "byteStride": 8 }), "not the 24 bytes"),
        (json!({ "count": 7 }), "not the 24 bytes"),
        (json!({ "mode": "INDICES", "byteStride": 8 }), "2 or 4"),
        (json!({ "mode": "TRIANGLES", "count": 7 }), "multiple of 3"),
        (json!({ "mode": "INDICES", "filter": "COLOR" }), "Color"),
        (json!({ "filter": "QUATERNION" }), "Quaternion"),
        (json!({ "mode": "POINTS" }), "unknown variant `POINTS`"),
        (json!({ "filter": "BLUR" }), "unknown variant `BLUR`"),
        (json!({ "byteLength": 20 }), "at least"),
    ] {
        let mut json = good.clone();
        for (key, value) in change.as_object().unwrap() {
            json[key] = value.clone();
        }
        let error = length(&json).unwrap_err();
        assert!(error.contains(words), "{change}: {error}");
    }
}

#[test]
fn triangles_refer_to_no_edges_before_the_first() {
    let compressed = Compressed::deserialize(json!({
        "buffer": 0, "byteLength": 18, "byteStride": 4, "count": 3, "mode": "TRIANGLES",
    }));
    let compressed = compressed.unwrap();
    let mut stream = [0; 18];
    stream[0] = 0xe1;
    let error = decode(&compressed, &stream).unwrap_err();
    assert!(error.starts_with("byte 1 of the stream"), "{error}");
    stream[1] = 0xf0;
    let decoded = decode(&compressed, &stream).unwrap();
    assert_eq!(decoded, [0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
}

#[test]
fn the_example_of_the_specification_comes_out() {
    // Differences of one byte in four bits, two of which are spelled out.
    let mut stream = vec![0xa0, 2];
    stream.extend([0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0, 0x34, 0xb5]);
    stream.extend([0; 3 + 32]);
    let mut decoded = vec![0; 64];
    attributes::decode(&stream, 4, &mut decoded).unwrap();
    let mut before = 0;
    let mut differences = Vec::new();
    for element in decoded.chunks(4) {
        differences.push(element[0].wrapping_sub(before).cast_signed());
        before = element[0];
        assert_eq!(element[1..], [0; 3]);
    }
    assert_eq!(
        differences,
        [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0]
    );
}

proptest! {
    #[test]
    fn changed_streams_are_decoded_or_refused(
        which: prop::sample::Index,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
    ) {
        let mut samples = samples();
        let Sample { compressed, mut stream, .. } = samples.swap_remove(which.index(samples.len()));
        for (place, byte) in changes {
            let place = place.index(stream.len());
            stream[place] = byte;
        }
        let _ = decode(&compressed, &stream);
    }

    #[test]
    fn any_stream_is_decoded_or_refused(
        head in prop::sample::select(vec![0xa0_u8, 0xa1, 0xd1, 0xe1]),
        body: Vec<u8>,
        stride in 1_u64..300,
        count in 0_u64..2000,
        filter in prop::sample::select(vec!["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"]),
    ) {
        let mut stream = vec![head];
        stream.extend(body);
        for mode in ["ATTRIBUTES", "TRIANGLES", "INDICES"] {
            let compressed = Compressed::deserialize(json!({
                "buffer": 0, "byteLength": 0, "byteStride": stride, "count": count,
                "mode": mode, "filter": filter,
            }));
            let _ = decode(&compressed.unwrap(), &stream);
        }
    }

    #[test]
    fn no_promise_is_kept_by_a_shorter_stream(stride in 1_u64..65, count in 0_u64..5000) {
        // The shortest streams are those of zeros; with a byte less nothing decodes.
        let stride = 4 * stride;
        let least = usize::try_from(attributes::shortest(count, stride)).unwrap();
        let stride = usize::try_from(stride).unwrap();
        let mut out = vec![0; usize::try_from(count).unwrap() * stride];
        let tail = (stride + stride / 4).max(24);
        let mut stream = vec![0xa1];
        stream.resize(least - tail, 0xaa);
        stream.resize(least, 0);
        prop_assert_eq!(attributes::decode(&stream, stride, &mut out), Ok(()));
        stream.remove(1.min(least - 1));
        prop_assert!(attributes::decode(&stream, stride, &mut out).is_err());
    }
}
