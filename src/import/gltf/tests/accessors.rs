//! Numbers of all types, sparse accessors, and accessors that do not fit.

use super::super::accessor::Accessor;
use super::super::budget::Budget;
use super::super::document::{Document, File};
use super::*;
use proptest::prelude::*;

/// Reads accessor 0 as elements of N floats.
fn floats<const N: usize>(maker: &Maker) -> Result<Vec<[f32; N]>> {
    with_document(maker, |document| document.accessors[0].floats(&document.buffers, &document.budget))
}

fn with_document<T>(maker: &Maker, read: impl FnOnce(&Document<'_>) -> Result<T>) -> Result<T> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.glb");
    std::fs::write(&path, maker.glb()).unwrap();
    let mut file = File::read(&path)?;
    let document = Document::open(&mut file)?;
    read(&document)
}

#[test]
fn every_component_type_is_read_as_it_is_and_normalised() {
    let bytes = |words: &[i32], size: usize| -> Vec<u8> {
        words.iter().flat_map(|word| word.to_le_bytes()[..size].to_vec()).collect()
    };
    // Type, bytes of a number, numbers, what they become when normalised
    let cases = [
        (5120, 1, [-128, -127, 127], Some([-1.0, -1.0, 1.0])),
        (5121, 1, [0, 51, 255], Some([0.0, 0.2, 1.0])),
        (5122, 2, [-32768, 0, 32767], Some([-1.0, 0.0, 1.0])),
        (5123, 2, [0, 13107, 65535], Some([0.0, 0.2, 1.0])),
        (5125, 4, [0, 7, 1 << 24], None),
    ];
    for (component, size, words, normalized) in cases {
        let mut maker = Maker::new();
        maker.accessor("SCALAR", component, 3, &bytes(&words, size));
        assert_eq!(floats::<1>(&maker).unwrap(), words.map(|word| [word as f32]), "{component}");
        maker.root["accessors"][0]["normalized"] = json!(true);
        match normalized {
            Some(expected) => {
                let found = floats::<1>(&maker).unwrap();
                let near = found.iter().zip(expected).all(|([x], y)| (x - y).abs() < 1e-6);
                assert!(near, "{component}: {found:?}");
            }
            None => assert!(floats::<1>(&maker).unwrap_err().message.contains("cannot be normalized")),
        }
    }
    let mut maker = Maker::new();
    maker.floats(&[[1.5, -2.5], [0.0, 1e30]]);
    assert_eq!(floats::<2>(&maker).unwrap(), [[1.5, -2.5], [0.0, 1e30]]);
    assert!(floats::<3>(&maker).unwrap_err().message.starts_with("/accessors/0: elements are of type VEC2"));
}

#[test]
fn strides_and_offsets_are_followed() {
    let mut maker = Maker::new();
    maker.accessor("VEC2", U8, 3, &[9, 9, 1, 2, 9, 9, 9, 9, 3, 4, 9, 9, 9, 9, 5, 6]);
    maker.root["bufferViews"][0]["byteStride"] = json!(6);
    maker.root["accessors"][0]["byteOffset"] = json!(2);
    assert_eq!(floats::<2>(&maker).unwrap(), [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]);
    // One byte further and the last element ends behind the view
    maker.root["accessors"][0]["byteOffset"] = json!(3);
    let error = floats::<2>(&maker).unwrap_err().message;
    assert_eq!(
        error,
        "/accessors/0: 3 elements 6 bytes apart from byte 3 on do not fit into /bufferViews/0 of 16 bytes"
    );
}

#[test]
fn sparse_elements_replace_those_of_the_base_or_zeros() {
    let mut maker = Maker::new();
    maker.floats(&[[1.0], [2.0], [3.0], [4.0]]);
    let (indices, values) =
        (maker.view(&[1, 3]), maker.view(&[20.0_f32, 40.0].map(f32::to_le_bytes).concat()));
    maker.root["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": { "bufferView": indices, "componentType": U8 },
        "values": { "bufferView": values },
    });
    assert_eq!(floats::<1>(&maker).unwrap().concat(), [1.0, 20.0, 3.0, 40.0]);
    maker.root["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(floats::<1>(&maker).unwrap().concat(), [0.0, 20.0, 0.0, 40.0]);
    maker.root["accessors"][0]["count"] = json!(3);
    assert!(floats::<1>(&maker).unwrap_err().message.contains("the sparse index 3 is not below 3"));
}

#[test]
fn numbers_that_are_not_finite_are_refused_with_their_place() {
    let mut maker = Maker::new();
    maker.floats(&[[1.0, 2.0], [f32::NAN, 0.0]]);
    let error = floats::<2>(&maker).unwrap_err().message;
    assert_eq!(error, "/accessors/0: element 1 is [NaN, 0.0], must be of finite numbers");
}

#[test]
fn accessors_of_nothing_do_not_exhaust_memory() {
    let mut maker = Maker::new();
    maker.add("accessors", json!({ "type": "VEC4", "componentType": F32, "count": 4_000_000_000_u32 }));
    let error = floats::<4>(&maker).unwrap_err().message;
    assert!(error.contains("the model grows to more than 64 times"), "{error}");
}

proptest! {
    /// An accessor of any description is refused, or gives as many elements as it says, each from its own bytes.
    #[test]
    fn accessors_give_what_they_say_or_are_refused(
        offset in 0_usize..20, stride in prop::option::of(0_usize..20), start in 0_usize..9, length in 0_usize..70,
        count in 0_usize..9, component in 5120_u32..5127, kind in 0_usize..4, bytes in prop::collection::vec(any::<u8>(), 64),
    ) {
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": length });
        if let Some(stride) = stride {
            view["byteStride"] = json!(stride);
        }
        let mut maker = Maker::new();
        maker.bytes = bytes.clone();
        maker.add("bufferViews", view);
        let name = ["SCALAR", "VEC2", "VEC3", "VEC4"][kind];
        let accessor = json!({ "bufferView": 0, "byteOffset": offset, "type": name, "componentType": component, "count": count });
        maker.add("accessors", accessor);
        let size = match component { 5120 | 5121 => 1, 5122 | 5123 => 2, _ => 4 };
        let step = stride.unwrap_or(size * (kind + 1));
        let fits = component != 5124 && count > 0 && start + length <= 64 && stride.is_none_or(|n| n >= 4)
            && step >= size * (kind + 1) && offset + (count - 1) * step + size * (kind + 1) <= length;
        let result = with_document(&maker, |document| {
            let accessor: &Accessor = &document.accessors[0];
            let budget = Budget::of(64);
            Ok(match kind {
                0 => accessor.floats::<1>(&document.buffers, &budget).map(|e| e.concat()),
                1 => accessor.floats::<2>(&document.buffers, &budget).map(|e| e.concat()),
                2 => accessor.floats::<3>(&document.buffers, &budget).map(|e| e.concat()),
                _ => accessor.floats::<4>(&document.buffers, &budget).map(|e| e.concat()),
            })
        });
        prop_assert_eq!(result.is_ok(), fits, "{:?}", result.as_ref().err());
        if let Ok(Ok(numbers)) = result {
            prop_assert_eq!(numbers.len(), count * (kind + 1));
            for (i, number) in numbers.iter().enumerate() {
                let at = start + offset + i / (kind + 1) * step + i % (kind + 1) * size;
                let word: Vec<u8> = bytes[at..at + size].to_vec();
                let expected = match component {
                    5120 => f32::from(word[0] as i8),
                    5121 => f32::from(word[0]),
                    5122 => f32::from(i16::from_le_bytes([word[0], word[1]])),
                    5123 => f32::from(u16::from_le_bytes([word[0], word[1]])),
                    5125 => u32::from_le_bytes([word[0], word[1], word[2], word[3]]) as f32,
                    _ => f32::from_le_bytes([word[0], word[1], word[2], word[3]]),
                };
                prop_assert_eq!(*number, expected);
            }
        }
    }
}
