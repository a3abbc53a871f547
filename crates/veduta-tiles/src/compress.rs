//! The streams of EXT_meshopt_compression: vertices and index sequences, a half to a tenth as long.
//!
//! Appendix A of the extension (Khronos vendor extensions) describes the bitstream: attributes by byte
//! planes, the change from one element to the next in groups of sixteen; indices as the difference
//! to one of two that came before, in bytes of seven bits.

const ATTRIBUTES_HEADER: u8 = 0xa0;
const INDICES_HEADER: u8 = 0xd1;
const BLOCK_BYTES: usize = 8192;
const BLOCK_ELEMENTS: usize = 256;
const GROUP: usize = 16;
const TAIL: usize = 32;

/// Mode `ATTRIBUTES`, filter `NONE`: elements of `stride` bytes (a multiple of four, at most 256).
/// None where the data are no such elements.
pub fn compress_attributes(data: &[u8], stride: usize) -> Option<Vec<u8>> {
    if stride == 0 || stride % 4 != 0 || stride > 256 || data.len() % stride != 0 {
        return None;
    }
    let in_block = (BLOCK_BYTES / stride / GROUP * GROUP).min(BLOCK_ELEMENTS);
    let mut out = vec![ATTRIBUTES_HEADER];
    let first = data.get(..stride).map_or(vec![0; stride], <[u8]>::to_vec);
    let mut last = first.clone();
    for block in data.chunks(in_block * stride) {
        let count = block.len() / stride;
        for plane in 0..stride {
            let mut before = last[plane];
            let mut changes = vec![0; count.div_ceil(GROUP) * GROUP];
            for element in 0..count {
                let value = block[element * stride + plane];
                changes[element] = zigzag(value.wrapping_sub(before));
                before = value;
            }
            plane_bytes(&changes, &mut out);
        }
        last.copy_from_slice(&block[block.len() - stride..]);
    }
    out.resize(out.len() + TAIL.saturating_sub(stride), 0);
    out.extend(first);
    Some(out)
}

/// Mode `INDICES`: any whole numbers below 2^30.
pub fn compress_indices(indices: impl Iterator<Item = u32>) -> Vec<u8> {
    let mut out = vec![INDICES_HEADER];
    let mut last = [0u32; 2];
    let mut current = 0;
    for index in indices {
        if index.abs_diff(last[current]) >= 30 {
            current ^= 1;
        }
        let change = index.wrapping_sub(last[current]);
        let folded = (change << 1) ^ (((change as i32) >> 31) as u32);
        let mut rest = (folded << 1) | current as u32;
        while rest > 127 {
            out.push((rest & 127) as u8 | 128);
            rest >>= 7;
        }
        out.push(rest as u8);
        last[current] = index;
    }
    out.extend([0; 4]);
    out
}

fn zigzag(change: u8) -> u8 {
    (((change as i8) >> 7) as u8) ^ (change << 1)
}

/// Two bits for each group say how many bits its changes take; those are behind.
fn plane_bytes(changes: &[u8], out: &mut Vec<u8>) {
    let header = out.len();
    let groups = changes.len() / GROUP;
    out.resize(header + groups.div_ceil(4), 0);
    for (number, group) in changes.chunks(GROUP).enumerate() {
        let code = (0..4u8)
            .min_by_key(|&code| group_size(group, code))
            .unwrap_or(3);
        out[header + number / 4] |= code << (number % 4 * 2);
        match code {
            0 => {}
            3 => out.extend(group),
            _ => group_bytes(group, 1 << code, out),
        }
    }
}

fn group_size(group: &[u8], code: u8) -> usize {
    match code {
        0 if group.iter().all(|&change| change == 0) => 0,
        0 => usize::MAX,
        3 => GROUP,
        _ => {
            let bits = 1usize << code;
            let most = (1u8 << bits) - 1;
            GROUP * bits / 8 + group.iter().filter(|&&change| change >= most).count()
        }
    }
}

fn group_bytes(group: &[u8], bits: usize, out: &mut Vec<u8>) {
    let most = (1u8 << bits) - 1;
    for some in group.chunks(8 / bits) {
        let packed = some
            .iter()
            .fold(0u8, |byte, &change| (byte << bits) | change.min(most));
        out.push(packed);
    }
    out.extend(group.iter().filter(|&&change| change >= most));
}
