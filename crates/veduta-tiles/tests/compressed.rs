//! A decoder written from the extension's appendix takes back what was put in.

use proptest::prelude::*;
use veduta_tiles::{compress_attributes, compress_indices};

fn attributes(stream: &[u8], count: usize, stride: usize) -> Vec<u8> {
    assert_eq!(stream[0], 0xa0);
    let mut last = stream[stream.len() - stride..].to_vec();
    let most = ((8192 / stride) & !15).min(256);
    let mut at = 1;
    let mut out = vec![0; count * stride];
    let mut first = 0;
    while first < count {
        let here = most.min(count - first);
        let groups = here.div_ceil(16);
        for plane in 0..stride {
            let header = at;
            at += groups.div_ceil(4);
            let mut before = last[plane];
            for group in 0..groups {
                let code = (stream[header + group / 4] >> (group % 4 * 2)) & 3;
                let changes = unpack(stream, &mut at, code);
                for k in 0..16.min(here - group * 16) {
                    let half = changes[k] >> 1;
                    let change = if changes[k] & 1 == 1 { !half } else { half };
                    before = before.wrapping_add(change);
                    out[(first + group * 16 + k) * stride + plane] = before;
                }
            }
            last[plane] = before;
        }
        first += here;
    }
    out
}

fn unpack(stream: &[u8], at: &mut usize, code: u8) -> [u8; 16] {
    let mut found = [0; 16];
    let bits = [0, 2, 4, 8][usize::from(code)];
    if bits == 0 {
        return found;
    }
    let each = 8 / bits;
    for k in 0..16 {
        let shift = 8 - bits * (k % each + 1);
        let mask = ((1u16 << bits) - 1) as u8;
        found[k] = (stream[*at + k / each] >> shift) & mask;
    }
    *at += 16 / each;
    if bits < 8 {
        for value in &mut found {
            if *value == (1 << bits) - 1 {
                *value = stream[*at];
                *at += 1;
            }
        }
    }
    found
}

fn indices(stream: &[u8], count: usize) -> Vec<u32> {
    assert_eq!(stream[0], 0xd1);
    let (mut at, mut last, mut out) = (1, [0u32; 2], Vec::new());
    for _ in 0..count {
        let (mut value, mut shift) = (0u32, 0);
        loop {
            let byte = stream[at];
            at += 1;
            value |= u32::from(byte & 127) << shift;
            shift += 7;
            if byte < 128 {
                break;
            }
        }
        let (current, folded) = ((value & 1) as usize, value >> 1);
        let change = (folded >> 1) ^ 0u32.wrapping_sub(folded & 1);
        last[current] = last[current].wrapping_add(change);
        out.push(last[current]);
    }
    assert_eq!(at + 4, stream.len());
    out
}

proptest! {
    #[test]
    fn attributes_come_back(
        words in 1usize..9, small in any::<bool>(), bytes in prop::collection::vec(any::<u8>(), 0..4000)
    ) {
        let stride = 4 * words;
        let count = bytes.len() / stride;
        let data: Vec<u8> = bytes[..count * stride]
            .iter()
            .map(|b| if small { b % 5 } else { *b })
            .collect();
        let stream = compress_attributes(&data, stride).unwrap();
        prop_assert_eq!(attributes(&stream, count, stride), data);
    }

    #[test]
    fn indices_come_back(all in prop::collection::vec(0u32..(1 << 29), 0..500)) {
        let stream = compress_indices(all.iter().copied());
        prop_assert_eq!(indices(&stream, all.len()), all);
    }
}

#[test]
fn repetition_is_short() {
    let data = [7, 1, 2, 3].repeat(4096);
    let stream = compress_attributes(&data, 4).unwrap();
    assert!(stream.len() < data.len() / 20, "{}", stream.len());
    assert!(compress_attributes(&data, 6).is_none());
}
